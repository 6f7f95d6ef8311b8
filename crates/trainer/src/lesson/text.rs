//! The little that a sentence of a lesson may hold besides words: code, new words, and what a field says.

use buslens::field::hex;
use buslens::tool::Report;

use super::field;

/// A part of a sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Piece {
    Plain(String),
    /// Bytes and numbers: `` `84 35` ``.
    Code(String),
    /// A new word: `*register*`.
    Term(String),
}

/// The parts of a sentence.
///
/// ```
/// use buslens_trainer::lesson::{Piece, pieces};
///
/// let found = pieces("a *byte*: `3C`");
/// assert_eq!(found[1], Piece::Term("byte".into()));
/// assert_eq!(found[3], Piece::Code("3C".into()));
/// ```
pub fn pieces(text: &str) -> Vec<Piece> {
    let mut found = Vec::new();
    let mut rest = text;
    while let Some(at) = rest.find(['`', '*']) {
        let mark = &rest[at..=at];
        let Some(length) = rest[at + 1..].find(mark).filter(|length| *length > 0) else {
            // A mark without its partner is a sign like others.
            break;
        };
        let inside = rest[at + 1..at + 1 + length].to_owned();
        if at > 0 {
            found.push(Piece::Plain(rest[..at].to_owned()));
        }
        found.push(if mark == "`" { Piece::Code(inside) } else { Piece::Term(inside) });
        rest = &rest[at + length + 2..];
    }
    if !rest.is_empty() {
        found.push(Piece::Plain(rest.to_owned()));
    }
    found
}

/// `text` with what stands in braces in place of the braces, as the library says it of telegram `index`:
/// `{Quantity}` is the field's value, `{Quantity bytes}` its bytes, `{Quantity means}` what it means. `own` is
/// the field that is meant by `{value}`, `{bytes}` and `{means}`. The error is what is not known.
pub fn filled(text: &str, report: &Report, index: usize, own: Option<&str>) -> Result<String, String> {
    let mut whole = String::new();
    let mut rest = text;
    while let Some((before, inside, after)) = braces(rest) {
        whole.push_str(before);
        whole.push_str(&said(inside, report, index, own).ok_or_else(|| inside.to_owned())?);
        rest = after;
    }
    Ok(whole + rest)
}

fn braces(text: &str) -> Option<(&str, &str, &str)> {
    let (before, rest) = text.split_once('{')?;
    let (inside, after) = rest.split_once('}')?;
    Some((before, inside, after))
}

fn said(inside: &str, report: &Report, index: usize, own: Option<&str>) -> Option<String> {
    let (name, what) = match inside {
        "value" | "bytes" | "means" => (own?, inside),
        _ => match inside.rsplit_once(' ') {
            Some((name, what @ ("bytes" | "means"))) => (name, what),
            _ => (inside, "value"),
        },
    };
    let detail = report.detail(index)?;
    let field = field(&detail, name)?;
    match what {
        "bytes" => Some(hex(field.span.of(&report.telegrams[index].line.bytes))),
        "means" => field.meaning().map(|meaning| meaning.to_string()),
        _ => Some(field.value_text()).filter(|value| !value.is_empty()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use buslens::tool::{Options, decode};

    #[test]
    fn marks_come_in_pairs() {
        assert_eq!(pieces("2 * 3"), [Piece::Plain("2 * 3".into())]);
        assert_eq!(pieces("`a` *b"), [Piece::Code("a".into()), Piece::Plain(" *b".into())]);
        assert_eq!(pieces(""), []);
    }

    #[test]
    fn the_library_says_what_stands_in_braces() {
        let report = decode("01 03 00 C8 00 03 84 35", Options::default());
        let said = |text| filled(text, &report, 0, Some("Quantity"));
        assert_eq!(said("{value} from {Starting address bytes}"), Ok("3 from 00 C8".to_owned()));
        assert_eq!(said("{Colour}"), Err("Colour".to_owned()));
        assert_eq!(said("no end {"), Ok("no end {".to_owned()));
    }
}
