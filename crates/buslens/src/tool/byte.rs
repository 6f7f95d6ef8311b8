//! One byte of a telegram: which field it belongs to, and how the field's value comes from it.

use super::Detail;
use crate::field::{Argument, Field, Format, Message, Spec, Value, float, hex_value, leaves, number_text};
use crate::message;

/// What there is to say of a byte as part of one field.
#[derive(Clone, Debug, PartialEq)]
pub struct Share {
    /// "Byte 1 of 2 of Register 200".
    pub place: Message,
    /// How the value comes about, step by step.
    pub steps: Vec<Message>,
    /// What the field is about, and where that is described.
    pub note: &'static str,
    pub source: &'static str,
}

/// What byte `at` is: in the telegram, and in what the device's manual says of it.
pub fn shares(detail: &Detail, bytes: &[u8], at: usize) -> Vec<Share> {
    let blocks = detail.device.blocks.iter().map(|block| std::slice::from_ref(&block.field));
    let trees = std::iter::once(&detail.fields[..]).chain(blocks);
    trees
        .filter_map(|tree| leaves(tree).into_iter().find(|leaf| leaf.span.contains(at)))
        .map(|leaf| share(leaf, bytes, at))
        .collect()
}

fn share(field: &Field, bytes: &[u8], at: usize) -> Share {
    let width = field.span.len();
    let place = match width {
        1 => message!("{label}", label = field.label()),
        _ => message!(
            "byte {n} of {width} of {label}",
            n = at - field.span.from + 1,
            width = width,
            label = field.label()
        ),
    };
    let own = field.span.of(bytes);
    let mut steps = Vec::new();
    match field.value {
        Value::Number { raw, width } if own.len() == width => {
            weigh(field.spec, raw, own, at - field.span.from, &mut steps);
        }
        Value::Check(check) => steps.push(message!(
            "{kind} over the bytes {from} to {to} gives {computed}; here stands {found}",
            kind = check.kind.to_ascii_uppercase(),
            from = check.covered.from,
            to = check.covered.to.saturating_sub(1),
            computed = check.computed_bytes(),
            found = check.found_bytes()
        )),
        _ => {}
    }
    // Bits are listed one by one above.
    if let Some(meaning) = field.meaning().filter(|_| field.spec.bits.is_empty() && steps.len() < 2) {
        steps.push(meaning);
    }
    Share { place, steps, note: field.spec.note, source: field.spec.source }
}

/// How the byte `at` of a number counts, and what becomes of the number.
fn weigh(spec: &Spec, raw: u64, own: &[u8], at: usize, steps: &mut Vec<Message>) {
    let width = own.len();
    // The number with this byte alone.
    let alone = |value: u8| {
        let mut bytes = vec![0; width];
        bytes[at] = value;
        spec.order.number(&bytes)
    };
    let (weight, share) = (alone(1), alone(own[at]));
    let shown = || number_text(raw, width, spec.format);
    if width > 1 && spec.format == Format::Float {
        steps.push(message!("it holds {bits}", bits = bits_of_float(weight.trailing_zeros() / 8, width)));
    } else if width > 1 && spec.bits.is_empty() {
        steps.push(message!(
            "it contributes {byte} × {weight} = {share} to the value {raw}",
            byte = own[at],
            weight = weight,
            share = share,
            raw = raw
        ));
    }
    match spec.format {
        Format::Float if width == 4 => steps.push(dismantled(raw as u32)),
        Format::Signed if width < 8 && raw >> (8 * width - 1) == 1 => steps.push(message!(
            "the highest bit is set, so it is below 0: {raw} − {over} = {value}",
            raw = raw,
            over = 1_u64 << (8 * width),
            value = shown()
        )),
        Format::Places(places) => {
            steps.push(message!(
                "in steps of {step}: {value}",
                step = number_text(1, width, Format::Places(places)),
                value = shown()
            ));
        }
        _ => {}
    }
    // The bits of this byte, highest first.
    let low = weight.trailing_zeros();
    for part in spec.bits.iter().rev().filter(|part| part.from < low + 8 && part.from + part.count > low) {
        let value = part.of(raw);
        let label = Argument::Term(part.label);
        steps.push(match part.name(value) {
            Some(name) => message!(
                "bit {from}, {label}: {value}, {name}",
                from = part.from,
                label = label,
                value = value,
                name = Argument::Term(name.label)
            ),
            None => message!("bit {from}, {label}: {value}", from = part.from, label = label, value = value),
        });
    }
    if !spec.unit.is_empty() {
        steps.push(message!("the unit is {unit}", unit = Argument::Term(spec.unit)));
    }
}

