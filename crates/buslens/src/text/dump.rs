//! Rows of hex dumps: xxd, `hexdump -C`, od, Wireshark. An offset, bytes, and often the same bytes
//! as characters.

/// Follows the offsets from row to row.
#[derive(Debug, Default)]
pub struct Dump {
    /// The offset that the next row should have.
    next: Option<usize>,
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
        /// Offsets stand near the beginning.
        const FAR: usize = 80;
        let mark = |c: &u8| matches!(c, b' ' | b'\t' | b'|' | b'>' | b'/' | b'#' | b'*' | b';');
        let first = line.iter().take_while(|c| mark(c)).count();
        if let Some(row) = self.row_at(line, first, true) {
            return Some(row);
        }
        let mut at = first;
        while at < line.len().min(FAR) {
            let before = at;
            at += line[at..].iter().take_while(|c| !mark(c)).count();
            at += line[at..].iter().take_while(|c| mark(c)).count();
            if at == before {
                break;
            }
            if let Some(row) = line.get(at).and_then(|_| self.row_at(line, at, false)) {
                return Some(row);
            }
        }
        None
    }

    /// The same with the offset at `start`; where other things are before it, it must be marked and fit.
    fn row_at(&self, line: &[u8], start: usize, alone: bool) -> Option<Row> {
        // tcpdump marks its offsets.
        let start = start + if line[start..].starts_with(b"0x") { 2 } else { 0 };
        let count = line[start..].iter().take_while(|c| c.is_ascii_hexdigit()).count();
        let digits =
            std::str::from_utf8(&line[start..start + count]).ok().filter(|_| (4..=16).contains(&count))?;
        let end = start + count;
        let blanks = |at: usize| {
            line.get(at..).unwrap_or_default().iter().take_while(|c| matches!(c, b' ' | b'\t')).count()
        };
        let bar = line.get(end + blanks(end)) == Some(&b'|');
        let colon = line.get(end) == Some(&b':') || bar;
        let from = end + if bar { blanks(end) } else { 0 } + usize::from(colon);
        // od parts its offset, seven digits, with one blank only.
        let od = count == 7 && !colon && blanks(from) == 1;
        let parted = (colon && blanks(from) > 0) || (alone && (blanks(from) > 1 || od));
        if !parted || !line.get(from + blanks(from)).is_some_and(u8::is_ascii_hexdigit) {
            return None;
        }
        // Most dumps count in hex, od in octal.
        let values = [16, 10, 8].map(|radix| usize::from_str_radix(digits, radix).ok());
        let offset = values[0]?;
        let first = &line[from + blanks(from)..];
        let length = first.iter().take_while(|c| c.is_ascii_alphanumeric()).count();
        // Bytes are parted by blanks: what goes on with a dot or a colon is a date or a time.
        if !first.get(length).is_none_or(|c| c.is_ascii_whitespace() || matches!(c, b'-' | b'|')) {
            return None;
        }
        let first = &first[..length];
        let octal = od && matches!(first.len(), 3 | 6) && first.iter().all(|c| (b'0'..=b'7').contains(c));
        let words = match od {
            _ if octal => Words::Octal,
            true => Words::LowFirst,
            false => Words::InOrder,
        };
        let row = |offset, continues| Some(Row { from, offset, continues, words });
        match self.next {
            _ if offset == 0 => row(0, false),
            Some(next) if values.contains(&Some(next)) => row(next, true),
            // Rows are missing.
            Some(next) if offset > next && offset.is_multiple_of(8) => row(offset, true),
            None if offset.is_multiple_of(8) && (alone || colon) => row(offset, false),
            _ => None,
        }
    }

    /// Whether a line is the offset behind the last row, which od and hexdump write by itself.
    pub fn ends(&self, line: &[u8]) -> bool {
        let Some(next) = self.next.filter(|next| *next > 0) else { return false };
        let digits = line.trim_ascii();
        let text = std::str::from_utf8(digits).ok().filter(|_| (4..=16).contains(&digits.len()));
        text.is_some_and(|text| {
            [16, 10, 8].iter().any(|radix| usize::from_str_radix(text, *radix) == Ok(next))
        })
    }

    /// The bytes of `row` were read, so many.
    pub fn read(&mut self, row: Row, count: usize) {
        self.next = Some(row.offset.saturating_add(count));
    }
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

    #[test]
    fn other_lines_are_no_rows() {
        for text in ["000000-Tx:01 03", "01 03 00 C8", "0103 00C8 0003", "0000 text", "2026  Mar"] {
            assert_eq!(Dump::default().row(text.as_bytes()), None, "{text}");
        }
    }
}
