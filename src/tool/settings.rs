//! What a user set up in the devices, as a file: one JSON object, every key of which can be left out.
//!
//! ```json
//! {
//!   "dialect": "keb-number-first",
//!   "read_mapping": {"start": 0, "entries": ["00330101", "023B0102", "00000000"]},
//!   "write_mapping": {"start": 0, "entries": ["00340101"]},
//!   "process_output": [{"index": "2032", "sets": "01"}],
//!   "process_input": [{"index": "2033", "sets": "01"}],
//!   "configuration": "B7 A3 93",
//!   "swap_channel": false,
//!   "swap_process": false
//! }
//! ```
//!
//! Mapping entries, indices, sets and configuration bytes are hex.

use serde::{Deserialize, Serialize};

use super::Settings;
use crate::device::{Entry, Mapping, ProcessWord};
use crate::field::hex;
use crate::modbus::DIALECTS;
use crate::profibus::configuration;

/// The file.
#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct File {
    #[serde(skip_serializing_if = "Option::is_none")]
    dialect: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    read_mapping: Option<List>,
    #[serde(skip_serializing_if = "Option::is_none")]
    write_mapping: Option<List>,
    #[serde(skip_serializing_if = "Option::is_none")]
    process_output: Option<Vec<Word>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    process_input: Option<Vec<Word>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    configuration: Option<String>,
    swap_channel: bool,
    swap_process: bool,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct List {
    start: u16,
    entries: Vec<String>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Word {
    index: String,
    sets: String,
}

/// Reads the file; the reason why it cannot be read is a sentence.
///
/// ```
/// use buslens::tool::settings::read;
///
/// let settings = read(r#"{"read_mapping": {"start": 0, "entries": ["00330101"]}}"#).unwrap();
/// assert_eq!(settings.device.read_mapping.entries[0].parameter(), 0x33);
/// assert!(read(r#"{"dialect": "none"}"#).unwrap_err().contains("keb-number-first"));
/// ```
pub fn read(text: &str) -> Result<Settings, String> {
    let file: File = serde_json::from_str(text).map_err(|error| format!("these are no settings: {error}"))?;
    let mut settings = Settings::default();
    if let Some(key) = &file.dialect {
        let known = DIALECTS.iter().copied().find(|dialect| dialect.key == key);
        settings.frame.dialect = known.ok_or_else(|| {
            let keys: Vec<&str> = DIALECTS.iter().map(|dialect| dialect.key).collect();
            format!("there is no dialect “{key}”: there are {}", keys.join(", "))
        })?;
    }
    for (list, mapping) in [
        (file.read_mapping, &mut settings.device.read_mapping),
        (file.write_mapping, &mut settings.device.write_mapping),
    ] {
        if let Some(list) = list {
            let entries = list.entries.iter().map(|entry| number(entry, 8).map(|raw| Entry(raw as u32)));
            *mapping = Mapping { start: list.start, entries: entries.collect::<Result<_, _>>()? };
        }
    }
    for (words, process) in [
        (file.process_output, &mut settings.device.process_output),
        (file.process_input, &mut settings.device.process_input),
    ] {
        if let Some(words) = words {
            let word = |word: &Word| {
                Ok(ProcessWord { index: number(&word.index, 4)? as u16, sets: number(&word.sets, 2)? as u8 })
            };
            *process = words.iter().map(word).collect::<Result<_, String>>()?;
        }
    }
    if let Some(text) = &file.configuration {
        let bytes = text.split_whitespace().map(|byte| number(byte, 2).map(|byte| byte as u8));
        settings.frame.profibus.layout = configuration::layout(&bytes.collect::<Result<Vec<u8>, _>>()?);
    }
    settings.frame.profibus.swap_channel = file.swap_channel;
    settings.frame.profibus.swap_process = file.swap_process;
    Ok(settings)
}

/// The lists of `settings` as a file that [`read`] takes again, but for the configuration, of which
/// only the resulting layout is known.
pub fn write(settings: &Settings) -> String {
    let list = |mapping: &Mapping| {
        let entry = |entry: &Entry| hex(&entry.0.to_be_bytes()).replace(' ', "");
        (*mapping != Mapping::default())
            .then(|| List { start: mapping.start, entries: mapping.entries.iter().map(entry).collect() })
    };
    let words = |words: &[ProcessWord]| {
        let word = |word: &ProcessWord| Word {
            index: hex(&word.index.to_be_bytes()).replace(' ', ""),
            sets: hex(&[word.sets]),
        };
        Some(words.iter().map(word).collect())
    };
    let file = File {
        dialect: Some(settings.frame.dialect.key.to_owned()),
        read_mapping: list(&settings.device.read_mapping),
        write_mapping: list(&settings.device.write_mapping),
        process_output: words(&settings.device.process_output),
        process_input: words(&settings.device.process_input),
        configuration: None,
        swap_channel: settings.frame.profibus.swap_channel,
        swap_process: settings.frame.profibus.swap_process,
    };
    // Strings and numbers only: nothing of this can fail to be written.
    serde_json::to_string_pretty(&file).unwrap_or_default()
}

/// A number of at most `digits` hex digits.
fn number(text: &str, digits: usize) -> Result<u64, String> {
    let fits = !text.is_empty() && text.len() <= digits && text.bytes().all(|byte| byte.is_ascii_hexdigit());
    u64::from_str_radix(text, 16)
        .ok()
        .filter(|_| fits)
        .ok_or_else(|| format!("“{text}” is not a hex number of at most {digits} digits"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_are_written_and_read_again() {
        let mut settings = Settings::default();
        settings.frame.dialect = DIALECTS[1];
        settings.frame.profibus.swap_process = true;
        settings.device.read_mapping = Mapping { start: 16, entries: vec![Entry(0x0033_0101), Entry(0)] };
        settings.device.process_output = vec![ProcessWord { index: 0x2034, sets: 3 }];
        let again = read(&write(&settings)).unwrap();
        assert_eq!(again.device, settings.device);
        assert_eq!(again.frame.profibus, settings.frame.profibus);
        assert_eq!(again.frame.dialect.key, settings.frame.dialect.key);
    }

    #[test]
    fn what_does_not_fit_is_said() {
        for (text, part) in [
            ("{", "no settings"),
            (r#"{"colour": 1}"#, "colour"),
            (r#"{"read_mapping": {"start": 0, "entries": ["123456789"]}}"#, "123456789"),
            (r#"{"process_input": [{"index": "20z3", "sets": "01"}]}"#, "20z3"),
            (r#"{"configuration": "B7 A3 9333"}"#, "9333"),
        ] {
            let said = read(text).expect_err(text);
            assert!(said.contains(part), "{text}: {said}");
        }
    }
}
