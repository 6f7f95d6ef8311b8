//! How the user's devices are set up.

use leptos::prelude::*;
use leptos::task::spawn_local;
use web_sys::File;

use crate::address::Address;
use crate::browser::{file, storage};
use crate::components::form::Edit;
use crate::components::toast::Toasts;
use buslens::tool::link::{Link, keep_settings, kept_settings};
use buslens::tool::setup::{self, List, What};
use buslens::tool::{Entries, Options, Profile, Settings, settings};

/// What Devices shows, and what Read and Build follow.
#[derive(Clone, Copy)]
pub struct DeviceSettings {
    /// What is set up, and the form of it as it was typed.
    set_up: RwSignal<SetUp>,
    /// A person's own settings, while those of a link count.
    own: RwSignal<Option<Settings>>,
    /// What was set up before each change, the last one last; and what a step back undid.
    before: RwSignal<Vec<Moment>>,
    undone: RwSignal<Vec<Moment>>,
    /// Why the browser does not keep it, if so.
    not_kept: RwSignal<Option<storage::NotKept>>,
    /// A link counts when the page comes up; later the address only follows what is shown.
    arrived: StoredValue<bool>,
    toasts: Toasts,
    address: Address,
}

#[derive(Clone)]
struct SetUp {
    settings: Settings,
    /// The form as it was typed; as the settings have it where nobody typed.
    entries: Option<Entries>,
}

/// What was set up at a time, before something happened to one thing.
#[derive(Clone)]
struct Moment {
    set_up: SetUp,
    /// Typing on in a field is one change.
    field: Option<String>,
}

impl From<Settings> for SetUp {
    fn from(settings: Settings) -> Self {
        Self { settings, entries: None }
    }
}

impl SetUp {
    fn entries(&self) -> Entries {
        self.entries.clone().unwrap_or_else(|| settings::entries(&mut self.settings.clone()))
    }
}

/// Where it is kept in the browser.
const KEY: &str = "settings";

/// A file of settings has some hundred bytes.
const LONGEST_FILE: u32 = 1_000_000;

impl DeviceSettings {
    /// The settings as they were kept. Another tab that changes them is heard.
    pub fn new() -> Self {
        let kept = kept_settings(&storage::kept(KEY).unwrap_or_default());
        let state = Self {
            set_up: RwSignal::new(kept.into()),
            own: RwSignal::new(None),
            before: RwSignal::new(Vec::new()),
            undone: RwSignal::new(Vec::new()),
            not_kept: RwSignal::new(None),
            arrived: StoredValue::new(false),
            toasts: expect_context(),
            address: expect_context(),
        };
        storage::on_change(KEY, move |text| state.hear(&text.unwrap_or_default()));
        state
    }

    /// What counts.
    pub fn settings(&self) -> Settings {
        self.set_up.with(|set_up| set_up.settings.clone())
    }

    /// The form of it.
    pub fn entries(&self) -> Entries {
        self.set_up.with(SetUp::entries)
    }

    pub fn rows(&self, list: List) -> Vec<setup::Row> {
        self.set_up.with(|set_up| list.rows(&set_up.settings))
    }

    /// What is no factory setting.
    pub fn differences(&self) -> Vec<setup::Difference> {
        self.set_up.with(|set_up| setup::differences(&set_up.settings))
    }

    /// Whether the settings of a link count.
    pub fn is_of_link(&self) -> bool {
        self.own.with(Option::is_some)
    }

    pub fn not_kept(&self) -> Option<storage::NotKept> {
        self.not_kept.get()
    }

    pub fn can_undo(&self) -> bool {
        !self.before.with(Vec::is_empty)
    }

    pub fn can_redo(&self) -> bool {
        !self.undone.with(Vec::is_empty)
    }

    /// Changes the entry at `path` of the form.
    pub fn edit(&self, path: &str, edit: &Edit) {
        self.change(Some(path), |set_up| {
            let mut entries = set_up.entries();
            entries.edit(&mut set_up.settings, path, edit.change());
            set_up.entries = Some(entries);
        });
    }

    /// Sets up row `index` of a list, or a new one.
    pub fn set_row(&self, list: List, index: usize, parameter: u16, sets: u8, words: u8) {
        self.rework(|settings| list.set(settings, index, parameter, sets, words));
    }

    pub fn remove_row(&self, list: List, index: usize) {
        self.rework(|settings| list.remove(settings, index));
    }

    /// Says what a unit is; `None` that nobody knows.
    pub fn name_unit(&self, unit: u8, device: Option<&'static Profile>) {
        self.rework(|settings| setup::name_unit(settings, unit, device));
    }

    /// Puts one thing back as it is delivered.
    pub fn put_back(&self, what: What) {
        self.rework(|settings| setup::put_back(settings, what));
    }

    /// Puts everything back as it is delivered.
    pub fn put_all_back(&self) {
        self.change(None, |set_up| *set_up = Settings::default().into());
        let state = *self;
        self.toasts.offer("All devices are at factory settings.", "Undo", move || state.undo());
    }

