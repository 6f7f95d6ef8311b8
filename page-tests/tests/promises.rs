//! What the page promises whatever it shows: accessible, private, quiet, in both themes, on any
//! screen.

use page_tests::{DESKTOP, DOCUMENTS, NARROW, PHONE, Page, Result};
use serde_json::json;
use thirtyfour::prelude::*;

const ALL_SORTS: &str = "01 03 00 C8 00 03 84 35\n01 03 06 00 08 42 A4 F1 DE B0 F8\n05 06 0C 90 04 01 48 33\n\
                         F8 03 00 00 00 01 90 63\n01 03 O0 C8\nhello\n00 01 00 00 00 06 FF 03 00 C8 00 03\n\
                         68 0F 0F 68 01 02 5D 52 01 20 34 00 64 00 00 00 05 01 2C 9D 16";

#[tokio::test(flavor = "multi_thread")]
async fn axe_finds_nothing() -> Result {
    for (size, name) in [(DESKTOP, "desktop"), (PHONE, "phone")] {
        for dark in [false, true] {
            let page = Page::open(size, dark).await?;
            let theme = if dark { "dark" } else { "light" };
            assert_eq!(page.accessibility().await?, [""; 0], "empty, {name}, {theme}");
            page.picture(&format!("empty-{name}-{theme}")).await?;
            page.click("#examples summary").await?;
            assert_eq!(page.accessibility().await?, [""; 0], "menu, {name}, {theme}");
            page.click("#examples summary").await?;
            page.paste(ALL_SORTS).await?;
            page.click("#layout summary").await?;
            for telegram in 0..7 {
                page.choose(telegram).await?;
                assert_eq!(page.accessibility().await?, [""; 0], "telegram {telegram}, {name}, {theme}");
            }
            page.picture(&format!("decode-{name}-{theme}")).await?;
            page.close().await?;
        }
    }
    Ok(())
}

/// The other documents in both themes, also at twice the size: 200 % of 1440 pixels leave 720.
#[tokio::test(flavor = "multi_thread")]
async fn axe_finds_nothing_in_any_document() -> Result {
    for size in [DESKTOP, (720, 450), NARROW] {
        for dark in [false, true] {
            let page = Page::open(size, dark).await?;
            page.paste(ALL_SORTS).await?;
            page.fragment().await?;
            for document in DOCUMENTS {
                page.go(document).await?;
                page.one("main h2, main input").await?;
                assert_eq!(page.accessibility().await?, [""; 0], "{document}, {size:?}, dark {dark}");
                let wide =
                    "return document.documentElement.scrollWidth - document.documentElement.clientWidth";
                assert_eq!(page.value(wide).await?, json!(0), "{document} scrolls sideways, {size:?}");
            }
            page.close().await?;
        }
    }
    Ok(())
}

