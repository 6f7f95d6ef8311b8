//! The parameter channel: read and write parameters by index, job by job, within the cyclic data.
//!
//! Layout, 8 bytes: control byte VW (1), subindex (1), index (2), value or error (4). A value of 1 to
//! 4 bytes begins at byte 5; an error is class (1), code (1), additional code (2).
//!
//! A confirmation counts when its handshake bit equals that of the request; until then the slave
//! shows the confirmation before. [`jobs`](super::jobs) follows that.
//!
//! With ValueSwapping bit 1, the index and values of 4 bytes come low byte first. The manual leaves
//! open what happens to shorter values and to errors; they are taken as not swapped.
//!
//! Source: KEB COMBIVERT F5 PROFIBUS-DP operator, 7.4, 9 (subindex), 12.4 (errors).

use super::{Body, Kind, Settings};
use crate::field::{Argument, Bits, Direction, Format, Message, Name, Order, Role, Severity, Spec};
use crate::field::{hex, hex_value};
use crate::message;
use crate::walk::{self, Deviations, Telegram, Walk, Walker};

pub static REQUEST: Kind = Kind {
    sap: None,
    direction: Direction::Request,
    spec: Spec::new("parameter_channel_request", "Parameter channel")
        .note("A job for the slave. The master repeats it until the slave confirms it.")
        .source(SOURCE),
    new: |settings| Box::new(Channel::new(Direction::Request, settings)),
};

pub static RESPONSE: Kind = Kind {
    sap: None,
    direction: Direction::Response,
    spec: Spec::new("parameter_channel_response", "Parameter channel")
        .note("A slave's confirmation. It counts when its handshake is that of the request.")
        .source(SOURCE),
    new: |settings| Box::new(Channel::new(Direction::Response, settings)),
};

/// Bytes of the parameter channel.
pub const LENGTH: usize = 8;

/// Bytes for a value or an error.
const DATA: usize = 4;

/// A request or a confirmation of the parameter channel.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    pub direction: Direction,
    /// ValueSwapping bit 1.
    pub swapped: bool,
    /// VW, as on the wire.
    pub control: u8,
    pub subindex: u8,
    pub index: u16,
    /// Counts where [`value`](Self::value) gives it.
    pub value: u32,
    /// Counts where [`refusal`](Self::refusal) gives it.
    pub refusal: Refusal,
    /// The bytes that are neither value nor error.
    pub unused: Vec<u8>,
    /// How long the value of the request is, which a confirmation of a write may not tell.
    pub request_length: Option<usize>,
}

/// What a request asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Service {
    None,
    Read,
    Write,
    /// Both bits set: not allowed.
    Both,
}

impl Service {
    /// The stable word of exports.
    pub const fn key(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Read => "read",
            Self::Write => "write",
            Self::Both => "both",
        }
    }
}

/// Why a slave did not do a job.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Refusal {
    pub class: u8,
    pub code: u8,
    pub additional: u16,
}

impl Refusal {
    /// Every error that the manual lists, with its name.
    pub fn all() -> impl Iterator<Item = (Self, &'static Name)> {
        ERRORS.iter().flat_map(|errors| {
            errors.additional.names.iter().map(|name| {
                let Errors { class, code, .. } = *errors;
                (Self { class, code, additional: name.value as u16 }, name)
            })
        })
    }

    /// Those that a slave can answer a request for this service with.
    pub fn possible(service: Service) -> impl Iterator<Item = (Self, &'static Name)> {
        Self::all().filter(move |(refusal, _)| {
            let Self { class, code, additional } = *refusal;
            match (class, code, additional) {
                (5, 4, _) => service == Service::Both,
                // What only happens where something is to be changed.
                (6, 3, 0) | (6, 5, 0) | (8, 0, 0x30) => service == Service::Write,
                _ => matches!(service, Service::Read | Service::Write),
            }
        })
    }

