//! Registers seen in every usual way: as numbers of 16, 32 and 64 bits, floats, bits, characters.

use crate::field::{Format, Order, escaped, number_text};

/// One way to see one or several registers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct View {
    pub kind: Kind,
    /// How many bits it takes: 16 for each register.
    pub bits: usize,
    /// In which order the registers' bytes are taken; for one register the order of the wire.
    pub order: Order,
    pub text: String,
}

/// What a view takes the bits for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Unsigned,
    Signed,
    Hex,
    Bits,
    Characters,
    Float,
}

impl Kind {
    pub const fn name(self) -> &'static str {
        match self {
            Self::Unsigned => "unsigned",
            Self::Signed => "signed",
            Self::Hex => "hex",
            Self::Bits => "bits",
            Self::Characters => "characters",
            Self::Float => "float",
        }
    }
}

/// The register at the beginning of `bytes` in every view, and together with those behind it as
/// far as there are some: two make 32 bits, four make 64.
pub fn views(bytes: &[u8]) -> Vec<View> {
    let mut views = Vec::new();
    for width in [2, 4, 8] {
        let Some(bytes) = bytes.get(..width) else { break };
        let orders: &[Order] = if width == 2 { &[Order::Big] } else { &Order::ALL };
        let kinds: &[Kind] = match width {
            2 => &[Kind::Unsigned, Kind::Signed, Kind::Hex, Kind::Bits, Kind::Characters],
            _ => &[Kind::Unsigned, Kind::Signed, Kind::Float],
        };
        for kind in kinds {
            for order in orders {
                let text = text(*kind, order.number(bytes), bytes);
                views.push(View { kind: *kind, bits: 8 * width, order: *order, text });
            }
        }
    }
    views
}

/// What two registers most look like: which kind of number, in which order. A guess: a float of usual
/// size with few digits, or a small whole number. `None` where nothing or too much looks so.
pub fn guess(bytes: &[u8]) -> Option<(Kind, Order)> {
    /// Exponents of floats from 0.001 to 1,000,000, about.
    const USUAL: std::ops::Range<u64> = 117..147;
    /// Larger whole numbers are rare in two registers, since one holds up to 65,535.
    const SMALL: std::ops::Range<u64> = 1..1_000_000;
    /// So many digits have values that a person set.
    const FEW: usize = 7;
    let bytes = bytes.get(..4)?;
    let float = |order: &Order| {
        let raw = order.number(bytes);
        let text = number_text(raw, 4, Format::Float);
        let digits =
            text.trim_start_matches(['\u{2212}', '0', '.']).chars().filter(char::is_ascii_digit).count();
        USUAL.contains(&(raw >> 23 & 0xFF)).then_some(digits)
    };
    let floats: Vec<(Order, usize)> =
        Order::ALL.iter().filter_map(|order| Some((*order, float(order)?))).collect();
    let shortest = floats.iter().copied().min_by_key(|(_, digits)| *digits);
    match (shortest, &floats[..]) {
        (Some((order, ..=FEW)), _) => return Some((Kind::Float, order)),
        (_, [(order, _)]) => return Some((Kind::Float, *order)),
        _ => {}
    }
    let small = Order::ALL.into_iter().find(|order| SMALL.contains(&order.number(bytes)));
    small.map(|order| (Kind::Unsigned, order))
}

fn text(kind: Kind, raw: u64, bytes: &[u8]) -> String {
    let width = bytes.len();
    match kind {
        Kind::Unsigned => raw.to_string(),
        Kind::Signed => number_text(raw, width, Format::Signed),
        Kind::Float => number_text(raw, width, Format::Float),
        Kind::Hex => number_text(raw, width, Format::Hex),
        Kind::Characters => escaped(bytes),
        Kind::Bits => {
            let nibbles: Vec<String> =
                (0..2 * width).rev().map(|at| format!("{:04b}", raw >> (4 * at) & 15)).collect();
            nibbles.join(" ")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seen(bytes: &[u8], kind: Kind, bits: usize, order: Order) -> Option<String> {
        let found = views(bytes).into_iter().find(|v| (v.kind, v.bits, v.order) == (kind, bits, order));
        found.map(|view| view.text)
    }

    #[test]
    fn one_register() {
        let of = |kind| seen(&[0xFF, 0x41], kind, 16, Order::Big).unwrap();
        assert_eq!(of(Kind::Unsigned), "65345");
        assert_eq!(of(Kind::Signed), "\u{2212}191");
        assert_eq!(of(Kind::Hex), "FF41h");
        assert_eq!(of(Kind::Bits), "1111 1111 0100 0001");
        assert_eq!(of(Kind::Characters), "\\xFFA");
    }

    #[test]
    fn a_float_in_every_order() {
        for order in Order::ALL {
            let bytes = order.bytes(0x42F6_E979, 4);
            assert_eq!(seen(&bytes, Kind::Float, 32, order).unwrap(), "123.456");
            let bytes = order.bytes(0x405E_DD2F_1A9F_BE77, 8);
            assert_eq!(seen(&bytes, Kind::Float, 64, order).unwrap(), "123.456");
            let bytes = order.bytes((-5_i64) as u64, 8);
            assert_eq!(seen(&bytes, Kind::Signed, 64, order).unwrap(), "\u{2212}5");
        }
    }

    #[test]
    fn the_plausible_order_is_guessed() {
        for order in Order::ALL {
            for value in [123.456_f32, -0.5, 20.0, 99.9] {
                let bytes = order.bytes(value.to_bits().into(), 4);
                assert_eq!(guess(&bytes), Some((Kind::Float, order)), "{value} {bytes:02X?}");
            }
        }
        assert_eq!(guess(&[0, 0, 1, 0x2C]), Some((Kind::Unsigned, Order::Big)));
        assert_eq!(guess(&[1, 0x2C, 0, 0]), Some((Kind::Unsigned, Order::LowWordFirst)));
        assert_eq!(guess(&[0; 4]), None);
        assert_eq!(guess(&[0xFF; 4]), None);
        assert_eq!(guess(&[0; 2]), None);
    }

    #[test]
    fn what_is_not_there_is_not_shown() {
        assert_eq!(views(&[0]), []);
        assert!(views(&[0; 2]).iter().all(|view| view.bits == 16));
        assert!(views(&[0; 6]).iter().all(|view| view.bits < 64));
    }
}
