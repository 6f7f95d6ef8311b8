use std::path::Path;

use buslens::tool::{Options, decode};

/// What inputs are made of.
#[derive(Debug, Default)]
pub struct Seeds {
    /// Telegrams, as bytes.
    pub telegrams: Vec<Vec<u8>>,
}

impl Seeds {
    /// The telegrams of the library's vectors.
    pub fn load() -> std::io::Result<Self> {
        let mut seeds = Self::default();
        let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates/buslens/tests/vectors")];
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
