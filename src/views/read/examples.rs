//! Telegrams to try.

use leptos::prelude::*;

use super::ReadState;
use crate::components::icon::{Glyph, Icon};
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

/// The three that show best what Buslens does.
#[component]
pub fn FirstExamples() -> impl IntoView {
    let read = expect_context::<ReadState>();
    let load = move |key: &'static str| {
        move |_| {
            if let Some(example) = example(key) {
                read.load_example(example.text, example.device);
            }
        }
    };
    view! {
        <ul class="first-examples">
            <li>
                <button type="button" on:click=load("memograph_channels")>
                    <Icon glyph=Glyph::Read />
                    <strong>"A recorder's channels, read and written"</strong>
                    <span>"Memograph M RSG45: Universal channel 1 = 82.4724, good"</span>
                    <Icon glyph=Glyph::ChevronRight />
                </button>
            </li>
            <li>
                <button type="button" on:click=move |_| read.load(LOG.to_owned())>
                    <Icon glyph=Glyph::Search />
                    <strong>"A customer's log: what is wrong here?"</strong>
                    <span>"104 telegrams, a silent unit, damaged answers: each finding with its advice"</span>
                    <Icon glyph=Glyph::ChevronRight />
                </button>
            </li>
            <li>
                <button type="button" on:click=load(FLOW_CONTROL)>
                    <Icon glyph=Glyph::Check />
                    <strong>"A wrong CRC, and the byte that was lost"</strong>
                    <span>"The likely cause, corrected and read"</span>
                    <Icon glyph=Glyph::ChevronRight />
                </button>
            </li>
        </ul>
    }
}

/// The example with this key.
pub fn example(key: &str) -> Option<&'static Example> {
    EXAMPLES.iter().find(|example| example.key == key)
}

/// The key of the example whose byte a converter has swallowed.
pub const FLOW_CONTROL: &str = "flow_control";

/// A log to try, with what goes wrong in plants.
pub const LOG: &str = include_str!("example.log");
