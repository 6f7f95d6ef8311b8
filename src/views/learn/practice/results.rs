//! Results of a group: codes, or files with them, in a table.

use leptos::prelude::*;
use leptos::task::spawn_local;
use web_sys::File;

use super::parts::{lines as place, to_start};
use super::series::Series;
use crate::browser::file;
use crate::components::button::Button;
use crate::components::icon::Glyph;
use crate::components::open_file::OpenFile;
use crate::components::wide_table::WideTable;
use crate::views::learn::LearnState;
use buslens_trainer::practice::QUESTIONS;
use buslens_trainer::result::{self, About, Line};

pub fn results() -> AnyView {
    let learn = expect_context::<LearnState>();
    let codes = learn.practice.codes;
    let lines = Memo::new(move |_| codes.with(|text| result::lines(text)));
    let open = move |one: File| {
        spawn_local(async move {
            match file::text(&one, MOST).await {
                Ok(text) => codes.update(|all| {
                    if !all.is_empty() && !all.ends_with('\n') {
                        all.push('\n');
                    }
                    // Who it is of, the file's name tells, where it says nothing itself.
                    let own = one.name();
                    let own = own.rsplit_once('.').map_or(own.as_str(), |(name, _)| name);
                    let read = result::lines(&text);
                    let alone = read.len() == 1;
                    for line in read {
                        let name = if line.name.is_empty() && alone { own } else { &line.name };
                        *all += &format!("{name} {}\n", line.code);
                    }
                }),
                Err(why) => learn.practice.say(why.sentence()),
            }
        });
    };
    let save = move |()| file::save("buslens-results.csv", &lines.with_untracked(|lines| result::csv(lines)));
    let none = Signal::derive(move || lines.with(Vec::is_empty));
    let row = move |line: Line| {
        let [what, level, seed, right] = cells(learn, &line);
        let problem = line.result.is_err();
        view! {
            <tr class:no-code=problem>
                <th scope="row">{line.name}</th>
                <td><code>{line.code}</code></td>
                <td colspan=if problem { "4" } else { "1" }>{what}</td>
                {(!problem)
                    .then(|| {
                        view! {
                            <td class="number">{level}</td>
                            <td><code>{seed}</code></td>
                            <td class="number">{right}</td>
                        }
                    })}
            </tr>
        }
    };
    let heads = ["Name", "Code", "Practice", "Level", "Seed", "Right at once"];
    let table = move || {
        let rows: Vec<_> = lines.get().into_iter().map(row).collect();
        (!rows.is_empty()).then(|| {
            view! {
                <WideTable label="Results">
                    <thead>
                        <tr>{heads.map(|head| view! { <th scope="col">{head}</th> }).into_iter().collect_view()}</tr>
                    </thead>
                    <tbody>{rows}</tbody>
                </WideTable>
            }
        })
    };
    view! {
        <div class="results">
            {to_start(learn)}
            <h3 class="headline">"Results of a group"</h3>
            {place(
                "Codes, one a line, with a name beside each",
                "6",
                "Anna 20MF-K7QM",
                codes.into(),
                Callback::new(move |text| codes.set(text)),
            )}
            <div class="acts">
                <OpenFile label="Open files" multiple=true accept=".txt,text/plain" on_open=Callback::new(open) />
                <Button glyph=Glyph::Save label="Save as CSV" disabled=none on_press=save />
            </div>
            {move || table()}
            <p class="note">
                "Nothing is sent anywhere: who sits before this page sees the table, and nobody else. A code is short, not secret."
            </p>
        </div>
    }
    .into_any()
}

/// What was asked, level, seed, and how many were right; or what is wrong with the code.
fn cells(learn: LearnState, line: &Line) -> [String; 4] {
    match &line.result {
        Err(why) => [why.sentence().to_owned(), String::new(), String::new(), String::new()],
        Ok(result) => match result.about {
            About::Round(round) => [
                round.kind.label().to_owned(),
                round.level.to_string(),
                round.seed.to_string(),
                format!("{} of {QUESTIONS}", result.right),
            ],
            About::Set(seed) => {
                // Its title and how many tasks it has, the set says, where it was opened here.
                let set = learn.practice.text(seed).map(|text| Series::of_set(&text));
                let count = set.as_ref().map_or(String::new(), |set| format!(" of {}", set.tasks.len()));
                let title = set.map_or_else(|| "A set that is not opened here".to_owned(), |set| set.title);
                [title, String::new(), seed.to_string(), format!("{}{count}", result.right)]
            }
        },
    }
}

/// Larger files are none with codes.
const MOST: u32 = 1_000_000;
