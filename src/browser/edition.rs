//! Which edition of the page this is. Its document says so; the bundler writes it.

use leptos::prelude::document;

/// How the page came here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edition {
    /// From a server, which may have a newer version.
    Hosted,
    /// As one file, which holds all of it.
    OneFile,
    /// From the server of somebody who works on it.
    Development,
}

/// The page as one file, which the server of the page has, too.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OneFile {
    pub address: String,
    pub bytes: u64,
}

/// Which edition this is.
pub fn edition() -> Edition {
    match said("edition").as_deref() {
        Some("hosted") => Edition::Hosted,
        Some("one-file") => Edition::OneFile,
        _ => Edition::Development,
    }
}

/// The version of Buslens, and behind a `+` what tells this build from others.
pub fn version() -> String {
    said("version").unwrap_or_default()
}

/// The page as one file, where it can be had.
pub fn one_file() -> Option<OneFile> {
    let said = said("one-file")?;
    let (address, bytes) = said.split_once(' ')?;
    Some(OneFile { address: address.to_owned(), bytes: bytes.parse().ok()? })
}

/// Whether this browser keeps the page for times without a connection. The boot script finds it out.
pub fn is_kept() -> bool {
    document().document_element().is_some_and(|page| page.has_attribute("data-kept"))
}

/// Whether the browser has a newer version already. The boot script finds it out, and tells it by the
/// event [`NEWER`].
pub fn has_newer() -> bool {
    document().document_element().is_some_and(|page| page.has_attribute("data-newer"))
}

/// An event of the window.
pub const NEWER: &str = "newversion";

/// The stylesheet of what comes later, where it is not in the document.
pub fn later_style() -> Option<String> {
    said("later-style")
}

/// What the document says under a name.
fn said(name: &str) -> Option<String> {
    let meta = document().query_selector(&format!("meta[name={name}]")).ok()??;
    meta.get_attribute("content")
}
