use super::log::State;
use crate::device::{self, Profile};
use crate::dialogue::{Certainty, Choice, Guess};
use crate::field::{self, Argument, Direction, Severity, Span};
use crate::frame::{self, Bus, Content, Frame, Protocol, Speaker, Verdict};
use crate::message;
use crate::modbus::{Access, Pdu};
use crate::profibus::jobs::{self, Jobs, Step};
use crate::profibus::{self, Body, Channel, Service};
use crate::text::{Line, Remark, Style};
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
    /// The device that a unit is: its own, or else the one that is chosen for all.
    pub fn device_of(&self, unit: Option<u8>) -> Option<&'static Profile> {
        let own = self.settings.units.iter().find(|it| Some(it.unit) == unit);
        own.and_then(|own| own.device).or(self.device)
    }

    /// All devices that are chosen, for all units or for some.
    pub fn devices(&self) -> impl Iterator<Item = &'static Profile> {
        self.device.into_iter().chain(self.settings.units.iter().filter_map(|it| it.device))
    }

    /// Takes what the chosen device says of its telegrams: its ident number, and what it speaks.
    pub(super) fn take_device(&mut self) {
        let bus = |device: &Profile| if device.ident.is_some() { Bus::Profibus } else { Bus::Modbus };
        let Some(device) = self.devices().next() else { return };
        let same = self.devices().all(|other| bus(other) == bus(device));
        let frame = &mut self.settings.frame;
        frame.profibus.ident = frame.profibus.ident.or(device.ident);
        frame.bus = same.then(|| bus(device));
    }
}

/// What a user set up in the devices that speak, as far as their telegrams depend on it.
#[derive(Clone, Debug, Default)]
pub struct Settings {
    /// How telegrams are laid out.
    pub frame: frame::Settings,
    /// What registers and process data mean.
    pub device: device::Settings,
    /// What single units are.
    pub units: Vec<UnitDevice>,
}

/// What a unit is.
#[derive(Clone, Copy, Debug, Default)]
pub struct UnitDevice {
    pub unit: u8,
    pub device: Option<&'static Profile>,
}

impl PartialEq for UnitDevice {
    fn eq(&self, other: &Self) -> bool {
        (self.unit, self.device.map(|it| it.key)) == (other.unit, other.device.map(|it| it.key))
    }
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
    /// How it went with it, where its log tells.
    pub state: Option<State>,
    /// What a person noted on it.
    pub comment: String,
}

impl Telegram {
    /// One that is known for what it is, from no text.
    fn known(bytes: &[u8], direction: Direction, protocol: &'static Protocol) -> Self {
        Self {
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
            state: None,
            comment: String::new(),
        }
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
    /// Of a log: bytes that are no telegram.
    pub bytes_discarded: usize,
    /// The stable word of a log's layout, or of how the bytes are written.
    pub layout: Option<&'static str>,
}

impl Report {
    /// A text without anything in it.
    pub(super) fn nothing(text: &str, options: Options) -> Self {
        Self { line_count: text.lines().count(), options, ..Self::default() }
    }

    /// Telegrams that were found and met with each other already.
    pub(super) fn of(telegrams: Vec<Telegram>, options: Options) -> Self {
        let mut report = Self { telegrams, options, ..Self::default() };
        report.follow();
        report
    }

    /// A telegram that is known for what it is, by itself.
    pub fn of_one(
        bytes: &[u8],
        direction: Direction,
        protocol: &'static Protocol,
        mut options: Options,
    ) -> Self {
        options.take_device();
        Self::of(vec![Telegram::known(bytes, direction, protocol)], options)
    }

    /// A request and a response to it, both of which are known for what they are.
    pub fn of_pair(
        request: &[u8],
        response: &[u8],
        protocol: &'static Protocol,
        mut options: Options,
    ) -> Self {
        options.take_device();
        let known = |bytes, direction| Telegram::known(bytes, direction, protocol);
        let asked = Telegram { answered_by: Some(1), ..known(request, Direction::Request) };
        let answer = Telegram { number: 2, answers: Some(0), ..known(response, Direction::Response) };
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
    pub(super) fn explain_display(&self, written: &str, span: Span) -> Option<Remark> {
        let shown = self.options.devices().find_map(|profile| profile.shown(written.trim()))?;
        let message = message!(
            "on the display of the device, {text} means: {meaning}",
            text = shown.text.to_owned(),
            meaning = Argument::Term(shown.meaning)
        );
        Some(Remark { code: "display", severity: Severity::Warning, message, span })
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
            walk::fill(asked.as_mut(), &self.telegrams[request].line.bytes);
            frame.answer(&asked.content());
        }
        let reading = walk::read(frame.as_mut(), &telegram.line.bytes);
        (frame, reading)
    }

    /// The device that telegram `index` is for or from.
    pub(super) fn device(&self, index: usize) -> Option<&'static Profile> {
        self.options.device_of(self.telegrams.get(index)?.unit)
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
            if telegram.verdict == Verdict::Wrong || (pdu && self.device(index).is_none()) {
                continue;
            }
            if telegram.unit == TO_ALL {
                self.follow_all(index);
                continue;
            }
            let mut settings = self.settings(index).clone();
            let (frame, reading) = self.read(index);
            let changed = match frame.content() {
                // The value that a telegram ends in is none.
                Content::Modbus { .. } if is_cut(&reading) => false,
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
                        changed |= self.learn_parameter(slave, channel, step.as_ref(), &mut settings.device);
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
        let Some(profile) = self.device(index) else { return false };
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
        let (frame, reading) = self.read(request);
        if is_cut(&reading) {
            return false;
        }
        let Content::Modbus { pdu, .. } = frame.content() else { return false };
        let Some(access) = pdu.body.access().filter(|access| access.write) else { return false };
        learn_values(profile, &access, settings)
    }

    /// Takes what a job wrote, when it is done.
    fn learn_parameter(
        &self,
        slave: Option<u8>,
        channel: &Channel,
        step: Option<&Step>,
        settings: &mut device::Settings,
    ) -> bool {
        let done =
            step.filter(|step| step.state == jobs::State::Done && channel.direction == Direction::Response);
        let written = channel.service() == Service::Write;
        match (self.options.device_of(slave), done.and_then(|step| step.value)) {
            (Some(profile), Some(value)) => {
                profile.learn(channel.index, channel.subindex, value, 4, written, settings)
            }
            _ => false,
        }
    }
}

/// The address that all units listen to.
const TO_ALL: Option<u8> = Some(0);

/// Whether a telegram ends before it should.
fn is_cut(reading: &walk::Reading) -> bool {
    field::problems(&reading.fields).iter().any(|problem| problem.code == "truncated")
}

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

/// How a device is known to be set up from some telegram on.
#[derive(Clone, Debug)]
struct Known {
    from: usize,
    unit: Option<u8>,
    settings: Settings,
}
