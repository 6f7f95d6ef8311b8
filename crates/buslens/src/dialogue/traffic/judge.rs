//! What of a text without a proof is a telegram, when all of it is known.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use super::collect::{Seen, Traffic};
use super::entry::{Entry, Hint, Role, bytes};
use crate::dialogue::evidence::{self, CONVERSATION, MISPRINTED, OTHER_KIND, SAME, SEEN};
use crate::dialogue::{Candidate, Certainty, protocols, turns};
use crate::field::{Direction, Facts, Span};
use crate::frame::{
    Bus, Protocol, Speaker, Verdict, modbus_ascii, modbus_pdu, modbus_rtu, modbus_tcp, modbus_unchecked,
    profibus_fdl,
};
use crate::modbus::EXCEPTION;
use crate::profibus::{Channel, Service};

/// An entry without a proof.
#[derive(Clone, Copy, Debug)]
pub(super) struct Weak {
    pub entry: u32,
    /// What its bytes and its place say.
    pub bits: i32,
    /// It looks like a telegram of some kind.
    pub read: bool,
    pub cut: bool,
    /// Its bits count on the request before it.
    pub awaited: bool,
    pub facts: Facts,
}

/// What stands in the same way in its lines.
#[derive(Clone, Copy, Debug, Default)]
struct Shape {
    number: u32,
    pieces: usize,
    proven: usize,
    alike: usize,
    /// Of those without a proof, how many look like telegrams with a wrong check, and how many like some without
    /// one.
    damaged: usize,
    unchecked: usize,
}

/// The shapes of a text, as [`Facts::shape`] numbers them.
#[derive(Clone, Debug, Default)]
pub(super) struct Shapes {
    shapes: Vec<Shape>,
    latest: usize,
}

impl Shapes {
    #[inline]
    pub fn count(&mut self, number: u32, proven: bool) {
        let shape = self.of(number);
        shape.pieces += 1;
        shape.proven += usize::from(proven);
    }

    pub fn look_alike(&mut self, number: u32) {
        self.of(number).alike += 1;
    }

    pub fn look_damaged(&mut self, number: u32) {
        self.of(number).damaged += 1;
    }

    pub fn look_unchecked(&mut self, number: u32) {
        self.of(number).unchecked += 1;
    }

    /// Whether telegrams there mostly have their check.
    fn are_checked(&self, number: u32) -> bool {
        self.shapes
            .iter()
            .any(|shape| shape.number == number && shape.proven + shape.damaged > shape.unchecked)
    }

    /// More share the last one.
    #[inline]
    fn of(&mut self, number: u32) -> &mut Shape {
        const MOST: usize = 256;
        if self.shapes.get(self.latest).is_none_or(|shape| shape.number != number) {
            let known = self.shapes.iter().position(|shape| shape.number == number);
            self.latest = known.unwrap_or(self.shapes.len().min(MOST - 1));
            if self.latest == self.shapes.len() {
                self.shapes.push(Shape { number, ..Shape::default() });
            }
        }
        &mut self.shapes[self.latest]
    }

    fn bits(&self, number: u32) -> i32 {
        let shape = self.shapes.iter().find(|shape| shape.number == number).copied().unwrap_or_default();
        evidence::company(shape.pieces, shape.proven, shape.alike)
    }

    fn is_proven(&self, number: u32) -> bool {
        self.shapes.iter().any(|shape| shape.number == number && shape.proven * 2 > shape.pieces)
    }
}

/// Some of the entries, by their numbers.
#[derive(Debug)]
struct Chosen {
    flags: Vec<bool>,
}

impl Chosen {
    /// Out of so many.
    fn of(all: usize, chosen: impl Iterator<Item = u32>) -> Self {
        let mut flags = vec![false; all];
        chosen.for_each(|entry| flags[entry as usize] = true);
        Self { flags }
    }

    fn contains(&self, entry: u32) -> bool {
        self.flags[entry as usize]
    }

    fn insert(&mut self, entry: u32) {
        self.flags[entry as usize] = true;
    }

