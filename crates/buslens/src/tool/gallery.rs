//! Telegrams to look at: those that the manuals print, and one of each kind.
//!
//! They are the heads of the test vectors (`tests/vectors`), and so what is checked and what is shown is the same;
//! all that is said of them comes from reading them.

use super::decode::Options;
use super::link::Link;
use super::{Detail, Profile, Protocol, Report, Verdict, decode};
use crate::device::PROFILES;
use crate::field::{Direction, Message, hex, in_order_by};
use crate::text;

/// A telegram of the gallery.
#[derive(Clone, Debug)]
pub struct Sample {
    /// What its vector says that it is.
    pub title: String,
    /// Document and section, and where in the section: "request 1", "S4".
    pub manual: String,
    pub section: String,
    pub place: String,
    /// The manual prints these bytes; else they are made after it.
    pub printed: bool,
    hex: String,
    /// What came before on the line.
    before: Vec<String>,
    pub device: Option<&'static Profile>,
    protocol: Option<&'static Protocol>,
    /// What is wrong with it in print, and the bytes as they should be, where the device's table does not say all.
    slip: Option<(String, String)>,
}

/// What a telegram of the gallery says.
#[derive(Clone, Debug)]
pub struct Said {
    /// What it does, in a sentence; of a misprint what it should do.
    pub sentence: String,
    pub bytes: Vec<u8>,
    pub protocol: &'static Protocol,
    pub direction: Direction,
    /// Of a Modbus telegram, without the exception bit.
    pub function: Option<u8>,
    /// What it is: "Read holding registers".
    pub kind: String,
    pub is_exception: bool,
    /// Something is wrong with it.
    pub is_faulty: bool,
    pub misprint: Option<Slip>,
}

/// What is wrong with a telegram in print.
#[derive(Clone, Debug)]
pub struct Slip {
    /// Which slip it is, in a few words.
    pub what: String,
    pub right: Vec<u8>,
}

/// The samples of a list: heads of vectors with an empty line between them, by manual and section, each response
/// behind its request.
pub fn samples(list: &str) -> Vec<Sample> {
    let samples = list.split("\n\n").filter_map(Sample::parse).map(|sample| (sample.order(), sample));
    in_order_by(samples, |(one, _), (other, _)| one.cmp(other))
        .into_iter()
        .map(|(_, sample)| sample)
        .collect()
}

impl Sample {
    fn parse(head: &str) -> Option<Self> {
        let find = |key: &str| head.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix(": "));
        let title = head.trim_start().lines().next()?;
        // Whether it is misprinted is said with the slip.
        let title = [" (as printed", ", with a misprint"]
            .iter()
            .fold(title, |title, mark| title.split_once(mark).map_or(title, |(before, _)| before));
        let (source, own) = match find("source")?.split_once("; ") {
            Some((source, own)) => (source, own.contains("of our own")),
            None => (find("source")?, false),
        };
        let source = source.strip_prefix("layout after ").unwrap_or(source);
        let source = source.strip_prefix("the ").unwrap_or(source);
        let parts: Vec<&str> = source.split(", ").collect();
        let is_section = |part: &&str| part.starts_with(|c: char| c.is_ascii_digit());
        let at = parts.iter().position(is_section).unwrap_or(parts.len());
        let slip = find("slip").zip(find("right"));
        Some(Self {
            title: title.to_owned(),
            manual: parts[..at].join(", "),
            section: parts.get(at).copied().unwrap_or_default().to_owned(),
            place: parts.get(at + 1..).unwrap_or_default().join(", "),
            printed: !own,
            hex: find("hex")?.to_owned(),
            before: find("before")
                .map_or(Vec::new(), |before| before.split('|').map(|it| it.trim().to_owned()).collect()),
            device: find("device").and_then(Profile::of),
            protocol: find("as").and_then(Protocol::of),
            slip: slip.map(|(what, right)| (what.to_owned(), right.to_owned())),
        })
    }

    /// Manuals in the order of the devices, sections by their numbers, an answer behind what it answers.
    fn order(&self) -> (usize, String, Vec<u32>, u32, bool) {
        let device = PROFILES.iter().position(|profile| self.manual == profile.source);
        // What is printed by whom most people come for stands first.
        let rank = device.map_or(usize::MAX, |device| PROFILES.len() - device);
        let numbers = |text: &str| {
            let digits = text.split(|c: char| !c.is_ascii_digit());
            digits.filter_map(|digits| digits.parse().ok()).collect::<Vec<u32>>()
        };
        let place = numbers(&self.place).first().copied().unwrap_or(u32::MAX);
        let answers = self.place.starts_with("response") || self.place.starts_with('E');
        (rank, self.manual.clone(), numbers(&self.section), place, answers)
    }

    fn options(&self) -> Options {
        Options { device: self.device, protocol: self.protocol, ..Options::default() }
    }

    /// Its bytes as `hex`, behind what came before it.
    fn text(&self, hex: &str) -> String {
        let lines = self.before.iter().map(String::as_str).chain([hex]);
        lines.collect::<Vec<_>>().join("\n")
    }

    fn read(&self, hex: &str) -> Option<(Report, Detail)> {
        let report = decode(&self.text(hex), self.options());
        let detail = report.detail(report.telegrams.len().checked_sub(1)?)?;
        Some((report, detail))
    }

    /// What it says.
    pub fn said(&self) -> Option<Said> {
        let (report, detail) = self.read(&self.hex)?;
        let telegram = report.telegrams.last()?;
        let bytes = telegram.line.bytes.clone();
        let known = PROFILES.iter().flat_map(|profile| profile.misprints);
        let known = known.filter(|_| self.printed).find(|misprint| misprint.printed == bytes);
        let misprint = match (&self.slip, known) {
            (Some((what, right)), _) => Some(Slip { what: what.clone(), right: text::bytes(right) }),
            (None, known) => known.map(|it| Slip { what: it.slips.to_owned(), right: it.right.to_vec() }),
        };
        let right = misprint.as_ref().and_then(|slip| self.read(&hex(&slip.right)));
        let said = right.as_ref().map_or(&detail, |(_, right)| right).meaning();
        let kind = match detail.function {
            // "Read holding registers, function 3": the function is said by itself.
            Some(_) => detail.kind.to_string().split(", function").next().unwrap_or_default().to_owned(),
            None => detail.kind.to_string(),
        };
        Some(Said {
            sentence: sentence(&said),
            bytes,
            protocol: telegram.choice.protocol,
            direction: telegram.guess.direction,
            function: detail.function,
            kind,
            is_exception: detail.exception.is_some(),
            is_faulty: telegram.verdict == Verdict::Wrong || !detail.problems().is_empty(),
            misprint,
        })
    }

    /// A link that opens it in Read, as it is printed, with what came before it.
    pub fn link(&self) -> Link {
        self.link_with(&self.hex)
    }

    /// A link that opens it in Read as it should be.
    pub fn corrected(&self, slip: &Slip) -> Link {
        self.link_with(&hex(&slip.right))
    }

    fn link_with(&self, hex: &str) -> Link {
        Link { telegram: self.before.len(), ..Link::to(self.text(hex), self.options()) }
    }
}

fn sentence(said: &Message) -> String {
    said.sentence() + "."
}
