//! A function, a service or a frame: its telegrams byte by byte, with an example. One sheet when it is printed.

use std::sync::Arc;

use leptos::prelude::*;

use super::diagram::{BitDiagram, Diagram, named};
use super::entry::source;
use super::{ITEMS, Place, place_of};
use crate::address::{View, href};
use crate::components::button::{Button, ButtonLink};
use crate::components::byte_strip::{ByteStrip, Lights, blocks};
use crate::components::icon::Glyph;
use crate::components::segments::Segments;
use crate::components::telegram::Shown;
use crate::views::learn::gallery::SAMPLES;
use buslens::field::{Direction, Message, Name, Spec};
use buslens::tool::gallery::{Said, Sample};
use buslens::tool::reference::{About, Item, Layout, Topic};
use buslens::tool::{Protocol, Row, Size, decode};

#[component]
pub fn TopicPage(item: Arc<Item>) -> impl IntoView {
    let About::Telegram(topic) = item.about.clone() else { return ().into_any() };
    let carriers = topic.carriers();
    let carrier = RwSignal::new(0_usize);
    let names =
        carriers.iter().enumerate().map(|(at, it)| (at, carrier_name(it).to_owned())).collect::<Vec<_>>();
    let several = names.len() > 1;
    let value = Signal::derive(move || carrier.get());
    let choose = Callback::new(move |at| carrier.set(at));
    let neighbours = neighbours(&item);
    let (label, code, note, said_by) = (item.label.clone(), topic.code.clone(), topic.note, topic.source);
    // Its telegrams say it themselves.
    let repeated = topic.layouts(carriers[0]).iter().any(|layout| layout.note == note);
    let draft = topic.draft().map(|link| {
        view! { <ButtonLink glyph=Glyph::Build label="Open in Build" to=href(View::Build, &link) /> }
    });
    // A browser that cannot print does nothing.
    let print = |()| drop(window().print());
    let all = Place::in_chapter(item.book, item.chapter);
    let back = format!("All telegrams of {}", item.book.label());
    let layouts = {
        let item = item.clone();
        move || {
            let carrier = carriers[carrier.get().min(carriers.len() - 1)];
            let (usual, others): (Vec<Layout>, Vec<Layout>) =
                topic.layouts(carrier).into_iter().partition(|layout| !layout.title.contains("where set so"));
            // What bits say is told once.
            let mut told: Vec<&'static Spec> = Vec::new();
            let mut telegram = |layout: Layout| {
                let example = example(&item, &topic, &layout, carrier);
                let mut bits: Vec<&'static Spec> = layout.rows.iter().map(|row| row.spec).collect();
                bits.retain(|spec| {
                    !spec.bits.is_empty() && !told.iter().any(|other| std::ptr::eq(*other, *spec))
                });
                told.extend(&bits);
                view! { <Telegram layout bits example /> }
            };
            let usual = usual.into_iter().map(&mut telegram).collect_view();
            let others = (!others.is_empty()).then(|| {
                view! {
                    <details class="other-layouts">
                        <summary>"Other layouts that a device can be set to under Devices"</summary>
                        {others.into_iter().map(&mut telegram).collect_view()}
                    </details>
                }
            });
            view! {
                {usual}
                {others}
            }
        }
    };
    view! {
        <article class="topic">
            <nav class="steps" aria-label="Other telegrams">
                <ButtonLink class="back" glyph=Glyph::Back label=back to=all.href() />
                {neighbours}
            </nav>
            <header>
                <div>
                    <h3>{label}</h3>
                    <p class="note">{[item.book.label(), &code].iter().filter(|it| !it.is_empty()).copied().collect::<Vec<_>>().join(", ")}</p>
                </div>
                <div class="actions">
                    {several
                        .then(|| view! { <Segments label="Carried by" options=names value on_choose=choose class="low" /> })}
                    {draft}
                    <Button glyph=Glyph::Print label="Print" on_press=print />
                </div>
            </header>
            {(!repeated).then(|| view! { <p>{note}</p> })}
            {move || layouts()}
            <footer>{source(said_by)}</footer>
        </article>
    }
    .into_any()
}

/// What carries it, in a word.
fn carrier_name(protocol: &Protocol) -> &'static str {
    protocol.label.strip_prefix("Modbus ").unwrap_or(protocol.label)
}

/// The telegrams before and behind it.
fn neighbours(item: &Arc<Item>) -> Vec<AnyView> {
    let of = |other: &&Arc<Item>| (other.book, other.chapter) == (item.book, item.chapter);
    let all: Vec<&Arc<Item>> = ITEMS.iter().filter(of).collect();
    let Some(at) = all.iter().position(|other| other.key == item.key) else { return Vec::new() };
    let link = |at: usize, glyph: Glyph| {
        let other = all.get(at)?;
        let label = format!("{} {}", other.number, other.label);
        Some(view! { <ButtonLink class="beside" glyph label to=place_of(other, "").href() /> }.into_any())
    };
    let before = at.checked_sub(1).and_then(|before| link(before, Glyph::Back));
    before.into_iter().chain(link(at + 1, Glyph::ChevronRight)).collect()
}

