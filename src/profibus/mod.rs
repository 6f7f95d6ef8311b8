//! PROFIBUS-DP telegrams without their frame: what a master and a slave tell each other, service
//! by service.
//!
//! Seen from the line: a *request* comes from the master (class 1: the controller), a *response*
//! from the slave. One file for each telegram; [`KINDS`] lists them.

use crate::field::{Direction, Message, Spec};
use crate::walk::Telegram;

/// Every telegram of every service.
pub static KINDS: &[&Kind] = &[];

/// One telegram of one service, in one direction.
#[derive(Debug)]
pub struct Kind {
    /// The service access point of the slave; `None` for data exchange, which uses none.
    pub sap: Option<u8>,
    pub direction: Direction,
    /// What the telegram is called, and where it is described.
    pub spec: Spec,
    /// An empty telegram of this kind, for a slave with these settings.
    pub new: fn(&Settings) -> Box<dyn Body>,
}

/// How a slave is set up, as far as its telegrams depend on it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Settings {
    /// ValueSwapping bit 1: index and 4-byte value of the parameter channel low byte first.
    pub swap_channel: bool,
    /// ValueSwapping bit 0: process data low byte first.
    pub swap_process: bool,
}

/// What a telegram can say beyond its fields.
pub trait Body: Telegram {
    /// The telegram in one sentence; `who` is the slave ("station 5").
    fn meaning(&self, who: Message) -> Message;
}
