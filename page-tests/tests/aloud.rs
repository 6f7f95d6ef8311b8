//! The page read aloud: what a screen reader has of it, and what it says at each key. `tests/aloud` has it as
//! text, a file for each state; `BLESS=1 cargo xtask test page aloud` writes them. Read them with your eyes shut.

use std::path::Path;

use page_tests::{DESKTOP, Page, Result};
use thirtyfour::prelude::*;

const PAIR: &str = "01 03 00 C8 00 03 84 35\n01 03 06 00 08 42 A4 F1 DE B0 F8";

const LOG: &str = "12:00:00.000 TX 01 03 00 C8 00 03 84 35\n12:00:00.020 RX 01 03 06 00 80 42 A4 F1 DE B0 F8\n\
                   12:00:01.000 TX 01 03 00 C8 00 03 84 35\n12:00:01.020 RX 01 03 06 00 80 42 A4 F1 DE B0 F9\n\
                   12:00:02.000 TX 02 03 00 C8 00 03 84 06\n12:00:03.000 TX 02 03 00 C8 00 03 84 06\n\
                   12:00:04.000 TX 01 03 FF FF 00 01 84 2E\n12:00:04.020 RX 01 83 02 C0 F1\n";

/// Fails where a file says something else.
fn compare(name: &str, said: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/aloud").join(name);
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

/// What is said at each of `keys`, and then by the page itself.
async fn pressed(page: &Page, said: &mut String, keys: &[(&str, Key)]) -> Result {
    for (name, key) in keys {
        page.press(key.clone()).await?;
        said.push_str(&format!("{name}: {}\n", page.focus_aloud().await?));
    }
    let told = page.told().await?;
    said.push_str(&format!("then: {told}\n\n"));
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
        page.press(Key::Tab).await?;
        if page.value("return !document.activeElement.closest('main')").await? == true {
            break;
        }
    }
    Ok(said)
}

#[tokio::test(flavor = "multi_thread")]
async fn telegrams_are_read_aloud() -> Result {
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
    pressed(&page, &mut said, &[("field, Down", Key::Down), ("Down", Key::Down), ("End", Key::End)]).await?;
    page.value("document.querySelector('.editor textarea').focus()").await?;
    page.fill(".editor textarea", "01 03 00 C8 00 03 84 35").await?;
    said.push_str(&format!("typed: {}\n", page.told().await?));
    compare("telegrams.txt", &said);
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_log_is_read_aloud() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste(LOG).await?;
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
    let page = Page::open(DESKTOP, false).await?;
    page.paste("01 10 00 C8 00 02 04 42 A4 F1 DE 8F 5E").await?;
    page.click_text(".lead a", "Edit in Build").await?;
    page.wait_for(".form input").await?;
    let said = format!("{}\n{}", page.aloud("main").await?, stops(&page, "main input").await?);
    compare("form.txt", &said);
    page.close().await
}
