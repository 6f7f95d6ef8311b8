//! What bytes may be that came without their addresses: a block of registers pasted by itself, a response
//! whose request nobody has.
//!
//! Every shape that the device's table knows is tried. What speaks for one are the values themselves: states
//! that have a name, bits that must be 0, floats of a usual size. It is counted in bits of chance.

use std::mem::discriminant;

use super::read::{Block, Numbers};
use super::{Access, Area, Content, Mapped, Part, Profile, Registers, Settings};
use crate::field::{Argument, Bits, Field, Format, Message, Span, Spec, Value, leaves, problems};
use crate::message;
use crate::walk;

/// One way to read them.
#[derive(Clone, Debug)]
pub struct Likely {
    /// "Status and 32-bit float".
    pub kind: Message,
    /// The values in a sentence.
    pub said: Message,
    /// They tile the bytes.
    pub fields: Vec<Field>,
    /// What speaks for it, or against it.
    pub reason: Message,
    /// What the bytes do not tell.
    pub unknown: Message,
    /// Blocks one behind the other.
    pub blocks: usize,
    /// How much speaks for it, in bits of chance; below 0 it speaks against it.
    pub bits: i32,
}

impl Profile {
    /// Every way to read `bytes` as registers of the device.
    pub fn likely(&'static self, bytes: &[u8], settings: &Settings) -> Vec<Likely> {
        if bytes.is_empty() || !bytes.len().is_multiple_of(2) || self.ident.is_some() {
            return Vec::new();
        }
        let mut shapes: Vec<(Shape, Vec<&'static str>, u16)> = Vec::new();
        for area in self.areas.iter().filter(|area| area.access != Access::Write) {
            let Some(shape) = Shape::of(area) else { continue };
            match shapes.iter_mut().find(|(known, ..)| known.same(&shape)) {
                Some((_, of, most)) => {
                    *most = area.count.max(*most);
                    if !of.contains(&area.spec.label) {
                        of.push(area.spec.label);
                    }
                }
                None => shapes.push((shape, vec![area.spec.label], area.count)),
            }
        }
        let read = shapes.into_iter().filter_map(|(shape, of, most)| {
            let likely = shape.read(bytes, of, settings)?;
            (likely.blocks <= usize::from(most)).then_some(likely)
        });
        let mut found: Vec<Likely> = read.collect();
        found.extend(self.mapped_block(bytes, settings));
        found
    }

    /// The registers of a mapping list, from its beginning on.
    fn mapped_block(&'static self, bytes: &[u8], settings: &Settings) -> Option<Likely> {
        if !self.areas.iter().any(|area| matches!(area.content, Content::Mapped)) {
            return None;
        }
        let mapping = &settings.read_mapping;
        let count = bytes.len() / 2;
        let span = Span::new(0, bytes.len());
        let registers = Registers {
            start: mapping.start,
            count,
            width: 2,
            access: Access::Read,
            single: false,
            values: Some(bytes),
            span,
        };
        let said = self.registers(&registers, settings);
        let known = (0..count as u16)
            .all(|at| matches!(mapping.entry(mapping.start.saturating_add(at)), Mapped::Entry(..)));
        let fields: Vec<Field> = said.blocks.iter().map(|block| block.field.clone()).collect();
        let (bits, reason) = match known {
            true if count == mapping.entries.len() => {
                (9, message!("they are as many as the mapping list has entries for"))
            }
            true => (6, message!("the mapping list has entries for all of them")),
            false => (1, message!("any parameter can be mapped")),
        };
        Some(Likely {
            kind: message!("registers of the mapping list"),
            said: said.sentence()?,
            fields,
            reason,
            unknown: message!("the bytes do not tell whether they begin where the mapping list does"),
            blocks: 1,
            bits,
        })
    }
}

/// How a block is laid out.
#[derive(Clone, Copy)]
enum Shape {
    Parts(&'static [Part]),
    /// One number over so many bytes.
    Number(&'static Spec, usize),
    /// A telegram, and the numbers of registers that are read of it.
    Telegram(super::New, &'static Spec, Option<&'static Spec>),
}

impl Shape {
    fn of(area: &'static Area) -> Option<Self> {
        match area.content {
            Content::Parts(parts) => Some(Self::Parts(parts)),
            // Of a plain number nothing speaks for one more than for another.
            Content::Value => {
                let width = area.length.unwrap_or(2 * usize::from(area.stride));
                let telling = area.spec.format == Format::Float || !area.spec.bits.is_empty();
                telling.then_some(Self::Number(&area.spec, width))
            }
            Content::Telegram { read, .. } => read.map(|new| Self::Telegram(new, &area.spec, area.reads)),
            Content::Mapped => None,
        }
    }

    /// Whether the values are the same, whatever they are of.
    fn same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Parts(one), Self::Parts(other)) => std::ptr::eq(*one, *other),
            (Self::Number(one, width), Self::Number(other, other_width)) => {
                let alike = discriminant(&one.format) == discriminant(&other.format);
                width == other_width && alike && one.bits == other.bits
            }
            _ => false,
        }
    }

