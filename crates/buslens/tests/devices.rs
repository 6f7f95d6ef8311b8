//! What holds for every device's table: that it is whole, and that it has something to say about any
//! registers, parameters and process data, whatever their bytes.

use std::collections::BTreeSet;

use buslens::device::{
    Access, Area, Content, Entry, Mapping, PROFILES, Process, ProcessWord, Profile, Registers, Said, Settings,
};
use buslens::field::{Bits, Name, Order, Span, Spec, Value, leaves};
use buslens::walk::guide::{Size, guide};
use proptest::prelude::*;

#[test]
fn profiles_are_told_apart() {
    let mut keys = BTreeSet::new();
    for profile in PROFILES {
        assert!(keys.insert(profile.key), "{} twice", profile.key);
        assert!(!profile.label.is_empty() && !profile.source.is_empty(), "{}", profile.key);
        assert!(profile.most_registers.is_none_or(|most| (1..=125).contains(&most)), "{}", profile.key);
    }
}

#[test]
fn areas_follow_each_other_without_overlap() {
    for profile in PROFILES {
        let mut free = 0;
        for area in profile.areas {
            let key = area.spec.key;
            assert!(area.stride > 0 && area.count > 0, "{key}");
            assert!(u32::from(area.from) >= free, "{key} overlaps the one before");
            free = u32::from(area.from) + u32::from(area.stride) * u32::from(area.count);
            assert!(free <= 0x1_0000, "{key} goes past FFFFh");
            assert_eq!(u32::from(area.last()) + 1, free, "{key}");
            assert_eq!(area.first.is_some(), area.count > 1, "{key}");
            match area.content {
                Content::Value => assert!([1, 2, 4].contains(&area.stride), "{key}"),
                Content::Parts(parts) => {
                    let registers = parts.iter().map(|part| part.registers).sum::<u16>();
                    assert_eq!(registers, area.stride, "{key}");
                }
                Content::Telegram { read, write } => {
                    assert_eq!(read.is_some(), area.access != Access::Write, "{key}");
                    assert_eq!(write.is_some(), area.access != Access::Read, "{key}");
                }
                Content::Mapped => assert_eq!(area.stride, 1, "{key}"),
            }
        }
    }
}

#[test]
fn parameters_lie_in_an_area_and_are_told_apart() {
    for profile in PROFILES {
        for (index, one) in profile.parameters().enumerate() {
            let name = one.spec.label;
            assert!(profile.area(one.address).is_some(), "{name}");
            assert!(one.length.is_none_or(|length| [1, 2, 4].contains(&length)), "{name}");
            for other in profile.parameters().take(index) {
                let apart = one.address != other.address
                    || one.subindex.is_some() && other.subindex.is_some() && one.subindex != other.subindex;
                assert!(apart, "{name} and {} share {:04X}h", other.spec.label, one.address);
                assert!(one.id.is_empty() || one.id != other.id, "{} twice", one.id);
            }
        }
    }
}

#[test]
fn lessons_lie_in_an_area() {
    for profile in PROFILES {
        for lesson in profile.lessons {
            let last = lesson.from.checked_add(lesson.count - 1).expect("an address");
            let [from, to] = [lesson.from, last].map(|address| profile.area(address).expect("an area"));
            assert!(std::ptr::eq(from, to), "{:04X}h", lesson.from);
        }
    }
}

/// Areas can share a spec: they are the same thing at two places.
#[test]
fn keys_are_stable_words_of_their_own() {
    for profile in PROFILES {
        let areas = profile.areas.iter().map(|area| &area.spec);
        let specs: Vec<&Spec> = areas.chain(profile.parameters().map(|parameter| &parameter.spec)).collect();
        for (index, spec) in specs.iter().enumerate() {
            assert_snake_case(spec.key);
            let twice = specs[..index].iter().any(|other| other.key == spec.key && other != spec);
            assert!(!twice, "{}: {} twice", profile.key, spec.key);
        }
    }
}