    fn is_empty(&self) -> bool {
        !self.flags.contains(&true)
    }

    fn iter(&self) -> impl Iterator<Item = u32> {
        (0..).zip(&self.flags).filter(|(_, chosen)| **chosen).map(|(entry, _)| entry)
    }
}

/// So far apart request and response may be.
const NEAR: usize = 3;

/// So few lines say nothing of each other.
const FEW: usize = 4;

/// Fewer bytes are only told by a person.
const SHORTEST: usize = 4;

/// The kinds of frames, as far as a text rarely mixes them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Family {
    Serial,
    Tcp,
    Profibus,
}

fn family(protocol: &Protocol) -> Family {
    match protocol.bus() {
        Bus::Modbus if protocol.is(&modbus_tcp::PROTOCOL) => Family::Tcp,
        Bus::Modbus => Family::Serial,
        Bus::Profibus => Family::Profibus,
    }
}

impl Traffic {
    /// Judges those of the first `count` entries that have no proof, and takes the telegrams out.
    pub(super) fn judge(&mut self, count: usize) -> Vec<Entry> {
        if self.weak.is_empty() && self.gone.is_empty() && self.short_frames() == 0 {
            let mut block = self.take_out(count, &Chosen::of(count, std::iter::empty()), Vec::new());
            self.take_turns(&mut block);
            return block;
        }
        let mut gone = Chosen::of(self.entries.len(), self.gone.drain(..));
        let later = self.weak.partition_point(|weak| (weak.entry as usize) < count);
        let later = self.weak.split_off(later);
        let mut weak = std::mem::replace(&mut self.weak, later);
        weak.retain(|weak| !gone.contains(weak.entry));
        // Who types telegrams types few lines that are none.
        let read = count - weak.iter().filter(|weak| !weak.read || weak.facts.slips).count();
        let typed = self.typed && (count <= FEW || read * 2 >= count);
        if typed && count == self.entries.len() && self.settled.is_empty() && self.context.is_none() {
            self.choose_typed(&mut weak);
        }
        self.settle_pdus(&weak, &gone);
        // What a block tells behind the beginning of the log is of itself only.
        let mut known = match &self.context {
            Some(context) => Known::behind(&context.known),
            None => std::mem::take(&mut self.known),
        };
        known.learn(self, count, &weak, &gone, typed);
        // Telegrams inside of what is none.
        let mut more: Vec<(u32, Vec<Entry>)> = Vec::new();
        for one in &weak {
            if self.weigh(one, &known, &gone) {
                self.accept(one, &known);
            } else if let Some(copies) = self.reject(one, &known, &mut gone) {
                more.push((one.entry, copies));
            }
        }
        self.take_out_foreign(count, &mut gone);
        let more = self.take_cut_copies(more, &known);
        if self.context.is_none() {
            self.known = known;
        }
        let mut block = self.take_out(count, &gone, more);
        self.take_turns(&mut block);
        block
    }

    /// Takes the first `count` entries out, but for those that are `gone`, and with `more` in place of some.
    fn take_out(&mut self, count: usize, gone: &Chosen, more: Vec<(u32, Vec<Entry>)>) -> Vec<Entry> {
        if gone.is_empty() && self.fresh_pauses.is_empty() {
            self.count_from(count, gone);
            let later = self.entries.split_off(count);
            return std::mem::replace(&mut self.entries, later);
        }
        let mut more = more.into_iter().peekable();
        let mut block = Vec::with_capacity(count);
        let mut pauses = self.fresh_pauses.drain(..).peekable();
        for (index, entry) in (0_u32..).zip(self.entries.drain(..count)) {
            let place = (self.settled.len() + block.len()) as u32;
            while let Some((_, pause)) = pauses.next_if(|(at, _)| *at == index) {
                self.pauses.push((place, pause));
            }
            if let Some((_, entries)) = more.next_if(|(at, _)| *at == index) {
                block.extend(entries);
            } else if !gone.contains(index) {
                block.push(entry);
            }
        }
        self.fresh_pauses = pauses.collect();
        self.count_from(count, gone);
        block
    }

