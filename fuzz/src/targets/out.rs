use std::collections::BTreeMap;

use super::log::read;
use super::{Target, USUAL_MEMORY};
use crate::{Input, make};
use buslens::tool::Options;
use buslens::tool::log::{CaptureFile, Hidden, Input as Kind, Log, Reading, Redacted};

/// What goes out of a log.
pub static TARGET: Target = Target {
    key: "out",
    about: "what goes out of a log: its digest, a capture, a log to pass on",
    share: 2,
    // A log, and what is made of it.
    memory: 2 * USUAL_MEMORY,
    make: |random, seeds| {
        let file = match random.below(4) {
            0 => make::stream(random, seeds),
            1 => make::capture(random, seeds),
            _ => make::log(random, seeds),
        };
        [make::choices(random, CHOICES), file].concat()
    },
    run,
};

const CHOICES: usize = 4;

fn run(data: &[u8]) {
    let mut input = Input::new(data, CHOICES);
    let (how, device) = (input.byte(), input.device());
    let name = input.byte();
    let file = input.content();
    let options = Options { device, ..Options::default() };
    let Some(log) = read(file, &Reading::default(), &options, &[]) else { return };
    match how % 3 {
        0 => digest(&log, file),
        1 => capture(&log, file, &options),
        _ => {
            let names =
                vec![String::from_utf8_lossy(&file[..file.len().min(usize::from(name) % 12)]).into_owned()];
            let hidden = Hidden { units: how & 4 == 0, addresses: how & 8 == 0, texts: how & 16 == 0, names };
            passed_on(&log, file, &hidden);
        }
    }
}

fn digest(log: &Log, file: &[u8]) {
    let digest = log.digest(&file, &log.findings(&file));
    assert!(digest.telegrams.is_sorted_by_key(|line| line.number));
    assert!(!digest.text(true).is_empty() && !digest.html(false).contains("<script"));
}

/// A capture of a log has its telegrams.
fn capture(log: &Log, file: &[u8], options: &Options) {
    let mut made = CaptureFile::default();
    let all: Vec<usize> = (0..log.entries().len()).collect();
    let mut bytes = made.begin();
    bytes.extend(made.telegrams(log, &file, &all, &BTreeMap::from([(1, "a note".to_owned())])));
    let reading = Reading { input: Kind::Capture, ..Reading::default() };
    let again = read(&bytes, &reading, options, &[]);
    let fault = again.and_then(|again| again.fault());
    assert!(fault.is_none(), "{fault:?}");
}

/// A log to pass on is as long, and nothing that was hidden is in it.
fn passed_on(log: &Log, file: &[u8], hidden: &Hidden) {
    let Redacted { file: passed, replaced, is_capture, .. } = log.redacted(&file, file.len() as u64, hidden);
    // What was in UTF-16 goes out in UTF-8. A decimal byte can have some digits more or less than another, and one
    // more than "0xB".
    let is_decimal =
        |number: &&[u8]| (1..=3).contains(&number.len()) && number.iter().all(u8::is_ascii_digit);
    let decimals = file.split(|c| !c.is_ascii_alphanumeric()).filter(is_decimal).count();
    let prefixes = file.windows(2).filter(|two| matches!(two, [b'0', b'x' | b'X'] | [b'\\', b'x'])).count();
    let utf_16 = file.contains(&0) || file.starts_with(&[0xFF, 0xFE]) || file.starts_with(&[0xFE, 0xFF]);
    let same = passed.len().abs_diff(file.len()) <= 2 * decimals + prefixes || utf_16;
    assert!(is_capture || same, "{} of {}", passed.len(), file.len());
    for it in &replaced {
        assert!(it.times > 0 && it.from != it.to, "{it:?}");
    }
}
