//! The telegram beside the list.

use std::sync::Arc;

use leptos::prelude::*;

use crate::address::{View, href};
use crate::components::byte_strip::{ByteStrip, blocks};
use crate::components::causes::Causes;
use crate::components::check_result::CheckResult;
use crate::components::chosen_byte::ChosenByte;
use crate::components::copy_as::CopyAs;
use crate::components::copy_button::CopyButton;
use crate::components::field_table::{FieldTable, rows};
use crate::components::fold::Fold;
use crate::components::icon::{Glyph, Icon};
use crate::components::problems::Problems;
use crate::components::registers::Registers;
use crate::components::telegram::Shown;
use crate::views::read::ReadState;
use crate::views::read::log::Current;
use crate::views::read::times::{clock, duration};
use crate::worker::messages::{self, Request, Which};
use buslens::field::{Direction, Message, hex};

#[component]
pub fn Detail() -> impl IntoView {
    let log = expect_context::<ReadState>().log;
    let current = move || {
        let current = log.current.get()?;
        Some(view! {
            <Head told=current.told.clone() />
            {match &current.shown {
                Some(shown) => view! { <Telegram shown=shown.clone() current=current.clone() /> }.into_any(),
                None => view! { <Discarded told=current.told.clone() /> }.into_any(),
            }}
        })
    };
    view! {
        <section class="detail" aria-label="Telegram">
            {current}
            <Show when=move || log.current.with(Option::is_some)>
                <Note />
            </Show>
        </section>
    }
}

/// Where the telegram stands in the log.
#[component]
fn Head(told: messages::Shown) -> impl IntoView {
    let log = expect_context::<ReadState>().log;
    let row = &told.row;
    let mut said = vec![format!("Telegram {}", row.index + 1)];
    if told.line > 0 {
        said.push(format!("line {}", told.line));
    }
    said.extend(row.time.map(clock));
    let partner = told.partner.map(|index| {
        let words = match row.direction {
            Some(Direction::Response) => "answers",
            _ => "answered by",
        };
        let after = row.latency.map(|latency| format!(" after {}", duration(latency.into())));
        let show = move |_| log.ask(Request::Show(Which::Index(index)));
        view! {
            " · "
            {words}
            " "
            <button type="button" class="link" on:click=show>
                {index + 1}
            </button>
            {after}
        }
    });
    let about = (!told.about.is_empty()).then(|| view! { <p class="note">{told.about.clone()}</p> });
    view! {
        <header>
            <p class="soft">{said.join(" · ")} {partner}</p>
        </header>
        {about}
    }
}

#[component]
fn Telegram(shown: Shown, current: Arc<Current>) -> impl IntoView {
    let lights = expect_context::<ReadState>().log.lights;
    let strip = blocks(&shown.detail, shown.bytes());
    let table = rows(&shown.detail, shown.bytes());
    let link = shown.link();
    let size = if shown.bytes().len() > 24 { "tiny" } else { "small" };
    let (text, places) = (current.told.excerpt.text.clone(), current.told.excerpt.places.clone());
    let has_registers = shown.detail.registers.is_some();
    view! {
        <h3 class="says">{shown.detail.meaning().sentence()} "."</h3>
        <p class="note">
            {format!(
                "{}, {}. {}.",
                shown.detail.kind.sentence(),
                shown.telegram.choice.protocol.label,
                Message::bytes(shown.bytes().len()),
            )}
        </p>
        <Problems shown=shown.clone() lights />
        <ByteStrip blocks=Signal::stored(strip) lights size />
        <ChosenByte shown=Signal::stored(Some(shown.clone())) lights />
        <Causes shown=Signal::stored(Some(shown.clone())) />
        <div class="acts">
            <CopyAs shown=Signal::stored(Some(shown.clone())) />
            <a class="button" href=href(View::Build, &link)>
                <Icon glyph=Glyph::Edit />
                "Edit in Build"
            </a>
            <a class="button" href=href(View::Read, &link)>
                <Icon glyph=Glyph::Read />
                "Read by itself"
            </a>
        </div>
        <CheckResult shown=shown.clone() lights />
        <details class="fold" open=true>
            <summary>"Fields"</summary>
            <FieldTable rows=Signal::stored(table) lights label="Fields" />
        </details>
        {has_registers
            .then(|| {
                view! {
                    <Fold summary=|| "All interpretations of these registers">
                        <Registers shown=shown.clone() lights />
                    </Fold>
                }
            })}
        <Lines text places />
    }
}

/// The lines of the log, with the telegram's bytes marked.
#[component]
fn Lines(text: String, places: Vec<(usize, usize)>) -> impl IntoView {
    if text.is_empty() {
        return None;
    }
    // Bytes with nothing but blanks between them are one mark: each would be told by itself.
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for (from, to) in places {
        match runs.last_mut() {
            Some((_, end)) if text.get(*end..from).is_some_and(|gap| gap.trim().is_empty()) => *end = to,
            _ => runs.push((from, to)),
        }
    }
    let mut at = 0;
    let mut pieces = Vec::new();
    for (from, to) in runs {
        let (Some(between), Some(byte)) = (text.get(at..from), text.get(from..to)) else { break };
        pieces.push(view! {
            {between.to_owned()}
            <mark>{byte.to_owned()}</mark>
        });
        at = to;
    }
    let rest = text.get(at..).unwrap_or_default().to_owned();
    Some(view! {
        <details class="fold" open=true>
            <summary>"In the log"</summary>
            <pre class="source" tabindex="0" role="region" aria-label="In the log">
                {pieces}
                {rest}
            </pre>
        </details>
    })
}

/// Bytes between the telegrams.
#[component]
fn Discarded(told: messages::Shown) -> impl IntoView {
    const SHOWN: usize = 2000;
    let bytes = told.discarded.unwrap_or_default();
    let more = if bytes.len() > SHOWN { " …" } else { "" };
    let text = hex(&bytes[..bytes.len().min(SHOWN)]) + more;
    view! {
        <h3 class="says">{Message::bytes(bytes.len()).to_string()} " that belong to no telegram."</h3>
        <pre class="source" tabindex="0" role="region" aria-label="The bytes">{text}</pre>
        <div class="acts">
            <CopyButton text=hex(&bytes) label="Copy as hex" />
        </div>
    }
}

/// What a person notes on the telegram.
#[component]
fn Note() -> impl IntoView {
    let log = expect_context::<ReadState>().log;
    let text = move || {
        let number = log.current.with(|current| current.as_ref().map(|it| it.told.row.index + 1))?;
        log.notes.with(|notes| notes.get(&number).cloned())
    };
    view! {
        <label class="own-note">
            <span>"Note (included in exports)"</span>
            <input
                class="input"
                autocomplete="off"
                prop:value=move || text().unwrap_or_default()
                on:input=move |event| log.note(&event_target_value(&event))
            />
        </label>
    }
}
