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

use super::keb_f5::kept;
use super::{
    Access, Alias, Area, Content, Entry, Lesson, Mapping, Parameter, Profile, Registers, Said, Settings,
    Taught, keb_f5,
};
use crate::field::{Argument, Bits, Format, Name, Problem, Spec};
use crate::message;

pub static PROFILE: Profile = Profile {
    key: "keb-f5-modbus",
    label: "KEB COMBIVERT F5 on Modbus",
    source: "KEB COMBIVERT F5 Modbus operator",
    functions: &[3, 4, 6, 16, 100, 101],
    hex_addresses: true,
    areas: AREAS,
    parameters: &[keb_f5::INVERTER_PARAMETERS, PARAMETERS],
    lessons: LESSONS,
    rules: &[entries],
    common_exceptions: &[1, 2, 3, 4, 5, 6],
    exceptions: Some(&keb_f5::EXCEPTIONS),
    aliases: ALIASES,
    ..Profile::BLANK
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
    Area::new(0x5F00, OPERATOR_PARAMETER).blocks(0x32, 1, 0x5F00).listed(),
    Area::new(READ_LIST, READ_ENTRY)
        .blocks(ENTRIES, 1, 0)
        .length(4)
        .completed(with_second_halves)
        .also("MDB_Mapping_Rd_N read map"),
    Area::new(WRITE_LIST, WRITE_ENTRY)
        .blocks(ENTRIES, 1, 0)
        .length(4)
        .completed(with_second_halves)
        .also("MDB_Mapping_Wr_N write map"),
    Area::new(0x5FFA, OPERATOR_PARAMETER).blocks(6, 1, 0x5FFA).listed(),
];

/// Where the mapping lists are.
const READ_LIST: u16 = 0x5F32;
const WRITE_LIST: u16 = 0x5F96;
const ENTRIES: u16 = 100;

const READ_ENTRY: Spec = mapping_entry("read_mapping_entry", "Read-mapping entry").note(
    "Entry N says which parameter is behind register start + N of what is read, in which sets, and how long \
     it is. 32 bits in one address: only functions 100 and 101 reach it. COMBIVIS chooses N by \
     MDB_Read_MapIndex (0289h, fb.09) and has the entry in MDB_Read_Mapping (028Ah, fb.10).",
);

const WRITE_ENTRY: Spec = mapping_entry("write_mapping_entry", "Write-mapping entry").initial(0x0032_0101).note(
    "Entry N says which parameter is behind register start + N of what is written, in which sets, and how \
     long it is. 32 bits in one address: only functions 100 and 101 reach it. COMBIVIS chooses N by \
     MDB_Write_MapIndex (028Bh, fb.11) and has the entry in MDB_Write_Mapping (028Ch, fb.12).",
);

/// Behind each entry of 32 bits an empty one, its second half.
fn with_second_halves(values: &[u8]) -> Vec<u8> {
    let mut whole = Vec::new();
    let mut entries = values.chunks(4).peekable();
    while let Some(entry) = entries.next() {
        whole.extend_from_slice(entry);
        if entry.last() == Some(&2) {
            entries.next_if(|next| next.iter().all(|byte| *byte == 0));
            whole.extend_from_slice(&[0; 4]);
        }
    }
    whole
}

