//! One telegram: what it says, its bytes, its fields, its check.

use std::cell::RefCell;

use leptos::prelude::*;
use maud::{Markup, html};
use web_sys::{Element, Event};

use super::{Drawn, byte, check, drawn, examples, fields, layout, strip, views};
use crate::app::address::fragment;
use crate::app::browser::{self, DETAIL};
use crate::app::state::{Chosen, Decoded, Shown, State};
use buslens::field::{Direction, Message, Severity, hex};
use buslens::tool::link::Link;
use buslens::tool::{Certainty, Options, Protocol};

/// Buttons for what can be done with a telegram, to which a link is given.
pub type Actions = fn(&Shown, &str) -> Markup;

#[component]
pub fn Telegram(state: State, actions: Actions) -> impl IntoView {
    let before = RefCell::new(Pieces::default());
    let reading = drawn(move || {
        state.decoded.with(|decoded| {
            let pieces = decoded.shown.as_ref().map(Pieces::of).unwrap_or_default();
            pieces.show(&before.borrow());
            before.replace(pieces);
            browser::set_text("device-name", decoded.options.device.map_or("", |device| device.label));
            match &decoded.shown {
                Some(shown) => reading(shown, decoded, actions),
                None => welcome(),
            }
        })
    });
    // What depends on the chosen byte is drawn by itself: the byte keeps the focus.
    let byte = of_shown(state, move |shown, _| match state.chosen.get() {
        Some(chosen) => byte::byte(shown, chosen.at),
        None => html! {},
    });
    let registers =
        of_shown(state, move |shown, _| views::chosen(shown, state.chosen.get().map(|chosen| chosen.span)));
    let check = of_shown(state, |shown, decoded| check::check(shown, &decoded.options));
    let layout =
        of_shown(state, |shown, decoded| layout::layout(&shown.detail, &decoded.report.layout(shown.index)));
    let no_registers: Drawn<bool> = Box::new(move || state.decoded.with(|decoded| !has_registers(decoded)));
    let unchosen: Drawn<bool> = Box::new(move || state.chosen.get().is_none());
    let nothing: Drawn<bool> = Box::new(move || state.decoded.with(|decoded| decoded.shown.is_none()));
    view! {
        <section id=DETAIL class="card detail" aria-label="Telegram">
            <div inner_html=reading></div>
            <div id=STRIP class="strip" role="group" aria-label="Bytes. Arrow keys go from byte to byte."></div>
            <div inner_html=tables().into_string()></div>
            <div class="byte" role="region" aria-label="The chosen byte" aria-live="polite" hidden=unchosen inner_html=byte></div>
            <div inner_html=check></div>
            <details id="views" class="layout" hidden=no_registers>
                <summary>"Registers in every view"</summary>
                <div inner_html=registers></div>
            </details>
            <details id="layout" class="layout" hidden=nothing>
                <summary>"How such a telegram is made"</summary>
                <div inner_html=layout></div>
            </details>
        </section>
    }
}

/// What is drawn of the telegram that is shown; nothing where there is none.
fn of_shown(state: State, draw: impl Fn(&Shown, &Decoded) -> Markup + Send + 'static) -> Drawn {
    drawn(move || {
        state.decoded.with(|decoded| match &decoded.shown {
            Some(shown) => draw(shown, decoded),
            None => html! {},
        })
    })
}

fn has_registers(decoded: &Decoded) -> bool {
    decoded.shown.as_ref().is_some_and(|shown| shown.detail.registers.is_some())
}

pub fn hear(state: State, kind: &str, event: &Event) {
    let inside = browser::closest(event, "#detail");
    match kind {
        "pointerleave" if browser::id(event) == DETAIL => state.point(None),
        _ if inside.is_none() => {}
        "pointerover" => state.point(browser::span(event)),
        "click" => click(state, event),
        // A pointer chooses by its click: what is below must not move before that.
        "focusin" if browser::closest(event, "[data-stop]:focus-visible").is_some() => choose(state, event),
        "keydown" => go(state, event),
        _ => {}
    }
}

