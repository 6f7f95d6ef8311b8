//! Programs that write logs, each in its own layout.

use std::fmt::Write as _;

use buslens::field::hex;

use super::generator::Sent;

/// How a program writes telegrams.
pub struct Program {
    /// The key of the layout, where it is one of those known by name.
    pub layout: &'static str,
    pub frame: fn(&Sent, usize) -> Vec<u8>,
    /// One telegram; the number counts them.
    pub write: fn(&mut String, &[u8], bool, usize),
}

fn rtu(sent: &Sent, _: usize) -> Vec<u8> {
    sent.rtu()
}

fn tcp(sent: &Sent, n: usize) -> Vec<u8> {
    sent.tcp(n as u16 / 2 + 1)
}

pub fn joined(bytes: &[u8], separator: &str, write: fn(u8) -> String) -> String {
    bytes.iter().map(|byte| write(*byte)).collect::<Vec<_>>().join(separator)
}

pub fn upper(byte: u8) -> String {
    format!("{byte:02X}")
}

pub fn lower(byte: u8) -> String {
    format!("{byte:02x}")
}

pub fn clock(n: usize) -> String {
    format!("{:02}:{:02}:{:02}", 9 + n / 3600, n / 60 % 60, n % 60)
}

fn rows(text: &mut String, bytes: &[u8], offset: Option<usize>, width: usize) {
    for (row, part) in bytes.chunks(16).enumerate() {
        if let Some(width) = offset {
            write!(text, "{:0width$x}   ", row * 16).unwrap();
        } else {
            text.push_str("    ");
        }
        let shown: String = part
            .iter()
            .map(|byte| if matches!(byte, b' '..=b'~') { char::from(*byte) } else { '.' })
            .collect();
        writeln!(text, "{:width$}   {shown}", joined(part, " ", lower)).unwrap();
    }
}

