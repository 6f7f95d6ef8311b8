//! Endress+Hauser Memograph M RSG45: a data manager with the option "Modbus slave".
//!
//! Addresses are zero-based, numbers big-endian with the high word first.

mod batch;
mod command;
mod event_text;
mod limit;
mod present;
mod relay;
mod text;

use super::{Access, Area, Content, Misprint, New, Part, Profile};
use crate::field::{Bits, Format, Name, Range, Role, Spec};

pub static PROFILE: Profile = Profile {
    key: "memograph-rsg45",
    label: "Endress+Hauser Memograph M RSG45",
    source: "Memograph M RSG45 Modbus supplement",
    functions: &[3, 6, 16],
    areas: AREAS,
    most_registers: Some(123),
    lessons: present::LESSONS,
    rules: present::RULES,
    misprints: MISPRINTS,
    ..Profile::BLANK
};

/// Where the overview (section 3) and the sections before it contradict each other, this follows
/// those sections: 20 single digital inputs and not 12, 12 maths states and not 4, 6500 to 6559 and
/// 6900 to 6911 as they are, a relay register that can be written.
static AREAS: &[Area] = &[
    written(channels(200, 40, SINGLE, universal("universal_value"))),
    channels(800, 40, SINGLE, universal_total("universal_total")).also(TOTAL),
    Area::new(1200, DIGITAL).blocks(20, 1, 1),
    Area { stride: 2, ..Area::new(1240, DIGITALS).content(Content::Parts(DIGITAL_PARTS)).together() }
        .also("digital states all"),
    channels(1300, 20, SINGLE, digital_total("digital_total")).also(TOTAL),
    channels(1500, 12, SINGLE, maths("maths_value")),
    channels(1700, 12, SINGLE, maths_total("maths_total")).also(TOTAL),
    Area::new(1800, MATHS_STATES).access(Access::Read),
    command(3024, 20, EVENT_TEXT, None, event_text::write)
        .access(Access::Write)
        .together()
        .also("event list message"),
    command(3088, 40, BATCH, Some(batch::read), batch::write).together().reads(&batch::READS),
    command(3152, 1, RELAY, Some(relay::read), relay::write),
    command(3216, 10, LIMIT, Some(limit::read), limit::write).reads(&limit::READS).also("limit value"),
    plain(4000, 40, 2, universal("universal_value_plain")),
    plain(4200, 12, 2, maths("maths_value_plain")),
    written(channels(5200, 40, DOUBLE, universal("universal_value_double"))),
    channels(5800, 40, DOUBLE, universal_total("universal_total_double")).also(TOTAL),
    channels(6300, 20, DOUBLE, digital_total("digital_total_double")).also(TOTAL),
    channels(6500, 12, DOUBLE, maths("maths_value_double")),
    channels(6700, 12, DOUBLE, maths_total("maths_total_double")).also(TOTAL),
    plain(6800, 40, 1, status("universal_status", "Universal channel status").short("Universal status")),
    plain(6900, 12, 1, status("maths_status", "Maths channel status").short("Maths status")),
    plain(8000, 40, 4, universal("universal_value_plain_double")),
    plain(8400, 12, 4, maths("maths_value_plain_double")),
];

/// Channels that take their value from the bus, too.
const fn written(area: Area) -> Area {
    area.access(Access::ReadWrite).together().whole()
}

/// Channels that are read with their status.
const fn channels(from: u16, count: u16, parts: &'static [Part], spec: Spec) -> Area {
    let mut stride = 0;
    let mut index = 0;
    while index < parts.len() {
        stride += parts[index].registers;
        index += 1;
    }
    Area::new(from, spec).blocks(count, stride, 1).access(Access::Read).content(Content::Parts(parts))
}

/// Channels that are read as one number.
const fn plain(from: u16, count: u16, registers: u16, spec: Spec) -> Area {
    Area::new(from, spec).blocks(count, registers, 1).access(Access::Read)
}

/// Registers that are written, and read, as a telegram of their own.
const fn command(from: u16, registers: u16, spec: Spec, read: Option<New>, write: New) -> Area {
    let content = Content::Telegram { read, write: Some(write) };
    Area { stride: registers, ..Area::new(from, spec).content(content) }
}

/// Status, then a float of 4 bytes.
const SINGLE: &[Part] = &[Part::new(&STATUS, 1).written(&WRITTEN_STATUS), Part::new(&VALUE, 2)];

