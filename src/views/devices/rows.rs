//! A list of parameters as a table: what registers and words stand for.

use leptos::prelude::*;

use super::Remove;
use super::state::DeviceSettings;
use crate::components::combobox::Combobox;
use crate::components::form::Edit;
use buslens::field::{Format, hex, hex_value, number_text};
use buslens::tool::Content;
use buslens::tool::setup::{self, List, Parameter, Row};

/// The table of a list, with a row to add one.
#[component]
pub fn Rows(list: List, title: &'static str, about: &'static str) -> impl IntoView {
    let state = expect_context::<DeviceSettings>();
    let rows = Memo::new(move |_| state.rows(list));
    let numbered = move || rows.get().into_iter().enumerate().collect::<Vec<_>>();
    let mapping = matches!(list, List::ReadMapping | List::WriteMapping);
    let full = move || rows.with(Vec::len) >= list.most();
    let row = move |(index, row): (usize, Row)| {
        view! { <TableRow list index row mapping /> }
    };
    view! {
        <div class="rows">
            <header>
                <h4>{title}</h4>
                {mapping.then(|| view! { <Start list /> })}
            </header>
            <p class="note">{about}</p>
            <table class="table" class:empty=move || rows.with(Vec::is_empty) aria-label=title>
                <thead>
                    <tr>
                        <th scope="col">{if mapping { "Register" } else { "Word" }}</th>
                        <th scope="col">"Parameter"</th>
                        <th scope="col">"Sets"</th>
                        <th scope="col">"Width"</th>
                        <th scope="col" class="raw">{if mapping { "Entry" } else { "Index" }}</th>
                        <th scope="col">
                            <span class="unseen">"Remove"</span>
                        </th>
                    </tr>
                </thead>
                <tbody>
                    <For each=numbered key=|row| *row children=row />
                    <Show when=move || !full()>
                        <NewRow list mapping />
                    </Show>
                </tbody>
            </table>
        </div>
    }
}

/// The place of a row as the manual writes it.
fn place(place: u16, mapping: bool) -> String {
    number_text(place.into(), 2, if mapping { Format::Hex } else { Format::Decimal })
}

/// A row for screen readers, which meet several lists: "input word 1".
fn spoken(list: List, place: &str) -> String {
    let kind = match list {
        List::ReadMapping => "read register",
        List::WriteMapping => "written register",
        List::ProcessOutput => "output word",
        List::ProcessInput => "input word",
    };
    format!("{kind} {place}")
}

/// The parameter of a row in a few words.
fn named(address: u16) -> String {
    match setup::parameter(address) {
        Some(parameter) => format!("{} {}", parameter.id, parameter.label),
        None => hex_value(address.into(), 2).to_string(),
    }
}

#[component]
fn TableRow(list: List, index: usize, row: Row, mapping: bool) -> impl IntoView {
    let state = expect_context::<DeviceSettings>();
    let place = place(row.place, mapping);
    let raw = match mapping {
        true => hex(&row.raw.to_be_bytes()),
        false => hex_value(row.raw.into(), 2).to_string(),
    };
    if row.second_half {
        return view! {
            <tr class="half">
                <td class="mono">{place}</td>
                <td colspan="3">"its second half"</td>
                <td class="raw mono">{raw}</td>
                <td></td>
            </tr>
        }
        .into_any();
    }
    let spoken = spoken(list, &place);
    let set = move |parameter: u16, sets: u8, words: u8| state.set_row(list, index, parameter, sets, words);
    let choose =
        Callback::new(move |parameter: Parameter| set(parameter.address, row.sets.max(1), parameter.words));
    let known = (1..=2).contains(&row.words);
    view! {
        <tr>
            <td class="mono">{place.clone()}</td>
            <td>
                <ParameterField label=format!("Parameter of {spoken}") shown=named(row.parameter) on_choose=choose />
            </td>
            <td>
                <Sets sets=row.sets place=spoken.clone() on_set=Callback::new(move |sets| set(row.parameter, sets, row.words)) />
            </td>
            <td>
                <select
                    class="select"
                    aria-label=format!("Width of {spoken}")
                    on:change=move |event| {
                        set(row.parameter, row.sets, event_target_value(&event).parse().unwrap_or(1));
                    }
                >
                    {(!known).then(|| view! { <option value=row.words.to_string() prop:selected=true>{format!("{} words", row.words)}</option> })}
                    <option value="1" prop:selected=row.words == 1>"16 bit"</option>
                    <option value="2" prop:selected=row.words == 2>"32 bit"</option>
                </select>
            </td>
            <td class="raw mono">{raw}</td>
            <td>
                <Remove what=spoken on_remove=Callback::new(move |()| state.remove_row(list, index)) />
            </td>
        </tr>
    }
    .into_any()
}

