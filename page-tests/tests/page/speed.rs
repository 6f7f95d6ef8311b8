//! How long the page takes. Medians are printed; held is the quickest of some tries, since what else the machine does
//! only adds to it. These run before all others and one at a time, so little does.

use std::time::Instant;

use page_tests::{DESKTOP, Page, Result, VIEWS};
use serde_json::json;
use thirtyfour::prelude::*;

use crate::log::{COUNT, file, log, open, wait_for_all};

/// In milliseconds, as all budgets here: 60 frames a second.
const FRAME: f64 = 16.7;

/// What was measured of the same thing some times, in milliseconds.
struct Times(Vec<f64>);

impl Times {
    fn of(times: impl IntoIterator<Item = f64>) -> Self {
        let mut times: Vec<f64> = times.into_iter().collect();
        times.sort_by(f64::total_cmp);
        Self(times)
    }

    fn median(&self) -> f64 {
        self.0[self.0.len() / 2]
    }

    #[track_caller]
    fn hold(&self, budget: f64, what: &str) {
        assert!(self.0[0] <= budget, "{what}: never within {budget} ms: {:.0?}", self.0);
    }
}

/// From opening the page to the first telegram read, as the browser measures it.
#[tokio::test(flavor = "multi_thread")]
async fn the_first_telegram_is_read_within_a_second() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    // The first start of a browser compiles what the others find compiled.
    let mut times = Vec::new();
    for _ in 0..5 {
        page.go("#/read?text=01+03+00+C8+00+03+84+35").await?;
        page.until(".lead h2", "Ask unit 1").await?;
        let script = "const done = arguments[0]; new PerformanceObserver((list) => \
            done(Math.max(...list.getEntries().map((entry) => entry.startTime)))).observe({ \
            type: 'largest-contentful-paint', buffered: true })";
        let painted: f64 = page.driver.execute_async(script, vec![]).await?.convert()?;
        times.push(painted);
    }
    let times = Times::of(times);
    println!("first telegram painted {:.0} ms after opening the page ({:.0?})", times.median(), times.0);
    times.hold(1000.0, "the first telegram");
    page.close().await
}

/// Each view is there before a person waits for it.
#[tokio::test(flavor = "multi_thread")]
async fn views_are_switched() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste("01 03 00 C8 00 03 84 35").await?;
    let script = "const [view, done] = arguments; const start = performance.now(); \
        document.querySelector(`.views a[href='${view}']`).click(); const look = () => \
        document.querySelector(`.views a[href='${view}'][aria-current]`) ? \
        requestAnimationFrame(() => setTimeout(() => done(performance.now() - start))) : setTimeout(look, 1); look();";
    let mut said = Vec::new();
    for view in VIEWS.iter().skip(1).filter(|view| **view != "#/sheet") {
        let mut times = Vec::new();
        for _ in 0..5 {
            let took: f64 = page.driver.execute_async(script, vec![json!(view)]).await?.convert()?;
            times.push(took);
            page.view("read").await?;
        }
        let times = Times::of(times);
        said.push(format!("{view} {:.0}", times.median()));
        times.hold(100.0, view);
    }
    println!("other views are there after, in ms: {}", said.join(", "));
    page.close().await
}

/// A digit is typed and deleted in turn, so many characters before the end of a field: until each input is handled,
/// until all is drawn and laid out, and until the frame behind that is done, of which up to 17 ms are waiting for its
/// turn. And how many elements each of them makes.
async fn keystrokes(page: &Page, field: &str, before_end: usize, pause: u32) -> Result<([Times; 3], f64)> {
    const KEYS: usize = 21;
    let script = "const [css, back, pause, keys, done] = arguments; const field = document.querySelector(css); \
        field.focus(); field.setSelectionRange(field.value.length - back, field.value.length - back); \
        let made = 0; const watch = new MutationObserver((all) => { for (const one of all) for (const node of one.addedNodes) \
          if (node.nodeType == 1) made += 1 + node.querySelectorAll('*').length; }); \
        watch.observe(document.body, { childList: true, subtree: true }); const times = []; \
        const step = async () => { const start = performance.now(); \
          document.execCommand(times.length % 2 ? 'insertText' : 'delete', false, '4'); \
          const handled = performance.now() - start; for (let turn = 0; turn < 20; turn++) await 0; \
          document.body.offsetHeight; const drawn = performance.now() - start; \
          requestAnimationFrame(() => { const channel = new MessageChannel(); channel.port1.onmessage = () => { \
            times.push([handled, drawn, performance.now() - start]); \
            if (times.length < keys) return setTimeout(step, pause); watch.disconnect(); done([times, made / keys]); }; \
            channel.port2.postMessage(0); }); }; step();";
    let given = vec![json!(field), json!(before_end), json!(pause), json!(KEYS)];
    let (times, made): (Vec<[f64; 3]>, f64) = page.driver.execute_async(script, given).await?.convert()?;
    Ok(([0, 1, 2].map(|at| Times::of(times.iter().map(|all| all[at]))), made))
}

