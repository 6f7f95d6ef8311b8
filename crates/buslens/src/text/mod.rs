//! Text into bytes: how everything that people paste or open is read.
//!
//! The [`Reader`] takes a text in pieces of any size and gives the bytes that it finds, line by line. Nothing
//! has to be known of it for that; [`LAYOUTS`] only names those that are known.
//!
//! - A line is taken apart into its time, who speaks, the port, words, and *runs*: numbers with hardly more
//!   than marks between them (`line`, `words`, `time`). `01 03`, `0103`, `0x01`, `01h`, `\x01`, `[01][03]`,
//!   decimal lists; colours of a terminal and marks of emphasis between them are nothing.
//! - Runs go on in the next lines in three ways: rows of a dump by their offsets (`dump`), a list of numbers
//!   whose row ends with a comma, and the columns of lines with a byte or two each (`columns`).
//! - Each run becomes a [`Piece`] with the [`Facts`] about it: does a word say who sent it, does a number
//!   beside it say how long it is, does it stand in brackets of its own. A line whose numbers could be hex and
//!   decimal gives both.
//!
//! Whether a piece holds a telegram is not decided here, but by [`crate::dialogue::evidence`]: a counter, a
//! date or a word of hex letters may well come out as a piece.
//!
//! Everything takes linear time, and usual lines do not allocate: most are like one before, and are compared with it
//! (`line::alike`).

mod characters;
mod columns;
mod dump;
mod encoding;
mod flow;
mod layouts;
mod line;
mod marks;
mod time;
mod typed;
mod words;

pub use encoding::{Encoding, encoding};
pub use flow::{Flow, flow};
pub use layouts::{EXPORTS, Export, LAYOUTS, Layout, export};
pub use line::{Numbers, Style};
pub use marks::{Marks, Place};
pub use typed::{Line, Remark, bytes, looks_typed, remarks};
pub use words::Sender;

use std::hash::{Hash, Hasher};

use crate::field::{Facts, Span};
use characters::is_word;
use columns::Columns;
use dump::{Dump, Words};
use line::{Alike, Like, Run, Scan, Start, Told};
use words::Weight;

/// How a text is to be read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Form {
    /// How numbers without a mark are written; `None` where each line tells.
    pub numbers: Option<Numbers>,
    /// The first number counts the bytes behind it, see [`counted`].
    pub counted: bool,
    /// Every line begins with a mark of a quotation, see [`quoted`].
    pub quoted: bool,
    /// Each line has one byte.
    pub flow: Option<Flow>,
    /// What a person marked in one line.
    pub marks: Option<Marks>,
}

/// Something found in a text.
#[derive(Debug)]
pub enum Event<'a> {
    Piece(Piece<'a>),
    /// A line without bytes that is not empty.
    Unread {
        line: u32,
        offset: u64,
    },
}

/// Bytes that stand together: perhaps a telegram, perhaps several, or a part of one, or none.
#[derive(Debug)]
pub struct Piece<'a> {
    pub bytes: &'a [u8],
    /// The same numbers read as decimal, where they can be either.
    pub decimal: Option<&'a [u8]>,
    /// Bytes from which on what stands between them is different.
    pub breaks: &'a [usize],
    /// Where each byte stands, counted from [`offset`](Self::offset).
    pub places: &'a [Span],
    /// Where they stand in the line as pairs of hex digits at equal distances: where the first one is, and how far it
    /// is to the next.
    pub pairs: Option<(usize, u8)>,
    /// The first line, counted from 1.
    pub line: u32,
    /// Where that line begins in the file.
    pub offset: u64,
    /// Microseconds, see [`Reader`].
    pub time: Option<i64>,
    pub sender: Option<Sender>,
    /// What tells several lines or connections apart: `COM8`, `10.0.0.7:49152 – 10.0.0.1:502`.
    pub port: Option<&'a [u8]>,
    /// It continues the piece before it.
    pub joins: bool,
    pub facts: Facts,
}

/// Reads a text, part by part of the file.
///
/// Times are microseconds since 1970, since midnight or since some start, as the log gives them.
#[derive(Debug, Default)]
pub struct Reader {
    form: Form,
    scan: Scan,
    alike: Alike,
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
    /// The time of a line without bytes, for the dump below it, and that line.
    remembered: Option<(i64, u32)>,
    /// The last line without bytes begins an array of a program.
    array: bool,
    list: List,
    columns: Columns,
    /// The breaks of the run in hand, see [`Piece::breaks`].
    breaks: Vec<usize>,
    /// How many pieces were given of the line in hand, and what was told of the last one.
    given: usize,
    told: Told,
    /// How the numbers of its lines are written, where that is counted.
    written: Option<Written>,
}

/// A line without bytes that says something about the next ones.
#[derive(Clone, Debug)]
struct Header {
    time: Option<i64>,
    sender: Option<Sender>,
    port: Vec<u8>,
    line: u32,
    offset: u64,
    /// The last row below it that is full, and goes on in the next line; 0 if there is none.
    row: u32,
    /// The last number in it.
    number: usize,
    leftovers: bool,
}

/// Whether a line, or what of it stands before bytes, begins an array in the source of a program: `uint8_t key[16] = {`,
/// `const char logo[] PROGMEM = {`.
fn begins_array(text: &[u8]) -> bool {
    let text = text.trim_ascii_end();
    let open = text.strip_suffix(b"{").or_else(|| text.strip_suffix(b"[")).map(<[u8]>::trim_ascii_end);
    let declared = open.and_then(|text| text.strip_suffix(b"=")).unwrap_or_default();
    let size = declared.iter().rposition(|c| *c == b']');
    let word = |c: &u8| c.is_ascii_alphanumeric() || matches!(c, b' ' | b'\t' | b'_');
    size.is_some_and(|end| declared[end + 1..].iter().all(word))
}

