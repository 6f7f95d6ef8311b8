//! What holds for every telegram, whatever its bytes: run over all kinds, in the frame.

mod random;
mod tiles;

use buslens::field::{Direction, Field, Value, problems};
use buslens::frame::modbus_ascii::ASCII;
use buslens::frame::modbus_rtu::RTU;
use buslens::frame::modbus_serial::{Mode, Serial};
use buslens::frame::{Cargo, Frame, PROTOCOLS, Protocol, Settings};
use buslens::modbus::{DIALECTS, Dialect, KINDS, Kind, OTHER_KINDS, STANDARD};
use buslens::tool::{Options, Verdict, decode};
use buslens::walk::{self, Deviations, form, guide};
use proptest::prelude::*;
use random::random;
use tiles::assert_tiled;

/// Every kind, with the dialect that it belongs to.
type Spoken = (&'static Dialect, &'static Kind);

fn kinds() -> impl Iterator<Item = Spoken> {
    let standard = KINDS.iter().chain(OTHER_KINDS).map(|kind| (&STANDARD, *kind));
    let others = DIALECTS.iter().flat_map(|dialect| dialect.kinds.iter().map(|kind| (*dialect, *kind)));
    standard.chain(others)
}

fn kind() -> impl Strategy<Value = Spoken> {
    proptest::sample::select(kinds().collect::<Vec<_>>())
}

fn dialect() -> impl Strategy<Value = &'static Dialect> {
    proptest::sample::select(DIALECTS)
}

fn direction() -> impl Strategy<Value = Direction> {
    prop_oneof![Just(Direction::Request), Just(Direction::Response)]
}

/// Bytes of any length, half of them with a known function code, some with small numbers behind it:
/// sub-functions, byte counts.
fn bytes() -> impl Strategy<Value = Vec<u8>> {
    let any_bytes = proptest::collection::vec(any::<u8>(), 0..300);
    let small = proptest::collection::vec(0..32u8, 0..12);
    (any_bytes, proptest::option::of(kind()), small).prop_map(|(mut bytes, spoken, small)| {
        if let (Some((_, kind)), Some(behind)) = (spoken, bytes.get_mut(1..)) {
            let head = std::iter::once(kind.function).chain(small);
            behind.iter_mut().zip(head).for_each(|(byte, known)| *byte = known);
        }
        bytes
    })
}

fn protocol() -> impl Strategy<Value = &'static Protocol> {
    proptest::sample::select(PROTOCOLS)
}

fn mode() -> impl Strategy<Value = &'static Mode> {
    prop_oneof![Just(&RTU), Just(&ASCII)]
}

/// An empty frame of any protocol to read `bytes` into.
fn expect(
    protocol: &Protocol,
    bytes: &[u8],
    direction: Direction,
    dialect: &'static Dialect,
) -> Box<dyn Frame> {
    (protocol.expect)(bytes, direction, &Settings { dialect, ..Settings::default() })
}

fn empty(mode: &'static Mode, (dialect, kind): Spoken) -> Serial {
    Serial { mode, unit: 1, pdu: kind.pdu(dialect) }
}

/// A valid telegram of `kind`, random by `seed`.
fn sample(mode: &'static Mode, kind: Spoken, seed: u64) -> Serial {
    let mut serial = empty(mode, kind);
    walk::sample(&mut serial, &mut random(seed));
    // A broadcast must not read, and 248 to 255 are reserved.
    serial.unit = serial.unit % 247 + 1;
    serial
}

/// Problems that a sample may have: its fields are drawn one by one, and these rules are about several.
const BETWEEN_FIELDS: &[&str] = &["address-overflow", "unused-bits", "response-too-long", "half-record"];

fn write(frame: &mut dyn Frame) -> Vec<u8> {
    walk::write(frame, &Deviations::default())
}

