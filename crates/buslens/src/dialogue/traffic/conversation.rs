//! Requests meet their responses.

use super::entry::{Entry, Hint, NOBODY, Role, bytes};
use crate::field::Direction;
use crate::frame::{ANY_EXCHANGE, Verdict};

/// What is true for a whole log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Habits {
    /// The writer of the log is the client; `None` where sent and received do not tell who asks, as
    /// where a monitor receives everything.
    logger_asks: Option<bool>,
    /// Each request comes back to its sender.
    echo: bool,
    /// The log has each telegram twice.
    twice: bool,
}

/// Tells who speaks in each telegram, and which response answers which request.
pub(super) fn meet(entries: &mut [Entry], data: &[u8]) {
    let habits = Habits::of(entries, data);
    let mut ports: Vec<Port> = Vec::new();
    for index in 0..entries.len() {
        if entries[index].role == Role::Discarded {
            continue;
        }
        let port = usize::from(entries[index].port);
        if ports.len() <= port {
            ports.resize_with(port + 1, Port::default);
        }
        ports[port].next(entries, data, index, habits);
    }
}

/// Where each port has only requests or only responses, their names say who speaks, not on which line: a
/// log that names the sender of each telegram, or a line whose two directions are tapped. All are one
/// port then.
pub(super) fn join_speakers(entries: &mut [Entry]) {
    let mut sides: Vec<[bool; 2]> = Vec::new();
    for entry in entries.iter().filter(|entry| entry.role != Role::Discarded) {
        let port = usize::from(entry.port);
        if sides.len() <= port {
            sides.resize(port + 1, [false; 2]);
        }
        let [asks, answers] = match (entry.sides, entry.hint) {
            ([true, true] | [false, false], Hint::Says(Direction::Request) | Hint::Logger) => [true, false],
            ([true, true] | [false, false], Hint::Says(Direction::Response) | Hint::Other) => [false, true],
            (sides, _) => sides,
        };
        sides[port][0] |= asks;
        sides[port][1] |= answers;
        if sides[port] == [true, true] {
            return;
        }
    }
    let of = |side: [bool; 2]| sides.iter().filter(|sides| **sides == side).count();
    if of([true, false]) > 0 && of([false, true]) > 0 {
        entries.iter_mut().for_each(|entry| entry.port = 0);
    }
}

/// Whether two telegrams are the same. Their lengths and checks tell most apart, in one step.
#[inline]
fn alike(a: &Entry, b: &Entry, data: &[u8]) -> bool {
    let (one, other) = (bytes(a, data), bytes(b, data));
    let [last, other_last] = [one, other].map(|bytes| bytes.last().copied().unwrap_or_default());
    (one.len() ^ other.len()) | usize::from(last ^ other_last) == 0 && one == other
}

/// Whether a telegram begins with a shorter one.
fn begins_with(own: &[u8], shorter: &[u8]) -> bool {
    shorter.len() > 2 && own.len() > shorter.len() && own.starts_with(shorter)
}

/// Whether the response of a function repeats the request.
fn repeats_request(entry: &Entry) -> bool {
    entry.verdict != Verdict::Wrong && matches!(entry.function, 5 | 6 | 22)
}

impl Habits {
    fn of(entries: &[Entry], data: &[u8]) -> Self {
        let (mut logger, mut hinted) = (0_i64, 0_i64);
        // How many telegrams are only requests, either, only responses: at first, and at once again.
        let mut counts = [[0_usize; 2]; 3];
        let mut previous: Option<&Entry> = None;
        // A third copy is none of the second.
        let mut doubled = false;
        for entry in entries.iter().filter(|entry| entry.role != Role::Discarded) {
            // What is damaged may have the length of the other side.
            let [asks, answers] = entry.sides.map(|side| i64::from(side && entry.verdict != Verdict::Wrong));
            let side = asks - answers;
            match entry.hint {
                Hint::Logger => logger += side,
                Hint::Other => logger -= side,
                _ => {}
            }
            hinted += i64::from(matches!(entry.hint, Hint::Logger | Hint::Other)) * side.abs();
            let same = previous.is_some_and(|it| alike(it, entry, data) && it.port == entry.port);
            doubled = same && !doubled;
            counts[(1 - side) as usize][usize::from(doubled)] += 1;
            previous = Some(entry);
        }
        let [requests, _, responses] = counts;
        let most = |[all, again]: [usize; 2]| again > 0 && again * 10 >= all * 6;
        // Nobody answers twice: where the responses are there twice, it is the log.
        let twice = most(responses) && responses[0] > 1;
        let logger_asks = (logger.abs() * 2 >= hinted).then_some(logger >= 0);
        Self { logger_asks, echo: !twice && most(requests), twice }
    }
}

/// What is open on a line or connection.
#[derive(Debug, Default)]
struct Port {
    /// Requests without an answer so far, oldest first, with what their answers have in common with
    /// them.
    open: Vec<(usize, u64)>,
    /// The telegram before.
    previous: Option<usize>,
    /// The last request came back already.
    echoed: bool,
}

