use std::fmt;

use super::write;
use pcap_parser::pcapng::{Block, PcapNGOption, parse_block_be, parse_block_le};
use pcap_parser::{Linktype, parse_pcap_frame, parse_pcap_frame_be, parse_pcap_header};

/// The file formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    Pcap,
    Pcapng,
}

impl Format {
    /// By the magic number: of pcap in both byte orders and with micro- or nanoseconds, or the first
    /// block of pcapng.
    pub fn of(beginning: &[u8]) -> Option<Self> {
        match beginning.get(..4)? {
            [0xA1, 0xB2, 0xC3, 0xD4]
            | [0xD4, 0xC3, 0xB2, 0xA1]
            | [0xA1, 0xB2, 0x3C, 0x4D]
            | [0x4D, 0x3C, 0xB2, 0xA1] => Some(Self::Pcap),
            [0x0A, 0x0D, 0x0D, 0x0A] => Some(Self::Pcapng),
            _ => None,
        }
    }

    pub const fn name(self) -> &'static str {
        match self {
            Self::Pcap => "capture of a network (pcap)",
            Self::Pcapng => "capture of a network (pcapng)",
        }
    }
}

/// What keeps a capture from being read to its end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fault {
    NoCapture,
    /// The file ends within a block.
    Cut {
        packets: usize,
        there: usize,
        of: usize,
    },
    /// A block that cannot be one.
    Damaged {
        offset: u64,
        why: &'static str,
    },
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoCapture => write!(f, "This does not begin as a capture does (pcap or pcapng)."),
            Self::Cut { packets, there, of } => write!(
                f,
                "The capture ends in the middle: behind packet {packets}, {there} of {of} bytes are there. All before that was read."
            ),
            Self::Damaged { offset, why } => {
                write!(f, "The capture is damaged at byte {offset}: {why}. All before that was read.")
            }
        }
    }
}

/// What a packet begins with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Link {
    Ethernet,
    Ip,
    /// Linux "cooked": the header's length, and where in it the type is.
    Cooked {
        length: usize,
        at: usize,
    },
    /// Four bytes of address family.
    Loopback,
    /// Nothing: the bytes of a serial line, as many programs write them.
    Serial,
    /// The name of a dissector of Wireshark, as it exports what it read.
    Named,
    Other,
}

impl Link {
    /// What a packet begins with, by its bytes: Ethernet or IP, if its lengths fit.
    pub fn tell(bytes: &[u8]) -> Option<Self> {
        const HEADER: usize = 14;
        const TAG: usize = 4;
        let kind = |at: usize| bytes.get(at..at + 2).map(|kind| [kind[0], kind[1]]);
        let inside = match kind(HEADER - 2)? {
            [0x08, 0x00] | [0x86, 0xDD] => HEADER,
            [0x81, 0x00] => HEADER + TAG,
            _ => return is_ip(bytes).then_some(Self::Ip),
        };
        match is_ip(bytes.get(inside..).unwrap_or_default()) {
            true => Some(Self::Ethernet),
            false => is_ip(bytes).then_some(Self::Ip),
        }
    }

    fn of(link: Linktype) -> Self {
        match link.0 {
            1 => Self::Ethernet,
            12 | 14 | 101 | 228 | 229 => Self::Ip,
            113 => Self::Cooked { length: 16, at: 14 },
            276 => Self::Cooked { length: 20, at: 0 },
            0 | 108 => Self::Loopback,
            // Free for anybody; serial lines are what is met there on a field bus.
            147..=162 => Self::Serial,
            252 => Self::Named,
            _ => Self::Other,
        }
    }
}

/// Whether bytes are a packet of IP with TCP or UDP, up to padding at the end.
fn is_ip(bytes: &[u8]) -> bool {
    const V6_HEADER: usize = 40;
    let number = |at: usize| usize::from(u16::from_be_bytes([bytes[at], bytes[at + 1]]));
    let carries = |kind: u8| matches!(kind, 6 | 17);
    match bytes.first() {
        Some(0x45..=0x4F) if bytes.len() >= 20 => {
            (20..=bytes.len()).contains(&number(2)) && carries(bytes[9])
        }
        Some(0x60..=0x6F) if bytes.len() >= V6_HEADER => {
            number(4) + V6_HEADER <= bytes.len() && carries(bytes[6])
        }
        _ => false,
    }
}

