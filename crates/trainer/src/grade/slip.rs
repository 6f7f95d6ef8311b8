//! The slips that people make with numbers, as far as the number itself tells.

use buslens::field::{Order, Role};

/// What became of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slip {
    OneHigh(Counted),
    OneLow(Counted),
    /// 40201 for address 200.
    Reference,
    BytesSwapped,
    WordsSwapped,
    BytesOfWordsSwapped,
    /// Decimal digits taken for hex ones: 0200h for 200.
    DecimalAsHex,
    /// Hex digits taken for decimal ones: 12 for 12h.
    HexAsDecimal,
    /// A quantity of registers that counts their bytes.
    CountsBytes,
    /// A count of bytes that counts registers.
    CountsRegisters,
    LowByte,
    HighByte,
    ExceptionBit,
}

/// What a number that is one off counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Counted {
    Addresses,
    /// The index of a parameter.
    Parameters,
    /// How many are asked for.
    Quantity,
    /// Bytes that follow.
    Bytes,
}

impl Counted {
    const fn of(role: Role, key: &str) -> Option<Self> {
        match (role, key.as_bytes()) {
            (_, b"subindex") => None,
            (Role::Address, b"index") => Some(Self::Parameters),
            (Role::Address, _) => Some(Self::Addresses),
            (Role::Count, b"quantity" | b"") => Some(Self::Quantity),
            (Role::Count, b"byte_count" | b"length" | b"length_again") => Some(Self::Bytes),
            _ => None,
        }
    }
}

impl Slip {
    /// What turned `wanted` into `given`, if that is a usual slip. `key` is the stable word of the field, where
    /// it is one.
    pub fn find(wanted: u64, given: u64, width: usize, role: Role, key: &str) -> Option<Self> {
        if wanted == given {
            return None;
        }
        let arranged = |order: Order| order.number(&Order::Big.bytes(wanted, width)) == given;
        let address = role == Role::Address;
        let digits = |number: u64| number.to_string();
        let hex_digits = |number: u64| format!("{number:x}");
        let references = [40_001, 400_001, 30_001, 300_001, 10_001, 40_000, 30_000];
        let counted = Counted::of(role, key);
        if let Some(counted) = counted {
            if given == wanted + 1 {
                return Some(Self::OneHigh(counted));
            }
            if given + 1 == wanted {
                return Some(Self::OneLow(counted));
            }
        }
        let found = [
            (address && references.iter().any(|first| given == wanted + first), Self::Reference),
            (role == Role::Function && given == wanted ^ 0x80, Self::ExceptionBit),
            (key == "quantity" && given == 2 * wanted, Self::CountsBytes),
            (key == "byte_count" && 2 * given == wanted, Self::CountsRegisters),
            (width == 2 && arranged(Order::Little), Self::BytesSwapped),
            (width == 4 && arranged(Order::LowWordFirst), Self::WordsSwapped),
            (width == 4 && arranged(Order::BytesSwapped), Self::BytesOfWordsSwapped),
            (width > 2 && arranged(Order::Little), Self::BytesSwapped),
            (wanted > 9 && hex_digits(given) == digits(wanted), Self::DecimalAsHex),
            (wanted > 9 && digits(given) == hex_digits(wanted), Self::HexAsDecimal),
            (width == 2 && wanted > 0xFF && given == wanted & 0xFF, Self::LowByte),
            (width == 2 && wanted > 0xFF && given == wanted >> 8, Self::HighByte),
        ];
        found.into_iter().find(|(is, _)| *is).map(|(_, slip)| slip)
    }

