//! The commands of the Memograph M RSG45: how they are built, the limits of each, and what holds for
//! all of them.

mod tiles;

use buslens::device::{Access, Area, Content, New, PROFILES, Profile, Registers, Settings};
use buslens::field::{Field, Name, Span, Value, leaves, problems};
use buslens::walk::{self, Deviations, Telegram, form, read};
use proptest::prelude::*;
use tiles::assert_tiled;

#[test]
fn telegrams_are_built_in_the_words_of_the_device() {
    for (key, entries, bytes) in [
        ("relay", &[("relay", "6"), ("state", "active")][..], "06 01"),
        ("event_text", &[("text", "ABCDE")], "41 42 43 44 45 20"),
        ("batch", &[("function", "start batch"), ("batch", "2")], "01 02"),
        (
            "batch",
            &[("function", "stop batch"), ("batch", "2"), ("user", "IDSPS;RemoteX")],
            "02 02 49 44 53 50 53 3B 52 65 6D 6F 74 65 58 20",
        ),
        (
            "batch",
            &[("function", "set preset counter"), ("batch", "2"), ("preset", "12.345")],
            "06 02 31 32 2E 33 34 35",
        ),
        ("limit", &[("function", "open editing")], "01 2A"),
        ("limit", &[("function", "accept changes")], "02 2A"),
        (
            "limit",
            &[("function", "change limit"), ("limit", "3"), ("new_values", "5.7;10")],
            "03 03 35 2E 37 3B 31 30",
        ),
        (
            "limit",
            &[("function", "give reason"), ("reason", "Reason why!")],
            "05 01 52 65 61 73 6F 6E 20 77 68 79 21 20",
        ),
        ("limit", &[("function", "read limits back"), ("first_limit", "off")], "04 FF"),
    ] {
        assert_eq!(build(key, entries), hex(bytes), "{key}: {entries:?}");
    }
}

#[test]
fn texts_keep_their_limits() {
    let batch =
        |function, key, text: &str| codes("batch", &build("batch", &[("function", function), (key, text)]));
    let change =
        |text| codes("limit", &build("limit", &[("function", "change limit"), ("new_values", text)]));
    let long = "x".repeat(41);

    for (key, function) in
        [("identifier", "set batch identifier"), ("name", "set batch name"), ("number", "set batch number")]
    {
        assert_eq!(batch(function, key, &long[..30]), [""; 0]);
        assert_eq!(batch(function, key, &long[..31]), ["text-too-long"]);
    }
    for (text, found) in [
        ("", &[][..]),
        ("12345678;12345678901234567890", &[]),
        (";", &[]),
        ("IDSPS", &["separator-missing"]),
        ("123456789;x", &["text-too-long"]),
        ("x;123456789012345678901", &["text-too-long"]),
        ("123456789;123456789012345678901", &["text-too-long"; 3]),
        ("Ü;x", &["not-ascii"]),
    ] {
        assert_eq!(batch("start batch", "user", text), found, "{text}");
        assert_eq!(batch("stop batch", "user", text), found, "{text}");
    }
    for (text, found) in [
        ("1.23E-2", &[][..]),
        ("+5", &[]),
        ("12345678", &[]),
        ("123456789", &["text-too-long"]),
        ("0", &["out-of-range"]),
        ("-1", &["out-of-range"]),
        ("1,5", &["not-a-number"]),
        ("inf", &["not-a-number"]),
        ("1e99", &["not-a-number"]),
        ("", &["data-missing"]),
        (" ", &["data-missing"]),
    ] {
        assert_eq!(batch("set preset counter", "preset", text), found, "{text}");
    }
    for (text, found) in [
        ("5.22;;60", &[][..]),
        ("5.34", &[]),
        (";;10", &[]),
        ("20;;;50", &[]),
        ("-1e6;60;99999;-0.5", &[]),
        ("1;;;2;", &[]),
        ("x", &["not-a-number"]),
        ("1;1.5", &["not-a-number"]),
        ("1;61", &["out-of-range"]),
        ("1;;100000", &["out-of-range"]),
        ("1;;99999999999", &["out-of-range"]),
        ("1;;;nan", &["not-a-number"]),
        ("x;x;x;x;x", &["not-a-number", "not-a-number", "not-a-number", "not-a-number", "too-many-values"]),
        ("", &["data-missing"]),
        ("0000000000000000000000000000001", &["text-too-long"]),
    ] {
        assert_eq!(change(text), found, "{text}");
    }
    let reason = |text| codes("limit", &build("limit", &[("function", "give reason"), ("reason", text)]));
    assert_eq!(reason(&long[..30]), [""; 0]);
    assert_eq!(reason(&long[..31]), ["text-too-long"]);
    assert_eq!(reason("tab\\x09"), ["not-ascii"]);
    let event = |text| codes("event_text", &build("event_text", &[("text", text)]));
    assert_eq!(event(&long[..40]), [""; 0]);
    assert_eq!(event(&long[..39]), [""; 0]);
    assert_eq!(event(&long), ["text-too-long"]);
}

