//! Telegrams that were to be written, with the slips that people make: the remark names the field and teaches.

use buslens::field::Direction;
use buslens::tool::{Profile, Protocol};
use buslens_trainer::{Answer, Blank, Expected, Task, Telegram, Verdict, grade};

fn telegram(hex: &str, direction: Direction, protocol: &str, device: &str) -> Telegram {
    let bytes = buslens::tool::steps::bytes(hex);
    let mut telegram = Telegram::new(bytes, direction, Protocol::of(protocol).unwrap());
    telegram.options.device = Profile::of(device);
    telegram
}

fn verdict(wanted: &Telegram, answer: &str) -> Verdict {
    let task = Task {
        question: String::new(),
        given: Vec::new(),
        expected: Expected::Telegram(wanted.clone()),
        hints: Vec::new(),
        working: Vec::new(),
    };
    grade(&task, &Answer::Text(answer.to_owned()))
}

/// The field and the text of the first remark.
#[track_caller]
fn first(wanted: &Telegram, answer: &str) -> (String, String) {
    let verdict = verdict(wanted, answer);
    let remark = verdict.remarks().first().unwrap_or_else(|| panic!("{answer}: {verdict:?}"));
    (remark.field.clone(), remark.text.to_string())
}

#[track_caller]
fn says(wanted: &Telegram, answer: &str, field: &str, part: &str) {
    let (label, text) = first(wanted, answer);
    assert_eq!(label, field, "{answer}: {text}");
    assert!(text.contains(part), "{answer}: {text}");
}

#[test]
fn a_request_in_any_spelling_is_right() {
    let wanted = telegram("01 03 00 C8 00 03 84 35", Direction::Request, "modbus-rtu", "");
    for answer in [
        "01 03 00 C8 00 03 84 35",
        "010300c800038435",
        "01 03 00 C8 00 03",
        "0x01, 0x03, 0x00, 0xC8, 0x00, 0x03",
        "01h 03h 00h C8h 00h 03h",
        "[01][03][00][C8][00][03][84][35]",
        "01-03-00-C8-00-03",
        "  01 03 00\nC8 00 03  ",
    ] {
        assert!(verdict(&wanted, answer).is_right(), "{answer}: {:?}", verdict(&wanted, answer));
    }
    assert!(matches!(verdict(&wanted, ""), Verdict::Unread(_)));
    assert!(matches!(verdict(&wanted, "read three registers"), Verdict::Unread(_)));
    let tcp = telegram("00 07 00 00 00 06 FF 03 00 C8 00 03", Direction::Request, "modbus-tcp", "");
    assert!(
        verdict(&tcp, "12 34 00 00 00 06 FF 03 00 C8 00 03").is_right(),
        "the transaction is the client's own"
    );
    // A lesson may be about no more than the first byte.
    for (wanted, given) in [("00", "01"), ("00 07", "00 08")] {
        let cut = telegram(wanted, Direction::Request, "modbus-tcp", "");
        assert!(verdict(&cut, wanted).is_right());
        assert!(!verdict(&cut, given).is_right(), "{given} for {wanted}");
    }
    let ascii = telegram("01 03 00 C8 00 03 31", Direction::Request, "modbus-ascii", "");
    assert!(verdict(&ascii, ":010300C8000331").is_right());
    assert!(verdict(&ascii, "010300C80003").is_right());
}

#[test]
fn each_slip_in_a_request_is_named() {
    let wanted = telegram("01 03 00 C8 00 03 84 35", Direction::Request, "modbus-rtu", "");
    says(&wanted, "01 03 00 C9 00 03", "Starting address", "one too high (201, not 200)");
    says(&wanted, "01 03 00 C7 00 03", "Starting address", "one too low");
    says(&wanted, "01 03 9D 09 00 03", "Starting address", "take 40001 off");
    says(&wanted, "01 03 C8 00 00 03", "Starting address", "bytes in the other order");
    says(&wanted, "01 03 02 00 00 03", "Starting address", "decimal digits where hex ones belong");
    says(&wanted, "02 03 00 C8 00 03", "Unit address", "is 2");
    says(&wanted, "01 04 00 C8 00 03", "Function code", "read input registers");
    says(&wanted, "01 03 00 C8 00 06", "Quantity", "counts bytes");
    says(&wanted, "01 03 00 C8 00 05", "Quantity", "is 5, 3 was asked for");
    says(&wanted, "01 03 00 C8 00 03 35 84", "CRC", "other order");
    says(&wanted, "01 03 00 C8 00 03 12 34", "CRC", "over your bytes it is 84 35");
    says(&wanted, "01 03 00 C8", "Quantity", "missing");
    // What is wrong in the body is said before its CRC, which fits it.
    says(&wanted, "01 03 00 C9 00 03 D5 F5", "Starting address", "one too high");
    let both = verdict(&wanted, "02 03 00 C9 00 03");
    assert_eq!(both.remarks().len(), 2);
}

