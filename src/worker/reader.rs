//! A log that is read, and the answers to what is asked about it. It knows nothing of workers: small logs
//! are read where the page is.

use std::collections::BTreeMap;
use std::ops::Range;

use super::messages::{Answer, Choice, Export, Found, Passed, Proposed, Request, Shown, Value, Which};
use buslens::field::hex;
use buslens::tool::digest::Digest;
use buslens::tool::log::{Bytes, CaptureFile, Entry, Filter, Finding, Hidden, Log, Role, Source};
use buslens::tool::{annotated, csv, json};

/// How many stretches the timeline has.
const STRETCHES: usize = 200;

/// A log with what the page sees of it.
pub struct Reader<S> {
    log: Log,
    source: S,
    size: u64,
    findings: Vec<Finding>,
    chosen: Chosen,
    /// How many telegrams the page knows of, while the log is read.
    known: usize,
}

/// The telegrams that the list has.
enum Chosen {
    /// So many, the first ones.
    All(usize),
    /// Those with these indices.
    Some(Vec<u32>),
}

impl Chosen {
    fn len(&self) -> usize {
        match self {
            Self::All(count) => *count,
            Self::Some(indices) => indices.len(),
        }
    }

    /// The index of the telegram at a place of the list.
    fn at(&self, place: usize) -> Option<usize> {
        match self {
            Self::All(count) => (place < *count).then_some(place),
            Self::Some(indices) => indices.get(place).map(|index| *index as usize),
        }
    }

    /// The place of a telegram in the list.
    fn place(&self, index: usize) -> Option<usize> {
        match self {
            Self::All(count) => (index < *count).then_some(index),
            Self::Some(indices) => indices.binary_search(&(index as u32)).ok(),
        }
    }

    fn indices(&self, places: Range<usize>) -> Vec<u32> {
        places.map_while(|place| self.at(place)).map(|index| index as u32).collect()
    }
}

impl<S: Source> Reader<S> {
    /// A log that is read from `source`, which has `size` bytes.
    pub fn new(log: Log, source: S, size: u64) -> Self {
        let chosen = Chosen::All(log.entries().len());
        Self { log, source, size, findings: Vec::new(), chosen, known: 0 }
    }

    /// The log, to be read on.
    pub fn log(&mut self) -> &mut Log {
        &mut self.log
    }

    /// How many telegrams are read.
    pub fn telegrams(&self) -> usize {
        self.log.entries().len()
    }

    /// What is said of a log while it is read: at once, and whenever there is twice as much to see.
    pub fn growing(&mut self) -> Vec<Answer> {
        if self.telegrams() < (2 * self.known).max(1) {
            return Vec::new();
        }
        self.log.look();
        let shown = self.known > 0;
        self.grow();
        let (overview, lanes) = (self.log.overview(), self.log.lanes(None, STRETCHES));
        let list = self.chosen.len();
        vec![
            Answer::Growing(Box::new(overview)),
            Answer::Lanes(lanes),
            if shown { Answer::Grown(list) } else { Answer::List(list) },
        ]
    }

    /// The file ends, or is not read any further: tells of it what there is to say.
    pub fn finish(&mut self, tell: &mut dyn FnMut(Answer)) {
        self.log.finish();
        let shown = self.known > 0;
        self.grow();
        // What the page shows of the list stays where it is.
        let stays = shown && matches!(self.chosen, Chosen::All(_));
        let telegrams = self.telegrams();
        self.opening(&mut |answer| match answer {
            Answer::List(_) if stays => tell(Answer::Grown(telegrams)),
            answer => tell(answer),
        });
    }

    fn grow(&mut self) {
        self.known = self.telegrams();
        if let Chosen::All(count) = &mut self.chosen {
            *count = self.known;
        }
    }

    /// Tells what there is to say of a log that is read, each as soon as it is known.
    pub fn opening(&mut self, tell: &mut dyn FnMut(Answer)) {
        tell(Answer::Ready(Box::new(self.log.overview())));
        self.findings = self.log.findings(&self.source);
        let found = |finding: &Finding| Found {
            code: finding.code.to_owned(),
            text: finding.text.sentence() + ".",
            evidence: finding.evidence.clone(),
        };
        tell(Answer::Findings(self.findings.iter().map(found).collect()));
        tell(Answer::Beside {
            proposals: self.log.proposals(&self.source).iter().map(Proposed::of).collect(),
            seen: self.log.seen(&self.source),
        });
        tell(Answer::Lanes(self.log.lanes(None, STRETCHES)));
        tell(Answer::List(self.chosen.len()));
    }

