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
    let listed = steps::output(mutants().arg("--list"))?;
    let mut all: Vec<&str> = listed.lines().collect();
    println!("{} changes are possible.", all.len());
    let out = tools::target_folder().join("mutants");
    let mut command = mutants();
    if let Some(count) = sample {
        shuffle(&mut all, seed);
        all.truncate(count as usize);
        println!("{} of them are tried, chosen by seed {seed}.", all.len());
        for name in &all {
            command.args(["--re", &format!("^{}$", plain(name))]);
        }
    }
    // That the tests pass without a change, `cargo xtask test` shows.
    command.args(["--baseline", "skip", "--timeout", "300", "--build-timeout", "600", "--output"]).arg(&out);
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

/// Puts a list into an order that the seed tells (Fisher and Yates, SplitMix64).
fn shuffle<T>(list: &mut [T], seed: u64) {
    let mut state = seed;
    for at in (1..list.len()).rev() {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
        list.swap(at, (z % (at as u64 + 1)) as usize);
    }
}

/// A regular expression for this very text.
fn plain(text: &str) -> String {
    let mut expression = String::new();
    for c in text.chars() {
        if r"\.+*?()|[]{}^$#&-~".contains(c) {
            expression.push('\\');
        }
        expression.push(c);
    }
    expression
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_tells_the_sample() {
        let shuffled = |seed| {
            let mut list: Vec<u32> = (0..100).collect();
            shuffle(&mut list, seed);
            list
        };
        assert_eq!(shuffled(3), shuffled(3));
        assert_ne!(shuffled(3), shuffled(4));
        let mut again = shuffled(5);
        again.sort_unstable();
        assert_eq!(again, (0..100).collect::<Vec<_>>());
    }

    #[test]
    fn names_are_no_expressions() {
        assert_eq!(plain("a.rs:1: replace + with -> b<'_>"), r"a\.rs:1: replace \+ with \-> b<'_>");
    }
}
