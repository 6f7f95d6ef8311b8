//! Function 7: read exception status.

use super::{Bare, Body, Kind, Length, Server};
use crate::field::{Bits, Direction, Message, Role, Spec, hex_value};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

pub static REQUEST: Kind = Kind {
    function: 7,
    direction: Direction::Request,
    spec: Spec::new("read_exception_status_request", "Read exception status")
        .note("Asks for eight outputs that tell the server's state. It has no data.")
        .source(SOURCE),
    length: Length::Fixed(1),
    serial_only: true,
    new: || Bare::of(|who| message!("ask {who} for its exception status", who = who)),
};

pub static RESPONSE: Kind = Kind {
    function: 7,
    direction: Direction::Response,
    spec: Spec::new("read_exception_status_response", "Read exception status")
        .note("Eight outputs in one byte.")
        .source(SOURCE),
    length: Length::Fixed(2),
    serial_only: true,
    new: || Box::new(Response { status: 0 }),
};

/// Answers with the exception status (1 byte).
pub struct Response {
    pub status: u8,
}

impl Telegram for Response {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        w.u8(&STATUS, &mut self.status)
    }
}

impl Body for Response {
    fn meaning(&self, who: Server) -> Message {
        message!(
            "{who} answers: its exception status is {status}",
            who = who.name(),
            status = hex_value(self.status.into(), 1)
        )
    }
}

static STATUS: Spec = Spec::new("status", "Exception status")
    .short("Status")
    .role(Role::Status)
    .note("Which outputs are on. What each of them says is in the device's manual.")
    .source(SOURCE)
    .bits(&[
        Bits::flag(0, "output_0", "output 0"),
        Bits::flag(1, "output_1", "output 1"),
        Bits::flag(2, "output_2", "output 2"),
        Bits::flag(3, "output_3", "output 3"),
        Bits::flag(4, "output_4", "output 4"),
        Bits::flag(5, "output_5", "output 5"),
        Bits::flag(6, "output_6", "output 6"),
        Bits::flag(7, "output_7", "output 7"),
    ]);

const SOURCE: &str = "Modbus application protocol V1.1b3, 6.7";
