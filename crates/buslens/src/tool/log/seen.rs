//! What lines tell that hold no telegram: errors that a program reports, values, other protocols. It is said
//! in the place of telegrams where there are none, and beside them where there are some.

use std::collections::BTreeMap;

use super::{Format, Input, Log, Options, Reading, Source};
use crate::dialogue::foreign::FOREIGN;
use crate::modbus::exceptions;

/// Something that lines tell.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "json", derive(serde::Serialize, serde::Deserialize))]
pub struct Seen {
    /// A sentence.
    pub text: String,
    /// The numbers of the first lines that tell it; none where it is told by pieces of any lines.
    pub lines: Vec<u32>,
    /// How many tell it.
    pub count: usize,
}

/// What a program says of an error, however it says it.
struct Sign {
    /// In small letters. One of them stands in the line.
    words: &'static [&'static str],
    means: &'static str,
}

const SIGNS: &[Sign] = &[
    Sign {
        words: &[
            "timeout",
            "timed out",
            "time out",
            "no response",
            "no reply",
            "no answer",
            "not responding",
            "did not respond",
            "does not respond",
            "keine antwort",
            "zeitüberschreitung",
            "pas de réponse",
            "sin respuesta",
            "nessuna risposta",
            "нет ответа",
            "таймаут",
            "超时",
            "无响应",
        ],
        means: "a program reports that no answer came in time.",
    },
    Sign {
        words: &[
            "crc error",
            "crc fail",
            "crc mismatch",
            "crc check",
            "bad crc",
            "invalid crc",
            "wrong crc",
            "crc-fehler",
            "lrc error",
            "checksum error",
            "checksum fail",
            "checksum mismatch",
            "bad checksum",
            "invalid checksum",
            "wrong checksum",
            "prüfsummenfehler",
        ],
        means: "a program reports a wrong checksum.",
    },
    Sign {
        words: &[
            "connection refused",
            "connection reset",
            "connection aborted",
            "connection closed",
            "unreachable",
            "broken pipe",
            "econnrefused",
            "econnreset",
            "not connected",
        ],
        means: "a program reports that its connection was refused or broken.",
    },
    Sign {
        words: &[
            "could not open port",
            "cannot open port",
            "can't open port",
            "failed to open port",
            "could not open serial",
            "port is already open",
            "port is not open",
            "device or resource busy",
            "access is denied",
            "no such file or directory: '/dev/",
        ],
        means: "a program could not open its port: another program may have it, or it has another name.",
    },
    Sign {
        words: &[
            "incomplete message",
            "incomplete frame",
            "incomplete response",
            "unexpected length",
            "wrong length",
            "invalid length",
            "frame error",
            "framing error",
            "parity error in",
            "overrun error",
        ],
        means: "a program received something incomplete, or with errors of the line.",
    },
];

/// How standards and programs called exceptions before.
const OLD_NAMES: &[(u8, &str)] = &[
    (4, "slave device failure"),
    (6, "slave device busy"),
    (4, "slave failure"),
    (6, "slave busy"),
    (11, "gateway target device"),
];

/// What the lines of a text tell that hold no telegram.
pub fn seen(text: &str, options: Options) -> Vec<Seen> {
    let reading = Reading { input: Input::Text, ..Reading::default() };
    let log = Log::read_with(None, text.as_bytes(), &reading, options);
    log.map_or(Vec::new(), |log| log.seen(&text.as_bytes()))
}

impl Log {
    /// What its unread lines tell, the most telling first.
    pub fn seen(&self, source: &dyn Source) -> Vec<Seen> {
        /// More say nothing else.
        const MOST: usize = 5000;
        const LONGEST: usize = 500;
        let mut seen: BTreeMap<Tells, (usize, Vec<u32>)> = BTreeMap::new();
        if matches!(self.format, Format::Text { .. }) {
            for (number, offset) in self.unread().iter().take(MOST) {
                if let Some(tells) = Tells::of(&self.text_at(source, offset, LONGEST)) {
                    let (count, lines) = seen.entry(tells).or_default();
                    *count += 1;
                    if lines.len() < SHOWN {
                        lines.push(number);
                    }
                }
            }
        }
        let foreign = FOREIGN.iter().zip(self.traffic.foreign_protocols());
        let foreign = foreign.filter(|(_, count)| **count > 0).map(|(foreign, count)| Seen {
            text: format!("telegrams of {}, which Buslens does not read.", foreign.name),
            lines: Vec::new(),
            count: *count as usize,
        });
        let told = seen.into_iter().map(|(tells, (count, lines))| Seen { text: tells.text(), lines, count });
        foreign.chain(told).collect()
    }
}

/// So many lines are named.
const SHOWN: usize = 5;

/// What a single line tells.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Tells {
    /// An exception by its name or number.
    Exception(u8),
    /// One of [`SIGNS`].
    Sign(usize),
    Values,
}

