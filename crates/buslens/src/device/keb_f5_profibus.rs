//! KEB COMBIVERT F5 on PROFIBUS-DP: what its parameter channel reaches by index and subindex.
//!
//! | indices | what is there |
//! | --- | --- |
//! | 2000h to 5EFFh | inverter parameters and, in between, operator parameters: their address + 2000h |
//! | 5F00h to 5FFFh | how the operator is set up |
//! | 6000h to FFFFh | coded as the DRIVECOM profile says: process data descriptions |
//!
//! The subindex of an inverter parameter is a set mask ([`keb_f5::sets`]); 0 is the set that Fr.09
//! chooses. A value has 1 to 4 bytes; read values always come as 4, the number in the last ones.
//!
//! A process data description says for each 16-bit word which parameter it carries: its index and
//! its set mask, then the same again for the word's second byte, always 0.
//!
//! Source: KEB COMBIVERT F5 PROFIBUS-DP operator manual (20114545), sections 9, 10.2, 12.1, 12.2.

use super::keb_f5::kept;
use super::{Access, Alias, Area, Display, Lesson, Parameter, Profile, Settings, keb_f5};
use crate::field::{Bits, Format, Name, Range, Spec};

pub static PROFILE: Profile = Profile {
    key: "keb-f5-profibus",
    label: "KEB COMBIVERT F5 on PROFIBUS-DP",
    source: "KEB COMBIVERT F5 PROFIBUS-DP operator",
    ident: Some(0x05EB),
    hex_addresses: true,
    areas: AREAS,
    parameters: &[keb_f5::INVERTER_PARAMETERS, PARAMETERS],
    display: DISPLAY,
    lessons: LESSONS,
    aliases: ALIASES,
    ..Profile::BLANK
};

/// The process data descriptions, which give process data words their meaning, and what puts them back.
static LESSONS: &[Lesson] = &[
    Lesson {
        from: 0x5FD9,
        count: 1,
        read: false,
        learn: |taught, settings| {
            if taught.value == RESET {
                load_factory_settings(settings);
            }
        },
    },
    Lesson {
        from: 0x5FE2,
        count: 1,
        read: true,
        learn: |taught, settings| {
            if taught.value != STORED {
                load_factory_settings(settings);
            }
        },
    },
    Lesson {
        from: 0x6000,
        count: 1,
        read: true,
        learn: |taught, settings| keb_f5::describe(&mut settings.process_input, taught),
    },
    Lesson {
        from: 0x6001,
        count: 1,
        read: true,
        learn: |taught, settings| keb_f5::describe(&mut settings.process_output, taught),
    },
];

/// The command to load the factory settings, and the value by which stored descriptions count.
const RESET: u32 = 1;
const STORED: u32 = 0xFF;

fn load_factory_settings(settings: &mut Settings) {
    settings.process_output = keb_f5::STANDARD_OUTPUT.to_vec();
    settings.process_input = keb_f5::STANDARD_INPUT.to_vec();
}

static AREAS: &[Area] = &[
    keb_f5::inverter_parameters(
        "A parameter of the inverter: index less 2000h is its address. The subindex says in which sets; \
         0 is the set that Fr.09 chooses.",
        INDICES,
    )
    .between(keb_f5::is_operators, &OPERATORS_IN_GROUP),
    Area::new(
        0x5F00,
        Spec::new("operator_parameter", "Operator parameter")
            .format(Format::Register)
            .hex_numbers()
            .note("How the operator, the inverter's bus module, is set up.")
            .source(INDICES),
    )
    .blocks(0x100, 1, 0x5F00)
    .listed(),
    Area::new(
        0x6000,
        Spec::new("drivecom_parameter", "DRIVECOM parameter")
            .format(Format::Register)
            .hex_numbers()
            .note("Coded as the DRIVECOM profile says, such as what the process data carry.")
            .source(INDICES),
    )
    .blocks(0xA000, 1, 0x6000)
    .listed(),
];

/// What the operator has in the groups of the inverter's parameters: from XX80h on.
static OPERATORS_IN_GROUP: Spec = Spec::new("operator_parameter_in_group", "Operator parameter")
    .format(Format::Register)
    .hex_numbers()
    .note(
        "A parameter of the operator: in each group of parameters the addresses XX80h to XXFEh are its own.",
    )
    .source("KEB COMBIVERT F5 PROFIBUS-DP operator, 10.2");

