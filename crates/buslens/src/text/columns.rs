//! Telegrams that stand across lines: one byte a line with words, an index or its character beside it, or one
//! field a row of a table.
//!
//! The lines of a block that have a byte or two each are read down: cell by cell where bars part them, else
//! number by number, counted from the beginning and from the end of the line. What comes out of a column is
//! only a telegram if its check is right.

use std::hash::{Hash, Hasher};

use super::line::Scan;
use super::{Event, Piece, SHORTEST, Sender};
use crate::field::{Facts, Span};

/// The columns of the lines in hand.
#[derive(Debug, Default)]
pub(super) struct Columns {
    lines: usize,
    columns: Vec<Column>,
    /// Those of blocks before: most blocks are nothing but a line with a number in it, which shall not allocate.
    spare: Vec<Column>,
    /// Where the first line of the block begins in the file.
    offset: u64,
    line: u32,
}

/// Bytes below each other.
#[derive(Debug, Hash)]
struct Column {
    key: Key,
    bytes: Vec<u8>,
    decimal: Vec<u8>,
    /// Counted from the beginning of the block.
    places: Vec<Span>,
}

/// Which column of its line a number is in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Key {
    /// Behind so many bars.
    Cell(usize),
    FromStart(usize),
    FromEnd(usize),
    /// Of the first numbers of each line, however many they are.
    First,
    /// Of the last ones.
    Last,
}

/// A block with more lines is read in parts.
const MOST_LINES: usize = 600;

/// A line with more numbers is no row of a table with one field each.
const MOST_NUMBERS: usize = 8;

impl Columns {
    /// The state behind so many lines, see [`Reader::hash_state`](super::Reader::hash_state).
    pub fn hash_state(&self, line: u32, hasher: &mut impl Hasher) {
        (self.lines, &self.columns).hash(hasher);
        if self.lines > 0 {
            (self.offset, line - self.line).hash(hasher);
        }
    }

    /// Takes a line, if it can be one of a block.
    pub fn take(&mut self, text: &[u8], scan: &Scan, line: u32, offset: u64) -> bool {
        let count = scan.hex.len();
        let bars = text.iter().filter(|c| **c == b'|').count();
        let table = bars > 1;
        // A line with nothing but a bar is the border of a cell.
        let border = bars > 0 && scan.words == 0;
        if (count == 0 && !table && !border) || count > MOST_NUMBERS || self.lines >= MOST_LINES {
            return false;
        }
        if self.lines == 0 {
            (self.offset, self.line) = (offset, line);
        }
        self.lines += 1;
        let base = (offset - self.offset) as usize;
        let mut cell = 0;
        let mut seen = 0;
        for run in &scan.runs {
            for at in run.first..run.end {
                let place = scan.places[at];
                let value = (scan.hex[at], scan.decimal.get(at).copied().unwrap_or_default());
                if table {
                    cell += text[seen..place.from].iter().filter(|c| **c == b'|').count();
                    seen = place.from;
                    self.add(Key::Cell(cell), value, place.shifted(base));
                } else {
                    self.add(Key::FromStart(at), value, place.shifted(base));
                    if count > 1 {
                        self.add(Key::FromEnd(count - 1 - at), value, place.shifted(base));
                    }
                    for (key, end) in [(Key::First, scan.runs.first()), (Key::Last, scan.runs.last())] {
                        if end.is_some_and(|end| end.first == run.first) {
                            self.add(key, value, place.shifted(base));
                        }
                    }
                }
            }
        }
        true
    }

    fn add(&mut self, key: Key, (hex, decimal): (u8, u8), place: Span) {
        let column = match self.columns.iter_mut().find(|column| column.key == key) {
            Some(column) => column,
            None => {
                let fresh = || Column { key, bytes: Vec::new(), decimal: Vec::new(), places: Vec::new() };
                let spare = self.spare.pop().map(|spare| Column { key, ..spare });
                self.columns.push_mut(spare.unwrap_or_else(fresh))
            }
        };
        column.bytes.push(hex);
        column.decimal.push(decimal);
        column.places.push(place);
    }

    pub fn is_empty(&self) -> bool {
        self.lines == 0
    }

    /// The block ends: gives its columns.
    pub fn end(&mut self, sender: Option<Sender>, sink: &mut dyn FnMut(Event<'_>)) {
        let lines = std::mem::take(&mut self.lines);
        if lines == 0 {
            return;
        }
        for mut column in self.columns.drain(..) {
            let Column { bytes, decimal, places, .. } = &mut column;
            if lines >= SHORTEST && bytes.len() >= SHORTEST {
                sink(Event::Piece(Piece {
                    bytes,
                    decimal: (decimal != bytes).then_some(decimal),
                    breaks: &[],
                    places,
                    pairs: None,
                    line: self.line,
                    offset: self.offset,
                    time: None,
                    sender,
                    port: None,
                    joins: false,
                    facts: Facts { column: true, ..Facts::default() },
                }));
            }
            bytes.clear();
            decimal.clear();
            places.clear();
            self.spare.push(column);
        }
    }
}
