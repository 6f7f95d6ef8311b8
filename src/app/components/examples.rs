//! Telegrams to try.

use maud::{Markup, html};

use crate::app::browser;
use crate::app::state::State;
use buslens::tool::Profile;
use buslens::tool::examples::{EXAMPLES, Group};

/// The examples as buttons, group by group.
pub fn examples() -> Markup {
    html! {
        @for group in Group::ALL {
            section {
                p.title aria-hidden="true" { (group.label()) }
                ul aria-label=(group.label()) {
                    @for example in EXAMPLES.iter().filter(|example| example.group == group) {
                        li { button type="button" data-example=(example.key) { (example.label) } }
                    }
                }
            }
        }
    }
}

/// Loads the example that was clicked, if one was.
pub fn load(state: State, event: &web_sys::Event) -> bool {
    let key = browser::attribute(event, "data-example");
    let example = EXAMPLES.iter().find(|example| Some(example.key) == key.as_deref());
    if let Some(example) = example {
        state.load(example.text);
        let device = Profile::of(example.device);
        state.read_as(|options| options.device = device);
    }
    example.is_some()
}
