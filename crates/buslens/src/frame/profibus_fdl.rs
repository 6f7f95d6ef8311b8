//! The PROFIBUS frame (FDL): start delimiter, addresses, frame control, data, frame check.
//!
//! | start | layout |
//! | --- | --- |
//! | SD1, 10h | destination, source, control, check, 16h: no data |
//! | SD2, 68h | length, length, 68h, destination, source, control, data, check, 16h |
//! | SD3, A2h | destination, source, control, 8 bytes of data, check, 16h |
//! | SD4, DCh | destination, source: the token |
//! | SC, E5h | nothing else: short acknowledgement |
//!
//! All fields are one byte but the data. The length counts destination to data, 4 to 249. Bit 7 of
//! an address says that the data begins with a service access point: that of the destination
//! (DSAP), then that of the source (SSAP). The check is the sum of destination to data.
//!
//! Source: EN 50170, volume 2, part 4 (FDL).

use super::{ANY_EXCHANGE, Cargo, Content, Fit, Frame, Protocol, Settings, Speaker, Verdict};
use crate::field::{
    Bits, Direction, Format, Message, Name, Role, Severity, Span, Spec, Value, hex_value, leaves,
};
use crate::message;
use crate::profibus::{self, Body, Kind};
use crate::walk::{self, Telegram, Walk, Walker};

pub static PROTOCOL: Protocol = Protocol {
    key: "profibus-fdl",
    label: "PROFIBUS",
    fit,
    verdict,
    first,
    unit: |bytes| stations(bytes).map(|(slave, _)| slave),
    speaker: Speaker::Frame(Fdl::direction),
    exchange,
    waiting: 1,
    expect: |bytes, direction, settings| Box::new(Fdl::expect(bytes, direction, &settings.profibus)),
    characters: None,
    carry: |station, cargo| match cargo {
        Cargo::Modbus(_) => None,
        Cargo::Profibus(kind, body) => Some(Box::new(Fdl::to(station, kind, body))),
    },
};

/// The start delimiters.
pub const SD1: u8 = 0x10;
pub const SD2: u8 = 0x68;
pub const SD3: u8 = 0xA2;
pub const SD4: u8 = 0xDC;
pub const SC: u8 = 0xE5;

/// The last byte of SD1 to SD3.
pub const END: u8 = 0x16;

/// The station that everybody on the line listens to.
pub const BROADCAST: u8 = 127;

/// The access point of a master for the services of PROFIBUS-DP.
pub const MASTER_SAP: u8 = 62;

/// A PROFIBUS frame.
pub struct Fdl {
    /// Which one to expect: that of the frame control byte, see [`direction`](Self::direction).
    pub direction: Direction,
    pub settings: profibus::Settings,
    pub start: u8,
    /// The addresses as on the wire, with the bit for an access point.
    pub destination: u8,
    pub source: u8,
    pub control: u8,
    /// Counts where bit 7 of the destination is set.
    pub destination_sap: u8,
    /// Counts where bit 7 of the source is set.
    pub source_sap: u8,
    pub kind: &'static Kind,
    pub body: Box<dyn Body>,
    /// What follows an unknown start delimiter.
    pub rest: Vec<u8>,
}

impl Fdl {
    /// A telegram of `kind` between the master 2 and the slave 1 (SD2), with nothing filled in.
    pub fn new(kind: &'static Kind, settings: &profibus::Settings) -> Self {
        let extension = if kind.sap.is_some() { 0x80 } else { 0 };
        let sap = kind.sap.unwrap_or_default();
        let (destination, source, control, destination_sap, source_sap) = match kind.direction {
            Direction::Request => (1, 2, 0x5D, sap, MASTER_SAP),
            Direction::Response => (2, 1, 0x08, MASTER_SAP, sap),
        };
        Self {
            direction: kind.direction,
            settings: settings.clone(),
            start: SD2,
            destination: destination | extension,
            source: source | extension,
            control,
            destination_sap,
            source_sap,
            kind,
            body: (kind.new)(settings),
            rest: Vec::new(),
        }
    }

    /// A request of `kind` for a slave, or its response, with `body` filled in.
    pub fn to(station: u8, kind: &'static Kind, body: Box<dyn Body>) -> Self {
        let mut frame = Self { body, ..Self::new(kind, &profibus::Settings::default()) };
        let slave = match kind.direction {
            Direction::Request => &mut frame.destination,
            Direction::Response => &mut frame.source,
        };
        *slave = *slave & 0x80 | station & 0x7F;
        frame
    }

