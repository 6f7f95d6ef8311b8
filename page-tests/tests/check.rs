//! A check is followed step by step, forwards and back.

use page_tests::{DESKTOP, PHONE, Page, Result};
use serde_json::json;
use thirtyfour::prelude::*;

#[tokio::test(flavor = "multi_thread")]
async fn a_crc_is_followed_from_a_telegram() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste("01 03 00 C8 00 03 84 35").await?;
    page.click("div.check a").await?;
    page.until(".stepper h2", "The register starts with FFFFh.").await?;
    assert_eq!(
        page.value("return document.getElementById('bytes').value").await?,
        json!("01 03 00 C8 00 03")
    );
    page.click("[data-to=forward]").await?;
    page.until(".stepper h2", "Byte 0, 01h, is XORed").await?;
    page.click("[data-to=forward]").await?;
    page.until(".stepper h2", "A 0 falls out").await?;
    let here = page.texts(".register td").await?;
    page.click("[data-to=forward]").await?;
    page.click("[data-to=back]").await?;
    assert_eq!(page.texts(".register td").await?, here, "back is where it was");
    page.picture("check-desktop-light").await?;
    page.click("[data-to=byte]").await?;
    page.until(".stepper .title", "Step 9 of 54").await?;
    page.click("[data-to=last]").await?;
    assert_eq!(page.text(".check h3").await?, "The check is 3584h");
    assert!(page.text(".check p").await?.contains("84 35"));
    assert_eq!(page.accessibility().await?, [""; 0]);
    // A link leads to the same step.
    let link = page.fragment().await?;
    page.go(&format!("check.html{link}")).await?;
    page.until(".check h3", "The check is 3584h").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn sums_and_the_keyboard() -> Result {
    let page = Page::open_at("check.html", PHONE, true).await?;
    page.one("#kind option[value=lrc]").await?.click().await?;
    page.enter("bytes", "02 03 00 C8 00 05").await?;
    page.driver.execute("document.getElementById('at').focus()", vec![]).await?;
    page.press(Key::End + "").await?;
    page.until(".check h3", "The check is 2Eh").await?;
    page.press(Key::Left + "").await?;
    page.until(".stepper h2", "Byte 5, 05h, is added").await?;
    page.enter("bytes", "").await?;
    page.until(".stepper", "There is no byte yet").await?;
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.picture("check-phone-dark").await?;
    page.close().await
}
