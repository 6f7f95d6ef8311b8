//! How numbers that follow each other become a run.

use super::Scan;
use crate::field::Span;
use crate::text::characters::{
    DIGITS, HEX, hex_value, is_phone_number, is_serial_number, is_word, separator, word, word_of,
};
use crate::text::words::{Sender, Weight};

/// How bytes without a mark of their own are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Numbers {
    Hex,
    Decimal,
}

/// How bytes are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Style {
    /// `01 03`, with any separator.
    Separated,
    /// `0103`.
    Contiguous,
    /// `0x01`, `$01`.
    Prefixed,
    /// `01h`.
    Suffixed,
    /// `\x01`.
    Escaped,
}

impl Style {
    pub const ALL: [Self; 5] =
        [Self::Separated, Self::Contiguous, Self::Prefixed, Self::Suffixed, Self::Escaped];

    pub const fn name(self) -> &'static str {
        match self {
            Self::Separated => "separate hex bytes",
            Self::Contiguous => "hex digits without spaces",
            Self::Prefixed => "hex numbers with a prefix",
            Self::Suffixed => "hex bytes with an h",
            Self::Escaped => "an escaped string",
        }
    }
}

/// Bytes that follow each other with only marks between them.
#[derive(Clone, Copy, Debug)]
pub struct Run {
    /// Its bytes in [`Scan::hex`], [`Scan::decimal`] and [`Scan::places`].
    pub first: usize,
    pub end: usize,
    /// Its place in the line.
    pub span: Span,
    /// All its numbers can be hex.
    pub hex: bool,
    /// All its numbers can be decimal, and none is more than 255.
    pub decimal: bool,
    /// Written as `0x01`, `\x01` or `01h`: certainly bytes.
    pub marked: bool,
    pub style: Style,
    /// One run of digits behind a colon, as Modbus ASCII has it.
    pub colon: bool,
    /// Who speaks, by what stands before it.
    pub sender: Option<(Sender, Weight)>,
    /// No other word is between the one that says who speaks and the run.
    pub said: bool,
    /// The word before it, as [`word_of`] makes it a number.
    pub word: u32,
    /// Its breaks in [`Scan::breaks`].
    pub breaks: Span,
    pub(super) tokens: usize,
    /// Where the last token's bytes begin.
    pub(super) last: usize,
    /// How many tokens there are since the last break.
    pub(super) since: usize,
    /// It has a byte of one digit without a zero before it, and one with a zero.
    pub(super) single: bool,
    pub(super) padded: bool,
    /// Where the second token's bytes begin, counted from the last break.
    second: usize,
    /// The same in the line.
    pub(super) second_at: usize,
    separator: u8,
    /// How wide the first separator is.
    pub(super) gap: usize,
}

impl Run {
    /// How many bytes it has.
    pub fn len(&self) -> usize {
        self.end - self.first
    }

    /// How many numbers they are written as.
    pub fn tokens(&self) -> usize {
        self.tokens
    }

    /// Whether one of its numbers has a zero before its only digit.
    pub fn is_padded(&self) -> bool {
        self.padded
    }

    /// Whether commas stand between its numbers.
    pub fn is_list(&self) -> bool {
        self.separator == b','
    }

    /// Whether what is written so is a number of many digits, or single ones.
    pub fn is_of_digits(&self, text: &[u8]) -> bool {
        match text {
            number if self.tokens == 1 => is_serial_number(number),
            list if self.is_list() => !list.windows(2).any(|two| two.iter().all(u8::is_ascii_hexdigit)),
            number => is_phone_number(number),
        }
    }

    /// Whether a mark stands between its bytes.
    pub(super) fn is_parted_by(&self, mark: u8) -> bool {
        self.separator_or(0) == mark
    }

    /// What stands between its bytes, `otherwise` where it has only one number so far.
    fn separator_or(&self, otherwise: u8) -> u8 {
        if self.since < 2 { otherwise } else { self.separator }
    }

    /// It ends here, and what comes next has a break before it.
    pub(super) fn pause(&mut self, at: usize) {
        self.span.to = at;
        self.since = 0;
    }
}

/// What bytes of a token are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kind {
    /// They can be hex.
    pub hex: bool,
    /// They can be decimal.
    pub decimal: bool,
    pub marked: bool,
    pub style: Style,
}

/// Hex digits without a mark.
pub(super) const PLAIN: Kind = Kind { hex: true, decimal: false, marked: false, style: Style::Separated };

/// Decimal digits that cannot be hex.
pub(super) const DECIMAL: Kind = Kind { hex: false, decimal: true, ..PLAIN };

