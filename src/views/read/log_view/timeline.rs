//! What happened over time, a lane for each unit. Dragging over it chooses a stretch.

use leptos::ev::{KeyboardEvent, PointerEvent};
use leptos::html;
use leptos::prelude::*;

use crate::components::icon::{Glyph, Icon};
use crate::views::read::ReadState;
use crate::views::read::times::{clock, duration};
use crate::worker::messages::Request;
use buslens::field::decimal;
use buslens::tool::log::{Filter, Lane, Lanes, Mark, State};

/// The height of a lane and of a mark in it, in pixels.
const LANE: usize = 24;
const MARK: usize = 14;

/// How far along something is that has so many stretches, for a style.
fn percent(at: f64, of: usize) -> String {
    decimal(at * 100.0 / of as f64, 3) + "%"
}

#[component]
pub fn Timeline() -> impl IntoView {
    let log = expect_context::<ReadState>().log;
    let picture = NodeRef::<html::Div>::new();
    // The stretches between which somebody drags, and the one that keys are at.
    let dragged = RwSignal::new(None::<(usize, usize)>);
    let at = RwSignal::new(0_usize);
    let stretches = move || log.lanes.with(|lanes| lanes.stretches.max(1));
    let stretch_at = move |event: &PointerEvent| {
        let width = picture.get_untracked().map_or(1, |it| it.client_width()).max(1);
        let left = picture.get_untracked().map_or(0.0, |it| it.get_bounding_client_rect().left());
        let part = (f64::from(event.client_x()) - left) / f64::from(width);
        ((part.clamp(0.0, 1.0) * stretches() as f64) as usize).min(stretches() - 1)
    };
    let choose = move |from: usize, to: usize| {
        let between = log.lanes.with_untracked(|lanes| (edge(lanes, from), edge(lanes, to + 1) - 1));
        let timed = log.lanes.with_untracked(|lanes| lanes.timed);
        log.filter_by(|filter| narrow(filter, timed, Some(between)));
        log.ask(Request::Lanes(Some(between)));
    };
    let all = move |_| {
        let timed = log.lanes.with_untracked(|lanes| lanes.timed);
        log.filter_by(|filter| narrow(filter, timed, None));
        log.ask(Request::Lanes(None));
    };
    let down = move |event: PointerEvent| {
        if event.button() == 0 {
            let at = stretch_at(&event);
            dragged.set(Some((at, at)));
            if let Some(picture) = picture.get_untracked() {
                // Without it, a drag that leaves the picture ends there.
                let _ = picture.set_pointer_capture(event.pointer_id());
            }
        }
    };
    let moved = move |event: PointerEvent| {
        let to = stretch_at(&event);
        dragged.update(|dragged| {
            if let Some((_, end)) = dragged {
                *end = to;
            }
        });
    };
    let up = move |_| {
        if let Some((from, to)) = dragged.get_untracked() {
            dragged.set(None);
            choose(from.min(to), from.max(to));
        }
    };
    let keys = move |event: KeyboardEvent| {
        let last = stretches() - 1;
        let step = if event.shift_key() { 10 } else { 1 };
        let to = match event.key().as_str() {
            "ArrowRight" => (at.get_untracked() + step).min(last),
            "ArrowLeft" => at.get_untracked().saturating_sub(step),
            "Home" => 0,
            "End" => last,
            "Enter" | " " => {
                event.prevent_default();
                let around = last / 20;
                let at = at.get_untracked();
                return choose(at.saturating_sub(around), (at + around).min(last));
            }
            _ => return,
        };
        event.prevent_default();
        at.set(to);
    };
    let zoomed = move || log.filter.with(|filter| filter.times.is_some() || filter.places.is_some());
    let names = move || {
        log.lanes.with(|lanes| {
            lanes
                .lanes
                .iter()
                .map(|lane| {
                    let name = lane_name(lane);
                    let title = name.clone();
                    view! { <li title=title>{name}</li> }
                })
                .collect_view()
        })
    };
    let lanes = move || log.lanes.with(draw);
    let ends = move || {
        log.lanes.with(|lanes| {
            const TICKS: usize = 6;
            (0..=TICKS)
                .map(|tick| place(lanes, edge(lanes, lanes.stretches * tick / TICKS)))
                .map(|text| view! { <span>{text}</span> })
                .collect_view()
        })
    };
    let band = move || {
        let (from, to) = dragged.get()?;
        let (from, to) = (from.min(to), from.max(to) + 1);
        let edge = |at: usize| percent(at as f64, stretches());
        Some(view! { <span class="band" style:left=edge(from) style:width=edge(to - from)></span> })
    };
    let shown = move || {
        let row_time = log
            .current
            .with(|current| current.as_ref().map(|current| (current.told.row.time, current.told.row.index)));
        log.lanes.with(|lanes| {
            let (time, index) = row_time?;
            let at = if lanes.timed { time? } else { index as i64 };
            let part = (at - lanes.from) as f64 / ((lanes.to - lanes.from).max(1)) as f64;
            (0.0..=1.0).contains(&part).then(|| {
                view! { <span class="cursor" style:left=percent(part, 1)></span> }
            })
        })
    };
    let words = move || log.lanes.with(|lanes| words(lanes, at.get()));
    view! {
        <figure class="timeline" aria-label="What happened over time, a lane for each unit">
            <ol class="lane-names">{names}</ol>
            <div class="lanes">
                <div
                    node_ref=picture
                    class="picture"
                    role="slider"
                    tabindex="0"
                    aria-label="A place in time. Arrow keys go along, Enter zooms in"
                    aria-valuemin="0"
                    aria-valuemax=move || (stretches() - 1).to_string()
                    aria-valuenow=move || at.get().min(stretches() - 1).to_string()
                    aria-valuetext=words
                    on:pointerdown=down
                    on:pointermove=moved
                    on:pointerup=up
                    on:pointercancel=move |_| dragged.set(None)
                    on:keydown=keys
                >
                    {lanes} {band} {shown}
                    <span
                        class="key-cursor"
                        style:left=move || percent(at.get() as f64 + 0.5, stretches())
                    ></span>
                </div>
                <p class="ends number">{ends}</p>
            </div>
            <Show when=zoomed>
                <button type="button" class="button low whole" on:click=all>
                    <Icon glyph=Glyph::Search />
                    "Whole log"
                </button>
            </Show>
        </figure>
    }
}

