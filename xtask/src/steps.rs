//! Running a program and running a row of steps, with words and times for whoever waits.

use std::process::Command;
use std::time::{Duration, Instant};

/// What goes wrong here is told to a person: the error is a sentence.
pub type Result<T = ()> = std::result::Result<T, String>;

/// Runs a program to its end; what it prints is seen as it comes.
pub fn run(command: &mut Command) -> Result {
    let status = command.status().map_err(|error| format!("{} did not start: {error}.", shown(command)))?;
    if status.success() { Ok(()) } else { Err(format!("{} failed ({status}).", shown(command))) }
}

/// Runs a program to its end and takes what it prints; its errors are still seen as they come.
pub fn output(command: &mut Command) -> Result<String> {
    let output = command
        .stderr(std::process::Stdio::inherit())
        .output()
        .map_err(|error| format!("{} did not start: {error}.", shown(command)))?;
    if output.status.success() {
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    } else {
        Err(format!("{} failed ({}).", shown(command), output.status))
    }
}

/// Runs a program to its end; what it prints is seen only if it fails.
pub fn run_quietly(command: &mut Command) -> Result {
    let output = command.output().map_err(|error| format!("{} did not start: {error}.", shown(command)))?;
    if output.status.success() {
        return Ok(());
    }
    print!("{}", String::from_utf8_lossy(&output.stdout));
    eprint!("{}", String::from_utf8_lossy(&output.stderr));
    Err(format!("{} failed ({}).", shown(command), output.status))
}

/// The command as one would type it, with the program's name instead of its path.
fn shown(command: &Command) -> String {
    let program = std::path::Path::new(command.get_program());
    let name = program.file_stem().unwrap_or(program.as_os_str());
    let words: Vec<_> =
        std::iter::once(name).chain(command.get_args()).map(|word| word.to_string_lossy()).collect();
    format!("`{}`", words.join(" "))
}

/// One check: what it is called and what it does.
pub type Step = (&'static str, fn() -> Result);

/// Runs the steps in turn and ends with a table of times. Stops at the first failure: what comes
/// later would mostly fail for the same reason, and bury the message.
pub fn run_all(steps: &[Step]) -> Result {
    let mut times: Vec<(&str, Duration)> = Vec::new();
    for (index, (name, work)) in steps.iter().enumerate() {
        println!("\n[{}/{}] {name} …", index + 1, steps.len());
        let start = Instant::now();
        let result = work();
        let time = start.elapsed();
        times.push((name, time));
        if let Err(sentence) = result {
            print_times(&times);
            let left = match steps.len() - times.len() {
                0 => "",
                1 => " The last step was not run.",
                _ => " The steps after it were not run.",
            };
            return Err(format!("Failed at “{name}”: {sentence}{left}"));
        }
        println!("      {}", seconds(time));
    }
    print_times(&times);
    println!("\nAll {} steps passed.", steps.len());
    Ok(())
}

fn print_times(times: &[(&str, Duration)]) {
    println!();
    for (name, time) in times {
        println!("{:>8}  {name}", seconds(*time));
    }
    let total = times.iter().map(|(_, time)| *time).sum();
    println!("{:>8}  together", seconds(total));
}

/// `12.3 s`
pub fn seconds(time: Duration) -> String {
    format!("{:.1} s", time.as_secs_f64())
}
