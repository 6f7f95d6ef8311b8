//! The form of what is built.

use leptos::html;
use leptos::prelude::*;

use super::state::BuildState;
use crate::components::byte_strip::{Chosen, span_of};
use crate::components::form::{Edit, Form};
use crate::components::icon::{Glyph, Icon};
use crate::components::roving;
use buslens::field::{Direction, Message};
use buslens::tool::{Content, Entries, Entry, Misfit, PROFILES, PROTOCOLS, Profile, Protocol};

#[component]
pub fn Making() -> impl IntoView {
    let state = expect_context::<BuildState>();
    let built = state.built();
    let form = NodeRef::<html::Div>::new();
    // What was found is filled in next.
    Effect::new(move |before: Option<usize>| {
        let now = state.to_form.get();
        if before.is_some_and(|before| before != now) {
            request_animation_frame(move || {
                if let Some(form) = form.get_untracked() {
                    roving::focus(&form, "input, select", 0);
                }
            });
        }
        now
    });
    let label = Memo::new(move |_| built.with(|built| built.label.clone()));
    let is_task = Memo::new(move |_| built.with(|built| built.is_task));
    let of_reply = Memo::new(move |_| built.with(|built| built.request.is_some()));
    let on_edit = Callback::new(move |(path, edit): (String, Edit)| state.edit(&path, &edit));
    // The field's bytes light up while it is typed.
    let on_focus = Callback::new(move |entry: Entry| {
        let (telegram, direction) = built.with_untracked(|built| (built.telegram.clone(), built.direction));
        let span = telegram.and_then(|telegram| span_of(&telegram.detail, &entry));
        let lights = if direction == Direction::Request { state.request_lights } else { state.reply_lights };
        lights.chosen.set(span.map(|span| Chosen { span, at: span.from }));
    });
    // Why there is no telegram is said at the entry that it is about, or else above all of them.
    let entries = Signal::derive(move || {
        built.with(|built| {
            let mut entries = built.entries.clone();
            if let Some(message) = &built.impossible
                && let Some(path) = concerned(&entries, message)
            {
                entries.misfits.push(Misfit { path, message: message.clone() });
            }
            entries
        })
    });
    let refused = Memo::new(move |_| {
        built.with(|built| {
            let impossible =
                built.impossible.as_ref().filter(|message| concerned(&built.entries, message).is_none());
            Some(impossible.or(built.refused.as_ref())?.sentence() + ".")
        })
    });
    view! {
        <section class="making" aria-label="Form">
            <header>
                <h3>{label}</h3>
                <Show when=move || is_task.get()>
                    <button type="button" class="button plain low" on:click=move |_| state.open_all()>
                        "All fields"
                        <Icon glyph=Glyph::ChevronDown />
                    </button>
                </Show>
                <Show when=move || of_reply.get()>
                    <button type="button" class="button low" on:click=move |_| state.edit_request()>
                        <Icon glyph=Glyph::Back />
                        "Back to the request"
                    </button>
                </Show>
            </header>
            <p class="misfit">{refused}</p>
            <Carrier />
            <div node_ref=form>
                <Form entries on_edit on_focus flat=&["content"] named=&["content.status", "status"] />
            </div>
        </section>
    }
}

/// The path of the entry that a message is about: it names the entry among its arguments, or misses a text.
fn concerned(entries: &Entries, message: &Message) -> Option<String> {
    let named = |name: &str| message.arguments.iter().any(|(argument, _)| *argument == name);
    let mut path = None;
    entries.form.visit(&mut |entry| {
        let typed = matches!(entry.content, Content::Text { .. } | Content::Bytes { .. });
        if path.is_none() && (named(entry.spec.key) || message.arguments.is_empty() && typed) {
            path = Some(entry.path.clone());
        }
    });
    path
}

/// Whose words count, and what carries the telegram.
#[component]
fn Carrier() -> impl IntoView {
    let state = expect_context::<BuildState>();
    let built = state.built();
    let protocol = Memo::new(move |_| built.with(|built| built.protocol.key));
    let device = Memo::new(move |_| state.device().map_or("", |device| device.key));
    let profile = move |own: &'static Profile| {
        view! {
            <option value=own.key prop:selected=move || device.get() == own.key>
                {own.label}
            </option>
        }
    };
    let carrier = move |own: &'static Protocol| {
        view! {
            <option value=own.key prop:selected=move || protocol.get() == own.key>
                {own.label}
            </option>
        }
    };
    let carry = move |event| {
        if let Some(protocol) = Protocol::of(&event_target_value(&event)) {
            state.carry_by(protocol);
        }
    };
    view! {
        <div class="carrier">
            <label>
                <span>"Device"</span>
                <select
                    class="select"
                    on:change=move |event| state.choose_device(Profile::of(&event_target_value(&event)))
                >
                    <option value="" prop:selected=move || device.get().is_empty()>
                        "Any"
                    </option>
                    {PROFILES.iter().copied().map(profile).collect_view()}
                </select>
            </label>
            <label>
                <span>"Protocol"</span>
                <select
                    class="select"
                    on:change=carry
                >
                    {PROTOCOLS.iter().copied().map(carrier).collect_view()}
                </select>
            </label>
        </div>
    }
}
