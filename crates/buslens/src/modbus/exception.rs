//! The exception response: a server refuses a request.
//!
//! Layout: function code + 80h (1 byte), exception code (1 byte).

use super::{Body, EXCEPTION, Kind, Length, Server};
use crate::field::{Direction, Message, Name, Role, Spec, hex_value};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

pub static RESPONSE: Kind = Kind {
    function: EXCEPTION,
    direction: Direction::Response,
    spec: Spec::new("exception_response", "Exception")
        .note("The server rejects the request. The function code is that of the request plus 80h.")
        .source(SOURCE),
    length: Length::Fixed(2),
    serial_only: false,
    new: || Box::new(Exception { code: 1 }),
};

/// Why a server refuses.
pub struct Exception {
    pub code: u8,
}

impl Telegram for Exception {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        w.u8(&CODE, &mut self.code)
    }
}

impl Body for Exception {
    fn meaning(&self, who: Server) -> Message {
        match CODE.name(self.code.into()) {
            Some(name) => message!(
                "{who} rejects the request: exception {code}, {name}",
                who = who.name(),
                code = self.code,
                name = Message::term(name.label)
            ),
            None => message!(
                "{who} rejects the request with exception {code} ({hex}), which the standard does not define",
                who = who.name(),
                code = self.code,
                hex = hex_value(self.code.into(), 1)
            ),
        }
    }

    fn exception(&self) -> Option<u8> {
        Some(self.code)
    }
}

pub(super) static CODE: Spec = Spec::new("exception", "Exception code")
    .short("Exception")
    .role(Role::Status)
    .note("Why the server rejects the request.")
    .source(SOURCE)
    .names(&[
        Name {
            value: 1,
            label: "illegal function",
            note: "The server does not know this function, or not in its present state.",
        },
        Name {
            value: 2,
            label: "illegal data address",
            note: "At least one of the registers asked for does not exist in this server.",
        },
        Name {
            value: 3,
            label: "illegal data value",
            note: "A count or length in the request is wrong, or the value is out of range.",
        },
        Name {
            value: 4,
            label: "server device failure",
            note: "The server failed while it worked on the request.",
        },
        Name {
            value: 5,
            label: "acknowledge",
            note: "The server needs time. Ask again later whether it is done.",
        },
        Name {
            value: 6,
            label: "server device busy",
            note: "The server works on something long. Try again later.",
        },
        Name { value: 8, label: "memory parity error", note: "The server found its file memory damaged." },
        Name {
            value: 10,
            label: "gateway path unavailable",
            note: "The gateway is set up wrong or overloaded.",
        },
        Name {
            value: 11,
            label: "gateway target device failed to respond",
            note: "Usually the device behind the gateway is off or not connected.",
        },
    ]);

const SOURCE: &str = "Modbus application protocol V1.1b3, 7";
