//! Logs: what a customer sent, whole.

use leptos::prelude::*;
use maud::html;
use web_sys::{Element, Event, HtmlInputElement};

use crate::app::browser::{self, DETAIL, DEVICE, FILE, LIST, PROTOCOL};
use crate::app::components::{Drawn, detail, drawn, header, input, list, menu};
use crate::app::logs::desk::{Desk, Stage, now};
use buslens::field::{Span, grouped, many};

/// An event of the page, for the part that it concerns.
pub fn hear(desk: Desk, event: &Event) {
    let kind = event.type_();
    menu::hear(&kind, event);
    header::hear(&kind, event);
    match kind.as_str() {
        "dragover" => event.prevent_default(),
        "drop" => {
            event.prevent_default();
            match browser::file(event) {
                Some(file) => desk.open(file.clone().into(), file.name()),
                None => {
                    if let Some(text) = browser::pasted(event) {
                        desk.paste(&text);
                    }
                }
            }
        }
        "paste" if !browser::is_field(event) || browser::id(event) == PASTE => {
            if let Some(text) = browser::pasted(event) {
                event.prevent_default();
                desk.paste(&text);
            }
        }
        "change" => change(desk, event),
        "input" if browser::id(event) == "text" => desk.filter_by("text", &browser::value(event)),
        "input" if browser::id(event) == "note" => desk.note(&browser::value(event)),
        "click" => click(desk, event),
        "keydown" => key(desk, event),
        "scroll" if browser::id(event) == LIST => {
            if let Some(list) = browser::element::<Element>(LIST) {
                desk.scroll(list.scroll_top().max(0) as usize);
            }
        }
        "pointerover" if browser::closest(event, "#detail").is_some() => browser::light(browser::span(event)),
        "pointerleave" if browser::id(event) == DETAIL => browser::light(None),
        _ => {}
    }
}

/// A short log: unit 9 is silent, and a converter swallows bytes 11h and 13h.
const EXAMPLE: &str = include_str!("example.log");

/// The id of the field to paste into.
const PASTE: &str = "paste";

fn change(desk: Desk, event: &Event) {
    let value = browser::value(event);
    match browser::id(event).as_str() {
        FILE => {
            if let Some(file) = browser::file(event) {
                desk.open(file.clone().into(), file.name());
            }
        }
        id @ (PROTOCOL | DEVICE | "input" | "numbers") => desk.read_as(id, &value),
        id @ ("wanted" | "unit" | "function" | "way" | "port") => desk.filter_by(id, &value),
        _ => {}
    }
}

fn click(desk: Desk, event: &Event) {
    let number = |name: &str| browser::attribute(event, name).and_then(|text| text.parse::<usize>().ok());
    if let Some(text) = browser::attribute(event, "data-copy") {
        browser::copy(&text);
        browser::say("Copied.");
    } else if let Some(index) = number("data-entry") {
        desk.find(index);
    } else if let Some(place) = number("data-place") {
        desk.select(place);
    } else if let Some(finding) = number("data-finding") {
        desk.show_finding(finding);
    } else if let Some(kind) = browser::attribute(event, "data-export") {
        desk.export(&kind);
        menu::close(event);
    } else if let Some(dialog) = browser::attribute(event, "data-dialog") {
        let (unit, function) = dialog.split_once(',').unwrap_or_default();
        for (id, value) in [("unit", unit), ("function", if function == "0" { "" } else { function })] {
            browser::set_field(id, value);
            desk.filter_by(id, value);
        }
    } else if browser::attribute(event, "data-from").is_some() {
        stretch(desk, event);
    } else if browser::attribute(event, "data-all").is_some() {
        all(desk);
    } else if let Some(part) = browser::attribute(event, "data-mark") {
        mark(desk, &part);
    } else if let Some(what) = browser::attribute(event, "data-do") {
        match what.as_str() {
            "stop" => desk.stop(),
            "example" => desk.paste(EXAMPLE),
            "next" => desk.step(true),
            "previous" => desk.step(false),
            "series" => {
                let value = |id: &str| {
                    browser::element::<HtmlInputElement>(id).map_or(String::new(), |field| field.value())
                };
                desk.draw_series(&value("series-unit"), &value("series-register"));
            }
            "again" => desk.forget_marks(),
            "unread" | "sample" => desk.ask(&what),
            _ => {}
        }
    } else if let Some(group) = browser::closest(event, "button.group") {
        detail::open_or_close(&group, None);
    }
}

/// Only the telegrams of a bar of the timeline are to be seen.
fn stretch(desk: Desk, event: &Event) {
    let edge = |name| browser::attribute(event, name).unwrap_or_default();
    let key = if browser::attribute(event, "data-timed").is_some() { "times" } else { "places" };
    desk.filter_by(key, &format!("{}..{}", edge("data-from"), edge("data-to")));
}

/// Everything is to be seen.
fn all(desk: Desk) {
    for id in ["wanted", "unit", "function", "way", "port", "text"] {
        browser::set_field(id, if id == "wanted" { "all" } else { "" });
    }
    desk.show_all();
}

