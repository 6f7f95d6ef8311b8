//! What once broke, each with its smallest input: no panic, no hang, nothing lost, nothing untrue.

use buslens::field::Direction;
use buslens::tool::link::{Link, keep_settings, kept_settings};
use buslens::tool::{Change, Editor, Entries, Options, PROFILES, PROTOCOLS, Settings, decode, settings};
use buslens::walk::Deviations;

const REQUEST: [u8; 8] = [0x01, 0x03, 0x00, 0xC8, 0x00, 0x03, 0x84, 0x35];

mod settings_files {
    use super::*;

    /// The number of entries is a byte: 256 of them were taken, and came back as none.
    #[test]
    fn a_list_takes_no_more_than_its_count_can_say() {
        let mut subject = Settings::default();
        let mut entries = settings::entries(&mut subject);
        entries.edit(&mut subject, "read_mapping.entries", Change::Enter("255"));
        assert_eq!(subject.device.read_mapping.entries.len(), 255);
        entries.edit(&mut subject, "read_mapping.entries", Change::Enter("256"));
        entries.edit(&mut subject, "read_mapping.entries", Change::Add);
        assert_eq!(subject.device.read_mapping.entries.len(), 255);
        assert!(entries.misfits.is_empty());
        let again = kept_settings(&keep_settings(&subject));
        assert_eq!(again.device, subject.device);
        let error = settings::read("read_mapping.entries = 256\noutputs = 2\ninputs = 8").unwrap_err();
        assert!(error.to_string().contains("read_mapping.entries"), "{error}");
    }

    #[test]
    fn what_is_no_settings_file_is_refused() {
        for text in ["", " \n\r\n", "\u{FEFF}", "\u{FEFF}\n"] {
            let error = settings::read(text).unwrap_err();
            assert!(error.sentence().contains("empty"), "{error}");
        }
        for text in ["\0\0\0", "inputs 8", "colour = 1", "inputs = eight", "= 1"] {
            settings::read(text).unwrap_err();
        }
        // Comments alone are a file of settings as delivered, and so is what `write` gives for them.
        settings::read("# as delivered").unwrap();
        settings::read(&settings::write(&Settings::default())).unwrap();
        let read = settings::read("\u{FEFF}inputs = 8\r\noutputs = 2\r\n").unwrap();
        assert_eq!((read.frame.profibus.layout.inputs, read.frame.profibus.layout.outputs), (8, 2));
    }
}

mod forms {
    use super::*;

    #[test]
    fn an_override_beside_an_entry_that_does_not_fit_is_taken() {
        let mut editor = Editor::of(&REQUEST, PROTOCOLS[0], Direction::Request, &Settings::default());
        editor.edit("start", Change::Enter("seven"));
        editor.edit("crc", Change::Enter("00 00"));
        assert_eq!(editor.bytes().unwrap(), [0x01, 0x03, 0x00, 0xC8, 0x00, 0x03, 0, 0]);
        // One that does not fit itself leaves what it was.
        editor.edit("crc", Change::Enter("zero"));
        assert_eq!(editor.bytes().unwrap()[6..], [0, 0]);
        assert_eq!(editor.entries().misfits.len(), 2);
    }

    /// A count that its byte cannot say is said; it was cut to its low byte without a word.
    #[test]
    fn a_count_that_its_byte_cannot_say_is_told() {
        let write = [0x01, 0x10, 0x00, 0x00, 0x00, 0x01, 0x02, 0x00, 0x07, 0, 0];
        let mut editor = Editor::of(&write, PROTOCOLS[0], Direction::Request, &Settings::default());
        editor.edit("crc", Change::Enter(""));
        editor.edit("values", Change::Enter("127"));
        assert_eq!(editor.bytes().unwrap().len(), 9 + 254);
        editor.edit("values", Change::Enter("128"));
        editor.edit("values", Change::Add);
        assert_eq!(editor.bytes().unwrap().len(), 9 + 254, "its byte count cannot say 256");
        editor.edit("byte_count", Change::Enter("0"));
        editor.edit("values", Change::Enter("128"));
        assert_eq!(editor.bytes().unwrap().len(), 9 + 256, "whoever overrides it may have more");
    }

