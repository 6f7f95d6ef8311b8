//! Files that a person opens, drops, or saves.

use leptos::prelude::*;
use leptos::wasm_bindgen::JsCast;
use wasm_bindgen_futures::JsFuture;
use web_sys::js_sys::Array;
use web_sys::{Blob, BlobPropertyBag, File, HtmlAnchorElement, HtmlInputElement, Url};

/// Why a file has no text for us.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotRead {
    TooLong {
        name: String,
    },
    /// It is a folder, it is gone, or the browser may not read it.
    Unreadable {
        name: String,
    },
    Empty {
        name: String,
    },
}

impl NotRead {
    /// In a sentence.
    pub fn sentence(&self) -> String {
        match self {
            Self::TooLong { name } => format!("{name} is too large to be such a file."),
            Self::Unreadable { name } => {
                format!("{name} cannot be read: it is a folder, it is gone, or this browser may not open it.")
            }
            Self::Empty { name } => format!("{name} is empty."),
        }
    }
}

/// The text of a file of at most `most` bytes.
pub async fn text(file: &File, most: u32) -> Result<String, NotRead> {
    let name = file.name();
    if file.size() > most.into() {
        return Err(NotRead::TooLong { name });
    }
    let read = JsFuture::from(file.text()).await.ok().and_then(|text| text.as_string());
    match read {
        None => Err(NotRead::Unreadable { name }),
        Some(text) if text.trim().is_empty() => Err(NotRead::Empty { name }),
        Some(text) => Ok(text),
    }
}

/// The files that were chosen in a field, where they can then be chosen again.
pub fn chosen(field: &HtmlInputElement) -> Vec<File> {
    let chosen = field.files();
    let files = chosen.iter().flat_map(|files| (0..files.length()).filter_map(|at| files.get(at))).collect();
    field.set_value("");
    files
}

/// Gives `text` to the person as a file to keep.
pub fn save(name: &str, text: &str) {
    if let Ok(blob) = Blob::new_with_str_sequence(&Array::of1(&text.into())) {
        save_blob(name, &blob);
    }
}

/// Gives a file to the person to keep.
pub fn save_blob(name: &str, blob: &Blob) {
    let Ok(address) = Url::create_object_url_with_blob(blob) else { return };
    if let Ok(link) = document().create_element("a") {
        let link: HtmlAnchorElement = link.unchecked_into();
        link.set_href(&address);
        link.set_download(name);
        link.click();
    }
    let _ = Url::revoke_object_url(&address);
}

/// A file of these parts, each a run of bytes.
pub fn blob(parts: &Array, kind: &str) -> Option<Blob> {
    let bag = BlobPropertyBag::new();
    bag.set_type(kind);
    Blob::new_with_u8_array_sequence_and_options(parts, &bag).ok()
}
