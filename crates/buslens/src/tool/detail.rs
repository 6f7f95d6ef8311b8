use super::decode::Report;
use crate::device::{self, Process, Profile, Registers, Said};
use crate::field::{self, Check, Direction, Field, Message, Order, Problem, Span, Spec, Value, hex_value};
use crate::frame::{Content, Verdict};
use crate::message;
use crate::modbus::{Access, EXCEPTION, Pdu, Server};
use crate::profibus::jobs::{State, Step};
use crate::profibus::{Body, Channel, Service, Side};

/// Everything about one telegram.
#[derive(Clone, Debug, PartialEq)]
pub struct Detail {
    /// The tree; its leaves tile the bytes.
    pub fields: Vec<Field>,
    /// What the telegram says, as if its check were right.
    pub said: Message,
    pub verdict: Verdict,
    /// What kind of telegram it is: "Read holding registers, function 3".
    pub kind: Message,
    /// What the kind is about, for newcomers, and where it is described.
    pub note: &'static str,
    pub source: &'static str,
    pub unit: Option<u8>,
    /// Without the exception bit.
    pub function: Option<u8>,
    pub exception: Option<u8>,
    pub start: Option<u16>,
    pub count: Option<usize>,
    pub values: Vec<u32>,
    /// The values are bits: coils or discrete inputs.
    pub coils: bool,
    /// Where 16-bit registers or words of process data stand in it.
    pub registers: Option<Span>,
    /// The parameter channel in it.
    pub channel: Option<Channel>,
    /// What it is for a job of the parameter channel.
    pub step: Option<Step>,
    /// What the device's manual says about it.
    pub device: Said,
}

impl Detail {
    /// The telegram in one sentence, with what its check makes of it.
    pub fn meaning(&self) -> Message {
        match self.verdict {
            Verdict::Right | Verdict::NoCheck => self.said.clone(),
            Verdict::Wrong => message!("{said}, but the check does not match", said = self.said.clone()),
            Verdict::Unchecked => message!("the beginning of a telegram: too short to say what it means"),
        }
    }

    /// The problems of all fields, in their order, and then those that the device would have.
    pub fn problems(&self) -> Vec<&Problem> {
        let mut problems = field::problems(&self.fields);
        problems.extend(self.step.iter().flat_map(|step| &step.problems));
        problems.extend(self.device.problems());
        problems
    }

    /// The check bytes, where the telegram is long enough to have some.
    pub fn check(&self) -> Option<Check> {
        field::leaves(&self.fields).into_iter().find_map(|leaf| match leaf.value {
            Value::Check(check) => Some(check),
            _ => None,
        })
    }
}

impl Report {
    /// Reads the fields of telegram `index`.
    pub fn detail(&self, index: usize) -> Option<Detail> {
        let telegram = self.telegrams.get(index)?;
        let (frame, reading) = self.read(index);
        let bytes = &telegram.line.bytes;
        let mut detail = Detail {
            said: frame.meaning(),
            verdict: telegram.verdict,
            kind: message!("a telegram"),
            note: "",
            source: "",
            unit: None,
            function: None,
            exception: None,
            start: None,
            count: None,
            values: Vec::new(),
            coils: false,
            registers: None,
            channel: None,
            step: None,
            device: Said::default(),
            fields: reading.fields,
        };
        let device = self.options.device.map(|profile| (profile, &self.settings(index).device));
        match frame.content() {
            Content::Modbus { server, pdu } => {
                if let Some((profile, settings)) = device {
                    detail.ask_registers(profile, settings, pdu);
                }
                detail.unit = server.unit().filter(|_| !bytes.is_empty());
                detail.tell_pdu(server, pdu);
                detail.registers = detail.register_place(pdu);
            }
            Content::Profibus { slave, kind, body } => {
                detail.step = telegram.step.clone().map(|step| detail.placed(step, bytes.len()));
                if let Some((profile, settings)) = device {
                    let who = match slave {
                        Some(slave) => message!("station {n}", n = slave),
                        None => message!("the slave"),
                    };
                    detail.ask_parameters(profile, settings, &who, body, bytes);
                }
                detail.unit = slave;
                detail.registers = detail.place(|spec| ["outputs", "inputs"].contains(&spec.key));
                detail.tell_service(&kind.spec, body);
            }
            Content::Nothing(spec) => detail.tell_kind(spec, Message::term(spec.label)),
        }
        Some(detail)
    }
}

impl Detail {
    /// Asks the device's table for the registers of a PDU.
    fn ask_registers(&mut self, profile: &'static Profile, settings: &device::Settings, pdu: &Pdu) {
        let function = pdu.function & !EXCEPTION;
        if !profile.functions.is_empty() && !profile.functions.contains(&function) {
            let span = self.place(|spec| spec.label == "Function code").unwrap_or_default();
            let message = message!("the device's manual does not list function {f}", f = function);
            self.device.problems.push(Problem::warning("function-not-listed", span, message));
        }
        let registers = |access: &Access<'_>| access.start.is_some() && !access.table.holds_switches();
        let Some(access) = pdu.body.access().filter(registers) else { return };
        let values = big_endian(&access, self.given(&access).unwrap_or_default().len());
        let said = profile.registers(&self.device_registers(&access, &values), settings);
        self.device.problems.extend(said.problems);
        self.device.blocks = said.blocks;
    }

