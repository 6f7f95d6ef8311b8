//! A browser with the page in it, as the tests in `tests/` use it.
//!
//! `cargo xtask test` builds the page, serves it, and runs the tests with what
//! they need in the environment: `BUSLENS_URL`, `BUSLENS_DIST`, `BUSLENS_ENGINE`, `BUSLENS_BROWSER`,
//! `BUSLENS_DRIVER`, `BUSLENS_KEEPER`, `BUSLENS_AXE` and `BUSLENS_SCREENSHOTS`.

mod aloud;
mod browser;
mod fields;
mod site;

use std::path::PathBuf;
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use thirtyfour::error::WebDriverErrorInner;
use thirtyfour::prelude::*;

use browser::Driver;
pub use browser::{Engine, chromium_only};
pub use site::{Files, Site, changed, dist, next_version, version};

/// What a step of a test gives; the error says what went wrong.
pub type Result<T = ()> = WebDriverResult<T>;

/// The sizes that the page is looked at in.
pub const DESKTOP: (u32, u32) = (1440, 900);
pub const PHONE: (u32, u32) = (390, 844);
/// The narrowest page that must do without scrolling sideways (WCAG 2.2, 1.4.10).
pub const NARROW: (u32, u32) = (320, 640);

/// Every view of the page.
pub const VIEWS: [&str; 6] = ["#/read", "#/build", "#/check", "#/devices", "#/learn", "#/sheet"];

/// Is there once the part of the page is that stands around what is read.
const THERE: &str = ".foot";

/// How long what must come may take: much longer than on any machine that is not overloaded.
const PATIENCE: Duration = Duration::from_secs(20);

/// A page of its own in a browser of its own.
pub struct Page {
    pub driver: WebDriver,
    /// Ends with it.
    _running: Driver,
    /// What its browser keeps, and by which it is known among others.
    profile: tempfile::TempDir,
    /// Where files go that it saves.
    downloads: tempfile::TempDir,
}

impl Page {
    /// Opens the page.
    pub async fn open(size: (u32, u32), dark: bool) -> Result<Self> {
        Self::open_at("", size, dark).await
    }

    /// Opens a view of the page, or a link.
    pub async fn open_at(fragment: &str, size: (u32, u32), dark: bool) -> Result<Self> {
        Self::open_address(&format!("{}{fragment}", setting("BUSLENS_URL")), size, dark).await
    }

    /// Opens the page where it is by another address.
    pub async fn open_address(address: &str, size: (u32, u32), dark: bool) -> Result<Self> {
        let page = Self::empty(size, dark).await?;
        page.driver.goto(address).await?;
        page.one(THERE).await?;
        Ok(page)
    }

    /// A browser without the page.
    pub async fn empty(size: (u32, u32), dark: bool) -> Result<Self> {
        let (profile, downloads) = (tempfile::tempdir()?, tempfile::tempdir()?);
        let running = Driver::start(dark);
        let wanted = browser::capabilities(profile.path(), downloads.path(), dark)?;
        let driver = WebDriver::new(running.address(), wanted).await?;
        browser::show_as(&driver, size, dark).await?;
        Ok(Self { driver, _running: running, profile, downloads })
    }

    /// Loads the page anew, with another view or a link.
    pub async fn go(&self, fragment: &str) -> Result {
        // A link that differs behind its `#` only would load nothing.
        self.driver.goto("about:blank").await?;
        self.driver.goto(format!("{}{fragment}", setting("BUSLENS_URL"))).await?;
        self.one(THERE).await?;
        self.settle().await
    }

    /// Goes to another view, as a click on its name does.
    pub async fn view(&self, name: &str) -> Result {
        self.click(&format!(".views a[href='#/{name}']")).await?;
        self.settle().await
    }

    /// What stands behind the `#` of the address, once it has followed what is shown.
    pub async fn fragment(&self) -> Result<String> {
        tokio::time::sleep(Duration::from_millis(800)).await;
        let fragment = self.value("return location.hash").await?;
        Ok(fragment.as_str().unwrap_or_default().to_owned())
    }