/// Status, then a float of 8 bytes.
const DOUBLE: &[Part] = &[Part::new(&STATUS, 1).written(&WRITTEN_STATUS), Part::new(&VALUE, 4)];

static STATUS: Spec = status("status", "Status");

/// What a client writes: a range of codes for each worth, and no limits.
static WRITTEN_STATUS: Spec = Spec::new("status", "Status")
    .role(Role::Status)
    .initial(0x80)
    .bits(&[
        Bits::part(0, 8, "worth", "quality")
            .names(&[
                Name { value: 0x80, label: "good", note: "As all from 80h to FFh." },
                Name { value: 0x40, label: "uncertain", note: "As all from 40h to 7Fh." },
                Name { value: 0x00, label: "invalid", note: "As all up to 3Fh: the value is not used." },
            ])
            .ranges(WORTHS),
        Bits::reserved(8, 8),
    ])
    .note("Quality of the value. The device watches its limits itself: the high byte should be 0.")
    .source("Memograph M RSG45 Modbus supplement, 2.6.14");

/// What codes without a name of their own are worth.
const WORTHS: &[Range] = &[
    Range { from: 0x00, to: 0x3F, label: "invalid" },
    Range { from: 0x40, to: 0x7F, label: "uncertain" },
    Range { from: 0x80, to: 0xFF, label: "good" },
];

static VALUE: Spec = Spec::new("value", "Value")
    .format(Format::Float)
    .note("A number in the unit that the device is set up with; the bus does not carry the unit.")
    .source("Memograph M RSG45 Modbus supplement, 2.6.14");

const fn status(key: &'static str, label: &'static str) -> Spec {
    Spec::new(key, label)
        .role(Role::Status)
        .bits(STATUS_BITS)
        .note(
            "The quality of the value (low byte), and which of the channel's first eight limits are \
             violated (high byte, from the device only).",
        )
        .source("Memograph M RSG45 Modbus supplement, 2.6.14")
}

const STATUS_BITS: &[Bits] = &[
    Bits::part(0, 8, "float_status", "float status")
        .names(&[
            Name { value: 0x01, label: "open circuit", note: "A wire of the sensor is broken or loose." },
            Name { value: 0x02, label: "signal too high", note: "" },
            Name { value: 0x03, label: "signal too low", note: "" },
            Name { value: 0x04, label: "invalid measured value", note: "" },
            Name { value: 0x06, label: "error value", note: "" },
            Name { value: 0x07, label: "sensor or input error", note: "" },
            Name { value: 0x08, label: "no value yet", note: "For example just after switching on." },
            Name { value: 0x40, label: "uncertain", note: "An error value stands in for the measured one." },
            Name { value: 0x41, label: "uncertain, low limit or falling gradient", note: "" },
            Name { value: 0x42, label: "uncertain, high limit or rising gradient", note: "" },
            Name { value: 0x43, label: "uncertain, both limits or band", note: "" },
            Name { value: 0x80, label: "good", note: "The value can be used, and no limit is violated." },
            Name { value: 0x81, label: "good, low limit or falling gradient", note: "" },
            Name { value: 0x82, label: "good, high limit or rising gradient", note: "" },
            Name { value: 0x83, label: "good, both limits or band", note: "" },
        ])
        .ranges(WORTHS)
        .note("Other codes: up to 3Fh invalid, up to 7Fh uncertain, else good."),
    Bits::flag(8, "limit_1", "limit 1 violated"),
    Bits::flag(9, "limit_2", "limit 2 violated"),
    Bits::flag(10, "limit_3", "limit 3 violated"),
    Bits::flag(11, "limit_4", "limit 4 violated"),
    Bits::flag(12, "limit_5", "limit 5 violated"),
    Bits::flag(13, "limit_6", "limit 6 violated"),
    Bits::flag(14, "limit_7", "limit 7 violated"),
    Bits::flag(15, "limit_8", "limit 8 violated"),
];

const fn universal(key: &'static str) -> Spec {
    Spec::new(key, "Universal channel")
        .short("Universal")
        .format(Format::Float)
        .note(
            "The present value of a universal input. Where writing is allowed, the input must be set up \
             to get its signal from the bus; where nothing is written for longer than the timeout that the \
             device is set up with, it becomes invalid. Channels that are only read have no timeout.",
        )
        .source("Memograph M RSG45 Modbus supplement, 2.6.1 and 2.6.3")
}

