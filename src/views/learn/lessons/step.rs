//! A step: where it is in its lesson, what it says, and what it shows.

use std::sync::Arc;

use leptos::context::Provider;
use leptos::prelude::*;

use super::line::Line;
use super::log::LogLines;
use super::sides::Sides;
use super::state::{Here, link_to};
use super::walk::Walk;
use crate::address::{View, href};
use crate::components::telegram::Shown;
use crate::views::check::{Calculation, CheckState, link_to as link_to_check};
use crate::views::learn::LearnState;
use crate::views::learn::words::Words;
use buslens::field::Span;
use buslens::tool::link::Link;
use buslens::tool::{Report, steps::CHECKS};
use buslens_trainer::lesson::{Show, Step};

/// The text of a step, and what is lit beside it.
#[component]
pub fn StepText(here: Here) -> impl IntoView {
    let Some(step) = here.step().cloned() else { return ().into_any() };
    let report = Arc::new(step.report());
    let text: Vec<_> = step
        .text
        .iter()
        .map(|text| {
            let text = step.filled_in(text);
            view! { <p><Words text /></p> }
        })
        .collect();
    let options = step.options();
    let shown: Vec<Shown> =
        (0..report.telegrams.len()).filter_map(|index| Shown::of(&report, index, &options)).collect();
    let walk =
        || (!shown.is_empty()).then(|| view! { <Walk step=step.clone() shown=shown.clone() /> }.into_any());
    let (above, body) = match step.show {
        Show::Bytes => (None, walk()),
        Show::Sides => (None, Some(view! { <Sides step=step.clone() shown=shown.clone() /> }.into_any())),
        Show::Checksum => (None, shown.first().cloned().map(|first| view! { <Checksum first /> }.into_any())),
        Show::Line(rate) => {
            let bytes = shown.iter().map(|shown| shown.bytes().to_vec()).collect::<Vec<_>>();
            (Some(view! { <Line rate bytes /> }.into_any()), walk())
        }
        Show::Log => (Some(view! { <LogLines step=step.clone() /> }.into_any()), walk()),
    };
    view! {
        <article class="step" aria-labelledby="step-title">
            <Way here=here.clone() />
            <h2 id="step-title" tabindex="-1">{step.title.clone()}</h2>
            <div class="prose">{text}</div>
            {above}
            {body}
            <Elsewhere step shown report />
        </article>
    }
    .into_any()
}

/// The lesson, and its steps to go to.
#[component]
fn Way(here: Here) -> impl IntoView {
    let state = expect_context::<LearnState>().lessons;
    let lesson = here.course.lesson.clone();
    let place = {
        let lesson = lesson.clone();
        move |at: usize| {
            let done = {
                let lesson = lesson.clone();
                move || state.is_done(&lesson, at)
            };
            let name = {
                let done = done.clone();
                let title = lesson.steps[at].title.clone();
                move || format!("Step {}: {title}{}", at + 1, if done() { ", done" } else { "" })
            };
            view! {
                <li>
                    <a
                        href=link_to(&lesson, at)
                        class:done=done
                        aria-current=(at == here.step).then_some("step")
                        aria-label=name.clone()
                        title=name
                    >
                        {at + 1}
                    </a>
                </li>
            }
        }
    };
    let steps: Vec<_> = (0..lesson.steps.len()).map(place).collect();
    view! {
        <div class="way">
            <a href="#/learn?place=lessons">"Lessons"</a>
            <span>{lesson.title.clone()}</span>
            <nav aria-label="Steps of this lesson">
                <ol>{steps}</ol>
            </nav>
        </div>
    }
}

/// The CRC of the first telegram, bit by bit.
#[component]
fn Checksum(first: Shown) -> impl IntoView {
    let state = CheckState::new();
    if let Some(check) = first.detail.check() {
        let span = Span::new(check.covered.from, check.covered.to + check.width);
        state.follow(link_to_check(span.of(first.bytes()), check.kind));
    }
    view! {
        <Provider value=state>
            <div class="check calculation">
                <Calculation />
            </div>
        </Provider>
    }
}

/// The same in the other views.
#[component]
fn Elsewhere(step: Step, shown: Vec<Shown>, report: Arc<Report>) -> impl IntoView {
    let lines: Vec<&str> = step.telegrams.iter().map(|telegram| telegram.text.as_str()).collect();
    let text = if step.log.is_empty() { lines.join("\n") } else { step.log.clone() };
    if text.is_empty() {
        return ().into_any();
    }
    let telegram = report.telegrams.len().saturating_sub(1);
    let read = href(View::Read, &Link { telegram, ..Link::to(text, step.options()) });
    let last = shown.last().cloned();
    let build = last.as_ref().map(|last| href(View::Build, &last.link()));
    let check = last.as_ref().and_then(|last| {
        let check = last.detail.check().filter(|check| CHECKS.iter().any(|it| it.kind == check.kind))?;
        let span = Span::new(check.covered.from, check.covered.to + check.width);
        Some(href(View::Check, &link_to_check(span.of(last.bytes()), check.kind)))
    });
    view! {
        <p class="elsewhere">
            "Open in "
            <a href=read>"Read"</a>
            {build.map(|to| view! { ", " <a href=to>"Build"</a> })}
            {check.map(|to| view! { ", " <a href=to>"Check"</a> })}
        </p>
    }
    .into_any()
}