    /// Bytes of one block; `None` where the bytes themselves tell.
    fn width(&self) -> Option<usize> {
        match self {
            Self::Parts(parts) => Some(parts.iter().map(|part| 2 * usize::from(part.registers)).sum()),
            Self::Number(_, width) => Some(*width),
            Self::Telegram(..) => None,
        }
    }

    fn kind(&self) -> Message {
        let number = |spec: &'static Spec, width: usize| match (spec.format, width) {
            (Format::Float, 4) => message!("32-bit float"),
            (Format::Float, _) => message!("64-bit float"),
            _ => Message::term(spec.label),
        };
        match self {
            Self::Parts(parts) => {
                let named = parts.iter().map(|part| number(part.spec, 2 * usize::from(part.registers)));
                let join = |said, next| message!("{said} and {next}", said = said, next = next);
                named.reduce(join).unwrap_or(message!("nothing"))
            }
            Self::Number(spec, width) => number(spec, *width),
            Self::Telegram(_, spec, _) => Message::term(spec.label),
        }
    }

    /// The bytes in this shape, if they are as many as it takes.
    fn read(&self, bytes: &[u8], of: Vec<&'static str>, settings: &Settings) -> Option<Likely> {
        let width = self.width().unwrap_or(bytes.len());
        let registers = bytes.len() as u64 / 2;
        let read_so = match self {
            Self::Telegram(_, _, Some(reads)) => reads.name(registers).is_some(),
            Self::Telegram(_, _, None) => registers == 1,
            _ => true,
        };
        if width == 0 || !bytes.len().is_multiple_of(width) || !read_so {
            return None;
        }
        let mut fields = Vec::new();
        let mut said = Vec::new();
        let mut bits = 0;
        for (block, from) in bytes.chunks(width).zip((0..).step_by(width)) {
            let mut read = match self {
                Self::Parts(parts) => {
                    let parts = parts.iter().map(|part| (part.spec, 2 * usize::from(part.registers)));
                    walk::read(&mut Numbers::new(parts), block).fields
                }
                Self::Number(spec, width) => {
                    walk::read(&mut Numbers::new([(*spec, *width)].into_iter()), block).fields
                }
                Self::Telegram(new, ..) => walk::read(new(settings).as_mut(), block).fields,
            };
            read.iter_mut().for_each(|field| field.shift(from));
            bits += likelihood(&read);
            let mut group = Field::new(&BLOCK, Span::new(from, from + width), Value::Group);
            group.children = read;
            said.extend(Block::new(group.clone(), 0, 0, false).values());
            fields.append(&mut group.children);
        }
        let blocks = bytes.len() / width;
        let more = said.len().saturating_sub(SHOWN);
        said.truncate(SHOWN);
        let mut said = Message::clauses(said)?;
        if more > 0 {
            said = message!("{said}; and {more} more", said = said, more = more);
        }
        let reason = match problems(&fields).len() {
            0 if bits > 0 => message!("the values are such as these registers hold"),
            0 => message!("the length fits, but the values are unusual for these registers"),
            1 => message!("the length fits, but one of the values is not allowed"),
            wrong => message!("the length fits, but {n} of the values are not allowed", n = wrong),
        };
        let unknown = match of.len() {
            1 => {
                message!("nothing but length and values tells that they are of {thing}", thing = one_of(&of))
            }
            _ => message!("the bytes do not tell the register: {things}", things = one_of(&of)),
        };
        Some(Likely { kind: self.kind(), said, fields, reason, unknown, blocks, bits })
    }
}

