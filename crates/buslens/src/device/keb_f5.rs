//! What the operators of the KEB COMBIVERT F5 have in common, whatever bus they are for.
//!
//! An inverter parameter has an address of two bytes, its group's number and its own: Sy.51 is
//! 0033h, OP.59 is 033Bh. Both buses add 2000h, which gives the Modbus register and the PROFIBUS
//! index. The manuals name more parameters (DI.01, DI.02, Fr.09, Pn.05, Pn.06, ud.01), but not
//! their groups' numbers: where those are, only the inverter's application manual says.
//!
//! Sources: the manuals of the Modbus operator (sections 1.2, 2.2 and 3) and of the PROFIBUS-DP
//! operator (sections 6.4, 8.1, 9, 9.1.1 and 10.2).

use super::{Access, Area, Parameter, Taught};
use crate::field::{Bits, Format, Name, Role, Spec};

/// A word of process data: the PROFIBUS index of the parameter that it carries, and its sets as
/// `sets` tells them apart. The second word of a 32-bit value has index 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ProcessWord {
    pub index: u16,
    pub sets: u8,
}

/// What the process output data carry by the factory setting: control word, set speed.
pub static STANDARD_OUTPUT: &[ProcessWord] = &[word(0x2032), word(0x2034)];

/// What the process input data carry by the factory setting: status word, actual speed.
pub static STANDARD_INPUT: &[ProcessWord] = &[word(0x2033), word(0x2035)];

const fn word(index: u16) -> ProcessWord {
    ProcessWord { index, sets: 1 }
}

/// Takes one part of a process data description into `words`: subindex 4x - 2 is the index of word
/// x, the one behind it its sets.
pub(super) fn describe(words: &mut Vec<ProcessWord>, &Taught { subindex, value, .. }: &Taught) {
    let Some(word) = usize::from(subindex).checked_sub(2).map(|part| part / 4) else { return };
    if word < MOST_WORDS && words.len() <= word {
        words.resize(word + 1, ProcessWord { index: 0, sets: 0 });
    }
    match (words.get_mut(word), subindex % 4) {
        (Some(word), 2) => word.index = value as u16,
        (Some(word), 3) => word.sets = value as u8,
        _ => {}
    }
}

/// 16 bytes of process data each way.
const MOST_WORDS: usize = 8;

/// A set mask: the sets 0 to 7 of a parameter, one bit each, from bit `from` on. Several at once
/// are all written; they can be read as long as they have the same value.
pub(super) const fn sets(from: u32) -> [Bits; 8] {
    [
        Bits::flag(from, "set_0", "set 0"),
        Bits::flag(from + 1, "set_1", "set 1"),
        Bits::flag(from + 2, "set_2", "set 2"),
        Bits::flag(from + 3, "set_3", "set 3"),
        Bits::flag(from + 4, "set_4", "set 4"),
        Bits::flag(from + 5, "set_5", "set 5"),
        Bits::flag(from + 6, "set_6", "set 6"),
        Bits::flag(from + 7, "set_7", "set 7"),
    ]
}

/// A byte that is a set mask.
pub static SETS: [Bits; 8] = sets(0);

/// The inverter's parameters, where both buses have them.
pub(super) const fn inverter_parameters(note: &'static str, source: &'static str) -> Area {
    let spec = Spec::new("inverter_parameter", "Inverter parameter")
        .format(Format::Register)
        .hex_numbers()
        .note(note)
        .source(source);
    Area::new(INVERTER, spec).blocks(0x3F00, 1, 0).in_sets()
}

/// Whether the operator's own parameters are here, among the inverter's: from XX80h on in each group.
pub(super) fn is_operators(address: u16) -> bool {
    INVERTER_INDICES.contains(&address) && (0x80..=0xFE).contains(&(address & 0xFF))
}

/// The address of a parameter of the inverter as registers and indices have it.
pub(super) const fn inverter_address(parameter: u16) -> u16 {
    INVERTER.wrapping_add(parameter)
}

/// What the operator adds to the standard's exception codes.
pub(super) static EXCEPTIONS: Spec = Spec::new("exception", "Exception code")
    .short("Exception")
    .role(Role::Status)
    .note("Why the operator rejects the request.")
    .source("KEB COMBIVERT F5 Modbus operator, 4.2")
    .names(&[
        Name {
            value: 64,
            label: "internal buffer overflow",
            note: "The request is longer than the F5 operator can take: ask for less at once.",
        },
        Name {
            value: 65,
            label: "timeout towards the inverter",
            note: "The operator got no answer from the inverter behind it.",
        },
        Name {
            value: 66,
            label: "parameter is write-protected",
            note: "The inverter parameter can only be read, or not be written in this state.",
        },
        Name { value: 67, label: "wrong password", note: "The parameter needs a higher password level." },
    ]);

