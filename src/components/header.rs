//! The line on top: name, views, promise, and what concerns the whole page.

use leptos::prelude::*;
use leptos::task::spawn_local;

use crate::address::{Address, View};
use crate::browser::storage;
use crate::components::toast::Toasts;

/// Where the theme is kept. The boot script reads it, too, so that the page comes up in the right colours.
const THEME: &str = "theme";

#[component]
pub fn Header() -> impl IntoView {
    let address = expect_context::<Address>();
    let views = [View::Read, View::Build, View::Check, View::Devices];
    let links = views.map(|view| {
        view! {
            <a
                href=format!("#/{}", view.key())
                aria-current=move || (address.view() == view).then_some("page")
            >
                {view.label()}
            </a>
        }
    });
    view! {
        <header class="top">
            <h1>"Buslens"</h1>
            <nav class="views" aria-label="Views">
                {links}
            </nav>
            <div class="end">
                <span class="promise">"Nothing leaves this page"</span>
                <CopyLink />
                <Theme />
            </div>
        </header>
    }
}

#[component]
fn CopyLink() -> impl IntoView {
    let address = expect_context::<Address>();
    let toasts = expect_context::<Toasts>();
    let copy = move |_| {
        spawn_local(async move {
            match address.link().await {
                Some(_link) => toasts.say("TODO"),
                None => toasts.say(
                    "This is too long for a link, even compressed: mail programs and chats cut links of more \
                     than 30,000 characters. Send it as a file.",
                ),
            }
        });
    };
    view! { <button type="button" class="button plain" on:click=copy>"Copy link"</button> }
}

#[component]
fn Theme() -> impl IntoView {
    let chosen = RwSignal::new(storage::kept(THEME).unwrap_or_default());
    let choose = move |theme: String| {
        if let Some(root) = document().document_element() {
            let _ = root.set_attribute("data-theme", &theme);
        }
        let _ = storage::keep(THEME, &theme);
        chosen.set(theme);
    };
    view! {
        <label class="theme">
            <span class="unseen">"Theme"</span>
            <select prop:value=chosen on:change=move |event| choose(event_target_value(&event))>
                <option value="">"System"</option>
                <option value="light">"Light"</option>
                <option value="dark">"Dark"</option>
            </select>
        </label>
    }
}
