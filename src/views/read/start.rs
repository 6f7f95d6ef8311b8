//! What a person sees first: where to put things, what to try, and what comes of it.

use leptos::prelude::*;

use super::ReadState;
use super::examples::FirstExamples;
use super::pictures::Pictures;
use crate::components::open_file::OpenFile;

/// What stands over the input.
#[component]
pub fn Welcome() -> impl IntoView {
    let read = expect_context::<ReadState>();
    let missing = move || {
        read.missing.get().map(|name| {
            view! {
                <div class="missing" role="status">
                    <p>
                        <strong>{name.clone()}</strong>
                        " was open at your last visit. This browser has not kept it: open it again."
                    </p>
                    <OpenFile label=format!("Open {name}") class="main" on_open=read.opener() />
                </div>
            }
        })
    };
    view! {
        <section class="welcome">
            {move || missing()} <h2>"Paste what the bus said. Read what it means."</h2>
            <p>
                "Every byte explained, every checksum verified, every fault named, in the words of the device's manual."
            </p>
        </section>
    }
}

/// What stands below it, and beside it.
#[component]
pub fn Start() -> impl IntoView {
    view! {
        <section class="first">
            <h3>"Or see it work"</h3>
            <FirstExamples />
            <p class="note">
                "More under Examples; or " <a href="#/build">"build a telegram"</a> " by saying what it should do."
            </p>
        </section>
        <div class="pictures">
            <Pictures />
        </div>
        <dl class="kinds">
            <div>
                <dt>"Protocols"</dt>
                <dd>"Modbus RTU, TCP, ASCII; PROFIBUS-DP"</dd>
            </div>
            <div>
                <dt>"Devices"</dt>
                <dd>"KEB COMBIVERT F5, Memograph M RSG45"</dd>
            </div>
            <div>
                <dt>"Logs"</dt>
                <dd>"of any program; hex, octal and decimal dumps; captures (pcap, pcapng); raw bytes; of any size"</dd>
            </div>
        </dl>
    }
}
