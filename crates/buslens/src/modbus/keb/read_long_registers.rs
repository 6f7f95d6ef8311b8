//! Function 100 (64h): read 32-bit registers.

use super::{LONG_REGISTERS, SOURCE};
use crate::field::{Direction, Spec};
use crate::modbus::registers::{ReadRequest, ReadResponse};
use crate::modbus::{Body, Kind, Length};

pub static REQUEST: Kind = request(Length::Fixed(5), || ReadRequest::of(&LONG_REGISTERS));

pub static RESPONSE: Kind = response(COUNTED, || ReadResponse::of(&LONG_REGISTERS));

/// The request in some dialect.
pub(super) const fn request(length: Length, new: fn() -> Box<dyn Body>) -> Kind {
    Kind {
        function: 100,
        direction: Direction::Request,
        spec: Spec::new("read_long_registers_request", "Read 32-bit registers (KEB)")
            .note("Asks for 32-bit values, such as the entries of a mapping list.")
            .source(SOURCE),
        length,
        serial_only: false,
        new,
    }
}

/// The response in some dialect.
pub(super) const fn response(length: Length, new: fn() -> Box<dyn Body>) -> Kind {
    Kind {
        function: 100,
        direction: Direction::Response,
        spec: Spec::new("read_long_registers_response", "Read 32-bit registers (KEB)")
            .note("The values asked for, in their order.")
            .source(SOURCE),
        length,
        serial_only: false,
        new,
    }
}

pub(super) const COUNTED: Length = Length::Counted { at: 1, unit: 4 };
