use std::borrow::Cow;

use super::blocks::{BlockReading, blocks};
use super::decode::Report;
use crate::device::{self, PROFILES, Process, Profile, Registers, Said};
use crate::dialogue::Certainty;
use crate::field::{self, Check, Direction, Field, Message, Order, Problem, Span, Spec, Value, hex_value};
use crate::frame::{Content, Verdict};
use crate::message;
use crate::modbus::{Access, DIALECTS, Dialect, EXCEPTION, Pdu, Server, exceptions};
use crate::profibus::jobs::{State, Step};
use crate::profibus::{Body, Channel, Service, Side, parameter_channel};
use crate::walk;

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
    /// It writes what it names.
    pub writes: bool,
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
    fn new(said: Message, verdict: Verdict, kind: Message, fields: Vec<Field>) -> Self {
        Self {
            said,
            verdict,
            kind,
            note: "",
            source: "",
            unit: None,
            function: None,
            exception: None,
            start: None,
            count: None,
            values: Vec::new(),
            coils: false,
            writes: false,
            registers: None,
            channel: None,
            step: None,
            device: Said::default(),
            fields,
        }
    }

    /// The telegram in one sentence, with what its check makes of it.
    pub fn meaning(&self) -> Cow<'_, Message> {
        Cow::Owned(match self.verdict {
            Verdict::Right | Verdict::NoCheck => return Cow::Borrowed(&self.said),
            Verdict::Wrong => message!("{said}, but the checksum is wrong", said = self.said.clone()),
            Verdict::Unchecked => message!("the beginning of a telegram: too short to say what it means"),
        })
    }

    /// The problems of all fields, in their order, and then those that the device would have.
    pub fn problems(&self) -> Vec<&Problem> {
        let mut problems = field::problems(&self.fields);
        problems.extend(self.step.iter().flat_map(|step| &step.problems));
        problems.extend(self.device.problems());
        problems
    }

    /// Whether a field of this label has this value.
    pub(super) fn fields_hold(&self, label: &str, value: Option<u64>) -> bool {
        let of = |field: &Field| field.spec.label == label && field.value.raw() == value;
        value.is_some() && field::find(&self.fields, &mut |field| of(field).then_some(())).is_some()
    }

    /// The check bytes, where the telegram is long enough to have some.
    pub fn check(&self) -> Option<Check> {
        field::find(&self.fields, &mut |field| match field.value {
            Value::Check(check) => Some(check),
            _ => None,
        })
    }
}

