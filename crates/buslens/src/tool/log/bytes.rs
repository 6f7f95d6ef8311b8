//! The bytes of telegrams: kept, or read again from the file.

use std::borrow::Cow;

use super::{Entry, Log, Source};
use crate::text;

/// Reads the bytes of telegrams one after the other. What is read of the file is read in large parts.
pub struct Bytes<'a> {
    log: &'a Log,
    source: &'a dyn Source,
    /// What was read last of the file, and from where on.
    part: Vec<u8>,
    from: u64,
    /// The bytes of the last telegram.
    telegram: Vec<u8>,
}

impl<'a> Bytes<'a> {
    pub fn new(log: &'a Log, source: &'a dyn Source) -> Self {
        Self { log, source, part: Vec::new(), from: 0, telegram: Vec::new() }
    }

    /// The bytes of an entry; fewer, if the file does not have them any more.
    pub fn of(&mut self, entry: &Entry) -> &[u8] {
        /// So much is read at a time where many telegrams are looked at.
        const PART: usize = 1 << 16;
        /// A request is not far before its response.
        const BEFORE: u64 = 1 << 12;
        if let Some(kept) = self.log.traffic.entries().kept(entry) {
            return kept;
        }
        let (from, step, length) = place(entry);
        let covered =
            from.checked_sub(self.from).is_some_and(|at| at + length as u64 <= self.part.len() as u64);
        if !covered {
            // Who looks at one telegram needs no more.
            let first = self.part.is_empty();
            self.from = if first { from } else { from.saturating_sub(BEFORE) };
            let wanted = (from - self.from) as usize + length;
            self.part =
                self.log.read_again(self.source, self.from, if first { wanted } else { wanted.max(PART) });
        }
        let at = ((from - self.from) as usize).min(self.part.len());
        let written = &self.part[at..self.part.len().min(at + length)];
        if step == 1 {
            return written;
        }
        self.telegram.clear();
        self.telegram.extend((0..written.len()).step_by(step).map_while(|at| text::pair(written, at)));
        &self.telegram
    }
}

/// Where an entry stands in the file: from where on, how far one byte is behind the other, and how long.
fn place(entry: &Entry) -> (u64, usize, usize) {
    let Some(written) = entry.written() else { return (0, 1, 0) };
    let (step, digits) = (usize::from(written.step), if written.step == 1 { 1 } else { 2 });
    let length = usize::from(entry.length).saturating_sub(1) * step + digits;
    (entry.offset + u64::from(written.from), step, length)
}

impl Log {
    /// The bytes of an entry; fewer, if the file does not have them any more.
    pub fn bytes(&self, source: &dyn Source, entry: &Entry) -> Cow<'_, [u8]> {
        match self.traffic.entries().kept(entry) {
            Some(kept) => kept.into(),
            None => Bytes::new(self, source).of(entry).to_vec().into(),
        }
    }

    /// Up to `length` bytes from `from` on, as they were read: of a file in UTF-16 what it would be in UTF-8.
    pub(super) fn read_again(&self, source: &dyn Source, from: u64, length: usize) -> Vec<u8> {
        match &self.transcoded {
            Some(text) => (&text.as_slice()).read(from, length),
            None => source.read(from, length),
        }
    }
}
