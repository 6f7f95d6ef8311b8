//! The tests in which all mutants sleep: built once, then run with one of them awake.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use serde::Deserialize;

use crate::Result;
use crate::list::Mutant;
use crate::switch::{Switched, switch};

/// Which mutant is awake.
const AWAKE: &str = "BUSLENS_MUTANT";
/// The file that is told which ones were met.
const MET: &str = "BUSLENS_MUTANTS_MET";

/// What a mutant asks. A function that the compiler calls, too, cannot know which one is awake, and says no there.
const ASKED: &str = r#"
/// Which change is tried.
#[doc(hidden)]
pub mod mutants {
    use std::io::Write as _;
    use std::sync::LazyLock;
    use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

    static AWAKE: LazyLock<u32> =
        LazyLock::new(|| std::env::var("BUSLENS_MUTANT").ok().and_then(|it| it.parse().ok()).unwrap_or(u32::MAX));
    static MET: [AtomicBool; COUNT] = [const { AtomicBool::new(false) }; COUNT];

    pub const fn is(number: u32) -> bool {
        const fn never(_: u32) -> bool {
            false
        }
        std::intrinsics::const_eval_select((number,), never, awake)
    }

    fn awake(number: u32) -> bool {
        let met = &MET[number as usize];
        if !met.load(Relaxed) && !met.swap(true, Relaxed) {
            if let Ok(path) = std::env::var("BUSLENS_MUTANTS_MET") {
                let file = std::fs::OpenOptions::new().append(true).create(true).open(path);
                let _ = file.and_then(|mut file| writeln!(file, "{number}"));
            }
        }
        *AWAKE == number
    }
}
"#;

/// A test, and how long it takes.
#[derive(Clone, Debug)]
struct Test {
    binary: usize,
    name: String,
    time: Duration,
}

/// The built tests.
pub struct Suite {
    folder: PathBuf,
    binaries: Vec<PathBuf>,
    tests: Vec<Test>,
    /// The tests that come past a mutant, the quickest first.
    met: HashMap<usize, Vec<usize>>,
    /// The mutants that have a switch.
    pub switched: HashSet<usize>,
}

/// What became of a mutant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    Noticed,
    /// Its tests take for ever.
    Endless,
    Survived,
    /// No test comes past it while it runs.
    NotMet,
    /// It has no switch: it does not compile, or not beside the others.
    NoSwitch,
}

impl Suite {
    /// Puts all `mutants` into the copy of the project in `folder`, and builds its tests; those whose names hold
    /// `tests` are run.
    pub fn build(folder: &Path, mutants: &[Mutant], tests: &str) -> Result<Self> {
        let mut files: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
        for (number, mutant) in mutants.iter().enumerate() {
            files.entry(&mutant.file).or_default().push(number);
        }
        let read = |file: &str| {
            fs::read_to_string(folder.join(file)).map_err(|error| format!("{file} cannot be read: {error}."))
        };
        let sources: BTreeMap<&str, String> =
            files.keys().map(|file| Ok((*file, read(file)?))).collect::<Result<_>>()?;
        prepare(folder, mutants.len())?;
        let mut left_out: HashSet<usize> = HashSet::new();
        loop {
            let mut written: HashMap<&str, Switched> = HashMap::new();
            for (file, numbers) in &files {
                let chosen: Vec<(usize, &Mutant)> = numbers
                    .iter()
                    .filter(|number| !left_out.contains(number))
                    .map(|number| (*number, &mutants[*number]))
                    .collect();
                let switched = switch(&sources[file], &chosen).map_err(|error| format!("{file}: {error}"))?;
                fs::write(folder.join(file), &switched.text).map_err(|error| format!("{file}: {error}"))?;
                written.insert(file, switched);
            }
            let errors = compile(folder, &["check", "--lib"])?.1;
            if errors.is_empty() {
                let switched = written.into_values().flat_map(|file| file.switched).collect();
                return Self::with(folder, switched, tests);
            }
            let before = left_out.len();
            for error in &errors {
                let blamed = |places: &[(String, usize)]| -> Vec<usize> {
                    let of = |(file, at): &(String, usize)| Some(written.get(file.as_str())?.to_blame(*at));
                    places.iter().filter_map(of).flatten().copied().collect()
                };
                // What was moved too early is told where it is missed, and where it went beside that.
                let mut found = blamed(&error.places);
                if found.iter().all(|number| left_out.contains(number)) {
                    found = blamed(&error.beside);
                }
                if found.is_empty() {
                    println!("{:?}: {}", error.places, error.message);
                }
                left_out.extend(found);
            }
            println!("{} do not compile beside the others.", left_out.len());
            if left_out.len() == before {
                return Err("What does not compile is no mutant.".to_owned());
            }
        }
    }

