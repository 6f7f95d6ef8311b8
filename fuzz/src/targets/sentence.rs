use super::{Target, USUAL_MEMORY};
use crate::{Input, make};
use buslens::tool::setup::find;
use buslens::tool::{Content, Settings, search};

/// What somebody types who looks for something to build.
pub static TARGET: Target = Target {
    key: "sentence",
    about: "sentences to search for: whatever is found can be opened, and what the words fill in fits its form",
    share: 2,
    memory: USUAL_MEMORY,
    make: |random, seeds| [make::choices(random, CHOICES), make::sentence(random, seeds)].concat(),
    run,
};

const CHOICES: usize = 2;

/// So many of what is found are opened.
const OPENED: usize = 6;

fn run(data: &[u8]) {
    let mut input = Input::new(data, CHOICES);
    let (how, device) = (input.byte(), input.device());
    let text = String::from_utf8_lossy(input.content());
    let found = search(&text, device);
    let settings = Settings::default();
    for one in found.iter().take(OPENED) {
        assert!(!one.label().sentence().is_empty(), "{text}");
        let mut editor =
            one.editor(how, None, &settings).unwrap_or_else(|why| panic!("{text}: {}: {why}", one.label()));
        let entries = editor.entries();
        // Not every character of a text is a byte, which the form then says.
        let mut texts = Vec::new();
        entries.form.visit(&mut |entry| {
            if matches!(entry.content, Content::Text { .. }) {
                texts.push(entry.path.as_str());
            }
        });
        let misfit = entries.misfits.iter().find(|misfit| !texts.contains(&misfit.path.as_str()));
        let has_texts = !texts.is_empty();
        assert!(misfit.is_none(), "{text}: {} {:?}: {misfit:?}", one.label(), one.entries);
        if how & 7 == 0 {
            // Where a text is to be sent, there may be none yet.
            let made = editor.bytes();
            let whole = made.is_ok_and(|bytes| !bytes.is_empty()) || has_texts;
            assert!(whole, "{text}: {}", one.label());
            editor.answers(&settings).iter().for_each(|answer| assert!(!answer.said.sentence().is_empty()));
        }
    }
    if how & 3 == 0 {
        find(&text);
    }
}
