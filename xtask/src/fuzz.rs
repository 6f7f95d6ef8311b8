//! `cargo xtask fuzz`: random inputs against the library's laws, see the crate `fuzz`.

use crate::steps::{self, Result};
use crate::tools;

/// How long the short run of `cargo xtask test` takes.
const SHORT: &str = "20";

/// Takes what the program takes: `SECONDS [--seed N] [--only TARGET]`, or `--replay FILE`.
pub fn run(arguments: &[&str]) -> Result {
    let program = ["run", "--quiet", "--profile", "fuzz", "--package", "fuzz", "--"];
    steps::run(tools::cargo().args(program).args(arguments))
}

/// Other inputs each time: what one run does not find, another one may.
pub fn short() -> Result {
    run(&[SHORT])
}
