//! What somebody means who types a few words: the offers that they fit, filled in, best first.

mod fitting;
mod query;

use super::offers::offers;
use super::{Change, Editor, Offer, PROFILES, PROTOCOLS, Profile, Protocol, Settings};
use crate::field::{Direction, Message, in_order};
pub(super) use query::{Number, fold};
use query::{Query, in_words};

/// Something that can be built, as somebody asked for it.
#[derive(Clone, Debug)]
pub struct Found {
    /// Whose words these are; `None` for a function or service by itself.
    pub device: Option<&'static Profile>,
    pub offer: Offer,
    /// What the words fill in, as path and text for [`Change::Enter`].
    pub entries: Vec<(String, String)>,
    /// Why it was found, where its label does not show it; may be empty.
    pub reason: Message,
}

impl Found {
    /// "Write Universal channel at 200 to 319".
    pub fn label(&self) -> Message {
        self.offer.label()
    }

    /// The wished protocol, if it carries this; else the usual one that does.
    pub fn protocol(&self, wished: Option<&'static Protocol>) -> &'static Protocol {
        let settings = Settings::default();
        let carries = |protocol: &&'static Protocol| Editor::new(self.offer, 1, protocol, &settings).is_ok();
        // A job by itself: within a frame it would come with outputs of 0.
        let by_itself = match self.offer {
            Offer::Task(_) => Protocol::of("profibus-parameter-channel"),
            _ => None,
        };
        let usual = by_itself.into_iter().chain(PROTOCOLS.iter().copied());
        wished.into_iter().chain(usual).find(carries).unwrap_or(PROTOCOLS[0])
    }

    /// The form, filled in.
    pub fn editor(
        &self,
        unit: u8,
        wished: Option<&'static Protocol>,
        settings: &Settings,
    ) -> Result<Editor, Message> {
        let mut settings = settings.clone();
        let ident = &mut settings.frame.profibus.ident;
        *ident = ident.or(self.device.and_then(|device| device.ident));
        let mut editor = Editor::new(self.offer, unit, self.protocol(wished), &settings)?;
        editor.device = editor.device.or(self.device);
        for (path, text) in &self.entries {
            editor.edit(path, Change::Enter(text));
        }
        Ok(editor)
    }
}

/// What somebody may mean who types `text`, best first: a name in any spelling, an address of the bus or
/// of COMBIVIS, a function, a service, or a sentence.
///
/// All devices are searched; what is offered for `device` comes first. Every word has to mean something:
/// what fits only in part is left out.
///
/// ```
/// use buslens::field::hex;
/// use buslens::tool::{Profile, Settings, search};
///
/// let memograph = Profile::of("memograph-rsg45");
/// let found = search("write 123.456 good to channel 6", memograph);
/// let mut editor = found[0].editor(1, None, &Settings::default()).unwrap();
/// assert_eq!(hex(&editor.bytes().unwrap()), "01 10 00 D7 00 03 06 00 80 42 F6 E9 79 28 15");
/// ```
pub fn search(text: &str, device: Option<&'static Profile>) -> Vec<Found> {
    let query = Query::of(text);
    let mut found: Vec<(i32, Found)> = Vec::new();
    let mut add = |score: i32, one: Found| found.push((score, one));
    let chosen = device.into_iter();
    for profile in
        chosen.chain(PROFILES.iter().copied().filter(|other| device.is_none_or(|it| it.key != other.key)))
    {
        let own = if device.is_some_and(|device| device.key == profile.key) { OWN } else { 0 };
        for task in profile.tasks() {
            if let Some(fit) = query.fit_task(&task) {
                let Fit { score, entries, reason } = fit;
                let one = Found { device: Some(profile), offer: Offer::Task(task), entries, reason };
                add(score + own, one);
            }
        }
    }
    for offer in offers(None) {
        if let Some(score) = query.fit_telegram(&offer) {
            let one = Found { device: None, offer, entries: Vec::new(), reason: Message::term("") };
            let own = match (&offer, device) {
                (Offer::Service(_), Some(device)) if device.ident.is_some() => OWN,
                (Offer::Telegram(kind), Some(device)) if device.functions.contains(&kind.function) => OWN,
                _ => 0,
            };
            add(score + own, one);
        }
    }
    // As they are offered, where nothing tells them apart.
    let found = in_order(found, |(score, _)| std::cmp::Reverse(*score));
    found.into_iter().map(|(_, found)| found).collect()
}

/// What belongs to the device that is chosen comes before all else.
const OWN: i32 = 1000;

/// How much a word says.
const NAME: i32 = 120;
const ADDRESS: i32 = 90;
const WORD: i32 = 40;
const BEGINNING: i32 = 25;
const ALSO: i32 = 22;
const VALUE: i32 = 15;
const INSIDE: i32 = 12;
const NOTE: i32 = 2;

/// What became of the words for one offer.
struct Fit {
    score: i32,
    entries: Vec<(String, String)>,
    reason: Message,
}

impl Query {
    /// How well a telegram of a function or service fits, if it does.
    fn fit_telegram(&self, offer: &Offer) -> Option<i32> {
        let (spec, code, direction) = match offer {
            Offer::Telegram(kind) => (&kind.spec, u64::from(kind.function), kind.direction),
            Offer::Service(kind) => (&kind.spec, kind.sap.map_or(u64::MAX, u64::from), kind.direction),
            Offer::Task(_) => return None,
        };
        let names = [spec.label, spec.short];
        let mut score = if direction == Direction::Request { 1 } else { 0 };
        for word in &self.words {
            let numbered = word.number.and_then(|number| number.whole) == Some(code);
            let said = [NAME * i32::from(fold(spec.short) == word.plain), in_words(&names, &word.plain)];
            let asked = [Direction::Request, Direction::Response]
                .iter()
                .any(|it| it.key() == word.plain && *it == direction);
            score += match said.into_iter().max().unwrap_or_default() {
                0 if numbered => ADDRESS,
                0 if asked => WORD,
                0 if word.stop || ["function", "fc", "sap"].contains(&word.plain.as_str()) => 0,
                0 => return None,
                said => said,
            };
        }
        Some(score).filter(|_| !self.words.is_empty())
    }
}
