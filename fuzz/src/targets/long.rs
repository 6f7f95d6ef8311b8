use std::time::{Duration, Instant};

use super::{Target, USUAL_MEMORY};
use crate::{Input, make};
use buslens::tool::log::{Input as Kind, Log, Reading};
use buslens::tool::{Options, decode, settings};

/// The same few words over and over: where that takes more than its share, time is not linear.
pub static TARGET: Target = Target {
    key: "long",
    about: "words repeated up to 64 kB, pasted, as a log and as settings: in linear time",
    share: 2,
    memory: USUAL_MEMORY,
    make: |random, _| [make::choices(random, CHOICES), make::repeated(random)].concat(),
    run,
};

const CHOICES: usize = 1;

/// A hundred times what such texts take, and some more for little text.
const FOR_EACH_BYTE: Duration = Duration::from_micros(20);
const AT_LEAST: Duration = Duration::from_millis(100);

fn run(data: &[u8]) {
    let how = Input::new(data, CHOICES).below(3);
    let file = Input::new(data, CHOICES).content();
    let text = String::from_utf8_lossy(file);
    let read = || match how {
        0 => drop(decode(&text, Options::default())),
        1 => drop(settings::read(&text)),
        _ => {
            let reading = Reading { input: Kind::Text, ..Reading::default() };
            if let Ok(log) = Log::read(file, &reading, Options::default()) {
                log.story();
            }
        }
    };
    // Other things run on the machine: only what takes long again and again takes long.
    let most = AT_LEAST + FOR_EACH_BYTE * file.len() as u32;
    let linear = (0..5).any(|_| {
        let start = Instant::now();
        read();
        start.elapsed() < most
    });
    assert!(linear, "more than {most:?} for {} bytes, way {how}: {:.60?}", file.len(), text);
}
