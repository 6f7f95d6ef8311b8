//! What a task lays before the learner.

use leptos::prelude::*;

use crate::address::{View, href};
use crate::components::byte_strip::{Block, ByteStrip, Lights, blocks};
use buslens::field::{Direction, Span, hex};
use buslens::tool::Options;
use buslens::tool::link::Link;
use buslens_trainer::{Given, Telegram};

/// The bytes without a word on what they are, counted from 0.
pub fn plain(bytes: &[u8]) -> Vec<Block> {
    bytes.iter().enumerate().map(|(at, byte)| bare(at, *byte)).collect()
}

pub fn bare(at: usize, byte: u8) -> Block {
    Block {
        name: String::new(),
        label: String::new(),
        caption: at.to_string(),
        class: "role-unknown bare",
        faulty: false,
        span: Span::new(at, at + 1),
        bytes: vec![byte],
    }
}

/// The bytes with the names and values of their fields.
pub fn named(telegram: &Telegram) -> Vec<Block> {
    telegram.detail().map_or_else(|| plain(&telegram.bytes), |detail| blocks(&detail, &telegram.bytes))
}

/// What a telegram is called that stands among others.
pub fn caption(telegram: &Telegram, alone: bool) -> &'static str {
    match telegram.direction {
        _ if alone => "The telegram",
        Direction::Request => "The request",
        Direction::Response => "The response",
    }
}

#[component]
pub fn GivenPart(
    given: Given,
    /// The only one.
    alone: bool,
    lights: Lights,
    /// Whether the fields are named.
    #[prop(into)]
    told: Signal<bool>,
) -> impl IntoView {
    match given {
        Given::Text(text) => view! {
            <pre class="log-lines mono" tabindex="0" role="region" aria-label="The log">
                {text}
            </pre>
        }
        .into_any(),
        Given::Telegram(telegram) => {
            let title = caption(&telegram, alone);
            let telegram = StoredValue::new(telegram);
            let blocks = Memo::new(move |_| {
                telegram
                    .with_value(|telegram| if told.get() { named(telegram) } else { plain(&telegram.bytes) })
            });
            view! {
                <figure class="given">
                    <figcaption>{title}</figcaption>
                    <ByteStrip
                        blocks
                        lights
                        label=format!("{title}. Arrow keys go from byte to byte.")
                    />
                </figure>
            }
            .into_any()
        }
    }
}

/// A link to Read, with all that is given.
pub fn in_read(given: &[Given], answer: Option<&Telegram>) -> Option<String> {
    let telegrams = given.iter().filter_map(|one| match one {
        Given::Telegram(telegram) => Some(telegram),
        Given::Text(_) => None,
    });
    let all: Vec<&Telegram> = telegrams.chain(answer).collect();
    let text = match (given, all.as_slice()) {
        ([Given::Text(text)], _) => text.clone(),
        (_, []) => return None,
        (_, all) => all.iter().map(|telegram| hex(&telegram.bytes)).collect::<Vec<_>>().join("\n"),
    };
    let options = match all.last() {
        Some(last) => {
            Options { protocol: Some(last.protocol), device: last.options.device, ..Options::default() }
        }
        None => Options::default(),
    };
    Some(href(View::Read, &Link { telegram: all.len().saturating_sub(1), ..Link::to(text, options) }))
}