    /// An empty frame to read `bytes` into.
    pub fn expect(bytes: &[u8], direction: Direction, settings: &profibus::Settings) -> Self {
        let start = bytes.first().copied().unwrap_or(SD2);
        Self { start, ..Self::new(Kind::of(None, direction), settings) }
    }

    /// Who speaks by the frame control byte: a master asks, a slave or another master answers. The
    /// token is neither.
    pub fn direction(bytes: &[u8]) -> Option<Direction> {
        let control = match *bytes.first()? {
            SD1 | SD3 => *bytes.get(3)?,
            SD2 => *bytes.get(6)?,
            SC => return Some(Direction::Response),
            _ => return None,
        };
        Some(if REQUEST.of(control.into()) == 1 { Direction::Request } else { Direction::Response })
    }

    /// Whether a frame control byte has a function of its direction.
    pub fn is_control(control: u8) -> bool {
        let functions = if REQUEST.of(control.into()) == 1 { &FUNCTION } else { &ANSWER };
        control & 0x80 == 0 && functions.name(functions.of(control.into())).is_some()
    }

    /// Whether data can follow a frame control byte. What is sent without acknowledgement is not counted.
    pub fn carries_data(control: u8) -> bool {
        match control & !COUNT {
            // Requests to send (SDA, SDN), and to send and ask (SRD).
            0x44 | 0x46 => control & COUNT == 0,
            0x43 | 0x45 | 0x4C | 0x4D => true,
            // Responses with data (DL, DH, RDL, RDH), of whatever station.
            0x08 | 0x0A | 0x0C | 0x0D => true,
            _ => false,
        }
    }

    /// How long the frame is that begins with `bytes`, of which the end may be missing; `None` if
    /// no frame begins so, or if the length of an SD2 is not there yet.
    ///
    /// ```
    /// use buslens::frame::profibus_fdl::Fdl;
    ///
    /// assert_eq!(Fdl::length(&[0xE5, 0x10]), Some(1));
    /// assert_eq!(Fdl::length(&[0x68, 0x05, 0x05, 0x68]), Some(11));
    /// assert_eq!(Fdl::length(&[0x68, 0x05, 0x06, 0x68]), None);
    /// ```
    pub fn length(bytes: &[u8]) -> Option<usize> {
        match *bytes {
            [SD1, ..] => Some(HEADER + AROUND),
            [SD2, length, again, SD2, ..] if length == again && LENGTH.allows(length.into()) => {
                Some(AROUND + LENGTH_BYTES + usize::from(length))
            }
            [SD3, ..] => Some(HEADER + FIXED_DATA + AROUND),
            [SD4, ..] => Some(3),
            [SC, ..] => Some(1),
            _ => None,
        }
    }

    /// Whether `bytes` are a whole SD1, SD2 or SD3, and their check is right. The token and the
    /// short acknowledgement have none.
    ///
    /// ```
    /// use buslens::frame::profibus_fdl::Fdl;
    ///
    /// assert!(Fdl::check_matches(&[0x10, 0x02, 0x01, 0x49, 0x4C, 0x16]));
    /// ```
    pub fn check_matches(bytes: &[u8]) -> bool {
        let from = match bytes.first() {
            Some(&SD1 | &SD3) => 1,
            Some(&SD2) => 1 + LENGTH_BYTES,
            _ => return false,
        };
        Self::length(bytes) == Some(bytes.len())
            && bytes.split_last_chunk::<2>().is_some_and(|(covered, [check, end])| {
                let covered = covered.get(from..).unwrap_or_default();
                *end == END && walk::FCS.wire(covered) == u64::from(*check)
            })
    }

    /// The slave by the direction: the destination of a request, the source of a response.
    pub fn slave(&self) -> Option<u8> {
        let (address, _) = self.slave_side();
        matches!(self.start, SD1 | SD2 | SD3).then(|| ADDRESS.of(address.into()) as u8)
    }

    /// The slave's access point; `None` in data exchange, which uses none.
    pub fn sap(&self) -> Option<u8> {
        let (address, sap) = self.slave_side();
        extended(address).then_some(sap)
    }

