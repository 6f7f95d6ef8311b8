//! What to ask of a device, in its manual's words, and the registers that this is.

use super::{Access, Area, Content, Numbers, Parameter, Part, Profile, keb_f5};
use crate::field::{Argument, Message, Role, Spec};
use crate::message;
use crate::walk::{self, Deviations, Telegram, Walk, Walker};

/// Something that can be asked of a device: "write a universal channel".
#[derive(Clone, Copy, Debug)]
pub struct Task {
    pub profile: &'static Profile,
    pub target: Target,
    /// [`Access::Read`] or [`Access::Write`].
    pub access: Access,
}

/// What is read or written.
#[derive(Clone, Copy, Debug)]
pub enum Target {
    Area(&'static Area),
    Parameter(&'static Parameter),
}

impl Profile {
    /// Everything that its table says can be asked of the device.
    pub fn tasks(&'static self) -> Vec<Task> {
        let areas = self.areas.iter().map(|area| (Target::Area(area), area.access));
        let parameters = self.parameters().map(|it| (Target::Parameter(it), it.access));
        let mut tasks = Vec::new();
        for (target, allowed) in areas.chain(parameters) {
            for access in [Access::Read, Access::Write] {
                if allowed == access || allowed == Access::ReadWrite {
                    tasks.push(Task { profile: self, target, access });
                }
            }
        }
        tasks
    }
}

impl Task {
    /// "Write universal channel"; with its addresses where several areas hold the same thing.
    pub fn label(&self) -> Message {
        let what = match self.target {
            Target::Area(area) => {
                let label = Argument::Term(area.spec.label);
                let alike = self.profile.areas.iter().filter(|other| other.spec.label == area.spec.label);
                match alike.count() {
                    1 => Message::term(area.spec.label),
                    _ => message!(
                        "{label} at {from} to {to}",
                        label = label,
                        from = self.profile.address(area.from),
                        to = self.profile.address(area.last())
                    ),
                }
            }
            Target::Parameter(Parameter { id: "", spec, .. }) => Message::term(spec.label),
            Target::Parameter(parameter) => message!(
                "{label} ({id})",
                label = Argument::Term(parameter.spec.label),
                id = parameter.id.to_owned()
            ),
        };
        match self.access {
            Access::Write => message!("write {what}", what = what),
            _ => message!("read {what}", what = what),
        }
    }

    /// A draft of it with nothing filled in.
    pub fn draft(self) -> Draft {
        let number = match self.target {
            Target::Area(area) => area.first.unwrap_or_default(),
            Target::Parameter(_) => 0,
        };
        let subindex = match self.target {
            Target::Parameter(parameter) => parameter.subindex.unwrap_or_default(),
            Target::Area(_) => 0,
        };
        let content = self.content();
        Draft { task: self, number, subindex, content }
    }

    /// Bytes of a register, or of the parameter's value.
    fn width(&self) -> usize {
        match self.target {
            Target::Area(Area { length: Some(length), .. }) => *length,
            Target::Parameter(parameter) if self.by_index() => parameter.length.unwrap_or(4),
            Target::Area(_) if self.by_index() => 4,
            // Only services for 32 bits reach more than two bytes in one address.
            Target::Parameter(Parameter { length: Some(length @ 4..), .. }) => *length,
            _ => 2,
        }
    }

    /// Parameters are asked for by index and subindex, not as registers.
    fn by_index(&self) -> bool {
        self.profile.ident.is_some()
    }

    /// What is written.
    fn content(&self) -> Box<dyn Telegram> {
        let width = self.width();
        let numbers = |parts: &[(&'static Spec, usize)]| -> Box<dyn Telegram> {
            Box::new(Numbers::new(parts.iter().copied()))
        };
        match (self.access, self.target) {
            (Access::Write, Target::Parameter(parameter)) => numbers(&[(&parameter.spec, width)]),
            (Access::Write, Target::Area(area)) => match area.content {
                Content::Telegram { write: Some(new), .. } => new(),
                Content::Parts(parts) => {
                    let part = |part: &Part| (part.written, width * usize::from(part.registers));
                    numbers(&parts.iter().map(part).collect::<Vec<_>>())
                }
                _ => numbers(&[(&area.spec, width * usize::from(area.stride))]),
            },
            _ => numbers(&[]),
        }
    }
}

/// A task while it is filled in. Its form has the number of the block, then what is written.
pub struct Draft {
    task: Task,
    /// Of the block, in the manual's words: channel 6.
    pub number: u64,
    /// For parameters asked for by index.
    pub subindex: u8,
    content: Box<dyn Telegram>,
}

/// What a draft is in registers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Asked {
    pub access: Access,
    /// First register, or index.
    pub address: u16,
    pub subindex: u8,
    /// Registers; 1 for a parameter asked for by index.
    pub count: usize,
    /// Bytes of a register, or of the parameter.
    pub width: usize,
    /// What is written, whole registers; empty for reading.
    pub values: Vec<u8>,
}

impl Draft {
    /// Parameters are asked for by index and subindex, not as registers.
    pub fn by_index(&self) -> bool {
        self.task.by_index()
    }

    /// Inverter parameters asked for by index are meant in sets.
    fn has_sets(&self) -> bool {
        let address = match self.task.target {
            Target::Area(area) => area.from,
            Target::Parameter(Parameter { subindex: Some(_), .. }) => return false,
            Target::Parameter(parameter) => parameter.address,
        };
        self.by_index() && keb_f5::INVERTER_INDICES.contains(&address)
    }

    /// The registers of what was filled in, or what is wrong with the number.
    pub fn asked(&mut self) -> Result<Asked, Message> {
        let width = self.task.width();
        let mut values = walk::write(self.content.as_mut(), &Deviations::default());
        while !values.len().is_multiple_of(width) {
            values.push(0);
        }
        let written = self.task.access == Access::Write;
        if written && values.is_empty() {
            return Err(message!("there is nothing to write yet"));
        }
        let (address, count) = match self.task.target {
            Target::Parameter(parameter) => (parameter.address, 1),
            Target::Area(area) => (self.block(area)?, area.stride.into()),
        };
        let count = if written { values.len() / width } else { count };
        Ok(Asked { access: self.task.access, address, subindex: self.subindex, count, width, values })
    }

    /// Where the block of this number begins.
    fn block(&self, area: &Area) -> Result<u16, Message> {
        let first = area.first.unwrap_or_default();
        let last = first + u64::from(area.count) - 1;
        let place = self.number.checked_sub(first).filter(|_| self.number <= last);
        match place.and_then(|place| u16::try_from(place).ok()) {
            Some(place) => Ok(area.from + place * area.stride),
            None => Err(message!(
                "{label} {number} does not exist: there are {first} to {last}",
                label = Argument::Term(area.spec.label),
                number = self.number,
                first = first,
                last = last
            )),
        }
    }
}

impl Telegram for Draft {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        if let Target::Area(Area { first: Some(_), .. }) = self.task.target {
            w.u64(&NUMBER, &mut self.number)?;
        }
        if self.has_sets() {
            w.u8(&SETS, &mut self.subindex)?;
        }
        w.within(&CONTENT, &mut |w| self.content.walk(w))
    }
}

static NUMBER: Spec =
    Spec::new("number", "Number").role(Role::Address).note("Which one, as the manual counts them.");

static SETS: Spec = Spec::new("subindex", "Sets")
    .role(Role::Address)
    .bits(&keb_f5::SETS)
    .note("The sets that are meant, one bit for each; 0 for the set that Fr.09 chooses.");

static CONTENT: Spec = Spec::new("content", "Content").note("What is written.");
