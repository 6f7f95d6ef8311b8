//! What the log says as a whole: a sentence, its units, and what is wrong.

use leptos::ev::KeyboardEvent;
use leptos::html;
use leptos::prelude::*;

use crate::components::icon::{Glyph, Icon};
use crate::components::roving;
use crate::views::read::ReadState;
use crate::views::read::reading::SeenList;
use crate::views::read::times::duration;
use crate::worker::messages::{Found, Proposed};
use buslens::field::many;
use buslens::tool::log::Unit;

#[component]
pub fn Overview() -> impl IntoView {
    let log = expect_context::<ReadState>().log;
    let headline = move || log.overview.with(|it| it.as_ref().map(|it| it.headline.clone()));
    let fault = move || {
        log.overview
            .with(|it| it.as_ref()?.fault.clone())
            .map(|fault| view! { <p class="refused">{fault}</p> })
    };
    let units = move || log.overview.with(|it| it.as_ref().map_or(Vec::new(), |it| it.units.clone()));
    let unit = move |unit: Unit| {
        let (number, port) = (unit.unit, unit.port);
        let choose = move |_| {
            log.filter_by(|filter| {
                filter.unit = number;
                filter.port = Some(port).filter(|_| number.is_some());
            });
            log.to_list.notify();
        };
        let name = number.map_or("The line".to_owned(), |number| format!("Unit {number}"));
        view! {
            <li>
                <button type="button" class="link" on:click=choose>
                    {name}
                </button>
                ": "
                {said(&unit)}
            </li>
        }
    };
    // More are in the table of units.
    const UNITS: usize = 6;
    let more = move || {
        let more = units().len().saturating_sub(UNITS);
        (more > 0).then(|| view! { <li class="soft">{format!("and {} more", many(more, "unit"))}</li> })
    };
    view! {
        <section class="story" aria-label="What the log shows">
            <div>
                <h2>{move || headline()}</h2>
                {fault}
                <ul class="units note">
                    {move || units().into_iter().take(UNITS).map(unit).collect_view()} {more}
                </ul>
                <ProposedDevices />
                {move || {
                    let seen = log.seen.get();
                    (!seen.is_empty()).then(|| view! { <SeenList seen /> })
                }}
            </div>
            <Findings />
        </section>
    }
}

/// The devices that units look like, where none is chosen.
#[component]
fn ProposedDevices() -> impl IntoView {
    /// One for each device is enough.
    const MOST: usize = 3;
    let read = expect_context::<ReadState>();
    let proposed = move |proposed: Proposed| {
        let choose = move |_| read.read_as(|choices| choices.device.clone_from(&proposed.device));
        view! {
            <p class="proposed">
                {proposed.text}
                " "
                <button type="button" class="button low" on:click=choose>
                    "Use it"
                </button>
            </p>
        }
    };
    move || {
        let mut proposals = read.log.proposals.get();
        let mut devices = Vec::new();
        proposals.retain(|proposed| {
            let first = !devices.contains(&proposed.device);
            devices.push(proposed.device.clone());
            first
        });
        proposals.into_iter().take(MOST).map(proposed).collect_view()
    }
}

/// What became of the requests to a unit.
fn said(unit: &Unit) -> String {
    let mut said = if unit.requests > 0 {
        format!("{} of {} answered", unit.answered, unit.requests)
    } else {
        many(unit.telegrams, "telegram")
    };
    if let Some(median) = unit.median {
        said += &format!(", usually after {}", duration(median.into()));
    }
    for (n, noun) in [(unit.damaged, "damaged"), (unit.refused, "rejected")] {
        if n > 0 {
            said += &format!(", {n} {noun}");
        }
    }
    said
}

/// What is wrong, each with a button to its telegrams.
#[component]
fn Findings() -> impl IntoView {
    let log = expect_context::<ReadState>().log;
    let remarks = move || log.overview.with(|it| it.as_ref().map_or(Vec::new(), |it| it.remarks.clone()));
    let list = NodeRef::<html::Ol>::new();
    // The finding that Tab leads to.
    let stop = RwSignal::new(0);
    let keys = move |event: KeyboardEvent| {
        let to = list.get_untracked().and_then(|list| roving::follow(&event, &list, "button"));
        to.into_iter().for_each(|to| stop.set(to));
    };
    let finding = move |(index, found): (usize, Found)| {
        // The first sentence says what it is, the others what to do.
        let (what, advice) = match found.text.split_once(". ") {
            Some((what, advice)) => (format!("{what}."), advice.to_owned()),
            None => (found.text.clone(), String::new()),
        };
        let count = found.evidence.len();
        view! {
            <li>
                <button
                    type="button"
                    tabindex=move || if stop.get() == index { "0" } else { "-1" }
                    aria-pressed=move || (log.finding.get() == Some(index)).to_string()
                    on:click=move |_| {
                        stop.set(index);
                        log.follow(index);
                    }
                >
                    <Icon glyph=Glyph::Warning />
                    <span class="text" title=found.text>
                        <b>{what}</b>
                        " "
                        <span class="soft">{advice}</span>
                    </span>
                    <span class="count">
                        {count}
                        <span class="unseen">" telegrams"</span>
                        <Icon glyph=Glyph::ChevronRight />
                    </span>
                </button>
            </li>
        }
    };
    move || {
        let findings = log.findings.get();
        if findings.is_empty() {
            // Nothing is wrong that has a name; the units are told beside it.
            let sentences: Vec<_> = remarks().into_iter().map(|text| view! { <li>{text}</li> }).collect();
            return view! { <ul class="findings none note">{sentences}</ul> }.into_any();
        }
        let findings = findings.into_iter().enumerate().map(finding).collect_view();
        // Others than before have a first one, too.
        stop.set(0);
        view! {
            <ol class="findings" aria-label="What the log shows to be wrong" node_ref=list on:keydown=keys>
                {findings}
            </ol>
        }
        .into_any()
    }
}