    /// Over at once: a walk for each entry would take minutes.
    #[test]
    fn a_link_with_many_entries_is_followed() {
        let known = (0..100_000).map(|at| (format!("values.{}.value", at % 120), at.to_string()));
        let unknown = (0..100_000).map(|at| (format!("values.{at}.worth"), at.to_string()));
        let write = format!("01 10 00 00 00 78 F0 {} 00 00", "00 07 ".repeat(120));
        let options = Options { protocol: Some(PROTOCOLS[0]), ..Options::default() };
        let link = Link { entries: known.chain(unknown).collect(), ..Link::to(write, options) };
        let mut editor = Editor::follow(&link).unwrap();
        assert_eq!(editor.entries().misfits.len(), 120, "99,880 and more are no 16-bit numbers");
        assert_eq!(editor.bytes().unwrap()[7..9], [0, 7]);
    }

    /// Entries are typed one by one, or all at once as from a link: the same comes of it.
    #[test]
    fn entries_are_entered_at_once_as_one_by_one() {
        let texts = [
            ("profibus", "swap process data"),
            ("read_mapping.entries", "2"),
            ("read_mapping.entries.1.entry", "00330101h"),
            ("read_mapping.entries.0.entry", "no"),
            ("inputs", "1"),
            ("inputs", "8"),
        ];
        let mut one = Settings::default();
        let mut by_one = settings::entries(&mut one);
        texts.iter().for_each(|(path, text)| by_one.edit(&mut one, path, Change::Enter(text)));
        let mut all = Settings::default();
        let mut at_once = settings::entries(&mut all);
        assert!(at_once.enter_all(&mut all, &texts).is_empty());
        assert_eq!(at_once.form, by_one.form);
        assert_eq!(at_once.misfits, by_one.misfits);
        assert_eq!(one.device, all.device);
        let refused = at_once.enter_all(&mut all, &[("nothing", "1"), ("inputs", "9")]);
        assert_eq!((refused.len(), all.frame.profibus.layout.inputs), (1, 9));
        let fresh = Entries::of(&mut Settings::default(), Deviations::default());
        assert_eq!(fresh.changed(&fresh), []);
    }
}

mod protocols {
    use super::*;

    /// Its bytes look like the characters of Modbus ASCII; what is set by hand counts more.
    #[test]
    fn what_is_set_by_hand_counts_more_than_what_bytes_look_like() {
        let text = "3A 30 30 30 30 30 30";
        let by_itself = decode(text, Options::default());
        assert_eq!(by_itself.telegrams[0].line.bytes.len(), 3);
        for protocol in PROTOCOLS {
            let by_hand = decode(text, Options { protocol: Some(protocol), ..Options::default() });
            let bytes: usize = by_hand.telegrams.iter().map(|telegram| telegram.line.bytes.len()).sum();
            assert_eq!(bytes, if protocol.key == "modbus-ascii" { 3 } else { 7 }, "{}", protocol.key);
        }
    }
}

/// Captures of many connections, far times, strange ends.
#[cfg(feature = "captures")]
mod captures {
    use super::*;
    use buslens::tool::log::{Filter, Log, Reading};

    /// A packet of Ethernet, IPv4 and TCP from the client `n`, or to it, that has this sequence number.
    fn packet(n: u32, sequence: u8, payload: &[u8]) -> Vec<u8> {
        let client = (0x0A00_0000 | n >> 12).to_be_bytes();
        let port = (0x8000 | (n & 0xFFF)) as u16;
        let length = (40 + payload.len()) as u16;
        [
            &[2, 0, 0, 0, 0, 1, 2, 0, 0, 0, 0, 2, 8, 0, 0x45, 0][..],
            &length.to_be_bytes(),
            &[0, 0, 0, 0, 64, 6, 0, 0],
            &client,
            &[10, 200, 0, 9],
            &[port, 502].map(u16::to_be_bytes).concat(),
            &[0, 0, 0, sequence, 0, 0, 0, 0, 0x50, 16, 0xFF, 0xFF, 0, 0, 0, 0],
            payload,
        ]
        .concat()
    }

