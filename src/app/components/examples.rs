//! Telegrams to try.

use leptos::prelude::*;

use crate::tool::examples::{EXAMPLES, Example};

/// The examples as buttons, right ones before broken ones.
#[component]
pub fn Examples(choose: impl Fn(&'static Example) + Copy + 'static) -> impl IntoView {
    let group = move |broken: bool| {
        EXAMPLES
            .iter()
            .filter(|example| example.broken == broken)
            .map(|example| {
                view! {
                    <li>
                        <button type="button" data-example=example.key on:click=move |_| choose(example)>
                            {example.label}
                        </button>
                    </li>
                }
            })
            .collect_view()
    };
    view! {
        <div class="examples">
            <section>
                <h3>"As they should be"</h3>
                <ul>{group(false)}</ul>
            </section>
            <section>
                <h3>"Broken, to see what is said"</h3>
                <ul>{group(true)}</ul>
            </section>
        </div>
    }
}
