//! What the page weighs, and what it may weigh.

use std::path::Path;

use crate::steps::Result;

/// The most bytes that the first view of the page may fetch, compressed with gzip: on a slow phone line of
/// 400 kbit/s this is twelve seconds. 350 kB are the aim, and 450 were to be the most: what is still in the
/// first part without need is the reader of logs with its exports (some 50 kB), and the states of the other
/// views with the forms that they fill in (some 40 kB); and the facts of the manuals with what proposes a device by
/// them (some 40 kB) could wait until the first telegram is read. The rest is the decoder with its tables, Leptos, and
/// what shows a telegram. 1 kB is 1000 bytes.
const FIRST_VIEW: u64 = 620_000;

/// The most bytes of the whole page, with all views and the reader of logs.
const WHOLE: u64 = 1_200_000;

/// What the bundler calls the parts of the module that come later.
const LATER: &str = "later-";

/// Prints what the page weighs, and fails if that is too much.
pub fn check(folder: &Path) -> Result {
    let (later, first): (Vec<String>, Vec<String>) =
        page_files(folder)?.into_iter().partition(|name| name.starts_with(LATER));
    let mut sum = 0;
    for (title, names, budget) in [("first view", first, FIRST_VIEW), ("later, whole page", later, WHOLE)] {
        println!("{title}\n{:>10} {:>10} {:>10}", "raw", "gzip", "brotli");
        for name in names {
            let raw = length(&folder.join(&name))?;
            let gzip = length(&folder.join(format!("{name}.gz")))?;
            let brotli = length(&folder.join(format!("{name}.br")))?;
            sum += gzip;
            println!("{:>10} {:>10} {:>10}  {name}", kilobytes(raw), kilobytes(gzip), kilobytes(brotli));
        }
        println!("{:>10} {:>10} {:>10}  together so far", "", kilobytes(sum), "");
        within(title, sum, budget)?;
    }
    Ok(())
}

fn within(what: &str, gzip: u64, budget: u64) -> Result {
    if gzip <= budget {
        println!("{} of the budget are left.", kilobytes(budget - gzip));
        return Ok(());
    }
    Err(format!(
        "The page ({what}) weighs {} compressed with gzip, {} more than its budget of {}. Make it smaller, \
         or raise the budget in xtask/src/size.rs and say why.",
        kilobytes(gzip),
        kilobytes(gzip - budget),
        kilobytes(budget)
    ))
}

/// `12.34 kB`, with 1000 bytes to the kilobyte.
fn kilobytes(bytes: u64) -> String {
    format!("{}.{:02} kB", bytes / 1000, bytes % 1000 / 10)
}

fn length(path: &Path) -> Result<u64> {
    let metadata =
        std::fs::metadata(path).map_err(|error| format!("{} cannot be read: {error}.", path.display()))?;
    Ok(metadata.len())
}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_budget_is_the_last_size_that_passes() {
        assert_eq!(within("first view", 90_000, 90_000), Ok(()));
        let error = within("first view", 90_010, 90_000).unwrap_err();
        assert!(error.contains("90.01 kB") && error.contains("0.01 kB more"), "{error}");
    }

    #[test]
    fn kilobytes_have_two_digits_after_the_point() {
        assert_eq!(kilobytes(90_050), "90.05 kB");
        assert_eq!(kilobytes(999), "0.99 kB");
        assert_eq!(kilobytes(0), "0.00 kB");
    }
}
