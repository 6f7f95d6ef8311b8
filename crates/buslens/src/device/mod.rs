//! What the makers' manuals say about their devices: registers, parameters, value names, limits.
//!
//! A device is a table: [`PROFILES`] lists them. A table says what stands at an address; it knows
//! neither function codes nor frames. Every block of registers and every parameter is described
//! once, and from that description it is read, written, edited and explained.

mod display;
mod draft;
pub mod keb_f5;
mod keb_f5_modbus;
mod keb_f5_profibus;
mod likely;
mod memograph_rsg45;
mod read;

pub use display::Display;
pub use draft::{Asked, Draft, Target, Task};
pub use keb_f5::ProcessWord;
pub use keb_f5_modbus::mapping_entry;
pub use likely::{Likely, likelihood};
pub use read::{Block, Numbers, Process, Registers, Said};

use crate::field::{Spec, hex_value};
use crate::walk::Telegram;

/// All devices.
pub static PROFILES: &[&Profile] =
    &[&keb_f5_modbus::PROFILE, &keb_f5_profibus::PROFILE, &memograph_rsg45::PROFILE];

/// What a manual says about a device.
#[derive(Debug)]
pub struct Profile {
    /// Stable word of settings and exports.
    pub key: &'static str,
    /// Maker and type.
    pub label: &'static str,
    /// The manual.
    pub source: &'static str,
    /// The function codes that its manual lists; empty where it has no Modbus.
    pub functions: &'static [u8],
    /// Its ident number on PROFIBUS.
    pub ident: Option<u16>,
    /// The manual writes addresses in hex.
    pub hex_addresses: bool,
    /// What stands at which address, in the order of the addresses and without overlap.
    pub areas: &'static [Area],
    /// Addresses with a name of their own, each within one of the areas; several lists, where
    /// devices share one.
    pub parameters: &'static [&'static [Parameter]],
    /// The most registers that the device takes at once, where it takes fewer than the standard.
    pub most_registers: Option<usize>,
    /// What its display shows when something is wrong.
    pub display: &'static [Display],
    /// Registers that set up what others mean, or say how the device is at present.
    pub lessons: &'static [Lesson],
    /// What the manual asks of registers beyond what their own descriptions say.
    pub rules: &'static [Rule],
    /// The exception codes of the standard that it rejects requests with.
    pub common_exceptions: &'static [u8],
    /// What its exception codes mean, where the manual has more of them than the standard.
    pub exceptions: Option<&'static Spec>,
    /// Other addresses of its parameters, as other programs of the maker count them.
    pub aliases: &'static [Alias],
    /// Telegrams that its manual misprints.
    pub misprints: &'static [Misprint],
}

/// Registers from `from` on, `count` of them, that set up what others mean.
#[derive(Debug)]
pub struct Lesson {
    pub from: u16,
    pub count: u16,
    /// A value that is read teaches, too.
    pub read: bool,
    pub learn: fn(&Taught, &mut Settings),
}

/// A value that was written, or read.
#[derive(Clone, Copy, Debug)]
pub struct Taught {
    /// The register's number among those of the lesson.
    pub n: usize,
    pub subindex: u8,
    pub value: u32,
    pub written: bool,
}

/// Says what is wrong with registers.
pub type Rule = fn(&'static Profile, &Registers<'_>, &Settings, &mut Said);

/// An address of COMBIVIS, the program of the F5's maker.
#[derive(Clone, Copy, Debug)]
pub struct Alias {
    pub address: u16,
    pub subindex: u8,
    /// From the first software on that counts so, and before; none where the manual gives none.
    pub new: Option<u16>,
    pub old: Option<u16>,
}

/// A telegram that a manual prints with slips.
#[derive(Debug)]
pub struct Misprint {
    pub section: &'static str,
    pub printed: &'static [u8],
    pub right: &'static [u8],
    /// Which slips they are.
    pub slips: &'static str,
}

/// Registers, or indices of a parameter channel, that follow each other and hold the same kind of thing.
#[derive(Debug)]
pub struct Area {
    /// What one block of it is called, and (for [`Content::Value`]) how its value is shown.
    pub spec: Spec,
    /// The first address.
    pub from: u16,
    /// Addresses of one block.
    pub stride: u16,
    /// Number of blocks.
    pub count: u16,
    /// The number of the first block in the manual's words: channel 1. `None` where blocks have none.
    pub first: Option<u64>,
    pub access: Access,
    pub content: Content,
    /// Bytes of a value, where one address holds more than a register of 16 bits.
    pub length: Option<usize>,
    /// Each address is there in several parameter sets.
    pub in_sets: bool,
    /// The manual lists all that there is here: what has no name does not exist.
    pub listed: bool,
    /// To be written by the service for several registers, even where it is one.
    pub together: bool,
    /// What else the manual, or a person, calls it.
    pub also: &'static str,
    /// To be written with all its parts.
    pub whole: bool,
    /// Addresses in between that hold something else, and what.
    pub between: Option<Between>,
    /// How many registers the manual reads at once, where it does not read the whole block: the values that
    /// have a name there.
    pub reads: Option<&'static Spec>,
    /// Adds to what is to be written what belongs to it.
    pub completed: Option<Complete>,
}

