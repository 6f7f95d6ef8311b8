use crate::device::{self, Profile, Registers, Said};
use crate::dialogue::{self, Candidate, Certainty, Choice, Guess, Pairing};
use crate::field::{self, Check, Direction, Field, Message, Problem, Span, Value, hex_value};
use crate::frame::{self, Content, Frame, Protocol, Speaker, Verdict, modbus_ascii, modbus_serial};
use crate::message;
use crate::modbus::{Access, EXCEPTION, Pdu, Server};
use crate::text::{self, Line, Style};
use crate::walk::{self, guide};

/// How a text is to be read.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// What the telegrams are, where a person says so; otherwise their bytes tell.
    pub direction: Option<Direction>,
    /// The same for their protocol.
    pub protocol: Option<&'static Protocol>,
    /// The device whose manual says what the registers mean.
    pub device: Option<&'static Profile>,
    pub settings: Settings,
}

/// What a user set up in the devices that speak, as far as their telegrams depend on it.
#[derive(Clone, Debug, Default)]
pub struct Settings {
    /// How telegrams are laid out.
    pub frame: frame::Settings,
    /// What registers and process data mean.
    pub device: device::Settings,
}

/// Reads every telegram of `text`, a line each.
///
/// Here the telegrams are found, checked and paired. Their fields are read one by one by
/// [`Report::detail`], when somebody looks.
pub fn decode(text: &str, options: Options) -> Report {
    let reading = text::read(text);
    let mut report = Report {
        telegrams: Vec::new(),
        not_understood: Vec::new(),
        style: reading.style,
        line_count: text.lines().count(),
        options,
        learned: Vec::new(),
    };
    let (mut lines, empty): (Vec<Line>, Vec<Line>) =
        reading.lines.into_iter().partition(|line| !line.bytes.is_empty());
    report.not_understood = empty;
    lines.iter_mut().for_each(characters_to_bytes);
    let choices = report.protocols(&lines);
    let mut pairing = Pairing::default();
    for (line, choice) in lines.into_iter().zip(choices) {
        let mut rest = Some(line);
        while let Some(mut line) = rest.take() {
            let length = (choice.protocol.first)(&line.bytes).max(1);
            rest = split(&mut line, length);
            report.add(line, choice.clone(), &mut pairing);
        }
    }
    report.learn();
    report
}

/// What was found in a text.
#[derive(Clone, Debug, Default)]
pub struct Report {
    pub telegrams: Vec<Telegram>,
    /// Lines without a single byte, with what is wrong with them.
    pub not_understood: Vec<Line>,
    /// How the bytes were written.
    pub style: Option<Style>,
    /// How many lines the text has, empty ones included.
    pub line_count: usize,
    options: Options,
    /// From which telegram on the device is known to be set up otherwise, in their order.
    learned: Vec<(usize, device::Settings)>,
}

/// A telegram as far as it was looked at without reading its fields.
#[derive(Clone, Debug)]
pub struct Telegram {
    /// Its bytes and where they stand in the text.
    pub line: Line,
    /// Its protocol, and what else it could be.
    pub choice: Choice,
    pub guess: Guess,
    pub verdict: Verdict,
    /// The index of the request that it answers.
    pub answers: Option<usize>,
    /// The index of the response to it.
    pub answered_by: Option<usize>,
}

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

/// A report in numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Summary {
    pub telegrams: usize,
    pub check_failed: usize,
    /// With a check, right or wrong.
    pub checked: usize,
    /// Too short to have a check.
    pub unchecked: usize,
    /// Requests with their response.
    pub pairs: usize,
    /// Requests that somebody should have answered.
    pub unanswered: usize,
    /// Responses without their request.
    pub unpaired: usize,
    pub lines: usize,
    pub lines_not_understood: usize,
}

impl Report {
    /// All lines with bytes or remarks: those of telegrams, then those without bytes.
    pub fn lines(&self) -> impl Iterator<Item = &Line> {
        self.telegrams.iter().map(|telegram| &telegram.line).chain(&self.not_understood)
    }

    pub fn summary(&self) -> Summary {
        let mut summary = Summary {
            telegrams: self.telegrams.len(),
            lines: self.line_count,
            lines_not_understood: self.not_understood.len(),
            ..Summary::default()
        };
        for telegram in &self.telegrams {
            summary.check_failed += usize::from(telegram.verdict == Verdict::Wrong);
            summary.checked += usize::from(matches!(telegram.verdict, Verdict::Right | Verdict::Wrong));
            summary.unchecked += usize::from(telegram.verdict == Verdict::Unchecked);
            summary.pairs += usize::from(telegram.answers.is_some());
            if telegram.guess.certainty != Certainty::Open {
                match telegram.guess.direction {
                    Direction::Request => {
                        let broadcast = telegram.line.bytes[0] == modbus_serial::BROADCAST
                            && telegram.choice.protocol.serial;
                        summary.unanswered += usize::from(telegram.answered_by.is_none() && !broadcast);
                    }
                    Direction::Response => summary.unpaired += usize::from(telegram.answers.is_none()),
                }
            }
        }
        summary
    }

