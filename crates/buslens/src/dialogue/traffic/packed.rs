//! Rows of numbers in little room: what a log keeps of its millions of telegrams.
//!
//! Rows that follow each other hardly differ: times and places grow by little, and most of the rest repeats.
//! So each chunk of rows is packed by itself, column by column, and any row can be read again by itself.

use std::fmt;

/// Rows of `N` numbers each.
pub(super) struct Packed<const N: usize> {
    chunks: Vec<Chunk>,
    /// So many chunks before them were handed over.
    gone: usize,
    /// A place for the rows of the chunk that is not full yet, and how many it has.
    open: Vec<[u64; N]>,
    filled: usize,
    desk: Desk,
}

/// So many rows are packed together: as many as the nearest cache of a processor holds.
const CHUNK: usize = 256;

/// What is handed over to whoever joins it, on another thread or in another worker.
pub(super) type Words = Vec<u64>;

/// The next ones of some words.
pub(super) fn take_words<const N: usize>(words: &mut &[u64]) -> Option<[u64; N]> {
    words.split_off(..N)?.try_into().ok()
}

/// The next one of some words, as a number of something.
pub(super) fn take_number(words: &mut &[u64]) -> Option<usize> {
    usize::try_from(*words.split_off_first()?).ok()
}

/// Writes bytes as words.
pub fn write_bytes(words: &mut Words, bytes: &[u8]) {
    words.push(bytes.len() as u64);
    let word = |bytes: &[u8]| bytes.iter().rev().fold(0, |word, byte| word << 8 | u64::from(*byte));
    words.extend(bytes.chunks(8).map(word));
}

/// Takes what [`write_bytes`] wrote; `None` if that is cut.
pub fn take_bytes(words: &mut &[u64]) -> Option<Vec<u8>> {
    let length = take_number(words)?;
    let written = words.split_off(..length.div_ceil(8))?;
    let mut bytes: Vec<u8> = written.iter().flat_map(|word| word.to_le_bytes()).collect();
    bytes.truncate(length);
    Some(bytes)
}

/// A chunk of rows: a [`Head`] of [`HEAD`] words for each column, and the columns behind them.
type Chunk = Box<[u64]>;

/// How many words the head of a column takes.
const HEAD: usize = 2;

/// Where a column is in its chunk, and how it is packed.
#[derive(Clone, Copy)]
struct Head {
    /// The bits that all of its numbers have in common, above those that are written, where it has no list.
    base: u64,
    /// How many bits each number has.
    width: u32,
    /// How many different numbers stand in its list. The numbers are places in that, if there is one.
    listed: usize,
    /// The word at which its list begins, with the numbers behind it.
    from: usize,
}

impl<const N: usize> Default for Packed<N> {
    fn default() -> Self {
        Self { chunks: Vec::new(), gone: 0, open: Vec::new(), filled: 0, desk: Desk::default() }
    }
}

impl<const N: usize> Packed<N> {
    pub fn len(&self) -> usize {
        self.packed() + self.filled
    }

    /// How many rows are packed.
    fn packed(&self) -> usize {
        (self.gone + self.chunks.len()) * CHUNK
    }

    /// The chunk of a row, if it is packed and not handed over.
    #[inline]
    fn chunk(&self, index: usize) -> Option<&Chunk> {
        self.chunks.get((index / CHUNK).wrapping_sub(self.gone))
    }

    pub fn push(&mut self, row: [u64; N]) {
        *self.next() = row;
    }

    /// The place for the next row, to be written there: rows that are put together elsewhere are copied.
    #[inline]
    pub fn next(&mut self) -> &mut [u64; N] {
        if self.filled == self.open.len() {
            self.make_room();
        }
        self.filled += 1;
        &mut self.open[self.filled - 1]
    }

    #[cold]
    fn make_room(&mut self) {
        if self.filled == CHUNK {
            self.chunks.push(self.desk.pack(&self.open));
            self.filled = 0;
        } else {
            self.open.resize((2 * self.filled).clamp(8, CHUNK), [0; N]);
        }
    }