/// What of a float is in its byte `place`, counted from the lowest.
fn bits_of_float(place: u32, width: usize) -> Message {
    match width as u32 - 1 - place {
        0 => message!("the sign and the upper 7 bits of the exponent"),
        1 if width == 4 => message!("the last bit of the exponent and the upper 7 bits of the fraction"),
        1 => message!("the lower 4 bits of the exponent and the upper 4 bits of the fraction"),
        _ => message!("bits {from} to {to} of the fraction", from = 8 * place, to = 8 * place + 7),
    }
}

/// A float of 4 bytes by its parts.
fn dismantled(raw: u32) -> Message {
    let (exponent, fraction) = (raw >> 23 & 0xFF, raw & 0x7F_FFFF);
    let value = float(raw.into(), 4);
    if exponent == 0 || exponent == 255 {
        return message!(
            "the exponent is {exponent}, which stands for {value}",
            exponent = exponent,
            value = value
        );
    }
    message!(
        "{sign}2^({exponent} − 127) × {mantissa} = {value}",
        sign = if raw >> 31 == 1 { "−" } else { "" }.to_owned(),
        exponent = exponent,
        // The fraction behind a 1 that is not sent: the float with the exponent of 1.
        mantissa = float(u64::from(0x3F80_0000 | fraction), 4),
        value = value
    )
}

/// The byte by itself: "42h, 66, 0100 0010".
pub fn itself(byte: u8) -> Message {
    message!(
        "{hex}, {decimal}, {high} {low}",
        hex = hex_value(byte.into(), 1),
        decimal = byte,
        high = format!("{:04b}", byte >> 4),
        low = format!("{:04b}", byte & 15)
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tool::{Options, PROFILES, decode};

    fn said(text: &str, device: &str, at: usize) -> Vec<String> {
        let device = PROFILES.iter().copied().find(|profile| profile.key == device);
        let report = decode(text, Options { device, ..Options::default() });
        let last = report.telegrams.len() - 1;
        let bytes = &report.telegrams[last].line.bytes;
        let shares = shares(&report.detail(last).unwrap(), bytes, at);
        shares
            .into_iter()
            .flat_map(|it| std::iter::once(it.place).chain(it.steps))
            .map(|it| it.to_string())
            .collect()
    }

    const PAIR: &str = "01 03 00 C8 00 03 84 35\n01 03 06 00 80 42 F6 E9 79 28 15";

    #[test]
    fn a_byte_of_a_register_counts_by_its_place() {
        assert_eq!(
            said(PAIR, "", 5),
            ["byte 1 of 2 of Register 201", "it contributes 66 × 256 = 16896 to the value 17142", "42F6h"]
        );
    }

    #[test]
    fn a_float_is_taken_apart() {
        let said = said(PAIR, "memograph-rsg45", 6);
        assert_eq!(
            said[3..],
            [
                "byte 2 of 4 of Value",
                "it holds the last bit of the exponent and the upper 7 bits of the fraction",
                "2^(133 − 127) × 1.929 = 123.456"
            ]
        );
    }

    #[test]
    fn bits_are_listed_by_the_byte_they_are_in() {
        let high = said(PAIR, "memograph-rsg45", 3);
        let low = said(PAIR, "memograph-rsg45", 4);
        assert!(low.iter().any(|step| step.contains("good")), "{low:?}");
        assert!(!high.iter().any(|step| step.contains("good")), "{high:?}");
    }

    #[test]
    fn a_check_says_what_it_is_over() {
        assert_eq!(
            said(PAIR, "", 9)[1],
            "CRC-16/MODBUS over the bytes 0 to 8 gives 5A 93; here stands 28 15"
        );
    }
}
