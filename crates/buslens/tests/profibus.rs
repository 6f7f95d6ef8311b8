//! PROFIBUS-DP: what holds for every telegram whatever its bytes, and what the manual prints.

mod random;
mod tiles;

use std::collections::BTreeSet;
use std::path::Path;

use buslens::field::{Direction, Field, Numbering, Severity, problems};
use buslens::frame::profibus_fdl::{Fdl, SC, SD1, SD2, SD3, SD4};
use buslens::profibus::client::{Busy, Client, Job, Outcome};
use buslens::profibus::jobs::{Jobs, State, Step};
use buslens::profibus::{
    Body, Channel, KINDS, Kind, Layout, OTHER_KINDS, Refusal, Service, Settings, Side, configuration,
};
use buslens::walk::form::{Content, Entry, Form};
use buslens::walk::{self, Deviations, form, guide};
use proptest::prelude::*;
use random::random;
use tiles::assert_tiled;

fn kinds() -> impl Iterator<Item = &'static Kind> {
    KINDS.iter().chain(OTHER_KINDS).copied()
}

fn kind() -> impl Strategy<Value = &'static Kind> {
    proptest::sample::select(kinds().collect::<Vec<_>>())
}

/// A kind that a frame carries: all but the parameter channel by itself.
fn service() -> impl Strategy<Value = &'static Kind> {
    proptest::sample::select(KINDS)
}

fn direction() -> impl Strategy<Value = Direction> {
    prop_oneof![Just(Direction::Request), Just(Direction::Response)]
}

fn settings() -> impl Strategy<Value = Settings> {
    let layout = (any::<bool>(), 0..17_usize, 0..17_usize);
    let ident = proptest::option::of(prop_oneof![Just(0x05EB), any::<u16>()]);
    (any::<bool>(), any::<bool>(), layout, ident).prop_map(|(swap_channel, swap_process, layout, ident)| {
        let (channel, outputs, inputs) = layout;
        Settings {
            swap_channel,
            swap_process,
            layout: Layout { channel, outputs, inputs },
            ident,
            told: true,
            not_set_up: false,
        }
    })
}

/// Settings with which user data is never empty: without data, a frame is no SD2.
fn settings_of_frames() -> impl Strategy<Value = Settings> {
    settings().prop_map(|mut settings| {
        settings.layout.outputs += 1;
        settings.layout.inputs += 1;
        settings
    })
}

fn any_bytes() -> impl Strategy<Value = Vec<u8>> {
    proptest::collection::vec(any::<u8>(), 0..40)
}

/// Bytes of any length, most of them with a known start, some with a length that is right.
fn frame_bytes() -> impl Strategy<Value = Vec<u8>> {
    let start = proptest::option::of(proptest::sample::select(vec![SD1, SD2, SD3, SD4, SC]));
    (any_bytes(), start, any::<bool>()).prop_map(|(mut bytes, start, right)| {
        let length = bytes.len().saturating_sub(6) as u8;
        if let (Some(start), Some(first)) = (start, bytes.first_mut()) {
            *first = start;
        }
        if let (true, Some(around)) = (right, bytes.get_mut(1..4)) {
            around.copy_from_slice(&[length, length, SD2]);
        }
        bytes
    })
}

const CONFIGURATIONS: [(&[u8], Layout); 7] = [
    (&[0xB7, 0xA3, 0x93], layout(true, 4, 4)),
    (&[0xB7, 0xA1, 0xA1, 0x93], layout(true, 4, 4)),
    (&[0xB7, 0xA1, 0xA1, 0x91, 0x91], layout(true, 4, 4)),
    (&[0xB7, 0xE0, 0xE0, 0xD0, 0xD0], layout(true, 4, 4)),
    (&[0xA3, 0x93], layout(false, 4, 4)),
    (&[0xB7, 0xE7, 0xD7], layout(true, 16, 16)),
    // Special format: 4 bytes out, 2 words in, 2 bytes of the maker; then 2 bytes in.
    (&[0xC2, 0x83, 0xC1, 0x01, 0x02, 0x91], layout(false, 4, 6)),
];

const fn layout(channel: bool, outputs: usize, inputs: usize) -> Layout {
    Layout { channel, outputs, inputs }
}

/// A valid telegram of `kind`, random by `seed`.
fn sample(kind: &'static Kind, settings: &Settings, seed: u64) -> Box<dyn Body> {
    // With random ident numbers, no certain one can be expected.
    let mut body = (kind.new)(&Settings { ident: None, ..settings.clone() });
    if body.layout().is_some() {
        // Random modules break the rules for them.
        let (bytes, _) = CONFIGURATIONS[seed as usize % CONFIGURATIONS.len()];
        walk::read(&mut *body, bytes);
    } else {
        walk::sample(&mut *body, &mut random(seed));
    }
    body
}

/// A valid SD2 with such a telegram.
fn sample_frame(kind: &'static Kind, settings: &Settings, seed: u64) -> Fdl {
    Fdl {
        body: sample(kind, settings, seed),
        ..Fdl::new(kind, &Settings { ident: None, ..settings.clone() })
    }
}

/// How many bytes a telegram of the kind has at least.
fn shortest(kind: &'static Kind, settings: &Settings) -> usize {
    let mut body = (kind.new)(settings);
    if body.layout().is_some() { 1 } else { walk::write(&mut *body, &Deviations::default()).len() }
}

fn codes(fields: &[Field]) -> Vec<&'static str> {
    problems(fields).iter().map(|problem| problem.code).collect()
}

/// Panics if two entries of a form have the same path.
fn assert_paths_are_unique(form: &Form) {
    fn collect<'a>(entries: &'a [Entry], paths: &mut BTreeSet<&'a str>) {
        for entry in entries {
            assert!(paths.insert(&entry.path), "{} twice", entry.path);
            match &entry.content {
                Content::Group { entries } => collect(entries, paths),
                Content::List { items } => items.iter().for_each(|item| collect(item, paths)),
                _ => {}
            }
        }
    }
    collect(&form.entries, &mut BTreeSet::new());
}

fn who() -> buslens::field::Message {
    buslens::message!("station {n}", n = 5u8)
}

