//! The page without a connection: kept in the browser, renewed from version to version, and as one file.

use std::fmt::Write as _;
use std::path::Path;
use std::time::{Duration, Instant};

use page_tests::{DESKTOP, Files, Page, Result, Site, chromium_only, dist, next_version, version};
use serde_json::json;
use thirtyfour::prelude::*;

const PAIR: &str = "01 03 00 C8 00 03 84 35\n01 03 06 00 80 42 F6 E9 79 5A 93";
const SAID: &str = "Unit 1 answers";

/// The field of Check.
const BYTES: &str = "Bytes to check, in hex";

/// Once the browser keeps the page.
const KEPT: &str = "html[data-kept]";

/// A log that is large enough for the worker, with this many exchanges.
const EXCHANGES: usize = 1000;

fn log(folder: &Path) -> String {
    let mut text = String::new();
    for second in 0..EXCHANGES {
        let clock = format!("10:{:02}:{:02}", second / 60, second % 60);
        writeln!(text, "{clock}.000 Tx: 01 03 00 C8 00 03 84 35").unwrap();
        writeln!(text, "{clock}.020 Rx: 01 03 06 00 80 42 F6 E9 79 5A 93").unwrap();
    }
    assert!(text.len() > 1 << 16, "{} bytes", text.len());
    let path = folder.join("plant.log");
    std::fs::write(&path, text).expect("a file can be written");
    path.display().to_string()
}

/// Opens the log, which the worker reads.
async fn read_log(page: &Page, path: &str) -> Result {
    page.open_file(path).await?;
    page.wait_for(".story h2, main [role=alert]").await?;
    page.until(".filters .end .number", "2,000").await
}

/// Everything the page does, without a look at what it says.
async fn use_all_of_it(page: &Page, log: &str) -> Result {
    for view in ["build", "check", "devices", "read"] {
        page.view(view).await?;
        page.one("main h2, main input, main textarea").await?;
        assert_eq!(page.count(".refused").await?, 0, "{view}");
    }
    read_log(page, log).await
}

/// The files that the document and the page have loaded, by their names.
async fn loaded(page: &Page) -> Result<Vec<String>> {
    let script =
        "return performance.getEntriesByType('resource').map((entry) => entry.name.split('/').pop())";
    page.driver.execute(script, vec![]).await?.convert()
}

/// The caches of all versions.
async fn caches(page: &Page) -> Result<Vec<String>> {
    let script = "caches.keys().then((names) => arguments[0](names))";
    page.driver.execute_async(script, vec![]).await?.convert()
}

/// How many files the browser keeps.
async fn kept_files(page: &Page) -> Result<usize> {
    let script = "const done = arguments[0]; caches.keys().then(async ([name]) => \
                  done(name ? (await (await caches.open(name)).keys()).length : 0))";
    page.driver.execute_async(script, vec![]).await?.convert()
}

