//! A log that is read in slices is the log that is read as a whole, wherever it is cut.

use std::cell::Cell;
use std::fs;
use std::path::Path;

use buslens::field::{Direction, hex};
use buslens::tool::Options;
use buslens::tool::log::{BEGINNING, Division, Entry, Input, Log, Reading, Source, join};

use super::generator::{Random, exchange};
use super::programs::{PROGRAMS, clock};

/// Short, so that small logs have many marks.
const DIVISION: Division = Division { beginning: 20_000, step: 2_000 };

/// A file that counts what is read again.
struct Counted<'a> {
    file: &'a [u8],
    read: Cell<usize>,
}

impl Source for Counted<'_> {
    fn read(&self, from: u64, length: usize) -> Vec<u8> {
        let part = self.file.read(from, length);
        self.read.set(self.read.get() + part.len());
        part
    }
}

/// A log that is opened as one of `size` bytes: of large ones bytes stay in the file.
fn open(file: &[u8], size: u64, reading: &Reading, division: Division) -> Log {
    let beginning = &file[..file.len().min(BEGINNING)];
    let log = Log::open(beginning, size, reading, Options::default()).expect("a log");
    log.divided(Some(division))
}

/// All that there is to tell of a telegram.
fn told(log: &Log, source: &dyn Source, index: usize) -> String {
    let entry: Entry = log.entry(index);
    let Entry { offset, line, skip, length, port, unit, function, verdict, direction, role, .. } = entry;
    format!(
        "{:?} {offset} {line} {skip} {length} {:?} {port} {unit:?} {function} {verdict:?} {direction:?} {role:?} {:?} \
         {:?} {} {}",
        entry.time(),
        entry.partner(),
        entry.sides(),
        entry.written(),
        entry.is_said(),
        hex(&log.bytes(source, &entry)),
    ) + entry.protocol().key
}

fn assert_same(whole: &Log, joined: &Log, file: &[u8], what: &str) {
    for index in 0..whole.entries().len().min(joined.entries().len()) {
        assert_eq!(
            told(joined, &file, index),
            told(whole, &file, index),
            "{what}, telegram {index}: what the slices give, and the whole"
        );
    }
    assert_eq!(joined.entries().len(), whole.entries().len(), "{what}");
    assert_eq!(joined.unread(), whole.unread(), "{what}");
    assert_eq!(joined.lines(), whole.lines(), "{what}");
    assert_eq!(joined.statistics(), whole.statistics(), "{what}");
    assert_eq!(joined.overview(), whole.overview(), "{what}");
    assert_eq!(joined.lanes(None, 50), whole.lanes(None, 50), "{what}");
    assert_eq!(joined.seen(&file), whole.seen(&file), "{what}");
    let findings = |log: &Log| format!("{:?}", log.findings(&file));
    assert_eq!(findings(joined), findings(whole), "{what}");
}

/// Reads `file` as a whole and in slices that begin at some of its marks; returns how many slices there were, and how
/// many bytes were read again.
fn compare(file: &[u8], reading: &Reading, size: u64, random: &mut Random, what: &str) -> (usize, usize) {
    let division = Division { beginning: 20_000, step: random.of(&[500, 2000, 2000, 7000]) };
    let open = || open(file, size, reading, division);
    let mut whole = open();
    whole.push(file);
    whole.finish();
    let Some(settled) = whole.divisible_from() else { return (0, 0) };
    let marks = (file.len() as u64).saturating_sub(settled) / division.step;
    let mut cuts: Vec<u64> = (0..1 + random.below(5))
        .map(|_| settled + (1 + random.below(marks.max(1) as usize) as u64) * division.step)
        .filter(|cut| *cut < file.len() as u64)
        .collect();
    cuts.sort_unstable();
    cuts.dedup();
    let ends = cuts.iter().copied().skip(1).chain([file.len() as u64]);
    let mut first = open();
    first.push(&file[..cuts.first().map_or(file.len(), |cut| *cut as usize)]);
    let read = |(from, to): (u64, u64)| {
        let mut log = open();
        log.push(&file[..settled as usize]);
        assert_eq!(log.divisible_from(), Some(settled), "the beginning tells it");
        let at = log.jump(from) as usize;
        log.push(&file[at..to as usize]);
        if to == file.len() as u64 {
            log.finish();
        }
        log
    };
    let slices: Vec<Log> = cuts.iter().copied().zip(ends).map(read).collect();
    let source = Counted { file, read: Cell::new(0) };
    let joined = join(first, slices, &source, file.len() as u64);
    assert_same(&whole, &joined, file, &format!("{what}, cut at {cuts:?}, marks {division:?}"));
    (cuts.len(), source.read.get())
}

