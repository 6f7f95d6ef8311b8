//! The shapes that the functions over coils and discrete inputs share. One byte holds eight of them,
//! the lowest bit first; what the last byte has too many is 0.
//!
//! What they ask for is laid out as for registers: [`registers`](super::registers).

use super::registers::{BYTE_COUNT, Layout, QUANTITY, Table, VALUES};
use super::{Access, Body, Choice, Server};
use crate::field::{Argument, Direction, Format, Message, Name, Role, Severity, Spec, hex_value};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

/// A table of switches: `one` and `many` are the words for them, `label` that of a list's items,
/// `digit` that of the 4xxxx notation.
pub const fn table(one: &'static str, many: &'static str, label: &'static str, digit: char) -> Table {
    Table {
        one,
        many,
        width: 1,
        layout: Layout::STANDARD,
        start: Spec::new("start", "Starting address")
            .short("Start")
            .role(Role::Address)
            .format(Format::Reference(digit))
            .note("The first one, counted from 0. Manuals that count from 1 call it one more."),
        read_quantity: QUANTITY
            .limits(1, 2000)
            .note("How many are to be read. The standard allows 2000, in 250 bytes."),
        write_quantity: QUANTITY
            .limits(1, 1968)
            .note("How many are written. The standard allows 1968, in 246 bytes."),
        byte_count: BYTE_COUNT
            .limits(1, 250)
            .note("How many bytes follow: one for each eight, the last one filled up with zeros."),
        values: VALUES,
        value: Spec::new("value", label)
            .format(Format::Switches)
            .step(8)
            .note("Eight in a byte, the first one in the lowest bit: 1 is on, 0 is off."),
    }
}

/// Eight coils of a byte, the lowest bit first, each 0 or 1.
type Eight = [u32; 8];

/// `bytes` bytes of coils, of which the first `quantity` are meant, where that is known.
fn walk_coils(
    table: &'static Table,
    w: &mut dyn Walker,
    coils: &mut Vec<Eight>,
    bytes: usize,
    start: Option<u16>,
    quantity: Option<usize>,
) -> Walk {
    let mut left = quantity;
    w.list(&table.values, coils, bytes, start.map(u64::from), |w, eight| {
        let mut raw = eight.iter().rev().fold(0, |raw, coil| raw << 1 | u64::from(*coil));
        let walk = w.number(&table.value, 1, &mut raw);
        for (bit, coil) in eight.iter_mut().enumerate() {
            *coil = (raw >> bit & 1) as u32;
        }
        walk?;
        let used = left.map_or(8, |left| left.min(8));
        left = left.map(|left| left - used);
        if eight.iter().skip(used).any(|coil| *coil == 1) {
            w.remark(
                &table.value,
                Severity::Warning,
                "unused-bits",
                message!(
                    "only the lowest {used} of these 8 bits are meant; the others should be 0",
                    used = used
                ),
            );
        }
        Ok(())
    })
}

/// The coils that are meant.
fn meant(coils: &[Eight], quantity: Option<usize>) -> &[u32] {
    let all = coils.as_flattened();
    quantity.and_then(|quantity| all.get(..quantity)).unwrap_or(all)
}

/// "20, 22–24 on": which of `coils` are, numbered from the first one or by their distance from it.
fn state(first: Option<u16>, coils: &[u32]) -> Message {
    let sign = if first.is_some() { "" } else { "+" };
    let on = coils.iter().filter(|coil| **coil == 1).count();
    match coils.len() - on {
        0 if on == 1 => message!("on"),
        0 => message!("all on"),
        1 if on == 0 => message!("off"),
        _ if on == 0 => message!("all off"),
        _ => message!("{which} on", which = runs(sign, first.map_or(0, usize::from), coils)),
    }
}

/// "20, 22–24": the numbers of those that are 1, of which `values` begins with number `first`.
pub fn runs(sign: &str, first: usize, values: &[u32]) -> String {
    const SHOWN: usize = 6;
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for (number, _) in (first..).zip(values).filter(|(_, value)| **value == 1) {
        match runs.last_mut() {
            Some((_, last)) if *last + 1 == number => *last = number,
            _ => runs.push((number, number)),
        }
    }
    let mut texts: Vec<String> = runs
        .iter()
        .take(SHOWN)
        .map(|(from, to)| match to - from {
            0 => format!("{sign}{from}"),
            1 => format!("{sign}{from}, {sign}{to}"),
            _ => format!("{sign}{from}–{to}"),
        })
        .collect();
    if runs.len() > SHOWN {
        texts.push("…".to_owned());
    }
    texts.join(", ")
}

/// Answers with coils: byte count (1 byte), then the bytes. How many coils are meant only the request says.
pub struct ReadResponse {
    pub table: &'static Table,
    /// What the request asks for, where it is known: the first coil, and how many.
    pub asked: Option<(u16, usize)>,
    pub coils: Vec<Eight>,
}

