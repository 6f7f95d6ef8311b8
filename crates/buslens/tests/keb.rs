//! The tables of the KEB COMBIVERT F5: that they are whole, and what they make of single values.

use buslens::device::keb_f5::{STANDARD_INPUT, STANDARD_OUTPUT};
use buslens::device::{Access, Area, Content, PROFILES, Parameter, Profile};
use buslens::field::{Field, Span, Spec, Value};

#[test]
fn areas_are_those_of_the_manuals() {
    let ranges =
        |key| -> Vec<(u16, u16)> { profile(key).areas.iter().map(|area| (area.from, area.last())).collect() };
    let mapping = [(0x5F32, 0x5F95), (0x5F96, 0x5FF9)];
    let modbus = ranges(MODBUS);
    assert_eq!(modbus[..3], [(0, 0x1FFF), (0x2000, 0x5EFF), (0x5F00, 0x5F31)]);
    assert_eq!(modbus[3..], [mapping[0], mapping[1], (0x5FFA, 0x5FFF)]);
    assert_eq!(ranges(PROFIBUS), [(0x2000, 0x5EFF), (0x5F00, 0x5FFF), (0x6000, 0xFFFF)]);
    assert!(matches!(area(MODBUS, 0x1000).content, Content::Mapped));
}

#[test]
fn every_row_of_the_manuals_is_there() {
    let own = |profile: &'static Profile| -> Vec<&'static str> {
        let reached = profile.parameters().skip(INVERTER_PARAMETERS);
        reached.filter(|it| it.access != Access::Elsewhere).map(|parameter| parameter.id).collect()
    };
    let modbus: Vec<String> = (0..=8).map(|n| format!("FB.{n:02}")).collect();
    assert_eq!(own(profile(MODBUS)), modbus);

    let profibus = own(profile(PROFIBUS));
    for n in 0..72 {
        assert!(profibus.contains(&format!("Fb{n:02}").as_str()), "Fb{n:02}");
    }
    for n in [0, 1, 3, 4, 5, 6, 7, 8, 16, 17, 18, 19, 20, 21] {
        assert!(profibus.contains(&format!("OS{n:02}").as_str()), "OS{n:02}");
    }
    // 88 rows of 12.1, four of 9.1, and the zeros of sixteen words.
    assert_eq!(profibus.iter().filter(|id| !id.is_empty()).count(), 92);
    assert_eq!(profibus.iter().filter(|id| id.is_empty()).count(), 32);
}

#[test]
fn process_data_descriptions_are_whole() {
    for (index, first_index, last_set) in [(0x6000, "Fb01", "Fb51"), (0x6001, "Fb13", "Fb61")] {
        for subindex in 1..=33 {
            let part = parameter(PROFIBUS, index, Some(subindex));
            let word = (subindex + 2) / 4;
            let (length, limits) = match subindex % 4 {
                _ if subindex == 1 => (1, Some((0, 16))),
                2 => (2, None),
                3 => (1, None),
                0 => (2, Some((0, 0))),
                _ => (1, Some((0, 0))),
            };
            assert_eq!((part.length, part.spec.limits), (Some(length), limits), "{index:X}h/{subindex}");
            assert_eq!(part.since, if word > 4 { "1.6" } else { "" }, "{index:X}h/{subindex}");
            assert!(subindex == 1 || part.spec.label.contains(&format!("{word}_")), "{}", part.spec.label);
        }
        assert_eq!(parameter(PROFIBUS, index, Some(2)).id, first_index);
        assert_eq!(parameter(PROFIBUS, index, Some(31)).id, last_set);
    }
}

#[test]
fn standard_process_data_are_parameters() {
    let ids = |words: &[buslens::device::keb_f5::ProcessWord]| -> Vec<&'static str> {
        words.iter().map(|word| parameter(PROFIBUS, word.index, None).id).collect()
    };
    assert_eq!(ids(STANDARD_OUTPUT), ["Sy.50", "Sy.52"]);
    assert_eq!(ids(STANDARD_INPUT), ["Sy.51", "Sy.53"]);
}

#[test]
fn both_buses_have_the_inverter_parameters_at_the_same_place() {
    let [modbus, profibus] = [MODBUS, PROFIBUS].map(|key| profile(key).parameters[0]);
    for (one, other) in modbus.iter().zip(profibus) {
        assert_eq!((one.address, one.id, &one.spec), (other.address, other.id, &other.spec));
    }
    assert_eq!(parameter(MODBUS, 0x233B, None).id, "OP.59");
    assert_eq!(parameter(MODBUS, 0x2D00, None).id, "LE.00");
}

