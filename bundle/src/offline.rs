//! What keeps the page in the browser: the version, the service worker with its list, the manifest with its
//! icons.

use std::path::Path;

use data_encoding::HEXLOWER;
use sha2::{Digest, Sha256};

use crate::names::integrity;
use crate::page::{File, replace_once};

/// The service worker, without its version and its list.
const WORKER: &str = include_str!("offline/service-worker.js");

/// The script in its place that takes the page out of the browser again.
pub const FAREWELL: &str = include_str!("offline/farewell.js");

/// How many bytes of the hash tell builds apart. A person reads them out on the phone.
const BUILD_BYTES: usize = 4;

/// The version of the page: that of the crates, and behind a `+` a hash of all that the page is made of.
pub fn version(template: &str, parts: &[&File]) -> String {
    // Their names follow their contents.
    let names: Vec<&str> = parts.iter().map(|file| file.name.as_str()).collect();
    let hash = Sha256::new().chain_update(template).chain_update(names.join("\n")).finalize();
    format!("{}+{}", env!("CARGO_PKG_VERSION"), HEXLOWER.encode(&hash[..BUILD_BYTES]))
}

/// The service worker of this version of the page.
pub fn service_worker(version: &str, document: &[u8], parts: &[&File]) -> Result<String, String> {
    // A folder means its document: some servers have no other name for it.
    let mut files = vec![("./".to_owned(), integrity(document))];
    files.extend(parts.iter().map(|file| (file.name.clone(), integrity(&file.content))));
    let list: String = files.iter().map(|(name, hash)| format!("  \"{name}\": \"{hash}\",\n")).collect();
    let text = replace_once(WORKER, "\"VERSION\"", &format!("\"{version}\""))?;
    replace_once(&text, "FILES = {}", &format!("FILES = {{\n{list}}}"))
}

/// The manifest by which the page is installed. Its icons, which stand beside it, are added to `icons`.
pub fn manifest(path: &Path, icons: &mut Vec<File>) -> Result<File, String> {
    let mut text = crate::text(&path.display().to_string())?;
    let sources: Vec<String> = text
        .split("\"src\": \"")
        .skip(1)
        .filter_map(|rest| Some(rest.split_once('"')?.0.to_owned()))
        .collect();
    for name in sources {
        let file = path.with_file_name(&name);
        let (Some(stem), Some(extension)) = (file.file_stem(), file.extension()) else {
            return Err(format!("{name} in {} is no file.", path.display()));
        };
        let icon = crate::hashed(&stem.to_string_lossy(), &extension.to_string_lossy(), crate::read(&file)?);
        text = replace_once(&text, &format!("\"{name}\""), &format!("\"./{}\"", icon.name))?;
        icons.push(icon);
    }
    Ok(crate::hashed("manifest", "json", text.into_bytes()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(name: &str) -> File {
        File { name: name.to_owned(), content: name.as_bytes().to_vec() }
    }

    #[test]
    fn the_version_follows_every_part_and_the_template() {
        let (one, other) = (file("page-1.js"), file("later-2.wasm"));
        let first = version("<html>", &[&one, &other]);
        assert!(first.starts_with(concat!(env!("CARGO_PKG_VERSION"), "+")), "{first}");
        assert_eq!(first, version("<html>", &[&one, &other]));
        assert_ne!(first, version("<html> ", &[&one, &other]));
        assert_ne!(first, version("<html>", &[&one, &file("later-3.wasm")]));
    }

    #[test]
    fn the_worker_lists_the_document_and_every_part_with_its_hash() {
        let (one, other) = (file("page-1.js"), file("log-2.wasm"));
        let script = service_worker("1.2.3+abcd", b"<html>", &[&one, &other]).unwrap();
        assert!(script.contains("const VERSION = \"1.2.3+abcd\";"), "{script}");
        for (name, content) in [("./", "<html>"), ("page-1.js", "page-1.js"), ("log-2.wasm", "log-2.wasm")] {
            let line = format!("\"{name}\": \"{}\",", integrity(content.as_bytes()));
            assert!(script.contains(&line), "{line} is missing in {script}");
        }
    }

    /// The service worker takes names for those of files by this form: see `HASHED` there.
    #[test]
    fn names_have_the_form_that_the_worker_knows() {
        let name = crate::hashed("icon-512", "png", vec![1]).name;
        let (stem, hash) = name.strip_suffix(".png").and_then(|rest| rest.rsplit_once('-')).unwrap();
        assert_eq!(stem, "icon-512");
        assert!(hash.len() == 16 && hash.bytes().all(|digit| digit.is_ascii_hexdigit()), "{name}");
    }
}
