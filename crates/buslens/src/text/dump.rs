//! Rows of hex dumps: xxd, `hexdump -C`, od, Wireshark. An offset, bytes, and often the same bytes
//! as characters.

use super::characters::DIGITS;
use super::words::Sender;
use crate::field::Span;

/// Follows the offsets from row to row. A dump of a conversation counts those of each side by themselves, and
/// something before the offset tells the two apart: `TX 0010:`, or only how far the row is indented.
#[derive(Debug, Hash, Default)]
pub struct Dump {
    streams: Vec<Stream>,
    /// The stream of the last row.
    latest: usize,
}

/// Rows whose offsets follow each other.
#[derive(Clone, Copy, Debug, Hash)]
struct Stream {
    /// What stands before the offset of each row.
    before: u32,
    /// The offset that the next row should have.
    next: usize,
}

/// What the offset of a row says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Row {
    /// Where the bytes begin in the line.
    pub from: usize,
    offset: usize,
    /// It goes on where the row before it ended, or further on.
    pub continues: bool,
    pub words: Words,
    before: u32,
}

/// How the numbers of a row are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Words {
    /// In hex, in the order of the bytes.
    InOrder,
    /// In hex, those of two bytes with the low byte first, as `od -x` and `hexdump` write them.
    LowFirst,
    /// In octal: bytes in three digits (`od -b`), two bytes with the low one first in six (`od`).
    Octal,
}

impl Dump {
    /// The row that a line is, if it is one. Before its offset there may be a time, an arrow, a bar, the
    /// sign of a comment.
    pub fn row(&self, line: &[u8]) -> Option<Row> {
        offsets(line).find_map(|offset| self.row_at(line, offset))
    }

    /// The same with what may be its offset, whose value has to fit.
    fn row_at(&self, line: &[u8], Offset { place, from, first, alone, colon, od }: Offset) -> Option<Row> {
        // Most dumps count in hex, od in octal.
        let digits = std::str::from_utf8(place.of(line)).ok()?;
        let values = [16, 10, 8].map(|radix| usize::from_str_radix(digits, radix).ok());
        let (offset, first) = (values[0]?, first.of(line));
        let octal = od && matches!(first.len(), 3 | 6) && first.iter().all(|c| (b'0'..=b'7').contains(c));
        let words = match od {
            _ if octal => Words::Octal,
            true => Words::LowFirst,
            false => Words::InOrder,
        };
        let before = outline(&line[..place.from]);
        // A row that goes on may be indented in another way.
        let latest = self.streams.get(self.latest);
        let stream = match self.streams.iter().position(|stream| stream.before == before) {
            Some(stream) => self.streams.get(stream),
            None => latest.filter(|latest| values.contains(&Some(latest.next))),
        };
        let in_turn = latest.is_none_or(|latest| stream.is_none_or(|stream| stream.before == latest.before));
        let row = |offset, continues: bool| {
            Some(Row { from, offset, continues: continues && in_turn, words, before })
        };
        match stream.map(|stream| stream.next) {
            _ if offset == 0 => row(0, false),
            Some(next) if values.contains(&Some(next)) => row(next, true),
            // Rows are missing.
            Some(next) if (next..).contains(&offset) && offset.is_multiple_of(8) => row(offset, true),
            None if self.streams.is_empty() && offset.is_multiple_of(8) && (alone || colon) => {
                row(offset, false)
            }
            _ => None,
        }
    }

    /// Whether a line is the offset behind the last row, which od and hexdump write by itself.
    pub fn ends(&self, line: &[u8]) -> bool {
        let latest = self.streams.get(self.latest);
        let Some(next) = latest.map(|stream| stream.next) else { return false };
        let digits = line.trim_ascii();
        let text = std::str::from_utf8(digits).ok().filter(|_| (4..=16).contains(&digits.len()));
        text.is_some_and(|text| {
            [16, 10, 8].iter().any(|radix| usize::from_str_radix(text, *radix) == Ok(next))
        })
    }

    /// The bytes of `row` were read, so many.
    pub fn read(&mut self, row: Row, count: usize) {
        /// More are no sides of a conversation.
        const MOST: usize = 8;
        let stream = Stream { before: row.before, next: row.offset.saturating_add(count) };
        let known = self.streams.iter().position(|stream| stream.before == row.before);
        match known.or((row.continues || self.streams.len() == MOST).then_some(self.latest)) {
            Some(at) => (self.latest, self.streams[at]) = (at, stream),
            None => {
                self.latest = self.streams.len();
                self.streams.push(stream);
            }
        }
    }

