//! The ways into the library, each with the laws that hold for whatever comes.

mod capture;
mod cause;
mod form;
mod frame;
mod law;
mod link;
mod log;
mod long;
mod settings;
mod splitter;
mod telegram;
mod text;
mod word;

use crate::{Random, Seeds};

/// A way into the library.
pub struct Target {
    pub key: &'static str,
    /// What is tried.
    pub about: &'static str,
    /// Its share of the time, in parts.
    pub share: u32,
    /// Makes an input.
    pub make: fn(&mut Random, &Seeds) -> Vec<u8>,
    /// Panics where a law does not hold.
    pub run: fn(&[u8]),
}

/// All of them.
pub static TARGETS: &[&Target] = &[
    &frame::TARGET,
    &splitter::TARGET,
    &telegram::TARGET,
    &text::TARGET,
    &log::TEXT,
    &log::STREAM,
    &capture::TARGET,
    &link::TARGET,
    &settings::TARGET,
    &form::TARGET,
    &long::TARGET,
    &cause::TARGET,
    &word::TARGET,
];
