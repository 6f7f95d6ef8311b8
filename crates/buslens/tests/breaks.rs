//! What once broke, each with its smallest input: no panic, no hang, nothing lost, nothing untrue.

use buslens::field::Direction;
use buslens::tool::link::{Link, keep_settings, kept_settings};
use buslens::tool::{Change, Editor, Entries, Options, PROTOCOLS, Settings, decode, settings};
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
        editor.edit("crc", Change::Enter("0"));
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