/// A list of numbers over several lines.
#[derive(Debug, Default)]
struct List {
    bytes: Vec<u8>,
    /// As long as `bytes`, if all can be decimal numbers.
    decimal: Vec<u8>,
    places: Vec<Span>,
    breaks: Vec<usize>,
    line: u32,
    offset: u64,
    facts: Facts,
    sender: Option<Sender>,
    time: Option<i64>,
}

/// A line longer than this is read in parts.
const LONGEST_LINE: usize = 1 << 16;

/// A list longer than this is read in parts.
const LONGEST_LIST: usize = 1 << 12;

/// So many bytes can be a telegram by themselves.
const SHORTEST: usize = 4;

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
        self.cut(sink);
    }

    /// The file ends.
    pub fn finish(&mut self, sink: &mut dyn FnMut(Event<'_>)) {
        if !self.carry.is_empty() {
            self.end_line(&[], sink);
        }
        self.end_list(sink);
        self.end_columns(sink);
        self.drop_header(sink);
    }

    /// Goes on elsewhere in the file, perhaps within a line, behind so many.
    pub fn jump(&mut self, offset: u64, line: u32) {
        let form = std::mem::take(&mut self.form);
        let (alike, dump) = (std::mem::take(&mut self.alike), std::mem::take(&mut self.dump));
        *self = Self { alike, dump, offset, line, long: true, ..Self::new(form) };
    }

    /// The file passes a mark: what stands far before it says nothing any more.
    pub fn pass_mark(&mut self) {
        /// A dump below a line with its time has no more.
        const FAR: u32 = 64;
        let line = self.line;
        self.remembered.take_if(|(_, remembered)| line - *remembered > FAR);
    }

    /// All that what comes next hangs on; lines are counted from here.
    pub fn hash_state(&self, hasher: &mut impl Hasher) {
        (&self.dump, &self.carry, self.offset, self.after_return, self.long, self.array).hash(hasher);
        self.remembered.map(|(time, line)| (time, self.line - line)).hash(hasher);
        if let Some(Header { time, sender, port, line, offset, row, number, leftovers }) = &self.header {
            let row = if *row == 0 { u32::MAX } else { self.line - row };
            (time, sender, port, self.line - line, offset, row, number, leftovers).hash(hasher);
        }
        let List { bytes, decimal, places, breaks, line, offset, facts, sender, time } = &self.list;
        if !bytes.is_empty() {
            (bytes, decimal, places, breaks, self.line - line, offset, facts, sender, time).hash(hasher);
        }
        self.columns.hash_state(self.line, hasher);
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
        while let Some(part) = carry.get(from..from + LONGEST_LINE) {
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
        let quote = if self.form.quoted && !self.long { quote(line) } else { 0 };
        if line[quote..].trim_ascii().is_empty() {
            self.end_list(sink);
            return self.end_columns(sink);
        }
        // Nothing in the lines before could say more of this one.
        let apart = !self.long
            && self.written.is_none()
            && !self.form.counted
            && self.form.marks.is_none()
            && self.form.flow.is_none()
            && self.header.is_none()
            && self.list.bytes.is_empty();
        let alike = !self.long
            && match self.alike.read(line, &mut self.scan, apart) {
                Like::None => false,
                Like::Read => true,
                Like::Told { told: Told { facts, sender }, bytes, time, pairs, port } => {
                    self.columns.end(None, sink);
                    self.scan.places.clear();
                    self.scan.places.extend(pairs.places(bytes.len()));
                    return sink(Event::Piece(Piece {
                        bytes,
                        decimal: None,
                        breaks: &[],
                        places: &self.scan.places,
                        pairs: pairs.digits(),
                        line: self.line,
                        offset: self.offset,
                        time: time.or(self.remembered.filter(|_| facts.bare).map(|(time, _)| time)),
                        sender,
                        port: (!port.is_empty()).then_some(port),
                        joins: false,
                        facts,
                    }));
                }
            };
        self.given = 0;
        let row = if self.long || alike { None } else { self.dump.row(line) };
        if !alike && self.dump.ends(line) {
            return;
        }
        let marked = self.form.marks.as_ref().and_then(|marks| marks.bytes_from(line));
        let begins = row.map_or(0, |row| row.from).max(marked.unwrap_or(0));
        let words = row.map(|row| row.words);
        if words == Some(Words::Octal) {
            self.scan.read_octal(line, begins);
        } else if !alike {
            let start = Start { from: begins.max(quote), in_row: begins > 0 };
            self.scan.read(line, start, self.form.numbers);
            if row.is_none() {
                self.alike.learn(line, &self.scan);
            }
        }
        if let Some(written) = &mut self.written {
            written.count(&self.scan);
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
        let mut listed = row.is_none() && self.is_row_of_list(line);
        if !listed && !self.list.bytes.is_empty() {
            self.end_list(sink);
            // What does not go on with a list may begin one.
            listed = row.is_none() && self.is_row_of_list(line);
        }
        if listed {
            return self.take_row_of_list(line, time, sink);
        }
        if self.form.flow.is_some() {
            return match flow::byte(&self.scan).copied() {
                Some(run) => self.emit(line, &run, Context { time, ..Context::default() }, sink),
                None => self.without_bytes(line, time, sink),
            };
        }
        if let Some(row) = row {
            self.end_columns(sink);
            let Some(run) = self.scan.runs.first().copied() else {
                return self.without_bytes(line, time, sink);
            };
            self.dump.read(row, run.len());
            let sender = self.dump.sender(row);
            let context = Context { time, joins: row.continues, dumped: true, sender, ..Context::default() };
            return self.emit(line, &run, context, sink);
        }
        self.runs(line, time, marked.is_some(), sink);
        let still = self.header.is_none() && self.columns.is_empty();
        if apart && still && self.given == 1 && !self.told.facts.rest {
            self.alike.tell(line, self.told);
        }
    }

    /// Gives the runs of a line that can be bytes of a telegram.
    fn runs(&mut self, line: &[u8], time: Option<i64>, marked: bool, sink: &mut dyn FnMut(Event<'_>)) {
        // A digit that is left over is being typed.
        let runs = self.scan.runs.iter().filter(|run| run.span.len() > 1).count().max(1);
        let bare = self.scan.words == 0 && self.scan.time.is_none() && runs == 1;
        let joined = bare && self.header.as_ref().is_some_and(|header| header.row + 1 == self.line);
        // Rows below a header end where another line comes: what is said in it is said of them only.
        self.header.take_if(|header| header.row > 0 && !joined);
        let several = self.scan.runs.iter().any(|run| run.len() >= SHORTEST);
        // The cells of a row of a table may be a run, too.
        let table = || memchr::memchr_iter(b'|', line).nth(1).is_some();
        let row = !self.long && !marked && !joined && (!several || table());
        if !row || !self.columns.take(line, &self.scan, self.line, self.offset) {
            self.end_columns(sink);
        }
        let last = self.scan.runs.last().map(|run| run.span);
        // The numbers between its bytes count them.
        let indexed = self.scan.behind_indices(line).is_some() && !marked;
        let (mut given, mut placed) = (false, false);
        for index in 0..self.scan.runs.len() {
            let run = self.scan.runs[index];
            let ends = Some(run.span) == last && self.scan.tail_is_plain(line, &run);
            // One number in a sentence is none.
            let number = run.tokens() == 1
                && !run.said
                && !run.colon
                && !bare
                && !run.marked
                && !is_labelled(line, &run);
            // Signs stand for one more byte at least.
            let length = run.len() + usize::from(has_placeholder(line, &run));
            let short = length < SHORTEST || (number && length == SHORTEST);
            let two = run.span.len() > 1;
            let said = run.said && run.sender.is_some_and(|(_, weight)| weight == Weight::Strong);
            let named = self.scan.is_acknowledgement(&run);
            let rest = short && !marked && (bare && two || said || named || ends && is_labelled(line, &run));
            if (short && !rest && !marked) || indexed {
                continue;
            }
            given |= !short || marked || bare;
            placed |= bare || marked || run.said || is_labelled(line, &run);
            let context =
                Context { time, joins: self.long || joined, dumped: marked, bare, rest, sender: None };
            self.emit(line, &run, context, sink);
        }
        self.bytes_apart(line, time, sink);
        if !given {
            return self.without_bytes(line, time, sink);
        }
        // A row that is full goes on in the next one.
        const ROWS: [usize; 5] = [8, 16, 20, 24, 32];
        let length = self.scan.runs.first().map_or(0, Run::len);
        match &mut self.header {
            Some(header) if bare && (header.row == 0 || joined) && ROWS.contains(&length) => {
                header.row = self.line
            }
            header if placed => *header = None,
            _ => {}
        }
    }

    /// Gives all bytes of a line that have a mark of their own, where words stand between them: `ADR 01H, CMD
    /// 03H, address 21H 02H`; and those behind running numbers: `{"0":1,"1":3}`.
    fn bytes_apart(&mut self, line: &[u8], time: Option<i64>, sink: &mut dyn FnMut(Event<'_>)) {
        let scan = &self.scan;
        let runs = || scan.runs.iter().filter(|run| run.marked);
        let longest = runs().map(Run::len).max().unwrap_or_default();
        let all: usize = runs().map(Run::len).sum();
        let marked = all != longest && all >= SHORTEST;
        let chosen: Vec<usize> = match scan.behind_indices(line) {
            _ if marked => runs().flat_map(|run| run.first..run.end).collect(),
            Some(behind) => behind.collect(),
            None => return,
        };
        self.given += 1;
        let take = |of: &[u8]| chosen.iter().filter_map(|at| of.get(*at)).copied().collect::<Vec<u8>>();
        let (bytes, decimal) = (take(&scan.hex), take(&scan.decimal));
        let places: Vec<Span> = chosen.iter().map(|at| scan.places[*at]).collect();
        let both = !marked && decimal.len() == bytes.len();
        sink(Event::Piece(Piece {
            bytes: &bytes,
            decimal: both.then_some(&decimal),
            breaks: &[],
            places: &places,
            pairs: None,
            line: self.line,
            offset: self.offset,
            time,
            sender: self.scan.sender.map(|(sender, _)| sender),
            port: None,
            joins: false,
            facts: Facts { column: true, marked, ..Facts::default() },
        }));
    }

    /// Gives a run with what is said of it.
    fn emit(&mut self, line: &[u8], run: &Run, context: Context, sink: &mut dyn FnMut(Event<'_>)) {
        let Self { scan, header, form, breaks, told, .. } = self;
        self.given += 1;
        let header = header.as_ref().filter(|_| context.bare || context.dumped || header_fits(scan));
        let alone = scan.near(run).iter().filter(|run| run.len() >= SHORTEST).count() <= 1;
        let after = scan.sender.filter(|(_, weight)| *weight == Weight::Strong && alone);
        let own = run.sender.or(after).map(|(sender, _)| sender);
        let sender = own.or(header.and_then(|header| header.sender));
        let port =
            if scan.port.is_empty() { header.map_or(&[][..], |header| &header.port) } else { &scan.port };
        let marks = form.marks.as_ref().and_then(|marks| marks.sender(line));
        breaks.clear();
        breaks.extend(run.breaks.of(&scan.breaks).iter().map(|at| at - run.first));
        let numbers = form.numbers.unwrap_or(Numbers::Hex);
        let bytes = scan.bytes(run, numbers);
        let decimal = scan.decimal_bytes(run).filter(|decimal| form.numbers.is_none() && *decimal != bytes);
        let places = &scan.places[run.first..run.end];
        // Of another run of the line, that is not known.
        let is_known = |(from, _): &(usize, u8)| places.first().is_some_and(|first| first.to == from + 2);
        let pairs = scan.pairs.filter(is_known).or_else(|| pairs(line, bytes, places));
        let counted = header.is_some_and(|header| header.number == run.len()) || scan.is_counted(line, run);
        let facts = Facts {
            colon: run.colon,
            dumped: context.dumped,
            bare: context.bare,
            said: marks.is_some()
                || run.said
                || run.sender.is_some_and(|(_, weight)| weight == Weight::Strong)
                || (own.is_none() && sender.is_some()),
            counted,
            of_leftovers: scan.of_leftovers || header.is_some_and(|header| header.leftovers),
            rest: context.rest,
            ..self::facts(line, run, scan)
        };
        let sender = marks.or(sender).or(context.sender);
        *told = Told { facts, sender };
        sink(Event::Piece(Piece {
            bytes,
            decimal,
            breaks,
            places,
            pairs,
            line: self.line,
            offset: self.offset,
            time: context
                .time
                .or(header.and_then(|header| header.time))
                .or(self.remembered.filter(|_| context.dumped || context.bare).map(|(time, _)| time)),
            sender,
            port: (!port.is_empty()).then_some(port),
            joins: context.joins,
            facts,
        }));
    }

    /// A line without bytes: it may say who speaks in the next one, and when.
    fn without_bytes(&mut self, line: &[u8], time: Option<i64>, sink: &mut dyn FnMut(Event<'_>)) {
        /// More are a sentence, unless a colon ends it.
        const WORDS: usize = 6;
        if self.long {
            return;
        }
        let code = line.trim_ascii_start();
        let remark = code.starts_with(b"//") || code.starts_with(b"/*") || code.trim_ascii_end() == b"{";
        self.array = begins_array(line) || (self.array && remark);
        let sender = self.scan.sender.filter(|_| !self.scan.both).map(|(sender, _)| sender);
        let heading = line.trim_ascii_end().ends_with(b":");
        let number = self.scan.last_number(line);
        let heads = (sender.is_some() && self.scan.words <= WORDS) || heading;
        if heads {
            self.drop_header(sink);
            let port = self.scan.port.clone();
            let leftovers = self.scan.of_leftovers;
            let (line, offset) = (self.line, self.offset);
            self.header = Some(Header { time, sender, port, line, offset, row: 0, number, leftovers });
        } else {
            // Another time is of something else.
            if time.is_some() {
                self.drop_header(sink);
            }
            self.remembered = time.map(|time| (time, self.line));
            sink(Event::Unread { line: self.line, offset: self.offset });
        }
    }

    /// A header below which nothing came was no header.
    fn drop_header(&mut self, sink: &mut dyn FnMut(Event<'_>)) {
        if let Some(header) = self.header.take().filter(|header| header.row == 0) {
            sink(Event::Unread { line: header.line, offset: header.offset });
        }
    }

    /// Whether a line is a row of a list that goes on, or that went on in the row before.
    fn is_row_of_list(&self, line: &[u8]) -> bool {
        let begins = self.list.bytes.is_empty();
        if self.long || self.form.flow.is_some() || self.form.marks.is_some() {
            return false;
        }
        let Some(first) = self.scan.runs.first() else { return false };
        let alone = !line[..first.span.from].iter().any(u8::is_ascii_alphanumeric);
        let may_begin = self.scan.time.is_none() && (alone || self.scan.runs.iter().any(|run| run.marked));
        // Among numbers with a mark, one without is decimal, unless a person says otherwise.
        let marked = self.list.facts.marked && self.form.numbers.is_none();
        let fits = |run: &Run| {
            let parted = run.tokens() == 1 || run.is_list();
            parted && (run.marked || run.decimal || !marked)
        };
        if !(alone && self.scan.runs.iter().all(fits) || begins) || (begins && !may_begin) {
            return false;
        }
        let code = without_comment(line);
        let last = self.scan.runs.iter().rfind(|run| run.span.to <= code.len());
        let Some(last) = last.filter(|_| first.span.to <= code.len()) else { return false };
        let ends = !code[last.span.to..].iter().any(u8::is_ascii_alphanumeric);
        let goes_on = code.trim_ascii_end().ends_with(b",");
        ends && (!begins || (goes_on && (alone || last.marked)))
    }

    fn take_row_of_list(&mut self, line: &[u8], time: Option<i64>, sink: &mut dyn FnMut(Event<'_>)) {
        let code = without_comment(line);
        if self.list.bytes.is_empty() {
            self.end_columns(sink);
            let facts =
                self.scan.runs.first().map_or_else(Facts::default, |run| facts(line, run, &self.scan));
            let header = self.header.take();
            self.list.sender = self.scan.sender.map(|(sender, _)| sender).or(header.and_then(|it| it.sender));
            let array = facts.array || self.array;
            self.list.facts = Facts { wrapped: true, said: self.list.sender.is_some(), array, ..facts };
            (self.list.line, self.list.offset, self.list.time) = (self.line, self.offset, time);
        } else {
            self.list.breaks.push(self.list.bytes.len());
        }
        let base = (self.offset - self.list.offset) as usize;
        for run in self.scan.runs.iter().filter(|run| run.span.to <= code.len()) {
            let bytes = self.scan.bytes(run, self.form.numbers.unwrap_or(Numbers::Hex));
            self.list.bytes.extend_from_slice(bytes);
            match self.scan.decimal_bytes(run) {
                Some(decimal) if self.form.numbers.is_none() => self.list.decimal.extend_from_slice(decimal),
                _ if run.marked => self.list.decimal.extend_from_slice(bytes),
                _ => {}
            }
            self.list
                .places
                .extend(self.scan.places[run.first..run.end].iter().map(|place| place.shifted(base)));
        }
        let goes_on = code.trim_ascii_end().ends_with(b",");
        if !goes_on || self.list.bytes.len() > LONGEST_LIST {
            self.end_list(sink);
        }
    }

    fn end_list(&mut self, sink: &mut dyn FnMut(Event<'_>)) {
        let List { bytes, decimal, places, breaks, line, offset, facts, sender, time } = &mut self.list;
        if bytes.is_empty() {
            return;
        }
        sink(Event::Piece(Piece {
            decimal: (decimal.len() == bytes.len() && decimal != bytes).then_some(decimal),
            bytes,
            breaks,
            places,
            pairs: None,
            line: *line,
            offset: *offset,
            time: *time,
            sender: *sender,
            port: None,
            joins: false,
            facts: *facts,
        }));
        for part in [bytes, decimal] {
            part.clear();
        }
        places.clear();
        breaks.clear();
    }

    fn end_columns(&mut self, sink: &mut dyn FnMut(Event<'_>)) {
        let sender = self.header.as_ref().and_then(|header| header.sender);
        self.columns.end(sender, sink);
    }
}

/// What is known where a run is given.
#[derive(Clone, Copy, Debug, Default)]
struct Context {
    time: Option<i64>,
    joins: bool,
    dumped: bool,
    bare: bool,
    rest: bool,
    /// Who speaks, where the text does not say it.
    sender: Option<Sender>,
}

/// Whether what a header says is said of a line that is not bare: one without words of its own.
fn header_fits(scan: &Scan) -> bool {
    scan.words == 0 && scan.time.is_none()
}

/// What a line without its comment is, where one begins behind a blank: `0x01, // unit`.
fn without_comment(line: &[u8]) -> &[u8] {
    let blank = |at: usize| at == 0 || line[at - 1].is_ascii_whitespace();
    let begins = |at: &usize| {
        let rest = &line[*at..];
        blank(*at) && (rest.starts_with(b"//") || rest.starts_with(b"# ") || rest.starts_with(b"-- "))
    };
    memchr::memchr3_iter(b'/', b'#', b'-', line).find(begins).map_or(line, |at| &line[..at])
}

/// The last sign before a run, blanks aside: any digit is the same, since those of times and counters change.
fn lead(line: &[u8], run: &Run) -> u8 {
    match line[..run.span.from].trim_ascii_end().last() {
        Some(b'0'..=b'9') => b'0',
        last => last.copied().unwrap_or_default(),
    }
}

/// See [`Piece::pairs`].
fn pairs(line: &[u8], bytes: &[u8], places: &[Span]) -> Option<(usize, u8)> {
    let (first, second) = (places.first()?, places.get(1)?);
    let step = u8::try_from(second.from.checked_sub(first.from)?).ok().filter(|step| *step > 1)?;
    // The digits may stand behind a mark: `0x01`.
    let from = [first.from, first.to.checked_sub(2)?]
        .into_iter()
        .find(|at| pair(line, *at) == bytes.first().copied())?;
    let digits = (from..).step_by(step.into());
    digits.zip(bytes).all(|(at, byte)| pair(line, at) == Some(*byte)).then_some((from, step))
}

/// The byte that two hex digits write.
#[inline]
pub fn pair(text: &[u8], at: usize) -> Option<u8> {
    let [high, low] = *text.get(at..)?.first_chunk()?;
    let digit = |c: u8| (c as char).to_digit(16);
    Some((digit(high)? * 16 + digit(low)?) as u8)
}

/// Whether a colon or the like stands before a run.
fn is_labelled(line: &[u8], run: &Run) -> bool {
    let before = line[..run.span.from].trim_ascii_end();
    let open = matches!(before.last(), Some(b'[' | b'(' | b'{' | b'<' | b'"' | b'\'' | b'`' | b'*' | b'_'));
    let before = if open { before[..before.len() - 1].trim_ascii_end() } else { before };
    matches!(before.last(), Some(b':' | b'=' | b'>' | b'-'))
}

/// Whether signs or a word that stand for bytes follow a run: `01 86 03 xx xx`, `01 86 03 [CRC]`.
fn has_placeholder(line: &[u8], run: &Run) -> bool {
    let behind = line[run.span.to..].trim_ascii_start();
    [b"xx", b"??", b"XX"].iter().any(|sign| behind.starts_with(*sign)) || names_check(behind)
}

/// Whether a digit that stands for any other, or two, are right before a run: `8x 01 04`, `XX 03 00`.
fn begins_with_placeholder(line: &[u8], run: &Run) -> bool {
    match line[..run.span.from].trim_ascii_end() {
        [before @ .., high, b'x' | b'X'] => {
            (high.is_ascii_hexdigit() || matches!(high, b'x' | b'X'))
                && !before.last().is_some_and(|c| is_word(*c))
        }
        _ => false,
    }
}

/// Whether a text begins with a word for a check behind an arrow: `→ CRC = ?`, `-> CRC16`.
fn leads_to_check(text: &[u8]) -> bool {
    let arrows = ["→", "->", "=>", "+"].map(str::as_bytes);
    let behind =
        arrows.into_iter().find_map(|arrow| text.strip_prefix(arrow)).unwrap_or_default().trim_ascii_start();
    behind.get(..3).is_some_and(|word| word.eq_ignore_ascii_case(b"crc"))
}

/// Whether a text begins with a word for a check, in brackets: `[CRC]`, `<crc16>`.
fn names_check(text: &[u8]) -> bool {
    const LONGEST: usize = 12;
    let [b'[' | b'<' | b'{' | b'(', name @ ..] = text else { return false };
    let ends = name.iter().take(LONGEST).position(|c| !is_word(*c) && !matches!(c, b'-' | b'_' | b' '));
    let word =
        name.get(..3).is_some_and(|word| [b"crc", b"lrc"].iter().any(|it| word.eq_ignore_ascii_case(*it)));
    word && ends.is_some_and(|at| matches!(name[at], b']' | b'>' | b'}' | b')'))
}

/// What a line says of a run by how it stands there.
fn facts(line: &[u8], run: &Run, scan: &Scan) -> Facts {
    /// So near behind a run an ellipsis is one of its bytes.
    const ELLIPSIS: usize = 40;
    let before = line[..run.span.from].trim_ascii();
    let lead = lead(line, run);
    let behind = line[run.span.to..].trim_ascii_start();
    let closes = match lead {
        b'[' => b']',
        b'(' => b')',
        b'{' => b'}',
        b'<' => b'>',
        quote => quote,
    };
    let wrapped = matches!(lead, b'[' | b'(' | b'{' | b'<' | b'"' | b'\'' | b'`')
        && behind.first() == Some(&closes)
        || run.style == Style::Escaped;
    let near = &behind[..behind.len().min(ELLIPSIS)];
    let dots = behind.iter().take_while(|c| **c == b'.').count();
    let ends = behind.get(dots).is_none_or(|c| c.is_ascii_whitespace() || matches!(c, b')' | b']' | b'"'));
    let ellipsis = !near.is_ascii()
        && ["…".as_bytes(), "・・".as_bytes()].iter().any(|sign| memchr::memmem::find(near, sign).is_some());
    // `0103…C40B`: what is before the ellipsis lacks its end, and what is behind it its beginning.
    let glued = line[run.span.to..].starts_with(b"..") || line[..run.span.from].ends_with(b"..");
    let dotted = (2..=4).contains(&dots) && ends;
    let abridged = !scan.column && (dotted || glued || has_placeholder(line, run) || ellipsis);
    let shape = run.word ^ (u32::from(lead) << 24) ^ (run.style as u32 + 1).wrapping_mul(0x9E37_79B1);
    Facts {
        labelled: is_labelled(line, run),
        wrapped,
        array: run.marked
            && run.is_list()
            && (lead == b',' || lead == b'{' && !before.iter().any(u8::is_ascii_alphanumeric))
            || matches!(lead, b'{' | b'[') && begins_array(before),
        words: run.marked
            && run.style != Style::Escaped
            && run.len() > run.tokens()
            && (run.tokens() > 1 || run.len() == SHORTEST),
        marked: run.marked,
        listed: run.is_list(),
        digits: run.is_of_digits(run.span.of(line)),
        of_telegrams: scan.of_telegrams,
        of_leftovers: scan.of_leftovers,
        abridged,
        check_named: names_check(behind) || leads_to_check(behind),
        slips: begins_with_placeholder(line, run)
            || scan.words == 0
                && (scan.slips > 0
                    || scan.near(run).iter().any(|other| other.first != run.first && other.span.len() == 1)),
        shape,
        ..Facts::default()
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

/// What the beginning of a text tells about it.
#[derive(Clone, Copy, Debug)]
pub struct Recognised {
    pub layout: Option<&'static Layout>,
    /// How all its numbers are written; `None` where each line has to tell.
    pub numbers: Option<Numbers>,
    /// How most bytes are written.
    pub style: Option<Style>,
    /// Lines of the beginning with bytes.
    pub with_bytes: usize,
    /// Those of them that say more than the bytes: who speaks, when, an offset.
    pub telling: usize,
    /// Those of them that are rows of a dump.
    pub dumped: usize,
}

/// Looks at the beginning of a text.
pub fn recognise(text: &[u8]) -> Recognised {
    const ENOUGH: usize = 1 << 16;
    let text = &text[..text.len().min(ENOUGH)];
    let mut shown = [0; LAYOUTS.len()];
    for line in text.split(|c| matches!(c, b'\n' | b'\r')) {
        // Of several, the first one counts.
        if let Some(count) = shown.get_mut(Layout::shown(line).trailing_zeros() as usize) {
            *count += 1;
        }
    }
    let best = LAYOUTS.iter().zip(shown).filter(|(_, count)| *count > 0).max_by_key(|(_, count)| *count);
    let layout = best.map(|(layout, _)| layout);
    let (mut with_bytes, mut telling, mut dumped) = (0, 0, 0);
    let mut reader = Reader { written: Some(Written::default()), ..Reader::default() };
    let mut count = |event: Event<'_>| {
        if let Event::Piece(piece) = event {
            with_bytes += 1;
            dumped += usize::from(piece.facts.dumped);
            telling += usize::from(piece.sender.is_some() || piece.time.is_some() || piece.joins);
        }
    };
    reader.push(text, &mut count);
    reader.finish(&mut count);
    let written = reader.written.unwrap_or_default();
    // The name of a program may stand in a text that was written by another one.
    let numbers = layout.and_then(|layout| layout.numbers).filter(|_| !written.padded).or(written.numbers());
    Recognised { layout, numbers, style: written.style(), with_bytes, telling, dumped }
}

/// Whether each line of a text is quoted: `> 01 03`.
pub fn quoted(text: &[u8]) -> bool {
    const ENOUGH: usize = 1 << 14;
    const LEAST: usize = 3;
    let text = &text[..text.len().min(ENOUGH)];
    let mut lines = text.split(|c| matches!(c, b'\n' | b'\r')).filter(|line| !line.trim_ascii().is_empty());
    lines.clone().nth(LEAST - 1).is_some() && lines.all(|line| line.starts_with(b">"))
}

/// How long the marks are that quote a line.
fn quote(line: &[u8]) -> usize {
    let marks = line.iter().take_while(|c| matches!(c, b'>' | b' ')).count();
    line[..marks].iter().rposition(|c| *c == b'>').map_or(0, |last| last + 1)
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
        scan.read(line, Start::default(), numbers);
        let Some(run) = scan.runs.iter().filter(|run| run.len() >= SHORTEST).max_by_key(|run| run.len())
        else {
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

/// How the numbers of a text are written.
#[derive(Debug, Default)]
struct Written {
    /// Lines whose bytes can only be hex, and only decimal.
    hex: usize,
    decimal: usize,
    /// There are some with a zero before one digit, which is not how decimal numbers are written.
    padded: bool,
    /// How many bytes are written in each style.
    styles: [usize; Style::ALL.len()],
}

impl Written {
    /// Counts what stands in a line.
    fn count(&mut self, scan: &Scan) {
        let Some(run) = scan.runs.iter().max_by_key(|run| run.len()) else { return };
        self.styles[run.style as usize] += run.len();
        if run.len() >= SHORTEST {
            self.hex += usize::from(run.hex && !run.decimal);
            self.decimal += usize::from(!run.hex && run.decimal);
            self.padded |= run.is_padded();
        }
    }

    /// How all numbers are written, if the lines leave no doubt.
    fn numbers(&self) -> Option<Numbers> {
        /// So many lines leave none.
        const SURE: usize = 8;
        match (self.hex, self.decimal) {
            (SURE.., 0) => Some(Numbers::Hex),
            (0, SURE..) => Some(Numbers::Decimal),
            _ => None,
        }
    }

    /// How most bytes are written.
    fn style(&self) -> Option<Style> {
        let styles = Style::ALL.into_iter().zip(self.styles).filter(|(_, count)| *count > 0);
        styles.max_by_key(|(_, count)| *count).map(|(style, _)| style)
    }
}

#[cfg(test)]
#[path = "../../tests/random/mod.rs"]
mod random;

#[cfg(test)]
mod tests {
    use super::random::random;
    use super::*;

    /// What is given of the pieces of a text, but for their places in the file.
    fn given(reader: &mut Reader, line: &str) -> Vec<String> {
        let mut given = Vec::new();
        reader.push(format!("{line}\n").as_bytes(), &mut |event| {
            if let Event::Piece(piece) = event {
                let Piece { bytes, decimal, breaks, places, pairs, time, sender, port, joins, facts, .. } = piece;
                given.push(format!(
                    "{bytes:?} {decimal:?} {breaks:?} {places:?} {pairs:?} {time:?} {sender:?} {port:?} {joins} \
                     {facts:?}"
                ));
            }
        });
        given
    }

    #[test]
    fn a_line_like_others_is_given_as_if_it_were_alone() {
        let form = Form { numbers: Some(Numbers::Hex), ..Form::default() };
        for [first, second, third] in [
            ["TX: 01 03 00 C8 00", "TX: 11 03 00 C8 00 03 84", "TX: FF 03 00 C8 00 03"],
            ["id 0103AB00C8", "id 1103000203", "id 0103000203"],
            ["id 0103AB00C8", "id 11030002AC", "id 0103000203"],
            [
                "09:30:05 len 5 rx 01 03 00 C8 00",
                "09:30:06 len 5 rx 01 03 00 C8 00 03",
                "09:30:07 len 5 rx 01 03 1F C8 00",
            ],
            ["len=00006 01 03 00 C8 00 03", "len=00007 01 03 00 C8 00 03", "len=00005 01 03 00 C8 00"],
            [
                "0x01 0x03 0x00 0xC8 0x00 (sent)",
                "0x11 0x03 0x00 0xC8 0x00 0x07 (sent)",
                "0x1 0x3 0x0 0xC8 0x0",
            ],
            ["COM8 > [01][03][00][C8][00]", "COM8 > [01][03][00][C8][00][03]", "COM9 > [01][03][00][C8][00]"],
            ["x 01 03 00 C8 00 at 09:30:05", "x 01 03 00 C8 10 at 09:30:06", "x 01 03 00 C8 10 at 09:30:99"],
        ] {
            let mut reader = Reader::new(form.clone());
            for line in [first, first, second, third] {
                assert_eq!(given(&mut reader, line), given(&mut Reader::new(form.clone()), line), "{line}");
            }
        }
    }

    /// Lines that patterns could be made of, and others that are nearly so.
    const LINES: &[&str] = &[
        "TX: 01 03 00 C8 00 03 84 35",
        "09:30:05.123 TX: 01 03 00 C8 00 03",
        "2026-03-02 09:30:05 [x] 01-03-00-c8-00-03",
        "2026-03-02 01:03:00:C8:00",
        "2026-03-02   01:03:00:C8:00",
        "000017-Tx:01 03 00 C8 00 03 84 35",
        "id 12345 rx 01  03  00  C8  00",
        "[01][03][00][C8][00][03]",
        "<01><03><00><C8><00><03>",
        ">>> 01:03:00:C8:00:03  ",
        "10.0.0.7:49152 -> 10.0.0.1:502 01 03 00 C8 00",
        "Tx=010300c800038435",
        ":010300C800032D",
        "Raw >>> {0x01, 0x03, 0x00, 0xC8, 0x00}",
        "rx: 0x01 0x03 0x00 0xC8 0x00, len 5",
        "[09:30:05] rx: 01.03.00.C8.00 (5 bytes in 12 ms)",
        "TX 0x01 , 0x03 , 0x00 , 0xC8 , 0x00",
        "rx 01 03 00 C8 00 03 len 6 of 00006",
        "TX: 30 30 31 32 33  00123",
        "TX: 30 30 31 32 33 |00123|",
        "01 03 00 C8 00 at 09:30:05",
        "{\"data\":\"01 03 00 C8 00 03\"}",
        "len=00006 01 03 00 C8 00 03",
        "5 01 03 00 C8 00",
        "COM 12: 01 03 00 C8 00",
        "0010: 01 03 00 C8 00",
        "x -01 03 00 C8 00",
        r"\x01 01 03 00 C8 00",
        "TX 01 03 00 C8 00 RX 01 03 00 C8 00 05",
        "tx 01 03 00 C8 00 123 56 rx",
        "rx 0xC8 0x00 5 01 03 00 C8 00",
        "01 03 00 C8 00 03 [12 bytes]",
        "TX 01#03#00#C8#00",
        "rx 01 03 00 C8 00 ... 84 35",
        "rx 01 03 00 C8 00 [CRC]",
        "a 123 | 01 03 00 C8 00 | b",
        "TX 1, 3, 0, 200, 0, 3",
        "TX: 01h 03h 00h C8h 00h",
        "rx (7): 01 03 02 00 05 78 44",
        "n 12345678 01 03 00 C8 00",
        "n 1234567 010300C8AB",
        "n 123/456 rx: 01 03 00 C8 00",
        "v1.234 -123 rx 01 03 00 C8 00",
        "123# 01 03 00 C8 00",
        "1775000000001 tx 01 03 00 C8 00",
        "TX 0103 00C8 0003",
        "0x01 0x03 0x00 0xC8 0x00 (sent)",
        "rx 0x01 0x03 0x00 0xC8 0x00 from unit 0x11",
        "E5 12345 rx 68 05 05 68 81 82 5D 3B 3E D9 16",
    ];

    /// A line with other digits, and perhaps another sign.
    fn varied(line: &str, random: &mut impl FnMut(u64) -> u64) -> String {
        const SIGNS: &[u8] = b" ,;:-./|x[]()<>h#0A19";
        let mut text = line.as_bytes().to_vec();
        for c in &mut text {
            let digits: &[u8] = match c {
                b'A' | b'C' | b'E' => b"0123456789ABCDEF",
                b'0'..=b'9' => b"0123456789",
                _ => continue,
            };
            if random(1) > 0 {
                *c = digits[random(digits.len() as u64 - 1) as usize];
            }
        }
        let at = random(text.len() as u64 - 1) as usize;
        let sign = SIGNS[random(SIGNS.len() as u64 - 1) as usize];
        match random(7) {
            0 => text[at] = sign,
            1 => text.insert(at, sign),
            2 => drop(text.remove(at)),
            // One byte more or less.
            3 => drop(text.splice(at.., text[at.saturating_sub(3)..].to_vec())),
            4 => drop(text.drain(at..(at + 3).min(text.len()))),
            _ => {}
        }
        String::from_utf8(text).expect("its signs are ASCII")
    }

    #[test]
    fn what_is_like_others_is_given_as_if_they_were_forgotten() {
        let mut random = random(1);
        for (nth, line) in LINES.iter().enumerate() {
            for numbers in [Some(Numbers::Hex), None, Some(Numbers::Decimal)] {
                let [mut reader, mut forgetful] =
                    [0, 1].map(|_| Reader::new(Form { numbers, ..Form::default() }));
                for _ in 0..100 {
                    for line in [line.to_string(), varied(line, &mut random)] {
                        forgetful.alike = Alike::default();
                        assert_eq!(given(&mut reader, &line), given(&mut forgetful, &line), "{nth}: {line}");
                    }
                }
            }
        }
    }

    /// Numbers of all spellings that follow each other.
    const NUMBERS: &[&str] = &[
        "0x01, 0x03, 0x00, 0xC8, 0x00",
        "0x1 0x3 0x0 0xC8 0x5",
        "1, 3, 0, 200, 0, 3",
        "200 201 3 4 50",
        "tx 0103 00C8 0003 8435",
        "01h, 03h, 0Ch, 12h",
        "9h 8h 7h Ah Bh 12h",
        "01   03   00   C8   00",
        "01 , 03 , 00 , C8 , 00",
        "{1,3,0,200,-56,7}",
        "01 - 03 - 00 - C8 - 00",
        "[01] [03] [00] [C8] [00]",
        "1 3 0 20 0 3 13 53",
        "01:03:00:C8:00:1",
        "0x01,0x03,0x00,3,4",
        "01 03 00 C8 0 5 6",
        "$01,$03,$00,$C8",
        "01%2003%2000%20C8",
        "'0x01', '0x03', '0x00', '0xC8'",
        "\"01\", \"03\", \"00\", \"C8\"",
        "0x01 ,0x03 ,0x00 ,0xC8",
        "12,34,56,78,90",
        "1|3|0|200|3",
        "tx 1, 3, 0, 20 and 5, 6, 7",
        "1. 3. 0. 200. 3. 9",
    ];

    #[test]
    fn numbers_like_those_before_are_read_as_if_asked_what_they_are() {
        let mut random = random(2);
        let read = |line: &str, numbers, slow| {
            let mut scan = Scan::default();
            scan.slow = slow;
            scan.read(line.as_bytes(), Start::default(), numbers);
            let decimal: Vec<_> = scan.runs.iter().map(|run| scan.decimal_bytes(run)).collect();
            let Scan { hex, places, runs, breaks, time, words, slips, column, sender, .. } = &scan;
            format!(
                "{hex:?} {decimal:?} {places:?} {runs:?} {breaks:?} {time:?} {words} {slips} {column} {sender:?}"
            )
        };
        for line in NUMBERS.iter().chain(LINES) {
            for numbers in [Some(Numbers::Hex), None, Some(Numbers::Decimal)] {
                for _ in 0..60 {
                    let line = varied(line, &mut random);
                    assert_eq!(read(&line, numbers, false), read(&line, numbers, true), "{line} {numbers:?}");
                }
            }
        }
    }

    #[test]
    fn marks_that_quote() {
        assert_eq!(
            ["> 01 03", ">> 01", "> > 01", "  01", "-> 01"].map(|line| quote(line.as_bytes())),
            [1, 2, 3, 0, 0]
        );
        assert!(quoted(b"> one\n> two\r\n\n> three"));
        assert!(!quoted(b"> one\n> two"), "two lines could be sent");
        assert!(!quoted(b"> one\n< two\n> three"));
    }
}
