//! A telegram that was to be made: compared byte by byte, explained field by field.

use buslens::field::{Argument, Check, Field, Message, Order, Role, Span, Value, hex};
use buslens::message;
use buslens::tool::steps::{self, CHECKS};
use buslens::tool::{Options, Verdict as Checked, decode};

use super::slip::Slip;
use super::{Remark, Verdict, small, the};
use crate::task::{Checksum, Telegram};

pub fn grade(wanted: &Telegram, text: &str) -> Verdict {
    if text.trim().is_empty() {
        return Verdict::Unread(message!("there is no answer yet"));
    }
    // On however many lines: it is one telegram.
    let text = &text.split_whitespace().collect::<Vec<_>>().join(" ");
    let bytes = steps::bytes(text);
    if let Some(message) = unread(text, &bytes) {
        return in_decimal(wanted, text).map_or(Verdict::Unread(message), Verdict::wrong);
    }
    let given = completed(wanted, &bytes);
    let typed_check = given == bytes;
    if is_same(wanted, &given) {
        let note = (!typed_check).then(|| check_bytes(wanted)).flatten();
        return Verdict::Right(
            note.map(|check| message!("with its checksum it ends in {check}", check = check)),
        );
    }
    if let Some(remark) = in_decimal(wanted, text).or_else(|| cut_off(wanted, &bytes)) {
        return Verdict::wrong(remark);
    }
    Verdict::Wrong(compare(wanted, &given, bytes.len(), typed_check))
}

/// Why what was typed is no telegram.
fn unread(text: &str, bytes: &[u8]) -> Option<Message> {
    let report = decode(text, Options::default());
    let remark = report.lines().flat_map(|line| &line.remarks).next();
    match remark {
        Some(remark) => Some(remark.message.clone()),
        None if bytes.is_empty() => {
            Some(message!("there are no bytes in it: write them in hex, like 01 03 00 C8"))
        }
        None => None,
    }
}

/// The bytes with their checksum, where they were typed without.
fn completed(wanted: &Telegram, bytes: &[u8]) -> Vec<u8> {
    let algorithm = match wanted.protocol.key {
        _ if wanted.checksum == Checksum::Asked => return bytes.to_vec(),
        "modbus-rtu" => CHECKS[0],
        "modbus-ascii" => CHECKS[1],
        _ => return bytes.to_vec(),
    };
    let check_of = |bytes: &[u8]| algorithm.wire(bytes).to_be_bytes()[8 - algorithm.width..].to_vec();
    // A checksum was typed where it is valid, where the length is that with one, and where it is that of the
    // telegram that is wanted, whatever stands before it.
    let has_check = (wanted.protocol.verdict)(bytes) == Checked::Right
        || bytes.len() == wanted.bytes.len()
        || check_bytes(wanted).is_some_and(|check| hex(bytes).ends_with(&check));
    if has_check { bytes.to_vec() } else { [bytes, &check_of(bytes)].concat() }
}

/// Whether the bytes say the same. The number of a transaction is the client's own.
fn is_same(wanted: &Telegram, given: &[u8]) -> bool {
    let free = if wanted.protocol.key == "modbus-tcp" && wanted.request.is_none() { 2 } else { 0 };
    let own = given.iter().zip(&wanted.bytes).skip(free.min(wanted.bytes.len().saturating_sub(1)));
    given.len() == wanted.bytes.len() && own.into_iter().all(|(given, wanted)| given == wanted)
}

/// The right bytes or values, as people count: 17 3 107 for 11 03 00 6B.
fn in_decimal(wanted: &Telegram, text: &str) -> Option<Remark> {
    let apart = text.split([' ', ',', ';']).filter(|word| !word.is_empty());
    let typed: Vec<u64> = apart.map(|word| word.parse().ok()).collect::<Option<_>>()?;
    let body = wanted.check().map_or(wanted.bytes.len(), |check| check.covered.to);
    let bytes = wanted.bytes.iter().map(|byte| u64::from(*byte));
    let values = wanted.fields(false).into_iter().filter(|field| field.spec.role != Role::Check);
    let same = bytes.clone().eq(typed.iter().copied())
        || bytes.take(body).eq(typed.iter().copied())
        || values.map(|field| field.value.raw()).eq(typed.iter().copied().map(Some));
    // Up to 9, both look the same.
    let differs = typed.iter().any(|number| *number > 9);
    (same && differs).then(|| {
        Remark::new("", message!("these are the right numbers as people count; a telegram is written in hex"))
    })
}

/// What comes next, where all that was typed is right.
fn cut_off(wanted: &Telegram, typed: &[u8]) -> Option<Remark> {
    let field = wanted.field_at(typed.len()).filter(|_| wanted.bytes.starts_with(typed))?;
    if field.span.from == typed.len() {
        return Some(missing(&field));
    }
    let label = field.label().to_string();
    let left = Message::bytes(field.span.to - typed.len());
    let text = message!("{field} ends too early, with {bytes} missing", field = the(&label), bytes = left);
    Some(Remark::new(&label, text))
}

