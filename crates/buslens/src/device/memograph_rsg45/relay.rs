//! Relays, register 3152. Written: relay (1 byte), state (1 byte). Read: a bit for each relay.

use crate::device::Settings;
use crate::field::{Bits, Name, Role, Spec};
use crate::walk::{Telegram, Walk, Walker};

pub fn write(_: &Settings) -> Box<dyn Telegram> {
    Box::new(Switch { relay: 1, state: 0 })
}

pub fn read(_: &Settings) -> Box<dyn Telegram> {
    Box::new(States { states: 0 })
}

/// Switches one relay.
struct Switch {
    relay: u8,
    state: u8,
}

impl Telegram for Switch {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        w.u8(&RELAY, &mut self.relay)?;
        w.u8(&STATE, &mut self.state)
    }
}

static RELAY: Spec = Spec::new("relay", "Relay")
    .role(Role::Address)
    .limits(1, 12)
    .note("The relay's number. The device must be set up to have it switched remotely.")
    .source("Memograph M RSG45 Modbus supplement, 2.6.10");

static STATE: Spec = Spec::new("state", "State")
    .limits(0, 1)
    .names(&[Name { value: 0, label: "inactive", note: "" }, Name { value: 1, label: "active", note: "" }])
    .note("Whether the relay is to be active.")
    .source("Memograph M RSG45 Modbus supplement, 2.6.10");

/// The states of all relays.
struct States {
    states: u16,
}

impl Telegram for States {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        w.u16(&STATES, &mut self.states)
    }
}

static STATES: Spec = Spec::new("states", "Relays")
    .short("Relays")
    .role(Role::Status)
    .bits(&[
        Bits::flag(0, "relay_1", "relay 1"),
        Bits::flag(1, "relay_2", "relay 2"),
        Bits::flag(2, "relay_3", "relay 3"),
        Bits::flag(3, "relay_4", "relay 4"),
        Bits::flag(4, "relay_5", "relay 5"),
        Bits::flag(5, "relay_6", "relay 6"),
        Bits::flag(6, "relay_7", "relay 7"),
        Bits::flag(7, "relay_8", "relay 8"),
        Bits::flag(8, "relay_9", "relay 9"),
        Bits::flag(9, "relay_10", "relay 10"),
        Bits::flag(10, "relay_11", "relay 11"),
        Bits::flag(11, "relay_12", "relay 12"),
        Bits::reserved(12, 4),
    ])
    .flagged("active", "none active")
    .note("Bit 0 is relay 1, and so on; 1 is active.")
    .source("Memograph M RSG45 Modbus supplement, 2.6.9");
