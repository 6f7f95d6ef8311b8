//! The command as others run it: arguments in, text and exit code out.

use std::io::Write;
use std::process::{Command, Output, Stdio};

use buslens::tool::{Options, PROFILES, PROTOCOLS, decode_file, json};
use serde_json::Value;

const TELEGRAMS: &str = "01 03 00 C8 00 03 84 35\n01 03 06 00 80 42 A6 FE C1 BF F1\n";

fn buslens(arguments: &[&str], input: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_buslens"));
    command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    // Who refuses its arguments does not read.
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    child.wait_with_output().unwrap()
}

fn printed(output: &Output) -> String {
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn refused(output: &Output, code: i32) -> String {
    assert_eq!((output.status.code(), output.stdout.len()), (Some(code), 0));
    String::from_utf8(output.stderr.clone()).unwrap()
}

#[test]
fn it_prints_what_the_library_says() {
    let report = decode_file(TELEGRAMS.as_bytes(), &Default::default(), Options::default()).unwrap();
    assert_eq!(printed(&buslens(&["decode"], TELEGRAMS)), json::lines(&report, false));
    assert_eq!(printed(&buslens(&["decode", "--fields", "-"], TELEGRAMS)), json::lines(&report, true));
}

#[test]
fn options_are_followed() {
    let folder = tempfile::tempdir().unwrap();
    let [file, settings] = ["telegrams.txt", "settings.txt"].map(|name| folder.path().join(name));
    std::fs::write(&file, "00 80 42 A4 F1 DE").unwrap();
    std::fs::write(&settings, "inputs = 8\n").unwrap();
    let [file, settings] = [&file, &settings].map(|path| path.to_str().unwrap());
    let all = ["decode", "--device=memograph-rsg45", "--protocol", "modbus-pdu", "--direction", "response"];
    let more = ["--input", "text", "--language", "en", "--settings", settings, file];
    let text = printed(&buslens(&[&all[..], &more[..]].concat(), ""));
    let first: Value = serde_json::from_str(text.lines().next().unwrap()).unwrap();
    assert_eq!(first["protocol"], "modbus-pdu", "{text}");
    // The last one counts.
    let again = printed(&buslens(&["decode", "--protocol", "modbus-tcp", "--protocol", "auto"], TELEGRAMS));
    assert!(again.contains("modbus-rtu"), "{again}");
}

#[test]
fn what_cannot_be_read_is_a_sentence() {
    let reason = refused(&buslens(&["decode", "nowhere/telegrams.txt"], ""), 1);
    assert!(reason.starts_with("buslens: nowhere/telegrams.txt cannot be read: "), "{reason}");
    let folder = tempfile::tempdir().unwrap();
    let settings = folder.path().join("settings.txt");
    std::fs::write(&settings, "colour = 1\n").unwrap();
    let reason = refused(&buslens(&["decode", "--settings", settings.to_str().unwrap()], TELEGRAMS), 1);
    assert!(reason.contains("colour"), "{reason}");
}

#[test]
fn what_is_not_understood_is_said_with_what_is() {
    let reason = refused(&buslens(&["decode", "--protocol", "telex"], ""), 2);
    assert!(reason.contains("telex") && reason.contains("modbus-rtu"), "{reason}");
    let reason = refused(&buslens(&["decode", "--colour"], ""), 2);
    assert!(reason.contains("--colour"), "{reason}");
    let reason = refused(&buslens(&["decode", "one.txt", "two.txt"], ""), 2);
    assert!(reason.contains("two.txt"), "{reason}");
}

#[test]
fn help_lists_every_protocol_and_device() {
    let help = printed(&buslens(&["decode", "--help"], ""));
    let keys = PROTOCOLS.iter().map(|it| it.key).chain(PROFILES.iter().map(|it| it.key));
    for key in keys.chain(["--settings", "--fields", "--input", "--direction"]) {
        assert!(help.contains(key), "{key} is missing in\n{help}");
    }
    assert!(printed(&buslens(&["--help"], "")).contains("decode"));
}
