//! Parts the compiled module: what the page's `wasm_split` functions reach and nothing else does comes
//! later, in files of its own.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use wasm_split_cli_support::{Options, transform};
use wasmparser::{KnownCustom, Linking, Parser, Payload, SymbolFlags, SymbolInfo};

use crate::names;
use crate::order::ordered;
use crate::page::File;

/// A module in parts.
pub struct Split {
    /// The first part, from which wasm-bindgen makes the glue.
    pub main: Vec<u8>,
    pub later: Vec<File>,
    /// JavaScript that loads the later parts; `LINK` is the name that the first part imports it by.
    pub link: String,
}

/// How the first part names the script that loads the others.
pub const LINK: &str = "./__wasm_split.js";

pub fn split(wasm: &[u8], folder: &Path, is_packed: bool) -> Result<Split, String> {
    if let Some(name) = missing_data(wasm)? {
        return Err(format!(
            "The module refers to `{name}`, which is not in it: parts of earlier builds were taken that do not fit \
             (rust-lang/rust#85309). Remove the folder `incremental` beside the module, and build again."
        ));
    }
    let says = |error| format!("the folder for the parts: {error}.");
    // What an earlier build left would be taken for parts of this one.
    if folder.exists() {
        fs::remove_dir_all(folder).map_err(says)?;
    }
    fs::create_dir_all(folder).map_err(says)?;
    let main = folder.join("main.wasm");
    let mut options = Options::new(wasm);
    options.output_dir = folder;
    options.main_out_path = &main;
    options.link_name = LINK;
    options.main_module = "./page.js";
    let parts = transform(options).map_err(|error| format!("The module cannot be parted: {error:#}"))?;

    let mut link = text(&folder.join(LINK))?;
    let mut later = Vec::new();
    let mut renamed = BTreeMap::new();
    for path in parts.split_modules {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let content = ordered(&read(&path)?, is_packed)?;
        let name = names::hashed("later", "wasm", &content);
        renamed.insert(format!("\"./{stem}.wasm\""), format!("\"./{name}\""));
        later.push(File { name, content });
    }
    for (from, to) in renamed {
        link = link.replace(&from, &to);
    }
    Ok(Split { main: read(&main)?, later, link })
}

/// Data that the module refers to and that nobody defines. The linker lets it be at address 0, and so the page
/// would call "null function" when it comes to use it. What the compiler kept of earlier builds can be so.
fn missing_data(wasm: &[u8]) -> Result<Option<String>, String> {
    let says = |error| format!("The module cannot be read: {error}.");
    for payload in Parser::new(0).parse_all(wasm) {
        let Payload::CustomSection(section) = payload.map_err(says)? else { continue };
        let KnownCustom::Linking(linking) = section.as_known() else { continue };
        for part in linking {
            let Linking::SymbolTable(symbols) = part.map_err(says)? else { continue };
            for symbol in symbols {
                if let SymbolInfo::Data { name, symbol: None, flags } = symbol.map_err(says)?
                    && !flags.contains(SymbolFlags::BINDING_WEAK)
                {
                    return Ok(Some(name.to_owned()));
                }
            }
        }
    }
    Ok(None)
}

/// The glue with the script that loads the later parts in it. Each of the two imports the other, so they
/// could not both carry the hash of the other in their names.
pub fn join(glue: &str, link: &str) -> Result<String, String> {
    let is_import = |line: &str| line.starts_with("import * as import") && line.contains(LINK);
    let first = glue.lines().find(|line| is_import(line)).ok_or("The glue does not import the parts.")?;
    let name = first.split_whitespace().nth(3).unwrap_or_default();
    let key = format!("\"{LINK}\":");
    let mut seen = false;
    let mut joined = String::new();
    for line in glue.lines().filter(|line| !is_import(line)) {
        if line.trim_start().starts_with(&key) {
            // One line for each function, all with the same key.
            if !seen {
                joined.push_str(&format!("{key} {name},\n"));
            }
            seen = true;
            continue;
        }
        joined.push_str(line);
        joined.push('\n');
    }
    let mut loaders = Vec::new();
    for line in link.lines() {
        if line.starts_with("import {") {
            continue;
        }
        if let Some(rest) = line.strip_prefix("export const ") {
            loaders.extend(rest.split_whitespace().next());
            joined.push_str("const ");
            joined.push_str(rest);
        } else {
            joined.push_str(line);
        }
        joined.push('\n');
    }
    joined.push_str(&format!("const {name} = {{ {} }};\n", loaders.join(", ")));
    Ok(joined)
}