impl ReadResponse {
    pub fn of(table: &'static Table) -> Box<dyn Body> {
        Box::new(Self { table, asked: None, coils: Vec::new() })
    }

    fn start(&self) -> Option<u16> {
        self.asked.map(|(start, _)| start)
    }

    fn meant(&self) -> &[u32] {
        meant(&self.coils, self.asked.map(|(_, quantity)| quantity))
    }
}

impl Telegram for ReadResponse {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        let (table, start) = (self.table, self.start());
        let bytes = w.announce(&table.byte_count, 1, self.coils.len(), 1)?;
        let quantity = self.asked.map(|(_, quantity)| quantity);
        if let Some(quantity) = quantity
            && quantity.div_ceil(8) != bytes
        {
            w.remark(
                &table.byte_count,
                Severity::Warning,
                "not-as-asked",
                message!(
                    "the request asks for {coils}, which need {bytes}",
                    coils = table.amount(quantity),
                    bytes = Message::bytes(quantity.div_ceil(8))
                ),
            );
        }
        walk_coils(table, w, &mut self.coils, bytes, start, quantity)
    }
}

impl Body for ReadResponse {
    fn meaning(&self, who: Server) -> Message {
        let (who, coils) = (who.name(), self.meant());
        let noun = Argument::Term(if coils.len() == 1 { self.table.one } else { self.table.many });
        let state = state(self.start(), coils);
        match self.start() {
            _ if coils.is_empty() => message!("{who} answers without values", who = who),
            Some(start) => message!(
                "{who} answers: {coils} {range}: {state}",
                who = who,
                coils = noun,
                range = self.table.range(start, coils.len()),
                state = state
            ),
            None => message!(
                "{who} answers with {bytes} of {coils}: {state}",
                who = who,
                bytes = Message::bytes(self.coils.len()),
                coils = noun,
                state = state
            ),
        }
    }

    fn access(&self) -> Option<Access<'_>> {
        let coils = self.meant();
        Some(Access::read(self.table, self.start(), coils.len(), coils))
    }

    fn answer(&mut self, request: &Access<'_>) {
        self.asked = request.asked();
    }

    fn reply(&mut self, request: &Access<'_>) {
        let count = request.asked().map_or(0, |(_, count)| count);
        self.coils = vec![Eight::default(); count.div_ceil(8)];
    }
}

/// Switches one coil: address (2 bytes), FF00h or 0000h (2 bytes); the response repeats the request.
pub struct WriteSingle {
    pub table: &'static Table,
    pub direction: Direction,
    pub address: u16,
    pub value: u16,
}

impl WriteSingle {
    pub fn of(table: &'static Table, direction: Direction) -> Box<dyn Body> {
        Box::new(Self { table, direction, address: 0, value: OFF })
    }
}

impl Telegram for WriteSingle {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        w.u16(&self.table.start, &mut self.address)?;
        SWITCH.walk(w, &mut self.value)
    }
}

impl Body for WriteSingle {
    fn meaning(&self, who: Server) -> Message {
        let who = who.name();
        let coil = Argument::Term(self.table.one);
        let address = self.table.address(self.address);
        let Some(state) = SWITCH.name(self.value) else {
            return message!(
                "{who}, {coil} {address}: {value} is neither on nor off",
                who = who,
                coil = coil,
                address = address,
                value = hex_value(self.value.into(), 2)
            );
        };
        let state = Argument::Term(state);
        match self.direction {
            Direction::Request => message!(
                "switch {coil} {address} of {who} {state}",
                coil = coil,
                address = address,
                who = who,
                state = state
            ),
            Direction::Response => message!(
                "{who} confirms: {coil} {address} switched {state}",
                who = who,
                coil = coil,
                address = address,
                state = state
            ),
        }
    }

    fn access(&self) -> Option<Access<'_>> {
        let values: &[u32] = match self.value {
            ON => &[1],
            OFF => &[0],
            _ => &[],
        };
        Some(Access::write(self.table, self.address, 1, values))
    }
}

/// Switches coils: starting address (2), quantity (2), byte count (1), then the bytes.
pub struct WriteRequest {
    pub table: &'static Table,
    pub start: u16,
    pub quantity: u16,
    pub coils: Vec<Eight>,
}

impl WriteRequest {
    pub fn of(table: &'static Table) -> Box<dyn Body> {
        Box::new(Self { table, start: 0, quantity: 1, coils: vec![[0; 8]] })
    }

    fn meant(&self) -> &[u32] {
        meant(&self.coils, Some(self.quantity.into()))
    }
}

