//! A log that is read in slices is the log that is read as a whole, wherever it is cut.

use std::fs;
use std::path::Path;

use buslens::field::{Direction, hex};
use buslens::tool::Options;
use buslens::tool::log::{BEGINNING, Division, Entry, Input, Log, Reading, Slice, Source};

use super::generator::{Random, exchange};
use super::programs::{PROGRAMS, clock};

/// Short, so that small logs have many marks.
const DIVISION: Division = Division { beginning: 20_000, step: 2_000 };

/// A log that is opened as one of `size` bytes: of large ones bytes stay in the file.
fn open(file: &[u8], size: u64, reading: &Reading, division: Division) -> Log {
    let beginning = &file[..file.len().min(BEGINNING)];
    let log = Log::open(beginning, size, reading, Options::default()).expect("a log");
    log.divided(division)
}

/// All that there is to tell of a telegram.
fn told(log: &Log, source: &dyn Source, index: usize) -> String {
    let entry: Entry = log.entry(index);
    assert_eq!(log.entries().time(index), entry.time(), "telegram {index}");
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

/// How a log is read in slices.
struct Trial {
    reading: Reading,
    /// It is opened as one of so many bytes.
    size: u64,
    /// What may be between two marks.
    steps: &'static [u64],
    /// The slice that is lost.
    lost: Option<usize>,
}

impl Trial {
    fn of(size: u64) -> Self {
        Self { reading: Reading::default(), size, steps: &[500, 2000, 2000, 7000], lost: None }
    }
}

/// Reads `file` as a whole and in slices that begin at some of its marks; returns how many slices there were, and how
/// many bytes were read again.
fn compare(file: &[u8], trial: &Trial, random: &mut Random, what: &str) -> (usize, usize) {
    let Trial { reading, size, steps, lost } = trial;
    let division = Division { beginning: 20_000, step: random.of(steps) };
    let open = || open(file, *size, reading, division);
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
    let mut read = |(from, to): (u64, u64)| {
        let mut log = open();
        log.push(&file[..settled as usize]);
        assert_eq!(log.divisible_from(), Some(settled), "the beginning tells it");
        let at = log.jump(from) as usize;
        let mut slice = Slice::default();
        for part in file[at..to as usize].chunks(random.of(&[5000, 60_000])) {
            log.push(part);
            assert!(slice.take(&log.hand_over()) && !slice.is_whole());
        }
        assert!(slice.take(&log.hand_over_rest(file.len() as u64)) && slice.is_whole());
        slice
    };
    let mut slices: Vec<Slice> = cuts.iter().copied().zip(ends).map(&mut read).collect();
    if let Some(lost) = lost.filter(|lost| *lost < slices.len()) {
        slices.remove(lost);
    }
    let (mut joined, mut again) = (first, 0);
    while joined.taken() < file.len() as u64 && !joined.join(&mut slices, file.len() as u64) {
        let next = file.len().min(joined.next_mark() as usize);
        let part = &file[joined.taken() as usize..next];
        again += part.len();
        joined.push(part);
    }
    joined.finish();
    assert_same(&whole, &joined, file, &format!("{what}, cut at {cuts:?}, marks {division:?}"));
    (cuts.len(), again)
}

/// A log of exchanges in which some telegrams are damaged, lost or late, with prose between them.
fn with_faults(index: usize, seed: u64, count: usize) -> Vec<u8> {
    const PROSE: [&str; 7] = [
        "Operator restarted pump 4, ticket 20260401 is open.",
        "10:15:00.000 connection lost, timeout",
        "",
        "--- second page ---",
        "setpoint 50 % from 12:30 on, all 4 units fine",
        "[100, 2150, 0]",
        "polled 10 5B 0A 65 16 of the heat meter",
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
    assert!(read_layouts(19, 500, 1) > PROGRAMS.len());
}

/// Returns how many slices there were.
fn read_layouts(seed: u64, exchanges: usize, rounds: usize) -> usize {
    let mut random = Random(seed);
    let mut slices = 0;
    for n in 0..rounds * PROGRAMS.len() {
        let file = with_faults(n % PROGRAMS.len(), random.next(), exchanges);
        let what = format!("layout {}", n % PROGRAMS.len());
        slices += compare(&file, &Trial::of(random.of(&SIZES)), &mut random, &what).0;
    }
    slices
}

#[test]
fn raw_streams_with_noise() {
    assert!(read_streams(20, 2000, 6) > 6);
}

fn read_streams(seed: u64, exchanges: u16, rounds: usize) -> usize {
    let mut random = Random(seed);
    let reading = Reading { input: Input::Binary, ..Reading::default() };
    let mut slices = 0;
    for round in 0..rounds {
        let mut file = Vec::new();
        for n in 0..exchanges {
            for sent in exchange(&mut random) {
                let bytes = if round % 3 == 2 { sent.tcp(n) } else { sent.rtu() };
                file.extend(match random.below(40) {
                    0 => random.bytes(1 + bytes.len()),
                    1 => bytes[1..].to_vec(),
                    2 => [bytes, random.bytes(3)].concat(),
                    _ => bytes,
                });
            }
        }
        let trial = Trial { reading: reading.clone(), ..Trial::of(SIZES[round % 2]) };
        slices += compare(&file, &trial, &mut random, &format!("stream {round}")).0;
    }
    slices
}

#[test]
fn posts_behind_each_other() {
    read_posts(21, 60_000, 4);
}

/// What people posted, one behind the other, again and again.
fn read_posts(seed: u64, size: usize, rounds: usize) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/posts");
    let mut posts: Vec<Vec<u8>> = fs::read_dir(folder)
        .expect("posts")
        .map(|entry| entry.expect("a file").path())
        .filter(|path| path.extension().is_some_and(|it| it == "txt"))
        .map(|path| fs::read(path).expect("a post"))
        .collect();
    posts.sort();
    let mut random = Random(seed);
    for n in 0..rounds {
        let mut file = Vec::new();
        while file.len() < size {
            file.extend_from_slice(&posts[random.below(posts.len())]);
            file.push(b'\n');
            // Logs have more telegrams than posts.
            file.extend(with_faults(random.below(PROGRAMS.len()), random.next(), 20));
        }
        compare(&file, &Trial::of(SIZES[n % 2]), &mut random, &format!("posts {n}"));
    }
}

#[test]
#[ignore = "takes minutes: `cargo test --release -p buslens --test logs slices -- --ignored`"]
fn many_logs_in_slices() {
    read_layouts(1019, 1500, 12);
    read_streams(1020, 4000, 60);
    read_posts(1021, 400_000, 60);
}

/// A log without faults, for some days.
fn clean(days: u32) -> Vec<u8> {
    let mut random = Random(22);
    let exchanges = 700 * days;
    let lines = (0..exchanges).flat_map(|n| {
        let seconds = (u64::from(n) * 86_400 * u64::from(days) / u64::from(exchanges) + 40_000) % 86_400;
        let [request, response] = exchange(&mut random).map(|sent| hex(&sent.rtu()));
        let time = format!("{:02}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
        format!("{time}.100 TX: {request}\n{time}.112 RX: {response}\n").into_bytes()
    });
    lines.collect()
}

/// Where nothing is wrong, nothing is read again.
#[test]
fn slices_meet_at_once_over_midnight() {
    let file = clean(5);
    let mut random = Random(23);
    for size in SIZES {
        for n in 0..3 {
            // As many telegrams are in hand before they are settled as 2,000 bytes have.
            let trial = Trial { steps: &[7000], ..Trial::of(size) };
            let (slices, again) = compare(&file, &trial, &mut random, &format!("days {n}"));
            assert!(slices > 0 && again == 0, "{again} bytes again for {slices} slices");
        }
    }
}

/// A worker may fail: its slice is read by the first one.
#[test]
fn a_slice_that_is_lost_is_read_again() {
    let file = clean(5);
    let mut random = Random(24);
    for n in 0..6 {
        let trial = Trial { lost: Some(random.below(3)), ..Trial::of(SIZES[n % 2]) };
        compare(&file, &trial, &mut random, &format!("{:?} lost, {n}", trial.lost));
    }
}

/// What cannot be divided is read by one.
#[test]
fn the_slices_of_a_file() {
    let file = clean(5);
    let mut log = open(&file, file.len() as u64, &Reading::default(), DIVISION);
    let size = file.len() as u64;
    let slices = log.slices(size, 4, 1);
    assert!(slices.len() == 1 && slices[0] == (0..size), "its beginning is not read");
    log.push(&file[..24_000]);
    assert_eq!(log.divisible_from(), Some(20_000));
    let slices = log.slices(size, 4, 1);
    assert_eq!(slices.len(), 4);
    assert_eq!((slices[0].start, slices[3].end), (24_000, size));
    assert!(slices.windows(2).all(|pair| pair[0].end == pair[1].start));
    assert!(slices[1..].iter().all(|slice| slice.start % DIVISION.step == 0));
    assert_eq!(log.slices(size, 4, size).len(), 1, "it is too small");
    let text: String = (0..1500).map(|n| format!("{} nothing is here\n", clock(n))).collect();
    let mut log = open(text.as_bytes(), text.len() as u64, &Reading::default(), DIVISION);
    log.push(text.as_bytes());
    assert_eq!(log.divisible_from(), None, "it tells nothing");
}