/// What the manual asks of mapping entries that are written.
fn entries(profile: &'static Profile, registers: &Registers<'_>, settings: &Settings, said: &mut Said) {
    let (Some(values), 4, Access::Write) = (registers.values, registers.width, registers.access) else {
        return;
    };
    let mut say = |code, message| said.problems.push(Problem::error(code, registers.span, message));
    for (address, value) in (registers.start..=u16::MAX).zip(values.chunks_exact(4)) {
        let (from, known, reads) = match address {
            READ_LIST..WRITE_LIST => (READ_LIST, &settings.read_mapping, true),
            WRITE_LIST..0x5FFA => (WRITE_LIST, &settings.write_mapping, false),
            _ => continue,
        };
        let n = usize::from(address - from);
        let entry = Entry(value.iter().fold(0, |raw, byte| raw << 8 | u32::from(*byte)));
        let parameter = profile.named(keb_f5::inverter_address(entry.parameter()), None);
        if entry.words() == 2 {
            let next = values.chunks_exact(4).nth(usize::from(address - registers.start) + 1);
            let next = match next {
                Some(next) => next.iter().any(|byte| *byte != 0),
                None => known.entries.get(n + 1).is_some_and(|next| next.0 != 0),
            };
            if n + 1 == usize::from(ENTRIES) {
                say(
                    "no-second-entry",
                    message!("entry {n} is the last: there is no room for the second half of 32 bits", n = n),
                );
            } else if next {
                say(
                    "second-entry",
                    message!(
                        "entry {n} has 32 bits: entry {next}, its second half, must be 0",
                        n = n,
                        next = n + 1
                    ),
                );
            }
        }
        let Some(parameter) = parameter.filter(|_| entry.0 != 0) else { continue };
        let label = Argument::Term(parameter.spec.label);
        if let (1, Some(4)) = (entry.words(), parameter.length) {
            say(
                "entry-too-short",
                message!("{label} has 32 bits, entry {n} maps 16 of them", label = label.clone(), n = n),
            );
        }
        if !reads && parameter.access == Access::Read {
            say(
                "read-only",
                message!("{label} can only be read: writing by entry {n} is rejected", label = label, n = n),
            );
        }
    }
}

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
        .refers(|raw| {
            let parameter = Entry(raw as u32).parameter();
            (raw != 0 && parameter <= LAST_PARAMETER).then(|| keb_f5::inverter_address(parameter))
        })
        .initial(0x0033_0101)
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
    lesson(0x5F02, 1, |taught, settings| settings.read_mapping.start = taught.value as u16),
    lesson(0x5F03, 1, |taught, settings| settings.write_mapping.start = taught.value as u16),
    lesson(0x5F04, 1, |taught, settings| settings.read_mapping.used = Some(taught.value as usize)),
    lesson(0x5F05, 1, |taught, settings| settings.write_mapping.used = Some(taught.value as usize)),
    Lesson {
        read: false,
        ..lesson(0x5F31, 1, |taught, settings| {
            if taught.value == RESET {
                let as_delivered = Mapping { used: Some(2), ..Mapping::default() };
                settings.read_mapping.clone_from(&as_delivered);
                settings.write_mapping = as_delivered;
            }
        })
    },
    lesson(READ_LIST, ENTRIES, |taught, settings| settings.read_mapping.set(taught.n, Entry(taught.value))),
    lesson(WRITE_LIST, ENTRIES, |taught, settings| settings.write_mapping.set(taught.n, Entry(taught.value))),
];

const fn lesson(from: u16, count: u16, learn: fn(&Taught, &mut Settings)) -> Lesson {
    Lesson { from, count, read: true, learn }
}

/// The command to load the factory settings.
const RESET: u32 = 1;

/// The addresses of COMBIVIS (section 4.1).
static ALIASES: &[Alias] = &[
    combivis(0x5F00, 0x0280),
    combivis(0x5F01, 0x0281),
    combivis(0x5F02, 0x0282),
    combivis(0x5F03, 0x0283),
    combivis(0x5F04, 0x0284),
    combivis(0x5F05, 0x0285),
    combivis(0x5F06, 0x0286),
    combivis(0x5F07, 0x0287),
    combivis(0x5F31, 0x0288),
    combivis(READ_LIST, 0x028A),
    combivis(WRITE_LIST, 0x028C),
    combivis(0x2180, 0x0180),
    combivis(0x2182, 0x0182),
    combivis(0x2183, 0x0183),
    combivis(0x2184, 0x0184),
    combivis(0x2185, 0x0185),
    combivis(0x2186, 0x0186),
    combivis(0x2187, 0x0187),
];

const fn combivis(address: u16, new: u16) -> Alias {
    Alias { address, subindex: 0, new: Some(new), old: None }
}

/// What the operator has besides, which only the diagnosis interface reaches.
const fn elsewhere(address: u16, id: &'static str, spec: Spec) -> Parameter {
    Parameter::new(address, id, spec.source(SOURCE)).access(Access::Elsewhere)
}

