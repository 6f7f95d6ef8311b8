use std::cmp::Ordering;
use std::mem::discriminant;

use crate::device::{self, Profile};
use crate::dialogue::{self, Candidate, Certainty, Choice, Guess, Pairing};
use crate::field::{self, Argument, Direction, Severity, Span};
use crate::frame::{self, Bus, Content, Frame, Protocol, Speaker, Verdict, modbus_ascii};
use crate::message;
use crate::modbus::{Access, Pdu};
use crate::profibus::jobs::{self, Jobs, Step};
use crate::profibus::{self, Body, Channel, Service};
use crate::text::{self, Line, Remark, Style};
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

impl Options {
    /// Takes what the chosen device says of its telegrams: its ident number, and what it speaks.
    pub(super) fn take_device(&mut self) {
        let Some(device) = self.device else { return };
        let frame = &mut self.settings.frame;
        frame.profibus.ident = frame.profibus.ident.or(device.ident);
        frame.bus = Some(if device.ident.is_some() { Bus::Profibus } else { Bus::Modbus });
    }
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
pub fn decode(text: &str, mut options: Options) -> Report {
    options.take_device();
    let reading = text::read(text);
    let mut report = Report {
        telegrams: Vec::new(),
        not_understood: Vec::new(),
        style: reading.style,
        line_count: text.lines().count(),
        options,
        ..Report::default()
    };
    let (mut lines, empty): (Vec<Line>, Vec<Line>) = reading
        .lines
        .into_iter()
        .map(|line| report.explain_display(text, line))
        .partition(|line| !line.bytes.is_empty());
    report.not_understood = empty;
    lines.iter_mut().for_each(characters_to_bytes);
    let choices = report.protocols(&lines);
    let mut telegrams = Vec::new();
    for (line, choice) in lines.into_iter().zip(choices) {
        let mut rest = Some(line);
        while let Some(mut line) = rest.take() {
            let length = (choice.protocol.first)(&line.bytes).max(1);
            rest = split(&mut line, length);
            telegrams.push((line, choice.clone()));
        }
    }
    let leanings: Vec<i32> = telegrams
        .iter()
        .filter_map(|(line, choice)| match choice.protocol.speaker {
            Speaker::Turns(leaning) => Some(leaning(&line.bytes)),
            _ => None,
        })
        .collect();
    let mut turns = dialogue::turns(&leanings).into_iter();
    let mut pairing = Pairing::default();
    for (line, choice) in telegrams {
        let said = said(text, &line);
        report.add(line, choice, said, &mut turns, &mut pairing);
    }
    report.follow();
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
    pub(super) options: Options,
    /// What telegrams said of how devices are set up, in their order.
    learned: Vec<Known>,
    /// The numbers of a whole log, where the telegrams are of one.
    pub(super) counted: Option<Summary>,
}

/// A telegram as far as it was looked at without reading its fields.
#[derive(Clone, Debug)]
pub struct Telegram {
    /// Its number for a person, from 1: in its text or its log.
    pub number: usize,
    /// Its bytes and where they stand in the text.
    pub line: Line,
    /// Its protocol, and what else it could be.
    pub choice: Choice,
    pub guess: Guess,
    pub verdict: Verdict,
    /// The unit or station that is asked or answers.
    pub unit: Option<u8>,
    /// The index of the request that it answers.
    pub answers: Option<usize>,
    /// The index of the response to it.
    pub answered_by: Option<usize>,
    /// What it is for a job of the parameter channel.
    pub step: Option<Step>,
    /// When it was sent, as its log says.
    pub time: Option<String>,
    /// Microseconds from the request to the response.
    pub latency: Option<u32>,
    /// What a person noted on it.
    pub comment: String,
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
    /// Of a log: bytes that are no telegram.
    pub bytes_discarded: usize,
    /// The stable word of a log's layout, or of how the bytes are written.
    pub layout: Option<&'static str>,
}

impl Report {
    /// Telegrams that were found and met with each other already.
    pub(super) fn of(telegrams: Vec<Telegram>, options: Options) -> Self {
        let mut report = Self { telegrams, options, ..Self::default() };
        report.follow();
        report
    }

