//! How telegrams of a kind are laid out, for those who want to know how one is made.

use leptos::prelude::*;

use super::byte_strip::role_class;
use buslens::field::{Message, Name};
use buslens::tool::{Row, Size};

#[component]
pub fn Structure(
    /// What the kind is about, and where it is described.
    note: &'static str,
    source: &'static str,
    layout: Vec<Row>,
) -> impl IntoView {
    let rows: Vec<Row> = layout.into_iter().filter(|row| !row.size.is_around()).collect();
    let boxes: Vec<_> = rows
        .iter()
        .map(|row| {
            view! {
                <li class=role_class(row.spec.role)>
                    <b>{row.spec.short}</b>
                    <small>{number(row)}</small>
                </li>
            }
        })
        .collect();
    let explained: Vec<_> = rows.into_iter().map(|row| view! { <Explained row /> }).collect();
    view! {
        <p class="note">{note}</p>
        <ol class="boxes" aria-hidden="true">{boxes}</ol>
        <dl class="explained">{explained}</dl>
        {(!source.is_empty()).then(|| view! { <p class="note">"Source: " <cite>{source} "."</cite></p> })}
    }
}

/// How many bytes, in a word.
fn number(row: &Row) -> String {
    match row.size {
        Size::Fixed(n) => n.to_string(),
        Size::Each(n) => format!("{n} × n"),
        Size::Rest | Size::Group | Size::List => "n".to_owned(),
    }
}

#[component]
fn Explained(row: Row) -> impl IntoView {
    let spec = row.spec;
    let size = match row.size {
        Size::Fixed(n) => Message::bytes(n).to_string(),
        Size::Each(n) => format!("{} each", Message::bytes(n)),
        Size::Rest | Size::Group | Size::List => "all bytes up to the checksum".to_owned(),
    };
    let offset = row.offset.map_or(String::new(), |offset| format!(", from byte {offset}"));
    let limits = spec.limits.map(|(from, to)| format!(" Allowed: {from} to {to}."));
    let chosen = row.chosen.map(|(value, chosen)| format!(" Here {value}: {}.", chosen.label));
    let name = |name: &Name| {
        view! {
            <dt>{name.value}</dt>
            <dd>{name.label} ". " {name.note}</dd>
        }
    };
    let names: Vec<_> = spec.names.iter().map(name).collect();
    view! {
        <dt>{spec.label} " " <small class="soft">{size} {offset}</small></dt>
        <dd>
            {spec.note} {limits} {chosen}
            {(!names.is_empty()).then(|| view! { <dl class="names">{names}</dl> })}
        </dd>
    }
}