/// The row that is not there yet.
#[component]
fn NewRow(list: List, mapping: bool) -> impl IntoView {
    let state = expect_context::<DeviceSettings>();
    let next = move || {
        let rows = state.rows(list);
        let after = rows.last().map(|row| row.place.wrapping_add(1));
        place(after.unwrap_or_else(|| start(state, list)), mapping)
    };
    let choose = Callback::new(move |parameter: Parameter| {
        state.set_row(list, usize::MAX, parameter.address, 1, parameter.words);
    });
    view! {
        <tr class="new">
            <td class="mono">{next}</td>
            <td colspan="5">
                <ParameterField
                    label="Add a parameter"
                    placeholder="Add: a name, or its address such as 0034h"
                    shown=""
                    on_choose=choose
                />
            </td>
        </tr>
    }
}

/// The register that an empty list begins with.
fn start(state: DeviceSettings, list: List) -> u16 {
    match list {
        List::ReadMapping => state.settings().device.read_mapping.start,
        List::WriteMapping => state.settings().device.write_mapping.start,
        List::ProcessOutput | List::ProcessInput => 0,
    }
}

/// A parameter, found by its name or its number.
#[component]
fn ParameterField(
    #[prop(into)] label: String,
    /// What stands there as long as nobody types.
    #[prop(into)]
    shown: String,
    #[prop(into, optional)] placeholder: String,
    on_choose: Callback<Parameter>,
) -> impl IntoView {
    let typed = RwSignal::new(None::<String>);
    let found = Memo::new(move |_| match typed.get() {
        Some(typed) => setup::find(&typed),
        None => setup::parameters().collect(),
    });
    let value = Signal::derive(move || typed.get().unwrap_or_else(|| shown.clone()));
    let choose = Callback::new(move |parameter: Parameter| {
        typed.set(None);
        on_choose.run(parameter);
    });
    // What was typed and is the name of one thing only is meant; anything else stays where it is.
    let leave = Callback::new(move |()| {
        if typed.with_untracked(|typed| typed.as_ref().is_some_and(|typed| typed.trim().is_empty())) {
            typed.set(None);
        } else if typed.with_untracked(Option::is_some)
            && let [only] = found.get_untracked()[..]
        {
            choose.run(only);
        }
    });
    let lost = Signal::derive(move || typed.with(Option::is_some) && found.with(Vec::is_empty));
    view! {
        <Combobox
            label
            value
            on_input=Callback::new(move |text| typed.set(Some(text)))
            options=found
            draw=option
            on_choose=choose
            on_leave=leave
            nothing="No parameter is called so. Type a part of its name, its short name such as Sy.52, or its address such as 0034h."
            placeholder
            invalid=lost
        />
    }
}

fn option(parameter: &Parameter) -> AnyView {
    view! {
        <b>{parameter.id}</b>
        <span>{parameter.label}</span>
        <code>{hex_value(parameter.address.into(), 2).to_string()}</code>
    }
    .into_any()
}

/// The parameter sets of a row: most have one.
#[component]
fn Sets(sets: u8, place: String, on_set: Callback<u8>) -> impl IntoView {
    let one = sets.is_power_of_two();
    let text =
        (0..8).filter(|set| sets >> set & 1 == 1).map(|set| set.to_string()).collect::<Vec<_>>().join(", ");
    let options = (0..8_u8).map(|set| {
        let own = 1 << set;
        view! { <option value=own.to_string() prop:selected=sets == own>{set.to_string()}</option> }
    });
    let others = (!one).then(|| {
        let text = if text.is_empty() { "none".to_owned() } else { text };
        view! { <option value=sets.to_string() prop:selected=true>{text}</option> }
    });
    view! {
        <select
            class="select"
            aria-label=format!("Sets of {place}")
            on:change=move |event| on_set.run(event_target_value(&event).parse().unwrap_or(1))
        >
            {others}
            {options.collect_view()}
            <option value="255" prop:selected=false>"all"</option>
        </select>
    }
}

/// The register that a mapping list begins with, as it was typed.
#[component]
fn Start(list: List) -> impl IntoView {
    let state = expect_context::<DeviceSettings>();
    let path = if list == List::ReadMapping { "read_mapping.start" } else { "write_mapping.start" };
    let text = move || {
        let mut found = String::new();
        state.entries().form.visit(&mut |entry| {
            if let (true, Content::Number { text, .. }) = (entry.path == path, &entry.content) {
                found.clone_from(text);
            }
        });
        found
    };
    let misfit = Memo::new(move |_| {
        let misfits = state.entries().misfits;
        misfits.into_iter().find(|misfit| misfit.path == path).map(|misfit| misfit.message.sentence() + ".")
    });
    view! {
        <label class="from">
            <span>"starts at"</span>
            <input
                class="input mono"
                autocomplete="off"
                spellcheck="false"
                aria-label=if list == List::ReadMapping { "First read register" } else { "First written register" }
                aria-invalid=move || misfit.with(Option::is_some).to_string()
                prop:value=text
                on:input=move |event| state.edit(path, &Edit::Enter(event_target_value(&event)))
            />
            <span class="misfit" aria-live="polite">{misfit}</span>
        </label>
    }
}