fn codes(fields: &[Field]) -> Vec<&'static str> {
    problems(fields).iter().map(|problem| problem.code).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2000) })]

    #[test]
    fn leaves_tile_any_bytes(
        protocol in protocol(), bytes in bytes(), direction in direction(), dialect in dialect()
    ) {
        let mut frame = expect(protocol, &bytes, direction, dialect);
        let reading = walk::read(frame.as_mut(), &bytes);
        assert_tiled(&reading.fields, bytes.len());
        // Saying it does not panic either.
        let _ = frame.meaning().sentence();
    }

    /// Any bytes at all are a value with deviations, and come back from it.
    #[test]
    fn any_bytes_are_written_again(
        protocol in protocol(), bytes in bytes(), direction in direction(), dialect in dialect()
    ) {
        let mut frame = expect(protocol, &bytes, direction, dialect);
        let deviations = walk::read(frame.as_mut(), &bytes).deviations(frame.as_mut());
        prop_assert_eq!(walk::write(frame.as_mut(), &deviations), bytes);
    }

    /// From bytes to a form, and from the form, filled into an empty frame, to the same bytes.
    #[test]
    fn a_form_gives_the_same_telegram(
        protocol in protocol(), bytes in bytes(), direction in direction(), dialect in dialect()
    ) {
        let mut frame = expect(protocol, &bytes, direction, dialect);
        let deviations = walk::read(frame.as_mut(), &bytes).deviations(frame.as_mut());
        let shown = form::form(frame.as_mut(), &deviations);
        let mut filled = expect(protocol, &[], direction, dialect);
        let entered = form::fill(filled.as_mut(), &shown).expect("a form fills what it was made of");
        prop_assert_eq!(&form::form(filled.as_mut(), &entered), &shown);
        prop_assert_eq!(walk::write(filled.as_mut(), &entered), bytes);
    }

    #[test]
    fn a_valid_telegram_has_no_problems_and_no_deviations(mode in mode(), kind in kind(), seed: u64) {
        let mut serial = sample(mode, kind, seed);
        let bytes = write(&mut serial);
        let mut read = mode.expect(&bytes, kind.1.direction, kind.0);
        let reading = walk::read(&mut read, &bytes);
        assert_tiled(&reading.fields, bytes.len());
        let found = codes(&reading.fields);
        prop_assert!(found.iter().all(|code| BETWEEN_FIELDS.contains(code)), "{:?}", found);
        prop_assert!(reading.deviations(&mut read).is_empty());
        prop_assert_eq!(write(&mut read), bytes);
    }

    /// What one protocol carries, each of its kin carries as well.
    #[test]
    fn every_protocol_of_modbus_carries_every_telegram(kind in kind(), seed: u64) {
        for protocol in PROTOCOLS {
            let pdu = sample(&RTU, kind, seed).pdu;
            let Some(mut frame) = (protocol.carry)(7, Cargo::Modbus(pdu)) else { continue };
            let bytes = write(frame.as_mut());
            let mut read = expect(protocol, &bytes, kind.1.direction, kind.0);
            let found = codes(&walk::read(read.as_mut(), &bytes).fields);
            let allowed = |code| BETWEEN_FIELDS.contains(code) || *code == "serial-only";
            prop_assert!(found.iter().all(allowed), "{}: {:?}", protocol.key, found);
            prop_assert_ne!((protocol.verdict)(&bytes), Verdict::Wrong);
            prop_assert_eq!(write(read.as_mut()), bytes);
        }
    }

    #[test]
    fn the_length_rule_agrees_with_the_telegram(mode in mode(), kind in kind(), seed: u64) {
        let bytes = write(&mut sample(mode, kind, seed));
        prop_assert!(kind.1.length.fits(mode.pdu_bytes(&bytes)));
        prop_assert_eq!(mode.pdu_bytes(&bytes).len() + mode.around(), bytes.len());
    }

    #[test]
    fn each_shorter_prefix_says_what_is_missing(
        mode in mode(), kind in kind(), seed: u64, cut: prop::sample::Index
    ) {
        let bytes = write(&mut sample(mode, kind, seed));
        let prefix = &bytes[..cut.index(bytes.len())];
        let mut serial = mode.expect(prefix, kind.1.direction, kind.0);
        let found = codes(&walk::read(&mut serial, prefix).fields);
        // Nothing tells how much data an unknown function has.
        let told = kind.1.length.of(mode.pdu_bytes(&bytes)).is_some() || prefix.len() < mode.shortest();
        prop_assert!(!told || found.contains(&"truncated"), "{:?}", found);
    }

    #[test]
    fn a_flipped_bit_is_noticed(
        mode in mode(), kind in kind(), seed: u64, place: prop::sample::Index, bit in 0..8
    ) {
        let mut bytes = write(&mut sample(mode, kind, seed));
        let place = place.index(bytes.len());
        bytes[place] ^= 1u8 << bit;
        for direction in [Direction::Request, Direction::Response] {
            let mut serial = mode.expect(&bytes, direction, &STANDARD);
            let reading = walk::read(&mut serial, &bytes);
            assert_tiled(&reading.fields, bytes.len());
            prop_assert!(codes(&reading.fields).contains(&"check-failed"));
        }
    }

    #[test]
    fn any_text_is_decoded(text in "[ -~\\n\\r\\t\u{80}-\u{ffff}]{0,200}", hex in "([0-9A-Fa-f]{0,3}[ ,;:\\n\\[\\]{}\"'\\\\xh]?){0,60}") {
        for text in [text, hex] {
            let report = decode(&text, Options::default());
            let mut last = 0;
            for (index, telegram) in report.telegrams.iter().enumerate() {
                let line = &telegram.line;
                prop_assert_eq!(line.bytes.len(), line.places.len());
                for place in line.places.iter().chain(line.remarks.iter().map(|remark| &remark.span)) {
                    prop_assert!(text.get(place.from..place.to).is_some());
                }
                for place in &line.places {
                    prop_assert!(last <= place.from && place.from < place.to);
                    last = place.to;
                }
                let detail = report.detail(index).expect("every telegram has its detail");
                assert_tiled(&detail.fields, line.bytes.len());
                let check = detail.check().map(|check| check.ok());
                prop_assert_eq!(check == Some(true), telegram.verdict == Verdict::Right);
            }
        }
    }
}

