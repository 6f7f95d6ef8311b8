//! Telegrams of a log read as far as anywhere else: with all their fields.

use super::places::Places;
use super::{Bytes, Entry, Format, Log, Role, Source, State, time_text};
use crate::dialogue::traffic::latency;
use crate::dialogue::{self, Candidate, Certainty, Choice, Guess};
use crate::field::{Direction, Span};
use crate::frame::{Speaker, Verdict, modbus_ascii, modbus_unchecked};
use crate::message;
use crate::text::{self, Line};
use crate::tool::decode::{Options, Report, Summary, Telegram};

impl Log {
    /// The telegrams `indices` of the log, in that order, as a report. A request and its response
    /// know each other where both are among them; what telegrams before them said of how the devices
    /// are set up is known.
    pub fn report(&self, source: &dyn Source, indices: &[usize]) -> Report {
        let lessons = self.lessons(source, indices);
        let all: Vec<usize> = lessons.iter().chain(indices).copied().collect();
        // Each part is in the log's order, unless a person chose otherwise.
        let ordered = indices.is_sorted();
        let place = |index: usize| match lessons.binary_search(&index) {
            Ok(at) => Some(at),
            Err(_) if ordered => indices.binary_search(&index).ok().map(|at| at + lessons.len()),
            Err(_) => indices.iter().position(|other| *other == index).map(|at| at + lessons.len()),
        };
        let mut places = Places::new(self, source);
        let telegrams = all.iter().filter_map(|index| {
            let entry = self.entries().get(*index)?;
            let partner = entry.partner().and_then(place);
            let number = partner.map(|place| all[place] + 1);
            let mut telegram = Telegram { number: index + 1, ..self.telegram(&entry, &mut places, number) };
            match entry.direction {
                Direction::Request => telegram.answered_by = partner,
                Direction::Response => telegram.answers = partner,
            }
            Some(telegram)
        });
        let mut report = Report::of(telegrams.collect(), self.options.clone());
        report.forget(lessons.len());
        report
    }

    /// A report of telegram `index` with what tells more of it, and its place in that.
    pub fn report_of(&self, source: &dyn Source, index: usize) -> (Report, usize) {
        let context = self.context(index);
        let place = context.binary_search(&index).unwrap_or_default();
        (self.report(source, &context), place)
    }