    /// What the manual calls this error. Only all three numbers together say it.
    pub fn name(&self) -> Option<&'static Name> {
        self.additional_spec().name(self.additional.into())
    }

    /// "8-0-0030h".
    pub fn number(&self) -> Message {
        message!(
            "{class}-{code}-{additional}",
            class = self.class,
            code = self.code,
            additional = hex_value(self.additional.into(), 2)
        )
    }

    /// What the additional codes of this class and code are called.
    fn additional_spec(&self) -> &'static Spec {
        let known = ERRORS.iter().find(|errors| (errors.class, errors.code) == (self.class, self.code));
        known.map_or(&ADDITIONAL, |errors| &errors.additional)
    }
}

/// What the 4 bytes behind the index are.
#[derive(Clone, Copy)]
enum Content {
    Unused,
    /// A value of so many bytes, and unused ones.
    Value(usize),
    /// What was written, of a length that nothing tells.
    Written,
    Error,
}

impl Channel {
    /// A job, or the confirmation of one, with nothing in it.
    pub fn new(direction: Direction, settings: &Settings) -> Self {
        Self {
            direction,
            swapped: settings.swap_channel,
            control: 0,
            subindex: 0,
            index: 0,
            value: 0,
            refusal: Refusal::default(),
            unused: Vec::new(),
            request_length: None,
        }
    }

    /// The first 8 of `bytes`; those that are missing count as 0.
    pub fn read(bytes: &[u8], direction: Direction, settings: &Settings) -> Self {
        let mut channel = Self::new(direction, settings);
        walk::fill(&mut channel, bytes.get(..LENGTH).unwrap_or(bytes));
        channel
    }

    /// As on the wire.
    pub fn bytes(&self) -> [u8; LENGTH] {
        let written = walk::write(&mut self.clone(), &Deviations::default());
        written.first_chunk().copied().unwrap_or_default()
    }

    pub fn service(&self) -> Service {
        match SERVICE.of(self.control.into()) {
            1 => Service::Read,
            2 => Service::Write,
            3 => Service::Both,
            _ => Service::None,
        }
    }

    /// 0 or 1.
    pub fn handshake(&self) -> u8 {
        HANDSHAKE.of(self.control.into()) as u8
    }

    /// Makes the control byte of a request; `length` is 1 to 4 bytes.
    pub fn ask(&mut self, service: Service, length: usize, handshake: u8) {
        let parts =
            [(&SERVICE, service as u64), (&LENGTH_BITS, length as u64 - 1), (&HANDSHAKE, handshake.into())];
        self.control = parts.iter().fold(0, |control, (part, value)| part.put(control, *value)) as u8;
    }

    /// The number of bytes that the length bits tell, 1 to 4, whether there is a value or not.
    pub fn length_bits(&self) -> usize {
        LENGTH_BITS.of(self.control.into()) as usize + 1
    }

    /// How many bytes the value has; `None` where there is none, or where nothing tells: a slave may
    /// leave the length bits 0 when it confirms a write.
    pub fn length(&self) -> Option<usize> {
        match self.content() {
            Content::Value(length) => Some(length),
            Content::Unused | Content::Written | Content::Error => None,
        }
    }

    /// The value to write, written or read.
    pub fn value(&self) -> Option<u32> {
        self.length().map(|_| self.value)
    }

    /// The error of a confirmation that has one.
    pub fn refusal(&self) -> Option<Refusal> {
        matches!(self.content(), Content::Error).then_some(self.refusal)
    }

    /// The confirmation `self` as the answer to `request`, which tells how much was written.
    pub fn answering(&self, request: &Self) -> Self {
        let mut answer = Self { request_length: request.length(), ..self.clone() };
        walk::fill(&mut answer, &self.bytes());
        answer
    }

    /// Makes this the confirmation of `request`: with what was written, or with 0 in 4 bytes for what
    /// was read; or with an error.
    pub fn confirm(&mut self, request: &Self, refusal: Option<Refusal>) {
        self.control = request.control;
        (self.index, self.subindex) = (request.index, request.subindex);
        self.request_length = request.length();
        if request.service() == Service::Read {
            self.ask(Service::Read, DATA, request.handshake());
        }
        self.value = request.value().unwrap_or_default();
        if let Some(refusal) = refusal {
            self.control = ERROR.put(self.control.into(), 1) as u8;
            self.refusal = refusal;
        }
    }

