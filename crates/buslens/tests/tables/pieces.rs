//! What the text layer gives of small texts.

use std::fmt::Write as _;

use buslens::field::{Direction, Facts, Span, hex};
use buslens::text::{self, Event, Form, Marks, Numbers, Piece, Place, Reader, Sender};

use super::assert_table;
use super::texts::{BLOCKS, SPELLINGS, SURROUNDINGS, TIMES};

/// What of the text layer comes out of a text.
fn pieces(table: &mut String, text: &str, form: &Form) {
    writeln!(table, "{}", text.escape_debug()).unwrap();
    let mut shapes: Vec<u32> = Vec::new();
    let mut tell = |event: Event<'_>| match event {
        Event::Piece(piece) => {
            let known = shapes.iter().position(|shape| *shape == piece.facts.shape);
            let shape = known.unwrap_or_else(|| {
                shapes.push(piece.facts.shape);
                shapes.len() - 1
            });
            writeln!(table, "    {}", shown(&piece, shape)).unwrap();
        }
        Event::Unread { line, offset } => writeln!(table, "    unread {line} at {offset}").unwrap(),
    };
    let mut reader = Reader::new(form.clone());
    reader.push(text.as_bytes(), &mut tell);
    reader.finish(&mut tell);
}

/// All of a piece, without what is as it mostly is.
fn shown(piece: &Piece<'_>, shape: usize) -> String {
    let places: Vec<String> =
        piece.places.iter().map(|place| format!("{}+{}", place.from, place.len())).collect();
    let mut said = format!("{} at {}: {} ({})", piece.line, piece.offset, hex(piece.bytes), places.join(" "));
    if let Some(decimal) = piece.decimal {
        write!(said, ", decimal {decimal:?}").unwrap();
    }
    if !piece.breaks.is_empty() {
        write!(said, ", breaks {:?}", piece.breaks).unwrap();
    }
    if let Some(time) = piece.time {
        write!(said, ", time {time}").unwrap();
    }
    if let Some(sender) = piece.sender {
        write!(said, ", {}", by(sender)).unwrap();
    }
    if let Some(port) = piece.port {
        write!(said, ", port {}", String::from_utf8_lossy(port)).unwrap();
    }
    if let Some((from, step)) = piece.pairs {
        write!(said, ", pairs from {from} by {step}").unwrap();
    }
    if piece.joins {
        said += ", joins";
    }
    let names = facts(&piece.facts);
    if !names.is_empty() {
        write!(said, ", {}", names.join(" ")).unwrap();
    }
    if shape > 0 {
        write!(said, ", shape {shape}").unwrap();
    }
    said
}

fn by(sender: Sender) -> &'static str {
    match sender {
        Sender::Says(Direction::Request) => "request",
        Sender::Says(Direction::Response) => "response",
        Sender::Logger => "sent",
        Sender::Other => "received",
    }
}

fn facts(facts: &Facts) -> Vec<&'static str> {
    let named = [
        (facts.colon, "colon"),
        (facts.dumped, "dumped"),
        (facts.column, "column"),
        (facts.bare, "bare"),
        (facts.said, "said"),
        (facts.labelled, "labelled"),
        (facts.wrapped, "wrapped"),
        (facts.array, "array"),
        (facts.words, "words"),
        (facts.listed, "listed"),
        (facts.marked, "marked"),
        (facts.counted, "counted"),
        (facts.of_telegrams, "of-telegrams"),
        (facts.of_leftovers, "of-leftovers"),
        (facts.abridged, "abridged"),
        (facts.slips, "slips"),
        (facts.rest, "rest"),
    ];
    named.into_iter().filter(|(fact, _)| *fact).map(|(_, name)| name).collect()
}

/// The pieces of small texts, with all that the text says of them.
#[test]
fn what_texts_have() {
    let mut table = String::new();
    for text in SPELLINGS.iter().chain(SURROUNDINGS).chain(BLOCKS) {
        pieces(&mut table, text, &Form::default());
    }
    for time in TIMES {
        pieces(&mut table, &format!("{time} 01 03 00 C8 00 03 84 35"), &Form::default());
    }
    assert_table("pieces", &table);
}

