//! Function 6: write a single register. The response repeats the request, so that the two cannot
//! be told apart by their bytes.

use super::read_holding_registers::HOLDING_REGISTERS;
use super::registers::WriteSingle;
use super::{Kind, Length};
use crate::field::{Direction, Spec};

pub static REQUEST: Kind = Kind {
    function: 6,
    direction: Direction::Request,
    spec: Spec::new("write_single_register_request", "Write single register")
        .note("Writes one register: 16 bits. A 32-bit value needs function 16, or 101 on a KEB.")
        .source(SOURCE),
    length: Length::Fixed(5),
    serial_only: false,
    new: || WriteSingle::of(&HOLDING_REGISTERS, Direction::Request),
};

pub static RESPONSE: Kind = Kind {
    function: 6,
    direction: Direction::Response,
    spec: Spec::new("write_single_register_response", "Write single register")
        .note("Repeats the request once the register is written.")
        .source(SOURCE),
    length: Length::Fixed(5),
    serial_only: false,
    new: || WriteSingle::of(&HOLDING_REGISTERS, Direction::Response),
};

const SOURCE: &str = "Modbus application protocol V1.1b3, 6.6";
