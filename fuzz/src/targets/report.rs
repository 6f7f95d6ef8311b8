use super::law::{assert_exports, assert_file, assert_telegram};
use super::{Target, USUAL_MEMORY};
use crate::{Input, make};
use buslens::field::hex;
use buslens::tool::checksums::{ByteOrder, CHECKSUMS};
use buslens::tool::copy::FORMATS;
use buslens::tool::{Options, Protocol, annotated, csv, decode, json, proposals, value_findings};

/// Requests of a device with what comes back.
pub static TARGET: Target = Target {
    key: "report",
    about: "conversations with a device: findings about values, proposals, whole exports, copies",
    share: 2,
    memory: USUAL_MEMORY,
    make: |random, seeds| [make::choices(random, CHOICES), make::conversation(random, seeds)].concat(),
    run,
};

const CHOICES: usize = 8;

fn run(data: &[u8]) {
    let mut input = Input::new(data, CHOICES);
    let (how, options) = (input.byte(), input.options());
    let text = String::from_utf8_lossy(input.content());
    let report = decode(&text, options);
    let all = report.telegrams.len();
    let within = |evidence: &[usize]| !evidence.is_empty() && evidence.iter().all(|index| *index < all);
    for proposal in proposals(&report) {
        assert!(within(&proposal.evidence) && !proposal.text.sentence().is_empty(), "{text:?}");
    }
    for finding in value_findings(&report) {
        assert!(within(&finding.evidence) && !finding.text.sentence().is_empty(), "{text:?}");
    }
    for index in 0..all.min(8) {
        assert_telegram(&report, index);
        assert_exports(&report, index);
    }
    if how & 3 == 0 {
        assert_file(&csv::table(&report), &json::lines(&report, how & 4 == 0), all);
        assert!(!annotated::text(&report).is_empty());
    }
    if how & 24 == 0 {
        // A byte or two by themselves are read as a telegram in some texts only, and eight digits 0 and 1 are bits.
        let told = |bytes: &[u8]| bytes.len() > 3 && bytes.iter().any(|byte| byte & 0xEE != 0);
        for telegram in report.telegrams.iter().take(2).filter(|it| told(&it.line.bytes)) {
            copied(&telegram.line.bytes);
        }
    }
}

/// What is copied is read again, and each check that bytes can have is found behind them.
fn copied(bytes: &[u8]) {
    for format in FORMATS {
        let text = (format.write)(bytes);
        let options = Options { protocol: Protocol::of("modbus-rtu"), ..Options::default() };
        let again = decode(&text, options);
        // What begins with a whole telegram is more than one.
        let read: Vec<u8> = again.telegrams.iter().flat_map(|it| it.line.bytes.iter().copied()).collect();
        assert_eq!(hex(&read), hex(bytes), "{text}");
    }
    for checksum in CHECKSUMS {
        let wire = checksum.wire(bytes);
        assert_eq!(checksum.gives(bytes, &wire), Some(ByteOrder::Usual), "{}", checksum.name);
    }
}
