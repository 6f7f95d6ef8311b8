//! Devices: how the user's devices are set up, which Decode and Build follow.

use leptos::prelude::*;
use web_sys::Event;

use crate::app::components::{device_file, drawn, form, header};
use crate::app::setup::Setup;

/// An event of the page, for the part that it concerns.
pub fn hear(setup: Setup, event: &Event) {
    let kind = event.type_();
    header::hear(&kind, event);
    device_file::hear(setup, &kind, event);
    form::hear(&kind, event, |path, change| setup.edit(path, change));
}

#[component]
pub fn Devices(setup: Setup) -> impl IntoView {
    let form = drawn(move || {
        setup.shape.track();
        setup.now(|kept| form::form(&kept.entries))
    });
    view! {
        <header::Header here="devices.html" />
        <main id="main" class="panes even" tabindex="-1">
            <section class="card form plain" aria-label="Settings of the devices" inner_html=form></section>
            <device_file::DeviceFile setup />
        </main>
    }
}