/// A packet as it was captured.
#[derive(Debug)]
pub struct Packet<'a> {
    /// Microseconds since 1970, or as a text says.
    pub time: Option<i64>,
    /// Where its block begins in the file.
    pub offset: u64,
    /// The line of a text that it begins in; 0 in a file of packets.
    pub line: u32,
    pub link: Link,
    /// Whoever wrote the file sent it, or received it.
    pub sent: Option<bool>,
    pub bytes: &'a [u8],
}

/// Reads the blocks of a file.
#[derive(Debug, Default)]
pub struct Packets {
    /// What has come of a block whose end is missing.
    carry: Vec<u8>,
    /// Where `carry` begins in the file.
    offset: u64,
    state: State,
    packets: usize,
}

#[derive(Debug, Default)]
enum State {
    #[default]
    Beginning,
    Pcap {
        big: bool,
        nanoseconds: bool,
        link: Link,
    },
    Pcapng {
        big: bool,
        interfaces: Vec<Interface>,
    },
    Damaged,
}

/// An interface of a section of a pcapng file.
#[derive(Clone, Copy, Debug)]
struct Interface {
    link: Link,
    /// Units of time in a second.
    units: u64,
    /// Seconds.
    offset: i64,
}

/// Microseconds in 35,000 years: a time further away is none, and differences of others fit.
const FURTHEST: u64 = 1 << 60;

/// No block is longer: a length above is a sign of damage.
const LONGEST: usize = 1 << 26;

