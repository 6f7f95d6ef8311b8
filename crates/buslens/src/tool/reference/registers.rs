//! What stands in the registers and parameters of a device.

use super::{About, Book, Chapter, Doing, Item};
use crate::device::{Access, Area, Content, Parameter, Profile, Target, Task};
use crate::field::{Format, Numbering, Spec, float, hex_value, in_order, number_text};
use crate::tool::link::Link;
use crate::tool::{Options, Protocol};
use crate::walk::{Deviations, form};

/// A register, a block of registers, or a parameter.
#[derive(Clone, Debug)]
pub struct Register {
    pub profile: &'static Profile,
    target: Target,
    /// Which block, as the manual counts them.
    block: Option<u64>,
    /// The maker's short name: `Sy.52`; may be empty.
    pub id: &'static str,
    pub from: u16,
    pub to: u16,
    pub subindex: Option<u8>,
    pub spec: &'static Spec,
    /// What kind of value it has: "float", "16 bits, signed".
    pub kind: String,
    /// The software that has it, where not all do.
    pub since: &'static str,
}

/// A number within a block of registers.
#[derive(Clone, Debug)]
pub struct Held {
    pub spec: &'static Spec,
    /// As the manual writes its addresses.
    pub number: String,
    pub kind: String,
}

impl Register {
    const fn access(&self) -> Access {
        match self.target {
            Target::Area(area) => area.access,
            Target::Parameter(parameter) => parameter.access,
        }
    }

    /// What the manual lets a client do: "read and write".
    pub const fn allowed(&self) -> &'static str {
        match self.access() {
            Access::Read => "read",
            Access::Write => "write",
            Access::ReadWrite => "read and write",
            Access::Elsewhere => "not over this bus",
        }
    }

    /// The smallest and the largest value, as its values are written; empty where the manual has none.
    pub fn limits(&self) -> String {
        limits(self.spec)
    }

    /// The unit of its value; may be empty.
    pub const fn unit(&self) -> &'static str {
        self.spec.unit
    }

    /// Its number in the other notations, each with its name.
    pub fn other_numbers(&self) -> Vec<(&'static str, String)> {
        let pair = |text: &dyn Fn(u16) -> String| match self.from == self.to {
            true => text(self.from),
            false => format!("{} to {}", text(self.from), text(self.to)),
        };
        let hex = |address: u16| hex_value(address.into(), 2).to_string();
        let decimal = |address: u16| address.to_string();
        let mut numbers = vec![match self.profile.hex_addresses {
            true => ("Decimal", pair(&decimal)),
            false => ("Hex", pair(&hex)),
        }];
        if self.profile.ident.is_none() {
            let register = |address: u16| (u32::from(address) + 1).to_string();
            let reference = |address: u16| match u32::from(address) + 1 {
                number @ ..10_000 => format!("4{number:04}"),
                number => format!("4{number:05}"),
            };
            numbers.push(("Counted from 1", pair(&register)));
            numbers.push(("As 4xxxx", pair(&reference)));
        }
        if let Some(alias) = self.profile.alias(self.from, self.subindex.unwrap_or_default()) {
            let both = [alias.new.map(hex), alias.old.map(|old| format!("{} in older software", hex(old)))];
            let both: Vec<String> = both.into_iter().flatten().collect();
            numbers.push(("COMBIVIS", both.join(", ")));
        }
        numbers
    }

    /// The numbers of the block, where it has several.
    pub fn parts(&self) -> Vec<Held> {
        let Target::Area(Area { content: Content::Parts(parts), length, .. }) = self.target else {
            return Vec::new();
        };
        let mut at = self.from;
        let mut held = Vec::new();
        for part in *parts {
            let (from, to) = (at, at + part.registers - 1);
            let number = match from == to {
                true => self.profile.address(from),
                false => format!("{} to {}", self.profile.address(from), self.profile.address(to)),
            };
            let width = length.unwrap_or(2) * usize::from(part.registers);
            held.push(Held { spec: part.spec, number, kind: kind(part.spec, width) });
            at = at.saturating_add(part.registers);
        }
        held
    }

    /// Whether it stands for a range whose addresses the manual does not tell apart.
    pub fn is_range(&self) -> bool {
        matches!(self.target, Target::Area(area) if area.count > 1) && self.block.is_none()
    }

    /// What stands at one address of a range.
    pub(super) fn at(&self, address: u16) -> Option<Item> {
        let Target::Area(area) = self.target else { return None };
        let block = area.first? + u64::from(address.checked_sub(area.from)? / area.stride);
        // A name of its own says more.
        if self.profile.parameters().any(|parameter| parameter.address == address) {
            return None;
        }
        Some(of_block(self.profile, area, block))
    }

    /// What can be asked of it, as links for Build.
    pub(super) fn drafts(&self) -> Vec<(Doing, Link)> {
        let mut drafts = Vec::new();
        for (doing, access) in [(Doing::Read, Access::Read), (Doing::Write, Access::Write)] {
            let task = self.profile.task(self.target, access);
            drafts.extend(task.map(|task| (doing, task_link(task, self.block, least(task)))));
        }
        drafts
    }
}

