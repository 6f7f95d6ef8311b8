//! The other layouts that functions 100 and 101 may have: the figures of the manual cannot be read
//! for sure, so a person can try what their device speaks.

use super::{LONG, LONG_VALUE, Layout, read_long_registers as read, write_long_registers as write};
use crate::field::Order;
use crate::modbus::registers::{ReadRequest, ReadResponse, WriteRequest, WriteResponse};
use crate::modbus::{Dialect, Length, Table};

/// Quantity (2 bytes) before starting address (2 bytes). The bytes do not tell it from the standard.
pub static NUMBER_FIRST: Dialect = Dialect {
    key: "keb-number-first",
    label: "KEB: quantity before address",
    note: "Functions 100 and 101 give the quantity first, then the starting address.",
    kinds: &[
        &read::request(Length::Fixed(5), || ReadRequest::of(&QUANTITY_FIRST)),
        &write::request(write::COUNTED, || WriteRequest::of(&QUANTITY_FIRST)),
        &write::response(Length::Fixed(5), || WriteResponse::of(&QUANTITY_FIRST)),
    ],
};

/// Starting address (2 bytes), quantity (1 byte): each of these telegrams is a byte shorter.
pub static NUMBER_8: Dialect = Dialect {
    key: "keb-number-8",
    label: "KEB: quantity of one byte",
    note: "Functions 100 and 101 give the quantity in one byte.",
    kinds: &[
        &read::request(Length::Fixed(4), || ReadRequest::of(&QUANTITY_OF_ONE_BYTE)),
        &write::request(Length::Counted { at: 4, unit: 4 }, || WriteRequest::of(&QUANTITY_OF_ONE_BYTE)),
        &write::response(Length::Fixed(4), || WriteResponse::of(&QUANTITY_OF_ONE_BYTE)),
    ],
};

/// The response to function 100 is the values alone. Function 101 keeps its byte count.
pub static NO_BYTE_COUNT: Dialect = Dialect {
    key: "keb-no-byte-count",
    label: "KEB: no byte count in the response",
    note: "The response to function 100 gives the values right behind the function code.",
    kinds: &[&read::response(Length::Units { after: 1, unit: 4 }, || {
        Box::new(ReadResponse { table: &WITHOUT_BYTE_COUNT, asked: None, values: vec![0] })
    })],
};

/// Values with their low 16-bit word first (CDAB). The bytes do not tell it from the standard.
pub static WORD_SWAP: Dialect = Dialect {
    key: "keb-word-swap",
    label: "KEB: low word first",
    note: "Functions 100 and 101 give a 32-bit value's low word before its high word.",
    kinds: &[
        &read::response(read::COUNTED, || ReadResponse::of(&LOW_WORD_FIRST)),
        &write::request(write::COUNTED, || WriteRequest::of(&LOW_WORD_FIRST)),
    ],
};

static QUANTITY_FIRST: Table = Table { layout: Layout { quantity_first: true, ..Layout::STANDARD }, ..LONG };

static QUANTITY_OF_ONE_BYTE: Table =
    Table { layout: Layout { quantity_width: 1, ..Layout::STANDARD }, ..LONG };

static WITHOUT_BYTE_COUNT: Table = Table { layout: Layout { byte_count: false, ..Layout::STANDARD }, ..LONG };

static LOW_WORD_FIRST: Table = Table {
    value: LONG_VALUE.order(Order::LowWordFirst).note("A 32-bit value, its low 16-bit word first."),
    ..LONG
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::Direction::{self, Request, Response};
    use crate::modbus::{Pdu, STANDARD};
    use crate::walk::{Deviations, read, write};

    /// The start and the values that `bytes` give, which must be read without a problem.
    fn told(dialect: &'static Dialect, direction: Direction, bytes: &[u8]) -> (Option<u16>, Vec<u32>) {
        let mut pdu = Pdu::expect(bytes[0], direction, dialect);
        let fields = read(&mut pdu, bytes).fields;
        assert!(crate::field::problems(&fields).is_empty(), "{}: {fields:?}", dialect.key);
        assert_eq!(write(&mut pdu, &Deviations::default()), bytes, "{}", dialect.key);
        let access = pdu.body.access().unwrap();
        let values =
            if access.values.is_empty() { vec![access.count as u32] } else { access.values.to_vec() };
        (access.start, values)
    }

    #[test]
    fn each_dialect_says_the_same() {
        let (start, value) = (Some(0x2000), 0x0102_0304);
        for (dialect, read, write, confirm) in [
            (&STANDARD, "\x64\x20\0\0\x05", "\x65\x20\0\0\x01\x04\x01\x02\x03\x04", "\x65\x20\0\0\x05"),
            (&NUMBER_FIRST, "\x64\0\x05\x20\0", "\x65\0\x01\x20\0\x04\x01\x02\x03\x04", "\x65\0\x05\x20\0"),
            (&NUMBER_8, "\x64\x20\0\x05", "\x65\x20\0\x01\x04\x01\x02\x03\x04", "\x65\x20\0\x05"),
            (&WORD_SWAP, "\x64\x20\0\0\x05", "\x65\x20\0\0\x01\x04\x03\x04\x01\x02", "\x65\x20\0\0\x05"),
        ] {
            assert_eq!(told(dialect, Request, read.as_bytes()), (start, vec![5]));
            assert_eq!(told(dialect, Request, write.as_bytes()), (start, vec![value]));
            assert_eq!(told(dialect, Response, confirm.as_bytes()), (start, vec![5]));
        }
        assert_eq!(told(&NO_BYTE_COUNT, Response, b"\x64\x01\x02\x03\x04\0\0\0\x05").1, [value, 5]);
        assert_eq!(told(&WORD_SWAP, Response, b"\x64\x04\x03\x04\x01\x02").1, [value]);
    }

    #[test]
    fn a_value_cut_short_is_missed_without_a_byte_count_too() {
        let mut pdu = Pdu::expect(100, Response, &NO_BYTE_COUNT);
        let fields = read(&mut pdu, b"\x64\x01\x02\x03\x04\0").fields;
        assert!(crate::field::problems(&fields).iter().any(|problem| problem.code == "truncated"));
    }
}
