//! The layouts that are known by name. They are all read alike: a name tells a person that the log
//! was understood, and in some it tells how numbers are written.

use super::line::Numbers;

/// How a program writes its log.
#[derive(Debug)]
pub struct Layout {
    /// Stable word of settings and exports.
    pub key: &'static str,
    pub name: &'static str,
    /// What is in its lines. `#` stands for a digit, `@` for a hex digit, `^` at the beginning for
    /// the beginning of the line, blanks before it aside.
    pub signs: &'static [&'static str],
    /// How numbers are written, where the layout says it.
    pub numbers: Option<Numbers>,
}

/// Every layout. Where a line shows several, the first one counts.
pub static LAYOUTS: &[Layout] = &[
    layout("qmodmaster", "QModMaster bus monitor", &["[RTU]>Tx >", "[RTU]>Rx >", "[TCP]>Tx >", "[TCP]>Rx >"]),
    layout(
        "modbus-poll",
        "Modbus Poll or Modbus Slave, communication traffic",
        &["^######-Tx:", "^######-Rx:"],
    ),
    layout(
        "libmodbus",
        "libmodbus, debug output",
        &["Waiting for a confirmation", "^[@@][@@][", "^<@@><@@><"],
    ),
    layout("pymodbus", "pymodbus, debug log", &["[pymodbus.", "pymodbus.logging", "pymodbus.transaction"]),
    layout("minimalmodbus", "MinimalModbus, debug mode", &["MinimalModbus debug mode"]),
    layout("modbus-tk", "modbus_tk, debug log", &["modbus_tk"]),
    layout("esphome-uart", "ESPHome, UART debugger", &["[uart_debug:"]),
    layout("esphome-modbus", "ESPHome, Modbus", &["][modbus:", "][modbus_controller:"]),
    Layout {
        numbers: Some(Numbers::Decimal),
        ..layout("nmodbus", "NModbus, log", &["Modbus.IO.Modbus", "NModbus"])
    },
    layout("serial-port-monitor", "serial port monitor, dump view", &["Written data (", "Read data ("]),
    layout("raw-request", "requests and responses as arrays of C", &["Raw Request >>>", "Raw Response <<<"]),
    layout(
        "rust-debug",
        "byte lists of Rust's debug format",
        &["tx [@@, @@", "rx [@@, @@", "TX [@@, @@", "RX [@@, @@"],
    ),
    layout("modbus-ascii", "Modbus ASCII, a frame a line", &["^:@@@@@@@@"]),
    layout("xxd", "xxd, a hex dump", &["^@@@@@@@@: @@@@ @@@@", "^@@@@@@@@: @@ @@ @@", "^@@@@@@@@: @@@@"]),
    layout("tcpdump", "tcpdump -x, packets as hex dumps", &["^0x@@@@:  @@@@ @@@@"]),
    layout("hexdump", "hexdump -C, a hex dump", &["^@@@@@@@@  @@ @@", "^@@@@@@@@  @@  |"]),
    layout(
        "wireshark",
        "Wireshark, packets as hex dumps",
        &["^@@@@   @@ @@", "^@@@@  @@ @@", "^@@@@   @@  "],
    ),
    layout(
        "od",
        "od, a dump",
        &["^####### @@ @@", "^####### @@@@ @@@@", "^####### ### ###", "^####### ###### ######"],
    ),
];

const fn layout(key: &'static str, name: &'static str, signs: &'static [&'static str]) -> Layout {
    Layout { key, name, signs, numbers: None }
}

impl Layout {
    /// The layout with this key.
    pub fn of(key: &str) -> Option<&'static Self> {
        LAYOUTS.iter().find(|layout| layout.key == key)
    }

    /// The layouts that a line shows, by their places in [`LAYOUTS`]: a bit for each.
    pub fn shown(line: &[u8]) -> u32 {
        let start = line.len() - line.trim_ascii_start().len();
        let begins = line.get(start).map_or(0, |c| BEGIN[usize::from(*c)]);
        let mut shown = 0;
        for (at, c) in line.iter().enumerate() {
            let anchored = if at == start { begins } else { 0 };
            let mut may_show = (WITHIN[usize::from(*c)] | anchored) & !shown;
            while may_show != 0 {
                let index = may_show.trailing_zeros();
                may_show &= may_show - 1;
                let mut signs = LAYOUTS[index as usize].signs.iter().map(|sign| sign.as_bytes());
                let is_here = |sign: &[u8]| match sign {
                    [b'^', sign @ ..] => at == start && like(&line[at..], sign),
                    sign => like(&line[at..], sign),
                };
                shown |= u32::from(signs.any(is_here)) << index;
            }
        }
        shown
    }
}