/// One bit for each of several numbered things: `bit: number`.
macro_rules! flags {
    ($what:literal $($bit:literal: $number:literal),+) => {
        &[$(Bits::flag($bit, concat!($what, "_", $number), concat!($what, " ", $number))),+]
    };
}

/// The parameters given, and behind them the process data descriptions, whose words differ in their
/// numbers only.
macro_rules! with_descriptions {
    ($($parameter:expr),* $(,)?) => {
        words! {
            [$($parameter),*]
            0x6000 "input" "PD_In":
                1 "Fb01" "Fb05" "", 2 "Fb02" "Fb06" "", 3 "Fb03" "Fb07" "", 4 "Fb04" "Fb08" "",
                5 "Fb44" "Fb48" "1.6", 6 "Fb45" "Fb49" "1.6", 7 "Fb46" "Fb50" "1.6", 8 "Fb47" "Fb51" "1.6";
            0x6001 "output" "PD_Out":
                1 "Fb13" "Fb17" "", 2 "Fb14" "Fb18" "", 3 "Fb15" "Fb19" "", 4 "Fb16" "Fb20" "",
                5 "Fb54" "Fb58" "1.6", 6 "Fb55" "Fb59" "1.6", 7 "Fb56" "Fb60" "1.6", 8 "Fb57" "Fb61" "1.6";
        }
    };
}

/// Word x is at subindex 4x - 2 and the three behind it.
macro_rules! words {
    (
        [$($parameter:expr),*]
        $($index:literal $way:literal $name:literal:
            $($x:literal $index_id:literal $set_id:literal $since:literal),+;)+
    ) => {
        &[
            $($parameter,)*
            $($(
                description($index, 4 * $x - 2, $index_id, Spec {
                    key: concat!($way, "_word_", $x, "_index"),
                    ..WORD_INDEX.label(concat!($name, $x, "_Index")).initial(standard_index($index, $x))
                }).length(2).since($since),
                description($index, 4 * $x - 1, $set_id, Spec {
                    key: concat!($way, "_word_", $x, "_set"),
                    ..WORD_SET.label(concat!($name, $x, "_Set"))
                }).length(1).since($since),
                description($index, 4 * $x, "", Spec {
                    key: concat!($way, "_word_", $x, "_second_index"),
                    ..SECOND_BYTE.label(concat!($name, $x, "_Index, second byte"))
                }).length(2).since($since),
                description($index, 4 * $x + 1, "", Spec {
                    key: concat!($way, "_word_", $x, "_second_set"),
                    ..SECOND_BYTE.label(concat!($name, $x, "_Set, second byte"))
                }).length(1).since($since),
            )+)+
        ]
    };
}

