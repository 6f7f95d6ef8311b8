//! The bytes of a telegram in a row, a block for each field.

use leptos::ev::KeyboardEvent;
use leptos::html;
use leptos::prelude::*;
use leptos::reactive::graph::Source;

use super::kept::{Kept, kept};
use super::roving;
use buslens::field::{Field, Numbering, Role, Severity, Span, Value, leaves};
use buslens::tool::{Detail, Entry};

/// Bytes that a person looks at, and which one of them is explained.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Chosen {
    pub span: Span,
    pub at: usize,
}

/// What is under the pointer and what is chosen: the strip and the table of fields light up together.
#[derive(Clone, Copy)]
pub struct Lights {
    pub pointed: RwSignal<Option<Span>>,
    pub chosen: RwSignal<Option<Chosen>>,
}

impl Lights {
    pub fn new() -> Self {
        Self { pointed: RwSignal::new(None), chosen: RwSignal::new(None) }
    }

    /// A signal keeps what listened to it and is gone (reactive_graph 0.2): here only what is still there comes back.
    fn forget(&self) {
        self.pointed.notify();
        self.pointed.clear_subscribers();
        self.chosen.notify();
        self.chosen.clear_subscribers();
    }

    /// Whoever looks is told only where something was lit.
    pub fn clear(&self) {
        if self.pointed.get_untracked().is_some() {
            self.pointed.set(None);
        }
        if self.chosen.get_untracked().is_some() {
            self.chosen.set(None);
        }
    }

    /// What the pointer is over. A view that is taken away loses its signals before what is drawn in it ends, and that
    /// may still be woken: it finds nothing lit.
    pub fn pointed(&self) -> Option<Span> {
        self.pointed.try_get().flatten()
    }

    /// What is chosen, as [`Self::pointed`].
    pub fn chosen(&self) -> Option<Chosen> {
        self.chosen.try_get().flatten()
    }

    /// Whether the pointer is over bytes of `span`.
    pub fn points_at(&self, span: Span) -> bool {
        self.pointed().is_some_and(|pointed| overlap(pointed, span))
    }

    /// Whether bytes of `span` are chosen.
    pub fn holds(&self, span: Span) -> bool {
        self.chosen().is_some_and(|chosen| overlap(chosen.span, span))
    }
}

const fn overlap(one: Span, other: Span) -> bool {
    one.from < other.to && other.from < one.to
}

/// A field with its bytes.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Block {
    /// The field's whole name, for screen readers.
    pub name: String,
    /// What stands above the bytes.
    pub label: String,
    /// What stands below them.
    pub caption: String,
    pub class: &'static str,
    pub faulty: bool,
    pub span: Span,
    pub bytes: Vec<u8>,
}

