//! A number that was to be found out.

use buslens::field::{Argument, Format, Order, Role};
use buslens::message;
use buslens::tool::parse_value;

use super::slip::Slip;
use super::{Remark, Verdict, the};
use crate::notation::{self, Notation, Written};
use crate::task::Number;

pub fn grade(wanted: &Number, text: &str) -> Verdict {
    if text.trim().is_empty() {
        return Verdict::Unread(message!("there is no answer yet"));
    }
    let text = without_unit(text, &wanted.unit);
    let named = wanted.spec.filter(|spec| !spec.names.is_empty() || !spec.bits.is_empty());
    let name = named.and_then(|spec| {
        let is_word = text.chars().any(|c| c.is_ascii_alphabetic());
        parse_value(text, wanted.width, spec).ok().filter(|_| is_word)
    });
    if name.is_some_and(|raw| raw == wanted.raw) {
        return Verdict::Right(None);
    }
    let written = match notation::read(text, wanted.width, wanted.format, wanted.notation) {
        Ok(written) => written,
        Err(_) if name.is_some() => return wrong(wanted, None),
        Err(message) => return of_another_kind(wanted, text).unwrap_or(Verdict::Unread(message)),
    };
    let bytes_only = written.notation != Notation::Decimal && wanted.notation == Notation::Any;
    let is_value = match wanted.format {
        Format::Float | Format::Places(_) => !bytes_only,
        Format::Signed => !bytes_only || wanted.raw >> (8 * wanted.width - 1) & 1 == 0,
        _ => true,
    };
    if written.raw == wanted.raw {
        return match () {
            () if !is_value => remark(
                wanted,
                message!("these are the bytes themselves; what number they stand for is asked"),
            ),
            // 65535 has the bits of −1, and is another number.
            () if wanted.format == Format::Signed && is_unsigned(text, &written, wanted) => remark(
                wanted,
                message!(
                    "the highest bit is set, so the number is below 0: take {over} off",
                    over = 1_u64 << (8 * wanted.width)
                ),
            ),
            () => in_notation(wanted, &written),
        };
    }
    if wanted.format == Format::Float && written.notation == Notation::Decimal {
        return float(wanted, &written);
    }
    wrong(wanted, Some(written.raw))
}

/// Right as a number; whether it is written as it was asked for.
fn in_notation(wanted: &Number, written: &Written) -> Verdict {
    match (wanted.notation, written.notation) {
        (Notation::Hex, Notation::Decimal | Notation::Binary) => remark(
            wanted,
            message!(
                "the number is right, but hex is asked: divide by 16, and write what is over 9 as A to F"
            ),
        ),
        (Notation::Binary, Notation::Decimal | Notation::Hex) => {
            remark(wanted, message!("the number is right, but binary is asked: a 0 or a 1 for each bit"))
        }
        (Notation::Decimal, Notation::Hex | Notation::Binary) => {
            remark(wanted, message!("the number is right, but decimal is asked"))
        }
        _ => Verdict::Right(None),
    }
}

/// Whether a number below 0 was written as if it were above.
fn is_unsigned(text: &str, written: &Written, wanted: &Number) -> bool {
    let negative = wanted.raw >> (8 * wanted.width - 1) & 1 == 1;
    negative && written.notation == Notation::Decimal && !text.contains(['-', '\u{2212}', '–'])
}

/// What digits that do not fit as asked would be otherwise: 200 where hex is asked and 00C8h meant fits; 4B7
/// where decimal is asked is hex.
fn of_another_kind(wanted: &Number, text: &str) -> Option<Verdict> {
    let others = [Notation::Any, Notation::Hex, Notation::Binary];
    let read = |notation| notation::read(text, wanted.width, Format::Decimal, notation).ok();
    let written = others.into_iter().find_map(|notation| read(notation).filter(|it| it.raw == wanted.raw))?;
    Some(match wanted.format {
        Format::Float | Format::Places(_) => {
            remark(wanted, message!("these are the bytes themselves; what number they stand for is asked"))
        }
        _ => in_notation(wanted, &written),
    })
}

