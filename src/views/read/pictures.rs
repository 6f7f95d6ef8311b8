//! What comes of a telegram, of a log, and of a wrong checksum: three examples as they are really read.

use std::sync::Arc;

use leptos::prelude::*;

use super::examples::{FLOW_CONTROL, LOG, example};
use crate::components::byte_strip::{ByteStrip, Lights, blocks};
use crate::components::state_badge::{StateBadge, class};
use crate::components::telegram::Shown;
use buslens::field::{Direction, in_order, many};
use buslens::tool::log::State;
use buslens::tool::{Options, Profile, Report, decode};

/// They show what will be; nothing in them can be pressed.
#[component]
pub fn Pictures() -> impl IntoView {
    view! {
        <OneTelegram />
        <ALog />
        <ACause />
    }
}

fn read(text: &str, device: &str) -> Arc<Report> {
    Arc::new(decode(text, Options { device: Profile::of(device), ..Options::default() }))
}

#[component]
fn OneTelegram() -> impl IntoView {
    let first = example("memograph_channels")?;
    let report = read(first.text, first.device);
    let shown = Shown::of(&report, 1, &Options::default())?;
    let strip = blocks(&shown.detail, shown.bytes());
    Some(view! {
        <figure>
            <figcaption>
                <strong>"One telegram"</strong>
                " becomes a sentence and its fields"
            </figcaption>
            <p class="says">{shown.detail.meaning().sentence()} "."</p>
            <div inert=true>
                <ByteStrip blocks=Signal::stored(strip) lights=Lights::new() size="small" />
            </div>
        </figure>
    })
}

#[component]
fn ALog() -> impl IntoView {
    const WIDTH: usize = 620;
    const HIGH: usize = 20;
    let report = read(LOG, "");
    let mut units = in_order(report.telegrams.iter().filter_map(|telegram| telegram.unit), |unit| *unit);
    units.dedup();
    let states: Vec<State> = (0..report.telegrams.len()).map(|index| report.state(index)).collect();
    let marks: Vec<_> = report
        .telegrams
        .iter()
        .zip(&states)
        .enumerate()
        .filter_map(|(index, (telegram, state))| {
            let row = units.iter().position(|unit| Some(*unit) == telegram.unit)?;
            let (x, y) = (index * WIDTH / states.len(), row * HIGH);
            let high = if telegram.guess.direction == Direction::Request { HIGH / 3 } else { HIGH * 2 / 3 };
            Some(view! {
                <rect x=x y=y + HIGH - high - 2 width="3" height=high class=class(*state).unwrap_or("plain") />
            })
        })
        .collect();
    let wrong = [State::Unanswered, State::Damaged, State::Slow].map(|wanted| {
        let count = states.iter().filter(|state| **state == wanted).count();
        let noun = if wanted == State::Unanswered { "request" } else { "response" };
        (count > 0).then(|| {
            view! {
                <li>
                    {many(count, noun)}
                    <StateBadge state=wanted latency=None />
                </li>
            }
        })
    });
    let height = units.len() * HIGH;
    view! {
        <figure>
            <figcaption>
                <strong>"A log"</strong>
                " becomes a story with findings"
            </figcaption>
            <p class="says">{format!("{} of {}: what is wrong?", many(states.len(), "telegram"), many(units.len(), "unit"))}</p>
            <svg viewBox=format!("0 0 {WIDTH} {height}") aria-hidden="true">
                {marks}
            </svg>
            <ul>{wrong.into_iter().collect_view()}</ul>
        </figure>
    }
}

#[component]
fn ACause() -> impl IntoView {
    let broken = example(FLOW_CONTROL)?;
    let report = read(broken.text, broken.device);
    let shown = Shown::of(&report, 1, &Options::default())?;
    let cause = report.explanations(1).into_iter().next()?;
    let found = shown.bytes().to_vec();
    let cells = |(at, byte): (usize, &u8)| {
        let text = format!("{byte:02X}");
        match cause.added.iter().any(|span| span.contains(at)) {
            true => view! { <mark class="good">{text}</mark> " " }.into_any(),
            false => format!("{text} ").into_any(),
        }
    };
    let corrected: Vec<_> = cause.hypothesis.bytes.iter().enumerate().map(cells).collect();
    Some(view! {
        <figure>
            <figcaption>
                <strong>"A wrong CRC"</strong>
                " becomes a cause"
            </figcaption>
            <p class="says">{cause.said.sentence()} "."</p>
            <code>{corrected}</code>
            <p class="note">{cause.hypothesis.text(&found).sentence()} "."</p>
        </figure>
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pictures_show_what_they_are_to_show() {
        let first = example("memograph_channels").expect("listed");
        let said = read(first.text, first.device).detail(1).expect("two").said.to_string();
        assert_eq!(said, "unit 1 answers: Universal channel 1 = 82.4724, good");
        let report = read(LOG, "");
        let states: Vec<State> = (0..report.telegrams.len()).map(|index| report.state(index)).collect();
        assert!(states.contains(&State::Unanswered) && states.contains(&State::Damaged));
        let broken = example(FLOW_CONTROL).expect("listed");
        let causes = read(broken.text, broken.device).explanations(1);
        assert_eq!(causes[0].said.to_string(), "unit 1 answers: Universal channel 1 = 36.32, good");
    }
}
