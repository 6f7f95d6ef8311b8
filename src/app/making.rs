//! What is being built. As in `state`, what is shown follows from the signals here, and only the
//! methods here change them.

use leptos::prelude::*;

use super::address::{self, Shows, Step};
use super::browser;
use super::components::form;
use super::state::State;
use buslens::field::{Message, hex};
use buslens::tool::link::Link;
use buslens::tool::{Editor, Offer, Options, PROTOCOLS, Profile, Protocol, offers};

/// The page's state, as handed to every part of it.
#[derive(Clone, Copy)]
pub struct Making {
    /// What can be built, and what of it is.
    made: RwSignal<Made, LocalStorage>,
    /// What follows from it. A signal of its own: it changes with each keystroke, the list of what can be
    /// built does not.
    pub outcome: RwSignal<Outcome, LocalStorage>,
    /// Counts on whenever the form has other entries than before. In between, its fields stay as they
    /// are while somebody types.
    pub shape: RwSignal<usize>,
}

/// What is built, and what else can be.
pub struct Made {
    pub device: Option<&'static Profile>,
    pub protocol: &'static Protocol,
    /// What was typed to find something.
    pub find: String,
    pub editor: Option<Editor>,
}

impl Default for Made {
    fn default() -> Self {
        Self { device: None, protocol: PROTOCOLS[0], find: String::new(), editor: None }
    }
}

/// What follows from what is built.
#[derive(Default)]
pub struct Outcome {
    /// Why there are no bytes, or why what was asked for last is not done.
    pub refused: Option<Message>,
    /// What can come back.
    pub replies: Vec<(Message, Vec<u8>)>,
}

impl Made {
    /// What can be built and fits what was typed.
    pub fn offers(&self) -> Vec<Offer> {
        let mut offers = offers(self.device);
        offers.retain(|offer| offer.fits(&self.find));
        offers
    }
}

impl Making {
    pub fn new() -> Self {
        Self {
            made: RwSignal::new_local(Made::default()),
            outcome: RwSignal::new_local(Outcome::default()),
            shape: RwSignal::new(0),
        }
    }

    /// Looks at what is built, and is called again when something else is, or its form has other entries.
    pub fn with<T>(&self, look: impl FnOnce(&Made) -> T) -> T {
        self.shape.track();
        self.made.with(look)
    }

    /// Looks at what is built now.
    pub fn now<T>(&self, look: impl FnOnce(&Made) -> T) -> T {
        self.made.with_untracked(look)
    }

    /// Types a part of the name of what is to be built.
    pub fn find(&self, typed: String) {
        self.made.update(|made| made.find = typed);
    }

    /// Builds for another device, or for any.
    pub fn ask_device(&self, state: State, device: Option<&'static Profile>) {
        self.made.update(|made| made.device = device);
        self.show(state, None);
        address::renew(Step::Chosen);
    }

    /// Builds what is at `index` of the list.
    pub fn choose(&self, state: State, index: usize) {
        self.made.update(|made| {
            let Some(offer) = made.offers().get(index).copied() else { return };
            let settings = state.settings();
            let unit = made.editor.as_mut().map_or(1, Editor::unit);
            // Its protocol, or else the first that carries such a thing.
            let carriers = [made.protocol].into_iter().chain(PROTOCOLS.iter().copied());
            let opened =
                carriers.filter_map(|protocol| Editor::new(offer, unit, protocol, &settings).ok()).next();
            if let Some(editor) = opened {
                made.protocol = editor.protocol;
                made.editor = Some(editor);
            }
        });
        self.chosen(state, None);
    }

    /// Lets another protocol carry it.
    pub fn carry_by(&self, state: State, protocol: &'static Protocol) {
        let mut refused = None;
        self.made.update(|made| {
            refused =
                made.editor.as_mut().and_then(|editor| editor.carry_by(protocol, &state.settings()).err());
            if refused.is_none() {
                made.protocol = protocol;
            }
        });
        self.chosen(state, refused);
    }

    /// Makes every field an entry of the form.
    pub fn open_all(&self, state: State) {
        let mut refused = None;
        self.made.update(|made| refused = made.editor.as_mut().and_then(|editor| editor.open_all().err()));
        self.chosen(state, refused);
    }

    /// Something else is built, or `refused` says why not.
    fn chosen(&self, state: State, refused: Option<Message>) {
        self.reshape();
        self.show(state, refused);
        address::renew(Step::Chosen);
    }

    /// Changes the form.
    pub fn edit(&self, state: State, edit: impl FnOnce(&mut Editor)) {
        let mut other = false;
        self.made.update_untracked(|made| {
            if let Some(editor) = &mut made.editor {
                let before = form::shape(editor.entries());
                edit(editor);
                other = form::outgrown(&before, editor.entries());
            }
        });
        if other {
            self.reshape();
        }
        self.show(state, None);
        address::renew(Step::Typed);
    }

    fn reshape(&self) {
        self.shape.update(|shape| *shape += 1);
    }

    /// Shows the telegram as Decode would.
    fn show(&self, state: State, refused: Option<Message>) {
        browser::set_field(browser::PROTOCOL, self.now(|made| made.protocol.key));
        browser::set_field(browser::DEVICE, self.now(|made| made.device.map_or("", |it| it.key)));
        let mut text = None;
        let mut options = Options::default();
        let mut outcome = Outcome { refused, replies: Vec::new() };
        let settings = state.settings();
        self.made.update_untracked(|made| {
            options.device = made.device;
            if let Some(editor) = &mut made.editor {
                options.protocol = Some(editor.protocol);
                options.direction = Some(editor.direction);
                outcome.replies = editor.replies(&settings);
                match editor.bytes() {
                    Ok(bytes) => text = Some(hex(&bytes)),
                    Err(message) => outcome.refused = Some(message),
                }
            }
        });
        self.outcome.set(outcome);
        state.show_built(text.unwrap_or_default(), options);
    }
}

/// Build with what is shown of it.
impl Shows for (Making, State) {
    fn key(&self) -> &'static str {
        "build"
    }

    fn link(&self) -> Link {
        let (making, state) = self;
        let mut link = Link::default();
        making.made.update_untracked(|made| {
            if let Some(editor) = &mut made.editor {
                link = editor.link(&state.settings());
            }
            link.options.device = made.device.or(link.options.device);
        });
        link
    }

    fn follow(&self, link: Link) {
        let (making, state) = self;
        state.set_up(link.options.settings.clone());
        making.made.update(|made| {
            made.device = link.options.device;
            made.editor = Editor::follow(&link);
            if let Some(editor) = &made.editor {
                made.protocol = editor.protocol;
            }
        });
        if making.now(|made| made.editor.is_none()) {
            making.choose(*state, 0);
        } else {
            making.reshape();
            making.show(*state, None);
        }
    }
}
