//! The last check: the page as it would be published, in real browsers.
//!
//! A driver starts browsers, and a browser is many processes. None of them may stay behind, however the tests
//! end, even killed. So each driver is started by another process of this tool that holds on to its standard
//! input: once that closes, for whatever reason, it ends the driver and with it all browsers. Each page of a
//! test has a driver of its own: those of Firefox and WebKit know one browser only.

use std::io::{self, BufRead, BufReader, Read, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::path::Path;
use std::process::{Child, Command, ExitCode, Stdio};
use std::time::{Duration, Instant};

use crate::steps::{self, Result};
use crate::tools::Engine;
use crate::{build, server, tools};

/// The word by which this tool starts a process that keeps another one.
pub const KEEP: &str = "keep";

/// How long a program may take to come up, and a driver to shut its browsers down.
const PATIENCE: Duration = Duration::from_secs(20);

/// What asks for the tests that take minutes.
const LONG: &str = "--long";

/// What asks for other browsers than Chromium: their names with commas between them, or `all`.
pub const BROWSERS: &str = "--browsers";

/// The name of the tests that measure how long the page takes.
const TIMED: &str = "speed::";

/// Runs the page's tests, or those with one of these names in their names; with `--long` those that take
/// minutes, with `--browsers` in these.
pub fn run(words: &[&str]) -> Result {
    let (mut names, mut engines, mut chosen) = (Vec::new(), vec![Engine::Chromium], &[][..]);
    let mut words = words.iter();
    while let Some(word) = words.next() {
        match *word {
            LONG => chosen = &["--ignored"],
            BROWSERS => engines = self::engines(words.next().unwrap_or(&""))?,
            name => names.push(name),
        }
    }
    let axe = tools::axe()?;
    let screenshots = tools::target_folder().join("page-tests").join("screenshots");
    let screenshots = std::path::absolute(&screenshots)
        .map_err(|error| format!("{} cannot be made: {error}.", screenshots.display()))?;
    let dist = std::path::absolute(build::DIST).map_err(|error| format!("{}: {error}.", build::DIST))?;
    let keeper = std::env::current_exe().map_err(|error| format!("this tool is not found: {error}."))?;

    // Compiled first, so that no browser waits for the compiler.
    steps::run(tools::cargo().args(["test", "--package", "page-tests", "--no-run"]))?;

    let listener = server::listen(0)?;
    let page = server::address(server::port(&listener)?);
    server::start(listener, Path::new(build::DIST))?;

    // Those that measure how long the page takes have the machine for themselves.
    let timed = [TIMED, "--test-threads=1"];
    let others = ["--skip", TIMED];
    let parts = match names[..] {
        [] => vec![&timed[..], &others],
        _ if names.iter().all(|name| name.starts_with(TIMED)) => vec![&timed[1..]],
        _ => vec![&[][..]],
    };
    for engine in engines {
        let browser = tools::browser(engine)?;
        let screenshots = match engine {
            Engine::Chromium => screenshots.clone(),
            _ => screenshots.join(engine.key()),
        };
        std::fs::create_dir_all(&screenshots)
            .map_err(|error| format!("{} cannot be made: {error}.", screenshots.display()))?;
        println!("The page in {}: {}", engine.label(), browser.program.display());
        // WebKit's has no way to do without a screen.
        let screen = browser.screen.as_deref().map(Kept::start).transpose()?;
        for &part in &parts {
            let mut tests = tools::cargo();
            tests
                // What tests measure is printed, too.
                .args(["test", "--package", "page-tests", "--no-fail-fast"])
                .args(["--", "--show-output"])
                // Cargo itself takes one name only.
                .args(&names)
                .args(part)
                .args(chosen)
                .env("BUSLENS_URL", &page)
                .env("BUSLENS_DIST", &dist)
                .env("BUSLENS_ENGINE", engine.key())
                .env("BUSLENS_BROWSER", &browser.program)
                .env("BUSLENS_DRIVER", &browser.driver)
                .env("BUSLENS_KEEPER", &keeper)
                .env("BUSLENS_AXE", &axe)
                .env("BUSLENS_SCREENSHOTS", &screenshots);
            if let Some(screen) = &screen {
                tests.env("DISPLAY", format!(":{}", screen.number));
            }
            steps::run(&mut tests)
                .map_err(|error| format!("{error} Pictures, if any, are in {}.", screenshots.display()))?;
        }
    }
    Ok(())
}

fn engines(words: &str) -> Result<Vec<Engine>> {
    if words == "all" {
        return Ok(Engine::ALL.to_vec());
    }
    let find = |word: &str| {
        let found = Engine::ALL.into_iter().find(|engine| engine.key() == word);
        found.ok_or_else(|| format!("`{word}` is no browser: chromium, firefox, webkit, or all."))
    };
    words.split(',').map(find).collect()
}

/// A program that ends with this tool; dropping it ends it.
struct Kept {
    keeper: Child,
    /// What it is found by.
    number: u16,
}

impl Kept {
    fn start(program: &Path) -> Result<Self> {
        let says = |error| format!("{} did not start: {error}.", program.display());
        let mut command = Command::new(std::env::current_exe().map_err(says)?);
        command.arg(KEEP).arg(program).stdin(Stdio::piped()).stdout(Stdio::piped());
        // Ctrl+C ends the tests, and by that the keeper ends what it keeps: it must not end before.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let mut keeper = command.spawn().map_err(says)?;
        let mut line = String::new();
        let printed = keeper.stdout.take();
        let read = printed.map(|stdout| BufReader::new(stdout).read_line(&mut line));
        // From here on the keeper is waited for, whatever the line says.
        let mut kept = Self { keeper, number: 0 };
        match (read, line.trim().parse()) {
            (Some(Ok(_)), Ok(number)) => {
                kept.number = number;
                Ok(kept)
            }
            _ => Err(format!("{} did not come up: start it by hand to see why.", program.display())),
        }
    }
}

impl Drop for Kept {
    fn drop(&mut self) {
        drop(self.keeper.stdin.take());
        let _ = self.keeper.wait();
    }
}

/// How a program is started so that it can be found.
struct Start {
    arguments: Vec<String>,
    /// What it is found by, in a line that it prints.
    says: fn(&str) -> Option<u16>,
    /// The port that it takes without a word.
    port: Option<u16>,
    /// Whether it can be asked to end.
    listens: bool,
}

impl Start {
    fn of(program: &str) -> io::Result<Self> {
        let name = Path::new(program).file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let start = |arguments: &[&str], says| Self {
            arguments: arguments.iter().map(|&it| it.to_owned()).collect(),
            says,
            port: None,
            listens: false,
        };
        Ok(match name.as_str() {
            "geckodriver" => start(&["--port=0", "--websocket-port=0", "--allow-system-access"], |line| {
                line.rsplit_once("Listening on 127.0.0.1:")?.1.trim().parse().ok()
            }),
            "WebKitWebDriver" => {
                let port = TcpListener::bind((Ipv4Addr::LOCALHOST, 0))?.local_addr()?.port();
                let arguments = [format!("--port={port}")];
                Self { port: Some(port), ..start(&arguments.each_ref().map(String::as_str), |_| None) }
            }
            "Xvfb" => {
                start(&["-displayfd", "1", "-screen", "0", "1920x1200x24", "-nolisten", "tcp"], |line| {
                    line.trim().parse().ok()
                })
            }
            _ => Self { listens: true, ..start(&["--port=0"], port) },
        })
    }
}

/// The keeping process: starts a program, prints by what number it is found, and ends it when its own standard
/// input closes.
pub fn keep(program: &str) -> ExitCode {
    // Two that start at once may choose the same port, and one of them ends: it chooses again.
    for _ in 0..5 {
        match Running::start(program) {
            Ok(Some(running)) => {
                println!("{}", running.number);
                let _ = io::stdin().read_to_end(&mut Vec::new());
                return ExitCode::SUCCESS;
            }
            Ok(None) => {}
            Err(error) => {
                eprintln!("{program} did not start: {error}.");
                return ExitCode::FAILURE;
            }
        }
    }
    eprintln!("{program} starts, and ends before it can be found.");
    ExitCode::FAILURE
}

/// A program that has started; dropping it ends it and all that it started.
struct Running {
    program: Child,
    number: u16,
    /// Whether it can be asked to end.
    listens: bool,
}

impl Running {
    /// Starts it; nothing, if it does not say by what number it is found.
    fn start(program: &str) -> io::Result<Option<Self>> {
        let start = Start::of(program)?;
        // The program gets a pipe for its words: it may not write to one that closed.
        let mut command = Command::new(program);
        command.args(&start.arguments).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::null());
        // What it starts is of its group, and ends with it.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let mut running = Self { program: command.spawn()?, number: 0, listens: false };
        let mut lines = running.program.stdout.take().map(|stdout| BufReader::new(stdout).lines());
        let number = match start.port {
            Some(port) => comes_up(port).then_some(port),
            None => lines
                .as_mut()
                .and_then(|lines| lines.map_while(io::Result::ok).find_map(|line| (start.says)(&line))),
        };
        // It may go on talking.
        std::thread::spawn(move || lines.into_iter().flatten().for_each(drop));
        Ok(number.map(|number| {
            (running.number, running.listens) = (number, start.listens);
            running
        }))
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        if self.listens {
            let _ = shut_down(self.number);
            let end = Instant::now() + PATIENCE;
            while Instant::now() < end && matches!(self.program.try_wait(), Ok(None)) {
                std::thread::sleep(Duration::from_millis(20));
            }
        }
        #[cfg(unix)]
        drop(
            Command::new("kill")
                .args(["-KILL", "--", &format!("-{}", self.program.id())])
                .stderr(Stdio::null())
                .status(),
        );
        let _ = self.program.kill();
        let _ = self.program.wait();
    }
}

/// Whether somebody takes connections at the port before long.
fn comes_up(port: u16) -> bool {
    let end = Instant::now() + PATIENCE;
    while Instant::now() < end {
        if TcpStream::connect((Ipv4Addr::LOCALHOST, port)).is_ok() {
            return true;
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    false
}

/// The port in `ChromeDriver was started successfully on port 40321.`
fn port(line: &str) -> Option<u16> {
    line.split_once("successfully on port ")?.1.trim_end_matches('.').parse().ok()
}

/// Asks the driver to end its browsers and itself. Killing it would leave the browsers.
fn shut_down(port: u16) -> io::Result<()> {
    let mut stream = TcpStream::connect((Ipv4Addr::LOCALHOST, port))?;
    stream.set_read_timeout(Some(PATIENCE))?;
    write!(stream, "GET /shutdown HTTP/1.1\r\nHost: localhost:{port}\r\nConnection: close\r\n\r\n")?;
    stream.read_to_end(&mut Vec::new())?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_port_is_read_from_what_the_driver_says() {
        assert_eq!(port("ChromeDriver was started successfully on port 40321."), Some(40321));
        assert_eq!(port("Starting ChromeDriver 150.0.1 on port 0"), None);
    }
}
