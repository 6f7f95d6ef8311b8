//! The fields of a telegram as a table, groups to be opened and closed.

use std::collections::HashSet;
use std::sync::Arc;

use leptos::ev::KeyboardEvent;
use leptos::html;
use leptos::prelude::*;

use super::byte_strip::{Chosen, Lights, is_faulty, role_class};
use super::kept::{Kept, kept};
use super::roving;
use buslens::field::{Bits, Field, Message, Role, Span, Value, hex};
use buslens::tool::{self, Detail};

/// A row of the table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    place: Place,
    faulty: bool,
    span: Span,
    bytes: String,
    value: String,
    meaning: String,
}

/// What a row is told apart by while a telegram is edited: all but what its bytes say.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct Place {
    /// In the tree: `2.0.1`.
    id: String,
    depth: usize,
    label: String,
    class: &'static str,
    note: &'static str,
    /// Whether it is open at first, where there is something to open.
    opens: Option<bool>,
}

/// The table. Rows that follow from the same telegram keep their place while it is edited.
#[component]
pub fn FieldTable(
    #[prop(into)] rows: Signal<Vec<Arc<Row>>>,
    lights: Lights,
    /// What table this is, for screen readers.
    #[prop(into)]
    label: String,
) -> impl IntoView {
    let body = NodeRef::<html::Tbody>::new();
    // Groups that a person opened, or closed.
    let turned = RwSignal::new(HashSet::<String>::new());
    let is_open =
        move |place: &Place| place.opens.map(|open| open != turned.with(|turned| turned.contains(&place.id)));
    let shown = Memo::new(move |_| rows.with(|rows| visible(rows, is_open)));
    let widest = Memo::new(move |_| shown.with(|rows| widest(rows)));
    let stop = RwSignal::new(0_usize);
    // The row that Tab leads to.
    let stop_now = Memo::new(move |_| {
        shown.with(|rows| {
            rows.get(stop.get().min(rows.len().saturating_sub(1))).map(|row| row.place.id.clone())
        })
    });
    let is_stop = Selector::new(move || stop_now.get());
    let turn = move |id: String| {
        turned.update(|turned| {
            if !turned.remove(&id) {
                turned.insert(id);
            }
        });
    };
    let choose = move |span: Span| {
        let at = span.from;
        lights.chosen.set((!span.is_empty()).then_some(Chosen { span, at }));
    };
    let keys = move |event: KeyboardEvent| {
        let at = stop.get_untracked();
        let row = shown.with_untracked(|rows| rows.get(at).cloned());
        let key = event.key();
        match (key.as_str(), row) {
            ("Escape", _) if lights.chosen.get_untracked().is_some() => {
                event.stop_propagation();
                lights.chosen.set(None);
            }
            ("ArrowLeft" | "ArrowRight", Some(row)) => {
                event.prevent_default();
                if is_open(&row.place).is_some_and(|open| open == (key == "ArrowLeft")) {
                    turn(row.place.id.clone());
                }
            }
            _ => {
                let to = body.get_untracked().and_then(|body| roving::follow(&event, &body, "button"));
                if let Some(to) = to {
                    stop.set(to);
                    if let Some(span) = shown.with_untracked(|rows| rows.get(to).map(|row| row.span)) {
                        choose(span);
                    }
                }
            }
        }
    };
    let row = move |Kept { key: place, item }: Kept<Place, Arc<Row>>| {
        let row = RwSignal::from(item);
        let class = move || {
            let row = row.read();
            let is_own = |lit: Option<Span>| !row.span.is_empty() && lit == Some(row.span);
            let mut class = row.place.class.to_owned();
            for (holds, name) in [
                (row.place.opens == Some(true), " group"),
                (row.faulty, " faulty"),
                (is_own(lights.pointed()), " pointed"),
                (is_own(lights.chosen().map(|chosen| chosen.span)), " chosen"),
            ] {
                class += if holds { name } else { "" };
            }
            class
        };
        let expanded = place.opens.is_some().then(|| {
            let place = place.clone();
            move || is_open(&place).map(|open| open.to_string())
        });
        let (is_stop, this) = (is_stop.clone(), Some(place.id.clone()));
        let (id, opens) = (place.id, place.opens.is_some());
        let click = move |_| {
            let at = shown.with_untracked(|rows| rows.iter().position(|row| row.place.id == id));
            stop.set(at.unwrap_or_default());
            choose(row.read_untracked().span);
            if opens {
                turn(id.clone());
            }
        };
        view! {
            <tr
                role="row"
                class=class
                style:--depth=place.depth.to_string()
                on:pointerenter=move |_| lights.pointed.set(Some(row.read_untracked().span))
            >
                <th role="rowheader" scope="row">
                    <button
                        type="button"
                        tabindex=move || if is_stop.selected(&this) { "0" } else { "-1" }
                        aria-expanded=expanded
                        // Who goes from field to field by keys hears what it holds, too.
                        aria-description=move || row.read().held()
                        title=place.note
                        on:click=click
                    >
                        {place.label}
                    </button>
                </th>
                <td role="cell" class="bytes">{move || row.read().bytes.clone()}</td>
                <td role="cell" class="value">{move || row.read().value.clone()}</td>
                <td role="cell" class="meaning">{move || row.read().meaning.clone()}</td>
            </tr>
        }
    };
    view! {
        // The roles say again what the elements are, since a phone shows the rows as blocks.
        <table
            class="table fields"
            role="table"
            aria-label=label
            style:--bytes=move || widest.get().to_string()
            on:keydown=keys
            on:pointerleave=move |_| lights.pointed.set(None)
        >
            <thead role="rowgroup">
                <tr role="row">
                    <th role="columnheader" scope="col">"Field"</th>
                    <th role="columnheader" scope="col">"Bytes"</th>
                    <th role="columnheader" scope="col">"Value"</th>
                    <th role="columnheader" scope="col">"Meaning"</th>
                </tr>
            </thead>
            <tbody role="rowgroup" node_ref=body>
                <For each=kept(move || shown.get(), |row| row.place.clone()) key=|kept| kept.key.clone() children=row />
            </tbody>
        </table>
    }
}