/// How long the beginning of a module is, before its sections.
pub const HEADER: usize = 8;

/// A section of a module.
pub struct Section<'a> {
    pub kind: u8,
    pub content: &'a [u8],
    /// Kind and length included.
    pub whole: &'a [u8],
}

/// What a module is made of, behind its header.
pub fn sections(wasm: &[u8]) -> Result<Vec<Section<'_>>, String> {
    let mut sections = Vec::new();
    let mut rest = wasm.get(HEADER..).ok_or_else(broken)?;
    while let [kind, after @ ..] = rest {
        let (length, digits) = number(after).ok_or_else(broken)?;
        let (start, end) = (1 + digits, 1 + digits + length);
        let whole = rest.get(..end).ok_or_else(broken)?;
        sections.push(Section { kind: *kind, content: &whole[start..], whole });
        rest = &rest[end..];
    }
    Ok(sections)
}

/// What is said of a module that is none.
pub fn broken() -> String {
    "A part of the module is no wasm.".to_owned()
}

/// A number in LEB128, and how many bytes it takes.
pub fn number(bytes: &[u8]) -> Option<(usize, usize)> {
    let mut value = 0_usize;
    for (at, byte) in bytes.iter().take(5).enumerate() {
        value |= usize::from(byte & 0x7F) << (7 * at);
        if byte & 0x80 == 0 {
            return Some((value, at + 1));
        }
    }
    None
}

fn read(path: &Path) -> Result<Vec<u8>, String> {
    fs::read(path).map_err(|error| format!("{} cannot be read: {error}.", path.display()))
}

fn text(path: &Path) -> Result<String, String> {
    String::from_utf8(read(path)?).map_err(|_| format!("{} is not UTF-8.", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_script_of_the_parts_stands_in_the_glue() {
        let glue = "import * as import1 from \"./__wasm_split.js\"\nimport * as import2 from \"./__wasm_split.js\"\n\
                    function f() {\nreturn {\n\"./page_bg.js\": import0,\n\"./__wasm_split.js\": import1,\n\
                    \"./__wasm_split.js\": import2,\n};\n}\n";
        let link = "import { initSync } from \"./page.js\";\nconst a = 1;\nexport const load = a;\n";
        assert_eq!(
            join(glue, link).unwrap(),
            "function f() {\nreturn {\n\"./page_bg.js\": import0,\n\"./__wasm_split.js\": import1,\n};\n}\n\
             const a = 1;\nconst load = a;\nconst import1 = { load };\n"
        );
    }

    #[test]
    fn data_that_is_not_there_is_noticed() {
        const DATA: u8 = 1;
        const UNDEFINED: u8 = 0x10;
        const WEAK: u8 = 0x01;
        let module = |symbols: &[u8]| {
            let table = [&[8, symbols.len() as u8], symbols].concat();
            let section = [&[7], &b"linking"[..], &[2], &table].concat();
            [b"\0asm\x01\0\0\0", &[0, section.len() as u8][..], &section].concat()
        };
        let there = [1, DATA, 0, 1, b'a', 0, 0, 4];
        let weak = [1, DATA, UNDEFINED | WEAK, 1, b'a'];
        let missing = [2, DATA, 0, 1, b'a', 0, 0, 4, DATA, UNDEFINED, 1, b'b'];
        assert_eq!(missing_data(&module(&there)).unwrap(), None);
        assert_eq!(missing_data(&module(&weak)).unwrap(), None);
        assert_eq!(missing_data(&module(&missing)).unwrap(), Some("b".to_owned()));
    }
}