/// What has to be filled in before there is a telegram: a text, where there is nothing to write without.
fn least(task: Task) -> Vec<(String, String)> {
    let mut draft = task.draft();
    if draft.asked().is_ok() {
        return Vec::new();
    }
    let mut entries = Vec::new();
    form::form(&mut draft, &Deviations::default()).visit(&mut |entry| {
        if let form::Content::Text { .. } = entry.content {
            entries.push((entry.path.clone(), "Text".to_owned()));
        }
    });
    entries
}

/// A link to what is asked of a device, filled in.
pub(super) fn task_link(task: Task, block: Option<u64>, mut entries: Vec<(String, String)>) -> Link {
    if let (Target::Area(Area { first: Some(first), .. }), Some(block)) = (task.target, block)
        && block != *first
    {
        entries.insert(0, ("number".to_owned(), block.to_string()));
    }
    // A job by itself: within a frame it would come with outputs of 0.
    let job = task.profile.ident.is_some();
    let protocol = Protocol::of(if job { "profibus-parameter-channel" } else { "modbus-rtu" });
    let options = Options { device: Some(task.profile), protocol, ..Options::default() };
    Link { task: Some(task.label().to_string()), entries, options, ..Link::default() }
}

/// What kind of number `spec` shows of `width` bytes.
fn kind(spec: &'static Spec, width: usize) -> String {
    let bits = format!("{} bits", 8 * width);
    match spec.format {
        Format::Float if width > 4 => "double".to_owned(),
        Format::Float => "float".to_owned(),
        Format::Text => "text".to_owned(),
        Format::Signed => format!("{bits}, signed"),
        Format::DayMonthYear => format!("{bits}, a date"),
        Format::Places(1) => format!("{bits}, 1 decimal place"),
        Format::Places(n) => format!("{bits}, {n} decimal places"),
        _ if !spec.bits.is_empty() => format!("{bits}, each with a meaning"),
        _ => bits,
    }
}

/// The allowed values.
fn limits(spec: &'static Spec) -> String {
    let Some((from, to)) = spec.limits else { return String::new() };
    let text = |raw: u64| match spec.format {
        Format::Float => float(raw, 4),
        format => number_text(raw, 2, format),
    };
    format!("{} to {}", text(from), text(to))
}

/// From so many blocks on a range is one thing to look up.
const MANY: u16 = 256;

/// The registers and parameters of a device, by their addresses.
pub(super) fn items(profile: &'static Profile) -> Vec<Item> {
    let mut items = Vec::new();
    for area in profile.areas {
        if !area.listed {
            match area.first {
                Some(first) if area.count > 1 && area.count < MANY => {
                    items.extend((0..area.count).map(|n| of_block(profile, area, first + u64::from(n))));
                }
                _ => items.push(of_area(profile, area)),
            }
        }
        let inside = |parameter: &&Parameter| (area.from..=area.last()).contains(&parameter.address);
        let named = profile.parameters().filter(inside);
        let named = in_order(named, |parameter| (parameter.address, parameter.subindex));
        items.extend(named.into_iter().map(|parameter| of_parameter(profile, parameter)));
    }
    items
}

