//! Bytes that are no telegram: registers by themselves, a parameter channel, process data, a configuration.

use super::{PROFILES, PROTOCOLS, Profile, Settings};
use crate::device::Process;
use crate::dialogue::Certainty;
use crate::field::{Argument, Direction, Field, Message, Order, Span, problems};
use crate::frame::{Content, Speaker};
use crate::message;
use crate::walk;

/// One way to read bytes that are no telegram.
#[derive(Clone, Debug)]
pub struct BlockReading {
    pub device: &'static Profile,
    /// "Status and 32-bit float, 2 blocks".
    pub kind: Message,
    /// What they say, in a sentence.
    pub said: Message,
    /// The fields; their leaves tile the bytes.
    pub fields: Vec<Field>,
    /// What speaks for it.
    pub reason: Message,
    /// What nobody can tell from the bytes: "which channel it is".
    pub unknown: Message,
    pub certainty: Certainty,
    /// How much speaks for it, in bits of chance.
    pub bits: i32,
}

/// The ways to read `bytes` as something of the device, or of any where none is chosen, best first. What
/// more speaks against than for is left out, unless it is of the chosen device and not wrong.
///
/// ```
/// use buslens::tool::{Profile, Settings, blocks};
///
/// let bytes = [0x00, 0x80, 0x42, 0xA4, 0xF1, 0xDE];
/// let best = &blocks(&bytes, Profile::of("memograph-rsg45"), &Settings::default())[0];
/// assert_eq!(best.said.to_string(), "82.4724, good");
/// ```
pub fn blocks(bytes: &[u8], device: Option<&'static Profile>, settings: &Settings) -> Vec<BlockReading> {
    let mut found = Vec::new();
    for profile in
        PROFILES.iter().copied().filter(|profile| device.is_none_or(|device| device.key == profile.key))
    {
        if profile.ident.is_some() {
            found.extend(services(bytes, profile, settings));
            found.extend(process(bytes, profile, settings));
        } else {
            found.extend(registers(bytes, profile, settings));
        }
    }
    // Of a device that is chosen, what is possible is worth a word.
    found.retain(|reading| reading.bits > 0 || device.is_some() && problems(&reading.fields).is_empty());
    let mut best: Vec<BlockReading> = Vec::with_capacity(found.len());
    for reading in found {
        best.insert(best.partition_point(|better| better.bits >= reading.bits), reading);
    }
    let second = best.get(1).map_or(0, |second| second.bits);
    for (index, reading) in best.iter_mut().enumerate() {
        let clear = index == 0 && reading.bits >= ENOUGH && reading.bits >= second + AHEAD;
        reading.certainty = if clear { Certainty::Likely } else { Certainty::Open };
    }
    best
}

/// From so many bits on, and so many before the next, a reading is likely.
const ENOUGH: i32 = 8;
const AHEAD: i32 = 3;

fn registers(bytes: &[u8], profile: &'static Profile, settings: &Settings) -> Vec<BlockReading> {
    let likely = profile.likely(bytes, &settings.device);
    let reading = |likely: crate::device::Likely| {
        let kind = match likely.blocks {
            1 => likely.kind,
            blocks => message!("{kind}, {n} blocks", kind = likely.kind, n = blocks),
        };
        BlockReading {
            device: profile,
            kind,
            said: likely.said,
            reason: likely.reason,
            unknown: likely.unknown,
            certainty: Certainty::Open,
            bits: likely.bits,
            fields: likely.fields,
        }
    };
    likely.into_iter().map(reading).collect()
}

/// What goes by itself on PROFIBUS.
fn services(bytes: &[u8], profile: &'static Profile, settings: &Settings) -> Vec<BlockReading> {
    let mut settings = settings.frame.clone();
    settings.profibus.ident = settings.profibus.ident.or(profile.ident);
    let bare =
        PROTOCOLS.iter().filter(|protocol| (protocol.verdict)(bytes) == crate::frame::Verdict::NoCheck);
    let of = |protocol: &&'static crate::frame::Protocol| {
        let fit = (protocol.fit)(bytes, &settings);
        let direction = match protocol.speaker {
            Speaker::Turns(leaning) if leaning(bytes) > 0 => Direction::Response,
            Speaker::Always(direction) => direction,
            _ => Direction::Request,
        };
        let mut frame = (protocol.expect)(bytes, direction, &settings);
        let fields = walk::read(frame.as_mut(), bytes).fields;
        let Content::Profibus { kind, .. } = frame.content() else { return None };
        let unknown = match protocol.speaker {
            Speaker::Turns(_) => message!("the bytes do not tell which station, nor for sure who speaks"),
            _ => message!("the bytes do not tell which station"),
        };
        (fit.bits > 0).then(|| BlockReading {
            device: profile,
            kind: message!("{kind}", kind = Argument::Term(kind.spec.label)),
            said: frame.meaning(),
            reason: fit.reason,
            unknown,
            certainty: Certainty::Open,
            bits: fit.bits as i32 - 2 * problems(&fields).len() as i32,
            fields,
        })
    };
    bare.filter_map(of).collect()
}

/// Process data by themselves, towards the device and from it.
fn process(bytes: &[u8], profile: &'static Profile, settings: &Settings) -> Vec<BlockReading> {
    const MOST: usize = 16;
    if bytes.is_empty() || bytes.len() > MOST || !bytes.len().is_multiple_of(2) {
        return Vec::new();
    }
    let layout = settings.frame.profibus.layout;
    let order = if settings.frame.profibus.swap_process { Order::Little } else { Order::Big };
    let of = |output: bool| {
        let process = Process { output, bytes, span: Span::new(0, bytes.len()), order };
        let said = profile.process(&process, &settings.device);
        let things = said.sentence()?;
        let fits = if output { layout.outputs } else { layout.inputs } == bytes.len();
        let kind = if output { message!("process output data") } else { message!("process input data") };
        Some(BlockReading {
            device: profile,
            kind,
            said: things,
            reason: match fits {
                true => message!("they are as long as the configuration says"),
                false => message!("they are whole words, at most 16 bytes"),
            },
            unknown: message!(
                "the bytes do not tell whether they go to the slave or come from it, nor which it is"
            ),
            certainty: Certainty::Open,
            bits: if fits { 3 } else { 1 },
            fields: said.blocks.into_iter().map(|block| block.field).collect(),
        })
    };
    [false, true].into_iter().filter_map(of).collect()
}
