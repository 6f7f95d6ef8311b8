//! A layout that a person makes: in one line it is marked which part is the time, who speaks, and
//! the bytes.

use super::characters::{is_digit, is_letter_or_digit};
use super::time;
use super::words::Sender;
use crate::field::{Direction, Span};

/// Where the parts of a line are.
#[derive(Clone, Debug, PartialEq)]
pub struct Marks {
    pub time: Option<Place>,
    /// Where a word says who speaks, the word, and what it says. Any other word there says the
    /// opposite.
    pub direction: Option<(Place, String, Direction)>,
    pub bytes: Place,
}

/// A place that other lines have, too: behind the separator that stands before it, and behind as
/// many others of its kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// What stands before it, up to the next letter or digit; empty at the beginning of a line.
    before: String,
    /// How many times that comes earlier in the line.
    nth: usize,
}

impl Place {
    /// The place of the marked `span` of `line`.
    pub fn of(line: &str, span: Span) -> Self {
        let head = line.get(..span.from).unwrap_or_default();
        let before: String = {
            let reversed: String = head.chars().rev().take_while(|c| !is_letter_or_digit(*c)).collect();
            reversed.chars().rev().collect()
        };
        let nth = if before.is_empty() { 0 } else { head.matches(&before).count().saturating_sub(1) };
        Self { before, nth }
    }

    /// Where it is in `line`.
    fn find(&self, line: &[u8]) -> Option<usize> {
        if self.before.is_empty() {
            return Some(0);
        }
        let before = self.before.as_bytes();
        let mut at = 0;
        let mut left = self.nth + 1;
        while at + before.len() <= line.len() {
            if line[at..].starts_with(before) {
                left -= 1;
                at += before.len();
                if left == 0 {
                    return Some(at);
                }
            } else {
                at += 1;
            }
        }
        None
    }
}

impl Marks {
    /// Where the bytes begin in `line`.
    pub fn bytes_from(&self, line: &[u8]) -> Option<usize> {
        self.bytes.find(line)
    }

    pub fn time(&self, line: &[u8]) -> Option<i64> {
        let at = self.time.as_ref()?.find(line)?;
        line.get(at).filter(|c| is_digit(**c))?;
        time::at(line, at).map(|found| found.micros)
    }

    pub fn sender(&self, line: &[u8]) -> Option<Sender> {
        let (place, word, direction) = self.direction.as_ref()?;
        let at = place.find(line)?;
        let same = line[at..].starts_with(word.as_bytes());
        Some(Sender::Says(match (same, direction) {
            (true, direction) => *direction,
            (false, Direction::Request) => Direction::Response,
            (false, Direction::Response) => Direction::Request,
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_found_in_other_lines() {
        let line = "#7;09:30:05.5;A;5;01 03 00 C8;note 1";
        let place = |text: &str| {
            let from = line.find(text).unwrap();
            Place::of(line, Span::new(from, from + text.len()))
        };
        let marks = Marks {
            time: Some(place("09:30")),
            direction: Some((place("A"), "A".into(), Direction::Request)),
            bytes: place("01 03"),
        };
        let other = b"#8;09:30:06.5;B;55;05 03 00 C8;note 2";
        assert_eq!(marks.bytes_from(other), Some(19));
        assert_eq!(marks.time(other), Some(34_206_500_000));
        assert_eq!(marks.sender(other), Some(Sender::Says(Direction::Response)));
        assert_eq!(marks.bytes_from(b"nothing"), None);
    }
}