impl Port {
    fn next(&mut self, entries: &mut [Entry], data: &[u8], index: usize, habits: Habits) {
        /// On a serial line answers come at once, or late; older ones are not waited for.
        const LATE: usize = 8;
        let entry = entries[index];
        let own = bytes(&entry, data);
        let protocol = entry.protocol();
        let same = self.previous.filter(|before| alike(&entries[*before], &entry, data));
        if habits.twice
            && same.is_some_and(|before| {
                entries[before].role != Role::Copy && entries[before].hint == entry.hint
            })
        {
            entries[index].role = Role::Copy;
            entries[index].direction = entries[self.previous.unwrap_or(index)].direction;
            self.previous = Some(index);
            return;
        }
        let exchange = (protocol.exchange)(own);
        let last = self.open.last().copied();
        let awaited = match (exchange, last) {
            (Some(ANY_EXCHANGE), Some(_)) => true,
            (Some(own), Some((_, asked))) => own == asked,
            _ => false,
        };
        let repeats = same.is_some() && same == last.map(|(request, _)| request);
        let hinted = match entry.hint {
            Hint::None => None,
            Hint::Says(direction) => Some(direction),
            Hint::Logger | Hint::Other => {
                habits.logger_asks.map(|asks| match (entry.hint == Hint::Logger) == asks {
                    true => Direction::Request,
                    false => Direction::Response,
                })
            }
        };
        let again = self.echoed && last.is_some_and(|(request, _)| alike(&entries[request], &entry, data));
        let echoes = habits.echo && repeats && !self.echoed && (entry.sides[0] || entry.sides == [false; 2]);
        let direction = match (entry.sides, hinted) {
            _ if echoes => Direction::Request,
            // Bytes count more than a word that may stand for something else.
            ([true, false], _) if entry.verdict != Verdict::Wrong => Direction::Request,
            ([false, true], _) if entry.verdict != Verdict::Wrong => Direction::Response,
            (_, Some(hinted)) => hinted,
            ([true, false], _) => Direction::Request,
            ([false, true], _) => Direction::Response,
            // The answer to a write of one value repeats it: another value is another write.
            _ if awaited && repeats_request(&entry) && protocol.waiting == 1 => {
                let asked = last.map(|(request, _)| bytes(&entries[request], data));
                let same = asked.is_some_and(|asked| asked.starts_with(own) || own.starts_with(asked));
                if same { Direction::Response } else { Direction::Request }
            }
            // What was cut before comes whole now.
            _ if entry.sides == [false; 2]
                && self.previous.is_some_and(|it| begins_with(own, bytes(&entries[it], data))) =>
            {
                self.previous.map_or(Direction::Request, |it| entries[it].direction)
            }
            // Of a function that is not known the same bytes again are another try.
            _ if awaited && repeats && entry.sides == [false; 2] => Direction::Request,
            _ if awaited => Direction::Response,
            _ => Direction::Request,
        };
        if direction == Direction::Request && awaited && repeats_request(&entry) {
            entries[index].sides = [true, false];
        }
        if entry.sides == [false; 2] && direction == Direction::Response {
            entries[index].sides = [false, true];
        }
        entries[index].direction = direction;
        self.previous = Some(index);
        if echoes {
            entries[index].role = Role::Echo;
            self.echoed = true;
            return;
        }
        let most = if protocol.waiting > 1 { protocol.waiting } else { LATE };
        match (direction, exchange) {
            (Direction::Request, None) => entries[index].role = Role::Broadcast,
            (Direction::Request, Some(exchange)) => {
                // Polls are alike, too: only who asks again at once tries again.
                if repeats || again {
                    entries[index].role = Role::Retry;
                    // Of a function that is not known, that tells who speaks.
                    if let Some((request, _)) = last.filter(|_| entry.sides == [false; 2]) {
                        entries[request].sides = [true, false];
                    }
                }
                self.echoed = false;
                // Who asks again does not wait for the first answer any more.
                self.open.retain(|(_, open)| *open != exchange);
                if self.open.len() >= most {
                    self.open.remove(0);
                }
                self.open.push((index, exchange));
            }
            (Direction::Response, None) => entries[index].role = Role::Unasked,
            (Direction::Response, Some(exchange)) => {
                let place =
                    self.open.iter().rposition(|(_, open)| exchange == ANY_EXCHANGE || *open == exchange);
                match place {
                    Some(place) => {
                        let late = protocol.waiting == 1 && place + 1 < self.open.len();
                        let (request, _) = self.open.remove(place);
                        entries[index].role = if late { Role::Late } else { Role::Plain };
                        entries[index].partner = request as u32;
                        entries[request].partner = index as u32;
                    }
                    None => entries[index].role = Role::Unasked,
                }
            }
        }
        debug_assert!(entries[index].partner == NOBODY || entries[index].partner != index as u32);
    }
}