/// The fields that are no groups and no items of lists: key, offset, depth.
fn places(field: &Field, depth: usize, found: &mut Vec<(&'static str, usize, usize)>) {
    if !matches!(field.value, Value::Group) && field.number.is_none() {
        found.push((field.spec.key, field.span.from, depth));
    }
    field.children.iter().for_each(|child| places(child, depth + 1, found));
}

#[test]
fn the_guide_and_the_reader_agree() {
    for kind in kinds() {
        let rows = guide::guide(&mut empty(&RTU, kind));
        let mut serial = sample(&RTU, kind, 1);
        let bytes = write(&mut serial);
        let reading = walk::read(&mut serial, &bytes);
        let mut read = Vec::new();
        reading.fields.iter().for_each(|field| places(field, 0, &mut read));
        for row in rows.iter().filter(|row| matches!(row.size, guide::Size::Fixed(_))) {
            let (_, offset, depth) = read.iter().find(|(key, ..)| *key == row.spec.key).expect(row.spec.key);
            assert!(row.offset.is_none_or(|told| told == *offset), "{}: {}", kind.1.spec.key, row.spec.key);
            assert_eq!(row.depth, *depth, "{}: {}", kind.1.spec.key, row.spec.key);
        }
        assert!(rows.len() > 2, "{}", kind.1.spec.key);
    }
}

/// The whole page's promise for long input: 100,000 characters of anything are read in linear time,
/// so this test is over at once and not in minutes.
#[test]
fn long_input_is_fine() {
    for unit in ["01 03 ", "0", "G", "{", "\"", "'\\", "0x", "/*", "= {\n", "é", "&H", "01\n", "[", "\\x0"] {
        let text = unit.repeat(100_000 / unit.len());
        let report = decode(&text, Options::default());
        if let Some(index) = report.telegrams.len().checked_sub(1) {
            let detail = report.detail(index).expect("the last telegram");
            assert_tiled(&detail.fields, report.telegrams[index].line.bytes.len());
        }
    }
}
