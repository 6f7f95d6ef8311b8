//! Turns compiled wasm into the static page.
//!
//! `cargo xtask build` runs this in the project's folder as `bundle <folder> <wasm file> [--dev]`. The
//! document is made from the template `index.html`, the stylesheet from those that it links to. The folder
//! is left holding the finished page and nothing else. With `--dev` there are no compressed copies, which
//! take longest.

mod names;
mod page;
mod split;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use wasm_bindgen_cli_support::Bindgen;

use page::{File, Links};
use split::Split;

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(sentence) => {
            eprintln!("{sentence}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), String> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let (folder, wasm, packs) = match words[..] {
        [folder, wasm] => (folder, wasm, true),
        [folder, wasm, "--dev"] => (folder, wasm, false),
        _ => return Err("Usage: bundle <folder> <wasm file> [--dev]".to_owned()),
    };

    let template = text("index.html")?;
    let Compiled { glue, wasm, later } = Compiled::read("page", Path::new(wasm))?;
    let boot = hashed("boot", "js", page::boot(&glue, &wasm)?.into_bytes());
    let style = hashed("page", "css", stylesheet(&template)?.into_bytes());
    let [icon] = page::linked(&template, "icon")[..] else {
        return Err("index.html should link to one icon.".to_owned());
    };
    let icon = hashed("icon", "svg", read(Path::new(icon))?);
    let links = Links { style: &style, icon: &icon, boot: &boot, glue: &glue, wasm: &wasm };
    let document =
        File { name: "index.html".to_owned(), content: page::html(&template, &links)?.into_bytes() };
    // The document last, so that a page served from this folder during a build finds all it links to.
    let mut files = vec![boot, glue, wasm, style, icon];
    files.extend(later);
    files.push(document);
    write_all(Path::new(folder), &files, packs)
}

/// What becomes of the compiled binary.
struct Compiled {
    glue: File,
    wasm: File,
    /// The parts of the module that are loaded later.
    later: Vec<File>,
}

impl Compiled {
    fn read(name: &str, path: &Path) -> Result<Compiled, String> {
        let says = |error| format!("wasm-bindgen could not read {}: {error:#}", path.display());
        let parts = path.with_extension("parts");
        let Split { main, later, link } = split::split(&read(path)?, &parts)?;
        let mut output = Bindgen::new()
            .input_bytes(name, main)
            .out_name(name)
            .web(true)
            .map_err(says)?
            .typescript(false)
            // The later parts import them.
            .keep_lld_exports(true)
            .demangle(false)
            .remove_name_section(true)
            .remove_producers_section(true)
            .omit_default_module_path(true)
            .generate_output()
            .map_err(says)?;
        // wasm-bindgen lists every crate that uses it, most of them with no snippet.
        let snippets = output.snippets().values().flatten().count();
        if snippets > 0 || !output.local_modules().is_empty() {
            return Err(format!(
                "A library in `{name}` brings JavaScript files of its own (wasm-bindgen snippets). \
                 The page has none so far: name them by their content in bundle/src/main.rs \
                 first, or do without that library."
            ));
        }
        let mut glue = output.js().to_owned();
        // Their names end with hashes, which no compression makes smaller: 3 kB of the page.
        for (index, import) in output.wasm_mut().imports.iter_mut().enumerate() {
            let short = format!("i{index}");
            let key = |name: &str| format!("{name}: function(");
            if glue.matches(&key(&import.name)).count() == 1 {
                glue = glue.replace(&key(&import.name), &key(&short));
                import.name = short;
            }
        }
        let glue = split::join(&glue, &link)?;
        let glue = minifier::js::minify(&glue)
            .map_err(|error| format!("The glue of {name} cannot be made smaller: {error}."))?;
        Ok(Compiled {
            glue: hashed(name, "js", glue.to_string().into_bytes()),
            wasm: hashed(name, "wasm", output.wasm_mut().emit_wasm()),
            later,
        })
    }
}

fn hashed(stem: &str, extension: &str, content: Vec<u8>) -> File {
    File { name: names::hashed(stem, extension, &content), content }
}

