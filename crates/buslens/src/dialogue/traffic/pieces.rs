//! Pieces of a text: what in them is proven to be a telegram, what is the beginning of one that goes on in the
//! next piece, and what may be one.

use std::borrow::Cow;
use std::hash::{Hash, Hasher};

use super::collect::{Traffic, has_length, is_right, keep};
use super::entry::{Hint, NO_TIME, Role};
use super::judge::Weak;
use super::lane::{PAUSE, Row};
use crate::dialogue::evidence::{self, Reading};
use crate::dialogue::foreign::{self, FOREIGN};
use crate::field::Facts;
use crate::frame::split::{Begins, Place, Waiting};
use crate::frame::{
    PROTOCOLS, Protocol, Speaker, Verdict, modbus_ascii, modbus_rtu, modbus_tcp, modbus_unchecked,
    profibus_fdl,
};
use crate::modbus::EXCEPTION;
use crate::walk::crc_step;

/// The beginning of a telegram, of one or more pieces.
#[derive(Clone, Debug)]
pub(super) struct Held {
    bytes: Vec<u8>,
    rows: Vec<Row>,
    /// Its telegram begins here: the line was not silent before.
    from: usize,
    /// Where its last piece begins.
    latest: usize,
    /// The entries that it is if nothing follows: one, or those of a buffer that grows.
    entries: Vec<u32>,
    /// Nothing is missing but its check.
    complete: bool,
    /// How many other pieces came since.
    age: usize,
}

impl Held {
    /// See [`Traffic::place`].
    pub fn hash_state(&self, line: u32, days: i64, hasher: &mut impl Hasher) {
        (&self.bytes, self.from, self.latest, &self.entries, self.complete, self.age).hash(hasher);
        self.rows.iter().for_each(|row| row.hash_state(line, days, hasher));
    }

    /// Entries are counted from `first` on; `false` if it has one before.
    pub fn count_from(&mut self, first: u32) -> bool {
        let counted = self.entries.iter().all(|entry| *entry >= first);
        if counted {
            self.entries.iter_mut().for_each(|entry| *entry -= first);
        }
        counted
    }
}

