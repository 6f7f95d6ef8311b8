//! Tasks for Moodle and programs like it: Moodle XML, and GIFT.
//!
//! A telegram or a number becomes a short answer, which accepts the usual spellings; a choice a choice; blanks a
//! short answer of all blank bytes; a wrong byte its number. What Moodle cannot do is to say what is off.
//!
//! Sources: Moodle documentation, "Moodle XML format" and "GIFT format".

use buslens::field::{Format, hex, hex_value, number_text};

use crate::task::{Expected, Given, Number, Task};

/// What a program like Moodle asks.
enum Asked {
    /// Spellings that are right.
    Short(Vec<String>),
    /// Choices, and the index of the right one.
    Choice(Vec<String>, usize),
}

fn asked(task: &Task) -> Asked {
    match &task.expected {
        Expected::Choice { choices, right } => {
            Asked::Choice(choices.iter().map(|choice| choice.text.clone()).collect(), *right)
        }
        Expected::Number(number) => Asked::Short(numbers(number)),
        Expected::Byte { at, .. } => Asked::Short((at.from..at.to).map(|at| at.to_string()).collect()),
        Expected::Telegram(telegram) => {
            let width = telegram.check().map_or(0, |check| check.width);
            let body = &telegram.bytes[..telegram.bytes.len() - width];
            spellings(&[&telegram.bytes, body])
        }
        Expected::Blanks { telegram, blanks } => {
            let bytes: Vec<u8> =
                blanks.iter().flat_map(|blank| blank.span.of(&telegram.bytes).to_vec()).collect();
            spellings(&[&bytes])
        }
    }
}

/// Bytes with spaces and without.
fn spellings(all: &[&[u8]]) -> Asked {
    let mut texts: Vec<String> = Vec::new();
    for bytes in all {
        for text in [hex(bytes), hex(bytes).replace(' ', "")] {
            if !texts.contains(&text) {
                texts.push(text);
            }
        }
    }
    Asked::Short(texts)
}

fn numbers(number: &Number) -> Vec<String> {
    let plain = number_text(number.raw, number.width, number.format);
    let mut all = vec![plain.clone(), plain.replace('\u{2212}', "-"), plain.replace('.', ",")];
    if !matches!(number.format, Format::Float | Format::Places(_) | Format::Signed) {
        let value = hex_value(number.raw, number.width).to_string();
        all.push(format!("0x{}", value.trim_end_matches('h')));
        all.push(value);
    }
    let mut once: Vec<String> = Vec::new();
    all.into_iter().for_each(|text| {
        if !once.contains(&text) {
            once.push(text)
        }
    });
    once
}

/// The question with what is given, in lines.
fn lines(task: &Task) -> Vec<String> {
    let mut lines = vec![task.question.clone()];
    for given in &task.given {
        match given {
            Given::Telegram(telegram) => lines.push(hex(&telegram.bytes)),
            Given::Text(text) => lines.extend(text.lines().map(str::to_owned)),
        }
    }
    match &task.expected {
        Expected::Blanks { telegram, blanks } => {
            let byte = |(at, byte): (usize, &u8)| match blanks.iter().any(|blank| blank.span.contains(at)) {
                true => "__".to_owned(),
                false => format!("{byte:02X}"),
            };
            let bytes: Vec<String> = telegram.bytes.iter().enumerate().map(byte).collect();
            lines.push(bytes.join(" "));
            lines.push("Give the blank bytes in their order, in hex.".to_owned());
        }
        Expected::Telegram(_) => lines.push("Give the bytes in hex.".to_owned()),
        Expected::Byte { .. } => lines.push("Give the number of the byte, counted from 0.".to_owned()),
        Expected::Number(_) | Expected::Choice { .. } => {}
    }
    lines
}

/// The name of a question in the question bank: the round and its number.
fn name(place: &str, index: usize) -> String {
    format!("{place}.{}", index + 1)
}