impl Row {
    /// Value and meaning in one.
    fn held(&self) -> String {
        let said = [self.value.as_str(), self.meaning.as_str()];
        said.into_iter().filter(|said| !said.is_empty()).collect::<Vec<_>>().join(", ")
    }

    /// The same at another place of the tree.
    fn at(mut self, id: String, depth: usize) -> Self {
        (self.place.id, self.place.depth) = (id, depth);
        self
    }
}

/// The rows that are in no closed group.
fn visible(rows: &[Arc<Row>], is_open: impl Fn(&Place) -> Option<bool>) -> Vec<Arc<Row>> {
    let mut shown = Vec::new();
    let mut closed_at = usize::MAX;
    for row in rows {
        if row.place.depth > closed_at {
            continue;
        }
        closed_at = if is_open(&row.place) == Some(false) { row.place.depth } else { usize::MAX };
        shown.push(row.clone());
    }
    shown
}

/// How many letters the column of bytes is wide. Those of a group may go on over what it leaves empty.
fn widest(rows: &[Arc<Row>]) -> usize {
    let held = rows.iter().filter(|row| !row.held().is_empty());
    held.map(|row| row.bytes.chars().count()).max().unwrap_or_default().max("Bytes".len())
}

/// The rows of a telegram: its fields, and what the device's manual says in the place of bare registers.
pub fn rows(detail: &Detail, bytes: &[u8]) -> Vec<Arc<Row>> {
    let mut rows = Rows { rows: Vec::new(), blocks: &detail.device.blocks, bytes };
    for (index, field) in detail.fields.iter().enumerate() {
        rows.add(field, &index.to_string(), 0);
    }
    // What is only asked for has no bytes of its own: it stands behind the address that names it.
    let asked: Vec<_> = rows.blocks.iter().filter(|block| !has_values(block)).collect();
    for (index, block) in asked.into_iter().enumerate().rev() {
        let row = rows.of_block(block).at(format!("d{index}"), 0);
        let address = rows.rows.iter().position(|other| other.span == row.span);
        rows.rows.insert(address.map_or(0, |at| at + 1), row);
    }
    rows.rows.into_iter().map(Arc::new).collect()
}

fn has_values(block: &tool::Block) -> bool {
    block.field.value != Value::Group || !block.field.children.is_empty()
}

struct Rows<'a> {
    rows: Vec<Row>,
    blocks: &'a [tool::Block],
    bytes: &'a [u8],
}

