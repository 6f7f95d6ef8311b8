//! What is asked of a device in its manual's words becomes the bytes that the manual prints, and
//! everything that can be asked is read again as what was asked; every request has its responses.

use buslens::device::{Access, Draft, Profile};
use buslens::field::{Direction, hex};
use buslens::frame::{Cargo, Settings};
use buslens::modbus::{KINDS, STANDARD, exceptions};
use buslens::profibus;
use buslens::tool::{Options, PROFILES, PROTOCOLS, build, decode, replies};
use buslens::walk::form::{self, Content, Entry};
use buslens::walk::{Deviations, read, write};

fn profile(key: &str) -> &'static Profile {
    PROFILES.iter().copied().find(|profile| profile.key == key).expect(key)
}

/// A draft of the task with this label, its entries filled in by their keys.
fn draft(device: &str, label: &str, entries: &[(&str, &str)]) -> Draft {
    let found = profile(device).tasks().into_iter().find(|task| task.label().sentence() == label);
    let mut draft = found.unwrap_or_else(|| panic!("no task {label}")).draft();
    // A choice decides which other entries there are: so one after the other.
    for (key, text) in entries {
        let mut shown = form::form(&mut draft, &Deviations::default());
        let entry = entry(&mut shown.entries, key).unwrap_or_else(|| panic!("{label} has no {key}"));
        match &mut entry.content {
            Content::Number { text: old, .. } | Content::Text { text: old } => *old = (*text).to_owned(),
            Content::Choice { raw, .. } => {
                *raw = form::parse_value(text, 1, entry.spec).expect("a choice");
            }
            other => panic!("{key} is {other:?}"),
        }
        form::fill(&mut draft, &shown).unwrap_or_else(|misfits| panic!("{label}: {misfits:?}"));
    }
    draft
}

fn entry<'a>(entries: &'a mut [Entry], key: &str) -> Option<&'a mut Entry> {
    for entry in entries {
        if entry.spec.key == key {
            return Some(entry);
        }
        if let Content::Group { entries } = &mut entry.content
            && let Some(found) = self::entry(entries, key)
        {
            return Some(found);
        }
    }
    None
}

fn bytes(draft: &mut Draft, unit: u8, protocol: &str) -> String {
    let protocol = PROTOCOLS.iter().find(|known| known.key == protocol).expect(protocol);
    let mut frame = build(draft, unit, protocol, &Settings::default()).expect("a telegram");
    hex(&write(frame.as_mut(), &Deviations::default()))
}

fn memograph(unit: u8, label: &str, entries: &[(&str, &str)]) -> String {
    bytes(&mut draft("memograph-rsg45", label, entries), unit, "modbus-rtu")
}

/// Memograph M RSG45 Modbus supplement, sections 2.6.1 to 2.6.13.
#[test]
fn the_telegrams_of_the_memograph_manual() {
    assert_eq!(
        memograph(
            1,
            "Write Universal channel at 200 to 319",
            &[("number", "6"), ("status", "good"), ("value", "123.456")]
        ),
        "01 10 00 D7 00 03 06 00 80 42 F6 E9 79 28 15"
    );
    assert_eq!(
        memograph(1, "Read Universal channel at 200 to 319", &[("number", "1")]),
        "01 03 00 C8 00 03 84 35"
    );
    assert_eq!(
        memograph(5, "Write Event text", &[("text", "ABCDE ")]),
        "05 10 0B D0 00 03 06 41 42 43 44 45 20 D8 4E"
    );
    assert_eq!(
        memograph(
            5,
            "Write Batch",
            &[("function", "set preset counter"), ("batch", "2"), ("preset", "12.345")]
        ),
        "05 10 0C 10 00 04 08 06 02 31 32 2E 33 34 35 D3 B5"
    );
    assert_eq!(
        memograph(
            5,
            "Write Limit",
            &[("function", "change limit"), ("limit", "3"), ("new_values", "5.7;10")]
        ),
        "05 10 0C 90 00 04 08 03 03 35 2E 37 3B 31 30 94 BF"
    );
    assert_eq!(
        memograph(5, "Write Limit", &[("function", "accept changes")]),
        "05 10 0C 90 00 01 02 02 2A C5 7F"
    );
}

/// A text that ends within a register is filled up with a space.
#[test]
fn an_odd_text_is_padded() {
    assert_eq!(
        memograph(5, "Write Event text", &[("text", "ABCDE")]),
        memograph(5, "Write Event text", &[("text", "ABCDE ")])
    );
}

#[test]
fn keb_by_register_and_by_index() {
    let entries = [("number", "0"), ("read_mapping_entry", "0x00330101")];
    let mut entry = draft("keb-f5-modbus", "Write Read-mapping entry", &entries);
    assert_eq!(bytes(&mut entry, 1, "modbus-tcp"), "00 01 00 00 00 0B 01 65 5F 32 00 01 04 00 33 01 01");
    // S1 of section 7.5.1, but with the parameter's own length.
    let entries = [("subindex", "0"), ("reference_source", "11")];
    let mut job = draft("keb-f5-profibus", "Write Reference source (OP.00)", &entries);
    assert_eq!(bytes(&mut job, 1, "profibus-parameter-channel"), "72 00 23 00 00 00 00 0B");
}

#[test]
fn a_number_that_does_not_exist_is_said() {
    let mut channel = draft("memograph-rsg45", "Read Universal channel at 200 to 319", &[("number", "41")]);
    let said = build(&mut channel, 1, PROTOCOLS[0], &Settings::default()).err().expect("refused").to_string();
    assert_eq!(said, "Universal channel 41 does not exist: there are 1 to 40");
}

