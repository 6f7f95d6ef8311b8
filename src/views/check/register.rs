//! The register before and after a step, bit by bit, and why.

use leptos::prelude::*;

use super::state::{CheckState, Ending, Work};
use super::steps::{place, said};
use buslens::field::{hex, hex_value};
use buslens::tool::steps::{Algorithm, Deed, POLYNOMIAL, Step};

/// A row of bits.
#[derive(Clone, PartialEq)]
struct Bits {
    name: String,
    value: u16,
    /// The bit that fell out at the right.
    out: Option<bool>,
    class: &'static str,
}

impl Bits {
    fn new(name: impl Into<String>, value: u16, class: &'static str) -> Self {
        Self { name: name.into(), value, out: None, class }
    }
}

/// What the step does, and the registers that show it.
#[component]
pub fn Registers() -> impl IntoView {
    let state = expect_context::<CheckState>();
    let work = state.work();
    let shown = move || Some((state.at(), state.step()?));
    let place = move || shown().map(|(at, step)| work.with(|work| place(work, at, step)));
    let said = move || shown().map(|(_, step)| work.with(|work| said(work, step)));
    let rows = Memo::new(move |_| shown().map_or(Vec::new(), |(_, step)| work.with(|work| rows(work, step))));
    let width = Memo::new(move |_| work.with(|work| work.algorithm.width));
    view! {
        <div class="step">
            <p class="note number">{place}</p>
            // Nobody can listen as quickly as it plays.
            <h3 aria-live=move || if state.playing.get() { "off" } else { "polite" }>{said}</h3>
        </div>
        <table class="registers" aria-label="Registers, bit by bit">
            <tbody>{move || rows.get().into_iter().map(|row| bits(row, width.get())).collect_view()}</tbody>
        </table>
    }
}

fn rows(work: &Work, Step { deed, byte, before, after }: Step) -> Vec<Bits> {
    let value = work.bytes.get(byte).copied().unwrap_or_default().into();
    let now = Bits::new("Register", before, "");
    let new = Bits::new("New register", after, "after");
    match deed {
        Deed::Start => vec![Bits::new("Register", after, "after")],
        Deed::Mix => vec![now, Bits::new(format!("XOR byte {byte}"), value, "operand"), new],
        Deed::Shift { out, .. } => {
            let shifted = Bits { out: Some(out), ..Bits::new("Shifted right", before >> 1, "") };
            let taken = Bits::new(format!("XOR {}", hex_value(POLYNOMIAL.into(), 2)), POLYNOMIAL, "operand");
            [Some(now), Some(shifted), out.then_some(taken), Some(new)].into_iter().flatten().collect()
        }
        Deed::Add => vec![
            Bits::new("Sum", before, ""),
            Bits::new(format!("Add byte {byte}"), value, "operand"),
            Bits::new("New sum", after, "after"),
        ],
        Deed::Complement => {
            vec![Bits::new("Sum", before, ""), Bits::new("100h minus the sum", after, "after")]
        }
    }
}

fn bits(Bits { name, value, out, class }: Bits, width: usize) -> impl IntoView {
    let cells = (0..8 * width).rev().map(|bit| {
        let one = value >> bit & 1 == 1;
        view! {
            <i class:one=one class:gap=bit == 7 && width == 2>
                {u8::from(one)}
            </i>
        }
    });
    let out = out.map(|out| {
        view! {
            <span class="out" class:one=out>
                <i>{u8::from(out)}</i>
                " drops out"
            </span>
        }
    });
    view! {
        <tr class=class>
            <th scope="row">{name}</th>
            // Read aloud as one number.
            <td>
                <span class="cells" aria-hidden="true">{cells.collect_view()}</span>
                {out}
            </td>
            <td class="mono">{hex_value(value.into(), width).to_string()}</td>
        </tr>
    }
}

/// Why the step is done.
#[component]
pub fn Why() -> impl IntoView {
    let state = expect_context::<CheckState>();
    let work = state.work();
    let why = move || {
        let step = state.step()?;
        let at_end = state.at() == work.with(Work::last);
        let (question, answer) = work.with(|work| why(work, step, at_end));
        Some(view! {
            <p class="why">
                <b>{question}</b>
                " "
                {answer}
            </p>
        })
    };
    view! { {move || why()} }
}