    /// The first `count` entries are taken out: others are counted from the first that is left.
    fn count_from(&mut self, count: usize, gone: &Chosen) {
        let count = count as u32;
        self.gone = gone.iter().filter_map(|index| index.checked_sub(count)).collect();
        self.weak.iter_mut().for_each(|weak| weak.entry -= count);
        self.fresh_pauses.iter_mut().for_each(|(entry, _)| *entry -= count);
        for lane in &mut self.lanes {
            lane.held.take_if(|held| !held.count_from(count));
        }
    }

    /// `03 04 00 01 00 02` is a request of unit 3, or the answer to `03 00 01 00 02`: what was asked before tells.
    fn settle_pdus(&mut self, weak: &[Weak], gone: &Chosen) {
        for one in weak {
            let index = one.entry as usize;
            let entry = &self.entries[index];
            if !entry.protocol().is(&modbus_unchecked::PROTOCOL) {
                continue;
            }
            let asked = self.numbered(index.saturating_sub(NEAR), index).rfind(|(number, other)| {
                !gone.contains(*number) && other.port == entry.port && other.role != Role::Discarded
            });
            let own = bytes(entry, &self.data);
            let answers = asked.is_some_and(|(_, asked)| {
                let request = bytes(asked, &self.data);
                asked.protocol().is(&modbus_pdu::PROTOCOL)
                    && own.first() == request.first()
                    && self.splitter.answer_length(request) == Some(own.len())
            });
            if answers {
                let telegram = own.to_vec();
                self.retype(index, &telegram, &modbus_pdu::PROTOCOL, Verdict::NoCheck);
            }
        }
    }

    /// An entry without a proof is a telegram.
    fn accept(&mut self, one: &Weak, known: &Known) {
        let index = one.entry as usize;
        let entry = &mut self.entries[index];
        let copy = known.is_cut_copy(entry, &self.data);
        if one.cut || copy.is_some() {
            as_cut(entry);
        }
        entry.sides = copy.unwrap_or(entry.sides);
        // What has the numbers of a request is none of the other side, whatever its line says.
        let answers = matches!(entry.hint, Hint::Says(Direction::Response) | Hint::Other);
        if answers && entry.verdict == Verdict::Wrong && entry.sides == [true, false] {
            let structure = pdu(entry, &self.data).and_then(|pdu| evidence::structure(pdu, &self.splitter));
            if structure.is_some_and(|bits| bits >= CONVERSATION) {
                entry.hint = Hint::None;
            }
        }
        let response = entry.sides == [false, true];
        let checked = self.shapes.are_checked(one.facts.shape) && copy.is_none() && !one.cut;
        if checked && response && self.lacks_data(index) {
            let telegram = bytes(&self.entries[index], &self.data).to_vec();
            let verdict = (modbus_rtu::PROTOCOL.verdict)(&telegram);
            self.retype(index, &telegram, &modbus_rtu::PROTOCOL, verdict);
        }
    }

    /// An entry without a proof is none: returns the telegrams without their ends that are in it.
    fn reject(&mut self, one: &Weak, known: &Known, gone: &mut Chosen) -> Option<Vec<Entry>> {
        let whole = self.entries[one.entry as usize];
        let own = bytes(&whole, &self.data);
        let placed = one.facts.bare || one.facts.said || one.facts.dumped;
        let copies = if placed { known.cut_copies(own) } else { Vec::new() };
        if !copies.is_empty() {
            gone.insert(one.entry);
            let copy = |span: Span| Entry {
                at: whole.at + span.from as u64,
                written: whole.written.and_then(|written| written.behind(span.from)),
                skip: whole.skip + span.from as u16,
                length: span.len() as u16,
                ..whole
            };
            return Some(copies.into_iter().map(copy).collect());
        }
        let placed = self.shapes.is_proven(one.facts.shape) && !one.facts.abridged && !one.facts.rest;
        if !placed || self.repeats(one, gone) {
            gone.insert(one.entry);
            self.passed.push((whole.line, whole.offset));
            return None;
        }
        // The layout says that a telegram stands here: one that is cut or damaged, or noise.
        if one.cut {
            as_cut(&mut self.entries[one.entry as usize]);
            return None;
        }
        let like = own.get(1).is_some_and(|function| self.splitter.knows(*function)) && own[0] <= 247;
        if !like || known.families[Family::Tcp as usize] {
            let entry = &mut self.entries[one.entry as usize];
            (entry.role, entry.verdict) = (Role::Discarded, Verdict::NoCheck);
        }
        None
    }

