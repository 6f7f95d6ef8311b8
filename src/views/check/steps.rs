//! The way through the steps: by byte, by slider, by list.

use leptos::ev::KeyboardEvent;
use leptos::html;
use leptos::prelude::*;

use super::state::{CheckState, Work};
use crate::components::icon::{Glyph, Icon};
use crate::components::roving;
use buslens::field::{hex, hex_value};
use buslens::tool::steps::{Deed, POLYNOMIAL, Step};

/// The byte that a step belongs to; none before the first.
fn byte_of(step: Option<Step>) -> Option<usize> {
    step.filter(|step| step.deed != Deed::Start).map(|step| step.byte)
}

/// The bytes, with what the register holds behind each.
#[component]
pub fn Bytes() -> impl IntoView {
    let state = expect_context::<CheckState>();
    let work = state.work();
    let strip = NodeRef::<html::Ol>::new();
    let here = Memo::new(move |_| byte_of(state.step()));
    let bytes = move || work.with(|work| work.data().iter().copied().enumerate().collect::<Vec<_>>());
    let behind = move |at: usize| {
        work.with(|work| hex_value(work.behind(at).into(), work.algorithm.width).to_string())
    };
    let keys = move |event: KeyboardEvent| {
        if let Some(at) = strip.get_untracked().and_then(|strip| roving::follow(&event, &strip, "button")) {
            state.go(work.with_untracked(|work| work.done_with(at)));
        }
    };
    let byte = move |(at, byte): (usize, u8)| {
        let class = move || match here.get() {
            Some(here) if here == at => "role-data chosen",
            Some(here) if at < here => "role-data",
            _ => "role-head",
        };
        let caption = move || match here.get() {
            Some(here) if here > at => behind(at),
            Some(here) if here == at && state.at() < work.with(|work| work.done_with(at)) => {
                "in work".to_owned()
            }
            Some(here) if here == at => behind(at),
            _ => String::new(),
        };
        view! {
            <li class=class>
                <span class="label" aria-hidden="true">{format!("byte {at}")}</span>
                <span class="cells">
                    <button
                        type="button"
                        tabindex=move || if here.get().unwrap_or_default() == at { "0" } else { "-1" }
                        aria-pressed=move || (here.get() == Some(at)).to_string()
                        aria-label=move || format!("{byte:02X}, byte {at}, register behind it {}", behind(at))
                        on:click=move |_| state.go(work.with_untracked(|work| work.done_with(at)))
                    >
                        {format!("{byte:02X}")}
                    </button>
                </span>
                <span class="caption mono" aria-hidden="true">{caption}</span>
            </li>
        }
    };
    let check = move || {
        work.with(|work| {
            let found = work.found()?;
            let class = if *found == *work.wire() { "role-check" } else { "role-check faulty" };
            Some(view! {
                <li class=class>
                    <span class="label">{super::short(work.algorithm)}</span>
                    <span class="cells whole">{hex(found)}</span>
                    <span class="caption"></span>
                </li>
            })
        })
    };
    view! {
        <ol
            node_ref=strip
            class="byte-strip"
            aria-label="Bytes, with the register behind each. Arrow keys go from byte to byte."
            on:keydown=keys
        >
            <For each=bytes key=|byte| *byte children=byte />
            {move || check()}
        </ol>
    }
}

/// Back, play, forward, and a slider over all steps.
#[component]
pub fn Player() -> impl IntoView {
    let state = expect_context::<CheckState>();
    let work = state.work();
    let last = Memo::new(move |_| work.with(Work::last));
    let at_start = move || state.at() == 0;
    let at_end = move || state.at() >= last.get();
    let glyph = move || {
        let glyph = if state.playing.get() { Glyph::Pause } else { Glyph::Play };
        view! { <Icon glyph /> }
    };
    view! {
        <div class="player">
            <button
                type="button"
                class="button icon-only"
                aria-label="Step back"
                disabled=at_start
                on:click=move |_| state.back()
            >
                <Icon glyph=Glyph::Back />
            </button>
            <button
                type="button"
                class="button main icon-only"
                aria-label=move || if state.playing.get() { "Pause" } else { "Play" }
                on:click=move |_| state.play()
            >
                {glyph}
            </button>
            <button
                type="button"
                class="button icon-only"
                aria-label="Step forward"
                disabled=at_end
                on:click=move |_| state.forward()
            >
                <Icon glyph=Glyph::Forward />
            </button>
            <input
                type="range"
                min="0"
                aria-label="Step"
                aria-valuetext=move || {
                    let said = work.with(|work| state.step().map(|step| said(work, step)));
                    said.unwrap_or_default()
                }
                max=move || last.get().to_string()
                prop:value=move || {
                    // A slider takes no value above its end: that comes first.
                    last.track();
                    state.at().to_string()
                }
                on:input=move |event| state.go(event_target_value(&event).parse().unwrap_or(0))
            />
            <button type="button" class="button" disabled=at_end on:click=move |_| state.next_byte()>
                "Next byte"
            </button>
            <button
                type="button"
                class="button"
                disabled=at_end
                on:click=move |_| state.go(usize::MAX)
            >
                "End"
            </button>
        </div>
    }
}