/// Takes what is filled in and gives what is to be written.
pub type Complete = fn(&[u8]) -> Vec<u8>;

/// Addresses among those of an area that hold something else.
#[derive(Clone, Copy, Debug)]
pub struct Between {
    pub has: fn(u16) -> bool,
    pub spec: &'static Spec,
}

/// Whether the manual lets a client read or write it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    Read,
    Write,
    ReadWrite,
    /// It has a name, but this bus does not reach it.
    Elsewhere,
}

/// What a block holds.
#[derive(Clone, Copy, Debug)]
pub enum Content {
    /// One number over all addresses of the block, as the area's spec says.
    Value,
    /// Numbers one behind the other.
    Parts(&'static [Part]),
    /// A telegram of its own over the whole area: what reading gives and what is written, where
    /// the device allows that.
    Telegram { read: Option<New>, write: Option<New> },
    /// What the user's mapping list says.
    Mapped,
}

/// Makes an empty telegram, for a device that is so at present.
pub type New = fn(&Settings) -> Box<dyn Telegram>;

/// A number within a block.
#[derive(Debug)]
pub struct Part {
    pub spec: &'static Spec,
    /// What it is when it is written, where that is something else.
    pub written: &'static Spec,
    /// How many addresses it takes.
    pub registers: u16,
}

/// An address with a name of its own.
#[derive(Debug)]
pub struct Parameter {
    /// Modbus register, or index of the parameter channel.
    pub address: u16,
    /// Where the parameter channel tells several things apart by subindex.
    pub subindex: Option<u8>,
    /// The maker's short name: `FB.00`, `Sy.50`.
    pub id: &'static str,
    /// Bytes of its value, where the manual says so.
    pub length: Option<usize>,
    pub access: Access,
    /// The software version from which on there is one, where the manual says so.
    pub since: &'static str,
    /// What else the manual calls it.
    pub also: &'static str,
    /// What it is called (the maker's name is the label, what it is for the note), and how its value is shown.
    pub spec: Spec,
}

/// What a user set up in a device, as far as it changes what its registers mean.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    pub read_mapping: Mapping,
    pub write_mapping: Mapping,
    /// What the words of process data mean, towards the device and from it.
    pub process_output: Vec<ProcessWord>,
    pub process_input: Vec<ProcessWord>,
    /// What the telegrams so far say of how the device is at present; nobody sets that up.
    pub present: Present,
}

/// How a device is at present, as far as what was written and read before tells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "json", derive(serde::Serialize, serde::Deserialize))]
pub struct Present {
    pub limits: Limits,
    /// Reading limits gives one after the other, and no status.
    pub limits_read_back: bool,
    /// Whether each of four batches runs, where that is known.
    pub batches: [Option<bool>; 4],
}

/// How far changing limits has come.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "json", derive(serde::Serialize, serde::Deserialize))]
pub enum Limits {
    /// Nothing was seen of it.
    #[default]
    Unseen,
    Open,
    Changed,
    Accepted,
}

/// A list that gives registers their parameters, as an F5 Modbus operator holds it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mapping {
    /// The register that the first entry stands for.
    pub start: u16,
    pub entries: Vec<Entry>,
    /// How many entries are in use, where that is known.
    pub used: Option<usize>,
}

/// What a mapping list has for a register.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mapped {
    /// Number and entry, and whether it is the second register of a 32-bit value: that has number and
    /// entry of the first.
    Entry(usize, Entry, bool),
    /// It lies before the list.
    Before,
    /// Behind the entries that are in use.
    Unused(usize),
    /// Behind the entries that are known.
    Unknown(usize),
}

/// An entry of a mapping list: parameter address (16 bits), set mask (8), words (8).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Entry(pub u32);

impl Entry {
    pub const fn parameter(self) -> u16 {
        (self.0 >> 16) as u16
    }

    pub const fn sets(self) -> u8 {
        (self.0 >> 8) as u8
    }

    /// 1 for a value of 16 bits, 2 for one of 32.
    pub const fn words(self) -> u8 {
        self.0 as u8
    }
}

