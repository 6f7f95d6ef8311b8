//! What is shown stands in the address: links, reloads, back and forward bring it back.

use page_tests::{DESKTOP, Page, Result};
use serde_json::json;

const PAIR: &str = "01 03 00 C8 00 03 84 35\n01 03 06 00 80 42 F6 E9 79 5A 93";

/// A text that compresses badly, as long as a day's log.
fn long(lines: u32) -> String {
    let mut noise = 1_u32;
    let mut byte = || {
        noise = noise.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        format!("{:02X}", noise >> 24)
    };
    (0..lines).map(|_| (0..8).map(|_| byte()).collect::<Vec<_>>().join(" ") + "\n").collect()
}

#[tokio::test(flavor = "multi_thread")]
async fn a_link_holds_the_whole_state() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.one("#device option[value=memograph-rsg45]").await?.click().await?;
    page.paste(PAIR).await?;
    page.choose(0).await?;
    let link = page.fragment().await?;
    assert_eq!(
        link,
        "#device=memograph-rsg45&text=01+03+00+C8+00+03+84+35%0A01+03+06+00+80+42+F6+E9+79+5A+93"
    );
    let said = page.text(".detail h2").await?;
    assert_eq!(said, "Ask unit 1 for Universal channel 1.");
    // Somebody else opens it.
    page.driver.execute("localStorage.clear()", vec![]).await?;
    page.go(&link).await?;
    page.until(".detail h2", &said).await?;
    assert_eq!(page.input().await?, PAIR);
    assert_eq!(page.value("return document.getElementById('device').value").await?, json!("memograph-rsg45"));
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn back_and_forward_go_between_what_was_chosen() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste(PAIR).await?;
    page.fragment().await?;
    page.choose(0).await?;
    page.fragment().await?;
    page.one("#protocol option[value=modbus-pdu]").await?.click().await?;
    page.fragment().await?;
    page.driver.back().await?;
    page.until(".detail .title", "Telegram 1 of 2 · Modbus RTU").await?;
    page.driver.back().await?;
    page.until(".detail .title", "Telegram 2 of 2 · Modbus RTU").await?;
    page.driver.forward().await?;
    page.driver.forward().await?;
    page.until(".detail .title", "Modbus PDU").await?;
    assert_eq!(page.input().await?, PAIR);
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_long_text_is_compressed_and_a_longer_one_is_refused() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.allow_clipboard().await?;
    let log = long(1000);
    page.fill(&log).await?;
    let link = page.fragment().await?;
    assert!(link.starts_with("#z=") && link.len() < 3 * log.len() / 4, "{} characters", link.len());
    page.click("[data-link]").await?;
    page.until("#toast", "The link is copied").await?;
    assert!(page.clipboard().await?.ends_with(&link));
    page.driver.execute("localStorage.clear()", vec![]).await?;
    page.go(&link).await?;
    page.until(".reading", "1000 telegrams").await?;
    assert_eq!(page.input().await?, log);

    let log = long(5000);
    page.fill(&log).await?;
    assert_eq!(page.fragment().await?, "");
    page.click("[data-link]").await?;
    page.until("#toast", "too long for a link").await?;
    // It survives a reload all the same.
    page.driver.refresh().await?;
    page.until(".reading", " telegrams, ").await?;
    assert_eq!(page.input().await?, log);
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_damaged_link_is_told() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    for link in ["#z=AAAA", "#z=%%%", &format!("#z={}", "A".repeat(40_000))] {
        page.go(link).await?;
        page.until("#toast", "This link is damaged").await?;
    }
    // The place in the page that the first key leads to is no link.
    page.go("#main").await?;
    page.paste(PAIR).await?;
    page.driver.execute("document.querySelector('.skip').click()", vec![]).await?;
    page.settle().await?;
    assert_eq!(page.input().await?, PAIR);
    assert_eq!(page.value("return document.activeElement.id").await?, json!("main"));
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn what_is_built_survives_a_reload() -> Result {
    let page = Page::open_at("build.html", DESKTOP, false).await?;
    page.one("#device option[value=memograph-rsg45]").await?.click().await?;
    page.one("#find").await?.send_keys("215 write").await?;
    page.click("[data-offer='0']").await?;
    page.enter("number", "0x6").await?;
    page.enter("content.value", "a lot").await?;
    let link = page.fragment().await?;
    assert!(link.contains(".number=0x6") && link.contains(".content.value=a+lot"), "{link}");
    let bytes = page.shown().await?;
    page.driver.refresh().await?;
    page.until(".form h2", "Write Universal channel").await?;
    assert_eq!(page.shown().await?, bytes);
    assert_eq!(page.value("return document.getElementById('number').value").await?, json!("0x6"));
    assert!(page.text("[id='content.value!']").await?.contains("“a lot”"));
    page.close().await
}
