//! Turns compiled wasm into the static page.
//!
//! `cargo xtask build` runs this in the project's folder as `bundle <folder> <wasm file> [--dev | --serve]`.
//! The document is made from the template `index.html`, the stylesheet and the icons from those that it links
//! to. The folder is left holding the finished page and nothing else: as files, and once more as one file.
//! With `--dev` there are no compressed copies, which take longest. With `--serve` the browser keeps nothing
//! of it either, and there is no single file.

mod names;
mod offline;
mod one_file;
mod order;
mod page;
mod split;
mod uniform;
mod unused;

use std::collections::BTreeSet;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use wasm_bindgen_cli_support::Bindgen;

use page::{Edition, File, Links};
use split::Split;

/// What the page as one file is called.
const ONE_FILE: &str = "buslens.html";

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(sentence) => {
            eprintln!("{sentence}");
            ExitCode::FAILURE
        }
    }
}

/// What the page is built for.
#[derive(Clone, Copy, PartialEq)]
enum Purpose {
    /// To be published.
    Release,
    /// To be tested while it is worked on.
    Dev,
    /// To be looked at while it is worked on.
    Serve,
}

fn run() -> Result<(), String> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let (folder, wasm, purpose) = match words[..] {
        [folder, wasm] => (folder, wasm, Purpose::Release),
        [folder, wasm, "--dev"] => (folder, wasm, Purpose::Dev),
        [folder, wasm, "--serve"] => (folder, wasm, Purpose::Serve),
        _ => return Err("Usage: bundle <folder> <wasm file> [--dev | --serve]".to_owned()),
    };
    let folder = Path::new(folder);
    let is_kept = purpose != Purpose::Serve;

    let template = text("index.html")?;
    let Compiled { glue, wasm, later } =
        Compiled::read("page", Path::new(wasm), purpose == Purpose::Release)?;
    let boot = hashed("boot", "js", page::boot(&glue, &wasm, is_kept)?.into_bytes());
    let style = stylesheet(&template, "stylesheet")? + page::NOTE_STYLE;
    let style = hashed("page", "css", page::without_comments(&style).into_bytes());
    let later_style = page::without_comments(&stylesheet(&template, "prefetch")?);
    let later_style = hashed("later", "css", later_style.into_bytes());
    let icon = hashed("icon", "svg", read(&linked(&template, "icon")?)?);
    let mut icons = Vec::new();
    let manifest = offline::manifest(&linked(&template, "manifest")?, &mut icons)?;

    let parts: Vec<&File> = [&boot, &glue, &wasm, &style, &icon, &manifest, &later_style]
        .into_iter()
        .chain(&later)
        .chain(&icons)
        .collect();
    let version = offline::version(&template, &parts);
    let mut written = Written::new(folder, purpose == Purpose::Release)?;
    for file in &parts {
        written.add(file)?;
    }
    let mut edition = Edition { version: &version, kind: "development", one_file: None };
    if is_kept {
        let modules: Vec<(&File, Vec<u8>)> = std::iter::once(&wasm)
            .chain(&later)
            .map(|file| Ok((file, written.packed(file)?)))
            .collect::<Result<_, String>>()?;
        let content = one_file::html(&template, &version, &[&style, &later_style], &icon, &glue, &modules)?;
        let file = File { name: ONE_FILE.to_owned(), content: content.into_bytes() };
        written.add(&file)?;
        edition = Edition { kind: "hosted", one_file: Some((ONE_FILE, file.content.len())), ..edition };
    }
    let links = Links {
        style: &style,
        icon: &icon,
        manifest: &manifest,
        boot: &boot,
        glue: &glue,
        wasm: &wasm,
        later_style: &later_style,
    };
    let document = page::html(&template, &edition, &links)?.into_bytes();
    let worker = match is_kept {
        true => offline::service_worker(&version, &document, &parts)?,
        false => offline::FAREWELL.to_owned(),
    };
    // Whoever is served from this folder meanwhile finds all that the document links to, and all that the
    // service worker lists.
    written.add(&File { name: "index.html".to_owned(), content: document })?;
    written.add(&File { name: "service-worker.js".to_owned(), content: worker.into_bytes() })?;
    written.finish()
}