    /// The answers to a request, but for exports, which may be large: see [`Reader::export`].
    pub fn answer(&mut self, request: &Request) -> Vec<Answer> {
        match request {
            Request::SetUp(how) => {
                self.log.set_options(how.options());
                let mut answers = Vec::new();
                self.opening(&mut |answer| answers.push(answer));
                answers
            }
            Request::List(choice) => {
                self.choose(choice);
                vec![Answer::List(self.chosen.len())]
            }
            Request::Lanes(between) => vec![Answer::Lanes(self.log.lanes(*between, STRETCHES))],
            Request::Rows { from, count } => {
                /// More do not fit on any screen.
                const MOST: usize = 200;
                let rows = self.chosen.indices(*from..from.saturating_add((*count).min(MOST)));
                vec![Answer::Rows { from: *from, rows: self.log.rows(&self.source, &rows) }]
            }
            Request::Show(which) => vec![self.show(*which)],
            Request::Series { unit, address } => vec![self.series(*unit, *address)],
            Request::Held => vec![Answer::Held(self.log.held(&self.source))],
            Request::Unread => vec![self.unread()],
            Request::Sample => vec![self.sample()],
            Request::Digest => vec![Answer::Digest(Box::new(self.digest()))],
            Request::Open(..)
            | Request::Read(_)
            | Request::Stop
            | Request::Export { .. }
            | Request::PassOn(_) => Vec::new(),
        }
    }

    fn choose(&mut self, choice: &Choice) {
        let finding = choice.finding.and_then(|index| self.findings.get(index));
        if finding.is_none() && choice.filter == Filter::default() {
            self.chosen = Chosen::All(self.telegrams());
            return;
        }
        let mut indices = self.log.filtered(&choice.filter, &self.source, self.size);
        if let Some(finding) = finding {
            indices.retain(|index| finding.evidence.binary_search(index).is_ok());
        }
        self.chosen = Chosen::Some(indices);
    }

    fn show(&self, which: Which) -> Answer {
        let entries = self.log.entries();
        let at = |place: usize| self.chosen.at(place);
        let wrong = |index: &usize| self.log.state(&self.log.entry(*index)).is_wrong();
        let index = match which {
            Which::At(place) => at(place),
            Which::Index(index) => Some(index).filter(|index| *index < entries.len()),
            Which::Wrong { from, forwards: true } => (from + 1..self.chosen.len()).filter_map(at).find(wrong),
            Which::Wrong { from, forwards: false } => {
                (0..from.min(self.chosen.len())).rev().filter_map(at).find(wrong)
            }
        };
        let Some(index) = index else { return Answer::NothingThere };
        let entry = &self.log.entry(index);
        let Some(row) = self.log.rows(&self.source, &[index as u32]).pop() else {
            return Answer::NothingThere;
        };
        let discarded = entry.role == Role::Discarded;
        Answer::Shown(Box::new(Shown {
            place: self.chosen.place(index),
            row,
            line: entry.line,
            about: about(entry).to_owned(),
            partner: entry.partner(),
            discarded: discarded.then(|| self.log.bytes(&self.source, entry).into_owned()),
            excerpt: if discarded { Default::default() } else { self.log.excerpt(&self.source, index) },
        }))
    }

    fn series(&self, unit: Option<u8>, address: u16) -> Answer {
        const MOST: usize = 600;
        let points = self.log.series(&self.source, unit, address, MOST);
        let value = |point: &buslens::tool::log::Point| Value {
            index: point.index,
            time: point.time,
            value: point.value,
        };
        Answer::Series(points.iter().map(value).collect())
    }

    fn unread(&self) -> Answer {
        const SHOWN: usize = 500;
        const LONGEST: usize = 300;
        let unread = self.log.unread();
        let text = |(line, offset): (u32, u64)| (line, self.log.text_at(&self.source, offset, LONGEST));
        Answer::Unread {
            lines: unread.iter().take(SHOWN).map(text).collect(),
            more: unread.len().saturating_sub(SHOWN),
        }
    }

