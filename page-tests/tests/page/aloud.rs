//! The page read aloud: what a screen reader has of it, and what it says at each key. `tests/page/aloud` has it as
//! text, a file for each state; `BLESS=1 cargo xtask test page aloud` writes them. Read them with your eyes shut.

use std::path::Path;

use page_tests::{DESKTOP, Page, Result, chromium_only};
use thirtyfour::prelude::*;

const WHY: &str = "only its driver gives the tree that screen readers have";

const PAIR: &str = "01 03 00 C8 00 03 84 35\n01 03 06 00 08 42 A4 F1 DE B0 F8";

/// Fails where a file says something else.
fn compare(name: &str, said: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/page/aloud").join(name);
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(&path, said).expect("the file can be written");
    }
    let kept = std::fs::read_to_string(&path).unwrap_or_default();
    for (number, (kept, said)) in kept.lines().zip(said.lines()).enumerate() {
        assert_eq!(
            kept,
            said,
            "{name}, line {}: `BLESS=1 cargo xtask test page aloud` renews it",
            number + 1
        );
    }
    assert_eq!(kept, said, "{name}");
}

/// Presses a key wherever the focus is; an element that opens files would take it for one.
async fn press(page: &Page, key: &Key) -> Result {
    page.driver.action_chain().send_keys(key.clone()).perform().await
}

/// What is said at each of `keys`, and then by the page itself.
async fn pressed(page: &Page, said: &mut String, keys: &[(&str, Key)]) -> Result {
    let before = page.told().await?;
    for (name, key) in keys {
        press(page, key).await?;
        said.push_str(&format!("{name}: {}\n", page.focus_aloud().await?));
    }
    let told = Some(page.told().await?).filter(|told| *told != before);
    said.push_str(&format!("then: {}\n\n", told.as_deref().unwrap_or("nothing more")));
    Ok(())
}

/// The stops that Tab makes, from the element that `css` finds to the end of the view.
async fn stops(page: &Page, css: &str) -> Result<String> {
    const MOST: usize = 60;
    let script = format!("document.querySelector('{css}').focus()");
    page.value(&script).await?;
    let mut said = String::from("Tab from stop to stop:\n");
    for _ in 0..MOST {
        said.push_str(&format!("  {}\n", page.focus_aloud().await?));
        press(page, &Key::Tab).await?;
        if page.value("return !document.activeElement.closest('main')").await? == true {
            break;
        }
    }
    Ok(said)
}

#[tokio::test(flavor = "multi_thread")]
async fn telegrams_are_read_aloud() -> Result {
    if chromium_only(WHY) {
        return Ok(());
    }
    let page = Page::open(DESKTOP, false).await?;
    page.paste(PAIR).await?;
    page.choose(1).await?;
    page.wait_for(".causes").await?;
    let mut said = format!("{}\n{}\n", page.aloud("main").await?, stops(&page, ".editor textarea").await?);
    page.value("document.querySelector('.byte-strip [tabindex=\"0\"]').focus()").await?;
    pressed(
        &page,
        &mut said,
        &[("byte, Right", Key::Right), ("Right", Key::Right), ("End", Key::End), ("Left", Key::Left)],
    )
    .await?;
    page.value("document.querySelector('.fields [tabindex=\"0\"]').focus()").await?;
    pressed(&page, &mut said, &[("field, Down", Key::Down), ("End", Key::End), ("Up", Key::Up)]).await?;
    page.value("document.querySelector('.editor textarea').focus()").await?;
    page.fill(".editor textarea", "01 03 00 C8 00 03 84 35").await?;
    said.push_str(&format!("typed: {}\n", page.told().await?));
    compare("telegrams.txt", &said);
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_log_is_read_aloud() -> Result {
    if chromium_only(WHY) {
        return Ok(());
    }
    let page = Page::open(DESKTOP, false).await?;
    page.click_text(".first-examples button", "A customer's log").await?;
    page.wait_for(".list .row:not(.head)").await?;
    page.wait_for(".detail h3").await?;
    let mut said = format!("opened: {}\n\n", page.told().await?);
    said.push_str(&format!("{}\n{}\n", page.aloud("main").await?, stops(&page, ".file-bar button").await?));
    page.value("document.querySelector('.findings [tabindex=\"0\"]').focus()").await?;
    pressed(&page, &mut said, &[("finding, Down", Key::Down), ("Up", Key::Up), ("Enter", Key::Enter)])
        .await?;
    page.value("document.querySelector('.list').focus()").await?;
    pressed(&page, &mut said, &[("row, Down", Key::Down), ("Down", Key::Down), ("End", Key::End)]).await?;
    page.fill(".filters input", "refused").await?;
    said.push_str(&format!("searched: {}\n", page.told().await?));
    compare("log.txt", &said);
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_form_is_read_aloud() -> Result {
    if chromium_only(WHY) {
        return Ok(());
    }
    let page = Page::open(DESKTOP, false).await?;
    page.paste("01 10 00 C8 00 02 04 42 A4 F1 DE 8F 5E").await?;
    page.click_text(".lead a", "Edit in Build").await?;
    page.wait_for(".form input").await?;
    let said = format!("{}\n{}", page.aloud("main").await?, stops(&page, "main input").await?);
    compare("form.txt", &said);
    page.close().await
}
