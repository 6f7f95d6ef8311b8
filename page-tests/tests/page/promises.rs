//! What the page promises whatever it shows: accessible, private, quiet, in both themes, on any
//! screen, whatever somebody does.

use page_tests::{DESKTOP, NARROW, PHONE, Page, Result, VIEWS, chromium_only};
use serde_json::json;
use thirtyfour::prelude::*;

const ALL_SORTS: &str = "01 03 00 C8 00 03 84 35\n01 03 06 00 08 42 A4 F1 DE B0 F8\n05 06 0C 90 04 01 48 33\n\
                         F8 03 00 00 00 01 90 63\n01 03 O0 C8\n00 01 00 00 00 06 FF 03 00 C8 00 03\n\
                         68 0F 0F 68 01 02 5D 52 01 20 34 00 64 00 00 00 05 01 2C 9D 16";

const WIDE: &str = "return document.documentElement.scrollWidth - document.documentElement.clientWidth";

#[tokio::test(flavor = "multi_thread")]
async fn axe_finds_nothing_in_read() -> Result {
    for (size, name) in [(DESKTOP, "desktop"), (PHONE, "phone")] {
        for dark in [false, true] {
            let page = Page::open(size, dark).await?;
            let theme = if dark { "dark" } else { "light" };
            assert_eq!(page.accessibility().await?, [""; 0], "empty, {name}, {theme}");
            page.picture(&format!("start-{name}-{theme}")).await?;
            page.click(".examples > button").await?;
            assert_eq!(page.accessibility().await?, [""; 0], "menu, {name}, {theme}");
            page.press(Key::Escape + "").await?;
            page.paste(ALL_SORTS).await?;
            page.click_text(".fold summary", "Structure").await?;
            for telegram in 0..page.count(".said-lines li").await? {
                page.choose(telegram).await?;
                page.value("document.querySelector('.byte-strip button').click()").await?;
                page.settle().await?;
                assert_eq!(page.accessibility().await?, [""; 0], "telegram {telegram}, {name}, {theme}");
            }
            page.picture(&format!("read-{name}-{theme}")).await?;
            page.close().await?;
        }
    }
    Ok(())
}

/// All views in both themes, also at twice the size: 200 % of 1440 pixels leave 720.
#[tokio::test(flavor = "multi_thread")]
async fn axe_finds_nothing_in_any_view() -> Result {
    for size in [DESKTOP, (720, 450), NARROW] {
        for dark in [false, true] {
            let page = Page::open(size, dark).await?;
            page.paste(ALL_SORTS).await?;
            page.fragment().await?;
            for view in VIEWS {
                page.go(view).await?;
                page.one("main h2, main input").await?;
                assert_eq!(page.accessibility().await?, [""; 0], "{view}, {size:?}, dark {dark}");
                assert_eq!(page.value(WIDE).await?, json!(0), "{view} scrolls sideways, {size:?}");
                if size == DESKTOP {
                    let theme = if dark { "dark" } else { "light" };
                    page.picture(&format!("{}-desktop-{theme}", view.trim_start_matches("#/"))).await?;
                }
            }
            page.close().await?;
        }
    }
    Ok(())
}

/// The page has the policy, and loads nothing after its start, whatever view is shown.
#[tokio::test(flavor = "multi_thread")]
async fn every_view_is_as_strict() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    let policy = page
        .value("return document.head.querySelector('[http-equiv=Content-Security-Policy]').content")
        .await?;
    let policy = policy.as_str().unwrap_or_default();
    assert!(
        policy.starts_with("default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'"),
        "{policy}"
    );
    let loaded = "return performance.getEntriesByType('resource').map((entry) => entry.name)";
    for view in ["build", "check", "devices", "read"] {
        page.view(view).await?;
        page.one("main h2, main textarea").await?;
    }
    let before = page.value(loaded).await?;
    let origin = page.value("return location.origin").await?;
    let own =
        |name: &serde_json::Value| name.as_str().unwrap_or_default().starts_with(origin.as_str().unwrap());
    assert!(before.as_array().is_some_and(|names| names.len() >= 3 && names.iter().all(own)), "{before}");
    for view in ["build", "check", "devices", "read"] {
        page.view(view).await?;
    }
    page.paste(ALL_SORTS).await?;
    page.choose(1).await?;
    page.fragment().await?;
    assert_eq!(page.value(loaded).await?, before, "nothing is loaded after the start");
    // The policy forbids it, too: not even the page itself could send what was pasted.
    let forbidden = page
        .driver
        .execute_async(
            "const done = arguments[0]; document.addEventListener('securitypolicyviolation', (event) => \
             done(event.effectiveDirective)); fetch('https://example.org/').catch(() => {})",
            vec![],
        )
        .await?;
    assert_eq!(forbidden.json(), &json!("connect-src"));
    assert_eq!(page.value("return document.querySelectorAll('script:not([src])').length").await?, json!(0));
    page.driver.quit().await
}

