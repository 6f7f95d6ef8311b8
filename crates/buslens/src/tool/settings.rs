//! What a user set up in the devices: entries of a form like those of a telegram, and a text of one
//! `path = value` in each line for what is no factory setting.
//!
//! ```text
//! dialect = KEB: quantity before address
//! read_mapping.entries = 1
//! read_mapping.entries.0.entry = 00330101h
//! process_output.words = 1
//! process_output.words.0.index = 2034h
//! process_output.words.0.sets = 01h
//! profibus = swap process data
//! inputs = 8
//! units = 1
//! units.0.unit = 3
//! units.0.device = KEB COMBIVERT F5 on Modbus
//! ```

use super::{Entries, Settings, UnitDevice};
use crate::device::{self, Entry, Mapping, PROFILES, ProcessWord, Profile, keb_f5, mapping_entry};
use crate::field::{Bits, Format, Message, Name, Role, Spec};
use crate::message;
use crate::modbus::{DIALECTS, STANDARD};
use crate::profibus::Layout;
use crate::walk::{self, Deviations, Telegram, Walk, Walker};

/// Reads the text; the message says which line is not understood. An empty text is no settings: it is
/// what a file that cannot be read looks like.
///
/// ```
/// use buslens::tool::settings::read;
///
/// let settings = read("read_mapping.entries = 1\nread_mapping.entries.0.entry = 0x00330101").unwrap();
/// assert_eq!(settings.device.read_mapping.entries[0].parameter(), 0x33);
/// assert!(read("colour = 1").unwrap_err().to_string().contains("colour"));
/// ```
pub fn read(text: &str) -> Result<Settings, Message> {
    let text = text.trim_start_matches('\u{FEFF}');
    if text.trim().is_empty() {
        return Err(message!("the file is empty, or could not be read"));
    }
    let mut lines = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let (path, value) = line.split_once('=').ok_or_else(|| {
            message!("line {n}, “{line}”, is not like “inputs = 8”", n = index + 1, line = line.to_owned())
        })?;
        lines.push((path.trim(), value.trim()));
    }
    let mut settings = Settings::default();
    let mut entries = entries(&mut settings);
    let refused = entries.enter_all(&mut settings, &lines);
    let misfits = entries.misfits.into_iter();
    let misfits =
        misfits.map(|misfit| message!("{path}: {misfit}", path = misfit.path, misfit = misfit.message));
    refused.into_iter().chain(misfits).next().map_or(Ok(settings), Err)
}

/// The text of what is no factory setting, or a comment that says that all is; [`read`] takes it again.
pub fn write(settings: &Settings) -> String {
    let changed = changed(settings);
    if changed.is_empty() {
        // An empty file would look like one that could not be read.
        return "# Everything is at factory settings.\n".to_owned();
    }
    changed.into_iter().map(|(path, text)| format!("{path} = {text}\n")).collect()
}

/// The settings as bytes, which take less room than the text; nothing if all are factory settings.
pub fn to_bytes(settings: &Settings) -> Vec<u8> {
    let bytes = |settings: &Settings| walk::write(&mut settings.clone(), &Deviations::default());
    let written = bytes(settings);
    if written == bytes(&Settings::default()) { Vec::new() } else { written }
}

/// The settings that [`to_bytes`] wrote; what the bytes do not tell is the factory setting.
pub fn from_bytes(bytes: &[u8]) -> Settings {
    let mut settings = Settings::default();
    walk::fill(&mut settings, bytes);
    settings
}

/// Every entry that is no factory setting, as path and text.
pub fn changed(settings: &Settings) -> Vec<(String, String)> {
    let as_delivered = entries(&mut Settings::default());
    entries(&mut settings.clone()).changed(&as_delivered)
}

/// The settings as a form.
pub fn entries(settings: &mut Settings) -> Entries {
    Entries::of(settings, Deviations::default())
}

impl Telegram for Settings {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        let mut dialect =
            DIALECTS.iter().position(|it| std::ptr::eq(*it, self.frame.dialect)).unwrap_or(0) as u8;
        w.u8(&DIALECT, &mut dialect)?;
        self.frame.dialect = DIALECTS.get(usize::from(dialect)).copied().unwrap_or(&STANDARD);
        mapping(w, &READ_MAPPING, &mut self.device.read_mapping)?;
        mapping(w, &WRITE_MAPPING, &mut self.device.write_mapping)?;
        process(w, &PROCESS_OUTPUT, &mut self.device.process_output)?;
        process(w, &PROCESS_INPUT, &mut self.device.process_input)?;