    fn slave_side(&self) -> (u8, u8) {
        match self.direction {
            Direction::Request => (self.destination, self.destination_sap),
            Direction::Response => (self.source, self.source_sap),
        }
    }

    /// The telegram in one sentence.
    pub fn meaning(&self) -> Message {
        match self.start {
            SD2 | SD3 => self.body.meaning(station(self.slave_side().0)),
            SD1 => {
                let function = self
                    .function()
                    .map_or(message!("function {n}", n = FUNCTION.of(self.control.into())), |name| {
                        Message::term(name.label)
                    });
                let (from, to) = (station(self.source), station(self.destination));
                match self.direction {
                    Direction::Request => {
                        message!("{from} to {to}: {function}", from = from, to = to, function = function)
                    }
                    Direction::Response => {
                        message!("{from} answers {to}: {function}", from = from, to = to, function = function)
                    }
                }
            }
            SD4 => message!(
                "{from} hands the token to {to}",
                from = station(self.source),
                to = station(self.destination)
            ),
            SC => message!("short acknowledgement: the request was taken"),
            _ => message!("no PROFIBUS frame begins with {start}", start = hex_value(self.start.into(), 1)),
        }
    }

    /// What the function code is called.
    fn function(&self) -> Option<&'static Name> {
        let function = match self.direction {
            Direction::Request => &FUNCTION,
            Direction::Response => &ANSWER,
        };
        function.name(function.of(self.control.into()))
    }

    /// A frame with check and end, whose unit should have `announced` bytes where `there` are.
    fn framed(&mut self, w: &mut dyn Walker, announced: u64, there: Option<u64>) -> Walk {
        let from = w.mark();
        // A frame that ends too early lacks its end, not its data.
        let left = there.map_or(0, |there| there + TRAILER as u64);
        self.unit(w, left.saturating_sub(announced).min(TRAILER as u64) as usize)?;
        w.checksum(&CHECK, &walk::FCS, from)?;
        w.derived(&END_DELIMITER, 1, Some(END.into()))
    }

    /// Destination to data, which the length counts and the check covers.
    fn unit(&mut self, w: &mut dyn Walker, keep: usize) -> Walk {
        w.window(keep, &mut |w| {
            self.addresses(w)?;
            if self.start == SD1 {
                return Ok(());
            }
            self.access_points(w)?;
            let kind = Kind::of(self.sap(), self.direction);
            if !std::ptr::eq(kind, self.kind) {
                self.kind = kind;
                self.body = (kind.new)(&self.settings);
            }
            self.body.walk(w)
        })
    }

    fn addresses(&mut self, w: &mut dyn Walker) -> Walk {
        w.u8(&DESTINATION, &mut self.destination)?;
        w.u8(&SOURCE_ADDRESS, &mut self.source)?;
        if ADDRESS.of(self.source.into()) == u64::from(BROADCAST) {
            w.remark(
                &SOURCE_ADDRESS,
                Severity::Error,
                "broadcast-source",
                message!("no station has the address 127: it means all stations"),
            );
        }
        if self.start == SD1 && (extended(self.destination) || extended(self.source)) {
            w.remark(
                &SOURCE_ADDRESS,
                Severity::Error,
                "no-access-point",
                message!("an address says that an access point follows, but this frame has no data"),
            );
        }
        let (control, other) = match self.direction {
            Direction::Request => (&REQUEST_CONTROL, 0),
            Direction::Response => (&RESPONSE_CONTROL, 1),
        };
        w.u8(control, &mut self.control)?;
        if REQUEST.of(self.control.into()) == other {
            w.remark(
                control,
                Severity::Warning,
                "other-direction",
                match self.direction {
                    Direction::Request => message!("bit 6 says that this is a response, not a request"),
                    Direction::Response => message!("bit 6 says that this is a request, not a response"),
                },
            );
        }
        Ok(())
    }

    /// The access points that the addresses announce. The slave's one chooses the service.
    fn access_points(&mut self, w: &mut dyn Walker) -> Walk {
        let direction = self.direction;
        // One byte wide, so it fits.
        let services = |sap: u64| &Kind::of(Some(sap as u8), direction).spec;
        let points = [
            (self.destination, &DESTINATION_SAP, &mut self.destination_sap, Direction::Request),
            (self.source, &SOURCE_SAP, &mut self.source_sap, Direction::Response),
        ];
        for (address, spec, sap, chooses) in points {
            match extended(address) {
                true if direction == chooses => w.choose(spec, 1, sap, &services)?,
                true => w.u8(spec, sap)?,
                false => {}
            }
        }
        Ok(())
    }

    /// The length, twice, and what it counts.
    fn variable(&mut self, w: &mut dyn Walker) -> Walk {
        let there = w.ahead(LENGTH_BYTES + TRAILER, &mut |w| self.unit(w, TRAILER));
        let told = w.announce(&LENGTH, 1, there.unwrap_or(0) as usize, 1)? as u64;
        let again = w.announce(&LENGTH_AGAIN, 1, told as usize, 1)? as u64;
        if told != again {
            w.remark(
                &LENGTH_AGAIN,
                Severity::Error,
                "count-mismatch",
                message!("the length is {told} first and {again} here", told = told, again = again),
            );
        }
        // One of the two may be damaged: the smaller one, or what is there, is less to be missed.
        let announced = told.min(again);
        match there {
            Some(there) if announced > there => w.remark(
                &LENGTH,
                Severity::Error,
                "truncated",
                message!(
                    "{announced} bytes are announced, {there} are there",
                    announced = announced,
                    there = there
                ),
            ),
            Some(there) if told != there => w.remark(
                &LENGTH,
                Severity::Error,
                "count-mismatch",
                message!("{told} bytes are announced, {there} are there", told = told, there = there),
            ),
            _ => {}
        }
        w.derived(&START_AGAIN, 1, Some(SD2.into()))?;
        self.framed(w, announced, there)
    }

    fn fixed(&mut self, w: &mut dyn Walker) -> Walk {
        let announced = if self.start == SD1 { HEADER } else { HEADER + FIXED_DATA } as u64;
        let there = w.ahead(TRAILER, &mut |_| Ok(()));
        if let Some(there) = there
            && there != announced
        {
            let code = if there < announced { "truncated" } else { "frame-too-long" };
            w.remark(
                &START,
                Severity::Error,
                code,
                message!(
                    "such a frame has {announced} bytes, this one has {there}",
                    announced = announced + AROUND as u64,
                    there = there + AROUND as u64
                ),
            );
        }
        self.framed(w, announced, there)
    }
}