fn bytes(hex: &str) -> Vec<u8> {
    hex.split_whitespace().map(|byte| u8::from_str_radix(byte, 16).unwrap()).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2000) })]

    #[test]
    fn any_bytes_tile_and_come_back(kind in kind(), settings in settings(), bytes in any_bytes()) {
        let mut body = (kind.new)(&settings);
        let reading = walk::read(&mut *body, &bytes);
        assert_tiled(&reading.fields, bytes.len());
        let _ = body.meaning(who()).sentence();
        let deviations = reading.deviations(&mut *body);
        prop_assert_eq!(&walk::write(&mut *body, &deviations), &bytes);

        let shown = form::form(&mut *body, &deviations);
        assert_paths_are_unique(&shown);
        let mut filled = (kind.new)(&settings);
        let entered = form::fill(&mut *filled, &shown).expect("a form fills what it was made of");
        prop_assert_eq!(&form::form(&mut *filled, &entered), &shown);
        prop_assert_eq!(walk::write(&mut *filled, &entered), bytes);
    }

    #[test]
    fn a_valid_telegram_has_no_problems_and_no_deviations(kind in kind(), settings in settings(), seed: u64) {
        let written = walk::write(&mut *sample(kind, &settings, seed), &Deviations::default());
        let mut read = (kind.new)(&Settings { ident: None, ..settings });
        let reading = walk::read(&mut *read, &written);
        assert_tiled(&reading.fields, written.len());
        // The two bits of the service are drawn one by one.
        // A KEB F5 reads 4 bytes, other devices need not.
        let drawn = ["read-and-write", "read-length", "no-such-diagnosis"];
        prop_assert!(codes(&reading.fields).iter().all(|code| drawn.contains(code)));
        prop_assert!(reading.deviations(&mut *read).is_empty());
        prop_assert_eq!(walk::write(&mut *read, &Deviations::default()), written);
    }

    #[test]
    fn each_shorter_prefix_says_what_is_missing(
        kind in kind(), settings in settings(), seed: u64, cut: prop::sample::Index
    ) {
        let written = walk::write(&mut *sample(kind, &settings, seed), &Deviations::default());
        // What comes behind the fields that every such telegram has may be of any length.
        let shortest = shortest(kind, &settings);
        if shortest > 0 {
            let prefix = &written[..cut.index(shortest)];
            let found = codes(&walk::read(&mut *(kind.new)(&settings), prefix).fields);
            prop_assert!(found.contains(&"truncated"), "{:?}", found);
        }
    }

    #[test]
    fn any_frame_tiles_and_comes_back(
        bytes in frame_bytes(), direction in direction(), settings in settings()
    ) {
        let mut frame = Fdl::expect(&bytes, direction, &settings);
        let reading = walk::read(&mut frame, &bytes);
        assert_tiled(&reading.fields, bytes.len());
        let _ = frame.meaning().sentence();
        let deviations = reading.deviations(&mut frame);
        prop_assert_eq!(&walk::write(&mut frame, &deviations), &bytes);

        let shown = form::form(&mut frame, &deviations);
        assert_paths_are_unique(&shown);
        let mut filled = Fdl::expect(&[], direction, &settings);
        let entered = form::fill(&mut filled, &shown).expect("a form fills what it was made of");
        prop_assert_eq!(&form::form(&mut filled, &entered), &shown);
        prop_assert_eq!(walk::write(&mut filled, &entered), bytes);
    }

    #[test]
    fn a_valid_frame_has_no_problems_and_its_check_matches(
        kind in service(), settings in settings_of_frames(), seed: u64
    ) {
        let written = walk::write(&mut sample_frame(kind, &settings, seed), &Deviations::default());
        prop_assert!(Fdl::check_matches(&written));
        prop_assert_eq!(Fdl::length(&written), Some(written.len()));
        prop_assert_eq!(Fdl::direction(&written), Some(kind.direction));
        let mut read = Fdl::expect(&written, kind.direction, &Settings { ident: None, ..settings });
        let reading = walk::read(&mut read, &written);
        assert_tiled(&reading.fields, written.len());
        let found = codes(&reading.fields);
        let drawn = ["read-and-write", "read-length", "no-such-diagnosis"];
        prop_assert!(found.iter().all(|code| drawn.contains(code)), "{:?}", found);
        prop_assert_eq!(read.kind.spec.key, kind.spec.key);
        prop_assert_eq!((read.slave(), read.sap()), (Some(1), kind.sap));
        prop_assert!(reading.deviations(&mut read).is_empty());
        prop_assert_eq!(walk::write(&mut read, &Deviations::default()), written);
    }

    #[test]
    fn a_shorter_frame_says_what_is_missing(
        kind in service(), settings in settings_of_frames(), seed: u64, cut: prop::sample::Index, fixed: bool
    ) {
        let mut frame = sample_frame(kind, &settings, seed);
        if fixed {
            frame = status_request();
        }
        let written = walk::write(&mut frame, &Deviations::default());
        let prefix = &written[..cut.index(written.len())];
        let mut read = Fdl::expect(prefix, frame.direction, &settings);
        let found = codes(&walk::read(&mut read, prefix).fields);
        prop_assert!(found.contains(&"truncated"), "{:?}", found);
        prop_assert!(!Fdl::check_matches(prefix));
    }

    #[test]
    fn a_flipped_bit_is_noticed(
        kind in service(), settings in settings_of_frames(), seed: u64, place: prop::sample::Index, bit in 0..8,
        start in proptest::sample::select(vec![SD1, SD2, SD3])
    ) {
        let mut frame = match start {
            SD1 => status_request(),
            SD2 => sample_frame(kind, &settings, seed),
            _ => eight_bytes(seed),
        };
        let mut written = walk::write(&mut frame, &Deviations::default());
        prop_assert!(Fdl::check_matches(&written));
        let place = place.index(written.len());
        written[place] ^= 1u8 << bit;
        prop_assert!(!Fdl::check_matches(&written));
        for direction in [Direction::Request, Direction::Response] {
            let mut read = Fdl::expect(&written, direction, &frame.settings);
            let reading = walk::read(&mut read, &written);
            assert_tiled(&reading.fields, written.len());
            let noticed = problems(&reading.fields).iter().any(|problem| problem.severity == Severity::Error);
            prop_assert!(noticed);
        }
    }

    /// Jobs take whatever comes.
    #[test]
    fn jobs_never_panic(telegrams in proptest::collection::vec((any::<[u8; 8]>(), direction()), 0..20)) {
        let mut jobs = Jobs::default();
        let mut count = 0;
        for (bytes, direction) in telegrams {
            let channel = Channel::read(&bytes, direction, &Settings::default());
            prop_assert_eq!(channel.bytes(), bytes);
            if let Some(step) = jobs.next(&channel) {
                prop_assert!(step.job == count || step.job == count + 1);
                count = step.job;
            }
        }
    }
}

