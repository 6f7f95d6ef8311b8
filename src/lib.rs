//! Buslens reads and builds field-bus telegrams.

#[cfg(feature = "page")]
pub mod app;
