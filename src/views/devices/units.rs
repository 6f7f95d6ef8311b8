//! Which unit is which device: those that a person named, and those that Read shows.

use std::collections::BTreeMap;

use leptos::html;
use leptos::prelude::*;

use super::Remove;
use super::state::DeviceSettings;
use crate::views::read::{Mode, ReadState};
use crate::worker::messages::Proposed;
use buslens::field::{in_order, many};
use buslens::tool::{PROFILES, Profile, proposals};

/// A unit, and what is known of it.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Row {
    unit: u8,
    /// The key of the device that a person named.
    named: Option<&'static str>,
    /// Its telegrams read well as this device, and why.
    proposed: Option<(&'static str, String)>,
    /// Read shows telegrams of it.
    seen: bool,
}

#[component]
pub fn Units() -> impl IntoView {
    let state = expect_context::<DeviceSettings>();
    let read = expect_context::<ReadState>();
    let proposed = Memo::new(move |_| {
        let found = match read.mode() {
            Mode::Log => read.log.proposals.get(),
            _ => proposals(&read.report()).iter().map(Proposed::of).collect(),
        };
        let found =
            found.into_iter().filter_map(|it| Some((it.unit?, (Profile::of(&it.device)?.key, it.text))));
        found.collect::<BTreeMap<_, _>>()
    });
    let rows = Memo::new(move |_| {
        let named = state.settings().units;
        let seen = seen(read);
        let units = named.iter().map(|it| it.unit).chain(seen.iter().copied());
        let mut units = in_order(units, |unit| *unit);
        units.dedup();
        let row = |unit: u8| Row {
            unit,
            named: named.iter().find(|it| it.unit == unit).and_then(|it| it.device).map(|it| it.key),
            proposed: proposed.with(|proposed| proposed.get(&unit).cloned()),
            seen: seen.contains(&unit),
        };
        units.into_iter().map(row).collect::<Vec<_>>()
    });
    let units = Memo::new(move |_| rows.with(|rows| rows.iter().map(|row| row.unit).collect::<Vec<_>>()));
    let sentence = move || rows.with(|rows| sentence(rows));
    let typed = RwSignal::new(String::new());
    let field = NodeRef::<html::Input>::new();
    let wrong = Memo::new(move |_| {
        let typed = typed.get();
        (!typed.trim().is_empty() && number(&typed).is_none()).then_some("A unit is a number from 1 to 247.")
    });
    let add = move |key: String| {
        let Some((unit, device)) = number(&typed.get_untracked()).zip(Profile::of(&key)) else { return };
        typed.set(String::new());
        state.name_unit(unit, Some(device));
        // The list of devices waits for the next unit.
        if let Some(field) = field.get_untracked() {
            let _ = field.focus();
        }
    };
    view! {
        <section class="units" aria-labelledby="devices-units">
            <h3 id="devices-units">"Units and their devices"</h3>
            <p class="note">
                {move || sentence()}
                " A unit that has no device here is read as the one that is chosen in Read or Build."
            </p>
            <table class="table" aria-label="Units and their devices">
                <thead>
                    <tr>
                        <th scope="col">"Unit"</th>
                        <th scope="col">"Device"</th>
                        <th scope="col">"Why"</th>
                        <th scope="col">
                            <span class="unseen">"Remove"</span>
                        </th>
                    </tr>
                </thead>
                <tbody>
                    <For
                        each=move || units.get()
                        key=|unit| *unit
                        children=move |unit| view! { <UnitRow unit rows /> }
                    />
                    <tr class="new">
                        <th scope="row">
                            <input
                                node_ref=field
                                class="input"
                                inputmode="numeric"
                                autocomplete="off"
                                placeholder="Unit"
                                aria-label="Another unit"
                                aria-invalid=move || wrong.with(Option::is_some).to_string()
                                prop:value=typed
                                on:input=move |event| typed.set(event_target_value(&event))
                            />
                        </th>
                        <td>
                            <select
                                class="select"
                                aria-label="Device of another unit"
                                disabled=move || number(&typed.get()).is_none()
                                on:change=move |event| add(event_target_value(&event))
                            >
                                <option value="" prop:selected=move || { typed.track(); true }>"choose …"</option>
                                {devices(|_| false)}
                            </select>
                        </td>
                        <td colspan="2">
                            <span class="misfit" aria-live="polite">{wrong}</span>
                        </td>
                    </tr>
                </tbody>
            </table>
        </section>
    }
}

