//! How devices are set up, as a person reads it: registers and words with the names of their parameters,
//! and what is no factory setting in sentences.

use super::{Settings, UnitDevice};
use crate::device::{Entry, Mapping, ProcessWord, Profile};
use crate::field::{Argument, Message, hex_value, in_order};
use crate::message;
use crate::modbus::DIALECTS;

/// A parameter that a register or a word can stand for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parameter {
    /// Its address in the inverter: 0034h.
    pub address: u16,
    /// The maker's short name: `Sy.52`.
    pub id: &'static str,
    pub label: &'static str,
    /// 1 for 16 bits, 2 for 32.
    pub words: u8,
}

/// All parameters of the inverter that the manuals name.
pub fn parameters() -> impl Iterator<Item = Parameter> {
    let modbus = Profile::of("keb-f5-modbus").into_iter().flat_map(Profile::parameters);
    modbus.filter_map(|parameter| {
        let address = parameter.address.checked_sub(REGISTERS).filter(|address| *address < ADDRESSES)?;
        let words = if parameter.length == Some(4) { 2 } else { 1 };
        Some(Parameter { address, id: parameter.id, label: parameter.spec.label, words })
    })
}

/// The parameter at an address, if the manuals name it.
pub fn parameter(address: u16) -> Option<Parameter> {
    parameters().find(|parameter| parameter.address == address)
}

/// The parameters that somebody may mean: by a part of the name, by the short name, by the address as the
/// manual writes it (`0034h`, `34h`, `0x34`), or by the register (`2034h`). An address that the manuals
/// do not name is one, too.
///
/// ```
/// use buslens::tool::setup::find;
///
/// let found: Vec<&str> = find("speed").iter().map(|it| it.id).collect();
/// assert_eq!(found, ["Sy.52", "Sy.53"]);
/// assert_eq!(find("0034h")[0].id, "Sy.52");
/// assert_eq!(find("2034h")[0].id, "Sy.52");
/// ```
pub fn find(typed: &str) -> Vec<Parameter> {
    let typed = typed.trim().to_ascii_lowercase();
    let hex = typed.strip_prefix("0x").or_else(|| typed.strip_suffix('h'));
    let number = hex.and_then(|digits| u16::from_str_radix(digits, 16).ok());
    let address = number.and_then(|number| match number.checked_sub(REGISTERS) {
        Some(address) => Some(address).filter(|address| *address < ADDRESSES),
        None => Some(number),
    });
    let fits = |parameter: &Parameter| {
        let text = format!("{} {}", parameter.id, parameter.label).to_ascii_lowercase();
        address == Some(parameter.address) || typed.split_whitespace().all(|word| text.contains(word))
    };
    // What was named exactly comes first.
    let is_other = |it: &Parameter| address != Some(it.address) && !it.id.eq_ignore_ascii_case(&typed);
    let mut found = in_order(parameters().filter(fits), is_other);
    if let Some(address) = address.filter(|address| found.iter().all(|it| it.address != *address)) {
        found.insert(0, Parameter { address, id: "", label: "parameter without a name here", words: 1 });
    }
    found
}

/// The lists of parameters that a user sets up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum List {
    /// Registers that are read, on Modbus.
    ReadMapping,
    /// Registers that are written, on Modbus.
    WriteMapping,
    /// Words of process data to the device, on PROFIBUS.
    ProcessOutput,
    /// Words of process data from the device, on PROFIBUS.
    ProcessInput,
}

/// A row of a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Row {
    /// The register, or the number of the word from 0.
    pub place: u16,
    /// The parameter's address in the inverter.
    pub parameter: u16,
    /// Parameter sets, one bit each.
    pub sets: u8,
    /// 1 for 16 bits, 2 for 32.
    pub words: u8,
    /// The second word of a value of 32 bits: belongs to the row before it.
    pub second_half: bool,
    /// As it is written into the device.
    pub raw: u32,
}

impl List {
    pub const ALL: [Self; 4] =
        [Self::ReadMapping, Self::WriteMapping, Self::ProcessOutput, Self::ProcessInput];

