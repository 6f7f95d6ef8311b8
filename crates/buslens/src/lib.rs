//! Buslens reads and builds field-bus telegrams.
//!
//! The data's way, and the modules on it, each of which may use only those before it:
//!
//! - [`field`]: what a field is, what it held, what there is to say about it;
//! - [`walk`]: a telegram described once, and the walkers that read, write, edit and explain it;
//! - [`modbus`]: function codes; [`profibus`]: services; [`frame`]: what carries them over a line;
//! - [`device`]: what the makers' manuals say about registers and parameters;
//! - [`text`]: pasted text and logs into bytes, each with its place in the text;
//! - `capture`: captures of networks into the bytes of their connections (feature `captures`);
//! - [`dialogue`]: who speaks, and which response answers which request;
//! - [`tool`]: decoding and export, plain data in and plain data out.
//!
//! No input panics; reading a telegram never fails, what is wrong with it is part of what is read.
#![forbid(unsafe_code)]

#[cfg(feature = "captures")]
pub mod capture;
pub mod device;
pub mod dialogue;
pub mod field;
pub mod frame;
pub mod modbus;
pub mod profibus;
pub mod text;
pub mod tool;
pub mod walk;