    fn with(folder: &Path, switched: HashSet<usize>, tests: &str) -> Result<Self> {
        println!("Building the tests with {} changes asleep.", switched.len());
        let (binaries, errors) = compile(folder, &["test", "--no-run", "--lib", "--test", "all"])?;
        if let Some(error) = errors.first() {
            return Err(format!("The tests do not compile: {:?}: {}", error.places, error.message));
        }
        let binaries = binaries.iter().map(|binary| kept(folder, binary)).collect::<Result<_>>()?;
        let mut suite =
            Self { folder: folder.to_owned(), binaries, tests: Vec::new(), met: HashMap::new(), switched };
        suite.survey(tests)?;
        Ok(suite)
    }

    /// Runs each test by itself with all mutants asleep, to see which of them it meets.
    fn survey(&mut self, tests: &str) -> Result {
        let list = self.folder.join("met.txt");
        for binary in 0..self.binaries.len() {
            let output = self.command(binary).args(["--list", "--format", "terse"]).output();
            let output = output.map_err(|error| format!("The tests do not start: {error}."))?;
            let names = String::from_utf8_lossy(&output.stdout).into_owned();
            let names = names.lines().filter_map(|line| line.strip_suffix(": test"));
            for name in names.filter(|name| name.contains(tests)) {
                let _ = fs::remove_file(&list);
                let start = Instant::now();
                let test = Test { binary, name: name.to_owned(), time: Duration::ZERO };
                let passed = self.passes(&[&test], (MET, list.as_os_str()), LONGEST);
                if passed != Some(true) {
                    println!("{name} fails without any change, and is left out.");
                    continue;
                }
                let time = start.elapsed();
                let met = fs::read_to_string(&list).unwrap_or_default();
                let at = self.tests.len();
                for number in met.lines().filter_map(|line| line.parse().ok()) {
                    self.met.entry(number).or_default().push(at);
                }
                self.tests.push(Test { time, ..test });
            }
        }
        let tests = &self.tests;
        self.met.values_mut().for_each(|met| met.sort_by_key(|at| tests[*at].time));
        let time: Duration = self.tests.iter().map(|test| test.time).sum();
        println!("{} tests meet {} of them in {time:.0?}.", self.tests.len(), self.met.len());
        Ok(())
    }

    /// Runs the tests that meet a mutant while it is awake, until one of them fails.
    pub fn try_mutant(&self, number: usize) -> (Outcome, String) {
        if !self.switched.contains(&number) {
            return (Outcome::NoSwitch, String::new());
        }
        let Some(met) = self.met.get(&number) else { return (Outcome::NotMet, String::new()) };
        let mut left: Vec<&Test> = met.iter().map(|at| &self.tests[*at]).collect();
        while !left.is_empty() {
            // Some quick ones at once: a process takes time, too.
            let binary = left[0].binary;
            let (mut batch, mut time) = (Vec::new(), Duration::ZERO);
            left.retain(|test| {
                let fits = test.binary == binary && (batch.is_empty() || time + test.time < BATCH);
                if fits {
                    batch.push(*test);
                    time += test.time;
                }
                !fits
            });
            let limit = Duration::from_secs(5) + time * 15;
            match self.passes(&batch, (AWAKE, number.to_string().as_ref()), limit) {
                None => return (Outcome::Endless, batch[0].name.clone()),
                Some(false) => return (Outcome::Noticed, batch[0].name.clone()),
                Some(true) => {}
            }
        }
        (Outcome::Survived, format!("{} tests", met.len()))
    }

    fn command(&self, binary: usize) -> Command {
        let mut command = Command::new(&self.binaries[binary]);
        command.current_dir(self.folder.join("crates/buslens"));
        // The same inputs each time.
        command.env("PROPTEST_RNG_SEED", "1");
        command
    }

    /// Whether tests of one binary pass; `None` if they are not done in time.
    fn passes(&self, tests: &[&Test], (name, value): (&str, &OsStr), limit: Duration) -> Option<bool> {
        let mut command = self.command(tests.first()?.binary);
        command.args(["--exact", "--test-threads", "1"]).args(tests.iter().map(|test| &test.name));
        command.stdout(Stdio::null()).stderr(Stdio::null());
        command.env(name, value);
        wait(command.spawn().ok()?, limit)
    }
}

