//! `cargo xtask mutants`: changes the code here and there, and counts the changes that no test notices
//! (cargo-mutants, `.cargo/mutants.toml`).

use std::path::Path;
use std::process::Command;

use crate::steps::{self, Result};
use crate::tools;

/// Takes `[--sample N] [--seed S]`: all changes take many hours.
pub fn run(arguments: &[&str]) -> Result {
    let (mut sample, mut seed) = (None, 1);
    for pair in arguments.chunks(2) {
        match *pair {
            ["--sample", number] => sample = Some(whole(number)?),
            ["--seed", number] => seed = whole(number)?,
            _ => return Err(format!("`{}` is not understood: [--sample N] [--seed S].", pair.join(" "))),
        }
    }
    let program = tools::installed("cargo-mutants", "27.1.0")?;
    let mutants = || {
        let mut command = Command::new(&program);
        command.args(["mutants", "--package", "buslens"]);
        command
    };
    let all = steps::output(mutants().arg("--list"))?.lines().count() as u64;
    println!("{all} changes are possible.");
    let out = tools::target_folder().join("mutants");
    let mut command = mutants();
    if let Some(wanted) = sample {
        let shards = shards(all, wanted);
        println!("Every {shards}th of them is tried, from the one on that seed {seed} tells.");
        command.args(["--sharding", "round-robin", "--shard", &format!("{}/{shards}", seed % shards)]);
    }
    // That the tests pass without a change, `cargo xtask test` shows.
    command.args(["--baseline", "skip", "--timeout", "600", "--output"]).arg(&out);
    // Quicker to compile.
    command.env("CARGO_PROFILE_DEV_DEBUG", "0").env("CARGO_PROFILE_TEST_DEBUG", "0");
    let status = command.status().map_err(|error| format!("cargo-mutants did not start: {error}."))?;
    tell(&out.join("mutants.out")).map_err(|error| format!("{error} ({status})."))
}

fn whole(number: &str) -> Result<u64> {
    number.parse().map_err(|_| format!("`{number}` is not a number."))
}

/// Prints the score and what survived; what takes for ever counts as noticed.
fn tell(folder: &Path) -> Result {
    let lines = |name: &str| -> Result<Vec<String>> {
        let path = folder.join(name);
        let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        Ok(text.lines().map(str::to_owned).collect())
    };
    let (caught, timeout) = (lines("caught.txt")?.len(), lines("timeout.txt")?.len());
    let (missed, unviable) = (lines("missed.txt")?, lines("unviable.txt")?.len());
    let noticed = caught + timeout;
    println!(
        "\n{unviable} do not compile; {noticed} noticed, {timeout} of them by time; {} survived:",
        missed.len()
    );
    missed.iter().for_each(|name| println!("  {name}"));
    let all = (noticed + missed.len()).max(1);
    println!("Score: {:.1} %", 100.0 * noticed as f64 / all as f64);
    Ok(())
}

/// In how many parts `all` changes are cut, so that one of them has about as many as are `wanted`.
fn shards(all: u64, wanted: u64) -> u64 {
    (all / wanted.max(1)).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_has_about_as_many_as_are_wanted() {
        assert_eq!(shards(2700, 30), 90);
        assert_eq!(shards(10, 30), 1);
        assert_eq!(shards(0, 0), 1);
    }
}
