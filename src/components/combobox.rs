//! A field that offers what fits to what is typed.

use std::sync::atomic::{AtomicUsize, Ordering};

use leptos::ev::{FocusEvent, KeyboardEvent, MouseEvent};
use leptos::html;
use leptos::prelude::*;
use leptos::wasm_bindgen::JsCast;
use web_sys::Element;

/// How one of the options looks.
pub type Draw<T> = fn(&T) -> AnyView;

/// Text that is typed, and a list of what it may mean. Arrows walk in the list, Enter takes what is
/// marked there, Escape closes it.
#[component]
pub fn Combobox<T>(
    /// What is asked for, for screen readers.
    #[prop(into)]
    label: String,
    #[prop(into)] value: Signal<String>,
    on_input: Callback<String>,
    /// What fits, best first.
    #[prop(into)]
    options: Signal<Vec<T>>,
    draw: Draw<T>,
    on_choose: Callback<T>,
    /// The field is left without a choice.
    #[prop(optional)]
    on_leave: Option<Callback<()>>,
    /// What the list says where nothing fits.
    #[prop(into)]
    nothing: String,
    #[prop(into, optional)] placeholder: String,
    #[prop(into, optional)] class: String,
    #[prop(into, optional)] invalid: Signal<bool>,
    #[prop(optional)] field: NodeRef<html::Input>,
) -> impl IntoView
where
    T: Clone + Send + Sync + 'static,
{
    // Options are told apart by their ids, which is how screen readers find the marked one.
    static BOXES: AtomicUsize = AtomicUsize::new(0);
    let id = StoredValue::new(format!("combobox-{}", BOXES.fetch_add(1, Ordering::Relaxed)));
    let option_id = move |index: usize| id.with_value(|id| format!("{id}-{index}"));
    let open = RwSignal::new(false);
    let marked = RwSignal::new(0_usize);
    let root = NodeRef::<html::Div>::new();
    let list = NodeRef::<html::Ul>::new();
    let count = move || options.with_untracked(Vec::len);
    let mark = move |index: usize| {
        marked.set(index);
        let options = list.get_untracked().map(|list| list.children());
        if let Some(option) = options.and_then(|options| options.item(u32::try_from(index).ok()?)) {
            keep_in_sight(&option);
        }
    };
    let choose = move |index: usize| {
        if let Some(option) = options.with_untracked(|options| options.get(index).cloned()) {
            open.set(false);
            on_choose.run(option);
        }
    };
    let keys = move |event: KeyboardEvent| {
        let (shown, at, last) = (open.get_untracked(), marked.get_untracked(), count().saturating_sub(1));
        match event.key().as_str() {
            "ArrowDown" | "ArrowUp" if !shown => {
                open.set(true);
                mark(0);
            }
            "ArrowDown" => mark(if at < last { at + 1 } else { 0 }),
            "ArrowUp" => mark(if at > 0 { at - 1 } else { last }),
            "PageDown" if shown => mark((at + 8).min(last)),
            "PageUp" if shown => mark(at.saturating_sub(8)),
            "Enter" if shown => choose(at),
            "Escape" if shown => open.set(false),
            _ => return,
        }
        event.prevent_default();
        event.stop_propagation();
    };
    let input = move |event| {
        marked.set(0);
        open.set(true);
        on_input.run(event_target_value(&event));
    };
    let left = move |event: FocusEvent| {
        // A field that is taken away with the focus in it loses that last.
        if open.is_disposed() {
            return;
        }
        let to = event.related_target().and_then(|to| to.dyn_into::<web_sys::Node>().ok());
        let stays = root.get_untracked().is_some_and(|root| root.contains(to.as_ref()));
        if !stays {
            open.set(false);
            if let Some(left) = on_leave {
                left.run(());
            }
        }
    };
    let option = move |index: usize, option: &T| {
        view! {
            <li
                id=option_id(index)
                role="option"
                aria-selected=move || (marked.get() == index).to_string()
                on:pointermove=move |_| {
                    if marked.get_untracked() != index {
                        marked.set(index);
                    }
                }
                // The field keeps the focus.
                on:mousedown=|event: MouseEvent| event.prevent_default()
                on:click=move |_| choose(index)
            >
                {draw(option)}
            </li>
        }
    };
    let shown = move || {
        options.with(|options| options.iter().enumerate().map(|(at, it)| option(at, it)).collect_view())
    };
    let active = move || (open.get() && options.with(|it| !it.is_empty())).then(|| option_id(marked.get()));
    view! {
        <div node_ref=root class=format!("combobox {class}") on:focusout=left>
            <input
                node_ref=field
                class="input"
                role="combobox"
                autocomplete="off"
                spellcheck="false"
                placeholder=placeholder
                aria-label=label.clone()
                aria-autocomplete="list"
                aria-expanded=move || open.get().to_string()
                aria-controls=id.get_value()
                aria-activedescendant=active
                aria-invalid=move || invalid.get().to_string()
                prop:value=move || value.get()
                on:input=input
                on:keydown=keys
                on:click=move |_| open.set(true)
            />
            <ul
                node_ref=list
                id=id.get_value()
                role="listbox"
                aria-label=label
                hidden=move || !(open.get() && options.with(|it| !it.is_empty()))
            >
                {move || open.get().then(shown)}
            </ul>
            <p class="nothing" role="status" hidden=move || !(open.get() && options.with(Vec::is_empty))>
                {nothing}
            </p>
        </div>
    }
}

/// Scrolls the list of an option as little as it takes to show it.
fn keep_in_sight(option: &Element) {
    let Some(list) = option.parent_element() else { return };
    let (own, around) = (option.get_bounding_client_rect(), list.get_bounding_client_rect());
    let (above, below) = (own.top() - around.top() - 4.0, own.bottom() - around.bottom() + 4.0);
    // Whole pixels are enough.
    if above < 0.0 {
        list.set_scroll_top(list.scroll_top() + above.floor() as i32);
    } else if below > 0.0 {
        list.set_scroll_top(list.scroll_top() + below.ceil() as i32);
    }
}
