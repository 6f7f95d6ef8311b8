//! Captures of networks that the tests make: every format, order and fault.

#![cfg(feature = "captures")]

use buslens::capture::{Capture, Fault, Segment};
use buslens::field::Direction;
use buslens::tool::Options;
use buslens::tool::log::{Log, Reading};
use proptest::prelude::*;

/// A packet of Ethernet, IPv4 and TCP.
fn packet(from_client: bool, number: u32, flags: u8, payload: &[u8]) -> Vec<u8> {
    let mut bytes = vec![2, 0, 0, 0, 0, 1, 2, 0, 0, 0, 0, 2, 8, 0];
    let length = (40 + payload.len()) as u16;
    let [client, server] = [[10, 0, 0, 5], [10, 0, 0, 9]];
    let (from, to) = if from_client { (client, server) } else { (server, client) };
    bytes.extend([0x45, 0]);
    bytes.extend(length.to_be_bytes());
    bytes.extend([0, 0, 0, 0, 64, 6, 0, 0]);
    bytes.extend(from);
    bytes.extend(to);
    let ports: [u16; 2] = if from_client { [49_152, 502] } else { [502, 49_152] };
    ports.iter().for_each(|port| bytes.extend(port.to_be_bytes()));
    bytes.extend(number.to_be_bytes());
    bytes.extend([0, 0, 0, 0, 0x50, flags, 0xFF, 0xFF, 0, 0, 0, 0]);
    bytes.extend(payload);
    bytes
}

const SYN: u8 = 2;
const ACK: u8 = 16;

/// The formats that a capture can be written in.
#[derive(Clone, Copy, Debug)]
enum Form {
    Pcap { big: bool, nanoseconds: bool },
    Pcapng { big: bool },
}

const FORMS: [Form; 6] = [
    Form::Pcap { big: false, nanoseconds: false },
    Form::Pcap { big: true, nanoseconds: false },
    Form::Pcap { big: false, nanoseconds: true },
    Form::Pcap { big: true, nanoseconds: true },
    Form::Pcapng { big: false },
    Form::Pcapng { big: true },
];

/// Writes packets with their times in microseconds.
fn capture(form: Form, packets: &[(u64, Vec<u8>)]) -> Vec<u8> {
    let big = match form {
        Form::Pcap { big, .. } | Form::Pcapng { big } => big,
    };
    let word = |n: u32| if big { n.to_be_bytes() } else { n.to_le_bytes() };
    let half = |n: u16| if big { n.to_be_bytes() } else { n.to_le_bytes() };
    let mut file = Vec::new();
    match form {
        Form::Pcap { nanoseconds, .. } => {
            file.extend(word(if nanoseconds { 0xA1B2_3C4D } else { 0xA1B2_C3D4 }));
            file.extend([half(2), half(4)].concat());
            file.extend([word(0), word(0), word(65_535), word(1)].concat());
        }
        Form::Pcapng { .. } => {
            file.extend([word(0x0A0D_0D0A), word(28), word(0x1A2B_3C4D)].concat());
            file.extend([half(1), half(0)].concat());
            file.extend([word(u32::MAX), word(u32::MAX), word(28)].concat());
            file.extend([word(1), word(20)].concat());
            file.extend([half(1), half(0)].concat());
            file.extend([word(0), word(20)].concat());
        }
    }
    for (micros, bytes) in packets {
        let length = bytes.len() as u32;
        match form {
            Form::Pcap { nanoseconds, .. } => {
                let fraction = micros % 1_000_000 * if nanoseconds { 1000 } else { 1 };
                file.extend(
                    [word((micros / 1_000_000) as u32), word(fraction as u32), word(length), word(length)]
                        .concat(),
                );
                file.extend(bytes);
            }
            Form::Pcapng { .. } => {
                let padded = bytes.len().next_multiple_of(4);
                let block = 32 + padded as u32;
                file.extend(
                    [word(6), word(block), word(0), word((micros >> 32) as u32), word(*micros as u32)]
                        .concat(),
                );
                file.extend([word(length), word(length)].concat());
                file.extend(bytes);
                file.extend(vec![0; padded - bytes.len()]);
                file.extend(word(block));
            }
        }
    }
    file
}

/// A segment: its time, whether the client sent it, its bytes, whether some are missing before it.
type Carried = (i64, bool, Vec<u8>, bool);