    /// The most rows that the device takes.
    pub const fn most(self) -> usize {
        match self {
            Self::ReadMapping | Self::WriteMapping => 100,
            Self::ProcessOutput | Self::ProcessInput => 8,
        }
    }

    /// The rows as they are set up.
    pub fn rows(self, settings: &Settings) -> Vec<Row> {
        match self {
            Self::ReadMapping => mapped(&settings.device.read_mapping),
            Self::WriteMapping => mapped(&settings.device.write_mapping),
            Self::ProcessOutput => words(&settings.device.process_output),
            Self::ProcessInput => words(&settings.device.process_input),
        }
    }

    /// Sets up row `index`, or a new one behind the last. A value of 32 bits takes the row behind it, too.
    pub fn set(self, settings: &mut Settings, index: usize, parameter: u16, sets: u8, words: u8) {
        let mut rows = self.rows(settings);
        let row = Row { place: 0, parameter, sets, words, second_half: false, raw: 0 };
        if index < rows.len() {
            rows[index] = row;
        } else {
            rows.push(row);
        }
        let index = index.min(rows.len() - 1);
        let half = Row { second_half: true, ..row };
        match (words, rows.get(index + 1)) {
            (2, Some(next)) if next.second_half => {}
            (2, _) => rows.insert(index + 1, half),
            (_, Some(next)) if next.second_half => drop(rows.remove(index + 1)),
            _ => {}
        }
        self.store(settings, &rows);
    }

    /// Takes row `index` away, with its second half.
    pub fn remove(self, settings: &mut Settings, index: usize) {
        let mut rows = self.rows(settings);
        if index >= rows.len() {
            return;
        }
        rows.remove(index);
        if rows.get(index).is_some_and(|next| next.second_half) {
            rows.remove(index);
        }
        self.store(settings, &rows);
    }

    fn store(self, settings: &mut Settings, rows: &[Row]) {
        let rows = &rows[..rows.len().min(self.most())];
        let device = &mut settings.device;
        let entry = |row: &Row| match row.second_half {
            true => Entry(0),
            false => Entry(u32::from(row.parameter) << 16 | u32::from(row.sets) << 8 | u32::from(row.words)),
        };
        let word = |row: &Row| match row.second_half {
            true => ProcessWord { index: 0, sets: row.sets },
            false => ProcessWord { index: REGISTERS + row.parameter, sets: row.sets },
        };
        match self {
            Self::ReadMapping => device.read_mapping.entries = rows.iter().map(entry).collect(),
            Self::WriteMapping => device.write_mapping.entries = rows.iter().map(entry).collect(),
            Self::ProcessOutput => device.process_output = rows.iter().map(word).collect(),
            Self::ProcessInput => device.process_input = rows.iter().map(word).collect(),
        }
    }
}

fn mapped(mapping: &Mapping) -> Vec<Row> {
    let mut rows: Vec<Row> = Vec::new();
    for (n, entry) in (0_u16..).zip(&mapping.entries) {
        let before = rows.last().copied().filter(|before| before.words == 2 && !before.second_half);
        let second_half = before.filter(|_| *entry == Entry(0));
        rows.push(match second_half {
            Some(before) => Row { place: mapping.start.wrapping_add(n), second_half: true, raw: 0, ..before },
            None => Row {
                place: mapping.start.wrapping_add(n),
                parameter: entry.parameter(),
                sets: entry.sets(),
                words: entry.words(),
                second_half: false,
                raw: entry.0,
            },
        });
    }
    rows
}

fn words(words: &[ProcessWord]) -> Vec<Row> {
    let mut rows: Vec<Row> = Vec::new();
    for (n, word) in (0_u16..).zip(words) {
        let raw = u32::from(word.index);
        let row = match rows.last_mut().filter(|before| word.index == 0 && !before.second_half) {
            Some(before) => {
                before.words = 2;
                Row { place: n, second_half: true, raw, ..*before }
            }
            None => {
                let parameter = word.index.saturating_sub(REGISTERS);
                Row { place: n, parameter, sets: word.sets, words: 1, second_half: false, raw }
            }
        };
        rows.push(row);
    }
    rows
}