    /// Who speaks where request and response take turns.
    fn take_turns(&self, block: &mut [Entry]) {
        if !self.turns {
            return;
        }
        let leaning = |entry: &Entry| match entry.protocol().speaker {
            Speaker::Turns(leaning) => Some(leaning),
            _ => None,
        };
        let leanings: Vec<i32> =
            block.iter().filter_map(|entry| Some(leaning(entry)?(bytes(entry, &self.data)))).collect();
        let mut guesses = turns(&leanings).into_iter();
        let mut before: Option<(Span, Direction)> = None;
        for entry in block {
            let place = Span::new(entry.at as usize, entry.at as usize + usize::from(entry.length));
            let Some(guess) = leaning(entry).and_then(|_| guesses.next()) else { continue };
            // A slave repeats what it wrote: byte for byte, where it sets the length, too.
            let repeats = before.is_some_and(|(asked, direction)| {
                direction == Direction::Request
                    && asked.of(&self.data) == place.of(&self.data)
                    && self.writes(entry)
            });
            let said = match entry.hint {
                Hint::Says(direction) => Some(direction),
                _ => None,
            };
            let told = match guess.certainty {
                _ if said.is_some() => said,
                Certainty::Certain => guess.told(),
                _ if repeats => Some(Direction::Response),
                _ => guess.told(),
            };
            if let Some(direction) = told.filter(|_| self.direction.is_none()) {
                entry.sides = [direction == Direction::Request, direction == Direction::Response];
            }
            before = Some((place, told.unwrap_or(guess.direction)));
        }
    }

    /// Whether a parameter channel asks to write.
    fn writes(&self, entry: &Entry) -> bool {
        let channel = Channel::read(bytes(entry, &self.data), Direction::Request, &self.settings.profibus);
        channel.service() == Service::Write
    }

    /// Makes entries of telegrams that were found without their ends.
    fn take_cut_copies(&mut self, mut more: Vec<(u32, Vec<Entry>)>, known: &Known) -> Vec<(u32, Vec<Entry>)> {
        for entry in more.iter_mut().flat_map(|(_, entries)| entries) {
            let own = bytes(entry, &self.data).to_vec();
            entry.set_protocol(&modbus_unchecked::PROTOCOL);
            (entry.verdict, entry.role) = (Verdict::NoCheck, Role::Plain);
            (entry.unit, entry.function) = (own.first().copied(), own.get(1).copied().unwrap_or_default());
            entry.sides = known.is_cut_copy(entry, &self.data).unwrap_or_default();
        }
        more
    }

