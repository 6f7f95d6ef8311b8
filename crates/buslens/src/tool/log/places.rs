//! Where the bytes of telegrams stand in the text of a log: its lines are read again.

use super::{Entry, Log, Source, Way};
use crate::field::Span;
use crate::frame::modbus_ascii;
use crate::text::{self, Event, Piece, Reader, Remark};

/// Finds the places of telegrams one after the other. Where many are in a line, that is read once.
pub(super) struct Places<'a> {
    log: &'a Log,
    source: &'a dyn Source,
    /// What was read last.
    part: Option<Part>,
}

/// Lines from the beginning of one on, with their pieces.
struct Part {
    offset: u32,
    /// How much was to be read.
    wanted: usize,
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
        Self { log, source, part: None }
    }

    /// The places of a telegram's bytes, and what in a line of bytes is none.
    pub fn of(&mut self, entry: &Entry) -> (Vec<Span>, Vec<Remark>) {
        /// A line of a telegram has hardly more.
        const PART: usize = 4096;
        const MOST: usize = 1 << 18;
        let bytes = self.log.bytes(entry);
        let same = |part: &Part| part.offset == entry.offset;
        let mut wanted = self.part.as_ref().filter(|part| same(part)).map_or(PART, |part| part.wanted);
        loop {
            if !self.part.as_ref().is_some_and(|part| same(part) && part.wanted == wanted) {
                self.part = self.read(entry, wanted);
            }
            let Some(part) = &mut self.part else { return (Vec::new(), Vec::new()) };
            let skip = usize::from(entry.skip);
            // Telegrams come in order mostly.
            let behind = part.last.map(|last| last + usize::from(skip == 0));
            let mut found = Search::default();
            // Mostly one piece has all of it.
            let whole = part.pieces.iter().position(|piece| piece.holds(bytes, skip));
            for start in behind.into_iter().chain(whole).chain([0]) {
                let mut search = Search { bytes, skip, ..Search::default() };
                (start..part.pieces.len()).for_each(|at| search.take(at, &part.pieces[at]));
                if search.places.len() >= found.places.len() {
                    found = search;
                }
                if found.places.len() >= bytes.len() {
                    break;
                }
            }
            if found.places.len() >= bytes.len() || part.text.len() < wanted || wanted >= MOST {
                part.last = Some(found.first);
                let remarks = found.slips.map_or(Vec::new(), |at| part.remarks(at));
                return (part.characters(found.places), remarks);
            }
            wanted *= 4;
        }
    }

    /// Reads the lines from that of `entry` on; `None` where the log has none.
    fn read(&self, entry: &Entry, wanted: usize) -> Option<Part> {
        let offset = u64::from(entry.offset);
        let text = match (&self.log.transcoded, &self.log.input) {
            (Some(text), _) => (&text.as_slice()).read(offset, wanted),
            (None, Way::Text(_)) => self.source.read(offset, wanted),
            _ => return None,
        };
        let mut pieces = Vec::new();
        let mut reader = Reader::starting_at(self.log.form.clone(), offset, entry.line);
        let mut take = |event: Event<'_>| {
            if let Event::Piece(piece) = event {
                pieces.push(Kept::of(&piece));
            }
        };
        reader.push(&text, &mut take);
        reader.finish(&mut take);
        Some(Part { offset: entry.offset, wanted, text, pieces, last: None })
    }
}

impl Part {
    /// What in the line of piece `at` is no byte.
    fn remarks(&self, at: usize) -> Vec<Remark> {
        let Kept { base, places, .. } = &self.pieces[at];
        let line = self.text.get(base - self.offset as usize..).unwrap_or_default();
        let end = line.iter().position(|c| matches!(c, b'\n' | b'\r')).unwrap_or(line.len());
        text::remarks(&String::from_utf8_lossy(&line[..end]), *base, places)
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
    /// A piece of it whose line has slips.
    slips: Option<usize>,
}

impl Search<'_> {
    /// Takes piece `at`, if it is the next one of the telegram.
    fn take(&mut self, at: usize, piece: &Kept) {
        let found = self.places.len();
        if found >= self.bytes.len() || self.go_on(at, piece, found) || found == 0 {
            return;
        }
        // What came before may only have looked like its beginning.
        let before = std::mem::take(&mut self.places);
        if !self.go_on(at, piece, 0) || self.places.len() < before.len() {
            self.places = before;
        }
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
            } else if let Some(decoded) = of_characters(reading).filter(|decoded| wanted.starts_with(decoded))
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

/// The bytes that characters stand for: of a frame of Modbus ASCII, or hex text.
fn of_characters(characters: &[u8]) -> Option<Vec<u8>> {
    if characters.first() == Some(&b':') {
        return modbus_ascii::from_characters(characters);
    }
    let digit = |c: &u8| char::from(*c).to_digit(16).map(|digit| digit as u8);
    let pairs = characters.trim_ascii().chunks(2).map(|pair| match pair {
        [high, low] => Some(digit(high)? << 4 | digit(low)?),
        _ => None,
    });
    pairs.collect::<Option<Vec<u8>>>().filter(|bytes| bytes.len() >= 4)
}
