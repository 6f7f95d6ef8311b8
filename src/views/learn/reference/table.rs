//! What was found, a row each. Only the rows in sight exist; on paper, all of them.

use std::sync::Arc;

use leptos::ev::{self, KeyboardEvent, MouseEvent};
use leptos::html;
use leptos::leptos_dom::helpers::WindowListenerHandle;
use leptos::prelude::*;

use super::{about, is_topic};
use crate::address::{View, href};
use buslens::tool::reference::{About, Item};

/// The height of a row in pixels; the stylesheet has the same.
const HIGH: usize = 32;
/// On a phone it has two lines.
const HIGH_ON_PHONE: usize = 60;
/// Rows before and behind those in sight.
const MORE: usize = 12;

#[component]
pub fn Table(
    rows: Signal<Vec<Arc<Item>>>,
    chosen: Signal<Option<Arc<Item>>>,
    /// Whether the rows say of which book they are.
    with_book: bool,
    on_choose: Callback<Arc<Item>>,
) -> impl IntoView {
    let list = NodeRef::<html::Div>::new();
    let scrolled = RwSignal::new(0_usize);
    let visible = RwSignal::new(600_usize);
    let high = RwSignal::new(row_height());
    let resized = window_event_listener(ev::resize, move |_| high.set(row_height()));
    let printed = RwSignal::new(false);
    let prints = ["beforeprint", "afterprint"]
        .map(|event| window_event_listener_untyped(event, move |_| printed.set(event == "beforeprint")));
    on_cleanup(move || [resized].into_iter().chain(prints).for_each(WindowListenerHandle::remove));
    let total = Memo::new(move |_| rows.with(Vec::len));
    let limited = Memo::new(move |_| {
        let limits = |item: &Arc<Item>| match &item.about {
            About::Register(register) => register.spec.limits.is_some() || !register.spec.unit.is_empty(),
            _ => false,
        };
        rows.with(|rows| rows.iter().any(limits))
    });
    let measure = move || {
        if let Some(list) = list.get_untracked() {
            scrolled.set(list.scroll_top().max(0) as usize);
            visible.set(list.client_height().max(200) as usize);
        }
    };
    let first = Memo::new(move |_| match printed.get() {
        true => 0,
        false => (scrolled.get() / high.get()).saturating_sub(MORE),
    });
    let last = Memo::new(move |_| match printed.get() {
        true => total.get(),
        false => ((scrolled.get() + visible.get()) / high.get() + MORE).min(total.get()),
    });
    let shown = move || {
        let (first, last) = (first.get(), last.get());
        rows.with(|rows| {
            let rows = rows.get(first.min(last)..last).unwrap_or_default();
            (first..).zip(rows.iter().cloned()).collect::<Vec<_>>()
        })
    };
    // Of what has a page of its own, arrows only mark the row.
    let marked = RwSignal::new(None::<usize>);
    let place = Memo::new(move |_| {
        let chosen = chosen.get()?;
        let same = |item: &Arc<Item>| {
            item.key == chosen.key && (item.book, item.chapter) == (chosen.book, chosen.chapter)
        };
        rows.with(|rows| rows.iter().position(same))
    });
    let at = Memo::new(move |_| place.get().or_else(|| marked.get().filter(|at| *at < total.get())));
    // Other rows begin at the top; what is chosen is in sight.
    Effect::new(move |before: Option<usize>| {
        let (Some(list), now) = (list.get(), total.get()) else { return 0 };
        let at = at.get();
        let high = high.get_untracked();
        let height = (list.client_height() as usize).saturating_sub(high);
        let top = list.scroll_top().max(0) as usize;
        if before.is_some_and(|before| before != now) {
            marked.set(None);
        }
        match at.map(|at| at * high) {
            Some(at) if at < top || at + high > top + height => {
                list.set_scroll_top(at.saturating_sub(height / 3) as i32);
            }
            None if before.is_some_and(|before| before != now) => list.set_scroll_top(0),
            _ => {}
        }
        measure();
        now
    });
    let choose = move |at: usize| {
        if let Some(item) = rows.with_untracked(|rows| rows.get(at).cloned()) {
            on_choose.run(item);
        }
    };
    let keys = move |event: KeyboardEvent| {
        let Some(last) = total.get_untracked().checked_sub(1) else { return };
        let page = visible.get_untracked() / high.get_untracked();
        let now = at.get_untracked();
        let to = match (event.key().as_str(), now) {
            ("ArrowDown" | "ArrowUp" | "Enter", None) => 0,
            ("Enter", Some(at)) => at,
            ("ArrowDown", Some(at)) => at + 1,
            ("ArrowUp", Some(at)) => at.saturating_sub(1),
            ("PageDown", at) => at.unwrap_or_default() + page,
            ("PageUp", at) => at.unwrap_or_default().saturating_sub(page),
            ("Home", _) => 0,
            ("End", _) => last,
            _ => return,
        };
        event.prevent_default();
        let to = to.min(last);
        marked.set(Some(to));
        let opens = rows.with_untracked(|rows| rows.get(to).is_some_and(|item| is_topic(item)));
        if !opens || event.key() == "Enter" {
            choose(to);
        }
    };
    let click = Callback::new(move |at: usize| {
        choose(at);
        request_animation_frame(|| {
            // Where the entry is below the list, it comes into sight.
            let narrow =
                window().match_media("(width < 1200px)").ok().flatten().is_some_and(|it| it.matches());
            if let Some(entry) = document().query_selector(".entry").ok().flatten().filter(|_| narrow) {
                entry.scroll_into_view();
            }
        });
    });
    view! {
        <div
            node_ref=list
            class="found"
            class:with-book=with_book
            class:no-limits=move || !limited.get()
            role="grid"
            tabindex="0"
            aria-label="What was found"
            aria-rowcount=move || (total.get() + 1).to_string()
            aria-activedescendant=move || at.get().map(|at| format!("found-{at}"))
            on:scroll=move |_| measure()
            on:keydown=keys
        >
            <div role="row" aria-rowindex="1" class="row head">
                <span role="columnheader" class="n">"Number"</span>
                <span role="columnheader" class="l">"Name"</span>
                <span role="columnheader" class="k">"What it is"</span>
                <span role="columnheader" class="m">"Allowed"</span>
                <span role="columnheader" class="b">"Of"</span>
                <span role="columnheader" class="d">"In Build"</span>
            </div>
            <div class="space" role="rowgroup" style:height=move || format!("{}px", total.get() * high.get())>
                <div
                    role="presentation"
                    class="rows"
                    style:transform=move || format!("translateY({}px)", first.get() * high.get())
                >
                    <For
                        each=shown
                        key=|(place, item)| (*place, item.book.key(), item.chapter.key(), item.key.clone())
                        children=move |(place, item)| {
                            let is_chosen = Signal::derive(move || at.get() == Some(place));
                            row(place, &item, is_chosen, click)
                        }
                    />
                </div>
            </div>
            <p class="nothing" hidden=move || total.get() != 0>
                "Nothing is called so, and nothing has this number. Try a part of the name, or the number as the \
                 manual writes it."
            </p>
        </div>
    }
}

