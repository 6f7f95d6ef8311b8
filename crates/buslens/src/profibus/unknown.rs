//! A service that is not listed: its data is kept as it is.

use super::{Body, Kind};
use crate::field::{Direction, Message, Role, Spec};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

pub static REQUEST: Kind = Kind {
    sap: None,
    direction: Direction::Request,
    spec: Spec::new("unknown_service_request", "Service not known").note(NOTE),
    new: |_| Box::new(Unknown { data: Vec::new() }),
};

pub static RESPONSE: Kind = Kind {
    sap: None,
    direction: Direction::Response,
    spec: Spec::new("unknown_service_response", "Service not known").note(NOTE),
    new: |_| Box::new(Unknown { data: Vec::new() }),
};

/// The data of a service that is not known.
pub struct Unknown {
    pub data: Vec<u8>,
}

impl Telegram for Unknown {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        w.bytes(&DATA, &mut self.data, None)
    }
}

impl Body for Unknown {
    fn meaning(&self, who: Message) -> Message {
        message!(
            "{who}: unknown service, with {bytes} of data",
            who = who,
            bytes = Message::bytes(self.data.len())
        )
    }
}

static DATA: Spec = Spec::new("data", "Data").role(Role::Unknown).note(NOTE);

const NOTE: &str = "What the data of this service means is up to the device.";
