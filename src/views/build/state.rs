//! What is built: an editor of the library, and what follows from it.

use std::sync::Arc;

use leptos::prelude::*;

use crate::address::Address;
use crate::components::byte_strip::Lights;
use crate::components::form::Edit;
use crate::components::telegram::Shown;
use crate::views::devices::DeviceSettings;
use buslens::field::{Direction, Format, Message, hex, leaves};
use buslens::tool::link::Link;
use buslens::tool::log::brief;
use buslens::tool::{
    Editor, Entries, Found, Offer, Options, PROTOCOLS, Profile, Protocol, Settings, decode, offers, search,
};

/// What Build shows.
#[derive(Clone, Copy)]
pub struct BuildState {
    /// What was typed to find something.
    pub query: RwSignal<String>,
    /// What is edited. No signal: what is shown of it follows in `built`.
    editor: StoredValue<Option<Editor>, LocalStorage>,
    /// The request, while its reply is edited.
    request: StoredValue<Option<Editor>, LocalStorage>,
    device: RwSignal<Option<&'static Profile>>,
    built: RwSignal<Built>,
    /// Which of the replies is shown.
    pub reply: RwSignal<usize>,
    /// Counts on when the focus is to go to the form: something was found.
    pub to_form: RwSignal<usize>,
    pub request_lights: Lights,
    pub reply_lights: Lights,
    devices: DeviceSettings,
    address: Address,
}

/// What follows from what is edited.
#[derive(Clone)]
pub struct Built {
    pub label: String,
    /// A request in the device's words, which has fewer entries than the telegram has fields.
    pub is_task: bool,
    pub direction: Direction,
    pub protocol: &'static Protocol,
    pub entries: Entries,
    /// Why there is no telegram of it.
    pub impossible: Option<Message>,
    /// Why what was asked for last is not done.
    pub refused: Option<Message>,
    /// The telegram; the last good one where there is none.
    pub telegram: Option<Shown>,
    /// The request that the edited reply is to.
    pub request: Option<Shown>,
    /// What can come back, a healthy device's response first.
    pub replies: Vec<Reply>,
}

/// Something that can come back.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Reply {
    pub label: String,
    pub bytes: Vec<u8>,
}

impl Built {
    /// Whether the telegram that is shown is of before what was typed last.
    pub fn is_stale(&self) -> bool {
        self.impossible.is_some()
    }
}

impl BuildState {
    pub fn new() -> Self {
        let devices = expect_context::<DeviceSettings>();
        let editor = first(&Settings::default());
        let built = Built {
            label: editor.label().sentence(),
            is_task: false,
            direction: editor.direction,
            protocol: editor.protocol,
            entries: editor.entries().clone(),
            impossible: None,
            refused: None,
            telegram: None,
            request: None,
            replies: Vec::new(),
        };
        let state = Self {
            query: RwSignal::new(String::new()),
            editor: StoredValue::new_local(Some(editor)),
            request: StoredValue::new_local(None),
            device: RwSignal::new(None),
            built: RwSignal::new(built),
            reply: RwSignal::new(0),
            to_form: RwSignal::new(0),
            request_lights: Lights::new(),
            reply_lights: Lights::new(),
            devices,
            address: expect_context(),
        };
        // What a telegram says depends on how the devices are set up.
        Effect::new(move |before: Option<()>| {
            devices.settings();
            if before.is_some() {
                state.show(None);
            }
        });
        state
    }

    pub fn built(&self) -> RwSignal<Built> {
        self.built
    }