const fn universal_total(key: &'static str) -> Spec {
    Spec::new(key, "Universal channel total")
        .short("Universal total")
        .format(Format::Float)
        .note("What a universal input has added up.")
        .source("Memograph M RSG45 Modbus supplement, 2.6.7")
}

const DIGITAL: Spec = Spec::new("digital_state", "Digital input")
    .short("Digital")
    .limits(0, 1)
    .names(&[Name { value: 0, label: "off", note: "" }, Name { value: 1, label: "on", note: "" }])
    .note(
        "The state of one input. To be written, the input must be set up to get its state from the bus; where \
         nothing is written for longer than the timeout that the device is set up with, it becomes invalid.",
    )
    .source("Memograph M RSG45 Modbus supplement, 2.6.2 and 2.6.5");

/// All inputs in two registers.
const DIGITALS: Spec = Spec::new("digital_states", "Digital inputs")
    .short("Digital")
    .note("The states of all inputs, a bit each, in two registers.")
    .source("Memograph M RSG45 Modbus supplement, 2.6.2 and 2.6.5");

const DIGITAL_PARTS: &[Part] = &[Part::new(&DIGITAL_1_TO_16, 1), Part::new(&DIGITAL_17_TO_20, 1)];

static DIGITAL_1_TO_16: Spec = Spec::new("digital_states_1_to_16", "Digital inputs 1 to 16")
    .short("Digital 1 to 16")
    .bits(&[
        Bits::flag(0, "input_1", "input 1"),
        Bits::flag(1, "input_2", "input 2"),
        Bits::flag(2, "input_3", "input 3"),
        Bits::flag(3, "input_4", "input 4"),
        Bits::flag(4, "input_5", "input 5"),
        Bits::flag(5, "input_6", "input 6"),
        Bits::flag(6, "input_7", "input 7"),
        Bits::flag(7, "input_8", "input 8"),
        Bits::flag(8, "input_9", "input 9"),
        Bits::flag(9, "input_10", "input 10"),
        Bits::flag(10, "input_11", "input 11"),
        Bits::flag(11, "input_12", "input 12"),
        Bits::flag(12, "input_13", "input 13"),
        Bits::flag(13, "input_14", "input 14"),
        Bits::flag(14, "input_15", "input 15"),
        Bits::flag(15, "input_16", "input 16"),
    ])
    .flagged("on", "all off")
    .note("Bit 0 is input 1, and so on; 1 is on.")
    .source("Memograph M RSG45 Modbus supplement, 2.6.2 and 2.6.5");

static DIGITAL_17_TO_20: Spec = Spec::new("digital_states_17_to_20", "Digital inputs 17 to 20")
    .short("Digital 17 to 20")
    .bits(&[
        Bits::flag(0, "input_17", "input 17"),
        Bits::flag(1, "input_18", "input 18"),
        Bits::flag(2, "input_19", "input 19"),
        Bits::flag(3, "input_20", "input 20"),
        Bits::reserved(4, 12),
    ])
    .flagged("on", "all off")
    .note("Bit 0 is input 17, and so on; 1 is on.")
    .source("Memograph M RSG45 Modbus supplement, 2.6.2 and 2.6.5");

const fn digital_total(key: &'static str) -> Spec {
    Spec::new(key, "Digital input total")
        .short("Digital total")
        .format(Format::Float)
        .note("The pulses or operating time that a digital input has counted.")
        .source("Memograph M RSG45 Modbus supplement, 2.6.6")
}

const fn maths(key: &'static str) -> Spec {
    Spec::new(key, "Maths channel")
        .short("Maths")
        .format(Format::Float)
        .note("The result of a calculation in the device.")
        .source("Memograph M RSG45 Modbus supplement, 2.6.4")
}

const fn maths_total(key: &'static str) -> Spec {
    Spec::new(key, "Maths channel total")
        .short("Maths total")
        .format(Format::Float)
        .note("What a maths channel has added up.")
        .source("Memograph M RSG45 Modbus supplement, 2.6.8")
}