    /// The telegrams `indices` and those that answer them or that they answer, in the log's order.
    pub fn with_partners(&self, indices: impl Iterator<Item = usize>) -> Vec<usize> {
        let partner = |index: usize| self.entries().get(index).and_then(|entry| entry.partner());
        let mut all: Vec<usize> = indices.flat_map(|index| [Some(index), partner(index)]).flatten().collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// What tells more of telegram `index`, in order, itself included: its partner, and for jobs of a
    /// parameter channel what was asked before.
    fn context(&self, index: usize) -> Vec<usize> {
        /// A job takes a few cycles.
        const CYCLES: usize = 30;
        let Some(entry) = self.entries().get(index) else { return Vec::new() };
        let modbus = matches!(entry.protocol().speaker, Speaker::Pdu(_));
        let first = if modbus { index } else { index.saturating_sub(CYCLES) };
        let same = |other: &usize| {
            let other = self.entry(*other);
            other.counts() && (other.port, other.unit) == (entry.port, entry.unit)
        };
        let mut context: Vec<usize> =
            (first..index).filter(same).chain(entry.partner()).chain([index]).collect();
        context.sort_unstable();
        context.dedup();
        context
    }

    /// The report of all telegrams, without what is no telegram or is there twice.
    pub fn whole_report(&self, source: &dyn Source) -> Report {
        let counted = self.entries().iter().enumerate().filter(|(_, entry)| entry.counts());
        let indices: Vec<usize> = counted.map(|(index, _)| index).collect();
        let mut report = self.report(source, &indices);
        // Whoever gets all of them need not know what was left out.
        report.telegrams.iter_mut().zip(1..).for_each(|(telegram, number)| telegram.number = number);
        // The last one may still be answered.
        if let Some(last) = report.telegrams.last_mut().filter(|last| last.state == Some(State::Unanswered)) {
            last.state = Some(State::Plain);
        }
        let statistics = self.statistics();
        report.counted = Some(Summary {
            telegrams: report.telegrams.len(),
            check_failed: statistics.check_failed,
            checked: report
                .telegrams
                .iter()
                .filter(|it| matches!(it.verdict, Verdict::Right | Verdict::Wrong))
                .count(),
            unchecked: statistics.unchecked,
            pairs: statistics.pairs,
            unanswered: statistics.unanswered,
            unpaired: statistics.unasked,
            lines: self.lines as usize,
            lines_not_understood: self.unread().len(),
            bytes_discarded: statistics.bytes_discarded,
            layout: Some(self.format.key()),
        });
        report
    }

    /// The same of a text that a person types: with what is wrong in lines that should be bytes, and what lines
    /// mean that show a display.
    pub(super) fn typed_report(&self, text: &str) -> Report {
        let mut report = self.whole_report(&text.as_bytes());
        report.style = match self.format {
            Format::Text { style, .. } if !report.telegrams.is_empty() => style,
            _ => None,
        };
        report.line_count = self.lines as usize;
        /// Nobody reads more of them.
        const MOST_LINES: usize = 10_000;
        const MOST_REMARKS: usize = 500;
        let mut said: usize = report.telegrams.iter().map(|telegram| telegram.line.remarks.len()).sum();
        for telegram in report.telegrams.iter_mut().skip(MOST_REMARKS) {
            telegram.line.remarks.clear();
        }
        let lines = self.unread().iter().take(MOST_LINES).map(|(number, offset)| {
            let from = offset as usize;
            let line = text.get(from..).unwrap_or_default();
            let line = line.split(['\n', '\r']).next().unwrap_or_default();
            let span = Span::new(from, from + line.len());
            let display = report.explain_display(line, span);
            let remarks = match display {
                Some(remark) => vec![remark],
                None if said < MOST_REMARKS && text::looks_typed(line) => text::remarks(line, from, &[]),
                None => Vec::new(),
            };
            said += remarks.len();
            Line { number: number as usize, span, remarks, ..Line::default() }
        });
        let lines: Vec<Line> = lines.collect();
        report.not_understood = lines;
        report
    }

    /// Writes that set up what others mean, before the first of `indices`, with their responses.
    fn lessons(&self, source: &dyn Source, indices: &[usize]) -> &[usize] {
        /// Older ones were written over, or the device has forgotten them.
        const MOST: usize = 200;
        let first = indices.iter().copied().min().unwrap_or_default();
        let teaching = self.teaching.get_or_init(|| self.find_lessons(source));
        let before = teaching.partition_point(|index| *index < first);
        &teaching[before.saturating_sub(MOST)..before]
    }

    /// Finds the writes that set up what others mean, for the device that is chosen.
    fn find_lessons(&self, source: &dyn Source) -> Vec<usize> {
        if self.options.devices().next().is_none() {
            return Vec::new();
        }
        let mut bytes = Bytes::new(self, source);
        let mut teaches = |entry: &Entry| {
            matches!(entry.function, 6 | 16 | 100 | 101)
                && entry.direction == Direction::Request
                && self.registers_in(&mut bytes, entry).is_some_and(|(start, count)| {
                    let device = self.options.device_of(entry.unit);
                    device.is_some_and(|device| {
                        (start..=start.saturating_add(count)).any(|address| device.teaches(address))
                    })
                })
        };
        let entries = self.entries().iter().enumerate();
        let mut found = Vec::new();
        for (index, entry) in entries.filter(|(_, entry)| teaches(entry)) {
            found.extend(entry.partner());
            found.push(index);
        }
        found.sort_unstable();
        found
    }

    /// Takes the bytes for those of another device, or of one that is set up in another way.
    pub fn set_options(&mut self, options: Options) {
        self.options = Options { protocol: self.options.protocol, ..options };
        self.options.take_device();
        self.teaching.take();
    }

    /// A telegram as an entry; its partner has this `number`.
    fn telegram(&self, entry: &Entry, places: &mut Places<'_>, number: Option<usize>) -> Telegram {
        let line = self.line(entry, places);
        Telegram {
            number: 0,
            unit: entry.unit,
            choice: self.choice_of(entry, &line),
            guess: self.guess(entry, &line.bytes, places, number),
            verdict: entry.verdict,
            answers: None,
            answered_by: None,
            step: None,
            time: entry.time().map(time_text),
            latency: self.latency(entry),
            state: Some(self.state(entry)),
            comment: String::new(),
            line,
        }
    }

    /// Its protocol, what speaks for it, and what else it could be.
    fn choice_of(&self, entry: &Entry, line: &Line) -> Choice {
        let protocol = entry.protocol();
        if self.options.protocol.is_some_and(|chosen| chosen.is(protocol)) {
            return Choice { protocol, reason: message!("set by hand"), others: Vec::new() };
        }
        let written_as = line.colon.then_some(&modbus_ascii::PROTOCOL);
        let candidate = Candidate { bytes: &line.bytes, written_as };
        let own = dialogue::protocols(&[candidate], &self.options.settings.frame).swap_remove(0);
        let Choice { protocol: told, reason, mut others } = own;
        if told.is(protocol) {
            return Choice { protocol, reason, others };
        }
        others.retain(|(other, _)| !other.is(protocol));
        let reason = if protocol.is(&modbus_unchecked::PROTOCOL) {
            message!("unit, function and length fit a telegram whose checksum was not printed")
        } else if protocol.is(self.choice.protocol) {
            message!("its neighbours are of this protocol, and nothing fits better")
        } else {
            message!("function code and length fit, and so does its place in the text")
        };
        Choice { protocol, reason, others }
    }

    /// Who speaks, and why: by the bytes, and where those leave it open, by what the text says and by the
    /// telegram that it answers or that answers it, which has this `number`.
    fn guess(&self, entry: &Entry, bytes: &[u8], places: &mut Places<'_>, number: Option<usize>) -> Guess {
        let direction = entry.direction;
        let guess = |certainty, reason| Guess { direction, certainty, reason };
        if self.options.direction == Some(direction) {
            return guess(Certainty::Certain, message!("set by hand"));
        }
        if entry.role == Role::Echo {
            let reason = message!("it is the request before it, come back over the same wires");
            return guess(Certainty::Certain, reason);
        }
        if entry.role == Role::Retry && number.is_none() && !entry.is_said() {
            return guess(Certainty::Likely, message!("the same was asked just before, without an answer"));
        }
        let protocol = entry.protocol();
        let own = match protocol.speaker {
            Speaker::Pdu(inside) => {
                let (pdu, around) = inside(bytes);
                let awaited = direction == Direction::Response && entry.partner().is_some();
                dialogue::direction(pdu, around, awaited, self.options.settings.frame.dialect)
            }
            Speaker::Frame(told) => dialogue::told(told(bytes), message!("its frame says so")),
            Speaker::Always(direction) => {
                dialogue::told(Some(direction), message!("such telegrams go one way only"))
            }
            Speaker::Turns(leaning) => dialogue::leaning(leaning(bytes)),
        };
        let turns = matches!(protocol.speaker, Speaker::Turns(_));
        if protocol.is(&modbus_unchecked::PROTOCOL) && own.certainty != Certainty::Certain && number.is_none()
        {
            let reason = match direction {
                Direction::Response => message!("its byte count says that it is the beginning of a response"),
                Direction::Request => message!("a checksum is added to what is sent"),
            };
            return guess(Certainty::Likely, reason);
        }
        if own.certainty != Certainty::Open && own.direction == direction && !(turns && number.is_some()) {
            return own;
        }
        let asked = entry.partner().map(|partner| places.bytes.of(&self.entry(partner)));
        match (number, direction) {
            (Some(_), Direction::Response) if turns && asked == Some(bytes) => {
                guess(Certainty::Likely, message!("it repeats the request before it, as a confirmation does"))
            }
            _ if turns && number.is_some() => {
                guess(Certainty::Likely, message!("request and response take turns"))
            }
            (Some(n), Direction::Request) => {
                guess(Certainty::Likely, message!("telegram {n} answers it", n = n))
            }
            (Some(n), Direction::Response) => {
                let reason = if asked == Some(bytes) {
                    message!("it repeats telegram {n}, as a response of this function does", n = n)
                } else {
                    message!("telegram {n} waits for such a response", n = n)
                };
                guess(Certainty::Likely, reason)
            }
            (None, _)
                if entry.sides() == [direction == Direction::Request, direction == Direction::Response] =>
            {
                let reason = message!("the telegrams around it tell");
                guess(Certainty::Likely, reason)
            }
            (None, _) if entry.is_said() => guess(Certainty::Likely, message!("the text says who speaks")),
            // A person who types one telegram may mean either.
            (None, Direction::Request)
                if entry.sides() == [true; 2] && self.entries().len() + self.unread().len() > 1 =>
            {
                let reason = message!("it could be a response, too, but no such request stands before it");
                guess(Certainty::Likely, reason)
            }
            (None, _) => guess(own.certainty, own.reason),
        }
    }

    /// Microseconds between a response and its request.
    pub fn latency(&self, entry: &Entry) -> Option<u32> {
        let (own, partner) = (entry.time(), self.entries().time(entry.partner()?));
        match entry.direction {
            Direction::Request => latency(partner, own),
            Direction::Response => latency(own, partner),
        }
    }

    /// The bytes of a telegram with their places in the file.
    fn line(&self, entry: &Entry, places: &mut Places<'_>) -> Line {
        let bytes = places.bytes.of(entry).to_vec();
        let number = entry.line as usize;
        if entry.line == 0 {
            let from = entry.offset as usize;
            let places = match self.format {
                Format::Stream => (from..from + bytes.len()).map(|at| Span::new(at, at + 1)).collect(),
                _ => Vec::new(),
            };
            let span = Span::new(from, from + places.len());
            return Line { number, span, places, bytes, ..Line::default() };
        }
        let (places, remarks) = places.of(entry);
        let span = match (places.first(), places.last()) {
            (Some(first), Some(last)) => Span::new(first.from, last.to),
            _ => Span::new(entry.offset as usize, entry.offset as usize),
        };
        let colon = entry.protocol().is(&modbus_ascii::PROTOCOL);
        Line { number, span, places, bytes, colon, remarks }
    }

    /// The line of the file that begins at `offset`, as text.
    pub fn text_at(&self, source: &dyn Source, offset: u64, length: usize) -> String {
        let text = self.piece_at(source, offset, length);
        text.split(['\n', '\r']).next().unwrap_or_default().to_owned()
    }

    /// Up to `length` bytes of the file from `offset` on, as text; each byte that is no UTF-8 is one
    /// character of ASCII in it, so that places stay as they are.
    pub fn piece_at(&self, source: &dyn Source, offset: u64, length: usize) -> String {
        let bytes = self.read_again(source, offset, length);
        let mut text = String::with_capacity(bytes.len());
        for chunk in bytes.utf8_chunks() {
            text.push_str(chunk.valid());
            text.extend(chunk.invalid().iter().map(|_| '?'));
        }
        text
    }

    /// How the log is read as far as the devices go.
    pub fn options(&self) -> &Options {
        &self.options
    }
}