    /// Waits until `css` finds an element with `text` in it.
    pub async fn until(&self, css: &str, text: &str) -> Result {
        let start = Instant::now();
        while start.elapsed() < PATIENCE {
            if self.texts(css).await.unwrap_or_default().iter().any(|found| found.contains(text)) {
                return Ok(());
            }
            tokio::time::sleep(Duration::from_millis(25)).await;
        }
        panic!("no {css} says {text:?}: {:?}", self.texts(css).await?);
    }

    /// The input of Read.
    pub async fn input(&self) -> Result<String> {
        let value = self.value("return document.querySelector('.editor textarea').value").await?;
        Ok(value.as_str().unwrap_or_default().to_owned())
    }

    /// The bytes of the telegram that is shown.
    pub async fn shown(&self) -> Result<String> {
        self.settle().await?;
        let cells = "return [...document.querySelectorAll('.byte-strip button')].map((cell) => \
                     cell.textContent.slice(0, 2)).join(' ')";
        Ok(self.value(cells).await?.as_str().unwrap_or_default().to_owned())
    }

    /// Closes the browser, whose console must have stayed empty.
    pub async fn close(self) -> Result {
        assert_eq!(self.console().await?, [""; 0], "the console");
        self.driver.quit().await
    }

    /// The element that `css` finds, waited for.
    pub async fn one(&self, css: &str) -> Result<WebElement> {
        self.driver.query(By::Css(css)).wait(Duration::from_secs(10), Duration::from_millis(20)).first().await
    }

    pub async fn text(&self, css: &str) -> Result<String> {
        self.one(css).await?.text().await
    }

    /// The texts of all elements that `css` finds at this moment.
    pub async fn texts(&self, css: &str) -> Result<Vec<String>> {
        let mut texts = Vec::new();
        for element in self.driver.find_all(By::Css(css)).await? {
            match element.text().await {
                // Drawn anew since it was found: what stands there now is asked for again.
                Err(error) if matches!(error.as_inner(), WebDriverErrorInner::StaleElementReference(_)) => {
                    return Box::pin(self.texts(css)).await;
                }
                text => texts.push(text?),
            }
        }
        Ok(texts)
    }

    pub async fn count(&self, css: &str) -> Result<usize> {
        Ok(self.driver.find_all(By::Css(css)).await?.len())
    }

    pub async fn click(&self, css: &str) -> Result {
        self.one(css).await?.click().await
    }

    /// Presses keys where the focus is.
    pub async fn press(&self, keys: impl Into<TypingData>) -> Result {
        self.driver.active_element().await?.send_keys(keys.into()).await
    }

    /// Pastes `text` where nothing is typed, which puts it in the place of the input.
    pub async fn paste(&self, text: &str) -> Result {
        // Firefox keeps from the page what a script puts into such an event as it is made.
        let script = "document.activeElement?.blur(); const clipboardData = new DataTransfer(); \
                      clipboardData.setData('text', arguments[0]); \
                      const event = new ClipboardEvent('paste', { bubbles: true, cancelable: true }); \
                      Object.defineProperty(event, 'clipboardData', { value: clipboardData }); \
                      document.body.dispatchEvent(event)";
        self.driver.execute(script, vec![json!(text)]).await?;
        self.settle().await
    }

    /// Puts `text` into a field as somebody does who types.
    pub async fn fill(&self, css: &str, text: &str) -> Result {
        let script = "const field = document.querySelector(arguments[0]); field.focus(); field.select(); \
                      document.execCommand(arguments[1] ? 'insertText' : 'delete', false, arguments[1])";
        self.one(css).await?;
        self.driver.execute(script, vec![json!(css), json!(text)]).await?;
        self.settle().await
    }

    /// Chooses in a list, by the value.
    pub async fn pick(&self, css: &str, value: &str) -> Result {
        let script = "const list = document.querySelector(arguments[0]); list.value = arguments[1]; \
                      list.dispatchEvent(new Event('change', { bubbles: true }))";
        self.one(css).await?;
        self.driver.execute(script, vec![json!(css), json!(value)]).await?;
        self.settle().await
    }

