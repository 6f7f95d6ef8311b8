//! The telegrams of the log, a row each. Only the rows in sight exist.

use leptos::ev::{self, KeyboardEvent, MouseEvent};
use leptos::html;
use leptos::prelude::*;

use crate::components::icon::{Glyph, Icon};
use crate::components::state_badge::StateBadge;
use crate::views::read::ReadState;
use crate::views::read::times::{clock, day_and_clock, delta, is_over_days};
use buslens::field::Direction;
use buslens::tool::log::{Row, State};

/// The height of a row in pixels; the stylesheet has the same.
const HIGH: usize = 28;
/// On a phone it has two lines.
const HIGH_ON_PHONE: usize = 56;

/// Browsers draw no element higher than some million pixels: longer lists move in larger steps.
const HIGHEST: usize = 8_000_000;

#[component]
pub fn List() -> impl IntoView {
    let log = expect_context::<ReadState>().log;
    let list = NodeRef::<html::Div>::new();
    let scrolled = RwSignal::new(0_usize);
    let high = RwSignal::new(row_height());
    let resized = window_event_listener(ev::resize, move |_| high.set(row_height()));
    on_cleanup(move || resized.remove());
    let whole = Memo::new(move |_| (log.total.get() * high.get()).min(HIGHEST));
    let steps = Memo::new(move |_| log.total.get() * high.get() > HIGHEST);
    // The first row in sight.
    let first = Memo::new(move |_| {
        if steps.get() {
            (scrolled.get() as f64 / whole.get() as f64 * log.total.get() as f64) as usize
        } else {
            scrolled.get() / high.get()
        }
    });
    let top = move || {
        let from = log.rows.with(|(from, _)| *from);
        if steps.get() {
            // In steps of many rows, those that are known are put where the list is scrolled to.
            scrolled.get().saturating_sub(first.get().saturating_sub(from) * high.get())
        } else {
            from * high.get()
        }
    };
    Effect::new(move |_| log.see(first.get()));
    // Another list begins at its top.
    Effect::watch(
        move || log.lists.get(),
        move |_, _, _| {
            if let Some(list) = list.get_untracked() {
                list.set_scroll_top(0);
                scrolled.set(0);
            }
        },
        false,
    );
    let place = Memo::new(move |_| log.current.with(|current| current.as_ref().and_then(|it| it.told.place)));
    let total = Memo::new(move |_| log.total.get());
    let dated = Memo::new(move |_| {
        log.overview.with(|overview| is_over_days(overview.as_ref().and_then(|overview| overview.times)))
    });
    // The telegram that is shown is in sight, wherever it was chosen. In the next frame: to ask for heights while
    // the rest of the log is being drawn would lay out all of it at once.
    Effect::new(move |_| {
        let (Some(place), Some(list)) = (place.get(), list.get()) else { return };
        let total = total.get();
        request_animation_frame(move || {
            // The log may be closed by now.
            let (Some(high), Some(steps)) = (high.try_get_untracked(), steps.try_get_untracked()) else {
                return;
            };
            // The head of the list stays over its first rows.
            let height = (list.client_height() as usize).saturating_sub(high);
            let scrolled = list.scroll_top().max(0) as usize;
            let at = if steps {
                (place as f64 / total.max(1) as f64 * whole.try_get_untracked().unwrap_or_default() as f64)
                    as usize
            } else {
                place * high
            };
            if at < scrolled || at + high > scrolled + height {
                list.set_scroll_top(at.saturating_sub(height / 3) as i32);
            }
        });
    });
    let rows = move || log.rows.with(|(from, rows)| (*from..).zip(rows.iter().cloned()).collect::<Vec<_>>());
    let keys = move |event: KeyboardEvent| {
        let Some(last) = log.total.get_untracked().checked_sub(1) else { return };
        let page =
            list.get_untracked().map_or(10, |list| list.client_height() as usize / high.get_untracked());
        let at = place.get_untracked().unwrap_or_default();
        let to = match event.key().as_str() {
            "ArrowDown" => at + 1,
            "ArrowUp" => at.saturating_sub(1),
            "PageDown" => at + page,
            "PageUp" => at.saturating_sub(page),
            "Home" => 0,
            "End" => last,
            _ => return,
        };
        event.prevent_default();
        log.select(to.min(last));
    };
    let heads = [
        ("n", "#"),
        ("t", "Time"),
        ("d", "Δ ms"),
        ("u", "Unit"),
        ("a", ""),
        ("s", "Meaning"),
        ("st", "State"),
    ];
    let heads = heads.map(|(class, title)| {
        view! {
            <span role="columnheader" class=class>
                {title}
                {(title.is_empty()).then(|| view! { <span class="unseen">"Direction"</span> })}
            </span>
        }
    });
    view! {
        <div
            node_ref=list
            class="list"
            class:untimed=move || log.overview.with(|it| it.as_ref().is_some_and(|it| it.times.is_none()))
            class:dated=move || dated.get()
            role="grid"
            tabindex="0"
            aria-label="Telegrams"
            aria-rowcount=move || (total.get() + 1).to_string()
            aria-activedescendant=move || place.get().map(|place| format!("row-{place}"))
            on:scroll=move |_| {
                if let Some(list) = list.get_untracked() {
                    scrolled.set(list.scroll_top().max(0) as usize);
                }
            }
            on:keydown=keys
        >
            <div role="row" aria-rowindex="1" class="row head">
                {heads.into_iter().collect_view()}
            </div>
            <div class="space" role="rowgroup" style:height=move || format!("{}px", whole.get())>
                <div role="presentation" class="rows" style:transform=move || format!("translateY({}px)", top())>
                    <For
                        each=rows
                        key=|(place, row)| (*place, row.index)
                        children=move |(place, row)| view! { <ListRow place row dated=dated.get_untracked() /> }
                    />
                </div>
            </div>
            <Show when=move || total.get() == 0>
                <p class="nothing">
                    "No telegram is like that. "
                    <button type="button" class="link" on:click=move |_| log.show_all()>
                        "Show everything"
                    </button>
                </p>
            </Show>
        </div>
    }
}

