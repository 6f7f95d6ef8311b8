//! A form: an entry for each field of something, as the library describes it.

use std::mem::{Discriminant, discriminant};
use std::sync::atomic::{AtomicUsize, Ordering};

use leptos::context::Provider;
use leptos::prelude::*;

use super::byte_strip::role_class;
use super::icon::{Glyph, Icon};
use super::kept::{Kept, kept};
use super::segments::Segments;
use buslens::field::{Bits, Message, Name, Role, Spec, count, hex, number_text};
use buslens::tool::{Change, Content, Entries, Entry, Misfit, parse_value};

/// What a person did with an entry.
#[derive(Clone, Debug)]
pub enum Edit {
    /// Typed it, or chose it from a list.
    Enter(String),
    /// Set some bits of a number.
    Bits { part: usize, value: u64 },
    /// Added an item to a list.
    Add,
    /// Took an item from a list.
    Remove(usize),
}

impl Edit {
    /// The same as the library takes it.
    pub fn change(&self) -> Change<'_> {
        match *self {
            Self::Enter(ref text) => Change::Enter(text),
            Self::Bits { part, value } => Change::Bits { part, value },
            Self::Add => Change::Add,
            Self::Remove(index) => Change::Remove(index),
        }
    }
}

/// What every entry of a form knows.
#[derive(Clone, Copy)]
struct Shared {
    misfits: RwSignal<Vec<Misfit>>,
    on_edit: Callback<(String, Edit)>,
    on_focus: Option<Callback<Entry>>,
    /// Tells the fields of several forms in a page apart.
    number: usize,
    named: &'static [&'static str],
}

impl Shared {
    /// What is wrong with an entry: it does not fit, or should not be so.
    fn said(&self, entry: &Entry) -> String {
        let misfit = self.misfits.with(|misfits| {
            misfits.iter().find(|misfit| misfit.path == entry.path).map(|misfit| misfit.message.sentence())
        });
        let spec = entry.spec;
        misfit.map(|misfit| misfit + ".").unwrap_or_else(|| match &entry.content {
            Content::Number { width, text }
                if parse_value(text, *width, spec).is_ok_and(|raw| !spec.allows(raw)) =>
            {
                format!("Allowed: {}.", range(entry).unwrap_or_default())
            }
            _ => String::new(),
        })
    }
}

/// The form. What is typed stays as it was typed; what does not fit is said at its field.
#[component]
pub fn Form(
    #[prop(into)] entries: Signal<Entries>,
    /// With the path of the entry.
    on_edit: Callback<(String, Edit)>,
    #[prop(optional)] on_focus: Option<Callback<Entry>>,
    /// Only these entries, by their paths; all of them without.
    #[prop(optional)]
    only: &'static [&'static str],
    /// These numbers are set by their names or switches only.
    #[prop(optional)]
    named: &'static [&'static str],
    /// The entries of these groups stand among the others.
    #[prop(optional)]
    flat: &'static [&'static str],
) -> impl IntoView {
    static FORMS: AtomicUsize = AtomicUsize::new(0);
    let number = FORMS.fetch_add(1, Ordering::Relaxed);
    let shown = Memo::new(move |_| {
        entries.with(|all| {
            let wanted = |entry: &&Entry| only.is_empty() || only.contains(&entry.path.as_str());
            let shown = all.form.entries.iter().filter(wanted).flat_map(|entry| match &entry.content {
                Content::Group { entries } if flat.contains(&entry.path.as_str()) => entries.clone(),
                _ => vec![entry.clone()],
            });
            shown.collect::<Vec<_>>()
        })
    });
    // Only who has to say another one is told.
    let misfits = RwSignal::new(entries.with_untracked(|all| all.misfits.clone()));
    Effect::new(move |_| {
        let now = entries.with(|all| all.misfits.clone());
        if misfits.with_untracked(|before| *before != now) {
            misfits.set(now);
        }
    });
    view! {
        // Each form of the page has a context of its own.
        <Provider value=Shared { misfits, on_edit, on_focus, number, named }>
            <div class="form">{level(shown.into(), false)}</div>
        </Provider>
    }
}

/// What an entry is told apart by while it is edited. Another function has other fields at the same paths.
fn key(entry: &Entry) -> (String, Discriminant<Content>, usize) {
    (entry.path.clone(), discriminant(&entry.content), std::ptr::from_ref(entry.spec).addr())
}

/// The entries of a form, a group or an item of a list. `within_list`: what holds for each item is not
/// said at each.
fn level(entries: Signal<Vec<Entry>>, within_list: bool) -> AnyView {
    let entry = move |first: Entry| {
        let own = key(&first);
        let entry = Memo::new(move |before: Option<&Entry>| {
            let now = entries.with(|all| all.iter().find(|entry| key(entry) == own).cloned());
            // One that is just being taken away stays as it was.
            now.or_else(|| before.cloned()).unwrap_or_else(|| first.clone())
        });
        view! { <Field entry=entry.into() within_list /> }
    };
    view! {
        <div class="entries">
            <For each=move || entries.get() key=key children=entry />
        </div>
    }
    .into_any()
}

