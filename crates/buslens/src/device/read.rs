//! Reading registers and parameters by a device's table.

use super::{Access, Area, Content, Mapped, New, Parameter, Part, Profile, Settings, address_text};
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
    /// They are written by the service for a single register.
    pub single: bool,
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
    /// The parameter that its value stands for: "Status word (Sy.51)".
    pub stands_for: Option<Message>,
    /// What the manual says of it besides its note: other addresses, software versions.
    pub facts: Vec<Message>,
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
        match &self.stands_for {
            Some(parameter) => {
                message!("{said}: {parameter}", said = self.plain_sentence(), parameter = parameter.clone())
            }
            None => self.plain_sentence(),
        }
    }

    fn plain_sentence(&self) -> Message {
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
        // Switches are named one by one: where some are on, the others need no word.
        let off = |leaf: &Field| leaf.spec.flagged.is_some() && leaf.value.raw() == Some(0);
        let some_on = self.leaves().any(|leaf| leaf.spec.flagged.is_some() && !off(leaf));
        let leaves: Vec<(&Field, Message)> = self
            .leaves()
            .filter(|leaf| role(leaf.spec.role) && !(some_on && off(leaf)))
            .filter_map(|leaf| shown(leaf).map(|value| (leaf, value)))
            .collect();
        // A lone status that is not the block itself says what it is a status of.
        let alone = leaves.len() == 1
            && leaves.iter().any(|(leaf, _)| {
                leaf.spec.role == Role::Status && leaf.spec.only_named && leaf.spec != self.field.spec
            })
            && self.leaves().filter(|leaf| shown(leaf).is_some()).count() == 1;
        let several = leaves.len() > 1 || alone;
        Message::list(leaves.into_iter().map(|(leaf, value)| match leaf.value {
            _ if some_on && leaf.spec.flagged.is_some() => value,
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
        Value::Number { raw, .. } if leaf.spec.name(*raw).is_some_and(|name| name.label.is_empty()) => None,
        Value::Number { raw, .. }
            if leaf.spec.name(*raw).is_some()
                || leaf.spec.range(*raw).is_some()
                || !leaf.spec.bits.is_empty() =>
        {
            leaf.meaning()
        }
        Value::Text(text) => {
            let text = Argument::Text(text.trim_end_matches(' ').to_owned());
            Some(match leaf.meaning() {
                Some(told) => message!("“{text}” ({told})", text = text, told = told),
                None => message!("“{text}”", text = text),
            })
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
        if mapped && registers.width > 2 {
            let message = message!("the mapping lists serve the functions for 16 bits only: 3, 4, 6 and 16");
            said.problems.push(Problem::warning("not-mapped", registers.span, message));
        }
        // What goes past the last address is nothing that a table could know.
        let count = registers.count.min(usize::from(u16::MAX - registers.start) + 1).min(MOST_SHOWN);
        let mut done = 0;
        while done < count {
            let address = registers.start + done as u16;
            let here = Here { registers, address, left: count - done, hex: self.hex_addresses };
            let mut block = self.block(&here, settings);
            done += usize::from(block.to - block.from) + 1;
            // What is said of many registers alike is said once.
            let said_before = said.blocks.last().map_or(&[][..], |before| &before.field.problems);
            block.field.problems.retain(|problem| !said_before.contains(problem));
            said.blocks.push(block);
        }
        self.rules.iter().for_each(|rule| rule(self, registers, settings, &mut said));
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
        let registers = Registers {
            start: index,
            count: 1,
            width,
            access,
            single: false,
            values: big_endian.as_deref(),
            span,
        };
        let here = Here { registers: &registers, address: index, left: 1, hex: self.hex_addresses };
        let named = self.named(index, Some(subindex));
        let has_sets = self.has_sets(index, subindex);
        // A parameter that has one subindex only is meant, whatever the subindex.
        let only = || self.parameters().find(|it| it.address == index && it.subindex == Some(0));
        let mut block = match named.or_else(only) {
            Some(parameter) => {
                let mut block = here.single(&parameter.spec, None, parameter.access);
                here.fit(&mut block.field, &parameter.spec, parameter.length);
                self.dress(&mut block, parameter);
                block
            }
            None => self.block(&here, &Settings::default()),
        };
        block.note = has_sets.then(|| set_names(subindex));
        if has_sets {
            block.field.problems.extend(here.sets_must_agree(subindex));
        } else if named.is_none()
            && let Some(problem) = self.no_such_subindex(index, subindex, span)
        {
            block.field.problems.retain(|problem| problem.code != "not-listed");
            block.field.problems.push(problem);
        }
        Said { blocks: vec![block], problems: Vec::new() }
    }

    /// What is wrong with a subindex that an index of parts, or of one, does not have.
    fn no_such_subindex(&'static self, index: u16, subindex: u8, span: Span) -> Option<Problem> {
        let mut parts: Vec<u8> =
            self.parameters().filter(|it| it.address == index).filter_map(|it| it.subindex).collect();
        if parts.is_empty() && self.area(index).is_some_and(|area| area.is_between(index)) && subindex > 0 {
            parts.push(0);
        }
        let (first, last) = (*parts.iter().min()?, *parts.iter().max()?);
        let index = self.address(index);
        Some(Problem::warning(
            "no-such-subindex",
            span,
            if first == last {
                message!(
                    "{index} has subindex {first} only: the slave rejects {subindex} with error 6-5-0011h",
                    index = index,
                    first = first,
                    subindex = subindex
                )
            } else {
                message!(
                    "{index} has the subindices {first} to {last}: the slave rejects {subindex} with error 6-5-0011h",
                    index = index,
                    first = first,
                    last = last,
                    subindex = subindex
                )
            },
        ))
    }

    /// Says of a block what is known of its parameter besides its value.
    fn dress(&'static self, block: &mut Block, parameter: &'static Parameter) {
        block.id = parameter.id;
        let subindex = parameter.subindex.unwrap_or_default();
        if let Some(alias) = self.alias(parameter.address, subindex) {
            let address = |address: u16| hex_value(address.into(), 2);
            block.facts.extend(match (alias.new, alias.old) {
                (Some(new), Some(old)) => {
                    Some(message!("in COMBIVIS {new}, before {old}", new = address(new), old = address(old)))
                }
                (Some(only), None) | (None, Some(only)) => {
                    Some(message!("in COMBIVIS {address}", address = address(only)))
                }
                (None, None) => None,
            });
        }
        if !parameter.since.is_empty() {
            let since = parameter.since.to_owned();
            block.facts.push(message!("from software version {since} on", since = since));
        }
        if let (Some(refers), Some(raw)) = (parameter.spec.refers, block.field.value.raw()) {
            block.stands_for = refers(raw).and_then(|address| self.parameter_label(address));
        }
    }

    /// What the parameter at `address` is called.
    fn parameter_label(&'static self, address: u16) -> Option<Message> {
        let parameter = self.parameters().find(|it| it.address == address)?;
        Some(match parameter.id {
            "" => Message::term(parameter.spec.label),
            id => {
                message!("{label} ({id})", label = Argument::Term(parameter.spec.label), id = id.to_owned())
            }
        })
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
        // Words that are there, but of which nobody said what they carry.
        for (at, word) in process.bytes.chunks_exact(2).enumerate().skip(mapped.len()) {
            let offset = process.span.from + 2 * at;
            let raw = process.order.number(word);
            let mut field =
                Field::new(&UNKNOWN_WORD, Span::new(offset, offset + 2), Value::Number { raw, width: 2 });
            field.number = Some(Numbering::At(at as u64 + 1));
            let index = if process.output { 0x6001 } else { 0x6000 };
            let note = message!(
                "what it carries, only the process data description ({index}) tells",
                index = address_text(index, self.hex_addresses)
            );
            said.blocks
                .push(Block { note: Some(note), ..Block::new(field, index, index, self.hex_addresses) });
        }
        said
    }

    /// The parameter at an address.
    pub(super) fn named(&'static self, address: u16, subindex: Option<u8>) -> Option<&'static Parameter> {
        self.parameters().find(|parameter| {
            parameter.address == address && (parameter.subindex.is_none() || parameter.subindex == subindex)
        })
    }

    fn block(&'static self, here: &Here<'_>, settings: &Settings) -> Block {
        let area = self.area(here.address);
        if let Some(parameter) = self.named(here.address, None) {
            let mut block = here.whole(&parameter.spec, None, parameter.access, parameter.length);
            self.dress(&mut block, parameter);
            block.note = area.filter(|_| self.has_sets(here.address, 0)).map(|_| set_names(0));
            return block;
        }
        let Some(area) = area else {
            let next = self.areas.iter().map(|area| area.from).filter(|from| *from > here.address).min();
            return here.unknown(next);
        };
        if let Some(between) = area.between.filter(|_| area.is_between(here.address)) {
            let number = Some(Numbering::At(here.address.into()));
            let mut block = here.single(between.spec, number, Access::ReadWrite);
            block.field.problems.push(here.not_listed());
            return block;
        }
        let mut block = match area.content {
            Content::Value if area.length.is_some() => {
                let number =
                    area.first.map(|first| Numbering::At(first + u64::from(here.address - area.from)));
                here.whole(&area.spec, number, area.access, area.length)
            }
            Content::Value => here.values(area, &[], &area.spec),
            Content::Parts(parts) => here.values(area, parts, &area.spec),
            Content::Telegram { read, write } => here.telegram(self, area, (read, write), settings),
            Content::Mapped => return self.mapped(here, area, settings),
        };
        if area.listed {
            block.field.problems.push(here.not_listed());
        }
        if area.in_sets {
            block.note = Some(set_names(0));
        }
        if let (Some(refers), Some(raw)) = (area.spec.refers, block.field.value.raw()) {
            block.stands_for = refers(raw).and_then(|address| self.parameter_label(address));
        }
        block
    }

    /// A register that stands for a parameter by the user's mapping list.
    fn mapped(&'static self, here: &Here<'_>, area: &'static Area, settings: &Settings) -> Block {
        let number = Some(Numbering::At(here.address.into()));
        let mapping = settings.mapping(here.registers.access);
        if here.registers.width > 2 {
            return here.single(&area.spec, number, area.access);
        }
        let (n, entry, second) = match mapping.entry(here.address) {
            Mapped::Entry(n, entry, second) => (n, entry, second),
            nowhere => {
                let mut block = here.single(&area.spec, number, area.access);
                let message = match nowhere {
                    Mapped::Unknown(0) => {
                        block.note = Some(message!("which parameter it is, only the mapping list tells"));
                        return block;
                    }
                    Mapped::Before => message!(
                        "it lies before the mapping list, which begins at {start}",
                        start = self.address(mapping.start)
                    ),
                    Mapped::Unused(used) => message!(
                        "it lies behind the mapping list, of which {n} in use",
                        n = match used {
                            1 => message!("1 entry is"),
                            used => message!("{n} entries are", n = used),
                        }
                    ),
                    _ => message!(
                        "the mapping list, as far as it is known, has {n}",
                        n = match mapping.entries.len() {
                            1 => message!("1 entry"),
                            known => message!("{n} entries", n = known),
                        }
                    ),
                };
                block.field.problems.push(Problem::warning("not-mapped", here.registers.span, message));
                return block;
            }
        };
        let address = 0x2000_u16.wrapping_add(entry.parameter());
        let named = self.named(address, None);
        let words = if entry.words() == 2 && here.registers.width == 2 { 2 } else { 1 };
        let spec = match named {
            Some(parameter) => &parameter.spec,
            None => self.areas.iter().find(|area| area.from == 0x2000).map_or(&area.spec, |area| &area.spec),
        };
        let access = named.map_or(area.access, |parameter| parameter.access);
        let number = named.is_none().then_some(Numbering::At(entry.parameter().into()));
        // The entry behind one of 32 bits is its second half, and must be empty.
        let taken = words == 2 && mapping.entries.get(n + 1).is_some_and(|next| next.0 != 0);
        let mut block = if words == 2 && (second || taken || here.left < 2) {
            let mut block = here.cut(spec, 1);
            let message = match taken {
                true => message!(
                    "mapping entry {n} is a 32-bit value, but entry {next}, its second half, is not empty",
                    n = n,
                    next = n + 1
                ),
                false => message!(
                    "mapping entry {n} is a 32-bit value over two registers: one alone cannot be read or written",
                    n = n
                ),
            };
            block.field.problems.push(Problem::error("half-value", here.registers.span, message));
            here.check_access(&mut block.field, access);
            block
        } else {
            let mut block = here.numbers(spec, number, access, &[(spec, words)], words);
            let length = named.and_then(|parameter| parameter.length);
            if let Some(length) = length.filter(|length| 2 * words < *length) {
                block.field.problems.push(too_short(spec, length, 2 * words, here.registers.span));
            }
            block
        };
        if let Some(parameter) = named {
            self.dress(&mut block, parameter);
        }
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

impl Block {
    pub(super) fn new(field: Field, from: u16, to: u16, hex: bool) -> Self {
        Self { field, from, to, hex, id: "", note: None, stands_for: None, facts: Vec::new() }
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
        Block::new(field, self.address, to, self.hex)
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
            let mut block = self.single(spec, number, access);
            self.fit(&mut block.field, spec, length);
            return block;
        };
        let mut block = self.cut(spec, 1);
        block.field.number = number;
        self.check_access(&mut block.field, access);
        block.field.problems.push(too_short(spec, length, width, span));
        block
    }

    /// Takes the number of a field for one of `length` bytes, which may have come in more or in fewer.
    fn fit(&self, field: &mut Field, spec: &'static Spec, length: Option<usize>) {
        let (Some(length), Value::Number { raw, width }) = (length, field.value.clone()) else { return };
        let span = self.registers.span;
        if width < length {
            field.problems.push(too_short(spec, length, width, span));
            return;
        }
        let bits = 8 * length as u32;
        let high = raw.checked_shr(bits).unwrap_or_default();
        let ones = u64::MAX >> (64 - 8 * width) >> bits.min(63);
        let negative =
            spec.format == Format::Signed && width > length && high == ones && raw >> (bits - 1) & 1 == 1;
        if high == 0 || negative {
            field.value = Value::Number { raw: raw & u64::MAX >> (64 - bits), width: length };
            return;
        }
        field.problems.push(Problem::warning(
            "value-too-long",
            span,
            message!(
                "{name} has {length}; {raw} does not fit",
                name = Argument::Term(spec.label),
                length = Message::bytes(length),
                raw = hex_value(raw, width)
            ),
        ));
    }

    /// What there is to say of an address that the manual does not list.
    fn not_listed(&self) -> Problem {
        let address = address_text(self.address, self.hex);
        let message = message!("the manual lists nothing at {address}", address = address);
        Problem::warning("not-listed", self.registers.span, message)
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
        self.check_service(&mut block.field, area);
        let Some((at, (part, _))) =
            wanted.iter().enumerate().find(|(_, (part, registers))| *registers < usize::from(part.registers))
        else {
            let left_out = widths.len() < parts.len() && self.registers.access == Access::Write;
            if left_out && area.whole && !self.registers.single {
                let label = block.field.label();
                let message = message!(
                    "{label} is to be written whole: {count} registers from {from}",
                    label = label,
                    count = area.stride,
                    from = address_text(self.address - inside, self.hex)
                );
                let span = self.registers.span;
                block.field.problems.push(Problem::warning("block-not-whole", span, message));
            }
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

    /// A telegram within the registers. What is written is its own up to where the next thing begins.
    fn telegram(
        &self,
        profile: &'static Profile,
        area: &'static Area,
        (read, write): (Option<New>, Option<New>),
        settings: &Settings,
    ) -> Block {
        let written = self.registers.access == Access::Write;
        let next = profile.areas.iter().map(|area| area.from).filter(|from| *from > self.address).min();
        let end = if written { next } else { area.last().checked_add(1) };
        let count = end.map_or(self.left, |end| usize::from(end - self.address)).min(self.left);
        let (span, bytes) = self.bytes(count);
        let mut field = Field::new(&area.spec, span, Value::Group);
        let begins = self.address == area.from;
        let new = if written { write } else { read };
        match (new.filter(|_| begins || written), bytes) {
            (Some(new), Some(bytes)) => {
                field.children = walk::read(new(settings).as_mut(), bytes).fields;
                field.children.iter_mut().for_each(|child| child.shift(span.from));
            }
            (None, Some(_)) => field.value = Value::Bytes,
            (_, None) => {}
        }
        self.check_access(&mut field, area.access);
        self.check_service(&mut field, area);
        let mut block = self.of(field, count);
        if !begins {
            let label = Argument::Term(area.spec.label);
            let from = address_text(area.from, self.hex);
            let message = message!("{label} begins at {from}", label = label, from = from);
            if written {
                let span = self.registers.span;
                block.field.problems.push(Problem::warning("not-at-its-beginning", span, message));
            } else {
                block.note = Some(message);
            }
        }
        block
    }

    /// Says so where what is written needs the service for several registers.
    fn check_service(&self, field: &mut Field, area: &'static Area) {
        if area.together && self.registers.single && self.registers.access == Access::Write {
            let label = Argument::Term(area.spec.label);
            let message = message!("{label} can only be written with function 16", label = label);
            field.problems.push(Problem::error("function-16", self.registers.span, message));
        }
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
            (Access::Elsewhere, _) => ("not-reachable", |label| {
                message!(
                    "{label} cannot be reached over this bus, only at the diagnosis interface",
                    label = label
                )
            }),
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

static UNKNOWN_WORD: Spec = Spec::new("process_word", "Process data word")
    .format(Format::Register)
    .note("A word of process data whose description was not seen.");

static NOT_IN_MANUAL: Spec = UNKNOWN;
static NOT_IN_HEX_MANUAL: Spec = UNKNOWN.hex_numbers();

const UNKNOWN: Spec = Spec::new("not_in_manual", "Register")
    .role(Role::Unknown)
    .note("The device's manual does not name this address.");
