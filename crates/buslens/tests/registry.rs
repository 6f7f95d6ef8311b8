//! A file that no registry names is dead: each function code's file must be in its registry, and
//! what the registries hold must be consistent.

use std::collections::BTreeSet;
use std::path::Path;

use buslens::field::Direction;
use buslens::modbus::{DIALECTS, KINDS, OTHER_KINDS};
use buslens::tool::examples::{EXAMPLES, Group};
use buslens::tool::{Options, PROFILES, Verdict, decode};

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