/// A log of exchanges in which some telegrams are damaged, lost or late, with prose between them.
fn with_faults(index: usize, seed: u64, count: usize) -> Vec<u8> {
    const PROSE: [&str; 6] = [
        "Operator restarted pump 4, ticket 20260401 is open.",
        "10:15:00.000 connection lost, timeout",
        "",
        "--- second page ---",
        "setpoint 50 % from 12:30 on, all 4 units fine",
        "[100, 2150, 0]",
    ];
    let program = &PROGRAMS[index];
    let mut random = Random(seed);
    let mut text = String::new();
    let mut late: Option<(Vec<u8>, bool)> = None;
    for n in 0..count {
        for sent in exchange(&mut random) {
            let mut bytes = (program.frame)(&sent, n);
            let asks = sent.direction == Direction::Request;
            match random.below(30) {
                0 => {
                    let at = random.below(bytes.len());
                    bytes[at] ^= 1 << random.below(8);
                }
                1 => continue,
                2 => bytes.truncate(1 + random.below(bytes.len())),
                3 if !asks => {
                    late = Some((bytes, asks));
                    continue;
                }
                4 => {
                    text += random.of(&PROSE);
                    text.push('\n');
                }
                _ => {}
            }
            (program.write)(&mut text, &bytes, asks, n);
            if let Some((bytes, asks)) = late.take() {
                (program.write)(&mut text, &bytes, asks, n);
            }
        }
    }
    text.into_bytes()
}

/// As one of a small file, and as one of a large one.
const SIZES: [u64; 2] = [1 << 20, 1 << 40];

#[test]
fn logs_of_every_layout() {
    let mut random = Random(19);
    let (mut slices, mut logs) = (0, 0);
    for index in 0..PROGRAMS.len() {
        for size in SIZES {
            let file = with_faults(index, random.next(), 1500);
            let (found, _) =
                compare(&file, &Reading::default(), size, &mut random, &format!("layout {index}"));
            slices += found;
            logs += 1;
        }
    }
    assert!(slices > 2 * logs, "{slices} slices of {logs} logs");
}

#[test]
fn raw_streams_with_noise() {
    let mut random = Random(20);
    let reading = Reading { input: Input::Binary, ..Reading::default() };
    for seed in 0..12 {
        let mut file = Vec::new();
        for n in 0..4000_u16 {
            for sent in exchange(&mut random) {
                let bytes = if seed % 3 == 2 { sent.tcp(n) } else { sent.rtu() };
                file.extend(match random.below(40) {
                    0 => random.bytes(1 + bytes.len()),
                    1 => bytes[1..].to_vec(),
                    2 => [bytes, random.bytes(3)].concat(),
                    _ => bytes,
                });
            }
        }
        for size in SIZES {
            let (slices, _) = compare(&file, &reading, size, &mut random, &format!("stream {seed}"));
            assert!(slices > 0);
        }
    }
}

/// What people posted, one behind the other, again and again.
#[test]
fn posts_behind_each_other() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/posts");
    let mut posts: Vec<Vec<u8>> = fs::read_dir(folder)
        .expect("posts")
        .map(|entry| entry.expect("a file").path())
        .filter(|path| path.extension().is_some_and(|it| it == "txt"))
        .map(|path| fs::read(path).expect("a post"))
        .collect();
    posts.sort();
    let mut random = Random(21);
    for n in 0..12 {
        let mut file = Vec::new();
        while file.len() < 400_000 {
            file.extend_from_slice(&posts[random.below(posts.len())]);
            file.push(b'\n');
            // Logs have more telegrams than posts.
            if n % 2 == 0 {
                file.extend(with_faults(random.below(PROGRAMS.len()), random.next(), 20));
            }
        }
        compare(&file, &Reading::default(), SIZES[n % 2], &mut random, &format!("posts {n}"));
    }
}

/// A log without faults, for some days.
fn clean(days: u32) -> Vec<u8> {
    let mut random = Random(22);
    let exchanges = 3000 * days;
    let lines = (0..exchanges).flat_map(|n| {
        let seconds = (u64::from(n) * 86_400 * u64::from(days) / u64::from(exchanges) + 40_000) % 86_400;
        let [request, response] = exchange(&mut random).map(|sent| hex(&sent.rtu()));
        let time = format!("{:02}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
        format!("{time}.100 TX: {request}\n{time}.112 RX: {response}\n").into_bytes()
    });
    lines.collect()
}

/// Where nothing is wrong, hardly anything is read again.
#[test]
fn slices_meet_at_once_over_midnight() {
    let file = clean(5);
    let mut random = Random(23);
    for size in SIZES {
        for n in 0..10 {
            let (slices, again) =
                compare(&file, &Reading::default(), size, &mut random, &format!("days {n}"));
            assert!(slices > 0 && again <= slices * 14_000, "{again} bytes again for {slices} slices");
        }
    }
}

/// What cannot be divided is read by one.
#[test]
fn the_slices_of_a_file() {
    let file = clean(5);
    let mut log = open(&file, file.len() as u64, &Reading::default(), DIVISION);
    let size = file.len() as u64;
    assert_eq!(log.slices(size, 4, 1), [0..size], "its beginning is not read");
    log.push(&file[..24_000]);
    assert_eq!(log.divisible_from(), Some(20_000));
    let slices = log.slices(size, 4, 1);
    assert_eq!(slices.len(), 4);
    assert_eq!((slices[0].start, slices[3].end), (24_000, size));
    assert!(slices.windows(2).all(|pair| pair[0].end == pair[1].start));
    assert!(slices[1..].iter().all(|slice| slice.start % DIVISION.step == 0));
    assert_eq!(log.slices(size, 4, size).len(), 1, "it is too small");
    let text: String = (0..3000).map(|n| format!("{} nothing is here\n", clock(n))).collect();
    let mut log = open(text.as_bytes(), text.len() as u64, &Reading::default(), DIVISION);
    log.push(text.as_bytes());
    assert_eq!(log.divisible_from(), None, "it tells nothing");
}
