//! What there is to look up: how telegrams are laid out, what stands in the registers and parameters of each
//! device, and what codes mean.
//!
//! Nothing is written down here: it all comes from the registries and tables that telegrams are read by.

mod codes;
mod registers;
mod telegrams;

use std::sync::Arc;

pub use codes::Code;
pub use registers::{Held, Register};
pub use telegrams::{Layout, Topic};

use super::link::Link;
use super::search::{Number, fold};
use super::{Editor, Options, PROFILES, Profile, Protocol, Settings};
use crate::field::{Direction, hex, in_order};

/// What something to look up is of.
#[derive(Clone, Copy, Debug)]
pub enum Book {
    Modbus,
    Profibus,
    Device(&'static Profile),
}

impl Book {
    pub fn all() -> Vec<Self> {
        let devices = PROFILES.iter().copied().map(Self::Device);
        [Self::Modbus, Self::Profibus].into_iter().chain(devices).collect()
    }

    /// Stable word of links.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Modbus => "modbus",
            Self::Profibus => "profibus",
            Self::Device(profile) => profile.key,
        }
    }

    pub const fn label(self) -> &'static str {
        match self {
            Self::Modbus => "Modbus",
            Self::Profibus => "PROFIBUS-DP",
            Self::Device(profile) => profile.label,
        }
    }

    /// Its label without the maker, for narrow places.
    pub fn short(self) -> &'static str {
        let label = self.label();
        let makers = ["KEB COMBIVERT ", "Endress+Hauser "];
        makers.iter().find_map(|maker| label.strip_prefix(maker)).unwrap_or(label)
    }

    pub fn of(key: &str) -> Option<Self> {
        Self::all().into_iter().find(|book| book.key() == key)
    }

    /// The chapters that it has.
    pub const fn chapters(self) -> [Chapter; 2] {
        match self {
            Self::Modbus | Self::Profibus => [Chapter::Telegrams, Chapter::Codes],
            Self::Device(_) => [Chapter::Registers, Chapter::Codes],
        }
    }
}

impl PartialEq for Book {
    fn eq(&self, other: &Self) -> bool {
        self.key() == other.key()
    }
}

/// A part of a book.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Chapter {
    Telegrams,
    /// Registers, or parameters by index.
    Registers,
    Codes,
}

impl Chapter {
    /// Stable word of links.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Telegrams => "telegrams",
            Self::Registers => "registers",
            Self::Codes => "codes",
        }
    }

    /// What it is called in `book`.
    pub const fn label(self, book: Book) -> &'static str {
        match (self, book) {
            (Self::Telegrams, _) => "Telegrams",
            (Self::Registers, Book::Device(Profile { ident: Some(_), .. })) => "Parameters",
            (Self::Registers, Book::Device(Profile { hex_addresses: true, .. })) => {
                "Registers and parameters"
            }
            (Self::Registers, _) => "Registers",
            (Self::Codes, _) => "Codes",
        }
    }

    pub fn of(key: &str) -> Option<Self> {
        [Self::Telegrams, Self::Registers, Self::Codes].into_iter().find(|chapter| chapter.key() == key)
    }
}

/// Something to look up.
#[derive(Clone, Debug)]
pub struct Item {
    pub book: Book,
    pub chapter: Chapter,
    /// Stable word of links, in its chapter; without points.
    pub key: String,
    /// Its number as the manual writes it: `215 to 217`, `2034h`, `16`, `8-0-0030h`.
    pub number: String,
    pub label: String,
    pub about: About,
    /// The numbers that it is found by, first and last.
    numbers: Vec<(u64, u64)>,
    /// Words that it is found by besides its label, the better ones first: names, then what is said of it.
    names: String,
    notes: String,
    /// Label, names and notes as [`fold`] writes them: what is in none of them is not looked for any closer.
    folded: String,
}

/// What it is.
#[derive(Clone, Debug)]
pub enum About {
    Telegram(Topic),
    Register(Register),
    Code(Code),
}

/// What a draft does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Doing {
    Read,
    Write,
    /// Such a telegram is built.
    Build,
}

impl Doing {
    pub const fn label(self) -> &'static str {
        match self {
            Self::Read => "Read",
            Self::Write => "Write",
            Self::Build => "Build",
        }
    }
}