/// A program in a place of its own: where another part is built, Cargo gives its programs the same names.
fn kept(folder: &Path, binary: &Path) -> Result<PathBuf> {
    let copy = folder.join(binary.file_name().unwrap_or_default());
    fs::copy(binary, &copy).map_err(|error| format!("{}: {error}.", copy.display()))?;
    Ok(copy)
}

/// No test takes longer.
const LONGEST: Duration = Duration::from_secs(600);

/// Tests that take no longer together are run in one process.
const BATCH: Duration = Duration::from_millis(400);

/// Whether a program ends well; `None` if it had to be ended.
fn wait(mut child: Child, limit: Duration) -> Option<bool> {
    let start = Instant::now();
    let mut pause = Duration::from_millis(2);
    while start.elapsed() < limit {
        match child.try_wait() {
            Ok(Some(status)) => return Some(status.success()),
            Ok(None) => std::thread::sleep(pause),
            Err(_) => break,
        }
        pause = (pause * 2).min(Duration::from_millis(50));
    }
    let _ = child.kill();
    let _ = child.wait();
    None
}

/// Makes the copy ready for switches.
fn prepare(folder: &Path, mutants: usize) -> Result {
    let path = folder.join("crates/buslens/src/lib.rs");
    let library = fs::read_to_string(&path).map_err(|error| format!("lib.rs cannot be read: {error}."))?;
    let (head, body) = library
        .split_once("#![forbid(unsafe_code)]")
        .ok_or("The library does not forbid unsafe code any more.")?;
    let features = "#![feature(core_intrinsics, const_eval_select)]\n#![allow(warnings, arithmetic_overflow, unconditional_panic)]";
    let asked = ASKED.replace("COUNT", &mutants.max(1).to_string());
    fs::write(&path, format!("{head}{features}{body}{asked}")).map_err(|error| format!("lib.rs: {error}."))
}

/// A line of what Cargo says.
#[derive(Deserialize)]
struct Said {
    reason: String,
    executable: Option<PathBuf>,
    message: Option<Diagnostic>,
}

#[derive(Deserialize)]
struct Diagnostic {
    level: String,
    message: String,
    spans: Vec<Shown>,
}

#[derive(Deserialize)]
struct Shown {
    file_name: String,
    byte_start: usize,
    is_primary: bool,
}

/// What does not compile, by file and byte.
struct Error {
    message: String,
    places: Vec<(String, usize)>,
    beside: Vec<(String, usize)>,
}

/// Compiles the copy: its programs, or what is wrong.
fn compile(folder: &Path, arguments: &[&str]) -> Result<(Vec<PathBuf>, Vec<Error>)> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .current_dir(folder)
        .args(arguments)
        .args(["--package", "buslens", "--profile", "mutants", "--message-format", "json"])
        .env("CARGO_TARGET_DIR", folder.with_file_name("target"))
        // For what only a compiler that is no release may do: to ask at run time in a `const fn`.
        .env("RUSTC_BOOTSTRAP", "1")
        .stderr(Stdio::piped())
        .output()
        .map_err(|error| format!("Cargo did not start: {error}."))?;
    let said = String::from_utf8_lossy(&output.stdout);
    let (mut binaries, mut errors, mut elsewhere) = (Vec::new(), Vec::new(), String::new());
    for said in said.lines().filter_map(|line| serde_json::from_str::<Said>(line).ok()) {
        binaries.extend(said.executable);
        let Some(message) =
            said.message.filter(|it| said.reason == "compiler-message" && it.level == "error")
        else {
            continue;
        };
        let (places, beside): (Vec<Shown>, Vec<Shown>) =
            message.spans.into_iter().partition(|it| it.is_primary);
        let at =
            |spans: Vec<Shown>| spans.into_iter().map(|span| (span.file_name, span.byte_start)).collect();
        match places.is_empty() {
            true => elsewhere += &message.message,
            false => errors.push(Error { message: message.message, places: at(places), beside: at(beside) }),
        }
    }
    if !output.status.success() && errors.is_empty() {
        return Err(format!("{}{elsewhere}", String::from_utf8_lossy(&output.stderr)));
    }
    Ok((binaries, errors))
}
