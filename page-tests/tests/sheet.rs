//! What Decode shows, for paper and as files.

use page_tests::{DESKTOP, Page, Result};
use serde_json::{Value, json};

const LOG: &str = "01 03 00 C8 00 03 84 35\n01 03 06 00 80 42 F6 E9 79 5A 93\n\
                   01 03 00 D7 00 03 B5 F3\n01 03 06 00 08 42 A4 F1 DE B0 F8\nhello";

#[tokio::test(flavor = "multi_thread")]
async fn the_telegrams_of_decode_are_on_the_sheet_and_in_files() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.one("#device option[value=memograph-rsg45]").await?.click().await?;
    page.paste(LOG).await?;
    page.click("a[href='sheet.html']").await?;
    page.until(".telegram h2", "Unit 1 answers: Universal channel 1 = 123.456, good.").await?;
    assert_eq!(page.count(".telegram").await?, 4);
    page.until(".causes li", "The digits of byte 4 are swapped: 08h for 80h").await?;
    page.enter("heading", "Dairy, line 2").await?;
    assert_eq!(page.text("#plant").await?, "Dairy, line 2");
    page.picture("sheet-desktop-light").await?;

    let read = |file| std::fs::read_to_string(file);
    let lines = read(page.saved("[data-save='telegrams.jsonl']").await?)?;
    let lines: Vec<Value> = lines.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    assert_eq!(lines.len(), 5);
    assert_eq!(lines[1]["device"][0]["value"], json!(123.456));
    assert_eq!(lines[4]["summary"]["check_failed"], json!(1));
    let table = read(page.saved("[data-save='telegrams.csv']").await?)?;
    assert_eq!(table.lines().count(), 5);
    let text = read(page.saved("[data-save='telegrams.txt']").await?)?;
    assert!(text.contains("4. Modbus RTU response to 3") && text.contains("Perhaps: "), "{text}");
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn only_the_sheet_is_printed() -> Result {
    let page = Page::open_at("sheet.html#text=01+03+00+C8+00+03+84+35", DESKTOP, true).await?;
    page.until(".telegram h2", "Ask unit 1").await?;
    page.driver.cdp().send_raw("Emulation.setEmulatedMedia", json!({ "media": "print" })).await?;
    page.settle().await?;
    let seen = "return ['.top', '.exports', '.sheet', '.toast'].map((css) => document.querySelector(css).offsetHeight > 0)";
    assert_eq!(page.value(seen).await?, json!([false, false, true, false]));
    let ground = "return getComputedStyle(document.querySelector('.sheet')).color";
    assert_eq!(page.value(ground).await?, json!("rgb(24, 34, 48)"), "dark on white, whatever the theme");
    page.picture("sheet-print").await?;
    page.close().await
}
