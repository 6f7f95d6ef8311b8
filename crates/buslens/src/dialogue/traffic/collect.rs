use std::collections::HashMap;

use super::conversation::Meeting;
use super::cut::Context;
use super::entries::Entries;
use super::entry::{Entry, Hint, NO_TIME, NOBODY, Role, Written, number};
use super::judge::{Known, Shapes, Weak};
use super::lane::{Carries, Lane, PAUSE, Row};
use super::pieces::Found;
use super::settle::Lines;
use crate::field::{Direction, Facts};
use crate::frame::split::{Framed, Splitter, Told, Waiting, can_split};
use crate::frame::{Protocol, Settings, Speaker, Verdict, modbus_rtu};
use crate::modbus::EXCEPTION;
use crate::walk::crc_residue;

/// Bytes of a log that stand together.
#[derive(Clone, Copy, Debug, Default)]
pub struct Chunk<'a> {
    pub bytes: &'a [u8],
    /// Microseconds.
    pub time: Option<i64>,
    pub hint: Hint,
    /// Which line, connection or port.
    pub port: u16,
    /// It goes on where the chunk before it of the same port (and, with `both_ways`, of the same
    /// hint) ended.
    pub joins: bool,
    /// Each direction of the port is a stream of its own, as over TCP.
    pub both_ways: bool,
    /// Of a connection: it goes to the port of Modbus, where all that its header tells is one.
    pub known_port: bool,
    /// See [`Entry::line`] and [`Entry::offset`].
    pub line: u32,
    pub offset: u64,
    /// How the bytes stand in the file, if they can be read again from there.
    pub written: Option<Written>,
    /// Of a text: what it says of the bytes.
    pub facts: Option<Facts>,
    /// Of a text: the same numbers read as decimal, where they can be either.
    pub decimal: Option<&'a [u8]>,
    /// Of a text: where what stands between the bytes changes.
    pub breaks: &'a [usize],
}

/// The telegrams of a log.
#[derive(Debug)]
pub struct Traffic {
    pub(super) splitter: Splitter,
    pub(super) settings: Settings,
    /// What most telegrams are.
    pub(super) protocol: &'static Protocol,
    /// The telegrams that are settled.
    pub(super) settled: Entries,
    /// Those that are not, and their bytes.
    pub(super) entries: Vec<Entry>,
    pub(super) data: Vec<u8>,
    pub(super) meeting: Meeting,
    pub(super) lanes: Vec<Lane>,
    pub(super) lane_of: HashMap<(u16, u8), usize>,
    /// The lane of the last chunk, and its port and way.
    pub(super) latest: usize,
    pub(super) latest_way: Option<(u16, u8)>,
    /// The request that waits, for each port.
    pub(super) waiting: Vec<Option<Waiting>>,
    /// Something came on the port since the last mark.
    pub(super) heard: Vec<bool>,
    /// Those that had a right telegram.
    pub(super) seen: Seen,
    /// The time of the last chunk, to notice midnight.
    pub(super) clock: i64,
    pub(super) days: i64,
    /// Some time has a date.
    pub(super) dated: bool,
    /// See [`Chunk::both_ways`].
    pub(super) both_ways: bool,
    /// See [`flow`](Traffic::flow).
    pub(super) flowing: bool,
    /// How many more entries can be told apart by their numbers.
    pub(super) room: usize,
    /// See [`pauses`](Self::pauses): of what is settled, and of what is not.
    pub(super) pauses: Vec<(u32, u32)>,
    pub(super) fresh_pauses: Vec<(u32, u32)>,
    /// There are telegrams whose protocol has request and response take turns.
    pub(super) turns: bool,
    /// A person said of which protocol all telegrams are.
    pub(super) by_hand: bool,
    /// See [`leave_in_file`](Self::leave_in_file).
    pub(super) in_file: bool,
    /// See [`directed`](Self::directed).
    pub(super) direction: Option<Direction>,
    /// The entries of a text that have no proof, in their order, of those that are not settled.
    pub(super) weak: Vec<Weak>,
    pub(super) shapes: Shapes,
    /// What those with a proof tell of the others.
    pub(super) known: Known,
    /// See [`settle_context`](Self::settle_context).
    pub(super) context: Option<Context>,
    /// A text holds nothing but what should be telegrams.
    pub(super) typed: bool,
    /// Lines of a text with pieces that are no telegrams: number and place.
    pub(super) passed: Vec<(u32, u64)>,
    /// Lines of a text that tell nothing by bytes.
    pub(super) unread: Vec<(u32, u64)>,
    /// Those of both that no telegram can stand in any more.
    pub(super) lines: Lines,
    /// Entries that turned out to be parts of others, of those that are not settled.
    pub(super) gone: Vec<u32>,
    pub(super) latest_piece: Latest,
    /// The telegrams of the last piece: a place to work in, so that pieces do not allocate.
    pub(super) found: Vec<Found>,
    /// The same for the frames of a stream.
    pub(super) framed: Vec<Framed>,
    /// How many bytes the columns of a text had.
    pub(super) in_columns: usize,
    /// What other protocols were seen, by their place in [`FOREIGN`](crate::dialogue::foreign::FOREIGN).
    pub(super) foreign_protocols: [u32; crate::dialogue::foreign::FOREIGN.len()],
}