        let profibus = &mut self.frame.profibus;
        let flags = [profibus.swap_process, profibus.swap_channel, !profibus.layout.channel];
        let mut raw = flags.iter().rev().fold(0, |raw, flag| raw << 1 | u8::from(*flag));
        w.u8(&PROFIBUS, &mut raw)?;
        profibus.swap_process = raw & 1 != 0;
        profibus.swap_channel = raw & 2 != 0;
        let Layout { channel, outputs, inputs } = &mut profibus.layout;
        *channel = raw & 4 == 0;
        for (spec, size) in [(&OUTPUTS, outputs), (&INPUTS, inputs)] {
            let mut bytes = u8::try_from(*size).unwrap_or(u8::MAX);
            w.u8(spec, &mut bytes)?;
            *size = bytes.into();
        }
        let Self { device: device::Settings { read_mapping, write_mapping, .. }, .. } = self;
        used(w, &READ_USED, &mut read_mapping.used)?;
        used(w, &WRITE_USED, &mut write_mapping.used)?;
        let count = w.announce(&UNIT_COUNT, 1, self.units.len(), 1)?;
        w.list(&UNITS, &mut self.units, count, Some(1), |w, UnitDevice { unit, device }| {
            w.u8(&UNIT, unit)?;
            let place = |it: &Profile| PROFILES.iter().position(|other| other.key == it.key);
            let mut number = device.and_then(place).map_or(0, |at| at as u8 + 1);
            w.u8(&DEVICE, &mut number)?;
            *device = usize::from(number).checked_sub(1).and_then(|at| PROFILES.get(at).copied());
            Ok(())
        })
    }
}

fn mapping(w: &mut dyn Walker, spec: &'static Spec, mapping: &mut Mapping) -> Walk {
    w.within(spec, &mut |w| {
        w.u16(&START, &mut mapping.start)?;
        let count = w.announce(&COUNT, 1, mapping.entries.len(), 1)?;
        w.list(&ENTRIES, &mut mapping.entries, count, Some(0), |w, Entry(raw)| w.u32(&ENTRY, raw))
    })
}

/// How many entries of a list are in use; one number stands for not knowing.
fn used(w: &mut dyn Walker, spec: &'static Spec, used: &mut Option<usize>) -> Walk {
    let mut number = used.and_then(|used| u8::try_from(used).ok()).unwrap_or(NOT_KNOWN);
    w.u8(spec, &mut number)?;
    *used = Some(number).filter(|number| *number != NOT_KNOWN).map(usize::from);
    Ok(())
}

fn process(w: &mut dyn Walker, spec: &'static Spec, words: &mut Vec<ProcessWord>) -> Walk {
    w.within(spec, &mut |w| {
        let count = w.announce(&COUNT, 1, words.len(), 1)?;
        w.list(&WORDS, words, count, Some(1), |w, word| {
            w.u16(&INDEX, &mut word.index)?;
            w.u8(&SETS, &mut word.sets)
        })
    })
}

static DIALECT: Spec = Spec::new("dialect", "Frame layout of functions 100 and 101")
    .names(&DIALECT_NAMES)
    .note("The figures of the manual cannot be read for sure: what the device at hand speaks.")
    .source("KEB COMBIVERT F5 Modbus operator, 3");
static DIALECT_NAMES: [Name; 5] = {
    let mut names = [const { Name { value: 0, label: "", note: "" } }; 5];
    let mut at = 0;
    while at < DIALECTS.len() {
        names[at] = Name { value: at as u64, label: DIALECTS[at].label, note: DIALECTS[at].note };
        at += 1;
    }
    names
};

static READ_MAPPING: Spec = Spec::new("read_mapping", "Mapping list for reading")
    .note("What registers 0000h to 1FFFh give, from the start address on.")
    .source("KEB COMBIVERT F5 Modbus operator, 2.2 and 2.3");
static WRITE_MAPPING: Spec = Spec::new("write_mapping", "Mapping list for writing")
    .note("What registers 0000h to 1FFFh take, from the start address on.")
    .source("KEB COMBIVERT F5 Modbus operator, 2.2 and 2.3");
static START: Spec = Spec::new("start", "Start address").role(Role::Address).format(Format::HexAddress);
static COUNT: Spec = Spec::new("count", "Number").role(Role::Count);
static ENTRIES: Spec = Spec::new("entries", "Entries");
static ENTRY: Spec = mapping_entry("entry", "Entry");

const NOT_KNOWN: u8 = 255;
static READ_USED: Spec = in_use("read_entries_used", "Entries of the reading list in use");
static WRITE_USED: Spec = in_use("write_entries_used", "Entries of the writing list in use");

const fn in_use(key: &'static str, label: &'static str) -> Spec {
    Spec::new(key, label)
        .role(Role::Count)
        .names(&[Name { value: NOT_KNOWN as u64, label: "not known", note: "" }])
        .note("MDB_MapNr_Rd and MDB_MapNr_Wr: entries behind them count for nothing; factory setting 2.")
        .source("KEB COMBIVERT F5 Modbus operator, 3")
}

