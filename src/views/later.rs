//! The views that come after the first one. They are a part of the module that is loaded when the page has
//! time for it, or at once when somebody asks for one of them: who reads a telegram need not wait for the
//! forms that build them.
// What parts the module hands values over as C functions do.
#![allow(unsafe_code)]

use leptos::prelude::*;
use leptos::task::spawn_local;

use super::build::Build;
use super::check::Check;
use super::devices::Devices;
use super::read::LogView;
use super::sheet::Sheet;

/// What is in that part.
pub struct Later {
    pub build: fn() -> AnyView,
    pub check: fn() -> AnyView,
    pub devices: fn() -> AnyView,
    pub sheet: fn() -> AnyView,
    pub log: fn() -> AnyView,
}

/// It did not come: the connection is gone.
struct NotLoaded;

impl From<leptos::wasm_split::SplitLoaderError> for NotLoaded {
    fn from(_: leptos::wasm_split::SplitLoaderError) -> Self {
        Self
    }
}

#[leptos::wasm_split::wasm_split(later, wasm_split_path = ::leptos::wasm_split, fallible)]
fn later() -> Result<&'static Later, NotLoaded> {
    // Made here and not a static: what a static names is in the first part.
    Ok(Box::leak(Box::new(Later {
        build: || view! { <Build /> }.into_any(),
        check: || view! { <Check /> }.into_any(),
        devices: || view! { <Devices /> }.into_any(),
        sheet: || view! { <Sheet /> }.into_any(),
        log: || view! { <LogView /> }.into_any(),
    })))
}

/// How far that part is loaded.
#[derive(Clone, Copy)]
pub struct LaterViews(RwSignal<Loaded, LocalStorage>);

#[derive(Clone, Copy)]
enum Loaded {
    Not,
    Loading,
    Failed,
    There(&'static Later),
}

impl LaterViews {
    pub fn new() -> Self {
        Self(RwSignal::new_local(Loaded::Not))
    }

    /// Loads it, if that has not begun.
    pub fn load(&self) {
        if let Loaded::Loading | Loaded::There(_) = self.0.get_untracked() {
            return;
        }
        let loaded = self.0;
        loaded.set(Loaded::Loading);
        spawn_local(async move {
            loaded.set(match later().await {
                Ok(later) => Loaded::There(later),
                Err(NotLoaded) => Loaded::Failed,
            });
        });
    }
}

/// One of those views.
#[component]
pub fn LaterView(which: fn(&Later) -> fn() -> AnyView) -> impl IntoView {
    let views = expect_context::<LaterViews>();
    views.load();
    move || {
        match views.0.get() {
        Loaded::There(later) => which(later)(),
        Loaded::Not | Loaded::Loading => view! { <p class="coming" role="status">"One moment"</p> }.into_any(),
        Loaded::Failed => view! {
            <div class="refused" role="alert">
                <span>"This view could not be loaded: check the connection. What you typed is still here."</span>
                <button type="button" class="button low" on:click=move |_| views.load()>
                    "Try again"
                </button>
            </div>
        }
        .into_any(),
    }
    }
}