    /// Who sends `row`, where the dump has two sides: which of them asks, the telegrams tell.
    pub fn sender(&self, row: Row) -> Option<Sender> {
        let side = self.streams.iter().position(|stream| stream.before == row.before);
        match side.filter(|_| self.streams.len() == 2)? {
            0 => Some(Sender::Logger),
            _ => Some(Sender::Other),
        }
    }
}

/// What can stand right before an offset.
static MARKS: [bool; 256] = {
    let mut marks = [false; 256];
    let mut at = 0;
    while at < b" \t|>/#*;-".len() {
        marks[b" \t|>/#*;-"[at] as usize] = true;
        at += 1;
    }
    marks
};

/// Whether a text may begin with an offset: all have four digits.
fn begins_offset(text: &[u8]) -> bool {
    let digits = text.strip_prefix(b"0x").unwrap_or(text);
    digits.first_chunk::<4>().is_some_and(|digits| digits.iter().all(u8::is_ascii_hexdigit))
}

/// What may be the offset of a row, by how it stands in the line.
#[derive(Clone, Copy, Debug)]
struct Offset {
    /// Its digits.
    place: Span,
    /// Where the bytes begin behind it, and the first of them.
    from: usize,
    first: Span,
    /// Nothing is before it.
    alone: bool,
    /// A colon or a bar parts it from the bytes.
    colon: bool,
    /// It has the form of those of od.
    od: bool,
}

/// Whether a number of a line stands as the offset of a row does, whatever its value is.
pub fn has_offset(line: &[u8]) -> bool {
    offsets(line).next().is_some()
}

/// The numbers of a line that stand as offsets do.
fn offsets(line: &[u8]) -> impl Iterator<Item = Offset> {
    let first = line.iter().take_while(|c| MARKS[usize::from(**c)]).count();
    let alone = begins_offset(&line[first..]).then_some(first);
    let mut at = first + 1;
    let others = std::iter::from_fn(move || {
        let found = next_number(line, at)?;
        at = found + 1;
        Some(found)
    });
    alone.into_iter().chain(others).filter_map(move |start| offset_at(line, start, start == first))
}

/// Where the next offset may begin, from `at` on: behind a mark. Most places are passed by fours: where one of the
/// four digits would be is none.
fn next_number(line: &[u8], mut at: usize) -> Option<usize> {
    /// Offsets stand near the beginning.
    const FAR: usize = 80;
    while at < FAR {
        let digits: &[u8; 4] = line.get(at..)?.first_chunk()?;
        // An x may be the second one: `0x0010`.
        match digits.iter().rposition(|c| DIGITS[usize::from(*c)] > 15 && *c != b'x') {
            Some(place) => at += place + 1,
            _ if MARKS[usize::from(line[at - 1])] && begins_offset(&line[at..]) => return Some(at),
            _ => at += 1,
        }
    }
    None
}

/// The offset whose digits begin at `start`; where other things are before it, it must be marked.
fn offset_at(line: &[u8], start: usize, alone: bool) -> Option<Offset> {
    /// So many digits have the offsets of most dumps.
    const USUAL: usize = 8;
    // tcpdump marks its offsets.
    let start = start + if line[start..].starts_with(b"0x") { 2 } else { 0 };
    let count = line[start..].iter().take_while(|c| c.is_ascii_hexdigit()).count();
    if !(4..=16).contains(&count) {
        return None;
    }
    let end = start + count;
    let blanks = |at: usize| {
        line.get(at..).unwrap_or_default().iter().take_while(|c| matches!(c, b' ' | b'\t')).count()
    };
    let bar = line.get(end + blanks(end)) == Some(&b'|');
    let colon = line.get(end) == Some(&b':') || bar;
    let from = end + if bar { blanks(end) } else { 0 } + usize::from(colon);
    // od parts its offset, seven digits, with one blank only.
    let od = count == 7 && !colon && blanks(from) == 1;
    let parted =
        (colon && blanks(from) > 0) || (alone && od) || ((alone || count == USUAL) && blanks(from) > 1);
    if !parted || !line.get(from + blanks(from)).is_some_and(u8::is_ascii_hexdigit) {
        return None;
    }
    let begins = from + blanks(from);
    let length = line[begins..].iter().take_while(|c| c.is_ascii_alphanumeric()).count();
    let first = Span::new(begins, begins + length);
    // Bytes are parted by blanks: what goes on with a dot or a colon is a date or a time.
    let bytes = line.get(first.to).is_none_or(|c| c.is_ascii_whitespace() || matches!(c, b'-' | b'|'));
    // What is longer is no byte or word of a row, so that what stands before it is no offset.
    (bytes && length <= 8).then_some(Offset { place: Span::new(start, end), from, first, alone, colon, od })
}