    /// A request and a response to it, both of which are known for what they are.
    pub(super) fn of_pair(
        request: &[u8],
        response: &[u8],
        protocol: &'static Protocol,
        mut options: Options,
    ) -> Self {
        options.take_device();
        let telegram = |bytes: &[u8], direction| Telegram {
            number: 1,
            line: Line { bytes: bytes.to_vec(), ..Line::default() },
            choice: Choice { protocol, reason: message!("it was made so"), others: Vec::new() },
            guess: Guess { direction, certainty: Certainty::Certain, reason: message!("it was made so") },
            verdict: (protocol.verdict)(bytes),
            unit: (protocol.unit)(bytes),
            answers: None,
            answered_by: None,
            step: None,
            time: None,
            latency: None,
            comment: String::new(),
        };
        let asked = Telegram { answered_by: Some(1), ..telegram(request, Direction::Request) };
        let answer = Telegram { number: 2, answers: Some(0), ..telegram(response, Direction::Response) };
        Self::of(vec![asked, answer], options)
    }

    /// Some of the telegrams, as they read with other options.
    pub(super) fn read_as(&self, indices: &[usize], mut options: Options) -> Self {
        options.take_device();
        let place = |index: Option<usize>| index.and_then(|index| indices.iter().position(|it| *it == index));
        let telegrams = indices.iter().map(|index| {
            let mut telegram = self.telegrams[*index].clone();
            (telegram.answers, telegram.answered_by) = (place(telegram.answers), place(telegram.answered_by));
            telegram
        });
        Self::of(telegrams.collect(), options)
    }

    /// Leaves out the first `count` telegrams, but not what they said of how devices are set up.
    pub(super) fn forget(&mut self, count: usize) {
        self.telegrams.drain(..count);
        for telegram in &mut self.telegrams {
            for partner in [&mut telegram.answers, &mut telegram.answered_by] {
                *partner = partner.and_then(|index| index.checked_sub(count));
            }
        }
        for known in &mut self.learned {
            known.from = known.from.saturating_sub(count);
        }
    }

    /// All lines with bytes or remarks: those of telegrams, then those without bytes.
    pub fn lines(&self) -> impl Iterator<Item = &Line> {
        self.telegrams.iter().map(|telegram| &telegram.line).chain(&self.not_understood)
    }

