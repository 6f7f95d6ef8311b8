//! Writing a capture: pcapng, with what there is to say of a packet as its comment.
//!
//! What a serial line carried has no packets of a network. It is written as Wireshark writes what one of
//! its dissectors was given (link type 252): the dissector's name, then the bytes. So Wireshark reads it
//! without any setting. What went over TCP is written as packets of IP (link type 101).
//!
//! Sources: draft-ietf-opsawg-pcapng, sections 4.1 to 4.3; the link types of tcpdump.org; RFC 791, 8200 and
//! 9293 for the headers; RFC 1071 for their checksums.

use std::collections::HashMap;
use std::net::{IpAddr, SocketAddr};

/// The kinds of interfaces of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Serial,
    Network,
}

impl Kind {
    const fn link(self) -> u16 {
        match self {
            Self::Serial => UPPER_PDU,
            Self::Network => 101,
        }
    }

    const fn name(self) -> &'static str {
        match self {
            Self::Serial => "serial line",
            Self::Network => "network",
        }
    }
}

/// The link type of bytes for a dissector that is named before them.
pub(super) const UPPER_PDU: u16 = 252;
/// The tag of the dissector's name, and that behind which the bytes begin.
pub(super) const DISSECTOR: u16 = 12;
pub(super) const END: u16 = 0;

/// What is known of bytes that are written.
#[derive(Clone, Copy, Debug, Default)]
pub struct About<'a> {
    /// Microseconds.
    pub time: Option<i64>,
    /// The client sent it, or a server; `None` where nobody knows.
    pub from_client: Option<bool>,
    /// Shown with the packet.
    pub comment: &'a str,
}

/// Writes a capture, block by block.
#[derive(Debug, Default)]
pub struct Writer {
    interfaces: Vec<Kind>,
    /// The numbers of the next byte that each end sends.
    numbers: HashMap<(SocketAddr, SocketAddr), u32>,
}

impl Writer {
    /// What a file begins with.
    pub fn begin(&self) -> Vec<u8> {
        let mut body = 0x1A2B_3C4D_u32.to_le_bytes().to_vec();
        body.extend(1_u16.to_le_bytes());
        body.extend(0_u16.to_le_bytes());
        // How long the section is: not said.
        body.extend(u64::MAX.to_le_bytes());
        option(&mut body, 4, b"Buslens");
        option(&mut body, 0, b"");
        block(0x0A0D_0D0A, body)
    }

    /// A telegram of a serial line, for this dissector of Wireshark.
    pub fn serial(&mut self, dissector: &str, bytes: &[u8], about: About<'_>) -> Vec<u8> {
        let name = dissector.as_bytes();
        let padded = name.len().next_multiple_of(4);
        let mut packet = DISSECTOR.to_be_bytes().to_vec();
        packet.extend((padded as u16).to_be_bytes());
        packet.extend(name);
        packet.resize(packet.len() + padded - name.len(), 0);
        packet.extend(END.to_be_bytes());
        packet.extend([0, 0]);
        packet.extend(bytes);
        self.packet(Kind::Serial, &packet, about)
    }

    /// A telegram of a TCP connection from its client to its server; or back, where the server sent it.
    pub fn tcp(&mut self, client: SocketAddr, server: SocketAddr, bytes: &[u8], about: About<'_>) -> Vec<u8> {
        let (from, to) = if about.from_client == Some(false) { (server, client) } else { (client, server) };
        let number = *self.numbers.get(&(from, to)).unwrap_or(&1);
        let seen = *self.numbers.get(&(to, from)).unwrap_or(&1);
        self.numbers.insert((from, to), number.wrapping_add(bytes.len() as u32));
        let packet = ip(from, to, tcp(from, to, number, seen, bytes));
        self.packet(Kind::Network, &packet, about)
    }

    /// A packet, after its interface where it is the first one of it.
    fn packet(&mut self, kind: Kind, packet: &[u8], about: About<'_>) -> Vec<u8> {
        let known = self.interfaces.iter().position(|other| *other == kind);
        let mut written = if known.is_some() { Vec::new() } else { interface(kind) };
        let index = known.unwrap_or_else(|| {
            self.interfaces.push(kind);
            self.interfaces.len() - 1
        });
        // Each packet has a time in such a file: the beginning, where none is known.
        let time = u64::try_from(about.time.unwrap_or_default()).unwrap_or_default();
        let mut body = (index as u32).to_le_bytes().to_vec();
        body.extend(((time >> 32) as u32).to_le_bytes());
        body.extend((time as u32).to_le_bytes());
        body.extend((packet.len() as u32).to_le_bytes());
        body.extend((packet.len() as u32).to_le_bytes());
        body.extend(packet);
        pad(&mut body);
        if !about.comment.is_empty() {
            option(&mut body, 1, about.comment.as_bytes());
        }
        if let Some(from_client) = about.from_client {
            // Whoever listens to a bus stands beside the client.
            let flags: u32 = if from_client { OUTBOUND } else { INBOUND };
            option(&mut body, FLAGS, &flags.to_le_bytes());
        }
        option(&mut body, 0, b"");
        written.extend(block(6, body));
        written
    }
}

