//! A file that no registry names is dead: each function code's file must be in its registry, and
//! what the registries hold must be consistent.

use std::collections::BTreeSet;
use std::path::Path;

use buslens::field::{self, Direction, Value};
use buslens::frame::profibus_fdl::Fdl;
use buslens::modbus::{DIALECTS, KINDS, OTHER_KINDS};
use buslens::profibus;
use buslens::tool::examples::{EXAMPLES, Group};
use buslens::tool::{Options, PROFILES, PROTOCOLS, Protocol, Verdict, decode};
use buslens::walk::{self, Deviations};

/// Files below `src/modbus` that are no function code.
const SHARED: &[&str] = &["bare", "choice", "coils", "dialects", "file_records", "length", "registers"];

#[test]
fn every_function_code_file_is_listed() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/modbus");
    let registry = std::fs::read_to_string(source.join("mod.rs")).unwrap();
    let listed =
        |name: &str| ["REQUEST", "RESPONSE"].map(|kind| registry.contains(&format!("&{name}::{kind},")));
    for folder in ["", "keb/"] {
        for entry in std::fs::read_dir(source.join(folder)).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_stem().unwrap().to_str().unwrap();
            let in_one_line = registry.contains(&format!("&{name}::RESPONSE"));
            // Folders of their own kind, the registry, and what function codes share.
            if ["mod", "keb"].contains(&name) || SHARED.contains(&name) {
                continue;
            }
            let name = format!("{}{name}", folder.replace('/', "::"));
            assert!(listed(&name) == [true, true] || in_one_line, "{name} is in no registry");
        }
    }
}

#[test]
fn every_encapsulated_interface_is_listed() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/modbus/encapsulated_interface");
    let registry = std::fs::read_to_string(source.join("mod.rs")).unwrap();
    for entry in std::fs::read_dir(source).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap();
        assert!(name == "mod" || registry.contains(&format!("&{name}::INTERFACE")), "{name} is not listed");
    }
}

#[test]
fn kinds_are_told_apart() {
    let mut keys = BTreeSet::new();
    let mut functions = BTreeSet::new();
    for kind in KINDS {
        assert!(functions.insert((kind.function, kind.direction == Direction::Request)));
        let suffix = format!("_{}", kind.direction.key());
        assert!(kind.spec.key.ends_with(&suffix), "{}", kind.spec.key);
    }
    for kind in KINDS.iter().chain(OTHER_KINDS) {
        assert!(keys.insert(kind.spec.key), "{} twice", kind.spec.key);
        assert!(!kind.spec.note.is_empty(), "{} has no note", kind.spec.key);
    }
}

#[test]
fn dialects_say_the_same_in_other_ways() {
    let mut keys = BTreeSet::new();
    for dialect in DIALECTS {
        assert!(keys.insert(dialect.key), "{} twice", dialect.key);
        for kind in dialect.kinds {
            let standard = KINDS.iter().find(|standard| standard.spec.key == kind.spec.key).unwrap();
            assert_eq!((kind.function, kind.direction), (standard.function, standard.direction));
        }
    }
}

#[test]
fn every_function_code_has_an_example_and_the_broken_ones_are_broken() {
    let mut functions = BTreeSet::new();
    let mut keys = BTreeSet::new();
    for example in EXAMPLES {
        assert!(keys.insert(example.key), "{} twice", example.key);
        let device = PROFILES.iter().copied().find(|profile| profile.key == example.device);
        assert!(device.is_some() || example.device.is_empty(), "{}", example.device);
        let report = decode(example.text, Options { device, ..Options::default() });
        let mut problems = 0;
        for (index, telegram) in report.telegrams.iter().enumerate() {
            let detail = report.detail(index).unwrap();
            problems += detail.problems().len() + telegram.line.remarks.len();
            problems += usize::from(matches!(telegram.verdict, Verdict::Wrong | Verdict::Unchecked));
            functions.extend(detail.function.filter(|_| example.group != Group::Broken));
        }
        assert_eq!(problems > 0, (example.group == Group::Broken), "{}: {problems} problems", example.key);
    }
    let listed: BTreeSet<u8> = KINDS.iter().map(|kind| kind.function).collect();
    assert_eq!(functions, listed);
}

