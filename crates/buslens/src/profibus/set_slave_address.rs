//! Set_Slave_Add: give a slave another address.
//!
//! Layout, 4 bytes: new address (1), ident number (2), lock (1); then data of the device, if it has some.

use super::{Body, Kind, ident};
use crate::field::{Direction, Message, Name, Role, Spec};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

pub static REQUEST: Kind = Kind {
    sap: Some(55),
    direction: Direction::Request,
    spec: Spec::new("set_slave_address_request", "Set slave address")
        .short("Set_Slave_Add")
        .note("Gives the slave another address. Only slaves that keep it themselves know this service.")
        .source(SOURCE),
    new: |settings| {
        let ident = settings.ident.unwrap_or_default();
        Box::new(SetSlaveAddress { address: 1, ident, expected: settings.ident, lock: 0, data: Vec::new() })
    },
};

pub struct SetSlaveAddress {
    pub address: u8,
    pub ident: u16,
    /// The ident number that the slave has, where it is known.
    pub expected: Option<u16>,
    pub lock: u8,
    pub data: Vec<u8>,
}

impl Telegram for SetSlaveAddress {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        w.u8(&ADDRESS, &mut self.address)?;
        ident::walk(w, &mut self.ident, self.expected)?;
        w.u8(&LOCK, &mut self.lock)?;
        w.bytes(&DATA, &mut self.data, None)
    }
}

impl Body for SetSlaveAddress {
    fn meaning(&self, who: Message) -> Message {
        message!("give {who} the address {address}", who = who, address = self.address)
    }
}

static ADDRESS: Spec = Spec::new("new_address", "New address")
    .role(Role::Unit)
    .limits(0, 125)
    .note("Which address the slave is to have, 0 to 125.")
    .source(SOURCE);

static LOCK: Spec = Spec::new("address_lock", "Lock")
    .note("Whether the address can be changed again.")
    .source(SOURCE)
    .names(&[Name { value: 0, label: "can be changed again", note: "Any other value: not until a reset." }]);

static DATA: Spec = Spec::new("slave_data", "Data of the device")
    .short("Data")
    .role(Role::Unknown)
    .note("What these bytes mean, the device's maker says.");

const SOURCE: &str = "EN 50170, volume 2";
