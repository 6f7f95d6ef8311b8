//! The devices' settings: entered once, kept, followed by Decode and Build, saved and opened as a file.

use page_tests::{DESKTOP, PHONE, Page, Result};
use serde_json::json;

/// Process data by Chk_Cfg's delivery are 4 bytes; here they are 2, low byte first.
async fn set_up(page: &Page) -> Result {
    page.enter("outputs", "2").await?;
    page.click("[id='profibus#0']").await?;
    page.click("[data-path='read_mapping.entries'] [data-add]").await?;
    page.enter("read_mapping.entries.0.entry", "0x00330101").await
}

#[tokio::test(flavor = "multi_thread")]
async fn settings_are_kept_and_followed() -> Result {
    let page = Page::open_at("devices.html", DESKTOP, false).await?;
    set_up(&page).await?;
    let text = page.text(".aside pre").await?;
    assert_eq!(
        text,
        "read_mapping.entries = 1\nread_mapping.entries.0.entry = 00330101h\nprofibus = 01h\noutputs = 2"
    );
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.picture("devices-desktop-light").await?;

    page.go("").await?;
    page.one("#device option[value=keb-f5-modbus]").await?.click().await?;
    page.paste("01 03 00 00 00 02 C4 0B").await?;
    let mapped = page.text(".detail h2").await?;
    page.one("#device option[value=keb-f5-profibus]").await?.click().await?;
    page.paste("68 0D 0D 68 01 02 5D 01 00 00 00 00 00 00 00 34 12 A7 16").await?;
    let swapped = page.text(".detail h2").await?;
    assert!(mapped.contains("Status word (Sy.51)"), "{mapped}");
    assert!(swapped.contains("1234h"), "{swapped}");
    // A link takes them along.
    let link = page.fragment().await?;
    assert!(link.contains("&settings="), "{link}");
    page.driver.execute("localStorage.clear()", vec![]).await?;
    page.go(&link).await?;
    page.until(".detail h2", &swapped).await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn settings_are_saved_and_opened_as_a_file() -> Result {
    let page = Page::open_at("devices.html", PHONE, true).await?;
    set_up(&page).await?;
    let file = page.saved("#export").await?;
    page.click("#reset").await?;
    page.until(".aside", "Nothing: everything is as the devices come").await?;
    let text = std::fs::read_to_string(&file)?;
    assert!(text.contains("outputs = 2"), "{text}");
    page.one("#import").await?.send_keys(file.display().to_string()).await?;
    page.until("#toast", "the devices are set up by it").await?;
    assert_eq!(page.value("return document.getElementById('outputs').value").await?, json!("2"));
    page.picture("devices-phone-dark").await?;

    std::fs::write(&file, "outputs = 2\ncolour = 1\n")?;
    page.one("#import").await?.send_keys(file.display().to_string()).await?;
    page.until("#toast", "There is no entry “colour”").await?;
    assert!(page.text(".aside pre").await?.contains("read_mapping"), "nothing is changed");
    page.enter("outputs", "99").await?;
    assert!(page.text("[id='outputs!']").await?.contains("Allowed: 0 to 16"));
    page.close().await
}