/// The numbers of the standard (V1.1b3, 6.8.1), each with its own meaning.
#[test]
fn the_diagnostics_are_those_of_the_standard() {
    let said = |number: u16, direction: Direction| {
        let kind = KINDS.iter().find(|kind| kind.function == 8 && kind.direction == direction).unwrap();
        let mut pdu = kind.pdu(DIALECTS[0]);
        let [high, low] = number.to_be_bytes();
        let fields = walk::read(&mut pdu, &[8, high, low, 0, 0]).fields;
        field::leaves(&fields)
            .into_iter()
            .filter_map(|leaf| match leaf.value {
                Value::Selector { chosen, .. } => Some(chosen.label.to_owned()),
                _ => None,
            })
            .nth(1)
            .unwrap()
    };
    let names = [
        (0, "return query data"),
        (1, "restart communications"),
        (2, "return diagnostic register"),
        (3, "change ASCII input delimiter"),
        (4, "force listen only mode"),
        (10, "clear counters"),
        (11, "return bus message count"),
        (12, "return bus communication error count"),
        (13, "return bus exception error count"),
        (14, "return server message count"),
        (15, "return server no response count"),
        (16, "return server NAK count"),
        (17, "return server busy count"),
        (18, "return bus character overrun count"),
        (20, "clear overrun counter"),
    ];
    for number in 0..=u16::MAX {
        let name =
            names.iter().find(|(known, _)| *known == number).map_or("sub-function not known", |it| it.1);
        for direction in [Direction::Request, Direction::Response] {
            assert_eq!(said(number, direction), name, "{number}");
        }
    }
}

/// Who builds a telegram gets one that does no harm and is for the usual ends of the line.
#[test]
fn new_telegrams_are_harmless() {
    for kind in profibus::KINDS.iter().chain(profibus::OTHER_KINDS) {
        let fdl = Fdl::new(kind, &profibus::Settings::default());
        let [to, from] = [fdl.destination, fdl.source].map(|address| address & 0x7F);
        let ends = if kind.direction == Direction::Request { (1, 2) } else { (2, 1) };
        assert_eq!((to, from), ends, "{}", kind.spec.key);
        assert_eq!(fdl.destination & 0x80 != 0, kind.sap.is_some(), "{}", kind.spec.key);
        assert_eq!(fdl.source & 0x80 != 0, kind.sap.is_some(), "{}", kind.spec.key);
    }
    let settings = profibus::Settings { ident: Some(0x05EB), ..profibus::Settings::default() };
    let written = |sap: u8| {
        let kind = profibus::Kind::of(Some(sap), Direction::Request);
        walk::write((kind.new)(&settings).as_mut(), &Deviations::default())
    };
    assert_eq!(written(55), [1, 0x05, 0xEB, 0], "its address can be changed again");
    assert_eq!(written(58), [0, 0], "no command for anybody");
    for kind in KINDS.iter().filter(|kind| kind.direction == Direction::Request) {
        let pdu = walk::write(&mut kind.pdu(DIALECTS[0]), &Deviations::default());
        let data = match kind.function {
            // Where it writes something, that is 0.
            5 | 6 | 15 | 16 | 101 => &pdu[1..],
            _ => &[],
        };
        let counts: usize = data.iter().map(|byte| usize::from(*byte)).sum();
        assert!(counts <= 6, "{}: {pdu:02X?}", kind.spec.key);
    }
}

/// A protocol is chosen by its label, and kept by its key.
#[test]
fn protocols_are_told_apart() {
    let mut told = BTreeSet::new();
    for protocol in PROTOCOLS {
        for word in [protocol.key, protocol.label] {
            assert!(word.len() > 3 && told.insert(word), "{word:?} twice, or none");
        }
    }
}

/// Of protocols whose both sides speak, a response finds its request.
#[test]
fn responses_find_their_requests() {
    for (protocol, request, response) in [
        ("modbus-rtu", "01 03 00 C8 00 03 84 35", "01 03 06 00 08 42 A4 F1 DE B0 F8"),
        ("modbus-tcp", "00 01 00 00 00 06 01 03 00 C8 00 01", "00 01 00 00 00 05 01 03 02 00 08"),
        ("modbus-ascii", ":010300C8000331", ":0103060008 42A4F1DE39"),
        ("modbus-pdu", "03 00 C8 00 01", "03 02 00 08"),
        ("profibus-parameter-channel", "41 00 22 00 00 00 00 00", "71 00 22 00 00 00 00 46"),
        ("profibus-user-data", "41 00 22 00 00 00 00 00 04 00 05 DC", "71 00 22 00 00 00 00 46 00 01 05 DC"),
    ] {
        let options = Options { protocol: Protocol::of(protocol), ..Options::default() };
        let report = decode(&format!("{request}\n{}", response.replace(' ', "")), options);
        let pairs: Vec<_> = report.telegrams.iter().map(|it| (it.answered_by, it.answers)).collect();
        assert_eq!(pairs, [(Some(1), None), (None, Some(0))], "{protocol}");
    }
}
