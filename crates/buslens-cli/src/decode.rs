//! `buslens decode`: the telegrams of a text, a log or a capture as JSON Lines, one object for each telegram,
//! then a summary.

use std::io::Read;
use std::path::Path;

use buslens::field::Direction;
use buslens::tool::log::{Input, Reading};
use buslens::tool::{Options, PROFILES, PROTOCOLS, Profile, Protocol, Settings, decode_file, json, settings};
use clap::builder::PossibleValue;
use clap::{Arg, ArgAction, ArgMatches, Command, value_parser};

pub const NAME: &str = "decode";

/// What stands for standard input.
const STDIN: &str = "-";

pub fn command() -> Command {
    let protocols = PROTOCOLS.iter().map(|it| PossibleValue::new(it.key).help(it.label));
    let devices = PROFILES.iter().map(|it| PossibleValue::new(it.key).help(it.label));
    Command::new(NAME)
        .about("Prints the telegrams of a text, a log or a capture as JSON Lines, and a summary at the end")
        .after_help(
            "The text may hold bytes in any spelling, with or without times, names and words around them; a file may \
             also be raw bytes of a line, or a capture (pcap, pcapng).",
        )
        // The last one counts, so that a script can add to the options of another.
        .args_override_self(true)
        .arg(
            choice("protocol", "PROTOCOL", "What the telegrams are, where the bytes shall not tell")
                .value_parser(first("auto", "As the bytes tell").chain(protocols).collect::<Vec<_>>()),
        )
        .arg(
            choice("device", "DEVICE", "In whose words values are told")
                .value_parser(first("none", "Any").chain(devices).collect::<Vec<_>>()),
        )
        .arg(choice("direction", "DIRECTION", "What all telegrams are").value_parser(["auto", "request", "response"]))
        .arg(choice("input", "INPUT", "What the file is").value_parser(Input::KEYS.map(|(key, _)| key)))
        .arg(
            Arg::new("settings")
                .long("settings")
                .value_name("FILE")
                .value_parser(value_parser!(std::path::PathBuf))
                .help("How the devices are set up, as the view Devices saves it: mapping lists, layouts, byte orders"),
        )
        .arg(choice("language", "LANGUAGE", "The language of the output").value_parser(["en"]))
        .arg(
            Arg::new("fields")
                .long("fields")
                .action(ArgAction::SetTrue)
                .help("Adds the tree of fields to each telegram"),
        )
        .arg(
            Arg::new("file")
                .value_name("FILE")
                .value_parser(value_parser!(std::path::PathBuf))
                .default_value(STDIN)
                .help("What is read; - is standard input"),
        )
}

fn choice(name: &'static str, value: &'static str, help: &'static str) -> Arg {
    Arg::new(name).long(name).value_name(value).help(help)
}

fn first(key: &'static str, help: &'static str) -> impl Iterator<Item = PossibleValue> {
    std::iter::once(PossibleValue::new(key).help(help))
}

/// What is printed, or why it cannot be.
pub fn run(matches: &ArgMatches) -> Result<String, String> {
    let chosen = |name: &str| matches.get_one::<String>(name).map_or("", String::as_str);
    let options = Options {
        protocol: Protocol::of(chosen("protocol")),
        device: Profile::of(chosen("device")),
        direction: Direction::of(chosen("direction")),
        settings: match matches.get_one::<std::path::PathBuf>("settings") {
            Some(path) => read_settings(path)?,
            None => Settings::default(),
        },
    };
    let reading = Reading { input: Input::of(chosen("input")).unwrap_or_default(), ..Reading::default() };
    let path = matches.get_one::<std::path::PathBuf>("file").expect("it has a default");
    let report = decode_file(&read(path)?, &reading, options).map_err(|refusal| refusal.to_string())?;
    Ok(json::lines(&report, matches.get_flag("fields")))
}

fn read_settings(path: &Path) -> Result<Settings, String> {
    let text = read(path)?;
    settings::read(&String::from_utf8_lossy(&text)).map_err(|reason| format!("{}: {reason}", path.display()))
}

/// The bytes of the file, or of standard input.
fn read(path: &Path) -> Result<Vec<u8>, String> {
    if path != Path::new(STDIN) {
        return std::fs::read(path).map_err(|error| format!("{} cannot be read: {error}", path.display()));
    }
    let mut bytes = Vec::new();
    let read = std::io::stdin().read_to_end(&mut bytes);
    read.map_err(|error| format!("standard input cannot be read: {error}"))?;
    Ok(bytes)
}
