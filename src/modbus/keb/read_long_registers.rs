//! Function 100 (64h): read 32-bit registers.

use super::{LONG_REGISTERS, SOURCE};
use crate::field::{Direction, Spec};
use crate::modbus::registers::{ReadRequest, ReadResponse};
use crate::modbus::{Kind, Length};

pub static REQUEST: Kind = Kind {
    function: 100,
    direction: Direction::Request,
    spec: Spec::new("read_long_registers_request", "Read 32-bit registers (KEB)")
        .note("Asks for 32-bit values, such as the entries of a mapping list.")
        .source(SOURCE),
    length: Length::Fixed(5),
    new: || ReadRequest::of(&LONG_REGISTERS),
};

pub static RESPONSE: Kind = Kind {
    function: 100,
    direction: Direction::Response,
    spec: Spec::new("read_long_registers_response", "Read 32-bit registers (KEB)")
        .note("The values asked for, in their order.")
        .source(SOURCE),
    length: Length::Counted { at: 1, unit: 4 },
    new: || ReadResponse::of(&LONG_REGISTERS),
};