    /// Index and subindex in a sentence.
    pub(super) fn place(&self) -> Message {
        let index = hex_value(self.index.into(), 2);
        match self.subindex {
            0 => message!("index {index}", index = index),
            mask if has_sets(self.index) => {
                let sets = (0..8).filter(|set| mask >> set & 1 == 1).map(|set: u8| set.to_string());
                let sets = sets.collect::<Vec<_>>().join(", ");
                match mask.count_ones() {
                    1 => message!("index {index}, set {set}", index = index, set = sets),
                    _ => message!("index {index}, sets {sets}", index = index, sets = sets),
                }
            }
            subindex => message!("index {index}, subindex {subindex}", index = index, subindex = subindex),
        }
    }

    fn content(&self) -> Content {
        let request = self.direction == Direction::Request;
        let told = self.length_bits();
        match self.service() {
            _ if !request && ERROR.of(self.control.into()) == 1 => Content::Error,
            Service::None | Service::Both => Content::Unused,
            Service::Read if request => Content::Unused,
            Service::Read => Content::Value(told),
            Service::Write if request => Content::Value(told),
            Service::Write => match self.request_length {
                Some(length) => Content::Value(length),
                None if told > 1 => Content::Value(told),
                None => Content::Written,
            },
        }
    }

    fn walk_value(&mut self, w: &mut dyn Walker, length: usize) -> Walk {
        let spec = if self.swapped && length == DATA { &VALUE_LOW_FIRST } else { &VALUE };
        let mut raw = u64::from(self.value);
        let walk = w.number(spec, length, &mut raw);
        // At most four bytes wide, so it fits.
        self.value = raw as u32;
        walk
    }

    fn walk_unused(&mut self, w: &mut dyn Walker, spec: &'static Spec, count: usize) -> Walk {
        if count == 0 {
            return Ok(());
        }
        self.unused.resize(count, 0);
        w.bytes(spec, &mut self.unused, Some(count))
    }
}

impl Telegram for Channel {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        let control = match self.direction {
            Direction::Request => &REQUEST_CONTROL,
            Direction::Response => &RESPONSE_CONTROL,
        };
        w.u8(control, &mut self.control)?;
        if let (Direction::Response, Service::Read, Content::Value(length @ ..DATA)) =
            (self.direction, self.service(), self.content())
        {
            let message =
                message!("a KEB F5 answers every read with 4 bytes; this has {length}", length = length);
            w.remark(control, Severity::Warning, "read-length", message);
        }
        if self.direction == Direction::Request && self.service() == Service::Both {
            w.remark(
                control,
                Severity::Error,
                "read-and-write",
                message!("read and write are both set: the slave will reject that with error 5-4-0000h"),
            );
        }
        w.u8(&SUBINDEX, &mut self.subindex)?;
        w.u16(if self.swapped { &INDEX_LOW_FIRST } else { &INDEX }, &mut self.index)?;
        match self.content() {
            Content::Unused => self.walk_unused(w, &UNUSED, DATA),
            Content::Written => self.walk_unused(w, &WRITTEN, DATA),
            Content::Value(length) => {
                self.walk_value(w, length)?;
                self.walk_unused(w, &UNUSED, DATA - length)
            }
            Content::Error => {
                w.u8(&CLASS, &mut self.refusal.class)?;
                w.u8(&CODE, &mut self.refusal.code)?;
                w.u16(self.refusal.additional_spec(), &mut self.refusal.additional)
            }
        }
    }
}

