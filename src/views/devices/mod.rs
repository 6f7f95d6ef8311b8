//! Devices: how the user's devices are set up, which Read and Build follow.

mod rows;
mod state;
mod units;

use leptos::ev::{self, KeyboardEvent};
use leptos::prelude::*;
use leptos::wasm_bindgen::JsCast;
use web_sys::{HtmlInputElement, HtmlSelectElement};

use crate::browser::file;
use crate::components::form::{Edit, Form};
use crate::components::icon::{Glyph, Icon};
use crate::components::open_file::OpenFile;
use buslens::tool::PROFILES;
use buslens::tool::setup::{Difference, List};
use rows::Rows;
pub use state::DeviceSettings;
use units::Units;

#[component]
pub fn Devices() -> impl IntoView {
    let state = expect_context::<DeviceSettings>();
    // In a field the keys are the browser's, which takes typing back letter by letter.
    let keys = move |event: KeyboardEvent| {
        let target = event.target();
        let in_field = target.as_ref().is_some_and(|target| {
            target.dyn_ref::<HtmlInputElement>().is_some_and(|field| field.type_() != "checkbox")
                || target.dyn_ref::<HtmlSelectElement>().is_some()
        });
        if in_field || !(event.ctrl_key() || event.meta_key()) {
            return;
        }
        match (event.key().as_str(), event.shift_key()) {
            ("z" | "Z", false) => state.undo(),
            ("z" | "Z", true) | ("y", _) => state.redo(),
            _ => return,
        }
        event.prevent_default();
    };
    let dropped = window_event_listener(ev::drop, move |event| {
        if let Some(file) = event.data_transfer().and_then(|data| data.files()?.get(0)) {
            state.open(file);
        }
    });
    on_cleanup(move || dropped.remove());
    view! {
        <div class="devices" on:keydown=keys>
            <div class="settings">
                <header>
                    <h2>"How your devices are set up"</h2>
                    <p class="note">
                        "The meaning of some telegrams depends on how the device is configured. Read and Build \
                         follow what is set here. Configuration found in a log takes precedence."
                    </p>
                </header>
                <Units />
                <Modbus />
                <Profibus />
                <Others />
            </div>
            <Changes />
        </div>
    }
}

/// Says in every view that a link's settings count.
#[component]
pub fn Borrowed() -> impl IntoView {
    let state = expect_context::<DeviceSettings>();
    view! {
        <Show when=move || state.is_of_link()>
            <div class="borrowed" role="status">
                <Icon glyph=Glyph::Link />
                <span>"The link you opened brings its own set-up. Yours is kept."</span>
                <span class="end">
                    <button type="button" class="button low" on:click=move |_| state.use_own()>
                        "Use mine"
                    </button>
                    <button type="button" class="button low" on:click=move |_| state.keep_of_link()>
                        "Keep the link’s"
                    </button>
                </span>
            </div>
        </Show>
    }
}

/// Takes a row out of a table.
#[component]
fn Remove(what: String, on_remove: Callback<()>) -> impl IntoView {
    view! {
        <button
            type="button"
            class="button plain low icon-only"
            aria-label=format!("Remove {what}")
            on:click=move |_| on_remove.run(())
        >
            <Icon glyph=Glyph::Close />
        </button>
    }
}

/// Some entries of the settings as a form.
#[component]
fn Entries(only: &'static [&'static str]) -> impl IntoView {
    let state = expect_context::<DeviceSettings>();
    let on_edit = Callback::new(move |(path, edit): (String, Edit)| state.edit(&path, &edit));
    view! { <Form entries=Signal::derive(move || state.entries()) on_edit only named=&["dialect", "profibus"] /> }
}

#[component]
fn Modbus() -> impl IntoView {
    view! {
        <section aria-labelledby="devices-modbus">
            <h3 id="devices-modbus">"KEB COMBIVERT F5 on Modbus"</h3>
            <div class="side-by-side">
                <Rows
                    list=List::ReadMapping
                    title="Registers you read"
                    about="What registers 0000h to 1FFFh give: the mapping list for reading."
                />
                <Rows
                    list=List::WriteMapping
                    title="Registers you write"
                    about="What registers 0000h to 1FFFh take: the mapping list for writing."
                />
            </div>
            <Entries only=&["dialect"] />
        </section>
    }
}

