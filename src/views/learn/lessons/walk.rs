//! Telegrams with their bytes lit one after another, and what there is to say of each part.

use leptos::prelude::*;

use crate::components::button::Button;
use crate::components::byte_strip::{ByteStrip, Chosen, Lights, blocks, role_class};
use crate::components::icon::Glyph;
use crate::components::telegram::Shown;
use crate::views::learn::words::Words;
use buslens::field::{Direction, Role, Span, hex};
use buslens::tool::byte::shares;
use buslens_trainer::lesson::{Place, Step, field};

/// Something to say of a part of a telegram.
#[derive(Clone, PartialEq)]
pub struct Stop {
    /// Of which telegram.
    pub telegram: usize,
    pub span: Span,
    pub label: String,
    pub bytes: String,
    pub value: String,
    pub class: &'static str,
    pub text: String,
}

/// Everything that a step says of its telegrams, in its order.
pub fn stops(step: &Step, shown: &[Shown]) -> Vec<Stop> {
    let mut all = Vec::new();
    for (index, (telegram, shown)) in step.telegrams.iter().zip(shown).enumerate() {
        for remark in &telegram.remarks {
            let Some(span) = remark.place.span(&shown.detail, shown.bytes().len()) else { continue };
            let named = match &remark.place {
                Place::Field(name) => field(&shown.detail, name),
                _ => None,
            };
            let own = match &remark.place {
                Place::Field(name) => Some(name.as_str()),
                _ => None,
            };
            all.push(Stop {
                telegram: index,
                span,
                label: named.map_or(String::new(), |field| field.label().to_string()),
                bytes: hex(span.of(shown.bytes())),
                value: named.map_or(String::new(), |field| match field.spec.role {
                    // Whether it is right says more than the number.
                    Role::Check => field.meaning().map_or(String::new(), |it| it.to_string()),
                    _ => field.value_text(),
                }),
                class: named.map_or("role-head", |field| role_class(field.spec.role)),
                text: step.filled_at(&remark.text, &shown.report, index, own),
            });
        }
    }
    all
}

/// What is lit: one of the stops, or a byte that somebody clicked.
#[derive(Clone, Copy)]
pub struct Lit {
    /// One for each telegram.
    lights: StoredValue<Vec<Lights>>,
    stops: StoredValue<Vec<Stop>>,
}

impl Lit {
    pub fn new(count: usize, stops: Vec<Stop>) -> Self {
        let lights: Vec<Lights> = (0..count).map(|_| Lights::new()).collect();
        for (index, own) in lights.iter().enumerate() {
            let others: Vec<Lights> =
                lights.iter().enumerate().filter(|(other, _)| *other != index).map(|(_, it)| *it).collect();
            let chosen = own.chosen;
            // Only one byte in all is looked at.
            Effect::new(move |_| {
                if chosen.get().is_some() {
                    others
                        .iter()
                        .filter(|it| it.chosen.get_untracked().is_some())
                        .for_each(|it| it.chosen.set(None));
                }
            });
        }
        let lit = Self { lights: StoredValue::new(lights), stops: StoredValue::new(stops) };
        lit.go(0);
        lit
    }

    pub fn of(self, telegram: usize) -> Option<Lights> {
        self.lights.with_value(|all| all.get(telegram).copied())
    }

    /// Lights stop `at`.
    pub fn go(self, at: usize) {
        let Some(stop) = self.stops.with_value(|all| all.get(at).cloned()) else { return };
        self.lights.with_value(|all| {
            for (index, lights) in all.iter().enumerate() {
                let chosen = Chosen { span: stop.span, at: stop.span.from };
                lights.chosen.set((index == stop.telegram).then_some(chosen));
            }
        });
    }

    /// The telegram and the byte that are looked at.
    fn chosen(self) -> Option<(usize, Chosen)> {
        self.lights.with_value(|all| {
            all.iter().enumerate().find_map(|(index, lights)| Some((index, lights.chosen()?)))
        })
    }

