//! What is needed now and then: units and functions as a table, a register over time, unread lines,
//! and how lines are to be read.

use leptos::ev::SubmitEvent;
use leptos::html;
use leptos::prelude::*;

use crate::components::dialog::Dialog;
use crate::components::icon::Glyph;
use crate::components::menu::{Menu, MenuItem};
use crate::components::toast::Toasts;
use crate::components::wide_table::WideTable;
use crate::views::read::ReadState;
use crate::views::read::editor::byte_offset;
use crate::views::read::reading::{Choose, ReadingChoices};
use crate::views::read::times::{clock, duration};
use crate::worker::messages::{Part, Request, Value, Which};
use buslens::field::{Span, count, decimal, shortest};
use buslens::tool::log::{Held, Unit};

#[component]
pub fn Tools() -> impl IntoView {
    let log = expect_context::<ReadState>().log;
    let [units, series, unread, reading] = [(); 4].map(|()| RwSignal::new(false));
    let open = move |dialog: RwSignal<bool>, ask: Option<Request>| {
        Callback::new(move |()| {
            dialog.set(true);
            if let Some(request) = ask.clone() {
                log.ask(request);
            }
        })
    };
    let lines = move || log.overview.with(|it| it.as_ref().map_or(0, |it| it.unread));
    view! {
        <Menu label="More" glyph=Glyph::Devices at_end=true>
            <MenuItem on_choose=open(units, None)>"Units and functions"</MenuItem>
            <MenuItem on_choose=open(series, None)>"A register over time"</MenuItem>
            <MenuItem on_choose=open(unread, Some(Request::Unread))>
                {move || format!("Unread lines ({})", lines())}
            </MenuItem>
            <MenuItem on_choose=open(reading, Some(Request::Sample))>"How it is read"</MenuItem>
        </Menu>
        <Dialog open=units title="Units and functions">
            <Units />
        </Dialog>
        <Dialog open=series title="A register over time">
            <Series open=series />
        </Dialog>
        <Dialog open=unread title="Unread lines">
            <UnreadLines />
        </Dialog>
        <Dialog open=reading title="How the log is read">
            <Reading />
        </Dialog>
    }
}

#[component]
fn Units() -> impl IntoView {
    let log = expect_context::<ReadState>().log;
    let units = move || log.overview.with(|it| it.as_ref().map_or(Vec::new(), |it| it.units.clone()));
    let port_name = move |port: u16| {
        log.overview.with(|it| {
            let ports = &it.as_ref()?.ports;
            ports.iter().find(|(other, _)| *other == port).map(|(_, name)| name.clone())
        })
    };
    let row = move |unit: Unit| {
        let functions: Vec<_> = unit.functions.iter().map(ToString::to_string).collect();
        let numbers =
            [unit.requests, unit.answered, unit.unanswered, unit.retries, unit.refused, unit.damaged];
        let numbers = numbers.map(|n| view! { <td class="number" class:soft=n == 0>{n}</td> });
        let time = |time: Option<u32>| time.map_or("–".to_owned(), |time| duration(time.into()));
        view! {
            <tr>
                <th scope="row">{unit.unit.map_or("–".to_owned(), |unit| unit.to_string())}</th>
                <td>{port_name(unit.port)}</td>
                <td>{functions.join(", ")}</td>
                {numbers.into_iter().collect_view()}
                <td class="number">{time(unit.median)}</td>
                <td class="number">{time(unit.worst)}</td>
            </tr>
        }
    };
    let heads = [
        "Unit",
        "Line",
        "Functions",
        "Requests",
        "Answered",
        "Unanswered",
        "Retries",
        "Rejected",
        "Damaged",
        "Usually",
        "At worst",
    ];
    let heads = heads.map(|head| view! { <th scope="col">{head}</th> });
    view! {
        <WideTable label="Units and functions">
            <thead>
                <tr>{heads.into_iter().collect_view()}</tr>
            </thead>
            <tbody>{move || units().into_iter().map(row).collect_view()}</tbody>
        </WideTable>
    }
}

