//! Runs the targets for a time: `fuzz SECONDS [--seed N] [--only TARGET] [--threads N]`, for a number of rounds
//! (`--rounds N` in the place of `SECONDS`), or one input again: `fuzz --replay FILE`.

mod memory;

use std::collections::HashMap;
use std::num::NonZero;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use fuzz::{Random, Seeds, TARGETS, Target, smaller};

#[global_allocator]
static MEMORY: memory::Counted = memory::Counted;

const USAGE: &str = "\
Usage: fuzz SECONDS [--seed N] [--only TARGET] [--threads N]
       fuzz --rounds N [--seed N] [--only TARGET] [--threads N]
       fuzz --replay FILE";

/// Where failing inputs go, below Cargo's target folder.
const FOLDER: &str = "fuzz";

/// No input takes longer: they have some hundred bytes, and a machine that is busy is slow.
const LONGEST: Duration = Duration::from_secs(60);

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let (length, options) = match words[..] {
        ["--replay", file] => return replay(Path::new(file)),
        ["--rounds", rounds, ref options @ ..] => (rounds.parse().map(Length::Rounds), options),
        [seconds, ref options @ ..] => {
            (seconds.parse().map(|seconds| Length::Time(Duration::from_secs(seconds))), options)
        }
        [] => return refuse(),
    };
    let Ok(length) = length else { return refuse() };
    let (mut seed, mut only) = (None, None);
    let mut threads = std::thread::available_parallelism().map_or(1, usize::from);
    for pair in options.chunks(2) {
        let understood = match *pair {
            ["--seed", number] => number.parse().map(|number| seed = Some(number)).is_ok(),
            ["--only", key] => {
                only = TARGETS.iter().copied().find(|target| target.key == key);
                only.is_some()
            }
            ["--threads", number] => {
                number.parse().map(|number: NonZero<usize>| threads = number.get()).is_ok()
            }
            _ => false,
        };
        if !understood {
            return refuse();
        }
    }
    // Without one, each run tries other inputs.
    let seed = seed.unwrap_or_else(|| std::time::UNIX_EPOCH.elapsed().map_or(1, |elapsed| elapsed.as_secs()));
    match run(length, seed, only, threads) {
        Ok(0) => ExitCode::SUCCESS,
        Ok(_) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn refuse() -> ExitCode {
    eprintln!("{USAGE}");
    ExitCode::from(2)
}

/// Runs one input again, with the panic as it comes.
fn replay(file: &Path) -> ExitCode {
    let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let key = name.split('-').next().unwrap_or_default();
    let Some(target) = TARGETS.iter().copied().find(|target| target.key == key) else {
        eprintln!("{name} does not begin with the name of a target.");
        return ExitCode::from(2);
    };
    match std::fs::read(file) {
        Ok(input) => {
            (target.run)(&input);
            println!("{name} holds.");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{}: {error}", file.display());
            ExitCode::from(2)
        }
    }
}

/// How long a run is.
#[derive(Clone, Copy)]
enum Length {
    Time(Duration),
    /// Each thread tries some inputs of each target, so often: the same ones on any machine.
    Rounds(u64),
}

/// What a thread is at.
struct Now {
    target: &'static str,
    input: Vec<u8>,
    since: Instant,
}

/// What the threads share.
struct Run {
    /// Executions by target.
    counts: Vec<AtomicU64>,
    /// Nanoseconds by target.
    times: Vec<AtomicU64>,
    /// What failed, by target and place in the source.
    failures: Mutex<HashMap<(&'static str, String), String>>,
    at: Vec<Mutex<Now>>,
    over: AtomicBool,
    /// How many threads are at work.
    busy: AtomicU64,
}

/// Runs all targets, or only one; returns how many kinds of failures there are.
fn run(length: Length, seed: u64, only: Option<&'static Target>, threads: usize) -> Result<usize, String> {
    let seeds = Seeds::load().map_err(|error| format!("The vectors cannot be read: {error}."))?;
    let targets: Vec<&'static Target> =
        TARGETS.iter().copied().filter(|target| only.is_none_or(|only| only.key == target.key)).collect();
    let start = Instant::now();
    let run = Run {
        counts: targets.iter().map(|_| AtomicU64::new(0)).collect(),
        times: targets.iter().map(|_| AtomicU64::new(0)).collect(),
        failures: Mutex::default(),
        at: (0..threads).map(|_| Mutex::new(Now { target: "", input: Vec::new(), since: start })).collect(),
        over: AtomicBool::new(false),
        busy: AtomicU64::new(threads as u64),
    };
    // What panics is told once, with its input.
    std::panic::set_hook(Box::new(|panic| {
        let place = panic.location().map_or(String::new(), ToString::to_string);
        let text = panic.payload_as_str().unwrap_or_default().to_owned();
        PANIC.set((place, text));
    }));
    println!("Seed {seed}, {threads} threads, {} telegrams to begin with.", seeds.telegrams.len());
    std::thread::scope(|scope| {
        for thread in 0..threads {
            let (run, seeds, targets) = (&run, &seeds, &targets);
            let random = Random(seed.wrapping_mul(1000).wrapping_add(thread as u64));
            scope.spawn(move || {
                work(run, thread, targets, seeds, random, length);
                run.busy.fetch_sub(1, Ordering::Relaxed);
            });
        }
        watch(&run, start, length);
    });
    let _ = std::panic::take_hook();
    tell(&run, &targets, start.elapsed());
    let failures = run.failures.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    Ok(failures.len())
}

thread_local! {
    /// Where the last panic of the thread was, and what it said.
    static PANIC: std::cell::Cell<(String, String)> = const { std::cell::Cell::new((String::new(), String::new())) };
}

/// Tries inputs until the time is over: some milliseconds for each target in turn, or some inputs.
fn work(
    run: &Run,
    thread: usize,
    targets: &[&'static Target],
    seeds: &Seeds,
    mut random: Random,
    length: Length,
) {
    const TURN: Duration = Duration::from_millis(4);
    let mut round = 0;
    while !run.over.load(Ordering::Relaxed) && !matches!(length, Length::Rounds(rounds) if round == rounds) {
        round += 1;
        for (index, target) in targets.iter().enumerate() {
            let turn = TURN * target.share;
            let (start, mut count) = (Instant::now(), 0);
            let goes_on = |count: u64| match length {
                Length::Time(_) => start.elapsed() < turn,
                Length::Rounds(_) => count < 8 * u64::from(target.share),
            };
            while goes_on(count) {
                for _ in 0..8 {
                    let input = (target.make)(&mut random, seeds);
                    {
                        let mut now = locked(&run.at[thread]);
                        (now.target, now.since) = (target.key, Instant::now());
                        now.input.clone_from(&input);
                    }
                    if let Err(failure) = try_input(target, &input) {
                        note(run, thread, target, input, failure);
                    }
                    count += 1;
                }
            }
            run.counts[index].fetch_add(count, Ordering::Relaxed);
            run.times[index].fetch_add(start.elapsed().as_nanos() as u64, Ordering::Relaxed);
        }
    }
    locked(&run.at[thread]).target = "";
}

/// Runs an input: where it failed and how, if it did.
fn try_input(target: &Target, input: &[u8]) -> Result<(), (String, String)> {
    let before = memory::begin();
    let outcome = catch_unwind(AssertUnwindSafe(|| (target.run)(input)));
    let used = memory::peak().saturating_sub(before);
    /// The most memory for each byte of input.
    const FOR_EACH: usize = 400;
    match outcome {
        Err(_) => Err(PANIC.take()),
        Ok(()) if used > target.memory + FOR_EACH * input.len() => {
            Err(("memory".to_owned(), format!("{used} bytes of memory for {} of input", input.len())))
        }
        Ok(()) => Ok(()),
    }
}

/// Writes a failing input, made as small as it gets, unless the same place failed before.
fn note(run: &Run, thread: usize, target: &'static Target, input: Vec<u8>, (place, text): (String, String)) {
    if locked(&run.failures).contains_key(&(target.key, place.clone())) {
        return;
    }
    let input = smaller(input, |input| {
        locked(&run.at[thread]).since = Instant::now();
        try_input(target, input).is_err_and(|(at, _)| at == place)
    });
    let text = try_input(target, &input).err().map_or(text, |(_, text)| text);
    let mut failures = locked(&run.failures);
    if failures.contains_key(&(target.key, place.clone())) {
        return;
    }
    let told = match keep(target.key, &input) {
        Ok(path) => format!("again by `cargo xtask fuzz --replay {}`", path.display()),
        Err(error) => format!("the input could not be written: {error}"),
    };
    println!("\n{}: {place}\n  {text}\n  {} bytes, {told}", target.key, input.len());
    failures.insert((target.key, place), text);
}

/// Writes an input into its folder.
fn keep(key: &str, input: &[u8]) -> std::io::Result<PathBuf> {
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| PathBuf::from("target"), PathBuf::from);
    let folder = target.join(FOLDER);
    std::fs::create_dir_all(&folder)?;
    let number = input.iter().fold(0xCBF2_9CE4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01B3)
    });
    let path = folder.join(format!("{key}-{number:016x}"));
    std::fs::write(&path, input)?;
    Ok(path)
}

