//! Tells the linker to keep what the bundler needs to split the page's module (src/later.rs), and gathers the
//! telegrams of the gallery (src/views/learn/gallery).

use std::path::{Path, PathBuf};
use std::{env, fs};

/// The telegrams that the library is tested with.
const VECTORS: &str = "crates/buslens/tests/vectors";

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-changed={VECTORS}");
    if env::var_os("CARGO_CFG_TARGET_FAMILY").is_some_and(|family| family == "wasm") {
        println!("cargo:rustc-link-arg-bin=page=--emit-relocs");
    }
    let folder = env::var_os("OUT_DIR").expect("cargo says where");
    fs::write(Path::new(&folder).join("gallery.txt"), gallery()).expect("cargo's folder can be written to");
}

/// The heads of the vectors that a manual prints or that say `gallery: yes`, an empty line behind each. Their
/// expectations are left out: the page reads the telegrams itself.
fn gallery() -> String {
    const LEFT_OUT: [&str; 5] = ["gallery: ", "direction: ", "check: ", "problems: ", "protocol: "];
    let mut list = String::new();
    for path in vectors() {
        let text = fs::read_to_string(path).expect("a vector is text");
        let head = text.split("---\n").next().unwrap_or_default();
        if head.contains("bytes of our own") && !head.contains("\ngallery: yes\n") {
            continue;
        }
        for line in head.lines().filter(|line| !LEFT_OUT.iter().any(|key| line.starts_with(key))) {
            list.push_str(line);
            list.push('\n');
        }
        list.push('\n');
    }
    list
}

fn vectors() -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![PathBuf::from(VECTORS)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("the vectors are there").flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "txt") {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}