#[test]
fn everything_has_words_for_a_person() {
    for profile in PROFILES {
        let areas = profile.areas.iter().map(|area| (&area.spec, width(area)));
        let parameters = profile.parameters().map(|parameter| (&parameter.spec, parameter.length));
        for (spec, width) in areas.chain(parameters) {
            assert!(!spec.note.is_empty(), "{} has no note", spec.label);
            assert_words(spec, width.unwrap_or(8));
        }
        for area in profile.areas {
            match area.content {
                Content::Parts(parts) => {
                    parts.iter().for_each(|part| assert_words(part.spec, 2 * usize::from(part.registers)));
                }
                Content::Telegram { read, write } => {
                    for new in read.into_iter().chain(write) {
                        for row in guide(new(&Settings::default()).as_mut()) {
                            let width = match row.size {
                                Size::Fixed(width) => width,
                                _ => 8,
                            };
                            assert_words(row.spec, width);
                            row.chosen.iter().for_each(|(_, chosen)| assert_words(chosen, 8));
                        }
                    }
                }
                Content::Value | Content::Mapped => {}
            }
        }
    }
}

/// Bytes of an area's value, where its spec is about one.
fn width(area: &Area) -> Option<usize> {
    area.length.or(matches!(area.content, Content::Value).then_some(2 * usize::from(area.stride)))
}

/// Panics unless `spec`, of a number of `width` bytes, has words for all that it can say.
fn assert_words(spec: &Spec, width: usize) {
    assert_snake_case(spec.key);
    assert!(!spec.label.is_empty() && !spec.short.is_empty(), "{}", spec.key);
    assert!(spec.note.len() + spec.source.len() > 20, "{} is not explained", spec.key);
    assert_names(spec.key, spec.names);
    let mut free = 0;
    let mut keys = BTreeSet::new();
    for part in spec.bits {
        let Bits { key, label, from, count, names, reserved, .. } = part;
        assert_snake_case(key);
        assert!(*reserved || keys.insert(*key), "{}: {key} twice", spec.key);
        assert!(!label.is_empty() && *count > 0, "{}: {key}", spec.key);
        assert!(*from >= free, "{}: {key} overlaps the part before", spec.key);
        free = from + count;
        assert_names(key, names);
    }
    assert!(free as usize <= 8 * width, "{}: its bits do not fit into {width} bytes", spec.key);
}

fn assert_names(key: &str, names: &[Name]) {
    let mut values = BTreeSet::new();
    let mut labels = BTreeSet::new();
    for name in names {
        assert!(values.insert(name.value), "{key}: {} twice", name.value);
        // What goes without saying has no label, but is explained.
        let told = !name.label.is_empty() || !name.note.is_empty();
        assert!(told && labels.insert(name.label), "{key}: “{}”", name.label);
    }
}