/// All segments of a file, and how its reading ended.
fn segments(file: &[u8], piece: usize) -> (Vec<Carried>, Result<(), Fault>) {
    let mut capture = Capture::default();
    let mut found = Vec::new();
    let mut take = |it: Segment<'_>| {
        found.push((it.time.unwrap_or_default(), it.from_client, it.bytes.to_vec(), it.gap))
    };
    let mut outcome = Ok(());
    for part in file.chunks(piece) {
        outcome = outcome.and(capture.push(part, &mut take));
    }
    outcome = outcome.and(capture.finish(&mut take));
    (found, outcome)
}

#[test]
fn every_format_in_pieces_of_any_size() {
    let packets = [
        (1_775_000_000_000_001, packet(true, 99, SYN, b"")),
        (1_775_000_000_000_500, packet(false, 499, SYN | ACK, b"")),
        (1_775_000_000_001_000, packet(true, 100, ACK, b"ask")),
        (1_775_000_000_020_000, packet(false, 500, ACK, b"answer")),
    ];
    for form in FORMS {
        let file = capture(form, &packets);
        assert!(Capture::recognises(&file).is_some(), "{form:?}");
        for piece in [1, 7, 1000] {
            let (found, outcome) = segments(&file, piece);
            assert_eq!(outcome, Ok(()), "{form:?}");
            let expected = [
                (1_775_000_000_001_000, true, b"ask".to_vec(), false),
                (1_775_000_000_020_000, false, b"answer".to_vec(), false),
            ];
            assert_eq!(found, expected, "{form:?} in pieces of {piece}");
        }
    }
}

#[test]
fn order_repetitions_and_gaps() {
    let parts = |list: &[(u32, &[u8])]| {
        let packets: Vec<(u64, Vec<u8>)> = list
            .iter()
            .zip(0..)
            .map(|((number, bytes), time)| (time, packet(true, *number, ACK, bytes)))
            .collect();
        let (found, _) = segments(&capture(FORMS[0], &packets), 1000);
        let gaps = found.iter().filter(|(.., gap)| *gap).count();
        (found.into_iter().flat_map(|(_, _, bytes, _)| bytes).collect::<Vec<u8>>(), gaps)
    };
    assert_eq!(parts(&[(1, b"abc"), (7, b"ghi"), (4, b"def")]), (b"abcdefghi".to_vec(), 0));
    assert_eq!(
        parts(&[(1, b"abc"), (1, b"abc"), (3, b"cde")]),
        (b"abcde".to_vec(), 0),
        "sent again, with more"
    );
    assert_eq!(parts(&[(1, b"abc"), (7, b"ghi")]), (b"abcghi".to_vec(), 1), "lost");
    assert_eq!(parts(&[(u32::MAX, b"ab"), (1, b"cd")]), (b"abcd".to_vec(), 0), "numbers wrap around");
}

/// A telegram in two segments, RTU inside TCP, and a connection that carries something else.
#[test]
fn telegrams_are_found_in_connections() {
    let request = [0, 1, 0, 0, 0, 6, 5, 3, 0, 200, 0, 1];
    let response = [0, 1, 0, 0, 0, 5, 5, 3, 2, 0, 7];
    let packets = [
        (1000, packet(true, 1, ACK, &request[..5])),
        (2000, packet(true, 6, ACK, &request[5..])),
        (22_000, packet(false, 1, ACK, &response)),
    ];
    let log = Log::read(&capture(FORMS[4], &packets), &Reading::default(), Options::default()).unwrap();
    let found: Vec<_> = log.entries().iter().map(|it| (it.direction, it.unit, log.latency(&it))).collect();
    assert_eq!(found.len(), 2, "{found:?}");
    assert_eq!(found[1].0, Direction::Response);
    assert_eq!(log.port_name(log.entry(0).port).unwrap(), "10.0.0.5:49152 – 10.0.0.9:502");
    let rtu = [1, 3, 0, 200, 0, 3, 0x84, 0x35];
    let log = Log::read(
        &capture(FORMS[0], &[(5, packet(true, 1, ACK, &rtu))]),
        &Reading::default(),
        Options::default(),
    );
    assert_eq!(log.unwrap().entry(0).protocol().key, "modbus-rtu");
    let page = b"GET / HTTP/1.1\r\n".repeat(400);
    let parts: Vec<(u64, Vec<u8>)> = page
        .chunks(1000)
        .zip(0..)
        .map(|(part, n)| (n, packet(true, 1 + 1000 * n as u32, ACK, part)))
        .collect();
    let log = Log::read(&capture(FORMS[0], &parts), &Reading::default(), Options::default()).unwrap();
    assert_eq!(log.entries().len(), 0);
    assert!(log.story().iter().any(|it| it.to_string().contains("without telegrams")));
}

