//! A telegram while it is made: its form, the bytes that follow from it, and what does not fit.

use super::build::{build, does_not_carry, slot};
use super::link::Link;
use super::{Change, Entries, Offer, Options, Report, Settings, decode, offers, replies};
use crate::device::{Draft, Profile, Task};
use crate::field::{Argument, Direction, Message, Role, Spec, hex, problems};
use crate::frame::{self, Cargo, Frame, PROTOCOLS, Protocol};
use crate::message;
use crate::modbus::Pdu;
use crate::profibus::{self, ident};
use crate::walk::form::Content;
use crate::walk::{self, Deviations, Telegram, Walk, Walker};

/// A telegram, or what is to be asked of a device, with its [`Entries`].
///
/// ```
/// use buslens::tool::{Change, Editor, PROTOCOLS, Settings};
/// use buslens::field::Direction;
///
/// let request = [0x01, 0x03, 0x00, 0xC8, 0x00, 0x03, 0x84, 0x35];
/// let mut editor = Editor::of(&request, PROTOCOLS[0], Direction::Request, &Settings::default());
/// editor.edit("start", Change::Enter("0xD7"));
/// assert_eq!(editor.bytes().unwrap(), [0x01, 0x03, 0x00, 0xD7, 0x00, 0x03, 0xB5, 0xF3]);
/// ```
pub struct Editor {
    pub protocol: &'static Protocol,
    pub direction: Direction,
    /// Whose telegram it is, where that is known.
    pub device: Option<&'static Profile>,
    subject: Subject,
    entries: Entries,
}

/// What can come back to a request.
#[derive(Clone, Debug)]
pub struct Answer {
    pub label: Message,
    pub bytes: Vec<u8>,
    /// The answer in a sentence.
    pub said: Message,
}

/// What the form is of.
enum Subject {
    /// A request in the device's words.
    Task(Asking),
    /// Every field of a telegram.
    Telegram(Box<dyn Frame>),
}

/// A task for one unit.
struct Asking {
    unit: u8,
    task: Task,
    draft: Draft,
    settings: frame::Settings,
}

impl Asking {
    fn build(&mut self, protocol: &Protocol) -> Result<Box<dyn Frame>, Message> {
        build(&mut self.draft, self.unit, protocol, &self.settings)
    }
}

impl Editor {
    /// A telegram with nothing filled in. The message says why the protocol does not carry it.
    pub fn new(
        offer: Offer,
        unit: u8,
        protocol: &'static Protocol,
        settings: &Settings,
    ) -> Result<Self, Message> {
        let carried = |cargo| (protocol.carry)(unit, cargo).ok_or_else(|| does_not_carry(protocol));
        let (direction, subject) = match offer {
            Offer::Telegram(kind) => {
                let pdu = Pdu::expect(kind.function, kind.direction, settings.frame.dialect);
                (kind.direction, Subject::Telegram(carried(Cargo::Modbus(pdu))?))
            }
            Offer::Service(kind) => {
                // Of the only device that is known here, unless another is.
                let ident = settings.frame.profibus.ident.or(Some(ident::KEB_F5));
                let body = (kind.new)(&profibus::Settings { ident, ..settings.frame.profibus.clone() });
                (kind.direction, Subject::Telegram(carried(Cargo::Profibus(kind, body))?))
            }
            Offer::Task(task) => {
                let draft = task.draft();
                slot(&draft, protocol, &settings.frame)?;
                let settings = settings.frame.clone();
                (Direction::Request, Subject::Task(Asking { unit, task, draft, settings }))
            }
        };
        let mut editor = Self::with(subject, Deviations::default(), protocol, direction);
        editor.fill_lists(settings);
        Ok(editor)
    }

    /// Gives each list an item, where the telegram is not right without.
    fn fill_lists(&mut self, settings: &Settings) {
        let mut paths = Vec::new();
        self.entries.form.visit(&mut |entry| {
            if matches!(entry.content, Content::List { .. }) {
                paths.push(entry.path.clone());
            }
        });
        for path in paths {
            let before = self.mistakes(settings);
            self.edit(&path, Change::Add);
            if self.mistakes(settings) >= before {
                self.edit(&path, Change::RemoveLast);
            }
        }
    }

