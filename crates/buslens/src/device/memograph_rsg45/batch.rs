//! Batches, from register 3088 on.
//!
//! Written: function (1 byte), batch (1 byte), text up to the end. Read: communication status
//! (2 bytes), then a byte for each of the four batches.

use std::cmp::Ordering;

use super::UNUSED;
use super::command::{Command, Function, Functions, Second, names};
use super::text::{Say, Text, check_length, check_number};
use crate::device::Settings;
use crate::field::{Argument, Message, Name, Role, Spec};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

pub fn write(_: &Settings) -> Box<dyn Telegram> {
    Box::new(Command::new(&FUNCTIONS, 1))
}

pub fn read(_: &Settings) -> Box<dyn Telegram> {
    Box::new(Status { communication: 0, states: vec![0; BATCHES], unused: Vec::new() })
}

static FUNCTIONS: Functions = Functions {
    spec: Spec::new("function", "Function")
        .role(Role::Function)
        .names(&NAMES)
        .note("What is to be done with the batch.")
        .source(SOURCE),
    list: &LIST,
};

static NAMES: [Name; 6] = names(&LIST);

static LIST: [Function; 6] = [
    function(1, Spec::new("start", "start batch"), &USER),
    function(2, Spec::new("stop", "stop batch"), &USER),
    function(3, Spec::new("set_identifier", "set batch identifier").note(BEFORE_START), &IDENTIFIER),
    function(4, Spec::new("set_name", "set batch name").note(BEFORE_START), &NAME),
    function(5, Spec::new("set_number", "set batch number").note(BEFORE_START), &NUMBER),
    function(6, Spec::new("set_preset", "set preset counter").note(BEFORE_START), &PRESET),
];

const BEFORE_START: &str =
    "Only while the batch does not run; not needed where the device does not ask for it.";

const fn function(code: u8, spec: Spec, text: &'static Text) -> Function {
    let spec = spec.role(Role::Function).source(SOURCE);
    Function { code, spec, second: Second::Number(&BATCH), text: Some(text) }
}

static BATCH: Spec = Spec::new("batch", "Batch")
    .role(Role::Address)
    .limits(1, 4)
    .note("Which of the four batches is meant.")
    .source(SOURCE);

static USER: Text = Text::new(
    Spec::new("user", "User")
        .told(tell_user)
        .note(
            "Who does it, as ID;name, where the device has its user administration switched on. \
             ID: at most 8 characters, name: at most 20.",
        )
        .source(SOURCE),
    8 + 1 + 20,
)
.rule(check_user);

static IDENTIFIER: Text = Text::new(
    Spec::new("identifier", "Batch identifier")
        .short("Identifier")
        .note("At most 30 characters.")
        .source(SOURCE),
    30,
);

static NAME: Text = Text::new(
    Spec::new("name", "Batch name").short("Name").note("At most 30 characters.").source(SOURCE),
    30,
);

static NUMBER: Text = Text::new(
    Spec::new("number", "Batch number")
        .short("Number")
        .note("At most 30 characters, which need not be digits.")
        .source(SOURCE),
    30,
);

static PRESET: Text = Text::new(
    Spec::new("preset", "Preset counter")
        .short("Preset")
        .note(
            "The count that stops the batch: a positive number of at most 8 characters, such as 12.345 \
             or 1.23E-2.",
        )
        .source(SOURCE),
    8,
)
.required()
.rule(check_preset);

/// "ID IDSPS, name RemoteX".
fn tell_user(text: &str) -> Option<Message> {
    let (id, name) = text.trim_end_matches(' ').split_once(';')?;
    Some(message!(
        "ID {id}, name {name}",
        id = Argument::Text(id.to_owned()),
        name = Argument::Text(name.to_owned())
    ))
}

fn check_user(text: &str, say: Say<'_>) {
    match text.split_once(';') {
        Some((id, name)) => {
            check_length("User ID", id.len(), 8, say);
            check_length("User name", name.len(), 20, say);
        }
        None => {
            let message = message!("“{text}” has no semicolon: write ID;name", text = text.to_owned());
            say("separator-missing", message);
        }
    }
}

fn check_preset(text: &str, say: Say<'_>) {
    if check_number(PRESET.spec.label, text, say).is_some_and(Ordering::is_le) {
        let message =
            message!("Preset counter is {text}; only positive numbers are allowed", text = text.to_owned());
        say("out-of-range", message);
    }
}

/// What became of the last function, and whether the batches run.
struct Status {
    communication: u16,
    /// Fewer where fewer registers are read.
    states: Vec<u8>,
    unused: Vec<u8>,
}

impl Telegram for Status {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        w.u16(&COMMUNICATION, &mut self.communication)?;
        let kept = self.states.len();
        let there = w.ahead(0, &mut |w| self.walk_states(w, kept));
        self.walk_states(w, there.map_or(kept, |there| BATCHES.min(there as usize)))?;
        w.bytes(&UNUSED, &mut self.unused, None)
    }
}

impl Status {
    fn walk_states(&mut self, w: &mut dyn Walker, count: usize) -> Walk {
        w.list(&STATES, &mut self.states, count, Some(1), |w, state| w.u8(&STATE, state))
    }
}

/// The status and the four batches.
pub static READS: Spec = Spec::new("registers", "Registers")
    .role(Role::Count)
    .initial(3)
    .names(&[Name { value: 3, label: "communication status and batches", note: "" }])
    .note("How many registers are read.")
    .source(SOURCE);

static COMMUNICATION: Spec = Spec::new("communication_status", "Communication status")
    .short("Status")
    .role(Role::Status)
    .note("What became of the last batch function. The device may know more codes than these.")
    .source("Memograph M RSG45 Modbus supplement, 2.6.13; PROFIBUS DP supplement, page 20")
    .names(&[
        Name { value: 0, label: "ok", note: "" },
        Name { value: 1, label: "data missing", note: "The function needs more than was sent." },
        Name {
            value: 2,
            label: "no authorised user logged in",
            note: "The user administration is switched on: send ID and name with the function.",
        },
        Name { value: 3, label: "batch already running", note: "" },
        Name { value: 4, label: "batch not set up", note: "" },
        Name {
            value: 5,
            label: "batch controlled by control input",
            note: "An input of the device starts and stops it, so that the bus cannot.",
        },
    ]);

static STATES: Spec = Spec::new("states", "Batches").note("A byte for each batch.").source(SOURCE);

static STATE: Spec = Spec::new("state", "Batch")
    .role(Role::Status)
    .names(&[Name { value: 0, label: "stopped", note: "" }, Name { value: 1, label: "running", note: "" }])
    .only_named()
    .note("Whether the batch runs.")
    .source(SOURCE);

const BATCHES: usize = 4;

const SOURCE: &str = "Memograph M RSG45 Modbus supplement, 2.6.13";