    /// Asks the device's table for the parameter and the process data of a telegram, and says it in
    /// the device's words.
    fn ask_parameters(
        &mut self,
        profile: &'static Profile,
        settings: &device::Settings,
        who: &Message,
        body: &dyn Body,
        bytes: &[u8],
    ) {
        let mut said = None;
        if let Some(channel) = body.channel() {
            let parameter = self.ask_parameter(profile, channel);
            said = Some(channel_sentence(channel, who, parameter.sentence()));
            self.device.blocks.extend(parameter.blocks);
        }
        if let Some(process) = body.process() {
            let output = process.side == Side::Outputs;
            let place = if output { "Outputs" } else { "Inputs" };
            let span = self.place(|spec| spec.label == place).unwrap_or_default();
            let order = if process.swapped { Order::Little } else { Order::Big };
            let process = Process { output, bytes: span.of(bytes), span, order };
            let words = profile.process(&process, settings);
            if let Some(things) = words.sentence() {
                let things = match output {
                    true => message!("outputs: {things}", things = things),
                    false => message!("inputs: {things}", things = things),
                };
                said = Some(match said {
                    Some(said) => message!("{said}; {things}", said = said, things = things),
                    None => message!("{who}, {things}", who = who.clone(), things = things),
                });
            }
            self.device.blocks.extend(words.blocks);
        }
        if let Some(said) = said {
            self.said = said;
        }
    }

    /// Where the values of a PDU stand that are no coils.
    fn register_place(&self, pdu: &Pdu) -> Option<Span> {
        let access = pdu.body.access().filter(|access| !access.table.holds_switches())?;
        self.given(&access).filter(|span| span.len() >= 2)
    }

    fn ask_parameter(&self, profile: &'static Profile, channel: &Channel) -> Said {
        let access = match channel.service() {
            Service::None => return Said::default(),
            Service::Write => device::Access::Write,
            Service::Read | Service::Both => device::Access::Read,
        };
        let place = self.place(|spec| spec.label == "Value").unwrap_or_default();
        // A value that the telegram ends in is none.
        let value = channel.length().zip(channel.value()).filter(|(length, _)| *length == place.len());
        let value = value.map(|(length, value)| Order::Big.bytes(value.into(), length));
        let index = || self.place(|spec| spec.label == "Index").unwrap_or_default();
        let span = if value.is_some() { place } else { index() };
        let value = value.as_deref().map(|value| (value, Order::Big));
        profile.parameter(channel.index, channel.subindex, access, value, span)
    }

    /// A step whose problems stand where the parameter channel does in the telegram, as far as its
    /// `length` bytes go.
    fn placed(&self, mut step: Step, length: usize) -> Step {
        let channel = self.place(|spec| spec.label == "Parameter channel").unwrap_or_default();
        for problem in &mut step.problems {
            problem.span = problem.span.shifted(channel.from).within(length);
        }
        step
    }