/// Everything that can be asked of any device is read back as what was asked.
#[test]
fn every_task_is_read_again() {
    for profile in PROFILES {
        let tasks = profile.tasks();
        assert!(tasks.len() > 20, "{}", profile.key);
        for task in tasks {
            let label = task.label();
            let mut draft = task.draft();
            let Ok(asked) = draft.asked() else {
                assert_eq!(label.to_string(), "write Event text", "a first draft is complete");
                continue;
            };
            let protocol = if draft.by_index() { "profibus-parameter-channel" } else { "modbus-rtu" };
            let text = bytes(&mut draft, 1, protocol);
            let options = Options {
                device: Some(profile),
                protocol: PROTOCOLS.iter().copied().find(|known| known.key == protocol),
                ..Options::default()
            };
            let detail = decode(&text, options).detail(0).expect("a telegram");
            let block = detail.device.blocks.first().unwrap_or_else(|| panic!("{label}: {text}"));
            assert_eq!(block.from, asked.address, "{label}");
            let codes: Vec<_> = detail.problems().iter().map(|problem| problem.code).collect();
            // A first draft holds zeros, which not every field takes, and no texts.
            let expected = ["out-of-range", "not-allowed", "data-missing", "half-value"];
            assert!(codes.iter().all(|code| expected.contains(code)), "{label}: {codes:?} in {text}");
            let writes =
                detail.channel.as_ref().map_or(matches!(detail.function, Some(16 | 101)), |channel| {
                    channel.service() == buslens::profibus::Service::Write
                });
            assert_eq!(writes, asked.access == Access::Write, "{label}");
        }
    }
}

/// A healthy server's response to every request is read as its answer, without a problem; so is each
/// refusal.
#[test]
fn every_request_has_its_responses() {
    let requests = KINDS.iter().filter(|kind| kind.direction == Direction::Request);
    for (kind, protocol) in requests.flat_map(|kind| PROTOCOLS.iter().map(move |protocol| (kind, protocol))) {
        let Some(mut request) = (protocol.carry)(5, Cargo::Modbus(kind.pdu(&STANDARD))) else { continue };
        let asked = hex(&write(request.as_mut(), &Deviations::default()));
        let replies = replies(request.as_mut(), &profibus::Settings::default(), None);
        // KEB's own functions are refused as its manual says: with six codes of the standard and four of its own.
        let refusals = if kind.function >= 100 { 6 + 4 } else { exceptions().len() };
        assert_eq!(replies.len(), 1 + refusals, "{}", kind.spec.key);
        for mut reply in replies {
            let answer = hex(&write(reply.frame.as_mut(), &Deviations::default()));
            let options = Options { protocol: Some(protocol), ..Options::default() };
            let report = decode(&format!("{asked}\n{answer}"), options);
            let key = kind.spec.key;
            assert_eq!(report.telegrams[1].answers, Some(0), "{key}, {}: {asked}, {answer}", protocol.key);
            let detail = report.detail(1).expect("a response");
            let codes: Vec<_> = detail.problems().iter().map(|problem| problem.code).collect();
            assert!(codes.iter().all(|code| *code == "serial-only"), "{key}: {codes:?} in {answer}");
        }
    }
}

#[test]
fn a_response_has_what_was_asked_for() {
    let respond = |request: &str| {
        let bytes: Vec<u8> = request.split(' ').map(|byte| u8::from_str_radix(byte, 16).unwrap()).collect();
        let mut frame = (PROTOCOLS[0].expect)(&bytes, Direction::Request, &Settings::default());
        read(frame.as_mut(), &bytes);
        let settings = profibus::Settings::default();
        let mut reply = replies(frame.as_mut(), &settings, None).into_iter().next().expect("an answer");
        hex(&write(reply.frame.as_mut(), &Deviations::default()))
    };
    assert_eq!(respond("01 03 00 C8 00 03 84 35")[..26], *"01 03 06 00 00 00 00 00 00");
    assert_eq!(respond("01 10 00 D7 00 03 06 00 80 42 F6 E9 79 28 15"), "01 10 00 D7 00 03 30 30");
    assert_eq!(respond("05 06 0C 90 04 01 48 33"), "05 06 0C 90 04 01 48 33");
    assert_eq!(respond("11 01 00 13 00 25 0E 84")[..23], *"11 01 05 00 00 00 00 00");
}

/// The confirmation of every job, and each error, comes back to the master that asked.
#[test]
fn a_job_has_its_confirmations() {
    let respond = |protocol: &str, request: &str| -> Vec<String> {
        let protocol = PROTOCOLS.iter().find(|it| it.key == protocol).expect("a protocol");
        let bytes: Vec<u8> = request.split(' ').map(|byte| u8::from_str_radix(byte, 16).unwrap()).collect();
        let mut frame = (protocol.expect)(&bytes, Direction::Request, &Settings::default());
        read(frame.as_mut(), &bytes);
        let replies = replies(frame.as_mut(), &profibus::Settings::default(), None);
        replies.into_iter().map(|mut it| hex(&write(it.frame.as_mut(), &Deviations::default()))).collect()
    };
    let written = respond("profibus-parameter-channel", "52 01 20 34 00 64 00 00");
    assert_eq!(written[0], "52 01 20 34 00 64 00 00");
    assert!(written.iter().any(|reply| reply == "D2 01 20 34 08 00 00 30"), "{written:?}");
    assert_eq!(
        respond("profibus-parameter-channel", "41 00 22 00 00 00 00 00")[0],
        "71 00 22 00 00 00 00 00"
    );
    let request = "68 0F 0F 68 05 03 5D 41 00 22 00 00 00 00 00 04 00 05 DC 51 16";
    let framed = respond("profibus-fdl", request);
    assert_eq!(framed[0][..50], *"68 0F 0F 68 03 05 08 71 00 22 00 00 00 00 00 00 00");
}