    pub fn undo(&self) {
        self.step(self.before, self.undone);
    }

    pub fn redo(&self) {
        self.step(self.undone, self.before);
    }

    fn step(&self, from: RwSignal<Vec<Moment>>, to: RwSignal<Vec<Moment>>) {
        let Some(moment) = from.try_update(Vec::pop).flatten() else { return };
        let now = self.set_up.get_untracked();
        to.update(|moments| moments.push(Moment { set_up: now, field: None }));
        self.set_up.set(moment.set_up);
        self.keep();
    }

    /// Changes the settings by themselves; what was typed in the form and does not fit stays.
    fn rework(&self, change: impl FnOnce(&mut Settings)) {
        self.change(None, |set_up| {
            let typed = set_up.entries();
            change(&mut set_up.settings);
            let mut entries = settings::entries(&mut set_up.settings);
            entries.keep_misfits(&mut set_up.settings, &typed);
            set_up.entries = Some(entries);
        });
    }

    fn change(&self, field: Option<&str>, change: impl FnOnce(&mut SetUp)) {
        let moment = Moment { set_up: self.set_up.get_untracked(), field: field.map(str::to_owned) };
        self.before.update(|moments| {
            let goes_on =
                moment.field.is_some() && moments.last().is_some_and(|last| last.field == moment.field);
            if !goes_on {
                moments.push(moment);
            }
            if moments.len() > MOST_UNDONE {
                moments.remove(0);
            }
        });
        self.undone.update(Vec::clear);
        self.set_up.update(change);
        self.keep();
    }

    /// Keeps what is set up. Who changes the settings of a link makes them his own.
    fn keep(&self) {
        self.own.set(None);
        let kept = self.set_up.with_untracked(|set_up| storage::keep(KEY, &keep_settings(&set_up.settings)));
        self.not_kept.set(kept.err());
        self.address.typed();
    }

    /// Another tab keeps something else.
    fn hear(&self, kept: &str) {
        let settings = kept_settings(kept);
        let same = self.set_up.with_untracked(|set_up| same(&set_up.settings, &settings));
        if self.own.with_untracked(Option::is_some) {
            self.own.set(Some(settings));
        } else if !same {
            // A step back would undo what the other tab did.
            self.before.update(Vec::clear);
            self.undone.update(Vec::clear);
            self.set_up.set(settings.into());
            self.toasts.say("The device settings were changed in another tab, and count here, too.");
        }
    }

    /// A link that was opened has settings of its own: they count, but are not kept.
    pub fn bring(&self, settings: &Settings) {
        if self.arrived.try_update_value(|arrived| std::mem::replace(arrived, true)) != Some(false) {
            return;
        }
        let own = self.set_up.with_untracked(|set_up| set_up.settings.clone());
        if !same(settings, &Settings::default()) && !same(settings, &own) {
            self.set_up.set(settings.clone().into());
            // Who has nothing set up has nothing to go back to, but may not want to keep it.
            self.own.set(Some(own));
        }
    }

    /// Goes back from a link's settings to the person's own.
    pub fn use_own(&self) {
        if let Some(own) = self.own.get_untracked() {
            self.own.set(None);
            self.set_up.set(own.into());
        }
    }

    /// Makes a link's settings the person's own.
    pub fn keep_of_link(&self) {
        if let Some(own) = self.own.get_untracked() {
            self.before.update(|moments| moments.push(Moment { set_up: own.into(), field: None }));
            self.keep();
        }
    }

    /// The settings as a file has them.
    pub fn text(&self) -> String {
        self.set_up.with(|set_up| settings::write(&set_up.settings))
    }

    /// Takes the settings of a file. One that cannot be read or understood is told, and changes nothing.
    pub fn open(&self, opened: File) {
        let state = *self;
        spawn_local(async move {
            let name = opened.name();
            let read = file::text(&opened, LONGEST_FILE).await.map_err(|error| error.sentence());
            let read = read.and_then(|text| {
                settings::read(&text).map_err(|message| {
                    format!("{name} is not a file of device settings: {}.", message.sentence())
                })
            });
            match read {
                Ok(settings) => {
                    state.change(None, |set_up| *set_up = settings.into());
                    let kept = match state.not_kept.get_untracked() {
                        None => String::new(),
                        Some(why) => format!(" {}", why.sentence()),
                    };
                    state.toasts.offer(
                        format!("{name} is opened: the devices are set up by it.{kept}"),
                        "Undo",
                        move || state.undo(),
                    );
                }
                Err(why) => state.toasts.say(format!("{why} Nothing is changed.")),
            }
        });
    }

    pub fn link(&self) -> Link {
        Link {
            options: Options { settings: untrack(|| self.settings()), ..Options::default() },
            ..Link::default()
        }
    }

    pub fn follow(&self, link: Link) {
        self.bring(&link.options.settings);
    }
}

/// Steps back that are kept.
const MOST_UNDONE: usize = 100;

fn same(one: &Settings, other: &Settings) -> bool {
    settings::to_bytes(one) == settings::to_bytes(other)
}