/// Something that is no factory setting.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// "Register 0000h reads Status word (Sy.51)".
    pub said: Message,
    pub what: What,
}

/// What a [`Difference`] is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum What {
    /// A row of a mapping list.
    Row(List, usize),
    /// A list of process data as a whole.
    Words(List),
    /// The register that a mapping list starts at.
    Start(List),
    Dialect,
    SwapProcess,
    SwapChannel,
    Channel,
    Outputs,
    Inputs,
    /// What a unit is.
    Unit(u8),
}

/// What is no factory setting, in the order of the settings.
pub fn differences(settings: &Settings) -> Vec<Difference> {
    let usual = Settings::default();
    let mut found = Vec::new();
    let mut tell = |what: What, said: Message| found.push(Difference { said, what });
    for list in [List::ReadMapping, List::WriteMapping] {
        let (mapping, verbs, used) = match list {
            List::ReadMapping => (&settings.device.read_mapping, ["reads", "read"], "reading"),
            _ => (&settings.device.write_mapping, ["writes", "write"], "writing"),
        };
        if mapping.start != 0 {
            let start = hex_value(mapping.start.into(), 2);
            let said = message!(
                "the list for {used} starts at register {start}",
                used = Argument::Term(used),
                start = start
            );
            tell(What::Start(list), said);
        }
        for (index, row) in list.rows(settings).into_iter().enumerate().filter(|(_, row)| !row.second_half) {
            tell(What::Row(list, index), row_sentence(&row, verbs));
        }
    }
    for (list, words, standard, side) in [
        (List::ProcessOutput, &settings.device.process_output, &usual.device.process_output, "output"),
        (List::ProcessInput, &settings.device.process_input, &usual.device.process_input, "input"),
    ] {
        if words != standard {
            let rows = list.rows(settings);
            let names = Message::list(rows.iter().filter(|row| !row.second_half).map(name));
            let said = match names {
                Some(names) => {
                    message!("process {side} data carry {names}", side = Argument::Term(side), names = names)
                }
                None => message!("process {side} data carry nothing", side = Argument::Term(side)),
            };
            tell(What::Words(list), said);
        }
    }
    let (frame, usual) = (&settings.frame, &usual.frame);
    if frame.dialect.key != usual.dialect.key {
        let layout = Argument::Term(frame.dialect.label);
        tell(What::Dialect, message!("functions 100 and 101 are laid out as {layout}", layout = layout));
    }
    let (profibus, usual) = (&frame.profibus, &usual.profibus);
    if profibus.swap_process != usual.swap_process {
        tell(What::SwapProcess, message!("process data come low byte first"));
    }
    if profibus.swap_channel != usual.swap_channel {
        tell(What::SwapChannel, message!("index and value of the parameter channel come low byte first"));
    }
    if profibus.layout.channel != usual.layout.channel {
        tell(What::Channel, message!("there is no parameter channel"));
    }
    for (what, size, standard, side) in [
        (What::Outputs, profibus.layout.outputs, usual.layout.outputs, "output"),
        (What::Inputs, profibus.layout.inputs, usual.layout.inputs, "input"),
    ] {
        if size != standard {
            let said = message!(
                "process {side} data have {bytes}",
                side = Argument::Term(side),
                bytes = Message::bytes(size)
            );
            tell(what, said);
        }
    }
    for UnitDevice { unit, device } in &settings.units {
        let Some(device) = device else { continue };
        let said = message!("unit {unit} is {device}", unit = *unit, device = Argument::Term(device.label));
        tell(What::Unit(*unit), said);
    }
    found
}

