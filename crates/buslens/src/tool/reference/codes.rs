//! What single values, bits, errors and texts of a display mean.

use super::registers::task_link;
use super::telegrams::written;
use super::{About, Book, Chapter, Doing, Item, Link, key_of, link_of, link_to};
use crate::device::{Access, Content, Profile, Settings as DeviceSettings, Target, Task};
use crate::field::{Bits, Direction, Format, Name, Spec, hex_value};
use crate::frame::profibus_fdl::Fdl;
use crate::frame::{Cargo, modbus_rtu, profibus_fdl};
use crate::modbus::{self, Pdu, STANDARD};
use crate::profibus::{self, Refusal, Service};
use crate::tool::{Change, Editor, Offer, Protocol};
use crate::walk::form::{self, Form};
use crate::walk::guide::{Size, guide};
use crate::walk::{self, Deviations, Telegram};

/// A value that means something.
#[derive(Clone, Debug)]
pub struct Code {
    /// What has this value: "Exception code", "Baud rate (Sy.07)", "Display".
    pub of: String,
    pub note: &'static str,
    pub source: &'static str,
    draft: Draft,
}

/// What can be built with a code.
#[derive(Clone, Debug)]
enum Draft {
    /// It is on no bus.
    None,
    /// The task, and the spec and the number that it fills in.
    Task(Task, Option<(&'static Spec, u64)>),
    /// A telegram of a function or service, with that number.
    Telegram(Offer, &'static Spec, u64),
    /// Function and code.
    Exception(u8, u8),
    Refusal(Refusal),
}

impl Code {
    /// Whether the display shows it, and no bus carries it.
    pub(super) const fn is_shown(&self) -> bool {
        matches!(self.draft, Draft::None)
    }

    /// What can be built with it, as a link for Build.
    pub(super) fn draft(&self) -> Option<(Doing, Link)> {
        match self.draft {
            Draft::None => None,
            Draft::Task(task, filled) => {
                let entry = filled.and_then(|(spec, raw)| {
                    Some((path_of(&form_of(&mut task.draft()), spec)?, text_of(spec, raw)))
                });
                let doing = if task.access == Access::Write { Doing::Write } else { Doing::Read };
                Some((doing, task_link(task, None, entry.into_iter().collect())))
            }
            Draft::Telegram(offer, spec, raw) => {
                let carrier = carrier_of(&offer);
                let mut editor = Editor::new(offer, 1, carrier, &crate::tool::Settings::default()).ok()?;
                if let Some(path) = path_of(&editor.entries().form, spec) {
                    editor.edit(&path, Change::Enter(&text_of(spec, raw)));
                }
                Some((Doing::Build, link_of(editor)))
            }
            Draft::Exception(function, code) => {
                let refusal = Pdu::expect(function, Direction::Request, &STANDARD).refusal(code);
                let mut frame = (modbus_rtu::PROTOCOL.carry)(1, Cargo::Modbus(refusal))?;
                let link = link_to(&written(frame.as_mut()), &modbus_rtu::PROTOCOL, Direction::Response);
                Some((Doing::Build, link))
            }
            Draft::Refusal(refusal) => {
                let settings = profibus::Settings::default();
                let mut request = profibus::Channel::new(Direction::Request, &settings);
                let service = if refusal.class == 5 { Service::Both } else { Service::Write };
                request.ask(service, 2, 1);
                request.index = 0x2300;
                let mut response = profibus::Channel::new(Direction::Response, &settings);
                response.confirm(&request, Some(refusal));
                let protocol = Protocol::of("profibus-parameter-channel")?;
                Some((Doing::Build, link_to(&response.bytes(), protocol, Direction::Response)))
            }
        }
    }
}

fn carrier_of(offer: &Offer) -> &'static Protocol {
    match offer {
        Offer::Service(_) => &profibus_fdl::PROTOCOL,
        _ => &modbus_rtu::PROTOCOL,
    }
}

fn form_of(telegram: &mut dyn Telegram) -> Form {
    form::form(telegram, &Deviations::default())
}

/// The path of the entry with this spec.
fn path_of(form: &Form, spec: &'static Spec) -> Option<String> {
    let mut path = None;
    form.visit(&mut |entry| {
        if path.is_none() && entry.spec == spec {
            path = Some(entry.path.clone());
        }
    });
    path
}

fn text_of(spec: &'static Spec, raw: u64) -> String {
    if spec.bits.is_empty() { raw.to_string() } else { format!("0x{raw:X}") }
}

/// What a spec says of its values, one by one.
struct Meaning {
    /// As the manual writes it: `3`, `80h`, `bit 4`, `1 to 239`.
    number: String,
    numbers: Option<(u64, u64)>,
    label: &'static str,
    note: &'static str,
    /// The part of the number that it is of, where that has a name of its own.
    part: Option<&'static str>,
    /// The whole number with this value.
    raw: u64,
}

fn meanings(spec: &'static Spec) -> Vec<Meaning> {
    let mut found = Vec::new();
    let shown = |value: u64, hex: bool| match hex {
        true => hex_value(value, if value > 0xFF { 2 } else { 1 }).to_string(),
        false => value.to_string(),
    };
    let is_hex = spec.format == Format::Hex;
    let named = |name: &'static Name| !name.label.is_empty();
    for name in spec.names.iter().filter(|name| named(name)) {
        let Name { value, label, note } = *name;
        let numbers = Some((value, value));
        found.push(Meaning { number: shown(value, is_hex), numbers, label, note, part: None, raw: value });
    }
    for range in spec.ranges {
        found.push(Meaning {
            number: format!("{} to {}", shown(range.from, is_hex), shown(range.to, is_hex)),
            numbers: Some((range.from, range.to)),
            label: range.label,
            note: "",
            part: None,
            raw: range.from,
        });
    }
    for part in spec.bits.iter().filter(|part| !part.reserved) {
        let Bits { label, note, .. } = *part;
        if part.names.is_empty() && part.ranges.is_empty() {
            if part.count == 1 {
                let number = format!("bit {}", part.from);
                let raw = part.put(spec.initial, 1);
                found.push(Meaning { number, numbers: None, label, note, part: None, raw });
            }
            continue;
        }
        let hex = part.format == Format::Hex || part.count == 8;
        for name in part.names.iter().filter(|name| named(name)) {
            let Name { value, label: named, note: said } = *name;
            let note = if said.is_empty() { note } else { said };
            found.push(Meaning {
                number: shown(value, hex),
                numbers: Some((value, value)),
                label: named,
                note,
                part: Some(label),
                raw: part.put(spec.initial, value),
            });
        }
        for range in part.ranges {
            found.push(Meaning {
                number: format!("{} to {}", shown(range.from, hex), shown(range.to, hex)),
                numbers: Some((range.from, range.to)),
                label: range.label,
                note,
                part: Some(label),
                raw: part.put(spec.initial, range.from),
            });
        }
    }
    found
}

/// Gathers codes, each once.
struct Codes {
    book: Book,
    items: Vec<Item>,
}

impl Codes {
    fn add(&mut self, number: String, numbers: Vec<(u64, u64)>, label: &str, code: Code) {
        let same = |item: &Item| {
            item.number == number
                && item.label == label
                && matches!(&item.about, About::Code(own) if own.of == code.of)
        };
        if self.items.iter().any(same) {
            return;
        }
        let mut key = key_of(&format!("{} {number}", code.of));
        let alike = self.items.iter().filter(|item| item.key == key).count();
        if alike > 0 {
            key = key_of(&format!("{key} {label}"));
        }
        self.items.push(Item {
            book: self.book,
            chapter: Chapter::Codes,
            key,
            label: label.to_owned(),
            numbers,
            names: format!("{}\n{number}", code.of),
            notes: code.note.to_owned(),
            number,
            folded: String::new(),
            about: About::Code(code),
        });
    }

    /// Everything that a spec says of its values; `of` is what the spec is about.
    fn add_spec(&mut self, of: &str, spec: &'static Spec, draft: impl Fn(u64) -> Draft) {
        for meaning in meanings(spec) {
            let Meaning { number, numbers, label, note, part, raw } = meaning;
            let of = match part {
                Some(part) if !of.to_ascii_lowercase().contains(part) => format!("{of}, {part}"),
                _ => of.to_owned(),
            };
            let code = Code { of, note, source: spec.source, draft: draft(raw) };
            self.add(number, numbers.into_iter().collect(), label, code);
        }
    }
}

/// The codes of a book.
pub(super) fn items(book: Book) -> Vec<Item> {
    let mut codes = Codes { book, items: Vec::new() };
    match book {
        Book::Modbus => modbus_codes(&mut codes),
        Book::Profibus => profibus_codes(&mut codes),
        Book::Device(profile) => device_codes(&mut codes, profile),
    }
    codes.items
}

fn modbus_codes(codes: &mut Codes) {
    for name in modbus::exceptions() {
        exception(codes, name, 3, modbus::OTHER_KINDS[0].spec.source);
    }
    for kind in modbus::KINDS {
        let offer = Offer::Telegram(kind);
        for row in guide(&mut kind.pdu(&STANDARD)) {
            codes.add_spec(row.spec.label, row.spec, |raw| Draft::Telegram(offer, row.spec, raw));
        }
        choices(codes, kind);
    }
}

/// What the bytes behind a function code choose, which has no list: sub-functions, MEI types.
fn choices(codes: &mut Codes, kind: &'static modbus::Kind) {
    let chosen = |value: u64, width: usize| {
        let mut pdu = kind.pdu(&STANDARD);
        let bytes: Vec<u8> =
            std::iter::once(kind.function).chain(value.to_be_bytes()[8 - width..].iter().copied()).collect();
        walk::fill(&mut pdu, &bytes);
        guide(&mut pdu).into_iter().find(|row| row.offset == Some(1))?.chosen
    };
    let rows = guide(&mut kind.pdu(&STANDARD));
    let row = rows.iter().find(|row| row.offset == Some(1) && row.chosen.is_some());
    let Some((row, Size::Fixed(width))) = row.map(|row| (row, row.size)) else { return };
    if !row.spec.names.is_empty() {
        return;
    }
    let unknown = chosen(u64::MAX, width).map(|(_, spec)| spec);
    for value in 0..=0xFF {
        let Some((_, spec)) = chosen(value, width).filter(|(_, spec)| Some(*spec) != unknown) else {
            continue;
        };
        let draft = Draft::Telegram(Offer::Telegram(kind), row.spec, value);
        let source = if spec.source.is_empty() { kind.spec.source } else { spec.source };
        let code = Code { of: row.spec.label.to_owned(), note: spec.note, source, draft };
        codes.add(value.to_string(), vec![(value, value)], spec.label, code);
    }
}

fn exception(codes: &mut Codes, name: &'static Name, function: u8, source: &'static str) {
    let Name { value, label, note } = *name;
    // Codes have one byte.
    let draft = Draft::Exception(function, value as u8);
    let code = Code { of: "Exception code".to_owned(), note, source, draft };
    codes.add(format!("{value} ({})", hex_value(value, 1)), vec![(value, value)], label, code);
}

fn profibus_codes(codes: &mut Codes) {
    for (refusal, name) in Refusal::all() {
        let code = Code {
            of: "Error of the parameter channel".to_owned(),
            note: name.note,
            source: "KEB COMBIVERT F5 PROFIBUS-DP operator, 7.4",
            draft: Draft::Refusal(refusal),
        };
        let additional = u64::from(refusal.additional);
        codes.add(refusal.number().to_string(), vec![(additional, additional)], name.label, code);
    }
    for kind in profibus::KINDS.iter().chain(&profibus::OTHER_KINDS[..2]) {
        let offer = Offer::Service(kind);
        let mut frame = Fdl::new(kind, &profibus::Settings::default());
        for row in guide(&mut frame) {
            codes.add_spec(row.spec.label, row.spec, |raw| Draft::Telegram(offer, row.spec, raw));
        }
    }
}

fn device_codes(codes: &mut Codes, profile: &'static Profile) {
    let function = profile.functions.first().copied().unwrap_or(3);
    if !profile.functions.is_empty() {
        for name in
            modbus::exceptions().iter().filter(|name| profile.common_exceptions.contains(&(name.value as u8)))
        {
            exception(codes, name, function, modbus::OTHER_KINDS[0].spec.source);
        }
    }
    if let Some(spec) = profile.exceptions {
        spec.names.iter().for_each(|name| exception(codes, name, function, spec.source));
    }
    if profile.ident.is_some() {
        profibus_refusals(codes);
    }
    for display in profile.display {
        let code = Code { of: "Display".to_owned(), note: "", source: profile.source, draft: Draft::None };
        codes.add(display.text.to_owned(), Vec::new(), display.meaning, code);
    }
    for parameter in profile.parameters() {
        let of = match parameter.id {
            "" => parameter.spec.label.to_owned(),
            id => format!("{} ({id})", parameter.spec.label),
        };
        let draft = draft_of(profile, Target::Parameter(parameter), true);
        codes.add_spec(&of, &parameter.spec, |raw| draft(&parameter.spec, raw));
    }
    for area in profile.areas.iter().filter(|area| !area.listed) {
        let target = Target::Area(area);
        let draft = draft_of(profile, target, true);
        codes.add_spec(area.spec.label, &area.spec, |raw| draft(&area.spec, raw));
        match area.content {
            Content::Parts(parts) => {
                for part in parts {
                    // What is written has words of its own.
                    let writes = matches!(area.access, Access::Write | Access::ReadWrite);
                    let read = draft_of(profile, target, false);
                    codes.add_spec(part.spec.label, part.spec, |raw| read(part.spec, raw));
                    if writes && !std::ptr::eq(part.spec, part.written) {
                        codes.add_spec(part.written.label, part.written, |raw| draft(part.written, raw));
                    }
                }
            }
            Content::Telegram { read, write } => {
                let present = |read_back| {
                    let mut settings = DeviceSettings::default();
                    settings.present.limits_read_back = read_back;
                    settings
                };
                for settings in [present(false), present(true)] {
                    let specs = read.map_or(Vec::new(), |new| specs_of(new(&settings)));
                    let read = draft_of(profile, target, false);
                    for spec in specs {
                        codes.add_spec(&format!("{}: {}", area.spec.label, spec.label), spec, |raw| {
                            read(spec, raw)
                        });
                    }
                }
                for spec in write.map_or(Vec::new(), |new| specs_of(new(&present(false)))) {
                    let write = draft_of(profile, target, true);
                    codes.add_spec(&format!("{}: {}", area.spec.label, spec.label), spec, |raw| {
                        write(spec, raw)
                    });
                }
            }
            Content::Value | Content::Mapped => {}
        }
    }
}

fn profibus_refusals(codes: &mut Codes) {
    let mut all = Codes { book: codes.book, items: Vec::new() };
    profibus_codes(&mut all);
    let of_jobs = |item: &Item| matches!(&item.about, About::Code(Code { draft: Draft::Refusal(_), .. }));
    codes.items.extend(all.items.into_iter().filter(of_jobs));
}

/// What can be asked of `target` with one of its values: to write it where `written`, or else to read what has it.
fn draft_of(
    profile: &'static Profile,
    target: Target,
    written: bool,
) -> impl Fn(&'static Spec, u64) -> Draft {
    move |spec, raw| {
        let write = profile.task(target, Access::Write).filter(|_| written);
        let read = profile.task(target, Access::Read);
        match (write, read) {
            (Some(task), _) => Draft::Task(task, Some((spec, raw))),
            (None, Some(task)) => Draft::Task(task, None),
            (None, None) => Draft::None,
        }
    }
}

/// The specs of a telegram's fields, for each thing that it can choose.
fn specs_of(mut telegram: Box<dyn Telegram>) -> Vec<&'static Spec> {
    let mut specs: Vec<&'static Spec> = Vec::new();
    let mut add = |telegram: &mut dyn Telegram| {
        for row in guide(telegram) {
            if !specs.iter().any(|spec| std::ptr::eq(*spec, row.spec)) {
                specs.push(row.spec);
            }
        }
    };
    add(telegram.as_mut());
    let first = form_of(telegram.as_mut());
    let mut choices = Vec::new();
    first.visit(&mut |entry| {
        if let form::Content::Choice { .. } = entry.content {
            choices.extend(entry.spec.names.iter().map(|name| (entry.path.clone(), name.value)));
        }
    });
    for (path, value) in choices {
        let mut form = first.clone();
        if let Some(entry) = form.entries.iter_mut().find(|entry| entry.path == path)
            && let form::Content::Choice { raw, .. } = &mut entry.content
        {
            *raw = value;
            // What does not fit stays as it was.
            let _ = form::fill(telegram.as_mut(), &form);
            add(telegram.as_mut());
        }
    }
    specs
}
