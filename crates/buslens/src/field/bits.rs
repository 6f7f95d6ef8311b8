use super::{Format, Name, Range};

/// Some bits of a number that say something of their own.
///
/// ```
/// use buslens::field::Bits;
///
/// static STATUS: &[Bits] = &[Bits::flag(0, "ready", "ready"), Bits::part(1, 2, "mode", "mode"), Bits::reserved(3, 5)];
/// assert_eq!(STATUS[1].of(0b110), 3);
/// ```
#[derive(Debug, PartialEq)]
pub struct Bits {
    /// Stable snake_case word of exports, vectors and links.
    pub key: &'static str,
    pub label: &'static str,
    /// The lowest bit, counted from 0.
    pub from: u32,
    pub count: u32,
    /// How a part that is a number is shown.
    pub format: Format,
    /// What single values are called.
    pub names: &'static [Name],
    /// What values without a name of their own are called, by where they lie.
    pub ranges: &'static [Range],
    /// One or two sentences for a person who meets them for the first time.
    pub note: &'static str,
    /// Must be 0.
    pub reserved: bool,
}

impl Bits {
    /// One bit: said by its label when it is set.
    pub const fn flag(bit: u32, key: &'static str, label: &'static str) -> Self {
        Self::part(bit, 1, key, label)
    }

    /// `count` bits from bit `from` that are a number, or have named values.
    pub const fn part(from: u32, count: u32, key: &'static str, label: &'static str) -> Self {
        Self {
            key: super::spec::kept_key(key),
            label,
            from,
            count,
            format: Format::Decimal,
            names: &[],
            ranges: &[],
            note: "",
            reserved: false,
        }
    }

    /// Bits that must be 0.
    pub const fn reserved(from: u32, count: u32) -> Self {
        Self { reserved: true, ..Self::part(from, count, "reserved", "reserved") }
    }

    pub const fn format(mut self, format: Format) -> Self {
        self.format = format;
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

    pub const fn note(mut self, note: &'static str) -> Self {
        self.note = note;
        self
    }

    /// The value of these bits in `number`.
    pub const fn of(&self, number: u64) -> u64 {
        (number >> self.from) & self.mask()
    }

    /// `number` with these bits set to `value`.
    pub const fn put(&self, number: u64, value: u64) -> u64 {
        (number & !(self.mask() << self.from)) | ((value & self.mask()) << self.from)
    }

    const fn mask(&self) -> u64 {
        u64::MAX >> (64 - self.count)
    }

    /// What `value` of these bits is called, if it has a name.
    pub fn name(&self, value: u64) -> Option<&'static Name> {
        self.names.iter().find(|name| name.value == value)
    }

    /// What `value` of these bits is called by where it lies, if it has no name of its own.
    pub fn range(&self, value: u64) -> Option<&'static Range> {
        self.ranges.iter().find(|range| (range.from..=range.to).contains(&value))
    }

    /// Whether these bits of `number` have a value that has words.
    pub(super) fn defines(&self, number: u64) -> bool {
        let value = self.of(number);
        self.names.is_empty() || self.name(value).is_some() || self.range(value).is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_taken_and_put() {
        let part = Bits::part(4, 2, "length", "length");
        assert_eq!(part.of(0x71), 3);
        assert_eq!(part.put(0x71, 1), 0x51);
        assert_eq!(Bits::part(0, 64, "all", "all").put(0, u64::MAX), u64::MAX);
    }
}