impl Tells {
    fn of(line: &str) -> Option<Self> {
        let line = line.to_ascii_lowercase();
        if let Some(code) = exception(&line) {
            return Some(Self::Exception(code));
        }
        let sign = SIGNS.iter().position(|sign| sign.words.iter().any(|word| line.contains(word)));
        sign.map(Self::Sign).or_else(|| has_values(&line).then_some(Self::Values))
    }

    fn text(self) -> String {
        match self {
            Self::Exception(code) => match exceptions().iter().find(|name| name.value == u64::from(code)) {
                Some(name) => {
                    format!("a program reports exception {code}, {}. {}", name.label, name.note)
                }
                None => format!("a program reports exception {code}."),
            },
            Self::Sign(index) => SIGNS[index].means.to_owned(),
            Self::Values => {
                "numbers that are no bytes, such as values of registers; the telegrams that carried them are not here."
                    .to_owned()
            }
        }
    }
}

/// The code of the exception that a line in small letters names.
fn exception(line: &str) -> Option<u8> {
    let named = exceptions().iter().find(|name| name.label.contains(' ') && line.contains(name.label));
    let old = || OLD_NAMES.iter().find(|(_, name)| line.contains(name)).map(|(code, _)| *code);
    named.and_then(|name| u8::try_from(name.value).ok()).or_else(old).or_else(|| numbered(line))
}

/// The number behind "exception", "exception code" or "exception_code": one that the standard has.
fn numbered(line: &str) -> Option<u8> {
    line.split("exception").skip(1).find_map(|behind| {
        let behind = behind.trim_start_matches(['_', ' ', '-']);
        let behind = behind.strip_prefix("code").unwrap_or(behind);
        let behind = behind.trim_start_matches([' ', ':', '=', '#']);
        let end = behind.find(|c: char| !c.is_ascii_digit()).unwrap_or(behind.len());
        let code = behind[..end].parse().ok()?;
        exceptions().iter().any(|name| name.value == u64::from(code)).then_some(code)
    })
}

/// A list in brackets with a number that no byte can be: `[100, 2150, 0]`.
fn has_values(line: &str) -> bool {
    let mut rest = line;
    while let Some((_, inside)) = rest.split_once('[') {
        let (list, behind) = inside.split_once(']').unwrap_or((inside, ""));
        rest = behind;
        // The standard library's tables for that weigh 14 kB.
        let number = |item: &str| lexical_core::parse::<f64>(item.trim().as_bytes()).ok();
        let numbers: Option<Vec<f64>> = list.split(',').map(number).collect();
        let is_no_byte = |number: &f64| *number < 0.0 || *number > 255.0 || number.fract() != 0.0;
        if numbers.is_some_and(|numbers| numbers.len() > 1 && numbers.iter().any(is_no_byte)) {
            return true;
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(line: &str) -> String {
        Tells::of(line).map_or(String::new(), Tells::text)
    }

    #[test]
    fn programs_report_errors_in_their_own_words() {
        for line in [
            "2024-03-04 10:00:01 ERROR Modbus Error: [Input/Output] No response received, retry",
            "serial.serialutil.SerialTimeoutException: Write timeout",
            "Fehler: Zeitüberschreitung beim Lesen",
            "等待超时",
        ] {
            assert_eq!(told(line), SIGNS[0].means, "{line}");
        }
        assert_eq!(told("W: CRC Error on ttyS0"), SIGNS[1].means);
        assert_eq!(told("connect: Connection refused (111)"), SIGNS[2].means);
        assert_eq!(told("could not open port 'COM3': PermissionError"), SIGNS[3].means);
        assert_eq!(told("[Modbus] incomplete frame dropped"), SIGNS[4].means);
    }

    #[test]
    fn exceptions_have_names_and_numbers() {
        for line in [
            "Illegal data address",
            "slave 3 sent exception code 2",
            "ExceptionResponse(dev_id=1, function_code=131, exception_code=2)",
            "Modbus exception: 2",
        ] {
            assert!(
                told(line).starts_with("a program reports exception 2, illegal data address. "),
                "{line}"
            );
        }
        assert!(told("Slave Device Busy").starts_with("a program reports exception 6"));
        // Exceptions of programming languages have no such numbers.
        for line in ["NullPointerException at line 2", "an exception 99 occurred", "exception in thread main"]
        {
            assert_eq!(told(line), "", "{line}");
        }
    }

    #[test]
    fn values_are_lists_of_what_no_byte_can_be() {
        assert!(has_values("registers: [100, 2150, 0]") && has_values("[ok] x = [-1, 2]"));
        assert!(has_values("[1.5, 2]"));
        assert!(!has_values("[1, 3, 0, 200]") && !has_values("[12345]") && !has_values("[a, 300]"));
        assert!(!has_values("[,]") && !has_values("["));
    }
}
