//! The request and its reply, side by side: what they say, their bytes, their fields.

use leptos::ev::KeyboardEvent;
use leptos::html;
use leptos::prelude::*;

use super::state::{BuildState, Built, Reply};
use crate::address::{View, href};
use crate::components::byte_strip::{ByteStrip, Lights, blocks};
use crate::components::copy_as::CopyAs;
use crate::components::copy_button::CopyButton;
use crate::components::field_table::{FieldTable, rows};
use crate::components::icon::{Glyph, Icon};
use crate::components::problems::Problems;
use crate::components::roving;
use crate::components::segments::Segments;
use crate::components::telegram::Shown;
use buslens::field::{Direction, Message, hex};
use buslens::tool::Options;
use buslens::tool::link::Link;

/// A telegram: sentence, bytes, what can be done with it, fields.
#[component]
fn Side(#[prop(into)] shown: Signal<Option<Shown>>, lights: Lights, children: ChildrenFn) -> impl IntoView {
    let blocks = Memo::new(move |_| {
        shown.with(|shown| shown.as_ref().map_or(Vec::new(), |it| blocks(&it.detail, it.bytes())))
    });
    let rows = Memo::new(move |_| {
        shown.with(|shown| shown.as_ref().map_or(Vec::new(), |it| rows(&it.detail, it.bytes())))
    });
    let said = move || shown.with(|shown| shown.as_ref().map(|it| it.detail.meaning().sentence() + "."));
    let problems = move || shown.get().map(|shown| view! { <Problems shown lights /> });
    view! {
        <h3 class="said">{said}</h3>
        <ByteStrip blocks lights size="small" />
        <div class="actions">{children()}</div>
        {move || problems()}
        <FieldTable rows lights label="Fields" />
    }
}

/// The bytes in hex.
fn bytes_of(shown: Signal<Option<Shown>>) -> Signal<String> {
    Signal::derive(move || shown.with(|shown| shown.as_ref().map_or(String::new(), |it| hex(it.bytes()))))
}

fn length(shown: Signal<Option<Shown>>) -> impl Fn() -> Option<String> + Copy {
    move || shown.with(|shown| shown.as_ref().map(|it| Message::bytes(it.bytes().len()).to_string()))
}

/// What can be done with any telegram.
#[component]
fn Actions(#[prop(into)] shown: Signal<Option<Shown>>, main: bool) -> impl IntoView {
    let state = expect_context::<BuildState>();
    let read = move || {
        let this = shown.get()?;
        // A response says more behind its request.
        let link = match (state.shown_request(), this.telegram.guess.direction) {
            (Some(request), Direction::Response) if this.telegram.answers.is_some() => Link {
                telegram: 1,
                ..Link::to(
                    format!("{}\n{}", hex(request.bytes()), hex(this.bytes())),
                    Options { direction: None, ..this.options.clone() },
                )
            },
            _ => this.link(),
        };
        Some(href(View::Read, &link))
    };
    view! {
        <CopyButton text=bytes_of(shown) label="Copy hex" class=if main { "main" } else { "" } />
        <CopyAs shown />
        <a class="button" href=read aria-label="Open in Read">
            <Icon glyph=Glyph::Read />
            "Read"
        </a>
    }
}

#[component]
pub fn RequestSide() -> impl IntoView {
    let state = expect_context::<BuildState>();
    let shown = Signal::derive(move || state.shown_request());
    let built = state.built();
    let stale = move || built.with(|built| built.direction == Direction::Request && built.is_stale());
    let editable = move || built.with(|built| built.request.is_some());
    let nothing = move || shown.with(Option::is_none) && built.with(|built| built.telegram.is_none());
    view! {
        <Show when=nothing>
            <section class="side" aria-label="Request">
                <p class="note">"No telegram yet: the form says what is missing."</p>
            </section>
        </Show>
        <Show when=move || shown.with(Option::is_some)>
            <section class="side" class:stale=move || stale() aria-label="Request">
                <header>
                    <span aria-hidden="true">"→"</span>
                    <b>"Request"</b>
                    <span>{length(shown)}</span>
                    <Show when=stale>
                        <span class="state warn">"last valid"</span>
                    </Show>
                </header>
                <Side shown lights=state.request_lights>
                    <Actions shown main=true />
                    <Show when=editable>
                        <button type="button" class="button" on:click=move |_| state.edit_request()>
                            <Icon glyph=Glyph::Edit />
                            "Edit the request"
                        </button>
                    </Show>
                </Side>
            </section>
        </Show>
    }
}

