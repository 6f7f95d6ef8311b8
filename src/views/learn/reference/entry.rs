//! Everything about one register, parameter or code.

use std::sync::Arc;

use leptos::prelude::*;

use super::diagram::{BitDiagram, meaning, meanings};
use crate::address::{View, href};
use crate::components::button::ButtonLink;
use crate::components::icon::Glyph;
use buslens::field::{Format, Name, Spec, hex_value};
use buslens::tool::reference::{About, Code, Doing, Item, Register};

/// The entry that is chosen, beside the table.
#[component]
pub fn Entry(item: Signal<Option<Arc<Item>>>) -> impl IntoView {
    let shown = move || match item.get() {
        Some(item) => entry(&item),
        None => view! { <p class="note">"Choose a row to see all about it."</p> }.into_any(),
    };
    view! {
        <section class="entry" aria-label="Entry">
            {move || shown()}
        </section>
    }
}

fn entry(item: &Item) -> AnyView {
    let what = match &item.about {
        About::Register(register) => of_register(item, register),
        About::Code(code) => of_code(item, code),
        About::Telegram(_) => ().into_any(),
    };
    let drafts = item.drafts().into_iter().map(|(doing, link)| {
        let words = match doing {
            Doing::Read => "Read it in Build",
            Doing::Write => "Write it in Build",
            Doing::Build => "Open in Build",
        };
        let class = if doing == Doing::Write { "button" } else { "button main" };
        view! { <ButtonLink class glyph=Glyph::Build label=words to=href(View::Build, &link) /> }
    });
    view! {
        <h3>{item.label.clone()}</h3>
        <p class="note">{item.book.label()}</p>
        <div class="actions">{drafts.collect_view()}</div>
        {what}
    }
    .into_any()
}

fn pair(name: &'static str, value: String) -> Option<AnyView> {
    (!value.is_empty()).then(|| {
        view! {
            <dt>{name}</dt>
            <dd>{value}</dd>
        }
        .into_any()
    })
}

fn of_register(item: &Item, register: &Register) -> AnyView {
    let spec = register.spec;
    let addressed = if register.subindex.is_some() { "Index" } else { "Address" };
    let subindex = register.subindex.map_or(String::new(), |subindex| subindex.to_string());
    let mut facts = vec![
        pair("Short name", register.id.to_owned()),
        pair(addressed, item.number.clone()),
        pair("Subindex", subindex),
    ];
    facts.extend(register.other_numbers().into_iter().map(|(name, number)| pair(name, number)));
    facts.extend([
        pair("Holds", register.kind.clone()),
        pair("Unit", register.unit().to_owned()),
        pair("Allowed", register.limits()),
        pair("A client may", register.allowed().to_owned()),
        pair(
            "Software",
            if register.since.is_empty() { String::new() } else { format!("from {} on", register.since) },
        ),
    ]);
    let parts = register.parts();
    let parts = (!parts.is_empty()).then(|| {
        let row = |part: buslens::tool::reference::Held| {
            view! {
                <tr>
                    <td class="mono">{part.number}</td>
                    <th scope="row">{part.spec.label}</th>
                    <td>{part.kind}</td>
                </tr>
            }
        };
        let meanings: Vec<AnyView> = parts.iter().map(|part| values(part.spec)).collect();
        view! {
            <h4>"Register by register"</h4>
            <table class="table">
                <tbody>{parts.into_iter().map(row).collect_view()}</tbody>
            </table>
            {meanings}
        }
    });
    view! {
        <dl class="pairs">{facts.into_iter().flatten().collect_view()}</dl>
        <p>{spec.note}</p>
        {parts}
        {values(spec)}
        {source(spec.source)}
    }
    .into_any()
}

fn of_code(item: &Item, code: &Code) -> AnyView {
    view! {
        <dl class="pairs">
            {pair("Value", item.number.clone())}
            {pair("Of", code.of.clone())}
        </dl>
        <p>{code.note}</p>
        {source(code.source)}
    }
    .into_any()
}

pub fn source(source: &'static str) -> Option<AnyView> {
    (!source.is_empty())
        .then(|| view! { <p class="note">"Source: " <cite>{source} "."</cite></p> }.into_any())
}

/// A value as the manual writes it.
fn value_text(spec: &'static Spec, value: u64) -> String {
    match spec.format {
        Format::Hex => hex_value(value, if value > 0xFF { 2 } else { 1 }).to_string(),
        _ => value.to_string(),
    }
}

/// What single values and bits of a number mean.
pub fn values(spec: &'static Spec) -> AnyView {
    let named = spec.names.iter().filter(|name| !name.label.is_empty()).collect::<Vec<_>>();
    let names = (!named.is_empty()).then(|| {
        let row =
            |name: &&Name| meaning(value_text(spec, name.value), name.label.to_owned(), name.note, None);
        meanings(format!("Values of {}", spec.label), named.iter().map(row).collect())
    });
    let bits = (!spec.bits.is_empty()).then(|| view! { <BitDiagram spec /> });
    view! {
        {names}
        {bits}
    }
    .into_any()
}