/// The last piece of a text: what is written twice in a line is one telegram.
#[derive(Debug, Default)]
pub(super) struct Latest {
    pub line: u32,
    pub bytes: Vec<u8>,
    pub hint: Hint,
}

impl Latest {
    pub fn set(&mut self, row: Row, bytes: &[u8]) {
        (self.line, self.hint) = (row.line, row.hint);
        self.bytes.clear();
        self.bytes.extend_from_slice(bytes);
    }
}

/// Their numbers have 32 bits, and one of them stands for none.
const MOST_ENTRIES: usize = u32::MAX as usize;

/// A piece longer than this is a stream.
const LONG: usize = 1024;

/// Microseconds: a pause that ends a telegram at 9600 baud is under 4 ms.
const LONG_PAUSE: i64 = 5000;

impl Traffic {
    /// For telegrams that are mostly of `protocol`.
    pub fn new(protocol: &'static Protocol, settings: &Settings) -> Self {
        Self {
            splitter: Splitter::new(settings.dialect),
            settings: settings.clone(),
            protocol,
            settled: Entries::default(),
            entries: Vec::new(),
            data: Vec::new(),
            meeting: Meeting::default(),
            lanes: Vec::new(),
            lane_of: HashMap::new(),
            latest: 0,
            latest_way: None,
            waiting: Vec::new(),
            heard: Vec::new(),
            seen: Seen::default(),
            clock: NO_TIME,
            days: 0,
            dated: false,
            both_ways: false,
            flowing: false,
            room: MOST_ENTRIES,
            pauses: Vec::new(),
            fresh_pauses: Vec::new(),
            turns: false,
            by_hand: false,
            in_file: false,
            direction: None,
            weak: Vec::new(),
            shapes: Shapes::default(),
            known: Known::default(),
            context: None,
            typed: true,
            passed: Vec::new(),
            unread: Vec::new(),
            lines: Lines::default(),
            gone: Vec::new(),
            latest_piece: Latest::default(),
            found: Vec::new(),
            framed: Vec::new(),
            in_columns: 0,
            foreign_protocols: [0; crate::dialogue::foreign::FOREIGN.len()],
        }
    }

    /// Takes the next bytes; `false` if the log has more telegrams than can be kept.
    pub fn take(&mut self, chunk: Chunk<'_>) -> bool {
        self.read(chunk);
        self.settle_blocks(chunk.line);
        self.room > 0
    }