    /// Chooses how the input is read: the list with this name.
    pub async fn read_as(&self, label: &str, value: &str) -> Result {
        let script = "const label = [...document.querySelectorAll('.choose')].find((it) => \
                      it.querySelector('span').textContent == arguments[0]); const list = label.querySelector('select'); \
                      list.value = arguments[1]; list.dispatchEvent(new Event('change', { bubbles: true }))";
        self.driver.execute(script, vec![json!(label), json!(value)]).await?;
        self.settle().await
    }

    /// Chooses the telegram at `index` beside the input.
    pub async fn choose(&self, index: usize) -> Result {
        self.click(&format!(".said-lines li:nth-child({}) button", index + 1)).await?;
        self.settle().await
    }

    /// Clicks the first element below `css` whose text is `text`.
    pub async fn click_text(&self, css: &str, text: &str) -> Result {
        let script = "const all = [...document.querySelectorAll(arguments[0])]; \
                      const found = all.find((it) => it.textContent.trim().startsWith(arguments[1])); \
                      if (!found) throw new Error(`no ${arguments[0]} says ${arguments[1]}`); found.click()";
        self.driver.execute(script, vec![json!(css), json!(text)]).await?;
        self.settle().await
    }

    /// Opens a file in Read.
    pub async fn open_file(&self, path: &str) -> Result {
        self.one(".open-file input").await?.send_keys(path).await
    }

    /// Waits for the page to be painted.
    pub async fn settle(&self) -> Result {
        let script = "const done = arguments[0]; requestAnimationFrame(() => setTimeout(done, 0));";
        self.driver.execute_async(script, vec![]).await.map(drop)
    }

    /// What a script gives.
    pub async fn value(&self, script: &str) -> Result<Value> {
        Ok(self.driver.execute(script, vec![]).await?.json().clone())
    }

    /// Waits for what is drawn by a worker.
    pub async fn wait_for(&self, css: &str) -> Result {
        for _ in 0..1200 {
            if self.count(css).await? > 0 {
                return Ok(());
            }
            tokio::time::sleep(Duration::from_millis(25)).await;
        }
        panic!("{css} does not come");
    }

    /// Waits until the field has this text in it.
    pub async fn until_value(&self, css: &str, text: &str) -> Result {
        let start = Instant::now();
        while start.elapsed() < PATIENCE {
            if self.one(css).await?.value().await?.is_some_and(|value| value.contains(text)) {
                return Ok(());
            }
            tokio::time::sleep(Duration::from_millis(25)).await;
        }
        panic!("{css} does not become {text}");
    }

    /// What axe-core finds, in words.
    pub async fn accessibility(&self) -> Result<Vec<String>> {
        let axe = std::fs::read_to_string(setting("BUSLENS_AXE")).expect("axe-core can be read");
        self.driver.execute(&axe, vec![]).await?;
        let script = "const done = arguments[0]; axe.run().then((found) => done(found.violations.map((rule) => \
                      rule.id + ': ' + rule.nodes.map((node) => node.target + ' ' + node.failureSummary).join('; '))));";
        let found = self.driver.execute_async(script, vec![]).await?;
        found.convert()
    }

    /// How much memory the page has with its workers, in MB, where the system tells.
    pub fn memory(&self) -> Option<u64> {
        Some(self.renderers()?.into_iter().filter_map(|it| status(it, "VmRSS:")).sum::<u64>() / 1024)
    }

    /// How many workers it has, where the system tells.
    pub fn workers(&self) -> Option<usize> {
        let threads =
            |process| std::fs::read_dir(format!("/proc/{process}/task")).into_iter().flatten().flatten();
        let names = self.renderers()?.into_iter().flat_map(threads);
        let names = names.filter_map(|thread| std::fs::read_to_string(thread.path().join("comm")).ok());
        Some(names.filter(|name| name.starts_with("DedicatedWorker")).count())
    }