fn row_height() -> usize {
    let narrow = window().match_media("(width < 720px)").ok().flatten().is_some_and(|query| query.matches());
    if narrow { HIGH_ON_PHONE } else { HIGH }
}

fn row(place: usize, item: &Arc<Item>, is_chosen: Signal<bool>, choose: Callback<usize>) -> AnyView {
    let (id, allowed, unit) = match &item.about {
        About::Register(register) => (register.id, register.limits(), register.unit()),
        About::Telegram(_) | About::Code(_) => ("", String::new(), ""),
    };
    let id = (!id.is_empty()).then(|| view! { <span class="id">{id}</span> });
    let cell = |class: &'static str, content: AnyView| {
        view! {
            <span role="gridcell" class=class>
                {content}
            </span>
        }
    };
    // A click on a link is no choice.
    let stop = |event: MouseEvent| event.stop_propagation();
    let drafts = item.drafts().into_iter().map(|(doing, link)| {
        view! {
            <a
                href=href(View::Build, &link)
                tabindex="-1"
                aria-label=format!("{} {} in Build", doing.label(), item.label)
                on:click=stop
            >
                {doing.label()}
            </a>
        }
    });
    view! {
        <div
            id=format!("found-{place}")
            role="row"
            class="row"
            aria-rowindex=place + 2
            aria-selected=move || is_chosen.get().to_string()
            on:click=move |_| choose.run(place)
        >
            {cell("n", item.number.clone().into_any())}
            {cell("l", (item.label.clone(), id).into_any())}
            {cell("k", about(item).into_any())}
            {cell("m", format!("{allowed} {unit}").into_any())}
            {cell("b", item.book.short().into_any())}
            {cell("d", drafts.collect_view().into_any())}
        </div>
    }
    .into_any()
}
