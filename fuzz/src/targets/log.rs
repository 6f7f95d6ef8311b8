use super::Target;
use super::law::{assert_same, assert_telegram};
use crate::{Input, make};
use buslens::tool::log::{BEGINNING, Filter, Input as Kind, Log, Reading, Wanted};
use buslens::tool::{Options, PROTOCOLS};

/// Logs of lines, whole and in pieces.
pub static TEXT: Target = Target {
    key: "log",
    about: "logs of lines: whole as in pieces of any cut, and what is shown of them",
    share: 3,
    make: |random, seeds| [make::choices(random, CHOICES), make::log(random, seeds)].concat(),
    run: |data| run(data, Kind::Text),
};

/// Bytes without anything between them, whole and in pieces.
pub static STREAM: Target = Target {
    key: "stream",
    about: "streams of telegrams: whole as in pieces of any cut",
    share: 2,
    make: |random, seeds| [make::choices(random, CHOICES), make::stream(random, seeds)].concat(),
    run: |data| run(data, Kind::Binary),
};

fn run(data: &[u8], kind: Kind) {
    let mut input = Input::new(data, CHOICES);
    let (how, mut options) = (input.byte(), input.options());
    let cuts = [input.byte(), input.byte(), input.byte()];
    if matches!(kind, Kind::Binary) && how & 1 != 0 {
        options.protocol = Some(PROTOCOLS[[0, 1, 4][usize::from(how >> 1) % 3]]);
    }
    let file = input.content();
    let input = if how & 128 != 0 { Kind::Auto } else { kind };
    let reading = Reading { input, ..Reading::default() };
    let Some(whole) = read(file, &reading, &options, &[]) else { return };
    let length = file.len().max(1);
    let mut at = cuts.map(|cut| usize::from(cut) * 3 % length);
    at.sort_unstable();
    let parts = read(file, &reading, &options, &at).expect("a file that is read is read in parts");
    assert_same(&parts, &whole, &format!("in parts that end at {at:?}"));
    show(&whole, file, how);
}

const CHOICES: usize = 12;

/// Reads a file in parts that end at `cuts`; `None` if it is refused.
pub fn read(file: &[u8], reading: &Reading, options: &Options, cuts: &[usize]) -> Option<Log> {
    let beginning = &file[..file.len().min(BEGINNING)];
    let mut log = Log::open(beginning, file.len() as u64, reading, options.clone()).ok()?;
    let mut from = 0;
    for to in cuts.iter().copied().chain([file.len()]) {
        log.push(&file[from..to]);
        from = to;
    }
    log.finish();
    Some(log)
}

/// What is shown of a log.
pub fn show(log: &Log, file: &[u8], how: u8) {
    let all = log.entries().len();
    let drawn: u32 = log.timeline(None, 7).buckets.iter().map(|bucket| bucket.telegrams).sum();
    assert!(drawn as usize <= all);
    assert!(log.story().iter().all(|sentence| !sentence.to_string().is_empty()));
    if how & 6 == 0 {
        for index in 0..all.min(3) {
            let (report, place) = log.report_of(&file, index);
            assert_telegram(&report, place);
        }
    }
    if how & 24 == 0 {
        log.findings(&file);
    }
    if how & 96 == 0 {
        let text = String::from_utf8_lossy(&file[..file.len().min(usize::from(how) / 8)]).into_owned();
        let wanted = Wanted::ALL[usize::from(how) % Wanted::ALL.len()];
        let filter = Filter { wanted, text, ..Filter::default() };
        assert!(log.filtered(&filter, &file, file.len() as u64).len() <= all);
    }
}
