use super::{Message, Span};

/// Something about a telegram that is not as it should be.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Stable kebab-case word of exports and tests.
    pub code: &'static str,
    pub severity: Severity,
    /// What was found and what was expected.
    pub message: Message,
    /// The bytes it is about.
    pub span: Span,
}

/// How much a problem weighs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The telegram can be right, but a person should look.
    Warning,
    /// The telegram breaks a rule of its protocol.
    Error,
}

impl Problem {
    pub fn error(code: &'static str, span: Span, message: Message) -> Self {
        Self { code, severity: Severity::Error, message, span }
    }

    pub fn warning(code: &'static str, span: Span, message: Message) -> Self {
        Self { code, severity: Severity::Warning, message, span }
    }
}
