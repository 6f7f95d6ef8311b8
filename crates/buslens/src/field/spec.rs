use super::{Argument, Bits, Message, Numbering, hex_value};
use crate::message;

/// What a field is, in every telegram: its names, its limits, what its values are called.
///
/// A spec is a constant beside the telegram it belongs to:
///
/// ```
/// use buslens::field::{Role, Spec};
///
/// static QUANTITY: Spec =
///     Spec::new("quantity", "Quantity").role(Role::Count).limits(1, 125).note("How many to read.");
/// ```
#[derive(Debug)]
pub struct Spec {
    /// Stable snake_case word of exports, vectors and links.
    pub key: &'static str,
    pub label: &'static str,
    /// A label of one word, for narrow places.
    pub short: &'static str,
    pub role: Role,
    pub format: Format,
    /// The smallest and the largest allowed value.
    pub limits: Option<(u64, u64)>,
    /// What else a value must be: what is wrong with it, in a few words, or nothing.
    pub rule: Option<fn(u64) -> Option<&'static str>>,
    /// What single values are called.
    pub names: &'static [Name],
    /// What values without a name of their own are called, by where they lie.
    pub ranges: &'static [Range],
    /// The manual defines no values and bits but those with a name.
    pub only_named: bool,
    /// One or two sentences for a person who meets the field for the first time.
    pub note: &'static str,
    /// Document and section.
    pub source: &'static str,
    /// The list's items are numbered as the device's manual does: `5F32h`.
    pub hex_numbers: bool,
    /// What the bits of the number say, lowest first; empty where it is no set of bits.
    pub bits: &'static [Bits],
    /// What the number counts: `ms`.
    pub unit: &'static str,
    /// In which order the bytes of the number come.
    pub order: Order,
    /// How many numbers an item of a list stands for: 8 for a byte of coils.
    pub step: u64,
    /// What its flags are when they are set, and what is said when none is: "on", "all off".
    pub flagged: Option<(&'static str, &'static str)>,
    /// What the parts of a text say.
    pub told: Option<fn(&str) -> Option<Message>>,
    /// The address of the parameter that a value stands for, if it stands for one.
    pub refers: Option<fn(u64) -> Option<u16>>,
    /// What a form begins with.
    pub initial: u64,
}

/// Keys are in the program only where something writes or reads them: the page that only shows
/// telegrams is 3 kB lighter without.
pub(super) const fn kept_key(key: &'static str) -> &'static str {
    if cfg!(feature = "keys") { key } else { "" }
}

/// Specs are constants: the same key and label are the same spec.
impl PartialEq for Spec {
    fn eq(&self, other: &Self) -> bool {
        (self.key, self.label) == (other.key, other.label)
    }
}

/// A value with a name of its own.
#[derive(Debug, PartialEq)]
pub struct Name {
    pub value: u64,
    pub label: &'static str,
    /// What follows from it, where that helps.
    pub note: &'static str,
}

/// Values that lie together and are called the same.
#[derive(Debug, PartialEq)]
pub struct Range {
    pub from: u64,
    pub to: u64,
    pub label: &'static str,
}

/// What a field is for. The page gives each role a colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Who is meant: unit, station.
    Unit,
    /// What is to be done.
    Function,
    /// Where: register, index.
    Address,
    /// How many, how long.
    Count,
    /// The payload.
    Data,
    /// What became of it: exception code, status.
    Status,
    /// What proves the rest.
    Check,
    /// Bytes that no rule explains.
    Unknown,
}

/// In which order the bytes of a number come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// Most significant byte first (ABCD): what both protocols say.
    Big,
    /// Least significant byte first (DCBA).
    Little,
    /// The 16-bit words swapped, each with its high byte first (CDAB).
    LowWordFirst,
    /// The high word first, the bytes of each word swapped (BADC).
    BytesSwapped,
}

impl Order {
    /// All of them, the usual one first.
    pub const ALL: [Self; 4] = [Self::Big, Self::LowWordFirst, Self::BytesSwapped, Self::Little];

    /// Letters and words for it.
    pub const fn name(self) -> (&'static str, &'static str) {
        match self {
            Self::Big => ("ABCD", "big-endian"),
            Self::LowWordFirst => ("CDAB", "word-swapped"),
            Self::BytesSwapped => ("BADC", "byte-swapped"),
            Self::Little => ("DCBA", "little-endian"),
        }
    }

    /// The number that `bytes` hold.
    pub fn number(self, bytes: &[u8]) -> u64 {
        let number = |bytes: &[u8]| bytes.iter().fold(0, |number, byte| number << 8 | u64::from(*byte));
        if self == Self::Big {
            return number(bytes);
        }
        let mut bytes = bytes.to_vec();
        self.arrange(&mut bytes);
        number(&bytes)
    }

    /// The `width` bytes of `number`.
    pub fn bytes(self, number: u64, width: usize) -> Vec<u8> {
        let mut bytes = number.to_be_bytes()[8 - width..].to_vec();
        self.arrange(&mut bytes);
        bytes
    }

    /// From big-endian to this order, which is the same way as back.
    fn arrange(self, bytes: &mut [u8]) {
        if matches!(self, Self::Little | Self::LowWordFirst) {
            bytes.reverse();
        }
        if matches!(self, Self::BytesSwapped | Self::LowWordFirst) {
            bytes.chunks_mut(2).for_each(<[u8]>::reverse);
        }
    }
}