static PARAMETERS: &[Parameter] = &[
    elsewhere(
        0x2180,
        "OS.00",
        Spec::new("operator_type", "Operator Type")
            .names(&[Name { value: 10310, label: "Modbus operator with diagnosis interface", note: "" }])
            .note("KEB's own number for the kind of operator."),
    )
    .length(2),
    elsewhere(
        0x2182,
        "OS.02",
        Spec::new("software_date", "Software date")
            .format(Format::DayMonthYear)
            .note("The day of the operator's software."),
    )
    .length(2),
    elsewhere(
        0x2183,
        "OS.03",
        Spec::new("diag_error_counter", "Diag Error Counter")
            .note("How many errors the diagnosis interface has seen."),
    )
    .length(2),
    elsewhere(
        0x2184,
        "OS.04",
        Spec::new("diag_rsp_delay_time", "DiagRsp.DelayTime")
            .unit("ms")
            .note(kept!("How long the diagnosis interface waits before it answers.")),
    )
    .length(1),
    elsewhere(
        0x2185,
        "OS.05",
        Spec::new("diag_baudrate", "Diag Baudrate")
            .names(keb_f5::BAUD_RATES)
            .only_named()
            .note("How fast the diagnosis interface is. To be read only."),
    )
    .length(1),
    elsewhere(
        0x2186,
        "OS.06",
        Spec::new("hsp5_max_inv_busy_retries", "HSP5_Max_InvBusy_Retries")
            .note(kept!("How often the operator repeats what the inverter was too busy for.")),
    )
    .length(1),
    elsewhere(
        0x2187,
        "OS.07",
        Spec::new("hsp5_tout_count", "HSP5 Tout Cnt")
            .note("How often the inverter did not answer the operator in time."),
    )
    .length(2),
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
            .initial(0xC0)
            .note(kept!(
                "Protocol and character format of the Modbus line; factory setting C0h. The next telegram \
                 already has to come in the new format."
            )),
    )
    .length(1),
    operator(
        0x5F01,
        "FB.01",
        Spec::new("mdb_slave_addr_op", "MDB_SlaveAddr_OP")
            .rule(|raw| (!matches!(raw, 1..=247 | 255)).then_some("1 to 247 are allowed, and 255"))
            .names(&[Name { value: 255, label: "taken from Sy.06", note: "If Sy.06 is 0, Modbus is off." }])
            .initial(255)
            .note(kept!(
                "The operator's address on the line, 1 to 247; 255, the factory setting, leaves it to Sy.06."
            )),
    )
    .length(1),
    operator(
        0x5F02,
        "FB.02",
        Spec::new("mdb_map_start_addr_rd", "MDB_MapStartAddr_Rd")
            .format(Format::HexAddress)
            .limits(0, 0x1FFF)
            .note(kept!("The register behind which entry 0 of the read mapping list is; factory setting 0.")),
    )
    .length(2),
    operator(
        0x5F03,
        "FB.03",
        Spec::new("mdb_map_start_addr_wr", "MDB_MapStartAddr_Wr")
            .format(Format::HexAddress)
            .limits(0, 0x1FFF)
            .note(kept!(
                "The register behind which entry 0 of the write mapping list is; factory setting 0."
            )),
    )
    .length(2),
    operator(
        0x5F04,
        "FB.04",
        Spec::new("mdb_map_nr_rd", "MDB_MapNr_Rd")
            .limits(0, 100)
            .initial(2)
            .note(kept!("How many entries of the read mapping list are in use; factory setting 2.")),
    )
    .length(1),
    operator(
        0x5F05,
        "FB.05",
        Spec::new("mdb_map_nr_wr", "MDB_MapNr_Wr")
            .limits(0, 100)
            .initial(2)
            .note(kept!("How many entries of the write mapping list are in use; factory setting 2.")),
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
            .only_named()
            .initial(1)
            .note(kept!("What resets the watchdog of the bus; factory setting 01h. Pn.06 is its time.")),
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
            .only_named()
            .initial(1)
            .note(kept!(
                "What starts the watchdog of the bus; factory setting 01h. Pn.05 says what happens when it \
                 runs out."
            )),
    )
    .length(1),
    operator(
        0x5F31,
        "FB.08",
        Spec::new("mdb_command", "MDB_Command")
            .bits(keb_f5::COMMAND)
            .only_named()
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
