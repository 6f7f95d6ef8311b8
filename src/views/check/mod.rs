//! Check: how a check follows from the bytes, step by step.

mod algorithms;
mod register;
mod state;
mod steps;

use std::time::Duration;

use leptos::ev::MouseEvent;
use leptos::prelude::*;
use web_sys::HtmlInputElement;

use crate::components::copy_button::CopyButton;
use crate::components::icon::{Glyph, Icon};
use crate::components::segments::Segments;
use algorithms::Algorithms;
use buslens::field::{hex, hex_value};
use buslens::tool::steps::{Algorithm, CHECKS, MOST};
use register::{Registers, Why, Worth};
pub use state::{CheckState, link_to};
use state::{Ending, Work};
use steps::{Bytes, Player, StepList};

#[component]
pub fn Check() -> impl IntoView {
    let state = expect_context::<CheckState>();
    let work = state.work();
    view! {
        <div class="check">
            <h2 class="unseen">"Check: how a CRC or checksum is calculated"</h2>
            <Input />
            <Outcome />
            <Show when=move || work.with(|work| work.covered > 0)>
                <div class="columns">
                    <section aria-label="Calculation">
                        <Calculation />
                        <Worth />
                    </section>
                    <section class="rail" aria-label="Steps and other algorithms">
                        <StepList />
                        <Algorithms />
                    </section>
                </div>
            </Show>
        </div>
    }
}

/// The steps of a check one by one: bytes, player, registers, and why. Its state is in the context.
#[component]
pub fn Calculation() -> impl IntoView {
    let state = expect_context::<CheckState>();
    let work = state.work();
    Effect::new(move || {
        /// Time enough to see what changes.
        const PACE: Duration = Duration::from_millis(450);
        let tick = move || {
            if state.at() < work.with_untracked(Work::last) {
                state.forward();
            } else {
                state.playing.set(false);
            }
        };
        if state.playing.get()
            && let Ok(playing) = set_interval_with_handle(move || untrack(tick), PACE)
        {
            on_cleanup(move || playing.clear());
        }
    });
    // Who comes back finds the step, not the play.
    on_cleanup(move || state.playing.set(false));
    view! {
        <Bytes />
        <Player />
        <Registers />
        <Why />
    }
}

/// What the check is called in short.
const fn short(algorithm: &Algorithm) -> &'static str {
    match (algorithm.width, algorithm.kind.as_bytes()) {
        (2, _) => "CRC",
        (_, b"lrc") => "LRC",
        _ => "FCS",
    }
}

/// What the check is called in a list.
fn title(kind: &str) -> &'static str {
    match kind {
        "crc-16/modbus" => "CRC-16/MODBUS (Modbus RTU)",
        "lrc" => "LRC (Modbus ASCII)",
        _ => "FCS (PROFIBUS)",
    }
}

#[component]
fn Input() -> impl IntoView {
    let state = expect_context::<CheckState>();
    let work = state.work();
    // The last bytes are a check or not: what they are called depends on the check.
    let ending = move || {
        let algorithm = work.with(|work| work.algorithm);
        let (bytes, are) =
            if algorithm.width == 1 { ("The last byte", "is") } else { ("The last two bytes", "are") };
        let name = short(algorithm);
        view! {
            <div class="entry">
                <span class="name" aria-hidden="true">{bytes}</span>
                <Segments
                    label=bytes
                    options=vec![
                        (Ending::Check, format!("{are} the {name}")),
                        (Ending::Data, format!("{are} data")),
                    ]
                    value=Signal::derive(move || state.ending())
                    on_choose=Callback::new(move |ending| state.choose_ending(ending))
                    class="wide"
                />
            </div>
        }
    };
    let kind = Memo::new(move |_| work.with(|work| work.algorithm.kind));
    let option = move |check: &&'static Algorithm| {
        let own = check.kind;
        view! { <option value=own prop:selected=move || kind.get() == own>{title(own)}</option> }
    };
    // Who comes with bytes of his own types or pastes them in place of the example. The next click is for a byte
    // of it.
    let comes = StoredValue::new(false);
    let click = move |event: MouseEvent| {
        if comes.try_update_value(std::mem::take) == Some(true) && state.is_example() {
            event_target::<HtmlInputElement>(&event).select();
        }
    };
    view! {
        <section class="bar" aria-label="Input">
            <label class="entry">
                <span class="name">"Bytes to check, in hex"</span>
                <input
                    class="input mono"
                    autocomplete="off"
                    spellcheck="false"
                    aria-invalid=move || work.with(|work| work.nonsense).to_string()
                    prop:value=move || state.text()
                    on:focus=move |_| comes.set_value(true)
                    on:click=click
                    on:input=move |event| state.enter(event_target_value(&event))
                />
            </label>
            <label class="entry">
                <span class="name">"Algorithm"</span>
                <select
                    class="select"
                    on:change=move |event| state.choose_algorithm(&event_target_value(&event))
                >
                    {CHECKS.iter().map(option).collect_view()}
                </select>
            </label>
            {move || {
                kind.track();
                ending()
            }}
        </section>
    }
}

