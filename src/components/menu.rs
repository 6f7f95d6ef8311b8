//! A button that opens a list of things to do.

use leptos::context::Provider;
use leptos::ev::{FocusEvent, KeyboardEvent, MouseEvent};
use leptos::html;
use leptos::prelude::*;
use leptos::wasm_bindgen::JsCast;

use super::icon::{Glyph, Icon};
use super::roving;

/// What an entry knows of its menu.
#[derive(Clone, Copy)]
struct Close(Callback<()>);

/// The button and its list, of which `children` are the [entries](MenuItem).
#[component]
pub fn Menu(
    #[prop(into)] label: Signal<String>,
    /// Only for screen readers; others see `glyph`.
    #[prop(optional)]
    icon_only: bool,
    #[prop(optional)] glyph: Option<Glyph>,
    #[prop(into, optional)] class: String,
    /// Its list ends where the button ends, which suits the right edge of the page.
    #[prop(optional)]
    at_end: bool,
    children: ChildrenFn,
) -> impl IntoView {
    let open = RwSignal::new(false);
    let root = NodeRef::<html::Div>::new();
    let button = NodeRef::<html::Button>::new();
    let list = NodeRef::<html::Div>::new();
    // Whoever opens it by keyboard goes on in the list.
    let enter = RwSignal::new(false);
    Effect::new(move || {
        if let Some(list) = list.get()
            && enter.get_untracked()
        {
            roving::focus(&list, ENTRIES, 0);
        }
    });
    let toggle = move |event: MouseEvent| {
        // A click without a pointer is a key.
        enter.set(event.detail() == 0);
        open.update(|open| *open = !*open);
    };
    let close = move || {
        open.set(false);
        if let Some(button) = button.get_untracked() {
            let _ = button.focus();
        }
    };
    let keys = move |event: KeyboardEvent| match event.key().as_str() {
        "Escape" if open.get_untracked() => {
            event.stop_propagation();
            close();
        }
        "ArrowDown" if !open.get_untracked() => {
            event.prevent_default();
            enter.set(true);
            open.set(true);
        }
        _ => {
            if let Some(list) = list.get_untracked() {
                roving::follow(&event, &list, ENTRIES);
            }
        }
    };
    let left = move |event: FocusEvent| {
        // A menu that is taken away with the focus in it loses that last.
        if open.is_disposed() {
            return;
        }
        let to = event.related_target().and_then(|to| to.dyn_into::<web_sys::Node>().ok());
        let stays = root.get_untracked().is_some_and(|root| root.contains(to.as_ref()));
        if !stays {
            open.set(false);
        }
    };
    view! {
        <div
            node_ref=root
            class=format!("menu {class}")
            class:end=at_end
            on:keydown=keys
            on:focusout=left
        >
            <button
                node_ref=button
                type="button"
                class="button"
                class:plain=icon_only
                class:icon-only=icon_only
                aria-haspopup="menu"
                aria-expanded=move || open.get().to_string()
                on:click=toggle
            >
                {glyph.map(|glyph| view! { <Icon glyph /> })}
                <span class:unseen=icon_only>{label}</span>
                {(!icon_only).then(|| view! { <Icon glyph=Glyph::ChevronDown /> })}
            </button>
            // Each menu of the page has a context of its own.
            <Provider value=Close(Callback::new(move |()| close()))>
                <Show when=move || open.get()>
                    <div node_ref=list role="menu" aria-label=move || label.get()>
                        {children()}
                    </div>
                </Show>
            </Provider>
        </div>
    }
}

const ENTRIES: &str = "[role=menuitem]";

/// One thing to do.
#[component]
pub fn MenuItem(on_choose: Callback<()>, children: Children) -> impl IntoView {
    let Close(close) = expect_context();
    let choose = move |_| {
        // First, so that a dialog that it opens gives the focus back to the menu.
        close.run(());
        on_choose.run(());
    };
    view! {
        <button type="button" role="menuitem" tabindex="-1" on:click=choose>
            {children()}
        </button>
    }
}

/// One place to go to.
#[component]
pub fn MenuLink(href: &'static str, children: Children) -> impl IntoView {
    let Close(close) = expect_context();
    view! {
        <a href=href role="menuitem" tabindex="-1" on:click=move |_| close.run(())>
            {children()}
        </a>
    }
}