/// The checksum of a telegram as its bytes.
fn check_bytes(telegram: &Telegram) -> Option<String> {
    telegram.check().map(|check| check.computed_bytes())
}

/// What is off, the most important first.
fn compare(wanted: &Telegram, given: &[u8], typed: usize, typed_check: bool) -> Vec<Remark> {
    let answer = wanted.with(given.to_vec());
    let (right, own) = (wanted.fields(false), answer.fields(false));
    let asks = wanted.direction == buslens::field::Direction::Request;
    let mut remarks = Vec::new();
    // Who, what, where, how many: what comes behind depends on them.
    for (wanted, given) in pairs(&right, &own) {
        let head = matches!(wanted.spec.role, Role::Unit | Role::Function | Role::Address | Role::Count);
        if !head || is_free(wanted) {
            continue;
        }
        match given {
            // Behind what was typed stands only the checksum that was added.
            Some(given) if given.span.to > typed => remarks.push(missing(wanted)),
            Some(given) if given.value == wanted.value => {}
            Some(given) => remarks.push(differs(wanted, given, asks)),
            None => remarks.push(missing(wanted)),
        }
        // Another function has other fields.
        if wanted.spec.role == Role::Function && given.is_none_or(|given| given.value != wanted.value) {
            break;
        }
    }
    if remarks.is_empty() {
        remarks.extend(content(wanted, &answer, asks));
    }
    if let Some(check) = answer.check().filter(|check| typed_check && !check.ok()) {
        remarks.extend(of_check(check, wanted, given));
    }
    if remarks.is_empty() {
        remarks.extend(length(wanted, given));
    }
    if remarks.is_empty() {
        // Nothing of the above: the first byte that differs.
        let at = wanted.bytes.iter().zip(given).take_while(|(one, other)| one == other).count();
        let field = wanted.field_at(at).map_or(String::new(), |field| field.label().to_string());
        let byte = |bytes: &[u8]| hex(Span::new(at, at + 1).of(bytes));
        let text = message!(
            "byte {n} is {is}, it should be {should}",
            n = at,
            is = byte(given),
            should = byte(&wanted.bytes)
        );
        remarks.push(Remark::new(&field, text).at(Span::new(at, at + 1)));
    }
    remarks
}

/// Each field that is wanted with its like among those that are given.
fn pairs<'a>(wanted: &'a [Field], given: &'a [Field]) -> Vec<(&'a Field, Option<&'a Field>)> {
    let alike =
        |one: &Field, other: &Field| (one.spec.key, one.spec.label) == (other.spec.key, other.spec.label);
    let pair = |(at, field): (usize, &'a Field)| {
        let nth = wanted[..at].iter().filter(|before| alike(before, field)).count();
        (field, given.iter().filter(|other| alike(other, field)).nth(nth))
    };
    wanted.iter().enumerate().map(pair).collect()
}

/// A field whose value is the sender's own choice.
fn is_free(field: &Field) -> bool {
    field.spec.key == "transaction"
}

/// A value as it is said in a sentence.
pub(super) fn value(field: &Field) -> String {
    match (&field.value, field.meaning()) {
        (Value::Selector { raw, .. }, Some(meaning)) => format!("{raw} ({})", small(&meaning.to_string())),
        (Value::Number { .. }, Some(meaning)) if !field.spec.bits.is_empty() => {
            format!("{} ({meaning})", field.value_text())
        }
        _ => match field.value_text() {
            text if text.is_empty() => "not there".to_owned(),
            text => match field.spec.name(field.value.raw().unwrap_or_default()) {
                Some(name) if field.value.raw().is_some() => format!("{text} ({})", name.label),
                _ => text,
            },
        },
    }
}

fn differs(wanted: &Field, given: &Field, asks: bool) -> Remark {
    let label = wanted.label().to_string();
    let (is, should) = (value(given), value(wanted));
    let slip = match (wanted.value.raw(), given.value.raw()) {
        (Some(right), Some(own)) => {
            Slip::find(right, own, wanted.span.len().min(8), wanted.spec.role, wanted.spec.key)
        }
        _ => None,
    };
    let text = match slip {
        Some(slip) => message!(
            "{field} {what} ({is}, not {should}): {why}",
            field = the(&label),
            what = Argument::Term(slip.what()),
            is = is,
            should = should,
            why = Argument::Term(slip.why())
        ),
        None if matches!(given.value, Value::Missing { .. }) => return missing(wanted),
        None if asks => {
            message!("{field} is {is}, {should} was asked for", field = the(&label), is = is, should = should)
        }
        None => {
            message!("{field} is {is}, it should be {should}", field = the(&label), is = is, should = should)
        }
    };
    Remark::new(&label, text).at(given.span)
}

fn missing(wanted: &Field) -> Remark {
    let label = wanted.label().to_string();
    let text = message!(
        "{field} is missing: it has {bytes}",
        field = the(&label),
        bytes = Message::bytes(wanted.span.len())
    );
    Remark::new(&label, text)
}

