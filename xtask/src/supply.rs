//! Where the libraries come from: their licences, sources and versions (cargo-deny, `deny.toml`), and
//! the one that stands in for another.

use crate::steps::{self, Result};
use crate::tools;

pub fn check() -> Result {
    check_patch()?;
    let deny = tools::installed("cargo-deny", DENY_VERSION)?;
    // Advisories need a database that cannot be had everywhere.
    let what = ["--locked", "check", "--hide-inclusion-graph", "bans", "licenses", "sources"];
    steps::run(std::process::Command::new(deny).args(what))
}

const DENY_VERSION: &str = "0.20.2";

/// The libraries that a folder of this project stands in for, see `[patch.crates-io]`. Cargo only warns
/// where a patch is not used any more.
const PATCHED: &[&str] = &["wasm-streams"];

/// Fails if the lock file has such a library from elsewhere.
fn check_patch() -> Result {
    let lock = std::fs::read_to_string("Cargo.lock").map_err(|error| format!("Cargo.lock: {error}."))?;
    for name in PATCHED {
        let packages: Vec<&str> = packages(&lock, name).collect();
        if packages.is_empty() {
            return Err(format!("Nothing depends on {name}: its patch in Cargo.toml can go."));
        }
        if packages.iter().any(|package| package.contains("\nsource = ")) {
            return Err(format!(
                "Cargo.lock has {name} from elsewhere, not from `lean/{name}`: who depends on it wants another \
                 version now. Bring the folder to that version, or leave the patch out."
            ));
        }
    }
    Ok(())
}

/// What a lock file says of the packages with this name.
fn packages<'a>(lock: &'a str, name: &str) -> impl Iterator<Item = &'a str> {
    let line = format!("name = \"{name}\"");
    lock.split("[[package]]").filter(move |package| package.lines().any(|other| other == line))
}

#[cfg(test)]
mod tests {
    use super::*;

    const LOCK: &str = "version = 4\n\n[[package]]\nname = \"a\"\nversion = \"1.0.0\"\nsource = \"registry\"\n\n\
                        [[package]]\nname = \"ab\"\nversion = \"0.5.0\"\ndependencies = [\n \"a\",\n]\n";

    #[test]
    fn packages_are_found_by_their_whole_name() {
        let sources =
            |name: &str| packages(LOCK, name).filter(|package| package.contains("\nsource = ")).count();
        assert_eq!((packages(LOCK, "a").count(), sources("a")), (1, 1));
        assert_eq!((packages(LOCK, "ab").count(), sources("ab")), (1, 0));
        assert_eq!(packages(LOCK, "b").count(), 0);
    }

    /// The patch of wasm-streams is the one in use.
    #[test]
    fn the_patch_is_in_use() {
        let lock = std::fs::read_to_string("../Cargo.lock").unwrap();
        for name in PATCHED {
            let found: Vec<&str> = packages(&lock, name).collect();
            assert_eq!(found.len(), 1, "{name}");
            assert!(!found[0].contains("\nsource = "), "{name} is from elsewhere");
        }
    }
}
