//! Modbus protocol data units: function code and data, without address and check.
//!
//! One file for each function code; [`KINDS`] lists them. A function code needs its file, its two
//! lines in [`KINDS`] and a vector in `tests/vectors`.
//!
//! Source: Modbus application protocol V1.1b3, sections 4 to 7; numbers are big-endian (4.2).

mod bare;
mod choice;
mod coils;
mod diagnostics;
mod encapsulated_interface;
mod exception;
mod file_records;
mod get_comm_event_counter;
mod get_comm_event_log;
pub mod keb;
mod length;
mod mask_write_register;
mod read_coils;
mod read_discrete_inputs;
mod read_exception_status;
mod read_fifo_queue;
mod read_file_record;
mod read_holding_registers;
mod read_input_registers;
mod read_write_multiple_registers;
mod registers;
mod report_server_id;
mod unknown;
mod write_file_record;
mod write_multiple_coils;
mod write_multiple_registers;
mod write_single_coil;
mod write_single_register;

use bare::Bare;
use choice::Choice;
pub use length::Length;
pub use registers::{Layout, Table};

use crate::field::{Direction, Message, Name, Role, Severity, Spec, problems};
use crate::message;
use crate::walk::{self, Deviations, Telegram, Walk, Walker};

/// Every telegram that a function code has, requests before responses.
pub static KINDS: &[&Kind] = &[
    &read_coils::REQUEST,
    &read_coils::RESPONSE,
    &read_discrete_inputs::REQUEST,
    &read_discrete_inputs::RESPONSE,
    &read_holding_registers::REQUEST,
    &read_holding_registers::RESPONSE,
    &read_input_registers::REQUEST,
    &read_input_registers::RESPONSE,
    &write_single_coil::REQUEST,
    &write_single_coil::RESPONSE,
    &write_single_register::REQUEST,
    &write_single_register::RESPONSE,
    &read_exception_status::REQUEST,
    &read_exception_status::RESPONSE,
    &diagnostics::REQUEST,
    &diagnostics::RESPONSE,
    &get_comm_event_counter::REQUEST,
    &get_comm_event_counter::RESPONSE,
    &get_comm_event_log::REQUEST,
    &get_comm_event_log::RESPONSE,
    &write_multiple_coils::REQUEST,
    &write_multiple_coils::RESPONSE,
    &write_multiple_registers::REQUEST,
    &write_multiple_registers::RESPONSE,
    &report_server_id::REQUEST,
    &report_server_id::RESPONSE,
    &read_file_record::REQUEST,
    &read_file_record::RESPONSE,
    &write_file_record::REQUEST,
    &write_file_record::RESPONSE,
    &mask_write_register::REQUEST,
    &mask_write_register::RESPONSE,
    &read_write_multiple_registers::REQUEST,
    &read_write_multiple_registers::RESPONSE,
    &read_fifo_queue::REQUEST,
    &read_fifo_queue::RESPONSE,
    &encapsulated_interface::REQUEST,
    &encapsulated_interface::RESPONSE,
    &keb::read_long_registers::REQUEST,
    &keb::read_long_registers::RESPONSE,
    &keb::write_long_registers::REQUEST,
    &keb::write_long_registers::RESPONSE,
];

/// The kinds that stand for many function codes: whatever is not in [`KINDS`].
pub static OTHER_KINDS: &[&Kind] = &[&exception::RESPONSE, &unknown::REQUEST, &unknown::RESPONSE];

/// Telegrams as the standard and the manuals lay them out.
pub static STANDARD: Dialect = Dialect {
    key: "standard",
    label: "as in the manual",
    note: "Every telegram as its manual or the standard describes it.",
    kinds: &[],
};

/// The dialects that a device may speak, the standard first.
pub static DIALECTS: &[&Dialect] = &[
    &STANDARD,
    &keb::dialects::NUMBER_FIRST,
    &keb::dialects::NUMBER_8,
    &keb::dialects::NO_BYTE_COUNT,
    &keb::dialects::WORD_SWAP,
];

/// The bit that a server sets in the function code to refuse a request.
pub const EXCEPTION: u8 = 0x80;

/// Why a server can refuse, by code.
pub fn exceptions() -> &'static [Name] {
    exception::CODE.names
}

/// The most bytes a PDU can have (section 4.1: 256 of a serial frame less address and check).
pub const LONGEST_PDU: usize = 253;

