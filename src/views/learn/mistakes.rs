//! Why a file is no lesson and no set.

use leptos::prelude::*;

use crate::components::button::Button;
use crate::components::icon::{Glyph, Icon};
use buslens_trainer::lesson::Mistake;

/// More mistakes are not shown at once.
const MOST: usize = 20;

/// A text that is not opened yet.
#[derive(Clone, PartialEq)]
pub struct Refused {
    /// What is said of it.
    pub said: String,
    pub mistakes: Vec<Mistake>,
}

/// What is wrong in a text, line by line.
#[component]
pub fn Mistakes(
    refused: Refused,
    /// Where it can be taken away.
    #[prop(optional)]
    on_close: Option<Callback<()>>,
) -> AnyView {
    let Refused { said, mistakes } = refused;
    let row = |mistake: &Mistake| {
        view! {
            <li>
                <b>{format!("Line {}", mistake.line)}</b>
                <span>{mistake.said.clone()}</span>
            </li>
        }
        .into_any()
    };
    let rows: Vec<AnyView> = mistakes.iter().take(MOST).map(row).collect();
    let more = match mistakes.len().saturating_sub(MOST) {
        0 => String::new(),
        more => format!("And {more} more."),
    };
    let close = on_close.map(|on_press| {
        view! { <Button class="button low icon-only plain" glyph=Glyph::Close label="Close" on_press /> }
    });
    view! {
        <section class="mistakes" role="alert">
            <p>
                <Icon glyph=Glyph::Warning />
                <b>{said}</b>
                {close}
            </p>
            <ol>{rows}</ol>
            <p class="note" hidden=more.is_empty()>{more.clone()}</p>
        </section>
    }
    .into_any()
}