impl Telegram for WriteRequest {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        let table = self.table;
        w.u16(&table.start, &mut self.start)?;
        w.u16(&table.write_quantity, &mut self.quantity)?;
        let quantity = usize::from(self.quantity);
        table.check_end(w, &table.write_quantity, self.start, quantity);
        let bytes = quantity.div_ceil(8);
        w.derived(&table.byte_count, 1, Some(bytes as u64))?;
        walk_coils(table, w, &mut self.coils, bytes, Some(self.start), Some(quantity))
    }
}

impl Body for WriteRequest {
    fn meaning(&self, who: Server) -> Message {
        let coils = self.meant();
        message!(
            "write {coils} from {start} of {who}: {state}",
            coils = self.table.amount(coils.len()),
            start = self.table.address(self.start),
            who = who.name(),
            state = state(Some(self.start), coils)
        )
    }

    fn access(&self) -> Option<Access<'_>> {
        let coils = self.meant();
        Some(Access::write(self.table, self.start, coils.len(), coils))
    }
}

const ON: u16 = 0xFF00;
const OFF: u16 = 0;

static SWITCH: Choice = Choice::new(
    Spec::new("value", "Value").format(Format::Hex).note("FF00h switches the coil on, 0000h off."),
    2,
    &[Name { value: OFF as u64, label: "off", note: "" }, Name { value: ON as u64, label: "on", note: "" }],
);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::{Field, problems};
    use crate::modbus::{Pdu, STANDARD};
    use crate::walk::read;

    fn response(bytes: &[u8], asked: Option<(u16, usize)>) -> (Pdu, Vec<Field>) {
        let mut pdu = Pdu::expect(1, Direction::Response, &STANDARD);
        if let Some((start, count)) = asked {
            pdu.body.answer(&Access::read(&crate::modbus::read_coils::COILS, Some(start), count, &[]));
        }
        let fields = read(&mut pdu, bytes).fields;
        (pdu, fields)
    }

    fn codes(fields: &[Field]) -> Vec<&'static str> {
        problems(fields).iter().map(|problem| problem.code).collect()
    }

    #[test]
    fn a_response_takes_its_numbers_from_the_request() {
        let (pdu, fields) = response(&[1, 3, 0xCD, 0x6B, 0x05], Some((19, 19)));
        assert_eq!(codes(&fields), [""; 0]);
        let labels: Vec<String> = fields[2].children.iter().map(|item| item.label().to_string()).collect();
        assert_eq!(labels, ["Coils 19 to 26", "Coils 27 to 34", "Coils 35 to 42"]);
        let access = pdu.body.access().unwrap();
        assert_eq!((access.start, access.count), (Some(19), 19));
        assert_eq!(access.values, [1, 0, 1, 1, 0, 0, 1, 1, 1, 1, 0, 1, 0, 1, 1, 0, 1, 0, 1]);
        assert!(access.table.holds_switches());
        let said = pdu.body.meaning(Server::Unit(17)).to_string();
        assert_eq!(said, "unit 17 answers: coils 19 to 37: 19, 21, 22, 25–28, 30, 32, 33, 35, … on");
    }

    #[test]
    fn bits_that_nobody_asked_for_are_noticed() {
        assert_eq!(codes(&response(&[1, 1, 0x15], Some((0, 4))).1), ["unused-bits"]);
        assert_eq!(codes(&response(&[1, 1, 0x15], Some((0, 5))).1), [""; 0]);
        assert_eq!(codes(&response(&[1, 1, 0x15], None).1), [""; 0]);
        assert_eq!(codes(&response(&[1, 2, 0x15, 0], Some((0, 8))).1), ["not-as-asked"]);
    }

    #[test]
    fn states_are_said_in_few_words() {
        let said = |first, coils: &[u32]| state(first, coils).to_string();
        assert_eq!(said(Some(7), &[1]), "on");
        assert_eq!(said(Some(7), &[0]), "off");
        assert_eq!(said(Some(7), &[0, 0]), "all off");
        assert_eq!(said(None, &[1, 1]), "all on");
        assert_eq!(said(None, &[1, 0, 1, 1, 0, 1, 1, 1]), "+0, +2, +3, +5–7 on");
    }

    #[test]
    fn the_form_numbers_coils_as_the_reader_does() {
        use crate::walk::{Deviations, form};
        let mut write = WriteRequest {
            table: &crate::modbus::read_coils::COILS,
            start: 16,
            quantity: 16,
            coils: vec![[0; 8]; 2],
        };
        let shown = form::form(&mut write, &Deviations::default());
        let form::Content::List { items } = &shown.entries[3].content else { panic!("no list") };
        let label = |item: usize| items[item][0].spec.numbered(items[item][0].number).to_string();
        assert_eq!([label(0), label(1)], ["Coils 16 to 23", "Coils 24 to 31"]);
    }
}