    /// A line that holds a telegram, or else any line.
    fn sample(&self) -> Answer {
        const LONGEST: usize = 1000;
        let first = self.log.entries().iter().find(|entry| entry.line > 0).map(|entry| entry.offset);
        let offset = first.or(self.log.unread().iter().next().map(|(_, offset)| offset)).unwrap_or_default();
        Answer::Sample(self.log.text_at(&self.source, offset, LONGEST))
    }

    /// The log in short.
    fn digest(&self) -> Digest {
        self.log.digest(&self.source, &self.findings)
    }

    /// The log without what is to be hidden, and what there is to say of that.
    pub fn pass_on(&self, hidden: &Hidden) -> (Vec<u8>, Passed) {
        let mut redacted = self.log.redacted(&self.source, self.size, hidden);
        (std::mem::take(&mut redacted.file), Passed::of(redacted))
    }

    /// Writes the telegrams of the list, part by part.
    pub fn export(&self, kind: Export, notes: &BTreeMap<usize, String>, write: &mut dyn FnMut(&[u8])) {
        /// So many are read at a time.
        const AT_ONCE: usize = 2000;
        let mut capture = CaptureFile::default();
        match kind {
            Export::Csv => write(csv::head().as_bytes()),
            Export::Text => write(self.digest().text(true).as_bytes()),
            Export::Capture => write(&capture.begin()),
            _ => {}
        }
        for from in (0..self.chosen.len()).step_by(AT_ONCE) {
            let chosen = &self.chosen.indices(from..from + AT_ONCE)[..];
            let text = match kind {
                Export::Capture => {
                    let chosen: Vec<usize> = chosen.iter().map(|index| *index as usize).collect();
                    write(&capture.telegrams(&self.log, &self.source, &chosen, notes));
                    continue;
                }
                Export::Hex => self.hex(chosen),
                Export::Lines => self.lines(chosen),
                _ => self.read(chosen, kind, notes),
            };
            write(text.as_bytes());
        }
    }

    fn hex(&self, chosen: &[u32]) -> String {
        let mut bytes = Bytes::new(&self.log, &self.source);
        let entries = chosen.iter().map(|index| self.log.entry(*index as usize));
        entries.map(|entry| hex(bytes.of(&entry)) + "\n").collect()
    }

    /// The log's own lines.
    fn lines(&self, chosen: &[u32]) -> String {
        const LONGEST: usize = 4096;
        let mut last = None;
        let mut text = String::new();
        for entry in chosen.iter().map(|index| self.log.entry(*index as usize)) {
            if entry.line > 0 && last != Some(entry.offset) {
                text += &self.log.text_at(&self.source, entry.offset, LONGEST);
                text.push('\n');
            }
            last = Some(entry.offset);
        }
        text
    }

    /// What telegrams say, each by itself, with what their partners tell of them.
    fn read(&self, chosen: &[u32], kind: Export, notes: &BTreeMap<usize, String>) -> String {
        let chosen: Vec<usize> = chosen
            .iter()
            .map(|index| *index as usize)
            .filter(|index| self.log.entry(*index).counts())
            .collect();
        let read = self.log.with_partners(chosen.iter().copied());
        let mut report = self.log.report(&self.source, &read);
        for telegram in &mut report.telegrams {
            telegram.comment = notes.get(&telegram.number).cloned().unwrap_or_default();
        }
        let places = chosen.iter().filter_map(|index| read.binary_search(index).ok());
        let one = |place: usize| match kind {
            Export::Csv => csv::telegram(&report, place),
            Export::Text => format!("\n{}", annotated::telegram(&report, place)),
            _ => json::line(&report, place, kind == Export::JsonLinesWithFields) + "\n",
        };
        places.map(one).collect()
    }
}

/// What its place in the conversation says of a telegram.
fn about(entry: &Entry) -> &'static str {
    match entry.role {
        Role::Echo => "An echo: the request before it, heard by its own sender on the same wires.",
        Role::Retry => "A retry: the same request before it got no answer.",
        Role::Copy => "The log has it twice; this copy is not counted.",
        Role::Broadcast => "Nobody answers it: it is for all.",
        Role::Late => "It came after other requests were sent.",
        Role::Unasked => "The log has no request for it.",
        Role::Discarded => {
            "No telegram with a valid checksum begins here: noise, a telegram whose beginning was lost, or another \
             protocol."
        }
        _ if entry.unanswered() => "Nobody answered it.",
        Role::Plain => "",
    }
}