/// Asks station 2 whether it is there: SD1.
fn status_request() -> Fdl {
    let settings = Settings::default();
    Fdl { start: SD1, control: 0x49, ..Fdl::new(Kind::of(None, Direction::Request), &settings) }
}

/// Data exchange with 8 bytes: SD3.
fn eight_bytes(seed: u64) -> Fdl {
    let settings = Settings { layout: layout(false, 8, 8), ..Settings::default() };
    let kind = Kind::of(None, Direction::Response);
    Fdl { start: SD3, body: sample(kind, &settings, seed), ..Fdl::new(kind, &settings) }
}

#[test]
fn the_guide_and_the_reader_agree() {
    let settings = Settings::default();
    for kind in kinds() {
        let rows = guide::guide(&mut *(kind.new)(&settings));
        let mut body = sample(kind, &settings, 1);
        let written = walk::write(&mut *body, &Deviations::default());
        let reading = walk::read(&mut *body, &written);
        let mut read = Vec::new();
        for field in &reading.fields {
            field.visit(&mut |field| read.push((field.spec.key, field.span.from)));
        }
        for row in rows.iter().filter(|row| matches!(row.size, guide::Size::Fixed(_))) {
            // What a parameter channel holds depends on its control byte.
            if let Some((_, offset)) = read.iter().find(|(key, _)| *key == row.spec.key) {
                assert!(row.offset.is_none_or(|told| told == *offset), "{}", row.spec.key);
            } else {
                assert!(["unused", "value", "error_class"].contains(&row.spec.key), "{}", row.spec.key);
            }
        }
    }
}

#[test]
fn every_service_is_listed_and_told_apart() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/profibus");
    let registry = std::fs::read_to_string(source.join("mod.rs")).unwrap();
    // The registry, and what services share or carry.
    let others = ["mod", "client", "configuration", "ident", "jobs", "no_data", "user_data"];
    for entry in std::fs::read_dir(source).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap();
        if !others.contains(&name) {
            let text = std::fs::read_to_string(&path).unwrap();
            for kind in ["REQUEST", "RESPONSE"] {
                let there = text.contains(&format!("pub static {kind}: Kind"));
                assert_eq!(there, registry.contains(&format!("&{name}::{kind}")), "{name}::{kind}");
            }
        }
    }
    let mut keys = BTreeSet::new();
    let mut services = BTreeSet::new();
    for kind in kinds() {
        assert!(keys.insert(kind.spec.key), "{} twice", kind.spec.key);
        assert!(kind.spec.key.ends_with(&format!("_{}", kind.direction.key())), "{}", kind.spec.key);
        assert!(!kind.spec.note.is_empty(), "{} has no note", kind.spec.key);
    }
    for kind in KINDS {
        assert!(services.insert((kind.sap, kind.direction.key())), "{}", kind.spec.key);
        assert!(std::ptr::eq(Kind::of(kind.sap, kind.direction), *kind));
    }
}

// The parameter channel.

/// Section 7.5.1 as printed, with the misprints in E4 and E6.
const SEQUENCE: [(Direction, &str); 15] = [
    (Direction::Response, "00 00 00 00 00 00 00 00"),
    (Direction::Request, "52 00 23 00 00 0B 00 00"),
    (Direction::Response, "00 00 00 00 00 00 00 00"),
    (Direction::Request, "52 00 23 00 00 0B 00 00"),
    (Direction::Response, "00 00 00 00 00 00 00 00"),
    (Direction::Request, "52 00 23 00 00 0B 00 00"),
    (Direction::Response, "C2 00 23 00 08 00 00 30"),
    (Direction::Request, "12 00 23 00 00 03 00 00"),
    (Direction::Response, "C2 00 23 00 08 00 00 00"),
    (Direction::Request, "12 00 23 00 00 03 00 00"),
    (Direction::Response, "02 00 23 00 00 03 00 00"),
    (Direction::Request, "41 00 22 00 00 03 00 00"),
    (Direction::Response, "02 00 23 00 00 00 00 00"),
    (Direction::Request, "41 00 22 00 00 03 00 00"),
    (Direction::Response, "71 00 22 00 00 00 00 46"),
];

fn channel(direction: Direction, hex: &str) -> Channel {
    Channel::read(&bytes(hex), direction, &Settings::default())
}

fn request(hex: &str) -> Channel {
    channel(Direction::Request, hex)
}

fn confirmation(hex: &str) -> Channel {
    channel(Direction::Response, hex)
}

fn step(jobs: &mut Jobs, channel: &Channel) -> Step {
    jobs.next(channel).expect("a step of a job")
}

fn step_codes(step: &Step) -> Vec<&'static str> {
    step.problems.iter().map(|problem| problem.code).collect()
}

#[test]
fn the_printed_sequence_is_three_jobs() {
    use State::{Asked, Done, Failed, Running};
    let mut jobs = Jobs::default();
    let steps: Vec<Option<Step>> =
        SEQUENCE.map(|(direction, hex)| jobs.next(&channel(direction, hex))).into();
    assert_eq!(steps[0], None, "E0 is before the first job");
    let steps: Vec<Step> = steps.into_iter().flatten().collect();
    let told: Vec<_> = steps.iter().map(|step| (step.job, step.state, step.repeated)).collect();
    assert_eq!(
        told,
        [
            (1, Asked, false),
            (1, Running, false),
            (1, Asked, true),
            (1, Running, false),
            (1, Asked, true),
            (1, Failed, false),
            (2, Asked, false),
            (2, Running, false),
            (2, Asked, true),
            (2, Done, false),
            (3, Asked, false),
            (3, Running, false),
            (3, Asked, true),
            (3, Done, false),
        ]
    );
    assert_eq!(steps[5].refusal, Some(Refusal { class: 8, code: 0, additional: 0x30 }));
    assert_eq!((steps[9].value, steps[13].value), (Some(3), Some(70)));
    for (index, step) in steps.iter().enumerate() {
        let message = step.problems.first().map(|problem| (problem.code, problem.message.to_string()));
        let expected = match index {
            7 => Some(
                "byte 8 is 00h where it was 30h: as long as job 2 runs, the slave \
                 should repeat the confirmation before",
            ),
            11 => Some(
                "byte 6 is 00h where it was 03h: as long as job 3 runs, the slave \
                 should repeat the confirmation before",
            ),
            _ => None,
        };
        assert_eq!(message, expected.map(|text| ("stale-otherwise", text.to_owned())), "{index}");
    }
    assert_eq!(steps[7].problems[0].span, buslens::field::Span::new(7, 8));
}

