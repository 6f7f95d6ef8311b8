//! The form of a telegram: entries that a person can edit, and from them the telegram again.

use super::{Algorithm, Deviation, Deviations, Items, Part, Path, Telegram, WINDOW, Walk, Walker};
use crate::field::{
    Argument, Format, Message, Numbering, Order, Role, Spec, escaped, hex, number_text, parse_float,
    unescaped,
};
use crate::message;

/// What a person can edit of a telegram.
#[derive(Clone, Debug, PartialEq)]
pub struct Form {
    pub entries: Vec<Entry>,
}

impl Form {
    /// Calls `visit` with every entry, those of lists and groups included.
    pub fn visit<'a>(&'a self, visit: &mut impl FnMut(&'a Entry)) {
        self.entries.iter().for_each(|entry| entry.visit(visit));
    }
}

/// One field of a form.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    pub spec: &'static Spec,
    pub number: Option<Numbering>,
    /// The field's place in the telegram: `pdu.values.3.value`.
    pub path: String,
    pub content: Content,
}

impl Entry {
    fn visit<'a>(&'a self, visit: &mut impl FnMut(&'a Self)) {
        visit(self);
        match &self.content {
            Content::List { items } => items.iter().flatten().for_each(|entry| entry.visit(visit)),
            Content::Group { entries } => entries.iter().for_each(|entry| entry.visit(visit)),
            _ => {}
        }
    }

    /// The last part of its path: what a level has too much or too little is shown by one spec.
    pub fn key(&self) -> &str {
        self.path.rsplit('.').next().unwrap_or_default()
    }

    /// What is written into it, where that is a text.
    pub fn text(&self) -> Option<&str> {
        match &self.content {
            Content::Number { text, .. }
            | Content::Computed { text, .. }
            | Content::Bytes { text }
            | Content::Text { text }
            | Content::Extra { text }
            | Content::Cut { text } => Some(text),
            Content::Choice { .. } | Content::List { .. } | Content::Group { .. } => None,
        }
    }

    /// The field's name in this telegram: "Quantity", "Register 215".
    pub fn label(&self) -> Message {
        self.spec.numbered(self.number)
    }
}

#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// A number of `width` bytes, as the person writes it: `200`, `0xC8`, `C8h`, `-1`.
    Number {
        width: usize,
        text: String,
    },
    /// The choice that made the form what it is. Another one of `spec.names` makes another form.
    Choice {
        raw: u64,
        chosen: &'static Spec,
    },
    /// A number that follows from the others. `text` is empty, or what to write instead.
    Computed {
        width: usize,
        computed: u64,
        text: String,
    },
    /// Bytes in hex.
    Bytes {
        text: String,
    },
    /// Bytes as characters, [`escaped`] where they cannot be shown.
    Text {
        text: String,
    },
    /// A list that can grow and shrink.
    List {
        items: Vec<Vec<Entry>>,
    },
    Group {
        entries: Vec<Entry>,
    },
    /// What a faulty telegram has too much (hex) or how many bytes it keeps (a number).
    Extra {
        text: String,
    },
    Cut {
        text: String,
    },
}

/// An entry that does not fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Misfit {
    pub path: String,
    pub message: Message,
}

/// What a form gave of which some entries do not fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Unfit {
    pub misfits: Vec<Misfit>,
    /// Those of the entries that fit.
    pub deviations: Deviations,
}

/// The form of `telegram` as it is, with its deviations.
pub fn form(telegram: &mut dyn Telegram, deviations: &Deviations) -> Form {
    let computed = super::write::compute(telegram, deviations);
    let mut show =
        Show { level: Vec::new(), path: Path::default(), deviations, computed: &computed, number: None };
    // The form never stops a walk.
    let _ = telegram.walk(&mut show);
    show.close_window(String::new());
    Form { entries: show.level }
}

/// Fills `telegram` from `form`. Entries that do not fit leave their field as it was and are
/// returned; entries that the telegram does not have are left out.
pub fn fill(telegram: &mut dyn Telegram, form: &Form) -> Result<Deviations, Unfit> {
    let mut fill = Fill {
        level: &form.entries,
        path: Path::default(),
        deviations: Deviations::default(),
        misfits: Vec::new(),
    };
    // The form never stops a walk.
    let _ = telegram.walk(&mut fill);
    fill.close_window(String::new());
    let Fill { deviations, misfits, .. } = fill;
    if misfits.is_empty() { Ok(deviations) } else { Err(Unfit { misfits, deviations }) }
}

