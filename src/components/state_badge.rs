//! How it went with a telegram: a sign and a word.

use leptos::prelude::*;

use super::icon::{Glyph, Icon};
use buslens::tool::log::State;

/// The state of a telegram. What went its way unremarkably has none.
#[component]
pub fn StateBadge(
    state: State,
    /// Microseconds that a slow answer took.
    latency: Option<u32>,
) -> impl IntoView {
    let class = class(state)?;
    let glyph = match state {
        State::Ok => Glyph::Tick,
        State::Damaged | State::Refused => Glyph::Close,
        State::Slow | State::Late => Glyph::Clock,
        State::Retry => Glyph::Undo,
        State::Unanswered | State::Discarded | State::Cut => Glyph::Gap,
        _ => Glyph::Dot,
    };
    let word = match (state, latency) {
        (State::Slow, Some(latency)) => format!("slow {} ms", latency / 1000),
        _ => state.word().to_owned(),
    };
    Some(view! {
        <span class=format!("state {class}")>
            <Icon glyph />
            {word}
        </span>
    })
}

/// The class that gives a state its colour, if it has a badge.
pub const fn class(state: State) -> Option<&'static str> {
    Some(match state {
        State::Plain => return None,
        State::Ok => "good",
        State::Broadcast | State::Copy | State::Echo => "quiet",
        State::Retry | State::Slow | State::Late | State::Unasked => "warn",
        State::Unanswered | State::Discarded | State::Cut => "open",
        State::Refused | State::Damaged => "bad",
    })
}
