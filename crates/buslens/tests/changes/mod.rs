//! Changes of a text that leave its telegrams in their places: other words, times, blanks, cases of hex digits, and
//! other units and data, with checks made right again.

use buslens::walk::CRC_16_MODBUS;

/// A source of numbers from 0 to what it is asked for, both included.
pub type Random<'a> = &'a mut dyn FnMut(u64) -> u64;

/// Words that say something to the reader, or that are bytes.
fn is_kept(word: &str) -> bool {
    const SAYING: &[&str] = &[
        "adu",
        "answer",
        "anfrage",
        "antwort",
        "ask",
        "buffer",
        "bytes",
        "check",
        "client",
        "cmd",
        "command",
        "crc",
        "flush",
        "frame",
        "garbage",
        "gesendet",
        "empfangen",
        "hex",
        "in",
        "input",
        "junk",
        "leftover",
        "lrc",
        "master",
        "message",
        "modbus",
        "out",
        "output",
        "packet",
        "payload",
        "pdu",
        "query",
        "cerere",
        "răspuns",
        "raw",
        "read",
        "reading",
        "recd",
        "receive",
        "received",
        "receiving",
        "recv",
        "replies",
        "reply",
        "req",
        "request",
        "requests",
        "resp",
        "respond",
        "responds",
        "response",
        "rtu",
        "rx",
        "rxd",
        "sc",
        "send",
        "sende",
        "sending",
        "sends",
        "sent",
        "server",
        "skipped",
        "slave",
        "stale",
        "tcp",
        "telegram",
        "telegramm",
        "thrown",
        "transmit",
        "tx",
        "txd",
        "unexpected",
        "write",
        "writing",
        "written",
        "wrote",
        "discarded",
        "discarding",
        "dropped",
        "dropping",
        "ignored",
        "ignoring",
        "abfrage",
        "answered",
        "answers",
        "antwortet",
        "asks",
        "checksum",
        "empfang",
        "com",
        "dev",
        "tty",
        "push",
        "from",
        "buf",
        "data",
        "length",
        "len",
    ];
    let small = word.to_ascii_lowercase();
    let hex = |word: &str| word.chars().all(|c| c.is_ascii_hexdigit());
    word.len() < 3
        || hex(small.trim_end_matches('h'))
        || word.chars().all(|c| c.is_ascii_hexdigit())
        || SAYING.iter().any(|said| small.starts_with(said))
}

/// Takes other words for those that say nothing: the same one for the same one, as long, and in the same case.
pub fn other_words(text: &str, random: Random) -> String {
    const LETTERS: &[u8] = b"gjkmnopqruvwyz";
    let mut words: Vec<(String, String)> = Vec::new();
    let mut changed = String::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let length = rest.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(rest.len());
        let (word, behind) = rest.split_at(length.max(first.len_utf8()));
        let letters = length > 0 && word.chars().all(|c| c.is_ascii_alphabetic());
        // What stands in a string or a path belongs to it.
        let free =
            !changed.ends_with(['\\', '%', '&', '$', '#', '_']) && !behind.starts_with(['"', '\'', '_', '#']);
        match letters && free && !is_kept(word) {
            true => {
                let known = words.iter().find(|(old, _)| old.eq_ignore_ascii_case(word));
                let other = known.map(|(_, new)| new.clone()).unwrap_or_else(|| {
                    let new =
                        (0..word.len()).map(|_| LETTERS[random(LETTERS.len() as u64 - 1) as usize] as char);
                    let new: String = new.collect();
                    words.push((word.to_owned(), new.clone()));
                    new
                });
                let capital = |(old, new): (char, char)| {
                    if old.is_ascii_uppercase() { new.to_ascii_uppercase() } else { new }
                };
                changed.extend(word.chars().zip(other.chars()).map(capital));
            }
            false => changed.push_str(word),
        }
        rest = behind;
    }
    changed
}

/// Sets all clocks on by the same time.
pub fn other_times(text: &str, random: Random) -> String {
    let (hours, minutes) = (random(22) + 1, random(58) + 1);
    let bytes = text.as_bytes();
    let mut changed = text.as_bytes().to_vec();
    let two = |at: usize| -> Option<u64> { std::str::from_utf8(bytes.get(at..at + 2)?).ok()?.parse().ok() };
    let apart = |at: Option<&u8>| at.is_none_or(|c| !c.is_ascii_alphanumeric() && *c != b':');
    for at in 0..bytes.len() {
        let colons = bytes.get(at + 2) == Some(&b':') && bytes.get(at + 5) == Some(&b':');
        let (Some(hour), Some(minute), Some(_)) = (two(at), two(at + 3), two(at + 6)) else { continue };
        let alone = apart(at.checked_sub(1).map(|before| &bytes[before])) && apart(bytes.get(at + 8));
        if colons && alone && hour < 24 && minute < 60 {
            let late = (hour * 60 + minute + hours * 60 + minutes) % (24 * 60);
            changed[at..at + 5].copy_from_slice(format!("{:02}:{:02}", late / 60, late % 60).as_bytes());
        }
    }
    String::from_utf8(changed).unwrap_or_else(|_| text.to_owned())
}

