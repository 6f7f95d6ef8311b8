//! The shape of a configuration: which modules a slave has, and how much data each of them carries.
//!
//! Layout: a byte for each module. In the special format, it says how many bytes belong to it: a
//! length of the outputs, a length of the inputs, and bytes of the maker.
//!
//! Source: KEB COMBIVERT F5 PROFIBUS-DP operator, 7.2; EN 50170, volume 2, Chk_Cfg.

use super::{Body, Layout, Settings, ident};
use crate::field::{Argument, Bits, Format, Message, Name, Role, Severity, Spec};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

/// The modules of a slave.
pub struct Configuration {
    pub bytes: Vec<u8>,
    /// The rules of the KEB F5 count: no other ident number is known.
    keb: bool,
    /// The sentence for a station and its layout.
    meaning: fn(Message, Message) -> Message,
}

impl Configuration {
    pub(super) fn new(settings: &Settings, meaning: fn(Message, Message) -> Message) -> Self {
        let keb = settings.ident.is_none_or(|ident| ident == ident::KEB_F5);
        Self { bytes: vec![PARAMETER_CHANNEL, 0xA3, 0x93], keb, meaning }
    }
}

/// What `bytes` of a configuration say about the user data: B7h at the beginning is the parameter
/// channel, everything else is process data.
///
/// ```
/// use buslens::profibus::{Layout, configuration};
///
/// let layout = configuration::layout(&[0xB7, 0xE0, 0xE0, 0xD0, 0xD0]);
/// assert_eq!(layout, Layout { channel: true, outputs: 4, inputs: 4 });
/// ```
pub fn layout(bytes: &[u8]) -> Layout {
    let mut modules = Modules::default();
    bytes.iter().for_each(|byte| modules.take(*byte));
    modules.layout()
}

impl Telegram for Configuration {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        let keb = self.keb;
        let mut modules = Modules::default();
        w.list(&MODULES, &mut self.bytes, None, Some(1), |w, byte| {
            let spec = modules.next();
            match std::ptr::eq(spec, &MODULE) {
                true => w.choose(spec, 1, byte, &|raw| match SIDES.of(raw) {
                    SPECIAL => &SPECIAL_FORMAT,
                    _ => &DATA,
                })?,
                false => w.u8(spec, byte)?,
            }
            modules.take(*byte);
            if keb {
                modules.check(w, *byte, spec);
            }
            Ok(())
        })?;
        if !modules.complete() {
            w.remark(
                &MODULES,
                Severity::Error,
                "truncated",
                message!("the configuration ends before the bytes that its last module announces"),
            );
        }
        if keb {
            modules.check_sum(w);
        }
        Ok(())
    }
}

impl Body for Configuration {
    fn meaning(&self, who: Message) -> Message {
        let layout = layout(&self.bytes);
        let process = message!(
            "{outputs} out, {inputs} in",
            outputs = Message::bytes(layout.outputs),
            inputs = Message::bytes(layout.inputs)
        );
        let said = match layout.channel {
            true => message!("parameter channel, {process}", process = process),
            false => process,
        };
        (self.meaning)(who, said)
    }

    fn layout(&self) -> Option<Layout> {
        Some(layout(&self.bytes))
    }
}

/// What the bytes so far say.
#[derive(Default)]
struct Modules {
    count: usize,
    outputs: usize,
    inputs: usize,
    channel: bool,
    /// What still belongs to the module at hand.
    output_length: bool,
    input_length: bool,
    makers: u64,
}

impl Modules {
    /// Every byte that a module announced was there.
    fn complete(&self) -> bool {
        !self.output_length && !self.input_length && self.makers == 0
    }

