//! MEI type 13 (0Dh): a CANopen general reference, laid out as CiA 309-2 says. Its data is kept as it is.

use super::{Carried, Interface, Opaque};
use crate::field::Spec;
use crate::message;
use crate::modbus::Length;

pub(super) static INTERFACE: Interface = Interface {
    number: 13,
    spec: Spec::new("canopen", "CANopen general reference")
        .note("Carries what a CANopen network is told or says.")
        .source("Modbus application protocol V1.1b3, 6.20"),
    request: CARRIED,
    response: CARRIED,
};

const CARRIED: Carried = Carried {
    length: Length::Open,
    new: || {
        Box::new(Opaque {
            meaning: |who, bytes| message!("{who}: CANopen, {bytes} of data", who = who, bytes = bytes),
            data: Vec::new(),
        })
    },
};
