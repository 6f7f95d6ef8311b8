//! What the page weighs, and what it may weigh.

use std::path::Path;

use crate::steps::Result;

/// The most bytes that the first view of the page may fetch, compressed with gzip: on a slow phone
/// line of 400 kbit/s this is four seconds. It was 90 kB for Modbus RTU alone; every function code,
/// PROFIBUS, the tables of three devices and the causes of failed checks are in it since. 1 kB is 1000
/// bytes.
const BUDGET: u64 = 200_000;

/// The same for the other documents, which come later and have the browser's copies of some files. 20 kB
/// of it is JSON, 15 kB are the causes of failed checks.
const LATER_BUDGET: u64 = 250_000;

/// The same for the document that reads logs: its worker comes in the background, and is made for speed
/// (level 3), which doubles it.
const LOGS_BUDGET: u64 = 450_000;

/// A file of the page with its lengths in bytes.
struct Row {
    name: String,
    raw: u64,
    gzip: u64,
    brotli: u64,
}

/// Prints what each document weighs, and fails if one weighs too much.
pub fn check(folder: &Path) -> Result {
    let files = page_files(folder)?;
    for document in files.iter().filter(|name| name.ends_with(".html")) {
        check_document(folder, &files, document)?;
    }
    Ok(())
}

/// Every file counts that the document names, and that its scripts name: it fetches all of them when it
/// is opened.
fn check_document(folder: &Path, files: &[String], document: &str) -> Result {
    let mut needed = vec![document.to_owned()];
    let mut at = 0;
    while let Some(name) = needed.get(at) {
        if name.ends_with(".html") || name.ends_with(".js") {
            let path = folder.join(name);
            let text = std::fs::read_to_string(&path)
                .map_err(|error| format!("{} cannot be read: {error}.", path.display()))?;
            let named = |file: &&String| text.contains(file.as_str()) && !file.ends_with(".html");
            let more: Vec<String> =
                files.iter().filter(named).filter(|file| !needed.contains(file)).cloned().collect();
            needed.extend(more);
        }
        at += 1;
    }
    let mut rows = Vec::new();
    for name in needed {
        rows.push(Row {
            raw: length(&folder.join(&name))?,
            gzip: length(&folder.join(format!("{name}.gz")))?,
            brotli: length(&folder.join(format!("{name}.br")))?,
            name,
        });
    }
    let sum = |column: fn(&Row) -> u64| rows.iter().map(column).sum();
    let all = Row {
        name: "together".to_owned(),
        raw: sum(|row| row.raw),
        gzip: sum(|row| row.gzip),
        brotli: sum(|row| row.brotli),
    };

    println!("{document}\n{:>10} {:>10} {:>10}", "raw", "gzip", "brotli");
    for row in rows.iter().chain([&all]) {
        println!(
            "{:>10} {:>10} {:>10}  {}",
            kilobytes(row.raw),
            kilobytes(row.gzip),
            kilobytes(row.brotli),
            row.name
        );
    }
    let budget = match document {
        "index.html" => BUDGET,
        "logs.html" => LOGS_BUDGET,
        _ => LATER_BUDGET,
    };
    within(all.gzip, budget)
}

fn within(gzip: u64, budget: u64) -> Result {
    if gzip <= budget {
        println!("{} of the budget are left.", kilobytes(budget - gzip));
        return Ok(());
    }
    Err(format!(
        "A document of the page weighs {} compressed with gzip, {} more than its budget of {}. Make it smaller, \
         or raise BUDGET in xtask/src/size.rs and say why.",
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
        assert_eq!(within(90_000, 90_000), Ok(()));
        let error = within(90_010, 90_000).unwrap_err();
        assert!(error.contains("90.01 kB") && error.contains("0.01 kB more"), "{error}");
    }

    #[test]
    fn kilobytes_have_two_digits_after_the_point() {
        assert_eq!(kilobytes(90_050), "90.05 kB");
        assert_eq!(kilobytes(999), "0.99 kB");
        assert_eq!(kilobytes(0), "0.00 kB");
    }
}
