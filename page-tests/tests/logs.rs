//! The Logs view: a worker reads what a customer sent, the page stays quick.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;
use std::time::{Duration, Instant};

use page_tests::{DESKTOP, PHONE, Page, Result};
use serde_json::json;
use thirtyfour::prelude::*;

/// A frame with its CRC.
fn frame(body: &[u8]) -> Vec<u8> {
    let mut crc = 0xFFFF_u16;
    for byte in body {
        crc = (0..8)
            .fold(crc ^ u16::from(*byte), |crc, _| if crc & 1 == 1 { crc >> 1 ^ 0xA001 } else { crc >> 1 });
    }
    [body, &crc.to_le_bytes()].concat()
}

/// A log of `pairs` requests with their answers: unit 9 is silent for a while, one check in 500 fails.
fn log(pairs: usize) -> String {
    let mut text = String::new();
    let mut line = |millisecond: usize, word: &str, bytes: &[u8]| {
        let second = 36_000 + millisecond / 1000;
        let clock = format!(
            "{:02}:{:02}:{:02}.{:03}",
            second / 3600 % 24,
            second / 60 % 60,
            second % 60,
            millisecond % 1000
        );
        let hex: Vec<String> = bytes.iter().map(|byte| format!("{byte:02X}")).collect();
        writeln!(text, "{clock} [bus] {word}: {}", hex.join(" ")).unwrap();
    };
    for n in 0..pairs {
        let unit = if n % 3 == 2 { 9 } else { 5 };
        let time = n * 50;
        line(time, "Tx", &frame(&[unit, 3, 0, 200, 0, 3]));
        let silent = unit == 9 && (pairs / 3..pairs / 3 + pairs / 20).contains(&n);
        if !silent {
            let value = ((n as f64 / 40.0).sin() * 100.0 + 200.0) as u16;
            let [high, low] = value.to_be_bytes();
            let mut answer = frame(&[unit, 3, 6, 0, 0x80, high, low, 0, 0]);
            if n % 500 == 499 {
                answer[4] ^= 0x10;
            }
            line(time + 12 + n % 9, "Rx", &answer);
        }
    }
    text
}

/// A file with this content, which a test opens in the page.
fn file(folder: &Path, name: &str, content: &[u8]) -> String {
    let path = folder.join(name);
    std::fs::File::create(&path).and_then(|mut file| file.write_all(content)).expect("a file can be written");
    path.display().to_string()
}

/// Opens a file, and waits until it is read or refused.
async fn open(page: &Page, path: &str) -> Result<Duration> {
    let start = Instant::now();
    page.one("#file").await?.send_keys(path).await?;
    page.wait_for(".story h2, [role=alert]").await?;
    Ok(start.elapsed())
}

#[tokio::test(flavor = "multi_thread")]
async fn a_log_is_read_summed_up_and_looked_through() -> Result {
    let folder = tempfile::tempdir()?;
    for (size, name) in [(DESKTOP, "desktop"), (PHONE, "phone")] {
        for dark in [false, true] {
            let theme = if dark { "dark" } else { "light" };
            let page = Page::open_at("logs.html", size, dark).await?;
            assert_eq!(page.accessibility().await?, [""; 0], "empty, {name}, {theme}");
            page.picture(&format!("logs-empty-{name}-{theme}")).await?;
            open(&page, &file(folder.path(), "bus.log", log(2000).as_bytes())).await?;
            page.wait_for("#telegram-0[aria-selected=true]").await?;
            assert!(
                page.text(".story h2").await?.starts_with("3,967 telegrams of Modbus RTU in 3,967 lines"),
                "{}",
                page.text(".story h2").await?
            );
            let story = page.texts(".story li").await?.join("\n");
            assert!(
                story.contains("Unit 9 answered 633 of 666 requests; 33 unanswered, most between"),
                "{story}"
            );
            assert!(story.contains("failed check"), "{story}");
            // The errors one by one.
            page.click("[data-do=next]").await?;
            page.until("#detail .title", "Telegram ").await?;
            page.one("#wanted option[value=unanswered]").await?.click().await?;
            page.until("p.count", "33 of 3,967 telegrams").await?;
            page.until("#detail .kind", "Nobody answered it").await?;
            assert_eq!(page.accessibility().await?, [""; 0], "filtered, {name}, {theme}");
            page.click("[data-all]").await?;
            page.until("p.count", "3,967 telegrams").await?;
            page.picture(&format!("logs-{name}-{theme}")).await?;
            page.close().await?;
        }
    }
    Ok(())
}

