//! `cargo xtask build`: from the sources to the static page in `dist/`.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use crate::steps::{self, Result};
use crate::tools;

/// Where the page goes.
pub const DIST: &str = "dist";

/// The profile of the bundler.
pub const TOOL: &str = "tool";

/// How the page is compiled.
#[derive(Clone, Copy, PartialEq)]
pub enum Build {
    /// As it is published.
    Release,
    /// In a fraction of the time, for work on it: larger, slower, without compressed copies.
    Dev,
    /// As `Dev`, for `cargo xtask serve`: the browser keeps nothing of it, and there is no single file.
    Serve,
}

pub fn run(build: Build) -> Result {
    let start = Instant::now();
    tools::wasm_target()?;
    compile_bundler()?;
    let page = compile(build)?;
    let mut bundle = Command::new(bundler());
    bundle.arg(DIST).arg(page);
    match build {
        Build::Release => {}
        Build::Dev => drop(bundle.arg("--dev")),
        Build::Serve => drop(bundle.arg("--serve")),
    }
    steps::run(&mut bundle)?;
    println!("The page is in {DIST}/ after {}.", steps::seconds(start.elapsed()));
    Ok(())
}

/// The program `bundle` has wasm-bindgen in it, which takes long to compile: so it is a program of
/// its own, and this tool starts quickly. It comes before the page for one more reason: after it,
/// Cargo has made the folders that `local_paths` lists.
fn compile_bundler() -> Result {
    if !bundler().exists() {
        println!("Compiling the bundler with wasm-bindgen; this happens once and takes minutes.");
    }
    steps::run(tools::cargo().args(["build", "--profile", TOOL, "--package", "bundle"]))
}

fn bundler() -> PathBuf {
    let name = format!("bundle{}", std::env::consts::EXE_SUFFIX);
    tools::target_folder().join(TOOL).join(name)
}

/// Compiles the page, and says where its wasm file is.
fn compile(build: Build) -> Result<PathBuf> {
    let profile = match build {
        Build::Release => "page",
        Build::Dev | Build::Serve => "page-dev",
    };
    // Parts of the page that differ in their types only are compiled once: a quarter less to download.
    let mut flags = vec![OsString::from("--cfg=erase_components")];
    flags.extend(local_paths().into_iter().map(|(path, name)| {
        let mut flag = OsString::from("--remap-path-prefix=");
        flag.push(path);
        flag.push(format!("={name}"));
        flag
    }));
    steps::run(
        tools::cargo()
            .args(["build", "--profile", profile, "--target", tools::WASM, "--package", "buslens-page"])
            // Not RUSTFLAGS, which splits at spaces, and a path may have one.
            .env("CARGO_ENCODED_RUSTFLAGS", flags.join("\u{1f}".as_ref()))
            .env_remove("RUSTFLAGS"),
    )?;
    Ok(tools::target_folder().join(tools::WASM).join(profile).join("page.wasm"))
}

/// The folders of this machine whose names the compiler would write into the texts of panics, and
/// what stands there instead: two people get the same file, and it tells nothing about either.
fn local_paths() -> Vec<(PathBuf, &'static str)> {
    // Where several fit, the compiler takes the last one.
    let mut paths = Vec::new();
    if let Ok(root) = std::env::current_dir() {
        paths.push((root, "buslens"));
    }
    if let Some(home) = tools::cargo_home() {
        paths.push((home.clone(), "cargo"));
        // One folder for each registry, called after where the crates came from.
        let registries = std::fs::read_dir(home.join("registry").join("src"));
        let entries = registries.into_iter().flatten().flatten();
        let mut folders: Vec<_> = entries.map(|entry| (entry.path(), "crates")).collect();
        folders.sort();
        paths.extend(folders);
    }
    if let Some(sysroot) = tools::sysroot() {
        paths.push((sysroot.join("lib").join("rustlib").join("src").join("rust"), "rust"));
    }
    paths
}

/// Fails if a file of the page names a folder of this machine.
pub fn check_no_local_path() -> Result {
    let mut needles: Vec<String> = local_paths().iter().map(|(path, _)| path.display().to_string()).collect();
    needles
        .extend(std::env::home_dir().map(|home| format!("{}{}", home.display(), std::path::MAIN_SEPARATOR)));
    for name in crate::size::page_files(Path::new(DIST))? {
        let content = std::fs::read(Path::new(DIST).join(&name))
            .map_err(|error| format!("{name} cannot be read: {error}."))?;
        for needle in &needles {
            let found = content.windows(needle.len()).any(|bytes| bytes == needle.as_bytes());
            if found {
                return Err(format!(
                    "{name} contains the path `{needle}` of this machine: \
                     see `local_paths` in xtask/src/build.rs."
                ));
            }
        }
    }
    Ok(())
}