/// What is wrong with values, where all before them is right.
fn content(wanted: &Telegram, answer: &Telegram, asks: bool) -> Vec<Remark> {
    let (right, own) = (wanted.fields(true), answer.fields(true));
    // What comes before the checksum; where that is too short, its bytes are none of a value.
    let width = wanted.check().map_or(0, |check| check.width);
    let body = &answer.bytes[..answer.bytes.len() - width.min(answer.bytes.len())];
    let mut remarks = Vec::new();
    for field in &right {
        if matches!(field.spec.role, Role::Check) || is_free(field) {
            continue;
        }
        let bytes = field.span.of(&wanted.bytes);
        let given = field.span.of(body);
        if bytes == given {
            continue;
        }
        let like = own.iter().find(|other| other.spec == field.spec && other.span == field.span);
        remarks.push(match like {
            _ if given.len() < bytes.len() => missing(field),
            Some(like) => data(field, like, bytes, given, asks),
            None => differs_in_bytes(field, bytes, given),
        });
    }
    if let Some(whole) = in_registers(&right, wanted, answer).filter(|_| remarks.len() > 1) {
        remarks.insert(0, whole);
    }
    remarks
}

fn differs_in_bytes(field: &Field, wanted: &[u8], given: &[u8]) -> Remark {
    let label = field.label().to_string();
    let text = message!(
        "{field} is {is}, it should be {should}",
        field = the(&label),
        is = hex(given),
        should = hex(wanted)
    );
    Remark::new(&label, text).at(field.span)
}

/// A value, with the slips that only values have.
fn data(wanted: &Field, given: &Field, bytes: &[u8], own: &[u8], asks: bool) -> Remark {
    let label = wanted.label().to_string();
    let (Some(right), Some(is)) = (wanted.value.raw(), given.value.raw()) else {
        return differs_in_bytes(wanted, bytes, own);
    };
    if wanted.spec.format == buslens::field::Format::Float && bytes.len() == 4 {
        let value = f32::from_bits(right as u32);
        if value.fract() == 0.0 && is == u64::from(value as u32) {
            let text = message!(
                "{field} is written as a whole number; a float of it has other bytes: {should}",
                field = the(&label),
                should = hex(bytes)
            );
            return Remark::new(&label, text).at(wanted.span);
        }
    }
    differs(wanted, given, asks)
}

/// Several registers that hold one value in another order.
fn in_registers(fields: &[Field], wanted: &Telegram, answer: &Telegram) -> Option<Remark> {
    let data: Vec<&Field> = fields.iter().filter(|field| field.spec.role == Role::Data).collect();
    let (first, last) = (data.first()?, data.last()?);
    let span = Span::new(first.span.from, last.span.to);
    let (right, own) = (span.of(&wanted.bytes), span.of(&answer.bytes));
    if right.len() != own.len() || right.len() < 4 || !right.len().is_multiple_of(4) {
        return None;
    }
    let arranged = |order: Order| {
        right.chunks(4).flat_map(|word| order.bytes(Order::Big.number(word), 4)).eq(own.iter().copied())
    };
    let slip = [
        (Order::LowWordFirst, Slip::WordsSwapped),
        (Order::BytesSwapped, Slip::BytesOfWordsSwapped),
        (Order::Little, Slip::BytesSwapped),
    ]
    .into_iter()
    .find(|(order, _)| arranged(*order))?
    .1;
    let label = first.label().to_string();
    let text = message!(
        "the value {what}: {why}",
        what = Argument::Term(slip.what()),
        why = Argument::Term(slip.why())
    );
    Some(Remark::new(&label, text).at(span))
}

fn of_check(check: Check, wanted: &Telegram, given: &[u8]) -> Option<Remark> {
    let label = match check.kind {
        "lrc" => "LRC",
        "fcs" => "FCS",
        _ => "CRC",
    };
    let (found, computed) = (check.found_bytes(), check.computed_bytes());
    let swapped = check.width == 2 && check.found.swap_bytes() >> 48 == check.computed;
    let text = if swapped {
        message!(
            "the two bytes of the CRC are in the other order: its low byte goes first, so {computed}",
            computed = computed
        )
    } else if check_bytes(wanted).as_ref() == Some(&found) {
        // It follows from what is wrong before it, or belongs to the telegram that was wanted.
        return None;
    } else {
        message!(
            "the {label} is {found}; over your bytes it is {computed}",
            label = label.to_owned(),
            found = found,
            computed = computed
        )
    };
    let width = check.width.min(given.len());
    Some(Remark::new(label, text).at(Span::new(check.covered.to, check.covered.to + width)))
}

fn length(wanted: &Telegram, given: &[u8]) -> Option<Remark> {
    let (right, own) = (wanted.bytes.len(), given.len());
    let text = match own.checked_sub(right) {
        Some(0) => return None,
        Some(more) => message!("it is {n} too long", n = Message::bytes(more)),
        None => message!("it is {n} too short", n = Message::bytes(right - own)),
    };
    Some(Remark::new("", text))
}
