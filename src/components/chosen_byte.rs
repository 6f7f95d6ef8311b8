//! The chosen byte: which field it is of, and how the field's value comes about.

use leptos::prelude::*;

use super::byte_strip::Lights;
use super::icon::{Glyph, Icon};
use super::telegram::Shown;
use super::toast::Toasts;
use buslens::tool::byte::{Share, itself, shares};

#[component]
pub fn ChosenByte(#[prop(into)] shown: Signal<Option<Shown>>, lights: Lights) -> impl IntoView {
    let toasts = expect_context::<Toasts>();
    // The whole of it would be said at each key: which byte of what it is, is enough until somebody goes there.
    Effect::watch(
        move || lights.chosen(),
        move |chosen, _, _| {
            let Some((shown, chosen)) = shown.get_untracked().zip(*chosen) else { return };
            let places = shares(&shown.detail, shown.bytes(), chosen.at);
            let places: Vec<_> = places.iter().map(|share| share.place.sentence()).collect();
            toasts.announce(places.join(", "));
        },
        false,
    );
    move || {
        let at = lights.chosen()?.at;
        let shown = shown.get()?;
        let byte = shown.bytes().get(at).copied()?;
        let shares: Vec<_> = shares(&shown.detail, shown.bytes(), at)
            .into_iter()
            .map(|share| view! { <Shared share /> })
            .collect();
        Some(view! {
            <section class="part chosen-byte" aria-label="Chosen byte">
                <header>
                    <h3>"Byte " {at} ": " <code>{itself(byte).to_string()}</code></h3>
                    <button
                        type="button"
                        class="button plain low icon-only"
                        aria-label="Close"
                        on:click=move |_| lights.chosen.set(None)
                    >
                        <Icon glyph=Glyph::Close />
                    </button>
                </header>
                {shares}
            </section>
        })
    }
}

#[component]
fn Shared(share: Share) -> impl IntoView {
    let steps: Vec<_> = share.steps.iter().map(|step| view! { <li>{step.sentence()}</li> }).collect();
    view! {
        <p class="place">{share.place.sentence()}</p>
        {(!steps.is_empty()).then(|| view! { <ul class="steps">{steps}</ul> })}
        {(!share.note.is_empty())
            .then(|| {
                view! {
                    <p class="note">
                        {share.note}
                        {(!share.source.is_empty()).then(|| view! { " " <cite>{share.source} "."</cite> })}
                    </p>
                }
            })}
    }
}