/// Cells and rows that the arrow keys lead to.
const STOP: &str = "[data-stop]";

fn click(state: State, event: &Event) {
    if let Some(index) = browser::attribute(event, "data-select").and_then(|index| index.parse().ok()) {
        state.select(index);
    } else if let Some(key) = browser::attribute(event, "data-protocol") {
        state.read_as(|options| options.protocol = Protocol::of(&key));
    } else if browser::attribute(event, "data-close").is_some() {
        state.choose(None);
    } else if let Some(text) = browser::attribute(event, "data-copy") {
        browser::copy(&text);
    } else if browser::span(event).is_some() {
        choose(state, event);
        if let Some(group) = browser::closest(event, "button.group") {
            open_or_close(&group, None);
        }
    }
}

fn choose(state: State, event: &Event) {
    let at = browser::attribute(event, "data-at").and_then(|at| at.parse().ok());
    state.choose(browser::span(event).map(|span| Chosen { span, at: at.unwrap_or(span.from) }));
}

fn go(state: State, event: &Event) {
    match browser::key(event).as_str() {
        "Escape" if browser::closest(event, STOP).is_some() => state.choose(None),
        _ => go_among(event),
    }
}

/// Arrow keys go from cell to cell and from row to row; left and right close and open a group.
pub fn go_among(event: &Event) {
    let Some(stop) = browser::closest(event, STOP) else { return };
    let Some(all) = stop.closest(".strip, .fields").ok().flatten().map(|root| browser::all(&root, STOP))
    else {
        return;
    };
    // Rows of a closed group have no boxes.
    let stops: Vec<Element> = all.into_iter().filter(|stop| stop.client_height() > 0).collect();
    let last = stops.len().saturating_sub(1);
    let at = stops.iter().position(|other| *other == stop).unwrap_or(0);
    let in_table = stop.class_list().contains("field");
    let key = browser::key(event);
    let to = match key.as_str() {
        "ArrowLeft" | "ArrowRight" if in_table => {
            open_or_close(&stop, Some(key == "ArrowRight"));
            at
        }
        "ArrowRight" | "ArrowDown" => (at + 1).min(last),
        "ArrowLeft" | "ArrowUp" => at.saturating_sub(1),
        "Home" => 0,
        "End" => last,
        _ => return,
    };
    event.prevent_default();
    browser::rove(&stops, &stops[to]);
}

/// Shows or hides the rows within the group of `button`.
pub fn open_or_close(button: &Element, open: Option<bool>) {
    let Some(now) = button.get_attribute("aria-expanded") else { return };
    let open = open.unwrap_or(now == "false");
    let _ = button.set_attribute("aria-expanded", if open { "true" } else { "false" });
    let depth = |row: &Element| row.get_attribute("data-depth").and_then(|depth| depth.parse::<usize>().ok());
    let Ok(Some(row)) = button.closest("tr") else { return };
    let within = std::iter::successors(row.next_element_sibling(), Element::next_element_sibling)
        .take_while(|other| depth(other) > depth(&row));
    for row in within {
        let _ = row.toggle_attribute_with_force("hidden", !open);
    }
}

/// What a person sees first.
fn welcome() -> Markup {
    html! {
        div.welcome {
            h2 { "What does this telegram say?" }
            p {
                "Paste the bytes of a Modbus or PROFIBUS telegram, or of several, one in a line. Every byte is \
                 explained, every check is checked, and what is wrong is said."
            }
            p.title { "Or start with an example" }
            div.examples { (examples::examples()) }
        }
    }
}