/// All devices as options; which of them is chosen.
fn devices(is_chosen: impl Fn(&'static str) -> bool + Copy + Send + 'static) -> Vec<AnyView> {
    let option = |profile: &&'static Profile| {
        let key = profile.key;
        view! { <option value=key prop:selected=move || is_chosen(key)>{profile.label}</option> }.into_any()
    };
    PROFILES.iter().map(option).collect()
}

#[component]
fn UnitRow(unit: u8, rows: Memo<Vec<Row>>) -> impl IntoView {
    let state = expect_context::<DeviceSettings>();
    let row = Memo::new(move |_| rows.with(|rows| rows.iter().find(|row| row.unit == unit).cloned()));
    let named = Memo::new(move |_| row.with(|row| row.as_ref()?.named));
    let choose = move |key: &str| state.name_unit(unit, Profile::of(key));
    let why = move || {
        let Row { named, proposed, seen, .. } = row.get()?;
        Some(match (named, proposed) {
            (Some(_), _) if seen => "chosen by you; Read shows telegrams of it".to_owned(),
            (Some(_), _) => "chosen by you".to_owned(),
            (None, Some((_, why))) => why,
            (None, None) => "Read shows telegrams of it".to_owned(),
        })
    };
    let take = move || {
        let (key, _) = row.get().filter(|row| row.named.is_none())?.proposed?;
        let label = Profile::of(key).map_or(key, |profile| profile.label);
        Some(view! {
            <button
                type="button"
                class="button low"
                aria-label=format!("Use it: unit {unit} is {label}")
                on:click=move |_| choose(key)
            >
                "Use it"
            </button>
        })
    };
    let forget = Callback::new(move |()| state.name_unit(unit, None));
    view! {
        <tr>
            <th scope="row">{unit}</th>
            <td>
                <select
                    class="select"
                    aria-label=format!("Device of unit {unit}")
                    on:change=move |event| choose(&event_target_value(&event))
                >
                    <option value="" prop:selected=move || named.get().is_none()>
                        "not known"
                    </option>
                    {devices(move |key| named.get() == Some(key))}
                </select>
            </td>
            <td class="why">{why} " " {take}</td>
            <td>
                <Show when=move || named.get().is_some()>
                    <Remove what=format!("unit {unit}") on_remove=forget />
                </Show>
            </td>
        </tr>
    }
}

/// The units whose telegrams Read shows.
fn seen(read: ReadState) -> Vec<u8> {
    /// More are in the log itself.
    const MOST: usize = 30;
    let mut units: Vec<u8> = match read.mode() {
        Mode::Log => read.log.overview.with(|overview| {
            let units = overview.iter().flat_map(|overview| &overview.units);
            units.filter_map(|unit| unit.unit).collect()
        }),
        _ => read.report().telegrams.iter().filter_map(|telegram| telegram.unit).collect(),
    };
    // 0 is everybody.
    units.retain(|unit| *unit != 0);
    let mut units = in_order(units, |unit| *unit);
    units.dedup();
    units.truncate(MOST);
    units
}

fn number(typed: &str) -> Option<u8> {
    typed.trim().parse().ok().filter(|unit| (1..=247).contains(unit))
}

/// "3 units, 2 devices."
fn sentence(rows: &[Row]) -> String {
    let mut devices = in_order(rows.iter().filter_map(|row| row.named), |named| *named);
    devices.dedup();
    match (rows.len(), devices.len()) {
        (0, _) => "No unit is named, and Read shows none.".to_owned(),
        (units, 0) => format!("{}, none with a device of its own.", many(units, "unit")),
        (units, devices) => format!("{}, {}.", many(units, "unit"), many(devices, "device")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_told_in_a_sentence() {
        let row = |unit, named| Row { unit, named, proposed: None, seen: true };
        assert_eq!(sentence(&[]), "No unit is named, and Read shows none.");
        assert_eq!(sentence(&[row(1, None)]), "1 unit, none with a device of its own.");
        let rows = [row(1, Some("memograph-rsg45")), row(3, Some("keb-f5-modbus")), row(4, None)];
        assert_eq!(sentence(&rows), "3 units, 2 devices.");
    }

    #[test]
    fn a_unit_is_a_number() {
        assert_eq!((number(" 3 "), number("0"), number("248"), number("x")), (Some(3), None, None, None));
    }
}