    fn read(&mut self, chunk: Chunk<'_>) {
        let time = chunk.time.map_or(NO_TIME, |time| self.continuous(time));
        self.data.reserve(chunk.bytes.len());
        self.both_ways |= chunk.both_ways;
        let way = match (chunk.both_ways, chunk.hint) {
            (true, Hint::Says(Direction::Response)) => 1,
            _ => 0,
        };
        let index = self.lane(chunk.port, way);
        if index != self.latest && !chunk.both_ways {
            self.close(self.latest);
        }
        (self.latest, self.latest_way) = (index, Some((chunk.port, way)));
        self.heard[usize::from(chunk.port)] = true;
        let lane = &self.lanes[index];
        let flows = self.flowing && lane.rows.last().is_some_and(|row| row.goes_on(chunk.hint, time));
        let stays = (chunk.joins || flows) && (!lane.rows.is_empty() || lane.streaming);
        if !stays {
            self.end_piece(index);
        }
        let lane = &mut self.lanes[index];
        lane.streaming |= chunk.both_ways || self.flowing;
        lane.breaks.clear();
        lane.decimal.clear();
        if !stays {
            lane.breaks.extend_from_slice(chunk.breaks);
            lane.decimal.extend_from_slice(chunk.decimal.unwrap_or_default());
        }
        let row = Row {
            from: lane.buffer.len() as isize,
            time,
            hint: chunk.hint,
            port: chunk.port,
            line: chunk.line,
            offset: chunk.offset,
            written: chunk.written,
            facts: chunk.facts.unwrap_or_default(),
        };
        if chunk.both_ways && !self.told(index, &chunk, row) {
            return;
        }
        let lane = &mut self.lanes[index];
        if lane.streaming && lane.buffer.is_empty() {
            // The usual way of a stream: nothing of it is copied but what is left over.
            lane.rows.clear();
            lane.rows.push(row);
            let used = self.split(index, chunk.bytes, false);
            let lane = &mut self.lanes[index];
            lane.buffer.extend_from_slice(&chunk.bytes[used..]);
            lane.forget(used);
            return;
        }
        lane.rows.push(row);
        lane.buffer.extend_from_slice(chunk.bytes);
        let long = lane.buffer.len() > LONG && !row.facts.column;
        if (lane.streaming && !self.flowing) || (long && can_split(self.protocol)) {
            lane.streaming = true;
            self.drain_buffer(index, false);
        }
    }

    /// Bytes that stand in the file as they are need not be kept: it can be read again.
    pub fn leave_in_file(&mut self) {
        self.in_file = true;
    }

    /// A stream of bytes begins, with nothing to part its telegrams.
    pub fn stream(&mut self) {
        let index = self.lane(0, 0);
        self.lanes[index].streaming = true;
        self.lanes[index].stream = true;
    }

    /// Each chunk is a byte or two: they follow each other, and the pauses between them tell where
    /// telegrams end.
    pub fn flow(&mut self) {
        self.flowing = true;
    }

    /// Every piece of a text is a telegram of the protocol, since a person says so.
    pub fn by_hand(&mut self) {
        self.by_hand = true;
    }

    /// A text holds something else than what should be telegrams.
    pub fn untyped(&mut self) {
        self.typed = false;
    }

    /// Who speaks in all telegrams, where a person says so.
    pub fn directed(&mut self, direction: Option<Direction>) {
        self.direction = direction;
    }

    /// The log ends: what is left is read and settled.
    pub fn finish(&mut self) {
        for index in 0..self.lanes.len() {
            self.close(index);
        }
        self.settle_all();
    }

    /// The telegrams that are settled: all of them once the log ended.
    pub fn entries(&self) -> &Entries {
        &self.settled
    }

    fn lane(&mut self, port: u16, way: u8) -> usize {
        if self.latest_way == Some((port, way)) {
            return self.latest;
        }
        let fresh = self.lanes.len();
        let index = *self.lane_of.entry((port, way)).or_insert(fresh);
        if index == fresh {
            self.lanes.push(Lane { in_step: true, ..Lane::default() });
        }
        if self.waiting.len() <= usize::from(port) {
            self.waiting.resize(usize::from(port) + 1, None);
            self.heard.resize(usize::from(port) + 1, false);
        }
        index
    }

    /// A time of day goes on behind midnight.
    fn continuous(&mut self, time: i64) -> i64 {
        const DAY: i64 = 86_400_000_000;
        let only_of_day = (0..DAY).contains(&time);
        self.dated |= !only_of_day;
        if only_of_day && self.clock != NO_TIME && self.clock - (time + self.days) > DAY / 2 {
            self.days += DAY;
        }
        self.clock = if only_of_day { time + self.days } else { time };
        self.clock
    }

    /// A chunk follows that does not join.
    fn end_piece(&mut self, index: usize) {
        self.close(index);
        let lane = &mut self.lanes[index];
        lane.streaming &= lane.stream;
    }

