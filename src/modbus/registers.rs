//! The shapes that the functions over registers share. Which registers they mean, how wide one is
//! and how many fit is in a [`Table`].

use super::{Access, Body, Server};
use crate::field::{Argument, Direction, Format, Message, Role, Severity, Spec, hex_value};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

/// One of the tables that a server keeps its registers in, and the words for it.
#[derive(Debug, PartialEq)]
pub struct Table {
    /// "holding register" and "holding registers".
    pub one: &'static str,
    pub many: &'static str,
    /// Bytes of one register's value.
    pub width: usize,
    pub start: Spec,
    /// How many can be read at once.
    pub read_quantity: Spec,
    /// How many can be written at once.
    pub write_quantity: Spec,
    pub byte_count: Spec,
    pub values: Spec,
    pub value: Spec,
}

impl Table {
    /// A table of 16-bit registers as the standard has them; `digit` is that of the 4xxxx notation.
    pub const fn standard(one: &'static str, many: &'static str, digit: char) -> Self {
        Self {
            one,
            many,
            width: 2,
            start: Spec::new("start", "Starting address")
                .short("Start")
                .role(Role::Address)
                .format(Format::Reference(digit))
                .note("The first register, counted from 0. Manuals that count from 1 call it one more."),
            read_quantity: QUANTITY
                .limits(1, 125)
                .note("How many registers are to be read. More than 125 do not fit into the response."),
            write_quantity: QUANTITY
                .limits(1, 123)
                .note("How many registers are written. More than 123 do not fit into the request."),
            byte_count: BYTE_COUNT
                .limits(2, 250)
                .note("How many bytes of values follow: two for each register."),
            values: VALUES,
            value: Spec::new("value", "Register")
                .format(Format::Register)
                .note("A register's 16 bits, high byte first."),
        }
    }

    /// "3 holding registers".
    fn amount(&self, count: usize) -> Message {
        let noun = if count == 1 { self.one } else { self.many };
        message!("{count} {registers}", count = count, registers = Argument::Term(noun))
    }

    /// An address in the notation of the table: `200` or `2000h`.
    fn address(&self, address: u16) -> String {
        match self.start.format {
            Format::HexAddress => hex_value(address.into(), 2),
            _ => address.to_string(),
        }
    }

    /// "200 to 202", or "200" where it is one.
    fn range(&self, start: u16, count: usize) -> Message {
        let last = usize::from(start) + count.max(1) - 1;
        match u16::try_from(last) {
            Ok(last) if last != start => {
                message!("{from} to {to}", from = self.address(start), to = self.address(last))
            }
            _ => message!("{from}", from = self.address(start)),
        }
    }

    /// Values in a sentence: the first few, in the notation of the table.
    fn listed(&self, values: &[u32]) -> String {
        const SHOWN: usize = 6;
        let shown = values.iter().take(SHOWN).map(|value| match self.start.format {
            Format::HexAddress => hex_value(u64::from(*value), self.width),
            _ => value.to_string(),
        });
        let mut text = shown.collect::<Vec<_>>().join(", ");
        if values.len() > SHOWN {
            text.push_str(", …");
        }
        text
    }

    fn walk_value(&self, w: &mut dyn Walker, spec: &'static Spec, value: &mut u32) -> Walk {
        let mut raw = u64::from(*value);
        let walk = w.number(spec, self.width, &mut raw);
        // At most four bytes wide, so it fits.
        *value = raw as u32;
        walk
    }

    /// Says so where `count` registers from `start` go past the last address.
    fn check_end(&'static self, w: &mut dyn Walker, quantity: &'static Spec, start: u16, count: usize) {
        if usize::from(start) + count > 0x1_0000 {
            w.remark(
                quantity,
                Severity::Error,
                "address-overflow",
                message!(
                    "{count} registers from {start} go past the last address, 65535",
                    count = count,
                    start = start
                ),
            );
        }
    }
}

const QUANTITY: Spec = Spec::new("quantity", "Quantity").role(Role::Count);
const BYTE_COUNT: Spec = Spec::new("byte_count", "Byte count").short("Bytes").role(Role::Count);
const VALUES: Spec = Spec::new("values", "Values");

/// Asks for registers: starting address (2 bytes), quantity (2 bytes).
pub struct ReadRequest {
    pub table: &'static Table,
    pub start: u16,
    pub quantity: u16,
}

impl ReadRequest {
    pub fn of(table: &'static Table) -> Box<dyn Body> {
        Box::new(Self { table, start: 0, quantity: 1 })
    }
}

impl Telegram for ReadRequest {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        w.u16(&self.table.start, &mut self.start)?;
        w.u16(&self.table.read_quantity, &mut self.quantity)?;
        self.table.check_end(w, &self.table.read_quantity, self.start, self.quantity.into());
        Ok(())
    }
}

impl Body for ReadRequest {
    fn meaning(&self, who: Server) -> Message {
        message!(
            "ask {who} for {registers} from {start}",
            who = who.name(),
            registers = self.table.amount(self.quantity.into()),
            start = self.table.address(self.start)
        )
    }

    fn access(&self) -> Option<Access<'_>> {
        let start = Some(self.start);
        Some(Access { table: self.table, write: false, start, count: self.quantity.into(), values: &[] })
    }
}

/// Answers with registers: byte count (1 byte), then the values.
pub struct ReadResponse {
    pub table: &'static Table,
    /// From the request, where it is known.
    pub start: Option<u16>,
    pub values: Vec<u32>,
}

