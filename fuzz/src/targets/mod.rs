//! The ways into the library, each with the laws that hold for whatever comes.

mod block;
mod capture;
mod cause;
mod form;
mod frame;
mod law;
mod link;
mod log;
mod long;
mod out;
mod practice;
mod report;
mod sentence;
mod settings;
mod setup;
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
    /// The most memory that little input may take.
    pub memory: usize,
    /// Makes an input.
    pub make: fn(&mut Random, &Seeds) -> Vec<u8>,
    /// Panics where a law does not hold.
    pub run: fn(&[u8]),
}

/// A report of some hundred telegrams in as many short lines, with all that there is to say of them.
const USUAL_MEMORY: usize = 3 << 20;

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
    &sentence::TARGET,
    &block::TARGET,
    &report::TARGET,
    &out::TARGET,
    &setup::TARGET,
    &practice::TARGET,
];