impl Body for Channel {
    fn meaning(&self, who: Message) -> Message {
        let place = self.place();
        match (self.direction, self.service(), self.content()) {
            (_, _, Content::Error) => self.refused(who),
            (Direction::Request, Service::None, _) => message!("no job for {who}", who = who),
            (Direction::Response, Service::None, _) => message!("{who} has no job", who = who),
            (_, Service::Both, _) => {
                message!(
                    "read and write {place} of {who} at once, which is not allowed",
                    place = place,
                    who = who
                )
            }
            (Direction::Request, Service::Read, _) => {
                message!("ask {who} for {place}", who = who, place = place)
            }
            (Direction::Request, Service::Write, _) => {
                message!("write {value} to {place} of {who}", value = self.value, place = place, who = who)
            }
            (Direction::Response, Service::Read, _) => {
                message!("{who} answers: {place} = {value}", who = who, place = place, value = self.value)
            }
            (Direction::Response, Service::Write, Content::Value(_)) => message!(
                "{who} confirms: {place} written with {value}",
                who = who,
                place = place,
                value = self.value
            ),
            (Direction::Response, Service::Write, _) => message!(
                "{who} confirms: {place} written, data {data}; only the request tells how many bytes count",
                who = who,
                place = place,
                data = hex(&self.unused)
            ),
        }
    }

    fn channel(&self) -> Option<&Channel> {
        Some(self)
    }

    fn channel_mut(&mut self) -> Option<&mut Channel> {
        Some(self)
    }

    fn answer(&mut self, request: &Channel) {
        self.request_length = request.length();
    }
}

impl Channel {
    fn refused(&self, who: Message) -> Message {
        let job = match self.service() {
            Service::Read => message!("read {place}", place = self.place()),
            Service::Write => message!("write {place}", place = self.place()),
            Service::None | Service::Both => message!("do the job for {place}", place = self.place()),
        };
        let error = self.refusal.number();
        match self.refusal.name() {
            Some(name) => message!(
                "{who} rejects the job to {job}: {name} (error {error})",
                who = who,
                job = job,
                name = Argument::Term(name.label),
                error = error
            ),
            None => message!(
                "{who} rejects the job to {job} with error {error} (not listed in the manual)",
                who = who,
                job = job,
                error = error
            ),
        }
    }
}

/// Whether an index is that of an inverter parameter, for which the subindex is a set of sets. From XX80h
/// on, each group of parameters holds the operator's.
pub fn has_sets(index: u16) -> bool {
    (0x2000..=0x5EFF).contains(&index) && index & 0xFF < 0x80
}

/// What a subindex is: a set of sets, or the number of a part. Which of the two, the index behind it tells.
pub fn subindex_spec(sets: bool) -> &'static Spec {
    if sets { &SUBINDEX_SETS } else { &SUBINDEX_PART }
}

/// How much 8 bytes look like a parameter channel, in bits of chance: unused bits that are 0, an
/// index that there is, an error that the manual lists, no left-overs.
pub fn likeness(bytes: &[u8], settings: &Settings) -> u32 {
    const INDEX: u32 = 6;
    const ERROR: u32 = 8;
    const CLEAN: u32 = 2;
    /// More than anything else sees in zeros.
    const IDLE: u32 = 7;
    let [request, channel] =
        [Direction::Request, Direction::Response].map(|direction| Channel::read(bytes, direction, settings));
    let clean = |channel: &Channel| channel.unused.iter().all(|byte| *byte == 0);
    if channel.control & 0x0C != 0 {
        return 0;
    }
    match channel.service() {
        Service::None if bytes.iter().all(|byte| *byte == 0) => IDLE,
        Service::None => 0,
        _ if !(0x2000..=0x60FF).contains(&channel.index) => 0,
        _ => match channel.refusal() {
            Some(refusal) if refusal.name().is_some() => INDEX + ERROR,
            Some(_) => INDEX,
            None if clean(&request) || clean(&channel) => INDEX + CLEAN,
            None => INDEX,
        },
    }
}

/// How much 8 bytes look like a confirmation (above 0) or a request (below 0): an error is one; a
/// slave reads out 4 bytes and leaves the length of what it wrote open.
pub fn leaning(bytes: &[u8]) -> i32 {
    let [control, _, _, _, first, rest @ ..] = bytes else { return 0 };
    let channel = Channel { control: *control, ..Channel::new(Direction::Request, &Settings::default()) };
    let more = rest.iter().take(DATA - 1).any(|byte| *byte != 0);
    match (channel.service(), channel.length_bits()) {
        _ if ERROR.of((*control).into()) == 1 => 10,
        (Service::Read, 4) => 4,
        (Service::Read, _) => -2,
        (Service::Write, 1) if more => 3,
        (Service::Write, 1) if *first == 0 => 0,
        // A request for one byte, or the confirmation of two, the second of them 0.
        (Service::Write, 1) => -1,
        (Service::Write, _) => -3,
        _ => 0,
    }
}