fn of_area(profile: &'static Profile, area: &'static Area) -> Item {
    let label = if area.count > 1 { format!("{}s", area.spec.label) } else { area.spec.label.to_owned() };
    let block = if area.count > 1 { None } else { area.first };
    area_item(profile, area, (area.from, area.last()), block, label)
}

fn of_block(profile: &'static Profile, area: &'static Area, block: u64) -> Item {
    let n = block - area.first.unwrap_or_default();
    // Fewer than there are addresses, so it fits.
    let from = area.from + n as u16 * area.stride;
    let label = area.spec.numbered(Some(Numbering::At(block))).sentence();
    area_item(profile, area, (from, from + (area.stride - 1)), Some(block), label)
}

fn area_item(
    profile: &'static Profile,
    area: &'static Area,
    (from, to): (u16, u16),
    block: Option<u64>,
    label: String,
) -> Item {
    let width = area.length.unwrap_or(2) * usize::from(area.stride);
    let kind = match area.content {
        Content::Parts(parts) => {
            let width = |registers: u16| area.length.unwrap_or(2) * usize::from(registers);
            let kinds = parts.iter().map(|part| match part.spec.label {
                "Status" => "status".to_owned(),
                _ => kind(part.spec, width(part.registers)),
            });
            let mut kinds: Vec<String> = kinds.collect();
            kinds.dedup();
            kinds.join(" and ")
        }
        Content::Telegram { .. } => "a command, or a record".to_owned(),
        Content::Mapped => "as the mapping list says".to_owned(),
        Content::Value if area.in_sets => "16 or 32 bits".to_owned(),
        Content::Value => kind(&area.spec, width),
    };
    item(
        Register {
            profile,
            target: Target::Area(area),
            block,
            id: "",
            from,
            to,
            subindex: None,
            spec: &area.spec,
            kind,
            since: "",
        },
        label,
        area.also,
    )
}

fn of_parameter(profile: &'static Profile, parameter: &'static Parameter) -> Item {
    let width = parameter.length.map_or(String::new(), |length| kind(&parameter.spec, length));
    let label = parameter.spec.label.to_owned();
    item(
        Register {
            profile,
            target: Target::Parameter(parameter),
            block: None,
            id: parameter.id,
            from: parameter.address,
            to: parameter.address,
            subindex: parameter.subindex,
            spec: &parameter.spec,
            kind: width,
            since: parameter.since,
        },
        label,
        parameter.also,
    )
}

fn item(register: Register, label: String, also: &str) -> Item {
    let Register { profile, from, to, .. } = register;
    let shown = profile.address(from);
    let several = register.parts_by_subindex();
    let mut number = if from == to { shown } else { format!("{shown} to {}", profile.address(to)) };
    let mut key = super::key_of(&profile.address(from));
    if register.is_range() {
        key.push_str("-on");
    }
    if let Some(subindex) = register.subindex.filter(|_| several) {
        number.push_str(&format!("-{subindex}"));
        key.push_str(&format!("-{subindex}"));
    }
    let aliases = profile.alias(from, register.subindex.unwrap_or_default());
    let aliases = aliases.into_iter().flat_map(|alias| [alias.new, alias.old]).flatten();
    let aliases: Vec<u64> = aliases.map(u64::from).collect();
    let numbers = std::iter::once((u64::from(from), u64::from(to)));
    let mut parts: Vec<&str> = register.parts().iter().map(|part| part.spec.label).collect();
    parts.dedup();
    Item {
        book: Book::Device(profile),
        chapter: Chapter::Registers,
        key,
        number,
        label,
        numbers: numbers.chain(aliases.into_iter().map(|alias| (alias, alias))).collect(),
        names: format!("{}\n{also}\n{}", register.id, register.kind),
        notes: format!("{} {}", register.spec.note, parts.join(" ")),
        folded: String::new(),
        about: About::Register(register),
    }
}

impl Register {
    /// Whether its index has several things, told apart by their subindices.
    fn parts_by_subindex(&self) -> bool {
        let same = |parameter: &&Parameter| parameter.address == self.from && parameter.subindex > Some(0);
        self.subindex.is_some() && self.profile.parameters().any(|parameter| same(&parameter))
    }
}