    /// The stop that is lit, if it is one: the one that somebody came to, or what is said of the byte.
    pub fn at(self) -> Option<usize> {
        let (telegram, chosen) = self.chosen()?;
        self.stops.with_value(|all| {
            let own = || all.iter().enumerate().filter(|(_, stop)| stop.telegram == telegram);
            let exact = own().find(|(_, stop)| stop.span == chosen.span);
            let around = own()
                .filter(|(_, stop)| stop.span.contains(chosen.at))
                .min_by_key(|(_, stop)| stop.span.len());
            exact.or(around).map(|(index, _)| index)
        })
    }

    fn count(self) -> usize {
        self.stops.with_value(Vec::len)
    }
}

#[component]
pub fn Walk(step: Step, shown: Vec<Shown>) -> impl IntoView {
    let lit = Lit::new(shown.len(), stops(&step, &shown));
    let several = shown.len() > 1;
    let strips: Vec<_> = shown
        .iter()
        .enumerate()
        .filter_map(|(index, shown)| {
            let lights = lit.of(index)?;
            let blocks = blocks(&shown.detail, shown.bytes());
            let (arrow, name) = match shown.telegram.guess.direction {
                Direction::Request => ("→", "Request"),
                Direction::Response => ("←", "Response"),
            };
            let heading = several.then(|| {
                view! {
                    <p class="side-name">
                        <span aria-hidden="true">{arrow}</span>
                        <b>{name}</b>
                        <span>{shown.detail.meaning().sentence()} "."</span>
                    </p>
                }
            });
            Some(view! {
                <div class="telegram">
                    {heading}
                    <ByteStrip blocks lights />
                </div>
            })
        })
        .collect();
    view! {
        <div class="walk">
            {strips}
            <Said lit shown />
        </div>
    }
}

/// What there is to say of what is lit, and the way to the next.
#[component]
pub fn Said(lit: Lit, shown: Vec<Shown>) -> impl IntoView {
    let shown = StoredValue::new(shown);
    let at = Memo::new(move |_| lit.at());
    let last = RwSignal::new(0);
    Effect::new(move |_| {
        if let Some(at) = at.get() {
            last.set(at);
        }
    });
    let said = move || match at.get().and_then(|at| lit.stops.with_value(|all| all.get(at).cloned())) {
        Some(stop) => Some(view! { <OfStop stop /> }.into_any()),
        // A byte of which the lesson says nothing: the library does.
        None => {
            let (telegram, chosen) = lit.chosen()?;
            let shown = shown.with_value(|all| all.get(telegram).cloned())?;
            let share = shares(&shown.detail, shown.bytes(), chosen.at).into_iter().last()?;
            Some(
                view! {
                    <div class="said-of">
                        <p class="of">
                            <b>{share.place.sentence()}</b>
                        </p>
                        {share.steps.iter().map(|it| view! { <p>{it.sentence()} "."</p> }).collect_view()}
                        <p>{share.note}</p>
                    </div>
                }
                .into_any(),
            )
        }
    };
    let count = lit.count();
    let [first, end] = [0, count.saturating_sub(1)].map(|end| Signal::derive(move || at.get() == Some(end)));
    // Who looked elsewhere comes back to where it went on from.
    let turn = move |by: isize| {
        let by = if at.get_untracked().is_some() { by } else { 0 };
        lit.go(last.get_untracked().saturating_add_signed(by));
    };
    let player = (count > 1).then(|| {
        view! {
            <div class="player">
                <Button glyph=Glyph::Back label="Back" disabled=first on_press=move |()| turn(-1) />
                <Button glyph=Glyph::Forward label="Next" disabled=end on_press=move |()| turn(1) />
                <span class="note number">
                    {move || at.get().map(|at| format!("{} of {count}", at + 1))}
                </span>
            </div>
        }
    });
    (count > 0).then(|| {
        view! {
            <div class="spoken" aria-live="polite">{move || said()}</div>
            {player}
        }
    })
}

#[component]
fn OfStop(stop: Stop) -> impl IntoView {
    let Stop { label, bytes, value, class, text, .. } = stop;
    view! {
        <div class=format!("said-of {class}")>
            {(!label.is_empty())
                .then(|| {
                    view! {
                        <p class="of">
                            <b>{label}</b>
                            <code>{bytes}</code>
                            <span>{value}</span>
                        </p>
                    }
                })}
            <p>
                <Words text />
            </p>
        </div>
    }
}
