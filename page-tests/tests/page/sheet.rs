//! What Read shows, for paper and as files.

use page_tests::{DESKTOP, PHONE, Page, Result, chromium_only};
use serde_json::{Value, json};

const LOG: &str = "01 03 00 C8 00 03 84 35\n01 03 06 00 80 42 F6 E9 79 5A 93\n\
                   01 03 00 D7 00 03 B5 F3\n01 03 06 00 08 42 A4 F1 DE B0 F8\nhello";

/// A link to the telegrams.
fn link(view: &str) -> String {
    format!("#/{view}?device=memograph-rsg45&text={}", LOG.replace(' ', "+").replace('\n', "%0A"))
}

#[tokio::test(flavor = "multi_thread")]
async fn the_telegrams_of_read_are_on_the_sheet_and_in_files() -> Result {
    let page = Page::open_at(&link("read"), DESKTOP, false).await?;
    page.until("main h2", "Universal channel").await?;
    page.driver.execute("location.hash = '#/sheet'", vec![]).await?;
    page.until(".telegram h3", "Unit 1 answers: Universal channel 1 = 123.456, good.").await?;
    assert_eq!(page.count(".paper .overview tbody tr").await?, 4);
    assert_eq!(page.count(".telegram").await?, 4);
    page.until(".causes li", "The manual prints it so in section 2.6.3").await?;
    page.until(".paper .overview", "damaged").await?;
    page.fill_in("Title", "Dairy, line 2").await?;
    assert_eq!(page.text(".paper h2").await?, "Dairy, line 2");
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.picture("sheet-desktop-light").await?;
    page.tick_option("Only what is wrong").await?;
    assert_eq!(page.count(".telegram").await?, 1);
    page.tick_option("No fields").await?;
    assert_eq!(page.count(".telegram").await?, 0);
    // It stays while another view is shown.
    page.view("read").await?;
    page.driver.execute("location.hash = '#/sheet'", vec![]).await?;
    page.until(".paper h2", "Dairy, line 2").await?;

    let save = async |label: &str| {
        page.press_button("Save as").await?;
        let at = page.texts(".tools [role=menuitem]").await?.iter().position(|it| it == label);
        let at = at.unwrap_or_else(|| panic!("no {label}"));
        let file = page.saved(&format!(".tools [role=menuitem]:nth-child({})", at + 1)).await?;
        Ok::<String, thirtyfour::prelude::WebDriverError>(std::fs::read_to_string(file)?)
    };
    let lines = save("JSON Lines").await?;
    let lines: Vec<Value> = lines.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    assert_eq!(lines.len(), 5);
    assert_eq!(lines[1]["device"][0]["value"], json!(123.456));
    assert_eq!(lines[4]["summary"]["check_failed"], json!(1));
    let table = save("CSV: a row for each telegram").await?;
    assert_eq!(table.lines().count(), 5);
    let text = save("Text: every telegram with its fields").await?;
    assert!(text.contains("4. Modbus RTU response to 3") && text.contains("Perhaps: "), "{text}");
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn only_the_sheet_is_printed() -> Result {
    if chromium_only("no other one shows how it would print") {
        return Ok(());
    }
    let page = Page::open_at(&link("sheet"), DESKTOP, true).await?;
    page.until(".telegram h3", "Ask unit 1").await?;
    page.driver.cdp().send_raw("Emulation.setEmulatedMedia", json!({ "media": "print" })).await?;
    page.settle().await?;
    let seen =
        "return ['.top', '.tools', '.paper'].map((css) => document.querySelector(css).offsetHeight > 0)";
    assert_eq!(page.value(seen).await?, json!([false, false, true]));
    let ink = "return getComputedStyle(document.querySelector('.paper h2')).color";
    assert_eq!(page.value(ink).await?, json!("rgb(21, 32, 45)"), "dark on white, whatever the theme");
    page.picture("sheet-print").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn nothing_to_print_is_said() -> Result {
    let page = Page::open_at("#/sheet", PHONE, true).await?;
    page.until(".paper", "Nothing to print yet").await?;
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.close().await
}
