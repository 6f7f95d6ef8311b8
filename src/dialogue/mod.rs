//! What telegrams say about each other, and what their lengths say about them: who speaks, and
//! which response answers which request.

mod guess;
mod pair;

pub use guess::{Certainty, Guess, direction};
pub use pair::Pairing;