impl Frame for Fdl {
    fn content(&self) -> Content<'_> {
        match self.start {
            SD2 | SD3 => Content::Profibus { slave: self.slave(), kind: self.kind, body: self.body.as_ref() },
            start => Content::Nothing(format_of(start)),
        }
    }

    fn meaning(&self) -> Message {
        Self::meaning(self)
    }

    fn answer(&mut self, request: &Content<'_>) {
        if let Content::Profibus { body, .. } = request
            && let Some(channel) = body.channel()
        {
            self.body.answer(channel);
        }
    }

    fn back(&self, response: Cargo) -> Option<Box<dyn Frame>> {
        let Cargo::Profibus(kind, body) = response else { return None };
        Some(Box::new(Self {
            destination: self.source,
            source: self.destination,
            destination_sap: self.source_sap,
            source_sap: self.destination_sap,
            body,
            ..Self::new(kind, &self.settings)
        }))
    }
}

fn fit(bytes: &[u8], _: &Settings) -> Fit {
    /// Start and end delimiters; the check; a length repeated; two bytes with nothing to check them.
    const DELIMITED: u32 = 16;
    const CHECK: u32 = 8;
    const REPEATED: u32 = 8;
    const SHORT: u32 = 8;
    let length = Fdl::length(bytes).filter(|length| *length <= bytes.len()).unwrap_or_default();
    let frame = Span::new(0, length).of(bytes);
    match (frame, bytes) {
        ([SD4 | SC, ..], _) if length == bytes.len() || Fdl::length(&bytes[length..]).is_some() => Fit {
            bits: SHORT,
            reason: message!("its first byte and its length are those of a PROFIBUS frame"),
        },
        ([start @ (SD1 | SD2 | SD3), .., END], _) => {
            let checked = if Fdl::check_matches(frame) { CHECK } else { 0 };
            let repeated = if *start == SD2 { REPEATED } else { 0 };
            Fit {
                bits: DELIMITED + checked + repeated,
                reason: message!("it begins and ends as a PROFIBUS frame of this length does"),
            }
        }
        (_, [SD2, length, again, SD2, ..]) if length == again => Fit {
            bits: DELIMITED,
            reason: message!("it begins as a PROFIBUS frame does, though its end is not where it should be"),
        },
        (_, [SD1 | SD2 | SD3, .., END]) => Fit {
            bits: SHORT,
            reason: message!("it begins and ends as a PROFIBUS frame does, though its length is wrong"),
        },
        _ => Fit { bits: 0, reason: message!("it is no PROFIBUS frame") },
    }
}