    /// What is wrong, behind the label of the field: "is one too high".
    pub const fn what(self) -> &'static str {
        match self {
            Self::OneHigh(_) => "is one too high",
            Self::OneLow(_) => "is one too low",
            Self::Reference => "still has the digit in front that only names the kind of register",
            Self::BytesSwapped => "has its bytes in the other order",
            Self::WordsSwapped => "has its two words in the other order: the word order is swapped",
            Self::BytesOfWordsSwapped => "has the two bytes of each word in the other order",
            Self::DecimalAsHex => "has decimal digits where hex ones belong",
            Self::HexAsDecimal => "has hex digits that were taken for decimal ones",
            Self::CountsBytes => "counts bytes",
            Self::CountsRegisters => "counts registers",
            Self::LowByte => "has only its low byte",
            Self::HighByte => "has only its high byte",
            Self::ExceptionBit => "is off by its highest bit",
        }
    }

    /// What to know about it.
    pub const fn why(self) -> &'static str {
        match self {
            Self::OneHigh(Counted::Addresses) => {
                "a telegram counts addresses from 0, lists of registers often from 1"
            }
            Self::OneLow(Counted::Addresses) => "it is counted from 0 already: nothing is to be taken off",
            Self::Reference => "40201 is the register at address 200, so take 40001 off",
            Self::OneHigh(counted) | Self::OneLow(counted) => match counted {
                Counted::Parameters => "the index is the parameter's own number plus 2000h",
                Counted::Bytes => "it says how many bytes follow",
                Counted::Addresses | Counted::Quantity => "from 5 to 7 are three: last − first + 1",
            },
            Self::BytesSwapped => "the high byte comes first",
            Self::WordsSwapped => "the high word comes first here, then the low one",
            Self::BytesOfWordsSwapped => "within each register, the high byte comes first",
            Self::DecimalAsHex => "divide by 16 to get the hex digits",
            Self::HexAsDecimal => "each hex digit counts 16 times the one behind it",
            Self::CountsBytes => "it is to count registers, of two bytes each",
            Self::CountsRegisters => "it is to count bytes, two for each register",
            Self::LowByte | Self::HighByte => "two bytes make one number: high byte × 256 + low byte",
            Self::ExceptionBit => "80h is added by a server that rejects a request, and by nobody else",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn usual_slips_are_known() {
        for (wanted, given, width, role, key, slip) in [
            (200, 201, 2, Role::Address, "start", Slip::OneHigh(Counted::Addresses)),
            (200, 199, 2, Role::Address, "start", Slip::OneLow(Counted::Addresses)),
            (200, 40_201, 2, Role::Address, "start", Slip::Reference),
            (200, 0xC800, 2, Role::Address, "start", Slip::BytesSwapped),
            (200, 0x200, 2, Role::Address, "start", Slip::DecimalAsHex),
            (0x12, 12, 2, Role::Data, "", Slip::HexAsDecimal),
            (3, 6, 2, Role::Count, "quantity", Slip::CountsBytes),
            (6, 3, 1, Role::Count, "byte_count", Slip::CountsRegisters),
            (3, 4, 2, Role::Count, "quantity", Slip::OneHigh(Counted::Quantity)),
            (6, 7, 1, Role::Count, "byte_count", Slip::OneHigh(Counted::Bytes)),
            (0x2201, 0x2200, 2, Role::Address, "index", Slip::OneLow(Counted::Parameters)),
            (0x42F6_E979, 0xE979_42F6, 4, Role::Data, "", Slip::WordsSwapped),
            (0x42F6_E979, 0xF642_79E9, 4, Role::Data, "", Slip::BytesOfWordsSwapped),
            (0x42F6_E979, 0x79E9_F642, 4, Role::Data, "", Slip::BytesSwapped),
            (0x1234, 0x34, 2, Role::Data, "", Slip::LowByte),
            (0x03, 0x83, 1, Role::Function, "", Slip::ExceptionBit),
        ] {
            assert_eq!(Slip::find(wanted, given, width, role, key), Some(slip), "{wanted} {given}");
        }
        assert_eq!(Slip::find(200, 200, 2, Role::Address, ""), None);
        assert_eq!(Slip::find(200, 777, 2, Role::Address, ""), None);
        // What counts nothing is not "one too high".
        assert_eq!(Slip::find(0, 1, 2, Role::Count, "protocol"), None);
        assert_eq!(Slip::find(1, 2, 1, Role::Address, "subindex"), None);
    }
}