/// Reads a number as a person writes it: decimal, `0xC8`, `C8h`, or negative as two's complement.
pub fn parse_number(text: &str, width: usize) -> Result<u64, Message> {
    let written = text.trim();
    let widest = u64::MAX >> (64 - 8 * width);
    let expected = || {
        message!(
            "“{text}” is not a number from 0 to {widest}: write it in decimal, or in hex as 0xC8 or C8h",
            text = written.to_owned(),
            widest = widest
        )
    };
    let lower = written.to_ascii_lowercase();
    let hex_digits = lower.strip_prefix("0x").or_else(|| lower.strip_suffix('h'));
    let number = match (hex_digits, lower.strip_prefix(['-', '\u{2212}'])) {
        (Some(digits), _) if !digits.starts_with('+') => u64::from_str_radix(digits, 16).ok(),
        // The smallest negative number is −(widest / 2) − 1: its top bit is set, as the wire has it.
        (None, Some(digits)) => digits
            .parse::<u64>()
            .ok()
            .filter(|amount| *amount <= widest / 2 + 1)
            .map(|amount| amount.wrapping_neg() & widest),
        _ if lower.starts_with('+') => None,
        _ => lower.parse().ok(),
    };
    number.filter(|number| *number <= widest).ok_or_else(expected)
}

/// Reads a value as its field shows it: a float, a number with decimal places, the name of a value,
/// or a number like any other.
pub fn parse_value(text: &str, width: usize, spec: &Spec) -> Result<u64, Message> {
    let written = text.trim();
    if let Some(name) = spec.names.iter().find(|name| name.label.eq_ignore_ascii_case(written)) {
        return Ok(name.value);
    }
    if let Some(raw) = parse_bits(written, spec) {
        return Ok(raw);
    }
    // With the unit behind it, as the field shows it.
    let written = written.strip_suffix(spec.unit).unwrap_or(written).trim_end();
    match spec.format {
        Format::Float => parse_float_text(written, width),
        Format::Places(places) => parse_places(written, width, places),
        _ => parse_number(written, width),
    }
}

/// A number whose bits each say something, by their names: `good, limit 1 violated`.
fn parse_bits(written: &str, spec: &Spec) -> Option<u64> {
    let named = |word: &str| {
        spec.bits.iter().find_map(|part| {
            let name = part.names.iter().find(|name| name.label.eq_ignore_ascii_case(word));
            let flag = part.count == 1 && part.names.is_empty() && part.label.eq_ignore_ascii_case(word);
            name.map(|name| (part, name.value)).or(flag.then_some((part, 1)))
        })
    };
    let mut words = written.split(',').map(|word| named(word.trim()));
    words.try_fold(0, |raw, named| named.map(|(part, value)| part.put(raw, value)))
}

fn parse_float_text(written: &str, width: usize) -> Result<u64, Message> {
    if let Some(raw) = written.strip_prefix("NaN(").and_then(|rest| rest.strip_suffix(')')) {
        return parse_number(raw, width);
    }
    parse_float(written, width).ok_or_else(|| {
        message!(
            "“{text}” is not a number that {bytes} can hold: write it like 123.456, −0.5 or 1e6",
            text = written.to_owned(),
            bytes = Message::bytes(width)
        )
    })
}

fn parse_places(written: &str, width: usize, places: u32) -> Result<u64, Message> {
    let widest = u64::MAX >> (64 - 8 * width);
    let (whole, behind) = written.split_once('.').unwrap_or((written, ""));
    let digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    let padded = format!("{whole}{behind:0<digits$}", digits = places as usize);
    let fits = !whole.is_empty() && digits(whole) && digits(behind) && behind.len() <= places as usize;
    padded.parse().ok().filter(|raw| fits && *raw <= widest).ok_or_else(|| {
        message!(
            "“{text}” is not a number from 0 to {widest} with at most {places} decimal places",
            text = written.to_owned(),
            widest = number_text(widest, width, Format::Places(places)),
            places = u64::from(places)
        )
    })
}

fn parse_text(text: &str) -> Result<Vec<u8>, Message> {
    unescaped(text).map_err(|what| {
        message!(
            "“{what}” is not one byte: write characters of one byte, or a byte in hex as {example}",
            what = what,
            example = Argument::Text("\\x5C".to_owned())
        )
    })
}

/// Reads bytes as a person writes them in a form: `01 03 00C8`.
fn parse_bytes(text: &str) -> Result<Vec<u8>, Message> {
    let digits: Vec<u8> = text.bytes().filter(|byte| !byte.is_ascii_whitespace()).collect();
    let byte = |pair: &[u8]| u8::from_str_radix(std::str::from_utf8(pair).ok()?, 16).ok();
    let all_hex = digits.iter().all(u8::is_ascii_hexdigit) && digits.len().is_multiple_of(2);
    all_hex.then(|| digits.chunks(2).map_while(byte).collect()).ok_or_else(|| {
        message!("“{text}” is not hex: write two digits for each byte", text = text.to_owned())
    })
}