    fn capture(packets: impl Iterator<Item = Vec<u8>>) -> Vec<u8> {
        let mut file = [0xA1B2_C3D4_u32, 0x0002_0004, 0, 0, 65_535, 1].map(u32::to_be_bytes).concat();
        for (at, packet) in (0_u32..).zip(packets) {
            let head = [at / 1000, at % 1000 * 1000, packet.len() as u32, packet.len() as u32];
            file.extend(head.map(u32::to_be_bytes).as_flattened());
            file.extend(packet);
        }
        file
    }

    const ASKS: [u8; 12] = [0, 1, 0, 0, 0, 6, 17, 3, 0, 200, 0, 3];

    /// Those beyond the 60,000th shared its number, and their telegrams counted as sent again.
    #[test]
    fn more_connections_than_can_be_told_apart_are_counted() {
        let file = capture((0..61_000).map(|n| packet(n, 100, &ASKS)));
        let log = Log::read(&file, &Reading::default(), Options::default()).unwrap();
        assert_eq!(log.entries().len(), 60_000);
        assert_eq!(log.statistics().retries, 0);
        let story: Vec<String> = log.story().iter().map(ToString::to_string).collect();
        assert!(story.iter().any(|line| line.starts_with("1,000 connections")), "{story:?}");
    }

    /// Over at once: to go through all telegrams for each silent unit took seconds.
    #[test]
    fn the_findings_of_many_connections_are_few() {
        let packets = (0..5 * 40_000_u32).map(|n| {
            let round = (n / 40_000) as u8;
            let mut asks = ASKS;
            asks[1] = round;
            packet(n % 40_000, 100 + 12 * round, &asks)
        });
        let file = capture(packets);
        let log = Log::read(&file, &Reading::default(), Options::default()).unwrap();
        let findings = log.findings(&file.as_slice());
        let silent: Vec<_> = findings.iter().filter(|finding| finding.code == "unit-silent").collect();
        assert_eq!(silent.len(), 51);
        assert!(silent[50].text.to_string().starts_with("39,950 units more"), "{}", silent[50].text);
        assert!(silent.iter().all(|finding| !finding.evidence.is_empty()));
    }

    /// Times of 64 bits and any resolution lie further apart than can be told.
    #[test]
    fn times_far_apart_are_drawn() {
        let block = |kind: u32, body: &[u8]| {
            let length = (12 + body.len() as u32).to_be_bytes();
            [&kind.to_be_bytes()[..], &length, body, &length].concat()
        };
        let unknown = [0xFF; 8];
        let section = block(0x0A0D_0D0A, &[&[0x1A, 0x2B, 0x3C, 0x4D, 0, 1, 0, 0][..], &unknown].concat());
        for since in [0, i64::MIN, i64::MAX, -1 << 40] {
            for resolution in [0_u8, 6, 9, 0x80, 0xBF] {
                let options = [&[0, 9, 0, 1, resolution, 0, 0, 0, 0, 14, 0, 8][..], &since.to_be_bytes()];
                let body = [&[0, 1, 0, 0, 0, 0, 255, 255][..], &options.concat(), &[0; 4]];
                let mut file = [section.clone(), block(1, &body.concat())].concat();
                for (n, stamp) in (0..).zip([0_u64, 1, u64::MAX / 2, u64::MAX]) {
                    let bytes = packet(n, 100, &ASKS);
                    let length = (bytes.len() as u32).to_be_bytes();
                    let padding = vec![0; bytes.len().next_multiple_of(4) - bytes.len()];
                    let stamp = stamp.to_be_bytes();
                    let body = [&[0; 4][..], &stamp, &length, &length, &bytes, &padding];
                    file.extend(block(6, &body.concat()));
                }
                let log = Log::read(&file, &Reading::default(), Options::default()).unwrap();
                assert_eq!(log.entries().len(), 4);
                let drawn: u32 = log.timeline(None, 10).buckets.iter().map(|bucket| bucket.telegrams).sum();
                let timed = log.entries().iter().filter(|entry| entry.time().is_some()).count();
                // Where no times tell, the stretches are of telegrams.
                assert!(drawn as usize == timed || drawn == 4, "{drawn} of {timed}");
                let _ = (log.story(), log.findings(&file.as_slice()));
            }
        }
    }