/// The result, whatever step is shown.
#[component]
fn Outcome() -> impl IntoView {
    let state = expect_context::<CheckState>();
    let work = state.work();
    let name = move || work.with(|work| short(work.algorithm));
    let wire = Signal::derive(move || work.with(|work| hex(&work.wire())));
    let number =
        Signal::derive(move || work.with(|work| hex_value(work.value(), work.algorithm.width).to_string()));
    let there = move || work.with(|work| work.covered > 0);
    let value = move |shown: Signal<String>| {
        view! {
            <dd>
                <span>{move || if there() { shown.get() } else { "–".to_owned() }}</span>
                <Show when=there>
                    <CopyButton
                        text=shown
                        label=Signal::derive(move || format!("Copy {}", shown.get()))
                        icon_only=true
                        class="plain low"
                    />
                </Show>
            </dd>
        }
    };
    view! {
        <section class="outcome" aria-label="Result">
            <dl>
                <div>
                    <dt>{move || format!("{} on the wire", name())}</dt>
                    {value(wire)}
                </div>
                <div>
                    <dt>{move || format!("{} as a number", name())}</dt>
                    {value(number)}
                </div>
            </dl>
            <p class="note">{move || work.with(about)}</p>
            {move || work.with(|work| verdict(work, &state.text()))}
        </section>
    }
}

/// What the result is of.
fn about(work: &Work) -> String {
    if work.covered == 0 {
        return String::new();
    }
    let over = match work.covered {
        1 => "Calculated over byte 0.".to_owned(),
        covered => format!("Calculated over bytes 0 to {}.", covered - 1),
    };
    let order = if work.algorithm.low_first { " Modbus sends the low byte first." } else { "" };
    let dropped = if work.bytes.len() > MOST {
        format!(" Only the first {MOST} bytes count here: no telegram has more.")
    } else {
        String::new()
    };
    over + order + &dropped
}

/// Whether the check that is there is right.
fn verdict(work: &Work, text: &str) -> impl IntoView + use<> {
    let name = short(work.algorithm);
    let (class, glyph, said) = match work.found() {
        _ if work.nonsense => {
            let start: String = text.trim().chars().take(24).collect();
            ("bad", Glyph::Warning, format!("“{start}” is no bytes. Write them in hex, such as 01 03 00 C8."))
        }
        _ if work.covered == 0 => {
            ("none", Glyph::Warning, "No bytes yet. Write them in hex, such as 01 03 00 C8.".to_owned())
        }
        Some(found) if *found == *work.wire() => {
            ("good", Glyph::Tick, format!("The {name} in these bytes is valid"))
        }
        Some(found) => ("bad", Glyph::Warning, format!("{} is not the {name} of these bytes", hex(found))),
        None if work.algorithm.width == 2 && work.value() == 0 && work.covered > 2 => {
            ("good", Glyph::Tick, "0000h over a whole frame: its last two bytes are its valid CRC".to_owned())
        }
        None => return None,
    };
    Some(view! {
        <p class=format!("verdict {class}") role="status">
            {(class != "none").then(|| view! { <Icon glyph /> })}
            {said}
        </p>
    })
}