/// Reads check bytes as they are on the wire, the first one most significant: `84 35`, `8435h`.
fn parse_check(text: &str, width: usize) -> Result<u64, Message> {
    let lower = text.trim().to_ascii_lowercase();
    if lower.starts_with("0x") || lower.ends_with('h') {
        return parse_number(&lower, width);
    }
    let bytes = parse_bytes(text).ok().filter(|bytes| bytes.len() == width);
    bytes.map(|bytes| Order::Big.number(&bytes)).ok_or_else(|| {
        message!(
            "“{text}” is not {bytes} in hex, as on the wire",
            text = text.trim().to_owned(),
            bytes = Message::bytes(width)
        )
    })
}

/// Value to entries.
struct Show<'a> {
    level: Vec<Entry>,
    path: Path,
    deviations: &'a Deviations,
    computed: &'a Deviations,
    /// The first number of the list at hand, and the index of its item.
    number: Option<(Option<u64>, u64)>,
}

impl Show<'_> {
    fn entry(&mut self, spec: &'static Spec, content: Content) {
        let path = self.path.join(spec.key);
        let number = self.numbering(spec);
        self.level.push(Entry { spec, number, path, content });
    }

    fn numbering(&mut self, spec: &'static Spec) -> Option<Numbering> {
        self.number.take().map(|(first, index)| Numbering::new(first, index * spec.step))
    }

    fn computed(&mut self, spec: &'static Spec, width: usize) {
        let path = self.path.join(spec.key);
        // A check is known by its bytes, a count by its number.
        let text = self.deviations.value(&path).map_or(String::new(), |raw| match spec.role {
            Role::Check => hex(&raw.to_be_bytes()[8 - width..]),
            _ => number_text(raw, width, Format::Hex),
        });
        let computed = self.computed.value(&path).unwrap_or(0);
        self.entry(spec, Content::Computed { width, computed, text });
    }

    /// Runs `part` on a level of its own and returns that level.
    fn nested(&mut self, part: impl FnOnce(&mut Self) -> Walk) -> Walk<Vec<Entry>> {
        let outer = std::mem::take(&mut self.level);
        let walk = part(self);
        let inner = std::mem::replace(&mut self.level, outer);
        walk.map(|()| inner)
    }

    fn close_window(&mut self, path: String) {
        let content = match self.deviations.get(&path) {
            Some(Deviation::Extra(extra)) => Content::Extra { text: hex(extra) },
            Some(Deviation::Cut(length)) => Content::Cut { text: length.to_string() },
            Some(Deviation::Value(_)) | None => return,
        };
        self.level.push(Entry { spec: &super::UNEXPECTED, number: None, path, content });
    }
}

impl Walker for Show<'_> {
    fn number(&mut self, spec: &'static Spec, width: usize, raw: &mut u64) -> Walk {
        self.entry(spec, Content::Number { width, text: number_text(*raw, width, spec.format) });
        Ok(())
    }

    fn select(
        &mut self,
        spec: &'static Spec,
        _: usize,
        raw: &mut u64,
        choices: &dyn Fn(u64) -> &'static Spec,
    ) -> Walk {
        self.entry(spec, Content::Choice { raw: *raw, chosen: choices(*raw) });
        Ok(())
    }

    fn announce(&mut self, spec: &'static Spec, width: usize, items: usize, _: usize) -> Walk<usize> {
        self.computed(spec, width);
        Ok(items)
    }

    fn derived(&mut self, spec: &'static Spec, width: usize, _: Option<u64>) -> Walk {
        self.computed(spec, width);
        Ok(())
    }

    fn bytes(&mut self, spec: &'static Spec, bytes: &mut Vec<u8>, _: Option<usize>) -> Walk {
        let content = match spec.format {
            Format::Text => Content::Text { text: escaped(bytes) },
            _ => Content::Bytes { text: hex(bytes) },
        };
        self.entry(spec, content);
        Ok(())
    }

    fn items(
        &mut self,
        spec: &'static Spec,
        items: &mut dyn Items,
        _: Option<usize>,
        first: Option<u64>,
    ) -> Walk {
        let path = self.path.join(spec.key);
        let depth = self.path.enter(spec.key);
        let mut shown = Vec::new();
        for index in 0..items.len() {
            let depth = self.path.enter_item(index);
            self.number = Some((first, index as u64));
            shown.push(self.nested(|show| items.walk(index, show))?);
            self.path.leave(depth);
        }
        self.path.leave(depth);
        self.level.push(Entry { spec, number: None, path, content: Content::List { items: shown } });
        Ok(())
    }

    fn within(&mut self, spec: &'static Spec, part: Part<'_>) -> Walk {
        let path = self.path.join(spec.key);
        let number = self.numbering(spec);
        let depth = self.path.enter(spec.key);
        let entries = self.nested(|show| part(show))?;
        self.path.leave(depth);
        self.level.push(Entry { spec, number, path, content: Content::Group { entries } });
        Ok(())
    }

    fn window(&mut self, _: usize, part: Part<'_>) -> Walk {
        part(self)?;
        let path = self.path.join(WINDOW);
        self.close_window(path);
        Ok(())
    }

    fn checksum(&mut self, spec: &'static Spec, algorithm: &'static Algorithm, _: usize) -> Walk {
        self.computed(spec, algorithm.width);
        Ok(())
    }
}

