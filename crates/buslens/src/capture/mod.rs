//! Captures of networks: pcap and pcapng files, taken in pieces of any size, into the bytes of TCP
//! connections and UDP datagrams in their order, and of serial lines; and written.
//!
//! | part | what it does |
//! | --- | --- |
//! | `packets` | the file: its blocks, interfaces and times |
//! | `connections` | TCP: order, repetitions, gaps |
//! | `write` | a file of what was read |
//!
//! Sources: draft-ietf-opsawg-pcap (pcap), draft-ietf-opsawg-pcapng (pcapng), RFC 9293 (TCP).

mod connections;
mod packets;
mod write;

pub use connections::{Connection, Segment};
pub use packets::{Fault, Format};
pub use write::{About, Writer};

use connections::Connections;
use etherparse::{EtherType, LaxNetSlice, LaxSlicedPacket, TransportSlice};
use packets::{Link, Packet, Packets};
use std::net::{IpAddr, SocketAddr};

/// Reads a capture.
#[derive(Debug, Default)]
pub struct Capture {
    packets: Packets,
    connections: Connections,
}

/// A packet that a text shows.
#[derive(Clone, Copy, Debug)]
pub struct Shown<'a> {
    pub bytes: &'a [u8],
    /// Microseconds.
    pub time: Option<i64>,
    /// Where it begins.
    pub line: u32,
    pub offset: u64,
}

impl Capture {
    /// Whether a file that begins so is a capture.
    pub fn recognises(beginning: &[u8]) -> Option<Format> {
        Format::of(beginning)
    }

    /// Takes the next part of the file, and gives what connections carried as soon as it is in
    /// order.
    pub fn push(&mut self, part: &[u8], sink: &mut dyn FnMut(Segment<'_>)) -> Result<(), Fault> {
        let Self { packets, connections } = self;
        packets.push(part, &mut |packet| read(&packet, connections, sink))
    }

    /// Whether bytes are a packet by themselves, as dumps show it.
    pub fn is_packet(bytes: &[u8]) -> bool {
        Link::tell(bytes).is_some()
    }

    /// Takes a packet that a text shows from a line on, which begins at `offset`.
    pub fn push_packet(&mut self, shown: Shown<'_>, sink: &mut dyn FnMut(Segment<'_>)) {
        let Shown { bytes, time, line, offset } = shown;
        let Some(link) = Link::tell(bytes) else { return };
        read(&Packet { time, offset, line, link, sent: None, bytes }, &mut self.connections, sink);
    }

    /// The file ends: gives what waits behind gaps.
    pub fn finish(&mut self, sink: &mut dyn FnMut(Segment<'_>)) -> Result<(), Fault> {
        self.connections.finish(sink);
        self.packets.finish()
    }

    /// The connections so far; [`Segment::connection`] counts them.
    pub fn connections(&self) -> &[Connection] {
        self.connections.list()
    }

    /// How many connections there are beyond those that are kept: they are not read.
    pub fn left_out(&self) -> usize {
        self.connections.left_out()
    }
}

/// Takes what a packet carries.
fn read(packet: &Packet<'_>, connections: &mut Connections, sink: &mut dyn FnMut(Segment<'_>)) {
    let serial = match packet.link {
        Link::Serial => Some(packet.bytes),
        Link::Named => named(packet.bytes),
        _ => None,
    };
    if let Some(bytes) = serial.filter(|bytes| !bytes.is_empty()) {
        return sink(Segment::of_line(packet, bytes));
    }
    let sliced = match packet.link {
        Link::Ethernet => LaxSlicedPacket::from_ethernet(packet.bytes).ok(),
        Link::Ip => LaxSlicedPacket::from_ip(packet.bytes).ok(),
        // A header of its own, at whose end is the type that Ethernet has.
        Link::Cooked { length, at } => {
            let kind = packet.bytes.get(at..at + 2).map(|kind| u16::from_be_bytes([kind[0], kind[1]]));
            let inside = packet.bytes.get(length..);
            kind.zip(inside).map(|(kind, inside)| LaxSlicedPacket::from_ether_type(EtherType(kind), inside))
        }
        Link::Loopback => packet.bytes.get(4..).and_then(|inside| LaxSlicedPacket::from_ip(inside).ok()),
        Link::Serial | Link::Named | Link::Other => None,
    };
    let ends = sliced.as_ref().and_then(|sliced| match &sliced.net {
        Some(LaxNetSlice::Ipv4(ip)) => {
            let header = ip.header();
            Some((IpAddr::from(header.source()), IpAddr::from(header.destination())))
        }
        Some(LaxNetSlice::Ipv6(ip)) => {
            let header = ip.header();
            Some((IpAddr::from(header.source()), IpAddr::from(header.destination())))
        }
        _ => None,
    });
    let transport = sliced.and_then(|sliced| sliced.transport);
    match (ends, transport) {
        (Some((from, to)), Some(TransportSlice::Tcp(tcp))) => {
            let ends =
                (SocketAddr::new(from, tcp.source_port()), SocketAddr::new(to, tcp.destination_port()));
            connections.tcp(packet, ends, &tcp, sink);
        }
        (Some((from, to)), Some(TransportSlice::Udp(udp))) => {
            let ends =
                (SocketAddr::new(from, udp.source_port()), SocketAddr::new(to, udp.destination_port()));
            connections.udp(packet, ends, udp.payload(), sink);
        }
        // Neither TCP nor UDP over IP.
        _ => {}
    }
}

/// What stands behind the name of the dissector that it is for, and other tags.
fn named(packet: &[u8]) -> Option<&[u8]> {
    let mut rest = packet;
    loop {
        let (head, behind) = rest.split_at_checked(4)?;
        let length = usize::from(u16::from_be_bytes([head[2], head[3]]));
        rest = behind.get(length..)?;
        if u16::from_be_bytes([head[0], head[1]]) == write::END {
            return Some(rest);
        }
    }
}