const MATHS_STATES: Spec = Spec::new("maths_states", "Maths channels 1 to 12")
    .short("Maths 1 to 12")
    .role(Role::Status)
    .bits(&[
        Bits::flag(0, "maths_1", "maths 1"),
        Bits::flag(1, "maths_2", "maths 2"),
        Bits::flag(2, "maths_3", "maths 3"),
        Bits::flag(3, "maths_4", "maths 4"),
        Bits::flag(4, "maths_5", "maths 5"),
        Bits::flag(5, "maths_6", "maths 6"),
        Bits::flag(6, "maths_7", "maths 7"),
        Bits::flag(7, "maths_8", "maths 8"),
        Bits::flag(8, "maths_9", "maths 9"),
        Bits::flag(9, "maths_10", "maths 10"),
        Bits::flag(10, "maths_11", "maths 11"),
        Bits::flag(11, "maths_12", "maths 12"),
        Bits::reserved(12, 4),
    ])
    .flagged("on", "all off")
    .note("Which calculations that give on or off are on. Bit 0 is channel 1, and so on.")
    .source("Memograph M RSG45 Modbus supplement, 2.6.4");

const EVENT_TEXT: Spec = Spec::new("event_text", "Event text")
    .short("Event")
    .note("A line for the device's event list, of at most 40 characters.")
    .source("Memograph M RSG45 Modbus supplement, 2.6.12");

const BATCH: Spec = Spec::new("batch", "Batch")
    .note("Starting, stopping and naming batches; reading gives their states. Needs the batch option.")
    .source("Memograph M RSG45 Modbus supplement, 2.6.13");

const RELAY: Spec = Spec::new("relay", "Relay")
    .note("Writing switches one relay, which needs the telealarm option; reading gives the states of all.")
    .source("Memograph M RSG45 Modbus supplement, 2.6.9 and 2.6.10");

const LIMIT: Spec = Spec::new("limit", "Limit")
    .note("Changing limits step by step; reading gives the last step's status, or one limit after the other.")
    .source("Memograph M RSG45 Modbus supplement, 2.6.11");

const TOTAL: &str = "totalizer counter";