    /// The rows that are not packed yet.
    fn open(&self) -> &[[u64; N]] {
        &self.open[..self.filled]
    }

    pub fn get(&self, index: usize) -> Option<[u64; N]> {
        self.numbers(index, std::array::from_fn(|column| column))
    }

    /// The numbers in some columns of a row.
    #[inline]
    pub fn numbers<const M: usize>(&self, index: usize, columns: [usize; M]) -> Option<[u64; M]> {
        if let Some(chunk) = self.chunk(index) {
            return Some(columns.map(|column| Head::of(chunk, column).number(chunk, index % CHUNK)));
        }
        let row = self.open().get(index.checked_sub(self.packed())?)?;
        Some(columns.map(|column| row[column]))
    }

    /// Puts another row in place of the one at `index`, if there is one. That packs its chunk anew.
    pub fn set(&mut self, index: usize, row: [u64; N]) {
        let packed = self.packed();
        if let Some(chunk) = self.chunks.get_mut((index / CHUNK).wrapping_sub(self.gone)) {
            let mut rows = Vec::new();
            unpack(chunk, &mut rows);
            rows[index % CHUNK] = row;
            *chunk = self.desk.pack(&rows);
        } else if let Some(open) =
            index.checked_sub(packed).and_then(|at| self.open[..self.filled].get_mut(at))
        {
            *open = row;
        }
    }

    /// Writes the chunks of rows before `end`, which are gone then, and what is not packed yet if all rows are before it.
    pub fn hand_over(&mut self, end: usize, words: &mut Words) {
        let chunks = (end / CHUNK).saturating_sub(self.gone).min(self.chunks.len());
        words.push(chunks as u64);
        for chunk in self.chunks.drain(..chunks) {
            words.push(chunk.len() as u64);
            words.extend_from_slice(&chunk);
        }
        self.gone += chunks;
        let open = if end >= self.len() { self.open() } else { &[] };
        words.push(open.len() as u64);
        words.extend_from_slice(open.as_flattened());
    }

    /// Takes what another one [handed over](Self::hand_over), behind what came before it; `None` if that is cut.
    pub fn take(&mut self, words: &mut &[u64]) -> Option<()> {
        for _ in 0..take_number(words)? {
            let length = take_number(words)?;
            self.chunks.push(words.split_off(..length)?.into());
        }
        let open = take_number(words)?;
        let (rows, []) = words.split_off(..open * N)?.as_chunks() else { return None };
        self.open = rows.to_vec();
        self.filled = open;
        Some(())
    }

    /// All rows in their order; a chunk is unpacked at a time.
    pub fn iter(&self) -> Rows<'_, N> {
        Rows { packed: self, chunk: Vec::new(), next: 0 }
    }

    /// Those from `index` on.
    pub fn from(&self, index: usize) -> Rows<'_, N> {
        let mut rows = Rows { packed: self, chunk: Vec::new(), next: index / CHUNK * CHUNK };
        rows.by_ref().take(index % CHUNK).for_each(drop);
        rows
    }

    /// How many bytes of memory it takes.
    pub fn memory(&self) -> usize {
        let chunks: usize = self.chunks.iter().map(|chunk| size_of_val(&chunk[..])).sum();
        let open = self.open.capacity() * size_of::<[u64; N]>();
        chunks + self.chunks.capacity() * size_of::<Chunk>() + open
    }
}

impl<const N: usize> fmt::Debug for Packed<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

/// The rows of a [`Packed`].
#[derive(Clone)]
pub(super) struct Rows<'a, const N: usize> {
    packed: &'a Packed<N>,
    /// The rows of the chunk in hand.
    chunk: Vec<[u64; N]>,
    next: usize,
}

