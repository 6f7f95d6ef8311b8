//! `cargo xtask build`: from the sources to the static page in `dist/`.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use crate::steps::{self, Result};
use crate::tools;

/// Where the page goes.
pub const DIST: &str = "dist";

/// A binary of the root package that becomes a wasm file and a document.
struct Module {
    /// What its files are called.
    name: &'static str,
    /// Cargo keeps the name `build` for itself.
    binary: &'static str,
    features: &'static str,
    /// Its files in `style/`.
    styles: &'static str,
    /// A binary that works for it in the background, with its features.
    worker: Option<(&'static str, &'static str)>,
}

/// The page's documents, each with a wasm file of its own: who reads telegrams need not wait for the
/// forms that build them. The first is `index.html`.
const MODULES: &[Module] = &[
    module("decode", "decode-page", "page", "page,telegram,decode"),
    Module {
        worker: Some(("log-worker", "page,keys,captures")),
        ..module("logs", "logs-page", "page", "page,telegram,decode,form,logs")
    },
    module("build", "build-page", "page,keys", "page,telegram,form,build"),
    module("check", "check-page", "page", "page,form,check"),
    module("sheet", "sheet-page", "page,keys", "page,form,sheet"),
    module("devices", "devices-page", "page,keys", "page,form,devices"),
];

const fn module(
    name: &'static str,
    binary: &'static str,
    features: &'static str,
    styles: &'static str,
) -> Module {
    Module { name, binary, features, styles, worker: None }
}

pub fn run() -> Result {
    let start = Instant::now();
    tools::wasm_target()?;
    compile_bundler()?;
    let mut arguments = vec![OsString::from(DIST)];
    for module in MODULES {
        let mut argument = OsString::from(format!("{}=", module.name));
        argument.push(compile(module.binary, module.features, "page")?);
        argument.push(format!("={}", module.styles));
        if let Some((binary, features)) = module.worker {
            argument.push(format!("={binary}="));
            argument.push(compile(binary, features, "worker")?);
        }
        arguments.push(argument);
    }
    steps::run(Command::new(bundler()).args(arguments))?;
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
    steps::run(tools::cargo().args(["build", "--release", "--package", "bundle"]))
}

fn bundler() -> PathBuf {
    let name = format!("bundle{}", std::env::consts::EXE_SUFFIX);
    tools::target_folder().join("release").join(name)
}

/// Compiles a binary for the page in one of the profiles of `Cargo.toml`, and says where its wasm file
/// is.
fn compile(binary: &str, features: &str, profile: &str) -> Result<PathBuf> {
    let remapped = local_paths().into_iter().map(|(path, name)| {
        let mut flag = OsString::from("--remap-path-prefix=");
        flag.push(path);
        flag.push(format!("={name}"));
        flag
    });
    let flags: Vec<OsString> = remapped.chain(flags_of(profile).iter().map(OsString::from)).collect();
    steps::run(
        tools::cargo()
            .args(["build", "--profile", profile, "--target", tools::WASM])
            .args(["--no-default-features", "--features", features])
            .args(["--package", "buslens-page", "--bin", binary])
            // Not RUSTFLAGS, which splits at spaces, and a path may have one.
            .env("CARGO_ENCODED_RUSTFLAGS", flags.join("\u{1f}".as_ref()))
            .env_remove("RUSTFLAGS"),
    )?;
    Ok(tools::target_folder().join(tools::WASM).join(profile).join(format!("{binary}.wasm")))
}

/// What the compiler is told besides the profile.
fn flags_of(profile: &str) -> &'static [&'static str] {
    match profile {
        // Browsers take longer to call their `memory.copy` than to copy what a telegram needs.
        "worker" => &["-Ctarget-feature=-bulk-memory"],
        _ => &[],
    }
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