/// The first frame's length, where another frame begins behind it; else its length may be wrong.
fn first(bytes: &[u8]) -> usize {
    match Fdl::length(bytes).filter(|length| *length < bytes.len()) {
        Some(length) if Fdl::length(&bytes[length..]).is_some() => length,
        _ => bytes.len(),
    }
}

/// What the tree says of the check, so that the two never differ.
fn verdict(bytes: &[u8]) -> Verdict {
    let direction = Fdl::direction(bytes).unwrap_or(Direction::Request);
    let mut frame = Fdl::expect(bytes, direction, &profibus::Settings::default());
    let fields = walk::read(&mut frame, bytes).fields;
    let check = leaves(&fields).into_iter().find_map(|leaf| match leaf.value {
        Value::Check(check) => Some(check.ok()),
        _ => None,
    });
    match (check, frame.start) {
        (Some(true), _) => Verdict::Right,
        (Some(false), _) => Verdict::Wrong,
        (None, SD4 | SC) => Verdict::NoCheck,
        (None, _) => Verdict::Unchecked,
    }
}

/// The two stations and the slave's access point. Nobody answers a broadcast, a token, or data sent
/// without asking for an acknowledgement (SDN).
fn exchange(bytes: &[u8]) -> Option<u64> {
    if bytes == [SC] {
        return Some(ANY_EXCHANGE);
    }
    let (slave, master) = stations(bytes)?;
    let request = Fdl::direction(bytes)? == Direction::Request;
    let at = head(bytes)?;
    let function = FUNCTION.of(bytes.get(at + 2).copied()?.into());
    if slave == BROADCAST || (request && matches!(function, SDN_LOW | SDN_HIGH)) {
        return None;
    }
    let (to, from) = (*bytes.get(at)?, *bytes.get(at + 1)?);
    // The access points stand behind the control byte, that of the destination first.
    let place = match request {
        true => extended(to).then_some(at + 3),
        false => extended(from).then_some(at + 3 + usize::from(extended(to))),
    };
    let sap = place.and_then(|place| bytes.get(place)).map_or(NO_SAP, |sap| u64::from(*sap));
    Some(u64::from(slave) << 16 | u64::from(master) << 8 | sap)
}

/// Where the addresses begin.
fn head(bytes: &[u8]) -> Option<usize> {
    match *bytes.first()? {
        SD1 | SD3 => Some(1),
        SD2 => Some(1 + LENGTH_BYTES),
        _ => None,
    }
}

/// The slave and the master, without the bit for an access point.
fn stations(bytes: &[u8]) -> Option<(u8, u8)> {
    let at = head(bytes)?;
    let address = |at: usize| bytes.get(at).map(|byte| byte & 0x7F);
    let (to, from) = (address(at)?, address(at + 1)?);
    Some(if Fdl::direction(bytes)? == Direction::Request { (to, from) } else { (from, to) })
}

/// Of a frame control byte, whether requests are counted, or of what type a station is.
const COUNT: u8 = 0x30;

/// Function codes of data sent without acknowledgement.
const SDN_LOW: u64 = 4;
const SDN_HIGH: u64 = 6;

/// No access point, in an exchange.
const NO_SAP: u64 = 0xFF;

impl Telegram for Fdl {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        // One byte wide, so it fits.
        w.choose(&START, 1, &mut self.start, &|start| format_of(start as u8))?;
        match self.start {
            SD1 | SD3 => self.fixed(w),
            SD2 => self.variable(w),
            SD4 => {
                w.u8(&DESTINATION, &mut self.destination)?;
                w.u8(&SOURCE_ADDRESS, &mut self.source)
            }
            SC => Ok(()),
            _ => {
                w.remark(
                    &START,
                    Severity::Error,
                    "unknown-start",
                    message!(
                        "no PROFIBUS frame begins with {start}",
                        start = hex_value(self.start.into(), 1)
                    ),
                );
                w.bytes(&REST, &mut self.rest, None)
            }
        }
    }
}