/// One entry.
#[component]
fn Field(entry: Signal<Entry>, within_list: bool) -> impl IntoView {
    // Which content it has does not change as long as it is there.
    match entry.with_untracked(|entry| discriminant(&entry.content)) {
        kind if kind == discriminant(&Content::Group { entries: Vec::new() }) => {
            group(entry, within_list).into_any()
        }
        kind if kind == discriminant(&Content::List { items: Vec::new() }) => list(entry).into_any(),
        _ => single(entry, within_list).into_any(),
    }
}

fn group(entry: Signal<Entry>, within_list: bool) -> impl IntoView {
    let within = Memo::new(move |_| {
        entry.with(|entry| match &entry.content {
            Content::Group { entries } => entries.clone(),
            _ => Vec::new(),
        })
    });
    let note = entry.with_untracked(|entry| entry.spec.note);
    let shown = move || entry.with(|entry| entry.label().sentence());
    // A group of nothing has nothing to say.
    view! {
        <fieldset class="group" hidden=move || within.with(Vec::is_empty)>
            <legend>{move || shown()}</legend>
            {(!note.is_empty() && !within_list).then(|| view! { <p class="note">{note}</p> })}
            {level(within.into(), within_list)}
        </fieldset>
    }
}

fn list(entry: Signal<Entry>) -> impl IntoView {
    let shared = expect_context::<Shared>();
    let path = StoredValue::new(entry.with_untracked(|entry| entry.path.clone()));
    let edit = move |edit: Edit| shared.on_edit.run((path.get_value(), edit));
    let length = Memo::new(move |_| entry.with(|entry| items(entry).len()));
    // More than fits the window: what is out of sight is not laid out.
    let is_long = move || length.get() > 16;
    let numbered = move || entry.with(|entry| items(entry).iter().cloned().enumerate().collect::<Vec<_>>());
    let item = move |Kept { key: index, item }: Kept<usize, (usize, Vec<Entry>)>| {
        let item = RwSignal::from(item);
        let entries = Signal::derive(move || item.read().1.clone());
        view! {
            <div class="item">
                {level(entries, true)}
                <button
                    type="button"
                    class="button plain icon-only"
                    aria-label=format!("Remove number {}", index + 1)
                    on:click=move |_| edit(Edit::Remove(index))
                >
                    <Icon glyph=Glyph::Close />
                </button>
            </div>
        }
    };
    let (label, note) = entry.with_untracked(|entry| (entry.label().sentence(), entry.spec.note));
    view! {
        <fieldset class="list" class:long=move || is_long()>
            <legend>
                {label} " " <small>{move || length.get().to_string()}</small>
            </legend>
            {(!note.is_empty()).then(|| view! { <p class="note">{note}</p> })}
            <For each=kept(numbered, |(index, _)| *index) key=|kept| kept.key children=item />
            <button type="button" class="button low" on:click=move |_| edit(Edit::Add)>
                <Icon glyph=Glyph::Add />
                "Add one"
            </button>
        </fieldset>
    }
}

/// The items of a list.
fn items(entry: &Entry) -> &[Vec<Entry>] {
    match &entry.content {
        Content::List { items } => items,
        _ => &[],
    }
}