#[test]
fn numbers_keep_their_limits() {
    for (key, bytes, found) in [
        ("relay", "00 01", &["out-of-range"][..]),
        ("relay", "0C 00", &[]),
        ("relay", "0D 02", &["out-of-range"; 2]),
        ("batch", "01 00", &["out-of-range"]),
        ("batch", "01 05", &["out-of-range"]),
        ("batch", "00 01", &["unknown-function"]),
        ("batch", "07 01 41 42", &["unknown-function"]),
        ("limit", "00 2A", &["unknown-function"]),
        ("limit", "06 2A", &["unknown-function"]),
        ("limit", "01 01", &["other-padding"]),
        ("limit", "02 2A 20 20", &["unexpected-bytes"]),
        ("limit", "03 00 31 20", &["out-of-range"]),
        ("limit", "03 3C 31 20", &[]),
        ("limit", "03 3D 31 20", &["out-of-range"]),
        ("limit", "04 00", &["out-of-range"]),
        ("limit", "04 3C", &[]),
        ("limit", "04 3D", &["out-of-range"]),
        ("limit", "04 FE", &["out-of-range"]),
        ("limit", "04 FF", &[]),
        ("limit", "05 FF 41 42", &[]),
        ("limit", "05 01 41", &["truncated"]),
        ("limit", "05", &["truncated"]),
    ] {
        assert_eq!(codes(key, &hex(bytes)), found, "{key}: {bytes}");
    }
    for (register, bytes, found) in [
        (3216, "00 00", &[][..]),
        (3216, "3C 01 00 00 00 00 00 3C 00 01 86 9F 00 00 00 00", &[]),
        (3216, "3D 01 00 00 00 00 00 3D 00 01 86 A0 00 00 00 00", &["out-of-range"; 3]),
        (3216, "01 01 00 00 00 00 00 00", &["truncated"]),
        (3152, "10 00", &["reserved-bits"]),
        (3088, "00 00", &[]),
        (3088, "00 00 00 01", &[]),
        (3088, "00 00 00 01 00 00 00 00", &[]),
        (3088, "00", &["truncated"]),
        (1241, "00 10", &["reserved-bits"]),
        (1200, "00 02", &["out-of-range"]),
    ] {
        assert_eq!(say(Access::Read, register, &hex(bytes)).1, found, "{register}: {bytes}");
    }
}

#[test]
fn the_last_channels_are_where_the_manual_has_them() {
    for (key, last) in [
        ("universal_value", 317),
        ("universal_total", 917),
        ("digital_state", 1219),
        ("digital_total", 1357),
        ("maths_value", 1533),
        ("maths_total", 1733),
        ("universal_value_plain", 4078),
        ("maths_value_plain", 4222),
        ("universal_value_double", 5395),
        ("universal_total_double", 5995),
        ("digital_total_double", 6395),
        ("maths_value_double", 6555),
        ("maths_total_double", 6755),
        ("universal_status", 6839),
        ("maths_status", 6911),
        ("universal_value_plain_double", 8156),
        ("maths_value_plain_double", 8444),
    ] {
        let area = area(key);
        assert_eq!(area.last() + 1 - area.stride, last, "{key}");
    }
}

