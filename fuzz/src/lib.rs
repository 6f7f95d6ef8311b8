//! Random and changed inputs against what must hold for every input.
//!
//! A [`Target`] is a plain function over bytes that panics where a law does not hold, as `cargo fuzz`
//! wants it, too; the loop around it is in `main.rs`, since a compiler for `cargo fuzz` is not
//! everywhere. What the bytes are to be is chosen by their first ones (see [`Input`]), so that a
//! failing input is a file that fails again.
//!
//! | part | what it does |
//! | --- | --- |
//! | `targets` | the laws, a file for each way into the library |
//! | `input` | bytes into choices |
//! | `make` | random bytes, changed seeds |
//! | `seeds` | the library's vectors, and words that mean something to it |
//! | `random` | numbers that a seed tells |

mod input;
mod make;
mod random;
mod seeds;
mod targets;

pub use input::Input;
pub use make::smaller;
pub use random::Random;
pub use seeds::Seeds;
pub use targets::{TARGETS, Target};
