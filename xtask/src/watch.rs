//! `cargo xtask serve`: the page on a local server, rebuilt after each change.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime};

use crate::build::{self, Build};
use crate::server;
use crate::steps::{self, Result};

/// What the page is made of.
const WATCHED: &[&str] = &["src", "crates", "style", "index.html", "Cargo.toml", "bundle/src"];

/// How often the files are looked at. Looking at some dozen files costs next to nothing, works on
/// every system and file system, and needs no library.
const PAUSE: Duration = Duration::from_millis(300);

pub fn serve(wanted: u16) -> Result {
    let mut built_from = look();
    build::run(Build::Serve)?;

    let listener = server::listen(wanted)?;
    let port = server::port(&listener)?;
    if port != wanted {
        println!("Port {wanted} is taken; serving on {port} instead.");
    }
    let address = server::address(port);
    server::start(listener, Path::new(build::DIST))?;
    println!("Buslens is at {address} and is rebuilt after each change. Ctrl+C ends this.");

    loop {
        std::thread::sleep(PAUSE);
        let mut now = look();
        if now == built_from {
            continue;
        }
        // An editor may save several files: wait until no more changes come.
        loop {
            std::thread::sleep(PAUSE);
            let later = look();
            if later == now {
                break;
            }
            now = later;
        }
        println!("\nChanged: {}", names(&changed(&built_from, &now)));
        built_from = now;
        let start = Instant::now();
        match build::run(Build::Serve) {
            Ok(()) => println!("Reload {address} to see it."),
            Err(sentence) => println!(
                "{sentence}\nStill serving the page as it was (after {}).",
                steps::seconds(start.elapsed())
            ),
        }
    }
}

/// Each watched file with its time and its length.
type Files = BTreeMap<PathBuf, (Option<SystemTime>, u64)>;

fn look() -> Files {
    let mut files = Files::new();
    let mut open: Vec<PathBuf> = WATCHED.iter().map(PathBuf::from).collect();
    while let Some(path) = open.pop() {
        // Drafts and backups of editors.
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if name.starts_with('.') || name.ends_with('~') {
            continue;
        }
        // What went away between the listing and this look is simply not there.
        let Ok(metadata) = fs::metadata(&path) else {
            continue;
        };
        if metadata.is_dir() {
            let entries = fs::read_dir(&path).into_iter().flatten().flatten();
            open.extend(entries.map(|entry| entry.path()));
        } else {
            files.insert(path, (metadata.modified().ok(), metadata.len()));
        }
    }
    files
}

/// The files that were added, edited or removed.
fn changed<'a>(before: &'a Files, after: &'a Files) -> Vec<&'a Path> {
    let edited = after.iter().filter(|(path, state)| before.get(*path) != Some(*state));
    let removed = before.iter().filter(|(path, _)| !after.contains_key(*path));
    edited.chain(removed).map(|(path, _)| path.as_path()).collect()
}

/// The first three, and how many more there are.
fn names(paths: &[&Path]) -> String {
    let shown: Vec<_> = paths.iter().take(3).map(|path| path.display().to_string()).collect();
    let shown = shown.join(", ");
    match paths.len().saturating_sub(3) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn added_edited_and_removed_files_are_changes() {
        let file = |name: &str, length| (PathBuf::from(name), (None, length));
        let before = Files::from([file("same", 1), file("edited", 1), file("removed", 1)]);
        let after = Files::from([file("same", 1), file("edited", 2), file("added", 1)]);
        let changes = changed(&before, &after);
        assert_eq!(changes, ["added", "edited", "removed"].map(Path::new));
    }

    #[test]
    fn many_changes_are_cut_short() {
        let paths = ["a", "b", "c", "d", "e"].map(Path::new);
        assert_eq!(names(&paths[..2]), "a, b");
        assert_eq!(names(&paths), "a, b, c and 2 more");
    }
}