/// A float: rounded ones count, and the usual slips are told apart.
fn float(wanted: &Number, written: &Written) -> Verdict {
    /// Fewer digits say too little.
    const FEWEST: usize = 3;
    let value = |raw: u64| match wanted.width {
        4 => f64::from(f32::from_bits(raw as u32)),
        _ => f64::from_bits(raw),
    };
    let (right, given) = (value(wanted.raw), value(written.raw));
    let near = |one: f64, other: f64| {
        let unit = 10_f64.powi(one.abs().log10().floor() as i32 + 1 - written.digits.min(12) as i32);
        (one - other).abs() <= unit * 0.500_001
    };
    if right != 0.0 && written.digits >= FEWEST && near(right, given) {
        let exact = buslens::field::float(wanted.raw, wanted.width);
        return Verdict::Right(Some(message!("rounded; exactly it is {exact}", exact = exact)));
    }
    let same = |other: f64| other.is_finite() && (other - given).abs() <= other.abs() * 1e-3;
    let bytes = Order::Big.bytes(wanted.raw, wanted.width);
    let arranged = |order: Order| value(order.number(&bytes));
    let mantissa = |raw: u64| raw & 0x007F_FFFF;
    let exponent = (wanted.raw >> 23 & 0xFF) as i32 - 127;
    let ratio = if right == 0.0 { 0.0 } else { given / right };
    let text = if given == -right {
        message!("the sign is the other one: the highest bit is 1 for numbers below 0")
    } else if same(arranged(Order::LowWordFirst)) {
        message!("the word order is swapped: the first register is the high word here")
    } else if same(arranged(Order::Little)) || same(arranged(Order::BytesSwapped)) {
        message!("the byte order is another one: the high byte comes first")
    } else if (given - wanted.raw as f64).abs() <= given.abs() * 1e-6 {
        message!(
            "this is what the bytes are as a whole number; they are a float, with sign, exponent and fraction"
        )
    } else if wanted.width == 4 && same(mantissa(wanted.raw) as f64 / 8_388_608.0 * 2_f64.powi(exponent)) {
        message!("the 1 before the point is not stored, but it counts: 1 + fraction")
    } else if ratio > 0.0 && ratio.log2().fract() == 0.0 {
        message!("the exponent is off by {n}: it is stored with 127 added", n = ratio.log2().abs() as u64)
    } else if ratio > 0.0 && [1.0, 2.0, 3.0].iter().any(|n| (ratio.log10().abs() - n).abs() < 1e-6) {
        message!("the point is at another place")
    } else if same(right.trunc()) || (given - right).abs() <= right.abs() * 0.02 {
        message!("that is near, but not near enough: give at least {n} digits", n = FEWEST)
    } else {
        message!("the value is another one: take sign, exponent and fraction apart once more")
    };
    remark(wanted, text)
}

/// A whole number, and which slip it looks like.
fn wrong(wanted: &Number, given: Option<u64>) -> Verdict {
    let label = if wanted.label.is_empty() { "the number".to_owned() } else { the(&wanted.label) };
    let key = wanted.spec.map_or("", |spec| spec.key);
    let slip = given.and_then(|given| Slip::find(wanted.raw, given, wanted.width, wanted.role, key));
    let scaled = |given: u64| {
        [10, 100, 1000]
            .iter()
            .any(|by| given.checked_mul(*by) == Some(wanted.raw) || wanted.raw * by == given)
    };
    let text = match (slip, given) {
        (Some(slip), _) => message!(
            "{label} {what}: {why}",
            label = label,
            what = Argument::Term(slip.what()),
            why = Argument::Term(slip.why())
        ),
        (None, Some(given)) if matches!(wanted.format, Format::Places(_)) && scaled(given) => {
            message!("the point is at another place: the manual says what one step is")
        }
        (None, Some(given)) if wanted.raw != 0 && given == wanted.raw.wrapping_neg() & mask(wanted.width) => {
            message!("the sign is the other one")
        }
        (None, Some(given)) if wanted.spec.is_none() && wanted.role == Role::Data => {
            let shown: Argument = match wanted.notation {
                Notation::Hex => buslens::field::hex_value(given, wanted.width).into(),
                _ => given.into(),
            };
            match given < wanted.raw {
                true => message!("{given} is too low", given = shown),
                false => message!("{given} is too high", given = shown),
            }
        }
        _ => match wanted.role {
            Role::Address => {
                message!("{label} is another one: it is in the bytes that say where", label = label)
            }
            Role::Count => {
                message!("{label} is another one: it is in the bytes that say how many", label = label)
            }
            _ => message!("{label} is another one", label = label),
        },
    };
    remark(wanted, text)
}

