//! A log: what it says as a whole, its telegrams as a list, and one of them beside it.

mod detail;
mod filters;
mod list;
mod overview;
mod timeline;
mod tools;

use std::sync::Arc;

use leptos::prelude::*;

use super::ReadState;
use super::log::Stage;
use super::times::stretch;
use crate::browser::typing::go_to_field;
use crate::components::icon::{Glyph, Icon};
use crate::components::menu::{Menu, MenuItem, MenuLink};
use crate::components::open_file::OpenFile;
use crate::views::outgoing::{PassOn, Summary};
use crate::worker::messages::{Export, Request};
use buslens::field::many;
use buslens::tool::digest::Digest;
use detail::Detail;
use filters::Filters;
use list::List;
use overview::Overview;
use timeline::Timeline;
use tools::Tools;

#[component]
pub fn LogView() -> impl IntoView {
    let log = expect_context::<ReadState>().log;
    // The overview can be folded, so that the list has the whole height.
    let folded = RwSignal::new(false);
    let ready = Memo::new(move |_| log.overview.with(Option::is_some));
    view! {
        <FileBar />
        <Progress />
        <Show when=move || ready.get()>
            <div class="log" class:folded=move || folded.get()>
                <Show when=move || !folded.get()>
                    <Overview />
                    <Timeline />
                </Show>
                <Filters folded />
                <div class="panes">
                    <List />
                    <Detail />
                </div>
            </div>
        </Show>
    }
}

/// What is open, and what can be done with all of it.
#[component]
fn FileBar() -> impl IntoView {
    let read = expect_context::<ReadState>();
    let log = read.log;
    let about = move || {
        log.overview.with(|overview| {
            let overview = overview.as_ref()?;
            let mut said = vec![many(overview.telegrams, "telegram"), overview.protocol.clone()];
            if let Some((from, to)) = overview.times.filter(|(from, to)| to > from) {
                let zone = if overview.utc { " UTC" } else { "" };
                said.push(format!("{}{zone}", stretch(from, to)));
            }
            Some(said.join(" · "))
        })
    };
    let format = move || log.overview.with(|it| it.as_ref().map(|it| format!("Read as: {}", it.format)));
    let name = Signal::derive(move || read.file_name().unwrap_or_else(|| "Pasted text".to_owned()));
    let export = move |kind: Export| {
        let save = Callback::new(move |()| log.export(kind));
        view! { <MenuItem on_choose=save>{kind.label()}</MenuItem> }
    };
    let [summary, pass_on] = [(); 2].map(|()| RwSignal::new(false));
    let titled = Signal::derive(move || {
        let digest = log.digest.get()?;
        Some(Arc::new(Digest { title: read.file_name().unwrap_or_default(), ..(*digest).clone() }))
    });
    let sum_up = move |_| {
        log.digest.set(None);
        log.ask(Request::Digest);
        summary.set(true);
    };
    let edit = move |_| {
        read.editing.update(|editing| *editing = !*editing);
        if read.editing.get_untracked() {
            request_animation_frame(go_to_field);
        }
    };
    let edit_label = move || if read.editing.get() { "Hide text" } else { "Edit text" };
    view! {
        <section class="file-bar" aria-label="File">
            <Icon glyph=Glyph::File />
            <strong>{name}</strong>
            <span class="soft number" title=format>
                {move || about()}
            </span>
            <div class="acts">
                <Show when=move || read.is_text()>
                    <button type="button" class="button plain" on:click=edit>
                        <Icon glyph=Glyph::Edit />
                        {move || edit_label()}
                    </button>
                </Show>
                <button type="button" class="button plain" on:click=move |_| read.clear()>
                    <Icon glyph=Glyph::Close />
                    "Close"
                </button>
                <OpenFile label="Open another" class="plain" on_open=read.opener() />
                <Tools />
                <Menu label="Export" glyph=Glyph::Save at_end=true>
                    {Export::FILES.map(export).into_iter().collect_view()}
                    <MenuItem on_choose=Callback::new(move |()| pass_on.set(true))>"A log to pass on"</MenuItem>
                    <MenuLink href="#/sheet">"A report to print"</MenuLink>
                    <MenuLink href="#/learn?place=practice.read">"A task for learners"</MenuLink>
                </Menu>
                <button type="button" class="button main" on:click=sum_up>
                    <Icon glyph=Glyph::Mail />
                    "Copy summary for a mail"
                </button>
            </div>
            <Summary open=summary digest=titled print="#/sheet" />
            <PassOn
                open=pass_on
                name
                ask=Callback::new(move |hidden| log.ask(Request::PassOn(hidden)))
                passed=log.passed
            />
        </section>
    }
}

/// How far the file is read, or why it is not.
#[component]
fn Progress() -> impl IntoView {
    let read = expect_context::<ReadState>();
    let log = read.log;
    let again = move |_| read.read_again();
    move || match log.stage.get() {
        // What takes no time needs no progress.
        Stage::Reading { of, .. } if of < 500_000.0 => None,
        Stage::Reading { done, of, telegrams, since } => {
            let passed = web_sys::js_sys::Date::now() - since;
            let left = if done > 0.0 { passed / done * (of - done) / 1000.0 } else { 0.0 };
            let left = if left >= 1.0 { format!(", {left:.0} s left") } else { String::new() };
            let percent = done / of.max(1.0) * 100.0;
            Some(
                view! {
                    <div class="reading-on">
                        <progress max=of.max(1.0).to_string() value=done.to_string() aria-label="Read"></progress>
                        <span class="number">
                            {format!("{percent:.0} %, {}{left}", many(telegrams, "telegram"))}
                        </span>
                        <button type="button" class="button low" on:click=move |_| log.stop()>
                            "Stop"
                        </button>
                    </div>
                }
                .into_any(),
            )
        }
        Stage::Refused(why) => Some(
            view! {
                <p class="refused" role="alert">
                    <Icon glyph=Glyph::Warning />
                    {why}
                </p>
            }
            .into_any(),
        ),
        Stage::Lost(why) => Some(
            view! {
                <div class="refused" role="alert">
                    <Icon glyph=Glyph::Warning />
                    <span>{why}</span>
                    <button type="button" class="button low" on:click=again>
                        "Read it again"
                    </button>
                </div>
            }
            .into_any(),
        ),
        Stage::Closed | Stage::Ready => None,
    }
}