    /// What the next byte is.
    fn next(&self) -> &'static Spec {
        match (self.output_length, self.input_length, self.makers) {
            (true, _, _) => &OUTPUT_LENGTH,
            (_, true, _) => &INPUT_LENGTH,
            (_, _, 1..) => &MAKERS,
            _ => &MODULE,
        }
    }

    fn take(&mut self, byte: u8) {
        let raw = u64::from(byte);
        if self.output_length {
            self.output_length = false;
            self.outputs += size(LONG_LENGTH.of(raw), raw);
        } else if self.input_length {
            self.input_length = false;
            self.inputs += size(LONG_LENGTH.of(raw), raw);
        } else if self.makers > 0 {
            self.makers -= 1;
        } else {
            self.count += 1;
            self.module(byte);
        }
    }

    fn module(&mut self, byte: u8) {
        let raw = u64::from(byte);
        let size = size(LENGTH.of(raw), raw);
        match SIDES.of(raw) {
            _ if byte == PARAMETER_CHANNEL && self.count == 1 => self.channel = true,
            SPECIAL => {
                self.input_length = raw & 0x40 != 0;
                self.output_length = raw & 0x80 != 0;
                // 15 stands for none, which nobody checks.
                self.makers = LENGTH.of(raw) % 15;
            }
            sides => {
                self.inputs += if sides & 1 != 0 { size } else { 0 };
                self.outputs += if sides & 2 != 0 { size } else { 0 };
            }
        }
    }

    fn layout(&self) -> Layout {
        Layout { channel: self.channel, outputs: self.outputs, inputs: self.inputs }
    }

    /// What a KEB F5 does not take of the module `byte`, just taken.
    fn check(&self, w: &mut dyn Walker, byte: u8, spec: &'static Spec) {
        let raw = u64::from(byte);
        if !std::ptr::eq(spec, &MODULE) || SIDES.of(raw) == SPECIAL {
            return;
        }
        if SIDES.of(raw) == BOTH_SIDES && byte != PARAMETER_CHANNEL {
            w.remark(
                &MODULE,
                Severity::Warning,
                "both-ways",
                message!(
                    "only the parameter channel of a KEB F5 goes both ways, as B7h: process data take a module for each way"
                ),
            );
        } else if SIDES.of(raw) == BOTH_SIDES && self.count != 1 {
            w.remark(
                &MODULE,
                Severity::Warning,
                "channel-not-first",
                message!("the parameter channel of a KEB F5 must be the first module, as B7h"),
            );
        }
        if !size(LENGTH.of(raw), raw).is_multiple_of(2) && size(LENGTH.of(raw), raw) > 1 {
            w.remark(
                &MODULE,
                Severity::Warning,
                "half-word",
                message!(
                    "a module of a KEB F5 has whole words of 2 bytes; this has {size} bytes",
                    size = size(LENGTH.of(raw), raw)
                ),
            );
        }
        if size(LENGTH.of(raw), raw) < 2 {
            w.remark(
                &MODULE,
                Severity::Warning,
                "module-too-small",
                message!("a module of a KEB F5 has one word (2 bytes) at least"),
            );
        }
    }

    /// What a KEB F5 does not take of all modules together.
    fn check_sum(&self, w: &mut dyn Walker) {
        if self.count > MOST_MODULES {
            w.remark(
                &MODULES,
                Severity::Warning,
                "too-many-modules",
                message!(
                    "{count} modules; a KEB F5 has at most {most}: the parameter channel and 8 each way",
                    count = self.count,
                    most = MOST_MODULES
                ),
            );
        }
        for (label, size) in [("outputs", self.outputs), ("inputs", self.inputs)] {
            if size > MOST_BYTES {
                w.remark(
                    &MODULES,
                    Severity::Warning,
                    "too-much-process-data",
                    message!(
                        "{size} bytes of {side}; a KEB F5 has at most {most}",
                        size = size,
                        side = Argument::Term(label),
                        most = MOST_BYTES
                    ),
                );
            }
        }
    }
}

/// Bytes of a module whose length bits say `length`.
fn size(length: u64, raw: u64) -> usize {
    (length as usize + 1) << WORDS.of(raw)
}

/// 8 bytes in and out, consistent over the whole length.
const PARAMETER_CHANNEL: u8 = 0xB7;

/// What a KEB F5 has at most.
const MOST_MODULES: usize = 17;
const MOST_BYTES: usize = 16;

