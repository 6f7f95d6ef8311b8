//! The browsers that the page is tested in: how one is started, and what it does for a test beyond WebDriver.
//!
//! Chromium is asked by its own protocol; Firefox by scripts that run in the browser itself and not in the page;
//! WebKit has nothing of that kind. What one cannot do for a test is left out there, with the reason.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};

use serde_json::{Value, json};
use thirtyfour::common::command::FormatRequestData;
use thirtyfour::prelude::*;
use thirtyfour::{Capabilities, LoggingPrefsLogLevel, RequestData, SessionId};

use crate::{Result, setting};

/// What draws the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Engine {
    Chromium,
    Firefox,
    Webkit,
}

impl Engine {
    /// The one that the tests run in.
    pub fn now() -> Self {
        match setting("BUSLENS_ENGINE").as_str() {
            "firefox" => Self::Firefox,
            "webkit" => Self::Webkit,
            _ => Self::Chromium,
        }
    }

    /// Whether the test cannot be made here; `why` is printed.
    pub fn cannot(self, why: &str) -> bool {
        let here = Self::now() == self;
        if here {
            println!("not tried in {self:?}: {why}");
        }
        here
    }
}

/// Whether the test is for Chromium only; `why` is printed elsewhere.
pub fn chromium_only(why: &str) -> bool {
    [Engine::Firefox, Engine::Webkit].into_iter().any(|engine| engine.cannot(why))
}

/// A running driver; dropping it ends it, with its browser.
pub struct Driver {
    keeper: Child,
    port: u16,
}

impl Driver {
    /// Starts one. Whatever becomes of the test, its keeper ends it.
    pub fn start(dark: bool) -> Self {
        let mut command = Command::new(setting("BUSLENS_KEEPER"));
        command
            .arg("keep")
            .arg(setting("BUSLENS_DRIVER"))
            // Where WebKit looks for the theme.
            .env("GTK_THEME", if dark { "Adwaita:dark" } else { "Adwaita" })
            .stdin(Stdio::piped())
            .stdout(Stdio::piped());
        // Ctrl+C ends the tests, and by that the keeper ends the driver: it must not end before.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let mut keeper = command.spawn().expect("the keeper of the driver starts");
        let mut line = String::new();
        let stdout = keeper.stdout.take().expect("it prints the port");
        BufReader::new(stdout).read_line(&mut line).expect("the port is read");
        Self { keeper, port: line.trim().parse().expect("the driver comes up") }
    }

    pub fn address(&self) -> String {
        format!("http://127.0.0.1:{}", self.port)
    }
}

impl Drop for Driver {
    fn drop(&mut self) {
        drop(self.keeper.stdin.take());
        let _ = self.keeper.wait();
    }
}

/// How the browser is to be started, with a folder for what it keeps and one for what it saves.
pub fn capabilities(profile: &Path, downloads: &Path, dark: bool) -> Result<Capabilities> {
    let program = setting("BUSLENS_BROWSER");
    let mut wanted = Capabilities::new();
    match Engine::now() {
        Engine::Chromium => {
            let mut options = DesiredCapabilities::chrome();
            options.set_binary(&program)?;
            for argument in [
                "--headless",
                "--no-sandbox",
                "--disable-gpu",
                "--no-first-run",
                "--disable-background-networking",
                "--disable-component-update",
                "--disable-sync",
            ] {
                options.add_arg(argument)?;
            }
            options.add_arg(&format!("--user-data-dir={}", profile.display()))?;
            options.set_browser_log_level(LoggingPrefsLogLevel::All)?;
            return Ok(options.into());
        }
        Engine::Firefox => {
            let options = json!({
                "binary": program,
                "args": ["-headless"],
                "prefs": {
                    "layout.css.prefers-color-scheme.content-override": i32::from(!dark),
                    // Without a question.
                    "dom.events.testing.asyncClipboard": true,
                    "browser.download.folderList": 2,
                    "browser.download.dir": downloads,
                    "browser.download.alwaysOpenPanel": false,
                },
            });
            wanted.set("browserName", "firefox")?;
            wanted.set("moz:firefoxOptions", options)?;
        }
        Engine::Webkit => {
            wanted.set("webkitgtk:browserOptions", json!({ "binary": program, "args": ["--automation"] }))?;
        }
    }
    Ok(wanted)
}

/// Makes the page so wide and high, and light or dark where that was not said at the start.
pub async fn show_as(driver: &WebDriver, (width, height): (u32, u32), dark: bool) -> Result {
    match Engine::now() {
        Engine::Chromium => {
            let metrics =
                json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600 });
            driver.cdp().send_raw("Emulation.setDeviceMetricsOverride", metrics).await?;
            let scheme =
                json!({ "name": "prefers-color-scheme", "value": if dark { "dark" } else { "light" } });
            driver.cdp().send_raw("Emulation.setEmulatedMedia", json!({ "features": [scheme] })).await?;
        }
        Engine::Firefox => {
            // Its window has a least width, the page in it has none.
            let script = "const [width, height] = arguments; window.resizeTo(1600, 1200); \
                          const { style } = gBrowser.selectedBrowser; \
                          for (const [name, size] of [['width', width], ['height', height]]) \
                            for (const of of ['', 'min-', 'max-']) style.setProperty(of + name, `${size}px`);";
            in_firefox(driver, script, vec![json!(width), json!(height)]).await?;
        }
        Engine::Webkit => {
            // The window has a frame and a bar, and the page what is left.
            let (mut wide, mut high) = (width, height);
            for _ in 0..5 {
                driver.set_window_rect(0, 0, wide, high).await?;
                tokio::time::sleep(std::time::Duration::from_millis(100)).await;
                let inner = driver.execute("return [innerWidth, innerHeight]", vec![]).await?;
                let [inner_width, inner_height]: [u32; 2] = inner.convert()?;
                if (inner_width, inner_height) == (width, height) {
                    return Ok(());
                }
                wide = (wide + width).saturating_sub(inner_width);
                high = (high + height).saturating_sub(inner_height);
            }
        }
    }
    Ok(())
}

/// What came to the console since the last look, where the browser tells.
pub async fn console(driver: &WebDriver) -> Result<Vec<String>> {
    match Engine::now() {
        Engine::Chromium => {
            let entries = driver.browser_log().await?;
            Ok(entries.into_iter().map(|entry| format!("{}: {}", entry.level, entry.message)).collect())
        }
        Engine::Firefox => {
            let script = "const said = Services.console.getMessageArray().filter((it) => \
                          it instanceof Ci.nsIScriptError && !(it.flags & Ci.nsIScriptError.warningFlag) && \
                          /^(https?|file|blob):/.test(it.sourceName)).map((it) => it.errorMessage); \
                          Services.console.reset(); return said;";
            Ok(serde_json::from_value(in_firefox(driver, script, vec![]).await?)?)
        }
        Engine::Webkit => Ok(Vec::new()),
    }
}

/// Runs a script in the browser itself, where it may do what pages may not.
async fn in_firefox(driver: &WebDriver, script: &str, arguments: Vec<Value>) -> Result<Value> {
    driver.handle().cmd(Context("chrome")).await?;
    let given = driver.execute(script, arguments).await;
    driver.handle().cmd(Context("content")).await?;
    Ok(given?.json().clone())
}

/// Whether scripts run in the page or in Firefox.
#[derive(Debug)]
struct Context(&'static str);

impl FormatRequestData for Context {
    fn format_request(&self, session: &SessionId) -> RequestData {
        RequestData::new(http::Method::POST, format!("/session/{session}/moz/context"))
            .add_body(json!({ "context": self.0 }))
    }
}
