use buslens::field::{hex, problems};
use buslens::tool::{Change, Editor, Options, PROTOCOLS, Protocol, Settings, decode, offers};

use super::{lines, profile, write_lines};

/// Something to ask of a device in the manual's words: device, protocol, what is offered, what is filled in
/// (`path = text`, parted by `; `), then the bytes, what does not fit, and the problems.
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
    /// Bytes or why there are none, what does not fit, the problems.
    fn made(&self) -> Vec<String> {
        let [device, protocol, label, entries] = [0, 1, 2, 3].map(|at| self.0[at].as_str());
        let device = profile(device);
        let protocol = Protocol::of(protocol).unwrap_or(PROTOCOLS[0]);
        let offer = offers(Some(device)).into_iter().find(|offer| offer.label().sentence() == label);
        let offer = offer.unwrap_or_else(|| panic!("nothing is called {label}"));
        let mut settings = Settings::default();
        settings.frame.profibus.ident = device.ident;
        let mut editor = match Editor::new(offer, 5, protocol, &settings) {
            Ok(editor) => editor,
            Err(why) => return vec![String::new(), why.to_string(), String::new()],
        };
        for entry in entries.split("; ").filter(|entry| !entry.is_empty()) {
            let (path, text) = entry.split_once(" = ").expect("path = text");
            editor.edit(path, Change::Enter(text));
        }
        let misfits = editor.entries().misfits.iter();
        let misfits: Vec<String> = misfits.map(|misfit| misfit.message.to_string()).collect();
        match editor.bytes() {
            Err(why) => vec![String::new(), why.to_string(), String::new()],
            Ok(bytes) => {
                let text = hex(&bytes);
                let options = Options {
                    device: Some(device),
                    protocol: Some(protocol),
                    direction: Some(editor.direction),
                    settings,
                };
                let detail = decode(&text, options).detail(0).expect("a telegram");
                let found: Vec<String> = detail
                    .problems()
                    .iter()
                    .map(|it| format!("{}: {}", it.code, it.message.sentence()))
                    .collect();
                let _ = problems;
                vec![text, misfits.join("; "), found.join("; ")]
            }
        }
    }
}
