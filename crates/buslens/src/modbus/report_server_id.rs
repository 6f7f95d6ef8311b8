//! Function 17 (11h): report server ID (older texts: slave ID).

use super::{Bare, Body, Kind, Length, Server};
use crate::field::{Direction, Format, Message, Role, Spec, escaped};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

pub static REQUEST: Kind = Kind {
    function: 17,
    direction: Direction::Request,
    spec: Spec::new("report_server_id_request", "Report server ID")
        .note("Asks what kind of device the server is, and whether it runs. It has no data.")
        .source(SOURCE),
    length: Length::Fixed(1),
    serial_only: true,
    new: || Bare::of(|who| message!("ask {who} what it is", who = who)),
};

pub static RESPONSE: Kind = Kind {
    function: 17,
    direction: Direction::Response,
    spec: Spec::new("report_server_id_response", "Report server ID")
        .note("What the device says about itself. Its manual says how.")
        .source(SOURCE),
    length: Length::Counted { at: 1, unit: 1 },
    serial_only: true,
    // An ID of one byte, and running.
    new: || Box::new(Response { about: vec![0, 0xFF] }),
};

/// Answers with byte count (1), server ID, run indicator (1: 00h off, FFh on) and whatever the device adds.
///
/// How long the ID is only the device knows, so the three are kept in one.
pub struct Response {
    pub about: Vec<u8>,
}

impl Telegram for Response {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        let count = w.announce(&BYTE_COUNT, 1, self.about.len(), 1)?;
        w.bytes(&ABOUT, &mut self.about, Some(count))
    }
}

impl Body for Response {
    fn meaning(&self, who: Server) -> Message {
        message!("{who} says what it is: “{text}”", who = who.name(), text = escaped(&self.about))
    }
}

static BYTE_COUNT: Spec = Spec::new("byte_count", "Byte count")
    .short("Bytes")
    .role(Role::Count)
    .limits(1, 251)
    .note("How many bytes follow.")
    .source(SOURCE);

static ABOUT: Spec = Spec::new("about", "ID, run indicator, additional data")
    .short("ID")
    .format(Format::Text)
    .note(
        "First the server's ID, then FFh where it runs or 00h where it does not, then what the device adds, \
         often text. Only the device's manual says how long the ID is, so these bytes are not split.",
    )
    .source(SOURCE);

const SOURCE: &str = "Modbus application protocol V1.1b3, 6.13";
