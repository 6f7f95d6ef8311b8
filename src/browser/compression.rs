//! Compressed text for addresses, by what the browser has for that.

use leptos::prelude::*;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;
use web_sys::js_sys::{Reflect, Uint8Array};
use web_sys::{ReadableStreamDefaultReader, ReadableWritablePair, Response};

/// Has no header.
const DEFLATE: &str = "deflate-raw";

/// No link of Buslens holds more, see `LONGEST_KEPT`; without an end, a link of some thousand characters
/// could hold gigabytes.
const MOST: usize = 2_000_000;

/// Why a text is not unpacked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Refusal {
    Damaged,
    TooMuch,
}

/// `text` in base64url, compressed.
pub async fn packed(text: String) -> Option<String> {
    let stream = CompressionStream::new(DEFLATE).ok()?;
    let bytes = through(text.into_bytes(), stream.as_ref(), usize::MAX).await.ok()?;
    let characters: String = bytes.into_iter().map(char::from).collect();
    let text = window().btoa(&characters).ok()?;
    Some(text.chars().filter(|c| *c != '=').map(|c| swapped(c, "+/", "-_")).collect())
}

/// What [`packed`] made.
pub async fn unpacked(text: &str) -> Result<String, Refusal> {
    let text: String = text.chars().map(|c| swapped(c, "-_", "+/")).collect();
    let characters = window().atob(&text).map_err(|_| Refusal::Damaged)?;
    let bytes: Vec<u8> = characters.chars().map(|c| c as u8).collect();
    let stream = DecompressionStream::new(DEFLATE).map_err(|_| Refusal::Damaged)?;
    let bytes = through(bytes, stream.as_ref(), MOST).await?;
    String::from_utf8(bytes).map_err(|_| Refusal::Damaged)
}

/// The digits of base64 that mean something else in an address.
fn swapped(c: char, from: &str, to: &str) -> char {
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

/// What comes out of a stream that `bytes` go into, if that is at most `most` bytes.
async fn through(bytes: Vec<u8>, stream: &JsValue, most: usize) -> Result<Vec<u8>, Refusal> {
    let damaged = |_| Refusal::Damaged;
    let whole = Response::new_with_opt_js_u8_array(Some(&Uint8Array::from(&bytes[..]))).map_err(damaged)?;
    let body = whole.body().ok_or(Refusal::Damaged)?;
    let stream = body.pipe_through(stream.unchecked_ref::<ReadableWritablePair>());
    let reader = stream.get_reader().unchecked_into::<ReadableStreamDefaultReader>();
    let mut out = Vec::new();
    loop {
        let part = JsFuture::from(reader.read()).await.map_err(damaged)?;
        if Reflect::get(&part, &"done".into()).is_ok_and(|done| done.is_truthy()) {
            return Ok(out);
        }
        let part = Reflect::get(&part, &"value".into()).map_err(damaged)?;
        out.extend(Uint8Array::new(&part).to_vec());
        if out.len() > most {
            let _ = reader.cancel();
            return Err(Refusal::TooMuch);
        }
    }
}
