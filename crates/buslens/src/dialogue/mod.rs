//! What telegrams say about each other, and what their bytes say about them: which protocol they
//! are of, who speaks, and which response answers which request.

pub mod evidence;
pub mod foreign;
mod guess;
mod hypothesis;
mod pair;
mod protocol;
pub mod traffic;
mod turns;

pub use guess::{Certainty, Guess, direction};
pub use hypothesis::{Cause, Context, Hypothesis, chance_of_change, hypotheses};
pub use pair::Pairing;
pub use protocol::{Candidate, Choice, protocols};
pub use turns::{leaning, told, turns};
