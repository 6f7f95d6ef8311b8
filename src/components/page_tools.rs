//! What concerns the page as a whole, at the end of the line on top.

use leptos::ev::{self, KeyboardEvent};
use leptos::prelude::*;
use leptos::task::spawn_local;

use super::copy_button::copy;
use super::dialog::Dialog;
use super::icon::{Glyph, Icon};
use super::menu::{Menu, MenuItem};
use super::page_menu::PageMenu;
use super::toast::Toasts;
use crate::address::Address;
use crate::browser::edition::{Edition, edition};
use crate::browser::storage;
use crate::browser::typing::{go_to_field, is_typed_into};

/// Where the theme is kept. The boot script reads it, too, so that the page comes up in the right colours.
const THEME: &str = "theme";

#[component]
pub fn PageTools() -> impl IntoView {
    view! {
        <CopyLink />
        <Theme />
        <Keys />
        <PageMenu />
    }
}

#[component]
fn CopyLink() -> impl IntoView {
    let address = expect_context::<Address>();
    let toasts = expect_context::<Toasts>();
    let give = move |_| {
        spawn_local(async move {
            let link = match address.link().await {
                Ok(link) => link,
                Err(why) => return toasts.say(why.sentence()),
            };
            if copy(toasts, link).await {
                toasts.say(match edition() {
                    Edition::OneFile => {
                        "Link copied. It leads to this file, and so works on this computer only."
                    }
                    _ => "Link copied. It contains everything shown; nothing is sent to a server.",
                });
            }
        });
    };
    view! {
        <button type="button" class="button plain" aria-label="Copy link" on:click=give>
            <Icon glyph=Glyph::Link />
            <span class="text">"Copy link"</span>
        </button>
    }
}

#[component]
fn Theme() -> impl IntoView {
    let choose = move |theme: &'static str| {
        Callback::new(move |()| {
            if let Some(root) = document().document_element() {
                let _ = root.set_attribute("data-theme", theme);
            }
            // Where it is not kept, it is chosen again at the next visit.
            let _ = storage::keep(THEME, theme);
        })
    };
    view! {
        <Menu label="Theme" glyph=Glyph::Sun icon_only=true at_end=true>
            <MenuItem on_choose=choose("")>"As the system has it"</MenuItem>
            <MenuItem on_choose=choose("light")>"Light"</MenuItem>
            <MenuItem on_choose=choose("dark")>"Dark"</MenuItem>
        </Menu>
    }
}

const KEYS: [(&str, &str); 9] = [
    ("?", "shows this list"),
    ("/", "goes to the input, or to the search of what is shown"),
    ("Tab, Shift + Tab", "go from part to part; bytes, fields and telegrams are one stop each"),
    ("Arrow keys", "go from byte to byte, from field to field, from telegram to telegram"),
    ("← →", "in fields: close and open a group"),
    ("Home, End", "go to the first and the last"),
    ("Esc", "clears the selection, closes a menu"),
    ("Ctrl + V", "anywhere in Read: pastes telegrams or a log in the place of the input"),
    ("Alt + ←, Alt + →", "previous and next state"),
];

/// The keys that do something, and the list of them.
#[component]
fn Keys() -> impl IntoView {
    let open = RwSignal::new(false);
    let pressed = window_event_listener(ev::keydown, move |event: KeyboardEvent| {
        if is_typed_into(event.target()) || event.ctrl_key() || event.meta_key() || event.alt_key() {
            return;
        }
        match event.key().as_str() {
            "?" => open.set(true),
            "/" => {
                event.prevent_default();
                go_to_field();
            }
            _ => {}
        }
    });
    on_cleanup(move || pressed.remove());
    view! {
        <button
            type="button"
            class="button plain icon-only keys-button"
            aria-label="Keyboard"
            on:click=move |_| open.set(true)
        >
            <Icon glyph=Glyph::Help />
        </button>
        <Dialog open title="Keyboard">
            <KeyList />
        </Dialog>
    }
}

#[component]
fn KeyList() -> impl IntoView {
    let key = |(key, deed): &(&'static str, &'static str)| {
        view! {
            <dt>
                <kbd>{*key}</kbd>
            </dt>
            <dd>{*deed}</dd>
        }
    };
    view! {
        <div class="keys">
            <dl>{KEYS.iter().map(key).collect_view()}</dl>
        </div>
    }
}
