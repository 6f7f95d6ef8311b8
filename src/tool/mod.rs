//! What the page and the command line offer: plain data in, plain data out.

mod decode;
pub mod examples;
#[cfg(feature = "json")]
pub mod json;

pub use crate::dialogue::Certainty;
pub use crate::text::{Remark, Style};
pub use crate::walk::guide::{Row, Size};
pub use decode::{Detail, Options, Report, Summary, Telegram, Verdict, decode};
