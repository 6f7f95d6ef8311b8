//! A log to pass on: what is to be hidden in it, what was replaced, and the file.

use leptos::prelude::*;
use web_sys::Blob;

use crate::browser::file;
use crate::components::dialog::Dialog;
use crate::components::icon::{Glyph, Icon};
use crate::components::toast::Toasts;
use crate::components::wide_table::WideTable;
use crate::worker::messages::Passed;
use buslens::field::many;
use buslens::tool::log::{Hidden, Replaced};

#[component]
pub fn PassOn(
    open: RwSignal<bool>,
    /// What the log is called.
    #[prop(into)]
    name: Signal<String>,
    /// Makes it.
    ask: Callback<Hidden>,
    /// What was made.
    passed: RwSignal<Option<(Passed, Blob)>, LocalStorage>,
) -> impl IntoView {
    let [units, addresses, texts] = [(); 3].map(|()| RwSignal::new(true));
    let names = RwSignal::new(String::new());
    let waiting = RwSignal::new(false);
    // What was made is of what was asked for then.
    Effect::new(move || {
        open.track();
        units.track();
        addresses.track();
        texts.track();
        names.track();
        passed.set(None);
        waiting.set(false);
    });
    Effect::new(move || {
        if passed.with(Option::is_some) {
            waiting.set(false);
        }
    });
    let make = move |_| {
        let names = names.get_untracked();
        let names = names.split(',').map(str::trim).filter(|name| !name.is_empty());
        waiting.set(true);
        ask.run(Hidden {
            units: units.get_untracked(),
            addresses: addresses.get_untracked(),
            texts: texts.get_untracked(),
            names: names.map(str::to_owned).collect(),
        });
    };
    let choice = move |chosen: RwSignal<bool>, label: &'static str, about: &'static str| {
        view! {
            <label class="tick">
                <input
                    type="checkbox"
                    prop:checked=chosen
                    on:change=move |event| chosen.set(event_target_checked(&event))
                />
                <span>{label} <span class="note">{about}</span></span>
            </label>
        }
    };
    let save = move |_| {
        passed.with_untracked(|passed| {
            if let Some((passed, blob)) = passed {
                file::save_blob(&name_to_pass_on(&name.get_untracked(), passed.is_capture), blob);
            }
        });
    };
    let save_list = move |_| {
        passed.with_untracked(|passed| {
            if let Some((passed, _)) = passed {
                let list: String = passed.replaced.iter().map(Replaced::line).collect();
                file::save("replaced.txt", &format!("what\twas\tis now\ttimes\n{list}"));
            }
        });
    };
    // Told to screen readers, too.
    let toasts = expect_context::<Toasts>();
    Effect::new(move || {
        if let Some(count) = passed.with(|it| it.as_ref().map(|(it, _)| it.replaced.len())) {
            toasts.announce(format!("{} replaced", many(count, "thing")));
        }
    });
    let made = move || passed.with(|passed| passed.as_ref().map(|(passed, _)| outcome(passed)));
    let ready = Memo::new(move |_| passed.with(Option::is_some));
    view! {
        <Dialog open title="A log to pass on" class="drawer">
            <p>
                "What is nobody’s business is replaced by something of the same length, the same by the same \
                 everywhere. Checksums that were valid are valid again; all else stays as it is."
            </p>
            <fieldset class="choices">
                <legend>"Hide"</legend>
                {choice(units, "Units and stations", "in telegrams, and behind words such as “unit” or “slave”")}
                {choice(addresses, "Network addresses", "IP and MAC, in the words of the log")}
                {choice(texts, "Texts in telegrams", "serial numbers, names, messages")}
                <label class="entry">
                    <span class="name">"Names, with a comma between them"</span>
                    <input
                        class="input"
                        autocomplete="off"
                        placeholder="For example a customer, a plant, a computer"
                        prop:value=names
                        on:input=move |event| names.set(event_target_value(&event))
                    />
                </label>
            </fieldset>
            {move || made()}
            <footer>
                <Show
                    when=move || ready.get()
                    fallback=move || {
                        view! {
                            <button
                                type="button"
                                class="button main"
                                disabled=move || waiting.get()
                                on:click=make
                            >
                                {move || if waiting.get() { "One moment" } else { "Replace, and show what" }}
                            </button>
                        }
                    }
                >
                    <button type="button" class="button" on:click=save_list>
                        <Icon glyph=Glyph::Save />
                        "Save the list"
                    </button>
                    <button type="button" class="button main" on:click=save>
                        <Icon glyph=Glyph::Save />
                        "Save the log"
                    </button>
                </Show>
            </footer>
        </Dialog>
    }
}

/// What was replaced, and what stayed.
fn outcome(passed: &Passed) -> impl IntoView + use<> {
    /// More are in the list.
    const SHOWN: usize = 100;
    let count = passed.replaced.len();
    let more = count.saturating_sub(SHOWN);
    let row = |it: &Replaced| {
        view! {
            <tr>
                <td class="soft">{it.kind.label()}</td>
                <td>{it.from.clone()}</td>
                <td>{it.to.clone()}</td>
                <td class="number">{it.times}</td>
            </tr>
        }
    };
    let rows = passed.replaced.iter().take(SHOWN).map(row).collect_view();
    let mut stayed = Vec::new();
    if passed.left > 0 {
        stayed.push(format!(
            "{} could not be changed, since their bytes were not found in the text.",
            many(passed.left, "telegram")
        ));
    }
    if passed.unread > 0 {
        stayed.push(format!("{} of no telegram stay as they are.", many(passed.unread, "byte")));
    }
    if passed.is_capture {
        stayed.push("The capture is written anew, of its telegrams only.".to_owned());
    }
    stayed.push(
        "Look through it before you pass it on: a log can name things in ways that nobody knows.".to_owned(),
    );
    let stayed = stayed.into_iter().map(|said| view! { <li>{said}</li> }).collect_view();
    view! {
        <h3>
            {if count == 0 { "Nothing to replace was found".to_owned() } else { many(count, "thing") + " replaced" }}
        </h3>
        {(count > 0)
            .then(|| {
                view! {
                    <WideTable label="What was replaced">
                        <thead>
                            <tr>
                                <th scope="col">"What"</th>
                                <th scope="col">"Was"</th>
                                <th scope="col">"Is now"</th>
                                <th scope="col">"Times"</th>
                            </tr>
                        </thead>
                        <tbody>{rows}</tbody>
                    </WideTable>
                }
            })}
        {(more > 0).then(|| view! { <p class="note">{format!("and {more} more, in the list")}</p> })}
        <p class="note">"The list is for you alone: it says what stands for what."</p>
        <ul class="note">{stayed}</ul>
    }
}

/// "converter.log" becomes "converter-to-pass-on.log".
fn name_to_pass_on(name: &str, is_capture: bool) -> String {
    let (stem, end) = name.rsplit_once('.').unwrap_or((name, "txt"));
    let stem = if stem.is_empty() { "log" } else { stem };
    format!("{stem}-to-pass-on.{}", if is_capture { "pcapng" } else { end })
}

#[cfg(test)]
mod tests {
    use super::name_to_pass_on;

    #[test]
    fn the_name_says_what_it_is() {
        assert_eq!(name_to_pass_on("converter.log", false), "converter-to-pass-on.log");
        assert_eq!(name_to_pass_on("Pasted text", false), "Pasted text-to-pass-on.txt");
        assert_eq!(name_to_pass_on("plant.pcap", true), "plant-to-pass-on.pcapng");
    }
}