/// How a number, or a run of bytes, is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    Decimal,
    Hex,
    /// Two's complement.
    Signed,
    /// An IEEE 754 number of 4 or 8 bytes.
    Float,
    /// So many decimal places: 15 with one is 1.5.
    Places(u32),
    /// A date as KEB writes it: decimal day, month, last digit of the year, `31011` for 31.01.2001.
    DayMonthYear,
    /// Eight switches of a row, lowest bit first: coils, discrete inputs.
    Switches,
    /// Bytes that are characters.
    Text,
    /// A zero-based Modbus address; the digit is that of the 4xxxx notation (`4` for holding
    /// registers, `3` for input registers).
    Reference(char),
    /// A device's register that its manual writes in hex (`5F32h`).
    HexAddress,
    /// A register's content: unsigned, with the hex and signed views beside it.
    Register,
}

impl Spec {
    pub const fn new(key: &'static str, label: &'static str) -> Self {
        Self {
            key: kept_key(key),
            label,
            short: label,
            role: Role::Data,
            format: Format::Decimal,
            limits: None,
            rule: None,
            names: &[],
            ranges: &[],
            only_named: false,
            note: "",
            source: "",
            hex_numbers: false,
            bits: &[],
            unit: "",
            order: Order::Big,
            step: 1,
            flagged: None,
            told: None,
            refers: None,
            initial: 0,
        }
    }

    pub const fn short(mut self, short: &'static str) -> Self {
        self.short = short;
        self
    }

    pub const fn role(mut self, role: Role) -> Self {
        self.role = role;
        self
    }

    pub const fn format(mut self, format: Format) -> Self {
        self.format = format;
        self
    }

    pub const fn limits(mut self, from: u64, to: u64) -> Self {
        self.limits = Some((from, to));
        self
    }

    pub const fn rule(mut self, rule: fn(u64) -> Option<&'static str>) -> Self {
        self.rule = Some(rule);
        self
    }

    pub const fn names(mut self, names: &'static [Name]) -> Self {
        self.names = names;
        self
    }

    pub const fn ranges(mut self, ranges: &'static [Range]) -> Self {
        self.ranges = ranges;
        self
    }

    pub const fn only_named(mut self) -> Self {
        self.only_named = true;
        self
    }

    pub const fn flagged(mut self, set: &'static str, none: &'static str) -> Self {
        self.flagged = Some((set, none));
        self
    }

    pub const fn told(mut self, told: fn(&str) -> Option<Message>) -> Self {
        self.told = Some(told);
        self
    }

    pub const fn refers(mut self, refers: fn(u64) -> Option<u16>) -> Self {
        self.refers = Some(refers);
        self
    }

    pub const fn initial(mut self, initial: u64) -> Self {
        self.initial = initial;
        self
    }

    pub const fn note(mut self, note: &'static str) -> Self {
        self.note = note;
        self
    }

    pub const fn source(mut self, source: &'static str) -> Self {
        self.source = source;
        self
    }

    pub const fn hex_numbers(mut self) -> Self {
        self.hex_numbers = true;
        self
    }

    /// A number whose bits each say something; it is shown in hex.
    pub const fn bits(mut self, bits: &'static [Bits]) -> Self {
        self.bits = bits;
        self.format = Format::Hex;
        self
    }

    pub const fn unit(mut self, unit: &'static str) -> Self {
        self.unit = unit;
        self
    }

    pub const fn order(mut self, order: Order) -> Self {
        self.order = order;
        self
    }

    pub const fn step(mut self, step: u64) -> Self {
        self.step = step;
        self
    }

    /// The same with other words for it.
    pub const fn label(mut self, label: &'static str) -> Self {
        self.label = label;
        self.short = label;
        self
    }

    /// The label of a list's item: "Register 215", or "Register +2" where the first one's number
    /// is not known; "Coils 16 to 23" where an item stands for several.
    pub fn numbered(&self, number: Option<Numbering>) -> Message {
        let label = Argument::Term(self.label);
        match number {
            None => Message::term(self.label),
            Some(Numbering::At(n)) if self.step > 1 => {
                message!("{label} {from} to {to}", label = label, from = n, to = n + self.step - 1)
            }
            Some(Numbering::Offset(n)) if self.step > 1 => {
                message!("{label} +{from} to +{to}", label = label, from = n, to = n + self.step - 1)
            }
            Some(Numbering::At(n)) if self.hex_numbers => {
                message!("{label} {n}", label = label, n = hex_value(n, 2))
            }
            Some(Numbering::At(n)) => message!("{label} {n}", label = label, n = n),
            Some(Numbering::Offset(n)) => message!("{label} +{n}", label = label, n = n),
        }
    }

    /// What `value` is called, if it has a name.
    pub fn name(&self, value: u64) -> Option<&'static Name> {
        self.names.iter().find(|name| name.value == value)
    }

    /// What `value` is called by where it lies, if it has no name of its own.
    pub fn range(&self, value: u64) -> Option<&'static Range> {
        self.ranges.iter().find(|range| (range.from..=range.to).contains(&value))
    }

    /// Whether `value` is one that the manual defines, where it defines all.
    pub fn defines(&self, value: u64) -> bool {
        if !self.only_named || self.name(value).is_some() || self.range(value).is_some() {
            return true;
        }
        let known = self.bits.iter().fold(0, |mask, part| part.put(mask, u64::MAX));
        !self.bits.is_empty() && value & !known == 0 && self.bits.iter().all(|part| part.defines(value))
    }

    pub fn allows(&self, value: u64) -> bool {
        self.limits.is_none_or(|(from, to)| (from..=to).contains(&value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn orders_are_what_their_letters_say() {
        for order in Order::ALL {
            let letters = order.name().0;
            assert_eq!(order.bytes(0x4142_4344, 4), letters.as_bytes());
            assert_eq!(order.number(letters.as_bytes()), 0x4142_4344);
            assert_eq!(order.number(&order.bytes(0x0102_0304_0506_0708, 8)), 0x0102_0304_0506_0708);
        }
    }
}
