//! Logs: text that other programs wrote, with telegrams somewhere in its lines.
//!
//! The [`Reader`] takes a log in pieces of any size and gives the bytes that it finds, line by line:
//! a line may have times, counters, lengths, addresses and names before or after them, in hex or
//! decimal, with any separator; who speaks is told by words, arrows and brackets. Nothing has to be
//! known of a log for that; [`LAYOUTS`] only names those that are known.
//!
//! Everything takes linear time, and no line allocates.

mod dump;
mod encoding;
mod flow;
mod layouts;
mod line;
mod marks;
mod time;
mod words;

pub use encoding::{Encoding, encoding};
pub use flow::{Flow, flow};
pub use layouts::{EXPORTS, Export, LAYOUTS, Layout, export};
pub use line::Numbers;
pub use marks::{Marks, Place};
pub use words::Sender;

use crate::field::Span;
use dump::{Dump, Words};
use line::{Run, Scan};
use words::Weight;

/// How a log is to be read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Form {
    /// How numbers without a mark are written; `None` where each tells.
    pub numbers: Option<Numbers>,
    /// The first number counts the bytes behind it, see [`counted`].
    pub counted: bool,
    /// Each line has one byte.
    pub flow: Option<Flow>,
    /// What a person marked in one line.
    pub marks: Option<Marks>,
}

/// Something found in a log.
#[derive(Debug)]
pub enum Event<'a> {
    Piece(Piece<'a>),
    /// A line without bytes that is not empty.
    Unread {
        line: u32,
        offset: u64,
    },
}

/// Bytes that stand together: mostly a telegram, sometimes several, or a part of one.
#[derive(Debug)]
pub struct Piece<'a> {
    pub bytes: &'a [u8],
    /// Where each byte stands in its line.
    pub places: &'a [Span],
    /// Counted from 1.
    pub line: u32,
    /// Where the line begins in the file.
    pub offset: u64,
    /// Microseconds, see [`Reader`].
    pub time: Option<i64>,
    pub sender: Option<Sender>,
    /// What tells several lines or connections apart: `COM8`, `10.0.0.7:49152 – 10.0.0.1:502`.
    pub port: Option<&'a [u8]>,
    /// It continues the piece before it.
    pub joins: bool,
    /// Digits behind a colon, as Modbus ASCII has them.
    pub colon: bool,
    /// A row of a dump.
    pub dumped: bool,
}

/// Reads a log, piece by piece of the file.
///
/// Times are microseconds since 1970, since midnight or since some start, as the log gives them.
#[derive(Debug, Default)]
pub struct Reader {
    form: Form,
    scan: Scan,
    dump: Dump,
    /// The beginning of a line whose end has not come yet.
    carry: Vec<u8>,
    /// Where the carried line, or the next one, begins in the file.
    offset: u64,
    line: u32,
    after_return: bool,
    /// The line in hand is so long that its beginning was read already.
    long: bool,
    header: Option<Header>,
    /// The time of a line without bytes, for the dump below it.
    remembered: Option<i64>,
}

/// A line without bytes that says something about the next ones.
#[derive(Clone, Debug)]
struct Header {
    time: Option<i64>,
    sender: Option<Sender>,
    port: Vec<u8>,
    line: u32,
    offset: u64,
    /// How many bytes the last row below it has.
    row: usize,
}

/// A line longer than this is read in parts.
const LONGEST_LINE: usize = 1 << 16;

impl Reader {
    pub fn new(form: Form) -> Self {
        Self::starting_at(form, 0, 1)
    }

    /// Begins in the middle of a file.
    pub fn starting_at(form: Form, offset: u64, line: u32) -> Self {
        let scan = Scan::timed(form.flow.map(|flow| flow.unit));
        Self { form, scan, offset, line: line.saturating_sub(1), ..Self::default() }
    }

