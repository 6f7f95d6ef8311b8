//! The paper: a table of all telegrams, then each with its fields.

use std::sync::Arc;

use leptos::prelude::*;
use web_sys::js_sys::{Date, Object, Reflect};

use super::SpelledOut;
use crate::components::byte_strip::{blocks, role_class};
use crate::components::state_badge::StateBadge;
use crate::views::outgoing::DigestView;
use crate::views::read::ReadState;
use buslens::field::{Direction, Field, Message, Severity, hex, many};
use buslens::tool::digest::Digest;
use buslens::tool::{Detail, Report, Telegram, Verdict, annotated};

/// More rows are for a file, not for paper.
const MOST_ROWS: usize = 1000;
/// More telegrams are not spelled out.
const MOST_SPELLED_OUT: usize = 200;

#[component]
pub fn Paper(
    report: Signal<Arc<Report>>,
    /// What was read in short, once that is known.
    #[prop(into)]
    digest: Signal<Option<Arc<Digest>>>,
    is_log: Signal<bool>,
    #[prop(into)] title: Signal<String>,
    #[prop(into)] spelled_out: Signal<SpelledOut>,
) -> impl IntoView {
    let read = expect_context::<ReadState>();
    let head = move || {
        let device = read.options().device.map(|device| device.label);
        let facts = [read.file_name(), device.map(str::to_owned), Some(today())];
        let facts: Vec<String> = facts.into_iter().flatten().collect();
        let shown = title.get();
        view! {
            <header>
                <h2>{if shown.is_empty() { "Field-bus telegrams".to_owned() } else { shown }}</h2>
                <p>{facts.join(" · ")}</p>
                {(!is_log.get())
                    .then(|| view! { <p>{report.with(|report| annotated::summary(report).trim_end().to_owned())}</p> })}
            </header>
        }
    };
    let count = Memo::new(move |_| report.with(|report| report.telegrams.len()));
    // What matters of a log comes first, and says more than a table of all.
    let short = move || {
        let digest = digest.get().filter(|_| is_log.get())?;
        let digest = Arc::new(Digest { title: String::new(), ..(*digest).clone() });
        Some(view! { <DigestView digest with_bytes=true /> })
    };
    let table = move || (!is_log.get()).then(|| report.with(|report| table(report)));
    let details = move || {
        let report = report.get();
        let wanted = |index: &usize| match spelled_out.get() {
            SpelledOut::All => true,
            SpelledOut::Wrong => is_wrong(&report, *index),
            SpelledOut::None => false,
        };
        let indices: Vec<usize> = (0..report.telegrams.len()).filter(wanted).collect();
        let more = indices.len().saturating_sub(MOST_SPELLED_OUT);
        let shown = indices.into_iter().take(MOST_SPELLED_OUT);
        let telegrams = shown.filter_map(|index| telegram(&report, index)).collect_view();
        let more = (more > 0).then(|| {
            view! { <p class="more">{format!("{} not spelled out here: a file holds them all.", many(more, "more telegram"))}</p> }
        });
        view! {
            {telegrams}
            {more}
        }
    };
    view! {
        <article class="paper" aria-label="What is printed">
            {move || head()}
            <Show
                when=move || count.get() != 0 || is_log.get()
                fallback=|| view! { <p>"Nothing to print yet. Paste telegrams in Read first."</p> }
            >
                {move || short()}
                {move || table()}
                {move || details()}
            </Show>
            <footer>"Made with Buslens"</footer>
        </article>
    }
}

/// Date and time as the person writes them, with the name of the month: 3/4 is two days.
fn today() -> String {
    let style = Object::new();
    for (what, how) in [("dateStyle", "long"), ("timeStyle", "short")] {
        // A plain object takes every key.
        let _ = Reflect::set(&style, &what.into(), &how.into());
    }
    Date::new_0().to_locale_string("default", &style).into()
}

fn is_wrong(report: &Report, index: usize) -> bool {
    let faulty = || {
        let detail = report.detail(index);
        detail.is_some_and(|it| it.problems().iter().any(|problem| problem.severity == Severity::Error))
    };
    report.state(index).is_wrong() || faulty()
}

fn arrow(telegram: &Telegram) -> &'static str {
    match telegram.guess.told() {
        Some(Direction::Request) => "→",
        Some(Direction::Response) => "←",
        None => "",
    }
}

