//! A stream of every kind of telegram, both ways: each is found, and cuts change nothing.

mod random;

use buslens::field::{Direction, Spec};
use buslens::frame::profibus_fdl::Fdl;
use buslens::frame::split::{Begins, Place, Splitter};
use buslens::frame::{Cargo, Settings};
use buslens::modbus::{DIALECTS, Dialect, KINDS, Kind, Pdu};
use buslens::profibus;
use buslens::tool::log::{Input, Log, Reading, Role};
use buslens::tool::{self, Options, Protocol, Verdict};
use buslens::walk::{self, Deviations, Telegram};

use random::random;

/// Telegrams one behind the other.
struct Stream {
    protocol: &'static Protocol,
    dialect: &'static Dialect,
    telegrams: Vec<(&'static Spec, Direction, Vec<u8>)>,
}

impl Stream {
    fn bytes(&self) -> Vec<u8> {
        self.telegrams.iter().flat_map(|(_, _, bytes)| bytes).copied().collect()
    }

    /// Reads it in pieces that end at `cuts`.
    fn read(&self, cuts: &[usize]) -> Log {
        let bytes = self.bytes();
        let reading = Reading { input: Input::Binary, ..Reading::default() };
        let frame = Settings { dialect: self.dialect, ..Settings::default() };
        let settings = tool::Settings { frame, ..tool::Settings::default() };
        let options = Options { protocol: Some(self.protocol), settings, ..Options::default() };
        let mut log = Log::open(&bytes, bytes.len() as u64, &reading, options).unwrap();
        let mut from = 0;
        for to in cuts.iter().copied().chain([bytes.len()]) {
            log.push(&bytes[from..to]);
            from = to;
        }
        log.finish();
        log
    }
}

fn written(telegram: &mut dyn Telegram) -> Vec<u8> {
    walk::write(telegram, &Deviations::default())
}

/// Every kind of Modbus, with all sub-functions of the diagnostics, whose length their bytes tell: without
/// that, nothing ends a telegram in a stream. Requests and responses take turns.
fn modbus(protocol: &'static Protocol, dialect: &'static Dialect, seed: u64) -> Stream {
    let mut random = random(seed);
    let mut telegrams = Vec::new();
    for pair in KINDS.chunks(2) {
        let [requests, responses] = [pair[0], pair[1]].map(|standard| {
            let same =
                |kind: &&&Kind| (kind.function, kind.direction) == (standard.function, standard.direction);
            let kind = dialect.kinds.iter().find(same).copied().unwrap_or(standard);
            pdus(kind, dialect, &mut random).into_iter().filter_map(move |pdu| {
                let mut frame = (protocol.carry)(17, Cargo::Modbus(pdu))?;
                Some((&kind.spec, kind.direction, written(frame.as_mut())))
            })
        });
        // The response to a write of one value repeats it: with another one it is another request.
        const REPEATED: [&str; 3] =
            ["write_single_coil_request", "write_single_register_request", "mask_write_register_request"];
        telegrams.extend(requests.zip(responses).flat_map(|(request, mut response)| {
            if REPEATED.contains(&request.0.key) {
                response.2 = request.2.clone();
            }
            [request, response]
        }));
    }
    Stream { protocol, dialect, telegrams }
}

/// Some PDUs of a kind.
fn pdus(kind: &'static Kind, dialect: &'static Dialect, random: &mut impl FnMut(u64) -> u64) -> Vec<Pdu> {
    let told = |pdu: &mut Pdu| {
        let bytes = written(pdu);
        kind.length.of(&bytes) == Some(bytes.len()) && kind.length.fits(&bytes) && bytes.len() <= 253
    };
    // Most fields are drawn one by one, and rules are about several.
    let drawn = (0..40).find_map(|_| {
        let mut pdu = kind.pdu(dialect);
        walk::sample(&mut pdu, random);
        told(&mut pdu).then_some(pdu)
    });
    let tested = (1..=20).filter(|_| kind.function == 8).filter_map(|number| {
        let mut pdu = kind.pdu(dialect);
        walk::read(&mut pdu, &[8, 0, number, 0, 0]);
        told(&mut pdu).then_some(pdu)
    });
    drawn.into_iter().chain(tested).collect()
}

/// Every service of PROFIBUS in its frame.
fn profibus(seed: u64) -> Stream {
    let mut random = random(seed);
    let protocol = Protocol::of("profibus-fdl").unwrap();
    let telegrams = profibus::KINDS.iter().chain(profibus::OTHER_KINDS).filter_map(|kind| {
        // The control byte is drawn, too, and says who speaks.
        (0..40).find_map(|_| {
            let body = (kind.new)(&profibus::Settings::default());
            let mut frame = (protocol.carry)(17, Cargo::Profibus(kind, body))?;
            walk::sample(frame.as_mut(), &mut random);
            let bytes = written(frame.as_mut());
            let right = (protocol.verdict)(&bytes) == Verdict::Right;
            let said = Fdl::direction(&bytes) == Some(kind.direction);
            (right && said).then_some((&kind.spec, kind.direction, bytes))
        })
    });
    Stream { protocol, dialect: DIALECTS[0], telegrams: telegrams.collect() }
}

fn streams() -> Vec<Stream> {
    let of = |key: &str| Protocol::of(key).unwrap();
    let mut streams: Vec<Stream> =
        DIALECTS.iter().map(|dialect| modbus(of("modbus-rtu"), dialect, 14)).collect();
    streams.push(modbus(of("modbus-tcp"), DIALECTS[0], 15));
    streams.push(profibus(16));
    streams
}

#[test]
fn every_kind_is_found_in_a_stream() {
    for stream in streams() {
        let log = stream.read(&[]);
        let what = format!("{} of {}", stream.dialect.key, stream.protocol.key);
        assert!(log.entries().iter().all(|entry| entry.role != Role::Discarded), "{what}");
        let file = stream.bytes();
        let found: Vec<_> =
            log.entries().iter().map(|entry| log.bytes(&&file[..], &entry).into_owned()).collect();
        let sent: Vec<Vec<u8>> = stream.telegrams.iter().map(|(_, _, bytes)| bytes.clone()).collect();
        assert_eq!(found, sent, "{what}");
        for (entry, (spec, direction, _)) in log.entries().iter().zip(&stream.telegrams) {
            assert_ne!(entry.verdict, Verdict::Wrong, "{what}: {}", spec.key);
            assert_eq!(entry.direction, *direction, "{what}: {}", spec.key);
        }
    }
}

/// Each is one telegram by itself, too, by its length rule and its check.
#[test]
fn every_kind_begins_where_it_begins() {
    for stream in streams() {
        let splitter = Splitter::new(stream.dialect);
        for (spec, _, bytes) in &stream.telegrams {
            let place = Place { bytes, last: true, in_step: true, waiting: None };
            let begins = splitter.begins(stream.protocol, place);
            assert_eq!(begins, Begins::Telegram(bytes.len()), "{} {}", stream.dialect.key, spec.key);
        }
    }
}

/// The splitter tells lengths before there is a check: of each kind, of what rejects it, and of a beginning of it.
#[test]
fn the_length_of_every_kind_is_told() {
    for stream in streams().iter().filter(|stream| stream.protocol.key == "modbus-rtu") {
        let splitter = Splitter::new(stream.dialect);
        for (spec, direction, bytes) in &stream.telegrams {
            let what = format!("{} {}", stream.dialect.key, spec.key);
            let side = usize::from(*direction == Direction::Response);
            assert_eq!(splitter.rtu_lengths(bytes)[side], Some(bytes.len()), "{what}");
            for cut in 2..bytes.len() {
                assert!(splitter.is_beginning(&bytes[..cut]), "{what}, {cut} bytes");
            }
            assert_eq!(splitter.rtu_lengths(&[17, bytes[1] | 0x80, 2]), [None, Some(5)], "{what}");
        }
    }
}

/// A frame longer than any is none, however much of it is missing; nor is one without a function.
#[test]
fn what_is_too_long_or_nothing_does_not_begin() {
    let splitter = Splitter::new(DIALECTS[0]);
    let begins = |key: &str, bytes: &[u8]| {
        let place = Place { bytes, last: false, in_step: true, waiting: None };
        splitter.begins(Protocol::of(key).unwrap(), place)
    };
    // 253 bytes of values are no whole registers, and 254 make a frame of 259.
    assert_eq!(begins("modbus-rtu", &[1, 3, 254, 0, 0, 0, 0, 0, 0, 0, 0, 0]), Begins::Nothing);
    assert_eq!(begins("modbus-rtu", &[1, 3, 250, 0, 0, 0, 0, 0, 0, 0, 0, 0]), Begins::More);
    assert_eq!(begins("modbus-tcp", &[0, 0, 0, 0, 0, 2, 1, 0]), Begins::Nothing);
    assert_eq!(begins("modbus-tcp", &[0, 0, 0, 0, 0, 3, 1, 0x80, 1]), Begins::Nothing);
    assert_eq!(begins("modbus-tcp", &[0, 0, 0, 0, 0, 2, 1, 7]), Begins::Telegram(8));
    assert_eq!(begins("modbus-tcp", &[0, 0, 0, 0, 0, 6, 1, 3]), Begins::More);
    assert_eq!(begins("modbus-tcp", &[0, 0, 0, 0, 0, 1, 1, 3]), Begins::Nothing);
    assert_eq!(begins("modbus-tcp", &[0, 0, 0, 1, 0, 6, 1, 3]), Begins::Nothing);
    assert_eq!(begins("modbus-tcp", &[0, 0, 0, 0, 2, 0, 1, 3]), Begins::Nothing);
}

/// A line of text may hold several: the first one ends where it ends, unless what follows is too short for one.
#[test]
fn the_first_of_two_is_told() {
    for stream in streams().iter().filter(|stream| stream.dialect.key == DIALECTS[0].key) {
        let first = stream.protocol.first;
        for (spec, _, bytes) in &stream.telegrams {
            let with = |more: &[u8]| first(&[bytes, more].concat());
            let what = format!("{} of {}", spec.key, stream.protocol.key);
            assert_eq!(first(bytes), bytes.len(), "{what}");
            assert_eq!(with(bytes), bytes.len(), "{what}");
            if stream.protocol.key == "modbus-rtu" {
                assert_eq!(with(&[1, 3, 0]), bytes.len() + 3, "{what}");
                assert_eq!(with(&[1, 3, 0, 0]), bytes.len(), "{what}");
            }
        }
    }
}

/// Request and response of the same unit and function belong together, and to no other's.
#[test]
fn exchanges_are_told_apart() {
    for (key, mut streams) in [("modbus-rtu", streams()), ("modbus-tcp", streams())] {
        streams.retain(|stream| stream.protocol.key == key && stream.dialect.key == DIALECTS[0].key);
        let protocol = Protocol::of(key).unwrap();
        let mut seen = std::collections::BTreeMap::new();
        for (spec, _, bytes) in &streams[0].telegrams {
            let function = bytes[if key == "modbus-tcp" { 7 } else { 1 }];
            let exchange = (protocol.exchange)(bytes).expect(spec.key);
            assert_eq!(*seen.entry(function).or_insert(exchange), exchange, "{}", spec.key);
        }
        let all: std::collections::BTreeSet<u64> = seen.values().copied().collect();
        assert_eq!(all.len(), seen.len(), "{key}");
    }
}

/// All kinds but those that nothing ends are there, so that what holds for the stream holds for each.
#[test]
fn the_streams_leave_no_kind_out() {
    let of = |stream: &Stream| stream.telegrams.iter().map(|(spec, _, _)| spec.key).collect::<Vec<_>>();
    let rtu = modbus(Protocol::of("modbus-rtu").unwrap(), DIALECTS[0], 14);
    let left: Vec<_> = KINDS.iter().map(|kind| kind.spec.key).filter(|key| !of(&rtu).contains(key)).collect();
    assert_eq!(left, Vec::<&str>::new());
    let fdl = profibus(16);
    let left: Vec<_> =
        profibus::KINDS.iter().map(|kind| kind.spec.key).filter(|key| !of(&fdl).contains(key)).collect();
    assert_eq!(left, Vec::<&str>::new());
}

#[test]
fn a_cut_anywhere_changes_nothing() {
    for stream in streams() {
        let whole = stream.read(&[]);
        let length = stream.bytes().len();
        for cut in 1..length {
            let log = stream.read(&[cut]);
            assert_eq!(log.entries(), whole.entries(), "{} cut at {cut}", stream.dialect.key);
        }
        for size in [1, 2, 3, 7, 11, 64, 255, 300] {
            let cuts: Vec<usize> = (1..length).filter(|at| at.is_multiple_of(size)).collect();
            let log = stream.read(&cuts);
            assert_eq!(log.entries(), whole.entries(), "{} in pieces of {size}", stream.dialect.key);
        }
    }
}

/// A telegram that tells its length late, with others around it that may be taken for its parts.
#[test]
fn a_length_that_is_told_late_is_waited_for() {
    let identification = [
        &[0x11, 0x2B, 0x0E, 0x01, 0x01, 0, 0, 3, 0, 7][..],
        b"Buslens",
        &[1, 2, 0x42, 0x31, 2, 4, 0x56, 0x31, 0x2E, 0x30, 0x94, 0xB5],
    ]
    .concat();
    let kind =
        KINDS.iter().find(|kind| kind.function == 43 && kind.direction == Direction::Response).unwrap();
    let telegrams = vec![(&kind.spec, kind.direction, identification)];
    let protocol = Protocol::of("modbus-rtu").unwrap();
    let stream = Stream { protocol, dialect: DIALECTS[0], telegrams };
    let length = stream.bytes().len();
    for first in 1..length {
        for second in first..length {
            let log = stream.read(&[first, second]);
            let verdicts: Vec<_> = log.entries().iter().map(|entry| entry.verdict).collect();
            assert_eq!(verdicts, [Verdict::Right], "{first} and {second}");
            assert_eq!(log.entry(0).direction, Direction::Response);
        }
    }
}