    /// Where a person types nothing but telegrams, all of them together tell the protocol.
    fn choose_typed(&mut self, weak: &mut [Weak]) {
        /// So many bits speak for a protocol.
        const COMPANY: u32 = 5;
        /// And so many leave no doubt.
        const SURE: u32 = 16;
        let candidates: Vec<Candidate<'_>> = self
            .entries
            .iter()
            .map(|entry| Candidate {
                bytes: bytes(entry, &self.data),
                written_as: entry.protocol().is(&modbus_ascii::PROTOCOL).then_some(&modbus_ascii::PROTOCOL),
            })
            .collect();
        let choices: Vec<&'static Protocol> =
            protocols(&candidates, &self.settings).into_iter().map(|choice| choice.protocol).collect();
        // A telegram that looks like nothing by itself goes with those of its length that do.
        let fits = |protocol: &Protocol, bytes: &[u8]| (protocol.fit)(bytes, &self.settings).bits;
        let company: HashSet<(usize, &str)> = candidates
            .iter()
            .zip(&choices)
            .filter(|(candidate, chosen)| fits(chosen, candidate.bytes) > COMPANY)
            .map(|(candidate, chosen)| (candidate.bytes.len(), chosen.key))
            .collect();
        // Who prints one telegram without its check prints all so.
        let none_checked = self.entries.iter().all(|entry| entry.verdict != Verdict::Right)
            && weak.iter().any(|one| {
                let entry = &self.entries[one.entry as usize];
                one.read
                    && !one.cut
                    && entry.protocol().is(&modbus_unchecked::PROTOCOL)
                    && !self.lacks_data(one.entry as usize)
            });
        for one in weak {
            let chosen = choices[one.entry as usize];
            let index = one.entry as usize;
            let own = self.entries[index].protocol();
            let telegram = bytes(&self.entries[index], &self.data).to_vec();
            let bits = (chosen.fit)(&telegram, &self.settings).bits;
            let other = bits >= SURE
                || (family(chosen) != Family::Serial && bits > COMPANY + 2)
                || self.settings.bus.is_some_and(|bus| bus == chosen.bus() && bus != own.bus())
                || (self.lacks_data(index) && !one.cut && !none_checked && family(chosen) == Family::Serial)
                || !one.read
                || chosen.is(&modbus_ascii::PROTOCOL);
            one.read |= bits > 0 || company.contains(&(telegram.len(), chosen.key));
            if other && !chosen.is(own) {
                let verdict = (chosen.verdict)(&telegram);
                self.retype(index, &telegram, chosen, verdict);
                one.cut = false;
            }
        }
    }

    /// Whether an entry that was taken for one without its check is more likely one that lost some of its data:
    /// where its bytes count the data, two that are missing look so.
    fn lacks_data(&self, index: usize) -> bool {
        let entry = &self.entries[index];
        entry.protocol().is(&modbus_unchecked::PROTOCOL) && entry.length > 6
    }

    /// Whether an entry without a proof is a telegram.
    fn weigh(&self, one: &Weak, known: &Known, gone: &Chosen) -> bool {
        let entry = &self.entries[one.entry as usize];
        let own = bytes(entry, &self.data);
        let facts = &one.facts;
        // What one person types into an empty page is meant to be one.
        let alone = known.entries == 1 && !facts.array;
        let meant = one.read || alone || self.settings.bus.is_some();
        if known.typed && meant && !facts.abridged {
            return true;
        }
        // Nothing so short can be told from other things, but an exception where a request waits for its answer.
        let in_conversation = self.is_in_conversation(one, own, gone);
        let exception = entry.function & EXCEPTION != 0 && one.read && in_conversation;
        if own.len() < SHORTEST && *own != [profibus_fdl::SC] && !exception {
            return false;
        }
        let copies = known.copies(entry, &self.data);
        // What stands below each other and was seen with its check is explained there, field by field.
        let explained = facts.column && (copies || !in_conversation);
        let amiss = (facts.abridged && one.cut) || facts.slips || explained;
        if amiss || self.repeats(one, gone) {
            return false;
        }
        let placed = (facts.said || facts.bare || facts.dumped) && !facts.of_leftovers;
        let copies = copies && (placed || known.misprints(entry, &self.data));
        if !one.read {
            return copies;
        }
        let family = family(entry.protocol());
        let mut bits = one.bits + self.shapes.bits(facts.shape);
        bits += if entry.verdict == Verdict::Wrong && known.misprinted { MISPRINTED } else { 0 };
        bits += if entry.verdict == Verdict::Right { SAME } else { 0 };
        bits += if copies { SAME } else { 0 };
        let seen = entry.unit.is_some_and(|unit| known.has_seen(unit, entry.function));
        bits += if seen { SEEN } else { 0 };
        if known.families.iter().any(|seen| *seen) && !known.families[family as usize] {
            bits += OTHER_KIND;
        }
        if known.typed {
            bits += CONVERSATION;
        }
        if let [profibus_fdl::SC] = own {
            bits += if known.families[Family::Profibus as usize] { SAME } else { OTHER_KIND };
        }
        if in_conversation {
            bits += CONVERSATION;
        } else if one.awaited && !self.is_awaited(one, gone) {
            bits -= CONVERSATION;
        }
        let of_columns = if facts.column { evidence::threshold(self.in_columns) } else { 0 };
        bits >= known.threshold.max(of_columns)
    }