fn reading(shown: &Shown, decoded: &Decoded, actions: Actions) -> Markup {
    let telegram = &shown.telegram;
    // What somebody chose needs no reason.
    let by_hand = decoded.options.protocol.is_some() && decoded.options.direction.is_some();
    let direction = telegram.guess.told().map_or("telegram", Direction::key);
    let partner = telegram.answers.map(|index| ("answers telegram ", index));
    let partner = partner.or(telegram.answered_by.map(|index| ("answered by telegram ", index)));
    html! {
        p.title {
            "Telegram " (shown.index + 1) " of " (shown.of) " · " (telegram.choice.protocol.label) " " (direction)
            @if let Some((words, index)) = partner {
                " · " button.link type="button" data-select=(index) { (words) (index + 1) }
            }
        }
        h2 { (shown.detail.meaning().sentence()) "." }
        p.kind {
            (shown.detail.kind) "."
            @if !by_hand {
                " "
                @match telegram.guess.certainty {
                    Certainty::Certain => { "A " (direction) ": " (telegram.guess.reason) "." },
                    Certainty::Likely => { "Taken for a " (direction) ": " (telegram.guess.reason) "." },
                    Certainty::Open => { "Request or response? " (telegram.guess.reason.sentence()) "." },
                }
            }
        }
        @if !by_hand {
            p.kind {
                (telegram.choice.protocol.label) ": " (telegram.choice.reason) "."
                @if !telegram.choice.others.is_empty() {
                    " It could also be "
                    @for (index, (other, fit)) in telegram.choice.others.iter().enumerate() {
                        @if index > 0 { ", " }
                        button.link type="button" data-protocol=(other.key) title=(fit.reason) { (other.label) }
                    }
                    "."
                }
            }
        }
        (problems(shown))
        div.bar {
            p.count { (Message::bytes(shown.bytes().len())) ". Choose one to see how its value comes about." }
            div.actions { (actions(shown, &link(shown, decoded))) }
        }
    }
}

/// Where the bytes and the rows of the tables come.
const STRIP: &str = "strip";
const DEVICE_ROWS: &str = "device-rows";
const FIELD_ROWS: &str = "field-rows";

fn tables() -> Markup {
    html! {
        div id="device-table" hidden {
            h3.device id="device-name" {}
            (fields::table("Device", DEVICE_ROWS))
        }
        div id="field-table" hidden { (fields::table("Fields", FIELD_ROWS)) }
    }
}

/// What is drawn piece by piece: a telegram of 256 bytes has hundreds of cells and rows, of which a
/// keystroke changes a few.
#[derive(Default)]
struct Pieces {
    strip: Vec<String>,
    device: Vec<String>,
    fields: Vec<String>,
}

impl Pieces {
    fn of(shown: &Shown) -> Self {
        Self { strip: strip::strip(shown), device: fields::device(shown), fields: fields::fields(shown) }
    }

    fn show(&self, before: &Self) {
        browser::redraw(STRIP, &before.strip, &self.strip);
        browser::redraw(DEVICE_ROWS, &before.device, &self.device);
        browser::redraw(FIELD_ROWS, &before.fields, &self.fields);
        browser::hide("device-table", self.device.is_empty());
        browser::hide("field-table", self.fields.is_empty());
    }
}

/// The telegram by itself, read as it is here.
fn link(shown: &Shown, decoded: &Decoded) -> String {
    let direction = shown.telegram.guess.direction;
    let options = Options {
        protocol: Some(shown.telegram.choice.protocol),
        direction: Some(direction),
        ..decoded.options.clone()
    };
    fragment(&Link::to(hex(shown.bytes()), options))
}

/// What is wrong with a telegram, each with a button to its bytes.
pub fn problems(shown: &Shown) -> Markup {
    let problems = shown.detail.problems();
    html! {
        @if !problems.is_empty() {
            ul.problems {
                @for problem in problems {
                    @let (class, word) = match problem.severity {
                        Severity::Error => ("error", "Error"),
                        Severity::Warning => ("warning", "Warning"),
                    };
                    li class=(class) {
                        button type="button" data-span=(browser::span_text(problem.span)) {
                            span.unseen { (word) ": " }
                            span { (problem.message.sentence()) "." }
                        }
                    }
                }
            }
        }
    }
}
