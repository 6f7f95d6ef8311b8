//! The shapes that the functions over registers share. Which registers they mean, how wide one is
//! and how many fit is in a [`Table`].

use super::{Access, Body, Server};
use crate::field::{Argument, Direction, Format, Message, Role, Severity, Spec, hex_value, push_number};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

/// One of the tables that a server keeps its registers in, and the words for it.
#[derive(Debug, PartialEq)]
pub struct Table {
    /// "holding register" and "holding registers".
    pub one: &'static str,
    pub many: &'static str,
    /// Bytes of one item of the values: a register, or eight coils.
    pub width: usize,
    pub layout: Layout,
    pub start: Spec,
    /// How many can be read at once.
    pub read_quantity: Spec,
    /// How many can be written at once.
    pub write_quantity: Spec,
    pub byte_count: Spec,
    pub values: Spec,
    pub value: Spec,
}

/// In which order and width a telegram gives its numbers.
#[derive(Debug, PartialEq)]
pub struct Layout {
    /// The quantity comes before the starting address.
    pub quantity_first: bool,
    /// Bytes of the quantity.
    pub quantity_width: usize,
    /// The response to a read begins with a byte count.
    pub byte_count: bool,
}

impl Layout {
    /// As the standard lays out functions 3 and 16.
    pub const STANDARD: Self = Self { quantity_first: false, quantity_width: 2, byte_count: true };
}

