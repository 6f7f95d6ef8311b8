//! Requests meet their responses.

use std::hash::{Hash, Hasher};

use super::cut::hash_entry;
use super::entries::Entries;
use super::entry::{Entry, Hint, NOBODY, Role, bytes};
use crate::field::Direction;
use crate::frame::{ANY_EXCHANGE, Verdict};

/// What is true for a whole log.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Habits {
    /// The writer of the log is the client; `None` where sent and received do not tell who asks, as
    /// where a monitor receives everything.
    logger_asks: Option<bool>,
    /// Each request comes back to its sender.
    echo: bool,
    /// The log has each telegram twice.
    twice: bool,
}

/// Who speaks in each telegram, and which response answers which request: told block by block.
#[derive(Debug, Default)]
pub(super) struct Meeting {
    habits: Option<Habits>,
    /// See [`join_speakers`].
    joined: bool,
    ports: Vec<Port>,
    carried: Vec<Carried>,
}

/// A telegram of a block before, which those of later ones may have to do with.
#[derive(Debug)]
struct Carried {
    index: usize,
    entry: Entry,
    bytes: Vec<u8>,
}

impl Meeting {
    /// Meets the telegrams of the next block with each other and with those before, of which `entries` has all.
    /// What is true for the whole log is told by its first block of some length. With `guess`, ports may be joined.
    pub fn meet(&mut self, entries: &mut Entries, block: &mut [Entry], data: &[u8], guess: bool) {
        /// Fewer telegrams do not speak for those behind them.
        const ENOUGH: usize = 256;
        if self.habits.is_none() {
            self.joined = guess && join_speakers(block);
        }
        if self.joined {
            block.iter_mut().for_each(|entry| entry.port = 0);
        }
        let habits = self.habits.unwrap_or_else(|| Habits::of(block, data));
        self.habits = (self.habits.is_some() || block.len() >= ENOUGH).then_some(habits);
        let base = entries.len();
        let mut window = Window { base, block, data, carried: &mut self.carried, entries };
        for at in 0..window.block.len() {
            if window.block[at].role == Role::Discarded {
                continue;
            }
            let port = usize::from(window.block[at].port);
            if self.ports.len() <= port {
                self.ports.resize_with(port + 1, Port::default);
            }
            self.ports[port].next(&mut window, base + at, habits);
        }
        self.carry(base, block, data);
    }

    /// Whether it is told what is true for the whole log.
    pub fn is_settled(&self) -> bool {
        self.habits.is_some()
    }

    /// At a mark behind so many telegrams: what is far before it is not waited for any more.
    pub fn forget(&mut self, telegrams: usize) {
        /// Nobody answers so late.
        const FAR: usize = 256;
        let near = |index: &usize| index + FAR >= telegrams;
        for port in &mut self.ports {
            port.open.retain(|(request, _)| near(request));
            port.previous = port.previous.filter(near);
        }
        self.leave_unwanted();
    }

    /// Nothing comes from a port any more.
    pub fn fall_silent(&mut self, port: u16) {
        if let Some(port) = self.ports.get_mut(usize::from(port)) {
            *port = Port::default();
        }
    }

    /// Goes on elsewhere in the log.
    pub fn jump(&mut self) {
        self.ports.iter_mut().for_each(|port| *port = Port::default());
        self.carried.clear();
    }

    /// How far before the place behind so many telegrams those are that later ones may have to do with.
    pub fn open(&self, telegrams: usize) -> Vec<usize> {
        self.carried.iter().map(|carried| telegrams - carried.index).collect()
    }

    /// See [`Traffic::place`](super::Traffic::place).
    pub fn hash_state(&self, telegrams: usize, line: u32, days: i64, hasher: &mut impl Hasher) {
        (self.habits, self.joined).hash(hasher);
        for carried in &self.carried {
            let partner = match carried.entry.partner {
                NOBODY => NOBODY,
                partner => (telegrams as u32).wrapping_sub(partner),
            };
            // Where its bytes were is nothing to what comes.
            let entry = Entry { partner, at: 0, ..carried.entry };
            hash_entry(&entry, line, days, hasher);
            (telegrams - carried.index, &carried.bytes).hash(hasher);
        }
        for port in &self.ports {
            for (request, exchange) in &port.open {
                (telegrams - request, exchange).hash(hasher);
            }
            (port.open.len(), port.previous.map(|it| telegrams - it), port.echoed).hash(hasher);
        }
    }