/// Whether an address says that an access point follows.
fn extended(address: u8) -> bool {
    EXTENSION.of(address.into()) == 1
}

/// "station 5".
fn station(address: u8) -> Message {
    match ADDRESS.of(address.into()) as u8 {
        BROADCAST => message!("all stations"),
        address => message!("station {n}", n = address),
    }
}

/// What a start delimiter begins.
fn format_of(start: u8) -> &'static Spec {
    match start {
        SD1 => &FORMATS[0],
        SD2 => &FORMATS[1],
        SD3 => &FORMATS[2],
        SD4 => &FORMATS[3],
        SC => &FORMATS[4],
        _ => &NO_FORMAT,
    }
}

/// Destination, source, control.
const HEADER: usize = 3;
/// Data of an SD3.
const FIXED_DATA: usize = 8;
/// Start delimiter, check, end delimiter.
const AROUND: usize = 3;
/// Length, length, start delimiter.
const LENGTH_BYTES: usize = 3;
/// Check, end delimiter.
const TRAILER: usize = 2;

static START: Spec = Spec::new("start", "Start delimiter")
    .short("Start")
    .role(Role::Function)
    .format(Format::Hex)
    .note("What kind of frame this is.")
    .source(SOURCE)
    .names(&[
        Name { value: SD1 as u64, label: "SD1: no data", note: "" },
        Name { value: SD2 as u64, label: "SD2: data of any length", note: "" },
        Name { value: SD3 as u64, label: "SD3: 8 bytes of data", note: "" },
        Name { value: SD4 as u64, label: "SD4: token", note: "" },
        Name { value: SC as u64, label: "SC: short acknowledgement", note: "" },
    ]);

static FORMATS: [Spec; 5] = [
    Spec::new("sd1", "SD1: no data").source(SOURCE),
    Spec::new("sd2", "SD2: data of any length").source(SOURCE),
    Spec::new("sd3", "SD3: 8 bytes of data").source(SOURCE),
    Spec::new("sd4", "SD4: token").note("The right to speak goes to the next master.").source(SOURCE),
    Spec::new("sc", "SC: short acknowledgement")
        .note("A request was taken; there is no data.")
        .source(SOURCE),
];

static NO_FORMAT: Spec = Spec::new("unknown_start", "no PROFIBUS frame").source(SOURCE);

static LENGTH: Spec = LENGTH_SPEC.limits(4, 249);

static LENGTH_AGAIN: Spec = Spec { key: "length_again", ..LENGTH_SPEC }
    .label("Length again")
    .note("The same length once more, so that a damaged one is noticed.");

const LENGTH_SPEC: Spec = Spec::new("length", "Length")
    .role(Role::Count)
    .note("How many bytes there are from the destination to the last byte of data.")
    .source(SOURCE);

static START_AGAIN: Spec = Spec::new("start_again", "Start delimiter again")
    .short("Start")
    .role(Role::Check)
    .format(Format::Hex)
    .note("68h once more.")
    .source(SOURCE);

static DESTINATION: Spec = Spec::new("destination", "Destination")
    .role(Role::Unit)
    .note("Address of the receiver, 0 to 126; 127 addresses all stations.")
    .source(SOURCE)
    .bits(ADDRESS_BITS);

static SOURCE_ADDRESS: Spec = Spec::new("source", "Source")
    .role(Role::Unit)
    .note("Address of the sender, 0 to 126.")
    .source(SOURCE)
    .bits(ADDRESS_BITS);

static ADDRESS_BITS: &[Bits] = &[ADDRESS, EXTENSION];

const ADDRESS: Bits = Bits::part(0, 7, "station", "station").names(&[
    Name { value: 126, label: "station 126", note: "A slave that has no address of its own yet." },
    Name { value: BROADCAST as u64, label: "all stations", note: "Every station listens, none answers." },
]);

const EXTENSION: Bits =
    Bits::flag(7, "extension", "with access point").note("A service access point follows before the data.");

static REQUEST_CONTROL: Spec = CONTROL.bits(&[
    FUNCTION,
    Bits::flag(4, "count_valid", "count bit valid").note("FCV: the count bit means something."),
    Bits::flag(5, "count", "count bit")
        .note("FCB: changes with each new request; a repeat after a lost answer keeps it."),
    REQUEST,
    Bits::reserved(7, 1),
]);