/// A text that is being typed or comes in pieces: how many bytes are found in it at each length.
#[test]
fn texts_that_grow() {
    let mut table = String::new();
    for text in SPELLINGS.iter().chain(SURROUNDINGS).chain(BLOCKS) {
        let mut found: Vec<(usize, usize)> = Vec::new();
        for length in (1..=text.len()).filter(|length| text.is_char_boundary(*length)) {
            let mut count = 0;
            let mut tell = |event: Event<'_>| {
                if let Event::Piece(piece) = event {
                    count += piece.bytes.len();
                }
            };
            let mut reader = Reader::new(Form::default());
            reader.push(&text.as_bytes()[..length], &mut tell);
            reader.finish(&mut tell);
            match found.last_mut() {
                Some((known, times)) if *known == count => *times += 1,
                _ => found.push((count, 1)),
            }
        }
        let found: Vec<String> = found.iter().map(|(count, times)| format!("{count}\u{d7}{times}")).collect();
        writeln!(table, "{}: {}", text.escape_debug(), found.join(" ")).unwrap();
    }
    assert_table("growing", &table);
}

/// What a person says of a text, or its beginning does.
#[test]
fn forms_of_texts() {
    let mut table = String::new();
    for numbers in [Numbers::Hex, Numbers::Decimal] {
        writeln!(table, "# {numbers:?}").unwrap();
        let form = Form { numbers: Some(numbers), ..Form::default() };
        for text in [
            "01 03 00 C8 00 03 84 35",
            "01 03 00 200 00 03 132 53",
            "1 3 0 20 0 3 13 53",
            "1, 3, 0, -56, 0, 3",
            "100 101 99 12",
            "{ 0x01, 3, 0, 20,\n0, 3, 13, 53 }",
            "010300C800038435",
            "a 01\nb 03\nc 00\nd 20\ne 00",
        ] {
            pieces(&mut table, text, &form);
        }
    }
    writeln!(table, "# counted").unwrap();
    for text in [
        "8 01 03 00 C8 00 03 84 35",
        "08 01 03 00 C8 00 03 84 35",
        "11 01 03 06 00 80 42 A4 F1 DE B0 F8",
        "9 01 03 00 C8 00 03 84 35",
        "4 01 03 00 C8",
        "3 01 03 00",
        "03 01 03 00",
        "04 01 03 00 C8",
        "09 01 03 00 C8 00 03 84 35",
        "8, 1, 3, 0, 200, 0, 3, 132, 53",
        "tx 8 01 03 00 C8 00 03 84 35 rx 4 01 03 00 C8",
    ] {
        pieces(&mut table, text, &Form { counted: true, ..Form::default() });
    }
    writeln!(table, "# quoted").unwrap();
    for text in [
        "> 01 03 00 C8\n> > 00 03\n>\n> x\nno 01 03 00 C8",
        ">>> tx 01 03 00 C8",
        "> 0000: 01 03 00 C8",
        "> tx 0x01 0x03 0x00 0xC8 0x00\n> tx 0x11 0x03 0x00 0xC9 0x00\n>> tx 0x11 0x03 0x00 0xC9 0x00",
    ] {
        pieces(&mut table, text, &Form { quoted: true, ..Form::default() });
    }
    writeln!(table, "# one byte a line").unwrap();
    for unit in [1, 1000, 1_000_000] {
        let form = Form { flow: Some(text::Flow { unit }), ..Form::default() };
        for text in [
            "time,byte\n0.5,0x01\n1.25,03\n2.125 00\n3.0;C8",
            "12.5\t01\t.\n13.5\t0x03 x\n14\t00\n15.5x 03",
            "10:00:00.5 RX 01\n10:00:01 RX 03 04",
            "1.,01\n99999999999999.5,01\n0.1234567,01\n1.5",
        ] {
            pieces(&mut table, text, &form);
        }
    }
    writeln!(table, "# marked").unwrap();
    let line = "#7;09:30:05.5;A;5;01 03 00 C8;note 1";
    let place = |text: &str| {
        let from = line.find(text).unwrap();
        Place::of(line, Span::new(from, from + text.len()))
    };
    for (time, word) in
        [(Some("09:30"), Some(Direction::Request)), (None, Some(Direction::Response)), (None, None)]
    {
        let marks = Marks {
            time: time.map(place),
            direction: word.map(|direction| (place("A"), "A".to_owned(), direction)),
            bytes: place("01 03"),
        };
        let form = Form { marks: Some(marks), ..Form::default() };
        for text in [
            "#7;09:30:05.5;A;5;01 03 00 C8;note 1",
            "#8;09:30:06.5;B;55;05 03 00 C8;note 2\n#9;x;AB;1;05;",
            "nothing; here",
            "#7;09:30:05.5;A;5;0x01 0x03 0x00 0xC8 0x00;note 1\n#8;09:30:06.5;B;5;0x11 0x03 0x00 0xC9 0x00;note 1",
            "#9;09:30:06.5;B;55;",
            "a;b;c;d;0x01, 0x03,\n1;2;3;4;00 C8",
        ] {
            pieces(&mut table, text, &form);
        }
    }
    assert_table("forms_of_texts", &table);
}