static PARAMETERS: &[Parameter] = with_descriptions![
    operator(
        0x2180,
        "OS00",
        Spec::new("operator_type", "Operator type").note(
            "KEB's own number for the kind of operator. The manual marks its access WA without \
             explaining that; here it counts as read only."
        )
    )
    .length(2)
    .access(Access::Read),
    operator(
        0x2181,
        "OS01",
        Spec::new("password", "Password").note(
            "At the keyboard, 666 in ud.01 leads to the operator's parameters, and the password of the \
             application, such as 440, in os.01 back to the inverter's. The manual marks its access WA \
             without explaining that; here it counts as write only."
        )
    )
    .access(Access::Write),
    operator(
        0x2183,
        "OS03",
        Spec::new("diag_error_count", "Diag Error Count")
            .note("How many errors the diagnosis interface has seen.")
    )
    .length(2),
    operator(
        0x2184,
        "OS04",
        Spec::new("diag_response_delay_time", "Diag Response delay time")
            .unit("ms")
            .note("How long the diagnosis interface waits at least before it answers; factory setting 0.")
    )
    .length(1),
    operator(
        0x2185,
        "OS05",
        Spec::new("diag_baudrate", "Diag Baudrate")
            .names(keb_f5::BAUD_RATES)
            .only_named()
            .note("How fast the diagnosis interface is. To change it, change Sy.07.")
    )
    .length(1)
    .access(Access::Read),
    operator(
        0x2187,
        "OS07",
        Spec::new("hsp5_tout_count", "HSP5 Tout Count")
            .note("How often the inverter did not answer the operator in time; factory setting 0.")
    )
    .length(2),
    listed(
        0x2188,
        "OS08",
        "software_number",
        "Software number",
        Format::Decimal,
        "By its name: which software the operator has."
    ),
    listed(
        0x2190,
        "OS16",
        "mem_addr",
        "Mem_Addr",
        Format::Hex,
        "By its name: which memory cell Mem_Val shows."
    )
    .access(Access::ReadWrite),
    listed(
        0x2191,
        "OS17",
        "mem_val",
        "Mem_Val",
        Format::Hex,
        "By its name: what the memory cell at Mem_Addr holds."
    ),
    listed(
        0x2192,
        "OS18",
        "ee_address",
        "EE_Address",
        Format::Hex,
        "By its name: which EEPROM cell EE_Data shows."
    )
    .access(Access::ReadWrite),
    listed(
        0x2193,
        "OS19",
        "ee_data",
        "EE_Data",
        Format::Hex,
        "By its name: what the EEPROM cell at EE_Address holds."
    ),
    listed(
        0x2194,
        "OS20",
        "fatal_error_cnt_index",
        "FatalErrorCnt_Index",
        Format::Decimal,
        "By its name: which counter FatalErrorCnt_Value shows."
    )
    .access(Access::ReadWrite),
    listed(
        0x2195,
        "OS21",
        "fatal_error_cnt_value",
        "FatalErrorCnt_Value",
        Format::Decimal,
        "By its name: how often one fatal error has come up."
    ),
    operator(
        0x2196,
        "HSP5CommMode",
        Spec::new("hsp5_comm_mode", "Communication mode")
            .bits(&[Bits::part(2, 1, "mode", "mode").names(&[
                Name { value: 0, label: "normal", note: "" },
                Name { value: 1, label: "cyclic", note: "Telegrams go out at fixed times; see SelComCycle." },
            ])])
            .note("How operator and inverter talk at present. Only bit 2 matters.")
    )
    .length(1)
    .access(Access::Read)
    .since("1.7"),
    operator(
        0x2197,
        "FU_HSP5Supp7",
        Spec::new("fu_hsp5_supp7", "Services for writing")
            .bits(SERVICES)
            .note("Which services the inverter takes for writing. Cyclic mode needs 54 and 55.")
    )
    .length(2)
    .access(Access::Read)
    .since("1.7"),
    operator(
        0x2198,
        "SelComCycle",
        Spec::new("sel_com_cycle", "Selected telegram cycle").unit("µs")
            .names(NO_CYCLE)
            .rule(|raw| (!raw.is_multiple_of(1000)).then_some("only multiples of 1000 µs are possible"))
            .note(kept!(
                "The time from telegram to telegram in cyclic mode, in steps of 1000; factory setting 0. Best is \
                 1000 or 2000. All process data take two telegrams: their cycle is 2 × SelComCycle, 2 ms at \
                 least."
            ))
    )
    .length(4)
    .since("1.7"),
    operator(
        0x2199,
        "ComCycle",
        Spec::new("com_cycle", "Actual telegram cycle").unit("µs").names(NO_CYCLE).note(
            "The time from telegram to telegram as it is; factory setting 0. It stays 0 where the inverter lacks cyclic \
             mode (see FU_HSP5Supp7) or there is no data exchange."
        )
    )
    .length(4)
    .access(Access::Read)
    .since("1.7"),
    listed(
        0x228B,
        "Fb11",
        "pdin_hsp5_service",
        "PDIN_HSP5Service",
        Format::Decimal,
        "By its name: the service that fetches process input data."
    ),
    listed(
        0x2296,
        "Fb22",
        "pdout_hsp5_service",
        "PDOUT_HSP5Service",
        Format::Decimal,
        "By its name: the service that takes process output data."
    )
    .length(1),
    process_data(0x2298, "Fb24", "process_data_in_1", "ProcessData In1"),
    process_data(0x2299, "Fb25", "process_data_in_2", "ProcessData In2"),
    process_data(0x229A, "Fb26", "process_data_in_3", "ProcessData In3"),
    process_data(0x229B, "Fb27", "process_data_in_4", "ProcessData In4"),
    process_data(0x229C, "Fb28", "process_data_out_1", "ProcessData Out1"),
    process_data(0x229D, "Fb29", "process_data_out_2", "ProcessData Out2"),
    process_data(0x229E, "Fb30", "process_data_out_3", "ProcessData Out3"),
    process_data(0x229F, "Fb31", "process_data_out_4", "ProcessData Out4"),
    listed(
        0x22A0,
        "Fb32",
        "check_pd_setting",
        "Check PD Setting",
        Format::Decimal,
        "By its name: whether the process data are set up well."
    ),
    listed(
        0x22A1,
        "Fb33",
        "cfg_len",
        "CFG_Len",
        Format::Decimal,
        "By its name: how many configuration bytes there are."
    ),
    listed(0x22A2, "Fb34", "cfg_data_1", "CFG_Data1", Format::Hex, "By its name: configuration byte 1."),
    listed(0x22A3, "Fb35", "cfg_data_2", "CFG_Data2", Format::Hex, "By its name: configuration byte 2."),
    listed(0x22A4, "Fb36", "cfg_data_3", "CFG_Data3", Format::Hex, "By its name: configuration byte 3."),
    listed(
        0x22A5,
        "Fb37",
        "master_pdin_len",
        "Master_PDIN_Len",
        Format::Decimal,
        "By its name: how many bytes of process input data the master set."
    ),
    listed(
        0x22A6,
        "Fb38",
        "master_pdout_len",
        "Master_PDOUT_Len",
        Format::Decimal,
        "By its name: how many bytes of process output data the master set."
    ),
    listed(
        0x22B5,
        "Fb53",
        "pdin2_hsp5_service",
        "PDIN2_HSP5Service",
        Format::Decimal,
        "By its name: the service that fetches process input bytes 9 to 16."
    ),
    listed(
        0x22BF,
        "Fb63",
        "pdout2_hsp5_service",
        "PDOUT2_HSP5Service",
        Format::Decimal,
        "By its name: the service that takes process output bytes 9 to 16."
    ),
    process_data(0x22C0, "Fb64", "process_data_in_5", "ProcessData In5"),
    process_data(0x22C1, "Fb65", "process_data_in_6", "ProcessData In6"),
    process_data(0x22C2, "Fb66", "process_data_in_7", "ProcessData In7"),
    process_data(0x22C3, "Fb67", "process_data_in_8", "ProcessData In8"),
    process_data(0x22C4, "Fb68", "process_data_out_5", "ProcessData Out5"),
    process_data(0x22C5, "Fb69", "process_data_out_6", "ProcessData Out6"),
    process_data(0x22C6, "Fb70", "process_data_out_7", "ProcessData Out7"),
    process_data(0x22C7, "Fb71", "process_data_out_8", "ProcessData Out8"),
    operator(
        0x5FD8,
        "Fb42",
        Spec::new("pdout_take_mode", "PDOUT TakeMode")
            .names(&[
                Name { value: 0, label: "always", note: "" },
                Name { value: 240, label: "unless all bytes are 0", note: "" },
                Name { value: 241, label: "unless all bytes are 0, and during data exchange only", note: "" },
            ])
            .ranges(&[
                Range { from: 1, to: 239, label: "during data exchange only" },
                Range { from: 242, to: 255, label: "during data exchange only" },
            ])
            .note(kept!(
                "When process output data are passed on to the inverter, so that it need not take the \
                 zeros of a bus that stopped; factory setting 0."
            ))
    )
    .length(1),
    operator(
        0x5FD9,
        "Fb41",
        Spec::new("fbs_command", "FBS Command")
            .bits(keb_f5::COMMAND)
            .only_named()
            .note("Has the operator do something; it sets bit 15 once that is done. Factory setting 0.")
    )
    .length(2)
    .since("1.5"),
    operator(
        0x5FDA,
        "Fb39",
        Spec::new("watchdog_activation", "Watchdog activation")
            .bits(&[
                Bits::flag(0, "process_output", "first process output data written to the inverter"),
                Bits::flag(1, "parameter_job", "first job of the parameter channel"),
            ])
            .names(&[Name { value: 0, label: "power on", note: "" }])
            .only_named()
            .note(kept!("What starts the watchdog of the bus; factory setting 0. See Watchdog Inhibit, too."))
    )
    .length(1)
    .since("1.5"),
    operator(
        0x5FE1,
        "OS06",
        Spec::new("hsp5_max_inv_busy_retries", "HSP5 Max InvBusy retries").note(
            "How often the operator repeats what the inverter was too busy for, before it reports \
             that; factory setting 0."
        )
    )
    .length(1),
    operator(
        0x5FE2,
        "Fb23",
        Spec::new("take_stored_pd_map", "Take Stored PD-Map")
            .format(Format::Hex)
            .names(&[
                Name { value: 0, label: "standard", note: "As any value but FFh." },
                Name { value: 0xFF, label: "stored", note: "" },
            ])
            .ranges(&[Range { from: 1, to: 254, label: "standard" }])
            .initial(0xFF)
            .note(kept!(
                "Which process data descriptions count; factory setting FFh. Section 9.1 calls it PD_Stored."
            ))
    )
    .length(1)
    .also("PD_Stored"),
    operator(
        0x5FF0,
        "SW_Version",
        Spec::new("sw_version", "Software version")
            .format(Format::Places(1))
            .note("The version of the operator's software.")
    )
    .length(2)
    .access(Access::Read),
    operator(
        0x5FF1,
        "SW_Date",
        Spec::new("sw_date", "Software date")
            .format(Format::DayMonthYear)
            .note("The day of the operator's software: day, month, last digit of the year.")
    )
    .length(2)
    .access(Access::Read),
    operator(
        0x5FF4,
        "Fb43",
        Spec::new("value_swapping", "ValueSwapping")
            .bits(&[
                Bits::flag(0, "process_data", "16- and 32-bit process data low byte first"),
                Bits::flag(
                    1,
                    "parameter_channel",
                    "index and 32-bit value of the parameter channel low byte first"
                ),
            ])
            .only_named()
            .note(
                "Which values come low byte first; factory setting 0. Kept at once, but in force only after \
                 the next switching on."
            )
    )
    .length(1)
    .since("1.5"),
    operator(
        0x5FF5,
        "Fb62",
        Spec::new("pd_out2_enable", "PD_Out2_Enable")
            .bits(BYTES_9_TO_16)
            .note(kept!(
                "Which of the bytes 9 to 16 of process output data are in use; factory setting 0. They go in a \
                 telegram of their own, which halves the rate of process data."
            ))
    )
    .length(1)
    .since("1.6"),
    operator(
        0x5FF6,
        "Fb52",
        Spec::new("pd_in2_enable", "PD_In2_Enable")
            .bits(BYTES_9_TO_16)
            .note(kept!(
                "Which of the bytes 9 to 16 of process input data are in use; factory setting 0. They go in a \
                 telegram of their own, which halves the rate of process data."
            ))
    )
    .length(1)
    .since("1.6"),
    operator(
        0x5FF8,
        "Fb10",
        Spec::new("pd_in_enable", "PD_In_Enable").bits(BYTES_1_TO_8).initial(0x0F).note(
            "Which of the bytes 1 to 8 of process input data are in use; factory setting 0Fh. The \
             description goes to the inverter; if that refuses it, all stay off. Section 9.1 calls it \
             PE_Enabled, too."
        )
    )
    .length(1)
    .also("PE_Enabled"),
    operator(
        0x5FF9,
        "Fb40",
        Spec::new("watchdog_inhibit", "Watchdog Inhibit")
            .bits(&[
                Bits::flag(0, "process_output", "process output data to the inverter"),
                Bits::flag(1, "parameter_job", "start of a parameter channel job"),
                Bits::flag(2, "data_exchange", "data exchange"),
            ])
            .only_named()
            .initial(7)
            .note(kept!(
                "What resets the watchdog of the bus; factory setting 07h. The watchdog itself is set in the \
                 inverter."
            ))
    )
    .length(1),
    operator(
        0x5FFA,
        "Fb09",
        Spec::new("pd_in_cycle", "PD_In_Cycle").unit("ms").initial(25).note(kept!(
            "How often the process input data are fetched from the inverter; factory setting 25 ms. With more \
             than 8 bytes the second part is fetched directly after the first. Section 9.1 calls it \
             PE_Cycle, too."
        ))
    )
    .length(2)
    .also("PE_Cycle"),
    description(
        0x6000,
        1,
        "Fb00",
        Spec::new("pd_in_length", "PD_In_Length").unit("bytes").limits(0, 16).initial(4).note(
            "How many bytes of process input data there are; factory setting 4. Writing it switches them \
             off."
        )
    )
    .length(1),
    description(
        0x6001,
        1,
        "Fb12",
        Spec::new("pd_out_length", "PD_Out_Length").unit("bytes").limits(0, 16).initial(4).note(
            "How many bytes of process output data there are; factory setting 4. Writing it switches them \
             off."
        )
    )
    .length(1),
    operator(
        0x6002,
        "Fb21",
        Spec::new("pd_out_enable", "PD_Out_Enable").bits(BYTES_1_TO_8).initial(0x0F).note(
            "Which of the bytes 1 to 8 of process output data are in use; factory setting 0Fh. The \
             description goes to the inverter; if that refuses it, all stay off. Outputs go on to the \
             inverter only when they change."
        )
    )
    .length(1),
];