    /// Reads the fields of telegram `index`.
    pub fn detail(&self, index: usize) -> Option<Detail> {
        let telegram = self.telegrams.get(index)?;
        let (frame, reading) = self.read(index);
        let bytes = &telegram.line.bytes;
        let device = self.device_says(index, frame.as_ref(), &reading.fields);
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
            device,
            fields: reading.fields,
        };
        match frame.content() {
            Content::Modbus { server, pdu } => {
                detail.unit = server.unit().filter(|_| !bytes.is_empty());
                detail.tell_pdu(server, pdu);
            }
        }
        Some(detail)
    }

    /// How every telegram of the kind of telegram `index` is laid out.
    pub fn layout(&self, index: usize) -> Vec<guide::Row> {
        let telegram = self.telegrams.get(index);
        telegram.map_or(Vec::new(), |_| guide::guide(self.expected(index).as_mut()))
    }

    /// The protocol of each line.
    fn protocols(&self, lines: &[Line]) -> Vec<Choice> {
        if let Some(protocol) = self.options.protocol {
            let reason = message!("set by hand");
            return vec![Choice { protocol, reason, others: Vec::new() }; lines.len()];
        }
        let candidates: Vec<Candidate<'_>> = lines
            .iter()
            .map(|line| Candidate {
                bytes: &line.bytes,
                written_as: line.colon.then_some(&modbus_ascii::PROTOCOL),
            })
            .collect();
        dialogue::protocols(&candidates, &self.options.settings.frame)
    }

    fn add(&mut self, line: Line, choice: Choice, pairing: &mut Pairing) {
        let index = self.telegrams.len();
        let protocol = choice.protocol;
        let guess = match self.options.direction {
            Some(direction) => {
                Guess { direction, certainty: Certainty::Certain, reason: message!("set by hand") }
            }
            None => self.guess(protocol, &line.bytes, pairing),
        };
        let verdict = (protocol.verdict)(&line.bytes);
        let exchange = (protocol.exchange)(&line.bytes);
        let answers =
            exchange.and_then(|exchange| pairing.next(index, guess.direction, exchange, protocol.waiting));
        if let Some(request) = answers {
            self.telegrams[request].answered_by = Some(index);
        }
        self.telegrams.push(Telegram { line, choice, guess, verdict, answers, answered_by: None });
    }

    /// Who speaks: by the bytes, and where those leave it open, by the request that waits.
    fn guess(&self, protocol: &Protocol, bytes: &[u8], pairing: &Pairing) -> Guess {
        let asked = pairing.waiting().map(|index| (index, self.telegrams[index].line.bytes.as_slice()));
        let exchange = (protocol.exchange)(bytes);
        let awaited =
            exchange.is_some() && asked.is_some_and(|(_, asked)| (protocol.exchange)(asked) == exchange);
        let Speaker::Pdu(inside) = protocol.speaker;
        let (pdu, around) = inside(bytes);
        let guess = dialogue::direction(pdu, around, awaited, self.options.settings.frame.dialect);
        match asked {
            Some((index, asked)) if guess.certainty == Certainty::Open && asked == bytes => Guess {
                direction: Direction::Response,
                certainty: Certainty::Likely,
                reason: message!(
                    "it repeats telegram {n}, as a response of this function does",
                    n = index + 1
                ),
            },
            _ => guess,
        }
    }

    /// A frame of the kind of telegram `index` with nothing read into it yet.
    fn expected(&self, index: usize) -> Box<dyn Frame> {
        let Telegram { line, choice, guess, .. } = &self.telegrams[index];
        (choice.protocol.expect)(&line.bytes, guess.direction, &self.options.settings.frame)
    }

    /// Reads telegram `index`, with what its request says that it does not repeat.
    fn read(&self, index: usize) -> (Box<dyn Frame>, walk::Reading) {
        let mut frame = self.expected(index);
        let telegram = &self.telegrams[index];
        if let Some(request) = telegram.answers {
            let mut asked = self.expected(request);
            walk::read(asked.as_mut(), &self.telegrams[request].line.bytes);
            frame.answer(&asked.content());
        }
        let reading = walk::read(frame.as_mut(), &telegram.line.bytes);
        (frame, reading)
    }

    /// How the device is set up when telegram `index` is sent.
    fn settings(&self, index: usize) -> &device::Settings {
        let known = self.learned.iter().rev().find(|(from, _)| *from <= index);
        known.map_or(&self.options.settings.device, |(_, settings)| settings)
    }

    fn device_says(&self, index: usize, frame: &dyn Frame, fields: &[Field]) -> Said {
        let Some(profile) = self.options.device else { return Said::default() };
        match frame.content() {
            Content::Modbus { pdu, .. } => {
                let Some(registers) = pdu.body.access().filter(|access| access.start.is_some()) else {
                    return Said::default();
                };
                let values = big_endian(&registers);
                let registers = device_registers(&registers, &values, fields);
                profile.registers(&registers, self.settings(index))
            }
        }
    }

    /// Takes from the writes of the text how the device is set up from then on.
    fn learn(&mut self) {
        let Some(profile) = self.options.device else { return };
        let mut settings = self.options.settings.device.clone();
        for index in 0..self.telegrams.len() {
            let (frame, _) = self.read(index);
            let Content::Modbus { pdu, .. } = frame.content();
            let Some(access) = pdu.body.access().filter(|access| access.write) else { continue };
            let Some(start) = access.start else { continue };
            let before = settings.clone();
            for (address, value) in (start..=u16::MAX).zip(access.values) {
                profile.learn(address, *value, &mut settings);
            }
            if settings != before {
                self.learned.push((index + 1, settings.clone()));
            }
        }
    }
}

