//! The project's build tool, started as `cargo xtask <command>`.
//!
//! It builds the static page, serves it while it is worked on, and runs every check.

mod build;
mod check;
mod compare;
mod fuzz;
mod mutants;
mod page_tests;
mod reproducible;
mod server;
mod size;
mod steps;
mod supply;
mod tools;
mod watch;

use std::num::NonZero;
use std::path::PathBuf;
use std::process::ExitCode;

use build::Build;
use steps::Result;

const USAGE: &str = "\
Usage: cargo xtask <command>

  build [--dev]      compiles the page into dist/, ready for any static web server;
                     with --dev in a fraction of the time, and not optimized
  serve [--port N]   builds as with --dev, serves dist/ on this machine and rebuilds after each change
  test [--browsers all]
                     runs every check, from the formatting to the page in Chromium, or in all three engines
  test page [NAME] [--long] [--browsers all | firefox,webkit]
                     only tests dist/ as it is in a browser, or those tests that are called so;
                     with --long those that take minutes, with --browsers in these
  fuzz SECONDS [--seed N] [--only TARGET] [--threads N]
                     tries random inputs against the library's laws; --replay FILE tries one again
  mutants [--of codecs|reader] [--sample N] [--seed S]
                     changes the code here and there, and counts the changes that no test notices
  compare            measures other programs that read Modbus on the same data, and Buslens
  reproducible       builds the page in two folders and compares every byte
  --help             this text";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let work: fn(u16) -> Result = match words[..] {
        [] | ["help" | "--help" | "-h"] => {
            println!("{USAGE}");
            return ExitCode::SUCCESS;
        }
        ["build"] => |_| build::run(Build::Release),
        ["build", "--dev"] => |_| build::run(Build::Dev),
        ["serve"] | ["serve", "--port", _] => watch::serve,
        ["test"] => |_| check::run(),
        ["test", page_tests::BROWSERS, "all"] => {
            return done(go_to_root().and_then(|()| check::run_in_all_browsers()));
        }
        ["test", "page", ..] => return done(go_to_root().and_then(|()| page_tests::run(&words[2..]))),
        ["fuzz", ref arguments @ ..] => return done(go_to_root().and_then(|()| fuzz::run(arguments))),
        ["mutants", ref arguments @ ..] => return done(go_to_root().and_then(|()| mutants::run(arguments))),
        ["compare"] => |_| compare::run(),
        ["reproducible"] => |_| reproducible::check(),
        // Started by the tests themselves, see page_tests.rs.
        [page_tests::KEEP, program] => return page_tests::keep(program),
        [command @ ("build" | "serve" | "test" | "compare" | "reproducible"), ..] => {
            return refuse(&format!("`{command}` is not followed by that."));
        }
        [unknown, ..] => return refuse(&format!("There is no command `{unknown}`.")),
    };
    let Ok(port) = words.get(2).unwrap_or(&server::USUAL_PORT).parse::<NonZero<u16>>() else {
        return refuse(&format!("`{}` is not a port: 1 to 65535.", words[2]));
    };

    done(go_to_root().and_then(|()| work(port.get())))
}

fn done(result: Result) -> ExitCode {
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(sentence) => {
            eprintln!("\n{sentence}");
            ExitCode::FAILURE
        }
    }
}

fn refuse(sentence: &str) -> ExitCode {
    eprintln!("{sentence}\n\n{USAGE}");
    ExitCode::from(2)
}

/// Every path in this tool starts at the project's folder, wherever it was called from.
fn go_to_root() -> Result {
    let own = std::env::var_os("CARGO_MANIFEST_DIR")
        .map_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")), PathBuf::from);
    let root = own.parent().unwrap_or(&own);
    std::env::set_current_dir(root).map_err(|error| format!("{} cannot be entered: {error}.", root.display()))
}