/// The option of a packet that says whether it went out or came in.
pub(super) const FLAGS: u16 = 2;
pub(super) const INBOUND: u32 = 1;
pub(super) const OUTBOUND: u32 = 2;

fn interface(kind: Kind) -> Vec<u8> {
    let mut body = kind.link().to_le_bytes().to_vec();
    body.extend([0; 6]);
    option(&mut body, 2, kind.name().as_bytes());
    option(&mut body, 0, b"");
    block(1, body)
}

/// A block with its length before and behind it.
fn block(kind: u32, mut body: Vec<u8>) -> Vec<u8> {
    pad(&mut body);
    let length = (body.len() as u32 + 12).to_le_bytes();
    [&kind.to_le_bytes(), &length, body.as_slice(), &length].concat()
}

fn option(body: &mut Vec<u8>, code: u16, value: &[u8]) {
    /// The length has two bytes; a letter may be cut in two here, which is shown as such.
    const LONGEST: usize = 0xFFFF;
    let value = &value[..value.len().min(LONGEST)];
    body.extend(code.to_le_bytes());
    body.extend((value.len() as u16).to_le_bytes());
    body.extend(value);
    pad(body);
}

fn pad(body: &mut Vec<u8>) {
    body.resize(body.len().next_multiple_of(4), 0);
}

/// A segment whose checksum is right.
fn tcp(from: SocketAddr, to: SocketAddr, number: u32, seen: u32, bytes: &[u8]) -> Vec<u8> {
    const PUSH_AND_ACKNOWLEDGE: u8 = 0x18;
    let mut segment = from.port().to_be_bytes().to_vec();
    segment.extend(to.port().to_be_bytes());
    segment.extend(number.to_be_bytes());
    segment.extend(seen.to_be_bytes());
    segment.extend([0x50, PUSH_AND_ACKNOWLEDGE, 0xFF, 0xFF, 0, 0, 0, 0]);
    segment.extend(bytes);
    let mut covered = [octets(from.ip()), octets(to.ip())].concat();
    covered.extend((segment.len() as u32).to_be_bytes());
    covered.extend([0, 0, 0, TCP]);
    covered.extend(&segment);
    segment[16..18].copy_from_slice(&checksum(&covered).to_be_bytes());
    segment
}

/// The protocol that IP carries.
const TCP: u8 = 6;

fn ip(from: SocketAddr, to: SocketAddr, segment: Vec<u8>) -> Vec<u8> {
    const HOPS: u8 = 64;
    let ends = [octets(from.ip()), octets(to.ip())].concat();
    let mut header = match from.ip() {
        IpAddr::V4(_) => {
            let mut header = vec![0x45, 0];
            header.extend((segment.len() as u16 + 20).to_be_bytes());
            header.extend([0, 0, 0x40, 0, HOPS, TCP, 0, 0]);
            header
        }
        IpAddr::V6(_) => {
            let mut header = vec![0x60, 0, 0, 0];
            header.extend((segment.len() as u16).to_be_bytes());
            header.extend([TCP, HOPS]);
            header
        }
    };
    header.extend(ends);
    if from.is_ipv4() {
        let checksum = checksum(&header);
        header[10..12].copy_from_slice(&checksum.to_be_bytes());
    }
    header.extend(segment);
    header
}

fn octets(address: IpAddr) -> Vec<u8> {
    match address {
        IpAddr::V4(address) => address.octets().to_vec(),
        IpAddr::V6(address) => address.octets().to_vec(),
    }
}

/// The complement of the sum of all words.
fn checksum(bytes: &[u8]) -> u16 {
    let words = bytes.chunks(2).map(|word| u32::from(word[0]) << 8 | u32::from(*word.get(1).unwrap_or(&0)));
    let mut sum = words.sum::<u32>();
    while sum > 0xFFFF {
        sum = (sum >> 16) + (sum & 0xFFFF);
    }
    !(sum as u16)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn checksums_are_those_of_the_standard() {
        // RFC 1071, section 3: the sum of these words is DDF2h.
        assert_eq!(checksum(&[0x00, 0x01, 0xF2, 0x03, 0xF4, 0xF5, 0xF6, 0xF7]), !0xDDF2);
        // Over what has its checksum in it, it is 0.
        let [client, server] = ["192.0.2.1:49152", "192.0.2.2:502"].map(|end| end.parse().unwrap());
        let packet = ip(client, server, tcp(client, server, 1, 1, b"odd"));
        assert_eq!(checksum(&packet[..20]), 0);
        assert_eq!(packet.len(), 43);
    }
}