/// What the beginning of a text tells of it.
#[test]
fn beginnings() {
    let mut table = String::new();
    let lines = |line: &dyn Fn(usize) -> String, count: usize| -> String {
        (0..count).map(|n| line(n) + "\n").collect()
    };
    let mut texts: Vec<String> = SPELLINGS.iter().chain(BLOCKS).map(|text| (*text).to_owned()).collect();
    for count in [3, 7, 8, 16, 17] {
        texts.push(lines(&|n| format!("TX 01 03 00 C8 00 {n:02X} 84 35"), count));
        texts.push(lines(&|n| format!("TX 1 3 0 200 0 {n} 132 53"), count));
        texts.push(lines(&|n| format!("TX 01 03 00 20 00 {n:02}"), count));
        texts.push(lines(&|n| format!("{n}.5,0x{n:02X},"), count));
        texts.push(lines(&|n| format!("{:02} 01 03 00 C8 00{}", 5 + n, " 03".repeat(n)), count));
        texts.push(lines(&|n| format!("{} 1 3 0 200 0{}", 5 + n, " 3".repeat(n)), count));
        texts.push(lines(&|n| format!("{:02} 01 03 00 C8 00", 5 + n), count));
        texts.push(lines(&|_| "06 01 03 00 C8 00 03".to_owned(), count));
        texts.push(lines(&|n| format!("> 01 03 00 C8 {n:02X}"), count));
    }
    texts.push(format!("Time [ms],x\n{}", lines(&|n| format!("{n}.5,0x{n:02X}"), 20)));
    texts.push(format!("time_us\n{}\n01 03 00 C8", lines(&|n| format!("{n}.5,0x{n:02X}"), 20)));
    texts.push(format!("t (us)\n01 03\n01 03\n{}", lines(&|n| format!("{n}.5,0x{n:02X}"), 20)));
    texts.push(format!("t\n01 03\n01 03\n01 03\n{}", lines(&|n| format!("{n}.5,0x{n:02X}"), 20)));
    texts.push(format!(
        "t\n{}{}",
        lines(&|_| "01 03 00 C8 x 0x05".to_owned(), 3),
        lines(&|n| format!("{n}.5,0x{n:02X}"), 20)
    ));
    texts.push(format!(
        "t\n{}{}",
        lines(&|_| "01 03 00 C8 x 0x05".to_owned(), 2),
        lines(&|n| format!("{n}.5,0x{n:02X}"), 20)
    ));
    texts.push(format!(
        "t\n{}{}",
        lines(&|_| "01 03 x 0x05".to_owned(), 3),
        lines(&|n| format!("{n}.5,0x{n:02X}"), 20)
    ));
    texts.push(format!(
        "t\n{}{}",
        lines(&|_| "x 1".to_owned(), 3),
        lines(&|n| format!("{n}.5,0x{n:02X}"), 20)
    ));
    for text in &texts {
        let known = text::recognise(text.as_bytes());
        let shown: String = text.escape_debug().to_string().chars().take(60).collect();
        writeln!(
            table,
            "{shown} ({}): {:?}, {:?}, {:?}, {} with bytes, {} telling, {} dumped, counted {}, quoted {}, {:?}",
            text.len(),
            known.layout.map(|layout| layout.name),
            known.numbers,
            known.style.map(text::Style::name),
            known.with_bytes,
            known.telling,
            known.dumped,
            text::counted(text.as_bytes(), known.numbers),
            text::quoted(text.as_bytes()),
            text::flow(text.as_bytes(), known.numbers),
        )
        .unwrap();
    }
    assert_table("beginnings", &table);
}

/// What is wrong with what a person types.
#[test]
fn slips() {
    let mut table = String::new();
    for text in [
        "01 03 00 C8 00 03 84 3",
        "01 03 00 C8 00 03 84 357",
        "01 03 00 c8 OO l3",
        "O",
        "l",
        "I 01",
        "0x",
        "0X 01",
        "01 0x 03",
        "01 zz 03",
        "01 z 03",
        "01 ? 03 !",
        "01 é 03",
        "010",
        "010 3",
        "01 0",
        "a",
        "ab c",
        "0103000",
        "01 03 00 C8 hello",
        "hello",
        "0103zz00",
        "123456789",
        "1234 56",
        "12 3x",
        "1x2x3x",
        "deadbeef",
        "01-03-0",
        "",
        " ",
        "?",
        "01 03 00 C8 00 03 84 35 q",
    ] {
        let mut places = Vec::new();
        let mut tell = |event: Event<'_>| {
            if let Event::Piece(piece) = event {
                places.extend(piece.places.iter().map(|place| place.shifted(piece.offset as usize)));
            }
        };
        let mut reader = Reader::new(Form::default());
        reader.push(text.as_bytes(), &mut tell);
        reader.finish(&mut tell);
        let remarks: Vec<String> = text::remarks(text, 0, &places)
            .iter()
            .map(|it| format!("{} at {}..{}: {}", it.code, it.span.from, it.span.to, it.message))
            .collect();
        let typed = if text::looks_typed(text) { "typed" } else { "not typed" };
        writeln!(table, "{text:?} = {}, {typed}: {}", hex(&text::bytes(text)), remarks.join("; ")).unwrap();
    }
    assert_table("slips", &table);
}

