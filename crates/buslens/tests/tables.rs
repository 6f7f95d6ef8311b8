//! What the codecs and the reader say of many small things, a line each, in `tests/tables`: a change that nobody meant shows
//! there. `BLESS=1 cargo test --test tables` writes the tables; read what changed before you commit it.

#[path = "tables/damage.rs"]
mod damage;
#[path = "tables/evidence.rs"]
mod evidence;
#[path = "tables/found.rs"]
mod found;
#[path = "tables/long_logs.rs"]
mod long_logs;
#[path = "tables/pieces.rs"]
mod pieces;
#[path = "tables/protocols.rs"]
mod protocols;
#[path = "tables/texts.rs"]
mod texts;
#[path = "tables/traffic.rs"]
mod traffic;

use std::fmt::Write as _;
use std::path::Path;

use buslens::field::{Direction, Message, hex};
use buslens::frame::Settings;
use buslens::modbus::{Body, DIALECTS, KINDS, OTHER_KINDS};
use buslens::profibus;
use buslens::tool::{
    Certainty, Content, Editor, Offer, Options, PROFILES, PROTOCOLS, Profile, Protocol, blocks, decode,
};
use buslens::walk::form::Entry;
use buslens::walk::{self, Telegram};

/// Compares a table with its file.
fn assert_table(name: &str, found: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/tables").join(name).with_extension("txt");
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(&path, found).unwrap();
    }
    let expected = std::fs::read_to_string(&path).unwrap_or_default();
    let (mut expected, mut found) = (expected.lines(), found.lines());
    loop {
        let (one, other) = (expected.next(), found.next());
        assert_eq!(one, other, "in {}", path.display());
        if one.is_none() {
            break;
        }
    }
}

fn bytes(text: &str) -> Vec<u8> {
    text.split_whitespace().map(|byte| u8::from_str_radix(byte, 16).expect(byte)).collect()
}

/// The forms of all that can be asked of a device: their entries as they begin, and the bytes of that.
#[test]
fn forms() {
    let mut table = String::new();
    let settings = buslens::tool::Settings::default();
    for profile in PROFILES {
        writeln!(table, "# {}", profile.key).unwrap();
        for task in profile.tasks() {
            let protocols = PROTOCOLS.iter();
            let mut editors =
                protocols.filter_map(|protocol| Editor::new(Offer::Task(task), 1, protocol, &settings).ok());
            let mut editor = editors.next().expect("some protocol carries it");
            let mut entries = Vec::new();
            editor.entries().form.visit(&mut |entry| entries.push(shown(entry)));
            let made = editor.bytes().map_or_else(|why| why.to_string(), |bytes| hex(&bytes));
            writeln!(table, "{}: {}: {made}", task.label().sentence(), entries.join(", ")).unwrap();
        }
    }
    assert_table("forms", &table);
}

fn shown(entry: &Entry) -> String {
    let text = match &entry.content {
        Content::Number { text, .. }
        | Content::Computed { text, .. }
        | Content::Bytes { text }
        | Content::Text { text }
        | Content::Extra { text }
        | Content::Cut { text } => text.clone(),
        Content::Choice { raw, .. } => raw.to_string(),
        Content::List { items } => format!("[{}]", items.len()),
        Content::Group { .. } => "…".to_owned(),
    };
    format!("{}={text}", entry.path)
}