/// What 9.1 describes.
const fn operator(index: u16, id: &'static str, spec: Spec) -> Parameter {
    Parameter::new(index, id, spec.source(SOURCE)).subindex(0)
}

/// What 12.1 lists and nothing describes: for the maker's diagnosis.
const fn listed(
    index: u16,
    id: &'static str,
    key: &'static str,
    label: &'static str,
    format: Format,
    note: &'static str,
) -> Parameter {
    Parameter::new(index, id, Spec::new(key, label).format(format).note(note).source(LIST))
        .subindex(0)
        .access(Access::Read)
}

const fn process_data(index: u16, id: &'static str, key: &'static str, label: &'static str) -> Parameter {
    listed(index, id, key, label, Format::Register, "By its name: this word of process data at present.")
}

/// A part of a process data description.
const fn description(index: u16, subindex: u8, id: &'static str, spec: Spec) -> Parameter {
    Parameter::new(index, id, spec.source(DESCRIPTIONS)).subindex(subindex)
}

/// Which parameter a word carries by the factory setting; 0 where it carries none.
const fn standard_index(description: u16, word: usize) -> u64 {
    let words = if description == 0x6000 { keb_f5::STANDARD_INPUT } else { keb_f5::STANDARD_OUTPUT };
    if word <= words.len() { words[word - 1].index as u64 } else { 0 }
}

