use super::{Argument, Message, Numbering, hex_value};
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
#[derive(Debug, PartialEq)]
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
    /// What single values are called.
    pub names: &'static [Name],
    /// One or two sentences for a person who meets the field for the first time.
    pub note: &'static str,
    /// Document and section.
    pub source: &'static str,
    /// The list's items are numbered as the device's manual does: `5F32h`.
    pub hex_numbers: bool,
}

/// A value with a name of its own.
#[derive(Debug, PartialEq)]
pub struct Name {
    pub value: u64,
    pub label: &'static str,
    /// What follows from it, where that helps.
    pub note: &'static str,
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

/// How a number is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    Decimal,
    Hex,
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
            key,
            label,
            short: label,
            role: Role::Data,
            format: Format::Decimal,
            limits: None,
            names: &[],
            note: "",
            source: "",
            hex_numbers: false,
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

    pub const fn names(mut self, names: &'static [Name]) -> Self {
        self.names = names;
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

    /// The label of a list's item: "Register 215", or "Register +2" where the first one's number
    /// is not known.
    pub fn numbered(&self, number: Option<Numbering>) -> Message {
        let label = Argument::Term(self.label);
        match number {
            None => Message::term(self.label),
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

    pub fn allows(&self, value: u64) -> bool {
        self.limits.is_none_or(|(from, to)| (from..=to).contains(&value))
    }
}
