//! Telegrams to try: right ones of every function, and broken ones as they come from plants.

/// A text to decode, and what it shows.
#[derive(Debug, PartialEq, Eq)]
pub struct Example {
    /// Stable word of links and tests.
    pub key: &'static str,
    pub label: &'static str,
    pub text: &'static str,
    pub group: Group,
    /// The key of the device that speaks, where one does.
    pub device: &'static str,
}

/// What an example shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// The devices whose manuals Buslens knows.
    Devices,
    /// The same telegram on different ways.
    Transports,
    /// A function code of Modbus.
    Functions,
    /// Something in it is wrong on purpose.
    Broken,
}

impl Group {
    /// In the order in which they are offered.
    pub const ALL: [Self; 4] = [Self::Devices, Self::Broken, Self::Transports, Self::Functions];

    pub const fn label(self) -> &'static str {
        match self {
            Self::Devices => "Devices",
            Self::Transports => "Framing",
            Self::Functions => "Modbus functions",
            Self::Broken => "Faulty telegrams",
        }
    }
}

impl Example {
    const fn new(group: Group, key: &'static str, label: &'static str, text: &'static str) -> Self {
        Self { key, label, text, group, device: "" }
    }

    const fn device(mut self, device: &'static str) -> Self {
        self.device = device;
        self
    }
}

