//! Reading registers and parameters by a device's table.

use super::{Access, Area, Content, Mapping, Parameter, Part, Profile, Settings, address_text, keb_f5};
use crate::field::{
    Argument, Field, Format, Message, Numbering, Order, Problem, Role, Span, Spec, Value, hex_value,
};
use crate::message;
use crate::walk::{self, Telegram, Walk, Walker};

/// Registers as a telegram asks for them, gives them or writes them.
#[derive(Clone, Copy, Debug)]
pub struct Registers<'a> {
    /// Zero-based.
    pub start: u16,
    pub count: usize,
    /// Bytes of each.
    pub width: usize,
    /// What the client wants of them: [`Access::Read`] or [`Access::Write`].
    pub access: Access,
    /// Their bytes, where the telegram has them.
    pub values: Option<&'a [u8]>,
    /// Where their bytes stand in the telegram, or else what names the registers.
    pub span: Span,
}

/// Process data words of a telegram.
#[derive(Clone, Copy, Debug)]
pub struct Process<'a> {
    /// From the master, for the inverter.
    pub output: bool,
    pub bytes: &'a [u8],
    pub span: Span,
    pub order: Order,
}

/// What a device's table says about a telegram.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Said {
    pub blocks: Vec<Block>,
    /// What is wrong with the telegram as a whole.
    pub problems: Vec<Problem>,
}

/// A block of registers, or a parameter, of which the telegram holds all or a part.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// Spans are those of the telegram. Without children or value where the telegram has no values.
    pub field: Field,
    /// The addresses that the telegram has of it.
    pub from: u16,
    pub to: u16,
    /// The manual writes them in hex.
    hex: bool,
    /// The maker's short name for it: `Sy.51`.
    pub id: &'static str,
    /// What only this telegram's addresses tell: parameter set, mapping entry.
    pub note: Option<Message>,
}

impl Said {
    /// All problems, those of the blocks behind those of the whole.
    pub fn problems(&self) -> impl Iterator<Item = &Problem> {
        let of_blocks =
            self.blocks.iter().flat_map(|block| crate::field::problems(std::slice::from_ref(&block.field)));
        self.problems.iter().chain(of_blocks)
    }

    /// The first few blocks in a sentence: "universal channel 6 = 123.456, good". Blocks of a kind
    /// that are only asked for are said together: "universal channel 1 to universal channel 40".
    pub fn sentence(&self) -> Option<Message> {
        const SHOWN: usize = 3;
        let alike = |one: &Block, other: &Block| {
            std::ptr::eq(one.field.spec, other.field.spec) && one.is_only_named() && other.is_only_named()
        };
        let runs: Vec<&[Block]> = self.blocks.chunk_by(alike).collect();
        let said = Message::clauses(runs.iter().take(SHOWN).filter_map(|run| match run {
            [first, .., last] => Some(message!("{from} to {to}", from = first.label(), to = last.label())),
            [only] => Some(only.sentence()),
            [] => None,
        }));
        match runs.len().checked_sub(SHOWN) {
            None | Some(0) => said,
            Some(more) => said.map(|said| message!("{said}; and {more} more", said = said, more = more)),
        }
    }
}

impl Block {
    /// The telegram has no values of it.
    fn is_only_named(&self) -> bool {
        self.field.value == Value::Group && self.field.children.is_empty()
    }

    /// "Status word (Sy.51)", "Universal channel 6".
    pub fn label(&self) -> Message {
        match self.id {
            "" => self.field.label(),
            id => message!("{label} ({id})", label = self.field.label(), id = id.to_owned()),
        }
    }

    fn sentence(&self) -> Message {
        let label = self.label();
        let numbers = self.leaves().filter(|leaf| leaf.spec.role != Role::Status).count();
        match (self.value(), self.status()) {
            (Some(value), Some(status)) if numbers == 1 => {
                message!("{label} = {value}, {status}", label = label, value = value, status = status)
            }
            (Some(value), None) if numbers == 1 => {
                message!("{label} = {value}", label = label, value = value)
            }
            (Some(value), Some(status)) => {
                message!("{label}: {value}, {status}", label = label, value = value, status = status)
            }
            (Some(value), None) => message!("{label}: {value}", label = label, value = value),
            (None, Some(status)) => message!("{label}: {status}", label = label, status = status),
            (None, None) => label,
        }
    }

    /// Its addresses: `215 to 217`, in hex where the manual writes them so.
    pub fn registers(&self) -> String {
        let shown = |address: u16| address_text(address, self.hex);
        if self.from == self.to {
            shown(self.from)
        } else {
            format!("{} to {}", shown(self.from), shown(self.to))
        }
    }

