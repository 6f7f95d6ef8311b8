//! Sentences of a task.

use leptos::prelude::*;

use buslens_trainer::lesson::{Piece, pieces};

/// A sentence, with its code and its new words.
#[component]
pub fn Words(#[prop(into)] text: String) -> impl IntoView {
    pieces(&text)
        .into_iter()
        .map(|piece| match piece {
            Piece::Plain(text) => view! { {text} }.into_any(),
            Piece::Code(text) => view! { <code>{text}</code> }.into_any(),
            Piece::Term(text) => view! { <dfn>{text}</dfn> }.into_any(),
        })
        .collect_view()
}