fn remark(wanted: &Number, text: buslens::field::Message) -> Verdict {
    Verdict::wrong(Remark::new(&wanted.label, text))
}

const fn mask(width: usize) -> u64 {
    u64::MAX >> (64 - 8 * width)
}

/// The number alone, where its unit is behind it.
fn without_unit<'a>(text: &'a str, unit: &str) -> &'a str {
    let text = text.trim();
    if unit.is_empty() { text } else { text.strip_suffix(unit).unwrap_or(text).trim_end() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(wanted: &Number, text: &str) -> String {
        match grade(wanted, text) {
            Verdict::Right(None) => "right".to_owned(),
            Verdict::Right(Some(note)) => format!("right, {note}"),
            Verdict::Wrong(remarks) => remarks[0].text.to_string(),
            Verdict::Unread(message) => format!("unread: {message}"),
        }
    }

    #[test]
    fn numbers_are_right_in_any_notation() {
        let address = Number::new("Starting address", 200, 2, Format::Decimal).role(Role::Address);
        for text in ["200", "0xC8", "C8h", "00C8h", "0200", " 200 ", "1100 1000b"] {
            assert_eq!(said(&address, text), "right", "{text}");
        }
        assert!(said(&address, "201").starts_with("the starting address is one too high"));
        assert!(said(&address, "40201").contains("take 40001 off"));
        assert!(said(&address, "51200").contains("bytes in the other order"));
        assert!(said(&address, "seven").starts_with("unread"));
        let hex = address.clone().notation(Notation::Hex);
        assert_eq!(said(&hex, "00C8"), "right");
        assert_eq!(said(&hex, "c8"), "right");
        assert!(said(&hex, "200").contains("decimal digits where hex ones belong"), "{}", said(&hex, "200"));
    }

    #[test]
    fn floats_may_be_rounded_and_slips_are_named() {
        let float = Number::new("Value", 0x42A4_F1DE, 4, Format::Float);
        assert_eq!(said(&float, "82.4724"), "right");
        assert_eq!(said(&float, "82,47"), "right, rounded; exactly it is 82.4724");
        assert_eq!(said(&float, "82.5"), "right, rounded; exactly it is 82.4724");
        assert!(said(&float, "82").contains("at least 3 digits"));
        assert!(said(&float, "42A4F1DE").contains("the bytes themselves"), "{}", said(&float, "42A4F1DE"));
        assert!(said(&float, "42A4F1DEh").contains("the bytes themselves"));
        assert!(said(&float, "-82.4724").contains("sign"));
        assert!(said(&float, "164.9448").contains("exponent is off by 1"), "{}", said(&float, "164.9448"));
        assert!(said(&float, "1118106078").contains("whole number"));
        assert!(said(&float, "18.4724").contains("the 1 before the point"), "{}", said(&float, "18.4724"));
        let swapped = buslens::field::float(0xF1DE_42A4, 4);
        assert!(said(&float, &swapped).contains("word order"), "{swapped}");
    }

    #[test]
    fn signed_numbers_are_below_zero() {
        let signed = Number::new("Speed", 0xFF85, 2, Format::Signed);
        assert_eq!(said(&signed, "−123"), "right");
        assert_eq!(said(&signed, "-123"), "right");
        assert!(said(&signed, "65413").contains("take 65536 off"));
        assert!(said(&signed, "123").contains("sign is the other one"));
        assert!(said(&signed, "FF85h").contains("bytes themselves"));
        let scaled = Number { unit: "Hz".to_owned(), ..Number::new("Frequency", 505, 2, Format::Places(1)) };
        assert_eq!(said(&scaled, "50.5 Hz"), "right");
        assert_eq!(said(&scaled, "50,5"), "right");
        assert!(said(&scaled, "505").contains("point"), "{}", said(&scaled, "505"));
    }
}