/// What becomes of the compiled binary.
struct Compiled {
    glue: File,
    wasm: File,
    /// The parts of the module that are loaded later.
    later: Vec<File>,
}

impl Compiled {
    fn read(name: &str, path: &Path, is_packed: bool) -> Result<Compiled, String> {
        let says = |error| format!("wasm-bindgen could not read {}: {error:#}", path.display());
        let parts = path.with_extension("parts");
        let Split { main, later, link } = split::split(&unused::without(&read(path)?)?, &parts, is_packed)?;
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
            wasm: hashed(name, "wasm", order::ordered(&output.wasm_mut().emit_wasm(), is_packed)?),
            later,
        })
    }
}

fn hashed(stem: &str, extension: &str, content: Vec<u8>) -> File {
    File { name: names::hashed(stem, extension, &content), content }
}

/// The stylesheets that the template links to as `rel`, as one: `prefetch` are those that a later part needs.
fn stylesheet(template: &str, rel: &str) -> Result<String, String> {
    let texts = page::linked(template, rel).into_iter().map(text);
    texts.map(|text| Ok(text? + "\n")).collect()
}

/// The one file that the template links to as `rel`.
fn linked(template: &str, rel: &str) -> Result<PathBuf, String> {
    match page::linked(template, rel)[..] {
        [name] => Ok(PathBuf::from(name)),
        _ => Err(format!("index.html should link to one {rel}.")),
    }
}

/// The folder with the files of the page.
struct Written<'a> {
    folder: &'a Path,
    /// Each file has compressed copies.
    packs: bool,
    kept: BTreeSet<PathBuf>,
}

impl<'a> Written<'a> {
    fn new(folder: &'a Path, packs: bool) -> Result<Self, String> {
        fs::create_dir_all(folder)
            .map_err(|error| format!("{} cannot be made: {error}.", folder.display()))?;
        Ok(Self { folder, packs, kept: BTreeSet::new() })
    }

    /// Writes a file and its compressed copies.
    fn add(&mut self, file: &File) -> Result<(), String> {
        let path = self.folder.join(&file.name);
        let copies =
            [(".br", brotli as Pack), (".gz", gzip)].map(|(ending, pack)| (self.copy(file, ending), pack));
        let copies = if self.packs { &copies[..] } else { &[] };
        // Copies are written before the file itself, so a file of the right content has its own.
        let same = fs::read(&path).is_ok_and(|old| old == file.content);
        if !same || copies.iter().any(|(path, _)| !path.exists()) {
            for (path, pack) in copies {
                replace(path, &pack(&file.content)?)?;
            }
            replace(&path, &file.content)?;
        }
        self.kept.extend(copies.iter().map(|(path, _)| path.clone()));
        self.kept.insert(path);
        Ok(())
    }

    /// What a written file is with gzip.
    fn packed(&self, file: &File) -> Result<Vec<u8>, String> {
        if self.packs { read(&self.copy(file, ".gz")) } else { quick_gzip(&file.content) }
    }

    fn copy(&self, file: &File, ending: &str) -> PathBuf {
        self.folder.join(format!("{}{ending}", file.name))
    }

    /// Removes whatever else the folder holds.
    fn finish(self) -> Result<(), String> {
        for path in entries(self.folder)? {
            if self.kept.contains(&path) {
                continue;
            }
            let removed = if path.is_dir() { fs::remove_dir_all(&path) } else { fs::remove_file(&path) };
            removed.map_err(|error| format!("{} cannot be removed: {error}.", path.display()))?;
        }
        Ok(())
    }
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

/// The same format, larger, and in a moment.
fn quick_gzip(content: &[u8]) -> Result<Vec<u8>, String> {
    let mut packer = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    packer.write_all(content).and_then(|()| packer.finish()).map_err(|error| format!("Gzip failed: {error}."))
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