impl Item {
    /// What can be built of it, as links for Build.
    pub fn drafts(&self) -> Vec<(Doing, Link)> {
        match &self.about {
            About::Telegram(topic) => topic.draft().map(|link| (Doing::Build, link)).into_iter().collect(),
            About::Register(register) => register.drafts(),
            About::Code(code) => code.draft().into_iter().collect(),
        }
    }

    /// How much `word` says for it; 0 where it does not fit.
    fn fits(&self, word: &Word) -> i32 {
        let hex = match self.book {
            Book::Device(profile) => profile.hex_addresses,
            _ => false,
        };
        // A display's text may stand for several.
        if let (About::Code(code), Book::Device(profile)) = (&self.about, self.book)
            && code.is_shown()
            && profile.shown(&word.text).is_some_and(|shown| shown.text == self.number)
        {
            return 120;
        }
        let register = matches!(self.about, About::Register(_));
        let numbered = word.numbers(hex, register).filter_map(|number| self.holds(number)).max();
        numbered.into_iter().chain([self.named(word)]).max().unwrap_or_default()
    }

    /// How much a number says.
    fn holds(&self, number: u64) -> Option<i32> {
        let inside = |(from, to): &&(u64, u64)| (*from..=*to).contains(&number);
        let (from, to) = self.numbers.iter().filter(inside).min_by_key(|(from, to)| to - from)?;
        Some(match to - from {
            0 => EXACT,
            // A block of registers; then ranges of anything.
            1..100 => EXACT - if number == *from { 10 } else { 20 },
            _ => BROAD,
        })
    }

    fn named(&self, word: &Word) -> i32 {
        let plain = word.plain.as_str();
        if plain.is_empty() || !self.folded.contains(plain) {
            return 0;
        }
        let scored = |text: &str, whole: i32, word: i32, begins: i32, inside: i32| {
            if fold(text) == plain {
                return whole;
            }
            let mut best = 0;
            for own in text.split([' ', '_', ',', '-', '/', '(', ')', ':']) {
                let own = fold(own);
                let score = match own {
                    _ if own == plain => word,
                    // The beginning of a number is no number.
                    _ if plain.bytes().all(|it| it.is_ascii_digit()) => 0,
                    _ if own.starts_with(plain) => begins,
                    _ if plain.len() > 2 && own.contains(plain) => inside,
                    _ => 0,
                };
                best = score.max(best);
            }
            best
        };
        let label = scored(&self.label, 110, 50, 30, 12);
        let names = self.names.split('\n').map(|name| scored(name, 120, 40, 20, 8)).max().unwrap_or_default();
        let joined = if plain.len() > 3 && fold(&self.label).contains(plain) { 10 } else { 0 };
        let notes = scored(&self.notes, 6, 5, 3, 0);
        label.max(names).max(joined).max(notes)
    }

    /// How much all words together say: the whole name, or what kind of thing it is.
    fn meant(&self, words: &[Word]) -> i32 {
        let whole: String = words.iter().map(|word| word.plain.as_str()).collect();
        let kind = |kinds: &[&str]| words.iter().any(|word| kinds.contains(&word.plain.as_str()));
        let of_kind = match self.about {
            About::Telegram(_) => kind(&["function", "fc", "sap", "service", "telegram"]),
            About::Register(_) => kind(&["register", "registers", "address", "parameter", "index"]),
            About::Code(_) => kind(&["exception", "error", "code", "status"]),
        };
        i32::from(fold(&self.label) == whole) * 60 + i32::from(of_kind) * 30
    }

    /// Of a range of anything, what stands at the one address that was typed.
    fn at(self: &Arc<Self>, words: &[Word]) -> Arc<Self> {
        let About::Register(register) = &self.about else { return self.clone() };
        if !register.is_range() {
            return self.clone();
        }
        let hex = register.profile.hex_addresses;
        let numbers = words.iter().flat_map(|word| word.numbers(hex, true).collect::<Vec<_>>());
        let mut inside = numbers.filter(|number| self.holds(*number).is_some());
        match inside.next().and_then(|number| register.at(u16::try_from(number).ok()?)) {
            Some(item) => Arc::new(item),
            None => self.clone(),
        }
    }
}

/// A number that is said exactly, and one in a range of thousands.
const EXACT: i32 = 100;
const BROAD: i32 = 15;

