//! The views, a folder each: its state, which outlasts it, and its parts.

pub mod build;
pub mod check;
pub mod devices;
pub mod learn;
pub mod outgoing;
pub mod read;
pub mod sheet;
