//! What comes after the first view: parts of the module that are loaded when the page has time for them, or at
//! once when somebody asks for what is in one. Who reads a telegram need not wait for the forms that build
//! others, nor for what reads logs.
//!
//! What only these parts call is in them, and whatever is named outside of them is in the first one. So the
//! states of their views are made by them, as context of the app, and outlast every switch of views; until
//! then, what a view is to show is kept as a link.
// What parts the module hands values over as C functions do.
#![allow(unsafe_code)]

use leptos::prelude::*;
use leptos::task::spawn_local;
use leptos::wasm_split::{SplitLoaderError, wasm_split};

use crate::address::View;
use crate::browser::stylesheet;
use crate::components::causes::Causes;
use crate::components::chosen_byte::ChosenByte;
use crate::components::copy_as::CopyAs;
use crate::components::foot::{AboutIsOpen, Foot};
use crate::components::page_tools::PageTools;
use crate::views::build::{Build, BuildState};
use crate::views::check::{Check, CheckState};
use crate::views::devices::Devices;
use crate::views::learn::{Learn, LearnState};
use crate::views::read::{Beside, Examples, LogView, More, ProposedDevice, ReadState, ReadingChoices, Start};
use crate::views::sheet::Sheet;
use buslens::tool::link::Link;

/// A part of the module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Build, Check, Devices, Sheet, and what they have in common.
    Views,
    /// What reads logs and shows them, and what stands around a telegram and its fields: reasons, tools, menus.
    Log,
    /// Lessons, tasks, and everything to look up.
    Learn,
}

/// What the later parts draw.
#[derive(Clone, Copy)]
pub enum Piece {
    Build,
    Check,
    Devices,
    Sheet,
    Learn,
    Log,
    /// What can be done with the page as a whole.
    PageTools,
    Foot,
    /// What there is to try, and what comes of it, below the input that is empty.
    Start,
    Examples,
    ReadingChoices,
    ProposedDevice,
    /// What the text tells beside its telegrams, or in their place.
    Beside,
    CopyAs,
    Causes,
    ChosenByte,
    /// What is folded below a telegram.
    More,
}

impl Piece {
    /// The part that it is in.
    const fn part(self) -> Part {
        match self {
            Self::Build | Self::Check | Self::Devices | Self::Sheet => Part::Views,
            Self::Learn => Part::Learn,
            _ => Part::Log,
        }
    }

    /// Whether it is all that is asked for, and not something beside that.
    const fn is_view(self) -> bool {
        matches!(self, Self::Build | Self::Check | Self::Devices | Self::Sheet | Self::Learn | Self::Log)
    }
}

/// What a part brings.
#[derive(Clone, Copy)]
struct Content {
    /// Makes what outlasts its pieces; called once, for the app.
    start: fn(),
    /// Draws one of its pieces.
    draw: fn(Piece) -> AnyView,
}

#[wasm_split(views, wasm_split_path = leptos::wasm_split, fallible)]
fn views() -> Result<Content, NotLoaded> {
    fn start() {
        let later = expect_context::<Later>();
        let (build, check) = (BuildState::new(), CheckState::new());
        provide_context(build);
        provide_context(check);
        later.give(View::Build, Box::new(build));
        later.give(View::Check, Box::new(check));
    }
    fn draw(piece: Piece) -> AnyView {
        match piece {
            Piece::Build => view! { <Build /> }.into_any(),
            Piece::Check => view! { <Check /> }.into_any(),
            Piece::Devices => view! { <Devices /> }.into_any(),
            Piece::Sheet => view! { <Sheet /> }.into_any(),
            _ => ().into_any(),
        }
    }
    Ok(Content { start, draw })
}

