//! Function 43 (2Bh): encapsulated interface transport, which carries telegrams of other kinds.
//!
//! Layout: MEI type (1 byte), then what that type says. One file for each type; [`TYPES`] lists them.

mod canopen;
mod read_device_identification;

use super::{Body, Kind, Length, Server};
use crate::field::{Direction, Message, Role, Spec};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

/// Every known type.
static TYPES: &[&Interface] = &[&canopen::INTERFACE, &read_device_identification::INTERFACE];

pub static REQUEST: Kind = Kind {
    function: 43,
    direction: Direction::Request,
    spec: Spec::new("encapsulated_interface_request", "Encapsulated interface")
        .note("Carries a telegram of another kind: its MEI type says which.")
        .source(SOURCE),
    length: Length::Chosen { at: 1, width: 1, by: |number| interface(number).request.length },
    serial_only: false,
    new: || Encapsulated::of(Direction::Request),
};

pub static RESPONSE: Kind = Kind {
    function: 43,
    direction: Direction::Response,
    spec: Spec::new("encapsulated_interface_response", "Encapsulated interface")
        .note("Carries the answer, of the same MEI type as the request.")
        .source(SOURCE),
    length: Length::Chosen { at: 1, width: 1, by: |number| interface(number).response.length },
    serial_only: false,
    new: || Encapsulated::of(Direction::Response),
};

/// What function 43 carries: a MEI type, "Modbus encapsulated interface".
#[derive(Debug)]
struct Interface {
    number: u8,
    spec: Spec,
    request: Carried,
    response: Carried,
}

/// A telegram that is carried, in one direction.
#[derive(Debug)]
struct Carried {
    /// That of the whole PDU.
    length: Length,
    new: fn() -> Box<dyn Body>,
}

impl Interface {
    fn carried(&self, direction: Direction) -> &Carried {
        match direction {
            Direction::Request => &self.request,
            Direction::Response => &self.response,
        }
    }
}

fn interface(number: u64) -> &'static Interface {
    let known = TYPES.iter().copied().find(|known| u64::from(known.number) == number);
    known.unwrap_or(&UNKNOWN)
}

/// The MEI type and what it carries.
struct Encapsulated {
    direction: Direction,
    interface: u8,
    body: Box<dyn Body>,
}

impl Encapsulated {
    fn of(direction: Direction) -> Box<dyn Body> {
        let read = &read_device_identification::INTERFACE;
        Box::new(Self { direction, interface: read.number, body: (read.carried(direction).new)() })
    }
}

impl Telegram for Encapsulated {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        let before = self.interface;
        let walk = w.choose(&TYPE, 1, &mut self.interface, &|number| &interface(number).spec);
        if self.interface != before {
            self.body = (interface(self.interface.into()).carried(self.direction).new)();
        }
        walk?;
        self.body.walk(w)
    }
}

impl Body for Encapsulated {
    fn meaning(&self, who: Server) -> Message {
        self.body.meaning(who)
    }

    fn only_reads(&self) -> bool {
        self.body.only_reads()
    }
}

/// Data that this crate does not explain.
struct Opaque {
    meaning: fn(Message, Message) -> Message,
    data: Vec<u8>,
}

impl Telegram for Opaque {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        w.bytes(&DATA, &mut self.data, None)
    }
}

impl Body for Opaque {
    fn meaning(&self, who: Server) -> Message {
        (self.meaning)(who.name(), Message::bytes(self.data.len()))
    }
}

/// A type whose data is kept as it is.
const OPAQUE_UNKNOWN: Carried = Carried {
    length: Length::Open,
    new: || {
        Box::new(Opaque {
            meaning: |who, bytes| {
                message!("{who}: unknown MEI type, with {bytes} of data", who = who, bytes = bytes)
            },
            data: Vec::new(),
        })
    },
};

static UNKNOWN: Interface = Interface {
    number: 0,
    spec: Spec::new("unknown_interface", "not known"),
    request: OPAQUE_UNKNOWN,
    response: OPAQUE_UNKNOWN,
};

static TYPE: Spec = Spec::new("mei_type", "MEI type")
    .short("MEI")
    .role(Role::Function)
    .note("What kind of telegram is carried: 13 (CANopen) and 14 (read device identification) are public.")
    .source(SOURCE);

static DATA: Spec = Spec::new("data", "Data").note("What the carried telegram has.").source(SOURCE);

const SOURCE: &str = "Modbus application protocol V1.1b3, 6.19";