impl<const N: usize> Iterator for Rows<'_, N> {
    type Item = [u64; N];

    #[inline]
    fn next(&mut self) -> Option<[u64; N]> {
        let at = self.next % CHUNK;
        if self.next == self.packed.len() {
            return None;
        }
        if at == 0 {
            match self.packed.chunk(self.next) {
                Some(chunk) => unpack(chunk, &mut self.chunk),
                None => {
                    self.chunk.clear();
                    self.chunk.extend_from_slice(self.packed.open());
                }
            }
        }
        let row = *self.chunk.get(at)?;
        self.next += 1;
        Some(row)
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = self.packed.len() - self.next;
        (left, Some(left))
    }
}

impl<const N: usize> ExactSizeIterator for Rows<'_, N> {}

impl Head {
    #[inline]
    fn of(chunk: &[u64], column: usize) -> Self {
        let [base, rest] = [chunk[column * HEAD], chunk[column * HEAD + 1]];
        let [width, listed, from] = [rest & 0xFF, rest >> 8 & 0xFFFF, rest >> 32];
        Self { base, width: width as u32, listed: listed as usize, from: from as usize }
    }

    fn words(self) -> [u64; HEAD] {
        [self.base, u64::from(self.width) + ((self.listed as u64) << 8) + ((self.from as u64) << 32)]
    }

    /// The number in row `row` of its column.
    #[inline]
    fn number(self, chunk: &[u64], row: usize) -> u64 {
        let bits = match self.width {
            0 => 0,
            width => {
                let first = row * width as usize;
                let (word, shift) = (self.from + self.listed + first / 64, first % 64);
                let low = chunk[word] >> shift;
                let high = if shift + width as usize > 64 { chunk[word + 1] << (64 - shift) } else { 0 };
                (low + high) & mask(width)
            }
        };
        if self.listed > 0 { chunk[self.from + bits as usize] } else { self.base + bits }
    }
}

/// The lowest bits, at least one.
fn mask(width: u32) -> u64 {
    u64::MAX >> (u64::BITS - width)
}

/// How many bits it takes to tell numbers up to `most` apart.
fn width(most: u64) -> u32 {
    u64::BITS - most.leading_zeros()
}

/// Where chunks are packed, again and again.
#[derive(Default)]
struct Desk {
    words: Vec<u64>,
    list: List,
}

impl Desk {
    /// Packs rows, of which there is at least one.
    fn pack<const N: usize>(&mut self, rows: &[[u64; N]]) -> Chunk {
        self.words.clear();
        self.words.resize(N * HEAD, 0);
        let first = rows[0];
        let mut varies = [0; N];
        for row in rows {
            varies = std::array::from_fn(|place| varies[place] | (row[place] ^ first[place]));
        }
        for (place, varies) in varies.into_iter().enumerate() {
            let width = width(varies);
            let mut head = Head { base: first[place], width, listed: 0, from: self.words.len() };
            // Most columns are the same all along.
            if width > 0 {
                let column = rows.iter().map(|row| row[place]);
                match self.list.width(column.clone(), width) {
                    Some(width) => {
                        (head.width, head.listed) = (width, self.list.numbers.len());
                        self.words.extend_from_slice(&self.list.numbers);
                        write(&mut self.words, self.list.places.iter().map(|place| u64::from(*place)), width);
                    }
                    None => {
                        head.base &= !mask(width);
                        write(&mut self.words, column.map(|number| number & mask(width)), width);
                    }
                }
            }
            self.words[place * HEAD..][..HEAD].copy_from_slice(&head.words());
        }
        self.words.as_slice().into()
    }
}

/// Writes numbers of so many bits, at least one.
#[inline]
fn write(words: &mut Vec<u64>, numbers: impl Iterator<Item = u64>, width: u32) {
    let (mut word, mut used) = (0, 0);
    for number in numbers {
        word |= number << used;
        used += width;
        if used >= u64::BITS {
            words.push(word);
            used -= u64::BITS;
            // What did not fit any more; a shift by all bits is none.
            word = if used == 0 { 0 } else { number >> (width - used) };
        }
    }
    if used > 0 {
        words.push(word);
    }
}