/// The same packets as Wireshark and tcpdump print them, with the time in a line above the rows.
#[test]
fn dumps_of_packets_are_read_as_captures_are() {
    let mut packets = Vec::new();
    for n in 0..20_u8 {
        let (asks, answers) = (1 + 12 * u32::from(n), 1 + 11 * u32::from(n));
        let [request, response] =
            [[0, n, 0, 0, 0, 6, 5, 3, 0, n, 0, 1].to_vec(), [0, n, 0, 0, 0, 5, 5, 3, 2, 0, n].to_vec()];
        packets.push((u64::from(n) * 100_000, packet(true, asks, ACK, &request)));
        packets.push((u64::from(n) * 100_000 + 20_000, packet(false, answers, ACK, &response)));
    }
    let rows = |text: &mut String, bytes: &[u8], offset: &dyn Fn(usize) -> String, group: usize| {
        for (row, part) in bytes.chunks(16).enumerate() {
            let groups: Vec<String> = part
                .chunks(group)
                .map(|bytes| bytes.iter().map(|it| format!("{it:02x}")).collect())
                .collect();
            let shown: String =
                part.iter().map(|c| if c.is_ascii_graphic() { char::from(*c) } else { '.' }).collect();
            text.push_str(&format!("{}  {:48}  {shown}\n", offset(row * 16), groups.join(" ")));
        }
    };
    let (mut wireshark, mut tcpdump) = (String::new(), String::new());
    for (number, (time, bytes)) in packets.iter().enumerate() {
        let (second, micro) = (time / 1_000_000, time % 1_000_000);
        wireshark.push_str(
            "No.     Time           Source                Destination           Protocol Length Info\n",
        );
        wireshark.push_str(&format!(
            "{:7} {second}.{micro:06}       10.0.0.5              10.0.0.9              Modbus/TCP 66     Query\n\n",
            number + 1
        ));
        rows(&mut wireshark, bytes, &|at| format!("{at:04x}"), 1);
        wireshark.push('\n');
        tcpdump.push_str(&format!(
            "00:00:{second:02}.{micro:06} IP 10.0.0.5.49152 > 10.0.0.9.502: Flags [P.], seq 1:13, ack 1, win 512, length 12\n"
        ));
        rows(&mut tcpdump, &bytes[14..], &|at| format!("\t0x{at:04x}:"), 2);
    }
    let read = |file: &[u8]| Log::read(file, &Reading::default(), Options::default()).unwrap();
    let told = |log: &Log| -> Vec<_> {
        let entries = log.entries().iter();
        entries
            .map(|it| {
                let bytes = log.bytes(&&[][..], &it).into_owned();
                (bytes, it.direction, it.time(), log.latency(&it), log.port_name(it.port))
            })
            .collect()
    };
    let truth = told(&read(&capture(FORMS[0], &packets)));
    assert_eq!(truth.len(), 40);
    for text in [wireshark, tcpdump] {
        let log = read(text.as_bytes());
        assert_eq!(told(&log), truth, "{}", &text[..500]);
        let report = log.report(&text.as_bytes(), &[3]);
        assert!(report.telegrams[0].line.number > 1, "the line is known");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 300, ..ProptestConfig::default() })]

    #[test]
    fn nothing_panics(form in 0..FORMS.len(), at in any::<proptest::sample::Index>(), byte: u8, cut in any::<proptest::sample::Index>(), piece in 1..200_usize) {
        let packets = [(1, packet(true, 1, ACK, b"abcdef")), (2, packet(false, 1, ACK, b"ghi")), (3, packet(true, 9, ACK, b"xyz"))];
        let mut file = capture(FORMS[form], &packets);
        let at = at.index(file.len());
        file[at] = byte;
        file.truncate(cut.index(file.len()) + 1);
        let (_, outcome) = segments(&file, piece);
        if let Err(fault) = outcome {
            prop_assert!(!fault.to_string().is_empty());
        }
    }
}