/// So many blocks are in a sentence.
const SHOWN: usize = 3;

/// How much values look like what their fields hold, in bits of chance.
pub fn likelihood(fields: &[Field]) -> i32 {
    /// What must not be.
    const WRONG: i32 = 8;
    let of_leaf = |leaf: &Field| match leaf.value {
        Value::Number { raw, width } => number(leaf.spec, raw, width),
        Value::Bytes if leaf.span.len() > 1 => -2,
        Value::Missing { .. } => -WRONG,
        _ => 0,
    };
    let values: i32 = leaves(fields).into_iter().map(of_leaf).sum();
    values - WRONG * problems(fields).len() as i32
}

fn number(spec: &'static Spec, raw: u64, width: usize) -> i32 {
    /// Of those that could be and have no name.
    const NAMELESS: i32 = 8;
    /// So much at most speaks for bits that are 0.
    const RESERVED: u32 = 3;
    if spec.format == Format::Float {
        return float(raw, width);
    }
    if !spec.bits.is_empty() {
        let of_part = |part: &Bits| {
            let value = part.of(raw);
            let flag = part.count == 1 && part.names.is_empty();
            match part.name(value) {
                _ if part.reserved && value == 0 => part.count.min(RESERVED) as i32,
                _ if part.reserved => -NAMELESS,
                _ if flag => -(value as i32),
                Some(_) if value == 0 => 1,
                Some(_) => part.count as i32 - (part.names.len() as u32).next_power_of_two().ilog2() as i32,
                None if part.names.is_empty() => 0,
                None => -NAMELESS,
            }
        };
        // Zeros are everywhere.
        if raw == 0 {
            let nameless = spec.bits.iter().any(|part| !part.names.is_empty() && part.name(0).is_none());
            return if nameless { -NAMELESS } else { 1 };
        }
        let named = spec.bits.iter().any(|part| part.name(part.of(raw)).is_some());
        let flags = spec.bits.iter().filter(|part| part.count == 1 && part.of(raw) == 1).count();
        // Where something has a name and no limit is violated, all is as it mostly is.
        let usual = if named && flags == 0 { RESERVED as i32 } else { 0 };
        return usual + spec.bits.iter().map(of_part).sum::<i32>();
    }
    match (spec.names.is_empty(), spec.name(raw)) {
        // Zeros are everywhere.
        (false, Some(_)) if raw == 0 => 1,
        (false, Some(_)) => NAMELESS / 2,
        (false, None) if spec.only_named => -NAMELESS,
        (false, None) => -NAMELESS / 2,
        _ => 0,
    }
}

/// Measured values are mostly between a thousandth and a million.
fn float(raw: u64, width: usize) -> i32 {
    let (bits, usual) = if width == 4 { (23, 117..147) } else { (52, 1013..1043) };
    let exponent = raw >> bits & if width == 4 { 0xFF } else { 0x7FF };
    let few_digits = raw.trailing_zeros() as i32 / 8;
    let size = if width == 4 { 3 } else { 6 };
    match exponent {
        0 if raw == 0 => 1,
        exponent if usual.contains(&exponent) => size + few_digits.min(2),
        0 | 0xFF if width == 4 => -2 * size,
        0 | 0x7FF => -2 * size,
        _ => -size,
    }
}

static BLOCK: Spec = Spec::new("block", "Block").note("Registers whose addresses are not known.");

impl Block {
    /// "82.4724, good", without a name.
    fn values(&self) -> Option<Message> {
        match (self.value(), self.status()) {
            (Some(value), Some(status)) => {
                message!("{value}, {status}", value = value, status = status).into()
            }
            (value, status) => value.or(status),
        }
    }
}

/// "Universal channel, Maths channel or Relay".
fn one_of(names: &[&'static str]) -> Message {
    let mut named = names.iter().map(|name| Message::term(name));
    let last = named.next_back().unwrap_or(message!("nothing"));
    let before = Message::list(named);
    match before {
        Some(before) => message!("{before} or {last}", before = before, last = last),
        None => message!("{name}", name = Argument::Message(last)),
    }
}