/// Says what a unit is; `None` that nobody knows.
pub fn name_unit(settings: &mut Settings, unit: u8, device: Option<&'static Profile>) {
    settings.units.retain(|it| it.unit != unit);
    if device.is_some() {
        settings.units.push(UnitDevice { unit, device });
        settings.units = in_order(std::mem::take(&mut settings.units), |it| it.unit);
    }
}

/// Puts one thing back as it is delivered.
pub fn put_back(settings: &mut Settings, what: What) {
    let usual = Settings::default();
    let profibus = &mut settings.frame.profibus;
    match what {
        What::Row(list, index) => list.remove(settings, index),
        What::Words(List::ProcessInput) => settings.device.process_input = usual.device.process_input,
        What::Words(_) => settings.device.process_output = usual.device.process_output,
        What::Start(List::WriteMapping) => settings.device.write_mapping.start = 0,
        What::Start(_) => settings.device.read_mapping.start = 0,
        What::Dialect => settings.frame.dialect = DIALECTS[0],
        What::SwapProcess => profibus.swap_process = usual.frame.profibus.swap_process,
        What::SwapChannel => profibus.swap_channel = usual.frame.profibus.swap_channel,
        What::Channel => profibus.layout.channel = usual.frame.profibus.layout.channel,
        What::Outputs => profibus.layout.outputs = usual.frame.profibus.layout.outputs,
        What::Inputs => profibus.layout.inputs = usual.frame.profibus.layout.inputs,
        What::Unit(unit) => name_unit(settings, unit, None),
    }
}