#[test]
fn every_named_function_exists() {
    for key in ["batch", "limit"] {
        let shown = form::form(&mut *written(key), &Deviations::default());
        let names = shown.entries[0].spec.names;
        assert!(names.len() > 1, "{key}");
        for name in names {
            let bytes = build(key, &[("function", name.label)]);
            assert_eq!(u64::from(bytes[0]), name.value);
            assert!(!codes(key, &bytes).contains(&"unknown-function"), "{key}: {}", name.label);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(1000) })]

    #[test]
    fn any_bytes_tile_and_are_written_again(new in any_telegram(), bytes in any_bytes()) {
        let mut telegram = new(&Settings::default());
        let reading = read(&mut *telegram, &bytes);
        assert_tiled(&reading.fields, bytes.len());
        let deviations = reading.deviations(&mut *telegram);
        prop_assert_eq!(walk::write(&mut *telegram, &deviations), bytes);
    }

    #[test]
    fn a_form_gives_the_same_telegram(new in any_telegram(), bytes in any_bytes()) {
        let mut telegram = new(&Settings::default());
        let deviations = read(&mut *telegram, &bytes).deviations(&mut *telegram);
        let shown = form::form(&mut *telegram, &deviations);
        let mut filled = new(&Settings::default());
        let entered = form::fill(&mut *filled, &shown).expect("a form fills what it was made of");
        prop_assert_eq!(&form::form(&mut *filled, &entered), &shown);
        prop_assert_eq!(walk::write(&mut *filled, &entered), bytes);
    }

    /// Samples of telegrams without text: texts have rules that no sampler knows.
    #[test]
    fn a_sample_has_no_problems(new in any_telegram(), seed: u64) {
        let mut telegram = new(&Settings::default());
        let mut state = seed;
        walk::sample(&mut *telegram, &mut |most| {
            state = state.wrapping_mul(0x5851_F42D_4C95_7F2D).wrapping_add(0x1405_7B7E_F767_814F);
            (state >> 32) % most.saturating_add(1)
        });
        let bytes = walk::write(&mut *telegram, &Deviations::default());
        let mut again = new(&Settings::default());
        let reading = read(&mut *again, &bytes);
        assert_tiled(&reading.fields, bytes.len());
        let has_text = leaves(&reading.fields).iter().any(|leaf| matches!(leaf.value, Value::Text(_)));
        // Any byte may pad.
        let wrong = problems(&reading.fields).into_iter().find(|problem| problem.code != "other-padding");
        prop_assert!(has_text || wrong.is_none(), "{:?}", reading.fields);
        prop_assert!(reading.deviations(&mut *again).is_empty());
        prop_assert_eq!(walk::write(&mut *again, &Deviations::default()), bytes);
    }

    #[test]
    fn what_the_manual_allows_has_no_problems(command in valid_command()) {
        let (key, function, number_key, number, text_key, text) = command;
        let number = number.to_string();
        let bytes = build(key, &[("function", function), (number_key, &number), (text_key, &text)]);
        prop_assert!(bytes.len().is_multiple_of(2));
        let empty = text.bytes().all(|byte| matches!(byte, b';' | b' ')) && text_key == "new_values";
        prop_assert_eq!(codes(key, &bytes), if empty { vec!["nothing-new"] } else { vec![] });
        let said = say(Access::Write, area(key).from, &bytes).0;
        prop_assert!(text.is_empty() || said[2].contains(&text), "{said:?}");
    }
}

type Command = (&'static str, &'static str, &'static str, u8, &'static str, String);

/// Commands with texts as the manual allows them.
fn valid_command() -> impl Strategy<Value = Command> {
    const FLOAT: &str = "[+-]?[0-9]{1,3}(\\.[0-9]{1,2})?(e-?[0-9])?";
    let new_values = format!("({FLOAT})?;([0-5]?[0-9])?;([0-9]{{1,5}})?(;{FLOAT})?");
    let batch = |function, text_key, texts: &str| {
        (1..=4u8, proptest::string::string_regex(texts).unwrap())
            .prop_map(move |(number, text)| ("batch", function, "batch", number, text_key, text))
    };
    // No backslash, which forms write as an escape.
    prop_oneof![
        batch("start batch", "user", "([!-:<-Z]{1,8};[ -Z]{0,19}[!-Z])?"),
        batch("stop batch", "user", "([!-:<-Z]{1,8};[ -Z]{0,19}[!-Z])?"),
        batch("set batch identifier", "identifier", "[ -Z]{0,30}"),
        batch("set batch name", "name", "[a-z ]{0,30}"),
        batch("set batch number", "number", "[ -Z]{0,30}"),
        batch("set preset counter", "preset", "[1-9]{1,2}(\\.[0-9]{1,2})?(E-?[0-9])?"),
        (1..=60u8, proptest::string::string_regex(&new_values).unwrap()).prop_map(|(number, text)| {
            // The values together may be longer than the registers.
            let text = if text.len() > 30 { "1".to_owned() } else { text };
            ("limit", "change limit", "limit", number, "new_values", text)
        }),
        (any::<u8>(), "[ -Z]{0,30}")
            .prop_map(|(number, text)| { ("limit", "give reason", "second_byte", number, "reason", text) }),
    ]
}

