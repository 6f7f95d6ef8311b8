//! Telegrams are built in a browser, and read again.

use page_tests::{DESKTOP, PHONE, Page, Result};
use serde_json::json;

/// The bytes that the strip shows.
async fn built(page: &Page) -> Result<String> {
    page.settle().await?;
    let cells = "return [...document.querySelectorAll('.strip [data-at]')].map((cell) => \
                 cell.textContent.slice(0, 2)).join(' ')";
    Ok(page.value(cells).await?.as_str().unwrap_or_default().to_owned())
}

#[tokio::test(flavor = "multi_thread")]
async fn a_channel_is_written_in_the_words_of_the_manual() -> Result {
    let page = Page::open_at("build.html", DESKTOP, false).await?;
    page.one("#device option[value=memograph-rsg45]").await?.click().await?;
    page.one("#find").await?.send_keys("215 write").await?;
    page.click("[data-offer='0']").await?;
    for (entry, text) in [("number", "6"), ("content.status", "good"), ("content.value", "123.456")] {
        page.enter(entry, text).await?;
    }
    // Section 2.6.1 of the manual prints these bytes.
    assert_eq!(built(&page).await?, "01 10 00 D7 00 03 06 00 80 42 F6 E9 79 28 15");
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.picture("build-desktop-light").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn what_does_not_fit_is_said_beside_it_and_kept() -> Result {
    let page = Page::open_at("build.html", PHONE, true).await?;
    let right = built(&page).await?;
    page.enter("quantity", "many").await?;
    assert_eq!(built(&page).await?, right);
    assert!(page.text("[id='quantity!']").await?.contains("“many” is not a number"));
    assert_eq!(page.value("return document.getElementById('quantity').value").await?, json!("many"));
    page.picture("build-phone-dark").await?;
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.enter("quantity", "0x10").await?;
    assert_eq!(page.text("[id='quantity!']").await?, "");
    assert_eq!(built(&page).await?, "01 01 00 00 00 10 3D C6");
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn lists_grow_and_another_protocol_carries_the_same() -> Result {
    let page = Page::open_at("build.html", DESKTOP, true).await?;
    page.one("#find").await?.send_keys("16 request").await?;
    page.click("[data-offer='0']").await?;
    page.click("[data-add]").await?;
    page.enter("values.1.value", "0x1234").await?;
    page.one("#protocol option[value=modbus-tcp]").await?.click().await?;
    assert_eq!(built(&page).await?, "00 01 00 00 00 0B 01 10 00 00 00 02 04 00 00 12 34");
    page.click("[data-remove='0']").await?;
    assert_eq!(built(&page).await?, "00 01 00 00 00 09 01 10 00 00 00 01 02 12 34");
    page.close().await
}
