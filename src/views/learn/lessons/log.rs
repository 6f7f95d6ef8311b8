//! A log as it came, and what is found in it.

use leptos::prelude::*;

use buslens_trainer::lesson::Step;

#[component]
pub fn LogLines(step: Step) -> impl IntoView {
    let lines: Vec<_> =
        step.log.lines().map(|line| view! { <li><code>{line.to_owned()}</code></li> }).collect();
    let found: Vec<_> = step.findings().into_iter().map(|(_, said)| view! { <li>{said}</li> }).collect();
    // The answer, for who is done.
    let found = (!found.is_empty()).then(|| {
        view! {
            <details>
                <summary>"What Buslens finds in it"</summary>
                <ul>{found}</ul>
            </details>
        }
    });
    view! {
        // It may be wider than the page: the keyboard scrolls it, too.
        <ol class="log-lines" tabindex="0" aria-label="A log, line by line">{lines}</ol>
        {found}
    }
}