/// Bytes without a frame, as each device reads them, with what speaks for it.
#[test]
fn without_a_frame() {
    let mut table = String::new();
    for text in [
        "00 80",
        "00 80 00 80 00 41",
        "00 80 42 A4 F1 DE",
        "00 80 42 A4 F1 DE 00 40 40 F0 00 00",
        "00 80 00 00 00 00",
        "00 80 7F C0 00 00",
        "00 80 FF 80 00 00",
        "00 80 00 00 00 01",
        "02 80 40 F0 00 00",
        "0F 80 40 F0 00 00",
        "00 05 40 F0 00 00",
        "33 33 33 33 33 33",
        "00 80 40 54 9E 3B C0 00 00 00",
        "00 80 00 00 00 00 00 00 00 00",
        "00 80 7F F8 00 00 00 00 00 00",
        "42 F6 E9 79",
        "42 F6 00 00",
        "3F 80 00 00",
        "00 00 00 00",
        "42 F6 E9 79 3F C0 00 00",
        "40 5E DD 2F 1A 9F BE 77",
        "7F F0 00 00 00 00 00 00",
        "00 00 00 00 00 00 00 00",
        "01 10 C9 74 23 F0 00 00 00 00 00 04 42 F6 E6 66",
        "00 33 01 01",
        "00 33 01 01 00 35 01 01",
        "03 3B 01 02 00 00 00 00",
        "00 03 05 DC",
        "00 03 FA 24 12",
        "41 00 23 00 00 00 00 00",
        "C2 00 23 00 08 00 00 30",
        "71 00 22 00 00 00 00 46",
        "41 00 23 00 00 00 00 00 00 03 05 DC",
        "88 01 0A 0B 05 EB 00",
        "88 01 0A 0B 05 EC 00",
        "B7 A3 93",
        "B7 A3",
        "C0 01 01",
        "C0 01",
        "40 01",
        "C1 01 01 07",
        "F5 13",
        "00 0C 00 02 05 EB",
        "42 05 00 FF 05 EB",
        "00 00",
        "02 00",
        "11",
    ] {
        for device in [None].into_iter().chain(PROFILES.iter().copied().map(Some)) {
            let key = device.map_or("any", |device| device.key);
            for reading in blocks(&bytes(text), device, &buslens::tool::Settings::default()) {
                let sure = if reading.certainty == Certainty::Likely { "likely" } else { "open" };
                let said = [&reading.kind, &reading.said, &reading.reason, &reading.unknown];
                let said: Vec<String> = said.map(Message::to_string).into();
                writeln!(table, "{text} | {key} | {} bits, {sure} | {}", reading.bits, said.join(" | "))
                    .unwrap();
            }
        }
    }
    assert_table("blocks", &table);
}

