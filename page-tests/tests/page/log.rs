//! Read, with a log: what a customer sent is summed up, listed, looked through and exported; large files are
//! read by a worker, and the page stays quick.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;
use std::time::{Duration, Instant};

use page_tests::{DESKTOP, PHONE, Page, Result, Site, changed, chromium_only, dist};
use serde_json::json;
use thirtyfour::prelude::*;

/// A frame with its CRC.
fn frame(body: &[u8]) -> Vec<u8> {
    let mut crc = 0xFFFF_u16;
    for byte in body {
        crc = (0..8)
            .fold(crc ^ u16::from(*byte), |crc, _| if crc & 1 == 1 { crc >> 1 ^ 0xA001 } else { crc >> 1 });
    }
    [body, &crc.to_le_bytes()].concat()
}

/// A log of `pairs` requests with their answers: unit 9 is silent for a while, one check in 500 fails.
pub fn log(pairs: usize) -> String {
    let mut text = String::new();
    let mut line = |millisecond: usize, word: &str, bytes: &[u8]| {
        let second = 36_000 + millisecond / 1000;
        let clock = format!(
            "{:02}:{:02}:{:02}.{:03}",
            second / 3600 % 24,
            second / 60 % 60,
            second % 60,
            millisecond % 1000
        );
        let hex: Vec<String> = bytes.iter().map(|byte| format!("{byte:02X}")).collect();
        writeln!(text, "{clock} [bus] {word}: {}", hex.join(" ")).unwrap();
    };
    for n in 0..pairs {
        let unit = if n % 3 == 2 { 9 } else { 5 };
        let time = n * 50;
        line(time, "Tx", &frame(&[unit, 3, 0, 200, 0, 3]));
        let silent = unit == 9 && (pairs / 3..pairs / 3 + pairs / 20).contains(&n);
        if !silent {
            let value = ((n as f64 / 40.0).sin() * 100.0 + 200.0) as u16;
            let [high, low] = value.to_be_bytes();
            let mut answer = frame(&[unit, 3, 6, 0, 0x80, high, low, 0, 0]);
            if n % 500 == 499 {
                answer[4] ^= 0x10;
            }
            line(time + 12 + n % 9, "Rx", &answer);
        }
    }
    text
}

/// A file with this content, which a test opens in the page.
pub fn file(folder: &Path, name: &str, content: &[u8]) -> String {
    let path = folder.join(name);
    std::fs::File::create(&path).and_then(|mut file| file.write_all(content)).expect("a file can be written");
    path.display().to_string()
}

/// Opens a file, and waits until it is read or refused.
pub async fn open(page: &Page, path: &str) -> Result<Duration> {
    let start = Instant::now();
    page.open_file(path).await?;
    page.wait_for(".story h2, [role=alert]").await?;
    Ok(start.elapsed())
}