/// The layouts with a sign that may begin with a character at the beginning of a line, and anywhere in it: a bit for
/// each.
static BEGIN: [u32; 256] = first_characters(true);
static WITHIN: [u32; 256] = first_characters(false);

const fn first_characters(anchored: bool) -> [u32; 256] {
    let mut layouts = [0; 256];
    let mut c = 0;
    while c < layouts.len() {
        let mut index = 0;
        while index < LAYOUTS.len() {
            let mut nth = 0;
            while nth < LAYOUTS[index].signs.len() {
                let sign = LAYOUTS[index].signs[nth].as_bytes();
                let is_anchored = sign[0] == b'^';
                let first = sign[is_anchored as usize];
                if is_anchored == anchored && stands_for(first, c as u8) {
                    layouts[c] |= 1 << index;
                }
                nth += 1;
            }
            index += 1;
        }
        c += 1;
    }
    layouts
}

/// An export that names telegrams without giving their bytes.
#[derive(Debug)]
pub struct Export {
    pub name: &'static str,
    /// What to export instead.
    pub instead: &'static str,
    /// As in [`Layout::signs`], in one of the first lines.
    signs: &'static [&'static str],
}

/// The exports that hold no bytes.
pub static EXPORTS: &[Export] = &[
    Export {
        name: "Wireshark's packet list",
        instead: "save the capture itself (pcapng), or export with “Packet Bytes”",
        signs: &["\"No.\",\"Time\",\"Source\"", "^No.     Time", "No.,Time,Source"],
    },
    Export {
        name: "a log of Zeek",
        instead: "open the capture that Zeek read (pcap)",
        signs: &["separator \\x09", "\"id.orig_h\""],
    },
];

/// The export that a file beginning with `text` is, if it is one without bytes.
pub fn export(text: &[u8]) -> Option<&'static Export> {
    let mut lines = text.split(|c| *c == b'\n').take(5);
    lines.find_map(|line| {
        EXPORTS.iter().find(|export| export.signs.iter().any(|sign| has(line, sign.as_bytes())))
    })
}

/// Whether `sign` is in `line`.
fn has(line: &[u8], sign: &[u8]) -> bool {
    match sign {
        [b'^', sign @ ..] => like(line.trim_ascii_start(), sign),
        _ => (0..line.len()).any(|at| like(&line[at..], sign)),
    }
}

/// Whether a text begins with `sign`.
fn like(text: &[u8], sign: &[u8]) -> bool {
    text.len() >= sign.len() && sign.iter().zip(text).all(|(sign, c)| stands_for(*sign, *c))
}

/// Whether a character of a sign stands for another one.
const fn stands_for(sign: u8, c: u8) -> bool {
    match sign {
        b'#' => c.is_ascii_digit(),
        b'@' => c.is_ascii_hexdigit(),
        sign => sign == c,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_are_found() {
        assert!(has(b"000017-Tx:01 03", b"^######-Tx:"));
        assert!(!has(b"00001x-Tx:01 03", b"^######-Tx:"));
        assert!(has(b"[x TRACE bus] tx [02, 64, 00]", b"tx [@@, @@"));
        assert!(!has(b"tx [2, 100]", b"tx [@@, @@"));
    }

    #[test]
    fn exports_without_bytes_are_named() {
        let named = |text: &str| export(text.as_bytes()).map(|export| export.name);
        assert_eq!(
            named("\"No.\",\"Time\",\"Source\",\"Destination\"\n\"1\""),
            Some("Wireshark's packet list")
        );
        assert_eq!(named("#separator \\x09\n#set_separator\t,"), Some("a log of Zeek"));
        assert_eq!(named("01 03 00 C8"), None);
    }

    #[test]
    fn keys_are_unique() {
        for (index, layout) in LAYOUTS.iter().enumerate() {
            assert!(LAYOUTS[index + 1..].iter().all(|other| other.key != layout.key), "{}", layout.key);
            assert_eq!(Layout::of(layout.key).map(|found| found.name), Some(layout.name));
        }
    }
}