impl Detail {
    /// What a PDU says.
    fn tell_pdu(&mut self, server: Server, pdu: &Pdu) {
        let spec = &pdu.kind.spec;
        let access = pdu.body.access();
        let write = access.is_some_and(|access| access.write);
        if let Some(label) = missing(&self.fields) {
            self.said = message!(
                "{kind}, cut off: {label} is incomplete",
                kind = field::Argument::Term(spec.label),
                label = label
            );
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
        self.kind = kind_name(spec.label, function);
        self.note = spec.note;
        self.source = spec.source;
        self.function = function.map(|function| function & !EXCEPTION);
        self.exception = pdu.body.exception();
        self.start = access.and_then(|access| access.start);
        self.count = access.map(|access| access.count);
        self.values = access.map_or(Vec::new(), |access| access.values.to_vec());
    }
}

/// Whether the function code was read.
fn has_function(fields: &[Field]) -> bool {
    field::leaves(fields).iter().any(|leaf| matches!(leaf.value, Value::Selector { .. }))
}

/// The values of registers as bytes, high byte first.
fn big_endian(access: &Access<'_>) -> Vec<u8> {
    let width = access.table.width;
    access.values.iter().flat_map(|value| value.to_be_bytes().into_iter().skip(4 - width)).collect()
}

/// Registers as a device's table takes them: with the place of their values in the telegram, or of
/// what names them.
fn device_registers<'a>(access: &Access<'_>, values: &'a [u8], fields: &[Field]) -> Registers<'a> {
    let place = |spec: &'static field::Spec| {
        let mut span = None;
        for field in fields {
            field.visit(&mut |field| {
                if std::ptr::eq(field.spec, spec) {
                    span = span.or(Some(field.span));
                }
            });
        }
        span
    };
    let table = access.table;
    let given = place(&table.values).or(place(&table.value)).filter(|_| !access.values.is_empty());
    let span = given.or(place(&table.start)).unwrap_or_default();
    Registers {
        start: access.start.unwrap_or_default(),
        count: access.count,
        width: table.width,
        access: if access.write { device::Access::Write } else { device::Access::Read },
        values: given.is_some().then_some(values),
        span,
    }
}

/// Puts bytes in place of the characters of Modbus ASCII that stand for them.
fn characters_to_bytes(line: &mut Line) {
    if let Some(bytes) = modbus_ascii::from_characters(&line.bytes) {
        // Each byte stands where its two digits do; colon and line end belong to the first and last.
        let places = line.places[1..].chunks(2).take(bytes.len());
        line.places = places.map(|pair| Span::new(pair[0].from, pair[pair.len() - 1].to)).collect();
        line.bytes = bytes;
        line.colon = true;
    }
}

/// Takes what comes behind the first `length` bytes of a line from it.
fn split(line: &mut Line, length: usize) -> Option<Line> {
    let next = line.places.get(length)?.from;
    let bytes = line.bytes.split_off(length);
    let places = line.places.split_off(length);
    let (remarks, kept) =
        std::mem::take(&mut line.remarks).into_iter().partition(|remark| remark.span.from >= next);
    line.remarks = kept;
    let span = Span::new(next, line.span.to);
    line.span.to = next;
    Some(Line { number: line.number, span, bytes, places, remarks, colon: line.colon })
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