/// The telegrams of the manual that fail their check.
static MISPRINTS: &[Misprint] = &[
    Misprint {
        section: "2.6.3",
        printed: &[0x01, 0x03, 0x06, 0x00, 0x08, 0x42, 0xA4, 0xF1, 0xDE, 0xB0, 0xF8],
        right: &[0x01, 0x03, 0x06, 0x00, 0x80, 0x42, 0xA4, 0xF1, 0xDE, 0xB0, 0xF8],
        slips: "the status 00 80 is printed as 00 08",
    },
    Misprint {
        section: "2.6.3",
        printed: &[0x01, 0x03, 0x0A, 0x00, 0x08, 0x40, 0x54, 0x9E, 0x3B, 0xC0, 0x00, 0x00, 0x00, 0x91, 0x3E],
        right: &[0x01, 0x03, 0x0A, 0x00, 0x80, 0x40, 0x54, 0x9E, 0x3B, 0xC0, 0x00, 0x00, 0x00, 0x91, 0x3E],
        slips: "the status 00 80 is printed as 00 08",
    },
    Misprint {
        section: "2.6.4",
        printed: &[0x01, 0x03, 0x06, 0x00, 0x08, 0x46, 0x40, 0xE6, 0xB7, 0x3E, 0x21],
        right: &[0x01, 0x03, 0x06, 0x00, 0x80, 0x46, 0x40, 0xE6, 0xB7, 0x3E, 0x21],
        slips: "the status 00 80 is printed as 00 08",
    },
    Misprint {
        section: "2.6.5",
        printed: &[0x01, 0x03, 0x04, 0x00, 0x08, 0x7B, 0xF1],
        right: &[0x01, 0x03, 0x04, 0x00, 0x08, 0x00, 0x00, 0x7B, 0xF1],
        slips: "the second register, 00 00, is left out",
    },
    Misprint {
        section: "2.6.6",
        printed: &[0x01, 0x03, 0x0A, 0x40, 0x19, 0x33, 0x33, 0x39, 0x80, 0x00, 0x00, 0xC5, 0x32],
        right: &[0x01, 0x03, 0x0A, 0x00, 0x80, 0x40, 0x19, 0x33, 0x33, 0x39, 0x80, 0x00, 0x00, 0xC5, 0x32],
        slips: "the status 00 80 is left out",
    },
    Misprint {
        section: "2.6.7",
        printed: &[0x01, 0x03, 0x06, 0x00, 0x80, 0x46, 0xCF, 0x7A, 0xE6, 0xE6, 0xFE],
        right: &[0x01, 0x03, 0x06, 0x00, 0x80, 0x46, 0xCF, 0x7A, 0xF9, 0xE6, 0xFE],
        slips: "the last byte of the value, F9, is printed as E6",
    },
    Misprint {
        section: "2.6.11",
        printed: &[0x05, 0x10, 0x0C, 0x90, 0x00, 0x01, 0x02, 0x01, 0x2A, 0x96, 0xA0],
        right: &[0x05, 0x10, 0x0C, 0x90, 0x00, 0x01, 0x02, 0x01, 0x2A, 0xC5, 0x8F],
        slips: "the check is that of the telegram for the relay",
    },
    Misprint {
        section: "2.6.11",
        printed: &[0x05, 0x10, 0x0C, 0x90, 0x00, 0x03, 0x06, 0x01, 0x01, 0x39, 0x30, 0x2E, 0x35, 0x3D, 0xFE],
        right: &[0x05, 0x10, 0x0C, 0x90, 0x00, 0x03, 0x06, 0x03, 0x01, 0x39, 0x30, 0x2E, 0x35, 0x3D, 0xFE],
        slips: "the function 03 is printed as 01",
    },
    Misprint {
        section: "2.6.11",
        printed: &[
            0x05, 0x03, 0x10, 0x00, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
            0x00, 0x00, 0x00, 0x00, 0xD4, 0x69,
        ],
        right: &[
            0x05, 0x03, 0x10, 0x00, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
            0x00, 0x00, 0x00, 0xD4, 0x69,
        ],
        slips: "a byte 00 is printed too many",
    },
    Misprint {
        section: "2.6.13",
        printed: &[0x05, 0x10, 0x0C, 0x10, 0x00, 0x01, 0x02, 0x01, 0x02, 0xD2, 0x51],
        right: &[0x05, 0x10, 0x0C, 0x10, 0x00, 0x01, 0x02, 0x01, 0x02, 0xDA, 0x51],
        slips: "the check DA 51 is printed as D2 51",
    },
    Misprint {
        section: "2.6.13",
        printed: &[
            0x05, 0x10, 0x0C, 0x10, 0x00, 0x08, 0x10, 0x02, 0x02, 0x49, 0x44, 0x53, 0x59, 0x53, 0x3B, 0x52,
            0x65, 0x6D, 0x6F, 0x74, 0x65, 0x58, 0x20, 0xD3, 0xD6,
        ],
        right: &[
            0x05, 0x10, 0x0C, 0x10, 0x00, 0x08, 0x10, 0x02, 0x02, 0x49, 0x44, 0x53, 0x50, 0x53, 0x3B, 0x52,
            0x65, 0x6D, 0x6F, 0x74, 0x65, 0x58, 0x20, 0xD3, 0xD6,
        ],
        slips: "the letter 50 is printed as 59",
    },
    Misprint {
        section: "2.6.13",
        printed: &[
            0x05, 0x10, 0x0C, 0x10, 0x00, 0x06, 0x0B, 0x03, 0x02, 0x59, 0x64, 0x65, 0x6E, 0x74, 0x69, 0x66,
            0x65, 0x72, 0x0E, 0x20,
        ],
        right: &[
            0x05, 0x10, 0x0C, 0x10, 0x00, 0x06, 0x0C, 0x03, 0x02, 0x49, 0x64, 0x65, 0x6E, 0x74, 0x69, 0x66,
            0x69, 0x65, 0x72, 0x0E, 0x20,
        ],
        slips: "the byte count 0C is printed as 0B, the letter 49 as 59, and a letter 69 is left out",
    },
    Misprint {
        section: "2.6.13",
        printed: &[0x05, 0x03, 0x0C, 0x10, 0x06, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x42, 0x75],
        right: &[0x05, 0x03, 0x06, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x42, 0x75],
        slips: "a register address 0C 10 is printed that a response does not have",
    },
];

/// What stands behind a telegram in registers that are read with it.
static UNUSED: Spec = Spec::new("unused", "Without meaning")
    .short("Unused")
    .role(Role::Unknown)
    .note("Registers that were asked for but say nothing.");
