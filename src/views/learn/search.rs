//! Where the gallery and the reference are searched.

use leptos::prelude::*;

use crate::components::icon::{Glyph, Icon};

#[component]
pub fn Search(
    /// For screen readers.
    label: &'static str,
    placeholder: &'static str,
    #[prop(into)] typed: Signal<String>,
    on_type: Callback<String>,
) -> AnyView {
    view! {
        <label class="search">
            <Icon glyph=Glyph::Search />
            <span class="unseen">{label}</span>
            <input
                type="search"
                autocomplete="off"
                spellcheck="false"
                placeholder=placeholder
                prop:value=typed
                on:input=move |event| on_type.run(event_target_value(&event))
            />
        </label>
    }
    .into_any()
}