fn any_telegram() -> impl Strategy<Value = New> {
    proptest::sample::select(profile().areas.iter().flat_map(telegrams).collect::<Vec<_>>())
}

/// Bytes of any length, most of them with a function that exists.
fn any_bytes() -> impl Strategy<Value = Vec<u8>> {
    (proptest::collection::vec(any::<u8>(), 0..100), proptest::option::of(0..8u8)).prop_map(
        |(mut bytes, function)| {
            if let (Some(first), Some(function)) = (bytes.first_mut(), function) {
                *first = function;
            }
            bytes
        },
    )
}

fn profile() -> &'static Profile {
    PROFILES.iter().find(|profile| profile.key == "memograph-rsg45").expect("the profile is listed")
}

fn area(key: &str) -> &'static Area {
    profile().areas.iter().find(|area| area.spec.key == key).expect(key)
}

fn telegrams(area: &Area) -> Vec<New> {
    match area.content {
        Content::Telegram { read, write } => read.into_iter().chain(write).collect(),
        _ => Vec::new(),
    }
}

/// The empty telegram that is written to the area `key`.
fn written(key: &str) -> Box<dyn Telegram> {
    match area(key).content {
        Content::Telegram { write: Some(new), .. } => new(&Settings::default()),
        _ => panic!("{key} is not written as a telegram"),
    }
}

/// The codes of what is wrong with `bytes` written to the area `key`.
fn codes(key: &str, bytes: &[u8]) -> Vec<&'static str> {
    let fields = read(&mut *written(key), bytes).fields;
    problems(&fields).iter().map(|problem| problem.code).collect()
}

/// The bytes of a telegram to the area `key` with these entries of its form, the function first.
fn build(key: &str, entries: &[(&str, &str)]) -> Vec<u8> {
    let mut telegram = written(key);
    for (entry, text) in entries {
        let mut shown = form::form(&mut *telegram, &Deviations::default());
        let found = shown.entries.iter_mut().find(|shown| shown.spec.key == *entry).expect(entry);
        match &mut found.content {
            form::Content::Choice { raw, .. } => {
                let named = |name: &&Name| name.label == *text;
                *raw = found.spec.names.iter().find(named).expect(text).value;
            }
            form::Content::Number { text: shown, .. } | form::Content::Text { text: shown } => {
                *shown = (*text).to_owned();
            }
            other => panic!("{entry}: {other:?}"),
        }
        form::fill(&mut *telegram, &shown).expect(text);
    }
    walk::write(&mut *telegram, &Deviations::default())
}

/// What the registers from `register` on say by the table, and the codes of what is wrong with them.
fn say(access: Access, register: u16, bytes: &[u8]) -> (Vec<String>, Vec<&'static str>) {
    let count = bytes.len().div_ceil(2);
    let span = Span::new(0, bytes.len());
    let registers =
        Registers { start: register, count, width: 2, access, single: false, values: Some(bytes), span };
    let said = profile().registers(&registers, &Settings::default());
    let fields = said.blocks.iter().map(|block| &block.field);
    let values = fields.flat_map(|field| leaves(std::slice::from_ref(field))).map(Field::value_text);
    (values.collect(), said.problems().map(|problem| problem.code).collect())
}

fn hex(text: &str) -> Vec<u8> {
    text.split(' ').map(|byte| u8::from_str_radix(byte, 16).expect(byte)).collect()
}
