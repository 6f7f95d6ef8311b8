//! Function 2: read discrete inputs.

use super::registers::{ReadRequest, Table};
use super::{Kind, Length, coils};
use crate::field::{Direction, Spec};

pub static REQUEST: Kind = Kind {
    function: 2,
    direction: Direction::Request,
    spec: Spec::new("read_discrete_inputs_request", "Read discrete inputs")
        .note("Asks for up to 2000 inputs that follow each other.")
        .source(SOURCE),
    length: Length::Fixed(5),
    serial_only: false,
    new: || ReadRequest::of(&DISCRETE_INPUTS),
};

pub static RESPONSE: Kind = Kind {
    function: 2,
    direction: Direction::Response,
    spec: Spec::new("read_discrete_inputs_response", "Read discrete inputs")
        .note("The inputs asked for, eight in a byte. Only the request says which ones, and how many.")
        .source(SOURCE),
    length: Length::Counted { at: 1, unit: 1 },
    serial_only: false,
    new: || coils::ReadResponse::of(&DISCRETE_INPUTS),
};

/// Single bits that can only be read.
static DISCRETE_INPUTS: Table = coils::table("discrete input", "discrete inputs", "Inputs", '1');

const SOURCE: &str = "Modbus application protocol V1.1b3, 6.2";