    pub fn summary(&self) -> Summary {
        if let Some(counted) = self.counted {
            return counted;
        }
        let mut summary = Summary {
            telegrams: self.telegrams.len(),
            lines: self.line_count,
            lines_not_understood: self.not_understood.len(),
            layout: self.style.map(Style::name),
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
                        let asks = (telegram.choice.protocol.exchange)(&telegram.line.bytes).is_some();
                        summary.unanswered += usize::from(telegram.answered_by.is_none() && asks);
                    }
                    Direction::Response => summary.unpaired += usize::from(telegram.answers.is_none()),
                }
            }
        }
        summary
    }

    /// How every telegram of the kind of telegram `index` is laid out.
    pub fn layout(&self, index: usize) -> Vec<guide::Row> {
        let telegram = self.telegrams.get(index);
        telegram.map_or(Vec::new(), |_| guide::guide(self.read(index).0.as_mut()))
    }

    /// A line that is no bytes but what the device's display shows, with what that means.
    fn explain_display(&self, text: &str, line: Line) -> Line {
        let written = text.get(line.span.from..line.span.to).unwrap_or_default().trim();
        let Some(shown) = self.options.device.and_then(|profile| profile.shown(written)) else { return line };
        let message = message!(
            "on the display of the device, {text} means: {meaning}",
            text = shown.text.to_owned(),
            meaning = Argument::Term(shown.meaning)
        );
        let remark = Remark { code: "display", severity: Severity::Warning, message, span: line.span };
        Line { number: line.number, span: line.span, remarks: vec![remark], ..Line::default() }
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

    fn add(
        &mut self,
        line: Line,
        choice: Choice,
        said: Option<Direction>,
        turns: &mut dyn Iterator<Item = Guess>,
        pairing: &mut Pairing,
    ) {
        let index = self.telegrams.len();
        let protocol = choice.protocol;
        let turn = match protocol.speaker {
            Speaker::Turns(_) => turns.next(),
            _ => None,
        };
        let guess = match (self.options.direction.or(said), turn) {
            (Some(direction), _) => {
                let by_hand = self.options.direction.is_some();
                let reason = if by_hand { message!("set by hand") } else { message!("the text says so") };
                Guess { direction, certainty: Certainty::Certain, reason }
            }
            // A slave repeats what it wrote: byte for byte, where it sets the length, too.
            (None, Some(turn)) if turn.certainty != Certainty::Certain && self.repeats(protocol, &line) => {
                let reason = message!("it repeats the request before it, as a confirmation does");
                Guess { direction: Direction::Response, certainty: Certainty::Likely, reason }
            }
            (None, Some(turn)) => turn,
            (None, None) => self.guess(protocol, &line.bytes, pairing),
        };
        let verdict = (protocol.verdict)(&line.bytes);
        let exchange = (protocol.exchange)(&line.bytes);
        let answers =
            exchange.and_then(|exchange| pairing.next(index, guess.direction, exchange, protocol.waiting));
        if let Some(request) = answers {
            let asked = &mut self.telegrams[request];
            asked.answered_by = Some(index);
            if asked.guess.certainty == Certainty::Open {
                let reason = message!("telegram {n} answers it", n = index + 1);
                asked.guess = Guess { certainty: Certainty::Likely, reason, ..asked.guess.clone() };
            }
        }
        let unit = (protocol.unit)(&line.bytes);
        self.telegrams.push(Telegram {
            number: index + 1,
            line,
            choice,
            guess,
            verdict,
            unit,
            answers,
            answered_by: None,
            step: None,
            time: None,
            latency: None,
            comment: String::new(),
        });
    }

    /// Whether a job that waits for its confirmation is repeated: only the request changes nothing.
    fn repeats(&self, protocol: &Protocol, line: &Line) -> bool {
        self.telegrams.last().is_some_and(|before| {
            before.line.bytes == line.bytes
                && before.choice.protocol.is(protocol)
                && before.guess.direction == Direction::Request
                && Channel::read(&line.bytes, Direction::Request, &self.options.settings.frame.profibus)
                    .service()
                    == Service::Write
        })
    }

    /// Who speaks: by the bytes, and where those leave it open, by the request that waits.
    fn guess(&self, protocol: &Protocol, bytes: &[u8], pairing: &Pairing) -> Guess {
        let asked = (protocol.exchange)(bytes).and_then(|exchange| pairing.waiting(exchange));
        let asked = asked.map(|index| (index, self.telegrams[index].line.bytes.as_slice()));
        let guess = match protocol.speaker {
            Speaker::Pdu(inside) => {
                let (pdu, around) = inside(bytes);
                dialogue::direction(pdu, around, asked.is_some(), self.options.settings.frame.dialect)
            }
            Speaker::Frame(told) => dialogue::told(told(bytes), message!("its frame says so")),
            Speaker::Always(direction) => {
                dialogue::told(Some(direction), message!("such telegrams go one way only"))
            }
            Speaker::Turns(leaning) => dialogue::leaning(leaning(bytes)),
        };
        if guess.certainty != Certainty::Open {
            return guess;
        }
        let Some((index, asked)) = asked else { return guess };
        let n = index + 1;
        // Both directions have such a length: the one that makes fewer mistakes is meant.
        let mistakes = |direction| self.mistakes(protocol, bytes, direction, index);
        let (direction, reason) = match mistakes(Direction::Response).cmp(&mistakes(Direction::Request)) {
            Ordering::Less => {
                (Direction::Response, message!("as a response to telegram {n} it is right", n = n))
            }
            Ordering::Greater => {
                (Direction::Request, message!("it does not fit as a response to telegram {n}", n = n))
            }
            Ordering::Equal if asked == bytes => (
                Direction::Response,
                message!("it repeats telegram {n}, as a response of this function does", n = n),
            ),
            Ordering::Equal if !self.echoes(protocol, bytes) => {
                (Direction::Response, message!("telegram {n} waits for such a response", n = n))
            }
            Ordering::Equal => return guess,
        };
        Guess { direction, certainty: Certainty::Likely, reason }
    }

    /// Whether request and response of the function are laid out alike.
    fn echoes(&self, protocol: &Protocol, bytes: &[u8]) -> bool {
        let Speaker::Pdu(inside) = protocol.speaker else { return false };
        let dialect = self.options.settings.frame.dialect;
        inside(bytes).0.first().is_none_or(|function| {
            let [request, response] = [Direction::Request, Direction::Response]
                .map(|direction| discriminant(&Pdu::kind(*function, direction, dialect).length));
            request == response
        })
    }

    /// How many problems `bytes` would have as a telegram of `direction`; a response answers
    /// telegram `request`.
    fn mistakes(&self, protocol: &Protocol, bytes: &[u8], direction: Direction, request: usize) -> usize {
        let settings = &self.options.settings.frame;
        let mut frame = (protocol.expect)(bytes, direction, settings);
        if direction == Direction::Response {
            let asked = &self.telegrams[request].line.bytes;
            let mut request = (protocol.expect)(asked, Direction::Request, settings);
            walk::read(request.as_mut(), asked);
            frame.answer(&request.content());
        }
        field::problems(&walk::read(frame.as_mut(), bytes).fields).len()
    }

    /// A frame of the kind of telegram `index` with nothing read into it yet.
    pub(super) fn expected(&self, index: usize) -> Box<dyn Frame> {
        let Telegram { line, choice, guess, .. } = &self.telegrams[index];
        (choice.protocol.expect)(&line.bytes, guess.direction, &self.settings(index).frame)
    }

    /// Reads telegram `index`, with what its request says that it does not repeat.
    pub(super) fn read(&self, index: usize) -> (Box<dyn Frame>, walk::Reading) {
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

    /// How the devices are set up when telegram `index` is sent.
    pub(super) fn settings(&self, index: usize) -> &Settings {
        let unit = self.telegrams[index].unit;
        let concerns = |known: &&Known| (known.unit == unit || known.unit == TO_ALL) && known.from <= index;
        let known = self.learned.iter().rev().find(concerns);
        known.map_or(&self.options.settings, |known| &known.settings)
    }

    /// Follows the jobs of parameter channels, and takes from what is written how the devices are
    /// set up from then on.
    fn follow(&mut self) {
        let mut slaves: Vec<(Option<u8>, Jobs)> = Vec::new();
        for index in 0..self.telegrams.len() {
            let telegram = &self.telegrams[index];
            let pdu = matches!(telegram.choice.protocol.speaker, Speaker::Pdu(_));
            if telegram.verdict == Verdict::Wrong || (pdu && self.options.device.is_none()) {
                continue;
            }
            if telegram.unit == TO_ALL {
                self.follow_all(index);
                continue;
            }
            let mut settings = self.settings(index).clone();
            let (frame, _) = self.read(index);
            let changed = match frame.content() {
                Content::Modbus { pdu, .. } => self.learn_registers(index, pdu, &mut settings.device),
                Content::Profibus { slave, kind, body } => {
                    let before = settings.frame.profibus.clone();
                    learn_setup(body, &mut settings.frame.profibus);
                    let mut changed = settings.frame.profibus != before;
                    // Inputs and outputs that are only looked at are no cycle of the channel.
                    if let Some(channel) = body.channel().filter(|_| kind.sap.is_none()) {
                        let known = slaves.iter().position(|(other, _)| *other == slave);
                        let at = known.unwrap_or_else(|| {
                            slaves.push((slave, Jobs::default()));
                            slaves.len() - 1
                        });
                        let step = slaves[at].1.next(channel);
                        changed |= self.learn_parameter(channel, step.as_ref(), &mut settings.device);
                        self.telegrams[index].step = step;
                    }
                    changed
                }
                Content::Nothing(_) => false,
            };
            if changed {
                let unit = self.telegrams[index].unit;
                self.learned.push(Known { from: index + 1, unit, settings });
            }
        }
    }

    /// Takes what is written to all units for each of them.
    fn follow_all(&mut self, index: usize) {
        let mut units: Vec<Option<u8>> = vec![TO_ALL];
        for known in &self.learned {
            if !units.contains(&known.unit) {
                units.push(known.unit);
            }
        }
        let (frame, _) = self.read(index);
        let Content::Modbus { pdu, .. } = frame.content() else { return };
        for unit in units {
            let known = self.learned.iter().rev().find(|known| known.unit == unit);
            let mut settings = known.map_or(&self.options.settings, |known| &known.settings).clone();
            if self.learn_registers(index, pdu, &mut settings.device) {
                self.learned.push(Known { from: index + 1, unit, settings });
            }
        }
    }

    /// Takes what registers were written, once that is confirmed, or if nobody answers at all; and what was
    /// read of them.
    fn learn_registers(&self, index: usize, pdu: &Pdu, settings: &mut device::Settings) -> bool {
        let Some(profile) = self.options.device else { return false };
        let telegram = &self.telegrams[index];
        if let Some(access) =
            pdu.body.access().filter(|access| !access.write && pdu.direction == Direction::Response)
        {
            return learn_values(profile, &access, settings);
        }
        let request = match telegram.answers {
            Some(request) if pdu.body.exception().is_none() => request,
            None if telegram.answered_by.is_none() => index,
            _ => return false,
        };
        if self.telegrams[request].verdict == Verdict::Wrong {
            return false;
        }
        let (frame, _) = self.read(request);
        let Content::Modbus { pdu, .. } = frame.content() else { return false };
        let Some(access) = pdu.body.access().filter(|access| access.write) else { return false };
        learn_values(profile, &access, settings)
    }

    /// Takes what a job wrote, when it is done.
    fn learn_parameter(
        &self,
        channel: &Channel,
        step: Option<&Step>,
        settings: &mut device::Settings,
    ) -> bool {
        let done =
            step.filter(|step| step.state == jobs::State::Done && channel.direction == Direction::Response);
        let written = channel.service() == Service::Write;
        match (self.options.device, done.and_then(|step| step.value)) {
            (Some(profile), Some(value)) => {
                profile.learn(channel.index, channel.subindex, value, 4, written, settings)
            }
            _ => false,
        }
    }
}

/// The address that all units listen to.
const TO_ALL: Option<u8> = Some(0);

/// Takes what the values of registers set up.
fn learn_values(profile: &Profile, access: &Access<'_>, settings: &mut device::Settings) -> bool {
    let Some(start) = access.start else { return false };
    let width = access.table.width;
    (start..=u16::MAX).zip(access.values).fold(false, |changed, (address, value)| {
        profile.learn(address, 0, *value, width, access.write, settings) || changed
    })
}

/// Takes what a telegram of a service says of how the slave is set up.
fn learn_setup(body: &dyn Body, settings: &mut profibus::Settings) {
    if let Some(layout) = body.layout() {
        (settings.layout, settings.told, settings.not_set_up) = (layout, true, false);
    }
    if body.sets_up() {
        settings.not_set_up = false;
    }
    if let Some(diagnosis) = body.diagnosis() {
        settings.not_set_up = diagnosis.not_set_up;
        if diagnosis.configuration_fault {
            (settings.layout, settings.told) = (profibus::Layout::default(), false);
        }
    }
}

/// Who speaks, by the word before the bytes.
fn said(text: &str, line: &Line) -> Option<Direction> {
    let first = line.places.first()?.from;
    let before = text.get(line.span.from..first)?.trim_start().to_ascii_lowercase();
    let word = before.trim_end_matches([':', ' ']);
    [Direction::Request, Direction::Response].into_iter().find(|direction| word == direction.key())
}

/// How a device is known to be set up from some telegram on.
#[derive(Clone, Debug)]
struct Known {
    from: usize,
    unit: Option<u8>,
    settings: Settings,
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
