//! Telegrams of a log read as far as anywhere else: with all their fields.

use super::{Entry, Format, Log, Role, Source, Way, time_text};
use crate::dialogue::traffic::latency;
use crate::dialogue::{Certainty, Choice, Guess};
use crate::field::{Direction, Span};
use crate::frame::{Speaker, Verdict, modbus_ascii};
use crate::message;
use crate::text::Line;
use crate::text::log::{Event, Reader};
use crate::tool::decode::{Options, Report, Summary, Telegram};

impl Log {
    /// The telegrams `indices` of the log, in that order, as a report. A request and its response
    /// know each other where both are among them; what telegrams before them said of how the devices
    /// are set up is known.
    pub fn report(&self, source: &dyn Source, indices: &[usize]) -> Report {
        let lessons = self.lessons(indices);
        let all: Vec<usize> = lessons.iter().chain(indices).copied().collect();
        // Each part is in the log's order, unless a person chose otherwise.
        let ordered = indices.is_sorted();
        let place = |index: usize| match lessons.binary_search(&index) {
            Ok(at) => Some(at),
            Err(_) if ordered => indices.binary_search(&index).ok().map(|at| at + lessons.len()),
            Err(_) => indices.iter().position(|other| *other == index).map(|at| at + lessons.len()),
        };
        let telegrams = all.iter().filter_map(|index| {
            let entry = self.entries().get(*index)?;
            let partner = entry.partner().and_then(place);
            let mut telegram = Telegram { number: index + 1, ..self.telegram(entry, source) };
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
        let partner = |index: usize| self.entries()[index].partner();
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
            let other = &self.entries()[*other];
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

    /// Writes that set up what others mean, before the first of `indices`, with their responses.
    fn lessons(&self, indices: &[usize]) -> &[usize] {
        /// Older ones were written over, or the device has forgotten them.
        const MOST: usize = 200;
        let first = indices.iter().copied().min().unwrap_or_default();
        let before = self.teaching.partition_point(|index| *index < first);
        &self.teaching[before.saturating_sub(MOST)..before]
    }

    /// Finds the writes that set up what others mean, for the device that is chosen.
    pub(super) fn find_lessons(&mut self) {
        let Some(profile) = self.options.device else {
            self.teaching.clear();
            return;
        };
        let teaches = |entry: &Entry| {
            matches!(entry.function, 6 | 16 | 100 | 101)
                && entry.direction == Direction::Request
                && self.registers(entry).is_some_and(|(start, count)| {
                    (start..=start.saturating_add(count)).any(|address| profile.teaches(address))
                })
        };
        let entries = self.entries().iter().enumerate();
        let mut found = Vec::new();
        for (index, entry) in entries.filter(|(_, entry)| teaches(entry)) {
            found.extend(entry.partner());
            found.push(index);
        }
        found.sort_unstable();
        self.teaching = found;
    }

    /// Takes the bytes for those of another device, or of one that is set up in another way.
    pub fn set_options(&mut self, options: Options) {
        self.options = Options { protocol: self.options.protocol, ..options };
        self.find_lessons();
    }

    fn telegram(&self, entry: &Entry, source: &dyn Source) -> Telegram {
        let line = self.line(entry, source);
        let protocol = entry.protocol();
        let (certainty, reason) = match entry.role {
            Role::Echo => {
                (Certainty::Certain, message!("it is the request before it, come back over the same wires"))
            }
            _ if entry.partner().is_some() => {
                (Certainty::Certain, message!("request and response fit each other"))
            }
            _ => (
                Certainty::Likely,
                message!("its length, its place in the log and what the log says of it tell"),
            ),
        };
        let own = protocol.is(self.choice.protocol);
        let reason_of_protocol =
            if own { self.choice.reason.clone() } else { message!("its own bytes prove it") };
        Telegram {
            number: 0,
            unit: entry.unit,
            choice: Choice { protocol, reason: reason_of_protocol, others: Vec::new() },
            guess: Guess { direction: entry.direction, certainty, reason },
            verdict: entry.verdict,
            answers: None,
            answered_by: None,
            step: None,
            time: entry.time().map(time_text),
            latency: self.latency(entry),
            comment: String::new(),
            line,
        }
    }

    /// Microseconds between a response and its request.
    pub fn latency(&self, entry: &Entry) -> Option<u32> {
        let partner = &self.entries()[entry.partner()?];
        match entry.direction {
            Direction::Request => latency(partner, entry),
            Direction::Response => latency(entry, partner),
        }
    }

    /// The bytes of a telegram with their places in the file.
    fn line(&self, entry: &Entry, source: &dyn Source) -> Line {
        let bytes = self.bytes(entry).to_vec();
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
        let places = self.places(entry, source);
        let span = match (places.first(), places.last()) {
            (Some(first), Some(last)) => Span::new(first.from, last.to),
            _ => Span::new(entry.offset as usize, entry.offset as usize),
        };
        let colon = entry.protocol().is(&modbus_ascii::PROTOCOL);
        Line { number, span, places, bytes, colon, ..Line::default() }
    }

    /// Reads the lines of a telegram again, for the places of its bytes.
    fn places(&self, entry: &Entry, source: &dyn Source) -> Vec<Span> {
        /// A line of a telegram has hardly more.
        const PART: usize = 4096;
        const MOST: usize = 1 << 18;
        let wanted = usize::from(entry.skip) + usize::from(entry.length);
        let offset = u64::from(entry.offset);
        let mut part = PART;
        loop {
            let text = match (&self.transcoded, &self.input) {
                (Some(text), _) => (&text.as_slice()).read(offset, part),
                (None, Way::Text(_)) => source.read(offset, part),
                _ => return Vec::new(),
            };
            let whole = text.len() < part;
            let mut places: Vec<Span> = Vec::new();
            let mut reader = Reader::starting_at(self.form.clone(), offset, entry.line);
            let mut take = |event: Event<'_>| {
                if let Event::Piece(piece) = event
                    && places.len() < wanted
                {
                    let base = piece.offset as usize;
                    let mut spans: Vec<Span> = piece.places.iter().map(|place| place.shifted(base)).collect();
                    // Two characters of Modbus ASCII are one byte.
                    if let [b':', ..] = piece.bytes
                        && modbus_ascii::from_characters(piece.bytes).is_some()
                    {
                        let pairs = spans[1..].chunks(2).take((piece.bytes.trim_ascii_end().len() - 1) / 2);
                        spans = pairs.map(|pair| Span::new(pair[0].from, pair[pair.len() - 1].to)).collect();
                    }
                    places.extend(spans);
                }
            };
            reader.push(&text, &mut take);
            reader.finish(&mut take);
            if places.len() >= wanted || whole || part >= MOST {
                let from = usize::from(entry.skip).min(places.len());
                let to = wanted.min(places.len());
                return places[from..to].to_vec();
            }
            part *= 4;
        }
    }

    /// The line of the file that begins at `offset`, as text.
    pub fn text_at(&self, source: &dyn Source, offset: u32, length: usize) -> String {
        let text = self.piece_at(source, offset, length);
        text.split(['\n', '\r']).next().unwrap_or_default().to_owned()
    }

    /// Up to `length` bytes of the file from `offset` on, as text; each byte that is no UTF-8 is one
    /// character of ASCII in it, so that places stay as they are.
    pub fn piece_at(&self, source: &dyn Source, offset: u32, length: usize) -> String {
        let mut bytes = match &self.transcoded {
            Some(text) => (&text.as_slice()).read(offset.into(), length),
            None => source.read(offset.into(), length),
        };
        while let Err(error) = std::str::from_utf8(&bytes) {
            let at = error.valid_up_to();
            bytes[at] = b'?';
        }
        String::from_utf8(bytes).unwrap_or_default()
    }

    /// How the log is read as far as the devices go.
    pub fn options(&self) -> &Options {
        &self.options
    }
}
