//! What is shown stands in the address: links, reloads, back and forward bring it back.

use buslens::field::hex;
use buslens::walk::CRC_16_MODBUS;
use page_tests::{DESKTOP, Page, Result, VIEWS};
use serde_json::json;

const PAIR: &str = "01 03 00 C8 00 03 84 35\n01 03 06 00 80 42 F6 E9 79 5A 93";

/// A text that compresses badly, as long as a day's log.
fn long(lines: u32) -> String {
    let mut noise = 1_u32;
    let mut byte = || {
        noise = noise.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (noise >> 24) as u8
    };
    let mut line = |_| {
        let mut bytes = vec![1, 6, byte(), byte(), byte(), byte()];
        bytes.extend((CRC_16_MODBUS.wire(&bytes) as u16).to_be_bytes());
        hex(&bytes) + "\n"
    };
    (0..lines).map(&mut line).collect()
}

#[tokio::test(flavor = "multi_thread")]
async fn a_link_holds_the_whole_state() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste(PAIR).await?;
    page.read_as("Device", "memograph-rsg45").await?;
    page.choose(0).await?;
    let link = page.fragment().await?;
    assert_eq!(
        link,
        "#/read?device=memograph-rsg45&text=01+03+00+C8+00+03+84+35%0A01+03+06+00+80+42+F6+E9+79+5A+93"
    );
    let said = page.text(".lead h2").await?;
    assert_eq!(said, "Ask unit 1 for Universal channel 1.");
    // Somebody else opens it.
    page.driver.execute("localStorage.clear()", vec![]).await?;
    page.go(&link).await?;
    page.until(".lead h2", &said).await?;
    assert_eq!(page.input().await?, PAIR);
    // Links of the time when views were documents go on to work.
    page.go("#device=memograph-rsg45&text=01+03+00+C8+00+03+84+35").await?;
    page.until(".lead h2", &said).await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn back_and_forward_go_between_what_was_chosen() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste(PAIR).await?;
    page.fragment().await?;
    page.choose(0).await?;
    page.fragment().await?;
    page.read_as("Protocol", "modbus-pdu").await?;
    page.fragment().await?;
    page.driver.back().await?;
    page.until(".lead h2", "Ask unit 1").await?;
    page.driver.back().await?;
    page.until(".lead h2", "Unit 1 answers").await?;
    page.driver.forward().await?;
    page.driver.forward().await?;
    page.until(".reasons, .kind", "Modbus PDU").await?;
    assert_eq!(page.input().await?, PAIR);
    page.close().await
}

/// Nothing is lost by looking elsewhere.
#[tokio::test(flavor = "multi_thread")]
async fn what_was_put_in_outlasts_other_views() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste(PAIR).await?;
    page.fragment().await?;
    for view in VIEWS.iter().map(|view| view.trim_start_matches("#/")).filter(|view| *view != "sheet") {
        page.view(view).await?;
        page.fragment().await?;
    }
    page.view("read").await?;
    page.until(".lead h2", "Unit 1 answers").await?;
    assert_eq!(page.input().await?, PAIR);
    // Back leads through the views.
    page.fragment().await?;
    page.driver.back().await?;
    page.until(".views [aria-current]", "Learn").await?;
    page.driver.back().await?;
    page.until(".views [aria-current]", "Devices").await?;
    page.driver.back().await?;
    page.until(".views [aria-current]", "Check").await?;
    page.driver.refresh().await?;
    page.until(".views [aria-current]", "Check").await?;
    page.view("read").await?;
    page.until(".lead h2", "Unit 1 answers").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_long_text_is_compressed_and_a_longer_one_is_refused() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.allow_clipboard().await?;
    let log = long(1000);
    page.paste(&log).await?;
    let link = page.fragment().await?;
    assert!(link.starts_with("#/read?z=") && link.len() < 3 * log.len() / 4, "{} characters", link.len());
    page.click("[aria-label='Copy link']").await?;
    page.until("[role=status]", "Link copied").await?;
    assert!(page.clipboard().await?.ends_with(&link));
    page.driver.execute("localStorage.clear()", vec![]).await?;
    page.go(&link).await?;
    page.until(".file-bar, .read-as", "telegrams").await?;

    // What is too long for that stays in this browser, and is there after a reload.
    let log = long(5000);
    page.paste(&log).await?;
    page.until(".file-bar", "telegrams").await?;
    page.click("[aria-label='Copy link']").await?;
    page.until("[role=status]", "too long for a link").await?;
    page.fragment().await?;
    let said = page.text(".file-bar .soft").await?;
    page.driver.refresh().await?;
    page.until(".file-bar .soft", &said).await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_damaged_link_is_told() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    for link in ["#/read?z=AAAA", "#z=%%%", &format!("#/read?z={}", "A".repeat(40_000))] {
        page.go(link).await?;
        page.until("[role=status]", "This link is damaged").await?;
    }
    // Four kilobytes can hold megabytes.
    let bomb = page
        .driver
        .execute_async(
            "const done = arguments[0]; const stream = new Blob(['text=' + '0%0A'.repeat(4e6)]).stream() \
             .pipeThrough(new CompressionStream('deflate-raw')); new Response(stream).arrayBuffer().then((bytes) => \
             done(btoa(String.fromCharCode(...new Uint8Array(bytes))).replace(/=/g, '').replace(/[+]/g, '-').replace(/[/]/g, '_')))",
            vec![],
        )
        .await?;
    let bomb: String = bomb.convert()?;
    page.go(&format!("#/read?z={bomb}")).await?;
    page.until("[role=status]", "more than a link of Buslens").await?;
    // The place in the page that the first key leads to is no link.
    page.paste(PAIR).await?;
    page.driver.execute("document.querySelector('.skip').click()", vec![]).await?;
    page.settle().await?;
    assert_eq!(page.input().await?, PAIR);
    assert_eq!(page.value("return document.activeElement.tagName").await?, json!("MAIN"));
    page.close().await
}

/// What was typed is there again even for who went on before the address followed.
#[tokio::test(flavor = "multi_thread")]
async fn what_was_typed_last_comes_back() -> Result {
    let page = Page::open_at("#/build", DESKTOP, false).await?;
    page.one(".finder input").await?;
    page.fragment().await?;
    let typed = "const field = document.querySelector('.making .entry input'); field.focus(); field.select(); \
        document.execCommand('insertText', false, '37'); location.hash = '#/check'; return field.value";
    assert_eq!(page.value(typed).await?, json!("37"));
    page.one("main h2, .check").await?;
    page.driver.back().await?;
    page.one(".making .entry input").await?;
    page.settle().await?;
    assert_eq!(page.value("return document.querySelector('.making .entry input').value").await?, json!("37"));
    page.close().await
}
