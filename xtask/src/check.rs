//! `cargo xtask test`: every check.
use crate::steps::{self, Result};

pub fn run() -> Result {
    steps::run_all(&[])
}