    /// Whether an entry answers one of those just before it, or is answered by one just behind.
    fn is_in_conversation(&self, one: &Weak, own: &[u8], gone: &Chosen) -> bool {
        /// So far away they may be.
        const FAR: usize = 32;
        let index = one.entry as usize;
        let entry = &self.entries[index];
        // Columns meet those beside them, and what is proven; the same one may be among them twice.
        let beside = |other: &Entry| {
            let fits = other.line == entry.line || other.verdict == Verdict::Right;
            !one.facts.column || (fits && bytes(other, &self.data) != own)
        };
        let near = |other: &(u32, &Entry)| {
            let same_port = other.1.port == entry.port;
            !gone.contains(other.0) && same_port && other.1.role != Role::Discarded && beside(other.1)
        };
        // Single bytes, as a column of them gives, are none of those.
        let long = |other: &(u32, &Entry)| other.1.length > 1;
        let before = self.numbered(index.saturating_sub(FAR), index).rev().filter(long).take(NEAR);
        let behind = self.numbered(index + 1, index + 1 + FAR).filter(long).take(NEAR);
        let fits = |request: &Entry, response: &Entry| self.answers(request, response, one.cut);
        before.clone().filter(near).any(|(_, other)| fits(other, entry))
            || (!one.cut && behind.clone().filter(near).any(|(_, other)| fits(entry, other)))
            || channel(own).is_some_and(|own| {
                let mut others = before.chain(behind).filter(near);
                others.any(|(_, other)| channel(bytes(other, &self.data)) == Some(own))
            })
    }

    /// Whether the request whose answer an entry may be is still taken for one.
    fn is_awaited(&self, one: &Weak, gone: &Chosen) -> bool {
        /// So far away it may be.
        const NEAR: usize = 16;
        let index = one.entry as usize;
        let entry = &self.entries[index];
        self.numbered(index.saturating_sub(NEAR), index).any(|(number, other)| {
            !gone.contains(number)
                && (other.port, other.unit) == (entry.port, entry.unit)
                && other.function == entry.function & !EXCEPTION
        })
    }

    /// The entries `from` to `to`, as far as there are so many, with their numbers.
    fn numbered(&self, from: usize, to: usize) -> impl DoubleEndedIterator<Item = (u32, &Entry)> + Clone {
        let entries = Span::new(from, to.max(from)).of(&self.entries);
        entries.iter().enumerate().map(move |(at, entry)| ((from + at) as u32, entry))
    }

    /// Whether an entry is a part of a telegram near it, as where a program prints its data again.
    fn repeats(&self, one: &Weak, gone: &Chosen) -> bool {
        const NEAR: usize = 8;
        let index = one.entry as usize;
        let own = bytes(&self.entries[index], &self.data);
        let mut near = self.numbered(index.saturating_sub(NEAR), index + NEAR);
        own.len() > 2
            && near.any(|(number, other)| {
                let right = other.verdict == Verdict::Right && !gone.contains(number);
                right
                    && bytes(other, &self.data)
                        .get(1..)
                        .is_some_and(|rest| rest.windows(own.len()).any(|part| part == own))
            })
    }

