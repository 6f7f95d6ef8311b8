/// Where a telegram's bytes are not what its value implies, by the path of the field.
///
/// A value holds no byte count and no check: those follow from it. A faulty telegram is its value
/// with deviations, so that it can be read, edited and written again byte for byte, and so that a
/// faulty telegram can be built on purpose.
///
/// There are a few at most, so they are simply listed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Deviations(Vec<(String, Deviation)>);

#[derive(Clone, Debug, PartialEq)]
pub enum Deviation {
    /// A computed number (a count, a length, a check as on the wire) has another value.
    Value(u64),
    /// A window, or the whole telegram, holds more bytes after its last field.
    Extra(Vec<u8>),
    /// A window, or the whole telegram, ends after so many bytes.
    Cut(usize),
}

impl Deviations {
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Adds a deviation. A path has one at most: walks meet each field once.
    pub fn set(&mut self, path: String, deviation: Deviation) {
        self.0.push((path, deviation));
    }

    pub fn get(&self, path: &str) -> Option<&Deviation> {
        self.0.iter().find(|(other, _)| other == path).map(|(_, deviation)| deviation)
    }

    /// The value that a computed field is to have instead of the computed one.
    pub fn value(&self, path: &str) -> Option<u64> {
        match self.get(path) {
            Some(Deviation::Value(value)) => Some(*value),
            _ => None,
        }
    }

    pub fn retain(&mut self, mut keep: impl FnMut(&str, &Deviation) -> bool) {
        self.0.retain(|(path, deviation)| keep(path, deviation));
    }
}
