use std::collections::HashMap;

use super::conversation;
use super::entry::{self, Entry, Hint, NO_TIME, NOBODY, Role, number};
use super::judge::{Shapes, Weak};
use super::pieces::Held;
use crate::dialogue::evidence;
use crate::field::{Direction, Facts};
use crate::frame::split::{Begins, Place, Splitter, Waiting, can_split};
use crate::frame::{Protocol, Settings, Verdict, modbus_rtu, modbus_tcp};
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
    pub offset: u32,
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
    pub(super) data: Vec<u8>,
    pub(super) entries: Vec<Entry>,
    pub(super) lanes: Vec<Lane>,
    pub(super) lane_of: HashMap<(u16, u8), usize>,
    /// The lane of the last chunk, and its port and way.
    pub(super) latest: usize,
    pub(super) latest_way: Option<(u16, u8)>,
    /// The request that waits, for each port.
    pub(super) waiting: Vec<Option<Waiting>>,
    /// Units with their functions that had a right telegram: a bit for each.
    pub(super) seen: Vec<u64>,
    /// The time of the last chunk, to notice midnight.
    pub(super) clock: i64,
    pub(super) days: i64,
    /// See [`Chunk::both_ways`].
    pub(super) both_ways: bool,
    /// See [`flow`](Traffic::flow).
    pub(super) flowing: bool,
    /// How many more entries fit.
    pub(super) room: usize,
    /// See [`pauses`](Self::pauses).
    pub(super) pauses: Vec<(u32, u32)>,
    /// A person said of which protocol all telegrams are.
    pub(super) by_hand: bool,
    /// See [`directed`](Self::directed).
    pub(super) direction: Option<Direction>,
    /// The telegrams of a text that have no proof, in their order.
    pub(super) weak: Vec<Weak>,
    pub(super) shapes: Shapes,
    /// Lines of a text with pieces that are no telegrams: number and place.
    pub(super) passed: Vec<(u32, u32)>,
    /// Entries that turned out to be parts of others.
    pub(super) gone: Vec<u32>,
    /// The line of the last piece of a text, its bytes, and who sent them: what is written twice in a line is
    /// one telegram.
    pub(super) latest_piece: (u32, Vec<u8>, Hint),
    /// How many bytes the columns of a text had.
    pub(super) in_columns: usize,
    /// What other protocols were seen, by their place in [`FOREIGN`](crate::dialogue::foreign::FOREIGN).
    pub(super) foreign_protocols: [u32; crate::dialogue::foreign::FOREIGN.len()],
}

/// Bytes that wait for the rest of their telegram.
#[derive(Debug, Default)]
pub(super) struct Lane {
    pub(super) buffer: Vec<u8>,
    /// Which chunks the bytes came in.
    pub(super) rows: Vec<Row>,
    /// Telegrams follow each other without anything that parts them.
    pub(super) streaming: bool,
    /// It is a stream by its nature.
    pub(super) stream: bool,
    /// The last telegram ended just before the buffer.
    pub(super) in_step: bool,
    /// In so many bytes at the beginning no telegram begins.
    pub(super) barren: usize,
    /// Of a text: the beginning of a telegram that may go on in the next piece.
    pub(super) held: Option<Held>,
    /// Of a text: what is in the buffer as decimal numbers, and its breaks.
    pub(super) decimal: Vec<u8>,
    pub(super) breaks: Vec<usize>,
    /// Of a connection: what it carries, once its bytes tell.
    carries: Carries,
}

/// What a connection carries.
#[derive(Clone, Copy, Debug, Default)]
enum Carries {
    #[default]
    Unknown,
    Protocol(&'static Protocol),
    /// No telegrams.
    Foreign,
}

/// A connection of which so many bytes tell nothing carries no telegrams.
const TELLING: usize = 4096;

/// So many bits in a PDU make one telegram of a connection enough.
const SURE: i32 = 8;

/// A chunk in a lane's buffer.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    /// Its first byte in the buffer; below 0 where that is gone.
    pub(super) from: isize,
    pub(super) time: i64,
    pub(super) hint: Hint,
    pub(super) port: u16,
    pub(super) line: u32,
    pub(super) offset: u32,
    pub(super) facts: Facts,
}

/// More entries than this would not fit into the memory of a page.
const MOST_ENTRIES: usize = 16_000_000;

