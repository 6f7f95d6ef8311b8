//! Whether everything that a lesson says holds.

use buslens::field::{Field, Value, hex, in_order};
use buslens::tool::log::{Log, Reading, decode_pasted};
use buslens::tool::{Report, decode};

use super::text::filled;
use super::{Lesson, Mistake, Place, Show, Statement, Step, field, names};

impl Lesson {
    /// What the library does not say so, or cannot do, in the order of the lines.
    pub fn mistakes(&self) -> Vec<Mistake> {
        let mut found = Vec::new();
        for step in &self.steps {
            step.check(&mut found);
        }
        in_order(found, |mistake| mistake.line)
    }
}

fn say(found: &mut Vec<Mistake>, line: usize, said: impl Into<String>) {
    found.push(Mistake { line, said: said.into() });
}

impl Step {
    pub(crate) fn check(&self, found: &mut Vec<Mistake>) {
        let report = self.report();
        if report.telegrams.len() != self.telegrams.len() {
            // Which one it is tells best who reads each by itself.
            let alone =
                self.telegrams.iter().find(|it| decode(&it.text, self.options()).telegrams.len() != 1);
            let line = alone.map_or(self.line, |telegram| telegram.line);
            say(
                found,
                line,
                "This is not one telegram. Expected bytes such as 01 03 00 C8 00 03 84 35, one telegram a line.",
            );
            return;
        }
        for (index, telegram) in self.telegrams.iter().enumerate() {
            let Some(detail) = report.detail(index) else { continue };
            for remark in &telegram.remarks {
                let length = report.telegrams[index].line.bytes.len();
                if remark.place.span(&detail, length).is_none() {
                    let said = match &remark.place {
                        Place::Field(name) => unknown(name, &names(&detail)),
                        _ => format!("The telegram has the bytes 0 to {}.", length.saturating_sub(1)),
                    };
                    say(found, remark.line, said);
                }
                let own = match &remark.place {
                    Place::Field(name) => Some(name.as_str()),
                    _ => None,
                };
                if let Err(name) = filled(&remark.text, &report, index, own) {
                    say(found, remark.line, unknown(&name, &names(&detail)));
                }
            }
        }
        for text in &self.text {
            if let Err(name) = self.filled(text, &report) {
                say(
                    found,
                    self.line,
                    format!("In the text of this step, {{{name}}} is nothing that its telegrams say."),
                );
            }
        }
        if matches!(self.show, Show::Sides | Show::Checksum | Show::Line(_)) && self.telegrams.is_empty() {
            say(found, self.line, "What this step shows needs a telegram.");
        }
        if self.show == Show::Log && self.log.is_empty() {
            say(found, self.line, "A log is to be shown and there is none: its lines begin with “| ”.");
        }
        for statement in &self.statements {
            match self.says(statement, &report) {
                Ok(values) if values.contains(&statement.value) => {}
                Ok(values) => {
                    let said =
                        format!("“{}” is {}, not {}.", statement.name, values.join(" or "), statement.value);
                    say(found, statement.line, said);
                }
                Err(said) => say(found, statement.line, said),
            }
        }
        if let Some(exercise) = &self.exercise {
            exercise.check(self, &report, found);
        }
    }

    /// A sentence with what its telegrams say in place of what stands in braces.
    pub fn filled(&self, text: &str, report: &Report) -> Result<String, String> {
        let all = (0..report.telegrams.len()).map(|index| filled(text, report, index, None));
        // One that says all of it; what none says is named by the first.
        let mut unknown = None;
        for filled in all {
            match filled {
                Ok(text) => return Ok(text),
                Err(name) => unknown = unknown.or(Some(name)),
            }
        }
        match unknown {
            Some(name) => Err(name),
            None => Ok(text.to_owned()),
        }
    }

    /// The same; what is not known stays as it is.
    pub fn filled_in(&self, text: &str) -> String {
        self.filled(text, &self.report()).unwrap_or_else(|_| text.to_owned())
    }

    /// The same for a remark on telegram `index`, of which `own` is the field. What is not known stays as it is.
    pub fn filled_at(&self, text: &str, report: &Report, index: usize, own: Option<&str>) -> String {
        filled(text, report, index, own).unwrap_or_else(|_| text.to_owned())
    }

    /// What the library says of what a statement names: all ways in which it may be written.
    fn says(&self, statement: &Statement, report: &Report) -> Result<Vec<String>, String> {
        if !self.log.is_empty() {
            return self.log_says(&statement.name);
        }
        let Some(detail) = report.detail(statement.telegram) else {
            return Err("What holds is said of a telegram: it stands below a line “telegram: …”.".to_owned());
        };
        if statement.name == "said" {
            return Ok(vec![detail.meaning().to_string()]);
        }
        let bytes = &report.telegrams[statement.telegram].line.bytes;
        match field(&detail, &statement.name) {
            Some(field) => Ok(ways(field, bytes)),
            None => Err(unknown(&statement.name, &names(&detail))),
        }
    }

    fn log_says(&self, name: &str) -> Result<Vec<String>, String> {
        let read = decode_pasted(&self.log, self.options());
        let summary = read.map(|report| report.summary()).unwrap_or_default();
        let number = match name {
            "telegrams" => summary.telegrams,
            "answered" => summary.pairs,
            "unanswered" => summary.unanswered,
            "damaged" => summary.check_failed,
            "finding" => return Ok(self.findings().into_iter().map(|(code, _)| code).collect()),
            _ => {
                return Err("Of a log hold: telegrams, answered, unanswered, damaged and finding.".to_owned());
            }
        };
        Ok(vec![number.to_string()])
    }

    /// What the library finds in the log: the stable word of each finding, and its sentence.
    pub fn findings(&self) -> Vec<(String, String)> {
        let source = self.log.as_bytes();
        let log = Log::read(source, &Reading::default(), self.options());
        let found = log.map(|log| log.findings(&source)).unwrap_or_default();
        found.into_iter().map(|it| (it.code.to_owned(), it.text.sentence() + ".")).collect()
    }
}

/// How a field's value may be written in a statement.
fn ways(field: &Field, bytes: &[u8]) -> Vec<String> {
    let check = match &field.value {
        Value::Check(check) if check.ok() => Some("valid".to_owned()),
        Value::Check(_) => Some("wrong".to_owned()),
        _ => None,
    };
    let meaning = field.meaning().map(|meaning| meaning.to_string());
    let all = [check, Some(field.value_text()), meaning, Some(hex(field.span.of(bytes)))];
    all.into_iter().flatten().filter(|way| !way.is_empty()).collect()
}

pub(super) fn unknown(name: &str, known: &[String]) -> String {
    format!("The telegram has no field “{name}”. It has: {}.", known.join(", "))
}
