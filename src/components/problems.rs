//! What is wrong with a telegram.

use leptos::prelude::*;

use super::byte_strip::{Chosen, Lights};
use super::icon::{Glyph, Icon};
use super::telegram::Shown;
use buslens::field::Severity;

/// Every problem is a button that leads to its bytes.
#[component]
pub fn Problems(shown: Shown, lights: Lights) -> impl IntoView {
    let problem = |severity, text: String, span: buslens::field::Span| {
        let (class, word) = match severity {
            Severity::Error => ("bad", "Error: "),
            Severity::Warning => ("warn", "Warning: "),
        };
        let choose = move |_| {
            lights.chosen.set((!span.is_empty()).then_some(Chosen { span, at: span.from }));
        };
        view! {
            <li class=class>
                <button type="button" on:click=choose>
                    <Icon glyph=Glyph::Warning />
                    <span class="unseen">{word}</span>
                    <span>{text}</span>
                </button>
            </li>
        }
    };
    let all: Vec<_> = shown
        .detail
        .problems()
        .into_iter()
        .map(|it| problem(it.severity, it.message.sentence() + ".", it.span))
        .collect();
    (!all.is_empty()).then(|| view! { <ul class="problems" aria-label="Problems">{all}</ul> })
}