/// The addresses of COMBIVIS (section 12.1): new, and before software 1.5.
static ALIASES: &[Alias] = &[
    combivis(0x2180, 0, Some(0x0180), None),
    combivis(0x2181, 0, Some(0x0181), None),
    combivis(0x2183, 0, Some(0x0183), None),
    combivis(0x2184, 0, Some(0x0184), Some(0x0082)),
    combivis(0x2185, 0, Some(0x0185), None),
    combivis(0x5FE1, 0, Some(0x0186), Some(0x0084)),
    combivis(0x2187, 0, Some(0x0187), Some(0x0087)),
    combivis(0x2188, 0, Some(0x0188), None),
    combivis(0x2190, 0, Some(0x0190), None),
    combivis(0x2191, 0, Some(0x0191), None),
    combivis(0x2192, 0, Some(0x0192), Some(0x00AD)),
    combivis(0x2193, 0, Some(0x0193), Some(0x00AE)),
    combivis(0x2194, 0, Some(0x0194), None),
    combivis(0x2195, 0, Some(0x0195), None),
    combivis(0x6000, 1, Some(0x0280), Some(0x0090)),
    combivis(0x6000, 2, Some(0x0281), Some(0x0091)),
    combivis(0x6000, 6, Some(0x0282), Some(0x0092)),
    combivis(0x6000, 10, Some(0x0283), Some(0x0093)),
    combivis(0x6000, 14, Some(0x0284), Some(0x0094)),
    combivis(0x6000, 3, Some(0x0285), Some(0x0095)),
    combivis(0x6000, 7, Some(0x0286), Some(0x0096)),
    combivis(0x6000, 11, Some(0x0287), Some(0x0097)),
    combivis(0x6000, 15, Some(0x0288), Some(0x0098)),
    combivis(0x5FFA, 0, Some(0x0289), Some(0x00AF)),
    combivis(0x5FF8, 0, Some(0x028A), Some(0x0099)),
    combivis(0x228B, 0, Some(0x028B), Some(0x00B7)),
    combivis(0x6001, 1, Some(0x028C), Some(0x009A)),
    combivis(0x6001, 2, Some(0x028D), Some(0x009B)),
    combivis(0x6001, 6, Some(0x028E), Some(0x009C)),
    combivis(0x6001, 10, Some(0x028F), Some(0x009D)),
    combivis(0x6001, 14, Some(0x0290), Some(0x009E)),
    combivis(0x6001, 3, Some(0x0291), Some(0x009F)),
    combivis(0x6001, 7, Some(0x0292), Some(0x00A0)),
    combivis(0x6001, 11, Some(0x0293), Some(0x00A1)),
    combivis(0x6001, 15, Some(0x0294), Some(0x00A2)),
    combivis(0x6002, 0, Some(0x0295), Some(0x00A3)),
    combivis(0x2296, 0, Some(0x0296), Some(0x00B8)),
    combivis(0x5FE2, 0, Some(0x0297), Some(0x00A4)),
    combivis(0x2298, 0, Some(0x0298), Some(0x00A5)),
    combivis(0x2299, 0, Some(0x0299), Some(0x00A6)),
    combivis(0x229A, 0, Some(0x029A), Some(0x00A7)),
    combivis(0x229B, 0, Some(0x029B), Some(0x00A8)),
    combivis(0x229C, 0, Some(0x029C), Some(0x00A9)),
    combivis(0x229D, 0, Some(0x029D), Some(0x00AA)),
    combivis(0x229E, 0, Some(0x029E), Some(0x00AB)),
    combivis(0x229F, 0, Some(0x029F), Some(0x00AC)),
    combivis(0x22A0, 0, Some(0x02A0), Some(0x00B6)),
    combivis(0x22A1, 0, Some(0x02A1), Some(0x00B0)),
    combivis(0x22A2, 0, Some(0x02A2), Some(0x00B1)),
    combivis(0x22A3, 0, Some(0x02A3), Some(0x00B2)),
    combivis(0x22A4, 0, Some(0x02A4), Some(0x00B3)),
    combivis(0x22A5, 0, Some(0x02A5), Some(0x00B5)),
    combivis(0x22A6, 0, Some(0x02A6), Some(0x00B4)),
    combivis(0x5FDA, 0, Some(0x02A7), Some(0x00FC)),
    combivis(0x5FF9, 0, Some(0x02A8), Some(0x008E)),
    combivis(0x5FD9, 0, Some(0x02A9), None),
    combivis(0x5FD8, 0, Some(0x02AA), None),
    combivis(0x5FF4, 0, Some(0x02AB), None),
    combivis(0x6000, 18, Some(0x02AC), None),
    combivis(0x6000, 22, Some(0x02AD), None),
    combivis(0x6000, 26, Some(0x02AE), None),
    combivis(0x6000, 30, Some(0x02AF), None),
    combivis(0x6000, 19, Some(0x02B0), None),
    combivis(0x6000, 23, Some(0x02B1), None),
    combivis(0x6000, 27, Some(0x02B2), None),
    combivis(0x6000, 31, Some(0x02B3), None),
    combivis(0x5FF6, 0, Some(0x02B4), None),
    combivis(0x22B5, 0, Some(0x02B5), None),
    combivis(0x6001, 18, Some(0x02B6), None),
    combivis(0x6001, 22, Some(0x02B7), None),
    combivis(0x6001, 26, Some(0x02B8), None),
    combivis(0x6001, 30, Some(0x02B9), None),
    combivis(0x6001, 19, Some(0x02BA), None),
    combivis(0x6001, 23, Some(0x02BB), None),
    combivis(0x6001, 27, Some(0x02BC), None),
    combivis(0x6001, 31, Some(0x02BD), None),
    combivis(0x5FF5, 0, Some(0x02BE), None),
    combivis(0x22BF, 0, Some(0x02BF), None),
    combivis(0x22C0, 0, Some(0x02C0), None),
    combivis(0x22C1, 0, Some(0x02C1), None),
    combivis(0x22C2, 0, Some(0x02C2), None),
    combivis(0x22C3, 0, Some(0x02C3), None),
    combivis(0x22C4, 0, Some(0x02C4), None),
    combivis(0x22C5, 0, Some(0x02C5), None),
    combivis(0x22C6, 0, Some(0x02C6), None),
    combivis(0x22C7, 0, Some(0x02C7), None),
    combivis(0x2196, 0, Some(0x0196), None),
    combivis(0x2197, 0, Some(0x0197), None),
    combivis(0x2198, 0, Some(0x0198), None),
    combivis(0x2199, 0, Some(0x0199), None),
];