/// A line for each telegram.
fn table(report: &Report) -> impl IntoView + use<> {
    let timed = report.telegrams.iter().any(|telegram| telegram.time.is_some());
    let row = |index: usize| {
        let (telegram, detail) = (report.telegrams.get(index)?, report.detail(index)?);
        Some(view! {
            <tr>
                <td class="number">{telegram.number}</td>
                {timed.then(|| view! { <td class="number">{telegram.time.clone()}</td> })}
                <td>{arrow(telegram)}</td>
                <td class="number">{telegram.unit}</td>
                <th scope="row">{detail.meaning().sentence()}</th>
                <td>
                    <StateBadge state=report.state(index) latency=telegram.latency />
                </td>
            </tr>
        })
    };
    let more = report.telegrams.len().saturating_sub(MOST_ROWS);
    let rows: Vec<_> = (0..report.telegrams.len().min(MOST_ROWS)).filter_map(row).collect();
    view! {
        <table class="table overview" aria-label="All telegrams">
            <thead>
                <tr>
                    <th scope="col">"No."</th>
                    {timed.then(|| view! { <th scope="col">"Time"</th> })}
                    <th scope="col">
                        <span class="unseen">"Direction"</span>
                    </th>
                    <th scope="col">"Unit"</th>
                    <th scope="col">"Says"</th>
                    <th scope="col">"State"</th>
                </tr>
            </thead>
            <tbody>{rows}</tbody>
        </table>
        {(more > 0).then(|| view! { <p class="more">{format!("And {}.", many(more, "more telegram"))}</p> })}
    }
}

/// One telegram: what it says, its bytes, its fields, what is wrong.
fn telegram(report: &Report, index: usize) -> Option<impl IntoView + use<>> {
    let (telegram, detail) = (report.telegrams.get(index)?, report.detail(index)?);
    let bytes = &telegram.line.bytes;
    let direction = telegram.guess.told().map_or("telegram", Direction::key);
    let partner = telegram.answers.and_then(|request| report.telegrams.get(request));
    let facts = [
        Some(format!("{} {direction}", telegram.choice.protocol.label)),
        partner.map(|request| format!("answers {}", request.number)),
        Some(Message::bytes(bytes.len()).to_string()),
        telegram.time.clone(),
    ];
    let facts: Vec<String> = facts.into_iter().flatten().collect();
    let problems = detail.problems().into_iter().map(|problem| {
        let (class, word) = match problem.severity {
            Severity::Error => ("bad", "Error"),
            Severity::Warning => ("warn", "Warning"),
        };
        view! { <p class=format!("problem {class}")>{format!("{word}: {}.", problem.message.sentence())}</p> }
    });
    let strip = blocks(&detail, bytes).into_iter().map(|block| {
        view! {
            <li class=block.class class:faulty=block.faulty>
                <span class="label">{block.label}</span>
                <code>{hex(&block.bytes)}</code>
            </li>
        }
    });
    let note = (!telegram.comment.is_empty())
        .then(|| view! { <p class="problem">{format!("Note: {}", telegram.comment)}</p> });
    let mut rows = Vec::new();
    detail.device.blocks.iter().for_each(|block| add_rows(&block.field, 0, bytes, &mut rows));
    detail.fields.iter().for_each(|field| add_rows(field, 0, bytes, &mut rows));
    let causes = (telegram.verdict == Verdict::Wrong).then(|| causes(report, index, telegram));
    Some(view! {
        <section class="telegram">
            <h3>{format!("{}. {}.", telegram.number, said(&detail))}</h3>
            <p class="facts">
                {facts.join(" · ")} " " <StateBadge state=report.state(index) latency=telegram.latency />
            </p>
            {problems.collect_view()}
            {note}
            <ol class="bytes">{strip.collect_view()}</ol>
            <table class="table">
                <tbody>{rows}</tbody>
            </table>
            {causes}
        </section>
    })
}

fn said(detail: &Detail) -> String {
    detail.meaning().sentence()
}

/// The row of a field, and those of the fields within it.
fn add_rows(field: &Field, depth: usize, bytes: &[u8], rows: &mut Vec<AnyView>) {
    /// The strip has all of them.
    const SHOWN: usize = 8;
    let run = field.span.of(bytes);
    let more = if run.len() > SHOWN { " …" } else { "" };
    let meaning = field.meaning().map_or(String::new(), |meaning| meaning.to_string());
    rows.push(
        view! {
            <tr class=role_class(field.spec.role) style:--depth=depth.to_string()>
                <th scope="row">{field.label().sentence()}</th>
                <td class="mono">{hex(&run[..run.len().min(SHOWN)])} {more}</td>
                <td>{field.value_text()}</td>
                <td>{meaning}</td>
            </tr>
        }
        .into_any(),
    );
    field.children.iter().for_each(|child| add_rows(child, depth + 1, bytes, rows));
}

/// What may have happened to a telegram whose check failed.
fn causes(report: &Report, index: usize, telegram: &Telegram) -> Option<impl IntoView + use<>> {
    let causes = report.explanations(index);
    let cause = |cause: &buslens::tool::Explanation| {
        let (text, odds) = (cause.hypothesis.text(&telegram.line.bytes).sentence(), cause.hypothesis.odds());
        view! { <li>{format!("{text} (chance of a false match: {odds}). It would then say: {}.", cause.said)}</li> }
    };
    (!causes.is_empty()).then(|| {
        view! {
            <div class="causes">
                <h4>"Possible causes"</h4>
                <ol>{causes.iter().map(cause).collect_view()}</ol>
            </div>
        }
    })
}
