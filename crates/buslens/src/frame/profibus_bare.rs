//! PROFIBUS telegrams by themselves, as a controller's monitor shows them: user data, parameter
//! channel, parameters, configuration, diagnosis, without the frame and its check.
//!
//! They carry no sign of what they are. What speaks for one of them are values that it must have.

use super::{Bus, Cargo, Content, Fit, Frame, Protocol, Settings, Speaker, Verdict};
use crate::field::{Direction, Message};
use crate::message;
use crate::profibus::{self, Body, Kind, parameter_channel};
use crate::walk::{Telegram, Walk, Walker};

pub static PARAMETER_CHANNEL: Protocol = Protocol {
    key: "profibus-parameter-channel",
    label: "PROFIBUS parameter channel",
    fit: |bytes, settings| match bytes.len() {
        parameter_channel::LENGTH => Fit {
            // Of such a device eight bytes are one, whatever they say.
            bits: parameter_channel::likeness(bytes, &settings.profibus)
                .max(if settings.bus == Some(Bus::Profibus) { OF_DEVICE } else { 0 }),
            reason: message!("8 bytes with handshake bit and index, as a parameter channel has them"),
        },
        _ => unlike(),
    },
    speaker: Speaker::Turns(parameter_channel::leaning),
    exchange: |_| Some(0),
    expect: |_, direction, settings| {
        let kind = match direction {
            Direction::Request => &parameter_channel::REQUEST,
            Direction::Response => &parameter_channel::RESPONSE,
        };
        Bare::expect(kind, settings)
    },
    ..WITHOUT_FRAME
};

pub static USER_DATA: Protocol = Protocol {
    key: "profibus-user-data",
    label: "PROFIBUS user data",
    fit: |bytes, settings| {
        let layout = settings.profibus.layout;
        let channel = if layout.channel { parameter_channel::LENGTH } else { 0 };
        let fits = [layout.outputs, layout.inputs].iter().any(|size| channel + size == bytes.len());
        match bytes.get(..parameter_channel::LENGTH) {
            Some(begin) if fits && layout.channel && bytes.len() > channel => Fit {
                // A little less than the channel by itself, since nothing speaks for the rest.
                bits: parameter_channel::likeness(begin, &settings.profibus).saturating_sub(1),
                reason: message!(
                    "parameter channel and process data of the length that the configuration says"
                ),
            },
            _ => unlike(),
        }
    },
    speaker: Speaker::Turns(parameter_channel::leaning),
    exchange: |_| Some(0),
    expect: |_, direction, settings| Bare::expect(Kind::of(None, direction), settings),
    ..WITHOUT_FRAME
};

pub static SET_PRM: Protocol = Protocol {
    key: "profibus-set-prm",
    label: "PROFIBUS Set_Prm",
    fit: |bytes, _| match bytes {
        [_, _, _, _, 0x05, 0xEB, _] => ident_fits(),
        _ => unlike(),
    },
    expect: |_, _, settings| Bare::expect(Kind::of(Some(61), Direction::Request), settings),
    ..WITHOUT_FRAME
};

pub static CHK_CFG: Protocol = Protocol {
    key: "profibus-chk-cfg",
    label: "PROFIBUS Chk_Cfg",
    fit: |bytes, _| match bytes {
        [0xB7, modules @ ..] if (1..17).contains(&modules.len()) => Fit {
            bits: 8,
            reason: message!("it begins with B7h, the configuration byte of the parameter channel"),
        },
        _ => unlike(),
    },
    expect: |_, _, settings| Bare::expect(Kind::of(Some(62), Direction::Request), settings),
    ..WITHOUT_FRAME
};

pub static SLAVE_DIAG: Protocol = Protocol {
    key: "profibus-slave-diag",
    label: "PROFIBUS Slave_Diag",
    fit: |bytes, _| match bytes {
        [_, _, _, _, 0x05, 0xEB] => ident_fits(),
        _ => unlike(),
    },
    speaker: Speaker::Always(Direction::Response),
    expect: |_, _, settings| Bare::expect(Kind::of(Some(60), Direction::Response), settings),
    ..WITHOUT_FRAME
};

pub static GLOBAL_CONTROL: Protocol = Protocol {
    key: "profibus-global-control",
    label: "PROFIBUS Global_Control",
    expect: |_, _, settings| Bare::expect(Kind::of(Some(58), Direction::Request), settings),
    ..WITHOUT_FRAME
};

/// What speaks for bytes of a device that speaks so.
const OF_DEVICE: u32 = 3;

/// What all of these have in common.
const WITHOUT_FRAME: Protocol = Protocol {
    key: "",
    label: "",
    fit: |_, _| unlike(),
    verdict: |_| Verdict::NoCheck,
    first: <[u8]>::len,
    unit: |_| None,
    speaker: Speaker::Always(Direction::Request),
    exchange: |_| None,
    waiting: 1,
    expect: |_, direction, settings| Bare::expect(Kind::of(None, direction), settings),
    characters: None,
    carry: |_, cargo| match cargo {
        Cargo::Modbus(_) => None,
        Cargo::Profibus(kind, body) => Some(Box::new(Bare { kind, body })),
    },
};

fn unlike() -> Fit {
    Fit { bits: 0, reason: message!("nothing speaks for it") }
}

fn ident_fits() -> Fit {
    Fit { bits: 16, reason: message!("the ident number 05EBh of a KEB F5 stands at its place") }
}

/// A telegram of a service without its frame.
struct Bare {
    kind: &'static Kind,
    body: Box<dyn Body>,
}

impl Bare {
    fn expect(kind: &'static Kind, settings: &Settings) -> Box<dyn Frame> {
        // Nothing but the layout tells where such bytes end.
        let settings = profibus::Settings { told: true, ..settings.profibus.clone() };
        Box::new(Self { kind, body: (kind.new)(&settings) })
    }
}

impl Telegram for Bare {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        self.body.walk(w)
    }
}

impl Frame for Bare {
    fn content(&self) -> Content<'_> {
        Content::Profibus { slave: None, kind: self.kind, body: self.body.as_ref() }
    }

    fn meaning(&self) -> Message {
        self.body.meaning(message!("the slave"))
    }

    fn answer(&mut self, request: &Content<'_>) {
        if let Content::Profibus { body, .. } = request
            && let Some(channel) = body.channel()
        {
            self.body.answer(channel);
        }
    }

    fn back(&self, response: Cargo) -> Option<Box<dyn Frame>> {
        (WITHOUT_FRAME.carry)(0, response)
    }
}
