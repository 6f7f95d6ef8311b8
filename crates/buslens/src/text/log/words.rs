//! Words and arrows that say who speaks in a line.

use crate::field::Direction;

/// What a line says of who speaks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sender {
    /// It calls the telegram a request or a response.
    Says(Direction),
    /// The writer of the log sent it: whether that one asks or answers, the telegrams tell.
    Logger,
    /// The writer of the log received it.
    Other,
}

/// How much a word says. A function's name may have a weak one in it: "read holding registers".
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Weight {
    Weak,
    Strong,
}

use Direction::{Request, Response};
use Sender::{Logger, Other, Says};
use Weight::{Strong, Weak};

static WORDS: &[(&str, Sender, Weight)] = &[
    ("tx", Logger, Strong),
    ("txd", Logger, Strong),
    ("send", Logger, Strong),
    ("sent", Logger, Strong),
    ("sending", Logger, Strong),
    ("transmit", Logger, Strong),
    ("transmitted", Logger, Strong),
    ("written", Logger, Strong),
    ("write", Logger, Weak),
    ("writing", Logger, Weak),
    ("wrote", Logger, Weak),
    ("out", Logger, Weak),
    ("output", Logger, Weak),
    ("rx", Other, Strong),
    ("rxd", Other, Strong),
    ("recv", Other, Strong),
    ("receive", Other, Strong),
    ("received", Other, Strong),
    ("receiving", Other, Strong),
    ("read", Other, Weak),
    ("reading", Other, Weak),
    ("in", Other, Weak),
    ("input", Other, Weak),
    ("request", Says(Request), Strong),
    ("req", Says(Request), Strong),
    ("query", Says(Request), Strong),
    ("command", Says(Request), Weak),
    ("cmd", Says(Request), Weak),
    ("master", Says(Request), Weak),
    ("client", Says(Request), Weak),
    ("response", Says(Response), Strong),
    ("resp", Says(Response), Strong),
    ("answer", Says(Response), Strong),
    ("reply", Says(Response), Strong),
    ("slave", Says(Response), Weak),
    ("server", Says(Response), Weak),
];

/// What `word` says, in whatever letters it is written.
pub fn word(word: &[u8]) -> Option<(Sender, Weight)> {
    const LONGEST: usize = 11;
    if !(2..=LONGEST).contains(&word.len()) {
        return None;
    }
    let first = word[0].to_ascii_lowercase();
    let said = WORDS.iter().find(|(known, ..)| {
        known.as_bytes()[0] == first
            && known.len() == word.len()
            && known.as_bytes().eq_ignore_ascii_case(word)
    });
    said.map(|(_, sender, weight)| (*sender, *weight))
}

/// What the arrow that begins at `at` says, and where it ends: `->`, `<-`, `>>>`, `<<`, `=>`, `→`.
pub fn arrow(line: &[u8], at: usize) -> Option<(Sender, usize)> {
    let rest = &line[at..];
    let run = |c: u8| rest.iter().take_while(|other| **other == c).count();
    match rest {
        [b'-' | b'=', b'>', ..] => Some((Logger, at + 2)),
        [b'-', b'-', b'>', ..] => Some((Logger, at + 3)),
        [b'<', b'-' | b'=', ..] => Some((Other, at + 1 + 1)),
        [b'>', b'>', ..] => Some((Logger, at + run(b'>'))),
        [b'<', b'<', ..] => Some((Other, at + run(b'<'))),
        [0xE2, 0x86, 0x92, ..] => Some((Logger, at + 3)),
        [0xE2, 0x86, 0x90, ..] => Some((Other, at + 3)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_in_any_letters() {
        assert_eq!(word(b"TX"), Some((Logger, Strong)));
        assert_eq!(word(b"Response"), Some((Says(Response), Strong)));
        assert_eq!(word(b"reads"), None);
        assert_eq!(word("é".as_bytes()), None);
    }

    #[test]
    fn arrows() {
        assert_eq!(arrow(b">>> 01", 0), Some((Logger, 3)));
        assert_eq!(arrow(b"x <- 01", 2), Some((Other, 4)));
        assert_eq!(arrow("→ 01".as_bytes(), 0), Some((Logger, 3)));
        assert_eq!(arrow(b"> 01", 0), None);
        assert_eq!(arrow(b"<01><03>", 0), None);
    }
}