#[test]
fn the_printed_sequence_in_words() {
    let mut said = Vec::new();
    let mut jobs = Jobs::default();
    for (direction, hex) in SEQUENCE {
        let settings = Settings { layout: layout(true, 0, 0), ..Settings::default() };
        let mut channel = (Kind::of(None, direction).new)(&settings);
        if let Some(request) = jobs.job() {
            channel.answer(request);
        }
        walk::read(&mut *channel, &bytes(hex));
        jobs.next(channel.channel().unwrap());
        said.push(channel.meaning(who()).to_string());
    }
    assert_eq!(said[0], "station 5 has no job; station 5 has no inputs");
    assert_eq!(said[1], "write 11 to index 2300h of station 5; send station 5 no outputs");
    let refused = "station 5 rejects the job to write index 2300h: value out of range (error 8-0-0030h)";
    assert!(said[6].starts_with(refused), "{}", said[6]);
    assert!(said[10].starts_with("station 5 confirms: index 2300h written with 3;"), "{}", said[10]);
    assert!(said[11].starts_with("ask station 5 for index 2200h;"), "{}", said[11]);
    assert!(said[14].starts_with("station 5 answers: index 2200h = 70;"), "{}", said[14]);
    let alone = confirmation("02 00 23 00 00 03 00 00");
    assert_eq!((alone.length(), alone.value()), (None, None), "its length bits do not tell");
    assert_eq!(
        alone.meaning(who()).to_string(),
        "station 5 confirms: index 2300h written, data 00 03 00 00; only the request tells how many bytes count"
    );
    let answer = alone.answering(&request("12 00 23 00 00 03 00 00"));
    assert_eq!((answer.length(), answer.value()), (Some(2), Some(3)));
}

#[test]
fn a_channel_says_what_it_holds() {
    let read = confirmation("71 00 22 00 00 00 00 46");
    assert_eq!((read.service(), read.handshake(), read.length()), (Service::Read, 1, Some(4)));
    assert_eq!((read.index, read.subindex, read.value(), read.refusal()), (0x2200, 0, Some(70), None));
    let ask = request("41 00 22 00 00 03 00 00");
    assert_eq!((ask.service().key(), ask.length(), ask.value()), ("read", None, None));
    for (hex, length, value) in [
        ("02 01 23 00 11 22 33 44", 1, 0x11),
        ("12 01 23 00 11 22 33 44", 2, 0x1122),
        ("22 01 23 00 11 22 33 44", 3, 0x11_2233),
        ("32 01 23 00 11 22 33 44", 4, 0x1122_3344),
        ("32 00 5F F8 00 00 00 FF", 4, 255),
    ] {
        let write = request(hex);
        assert_eq!((write.length(), write.value()), (Some(length), Some(value)), "{hex}");
    }
    assert_eq!(request("00 00 00 00 00 00 00 00").meaning(who()).to_string(), "no job for station 5");
    let places = [("01", "23", "set 0"), ("8A", "23", "sets 1, 3, 7"), ("0A", "60", "subindex 10")];
    for (subindex, high, place) in places {
        let said = request(&format!("01 {subindex} {high} 00 00 00 00 00")).meaning(who()).to_string();
        assert_eq!(said, format!("ask station 5 for index {high}00h, {place}"));
    }
}

#[test]
fn read_and_write_at_once_is_a_problem_of_the_request() {
    let both = bytes("03 00 23 00 00 00 00 00");
    let codes = |direction| {
        let mut channel = Channel::new(direction, &Settings::default());
        codes(&walk::read(&mut channel, &both).fields)
    };
    assert_eq!(codes(Direction::Request), ["read-and-write"]);
    assert_eq!(codes(Direction::Response), [""; 0]);
    let mut jobs = Jobs::default();
    step(&mut jobs, &request("43 00 23 00 00 00 00 00"));
    let refused = step(&mut jobs, &confirmation("C3 00 23 00 05 04 00 00"));
    assert_eq!(refused.refusal.unwrap().name().unwrap().label, "read and write at once");
}

#[test]
fn every_error_of_the_manual_has_its_name() {
    for (class, code, additional, label) in [
        (5, 4, 0x0000, "read and write at once"),
        (6, 2, 0x0000, "no link to the inverter"),
        (6, 3, 0x0000, "parameter is write-protected"),
        (6, 3, 0x0030, "password level too low"),
        (6, 4, 0x0000, "index not known"),
        (6, 5, 0x0000, "process data description not allowed"),
        (6, 5, 0x0011, "subindex not known"),
        (8, 0, 0x0022, "inverter busy"),
        (8, 0, 0x0030, "value out of range"),
        (8, 0, 0x0033, "set not allowed"),
        (8, 0, 0x0034, "not possible now"),
    ] {
        let refusal = Refusal { class, code, additional };
        assert_eq!(refusal.name().map(|name| name.label), Some(label));
        let wire = [0xC1, 0, 0x22, 0, class, code, 0, additional as u8];
        let mut channel = Channel::new(Direction::Response, &Settings::default());
        let reading = walk::read(&mut channel, &wire);
        let field = reading.fields.iter().find(|field| field.spec.key == "additional_code").unwrap();
        assert_eq!(field.meaning().unwrap().to_string(), label);
        let said = channel.meaning(who()).to_string();
        let number = format!("{class}-{code}-{additional:04X}h");
        assert_eq!(said, format!("station 5 rejects the job to read index 2200h: {label} (error {number})"));
    }
    let unknown = confirmation("C2 00 22 00 08 00 00 31");
    assert_eq!(unknown.refusal().unwrap().name(), None);
    assert_eq!(
        unknown.meaning(who()).to_string(),
        "station 5 rejects the job to write index 2200h with error 8-0-0031h (not listed in the manual)"
    );
}