fn row_height() -> usize {
    let narrow = window().match_media("(width < 720px)").ok().flatten().is_some_and(|query| query.matches());
    if narrow { HIGH_ON_PHONE } else { HIGH }
}

#[component]
fn ListRow(place: usize, row: Row, dated: bool) -> impl IntoView {
    let log = expect_context::<ReadState>().log;
    let Row { index, time, delta: since, unit, direction, said, state, latency, .. } = row;
    let is_chosen = move || {
        log.current.with(|current| current.as_ref().is_some_and(|current| current.told.row.index == index))
    };
    let is_hit = move || {
        log.with_evidence(|evidence| evidence.binary_search(&(index as u32)).is_ok()).unwrap_or_default()
    };
    let (arrow, words) = match direction {
        Some(Direction::Request) => ("→", "request"),
        Some(Direction::Response) => ("←", "response"),
        None => ("·", "no telegram"),
    };
    let note = move || {
        log.notes.with(|notes| notes.get(&(index + 1)).cloned()).map(|note| {
            view! {
                <span class="noted" title="Your note">
                    <Icon glyph=Glyph::Edit />
                    {note}
                </span>
            }
        })
    };
    // A click on a cell filters by it.
    let by_unit = move |event: MouseEvent| {
        event.stop_propagation();
        log.filter_by(|filter| filter.unit = unit);
    };
    let by_direction = move |event: MouseEvent| {
        event.stop_propagation();
        log.filter_by(|filter| filter.direction = direction);
    };
    let by_state = move |event: MouseEvent| {
        event.stop_propagation();
        log.filter_by(|filter| filter.state = Some(state));
    };
    let (before, value) = match said.split_once(" = ") {
        Some((before, value)) => (format!("{before} = "), value.to_owned()),
        None => (said, String::new()),
    };
    view! {
        <div
            id=format!("row-{place}")
            role="row"
            class="row"
            class:asks=direction == Some(Direction::Request)
            class:hit=move || is_hit()
            aria-rowindex=place + 2
            aria-selected=move || is_chosen().to_string()
            on:click=move |_| log.select(place)
        >
            <span role="gridcell" class="n">{index + 1}</span>
            <span role="gridcell" class="t">{time.map(if dated { day_and_clock } else { clock })}</span>
            <span role="gridcell" class="d">{since.map(delta)}</span>
            <span role="gridcell" class="u">
                {unit
                    .map(|unit| {
                        view! {
                            <button
                                type="button"
                                tabindex="-1"
                                title="Only this unit"
                                aria-label=format!("unit {unit}")
                                on:click=by_unit
                            >
                                {unit}
                            </button>
                        }
                    })}
            </span>
            <span role="gridcell" class="a">
                <button type="button" tabindex="-1" title=format!("A {words}: only such") aria-label=words on:click=by_direction>
                    {arrow}
                </button>
            </span>
            <span role="gridcell" class="s">
                {note} {before} <b>{value}</b>
            </span>
            <span role="gridcell" class="st">
                // A request without a word says nothing here.
                {(state != State::Plain)
                    .then(|| {
                        view! {
                            <button type="button" tabindex="-1" title="Only such" on:click=by_state>
                                <StateBadge state latency />
                            </button>
                        }
                    })}
            </span>
        </div>
    }
}
