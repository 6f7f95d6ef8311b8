//! Function 20 (14h): read file record.

use super::file_records::{
    Place, RECORD_DATA, RECORD_LENGTH, RECORD_VALUE, REFERENCE_TYPE, records_in_parts, walk_parts,
};
use super::{Body, Kind, Length, Server};
use crate::field::{Direction, Message, Role, Severity, Spec};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

pub static REQUEST: Kind = Kind {
    function: 20,
    direction: Direction::Request,
    spec: Spec::new("read_file_record_request", "Read file record")
        .note("Asks for records of one file or of several.")
        .source(SOURCE),
    length: Length::Counted { at: 1, unit: 7 },
    serial_only: false,
    new: || Box::new(Request { places: vec![Place::default()] }),
};

pub static RESPONSE: Kind = Kind {
    function: 20,
    direction: Direction::Response,
    spec: Spec::new("read_file_record_response", "Read file record")
        .note("The records asked for, part by part. Which ones they are only the request says.")
        .source(SOURCE),
    length: Length::Counted { at: 1, unit: 2 },
    serial_only: false,
    new: || Box::new(Response { parts: vec![Part::default()] }),
};

/// Byte count (1 byte), then places of seven bytes.
pub struct Request {
    pub places: Vec<Place>,
}

impl Telegram for Request {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        let count = w.announce(&BYTE_COUNT, 1, self.places.len(), 7)?;
        w.list(&PLACES, &mut self.places, count, Some(1), |w, place| {
            w.within(&PLACE, &mut |w| place.walk(w, &PLACE_LENGTH))
        })?;
        let answer: usize = self.places.iter().map(|place| 2 + 2 * usize::from(place.length)).sum();
        if answer > LONGEST {
            w.remark(
                &PLACES,
                Severity::Error,
                "response-too-long",
                message!(
                    "the response would have {bytes} to count, and it can have {longest}",
                    bytes = Message::bytes(answer),
                    longest = LONGEST
                ),
            );
        }
        Ok(())
    }
}

impl Body for Request {
    fn meaning(&self, who: Server) -> Message {
        let who = who.name();
        match self.places.as_slice() {
            [place] => message!("ask {who} for {records}", who = who, records = place.meaning()),
            places => {
                let count = places.iter().map(|place| usize::from(place.length)).sum();
                let records = records_in_parts(count, places.len());
                message!("ask {who} for {records}", who = who, records = records)
            }
        }
    }

    fn only_reads(&self) -> bool {
        true
    }
}

/// Byte count (1 byte), then parts: length (1), reference type (1), records (2 each). The length counts
/// what is behind it.
pub struct Response {
    pub parts: Vec<Part>,
}

/// The records of one place.
pub struct Part {
    pub length: u8,
    pub reference_type: u8,
    pub records: Vec<u16>,
}

impl Default for Part {
    fn default() -> Self {
        Self { length: 3, reference_type: 6, records: vec![0] }
    }
}

impl Part {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        w.u8(&LENGTH, &mut self.length)?;
        if self.length.is_multiple_of(2) {
            w.remark(
                &LENGTH,
                Severity::Error,
                "half-record",
                message!("{length} bytes are no whole records and a reference type", length = self.length),
            );
        }
        w.u8(&REFERENCE_TYPE, &mut self.reference_type)?;
        let count = usize::from(self.length.saturating_sub(1) / 2);
        w.list(&RECORD_DATA, &mut self.records, count, None, |w, record| w.u16(&RECORD_VALUE, record))
    }
}

impl Telegram for Response {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        let length = walk_parts(w, &PARTS, &PART, &mut self.parts, Part::walk)?;
        if let Some(length) = length.filter(|length| *length > LONGEST as u64) {
            w.remark(
                &PARTS,
                Severity::Error,
                "out-of-range",
                message!(
                    "{length} bytes of records; {longest} are allowed",
                    length = length,
                    longest = LONGEST
                ),
            );
        }
        Ok(())
    }
}

impl Body for Response {
    fn meaning(&self, who: Server) -> Message {
        let count = self.parts.iter().map(|part| part.records.len()).sum();
        let records = records_in_parts(count, self.parts.len());
        message!("{who} answers with {records}", who = who.name(), records = records)
    }
}

/// The largest byte count, F5h.
const LONGEST: usize = 245;

static BYTE_COUNT: Spec = Spec::new("byte_count", "Byte count")
    .short("Bytes")
    .role(Role::Count)
    .limits(7, LONGEST as u64)
    .note("How many bytes follow: seven for each place.")
    .source(SOURCE);

static PLACES: Spec = Spec::new("places", "Sub-requests").source(SOURCE);

static PLACE: Spec = Spec::new("place", "Sub-request").source(SOURCE);

static PLACE_LENGTH: Spec = RECORD_LENGTH
    .limits(1, 121)
    .note("How many records of 16 bits are to be read. All together must fit into a response of 245 bytes.");

static PARTS: Spec = Spec::new("parts", "Sub-responses").source(SOURCE);

static PART: Spec = Spec::new("part", "Sub-response").source(SOURCE);

/// The standard begins at 7, but the answer with a single record has a length of 3.
static LENGTH: Spec = Spec::new("length", "File response length")
    .short("Length")
    .role(Role::Count)
    .limits(3, 243)
    .note("How many bytes of this part follow: one for the reference type, two for each record.")
    .source(SOURCE);

const SOURCE: &str = "Modbus application protocol V1.1b3, 6.14";