/// Bytes that are certainly hex.
pub(super) const fn marked(style: Style) -> Kind {
    Kind { hex: true, decimal: false, marked: true, style }
}

/// How the numbers of a run are written that are read without asking what else they could be.
#[derive(Clone, Copy, Debug)]
enum Same {
    /// `01`, with more than two characters between them: see [`Scan::same_pairs`].
    Pairs,
    /// `0103`
    Words,
    /// `0x01`, `0x1`
    Prefixed,
    /// `01h`
    Suffixed,
    /// `200`, where it can be no hex.
    Decimal { only: bool },
}

/// A number that is written like those before it.
struct Number {
    /// How many characters it has.
    length: usize,
    hex: u8,
    decimal: u8,
}

impl Same {
    /// How the numbers of `run` are written, the last of which has so many bytes, where nothing between them could mean
    /// something else than before.
    fn of(run: &Run, bytes: usize, gap: &[u8], numbers: Option<Numbers>) -> Option<Self> {
        let may_be_hex = run.hex && !run.marked && numbers != Some(Numbers::Decimal);
        match run.style {
            // Quotes, signs before a number, what shows the bytes as characters.
            _ if gap.iter().any(|c| matches!(c, b'"' | b'\'' | b'%'))
                || matches!(gap, [] | [b'|', ..] | [b' ' | b'\t', b' ' | b'\t' | b'|', ..])
                || matches!(gap, [_, .., b'-'] | [b' ', .., b'[']) =>
            {
                None
            }
            Style::Separated if may_be_hex && bytes == 1 && !run.single => Some(Self::Pairs),
            Style::Contiguous if may_be_hex && bytes == 2 => Some(Self::Words),
            Style::Prefixed if run.marked && run.hex && bytes == 1 => Some(Self::Prefixed),
            Style::Suffixed if run.marked && run.hex && bytes == 1 => Some(Self::Suffixed),
            Style::Separated if !run.marked && !run.hex && run.decimal && bytes == 1 => {
                Some(Self::Decimal { only: numbers.is_some() })
            }
            _ => None,
        }
    }

    /// The number that begins a text.
    fn number(self, text: &[u8]) -> Option<Number> {
        let digit = |at: usize| text.get(at).map_or(0xFF, |c| DIGITS[usize::from(*c)]);
        // One hex digit or two.
        let byte = |at: usize| match [digit(at), digit(at + 1)] {
            [0x10..=0xFF, _] => None,
            [high, low @ 0..=15] => Some((2, high * 16 + low)),
            [value, _] => Some((1, value)),
        };
        let marked = |length: usize, value: u8| Number { length, hex: value, decimal: value };
        match (self, text) {
            (Self::Pairs, _) => {
                let [high, low] = [digit(0), digit(1)];
                let decimal = if high < 10 && low < 10 { high * 10 + low } else { 0 };
                (high | low < 0x10).then(|| Number { length: 2, hex: high * 16 + low, decimal })
            }
            (Self::Words, _) => {
                let four = (0..4).all(|at| digit(at) < 0x10);
                four.then_some(Number { length: 4, hex: 0, decimal: 0 })
            }
            (Self::Prefixed, [b'0', b'x' | b'X', ..]) => {
                byte(2).map(|(digits, value)| marked(2 + digits, value))
            }
            (Self::Suffixed, _) => {
                let (digits, value) = byte(0)?;
                let own = &text[..digits];
                // "ach" is a word.
                let hex = own.iter().any(u8::is_ascii_digit) || own.iter().all(u8::is_ascii_uppercase);
                let ends = hex && matches!(text.get(digits), Some(b'h' | b'H'));
                ends.then(|| marked(digits + 1, value))
            }
            (Self::Decimal { only }, _) => {
                let length = text.iter().take(3).take_while(|c| c.is_ascii_digit()).count();
                let digits = text[..length].iter();
                let value = digits.fold(0, |sum, c| sum * 10 + u32::from(c - b'0'));
                let hex = if only || length > 2 { 0 } else { hex_value(&text[..length]) };
                let decimal = u8::try_from(value).ok().filter(|_| length > 0)?;
                Some(Number { length, hex, decimal })
            }
            _ => None,
        }
    }
}

impl Scan {
    /// The run that goes on, if the next number fits.
    pub(super) fn open(&self) -> Option<&Run> {
        self.runs.last().filter(|_| self.is_open)
    }

    pub(super) fn open_mut(&mut self) -> Option<&mut Run> {
        self.runs.last_mut().filter(|_| self.is_open)
    }