/// Entries to value.
struct Fill<'a> {
    level: &'a [Entry],
    path: Path,
    deviations: Deviations,
    misfits: Vec<Misfit>,
}

impl<'a> Fill<'a> {
    /// The content of this level's entry `spec`.
    fn content(&self, spec: &'static Spec) -> Option<&'a Content> {
        self.level.iter().find(|entry| std::ptr::eq(entry.spec, spec)).map(|entry| &entry.content)
    }

    /// What `text` gives, or `None` and a misfit of the entry at `path`.
    fn parsed<T>(&mut self, path: String, parsed: Result<T, Message>) -> Option<T> {
        parsed.map_err(|message| self.misfits.push(Misfit { path, message })).ok()
    }

    fn computed(&mut self, spec: &'static Spec) {
        if let Some(Content::Computed { width, text, .. }) = self.content(spec)
            && !text.trim().is_empty()
        {
            let path = self.path.join(spec.key);
            let parsed = match spec.role {
                Role::Check => parse_check(text, *width),
                _ => parse_number(text, *width),
            };
            if let Some(raw) = self.parsed(path.clone(), parsed) {
                self.deviations.set(path, Deviation::Value(raw));
            }
        }
    }

    fn close_window(&mut self, path: String) {
        let Some(entry) = self.level.iter().find(|entry| {
            entry.path == path && matches!(entry.content, Content::Extra { .. } | Content::Cut { .. })
        }) else {
            return;
        };
        let deviation = match &entry.content {
            Content::Extra { text } => parse_bytes(text).map(Deviation::Extra),
            Content::Cut { text } => parse_number(text, 4).map(|length| Deviation::Cut(length as usize)),
            _ => return,
        };
        if let Some(deviation) = self.parsed(path.clone(), deviation) {
            self.deviations.set(path, deviation);
        }
    }

    /// Runs `part` with `level` as the entries at hand.
    fn at(&mut self, level: &'a [Entry], part: impl FnOnce(&mut Self) -> Walk) -> Walk {
        let outer = std::mem::replace(&mut self.level, level);
        let walk = part(self);
        self.level = outer;
        walk
    }
}

impl Walker for Fill<'_> {
    fn number(&mut self, spec: &'static Spec, _: usize, raw: &mut u64) -> Walk {
        if let Some(Content::Number { width, text }) = self.content(spec)
            && let Some(number) = self.parsed(self.path.join(spec.key), parse_value(text, *width, spec))
        {
            *raw = number;
        }
        Ok(())
    }

    fn select(
        &mut self,
        spec: &'static Spec,
        _: usize,
        raw: &mut u64,
        _: &dyn Fn(u64) -> &'static Spec,
    ) -> Walk {
        if let Some(Content::Choice { raw: chosen, .. }) = self.content(spec) {
            *raw = *chosen;
        }
        Ok(())
    }

    fn announce(&mut self, spec: &'static Spec, _: usize, items: usize, _: usize) -> Walk<usize> {
        self.computed(spec);
        Ok(items)
    }

    fn derived(&mut self, spec: &'static Spec, _: usize, _: Option<u64>) -> Walk {
        self.computed(spec);
        Ok(())
    }

    fn bytes(&mut self, spec: &'static Spec, bytes: &mut Vec<u8>, _: Option<usize>) -> Walk {
        let parsed = match self.content(spec) {
            Some(Content::Bytes { text }) => parse_bytes(text),
            Some(Content::Text { text }) => parse_text(text),
            _ => return Ok(()),
        };
        if let Some(parsed) = self.parsed(self.path.join(spec.key), parsed) {
            *bytes = parsed;
        }
        Ok(())
    }