/// What is done in a step, in a sentence.
pub fn said(work: &Work, Step { deed, byte, before, after }: Step) -> String {
    let width = work.algorithm.width;
    let shown = |value: u16| hex_value(value.into(), width);
    let value = hex_value(work.bytes.get(byte).copied().unwrap_or_default().into(), 1);
    match deed {
        Deed::Start => format!("The register starts with {}.", shown(after)),
        Deed::Mix => format!("XOR byte {byte}, {value}, into the low half of the register."),
        Deed::Shift { out: true, .. } => {
            format!("Shift right. A 1 drops out, so XOR with {}.", shown(POLYNOMIAL))
        }
        Deed::Shift { out: false, .. } => "Shift right. A 0 drops out: nothing else to do.".to_owned(),
        Deed::Add if after < before => format!("Add byte {byte}, {value}. What is above FFh is dropped."),
        Deed::Add => format!("Add byte {byte}, {value}."),
        Deed::Complement => format!("Take the two’s complement: 100h minus {}.", shown(before)),
    }
}

/// Where a step is: "Step 12 of 54 · byte 1 (03h), bit 2 of 8".
pub fn place(work: &Work, at: usize, step: Step) -> String {
    let value = || hex_value(work.bytes.get(step.byte).copied().unwrap_or_default().into(), 1);
    let within = match step.deed {
        Deed::Start | Deed::Complement => String::new(),
        Deed::Shift { bit, .. } => format!(" · byte {} ({}), bit {bit} of 8", step.byte, value()),
        Deed::Mix | Deed::Add => format!(" · byte {} ({})", step.byte, value()),
    };
    format!("Step {at} of {}{within}", work.last())
}

/// A step in a few words, for the list.
fn brief(work: &Work, step: Step) -> String {
    match step.deed {
        Deed::Start => "start".to_owned(),
        Deed::Mix => format!("XOR with byte {}", step.byte),
        Deed::Shift { out: true, .. } => format!("shift, drop 1, XOR {}", hex_value(POLYNOMIAL.into(), 2)),
        Deed::Shift { out: false, .. } => "shift, drop 0".to_owned(),
        Deed::Add => format!(
            "add byte {}, {}",
            step.byte,
            hex_value(work.bytes.get(step.byte).copied().unwrap_or_default().into(), 1)
        ),
        Deed::Complement => "two’s complement".to_owned(),
    }
}

/// The steps of the byte at hand; of a sum, all steps.
#[component]
pub fn StepList() -> impl IntoView {
    let state = expect_context::<CheckState>();
    let work = state.work();
    let list = NodeRef::<html::Tbody>::new();
    let byte = Memo::new(move |_| byte_of(state.step()).unwrap_or_default());
    let steps = Memo::new(move |_| {
        work.with(|work| {
            let whole = work.algorithm.width == 1;
            let own =
                |(_, step): &(usize, &Step)| whole || step.byte == byte.get() && step.deed != Deed::Start;
            work.steps.iter().enumerate().filter(own).map(|(at, step)| (at, *step)).collect::<Vec<_>>()
        })
    });
    let title = move || match work.with(|work| work.algorithm.width) {
        1 => "The sum, byte by byte".to_owned(),
        _ => format!("Byte {}, bit by bit", byte.get()),
    };
    let keys = move |event: KeyboardEvent| {
        if let Some(to) = list.get_untracked().and_then(|list| roving::follow(&event, &list, "button"))
            && let Some((at, _)) = steps.with_untracked(|steps| steps.get(to).copied())
        {
            state.go(at);
        }
    };
    let first = move || steps.with(|steps| steps.first().map_or(0, |(at, _)| *at));
    let row = move |(at, step): (usize, Step)| {
        let (brief, after) = work
            .with_untracked(|work| (brief(work, step), hex_value(step.after.into(), work.algorithm.width)));
        let here = move || state.at() == at;
        let within = move || steps.with(|steps| steps.iter().any(|(other, _)| *other == state.at()));
        view! {
            <tr class:chosen=move || here()>
                <td class="soft number">{at}</td>
                <th scope="row">
                    <button
                        type="button"
                        tabindex=move || if here() || !within() && first() == at { "0" } else { "-1" }
                        aria-current=move || here().then_some("step")
                        on:click=move |_| state.go(at)
                    >
                        {brief}
                    </button>
                </th>
                <td class="mono">{after.to_string()}</td>
            </tr>
        }
    };
    let kind = move || work.with(|work| (work.algorithm.kind, work.bytes.clone()));
    view! {
        <div class="part">
            <h3>{move || title()}</h3>
            <div class="scroll">
                <table class="table" aria-label=title on:keydown=keys>
                    <tbody node_ref=list>
                        // What a step says depends on the bytes, too.
                        <For
                            each=move || {
                                let of = kind();
                                steps.get().into_iter().map(|step| (step, of.clone())).collect::<Vec<_>>()
                            }
                            key=|((at, step), of)| (*at, step.before, step.after, of.clone())
                            children=move |(step, _)| row(step)
                        />
                    </tbody>
                </table>
            </div>
        </div>
    }
}