#[wasm_split(log, wasm_split_path = leptos::wasm_split, fallible)]
fn log() -> Result<Content, NotLoaded> {
    fn start() {
        provide_context(AboutIsOpen(RwSignal::new(false)));
        expect_context::<ReadState>().read_logs();
    }
    fn draw(piece: Piece) -> AnyView {
        let read = expect_context::<ReadState>();
        let shown = Signal::derive(move || read.shown());
        match piece {
            Piece::PageTools => view! { <PageTools /> }.into_any(),
            Piece::Foot => view! { <Foot /> }.into_any(),
            Piece::Start => view! { <Start /> }.into_any(),
            Piece::Examples => view! { <Examples /> }.into_any(),
            Piece::ReadingChoices => view! { <ReadingChoices /> }.into_any(),
            Piece::ProposedDevice => view! { <ProposedDevice /> }.into_any(),
            Piece::Beside => view! { <Beside /> }.into_any(),
            Piece::CopyAs => view! { <CopyAs shown at_end=true /> }.into_any(),
            Piece::Causes => {
                let on_use = Callback::new(move |bytes| read.correct(bytes));
                view! { <Causes shown on_use /> }.into_any()
            }
            Piece::ChosenByte => view! { <ChosenByte shown lights=read.lights /> }.into_any(),
            Piece::More => view! { <More /> }.into_any(),
            _ => view! { <LogView /> }.into_any(),
        }
    }
    Ok(Content { start, draw })
}

#[wasm_split(learn, wasm_split_path = leptos::wasm_split, fallible)]
fn learn() -> Result<Content, NotLoaded> {
    fn start() {
        let state = LearnState::new();
        provide_context(state);
        expect_context::<Later>().give(View::Learn, Box::new(state));
    }
    Ok(Content { start, draw: |_| view! { <Learn /> }.into_any() })
}

/// Answers what the page asks about logs; for the worker.
#[wasm_split(log, wasm_split_path = leptos::wasm_split, fallible)]
pub fn serve_logs() -> Result<(), NotLoaded> {
    crate::worker::serve();
    Ok(())
}

/// It did not come: the connection is gone.
pub struct NotLoaded;

impl From<SplitLoaderError> for NotLoaded {
    fn from(_: SplitLoaderError) -> Self {
        Self
    }
}

/// How far a part is loaded.
#[derive(Clone, Copy)]
enum Stage {
    Not,
    Loading,
    Failed,
    There(Content),
}

/// The state of a view, as links know it.
pub trait Linked {
    fn link(&self) -> Link;
    fn follow(&self, link: Link);
}

impl Linked for BuildState {
    fn link(&self) -> Link {
        self.link()
    }

    fn follow(&self, link: Link) {
        self.follow(link);
    }
}

impl Linked for LearnState {
    fn link(&self) -> Link {
        self.link()
    }

    fn follow(&self, link: Link) {
        self.follow(link);
    }
}

impl Linked for CheckState {
    fn link(&self) -> Link {
        self.link()
    }

    fn follow(&self, link: Link) {
        self.follow(link);
    }
}

/// What views are about, as far as they were made.
type States = Vec<(View, Box<dyn Linked>)>;

/// The later parts, as far as they are there.
#[derive(Clone, Copy)]
pub struct Later {
    views: RwSignal<Stage, LocalStorage>,
    log: RwSignal<Stage, LocalStorage>,
    learn: RwSignal<Stage, LocalStorage>,
    /// Owns what the parts make.
    app: StoredValue<Owner>,
    states: StoredValue<States, LocalStorage>,
    /// What views are to show once they are there.
    waiting: StoredValue<Vec<(View, Link)>, LocalStorage>,
}

impl Later {
    /// For the component in which it is made.
    pub fn new() -> Self {
        Self {
            views: RwSignal::new_local(Stage::Not),
            log: RwSignal::new_local(Stage::Not),
            learn: RwSignal::new_local(Stage::Not),
            app: StoredValue::new(Owner::current().unwrap_or_default()),
            states: StoredValue::new_local(Vec::new()),
            waiting: StoredValue::new_local(Vec::new()),
        }
    }

