use std::path::Path;

use buslens::tool::{Editor, Offer, Options, PROFILES, PROTOCOLS, Profile, Settings, decode};

/// What inputs are made of.
#[derive(Debug, Default)]
pub struct Seeds {
    /// Telegrams, as bytes.
    pub telegrams: Vec<Vec<u8>>,
    /// What can be asked of each device.
    pub exchanges: Vec<Vec<Exchange>>,
    /// What somebody types who looks for something to build, and the names of the manuals.
    pub sentences: Vec<String>,
}

/// A request with what can come back.
#[derive(Debug)]
pub struct Exchange {
    pub request: Vec<u8>,
    pub replies: Vec<Vec<u8>>,
}

impl Seeds {
    /// The telegrams of the library's vectors, and what its devices understand.
    pub fn load() -> std::io::Result<Self> {
        let tests = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates/buslens/tests");
        let mut seeds = Self {
            exchanges: PROFILES.iter().copied().map(exchanges).collect(),
            sentences: sentences(&std::fs::read_to_string(tests.join("manuals/words.tsv"))?),
            ..Self::default()
        };
        let mut folders = vec![tests.join("vectors")];
        let mut paths = Vec::new();
        while let Some(folder) = folders.pop() {
            for entry in std::fs::read_dir(folder)? {
                let path = entry?.path();
                if path.is_dir() { folders.push(path) } else { paths.push(path) }
            }
        }
        // Folders are listed in any order, and a seed of random numbers is to tell everything.
        paths.sort();
        for path in paths {
            let text = std::fs::read_to_string(path)?;
            let told = |key: &str| text.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix(": "));
            let before = told("before").unwrap_or_default().replace('|', "\n");
            let text = format!("{before}\n{}", told("hex").unwrap_or_default());
            let telegrams = decode(&text, Options::default()).telegrams;
            seeds.telegrams.extend(telegrams.into_iter().map(|telegram| telegram.line.bytes));
        }
        seeds.telegrams.sort();
        seeds.telegrams.dedup();
        Ok(seeds)
    }
}

/// Everything that can be asked of a device, as it is built with nothing filled in.
fn exchanges(device: &'static Profile) -> Vec<Exchange> {
    let settings = Settings::default();
    let exchange = |task| {
        let editors = PROTOCOLS
            .iter()
            .filter_map(|protocol| Editor::new(Offer::Task(task), 5, protocol, &settings).ok());
        editors
            .filter_map(|mut editor| {
                let replies = editor.replies(&settings).into_iter().map(|(_, bytes)| bytes).collect();
                Some(Exchange { request: editor.bytes().ok()?, replies })
            })
            .next()
    };
    device.tasks().into_iter().filter_map(exchange).collect()
}

/// The words of a table of searches, and every name of the manuals.
fn sentences(table: &str) -> Vec<String> {
    let typed = table.lines().filter_map(|line| line.split('\t').nth(1)).map(str::to_owned);
    let areas = PROFILES.iter().flat_map(|profile| profile.areas).map(|area| area.spec.label.to_owned());
    let parameters = PROFILES
        .iter()
        .flat_map(|profile| profile.parameters())
        .flat_map(|parameter| [parameter.id, parameter.spec.label].map(str::to_owned));
    let mut all: Vec<String> = typed.chain(areas).chain(parameters).filter(|text| !text.is_empty()).collect();
    all.sort();
    all.dedup();
    all
}

/// The words of sentences.
pub const ASKED: &[&str] = &[
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
    "40",
    "0",
    "123.456",
    "-1500",
    "1e9",
    "0x5F00",
    "2033h",
    "40001",
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
    "999999999999",
    "“",
    "function",
    "reset",
    "unit",
    "all",
    "bits",
    "parameter",
    "reference",
    "value",
    "status",
    "float",
    "and",
    "of",
    ",",
];

/// What stands in texts, logs, links and settings.
pub const WORDS: &[&str] = &[
    " ",
    "  ",
    "\n",
    "\r\n",
    "\r",
    "\t",
    ",",
    ";",
    ":",
    "|",
    "-",
    ".",
    "..",
    "'",
    "\"",
    "\\",
    "\\x",
    "\\x0",
    "0x",
    "0X",
    "h",
    "H",
    "$",
    "&H",
    "#",
    "//",
    "/*",
    "*/",
    "{",
    "}",
    "[",
    "]",
    "(",
    ")",
    "<",
    ">",
    "->",
    "<-",
    "=>",
    "→",
    "←",
    "TX",
    "RX",
    "Tx:",
    "Rx:",
    ">>",
    "<<",
    "send",
    "received",
    "request",
    "response",
    "master",
    "slave",
    "Unit 7",
    "12:34:56.789",
    "2026-11-27T08:09:10.123456Z",
    "1775000000.000001",
    "[0.000125]",
    "00000000  ",
    "0000: ",
    "00000010",
    "len=8",
    "8 bytes",
    "port=502",
    "COM3",
    "10.0.0.5:49152 > 10.0.0.9:502",
    "CRC error",
    "timeout",
    "FF",
    "00",
    "0",
    "1",
    "01 03 00 C8 00 03 84 35",
    "010300C80003",
    ":010300C80003",
    ":0103",
    "68 08 08 68",
    "E5",
    "b'\\x01\\x03'",
    "byte[] x = { 0x01, 0x03 };",
    "é",
    "\u{1F600}",
    "\u{FEFF}",
    "\u{2212}1",
    "１",
    "٣",
    "\0",
    "20000000000000.0",
    "0xx",
    "99999999999999999999",
    "-1",
    "1e9",
    "NaN",
    "65535",
    "65536",
    "256",
    "255",
    "device=",
    "protocol=",
    "text=",
    "telegram=",
    "settings=",
    "task=",
    ".unit=",
    ".values=",
    "&",
    "=",
    "%",
    "+",
    "%0A",
    "%E0%A4%A",
    "keb-f5-modbus",
    "keb-f5-profibus",
    "memograph-rsg45",
    "modbus-rtu",
    "modbus-tcp",
    "modbus-ascii",
    "profibus-fdl",
    "read_mapping.entries = 255",
    "write_mapping.entries.0.entry = 00330101h",
    "read_mapping.start = 16",
    "process_output.words = 2",
    "process_output.words.0.index = 2034h",
    "process_input.words.1.sets = 01h",
    "profibus = swap process data, no parameter channel",
    "inputs = 8",
    "outputs = 17",
    "dialect = 1",
    "universal channel 6",
    "Sy.51",
    "batch",
    "limit",
    "control word",
    "215 write",
];