/// The values of a register as a line.
#[component]
fn Series(open: RwSignal<bool>) -> impl IntoView {
    let log = expect_context::<ReadState>().log;
    let toasts = expect_context::<Toasts>();
    let (unit, register) = (RwSignal::new(String::new()), RwSignal::new(String::new()));
    let number = |text: &str| match text.trim().strip_prefix("0x") {
        Some(hex) => u16::from_str_radix(hex, 16).ok(),
        None => text.trim().parse::<u16>().ok(),
    };
    let draw = move |event: SubmitEvent| {
        event.prevent_default();
        let unit = number(&unit.get_untracked()).and_then(|unit| u8::try_from(unit).ok());
        match number(&register.get_untracked()) {
            Some(address) => log.ask(Request::Series { unit, address }),
            None => toasts.say("Which register? Expected its address, such as 200 or 0xC8."),
        }
    };
    let first = log.overview.with_untracked(|it| it.as_ref().and_then(|it| it.units.first()?.unit));
    unit.set(first.map_or(String::new(), |unit| unit.to_string()));
    log.ask(Request::Held);
    let option = |(index, held): (usize, Held)| {
        let unit = held.unit.map_or(String::new(), |unit| format!("Unit {unit}, "));
        let label = match held.name.is_empty() {
            true => format!("{unit}register {}", held.address),
            false => format!("{unit}{} ({})", held.name, held.address),
        };
        view! { <option value=index.to_string()>{label}</option> }
    };
    let choose = move |event| {
        let index: Option<usize> = event_target_value(&event).parse().ok();
        let Some(held) = log.held.with_untracked(|held| held.get(index?).cloned()) else { return };
        unit.set(held.unit.map_or(String::new(), |unit| unit.to_string()));
        register.set(held.address.to_string());
        log.ask(Request::Series { unit: held.unit, address: held.address });
    };
    view! {
        <form class="asked" on:submit=draw>
            <Show when=move || log.held.with(|held| !held.is_empty())>
                <label>
                    <span>"In this log"</span>
                    <select class="select" on:change=choose>
                        <option value="">"choose …"</option>
                        {move || log.held.get().into_iter().enumerate().map(option).collect_view()}
                    </select>
                </label>
            </Show>
            <label>
                <span>"Unit"</span>
                <input
                    class="input"
                    inputmode="numeric"
                    size="4"
                    prop:value=unit
                    on:input=move |event| unit.set(event_target_value(&event))
                />
            </label>
            <label>
                <span>"Register"</span>
                <input
                    class="input"
                    size="8"
                    placeholder="200 or 0xC8"
                    prop:value=register
                    on:input=move |event| register.set(event_target_value(&event))
                />
            </label>
            <button type="submit" class="button main">
                "Draw"
            </button>
        </form>
        {move || log.series.get().map(|values| view! { <Curve values open /> })}
    }
}

#[component]
fn Curve(values: Vec<Value>, open: RwSignal<bool>) -> impl IntoView {
    const WIDTH: f64 = 720.0;
    const HEIGHT: f64 = 180.0;
    const EDGE: f64 = 8.0;
    let log = expect_context::<ReadState>().log;
    let (Some(first), Some(last)) = (values.first().cloned(), values.last().cloned()) else {
        return view! { <p class="note">"No telegram of this log reads or writes that register of that unit."</p> }
            .into_any();
    };
    let timed = values.iter().all(|value| value.time.is_some());
    let at = move |value: &Value| {
        if timed { value.time.unwrap_or_default() as f64 } else { value.index as f64 }
    };
    let range = |numbers: &mut dyn Iterator<Item = f64>| {
        numbers.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), n| (low.min(n), high.max(n)))
    };
    let (left, right) = range(&mut values.iter().map(at));
    let (low, high) = range(&mut values.iter().map(|value| value.value));
    let part = |n: f64, low: f64, high: f64| if high > low { (n - low) / (high - low) } else { 0.5 };
    let x = |value: &Value| part(at(value), left, right) * (WIDTH - 2.0 * EDGE) + EDGE;
    let y = |value: &Value| (1.0 - part(value.value, low, high)) * (HEIGHT - 2.0 * EDGE) + EDGE;
    let line: Vec<String> =
        values.iter().map(|value| decimal(x(value), 1) + "," + &decimal(y(value), 1)).collect();
    let place = |value: &Value| value.time.map_or_else(|| format!("telegram {}", value.index + 1), clock);
    let points: Vec<_> = values
        .iter()
        .map(|value| {
            let words = format!("{}: {}", place(value), shortest(value.value));
            view! {
                <circle cx=decimal(x(value), 1) cy=decimal(y(value), 1) r="3">
                    <title>{words}</title>
                </circle>
            }
        })
        .collect();
    // Each value leads to its telegram; a list does so by keyboard, too.
    let rows: Vec<_> = values
        .iter()
        .take(200)
        .map(|value| {
            let index = value.index;
            let show = move |_| {
                open.set(false);
                log.ask(Request::Show(Which::Index(index)));
            };
            view! {
                <li>
                    <button type="button" class="link" on:click=show>
                        {place(value)}
                    </button>
                    " "
                    {shortest(value.value)}
                </li>
            }
        })
        .collect();
    view! {
        <p>{format!("{}, {low} to {high}", count(values.len(), "value"))}</p>
        <svg class="curve" viewBox=format!("0 0 {WIDTH} {HEIGHT}") role="img" aria-label=format!("{low} to {high} over time")>
            <polyline points=line.join(" ") />
            {points}
        </svg>
        <p class="ends number">
            <span>{place(&first)}</span>
            <span>{place(&last)}</span>
        </p>
        <ol class="values number">{rows}</ol>
    }
    .into_any()
}

