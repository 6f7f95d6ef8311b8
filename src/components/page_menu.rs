//! The menu of what concerns the page as a whole.

use leptos::prelude::*;
use leptos::task::spawn_local;
use leptos::wasm_bindgen::JsCast;
use wasm_bindgen_futures::JsFuture;
use web_sys::{Blob, Response};

use super::foot::AboutIsOpen;
use super::icon::Glyph;
use super::menu::{Menu, MenuItem};
use super::toast::Toasts;
use crate::browser::edition::{self, OneFile};
use crate::browser::file;

/// What the page as one file is called where it is saved.
const NAME: &str = "buslens.html";

#[component]
pub fn PageMenu() -> impl IntoView {
    let toasts = expect_context::<Toasts>();
    let AboutIsOpen(about) = expect_context();
    let save = move |one_file: OneFile| {
        let label = label(&one_file);
        let save = Callback::new(move |()| save(one_file.clone(), toasts));
        view! { <MenuItem on_choose=save>{label}</MenuItem> }
    };
    view! {
        <Menu label="More" glyph=Glyph::More class="page-menu" icon_only=true at_end=true>
            {edition::one_file().map(save)}
            <MenuItem on_choose=Callback::new(move |()| about.set(true))>"About this version"</MenuItem>
        </Menu>
    }
}

/// What the deed is called.
pub fn label(one_file: &OneFile) -> String {
    let tenths = one_file.bytes.div_ceil(100_000);
    format!("Save the page as one file ({}.{} MB)", tenths / 10, tenths % 10)
}

/// Gives the page as one file to the person to keep.
pub fn save(one_file: OneFile, toasts: Toasts) {
    spawn_local(async move {
        match fetched(&one_file.address).await {
            Some(blob) => {
                file::save_blob(NAME, &blob);
                toasts.say("The page is saved as one file. It opens on any computer, without a connection.");
            }
            None => toasts.say("The file could not be loaded: check the connection, and try again."),
        }
    });
}

/// The file at an address.
async fn fetched(address: &str) -> Option<Blob> {
    let response = JsFuture::from(window().fetch_with_str(address)).await.ok()?;
    let response: Response = response.dyn_into().ok().filter(Response::ok)?;
    JsFuture::from(response.blob().ok()?).await.ok()?.dyn_into().ok()
}