    /// Every word of every device's tables can be searched.
    #[test]
    fn every_name_of_a_device_can_be_searched() {
        let file = capture(std::iter::once(packet(1, 100, &ASKS)));
        for device in PROFILES {
            let options = Options { device: Some(device), ..Options::default() };
            let log = Log::read(&file, &Reading::default(), options).unwrap();
            let labels = device.areas.iter().map(|area| area.spec.label);
            let labels = labels.chain(device.parameters().map(|parameter| parameter.spec.label));
            for word in labels.flat_map(|label| label.split(' ')).chain(["", " ", "0", "1", "65535", "FFFFh"])
            {
                for text in [word.to_owned(), format!("{word} 1"), format!("{word} 65535")] {
                    let filter = Filter { text, ..Filter::default() };
                    log.filtered(&filter, &file.as_slice(), file.len() as u64);
                }
            }
        }
    }
}

mod texts {
    use super::*;
    use buslens::tool::log::{Log, Reading};

    /// Reads a log in parts that end at `cuts`.
    fn read(text: &[u8], cuts: &[usize]) -> Log {
        let mut log = Log::open(text, text.len() as u64, &Reading::default(), Options::default()).unwrap();
        let mut from = 0;
        for to in cuts.iter().copied().chain([text.len()]) {
            log.push(&text[from..to]);
            from = to;
        }
        log.finish();
        log
    }

    /// A character that no byte stands for had its bytes in the string, each with the place of the whole one.
    #[test]
    fn strings_hold_no_characters_that_are_no_bytes() {
        assert!(decode("0\"0\\0Ā\"", Options::default()).telegrams.is_empty());
        // Those of Latin-1 are bytes.
        let text = r#"b"\x01\x03\x00È\x00\x03\x845""#;
        assert_eq!(decode(text, Options::default()).telegrams[0].line.bytes[3], 0xC8);
    }

    /// Where a part ended within a character of two units, or began with a mark, the places of all later
    /// lines were off.
    #[test]
    fn utf_16_is_the_same_in_parts() {
        let text = "\u{FEFF}# \u{1F600} ok\n\u{FEFF}TX 01 03 00 C8 00 03 84 35 \u{1F600}\n\
                    RX 01 03 06 00 08 42 A4 F1 DE B0 F8 # \u{FEFF}\n\u{1F600}";
        for big in [false, true] {
            let bytes: Vec<u8> = text
                .encode_utf16()
                .flat_map(|unit| if big { unit.to_be_bytes() } else { unit.to_le_bytes() })
                .collect();
            let whole = read(&bytes, &[]);
            assert!(!whole.entries().is_empty());
            for first in 0..bytes.len() {
                for second in [first, first + 1, first + 2, first + 3] {
                    let parts = read(&bytes, &[first, second.min(bytes.len())]);
                    assert_eq!(parts.entries(), whole.entries(), "cut at {first} and {second}");
                    assert_eq!(parts.unread(), whole.unread(), "cut at {first} and {second}");
                }
            }
        }
    }

    /// A number of one digit that looked like the telegram's next byte, which the next piece begins with.
    #[test]
    fn every_byte_has_its_place() {
        for text in [
            "0.00\0Tx\x001 64\x000C 0\x000 330101033B8281020000000095B4",
            "680F0F6801027D12066000000000<-0\\0\\00 000505DC283E",
        ] {
            for line in decode(text, Options::default()).lines() {
                assert_eq!(line.places.len(), line.bytes.len(), "{text:?}");
            }
        }
    }

    /// Overflow checks are on in tests.
    #[test]
    fn nothing_overflows() {
        for text in
            ["0xx", "20000000000000.0", "20000000000000.0 01 03", "99999999999999999999.9 01 03 00 C8"]
        {
            read(text.as_bytes(), &[]);
            decode(text, Options::default());
        }
    }

    /// Over at once: to look for the closing quote from every quote took 50 µs a byte.
    #[test]
    fn lines_of_quotes_take_linear_time() {
        for unit in ["'\\", "\"\\", "'", "\"", "b'", "'\\x", "\"'", "(", "[", "{", "<", "`"] {
            let text = unit.repeat(400_000 / unit.len());
            read(text.as_bytes(), &[]);
            decode(&text, Options::default());
        }
    }