/// Waits until the browser keeps these versions for these folders, and no other ones.
async fn only_kept(page: &Page, expected: &[(&str, &str)]) -> Result {
    let expected: Vec<_> =
        expected.iter().map(|(address, version)| format!("buslens {address} {version}")).collect();
    let mut found = Vec::new();
    for _ in 0..400 {
        found = caches(page).await?;
        found.sort();
        if found == expected {
            return Ok(());
        }
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
    panic!("{found:?} are kept, not {expected:?}");
}

/// Reloads until this version is open. Where the network takes its time the one that is kept comes first.
async fn reload_to(page: &Page, version: &str) -> Result {
    for _ in 0..5 {
        page.driver.refresh().await?;
        if page.text(".foot > button").await?.ends_with(version) {
            return Ok(());
        }
    }
    panic!("{version} does not come: {:?}", page.texts(".foot > button").await?);
}

/// The browser looks for a new version, as it does by itself from time to time.
async fn look_for_updates(page: &Page) -> Result {
    let script = "const done = arguments[0]; navigator.serviceWorker.getRegistration() \
                  .then((registration) => registration.update()).then(() => done(), () => done())";
    page.driver.execute_async(script, vec![]).await.map(drop)
}

/// Nothing is said of a new version.
async fn not_offered(page: &Page) -> Result {
    let said = page.texts(".toast, .foot").await?;
    assert!(said.iter().all(|text| !text.contains("new version")), "{said:?}");
    Ok(())
}

fn is_of(files: &Files, names: &[String]) -> bool {
    names.iter().all(|name| files.contains_key(name))
}

#[tokio::test(flavor = "multi_thread")]
async fn without_a_server_the_page_comes_back() -> Result {
    let folder = tempfile::tempdir()?;
    let log = log(folder.path());
    let files = dist();
    let mut site = Site::serve(files.clone());
    let address = site.address("tools/buslens/");
    let page = Page::open_address(&address, DESKTOP, false).await?;
    page.paste(PAIR).await?;
    page.until(".lead h2", SAID).await?;
    page.wait_for(KEPT).await?;
    page.fragment().await?;
    // Nothing is asked for but the page's own files, in its own folder.
    let names: Vec<String> = files.keys().map(|name| format!("/tools/buslens/{name}")).collect();
    for path in site.asked() {
        assert!(path == "/tools/buslens/" || names.contains(&path), "{path}");
    }

    // What somebody clears away is there again at the next visit.
    let whole = kept_files(&page).await?;
    page.driver
        .execute_async("caches.keys().then(([name]) => caches.delete(name)).then(arguments[0])", vec![])
        .await?;
    page.driver.refresh().await?;
    page.wait_for(KEPT).await?;
    for _ in 0..200 {
        tokio::time::sleep(Duration::from_millis(50)).await;
        if kept_files(&page).await? == whole {
            break;
        }
    }
    assert!(whole > 8 && kept_files(&page).await? == whole, "{whole} files");

    site.stop();
    page.driver.refresh().await?;
    page.until(".lead h2", SAID).await?;
    page.until_value(".editor textarea", PAIR).await?;
    assert_eq!(page.text(".foot > button").await?, format!("Buslens {}", version(&files)));
    use_all_of_it(&page, &log).await?;
    // By its other name, and by a link.
    page.driver.goto("about:blank").await?;
    page.driver.goto(format!("{address}index.html#/read?text=01+03+00+C8+00+03+84+35")).await?;
    page.until(".lead h2", "unit 1").await?;

    // A connection that takes everything and says nothing is waited for, but not long.
    site.start();
    site.hang();
    let start = Instant::now();
    page.driver.refresh().await?;
    page.until(".lead h2", "unit 1").await?;
    println!("behind a silent connection, the page is there after {:.1} s", start.elapsed().as_secs_f64());
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_reload_brings_the_new_version() -> Result {
    let folder = tempfile::tempdir()?;
    let log = log(folder.path());
    let old = dist();
    let new = next_version(&old);
    let mut site = Site::serve(old.clone());
    let page = Page::open_address(&site.address(""), DESKTOP, false).await?;
    page.wait_for(KEPT).await?;
    assert!(is_of(&old, &loaded(&page).await?), "{:?}", loaded(&page).await?);
    page.paste(PAIR).await?;
    page.fragment().await?;

    site.put(new.clone());
    reload_to(&page, &version(&new)).await?;
    page.until_value(".editor textarea", PAIR).await?;
    use_all_of_it(&page, &log).await?;
    let names = loaded(&page).await?;
    assert!(names.len() > 3 && is_of(&new, &names), "{names:?}");
    // It is kept in the place of the old one, and nothing is said of it.
    only_kept(&page, &[(&site.address(""), &version(&new))]).await?;
    not_offered(&page).await?;
    site.stop();
    page.driver.refresh().await?;
    page.until(".foot > button", &version(&new)).await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_new_version_is_offered_once() -> Result {
    let folder = tempfile::tempdir()?;
    let log = log(folder.path());
    let old = dist();
    let new = next_version(&old);
    let site = Site::serve(old.clone());
    let page = Page::open_address(&site.address(""), DESKTOP, false).await?;
    page.wait_for(KEPT).await?;
    page.paste(PAIR).await?;
    page.click(".editor textarea").await?;

    site.put(new.clone());
    look_for_updates(&page).await?;
    page.until(".toast", "A new version of Buslens is here.").await?;
    page.click("[aria-label='Close this message']").await?;
    look_for_updates(&page).await?;
    tokio::time::sleep(Duration::from_millis(500)).await;
    assert_eq!(page.count(".toast").await?, 0, "it is said once");
    page.until(".foot", "A new version is here.").await?;
    assert_eq!(page.accessibility().await?, [""; 0]);
    // Who does not take it goes on with the version that is open: its files are not on the server any more.
    page.view("check").await?;
    page.fill_in(BYTES, "02 03 00 C8 00 05").await?;
    page.view("read").await?;
    read_log(&page, &log).await?;
    assert!(is_of(&old, &loaded(&page).await?), "{:?}", loaded(&page).await?);
    page.paste(PAIR).await?;
    page.fill(".editor textarea", &format!("{PAIR}\n01 03")).await?;
    // Another tab has something else in Check, and what is kept for all tabs is what was typed last.
    page.driver.execute("localStorage.setItem('buslens.check', 'text=FF')", vec![]).await?;
    // At once, before the address has followed.
    page.click(".foot span button").await?;
    page.until(".foot > button", &version(&new)).await?;
    page.until_value(".editor textarea", &format!("{PAIR}\n01 03")).await?;
    page.view("check").await?;
    assert_eq!(page.holds(BYTES).await?, "02 03 00 C8 00 05");
    use_all_of_it(&page, &log).await?;
    assert!(is_of(&new, &loaded(&page).await?), "{:?}", loaded(&page).await?);
    only_kept(&page, &[(&site.address(""), &version(&new))]).await?;
    not_offered(&page).await?;
    page.close().await
}

/// A server that has files of two versions, since somebody is putting a new one there.
#[tokio::test(flavor = "multi_thread")]
async fn half_a_new_version_is_not_taken() -> Result {
    let old = dist();
    let new = next_version(&old);
    let mut site = Site::serve(old.clone());
    let page = Page::open_address(&site.address(""), DESKTOP, false).await?;
    page.wait_for(KEPT).await?;
    // The worker and most files are new, the document is not.
    let mut both = old.clone();
    both.extend(new.clone());
    both.insert("index.html".to_owned(), old["index.html"].clone());
    site.put(both);
    look_for_updates(&page).await?;
    page.driver.refresh().await?;
    page.until(".foot > button", &version(&old)).await?;
    page.wait_for(KEPT).await?;
    only_kept(&page, &[(&site.address(""), &version(&old))]).await?;
    not_offered(&page).await?;
    site.stop();
    page.driver.refresh().await?;
    page.until(".foot > button", &version(&old)).await?;
    assert!(is_of(&old, &loaded(&page).await?), "{:?}", loaded(&page).await?);
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn copies_on_one_server_leave_each_other_alone() -> Result {
    let old = dist();
    let new = next_version(&old);
    let mut site = Site::serve(old.clone());
    let (first, second) = (site.address(""), site.address("second/"));
    let page = Page::open_address(&first, DESKTOP, false).await?;
    page.wait_for(KEPT).await?;
    page.driver.goto(&second).await?;
    page.wait_for(KEPT).await?;
    site.put(new.clone());
    reload_to(&page, &version(&new)).await?;
    only_kept(&page, &[(&first, &version(&old)), (&second, &version(&new))]).await?;
    site.stop();
    page.driver.goto(&first).await?;
    page.until(".foot > button", &version(&old)).await?;
    page.driver.goto(&second).await?;
    page.until(".foot > button", &version(&new)).await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn who_hosts_the_page_can_take_it_back() -> Result {
    let mut files = dist();
    let site = Site::serve(files.clone());
    let page = Page::open_address(&site.address(""), DESKTOP, false).await?;
    page.wait_for(KEPT).await?;
    let farewell = include_bytes!("../../../bundle/src/offline/farewell.js").to_vec();
    files.insert("service-worker.js".to_owned(), farewell);
    site.put(files);
    look_for_updates(&page).await?;
    let registered = "navigator.serviceWorker.getRegistrations().then((all) => arguments[0](all.length))";
    for _ in 0..200 {
        let count = page.driver.execute_async(registered, vec![]).await?;
        if count.json() == &json!(0) && caches(&page).await?.is_empty() {
            return page.close().await;
        }
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
    panic!("{:?} are still kept", caches(&page).await?);
}

/// Browsers have none over plain http, and refuse it in some private windows.
#[tokio::test(flavor = "multi_thread")]
async fn where_nothing_can_be_kept_the_page_is_silent_and_works() -> Result {
    if chromium_only("its script has to run before the page") {
        return Ok(());
    }
    let folder = tempfile::tempdir()?;
    let log = log(folder.path());
    let refused = "if (globalThis.ServiceWorkerContainer) ServiceWorkerContainer.prototype.register = () => \
                   Promise.reject(new DOMException('not here', 'SecurityError'));";
    let missing =
        "delete Navigator.prototype.serviceWorker; delete Navigator.prototype.locks; delete window.caches;";
    for script in [refused, missing] {
        let page = Page::empty(DESKTOP, false).await?;
        page.before_loading(script).await?;
        page.go("").await?;
        page.paste(PAIR).await?;
        use_all_of_it(&page, &log).await?;
        tokio::time::sleep(Duration::from_secs(4)).await;
        assert_eq!(page.count(KEPT).await?, 0);
        not_offered(&page).await?;
        page.click(".foot > button").await?;
        page.until("dialog", "has not kept the page").await?;
        page.close().await?;
    }
    Ok(())
}

/// What the page is called and how it is installed.
#[tokio::test(flavor = "multi_thread")]
async fn the_page_can_be_installed() -> Result {
    if chromium_only("no other one says what it would install") {
        return Ok(());
    }
    let page = Page::open(DESKTOP, false).await?;
    page.wait_for(KEPT).await?;
    let errors = page.driver.cdp().send_raw("Page.getInstallabilityErrors", json!({})).await?;
    // The tests' browser has a profile that is thrown away.
    let errors: Vec<_> = errors["installabilityErrors"].as_array().cloned().unwrap_or_default();
    let real: Vec<_> = errors.iter().filter(|error| error["errorId"] != "in-incognito").collect();
    assert!(real.is_empty(), "{real:?}");
    let manifest = page.driver.cdp().send_raw("Page.getAppManifest", json!({})).await?;
    assert_eq!(manifest["errors"], json!([]), "{manifest}");
    assert!(
        manifest["data"].as_str().is_some_and(|data| data.contains("\"short_name\": \"Buslens\"")),
        "{manifest}"
    );
    page.close().await
}

/// The installed page is what the system opens files with.
#[tokio::test(flavor = "multi_thread")]
async fn a_file_that_the_system_opens_is_read() -> Result {
    if chromium_only("its script has to run before the page") {
        return Ok(());
    }
    let page = Page::empty(DESKTOP, false).await?;
    page.before_loading(&format!(
        "const handle = {{ getFile: () => Promise.resolve(new File([{PAIR:?}], 'plant.txt')) }}; \
         Object.defineProperty(window, 'launchQueue', {{ value: {{ setConsumer: (take) => take({{ files: [handle] }}) }} }})"
    ))
    .await?;
    page.go("#/check").await?;
    page.until(".lead h2", SAID).await?;
    assert_eq!(page.input().await?, PAIR);
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn the_page_as_one_file_opens_from_a_disk() -> Result {
    if chromium_only("its script has to run before the page") {
        return Ok(());
    }
    let page = Page::open(DESKTOP, false).await?;
    page.click_text(".top .menu > button", "More").await?;
    page.until("[role=menuitem]", "Save the page as one file").await?;
    assert_eq!(page.accessibility().await?, [""; 0]);
    let saved = std::fs::read(page.saved("[role=menuitem]").await?)?;
    page.until(".toast", "The page is saved as one file").await?;
    page.close().await?;
    let files = dist();
    assert!(saved == files["buslens.html"], "it is saved as the server has it");

    // What a browser saved is gone with its driver.
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("buslens.html");
    std::fs::write(&path, saved)?;
    let log = log(folder.path());
    let page = Page::empty(DESKTOP, false).await?;
    page.before_loading(
        "window.violations = []; document.addEventListener('securitypolicyviolation', (event) => \
         violations.push(`${event.effectiveDirective} ${event.blockedURI}`)); \
         window.workers = 0; window.Worker = class extends Worker { constructor(...all) { super(...all); workers++; } }",
    )
    .await?;
    let address = format!("file://{}", path.display());
    page.driver.goto(&address).await?;
    page.one("main > *").await?;
    page.until(".foot", "offline copy").await?;
    assert_eq!(page.text(".foot > button").await?, format!("Buslens {}", version(&files)));
    page.click(".foot > button").await?;
    page.until("dialog", "This is the offline copy").await?;
    assert_eq!(page.count("dialog .button:not(.icon-only)").await?, 0, "it needs not be saved again");
    page.press(Key::Escape + "").await?;
    page.paste(PAIR).await?;
    page.until(".lead h2", SAID).await?;
    let link = page.fragment().await?;
    assert!(link.starts_with("#/read?"), "{link}");
    page.driver.refresh().await?;
    page.until(".lead h2", SAID).await?;
    page.view("build").await?;
    page.fill("main input", "write 123.456 good to channel 6").await?;
    page.until("main", "Write Universal channel 6 = 123.456, good").await?;
    page.click(".finder [role=option]").await?;
    page.until(".side[aria-label=Request] .said", "Universal channel 6 = 123.456").await?;
    assert_eq!(
        page.bytes_in(".side[aria-label=Request]").await?,
        "01 10 00 D7 00 03 06 00 80 42 F6 E9 79 28 15",
        "as section 2.6.1 of the manual prints it"
    );
    use_all_of_it(&page, &log).await?;
    assert_eq!(page.value("return workers").await?, json!(1), "the log is read by the worker");
    assert_eq!(page.value("return violations").await?, json!([]));
    assert_eq!(page.accessibility().await?, [""; 0]);
    assert_eq!(page.console().await?, [""; 0], "the console");

    // The file may ask nobody for anything.
    for address in ["https://example.org/", "data:,x", &address] {
        let forbidden = page
            .driver
            .execute_async(
                "const [address, done] = arguments; fetch(address).then(() => done('fetched'), () => done('refused'))",
                vec![json!(address)],
            )
            .await?;
        assert_eq!(forbidden.json(), &json!("refused"), "{address}");
    }
    assert!(loaded(&page).await?.iter().all(|name| name.starts_with("data:") || name.starts_with("blob:")));
    page.driver.quit().await
}

/// Some browsers keep nothing for files, and refuse even to look.
#[tokio::test(flavor = "multi_thread")]
async fn the_one_file_does_without_a_store() -> Result {
    if chromium_only("its script has to run before the page") {
        return Ok(());
    }
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("buslens.html");
    std::fs::write(&path, &dist()["buslens.html"])?;
    let page = Page::empty(DESKTOP, true).await?;
    page.before_loading(
        "for (const name of ['localStorage', 'sessionStorage', 'indexedDB']) Object.defineProperty(window, name, \
         { get() { throw new DOMException('not here', 'SecurityError'); } })",
    )
    .await?;
    page.driver.goto(format!("file://{}", path.display())).await?;
    page.one("main > *").await?;
    page.paste(PAIR).await?;
    page.until(".lead h2", SAID).await?;
    read_log(&page, &log(folder.path())).await?;
    page.close().await
}
