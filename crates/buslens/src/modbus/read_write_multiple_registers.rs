//! Function 23 (17h): write registers, then read registers, in one go.

use super::read_holding_registers::HOLDING_REGISTERS;
use super::registers::{ReadRequest, ReadResponse, Table, WriteRequest};
use super::{Access, Body, Kind, Length, Server};
use crate::field::{Direction, Message, Spec};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

pub static REQUEST: Kind = Kind {
    function: 23,
    direction: Direction::Request,
    spec: Spec::new("read_write_multiple_registers_request", "Read/write multiple registers")
        .note("Writes up to 121 registers, then asks for up to 125. The two can be the same or others.")
        .source(SOURCE),
    length: Length::Counted { at: 9, unit: 2 },
    serial_only: false,
    new: || {
        Box::new(Request {
            read: ReadRequest { table: &READ, start: 0, quantity: 1 },
            write: WriteRequest { table: &WRITTEN, start: 0, values: vec![0] },
        })
    },
};

pub static RESPONSE: Kind = Kind {
    function: 23,
    direction: Direction::Response,
    spec: Spec::new("read_write_multiple_registers_response", "Read/write multiple registers")
        .note("The registers asked for, in their order. Which ones they are only the request says.")
        .source(SOURCE),
    length: Length::Counted { at: 1, unit: 2 },
    serial_only: false,
    new: || ReadResponse::of(&HOLDING_REGISTERS),
};

/// Read start (2 bytes), read quantity (2), write start (2), write quantity (2), byte count (1), values.
pub struct Request {
    pub read: ReadRequest,
    pub write: WriteRequest,
}

impl Telegram for Request {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        self.read.walk(w)?;
        self.write.walk(w)
    }
}

impl Body for Request {
    fn meaning(&self, who: Server) -> Message {
        message!(
            "{write}; then read {registers} from {start}",
            write = self.write.meaning(who),
            registers = HOLDING_REGISTERS.amount(self.read.quantity.into()),
            start = self.read.start
        )
    }

    fn access(&self) -> Option<Access<'_>> {
        let reads = Some((self.read.start, self.read.quantity.into()));
        self.write.access().map(|access| Access { table: &HOLDING_REGISTERS, reads, ..access })
    }
}

const BASE: Table = Table::standard("holding register", "holding registers", '4');

static READ: Table = Table {
    start: Spec { key: "read_start", short: "Read from", label: "Starting address to read", ..BASE.start },
    read_quantity: Spec {
        key: "read_quantity",
        short: "Read",
        label: "Quantity to read",
        ..BASE.read_quantity
    },
    ..BASE
};

static WRITTEN: Table = Table {
    start: Spec { key: "write_start", short: "Write from", label: "Starting address to write", ..BASE.start },
    write_quantity: Spec {
        key: "write_quantity",
        short: "Write",
        label: "Quantity to write",
        ..BASE.write_quantity
    }
    .limits(1, 121)
    .note("How many registers are written. More than 121 do not fit into the request."),
    ..BASE
};

const SOURCE: &str = "Modbus application protocol V1.1b3, 6.17";
