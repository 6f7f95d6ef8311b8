//! Function 101 (65h): write 32-bit registers.

use super::{LONG_REGISTERS, SOURCE};
use crate::field::{Direction, Spec};
use crate::modbus::registers::{WriteRequest, WriteResponse};
use crate::modbus::{Kind, Length};

pub static REQUEST: Kind = Kind {
    function: 101,
    direction: Direction::Request,
    spec: Spec::new("write_long_registers_request", "Write 32-bit registers (KEB)")
        .note("Writes 32-bit values, such as the entries of a mapping list.")
        .source(SOURCE),
    length: Length::Counted { at: 5, unit: 4 },
    new: || WriteRequest::of(&LONG_REGISTERS),
};

pub static RESPONSE: Kind = Kind {
    function: 101,
    direction: Direction::Response,
    spec: Spec::new("write_long_registers_response", "Write 32-bit registers (KEB)")
        .note("Repeats address and number once the values are written.")
        .source(SOURCE),
    length: Length::Fixed(5),
    new: || WriteResponse::of(&LONG_REGISTERS),
};