    /// What most telegrams of a lane are.
    pub(super) fn main(&self, index: usize) -> &'static Protocol {
        match self.lanes[index].carries {
            Carries::Protocol(protocol) => protocol,
            _ => self.protocol,
        }
    }

    /// The last telegram came in several chunks: notes the longest pause between them.
    pub(super) fn note_pause(&mut self, index: usize) {
        let rows = self.lanes[index].rows.windows(2);
        let timed = rows.filter(|pair| pair[0].time != NO_TIME && pair[1].time != NO_TIME);
        if let Some(pause) = timed.map(|pair| pair[1].time - pair[0].time).max()
            && let Some(entry) = self.entries.len().checked_sub(1)
            && pause > LONG_PAUSE
        {
            self.fresh_pauses.push((entry as u32, pause.min(PAUSE) as u32));
        }
    }

    /// The telegrams that came in several chunks with pauses of more than 5 ms between them, and the
    /// longest of these in microseconds.
    pub fn pauses(&self) -> &[(u32, u32)] {
        &self.pauses
    }

    /// How many bytes of memory it takes, as far as it is settled.
    pub fn memory(&self) -> usize {
        self.settled.memory() + self.lines.memory()
    }

    /// How many pieces of a text are telegrams of each of the [`FOREIGN`](crate::dialogue::foreign::FOREIGN).
    pub fn foreign_protocols(&self) -> &[u32] {
        &self.foreign_protocols
    }

    /// How many directions of connections carry no telegrams.
    pub fn foreign(&self) -> usize {
        self.lanes.iter().filter(|lane| matches!(lane.carries, Carries::Foreign)).count()
    }

    /// Reads all that is left of a lane.
    pub(super) fn close(&mut self, index: usize) {
        if self.lanes.len() <= index {
            return;
        }
        let other = if self.both_ways { self.other_way(index) } else { None };
        let lane = &mut self.lanes[index];
        if let (Carries::Unknown, Some(protocol)) = (lane.carries, other) {
            lane.carries = Carries::Protocol(protocol);
        }
        if lane.buffer.is_empty() {
            lane.rows.clear();
        } else if self.both_ways && matches!(lane.carries, Carries::Unknown) {
            lane.carries = Carries::Foreign;
            lane.buffer.clear();
            lane.rows.clear();
        } else if lane.streaming {
            self.drain_buffer(index, true);
        } else {
            self.read_piece(index);
        }
    }

    /// Adds a telegram of which something is wrong: its check, or with that right, only its length.
    pub(super) fn damaged(&mut self, index: usize, bytes: &[u8], from: usize, kept: usize) {
        let main = self.main(index);
        self.push(index, bytes, from, kept, main, (main.verdict)(bytes), Role::Plain);
    }

    pub(super) fn discard(&mut self, index: usize, bytes: &[u8], from: usize, kept: usize) {
        for (part, piece) in bytes.chunks(usize::from(u16::MAX)).enumerate() {
            let at = part * usize::from(u16::MAX);
            self.push(index, piece, from + at, kept + at, self.protocol, Verdict::NoCheck, Role::Discarded);
        }
    }

    pub(super) fn add(
        &mut self,
        index: usize,
        bytes: &[u8],
        from: usize,
        protocol: &'static Protocol,
        verdict: Verdict,
    ) {
        let kept = keep(&mut self.data, bytes);
        // No telegram is longer, whatever the bytes are said to be.
        if bytes.len() > usize::from(u16::MAX) {
            return self.discard(index, bytes, from, kept);
        }
        self.push(index, bytes, from, kept, protocol, verdict, Role::Plain);
    }

    /// Adds the entry of `bytes`, which lie at `from` in their lane and at `kept` in the data.
    #[inline]
    #[expect(clippy::too_many_arguments, reason = "all of them are the entry's")]
    pub(super) fn push(
        &mut self,
        index: usize,
        bytes: &[u8],
        from: usize,
        kept: usize,
        protocol: &'static Protocol,
        verdict: Verdict,
        role: Role,
    ) {
        let row = self.lanes[index].row(from);
        let (port, hint) = (row.port, row.hint);
        let said = match role {
            Role::Plain => self.describe(port, hint, bytes, protocol, verdict),
            _ => Said::default(),
        };
        self.enter(index, bytes, from, kept, number(protocol), verdict, role, said);
    }

    /// Adds the RTU frames of a stream that `bytes` begin with, one behind the other.
    pub(super) fn push_all(
        &mut self,
        index: usize,
        mut bytes: &[u8],
        mut from: usize,
        mut kept: usize,
        found: &[Framed],
    ) {
        let protocol = number(&modbus_rtu::PROTOCOL);
        for Framed { length, unit, function, sides } in found {
            let (own, rest) = bytes.split_at(usize::from(*length));
            self.seen.insert(*unit, *function);
            let said = Said { unit: Some(*unit), function: *function, sides: *sides };
            self.enter(index, own, from, kept, protocol, Verdict::Right, Role::Plain, said);
            (from, kept, bytes) = (from + own.len(), kept + own.len(), rest);
        }
    }

    #[inline]
    #[expect(clippy::too_many_arguments, reason = "all of them are the entry's")]
    fn enter(
        &mut self,
        index: usize,
        bytes: &[u8],
        from: usize,
        kept: usize,
        protocol: u8,
        verdict: Verdict,
        role: Role,
        said: Said,
    ) {
        if self.room == 0 {
            return;
        }
        self.room -= 1;
        let row = self.lanes[index].row(from);
        let skip = from as isize - row.from;
        let (offset, skip) = match row.line {
            // Of a stream, the place itself is known.
            0 => (row.offset.wrapping_add_signed(skip as i64), 0),
            _ => (row.offset, skip.clamp(0, isize::from(i16::MAX)) as u16),
        };
        let (hint, sides) = match self.direction {
            Some(direction) => (Hint::Says(direction), sides_of(direction)),
            None => (row.hint, said.sides),
        };
        self.entries.push(Entry {
            time: row.time,
            at: kept as u64,
            offset,
            written: self.written(index, row, from, bytes),
            line: row.line,
            skip,
            length: bytes.len() as u16,
            partner: NOBODY,
            port: row.port,
            protocol,
            unit: said.unit,
            function: said.function,
            verdict,
            direction: Direction::Request,
            role,
            sides,
            hint,
        });
    }

    /// How `bytes`, which lie at `from` in their lane, stand in the file, if they can be read again from there.
    #[inline]
    fn written(&self, index: usize, row: &Row, from: usize, bytes: &[u8]) -> Option<Written> {
        let written = row.written.filter(|_| self.in_file)?;
        if row.line == 0 {
            return Some(written);
        }
        // What was put together, or read in another way, does not stand there.
        let skip = usize::try_from(from as isize - row.from).ok()?;
        let latest = &self.latest_piece;
        let alone = self.lanes[index].rows.len() == 1 && latest.line == row.line;
        let same = alone && latest.bytes.get(skip..skip + bytes.len()) == Some(bytes);
        if same { written.behind(skip) } else { None }
    }

    /// An entry turns out to be of another protocol.
    pub(super) fn retype(
        &mut self,
        index: usize,
        bytes: &[u8],
        protocol: &'static Protocol,
        verdict: Verdict,
    ) {
        let (port, hint) = (self.entries[index].port, self.entries[index].hint);
        let said = self.describe(port, hint, bytes, protocol, verdict);
        let entry = &mut self.entries[index];
        entry.set_protocol(protocol);
        entry.verdict = verdict;
        (entry.unit, entry.function, entry.sides) = (said.unit, said.function, said.sides);
    }

    /// Unit, function, and what its length says; and whether it is now waited for a response.
    #[inline]
    fn describe(
        &mut self,
        port: u16,
        hint: Hint,
        bytes: &[u8],
        protocol: &'static Protocol,
        verdict: Verdict,
    ) -> Said {
        let serial = protocol.is(&modbus_rtu::PROTOCOL);
        let (unit, (pdu, around)) = if serial {
            let pdu = bytes.get(1..bytes.len().saturating_sub(2).max(1)).unwrap_or_default();
            (bytes.first().copied(), (pdu, modbus_rtu::RTU.around()))
        } else {
            let unit = (protocol.unit)(bytes);
            let said = |sides| Said { unit, function: 0, sides };
            match protocol.speaker {
                Speaker::Pdu(inside) => (unit, inside(bytes)),
                Speaker::Frame(told) => return said(told(bytes).map_or([false; 2], sides_of)),
                Speaker::Always(direction) => return said(sides_of(direction)),
                Speaker::Turns(leaning) => {
                    self.turns = true;
                    let leaning = leaning(bytes);
                    return said([leaning <= 0, leaning >= 0]);
                }
            }
        };
        let Some(function) = pdu.first().copied() else { return Said { unit, ..Said::default() } };
        let told = self.splitter.told(pdu);
        let mut sides = told.sides;
        let number = |at: usize| pdu.get(at..at + 2).map_or(0, |word| u16::from_be_bytes([word[0], word[1]]));
        // Three bytes of switches have the length of a request, but may ask for more than there can be.
        if sides == [true; 2] && matches!(function, 1 | 2) && number(3) > MOST_SWITCHES {
            sides = [false, true];
        }
        if verdict == Verdict::Wrong && sides == [true, false] && self.lacks_a_byte(port, unit, pdu) {
            sides = [false, true];
        }
        if sides == [false; 2] && told.known && hint == Hint::None {
            // The direction whose length it misses by less.
            let waiting = self.waiting[usize::from(port)];
            let awaited = waiting.is_some_and(|it| Some(it.unit) == unit && it.function == function);
            let nearer = crate::dialogue::direction(pdu, around, awaited, self.settings.dialect);
            sides = nearer.told().map_or([false; 2], sides_of);
        }
        if verdict != Verdict::Wrong {
            let unit = unit.unwrap_or_default();
            self.seen.insert(unit, function);
            let waiting = &mut self.waiting[usize::from(port)];
            *waiting = Waiting::behind(waiting.as_ref(), unit, function, Told { sides, ..told });
        }
        Said { unit, function, sides }
    }

    /// Whether a telegram that has the length of a request is a response without one of its bytes: it counts as many
    /// as are waited for, and does not ask for so much again.
    fn lacks_a_byte(&self, port: u16, unit: Option<u8>, pdu: &[u8]) -> bool {
        let ([function, count, _, high, low], Some(waiting)) = (pdu, self.waiting[usize::from(port)]) else {
            return false;
        };
        let asked = u16::from_be_bytes([*high, *low]);
        let count = u16::from(*count);
        (Some(waiting.unit), waiting.function, waiting.length) == (unit, *function, Some(count + 5))
            && asked.wrapping_mul(2) != count
    }
}