#[component]
pub fn ReplySide() -> impl IntoView {
    let state = expect_context::<BuildState>();
    let built = state.built();
    let shown = Signal::from(Memo::new(move |_| state.shown_reply()));
    let edited = Memo::new(move |_| built.with(|built| built.direction == Direction::Response));
    let stale = move || edited.get() && built.with(Built::is_stale);
    let exceptions = Memo::new(move |_| {
        built.with(|built| built.replies.iter().cloned().enumerate().skip(1).collect::<Vec<_>>())
    });
    let normal = Signal::derive(move || state.reply.get() == 0);
    let switch = Callback::new(move |normal: bool| state.reply.set(usize::from(!normal)));
    let list = NodeRef::<html::Ol>::new();
    let keys = move |event: KeyboardEvent| {
        let to = list.get_untracked().and_then(|list| roving::follow(&event, &list, "button"));
        if let Some(at) = to {
            // The first of all replies is no exception.
            state.reply.set(at + 1);
        }
    };
    let row = move |(index, reply): (usize, Reply)| {
        let here = move || state.reply.get() == index;
        let is_stop = move || state.reply.get().max(1) == index;
        view! {
            <li class:chosen=move || here()>
                <button
                    type="button"
                    tabindex=move || if is_stop() { "0" } else { "-1" }
                    aria-pressed=move || here().to_string()
                    on:click=move |_| state.reply.set(index)
                >
                    <span>{reply.label}</span>
                    <code>{hex(&reply.bytes)}</code>
                </button>
            </li>
        }
    };
    view! {
        <Show when=move || shown.with(Option::is_some)>
            <section class="side" class:stale=move || stale() aria-label="Reply">
                <header>
                    <span aria-hidden="true">"←"</span>
                    <b>"Reply"</b>
                    <span>{length(shown)}</span>
                    <Show when=stale>
                        <span class="state warn">"last valid"</span>
                    </Show>
                    <Show when=move || !edited.get() && !exceptions.with(Vec::is_empty)>
                        <Segments
                            label="Which reply"
                            options=vec![(true, "Normal".to_owned()), (false, "Exception".to_owned())]
                            value=normal
                            on_choose=switch
                            class="low"
                        />
                    </Show>
                </header>
                <Side shown lights=state.reply_lights>
                    <Actions shown main=false />
                    <Show when=move || !edited.get()>
                        <button type="button" class="button" on:click=move |_| state.edit_reply()>
                            <Icon glyph=Glyph::Edit />
                            "Edit the reply"
                        </button>
                    </Show>
                </Side>
                <Show when=move || !edited.get() && !exceptions.with(Vec::is_empty)>
                    <div class="exceptions">
                        <h3>"Or an exception"</h3>
                        <ol node_ref=list on:keydown=keys>
                            <For each=move || exceptions.get() key=|row| row.clone() children=row />
                        </ol>
                    </div>
                </Show>
            </section>
        </Show>
    }
}

/// The bytes of what is edited, where the screen is too narrow to have them beside the form.
#[component]
pub fn Dock() -> impl IntoView {
    let state = expect_context::<BuildState>();
    let built = state.built();
    let shown = Signal::derive(move || built.with(|built| built.telegram.clone()));
    let blocks = Memo::new(move |_| {
        shown.with(|shown| shown.as_ref().map_or(Vec::new(), |it| blocks(&it.detail, it.bytes())))
    });
    let lights = move || built.with(|built| built.direction);
    let name = move || match built.with(|built| built.direction) {
        Direction::Request => "Request",
        Direction::Response => "Reply",
    };
    let direction = Memo::new(move |_| lights());
    view! {
        <aside class="dock" class:stale=move || built.with(Built::is_stale) aria-label="Bytes of what is edited">
            <p>
                <b>{move || name()}</b>
                <span>{length(shown)}</span>
                <Show when=move || built.with(Built::is_stale)>
                    <span class="state warn">"last valid"</span>
                </Show>
                <CopyButton text=bytes_of(shown) label="Copy hex" class="main low" />
            </p>
            {move || {
                let lights = match direction.get() {
                    Direction::Request => state.request_lights,
                    Direction::Response => state.reply_lights,
                };
                view! { <ByteStrip blocks lights size="tiny" /> }
            }}
        </aside>
    }
}