    /// Keeps what the next block may have to do with.
    fn carry(&mut self, base: usize, block: &[Entry], data: &[u8]) {
        let wanted = self.leave_unwanted();
        let fresh = wanted.partition_point(|index| *index < base);
        self.carried.extend(wanted[fresh..].iter().map(|index| {
            let entry = block[index - base];
            Carried { index: *index, entry, bytes: bytes(&entry, data).to_vec() }
        }));
    }

    /// Leaves what nothing has to do with any more; returns what something may have.
    fn leave_unwanted(&mut self) -> Vec<usize> {
        let mut wanted: Vec<usize> = self.ports.iter().flat_map(Port::wanted).collect();
        wanted.sort_unstable();
        wanted.dedup();
        self.carried.retain(|carried| wanted.binary_search(&carried.index).is_ok());
        wanted
    }
}

/// The telegrams of a block, and what was carried along from those before.
struct Window<'a> {
    /// The index of the block's first telegram.
    base: usize,
    block: &'a mut [Entry],
    data: &'a [u8],
    carried: &'a mut Vec<Carried>,
    entries: &'a mut Entries,
}

impl Window<'_> {
    #[inline]
    fn get(&self, index: usize) -> (&Entry, &[u8]) {
        // Those before the block are none of its places.
        match self.block.get(index.wrapping_sub(self.base)) {
            Some(entry) => (entry, bytes(entry, self.data)),
            None => self.get_carried(index),
        }
    }

    #[cold]
    fn get_carried(&self, index: usize) -> (&Entry, &[u8]) {
        let place = self.carried.partition_point(|carried| carried.index < index);
        let Carried { entry, bytes, .. } = &self.carried[place];
        (entry, bytes)
    }

    #[inline]
    fn change(&mut self, index: usize, change: impl FnOnce(&mut Entry)) {
        if let Some(entry) = self.block.get_mut(index.wrapping_sub(self.base)) {
            return change(entry);
        }
        let place = self.carried.partition_point(|carried| carried.index < index);
        let Carried { entry, .. } = &mut self.carried[place];
        change(entry);
        self.entries.set(index, entry);
    }
}

/// Where each port has only requests or only responses, their names say who speaks, not on which line: a
/// log that names the sender of each telegram, or a line whose two directions are tapped. All are one
/// port then.
fn join_speakers(entries: &[Entry]) -> bool {
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
            return false;
        }
    }
    [[true, false], [false, true]].iter().all(|side| sides.contains(side))
}

