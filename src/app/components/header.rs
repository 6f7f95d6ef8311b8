//! The line on top: name, promise, theme.

use leptos::prelude::*;

use crate::app::browser;

const THEME: &str = "buslens.theme";

#[component]
pub fn Header() -> impl IntoView {
    let theme = RwSignal::new(browser::remembered(THEME).unwrap_or_else(|| "system".to_owned()));
    Effect::new(move |_| {
        let theme = theme.get();
        if let Some(root) = document().document_element() {
            // The boot script sets the same attribute before the first paint.
            let _ = root.set_attribute("data-theme", &theme);
        }
        browser::remember(THEME, &theme);
    });
    view! {
        <header class="top">
            <h1>"Bus"<span>"lens"</span></h1>
            <p class="promise">"Reads field-bus telegrams. Nothing leaves this page."</p>
            <label class="theme">
                <span>"Theme"</span>
                <select
                    id="theme"
                    prop:value=move || theme.get()
                    on:change:target=move |event| theme.set(event.target().value())
                >
                    <option value="system">"System"</option>
                    <option value="light">"Light"</option>
                    <option value="dark">"Dark"</option>
                </select>
            </label>
        </header>
    }
}