/// Errors of the same class and code.
struct Errors {
    class: u8,
    code: u8,
    /// The additional code, with the meaning that its values have for this class and code.
    additional: Spec,
}

impl Errors {
    const fn new(class: u8, code: u8, names: &'static [Name]) -> Self {
        Self { class, code, additional: ADDITIONAL_CODE.names(names) }
    }
}

static ERRORS: &[Errors] = &[
    Errors::new(
        5,
        4,
        &[Name {
            value: 0x0000,
            label: "read and write at once",
            note: "Both service bits of the request are set: set one of them.",
        }],
    ),
    Errors::new(
        6,
        2,
        &[Name {
            value: 0x0000,
            label: "no link to the inverter",
            note: "The operator does not reach the inverter that it is plugged into.",
        }],
    ),
    Errors::new(
        6,
        3,
        &[
            Name {
                value: 0x0000,
                label: "parameter is write-protected",
                note: "The parameter can only be read.",
            },
            Name {
                value: 0x0030,
                label: "password level too low",
                note: "Set a password that allows this parameter.",
            },
        ],
    ),
    Errors::new(
        6,
        4,
        &[Name {
            value: 0x0000,
            label: "index not known",
            note: "There is no parameter with this index. Inverter parameters have 2000h added.",
        }],
    ),
    Errors::new(
        6,
        5,
        &[
            Name {
                value: 0x0000,
                label: "process data description not allowed",
                note: "What is to be mapped cannot be process data.",
            },
            Name {
                value: 0x0011,
                label: "subindex not known",
                note: "The parameter has no part or set with this subindex.",
            },
        ],
    ),
    Errors::new(
        8,
        0,
        &[
            Name { value: 0x0022, label: "inverter busy", note: "Try again later." },
            Name {
                value: 0x0030,
                label: "value out of range",
                note: "The value lies outside of what the parameter allows.",
            },
            Name {
                value: 0x0033,
                label: "set not allowed",
                note: "The parameter does not have the set that the subindex names.",
            },
            Name {
                value: 0x0034,
                label: "not possible now",
                note: "The inverter cannot do this in its present state.",
            },
        ],
    ),
];

static REQUEST_CONTROL: Spec = CONTROL
    .note("What is to be done. The handshake changes with each new job; repeats of a job keep it.")
    .bits(&[SERVICE, UNUSED_BITS, LENGTH_BITS, HANDSHAKE, Bits::reserved(7, 1)]);

static RESPONSE_CONTROL: Spec = CONTROL
    .note("What became of the job. Only if the handshake is that of the request, the rest counts.")
    .bits(&[SERVICE, UNUSED_BITS, LENGTH_BITS, HANDSHAKE, ERROR]);

const CONTROL: Spec = Spec::new("control", "Control byte").short("VW").role(Role::Function).source(SOURCE);

const SERVICE: Bits = Bits::part(0, 2, "service", "service")
    .names(&[
        Name { value: 0, label: "no service", note: "Nothing is asked for." },
        Name { value: 1, label: "read", note: "" },
        Name { value: 2, label: "write", note: "" },
        Name { value: 3, label: "read and write", note: "Not allowed: error 5-4-0000h." },
    ])
    .note("Bit 0 reads, bit 1 writes.");

const UNUSED_BITS: Bits = Bits::reserved(2, 2);

const LENGTH_BITS: Bits = Bits::part(4, 2, "length", "length less 1")
    .names(&[
        Name { value: 0, label: "1 byte", note: "" },
        Name { value: 1, label: "2 bytes", note: "" },
        Name { value: 2, label: "3 bytes", note: "" },
        Name { value: 3, label: "4 bytes", note: "" },
    ])
    .note(
        "How long the value is. Means nothing where no value is carried, such as in a read request. A KEB \
         F5 always reads 4 bytes; where it confirms a write, these bits can be 0 whatever was written.",
    );

