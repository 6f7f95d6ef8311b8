//! What chooses among the telegrams of the log.

use gloo_timers::callback::Timeout;
use leptos::html;
use leptos::prelude::*;

use crate::components::choose::{Choose, choices};
use crate::components::icon::{Glyph, Icon};
use crate::components::segments::Segments;
use crate::views::read::ReadState;
use crate::views::read::times::stretch;
use crate::worker::messages::{Request, Which};
use buslens::field::{Direction, many};
use buslens::tool::log::{Filter, State, Wanted};

#[component]
pub fn Filters(folded: RwSignal<bool>) -> impl IntoView {
    let log = expect_context::<ReadState>().log;
    let waiting = StoredValue::new_local(None::<Timeout>);
    let text = move || log.filter.with(|filter| filter.text.clone());
    // Searching a large file at each letter would only keep the reader from the last one.
    let search = move |text: String| {
        const PAUSE: u32 = 250;
        let find = move || log.filter_by(|filter| filter.text.clone_from(&text));
        waiting.set_value(Some(Timeout::new(PAUSE, find)));
    };
    let place = move || {
        log.current
            .with_untracked(|current| current.as_ref().and_then(|it| it.told.place))
            .unwrap_or_default()
    };
    let step = move |forwards: bool| log.ask(Request::Show(Which::Wrong { from: place(), forwards }));
    let wrong = move || log.overview.with(|it| it.as_ref().map_or(0, |it| it.wrong));
    let count = move || {
        let all = log.overview.with(|it| it.as_ref().map_or(0, |it| it.rows));
        let total = log.total.get();
        let noun = many(all, "row");
        if log.is_filtered() { format!("{total} of {noun}") } else { format!("{noun}, {} not ok", wrong()) }
    };
    let bar = NodeRef::<html::Section>::new();
    // Where the story is high and the window low, the list may be out of sight.
    Effect::new(move |before: Option<()>| {
        log.to_list.track();
        let height = window().inner_height().ok().and_then(|it| it.as_f64()).unwrap_or_default();
        if let Some(bar) = bar.get().filter(|_| before.is_some())
            && bar.get_bounding_client_rect().bottom() > height * 0.7
        {
            bar.scroll_into_view();
        }
    });
    view! {
        <section class="filters" aria-label="Choose among the telegrams" node_ref=bar>
            <label class="search">
                <Icon glyph=Glyph::Search />
                <input
                    type="search"
                    autocomplete="off"
                    aria-label="Search: value, name, register, bytes, any text of the log"
                    placeholder="Name, register, bytes, any text"
                    prop:value=text
                    on:input=move |event| search(event_target_value(&event))
                />
            </label>
            <Wanteds />
            <FindingChip />
            <FilterChips />
            <span class="steps">
                <button
                    type="button"
                    class="button plain low icon-only"
                    aria-label="Previous telegram that is not ok"
                    on:click=move |_| step(false)
                >
                    <Icon glyph=Glyph::Up />
                </button>
                "not ok"
                <button
                    type="button"
                    class="button plain low icon-only"
                    aria-label="Next telegram that is not ok"
                    on:click=move |_| step(true)
                >
                    <Icon glyph=Glyph::Down />
                </button>
            </span>
            <span class="end">
                <span class="number">{count}</span>
                <button
                    type="button"
                    class="button plain low"
                    aria-expanded=move || (!folded.get()).to_string()
                    on:click=move |_| folded.update(|folded| *folded = !*folded)
                >
                    {move || {
                        let glyph = if folded.get() { Glyph::ChevronRight } else { Glyph::ChevronDown };
                        view! { <Icon glyph /> }
                    }}
                    "Overview"
                </button>
            </span>
        </section>
    }
}

/// Which telegrams by how it went, by unit, by function.
#[component]
fn Wanteds() -> impl IntoView {
    let log = expect_context::<ReadState>().log;
    let wanted = Wanted::ALL.iter().filter(|it| **it != Wanted::All);
    let wanted = choices(wanted.map(|it| (it.key(), it.label())));
    let value = move || {
        log.filter.with(|filter| match filter.wanted {
            Wanted::All => String::new(),
            wanted => wanted.key().to_owned(),
        })
    };
    let choose = Callback::new(move |key: String| {
        log.filter_by(|filter| filter.wanted = Wanted::of(&key).unwrap_or_default());
    });
    view! {
        <Choose label="Show" otherwise="everything" options=wanted value=Signal::derive(value) on_choose=choose />
    }
}

