//! `cargo xtask mutants`: changes the code here and there, and counts the changes that no test notices, see the
//! crate `mutants`.

use crate::steps::{self, Result};
use crate::tools;

/// Takes what the program takes: `[--of PART] [--sample N] [--seed S] [--tests NAME]`.
pub fn run(arguments: &[&str]) -> Result {
    let lister = tools::installed("cargo-mutants", "27.1.0")?;
    let program = ["run", "--quiet", "--package", "mutants", "--"];
    steps::run(tools::cargo().args(program).arg(lister).args(arguments))
}