    /// Over at once, with as much said as somebody can read: each line had a remark of its own, 330 bytes
    /// of memory for each byte.
    #[test]
    fn much_text_of_short_lines_is_decoded() {
        for line in ["0\n", "01\n", "01\r\n", "G\n", "\n", "01 03\n"] {
            let report = decode(&line.repeat(1_000_000 / line.len()), Options::default());
            let remarks: usize = report.lines().map(|line| line.remarks.len()).sum();
            assert!(remarks < 2000, "{remarks} remarks");
        }
    }
}

mod builds {
    use super::*;
    use buslens::frame::split::{Begins, Place, Splitter};
    use buslens::modbus::STANDARD;
    use buslens::tool::{Offer, Protocol, offers, replies};
    use buslens::walk;

    /// The bytes that the link of an editor leads to.
    fn followed(editor: &mut Editor, settings: &Settings) -> Vec<u8> {
        let link = Link::read(editor.link(settings).pairs());
        Editor::follow(&link).expect("a link leads to an editor").bytes().unwrap()
    }

    /// What does not fit left the field as it was at the link's end, and that was something else.
    #[test]
    fn a_link_leads_to_the_bytes_that_are_shown() {
        let settings = Settings::default();
        let mut editor = Editor::of(&REQUEST, PROTOCOLS[0], Direction::Request, &settings);
        for (path, text) in [("unit", "0"), ("unit", ""), ("start", "9"), ("start", "seven"), ("crc", "0")] {
            editor.edit(path, Change::Enter(text));
            assert_eq!(followed(&mut editor, &settings), editor.bytes().unwrap(), "{path} = {text}");
        }
        // A request in a device's words has no bytes in its link.
        for device in PROFILES {
            let task = offers(Some(device)).into_iter().find(|offer| matches!(offer, Offer::Task(_)));
            let made =
                PROTOCOLS.iter().find_map(|protocol| Editor::new(task.unwrap(), 1, protocol, &settings).ok());
            let mut editor = made.unwrap();
            editor.edit("unit", Change::Enter("0"));
            editor.edit("unit", Change::Enter(""));
            assert_eq!(followed(&mut editor, &settings), editor.bytes().unwrap(), "{}", device.key);
            let link = Link::read(editor.link(&settings).pairs());
            let again = Editor::follow(&link).unwrap();
            assert_eq!(again.entries().misfits, editor.entries().misfits, "{}", device.key);
        }
    }

    /// How many bytes it keeps, and what it has too much, are told by the bytes.
    #[test]
    fn a_link_to_a_faulty_telegram_leads_to_its_bytes() {
        let settings = Settings::default();
        for (bytes, edits) in [
            (&[1][..], &[("", "4")][..]),
            (&[1, 3, 0, 200], &[("", "1"), (".window", "3"), ("", "")]),
            (&[1, 16, 0, 0, 0, 1, 2, 0, 7, 0, 0], &[("byte_count", "9"), ("values", "3")]),
        ] {
            let mut editor = Editor::of(bytes, PROTOCOLS[0], Direction::Request, &settings);
            for (path, text) in edits {
                editor.edit(path, Change::Enter(text));
                assert_eq!(followed(&mut editor, &settings), editor.bytes().unwrap(), "{path} = {text}");
            }
        }
        // A frame and another one behind it.
        let fdl = Protocol::of("profibus-fdl").unwrap();
        let mut editor = Editor::of(&[0x10, 0x16], fdl, Direction::Request, &settings);
        assert_eq!(followed(&mut editor, &settings), [0x10, 0x16]);
    }

    /// What two windows keep was typed into both.
    #[test]
    fn windows_have_entries_of_their_own() {
        let settings = Settings::default();
        let mut editor = Editor::of(&[1], PROTOCOLS[0], Direction::Request, &settings);
        let typed = |editor: &Editor| {
            let mut typed = Vec::new();
            editor.entries().form.visit(&mut |entry| {
                if entry.spec.key == "unexpected" {
                    typed.push((entry.path.clone(), entry.text().unwrap_or_default().to_owned()));
                }
            });
            typed
        };
        let before = typed(&editor);
        assert_eq!(before.len(), 2, "{before:?}");
        editor.edit(&before[0].0, Change::Enter("x"));
        assert_eq!(typed(&editor)[0].1, "x");
        assert_eq!(typed(&editor)[1], before[1]);
    }