/// What a block is told apart by while a telegram is edited: all but what its bytes say.
type Place = (Span, usize, String, String, &'static str);

impl Block {
    fn place(&self) -> Place {
        (self.span, self.bytes.len(), self.name.clone(), self.label.clone(), self.class)
    }
}

/// After how many blocks made anew those that are gone are forgotten.
const LIGHTS_LAST: u32 = 4096;

/// More bytes than a telegram can have are not worth a cell each.
const MOST: usize = 300;

/// The strip. A field keeps its cells while its bytes are edited.
#[component]
pub fn ByteStrip(
    #[prop(into)] blocks: Signal<Vec<Block>>,
    lights: Lights,
    /// `large`, `small` or `tiny`; in between without.
    #[prop(into, optional)]
    size: String,
    #[prop(into, optional)] label: Option<String>,
) -> impl IntoView {
    let strip = NodeRef::<html::Ol>::new();
    let length = Memo::new(move |_| blocks.with(|all| all.last().map_or(0, |block| block.span.to)));
    // The byte that Tab leads to.
    let stop = RwSignal::new(0);
    let stop_now = Memo::new(move |_| stop.get().min(length.get().min(MOST).saturating_sub(1)));
    let is_stop = Selector::new(move || stop_now.get());
    let is_chosen = Selector::new(move || lights.chosen().map(|chosen| chosen.at));
    let choose = move |at: usize| {
        stop.set(at);
        let span = blocks
            .with_untracked(|all| all.iter().find(|block| block.span.contains(at)).map(|block| block.span));
        lights.chosen.set(span.map(|span| Chosen { span, at }));
    };
    let keys = move |event: KeyboardEvent| {
        if event.key() == "Escape" && lights.chosen.get_untracked().is_some() {
            event.stop_propagation();
            lights.chosen.set(None);
        } else if let Some(at) =
            strip.get_untracked().and_then(|strip| roving::follow(&event, &strip, "button"))
        {
            choose(at);
        }
    };
    let made = StoredValue::new(0_u32);
    let shown = move || {
        if made.get_value() > LIGHTS_LAST {
            made.set_value(0);
            lights.forget();
        }
        blocks.with(|all| all.iter().filter(|block| block.span.from < MOST).cloned().collect::<Vec<_>>())
    };
    let block = move |Kept { key, item }: Kept<Place, Block>| {
        made.update_value(|made| *made += 1);
        let (span, length, name, label, class) = key;
        let block = RwSignal::from(item);
        let class = move || {
            let block = block.read();
            let mut class = class.to_owned();
            for (holds, name) in [
                (block.faulty, " faulty"),
                (lights.points_at(span), " pointed"),
                (lights.holds(span), " chosen"),
            ] {
                class += if holds { name } else { "" };
            }
            class
        };
        let named = StoredValue::new(name);
        let cell = |at: usize| {
            let (is_stop, is_chosen) = (is_stop.clone(), is_chosen.clone());
            let byte = move || {
                let byte = block.read().bytes.get(at - span.from).copied();
                byte.map_or(String::new(), |byte| format!("{byte:02X}"))
            };
            view! {
                <button
                    type="button"
                    role="option"
                    tabindex=move || if is_stop.selected(&at) { "0" } else { "-1" }
                    aria-selected=move || is_chosen.selected(&Some(at)).to_string()
                    aria-label=move || format!("{}, {}, byte {at}", byte(), named.read_value())
                    on:click=move |_| choose(at)
                >
                    {byte}
                </button>
            }
        };
        let cells = (span.from..MOST).take(length).map(cell).collect_view();
        view! {
            <li
                role="presentation"
                class=class
                on:pointerenter=move |_| lights.pointed.set(Some(span))
            >
                <span class="label" aria-hidden="true">{label}</span>
                <span class="cells">{cells}</span>
                <span class="caption" aria-hidden="true">{move || block.read().caption.clone()}</span>
            </li>
        }
    };
    let more = move || {
        length.get().checked_sub(MOST).filter(|more| *more > 0).map(|more| {
            view! { <li role="presentation" class="rest">{format!("and {more} more bytes")}</li> }
        })
    };
    view! {
        // A list to choose from: a screen reader says of each byte which of how many it is.
        <ol
            role="listbox"
            aria-orientation="horizontal"
            node_ref=strip
            class=format!("byte-strip {size}")
            aria-label=label.unwrap_or_else(|| "Bytes".to_owned())
            on:keydown=keys
            on:pointerleave=move |_| lights.pointed.set(None)
        >
            <For each=kept(shown, Block::place) key=|kept| kept.key.clone() children=block />
            {more}
        </ol>
    }
}

/// The class that gives a role its colour.
pub const fn role_class(role: Role) -> &'static str {
    match role {
        Role::Unit | Role::Function | Role::Count => "role-head",
        Role::Address => "role-place",
        Role::Data => "role-data",
        Role::Status => "role-status",
        Role::Check => "role-check",
        Role::Unknown => "role-unknown",
    }
}

/// Whether the field has an error.
pub fn is_faulty(field: &Field) -> bool {
    field.problems.iter().any(|problem| problem.severity == Severity::Error)
}

/// The blocks of a telegram: its fields, those of the device's manual in the place of bare registers.
pub fn blocks(detail: &Detail, bytes: &[u8]) -> Vec<Block> {
    fields_by_byte(detail).into_iter().map(|leaf| block(leaf, bytes)).collect()
}

fn block(leaf: &Field, bytes: &[u8]) -> Block {
    let name = leaf.label().to_string();
    let label = match leaf.number {
        None => leaf.spec.short.to_owned(),
        Some(Numbering::At(_)) => name.rsplit(' ').next().unwrap_or_default().to_owned(),
        Some(Numbering::Offset(n)) => format!("+{n}"),
    };
    Block {
        name,
        label,
        caption: caption(leaf),
        class: role_class(leaf.spec.role),
        faulty: is_faulty(leaf),
        span: leaf.span,
        bytes: leaf.span.of(bytes).to_vec(),
    }
}