/// The finding that is followed, to step through its telegrams, to take it off.
#[component]
fn FindingChip() -> impl IntoView {
    let log = expect_context::<ReadState>().log;
    let place = move || {
        let at = log.current.with(|current| current.as_ref().map(|it| it.told.row.index as u32));
        log.with_evidence(|evidence| {
            let of = evidence.len();
            match at.and_then(|at| evidence.iter().position(|index| *index == at)) {
                Some(place) => format!("{} of {of}", place + 1),
                None => many(of, "telegram"),
            }
        })
    };
    let title = move || {
        let index = log.finding.get()?;
        log.findings.with(|findings| {
            let text = &findings.get(index)?.text;
            Some(text.split(['.', ':']).next().unwrap_or_default().to_owned())
        })
    };
    view! {
        <Show when=move || log.finding.get().is_some()>
            <button type="button" class="chip finding-chip" on:click=move |_| log.leave_finding()>
                <Icon glyph=Glyph::Close />
                <span class="unseen">"Clear the finding:  "</span>
                <span class="title">{title}</span>
            </button>
            <span class="steps">
                <button
                    type="button"
                    class="button plain low icon-only"
                    aria-label="Previous telegram of the finding"
                    on:click=move |_| log.step_in_finding(Some(false))
                >
                    <Icon glyph=Glyph::Up />
                </button>
                <span class="number">{place}</span>
                <button
                    type="button"
                    class="button plain low icon-only"
                    aria-label="Next telegram of the finding"
                    on:click=move |_| log.step_in_finding(Some(true))
                >
                    <Icon glyph=Glyph::Down />
                </button>
            </span>
            <Segments
                label="The telegrams of the finding"
                options=vec![(false, "Mark".to_owned()), (true, "Only these".to_owned())]
                value=log.only
                on_choose=Callback::new(move |only| log.show_only(only))
                class="low"
            />
        </Show>
    }
}

/// What else is filtered by, each to be taken off.
#[component]
fn FilterChips() -> impl IntoView {
    let log = expect_context::<ReadState>().log;
    type Clear = fn(&mut Filter);
    let chips = move || {
        log.filter.with(|filter| {
            let mut chips: Vec<(String, Clear)> = Vec::new();
            if let Some(unit) = filter.unit {
                chips.push((format!("Unit {unit}"), |filter| (filter.unit, filter.port) = (None, None)));
            } else if filter.port.is_some() {
                chips.push(("One line".to_owned(), |filter| filter.port = None));
            }
            if let Some(function) = filter.function {
                chips.push((format!("Function {function}"), |filter| filter.function = None));
            }
            if let Some(direction) = filter.direction {
                let word = match direction {
                    Direction::Request => "Requests",
                    Direction::Response => "Answers",
                };
                chips.push((word.to_owned(), |filter| filter.direction = None));
            }
            if let Some(state) = filter.state {
                chips.push((state_words(state), |filter| filter.state = None));
            }
            if let Some((from, to)) = filter.times {
                chips.push((stretch(from, to), |filter| filter.times = None));
            }
            if let Some((from, to)) = filter.places {
                chips.push((format!("# {} to {}", from + 1, to + 1), |filter| filter.places = None));
            }
            chips
        })
    };
    let chip = move |(text, clear): (String, Clear)| {
        let take_off = move |_| {
            let stretch = |filter: &Filter| filter.times.is_some() || filter.places.is_some();
            let before = log.filter.with_untracked(stretch);
            log.filter_by(clear);
            if before && !log.filter.with_untracked(stretch) {
                log.ask(Request::Lanes(None));
            }
        };
        view! {
            <button type="button" class="chip" on:click=take_off>
                <Icon glyph=Glyph::Close />
                <span class="unseen">"Take off: "</span>
                {text}
            </button>
        }
    };
    move || chips().into_iter().map(chip).collect_view()
}

fn state_words(state: State) -> String {
    match state {
        State::Plain => "Requests without a word".to_owned(),
        state => state.word().to_owned(),
    }
}
