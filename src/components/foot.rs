//! The line at the foot: which version of Buslens this is, and whether there is a newer one.

use leptos::prelude::*;
use leptos::task::spawn_local;

use super::dialog::Dialog;
use super::icon::{Glyph, Icon};
use super::page_menu;
use super::toast::Toasts;
use crate::address::Address;
use crate::browser::edition::{self, Edition, OneFile};
use crate::views::read::ReadState;

/// Whether the window about the version is open.
#[derive(Clone, Copy)]
pub struct AboutIsOpen(pub RwSignal<bool>);

#[component]
pub fn Foot() -> impl IntoView {
    let (address, read, toasts) = (expect_context(), expect_context(), expect_context::<Toasts>());
    let AboutIsOpen(is_open) = expect_context();
    let has_newer = RwSignal::new(edition::has_newer());
    let reload = move || spawn_local(reload(address, read, toasts));
    // Said once; who does not take it now finds it here.
    let heard = window_event_listener_untyped(edition::NEWER, move |_| {
        if !has_newer.get_untracked() {
            toasts.offer("A new version of Buslens is here.", "Reload", reload);
        }
        has_newer.set(true);
    });
    on_cleanup(move || heard.remove());
    let what = match edition::edition() {
        Edition::Hosted => "",
        Edition::OneFile => "offline copy",
        Edition::Development => "development build",
    };
    view! {
        <footer class="foot">
            <button type="button" class="link" on:click=move |_| is_open.set(true)>
                {format!("Buslens {}", edition::version())}
            </button>
            <span>{what}</span>
            <Show when=move || has_newer.get()>
                <span>
                    "A new version is here. "
                    <button type="button" class="link" on:click=move |_| reload()>
                        "Reload"
                    </button>
                </span>
            </Show>
        </footer>
        <Dialog open=is_open title="About this version">
            <About />
        </Dialog>
    }
}

/// What the version means, and what the browser keeps.
#[component]
fn About() -> impl IntoView {
    let toasts = expect_context::<Toasts>();
    let version = edition::version();
    let (release, build) = version.split_once('+').unwrap_or((&version, ""));
    let kept = match edition::edition() {
        Edition::Hosted if edition::is_kept() => {
            "This browser keeps the page: it opens without a connection, too. With a connection, each reload \
             brings the newest version."
        }
        Edition::Hosted => {
            "This browser has not kept the page so far: without a connection, it may not open. As one file it \
             does, everywhere."
        }
        Edition::OneFile => {
            "This is the offline copy: the whole page in one file. It opens from any disk, asks nobody for \
             anything, and stays as it is. Newer versions are where it was saved from."
        }
        Edition::Development => "This page is being worked on: the browser keeps nothing of it.",
    };
    let save = move |one_file: OneFile| {
        let label = page_menu::label(&one_file);
        view! {
            <button type="button" class="button" on:click=move |_| page_menu::save(one_file.clone(), toasts)>
                <Icon glyph=Glyph::Save />
                {label}
            </button>
        }
    };
    view! {
        <div class="prose">
            <p>
                {format!("Buslens {release}, build {build}. ")}
                "The build is a fingerprint of every byte of the page: where it is the same, so is the page."
            </p>
            <p>{kept}</p>
            {edition::one_file().map(save)}
        </div>
    }
}

/// Loads the page anew, and with it the newer version, once all that was typed is sure to come back.
async fn reload(address: Address, read: ReadState, toasts: Toasts) {
    if address.keep_all().await && read.keep_file().await {
        let _ = window().location().reload();
    } else {
        toasts.say(
            "This browser has no room to keep what is shown over a reload. Copy or save what you need, then \
             reload the page yourself.",
        );
    }
}