/// The value in a few letters.
fn caption(leaf: &Field) -> String {
    match &leaf.value {
        Value::Check(check) if check.ok() => "valid".to_owned(),
        Value::Check(check) => format!("not {}", check.computed_bytes()),
        Value::Number { raw, .. } => match leaf.spec.name(*raw) {
            Some(name) => name.label.to_owned(),
            None if !leaf.spec.bits.is_empty() => leaf.meaning().map_or(String::new(), |it| it.to_string()),
            None => leaf.value_text(),
        },
        // "read" of "Read holding registers": the field table has all of it.
        Value::Selector { chosen, .. } => {
            chosen.label.split(' ').next().unwrap_or_default().to_ascii_lowercase()
        }
        Value::Missing { .. } => "cut off".to_owned(),
        Value::Group | Value::Bytes => String::new(),
        Value::Text(_) => leaf.value_text(),
    }
}

/// Where the bytes of a form's entry stand in the telegram.
pub fn span_of(detail: &Detail, entry: &Entry) -> Option<Span> {
    let fits =
        |leaf: &&Field| leaf.spec == entry.spec && (entry.number.is_none() || leaf.number == entry.number);
    fields_by_byte(detail).into_iter().find(fits).map(|leaf| leaf.span)
}

/// The leaves in the order of their bytes, each byte in one of them.
fn fields_by_byte(detail: &Detail) -> Vec<&Field> {
    let named = detail.device.blocks.iter().flat_map(|block| leaves(std::slice::from_ref(&block.field)));
    // What is only asked for stands where it is named, and that field says more.
    let mut found: Vec<&Field> = Vec::new();
    for leaf in named.filter(|leaf| !matches!(leaf.value, Value::Group) && !leaf.span.is_empty()) {
        if found.iter().all(|other| !overlap(other.span, leaf.span)) {
            found.push(leaf);
        }
    }
    let bare = leaves(&detail.fields).into_iter().filter(|leaf| !leaf.span.is_empty());
    let (over, plain): (Vec<&Field>, Vec<&Field>) =
        bare.partition(|leaf| found.iter().any(|named| overlap(named.span, leaf.span)));
    // A named field that covers a part of a bare one only would leave bytes out.
    let covered = |leaf: &&&Field| {
        (leaf.span.from..leaf.span.to).all(|at| found.iter().any(|named| named.span.contains(at)))
    };
    let exact = found.iter().all(|named| {
        (named.span.from..named.span.to).all(|at| over.iter().any(|leaf| leaf.span.contains(at)))
    });
    let others = if exact && over.iter().filter(covered).count() == over.len() { found } else { over };
    let mut all: Vec<&Field> = Vec::new();
    for leaf in plain.into_iter().chain(others) {
        all.insert(all.partition_point(|before| before.span.from <= leaf.span.from), leaf);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use buslens::tool::{Options, Profile, decode};

    fn labels(text: &str, device: &str) -> Vec<String> {
        let report = decode(text, Options { device: Profile::of(device), ..Options::default() });
        let last = report.telegrams.len() - 1;
        let bytes = &report.telegrams[last].line.bytes;
        let blocks = blocks(&report.detail(last).unwrap(), bytes);
        let tiled: Vec<u8> = blocks.iter().flat_map(|block| block.bytes.clone()).collect();
        assert_eq!(tiled, *bytes, "each byte stands in one block");
        blocks.into_iter().map(|block| format!("{} {}", block.label, block.caption)).collect()
    }

    const PAIR: &str = "01 03 00 C8 00 03 84 35\n01 03 06 00 80 42 A4 F1 DE B0 F8";

    #[test]
    fn the_device_names_registers() {
        let bare = labels(PAIR, "");
        assert_eq!(bare[3..6], ["200 128", "201 17060", "202 61918"]);
        let named = labels(PAIR, "memograph-rsg45");
        assert!(named.contains(&"Value 82.4724".to_owned()), "{named:?}");
        assert_eq!(named.last().unwrap(), "CRC valid");
    }

    #[test]
    fn cut_telegrams_have_their_bytes_once() {
        for device in ["", "memograph-rsg45", "keb-f5-modbus"] {
            for length in 3..PAIR.len() {
                labels(&PAIR[..length], device);
            }
        }
    }
}