/// An entry that is typed or chosen.
fn single(entry: Signal<Entry>, within_list: bool) -> impl IntoView {
    let shared = expect_context::<Shared>();
    let (spec, path) = entry.with_untracked(|entry| (entry.spec, entry.path.clone()));
    let id = format!("form-{}-{path}", shared.number);
    let about = format!("{id}-about");
    let by_name_only = spec.only_named || shared.named.contains(&path.as_str());
    let path = StoredValue::new(path);
    let edit = Callback::new(move |edit: Edit| shared.on_edit.run((path.get_value(), edit)));
    let said = Memo::new(move |_| entry.with(|entry| shared.said(entry)));
    let focus = move |_| {
        if let Some(focus) = shared.on_focus {
            focus.run(entry.get_untracked());
        }
    };
    let control = match entry.with_untracked(|entry| entry.content.clone()) {
        Content::Choice { .. } if !spec.names.is_empty() => choice(entry, spec, id.clone(), edit).into_any(),
        _ if by_name_only && !spec.bits.is_empty() => bits(entry, spec, edit).into_any(),
        _ if by_name_only => choice(entry, spec, id.clone(), edit).into_any(),
        content => {
            let mono = !matches!(content, Content::Text { .. });
            let placeholder = move || entry.with(|entry| placeholder(&entry.content, spec));
            let behind = move || entry.with(|entry| behind(&entry.content, spec));
            let number = matches!(content, Content::Number { .. });
            view! {
                <div class="control">
                    <input
                        id=id.clone()
                        class="input"
                        class:mono=mono
                        autocomplete="off"
                        autocapitalize="off"
                        spellcheck="false"
                        placeholder=placeholder
                        aria-describedby=about.clone()
                        aria-invalid=move || (!said.with(String::is_empty)).to_string()
                        prop:value=move || entry.with(|entry| text(&entry.content))
                        on:input=move |event| edit.run(Edit::Enter(event_target_value(&event)))
                    />
                    <span class="behind">{behind}</span>
                    {(number && by_name(spec)).then(|| names(entry, spec, edit))}
                </div>
                {(number && !spec.bits.is_empty()).then(|| bits(entry, spec, edit))}
            }
            .into_any()
        }
    };
    let hint = Memo::new(move |_| entry.with(|entry| hint(entry, within_list)));
    let nothing = move || said.with(String::is_empty) && hint.with(String::is_empty);
    let text = move || entry.with(|entry| entry.label().sentence());
    // Switches have labels of their own.
    let label = match by_name_only && !spec.bits.is_empty() {
        true => view! { <span class="name">{text}</span> }.into_any(),
        false => view! { <label for=id.clone()>{text}</label> }.into_any(),
    };
    view! {
        <div class=format!("entry {}", role_class(spec.role)) on:focusin=focus>
            {label}
            {control}
            <p class="about" id=about hidden=nothing>
                <span class="misfit" aria-live="polite">{said}</span>
                <small>{hint}</small>
            </p>
        </div>
    }
}

/// What stands in the field.
fn text(content: &Content) -> String {
    match content {
        Content::Number { text, .. }
        | Content::Computed { text, .. }
        | Content::Bytes { text }
        | Content::Text { text }
        | Content::Extra { text }
        | Content::Cut { text } => text.clone(),
        Content::Choice { raw, .. } => raw.to_string(),
        Content::List { .. } | Content::Group { .. } => String::new(),
    }
}

/// What an empty field says: what counts instead.
fn placeholder(content: &Content, spec: &Spec) -> String {
    match content {
        Content::Computed { width, computed, .. } if spec.role == Role::Check => {
            format!("{}, computed", hex(&computed.to_be_bytes()[8 - width..]))
        }
        Content::Computed { width, computed, .. } => {
            format!("{}, computed", number_text(*computed, *width, spec.format))
        }
        _ => String::new(),
    }
}

/// What stands behind the field: its unit, how long the text is, what a number is called.
fn behind(content: &Content, spec: &Spec) -> String {
    match content {
        Content::Number { .. } => spec.unit.to_owned(),
        Content::Text { text } => {
            let characters =
                buslens::field::unescaped(text).map_or(text.chars().count(), |bytes| bytes.len());
            count(characters, "character")
        }
        Content::Choice { chosen, .. } => Message::term(chosen.label).sentence(),
        _ => String::new(),
    }
}

/// What there is to know before it is typed.
fn hint(entry: &Entry, within_list: bool) -> String {
    let spec = entry.spec;
    if within_list {
        return String::new();
    }
    let note = match &entry.content {
        Content::Computed { .. } if spec.role == Role::Check => "Type its bytes here to break it on purpose.",
        Content::Computed { .. } => "Type a number here to break it on purpose.",
        Content::Choice { chosen, .. } => chosen.note,
        _ => spec.note,
    };
    let range = range(entry).map(|range| range + ".");
    [range, Some(note.to_owned())].into_iter().flatten().collect::<Vec<_>>().join(" ").trim().to_owned()
}

/// "1 to 125", where there are limits.
fn range(entry: &Entry) -> Option<String> {
    let Content::Number { width, .. } = entry.content else { return None };
    let (from, to) = entry.spec.limits?;
    let text = |raw| number_text(raw, width, entry.spec.format);
    Some(format!("{} to {}", text(from), text(to)))
}

/// Whether people think of its values by their names. A unit has a number; only a few are special.
fn by_name(spec: &Spec) -> bool {
    !spec.names.is_empty() && spec.role != Role::Unit
}

/// The number that stands in the field; 0 where that is none.
fn number(entry: &Entry) -> Option<u64> {
    match &entry.content {
        Content::Number { width, text } => parse_value(text, *width, entry.spec).ok(),
        Content::Choice { raw, .. } => Some(*raw),
        _ => None,
    }
}

/// A name as an option says it.
fn name_text(name: &Name) -> String {
    if name.label.is_empty() { name.value.to_string() } else { Message::term(name.label).sentence() }
}