    /// Most of a log are numbers that are all written alike, with the same between them: they are read without
    /// asking what else they could be. Returns where that ends.
    #[inline]
    pub(super) fn same_again(&mut self, line: &[u8], at: usize) -> usize {
        #[cfg(test)]
        if self.slow {
            return at;
        }
        let Some(run) = self.open().filter(|run| run.span.to == at && run.since >= 2) else { return at };
        let may_be_hex = run.hex && !run.marked && !run.single && self.numbers != Some(Numbers::Decimal);
        let (pairs, words) = (may_be_hex && matches!(run.gap, 1 | 2), run.end - run.last == 2);
        let to = if words || !pairs { self.same_numbers(line, at) } else { at };
        if pairs { self.same_pairs(line, to) } else { to }
    }

    /// The same for bytes of two hex digits with one character or two between them.
    fn same_pairs(&mut self, line: &[u8], at: usize) -> usize {
        let hex_only = self.hex_only();
        let Self { runs, hex, decimal, places, .. } = self;
        let Some(run) = runs.last_mut() else { return at };
        let width = run.gap;
        let gap = [line[run.second_at - width], line[run.second_at - 1]];
        let digits = |next: &[u8]| {
            let [.., high, low] = *next else { return [0xFF; 2] };
            [DIGITS[usize::from(high)], DIGITS[usize::from(low)]]
        };
        let same = |next: &&[u8]| {
            let [high, low] = digits(next);
            next[0] == gap[0] && next[width - 1] == gap[1] && (high | low) < 16
        };
        let step = width + 2;
        let mut count = line[at..].chunks_exact(step).take_while(same).count();
        // The last one may be the beginning of a word, or in brackets with one: `[12 bytes]`.
        let goes_on = |c: &u8| is_word(*c) || (gap[width - 1] == b'[' && *c != b']');
        if line.get(at + count * step).is_some_and(goes_on) {
            count = count.saturating_sub(1);
        }
        if count == 0 {
            return at;
        }
        let to = at + count * step;
        let bytes = line[at..to].chunks_exact(step).map(digits);
        let (mut all_decimal, mut padded) = (true, false);
        hex.extend(bytes.clone().map(|[high, low]| {
            all_decimal &= (high < 10) & (low < 10);
            padded |= high == 0;
            high * 16 + low
        }));
        if !hex_only {
            decimal.extend(bytes.map(|[high, low]| high.wrapping_mul(10).wrapping_add(low)));
        }
        places.extend((1..=count).map(|nth| Span::new(at + nth * step - 2, at + nth * step)));
        run.decimal &= all_decimal;
        run.padded |= padded;
        run.tokens += count;
        run.since += count;
        (run.last, run.end) = (hex.len() - 1, hex.len());
        (run.span.to, run.colon) = (to, false);
        to
    }

    /// The same for numbers of any kind.
    fn same_numbers(&mut self, line: &[u8], at: usize) -> usize {
        let Some(run) = self.open() else { return at };
        let gap = &line[run.second_at - run.gap..run.second_at];
        let Some(same) = Same::of(run, run.end - run.last, gap, self.numbers) else { return at };
        let mut run = *run;
        let behind_gap = |at: usize| {
            let rest = &line[at..];
            let same = rest.len() > gap.len() && gap.iter().zip(rest).all(|(a, b)| a == b);
            same.then_some(at + gap.len())
        };
        let mut next = behind_gap(run.span.to);
        while let Some(from) = next {
            let Some(Number { length, hex, decimal }) = same.number(&line[from..]) else { break };
            let to = from + length;
            // What stands behind the last one may make something else of it.
            next = behind_gap(to);
            let ends = to == line.len() || next.is_some();
            let plain = matches!(same, Same::Pairs | Same::Decimal { .. });
            let single = plain && length == 1;
            if !ends || (single && run.padded && run.separator == b' ') {
                break;
            }
            run.single |= single;
            run.padded |= plain && length == 2 && line[from] == b'0';
            run.decimal = match same {
                Same::Pairs => run.decimal && hex < 0xA0 && hex & 0x0F < 0x0A,
                Same::Words => false,
                _ => true,
            };
            run.last = self.hex.len();
            match same {
                Same::Words => self.push_pairs(line, from, to),
                _ => self.push(hex, decimal, from, to),
            }
            run.tokens += 1;
            run.since += 1;
            run.span.to = to;
            run.colon = false;
        }
        let to = run.span.to;
        run.end = self.hex.len();
        if let Some(open) = self.open_mut() {
            *open = run;
        }
        to
    }