static RESPONSE_CONTROL: Spec = CONTROL.bits(&[
    ANSWER,
    Bits::part(4, 2, "station_type", "station type").names(&[
        Name { value: 0, label: "slave", note: "" },
        Name { value: 1, label: "master, not ready", note: "" },
        Name { value: 2, label: "master, ready for the token", note: "" },
        Name { value: 3, label: "master in the ring", note: "" },
    ]),
    REQUEST,
    Bits::reserved(7, 1),
]);

const CONTROL: Spec = Spec::new("frame_control", "Frame control")
    .short("Control")
    .role(Role::Function)
    .note("Whether this asks or answers, and in which way.")
    .source(SOURCE);

const REQUEST: Bits = Bits::part(6, 1, "request", "request")
    .names(&[Name { value: 0, label: "response", note: "" }, Name { value: 1, label: "request", note: "" }]);

const FUNCTION: Bits = Bits::part(0, 4, "function", "function").names(&[
    Name { value: 3, label: "send, acknowledged (SDA low)", note: "" },
    Name { value: 4, label: "send, not acknowledged (SDN low)", note: "" },
    Name { value: 5, label: "send, acknowledged (SDA high)", note: "" },
    Name { value: 6, label: "send, not acknowledged (SDN high)", note: "" },
    Name { value: 9, label: "ask for the FDL status", note: "Is there a station, and of which type?" },
    Name { value: 12, label: "send and ask for data (SRD low)", note: "" },
    Name { value: 13, label: "send and ask for data (SRD high)", note: "" },
]);

const ANSWER: Bits = Bits::part(0, 4, "function", "function").names(&[
    Name { value: 0, label: "OK", note: "" },
    Name { value: 1, label: "user error (UE)", note: "The user of the access point does not take it." },
    Name { value: 2, label: "no resource (RR)", note: "The access point has no room for the data." },
    Name { value: 3, label: "no service (RS)", note: "The access point is not active." },
    Name { value: 8, label: "data (DL)", note: "" },
    Name { value: 9, label: "no data (NR)", note: "Taken, but there is nothing to answer." },
    Name { value: 10, label: "urgent data (DH)", note: "A slave in data exchange has new diagnosis." },
    Name { value: 12, label: "data, but no resource (RDL)", note: "" },
    Name { value: 13, label: "urgent data, but no resource (RDH)", note: "" },
]);

static DESTINATION_SAP: Spec = ACCESS_POINT
    .label("Access point of the destination")
    .short("DSAP")
    .note("Which service is meant: the slave's access point in a request, the master's in a response.");

static SOURCE_SAP: Spec = Spec { key: "source_sap", ..ACCESS_POINT }
    .label("Access point of the source")
    .short("SSAP")
    .note("From which service it comes: the master's access point in a request, the slave's in a response.");

const ACCESS_POINT: Spec =
    Spec::new("destination_sap", "Access point").role(Role::Function).source(SOURCE).names(&[
        Name { value: 55, label: "55: Set_Slave_Add", note: "" },
        Name { value: 56, label: "56: RD_Inp", note: "" },
        Name { value: 57, label: "57: RD_Outp", note: "" },
        Name { value: 58, label: "58: Global_Control", note: "" },
        Name { value: 59, label: "59: Get_Cfg", note: "" },
        Name { value: 60, label: "60: Slave_Diag", note: "" },
        Name { value: 61, label: "61: Set_Prm", note: "" },
        Name { value: 62, label: "Chk_Cfg, or a master", note: "" },
    ]);

static CHECK: Spec = Spec::new("fcs", "FCS")
    .role(Role::Check)
    .note("The sum of all bytes from the destination to the data. A frame whose sum is wrong is ignored.")
    .source(SOURCE);

static END_DELIMITER: Spec = Spec::new("end", "End delimiter")
    .short("End")
    .role(Role::Check)
    .format(Format::Hex)
    .note("Always 16h.")
    .source(SOURCE);

static REST: Spec =
    Spec::new("rest", "Not understood").role(Role::Unknown).note("What follows an unknown start.");

const SOURCE: &str = "EN 50170, volume 2, part 4 (FDL)";