impl Packets {
    /// Takes the next part of the file.
    pub fn push(&mut self, part: &[u8], sink: &mut dyn FnMut(Packet<'_>)) -> Result<(), Fault> {
        if matches!(self.state, State::Damaged) {
            return Ok(());
        }
        self.carry.extend_from_slice(part);
        let carry = std::mem::take(&mut self.carry);
        let mut at = 0;
        let outcome = loop {
            match self.block(&carry[at..], self.offset + at as u64, sink) {
                Ok(Some(length)) => at += length,
                Ok(None) => break Ok(()),
                Err(fault) => {
                    self.state = State::Damaged;
                    break Err(fault);
                }
            }
        };
        self.offset += at as u64;
        self.carry = carry;
        self.carry.drain(..at);
        outcome
    }

    /// The file ends.
    pub fn finish(&mut self) -> Result<(), Fault> {
        let there = self.carry.len();
        match self.state {
            State::Damaged => Ok(()),
            _ if there == 0 => Ok(()),
            State::Beginning => Err(Fault::NoCapture),
            _ => Err(Fault::Cut { packets: self.packets, there, of: self.length(&self.carry).unwrap_or(16) }),
        }
    }

    /// How long the block is that begins so, as it says itself.
    fn length(&self, bytes: &[u8]) -> Option<usize> {
        let number = |at: usize, big: bool| {
            let bytes = bytes.get(at..at + 4)?.try_into().ok()?;
            Some(if big { u32::from_be_bytes(bytes) } else { u32::from_le_bytes(bytes) } as usize)
        };
        match &self.state {
            State::Beginning | State::Damaged => None,
            State::Pcap { big, .. } => number(8, *big).map(|captured| captured.saturating_add(16)),
            State::Pcapng { big, .. } => {
                // A section begins with its own byte order.
                let section = bytes.starts_with(&[0x0A, 0x0D, 0x0D, 0x0A]);
                let big = if section { bytes.get(8..12)? == [0x1A, 0x2B, 0x3C, 0x4D] } else { *big };
                number(4, big)
            }
        }
    }

    /// Reads one block, and says how long it is; `None` where its end is missing.
    fn block(
        &mut self,
        bytes: &[u8],
        offset: u64,
        sink: &mut dyn FnMut(Packet<'_>),
    ) -> Result<Option<usize>, Fault> {
        const HEADER: usize = 24;
        if let State::Beginning = self.state {
            match Format::of(bytes) {
                None if bytes.len() < 4 => return Ok(None),
                None => return Err(Fault::NoCapture),
                Some(Format::Pcapng) => self.state = State::Pcapng { big: false, interfaces: Vec::new() },
                Some(Format::Pcap) if bytes.len() < HEADER => return Ok(None),
                Some(Format::Pcap) => {
                    let (_, header) = parse_pcap_header(&bytes[..HEADER]).map_err(|_| Fault::NoCapture)?;
                    self.state = State::Pcap {
                        big: header.is_bigendian(),
                        nanoseconds: header.is_nanosecond_precision(),
                        link: Link::of(header.network),
                    };
                    return Ok(Some(HEADER));
                }
            }
        }
        let Some(length) = self.length(bytes) else { return Ok(None) };
        let damaged = |why| Fault::Damaged { offset, why };
        if length > LONGEST {
            return Err(damaged("a packet of more than 64 MB is announced"));
        }
        if matches!(self.state, State::Pcapng { .. }) && (length < 12 || !length.is_multiple_of(4)) {
            return Err(damaged("a block has a length that no block has"));
        }
        let Some(block) = bytes.get(..length) else { return Ok(None) };
        match &mut self.state {
            State::Beginning | State::Damaged => return Ok(None),
            State::Pcap { big, nanoseconds, link } => {
                let frame = if *big { parse_pcap_frame_be(block) } else { parse_pcap_frame(block) };
                let (_, frame) = frame.map_err(|_| damaged("a packet's header cannot be one"))?;
                let fraction = i64::from(frame.ts_usec) / if *nanoseconds { 1000 } else { 1 };
                self.packets += 1;
                sink(Packet {
                    time: Some(i64::from(frame.ts_sec) * 1_000_000 + fraction),
                    offset,
                    line: 0,
                    link: *link,
                    sent: None,
                    bytes: frame.data,
                });
            }
            State::Pcapng { big, interfaces } => {
                if block.starts_with(&[0x0A, 0x0D, 0x0D, 0x0A]) {
                    *big = block.get(8..12) == Some(&[0x1A, 0x2B, 0x3C, 0x4D]);
                    interfaces.clear();
                }
                let parsed = if *big { parse_block_be(block) } else { parse_block_le(block) };
                let (_, parsed) = parsed.map_err(|_| damaged("a block is not laid out as its kind is"))?;
                let known = |index: u32| interfaces.get(index as usize).copied();
                let (interface, stamp, data) = match &parsed {
                    Block::InterfaceDescription(it) => {
                        interfaces.push(Interface {
                            link: Link::of(it.linktype),
                            units: it.ts_resolution().unwrap_or(1_000_000).max(1),
                            offset: it.ts_offset(),
                        });
                        return Ok(Some(length));
                    }
                    Block::EnhancedPacket(it) => {
                        let stamp = u64::from(it.ts_high) << 32 | u64::from(it.ts_low);
                        let data = it.data.get(..it.caplen as usize).unwrap_or(it.data);
                        (known(it.if_id), stamp, data)
                    }
                    Block::SimplePacket(it) => {
                        let data = it.data.get(..it.origlen as usize).unwrap_or(it.data);
                        (known(0), 0, data)
                    }
                    _ => return Ok(Some(length)),
                };
                self.packets += 1;
                if let Some(Interface { link, units, offset: since }) = interface {
                    let micros = i128::from(stamp) * 1_000_000 / i128::from(units);
                    let simple = matches!(parsed, Block::SimplePacket(_));
                    let time = i64::try_from(micros + i128::from(since) * 1_000_000).ok();
                    let time = time.filter(|time| !simple && time.unsigned_abs() < FURTHEST);
                    let sent = match &parsed {
                        Block::EnhancedPacket(it) => sent(&it.options, *big),
                        _ => None,
                    };
                    sink(Packet { time, offset, line: 0, link, sent, bytes: data });
                }
            }
        }
        Ok(Some(length))
    }
}

/// Whether a packet went out, where its options tell.
fn sent(options: &[PcapNGOption<'_>], big: bool) -> Option<bool> {
    let flags = options.iter().find(|option| option.code.0 == write::FLAGS)?;
    let bytes = flags.value.get(..4)?.try_into().ok()?;
    let flags = if big { u32::from_be_bytes(bytes) } else { u32::from_le_bytes(bytes) };
    match flags & 3 {
        write::INBOUND => Some(false),
        write::OUTBOUND => Some(true),
        _ => None,
    }
}