impl Mapping {
    /// What is behind the register at `address`.
    pub fn entry(&self, address: u16) -> Mapped {
        let Some(n) = address.checked_sub(self.start).map(usize::from) else { return Mapped::Before };
        if let Some(used) = self.used.filter(|used| n >= *used) {
            return Mapped::Unused(used);
        }
        let before = n.checked_sub(1).map(|before| (before, self.entries.get(before)));
        match (self.entries.get(n), before) {
            (Some(Entry(0)), Some((n, Some(entry)))) if entry.words() == 2 => Mapped::Entry(n, *entry, true),
            (None | Some(Entry(0)), _) => Mapped::Unknown(self.entries.len()),
            (Some(entry), _) => Mapped::Entry(n, *entry, false),
        }
    }

    /// Sets entry `n`, with empty ones before it where there are none yet.
    pub fn set(&mut self, n: usize, entry: Entry) {
        if self.entries.len() <= n {
            self.entries.resize(n + 1, Entry::default());
        }
        self.entries[n] = entry;
    }
}

impl Settings {
    /// The list that counts for what the client wants.
    pub fn mapping(&self, access: Access) -> &Mapping {
        if access == Access::Write { &self.write_mapping } else { &self.read_mapping }
    }
}

impl Profile {
    /// What a device has that has nothing special: a table names only what it has.
    pub const BLANK: Self = Self {
        key: "",
        label: "",
        source: "",
        functions: &[],
        ident: None,
        hex_addresses: false,
        areas: &[],
        parameters: &[],
        most_registers: None,
        display: &[],
        lessons: &[],
        rules: &[],
        // Others are of devices that program, keep files or pass on.
        common_exceptions: &[1, 2, 3, 4],
        exceptions: None,
        aliases: &[],
        misprints: &[],
    };

    /// The device with this key.
    pub fn of(key: &str) -> Option<&'static Self> {
        PROFILES.iter().copied().find(|profile| profile.key == key)
    }

    /// All addresses with a name of their own.
    pub fn parameters(&self) -> impl Iterator<Item = &'static Parameter> {
        self.parameters.iter().copied().flatten()
    }

    /// An address as the manual writes it.
    pub fn address(&self, address: u16) -> String {
        address_text(address, self.hex_addresses)
    }

    /// The area that has `address`.
    pub fn area(&self, address: u16) -> Option<&Area> {
        self.areas.iter().find(|area| (area.from..=area.last()).contains(&address))
    }

    /// The addresses of what is called so, first and last: a part of a name or an identifier, or a
    /// block with its number, such as `universal channel 6`.
    pub fn addresses(&self, name: &str) -> Vec<(u16, u16)> {
        let name = name.to_ascii_lowercase();
        let (words, number) = match name.rsplit_once(' ') {
            Some((words, number)) => (words, number.parse::<u64>().ok()),
            None => (name.as_str(), None),
        };
        let parameters = self.parameters.iter().copied().flatten();
        let called = |parameter: &&Parameter| {
            parameter.id.eq_ignore_ascii_case(&name)
                || parameter.spec.label.to_ascii_lowercase().contains(&name)
        };
        let mut found: Vec<(u16, u16)> =
            parameters.filter(called).map(|parameter| (parameter.address, parameter.address)).collect();
        for area in self.areas {
            let label = area.spec.label.to_ascii_lowercase();
            let block = number.zip(area.first).and_then(|(number, first)| number.checked_sub(first));
            if let Some(block) = block.filter(|block| *block < area.count.into() && label.contains(words)) {
                // Fewer than there are blocks, so it fits.
                let from = area.from + block as u16 * area.stride;
                found.push((from, from + (area.stride - 1)));
            } else if label.contains(&name) {
                found.push((area.from, area.last()));
            }
        }
        found
    }

    /// Whether what is written to this address can change what others mean.
    pub fn teaches(&self, address: u16) -> bool {
        self.lesson(address).is_some()
    }

    fn lesson(&self, address: u16) -> Option<&'static Lesson> {
        self.lessons.iter().find(|lesson| (lesson.from..lesson.from + lesson.count).contains(&address))
    }

    /// Takes from a value of `width` bytes that was written or read how the device is set up from then on;
    /// says whether that changes it.
    pub fn learn(
        &self,
        address: u16,
        subindex: u8,
        value: u32,
        width: usize,
        written: bool,
        settings: &mut Settings,
    ) -> bool {
        let Some(lesson) = self.lesson(address).filter(|lesson| written || lesson.read) else { return false };
        if self.area(address).and_then(|area| area.length).is_some_and(|length| width < length) {
            return false;
        }
        let before = settings.clone();
        let taught = Taught { n: usize::from(address - lesson.from), subindex, value, written };
        (lesson.learn)(&taught, settings);
        *settings != before
    }

    /// Whether the subindex of `index` says in which sets a parameter is meant.
    pub fn has_sets(&'static self, index: u16, subindex: u8) -> bool {
        self.area(index).is_some_and(|area| area.in_sets && !area.is_between(index))
            && self.named(index, Some(subindex)).is_none_or(keb_f5::has_sets)
    }

    /// Other addresses of a parameter.
    pub fn alias(&self, address: u16, subindex: u8) -> Option<&'static Alias> {
        self.aliases.iter().find(|alias| (alias.address, alias.subindex) == (address, subindex))
    }
}

