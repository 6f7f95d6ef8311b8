use std::fmt;

use super::{Input, Reading};
use crate::text::{self, Encoding, Layout, Numbers, Style};

/// What a file is.
#[derive(Clone, Debug, PartialEq)]
pub enum Format {
    Text {
        /// Known by name.
        layout: Option<&'static str>,
        /// How numbers are written; `None` where each line tells.
        numbers: Option<Numbers>,
        /// How most bytes are written.
        style: Option<Style>,
        /// Its lines say more than bytes: when, or who speaks.
        tells: bool,
    },
    /// Bytes with nothing between them.
    Stream,
    /// A capture of a network.
    Capture { name: &'static str },
}

impl Format {
    /// Its name for a person: "QModMaster bus monitor".
    pub fn name(&self) -> String {
        match self {
            Self::Text { layout: Some(layout), .. } => {
                Layout::of(layout).map_or_else(String::new, |layout| layout.name.to_owned())
            }
            Self::Text { numbers: Some(Numbers::Decimal), .. } => "lines with decimal bytes".into(),
            Self::Text { tells: true, .. } => "lines with bytes and who sent them or when".into(),
            Self::Text { .. } => "lines with hex bytes".into(),
            Self::Stream => "raw bytes of a line".into(),
            Self::Capture { name } => (*name).into(),
        }
    }

    /// The stable word of exports.
    pub fn key(&self) -> &'static str {
        match self {
            Self::Text { layout: Some(key), .. } => key,
            Self::Text { numbers: Some(Numbers::Decimal), .. } => "decimal",
            Self::Text { tells: true, .. } => "log",
            Self::Text { style, .. } => style.map_or("hex", Style::name),
            Self::Stream => "binary",
            Self::Capture { .. } => "capture",
        }
    }
}

/// Why a file is not read.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    Empty,
    /// Its first bytes are those of a file of another kind.
    Foreign {
        name: &'static str,
        instead: &'static str,
    },
    /// An export that names telegrams without their bytes.
    NoBytes {
        name: &'static str,
        instead: &'static str,
    },
    NoCaptures,
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => write!(f, "The file is empty."),
            Self::Foreign { name, instead } => write!(f, "This is {name}, no log: {instead}."),
            Self::NoBytes { name, instead } => {
                write!(f, "This is {name}. It names telegrams but does not hold their bytes: {instead}.")
            }
            Self::NoCaptures => write!(f, "This is a capture of a network, which this build does not read."),
        }
    }
}

/// The beginnings of files that people send by mistake.
static FOREIGN: &[(&[u8], &str, &str)] = &[
    (b"PK\x03\x04", "a ZIP archive or an Office document", "unpack it, or save it as text"),
    (b"\x1F\x8B", "a gzip archive", "unpack it first"),
    (b"7z\xBC\xAF\x27\x1C", "a 7z archive", "unpack it first"),
    (b"Rar!", "a RAR archive", "unpack it first"),
    (b"%PDF", "a PDF", "copy the lines out of it and paste them"),
    (b"\x89PNG", "a picture", "ask for the text of the log"),
    (b"\xFF\xD8\xFF", "a picture", "ask for the text of the log"),
    (b"MZ\x90", "a program", "ask for the log itself"),
    (b"\x7FELF", "a program", "ask for the log itself"),
    (b"SQLite format 3", "a database", "export its table of telegrams as text"),
    (b"\xD0\xCF\x11\xE0", "an old Office document", "save it as text"),
    (b"{\\rtf", "a document in RTF", "save it as plain text"),
];

/// What a file's beginning tells of it.
pub(super) struct Told {
    pub format: Format,
    pub encoding: Encoding,
    /// A text with rows of dumps in it.
    pub dumps: bool,
}

/// Tells what a file is from its beginning.
pub(super) fn tell(beginning: &[u8], reading: &Reading) -> Result<Told, Refusal> {
    let told = |format, encoding| Ok(Told { format, encoding, dumps: false });
    if beginning.is_empty() {
        return Err(Refusal::Empty);
    }
    #[cfg(feature = "captures")]
    if let Some(format) = crate::capture::Capture::recognises(beginning)
        && matches!(reading.input, Input::Auto | Input::Capture)
    {
        return told(Format::Capture { name: format.name() }, Encoding::Binary);
    }
    if reading.input == Input::Capture {
        let instead = "a capture begins with the magic number of pcap or pcapng";
        return Err(Refusal::Foreign { name: "no capture", instead });
    }
    let encoding = text::encoding(beginning);
    if reading.input == Input::Binary {
        return told(Format::Stream, encoding);
    }
    let foreign = FOREIGN.iter().find(|(magic, ..)| beginning.starts_with(magic));
    if let Some((_, name, instead)) = foreign.filter(|_| reading.input == Input::Auto) {
        return Err(Refusal::Foreign { name, instead });
    }
    if encoding == Encoding::Binary && reading.input == Input::Auto {
        return told(Format::Stream, encoding);
    }
    let text = encoding.text(beginning);
    let recognised = text::recognise(&text);
    // The same list can be exported with the bytes below each line.
    if let Some(export) =
        text::export(&text).filter(|_| recognised.dumped == 0 && reading.input == Input::Auto)
    {
        return Err(Refusal::NoBytes { name: export.name, instead: export.instead });
    }
    let format = Format::Text {
        layout: recognised.layout.map(|layout| layout.key),
        numbers: reading.numbers.or(recognised.numbers),
        style: recognised.style,
        tells: recognised.telling * 2 > recognised.with_bytes,
    };
    Ok(Told { format, encoding, dumps: recognised.dumped > 0 })
}
