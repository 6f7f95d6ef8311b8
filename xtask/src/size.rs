//! What the page weighs, and what it may weigh.

use std::path::Path;

use crate::steps::Result;

/// The most bytes that the first view of the page may fetch, compressed with gzip, until a telegram is read: on a
/// slow phone line of 400 kbit/s this is nine seconds. 350 kB are the aim. What is in it is the decoder with its
/// tables (a vtable of all that can be read leads to all of it), Leptos, and what shows a telegram. 1 kB is 1000 bytes.
const FIRST_VIEW: u64 = 450_000;

/// The most bytes of the whole page, with all views and the reader of logs. 1.2 MB are the aim,
/// kept without Learn, which is a quarter of it and loaded when somebody goes there.
const WHOLE: u64 = 1_285_000;

/// The most bytes of the page as one file, as it lies on a disk. In base64, the modules take four thirds of what
/// they take on the way; 1 MB was the aim before Learn came.
const ONE_FILE: u64 = 1_810_000;

/// What the bundler calls the files whose names have no hash.
const DOCUMENT: &str = "index.html";
const ONE_FILE_NAME: &str = "buslens.html";
const SERVICE_WORKER: &str = "service-worker.js";

/// Prints what the page weighs, and fails if that is too much.
pub fn check(folder: &Path) -> Result {
    let [document, worker] = [DOCUMENT, SERVICE_WORKER].map(|name| text(&folder.join(name)));
    let (document, worker) = (document?, worker?);
    let names = page_files(folder)?;
    check_kept(&names, &worker)?;
    // The manifest is for those who install the page; what comes later is named so.
    let is_later = |name: &String| ["manifest-", "later-"].iter().any(|start| name.starts_with(start));
    let is_first = |name: &String| name == DOCUMENT || (document.contains(name.as_str()) && !is_later(name));
    let (first, later): (Vec<_>, Vec<_>) =
        names.into_iter().filter(|name| name != ONE_FILE_NAME).partition(is_first);
    let mut sum = 0;
    for (title, names, budget) in
        [("first view", first, FIRST_VIEW), ("later, whole page, kept by the browser", later, WHOLE)]
    {
        println!("{title}\n{:>10} {:>10} {:>10}", "raw", "gzip", "brotli");
        for name in names {
            sum += print_sizes(folder, &name)?[1];
        }
        println!("{:>10} {:>10} {:>10}  together so far", "", kilobytes(sum), "");
        within(&format!("{title}, compressed with gzip"), sum, budget)?;
    }
    println!("the page as one file");
    let [raw, ..] = print_sizes(folder, ONE_FILE_NAME)?;
    within("the page as one file", raw, ONE_FILE)
}

/// Prints what a file weighs: raw, with gzip, with brotli.
fn print_sizes(folder: &Path, name: &str) -> Result<[u64; 3]> {
    let sizes = [
        length(&folder.join(name))?,
        length(&folder.join(format!("{name}.gz")))?,
        length(&folder.join(format!("{name}.br")))?,
    ];
    let [raw, gzip, brotli] = sizes.map(kilobytes);
    println!("{raw:>10} {gzip:>10} {brotli:>10}  {name}");
    Ok(sizes)
}

/// Fails if the service worker does not keep all that the page is made of.
fn check_kept(names: &[String], worker: &str) -> Result {
    let hashed = |name: &&String| ![DOCUMENT, ONE_FILE_NAME, SERVICE_WORKER].contains(&name.as_str());
    match names.iter().filter(hashed).find(|name| !worker.contains(&format!("\"{name}\":"))) {
        None => Ok(()),
        Some(name) => Err(format!("The service worker does not keep {name}: see bundle/src/offline.rs.")),
    }
}

fn within(what: &str, bytes: u64, budget: u64) -> Result {
    if bytes <= budget {
        println!("{} of the budget are left.", kilobytes(budget - bytes));
        return Ok(());
    }
    Err(format!(
        "The page ({what}) weighs {}, {} more than its budget of {}. Make it smaller, or raise the budget in \
         xtask/src/size.rs and say why.",
        kilobytes(bytes),
        kilobytes(bytes - budget),
        kilobytes(budget)
    ))
}

/// `12.34 kB`, with 1000 bytes to the kilobyte.
fn kilobytes(bytes: u64) -> String {
    format!("{}.{:02} kB", bytes / 1000, bytes % 1000 / 10)
}

fn text(path: &Path) -> Result<String> {
    std::fs::read_to_string(path).map_err(|error| format!("{} cannot be read: {error}.", path.display()))
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
    fn a_part_that_is_not_kept_is_named() {
        let names = ["index.html", "log-1.wasm", "page-1.js", "buslens.html"].map(str::to_owned);
        assert_eq!(check_kept(&names, "{\"./\": \"\", \"log-1.wasm\": \"\", \"page-1.js\": \"\"}"), Ok(()));
        let error = check_kept(&names, "{\"page-1.js\": \"\"}").unwrap_err();
        assert!(error.contains("log-1.wasm"), "{error}");
    }

    #[test]
    fn kilobytes_have_two_digits_after_the_point() {
        assert_eq!(kilobytes(90_050), "90.05 kB");
        assert_eq!(kilobytes(999), "0.99 kB");
        assert_eq!(kilobytes(0), "0.00 kB");
    }
}
