//! What the page and the command line offer: plain data in, plain data out.

pub mod annotated;
mod blocks;
mod build;
pub mod byte;
pub mod checksums;
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
mod proposals;
mod replies;
mod search;
pub mod settings;
pub mod setup;
pub mod steps;
mod values;
mod views;

pub use crate::device::{Block, Draft, PROFILES, Profile, Task};
pub use crate::dialogue::Certainty;
pub use crate::frame::{PROTOCOLS, Protocol, Verdict};
pub use crate::text::{Remark, Style};
pub use crate::walk::form::{Content, Entry, Misfit, parse_value};
pub use crate::walk::guide::{Row, Size};
pub use blocks::{BlockReading, blocks};
pub use build::build;
pub use decode::{Options, Report, Settings, Summary, Telegram};
pub use detail::Detail;
pub use editor::{Answer, Editor};
pub use entries::{Change, Entries};
pub use explain::Explanation;
pub use log::{decode, decode_file, decode_pasted};
pub use offers::{Offer, offers};
pub use proposals::{Proposal, proposals};
pub use replies::{Reply, replies};
pub use search::{Found, search};
pub use values::{ValueFinding, value_findings};
pub use views::{Kind, View, guess, views};
