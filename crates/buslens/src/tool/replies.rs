//! What can come back to a request.

use crate::device::{PROFILES, Profile};
use crate::field::{Argument, Direction, Message};
use crate::frame::{Cargo, Content, Frame};
use crate::message;
use crate::modbus::{Server, exceptions};
use crate::profibus::{self, Body, KINDS, Kind, OTHER_KINDS, Refusal, Service};

/// A response to a request.
pub struct Reply {
    /// "Exception 2, illegal data address".
    pub label: Message,
    pub frame: Box<dyn Frame>,
}

/// The responses that can follow a request: that of a healthy device first, with zeros for what it would
/// read, unless that is more than a telegram can hold; then those that refuse it. None to a broadcast, to a
/// response, and to what is answered without data. The device tells which codes it refuses with besides those
/// of the standard.
pub fn replies(
    request: &mut dyn Frame,
    settings: &profibus::Settings,
    device: Option<&'static Profile>,
) -> Vec<Reply> {
    let cargo = match request.content() {
        Content::Modbus { server: Server::All, .. } | Content::Nothing(_) => Vec::new(),
        Content::Modbus { .. } => registers(request, device),
        Content::Profibus { kind, body, .. } => service(kind, body, settings),
    };
    let back = |(label, cargo)| request.back(cargo).map(|frame| Reply { label, frame });
    cargo.into_iter().filter_map(back).collect()
}

/// Function codes that makers may use as they like; whose they are tells whose device it is.
const MAKERS: [std::ops::RangeInclusive<u8>; 2] = [65..=72, 100..=110];

fn registers(request: &mut dyn Frame, device: Option<&'static Profile>) -> Vec<(Message, Cargo)> {
    let Some(pdu) = request.pdu().filter(|pdu| pdu.direction == Direction::Request) else {
        return Vec::new();
    };
    let mut replies: Vec<_> =
        pdu.reply().map(|reply| (healthy(), Cargo::Modbus(reply))).into_iter().collect();
    let function = pdu.function;
    let own = MAKERS.iter().any(|codes| codes.contains(&function));
    let maker = || PROFILES.iter().copied().find(|profile| own && profile.functions.contains(&function));
    let device = device.or_else(maker);
    let common = exceptions().iter().filter(|code| {
        device.is_none_or(|profile| profile.common_exceptions.iter().any(|it| u64::from(*it) == code.value))
    });
    let more = device.and_then(|profile| profile.exceptions);
    for code in common.chain(more.map_or(&[][..], |spec| spec.names)) {
        let (number, name) = (code.value as u8, Argument::Term(code.label));
        let label = message!("exception {code}, {name}", code = number, name = name);
        replies.push((label, Cargo::Modbus(pdu.refusal(number))));
    }
    replies
}

fn service(kind: &Kind, body: &dyn Body, settings: &profibus::Settings) -> Vec<(Message, Cargo)> {
    let same = |other: &&&Kind| {
        (other.sap, other.spec.label, other.direction) == (kind.sap, kind.spec.label, Direction::Response)
    };
    let Some(response) =
        KINDS.iter().chain(OTHER_KINDS).find(same).filter(|_| kind.direction == Direction::Request)
    else {
        return Vec::new();
    };
    let answer = |refusal| {
        let mut answer = (response.new)(settings);
        if let (Some(channel), Some(asked)) = (answer.channel_mut(), body.channel()) {
            channel.confirm(asked, refusal);
        }
        Cargo::Profibus(response, answer)
    };
    let mut replies = vec![(healthy(), answer(None))];
    if let Some(channel) = body.channel().filter(|channel| channel.service() != Service::None) {
        replies.extend(Refusal::possible(channel.service()).map(|(refusal, name)| {
            let (number, name) = (refusal.number(), Argument::Term(name.label));
            (message!("error {number}, {name}", number = number, name = name), answer(Some(refusal)))
        }));
    }
    replies
}

fn healthy() -> Message {
    message!("the normal response")
}