    /// The values that are no status, as text.
    pub fn value(&self) -> Option<Message> {
        self.told(|role| !matches!(role, Role::Status | Role::Unknown))
    }

    /// What the block says about the value.
    pub fn status(&self) -> Option<Message> {
        self.told(|role| role == Role::Status)
    }

    /// The leaves of some roles one behind the other, with their names where there are several.
    fn told(&self, role: fn(Role) -> bool) -> Option<Message> {
        let leaves: Vec<(&Field, Message)> = self
            .leaves()
            .filter(|leaf| role(leaf.spec.role))
            .filter_map(|leaf| shown(leaf).map(|value| (leaf, value)))
            .collect();
        let several = leaves.len() > 1;
        Message::list(leaves.into_iter().map(|(leaf, value)| match leaf.value {
            Value::Number { .. } | Value::Text(_) if several => {
                message!("{label} {value}", label = leaf.label(), value = value)
            }
            _ => value,
        }))
    }

    fn leaves(&self) -> impl Iterator<Item = &Field> {
        crate::field::leaves(std::slice::from_ref(&self.field)).into_iter()
    }
}

/// A leaf's value as a sentence has it: by name or by parts where it has some.
fn shown(leaf: &Field) -> Option<Message> {
    match &leaf.value {
        Value::Number { raw, .. } if leaf.spec.name(*raw).is_some() || !leaf.spec.bits.is_empty() => {
            leaf.meaning()
        }
        Value::Number { .. } if leaf.spec.format == Format::DayMonthYear => leaf.meaning(),
        Value::Selector { chosen, .. } => Some(Message::term(chosen.label)),
        Value::Group | Value::Bytes | Value::Missing { .. } => None,
        _ => Some(message!("{value}", value = leaf.value_text())),
    }
}

impl Profile {
    /// What the table says about `registers`.
    pub fn registers(&'static self, registers: &Registers<'_>, settings: &Settings) -> Said {
        let mut said = Said::default();
        if let Some(most) = self.most_registers.filter(|most| registers.count > *most) {
            said.problems.push(Problem::error(
                "too-many-for-device",
                registers.span,
                message!(
                    "{count} registers at once; the device takes at most {most}",
                    count = registers.count,
                    most = most
                ),
            ));
        }
        let mapping = settings.mapping(registers.access);
        let mapped = self.area(registers.start).is_some_and(|area| matches!(area.content, Content::Mapped));
        if mapped && registers.count > MOST_MAPPED {
            said.problems.push(Problem::error(
                "too-many-for-device",
                registers.span,
                message!(
                    "{count} registers at once; a mapping list has at most {most}",
                    count = registers.count,
                    most = MOST_MAPPED
                ),
            ));
        }
        // What goes past the last address is nothing that a table could know.
        let count = registers.count.min(usize::from(u16::MAX - registers.start) + 1).min(MOST_SHOWN);
        let mut done = 0;
        while done < count {
            let address = registers.start + done as u16;
            let here = Here { registers, address, left: count - done, hex: self.hex_addresses };
            let block = self.block(&here, mapping);
            done += usize::from(block.to - block.from) + 1;
            said.blocks.push(block);
        }
        said
    }

    /// What the table says about the parameter at `index`, with the value's bytes if there are some.
    pub fn parameter(
        &'static self,
        index: u16,
        subindex: u8,
        access: Access,
        value: Option<(&[u8], Order)>,
        span: Span,
    ) -> Said {
        // No number has more bytes.
        let value = value.filter(|(bytes, _)| bytes.len() <= 8);
        let big_endian = value.map(|(bytes, order)| Order::Big.bytes(order.number(bytes), bytes.len()));
        let width = value.map_or(0, |(bytes, _)| bytes.len());
        let registers =
            Registers { start: index, count: 1, width, access, values: big_endian.as_deref(), span };
        let here = Here { registers: &registers, address: index, left: 1, hex: self.hex_addresses };
        let mut block = match self.named(index, Some(subindex)) {
            Some(parameter) => {
                let mut block = here.single(&parameter.spec, None, parameter.access);
                block.id = parameter.id;
                if let Some(length) = parameter.length.filter(|length| value.is_some() && width < *length) {
                    block.field.problems.push(too_short(&parameter.spec, length, width, span));
                }
                block
            }
            None => self.block(&here, &Mapping::default()),
        };
        // The subindex is a set mask only where the table does not use it otherwise.
        if keb_f5::INVERTER_INDICES.contains(&index)
            && self.named(index, Some(subindex)).is_none_or(keb_f5::has_sets)
        {
            let sets = set_names(subindex);
            block.field.problems.extend(here.sets_must_agree(subindex));
            block.note = Some(match block.note {
                Some(note) => message!("{note}; {sets}", note = note, sets = sets),
                None => sets,
            });
        }
        Said { blocks: vec![block], problems: Vec::new() }
    }