pub static EXAMPLES: &[Example] = &[
    Example::new(
        Group::Devices,
        "memograph_channels",
        "Memograph: channels read and written",
        "01 03 00 C8 00 03 84 35\n\
               01 03 06 00 80 42 A4 F1 DE B0 F8\n\
               01 10 00 D7 00 03 06 00 80 42 F6 E9 79 28 15\n\
               01 10 00 D7 00 03 30 30",
    )
    .device("memograph-rsg45"),
    Example::new(
        Group::Devices,
        "memograph_limit",
        "Memograph: a limit is changed",
        "05 10 0C 90 00 01 02 01 2A C5 8F\n\
               05 10 0C 90 00 01 03 30\n\
               05 10 0C 90 00 04 08 03 03 35 2E 37 3B 31 30 94 BF\n\
               05 10 0C 90 00 04 C3 33\n\
               05 10 0C 90 00 01 02 02 2A C5 7F\n\
               05 10 0C 90 00 01 03 30",
    )
    .device("memograph-rsg45"),
    Example::new(
        Group::Devices,
        "memograph_batch",
        "Memograph: batch 2 starts",
        "05 10 0C 10 00 01 02 01 02 DA 51\n\
               05 10 0C 10 00 01 02 D8\n\
               05 03 0C 10 00 03 06 DA\n\
               05 03 06 00 00 00 01 00 00 42 75",
    )
    .device("memograph-rsg45"),
    Example::new(
        Group::Devices,
        "keb_mapping",
        "KEB F5: a mapping list, then its registers",
        "01 65 5F 32 00 03 0C 00 33 01 01 03 3B 01 02 00 00 00 00 87 85\n\
               01 65 5F 32 00 03 BE 18\n\
               01 03 00 00 00 03 05 CB\n\
               01 03 06 00 10 00 01 86 A0 D3 6E",
    )
    .device("keb-f5-modbus"),
    Example::new(
        Group::Devices,
        "keb_jobs",
        "KEB F5: jobs of the PROFIBUS parameter channel",
        "52 00 23 00 00 0B 00 00\n\
               00 00 00 00 00 00 00 00\n\
               52 00 23 00 00 0B 00 00\n\
               C2 00 23 00 08 00 00 30\n\
               12 00 23 00 00 03 00 00\n\
               C2 00 23 00 08 00 00 30\n\
               12 00 23 00 00 03 00 00\n\
               02 00 23 00 00 03 00 00\n\
               41 00 22 00 00 03 00 00\n\
               71 00 22 00 00 00 00 46",
    )
    .device("keb-f5-profibus"),
    Example::new(
        Group::Devices,
        "keb_profibus",
        "KEB F5: PROFIBUS from start-up to data exchange",
        "68 05 05 68 81 82 6D 3C 3E EA 16\n\
               68 0B 0B 68 82 81 08 3E 3C 02 05 00 FF 05 EB 7B 16\n\
               68 0C 0C 68 81 82 5D 3D 3E B8 0A 14 0B 05 EB 00 AC 16\n\
               E5\n\
               68 08 08 68 81 82 7D 3E 3E B7 A3 93 E9 16\n\
               E5\n\
               68 0F 0F 68 01 02 5D 52 01 20 34 00 64 00 00 00 05 01 2C 9D 16\n\
               68 0F 0F 68 02 01 08 42 01 20 34 00 64 00 00 00 10 01 20 37 16",
    )
    .device("keb-f5-profibus"),
    Example::new(
        Group::Transports,
        "modbus_tcp",
        "Modbus TCP",
        "00 01 00 00 00 06 FF 03 00 C8 00 03\n\
               00 01 00 00 00 09 FF 03 06 00 80 42 A4 F1 DE",
    ),
    Example::new(
        Group::Transports,
        "modbus_ascii",
        "Modbus ASCII",
        ":010300C8000331\n\
               :010306008042A4F1DEC1",
    ),
    Example::new(
        Group::Transports,
        "modbus_pdu",
        "A PDU without frame",
        "03 00 C8 00 03\n\
               03 06 00 80 42 A4 F1 DE",
    ),
    Example::new(
        Group::Functions,
        "read_coils",
        "Read coils (1)",
        "11 01 00 13 00 25 0E 84\n11 01 05 CD 6B B2 0E 1B 45 E6",
    ),
    Example::new(
        Group::Functions,
        "read_discrete_inputs",
        "Read discrete inputs (2)",
        "11 02 00 C4 00 0A BB 60\n11 02 02 AC 01 C4 BB",
    ),
    Example::new(
        Group::Functions,
        "read_holding_registers",
        "Read holding registers (3)",
        "01 03 00 C8 00 03 84 35\n01 03 06 00 80 42 A4 F1 DE B0 F8",
    ),
    Example::new(
        Group::Functions,
        "read_input_registers",
        "Read input registers (4)",
        "11 04 00 00 00 02 73 5B\n11 04 04 09 29 00 0B 79 D6",
    ),
    Example::new(
        Group::Functions,
        "write_single_coil",
        "Write single coil (5)",
        "11 05 00 AC FF 00 4E 8B\n11 05 00 AC FF 00 4E 8B",
    ),
    Example::new(
        Group::Functions,
        "write_single_register",
        "Write single register (6)",
        "05 06 0C 90 04 01 48 33\n05 06 0C 90 04 01 48 33",
    ),
    Example::new(
        Group::Functions,
        "read_exception_status",
        "Read exception status (7)",
        "11 07 4C 22\n11 07 6D E2 18",
    ),
    Example::new(
        Group::Functions,
        "diagnostics",
        "Diagnostics (8)",
        "11 08 00 00 A5 37 D8 1D\n11 08 00 00 A5 37 D8 1D",
    ),
    Example::new(
        Group::Functions,
        "get_comm_event_counter",
        "Get comm event counter (11)",
        "11 0B 4C 27\n11 0B FF FF 01 08 A6 E9",
    ),
    Example::new(
        Group::Functions,
        "get_comm_event_log",
        "Get comm event log (12)",
        "11 0C 0D E5\n11 0C 0C 00 00 01 08 01 21 80 41 82 C0 04 00 43 F3",
    ),
    Example::new(
        Group::Functions,
        "write_multiple_coils",
        "Write multiple coils (15)",
        "11 0F 00 13 00 0A 02 CD 01 BF 0B\n11 0F 00 13 00 0A 26 99",
    ),
    Example::new(
        Group::Functions,
        "write_multiple_registers",
        "Write multiple registers (16)",
        "01 10 00 D7 00 03 06 00 80 42 F6 E9 79 28 15\n01 10 00 D7 00 03 30 30",
    ),
    Example::new(
        Group::Functions,
        "report_server_id",
        "Report server ID (17)",
        "11 11 CD EC\n11 11 08 B4 FF 56 31 2E 30 2E 33 41 A0",
    ),
    Example::new(
        Group::Functions,
        "read_file_record",
        "Read file record (20)",
        "11 14 0E 06 00 04 00 01 00 02 06 00 03 00 09 00 02 F9 38\n\
               11 14 0C 05 06 0D FE 00 20 05 06 33 CD 00 40 69 AD",
    ),
    Example::new(
        Group::Functions,
        "write_file_record",
        "Write file record (21)",
        "11 15 0D 06 00 04 00 07 00 03 06 AF 04 BE 10 0D DB C7\n\
               11 15 0D 06 00 04 00 07 00 03 06 AF 04 BE 10 0D DB C7",
    ),
    Example::new(
        Group::Functions,
        "mask_write_register",
        "Mask write register (22)",
        "11 16 00 04 00 F2 00 25 66 E2\n11 16 00 04 00 F2 00 25 66 E2",
    ),
    Example::new(
        Group::Functions,
        "read_write_multiple_registers",
        "Read/write multiple registers (23)",
        "11 17 00 03 00 06 00 0E 00 03 06 00 FF 00 FF 00 FF 4B 54\n\
               11 17 0C 00 FE 0A CD 00 01 00 03 00 0D 00 FF 0D 75",
    ),
    Example::new(
        Group::Functions,
        "read_fifo_queue",
        "Read FIFO queue (24)",
        "11 18 04 DE 07 87\n11 18 00 06 00 02 01 B8 12 84 18 8D",
    ),
    Example::new(
        Group::Functions,
        "read_device_identification",
        "Read device identification (43)",
        "11 2B 0E 01 00 B1 B4\n\
               11 2B 0E 01 01 00 00 03 00 07 42 75 73 6C 65 6E 73 01 02 42 31 02 04 56 31 2E 30 94 B5",
    ),
    Example::new(
        Group::Functions,
        "read_long_registers",
        "KEB: read 32-bit registers (100)",
        "01 64 5F 32 00 02 42 18\n01 64 08 00 33 01 01 02 00 01 02 99 48",
    )
    .device("keb-f5-modbus"),
    Example::new(
        Group::Functions,
        "write_long_registers",
        "KEB: write 32-bit registers (101)",
        "01 65 5F 96 00 02 08 02 00 01 02 00 00 00 00 C4 CE\n01 65 5F 96 00 02 3E 3B",
    )
    .device("keb-f5-modbus"),
    Example::new(
        Group::Functions,
        "refused",
        "Rejected: exceptions 2, 64 and 66",
        "01 03 27 10 00 01 8F 7B\n01 83 02 C0 F1\n01 64 20 00 00 3E FA 12\n01 E4 40 6A F0\n\
               01 65 20 0A 00 01 04 00 00 00 05 38 1A\n01 E5 42 EA A1",
    ),
    Example::new(
        Group::Transports,
        "source_code",
        "A telegram from C source code",
        "uint8_t request[8] = {\n    0x01, 0x03,   // unit 1, read holding registers\n    \
               0x00, 0xC8,   // from 200\n    0x00, 0x03,   // three\n    0x84, 0x35    // CRC\n};",
    ),
    Example::new(
        Group::Broken,
        "flow_control",
        "A byte that a converter swallowed",
        "01 03 00 C8 00 03 84 35\n\
               01 03 06 00 80 42 47 AE D6 9A",
    )
    .device("memograph-rsg45"),
    Example::new(
        Group::Broken,
        "check_failed",
        "A changed byte: the CRC is wrong",
        "01 03 00 C8 00 03 84 35\n01 03 06 00 08 42 A4 F1 DE B0 F8",
    ),
    Example::new(
        Group::Broken,
        "register_missing",
        "A register is missing",
        "01 03 18 B5 00 05 92 8F\n01 03 0A 40 19 33 33 39 80 00 00 C5 32",
    ),
    Example::new(
        Group::Broken,
        "byte_too_many",
        "A byte too many",
        "05 03 0C 90 00 08 46 F5\n05 03 10 00 01 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 D4 69",
    ),
    Example::new(
        Group::Broken,
        "byte_count_wrong",
        "Valid CRC, wrong byte count",
        "01 03 05 00 80 42 A4 F1 DE 83 F8",
    ),
    Example::new(
        Group::Broken,
        "quantity_too_large",
        "Valid CRC, too many registers",
        "01 03 07 D0 00 7E C5 67",
    ),
    Example::new(Group::Broken, "bad_character", "A letter O in place of a zero", "01 03 O0 C8 00 03 84 35"),
];
