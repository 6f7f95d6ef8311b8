//! Bytes that are no telegram: a block of registers by itself, a response without its request, what goes by
//! itself on PROFIBUS.

mod tiles;

use buslens::tool::{Certainty, Options, PROFILES, Profile, Settings, blocks, decode, settings};
use proptest::prelude::*;
use tiles::assert_tiled;

fn bytes(hex: &str) -> Vec<u8> {
    hex.split(' ').map(|byte| u8::from_str_radix(byte, 16).expect(byte)).collect()
}

/// Kind and sentence of the best reading.
fn best(device: &str, hex: &str) -> (String, String) {
    let found = blocks(&bytes(hex), Profile::of(device), &Settings::default());
    let best = found.first().unwrap_or_else(|| panic!("nothing for {hex}"));
    (best.kind.to_string(), best.said.to_string())
}

/// Memograph M RSG45 Modbus supplement, 2.6.3 to 2.6.14.
#[test]
fn blocks_of_a_memograph() {
    for (hex, kind, said) in [
        ("00 80 42 A4 F1 DE", "Status and 32-bit float", "82.4724, good"),
        ("02 80 40 F0 00 00", "Status and 32-bit float", "7.5, good, limit 2 violated"),
        ("00 01 40 F0 00 00", "Status and 32-bit float", "7.5, open circuit"),
        ("00 05 40 F0 00 00", "Status and 32-bit float", "7.5, invalid (05h)"),
        ("00 80 40 54 9E 3B C0 00 00 00", "Status and 64-bit float", "82.47239685058594, good"),
        (
            "00 80 42 A4 F1 DE 00 40 40 F0 00 00",
            "Status and 32-bit float, 2 blocks",
            "82.4724, good; 7.5, uncertain",
        ),
        (
            "00 80 3F 80 00 00 00 80 40 00 00 00 00 80 40 40 00 00 00 80 40 80 00 00",
            "Status and 32-bit float, 4 blocks",
            "1, good; 2, good; 3, good; and 1 more",
        ),
        ("42 F6 E9 79", "32-bit float", "123.456"),
        ("42 F6 E9 79 3F C0 00 00", "32-bit float, 2 blocks", "123.456; 1.5"),
        ("40 5E DD 2F 1A 9F BE 77", "64-bit float", "123.456"),
        ("00 80", "Universal channel status", "good"),
        (
            "00 80 00 80 00 41",
            "Universal channel status, 3 blocks",
            "good; good; uncertain, low limit or falling gradient",
        ),
        (
            "01 10 C9 74 23 F0 00 00 00 00 00 04 42 F6 E6 66",
            "Limit",
            "Limit 1, Limit type in-band, Value \u{2212}999999, Span 0 s, Delay 4 s, Value 2 123.45",
        ),
    ] {
        assert_eq!(best("memograph-rsg45", hex), (kind.to_owned(), said.to_owned()), "{hex}");
    }
}

/// Which channel it is, and which of its registers, nobody can tell.
#[test]
fn what_cannot_be_known_is_said() {
    let found = blocks(&bytes("00 80 42 A4 F1 DE"), Profile::of("memograph-rsg45"), &Settings::default());
    assert_eq!(
        found[0].unknown.to_string(),
        "the bytes do not tell the register: Universal channel, Universal channel total, Digital input total, \
         Maths channel or Maths channel total"
    );
    assert_eq!(found[0].certainty, Certainty::Likely);
    // Floats without a state that speaks for them are a guess.
    let found = blocks(&bytes("42 F6 E9 79"), Profile::of("memograph-rsg45"), &Settings::default());
    assert_eq!(found[0].certainty, Certainty::Open);
    assert!(blocks(&[], None, &Settings::default()).is_empty());
}

