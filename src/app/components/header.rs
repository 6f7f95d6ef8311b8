//! The line on top: name, promise, theme.

use leptos::prelude::*;

use crate::app::browser;

/// The boot script reads the same setting, so that the page comes up in the right colours.
const THEME: &str = "buslens.theme";

#[component]
pub fn Header() -> impl IntoView {
    let theme = browser::remembered(THEME).unwrap_or_default();
    let choose = |theme: String| {
        if let Some(root) = document().document_element() {
            let _ = root.set_attribute("data-theme", &theme);
        }
        browser::remember(THEME, &theme);
    };
    view! {
        <header class="top">
            <h1>"Bus"<span>"lens"</span></h1>
            <p class="promise">"Reads field-bus telegrams. Nothing leaves this page."</p>
            <label class="theme">
                <span>"Theme"</span>
                <select id="theme" aria-label="Theme" prop:value=theme on:change:target=move |event| choose(event.target().value())>
                    <option value="">"System"</option>
                    <option value="light">"Light"</option>
                    <option value="dark">"Dark"</option>
                </select>
            </label>
        </header>
    }
}