/// One telegram of one function code, in one direction.
#[derive(Debug)]
pub struct Kind {
    pub function: u8,
    pub direction: Direction,
    /// What the telegram is called, and where it is described.
    pub spec: Spec,
    pub length: Length,
    /// Only units on a serial line know it: over TCP nobody does.
    pub serial_only: bool,
    /// An empty body of this kind.
    pub new: fn() -> Box<dyn Body>,
}

impl Kind {
    /// A PDU of this kind with nothing filled in.
    pub fn pdu(&'static self, dialect: &'static Dialect) -> Pdu {
        Pdu {
            function: self.function,
            direction: self.direction,
            dialect,
            kind: self,
            body: (self.new)(),
            asked: None,
        }
    }
}

/// Telegrams that some devices lay out in a way of their own.
#[derive(Debug)]
pub struct Dialect {
    /// Stable word of settings and exports.
    pub key: &'static str,
    pub label: &'static str,
    pub note: &'static str,
    /// What takes the place of the kinds of the same function code in [`KINDS`].
    pub kinds: &'static [&'static Kind],
}

/// What a function code's telegram can say beyond its fields.
pub trait Body: Telegram {
    /// The telegram in one sentence; `who` is the server.
    fn meaning(&self, who: Server) -> Message;

    /// The registers or coils it is about, for exports, devices and pairing.
    fn access(&self) -> Option<Access<'_>> {
        None
    }

    /// Whether the request is for nothing without an answer: it changes nothing in the server.
    fn only_reads(&self) -> bool {
        self.access().is_some_and(|access| !access.write)
    }

    /// The code of a refusal.
    fn exception(&self) -> Option<u8> {
        None
    }

    /// Takes from the request what a response does not repeat, before the response is read.
    fn answer(&mut self, _request: &Access<'_>) {}

    /// Makes an empty response one that a healthy server would give, with zeros for what it reads.
    fn reply(&mut self, _request: &Access<'_>) {}
}

/// Whom a request is for and a response is from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Server {
    Unit(u8),
    /// A PDU by itself does not say which.
    Unsaid,
    /// Every unit on the line listens, none answers.
    All,
}

impl Server {
    /// Its number on the line.
    pub const fn unit(self) -> Option<u8> {
        match self {
            Self::Unit(unit) => Some(unit),
            Self::Unsaid => None,
            Self::All => Some(0),
        }
    }

    /// "unit 5".
    pub fn name(self) -> Message {
        match self {
            Self::Unit(unit) => message!("unit {unit}", unit = unit),
            Self::Unsaid => message!("the server"),
            Self::All => message!("all units"),
        }
    }
}

/// The registers or coils that a telegram reads or writes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Access<'a> {
    /// Where they are; [`Table::holds_switches`] tells coils from registers.
    pub table: &'static Table,
    pub write: bool,
    /// Zero-based; a read response does not carry it.
    pub start: Option<u16>,
    /// A response with coils carries whole bytes: where its request is not known, up to seven of
    /// them may be more than were asked for.
    pub count: usize,
    /// Empty where the telegram carries no values. Of coils they are 0 and 1.
    pub values: &'a [u32],
    /// What is to be read as well, first register and number: function 23 writes, then reads.
    pub reads: Option<(u16, usize)>,
}

impl<'a> Access<'a> {
    pub fn read(table: &'static Table, start: Option<u16>, count: usize, values: &'a [u32]) -> Self {
        Self { table, write: false, start, count, values, reads: None }
    }

    pub fn write(table: &'static Table, start: u16, count: usize, values: &'a [u32]) -> Self {
        Self { table, write: true, start: Some(start), count, values, reads: None }
    }

    /// What a response to it answers with: the first one and how many.
    pub fn asked(&self) -> Option<(u16, usize)> {
        self.reads.or_else(|| Some((self.start?, self.count)))
    }
}

/// A PDU: the function code and what belongs to it.
pub struct Pdu {
    /// As on the wire, with the exception bit.
    pub function: u8,
    pub direction: Direction,
    pub dialect: &'static Dialect,
    pub kind: &'static Kind,
    pub body: Box<dyn Body>,
    /// What the request was to write, where this is its response: first one, number, values.
    asked: Option<(Option<u16>, usize, Vec<u32>)>,
}