    /// The processes that hold the page and its workers.
    fn renderers(&self) -> Option<Vec<u64>> {
        let all: Vec<u64> = std::fs::read_dir("/proc")
            .ok()?
            .filter_map(|entry| entry.ok()?.file_name().to_str()?.parse().ok())
            .collect();
        let own = format!("--user-data-dir={}", self.profile.path().display());
        let started =
            |process: u64, word: &str| told(process, "cmdline").is_some_and(|line| line.contains(word));
        // The browser, what it started, and what that started.
        let mut family: Vec<u64> =
            all.iter().copied().filter(|it| started(*it, &own) && !started(*it, "--type=")).collect();
        let mut next = 0;
        while let Some(parent) = family.get(next).copied() {
            next += 1;
            family.extend(all.iter().copied().filter(|it| status(*it, "PPid:") == Some(parent)));
        }
        Some(family.into_iter().filter(|it| started(*it, "--type=renderer")).collect())
    }

    /// What came to the browser's console since the last look.
    pub async fn console(&self) -> Result<Vec<String>> {
        browser::console(&self.driver).await
    }

    /// Lets the page and the tests use the clipboard.
    pub async fn allow_clipboard(&self) -> Result {
        if Engine::now() != Engine::Chromium {
            return Ok(());
        }
        let permissions = json!({ "permissions": ["clipboardReadWrite", "clipboardSanitizedWrite"] });
        self.driver.cdp().send_raw("Browser.grantPermissions", permissions).await.map(drop)
    }

    /// Clicks what saves a file, and says where the file is.
    pub async fn saved(&self, css: &str) -> Result<PathBuf> {
        let folder = self.downloads.path();
        if Engine::now() == Engine::Chromium {
            let to = json!({ "behavior": "allow", "downloadPath": folder });
            self.driver.cdp().send_raw("Browser.setDownloadBehavior", to).await?;
        }
        let before: Vec<_> = std::fs::read_dir(folder)?.flatten().map(|entry| entry.path()).collect();
        self.click(css).await?;
        for _ in 0..200 {
            tokio::time::sleep(Duration::from_millis(25)).await;
            let found = std::fs::read_dir(folder)?.flatten().map(|entry| entry.path());
            let found = found.filter(|path| !before.contains(path));
            let whole = |path: &PathBuf| {
                let ends = ["txt", "csv", "jsonl", "html", "pcapng", "log", "xml"];
                // Firefox holds its place with an empty one.
                path.extension().is_some_and(|it| ends.iter().any(|end| it == *end))
                    && path.metadata().is_ok_and(|it| it.len() > 0)
            };
            if let Some(path) = found.into_iter().find(whole) {
                return Ok(path);
            }
        }
        panic!("{css} saves no file");
    }

    pub async fn clipboard(&self) -> Result<String> {
        self.settle().await?;
        let script =
            "navigator.clipboard.readText().then(arguments[0], (error) => arguments[0](String(error)))";
        self.driver.execute_async(script, vec![]).await?.convert()
    }

    /// What is on the clipboard for programs that show HTML.
    pub async fn clipboard_html(&self) -> Result<String> {
        self.settle().await?;
        let script = "navigator.clipboard.read().then(([item]) => item.getType('text/html')).then((it) => it.text())\
                      .then(arguments[0], (error) => arguments[0](String(error)))";
        self.driver.execute_async(script, vec![]).await?.convert()
    }

    /// A picture of the whole page for a person to look at.
    pub async fn picture(&self, name: &str) -> Result {
        let folder = PathBuf::from(setting("BUSLENS_SCREENSHOTS"));
        self.settle().await?;
        self.driver.screenshot(&folder.join(format!("{name}.png"))).await
    }
}

/// What the system tells of a process, where it does.
fn told(process: u64, file: &str) -> Option<String> {
    std::fs::read_to_string(format!("/proc/{process}/{file}")).ok()
}

/// A number in that.
fn status(process: u64, key: &str) -> Option<u64> {
    let text = told(process, "status")?;
    text.lines().find_map(|line| line.strip_prefix(key)?.split_whitespace().next()?.parse().ok())
}

fn setting(name: &str) -> String {
    std::env::var(name)
        .unwrap_or_else(|_| panic!("{name} is not set: the page's tests are run by `cargo xtask test`"))
}