/// Whether two telegrams are the same. Their lengths and checks tell most apart, in one step.
#[inline]
fn alike(one: &[u8], other: &[u8]) -> bool {
    (one.len(), one.last()) == (other.len(), other.last()) && one == other
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
            let same = previous
                .is_some_and(|it| alike(bytes(it, data), bytes(entry, data)) && it.port == entry.port);
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
    /// The telegrams that later ones may have to do with.
    fn wanted(&self) -> impl Iterator<Item = usize> {
        self.open.iter().map(|(request, _)| *request).chain(self.previous)
    }

    fn next(&mut self, window: &mut Window<'_>, index: usize, habits: Habits) {
        /// On a serial line answers come at once, or late; older ones are not waited for.
        const LATE: usize = 8;
        /// The check of a telegram on a serial line.
        const CHECK: usize = 2;
        let (entry, own) = window.get(index);
        let (entry, protocol) = (*entry, entry.protocol());
        let is_same = |other: &usize| alike(window.get(*other).1, own);
        if habits.twice
            && let Some((before, _)) = self.previous.filter(is_same).map(|before| window.get(before))
            && before.role != Role::Copy
            && before.hint == entry.hint
        {
            let direction = before.direction;
            window.change(index, |entry| (entry.role, entry.direction) = (Role::Copy, direction));
            self.previous = Some(index);
            return;
        }
        // A write that is printed again without its check could as well be its answer.
        let body = |whole: &[u8]| whole.len() == own.len() + CHECK && whole.starts_with(own);
        if (entry.sides, entry.hint, entry.verdict) == ([true; 2], Hint::None, Verdict::NoCheck)
            && let Some((before, _)) = self.previous.map(|it| window.get(it)).filter(|(_, it)| body(it))
        {
            let direction = before.direction;
            let sides = [direction == Direction::Request, direction == Direction::Response];
            window.change(index, |entry| {
                (entry.role, entry.direction, entry.sides) = (Role::Copy, direction, sides);
            });
            return;
        }
        // And with its check it stands behind the same without it in one line: that is the copy.
        if (entry.hint, entry.verdict) == (Hint::None, Verdict::Right)
            && entry.line > 0
            && let Some(place) = self.previous
            && let (before, body) = window.get(place)
            && (before.line, before.verdict) == (entry.line, Verdict::NoCheck)
            && own.len() == body.len() + CHECK
            && own.starts_with(body)
        {
            let (hint, direction, sides, partner) =
                (before.hint, before.direction, before.sides, before.partner);
            window.change(index, |entry| {
                (entry.hint, entry.direction, entry.sides, entry.partner) = (hint, direction, sides, partner)
            });
            window.change(place, |entry| (entry.role, entry.partner) = (Role::Copy, NOBODY));
            if partner != NOBODY {
                window.change(partner as usize, |entry| entry.partner = index as u32);
            }
            if let Some((open, _)) = self.open.last_mut().filter(|(open, _)| *open == place) {
                *open = index;
            }
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
        let previous = self.previous;
        let repeats = || last.is_some_and(|(request, _)| previous == Some(request) && is_same(&request));
        let in_line = entry.verdict == Verdict::Wrong
            && entry.line > 0
            && last.is_some_and(|(request, _)| {
                previous == Some(request) && window.get(request).0.line == entry.line
            });
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
        let continued = || {
            let before = self.previous.filter(|_| entry.sides == [false; 2]).map(|it| window.get(it));
            before.filter(|(_, before)| own.starts_with(before))
        };
        let again = self.echoed && last.is_some_and(|(request, _)| is_same(&request));
        let echoes =
            habits.echo && !self.echoed && (entry.sides[0] || entry.sides == [false; 2]) && repeats();
        let direction = match (entry.sides, hinted) {
            _ if echoes => Direction::Request,
            // Bytes count more than a word that may stand for something else.
            ([true, false], _) if entry.verdict != Verdict::Wrong => Direction::Request,
            ([false, true], _) if entry.verdict != Verdict::Wrong => Direction::Response,
            // What a line is called is not said of all that it holds.
            ([_, true] | [false, false], _) if awaited && in_line => Direction::Response,
            (_, Some(hinted)) => hinted,
            ([true, false], _) => Direction::Request,
            ([false, true], _) => Direction::Response,
            // The answer to a write of one value repeats it: another value is another write.
            _ if awaited && repeats_request(&entry) => {
                let asked = last.map(|(request, _)| window.get(request).1);
                let same = asked.is_some_and(|asked| asked.starts_with(own) || own.starts_with(asked));
                if same { Direction::Response } else { Direction::Request }
            }
            // Of a function that is not known the same bytes again are another try, and what was cut comes whole.
            _ if let Some((before, _)) = continued() => before.direction,
            _ if awaited => Direction::Response,
            _ => Direction::Request,
        };
        let sides = match direction {
            Direction::Request if awaited && repeats_request(&entry) => [true, false],
            Direction::Response if entry.sides == [false; 2] => [false, true],
            _ => entry.sides,
        };
        self.previous = Some(index);
        if echoes {
            let role = Role::Echo;
            window
                .change(index, |entry| (entry.direction, entry.sides, entry.role) = (direction, sides, role));
            self.echoed = true;
            return;
        }
        let (mut role, mut partner) = (entry.role, entry.partner);
        let most = protocol.waiting.max(LATE);
        match (direction, exchange) {
            (Direction::Request, None) => role = Role::Broadcast,
            (Direction::Request, Some(exchange)) => {
                // Polls are alike, too: only who asks again at once tries again.
                if again || repeats() {
                    role = Role::Retry;
                    // Of a function that is not known, that tells who speaks.
                    if let Some((request, _)) = last.filter(|_| entry.sides == [false; 2]) {
                        window.change(request, |request| request.sides = [true, false]);
                    }
                }
                self.echoed = false;
                if last.is_some() {
                    // Who asks again does not wait for the first answer any more.
                    self.open.retain(|(_, open)| *open != exchange);
                    if self.open.len() >= most {
                        self.open.remove(0);
                    }
                }
                self.open.push((index, exchange));
            }
            (Direction::Response, None) => role = Role::Unasked,
            (Direction::Response, Some(exchange)) => {
                let answered = if awaited {
                    self.open.pop()
                } else {
                    let place = self.open.iter().rposition(|(_, open)| *open == exchange);
                    place.map(|place| self.open.remove(place))
                };
                match answered {
                    Some((request, _)) => {
                        let late = protocol.waiting == 1 && !awaited;
                        role = if late { Role::Late } else { Role::Plain };
                        partner = request as u32;
                        window.change(request, |request| request.partner = index as u32);
                    }
                    None => role = Role::Unasked,
                }
            }
        }
        debug_assert!(partner == NOBODY || partner != index as u32);
        window.change(index, |entry| {
            (entry.direction, entry.sides) = (direction, sides);
            (entry.role, entry.partner) = (role, partner);
        });
    }
}
