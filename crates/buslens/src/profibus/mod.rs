//! PROFIBUS-DP telegrams without their frame: what a master and a slave tell each other, service
//! by service.
//!
//! Seen from the line: a *request* comes from the master (class 1: the controller), a *response*
//! from the slave. One file for each service; [`KINDS`] lists their telegrams. What cyclic user
//! data carries is in [`parameter_channel`]; [`jobs`] follows a sequence of it, [`client`] makes one.

mod chk_cfg;
pub mod client;
pub mod configuration;
mod data_exchange;
mod get_cfg;
mod global_control;
pub mod ident;
pub mod jobs;
mod no_data;
pub mod parameter_channel;
mod read_inputs;
mod read_outputs;
mod set_prm;
mod set_slave_address;
mod slave_diag;
mod unknown;
mod user_data;

pub use parameter_channel::{Channel, Refusal, Service};
pub use user_data::{Process, Side};

use crate::field::{Direction, Field, Message, Span, Spec, Value};
use crate::walk::Telegram;

/// Every telegram of every service. Where a slave only acknowledges (short, without data) or says
/// nothing, there is no response.
pub static KINDS: &[&Kind] = &[
    &data_exchange::REQUEST,
    &data_exchange::RESPONSE,
    &set_slave_address::REQUEST,
    &read_inputs::REQUEST,
    &read_inputs::RESPONSE,
    &read_outputs::REQUEST,
    &read_outputs::RESPONSE,
    &global_control::REQUEST,
    &get_cfg::REQUEST,
    &get_cfg::RESPONSE,
    &slave_diag::REQUEST,
    &slave_diag::RESPONSE,
    &set_prm::REQUEST,
    &chk_cfg::REQUEST,
];

/// Kinds without a service access point of their own: the parameter channel by itself, and
/// whatever is not in [`KINDS`].
pub static OTHER_KINDS: &[&Kind] =
    &[&parameter_channel::REQUEST, &parameter_channel::RESPONSE, &unknown::REQUEST, &unknown::RESPONSE];

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

impl Kind {
    /// The kind of a telegram to or from the slave's `sap`.
    pub fn of(sap: Option<u8>, direction: Direction) -> &'static Kind {
        let listed = KINDS.iter().find(|kind| kind.sap == sap && kind.direction == direction);
        match (listed, direction) {
            (Some(kind), _) => kind,
            (None, Direction::Request) => &unknown::REQUEST,
            (None, Direction::Response) => &unknown::RESPONSE,
        }
    }
}

/// How a slave is set up, as far as its telegrams depend on it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Settings {
    /// ValueSwapping bit 1: index and 4-byte value of the parameter channel low byte first.
    pub swap_channel: bool,
    /// ValueSwapping bit 0: process data low byte first.
    pub swap_process: bool,
    pub layout: Layout,
    /// The ident number that the slave should have, where it is known.
    pub ident: Option<u16>,
    /// The layout was told, by a person or by Chk_Cfg, and not only assumed.
    pub told: bool,
    /// The slave said that it must be set up, and nobody has done that since.
    pub not_set_up: bool,
}

impl Settings {
    /// Whether other user data than the layout says are no fault: it is only what is delivered.
    pub fn is_assumed(&self) -> bool {
        !self.told && self.layout == Layout::default()
    }
}

/// How a slave is set up, as it says itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Diagnosis {
    /// It wants to be set up before it exchanges data.
    pub not_set_up: bool,
    /// The last configuration does not fit it.
    pub configuration_fault: bool,
}

/// What the cyclic user data of a slave consists of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// The first 8 bytes of both directions are the parameter channel.
    pub channel: bool,
    /// Bytes of process data from the master.
    pub outputs: usize,
    /// Bytes of process data to the master.
    pub inputs: usize,
}

/// The configuration `B7 A3 93`, which a KEB F5 has by default.
impl Default for Layout {
    fn default() -> Self {
        Self { channel: true, outputs: 4, inputs: 4 }
    }
}

/// What a telegram can say beyond its fields.
pub trait Body: Telegram {
    /// The telegram in one sentence; `who` is the slave ("station 5").
    fn meaning(&self, who: Message) -> Message;

    /// The parameter channel in it; it is at the beginning.
    fn channel(&self) -> Option<&Channel> {
        None
    }

    fn channel_mut(&mut self) -> Option<&mut Channel> {
        None
    }

    /// Takes from the request what a confirmation of the parameter channel does not repeat, before
    /// the confirmation is read.
    fn answer(&mut self, _request: &Channel) {}

    /// The process data in it.
    fn process(&self) -> Option<Process<'_>> {
        None
    }

    /// The layout of the user data, if the telegram says it.
    fn layout(&self) -> Option<Layout> {
        None
    }

    /// What the slave says of how it is set up, if this is its diagnosis.
    fn diagnosis(&self) -> Option<Diagnosis> {
        None
    }

    /// It sets up the slave.
    fn sets_up(&self) -> bool {
        false
    }
}

/// What a byte says by its names and bits.
fn number_meaning(spec: &'static Spec, byte: u8) -> Message {
    let field = Field::new(spec, Span::default(), Value::Number { raw: byte.into(), width: 1 });
    field.meaning().unwrap_or(Message::term(""))
}