/// Units with their functions: a bit for each.
#[derive(Clone, Debug)]
pub(super) struct Seen(Vec<u64>);

impl Default for Seen {
    fn default() -> Self {
        Self(vec![0; 256 * 2])
    }
}

impl Seen {
    #[inline]
    fn place(unit: u8, function: u8) -> (usize, u64) {
        let plain = function & !EXCEPTION;
        (usize::from(unit) * 2 + usize::from(plain >> 6), 1 << (plain & 63))
    }

    #[inline]
    pub fn insert(&mut self, unit: u8, function: u8) {
        let (word, bit) = Self::place(unit, function);
        self.0[word] |= bit;
    }

    pub fn contains(&self, unit: u8, function: u8) -> bool {
        let (word, bit) = Self::place(unit, function);
        self.0[word] & bit != 0
    }
}

/// So many switches are read at most.
///
/// Source: Modbus application protocol V1.1b3, sections 6.1 and 6.2.
const MOST_SWITCHES: u16 = 2000;

/// What a telegram says of itself.
#[derive(Clone, Copy, Default)]
struct Said {
    unit: Option<u8>,
    /// 0 where the protocol has none.
    function: u8,
    /// Which sides it can be of: request, response.
    sides: [bool; 2],
}

fn sides_of(direction: Direction) -> [bool; 2] {
    [direction == Direction::Request, direction == Direction::Response]
}

/// Keeps bytes; returns where.
pub(super) fn keep(data: &mut Vec<u8>, bytes: &[u8]) -> usize {
    let kept = data.len();
    data.extend_from_slice(bytes);
    kept
}

/// Whether an RTU frame can have so many bytes.
pub(super) fn has_length(bytes: &[u8]) -> bool {
    (modbus_rtu::RTU.shortest()..=modbus_rtu::RTU.longest()).contains(&bytes.len())
}

/// Whether the check of an RTU frame is right.
pub(super) fn is_right(bytes: &[u8]) -> bool {
    has_length(bytes) && crc_residue(bytes) == 0
}