#[test]
fn value_swapping_swaps_index_and_long_values() {
    let settings = Settings { swap_channel: true, swap_process: true, ..Settings::default() };
    let long = Channel::read(&bytes("71 00 00 22 46 00 00 00"), Direction::Response, &settings);
    assert_eq!((long.index, long.value()), (0x2200, Some(70)));
    let short = Channel::read(&bytes("52 00 00 23 00 0B 00 00"), Direction::Request, &settings);
    assert_eq!((short.index, short.value()), (0x2300, Some(11)));
    let error = Channel::read(&bytes("C2 00 00 23 08 00 00 30"), Direction::Response, &settings);
    assert_eq!(error.refusal(), Some(Refusal { class: 8, code: 0, additional: 0x30 }));

    let mut body = (Kind::of(None, Direction::Request).new)(&settings);
    walk::read(&mut *body, &bytes("52 00 00 23 00 0B 00 00 34 12 78 56"));
    assert_eq!(body.process().unwrap().words, [0x1234, 0x5678]);
}

// Jobs.

#[test]
fn another_job_needs_another_handshake() {
    let mut jobs = Jobs::default();
    assert_eq!(jobs.next(&confirmation("00 00 00 00 00 00 00 00")), None);
    let untoggled = step(&mut jobs, &request("01 00 22 00 00 00 00 00"));
    assert_eq!((untoggled.job, step_codes(&untoggled)), (1, vec!["handshake-not-changed"]));
    assert_eq!(untoggled.problems[0].severity, Severity::Error);

    let mut jobs = Jobs::default();
    step(&mut jobs, &request("41 00 22 00 00 00 00 00"));
    step(&mut jobs, &confirmation("71 00 22 00 00 00 00 46"));
    let changed = step(&mut jobs, &request("41 00 22 01 00 00 00 00"));
    assert_eq!((changed.job, changed.state, changed.repeated), (1, State::Done, false));
    assert_eq!(step_codes(&changed), ["handshake-not-changed"]);
    let again = step(&mut jobs, &request("41 00 22 01 00 00 00 00"));
    assert!(again.repeated && again.problems.is_empty(), "said once");
    // Left-overs in a read request are no change.
    let left = step(&mut jobs, &request("01 00 22 01 00 00 00 00"));
    assert_eq!((left.job, left.state, left.problems), (2, State::Asked, vec![]));
    assert!(step(&mut jobs, &request("01 00 22 01 12 34 00 00")).repeated);
}

#[test]
fn a_job_must_be_finished_before_the_next() {
    let mut jobs = Jobs::default();
    jobs.next(&confirmation("00 00 00 00 00 00 00 00"));
    step(&mut jobs, &request("41 00 22 00 00 00 00 00"));
    let early = step(&mut jobs, &request("01 00 22 01 00 00 00 00"));
    assert_eq!((early.job, step_codes(&early)), (2, vec!["job-not-finished"]));
    // Its handshake is the one that the slave still shows: nothing was done.
    let stale = step(&mut jobs, &confirmation("00 00 00 00 00 00 00 00"));
    assert_eq!((stale.state, step_codes(&stale)), (State::Done, vec!["other-job"]));
}

#[test]
fn a_confirmation_must_be_that_of_the_job() {
    let mut jobs = Jobs::default();
    step(&mut jobs, &request("52 00 23 00 00 0B 00 00"));
    let other = step(&mut jobs, &confirmation("42 00 23 01 00 0B 00 00"));
    assert_eq!(
        other.problems[0].message.to_string(),
        "by its handshake this confirms the job, but the job was: write index 2300h; and \
         this says: write index 2301h"
    );
    step(&mut jobs, &request("12 00 23 00 00 03 00 00"));
    let otherwise = step(&mut jobs, &confirmation("02 00 23 00 00 04 00 00"));
    assert_eq!((otherwise.value, step_codes(&otherwise)), (Some(4), vec!["written-otherwise"]));
    let repeated = step(&mut jobs, &confirmation("02 00 23 00 00 04 00 00"));
    assert_eq!((repeated.job, repeated.state, repeated.problems), (2, State::Done, vec![]));
    let lost = step(&mut jobs, &confirmation("42 00 00 00 00 00 00 00"));
    assert_eq!((lost.job, lost.state, step_codes(&lost)), (2, State::Done, vec!["handshake-changed"]));
    assert_eq!(jobs.next(&request("00 00 00 00 00 00 00 00")), None, "no service is no job");
    assert_eq!(jobs.next(&confirmation("42 00 00 00 00 00 00 00")), None);
}

// The client.

/// A slave with one parameter, which takes a few cycles for a job.
struct Slave {
    settings: Settings,
    shown: [u8; 8],
    cycles: usize,
    busy: usize,
    value: u32,
}

impl Slave {
    fn new(handshake: u8, settings: &Settings) -> Self {
        let shown = [handshake << 6, 0, 0, 0, 0, 0, 0, 0];
        Self { settings: settings.clone(), shown, cycles: 3, busy: 3, value: 70 }
    }

    fn cycle(&mut self, request: [u8; 8]) -> [u8; 8] {
        let request = Channel::read(&request, Direction::Request, &self.settings);
        let shown = Channel::read(&self.shown, Direction::Response, &self.settings);
        if request.service() == Service::None || request.handshake() == shown.handshake() {
            return self.shown;
        }
        self.busy -= 1;
        if self.busy > 0 {
            return self.shown;
        }
        self.busy = self.cycles;
        let mut answer = Channel { direction: Direction::Response, ..request.clone() };
        match request.value() {
            _ if request.index != 0x2300 => {
                answer.control |= 0x80;
                answer.refusal = Refusal { class: 6, code: 4, additional: 0 };
            }
            // The length bits of E5 in the manual.
            Some(value) => {
                self.value = value;
                answer.control &= !0x30;
                answer.request_length = request.length();
            }
            None => {
                answer.control |= 0x30;
                answer.value = self.value;
            }
        }
        self.shown = answer.bytes();
        self.shown
    }
}

