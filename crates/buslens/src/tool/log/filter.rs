#[cfg(feature = "json")]
use serde::{Deserialize, Serialize};

use super::{Bytes, Entry, Log, Role, Source, State};
use crate::field::Direction;
use crate::frame::{Speaker, Verdict};

/// Which telegrams of a log are to be seen. Whatever is `None` lets all through.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize))]
pub struct Filter {
    pub port: Option<u16>,
    pub unit: Option<u8>,
    pub function: Option<u8>,
    pub direction: Option<Direction>,
    pub wanted: Wanted,
    pub state: Option<State>,
    /// First and last microsecond.
    pub times: Option<(i64, i64)>,
    /// First and last index.
    pub places: Option<(usize, usize)>,
    /// Hex bytes, a register's number or name, or any text of the log's lines.
    pub text: String,
}

/// Which telegrams by what happened to them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize))]
pub enum Wanted {
    #[default]
    All,
    /// All that is wrong.
    Errors,
    CheckFailed,
    Unanswered,
    Exceptions,
    /// Retries, echoes, copies, late answers, and answers that nobody asked for.
    Odd,
    Discarded,
}

impl Wanted {
    pub const ALL: [Self; 7] = [
        Self::All,
        Self::Errors,
        Self::CheckFailed,
        Self::Unanswered,
        Self::Exceptions,
        Self::Odd,
        Self::Discarded,
    ];

    pub const fn key(self) -> &'static str {
        match self {
            Self::All => "all",
            Self::Errors => "errors",
            Self::CheckFailed => "check-failed",
            Self::Unanswered => "unanswered",
            Self::Exceptions => "exceptions",
            Self::Odd => "odd",
            Self::Discarded => "discarded",
        }
    }

    pub const fn label(self) -> &'static str {
        match self {
            Self::All => "everything",
            Self::Errors => "all errors",
            Self::CheckFailed => "wrong checksums",
            Self::Unanswered => "unanswered requests",
            Self::Exceptions => "exceptions",
            Self::Odd => "retries, echoes, late or unexpected responses",
            Self::Discarded => "discarded bytes",
        }
    }

    /// The choice with this key.
    pub fn of(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|wanted| wanted.key() == key)
    }

    fn wants(self, log: &Log, entry: &Entry) -> bool {
        match self {
            Self::All => true,
            Self::Errors => log.state(entry).is_wrong(),
            Self::CheckFailed => entry.verdict == Verdict::Wrong,
            Self::Unanswered => entry.unanswered(),
            Self::Exceptions => entry.refuses(),
            Self::Odd => !matches!(entry.role, Role::Plain | Role::Broadcast | Role::Discarded),
            Self::Discarded => entry.role == Role::Discarded,
        }
    }
}

/// Whether something went wrong with a telegram.
pub fn is_error(entry: &Entry) -> bool {
    matches!(entry.verdict, Verdict::Wrong | Verdict::Unchecked)
        || entry.unanswered()
        || entry.refuses()
        || matches!(entry.role, Role::Discarded | Role::Unasked | Role::Late)
}

/// What the text of a filter means.
enum Text {
    Any,
    Bytes(Vec<u8>),
    /// Registers, first and last.
    Registers(Vec<(u16, u16)>),
    /// Where lines of the file hold it.
    Lines(Vec<u64>),
}

impl Log {
    /// The indices of the entries that `filter` lets through. `source` of `size` bytes is searched
    /// where the filter's text is neither bytes nor a register.
    pub fn filtered(&self, filter: &Filter, source: &dyn Source, size: u64) -> Vec<u32> {
        let text = self.meant(filter.text.trim(), source, size);
        let mut bytes = Bytes::new(self, source);
        let mut lets = |index: usize, entry: &Entry| {
            filter.port.is_none_or(|port| entry.port == port)
                && filter.unit.is_none_or(|unit| entry.unit == Some(unit))
                && filter.function.is_none_or(|function| entry.plain_function() == function && entry.counts())
                && filter.direction.is_none_or(|direction| entry.direction == direction && entry.counts())
                && filter.wanted.wants(self, entry)
                && filter.state.is_none_or(|state| self.state(entry) == state)
                && filter
                    .times
                    .is_none_or(|(from, to)| entry.time().is_some_and(|time| (from..=to).contains(&time)))
                && filter.places.is_none_or(|(from, to)| (from..=to).contains(&index))
                && match &text {
                    Text::Any => true,
                    Text::Bytes(wanted) => holds(bytes.of(entry), wanted),
                    Text::Registers(ranges) => {
                        self.registers_in(&mut bytes, entry).is_some_and(|(start, count)| {
                            let last = start.saturating_add(count.saturating_sub(1));
                            ranges.iter().any(|(from, to)| start <= *to && last >= *from)
                        })
                    }
                    Text::Lines(offsets) => offsets.binary_search(&entry.offset).is_ok(),
                }
        };
        let entries = self.entries().iter().enumerate();
        entries.filter(|(index, entry)| lets(*index, entry)).map(|(index, _)| index as u32).collect()
    }

