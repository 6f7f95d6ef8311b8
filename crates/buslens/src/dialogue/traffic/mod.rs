//! The telegrams of a log: found, checked, and met with those that they answer.
//!
//! Bytes go in as [`Chunk`]s; a telegram is an [`Entry`] of 40 bytes and its bytes in one long run.
//! Nothing is allocated for a single telegram, and everything takes linear time.

mod collect;
mod conversation;
mod entry;
mod judge;
mod lane;
mod pieces;
mod statistics;
mod stream;

pub use collect::{Chunk, Traffic};
pub use entry::{Entry, Hint, Role};
pub use statistics::{Dialog, Minutes, Statistics, latency, statistics};