/// What comes of `job`, and after how many cycles.
fn run(client: &mut Client, slave: &mut Slave, job: Job) -> (Outcome, usize) {
    client.start(job).expect("nothing else to do");
    assert_eq!(client.start(job), Err(Busy));
    for cycle in 1..20 {
        match client.receive(&slave.cycle(client.request())) {
            Outcome::Waiting => {}
            outcome => return (outcome, cycle),
        }
    }
    (Outcome::Waiting, 20)
}

#[test]
fn a_client_does_its_jobs() {
    let swapped = Settings { swap_channel: true, ..Settings::default() };
    for (settings, handshake) in
        [(Settings::default(), 0), (Settings::default(), 1), (swapped.clone(), 0), (swapped, 1)]
    {
        let mut slave = Slave::new(handshake, &settings);
        let mut client = Client::new(&settings);
        let read = Job::Read { index: 0x2300, subindex: 0 };
        let write = |length, value| Job::Write { index: 0x2300, subindex: 1, length, value };
        // The first cycle tells the handshake.
        assert_eq!(run(&mut client, &mut slave, read), (Outcome::Done(Some(70)), 4));
        assert_eq!(run(&mut client, &mut slave, write(2, 11)), (Outcome::Done(Some(11)), 3));
        assert_eq!(
            run(&mut client, &mut slave, write(4, 0x1234_5678)),
            (Outcome::Done(Some(0x1234_5678)), 3)
        );
        assert_eq!(run(&mut client, &mut slave, read), (Outcome::Done(Some(0x1234_5678)), 3));
        let wrong = Job::Read { index: 0x2301, subindex: 0 };
        let refusal = Refusal { class: 6, code: 4, additional: 0 };
        assert_eq!(run(&mut client, &mut slave, wrong), (Outcome::Failed(refusal), 3));
        assert_eq!(run(&mut client, &mut slave, read), (Outcome::Done(Some(0x1234_5678)), 3));
        assert_eq!(client.receive(&slave.cycle(client.request())), Outcome::Idle);
    }
}

#[test]
fn a_client_sends_what_the_manual_prints() {
    let mut client = Client::new(&Settings::default());
    assert_eq!(client.receive(&bytes(SEQUENCE[0].1)), Outcome::Idle);
    client.start(Job::Write { index: 0x2300, subindex: 0, length: 2, value: 11 }).unwrap();
    let mut outcomes = Vec::new();
    for pair in SEQUENCE[1..].chunks(2) {
        if pair[0].1.starts_with("12") && client.request()[0] != 0x12 {
            client.start(Job::Write { index: 0x2300, subindex: 0, length: 2, value: 3 }).unwrap();
        }
        if pair[0].1.starts_with("41") && client.request()[0] != 0x41 {
            client.start(Job::Read { index: 0x2200, subindex: 0 }).unwrap();
        }
        let [service, index, data] = [0..1, 1..4, 4..8].map(|part| client.request()[part].to_vec());
        let printed = bytes(pair[0].1);
        assert_eq!((service, index), (printed[..1].to_vec(), printed[1..4].to_vec()));
        // A read carries nothing; the manual prints left-overs.
        assert!(printed[0] == 0x41 || data == printed[4..]);
        outcomes.push(client.receive(&bytes(pair[1].1)));
    }
    use Outcome::{Done, Failed, Waiting};
    let refusal = Refusal { class: 8, code: 0, additional: 0x30 };
    assert_eq!(
        outcomes,
        [Waiting, Waiting, Failed(refusal), Waiting, Done(Some(3)), Waiting, Done(Some(70))]
    );
}

#[test]
fn a_client_waits_through_nonsense() {
    let mut client = Client::new(&Settings::default());
    assert_eq!(client.receive(&[]), Outcome::Idle);
    client.start(Job::Write { index: 0x2300, subindex: 0, length: 9, value: 0x1_0203 }).unwrap();
    assert_eq!(client.receive(&[0x40]), Outcome::Waiting);
    assert_eq!(client.request(), [0; 8], "the handshake is not known yet");
    // Process data behind the channel does not matter.
    assert_eq!(client.receive(&[0; 12]), Outcome::Waiting);
    assert_eq!(client.request(), [0x72, 0, 0x23, 0, 0, 1, 2, 3], "4 bytes at most");
}

// The other services.

fn read(kind: &'static Kind, settings: &Settings, hex: &str) -> (Box<dyn Body>, Vec<Field>) {
    let mut body = (kind.new)(settings);
    let reading = walk::read(&mut *body, &bytes(hex));
    assert_tiled(&reading.fields, bytes(hex).len());
    (body, reading.fields)
}

fn says(fields: &[Field], key: &str) -> String {
    let field = fields.iter().find(|field| field.spec.key == key).expect(key);
    field.meaning().map_or(String::new(), |meaning| meaning.to_string())
}

fn request_to(sap: u8) -> &'static Kind {
    Kind::of(Some(sap), Direction::Request)
}

fn response_from(sap: u8) -> &'static Kind {
    Kind::of(Some(sap), Direction::Response)
}

#[test]
fn user_data_has_a_channel_and_words() {
    let settings = Settings::default();
    let (body, fields) =
        read(Kind::of(None, Direction::Request), &settings, "41 00 22 00 00 00 00 00 04 00 05 DC");
    assert!(codes(&fields).is_empty());
    let process = body.process().unwrap();
    assert_eq!((process.side, process.offset, process.words), (Side::Outputs, 8, &[0x0400, 0x05DC][..]));
    assert_eq!(body.channel().unwrap().index, 0x2200);
    assert_eq!(
        body.meaning(who()).to_string(),
        "ask station 5 for index 2200h; send station 5 outputs 0400h, 05DCh"
    );
    let words = &fields.iter().find(|field| field.spec.key == "outputs").unwrap().children;
    assert_eq!(words[1].number, Some(Numbering::At(2)));

    let settings = Settings { layout: layout(false, 2, 3), ..settings };
    let (body, fields) = read(Kind::of(None, Direction::Response), &settings, "01 02 03");
    assert!(codes(&fields).is_empty());
    assert_eq!((body.process().unwrap().offset, body.process().unwrap().words), (0, &[0x0102][..]));
    assert_eq!(body.meaning(who()).to_string(), "station 5 has inputs 0102h, 03h");
    let (body, _) = read(response_from(57), &settings, "01 02");
    assert_eq!(body.process().unwrap().side, Side::Outputs);
}

