//! Protocols and devices: told, chosen, explained.

use buslens::tool::{PROFILES, PROTOCOLS};
use page_tests::{DESKTOP, PHONE, Page, Result};

const TCP: &str = "00 01 00 00 00 06 FF 03 00 C8 00 03";
const CHANNEL: &str = "52 00 23 00 00 0B 00 00\n00 00 00 00 00 00 00 00\n\
                       52 00 23 00 00 0B 00 00\nC2 00 23 00 08 00 00 30";

#[tokio::test(flavor = "multi_thread")]
async fn every_protocol_and_device_is_offered() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    for protocol in PROTOCOLS {
        assert_eq!(page.count(&format!("#protocol option[value={}]", protocol.key)).await?, 1);
    }
    for profile in PROFILES {
        assert_eq!(page.count(&format!("#device option[value={}]", profile.key)).await?, 1);
    }
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn the_protocol_is_told_and_can_be_chosen() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste(TCP).await?;
    assert!(page.text(".detail .title").await?.contains("Modbus TCP request"));
    assert!(page.text(".detail").await?.contains("it begins with a Modbus TCP header"));
    assert_eq!(page.text("div.check h3").await?, "No check of its own");
    page.one("#protocol option[value=modbus-rtu]").await?.click().await?;
    page.settle().await?;
    assert!(page.text(".detail .title").await?.contains("Modbus RTU"));
    assert!(page.text(".detail").await?.contains("Modbus RTU: set by hand"));
    // What was chosen stays for what is pasted next, and can be taken back.
    page.one("#protocol option[value='']").await?.click().await?;
    page.settle().await?;
    assert!(page.text(".detail .title").await?.contains("Modbus TCP request"));
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_device_gives_registers_their_names() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste("01 03 00 C8 00 03 84 35\n01 03 06 00 80 42 A4 F1 DE B0 F8").await?;
    page.choose(1).await?;
    assert!(!page.one("h3.device").await?.is_displayed().await?);
    page.one("#device option[value=memograph-rsg45]").await?.click().await?;
    page.settle().await?;
    assert_eq!(page.text(".detail h2").await?, "Unit 1 answers: Universal channel 1 = 82.4724, good.");
    assert_eq!(page.text("h3.device").await?, "Endress+Hauser Memograph M RSG45");
    // The bits of the status are behind its row.
    assert_eq!(page.count("h3.device + table tr:not([hidden]) .field").await?, 3);
    page.click("h3.device + table [data-depth='1'] button.group").await?;
    assert!(page.count("h3.device + table tr:not([hidden]) .field").await? > 10);
    page.picture("device-desktop").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn jobs_are_followed() -> Result {
    let page = Page::open(PHONE, true).await?;
    page.paste(CHANNEL).await?;
    page.one("#device option[value=keb-f5-profibus]").await?.click().await?;
    page.settle().await?;
    page.choose(1).await?;
    assert!(page.text(".detail h2").await?.starts_with("Job 1 is still running"));
    page.choose(3).await?;
    let said = page.text(".detail h2").await?;
    assert!(said.starts_with("Job 1 failed") && said.contains("value out of range"), "{said}");
    page.picture("jobs-phone-dark").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_chosen_register_is_seen_in_every_view() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste("01 03 06 00 80 42 A4 F1 DE B0 F8").await?;
    page.click("#views summary").await?;
    assert!(page.text("#views").await?.contains("Choose a register"));
    page.click(".strip [data-at='5']").await?;
    page.settle().await?;
    let views = page.texts("#views td").await?;
    for expected in ["17060", "42A4h", "0100 0010 1010 0100", "82.4724"] {
        assert!(views.iter().any(|view| view == expected), "{expected} in {views:?}");
    }
    // Another telegram has nothing chosen.
    page.paste("01 03 00 C8 00 03 84 35").await?;
    assert!(page.one("#views").await?.attr("hidden").await?.is_some());
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn the_display_of_a_device_is_explained() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.one("#device option[value=keb-f5-profibus]").await?.click().await?;
    page.paste("t_out").await?;
    assert!(page.text(".remarks").await?.contains("control board does not answer"));
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn what_was_typed_and_chosen_survives_a_reload() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste("01 03 00 C8 00 03 84 35\n01 03 06 00 80 42 A4 F1 DE B0 F8").await?;
    page.one("#device option[value=memograph-rsg45]").await?.click().await?;
    page.settle().await?;
    page.driver.refresh().await?;
    page.one("#telegram-1").await?;
    page.choose(1).await?;
    assert_eq!(page.text(".detail h2").await?, "Unit 1 answers: Universal channel 1 = 82.4724, good.");
    assert_eq!(page.value("return document.getElementById('device').value").await?, "memograph-rsg45");
    page.paste("").await?;
    page.driver.refresh().await?;
    assert_eq!(page.text(".welcome h2").await?, "What does this telegram say?");
    page.close().await
}
