//! A list to choose from, with its name.

use leptos::prelude::*;

/// A key, and what stands for it in the list.
pub type Choice = (String, String);

/// A small list with its name before it; with another class, as that says.
#[component]
pub fn Choose(
    label: &'static str,
    /// What counts where nobody chooses; in some lists there is no such thing.
    #[prop(optional)]
    otherwise: &'static str,
    options: Vec<Choice>,
    #[prop(into)] value: Signal<String>,
    on_choose: Callback<String>,
    #[prop(default = "choose")] class: &'static str,
    #[prop(default = "select low")] of_list: &'static str,
) -> AnyView {
    let nothing = (!otherwise.is_empty()).then(|| (String::new(), otherwise.to_owned()));
    let option = |(key, label): Choice| {
        let own = key.clone();
        view! {
            <option value=key prop:selected=move || value.with(|value| *value == own)>
                {label}
            </option>
        }
    };
    view! {
        <label class=class>
            <span>{label}</span>
            <select class=of_list on:change=move |event| on_choose.run(event_target_value(&event))>
                {nothing.into_iter().chain(options).map(option).collect_view()}
            </select>
        </label>
    }
    .into_any()
}

/// Keys and labels that are known beforehand.
pub fn choices(all: impl IntoIterator<Item = (&'static str, &'static str)>) -> Vec<Choice> {
    all.into_iter().map(|(key, label)| (key.to_owned(), label.to_owned())).collect()
}