#[test]
fn set_prm_tells_watchdog_lock_and_ident() {
    let settings = Settings { ident: Some(0x05EB), ..Settings::default() };
    let (body, fields) = read(request_to(61), &settings, "88 02 19 0B 05 EB 00");
    assert!(codes(&fields).is_empty());
    assert_eq!(says(&fields, "station_status"), "watchdog on, locked for other masters");
    assert_eq!(says(&fields, "ident"), "KEB F5 PROFIBUS-DP operator");
    assert_eq!(
        body.meaning(who()).to_string(),
        "parameterise station 5 (ident 05EBh): locked for other masters, watchdog 500 ms"
    );
    for (status, said) in [
        ("00", "not locked, settings may change"),
        ("40", "released for other masters"),
        ("80", "locked for other masters"),
        ("C0", "released for other masters"),
        ("B0", "freeze, sync, locked for other masters"),
    ] {
        let (body, fields) = read(request_to(61), &settings, &format!("{status} 00 00 0B 05 EB 03"));
        assert_eq!(says(&fields, "station_status"), said);
        assert_eq!(says(&fields, "groups"), "group 1, group 2");
        assert!(codes(&fields).is_empty(), "no watchdog needs no factors");
        assert!(body.meaning(who()).to_string().ends_with("no watchdog"));
    }
    let (_, fields) = read(request_to(61), &settings, "89 00 01 0B 80 6A 00 01 02");
    assert_eq!(codes(&fields), ["reserved-bits", "out-of-range", "wrong-ident"]);
    assert_eq!(fields.last().unwrap().span.len(), 2, "parameters of the device");
}

#[test]
fn configurations_of_the_manual_are_right() {
    for (bytes, layout) in CONFIGURATIONS {
        assert_eq!(configuration::layout(bytes), layout);
        for kind in [request_to(62), response_from(59)] {
            let mut body = (kind.new)(&Settings::default());
            let reading = walk::read(&mut *body, bytes);
            assert_tiled(&reading.fields, bytes.len());
            assert!(codes(&reading.fields).is_empty(), "{bytes:X?} {:?}", codes(&reading.fields));
            assert_eq!(body.layout(), Some(layout));
        }
    }
    let (body, fields) = read(request_to(62), &Settings::default(), "B7 E0 D0 93 A1");
    let said: Vec<String> =
        fields[0].children.iter().map(|field| field.meaning().unwrap().to_string()).collect();
    assert_eq!(
        said,
        [
            "8 bytes in and out: parameter channel",
            "length 1, output, words, consistent as a whole",
            "length 1, input, words, consistent as a whole",
            "length 4, input, bytes, consistent as a whole",
            "length 2, output, bytes, consistent as a whole",
        ]
    );
    assert_eq!(
        body.meaning(who()).to_string(),
        "tell station 5 its configuration: parameter channel, 4 bytes out, 6 bytes in"
    );
}

#[test]
fn the_rules_of_the_manual_for_configurations() {
    let many = format!("B7{}{}", " E0".repeat(8), " D0".repeat(8));
    let too_many = format!("{many} 00");
    for (hex, expected) in [
        (many.as_str(), &[][..]),
        (too_many.as_str(), &["too-many-modules"]),
        ("A3 B7 93", &["channel-not-first"]),
        ("B3 A3 93", &["both-ways"]),
        ("B7 A2 93", &["half-word"]),
        ("B7 B7", &["channel-not-first"]),
        ("B7 A0 93", &["module-too-small"]),
        ("B7 E8 93", &["too-much-process-data"]),
        ("B7 EF DF", &["too-much-process-data", "too-much-process-data"]),
        ("B7 C1 83", &["truncated"]),
        ("", &["truncated"]),
    ] {
        let (_, fields) = read(request_to(62), &Settings::default(), hex);
        assert_eq!(codes(&fields), expected, "{hex}");
        // They are the F5's own rules.
        let other = Settings { ident: Some(0x806A), ..Settings::default() };
        let (_, fields) = read(request_to(62), &other, hex);
        assert_eq!(codes(&fields).is_empty(), !expected.contains(&"truncated"), "{hex}");
    }
}

#[test]
fn slave_diag_tells_every_bit() {
    let said: [&[&str]; 3] = [
        &[
            "does not exist",
            "not ready",
            "configuration fault",
            "extended diagnosis",
            "function not supported",
            "invalid response",
            "parameter fault",
            "locked by another master",
        ],
        &[
            "must be set up",
            "static diagnosis",
            "nothing set",
            "watchdog on",
            "inputs frozen",
            "outputs held (sync)",
            "not present",
            "deactivated",
        ],
        &["", "", "", "", "", "", "", "extended diagnosis overflow"],
    ];
    for (index, labels) in said.into_iter().enumerate() {
        for (bit, label) in labels.iter().enumerate() {
            let mut wire = [0, 4, 0, 2, 5, 0xEB];
            wire[index] |= 1 << bit;
            let mut body = (response_from(60).new)(&Settings::default());
            let fields = walk::read(&mut *body, &wire).fields;
            let reserved = label.is_empty();
            assert_eq!(codes(&fields), if reserved { &["reserved-bits"][..] } else { &[] });
            let said = fields[index].meaning().unwrap().to_string();
            assert!(reserved || said == *label, "{said} is not {label}");
        }
    }
    let (_, fields) = read(response_from(60), &Settings::default(), "00 00 00 FF 05 EB");
    assert_eq!(says(&fields, "station_status_2"), "bit 2 not set");
    assert_eq!(says(&fields, "master"), "no master");
}

#[test]
fn slave_diag_in_a_sentence() {
    let settings = Settings { ident: Some(0x05EB), ..Settings::default() };
    for (hex, said) in [
        ("00 0C 00 02 05 EB", "station 5 says: ready, watchdog on; set up by station 2"),
        ("02 05 00 FF 05 EB", "station 5 says: not ready, must be set up; no master has set it up"),
        (
            "08 04 00 02 05 EB 03 01 02",
            "station 5 says: extended diagnosis; set up by station 2; 3 bytes of extended diagnosis",
        ),
    ] {
        let (body, fields) = read(response_from(60), &settings, hex);
        assert_eq!(body.meaning(who()).to_string(), said);
        // A KEB F5 has no more to say than six bytes.
        let more: &[&str] = if hex.len() > 17 { &["no-such-diagnosis"] } else { &[] };
        assert_eq!(codes(&fields), more);
    }
    assert_eq!(codes(&read(response_from(60), &settings, "00 0C 00 02 05 EC").1), ["wrong-ident"]);
}