/// 20 MB: what the page's thread does meanwhile is measured, and printed.
#[tokio::test(flavor = "multi_thread")]
async fn a_large_log_does_not_block_the_page() -> Result {
    let folder = tempfile::tempdir()?;
    let text = log(200_000);
    let path = file(folder.path(), "large.log", text.as_bytes());
    let page = Page::open_at("logs.html", DESKTOP, false).await?;
    page.value(
        "window.longest = 0; let last = performance.now();
         setInterval(() => { const now = performance.now(); longest = Math.max(longest, now - last); last = now; }, 1);",
    )
    .await?;
    let took = open(&page, &path).await?;
    page.wait_for("#telegram-0").await?;
    let longest = page.value("return longest").await?;
    println!(
        "{:.1} MB read in {took:?}; the page's thread was busy for {longest} ms at most",
        text.len() as f64 / 1e6
    );
    assert_eq!(page.count("[role=option]").await?, 48, "only rows in sight exist");
    // The end of the list is there, too.
    page.click("#list").await?;
    page.press(Key::End).await?;
    let last = page.value("return document.querySelector('[role=option]').ariaSetSize").await?;
    let last = last.as_str().and_then(|text| text.parse::<usize>().ok()).expect("a number") - 1;
    page.wait_for(&format!("#telegram-{last}[aria-selected=true]")).await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn each_bad_file_gets_its_word() -> Result {
    let folder = tempfile::tempdir()?;
    let page = Page::open_at("logs.html", DESKTOP, false).await?;
    for (name, content, word) in [
        ("empty.log", &b""[..], "The file is empty."),
        ("log.zip", b"PK\x03\x04rest", "ZIP archive"),
        (
            "packets.csv",
            b"\"No.\",\"Time\",\"Source\",\"Destination\"\n\"1\",\"0.0\",\"10.0.0.1\",\"10.0.0.2\"\n",
            "does not hold their bytes",
        ),
    ] {
        open(&page, &file(folder.path(), name, content)).await?;
        page.until("[role=alert]", word).await?;
    }
    // UTF-16 is read.
    let wide: Vec<u8> =
        "\u{FEFF}TX: 05 03 00 C8 00 03 85 B1\r\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    open(&page, &file(folder.path(), "wide.log", &wide)).await?;
    page.until(".story h2", "1 telegram of Modbus RTU in 1 line").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_layout_is_made_by_marking_a_line() -> Result {
    let folder = tempfile::tempdir()?;
    let page = Page::open_at("logs.html", DESKTOP, false).await?;
    // The number in front has more bytes than the telegram.
    let text = "AA0102030405060708;B;05 86 02 C3 A1\nAA0102030405060709;A;05 86 02 C3 A1\n";
    open(&page, &file(folder.path(), "odd.log", text.as_bytes())).await?;
    page.click(".marking summary").await?;
    page.click("[data-do=sample]").await?;
    page.until_value("#sample", "05 86 02").await?;
    page.value(
        "const field = document.getElementById('sample'); field.focus(); field.setSelectionRange(21, 35);",
    )
    .await?;
    page.click("[data-mark=bytes]").await?;
    page.until("#detail h2", "refuses").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn what_is_chosen_is_exported() -> Result {
    let folder = tempfile::tempdir()?;
    let page = Page::open_at("logs.html", DESKTOP, false).await?;
    open(&page, &file(folder.path(), "bus.log", log(600).as_bytes())).await?;
    page.wait_for("#telegram-0").await?;
    page.one("#wanted option[value=check-failed]").await?.click().await?;
    page.until("p.count", "1 of ").await?;
    page.wait_for("#telegram-0[aria-selected=true]").await?;
    page.one("#note").await?.send_keys("noise of the new drive").await?;
    page.until("#telegram-0 .note", "noise of the new drive").await?;
    page.click(".actions .menu summary").await?;
    let csv = std::fs::read_to_string(page.saved("[data-export=csv]").await?)?;
    assert_eq!(csv.lines().count(), 2, "{csv}");
    assert!(csv.contains(",wrong,") && csv.contains("noise of the new drive"), "{csv}");
    assert_eq!(json!(page.console().await?), json!([]));
    page.close().await
}
