//! Telegrams made of what is to be asked of a device.

use crate::device::{Access, Asked, Draft};
use crate::field::{Direction, Message, Order};
use crate::frame::{Cargo, Content, Frame, Protocol};
use crate::message;
use crate::modbus::{Pdu, Server, exceptions};
use crate::profibus::{Channel, Service, Settings, parameter_channel};

/// The request that `draft` is, for a unit.
///
/// ```
/// use buslens::tool::{PROFILES, PROTOCOLS, build};
/// use buslens::walk::{Deviations, form, write};
///
/// let memograph = PROFILES.iter().find(|profile| profile.key == "memograph-rsg45").unwrap();
/// let task = memograph.tasks().into_iter().find(|task| task.label().to_string() == "write Universal channel at 200 to 319").unwrap();
/// let mut draft = task.draft();
/// draft.number = 6;
/// let mut request = build(&mut draft, 1, PROTOCOLS[0]).unwrap();
/// assert_eq!(write(request.as_mut(), &Deviations::default())[..7], [0x01, 0x10, 0x00, 0xD7, 0x00, 0x03, 0x06]);
/// ```
pub fn build(draft: &mut Draft, unit: u8, protocol: &Protocol) -> Result<Box<dyn Frame>, Message> {
    let asked = draft.asked()?;
    let cargo = if draft.by_index() { channel(&asked) } else { registers(&asked)? };
    (protocol.carry)(unit, cargo).ok_or_else(|| {
        message!("{protocol} does not carry such a telegram", protocol = protocol.label.to_owned())
    })
}

/// The responses that can follow a request over Modbus: that of a healthy server first, with zeros for
/// what it would read, then those that refuse it. None to a broadcast or to a response.
pub fn replies(request: &mut dyn Frame) -> Vec<Box<dyn Frame>> {
    if matches!(request.content(), Content::Modbus { server: Server::All, .. }) {
        return Vec::new();
    }
    let Some(pdu) = request.pdu().filter(|pdu| pdu.direction == Direction::Request) else {
        return Vec::new();
    };
    let mut replies = vec![pdu.reply()];
    replies.extend(exceptions().iter().map(|code| pdu.refusal(code.value as u8)));
    replies.into_iter().filter_map(|reply| request.around(reply)).collect()
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

fn channel(asked: &Asked) -> Cargo {
    let request = &parameter_channel::REQUEST;
    let mut channel = Channel::new(request.direction, &Settings::default());
    let (service, length) = match asked.access {
        Access::Write => (Service::Write, asked.width),
        _ => (Service::Read, 1),
    };
    channel.ask(service, length, 1);
    (channel.index, channel.subindex) = (asked.address, asked.subindex);
    channel.value = Order::Big.number(&asked.values) as u32;
    Cargo::Profibus(request, Box::new(channel))
}