/// Everything that can be looked up, book by book.
pub fn items() -> Vec<Arc<Item>> {
    let mut items = Vec::new();
    for book in Book::all() {
        match book {
            Book::Modbus | Book::Profibus => items.extend(telegrams::items(book)),
            Book::Device(profile) => items.extend(registers::items(profile)),
        }
        items.extend(codes::items(book));
    }
    for item in &mut items {
        item.folded = [&item.label, &item.names, &item.notes].map(|text| fold(text)).join(" ");
    }
    items.into_iter().map(Arc::new).collect()
}

/// Which of `items` somebody means who types `text`, best first; all in their order where nothing is typed.
///
/// Every word has to fit: a part of a name, or a number in any notation. Words that only say what kind of number
/// follows count where they fit.
///
/// ```
/// use buslens::tool::reference::{find, items};
///
/// let items = items();
/// for typed in ["Sy.52", "set speed", "2034h", "0x2034", "modbus register 2034"] {
///     assert_eq!(find(&items, typed)[0].number, "2034h", "{typed}");
/// }
/// assert_eq!(find(&items, "40216")[0].label, "Universal channel 6");
/// assert_eq!(find(&items, "exception 66")[0].label, "parameter is write-protected");
/// ```
pub fn find(items: &[Arc<Item>], text: &str) -> Vec<Arc<Item>> {
    let words: Vec<Word> = text.split_whitespace().map(Word::of).collect();
    if words.is_empty() {
        return items.to_vec();
    }
    let mut found: Vec<(i32, Arc<Item>)> = Vec::new();
    'items: for item in items {
        let mut score = 0;
        for word in &words {
            score += match item.fits(word) {
                0 if word.is_kind => 0,
                0 => continue 'items,
                fit => fit,
            };
        }
        if score > 0 {
            found.push((score + item.meant(&words), item.at(&words)));
        }
    }
    in_order(found, |(score, _)| std::cmp::Reverse(*score)).into_iter().map(|(_, item)| item).collect()
}

/// A word that was typed.
struct Word {
    plain: String,
    /// It says what kind of number is meant, and may be in no name.
    is_kind: bool,
    number: Option<Number>,
    text: String,
}

impl Word {
    fn of(text: &str) -> Self {
        const KINDS: &[&str] = &[
            "function",
            "fc",
            "sap",
            "register",
            "registers",
            "address",
            "index",
            "parameter",
            "code",
            "error",
            "exception",
            "modbus",
            "profibus",
            "channel",
            "status",
        ];
        let text = text.trim_matches([',', ';', ':', '?', '"', '“', '”']).to_owned();
        let plain = fold(&text);
        let is_kind = KINDS.contains(&plain.as_str()) || plain.is_empty();
        Self { number: Number::of(&text), is_kind, plain, text }
    }

    /// The numbers that it may mean: as written; in hex without saying so, where the manual counts in hex; and as
    /// the reference of a register.
    fn numbers(&self, hex: bool, register: bool) -> impl Iterator<Item = u64> {
        let whole = self.number.and_then(|number| number.whole);
        let bare = hex && (2..=4).contains(&self.text.len());
        let bare = if bare { u64::from_str_radix(&self.text, 16).ok() } else { None };
        let is_reference = register && matches!(self.text.len(), 5 | 6) && self.text.starts_with('4');
        let base = if self.text.len() == 6 { 400_001 } else { 40_001 };
        let reference = whole.filter(|_| is_reference).and_then(|number| number.checked_sub(base));
        whole.into_iter().chain(bare.filter(|bare| Some(*bare) != whole)).chain(reference)
    }
}

/// A word for links: small letters and digits, the rest as lines.
fn key_of(text: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' };
    let key: String = text.chars().map(plain).collect();
    key.split('-').filter(|part| !part.is_empty()).collect::<Vec<_>>().join("-")
}

/// A link to bytes, read as what they are.
fn link_to(bytes: &[u8], protocol: &'static Protocol, direction: Direction) -> Link {
    let options = Options { protocol: Some(protocol), direction: Some(direction), ..Options::default() };
    Link::to(hex(bytes), options)
}

/// A link to what is edited.
fn link_of(mut editor: Editor) -> Link {
    editor.link(&Settings::default())
}