    /// How many problems the telegram has.
    fn mistakes(&mut self, settings: &Settings) -> usize {
        self.bytes().map_or(0, |bytes| {
            let mut frame = (self.protocol.expect)(&bytes, self.direction, &settings.frame);
            problems(&walk::read(frame.as_mut(), &bytes).fields).len()
        })
    }

    /// A telegram that there is, faults included: [`bytes`](Self::bytes) gives the same bytes again.
    pub fn of(bytes: &[u8], protocol: &'static Protocol, direction: Direction, settings: &Settings) -> Self {
        let mut frame = (protocol.expect)(bytes, direction, &settings.frame);
        let deviations = walk::read(frame.as_mut(), bytes).deviations(frame.as_mut());
        Self::with(Subject::Telegram(frame), deviations, protocol, direction)
    }

    /// What a [link](Self::link) leads to; `None` if it names neither telegram nor task.
    pub fn follow(link: &Link) -> Option<Self> {
        let Options { protocol, device, settings, .. } = &link.options;
        let mut editor = match &link.task {
            Some(task) => {
                let offer = offers(*device).into_iter().find(|offer| offer.label().to_string() == *task)?;
                let protocols = protocol.iter().chain(PROTOCOLS);
                protocols.filter_map(|protocol| Self::new(offer, 1, protocol, settings).ok()).next()?
            }
            None if let (Some(protocol), Some(direction), Some(bytes)) =
                (protocol, link.options.direction, plain(&link.text)) =>
            {
                Self::of(&bytes, protocol, direction, settings)
            }
            None => {
                let report = decode(&link.text, link.options.clone());
                let first = report.telegrams.first()?;
                // A faulty telegram can look like several.
                let others = report.telegrams.iter().skip(1).filter(|_| protocol.is_some());
                let same_line = others.take_while(|other| other.line.number == first.line.number);
                let bytes: Vec<u8> = std::iter::once(first)
                    .chain(same_line)
                    .flat_map(|telegram| telegram.line.bytes.iter().copied())
                    .collect();
                Self::of(&bytes, first.choice.protocol, first.guess.direction, settings)
            }
        };
        let typed: Vec<_> = link.entries.iter().map(|(path, text)| (path.as_str(), text.as_str())).collect();
        // A link of another version may name entries that there are none of: the others count.
        let _ = editor.entries.enter_all(editor.subject.telegram(), &typed);
        Some(editor)
    }

    /// What leads here again, with what was typed as it was typed. Where that would lead to other bytes,
    /// only the bytes count.
    pub fn link(&mut self, settings: &Settings) -> Link {
        let options =
            Options { protocol: Some(self.protocol), settings: settings.clone(), ..Options::default() };
        let bytes = self.bytes();
        let to_bytes = bytes.as_ref().ok().map(|bytes| {
            let options = Options { direction: Some(self.direction), ..options.clone() };
            Link::to(hex(bytes), options)
        });
        let typed = match (&mut self.subject, &to_bytes) {
            (Subject::Task(asking), _) => {
                let task = asking.task;
                let fresh = Self::new(Offer::Task(task), 1, self.protocol, settings);
                Link {
                    task: Some(task.label().to_string()),
                    entries: fresh.map_or(Vec::new(), |fresh| self.entries.typed(asking, &fresh.entries)),
                    options: Options { device: Some(task.profile), ..options },
                    ..Link::default()
                }
            }
            (Subject::Telegram(frame), Some(plain)) => {
                let bytes = bytes.as_deref().unwrap_or_default();
                let fresh = Self::of(bytes, self.protocol, self.direction, settings);
                Link { entries: self.entries.typed(frame.as_mut(), &fresh.entries), ..plain.clone() }
            }
            (Subject::Telegram(_), None) => return Link::default(),
        };
        match to_bytes {
            Some(plain) if Self::follow(&typed).is_none_or(|mut there| there.bytes() != bytes) => plain,
            _ => typed,
        }
    }

    fn with(
        mut subject: Subject,
        deviations: Deviations,
        protocol: &'static Protocol,
        direction: Direction,
    ) -> Self {
        let entries = Entries::of(subject.telegram(), deviations);
        let device = match &subject {
            Subject::Task(asking) => Some(asking.task.profile),
            Subject::Telegram(_) => None,
        };
        Self { protocol, direction, device, subject, entries }
    }

    /// What can be edited, and what was typed that does not fit.
    pub fn entries(&self) -> &Entries {
        &self.entries
    }