/// "Register 0000h reads Status word (Sy.51)".
fn row_sentence(row: &Row, [one, several]: [&'static str; 2]) -> Message {
    let (first, name) = (hex_value(row.place.into(), 2), name(row));
    match row.words {
        2 => message!(
            "registers {first} and {second} {verb} {name}, 32 bit",
            first = first,
            second = hex_value(u64::from(row.place) + 1, 2),
            verb = Argument::Term(several),
            name = name
        ),
        _ => {
            message!("register {first} {verb} {name}", first = first, verb = Argument::Term(one), name = name)
        }
    }
}

/// "Status word (Sy.51)", or the address of what has no name here.
fn name(row: &Row) -> Message {
    match parameter(row.parameter) {
        Some(parameter) => {
            message!("{label} ({id})", label = Argument::Term(parameter.label), id = parameter.id.to_owned())
        }
        None if row.raw == 0 => message!("nothing"),
        None => message!("parameter {address}", address = hex_value(row.parameter.into(), 2)),
    }
}

/// What the F5 adds to the address of a parameter: its register, or its index.
const REGISTERS: u16 = 0x2000;
/// Addresses of parameters lie below.
const ADDRESSES: u16 = 0x3F00;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tool::settings::{read, write};

    #[test]
    fn rows_have_their_second_halves() {
        let mut settings = Settings::default();
        let list = List::ReadMapping;
        list.set(&mut settings, 0, 0x33, 1, 1);
        list.set(&mut settings, 1, 0x33B, 1, 2);
        list.set(&mut settings, 9, 0x35, 1, 1);
        let raw: Vec<u32> = list.rows(&settings).iter().map(|row| row.raw).collect();
        assert_eq!(raw, [0x0033_0101, 0x033B_0102, 0, 0x0035_0101]);
        list.set(&mut settings, 1, 0x34, 1, 1);
        assert_eq!(list.rows(&settings).len(), 3);
        list.set(&mut settings, 0, 0x33B, 1, 2);
        list.remove(&mut settings, 0);
        let raw: Vec<u32> = list.rows(&settings).iter().map(|row| row.raw).collect();
        assert_eq!(raw, [0x0034_0101, 0x0035_0101]);
        for index in 0..300 {
            list.set(&mut settings, index, 0x33, 1, 1);
        }
        assert_eq!(list.rows(&settings).len(), list.most());
        // As the file has it.
        let again = read(&write(&settings)).unwrap();
        assert_eq!(list.rows(&again), list.rows(&settings));
    }

    #[test]
    fn words_of_process_data_are_parameters() {
        let mut settings = Settings::default();
        let rows = List::ProcessInput.rows(&settings);
        assert_eq!(rows.iter().map(|row| row.parameter).collect::<Vec<_>>(), [0x33, 0x35]);
        List::ProcessInput.set(&mut settings, 1, 0x33B, 1, 2);
        let rows = List::ProcessInput.rows(&settings);
        assert_eq!((rows.len(), rows[1].words, rows[2].second_half), (3, 2, true));
        assert_eq!(settings.device.process_input[1].index, 0x233B);
        assert_eq!(
            differences(&settings)[0].said.sentence(),
            "Process input data carry Status word (Sy.51), Motorpoti ramp time (OP.59)"
        );
    }

    #[test]
    fn what_is_not_as_delivered_is_said_and_put_back() {
        assert!(differences(&Settings::default()).is_empty());
        let mut settings = read(
            "dialect = KEB: quantity before address\nread_mapping.start = 0010h\nread_mapping.entries = 3\n\
             read_mapping.entries.0.entry = 00330101h\nread_mapping.entries.1.entry = 033B0102h\n\
             write_mapping.entries = 1\nwrite_mapping.entries.0.entry = 12340101h\n\
             process_output.words = 0\nprofibus = 07h\noutputs = 2\ninputs = 8",
        )
        .unwrap();
        let said: Vec<String> = differences(&settings).iter().map(|it| it.said.sentence()).collect();
        assert_eq!(
            said,
            [
                "The list for reading starts at register 0010h",
                "Register 0010h reads Status word (Sy.51)",
                "Registers 0011h and 0012h read Motorpoti ramp time (OP.59), 32 bit",
                "Register 0000h writes parameter 1234h",
                "Process output data carry nothing",
                "Functions 100 and 101 are laid out as KEB: quantity before address",
                "Process data come low byte first",
                "Index and value of the parameter channel come low byte first",
                "There is no parameter channel",
                "Process output data have 2 bytes",
                "Process input data have 8 bytes",
            ]
        );
        for left in (0..said.len()).rev() {
            let first = differences(&settings)[0].what;
            put_back(&mut settings, first);
            assert_eq!(differences(&settings).len(), left);
        }
        assert_eq!(write(&settings), write(&Settings::default()));
    }

    #[test]
    fn units_are_devices() {
        let mut settings = Settings::default();
        name_unit(&mut settings, 3, Profile::of("keb-f5-modbus"));
        name_unit(&mut settings, 1, Profile::of("memograph-rsg45"));
        let said: Vec<String> = differences(&settings).iter().map(|it| it.said.sentence()).collect();
        assert_eq!(
            said,
            ["Unit 1 is Endress+Hauser Memograph M RSG45", "Unit 3 is KEB COMBIVERT F5 on Modbus"]
        );
        let text = write(&settings);
        assert!(text.contains("units.1.unit = 3\nunits.1.device = 1\n"), "{text}");
        assert_eq!(read(&text).unwrap().units, settings.units);
        let named = text.replace("device = 1", "device = KEB COMBIVERT F5 on Modbus");
        assert_eq!(read(&named).unwrap().units, settings.units);
        let bytes = crate::tool::settings::to_bytes(&settings);
        assert_eq!(crate::tool::settings::from_bytes(&bytes).units, settings.units);
        put_back(&mut settings, What::Unit(1));
        name_unit(&mut settings, 3, None);
        assert!(differences(&settings).is_empty());
    }

    #[test]
    fn parameters_are_found_as_the_manual_writes_them() {
        let first = |typed: &str| find(typed).first().map(|it| (it.address, it.id));
        assert_eq!(first("sy.52"), Some((0x34, "Sy.52")));
        assert_eq!(first("34h"), Some((0x34, "Sy.52")));
        assert_eq!(first("0x2034"), Some((0x34, "Sy.52")));
        assert_eq!(first("0123h"), Some((0x123, "")));
        assert_eq!(first("no such thing"), None);
        assert!(parameters().all(|it| parameter(it.address) == Some(it)));
    }
}
