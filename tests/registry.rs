//! A file that no registry names is dead: each function code's file must be in its registry, and
//! what the registries hold must be consistent.

use std::collections::BTreeSet;
use std::path::Path;

use buslens::field::Direction;
use buslens::modbus::{KINDS, OTHER_KINDS};
use buslens::tool::examples::EXAMPLES;
use buslens::tool::{Options, Verdict, decode};

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
            // Folders, the registry, and the shapes that function codes share.
            if path.is_dir() || ["mod", "registers"].contains(&name) {
                continue;
            }
            let name = format!("{}{name}", folder.replace('/', "::"));
            assert!(listed(&name) == [true, true] || in_one_line, "{name} is in no registry");
        }
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
fn every_function_code_has_an_example_and_the_broken_ones_are_broken() {
    let mut functions = BTreeSet::new();
    let mut keys = BTreeSet::new();
    for example in EXAMPLES {
        assert!(keys.insert(example.key), "{} twice", example.key);
        let report = decode(example.text, Options::default());
        let mut problems = 0;
        for (index, telegram) in report.telegrams.iter().enumerate() {
            let detail = report.detail(index).unwrap();
            problems += detail.problems().len() + telegram.line.remarks.len();
            problems += usize::from(telegram.verdict != Verdict::Right);
            functions.extend(detail.function.filter(|_| !example.broken));
        }
        assert_eq!(problems > 0, example.broken, "{}: {problems} problems", example.key);
    }
    let listed: BTreeSet<u8> = KINDS.iter().map(|kind| kind.function).collect();
    assert_eq!(functions, listed);
}