    /// The telegram's bytes, or why there is none: what the entries say cannot be asked for.
    pub fn bytes(&mut self) -> Result<Vec<u8>, Message> {
        match &mut self.subject {
            Subject::Telegram(frame) => Ok(walk::write(frame.as_mut(), &self.entries.deviations)),
            Subject::Task(asking) => {
                let mut frame = asking.build(self.protocol)?;
                Ok(walk::write(frame.as_mut(), &Deviations::default()))
            }
        }
    }

    /// Lets another protocol carry the same. What was typed stays, as far as the other has such fields.
    pub fn carry_by(&mut self, protocol: &'static Protocol, settings: &Settings) -> Result<(), Message> {
        let unit = self.unit();
        let offer = match &mut self.subject {
            Subject::Task(asking) => {
                slot(&asking.draft, protocol, &asking.settings)?;
                self.protocol = protocol;
                return Ok(());
            }
            Subject::Telegram(frame) => match frame.content() {
                frame::Content::Modbus { pdu, .. } => Offer::Telegram(pdu.kind),
                frame::Content::Profibus { kind, .. } => Offer::Service(kind),
                frame::Content::Nothing(spec) => {
                    return Err(message!(
                        "{protocol} has no {telegram}",
                        protocol = protocol.label.to_owned(),
                        telegram = Argument::Term(spec.label)
                    ));
                }
            },
        };
        let mut other = Self::new(offer, unit, protocol, settings)?;
        other.entries.take(other.subject.telegram(), &self.entries.form);
        *self = other;
        Ok(())
    }

    /// The unit or station that the telegram is for or from; 1 where it does not say.
    pub fn unit(&mut self) -> u8 {
        match &self.subject {
            Subject::Task(asking) => asking.unit,
            Subject::Telegram(_) => {
                self.bytes().ok().and_then(|bytes| (self.protocol.unit)(&bytes)).unwrap_or(1)
            }
        }
    }

    /// Makes every field of the telegram an entry, where so far it was a request in the device's words.
    pub fn open_all(&mut self) -> Result<(), Message> {
        if let Subject::Task(asking) = &mut self.subject {
            let frame = asking.build(self.protocol)?;
            let device = self.device;
            *self =
                Self::with(Subject::Telegram(frame), Deviations::default(), self.protocol, self.direction);
            self.device = device;
        }
        Ok(())
    }

    /// The request in the device's words, which has fewer entries than the telegram has fields.
    pub fn task(&self) -> Option<&Task> {
        match &self.subject {
            Subject::Task(asking) => Some(&asking.task),
            Subject::Telegram(_) => None,
        }
    }

    /// What is edited, in the words of its [`Offer`].
    pub fn label(&self) -> Message {
        match &self.subject {
            Subject::Task(asking) => asking.task.label(),
            Subject::Telegram(frame) => match frame.content() {
                frame::Content::Modbus { pdu, .. } => Offer::Telegram(pdu.kind).label(),
                frame::Content::Profibus { kind, .. } => Offer::Service(kind).label(),
                frame::Content::Nothing(spec) => Message::term(spec.label),
            },
        }
    }

    /// What can come back, as bytes with their names; nothing for a response.
    pub fn replies(&mut self, settings: &Settings) -> Vec<(Message, Vec<u8>)> {
        let (profibus, device) = (&settings.frame.profibus, self.device);
        let replies = match &mut self.subject {
            Subject::Telegram(frame) => replies(frame.as_mut(), profibus, device),
            Subject::Task(asking) => match asking.build(self.protocol) {
                Ok(mut frame) => replies(frame.as_mut(), profibus, device),
                Err(_) => Vec::new(),
            },
        };
        let bytes = |frame: &mut dyn Frame| walk::write(frame, &Deviations::default());
        replies.into_iter().map(|mut reply| (reply.label, bytes(reply.frame.as_mut()))).collect()
    }

    /// What can come back, each with what it says in the device's words.
    pub fn answers(&mut self, settings: &Settings) -> Vec<Answer> {
        let Ok(request) = self.bytes() else { return Vec::new() };
        let options = Options { device: self.device, settings: settings.clone(), ..Options::default() };
        let protocol = self.protocol;
        let replies = self.replies(settings).into_iter();
        let answer = |(label, bytes): (Message, Vec<u8>)| {
            let both = Report::of_pair(&request, &bytes, protocol, options.clone());
            let said = both.detail(1).map_or_else(|| label.clone(), |detail| detail.said);
            Answer { label, bytes, said }
        };
        replies.map(answer).collect()
    }

