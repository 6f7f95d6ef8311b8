//! What the page weighs, and what it may weigh.

use std::path::Path;

use crate::steps::Result;

/// The names of the page's own files in the folder, without their compressed copies.
pub fn page_files(folder: &Path) -> Result<Vec<String>> {
    let says = |error| format!("{} cannot be listed: {error}.", folder.display());
    let mut names = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(says)? {
        let name = entry.map_err(says)?.file_name();
        let name = name.to_string_lossy();
        if !name.ends_with(".br") && !name.ends_with(".gz") {
            names.push(name.into_owned());
        }
    }
    names.sort();
    Ok(names)
}