/// A telegram of the gallery that is laid out so.
fn example(
    item: &Item,
    topic: &Topic,
    layout: &Layout,
    carrier: &Protocol,
) -> Option<(&'static Sample, &'static Said)> {
    if layout.title.contains(',') && topic.function().is_some() {
        return None;
    }
    let fits = |(_, said): &&(Sample, Said)| {
        let same = match topic.function() {
            Some(function) if function >= 0x80 => said.is_exception,
            Some(0) => said.kind.contains("not known"),
            Some(function) => said.function == Some(function) && !said.is_exception,
            None => {
                said.kind == item.label
                    || said.kind.starts_with(&item.number)
                    || said.protocol.label == item.label
            }
        };
        same && layout.fits(&said.bytes)
            && !said.sentence.contains("still")
            && said.direction == layout.direction
            && said.protocol.key == carrier.key
            && !said.is_faulty
    };
    SAMPLES.iter().find(fits).map(|(sample, said)| (sample, said))
}

/// A telegram: its bytes as a diagram, its fields as a table, an example.
#[component]
fn Telegram(
    layout: Layout,
    /// The numbers whose bits are told here.
    bits: Vec<&'static Spec>,
    example: Option<(&'static Sample, &'static Said)>,
) -> impl IntoView {
    let arrow = match layout.direction {
        Direction::Request => "→",
        Direction::Response => "←",
    };
    let note = (!layout.note.is_empty()).then(|| view! { <p class="note">{layout.note}</p> });
    let rows = layout.rows.clone();
    let drawn = match rows.is_empty() {
        true => view! { <p>"It has no data: the access points in its frame say all."</p> }.into_any(),
        false => view! {
            <Diagram rows=layout.rows />
            <Fields rows bits />
        }
        .into_any(),
    };
    view! {
        <section class="telegram">
            <h4>
                <span aria-hidden="true">{arrow}</span>
                {layout.title}
            </h4>
            {note}
            {drawn}
            {example.map(|(sample, said)| view! { <Example sample said /> })}
        </section>
    }
}

#[component]
fn Fields(rows: Vec<Row>, bits: Vec<&'static Spec>) -> impl IntoView {
    let row = |row: Row| {
        let spec = row.spec;
        let (length, each) = match row.size {
            Size::Fixed(width) => (Message::bytes(width).to_string(), width),
            Size::Each(width) => (format!("{} each", Message::bytes(width)), width),
            Size::Rest => ("all that follow".to_owned(), 0),
            Size::Group | Size::List => (String::new(), 0),
        };
        let place = match row.offset {
            _ if row.size.is_around() => String::new(),
            None => "then".to_owned(),
            Some(offset) if each > 1 => format!("{offset} to {}", offset + each - 1),
            Some(offset) => offset.to_string(),
        };
        let allowed = spec
            .limits
            .map(|(from, to)| if from == to { from.to_string() } else { format!("{from} to {to}") });
        let here = row.chosen.filter(|_| !row.size.is_around()).map(|(value, chosen)| {
            if chosen.label.is_empty() { String::new() } else { format!(" Here {value}: {}.", chosen.label) }
        });
        let all: Vec<&Name> = spec.names.iter().filter(|name| !name.label.is_empty()).collect();
        let names = (!all.is_empty()).then(|| {
            let names: Vec<_> = all.iter().map(|name| named(name.value.to_string(), name.label)).collect();
            view! { <ul class="named">{names}</ul> }
        });
        let around = row.size.is_around();
        view! {
            <tr class=crate::components::byte_strip::role_class(spec.role) class:around=around style:--depth=row.depth.to_string()>
                <td class="mono">{place}</td>
                <th scope="row">{spec.label}</th>
                <td>{length}</td>
                <td class="number">{allowed}</td>
                <td>
                    {spec.note}
                    {here}
                    {names}
                </td>
            </tr>
        }
    };
    let bits = bits.into_iter().map(|spec| view! { <BitDiagram spec /> }).collect_view();
    view! {
        <table class="table layout">
            <thead>
                <tr>
                    <th scope="col">"Byte"</th>
                    <th scope="col">"Field"</th>
                    <th scope="col">"Length"</th>
                    <th scope="col">"Allowed"</th>
                    <th scope="col">"What it says"</th>
                </tr>
            </thead>
            <tbody>{rows.into_iter().map(row).collect_view()}</tbody>
        </table>
        {bits}
    }
}

#[component]
fn Example(sample: &'static Sample, said: &'static Said) -> impl IntoView {
    let link = sample.link();
    let report = Arc::new(decode(&link.text, link.options.clone()));
    let strip = Shown::of(&report, link.telegram, &link.options).map(|shown| {
        let blocks = blocks(&shown.detail, shown.bytes());
        let label = format!("Example: {}", said.sentence);
        view! { <ByteStrip blocks=Signal::stored(blocks) lights=Lights::new() size="small" label /> }
    });
    view! {
        <div class="example">
            <p>
                <b>"For example: "</b>
                {said.sentence.as_str()}
                " "
                <a href=href(View::Read, &link)>"Open in Read"</a>
            </p>
            {strip}
        </div>
    }
}