/// What is selected in the sample line is a part of it.
fn mark(desk: Desk, part: &str) {
    let Some(field) = browser::element::<HtmlInputElement>("sample") else { return };
    let (from, to) = (field.selection_start().ok().flatten(), field.selection_end().ok().flatten());
    let (Some(from), Some(to)) = (from, to) else { return };
    if from >= to {
        browser::say("Select the part in the line first, with the mouse or with Shift and the arrow keys.");
        return;
    }
    let text = field.value();
    let byte = |units: u32| input::byte_offset(&text, units as usize);
    desk.mark(part, Span::new(byte(from), byte(to)));
}

fn key(desk: Desk, event: &Event) {
    let key = browser::key(event);
    if let Some(stop) = browser::closest(event, "svg [data-stop]") {
        let stops =
            stop.closest("svg").ok().flatten().map_or(Vec::new(), |svg| browser::all(&svg, "[data-stop]"));
        let at = stops.iter().position(|other| *other == stop).unwrap_or(0);
        let to = match key.as_str() {
            "ArrowRight" => at + 1,
            "ArrowLeft" => at.saturating_sub(1),
            "Home" => 0,
            "End" => usize::MAX,
            "Enter" | " " => {
                event.prevent_default();
                return click(desk, event);
            }
            _ => return,
        };
        event.prevent_default();
        if let Some(next) = stops.get(to.min(stops.len().saturating_sub(1))) {
            browser::rove(&stops, next);
        }
        return;
    }
    if browser::closest(event, "#detail [data-stop]").is_some() {
        return detail::go_among(event);
    }
    if browser::id(event) != LIST {
        return;
    }
    let at = desk.place.get_untracked().unwrap_or(0);
    if let Some(to) = list::aim(event, at, desk.total.get_untracked().0) {
        desk.select(to);
    }
}

#[component]
pub fn Logs(desk: Desk) -> impl IntoView {
    let nothing: Drawn<bool> = Box::new(move || desk.telegram.with(String::is_empty));
    view! {
        <header::Header here="logs.html" />
        <main id="main" class="panes logs" tabindex="-1">
            <div class="column">
                <section class="card open" aria-label="Log">
                    <div inner_html=opening().into_string()></div>
                    <details class="more-settings">
                        <summary>"Device, protocol, and how it is read"</summary>
                        <div class="settings" inner_html=Box::new(move || desk.settings.get()) as Drawn></div>
                    </details>
                    <div inner_html=drawn(move || stage(desk)) aria-live="polite"></div>
                    <div class="story" inner_html=Box::new(move || desk.story.get()) as Drawn></div>
                    <div class="findings" inner_html=Box::new(move || desk.findings.get()) as Drawn></div>
                    <p id="status" role="status" class="unseen"></p>
                    <div hidden=unless_ready(desk) inner_html=lower().into_string()></div>
                    <div inner_html=Box::new(move || desk.unread.get()) as Drawn></div>
                </section>
                <section class="card" aria-label="Over time" hidden=unless_ready(desk)>
                    <div inner_html=Box::new(move || desk.picture.get()) as Drawn></div>
                    <details class="layout" open=true>
                        <summary>"Units and functions"</summary>
                        <div inner_html=Box::new(move || desk.table.get()) as Drawn></div>
                    </details>
                    <details class="layout">
                        <summary>"A register over time"</summary>
                        <div inner_html=asks_register().into_string()></div>
                        <div inner_html=Box::new(move || desk.series.get()) as Drawn></div>
                    </details>
                </section>
                <Telegrams desk />
            </div>
            <section id=DETAIL class="card detail" aria-label="Telegram" hidden=nothing>
                <div inner_html=Box::new(move || desk.telegram.get()) as Drawn></div>
                <Note desk />
            </section>
        </main>
    }
}

/// Whether there is nothing to show yet.
fn unless_ready(desk: Desk) -> Drawn<bool> {
    Box::new(move || desk.stage.get() != Stage::Ready)
}

/// The list of telegrams, with what chooses among them above it.
#[component]
fn Telegrams(desk: Desk) -> impl IntoView {
    let current: Drawn =
        Box::new(move || desk.place.get().map_or(String::new(), |place| format!("telegram-{place}")));
    let rows: Drawn = Box::new(move || {
        let (above, below) = desk.space();
        // What is chosen now is drawn as such; what is chosen later is marked below.
        let place = desk.place.get_untracked().map(|place| format!("data-place=\"{place}\""));
        let chosen = |rows: &str| match &place {
            Some(place) => rows.replacen(place.as_str(), &format!("{place} aria-selected=\"true\""), 1),
            None => rows.to_owned(),
        };
        desk.rows.with(|(_, rows)| {
            [list::space(above).into_string(), chosen(rows), list::space(below).into_string()].concat()
        })
    });
    // The chosen row is marked by itself: drawing all rows anew would be felt.
    Effect::new(move |_| {
        desk.rows.track();
        let place = desk.place.get();
        let Some(list) = browser::element::<Element>(LIST) else { return };
        for row in browser::all(&list, "[role=option]") {
            let chosen = row.get_attribute("data-place").and_then(|text| text.parse().ok()) == place
                && place.is_some();
            let _ = row.set_attribute("aria-selected", if chosen { "true" } else { "false" });
        }
    });
    let lists: Drawn = Box::new(move || desk.lists.get());
    let found = drawn(move || {
        let (count_in_list, all) = desk.total.get();
        let filtered = desk.filter.with(|filter| !filter.is_empty());
        html! {
            @if filtered {
                (grouped(count_in_list)) " of " (many(all, "telegram")) " "
                button.link type="button" data-all="" { "show all" }
            } @else { (many(all, "telegram")) }
        }
    });
    view! {
        <section class="card telegrams" aria-labelledby="telegrams" hidden=unless_ready(desk)>
            <div class="settings" inner_html=lists></div>
            <div inner_html=search().into_string()></div>
            <p class="count" inner_html=found></p>
            <div inner_html=head().into_string()></div>
            <div id=LIST class="window" role="listbox" tabindex="0" aria-labelledby="telegrams" aria-activedescendant=current inner_html=rows></div>
        </section>
    }
}

