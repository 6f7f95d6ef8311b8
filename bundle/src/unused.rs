//! What libraries export for JavaScript and this page never gives to it: an export is kept with all that it
//! reaches, whether or not anybody calls it.

use crate::split::{HEADER, broken, sections};

/// The classes of `wasm-streams`, which Leptos brings for the bodies of server functions: 6 kB of the page.
const CLASS: &str = "IntoUnderlying";

/// The module as compiled, without what is exported of those classes. Were they in use after all, wasm-bindgen
/// would miss what it is told of them and say so.
pub fn without(wasm: &[u8]) -> Result<Vec<u8>, String> {
    const EXPORTS: u8 = 7;
    const CUSTOM: u8 = 0;
    const PROGRAMS: &[u8] = b"\x17__wasm_bindgen_unstable";
    let sections = sections(wasm)?;
    let mut kept = wasm[..HEADER].to_vec();
    for section in sections {
        let content = match section.kind {
            EXPORTS => exports(section.content).ok_or_else(broken)?,
            CUSTOM if section.content.starts_with(PROGRAMS) => {
                let programs = programs(&section.content[PROGRAMS.len()..]).ok_or_else(broken)?;
                [PROGRAMS, &programs].concat()
            }
            _ => {
                kept.extend_from_slice(section.whole);
                continue;
            }
        };
        kept.push(section.kind);
        put_number(&mut kept, content.len());
        kept.extend(content);
    }
    Ok(kept)
}

fn is_unused(name: &[u8]) -> bool {
    let name = name.to_ascii_lowercase();
    let class = CLASS.to_ascii_lowercase();
    name.windows(class.len()).any(|part| part == class.as_bytes())
}

/// Each export is a name, a kind and an index; the section begins with their count.
fn exports(section: &[u8]) -> Option<Vec<u8>> {
    let (count, mut rest) = number(section)?;
    let mut kept = Vec::new();
    let mut kept_count = 0;
    for _ in 0..count {
        let (length, name) = number(rest)?;
        let (_, after) = number(name.get(length + 1..)?)?;
        if !is_unused(name.get(..length)?) {
            kept.extend_from_slice(&rest[..rest.len() - after.len()]);
            kept_count += 1;
        }
        rest = after;
    }
    let mut section = Vec::new();
    put_number(&mut section, kept_count);
    section.extend(kept);
    Some(section)
}

/// What wasm-bindgen's macros say of a library: pairs of a version and a program, each behind its length.
fn programs(section: &[u8]) -> Option<Vec<u8>> {
    let part = |bytes: &[u8]| {
        let (length, rest) = bytes.split_first_chunk::<4>()?;
        let length = u32::from_le_bytes(*length) as usize;
        (length <= rest.len()).then_some(4 + length)
    };
    let mut kept = Vec::new();
    let mut rest = section;
    while !rest.is_empty() {
        let version = part(rest)?;
        let end = version + part(&rest[version..])?;
        if !is_unused(&rest[version..end]) {
            kept.extend_from_slice(&rest[..end]);
        }
        rest = &rest[end..];
    }
    Some(kept)
}

/// A number in LEB128, and what follows it.
fn number(bytes: &[u8]) -> Option<(usize, &[u8])> {
    let (value, digits) = crate::split::number(bytes)?;
    Some((value, &bytes[digits..]))
}

fn put_number(bytes: &mut Vec<u8>, mut number: usize) {
    while number >= 0x80 {
        bytes.push(number as u8 | 0x80);
        number >>= 7;
    }
    bytes.push(number as u8);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exports_of_the_class_are_left_out() {
        let section = b"\x03\x04main\x00\x85\x01\x15intounderlyingsource_\x00\x02\x06memory\x02\x00";
        assert_eq!(exports(section).unwrap(), b"\x02\x04main\x00\x85\x01\x06memory\x02\x00");
        assert_eq!(exports(b"\x02\x04main\x00\x01"), None);
    }

    #[test]
    fn programs_of_the_class_are_left_out() {
        let of = |text: &str| [&(text.len() as u32).to_le_bytes(), text.as_bytes()].concat();
        let (version, kept) = (of("{}"), of("Blob"));
        let section = [&version, &of("new IntoUnderlyingSink"), &version, &kept].map(Vec::as_slice).concat();
        assert_eq!(programs(&section).unwrap(), [version, kept].concat());
        assert_eq!(programs(&[9, 0, 0, 0]), None);
    }
}