    pub(super) fn push(&mut self, hex: u8, decimal: u8, from: usize, to: usize) {
        self.hex.push(hex);
        if !self.hex_only() {
            self.decimal.push(decimal);
        }
        self.places.push(Span::new(from, to));
    }

    /// A byte with a mark of its own is the same in a list of decimal numbers.
    pub(super) fn push_marked(&mut self, value: u8, from: usize, to: usize) {
        self.push(value, value, from, to);
    }

    /// Takes the bytes from `first` on into the open run, or begins a new one.
    pub(super) fn join(&mut self, line: &[u8], at: usize, to: usize, first: usize, kind: Kind) {
        /// A run with more breaks is none.
        const BREAKS: usize = 8;
        /// A number of so many bytes can be a telegram by itself.
        const LONG: usize = 4;
        let short = kind.style == Style::Separated && to - at <= 2;
        let single = short && to - at == 1;
        let padded = short && to - at == 2 && line[at] == b'0';
        let Self { runs, breaks, hex, is_open, .. } = self;
        if let Some(run) = runs.last_mut().filter(|_| *is_open) {
            let gap = &line[run.span.to..at];
            let between = separator(gap);
            let both = (run.hex && kind.hex) || (run.decimal && kind.decimal);
            // In a list, decimal numbers can stand beside hex ones with a mark.
            let list = between == Some(b',') && run.separator_or(b',') == b',';
            // Long numbers in a list are a telegram each; in the rows of a dump they are words.
            let long = first - run.last >= LONG || hex.len() - first >= LONG;
            let fits = !(long && between != Some(b' '))
                && ((both && run.marked == kind.marked) || (list && (both || run.marked || kind.marked)));
            // `a 01 03`, `01 03 0`: who writes zeros before one digit writes them before each.
            let apart = between == Some(b' ') && !kind.marked;
            let odd = apart && ((padded && run.single && run.tokens == 1) || (single && run.padded));
            // `01 03 0C [12 bytes of data]`: the number in brackets counts what is not printed.
            let counts = gap.ends_with(b"[") && line.get(to) == Some(&b' ') && {
                let behind = word(line, to + 1);
                behind.to > to + 1 && behind.all & HEX == 0 || line.get(to + 1).is_some_and(|c| *c >= 0x80)
            };
            // `f(0x41, [0x10, 0x6A])`: a list among others is one by itself.
            let inner = gap.starts_with(b",") && gap.ends_with(b"[");
            if let Some(mark) = between.filter(|_| fits && !odd && !counts && !inner) {
                if run.since == 0 {
                    (run.separator, run.gap) = (0, 0);
                } else if run.since == 1 {
                    (run.separator, run.gap, run.second, run.second_at) = (mark, gap.len(), first, at);
                } else if mark != run.separator && !(run.tokens == 8 && run.separator == b' ' && gap == b"-")
                {
                    // `8: 01 03 …`: what stands between them changes behind the first one already.
                    let restart = run.since == 2;
                    let place = if restart { run.second } else { first };
                    // What was decimal before a break need not be so behind it.
                    let other = !run.hex && kind.hex;
                    if run.breaks.len() >= BREAKS || other {
                        self.close();
                        return self.begin(line, at, to, first, kind, (single, padded));
                    }
                    breaks.push(place);
                    run.breaks.to = breaks.len();
                    run.since = 0;
                    if restart {
                        run.since = 1;
                        (run.separator, run.gap, run.second, run.second_at) = (mark, gap.len(), first, at);
                    }
                }
                run.last = first;
                run.end = hex.len();
                run.span.to = to;
                run.tokens += 1;
                run.since += 1;
                run.decimal = (run.decimal || run.marked) && (kind.decimal || kind.marked);
                run.hex &= kind.hex;
                run.marked |= kind.marked;
                run.single |= single;
                run.padded |= padded;
                if kind.style == Style::Contiguous {
                    run.style = Style::Contiguous;
                }
                run.colon = false;
                return;
            }
        }
        self.close();
        self.begin(line, at, to, first, kind, (single, padded));
    }

