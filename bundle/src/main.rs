//! Turns compiled wasm into the static page.
//!
//! `cargo xtask build` runs this in the project's folder as
//! `bundle <folder> <name>=<wasm file>=<style>,<style>…[=<worker>=<wasm file>]…`. Each module gets a document of
//! its own from the template `page.html`, the first one as `index.html`, the others as `<name>.html`. The
//! style is in `style/`. A worker is a second wasm file that the module starts when it needs it. The folder
//! is left holding the finished page and nothing else.

mod names;
mod page;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use wasm_bindgen_cli_support::Bindgen;

use page::{File, Links};

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
    let usage = "Usage: bundle <folder> <name>=<wasm file>=<style>,<style>…[=<worker>=<wasm file>]…";
    let mut arguments = std::env::args().skip(1);
    let folder = PathBuf::from(arguments.next().ok_or(usage)?);

    let mut modules = Vec::new();
    for argument in arguments {
        let parts: Vec<&str> = argument.split('=').collect();
        let (name, path, styles, worker) = match parts[..] {
            [name, path, styles] => (name, path, styles, None),
            [name, path, styles, worker, wasm] => (name, path, styles, Some((worker, wasm))),
            _ => return Err(usage.to_owned()),
        };
        let worker = worker.map(|(name, path)| Compiled::read(name, Path::new(path))).transpose()?;
        let compiled = Compiled::read(name, Path::new(path))?;
        let style = hashed(name, "css", stylesheet(styles)?);
        modules.push(Module { name: name.to_owned(), compiled, style, worker });
    }
    if modules.is_empty() {
        return Err(usage.to_owned());
    }

    let icon = hashed("icon", "svg", read(Path::new("style/icon.svg"))?);
    let template =
        String::from_utf8(read(Path::new("page.html"))?).map_err(|_| "page.html is not UTF-8.".to_owned())?;
    let mut files = Vec::new();
    let mut documents = Vec::new();
    for (index, module) in modules.into_iter().enumerate() {
        let Module { name, compiled: Compiled { glue, wasm }, style, worker } = module;
        let boot = hashed("boot", "js", page::boot(&glue, &wasm)?.into_bytes());
        let mut start = None;
        if let Some(Compiled { glue, wasm }) = worker {
            start = Some(hashed("worker", "js", page::worker(&glue, &wasm)?.into_bytes()));
            files.extend([glue, wasm]);
        }
        let links = Links {
            style: &style,
            icon: &icon,
            boot: &boot,
            glue: &glue,
            wasm: &wasm,
            worker: start.as_ref(),
        };
        let name = if index == 0 { "index" } else { &name };
        let content = page::html(&template, &links)?.into_bytes();
        documents.push(File { name: format!("{name}.html"), content });
        files.extend([boot, glue, wasm, style]);
        files.extend(start);
    }
    files.push(icon);
    // Last, so that a page served from this folder during a build finds all it links to.
    files.extend(documents);
    write_all(&folder, &files)
}

/// A document of the page and what it needs.
struct Module {
    name: String,
    compiled: Compiled,
    style: File,
    worker: Option<Compiled>,
}

/// What wasm-bindgen makes of one compiled binary.
struct Compiled {
    glue: File,
    wasm: File,
}

impl Compiled {
    fn read(name: &str, path: &Path) -> Result<Compiled, String> {
        let says = |error| format!("wasm-bindgen could not read {}: {error:#}", path.display());
        let mut output = Bindgen::new()
            .input_path(path)
            .out_name(name)
            .web(true)
            .map_err(says)?
            .typescript(false)
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
        let glue = minifier::js::minify(&glue)
            .map_err(|error| format!("The glue of {name} cannot be made smaller: {error}."))?;
        Ok(Compiled {
            glue: hashed(name, "js", glue.to_string().into_bytes()),
            wasm: hashed(name, "wasm", output.wasm_mut().emit_wasm()),
        })
    }
}

fn hashed(stem: &str, extension: &str, content: Vec<u8>) -> File {
    File { name: names::hashed(stem, extension, &content), content }
}

/// Some files of `style/`, as one small one.
fn stylesheet(names: &str) -> Result<Vec<u8>, String> {
    let mut text = String::new();
    for name in names.split(',') {
        let path = Path::new("style").join(name).with_extension("css");
        let content = String::from_utf8(read(&path)?);
        text.push_str(&content.map_err(|_| format!("{} is not UTF-8.", path.display()))?);
        text.push('\n');
    }
    text.push_str(page::NOTE_STYLE);
    let small =
        minifier::css::minify(&text).map_err(|error| format!("The stylesheet has a slip: {error}."))?;
    Ok(small.to_string().into_bytes())
}

/// Writes the files and their compressed copies, then removes whatever else the folder holds.
fn write_all(folder: &Path, files: &[File]) -> Result<(), String> {
    fs::create_dir_all(folder).map_err(|error| format!("{} cannot be made: {error}.", folder.display()))?;
    let mut kept = BTreeSet::new();
    for file in files {
        let path = folder.join(&file.name);
        let brotli_path = folder.join(format!("{}.br", file.name));
        let gzip_path = folder.join(format!("{}.gz", file.name));
        // Copies are written before the file itself, so a file of the right content has its own.
        let done = fs::read(&path).is_ok_and(|old| old == file.content)
            && brotli_path.exists()
            && gzip_path.exists();
        if !done {
            replace(&brotli_path, &brotli(&file.content)?)?;
            replace(&gzip_path, &gzip(&file.content)?)?;
            replace(&path, &file.content)?;
        }
        kept.extend([path, brotli_path, gzip_path]);
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
