//! The page's address: what is shown stands behind its `#`, so that a link, a reload, and back and
//! forward bring it back. No server sees that part.

use std::cell::RefCell;

use gloo_timers::callback::Timeout;
use leptos::prelude::*;
use leptos::task::spawn_local;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;
use web_sys::js_sys::{ArrayBuffer, Uint8Array, decode_uri_component, encode_uri_component};
use web_sys::{ReadableWritablePair, Response};

use super::browser;
use buslens::tool::link::{Link, kept_settings};

/// Longer ones are compressed.
const LONGEST_PLAIN: usize = 400;
/// Mail programs and chats cut or refuse longer ones.
const LONGEST: usize = 30_000;
/// What is longer is not kept for the next visit: browsers allow a few megabytes in all.
const LONGEST_KEPT: usize = 2_000_000;
/// Stands before what is compressed, in base64url.
const COMPRESSED: &str = "z=";
/// Has no header.
const DEFLATE: &str = "deflate-raw";
/// Where the user's settings of the devices are kept.
pub const SETTINGS: &str = "settings";

/// What to do with the address that there was.
#[derive(Clone, Copy, PartialEq)]
pub enum Step {
    /// Somebody goes on typing: "back" leads to where he began.
    Typed,
    /// Somebody chose something else: "back" undoes that.
    Chosen,
}

/// Who knows what is shown.
pub trait Shows: 'static {
    /// What the page calls it in the browser's store.
    fn key(&self) -> &'static str;
    /// What is shown at this moment.
    fn link(&self) -> Link;
    /// Shows something else.
    fn follow(&self, link: Link);
}

struct Keeper {
    page: &'static dyn Shows,
    /// What stands in the address.
    written: String,
    step: Step,
    waiting: Option<Timeout>,
}

thread_local! {
    static KEEPER: RefCell<Option<Keeper>> = const { RefCell::new(None) };
}

/// Brings back what the address says, or what was shown at the last visit. From now on the address
/// follows what is shown, and what is shown the address.
pub fn keep(page: impl Shows) {
    let page: &'static dyn Shows = Box::leak(Box::new(page));
    KEEPER.set(Some(Keeper { page, written: String::new(), step: Step::Typed, waiting: None }));
    spawn_local(async {
        if !follow().await {
            let mut link = browser::remembered(page.key()).map(|kept| read(&kept)).unwrap_or_default();
            link.options.settings = kept_settings(&browser::remembered(SETTINGS).unwrap_or_default());
            page.follow(link);
            renew(Step::Typed);
        }
    });
    browser::on_window("popstate", || {
        spawn_local(async {
            follow().await;
        });
    });
    browser::on_window("pagehide", || {
        spawn_local(write());
    });
}

/// Shows what the address says; whether it says something.
async fn follow() -> bool {
    let fragment = here();
    let plain = match fragment.strip_prefix(COMPRESSED) {
        _ if fragment.len() > LONGEST => None,
        Some(packed) => unpacked(packed).await,
        None => Some(fragment.clone()),
    };
    let Some(page) = KEEPER.with_borrow_mut(|keeper| {
        let keeper = keeper.as_mut()?;
        keeper.written.clone_from(&fragment);
        // What was to be written is of before.
        keeper.waiting = None;
        Some(keeper.page)
    }) else {
        return false;
    };
    match plain {
        Some(plain) if plain.contains('=') => page.follow(read(&plain)),
        Some(_) => return false,
        None => browser::say("This link is damaged, or was cut on its way: what it held cannot be shown."),
    }
    true
}

/// Something else is shown: the address follows at the next pause. Browsers refuse pages that
/// change theirs at every keystroke.
pub fn renew(step: Step) {
    const PAUSE: u32 = 400;
    KEEPER.with_borrow_mut(|keeper| {
        if let Some(keeper) = keeper {
            if step == Step::Chosen {
                keeper.step = step;
            }
            // What waited before is dropped, and so never done.
            keeper.waiting = Some(Timeout::new(PAUSE, || spawn_local(write())));
        }
    });
}

/// Writes what is shown into the address, and into the browser's store for the next visit.
async fn write() {
    let Some(page) = KEEPER.with_borrow(|keeper| Some(keeper.as_ref()?.page)) else { return };
    let fragment = fragment(&page.link());
    browser::remember(page.key(), if fragment.len() > LONGEST_KEPT { "" } else { &fragment });
    let fragment = packed(fragment).await.unwrap_or_default();
    KEEPER.with_borrow_mut(|keeper| {
        let Some(keeper) = keeper else { return };
        let step = std::mem::replace(&mut keeper.step, Step::Typed);
        if keeper.written == fragment {
            return;
        }
        let address = format!("#{fragment}");
        // A browser that refuses it leaves the address as it was.
        let _ = window().history().and_then(|history| match step {
            Step::Chosen => history.push_state_with_url(&JsValue::NULL, "", Some(&address)),
            Step::Typed => history.replace_state_with_url(&JsValue::NULL, "", Some(&address)),
        });
        keeper.written = fragment;
    });
}