/// A keystroke in the longest telegram is drawn and laid out within a frame, and draws little anew.
#[tokio::test(flavor = "multi_thread")]
async fn a_keystroke_in_a_telegram() -> Result {
    /// Elements that a keystroke makes: the telegram has more than a thousand.
    const MADE_ANEW: f64 = 100.0;
    let page = Page::open(DESKTOP, false).await?;
    let longest = format!("01 03 FA {}12 34", "42 A4 ".repeat(125));
    for (place, before_end) in [("at the end", 0), ("in the middle", longest.len() - 300)] {
        page.paste(&longest).await?;
        let ([handled, drawn, framed], made) = keystrokes(&page, ".editor textarea", before_end, 60).await?;
        println!(
            "keystroke {place} of a telegram of 255 bytes: {:.1} ms until handled, {:.1} ms until drawn and laid out (the \
             quickest {:.1}), {:.1} ms until its frame is done; {made:.0} elements are made anew",
            handled.median(),
            drawn.median(),
            drawn.0[0],
            framed.median()
        );
        drawn.hold(FRAME, place);
        assert!(made <= MADE_ANEW, "{place}: {made:.0} elements are made anew by a keystroke");
        assert!(!page.text(".lead h2").await?.is_empty());
    }
    page.close().await
}

/// A log of 1,000 lines that somebody types in is read at the next pause.
#[tokio::test(flavor = "multi_thread")]
async fn a_keystroke_in_a_log() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste(&log(500)).await?;
    page.wait_for(".rows .row").await?;
    page.click_text(".file-bar button", "Edit text").await?;
    let ([_, _, framed], _) = keystrokes(&page, ".editor textarea", 2, 500).await?;
    println!("keystroke in a log of 1,000 lines: {:.1} ms until its frame is done", framed.median());
    framed.hold(50.0, "a keystroke in a log of 1,000 lines");
    page.close().await
}

/// The longest telegram is edited without a wait that a person feels.
#[tokio::test(flavor = "multi_thread")]
async fn a_keystroke_in_a_long_form() -> Result {
    let text = format!("01 10 00 00 00 7B F6 {}", "12 34 ".repeat(123));
    let link = format!("#/build?text={}", text.trim().replace(' ', "+"));
    let page = Page::open_at(&link, DESKTOP, false).await?;
    page.until(".making h3", "Write multiple registers").await?;
    page.value("document.querySelectorAll('.making .item input')[60].classList.add('typed')").await?;
    let ([_, drawn, framed], _) = keystrokes(&page, ".typed", 0, 50).await?;
    println!(
        "keystroke in a form of 123 registers: {:.1} ms until drawn and laid out, {:.1} ms until its frame is done",
        drawn.median(),
        framed.median()
    );
    drawn.hold(FRAME, "a keystroke in a form of 123 registers");
    page.close().await
}

/// 20 MB: what the page's thread does meanwhile is measured, and printed.
#[tokio::test(flavor = "multi_thread")]
async fn a_large_log_does_not_block_the_page() -> Result {
    let folder = tempfile::tempdir()?;
    let text = log(200_000);
    let path = file(folder.path(), "large.log", text.as_bytes());
    let page = Page::open(DESKTOP, false).await?;
    page.value(
        "window.longest = 0; new PerformanceObserver((list) => { for (const entry of list.getEntries()) \
         longest = Math.max(longest, entry.duration); }).observe({ type: 'longtask' });",
    )
    .await?;
    let start = Instant::now();
    let first = open(&page, &path).await?;
    page.wait_for(".rows .row").await?;
    wait_for_all(&page).await?;
    let (took, longest) = (start.elapsed(), page.value("return longest").await?);
    println!(
        "{:.1} MB: something to see after {first:?}, all read in {took:?}; the longest task of the page's thread took \
         {longest} ms",
        text.len() as f64 / 1e6
    );
    // What was seen first is still there, and what came later is, too.
    page.until(COUNT, "396,667 rows").await?;
    assert!(page.count(".rows .row").await? <= 100, "only rows in sight exist");
    // The end of the list is there, too.
    page.driver.execute("document.querySelector('.list').focus()", vec![]).await?;
    page.press(Key::End).await?;
    let last = page.value("return document.querySelector('.list').ariaRowCount").await?;
    let last = last.as_str().and_then(|text| text.parse::<usize>().ok()).expect("a number") - 2;
    page.wait_for(&format!("#row-{last}[aria-selected=true]")).await?;
    page.close().await
}