#[component]
fn Profibus() -> impl IntoView {
    view! {
        <section aria-labelledby="devices-profibus">
            <h3 id="devices-profibus">"KEB COMBIVERT F5 on PROFIBUS-DP"</h3>
            <div class="side-by-side">
                <Rows
                    list=List::ProcessInput
                    title="Process input data"
                    about="What the words from the device carry."
                />
                <Rows
                    list=List::ProcessOutput
                    title="Process output data"
                    about="What the words to the device carry."
                />
            </div>
            <Entries only=&["profibus", "outputs", "inputs"] />
        </section>
    }
}

/// Devices whose telegrams need no settings.
#[component]
fn Others() -> impl IntoView {
    let others = PROFILES.iter().filter(|profile| !profile.key.starts_with("keb-f5"));
    let others = others.map(|profile| {
        view! {
            <section>
                <h3>{profile.label}</h3>
                <p class="note">"Nothing to set up: its telegrams say all that they mean."</p>
            </section>
        }
    });
    others.collect_view()
}

/// What is no factory setting, and the settings as a file.
#[component]
fn Changes() -> impl IntoView {
    let state = expect_context::<DeviceSettings>();
    let differences = Memo::new(move |_| state.differences());
    let row = move |Difference { said, what }: Difference| {
        let said = said.sentence();
        let name = format!("Undo: {said}");
        view! {
            <li>
                <span>{said} "."</span>
                <button
                    type="button"
                    class="button plain low"
                    aria-label=name
                    on:click=move |_| state.put_back(what)
                >
                    <Icon glyph=Glyph::Undo />
                    "Undo"
                </button>
            </li>
        }
    };
    let kept = move || match state.not_kept() {
        None => view! { <p class="note">"Stored in this browser and included in every link."</p> }.into_any(),
        Some(why) => view! {
            <p class="verdict warn" role="alert">
                <Icon glyph=Glyph::Warning />
                {why.sentence()}
            </p>
        }
        .into_any(),
    };
    view! {
        <aside class="changes" aria-label="Changed from factory settings">
            <h3>"Changed from factory settings"</h3>
            <Show
                when=move || !differences.with(Vec::is_empty)
                fallback=|| view! { <p class="note">"None: everything is at factory settings."</p> }
            >
                <ol>
                    <For
                        each=move || differences.get()
                        key=|difference| (difference.what, difference.said.to_string())
                        children=row
                    />
                </ol>
            </Show>
            <div class="actions">
                <button type="button" class="button" disabled=move || !state.can_undo() on:click=move |_| state.undo()>
                    <Icon glyph=Glyph::Undo />
                    "Undo"
                </button>
                <button type="button" class="button" disabled=move || !state.can_redo() on:click=move |_| state.redo()>
                    "Redo"
                </button>
                <button
                    type="button"
                    class="button plain"
                    disabled=move || differences.with(Vec::is_empty)
                    on:click=move |_| state.put_all_back()
                >
                    "Reset all"
                </button>
            </div>
            {move || kept()}
            <div class="actions">
                <button
                    type="button"
                    class="button"
                    on:click=move |_| file::save("buslens-devices.txt", &untrack(|| state.text()))
                >
                    <Icon glyph=Glyph::Save />
                    "Save as a file"
                </button>
                <OpenFile
                    label="Open a file"
                    accept=".txt,text/plain"
                    on_open=Callback::new(move |file| state.open(file))
                />
            </div>
            <details>
                <summary>"What the file holds"</summary>
                <pre>{move || Some(state.text()).filter(|text| !text.is_empty()).unwrap_or_else(|| "# factory settings\n".to_owned())}</pre>
            </details>
        </aside>
    }
}
