//! Streams of the browser as streams of Rust, and back.
//!
//! Leptos depends on `wasm-streams` for its server functions, which a static page does not have.
//! That crate exports JavaScript classes, and what is exported cannot be left out of the page: it
//! would cost every visitor about 7 kB, gzipped. This one has the same names, as far as Leptos uses
//! them, exports nothing, and so weighs nothing until somebody calls it.

use std::cell::RefCell;
use std::rc::Rc;

use futures_util::stream::{self, Stream, StreamExt};
use js_sys::{Object, Reflect};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, future_to_promise};
use web_sys::{ReadableStreamDefaultController, ReadableStreamDefaultReader};

/// A stream that can be read.
#[derive(Debug)]
pub struct ReadableStream(web_sys::ReadableStream);

impl ReadableStream {
    /// Takes a stream of the browser.
    pub fn from_raw(raw: web_sys::ReadableStream) -> Self {
        Self(raw)
    }

    /// Gives back the stream of the browser.
    pub fn into_raw(self) -> web_sys::ReadableStream {
        self.0
    }

    /// Makes a stream of the browser that takes its chunks from `chunks` when it is read.
    ///
    /// # Panics
    ///
    /// If the browser refuses to make a stream, which the standard gives it no reason for.
    pub fn from_stream(chunks: impl Stream<Item = Result<JsValue, JsValue>> + 'static) -> Self {
        let chunks = Rc::new(RefCell::new(Some(Box::pin(chunks))));
        let pull = Closure::<dyn FnMut(ReadableStreamDefaultController) -> js_sys::Promise>::new(
            move |controller: ReadableStreamDefaultController| {
                let chunks = chunks.clone();
                future_to_promise(async move {
                    // The browser does not pull again before this promise is kept.
                    let Some(mut rest) = chunks.take() else { return Ok(JsValue::UNDEFINED) };
                    match rest.next().await {
                        Some(chunk) => {
                            controller.enqueue_with_chunk(&chunk?)?;
                            chunks.replace(Some(rest));
                        }
                        None => controller.close()?,
                    }
                    Ok(JsValue::UNDEFINED)
                })
            },
        );
        let source = Object::new();
        let stream = Reflect::set(&source, &"pull".into(), &pull.into_js_value())
            .and_then(|_| web_sys::ReadableStream::new_with_underlying_source(&source));
        Self(stream.expect_throw("a readable stream of an object with a function pull"))
    }

    /// The chunks of the stream, one after the other, up to its end or its first error.
    ///
    /// # Panics
    ///
    /// If somebody else is reading the stream.
    pub fn into_stream(self) -> impl Stream<Item = Result<JsValue, JsValue>> + 'static {
        let reader = ReadableStreamDefaultReader::new(&self.0).expect_throw("a stream that nobody reads");
        stream::unfold(Some(reader), |reader| async {
            let reader = reader?;
            match next(&reader).await {
                Ok(chunk) => chunk.map(|chunk| (Ok(chunk), Some(reader))),
                Err(error) => Some((Err(error), None)),
            }
        })
    }
}

async fn next(reader: &ReadableStreamDefaultReader) -> Result<Option<JsValue>, JsValue> {
    let read = JsFuture::from(reader.read()).await?;
    let done = Reflect::get(&read, &"done".into())?.is_truthy();
    if done { Ok(None) } else { Reflect::get(&read, &"value".into()).map(Some) }
}
