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
        key: "read_coils",
        label: "Read coils (1)",
        text: "11 01 00 13 00 25 0E 84\n11 01 05 CD 6B B2 0E 1B 45 E6",
        broken: false,
    },
    Example {
        key: "read_discrete_inputs",
        label: "Read discrete inputs (2)",
        text: "11 02 00 C4 00 0A BB 60\n11 02 02 AC 01 C4 BB",
        broken: false,
    },
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
        key: "write_single_coil",
        label: "Write single coil (5)",
        text: "11 05 00 AC FF 00 4E 8B\n11 05 00 AC FF 00 4E 8B",
        broken: false,
    },
    Example {
        key: "write_single_register",
        label: "Write single register (6)",
        text: "05 06 0C 90 04 01 48 33\n05 06 0C 90 04 01 48 33",
        broken: false,
    },
    Example {
        key: "read_exception_status",
        label: "Read exception status (7)",
        text: "11 07 4C 22\n11 07 6D E2 18",
        broken: false,
    },
    Example {
        key: "diagnostics",
        label: "Diagnostics (8)",
        text: "11 08 00 00 A5 37 D8 1D\n11 08 00 00 A5 37 D8 1D",
        broken: false,
    },
    Example {
        key: "get_comm_event_counter",
        label: "Get comm event counter (11)",
        text: "11 0B 4C 27\n11 0B FF FF 01 08 A6 E9",
        broken: false,
    },
    Example {
        key: "get_comm_event_log",
        label: "Get comm event log (12)",
        text: "11 0C 0D E5\n11 0C 0C 00 00 01 08 01 21 80 41 82 C0 04 00 43 F3",
        broken: false,
    },
    Example {
        key: "write_multiple_coils",
        label: "Write multiple coils (15)",
        text: "11 0F 00 13 00 0A 02 CD 01 BF 0B\n11 0F 00 13 00 0A 26 99",
        broken: false,
    },
    Example {
        key: "write_multiple_registers",
        label: "Write multiple registers (16)",
        text: "01 10 00 D7 00 03 06 00 80 42 F6 E9 79 28 15\n01 10 00 D7 00 03 30 30",
        broken: false,
    },
    Example {
        key: "report_server_id",
        label: "Report server ID (17)",
        text: "11 11 CD EC\n11 11 08 B4 FF 56 31 2E 30 2E 33 41 A0",
        broken: false,
    },
    Example {
        key: "read_file_record",
        label: "Read file record (20)",
        text: "11 14 0E 06 00 04 00 01 00 02 06 00 03 00 09 00 02 F9 38\n\
               11 14 0C 05 06 0D FE 00 20 05 06 33 CD 00 40 69 AD",
        broken: false,
    },
    Example {
        key: "write_file_record",
        label: "Write file record (21)",
        text: "11 15 0D 06 00 04 00 07 00 03 06 AF 04 BE 10 0D DB C7\n\
               11 15 0D 06 00 04 00 07 00 03 06 AF 04 BE 10 0D DB C7",
        broken: false,
    },
    Example {
        key: "mask_write_register",
        label: "Mask write register (22)",
        text: "11 16 00 04 00 F2 00 25 66 E2\n11 16 00 04 00 F2 00 25 66 E2",
        broken: false,
    },
    Example {
        key: "read_write_multiple_registers",
        label: "Read/write multiple registers (23)",
        text: "11 17 00 03 00 06 00 0E 00 03 06 00 FF 00 FF 00 FF 4B 54\n\
               11 17 0C 00 FE 0A CD 00 01 00 03 00 0D 00 FF 0D 75",
        broken: false,
    },
    Example {
        key: "read_fifo_queue",
        label: "Read FIFO queue (24)",
        text: "11 18 04 DE 07 87\n11 18 00 06 00 02 01 B8 12 84 18 8D",
        broken: false,
    },
    Example {
        key: "read_device_identification",
        label: "Read device identification (43)",
        text: "11 2B 0E 01 00 B1 B4\n\
               11 2B 0E 01 01 00 00 03 00 07 42 75 73 6C 65 6E 73 01 02 42 31 02 04 56 31 2E 30 94 B5",
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