    /// Bytes, a register, a name of the device's manual, or else any text.
    fn meant(&self, text: &str, source: &dyn Source, size: u64) -> Text {
        if text.is_empty() {
            return Text::Any;
        }
        if let Some(bytes) = hex_bytes(text) {
            return Text::Bytes(bytes);
        }
        let (number, radix) = match text.strip_prefix("0x").or_else(|| text.strip_suffix(['h', 'H'])) {
            Some(hex) => (hex, 16),
            None => (text, 10),
        };
        if let Ok(address) = u16::from_str_radix(number, radix) {
            return Text::Registers(vec![(address, address)]);
        }
        let named: Vec<_> = self.options.devices().flat_map(|profile| profile.addresses(text)).collect();
        if !named.is_empty() {
            return Text::Registers(named);
        }
        Text::Lines(self.lines_with(text, source, size))
    }

    /// The first register of a telegram and their number; of a response, those of its request.
    pub fn registers(&self, source: &dyn Source, entry: &Entry) -> Option<(u16, u16)> {
        self.registers_in(&mut Bytes::new(self, source), entry)
    }

    /// The same, where many are looked at.
    pub(super) fn registers_in(&self, bytes: &mut Bytes<'_>, entry: &Entry) -> Option<(u16, u16)> {
        let request = match entry.direction {
            Direction::Request => *entry,
            Direction::Response => self.entry(entry.partner()?),
        };
        let Speaker::Pdu(inside) = request.protocol().speaker else { return None };
        let (pdu, _) = inside(bytes.of(&request));
        let number = |at: usize| pdu.get(at..at + 2).map(|pair| u16::from_be_bytes([pair[0], pair[1]]));
        match request.plain_function() {
            5 | 6 | 22 => Some((number(1)?, 1)),
            1..=4 | 15 | 16 | 23 | 100 | 101 => Some((number(1)?, number(3)?)),
            _ => None,
        }
    }

    /// Where the lines begin that hold `text`, in any letters.
    fn lines_with(&self, text: &str, source: &dyn Source, size: u64) -> Vec<u64> {
        const PART: usize = 1 << 20;
        let text = text.to_ascii_lowercase().into_bytes();
        let size = self.transcoded.as_ref().map_or(size, |text| text.len() as u64);
        let mut found = Vec::new();
        let (mut from, mut line_start) = (0_u64, 0_u64);
        let mut line: Vec<u8> = Vec::new();
        while from < size {
            let part = self.read_again(source, from, PART);
            if part.is_empty() {
                break;
            }
            for c in &part {
                from += 1;
                if matches!(c, b'\n' | b'\r') {
                    if holds(&line, &text) {
                        found.push(line_start);
                    }
                    line.clear();
                    line_start = from;
                } else if line.len() < PART {
                    line.push(c.to_ascii_lowercase());
                }
            }
        }
        if holds(&line, &text) {
            found.push(line_start);
        }
        found
    }
}

/// `01 03`, `0103`: at least two bytes, so that a number stays a number.
fn hex_bytes(text: &str) -> Option<Vec<u8>> {
    let digits: Vec<u32> =
        text.chars().filter(|c| !c.is_whitespace()).map(|c| c.to_digit(16)).collect::<Option<_>>()?;
    let spaced = text.contains(char::is_whitespace) && text.split_whitespace().all(|word| word.len() == 2);
    let long = digits.len() >= 6 || text.starts_with('0');
    ((spaced || long) && digits.len() >= 4 && digits.len().is_multiple_of(2))
        .then(|| digits.chunks(2).map(|pair| (pair[0] << 4 | pair[1]) as u8).collect())
}

/// Whether `part` is in `whole`.
fn holds(whole: &[u8], part: &[u8]) -> bool {
    let Some(first) = part.first() else { return true };
    let mut rest = whole;
    while let Some(at) = rest.iter().position(|byte| byte == first) {
        if rest[at..].starts_with(part) {
            return true;
        }
        rest = &rest[at + 1..];
    }
    false
}
