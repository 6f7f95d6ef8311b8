//! Telegrams to try.

use maud::{Markup, html};

use crate::app::browser;
use crate::app::state::State;
use crate::tool::examples::EXAMPLES;

/// The examples as buttons, right ones before broken ones.
pub fn examples() -> Markup {
    let group = |title: &str, broken: bool| {
        html! {
            section {
                p.title aria-hidden="true" { (title) }
                ul aria-label=(title) {
                    @for example in EXAMPLES.iter().filter(|example| example.broken == broken) {
                        li { button type="button" data-example=(example.key) { (example.label) } }
                    }
                }
            }
        }
    };
    html! {
        (group("As they should be", false))
        (group("Broken, to see what is said", true))
    }
}

/// Loads the example that was clicked, if one was.
pub fn load(state: State, event: &web_sys::Event) -> bool {
    let key = browser::attribute(event, "data-example");
    let example = EXAMPLES.iter().find(|example| Some(example.key) == key.as_deref());
    if let Some(example) = example {
        state.load(example.text);
    }
    example.is_some()
}
