//! A telegram of somebody's own with a fault in it, for others to find. It travels in the link: the telegram as
//! it should be, the fault, and a seed for its place.

use leptos::ev::SubmitEvent;
use leptos::prelude::*;

use super::go;
use super::question::Asked;
use super::start::any_seed;
use super::state::Where;
use crate::components::icon::{Glyph, Icon};
use crate::views::learn::LearnState;
use crate::views::learn::state::Part;
use crate::views::read::ReadState;
use buslens::field::hex;
use buslens::tool::{PROFILES, Profile, Protocol};
use buslens_trainer::Task;
use buslens_trainer::fault::{self, Fault};
use buslens_trainer::practice::Seed;
use buslens_trainer::random::Random;

/// The first word of its places.
pub const OWN: &str = "own";

/// What a link to such a task says.
#[derive(Clone, Debug)]
struct OwnTask {
    fault: Fault,
    seed: Seed,
    device: Option<&'static Profile>,
    /// The telegram, behind its request if it answers one.
    text: String,
}

impl OwnTask {
    /// `own.1.bit-flipped.K7QM.memograph-rsg45.010300C800038435-0103…`; the number is the version.
    fn of(place: &str) -> Option<Self> {
        let mut words = place.split('.').skip(1);
        words.next().filter(|version| *version == "1")?;
        let fault = Fault::of(words.next()?)?;
        let seed = Seed::of(words.next()?)?;
        let device = Profile::of(words.next()?);
        let text = words.next()?.replace('-', "\n");
        Some(Self { fault, seed, device, text })
    }

    fn place(&self) -> String {
        let device = self.device.map_or("any", |device| device.key);
        let text: Vec<String> = self.text.lines().map(|line| line.replace(' ', "")).collect();
        format!("{OWN}.1.{}.{}.{device}.{}", self.fault.key(), self.seed, text.join("-"))
    }

    fn task(&self) -> Result<Task, &'static str> {
        let telegram = fault::telegram(&self.text, Protocol::of("modbus-rtu"), self.device)?;
        fault::task(&telegram, self.fault, &mut Random::of(&[self.seed.number().into()]))
            .ok_or("This fault cannot be in this telegram so that it can be found: choose another one.")
    }
}

#[component]
pub fn Own(place: String) -> impl IntoView {
    let learn = expect_context::<LearnState>();
    let made = OwnTask::of(&place).map(|own| own.task());
    match made {
        Some(Ok(task)) => {
            let back = Callback::new(move |()| go(learn, Where::Start));
            view! {
                <nav class="round" aria-label="This task">
                    <button type="button" class="button plain low" on:click=move |_| go(learn, Where::Start)>
                        <Icon glyph=Glyph::Back />
                        "All kinds"
                    </button>
                    <p>
                        <strong>"A task of somebody's own"</strong>
                        <span class="soft">" “Copy link” above hands it on."</span>
                    </p>
                </nav>
                <Asked task key=(place, 0) label="To all kinds" on_next=back />
            }
            .into_any()
        }
        Some(Err(why)) => view! { <Making why /> }.into_any(),
        None if place == OWN => view! { <Making why="" /> }.into_any(),
        None => view! { <Making why="This link is incomplete or damaged. Ask for it again, or make a task here." /> }
            .into_any(),
    }
}

/// Where a task is made.
#[component]
fn Making(why: &'static str) -> impl IntoView {
    let learn = expect_context::<LearnState>();
    let read = expect_context::<ReadState>();
    let typed = learn.practice.own;
    // `None` is any that can be in it.
    let chosen = RwSignal::new(None::<Fault>);
    let device = RwSignal::new(None::<&'static str>);
    let refused = RwSignal::new(why);
    let make = move |event: SubmitEvent| {
        event.prevent_default();
        let device = device.get_untracked().and_then(Profile::of);
        let telegram =
            match typed.with_untracked(|text| fault::telegram(text, Protocol::of("modbus-rtu"), device)) {
                Ok(telegram) => telegram,
                Err(why) => return refused.set(why),
            };
        let lines = telegram.request.iter().chain([&telegram.bytes]).map(|bytes| hex(bytes));
        let text = lines.collect::<Vec<_>>().join("\n");
        let seed = any_seed();
        let mut faults = Fault::ALL.to_vec();
        Random::of(&[seed.number().into()]).shuffle(&mut faults);
        let tried = chosen.get_untracked().map_or(faults, |fault| vec![fault]);
        let own = |fault| OwnTask { fault, seed, device, text: text.clone() };
        match tried.into_iter().map(own).find(|own| own.task().is_ok()) {
            Some(own) => {
                learn.practice.moved.set_value(true);
                learn.go_to(Part::Practice, own.place());
            }
            None => refused
                .set("This fault cannot be in this telegram so that it can be found: choose another one."),
        }
    };
    let faults = Fault::ALL.map(|fault| view! { <option value=fault.key()>{fault.label()}</option> });
    let devices = PROFILES.iter().map(|device| view! { <option value=device.key>{device.label}</option> });
    let devices = devices.collect_view();
    view! {
        <button type="button" class="button plain low back" on:click=move |_| go(learn, Where::Start)>
            <Icon glyph=Glyph::Back />
            "All kinds"
        </button>
        <form class="own" on:submit=make>
            <h3 class="headline">"Hide a fault in a telegram of your own"</h3>
            <p class="intro">
                "Paste a telegram of Modbus RTU that is right; with its request before it, if it is a response. The fault is put into it, and the link to the task holds everything."
            </p>
            <label class="typed">
                <span>"Telegram, or request and response"</span>
                <textarea
                    class="input mono"
                    rows="3"
                    spellcheck="false"
                    placeholder="01 03 00 C8 00 03 84 35"
                    prop:value=typed
                    on:input=move |event| {
                        refused.set("");
                        typed.set(event_target_value(&event));
                    }
                ></textarea>
            </label>
            <button
                type="button"
                class="button low"
                on:click=move |_| {
                    let report = read.report();
                    let last = report.telegrams.iter().rev().take(2).collect::<Vec<_>>();
                    let lines: Vec<String> = last.iter().rev().map(|telegram| hex(&telegram.line.bytes)).collect();
                    refused.set(if lines.is_empty() { "Nothing is in Read yet." } else { "" });
                    if !lines.is_empty() {
                        typed.set(lines.join("\n"));
                    }
                }
            >
                "Take the last telegrams from Read"
            </button>
            <label class="typed short">
                <span>"Fault"</span>
                <select class="select" on:change=move |event| chosen.set(Fault::of(&event_target_value(&event)))>
                    <option value="">"Any, by chance"</option>
                    {faults.collect_view()}
                </select>
            </label>
            <label class="typed short">
                <span>"Device"</span>
                <select
                    class="select"
                    on:change=move |event| device.set(Profile::of(&event_target_value(&event)).map(|it| it.key))
                >
                    <option value="">"Any"</option>
                    {devices}
                </select>
            </label>
            <p class="misfit" role="alert">{refused}</p>
            <button type="submit" class="button main">"Make the task"</button>
        </form>
    }
}