impl Pdu {
    /// The kind that a PDU with `function` on the wire has.
    pub fn kind(function: u8, direction: Direction, dialect: &'static Dialect) -> &'static Kind {
        let mut known = dialect.kinds.iter().chain(KINDS);
        let listed = known.find(|kind| kind.function == function && kind.direction == direction);
        match (listed, direction) {
            (Some(kind), _) => kind,
            (None, Direction::Request) => &unknown::REQUEST,
            (None, Direction::Response) if function & EXCEPTION != 0 => &exception::RESPONSE,
            (None, Direction::Response) => &unknown::RESPONSE,
        }
    }

    /// The request to read `count` registers; `long` for KEB's of 32 bits.
    pub fn reading(start: u16, count: u16, long: bool) -> Self {
        let kind = if long { &keb::read_long_registers::REQUEST } else { &read_holding_registers::REQUEST };
        let table = if long { &keb::LONG_REGISTERS } else { &read_holding_registers::HOLDING_REGISTERS };
        let body = Box::new(registers::ReadRequest { table, start, quantity: count });
        Self { body, ..kind.pdu(&STANDARD) }
    }

    /// The request to write registers; `long` for KEB's of 32 bits.
    pub fn writing(start: u16, values: Vec<u32>, long: bool) -> Self {
        let kind =
            if long { &keb::write_long_registers::REQUEST } else { &write_multiple_registers::REQUEST };
        let table = if long { &keb::LONG_REGISTERS } else { &read_holding_registers::HOLDING_REGISTERS };
        let body = Box::new(registers::WriteRequest { table, start, values });
        Self { body, ..kind.pdu(&STANDARD) }
    }

    /// Takes from the request what a response does not repeat, before the response is read.
    pub fn answer(&mut self, request: &Self) {
        let Some(access) = request.body.access() else { return };
        self.body.answer(&access);
        self.asked = access.write.then(|| (access.start, access.count, access.values.to_vec()));
    }

    /// The response that a healthy server would give, with zeros for what it reads; `None` if that is
    /// more than a PDU can hold.
    pub fn reply(&mut self) -> Option<Self> {
        /// Function code and byte count.
        const AROUND: usize = 2;
        let reads = self.body.access().filter(|access| !access.write || access.reads.is_some());
        if let Some((access, (_, count))) = reads.and_then(|access| Some((access, access.asked()?))) {
            let bytes =
                if access.table.holds_switches() { count.div_ceil(8) } else { count * access.table.width };
            if bytes + AROUND > LONGEST_PDU {
                return None;
            }
        }
        let mut reply = Self::expect(self.function, Direction::Response, self.dialect);
        reply.answer(self);
        // Most responses that read nothing repeat the request, or its beginning.
        let bytes = walk::write(self, &Deviations::default());
        let fields = walk::read(&mut reply, &bytes).fields;
        if problems(&fields).iter().any(|problem| problem.code != "unexpected-bytes") {
            reply = Self::expect(self.function, Direction::Response, self.dialect);
            reply.answer(self);
        }
        if let Some(access) = self.body.access() {
            reply.body.reply(&access);
        }
        Some(reply)
    }

    /// The response of a server that refuses it.
    pub fn refusal(&self, code: u8) -> Self {
        let mut refusal = Self::expect(self.function | EXCEPTION, Direction::Response, self.dialect);
        refusal.body = Box::new(exception::Exception { code });
        refusal
    }

    /// Whether it is of the function for a single register.
    pub fn is_single(&self) -> bool {
        self.function == write_single_register::REQUEST.function
    }

    /// Says so where a response confirms something else than was to be written.
    fn check_asked(&self, w: &mut dyn Walker) {
        let (Some((start, count, values)), Some(done)) = (&self.asked, self.body.access()) else { return };
        let same_values = done.values.is_empty() || done.values == values;
        if done.write && (done.start, done.count, same_values) != (*start, *count, true) {
            w.remark(
                &FUNCTION,
                Severity::Warning,
                "not-as-asked",
                message!("this does not confirm what the request was to write"),
            );
        }
    }

    /// An empty PDU to read a telegram of `function` into.
    pub fn expect(function: u8, direction: Direction, dialect: &'static Dialect) -> Self {
        Self { function, ..Self::kind(function, direction, dialect).pdu(dialect) }
    }
}

impl Telegram for Pdu {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        let (direction, dialect) = (self.direction, self.dialect);
        let mut function = self.function;
        w.choose(&FUNCTION, 1, &mut function, &|function| {
            // One byte wide, so it fits.
            &Self::kind(function as u8, direction, dialect).spec
        })?;
        if function != self.function {
            *self = Self::expect(function, direction, dialect);
        }
        self.body.walk(w)?;
        self.check_asked(w);
        Ok(())
    }
}

static FUNCTION: Spec = Spec::new("function", "Function code")
    .short("Function")
    .role(Role::Function)
    .note("The requested operation. A server that rejects it sends it back with 80h added.")
    .source("Modbus application protocol V1.1b3, 4.1");