    fn begin(
        &mut self,
        line: &[u8],
        at: usize,
        to: usize,
        first: usize,
        kind: Kind,
        (single, padded): (bool, bool),
    ) {
        let before = |back: usize| at.checked_sub(back).map(|place| line[place]);
        // `"ts":1718012345` is a number with a name.
        let name = |back| before(back).is_some_and(|c| c.is_ascii_alphanumeric());
        let quoted = matches!(before(2), Some(b'"' | b'\''));
        let colon = before(1) == Some(b':') && !name(2) && !(quoted && name(3));
        let sender = self.strong.map(|sender| (sender, Weight::Strong));
        self.is_open = true;
        self.runs.push(Run {
            first,
            end: self.hex.len(),
            span: Span::new(at, to),
            hex: kind.hex,
            decimal: kind.decimal,
            marked: kind.marked,
            style: kind.style,
            colon: colon && to - at >= 6,
            sender: sender.or(self.weak.map(|sender| (sender, Weight::Weak))),
            said: self.words_since == 0 && (self.strong.is_some() || self.weak.is_some()),
            word: self.last_word.map_or(0, |word| word_of(word.of(line))),
            breaks: Span::new(self.breaks.len(), self.breaks.len()),
            tokens: 1,
            last: first,
            since: 1,
            single,
            padded,
            second: first,
            second_at: at,
            separator: 0,
            gap: 0,
        });
    }

    /// The open run ends.
    pub(super) fn close(&mut self) {
        /// So many bytes that what is said before them is not said of the next ones.
        const TELEGRAM: usize = 4;
        let Some(run) = self.open_mut() else { return };
        // [01][03] is sent and <01><03> received: libmodbus writes so.
        let sender = match run.separator {
            b']' => Some(Sender::Logger),
            b'>' => Some(Sender::Other),
            _ => None,
        };
        if let Some(sender) = sender.filter(|_| run.tokens > 2 && run.sender.is_none()) {
            run.sender = Some((sender, Weight::Strong));
        }
        if run.len() >= TELEGRAM {
            (self.strong, self.weak) = (None, None);
        }
        self.is_open = false;
    }

    /// Joins numbers that are made bytes in the same way each: `(byte) 0x17, (byte) 0x03`, `Chr(23) + Chr(3)`.
    pub(super) fn join_casts(&mut self, line: &[u8]) {
        /// What stands between two of them is no longer.
        const LONGEST: usize = 32;
        let gap = |runs: &[Run], at: usize| -> Option<Span> {
            let (before, behind) = (runs.get(at.checked_sub(1)?)?, runs.get(at)?);
            let place = Span::new(before.span.to, behind.span.from.max(before.span.to));
            let alike = (before.marked, before.end) == (behind.marked, behind.first)
                && before.breaks.is_empty()
                && behind.breaks.is_empty();
            // Characters have their quotes themselves: `'\x17', '\x03'`.
            let character = |run: &Run| run.style == Style::Escaped && run.len() == 1;
            let around = || {
                place.of(line).iter().any(|c| matches!(c, b'(' | b'{' | b'"' | b'\''))
                    || (character(before) && character(behind))
            };
            (alike && place.len() <= LONGEST && around()).then_some(place)
        };
        let joins = |runs: &[Run], at: usize| {
            gap(runs, at).map(|place| place.of(line)).is_some_and(|own| {
                let same = |other| gap(runs, other).is_some_and(|place| place.of(line) == own);
                is_cast(own) || same(at - 1) || same(at + 1)
            })
        };
        if !(1..self.runs.len()).any(|at| joins(&self.runs, at)) {
            return;
        }
        let runs = std::mem::take(&mut self.runs);
        for (at, run) in runs.iter().enumerate() {
            let both = |last: &Run| (last.hex && run.hex) || (last.decimal && run.decimal);
            match self.runs.last_mut().filter(|last| joins(&runs, at) && both(last)) {
                Some(last) => {
                    (last.end, last.span.to, last.last) = (run.end, run.span.to, run.last);
                    last.tokens += run.tokens;
                    last.hex &= run.hex;
                    last.decimal &= run.decimal;
                    last.padded |= run.padded;
                    last.separator = b',';
                }
                None => self.runs.push(*run),
            }
        }
    }

    /// The open run turns out to be none.
    pub(super) fn drop_open(&mut self) {
        let Some(run) = self.runs.pop_if(|_| self.is_open) else { return };
        self.is_open = false;
        self.forget(run.first);
    }

    /// Forgets the bytes from `first` on.
    pub(super) fn forget(&mut self, first: usize) {
        self.hex.truncate(first);
        self.decimal.truncate(first);
        self.places.truncate(first);
    }
}

/// Whether a comma and the name of a type in brackets stand between two numbers: `, (byte)`.
fn is_cast(gap: &[u8]) -> bool {
    let behind = gap.strip_prefix(b",").map(<[u8]>::trim_ascii);
    let name = behind.and_then(|it| it.strip_prefix(b"(")?.strip_suffix(b")"));
    name.is_some_and(|name| !name.is_empty() && name.iter().all(|c| c.is_ascii_alphanumeric() || *c == b'_'))
}