const fn combivis(address: u16, subindex: u8, new: Option<u16>, old: Option<u16>) -> Alias {
    Alias { address, subindex, new, old }
}

static DISPLAY: &[Display] = &[
    shows("Error", "the link to the inverter fails while the operator starts"),
    shows("o_Flo", "a value gets too large in a calculation"),
    shows("t_out", "the inverter's control board does not answer"),
    shows("IDAtA", "illegal data value"),
    shows("rOnly", "parameter can only be read"),
    shows("E_Bcc", "link to the inverter: wrong checksum"),
    shows("Busy", "the inverter is busy"),
    shows("ISruc", "link to the inverter: unknown service"),
    shows("No PA", "the password does not open this parameter"),
    shows("I_FrA", "link to the inverter: wrong character"),
    shows("E_PAr", "link to the inverter: wrong parity"),
    shows("I_SEt", "set not allowed"),
    shows("I_Adr", "no parameter has this address"),
    shows("I_OPE", "not possible at present"),
    shows("E xx", "another error; xx is its number in hex"),
    shows("EEEPX", "fatal: step X of the EEPROM test fails"),
    shows("EEEPR", "fatal: the EEPROM test fails"),
    shows("ESPC3", "fatal: the test of the PROFIBUS chip SPC3 fails"),
    shows("EESPE", "fatal: the test of the external RAM fails"),
    shows("EDPSI", "fatal: dpse_init() fails"),
    shows("EIOLE", "fatal: dpse_calculate_inp_outp_len() fails"),
    shows("ESPCS", "fatal: the PROFIBUS chip SPC3 has no memory for the operator"),
    shows("EDPSE", "fatal: the DPSE driver reports an error"),
    shows("ECAXX", "CAN operator, fatal: test XX of the CAN controller fails"),
    shows("Synch", "CAN operator: works in step with the bus"),
    shows("SAuto", "CAN operator: keeps its own time, because no SYNC comes over the bus"),
    shows("EEPL1", "POWERLINK operator: its FPGA is not configured yet"),
    shows("EEPL2", "POWERLINK operator: its FPGA is starting"),
    shows("EEPL4", "POWERLINK operator: its FPGA is not pre-operational yet"),
];

