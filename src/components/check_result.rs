//! The check: what it covers, what was found, what it should be.

use leptos::prelude::*;

use super::byte_strip::{Chosen, Lights};
use super::copy_button::CopyButton;
use super::icon::{Glyph, Icon};
use super::telegram::Shown;
use crate::address::{View, href};
use crate::views::check::link_to;
use buslens::field::{Check, Span, hex, hex_value};
use buslens::tool::Verdict;

#[component]
pub fn CheckResult(shown: Shown, lights: Lights) -> impl IntoView {
    match shown.detail.check() {
        Some(check) => view! { <Checked shown check lights /> }.into_any(),
        None => view! { <Unchecked shown /> }.into_any(),
    }
}

#[component]
fn Checked(shown: Shown, check: Check, lights: Lights) -> impl IntoView {
    let ok = check.ok();
    let name = check.kind.to_ascii_uppercase();
    let short = name.split(['-', '/']).next().unwrap_or(&name).to_owned();
    let covered = check.covered;
    let choose = move |_| lights.chosen.set(Some(Chosen { span: covered, at: covered.from }));
    let followed = href(
        View::Check,
        &link_to(Span::new(covered.from, covered.to + check.width).of(shown.bytes()), check.kind),
    );
    let title = if ok { format!("{short} is valid") } else { format!("{short} is wrong") };
    let order = if check.low_first && check.width > 1 { "low byte first" } else { "" };
    let corrected = hex(&corrected(shown.bytes(), &check));
    view! {
        <section class="part check-result">
            <p class="verdict" class:good=ok class:bad=!ok>
                <Icon glyph=if ok { Glyph::Tick } else { Glyph::Close } />
                {title}
            </p>
            <dl class="pairs">
                <dt>{if ok { "On the wire" } else { "Received" }}</dt>
                <dd>
                    <code>{check.found_bytes()}</code>
                    " "
                    <span class="soft">{order}</span>
                </dd>
                {(!ok)
                    .then(|| {
                        view! {
                            <dt>"Computed"</dt>
                            <dd>
                                <code>{check.computed_bytes()}</code>
                            </dd>
                        }
                    })}
                <dt>"As a number"</dt>
                <dd>
                    <code>{hex_value(check.computed_value(), check.width).to_string()}</code>
                    " "
                    <span class="soft">
                        {name} " over "
                        <button type="button" class="link" on:click=choose>
                            {format!("bytes {} to {}", covered.from, covered.to.saturating_sub(1))}
                        </button>
                    </span>
                </dd>
            </dl>
            {(!ok)
                .then(|| {
                    view! {
                        <p class="note">
                            {format!(
                                "A byte was changed, lost or added on the way, or the {short} itself is wrong. The {short} cannot tell which, so the reading above may be wrong, too.",
                            )}
                        </p>
                    }
                })}
            <p class="acts">
                <a href=followed>"Follow it step by step"</a>
                {(!ok)
                    .then(|| {
                        view! { <CopyButton text=corrected label="Copy with the correct checksum" class="low" /> }
                    })}
            </p>
        </section>
    }
}

/// Says why nothing is checked, so that nobody takes it for checked.
#[component]
fn Unchecked(shown: Shown) -> impl IntoView {
    let protocol = shown.telegram.choice.protocol.label;
    let (title, why) = match shown.detail.verdict {
        Verdict::Unchecked => (
            "Not checked",
            "It is too short to hold its checksum: it was cut, or more is to come.".to_owned(),
        ),
        // A short acknowledgement of PROFIBUS is a byte of its own.
        _ if shown.bytes().len() == 1 => {
            ("No checksum", "A short acknowledgement is one byte and has no checksum.".to_owned())
        }
        _ => (
            "No checksum of its own",
            format!(
                "{protocol} has none at this level: the layer below protects the bytes, so a changed byte cannot be detected here."
            ),
        ),
    };
    view! {
        <section class="part check-result">
            <p class="verdict">{title}</p>
            <p class="note">{why}</p>
        </section>
    }
}

/// The bytes with the checksum as it should be.
fn corrected(bytes: &[u8], check: &Check) -> Vec<u8> {
    let place = Span::new(check.covered.to, check.covered.to + check.width);
    let computed = &check.computed.to_be_bytes()[8 - check.width..];
    [Span::new(0, place.from).of(bytes), computed, Span::new(place.to, bytes.len().max(place.to)).of(bytes)]
        .concat()
}