#[tokio::test(flavor = "multi_thread")]
async fn the_console_stays_empty() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste(ALL_SORTS).await?;
    // The preload that nobody used would be told of after some seconds.
    tokio::time::sleep(std::time::Duration::from_secs(6)).await;
    page.close().await
}

/// A thousand actions in a view, the same in each run: clicks, keys, entries, choices, scrolling, back
/// and forward. Nothing ends the page, and nothing comes to the console.
const ACTIONS: &str = r"
    const [seed, count, done] = arguments;
    let state = seed;
    const random = (n) => { state = (Math.imul(state, 1664525) + 1013904223) >>> 0; return Math.floor(state / 4294967296 * n); };
    const pick = (all) => all[random(all.length)];
    const texts = ['01 03 00 C8 00 03 84 35', '01 03 06 00 80 42 A4 F1 DE B0 F8', '71 00 22 34 00', ':0106000005', '7', '-1', 'x',
      '0x1F', '', '99999', '05 10 0C 10 00 04 08 06 02 31', '00 01 00 00 00 06 01 06 00 00', 'write channel 6', '01 03\n'.repeat(20)];
    const keys = ['ArrowDown', 'ArrowUp', 'ArrowLeft', 'ArrowRight', 'Home', 'End', 'Enter', 'Escape', ' ', 'PageDown', 'Tab', '?', '/'];
    const here = location.hash.split('?')[0];
    // What leaves the page, or opens a window of the browser, is no part of it.
    window.print = () => {}; HTMLAnchorElement.prototype.click = function () { if (!this.download) this.dispatchEvent(new MouseEvent('click', { bubbles: true, cancelable: true })); };
    const press = HTMLInputElement.prototype.click; HTMLInputElement.prototype.click = function () { if (this.type != 'file') press.call(this); };
    navigator.clipboard.writeText = () => Promise.resolve();
    let at = 0;
    const act = () => {
      const end = document.querySelector('.ended');
      if (end) return done(`ended after ${at}: ${end.textContent}`);
      if (at++ == count) return done('');
      const kind = random(20);
      const within = [...document.querySelectorAll('main *, .top *, .toast *')];
      if (kind < 8) {
        const all = within.filter((e) => e.matches('button, summary, a[href^=\'#\'], label:not(:has([type=file])), [role=row], td'));
        if (all.length) pick(all).dispatchEvent(new MouseEvent('click', { bubbles: true, cancelable: true, detail: 1 }));
      } else if (kind < 12) {
        const all = within.filter((e) => e.matches('textarea, input:not([type=file])'));
        if (all.length) { const field = pick(all);
          if (field.type == 'checkbox' || field.type == 'radio') field.click(); else {
            // Browsers take nothing else there.
            const numbers = field.type == 'range' || field.type == 'number';
            const text = numbers ? String(random(50)) : pick(texts);
            field.focus(); field.value = text; field.dispatchEvent(new Event('input', { bubbles: true }));
            field.dispatchEvent(new Event('change', { bubbles: true })); } }
      } else if (kind < 14) {
        const all = within.filter((e) => e.matches('select'));
        if (all.length) { const list = pick(all); list.selectedIndex = random(list.options.length); list.dispatchEvent(new Event('change', { bubbles: true })); }
      } else if (kind < 17) {
        const all = within.filter((e) => e.matches('[tabindex=\'0\'], button, input, textarea'));
        if (all.length) { const e = pick(all); e.focus(); e.dispatchEvent(new KeyboardEvent('keydown', { key: pick(keys), bubbles: true, cancelable: true })); }
      } else if (kind == 17) {
        for (const e of within.filter((e) => e.scrollHeight > e.clientHeight + 40).slice(0, 3)) e.scrollTop = random(e.scrollHeight);
      } else if (kind == 18) {
        const e = pick(within); if (e) for (const name of ['pointerenter', 'pointerover', 'pointerleave']) e.dispatchEvent(new PointerEvent(name, { bubbles: true }));
      } else if (random(4) == 0) {
        history.go(random(2) ? 1 : -1);
      }
      // Who wandered off comes back.
      if (at % 25 == 0 && location.hash.split('?')[0] != here) location.hash = here;
      setTimeout(act, at % 10 ? 0 : 20);
    };
    act();";

