//! Fields of a telegram that were to be filled in.

use buslens::field::{Message, Order, Role, hex};
use buslens::message;
use buslens::tool::steps;

use super::slip::Slip;
use super::{Remark, Verdict, small};
use crate::notation::{self, Notation};
use crate::task::{Blank, Telegram};

pub fn grade(telegram: &Telegram, blanks: &[Blank], texts: &[String]) -> Verdict {
    let typed = |index: usize| texts.get(index).map_or("", |text| text.trim());
    if (0..blanks.len()).all(|index| typed(index).is_empty()) {
        return Verdict::Unread(message!("there is no answer yet"));
    }
    let mut remarks = Vec::new();
    for (index, blank) in blanks.iter().enumerate() {
        let wanted = blank.span.of(&telegram.bytes);
        match bytes(typed(index), wanted.len()) {
            Ok(given) if given == wanted => {}
            Ok(given) => remarks.push(differs(telegram, blank, wanted, &given, typed(index))),
            Err(text) => remarks.push(Remark::new(&blank.label, text).at(blank.span)),
        }
    }
    if remarks.is_empty() { Verdict::Right(None) } else { Verdict::Wrong(remarks) }
}

/// The bytes that were typed, in hex; fewer digits are a number with zeros before it.
fn bytes(text: &str, width: usize) -> Result<Vec<u8>, Message> {
    if text.is_empty() {
        return Err(message!("it is still empty"));
    }
    let typed = steps::bytes(text);
    if typed.len() == width && text.chars().filter(char::is_ascii_hexdigit).count() == 2 * width {
        return Ok(typed);
    }
    let written = notation::read(text, width.min(8), buslens::field::Format::Decimal, Notation::Hex);
    match written {
        Ok(written) if width <= 8 => Ok(Order::Big.bytes(written.raw, width)),
        _ => Err(message!("here belong {n}, in hex", n = Message::bytes(width))),
    }
}

fn differs(telegram: &Telegram, blank: &Blank, wanted: &[u8], given: &[u8], typed: &str) -> Remark {
    let field = telegram.fields(false).into_iter().find(|field| field.span == blank.span);
    let (role, key) = field.map_or((Role::Data, ""), |field| (field.spec.role, field.spec.key));
    let label = small(&blank.label);
    let number = |bytes: &[u8]| Order::Big.number(bytes);
    let whole = wanted.len() <= 8;
    let decimal = typed.parse::<u64>().ok().filter(|typed| whole && *typed == number(wanted) && *typed > 9);
    let slip = if whole { Slip::find(number(wanted), number(given), wanted.len(), role, key) } else { None };
    let text = match (decimal, slip) {
        (Some(_), _) => {
            message!("the {label} is right as a decimal number; here stand bytes, in hex", label = label)
        }
        (None, _) if role == Role::Check && wanted.iter().rev().eq(given) => {
            message!("the two bytes of the CRC are in the other order: its low byte goes first")
        }
        (None, Some(slip)) => message!(
            "the {label} {what}: {why}",
            label = label,
            what = buslens::field::Argument::Term(slip.what()),
            why = buslens::field::Argument::Term(slip.why())
        ),
        (None, None) => message!("the {label} is not {given}", label = label, given = hex(given)),
    };
    Remark::new(&blank.label, text).at(blank.span)
}
