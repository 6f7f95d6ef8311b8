//! Telegrams to try: right ones of every function, and broken ones as they come from plants.

/// A text to decode, and what it shows.
#[derive(Debug, PartialEq, Eq)]
pub struct Example {
    /// Stable word of links and tests.
    pub key: &'static str,
    pub label: &'static str,
    pub text: &'static str,
    /// Something in it is wrong on purpose.
    pub broken: bool,
}

pub static EXAMPLES: &[Example] = &[
    Example {
        key: "read_holding_registers",
        label: "Read holding registers (3)",
        text: "01 03 00 C8 00 03 84 35\n01 03 06 00 80 42 A4 F1 DE B0 F8",
        broken: false,
    },
    Example {
        key: "read_input_registers",
        label: "Read input registers (4)",
        text: "11 04 00 00 00 02 73 5B\n11 04 04 09 29 00 0B 79 D6",
        broken: false,
    },
    Example {
        key: "write_single_register",
        label: "Write single register (6)",
        text: "05 06 0C 90 04 01 48 33\n05 06 0C 90 04 01 48 33",
        broken: false,
    },
    Example {
        key: "write_multiple_registers",
        label: "Write multiple registers (16)",
        text: "01 10 00 D7 00 03 06 00 80 42 F6 E9 79 28 15\n01 10 00 D7 00 03 30 30",
        broken: false,
    },
    Example {
        key: "read_long_registers",
        label: "KEB: read 32-bit registers (100)",
        text: "01 64 5F 32 00 02 42 18\n01 64 08 00 33 01 01 02 00 01 02 99 48",
        broken: false,
    },
    Example {
        key: "write_long_registers",
        label: "KEB: write 32-bit registers (101)",
        text: "01 65 5F 96 00 02 08 02 00 01 02 00 00 00 00 C4 CE\n01 65 5F 96 00 02 3E 3B",
        broken: false,
    },
    Example {
        key: "refused",
        label: "Refused: exceptions 2, 64 and 66",
        text: "01 03 27 10 00 01 8F 7B\n01 83 02 C0 F1\n01 64 20 00 00 3E FA 12\n01 E4 40 6A F0\n\
               01 65 20 0A 00 01 04 00 00 00 05 38 1A\n01 E5 42 EA A1",
        broken: false,
    },
    Example {
        key: "source_code",
        label: "A telegram from C source code",
        text: "uint8_t request[8] = {\n    0x01, 0x03,   // unit 1, read holding registers\n    \
               0x00, 0xC8,   // from 200\n    0x00, 0x03,   // three\n    0x84, 0x35    // CRC\n};",
        broken: false,
    },
    Example {
        key: "check_failed",
        label: "A changed byte: the check fails",
        text: "01 03 00 C8 00 03 84 35\n01 03 06 00 08 42 A4 F1 DE B0 F8",
        broken: true,
    },
    Example {
        key: "register_missing",
        label: "A register is missing",
        text: "01 03 18 B5 00 05 92 8F\n01 03 0A 40 19 33 33 39 80 00 00 C5 32",
        broken: true,
    },
    Example {
        key: "byte_too_many",
        label: "A byte too many",
        text: "05 03 0C 90 00 08 46 F5\n05 03 10 00 01 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 D4 69",
        broken: true,
    },
    Example {
        key: "byte_count_wrong",
        label: "Right check, wrong byte count",
        text: "01 03 05 00 80 42 A4 F1 DE 83 F8",
        broken: true,
    },
    Example {
        key: "quantity_too_large",
        label: "Right check, too many registers",
        text: "01 03 07 D0 00 7E C5 67",
        broken: true,
    },
    Example {
        key: "bad_character",
        label: "A letter O in place of a zero",
        text: "01 03 O0 C8 00 03 84 35",
        broken: true,
    },
];
