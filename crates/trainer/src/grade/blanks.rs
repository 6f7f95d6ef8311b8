//! Fields of a telegram that were to be filled in.

use buslens::field::{Message, Order, Role, hex};
use buslens::message;
use buslens::tool::steps;

use super::slip::Slip;
use super::telegram::value;
use super::{Remark, Verdict, the};
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
            Err(_) if is_decimal(typed(index), wanted) => remarks.push(in_decimal(blank)),
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
        _ => Err(message!("expected {n}, in hex", n = Message::bytes(width))),
    }
}

/// Whether the right number was typed as people count.
fn is_decimal(typed: &str, wanted: &[u8]) -> bool {
    wanted.len() <= 8 && typed.parse().is_ok_and(|typed: u64| typed > 9 && typed == Order::Big.number(wanted))
}

fn in_decimal(blank: &Blank) -> Remark {
    let text =
        message!("{field} is right as a decimal number; here stand bytes, in hex", field = the(&blank.label));
    Remark::new(&blank.label, text).at(blank.span)
}

fn differs(telegram: &Telegram, blank: &Blank, wanted: &[u8], given: &[u8], typed: &str) -> Remark {
    if is_decimal(typed, wanted) {
        return in_decimal(blank);
    }
    let field = telegram.fields(false).into_iter().find(|field| field.span == blank.span);
    let (role, key) = field.map_or((Role::Data, ""), |field| (field.spec.role, field.spec.key));
    let label = the(&blank.label);
    let number = |bytes: &[u8]| Order::Big.number(bytes);
    let whole = wanted.len() <= 8;
    let slip = if whole { Slip::find(number(wanted), number(given), wanted.len(), role, key) } else { None };
    let text = match slip {
        _ if role == Role::Check && wanted.iter().rev().eq(given) => {
            message!("the two bytes of the CRC are in the other order: its low byte goes first")
        }
        Some(slip) => message!(
            "{field} {what}: {why}",
            field = label,
            what = buslens::field::Argument::Term(slip.what()),
            why = buslens::field::Argument::Term(slip.why())
        ),
        None => match would_be(telegram, blank, given).filter(|_| role != Role::Check) {
            Some(value) => {
                message!("with {given}, {field} is {value}", given = hex(given), field = label, value = value)
            }
            None => message!("{field} is not {given}", field = label, given = hex(given)),
        },
    };
    Remark::new(&blank.label, text).at(blank.span)
}

/// What the field would say with these bytes.
fn would_be(telegram: &Telegram, blank: &Blank, given: &[u8]) -> Option<String> {
    let mut bytes = telegram.bytes.clone();
    bytes.get_mut(blank.span.from..blank.span.to)?.copy_from_slice(given);
    let changed = telegram.with(bytes);
    let mut fields = changed.fields(true).into_iter().chain(changed.fields(false));
    let field = fields.find(|field| field.span == blank.span && field.label().to_string() == blank.label)?;
    Some(field).filter(|field| !field.value_text().is_empty()).map(|field| value(&field))
}