    /// What the mapping says about process data.
    pub fn process(&'static self, process: &Process<'_>, settings: &Settings) -> Said {
        let mapped = if process.output { &settings.process_output } else { &settings.process_input };
        let mut said = Said::default();
        let mut words = process.bytes.chunks_exact(2).zip(0_u16..).peekable();
        while let Some((word, at)) = words.next() {
            let offset = process.span.from + 2 * usize::from(at);
            let Some(entry) = mapped.get(usize::from(at)) else { break };
            let mut bytes = word.to_vec();
            // A 32-bit value takes two words: its second entry is empty.
            let long = mapped.get(usize::from(at) + 1).is_some_and(|next| next.index == 0);
            if long && let Some((more, _)) = words.next_if(|_| true) {
                bytes.extend_from_slice(more);
            }
            let span = Span::new(offset, offset + bytes.len());
            let access = if process.output { Access::Write } else { Access::Read };
            let parameter =
                self.parameter(entry.index, entry.sets, access, Some((&bytes, process.order)), span);
            said.blocks.extend(parameter.blocks);
        }
        said
    }

    /// The parameter at an address.
    fn named(&'static self, address: u16, subindex: Option<u8>) -> Option<&'static Parameter> {
        self.parameters().find(|parameter| {
            parameter.address == address && (parameter.subindex.is_none() || parameter.subindex == subindex)
        })
    }

    fn block(&'static self, here: &Here<'_>, mapping: &Mapping) -> Block {
        if let Some(parameter) = self.named(here.address, None) {
            let mut block = here.whole(&parameter.spec, None, parameter.access, parameter.length);
            block.id = parameter.id;
            return block;
        }
        let Some(area) = self.area(here.address) else {
            let next = self.areas.iter().map(|area| area.from).filter(|from| *from > here.address).min();
            return here.unknown(next);
        };
        match area.content {
            Content::Value if area.length.is_some() => {
                let number =
                    area.first.map(|first| Numbering::At(first + u64::from(here.address - area.from)));
                here.whole(&area.spec, number, area.access, area.length)
            }
            Content::Value => here.values(area, &[], &area.spec),
            Content::Parts(parts) => here.values(area, parts, &area.spec),
            Content::Telegram { read, write } => {
                let new = if here.registers.access == Access::Write { write } else { read };
                here.telegram(area, new.filter(|_| here.address == area.from).map(|new| new()))
            }
            Content::Mapped => self.mapped(here, area, mapping),
        }
    }

    /// A register that stands for a parameter by the user's mapping list.
    fn mapped(&'static self, here: &Here<'_>, area: &'static Area, mapping: &Mapping) -> Block {
        let number = Some(Numbering::At(here.address.into()));
        let Some((n, entry, second)) = mapping.entry(here.address) else {
            let mut block = here.single(&area.spec, number, area.access);
            block.note = Some(match mapping.entries.len() {
                0 => message!("which parameter it is, only the mapping list tells"),
                known => {
                    message!("the mapping list, as far as it is known, has {known} entries", known = known)
                }
            });
            return block;
        };
        let address = 0x2000_u16.wrapping_add(entry.parameter());
        let words = if entry.words() == 2 && here.registers.width == 2 { 2 } else { 1 };
        let spec = match self.named(address, None) {
            Some(parameter) => &parameter.spec,
            None => self.areas.iter().find(|area| area.from == 0x2000).map_or(&area.spec, |area| &area.spec),
        };
        let named = self.named(address, None);
        let number = named.is_none().then_some(Numbering::At(entry.parameter().into()));
        let mut block = if words == 2 && (second || here.left < 2) {
            let mut block = here.cut(spec, 1);
            block.field.problems.push(Problem::error(
                "half-value",
                here.registers.span,
                message!(
                    "mapping entry {n} is a 32-bit value over two registers: one alone cannot be read or written",
                    n = n
                ),
            ));
            block
        } else {
            here.numbers(spec, number, area.access, &[(spec, words)], words)
        };
        block.id = named.map_or("", |parameter| parameter.id);
        block.note = Some(message!(
            "mapping entry {n}: parameter {parameter}, {sets}",
            n = n,
            parameter = hex_value(entry.parameter().into(), 2),
            sets = set_names(entry.sets())
        ));
        block.field.problems.extend(here.sets_must_agree(entry.sets()));
        block
    }
}

/// A value of which a telegram has only a part.
fn too_short(spec: &'static Spec, length: usize, width: usize, span: Span) -> Problem {
    Problem::warning(
        "value-too-short",
        span,
        message!(
            "{name} has {length}; the telegram carries {width} of them",
            name = Argument::Term(spec.label),
            length = Message::bytes(length),
            width = width
        ),
    )
}

/// "sets 0, 2" of a set mask.
fn set_names(mask: u8) -> Message {
    let sets: Vec<String> =
        (0..8).filter(|set| mask >> set & 1 == 1).map(|set: u32| set.to_string()).collect();
    match sets.len() {
        0 => message!("the set chosen by Fr.09"),
        1 => message!("set {set}", set = sets.join("")),
        _ => message!("sets {sets}", sets = sets.join(", ")),
    }
}

/// The registers from an address on.
struct Here<'a> {
    registers: &'a Registers<'a>,
    address: u16,
    /// How many registers there are from here on.
    left: usize,
    hex: bool,
}

