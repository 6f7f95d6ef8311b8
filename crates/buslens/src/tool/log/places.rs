//! Where the bytes of telegrams stand in the text of a log: its lines are read again.

use super::{Bytes, Entry, Log, Source, Way};
use crate::field::Span;
use crate::frame::modbus_ascii;
use crate::text::{self, Event, Piece, Reader, Remark};

/// Finds the places of telegrams one after the other. Where many are in a line, that is read once.
pub(super) struct Places<'a> {
    log: &'a Log,
    source: &'a dyn Source,
    pub bytes: Bytes<'a>,
    /// What was read last.
    part: Option<Part>,
}

/// Lines from the beginning of one on, with their pieces.
struct Part {
    offset: u64,
    text: Vec<u8>,
    pieces: Vec<Kept>,
    /// The piece that the last telegram began in: the next one begins there, if bytes of others come
    /// before it in its piece, or behind it.
    last: Option<usize>,
}

/// A piece of a line.
struct Kept {
    bytes: Vec<u8>,
    decimal: Option<Vec<u8>>,
    /// In the whole text.
    places: Vec<Span>,
    /// Where its line begins.
    base: usize,
    slips: bool,
}

impl Kept {
    fn of(piece: &Piece<'_>) -> Self {
        let base = piece.offset as usize;
        Self {
            bytes: piece.bytes.to_vec(),
            decimal: piece.decimal.map(<[u8]>::to_vec),
            places: piece.places.iter().map(|place| place.shifted(base)).collect(),
            base,
            slips: piece.facts.slips,
        }
    }
}

impl Kept {
    /// Whether all of a telegram stands in it, behind so many other bytes.
    fn holds(&self, telegram: &[u8], skip: usize) -> bool {
        let readings = [Some(&self.bytes), self.decimal.as_ref()];
        readings
            .into_iter()
            .flatten()
            .any(|reading| reading.get(skip..skip + telegram.len()) == Some(telegram))
    }
}

impl<'a> Places<'a> {
    pub fn new(log: &'a Log, source: &'a dyn Source) -> Self {
        Self { log, source, bytes: Bytes::new(log, source), part: None }
    }

    /// The places of a telegram's bytes, and what in a line of bytes is none.
    pub fn of(&mut self, entry: &Entry) -> (Vec<Span>, Vec<Remark>) {
        /// A line of a telegram has hardly more.
        const PART: usize = 4096;
        const MOST: usize = 1 << 18;
        let bytes = &*self.bytes.of(entry).to_vec();
        // Mostly its line was read with those before it.
        if let Some(part) = self.part.as_mut().filter(|part| part.covers(entry)) {
            let found = part.search(entry, bytes);
            if found.places.len() >= bytes.len() {
                return part.take(found);
            }
        }
        let mut wanted = PART;
        loop {
            self.part = self.read(entry, wanted);
            let Some(part) = &mut self.part else { return (Vec::new(), Vec::new()) };
            let found = part.search(entry, bytes);
            if found.places.len() >= bytes.len() || part.text.len() < wanted || wanted >= MOST {
                return part.take(found);
            }
            wanted *= 4;
        }
    }

    /// Reads the lines from that of `entry` on; `None` where the log has none.
    fn read(&self, entry: &Entry, wanted: usize) -> Option<Part> {
        let (Way::Text(_) | Way::Utf16 { .. }) = self.log.input else { return None };
        let offset = entry.offset;
        let text = self.log.read_again(self.source, offset, wanted);
        let mut pieces = Vec::new();
        let mut reader = Reader::starting_at(self.log.form.clone(), offset, entry.line);
        let mut take = |event: Event<'_>| {
            if let Event::Piece(piece) = event {
                pieces.push(Kept::of(&piece));
            }
        };
        reader.push(&text, &mut take);
        reader.finish(&mut take);
        Some(Part { offset, text, pieces, last: None })
    }
}

impl Part {
    /// Whether the line of `entry` is among those that were read.
    fn covers(&self, entry: &Entry) -> bool {
        (self.offset..self.offset + self.text.len() as u64).contains(&entry.offset)
    }

