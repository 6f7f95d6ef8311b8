//! A telegram of a log with what tells more of it, as plain data: it can go to another thread, and is read
//! there as it would be here.

#[cfg(feature = "json")]
use serde::{Deserialize, Serialize};

use super::{Log, Source, State};
use crate::device::Present;
use crate::dialogue::{Certainty, Choice, Guess};
use crate::field::{Direction, Span};
use crate::frame::{PROTOCOLS, Protocol, Verdict};
use crate::message;
use crate::text::Line;
use crate::tool::decode::{Options, Report, Telegram};
use crate::tool::link::{keep_settings, kept_settings};

/// A telegram and its neighbours.
#[derive(Clone, Debug, Default)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize))]
pub struct Excerpt {
    /// Which of the telegrams is meant.
    pub place: usize,
    telegrams: Vec<Neighbour>,
    /// How the devices are set up by then, as links hold it.
    settings: String,
    /// What nobody sets up: how the device is by then.
    present: Present,
    /// The lines of the log that the telegram was read from.
    pub text: String,
    /// Where its bytes stand in that text.
    pub places: Vec<(usize, usize)>,
}

#[derive(Clone, Debug)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize))]
struct Neighbour {
    number: usize,
    line: usize,
    bytes: Vec<u8>,
    colon: bool,
    protocol: String,
    /// Not what the bytes alone say: one that was printed without its check has none.
    verdict: Verdict,
    reason_of_protocol: String,
    direction: Direction,
    certain: bool,
    reason: String,
    unit: Option<u8>,
    answers: Option<usize>,
    answered_by: Option<usize>,
    time: Option<String>,
    latency: Option<u32>,
    state: Option<State>,
}

impl Log {
    /// Telegram `index` with what tells more of it.
    pub fn excerpt(&self, source: &dyn Source, index: usize) -> Excerpt {
        let (report, place) = self.report_of(source, index);
        let Some(shown) = report.telegrams.get(place) else { return Excerpt::default() };
        let (text, places) = self.lines_of(source, index, &shown.line.places);
        Excerpt {
            place,
            settings: keep_settings(report.settings(place)),
            present: report.settings(place).device.present,
            text,
            places,
            telegrams: report.telegrams.iter().map(Neighbour::of).collect(),
        }
    }

    /// The lines of the log that the telegram `index` was read from, and where its bytes stand in them.
    fn lines_of(&self, source: &dyn Source, index: usize, places: &[Span]) -> (String, Vec<(usize, usize)>) {
        const LONGEST: usize = 4096;
        const AFTER: usize = 200;
        let entry = &self.entry(index);
        let (Some(first), Some(last)) = (places.first(), places.last()) else { return Default::default() };
        if entry.line == 0 {
            return Default::default();
        }
        let base = entry.offset as usize;
        let length = last.to.max(first.to).saturating_sub(base).min(LONGEST);
        let mut text = self.piece_at(source, entry.offset, length + AFTER);
        // The rest of its last line belongs to it.
        let rest = text.get(length..).unwrap_or_default();
        let end = rest.find(['\n', '\r']).map_or(text.len(), |at| length + at);
        text.truncate(end);
        let within = |at: usize| at.checked_sub(base).filter(|at| *at <= end);
        let places = places.iter().filter_map(|span| Some((within(span.from)?, within(span.to)?)));
        let places = places.collect();
        (text, places)
    }
}

impl Neighbour {
    fn of(telegram: &Telegram) -> Self {
        Self {
            number: telegram.number,
            line: telegram.line.number,
            bytes: telegram.line.bytes.clone(),
            colon: telegram.line.colon,
            protocol: telegram.choice.protocol.key.to_owned(),
            verdict: telegram.verdict,
            reason_of_protocol: telegram.choice.reason.to_string(),
            direction: telegram.guess.direction,
            certain: telegram.guess.certainty == Certainty::Certain,
            reason: telegram.guess.reason.to_string(),
            unit: telegram.unit,
            answers: telegram.answers,
            answered_by: telegram.answered_by,
            time: telegram.time.clone(),
            latency: telegram.latency,
            state: telegram.state,
        }
    }

    fn telegram(&self) -> Telegram {
        let protocol = Protocol::of(&self.protocol).unwrap_or(PROTOCOLS[0]);
        let certainty = if self.certain { Certainty::Certain } else { Certainty::Likely };
        Telegram {
            number: self.number,
            verdict: self.verdict,
            line: Line { number: self.line, bytes: self.bytes.clone(), colon: self.colon, ..Line::default() },
            choice: Choice {
                protocol,
                reason: message!("{reason}", reason = self.reason_of_protocol.clone()),
                others: Vec::new(),
            },
            guess: Guess {
                direction: self.direction,
                certainty,
                reason: message!("{reason}", reason = self.reason.clone()),
            },
            unit: self.unit,
            answers: self.answers,
            answered_by: self.answered_by,
            step: None,
            time: self.time.clone(),
            latency: self.latency,
            state: self.state,
            comment: String::new(),
        }
    }
}

impl Excerpt {
    /// The telegrams, to be read as `options` say.
    pub fn report(&self, options: &Options) -> Report {
        let mut settings = kept_settings(&self.settings);
        settings.device.present = self.present;
        let mut options = Options { settings, ..options.clone() };
        // What links hold is what a person set up; the rest is the device's.
        options.take_device();
        Report::of(self.telegrams.iter().map(Neighbour::telegram).collect(), options)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tool::log::Reading;

    #[test]
    fn a_telegram_says_the_same_elsewhere() {
        for (device, text) in [
            (
                "memograph-rsg45",
                "10:00:00.000 TX 01 03 00 C8 00 03 84 35\n10:00:00.030 RX 01 03 06 00 80 42 A4 F1 DE B0 F8\n",
            ),
            // Requests that were printed without their checksums.
            (
                "memograph-rsg45",
                ">>> request  01 03 00 c8 00 03\n<<< response 01 03 06 00 80 41 40 00 00 35 43\n\
                 >>> request  01 06 20 64 00 05\n<<< response 01 06 20 64 00 05 03 d6\n",
            ),
            // Limits are open for editing when a reason is given.
            (
                "memograph-rsg45",
                "TX 00 01 00 00 00 06 05 06 0C 90 01 01\nRX 00 01 00 00 00 06 05 06 0C 90 01 01\n\
                 TX 00 02 00 00 00 0B 05 10 0C 90 00 02 04 05 01 41 42\nRX 00 02 00 00 00 06 05 10 0C 90 00 02\n",
            ),
            // The ident number of another device.
            ("keb-f5-profibus", "TX 68 0C 0C 68 81 82 5D 3D 3E 88 01 0A 0B 05 EC 00 6A 16\nRX E5\n"),
        ] {
            let options = Options { device: crate::tool::Profile::of(device), ..Options::default() };
            let log = Log::read(text.as_bytes(), &Reading::default(), options.clone()).unwrap();
            assert!(log.entries().len() >= 2);
            for index in 0..log.entries().len() {
                let (report, place) = log.report_of(&text.as_bytes(), index);
                let excerpt = log.excerpt(&text.as_bytes(), index);
                let again = excerpt.report(&options);
                assert_eq!(again.telegrams[excerpt.place].verdict, log.entry(index).verdict);
                assert_eq!(report.detail(place), again.detail(excerpt.place));
                assert!(excerpt.places.len() == report.telegrams[place].line.bytes.len());
                assert!(text.contains(&excerpt.text) && !excerpt.text.is_empty());
            }
        }
    }
}