    /// Whether one telegram can be the answer to another.
    fn answers(&self, request: &Entry, response: &Entry, cut: bool) -> bool {
        let (Some(asked), Some(answer)) = (pdu(request, &self.data), pdu(response, &self.data)) else {
            return false;
        };
        let same_unit = match (request.unit, response.unit) {
            (Some(asked), Some(answers)) => asked == answers,
            _ => true,
        };
        let (Some(function), Some(code)) = (asked.first(), answer.first()) else { return false };
        // Of a function that is not known, the length says neither.
        if !same_unit || code & !EXCEPTION != *function || request.sides == [false, true] {
            return false;
        }
        if code & EXCEPTION != 0 {
            return answer.len() == 2;
        }
        if request.protocol().is(&modbus_tcp::PROTOCOL) && response.protocol().is(&modbus_tcp::PROTOCOL) {
            return bytes(request, &self.data)[..2] == bytes(response, &self.data)[..2];
        }
        // The answer to a write of one value repeats it.
        if matches!(function, 5 | 6 | 22) && !cut && response.verdict != Verdict::Wrong {
            return asked == answer;
        }
        match self.splitter.answer_length(asked) {
            Some(length) if cut => {
                answer.len() < length && answer.get(1).is_none_or(|count| usize::from(*count) + 2 == length)
            }
            Some(length) => answer.len() == length && response.sides[1],
            None => false,
        }
    }

    /// Where the short frames of M-Bus and IEC 60870-5 were seen, frames like those of PROFIBUS are theirs, too.
    fn take_out_foreign(&mut self, count: usize, gone: &mut Chosen) {
        let own = self.entries[..count].iter().filter(|entry| {
            entry.protocol().is(&profibus_fdl::PROTOCOL)
                && bytes(entry, &self.data).first() == Some(&profibus_fdl::SD1)
        });
        if (self.short_frames() as usize) <= own.count() {
            return;
        }
        for (index, entry) in (0_u32..).zip(&self.entries[..count]) {
            if entry.protocol().is(&profibus_fdl::PROTOCOL) {
                gone.insert(index);
                self.passed.push((entry.line, entry.offset));
            }
        }
    }
}

/// The bytes of a telegram, and which sides it can be of.
type Sided = (Vec<u8>, [bool; 2]);

/// What the text as a whole says of what is without a proof: most of it by the telegrams that have one.
#[derive(Debug, Default)]
pub(super) struct Known {
    /// Who typed it typed hardly anything but telegrams.
    typed: bool,
    /// How many entries there are.
    entries: usize,
    /// How many without a proof look like telegrams.
    read: usize,
    /// How many bits it takes.
    threshold: i32,
    /// No check is right, and some that are wrong leave no doubt: they were not computed.
    misprinted: bool,
    /// Units with their functions.
    seen: Seen,
    /// Of which [`Family`] there are some.
    families: [bool; 3],
    /// The telegrams on serial lines by their first bytes, and which sides they can be of.
    bodies: HashMap<[u8; 4], Vec<Sided>>,
    /// What the beginning of the log told.
    beginning: Option<Arc<Self>>,
}

impl Known {
    /// Begins with what the beginning of a log told.
    fn behind(beginning: &Arc<Self>) -> Self {
        let Self { entries, read, families, .. } = **beginning;
        Self { entries, read, families, beginning: Some(Arc::clone(beginning)), ..Self::default() }
    }

    fn has_seen(&self, unit: u8, function: u8) -> bool {
        let before = self.beginning.as_ref().is_some_and(|it| it.seen.contains(unit, function));
        before || self.seen.contains(unit, function)
    }