/// The stylesheets that the template links to, as one.
fn stylesheet(template: &str) -> Result<String, String> {
    let mut style = String::new();
    for name in page::linked(template, "stylesheet") {
        style.push_str(&text(name)?);
        style.push('\n');
    }
    style.push_str(page::NOTE_STYLE);
    Ok(style)
}

/// Writes the files and their compressed copies, then removes whatever else the folder holds.
fn write_all(folder: &Path, files: &[File], packs: bool) -> Result<(), String> {
    fs::create_dir_all(folder).map_err(|error| format!("{} cannot be made: {error}.", folder.display()))?;
    let mut kept = BTreeSet::new();
    for file in files {
        let path = folder.join(&file.name);
        let copies = [(".br", brotli as Pack), (".gz", gzip)]
            .map(|(ending, pack)| (folder.join(format!("{}{ending}", file.name)), pack));
        let copies = if packs { &copies[..] } else { &[] };
        // Copies are written before the file itself, so a file of the right content has its own.
        let same = fs::read(&path).is_ok_and(|old| old == file.content);
        if !same || copies.iter().any(|(path, _)| !path.exists()) {
            for (path, pack) in copies {
                replace(path, &pack(&file.content)?)?;
            }
            replace(&path, &file.content)?;
        }
        kept.extend(copies.iter().map(|(path, _)| path.clone()));
        kept.insert(path);
    }
    for path in entries(folder)? {
        if kept.contains(&path) {
            continue;
        }
        let removed = if path.is_dir() { fs::remove_dir_all(&path) } else { fs::remove_file(&path) };
        removed.map_err(|error| format!("{} cannot be removed: {error}.", path.display()))?;
    }
    Ok(())
}

/// Makes a compressed copy.
type Pack = fn(&[u8]) -> Result<Vec<u8>, String>;

/// Puts a file in place in one go: whoever reads meanwhile sees the old one or the new one.
fn replace(path: &Path, content: &[u8]) -> Result<(), String> {
    let says = |error| format!("{} cannot be written: {error}.", path.display());
    let mut draft = path.as_os_str().to_owned();
    draft.push(".new");
    fs::write(&draft, content).map_err(says)?;
    fs::rename(&draft, path).map_err(says)
}

fn brotli(content: &[u8]) -> Result<Vec<u8>, String> {
    let parameters = brotli::enc::BrotliEncoderParams {
        quality: 11,
        lgwin: 22,
        size_hint: content.len(),
        ..Default::default()
    };
    let mut packed = Vec::new();
    brotli::BrotliCompress(&mut &*content, &mut packed, &parameters)
        .map_err(|error| format!("Brotli failed: {error}."))?;
    Ok(packed)
}

fn gzip(content: &[u8]) -> Result<Vec<u8>, String> {
    let mut packed = Vec::new();
    // More blocks than the usual 15 suit a file of code, tables and texts.
    let options = zopfli::Options { maximum_block_splits: 60, ..zopfli::Options::default() };
    zopfli::compress(options, zopfli::Format::Gzip, content, &mut packed)
        .map_err(|error| format!("Gzip failed: {error}."))?;
    Ok(packed)
}

fn read(path: &Path) -> Result<Vec<u8>, String> {
    fs::read(path).map_err(|error| format!("{} cannot be read: {error}.", path.display()))
}

fn text(path: &str) -> Result<String, String> {
    String::from_utf8(read(Path::new(path))?).map_err(|_| format!("{path} is not UTF-8."))
}

fn entries(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let says = |error| format!("{} cannot be listed: {error}.", folder.display());
    fs::read_dir(folder).map_err(says)?.map(|entry| entry.map(|entry| entry.path()).map_err(says)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read as _;

    #[test]
    fn compressed_copies_unpack_to_the_same_bytes() {
        let content = b"01 03 00 00 00 0A C5 CD ".repeat(1000);
        let mut unpacked = Vec::new();
        flate2::read::GzDecoder::new(&*gzip(&content).unwrap()).read_to_end(&mut unpacked).unwrap();
        assert!(unpacked == content, "gzip");

        let mut unpacked = Vec::new();
        brotli::BrotliDecompress(&mut &*brotli(&content).unwrap(), &mut unpacked).unwrap();
        assert!(unpacked == content, "brotli");
    }
}
