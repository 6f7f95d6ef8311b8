//! Results of a group: codes, or files with them, in a table.

use leptos::html;
use leptos::prelude::*;
use leptos::task::spawn_local;

use super::go;
use super::state::Where;
use crate::browser::file;
use crate::components::icon::{Glyph, Icon};
use crate::components::toast::Toasts;
use crate::views::learn::LearnState;
use buslens_trainer::practice::QUESTIONS;
use buslens_trainer::result::{self, About, Line, RoundResult};

#[component]
pub fn Results() -> impl IntoView {
    let learn = expect_context::<LearnState>();
    let toasts = expect_context::<Toasts>();
    let codes = learn.practice.codes;
    let lines = Memo::new(move |_| codes.with(|text| result::lines(text)));
    let field = NodeRef::<html::Input>::new();
    let open = move |_| {
        let Some(files) = field.get_untracked().and_then(|field| field.files()) else { return };
        for at in 0..files.length() {
            let Some(one) = files.get(at) else { continue };
            spawn_local(async move {
                match file::text(&one, MOST).await {
                    Ok(text) => codes.update(|all| {
                        if !all.is_empty() && !all.ends_with('\n') {
                            all.push('\n');
                        }
                        // Who it is of, the file's name tells, where it says nothing itself.
                        let own = one.name();
                        let own = own.rsplit_once('.').map_or(own.as_str(), |(name, _)| name);
                        let alone = result::lines(&text).len() == 1;
                        for line in result::lines(&text) {
                            let name = if line.name.is_empty() && alone { own } else { &line.name };
                            *all += &format!("{name} {}\n", line.code);
                        }
                    }),
                    Err(why) => toasts.say(why.sentence()),
                }
            });
        }
        if let Some(field) = field.get_untracked() {
            field.set_value("");
        }
    };
    let row = |line: Line| {
        let Line { name, code, result } = line;
        match result {
            Ok(RoundResult { about: About::Set(seed), right }) => view! {
                <tr>
                    <th scope="row">{name}</th>
                    <td><code>{code}</code></td>
                    <td>"A set"</td>
                    <td></td>
                    <td><code>{seed.to_string()}</code></td>
                    <td class="number">{right}</td>
                </tr>
            }
            .into_any(),
            Ok(RoundResult { about: About::Round(round), right }) => view! {
                <tr>
                    <th scope="row">{name}</th>
                    <td><code>{code}</code></td>
                    <td>{round.kind.label()}</td>
                    <td class="number">{round.level}</td>
                    <td><code>{round.seed.to_string()}</code></td>
                    <td class="number">{format!("{right} of {QUESTIONS}")}</td>
                </tr>
            }
            .into_any(),
            Err(why) => view! {
                <tr class="no-code">
                    <th scope="row">{name}</th>
                    <td><code>{code}</code></td>
                    <td colspan="4">{why.sentence()}</td>
                </tr>
            }
            .into_any(),
        }
    };
    view! {
        <div class="results">
            <button type="button" class="button plain low" on:click=move |_| go(learn, Where::Start)>
                <Icon glyph=Glyph::Back />
                "All kinds"
            </button>
            <h3 class="headline">"Results of a group"</h3>
            <label class="typed">
                <span>"Codes, one a line, with a name beside each"</span>
                <textarea
                    class="input mono"
                    rows="6"
                    spellcheck="false"
                    placeholder="Anna 20MF-K7QM"
                    prop:value=codes
                    on:input=move |event| codes.set(event_target_value(&event))
                ></textarea>
            </label>
            <div class="acts">
                <label class="button">
                    <Icon glyph=Glyph::Open />
                    "Open files"
                    <input class="unseen" type="file" multiple=true accept=".txt,text/plain" node_ref=field on:change=open />
                </label>
                <button
                    type="button"
                    class="button"
                    prop:disabled=move || lines.with(Vec::is_empty)
                    on:click=move |_| file::save("buslens-results.csv", &lines.with_untracked(|lines| result::csv(lines)))
                >
                    <Icon glyph=Glyph::Save />
                    "Save as CSV"
                </button>
            </div>
            <Show when=move || !lines.with(Vec::is_empty)>
                <div class="table-frame" role="region" aria-label="Results" tabindex="0">
                    <table class="table">
                        <thead>
                            <tr>
                                <th scope="col">"Name"</th>
                                <th scope="col">"Code"</th>
                                <th scope="col">"Practice"</th>
                                <th scope="col">"Level"</th>
                                <th scope="col">"Seed"</th>
                                <th scope="col">"Right at once"</th>
                            </tr>
                        </thead>
                        <tbody>{move || lines.get().into_iter().map(row).collect_view()}</tbody>
                    </table>
                </div>
            </Show>
            <p class="note">
                "Nothing is sent anywhere: who sits before this page sees the table, and nobody else. A code is short, not secret."
            </p>
        </div>
    }
}

/// Larger files are none with codes.
const MOST: u32 = 1_000_000;
