//! The app: the views by address, and what outlasts them.

use std::rc::Rc;
use std::time::Duration;

use leptos::ev::{DragEvent, MouseEvent};
use leptos::prelude::*;
use leptos::wasm_bindgen::JsCast;
use web_sys::File;
use web_sys::js_sys::Reflect;

use crate::address::{Address, Shows, View};
use crate::browser::typing::is_typed_into;
use crate::components::header::Header;
use crate::components::toast::{ToastList, Toasts};
use crate::later::{Later, LaterPiece, Part, Piece};
use crate::views::devices::{Borrowed, DeviceSettings};
use crate::views::read::{Read, ReadState};
use crate::views::sheet::SheetState;
use buslens::tool::link::Link;

#[component]
pub fn App() -> impl IntoView {
    let address = Address::new();
    let toasts = Toasts::new();
    provide_context(address);
    provide_context(toasts);
    let devices = DeviceSettings::new();
    provide_context(devices);
    let later = Later::new();
    provide_context(later);
    let read = ReadState::new();
    provide_context(read);
    provide_context(SheetState::new());
    // Whoever looks at what there is has time for the rest to come.
    let load_all = move || [Part::Log, Part::Views].into_iter().for_each(|part| later.load(part));
    set_timeout(load_all, Duration::from_millis(1500));
    address.keep(Rc::new(States { read, devices, later, toasts }));

    Effect::new(move |_| {
        let view = address.view();
        let about = match view {
            View::Read | View::Sheet => read.title(),
            View::Build | View::Check | View::Devices | View::Learn => None,
        };
        let about = about.map_or(String::new(), |about| format!(": {about}"));
        document().set_title(&format!("{}{about} - Buslens", view.label()));
    });
    let main = NodeRef::<leptos::html::Main>::new();
    // The address holds the view, and so no place in the page.
    let skip = move |event: MouseEvent| {
        event.prevent_default();
        if let Some(main) = main.get_untracked() {
            let _ = main.focus();
        }
    };
    let open = move |file: File| {
        read.open(file);
        if address.view_now() != View::Read {
            address.go_to(View::Read);
        }
    };
    // Where the page is installed, the system opens files with it: the boot script hears of it first.
    let launched = window_event_listener_untyped("openfile", move |event| {
        let file = Reflect::get(&event, &"detail".into()).ok().and_then(|file| file.dyn_into().ok());
        file.into_iter().for_each(open);
    });
    on_cleanup(move || launched.remove());
    let dropped = move |event: DragEvent| {
        let Some(data) = event.data_transfer() else { return };
        let Some(file) = data.files().and_then(|files| files.get(0)) else {
            // Text that is moved within a field is the browser's to move.
            let text = data.get_data("text").unwrap_or_default();
            if !text.is_empty() && !is_typed_into(event.target()) {
                event.prevent_default();
                read.load(text);
            }
            return;
        };
        event.prevent_default();
        if address.view_now() == View::Devices {
            // It takes files of settings, and listens itself.
            return;
        }
        let folder = data.items().get(0).and_then(|item| item.webkit_get_as_entry().ok().flatten());
        if folder.is_some_and(|entry| entry.is_directory()) {
            return toasts.say(format!("{} is a folder: open a file in it.", file.name()));
        }
        open(file);
    };
    let view = move || match address.view() {
        View::Read => view! { <Read /> }.into_any(),
        View::Build => view! { <LaterPiece piece=Piece::Build /> }.into_any(),
        View::Check => view! { <LaterPiece piece=Piece::Check /> }.into_any(),
        View::Devices => view! { <LaterPiece piece=Piece::Devices /> }.into_any(),
        View::Learn => view! { <LaterPiece piece=Piece::Learn /> }.into_any(),
        View::Sheet => view! { <LaterPiece piece=Piece::Sheet /> }.into_any(),
    };
    view! {
        <div class="app" on:dragover=|event| event.prevent_default() on:drop=dropped>
            <a class="skip" href="#main" on:click=skip>
                "Skip to the content"
            </a>
            <Header />
            <Borrowed />
            <main id="main" tabindex="-1" node_ref=main>
                {view}
            </main>
            <LaterPiece piece=Piece::Foot />
            <ToastList />
        </div>
    }
}

/// What the views show.
struct States {
    read: ReadState,
    devices: DeviceSettings,
    later: Later,
    toasts: Toasts,
}

impl Shows for States {
    fn link(&self, view: View) -> Link {
        match view {
            View::Read | View::Sheet => self.read.link(),
            View::Devices => self.devices.link(),
            View::Build | View::Check | View::Learn => self.later.link(view),
        }
    }

    fn follow(&self, view: View, link: Link) {
        match view {
            View::Read | View::Sheet => self.read.follow(link),
            View::Devices => self.devices.follow(link),
            View::Build | View::Check | View::Learn => self.later.follow(view, link),
        }
    }

    fn refuse(&self, why: &str) {
        self.toasts.say(why);
    }
}