    /// Takes the next part of the file.
    pub fn push(&mut self, part: &[u8], sink: &mut dyn FnMut(Event<'_>)) {
        let mut rest = part;
        while let Some(end) = memchr::memchr2(b'\n', b'\r', rest) {
            let (line, ended) = rest.split_at(end);
            let newline = ended[0] == b'\n';
            if newline && self.after_return && line.is_empty() && self.carry.is_empty() {
                self.offset += 1;
            } else {
                self.end_line(line, sink);
                self.offset += 1;
            }
            self.after_return = !newline;
            rest = &ended[1..];
        }
        self.after_return &= rest.is_empty();
        self.carry.extend_from_slice(rest);
        if self.carry.len() > LONGEST_LINE {
            self.cut(sink);
        }
    }

    /// The file ends.
    pub fn finish(&mut self, sink: &mut dyn FnMut(Event<'_>)) {
        if !self.carry.is_empty() {
            self.end_line(&[], sink);
        }
        self.drop_header(sink);
    }

    /// How many lines were read.
    pub fn lines(&self) -> u32 {
        self.line
    }

    fn end_line(&mut self, end: &[u8], sink: &mut dyn FnMut(Event<'_>)) {
        let mut carry = std::mem::take(&mut self.carry);
        let length;
        if carry.is_empty() {
            length = end.len();
            self.read(end, sink);
        } else {
            carry.extend_from_slice(end);
            length = carry.len();
            self.read(&carry, sink);
            carry.clear();
        }
        self.carry = carry;
        self.offset += length as u64;
        self.long = false;
    }

    /// Reads what is there of a long line, in parts that end where no byte is cut.
    fn cut(&mut self, sink: &mut dyn FnMut(Event<'_>)) {
        let blank = |c: &u8| matches!(c, b' ' | b'\t' | b',' | b';' | b':' | b'-' | b'[' | b'<');
        let mut carry = std::mem::take(&mut self.carry);
        let mut from = 0;
        while carry.len() - from > LONGEST_LINE {
            let part = &carry[from..from + LONGEST_LINE];
            let length = part.iter().rposition(blank).filter(|at| *at > 0).unwrap_or(LONGEST_LINE);
            self.read(&part[..length], sink);
            self.long = true;
            self.offset += length as u64;
            from += length;
        }
        carry.drain(..from);
        self.carry = carry;
    }

    fn read(&mut self, line: &[u8], sink: &mut dyn FnMut(Event<'_>)) {
        self.line += u32::from(!self.long);
        if line.trim_ascii().is_empty() {
            return;
        }
        let row = if self.long { None } else { self.dump.row(line) };
        if row.is_none() && self.dump.ends(line) {
            return;
        }
        let marked = self.form.marks.as_ref().and_then(|marks| marks.bytes_from(line));
        let from = row.map_or(0, |row| row.from).max(marked.unwrap_or(0));
        let words = row.map(|row| row.words);
        match words {
            Some(Words::Octal) => self.scan.read_octal(line, from),
            _ => self.scan.read(line, from, self.form.numbers),
        }
        if self.form.counted {
            self.scan.drop_counts();
        }
        if words == Some(Words::LowFirst) {
            swap_words(&mut self.scan);
        }
        let time = match &self.form.marks {
            Some(marks) => marks.time(line).or(self.scan.time),
            None => self.scan.time,
        };
        let alone = self.scan.words == 0 && self.scan.time.is_none() && self.scan.runs.len() == 1;
        let least = |run: &Run| match () {
            () if row.is_some() || marked.is_some() || (alone && self.header.is_some()) => 1,
            () if alone => {
                if run.span.len() == 2 {
                    1
                } else {
                    2
                }
            }
            () if run.said && run.span.to + 2 >= line.trim_ascii_end().len() => 1,
            () if run.marked => 2,
            // One long number in a sentence.
            () if run.tokens() == 1 && !run.said && !run.colon => 5,
            () => 4,
        };
        let good = |run: &&Run| run.len() >= least(run);
        let several = self.scan.runs.iter().filter(|run| run.len() >= 4 && run.said).count() > 1;
        // Names and addresses can be hex, too; but what is said to be sent or received is no name.
        let weight = |run: &&Run| {
            let telegram = run.said && run.len() >= 4;
            (run.marked && (run.tokens() > 1 || telegram), telegram, run.len())
        };
        let best = match self.form.flow {
            Some(_) => flow::byte(&self.scan),
            None => self.scan.runs.iter().filter(good).max_by_key(weight),
        };
        let Some(best) = best else { return self.without_bytes(time, sink) };
        let header = self.header.as_mut().filter(|_| alone || row.is_some());
        let joined = header.as_ref().is_some_and(|header| header.row > 0);
        let fallback = header.as_ref().map(|header| (header.time, header.sender, header.port.clone()));
        if let Some(header) = header {
            header.row = best.len();
        }
        if let Some(row) = row {
            self.dump.read(row, best.len());
        }
        let after =
            self.scan.sender.filter(|(_, weight)| *weight == Weight::Strong).map(|(sender, _)| sender);
        let after = after.filter(|_| self.scan.runs.len() == 1);
        let (header_time, header_sender, header_port) = fallback.unwrap_or_default();
        let chosen = |run: &Run| if several { run.len() >= 4 && run.said } else { std::ptr::eq(run, best) };
        for run in self.scan.runs.iter().filter(|run| chosen(run)) {
            let said = run.sender.map(|(sender, _)| sender).or(after).or(header_sender);
            let port = if self.scan.port.is_empty() { &header_port } else { &self.scan.port };
            sink(Event::Piece(Piece {
                bytes: self.scan.bytes(run, self.form.numbers.unwrap_or(Numbers::Hex)),
                places: &self.scan.places[run.first..run.end],
                line: self.line,
                offset: self.offset,
                time: time.or(header_time).or(if row.is_some() { self.remembered } else { None }),
                sender: self.form.marks.as_ref().and_then(|marks| marks.sender(line)).or(said),
                port: (!port.is_empty()).then_some(port.as_slice()),
                joins: self.long || joined || row.is_some_and(|row| row.continues),
                colon: run.colon,
                dumped: row.is_some(),
            }));
        }
        // A row that is full goes on in the next one.
        const ROWS: [usize; 5] = [8, 16, 20, 24, 32];
        if self.header.as_ref().is_some_and(|header| header.row > 0 && !ROWS.contains(&header.row))
            || (!alone && row.is_none())
        {
            self.header = None;
        }
    }

    /// A line without bytes: it may say who speaks in the next one, and when.
    fn without_bytes(&mut self, time: Option<i64>, sink: &mut dyn FnMut(Event<'_>)) {
        /// More are a sentence.
        const WORDS: usize = 6;
        let sender = self.scan.sender.map(|(sender, _)| sender);
        let heads = sender.is_some() && self.scan.words <= WORDS && !self.long;
        if heads {
            self.drop_header(sink);
            let port = self.scan.port.clone();
            self.header = Some(Header { time, sender, port, line: self.line, offset: self.offset, row: 0 });
        } else if !self.long {
            self.remembered = time;
            sink(Event::Unread { line: self.line, offset: self.offset });
        }
    }

    /// A header below which nothing came was no header.
    fn drop_header(&mut self, sink: &mut dyn FnMut(Event<'_>)) {
        if let Some(header) = self.header.take().filter(|header| header.row == 0) {
            sink(Event::Unread { line: header.line, offset: header.offset });
        }
    }
}

/// Swaps the bytes of words that are written as one number each.
fn swap_words(scan: &mut Scan) {
    for run in &scan.runs {
        let words = scan.places[run.first..run.end].chunks(2);
        if words.clone().all(|pair| pair.len() == 2 && pair[0].to == pair[1].from) {
            for pair in scan.hex[run.first..run.end].chunks_exact_mut(2) {
                pair.swap(0, 1);
            }
        }
    }
}

/// What the beginning of a log tells about it.
#[derive(Clone, Copy, Debug)]
pub struct Recognised {
    pub layout: Option<&'static Layout>,
    pub numbers: Numbers,
    /// Lines of the beginning with bytes.
    pub with_bytes: usize,
    /// Those of them that say more than the bytes: who speaks, when, an offset.
    pub telling: usize,
    /// Those of them that are rows of a dump.
    pub dumped: usize,
}

/// Looks at the beginning of a log.
pub fn recognise(text: &[u8]) -> Recognised {
    const ENOUGH: usize = 1 << 16;
    let text = &text[..text.len().min(ENOUGH)];
    let mut shown = [0; LAYOUTS.len()];
    for line in text.split(|c| matches!(c, b'\n' | b'\r')) {
        if let Some(index) = LAYOUTS.iter().position(|layout| layout.shows(line)) {
            shown[index] += 1;
        }
    }
    let best = LAYOUTS.iter().zip(shown).filter(|(_, count)| *count > 0).max_by_key(|(_, count)| *count);
    let layout = best.map(|(layout, _)| layout);
    let (mut with_bytes, mut telling, mut dumped) = (0, 0, 0);
    let mut reader = Reader::default();
    let mut count = |event: Event<'_>| {
        if let Event::Piece(piece) = event {
            with_bytes += 1;
            dumped += usize::from(piece.dumped);
            telling += usize::from(piece.sender.is_some() || piece.time.is_some() || piece.joins);
        }
    };
    reader.push(text, &mut count);
    reader.finish(&mut count);
    let numbers = layout.and_then(|layout| layout.numbers).unwrap_or_else(|| numbers(text));
    Recognised { layout, numbers, with_bytes, telling, dumped }
}

/// Whether each line's first number counts the bytes behind it, with nothing else to tell it from
/// them: `8 01 03 00 C8 00 03 84 35`.
pub fn counted(text: &[u8], numbers: Option<Numbers>) -> bool {
    const ENOUGH: usize = 1 << 14;
    let text = &text[..text.len().min(ENOUGH)];
    // The last line may be cut.
    let end = text.iter().rposition(|c| matches!(c, b'\n' | b'\r')).unwrap_or(text.len());
    let mut scan = Scan::default();
    let (mut least, mut most) = (usize::MAX, 0);
    for line in text[..end].split(|c| matches!(c, b'\n' | b'\r')) {
        scan.read(line, 0, numbers);
        let Some(run) = scan.runs.iter().filter(|run| run.len() >= 4).max_by_key(|run| run.len()) else {
            continue;
        };
        if !scan.counts(run) {
            return false;
        }
        (least, most) = (least.min(run.len()), most.max(run.len()));
    }
    // Telegrams of one length for one unit could look the same.
    least < most
}

/// Hex, unless the numbers of most lines can only be decimal.
fn numbers(text: &[u8]) -> Numbers {
    let mut scan = Scan::default();
    let mut votes = 0_i64;
    for line in text.split(|c| matches!(c, b'\n' | b'\r')) {
        scan.read(line, 0, None);
        if let Some(run) = scan.runs.iter().filter(|run| run.len() >= 4).max_by_key(|run| run.len()) {
            votes += i64::from(!run.hex && run.decimal) - i64::from(run.hex && !run.decimal);
        }
    }
    if votes > 0 { Numbers::Decimal } else { Numbers::Hex }
}