    /// Learns from the next `count` entries, of which these are `weak`.
    fn learn(&mut self, traffic: &Traffic, count: usize, weak: &[Weak], gone: &Chosen, typed: bool) {
        /// More that begin alike are a log whose lines tell enough.
        const MOST: usize = 16;
        /// And so are so many that begin in other ways.
        const MOST_BEGINNINGS: usize = 1 << 14;
        let without = Chosen::of(count, weak.iter().map(|weak| weak.entry));
        self.typed = typed;
        self.entries += count;
        self.read += weak.iter().filter(|weak| weak.read).count();
        self.threshold = evidence::threshold(self.read);
        // Delimiters and lengths tell a frame of PROFIBUS, whatever its sum.
        self.families[Family::Profibus as usize] |= weak.iter().any(|weak| {
            let entry = &traffic.entries[weak.entry as usize];
            weak.bits >= SAME && entry.length > 3 && entry.protocol().is(&profibus_fdl::PROTOCOL)
        });
        let entry = |weak: &Weak| &traffic.entries[weak.entry as usize];
        self.misprinted = traffic.entries[..count].iter().all(|entry| entry.verdict != Verdict::Right)
            && weak.iter().any(|weak| entry(weak).verdict == Verdict::Wrong && weak.bits >= self.threshold);
        for (index, entry) in (0_u32..).zip(&traffic.entries[..count]) {
            if without.contains(index) || gone.contains(index) || entry.role == Role::Discarded {
                continue;
            }
            self.families[family(entry.protocol()) as usize] = true;
            if let Some(unit) = entry.unit {
                self.seen.insert(unit, entry.function);
            }
            let own = bytes(entry, &traffic.data);
            if let (true, Some(first)) = (entry.protocol().is(&modbus_rtu::PROTOCOL), own.first_chunk())
                && entry.verdict == Verdict::Right
            {
                let room = self.bodies.len() < MOST_BEGINNINGS;
                let alike = match self.bodies.get_mut(first) {
                    None if room => self.bodies.entry(*first).or_default(),
                    None => continue,
                    Some(alike) => alike,
                };
                if alike.len() < MOST && alike.iter().all(|(body, _)| body != own) {
                    alike.push((own.to_vec(), entry.sides));
                }
            }
        }
    }

    /// The telegrams that begin as `own` does.
    fn alike(&self, own: &[u8]) -> impl Iterator<Item = &Sided> {
        let knows = self.beginning.as_deref().into_iter().chain([self]);
        knows.filter_map(|known| known.bodies.get(own.first_chunk()?)).flatten()
    }

    /// Whether an entry is a telegram that was seen, with another check, without one, or without its end.
    fn copies(&self, entry: &Entry, data: &[u8]) -> bool {
        let own = bytes(entry, data);
        let begins = |known: &[u8]| (own.len() + 3 >= known.len() || own.len() > 6) && known.starts_with(own);
        self.misprints(entry, data) || self.alike(own).any(|(known, _)| begins(known))
    }

    /// Whether it is one with another check.
    fn misprints(&self, entry: &Entry, data: &[u8]) -> bool {
        let own = bytes(entry, data);
        let body = &own[..own.len().saturating_sub(2)];
        entry.verdict == Verdict::Wrong && self.alike(own).any(|(known, _)| known[..known.len() - 2] == *body)
    }

    /// If it is one without its end: which sides that can be of.
    fn is_cut_copy(&self, entry: &Entry, data: &[u8]) -> Option<[bool; 2]> {
        let own = bytes(entry, data);
        let whole = self.alike(own).find(|(known, _)| known.starts_with(own));
        whole.map(|(_, sides)| *sides)
    }

    /// Where in bytes telegrams that were seen stand without their last byte or two, again and again.
    fn cut_copies(&self, own: &[u8]) -> Vec<Span> {
        let mut found = Vec::new();
        let mut at = 0;
        while at < own.len() {
            let length = |known: &[u8]| {
                (1..=2)
                    .map(|missing| known.len() - missing)
                    .find(|length| own[at..].starts_with(&known[..*length]))
            };
            match self.alike(&own[at..]).find_map(|(known, _)| length(known)) {
                Some(length) => {
                    found.push(Span::new(at, at + length));
                    at += length;
                }
                None => at += 1,
            }
        }
        found
    }
}

/// An entry whose end is missing has no check.
fn as_cut(entry: &mut Entry) {
    if entry.verdict == Verdict::Wrong {
        entry.verdict = Verdict::NoCheck;
        entry.set_protocol(&modbus_unchecked::PROTOCOL);
    }
}

/// The PDU of a Modbus telegram.
fn pdu<'a>(entry: &Entry, data: &'a [u8]) -> Option<&'a [u8]> {
    let own = bytes(entry, data);
    match entry.protocol().speaker {
        Speaker::Pdu(inside) => Some(inside(own).0),
        _ => None,
    }
}

/// Index and value of what may be a parameter channel: request and confirmation have both in common.
fn channel(own: &[u8]) -> Option<&[u8]> {
    (own.len() == 8 && own[2..4] != [0, 0]).then(|| &own[1..4])
}
