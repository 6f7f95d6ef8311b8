//! Telegrams to try.

use leptos::prelude::*;

use super::ReadState;
use crate::components::icon::Glyph;
use crate::components::menu::{Menu, MenuItem};
use buslens::tool::examples::{EXAMPLES, Example, Group};

/// The examples as a menu.
#[component]
pub fn Examples() -> impl IntoView {
    let read = expect_context::<ReadState>();
    let entry = move |example: &'static Example| {
        let load = Callback::new(move |()| read.load_example(example.text, example.device));
        view! { <MenuItem on_choose=load>{example.label}</MenuItem> }
    };
    let group = move |group: Group| {
        let of = EXAMPLES.iter().filter(move |example| example.group == group);
        view! {
            <p class="group" role="presentation">{group.label()}</p>
            {of.map(entry).collect_view()}
        }
    };
    view! {
        <Menu label="Examples" glyph=Glyph::Learn class="examples" at_end=true>
            {Group::ALL.map(group).into_iter().collect_view()}
        </Menu>
    }
}

/// A few examples as buttons, for who has nothing to paste.
#[component]
pub fn FirstExamples() -> impl IntoView {
    let read = expect_context::<ReadState>();
    let button = move |example: &'static Example| {
        let load = move |_| read.load_example(example.text, example.device);
        let first = example.text.lines().next().unwrap_or_default().trim();
        view! {
            <li>
                <button type="button" on:click=load>
                    <strong>{example.label}</strong>
                    <code>{first}</code>
                </button>
            </li>
        }
    };
    let of = |group: Group, count: usize| {
        EXAMPLES.iter().filter(move |example| example.group == group).take(count).map(button).collect_view()
    };
    let load_log = move |_| read.load(LOG.to_owned());
    view! {
        <ul class="first-examples">
            {of(Group::Devices, 2)} {of(Group::Broken, 2)}
            <li>
                <button type="button" on:click=load_log>
                    <strong>"A log of a converter"</strong>
                    <code>{LOG.lines().next().unwrap_or_default()}</code>
                </button>
            </li>
        </ul>
    }
}

/// A log to try, with what goes wrong in plants.
const LOG: &str = include_str!("example.log");