/// The layouts known by name, and others that resemble none of them.
pub static PROGRAMS: &[Program] = &[
    Program {
        layout: "raw-request",
        frame: rtu,
        write: |text, bytes, asks, _| {
            let list = joined(bytes, ", ", |byte| format!("0x{byte:02X}"));
            let words = if asks { "Raw Request >>>" } else { "Raw Response <<<" };
            writeln!(text, "{words} {{{list}}}").unwrap();
        },
    },
    Program {
        layout: "esphome-modbus",
        frame: rtu,
        write: |text, bytes, asks, n| {
            let word = if asks { "write" } else { "recv" };
            let list = joined(bytes, ".", upper);
            writeln!(text, "[{}][V][modbus:199]: Modbus {word}: {list} ({})", clock(n), bytes.len()).unwrap();
        },
    },
    Program {
        layout: "esphome-uart",
        frame: rtu,
        write: |text, bytes, asks, n| {
            let arrow = if asks { ">>>" } else { "<<<" };
            writeln!(text, "[{}][D][uart_debug:158]: {arrow} {}", clock(n), joined(bytes, ":", upper))
                .unwrap();
        },
    },
    Program {
        layout: "libmodbus",
        frame: rtu,
        write: |text, bytes, asks, _| {
            if asks {
                writeln!(text, "[{}]\nWaiting for a confirmation...", joined(bytes, "][", upper)).unwrap();
            } else {
                writeln!(text, "<{}>", joined(bytes, "><", upper)).unwrap();
            }
        },
    },
    Program {
        layout: "minimalmodbus",
        frame: rtu,
        write: |text, bytes, asks, _| {
            let list = joined(bytes, " ", upper);
            let count = bytes.len();
            if asks {
                writeln!(text, "MinimalModbus debug mode. Will write to instrument (expecting 9 bytes back): {list} ({count} bytes)").unwrap();
            } else {
                writeln!(text, "MinimalModbus debug mode. Response from instrument: {list} ({count} bytes), roundtrip time: 8.4 ms. Timeout for reading: 50.0 ms.").unwrap();
            }
        },
    },
    Program {
        layout: "modbus-ascii",
        frame: |sent, _| sent.ascii(),
        write: |text, bytes, _, _| writeln!(text, ":{}", joined(bytes, "", upper)).unwrap(),
    },
    Program {
        layout: "modbus-poll",
        frame: rtu,
        write: |text, bytes, asks, n| {
            writeln!(text, "{n:06}-{}:{}", if asks { "Tx" } else { "Rx" }, joined(bytes, " ", upper))
                .unwrap();
        },
    },
    Program {
        layout: "modbus-tk",
        frame: tcp,
        write: |text, bytes, asks, _| {
            let arrow = if asks { "->" } else { "<-" };
            writeln!(text, "DEBUG:modbus_tk:{arrow} {}", joined(bytes, "-", lower)).unwrap();
        },
    },
    Program {
        layout: "nmodbus",
        frame: rtu,
        write: |text, bytes, asks, _| {
            let list = joined(bytes, ", ", |byte| byte.to_string());
            writeln!(
                text,
                "DEBUG Modbus.IO.ModbusSerialTransport - {}: {list}",
                if asks { "TX" } else { "RX" }
            )
            .unwrap();
        },
    },
    Program { layout: "", frame: rtu, write: |text, bytes, _, _| writeln!(text, "{}", hex(bytes)).unwrap() },
    Program {
        layout: "",
        frame: rtu,
        write: |text, bytes, _, _| writeln!(text, "{}", joined(bytes, "", lower)).unwrap(),
    },
    Program {
        layout: "pymodbus",
        frame: rtu,
        write: |text, bytes, asks, n| {
            let list = joined(bytes, " ", |byte| format!("{byte:#x}"));
            let word = if asks { "SEND" } else { "RECV" };
            writeln!(
                text,
                "2026-04-01 {}.{:03} DEBUG (Worker_2) [pymodbus.transaction] {word}: {list}",
                clock(n),
                n % 1000
            )
            .unwrap();
        },
    },
    Program {
        layout: "pymodbus",
        frame: tcp,
        write: |text, bytes, asks, n| {
            let list = joined(bytes, " ", |byte| format!("{byte:#x}"));
            let tail = if asks { "" } else { " old_data:  addr=None" };
            let word = if asks { "send" } else { "recv" };
            writeln!(
                text,
                "2026-04-01 {}.120 DEBUG (MainThread) [pymodbus.logging] {word}: {list}{tail}",
                clock(n)
            )
            .unwrap();
        },
    },
    Program {
        layout: "qmodmaster",
        frame: rtu,
        write: |text, bytes, asks, n| {
            let word = if asks { "Tx" } else { "Rx" };
            writeln!(text, "[RTU]>{word} > {}:{:03} - {}  ", clock(n), n % 1000, joined(bytes, "  ", upper))
                .unwrap();
        },
    },
    Program {
        layout: "rust-debug",
        frame: rtu,
        write: |text, bytes, asks, n| {
            let word = if asks { "tx" } else { "rx" };
            writeln!(text, "[2026-04-01T{}Z TRACE line] {word} [{}]", clock(n), joined(bytes, ", ", upper))
                .unwrap();
        },
    },
    Program {
        layout: "serial-port-monitor",
        frame: rtu,
        write: |text, bytes, asks, n| {
            writeln!(text, "[01/04/2026 {}] {} data (COM3)", clock(n), if asks { "Written" } else { "Read" })
                .unwrap();
            rows(text, bytes, None, 47);
            text.push('\n');
        },
    },
    Program {
        layout: "wireshark",
        frame: tcp,
        write: |text, bytes, _, _| {
            rows(text, bytes, Some(4), 47);
            text.push('\n');
        },
    },
    // From here on: nobody's.
    Program {
        layout: "",
        frame: rtu,
        write: |text, bytes, asks, n| {
            let way = if asks {
                "192.168.0.10:49152 -> 10.0.0.7:4001"
            } else {
                "10.0.0.7:4001 -> 192.168.0.10:49152"
            };
            let word = if asks { "request" } else { "response" };
            writeln!(
                text,
                "#{n} {} [thread-7] INFO {way} {word} len={} data={}",
                clock(n),
                bytes.len(),
                joined(bytes, " ", lower)
            )
            .unwrap();
        },
    },
    Program {
        layout: "",
        frame: rtu,
        write: |text, bytes, asks, n| {
            writeln!(
                text,
                "{}.{:06} {} {}: {}",
                1_775_000_000 + n,
                n,
                bytes.len(),
                if asks { "OUT" } else { "IN" },
                joined(bytes, "-", upper)
            )
            .unwrap();
        },
    },
    Program {
        layout: "",
        frame: rtu,
        write: |text, bytes, asks, _| {
            let escapes: String = bytes.iter().map(|byte| format!("\\x{byte:02x}")).collect();
            writeln!(text, "{} b'{escapes}'", if asks { "write" } else { "read" }).unwrap();
        },
    },
    Program {
        layout: "",
        frame: rtu,
        write: |text, bytes, asks, n| {
            writeln!(
                text,
                "{};{};{};ok",
                clock(n),
                if asks { "master" } else { "slave" },
                joined(bytes, " ", |byte| format!("{byte:02X}h"))
            )
            .unwrap();
        },
    },
    Program {
        layout: "",
        frame: rtu,
        write: |text, bytes, asks, n| {
            writeln!(
                text,
                "{} ({}) at {}",
                joined(bytes, " ", upper),
                if asks { "sent" } else { "received" },
                clock(n)
            )
            .unwrap();
        },
    },
    Program {
        layout: "",
        frame: rtu,
        write: |text, bytes, asks, n| {
            writeln!(
                text,
                "{} {}\n{}",
                if asks { "Request at" } else { "Response at" },
                clock(n),
                hex(bytes)
            )
            .unwrap();
        },
    },
    Program {
        layout: "",
        frame: rtu,
        write: |text, bytes, asks, _| {
            // In chunks, as a port gives them.
            for part in bytes.chunks(8) {
                writeln!(text, "{} {}", if asks { "TX" } else { "RX" }, joined(part, " ", upper)).unwrap();
            }
        },
    },
    Program {
        layout: "",
        frame: rtu,
        write: |text, bytes, asks, n| {
            // The count before the bytes, the direction behind the time, in the middle of a line.
            let word = if asks { "OUT" } else { "IN" };
            writeln!(text, "{}, {word}, ch 2, {:3}, {}", clock(n), bytes.len(), joined(bytes, ",", upper))
                .unwrap();
        },
    },
    Program {
        layout: "",
        frame: rtu,
        write: |text, bytes, asks, n| {
            // logfmt, the digits without anything between.
            writeln!(
                text,
                "ts=2026-04-01T{}.{:03}Z level=debug dir={} len={} hex={}",
                clock(n),
                n % 1000,
                if asks { "tx" } else { "rx" },
                bytes.len(),
                joined(bytes, "", lower)
            )
            .unwrap();
        },
    },
    Program {
        layout: "",
        frame: rtu,
        write: |text, bytes, asks, n| {
            // An object of JSON in each line.
            writeln!(
                text,
                "{{\"time\":\"2026-04-01T{}.{:03}+01:00\",\"kind\":\"{}\",\"data\":\"{}\"}}",
                clock(n),
                n % 1000,
                if asks { "request" } else { "response" },
                joined(bytes, " ", upper)
            )
            .unwrap();
        },
    },
    Program {
        layout: "",
        frame: rtu,
        write: |text, bytes, asks, n| {
            // strace of a serial port.
            let escapes: String = bytes.iter().map(|byte| format!("\\x{byte:02x}")).collect();
            let count = bytes.len();
            if asks {
                writeln!(text, "{}.{:06} write(3, \"{escapes}\", {count}) = {count}", clock(n), n).unwrap();
            } else {
                writeln!(text, "{}.{:06} read(3, \"{escapes}\", 256) = {count}", clock(n), n).unwrap();
            }
        },
    },
    Program {
        layout: "",
        frame: rtu,
        write: |text, bytes, asks, n| {
            // Decimal numbers with odd separators.
            let list = joined(bytes, " ; ", |byte| byte.to_string());
            writeln!(text, "{} | {} | {list}", clock(n), if asks { "send" } else { "recv" }).unwrap();
        },
    },
    Program {
        layout: "",
        frame: rtu,
        write: |text, bytes, asks, _| {
            // As a list in a program's code, three digits each.
            let list = joined(bytes, " ", |byte| format!("{byte:03}"));
            writeln!(text, "{} {list}", if asks { "Tx:" } else { "Rx:" }).unwrap();
        },
    },
    Program {
        layout: "",
        frame: rtu,
        write: |text, bytes, asks, n| {
            // The kernel's way to print: seconds since the start.
            writeln!(
                text,
                "[{:5}.{:06}] ttyUSB0: {} {}",
                12 + n / 100,
                n % 100 * 10_000,
                if asks { "TX" } else { "RX" },
                joined(bytes, " ", lower)
            )
            .unwrap();
        },
    },
    Program {
        layout: "",
        frame: rtu,
        write: |text, bytes, asks, n| {
            // syslog.
            writeln!(
                text,
                "Apr  1 {} gateway mbusd[2417]: {} ({} bytes): {}",
                clock(n),
                if asks { "request" } else { "response" },
                bytes.len(),
                joined(bytes, " ", |byte| format!("0x{byte:02x}"))
            )
            .unwrap();
        },
    },
    Program {
        layout: "",
        frame: rtu,
        write: |text, bytes, asks, n| {
            // A date as Germans write it, and the bytes in brackets each.
            writeln!(
                text,
                "01.04.2026 {},{:03}  {}  [{}]",
                clock(n),
                n % 1000,
                if asks { "==>" } else { "<==" },
                joined(bytes, "] [", upper)
            )
            .unwrap();
        },
    },
    Program {
        layout: "",
        frame: rtu,
        write: |text, bytes, asks, n| {
            // Columns parted by tabs, a counter first.
            writeln!(
                text,
                "{n}\t{}\t{}\t{}\tOK",
                clock(n),
                if asks { "Request" } else { "Answer" },
                joined(bytes, " ", upper)
            )
            .unwrap();
        },
    },
    Program {
        layout: "",
        frame: tcp,
        write: |text, bytes, asks, n| {
            let (from, to) =
                if asks { ("10.0.0.5:50112", "10.0.0.9:502") } else { ("10.0.0.9:502", "10.0.0.5:50112") };
            writeln!(
                text,
                "{} {from} > {to}: {} {}",
                clock(n),
                if asks { "query" } else { "response" },
                joined(bytes, " ", lower)
            )
            .unwrap();
        },
    },
    Program {
        layout: "",
        frame: rtu,
        write: |text, bytes, asks, n| {
            // A header line, then rows of eight bytes.
            writeln!(text, "{} {} {} bytes", clock(n), if asks { "TX" } else { "RX" }, bytes.len()).unwrap();
            for part in bytes.chunks(8) {
                writeln!(text, "  {}", joined(part, " ", upper)).unwrap();
            }
            text.push('\n');
        },
    },
    Program {
        layout: "",
        frame: rtu,
        write: |text, bytes, asks, n| {
            // Arrows of Unicode, milliseconds since 1970, words of two bytes.
            let words: Vec<String> = bytes.chunks(2).map(|pair| joined(pair, "", upper)).collect();
            writeln!(
                text,
                "{}{:03} {} {}",
                1_775_000_000 + n,
                n % 1000,
                if asks { "→" } else { "←" },
                words.join(" ")
            )
            .unwrap();
        },
    },
    Program {
        layout: "",
        frame: |sent, _| sent.ascii(),
        write: |text, bytes, asks, n| {
            writeln!(text, "{} {} :{}", clock(n), if asks { "TX" } else { "RX" }, joined(bytes, "", upper))
                .unwrap();
        },
    },
];
