use buslens::field::hex;
use buslens::tool::{PROFILES, Profile, Settings, search};

use super::{lines, write_lines};

/// Words typed into Build: device, words, then what comes first, and its bytes (unit 1).
pub struct Row(Vec<String>);

pub fn rows() -> Vec<Row> {
    lines("words").into_iter().map(Row).collect()
}

pub fn wrong(row: &Row) -> Option<String> {
    let found = row.found();
    (found != row.0[2..])
        .then(|| format!("“{}”:\n  expected {:?}\n  found    {found:?}", row.0[1], &row.0[2..]))
}

pub fn bless(rows: &[Row]) {
    write_lines("words", rows.iter().map(|row| [&row.0[..2], &row.found()].concat()));
}

impl Row {
    fn found(&self) -> Vec<String> {
        let found = search(&self.0[1], Profile::of(&self.0[0]));
        let Some(best) = found.first() else {
            return vec!["nothing".to_owned(), String::new(), String::new()];
        };
        let made = best.editor(1, None, &Settings::default()).and_then(|mut editor| editor.bytes());
        let bytes = made.map_or_else(|why| why.to_string(), |bytes| hex(&bytes));
        vec![best.label().sentence(), best.reason.to_string(), bytes]
    }
}

/// Whatever is found can be opened, and what the words fill in fits its form.
#[test]
fn what_is_found_can_be_built() {
    const WORDS: &[&str] = &[
        "read",
        "write",
        "set",
        "to",
        "channel",
        "digital",
        "limit",
        "batch",
        "relay",
        "good",
        "on",
        "off",
        "6",
        "123.456",
        "-1500",
        "0x5F00",
        "2033h",
        "OP.59",
        "Sy.51",
        "mapping",
        "entry",
        "event",
        "text",
        "Hello",
        ";;60",
        "5.7;10",
        "factory",
        "name",
        "start",
        "=",
        "speed",
        "8E1",
        "8",
        "999999999999",
        "“",
        "é",
        "16",
        "function",
        "reset",
    ];
    let mut state = 7_u64;
    let mut draw = |most: usize| {
        state = state.wrapping_mul(0x5851_F42D_4C95_7F2D).wrapping_add(0x1405_7B7E_F767_814F);
        (state >> 33) as usize % most
    };
    for round in 0..60 {
        let words: Vec<&str> = (0..1 + round % 6).map(|_| WORDS[draw(WORDS.len())]).collect();
        let text = words.join(" ");
        for found in search(&text, PROFILES.get(round % 4).copied()) {
            let editor = found.editor(1, None, &Settings::default());
            let editor = editor.unwrap_or_else(|why| panic!("{text}: {}: {why}", found.label()));
            let misfits = &editor.entries().misfits;
            assert!(misfits.is_empty(), "{text}: {} {:?}: {misfits:?}", found.label(), found.entries);
        }
    }
}
