//! Prints the telegrams of a text, a log or a capture as JSON Lines: one object for each telegram,
//! then a summary.

use std::fmt::Write as _;
use std::io::{Read, Write as _};
use std::process::ExitCode;

use buslens::field::Direction;
use buslens::tool::log::{Input, Reading};
use buslens::tool::{Options, PROFILES, PROTOCOLS, Profile, Protocol, decode_file, json, settings};

fn main() -> ExitCode {
    match run() {
        Ok(text) => {
            // A closed pipe, as of `decode … | head`, is the reader's choice.
            let _ = std::io::stdout().write_all(text.as_bytes());
            ExitCode::SUCCESS
        }
        Err(reason) => {
            eprintln!("decode: {reason}");
            ExitCode::from(2)
        }
    }
}

fn run() -> Result<String, String> {
    let mut arguments = std::env::args().skip(1);
    let mut options = Options::default();
    let mut fields = false;
    let mut reading = Reading::default();
    let mut file = None;
    while let Some(argument) = arguments.next() {
        let (name, mut value) = match argument.split_once('=') {
            Some((name, value)) if name.starts_with("--") => (name.to_owned(), Some(value.to_owned())),
            _ => (argument.clone(), None),
        };
        let mut choice = |allowed: &[&'static str]| {
            let value = value.take().or_else(|| arguments.next()).unwrap_or_default();
            let known = allowed.iter().copied().find(|word| *word == value);
            known.ok_or_else(|| format!("{name} takes {}, not “{value}”", either(allowed)))
        };
        match name.as_str() {
            "--help" | "-h" => return Ok(help()),
            "--fields" => fields = true,
            "--protocol" => {
                let keys = keys("auto", PROTOCOLS.iter().map(|protocol| protocol.key));
                let key = choice(&keys)?;
                options.protocol = Protocol::of(key);
            }
            "--device" => {
                let keys = keys("none", PROFILES.iter().map(|profile| profile.key));
                let key = choice(&keys)?;
                options.device = Profile::of(key);
            }
            "--input" => {
                let key = choice(&Input::KEYS.map(|(key, _)| key))?;
                reading.input = Input::of(key).unwrap_or_default();
            }
            "--language" => _ = choice(&["en"])?,
            "--settings" => {
                let path = value.or_else(|| arguments.next()).unwrap_or_default();
                let text = input(Some(&path))?;
                options.settings = settings::read(&String::from_utf8_lossy(&text))
                    .map_err(|reason| format!("{path}: {reason}"))?;
            }
            "--direction" => {
                options.direction = match choice(&["auto", "request", "response"])? {
                    "request" => Some(Direction::Request),
                    "response" => Some(Direction::Response),
                    _ => None,
                }
            }
            _ if argument.starts_with('-') && argument != "-" => {
                return Err(format!("there is no option {argument}; --help lists them"));
            }
            _ if file.is_none() => file = Some(argument),
            _ => return Err(format!("one file at a time: “{argument}” is one too many")),
        }
    }
    let file = input(file.as_deref())?;
    let report = decode_file(&file, &reading, options).map_err(|refusal| refusal.to_string())?;
    json::lines(&report, fields).map_err(|error| error.to_string())
}

/// The bytes of the file, or of standard input.
fn input(file: Option<&str>) -> Result<Vec<u8>, String> {
    match file {
        None | Some("-") => {
            let mut bytes = Vec::new();
            let read = std::io::stdin().read_to_end(&mut bytes);
            read.map_err(|error| format!("standard input cannot be read: {error}"))?;
            Ok(bytes)
        }
        Some(path) => std::fs::read(path).map_err(|error| format!("{path} cannot be read: {error}")),
    }
}

/// "a, b or c".
fn either(words: &[&str]) -> String {
    let mut text = String::new();
    for (index, word) in words.iter().enumerate() {
        let between = match index {
            0 => "",
            _ if index + 1 == words.len() => " or ",
            _ => ", ",
        };
        // Writing to a string cannot fail.
        let _ = write!(text, "{between}{word}");
    }
    text
}

/// `first`, then the others.
fn keys(first: &'static str, others: impl Iterator<Item = &'static str>) -> Vec<&'static str> {
    std::iter::once(first).chain(others).collect()
}

fn help() -> String {
    let list = |keys: Vec<&'static str>| keys.join("\n             ");
    format!(
        "\
Prints the telegrams of a text, a log or a capture as JSON Lines, and a summary at the end.

decode [--protocol PROTOCOL] [--device DEVICE] [--direction auto|request|response]
       [--settings FILE] [--input auto|text|binary|pcap] [--language en] [--fields] [FILE]

PROTOCOL:    {}
DEVICE:      {}

Without FILE, or with -, it reads standard input. --fields adds the tree of fields. The settings
are those of the devices that speak: mapping lists, layouts, byte orders, a line each (see the
module buslens::tool::settings).
",
        list(keys("auto", PROTOCOLS.iter().map(|protocol| protocol.key))),
        list(keys("none", PROFILES.iter().map(|profile| profile.key))),
    )
}
