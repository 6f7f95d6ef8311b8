//! Function 15 (0Fh): write multiple coils.

use super::coils::WriteRequest;
use super::read_coils::COILS;
use super::registers::WriteResponse;
use super::{Kind, Length};
use crate::field::{Direction, Spec};

pub static REQUEST: Kind = Kind {
    function: 15,
    direction: Direction::Request,
    spec: Spec::new("write_multiple_coils_request", "Write multiple coils")
        .note("Switches up to 1968 coils that follow each other.")
        .source(SOURCE),
    length: Length::Counted { at: 5, unit: 1 },
    serial_only: false,
    new: || WriteRequest::of(&COILS),
};

pub static RESPONSE: Kind = Kind {
    function: 15,
    direction: Direction::Response,
    spec: Spec::new("write_multiple_coils_response", "Write multiple coils")
        .note("Repeats address and quantity once the coils are switched.")
        .source(SOURCE),
    length: Length::Fixed(5),
    serial_only: false,
    new: || WriteResponse::of(&COILS),
};

const SOURCE: &str = "Modbus application protocol V1.1b3, 6.11";