/// Reads all rows of a chunk.
fn unpack<const N: usize>(chunk: &[u64], rows: &mut Vec<[u64; N]>) {
    let heads: [Head; N] = std::array::from_fn(|column| Head::of(chunk, column));
    rows.clear();
    rows.resize(CHUNK, heads.map(|head| head.base));
    for (column, head) in heads.iter().enumerate().filter(|(_, head)| head.width > 0) {
        let (list, words) = chunk[head.from..].split_at(head.listed);
        let mut words = words.iter();
        let mask = mask(head.width);
        // What is left of the last word, and of how many bits that is.
        let (mut word, mut left) = (0, 0);
        for numbers in rows.iter_mut() {
            let bits;
            if left >= head.width {
                bits = word & mask;
                word >>= head.width;
                left -= head.width;
            } else {
                let next = words.next().copied().unwrap_or_default();
                bits = (word | next << left) & mask;
                // A shift by all bits leaves nothing.
                word = next.checked_shr(head.width - left).unwrap_or_default();
                left += u64::BITS - head.width;
            }
            numbers[column] = if list.is_empty() { head.base + bits } else { list[bits as usize] };
        }
    }
}

/// The different numbers of a column, where they are few.
#[derive(Default)]
struct List {
    numbers: Vec<u64>,
    /// The place in `numbers` of each row's.
    places: Vec<u8>,
    /// By a hash of them, the place behind that of a number; 0 where there is none.
    slots: Vec<u8>,
}

impl List {
    /// Numbers of fewer bits need no list.
    const LEAST: u32 = 14;
    const MOST: usize = 64;
    const SLOTS: usize = 256;

    /// Lists the numbers of a column, if that takes less room than `width` bits for each; returns how many bits
    /// their places have.
    fn width(&mut self, numbers: impl Iterator<Item = u64>, width: u32) -> Option<u32> {
        if width < Self::LEAST || !self.take(numbers) {
            return None;
        }
        let listed = self::width(self.numbers.len() as u64 - 1);
        let saved = (width - listed) as usize * self.places.len();
        (saved > self.numbers.len() * u64::BITS as usize).then_some(listed)
    }