    fn items(
        &mut self,
        spec: &'static Spec,
        items: &mut dyn Items,
        _: Option<usize>,
        _: Option<u64>,
    ) -> Walk {
        let Some(Content::List { items: entered }) = self.content(spec) else { return Ok(()) };
        items.resize(entered.len());
        let depth = self.path.enter(spec.key);
        for (index, entries) in entered.iter().enumerate() {
            let depth = self.path.enter_item(index);
            self.at(entries, |fill| items.walk(index, fill))?;
            self.path.leave(depth);
        }
        self.path.leave(depth);
        Ok(())
    }

    fn within(&mut self, spec: &'static Spec, part: Part<'_>) -> Walk {
        let Some(Content::Group { entries }) = self.content(spec) else { return part(self) };
        let depth = self.path.enter(spec.key);
        self.at(entries, |fill| part(fill))?;
        self.path.leave(depth);
        Ok(())
    }

    fn window(&mut self, _: usize, part: Part<'_>) -> Walk {
        part(self)?;
        let path = self.path.join(WINDOW);
        self.close_window(path);
        Ok(())
    }

    fn checksum(&mut self, spec: &'static Spec, _: &'static Algorithm, _: usize) -> Walk {
        self.computed(spec);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::{Bits, Name};

    #[test]
    fn numbers_are_read_in_every_usual_notation() {
        for (text, width, number) in [
            ("200", 2, 200),
            (" 0xC8 ", 2, 200),
            ("C8h", 2, 200),
            ("00c8H", 2, 200),
            ("-1", 2, 0xFFFF),
            ("\u{2212}32768", 2, 0x8000),
            ("-2147483648", 4, 0x8000_0000),
            ("18446744073709551615", 8, u64::MAX),
        ] {
            assert_eq!(parse_number(text, width), Ok(number), "{text}");
        }
        for text in ["", "65536", "-32769", "C8", "0x", "h", "1.5", "+1", "0x+1", "--1"] {
            assert!(parse_number(text, 2).is_err(), "{text}");
        }
    }

    #[test]
    fn values_are_read_as_they_are_shown() {
        static FLOAT: Spec = Spec::new("f", "F").format(Format::Float);
        static TENTHS: Spec = Spec::new("t", "T").format(Format::Places(1)).unit("V");
        let shown = |spec: &Spec, raw, width| number_text(raw, width, spec.format);
        for raw in [0x42F6_E979, 0x8000_0000, 1, 0x7F80_0000, 0xFF80_0000, 0x7FC0_0001, 0xFFFF_FFFF] {
            assert_eq!(parse_value(&shown(&FLOAT, raw, 4), 4, &FLOAT), Ok(raw));
        }
        for raw in [0x405E_DD2F_1A9F_BE77, 1, 0x7FF0_0000_0000_0001, 0xFFF0_0000_0000_0000] {
            assert_eq!(parse_value(&shown(&FLOAT, raw, 8), 8, &FLOAT), Ok(raw));
        }
        assert!(parse_value("1e99", 4, &FLOAT).is_err());
        assert!(parse_value("nan", 4, &FLOAT).is_err());
        for (text, raw) in [("1.5", 15), ("1.5 V", 15), ("20", 200), ("6553.5", 65535)] {
            assert_eq!(parse_value(text, 2, &TENTHS), Ok(raw), "{text}");
        }
        for text in ["", ".5", "1.55", "6553.6", "-1", "x"] {
            assert!(parse_value(text, 2, &TENTHS).is_err(), "{text}");
        }
    }

    #[test]
    fn bits_are_read_by_their_names() {
        const MODES: &[Name] =
            &[Name { value: 0, label: "idle", note: "" }, Name { value: 2, label: "fast", note: "" }];
        static BITS: Spec = Spec::new("b", "B")
            .bits(&[Bits::part(0, 2, "mode", "mode").names(MODES), Bits::flag(7, "on", "switched on")]);
        for (text, raw) in [("fast", 2), ("Switched on, fast", 0x82), ("idle", 0), ("0x41", 0x41)] {
            assert_eq!(parse_value(text, 1, &BITS), Ok(raw), "{text}");
        }
        assert!(parse_value("fast, slow", 1, &BITS).is_err());
    }

    #[test]
    fn bytes_are_read_with_or_without_spaces() {
        assert_eq!(parse_bytes("01 03 00C8"), Ok(vec![1, 3, 0, 0xC8]));
        assert_eq!(parse_bytes(""), Ok(vec![]));
        assert!(parse_bytes("0").is_err());
        assert!(parse_bytes("zz").is_err());
    }
}
