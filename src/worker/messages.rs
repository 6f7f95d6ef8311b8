//! What the page asks of whoever reads a log, and what it is told: plain data.

use std::collections::BTreeMap;
use std::ops::Range;

use serde::{Deserialize, Serialize};

use buslens::field::{Direction, Span};
use buslens::tool::digest::Digest;
use buslens::tool::link::{keep_settings, kept_settings};
use buslens::tool::log::{
    Excerpt, Filter, Held, Hidden, Input, Lanes, Marks, Numbers, Overview, Place, Reading, Redacted,
    Replaced, Row, Seen,
};
use buslens::tool::{Options, Profile, Proposal, Protocol};

/// How a file is to be read, where a person says so.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct How {
    /// Their keys.
    pub protocol: Option<String>,
    pub device: Option<String>,
    /// How the devices are set up, as links hold it.
    pub settings: String,
    /// The key of an [`Input`].
    pub input: Option<String>,
    /// The numbers are decimal, or hex.
    pub decimal: Option<bool>,
    pub marks: Option<Marked>,
}

/// A line of a log in which a person marked what is what.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Marked {
    pub line: String,
    pub parts: Vec<(Part, (usize, usize))>,
}

/// A part of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Part {
    Bytes,
    Time,
    Request,
    Response,
}

impl How {
    /// How the file is read with these options.
    pub fn of(options: &Options) -> Self {
        Self {
            protocol: options.protocol.map(|it| it.key.to_owned()),
            device: options.device.map(|it| it.key.to_owned()),
            settings: keep_settings(&options.settings),
            ..Self::default()
        }
    }

    pub fn options(&self) -> Options {
        Options {
            direction: None,
            protocol: self.protocol.as_deref().and_then(Protocol::of),
            device: self.device.as_deref().and_then(Profile::of),
            settings: kept_settings(&self.settings),
        }
    }

    pub fn reading(&self) -> Reading {
        let numbers = self.decimal.map(|decimal| if decimal { Numbers::Decimal } else { Numbers::Hex });
        let input = self.input.as_deref().and_then(Input::of).unwrap_or_default();
        Reading { input, numbers, marks: self.marks.as_ref().and_then(Marked::marks) }
    }
}

impl Marked {
    fn marks(&self) -> Option<Marks> {
        let span = |part: Part| {
            let (_, (from, to)) = self.parts.iter().find(|(other, _)| *other == part)?;
            self.line
                .get(*from..*to)
                .filter(|text| !text.is_empty())
                .map(|text| (Span::new(*from, *to), text))
        };
        let (bytes, _) = span(Part::Bytes)?;
        let directions = [(Part::Request, Direction::Request), (Part::Response, Direction::Response)];
        Some(Marks {
            time: span(Part::Time).map(|(time, _)| Place::of(&self.line, time)),
            direction: directions.into_iter().find_map(|(part, direction)| {
                let (place, word) = span(part)?;
                Some((Place::of(&self.line, place), word.to_owned(), direction))
            }),
            bytes: Place::of(&self.line, bytes),
        })
    }
}

/// What the page asks. The file of `Open` and `Read` comes beside it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Request {
    /// It may be read by so many workers at once.
    Open(How, usize),
    /// A slice is read for another worker.
    Read(Share),
    /// What is read so far is enough.
    Stop,
    /// The devices are others, or set up in another way.
    SetUp(How),
    List(Choice),
    /// The timeline of all of it, or of a stretch.
    Lanes(Option<(i64, i64)>),
    Rows {
        from: usize,
        count: usize,
    },
    Show(Which),
    Series {
        unit: Option<u8>,
        address: u16,
    },
    /// The registers that can be drawn.
    Held,
    /// The lines without bytes.
    Unread,
    /// A line to mark parts in.
    Sample,
    /// The log in short.
    Digest,
    /// The log without what is to be hidden.
    PassOn(Hidden),
    Export {
        kind: Export,
        notes: BTreeMap<usize, String>,
    },
}

/// What a worker reads for another one.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Share {
    pub how: How,
    /// So much of the file is its beginning.
    pub beginning: u64,
    pub slice: Range<u64>,
}

/// Which telegrams the list has.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Choice {
    pub filter: Filter,
    /// Only those that this finding is about.
    pub finding: Option<usize>,
}

/// Which telegram is to be shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Which {
    /// The one at a place of the list.
    At(usize),
    /// The one with this index in the log.
    Index(usize),
    /// The next one behind a place of the list that a person should look at, or the one before.
    Wrong { from: usize, forwards: bool },
}

