//! `cargo xtask reproducible`: the page, built here and in another folder, is the same byte for byte. So
//! whoever builds it can tell whether what a server hands out is made of these sources.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::build::DIST;
use crate::steps::{self, Result};
use crate::tools;

pub fn check() -> Result {
    let other = tools::target_folder().join("reproducible").join("in-another-folder");
    copy_sources(&other)?;
    println!("Building the page here.");
    build(Path::new("."))?;
    println!("Building it in {}, from nothing.", other.display());
    build(&other)?;
    let (here, there) = (files(Path::new(DIST))?, files(&other.join(DIST))?);
    let differences: Vec<String> = here
        .keys()
        .chain(there.keys().filter(|name| !here.contains_key(*name)))
        .filter_map(|name| difference(name, here.get(name), there.get(name)))
        .collect();
    if !differences.is_empty() {
        return Err(format!("The two pages differ:\n{}", differences.join("\n")));
    }
    let bytes: usize = here.values().map(Vec::len).sum();
    println!("{} files, {bytes} bytes: the same in both.", here.len());
    // A second target folder takes gigabytes.
    std::fs::remove_dir_all(&other).map_err(|error| format!("{}: {error}.", other.display()))
}

/// Every file that git knows, as it is at this moment.
fn copy_sources(to: &Path) -> Result {
    if to.exists() {
        std::fs::remove_dir_all(to).map_err(|error| format!("{}: {error}.", to.display()))?;
    }
    let listed =
        steps::output(Command::new("git").args(["ls-files", "--cached", "--others", "--exclude-standard"]))?;
    for name in listed.lines().filter(|name| Path::new(name).is_file()) {
        let copy = to.join(name);
        let folder = copy.parent().unwrap_or(to);
        std::fs::create_dir_all(folder)
            .and_then(|()| std::fs::copy(name, &copy))
            .map_err(|error| format!("{name} cannot be copied: {error}."))?;
    }
    Ok(())
}

/// Builds the page with the tool of that folder, into its own target folder.
fn build(folder: &Path) -> Result {
    let mut command = tools::cargo();
    command.args(["run", "--quiet", "--package", "xtask", "--", "build"]).current_dir(folder);
    if folder != Path::new(".") {
        command.env_remove("CARGO_TARGET_DIR");
    }
    // This tool's own, which Cargo sets anew.
    command.env_remove("CARGO_MANIFEST_DIR");
    steps::run(&mut command)
}

/// The files of a folder by their names in it, with what they hold.
fn files(folder: &Path) -> Result<BTreeMap<PathBuf, Vec<u8>>> {
    let failed = |error: std::io::Error| format!("{} cannot be read: {error}.", folder.display());
    let mut found = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in std::fs::read_dir(next).map_err(failed)? {
            let path = entry.map_err(failed)?.path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path.strip_prefix(folder).unwrap_or(&path).to_owned();
                found.insert(name, std::fs::read(&path).map_err(failed)?);
            }
        }
    }
    Ok(found)
}

/// How a file differs in two folders.
fn difference(name: &Path, here: Option<&Vec<u8>>, there: Option<&Vec<u8>>) -> Option<String> {
    let name = name.display();
    match (here, there) {
        (Some(here), Some(there)) if here == there => None,
        (Some(here), Some(there)) => {
            let at = here.iter().zip(there).take_while(|(one, other)| one == other).count();
            Some(format!("  {name}: {} and {} bytes, from byte {at} on", here.len(), there.len()))
        }
        (Some(_), None) => Some(format!("  {name}: only here")),
        (None, _) => Some(format!("  {name}: only in the other folder")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_are_told_by_their_place() {
        let told = |here: Option<&str>, there: Option<&str>| {
            let [here, there] = [here, there].map(|text| text.map(|text| text.as_bytes().to_vec()));
            difference(Path::new("a.wasm"), here.as_ref(), there.as_ref())
        };
        assert_eq!(told(Some("abc"), Some("abc")), None);
        assert_eq!(told(Some("abc"), Some("abd")).unwrap(), "  a.wasm: 3 and 3 bytes, from byte 2 on");
        assert_eq!(told(Some("abc"), Some("ab")).unwrap(), "  a.wasm: 3 and 2 bytes, from byte 2 on");
        assert_eq!(told(Some("abc"), None).unwrap(), "  a.wasm: only here");
        assert_eq!(told(None, Some("abc")).unwrap(), "  a.wasm: only in the other folder");
    }
}
