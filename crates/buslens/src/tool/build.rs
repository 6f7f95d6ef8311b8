//! Telegrams made of what is to be asked of a device.

use crate::device::{Access, Asked, Draft};
use crate::field::{Direction, Message, Order};
use crate::frame::{Cargo, Content, Frame, Protocol, Settings};
use crate::message;
use crate::modbus::Pdu;
use crate::profibus::{Body, Kind, Service};

/// The request that `draft` is, for a unit.
///
/// ```
/// use buslens::frame::Settings;
/// use buslens::tool::{PROFILES, PROTOCOLS, build};
/// use buslens::walk::{Deviations, form, write};
///
/// let memograph = PROFILES.iter().find(|profile| profile.key == "memograph-rsg45").unwrap();
/// let task = memograph.tasks().into_iter().find(|task| task.label().to_string() == "write Universal channel at 200 to 319").unwrap();
/// let mut draft = task.draft();
/// draft.number = 6;
/// let mut request = build(&mut draft, 1, PROTOCOLS[0], &Settings::default()).unwrap();
/// assert_eq!(write(request.as_mut(), &Deviations::default())[..7], [0x01, 0x10, 0x00, 0xD7, 0x00, 0x03, 0x06]);
/// ```
pub fn build(
    draft: &mut Draft,
    unit: u8,
    protocol: &Protocol,
    settings: &Settings,
) -> Result<Box<dyn Frame>, Message> {
    let slot = slot(draft, protocol, settings)?;
    let asked = draft.asked()?;
    let cargo = match slot {
        Some((kind, body)) => job(&asked, kind, body),
        None => registers(&asked)?,
    };
    (protocol.carry)(unit, cargo).ok_or_else(|| does_not_carry(protocol))
}

pub(super) type Slot = (&'static Kind, Box<dyn Body>);

/// Where the protocol carries a job by index: the telegram whose parameter channel takes it, by itself
/// or before process data of 0. `None` for what goes by registers. The message says why the protocol
/// carries neither.
pub(super) fn slot(draft: &Draft, protocol: &Protocol, settings: &Settings) -> Result<Option<Slot>, Message> {
    let frame = (protocol.expect)(&[], Direction::Request, settings);
    match frame.content() {
        Content::Modbus { .. } if !draft.by_index() => Ok(None),
        Content::Profibus { kind, .. } if draft.by_index() => {
            let mut body = (kind.new)(&settings.profibus);
            match body.channel_mut() {
                Some(_) => Ok(Some((kind, body))),
                None => Err(does_not_carry(protocol)),
            }
        }
        _ => Err(does_not_carry(protocol)),
    }
}

pub(super) fn does_not_carry(protocol: &Protocol) -> Message {
    message!("{protocol} does not carry such a telegram", protocol = protocol.label.to_owned())
}

fn registers(asked: &Asked) -> Result<Cargo, Message> {
    let long = asked.width == 4;
    let count = u16::try_from(asked.count).map_err(|_| message!("too many registers"))?;
    Ok(Cargo::Modbus(match asked.access {
        Access::Write => {
            let values = asked.values.chunks(asked.width).map(|bytes| Order::Big.number(bytes) as u32);
            Pdu::writing(asked.address, values.collect(), long)
        }
        _ => Pdu::reading(asked.address, count, long),
    }))
}

fn job(asked: &Asked, kind: &'static Kind, mut body: Box<dyn Body>) -> Cargo {
    if let Some(channel) = body.channel_mut() {
        let (service, length) = match asked.access {
            Access::Write => (Service::Write, asked.width),
            _ => (Service::Read, 1),
        };
        channel.ask(service, length, asked.handshake & 1);
        (channel.index, channel.subindex) = (asked.address, asked.subindex);
        channel.value = Order::Big.number(&asked.values) as u32;
    }
    Cargo::Profibus(kind, body)
}
