//! Logs: files of any size, read by a worker.
//!
//! The worker (`worker`) is a wasm file of its own, without Leptos. It holds the log and draws what is to
//! be seen of it (`rows`, `summary`, `timeline`, `telegram`); the page (`desk`) only shows it. So the
//! page's thread is never blocked. They talk in `mail`.

pub mod desk;
mod mail;
mod rows;
mod summary;
mod telegram;
mod timeline;
pub mod worker;
