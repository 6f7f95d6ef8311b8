//! Function 11 (0Bh): get comm event counter.

use super::{Bare, Body, Choice, Kind, Length, Server};
use crate::field::{Direction, Format, Message, Name, Role, Spec};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

pub static REQUEST: Kind = Kind {
    function: 11,
    direction: Direction::Request,
    spec: Spec::new("get_comm_event_counter_request", "Get comm event counter")
        .note("Asks how many requests the server has done. It has no data.")
        .source(SOURCE),
    length: Length::Fixed(1),
    serial_only: true,
    new: || Bare::of(|who| message!("ask {who} for its event counter", who = who)),
};

pub static RESPONSE: Kind = Kind {
    function: 11,
    direction: Direction::Response,
    spec: Spec::new("get_comm_event_counter_response", "Get comm event counter")
        .note("Counting before and after a request tells whether the server has done it.")
        .source(SOURCE),
    length: Length::Fixed(5),
    serial_only: true,
    new: || Box::new(Response { status: 0, events: 0 }),
};

/// Answers with status (2 bytes) and event count (2 bytes).
pub struct Response {
    pub status: u16,
    pub events: u16,
}

impl Telegram for Response {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        STATUS.walk(w, &mut self.status)?;
        w.u16(&EVENTS, &mut self.events)
    }
}

impl Body for Response {
    fn meaning(&self, who: Server) -> Message {
        message!("{who} answers: event count {n}", who = who.name(), n = self.events)
    }
}

/// Whether the server still works on something.
pub static STATUS: Choice = Choice::new(
    Spec::new("status", "Status")
        .role(Role::Status)
        .format(Format::Hex)
        .note("Whether the server still works on a program command that it was given before.")
        .source(SOURCE),
    2,
    &[Name { value: 0, label: "ready", note: "" }, Name { value: 0xFFFF, label: "busy", note: "" }],
);

/// How many requests were done.
pub static EVENTS: Spec = Spec::new("events", "Event count")
    .short("Events")
    .note("Requests done without a fault. Rejected ones and those that ask for this counter do not count.")
    .source(SOURCE);

const SOURCE: &str = "Modbus application protocol V1.1b3, 6.9";
