//! The menu of what concerns the page as a whole.

use leptos::prelude::*;
use leptos::task::spawn_local;
use leptos::wasm_bindgen::JsCast;
use wasm_bindgen_futures::JsFuture;
use web_sys::{Blob, Response};

use super::icon::Glyph;
use super::menu::{Menu, MenuItem};
use super::toast::Toasts;
use crate::browser::edition::{self, OneFile};
use crate::browser::file;

/// What the page as one file is called where it is saved.
const NAME: &str = "buslens.html";

/// Nothing where the page cannot be saved, as it is the saved one.
#[component]
pub fn PageMenu() -> impl IntoView {
    let toasts = expect_context::<Toasts>();
    let menu = move |OneFile { address, bytes }: OneFile| {
        let save = Callback::new(move |()| {
            let address = address.clone();
            spawn_local(async move {
                match fetched(&address).await {
                    Some(blob) => {
                        file::save_blob(NAME, &blob);
                        toasts.say("The page is saved as one file. It opens on any computer, from any disk.");
                    }
                    None => toasts.say("The file could not be loaded: check the connection, and try again."),
                }
            });
        });
        let label = format!("Save the page as one file ({:.1} MB)", bytes as f64 / 1e6);
        let label = StoredValue::new(label);
        view! {
            <Menu label="More" glyph=Glyph::More icon_only=true at_end=true>
                <MenuItem on_choose=save>{label.get_value()}</MenuItem>
            </Menu>
        }
    };
    edition::one_file().map(menu)
}

/// The file at an address.
async fn fetched(address: &str) -> Option<Blob> {
    let response = JsFuture::from(window().fetch_with_str(address)).await.ok()?;
    let response: Response = response.dyn_into().ok().filter(Response::ok)?;
    JsFuture::from(response.blob().ok()?).await.ok()?.dyn_into().ok()
}