fn assert_snake_case(key: &str) {
    let word = |word: &str| word.bytes().all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit());
    let words = key.split('_').all(|part| !part.is_empty() && word(part));
    assert!(words && key.starts_with(|first: char| first.is_ascii_lowercase()), "{key}");
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(1000) })]

    #[test]
    fn any_registers_are_covered(
        profile in profile(),
        settings in settings(),
        start in address(),
        count in prop_oneof![0..12_usize, 0..200_usize],
        width in prop_oneof![Just(2_usize), Just(4)],
        access in access(),
        bytes in proptest::option::of(proptest::collection::vec(any::<u8>(), 0..800)),
        whole: bool,
        single: bool,
    ) {
        // Mostly as many bytes as there should be.
        let bytes = bytes.map(|mut bytes| {
            if whole {
                bytes.resize(count * width, 0x5A);
            }
            bytes
        });
        let span = Span::new(OFFSET, OFFSET + bytes.as_ref().map_or(2, Vec::len));
        let registers = Registers { start, count, width, access, single, values: bytes.as_deref(), span };
        let said = profile.registers(&registers, &settings);
        let mut next = u32::from(start);
        for block in &said.blocks {
            prop_assert_eq!(u32::from(block.from), next);
            prop_assert!(block.from <= block.to);
            next = u32::from(block.to) + 1;
        }
        let there = count.min(0x1_0000 - usize::from(start));
        prop_assert_eq!(next, u32::from(start) + there as u32);
        if let Some(bytes) = &bytes {
            prop_assert_eq!(tiled(&said), OFFSET + bytes.len().min(there * width));
        }
        read_all(&said);
    }

    #[test]
    fn any_parameter_is_told(
        profile in profile(),
        index in address(),
        subindex: u8,
        access in access(),
        value in proptest::option::of((proptest::collection::vec(any::<u8>(), 0..12), order())),
    ) {
        let length = value.as_ref().map_or(2, |(bytes, _)| bytes.len());
        let span = Span::new(OFFSET, OFFSET + length);
        let given = value.as_ref().map(|(bytes, order)| (bytes.as_slice(), *order));
        let said = profile.parameter(index, subindex, access, given, span);
        prop_assert_eq!(said.blocks.len(), 1);
        prop_assert_eq!((said.blocks[0].from, said.blocks[0].to), (index, index));
        if length <= 8 {
            prop_assert_eq!(tiled(&said), OFFSET + length);
        }
        read_all(&said);
    }

    #[test]
    fn any_process_data_is_told(
        profile in profile(),
        settings in settings(),
        output: bool,
        order in order(),
        bytes in proptest::collection::vec(any::<u8>(), 0..40),
    ) {
        let span = Span::new(OFFSET, OFFSET + bytes.len());
        let process = Process { output, bytes: &bytes, span, order };
        let said = profile.process(&process, &settings);
        // Half a word is left out.
        prop_assert_eq!(tiled(&said), OFFSET + bytes.len() / 2 * 2);
        read_all(&said);
    }

    #[test]
    fn anything_can_be_learned(
        profile in profile(),
        mut settings in settings(),
        written in proptest::collection::vec((address(), any::<u8>(), any::<u32>(), 1..=4_usize, any::<bool>()), 0..20),
    ) {
        for (address, subindex, value, width, written) in written {
            let before = settings.clone();
            let changed = profile.learn(address, subindex, value, width, written, &mut settings);
            prop_assert_eq!(changed, settings != before);
            prop_assert!(!profile.learn(address, subindex, value, width, written, &mut settings));
        }
    }
}

/// Every part of a description of process data is learned, and none of words that there are not.
#[test]
fn eight_words_of_process_data_are_learned() {
    let profile = Profile::of("keb-f5-profibus").unwrap();
    for lesson in profile.lessons.iter().filter(|lesson| lesson.count == 1 && !lesson.read) {
        let mut settings = Settings::default();
        for subindex in 0..=u8::MAX {
            profile.learn(lesson.from, subindex, 0x2000 + u32::from(subindex), 4, true, &mut settings);
        }
        for words in [&settings.process_output, &settings.process_input] {
            assert!(words.len() <= 8, "{:04X}h: {words:?}", lesson.from);
            let taught = words.len() == 8;
            for (word, n) in words.iter().zip(0_u8..).filter(|_| taught) {
                assert_eq!(word.index, 0x2002 + u16::from(4 * n), "{:04X}h", lesson.from);
                assert_eq!(word.sets, 4 * n + 3, "{:04X}h", lesson.from);
            }
        }
    }
}

/// A number may come in more bytes than it has, where those say nothing but its sign.
#[test]
fn wider_values_are_those_that_fit() {
    let profile = Profile::of("keb-f5-profibus").unwrap();
    let said = |address: u16, bytes: [u8; 4]| {
        let span = Span::new(0, 4);
        let said = profile.parameter(address, 1, Access::Read, Some((&bytes, Order::Big)), span);
        let block = &said.blocks[0];
        let codes: Vec<&str> = block.field.problems.iter().map(|problem| problem.code).collect();
        (block.value().map(|value| value.to_string()), codes)
    };
    let signed = profile
        .parameters()
        .find(|it| it.length == Some(2) && it.spec.format == buslens::field::Format::Signed);
    let address = signed.expect("a signed parameter of 16 bits").address;
    assert_eq!(said(address, [0, 0, 0x05, 0xDC]).1, [""; 0]);
    assert_eq!(said(address, [0xFF, 0xFF, 0xFA, 0x24]).1, [""; 0]);
    assert_ne!(said(address, [0xFF, 0xFF, 0xFA, 0x24]).0, said(address, [0, 0, 0x05, 0xDC]).0);
    for long in [[0xFF, 0xFF, 0x05, 0xDC], [0, 1, 0x85, 0xDC], [0xFF, 0xFE, 0xFA, 0x24], [0x80, 0, 0, 0]] {
        assert_eq!(said(address, long).1, ["value-too-long"], "{long:02X?}");
    }
}

