//! KEB COMBIVERT F5 on Modbus.
//!
//! | registers | what is there |
//! | --- | --- |
//! | 0000h to 1FFFh | what the user's two mapping lists say, one for reading and one for writing |
//! | 2000h to 5EFFh | inverter parameters: parameter address + 2000h |
//! | 5F00h to 5FFFh | the operator's own parameters, the mapping lists among them |
//!
//! A parameter of one byte takes the low byte of its register. What is 32 bits wide stands in a
//! single register address: KEB's functions 100 and 101 reach it there, the standard ones only
//! through a mapping list.
//!
//! Source: KEB COMBIVERT F5 Modbus operator manual, sections 2.2, 2.3 and 3. The fields of a
//! mapping entry are those of the English edition (CM.F5.010-K000, page 10).

use super::{Area, Content, Entry, Lesson, Parameter, Profile, keb_f5};
use crate::field::{Bits, Format, Name, Spec};

pub static PROFILE: Profile = Profile {
    key: "keb-f5-modbus",
    label: "KEB COMBIVERT F5 on Modbus",
    source: "KEB COMBIVERT F5 Modbus operator",
    functions: &[3, 4, 6, 16, 100, 101],
    ident: None,
    hex_addresses: true,
    areas: AREAS,
    parameters: &[keb_f5::INVERTER_PARAMETERS, PARAMETERS],
    most_registers: None,
    display: &[],
    lessons: LESSONS,
};

static AREAS: &[Area] = &[
    Area::new(
        0x0000,
        Spec::new("mapped_register", "Mapped register")
            .format(Format::Register)
            .hex_numbers()
            .note("What stands here, a mapping list says: the one for reading or the one for writing.")
            .source("KEB COMBIVERT F5 Modbus operator, 2.2 and 2.3"),
    )
    .blocks(0x2000, 1, 0)
    .content(Content::Mapped),
    keb_f5::inverter_parameters(
        "A parameter of the inverter: register less 2000h is its address. It is that of the set that \
         Fr.09 chooses.",
        "KEB COMBIVERT F5 Modbus operator, 2.2",
    ),
    Area::new(0x5F00, OPERATOR_PARAMETER).blocks(0x32, 1, 0x5F00),
    Area::new(0x5F32, mapping_entry("read_mapping_entry", "Read mapping entry")).blocks(100, 1, 0).length(4),
    Area::new(0x5F96, mapping_entry("write_mapping_entry", "Write mapping entry"))
        .blocks(100, 1, 0)
        .length(4),
    Area::new(0x5FFA, OPERATOR_PARAMETER).blocks(6, 1, 0x5FFA),
];

const OPERATOR_PARAMETER: Spec = Spec::new("operator_parameter", "Operator parameter")
    .format(Format::Register)
    .hex_numbers()
    .note("A parameter of the operator, the inverter's bus module.")
    .source(SOURCE);

pub const fn mapping_entry(key: &'static str, label: &'static str) -> Spec {
    Spec::new(key, label)
        .bits(&MAPPING_ENTRY)
        .rule(|raw| match Entry(raw as u32) {
            Entry(0) => None,
            entry if !(1..=2).contains(&entry.words()) => Some("the length is neither 1 nor 2 words"),
            entry if entry.sets() == 0 => Some("no set is chosen"),
            entry if entry.parameter() > LAST_PARAMETER => Some("no parameter has this address"),
            _ => None,
        })
        .names(&[Name { value: 0, label: SECOND_HALF, note: "" }])
        .note(
            "Entry N says which parameter is behind register start + N, in which sets, and how long it \
             is. 32 bits in one address: only functions 100 and 101 reach it.",
        )
        .source(SOURCE)
}

/// The last parameter address that fits below the operator's registers: 5EFFh less 2000h.
const LAST_PARAMETER: u16 = 0x3EFF;

static MAPPING_ENTRY: [Bits; 10] = {
    let length = Bits::part(0, 8, "length", "length")
        .names(&[
            Name { value: 0, label: SECOND_HALF, note: "" },
            Name { value: 1, label: "16 bit", note: "" },
            Name { value: 2, label: "32 bit", note: "Takes this entry and the next one, which is all 0." },
        ])
        .note("How many 16-bit words the parameter has.");
    let [set_0, set_1, set_2, set_3, set_4, set_5, set_6, set_7] = keb_f5::sets(8);
    let parameter = Bits::part(16, 16, "parameter", "parameter")
        .format(Format::Hex)
        .note("The parameter's address in the inverter, without the 2000h of its register.");
    [length, set_0, set_1, set_2, set_3, set_4, set_5, set_6, set_7, parameter]
};