const HANDSHAKE: Bits = Bits::part(6, 1, "handshake", "handshake")
    .names(&[
        Name { value: 0, label: "handshake 0", note: "" },
        Name { value: 1, label: "handshake 1", note: "" },
    ])
    .note("The master changes it for each new job; the slave shows the same when the job is done.");

const ERROR: Bits = Bits::flag(7, "error", "error").note("The last four bytes say which.");

static SUBINDEX: Spec = SUBINDEX_SPEC;

static SUBINDEX_SETS: Spec =
    SUBINDEX_SPEC.names(&[Name { value: 0, label: "the set that Fr.09 chooses", note: "" }]).bits(&[
        Bits::flag(0, "set_0", "set 0"),
        Bits::flag(1, "set_1", "set 1"),
        Bits::flag(2, "set_2", "set 2"),
        Bits::flag(3, "set_3", "set 3"),
        Bits::flag(4, "set_4", "set 4"),
        Bits::flag(5, "set_5", "set 5"),
        Bits::flag(6, "set_6", "set 6"),
        Bits::flag(7, "set_7", "set 7"),
    ]);

static SUBINDEX_PART: Spec = SUBINDEX_SPEC.bits(&[Bits::part(0, 8, "part", "part").names(&[Name {
    value: 0,
    label: "the whole parameter",
    note: "Without sets and parts.",
}])]);

const SUBINDEX_SPEC: Spec = Spec::new("subindex", "Subindex")
    .role(Role::Address)
    .format(Format::Hex)
    .note(
        "For an inverter parameter (index 2000h to 5EFFh): in which sets, one bit for each; reading from \
         several works only where they hold the same. 0 means the set that Fr.09 chooses. For other \
         indices it is no set but the number of a part.",
    )
    .source("KEB COMBIVERT F5 PROFIBUS-DP operator, 9");

static INDEX: Spec = INDEX_SPEC;
static INDEX_LOW_FIRST: Spec = INDEX_SPEC.order(Order::Little);

const INDEX_SPEC: Spec = Spec::new("index", "Index")
    .role(Role::Address)
    .format(Format::HexAddress)
    .note("Which parameter: 2000h and more for the inverter's, 5F00h and more for the operator's.")
    .source(SOURCE);

static VALUE: Spec = VALUE_SPEC;
static VALUE_LOW_FIRST: Spec = VALUE_SPEC.order(Order::Little);

const VALUE_SPEC: Spec = Spec::new("value", "Value")
    .format(Format::Register)
    .note("The parameter's value, high byte first where ValueSwapping does not say otherwise.")
    .source(SOURCE);

static WRITTEN: Spec = Spec::new("written", "Written data")
    .note(
        "What the slave wrote, from the first byte on. How many of the bytes count only the request tells: \
         a KEB F5 can leave the length bits 0 here.",
    )
    .source(SOURCE);

static UNUSED: Spec = Spec::new("unused", "Not used")
    .role(Role::Unknown)
    .note("These bytes mean nothing here. They often still hold what was there before.")
    .source(SOURCE);

static CLASS: Spec =
    Spec::new("error_class", "Error class").short("Class").role(Role::Status).note(ERROR_NOTE);
static CODE: Spec = Spec::new("error_code", "Error code").short("Code").role(Role::Status).note(ERROR_NOTE);
static ADDITIONAL: Spec = ADDITIONAL_CODE;

const ADDITIONAL_CODE: Spec = Spec::new("additional_code", "Additional code")
    .short("Additional")
    .role(Role::Status)
    .format(Format::Hex)
    .note(ERROR_NOTE)
    .source("KEB COMBIVERT F5 PROFIBUS-DP operator, 12.4");

const ERROR_NOTE: &str = "Class, code and additional code together say what is wrong.";

const SOURCE: &str = "KEB COMBIVERT F5 PROFIBUS-DP operator, 7.4";
