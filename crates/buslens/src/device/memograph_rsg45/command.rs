//! Commands written to the Memograph: function (1 byte), what it is for (1 byte), text up to the
//! end of the registers where the function has one.

use super::text::{Text, unpadded};
use crate::field::{Argument, Message, Name, Role, Severity, Spec, hex_value};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

/// The functions of one block of registers.
#[derive(Debug)]
pub struct Functions {
    /// The first byte, which chooses one.
    pub spec: Spec,
    pub list: &'static [Function],
}

/// A function.
#[derive(Debug)]
pub struct Function {
    pub code: u8,
    /// What it does.
    pub spec: Spec,
    pub second: Second,
    pub text: Option<&'static Text>,
}

/// What the second byte is.
#[derive(Clone, Copy, Debug)]
pub enum Second {
    /// Which one the function is for.
    Number(&'static Spec),
    /// The same, with more to say of it than limits can.
    Checked(&'static Spec, fn(u8) -> Option<Message>),
    /// It only fills the register: the manual has this byte there.
    Filler(&'static Spec, u8),
}

impl Functions {
    fn find(&self, code: u64) -> Option<&'static Function> {
        self.list.iter().find(|function| u64::from(function.code) == code)
    }
}

/// The functions as names of the first byte.
pub const fn names<const COUNT: usize>(list: &[Function; COUNT]) -> [Name; COUNT] {
    let mut names = [const { Name { value: 0, label: "", note: "" } }; COUNT];
    let mut index = 0;
    while index < COUNT {
        let function = &list[index];
        let (label, note) = (function.spec.label, function.spec.note);
        names[index] = Name { value: function.code as u64, label, note };
        index += 1;
    }
    names
}

/// A command.
pub struct Command {
    functions: &'static Functions,
    code: u8,
    number: u8,
    text: Vec<u8>,
}

impl Command {
    /// An empty one of the function `code`.
    pub fn new(functions: &'static Functions, code: u8) -> Self {
        let number = match functions.find(code.into()).map(|function| function.second) {
            Some(Second::Filler(_, filler)) => filler,
            _ => 1,
        };
        Self { functions, code, number, text: Vec::new() }
    }
}

impl Telegram for Command {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        let functions = self.functions;
        let mut code = self.code;
        w.choose(&functions.spec, 1, &mut code, &|code| {
            functions.find(code).map_or(&UNKNOWN, |function| &function.spec)
        })?;
        if code != self.code {
            *self = Self::new(functions, code);
        }
        let Some(function) = functions.find(code.into()) else {
            let message = message!("function {code} does not exist here", code = code);
            w.remark(&functions.spec, Severity::Error, "unknown-function", message);
            return w.bytes(&UNKNOWN, &mut self.text, None);
        };
        match function.second {
            Second::Number(spec) => w.u8(spec, &mut self.number)?,
            Second::Checked(spec, check) => {
                w.u8(spec, &mut self.number)?;
                if let Some(message) = check(self.number) {
                    w.remark(spec, Severity::Error, "out-of-range", message);
                }
            }
            Second::Filler(spec, filler) => {
                w.u8(spec, &mut self.number)?;
                if self.number != filler {
                    let message =
                        message!("the manual pads with {filler} here", filler = hex_value(filler.into(), 1));
                    w.remark(spec, Severity::Warning, "other-padding", message);
                }
            }
        }
        let Some(text) = function.text else { return Ok(()) };
        text.walk(w, &mut self.text)?;
        if text.required && unpadded(&self.text).is_empty() {
            let message = message!(
                "{function} needs {text} behind the first two bytes",
                function = Argument::Term(function.spec.label),
                text = Argument::Term(text.spec.label)
            );
            w.remark(&functions.spec, Severity::Error, "data-missing", message);
        }
        Ok(())
    }
}

static UNKNOWN: Spec = Spec::new("unknown_function", "Unknown function")
    .short("Unknown")
    .role(Role::Unknown)
    .note("The manual knows no such function of these registers.");