/// How well bytes fit each protocol, what its check says, and where the first telegram in them ends.
#[test]
fn fits() {
    let mut table = String::new();
    for text in [
        "01",
        "E5",
        "01 03",
        "01 03 00 C8 00 03 84 35",
        "01 03 00 C8 00 03 84 35 01 03 00 C8 00 03 84 35",
        "01 03 00 C8 00 03 84 35 11 03 00",
        "01 03 00 C8 00 03 84 35 11 03 00 FF",
        "01 03 00 C8 00 03 84 36",
        "00 03 00 C8 00 03 85 E4",
        "01 03 06 00 08 42 A4 F1 DE B0 F8",
        "01 83 02 C0 F1",
        "01 83 02 C0 F2",
        "11 07 4C 22",
        "01 2B 0E 01 00 70 77",
        "FF 2B 0E 01",
        "02 03 00 C8 00 05 2E",
        "02 03 00 C8 00 05 2F",
        "00 01 00 00 00 06 01 03 00 C8 00 03",
        "00 01 00 00 00 06 01 03 00 C8 00 03 00 02 00 00 00 06 01 03 00 C8 00 03",
        "00 01 00 00 00 06 01 03 00 C8 00",
        "00 01 00 00 00 07 01 03 00 C8 00 03",
        "00 01 00 01 00 06 01 03 00 C8 00 03",
        "00 01 00 00 00 08 01 03 00 C8 00 03 84 35",
        "00 01 00 00 00 06 01 63 00 C8 00 03",
        "00 01 00 00 00 02 01 07",
        "00 01 00 00 00 03 01 83 02",
        "00 00 00 00 00 02 01 00",
        "00 00 00 00 01 00 01 03",
        "03 00 C8 00 03",
        "83 02",
        "41 00 22 00 00 00 00 00",
        "71 00 22 00 00 00 00 46",
        "41 00 22 00 00 00 00 00 04 00 05 DC",
        "10 01 02 49 4C 16",
        "10 01 02 49 4D 16",
        "10 81 82 49 4C 16",
        "DC 01 02",
        "A2 01 02 49 00 00 00 00 00 00 00 00 4C 16",
        "68 05 05 68 81 82 5D 3B 3E D9 16",
        "68 05 05 68 81 82 5D 3B 3E DA 16",
        "68 05 06 68 81 82 5D 3B 3E D9 16",
        "68 05 05 68 81 82 5D 3B 3E D9 16 E5",
        "68 0C 0C 68 81 82 5D 3D 3E 88 01 0A 0B 05 EB 00 69 16",
        "68 0F 0F 68 01 02 5D 52 01 20 34 00 64 00 00 00 05 01 2C 9D 16",
        "68 07 07 68 FF 82 46 3A 3E 20 01 60 16",
        "88 01 0A 0B 05 EB 00",
        "B7 A3 93",
        "00 0C 00 02 05 EB",
        "00 00 00 00",
        "FF FF FF FF",
    ] {
        let bytes = bytes(text);
        for protocol in PROTOCOLS {
            let fit = (protocol.fit)(&bytes, &Settings::default());
            let exchange = (protocol.exchange)(&bytes).map_or("-".to_owned(), |key| format!("{key:X}"));
            writeln!(
                table,
                "{text} | {} | {} bits: {} | {:?} | first {} | unit {:?} | exchange {exchange}",
                protocol.key,
                fit.bits,
                fit.reason,
                (protocol.verdict)(&bytes),
                (protocol.first)(&bytes),
                (protocol.unit)(&bytes),
            )
            .unwrap();
        }
    }
    assert_table("fits", &table);
}

/// What each telegram is about, and whether it changes anything.
#[test]
fn bodies() {
    let mut table = String::new();
    for kind in KINDS.iter().chain(OTHER_KINDS) {
        let body = (kind.new)();
        // What a response is for, nobody asks.
        let said =
            if kind.direction == Direction::Request { about(body.as_ref()) } else { access(body.as_ref()) };
        writeln!(table, "{}: {said}, exception {:?}", kind.spec.key, body.exception()).unwrap();
    }
    for number in [0, 1, 2, 3, 4, 5, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21] {
        let kind = KINDS.iter().find(|kind| kind.function == 8).unwrap();
        let mut pdu = kind.pdu(DIALECTS[0]);
        walk::read(&mut pdu, &[8, 0, number, 0, 0]);
        writeln!(table, "diagnostics {number}: {}", about(pdu.body.as_ref())).unwrap();
    }
    for text in ["2B 0E 01 00", "2B 0D 00", "2B 01", "2B"] {
        let kind = KINDS.iter().find(|kind| kind.function == 43).unwrap();
        let mut pdu = kind.pdu(DIALECTS[0]);
        walk::read(&mut pdu, &bytes(text));
        writeln!(table, "{text}: {}", about(pdu.body.as_ref())).unwrap();
    }
    for kind in profibus::KINDS.iter().chain(profibus::OTHER_KINDS) {
        let mut body = (kind.new)(&profibus::Settings::default());
        for text in [
            "00 00 00 00 00 00",
            "FF 00 00 00 00 00",
            "00 FF 00 00 00 00",
            "04 00 00",
            "00 01 00",
            "01 02 03",
        ] {
            let telegram: &mut dyn Telegram = body.as_mut();
            walk::read(telegram, &bytes(text));
            writeln!(table, "{} {text}: {:?}", kind.spec.key, body.diagnosis()).unwrap();
        }
    }
    assert_table("bodies", &table);
}

fn about(body: &dyn Body) -> String {
    format!("{}, {}", access(body), if body.only_reads() { "only reads" } else { "may change something" })
}