async fn a_thousand_actions_break_nothing(view: &str, seed: u32) -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.driver.set_script_timeout(std::time::Duration::from_secs(300)).await?;
    page.paste(ALL_SORTS).await?;
    page.fragment().await?;
    page.driver.execute("location.hash = arguments[0]", vec![json!(view)]).await?;
    page.fragment().await?;
    let ended = page.driver.execute_async(ACTIONS, vec![json!(seed * 7919), json!(1000)]).await?;
    assert_eq!(ended.json(), &json!(""), "{view}: {:?}", page.console().await?);
    page.close().await
}

/// A test for each, so that they run side by side.
macro_rules! a_thousand_actions_in {
    ($($name:ident: $view:literal, $seed:literal;)*) => {
        mod a_thousand_actions_break_nothing_in {
            $(#[tokio::test(flavor = "multi_thread")]
            async fn $name() -> super::Result {
                super::a_thousand_actions_break_nothing($view, $seed).await
            })*
        }
    };
}

a_thousand_actions_in! {
    read: "#/read", 1;
    build: "#/build", 2;
    check: "#/check", 3;
    devices: "#/devices", 4;
    lessons: "#/learn", 5;
    sheet: "#/sheet", 6;
    practice: "#/learn?place=practice.1.decode.2.K7QM.1", 7;
    telegrams: "#/learn?place=telegrams", 8;
    reference: "#/learn?place=reference", 9;
}

#[tokio::test(flavor = "multi_thread")]
async fn the_theme_can_be_switched_and_stays() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    let ground = "return getComputedStyle(document.documentElement).backgroundColor";
    let light = page.value(ground).await?;
    page.click_text(".top .menu > button", "Theme").await?;
    page.click_text("[role=menuitem]", "Dark").await?;
    let dark = page.value(ground).await?;
    assert_ne!(light, dark);
    page.driver.refresh().await?;
    page.one(".editor textarea").await?;
    assert_eq!(page.value(ground).await?, dark, "after a reload");
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_narrow_page_does_not_scroll_sideways() -> Result {
    let page = Page::open(NARROW, false).await?;
    assert_eq!(page.value(WIDE).await?, json!(0), "empty");
    page.paste(ALL_SORTS).await?;
    for telegram in 0..page.count(".said-lines li").await? {
        page.choose(telegram).await?;
        assert_eq!(page.value(WIDE).await?, json!(0), "telegram {telegram}");
    }
    page.click_text(".fold summary", "Structure").await?;
    assert_eq!(page.value(WIDE).await?, json!(0), "structure");
    page.picture("read-narrow").await?;
    page.close().await
}

/// A telegram from the first key to its last field, without a pointer.
#[tokio::test(flavor = "multi_thread")]
async fn everything_is_reached_by_keyboard() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste("01 03 00 C8 00 03 84 35\n01 03 06 00 08 42 A4 F1 DE B0 F8").await?;
    page.driver.execute("document.querySelector('.skip').focus()", vec![]).await?;
    let mut stops = vec!["skip".to_owned()];
    for _ in 0..60 {
        page.driver.action_chain().send_keys(Key::Tab + "").perform().await?;
        let stop = page
            .value(
                "const e = document.activeElement; const box = (e.type == 'file' ? e.parentElement : e).getBoundingClientRect(); \
                 const part = e.closest('.views, .end, .byte-strip, .fields, .problems, .fold, .causes, .check-result, .lead, \
                 .said-lines, .editor, .reading-choices, .input-tools'); \
                 return [(part?.className || e.tagName), \
                 getComputedStyle(e.type == 'file' ? e.parentElement : e).outlineStyle != 'none' || e.tagName == 'TEXTAREA', \
                 Math.round(Math.min(box.top, innerHeight - box.bottom)), e.tagName == 'BODY', e.textContent.slice(0, 20)]",
            )
            .await?;
        if stop[3] == json!(true) {
            break;
        }
        let name = stop[0].as_str().unwrap_or_default().to_owned();
        assert_eq!(stop[1], json!(true), "{name} shows that it has the focus: {stop}");
        assert!(stop[2].as_f64() >= Some(0.0), "{name} is in sight: {stop}");
        stops.push(name);
    }
    for name in [
        "views",
        "end",
        "editor",
        "said-lines",
        "reading-choices",
        "input-tools",
        "lead",
        "problems",
        "byte-strip",
        "causes",
        "fields",
        "fold",
        "check-result",
    ] {
        assert!(stops.iter().any(|stop| stop.contains(name)), "{name} is not reached: {stops:?}");
    }
    for one in ["byte-strip", "fields"] {
        assert_eq!(stops.iter().filter(|stop| stop.contains(one)).count(), 1, "{one} is one stop: {stops:?}");
    }
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn the_result_is_told_to_screen_readers() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    let told = "return [...document.querySelectorAll('[role=status], [aria-live]')].map((it) => it.textContent).join(' ')";
    page.paste("01 03 06 00 08 42 A4 F1 DE B0 F8").await?;
    let at_once = page.value(told).await?;
    assert!(!at_once.as_str().unwrap_or_default().contains("1 wrong checksum"), "not at once: {at_once}");
    tokio::time::sleep(std::time::Duration::from_millis(1500)).await;
    let later = page.value(told).await?;
    assert!(later.as_str().unwrap_or_default().contains("1 telegram, 1 wrong checksum"), "{later}");
    page.close().await
}