#[test]
fn values_are_explained() {
    for (key, address, subindex, raw, meaning) in [
        (MODBUS, 0x5F00, None, 0xC0, "8E1, RTU"),
        (MODBUS, 0x5F00, None, 0x20, "8O1, ASCII"),
        (MODBUS, 0x5F00, None, 0xE0, "character format 3, RTU"),
        (MODBUS, 0x5F01, None, 255, "taken from Sy.06"),
        (MODBUS, 0x5F06, None, 0x03, "any good telegram, any good telegram for this inverter"),
        (MODBUS, 0x5F31, None, 0x8001, "load the factory settings, done"),
        (MODBUS, 0x5F31, None, 0, "no command"),
        (MODBUS, 0x2007, None, 6, "55500 bit/s"),
        (PROFIBUS, 0x2185, Some(0), 4, "19200 bit/s"),
        (PROFIBUS, 0x2196, Some(0), 0x04, "cyclic"),
        (PROFIBUS, 0x2197, Some(0), 0x00C0, "service 54, service 55"),
        (PROFIBUS, 0x2198, Some(0), 0, "no cyclic mode"),
        (PROFIBUS, 0x5FD8, Some(0), 240, "unless all bytes are 0"),
        (PROFIBUS, 0x5FDA, Some(0), 0, "power on"),
        (PROFIBUS, 0x5FE2, Some(0), 0xFF, "stored"),
        (PROFIBUS, 0x5FF1, Some(0), 31011, "31.01., year ending in 1"),
        (PROFIBUS, 0x5FF5, Some(0), 0x81, "byte 9, byte 16"),
        (PROFIBUS, 0x5FF8, Some(0), 0x0F, "byte 1 to byte 4"),
        (PROFIBUS, 0x6000, Some(3), 0x01, "set 0"),
        (PROFIBUS, 0x6000, Some(18), 0, "goes on with the word before"),
        (PROFIBUS, 0x6001, Some(31), 0x80, "set 7"),
    ] {
        let parameter = parameter(key, address, subindex);
        let width = parameter.length.unwrap_or(2);
        let field = field(&parameter.spec, raw, width);
        assert_eq!(field.meaning().unwrap().to_string(), meaning, "{}", parameter.id);
    }
    let text =
        |address, raw, width| field(&parameter(PROFIBUS, address, Some(0)).spec, raw, width).value_text();
    assert_eq!(text(0x5FF0, 17, 2), "1.7");
    assert_eq!(text(0x5FFA, 25, 2), "25 ms");
    assert_eq!(text(0x2199, 2000, 4), "2000 µs");
}

#[test]
fn mapping_entries_are_explained() {
    for (register, label) in [(0x5F33, "Read-mapping entry 1"), (0x5F96, "Write-mapping entry 0")] {
        let area = area(MODBUS, register);
        let mut entry = field(&area.spec, 0x0033_0101, 4);
        let number = area.first.unwrap() + u64::from(register - area.from);
        entry.number = Some(buslens::field::Numbering::At(number));
        assert_eq!(entry.label().to_string(), label);
        assert_eq!(entry.meaning().unwrap().to_string(), "16 bit, set 0, parameter 0033h");
    }
    let entry = |raw| field(&area(MODBUS, 0x5F32).spec, raw, 4).meaning().unwrap().to_string();
    assert_eq!(entry(0x033B_8102), "32 bit, set 0, set 7, parameter 033Bh");
    assert_eq!(entry(0), "empty, or second half of a 32-bit entry");
}

#[test]
fn unexplained_access_is_said_to_be_so() {
    for (index, access) in [(0x2180, Access::Read), (0x2181, Access::Write)] {
        let parameter = parameter(PROFIBUS, index, Some(0));
        assert_eq!(parameter.access, access);
        assert!(parameter.spec.note.contains("WA"));
    }
}

#[test]
fn display_texts_are_explained_once() {
    let display = profile(PROFIBUS).display;
    assert_eq!(display.len(), 29);
    for (index, shown) in display.iter().enumerate() {
        assert!(!shown.meaning.is_empty(), "{}", shown.text);
        assert!(display[..index].iter().all(|other| other.text != shown.text), "{} twice", shown.text);
    }
}

fn profile(key: &str) -> &'static Profile {
    PROFILES.iter().find(|profile| profile.key == key).unwrap()
}

fn area(key: &str, address: u16) -> &'static Area {
    profile(key).areas.iter().find(|area| (area.from..=area.last()).contains(&address)).unwrap()
}

fn parameter(key: &str, address: u16, subindex: Option<u8>) -> &'static Parameter {
    let wanted = |parameter: &&Parameter| (parameter.address, parameter.subindex) == (address, subindex);
    profile(key).parameters().find(wanted).unwrap()
}

fn field(spec: &'static Spec, raw: u64, width: usize) -> Field {
    Field::new(spec, Span::new(0, width), Value::Number { raw, width })
}

const MODBUS: &str = "keb-f5-modbus";
const PROFIBUS: &str = "keb-f5-profibus";

/// How many of the inverter's own parameters head each table.
const INVERTER_PARAMETERS: usize = 10;
