//! What the telegrams of a log say of the devices behind them: which they are, and how their values go.

use buslens::field::hex;
use buslens::tool::log::{Log, Reading};
use buslens::tool::{Options, Profile, Settings, decode, proposals, setup, value_findings};
use buslens::walk::CRC_16_MODBUS;

/// A telegram of Modbus RTU with its check.
fn rtu(text: &str) -> String {
    let mut bytes: Vec<u8> = text.split(' ').map(|byte| u8::from_str_radix(byte, 16).expect(byte)).collect();
    let check = CRC_16_MODBUS.wire(&bytes);
    bytes.extend_from_slice(&(check as u16).to_be_bytes());
    hex(&bytes)
}

fn log(telegrams: &[&str]) -> String {
    telegrams.iter().map(|telegram| rtu(telegram) + "\n").collect()
}

/// Reading universal channel 1 of unit 1 with this status and value.
fn channel(status: &str, value: &str) -> [String; 2] {
    ["01 03 00 C8 00 03".to_owned(), format!("01 03 06 {status} {value}")]
}

fn findings(device: &str, text: &str) -> Vec<(&'static str, String)> {
    let report = decode(text, Options { device: Profile::of(device), ..Options::default() });
    value_findings(&report).into_iter().map(|finding| (finding.code, finding.text.to_string())).collect()
}

fn proposed(text: &str) -> Vec<(Option<u8>, &'static str, String)> {
    let report = decode(text, Options::default());
    proposals(&report).into_iter().map(|it| (it.unit, it.device.key, it.text.to_string())).collect()
}

/// The reason is one, and a drive on PROFIBUS does not speak Modbus.
#[test]
fn what_is_proposed_has_a_reason() {
    let own_functions = log(&[
        "02 64 00 C8 00 04",
        "02 64 10 69 0D 45 52 BB 22 D0 BB FA C9 BC 7F E4 6E 96 7C",
        "02 65 00 C8 00 01 0C 69 47 7A",
        "02 65 00 C8 00 01",
    ]);
    let said = proposed(&own_functions);
    assert_eq!(said.len(), 1, "{said:?}");
    assert_eq!(said[0].2, "unit 2 reads well as KEB COMBIVERT F5 on Modbus: 4 telegrams that only it knows");
    // Its parameters have the same numbers on both.
    let parameters = log(&["05 04 20 32 00 03", "05 04 06 22 28 E0 55 2B C0"]).repeat(3);
    assert!(proposed(&parameters).iter().all(|it| it.1 != "keb-f5-profibus"), "{:?}", proposed(&parameters));
}

/// A recorder and a drive on one line, each in the words of its manual.
#[test]
fn units_are_read_as_their_own_devices() {
    let text =
        log(&["01 03 00 C8 00 03", "01 03 06 00 80 42 A4 F1 DE", "03 03 20 34 00 01", "03 03 02 05 DC"]);
    let report = decode(&text, two_devices());
    let said = |index: usize| report.detail(index).unwrap().said.to_string();
    assert!(said(1).contains("Universal channel 1 = 82.4724"), "{}", said(1));
    assert!(said(3).contains("Set speed"), "{}", said(3));
    assert!(proposals(&report).is_empty());
    // What nobody named is read as the device that is chosen for all.
    let mut settings = two_devices().settings;
    setup::name_unit(&mut settings, 1, None);
    let device = Profile::of("memograph-rsg45");
    let report = decode(&text, Options { device, settings, ..Options::default() });
    let said = |index: usize| report.detail(index).unwrap().said.to_string();
    assert!(said(1).contains("Universal channel 1") && said(3).contains("Set speed"), "{}", said(3));
    // In a log, each unit has its device in the summary.
    let digest = {
        let log = Log::read(text.as_bytes(), &Reading::default(), two_devices()).unwrap();
        log.digest(&text.as_bytes(), &[])
    };
    let devices: Vec<&str> = digest.units.iter().map(|unit| unit.device.as_str()).collect();
    assert_eq!(devices, ["Endress+Hauser Memograph M RSG45", "KEB COMBIVERT F5 on Modbus"]);
}

fn two_devices() -> Options {
    let mut settings = Settings::default();
    setup::name_unit(&mut settings, 1, Profile::of("memograph-rsg45"));
    setup::name_unit(&mut settings, 3, Profile::of("keb-f5-modbus"));
    Options { settings, ..Options::default() }
}

#[test]
fn a_memograph_proposes_itself() {
    let text = log(&[
        "01 03 00 C8 00 03",
        "01 03 06 00 80 42 A4 F1 DE",
        "01 03 00 CB 00 03",
        "01 03 06 00 80 40 F0 00 00",
    ]);
    let [(unit, device, said)] = proposed(&text).try_into().expect("one proposal");
    assert_eq!((unit, device), (Some(1), "memograph-rsg45"));
    assert_eq!(said, "unit 1 reads well as Endress+Hauser Memograph M RSG45: 2 blocks with good status");
    // Chosen, there is nothing to propose.
    let chosen = Options { device: Profile::of("memograph-rsg45"), ..Options::default() };
    assert!(proposals(&decode(&text, chosen)).is_empty());
}

#[test]
fn one_unit_is_a_recorder_and_another_a_drive() {
    let text = log(&[
        "01 03 00 C8 00 03",
        "01 03 06 00 80 42 A4 F1 DE",
        "02 65 5F 32 00 02 08 00 33 01 01 00 35 01 01",
        "02 65 5F 32 00 02",
        "02 03 20 33 00 01",
        "02 03 02 00 03",
        "01 03 00 C8 00 03",
        "01 03 06 00 80 42 A4 F1 DF",
    ]);
    let devices: Vec<_> = proposed(&text).into_iter().map(|(unit, device, _)| (unit, device)).collect();
    assert_eq!(devices, [(Some(1), "memograph-rsg45"), (Some(2), "keb-f5-modbus")]);
}

