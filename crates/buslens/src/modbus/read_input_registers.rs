//! Function 4: read input registers.

use super::registers::{ReadRequest, ReadResponse, Table};
use super::{Kind, Length};
use crate::field::{Direction, Spec};

pub static REQUEST: Kind = Kind {
    function: 4,
    direction: Direction::Request,
    spec: Spec::new("read_input_registers_request", "Read input registers")
        .note("Asks for up to 125 read-only registers. Many devices give the same as for function 3.")
        .source(SOURCE),
    length: Length::Fixed(5),
    serial_only: false,
    new: || ReadRequest::of(&INPUT_REGISTERS),
};

pub static RESPONSE: Kind = Kind {
    function: 4,
    direction: Direction::Response,
    spec: Spec::new("read_input_registers_response", "Read input registers")
        .note("The registers asked for, in their order. Which ones they are only the request says.")
        .source(SOURCE),
    length: Length::Counted { at: 1, unit: 2 },
    serial_only: false,
    new: || ReadResponse::of(&INPUT_REGISTERS),
};

/// Registers that can only be read.
static INPUT_REGISTERS: Table = Table::standard("input register", "input registers", '3');

const SOURCE: &str = "Modbus application protocol V1.1b3, 6.4";
