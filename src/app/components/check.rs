//! The check: what it covers, what was found, what it should be.

use std::sync::Arc;

use leptos::prelude::*;

use crate::app::browser;
use crate::app::state::{Shown, State};
use crate::field::{Span, hex, hex_value};

#[component]
pub fn Check(shown: Arc<Shown>) -> impl IntoView {
    let state = State::here();
    shown.detail.check().map(|check| {
        let length = shown.bytes().len();
        let covered = Span::new(0, length - check.width);
        let name = check.kind.to_uppercase();
        let value = hex_value(check.computed_value(), check.width);
        let repaired = {
            let payload = hex(covered.of(shown.bytes()));
            format!("{payload} {}", check.computed_bytes())
        };
        let explained = view! {
            {name}" over "
            <button type="button" class="link" on:click=move |_| state.chosen.set(Some(covered))>
                {format!("bytes 0 to {}", covered.to - 1)}
            </button>
            " gives "<code>{value}</code>", on the wire low byte first: "<code>{check.computed_bytes()}</code>"."
        };
        if check.ok() {
            view! {
                <div class="check good">
                    <h3>"The check is right"</h3>
                    <p>{explained}</p>
                </div>
            }
            .into_any()
        } else {
            view! {
                <div class="check error">
                    <h3>"The check does not match"</h3>
                    <p>{explained}" Found: "<code>{check.found_bytes()}</code>"."</p>
                    <p>
                        "Some byte is not what its sender checked, or is missing or too many, or the check itself is "
                        "wrong. The check alone cannot tell which: what is said above may be wrong, too."
                    </p>
                    <button type="button" class="quiet" on:click=move |_| browser::copy(&repaired)>
                        "Copy with the computed check"
                    </button>
                </div>
            }
            .into_any()
        }
    })
}
