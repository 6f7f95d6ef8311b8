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
mod memograph_rsg45;
mod read;

pub use display::Display;
pub use draft::{Asked, Draft, Target, Task};
pub use keb_f5::ProcessWord;
pub use keb_f5_modbus::mapping_entry;
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
    /// Registers that set up what others mean.
    pub lessons: &'static [Lesson],
}

/// Registers from `from` on, `count` of them, that set up what others mean.
#[derive(Debug)]
pub struct Lesson {
    pub from: u16,
    pub count: u16,
    /// Takes the number of the register among them, the subindex, and the new value.
    pub learn: fn(usize, u8, u32, &mut Settings),
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
}

/// Whether the manual lets a client read or write it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    Read,
    Write,
    ReadWrite,
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

/// Makes an empty telegram.
pub type New = fn() -> Box<dyn Telegram>;

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
}

/// A list that gives registers their parameters, as an F5 Modbus operator holds it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mapping {
    /// The register that the first entry stands for.
    pub start: u16,
    pub entries: Vec<Entry>,
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
    /// Number and entry of the register at `address`, and whether it is the second one of a 32-bit
    /// value: that has the number and the entry of the first.
    pub fn entry(&self, address: u16) -> Option<(usize, Entry, bool)> {
        let n = usize::from(address.checked_sub(self.start)?);
        match self.entries.get(n)? {
            Entry(0) => {
                let before = n.checked_sub(1)?;
                Some((before, self.entries[before], true)).filter(|(_, entry, _)| entry.words() == 2)
            }
            entry => Some((n, *entry, false)),
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
    /// The device with this key.
    pub fn of(key: &str) -> Option<&'static Self> {
        PROFILES.iter().copied().find(|profile| profile.key == key)
    }

    /// All addresses with a name of their own.
    pub fn parameters(&self) -> impl Iterator<Item = &'static Parameter> {
        self.parameters.iter().copied().flatten()
    }

    /// Whether an exception code is the device's: those of the standard are everybody's, KEB's own come from
    /// KEB's devices, which have functions of their own, too.
    pub fn can_refuse_with(&self, code: u8) -> bool {
        const OF_THE_STANDARD: u8 = 63;
        code <= OF_THE_STANDARD || self.functions.iter().any(|function| *function > OF_THE_STANDARD)
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
        let name = name.to_lowercase();
        let (words, number) = match name.rsplit_once(' ') {
            Some((words, number)) => (words, number.parse::<u64>().ok()),
            None => (name.as_str(), None),
        };
        let parameters = self.parameters.iter().copied().flatten();
        let called = |parameter: &&Parameter| {
            parameter.id.eq_ignore_ascii_case(&name) || parameter.spec.label.to_lowercase().contains(&name)
        };
        let mut found: Vec<(u16, u16)> =
            parameters.filter(called).map(|parameter| (parameter.address, parameter.address)).collect();
        for area in self.areas {
            let label = area.spec.label.to_lowercase();
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

    /// Takes from a new value of `width` bytes how the device is set up from then on; says whether
    /// that changes it.
    pub fn learn(
        &self,
        address: u16,
        subindex: u8,
        value: u32,
        width: usize,
        settings: &mut Settings,
    ) -> bool {
        let Some(lesson) = self.lesson(address) else { return false };
        if self.area(address).and_then(|area| area.length).is_some_and(|length| width < length) {
            return false;
        }
        let before = settings.clone();
        (lesson.learn)(usize::from(address - lesson.from), subindex, value, settings);
        *settings != before
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
        }
    }
}

/// An address in decimal or in hex.
fn address_text(address: u16, hex: bool) -> String {
    if hex { hex_value(address.into(), 2) } else { address.to_string() }
}

impl Area {
    /// One block of one readable and writable number.
    pub const fn new(from: u16, spec: Spec) -> Self {
        let access = Access::ReadWrite;
        Self { spec, from, stride: 1, count: 1, first: None, access, content: Content::Value, length: None }
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
        Self { address, subindex: None, id, length: None, access, since: "", spec }
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

    pub const fn since(mut self, since: &'static str) -> Self {
        self.since = since;
        self
    }
}
