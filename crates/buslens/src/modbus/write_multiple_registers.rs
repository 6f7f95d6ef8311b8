//! Function 16 (10h): write multiple registers.

use super::read_holding_registers::HOLDING_REGISTERS;
use super::registers::{WriteRequest, WriteResponse};
use super::{Kind, Length};
use crate::field::{Direction, Spec};

pub static REQUEST: Kind = Kind {
    function: 16,
    direction: Direction::Request,
    spec: Spec::new("write_multiple_registers_request", "Write multiple registers")
        .note("Writes up to 123 registers that follow each other.")
        .source(SOURCE),
    length: Length::Counted { at: 5, unit: 2 },
    serial_only: false,
    new: || WriteRequest::of(&HOLDING_REGISTERS),
};

pub static RESPONSE: Kind = Kind {
    function: 16,
    direction: Direction::Response,
    spec: Spec::new("write_multiple_registers_response", "Write multiple registers")
        .note("Repeats address and quantity once the registers are written.")
        .source(SOURCE),
    length: Length::Fixed(5),
    serial_only: false,
    new: || WriteResponse::of(&HOLDING_REGISTERS),
};

const SOURCE: &str = "Modbus application protocol V1.1b3, 6.12";
