//! Limits, from register 3216 on.
//!
//! Written: function (1 byte), limit number or filler (1 byte), text up to the end. The way to
//! change limits: open editing, change, give a reason if there is one, accept.
//!
//! Read: limit number (1 byte). Where that is 0, a status code (1 byte) follows; else the record
//! of that limit: type (1), value (4), span (2), delay (4), value 2 (4). How many registers are
//! read does not tell which of the two it is: asked for a record, the device gives a status and
//! fills up with zeros where the number was wrong.

use super::UNUSED;
use super::command::{Command, Function, Functions, Second, names};
use super::text::{Say, Text, check_number, check_whole};
use crate::device::Settings;
use crate::field::{Argument, Format, Message, Name, Role, Spec};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

pub fn write(_: &Settings) -> Box<dyn Telegram> {
    Box::new(Command::new(&FUNCTIONS, 1))
}

pub fn read(settings: &Settings) -> Box<dyn Telegram> {
    Box::new(Limit { read_back: settings.present.limits_read_back, ..Limit::default() })
}

/// One register for the status, eight for a limit.
pub static READS: Spec = Spec::new("registers", "Registers")
    .role(Role::Count)
    .initial(1)
    .names(&[
        Name { value: 1, label: "communication status", note: "What became of the last function." },
        Name { value: 8, label: "record of a limit", note: "Once reading back is on." },
    ])
    .note("How many registers are read: that decides what they hold.")
    .source(SOURCE);

static FUNCTIONS: Functions = Functions {
    spec: Spec::new("function", "Function")
        .role(Role::Function)
        .names(&NAMES)
        .note("A step of changing limits, or reading them back.")
        .source(SOURCE),
    list: &LIST,
};

static NAMES: [Name; 5] = names(&LIST);

static LIST: [Function; 5] = [
    function(
        1,
        Spec::new("open_editing", "open editing").note("The first step: from now on limits can be changed."),
        FILLER,
        None,
    ),
    function(
        2,
        Spec::new("accept", "accept changes")
            .note("The last step: the changed limits become effective and are kept."),
        FILLER,
        None,
    ),
    function(
        3,
        Spec::new("change", "change limit").note("Not effective before the changes are accepted."),
        Second::Number(&LIMIT),
        Some(&CHANGE),
    ),
    function(
        4,
        Spec::new("read_back", "read limits back").note(
            "From now on, reading 8 registers gives a limit, then the next active one, and so on, \
             but no status. Any other function ends this.",
        ),
        Second::Checked(&FIRST, check_first),
        None,
    ),
    function(
        5,
        Spec::new("give_reason", "give reason").note("For the event list; between changing and accepting."),
        Second::Number(&OPEN),
        Some(&REASON),
    ),
];

const fn function(code: u8, spec: Spec, second: Second, text: Option<&'static Text>) -> Function {
    Function { code, spec: spec.role(Role::Function).source(SOURCE), second, text }
}

/// The manual calls this byte of the first step a limit value; it is a filler as in the last step.
const FILLER: Second = Second::Filler(&FILLER_BYTE, 0x2A);

static FILLER_BYTE: Spec = Spec::new("filler", "Filler")
    .role(Role::Unknown)
    .format(Format::Hex)
    .note("It only fills the register: the manual pads with 2Ah.")
    .source(SOURCE);

static LIMIT: Spec = Spec::new("limit", "Limit")
    .role(Role::Address)
    .limits(1, MOST)
    .note("The number of the limit in the device.")
    .source(SOURCE);

static FIRST: Spec = Spec::new("first_limit", "First limit")
    .role(Role::Address)
    .names(&[Name { value: OFF, label: "off", note: "Reading gives the status again." }])
    .note("From which limit, 1 to 60, the active ones are read back.")
    .source(SOURCE);

fn check_first(number: u8) -> Option<Message> {
    let number = u64::from(number);
    (number != OFF && !LIMIT.allows(number)).then(|| {
        message!(
            "First limit is {number}; 1 to {most} are allowed, and {off} to end reading back",
            number = number,
            most = MOST,
            off = OFF
        )
    })
}

static OPEN: Spec = Spec::new("second_byte", "Second byte")
    .short("Second")
    .note("The manual leaves open what it is, and sends 1 in its example.")
    .source(SOURCE);

/// No longest length in the manual: as much as the registers hold.
static CHANGE: Text = Text::new(
    Spec::new("new_values", "New values")
        .told(tell_change)
        .note(
            "Value;span;delay;value 2, such as 5.22;;60 for a value of 5.22 and a delay of 60 s. What is \
             left out stays as it is. Span: 0 to 60 s; delay: 0 to 99999 s; value 2: upper limit of a band.",
        )
        .source(SOURCE),
    30,
)
.required()
.rule(check_change);

static REASON: Text = Text::new(
    Spec::new("reason", "Reason")
        .note("Why limits are changed, at most 30 characters, for the event list.")
        .source(SOURCE),
    30,
);

/// "value 5.22, delay 60 s".
fn tell_change(text: &str) -> Option<Message> {
    let parts = text.split(';').map(str::trim).enumerate().filter(|(_, part)| !part.is_empty());
    Message::list(parts.map(|(index, part)| {
        let part = Argument::Text(part.to_owned());
        match index {
            0 => message!("value {part}", part = part),
            1 => message!("span {part} s", part = part),
            2 => message!("delay {part} s", part = part),
            3 => message!("value 2 {part}", part = part),
            _ => message!("{part} too many", part = part),
        }
    }))
}

