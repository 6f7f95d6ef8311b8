use super::{Target, USUAL_MEMORY};
use crate::{Input, make};
use buslens::tool::link::{keep_settings, kept_settings};
use buslens::tool::settings::{changed, from_bytes, read, to_bytes, write};

/// Files of settings, and the bytes that a browser and links keep.
pub static TARGET: Target = Target {
    key: "settings",
    about: "settings: text, bytes and links, there and back",
    share: 1,
    memory: USUAL_MEMORY,
    make: |random, seeds| match random.below(3) {
        0 => [vec![0], make::telegram(random, seeds)].concat(),
        _ => [vec![1], make::words(random, "\n")].concat(),
    },
    run,
};

const CHOICES: usize = 1;

fn run(data: &[u8]) {
    let mut input = Input::new(data, CHOICES);
    let settings = match input.byte() {
        0 => from_bytes(input.content()),
        _ => match read(&String::from_utf8_lossy(input.content())) {
            Ok(settings) => settings,
            Err(message) => return assert!(!message.sentence().is_empty()),
        },
    };
    let kept = [
        from_bytes(&to_bytes(&settings)),
        kept_settings(&keep_settings(&settings)),
        read(&write(&settings)).expect("what is written is read"),
    ];
    for again in kept {
        assert_eq!(changed(&again), changed(&settings));
        assert_eq!(again.device, settings.device);
    }
}
