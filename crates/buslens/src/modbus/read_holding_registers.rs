//! Function 3: read holding registers.

use super::registers::{ReadRequest, ReadResponse, Table};
use super::{Kind, Length};
use crate::field::{Direction, Spec};

pub static REQUEST: Kind = Kind {
    function: 3,
    direction: Direction::Request,
    spec: Spec::new("read_holding_registers_request", "Read holding registers")
        .note("Asks for up to 125 registers that follow each other.")
        .source(SOURCE),
    length: Length::Fixed(5),
    serial_only: false,
    new: || ReadRequest::of(&HOLDING_REGISTERS),
};

pub static RESPONSE: Kind = Kind {
    function: 3,
    direction: Direction::Response,
    spec: Spec::new("read_holding_registers_response", "Read holding registers")
        .note("The registers asked for, in their order. Which ones they are only the request says.")
        .source(SOURCE),
    length: Length::Counted { at: 1, unit: 2 },
    serial_only: false,
    new: || ReadResponse::of(&HOLDING_REGISTERS),
};

/// Registers that can be read and written.
pub static HOLDING_REGISTERS: Table = Table::standard("holding register", "holding registers", '4');

const SOURCE: &str = "Modbus application protocol V1.1b3, 6.3";
