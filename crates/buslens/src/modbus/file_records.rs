//! The shapes that the functions over file records share: where records stand, and parts of a telegram
//! that follow each other up to its end.

use super::registers::BYTE_COUNT;
use crate::field::{Format, Message, Role, Severity, Spec};
use crate::message;
use crate::walk::{Walk, Walker};

/// Where records stand: reference type (1 byte, always 6), file number (2), record number (2) and
/// record length (2), which counts records of 16 bits.
pub struct Place {
    pub reference_type: u8,
    pub file: u16,
    pub record: u16,
    pub length: u16,
}

impl Default for Place {
    fn default() -> Self {
        Self { reference_type: 6, file: 1, record: 0, length: 1 }
    }
}

impl Place {
    /// `length` is the spec of the record length: how many fit depends on the function.
    pub fn walk(&mut self, w: &mut dyn Walker, length: &'static Spec) -> Walk {
        w.u8(&REFERENCE_TYPE, &mut self.reference_type)?;
        w.u16(&FILE, &mut self.file)?;
        w.u16(&RECORD, &mut self.record)?;
        w.u16(length, &mut self.length)?;
        if u32::from(self.record) + u32::from(self.length) > RECORDS {
            w.remark(
                length,
                Severity::Error,
                "address-overflow",
                message!(
                    "{records} from {record} go past the last one of a file, 9999",
                    records = records(self.length.into()),
                    record = self.record
                ),
            );
        }
        Ok(())
    }

    /// "2 records from 9 of file 3".
    pub fn meaning(&self) -> Message {
        message!(
            "{records} from {record} of file {file}",
            records = records(self.length.into()),
            record = self.record,
            file = self.file
        )
    }
}

/// "3 records".
pub fn records(count: usize) -> Message {
    match count {
        1 => message!("1 record"),
        _ => message!("{n} records", n = count),
    }
}

/// "3 records", "3 records in 2 parts".
pub fn records_in_parts(count: usize, parts: usize) -> Message {
    match parts {
        1 => records(count),
        _ => message!("{records} in {parts} parts", records = records(count), parts = parts),
    }
}

/// How a part of a telegram is walked.
pub type Each<T> = fn(&mut T, &mut dyn Walker) -> Walk;

/// A byte count (1 byte) and the parts that it counts, each as long as it says itself: they take all
/// that is left of the telegram. Returns the number of their bytes, where it is known.
pub fn walk_parts<T: Default>(
    w: &mut dyn Walker,
    list: &'static Spec,
    part: &'static Spec,
    parts: &mut Vec<T>,
    each: Each<T>,
) -> Walk<Option<u64>> {
    let mut walk = |w: &mut dyn Walker| {
        w.list(list, parts, None, Some(1), |w, one| w.within(part, &mut |w| each(one, w)))
    };
    let length = w.ahead(1, &mut walk);
    w.derived(&PARTS_BYTE_COUNT, 1, length)?;
    walk(w)?;
    Ok(length)
}

/// Records of a file.
const RECORDS: u32 = 10_000;

pub static REFERENCE_TYPE: Spec = Spec::new("reference_type", "Reference type")
    .short("Type")
    .limits(6, 6)
    .note("What kind of memory is meant: always 6.")
    .source(SOURCE);

static FILE: Spec = Spec::new("file", "File number")
    .short("File")
    .role(Role::Address)
    .limits(1, 65535)
    .note("Which file. Many devices have no more than ten.")
    .source(SOURCE);

static RECORD: Spec = Spec::new("record", "Record number")
    .short("Record")
    .role(Role::Address)
    .limits(0, 9999)
    .note("The first record in the file, counted from 0.")
    .source(SOURCE);

pub const RECORD_LENGTH: Spec =
    Spec::new("record_length", "Record length").short("Length").role(Role::Count).source(SOURCE);

static PARTS_BYTE_COUNT: Spec =
    BYTE_COUNT.note("How many bytes follow, in all parts together.").source(SOURCE);

/// The records of a part.
pub static RECORD_DATA: Spec = Spec::new("records", "Records").source(SOURCE);

pub static RECORD_VALUE: Spec = Spec::new("value", "Record")
    .format(Format::Register)
    .note("A record's 16 bits, high byte first.")
    .source(SOURCE);

const SOURCE: &str = "Modbus application protocol V1.1b3, 6.14 and 6.15";

#[cfg(test)]
mod tests {
    use crate::field::{Direction, problems};
    use crate::modbus::{Pdu, STANDARD};
    use crate::walk::{Deviations, form, read, write};

    const TWO_PARTS: [u8; 20] = [21, 18, 6, 0, 4, 0, 7, 0, 1, 6, 0xAF, 6, 0, 5, 0x27, 0x0F, 0, 1, 4, 0xBE];

    #[test]
    fn several_parts_are_read_edited_and_written() {
        let mut pdu = Pdu::expect(21, Direction::Request, &STANDARD);
        let reading = read(&mut pdu, &TWO_PARTS);
        assert!(problems(&reading.fields).is_empty());
        let labels: Vec<String> =
            reading.fields[2].children.iter().map(|part| part.label().to_string()).collect();
        assert_eq!(labels, ["Sub-request 1", "Sub-request 2"]);
        assert!(reading.deviations(&mut pdu).is_empty());
        let shown = form::form(&mut pdu, &Deviations::default());
        let mut filled = Pdu::expect(21, Direction::Request, &STANDARD);
        let deviations = form::fill(&mut filled, &shown).unwrap();
        assert_eq!(write(&mut filled, &deviations), TWO_PARTS);
    }

    #[test]
    fn every_cut_is_told_and_written_again() {
        for length in 1..TWO_PARTS.len() {
            let mut pdu = Pdu::expect(21, Direction::Request, &STANDARD);
            let reading = read(&mut pdu, &TWO_PARTS[..length]);
            let codes: Vec<_> = problems(&reading.fields).iter().map(|problem| problem.code).collect();
            // Behind a whole part, the byte count alone says that there was more.
            let expected = if length == 11 { "count-mismatch" } else { "truncated" };
            assert!(codes.contains(&expected), "{length}: {codes:?}");
            let deviations = reading.deviations(&mut pdu);
            assert_eq!(write(&mut pdu, &deviations), TWO_PARTS[..length], "{length}");
        }
    }
}