/// Moodle XML with all tasks in a category of this title. `place` names the round.
pub fn moodle_xml(title: &str, place: &str, tasks: &[Task]) -> String {
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<quiz>\n<question type=\"category\">\n  <category><text>$course$/top/{}</text></category>\n</question>\n",
        escaped(&title.replace('/', "//"))
    );
    for (index, task) in tasks.iter().enumerate() {
        let asked = asked(task);
        let (kind, more) = match asked {
            Asked::Short(_) => ("shortanswer", "  <usecase>0</usecase>\n"),
            Asked::Choice(..) => (
                "multichoice",
                "  <single>true</single>\n  <shuffleanswers>true</shuffleanswers>\n  <answernumbering>abc</answernumbering>\n",
            ),
        };
        let said = lines(task);
        let (question, given) =
            said.split_first().map_or(("", &[][..]), |(first, rest)| (first.as_str(), rest));
        let mut html = format!("<p>{}</p>", escaped(question));
        if !given.is_empty() {
            html += &format!("<pre>{}</pre>", escaped(&given.join("\n")));
        }
        let working: String = task.working.iter().map(|step| format!("<li>{}</li>", escaped(step))).collect();
        text += &format!(
            "<question type=\"{kind}\">\n  <name><text>{}</text></name>\n  <questiontext format=\"html\"><text>{}</text></questiontext>\n  <generalfeedback format=\"html\"><text>{}</text></generalfeedback>\n  <defaultgrade>1</defaultgrade>\n{more}",
            escaped(&name(place, index)),
            escaped(&html),
            escaped(&format!("<ol>{working}</ol>"))
        );
        let mut answer = |fraction: &str, written: &str, html: bool| {
            let format = if html { " format=\"html\"" } else { " format=\"plain_text\"" };
            // An answer that is matched has * for any text.
            let written =
                if html { escaped(&escaped(written)) } else { escaped(&written.replace('*', "\\*")) };
            text += &format!("  <answer fraction=\"{fraction}\"{format}><text>{written}</text></answer>\n");
        };
        match &asked {
            Asked::Short(all) => all.iter().for_each(|one| answer("100", one, false)),
            Asked::Choice(all, right) => {
                for (at, one) in all.iter().enumerate() {
                    answer(if at == *right { "100" } else { "0" }, one, true);
                }
            }
        }
        for hint in &task.hints {
            text += &format!("  <hint format=\"html\"><text>{}</text></hint>\n", escaped(&escaped(hint)));
        }
        text += "</question>\n";
    }
    text + "</quiz>\n"
}

/// Text within XML.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\t' | '\n' => escaped.push(c),
            // XML knows no other control characters.
            c if c.is_control() => {}
            c => escaped.push(c),
        }
    }
    escaped
}

/// GIFT with all tasks in a category of this title. `place` names the round.
pub fn gift(title: &str, place: &str, tasks: &[Task]) -> String {
    let mut text = format!("// {}\n\n$CATEGORY: $course$/top/{}\n", place, title.replace('/', "//"));
    for (index, task) in tasks.iter().enumerate() {
        let question: Vec<String> = lines(task).iter().map(|line| guarded(line)).collect();
        text += &format!("\n::{}::[plain]{} {{\n", guarded(&name(place, index)), question.join("\\n"));
        match asked(task) {
            Asked::Short(all) => all.iter().for_each(|one| text += &format!("={}\n", guarded(one))),
            Asked::Choice(all, right) => {
                for (at, one) in all.iter().enumerate() {
                    text += &format!("{}{}\n", if at == right { '=' } else { '~' }, guarded(one));
                }
            }
        }
        let working: Vec<String> = task.working.iter().map(|step| guarded(step)).collect();
        text += &format!("####{}\n}}\n", working.join("\\n"));
    }
    text
}

/// Text within GIFT: what has a meaning there has a backslash before it.
fn guarded(text: &str) -> String {
    let mut guarded = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '~' | '=' | '#' | '{' | '}' | ':' | '\\' => guarded.extend(['\\', c]),
            // A line ends what is said.
            '\n' => guarded.push_str("\\n"),
            c if c.is_control() => {}
            c => guarded.push(c),
        }
    }
    guarded
}