/// KEB COMBIVERT F5 Modbus operator, 2.2 and 3.
#[test]
fn blocks_of_an_f5_on_modbus() {
    let text = "read_mapping.entries = 2\nread_mapping.entries.0.entry = 00330101h\nread_mapping.entries.1.entry = 00350101h";
    let settings = settings::read(text).unwrap();
    let found = blocks(&bytes("00 03 FA 24"), Profile::of("keb-f5-modbus"), &settings);
    assert_eq!(found[0].said.to_string(), "Status word (Sy.51) = 0003h; Actual speed (Sy.53) = \u{2212}1500");
    let (kind, said) = best("keb-f5-modbus", "00 33 01 01 00 35 01 01");
    assert_eq!(kind, "Read-mapping entry, 2 blocks");
    assert!(said.starts_with("16 bit, set 0, parameter 0033h"), "{said}");
    assert_eq!(best("keb-f5-modbus", "00 03 05 DC").0, "registers of the mapping list");
}

/// KEB COMBIVERT F5 PROFIBUS-DP operator, 7.1 to 7.4.
#[test]
fn blocks_of_an_f5_on_profibus() {
    for (hex, kind) in [
        ("41 00 23 00 00 00 00 00", "Parameter channel"),
        ("C2 00 23 00 08 00 00 30", "Parameter channel"),
        ("41 00 23 00 00 00 00 00 00 03 05 DC", "Data exchange"),
        ("00 03 05 DC", "process input data"),
        ("88 01 0A 0B 05 EB 00", "Set parameters"),
        ("B7 A3 93", "Check configuration"),
        ("00 0C 00 02 05 EB", "Diagnosis"),
    ] {
        assert_eq!(best("keb-f5-profibus", hex).0, kind, "{hex}");
    }
}

/// Pasted with a device chosen, they come out as what they are; so does a response without its request.
#[test]
fn decode_reads_them() {
    let said = |device: &str, text: &str| {
        let options = Options { device: Profile::of(device), ..Options::default() };
        let report = decode(text, options);
        report.detail(0).expect("something").meaning().sentence()
    };
    assert_eq!(
        said("memograph-rsg45", "00 80 42 A4 F1 DE"),
        "Status and 32-bit float by itself: 82.4724, good"
    );
    assert_eq!(
        said("memograph-rsg45", "01 03 06 00 80 42 A4 F1 DE B0 F8"),
        "Unit 1 answers, to a request that is not here: 82.4724, good (status and 32-bit float)"
    );
    assert_eq!(
        said("memograph-rsg45", "01 03 0A 00 80 40 54 9E 3B C0 00 00 00 91 3E"),
        "Unit 1 answers, to a request that is not here: 82.47239685058594, good (status and 64-bit float)"
    );
    // A telegram stays one, even with a fault.
    assert_eq!(
        said("memograph-rsg45", "01 03 00 C8 00 03 84 36"),
        "Ask unit 1 for Universal channel 1, but the checksum is wrong"
    );
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(500) })]

    #[test]
    fn any_bytes_tile(bytes in proptest::collection::vec(any::<u8>(), 0..60), device in proptest::option::of(proptest::sample::select(PROFILES))) {
        for reading in blocks(&bytes, device, &Settings::default()) {
            assert_tiled(&reading.fields, bytes.len());
            prop_assert!(!reading.said.to_string().is_empty());
            prop_assert!(reading.bits > 0 || device.is_some());
        }
    }
}

/// The device that is chosen weighs on what bytes are; what a check proves, it does not change.
#[test]
fn the_device_decides_with() {
    let protocol = |device: &str, text: &str| {
        let options = Options { device: Profile::of(device), ..Options::default() };
        decode(text, options).telegrams[0].choice.protocol.key
    };
    assert_eq!(protocol("keb-f5-profibus", "90 80 20 00 01 00 00 00"), "profibus-parameter-channel");
    assert_eq!(protocol("keb-f5-profibus", "00 00 20 00 01 00 00 00"), "profibus-parameter-channel");
    assert_ne!(protocol("memograph-rsg45", "41 00 23 00 00 00 00 00"), "profibus-parameter-channel");
    assert_eq!(protocol("keb-f5-profibus", "01 03 00 C8 00 03 84 35"), "modbus-rtu");
    assert_eq!(protocol("", "41 00 23 00 00 00 00 00"), "profibus-parameter-channel");
}