/// Copies the link to what is shown, and says so, or why there is none.
pub fn copy_link() {
    spawn_local(async {
        let Some(page) = KEEPER.with_borrow(|keeper| Some(keeper.as_ref()?.page)) else { return };
        let address = window().location().href().unwrap_or_default();
        let address = address.split('#').next().unwrap_or_default();
        match packed(fragment(&page.link())).await {
            Some(fragment) => {
                browser::copy(&format!("{address}#{fragment}"));
                browser::say("The link is copied. It holds all that is shown; no server sees it.");
            }
            None => browser::say(
                "This is too long for a link, even compressed: mail programs and chats cut links of more than \
                 30,000 characters. Send it as a file.",
            ),
        }
    });
}

/// What stands behind the `#` of a link.
pub fn fragment(link: &Link) -> String {
    let encoded = |text: &str| String::from(encode_uri_component(text)).replace("%20", "+");
    let pairs: Vec<String> =
        link.pairs().iter().map(|(key, value)| format!("{}={}", encoded(key), encoded(value))).collect();
    pairs.join("&")
}

/// The link that [`fragment`] wrote; what is damaged is left out.
fn read(fragment: &str) -> Link {
    let decoded = |text: &str| decode_uri_component(&text.replace('+', " ")).ok().map(String::from);
    Link::read(fragment.split('&').filter_map(|pair| {
        let (key, value) = pair.split_once('=')?;
        Some((decoded(key)?, decoded(value)?))
    }))
}

fn here() -> String {
    let hash = window().location().hash().unwrap_or_default();
    hash.strip_prefix('#').unwrap_or_default().to_owned()
}

/// A fragment as short as it gets; `None` if that is still too long.
async fn packed(fragment: String) -> Option<String> {
    if fragment.len() <= LONGEST_PLAIN {
        return Some(fragment);
    }
    let bytes = through(fragment.into_bytes(), CompressionStream::new(DEFLATE).ok()?.as_ref()).await?;
    if bytes.len() > LONGEST {
        return None;
    }
    let characters: String = bytes.into_iter().map(char::from).collect();
    let text = window().btoa(&characters).ok()?;
    let text: String = text.chars().filter(|c| *c != '=').map(|c| swap(c, "+/", "-_")).collect();
    (text.len() <= LONGEST).then(|| format!("{COMPRESSED}{text}"))
}

async fn unpacked(text: &str) -> Option<String> {
    let text: String = text.chars().map(|c| swap(c, "-_", "+/")).collect();
    let bytes: Vec<u8> = window().atob(&text).ok()?.chars().map(|c| c as u8).collect();
    String::from_utf8(through(bytes, DecompressionStream::new(DEFLATE).ok()?.as_ref()).await?).ok()
}

/// The digits of base64 that mean something else in an address.
fn swap(c: char, from: &str, to: &str) -> char {
    from.chars().zip(to.chars()).find(|(from, _)| *from == c).map_or(c, |(_, to)| to)
}

// web-sys has these two for its unstable interfaces only; every browser has had them since 2023.
#[wasm_bindgen]
extern "C" {
    type CompressionStream;

    #[wasm_bindgen(constructor, catch)]
    fn new(format: &str) -> Result<CompressionStream, JsValue>;

    type DecompressionStream;

    #[wasm_bindgen(constructor, catch)]
    fn new(format: &str) -> Result<DecompressionStream, JsValue>;
}

/// What comes out of a stream that `bytes` go into.
async fn through(bytes: Vec<u8>, stream: &JsValue) -> Option<Vec<u8>> {
    let whole = Response::new_with_opt_js_u8_array(Some(&Uint8Array::from(&bytes[..]))).ok()?;
    let stream = whole.body()?.pipe_through(stream.unchecked_ref::<ReadableWritablePair>());
    let response = Response::new_with_opt_readable_stream(Some(&stream)).ok()?;
    let buffer: ArrayBuffer = JsFuture::from(response.array_buffer().ok()?).await.ok()?.into();
    Some(Uint8Array::new(&buffer).to_vec())
}