/// Writes bytes of two digits in small letters, or in capital ones.
pub fn other_case(text: &str, random: Random) -> String {
    let small = random(1) == 0;
    let mut changed = text.as_bytes().to_vec();
    for at in pairs(text) {
        let pair = &mut changed[at..at + 2];
        if small { pair.make_ascii_lowercase() } else { pair.make_ascii_uppercase() }
    }
    String::from_utf8(changed).unwrap_or_else(|_| text.to_owned())
}

/// Puts blanks behind lines, and another line end.
pub fn other_ends(text: &str, random: Random) -> String {
    let end = ["\n", "\r\n", " \n", "  \r\n", "\t\n"][random(4) as usize];
    text.lines().map(|line| format!("{line}{end}")).collect()
}

/// Indents all lines, quotes them, or wraps them as a list of a markdown text does.
pub fn other_beginnings(text: &str, random: Random) -> String {
    let before = ["\t", "  ", "> ", "    "][random(3) as usize];
    text.lines().map(|line| format!("{before}{line}\n")).collect()
}

/// Puts another separator between the bytes of two digits that have a blank.
pub fn other_separators(text: &str, random: Random) -> String {
    let mark = ["  ", "-", "\t", ", "][random(3) as usize];
    let places = pairs(text);
    let mut changed = String::new();
    let mut done = 0;
    // What stands behind the bytes of a row of a dump would be parted in another way.
    let ends = |at: usize| {
        let line = text[at..].lines().next().unwrap_or_default();
        line.trim_end().chars().all(|c| c.is_ascii_hexdigit() || c == ' ')
    };
    for (at, next) in places.iter().zip(places.iter().skip(1)) {
        if *next == at + 3 && text.as_bytes()[at + 2] == b' ' && ends(*at) {
            changed.push_str(&text[done..at + 2]);
            changed.push_str(mark);
            done = *next;
        }
    }
    changed + &text[done..]
}

/// Where bytes of two digits stand by themselves, at least one of them a digit. Characters behind the bytes of a row
/// are none.
fn pairs(text: &str) -> Vec<usize> {
    let bytes = text.as_bytes();
    let is_word = |at: usize| bytes.get(at).is_some_and(|c| c.is_ascii_alphanumeric() || *c >= 0x80);
    let column = |at: usize| {
        let line = &text[text[..at].rfind('\n').map_or(0, |end| end + 1)..at];
        line.trim_start().contains("   ")
    };
    (0..bytes.len().saturating_sub(1))
        .filter(|at| bytes[*at..at + 2].iter().all(u8::is_ascii_hexdigit))
        .filter(|at| (*at == 0 || !is_word(at - 1)) && !is_word(at + 2))
        .filter(|at| bytes[*at..at + 2].iter().any(u8::is_ascii_digit))
        .filter(|at| !column(*at))
        .collect()
}

/// Takes another unit, and in answers other data, for a telegram with a right CRC.
pub fn other_bytes(telegram: &[u8], units: &[u8; 256], random: Random) -> Vec<u8> {
    let mut body = telegram[..telegram.len() - 2].to_vec();
    body[0] = units[usize::from(body[0])];
    let data = match body[1..] {
        [1..=4, count, ..] if usize::from(count) + 3 == body.len() => 3..body.len(),
        // An address, and not the quantity behind it.
        [1..=4, _, _, _, _] => 3..4,
        _ => 0..0,
    };
    for byte in &mut body[data] {
        *byte = random(255) as u8;
    }
    let check = (CRC_16_MODBUS.wire(&body) as u16).to_be_bytes();
    [body.as_slice(), &check].concat()
}

/// Writes `new` wherever `old` stands in hex digits, with whatever is between them.
pub fn replaced(text: &str, old: &[u8], new: &[u8]) -> String {
    let digits: Vec<(usize, u8)> = text.bytes().enumerate().filter(|(_, c)| c.is_ascii_hexdigit()).collect();
    let wanted: Vec<u8> = old.iter().flat_map(|byte| format!("{byte:02X}").into_bytes()).collect();
    let given: Vec<u8> = new.iter().flat_map(|byte| format!("{byte:02X}").into_bytes()).collect();
    let mut changed = text.as_bytes().to_vec();
    let mut at = 0;
    while at + wanted.len() <= digits.len() {
        let part = &digits[at..at + wanted.len()];
        // A byte's digits stand together, and no letters are between bytes.
        let whole = part.chunks(2).all(|pair| pair[1].0 == pair[0].0 + 1);
        let gap = |pair: &[(usize, u8)]| {
            !text.as_bytes()[pair[0].0 + 1..pair[1].0].iter().any(u8::is_ascii_alphanumeric)
        };
        let same = part.iter().zip(&wanted).all(|((_, c), wanted)| c.to_ascii_uppercase() == *wanted);
        if whole && same && part.windows(2).all(gap) {
            for ((place, old), new) in part.iter().zip(&given) {
                changed[*place] = if old.is_ascii_lowercase() { new.to_ascii_lowercase() } else { *new };
            }
            at += wanted.len();
        } else {
            at += 1;
        }
    }
    String::from_utf8(changed).unwrap_or_else(|_| text.to_owned())
}