/// Waits until all of a file is read, of which something is shown before.
pub async fn wait_for_all(page: &Page) -> Result {
    while page.count(".reading-on").await? > 0 {
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
    Ok(())
}

/// The telegrams of the list, as far as its foot tells.
pub const COUNT: &str = ".filters .end .number";

#[tokio::test(flavor = "multi_thread")]
async fn a_log_is_read_summed_up_and_looked_through() -> Result {
    let folder = tempfile::tempdir()?;
    for (size, name) in [(DESKTOP, "desktop"), (PHONE, "phone")] {
        for dark in [false, true] {
            let theme = if dark { "dark" } else { "light" };
            let page = Page::open(size, dark).await?;
            open(&page, &file(folder.path(), "bus.log", log(2000).as_bytes())).await?;
            page.wait_for(".rows [aria-selected=true]").await?;
            assert_eq!(page.text(".file-bar strong").await?, "bus.log");
            assert!(page.text(".file-bar .soft").await?.starts_with("3,967 telegrams · Modbus RTU"));
            let story = page.text(".story").await?;
            assert!(
                story.starts_with("All 2 units answer; 33 requests went unanswered; 4 telegrams damaged"),
                "{story}"
            );
            assert!(story.contains("Unit 9: 633 of 666 answered, usually after"), "{story}");
            page.picture(&format!("log-{name}-{theme}")).await?;
            // What is not ok, one by one.
            page.click("[aria-label='Next telegram that is not ok']").await?;
            page.until(".rows [aria-selected=true] .st, .detail", "damaged").await?;
            page.read_as("Show", "unanswered").await?;
            page.until(COUNT, "33 of 3,967").await?;
            page.wait_for(".rows .row").await?;
            page.value("document.querySelector('.rows .row').click()").await?;
            page.until(".detail", "Nobody answered it").await?;
            assert_eq!(page.accessibility().await?, [""; 0], "filtered, {name}, {theme}");
            page.read_as("Show", "").await?;
            page.until(COUNT, "3,967 rows").await?;
            page.close().await?;
        }
    }
    Ok(())
}

#[tokio::test(flavor = "multi_thread")]
async fn a_finding_leads_to_its_telegrams() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    // Unit 9 is asked a hundred times and never answers.
    let text: String =
        log(300).lines().filter(|line| !line.contains("Rx: 09")).map(|line| format!("{line}\n")).collect();
    page.paste(&text).await?;
    page.wait_for(".rows [aria-selected=true]").await?;
    page.click(".findings button").await?;
    page.until(".finding-chip", "Unit 9").await?;
    page.until(".filters .steps .number", "1 of ").await?;
    page.until(".rows [aria-selected=true] .st", "unanswered").await?;
    // The row is in sight.
    let sight = "const row = document.querySelector('.rows [aria-selected=true]').getBoundingClientRect(); \
                 const list = document.querySelector('.list').getBoundingClientRect(); \
                 return row.top >= list.top && row.bottom <= list.bottom";
    assert_eq!(page.value(sight).await?, json!(true));
    let hits = page.count(".rows .hit").await?;
    assert!(hits > 0);
    page.click("[aria-label='Next telegram of the finding']").await?;
    page.until(".filters .steps .number", "2 of ").await?;
    // Only these, and all again.
    page.click_text(".segments label", "Only these").await?;
    page.until(COUNT, "100 of").await?;
    assert_eq!(page.count(".rows .row").await?, page.count(".rows .hit").await?);
    page.click(".finding-chip").await?;
    page.until(COUNT, "rows").await?;
    assert_eq!(page.count(".finding-chip").await?, 0);
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_click_on_a_cell_filters_and_a_drag_zooms() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste(&log(300)).await?;
    page.wait_for(".rows [aria-selected=true]").await?;
    page.click_text(".rows .u button", "9").await?;
    page.until(".filters .chip", "Unit 9").await?;
    let units = page.texts(".rows .u").await?;
    assert!(units.len() > 10 && units.iter().all(|unit| unit == "9"), "{units:?}");
    page.click_text(".rows .st button", "ok").await?;
    page.until(".filters", "ok").await?;
    page.click_text(".filters .chip", "Take off: Unit").await?;
    page.click_text(".filters .chip", "Take off: ok").await?;
    page.until(COUNT, "rows").await?;
    // The search finds bytes, registers, any text.
    page.fill(".search input", "09 03 00 C8").await?;
    page.until(COUNT, " of ").await?;
    page.fill(".search input", "").await?;
    page.until(COUNT, "rows").await?;
    // Dragging over a stretch of time.
    let picture = page.one(".picture").await?;
    let actions = page.driver.action_chain().move_to_element_with_offset(&picture, 0, 4).click_and_hold();
    actions.move_by_offset(120, 0).release().perform().await?;
    page.until(".filters .chip", " to ").await?;
    page.until(COUNT, " of ").await?;
    page.click(".timeline .whole").await?;
    page.until(COUNT, "rows").await?;
    // The same by keyboard.
    page.driver.execute("document.querySelector('.picture').focus()", vec![]).await?;
    page.press(Key::Right + Key::Right + Key::Enter).await?;
    page.until(".filters .chip", " to ").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_log_and_its_notes_come_back() -> Result {
    let folder = tempfile::tempdir()?;
    for pairs in [300, 8000] {
        let page = Page::open(DESKTOP, false).await?;
        open(&page, &file(folder.path(), "plant.log", log(pairs).as_bytes())).await?;
        page.wait_for(".rows [aria-selected=true]").await?;
        page.fill(".own-note input", "noise of the new drive").await?;
        page.until(".rows .noted", "noise of the new drive").await?;
        let said = page.text(".file-bar .soft").await?;
        page.fragment().await?;
        // Another view, and back.
        page.view("build").await?;
        page.driver.back().await?;
        page.until(".file-bar .soft", &said).await?;
        page.until(".rows .noted", "noise of the new drive").await?;
        // "Read by itself", and back.
        page.click_text(".detail .acts a", "Read by itself").await?;
        page.until(".read-as", "1 telegram").await?;
        page.fragment().await?;
        page.driver.back().await?;
        page.until(".file-bar .soft", &said).await?;
        page.until(".rows .noted", "noise of the new drive").await?;
        page.driver.refresh().await?;
        page.until(".file-bar .soft", &said).await?;
        page.until(".rows .noted", "noise of the new drive").await?;
        page.close().await?;
    }
    Ok(())
}

/// Where the browser keeps no files, the page says what was open.
#[tokio::test(flavor = "multi_thread")]
async fn a_file_that_was_not_kept_is_asked_for() -> Result {
    let folder = tempfile::tempdir()?;
    let page = Page::open(DESKTOP, false).await?;
    page.value(
        "window.indexedDB.deleteDatabase; Object.defineProperty(window, 'indexedDB', { value: null })",
    )
    .await?;
    open(&page, &file(folder.path(), "plant.log", log(8000).as_bytes())).await?;
    page.wait_for(".rows [aria-selected=true]").await?;
    page.fragment().await?;
    page.driver.refresh().await?;
    page.until(".missing", "plant.log").await?;
    page.close().await
}

/// What the page says of a large log that so many workers may read, its rows around each place where slices may meet
/// included; and how many read it.
async fn said_by(page: Page, workers: usize, path: &str, text: &str) -> Result<(Vec<String>, usize)> {
    page.value(&format!("Object.defineProperty(navigator, 'hardwareConcurrency', {{ value: {workers} }})"))
        .await?;
    let start = Instant::now();
    open(&page, path).await?;
    let mut most = 0;
    while page.count(".reading-on").await? > 0 {
        most = most.max(page.workers().unwrap_or(workers));
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
    println!("{:.0} MB read in {:?} by {most} at once", text.len() as f64 / 1e6, start.elapsed());
    page.wait_for(".findings button").await?;
    page.wait_for(&format!("[aria-rowcount='{}']", text.lines().count() + 1)).await?;
    let mut said =
        vec![page.text(".story").await?, page.text(".file-bar .soft").await?, page.text(COUNT).await?];
    // Everywhere between two of these a telegram goes on behind the place.
    for megabytes in [1, 16, 43, 44, 45, 46, 47, 48, 49, 50, 51, 77] {
        let row = text.as_bytes()[..megabytes << 20].iter().filter(|byte| **byte == b'\n').count();
        page.value(&format!(
            "const list = document.querySelector('.list'); const high = document.querySelector('.space').offsetHeight; \
             list.scrollTop = {row} / (list.ariaRowCount - 1) * high"
        ))
        .await?;
        page.wait_for(&format!("#row-{row}")).await?;
        said.push(page.text(".rows").await?);
    }
    Ok((said, most))
}

/// Several workers read a log, each a slice of it: the page says what it says when one reads all of it, also when one
/// of them fails.
#[tokio::test(flavor = "multi_thread")]
async fn several_workers_read_one_log() -> Result {
    let folder = tempfile::tempdir()?;
    let text = log(800_000);
    let path = file(folder.path(), "large.log", text.as_bytes());
    let (alone, workers) = said_by(Page::open(DESKTOP, false).await?, 1, &path, &text).await?;
    assert_eq!(workers, 1);
    let (together, workers) = said_by(Page::open(DESKTOP, false).await?, 2, &path, &text).await?;
    assert_eq!((together, workers), (alone.clone(), 2));
    // A worker finds no script for another one.
    let gone = "new Worker(\"document\" in globalThis ? import.meta.url : \"gone.js\"";
    let site = Site::serve(changed(dist(), "boot", "new Worker(import.meta.url", gone));
    let page = Page::open_address(&site.address(""), DESKTOP, false).await?;
    let (without, _) = said_by(page, 2, &path, &text).await?;
    assert_eq!(without, alone);
    assert!(site.asked().iter().any(|path| path.ends_with("gone.js")), "it was tried");
    // Nor does it wait for ever for one that says nothing.
    let mut files = changed(dist(), "boot", "new Worker(import.meta.url", &gone.replace("gone", "silent"));
    files.insert("silent.js".to_owned(), Vec::new());
    let site = Site::serve(files);
    let page = Page::open_address(&site.address(""), DESKTOP, false).await?;
    let (without, _) = said_by(page, 2, &path, &text).await?;
    assert_eq!(without, alone);
    assert!(site.asked().iter().any(|path| path.ends_with("silent.js")), "it was tried");
    Ok(())
}

/// Twenty logs of 20 MB one after another: what the page and its worker had for one is there for the next.
#[tokio::test(flavor = "multi_thread")]
#[ignore = "takes minutes: `cargo xtask test page twenty_large_logs --long`"]
async fn twenty_large_logs_leave_nothing_behind() -> Result {
    if chromium_only("no other one frees memory when it is asked to") {
        return Ok(());
    }
    const WARM: usize = 3;
    let folder = tempfile::tempdir()?;
    let text = log(200_000);
    let page = Page::open(DESKTOP, false).await?;
    let mut used = Vec::new();
    for n in 0..20 {
        let name = format!("plant-{n}.log");
        let path = file(folder.path(), &name, format!("# {n}\n{text}").as_bytes());
        page.open_file(&path).await?;
        page.until(".file-bar strong", &name).await?;
        page.wait_for(".story h2").await?;
        page.wait_for(".rows .row").await?;
        wait_for_all(&page).await?;
        std::fs::remove_file(path)?;
        page.driver.cdp().send_raw("HeapProfiler.collectGarbage", json!({})).await?;
        used.push(page.memory().expect("the system tells what a process has"));
    }
    println!("memory after each log of {:.1} MB, in MB: {used:?}", text.len() as f64 / 1e6);
    // The first ones make the room that all others take.
    let (first, last) = (&used[WARM..WARM + 5], &used[15..]);
    let most = |of: &[u64]| of.iter().copied().max().unwrap_or_default();
    assert!(most(last) * 10 <= most(first) * 11, "it grows: {used:?}");
    page.close().await
}

/// Two tabs with the same log hear each other's notes, and neither loses its own.
#[tokio::test(flavor = "multi_thread")]
async fn notes_of_another_tab_are_heard() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    let text = log(40);
    page.paste(&text).await?;
    page.wait_for(".rows [aria-selected=true]").await?;
    page.fragment().await?;
    let first = page.driver.window().await?;
    let address = page.driver.current_url().await?.to_string();
    let second = page.driver.new_tab().await?;
    page.driver.switch_to_window(second.clone()).await?;
    page.driver.goto(address).await?;
    page.wait_for(".rows [aria-selected=true]").await?;
    page.fill(".own-note input", "from the second tab").await?;
    page.driver.switch_to_window(first).await?;
    page.until(".rows .noted", "from the second tab").await?;
    page.click(".rows .row:nth-child(3)").await?;
    page.fill(".own-note input", "from the first").await?;
    page.driver.switch_to_window(second).await?;
    let kept = page.value("return localStorage.getItem('buslens.notes')").await?;
    let kept = kept.as_str().unwrap_or_default();
    assert!(kept.contains("from the second tab") && kept.contains("from the first"), "{kept}");
    page.close().await
}

/// A worker that does not start, or is ended, is told, and the next file starts another one.
#[tokio::test(flavor = "multi_thread")]
async fn a_worker_that_fails_is_told_and_started_again() -> Result {
    let folder = tempfile::tempdir()?;
    let path = file(folder.path(), "plant.log", log(8000).as_bytes());
    let page = Page::open(DESKTOP, false).await?;
    // Its script is not there.
    page.value(
        "const Own = window.Worker; window.Own = Own; window.Worker = function (address, options) { \
         return new Own(address.replace('boot', 'gone'), options); }",
    )
    .await?;
    open(&page, &path).await?;
    page.until("[role=alert]", "could not be loaded").await?;
    // It breaks while it reads.
    page.value(
        "window.Worker = function (address, options) { const worker = new Own(address, options); \
         window.last = worker; return worker; }",
    )
    .await?;
    page.click_text("[role=alert] button", "Read it again").await?;
    page.wait_for(".rows .row").await?;
    page.value("last.dispatchEvent(new ErrorEvent('error', { message: 'broke' }))").await?;
    page.until("[role=alert]", "has ended").await?;
    page.click_text("[role=alert] button", "Read it again").await?;
    page.until(".file-bar .soft", "telegrams").await?;
    assert_eq!(page.count("[role=alert]").await?, 0);
    // It is ended without a word: the next file starts another one.
    page.value("last.terminate()").await?;
    let other = file(folder.path(), "other.log", log(9000).as_bytes());
    open(&page, &other).await?;
    page.until(".file-bar strong", "other.log").await?;
    page.wait_for(".rows .row").await?;
    // What the missing script left in the console is meant.
    page.driver.quit().await
}

#[tokio::test(flavor = "multi_thread")]
async fn each_bad_file_gets_its_word() -> Result {
    let folder = tempfile::tempdir()?;
    let page = Page::open(DESKTOP, false).await?;
    page.paste("01 03 00 C8 00 03 84 35").await?;
    page.open_file(&file(folder.path(), "empty.log", b"")).await?;
    page.until("[role=status]", "empty.log is empty").await?;
    assert_eq!(page.input().await?, "01 03 00 C8 00 03 84 35", "nothing is lost");
    // A folder that is dropped has a name.
    page.value(
        "const data = new DataTransfer(); data.items.add(new File(['x'], 'logs')); \
         const event = new DragEvent('drop', { bubbles: true, cancelable: true }); \
         Object.defineProperty(event, 'dataTransfer', { value: { files: data.files, items: [{ webkitGetAsEntry: () => \
         ({ isDirectory: true }) }], getData: () => '' } }); document.querySelector('main').dispatchEvent(event);",
    )
    .await?;
    page.until("[role=status]", "logs is a folder").await?;
    assert_eq!(page.input().await?, "01 03 00 C8 00 03 84 35", "nothing is lost");
    open(&page, &file(folder.path(), "log.zip", b"PK\x03\x04\0rest")).await?;
    page.until("[role=alert]", "ZIP archive").await?;
    // UTF-16 is read.
    let wide: Vec<u8> =
        "\u{FEFF}TX: 05 03 00 C8 00 03 85 B1\r\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    page.open_file(&file(folder.path(), "wide.log", &wide)).await?;
    page.until(".file-bar .soft", "1 telegram").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_layout_is_made_by_marking_a_line() -> Result {
    let folder = tempfile::tempdir()?;
    let page = Page::open(DESKTOP, false).await?;
    // The number in front has more bytes than the telegram.
    let text = "AA0102030405060708;B;05 86 02 C3 A1\nAA0102030405060709;A;05 86 02 C3 A1\n".repeat(1200);
    open(&page, &file(folder.path(), "odd.log", text.as_bytes())).await?;
    page.click_text(".file-bar .menu > button", "More").await?;
    page.click_text("[role=menuitem]", "How it is read").await?;
    page.until_value("dialog[open] input[readonly]", "05 86 02").await?;
    page.value(
        "const field = document.querySelector('dialog[open] input[readonly]'); field.focus(); field.setSelectionRange(21, 35);",
    )
    .await?;
    page.click_text("dialog[open] button", "These are the bytes").await?;
    page.click("dialog[open] [aria-label=Close]").await?;
    page.until(".rows .s", "Exception 2").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn what_is_chosen_is_exported() -> Result {
    let folder = tempfile::tempdir()?;
    let page = Page::open(DESKTOP, false).await?;
    page.allow_clipboard().await?;
    open(&page, &file(folder.path(), "bus.log", log(600).as_bytes())).await?;
    page.wait_for(".rows .row").await?;
    page.read_as("Show", "check-failed").await?;
    page.until(COUNT, "1 of ").await?;
    page.click(".rows .row").await?;
    page.fill(".own-note input", "noise of the new drive").await?;
    page.click_text(".file-bar .menu > button", "Export").await?;
    let item = page.value(
        "return [...document.querySelectorAll('[role=menuitem]')].findIndex((it) => it.textContent.startsWith('CSV')) + 1",
    );
    let item = item.await?;
    let csv = std::fs::read_to_string(page.saved(&format!("[role=menuitem]:nth-child({item})")).await?)?;
    assert_eq!(csv.lines().count(), 2, "{csv}");
    assert!(csv.contains(",wrong,") && csv.contains("noise of the new drive"), "{csv}");
    page.close().await
}

/// What somebody opened by keyboard is gone on with by keyboard.
#[tokio::test(flavor = "multi_thread")]
async fn the_keyboard_goes_on_in_a_log() -> Result {
    const FOCUS: &str =
        "return (document.activeElement.innerText || document.activeElement.type || '').trim()";
    let page = Page::open(DESKTOP, false).await?;
    page.driver.execute("document.querySelectorAll('.first-examples button')[1].focus()", vec![]).await?;
    page.press(Key::Enter + "").await?;
    page.wait_for(".rows .row").await?;
    page.press(Key::Tab + "").await?;
    assert_eq!(page.value(FOCUS).await?, json!("Edit text"), "the next is the first thing of the log");
    // The text is edited where the cursor is then, and folded away again.
    page.press(Key::Enter + "").await?;
    page.wait_for(".editor textarea").await?;
    assert_eq!(page.value(FOCUS).await?, json!("textarea"));
    page.click_text(".file-bar button", "Hide text").await?;
    page.until(".file-bar button", "Edit text").await?;
    assert_eq!(page.count(".editor").await?, 0);
    page.press("/").await?;
    assert_eq!(page.value(FOCUS).await?, json!("search"));
    page.close().await
}

/// The list and the telegram beside it keep their height where the window has little.
#[tokio::test(flavor = "multi_thread")]
async fn a_log_in_a_low_window() -> Result {
    let page = Page::open((1366, 650), false).await?;
    page.paste(&log(50)).await?;
    page.wait_for(".rows .row").await?;
    let heights = "const height = css => document.querySelector(css).clientHeight; \
        const foot = document.querySelector('.foot').getBoundingClientRect().top; \
        return [height('.list'), height('.detail'), foot - document.querySelector('.panes').getBoundingClientRect().bottom]";
    for label in ["Edit text", "Hide text"] {
        let [list, detail, gap]: [f64; 3] =
            serde_json::from_value(page.value(heights).await?).expect("numbers");
        assert!(
            list >= 320.0 && detail >= 320.0 && gap >= 0.0,
            "list {list}, detail {detail}, before the foot {gap}"
        );
        page.click_text(".file-bar button", label).await?;
    }
    page.close().await
}

/// On a phone the list stands below the story: what leads to it brings it into sight.
#[tokio::test(flavor = "multi_thread")]
async fn a_finding_leads_to_the_list_on_a_phone() -> Result {
    for button in [".findings button", ".units button"] {
        let page = Page::open(PHONE, false).await?;
        page.driver.execute("document.querySelectorAll('.first-examples button')[1].click()", vec![]).await?;
        page.wait_for(".rows .row").await?;
        page.click(button).await?;
        page.wait_for(".filters .chip").await?;
        page.settle().await?;
        let top = page.value("return document.querySelector('.list').getBoundingClientRect().top").await?;
        assert!(top.as_f64().is_some_and(|top| (0.0..500.0).contains(&top)), "{button}: {top}");
        page.close().await?;
    }
    Ok(())
}