/// What such a check is worth, whatever step is shown.
#[component]
pub fn Worth() -> impl IntoView {
    let state = expect_context::<CheckState>();
    let work = state.work();
    let facts = Memo::new(move |_| work.with(|work| facts(work.algorithm)));
    // Over a whole frame the register ends at 0: that is best seen.
    let shows =
        move || work.with(|work| work.algorithm.width == 2 && work.found() == Some(work.wire().as_slice()));
    let show = move |_| {
        state.choose_ending(Ending::Data);
        state.go(usize::MAX);
    };
    view! {
        <section class="worth" aria-labelledby="check-worth">
            <h3 id="check-worth">{move || facts.get().title}</h3>
            <dl>
                {move || {
                    let part = |(question, answer): (&'static str, &'static str)| {
                        view! {
                            <div>
                                <dt>{question}</dt>
                                <dd>{answer}</dd>
                            </div>
                        }
                    };
                    facts.get().parts.into_iter().map(part).collect_view()
                }}
            </dl>
            <Show when=shows>
                <button type="button" class="button" on:click=show>
                    "Show it: go on over the CRC"
                </button>
            </Show>
        </section>
    }
}

/// What there is to know of a check.
#[derive(Clone, Copy, PartialEq)]
struct Worthy {
    title: &'static str,
    parts: [(&'static str, &'static str); 3],
}

fn facts(algorithm: &Algorithm) -> Worthy {
    match (algorithm.width, algorithm.kind) {
        (2, _) => Worthy {
            title: "What the CRC is good for",
            parts: [
                (
                    "What it notices",
                    "Every single wrong bit, every two of them, every odd number of them, and every run of up \
                     to 16 bits.",
                ),
                ("What it misses", "Of any other damage 1 in 65,536."),
                (
                    "How a receiver uses it",
                    "It goes on over the two bytes of the CRC: a frame whose CRC is valid ends at 0000h.",
                ),
            ],
        },
        (_, "lrc") => Worthy {
            title: "What the LRC is good for",
            parts: [
                ("What it notices", "Every single wrong bit, and most other damage."),
                (
                    "What it misses",
                    "Bytes that changed places, changes that make up for each other, and of any other damage 1 in \
                     256.",
                ),
                (
                    "How a receiver uses it",
                    "It adds up all bytes and the LRC: 00h remains where all of it is right.",
                ),
            ],
        },
        _ => Worthy {
            title: "What the FCS is good for",
            parts: [
                ("What it notices", "Every single wrong bit, and most other damage."),
                (
                    "What it misses",
                    "Bytes that changed places, changes that make up for each other, and of any other damage 1 in \
                     256. Each character on the line has a parity bit besides.",
                ),
                (
                    "How a receiver uses it",
                    "It adds up the bytes from the destination address to the last one of the data, and compares.",
                ),
            ],
        },
    }
}

fn why(work: &Work, step: Step, at_end: bool) -> (&'static str, String) {
    let crc = work.algorithm.width == 2;
    let check = hex_value(work.value(), work.algorithm.width);
    match step.deed {
        _ if at_end && crc => (
            "This is the CRC.",
            format!(
                "{check} goes out with its low byte first: {}. A receiver that goes on over these two bytes \
                 ends at 0000h, and so knows that all of it is right.",
                hex(&work.wire())
            ),
        ),
        Deed::Start if crc => (
            "Why FFFFh?",
            "From 0000h, bytes of 00h at the beginning would leave no trace in the CRC.".to_owned(),
        ),
        Deed::Start => ("Why 00h?", "A sum starts with nothing.".to_owned()),
        Deed::Mix => (
            "Why XOR?",
            "Bits are added without carrying over. The byte goes into the low half, because Modbus sends \
             the lowest bit first."
                .to_owned(),
        ),
        Deed::Shift { out: true, .. } => (
            "Why A001h?",
            "It is the polynomial x¹⁶ + x¹⁵ + x² + 1 written backwards, because Modbus sends the lowest bit \
             first. A 1 that drops out means that the polynomial fits once more into the bits read so far, so \
             it is taken off."
                .to_owned(),
        ),
        Deed::Shift { out: false, .. } => (
            "Why nothing else?",
            "A 0 that drops out means that the polynomial does not fit into the bits read so far.".to_owned(),
        ),
        Deed::Complement => (
            "Why the complement?",
            format!("All bytes and the LRC then add up to 00h. {check} is the LRC."),
        ),
        Deed::Add if at_end => ("This is the FCS.", format!("{check} is the sum of all bytes, without what is above FFh.")),
        Deed::Add => ("Why drop what is above FFh?", "The check has one byte, and so the sum has one.".to_owned()),
    }
}
