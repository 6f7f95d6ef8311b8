//! Devices.

mod state;

use leptos::prelude::*;

pub use state::DeviceSettings;

#[component]
pub fn Devices() -> impl IntoView {
    view! { <p>"Devices"</p> }
}