/// A telegram in a piece.
pub(super) type Found = (usize, usize, &'static Protocol, Verdict);

/// So many other pieces may come between two parts of a telegram.
const OTHERS: usize = 8;

/// A piece longer than this is no single telegram.
const LONGEST: usize = 300;

impl Traffic {
    /// Reads the piece in a lane's buffer.
    pub(super) fn read_piece(&mut self, index: usize) {
        let lane = &mut self.lanes[index];
        let mut buffer = std::mem::take(&mut lane.buffer);
        let mut decimal = std::mem::take(&mut lane.decimal);
        let mut breaks = std::mem::take(&mut lane.breaks);
        let row = *lane.row(0);
        let mut found = std::mem::take(&mut self.found);
        self.piece(index, &buffer, &decimal, &breaks, row, &mut found);
        self.found = found;
        buffer.clear();
        decimal.clear();
        breaks.clear();
        let lane = &mut self.lanes[index];
        (lane.buffer, lane.decimal, lane.breaks) = (buffer, decimal, breaks);
        lane.rows.clear();
    }

    fn piece(
        &mut self,
        index: usize,
        bytes: &[u8],
        decimal: &[u8],
        breaks: &[usize],
        row: Row,
        found: &mut Vec<Found>,
    ) {
        let facts = row.facts;
        if self.by_hand && !facts.column && (!facts.rest || facts.bare) {
            self.latest_piece.set(row, bytes);
            return self.all_by_hand(index, bytes);
        }
        if facts.column {
            return self.column(index, bytes, decimal, row);
        }
        let latest = &mut self.latest_piece;
        let twice =
            (latest.line, latest.hint) == (row.line, row.hint) && latest.bytes == bytes && !facts.said;
        if twice && row.line > 0 && bytes.len() > 1 {
            return;
        }
        latest.set(row, bytes);
        if self.is_nothing(index, bytes, decimal, &facts) {
            self.shapes.count(facts.shape, false);
            return self.passed.push((row.line, row.offset));
        }
        if let Some(foreign) = foreign::certain(bytes) {
            self.foreign_protocols[foreign] += 1;
            return self.passed.push((row.line, row.offset));
        }
        for reading in [bytes, decimal] {
            if self.whole(index, reading, breaks.is_empty(), found) {
                self.release(index, reading);
                self.shapes.count(facts.shape, true);
                return self.take_found(index, reading, 0, found);
            }
        }
        if self.characters(index, bytes, &facts) {
            return self.shapes.count(facts.shape, true);
        }
        if self.goes_on(index, bytes, row) {
            return;
        }
        // `8: 01 03 …`: what stands before or behind a break may be none of the telegram.
        for (from, to) in parts(breaks, bytes.len()) {
            for reading in [bytes, decimal] {
                if reading.get(from..to).is_some_and(|part| self.whole(index, part, false, found)) {
                    self.shapes.count(facts.shape, true);
                    return self.take_found(index, &reading[from..to], from, found);
                }
            }
        }
        for reading in [bytes, decimal] {
            self.inside(index, reading, found);
            if !found.is_empty() {
                self.take_found(index, reading, 0, found);
                return self.take_rest(index, reading, found, row);
            }
        }
        if let Some(foreign) = FOREIGN.iter().position(|foreign| (foreign.fits)(bytes)) {
            self.foreign_protocols[foreign] += 1;
        }
        self.unproven(index, bytes, decimal, breaks, row);
    }

    /// Whether a piece is one byte at the end of a line that says more, with nothing before that it could end: a
    /// count, mostly.
    fn is_nothing(&self, index: usize, bytes: &[u8], decimal: &[u8], facts: &Facts) -> bool {
        let acknowledges = [bytes, decimal].contains(&[profibus_fdl::SC].as_slice());
        let one = bytes.len() == 1 && facts.rest && !facts.bare && !acknowledges;
        one && !self.typed && self.lanes[index].held.is_none()
    }

    /// Bytes that stand below each other, or between words: only what is beyond doubt counts. Several columns of
    /// the same lines, and pieces of the same line, can have the same telegrams.
    fn column(&mut self, index: usize, bytes: &[u8], decimal: &[u8], row: Row) {
        let known = self.entries.partition_point(|entry| entry.line < row.line);
        let known: Vec<(u64, u16)> =
            self.entries[known..].iter().map(|entry| (entry.at, entry.length)).collect();
        for reading in [bytes, decimal] {
            let mut found = Vec::new();
            let whole = self.whole(index, reading, false, &mut found);
            if !whole {
                self.inside(index, reading, &mut found);
            }
            let seen = |(from, to, ..): &Found| {
                known.iter().any(|(at, length)| {
                    let at = *at as usize;
                    self.data.get(at..at + usize::from(*length)) == Some(&reading[*from..*to])
                })
            };
            // The longer the columns are, the more is found in them by chance.
            self.in_columns += reading.len();
            let threshold = evidence::threshold(self.in_columns);
            found.retain(|(from, to, protocol, _)| {
                whole && row.facts.marked
                    || evidence::proof(protocol, &reading[*from..*to], &self.splitter) >= threshold
            });
            let any = !found.is_empty();
            found.retain(|telegram| !seen(telegram));
            self.take_found(index, reading, 0, &found);
            if any || self.characters(index, reading, &row.facts) {
                return;
            }
        }
        let fresh = |own: &[u8]| {
            !known.iter().any(|(at, length)| {
                self.data.get(*at as usize..*at as usize + usize::from(*length)) == Some(own)
            })
        };
        // A write counts what it holds: it is told even where its check is misprinted.
        let write = (0..bytes.len()).find_map(|at| {
            let length =
                self.splitter.rtu_lengths(&bytes[at..])[0].filter(|length| *length <= bytes.len() - at)?;
            let telegram = &bytes[at..at + length];
            let reading = evidence::counted_write(telegram, &self.splitter)?;
            fresh(telegram).then_some((at, telegram, reading))
        });
        if let Some((at, telegram, reading)) = write {
            return self.add_weak(index, telegram, at, &row.facts, Some(reading));
        }
        // As the standard prints its examples, request and response stand side by side without a check.
        let reading = evidence::reading(bytes, &self.splitter, None)
            .filter(|reading| fresh(bytes) && !reading.cut && reading.verdict == Verdict::NoCheck)
            .filter(|_| !row.facts.marked);
        match reading {
            Some(_) => self.add_weak(index, bytes, 0, &row.facts, reading),
            None => self.passed.push((row.line, row.offset)),
        }
    }

    /// A person says that all pieces are telegrams of the protocol.
    fn all_by_hand(&mut self, index: usize, bytes: &[u8]) {
        let main = self.protocol;
        if main.is(&modbus_ascii::PROTOCOL)
            && let Some(bytes) = modbus_ascii::from_characters(bytes)
        {
            return self.add(index, &bytes, 0, main, (main.verdict)(&bytes));
        }
        let mut at = 0;
        while at < bytes.len() {
            let length = (main.first)(&bytes[at..]).max(1);
            let telegram = &bytes[at..at + length];
            self.add(index, telegram, at, main, (main.verdict)(telegram));
            at += length;
        }
    }

    /// Adds telegrams that were found in a piece, of which `bytes` begin at `from`.
    fn take_found(&mut self, index: usize, bytes: &[u8], from: usize, found: &[Found]) {
        for (at, to, protocol, verdict) in found.iter().copied() {
            self.add(index, &bytes[at..to], from + at, protocol, verdict);
        }
    }

    /// Whether all of a piece is telegrams beyond doubt.
    /// With `plain`, also headers of Modbus TCP with a function that is not known: RTU frames with many zeros look
    /// like them.
    fn whole(&self, index: usize, bytes: &[u8], plain: bool, found: &mut Vec<Found>) -> bool {
        found.clear();
        if bytes.len() < 4 {
            return false;
        }
        if self.is_rtu(bytes) {
            found.push((0, bytes.len(), &modbus_rtu::PROTOCOL, Verdict::Right));
            return true;
        }
        [&modbus_tcp::PROTOCOL, &profibus_fdl::PROTOCOL, &modbus_rtu::PROTOCOL]
            .into_iter()
            .any(|protocol| self.leading(index, protocol, bytes, plain, found) == bytes.len())
    }

    /// Finds the telegrams of `protocol` beyond doubt that begin a piece, one behind the other; returns where they
    /// end.
    fn leading(
        &self,
        index: usize,
        protocol: &'static Protocol,
        bytes: &[u8],
        plain: bool,
        found: &mut Vec<Found>,
    ) -> usize {
        found.clear();
        let waiting = self.waiting_at(index);
        let mut at = 0;
        loop {
            let waiting = waiting.filter(|_| at == 0);
            let waiting = waiting.as_ref();
            let place = Place { bytes: &bytes[at..], last: true, in_step: true, waiting };
            let Begins::Telegram(length) = self.splitter.begins(protocol, place) else { break };
            let telegram = &bytes[at..at + length];
            let known =
                telegram.get(modbus_tcp::HEADER).is_some_and(|function| self.splitter.knows(*function));
            // A request of RTU for two registers from 0 looks like a header with a function behind it.
            let more = telegram.len() > modbus_tcp::HEADER + 1;
            let told = if more { known || plain } else { known && self.protocol.is(&modbus_tcp::PROTOCOL) };
            // So does a write of switches from 0, whose check is wrong.
            let write = || {
                let pdu = &telegram[modbus_tcp::HEADER..];
                self.splitter.sides(pdu) == [false; 2]
                    && evidence::counted_write(telegram, &self.splitter).is_some()
            };
            if protocol.is(&modbus_tcp::PROTOCOL) && (!told || write()) {
                break;
            }
            found.push((at, at + length, protocol, (protocol.verdict)(telegram)));
            at += length;
        }
        // An acknowledgement alone proves nothing.
        if found.iter().any(|(from, to, ..)| to - from > 3) {
            return at;
        }
        found.clear();
        0
    }

    /// Whether bytes are one RTU frame with a right check. A check that is right before the telegram's end says
    /// little, since zeros may follow: so the length of its function counts.
    fn is_rtu(&self, bytes: &[u8]) -> bool {
        if !is_right(bytes) {
            return false;
        }
        let pdu = &bytes[1..bytes.len() - 2];
        if !self.splitter.knows(bytes[1]) {
            // Nor is a check right by itself that zeros only follow.
            let before = bytes.len() - 1;
            return bytes.len() > 4
                && bytes[1] & !EXCEPTION != 0
                // An exception has one byte behind its function.
                && (bytes[1] & EXCEPTION == 0 || bytes.len() == 5)
                && !(bytes[before] == 0 && is_right(&bytes[..before]));
        }
        if self.splitter.sides(pdu) != [false; 2] {
            return true;
        }
        let lengths = self.splitter.rtu_lengths(bytes);
        let shorter = lengths.into_iter().flatten().any(|length| bytes.get(..length).is_some_and(is_right));
        // Only a zero leaves a check right, so that one is all that can be missing.
        let longer = lengths.into_iter().flatten().any(|length| length == bytes.len() + 1);
        bytes.len() > 4 && !shorter && !longer
    }

    /// Takes a piece that is written as the characters of a telegram: a frame of Modbus ASCII, or hex text.
    fn characters(&mut self, index: usize, bytes: &[u8], facts: &Facts) -> bool {
        let decoded = match facts.colon {
            true => Some(Cow::Borrowed(bytes)),
            false => modbus_ascii::from_characters(bytes).map(Cow::Owned),
        };
        if let Some(telegram) = decoded {
            let verdict = modbus_ascii::ASCII.verdict(&telegram);
            let known = telegram.get(1).is_some_and(|function| self.splitter.knows(*function));
            if verdict == Verdict::Right && known {
                self.release(index, bytes);
                self.add(index, &telegram, 0, &modbus_ascii::PROTOCOL, verdict);
                return true;
            }
            let reading = evidence::ascii(&telegram, &self.splitter)
                .or_else(|| (!facts.colon).then(|| evidence::characters(&telegram)))
                .filter(|_| !facts.column && (known || telegram.len() > 2));
            let Some(reading) = reading else { return false };
            self.add_weak(index, &telegram, 0, facts, Some(reading));
            return true;
        }
        let Some(telegram) = modbus_ascii::from_hex_text(bytes) else { return false };
        let mut found = Vec::new();
        self.whole(index, &telegram, true, &mut found) && {
            self.take_found(index, &telegram, 0, &found);
            true
        }
    }

    /// Finds the telegrams inside of a piece that are beyond doubt.
    fn inside(&self, index: usize, bytes: &[u8], found: &mut Vec<Found>) {
        found.clear();
        let [fdl, rtu] = [&profibus_fdl::PROTOCOL, &modbus_rtu::PROTOCOL]
            .map(|protocol| (self.splitter.covered(protocol, bytes), protocol));
        let (covered, protocol) = std::cmp::max_by_key(fdl, rtu, |(covered, _)| *covered);
        let mut at = 0;
        let mut waiting = self.waiting_at(index);
        while covered > 0
            && let rest @ [_, ..] = &bytes[at..]
        {
            let place = Place { bytes: rest, last: true, in_step: false, waiting: waiting.as_ref() };
            match self.splitter.begins(protocol, place) {
                Begins::Telegram(length) => {
                    let telegram = &bytes[at..at + length];
                    found.push((at, at + length, protocol, (protocol.verdict)(telegram)));
                    waiting = self.asks(telegram);
                    at += length;
                }
                _ => at += 1,
            }
        }
        if !found.is_empty() || self.unusual(bytes, found) {
            return;
        }
        // Over TCP nothing follows the last telegram.
        let tcp = &modbus_tcp::PROTOCOL;
        for at in 1..bytes.len().saturating_sub(modbus_tcp::HEADER) {
            let place = Place { bytes: &bytes[at..], last: true, in_step: false, waiting: None };
            if self.splitter.begins(tcp, place) == Begins::Telegram(bytes.len() - at) {
                return found.push((at, bytes.len(), tcp, Verdict::NoCheck));
            }
        }
        // A line that was not silent reads as FFh or 00h; behind that a check is right for all that is left.
        let idle = bytes.iter().take_while(|byte| matches!(byte, 0 | 0xFF)).count();
        let rest = |from: &usize| {
            let rest = &bytes[*from..];
            let known = rest.get(1).is_some_and(|function| function & !EXCEPTION != 0);
            known && rest.len() > 4 && is_right(rest)
        };
        if let Some(from) = (idle.saturating_sub(1)..=idle).filter(|from| *from > 0).find(rest) {
            found.push((from, bytes.len(), &modbus_rtu::PROTOCOL, Verdict::Right));
        }
    }

    /// Finds frames that are not taken one by one, since their unit or function is unusual: what is right has another
    /// right one behind it, or nothing but a line that was not silent.
    fn unusual(&self, bytes: &[u8], found: &mut Vec<Found>) -> bool {
        /// The shortest of them.
        const SHORTEST: usize = 5;
        let [unit, function, ..] = *bytes else { return false };
        let known = self.splitter.knows(function);
        if matches!(function, 0 | EXCEPTION..) || (known && unit <= 247) {
            return false;
        }
        let lengths = self.splitter.rtu_lengths(bytes);
        let mut crc = u16::MAX;
        let ends = (1..=bytes.len()).filter(|end| {
            crc = crc_step(crc, bytes[end - 1]);
            crc == 0 && *end >= SHORTEST && (!known || lengths.contains(&Some(*end)))
        });
        let ends: Vec<usize> = ends.collect();
        let rtu = &modbus_rtu::PROTOCOL;
        ends.into_iter().any(|end| {
            let idle = bytes[end..].iter().take_while(|byte| matches!(byte, 0 | 0xFF)).count();
            let from = end + idle;
            let rest = &bytes[from..];
            let alone = rest.is_empty() && known;
            let again = rest.get(1) == Some(&function) && is_right(rest);
            if alone || again {
                found.push((0, end, rtu, Verdict::Right));
            }
            if again {
                found.push((from, bytes.len(), rtu, Verdict::Right));
            }
            alone || again
        })
    }

    /// What waits for its response once `telegram` is sent.
    fn asks(&self, telegram: &[u8]) -> Option<Waiting> {
        let pdu = telegram.get(1..telegram.len().checked_sub(2)?)?;
        let [asks, _] = self.splitter.sides(pdu);
        asks.then(|| Waiting {
            unit: telegram[0],
            function: pdu[0],
            length: self.splitter.answer_length(pdu).map(|length| (length + modbus_rtu::RTU.around()) as u16),
        })
    }

    /// What is left of a piece besides the telegrams in it.
    fn take_rest(&mut self, index: usize, bytes: &[u8], found: &[Found], row: Row) {
        let said = evidence::place(&row.facts) > 0;
        let mut at = 0;
        let ends = found.iter().map(|(from, to, ..)| (*from, *to)).chain([(bytes.len(), bytes.len())]);
        for (from, to) in ends {
            if said {
                let rest = &bytes[at..from];
                let cut = evidence::reading(rest, &self.splitter, self.waiting_at(index))
                    .filter(|it| it.cut && from == bytes.len());
                match cut {
                    Some(reading) => {
                        let begins = at + reading.from;
                        self.add(index, &bytes[begins..from], begins, reading.protocol, reading.verdict);
                    }
                    None => {
                        let kept = keep(&mut self.data, rest);
                        match has_length(rest) && self.is_of_known(index, rest, at) {
                            true => self.damaged(index, rest, at, kept),
                            false => self.discard(index, rest, at, kept),
                        }
                    }
                }
            }
            at = to;
        }
    }

    fn waiting_at(&self, index: usize) -> Option<Waiting> {
        let port = usize::from(self.lanes[index].row(0).port);
        self.waiting.get(port).copied().flatten()
    }

    /// A telegram came that needs no other piece: what was held is by itself, unless it was a part of this one.
    fn release(&mut self, index: usize, bytes: &[u8]) {
        let Some(mut held) = self.lanes[index].held.take() else { return };
        let row = *self.lanes[index].row(0);
        if is_apart(&held, row) {
            return;
        }
        // A buffer that grows is printed again and again. What lacked only its check was sent by itself.
        if bytes.starts_with(&held.bytes) && !held.complete && held.age == 0 {
            return self.gone.extend(held.entries);
        }
        // What comes over TCP in parts goes on behind what is sent meanwhile.
        let last = held.rows.last().map_or(Hint::None, |last| last.hint);
        let other_side = last != Hint::None && row.hint != Hint::None && last != row.hint;
        if other_side && held.age < OTHERS && self.begins_over_tcp(&held.bytes[held.from..]) {
            held.age += 1;
            self.lanes[index].held = Some(held);
        }
    }

    /// Whether a piece goes on with what is held, or is a copy of it.
    fn goes_on(&mut self, index: usize, bytes: &[u8], row: Row) -> bool {
        let Some(mut held) = self.lanes[index].held.take() else { return false };
        let elsewhere = held.rows.last().is_some_and(|last| last.facts.shape != row.facts.shape);
        if elsewhere && (held.bytes[held.latest..] == *bytes || held.bytes == bytes) {
            self.lanes[index].held = Some(held);
            return true;
        }
        if bytes.starts_with(&held.bytes) {
            self.lanes[index].held = Some(held);
            return false;
        }
        // A row below others is of the same, whatever stands before the first one.
        let below = |last: &Row| row.facts.bare && last.line + 1 == row.line;
        let same = row.facts.shape == held.rows[0].facts.shape || held.rows.last().is_some_and(below);
        // A number that ends a sentence is no rest of a telegram.
        let Facts { rest, bare, of_leftovers, .. } = row.facts;
        let sent = row.hint != Hint::None && row.hint == held.rows[0].hint;
        let placed = !rest || bare || of_leftovers || same || sent;
        if is_apart(&held, row) {
            return false;
        }
        if !placed {
            self.lanes[index].held = Some(held);
            return false;
        }
        let length = held.bytes.len();
        let joined = [held.bytes.as_slice(), bytes].concat();
        let rest = &joined[held.from..];
        let mut found = Vec::new();
        let whole = self.whole(index, rest, true, &mut found);
        if !whole && same && self.goes_on_behind(index, rest, &mut found) {
            return self.take_with_tail(index, held, bytes, row, &found);
        }
        if whole || self.is_beginning(index, rest) && same {
            let rows =
                self.lanes[index].rows.iter().map(|row| Row { from: row.from + length as isize, ..*row });
            held.rows.extend(rows);
            if whole {
                self.gone.extend(&held.entries);
                self.shapes.count(held.rows[0].facts.shape, true);
                self.lanes[index].rows = held.rows;
                self.take_found(index, rest, held.from, &found);
                self.note_pause(index);
            } else {
                // It may be one by itself all the same, if the end never comes.
                (held.latest, held.bytes, held.age) = (length, joined, 0);
                self.lanes[index].held = Some(held);
                return false;
            }
            return true;
        }
        held.age += 1;
        if held.age <= OTHERS {
            self.lanes[index].held = Some(held);
        }
        false
    }

    /// Whether a telegram whose first bytes were held ends within `bytes`, and another one begins there: what
    /// was received came in parts that are no telegrams.
    fn goes_on_behind(&self, index: usize, bytes: &[u8], found: &mut Vec<Found>) -> bool {
        [&modbus_tcp::PROTOCOL, &modbus_rtu::PROTOCOL].into_iter().any(|protocol| {
            let end = self.leading(index, protocol, bytes, true, found);
            end > 0 && self.is_beginning(index, &bytes[end..])
        })
    }

    /// Takes the telegrams that were found in what is held and a piece behind it, and holds the rest.
    fn take_with_tail(&mut self, index: usize, held: Held, bytes: &[u8], row: Row, found: &[Found]) -> bool {
        let length = held.bytes.len();
        let joined = [held.bytes.as_slice(), bytes].concat();
        let rows = self.lanes[index].rows.iter().map(|row| Row { from: row.from + length as isize, ..*row });
        let rows = held.rows.into_iter().chain(rows).collect();
        let own = std::mem::replace(&mut self.lanes[index].rows, rows);
        self.gone.extend(&held.entries);
        self.shapes.count(row.facts.shape, true);
        self.take_found(index, &joined[held.from..], held.from, found);
        self.lanes[index].rows = own;
        let end = held.from + found.last().map_or(0, |(_, to, ..)| *to);
        self.lanes[index].held = Some(Held {
            bytes: joined[end..].to_vec(),
            rows: vec![Row { from: length as isize - end as isize, ..row }],
            from: 0,
            latest: 0,
            entries: Vec::new(),
            complete: false,
            age: 0,
        });
        true
    }

    /// Whether a telegram that begins so is longer.
    fn is_beginning(&self, index: usize, bytes: &[u8]) -> bool {
        let [unit, function, ..] = *bytes else { return false };
        let awaited = self.waiting_at(index).is_some_and(|it| (it.unit, it.function) == (unit, function));
        let rtu = unit <= 247 && self.splitter.is_beginning(bytes);
        let fdl = bytes[0] == profibus_fdl::SD2
            && profibus_fdl::Fdl::length(bytes).is_some_and(|length| length > bytes.len());
        let tcp = self.begins_over_tcp(bytes);
        bytes.len() < modbus_rtu::RTU.longest()
            && (rtu || fdl || tcp || (awaited && !self.splitter.knows(function)))
    }

    /// Whether a telegram of Modbus TCP begins so and is longer.
    fn begins_over_tcp(&self, bytes: &[u8]) -> bool {
        let place = Place { bytes, last: false, in_step: true, waiting: None };
        bytes.len() > 5 && self.splitter.begins(&modbus_tcp::PROTOCOL, place) == Begins::More
    }

    /// A piece without a telegram that is beyond doubt: what it most likely is, to be judged when all of the
    /// text is known; and it may go on.
    fn unproven(&mut self, index: usize, bytes: &[u8], decimal: &[u8], breaks: &[usize], row: Row) {
        /// What may come before a telegram: the line was not silent when it was switched.
        const STRAY: usize = 2;
        let facts = row.facts;
        self.shapes.count(facts.shape, false);
        if bytes.len() > LONGEST && !(facts.bare && bytes.len() < 2 * LONGEST) {
            return self.passed.push((row.line, row.offset));
        }
        let whole = [(0, bytes), (0, decimal)].into_iter();
        let parts = parts(breaks, bytes.len()).map(|(from, to)| (from, &bytes[from..to]));
        let readings = whole.chain(parts).filter(|(_, part)| !part.is_empty());
        let waiting = self.waiting_at(index);
        // Among many parts, more is found by chance.
        let chance = 2 * (1 + breaks.len()).ilog2() as i32;
        let read = |from: usize, part: &[u8]| {
            let reading = evidence::reading(part, &self.splitter, waiting)?;
            let apart = part.len() < bytes.len();
            // What goes on in the next row of a list is not cut.
            let goes_on = reading.cut && facts.listed && from + part.len() < bytes.len();
            (!goes_on).then_some(Reading { bits: reading.bits - if apart { chance } else { 0 }, ..reading })
        };
        let best = readings.map(|(from, part)| (from, part, read(from, part))).reduce(|best, other| {
            // Numbers of a list that could be hex and decimal are decimal.
            let listed = facts.listed && other.1 == decimal && bits(&other.2) == bits(&best.2);
            if bits(&other.2) > bits(&best.2) || listed { other } else { best }
        });
        let Some((from, part, reading)) = best else { return };
        let before = self.entries.len();
        let begins = |from: &usize| bytes.get(*from..).is_some_and(|rest| self.is_beginning(index, rest));
        let awaited = |from: &usize| {
            let rest = &bytes[*from..];
            *from == 0 || waiting.is_some_and(|it| rest.starts_with(&[it.unit, it.function]))
        };
        let begins = (0..=STRAY.min(bytes.len())).filter(begins).find(awaited);
        self.add_weak(index, part, from, &facts, reading);
        let added = (before as u32..self.entries.len() as u32).next();
        if let Some(held) = self.lanes[index]
            .held
            .as_mut()
            .filter(|held| held.age == 0 && held.bytes[held.latest..] == *bytes)
        {
            return held.entries.extend(added);
        }
        if let Some(from) = begins.filter(|_| !facts.abridged) {
            let rows = self.lanes[index].rows.clone();
            let lane = &mut self.lanes[index];
            let grows = lane
                .held
                .take()
                .filter(|held| bytes.starts_with(&held.bytes) && held.age == 0 && !is_apart(held, row));
            let entries = grows.into_iter().flat_map(|held| held.entries).chain(added).collect();
            let complete = reading.is_some_and(|reading| !reading.cut);
            lane.held =
                Some(Held { bytes: bytes.to_vec(), rows, from, latest: 0, entries, complete, age: 0 });
        }
    }

    /// What bytes are as a service of PROFIBUS without its frame.
    fn bare_profibus(&self, bytes: &[u8]) -> Option<Reading> {
        // What reads as a text is one: `AT+CGMI` and a line end.
        if bytes.iter().all(|c| matches!(c, b' '..=b'~' | b'\r' | b'\n')) {
            return None;
        }
        let bare = PROTOCOLS
            .iter()
            .copied()
            .filter(|protocol| !matches!(protocol.speaker, Speaker::Pdu(_) | Speaker::Frame(_)));
        let fits = bare.map(|protocol| ((protocol.fit)(bytes, &self.settings).bits as i32, protocol));
        let (bits, protocol) = fits
            .filter(|(bits, _)| *bits > 0)
            .reduce(|best, other| if other.0 > best.0 { other } else { best })?;
        // Eight zeros are a parameter channel without a job, and much else.
        let bits = if bytes.iter().all(|byte| *byte == bytes[0]) { 0 } else { bits };
        Some(Reading { protocol, verdict: Verdict::NoCheck, from: 0, bits, cut: false, awaited: false })
    }

    /// Adds an entry that is to be judged.
    fn add_weak(&mut self, index: usize, bytes: &[u8], from: usize, facts: &Facts, reading: Option<Reading>) {
        let reading = reading.or_else(|| self.bare_profibus(bytes));
        let (protocol, verdict) = match &reading {
            Some(reading) => (reading.protocol, reading.verdict),
            None => (&modbus_rtu::PROTOCOL, modbus_rtu::RTU.verdict(bytes)),
        };
        let stray = reading.as_ref().map_or(0, |reading| reading.from);
        let before = self.entries.len();
        let port = usize::from(self.lanes[index].row(0).port);
        let waiting = self.waiting[port];
        self.add(index, &bytes[stray..], from + stray, protocol, verdict);
        if self.entries.len() == before {
            return;
        }
        // What may be no request does not wait for its answer.
        if reading.is_none_or(|reading| reading.cut) {
            self.waiting[port] = waiting;
        }
        if protocol.is(&modbus_unchecked::PROTOCOL) && reading.is_some_and(|reading| reading.cut) {
            // Requests are short, but for writes: what is cut is a response, unless its check tells.
            let own = &bytes[stray..];
            let checked = || {
                let [request, _] = self.splitter.rtu_lengths(own);
                request == Some(own.len() + 1) && evidence::begins_check(own)
            };
            let asks = matches!(self.entries[before].function, 15 | 16 | 101)
                || !reading.is_some_and(|reading| reading.awaited) && checked();
            self.entries[before].sides = [asks, !asks];
        }
        // A write of one value looks like nothing by itself.
        if bits(&reading) > 8 && !facts.digits || (facts.check_named && reading.is_some()) {
            self.shapes.look_alike(facts.shape);
        }
        match reading {
            Some(Reading { protocol, .. }) if protocol.is(&modbus_rtu::PROTOCOL) => {
                self.shapes.look_damaged(facts.shape)
            }
            Some(Reading { protocol, cut: false, .. }) if protocol.is(&modbus_unchecked::PROTOCOL) => {
                self.shapes.look_unchecked(facts.shape);
            }
            _ => {}
        }
        self.weak.push(Weak {
            entry: before as u32,
            bits: bits(&reading) + evidence::place(facts),
            read: reading.is_some(),
            cut: reading.is_some_and(|reading| reading.cut),
            awaited: reading.is_some_and(|reading| reading.awaited),
            facts: *facts,
        });
        debug_assert!(self.entries[before].role == Role::Plain);
    }
}

/// Whether so much time passed since what is held that nothing goes on with it.
fn is_apart(held: &Held, row: Row) -> bool {
    held.rows.last().is_some_and(|last| {
        let timed = row.time != NO_TIME && last.time != NO_TIME;
        timed && !(0..=PAUSE).contains(&row.time.saturating_sub(last.time))
    })
}

/// The parts of a piece of so many bytes between its breaks, the longest ones first for each beginning; all of
/// it is none.
fn parts(breaks: &[usize], length: usize) -> impl Iterator<Item = (usize, usize)> {
    let ends = move |from: usize| {
        let later = breaks.iter().rev().copied().take_while(move |to| *to != from);
        std::iter::once(length).chain(later).map(move |to| (from, to))
    };
    let begins = breaks.iter().copied().chain([0]);
    begins.flat_map(ends).filter(move |part| *part != (0, length))
}

fn bits(reading: &Option<Reading>) -> i32 {
    reading.as_ref().map_or(0, |reading| reading.bits)
}