#[test]
fn commands_and_addresses() {
    let (body, fields) = read(request_to(58), &Settings::default(), "28 05");
    assert!(codes(&fields).is_empty());
    assert_eq!(
        body.meaning(who()).to_string(),
        "command station 5 (group 1, group 3): freeze inputs, hold outputs (sync)"
    );
    assert_eq!(codes(&read(request_to(58), &Settings::default(), "C1 00").1), ["reserved-bits"; 2]);
    let (body, _) = read(request_to(55), &Settings::default(), "09 05 EB 00");
    assert_eq!(body.meaning(who()).to_string(), "give station 5 the address 9");
}

// Frames.

fn frame(hex: &str) -> (Fdl, Vec<Field>) {
    let bytes = bytes(hex);
    let direction = Fdl::direction(&bytes).unwrap_or(Direction::Request);
    let mut frame = Fdl::expect(&bytes, direction, &Settings::default());
    let fields = walk::read(&mut frame, &bytes).fields;
    assert_tiled(&fields, bytes.len());
    (frame, fields)
}

#[test]
fn frames_in_a_sentence() {
    for (hex, said) in [
        ("10 02 01 49 4C 16", "station 1 to station 2: ask for the FDL status"),
        ("10 01 02 00 03 16", "station 2 answers station 1: OK"),
        ("DC 03 02", "station 2 hands the token to station 3"),
        ("E5", "short acknowledgement: the request was taken"),
        ("68 05 05 68 85 82 6D 3C 3E EE 16", "ask station 5 for its diagnosis"),
        (
            "68 0B 0B 68 82 85 08 3E 3C 00 0C 00 02 05 EB 87 16",
            "station 5 says: ready, watchdog on; set up by station 2",
        ),
        (
            "68 08 08 68 85 82 5D 3D 3E 00 00 00 DF 16",
            "parameterise station 5 (ident 0000h): not locked, settings may change, no watchdog",
        ),
        ("68 07 07 68 FF 82 46 3A 3E 02 00 41 16", "command all stations (all groups): clear outputs"),
        ("68 06 06 68 85 82 5D 21 3E 01 C4 16", "station 5: unknown service, with 1 byte of data"),
    ] {
        let (read, fields) = frame(hex);
        assert_eq!(read.meaning().to_string(), said, "{hex}");
        let expected: &[&str] = if hex.contains("3D 3E 00 00 00") { &["truncated"] } else { &[] };
        assert_eq!(codes(&fields), expected, "{hex}");
        assert_eq!(Fdl::check_matches(&bytes(hex)), !hex.starts_with(['D', 'E']), "{hex}");
        assert_eq!(Fdl::length(&bytes(hex)), Some(bytes(hex).len()));
    }
}

#[test]
fn data_exchange_in_a_frame() {
    let (read, fields) = frame("68 0F 0F 68 05 02 5D 41 00 22 00 00 00 00 00 04 00 05 DC AC 16");
    assert!(codes(&fields).is_empty(), "{:?}", codes(&fields));
    assert_eq!((read.slave(), read.sap()), (Some(5), None));
    assert_eq!(read.body.channel().unwrap().index, 0x2200);
    assert_eq!(read.body.process().unwrap().words, [0x0400, 0x05DC]);
    let settings = Settings { layout: layout(true, 0, 0), ..Settings::default() };
    let wire = bytes("A2 02 05 08 71 00 22 00 00 00 00 46 E8 16");
    let mut read = Fdl::expect(&wire, Direction::Response, &settings);
    assert!(codes(&walk::read(&mut read, &wire).fields).is_empty());
    assert_eq!(read.body.channel().unwrap().value(), Some(70));
}

#[test]
fn what_is_wrong_with_a_frame_is_said() {
    for (hex, expected) in [
        // The lengths differ; both are wrong; the second 68h is.
        ("68 05 06 68 85 82 6D 3C 3E EE 16", &["count-mismatch"][..]),
        ("68 04 04 68 85 82 6D 3C 3E EE 16", &["count-mismatch"]),
        ("68 05 05 67 85 82 6D 3C 3E EE 16", &["count-mismatch"]),
        ("68 05 05 68 85 82 6D 3C 3E EE 17", &["count-mismatch"]),
        ("68 05 05 68 85 82 6D 3C 3E EF 16", &["check-failed"]),
        ("10 02 01 49 4C", &["truncated", "truncated"]),
        ("10 02 01 49 4C 16 00", &["frame-too-long", "unexpected-bytes", "check-failed", "count-mismatch"]),
        ("10 02 7F 49 CA 16", &["broadcast-source"]),
        ("10 82 01 49 CC 16", &["no-access-point"]),
        ("DC 03", &["truncated"]),
        ("E5 E5", &["unexpected-bytes"]),
        ("11 22 33", &["unknown-start"]),
        ("", &["truncated"]),
    ] {
        assert_eq!(codes(&frame(hex).1), expected, "{hex}");
    }
    let wire = bytes("10 02 01 49 4C 16");
    let mut other = Fdl::expect(&wire, Direction::Response, &Settings::default());
    assert_eq!(codes(&walk::read(&mut other, &wire).fields), ["other-direction"]);
}

#[test]
fn a_length_may_not_pass_its_limits() {
    for (data, right) in [(0, false), (1, true), (246, true), (247, false)] {
        let settings = Settings { layout: layout(false, data, 0), ..Settings::default() };
        let kind = Kind::of(None, Direction::Request);
        let written = walk::write(&mut Fdl::new(kind, &settings), &Deviations::default());
        let mut read = Fdl::expect(&written, Direction::Request, &settings);
        let found = codes(&walk::read(&mut read, &written).fields);
        assert_eq!(found, if right { &[][..] } else { &["out-of-range"] }, "{data}");
        assert_eq!(Fdl::length(&written).is_some(), right);
    }
}
