//! The shape that the services with user data share: the parameter channel (8 bytes) where the
//! configuration has one, then the process data as 16-bit words.

use super::parameter_channel::LENGTH;
use super::{Body, Channel, Settings};
use crate::field::{Direction, Format, Message, Order, Severity, Spec, hex_value};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

/// Whose data it is, seen from the master.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// From the master, such as the control word.
    Outputs,
    /// From the slave, such as the status word.
    Inputs,
}

/// The process data of a telegram.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Process<'a> {
    pub side: Side,
    /// Where it begins in the user data, in bytes; each word takes two. The last byte of an odd
    /// number comes behind the words.
    pub offset: usize,
    pub words: &'a [u16],
    /// The words come low byte first.
    pub swapped: bool,
}

/// User data of one side.
pub struct UserData {
    side: Side,
    /// Not exchanged, but read from the slave by another service.
    read: bool,
    channel: Option<Channel>,
    swapped: bool,
    /// Bytes of process data by the configuration.
    size: usize,
    /// The configuration was not seen: so many bytes are delivered.
    assumed: bool,
    /// The slave said before that it must be set up.
    not_set_up: bool,
    words: Vec<u16>,
    /// The last byte of an odd number.
    odd: u8,
}

impl UserData {
    pub fn exchanged(side: Side, settings: &Settings) -> Self {
        let (direction, size) = match side {
            Side::Outputs => (Direction::Request, settings.layout.outputs),
            Side::Inputs => (Direction::Response, settings.layout.inputs),
        };
        Self {
            side,
            read: false,
            channel: settings.layout.channel.then(|| Channel::new(direction, settings)),
            swapped: settings.swap_process,
            size,
            assumed: settings.is_assumed(),
            not_set_up: settings.not_set_up,
            words: vec![0; size / 2],
            odd: 0,
        }
    }

    pub fn read(side: Side, settings: &Settings) -> Self {
        Self { read: true, ..Self::exchanged(side, settings) }
    }

    /// "0400h, 05DCh", or nothing.
    fn listed(&self) -> Option<String> {
        let odd = (!self.size.is_multiple_of(2)).then(|| hex_value(self.odd.into(), 1));
        let words = self.words.iter().map(|word| hex_value((*word).into(), 2));
        let values: Vec<String> = words.chain(odd).map(|value| value.to_string()).collect();
        (!values.is_empty()).then(|| values.join(", "))
    }
}

impl Telegram for UserData {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        if let Some(channel) = &mut self.channel {
            w.within(&CHANNEL, &mut |w| channel.walk(w))?;
        }
        let words = match self.side {
            Side::Outputs => &OUTPUTS,
            Side::Inputs => &INPUTS,
        };
        if self.assumed {
            self.size = self.size_there(w);
        }
        if self.size > 1 {
            let word = if self.swapped { &words.low_first } else { &words.word };
            w.list(&words.list, &mut self.words, self.size / 2, Some(1), |w, value| w.u16(word, value))?;
        }
        if !self.size.is_multiple_of(2) {
            w.u8(&words.odd, &mut self.odd)?;
        }
        if self.assumed && self.size != AS_DELIVERED {
            let message = message!(
                "{size} bytes of process data, and no Chk_Cfg before that tells the layout: the factory setting is {usual}. Set what the master configures under Devices",
                size = self.size,
                usual = AS_DELIVERED
            );
            w.remark(&words.list, Severity::Warning, "layout-unknown", message);
        }
        if self.not_set_up && !self.read {
            let message = message!(
                "the slave said that it must be set up: before Set_Prm and Chk_Cfg it exchanges no data"
            );
            w.remark(&words.list, Severity::Warning, "not-set-up", message);
        }
        Ok(())
    }
}

impl UserData {
    /// The bytes that are there, where they can be process data.
    fn size_there(&mut self, w: &mut dyn Walker) -> usize {
        let kept = self.words.len();
        let words = &mut self.words;
        let there = w.ahead(0, &mut |w| {
            w.list(&OUTPUTS.list, words, kept, Some(1), |w, value| w.u16(&OUTPUTS.word, value))
        });
        match there {
            Some(there @ 2..=MOST) if there % 2 == 0 => there as usize,
            _ => AS_DELIVERED,
        }
    }
}

/// Bytes each way in the configuration `B7 A3 93`, and the most that there can be.
const AS_DELIVERED: usize = 4;
const MOST: u64 = 16;

impl Body for UserData {
    fn meaning(&self, who: Message) -> Message {
        let process = match (self.listed(), self.side, self.read) {
            (None, Side::Outputs, false) => message!("send {who} no outputs", who = who.clone()),
            (None, Side::Outputs, true) => message!("{who} has no outputs", who = who.clone()),
            (None, Side::Inputs, _) => message!("{who} has no inputs", who = who.clone()),
            (Some(data), Side::Outputs, false) => {
                message!("send {who} outputs {data}", who = who.clone(), data = data)
            }
            (Some(data), Side::Outputs, true) => {
                message!("{who} has outputs {data}", who = who.clone(), data = data)
            }
            (Some(data), Side::Inputs, _) => {
                message!("{who} has inputs {data}", who = who.clone(), data = data)
            }
        };
        match &self.channel {
            // What a channel says to those who read it along is not said to them.
            Some(channel) if !self.read => {
                message!("{channel}; {process}", channel = channel.meaning(who), process = process)
            }
            _ => process,
        }
    }

    fn channel(&self) -> Option<&Channel> {
        self.channel.as_ref()
    }

    fn channel_mut(&mut self) -> Option<&mut Channel> {
        self.channel.as_mut()
    }

    fn answer(&mut self, request: &Channel) {
        if let Some(channel) = &mut self.channel {
            channel.answer(request);
        }
    }

    fn process(&self) -> Option<Process<'_>> {
        let offset = if self.channel.is_some() { LENGTH } else { 0 };
        Some(Process { side: self.side, offset, words: &self.words, swapped: self.swapped })
    }
}

static CHANNEL: Spec = Spec::new("channel", "Parameter channel")
    .short("Channel")
    .note("A job to read or write one parameter, or its confirmation.")
    .source(SOURCE);

/// The words for the process data of one side.
struct Words {
    list: Spec,
    word: Spec,
    low_first: Spec,
    /// A last byte without another to make a word of.
    odd: Spec,
}

static OUTPUTS: Words = Words {
    list: Spec::new("outputs", "Outputs").note("Process data from the master to the slave.").source(SOURCE),
    word: OUTPUT,
    low_first: OUTPUT.order(Order::Little),
    odd: Spec::new("output", "Output byte").short("Output").format(Format::Hex).note(ODD),
};

static INPUTS: Words = Words {
    list: Spec::new("inputs", "Inputs").note("Process data from the slave to the master.").source(SOURCE),
    word: INPUT,
    low_first: INPUT.order(Order::Little),
    odd: Spec::new("input", "Input byte").short("Input").format(Format::Hex).note(ODD),
};

const OUTPUT: Spec = Spec::new("output", "Output word").short("Output").format(Format::Register).note(
    "What it means, the slave's process data mapping says. A value of 32 bits takes two words. Outputs go on to \
     the inverter only when they change.",
);
const INPUT: Spec = Spec::new("input", "Input word").short("Input").format(Format::Register).note(NOTE);

const NOTE: &str =
    "What it means, the slave's process data mapping says. A value of 32 bits takes two words.";
const ODD: &str = "The last byte of process data whose number of bytes is odd.";

const SOURCE: &str = "KEB COMBIVERT F5 PROFIBUS-DP operator, 7.4";
