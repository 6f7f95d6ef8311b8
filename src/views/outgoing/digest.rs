//! What was read in short, as the mail and the first page of a report have it.

use std::sync::Arc;

use leptos::prelude::*;

use crate::components::state_badge::StateBadge;
use crate::components::wide_table::WideTable;
use buslens::field::{Direction, grouped, many};
use buslens::tool::digest::{Digest, Line, Party};

#[component]
pub fn DigestView(digest: Arc<Digest>, with_bytes: bool) -> impl IntoView {
    let Digest { title, read, headline, remarks, findings, units, telegrams, of, wrong } = &*digest;
    let named = (!title.is_empty()).then(|| {
        view! {
            <b>{title.clone()}</b>
            ": "
        }
    });
    let findings = findings.iter().map(|finding| {
        view! {
            <li>
                {finding.text.clone()} " " <span class="soft">{many(finding.telegrams, "telegram")}</span>
            </li>
        }
    });
    let findings = findings.collect_view();
    let remarks = remarks.iter().map(|remark| view! { <li>{remark.clone()}</li> }).collect_view();
    let shown = telegrams.len();
    let heading = match (wrong, *of > shown) {
        (true, true) => format!("Telegrams that matter: {shown} of {}", grouped(*of)),
        (true, false) => "Telegrams that matter".to_owned(),
        (false, _) => "Telegrams".to_owned(),
    };
    view! {
        <div class="digest">
            <p>
                {named} {read.clone()} <br />
                <b>{headline.clone()}</b>
            </p>
            {(!digest.remarks.is_empty()).then(|| view! { <ul class="note">{remarks}</ul> })}
            {(!digest.findings.is_empty())
                .then(|| {
                    view! {
                        <h3>"What is wrong"</h3>
                        <ol class="findings-list">{findings}</ol>
                    }
                })}
            {(!units.is_empty()).then(|| view! { <Units units=units.clone() /> })}
            {(!telegrams.is_empty())
                .then(|| {
                    view! {
                        <h3>{heading}</h3>
                        <Lines lines=telegrams.clone() with_bytes />
                    }
                })}
        </div>
    }
}

#[component]
fn Units(units: Vec<Party>) -> impl IntoView {
    // A column that nobody has anything in says nothing.
    let rows: Vec<[String; 9]> = units.iter().map(Party::cells).collect();
    let used: Vec<usize> = (0..Party::HEADS.len())
        .filter(|column| rows.iter().any(|row| !matches!(row[*column].as_str(), "" | "0")))
        .collect();
    let heads =
        used.iter().map(|column| view! { <th scope="col">{Party::HEADS[*column]}</th> }).collect_view();
    let row = |row: [String; 9]| {
        let cells = used.iter().map(|column| {
            let text = row[*column].clone();
            match column {
                0 => view! { <th scope="row">{text}</th> }.into_any(),
                1 => view! { <td>{text}</td> }.into_any(),
                _ => {
                    let nothing = text == "0";
                    view! { <td class="number" class:soft=nothing>{text}</td> }.into_any()
                }
            }
        });
        view! { <tr>{cells.collect_view()}</tr> }
    };
    let rows = rows.into_iter().map(row).collect_view();
    view! {
        <h3>"Units"</h3>
        <WideTable label="Units">
            <thead>
                <tr>{heads}</tr>
            </thead>
            <tbody>{rows}</tbody>
        </WideTable>
    }
}

#[component]
fn Lines(lines: Vec<Line>, with_bytes: bool) -> impl IntoView {
    let timed = lines.iter().any(|line| line.time.is_some());
    let row = move |line: Line| {
        let arrow = match line.direction {
            Some(Direction::Request) => "→",
            Some(Direction::Response) => "←",
            None => "",
        };
        let times = (line.times > 1).then(|| format!("{} times", grouped(line.times)));
        let faults =
            line.faults.iter().map(|fault| view! { <p class="note">{fault.clone()}</p> }).collect_view();
        view! {
            <tr>
                <td class="number">{line.number}</td>
                {timed.then(|| view! { <td class="number">{line.time.clone()}</td> })}
                <td class="number">{line.unit} " " {arrow}</td>
                <td class="says">
                    {line.said.clone()} {with_bytes.then(|| view! { <code>{line.hex()}</code> })} {faults}
                </td>
                <td>
                    <StateBadge state=line.state latency=line.latency />
                    {times.map(|times| view! { <span class="times note">{times}</span> })}
                </td>
            </tr>
        }
    };
    view! {
        <table class="table lines" aria-label="Telegrams">
            <thead>
                <tr>
                    <th scope="col">"No."</th>
                    {timed.then(|| view! { <th scope="col">"Time"</th> })}
                    <th scope="col">"Unit"</th>
                    <th scope="col">"Says"</th>
                    <th scope="col">"State"</th>
                </tr>
            </thead>
            <tbody>{lines.into_iter().map(row).collect_view()}</tbody>
        </table>
    }
}
