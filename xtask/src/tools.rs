//! The programs that the other commands need, and how each is installed where it is missing.

use std::path::PathBuf;
use std::process::Command;

use crate::steps::{self, Result};

/// The target that the page is compiled for.
pub const WASM: &str = "wasm32-unknown-unknown";

/// The Cargo that started this tool.
pub fn cargo() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// Where Cargo puts what it compiles.
pub fn target_folder() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| PathBuf::from("target"), PathBuf::from)
}

/// Where Cargo keeps the sources of libraries.
pub fn cargo_home() -> Option<PathBuf> {
    match std::env::var_os("CARGO_HOME") {
        Some(home) => Some(PathBuf::from(home)),
        None => Some(std::env::home_dir()?.join(".cargo")),
    }
}

/// Where the compiler is installed.
pub fn sysroot() -> Option<PathBuf> {
    let printed = steps::output(rustc().args(["--print", "sysroot"])).ok()?;
    Some(PathBuf::from(printed.trim()))
}

fn rustc() -> Command {
    Command::new(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()))
}

/// Sees to it that the compiler can compile for `WASM`. Asks the compiler and not rustup: a
/// compiler from elsewhere may bring the target, too.
pub fn wasm_target() -> Result {
    let mut question = rustc();
    question.args(["--print", "target-libdir", "--target", WASM]);
    let folder = steps::output(&mut question)?;
    if std::path::Path::new(folder.trim()).exists() {
        return Ok(());
    }
    println!("Adding the target {WASM} to the compiler.");
    steps::run(Command::new("rustup").args(["target", "add", WASM])).map_err(|error| {
        format!(
            "{error}\nThe page needs the compiler's target {WASM}. With rustup that is \
             `rustup target add {WASM}`; with a compiler from elsewhere, look for its package \
             of that name."
        )
    })
}