    /// Makes a job for the parameter channel the next one: with the other handshake.
    pub fn next_job(&mut self) {
        let Subject::Task(asking) = &self.subject else { return };
        if asking.draft.by_index() {
            let next = (1 - asking.draft.handshake.min(1)).to_string();
            self.edit("handshake", Change::Enter(&next));
        }
    }

    /// Changes the entry at `path`.
    pub fn edit(&mut self, path: &str, change: Change) {
        self.entries.edit(self.subject.telegram(), path, change);
    }
}

/// The bytes of a text that is nothing but them, as an editor's [`link`](Editor::link) has it.
fn plain(text: &str) -> Option<Vec<u8>> {
    let byte = |pair: &str| u8::from_str_radix(pair, 16).ok().filter(|_| pair.len() == 2);
    text.split(' ').map(byte).collect()
}

impl Subject {
    fn telegram(&mut self) -> &mut dyn Telegram {
        match self {
            Self::Task(asking) => asking,
            Self::Telegram(frame) => frame.as_mut(),
        }
    }
}

impl Telegram for Asking {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        w.u8(&UNIT, &mut self.unit)?;
        self.draft.walk(w)
    }
}

static UNIT: Spec = Spec::new("unit", "Unit address").role(Role::Address).note("Address of the device.");

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tool::PROFILES;

    fn editor(request: &[u8]) -> Editor {
        Editor::of(request, PROTOCOLS[0], Direction::Request, &Settings::default())
    }

    fn text(editor: &Editor, path: &str) -> String {
        let mut found = None;
        editor.entries.form.visit(&mut |entry| {
            if let (true, Content::Number { text, .. }) = (entry.path == path, &entry.content) {
                found = Some(text.clone());
            }
        });
        found.expect(path)
    }

    #[test]
    fn what_does_not_fit_is_kept_and_said() {
        let bytes = [0x01, 0x03, 0x00, 0xC8, 0x00, 0x03, 0x84, 0x35];
        let mut editor = editor(&bytes);
        editor.edit("start", Change::Enter("seven"));
        assert_eq!(text(&editor, "start"), "seven");
        assert_eq!(editor.entries.misfits[0].path, "start");
        assert_eq!(editor.bytes().unwrap(), bytes);
        // An entry beside it still counts, and what was typed wrong stays.
        editor.edit("unit", Change::Enter("0x02"));
        assert_eq!(text(&editor, "start"), "seven");
        assert_eq!(text(&editor, "unit"), "0x02");
        editor.edit("start", Change::Enter("7"));
        assert!(editor.entries.misfits.is_empty());
        assert_eq!(editor.bytes().unwrap()[..6], [0x02, 0x03, 0x00, 0x07, 0x00, 0x03]);
    }

    #[test]
    fn lists_grow_and_shrink_where_asked() {
        let mut editor = editor(&[1, 0x10, 0, 7, 0, 2, 4, 0, 10, 0, 11, 0, 0]);
        editor.edit("values.1.value", Change::Enter("0x0C"));
        editor.edit("values", Change::Add);
        editor.edit("values.2.value", Change::Enter("13"));
        editor.edit("values", Change::Remove(0));
        assert_eq!(text(&editor, "values.0.value"), "0x0C");
        assert_eq!(editor.bytes().unwrap()[4..11], [0, 2, 4, 0, 12, 0, 13]);
        editor.edit("values", Change::Remove(9));
        assert_eq!(editor.bytes().unwrap().len(), 13);
    }

    #[test]
    fn a_computed_number_can_be_overridden_and_given_back() {
        let mut editor = editor(&[1, 3, 0, 200, 0, 3, 0x84, 0x35]);
        editor.edit("crc", Change::Enter("12 34"));
        assert_eq!(editor.bytes().unwrap()[6..], [0x12, 0x34], "as on the wire");
        editor.edit("crc", Change::Enter("12"));
        assert_eq!(
            editor.entries.misfits[0].message.to_string(),
            "“12” is not 2 bytes in hex, as on the wire"
        );
        editor.edit("crc", Change::Enter(""));
        assert_eq!(editor.bytes().unwrap()[6..], [0x84, 0x35]);
    }

    #[test]
    fn another_protocol_carries_what_was_typed() {
        let mut editor = editor(&[7, 3, 0, 200, 0, 3, 0, 0]);
        let tcp = PROTOCOLS.iter().find(|protocol| protocol.key == "modbus-tcp").unwrap();
        editor.edit("start", Change::Enter("0xD7"));
        editor.carry_by(tcp, &Settings::default()).unwrap();
        assert_eq!(text(&editor, "start"), "0xD7");
        assert_eq!(editor.bytes().unwrap(), [0, 1, 0, 0, 0, 6, 7, 3, 0, 0xD7, 0, 3]);
        let channel = PROTOCOLS.iter().find(|protocol| protocol.key == "profibus-fdl").unwrap();
        assert!(editor.carry_by(channel, &Settings::default()).is_err());
        assert_eq!(editor.protocol.key, "modbus-tcp");
    }

    /// A link brings back what was typed, right or wrong, and a telegram with its faults.
    #[test]
    fn a_link_leads_back() {
        let settings = Settings::default();
        let faulty = [0x01, 0x03, 0x06, 0x00, 0x08, 0x42, 0xA4, 0xF1, 0xDE, 0xB0, 0xF8, 0x00];
        let mut editor = Editor::of(&faulty, PROTOCOLS[0], Direction::Response, &settings);
        editor.edit("unit", Change::Enter("0x11"));
        editor.edit("values.0.value", Change::Enter("seven"));
        let link = Link::read(editor.link(&settings).pairs());
        let mut again = Editor::follow(&link).unwrap();
        assert_eq!(again.bytes(), editor.bytes());
        assert_eq!(text(&again, "unit"), "0x11");
        assert_eq!(text(&again, "values.0.value"), "seven");
        assert_eq!(again.entries.misfits, editor.entries.misfits);

        let device = PROFILES.iter().copied().find(|profile| profile.key == "memograph-rsg45");
        let offer = offers(device).into_iter().find(|offer| offer.fits("215 write")).unwrap();
        let mut editor = Editor::new(offer, 5, PROTOCOLS[0], &settings).unwrap();
        editor.edit("number", Change::Enter("6"));
        editor.edit("content.value", Change::Enter("123.456"));
        let link = Link::read(editor.link(&settings).pairs());
        let mut again = Editor::follow(&link).unwrap();
        assert_eq!(again.bytes(), editor.bytes());
        assert!(Editor::follow(&Link::default()).is_none());
    }

    /// The next job takes the other handshake; what comes back is said in the device's words.
    #[test]
    fn jobs_follow_each_other() {
        let settings = Settings::default();
        let f5 = PROFILES.iter().copied().find(|profile| profile.key == "keb-f5-profibus");
        let offer =
            offers(f5).into_iter().find(|offer| offer.label().to_string() == "read Status word (Sy.51)");
        let channel = PROTOCOLS.iter().find(|protocol| protocol.key == "profibus-parameter-channel").unwrap();
        let mut editor = Editor::new(offer.unwrap(), 1, channel, &settings).unwrap();
        assert_eq!(editor.bytes().unwrap()[0], 0x41);
        editor.next_job();
        assert_eq!(editor.bytes().unwrap()[0], 0x01);
        let answers = editor.answers(&settings);
        assert_eq!(
            answers[0].said.to_string(),
            "job 1 is done: the slave answers: Status word (Sy.51) = 0000h"
        );
        assert!(
            answers[1].said.to_string().contains("rejects the job to read index 2033h"),
            "{}",
            answers[1].said
        );
    }

    /// Whatever is offered can be opened in at least one protocol, and what was made of it is read
    /// again as the same form.
    #[test]
    fn every_offer_is_built() {
        let settings = Settings::default();
        for device in PROFILES {
            for offer in offers(Some(device)) {
                let made: Vec<Editor> = PROTOCOLS
                    .iter()
                    .filter_map(|protocol| Editor::new(offer, 1, protocol, &settings).ok())
                    .filter_map(|mut editor| editor.bytes().is_ok().then_some(editor))
                    .collect();
                let what = offer.label().to_string();
                assert!(!made.is_empty() || what.starts_with("write"), "{}: {what}", device.key);
                for mut editor in made {
                    let bytes = editor.bytes().unwrap();
                    let mut again = Editor::of(&bytes, editor.protocol, editor.direction, &settings);
                    assert_eq!(again.bytes().unwrap(), bytes, "{what}");
                }
            }
        }
    }
}