    /// Whose words count.
    pub fn device(&self) -> Option<&'static Profile> {
        self.device.get()
    }

    /// What fits to what was typed.
    pub fn found(&self) -> Vec<Found> {
        search(&self.query.get(), self.device.get())
    }

    /// What the telegram of a sentence says, and its function and registers; none of what has nothing filled in.
    pub fn told(&self, found: &Found) -> Option<(String, String)> {
        if found.entries.is_empty() {
            return None;
        }
        let settings = self.devices.settings();
        let unit = self.with_editor(Editor::unit).unwrap_or(1);
        let wished = self.built.with_untracked(|built| built.protocol);
        let mut editor = found.editor(unit, Some(wished), &settings).ok()?;
        let bytes = editor.bytes().ok()?;
        let (protocol, direction) = (editor.protocol, editor.direction);
        let shown = read(None, &bytes, direction, protocol, &options(found.device, &settings))?;
        let registers =
            shown.detail.device.blocks.first().map(|block| block.registers()).filter(|it| !it.is_empty());
        let registers = registers.map(|registers| match registers.contains(' ') {
            true => format!("registers {registers}"),
            false => format!("register {registers}"),
        });
        let function = shown.detail.function.map(|function| format!("function {function}"));
        let blocks = shown.detail.device.blocks.iter().map(|block| std::slice::from_ref(&block.field));
        let float = blocks.flat_map(leaves).find(|leaf| leaf.spec.format == Format::Float);
        let float = float.map(|leaf| if leaf.span.len() > 4 { "double" } else { "float" }.to_owned());
        let facts = [float, registers, function].into_iter().flatten().collect::<Vec<_>>().join(", ");
        Some((brief(&shown.detail.said), facts))
    }

    /// Builds something else.
    pub fn choose(&self, found: &Found) {
        let settings = self.settings();
        let unit = self.with_editor(Editor::unit).unwrap_or(1);
        let wished = self.built.with_untracked(|built| built.protocol);
        let Ok(editor) = found.editor(unit, Some(wished), &settings) else { return };
        if found.device.is_some() {
            self.device.set(found.device);
        }
        self.open(editor);
        self.to_form.update(|count| *count += 1);
    }

    /// Builds for another device, or for any.
    pub fn choose_device(&self, device: Option<&'static Profile>) {
        self.device.set(device);
        let task = self.with_editor(|editor| editor.task().map(|task| task.label().to_string())).flatten();
        // The same may be asked of the other device, too; else its telegram stays, field by field.
        let same = task.as_ref().and_then(|task| {
            let all = device.map_or(Vec::new(), |device| offers(Some(device)));
            let offer =
                all.into_iter().find(|it| matches!(it, Offer::Task(_)) && it.label().to_string() == *task)?;
            Some(Found { device, offer, entries: Vec::new(), reason: Message::term("") })
        });
        match (task, same) {
            (Some(_), Some(same)) => {
                let settings = self.settings();
                let unit = self.with_editor(Editor::unit).unwrap_or(1);
                let wished = self.built.with_untracked(|built| built.protocol);
                if let Ok(editor) = same.editor(unit, Some(wished), &settings) {
                    self.open(editor);
                }
            }
            (Some(_), None) => self.open_all(),
            (None, _) => {
                self.show(None);
                self.address.chosen();
            }
        }
    }

    /// Lets another protocol carry it.
    pub fn carry_by(&self, protocol: &'static Protocol) {
        let settings = self.settings();
        let refused = self.with_editor(|editor| editor.carry_by(protocol, &settings).err()).flatten();
        self.clear_lights();
        self.show(refused);
        self.address.chosen();
    }

    /// Makes every field an entry of the form.
    pub fn open_all(&self) {
        let refused = self.with_editor(|editor| editor.open_all().err()).flatten();
        self.show(refused);
        self.address.chosen();
    }

    /// Changes the form.
    pub fn edit(&self, path: &str, edit: &Edit) {
        self.with_editor(|editor| editor.edit(path, edit.change()));
        self.show(None);
        self.address.typed();
    }

    /// Edits the reply that is shown; the request stays beside it.
    pub fn edit_reply(&self) {
        let at = self.reply.get_untracked();
        let reply = self.built.with_untracked(|built| built.replies.get(at).cloned());
        let protocol = self.built.with_untracked(|built| built.protocol);
        let Some(reply) = reply else { return };
        let editor = Editor::of(&reply.bytes, protocol, Direction::Response, &self.settings());
        let request = self.editor.try_update_value(Option::take).flatten();
        self.open(editor);
        self.request.set_value(request);
        self.show(None);
    }

    /// Goes back to the request, as it was left.
    pub fn edit_request(&self) {
        if let Some(request) = self.request.try_update_value(Option::take).flatten() {
            self.open(request);
        }
    }

    fn open(&self, editor: Editor) {
        self.editor.set_value(Some(editor));
        self.request.set_value(None);
        self.reply.set(0);
        self.clear_lights();
        self.show(None);
        self.address.chosen();
    }

    fn clear_lights(&self) {
        self.request_lights.clear();
        self.reply_lights.clear();
    }

    fn with_editor<T>(&self, act: impl FnOnce(&mut Editor) -> T) -> Option<T> {
        self.editor.try_update_value(|editor| editor.as_mut().map(act)).flatten()
    }

    fn settings(&self) -> Settings {
        untrack(|| self.devices.settings())
    }

    /// Works out what follows from the editor. `refused`: why what was asked for last is not done.
    fn show(&self, refused: Option<Message>) {
        let settings = self.settings();
        let device = self.device.get_untracked();
        let options = options(device, &settings);
        let asked = self
            .request
            .try_update_value(|request| request.as_mut().and_then(|request| request.bytes().ok()));
        let asked = asked.flatten();
        let before = self.built.with_untracked(|built| built.telegram.clone());
        let built = self.with_editor(|editor| {
            editor.device = device;
            let (bytes, impossible) = match editor.bytes() {
                Ok(bytes) => (Some(bytes), None),
                Err(message) => (None, Some(message)),
            };
            let (protocol, direction) = (editor.protocol, editor.direction);
            let read = |asked: Option<&[u8]>, bytes: &[u8]| read(asked, bytes, direction, protocol, &options);
            let telegram = match &bytes {
                Some(bytes) => read(asked.as_deref(), bytes),
                None => before,
            };
            let replies = editor.replies(&settings).into_iter();
            let replies = replies.map(|(label, bytes)| Reply { label: label.sentence(), bytes });
            Built {
                label: editor.label().sentence(),
                is_task: editor.task().is_some(),
                direction,
                protocol,
                entries: editor.entries().clone(),
                impossible,
                refused,
                telegram,
                request: asked
                    .as_deref()
                    .and_then(|asked| self::read(None, asked, Direction::Request, protocol, &options)),
                replies: replies.collect(),
            }
        });
        if let Some(built) = built {
            let last = built.replies.len().saturating_sub(1);
            self.reply.update(|reply| *reply = (*reply).min(last));
            self.built.set(built);
        }
    }

    /// The reply that is shown, read with its request.
    pub fn shown_reply(&self) -> Option<Shown> {
        let at = self.reply.get();
        let settings = self.devices.settings();
        let options = options(self.device.get(), &settings);
        self.built.with(|built| {
            if built.direction == Direction::Response {
                return built.telegram.clone();
            }
            let reply = built.replies.get(at)?;
            let asked = built.telegram.as_ref()?.bytes();
            read(Some(asked), &reply.bytes, Direction::Response, built.protocol, &options)
        })
    }

    /// The request that is shown.
    pub fn shown_request(&self) -> Option<Shown> {
        self.built.with(|built| match built.direction {
            Direction::Request => built.telegram.clone(),
            Direction::Response => built.request.clone(),
        })
    }

    pub fn link(&self) -> Link {
        let settings = self.settings();
        let mut link = self.with_editor(|editor| editor.link(&settings)).unwrap_or_default();
        link.options.device = self.device.get_untracked().or(link.options.device);
        link
    }

    pub fn follow(&self, link: Link) {
        self.devices.bring(&link.options.settings);
        let settings = self.settings();
        let mut link = link;
        link.options.settings = settings.clone();
        let editor = Editor::follow(&link).unwrap_or_else(|| first(&settings));
        self.device.set(link.options.device);
        self.editor.set_value(Some(editor));
        self.request.set_value(None);
        self.reply.set(0);
        self.clear_lights();
        self.show(None);
    }
}