    const fn stage(self, part: Part) -> RwSignal<Stage, LocalStorage> {
        match part {
            Part::Views => self.views,
            Part::Log => self.log,
            Part::Learn => self.learn,
        }
    }

    /// Loads a part, if that has not begun.
    pub fn load(self, part: Part) {
        let stage = self.stage(part);
        if let Stage::Loading | Stage::There(_) = stage.get_untracked() {
            return;
        }
        stage.set(Stage::Loading);
        spawn_local(async move {
            let has_style = part == Part::Log || stylesheet::load_later().await;
            let loaded = match part {
                _ if !has_style => Err(NotLoaded),
                Part::Views => views().await,
                Part::Log => log().await,
                Part::Learn => learn().await,
            };
            stage.set(match loaded {
                Ok(content) => {
                    self.app.get_value().with(content.start);
                    Stage::There(content)
                }
                Err(NotLoaded) => Stage::Failed,
            });
        });
    }

    /// Whether a part could not be loaded.
    pub fn has_failed(self, part: Part) -> bool {
        matches!(self.stage(part).get(), Stage::Failed)
    }

    /// What `view` shows, or is to show.
    pub fn link(self, view: View) -> Link {
        let shown = self.states.with_value(|states| {
            states.iter().find(|(other, _)| *other == view).map(|(_, state)| state.link())
        });
        let waiting = || {
            self.waiting.with_value(|waiting| {
                waiting.iter().find(|(other, _)| *other == view).map(|(_, link)| link.clone())
            })
        };
        shown.or_else(waiting).unwrap_or_default()
    }

    /// `view` shows something else, now or once it is there.
    pub fn follow(self, view: View, link: Link) {
        let rest = self.states.with_value(|states| match states.iter().find(|(other, _)| *other == view) {
            Some((_, state)) => {
                state.follow(link);
                None
            }
            None => Some(link),
        });
        if let Some(link) = rest {
            self.waiting.update_value(|waiting| {
                waiting.retain(|(other, _)| *other != view);
                waiting.push((view, link));
            });
        }
    }

    /// A state is there.
    fn give(self, view: View, state: Box<dyn Linked>) {
        let waiting = self.waiting.try_update_value(|waiting| {
            let at = waiting.iter().position(|(other, _)| *other == view)?;
            Some(waiting.swap_remove(at).1)
        });
        if let Some(link) = waiting.flatten() {
            state.follow(link);
        }
        self.states.update_value(|states| states.push((view, state)));
    }
}

/// A piece of a later part, which is loaded if it is not there.
#[component]
pub fn LaterPiece(piece: Piece) -> impl IntoView {
    let later = expect_context::<Later>();
    let part = piece.part();
    // What stands beside a view comes and goes with each keystroke: it does not ask again by itself.
    if piece.is_view() || matches!(later.stage(part).get_untracked(), Stage::Not) {
        later.load(part);
    }
    move || {
        let stage = later.stage(part);
        // What is there stays there: a piece that comes and goes with each keystroke need not be told.
        let there = Some(stage.get_untracked()).filter(|stage| matches!(stage, Stage::There(_)));
        match there.unwrap_or_else(|| stage.get()) {
        Stage::There(content) => (content.draw)(piece),
        // Nor is it waited for.
        _ if !piece.is_view() => ().into_any(),
        Stage::Not | Stage::Loading => {
            view! { <p class="coming" role="status">"One moment"</p> }.into_any()
        }
        Stage::Failed => view! {
            <CouldNotLoad part>
                "This part of the page could not be loaded: check the connection. What you typed is still here."
            </CouldNotLoad>
        }
        .into_any(),
    }
    }
}

/// Says that a part could not be loaded, and what that means.
#[component]
pub fn CouldNotLoad(part: Part, children: Children) -> impl IntoView {
    let later = expect_context::<Later>();
    view! {
        <div class="refused" role="alert">
            <span>{children()}</span>
            <button type="button" class="button low" on:click=move |_| later.load(part)>
                "Try again"
            </button>
        </div>
    }
}