/// A piece longer than this is a stream.
const LONG: usize = 1024;

/// Where chunks of a telegram lie further apart, they are none.
pub(super) const PAUSE: i64 = 1_000_000;

impl Traffic {
    /// For telegrams that are mostly of `protocol`.
    pub fn new(protocol: &'static Protocol, settings: &Settings) -> Self {
        Self {
            splitter: Splitter::new(settings.dialect),
            settings: settings.clone(),
            protocol,
            data: Vec::new(),
            entries: Vec::new(),
            lanes: Vec::new(),
            lane_of: HashMap::new(),
            latest: 0,
            latest_way: None,
            waiting: Vec::new(),
            seen: vec![0; 256 * 2],
            clock: NO_TIME,
            days: 0,
            both_ways: false,
            flowing: false,
            room: MOST_ENTRIES,
            pauses: Vec::new(),
            by_hand: false,
            direction: None,
            weak: Vec::new(),
            shapes: Shapes::default(),
            passed: Vec::new(),
            gone: Vec::new(),
            latest_piece: (0, Vec::new(), Hint::None),
            in_columns: 0,
            foreign_protocols: [0; crate::dialogue::foreign::FOREIGN.len()],
        }
    }

    /// Takes the next bytes; `false` if the log has more telegrams than can be kept.
    pub fn take(&mut self, chunk: Chunk<'_>) -> bool {
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
            facts: chunk.facts.unwrap_or_default(),
        };
        if chunk.both_ways && !self.told(index, &chunk, row) {
            return true;
        }
        let lane = &mut self.lanes[index];
        if lane.streaming && lane.buffer.is_empty() && !self.flowing {
            // The usual way of a stream: nothing of it is copied but what is left over.
            lane.rows.clear();
            lane.rows.push(row);
            let used = self.split(index, chunk.bytes, 0, false);
            let lane = &mut self.lanes[index];
            lane.buffer.extend_from_slice(&chunk.bytes[used..]);
            lane.forget(used);
            return self.room > 0;
        }
        lane.rows.push(row);
        lane.buffer.extend_from_slice(chunk.bytes);
        let long = lane.buffer.len() > LONG;
        if (lane.streaming && !self.flowing) || (long && can_split(self.protocol)) {
            lane.streaming = true;
            self.drain_buffer(index, false);
        }
        self.room > 0
    }

    /// A stream of bytes begins, with nothing to part its telegrams.
    pub fn stream(&mut self) {
        let index = self.lane(0, 0);
        self.lanes[index].streaming = true;
        self.lanes[index].stream = true;
    }

    /// `taken` of a file's `size` bytes were read: makes room for what the rest will need, if it is like
    /// them. To grow step by step would copy all of it again and again, and need twice the memory.
    pub fn make_room(&mut self, taken: u64, size: u64) {
        if !(1..size).contains(&taken) {
            return;
        }
        let whole = |part: usize| {
            let rest = part as u64 * (size - taken) / taken;
            part + usize::try_from(rest + rest / 64).unwrap_or(usize::MAX / 2)
        };
        let entries = whole(self.entries.len()).min(MOST_ENTRIES);
        if self.entries.capacity() < entries {
            self.entries.reserve_exact(entries - self.entries.len());
        }
        let data = whole(self.data.len()).min(usize::try_from(size).unwrap_or(usize::MAX));
        if self.data.capacity() < data {
            self.data.reserve_exact(data - self.data.len());
        }
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

    /// Who speaks in all telegrams, where a person says so.
    pub fn directed(&mut self, direction: Option<Direction>) {
        self.direction = direction;
    }

    /// The log ends: what is left is read, what has no proof is judged, and the telegrams are met with each
    /// other. `typed` says that a text holds nothing but what should be telegrams.
    pub fn finish(&mut self, typed: bool) {
        for index in 0..self.lanes.len() {
            self.close(index);
        }
        self.judge(typed);
        // What a capture says of a connection needs no guess.
        if !self.both_ways {
            conversation::join_speakers(&mut self.entries);
        }
        conversation::meet(&mut self.entries, &self.data);
    }

    /// Lines of a text whose pieces are no telegrams: number and place, in order.
    pub fn passed(&self) -> &[(u32, u32)] {
        &self.passed
    }

    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// The bytes of an entry.
    pub fn bytes(&self, entry: &Entry) -> &[u8] {
        entry::bytes(entry, &self.data)
    }

    /// How many bytes of memory it takes.
    pub fn memory(&self) -> usize {
        self.data.capacity() + self.entries.capacity() * size_of::<Entry>()
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
        }
        index
    }

    /// A time of day goes on behind midnight.
    fn continuous(&mut self, time: i64) -> i64 {
        const DAY: i64 = 86_400_000_000;
        let only_of_day = (0..DAY).contains(&time);
        if only_of_day && self.clock != NO_TIME && self.clock - (time + self.days) > DAY / 2 {
            self.days += DAY;
        }
        self.clock = if only_of_day { time + self.days } else { time };
        self.clock
    }

    /// A chunk follows that does not join.
    fn end_piece(&mut self, index: usize) {
        self.close(index);
        if !self.both_ways && !self.flowing && self.lanes[index].rows.is_empty() {
            let lane = &mut self.lanes[index];
            lane.streaming &= lane.stream;
        }
    }

    /// Tells what a connection carries; `false` where it is not known yet, or is of no interest.
    fn told(&mut self, index: usize, chunk: &Chunk<'_>, row: Row) -> bool {
        match self.lanes[index].carries {
            Carries::Protocol(_) => return true,
            Carries::Foreign => return false,
            Carries::Unknown => {}
        }
        let lane = &mut self.lanes[index];
        lane.rows.push(row);
        lane.buffer.extend_from_slice(chunk.bytes);
        if let Some(protocol) = self.other_way(index) {
            self.lanes[index].carries = Carries::Protocol(protocol);
            self.drain_buffer(index, false);
            return false;
        }
        let lane = &mut self.lanes[index];
        let protocols: [&'static Protocol; 2] = [&modbus_tcp::PROTOCOL, &modbus_rtu::PROTOCOL];
        // What was captured may begin within a telegram: the next one begins with a segment.
        let begins = |protocol: &&&'static Protocol| {
            let telegrams = lane.rows.iter().filter_map(|row| {
                let bytes = &lane.buffer[usize::try_from(row.from).unwrap_or_default()..];
                let place = Place { bytes, last: false, in_step: chunk.known_port, waiting: None };
                match self.splitter.begins(protocol, place) {
                    Begins::Telegram(length) => Some(&bytes[..length]),
                    _ => None,
                }
            });
            // Elsewhere than at the port of Modbus, bytes of other protocols may fit by accident.
            let (mut count, mut sure) = (0, chunk.known_port || protocol.is(&modbus_rtu::PROTOCOL));
            for telegram in telegrams {
                count += 1;
                let pdu = telegram.get(modbus_tcp::HEADER..).unwrap_or_default();
                sure |= evidence::structure(pdu, &self.splitter).is_some_and(|bits| bits >= SURE);
            }
            count > 1 || (count == 1 && sure)
        };
        if let Some(protocol) = protocols.iter().find(begins) {
            lane.carries = Carries::Protocol(protocol);
            self.drain_buffer(index, false);
        } else if lane.buffer.len() > TELLING {
            lane.carries = Carries::Foreign;
            lane.buffer = Vec::new();
            lane.rows.clear();
        }
        false
    }

    /// What the other way of a lane's connection carries, if that is known: both carry the same.
    fn other_way(&self, index: usize) -> Option<&'static Protocol> {
        let port = self.lanes[index].rows.first()?.port;
        let ways = [0, 1].into_iter().filter_map(|way| self.lane_of.get(&(port, way)));
        let other = ways.copied().find(|lane| *lane != index)?;
        match self.lanes[other].carries {
            Carries::Protocol(protocol) => Some(protocol),
            _ => None,
        }
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
        {
            self.pauses.push((entry as u32, pause.clamp(0, PAUSE) as u32));
        }
    }

    /// The telegrams that came in several chunks, with the longest pause between them in microseconds.
    pub fn pauses(&self) -> &[(u32, u32)] {
        &self.pauses
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
    fn close(&mut self, index: usize) {
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

    /// Takes the telegrams out of what waits in a lane.
    fn drain_buffer(&mut self, index: usize, last: bool) {
        let buffer = std::mem::take(&mut self.lanes[index].buffer);
        let used = self.split(index, &buffer, 0, last);
        let lane = &mut self.lanes[index];
        lane.buffer = buffer;
        lane.buffer.drain(..used);
        lane.forget(used);
        if last {
            (lane.in_step, lane.barren) = (true, 0);
            lane.rows.clear();
        }
    }

    /// Takes the telegrams out of bytes that begin at `from` in the lane; returns how many are done
    /// with.
    fn split(&mut self, index: usize, bytes: &[u8], from: usize, last: bool) -> usize {
        /// So much that no telegram begins in is given up at once.
        const HOPELESS: usize = 1 << 14;
        /// A telegram, and another one behind it, have to be there before pauses can tell.
        const SEEN: usize = 512;
        let (main, flowing) = (self.main(index), self.flowing);
        let port = usize::from(self.lanes[index].row(from).port);
        let mut in_step = self.lanes[index].in_step;
        // All that is done with becomes entries, one behind the other: with the first of them, all of
        // it is kept.
        let mut kept = None;
        // What lies before `at` and is no telegram begins at `garbage`.
        let (mut garbage, mut at) = (0, std::mem::take(&mut self.lanes[index].barren));
        while at < bytes.len() {
            if flowing && !last && bytes.len() - at < SEEN {
                break;
            }
            let waiting = self.waiting[port];
            let place = Place { bytes: &bytes[at..], last, in_step, waiting };
            match self.splitter.begins(main, place) {
                Begins::Telegram(length) => {
                    let length = match () {
                        () if flowing => self.by_pauses(index, place, from + at, length),
                        () if self.both_ways => self.by_segments(index, place, from + at, length),
                        () => length,
                    };
                    let kept = *kept.get_or_insert_with(|| keep(&mut self.data, bytes));
                    if garbage < at {
                        self.unframed(index, &bytes[garbage..at], from + garbage, kept + garbage);
                    }
                    let telegram = &bytes[at..at + length];
                    let verdict = if main.is(&modbus_rtu::PROTOCOL) {
                        Verdict::Right
                    } else {
                        (main.verdict)(telegram)
                    };
                    self.push(index, telegram, from + at, kept + at, main, verdict, Role::Plain);
                    at += length;
                    (garbage, in_step) = (at, true);
                }
                Begins::More => break,
                Begins::Nothing => {
                    (at, in_step) = (at + 1, false);
                    if at - garbage >= HOPELESS {
                        let kept = *kept.get_or_insert_with(|| keep(&mut self.data, bytes));
                        self.discard(index, &bytes[garbage..at], from + garbage, kept + garbage);
                        garbage = at;
                    }
                }
            }
        }
        if last && garbage < at {
            let kept = *kept.get_or_insert_with(|| keep(&mut self.data, bytes));
            self.unframed(index, &bytes[garbage..at], from + garbage, kept + garbage);
            garbage = at;
        }
        if let Some(kept) = kept {
            self.data.truncate(kept + garbage);
        }
        let lane = &mut self.lanes[index];
        (lane.in_step, lane.barren) = (in_step, at - garbage);
        garbage
    }

    /// How long the telegram at `from` of a connection is: `length`, unless a segment within it begins with
    /// another one, so that the header counted too many.
    fn by_segments(&self, index: usize, place: Place<'_>, from: usize, length: usize) -> usize {
        let (first, end) = (from as isize + modbus_tcp::HEADER as isize, (from + length) as isize);
        let rows = self.lanes[index].rows.iter().map(|row| row.from).filter(|row| (first..end).contains(row));
        let begins = |row: &isize| {
            let bytes = &place.bytes[*row as usize - from..];
            let place = Place { bytes, in_step: false, ..place };
            matches!(self.splitter.begins(&modbus_tcp::PROTOCOL, place), Begins::Telegram(_))
        };
        let cut = rows.into_iter().find(begins).filter(|_| self.main(index).is(&modbus_tcp::PROTOCOL));
        cut.map_or(length, |row| row as usize - from)
    }

    /// How long the telegram at `from` of a lane is: `length`, unless it is right with another length,
    /// too, behind which there is a longer pause. The request that waits counts more, and so does the
    /// answer that follows.
    #[cold]
    fn by_pauses(&self, index: usize, place: Place<'_>, from: usize, length: usize) -> usize {
        let bytes = place.bytes;
        let awaited = place.waiting.is_some_and(|it| bytes.starts_with(&[it.unit, it.function]));
        if awaited || !self.main(index).is(&modbus_rtu::PROTOCOL) {
            return length;
        }
        let Some(other) = self.splitter.other_length(bytes, length) else { return length };
        if let [Some(asks), _] = self.splitter.rtu_lengths(bytes)
            && [length, other].contains(&asks)
            && self.is_answered(&bytes[..asks], &bytes[asks..])
        {
            return asks;
        }
        let lane = &self.lanes[index];
        let pause = |length: usize| lane.pause_before(from + length, from + bytes.len());
        if pause(other) > pause(length) { other } else { length }
    }

    /// Whether the answer to `request` follows, perhaps behind a stray byte or two.
    fn is_answered(&self, request: &[u8], next: &[u8]) -> bool {
        const STRAY: usize = 2;
        let pdu = request.get(1..request.len() - 2).and_then(|pdu| self.splitter.answer_length(pdu));
        let Some(length) = pdu.map(|length| length + modbus_rtu::RTU.around()) else { return false };
        (0..=STRAY).any(|stray| {
            let answer = next.get(stray..stray + length);
            answer.is_some_and(|answer| answer[..2] == request[..2] && is_right(answer))
        })
    }

    /// Bytes of a stream without a right telegram: a damaged one, if they begin or end like one.
    pub(super) fn unframed(&mut self, index: usize, bytes: &[u8], from: usize, kept: usize) {
        let rtu = self.main(index).is(&modbus_rtu::PROTOCOL);
        let like = rtu
            && has_length(bytes)
            && (self.is_of_known(index, bytes, from)
                || self.splitter.rtu_lengths(bytes).contains(&Some(bytes.len())));
        match like {
            true => self.damaged(index, bytes, from, kept),
            false => self.discard(index, bytes, from, kept),
        }
    }

    /// Whether bytes begin with a unit and a function that were seen or are awaited.
    pub(super) fn is_of_known(&self, index: usize, bytes: &[u8], from: usize) -> bool {
        let [unit, code, ..] = *bytes else { return false };
        let (port, function) = (usize::from(self.lanes[index].row(from).port), code & !EXCEPTION);
        let awaited = self.waiting[port].is_some_and(|it| (it.unit, it.function) == (unit, function));
        awaited || self.seen[usize::from(unit) * 2 + usize::from(function >> 6)] >> (function & 63) & 1 == 1
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
        if self.room == 0 {
            return;
        }
        self.room -= 1;
        let row = self.lanes[index].row(from);
        let mut entry = Entry {
            time: row.time,
            at: kept as u32,
            offset: row.offset,
            line: row.line,
            skip: (from as isize - row.from).clamp(0, isize::from(i16::MAX)) as u16,
            length: bytes.len() as u16,
            partner: NOBODY,
            port: row.port,
            protocol: number(protocol),
            unit: None,
            function: 0,
            verdict,
            direction: Direction::Request,
            role,
            sides: [false; 2],
            hint: row.hint,
        };
        if row.line == 0 {
            // Of a stream, the place itself is known.
            entry.offset = (i64::from(row.offset) + (from as isize - row.from) as i64) as u32;
            entry.skip = 0;
        }
        if role == Role::Plain {
            self.describe(&mut entry, bytes, protocol);
            if let Some(direction) = self.direction {
                entry.sides = [direction == Direction::Request, direction == Direction::Response];
                entry.hint = Hint::Says(direction);
            }
        }
        self.entries.push(entry);
    }

    /// An entry turns out to be of another protocol.
    pub(super) fn retype(
        &mut self,
        index: usize,
        bytes: &[u8],
        protocol: &'static Protocol,
        verdict: Verdict,
    ) {
        let mut entry = self.entries[index];
        entry.set_protocol(protocol);
        (entry.verdict, entry.unit, entry.function, entry.sides) = (verdict, None, 0, [false; 2]);
        self.describe(&mut entry, bytes, protocol);
        self.entries[index] = entry;
    }

    /// Unit, function, and what its length says; and whether it is now waited for a response.
    #[inline]
    fn describe(&mut self, entry: &mut Entry, bytes: &[u8], protocol: &'static Protocol) {
        let serial = protocol.is(&modbus_rtu::PROTOCOL);
        let pdu = if serial {
            entry.unit = bytes.first().copied();
            bytes.get(1..bytes.len().saturating_sub(2).max(1)).unwrap_or_default()
        } else {
            entry.unit = (protocol.unit)(bytes);
            match protocol.speaker {
                crate::frame::Speaker::Pdu(inside) => inside(bytes).0,
                crate::frame::Speaker::Frame(told) => {
                    match told(bytes) {
                        Some(Direction::Request) => entry.sides = [true, false],
                        Some(Direction::Response) => entry.sides = [false, true],
                        None => {}
                    }
                    return;
                }
                crate::frame::Speaker::Always(direction) => {
                    entry.sides = [direction == Direction::Request, direction == Direction::Response];
                    return;
                }
                crate::frame::Speaker::Turns(leaning) => {
                    let leaning = leaning(bytes);
                    entry.sides = [leaning <= 0, leaning >= 0];
                    return;
                }
            }
        };
        let Some(function) = pdu.first().copied() else { return };
        entry.function = function;
        entry.sides = self.splitter.sides(pdu);
        if entry.sides == [false; 2] && self.splitter.knows(function) && entry.hint == Hint::None {
            // The direction whose length it misses by less.
            let (_, around) = match protocol.speaker {
                crate::frame::Speaker::Pdu(inside) => inside(bytes),
                _ => return,
            };
            let waiting = self.waiting[usize::from(entry.port)];
            let awaited = waiting.is_some_and(|it| Some(it.unit) == entry.unit && it.function == function);
            let nearer = crate::dialogue::direction(pdu, around, awaited, self.settings.dialect);
            if let Some(direction) = nearer.told() {
                entry.sides = [direction == Direction::Request, direction == Direction::Response];
            }
        }
        if entry.verdict == Verdict::Wrong {
            return;
        }
        let (unit, plain) = (entry.unit.unwrap_or_default(), function & !EXCEPTION);
        self.seen[usize::from(unit) * 2 + usize::from(plain >> 6)] |= 1 << (plain & 63);
        let waiting = &mut self.waiting[usize::from(entry.port)];
        let awaited = waiting.is_some_and(|it| (it.unit, it.function) == (unit, plain));
        *waiting = match entry.sides {
            // Of a function that is not known, nothing tells whether it asks.
            [false, false] if !self.splitter.knows(function) => {
                Some(Waiting { unit, function: plain, length: None })
            }
            [true, answers] if !(answers && awaited) => Some(Waiting {
                unit,
                function: plain,
                length: self
                    .splitter
                    .answer_length(pdu)
                    .map(|length| (length + modbus_rtu::RTU.around()) as u16),
            }),
            _ => None,
        };
    }
}

impl Row {
    /// Whether a telegram can go on with a chunk of this hint and time.
    pub(super) fn goes_on(&self, hint: Hint, time: i64) -> bool {
        let apart = time != NO_TIME && self.time != NO_TIME && time - self.time > PAUSE;
        !apart && self.hint == hint
    }
}

impl Lane {
    /// How long nothing came before the byte at `at` of the buffer, if that is the first of its chunk;
    /// the end of all counts as the longest pause.
    fn pause_before(&self, at: usize, end: usize) -> i64 {
        let next = self.rows.partition_point(|row| row.from < at as isize);
        match self.rows.get(next.saturating_sub(1)..=next) {
            _ if at >= end => i64::MAX,
            Some([before, row]) if row.from == at as isize && row.time != NO_TIME => {
                row.time.saturating_sub(before.time.max(0))
            }
            _ => 0,
        }
    }

    /// The chunk that the byte at `at` of the buffer came in.
    #[inline]
    pub(super) fn row(&self, at: usize) -> Row {
        let at = at as isize;
        if let Some(last) = self.rows.last().filter(|last| last.from <= at) {
            return *last;
        }
        let next = self.rows.partition_point(|row| row.from <= at);
        self.rows.get(next.saturating_sub(1)).copied().unwrap_or(Row {
            from: 0,
            time: NO_TIME,
            hint: Hint::None,
            port: 0,
            line: 0,
            offset: 0,
            facts: Facts::default(),
        })
    }

    /// The first `count` bytes are gone.
    pub(super) fn forget(&mut self, count: usize) {
        if count == 0 {
            return;
        }
        for row in &mut self.rows {
            row.from -= count as isize;
        }
        let gone = self.rows.partition_point(|row| row.from <= 0).saturating_sub(1);
        self.rows.drain(..gone);
    }
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
