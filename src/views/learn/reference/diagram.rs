//! Telegrams and words drawn byte by byte and bit by bit.

use leptos::prelude::*;

use crate::components::byte_strip::role_class;
use buslens::field::{Format, Message, Order, Role, Spec, hex, in_order, number_text};
use buslens::tool::{Row, Size};

/// A field, or a group or list of them.
enum Node<'a> {
    Field(&'a Row),
    Around(&'a Row, Vec<Node<'a>>),
}

/// The rows as a tree; the rest of a group are the rows that lie deeper.
fn nodes<'a>(rows: &mut std::iter::Peekable<std::slice::Iter<'a, Row>>, depth: usize) -> Vec<Node<'a>> {
    let mut found = Vec::new();
    while let Some(row) = rows.next_if(|row| row.depth >= depth) {
        found.push(match row.size.is_around() {
            true => Node::Around(row, nodes(rows, depth + 1)),
            false => Node::Field(row),
        });
    }
    found
}

/// A telegram as boxes: a cell for each byte, what it is above, and how long below. What is in it is said in the
/// table of its fields.
#[component]
pub fn Diagram(rows: Vec<Row>) -> impl IntoView {
    let mut all = rows.iter().peekable();
    let drawn: Vec<AnyView> = nodes(&mut all, 0).iter().map(draw).collect();
    view! {
        <ol class="diagram" aria-hidden="true">
            {drawn}
        </ol>
    }
}

fn draw(node: &Node<'_>) -> AnyView {
    match node {
        Node::Field(row) => field(row),
        Node::Around(row, within) => {
            let is_list = row.size == Size::List;
            let drawn: Vec<AnyView> = within.iter().map(draw).collect();
            view! {
                <li class="around" class:repeated=is_list>
                    <span class="label">{row.spec.short}</span>
                    <ol>{drawn}</ol>
                    {is_list.then_some(view! { <span class="times">"× n"</span> })}
                </li>
            }
            .into_any()
        }
    }
}

/// More cells than that are not counted by anybody.
const MOST: usize = 8;

fn field(row: &Row) -> AnyView {
    let spec = row.spec;
    let (cells, caption) = match row.size {
        Size::Fixed(width) | Size::Each(width) => (width, Message::bytes(width).to_string()),
        _ => (0, "n bytes".to_owned()),
    };
    let marks = marks(row, cells);
    let cell = |(index, mark): (usize, String)| {
        let number = row.offset.map(|offset| (offset + index).to_string());
        view! {
            <i>
                <b>{mark}</b>
                <small>{number}</small>
            </i>
        }
    };
    let cells = match cells {
        0 => view! { <i class="rest"><b>"…"</b><small></small></i> }.into_any(),
        _ => marks.into_iter().enumerate().map(cell).collect_view().into_any(),
    };
    view! {
        <li class=role_class(spec.role)>
            <span class="label">{spec.short}</span>
            <span class="cells">{cells}</span>
            <span class="caption">{caption}</span>
        </li>
    }
    .into_any()
}

/// What stands in the cells: the bytes where they are always the same, else which is the high one.
fn marks(row: &Row, cells: usize) -> Vec<String> {
    if let Some((value, chosen)) = row.chosen
        && row.spec.role == Role::Function
        && chosen.label != row.spec.label
    {
        let bytes = row.spec.order.bytes(value, cells.min(8));
        return bytes.iter().map(|byte| hex(&[*byte])).collect();
    }
    let low_first = matches!(row.spec.order, Order::Little) || row.spec.role == Role::Check && cells == 2;
    match (cells, low_first) {
        (2, false) => vec!["high".to_owned(), "low".to_owned()],
        (2, true) => vec!["low".to_owned(), "high".to_owned()],
        _ => vec![String::new(); cells.min(MOST)],
    }
}

/// A number bit by bit: what each says, the highest first.
#[component]
pub fn BitDiagram(spec: &'static Spec) -> impl IntoView {
    let highest = spec.bits.iter().map(|part| part.from + part.count).max().unwrap_or_default();
    let width = highest.div_ceil(8) * 8;
    let parts = in_order(spec.bits, |part| std::cmp::Reverse(part.from));
    let of_bit = |bit: u32| parts.iter().find(|part| (part.from..part.from + part.count).contains(&bit));
    let cells: Vec<AnyView> = (0..width)
        .rev()
        .map(|bit| {
            let part = of_bit(bit);
            let begins = part.is_some_and(|part| part.from + part.count - 1 == bit) || part.is_none();
            let reserved = part.is_none_or(|part| part.reserved);
            view! {
                <li class:begins=begins class:reserved=reserved>{bit}</li>
            }
            .into_any()
        })
        .collect();
    let row = |part: &&&buslens::field::Bits| {
        let (from, last) = (part.from, part.from + part.count - 1);
        let place = if from == last { format!("bit {from}") } else { format!("bits {last} to {from}") };
        let hex = part.count >= 8;
        let shown = move |value: u64| {
            number_text(
                value,
                (part.count as usize).div_ceil(8),
                if hex { Format::Hex } else { Format::Decimal },
            )
        };
        let mut names: Vec<AnyView> = Vec::new();
        for name in part.names.iter().filter(|name| !name.label.is_empty()) {
            names.push(named(shown(name.value), name.label));
        }
        for range in part.ranges {
            names.push(named(format!("{} to {}", shown(range.from), shown(range.to)), range.label));
        }
        let said = if part.reserved { "Must be 0." } else { part.note };
        let names = (!names.is_empty()).then(|| view! { <ul>{names}</ul> }.into_any());
        meaning(place, Message::term(part.label).sentence(), said, names)
    };
    let rows = parts.iter().map(|part| row(&part)).collect();
    view! {
        <ol class="bit-diagram" aria-hidden="true" style:--bits=width.min(16).to_string()>
            {cells}
        </ol>
        {meanings(format!("Bits of {}", spec.label), rows)}
    }
}

/// What values or bits mean, a row each.
pub fn meanings(caption: String, rows: Vec<AnyView>) -> AnyView {
    view! {
        <table class="table values-of">
            <caption>{caption}</caption>
            <tbody>{rows}</tbody>
        </table>
    }
    .into_any()
}

/// A row of those: what it is called, a note that may be empty, and what else there is.
pub fn meaning(value: String, label: String, note: &str, more: Option<AnyView>) -> AnyView {
    view! {
        <tr>
            <th scope="row" class="mono">{value}</th>
            <td>
                <b>{label}</b>
                {(!note.is_empty()).then(|| format!(". {note}"))}
                {more}
            </td>
        </tr>
    }
    .into_any()
}

/// A value in a list, and what it is called.
pub fn named(value: String, label: &'static str) -> AnyView {
    view! {
        <li>
            <span class="mono">{value}</span>
            " "
            {label}
        </li>
    }
    .into_any()
}