    /// The places of the bytes of `entry`, as far as they are there.
    fn search<'a>(&self, entry: &Entry, bytes: &'a [u8]) -> Search<'a> {
        let (skip, base) = (usize::from(entry.skip), entry.offset as usize);
        let line = self.pieces.partition_point(|piece| piece.base < base);
        // Telegrams come in order mostly.
        let behind = self.last.map(|last| last + usize::from(skip == 0)).filter(|behind| *behind >= line);
        // Mostly one piece has all of it.
        let own = self.pieces[line..].iter().take_while(|piece| piece.base == base);
        let whole = own.into_iter().position(|piece| piece.holds(bytes, skip)).map(|at| line + at);
        let mut found = Search::default();
        for start in behind.into_iter().chain(whole).chain([line]) {
            let mut search = Search { bytes, skip, ..Search::default() };
            for (at, piece) in self.pieces.iter().enumerate().skip(start) {
                search.take(at, piece);
                if search.places.len() >= bytes.len() {
                    return search;
                }
            }
            if search.places.len() >= found.places.len() {
                found = search;
            }
        }
        found
    }

    /// What was found is the telegram's.
    fn take(&mut self, found: Search<'_>) -> (Vec<Span>, Vec<Remark>) {
        self.last = Some(found.first);
        let remarks = found.slips.map_or(Vec::new(), |at| self.remarks(at, &found.places));
        (self.characters(found.places), remarks)
    }

    /// What in the line of piece `at` is no byte, near the `telegram` that stands at these places.
    fn remarks(&self, at: usize, telegram: &[Span]) -> Vec<Remark> {
        /// What is further away is of other telegrams, and nobody reads more.
        const NEAR: usize = 64;
        const MOST: usize = 20;
        let Kept { base, places, .. } = &self.pieces[at];
        let line = self.text.get(base - self.offset as usize..).unwrap_or_default();
        let end = line.iter().position(|c| matches!(c, b'\n' | b'\r')).unwrap_or(line.len());
        let (first, last) = match telegram {
            [first, .., last] => (first.from, last.to),
            [only] => (only.from, only.to),
            [] => (*base, *base + end),
        };
        // Where a word begins, and where one ends.
        let inside = |at: &usize| line.get(*at).is_some_and(|c| c.is_ascii_alphanumeric() || *c >= 0x80);
        let from = first.saturating_sub(*base + NEAR).min(end);
        let from = if from == 0 { 0 } else { (from..end).find(|at| !inside(at)).unwrap_or(end) };
        let to = (last.saturating_sub(*base) + NEAR).clamp(from, end);
        let to = (to..end).find(|at| !inside(at)).unwrap_or(end);
        let near = places.partition_point(|place| place.to < base + from);
        let mut remarks =
            text::remarks(&String::from_utf8_lossy(&line[from..to]), base + from, &places[near..]);
        remarks.truncate(MOST);
        remarks
    }

    /// Places of whole characters: a letter that stands for a byte can have several in UTF-8.
    fn characters(&self, mut places: Vec<Span>) -> Vec<Span> {
        let offset = self.offset as usize;
        let inside = |at: usize| {
            let at = at.checked_sub(offset).and_then(|at| self.text.get(at));
            at.is_some_and(|byte| (0x80..0xC0).contains(byte))
        };
        for place in &mut places {
            while place.from > offset && inside(place.from) {
                place.from -= 1;
            }
            while inside(place.to) {
                place.to += 1;
            }
        }
        places
    }
}

/// The places of a telegram's bytes, put together from the pieces that they came in.
#[derive(Default)]
struct Search<'a> {
    bytes: &'a [u8],
    /// How many bytes of its first piece come before it.
    skip: usize,
    places: Vec<Span>,
    /// The piece that it begins in.
    first: usize,
    /// How many bytes come before those of each piece that was taken.
    starts: Vec<usize>,
    /// A piece of it whose line has slips.
    slips: Option<usize>,
}

impl Search<'_> {
    /// Takes piece `at`, if it is the next one of the telegram.
    fn take(&mut self, at: usize, piece: &Kept) {
        let found = self.places.len();
        if found >= self.bytes.len() {
            return;
        }
        if self.go_on(at, piece, found) {
            self.starts.push(found);
        } else if found > 0 {
            /// Small numbers that look like its next bytes do not come by the dozen.
            const BACK: usize = 4;
            let starts: Vec<usize> = self.starts.iter().rev().copied().take(BACK).chain([0]).collect();
            for start in starts {
                if self.take_instead(at, piece, start) {
                    break;
                }
            }
        }
    }

    /// Takes the piece in place of what was found from `start` on, which may only have looked like the
    /// telegram's next part, or its beginning: whether that gives more of it.
    fn take_instead(&mut self, at: usize, piece: &Kept, start: usize) -> bool {
        let (first, slips, before) = (self.first, self.slips, self.places.split_off(start));
        let least = start + before.len() + usize::from(start > 0);
        if self.go_on(at, piece, start) && self.places.len() >= least {
            self.starts.retain(|other| *other < start);
            self.starts.push(start);
            return true;
        }
        (self.first, self.slips) = (first, slips);
        self.places.truncate(start);
        self.places.extend(before);
        false
    }

    /// Takes the piece for what comes behind the first `found` bytes, if it is that.
    fn go_on(&mut self, at: usize, piece: &Kept, found: usize) -> bool {
        let wanted = &self.bytes[found..];
        // A telegram does not go on before it began.
        let (last, first) = (self.places.last(), piece.places.first());
        if found > 0 && last.zip(first).is_some_and(|(last, first)| first.from < last.from) {
            return false;
        }
        for reading in [Some(&piece.bytes), piece.decimal.as_ref()].into_iter().flatten() {
            let skip = if found == 0 { self.skip.min(reading.len()) } else { 0 };
            let length = wanted.len().min(reading.len() - skip);
            if length > 0 && wanted[..length] == reading[skip..skip + length] {
                self.places.extend(&piece.places[skip..skip + length]);
            } else if let Some(decoded) = modbus_ascii::from_characters(reading)
                .or_else(|| modbus_ascii::from_hex_text(reading))
                .filter(|decoded| wanted.starts_with(decoded))
            {
                // Two characters are one byte.
                let colon = usize::from(reading.first() == Some(&b':'));
                let pairs = piece.places.get(colon..).unwrap_or_default().chunks(2).take(decoded.len());
                self.places.extend(pairs.map(|pair| Span::new(pair[0].from, pair[pair.len() - 1].to)));
                self.skip = 0;
            } else {
                continue;
            }
            if found == 0 {
                self.first = at;
            }
            if piece.slips {
                self.slips = Some(at);
            }
            return true;
        }
        false
    }
}
