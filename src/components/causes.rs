//! What may have happened to a telegram whose checksum is wrong.

use leptos::prelude::*;

use super::copy_button::CopyButton;
use super::fold::Fold;
use super::icon::{Glyph, Icon};
use super::telegram::Shown;
use crate::address::{View, href};
use buslens::field::{Span, hex};
use buslens::tool::link::Link;
use buslens::tool::{Explanation, Options};

/// The causes, best first. The first is open.
#[component]
pub fn Causes(
    #[prop(into)] shown: Signal<Option<Shown>>,
    /// Puts the corrected bytes in the place of those that came, where that can be done.
    #[prop(optional)]
    on_use: Option<Callback<Vec<u8>>>,
) -> impl IntoView {
    move || {
        let shown = shown.get()?;
        let warning = shown.report.undecidable(shown.index).map(|why| why.sentence() + ".");
        let causes: Vec<_> = shown
            .report
            .explanations(shown.index)
            .into_iter()
            .enumerate()
            .map(|(index, cause)| view! { <Cause shown=shown.clone() cause open=index == 0 on_use /> })
            .collect();
        (!causes.is_empty()).then(|| {
            view! {
                <section class="part causes">
                    <h3>"Possible causes"</h3>
                    {warning.map(|warning| view! { <p class="advice"><Icon glyph=Glyph::Warning />{warning}</p> })}
                    <ol>{causes}</ol>
                </section>
            }
        })
    }
}

#[component]
fn Cause(shown: Shown, cause: Explanation, open: bool, on_use: Option<Callback<Vec<u8>>>) -> impl IntoView {
    let title = cause.hypothesis.text(shown.bytes()).sentence() + ".";
    // What fits anything says nothing for itself.
    let odds = match cause.hypothesis.odds().to_string() {
        odds if odds == "always" => "always possible".to_owned(),
        odds => format!("{odds} by chance"),
    };
    let summary = move || {
        view! {
            <span>{title.clone()}</span>
            " "
            <span class="odds">{odds.clone()}</span>
        }
    };
    view! {
        <li>
            <Fold summary open class="cause">
                <Corrected shown=shown.clone() cause=cause.clone() on_use />
            </Fold>
        </li>
    }
}

/// The telegram as it came, and as it was if the cause is the true one.
#[component]
fn Corrected(shown: Shown, cause: Explanation, on_use: Option<Callback<Vec<u8>>>) -> impl IntoView {
    let found = shown.bytes().to_vec();
    let right = cause.hypothesis.bytes.clone();
    let options = Options {
        protocol: cause.hypothesis.protocol.or(Some(shown.telegram.choice.protocol)),
        direction: None,
        ..shown.options.clone()
    };
    let both = Link { telegram: 1, ..Link::to(format!("{}\n{}", hex(&found), hex(&right)), options) };
    let sense = cause.sense().sentence() + ".";
    let copied = hex(&right);
    let said = cause.said.sentence() + ".";
    let used = right.clone();
    let use_it = on_use.map(|on_use| {
        view! {
            <button type="button" class="button main" on:click=move |_| on_use.run(used.clone())>
                "Use the corrected telegram"
            </button>
        }
    });
    view! {
        <div class="compared">
            <span>"Received"</span>
            <Marked bytes=found spans=cause.removed class="bad" />
            <span>"Corrected"</span>
            <Marked bytes=right spans=cause.added class="good" />
            <span>"Meaning"</span>
            <p>
                <strong>{said}</strong>
                " "
                <span class="note">{sense}</span>
            </p>
        </div>
        <div class="acts">
            {use_it} <CopyButton text=copied label="Copy the corrected bytes" class="low" />
            <a class="button low" href=href(View::Read, &both)>"Compare both"</a>
        </div>
    }
}

/// Bytes with those of `spans` marked. What is alike stands in one piece: it is drawn anew at each keystroke.
#[component]
fn Marked(bytes: Vec<u8>, spans: Vec<Span>, class: &'static str) -> impl IntoView {
    let is_marked = |at: usize| spans.iter().any(|span| span.contains(at));
    let places: Vec<usize> = (0..bytes.len()).collect();
    let piece = |places: &[usize]| {
        let text = hex(&bytes[places[0]..places[0] + places.len()]);
        match is_marked(places[0]) {
            true => view! { <mark class=class>{text}</mark> " " }.into_any(),
            false => (text + " ").into_any(),
        }
    };
    let pieces: Vec<_> =
        places.chunk_by(|one, next| is_marked(*one) == is_marked(*next)).map(piece).collect();
    view! { <code>{pieces}</code> }
}