const fn shows(text: &'static str, meaning: &'static str) -> Display {
    Display { text, meaning }
}

const WORD_INDEX: Spec = Spec::new("word_index", "Index")
    .format(Format::HexAddress)
    .rule(|index| match index as u16 {
        0 => None,
        index if index < keb_f5::inverter_address(0) => {
            Some("no index is below 2000h: add 2000h to the parameter")
        }
        index if keb_f5::is_operators(index) || !keb_f5::INVERTER_INDICES.contains(&index) => {
            Some("only parameters of the inverter can be process data: error 6-5-0000h")
        }
        _ => None,
    })
    .refers(|index| u16::try_from(index).ok().filter(|index| *index > 0))
    .names(&[Name {
        value: 0,
        label: "goes on with the word before",
        note: "The second half of a 32-bit value.",
    }])
    .note("Which parameter this word of process data carries. Writing it switches the data off.");

const WORD_SET: Spec = Spec::new("word_set", "Set")
    .bits(&keb_f5::SETS)
    .initial(1)
    .names(&[Name { value: 0, label: "no set", note: "" }])
    .note("In which sets of the parameter the word is. Writing it switches the data off.");

const SECOND_BYTE: Spec = Spec::new("second_byte", "Second byte")
    .limits(0, 0)
    .note("Always 0: the second byte of a word belongs to the same parameter as the first.");

