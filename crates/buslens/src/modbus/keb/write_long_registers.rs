//! Function 101 (65h): write 32-bit registers.

use super::{LONG_REGISTERS, SOURCE};
use crate::field::{Direction, Spec};
use crate::modbus::registers::{WriteRequest, WriteResponse};
use crate::modbus::{Body, Kind, Length};

pub static REQUEST: Kind = request(COUNTED, || WriteRequest::of(&LONG_REGISTERS));

pub static RESPONSE: Kind = response(Length::Fixed(5), || WriteResponse::of(&LONG_REGISTERS));

/// The request in some dialect.
pub(super) const fn request(length: Length, new: fn() -> Box<dyn Body>) -> Kind {
    Kind {
        function: 101,
        direction: Direction::Request,
        spec: Spec::new("write_long_registers_request", "Write 32-bit registers (KEB)")
            .note("Writes 32-bit values, such as the entries of a mapping list.")
            .source(SOURCE),
        length,
        serial_only: false,
        new,
    }
}

/// The response in some dialect.
pub(super) const fn response(length: Length, new: fn() -> Box<dyn Body>) -> Kind {
    Kind {
        function: 101,
        direction: Direction::Response,
        spec: Spec::new("write_long_registers_response", "Write 32-bit registers (KEB)")
            .note("Repeats address and number once the values are written.")
            .source(SOURCE),
        length,
        serial_only: false,
        new,
    }
}

pub(super) const COUNTED: Length = Length::Counted { at: 5, unit: 4 };
