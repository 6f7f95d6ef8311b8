use crate::field::Direction;
use crate::frame::{PROTOCOLS, Protocol, Verdict};

/// A telegram of a log. [`Entries`](super::Entries) keeps millions in little room.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// Microseconds, see [`time`](Self::time).
    pub(super) time: i64,
    /// Its first byte among those that are kept.
    pub(super) at: u64,
    /// Where the line, or the piece of a stream, begins that its first byte is in.
    pub offset: u64,
    /// How its bytes can be read again from the file, if they can.
    pub(super) written: Option<Written>,
    /// The number of that line, from 1; 0 where there are no lines.
    pub line: u32,
    /// How many bytes of other telegrams that line or piece has before it.
    pub skip: u16,
    pub length: u16,
    pub(super) partner: u32,
    /// Which line, connection or port, from 0.
    pub port: u16,
    /// Index in [`PROTOCOLS`].
    pub(super) protocol: u8,
    pub unit: Option<u8>,
    /// As on the wire; 0 where the protocol has none.
    pub function: u8,
    pub verdict: Verdict,
    pub direction: Direction,
    pub role: Role,
    /// It has the length of a request, and that of a response.
    pub(super) sides: [bool; 2],
    pub(super) hint: Hint,
}

/// How the bytes of a telegram stand in the file, all in the same way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Written {
    /// How far behind [`Entry::offset`] the first one begins.
    pub from: u32,
    /// One begins so far behind the other: 1 if they are the bytes of the file, else they are pairs of hex digits.
    pub step: u8,
}

impl Written {
    /// The same from the byte `skip` on.
    pub(super) fn behind(self, skip: usize) -> Option<Self> {
        let skip = u32::try_from(skip * usize::from(self.step)).ok()?;
        Some(Self { from: self.from.checked_add(skip)?, ..self })
    }
}

/// What is special about a telegram in its conversation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Role {
    /// A request or a response like others.
    Plain,
    /// A request that came back to its sender over the same pair of wires.
    Echo,
    /// A request that repeats one without an answer.
    Retry,
    /// The log has it twice.
    Copy,
    /// A request to all, or one that nobody answers.
    Broadcast,
    /// A response that came after other requests.
    Late,
    /// A response that nobody asked for.
    Unasked,
    /// Bytes that are no telegram.
    Discarded,
}

/// What the log says of who speaks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Hint {
    #[default]
    None,
    Says(Direction),
    /// The writer of the log sent it.
    Logger,
    /// The writer of the log received it.
    Other,
}

/// No time is known.
pub(super) const NO_TIME: i64 = i64::MIN;

/// No telegram.
pub(super) const NOBODY: u32 = u32::MAX;

impl Entry {
    /// Microseconds as the log has them: since 1970, midnight, or some start.
    pub fn time(&self) -> Option<i64> {
        (self.time != NO_TIME).then_some(self.time)
    }

    /// The index of the request that it answers, or of the response to it.
    pub fn partner(&self) -> Option<usize> {
        (self.partner != NOBODY).then_some(self.partner as usize)
    }

    /// How its bytes can be read again from the file, if they can; else they are kept.
    pub fn written(&self) -> Option<Written> {
        self.written
    }

    /// Where its bytes end, and others may begin.
    pub(super) fn end(&self) -> u64 {
        self.at + u64::from(self.length)
    }

    pub(super) fn set_protocol(&mut self, protocol: &'static Protocol) {
        self.protocol = number(protocol);
    }

    pub fn protocol(&self) -> &'static Protocol {
        PROTOCOLS[usize::from(self.protocol)]
    }

    /// Whether the log says who speaks.
    pub fn is_said(&self) -> bool {
        self.hint != Hint::None
    }

    /// Whether it has the length of a request, and that of a response.
    pub fn sides(&self) -> [bool; 2] {
        self.sides
    }

    /// Whether it is a telegram at all, and not one that the log has twice.
    pub fn counts(&self) -> bool {
        !matches!(self.role, Role::Discarded | Role::Copy)
    }

    // Millions are counted: what follows is worked out without branches.

    /// Whether it is a request that somebody should answer.
    pub fn asks(&self) -> bool {
        (self.direction == Direction::Request) & matches!(self.role, Role::Plain | Role::Retry)
    }

    /// Whether it is a request that nobody answered.
    pub fn unanswered(&self) -> bool {
        self.asks() & (self.partner == NOBODY)
    }

    /// Whether it is a response whose request is known.
    pub fn answers(&self) -> bool {
        (self.direction == Direction::Response) & (self.partner != NOBODY)
    }

    /// The function code without the bit of an exception.
    pub fn plain_function(&self) -> u8 {
        self.function & !crate::modbus::EXCEPTION
    }

    /// Whether the server refused.
    pub fn refuses(&self) -> bool {
        (self.direction == Direction::Response) & (self.function & crate::modbus::EXCEPTION != 0)
    }
}

/// The bytes of an entry in those that are at hand.
pub(super) fn bytes<'a>(entry: &Entry, data: &'a [u8]) -> &'a [u8] {
    let from = entry.at as usize;
    data.get(from..from + usize::from(entry.length)).unwrap_or_default()
}

/// The place of a protocol in [`PROTOCOLS`].
pub(super) fn number(protocol: &'static Protocol) -> u8 {
    // The usual one is the first.
    PROTOCOLS.iter().position(|known| known.is(protocol)).unwrap_or_default() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_further_on() {
        let pairs = Written { from: 10, step: 3 };
        assert_eq!(pairs.behind(0), Some(pairs));
        assert_eq!(pairs.behind(4), Some(Written { from: 22, step: 3 }));
        assert_eq!(pairs.behind(1 << 31), None, "so far behind is nothing");
        assert_eq!(Written { from: u32::MAX, step: 1 }.behind(1), None);
    }
}