/// A list of names, of which one makes the form what it is.
fn choice(entry: Signal<Entry>, spec: &'static Spec, id: String, edit: Callback<Edit>) -> impl IntoView {
    let raw = Memo::new(move |_| entry.with(number).unwrap_or_default());
    let option = move |name: &'static Name| {
        view! {
            <option value=name.value.to_string() prop:selected=move || raw.get() == name.value>
                {name_text(name)}
            </option>
        }
    };
    let other = move || {
        spec.name(raw.get()).is_none().then(|| {
            let label = entry.with(|entry| behind(&entry.content, spec));
            view! { <option value=raw.get().to_string() prop:selected=true>{format!("{}: {label}", raw.get())}</option> }
        })
    };
    view! {
        <select
            id=id
            class="select"
            on:change=move |event| edit.run(Edit::Enter(event_target_value(&event)))
        >
            {move || other()}
            {spec.names.iter().map(option).collect_view()}
        </select>
    }
}

/// The named values to choose from, beside the number.
fn names(entry: Signal<Entry>, spec: &'static Spec, edit: Callback<Edit>) -> impl IntoView {
    let raw = Memo::new(move |_| entry.with(number));
    let named = move || raw.get().is_some_and(|raw| spec.name(raw).is_some());
    let option = move |name: &'static Name| {
        view! {
            <option value=name.label prop:selected=move || raw.get() == Some(name.value)>
                {name_text(name)}
            </option>
        }
    };
    let choose = move |event| {
        let label = event_target_value(&event);
        // The first line of the list chooses none.
        if !label.is_empty() {
            edit.run(Edit::Enter(label));
        }
    };
    let label = move || entry.with(|entry| format!("{}, by name", entry.label().sentence()));
    view! {
        <select class="select" aria-label=label on:change=choose>
            <option value="" prop:selected=move || !named()>"choose …"</option>
            {spec.names.iter().map(option).collect_view()}
        </select>
    }
}

/// A switch for each bit that says something, a choice or a number for several together.
fn bits(entry: Signal<Entry>, spec: &'static Spec, edit: Callback<Edit>) -> impl IntoView {
    let raw = Memo::new(move |_| entry.with(number).unwrap_or_default());
    // What has one choice is none.
    let said = spec.bits.iter().enumerate().filter(|(_, part)| !part.reserved && part.names.len() != 1);
    let part = move |(index, part): (usize, &'static Bits)| {
        let value = Memo::new(move |_| part.of(raw.get()));
        let set = Callback::new(move |value: u64| edit.run(Edit::Bits { part: index, value }));
        bit(part, value, set)
    };
    view! { <div class="bits">{said.map(part).collect_view()}</div> }
}

fn bit(part: &'static Bits, value: Memo<u64>, set: Callback<u64>) -> AnyView {
    /// More are easier to read in a list.
    const SIDE_BY_SIDE: usize = 3;
    let label = Message::term(part.label).sentence();
    let known = move || part.name(value.get()).is_some();
    let named: Vec<(u64, String)> = part.names.iter().map(|name| (name.value, name_text(name))).collect();
    match part.names.len() {
        0 if part.count == 1 => view! {
            <label class="switch" title=part.note>
                <input
                    type="checkbox"
                    prop:checked=move || value.get() == 1
                    on:change=move |event| set.run(event_target_checked(&event).into())
                />
                <span>{label}</span>
            </label>
        }
        .into_any(),
        0 => view! {
            <label class="part" title=part.note>
                <span>{label}</span>
                <input
                    class="input mono"
                    type="number"
                    min="0"
                    max=((1_u64 << part.count) - 1).to_string()
                    prop:value=move || value.get().to_string()
                    on:change=move |event| {
                        if let Ok(value) = event_target_value(&event).parse() {
                            set.run(value);
                        }
                    }
                />
            </label>
        }
        .into_any(),
        few if few <= SIDE_BY_SIDE && part.names.iter().all(|name| name.label.len() < 16) => view! {
            <div class="part">
                <span aria-hidden="true">{label.clone()}</span>
                <Segments
                    label=label
                    options=named
                    value=Signal::from(value)
                    on_choose=set
                    class="wide"
                />
            </div>
        }
        .into_any(),
        _ => view! {
            <label class="part" title=part.note>
                <span>{label}</span>
                <select
                    class="select"
                    on:change=move |event| {
                        if let Ok(value) = event_target_value(&event).parse() {
                            set.run(value);
                        }
                    }
                >
                    {move || {
                        (!known()).then(|| {
                            let value = value.get().to_string();
                            view! { <option value=value.clone() prop:selected=true>{value.clone()}</option> }
                        })
                    }}
                    {part
                        .names
                        .iter()
                        .map(|name| {
                            view! {
                                <option
                                    value=name.value.to_string()
                                    prop:selected=move || value.get() == name.value
                                >
                                    {name_text(name)}
                                </option>
                            }
                        })
                        .collect_view()}
                </select>
            </label>
        }
        .into_any(),
    }
}