fn access(body: &dyn Body) -> String {
    body.access().map_or("nothing".to_owned(), |access| {
        let verb = if access.write { "writes" } else { "reads" };
        format!("{verb} {:?} of {} from {:?}", access.count, access.values.len(), access.start)
    })
}

/// Telegrams at the edges of what they can say: the sentence, and the problems.
#[test]
fn sentences() {
    let mut table = String::new();
    let long = |head: &str, count: usize, part: &str| format!("{head}{}", format!(" {part}").repeat(count));
    let mut texts: Vec<(&str, String)> = Vec::new();
    for coils in [
        "01 00",
        "01 01 01",
        "01 01 00",
        "01 01 03",
        "01 01 06",
        "01 01 2E",
        "01 02 55 55",
        "01 02 FF 0F",
        "01 02 FF",
    ] {
        for quantity in ["00 01", "00 02", "00 03", "00 06", "00 0C"] {
            texts.push(("modbus-pdu", format!("01 00 14 {quantity}\n{coils}")));
        }
        texts.push(("modbus-pdu", coils.to_owned()));
    }
    for length in [241, 243, 245, 247] {
        texts.push(("modbus-pdu", long(&format!("14 {:02X} {length:02X} 06", length + 1), length - 1, "00")));
    }
    for cut in [
        "B7 A3 93",
        "C0 01 01",
        "C0 01",
        "80 01",
        "40 01",
        "C1 01 01 07",
        "C1 01 01",
        "C1 01",
        "C3 01 01 07 08",
        "00",
        "F5 13 E5 D3",
    ] {
        texts.push(("profibus-chk-cfg", cut.to_owned()));
    }
    for (protocol, text) in texts {
        let protocol = Some(Protocol::of(protocol).expect(protocol));
        for device in [None, Profile::of("keb-f5-profibus")] {
            let report = decode(&text, Options { protocol, device, ..Options::default() });
            for index in 0..report.telegrams.len() {
                let detail = report.detail(index).unwrap();
                let problems: Vec<&str> = detail.problems().iter().map(|problem| problem.code).collect();
                let shown = text.replace('\n', " / ");
                let shown: String = shown.chars().take(48).collect();
                let key = device.map_or("-", |device| device.key);
                writeln!(table, "{shown} | {key} | {} | {}", detail.said.sentence(), problems.join(", "))
                    .unwrap();
            }
        }
    }
    assert_table("sentences", &table);
}

/// Who is meant by a name: first and last address.
#[test]
fn addresses() {
    let mut table = String::new();
    for profile in PROFILES {
        for name in [
            "universal channel",
            "Universal channel 6",
            "universal channel 40",
            "universal channel 41",
            "universal channel 0",
            "limit 3",
            "limit 0",
            "relay 1",
            "batch",
            "mapping",
            "Sy.51",
            "sy.5",
            "speed",
            "status",
            "digital 4",
            "parameter",
            "nothing",
            "1",
        ] {
            let found: Vec<String> =
                profile.addresses(name).iter().map(|(from, to)| format!("{from}-{to}")).collect();
            writeln!(table, "{} | {name} | {}", profile.key, found.join(", ")).unwrap();
        }
        // What a display shows in place of an X is a digit.
        for text in [
            "Error", "ERROR", "o Flo", "E.bcc", "E_Bc", "E xx", "E 1A", "E 1-", "E 1", "E 123", "EEEP3",
            "eeepr", "EEEP", "EEEP33", "F 12", "x",
        ] {
            let shown = profile.shown(text).map_or("nothing", |it| it.text);
            writeln!(table, "{} | display {text} | {shown}", profile.key).unwrap();
        }
    }
    assert_table("addresses", &table);
}

/// Which way a telegram goes is known of each kind.
#[test]
fn directions() {
    assert!(
        KINDS
            .chunks(2)
            .all(|pair| (pair[0].direction, pair[1].direction) == (Direction::Request, Direction::Response))
    );
}
