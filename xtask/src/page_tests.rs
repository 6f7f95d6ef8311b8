//! The last check: the page as it would be published, in a real browser.
//!
//! The driver starts browsers, and a browser is many processes. None of them may stay behind,
//! however this tool ends, even killed. So the driver is started by a second process of this tool
//! that holds on to its standard input: once that closes, for whatever reason, it shuts the driver
//! and with it all browsers down.

use std::io::{self, BufRead, BufReader, Read, Write};
use std::net::{Ipv4Addr, TcpStream};
use std::path::Path;
use std::process::{Child, Command, ExitCode, Stdio};
use std::time::{Duration, Instant};

use crate::steps::{self, Result};
use crate::{build, server, tools};

/// The word by which this tool starts its second process.
pub const KEEP_DRIVER: &str = "keep-driver";

/// How long a driver may take to come up, and to shut its browsers down.
const PATIENCE: Duration = Duration::from_secs(20);

/// What asks for the tests that take minutes.
const LONG: &str = "--long";

/// Runs the page's tests, or those with one of `names` in their names; with `--long` those that take minutes.
pub fn run(names: &[&str]) -> Result {
    let chosen: &[&str] = if names.contains(&LONG) { &["--ignored"] } else { &[] };
    let browser = tools::browser()?;
    let axe = tools::axe()?;
    let screenshots = tools::target_folder().join("page-tests").join("screenshots");
    let screenshots = std::path::absolute(&screenshots)
        .and_then(|path| std::fs::create_dir_all(&path).map(|()| path))
        .map_err(|error| format!("{} cannot be made: {error}.", screenshots.display()))?;

    let dist = std::path::absolute(build::DIST).map_err(|error| format!("{}: {error}.", build::DIST))?;

    // Compiled first, so that no browser waits for the compiler.
    steps::run(tools::cargo().args(["test", "--package", "page-tests", "--no-run"]))?;

    let listener = server::listen(0)?;
    let page = server::address(server::port(&listener)?);
    server::start(listener, Path::new(build::DIST))?;
    let driver = Driver::start(&browser.driver)?;

    steps::run(
        tools::cargo()
            // What tests measure is printed, too.
            .args(["test", "--package", "page-tests", "--no-fail-fast"])
            .args(names.iter().filter(|name| **name != LONG))
            .args(["--", "--show-output"])
            .args(chosen)
            .env("BUSLENS_URL", page)
            .env("BUSLENS_DIST", &dist)
            .env("WEBDRIVER_URL", format!("http://127.0.0.1:{}", driver.port))
            .env("BUSLENS_CHROMIUM", &browser.chromium)
            .env("BUSLENS_AXE", axe)
            .env("BUSLENS_SCREENSHOTS", &screenshots),
    )
    .map_err(|error| format!("{error} Pictures, if any, are in {}.", screenshots.display()))
}

/// A running driver; dropping it ends it, with all its browsers.
struct Driver {
    keeper: Child,
    port: u16,
}

impl Driver {
    fn start(driver: &Path) -> Result<Driver> {
        let says = |error| format!("{} did not start: {error}.", driver.display());
        let mut keeper = Command::new(std::env::current_exe().map_err(says)?)
            .arg(KEEP_DRIVER)
            .arg(driver)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(says)?;
        let mut line = String::new();
        let printed = keeper.stdout.take();
        let read = printed.map(|stdout| BufReader::new(stdout).read_line(&mut line));
        // From here on the keeper is waited for, whatever the line says.
        let mut driver_process = Driver { keeper, port: 0 };
        match (read, line.trim().parse()) {
            (Some(Ok(_)), Ok(port)) => {
                driver_process.port = port;
                Ok(driver_process)
            }
            _ => Err(format!(
                "{} did not come up. Does `chromedriver --port=0` start one by hand?",
                driver.display()
            )),
        }
    }
}

impl Drop for Driver {
    fn drop(&mut self) {
        drop(self.keeper.stdin.take());
        let _ = self.keeper.wait();
    }
}

/// The second process: starts the driver on a free port, prints the port, and ends the driver when
/// its own standard input closes.
pub fn keep_driver(driver: &str) -> ExitCode {
    // The driver gets a pipe for its words: a program may not write to one that closed.
    let started = Command::new(driver)
        .arg("--port=0")
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn();
    let mut driver = match started {
        Ok(driver) => driver,
        Err(error) => {
            eprintln!("{driver} did not start: {error}.");
            return ExitCode::FAILURE;
        }
    };

    let mut lines = driver.stdout.take().map(|stdout| BufReader::new(stdout).lines());
    let port = lines.as_mut().and_then(|lines| lines.map_while(io::Result::ok).find_map(|line| port(&line)));
    // The driver may go on talking.
    std::thread::spawn(move || lines.into_iter().flatten().for_each(drop));

    if let Some(port) = port {
        println!("{port}");
        let _ = io::stdin().read_to_end(&mut Vec::new());
        let _ = shut_down(port);
        let end = Instant::now() + PATIENCE;
        while Instant::now() < end && matches!(driver.try_wait(), Ok(None)) {
            std::thread::sleep(Duration::from_millis(20));
        }
    }
    let _ = driver.kill();
    let _ = driver.wait();
    ExitCode::SUCCESS
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