    /// Lists the numbers; `false` if too many differ.
    fn take(&mut self, numbers: impl Iterator<Item = u64>) -> bool {
        self.numbers.clear();
        self.places.clear();
        self.slots.clear();
        self.slots.resize(Self::SLOTS, 0);
        for number in numbers {
            let [slot, ..] = number.wrapping_mul(0x9E37_79B9_7F4A_7C15).to_be_bytes();
            let mut slot = usize::from(slot);
            let place = loop {
                match self.slots[slot].checked_sub(1) {
                    Some(place) if self.numbers[usize::from(place)] == number => break place,
                    Some(_) => slot = (slot + 1) % Self::SLOTS,
                    None if self.numbers.len() == Self::MOST => return false,
                    None => {
                        self.numbers.push(number);
                        self.slots[slot] = self.numbers.len() as u8;
                        break self.slots[slot] - 1;
                    }
                }
            };
            self.places.push(place);
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Columns of all kinds: constant, growing, of few values, of any, at both ends of what a number can be.
    fn row(n: u64) -> [u64; 6] {
        let mixed = n.wrapping_mul(0x9E37_79B9_7F4A_7C15);
        [7, n * 60 + mixed % 9, (mixed >> 60) << 40, mixed, u64::MAX - n % 3, (mixed >> 62).wrapping_neg()]
    }

    #[test]
    fn rows_come_back() {
        for length in [0, 1, CHUNK - 1, CHUNK, CHUNK + 1, 3 * CHUNK + 5] {
            let mut packed = Packed::default();
            (0..length as u64).for_each(|n| packed.push(row(n)));
            assert_eq!(packed.len(), length);
            assert!(packed.iter().eq((0..length as u64).map(row)));
            assert!((0..length).all(|at| packed.get(at) == Some(row(at as u64))));
            assert_eq!(packed.get(length), None);
        }
    }

    #[test]
    fn a_row_is_replaced_by_any_other() {
        let mut packed = Packed::default();
        (0..2 * CHUNK as u64 + 9).for_each(|n| packed.push(row(n)));
        for at in [0, 5, CHUNK - 1, CHUNK, 2 * CHUNK + 3] {
            packed.set(at, [u64::MAX, 0, u64::MAX, at as u64, 1, 2]);
        }
        for (at, found) in packed.iter().enumerate() {
            let replaced = [0, 5, CHUNK - 1, CHUNK, 2 * CHUNK + 3].contains(&at);
            let expected = if replaced { [u64::MAX, 0, u64::MAX, at as u64, 1, 2] } else { row(at as u64) };
            assert_eq!(found, expected, "row {at}");
        }
    }

    #[test]
    fn rows_are_handed_over_while_others_come() {
        for length in [0, 1, CHUNK - 1, CHUNK, 3 * CHUNK + 5, 9 * CHUNK] {
            let (mut packed, mut taken) = (Packed::default(), Packed::default());
            for n in 0..length {
                packed.push(row(n as u64));
                if n % 300 == 299 {
                    let mut words = Words::new();
                    packed.hand_over(n - 200, &mut words);
                    assert_eq!(taken.take(&mut &words[..]), Some(()));
                    assert_eq!(packed.get(n), Some(row(n as u64)), "what is behind them is still there");
                    packed.set(n, row(n as u64 + 1));
                    packed.set(n, row(n as u64));
                }
            }
            let mut words = Words::new();
            packed.hand_over(usize::MAX, &mut words);
            for cut in 0..words.len() {
                assert_eq!(Packed::<6>::default().take(&mut &words[..cut]), None);
            }
            let mut all = &words[..];
            assert_eq!((taken.take(&mut all), all), (Some(()), &[][..]));
            assert_eq!((packed.len(), taken.len()), (length, length));
            assert!(taken.iter().eq((0..length as u64).map(row)));
        }
    }

    #[test]
    fn what_repeats_and_grows_takes_little_room() {
        let mut packed = Packed::default();
        // Eight kinds that lie far apart, a place, a time.
        (0..100_000_u64).for_each(|n| packed.push([((n % 8) << 50) | (n % 3), n * 50, n * 10_000]));
        let each = packed.memory() as f64 / 100_000.0;
        assert!((6.0..7.0).contains(&each), "{each} bytes a row");
        assert!(packed.iter().len() == 100_000);
        // Where nothing changes, a chunk of 256 rows has two words, and two tell where it is.
        let mut packed = Packed::default();
        (0..100_000).for_each(|_| packed.push([7]));
        assert!((12_500..20_000).contains(&packed.memory()), "{} bytes", packed.memory());
    }

    /// So many bits it takes to write a row of one column, whose numbers are among so many that lie far apart.
    fn bits_of(different: u64, width: u32) -> usize {
        let mut packed = Packed::default();
        let number = |n: u64| [(n % different).wrapping_mul(0x9E37_79B9) & mask(width)];
        (0..=CHUNK as u64).for_each(|n| packed.push(number(n)));
        let [chunk] = &packed.chunks[..] else { panic!("{} chunks", packed.chunks.len()) };
        chunk.len() - HEAD
    }

    #[test]
    fn few_numbers_are_listed_where_that_takes_less_room() {
        // A chunk has 256 rows: four words for each bit. A list of numbers has a word for each.
        assert_eq!(bits_of(16, 32), 16 + 4 * 4);
        assert_eq!(bits_of(17, 32), 17 + 5 * 4);
        assert_eq!(bits_of(64, 32), 64 + 6 * 4);
        assert_eq!(bits_of(65, 32), 32 * 4);
        // With 6 of 16 bits it would be four words more.
        assert_eq!(bits_of(44, 16), 16 * 4);
        assert_eq!(bits_of(39, 16), 39 + 6 * 4);
        assert_eq!(bits_of(8, 14), 8 + 3 * 4);
        assert_eq!(bits_of(8, 13), 13 * 4);
    }
}