/// Where the values stand in the telegram.
const OFFSET: usize = 5;

/// Where the leaves of all blocks end, which must follow each other from [`OFFSET`] on.
fn tiled(said: &Said) -> usize {
    said.blocks.iter().fold(OFFSET, |mut position, block| {
        for leaf in leaves(std::slice::from_ref(&block.field)) {
            assert_eq!(leaf.span.from, position, "{}", leaf.spec.key);
            position = leaf.span.to;
            let filled = !leaf.span.is_empty() || leaf.value == Value::Group || leaf.value == Value::Bytes;
            assert!(filled || matches!(leaf.value, Value::Missing { .. } | Value::Text(_)), "{leaf:?}");
        }
        position
    })
}

/// All that a person is shown.
fn read_all(said: &Said) {
    let _ = said.sentence().map(|sentence| sentence.sentence());
    for block in &said.blocks {
        assert!(!block.label().to_string().is_empty() && !block.registers().is_empty());
        let _ = (block.value(), block.status(), &block.note);
    }
    for problem in said.problems() {
        assert!(!problem.message.to_string().is_empty());
    }
}

fn profile() -> impl Strategy<Value = &'static Profile> {
    proptest::sample::select(PROFILES)
}

/// Any address; mostly one near where an area begins or ends, or one that may be mapped.
fn address() -> impl Strategy<Value = u16> {
    let areas = PROFILES.iter().flat_map(|profile| profile.areas);
    let borders: Vec<u16> = areas.flat_map(|area| [area.from, area.last()]).collect();
    let near = (proptest::sample::select(borders), -12..12_i32)
        .prop_map(|(border, by)| (i32::from(border) + by).clamp(0, 0xFFFF) as u16);
    prop_oneof![3 => near, 1 => 0..48_u16, 1 => any::<u16>()]
}

fn access() -> impl Strategy<Value = Access> {
    prop_oneof![Just(Access::Read), Just(Access::Write)]
}

fn order() -> impl Strategy<Value = Order> {
    proptest::sample::select(&Order::ALL[..])
}

/// Devices set up in any way.
fn settings() -> impl Strategy<Value = Settings> {
    (mapping(), mapping(), words(), words()).prop_map(
        |(read_mapping, write_mapping, process_output, process_input)| Settings {
            read_mapping,
            write_mapping,
            process_output,
            process_input,
            ..Settings::default()
        },
    )
}

fn mapping() -> impl Strategy<Value = Mapping> {
    let entry = prop_oneof![
        any::<u32>(),
        Just(0),
        (any::<u16>(), any::<u8>(), 1..=2_u8).prop_map(|(address, sets, words)| u32::from_be_bytes([
            (address >> 8) as u8,
            address as u8,
            sets,
            words
        ])),
    ];
    // Mostly where registers are asked for.
    let start = prop_oneof![3 => 0..24_u16, 1 => address()];
    let used = proptest::option::weighted(0.3, 0..=100_usize);
    (start, proptest::collection::vec(entry.prop_map(Entry), 0..120), used)
        .prop_map(|(start, entries, used)| Mapping { start, entries, used })
}

fn words() -> impl Strategy<Value = Vec<ProcessWord>> {
    let word =
        (prop_oneof![address(), Just(0)], any::<u8>()).prop_map(|(index, sets)| ProcessWord { index, sets });
    proptest::collection::vec(word, 0..20)
}