/// A number for what stands before an offset: the same for the same letters and blanks, whatever digits are among
/// them.
fn outline(text: &[u8]) -> u32 {
    let kept = text.iter().filter(|c| !c.is_ascii_digit());
    kept.fold(0x811C_9DC5, |hash, c| (hash ^ u32::from(*c)).wrapping_mul(0x0100_0193))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_follow_each_other() {
        let mut dump = Dump::default();
        let first = dump.row(b"00000000: 0510 0c90  ....").unwrap();
        assert_eq!((first.from, first.continues), (9, false));
        dump.read(first, 16);
        assert!(dump.row(b"00000010: 0510 0c90  ....").unwrap().continues);
        assert!(dump.row(b"0000020 05 10 0c 90").unwrap().continues, "16 in octal, of od");
        assert!(dump.row(b"00000040: 0510").unwrap().continues, "rows are missing");
        assert!(dump.row(b"00000013: 0510").is_none());
        assert!(dump.ends(b"00000010") && dump.ends(b"0000020\n") && !dump.ends(b"00000013"));
        assert!(!dump.row(b"\t0x0000:  4500 0034").unwrap().continues);
        assert_eq!(dump.row(b"0000000 001405 110000").unwrap().words, Words::Octal);
        assert_eq!(dump.row(b"0000000 005 003").unwrap().words, Words::Octal);
        assert_eq!(dump.row(b"0000000 0305 c800").unwrap().words, Words::LowFirst);
    }

    /// What is read of rows one after the other: whether each goes on, and who sends it.
    fn follow(rows: &[&str]) -> Vec<Option<(bool, Option<Sender>)>> {
        let mut dump = Dump::default();
        let mut follow = |text: &&str| {
            let row = dump.row(text.as_bytes())?;
            dump.read(row, 8);
            Some((row.continues, dump.sender(row)))
        };
        rows.iter().map(&mut follow).collect()
    }

    #[test]
    fn each_side_of_a_conversation_counts_by_itself() {
        let (first, second) = (Some(Sender::Logger), Some(Sender::Other));
        let rows = ["TX 0000: 01 03", "RX 0000: 01 03", "TX 0008: 00 C8", "RX 0008: 06 00", "RX 0010: 02"];
        let told = [(false, None), (false, second), (false, first), (false, second), (true, second)];
        assert_eq!(follow(&rows), told.map(Some));
        // What a row is told by has no digits: they are times.
        let rows = ["09:30:05 0000: 01 03", "09:30:06 0008: 00 C8"];
        assert_eq!(follow(&rows), [Some((false, None)), Some((true, None))]);
        // Only indented in another way.
        let rows = ["00000000  01 03", "    00000000  01 03", "00000008  00 C8"];
        assert_eq!(follow(&rows), [Some((false, None)), Some((false, second)), Some((false, first))]);
    }

    #[test]
    fn offsets_stand_behind_marks_near_the_beginning() {
        let row = |text: &str| Dump::default().row(text.as_bytes()).map(|row| row.from);
        assert_eq!(row("| 0000: 01 03"), Some(7));
        assert_eq!(row("09:30:05 > 0000: 01 03"), Some(16));
        assert_eq!(row("read,0000: 01 03"), None);
        assert_eq!(row(&format!("{} 0000: 01 03", "x".repeat(70))), Some(76));
        assert_eq!(row(&format!("{} 0000: 01 03", "x".repeat(80))), None);
        assert_eq!(row("123: 01 03"), None);
    }

    #[test]
    fn other_lines_are_no_rows() {
        for text in ["000000-Tx:01 03", "01 03 00 C8", "0103 00C8 0003", "0000 text", "2026  Mar"] {
            assert_eq!(Dump::default().row(text.as_bytes()), None, "{text}");
        }
    }
}