impl ReadResponse {
    pub fn of(table: &'static Table) -> Box<dyn Body> {
        Box::new(Self { table, start: None, values: Vec::new() })
    }
}

impl Telegram for ReadResponse {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        let table = self.table;
        let count = w.announce(&table.byte_count, 1, self.values.len(), table.width)?;
        w.list(&table.values, &mut self.values, count, self.start.map(u64::from), |w, value| {
            table.walk_value(w, &table.value, value)
        })
    }
}

impl Body for ReadResponse {
    fn meaning(&self, who: Server) -> Message {
        match self.start {
            _ if self.values.is_empty() => {
                message!("{who} answers without values", who = who.name())
            }
            Some(start) => message!(
                "{who} answers: {registers} {range} = {values}",
                who = who.name(),
                registers =
                    Argument::Term(if self.values.len() == 1 { self.table.one } else { self.table.many }),
                range = self.table.range(start, self.values.len()),
                values = self.table.listed(&self.values)
            ),
            None => message!(
                "{who} answers with {registers}: {values}",
                who = who.name(),
                registers = self.table.amount(self.values.len()),
                values = self.table.listed(&self.values)
            ),
        }
    }

    fn access(&self) -> Option<Access<'_>> {
        Some(Access {
            table: self.table,
            write: false,
            start: self.start,
            count: self.values.len(),
            values: &self.values,
        })
    }

    fn answer(&mut self, request: &Access<'_>) {
        self.start = request.start;
    }
}

/// Writes one register: address (2 bytes), value; the response repeats the request.
pub struct WriteSingle {
    pub table: &'static Table,
    pub direction: Direction,
    pub address: u16,
    pub value: [u32; 1],
}

impl WriteSingle {
    pub fn of(table: &'static Table, direction: Direction) -> Box<dyn Body> {
        Box::new(Self { table, direction, address: 0, value: [0] })
    }
}

impl Telegram for WriteSingle {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        w.u16(&self.table.start, &mut self.address)?;
        self.table.walk_value(w, &self.table.value, &mut self.value[0])
    }
}

impl Body for WriteSingle {
    fn meaning(&self, who: Server) -> Message {
        let who = who.name();
        let register = Argument::Term(self.table.one);
        let address = self.table.address(self.address);
        let value = self.table.listed(&self.value);
        match self.direction {
            Direction::Request => message!(
                "write {value} to {register} {address} of {who}",
                value = value,
                register = register,
                address = address,
                who = who
            ),
            Direction::Response => message!(
                "{who} confirms: {register} {address} written with {value}",
                value = value,
                register = register,
                address = address,
                who = who
            ),
        }
    }

    fn access(&self) -> Option<Access<'_>> {
        let start = Some(self.address);
        Some(Access { table: self.table, write: true, start, count: 1, values: &self.value })
    }
}

/// Writes registers: starting address (2), quantity (2), byte count (1), then the values.
pub struct WriteRequest {
    pub table: &'static Table,
    pub start: u16,
    pub values: Vec<u32>,
}

impl WriteRequest {
    pub fn of(table: &'static Table) -> Box<dyn Body> {
        Box::new(Self { table, start: 0, values: vec![0] })
    }
}

impl Telegram for WriteRequest {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        let table = self.table;
        w.u16(&table.start, &mut self.start)?;
        let quantity = w.announce(&table.write_quantity, 2, self.values.len(), 1)?;
        table.check_end(w, &table.write_quantity, self.start, quantity);
        w.derived(&table.byte_count, 1, Some((quantity * table.width) as u64))?;
        w.list(&table.values, &mut self.values, quantity, Some(self.start.into()), |w, value| {
            table.walk_value(w, &table.value, value)
        })
    }
}

impl Body for WriteRequest {
    fn meaning(&self, who: Server) -> Message {
        message!(
            "write {registers} from {start} of {who}: {values}",
            who = who.name(),
            registers = self.table.amount(self.values.len()),
            start = self.table.address(self.start),
            values = self.table.listed(&self.values)
        )
    }

    fn access(&self) -> Option<Access<'_>> {
        Some(Access {
            table: self.table,
            write: true,
            start: Some(self.start),
            count: self.values.len(),
            values: &self.values,
        })
    }
}

/// Confirms that registers were written: starting address (2), quantity (2).
pub struct WriteResponse {
    pub table: &'static Table,
    pub start: u16,
    pub quantity: u16,
}

impl WriteResponse {
    pub fn of(table: &'static Table) -> Box<dyn Body> {
        Box::new(Self { table, start: 0, quantity: 1 })
    }
}

impl Telegram for WriteResponse {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        w.u16(&self.table.start, &mut self.start)?;
        w.u16(&self.table.write_quantity, &mut self.quantity)?;
        self.table.check_end(w, &self.table.write_quantity, self.start, self.quantity.into());
        Ok(())
    }
}

impl Body for WriteResponse {
    fn meaning(&self, who: Server) -> Message {
        message!(
            "{who} confirms: {registers} written from {start}",
            who = who.name(),
            registers = self.table.amount(self.quantity.into()),
            start = self.table.address(self.start)
        )
    }

    fn access(&self) -> Option<Access<'_>> {
        let start = Some(self.start);
        Some(Access { table: self.table, write: true, start, count: self.quantity.into(), values: &[] })
    }
}
