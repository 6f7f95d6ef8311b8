use buslens::tool::Options;
use buslens::tool::log::{Log, Reading};
use proptest::prelude::*;

fn word(file: &[u8]) -> String {
    match Log::read(file, &Reading::default(), Options::default()) {
        Err(refusal) => refusal.to_string(),
        Ok(log) => log.fault().unwrap_or_else(|| log.story()[0].to_string()),
    }
}

#[test]
fn each_bad_file_gets_its_word() {
    assert_eq!(word(b""), "The file is empty.");
    assert!(word(b"PK\x03\x04....").contains("ZIP"), "{}", word(b"PK\x03\x04...."));
    assert!(word(b"%PDF-1.7").contains("PDF"));
    let list = b"\"No.\",\"Time\",\"Source\",\"Destination\",\"Protocol\",\"Length\",\"Info\"\n\"1\",\"0.0\",\"a\",\"b\"\n";
    assert!(word(list).contains("Wireshark's packet list"));
    assert!(word(b"#separator \\x09\n#fields\tts\tuid\tfunc\n").contains("Zeek"));
    // Half a capture: a header, and a packet of which the end is missing.
    let mut half = vec![0xD4, 0xC3, 0xB2, 0xA1, 2, 0, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 4, 0, 1, 0, 0, 0];
    half.extend([0, 0, 0, 0, 0, 0, 0, 0, 60, 0, 0, 0, 60, 0, 0, 0, 1, 2, 3]);
    assert!(word(&half).contains("19 of 76 bytes are there"), "{}", word(&half));
    half[32..36].copy_from_slice(&[0xFF; 4]);
    assert!(word(&half).contains("damaged at byte 24"), "{}", word(&half));
    // Prose, and noise.
    assert!(word("nothing but prose\n".repeat(20).as_bytes()).starts_with("0 telegrams"));
    let noise: Vec<u8> = (0..5000_u32).map(|n| (n.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
    assert!(word(&noise).contains("telegrams of"), "{}", word(&noise));
    // A text that was cut in the middle of a character, and one of zeros.
    let wide: Vec<u8> = "TX 05 03 00 C8 00 03 85 8F\n".encode_utf16().flat_map(u16::to_be_bytes).collect();
    let wide = [&[0xFE, 0xFF], wide.as_slice(), &[0]].concat();
    assert!(word(&wide).starts_with("1 telegram of Modbus RTU in 1 line"), "{}", word(&wide));
    assert!(word(&[0; 10_000]).starts_with("0 telegrams"), "{}", word(&[0; 10_000]));
    assert!(word(b"\n\n\n").starts_with("0 telegrams"), "{}", word(b"\n\n\n"));
    for (beginning, name) in [
        (&b"\x1F\x8B\x08\0"[..], "gzip"),
        (b"\x89PNG\r\n", "picture"),
        (b"MZ\x90\0", "program"),
        (b"SQLite format 3\0", "database"),
        (b"\xD0\xCF\x11\xE0", "Office"),
    ] {
        assert!(word(beginning).contains(name), "{}", word(beginning));
    }
    // 10 MB in one line, without a blank as well.
    let line = "05030 0C8".repeat(10);
    assert!(word(line.as_bytes()).contains("telegram"), "{}", word(line.as_bytes()));
    let line = "A".repeat(10_000_000);
    assert!(word(line.as_bytes()).contains("telegram"), "{}", word(line.as_bytes()));
    let line = "05 03 00 C8 00 03 85 B1 ".repeat(10_000_000 / 24);
    assert!(
        word(line.as_bytes()).starts_with("416,666 telegrams of Modbus RTU in 1 line"),
        "{}",
        word(line.as_bytes())
    );
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 200, ..ProptestConfig::default() })]

    #[test]
    fn no_file_panics_or_swells(file in proptest::collection::vec(any::<u8>(), 0..3000), size in 1..500_usize) {
        if let Ok(mut log) = Log::open(&file, file.len() as u64, &Reading::default(), Options::default()) {
            file.chunks(size).for_each(|part| _ = log.push(part));
            log.finish();
            prop_assert!(log.memory() < 200 * (file.len() + 100));
            let report = log.whole_report(&file.as_slice());
            for index in 0..report.telegrams.len() {
                prop_assert!(report.detail(index).is_some());
            }
        }
    }

    #[test]
    fn no_text_panics(text in "([0-9A-Fa-f]{1,4}[ :,\\-.]|Tx |Rx: |0x[0-9a-f]{1,2} |\\\\x[0-9a-f]{2}|09:30:05|[\\n\\r'\"<>\\[\\]]|é|000000[0-9]0  ){0,300}") {
        if let Ok(log) = Log::read(text.as_bytes(), &Reading::default(), Options::default()) {
            let report = log.whole_report(&text.as_bytes());
            for telegram in &report.telegrams {
                for place in &telegram.line.places {
                    prop_assert!(place.to <= text.len());
                }
            }
        }
    }
}