/// Where the browser keeps nothing, or what it kept is not ours, the page works all the same.
#[tokio::test(flavor = "multi_thread")]
async fn whatever_the_browser_keeps_the_page_starts() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    for value in ["", "x", "z=AAAA", "text=%E0%A4%A&device=%", "file=gone|1|2", &"9".repeat(100_000)] {
        let script = "for (const key of ['read', 'build', 'check', 'devices', 'learn', 'lessons', 'own-lessons', 'practice', 'settings', 'notes', 'theme']) \
                      localStorage.setItem('buslens.' + key, arguments[0])";
        page.driver.execute(script, vec![json!(value)]).await?;
        for view in VIEWS {
            page.go(view).await?;
            page.one("main h2, main input, main textarea").await?;
            assert_eq!(page.count(".ended").await?, 0, "{value:.20} in {view}");
        }
        page.go("").await?;
    }
    page.close().await
}

/// A browser that keeps nothing, or has no room, or keeps no files: all views work until they are left.
#[tokio::test(flavor = "multi_thread")]
async fn storage_denied_or_full_breaks_no_view() -> Result {
    if chromium_only("its script has to run before the page") {
        return Ok(());
    }
    let denied = |what: &str| {
        format!(
            "Object.defineProperty(window, '{what}', {{ get() {{ throw new DOMException('no', 'SecurityError') }} }});"
        )
    };
    let full = "Storage.prototype.setItem = () => { throw new DOMException('no', 'QuotaExceededError') }; \
                IDBObjectStore.prototype.put = () => { throw new DOMException('no', 'QuotaExceededError') };";
    let nothing = "Object.defineProperty(window, 'localStorage', { value: null }); \
                   Object.defineProperty(window, 'indexedDB', { value: null });";
    let folder = tempfile::tempdir()?;
    let log = folder.path().join("plant.log");
    std::fs::write(&log, "TX 01 03 00 C8 00 03 84 35\n".repeat(4000))?;
    for script in [denied("localStorage") + denied("indexedDB").as_str(), full.to_owned(), nothing.to_owned()]
    {
        let page = Page::open_at("#/read", DESKTOP, false).await?;
        page.before_loading(&script).await?;
        for view in VIEWS {
            page.go(view).await?;
            page.one("main h2, main input, main textarea").await?;
            assert_eq!(page.count(".ended").await?, 0, "{script:.60} in {view}");
        }
        page.go("#/read").await?;
        page.paste(ALL_SORTS).await?;
        page.choose(1).await?;
        assert_eq!(page.shown().await?, "01 03 06 00 08 42 A4 F1 DE B0 F8", "{script:.60}");
        page.click_text(".top .menu > button", "Theme").await?;
        page.click_text("[role=menuitem]", "Dark").await?;
        page.open_file(&log.display().to_string()).await?;
        page.wait_for(".rows .row").await?;
        page.fill(".own-note input", "noise of the new drive").await?;
        page.until(".rows .noted", "noise of the new drive").await?;
        page.close().await?;
    }
    Ok(())
}