impl<'a> Rows<'a> {
    /// The block of the device's manual that these bytes belong to.
    fn block(&self, span: Span) -> Option<&'a tool::Block> {
        let holds = |block: &&tool::Block| {
            let own = block.field.span;
            has_values(block) && own.from <= span.from && span.to <= own.to && !span.is_empty()
        };
        self.blocks.iter().find(holds)
    }

    fn add(&mut self, field: &Field, id: &str, depth: usize) {
        if field.spec.role != Role::Address
            && let Some(block) = self.block(field.span)
        {
            // It stands where its first byte is.
            if block.field.span.from == field.span.from {
                let row = self.of_block(block).at(id.to_owned(), depth);
                self.rows.push(row);
                self.within(&block.field, id, depth);
            }
            return;
        }
        // A group that only says that registers follow is in the way of what they mean.
        let only_frame = field.children.iter().any(|child| self.block(child.span).is_some());
        if only_frame {
            for (index, child) in field.children.iter().enumerate() {
                self.add(child, &format!("{id}.{index}"), depth);
            }
            return;
        }
        let row = self.of_field(field).at(id.to_owned(), depth);
        self.rows.push(row);
        self.within(field, id, depth);
    }

    /// What is within a field: its bits, its children.
    fn within(&mut self, field: &Field, id: &str, depth: usize) {
        for (index, (part, value)) in field.parts().enumerate() {
            if !part.reserved || value != 0 {
                self.rows.push(of_part(part, value, field, format!("{id}#{index}"), depth + 1));
            }
        }
        for (index, child) in field.children.iter().enumerate() {
            let id = format!("{id}.{index}");
            self.rows.push(self.of_field(child).at(id.clone(), depth + 1));
            self.within(child, &id, depth + 1);
        }
    }

    fn of_field(&self, field: &Field) -> Row {
        /// More bytes do not fit into the column; the strip shows them.
        const SHOWN: usize = 8;
        let run = field.span.of(self.bytes);
        let more = if run.len() > SHOWN { " …" } else { "" };
        // The meaning tells what is set: the bits are for those who want to know more.
        let has_parts = field.parts().next().is_some();
        Row {
            place: Place {
                id: String::new(),
                depth: 0,
                label: field.label().sentence(),
                class: role_class(field.spec.role),
                note: field.spec.note,
                opens: (has_parts || !field.children.is_empty()).then_some(!has_parts),
            },
            faulty: is_faulty(field),
            span: field.span,
            bytes: hex(&run[..run.len().min(SHOWN)]) + more,
            value: field.value_text(),
            meaning: field.meaning().map_or(String::new(), |meaning| meaning.to_string()),
        }
    }

    fn of_block(&self, block: &tool::Block) -> Row {
        let row = self.of_field(&block.field);
        let value = if row.value.is_empty() {
            block.value().map_or(String::new(), |value| value.to_string())
        } else {
            row.value.clone()
        };
        let said = [block.status().map(|status| status.to_string()), Some(row.meaning.clone())];
        let about = [Some(places(block)), block.note.as_ref().map(Message::to_string)];
        let mut parts: Vec<String> = said.into_iter().flatten().filter(|part| !part.is_empty()).collect();
        parts.dedup();
        parts.retain(|part| *part != value);
        parts.extend(about.into_iter().flatten());
        let place = Place { label: block.label().sentence(), ..row.place };
        Row { place, value, meaning: parts.join(" · "), ..row }
    }
}

fn places(block: &tool::Block) -> String {
    let noun = if block.from == block.to { "register" } else { "registers" };
    format!("{noun} {}", block.registers())
}

/// Some bits of a field.
fn of_part(part: &'static Bits, value: u64, field: &Field, id: String, depth: usize) -> Row {
    let last = part.from + part.count - 1;
    let meaning = match part.name(value) {
        Some(name) => name.label,
        None if part.count == 1 && value == 1 => "set",
        None if part.count == 1 => "not set",
        None => "",
    };
    Row {
        place: Place {
            id,
            depth,
            label: Message::term(part.label).sentence(),
            class: role_class(field.spec.role),
            note: part.note,
            opens: None,
        },
        faulty: false,
        span: field.span,
        bytes: if part.count == 1 {
            format!("bit {}", part.from)
        } else {
            format!("bits {last} to {}", part.from)
        },
        value: value.to_string(),
        meaning: meaning.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use buslens::tool::{Options, Profile, decode};

    const PAIR: &str = "01 03 00 C8 00 03 84 35\n01 03 06 00 80 42 A4 F1 DE B0 F8";

    #[test]
    fn blocks_of_the_device_stand_for_registers() {
        let device = Profile::of("memograph-rsg45");
        let report = decode(PAIR, Options { device, ..Options::default() });
        let bytes = &report.telegrams[1].line.bytes;
        let rows = rows(&report.detail(1).unwrap(), bytes);
        let all: Vec<String> = rows
            .iter()
            .map(|row| format!("{}{} = {}", " ".repeat(row.place.depth), row.place.label, row.value))
            .collect();
        assert!(all.contains(&"Universal channel 1 = 82.4724".to_owned()), "{all:?}");
        assert!(!all.iter().any(|row| row.contains("Register 200")), "{all:?}");
        let ids: HashSet<&String> = rows.iter().map(|row| &row.place.id).collect();
        assert_eq!(ids.len(), rows.len(), "each row has a place of its own");
        let closed = visible(&rows, |place| place.opens.map(|_| false));
        assert!(closed.len() < rows.len() && closed.iter().all(|row| row.place.depth == 0), "{closed:?}");
    }
}