/// Every document has the policy, and loads nothing after its start.
#[tokio::test(flavor = "multi_thread")]
async fn every_document_is_as_strict() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    for document in DOCUMENTS {
        page.go(document).await?;
        let policy = page
            .value("return document.head.querySelector('[http-equiv=Content-Security-Policy]').content")
            .await?;
        let policy = policy.as_str().unwrap_or_default();
        assert!(policy.starts_with("default-src 'none'; script-src 'self' 'wasm-unsafe-eval'"), "{policy}");
        let loaded = "return performance.getEntriesByType('resource').length";
        let before = page.value(loaded).await?;
        for button in
            page.driver.find_all(By::Css("main button:not([data-print], [data-save])")).await?.iter().take(20)
        {
            // Some are drawn anew by others, and gone.
            let _ = button.click().await;
        }
        page.settle().await?;
        assert_eq!(page.value(loaded).await?, before, "{document} loads something");
    }
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn nothing_is_asked_of_anybody_else() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    let loaded = "return performance.getEntriesByType('resource').map((entry) => entry.name)";
    let before = page.value(loaded).await?;
    let origin = page.value("return location.origin").await?;
    let own =
        |name: &serde_json::Value| name.as_str().unwrap_or_default().starts_with(origin.as_str().unwrap());
    assert!(before.as_array().is_some_and(|names| names.len() >= 3 && names.iter().all(own)), "{before}");
    page.paste(ALL_SORTS).await?;
    page.click("#telegram-1").await?;
    page.click("#examples summary").await?;
    page.click("#examples [data-example=refused]").await?;
    page.settle().await?;
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
    page.click("#telegram-1").await?;
    page.click("#layout summary").await?;
    // The preload that nobody used would be told of after some seconds.
    tokio::time::sleep(std::time::Duration::from_secs(6)).await;
    assert_eq!(page.console().await?, [""; 0]);
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn the_theme_can_be_switched_and_stays() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    let ground = "return getComputedStyle(document.documentElement).backgroundColor";
    let light = page.value(ground).await?;
    page.one("#theme option[value=dark]").await?.click().await?;
    let dark = page.value(ground).await?;
    assert_ne!(light, dark);
    page.driver.refresh().await?;
    page.one("#input").await?;
    assert_eq!(page.value(ground).await?, dark, "after a reload");
    assert_eq!(page.value("return document.getElementById('theme').value").await?, json!("dark"));
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_narrow_page_does_not_scroll_sideways() -> Result {
    let page = Page::open(NARROW, false).await?;
    let wide = "return document.documentElement.scrollWidth - document.documentElement.clientWidth";
    assert_eq!(page.value(wide).await?, json!(0), "empty");
    page.paste(ALL_SORTS).await?;
    for telegram in 0..7 {
        page.choose(telegram).await?;
        assert_eq!(page.value(wide).await?, json!(0), "telegram {telegram}");
    }
    page.click("#layout summary").await?;
    assert_eq!(page.value(wide).await?, json!(0), "layout");
    page.picture("decode-narrow").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn everything_is_reached_by_keyboard() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste("01 03 00 C8 00 03 84 35\n01 03 06 00 08 42 A4 F1 DE B0 F8").await?;
    page.driver.execute("document.querySelector('.skip').focus()", vec![]).await?;
    let mut stops = vec!["skip".to_owned()];
    for _ in 0..40 {
        page.driver.action_chain().send_keys(Key::Tab + "").perform().await?;
        let stop = page
            .value(
                "let e = document.activeElement; \
                 if (e.type == 'file') e = document.querySelector(`label[for=${e.id}]`); \
                 const box = e.getBoundingClientRect(); \
                 return [e.closest('.nav, .strip, .fields, .problems, .layout, .menu, .bar, .check')?.className || e.id || e.className, \
                 getComputedStyle(e).outlineStyle, [box.top, innerHeight - box.bottom, box.width - 24].map(Math.round), e.tagName]",
            )
            .await?;
        let name = stop[0].as_str().unwrap_or_default().split(' ').next().unwrap_or_default().to_owned();
        if name.is_empty() {
            break;
        }
        assert_ne!(stop[1], json!("none"), "{name} shows that it has the focus");
        let outside =
            stop[2].as_array().is_some_and(|room| room.iter().any(|room| room.as_f64() < Some(0.0)));
        assert!(!outside, "{name} is in sight and large enough: {}", stop[2]);
        stops.push(name);
    }
    let expected = [
        "skip",
        "nav",
        "nav",
        "nav",
        "nav",
        "nav",
        "quiet",
        "theme",
        "input",
        "protocol",
        "direction",
        "device",
        "menu",
        "quiet",
        "quiet",
        "quiet",
        "list",
        "link",
    ];
    assert_eq!(stops[..expected.len()], expected);
    for name in ["problems", "bar", "strip", "fields", "check", "layout"] {
        assert!(stops.iter().any(|stop| stop == name), "{name} is not reached: {stops:?}");
    }
    assert_eq!(stops.iter().filter(|stop| *stop == "strip").count(), 1, "the bytes are one stop");
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn the_result_is_told_to_screen_readers() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste("01 03 06 00 08 42 A4 F1 DE B0 F8").await?;
    assert_eq!(
        page.value("return document.getElementById('status').textContent").await?,
        json!(""),
        "not at once"
    );
    tokio::time::sleep(std::time::Duration::from_millis(1500)).await;
    assert_eq!(
        page.value("return document.getElementById('status').textContent").await?,
        json!("1 telegram, 1 check failed")
    );
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn bytes_are_copied() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.allow_clipboard().await?;
    page.paste("010306000842A4F1DEB0F8").await?;
    page.click(".bar button").await?;
    assert_eq!(page.clipboard().await?, "01 03 06 00 08 42 A4 F1 DE B0 F8");
    page.click("div.check button.quiet").await?;
    assert_eq!(page.clipboard().await?, "01 03 06 00 08 42 A4 F1 DE 50 E7");
    page.close().await
}

/// Measures and prints, and holds nothing against a noisy machine.
#[tokio::test(flavor = "multi_thread")]
async fn keystrokes() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.driver.cdp().send_raw("Performance.enable", json!({})).await?;
    // A digit is typed and deleted in turn: until the input is handled, until all is drawn and laid out,
    // until the frame behind that is done, of which up to 17 ms are waiting for its turn.
    let script = "const [at, done] = arguments; const input = document.getElementById('input'); input.focus(); \
        input.setSelectionRange(at, at); const times = []; \
        const step = async () => { const start = performance.now(); \
          document.execCommand(times.length % 2 ? 'insertText' : 'delete', false, '4'); \
          const handled = performance.now() - start; for (let turn = 0; turn < 20; turn++) await 0; \
          document.body.offsetHeight; const drawn = performance.now() - start; \
          requestAnimationFrame(() => { const channel = new MessageChannel(); \
            channel.port1.onmessage = () => { times.push([handled, drawn, performance.now() - start]); \
              times.length < 21 ? setTimeout(step, 60) : done([0, 1, 2].map((at) => \
                times.map((all) => all[at]).sort((a, b) => a - b)[10])); }; channel.port2.postMessage(0); }); }; step();";
    let longest = format!("01 03 FA {}12 34", "42 A4 ".repeat(125));
    let many = "01 03 00 C8 00 03 84 35\n".repeat(100_000 / 24);
    for (what, text, at) in [
        ("at the end of a telegram of 255 bytes", &longest, longest.len()),
        ("in the middle of a telegram of 255 bytes", &longest, 300),
        ("at the end of 100,000 characters", &many, many.len() - 1),
    ] {
        page.fill(text).await?;
        let before = task_seconds(&page).await?;
        let medians: [f64; 3] = page.driver.execute_async(script, vec![json!(at)]).await?.convert()?;
        let busy = (task_seconds(&page).await? - before) * 1000.0 / 21.0;
        println!(
            "keystroke {what}: {:.1} ms until handled, {:.1} ms until drawn and laid out, {:.1} ms until its \
             frame is done; the page's thread is busy for {busy:.1} ms",
            medians[0], medians[1], medians[2]
        );
        assert!(!page.text(".detail h2").await?.is_empty());
    }
    page.close().await
}

/// How long the page's thread has been busy so far.
async fn task_seconds(page: &Page) -> Result<f64> {
    let metrics = page.driver.cdp().send_raw("Performance.getMetrics", json!({})).await?;
    let metrics = metrics["metrics"].as_array().cloned().unwrap_or_default();
    let duration = metrics.iter().find(|metric| metric["name"] == "TaskDuration");
    Ok(duration.and_then(|metric| metric["value"].as_f64()).unwrap_or_default())
}