/// What a person notes on a telegram.
#[component]
fn Note(desk: Desk) -> impl IntoView {
    let hidden: Drawn<bool> = Box::new(move || desk.telegram.with(String::is_empty));
    let markup = html! {
        label.title for="note" { "Your note on this telegram; it goes into exports" }
        input id="note" autocomplete="off";
    };
    view! { <div class="note-box" hidden=hidden inner_html=markup.into_string()></div> }
}

fn opening() -> maud::Markup {
    html! {
        label.title for=(PASTE) { "Open what the customer sent, drop it anywhere, or paste it here" }
        div.row-of {
            input.unseen id=(FILE) type="file";
            label.quiet.first for=(FILE) { "Open file" }
            textarea id=(PASTE) rows="1" spellcheck="false" placeholder="Paste a log" {}
        }
    }
}

/// What there is below the summary.
fn lower() -> maud::Markup {
    let exports = [
        ("txt", "Text"),
        ("csv", "CSV"),
        ("jsonl", "JSON Lines"),
        ("fields", "JSON Lines with fields"),
        ("hex", "Hex"),
        ("log", "Lines of the log"),
    ];
    html! {
        div.actions {
            details.menu {
                summary { "Export the list" }
                div.examples { @for (kind, label) in exports { button.quiet type="button" data-export=(kind) { (label) } } }
            }
            button.quiet type="button" data-do="unread" { "Show lines without bytes" }
            details.marking {
                summary { "Lines are read wrongly?" }
                p { "Take a line of the log, select a part of it, and say what it is. All lines are then read like that." }
                div.row-of {
                    button.quiet type="button" data-do="sample" { "Take a line" }
                    input id="sample" readonly aria-label="A line of the log";
                }
                div.actions {
                    @for (part, label) in [("bytes", "This is the bytes"), ("time", "This is the time"), ("request", "This says request"), ("response", "This says response")] {
                        button.quiet type="button" data-mark=(part) { (label) }
                    }
                    button.quiet type="button" data-do="again" { "Forget the marks" }
                }
            }
        }
    }
}

fn stage(desk: Desk) -> maud::Markup {
    match desk.stage.get() {
        Stage::Empty => html! {
            p { "Logs of any program and layout, hex dumps, raw bytes of a line, captures (pcap, pcapng). Large files are fine: nothing is sent anywhere." }
            p { button.quiet type="button" data-do="example" { "Try it with an example" } }
        },
        Stage::Reading { done, of, telegrams, since } => {
            let left = if done > 0.0 { (now() - since) / done * (of - done) / 1000.0 } else { 0.0 };
            html! {
                div.reading-on {
                    progress max=(of.max(1.0)) value=(done) aria-label="Read" {}
                    span { (format!("{:.0} %", done / of.max(1.0) * 100.0)) ", " (many(telegrams, "telegram")) @if left >= 1.0 { ", " (format!("{left:.0} s left")) } }
                    button.quiet type="button" data-do="stop" { "Stop" }
                }
            }
        }
        Stage::Refused(why) => html! { p.error role="alert" { (why) } },
        Stage::Ready => html! {},
    }
}

fn asks_register() -> maud::Markup {
    html! {
        div.row-of {
            label { span { "Unit" } input id="series-unit" inputmode="numeric" size="4"; }
            label { span { "Register" } input id="series-register" size="8" placeholder="200 or 0xC8"; }
            button.quiet type="button" data-do="series" { "Draw" }
        }
    }
}

fn search() -> maud::Markup {
    html! {
        div.row-of.search {
            input id="text" type="search" autocomplete="off" aria-label="Search" placeholder="Bytes, register, name, or any text of the log";
            button.quiet type="button" data-do="previous" { "‹ Error" }
            button.quiet type="button" data-do="next" { "Error ›" }
        }
    }
}

fn head() -> maud::Markup {
    html! {
        h2.unseen id="telegrams" { "Telegrams" }
        div.row.head aria-hidden="true" {
            @for title in ["#", "Time", "", "Unit", "What it says", "After", "Check"] { span { (title) } }
        }
    }
}
