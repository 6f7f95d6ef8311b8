//! A window within the page.

use leptos::html;
use leptos::prelude::*;

use super::icon::{Glyph, Icon};

/// A dialog that is open as long as `open` is true.
#[component]
pub fn Dialog(
    open: RwSignal<bool>,
    #[prop(into)] title: String,
    /// `drawer`: at the side, as high as the page.
    #[prop(into, optional)]
    class: String,
    children: ChildrenFn,
) -> impl IntoView {
    let dialog = NodeRef::<html::Dialog>::new();
    Effect::new(move || {
        let Some(dialog) = dialog.get() else { return };
        match (open.get(), dialog.open()) {
            // The browser gives the focus back to where it was before.
            (true, false) => drop(dialog.show_modal()),
            (false, true) => dialog.close(),
            _ => {}
        }
    });
    let name = title.clone();
    view! {
        <dialog node_ref=dialog class=format!("dialog {class}") aria-label=name on:close=move |_| open.set(false)>
            <header>
                <h2>{title}</h2>
                <button
                    type="button"
                    class="button plain icon-only"
                    aria-label="Close"
                    on:click=move |_| open.set(false)
                >
                    <Icon glyph=Glyph::Close />
                </button>
            </header>
            <div class="content">{move || open.get().then(|| children())}</div>
        </dialog>
    }
}