#[test]
fn each_slip_in_a_written_value_is_named() {
    let wanted = telegram(
        "01 10 00 D7 00 03 06 00 80 42 F6 E9 79 28 15",
        Direction::Request,
        "modbus-rtu",
        "memograph-rsg45",
    );
    assert!(verdict(&wanted, "01 10 00 D7 00 03 06 00 80 42 F6 E9 79").is_right());
    says(&wanted, "01 10 00 D7 00 03 06 00 80 E9 79 42 F6", "Value", "word order is swapped");
    says(&wanted, "01 10 00 D7 00 03 06 00 40 42 F6 E9 79", "Status", "uncertain");
    says(&wanted, "01 10 00 D7 00 03 03 00 80 42 F6 E9 79", "Byte count", "counts registers");
    says(&wanted, "01 10 00 D7 00 03 06 00 80 42 F6", "Value", "missing");
    says(&wanted, "01 10 00 D7 00 03 06 00 80 42 F6 E9 7A", "Value", "is 123.4");
    let whole = telegram(
        "01 10 00 D7 00 03 06 00 80 42 C8 00 00 00 00",
        Direction::Request,
        "modbus-rtu",
        "memograph-rsg45",
    );
    says(&whole, "01 10 00 D7 00 03 06 00 80 00 00 00 64", "Value", "written as a whole number");
    let bare = telegram("01 10 00 D7 00 02 04 42 F6 E9 79 00 00", Direction::Request, "modbus-rtu", "");
    says(&bare, "01 10 00 D7 00 02 04 E9 79 42 F6", "Register 215", "word order is swapped");
}

#[test]
fn a_response_and_a_job_are_compared_by_fields_too() {
    let mut wanted = telegram("01 03 06 00 80 42 A4 F1 DE B0 F8", Direction::Response, "modbus-rtu", "");
    wanted.request = Some(buslens::tool::steps::bytes("01 03 00 C8 00 03 84 35"));
    says(&wanted, "01 03 03 00 80 42 A4 F1 DE", "Byte count", "counts registers");
    says(&wanted, "01 83 02", "Function code", "");
    let job = telegram("52 00 23 00 00 0B 00 00", Direction::Request, "profibus-parameter-channel", "");
    assert!(verdict(&job, "52 00 23 00 00 0B 00 00").is_right());
    says(&job, "52 00 23 01 00 0B 00 00", "Index", "one too high");
}

#[test]
fn what_is_not_there_yet_is_missing() {
    let wanted = telegram("01 03 00 C8 00 03 84 35", Direction::Request, "modbus-rtu", "");
    says(&wanted, "01", "Function code", "is missing: it has 1 byte");
    says(&wanted, "02", "Unit address", "is 2");
    says(&wanted, "01 03 00 C8 00", "Quantity", "ends too early, with 1 byte missing");
    // The checksum that is added is no function code.
    let both = verdict(&wanted, "02");
    assert_eq!(both.remarks()[1].text.to_string(), "the function code is missing: it has 1 byte");
    let frame = telegram("68 05 05 68 81 82 6D 3C 3E EA 16", Direction::Request, "profibus-fdl", "");
    says(&frame, "68 05 05 68 81 82 6D 3C 3E", "FCS", "missing");
}

#[test]
fn numbers_as_people_count_are_told_apart() {
    let wanted = telegram("11 03 01 2C 00 0C 87 6A", Direction::Request, "modbus-rtu", "");
    for text in ["17 3 300 12", "17, 3, 1, 44, 0, 12", "17 3 1 44 0 12 135 106"] {
        says(&wanted, text, "", "the right numbers as people count");
    }
    says(&wanted, "17 03 01 2C 00 0C", "Unit address", "decimal digits where hex ones belong");
}

#[test]
fn only_what_counts_is_one_too_high() {
    let tcp = telegram("00 01 00 00 00 06 01 03 00 C8 00 03", Direction::Request, "modbus-tcp", "");
    says(&tcp, "00 01 00 00 00 07 01 03 00 C8 00 03", "Length", "it says how many bytes follow");
    says(
        &tcp,
        "00 01 00 01 00 06 01 03 00 C8 00 03",
        "Protocol identifier",
        "is 1, 0 (Modbus) was asked for",
    );
    let job = telegram("41 00 22 00 00 00 00 00", Direction::Request, "profibus-parameter-channel", "");
    says(&job, "41 00 22 01 00 00 00 00", "Index", "own number plus 2000h");
    says(&job, "41 01 22 00 00 00 00 00", "Subindex", "was asked for");
    says(&job, "41 00 22 00 01 00 00 00", "Not used", "what is not used is 01 00 00 00");
}

#[test]
fn a_blank_is_told_what_it_would_mean() {
    let telegram = telegram("02 03 00 0A 00 02 E4 3A", Direction::Request, "modbus-rtu", "");
    let blanks = ["Function code", "CRC"].map(|label| {
        let field =
            telegram.fields(false).into_iter().find(|field| field.label().to_string() == label).unwrap();
        Blank { label: label.to_owned(), span: field.span }
    });
    let task = Task {
        question: String::new(),
        given: Vec::new(),
        expected: Expected::Blanks { telegram, blanks: blanks.to_vec() },
        hints: Vec::new(),
        working: Vec::new(),
    };
    for (function, crc, said) in [
        ("4", "E4 3A", "with 04, the function code is 4 (read input registers)"),
        ("3", "58426", "the CRC is right as a decimal number"),
        ("3", "3A E4", "its low byte goes first"),
        ("3", "E43B", "the CRC is not E4 3B"),
        ("3", "zz", "expected 2 bytes, in hex"),
    ] {
        let verdict = grade(&task, &Answer::Blanks(vec![function.to_owned(), crc.to_owned()]));
        let text = verdict.remarks()[0].text.to_string();
        assert!(text.contains(said), "{function} {crc}: {text}");
    }
}
