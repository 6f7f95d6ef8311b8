//! The telegrams of a log as a capture for Wireshark, pcapng.
//!
//! Wireshark opens it without any setting: Modbus RTU comes as what its dissector of that name takes, Modbus
//! TCP as packets of IP and TCP. What Wireshark has no dissector for is there byte for byte. Beside each
//! telegram stands what it says and how it went, as the packet's comment (`frame.comment`).

use std::collections::BTreeMap;
use std::net::{IpAddr, Ipv4Addr, SocketAddr};

use super::list::brief;
use super::{Log, Source};
use crate::capture::{About, Writer};
use crate::field::Direction;
use crate::frame::{modbus_rtu, modbus_tcp};
use crate::tool::decode::Report;

/// A capture that is written part by part.
#[derive(Debug, Default)]
pub struct CaptureFile(Writer);

impl CaptureFile {
    /// What the file begins with.
    pub fn begin(&self) -> Vec<u8> {
        self.0.begin()
    }

    /// The telegrams `indices` of a log that counts them, with what a person noted on them by their numbers.
    ///
    /// ```
    /// use buslens::tool::log::{CaptureFile, Log, Reading};
    /// use buslens::tool::Options;
    ///
    /// let text = b"TX: 01 03 00 C8 00 03 84 35\nRX: 01 83 02 C0 F1\n".as_slice();
    /// let log = Log::read(text, &Reading::default(), Options::default()).unwrap();
    /// let mut file = CaptureFile::default();
    /// let bytes = [file.begin(), file.telegrams(&log, &text, &[0, 1], &Default::default())].concat();
    /// let again = Log::read(&bytes, &Reading::default(), Options::default()).unwrap();
    /// assert_eq!(again.bytes(&&bytes[..], &again.entry(1))[..], [0x01, 0x83, 0x02, 0xC0, 0xF1]);
    /// ```
    pub fn telegrams(
        &mut self,
        log: &Log,
        source: &dyn Source,
        indices: &[usize],
        notes: &BTreeMap<usize, String>,
    ) -> Vec<u8> {
        let entries = log.entries();
        let counted =
            indices.iter().copied().filter(|index| entries.get(*index).is_some_and(|entry| entry.counts()));
        let counted: Vec<usize> = counted.collect();
        // A response says more when its request is known.
        let read = log.with_partners(counted.iter().copied());
        let report = log.report(source, &read);
        let mut written = Vec::new();
        for index in counted {
            let comment = read.binary_search(&index).map(|place| comment(log, &report, place, notes));
            let comment = comment.unwrap_or_default();
            let entry = &log.entry(index);
            let about = About {
                time: entry.time(),
                from_client: Some(entry.direction == Direction::Request),
                comment: &comment,
            };
            let bytes = &*log.bytes(source, entry);
            written.extend(match entry.protocol() {
                protocol if protocol.is(&modbus_tcp::PROTOCOL) => {
                    let (client, server) = log.ends(entry.port);
                    self.0.tcp(client, server, bytes, about)
                }
                protocol if protocol.is(&modbus_rtu::PROTOCOL) => self.0.serial("mbrtu", bytes, about),
                // On the line are the characters, where they are what is sent.
                protocol => match protocol.characters {
                    Some(characters) => self.0.serial("data", characters(bytes).as_bytes(), about),
                    None => self.0.serial("data", bytes, about),
                },
            });
        }
        written
    }
}

/// What a telegram says, how it went, and what a person noted.
fn comment(log: &Log, report: &Report, place: usize, notes: &BTreeMap<usize, String>) -> String {
    let Some((telegram, detail)) = report.telegrams.get(place).zip(report.detail(place)) else {
        return String::new();
    };
    let entry = telegram.number.checked_sub(1).and_then(|index| log.entries().get(index));
    let state = entry.map(|entry| log.state(&entry)).filter(|state| state.is_wrong());
    let parts = [
        state.map(|state| format!("[{}]", state.word())),
        Some(brief(&detail.said)),
        notes.get(&telegram.number).map(|note| format!("Note: {note}")),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join(" ")
}

impl Log {
    /// Client and server of a connection: as the capture has them, or else addresses that are set aside for
    /// documentation.
    ///
    /// Source: RFC 5737, section 3.
    fn ends(&self, port: u16) -> (SocketAddr, SocketAddr) {
        const CLIENT: u16 = 49_152;
        const MODBUS: u16 = 502;
        if let Some(connection) =
            self.capture().and_then(|capture| capture.connections().get(usize::from(port).checked_sub(1)?))
        {
            return (connection.client, connection.server);
        }
        let end = |last, port| SocketAddr::new(IpAddr::V4(Ipv4Addr::new(192, 0, 2, last)), port);
        (end(1, CLIENT.saturating_add(port)), end(2, MODBUS))
    }
}
