//! One of a few, side by side.

use std::sync::atomic::{AtomicUsize, Ordering};

use leptos::prelude::*;

/// A group of radio buttons that looks like one control.
#[component]
pub fn Segments<T>(
    /// What is chosen, for screen readers.
    #[prop(into)]
    label: String,
    options: Vec<(T, String)>,
    #[prop(into)] value: Signal<T>,
    on_choose: Callback<T>,
    #[prop(into, optional)] class: String,
) -> impl IntoView
where
    T: Copy + PartialEq + Send + Sync + 'static,
{
    // Radio buttons of one name go together, also where they are not of one part.
    static GROUPS: AtomicUsize = AtomicUsize::new(0);
    let name = format!("segments-{}", GROUPS.fetch_add(1, Ordering::Relaxed));
    let option = move |(option, label): (T, String)| {
        view! {
            <label>
                <input
                    type="radio"
                    name=name.clone()
                    prop:checked=move || value.get() == option
                    on:change=move |_| on_choose.run(option)
                />
                {label}
            </label>
        }
    };
    view! {
        <div class=format!("segments {class}") role="radiogroup" aria-label=label>
            {options.into_iter().map(option).collect_view()}
        </div>
    }
}
