use super::law::{assert_same, assert_telegram};
use super::{Target, USUAL_MEMORY};
use crate::{Input, make};
use buslens::field::{Direction, Span};
use buslens::text::{Marks, Place};
use buslens::tool::log::{BEGINNING, Filter, Input as Kind, Log, Reading, Wanted};
use buslens::tool::{Options, PROTOCOLS, proposals};

/// Logs of lines, whole and in pieces.
pub static TEXT: Target = Target {
    key: "log",
    about: "logs of lines: whole as in pieces of any cut, and what is shown of them",
    share: 3,
    memory: USUAL_MEMORY,
    make: |random, seeds| [make::choices(random, CHOICES), make::log(random, seeds)].concat(),
    run: |data| run(data, Kind::Text),
};

/// Bytes without anything between them, whole and in pieces.
pub static STREAM: Target = Target {
    key: "stream",
    about: "streams of telegrams: whole as in pieces of any cut",
    share: 2,
    memory: USUAL_MEMORY,
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
    let marks = (matches!(kind, Kind::Text) && how & 112 == 16).then(|| marks(file, cuts));
    let reading = Reading { input, marks, ..Reading::default() };
    let Some(whole) = read(file, &reading, &options, &[]) else { return };
    let length = file.len().max(1);
    let mut at = cuts.map(|cut| usize::from(cut) * 3 % length);
    at.sort_unstable();
    let parts = read(file, &reading, &options, &at).expect("a file that is read is read in parts");
    assert_same(&parts, &whole, file, &format!("in parts that end at {at:?}"));
    show(&whole, file, how);
}

const CHOICES: usize = 12;

/// What somebody marks in the first line: where the bytes begin, where the time, where a word that says who speaks.
fn marks(file: &[u8], [bytes, time, word]: [u8; 3]) -> Marks {
    let text = String::from_utf8_lossy(file);
    let line = text.lines().next().unwrap_or_default();
    let at = |place: u8| {
        let from = line.floor_char_boundary(usize::from(place) % (line.len() + 1));
        Place::of(line, Span::new(from, line.len()))
    };
    let said: String = line.chars().skip(usize::from(word) % 8).take(2).collect();
    Marks {
        time: (time & 1 == 0).then(|| at(time >> 1)),
        direction: (word & 1 == 0).then(|| (at(word >> 1), said, Direction::Request)),
        bytes: at(bytes),
    }
}

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
    if how & 11 == 1 {
        listed(log, file, how);
    }
    if how & 96 == 0 {
        let text = String::from_utf8_lossy(&file[..file.len().min(usize::from(how) / 8)]).into_owned();
        let wanted = Wanted::ALL[usize::from(how) % Wanted::ALL.len()];
        let filter = Filter { wanted, text, ..Filter::default() };
        assert!(log.filtered(&filter, &file, file.len() as u64).len() <= all);
    }
}

/// What the page asks for: rows, pictures, a telegram by itself, the whole as a report.
fn listed(log: &Log, file: &[u8], how: u8) {
    let all = log.entries().len();
    let few: Vec<u32> = (0..all.min(6) as u32 + 1).collect();
    let rows = log.rows(&file, &few);
    assert_eq!(rows.len(), all.min(7));
    assert!(rows.iter().all(|row| !row.said.is_empty()));
    assert_eq!(log.overview().rows, all);
    for stretches in [0, 1, usize::from(how)] {
        let lanes = log.lanes(None, stretches);
        assert!(lanes.lanes.iter().flat_map(|lane| &lane.marks).all(|mark| mark.at < lanes.stretches));
        log.lanes(Some((i64::MIN, i64::MAX)), stretches);
    }
    for index in 0..all.min(2) {
        let (report, place) = log.report_of(&file, index);
        let excerpt = log.excerpt(&file, index);
        let again = excerpt.report(log.options());
        assert_eq!(again.detail(excerpt.place), report.detail(place), "telegram {index} elsewhere");
        let entry = &log.entry(index);
        let start = log.registers(&file, entry).map_or(u16::from(how), |(start, _)| start);
        assert!(log.series(&file, entry.unit, start, 5).len() <= 5);
    }
    let report = log.whole_report(&file);
    assert!(report.telegrams.len() <= all);
    proposals(&report);
    log.proposals(&file);
    log.text_at(&file, u64::from(how), 9);
    log.piece_at(&file, u64::MAX, 9);
}