/// Waits for the end, and ends everything where an input takes too long.
fn watch(run: &Run, start: Instant, length: Length) {
    const LOOK: Duration = Duration::from_millis(200);
    loop {
        match length {
            Length::Time(time) if start.elapsed() >= time => break,
            Length::Time(time) => std::thread::sleep(LOOK.min(time.saturating_sub(start.elapsed()))),
            Length::Rounds(_) if run.busy.load(Ordering::Relaxed) == 0 => break,
            Length::Rounds(_) => std::thread::sleep(LOOK),
        }
        for at in &run.at {
            let now = locked(at);
            if !now.target.is_empty() && now.since.elapsed() > LONGEST {
                let told = keep(now.target, &now.input)
                    .map_or_else(|error| error.to_string(), |it| it.display().to_string());
                eprintln!("\n{}: an input takes more than {LONGEST:?}: {told}", now.target);
                std::process::exit(1);
            }
        }
    }
    run.over.store(true, Ordering::Relaxed);
}

/// Prints the executions of each target.
fn tell(run: &Run, targets: &[&'static Target], elapsed: Duration) {
    println!();
    let mut all = 0;
    for (index, target) in targets.iter().enumerate() {
        let (count, time) =
            (run.counts[index].load(Ordering::Relaxed), run.times[index].load(Ordering::Relaxed));
        all += count;
        let micros = time as f64 / 1000.0 / count.max(1) as f64;
        println!("{count:>12}  {:<9} {micros:>7.1} µs each  {}", target.key, target.about);
    }
    println!("{all:>12}  together in {:.0} s", elapsed.as_secs_f64());
}

fn locked<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}