const BYTES_1_TO_8: &[Bits] = flags!("byte" 0: 1, 1: 2, 2: 3, 3: 4, 4: 5, 5: 6, 6: 7, 7: 8);

const BYTES_9_TO_16: &[Bits] = flags!("byte" 0: 9, 1: 10, 2: 11, 3: 12, 4: 13, 5: 14, 6: 15, 7: 16);

/// The services that the operator and the inverter may exchange process data with.
const SERVICES: &[Bits] = flags!(
    "service" 0: 48, 1: 49, 2: 50, 3: 51, 4: 52, 5: 53, 6: 54, 7: 55,
    8: 56, 9: 57, 10: 58, 11: 59, 12: 60, 13: 61, 14: 62, 15: 63
);

const NO_CYCLE: &[Name] = &[Name { value: 0, label: "no cyclic mode", note: "" }];

const INDICES: &str = "KEB COMBIVERT F5 PROFIBUS-DP operator, 9";

const SOURCE: &str = "KEB COMBIVERT F5 PROFIBUS-DP operator, 9.1, 10.2 and 12.1";

const DESCRIPTIONS: &str = "KEB COMBIVERT F5 PROFIBUS-DP operator, 9.1.1 and 12.1";

const LIST: &str = "KEB COMBIVERT F5 PROFIBUS-DP operator, 12.1";