/// A note of a parameter whose remark in the manuals says when a new value counts.
macro_rules! kept {
    ($note:literal) => {
        concat!($note, " A new value counts at once, and is kept without power.")
    };
}
pub(super) use kept;

/// Whether a named parameter is the inverter's, and so may differ from set to set.
pub(super) fn has_sets(parameter: &Parameter) -> bool {
    INVERTER_PARAMETERS.iter().any(|inverter| inverter.address == parameter.address)
}

/// The inverter's parameters that the manuals name.
pub(super) static INVERTER_PARAMETERS: &[Parameter] = &[
    inverter(
        0x0006,
        "Sy.06",
        Spec::new("inverter_address", "Inverter address")
            .names(&[Name { value: 0, label: "0, no Modbus", note: "All activity on Modbus is off." }])
            .initial(1)
            .note(
                "The address on the bus; factory setting 1. The Modbus operator can have one of its own; if \
             it has not, 0 switches Modbus off.",
            ),
    ),
    inverter(
        0x0007,
        "Sy.07",
        Spec::new("baud_rate", "Baud rate").names(BAUD_RATES).only_named().note(
            "How fast the Modbus and the diagnosis interface are. The operator looks at it once, when \
             it starts.",
        ),
    ),
    inverter(
        0x0032,
        "Sy.50",
        Spec::new("control_word", "Control word")
            .format(Format::Hex)
            .note("Commands to the inverter. What its bits say, the inverter's application manual says."),
    )
    .length(2),
    inverter(
        0x0033,
        "Sy.51",
        Spec::new("status_word", "Status word")
            .format(Format::Hex)
            .note("How the inverter is. What its bits say, the inverter's application manual says."),
    )
    .length(2)
    .access(Access::Read),
    inverter(
        0x0034,
        "Sy.52",
        Spec::new("set_speed", "Set speed")
            .format(Format::Signed)
            .note("How fast the motor is to turn; below 0 the other way round."),
    )
    .length(2),
    inverter(
        0x0035,
        "Sy.53",
        Spec::new("actual_speed", "Actual speed")
            .format(Format::Signed)
            .note("How fast the motor turns; below 0 the other way round."),
    )
    .length(2)
    .access(Access::Read),
    inverter(
        0x0300,
        "OP.00",
        Spec::new("reference_source", "Reference source").initial(5).note(
            "Where the inverter takes its set speed from. 5 for the set speed in the process data; with \
                 them, bit 0 of DI.01 (signal source) and of DI.02 (digital inputs) has to be 1, too.",
        ),
    ),
    inverter(
        0x0301,
        "OP.01",
        Spec::new("rotation_source", "Rotation source")
            .initial(8)
            .note("Where the inverter takes its direction from. 8 goes with process data, as do others."),
    ),
    inverter(
        0x033B,
        "OP.59",
        Spec::new("motorpoti_ramp_time", "Motorpoti ramp time")
            .format(Format::Register)
            .note("The ramp of the motor potentiometer. 32 bits: as process data it takes two words."),
    )
    .length(4),
    inverter(
        0x0D00,
        "LE.00",
        Spec::new("switching_level", "Switching level")
            .format(Format::Register)
            .note("A level to compare with. 32 bits: as process data it takes two words."),
    )
    .length(4),
];

const fn inverter(address: u16, id: &'static str, spec: Spec) -> Parameter {
    Parameter::new(INVERTER + address, id, spec.source(SOURCE))
}

/// What Sy.07 and the operators call the speeds of their interfaces.
pub(super) const BAUD_RATES: &[Name] = &[
    baud_rate(0, "1200 bit/s"),
    baud_rate(1, "2400 bit/s"),
    baud_rate(2, "4800 bit/s"),
    baud_rate(3, "9600 bit/s"),
    baud_rate(4, "19200 bit/s"),
    baud_rate(5, "38400 bit/s"),
    Name {
        value: 6,
        label: "55500 bit/s",
        note: "A PC's serial interface does not have this speed by itself.",
    },
];

const fn baud_rate(value: u64, label: &'static str) -> Name {
    Name { value, label, note: "" }
}

/// A command to the operator, and whether it is done.
pub(super) const COMMAND: &[Bits] = &[
    Bits::part(0, 15, "command", "command").names(&[
        Name { value: 0, label: "no command", note: "" },
        Name { value: 1, label: "load the factory settings", note: "Of the operator, not of the inverter." },
    ]),
    Bits::flag(15, "done", "done").note("The operator sets it once the command is carried out."),
];

/// What both buses add to the address of an inverter parameter.
const INVERTER: u16 = 0x2000;

/// The indices of inverter parameters, whose subindex is a set mask.
pub const INVERTER_INDICES: std::ops::RangeInclusive<u16> = INVERTER..=0x5EFF;

const SOURCE: &str = "KEB COMBIVERT F5 PROFIBUS-DP operator, 6.4, 8.1, 9.1.1 and 10.2";
