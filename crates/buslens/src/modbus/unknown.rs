//! A function code that is not listed: its data is kept as it is.

use super::{Body, Kind, Length, Server};
use crate::field::{Direction, Message, Role, Spec};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

pub static REQUEST: Kind = Kind {
    function: 0,
    direction: Direction::Request,
    spec: Spec::new("unknown_request", "Function not known").note(NOTE),
    length: Length::Open,
    serial_only: false,
    new: || Box::new(Unknown { data: Vec::new() }),
};

pub static RESPONSE: Kind = Kind {
    function: 0,
    direction: Direction::Response,
    spec: Spec::new("unknown_response", "Function not known").note(NOTE),
    length: Length::Open,
    serial_only: false,
    new: || Box::new(Unknown { data: Vec::new() }),
};

/// The data of a function that is not known.
pub struct Unknown {
    pub data: Vec<u8>,
}

impl Telegram for Unknown {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        w.bytes(&DATA, &mut self.data, None)
    }
}

impl Body for Unknown {
    fn meaning(&self, who: Server) -> Message {
        message!(
            "{who}: unknown function, with {bytes} of data",
            who = who.name(),
            bytes = Message::bytes(self.data.len())
        )
    }
}

static DATA: Spec = Spec::new("data", "Data").role(Role::Unknown).note(NOTE);

const NOTE: &str = "What the data of this function means is up to the device.";