    /// A request for 65,535 registers was answered with 131,070 bytes.
    #[test]
    fn no_reply_is_longer_than_a_telegram() {
        for function in [1, 2, 3, 4, 23, 100] {
            for quantity in [1_u16, 125, 2000, 2001, 24_320, u16::MAX] {
                let bytes = [&[1, function, 0, 0][..], &quantity.to_be_bytes(), &[0, 0]].concat();
                let mut request =
                    (PROTOCOLS[0].expect)(&bytes, Direction::Request, &Settings::default().frame);
                walk::read(request.as_mut(), &bytes);
                let all = replies(request.as_mut(), &Settings::default().frame.profibus, None);
                assert!(all.len() > 3);
                for mut reply in all {
                    let bytes = walk::write(reply.frame.as_mut(), &Deviations::default());
                    assert!(bytes.len() <= 256, "{} bytes for {quantity} of {function}", bytes.len());
                }
            }
        }
    }

    #[test]
    fn nothing_may_become_anything() {
        for protocol in PROTOCOLS.iter().filter(|protocol| buslens::frame::split::can_split(protocol)) {
            let begins = |last| {
                let place = Place { bytes: &[], last, in_step: true, waiting: None };
                Splitter::new(&STANDARD).begins(protocol, place)
            };
            assert_eq!((begins(false), begins(true)), (Begins::More, Begins::Nothing), "{}", protocol.key);
        }
    }
}

/// What the fuzzer found in texts and logs, each with its smallest input.
mod found {
    use super::*;
    use buslens::tool::log::{Input, Log, Reading, Role};

    /// Half a letter was no word and no sign: the reader stood still.
    #[test]
    fn halves_of_letters_end() {
        for bytes in
            [&b"\xA1\xB2\xC3"[..], b"\xC3", b"\xC9 01 03", b"\xC3\xC3", b"\xB5\x0C?", b"\xE2", b"01\xC3"]
        {
            for input in [Input::Auto, Input::Text, Input::Binary] {
                let reading = Reading { input, ..Reading::default() };
                let _ = Log::read(bytes, &reading, Options::default());
                decode(&String::from_utf8_lossy(bytes), Options::default());
            }
        }
    }
    /// A number before the bytes looked like the first of them: the others had no places.
    #[test]
    fn each_byte_has_its_place() {
        let options = Options { protocol: Some(PROTOCOLS[0]), ..Options::default() };
        let report = decode("<-225\x00\x00225 9 0 1", options);
        for telegram in &report.telegrams {
            assert_eq!(telegram.line.bytes.len(), telegram.line.places.len(), "{:?}", telegram.line.bytes);
        }
    }

    /// The length of an entry has 16 bits: of 70,000 bytes in a line, said to be a PDU, 4,464 were one.
    #[test]
    fn more_bytes_than_an_entry_can_count_are_no_telegram() {
        let text = "5A ".repeat(70_000);
        for protocol in PROTOCOLS {
            let options = Options { protocol: Some(protocol), ..Options::default() };
            let log = Log::read(text.as_bytes(), &Reading::default(), options).unwrap();
            assert!(log.entries().iter().all(|it| it.role == Role::Discarded), "{}", protocol.key);
            let counted: usize = log.entries().iter().map(|it| usize::from(it.length)).sum();
            assert_eq!(counted, 70_000, "{}", protocol.key);
        }
    }

    /// Over at once: to look at all pieces of a line for each of them takes minutes.
    #[test]
    fn lines_of_many_pieces_take_linear_time() {
        for unit in ["20000000000000.0=", "..99999999999999999999", "len=8 01 ", "(01)x", "-1 g ", "1,g "] {
            let text = unit.repeat(60_000 / unit.len());
            let _ = Log::read(text.as_bytes(), &Reading::default(), Options::default());
            decode(&text, Options::default());
        }
    }
}
