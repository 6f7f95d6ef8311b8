//! How many changes of the library its tests notice: `mutants CARGO_MUTANTS [--of PART] [--sample N] [--seed S] [--tests NAME]`.
//!
//! cargo-mutants says what could be changed where. To build the tests for each change takes a minute, so all
//! changes are built in at once, each behind a switch ([`switch`]); the tests are run with one of them on, and
//! only those that come past it ([`suite`]).

mod list;
mod suite;
mod switch;

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::Instant;

use list::{Mutant, PARTS};
use suite::{Outcome, Suite};

/// What goes wrong here is told to a person: the error is a sentence.
type Result<T = ()> = std::result::Result<T, String>;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match run(&words) {
        Ok(()) => ExitCode::SUCCESS,
        Err(sentence) => {
            eprintln!("\n{sentence}");
            ExitCode::FAILURE
        }
    }
}

fn run(words: &[&str]) -> Result {
    let [program, options @ ..] = words else { return Err("Which cargo-mutants?".to_owned()) };
    let (mut part, mut sample, mut seed, mut tests) = (&PARTS[0], usize::MAX, 1, "");
    for pair in options.chunks(2) {
        let number = |text: &str| text.parse().map_err(|_| format!("`{text}` is not a number."));
        match *pair {
            ["--of", key] => {
                part = PARTS.iter().find(|part| part.key == key).ok_or_else(|| {
                    let keys: Vec<&str> = PARTS.iter().map(|part| part.key).collect();
                    format!("There is no part `{key}`: {}.", keys.join(", "))
                })?;
            }
            ["--sample", text] => sample = number(text)?,
            ["--seed", text] => seed = number(text)? as u64,
            // What some of the tests notice by themselves, while they are written.
            ["--tests", name] => tests = name,
            _ => {
                return Err(format!(
                    "`{}` is not understood: [--of PART] [--sample N] [--seed S] [--tests NAME].",
                    pair.join(" ")
                ));
            }
        }
    }
    let mutants = list::list(Path::new(program), part)?;
    let folder = copy(part.key)?;
    println!("{} changes of {}.", mutants.len(), part.key);
    let suite = Suite::build(&folder, &mutants, tests)?;
    let mut order: Vec<usize> = (0..mutants.len()).collect();
    shuffle(&mut order, seed);
    order.truncate(sample);
    let start = Instant::now();
    let mut tried: Vec<(usize, Outcome)> = Vec::new();
    for number in order {
        let begun = Instant::now();
        let (outcome, why) = suite.try_mutant(number);
        tried.push((number, outcome));
        if !matches!(outcome, Outcome::Noticed | Outcome::NoSwitch) {
            println!("{outcome:?}: {} ({why}, {:.1?})", mutants[number].name, begun.elapsed());
        }
        if tried.len().is_multiple_of(50) {
            println!("… {} in {:.0?}", tried.len(), start.elapsed());
        }
    }
    tell(&mutants, &tried);
    Ok(())
}

/// Prints the score and what survived; what takes for ever counts as noticed.
fn tell(mutants: &[Mutant], tried: &[(usize, Outcome)]) {
    let count = |wanted: Outcome| tried.iter().filter(|(_, outcome)| *outcome == wanted).count();
    let noticed = count(Outcome::Noticed) + count(Outcome::Endless);
    let all = noticed + count(Outcome::Survived);
    println!("\n{} tried of {}:", tried.len(), mutants.len());
    println!("{:>6} noticed, {} of them since the tests never end", noticed, count(Outcome::Endless));
    println!("{:>6} survived", count(Outcome::Survived));
    println!("{:>6} that no test comes past, or only the compiler", count(Outcome::NotMet));
    println!("{:>6} that do not compile, or not beside others", count(Outcome::NoSwitch));
    let (low, high) = interval(noticed, all);
    println!(
        "Score: {:.1} % ({low:.1} to {high:.1} %, 95 % sure)",
        100.0 * noticed as f64 / all.max(1) as f64
    );
    for wanted in [Outcome::Survived, Outcome::NotMet] {
        for (number, _) in tried.iter().filter(|(_, outcome)| *outcome == wanted) {
            println!("{wanted:?}: {}", mutants[*number].name);
        }
    }
}

/// Wilson's interval, in per cent.
fn interval(noticed: usize, all: usize) -> (f64, f64) {
    let (noticed, all, z) = (noticed as f64, all.max(1) as f64, 1.96_f64);
    let share = noticed / all;
    let middle = share + z * z / (2.0 * all);
    let half = z * (share * (1.0 - share) / all + z * z / (4.0 * all * all)).sqrt();
    let whole = 1.0 + z * z / all;
    (100.0 * (middle - half) / whole, 100.0 * (middle + half) / whole)
}

/// Puts numbers into an order that the seed tells (SplitMix64).
fn shuffle(numbers: &mut [usize], seed: u64) {
    let mut state = seed;
    for at in (1..numbers.len()).rev() {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
        numbers.swap(at, (z % (at as u64 + 1)) as usize);
    }
}

/// A copy of every file that git knows, as it is at this moment.
fn copy(key: &str) -> Result<PathBuf> {
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| PathBuf::from("target"), PathBuf::from);
    let folder = std::path::absolute(target.join("mutants").join(key)).map_err(|error| error.to_string())?;
    let failed = |error: std::io::Error| format!("{}: {error}.", folder.display());
    if folder.exists() {
        std::fs::remove_dir_all(&folder).map_err(failed)?;
    }
    let listed = Command::new("git")
        .args(["ls-files", "--cached", "--others", "--exclude-standard"])
        .output()
        .map_err(|error| format!("git did not start: {error}."))?;
    for name in String::from_utf8_lossy(&listed.stdout).lines().filter(|name| Path::new(name).is_file()) {
        let copy = folder.join(name);
        std::fs::create_dir_all(copy.parent().unwrap_or(&folder)).map_err(failed)?;
        std::fs::copy(name, &copy).map_err(failed)?;
    }
    Ok(folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interval_holds_the_score() {
        let (low, high) = interval(95, 100);
        assert!((88.0..90.0).contains(&low) && (97.0..98.5).contains(&high), "{low} to {high}");
        assert_eq!(interval(0, 0).0, 0.0);
    }

    #[test]
    fn a_seed_tells_the_order() {
        let order = |seed| {
            let mut numbers: Vec<usize> = (0..20).collect();
            shuffle(&mut numbers, seed);
            numbers
        };
        assert_eq!(order(1), order(1));
        assert_ne!(order(1), order(2));
        let mut sorted = order(3);
        sorted.sort_unstable();
        assert_eq!(sorted, (0..20).collect::<Vec<_>>());
    }
}
