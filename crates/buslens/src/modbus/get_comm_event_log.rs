//! Function 12 (0Ch): get comm event log.

use super::get_comm_event_counter::{EVENTS, STATUS};
use super::{Bare, Body, Kind, Length, Server};
use crate::field::{Bits, Direction, Message, Name, Role, Spec};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

pub static REQUEST: Kind = Kind {
    function: 12,
    direction: Direction::Request,
    spec: Spec::new("get_comm_event_log_request", "Get comm event log")
        .note("Asks what the server noted of the last telegrams. It has no data.")
        .source(SOURCE),
    length: Length::Fixed(1),
    serial_only: true,
    new: || Bare::of(|who| message!("ask {who} for its event log", who = who)),
};

pub static RESPONSE: Kind = Kind {
    function: 12,
    direction: Direction::Response,
    spec: Spec::new("get_comm_event_log_response", "Get comm event log")
        .note("Two counters, and a byte for each of the last 64 events, the newest first.")
        .source(SOURCE),
    length: Length::Counted { at: 1, unit: 1 },
    serial_only: true,
    new: || Box::new(Response { status: 0, events: 0, messages: 0, log: Vec::new() }),
};

/// Answers with byte count (1), status (2), event count (2), message count (2), then an event a byte.
pub struct Response {
    pub status: u16,
    pub events: u16,
    pub messages: u16,
    /// The newest first.
    pub log: Vec<u8>,
}

impl Telegram for Response {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        let bytes = w.announce(&BYTE_COUNT, 1, COUNTERS + self.log.len(), 1)?;
        STATUS.walk(w, &mut self.status)?;
        w.u16(&EVENTS, &mut self.events)?;
        w.u16(&MESSAGES, &mut self.messages)?;
        let events = bytes.saturating_sub(COUNTERS);
        w.list(&LOG, &mut self.log, events, Some(1), |w, event| w.u8(&EVENT, event))
    }
}

impl Body for Response {
    fn meaning(&self, who: Server) -> Message {
        message!(
            "{who} answers: event count {events}, message count {messages}, {n} in the log",
            who = who.name(),
            events = self.events,
            messages = self.messages,
            n = self.log.len()
        )
    }
}

/// Bytes of status and counters, which the byte count counts with the events.
const COUNTERS: usize = 6;

static BYTE_COUNT: Spec = Spec::new("byte_count", "Byte count")
    .short("Bytes")
    .role(Role::Count)
    .limits(6, 70)
    .note("How many bytes follow: six for status and counters, one for each event.")
    .source(SOURCE);

static MESSAGES: Spec = Spec::new("messages", "Message count")
    .short("Messages")
    .note("Telegrams that the server has dealt with since it started or was told to count anew.")
    .source(SOURCE);

static LOG: Spec = Spec::new("log", "Event log").short("Log").source(SOURCE);

static EVENT: Spec = Spec::new("event", "Event")
    .note("What the server noted of one telegram. Bit 7 is 1 where it received it; 01 in bits 7 and 6: sent.")
    .source(SOURCE)
    .names(&[
        Name { value: 0, label: "communication restarted", note: "Function 8, sub-function 1." },
        Name {
            value: 4,
            label: "listen only mode entered",
            note: "From here on the server hears and does not answer: function 8, sub-function 4.",
        },
    ])
    .bits(&[
        Bits::flag(0, "exception", "exception 1 to 3").note("An exception with one of these codes was sent."),
        Bits::flag(1, "error", "communication error or exception 4")
            .note("In a received telegram a communication error, in a sent one an exception with code 4."),
        Bits::flag(2, "busy", "exception 5 or 6").note("An exception with one of these codes was sent."),
        Bits::flag(3, "not_acknowledged", "exception 7").note("An exception with this code was sent."),
        Bits::part(4, 4, "kind", "kind").names(KIND_OF_EVENT).note(
            "Bit 4 is an overrun of characters or, in what was sent, a write timeout; bit 5 listen only \
             mode; bit 6 of a received telegram a broadcast.",
        ),
    ]);

/// Bits 4 to 7 of an event say together what it is.
const KIND_OF_EVENT: &[Name] = &[
    Name { value: 0x0, label: "kind not defined", note: "" },
    Name { value: 0x1, label: "kind not defined", note: "" },
    Name { value: 0x2, label: "kind not defined", note: "" },
    Name { value: 0x3, label: "kind not defined", note: "" },
    Name { value: 0x4, label: "sent", note: "" },
    Name { value: 0x5, label: "sent, write timeout", note: "" },
    Name { value: 0x6, label: "sent in listen only mode", note: "" },
    Name { value: 0x7, label: "sent in listen only mode, write timeout", note: "" },
    Name { value: 0x8, label: "received", note: "" },
    Name { value: 0x9, label: "received, characters overrun", note: "" },
    Name { value: 0xA, label: "received in listen only mode", note: "" },
    Name { value: 0xB, label: "received in listen only mode, characters overrun", note: "" },
    Name { value: 0xC, label: "broadcast received", note: "" },
    Name { value: 0xD, label: "broadcast received, characters overrun", note: "" },
    Name { value: 0xE, label: "broadcast received in listen only mode", note: "" },
    Name { value: 0xF, label: "broadcast received in listen only mode, characters overrun", note: "" },
];

const SOURCE: &str = "Modbus application protocol V1.1b3, 6.10";