fn check_change(text: &str, say: Say<'_>) {
    // The device takes no notice of spaces.
    let text: String = text.chars().filter(|c| *c != ' ').collect();
    if text.bytes().all(|byte| byte == b';') {
        say("nothing-new", message!("all values are left out: nothing is changed"));
    }
    for (index, part) in text.split(';').enumerate().filter(|(_, part)| !part.is_empty()) {
        match index {
            0 => _ = check_number(VALUE.label, part, say),
            1 => check_whole(SPAN.label, part, MOST_SPAN, say),
            2 => check_whole(DELAY.label, part, MOST_DELAY, say),
            3 => _ = check_number(VALUE_2.label, part, say),
            _ => say(
                "too-many-values",
                message!("“{part}” is one value more than a limit has", part = part.to_owned()),
            ),
        }
    }
}

/// A status, or the record of a limit.
#[derive(Default)]
struct Limit {
    /// 0 for a status.
    number: u8,
    status: u8,
    unused: Vec<u8>,
    kind: u8,
    value: u32,
    span: u16,
    delay: u32,
    value_2: u32,
    /// Limits are being read back: no status comes.
    read_back: bool,
}

impl Telegram for Limit {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        w.u8(&NUMBER, &mut self.number)?;
        if self.number == 0 {
            w.u8(if self.read_back { &NO_LIMIT } else { &STATUS }, &mut self.status)?;
        } else {
            w.u8(&KIND, &mut self.kind)?;
            w.u32(&VALUE, &mut self.value)?;
            w.u16(&SPAN, &mut self.span)?;
            w.u32(&DELAY, &mut self.delay)?;
            w.u32(&VALUE_2, &mut self.value_2)?;
        }
        w.bytes(&UNUSED, &mut self.unused, None)
    }
}

static NUMBER: Spec = Spec::new("limit", "Limit")
    .role(Role::Address)
    .limits(0, MOST)
    .names(&[Name { value: 0, label: "", note: "No limit, but a status." }])
    .note("The limit's number. After each reading the device goes on to the next active limit.")
    .source(SOURCE);

/// While limits are read back, zeros say that there is none.
static NO_LIMIT: Spec = Spec::new("no_limit", "Read back")
    .role(Role::Status)
    .names(&[Name { value: 0, label: "no limit is active", note: "" }])
    .note("While limits are read back, the device gives one after the other, and no status.")
    .source(SOURCE);

static STATUS: Spec = Spec::new("communication_status", "Communication status")
    .short("Status")
    .role(Role::Status)
    .only_named()
    .note("What became of the last function over limits.")
    .source(SOURCE)
    .names(&[
        Name { value: 0, label: "ok", note: "With reading back on, that no limit is active." },
        Name { value: 1, label: "wrong function or limit number", note: "" },
        Name { value: 2, label: "data missing", note: "The function needs more than was sent." },
        Name { value: 3, label: "limit not active", note: "The limit is switched off in the device." },
        Name { value: 4, label: "value out of range", note: "" },
        Name {
            value: 5,
            label: "not possible now",
            note: "Open editing first, and change before accepting.",
        },
        Name { value: 9, label: "error", note: "" },
    ]);

static KIND: Spec = Spec::new("type", "Limit type")
    .short("Type")
    .note("What the limit watches.")
    .source(SOURCE)
    .only_named()
    .names(&[
        Name { value: 0, label: "off", note: "" },
        Name { value: 1, label: "upper limit", note: "" },
        Name { value: 2, label: "lower limit", note: "" },
        Name { value: 3, label: "evaluation 1", note: "" },
        Name { value: 4, label: "evaluation 2", note: "" },
        Name { value: 5, label: "evaluation 3", note: "" },
        Name { value: 6, label: "evaluation 4", note: "" },
        Name {
            value: 7,
            label: "gradient",
            note: "How fast the value changes: by the value within the span.",
        },
        Name { value: 8, label: "statistics 1, frequency", note: "" },
        Name { value: 9, label: "statistics 2, frequency", note: "" },
        Name { value: 10, label: "statistics 3, frequency", note: "" },
        Name { value: 11, label: "statistics 4, frequency", note: "" },
        Name { value: 12, label: "statistics 1, duration", note: "" },
        Name { value: 13, label: "statistics 2, duration", note: "" },
        Name { value: 14, label: "statistics 3, duration", note: "" },
        Name { value: 15, label: "statistics 4, duration", note: "" },
        Name { value: 16, label: "in-band", note: "Value and value 2 are the band's lower and upper limit." },
        Name {
            value: 17,
            label: "out-band",
            note: "Value and value 2 are the band's lower and upper limit.",
        },
    ]);

static VALUE: Spec = Spec::new("value", "Value")
    .format(Format::Float)
    .note("The limit, in the channel's unit; of a band, the lower one.")
    .source(SOURCE);

/// 0 to 60 in one table of the manual, 1 to 60 in another.
static SPAN: Spec = Spec::new("span", "Span")
    .limits(0, MOST_SPAN as u64)
    .unit("s")
    .note("The time over which a gradient is taken; without meaning for other types.")
    .source(SOURCE);

static DELAY: Spec = Spec::new("delay", "Delay")
    .limits(0, MOST_DELAY as u64)
    .unit("s")
    .note("How long the limit must be violated before the device says so.")
    .source(SOURCE);

static VALUE_2: Spec = Spec::new("value_2", "Value 2")
    .format(Format::Float)
    .note("The upper limit of a band; without meaning for other types.")
    .source(SOURCE);

/// Limits of the device.
const MOST: u64 = 60;
/// The first limit that ends reading back.
const OFF: u64 = 255;
const MOST_SPAN: u32 = 60;
const MOST_DELAY: u32 = 99999;

const SOURCE: &str = "Memograph M RSG45 Modbus supplement, 2.6.11";