/// Texts that are longer than what is read at once: the pieces in short.
#[test]
fn long_texts() {
    let mut table = String::new();
    let rows = |count: usize, row: &str| format!("{row}\n").repeat(count);
    let bytes = |count: usize, parted: &str| vec!["5A"; count].join(parted);
    for (name, text) in [
        ("a line of 65,536 characters", "x".repeat(1 << 16)),
        ("a blank and 70,000 characters", " ".to_owned() + &"x".repeat(70_000)),
        ("65,537 characters and bytes", "x".repeat((1 << 16) + 1) + " 01 03 00 C8 00 03"),
        ("30,000 bytes in a line", bytes(30_000, " ")),
        ("30,000 bytes in a line with a time", format!("10:00:00 tx: {}", bytes(30_000, " "))),
        ("60,000 bytes without blanks", bytes(60_000, "")),
        ("30,000 bytes with colons, and a line", bytes(30_000, ":") + "\n01 03 00 C8\n"),
        ("a list of 4,096 bytes", rows(256, "1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16,")),
        ("a list of 4,112 bytes", rows(257, "1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16,")),
        ("a list of 8,300 bytes", rows(519, "1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16,")),
        ("600 lines of a column", rows(600, "x 5A")),
        ("601 lines of a column", rows(601, "x 5A")),
        ("605 lines of a column", rows(605, "x 5A")),
        ("8 numbers in a row", rows(5, "q 1 r 2 s 3 t 4 u 5 v 6 w 7 x 8")),
        ("9 numbers in a row", rows(5, "q 1 r 2 s 3 t 4 u 5 v 6 w 7 x 8 y 9")),
        (
            "70 numbers in a line, the last tells the length",
            format!("{} 8: 01 03 00 C8 00 03 84 35", "x 9 ".repeat(70)),
        ),
        ("a number far away tells the length", format!("8 {}: 01 03 00 C8 00 03 84 35", "x 9 ".repeat(40))),
        (
            "a number not so far away tells the length",
            format!("8 {}: 01 03 00 C8 00 03 84 35", "x 9 ".repeat(20)),
        ),
        (
            "many breaks",
            (0..14)
                .map(|n| format!("5A{}5B 5C 5D", [",", ";", "|", "/"][n % 4]))
                .collect::<Vec<_>>()
                .join(" "),
        ),
        ("far behind an ellipsis", format!("01 03 00 C8 00 03 {} …", "z".repeat(35))),
        ("too far behind for an ellipsis", format!("01 03 00 C8 00 03 {} …", "z".repeat(45))),
        ("between bytes too much", format!("01 03{}00 C8 00 03", " ".repeat(24))),
        ("between bytes more than too much", format!("01 03{}00 C8 00 03", " ".repeat(25))),
    ] {
        let mut told: Vec<String> = Vec::new();
        let mut tell = |event: Event<'_>| match event {
            Event::Piece(piece) => told.push(
                format!(
                    "{} at {}: {} bytes{}{}{}{}",
                    piece.line,
                    piece.offset,
                    piece.bytes.len(),
                    if piece.joins { ", joins" } else { "" },
                    if piece.time.is_some() { ", with time" } else { "" },
                    if piece.sender.is_some() { ", said" } else { "" },
                    if piece.breaks.is_empty() {
                        String::new()
                    } else {
                        format!(", breaks {:?}", piece.breaks)
                    }
                ) + &facts(&piece.facts).iter().map(|fact| format!(" {fact}")).collect::<String>(),
            ),
            Event::Unread { line, offset } => told.push(format!("unread {line} at {offset}")),
        };
        let mut reader = Reader::new(Form::default());
        for part in text.as_bytes().chunks(1000) {
            reader.push(part, &mut tell);
        }
        reader.finish(&mut tell);
        let lines = reader.lines();
        let count = told.len();
        told.truncate(8);
        writeln!(table, "{name}: {lines} lines, {count} pieces: {}", told.join("; ")).unwrap();
    }
    assert_table("long_texts", &table);
}
