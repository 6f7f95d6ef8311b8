//! `cargo xtask test`: every check, in the order in which they fail soonest.

use std::path::Path;

use crate::build::{self, Build};
use crate::steps::{self, Result, Step};
use crate::tools::Engine;
use crate::{fuzz, page_tests, size, supply, tools};

const STEPS: &[Step] = &[
    ("tools", tools),
    ("formatting", formatting),
    ("clippy", clippy),
    ("the library without the page's libraries", lean_library),
    ("licences and sources of the libraries", supply::check),
    ("tests", tests),
    ("random inputs", fuzz::short),
    ("the facts of the manuals", facts),
    ("benchmarks compile, and the library by itself", other_targets),
    ("documentation", documentation),
    ("the page", page),
    ("size of the page", || size::check(Path::new(build::DIST))),
    ("the page in a browser", || page_tests::run(&[])),
];

/// What `--browsers all` adds: before all else, and behind it.
const OTHER_TOOLS: &[Step] = &[("tools of the other browsers", other_tools)];
const OTHER_BROWSERS: &[Step] = &[
    ("the page in Firefox", || page_tests::run(&[page_tests::BROWSERS, "firefox"])),
    ("the page in WebKit", || page_tests::run(&[page_tests::BROWSERS, "webkit"])),
];

pub fn run() -> Result {
    steps::run_all(STEPS)
}

/// All of them, with the page in the other browsers, too.
pub fn run_in_all_browsers() -> Result {
    steps::run_all(&[OTHER_TOOLS, STEPS, OTHER_BROWSERS].concat())
}

/// First, since a missing tool should not show after minutes.
fn tools() -> Result {
    tools::wasm_target()?;
    tools::component("rustfmt")?;
    tools::component("clippy")?;
    let browser = tools::browser(Engine::Chromium)?;
    let axe = tools::axe()?;
    println!("Browser: {}", browser.program.display());
    println!("Driver: {}", browser.driver.display());
    println!("Accessibility: {}", axe.display());
    Ok(())
}

fn other_tools() -> Result {
    for engine in [Engine::Firefox, Engine::Webkit] {
        let browser = tools::browser(engine)?;
        println!("{}: {}, driven by {}", engine.label(), browser.program.display(), browser.driver.display());
    }
    Ok(())
}

fn formatting() -> Result {
    cargo(&["fmt", "--all", "--check"]).map_err(|error| format!("{error} `cargo fmt --all` puts it right."))
}

fn clippy() -> Result {
    cargo(&["clippy", "--workspace", "--all-targets", "--", "--deny", "warnings"])?;
    // As the page is compiled, with 32 bits to an address.
    cargo(&["clippy", "--package", "buslens-page", "--target", tools::WASM, "--", "--deny", "warnings"])
}

/// The library is for programs of every kind: a plain dependency on it must not bring in what only
/// the page needs.
fn lean_library() -> Result {
    let mut question = tools::cargo();
    question.args(["tree", "--package", "buslens", "--edges", "normal", "--prefix", "none"]);
    let tree = steps::output(&mut question)?;
    let found = tree.lines().find(|line| {
        let name = line.split(' ').next().unwrap_or_default();
        ["leptos", "web-sys", "js-sys", "wasm-bindgen"].contains(&name)
    });
    match found {
        None => Ok(()),
        Some(line) => Err(format!(
            "The library depends on {line}, which only the page may need: it belongs into the \
             root package, the page."
        )),
    }
}

fn tests() -> Result {
    // The bundler's libraries are compiled for the page anyway; once is enough.
    cargo(&["test", "--workspace", "--exclude", "page-tests", "--exclude", "bundle"])?;
    cargo(&["test", "--profile", build::TOOL, "--package", "bundle"])
}

/// Run with the rest already; here for what it counts: `966 of 966 facts`.
fn facts() -> Result {
    cargo(&["test", "--package", "buslens", "--test", "manuals", "--", "--nocapture"])
}

fn other_targets() -> Result {
    cargo(&["check", "--package", "buslens", "--benches"])?;
    cargo(&["check", "--package", "buslens", "--lib", "--no-default-features"])
}

fn documentation() -> Result {
    steps::run(
        tools::cargo().args(["doc", "--no-deps", "--workspace"]).env("RUSTDOCFLAGS", "--deny warnings"),
    )
}

fn page() -> Result {
    build::run(Build::Release)?;
    build::check_no_local_path()
}

fn cargo(arguments: &[&str]) -> Result {
    steps::run(tools::cargo().args(arguments))
}
