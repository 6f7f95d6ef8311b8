//! The summary for a mail: it is on the clipboard, and shown as it will be pasted.

use std::sync::Arc;

use leptos::prelude::*;
use leptos::task::spawn_local;

use super::DigestView;
use crate::browser::clipboard;
use crate::components::dialog::Dialog;
use crate::components::icon::{Glyph, Icon};
use crate::components::toast::Toasts;
use buslens::tool::digest::Digest;

/// A window with the summary; when it opens, the summary is copied.
#[component]
pub fn Summary(
    open: RwSignal<bool>,
    /// `None` until it is made.
    #[prop(into)]
    digest: Signal<Option<Arc<Digest>>>,
    /// Where it can be printed, unless this is where.
    #[prop(optional)]
    print: Option<&'static str>,
) -> impl IntoView {
    let toasts = expect_context::<Toasts>();
    let with_bytes = RwSignal::new(true);
    // Whether the browser copied it.
    let copied = RwSignal::new(None::<bool>);
    let copy = move || {
        let Some(digest) = digest.get_untracked() else { return };
        let with_bytes = with_bytes.get_untracked();
        spawn_local(async move {
            let done =
                clipboard::write_both(&digest.text(with_bytes), &digest.html(with_bytes)).await.is_ok();
            copied.set(Some(done));
            toasts.announce(if done { "The summary is copied: paste it into the mail." } else { NOT_COPIED });
        });
    };
    Effect::watch(
        move || (open.get(), digest.with(Option::is_some), with_bytes.get()),
        move |(open, there, _), _, _| {
            copied.set(None);
            if *open && *there {
                copy();
            }
        },
        false,
    );
    let said = move || match (digest.with(Option::is_some), copied.get()) {
        (false, _) => view! { <p role="status">"One moment"</p> }.into_any(),
        (true, Some(true)) => view! {
            <p class="done" role="status">
                <Icon glyph=Glyph::Tick />
                "Copied. Paste it into the mail; this is what it will say."
            </p>
        }
        .into_any(),
        (true, Some(false)) => view! {
            <p class="not-done" role="status">
                <Icon glyph=Glyph::Warning />
                {NOT_COPIED}
            </p>
        }
        .into_any(),
        (true, None) => ().into_any(),
    };
    let shown = move || {
        let with_bytes = with_bytes.get();
        digest.get().map(|digest| view! { <DigestView digest with_bytes /> })
    };
    view! {
        <Dialog open title="Summary for a mail" class="drawer">
            {move || said()}
            {move || shown()}
            <footer>
                <label class="tick">
                    <input
                        type="checkbox"
                        prop:checked=with_bytes
                        on:change=move |event| with_bytes.set(event_target_checked(&event))
                    />
                    "With bytes"
                </label>
                {print
                    .map(|print| {
                        view! {
                            <a class="button" href=print on:click=move |_| open.set(false)>
                                <Icon glyph=Glyph::Print />
                                "Print"
                            </a>
                        }
                    })}
                <button type="button" class="button main" on:click=move |_| copy()>
                    <Icon glyph=Glyph::Copy />
                    "Copy again"
                </button>
            </footer>
        </Dialog>
    }
}

const NOT_COPIED: &str = "The browser does not let Buslens copy. Press “Copy again”, or select the text here and copy it with Ctrl+C.";