static UNIT_COUNT: Spec = Spec::new("unit_count", "Units with a device of their own").role(Role::Count);
static UNITS: Spec = Spec::new("units", "Units");
static UNIT: Spec = Spec::new("unit", "Unit").role(Role::Unit);
static DEVICE: Spec = Spec::new("device", "Device")
    .names(&DEVICE_NAMES)
    .note("The device that this unit is; it counts more than one that is chosen for all.");
static DEVICE_NAMES: [Name; 4] = {
    let mut names = [const { Name { value: 0, label: "not known", note: "" } }; 4];
    let mut at = 0;
    while at < PROFILES.len() {
        names[at + 1] = Name { value: at as u64 + 1, label: PROFILES[at].label, note: "" };
        at += 1;
    }
    names
};

static PROCESS_OUTPUT: Spec = Spec::new("process_output", "Process output data")
    .note("What the words to the device carry; factory setting: control word and set speed.")
    .source("KEB COMBIVERT F5 PROFIBUS-DP operator, 8.1");
static PROCESS_INPUT: Spec = Spec::new("process_input", "Process input data")
    .note("What the words from the device carry; factory setting: status word and actual speed.")
    .source("KEB COMBIVERT F5 PROFIBUS-DP operator, 8.1");
static WORDS: Spec = Spec::new("words", "Words");
static INDEX: Spec = Spec::new("index", "Index")
    .role(Role::Address)
    .format(Format::Hex)
    .note("The parameter; 0 for the second word of a 32-bit value.");
static SETS: Spec = Spec::new("sets", "Sets").role(Role::Address).bits(&keb_f5::SETS);

static PROFIBUS: Spec = Spec::new("profibus", "PROFIBUS")
    .bits(&[
        Bits::flag(0, "swap_process", "swap process data")
            .note("ValueSwapping bit 0: process data come low byte first."),
        Bits::flag(1, "swap_channel", "swap parameter channel").note(
            "ValueSwapping bit 1: index and 4-byte value of the parameter channel come low byte first.",
        ),
        Bits::flag(2, "no_channel", "no parameter channel")
            .note("The configuration has no module for the parameter channel."),
    ])
    .source("KEB COMBIVERT F5 PROFIBUS-DP operator, 7.2");
static OUTPUTS: Spec = Spec::new("outputs", "Process output bytes")
    .role(Role::Count)
    .limits(0, 16)
    .note("Process data to the device, by its configuration.");
static INPUTS: Spec = Spec::new("inputs", "Process input bytes")
    .role(Role::Count)
    .limits(0, 16)
    .note("Process data from the device, by its configuration.");

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_are_written_and_read_again() {
        let mut settings = Settings::default();
        assert!(changed(&settings).is_empty(), "nothing is to be said of factory settings");
        settings.frame.dialect = DIALECTS[1];
        settings.frame.profibus.swap_process = true;
        settings.frame.profibus.layout = Layout { channel: false, outputs: 2, inputs: 8 };
        settings.device.read_mapping =
            Mapping { start: 16, entries: vec![Entry(0x0033_0101), Entry(0)], used: Some(2) };
        settings.device.process_output = vec![ProcessWord { index: 0x2034, sets: 3 }];
        for again in [read(&write(&settings)).unwrap(), from_bytes(&to_bytes(&settings))] {
            assert_eq!(again.device, settings.device);
            assert_eq!(again.frame.profibus, settings.frame.profibus);
            assert_eq!(again.frame.dialect.key, settings.frame.dialect.key);
        }
    }

    #[test]
    fn bytes_that_end_early_leave_the_rest_as_delivered() {
        assert!(to_bytes(&Settings::default()).is_empty());
        assert!(to_bytes(&from_bytes(&[])).is_empty());
        let settings = from_bytes(&[1, 0, 16]);
        assert_eq!((settings.frame.dialect.key, settings.device.read_mapping.start), (DIALECTS[1].key, 16));
        assert_eq!(settings.device.process_input, Settings::default().device.process_input);
    }

    #[test]
    fn what_does_not_fit_is_said() {
        for (text, part) in [
            ("inputs 8", "line 1"),
            ("# a remark\n\ncolour = 1", "colour"),
            ("dialect = french", "french"),
            ("read_mapping.entries = 1\nread_mapping.entries.0.entry = 0x123456789", "0x123456789"),
            ("read_mapping.entries = 60000", "60000"),
            ("read_mapping.entries.0.entry = 1", "read_mapping.entries.0.entry"),
            ("process_input.words.0.index = 20z3h", "20z3h"),
        ] {
            let said = read(text).map(|settings| write(&settings)).expect_err(text).to_string();
            assert!(said.contains(part), "{text}: {said}");
        }
    }
}
