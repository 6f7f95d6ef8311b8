//! Some telegrams: what one of them says, its bytes, its fields, its check.

use leptos::prelude::*;

use super::ReadState;
use crate::address::{View, href};
use crate::components::byte_strip::{ByteStrip, blocks};
use crate::components::check_result::CheckResult;
use crate::components::field_table::{FieldTable, rows};
use crate::components::fold::Fold;
use crate::components::icon::{Glyph, Icon};
use crate::components::problems::Problems;
use crate::components::registers::Registers;
use crate::components::structure::Structure;
use crate::components::telegram::Shown;
use crate::later::{LaterPiece, Piece};
use buslens::field::{Direction, Message};
use buslens::tool::{Certainty, Profile, Verdict};

/// The telegram of the input that is shown.
#[component]
pub fn Telegrams() -> impl IntoView {
    let read = expect_context::<ReadState>();
    let lights = read.lights;
    let blocks =
        Memo::new(move |_| read.shown().map_or(Vec::new(), |shown| blocks(&shown.detail, shown.bytes())));
    let rows =
        Memo::new(move |_| read.shown().map_or(Vec::new(), |shown| rows(&shown.detail, shown.bytes())));
    let wrong = Memo::new(move |_| {
        read.shown().is_some_and(|shown| {
            // One that is cut may be a misprint of a manual.
            matches!(shown.telegram.verdict, Verdict::Wrong | Verdict::Unchecked)
        })
    });
    let size = Memo::new(move |_| match read.shown().map_or(0, |shown| shown.bytes().len()) {
        ..=24 => "large",
        25..=80 => "",
        _ => "small",
    });
    view! {
        <Show when=move || read.shown().is_some()>
            <Lead />
            <section class="bytes" aria-label="Bytes">
                {move || view! { <ByteStrip blocks lights size=size.get() /> }}
            </section>
            <div class="columns">
                <section class="fields-column" aria-label="Fields">
                    <Show when=move || wrong.get()>
                        <LaterPiece piece=Piece::Causes />
                    </Show>
                    <FieldTable rows lights label="Fields" />
                    <LaterPiece piece=Piece::More />
                </section>
                <section class="rail" aria-label="Checksum and chosen byte">
                    {move || read.shown().map(|shown| view! { <CheckResult shown lights /> })}
                    <LaterPiece piece=Piece::ChosenByte />
                    {move || read.shown().map(|shown| view! { <Exchange shown /> })}
                </section>
            </div>
        </Show>
    }
}

/// What the telegram says, how that is known, and what can be done with it.
#[component]
fn Lead() -> impl IntoView {
    let read = expect_context::<ReadState>();
    let lights = read.lights;
    let said = move || {
        read.shown().map(|shown| {
            view! {
                <h2>{shown.detail.meaning().sentence()} "."</h2>
                <Kind shown=shown.clone() />
                <Problems shown lights />
            }
        })
    };
    view! {
        <section class="lead">
            <div>{move || said()}</div>
            <div class="acts">
                <LaterPiece piece=Piece::CopyAs />
                <a class="button" href=move || read.shown().map(|shown| href(View::Build, &shown.link()))>
                    <Icon glyph=Glyph::Edit />
                    "Edit in Build"
                </a>
            </div>
        </section>
    }
}

/// What kind of telegram it is, and what speaks for that.
#[component]
pub fn Kind(shown: Shown) -> impl IntoView {
    let read = expect_context::<ReadState>();
    let telegram = &shown.telegram;
    // What somebody chose needs no reason.
    let by_hand = shown.options.protocol.is_some() && shown.options.direction.is_some();
    let direction = telegram.guess.told().map_or("telegram", Direction::key);
    let who = match telegram.guess.certainty {
        Certainty::Certain => format!("A {direction}: {}.", telegram.guess.reason),
        Certainty::Likely => format!("Taken for a {direction}: {}.", telegram.guess.reason),
        Certainty::Open => format!("Request or response? {}.", telegram.guess.reason.sentence()),
    };
    let protocol = format!("{}: {}.", telegram.choice.protocol.label, telegram.choice.reason);
    let others: Vec<_> = telegram
        .choice
        .others
        .iter()
        .enumerate()
        .map(|(index, (other, fit))| {
            let key = other.key;
            view! {
                {if index > 0 { ", " } else { "" }}
                <button
                    type="button"
                    class="link"
                    title=fit.reason.to_string()
                    on:click=move |_| read.read_as(|choices| choices.protocol = key.to_owned())
                >
                    {other.label}
                </button>
            }
        })
        .collect();
    let others = (!others.is_empty()).then(|| view! { " It could also be " {others} "." });
    let device = shown.options.device_of(telegram.unit).map(|device: &Profile| format!(" {}.", device.label));
    view! {
        <p class="kind">
            {shown.detail.kind.sentence()} ", " {Message::bytes(shown.bytes().len()).to_string()} "." {device}
        </p>
        {(!by_hand)
            .then(|| {
                view! {
                    <p class="reasons">{who} " " {protocol} {others}</p>
                }
            })}
    }
}

/// What is there for those who want to know more.
#[component]
pub fn More() -> impl IntoView {
    let read = expect_context::<ReadState>();
    let lights = read.lights;
    let has_registers =
        Memo::new(move |_| read.shown().is_some_and(|shown| shown.detail.registers.is_some()));
    let registers = move || read.shown().map(|shown| view! { <Registers shown lights /> });
    let structure = move || {
        read.shown().map(|shown| {
            let (note, source) = (shown.detail.note, shown.detail.source);
            view! { <Structure note source layout=shown.report.layout(shown.index) /> }
        })
    };
    view! {
        <Show when=move || has_registers.get()>
            <Fold summary=|| "All interpretations of these registers">{registers}</Fold>
        </Show>
        <Fold summary=|| "Structure of this telegram">{structure}</Fold>
    }
}

/// Request and answer of the same exchange.
#[component]
fn Exchange(shown: Shown) -> impl IntoView {
    let read = expect_context::<ReadState>();
    let telegram = &shown.telegram;
    let (word, partner) = match (telegram.answers, telegram.answered_by) {
        (Some(request), _) => ("Request", request),
        (None, Some(response)) => ("Answer", response),
        (None, None) => return None,
    };
    let said = shown.report.detail(partner).map(|detail| detail.said.sentence() + ".");
    let number = shown.report.telegrams.get(partner).map_or(0, |telegram| telegram.number);
    Some(view! {
        <section class="part">
            <h3>"Exchange"</h3>
            <dl class="pairs">
                <dt>{word}</dt>
                <dd>
                    <button type="button" class="link" on:click=move |_| read.select(partner)>
                        {format!("telegram {number}")}
                    </button>
                    ": "
                    {said}
                </dd>
            </dl>
        </section>
    })
}
