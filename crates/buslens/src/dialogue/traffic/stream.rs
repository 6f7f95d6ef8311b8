//! Telegrams that follow each other without anything that parts them: of a serial line, and of connections.

use super::collect::{Chunk, Traffic, has_length, is_right, keep};
use super::entry::Role;
use super::lane::{Carries, Row};
use crate::dialogue::evidence;
use crate::frame::split::{Begins, Place};
use crate::frame::{Protocol, Verdict, modbus_rtu, modbus_tcp};
use crate::modbus::EXCEPTION;

/// A connection of which so many bytes tell nothing carries no telegrams.
const TELLING: usize = 4096;

/// So many bits in a PDU make one telegram of a connection enough.
const SURE: i32 = 8;

impl Traffic {
    /// Tells what a connection carries; `false` where it is not known yet, or is of no interest.
    pub(super) fn told(&mut self, index: usize, chunk: &Chunk<'_>, row: Row) -> bool {
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
    pub(super) fn other_way(&self, index: usize) -> Option<&'static Protocol> {
        let port = self.lanes[index].rows.first()?.port;
        let ways = [0, 1].into_iter().filter_map(|way| self.lane_of.get(&(port, way)));
        let other = ways.copied().find(|lane| *lane != index)?;
        match self.lanes[other].carries {
            Carries::Protocol(protocol) => Some(protocol),
            _ => None,
        }
    }

    /// Takes the telegrams out of what waits in a lane.
    pub(super) fn drain_buffer(&mut self, index: usize, last: bool) {
        let buffer = std::mem::take(&mut self.lanes[index].buffer);
        let used = self.split(index, &buffer, last);
        let lane = &mut self.lanes[index];
        lane.buffer = buffer;
        lane.buffer.drain(..used);
        lane.forget(used);
        if last {
            (lane.in_step, lane.barren) = (true, 0);
            lane.rows.clear();
        }
    }

    /// Takes the telegrams out of the bytes of a lane, all that it has; returns how many are done with.
    pub(super) fn split(&mut self, index: usize, bytes: &[u8], last: bool) -> usize {
        /// So much that no telegram begins in is given up at once.
        const HOPELESS: usize = 1 << 14;
        /// A telegram, and another one behind it, have to be there before pauses can tell.
        const SEEN: usize = 512;
        let (main, flowing) = (self.main(index), self.flowing);
        let port = usize::from(self.lanes[index].row(0).port);
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
            if in_step && main.is(&modbus_rtu::PROTOCOL) && !flowing {
                self.framed.clear();
                let run = self.splitter.run(&bytes[at..], last, &mut self.waiting[port], &mut self.framed);
                if run > 0 {
                    let kept = *kept.get_or_insert_with(|| keep(&mut self.data, bytes));
                    let framed = std::mem::take(&mut self.framed);
                    self.push_all(index, &bytes[at..], at, kept + at, &framed);
                    self.framed = framed;
                    at += run;
                    garbage = at;
                    continue;
                }
            }
            let waiting = self.waiting[port].as_ref();
            let place = Place { bytes: &bytes[at..], last, in_step, waiting };
            match self.splitter.begins(main, place) {
                Begins::Telegram(length) => {
                    let length = match () {
                        () if flowing => self.by_pauses(index, place, at, length),
                        () if self.both_ways => self.by_segments(index, place, at, length),
                        () => length,
                    };
                    let kept = *kept.get_or_insert_with(|| keep(&mut self.data, bytes));
                    self.unframed(index, &bytes[garbage..at], garbage, kept + garbage);
                    let telegram = &bytes[at..at + length];
                    let verdict = if main.is(&modbus_rtu::PROTOCOL) {
                        Verdict::Right
                    } else {
                        (main.verdict)(telegram)
                    };
                    self.push(index, telegram, at, kept + at, main, verdict, Role::Plain);
                    at += length;
                    (garbage, in_step) = (at, true);
                }
                Begins::More => break,
                Begins::Nothing => {
                    (at, in_step) = (at + 1, false);
                    if at - garbage >= HOPELESS {
                        let kept = *kept.get_or_insert_with(|| keep(&mut self.data, bytes));
                        self.discard(index, &bytes[garbage..at], garbage, kept + garbage);
                        garbage = at;
                    }
                }
            }
        }
        if last {
            let kept = *kept.get_or_insert_with(|| keep(&mut self.data, bytes));
            let rest = &bytes[garbage..at];
            match evidence::reading(rest, &self.splitter, self.waiting[port]) {
                // The recording ends within the answer.
                Some(cut) if cut.cut && cut.awaited && cut.from == 0 && main.is(&modbus_rtu::PROTOCOL) => {
                    self.push(index, rest, garbage, kept + garbage, cut.protocol, cut.verdict, Role::Plain);
                    self.entries.last_mut().expect("it was added").sides = [false, true];
                }
                _ => self.unframed(index, rest, garbage, kept + garbage),
            }
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
        awaited || self.seen.contains(unit, function)
    }
}