impl Table {
    /// A table of 16-bit registers as the standard has them; `digit` is that of the 4xxxx notation.
    pub const fn standard(one: &'static str, many: &'static str, digit: char) -> Self {
        Self {
            one,
            many,
            width: 2,
            layout: Layout::STANDARD,
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

    /// Whether it holds coils or discrete inputs, on or off, and not numbers.
    pub fn holds_switches(&self) -> bool {
        self.value.format == Format::Switches
    }

    /// "3 holding registers".
    pub(super) fn amount(&self, count: usize) -> Message {
        let noun = if count == 1 { self.one } else { self.many };
        message!("{count} {registers}", count = count, registers = Argument::Term(noun))
    }

    /// An address in the notation of the table: `200` or `2000h`.
    pub(super) fn address(&self, address: u16) -> Argument {
        match self.start.format {
            Format::HexAddress => hex_value(address.into(), 2).into(),
            _ => address.into(),
        }
    }

    /// "200 to 202", or "200" where it is one.
    pub(super) fn range(&self, start: u16, count: usize) -> Message {
        let last = usize::from(start) + count.max(1) - 1;
        match u16::try_from(last) {
            Ok(last) if last != start => {
                message!("{from} to {to}", from = self.address(start), to = self.address(last))
            }
            _ => message!("{from}", from = self.address(start)),
        }
    }

    /// Values in a sentence: the first few, in the notation of the table.
    pub(super) fn listed(&self, values: &[u32]) -> String {
        const SHOWN: usize = 6;
        let format = if self.start.format == Format::HexAddress { Format::Hex } else { Format::Decimal };
        let mut text = String::new();
        for (place, value) in values.iter().enumerate() {
            if place > 0 {
                text.push_str(", ");
            }
            if place == SHOWN {
                text.push('…');
                break;
            }
            push_number(&mut text, (*value).into(), self.width, format);
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

    /// Starting address and quantity, in the order of the layout.
    fn walk_range<T>(
        &'static self,
        w: &mut dyn Walker,
        start: &mut u16,
        quantity: impl FnOnce(&mut dyn Walker) -> Walk<T>,
    ) -> Walk<T> {
        if self.layout.quantity_first {
            let count = quantity(w)?;
            w.u16(&self.start, start)?;
            return Ok(count);
        }
        w.u16(&self.start, start)?;
        quantity(w)
    }

    fn walk_quantity(&self, w: &mut dyn Walker, spec: &'static Spec, quantity: &mut u16) -> Walk {
        let mut raw = u64::from(*quantity);
        let walk = w.number(spec, self.layout.quantity_width, &mut raw);
        // At most two bytes wide, so it fits.
        *quantity = raw as u16;
        walk
    }

    /// Says so where `count` registers from `start` go past the last address.
    pub(super) fn check_end(
        &'static self,
        w: &mut dyn Walker,
        quantity: &'static Spec,
        start: u16,
        count: usize,
    ) {
        if usize::from(start) + count > 0x1_0000 {
            w.remark(
                quantity,
                Severity::Error,
                "address-overflow",
                message!(
                    "{registers} from {start} go past the last address, 65535",
                    registers = self.amount(count),
                    start = start
                ),
            );
        }
    }

    /// Says so where a response has not as many values as its request asks for.
    fn check_asked(&'static self, w: &mut dyn Walker, asked: Option<(u16, usize)>, count: usize) {
        if let Some((_, asked)) = asked
            && count != asked
        {
            w.remark(
                &self.values,
                Severity::Warning,
                "not-as-asked",
                message!(
                    "the request asks for {registers}, the response has {count}",
                    registers = self.amount(asked),
                    count = count
                ),
            );
        }
    }
}

pub(super) const QUANTITY: Spec = Spec::new("quantity", "Quantity").role(Role::Count);
pub(super) const BYTE_COUNT: Spec = Spec::new("byte_count", "Byte count").short("Bytes").role(Role::Count);
pub(super) const VALUES: Spec = Spec::new("values", "Values");

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
        let table = self.table;
        table.walk_range(w, &mut self.start, |w| {
            table.walk_quantity(w, &table.read_quantity, &mut self.quantity)
        })?;
        table.check_end(w, &table.read_quantity, self.start, self.quantity.into());
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
        Some(Access::read(self.table, Some(self.start), self.quantity.into(), &[]))
    }
}

/// Answers with registers: byte count (1 byte), then the values.
pub struct ReadResponse {
    pub table: &'static Table,
    /// What the request asks for, where it is known: the first register, and how many.
    pub asked: Option<(u16, usize)>,
    pub values: Vec<u32>,
}

impl ReadResponse {
    fn start(&self) -> Option<u16> {
        self.asked.map(|(start, _)| start)
    }

    pub fn of(table: &'static Table) -> Box<dyn Body> {
        Box::new(Self { table, asked: None, values: Vec::new() })
    }
}

impl Telegram for ReadResponse {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        let (table, start) = (self.table, self.start());
        let count = if table.layout.byte_count {
            w.announce(&table.byte_count, 1, self.values.len(), table.width)?
        } else {
            // All that is left, where somebody knows how much that is.
            let left = w.ahead(0, &mut |_| Ok(()));
            left.map_or(self.values.len(), |left| (left as usize).div_ceil(table.width))
        };
        w.list(&table.values, &mut self.values, count, start.map(u64::from), |w, value| {
            table.walk_value(w, &table.value, value)
        })?;
        table.check_asked(w, self.asked, count);
        Ok(())
    }
}

impl Body for ReadResponse {
    fn meaning(&self, who: Server) -> Message {
        match self.start() {
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
        Some(Access::read(self.table, self.start(), self.values.len(), &self.values))
    }

    fn answer(&mut self, request: &Access<'_>) {
        self.asked = request.asked();
    }

    fn reply(&mut self, request: &Access<'_>) {
        self.values = vec![0; request.asked().map_or(0, |(_, count)| count)];
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
        Some(Access::write(self.table, self.address, 1, &self.value))
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
        let quantity = table.walk_range(w, &mut self.start, |w| {
            w.announce(&table.write_quantity, table.layout.quantity_width, self.values.len(), 1)
        })?;
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
        Some(Access::write(self.table, self.start, self.values.len(), &self.values))
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
        let table = self.table;
        table.walk_range(w, &mut self.start, |w| {
            table.walk_quantity(w, &table.write_quantity, &mut self.quantity)
        })?;
        table.check_end(w, &table.write_quantity, self.start, self.quantity.into());
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
        Some(Access::write(self.table, self.start, self.quantity.into(), &[]))
    }
}
