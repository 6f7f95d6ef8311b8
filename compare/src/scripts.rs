//! Programs in other languages, as far as their languages and they themselves are installed: each has a script in
//! `compare/peers`, which prints what it measured, a line each.

use std::path::Path;
use std::process::Command;

use crate::Measured;

/// The name of a peer, its script, and what runs that.
const PEERS: [(&str, &str, &str); 4] = [
    ("pymodbus", "with_pymodbus.py", "python3"),
    ("scapy (Modbus TCP only)", "with_scapy.py", "python3"),
    ("jsmodbus", "with_jsmodbus.cjs", "node"),
    ("tshark -T json", "with_tshark.py", "python3"),
];

/// What each of them measures of the data in `folder`, where their packages are, too.
pub fn measure(folder: &Path) -> Vec<Measured> {
    PEERS.iter().filter_map(|(name, script, runner)| run(folder, name, script, runner)).collect()
}

fn run(folder: &Path, name: &str, script: &str, runner: &str) -> Option<Measured> {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("peers").join(script);
    let output = Command::new(runner)
        .arg(script)
        .arg(folder)
        .env("PYTHONPATH", folder.join("python"))
        .env("NODE_PATH", folder.join("node/node_modules"))
        .output();
    let output = match output {
        Ok(output) if output.status.success() => output,
        Ok(output) => {
            let said = String::from_utf8_lossy(&output.stderr);
            eprintln!("{name} is left out: {}", said.trim().lines().last().unwrap_or("its script failed"));
            return None;
        }
        Err(_) => {
            eprintln!("{name} is left out: {runner} is not installed");
            return None;
        }
    };
    let mut measured = Measured { name: name.to_owned(), ..Measured::default() };
    for line in String::from_utf8_lossy(&output.stdout).lines() {
        let mut words = line.split_whitespace();
        let (what, mut values) =
            (words.next().unwrap_or_default(), words.map(|word| word.parse::<f64>().ok()));
        let mut value = || values.next().flatten();
        match what {
            "version" => {
                measured.name = format!("{name} {}", line.split_whitespace().nth(1).unwrap_or_default())
            }
            "split" => measured.split = value(),
            "decoded" => measured.decoded = value(),
            "noise" => {
                measured.noise = value().zip(value()).map(|(found, more)| (found as usize, more as usize))
            }
            "odd" => measured.odd = value().map(|odd| odd as usize),
            _ => {}
        }
    }
    Some(measured)
}