/// What fits no device, or any, proposes none.
#[test]
fn nothing_is_proposed_without_evidence() {
    assert!(proposed("").is_empty());
    assert!(proposed(&log(&["01 03 00 C8 00 03"])).is_empty());
    assert!(
        proposed(&log(&[
            "01 03 00 00 00 02",
            "01 03 04 00 01 00 02",
            "01 06 00 10 00 05",
            "01 06 00 10 00 05"
        ]))
        .is_empty()
    );
    assert!(proposed(&log(&["01 03 9C 40 00 0A", "07 04 00 00 00 02", "07 04 04 00 00 00 01"])).is_empty());
}

#[test]
fn an_f5_on_profibus_proposes_itself() {
    let text = "68 0B 0B 68 82 83 08 3E 3C 00 0C 00 02 05 EB 85 16";
    let devices: Vec<_> = proposed(text).into_iter().map(|(unit, device, _)| (unit, device)).collect();
    assert_eq!(devices, [(Some(3), "keb-f5-profibus")]);
}

#[test]
fn a_state_that_turns_is_found() {
    let telegrams: Vec<String> = [
        channel("00 80", "42 A4 F1 DE"),
        channel("00 80", "42 A4 F1 DF"),
        channel("00 01", "42 A4 F1 DF"),
        channel("00 80", "42 A4 00 00"),
    ]
    .concat();
    let telegrams: Vec<&str> = telegrams.iter().map(String::as_str).collect();
    assert_eq!(
        findings("memograph-rsg45", &log(&telegrams)),
        [
            ("worse", "Universal channel 1 of unit 1 turned from good to open circuit".to_owned()),
            ("better", "Universal channel 1 of unit 1 turned from open circuit to good".to_owned()),
        ]
    );
}

#[test]
fn a_value_that_stands_still_is_found() {
    let moving = ["42 A4 00 00", "42 A5 00 00", "42 A6 00 00", "42 A7 00 00"];
    let values = moving.iter().chain([&"42 A7 00 00"; 12]);
    let telegrams: Vec<String> = values.flat_map(|value| channel("00 80", value)).collect();
    let telegrams: Vec<&str> = telegrams.iter().map(String::as_str).collect();
    let [(code, text)] = findings("memograph-rsg45", &log(&telegrams)).try_into().expect("one finding");
    assert_eq!(
        (code, text.as_str()),
        ("frozen", "Universal channel 1 of unit 1 stands at 83.5 for 13 readings, after it changed before")
    );
    // A value that never moved is a set point.
    let still: Vec<String> =
        [&"42 A7 00 00"; 15].into_iter().flat_map(|value| channel("00 80", value)).collect();
    let still: Vec<&str> = still.iter().map(String::as_str).collect();
    assert!(findings("memograph-rsg45", &log(&still)).is_empty());
}

#[test]
fn what_is_no_value_is_found() {
    let telegrams = channel("00 80", "7F C0 00 00");
    let telegrams: Vec<&str> = telegrams.iter().map(String::as_str).collect();
    let [(code, text)] = findings("memograph-rsg45", &log(&telegrams)).try_into().expect("one finding");
    assert_eq!(code, "no-value");
    assert!(text.contains("NaN"), "{text}");
}

#[test]
fn a_refusal_says_what_was_asked_for() {
    let text = log(&["01 03 23 3B 00 01", "01 83 02", "01 03 23 3B 00 01", "01 83 02"]);
    let report = decode(&text, Options { device: Profile::of("keb-f5-modbus"), ..Options::default() });
    let found = value_findings(&report);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].evidence, [1, 3]);
    assert_eq!(
        found[0].text.to_string(),
        "unit 1 rejects reading Motorpoti ramp time (OP.59): exception 2, illegal data address; of the request: \
         Motorpoti ramp time has 4 bytes; the telegram carries 2 of them"
    );
}

#[test]
fn a_write_without_effect_is_found() {
    let text = log(&["01 06 04 B3 00 01", "01 06 04 B3 00 01", "01 03 04 B3 00 01", "01 03 02 00 00"]);
    assert_eq!(
        findings("memograph-rsg45", &text),
        [("no-effect", "Digital input 4 of unit 1 was written as on, but is read as off".to_owned())]
    );
}

#[test]
fn steps_out_of_order_are_found() {
    let start = ["05 10 0C 10 00 01 02 01 02", "05 10 0C 10 00 01"];
    let name = ["05 10 0C 10 00 03 06 04 02 4E 61 6D 65", "05 10 0C 10 00 03"];
    let found = findings("memograph-rsg45", &log(&[start, name].concat()));
    assert_eq!(found, [("out-of-order", "batch 2 runs: this is possible only while it does not".to_owned())]);
    // In their order nothing is to be said.
    assert!(findings("memograph-rsg45", &log(&[name, start].concat())).is_empty());
}

/// A corrected telegram speaks the device's words.
#[test]
fn hypotheses_speak_the_devices_words() {
    let text = "01 03 00 C8 00 03 84 35\n01 03 06 00 80 42 A4 F1 DF B0 F8";
    let report = decode(text, Options { device: Profile::of("memograph-rsg45"), ..Options::default() });
    let right = report.explanations(1).into_iter().find(|it| it.hypothesis.bytes[8] == 0xDE).expect("found");
    assert_eq!(right.said.to_string(), "unit 1 answers: Universal channel 1 = 82.4724, good");
}