/// How telegrams are read here: the device that is chosen for them counts more than what units are elsewhere.
fn options(device: Option<&'static Profile>, settings: &Settings) -> Options {
    let mut settings = settings.clone();
    if device.is_some() {
        settings.units.clear();
    }
    Options { device, settings, ..Options::default() }
}

/// What is built where nobody chose: what most people need first.
fn first(settings: &Settings) -> Editor {
    let usual = offers(None)
        .into_iter()
        .filter(|offer| offer.label().to_string() == "Read holding registers, request");
    let all = usual.chain(offers(None));
    let editors = all.flat_map(|offer| {
        PROTOCOLS.iter().filter_map(move |protocol| Editor::new(offer, 1, protocol, settings).ok())
    });
    let mut editors = editors;
    editors.next().expect("something can be built")
}

/// A telegram as Read would show it: with its request, which tells what a response is about.
fn read(
    asked: Option<&[u8]>,
    bytes: &[u8],
    direction: Direction,
    protocol: &'static Protocol,
    options: &Options,
) -> Option<Shown> {
    let options = Options { protocol: Some(protocol), ..options.clone() };
    if let Some(asked) = asked {
        let report = Arc::new(decode(&format!("{}\n{}", hex(asked), hex(bytes)), options.clone()));
        let shown = Shown::of(&report, 1, &options);
        let pair = report.telegrams.len() == 2
            && shown
                .as_ref()
                .is_some_and(|it| it.bytes() == bytes && it.telegram.guess.direction == direction);
        if pair {
            return shown;
        }
    }
    let options = Options { direction: Some(direction), ..options };
    Shown::of(&Arc::new(decode(&hex(bytes), options.clone())), 0, &options)
}
