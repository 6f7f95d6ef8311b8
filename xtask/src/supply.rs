//! Where the libraries come from: their licences, sources and versions (cargo-deny, `deny.toml`).

use crate::steps::{self, Result};
use crate::tools;

pub fn check() -> Result {
    let deny = tools::installed("cargo-deny", DENY_VERSION)?;
    // Advisories need a database that cannot be had everywhere.
    let what = ["--locked", "check", "--hide-inclusion-graph", "bans", "licenses", "sources"];
    steps::run(std::process::Command::new(deny).args(what))
}

const DENY_VERSION: &str = "0.20.2";
