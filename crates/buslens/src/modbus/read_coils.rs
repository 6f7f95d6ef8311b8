//! Function 1: read coils.

use super::registers::{ReadRequest, Table};
use super::{Kind, Length, coils};
use crate::field::{Direction, Spec};

pub static REQUEST: Kind = Kind {
    function: 1,
    direction: Direction::Request,
    spec: Spec::new("read_coils_request", "Read coils")
        .note("Asks for up to 2000 coils that follow each other.")
        .source(SOURCE),
    length: Length::Fixed(5),
    serial_only: false,
    new: || ReadRequest::of(&COILS),
};

pub static RESPONSE: Kind = Kind {
    function: 1,
    direction: Direction::Response,
    spec: Spec::new("read_coils_response", "Read coils")
        .note("The coils asked for, eight in a byte. Only the request says which ones, and how many.")
        .source(SOURCE),
    length: Length::Counted { at: 1, unit: 1 },
    serial_only: false,
    new: || coils::ReadResponse::of(&COILS),
};

/// Single bits that can be read and written, such as outputs.
pub static COILS: Table = coils::table("coil", "coils", "Coils", '0');

const SOURCE: &str = "Modbus application protocol V1.1b3, 6.1";