    /// Where the first field of such a spec stands. The page that shows telegrams has no keys: labels tell.
    fn place(&self, wanted: impl Fn(&'static Spec) -> bool) -> Option<Span> {
        place(&self.fields, wanted)
    }

    /// The kind of the telegram; what it says where it ends too early.
    fn tell_kind(&mut self, spec: &'static Spec, kind: Message) {
        if let Some(label) = missing(&self.fields) {
            self.said = message!(
                "{kind}, cut off: {label} is incomplete",
                kind = field::Argument::Term(spec.label),
                label = label
            );
        }
        self.kind = kind;
        self.note = spec.note;
        self.source = spec.source;
    }

    /// What a telegram of a PROFIBUS service says.
    fn tell_service(&mut self, spec: &'static Spec, body: &dyn Body) {
        if let Some(step) = &self.step {
            let (job, said) = (step.job, self.said.clone());
            self.said = match step.state {
                State::Asked => message!("job {job}: {said}", job = job, said = said),
                State::Running => {
                    message!(
                        "job {job} is still running, this is from before: {said}",
                        job = job,
                        said = said
                    )
                }
                State::Done => message!("job {job} is done: {said}", job = job, said = said),
                State::Failed => message!("job {job} failed: {said}", job = job, said = said),
            };
        }
        self.channel = body.channel().cloned();
        self.values.extend(self.channel.as_ref().and_then(Channel::value));
        self.tell_kind(spec, Message::term(spec.label));
    }

    /// What a PDU says.
    fn tell_pdu(&mut self, server: Server, pdu: &Pdu) {
        let spec = &pdu.kind.spec;
        let access = pdu.body.access();
        let write = access.is_some_and(|access| access.write);
        // What is written without values, or besides reading, says more by itself.
        let plain = access.is_none_or(|access| {
            access.reads.is_none()
                && (pdu.direction == Direction::Response || !write || !access.values.is_empty())
        });
        if let (Some(things), false) = (self.device.sentence(), plain) {
            self.said = message!("{said} ({things})", said = self.said.clone(), things = things);
        } else if let Some(things) = self.device.sentence() {
            let who = server.name();
            self.said = match (pdu.direction, write) {
                (Direction::Request, false) => message!("ask {who} for {things}", who = who, things = things),
                (Direction::Request, true) => {
                    message!("write to {who}: {things}", who = who, things = things)
                }
                (Direction::Response, false) => {
                    message!("{who} answers: {things}", who = who, things = things)
                }
                (Direction::Response, true) => {
                    message!("{who} confirms what it wrote: {things}", who = who, things = things)
                }
            };
        }
        let function = has_function(&self.fields).then_some(pdu.function);
        self.tell_kind(spec, kind_name(spec.label, function));
        self.function = function.map(|function| function & !EXCEPTION);
        self.exception = pdu.body.exception();
        self.start = access.and_then(|access| access.start);
        self.coils = access.is_some_and(|access| access.table.holds_switches());
        self.count = access.map(|access| access.count);
        self.values = access.map_or(Vec::new(), |access| self.whole_values(&access).to_vec());
    }

    /// Registers as a device's table takes them: with the place of their values in the telegram, or of
    /// what names them.
    fn device_registers<'a>(&self, access: &Access<'_>, values: &'a [u8]) -> Registers<'a> {
        let table = access.table;
        let given = self.given(access).filter(|_| !access.values.is_empty());
        let span = given.or(self.place(|spec| std::ptr::eq(spec, &table.start))).unwrap_or_default();
        Registers {
            start: access.start.unwrap_or_default(),
            count: access.count,
            width: table.width,
            access: if access.write { device::Access::Write } else { device::Access::Read },
            values: given.is_some().then_some(values),
            span,
        }
    }

    /// The values whose bytes are all there: the value that a telegram ends in is none.
    fn whole_values<'a>(&self, access: &Access<'a>) -> &'a [u32] {
        match self.given(access) {
            Some(span) if !access.table.holds_switches() => {
                &access.values[..access.values.len().min(span.len() / access.table.width)]
            }
            _ => access.values,
        }
    }

    /// Where the values of a PDU stand.
    fn given(&self, access: &Access<'_>) -> Option<Span> {
        let of = |wanted: &'static Spec| self.place(|spec| std::ptr::eq(spec, wanted));
        of(&access.table.values).or(of(&access.table.value))
    }
}

/// What a parameter channel says, with the device's words for the parameter.
fn channel_sentence(channel: &Channel, who: &Message, things: Option<Message>) -> Message {
    let plain = channel.meaning(who.clone());
    let (Some(things), who) = (things, who.clone()) else { return plain };
    match (channel.direction, channel.service()) {
        _ if channel.refusal().is_some() => message!("{plain} ({things})", plain = plain, things = things),
        (Direction::Request, Service::Read) => message!("ask {who} for {things}", who = who, things = things),
        (Direction::Request, Service::Write) => {
            message!("write to {who}: {things}", who = who, things = things)
        }
        (Direction::Response, Service::Read) => {
            message!("{who} answers: {things}", who = who, things = things)
        }
        (Direction::Response, Service::Write) => {
            message!("{who} confirms what it wrote: {things}", who = who, things = things)
        }
        (_, Service::None | Service::Both) => plain,
    }
}

/// Where the first field of such a spec stands.
fn place(fields: &[Field], wanted: impl Fn(&'static Spec) -> bool) -> Option<Span> {
    let mut span = None;
    for field in fields {
        field.visit(&mut |field| {
            if wanted(field.spec) {
                span = span.or(Some(field.span));
            }
        });
    }
    span
}

/// Whether the function code was read.
fn has_function(fields: &[Field]) -> bool {
    field::leaves(fields).iter().any(|leaf| matches!(leaf.value, Value::Selector { .. }))
}

/// The values of registers as bytes, high byte first: those of the telegram, which has `length` of them.
fn big_endian(access: &Access<'_>, length: usize) -> Vec<u8> {
    let width = access.table.width;
    // A part of a value that comes low word first is not the first part of it.
    let length = if access.table.value.order == Order::Big { length } else { length / width * width };
    let bytes = access.values.iter().flat_map(|value| value.to_be_bytes().into_iter().skip(4 - width));
    bytes.take(length).collect()
}

/// The first field, items of lists aside, that the telegram ends before.
fn missing(fields: &[Field]) -> Option<Message> {
    fields.iter().find(|field| matches!(field.value, Value::Missing { .. })).map(Field::label)
}

fn kind_name(label: &'static str, function: Option<u8>) -> Message {
    let Some(function) = function else { return message!("no function code yet") };
    let plain = function & !EXCEPTION;
    let label = field::Argument::Term(label);
    match (function & EXCEPTION != 0, plain) {
        (true, _) => message!("{label} to function {plain}", label = label, plain = plain),
        (false, 0..=9) => message!("{label}, function {plain}", label = label, plain = plain),
        (false, _) => message!(
            "{label}, function {plain} ({hex})",
            label = label,
            plain = plain,
            hex = hex_value(plain.into(), 1)
        ),
    }
}
