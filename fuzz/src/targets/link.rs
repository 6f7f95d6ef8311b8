use super::{Target, USUAL_MEMORY};
use crate::make;
use buslens::field::hex;
use buslens::tool::Editor;
use buslens::tool::link::Link;

/// What stands behind the `#` of an address, right or damaged.
pub static TARGET: Target = Target {
    key: "link",
    about: "links: there and back, and what is built by them",
    share: 1,
    memory: USUAL_MEMORY,
    make: |random, seeds| {
        let mut link = make::words(random, "&");
        if random.one_in(2) {
            let bytes = make::telegram(random, seeds);
            link.splice(0..0, format!("text={}&", hex(&bytes).replace(' ', "+")).into_bytes());
        }
        link
    },
    run,
};

fn run(data: &[u8]) {
    let content = String::from_utf8_lossy(data).into_owned();
    let link = Link::parse(&content);
    let again = Link::read(link.pairs());
    assert_eq!(again.pairs(), link.pairs(), "{content:?}");
    assert!(again.damaged.is_empty(), "{:?} of {content:?}", again.damaged);
    if let Some(mut editor) = Editor::follow(&link) {
        let bytes = editor.bytes();
        if bytes.as_ref().is_ok_and(Vec::is_empty) {
            return;
        }
        let back = Link::read(editor.link(&link.options.settings).pairs());
        let mut followed = Editor::follow(&back).expect("a link of an editor leads to one");
        assert_eq!(followed.bytes(), bytes, "{content:?} by {:?}", back.pairs());
    }
}
