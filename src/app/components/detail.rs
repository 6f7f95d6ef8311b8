//! One telegram: what it says, its bytes, its fields, its check.

use std::sync::Arc;

use leptos::prelude::*;

use super::examples::Examples;
use super::{check, fields, layout, strip};
use crate::app::browser;
use crate::app::state::{Shown, State};
use crate::field::{Severity, hex};
use crate::tool::Certainty;

#[component]
pub fn Telegram() -> impl IntoView {
    let state = State::here();
    view! {
        <section class="card detail" aria-label="Telegram" on:pointerleave=move |_| state.pointed.set(None)>
            {move || match state.shown.get() {
                Some(shown) => view! { <Reading shown /> }.into_any(),
                None => view! { <Welcome /> }.into_any(),
            }}
        </section>
    }
}

/// What a person sees first.
#[component]
fn Welcome() -> impl IntoView {
    let state = State::here();
    view! {
        <div class="welcome">
            <h2>"What does this telegram say?"</h2>
            <p>
                "Paste the bytes of a Modbus RTU telegram on the left, or several, one in a line. Every byte is "
                "explained, every check is checked, and what is wrong is said."
            </p>
            <p class="title">"Or start with an example"</p>
            <Examples choose=move |example| state.load(example.text) />
        </div>
    }
}

#[component]
fn Reading(shown: Arc<Shown>) -> impl IntoView {
    let state = State::here();
    let telegram = &shown.telegram;
    let direction = match telegram.guess.certainty {
        Certainty::Open => "telegram",
        Certainty::Certain | Certainty::Likely => telegram.guess.direction.key(),
    };
    let partner = telegram.answers.map(|index| ("answers telegram", index));
    let partner = partner.or(telegram.answered_by.map(|index| ("answered by telegram", index)));
    let partner = partner.map(|(words, index)| {
        view! {
            " · "
            <button type="button" class="link" on:click=move |_| state.selected.set(index)>
                {format!("{words} {}", index + 1)}
            </button>
        }
    });
    let sure = match telegram.guess.certainty {
        Certainty::Certain => "",
        Certainty::Likely => "Taken for a ",
        Certainty::Open => "Request or response: ",
    };
    let sure = match telegram.guess.certainty {
        Certainty::Likely => format!("{sure}{direction}: "),
        Certainty::Certain => format!("A {direction}: "),
        Certainty::Open => sure.to_owned(),
    };
    let problems = shown.detail.problems().into_iter().cloned().collect::<Vec<_>>();
    let listed = problems
        .into_iter()
        .map(|problem| {
            let (class, word) = match problem.severity {
                Severity::Error => ("error", "Error"),
                Severity::Warning => ("warning", "Warning"),
            };
            let span = problem.span;
            view! {
                <li class=class>
                    <button type="button" on:click=move |_| state.chosen.set(Some(span))>
                        <span class="unseen">{word}": "</span>
                        {problem.message.sentence()}
                        "."
                    </button>
                </li>
            }
        })
        .collect::<Vec<_>>();
    let bytes = hex(shown.bytes());
    view! {
        <p class="title">
            {format!("Telegram {} of {} · Modbus RTU {direction}", shown.index + 1, shown.of)} {partner}
        </p>
        <h2>{shown.detail.meaning().sentence()}"."</h2>
        <p class="kind">{shown.detail.kind.to_string()}". "{sure}{telegram.guess.reason.to_string()}"."</p>
        {(!listed.is_empty()).then(|| view! { <ul class="problems">{listed}</ul> })}
        <div class="bar">
            <p class="count">{crate::field::Message::bytes(shown.bytes().len()).to_string()}</p>
            <button type="button" class="quiet" on:click=move |_| browser::copy(&bytes)>
                "Copy as hex"
            </button>
        </div>
        <strip::Strip shown=shown.clone() />
        <fields::Fields shown=shown.clone() />
        <check::Check shown=shown.clone() />
        <layout::Layout shown />
    }
}
