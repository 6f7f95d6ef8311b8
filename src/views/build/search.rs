//! What somebody may want to build, by what is typed.

use buslens::field::Message;
use buslens::tool::{Editor, Offer, PROFILES, PROTOCOLS, Profile, Protocol, Settings, offers};

/// Something that can be built, and whose words it is in.
#[derive(Clone, Debug)]
pub struct Found {
    pub device: Option<&'static Profile>,
    pub offer: Offer,
}

impl Found {
    pub fn label(&self) -> Message {
        self.offer.label()
    }

    /// A form for it, in the wished protocol or else in the first that carries it.
    pub fn editor(&self, unit: u8, wished: &'static Protocol, settings: &Settings) -> Option<Editor> {
        let protocols = [wished].into_iter().chain(PROTOCOLS.iter().copied());
        protocols.filter_map(|protocol| Editor::new(self.offer, unit, protocol, settings).ok()).next()
    }
}

/// What fits, of all devices; that of `device` comes first.
pub fn search(typed: &str, device: Option<&'static Profile>) -> Vec<Found> {
    let others = PROFILES.iter().copied().filter(|profile| device.is_none_or(|it| it.key != profile.key));
    let tasks = device.into_iter().chain(others).flat_map(|profile| {
        profile.tasks().into_iter().map(move |task| Found { device: Some(profile), offer: Offer::Task(task) })
    });
    let telegrams = offers(None).into_iter().map(|offer| Found { device: None, offer });
    let all: Vec<Found> = match device {
        Some(_) => tasks.chain(telegrams).collect(),
        None => telegrams.chain(tasks).collect(),
    };
    all.into_iter().filter(|found| found.offer.fits(typed)).collect()
}
