//! Function 5: write a single coil. The response repeats the request, so that the two cannot be told
//! apart by their bytes.

use super::coils::WriteSingle;
use super::read_coils::COILS;
use super::{Kind, Length};
use crate::field::{Direction, Spec};

pub static REQUEST: Kind = Kind {
    function: 5,
    direction: Direction::Request,
    spec: Spec::new("write_single_coil_request", "Write single coil")
        .note("Switches one coil on or off.")
        .source(SOURCE),
    length: Length::Fixed(5),
    serial_only: false,
    new: || WriteSingle::of(&COILS, Direction::Request),
};

pub static RESPONSE: Kind = Kind {
    function: 5,
    direction: Direction::Response,
    spec: Spec::new("write_single_coil_response", "Write single coil")
        .note("Repeats the request once the coil is switched.")
        .source(SOURCE),
    length: Length::Fixed(5),
    serial_only: false,
    new: || WriteSingle::of(&COILS, Direction::Response),
};

const SOURCE: &str = "Modbus application protocol V1.1b3, 6.5";
