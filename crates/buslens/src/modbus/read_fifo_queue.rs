//! Function 24 (18h): read FIFO queue.

use super::read_holding_registers::HOLDING_REGISTERS;
use super::{Access, Body, Kind, Length, Server};
use crate::field::{Direction, Format, Message, Role, Spec};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

pub static REQUEST: Kind = Kind {
    function: 24,
    direction: Direction::Request,
    spec: Spec::new("read_fifo_queue_request", "Read FIFO queue")
        .note("Asks for what waits in a queue of registers. Reading leaves it there.")
        .source(SOURCE),
    length: Length::Fixed(3),
    serial_only: false,
    new: || Box::new(Request { pointer: 0 }),
};

pub static RESPONSE: Kind = Kind {
    function: 24,
    direction: Direction::Response,
    spec: Spec::new("read_fifo_queue_response", "Read FIFO queue")
        .note(
            "What waits in the queue, up to 31 registers. A server rejects the request where there are more.",
        )
        .source(SOURCE),
    length: Length::CountedByTwo { at: 1, unit: 2 },
    serial_only: false,
    new: || Box::new(Response { values: Vec::new() }),
};

/// Asks for a queue: the address of its pointer (2 bytes).
pub struct Request {
    pub pointer: u16,
}

impl Telegram for Request {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        w.u16(&POINTER, &mut self.pointer)
    }
}

impl Body for Request {
    fn meaning(&self, who: Server) -> Message {
        message!("ask {who} for the queue at holding register {n}", who = who.name(), n = self.pointer)
    }

    /// The pointer alone: what waits in the queue stands at no address.
    fn access(&self) -> Option<Access<'_>> {
        Some(Access::read(&HOLDING_REGISTERS, Some(self.pointer), 1, &[]))
    }
}

/// Answers with byte count (2 bytes), FIFO count (2 bytes) and the values.
pub struct Response {
    pub values: Vec<u16>,
}

impl Telegram for Response {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        // The FIFO count is counted, too.
        let words = w.announce(&BYTE_COUNT, 2, 1 + self.values.len(), 2)?;
        let count = words.saturating_sub(1);
        w.derived(&FIFO_COUNT, 2, Some(count as u64))?;
        w.list(&VALUES, &mut self.values, count, Some(1), |w, value| w.u16(&VALUE, value))
    }
}

impl Body for Response {
    fn meaning(&self, who: Server) -> Message {
        if self.values.is_empty() {
            return message!("{who} answers: nothing waits in the queue", who = who.name());
        }
        let values: Vec<u32> = self.values.iter().copied().map(u32::from).collect();
        message!(
            "{who} answers: {n} in the queue ({values})",
            who = who.name(),
            n = values.len(),
            values = HOLDING_REGISTERS.listed(&values)
        )
    }
}

static POINTER: Spec = Spec::new("pointer", "FIFO pointer address")
    .short("Pointer")
    .role(Role::Address)
    .format(Format::Reference('4'))
    .note("The register that leads to the queue, counted from 0: it holds how many wait there.")
    .source(SOURCE);

static BYTE_COUNT: Spec = Spec::new("byte_count", "Byte count")
    .short("Bytes")
    .role(Role::Count)
    .limits(2, 64)
    .note("How many bytes follow, in two bytes: two for the FIFO count, two for each value.")
    .source(SOURCE);

static FIFO_COUNT: Spec = Spec::new("fifo_count", "FIFO count")
    .short("Count")
    .role(Role::Count)
    .limits(0, 31)
    .note("How many values wait in the queue.")
    .source(SOURCE);

static VALUES: Spec = Spec::new("values", "Values").source(SOURCE);

static VALUE: Spec = Spec::new("value", "Value")
    .format(Format::Register)
    .note("16 bits, high byte first; the one that waits longest comes first.")
    .source(SOURCE);

const SOURCE: &str = "Modbus application protocol V1.1b3, 6.18";
