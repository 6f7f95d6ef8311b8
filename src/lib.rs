//! The page: reads and builds field-bus telegrams in a browser.
//!
//! What telegrams are is the library's, `buslens`; the page sees of it only [`buslens::tool`] and the
//! words of [`buslens::field`].
#![forbid(unsafe_code)]

#[cfg(feature = "page")]
pub mod app;
