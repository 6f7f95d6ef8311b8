//! What the makers' manuals say about their devices: registers, parameters, value names, limits.
//!
//! A device is a table: [`PROFILES`] lists them. A table says what stands at an address; it knows
//! neither function codes nor frames. Every block of registers and every parameter is described
//! once, and from that description it is read, written, edited and explained.

pub mod keb_f5;
mod keb_f5_modbus;
mod keb_f5_profibus;
mod memograph_rsg45;

use crate::field::Spec;
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
    /// What stands at which address, in the order of the addresses and without overlap.
    pub areas: &'static [Area],
    /// Addresses with a name of their own, each within one of the areas.
    pub parameters: &'static [Parameter],
    /// The most registers that the device takes at once, where it takes fewer than the standard.
    pub most_registers: Option<usize>,
    /// What its display shows when something is wrong.
    pub display: &'static [Display],
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

/// A text that the device's display shows.
#[derive(Debug)]
pub struct Display {
    /// As the seven segments write it.
    pub text: &'static str,
    pub meaning: &'static str,
}

impl Area {
    /// One block of one readable and writable number.
    pub const fn new(from: u16, spec: Spec) -> Self {
        let access = Access::ReadWrite;
        Self { spec, from, stride: 1, count: 1, first: None, access, content: Content::Value }
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

    /// The last address.
    pub const fn last(&self) -> u16 {
        self.from + (self.stride * self.count - 1)
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