impl Report {
    /// Reads the fields of telegram `index`.
    pub fn detail(&self, index: usize) -> Option<Detail> {
        let telegram = self.telegrams.get(index)?;
        if let Some(block) = self.block(index) {
            return Some(Detail::of_block(block));
        }
        let (frame, reading) = self.read(index);
        let bytes = &telegram.line.bytes;
        let mut detail =
            Detail::new(frame.meaning(), telegram.verdict, message!("a telegram"), reading.fields);
        let device = self.device(index).map(|profile| (profile, &self.settings(index).device));
        if let Content::Profibus { body, .. } = frame.content()
            && let Some(channel) = body.channel()
        {
            let sets = match device {
                Some((profile, _)) if profile.ident.is_some() => {
                    profile.has_sets(channel.index, channel.subindex)
                }
                _ => parameter_channel::has_sets(channel.index),
            };
            refine(&mut detail.fields, parameter_channel::subindex_spec(sets));
        }
        match frame.content() {
            Content::Modbus { server, pdu } => {
                if let Some((profile, settings)) = device {
                    detail.ask_registers(profile, settings, pdu);
                }
                detail.unit = server.unit().filter(|_| !bytes.is_empty());
                detail.tell_pdu(server, pdu);
                detail.device.problems.extend(self.other_layout(index, pdu, &detail.fields));
                if let Some(code) = pdu.body.exception() {
                    let asked = telegram.answers.and_then(|request| self.detail(request));
                    detail.tell_refusal(server, code, asked, device.map(|(profile, _)| profile));
                }
                detail.registers = detail.register_place(pdu);
                if let Some(block) = self.unasked(index, pdu) {
                    detail.tell_unasked(server, block);
                }
            }
            Content::Profibus { slave, kind, body } => {
                detail.step = telegram.step.clone().map(|step| detail.placed(step, bytes.len()));
                if let Some((profile, settings)) = device {
                    let who = match slave {
                        Some(slave) => message!("station {n}", n = slave),
                        None => message!("the slave"),
                    };
                    // What is only looked at is no job.
                    let looked_at = kind.sap.is_some() && kind.direction == Direction::Response;
                    detail.ask_parameters(profile, settings, &who, (body, looked_at), bytes);
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

impl Report {
    /// What the bytes of "telegram" `index` are, where they are none but a block of registers by itself.
    pub fn block(&self, index: usize) -> Option<BlockReading> {
        let telegram = &self.telegrams[index];
        let device = self.device(index)?;
        let plain = matches!(telegram.verdict, Verdict::Wrong | Verdict::Unchecked);
        let alone = telegram.answers.is_none() && telegram.guess.certainty != Certainty::Certain;
        if !plain || self.options.protocol.is_some() || !(alone || telegram.unit == Some(0)) {
            return None;
        }
        let best = blocks(&telegram.line.bytes, Some(device), self.settings(index)).into_iter().next()?;
        (best.certainty == Certainty::Likely).then_some(best)
    }

    /// What a response holds that says of no registers it is.
    fn unasked(&self, index: usize, pdu: &Pdu) -> Option<BlockReading> {
        let access = pdu
            .body
            .access()
            .filter(|access| !access.write && access.start.is_none() && !access.table.holds_switches())?;
        let best = blocks(&big_endian(&access, usize::MAX), Some(self.device(index)?), self.settings(index))
            .into_iter()
            .next()?;
        (best.certainty == Certainty::Likely).then_some(best)
    }

    /// The layout that would make right what is wrong with a telegram of functions that have several.
    fn other_layout(&self, index: usize, pdu: &Pdu, fields: &[Field]) -> Option<Problem> {
        let telegram = &self.telegrams[index];
        let by_itself = |problem: &&Problem| problem.code != "not-as-asked";
        let wrong = field::problems(fields).into_iter().any(|problem| by_itself(&problem));
        if !wrong || telegram.verdict == Verdict::Wrong {
            return None;
        }
        let direction = telegram.guess.direction;
        let has = |dialect: &&&'static Dialect| {
            dialect.kinds.iter().any(|kind| (kind.function, kind.direction) == (pdu.function, direction))
        };
        let mut settings = self.settings(index).frame.clone();
        let others = DIALECTS.iter().filter(has).filter(|other| other.key != settings.dialect.key);
        let right = others.copied().find(|other| {
            settings.dialect = other;
            let bytes = &telegram.line.bytes;
            let mut frame = (telegram.choice.protocol.expect)(bytes, direction, &settings);
            field::problems(&walk::read(frame.as_mut(), bytes).fields).is_empty()
        })?;
        let span = Span::new(0, telegram.line.bytes.len());
        let message = message!(
            "laid out as “{layout}” it would be right: set that under Devices if the device speaks so",
            layout = field::Argument::Term(right.label)
        );
        Some(Problem::warning("other-layout", span, message))
    }
}

impl Detail {
    /// What there is to say of a block by itself.
    fn of_block(block: BlockReading) -> Self {
        let said = message!("{kind} by itself: {said}", kind = block.kind.clone(), said = block.said);
        Self {
            note: "A block without a frame: its address, and whose it is, the bytes do not tell.",
            ..Self::new(said, Verdict::NoCheck, block.kind, block.fields)
        }
    }

    /// What a response says whose request is not here.
    fn tell_unasked(&mut self, server: Server, block: BlockReading) {
        self.said = message!(
            "{who} answers, to a request that is not here: {said} ({kind})",
            who = server.name(),
            said = block.said,
            kind = small(block.kind)
        );
    }

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
        let said = profile.registers(&self.device_registers(&access, pdu.is_single(), &values), settings);
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
        (body, looked_at): (&dyn Body, bool),
        bytes: &[u8],
    ) {
        let mut said = None;
        if let Some(channel) = body.channel().filter(|_| !looked_at) {
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
                    None if looked_at => message!("{who} has {things}", who = who.clone(), things = things),
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
                        "job {job} is still running; the slave still shows its previous state: {said}",
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

    /// What a server refuses to do, in the device's words, and why.
    fn tell_refusal(
        &mut self,
        server: Server,
        code: u8,
        asked: Option<Self>,
        profile: Option<&'static Profile>,
    ) {
        let named = |spec: &'static Spec| spec.name(code.into());
        let own = profile.and_then(|profile| profile.exceptions).filter(|spec| named(spec).is_some());
        let standard = exceptions().iter().find(|name| name.value == u64::from(code));
        if let Some(spec) = own {
            refine(&mut self.fields, spec);
        }
        let hex = hex_value(code.into(), 1);
        let name = own.and_then(named).or(standard);
        let why = match (name, profile) {
            (Some(name), _) => {
                message!("exception {code}, {name}", code = code, name = field::Argument::Term(name.label))
            }
            (None, Some(_)) => {
                message!(
                    "exception {code} ({hex}), which neither the standard nor the manual defines",
                    code = code,
                    hex = hex
                )
            }
            (None, None) => {
                let others = PROFILES.iter().filter_map(|other| Some((other, named(other.exceptions?)?)));
                match others.into_iter().next() {
                    Some((other, name)) => message!(
                        "exception {code} ({hex}), which the standard does not define; of a {device} it is: {name}",
                        code = code,
                        hex = hex,
                        device = field::Argument::Term(other.label),
                        name = field::Argument::Term(name.label)
                    ),
                    None => message!(
                        "exception {code} ({hex}), which the standard does not define",
                        code = code,
                        hex = hex
                    ),
                }
            }
        };
        let who = server.name();
        let things = asked.as_ref().and_then(|asked| asked.device.sentence());
        self.said = match (things, asked.as_ref().is_some_and(|asked| asked.writes)) {
            (Some(things), false) => {
                message!("{who} rejects reading {things}: {why}", who = who, things = things, why = why)
            }
            (Some(things), true) => {
                message!("{who} rejects writing {things}: {why}", who = who, things = things, why = why)
            }
            (None, _) => message!("{who} rejects the request: {why}", who = who, why = why),
        };
        // What the manual had to say of the request is why.
        if let Some(problem) = asked.as_ref().and_then(|asked| asked.device.problems().next()) {
            self.said = message!(
                "{said}; of the request: {problem}",
                said = self.said.clone(),
                problem = problem.message.clone()
            );
        }
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
                    message!("{who} confirms the write: {things}", who = who, things = things)
                }
            };
        }
        let function = has_function(&self.fields).then_some(pdu.function);
        self.tell_kind(spec, kind_name(spec.label, function));
        self.function = function.map(|function| function & !EXCEPTION);
        self.exception = pdu.body.exception();
        self.start = access.and_then(|access| access.start);
        self.writes = write;
        self.coils = access.is_some_and(|access| access.table.holds_switches());
        self.count = access.map(|access| access.count);
        self.values = access.map_or(Vec::new(), |access| self.whole_values(&access).to_vec());
    }

    /// Registers as a device's table takes them: with the place of their values in the telegram, or of
    /// what names them.
    fn device_registers<'a>(&self, access: &Access<'_>, single: bool, values: &'a [u8]) -> Registers<'a> {
        let table = access.table;
        let given = self.given(access).filter(|_| !access.values.is_empty());
        let span = given.or(self.place(|spec| std::ptr::eq(spec, &table.start))).unwrap_or_default();
        Registers {
            start: access.start.unwrap_or_default(),
            count: access.count,
            width: table.width,
            access: if access.write { device::Access::Write } else { device::Access::Read },
            single,
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
            message!("{who} confirms the write: {things}", who = who, things = things)
        }
        (_, Service::None | Service::Both) => plain,
    }
}

/// Gives the field that is called so the words of `spec`: what only other fields, or the device, tell.
fn refine(fields: &mut [Field], spec: &'static Spec) {
    for field in fields {
        if field.spec == spec {
            field.spec = spec;
        }
        refine(&mut field.children, spec);
    }
}

/// A label within a sentence.
fn small(label: Message) -> String {
    let mut text = label.to_string();
    if let Some(first) = text.get_mut(..1) {
        first.make_ascii_lowercase();
    }
    text
}

/// Where the first field of such a spec stands.
fn place(fields: &[Field], wanted: impl Fn(&'static Spec) -> bool) -> Option<Span> {
    field::find(fields, &mut |field| wanted(field.spec).then_some(field.span))
}

/// Whether the function code was read.
fn has_function(fields: &[Field]) -> bool {
    let chosen = |field: &Field| matches!(field.value, Value::Selector { .. }).then_some(());
    field::find(fields, &mut |field| chosen(field)).is_some()
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
