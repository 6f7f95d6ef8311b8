use buslens::field::hex;
use buslens::tool::{Change, Editor, Options, PROTOCOLS, Protocol, Settings, decode, offers};

use super::{lines, profile, write_lines};

/// Something to ask of a device in the manual's words: device, protocol, what is offered, what is filled in
/// (`path = text`, parted by `; `), then the bytes, what does not fit, the problems, and the sentence.
///
/// `replies = ?` has the refusals that can follow instead of the problems, `answer = ?` what a healthy
/// device's response says behind it instead of the sentence.
pub struct Row(Vec<String>);

pub fn rows() -> Vec<Row> {
    lines("builds").into_iter().map(Row).collect()
}

pub fn wrong(row: &Row) -> Option<String> {
    let made = row.made();
    let expected: Vec<&str> = row.0.iter().skip(4).map(String::as_str).collect();
    (made != expected).then(|| {
        format!("{} {} {}:\n  expected {expected:?}\n  found    {made:?}", row.0[0], row.0[2], row.0[3])
    })
}

pub fn bless(rows: &[Row]) {
    write_lines("builds", rows.iter().map(|row| [&row.0[..4], &row.made()].concat()));
}

impl Row {
    /// Bytes or why there are none, what does not fit, the problems, the sentence.
    fn made(&self) -> Vec<String> {
        let [device, protocol, label, entries] = [0, 1, 2, 3].map(|at| self.0[at].as_str());
        let device = profile(device);
        let protocol = Protocol::of(protocol).unwrap_or(PROTOCOLS[0]);
        let offer = offers(Some(device)).into_iter().find(|offer| offer.label().sentence() == label);
        let offer = offer.unwrap_or_else(|| panic!("nothing is called {label}"));
        let settings = Settings::default();
        let none = |why: String| vec![String::new(), why, String::new(), String::new()];
        let mut editor = match Editor::new(offer, 5, protocol, &settings) {
            Ok(editor) => editor,
            Err(why) => return none(why.to_string()),
        };
        for entry in entries.split("; ").filter(|entry| !entry.is_empty() && !entry.ends_with(" = ?")) {
            let (path, text) = entry.split_once(" = ").expect("path = text");
            editor.edit(path, Change::Enter(text));
        }
        let misfits = editor.entries().misfits.iter();
        let misfits: Vec<String> = misfits.map(|misfit| misfit.message.to_string()).collect();
        let bytes = match editor.bytes() {
            Err(why) => return none(why.to_string()),
            Ok(bytes) => hex(&bytes),
        };
        let options = Options {
            device: Some(device),
            protocol: Some(protocol),
            direction: Some(editor.direction),
            settings: settings.clone(),
        };
        let detail = decode(&bytes, options.clone()).detail(0).expect("a telegram");
        let problems = detail.problems();
        let found = problems.iter().map(|it| format!("{}: {}", it.code, it.message.sentence()));
        let mut found: Vec<String> = found.collect();
        let mut sentence = detail.meaning().sentence();
        let replies = editor.replies(&settings);
        if entries.contains("replies = ?") {
            found = replies.iter().map(|(label, _)| label.to_string()).collect();
        }
        if entries.contains("answer = ?") {
            let both = format!("{bytes}\n{}", hex(&replies[0].1));
            let report = decode(&both, Options { direction: None, ..options });
            sentence = report.detail(1).expect("a response").meaning().sentence();
        }
        vec![bytes, misfits.join("; "), found.join("; "), sentence]
    }
}
