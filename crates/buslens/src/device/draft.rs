//! What to ask of a device, in its manual's words, and the registers that this is.

use super::{Access, Area, Content, Numbers, Parameter, Part, Profile, Settings, keb_f5};
use crate::field::{Argument, Message, Name, Role, Spec};
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
        let targets = self.areas.iter().map(Target::Area).chain(self.parameters().map(Target::Parameter));
        let both = |target| [Access::Read, Access::Write].map(|access| self.task(target, access));
        targets.flat_map(both).flatten().collect()
    }

    /// What is asked of one of its targets, where its table says that it can be.
    pub fn task(&'static self, target: Target, access: Access) -> Option<Task> {
        let (allowed, can_be_asked, fixed) = match target {
            // Where everything has a name of its own, the rest is nothing to ask for.
            Target::Area(area) => (area.access, !area.listed, false),
            // What can have one value only is nothing to write.
            Target::Parameter(Parameter { access, spec, .. }) => {
                (*access, true, spec.limits.is_some_and(|(least, most)| least == most))
            }
        };
        let may = allowed == access || allowed == Access::ReadWrite;
        let may = may && can_be_asked && !(fixed && access == Access::Write);
        may.then_some(Task { profile: self, target, access })
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

    /// A draft of it as a form begins: with the factory setting that the manual has, or the least that is right.
    pub fn draft(self) -> Draft {
        let number = match self.target {
            Target::Area(area) => area.first.unwrap_or_default(),
            Target::Parameter(_) => 0,
        };
        let subindex = match self.target {
            Target::Parameter(parameter) => parameter.subindex.unwrap_or_default(),
            Target::Area(_) => 0,
        };
        let reads = match self.target {
            Target::Area(Area { reads: Some(reads), .. }) => reads.initial as u16,
            Target::Area(area) => area.stride,
            Target::Parameter(_) => 1,
        };
        let content = self.content();
        Draft {
            task: self,
            number,
            count: 1,
            reads,
            subindex,
            handshake: 1,
            width: 0,
            content,
            more: Vec::new(),
        }
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

    /// Several blocks can be asked for at once.
    fn has_several(&self) -> bool {
        match self.target {
            Target::Area(area) => {
                area.count > 1 && !self.by_index() && !matches!(area.content, Content::Telegram { .. })
            }
            Target::Parameter(_) => false,
        }
    }

    /// Values of 16 or 32 bits in one address: which of them, the parameter's own length tells, or a person.
    fn has_widths(&self) -> bool {
        matches!(self.target, Target::Area(area) if area.in_sets && !self.by_index())
    }

    /// What is written.
    fn content(&self) -> Box<dyn Telegram> {
        let width = if self.has_widths() { 4 } else { self.width() };
        let numbers = |parts: &[(&'static Spec, usize)]| -> Box<dyn Telegram> {
            let mut numbers = Numbers::new(parts.iter().copied());
            numbers.values.iter_mut().zip(parts).for_each(|(value, (spec, _))| *value = spec.initial);
            Box::new(numbers)
        };
        match (self.access, self.target) {
            (Access::Write, Target::Parameter(parameter)) => numbers(&[(&parameter.spec, width)]),
            (Access::Write, Target::Area(area)) => match area.content {
                Content::Telegram { write: Some(new), .. } => new(&Settings::default()),
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
    /// How many blocks are read.
    pub count: u64,
    /// How many registers are read of what is not always read whole.
    reads: u16,
    /// For parameters asked for by index.
    pub subindex: u8,
    /// The same: a job takes another than the one before.
    pub handshake: u8,
    /// 16 or 32 bits; 0 where the parameter's own length tells.
    width: u8,
    content: Box<dyn Telegram>,
    /// What is written to the blocks behind the first.
    more: Vec<Option<Box<dyn Telegram>>>,
}

/// What a draft is in registers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Asked {
    pub access: Access,
    /// First register, or index.
    pub address: u16,
    pub subindex: u8,
    pub handshake: u8,
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
        let profile = self.task.profile;
        self.by_index()
            && match self.task.target {
                Target::Area(area) => area.in_sets,
                Target::Parameter(parameter) => {
                    parameter.subindex.is_none() && profile.has_sets(parameter.address, self.subindex)
                }
            }
    }

    /// The registers of what was filled in, or what is wrong with the number.
    pub fn asked(&mut self) -> Result<Asked, Message> {
        let address = match self.task.target {
            Target::Parameter(parameter) => parameter.address,
            Target::Area(area) => self.block(area, self.number)?,
        };
        let mut values = walk::write(self.content.as_mut(), &Deviations::default());
        for more in &mut self.more {
            let more = more.get_or_insert_with(|| self.task.content());
            values.extend(walk::write(more.as_mut(), &Deviations::default()));
        }
        let width = self.take_width(address, &mut values);
        if let Target::Area(Area { completed: Some(completed), .. }) = self.task.target {
            values = completed(&values);
        }
        while !values.len().is_multiple_of(width) {
            values.push(0);
        }
        let written = self.task.access == Access::Write;
        if written && values.is_empty() {
            return Err(message!("there is nothing to write yet"));
        }
        let count = match self.task.target {
            _ if written => values.len() / width,
            Target::Parameter(_) => 1,
            Target::Area(area) if self.task.has_several() => {
                self.block(area, self.number.saturating_add(self.count.max(1)) - 1)?;
                usize::from(area.stride) * self.count.max(1) as usize
            }
            Target::Area(_) => self.reads.into(),
        };
        if let (Target::Area(area), true) = (self.task.target, written && self.task.has_several()) {
            let blocks = count.div_ceil(area.stride.into()) as u64;
            self.block(area, self.number.saturating_add(blocks) - 1)?;
        }
        let Self { subindex, handshake, .. } = *self;
        Ok(Asked { access: self.task.access, address, subindex, handshake, count, width, values })
    }

    /// Bytes of a register here; the values lose what is too much of them.
    fn take_width(&self, address: u16, values: &mut Vec<u8>) -> usize {
        if !self.task.has_widths() {
            return self.task.width();
        }
        let own = self.task.profile.named(address, None).and_then(|parameter| parameter.length);
        // A value that fits into neither 16 bits nor its own sign needs 32.
        let fits = values.chunks(4).all(|value| {
            matches!(value, [0, 0, ..]) || matches!(value, [0xFF, 0xFF, high, _] if high & 0x80 != 0)
        });
        let long = match (self.width, own) {
            (16, _) => false,
            (32, _) => true,
            (_, own) => own == Some(4) || !fits,
        };
        if !long {
            *values = values.chunks(4).flat_map(|value| value.iter().skip(2)).copied().collect();
        }
        if long { 4 } else { 2 }
    }

    /// Where the block of this number begins.
    fn block(&self, area: &Area, number: u64) -> Result<u16, Message> {
        let first = area.first.unwrap_or_default();
        let last = first + u64::from(area.count) - 1;
        let place = number.checked_sub(first).filter(|_| number <= last);
        match place.and_then(|place| u16::try_from(place).ok()) {
            Some(place) => Ok(area.from + place * area.stride),
            None => Err(message!(
                "{label} {number} does not exist: there are {first} to {last}",
                label = Argument::Term(area.spec.label),
                number = number,
                first = first,
                last = last
            )),
        }
    }
}

impl Telegram for Draft {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        let written = self.task.access == Access::Write;
        if let Target::Area(area) = self.task.target {
            if area.first.is_some() {
                w.u64(&NUMBER, &mut self.number)?;
            }
            if self.task.has_several() && !written {
                w.u64(&COUNT, &mut self.count)?;
            }
            if let Some(reads) = area.reads.filter(|reads| reads.names.len() > 1 && !written) {
                w.u16(reads, &mut self.reads)?;
            }
        }
        if self.task.has_widths() {
            w.u8(&WIDTH, &mut self.width)?;
        }
        if self.has_sets() {
            w.u8(&SETS, &mut self.subindex)?;
        }
        if self.by_index() {
            w.u8(&HANDSHAKE, &mut self.handshake)?;
        }
        w.within(&CONTENT, &mut |w| self.content.walk(w))?;
        if !(written && self.task.has_several()) {
            return Ok(());
        }
        let (task, count) = (self.task, self.more.len());
        w.list(&MORE, &mut self.more, count, Some(self.number.saturating_add(1)), |w, more| {
            let more = more.get_or_insert_with(|| task.content());
            w.within(&CONTENT, &mut |w| more.walk(w))
        })
    }
}

static NUMBER: Spec =
    Spec::new("number", "Number").role(Role::Address).note("Which one, as the manual counts them.");

static COUNT: Spec =
    Spec::new("count", "How many").role(Role::Count).initial(1).note("So many, one behind the other.");

static WIDTH: Spec = Spec::new("width", "Length")
    .role(Role::Count)
    .names(&[
        Name {
            value: 0,
            label: "as the parameter has it",
            note: "32 bits where the manual or the value says so.",
        },
        Name { value: 16, label: "16 bits", note: "" },
        Name { value: 32, label: "32 bits", note: "By functions 100 and 101." },
    ])
    .note("Parameters of 32 bits are reached by functions 100 and 101 only.");

static SETS: Spec = Spec::new("subindex", "Sets")
    .role(Role::Address)
    .bits(&keb_f5::SETS)
    .note("The sets that are meant, one bit for each; 0 for the set that Fr.09 chooses.");

static HANDSHAKE: Spec = Spec::new("handshake", "Handshake")
    .role(Role::Function)
    .limits(0, 1)
    .initial(1)
    .names(&[Name { value: 0, label: "0", note: "" }, Name { value: 1, label: "1", note: "" }])
    .note("The other one than the job before had: by that the slave knows that it is a new job.");

static CONTENT: Spec = Spec::new("content", "Content").note("What is written.");

static MORE: Spec =
    Spec::new("more", "More in the same telegram").note("What those that follow the first are set to.");