/// Lets only what lies in a stretch into the list, or everything.
fn narrow(filter: &mut Filter, timed: bool, between: Option<(i64, i64)>) {
    if timed {
        filter.times = between;
    } else {
        filter.places = between.map(|(from, to)| (from.max(0) as usize, to.max(0) as usize));
    }
}

fn lane_name(lane: &Lane) -> String {
    match lane.unit {
        _ if lane.others => "others, damaged".to_owned(),
        Some(unit) => format!("Unit {unit}"),
        None => "the line".to_owned(),
    }
}

/// Where stretch `at` begins.
fn edge(lanes: &Lanes, at: usize) -> i64 {
    let span = i128::from(lanes.to) - i128::from(lanes.from) + 1;
    lanes.from + (span * at as i128 / lanes.stretches.max(1) as i128) as i64
}

fn place(lanes: &Lanes, at: i64) -> String {
    /// Nobody reads microseconds off a picture.
    const MILLI: i64 = 1000;
    if lanes.timed { clock(at.div_euclid(MILLI) * MILLI) } else { format!("# {}", at + 1) }
}

/// What a stretch holds, for who does not see it.
fn words(lanes: &Lanes, at: usize) -> String {
    let (from, to) = (place(lanes, edge(lanes, at)), place(lanes, edge(lanes, at + 1)));
    let mut text = format!("{from} to {to}");
    for lane in &lanes.lanes {
        if let Some(mark) = lane.marks.iter().find(|mark| mark.at == at) {
            text += &format!(", {}: {} telegrams, {}", lane_name(lane), mark.telegrams, mark.state.word());
        }
    }
    text
}

/// The marks of all lanes: one path for each class, whatever their number.
fn draw(lanes: &Lanes) -> impl IntoView + use<> {
    const CLASSES: [&str; 5] = ["fine", "warn", "open", "bad", "quiet"];
    let width = lanes.stretches.max(1);
    let height = (lanes.lanes.len() * LANE).max(LANE);
    let paths = CLASSES.map(|class| {
        let mut path = String::new();
        for (row, lane) in lanes.lanes.iter().enumerate() {
            let top = row * LANE + (LANE - MARK) / 2;
            for mark in lane.marks.iter().filter(|mark| class_of(mark) == class) {
                path += &format!("M{} {top}h.8v{MARK}h-.8z", mark.at);
            }
        }
        view! { <path class=class d=path /> }
    });
    // The longest waits have room for their words where few stand beside them.
    let slow = lanes.lanes.iter().enumerate().flat_map(|(row, lane)| {
        let few = lane.marks.len() * 4 < width;
        let slow = lane.marks.iter().filter(move |mark| few && mark.worst.is_some());
        slow.map(move |mark| (row, mark.at, mark.worst.unwrap_or_default()))
    });
    let slow: Vec<_> = slow
        .take(12)
        .map(|(row, at, worst)| {
            view! {
                <span
                    class="slow"
                    style:left=percent(at as f64 + 1.2, width)
                    style:top=format!("{}px", row * LANE + (LANE - 16) / 2)
                >
                    {duration(worst.into())}
                </span>
            }
        })
        .collect();
    view! {
        <svg viewBox=format!("0 0 {width} {height}") preserveAspectRatio="none" style:height=format!("{height}px")>
            {paths.into_iter().collect_view()}
        </svg>
        {slow}
    }
}

fn class_of(mark: &Mark) -> &'static str {
    match mark.state {
        State::Plain | State::Ok => "fine",
        State::Broadcast | State::Copy | State::Echo => "quiet",
        State::Retry | State::Slow | State::Late | State::Unasked => "warn",
        State::Unanswered | State::Discarded | State::Cut => "open",
        State::Refused | State::Damaged => "bad",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stretches_tile_the_time() {
        let lanes = Lanes { from: 1000, to: 1999, stretches: 10, timed: true, ..Lanes::default() };
        assert_eq!((edge(&lanes, 0), edge(&lanes, 1), edge(&lanes, 10)), (1000, 1100, 2000));
    }
}
