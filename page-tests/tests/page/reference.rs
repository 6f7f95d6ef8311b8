//! The gallery of telegrams, and what can be looked up.

use page_tests::{DESKTOP, PHONE, Page, Result};
use serde_json::json;
use thirtyfour::prelude::*;

const SEARCH: &str = ".reference [type=search]";
/// How many telegrams the gallery shows.
const TOLD: &str = ".gallery .tools .end";
const REQUEST: &str = ".side[aria-label=Request]";

/// Types into the search of the reference, and waits for the first row to be of that name.
async fn look_up(page: &Page, text: &str, first: &str) -> Result {
    page.fill(SEARCH, text).await?;
    page.until("#found-0 .l", first).await?;
    // The address follows at the pause, and "back" leads to it.
    page.fragment().await?;
    Ok(())
}

#[tokio::test(flavor = "multi_thread")]
async fn the_telegrams_of_the_manuals_open_in_read() -> Result {
    let page = Page::open_at("#/learn?place=telegrams", DESKTOP, false).await?;
    page.until(".gallery .manual", "Memograph M RSG45").await?;
    // An exchange of the first section, in a sentence each.
    let says = page.texts(".samples .says").await?;
    assert_eq!(says[0], "Write to unit 1: Universal channel 6 = 123.456, good.");
    assert!(says[1].starts_with("Unit 1 confirms the write"), "{}", says[1]);
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.picture("gallery-desktop-light").await?;
    page.click(".samples li:nth-child(2) a").await?;
    // A response, behind its request, with its device.
    page.until(".lead h2", "Unit 1 confirms the write").await?;
    assert_eq!(page.shown().await?, "01 10 00 D7 00 03 30 30");
    page.driver.back().await?;
    page.until(".gallery h3", "Telegrams of the manuals").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_misprint_says_what_is_wrong_in_the_print() -> Result {
    let page = Page::open_at("#/learn?place=telegrams", DESKTOP, false).await?;
    page.wait_for(".gallery .tools").await?;
    page.choose_in("Kind", "Misprinted").await?;
    page.until(TOLD, "15 telegrams").await?;
    assert_eq!(page.count(".samples .slip").await?, 15);
    let slips = page.texts(".samples .slip").await?;
    assert!(slips[0].contains("The status 00 80 is printed as 00 08. Corrected:"), "{}", slips[0]);
    assert_eq!(page.fragment().await?, "#/learn?place=telegrams..misprint");
    // As printed, Read says what the manual has wrong; corrected, nothing is.
    page.click(".samples li:nth-child(1) > a").await?;
    page.until(".lead h2", "but the checksum is wrong").await?;
    page.until(".causes", "2.6.3").await?;
    page.driver.back().await?;
    page.until(TOLD, "15 telegrams").await?;
    page.click(".samples li:nth-child(1) .slip a").await?;
    page.until(".lead h2", "Universal channel 1 = 82.4724, good.").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn the_gallery_is_narrowed_by_manual_function_and_words() -> Result {
    let page = Page::open_at("#/learn?place=telegrams.keb-f5-profibus", PHONE, true).await?;
    page.until(".gallery .manual", "PROFIBUS-DP operator").await?;
    page.picture("gallery-phone-dark").await?;
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.choose_in("Of", "all manuals").await?;
    page.choose_in("Function", "101: Write 32-bit registers (KEB)").await?;
    page.until(".samples .says", "mapping entry").await?;
    page.choose_in("Function", "all").await?;
    page.fill(".gallery [type=search]", "event text").await?;
    assert_eq!(page.fragment().await?, "#/learn?place=telegrams....event+text");
    assert_eq!(page.text(TOLD).await?, "2 telegrams");
    page.fill(".gallery [type=search]", "05 10 0B D0 00 03 82").await?;
    page.settle().await?;
    assert_eq!(page.text(TOLD).await?, "1 telegram");
    page.fill(".gallery [type=search]", "no such thing").await?;
    page.until(".gallery .nothing", "No telegram is like that.").await?;
    page.click(".gallery .nothing button").await?;
    page.until(".gallery .manual", "Memograph").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn things_are_found_by_name_and_by_number() -> Result {
    let page = Page::open_at("#/learn?place=reference", DESKTOP, false).await?;
    page.until(".reference-start", "What can be typed above").await?;
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.picture("reference-desktop-light").await?;
    for (typed, first) in [
        ("set speed", "Set speed"),
        ("sy.52", "Set speed"),
        ("0x2034", "Set speed"),
        ("40216", "Universal channel 6"),
        ("mdb_protcfg", "MDB_ProtCfg"),
        ("exception 66", "parameter is write-protected"),
        ("E.bcc", "wrong checksum"),
        ("function 16", "Write multiple registers"),
    ] {
        look_up(&page, typed, first).await?;
    }
    assert_eq!(page.fragment().await?, "#/learn?place=reference....function+16");
    page.fill(SEARCH, "no such thing").await?;
    page.until(".found .nothing", "Nothing is called so").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_row_opens_build_with_a_finished_telegram() -> Result {
    let page = Page::open_at("#/learn?place=reference", DESKTOP, false).await?;
    look_up(&page, "universal channel 6", "Universal channel 6").await?;
    page.click_text("#found-0 a", "Read").await?;
    page.until(&format!("{REQUEST} .said"), "Ask unit 1 for Universal channel 6.").await?;
    assert_eq!(page.bytes_in(REQUEST).await?, "01 03 00 D7 00 03 B5 F3");
    page.driver.back().await?;
    page.until("#found-0 .l", "Universal channel 6").await?;
    // A code is filled in.
    look_up(&page, "9600 Sy.07", "9600 bit/s").await?;
    page.click_text("#found-0 a", "Write").await?;
    page.until(&format!("{REQUEST} .said"), "9600 bit/s").await?;
    assert_eq!(page.bytes_in(REQUEST).await?, "01 10 20 07 00 01 02 00 03 C6 24");
    page.close().await
}

/// The table is one stop for Tab; arrows walk in it, and the entry says all about the row.
#[tokio::test(flavor = "multi_thread")]
async fn the_table_goes_by_keyboard() -> Result {
    let page = Page::open_at("#/learn?place=reference.keb-f5-modbus.registers", DESKTOP, true).await?;
    page.wait_for(".found .row").await?;
    page.driver.execute("document.querySelector('.found').focus()", vec![]).await?;
    page.press(Key::Down + "").await?;
    page.until(".entry h3", "Mapped registers").await?;
    page.press(Key::End + "").await?;
    page.until(".entry h3", "mapping entry 99").await?;
    let in_sight = "const row = document.querySelector('.found [aria-selected=true]').getBoundingClientRect(); \
                    const list = document.querySelector('.found').getBoundingClientRect(); \
                    return row.top >= list.top && row.bottom <= list.bottom";
    page.settle().await?;
    assert_eq!(page.value(in_sight).await?, json!(true));
    // Only what is in sight is there.
    assert!(page.count(".found .rows .row").await? < 80);
    assert_eq!(page.fragment().await?, "#/learn?place=reference.keb-f5-modbus.registers.5ff9h");
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.picture("reference-table-dark").await?;
    // A reload, and back, lead to the same.
    page.driver.refresh().await?;
    page.until(".entry h3", "mapping entry 99").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn every_chapter_opens() -> Result {
    let page = Page::open_at("#/learn?place=reference", DESKTOP, false).await?;
    page.wait_for(".contents a").await?;
    let chapters = page.count(".contents a").await?;
    assert_eq!(chapters, 1 + 2 * 5);
    for chapter in 1..chapters {
        let link = format!(
            "const link = document.querySelectorAll('.contents a')[{chapter}]; link.click(); \
                            return link.getAttribute('href')"
        );
        let address = page.value(&link).await?;
        page.wait_for(".contents a[aria-current]").await?;
        assert_eq!(json!(page.fragment().await?), address);
        page.wait_for("#found-0").await?;
        let told = page.text(".reference .tools .end").await?;
        let rows: usize = told.split(' ').next().and_then(|number| number.parse().ok()).unwrap_or_default();
        assert!(rows > 10, "{address}: {told}");
    }
    page.close().await
}

/// A function on one page: request and response, byte by byte, with an example.
#[tokio::test(flavor = "multi_thread")]
async fn a_telegram_is_laid_out() -> Result {
    let page = Page::open_at("#/learn?place=reference.modbus.telegrams.16", DESKTOP, false).await?;
    page.until(".topic h3", "Write multiple registers").await?;
    let labels = page.texts(".topic .telegram:nth-of-type(1) .diagram .label").await?;
    assert_eq!(labels[..6], ["Unit", "Function", "Start", "Quantity", "Bytes", "Values"].map(str::to_owned));
    page.until(".topic .example", "For example: Write to unit 1: Universal channel 6 = 123.456, good.")
        .await?;
    assert_eq!(
        page.bytes_in(".topic .telegram:nth-of-type(1) .example").await?,
        "01 10 00 D7 00 03 06 00 80 42 F6 E9 79 28 15"
    );
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.picture("reference-telegram-light").await?;
    // Carried by TCP it has a header and no checksum.
    page.tick_option("TCP").await?;
    page.until(".topic .layout", "Transaction identifier").await?;
    page.click_text(".topic a", "Open in Build").await?;
    page.until(".making h3", "Write multiple registers").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_phone_shows_it_all() -> Result {
    let page = Page::open_at("#/learn?place=reference.memograph-rsg45.registers.215", PHONE, false).await?;
    page.until(".entry h3", "Universal channel 6").await?;
    page.until(".entry", "Register by register").await?;
    let wide = "return document.documentElement.scrollWidth <= innerWidth";
    assert_eq!(page.value(wide).await?, json!(true), "nothing is wider than the phone");
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.picture("reference-phone-light").await?;
    page.go("#/learn?place=reference.profibus.telegrams.set-parameters").await?;
    page.until(".topic h3", "Set parameters").await?;
    assert_eq!(page.value(wide).await?, json!(true), "nothing is wider than the phone");
    page.picture("reference-phone-telegram-light").await?;
    page.close().await
}
