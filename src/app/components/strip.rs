//! The bytes of a telegram in a row, grouped by field. Bytes and fields light each other up.

use std::sync::Arc;

use leptos::prelude::*;

use crate::app::browser;
use crate::app::state::{Shown, State};
use crate::field::{Field, Numbering, Role, Severity};

/// More bytes than a telegram can have are not worth a cell each.
const MOST: usize = 300;

#[component]
pub fn Strip(shown: Arc<Shown>) -> impl IntoView {
    let state = State::here();
    let bytes = shown.bytes();
    let total = bytes.len().min(MOST);
    let rest = bytes.len() - total;
    let groups: Vec<_> = shown
        .leaves()
        .into_iter()
        .filter(|leaf| leaf.span.from < MOST)
        .map(|leaf| group(state, leaf, bytes))
        .collect();
    let spans: Arc<[_]> = shown.leaves().into_iter().map(|leaf| leaf.span).collect();
    let field_of = move |byte: usize| spans.iter().copied().find(|span| span.contains(byte));
    let field_at = Arc::new(move |event: &web_sys::Event| field_of(browser::number_at(event, "data-byte")?));
    let (point, choose, focus) = (field_at.clone(), field_at.clone(), field_at);
    let at = RwSignal::new(0);
    let go = move |event: web_sys::KeyboardEvent| {
        let Some(byte) = browser::number_at(&event, "data-byte") else { return };
        let to = match event.key().as_str() {
            "ArrowRight" | "ArrowDown" => byte + 1,
            "ArrowLeft" | "ArrowUp" => byte.saturating_sub(1),
            "Home" => 0,
            "End" => total - 1,
            "Escape" => {
                state.chosen.set(None);
                return;
            }
            _ => return,
        };
        event.prevent_default();
        browser::focus(&format!("byte-{}", to.min(total - 1)));
    };
    // One byte is in the order of the tab key; the arrow keys lead to the others.
    Effect::new(move |before: Option<usize>| {
        let now = at.get();
        for (byte, index) in [(before, "-1"), (Some(now), "0")] {
            let id = byte.map(|byte| format!("byte-{byte}"));
            if let Some(cell) = id.and_then(|id| document().get_element_by_id(&id)) {
                let _ = cell.set_attribute("tabindex", index);
            }
        }
        now
    });
    view! {
        <div
            class="strip"
            role="group"
            aria-label="Bytes. Arrow keys go from byte to byte."
            on:pointerover=move |event| state.pointed.set(point(&event))
            on:click=move |event| {
                if let Some(span) = choose(&event) {
                    state.chosen.set(Some(span));
                }
            }
            on:focusin=move |event| {
                if let Some(byte) = browser::number_at(&event, "data-byte") {
                    at.set(byte);
                    state.chosen.set(focus(&event));
                }
            }
            on:keydown=go
        >
            {groups}
            {(rest > 0).then(|| view! { <p class="rest">{format!("and {rest} bytes more")}</p> })}
        </div>
    }
}

fn group(state: State, leaf: &Field, bytes: &[u8]) -> impl IntoView + use<> {
    let span = leaf.span;
    let faulty = leaf.problems.iter().any(|problem| problem.severity == Severity::Error);
    let name = leaf.label().to_string();
    let label = match leaf.number {
        None => leaf.spec.short.to_owned(),
        Some(Numbering::At(_)) => name.rsplit(' ').next().unwrap_or_default().to_owned(),
        Some(Numbering::Offset(n)) => format!("+{n}"),
    };
    let lit = move || state.lit().is_some_and(|lit| lit.from < span.to && span.from < lit.to);
    let cells: Vec<_> = (span.from..span.to.min(MOST))
        .map(|at| {
            let byte = format!("{:02X}", bytes[at]);
            let described = format!("Byte {at}: {byte}, {name}");
            view! {
                <button
                    type="button"
                    id=format!("byte-{at}")
                    data-byte=at
                    tabindex=if at == 0 { "0" } else { "-1" }
                    aria-label=described
                >
                    <b>{byte}</b>
                    <small>{at}</small>
                </button>
            }
        })
        .collect();
    view! {
        <div class=format!("group {}", role_class(leaf.spec.role)) class:faulty=faulty class:lit=lit>
            <span class="name" aria-hidden="true">{label}</span>
            <div class="cells">{cells}</div>
        </div>
    }
}

/// The class that gives a role its colour.
pub fn role_class(role: Role) -> &'static str {
    match role {
        Role::Unit => "role-unit",
        Role::Function => "role-function",
        Role::Address => "role-address",
        Role::Count => "role-count",
        Role::Data => "role-data",
        Role::Status => "role-status",
        Role::Check => "role-check",
        Role::Unknown => "role-unknown",
    }
}
