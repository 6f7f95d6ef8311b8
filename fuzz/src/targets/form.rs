use std::sync::LazyLock;

use super::Target;
use crate::{Input, make};
use buslens::field::hex;
use buslens::tool::link::Link;
use buslens::tool::{Change, Content, Editor, Offer, PROFILES, offers};

/// A telegram or a request of a device while somebody fills in its form.
pub static TARGET: Target = Target {
    key: "form",
    about: "forms: any entries in any order, and the link to what comes of them",
    share: 3,
    // Three bytes make a list of 256 items, each with a form of its own.
    memory: 16 << 20,
    make: |random, seeds| {
        let mut data = make::choices(random, 6);
        let telegram = make::telegram(random, seeds);
        data.push(telegram.len().min(255) as u8);
        data.extend(&telegram[..telegram.len().min(255)]);
        let edits = 3 * random.below(8);
        data.extend(make::choices(random, edits));
        data
    },
    run,
};

static OFFERS: LazyLock<Vec<Vec<Offer>>> =
    LazyLock::new(|| PROFILES.iter().copied().map(|profile| offers(Some(profile))).collect());

/// What is typed.
const TYPED: &[&str] = &[
    "",
    "0",
    "1",
    "2",
    "4",
    "7",
    "16",
    "0x10",
    "FFh",
    "255",
    "256",
    "65535",
    "65536",
    "-1",
    "seven",
    "1.5",
    "NaN",
    "01 02",
    "0",
    "xyz",
    "00",
    "\\x00",
    "a",
    "good",
    "FFFF",
    "3",
    "8",
    "40",
    "300",
    "12345678901234567890",
];

fn run(data: &[u8]) {
    let mut input = Input::new(data, usize::MAX);
    let (how, which) = (input.byte(), input.byte());
    let (protocol, direction, settings) = (input.protocol(), input.direction(), input.settings());
    let length = usize::from(input.byte());
    let bytes = input.bytes(length);
    let editor = match how & 3 {
        0 => {
            let offers = &OFFERS[usize::from(how >> 2) % OFFERS.len()];
            Editor::new(offers[usize::from(which) % offers.len()], 1, protocol, &settings).ok()
        }
        _ => Some(Editor::of(bytes, protocol, direction, &settings)),
    };
    let Some(mut editor) = editor else { return };
    let mut done = Vec::new();
    while !input.is_over() {
        let (place, what, typed) = (input.byte(), input.byte(), input.byte());
        let mut paths = Vec::new();
        editor.entries().form.visit(&mut |entry| {
            // Lists and bits are few, and much follows from them.
            let times =
                if matches!(entry.content, Content::List { .. } | Content::Cut { .. }) { 3 } else { 1 };
            (0..times).for_each(|_| paths.push(entry.path.clone()));
        });
        let Some(path) = paths.get(usize::from(place) * paths.len() / 256) else { break };
        let change = match what & 15 {
            0 | 1 => Change::Add,
            2 => Change::Remove(usize::from(typed) % 4),
            3 => Change::Bits { part: usize::from(typed) % 8, value: u64::from(typed) },
            _ => Change::Enter(TYPED[usize::from(typed) % TYPED.len()]),
        };
        editor.edit(path, change);
        done.push(format!("{path}: {change:?}"));
    }
    let made = editor.bytes();
    if made.as_ref().is_ok_and(Vec::is_empty) {
        // Nothing is no telegram, and no link leads to it.
        return;
    }
    let link = Link::read(editor.link(&settings).pairs());
    let mut again = Editor::follow(&link).expect("a link of an editor leads to one");
    let show = |bytes: &Result<Vec<u8>, _>| bytes.as_ref().map(|bytes| hex(bytes)).unwrap_or_default();
    assert_eq!(
        show(&again.bytes()),
        show(&made),
        "{} of {} after {done:?} by {:?}",
        editor.label(),
        editor.protocol.key,
        link.pairs()
    );
    if how & 12 == 0 {
        editor.replies(&settings);
        if editor.carry_by(buslens::tool::PROTOCOLS[usize::from(which) % 11], &settings).is_ok() {
            let _ = editor.bytes();
        }
        let _ = editor.open_all();
        let _ = editor.bytes();
    }
}
