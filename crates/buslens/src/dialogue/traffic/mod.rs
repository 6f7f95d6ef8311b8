//! The telegrams of a log: found, checked, and met with those that they answer.
//!
//! Bytes go in as [`Chunk`]s and become [`Entry`]s. A block of these at a time is settled: judged, met, and packed
//! into [`Entries`], after which their bytes are only in the file, where they can be read from it. Nothing is
//! allocated for a single telegram, and everything takes linear time.

mod collect;
mod conversation;
mod cut;
mod entries;
mod entry;
mod judge;
mod lane;
mod packed;
mod pieces;
mod settle;
mod statistics;
mod stream;

pub use collect::{Chunk, Traffic};
pub use cut::{Found, Place, Sums};
pub use entries::{Entries, Iter};
pub use entry::{Entry, Hint, Role, Written};
pub use packed::{take_bytes, write_bytes};
pub use settle::Lines;
pub use statistics::{Dialog, Minutes, Statistics, latency, statistics};
