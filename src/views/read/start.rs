//! What a person sees first.

use leptos::prelude::*;

use super::ReadState;
use super::examples::FirstExamples;
use super::open_file::OpenFile;

#[component]
pub fn Start() -> impl IntoView {
    let read = expect_context::<ReadState>();
    let missing = move || {
        read.missing.get().map(|name| {
            view! {
                <div class="missing" role="status">
                    <p>
                        <strong>{name.clone()}</strong>
                        " was open at your last visit. This browser has not kept it: open it again."
                    </p>
                    <OpenFile label=format!("Open {name}") class="main" />
                </div>
            }
        })
    };
    view! {
        <section class="start">
            {missing}
            <h2>"What does this telegram say?"</h2>
            <p class="lead">
                "Paste the bytes of a Modbus or PROFIBUS telegram, a whole log, or the mail they came in; or drop a file of any size. Every byte is explained, every checksum verified, every fault named."
            </p>
            <h3>"Or start with an example"</h3>
            <FirstExamples />
            <dl class="kinds">
                <dt>"Telegrams"</dt>
                <dd>"01 03 00 C8, 0103, 0x01, \\x01, 01h, [01], :0103…, arrays of C, Python and Rust"</dd>
                <dt>"Logs"</dt>
                <dd>"of any program and layout; hex, octal and decimal dumps; one byte a line"</dd>
                <dt>"Files"</dt>
                <dd>"raw bytes of a line, captures of networks (pcap, pcapng), up to 2 GB"</dd>
            </dl>
        </section>
    }
}
