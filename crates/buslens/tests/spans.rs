//! No span lies outside the bytes, wherever a telegram ends: those of its fields, of what is wrong with
//! it, of what the device's manual says, and of the values that are shown on their own.

mod tiles;

use std::path::Path;

use buslens::field::{Direction, Field, Span, hex};
use buslens::frame::Cargo;
use buslens::profibus::{Kind, Service, Settings};
use buslens::tool::{Options, PROFILES, PROTOCOLS, Profile, Protocol, decode, json};
use buslens::walk::{self, Deviations};
use tiles::assert_tiled;

/// The smallest inputs that once ended the page: device, protocol, bytes.
#[test]
fn cut_telegrams_of_devices_keep_their_spans_inside() {
    for (device, protocol, text) in [
        ("keb-f5-modbus", "", ":0106000005"),
        ("keb-f5-modbus", "", "05 10 0C 10 00 04 08 06 02 31"),
        ("keb-f5-modbus", "modbus-tcp", "00 01 00 00 00 06 01 06 00 00"),
        ("keb-f5-profibus", "profibus-parameter-channel", "71 00 22 34 00"),
        ("keb-f5-profibus", "", "68 0F 0F 68 01 02 7D 52 00 23 00"),
        ("memograph-rsg45", "modbus-tcp", "00 01 00 00 00 0D 01 10 00 D7 00 03 06 00 80 42"),
        ("keb-f5-profibus", "profibus-parameter-channel", "34 E0\n0A 00 00 00 00\n52 34"),
    ] {
        let options =
            Options { device: Profile::of(device), protocol: Protocol::of(protocol), ..Options::default() };
        assert_inside(text, options);
    }
}

/// Every telegram of the vectors, cut at every length, with the devices it may belong to and the
/// protocols it may be taken for.
#[test]
fn every_cut_vector_keeps_its_spans_inside() {
    let mut seen = std::collections::HashSet::new();
    let mut beginnings = Vec::new();
    for text in vectors() {
        let find = |key: &str| text.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix(": "));
        let bytes = &decode(find("hex").unwrap(), Options::default()).telegrams[0].line.bytes;
        for length in 1..=bytes.len() {
            let own = find("device").and_then(Profile::of);
            if seen.insert((bytes[..length].to_vec(), own.map(|own| own.key))) {
                beginnings.push((bytes[..length].to_vec(), own));
            }
        }
    }
    // All pairs of device and protocol for all of them would take minutes: each takes some in turn.
    let devices: Vec<_> = PROFILES.iter().copied().map(Some).chain([None]).collect();
    let protocols: Vec<_> = PROTOCOLS.iter().copied().map(Some).chain([None]).collect();
    for (at, (bytes, own)) in beginnings.into_iter().enumerate() {
        let text: String = bytes.iter().map(|byte| format!("{byte:02X} ")).collect();
        let others =
            (0..2).map(|n| (devices[(at + n) % devices.len()], protocols[(at / 3 + n) % protocols.len()]));
        for (device, protocol) in others.chain([(own, None)]) {
            assert_inside(&text, Options { device, protocol, ..Options::default() });
        }
    }
}

/// Panics if a span of what `text` holds lies outside its telegram.
fn assert_inside(text: &str, options: Options) {
    let shown =
        format!("{text} as {:?} of {:?}", options.protocol.map(|it| it.key), options.device.map(|it| it.key));
    let report = decode(text, options);
    for (index, telegram) in report.telegrams.iter().enumerate() {
        let length = telegram.line.bytes.len();
        let inside = |span: Span, what: &str| {
            assert!(span.from <= span.to && span.to <= length, "{shown}: {what} at {span:?} of {length}");
        };
        let detail = report.detail(index).unwrap();
        assert_tiled(&detail.fields, length);
        let blocks = detail.device.blocks.iter().map(|block| &block.field);
        for field in detail.fields.iter().chain(blocks) {
            field.visit(&mut |field: &Field| inside(field.span, field.spec.key));
        }
        for problem in detail.problems() {
            inside(problem.span, problem.code);
        }
        detail.registers.iter().for_each(|span| inside(*span, "registers"));
        let line: serde_json::Value = serde_json::from_str(&json::line(&report, index, true)).unwrap();
        for problem in line["problems"].as_array().into_iter().flatten() {
            let to = problem["span"][1].as_u64().unwrap_or_default();
            assert!(to <= length as u64, "{shown}: {problem} in JSON");
        }
    }
}

/// The texts of all vectors.
fn vectors() -> Vec<String> {
    let mut texts = Vec::new();
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/vectors")];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "txt") {
                texts.push(std::fs::read_to_string(path).unwrap());
            }
        }
    }
    texts.sort();
    texts
}

/// What is wrong with a job stands where its parameter channel does, in a frame, too.
#[test]
fn problems_of_jobs_stand_at_their_channel() {
    let fdl = Protocol::of("profibus-fdl").unwrap();
    let request = |index: u16| {
        let kind = Kind::of(None, Direction::Request);
        let mut body = (kind.new)(&Settings::default());
        let channel = body.channel_mut().unwrap();
        channel.ask(Service::Read, 4, 1);
        channel.index = index;
        let mut frame = (fdl.carry)(1, Cargo::Profibus(kind, body)).unwrap();
        hex(&walk::write(frame.as_mut(), &Deviations::default()))
    };
    let report = decode(&format!("{}\n{}", request(0x2200), request(0x2201)), Options::default());
    let detail = report.detail(1).unwrap();
    let problem = &detail.step.as_ref().unwrap().problems[0];
    let mut control = None;
    detail.fields.iter().for_each(|field| {
        field.visit(&mut |field| control = control.or((field.spec.key == "control").then_some(field.span)));
    });
    assert_eq!((problem.code, Some(problem.span)), ("handshake-not-changed", control));
    assert_eq!(problem.span, Span::new(7, 8));
}
