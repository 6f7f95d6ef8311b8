//! Bits that can be switched.

use leptos::ev::KeyboardEvent;
use leptos::html;
use leptos::prelude::*;

use crate::components::roving;
use buslens::field::{Format, decimal, hex_value, number_text};
use buslens_trainer::lesson::Reading;

/// A few bits that mean something together.
#[derive(Clone, Copy)]
struct Part {
    label: &'static str,
    class: &'static str,
    /// The highest bit, and one below the lowest.
    from: u32,
    to: u32,
}

/// The parts of a float.
const FLOAT: [Part; 3] = [
    Part { label: "sign", class: "role-head", from: 32, to: 31 },
    Part { label: "exponent", class: "role-status", from: 31, to: 23 },
    Part { label: "fraction", class: "role-data", from: 23, to: 0 },
];

/// The number that some bytes are, the first one the highest.
pub fn number(bytes: &[u8]) -> u32 {
    bytes.iter().take(4).fold(0, |number, byte| number << 8 | u32::from(*byte))
}

/// Switches for the bits of a number of so many bytes.
#[component]
pub fn Switches(
    #[prop(into)] value: Signal<u32>,
    on_set: Callback<u32>,
    width: usize,
    reading: Reading,
    wanted: u32,
) -> impl IntoView {
    let root = NodeRef::<html::Div>::new();
    let bits = 8 * width as u32;
    let float = reading == Reading::Float;
    let parts: Vec<Part> = match float {
        true => FLOAT.to_vec(),
        // Half a byte is a digit.
        false => (0..2 * width as u32)
            .rev()
            .map(|half| Part { label: "", class: "role-data", from: 4 * half + 4, to: 4 * half })
            .collect(),
    };
    let keys = move |event: KeyboardEvent| {
        if let Some(root) = root.get_untracked() {
            roving::follow(&event, &root, "button");
        }
    };
    let switch = move |bit: u32| {
        let on = move || value.get() >> bit & 1 == 1;
        let name = if float { format!("bit {bit}") } else { format!("worth {}", 1_u64 << bit) };
        view! {
            <button
                type="button"
                role="switch"
                tabindex=if bit + 1 == bits { "0" } else { "-1" }
                aria-checked=move || on().to_string()
                aria-label=name
                class:one=on
                on:click=move |_| on_set.run(value.get_untracked() ^ 1 << bit)
            >
                {move || u8::from(on())}
                {(!float).then(|| view! { <small aria-hidden="true">{1_u64 << bit}</small> })}
            </button>
        }
    };
    let part = move |Part { label, class, from, to }: Part| {
        let below = move || {
            let bits = value.get() >> to & (u32::MAX >> (32 - (from - to)));
            match label {
                "sign" => if bits == 0 { "+" } else { "−" }.to_owned(),
                "exponent" => format!("{bits}: times 2 to the power of {}", bits as i32 - 127),
                "fraction" => decimal(1.0 + f64::from(bits) / f64::from(1_u32 << 23), 6),
                // What hex is, is not known yet.
                _ if reading == Reading::Sum => String::new(),
                _ => format!("{bits:X}"),
            }
        };
        view! {
            <li class=class>
                {(!label.is_empty()).then(|| view! { <b>{label}</b> })}
                <span class="cells">{(to..from).rev().map(switch).collect_view()}</span>
                <span class="below">{below}</span>
            </li>
        }
    };
    let shown = move |value: u32| match reading {
        Reading::Float => number_text(value.into(), 4, Format::Float),
        Reading::Hex => format!("{} = {value}", hex_value(value.into(), width)),
        Reading::Sum => {
            let on = (0..bits).rev().map(|bit| 1_u32 << bit).filter(|worth| value & worth != 0);
            let worth: Vec<String> = on.map(|worth| worth.to_string()).collect();
            if worth.len() < 2 { value.to_string() } else { format!("{} = {value}", worth.join(" + ")) }
        }
    };
    view! {
        <div class="switches" class:float=float node_ref=root on:keydown=keys>
            <ol aria-label="Switches. Arrow keys go from one to the next.">{parts.into_iter().map(part).collect_view()}</ol>
            <dl>
                <div>
                    <dt>"Now"</dt>
                    <dd>{move || shown(value.get())}</dd>
                </div>
                {float
                    .then(|| {
                        view! {
                            <div>
                                <dt>"Wanted"</dt>
                                <dd>{shown(wanted)}</dd>
                            </div>
                        }
                    })}
            </dl>
        </div>
    }
}
