//! `cargo xtask fuzz`: random inputs against the library's laws, see the crate `fuzz`.

use crate::steps::{self, Result};
use crate::tools;

/// The short run of `cargo xtask test`: so many rounds take some 20 seconds.
const SHORT: [&str; 6] = ["--rounds", "120", "--seed", "1", "--threads", "2"];

/// Takes what the program takes: `SECONDS [--seed N] [--only TARGET] [--threads N]`, `--rounds N` in the place of `SECONDS`, or `--replay FILE`.
pub fn run(arguments: &[&str]) -> Result {
    let program = ["run", "--quiet", "--profile", "fuzz", "--package", "fuzz", "--"];
    steps::run(tools::cargo().args(program).args(arguments))
}

/// The same inputs each time, so that a check fails only for what was changed: to find what nobody knows yet
/// is for the long runs, which take others each time.
pub fn short() -> Result {
    run(&SHORT)
}