/// What gives the mapped registers their meaning.
static LESSONS: &[Lesson] = &[
    Lesson {
        from: 0x5F02,
        count: 1,
        learn: |_, _, value, settings| settings.read_mapping.start = value as u16,
    },
    Lesson {
        from: 0x5F03,
        count: 1,
        learn: |_, _, value, settings| settings.write_mapping.start = value as u16,
    },
    Lesson {
        from: 0x5F32,
        count: 100,
        learn: |n, _, value, settings| settings.read_mapping.set(n, Entry(value)),
    },
    Lesson {
        from: 0x5F96,
        count: 100,
        learn: |n, _, value, settings| settings.write_mapping.set(n, Entry(value)),
    },
];

static PARAMETERS: &[Parameter] = &[
    operator(
        0x5F00,
        "FB.00",
        Spec::new("mdb_prot_cfg", "MDB_ProtCfg")
            .bits(&[
                Bits::reserved(0, 5),
                Bits::part(5, 2, "character", "character format").names(&[
                    Name { value: 0, label: "8N2", note: "8 data bits, no parity, 2 stop bits." },
                    Name { value: 1, label: "8O1", note: "8 data bits, odd parity, 1 stop bit." },
                    Name { value: 2, label: "8E1", note: "8 data bits, even parity, 1 stop bit." },
                ]),
                Bits::part(7, 1, "protocol", "protocol").names(&[
                    Name { value: 0, label: "ASCII", note: "The operator does not offer it yet." },
                    Name { value: 1, label: "RTU", note: "" },
                ]),
            ])
            .rule(|raw| match (raw >> 7 & 1, raw >> 5 & 3) {
                (0, _) => Some("ASCII cannot be chosen yet"),
                (_, 3) => Some("this character format is not defined"),
                _ => None,
            })
            .note("Protocol and character format of the Modbus line; C0h as delivered."),
    )
    .length(1),
    operator(
        0x5F01,
        "FB.01",
        Spec::new("mdb_slave_addr_op", "MDB_SlaveAddr_OP")
            .rule(|raw| (!matches!(raw, 1..=247 | 255)).then_some("1 to 247 are allowed, and 255"))
            .names(&[Name { value: 255, label: "taken from Sy.06", note: "If Sy.06 is 0, Modbus is off." }])
            .note("The operator's address on the line, 1 to 247; 255, as delivered, leaves it to Sy.06."),
    )
    .length(1),
    operator(
        0x5F02,
        "FB.02",
        Spec::new("mdb_map_start_addr_rd", "MDB_MapStartAddr_Rd")
            .format(Format::HexAddress)
            .limits(0, 0x1FFF)
            .note("The register behind which entry 0 of the read mapping list is; 0 as delivered."),
    )
    .length(2),
    operator(
        0x5F03,
        "FB.03",
        Spec::new("mdb_map_start_addr_wr", "MDB_MapStartAddr_Wr")
            .format(Format::HexAddress)
            .limits(0, 0x1FFF)
            .note("The register behind which entry 0 of the write mapping list is; 0 as delivered."),
    )
    .length(2),
    operator(
        0x5F04,
        "FB.04",
        Spec::new("mdb_map_nr_rd", "MDB_MapNr_Rd")
            .limits(0, 100)
            .note("How many entries of the read mapping list are in use; 2 as delivered."),
    )
    .length(1),
    operator(
        0x5F05,
        "FB.05",
        Spec::new("mdb_map_nr_wr", "MDB_MapNr_Wr")
            .limits(0, 100)
            .note("How many entries of the write mapping list are in use; 2 as delivered."),
    )
    .length(1),
    operator(
        0x5F06,
        "FB.06",
        Spec::new("watchdog_inhibit", "Watchdog_Inhibit")
            .bits(&[
                Bits::flag(0, "any_telegram", "any good telegram"),
                Bits::flag(1, "own_telegram", "any good telegram for this inverter").note(WITH_BROADCASTS),
            ])
            .note("What resets the watchdog of the bus; 01h as delivered. Pn.06 is its time."),
    )
    .length(1),
    operator(
        0x5F07,
        "FB.07",
        Spec::new("watchdog_activation", "Watchdog_Activation")
            .bits(&[
                Bits::flag(0, "any_telegram", "first telegram of any kind"),
                Bits::flag(1, "own_telegram", "first good telegram for this inverter").note(WITH_BROADCASTS),
            ])
            .note(
                "What starts the watchdog of the bus; 01h as delivered. Pn.05 says what happens when it \
                 runs out.",
            ),
    )
    .length(1),
    operator(
        0x5F31,
        "FB.08",
        Spec::new("mdb_command", "MDB_Command")
            .bits(keb_f5::COMMAND)
            .note("Has the operator do something; it sets bit 15 once that is done."),
    )
    .length(2),
];

const fn operator(register: u16, id: &'static str, spec: Spec) -> Parameter {
    Parameter::new(register, id, spec.source(SOURCE))
}

const SECOND_HALF: &str = "empty, or second half of a 32-bit entry";

const WITH_BROADCASTS: &str = "Broadcasts count, too.";

const SOURCE: &str = "KEB COMBIVERT F5 Modbus operator, 3";
