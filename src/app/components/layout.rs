//! How telegrams of this kind are laid out, for those who want to know how one is made.

use std::sync::Arc;

use leptos::prelude::*;

use super::strip::role_class;
use crate::app::state::Shown;
use crate::tool::{Row, Size};

#[component]
pub fn Layout(shown: Arc<Shown>) -> impl IntoView {
    let detail = &shown.detail;
    let boxes: Vec<_> = detail.layout.iter().filter(|row| row.size != Size::Group).map(byte_box).collect();
    let rows: Vec<_> = detail.layout.iter().map(explained).collect();
    view! {
        <details class="layout">
            <summary>"How such a telegram is made"</summary>
            <p>{detail.note}</p>
            <div class="boxes" aria-hidden="true">{boxes}</div>
            <dl>{rows}</dl>
            {(!detail.source.is_empty()).then(|| view! { <p class="source">"Source: "{detail.source}"."</p> })}
        </details>
    }
}

fn size(row: &Row) -> String {
    match row.size {
        Size::Fixed(1) => "1 byte".to_owned(),
        Size::Fixed(n) => format!("{n} bytes"),
        Size::Each(n) => format!("{n} bytes each"),
        Size::Rest => "all bytes up to the check".to_owned(),
        Size::Group => String::new(),
    }
}

fn byte_box(row: &Row) -> impl IntoView + use<> {
    let width = match row.size {
        Size::Fixed(n) | Size::Each(n) => n,
        Size::Rest | Size::Group => 2,
    };
    let number = match row.size {
        Size::Fixed(n) => n.to_string(),
        Size::Each(n) => format!("{n} × n"),
        Size::Rest | Size::Group => "n".to_owned(),
    };
    view! {
        <div class=format!("box {}", role_class(row.spec.role)) style:flex-grow=width.to_string()>
            <b>{row.spec.short}</b>
            <small>{number}</small>
        </div>
    }
}

fn explained(row: &Row) -> impl IntoView + use<> {
    let spec = row.spec;
    let place = match (row.size, row.offset) {
        (Size::Group, _) | (_, None) => String::new(),
        (_, Some(offset)) => format!(", from byte {offset}"),
    };
    let limits = spec.limits.map(|(from, to)| format!(" Allowed: {from} to {to}."));
    let chosen = row.chosen.map(|(value, chosen)| format!(" Here {value} ({value:02X}h): {}.", chosen.label));
    let names: Vec<String> =
        spec.names.iter().map(|name| format!("{}: {}", name.value, name.label)).collect();
    let names = (!names.is_empty()).then(|| format!(" Values: {}.", names.join("; ")));
    (row.size != Size::Group).then(|| {
        view! {
            <dt>{spec.label}<small>{format!("{}{place}", size(row))}</small></dt>
            <dd>{spec.note}{limits}{chosen}{names}</dd>
        }
    })
}