#[component]
fn UnreadLines() -> impl IntoView {
    let log = expect_context::<ReadState>().log;
    move || {
        let unread = log.unread.get()?;
        if unread.lines.is_empty() {
            return Some(
                view! { <p class="note">"No line is left over: all of them were read."</p> }.into_any(),
            );
        }
        let more =
            (unread.more > 0).then(|| view! { <p class="note">{format!("and {} more", unread.more)}</p> });
        let line = |(number, text): (u32, String)| {
            view! {
                <li value=number.to_string()>
                    <code>{text}</code>
                </li>
            }
        };
        let lines = unread.lines.into_iter().map(line).collect_view();
        Some(view! { <ol class="unread">{lines}</ol> {more} }.into_any())
    }
}

/// How the file is to be read, and what is what in one of its lines.
#[component]
fn Reading() -> impl IntoView {
    let read = expect_context::<ReadState>();
    let log = read.log;
    let toasts = expect_context::<Toasts>();
    let field = NodeRef::<html::Input>::new();
    let inputs = vec![("text", "Text"), ("binary", "Raw bytes of a line"), ("pcap", "Capture of a network")];
    let numbers = vec![("hex", "Hex"), ("decimal", "Decimal")];
    let decimal = move || match read.choices().decimal {
        None => "",
        Some(true) => "decimal",
        Some(false) => "hex",
    };
    let mark = move |part: Part| {
        let Some(field) = field.get_untracked() else { return };
        let (from, to) = (field.selection_start().ok().flatten(), field.selection_end().ok().flatten());
        let (Some(from), Some(to)) = (from, to) else { return };
        if from >= to {
            toasts.say("Select the part in the line first, with the mouse or with Shift and the arrow keys.");
            return;
        }
        let text = field.value();
        let span = Span::new(byte_offset(&text, from as usize), byte_offset(&text, to as usize));
        read.mark(text, part, span);
        toasts.say("All lines are read like that now.");
    };
    let parts = [
        (Part::Bytes, "These are the bytes"),
        (Part::Time, "This is the time"),
        (Part::Request, "This marks a request"),
        (Part::Response, "This marks a response"),
    ];
    let buttons = parts.map(|(part, label)| {
        view! {
            <button type="button" class="button low" on:click=move |_| mark(part)>
                {label}
            </button>
        }
    });
    view! {
        <div class="asked">
            <ReadingChoices />
            <Choose
                label="File"
                otherwise="Detect automatically"
                options=inputs
                value=Signal::derive(move || read.choices().input)
                on_choose=Callback::new(move |key| read.read_as(|choices| choices.input = key))
            />
            <Choose
                label="Numbers"
                otherwise="Detect automatically"
                options=numbers
                value=Signal::derive(move || decimal().to_owned())
                on_choose=Callback::new(move |key: String| {
                    read.read_as(|choices| choices.decimal = (!key.is_empty()).then(|| key == "decimal"));
                })
            />
        </div>
        <h3>"Lines read incorrectly?"</h3>
        <p class="note">"Select a part of this line, and say what it is. All lines are then read like that."</p>
        <input
            node_ref=field
            class="input mono"
            readonly=true
            aria-label="A line of the log"
            prop:value=move || log.sample.get()
        />
        <div class="acts">
            {buttons.into_iter().collect_view()}
            <Show when=move || read.choices().marks.is_some()>
                <button
                    type="button"
                    class="button plain low"
                    on:click=move |_| read.read_as(|choices| choices.marks = None)
                >
                    "Forget the marks"
                </button>
            </Show>
        </div>
    }
}
