//! Every telegram of the library's vectors, typed character by character with each device chosen: whatever
//! stands in the input on the way, the page goes on, and its console stays empty.

use std::path::Path;

use buslens::tool::PROFILES;
use page_tests::{DESKTOP, Page, Result};
use serde_json::json;

/// Types each text, from where it differs from the one before it, and gives back the last one where the page
/// ended. What is drawn follows each key at once, before the next.
const TYPE: &str = "const [texts, done] = arguments; const area = document.querySelector('.editor textarea'); \
    area.focus(); let keys = 0; \
    const enter = async (text) => { area.value = text; area.dispatchEvent(new InputEvent('input', { bubbles: true })); \
      for (let turn = 0; turn < 12; turn++) await 0; keys++; }; \
    const type = async () => { let before = ''; \
      for (const text of texts) { let at = 0; while (at < text.length && text[at] == before[at]) at++; \
        if (at < before.length) await enter(text.slice(0, at)); \
        for (; at < text.length; at++) { await enter(text.slice(0, at + 1)); \
          if (document.querySelector('.ended')) return [keys, text.slice(0, at + 1)]; } \
        before = text; if (area.value != text) return [keys, 'lost: ' + text]; \
        await new Promise((next) => setTimeout(next, 0)); } \
      return [keys, '']; }; type().then(done, (error) => done([keys, String(error)]));";

/// Some vectors with each device, other ones with each; `--long` types all of them with all.
#[tokio::test(flavor = "multi_thread")]
async fn vectors_can_be_typed_with_every_device() -> Result {
    /// More take minutes.
    const EACH: usize = 24;
    let texts = texts();
    type_all(|device| texts.iter().skip(device * 7).step_by(texts.len() / EACH).cloned().collect()).await
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "takes minutes: `cargo xtask test page every_vector --long`"]
async fn every_vector_can_be_typed_with_every_device() -> Result {
    type_all(|_| texts()).await
}

/// No device, and each that there is.
fn devices() -> Vec<&'static str> {
    std::iter::once("").chain(PROFILES.iter().map(|profile| profile.key)).collect()
}

/// Types what `of` gives for each device, by its number.
async fn type_all(of: impl Fn(usize) -> Vec<String>) -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.driver.set_script_timeout(std::time::Duration::from_secs(110)).await?;
    page.paste("01").await?;
    let (start, mut typed) = (std::time::Instant::now(), 0);
    for (number, device) in devices().into_iter().enumerate() {
        page.read_as("Device", device).await?;
        // A driver waits two minutes for the end of a script.
        for texts in of(number).chunks(24) {
            let told = page.driver.execute_async(TYPE, vec![json!(texts)]).await?;
            let (keys, ended): (usize, String) = told.convert()?;
            typed += keys;
            assert_eq!((ended.as_str(), page.console().await?), ("", Vec::new()), "device {device:?}");
        }
    }
    println!("{typed} keys in {:.0?}", start.elapsed());
    page.close().await
}

/// The bytes of all vectors, in order, so that what begins alike is typed once.
fn texts() -> Vec<String> {
    let mut texts = Vec::new();
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates/buslens/tests/vectors")];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("the vectors") {
            let path = entry.expect("a vector").path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let text = std::fs::read_to_string(path).expect("a vector");
            let told = |key: &str| text.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix(": "));
            let before = told("before").map(|before| before.replace('|', "\n") + "\n").unwrap_or_default();
            texts.push(before + told("hex").expect("a vector has bytes"));
        }
    }
    texts.sort();
    texts.dedup();
    texts
}