impl Here<'_> {
    /// What there is to say where several sets are asked for at once. An answer shows that they agree.
    fn sets_must_agree(&self, sets: u8) -> Option<Problem> {
        let asked = self.registers.access == Access::Read && self.registers.values.is_none();
        (asked && sets.count_ones() > 1).then(|| {
            Problem::warning(
                "sets-must-agree",
                self.registers.span,
                message!("this reads several sets at once: that works only while they hold the same value"),
            )
        })
    }

    /// Where the next `count` registers stand in the telegram, with their bytes.
    fn bytes(&self, count: usize) -> (Span, Option<&[u8]>) {
        let Registers { span, values, width, start, .. } = *self.registers;
        let Some(values) = values else { return (span, None) };
        let from = usize::from(self.address - start) * width;
        let inside = Span::new(from.min(values.len()), (from + count * width).min(values.len()));
        (Span::new(span.from + inside.from, span.from + inside.to), Some(inside.of(values)))
    }

    fn of(&self, field: Field, count: usize) -> Block {
        let to = self.address.saturating_add(count.saturating_sub(1) as u16);
        Block { field, from: self.address, to, hex: self.hex, id: "", note: None }
    }

    /// A number of one register.
    fn single(&self, spec: &'static Spec, number: Option<Numbering>, access: Access) -> Block {
        self.numbers(spec, number, access, &[(spec, 1)], 1)
    }

    /// A number of one register, of which a narrow register has only a part.
    fn whole(
        &self,
        spec: &'static Spec,
        number: Option<Numbering>,
        access: Access,
        length: Option<usize>,
    ) -> Block {
        let Registers { span, width, .. } = *self.registers;
        let Some(length) = length.filter(|length| width < *length) else {
            return self.single(spec, number, access);
        };
        let mut block = self.cut(spec, 1);
        block.field.number = number;
        self.check_access(&mut block.field, access);
        block.field.problems.push(too_short(spec, length, width, span));
        block
    }

    /// The area's block at this address, with the parts that the telegram has of it.
    fn values(&self, area: &'static Area, parts: &'static [Part], spec: &'static Spec) -> Block {
        let (index, inside) =
            ((self.address - area.from) / area.stride, (self.address - area.from) % area.stride);
        let number = area.first.map(|first| Numbering::At(first + u64::from(index)));
        let there = usize::from(area.stride - inside).min(self.left);
        let whole = [Part::new(spec, area.stride)];
        let parts: &[Part] = if parts.is_empty() { &whole } else { parts };
        let mut wanted = Vec::new();
        let mut at = 0;
        for part in parts {
            let (from, to) = (
                at.max(usize::from(inside)),
                (at + usize::from(part.registers)).min(usize::from(inside) + there),
            );
            at += usize::from(part.registers);
            if from >= to {
                continue;
            }
            wanted.push((part, to - from));
        }
        let widths: Vec<_> =
            wanted.iter().map(|(part, registers)| (part.spec(self.registers.access), *registers)).collect();
        let mut block = self.numbers(spec, number, area.access, &widths, there);
        let Some((at, (part, _))) =
            wanted.iter().enumerate().find(|(_, (part, registers))| *registers < usize::from(part.registers))
        else {
            return block;
        };
        // A piece of a number is no number.
        let whole = &mut block.field;
        let cut = if whole.children.is_empty() { Some(&mut *whole) } else { whole.children.get_mut(at) };
        if let Some(cut) = cut.filter(|cut| cut.value != Value::Group) {
            cut.value = Value::Bytes;
        }
        whole.problems.push(Problem::warning(
            "block-cut",
            whole.span,
            message!(
                "{label} is cut: with {there} of its {stride} registers, {part} is not whole",
                label = whole.label(),
                there = there,
                stride = area.stride,
                part = Argument::Term(part.spec.label)
            ),
        ));
        block
    }

    /// Numbers of so many registers each; `count` registers together.
    fn numbers(
        &self,
        spec: &'static Spec,
        number: Option<Numbering>,
        access: Access,
        parts: &[(&'static Spec, usize)],
        count: usize,
    ) -> Block {
        let (span, bytes) = self.bytes(count);
        let mut field = Field::new(spec, span, Value::Group);
        if let Some(bytes) = bytes {
            let mut numbers =
                Numbers::new(parts.iter().map(|(spec, registers)| (*spec, registers * self.registers.width)));
            let mut fields = walk::read(&mut numbers, bytes).fields;
            fields.iter_mut().for_each(|field| field.shift(span.from));
            match <[Field; 1]>::try_from(fields) {
                Ok([only]) if std::ptr::eq(only.spec, spec) => field = only,
                Ok([only]) => field.children = vec![only],
                Err(fields) => field.children = fields,
            }
        }
        field.number = number;
        self.check_access(&mut field, access);
        self.of(field, count)
    }

    /// A part of a number.
    fn cut(&self, spec: &'static Spec, count: usize) -> Block {
        let (span, bytes) = self.bytes(count);
        self.of(Field::new(spec, span, if bytes.is_some() { Value::Bytes } else { Value::Group }), count)
    }

    /// A telegram within the registers.
    fn telegram(&self, area: &'static Area, telegram: Option<Box<dyn Telegram>>) -> Block {
        let count = usize::from(area.last() - self.address + 1).min(self.left);
        let (span, bytes) = self.bytes(count);
        let mut field = Field::new(&area.spec, span, Value::Group);
        match (telegram, bytes) {
            (Some(mut telegram), Some(bytes)) => {
                field.children = walk::read(telegram.as_mut(), bytes).fields;
                field.children.iter_mut().for_each(|child| child.shift(span.from));
            }
            (None, Some(_)) => field.value = Value::Bytes,
            (_, None) => {}
        }
        self.check_access(&mut field, area.access);
        self.of(field, count)
    }

    /// Registers that the manual does not name, up to the next that it does.
    fn unknown(&self, next: Option<u16>) -> Block {
        let count = next.map_or(self.left, |next| usize::from(next - self.address).min(self.left));
        let mut block = self.cut(if self.hex { &NOT_IN_HEX_MANUAL } else { &NOT_IN_MANUAL }, count);
        block.field.number = Some(Numbering::At(self.address.into()));
        block.field.problems.push(Problem::warning(
            "not-in-manual",
            block.field.span,
            message!("the manual has nothing at {addresses}", addresses = block.registers()),
        ));
        block
    }

    fn check_access(&self, field: &mut Field, access: Access) {
        let (code, template): (_, fn(Message) -> Message) = match (access, self.registers.access) {
            (Access::Read, Access::Write) => {
                ("read-only", |label| message!("{label} can only be read", label = label))
            }
            (Access::Write, Access::Read) => {
                ("write-only", |label| message!("{label} can only be written", label = label))
            }
            _ => return,
        };
        field.problems.push(Problem::error(code, self.registers.span, template(field.label())));
    }
}

/// Numbers one behind the other, as a telegram.
pub struct Numbers {
    parts: Vec<(&'static Spec, usize)>,
    pub values: Vec<u64>,
}

impl Numbers {
    /// Zeros; each part has its width in bytes. What is wider than a number can be is left out.
    pub fn new(parts: impl Iterator<Item = (&'static Spec, usize)>) -> Self {
        let parts: Vec<_> = parts.filter(|(_, width)| (1..=8).contains(width)).collect();
        Self { values: vec![0; parts.len()], parts }
    }
}

impl Telegram for Numbers {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        self.parts
            .iter()
            .zip(&mut self.values)
            .try_for_each(|((spec, width), value)| w.number(spec, *width, value))
    }
}

/// More registers than a telegram can have are not worth a block each.
const MOST_SHOWN: usize = 256;

/// Entries of a mapping list, each a word.
const MOST_MAPPED: usize = 100;

static NOT_IN_MANUAL: Spec = UNKNOWN;
static NOT_IN_HEX_MANUAL: Spec = UNKNOWN.hex_numbers();

const UNKNOWN: Spec = Spec::new("not_in_manual", "Register")
    .role(Role::Unknown)
    .note("The device's manual does not name this address.");