/// What the list is written to a file as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Export {
    Text,
    Csv,
    JsonLines,
    JsonLinesWithFields,
    Hex,
    /// A capture for Wireshark.
    Capture,
    /// The lines of the log itself.
    Lines,
}

impl Export {
    /// All that become files.
    pub const FILES: [Self; 7] = [
        Self::Text,
        Self::Csv,
        Self::JsonLines,
        Self::JsonLinesWithFields,
        Self::Capture,
        Self::Hex,
        Self::Lines,
    ];

    pub const fn label(self) -> &'static str {
        match self {
            Self::Text => "Text: every telegram with its fields",
            Self::Csv => "CSV: a row for each telegram",
            Self::JsonLines => "JSON Lines",
            Self::JsonLinesWithFields => "JSON Lines with fields",
            Self::Hex => "Bytes as hex",
            Self::Capture => "Capture for Wireshark (pcapng)",
            Self::Lines => "The lines of the log",
        }
    }

    /// Name and type of the file.
    pub const fn file(self) -> (&'static str, &'static str) {
        match self {
            Self::Text | Self::Hex => ("telegrams.txt", "text/plain"),
            Self::Csv => ("telegrams.csv", "text/csv"),
            Self::JsonLines | Self::JsonLinesWithFields => ("telegrams.jsonl", "application/json"),
            Self::Capture => ("telegrams.pcapng", "application/vnd.tcpdump.pcap"),
            Self::Lines => ("lines.txt", "text/plain"),
        }
    }
}

/// What the page is told.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Answer {
    /// The worker can hear.
    Hello,
    Progress {
        done: f64,
        telegrams: usize,
    },
    /// What is read so far, of which nothing changes any more. It is told again when there is twice as much.
    Growing(Box<Overview>),
    /// The list has so many telegrams now: those that it had, and others behind them.
    Grown(usize),
    /// Why the file is not read.
    Refused(String),
    /// Why nobody reads it any more; it can be opened again. The worker itself cannot say that.
    Lost(String),
    /// The file is read.
    Ready(Box<Overview>),
    Findings(Vec<Found>),
    /// The devices that units look like, and what lines tell that hold no telegram.
    Beside {
        proposals: Vec<Proposed>,
        seen: Vec<Seen>,
    },
    /// How many telegrams the list has now.
    List(usize),
    Lanes(Lanes),
    Rows {
        from: usize,
        rows: Vec<Row>,
    },
    Shown(Box<Shown>),
    /// There is no such telegram.
    NothingThere,
    Series(Vec<Value>),
    Held(Vec<Held>),
    Unread {
        lines: Vec<(u32, String)>,
        more: usize,
    },
    Sample(String),
    Digest(Box<Digest>),
    /// The file comes beside it.
    PassedOn(Passed),
    /// A file comes beside it.
    Exported(Export),
    /// What was found in a slice since the last one comes beside it.
    Found,
}

impl Passed {
    /// What there is to say of it, without the file.
    pub fn of(redacted: Redacted) -> Self {
        let Redacted { is_capture, replaced, left, unread, .. } = redacted;
        Self { is_capture, replaced, left, unread }
    }
}

/// What there is to say of a log to pass on.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Passed {
    /// It is a capture, as what was read was one.
    pub is_capture: bool,
    pub replaced: Vec<Replaced>,
    /// Telegrams that stay as they are, since their bytes were not found in the text.
    pub left: usize,
    /// Bytes of no telegram, which stay as they are.
    pub unread: usize,
}

/// What is behind many errors.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Found {
    pub code: String,
    pub text: String,
    /// The indices of telegrams that show it.
    pub evidence: Vec<u32>,
}

/// A device that the telegrams of a unit look like.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Proposed {
    pub unit: Option<u8>,
    /// Its key.
    pub device: String,
    /// Why.
    pub text: String,
    /// How much speaks for it, in bits of chance.
    pub bits: i32,
}

impl Proposed {
    pub fn of(proposal: &Proposal) -> Self {
        Self {
            unit: proposal.unit,
            device: proposal.device.key.to_owned(),
            text: proposal.text.sentence() + ".",
            bits: proposal.bits,
        }
    }
}

/// A telegram that is shown.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Shown {
    /// Its place in the list, if it is in it.
    pub place: Option<usize>,
    pub row: Row,
    /// The number of its line; 0 where the log has no lines.
    pub line: u32,
    /// What its place in the conversation says.
    pub about: String,
    /// The index of its partner.
    pub partner: Option<usize>,
    /// Bytes that are no telegram.
    pub discarded: Option<Vec<u8>>,
    pub excerpt: Excerpt,
}

/// A value of a register.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Value {
    pub index: usize,
    pub time: Option<i64>,
    pub value: f64,
}
