//! What the page and the command line offer: plain data in, plain data out.

pub mod annotated;
mod build;
pub mod byte;
pub mod copy;
pub mod csv;
mod decode;
mod detail;
mod editor;
mod entries;
pub mod examples;
mod explain;
#[cfg(feature = "json")]
pub mod json;
pub mod link;
pub mod log;
mod offers;
mod replies;
pub mod settings;
pub mod steps;
mod views;

pub use crate::device::{Block, Draft, PROFILES, Profile, Task};
pub use crate::dialogue::Certainty;
pub use crate::frame::{PROTOCOLS, Protocol, Verdict};
pub use crate::text::{Remark, Style};
pub use crate::walk::form::{Content, Entry, parse_value};
pub use crate::walk::guide::{Row, Size};
pub use build::build;
pub use decode::{Options, Report, Settings, Summary, Telegram};
pub use detail::Detail;
pub use editor::Editor;
pub use entries::{Change, Entries};
pub use explain::Explanation;
pub use log::{decode, decode_file};
pub use offers::{Offer, offers};
pub use replies::{Reply, replies};
pub use views::{Kind, View, guess, views};