/// Values of [`SIDES`].
const SPECIAL: u64 = 0;
const BOTH_SIDES: u64 = 3;

static MODULES: Spec = Spec::new("modules", "Modules")
    .note("One byte for each module, in the order of the user data; more for modules of the special format.")
    .source(SOURCE);

static MODULE: Spec = Spec::new("module", "Configuration byte")
    .short("Module")
    .role(Role::Count)
    .format(Format::Hex)
    .note(
        "How much data a module carries, and to which side, seen from the master. Bits 4 and 5 both 0 mark \
         the special format.",
    )
    .source(SOURCE);

/// What the byte of a module says.
static DATA: Spec = Spec::new("module_data", "Module")
    .names(&[Name {
        value: PARAMETER_CHANNEL as u64,
        label: "8 bytes in and out: parameter channel",
        note: "",
    }])
    .bits(&[LENGTH, SIDES, WORDS, CONSISTENT]);

/// What it says in the special format.
static SPECIAL_FORMAT: Spec = Spec::new("special_format", "Module in the special format")
    .names(&[Name { value: 0x00, label: "empty module", note: "" }])
    .bits(&[
        SIDES,
        Bits::flag(6, "input_length", "a length of inputs follows"),
        Bits::flag(7, "output_length", "a length of outputs follows"),
        Bits::part(0, 4, "makers_bytes", "bytes of the maker:"),
    ]);

static OUTPUT_LENGTH: Spec =
    Spec::new("output_length", "Length of outputs").short("Outputs").bits(LENGTH_BYTE);
static INPUT_LENGTH: Spec = Spec::new("input_length", "Length of inputs").short("Inputs").bits(LENGTH_BYTE);

static MAKERS: Spec = Spec::new("makers_byte", "Byte of the maker")
    .short("Maker")
    .role(Role::Unknown)
    .format(Format::Hex)
    .note("What it means, the device's maker says.");

static LENGTH_BYTE: &[Bits] = &[LONG_LENGTH, WORDS, CONSISTENT];

const LENGTH: Bits = Bits::part(0, 4, "length", "length less 1").names(&[
    Name { value: 0, label: "length 1", note: "" },
    Name { value: 1, label: "length 2", note: "" },
    Name { value: 2, label: "length 3", note: "" },
    Name { value: 3, label: "length 4", note: "" },
    Name { value: 4, label: "length 5", note: "" },
    Name { value: 5, label: "length 6", note: "" },
    Name { value: 6, label: "length 7", note: "" },
    Name { value: 7, label: "length 8", note: "" },
    Name { value: 8, label: "length 9", note: "" },
    Name { value: 9, label: "length 10", note: "" },
    Name { value: 10, label: "length 11", note: "" },
    Name { value: 11, label: "length 12", note: "" },
    Name { value: 12, label: "length 13", note: "" },
    Name { value: 13, label: "length 14", note: "" },
    Name { value: 14, label: "length 15", note: "" },
    Name { value: 15, label: "length 16", note: "" },
]);

const LONG_LENGTH: Bits = Bits::part(0, 6, "length", "length less 1");

const SIDES: Bits = Bits::part(4, 2, "sides", "direction").names(&[
    Name { value: SPECIAL, label: "special format", note: "" },
    Name { value: 1, label: "input", note: "" },
    Name { value: 2, label: "output", note: "" },
    Name { value: BOTH_SIDES, label: "input and output", note: "" },
]);

const WORDS: Bits = Bits::part(6, 1, "words", "words").names(&[
    Name { value: 0, label: "bytes", note: "" },
    Name { value: 1, label: "words", note: "Of 16 bits." },
]);

const CONSISTENT: Bits = Bits::part(7, 1, "consistency", "consistency").names(&[
    Name { value: 0, label: "consistent byte by byte or word by word", note: "" },
    Name { value: 1, label: "consistent as a whole", note: "" },
]);

const SOURCE: &str = "KEB COMBIVERT F5 PROFIBUS-DP operator, 7.2; EN 50170, volume 2";
