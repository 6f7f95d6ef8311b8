//! Function 21 (15h): write file record. The response repeats the request, so that the two cannot be
//! told apart by their bytes.

use super::file_records::{Place, RECORD_DATA, RECORD_LENGTH, RECORD_VALUE, records_in_parts, walk_parts};
use super::{Body, Kind, Length, Server};
use crate::field::{Direction, Message, Spec};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

pub static REQUEST: Kind = Kind {
    function: 21,
    direction: Direction::Request,
    spec: Spec::new("write_file_record_request", "Write file record")
        .note("Writes records of one file or of several.")
        .source(SOURCE),
    length: Length::Counted { at: 1, unit: 1 },
    serial_only: false,
    new: || WriteFileRecord::of(Direction::Request),
};

pub static RESPONSE: Kind = Kind {
    function: 21,
    direction: Direction::Response,
    spec: Spec::new("write_file_record_response", "Write file record")
        .note("Repeats the request once the records are written.")
        .source(SOURCE),
    length: Length::Counted { at: 1, unit: 1 },
    serial_only: false,
    new: || WriteFileRecord::of(Direction::Response),
};

/// Byte count (1 byte, 9 to 251), then parts: where (7 bytes), records (2 each).
pub struct WriteFileRecord {
    pub direction: Direction,
    pub parts: Vec<Part>,
}

impl WriteFileRecord {
    pub fn of(direction: Direction) -> Box<dyn Body> {
        Box::new(Self { direction, parts: vec![Part::default()] })
    }
}

/// Records that follow each other.
pub struct Part {
    pub place: Place,
    pub records: Vec<u16>,
}

impl Default for Part {
    fn default() -> Self {
        Self { place: Place::default(), records: vec![0] }
    }
}

impl Part {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        self.place.walk(w, &LENGTH)?;
        let (count, first) = (usize::from(self.place.length), Some(self.place.record.into()));
        w.list(&RECORD_DATA, &mut self.records, count, first, |w, record| w.u16(&RECORD_VALUE, record))
    }
}

impl Telegram for WriteFileRecord {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        walk_parts(w, &PARTS, &PART, &mut self.parts, Part::walk)?;
        Ok(())
    }
}

impl Body for WriteFileRecord {
    fn meaning(&self, who: Server) -> Message {
        let who = who.name();
        let records = match self.parts.as_slice() {
            [part] => part.place.meaning(),
            parts => records_in_parts(parts.iter().map(|part| part.records.len()).sum(), parts.len()),
        };
        match self.direction {
            Direction::Request => message!("write {records} of {who}", records = records, who = who),
            Direction::Response => {
                message!("{who} confirms: {records} written", who = who, records = records)
            }
        }
    }
}

static PARTS: Spec = Spec::new("parts", "Sub-requests").source(SOURCE);

static PART: Spec = Spec::new("part", "Sub-request").source(SOURCE);

static LENGTH: Spec =
    RECORD_LENGTH.limits(1, 122).note("How many records of 16 bits follow. More than 122 do not fit.");

const SOURCE: &str = "Modbus application protocol V1.1b3, 6.15";