impl Default for Settings {
    /// As the devices come from their makers: the F5's process data are control word and set speed,
    /// status word and actual speed.
    fn default() -> Self {
        Self {
            read_mapping: Mapping::default(),
            write_mapping: Mapping::default(),
            process_output: keb_f5::STANDARD_OUTPUT.to_vec(),
            process_input: keb_f5::STANDARD_INPUT.to_vec(),
            present: Present::default(),
        }
    }
}

/// An address in decimal or in hex.
fn address_text(address: u16, hex: bool) -> String {
    if hex { hex_value(address.into(), 2).to_string() } else { address.to_string() }
}

impl Area {
    /// One block of one readable and writable number.
    pub const fn new(from: u16, spec: Spec) -> Self {
        Self {
            spec,
            from,
            stride: 1,
            count: 1,
            first: None,
            access: Access::ReadWrite,
            content: Content::Value,
            length: None,
            in_sets: false,
            listed: false,
            together: false,
            also: "",
            whole: false,
            between: None,
            reads: None,
            completed: None,
        }
    }

    /// `count` blocks of `stride` addresses, numbered from `first` in the manual's words.
    pub const fn blocks(mut self, count: u16, stride: u16, first: u64) -> Self {
        self.count = count;
        self.stride = stride;
        self.first = Some(first);
        self
    }

    pub const fn access(mut self, access: Access) -> Self {
        self.access = access;
        self
    }

    pub const fn content(mut self, content: Content) -> Self {
        self.content = content;
        self
    }

    pub const fn length(mut self, length: usize) -> Self {
        self.length = Some(length);
        self
    }

    pub const fn in_sets(mut self) -> Self {
        self.in_sets = true;
        self
    }

    pub const fn listed(mut self) -> Self {
        self.listed = true;
        self
    }

    pub const fn together(mut self) -> Self {
        self.together = true;
        self
    }

    pub const fn also(mut self, also: &'static str) -> Self {
        self.also = also;
        self
    }

    pub const fn whole(mut self) -> Self {
        self.whole = true;
        self
    }

    pub const fn between(mut self, has: fn(u16) -> bool, spec: &'static Spec) -> Self {
        self.between = Some(Between { has, spec });
        self
    }

    pub const fn reads(mut self, reads: &'static Spec) -> Self {
        self.reads = Some(reads);
        self
    }

    pub const fn completed(mut self, completed: Complete) -> Self {
        self.completed = Some(completed);
        self
    }

    /// Whether something else than the rest stands at this address.
    pub fn is_between(&self, address: u16) -> bool {
        self.between.is_some_and(|between| (between.has)(address))
    }

    /// The last address.
    pub const fn last(&self) -> u16 {
        self.from + (self.stride * self.count - 1)
    }
}

impl Part {
    /// A number that is the same whether it is read or written.
    pub const fn new(spec: &'static Spec, registers: u16) -> Self {
        Self { spec, written: spec, registers }
    }

    /// With other words for what a client writes.
    pub const fn written(mut self, written: &'static Spec) -> Self {
        self.written = written;
        self
    }

    /// What it is to a client that wants this.
    pub fn spec(&self, access: Access) -> &'static Spec {
        if access == Access::Write { self.written } else { self.spec }
    }
}

impl Parameter {
    /// A readable and writable parameter.
    pub const fn new(address: u16, id: &'static str, spec: Spec) -> Self {
        let access = Access::ReadWrite;
        Self { address, subindex: None, id, length: None, access, since: "", also: "", spec }
    }

    pub const fn subindex(mut self, subindex: u8) -> Self {
        self.subindex = Some(subindex);
        self
    }

    pub const fn length(mut self, length: usize) -> Self {
        self.length = Some(length);
        self
    }

    pub const fn access(mut self, access: Access) -> Self {
        self.access = access;
        self
    }

    pub const fn also(mut self, also: &'static str) -> Self {
        self.also = also;
        self
    }

    pub const fn since(mut self, since: &'static str) -> Self {
        self.since = since;
        self
    }
}
