//! Who may import whom. A layer knows nothing of those above it.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Each layer with all that it may use of this crate.
const LAYERS: &[(&str, &[&str])] = &[
    ("field", &[]),
    ("walk", &["field"]),
    ("modbus", &["field", "walk"]),
    ("profibus", &["field", "walk"]),
    ("frame", &["field", "walk", "modbus", "profibus"]),
    ("device", &["field", "walk"]),
    ("text", &["field"]),
    ("capture", &[]),
    ("dialogue", &["field", "walk", "modbus", "profibus", "frame"]),
    ("tool", &["field", "walk", "modbus", "profibus", "frame", "device", "text", "capture", "dialogue"]),
];

/// What the page, and the crate of tasks, may use of the library.
const PAGE: &[&str] = &["field", "tool"];

/// Crates that only the page may use.
const PAGE_CRATES: &[&str] = &["leptos", "web_sys", "wasm_bindgen", "js_sys", "gloo_events", "gloo_timers"];

#[test]
fn layers_import_only_what_is_below_them() {
    let mut wrong = Vec::new();
    for (layer, allowed) in LAYERS {
        for path in rust_files(&source().join(layer)) {
            let text = std::fs::read_to_string(&path).unwrap();
            for used in imports(&text, "crate::") {
                if used != *layer && !allowed.contains(&used.as_str()) {
                    wrong.push(format!("{}: {layer} must not use {used}", path.display()));
                }
            }
            for name in PAGE_CRATES {
                if code(&text).any(|line| line.contains(&format!("{name}::"))) {
                    wrong.push(format!("{}: only the page may use {name}", path.display()));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_page_and_the_tasks_see_tools_and_words_only() {
    let mut wrong = Vec::new();
    for folder in ["../../src", "../trainer/src"] {
        for path in rust_files(&Path::new(env!("CARGO_MANIFEST_DIR")).join(folder)) {
            let text = std::fs::read_to_string(&path).unwrap();
            for used in imports(&text, "buslens::").filter(|used| !PAGE.contains(&used.as_str())) {
                wrong.push(format!("{}: only the library itself may use {used}", path.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_tasks_know_nothing_of_the_page() {
    for path in rust_files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../trainer/src")) {
        let text = std::fs::read_to_string(&path).unwrap();
        for name in PAGE_CRATES {
            let used = code(&text).any(|line| line.contains(&format!("{name}::")));
            assert!(!used, "{}: only the page may use {name}", path.display());
        }
    }
}

#[test]
fn every_folder_is_a_layer() {
    let folders: BTreeSet<String> = std::fs::read_dir(source())
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.is_dir())
        .map(|path| path.file_name().unwrap().to_str().unwrap().to_owned())
        .collect();
    let layers: BTreeSet<String> = LAYERS.iter().map(|(layer, _)| (*layer).to_owned()).collect();
    assert_eq!(folders, layers);
}

#[test]
fn imports_are_found_in_every_form() {
    let text = "use crate::field::{Span, Spec};\n    let x = crate::walk::read(a);\nuse crate::{text, tool::decode};\n\
                // crate::app is only spoken of\nuse crate::message;\n";
    let found: Vec<String> = imports(text, "crate::").collect();
    assert_eq!(found, ["field", "walk", "text", "tool"]);
}

fn source() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(rust_files(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
    found
}

fn code(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter(|line| !line.trim_start().starts_with("//"))
}

/// The modules that `text` names behind `root`. `message` is a macro that belongs to `field`.
fn imports<'a>(text: &'a str, root: &'a str) -> impl Iterator<Item = String> + 'a {
    code(text)
        .flat_map(move |line| line.match_indices(root).map(|(at, found)| &line[at + found.len()..]))
        .flat_map(|rest| match rest.strip_prefix('{') {
            Some(list) => list.split('}').next().unwrap_or("").split(',').map(first_word).collect::<Vec<_>>(),
            None => vec![first_word(rest)],
        })
        .filter(|name| name != "message" && !name.is_empty())
}

fn first_word(text: &str) -> String {
    text.trim().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
}
