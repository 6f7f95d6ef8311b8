//! The changes that cargo-mutants would try, and where they are.

use std::path::Path;
use std::process::Command;

use serde::Deserialize;

use crate::Result;

/// A part of the library with a score of its own.
#[derive(Debug)]
pub struct Part {
    pub key: &'static str,
    /// Folders of `crates/buslens/src`.
    pub folders: &'static [&'static str],
}

pub static PARTS: &[Part] = &[
    Part { key: "codecs", folders: &["field", "walk", "modbus", "profibus", "frame", "device"] },
    Part { key: "reader", folders: &["text", "dialogue"] },
];

/// A change of the code at one place.
#[derive(Clone, Debug, Deserialize)]
pub struct Mutant {
    /// `crates/buslens/src/field/mod.rs:39:19: replace == with != in Span::is_empty`
    pub name: String,
    pub file: String,
    pub genre: Genre,
    pub replacement: String,
    pub span: Span,
}

/// What is changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize)]
pub enum Genre {
    /// A function gives something else at once.
    FnValue,
    BinaryOperator,
    UnaryOperator,
    /// An arm that is left out.
    MatchArm,
    MatchArmGuard,
    /// A field that is left to what stands behind `..`.
    StructField,
}

#[derive(Clone, Copy, Debug, Deserialize)]
pub struct Span {
    pub start: Place,
}

/// Line and column, from 1, in characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize)]
pub struct Place {
    pub line: usize,
    pub column: usize,
}

/// All changes of `part`, without what `.cargo/mutants.toml` says means nothing.
pub fn list(program: &Path, part: &Part) -> Result<Vec<Mutant>> {
    let mut command = Command::new(program);
    command.args(["mutants", "--package", "buslens", "--list", "--json"]);
    for folder in part.folders {
        command.arg("--file").arg(format!("crates/buslens/src/{folder}/**/*.rs"));
    }
    let output = command.output().map_err(|error| format!("cargo-mutants did not start: {error}."))?;
    if !output.status.success() {
        return Err(format!("cargo-mutants: {}", String::from_utf8_lossy(&output.stderr)));
    }
    serde_json::from_slice(&output.stdout)
        .map_err(|error| format!("cargo-mutants lists no mutants: {error}."))
}
