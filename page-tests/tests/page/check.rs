//! A check is worked out, compared, and followed step by step.

use page_tests::{DESKTOP, NARROW, PHONE, Page, Result};
use serde_json::json;
use thirtyfour::prelude::*;

const BYTES: &str = "Bytes to check, in hex";

#[tokio::test(flavor = "multi_thread")]
async fn a_crc_is_followed_from_a_telegram() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste("01 03 00 C8 00 03 84 35").await?;
    page.press_button("Follow it step by step").await?;
    page.until(".step h3", "The register starts with FFFFh.").await?;
    assert_eq!(page.holds(BYTES).await?, "01 03 00 C8 00 03 84 35");
    page.press_button("Step forward").await?;
    page.until(".step h3", "XOR byte 0, 01h").await?;
    page.press_button("Step forward").await?;
    page.until(".step h3", "A 0 drops out").await?;
    let here = page.text(".registers").await?;
    page.press_button("Step forward").await?;
    page.press_button("Step back").await?;
    assert_eq!(page.text(".registers").await?, here, "back is where it was");
    page.picture("check-desktop-light").await?;
    page.press_button("Next byte").await?;
    page.until(".step .note", "Step 9 of 54").await?;
    page.press_button("End").await?;
    page.until(".why", "ends at 0000h").await?;
    assert_eq!(page.accessibility().await?, [""; 0]);
    // A link leads to the same step, and so does a reload.
    let link = page.fragment().await?;
    page.driver.execute("localStorage.clear()", vec![]).await?;
    page.go(&link).await?;
    page.until(".step .note", "Step 54 of 54").await?;
    page.close().await
}

/// The result stands on top whatever step is shown, in both notations, and can be copied.
#[tokio::test(flavor = "multi_thread")]
async fn the_result_is_always_there() -> Result {
    let page = Page::open_at("#/check", DESKTOP, false).await?;
    page.allow_clipboard().await?;
    page.fill_in(BYTES, "01 03 00 C8 00 03").await?;
    assert_eq!(page.texts(".outcome dd > span").await?, ["84 35", "3584h"]);
    page.press_button("Copy 84 35").await?;
    assert_eq!(page.clipboard().await?, "84 35");
    page.fill_in(BYTES, "01 03 00 C8 00 03 84 35").await?;
    page.until(".outcome .verdict", "The CRC in these bytes is valid").await?;
    page.tick_option("are data").await?;
    page.until(".outcome .verdict", "0000h over a whole frame").await?;
    page.fill_in(BYTES, "01 03 00 C8 00 03 84 36").await?;
    page.tick_option("are the CRC").await?;
    page.until(".outcome .verdict", "84 36 is not the CRC of these bytes").await?;
    assert_eq!(page.texts(".outcome dd > span").await?, ["84 35", "3584h"]);
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn nonsense_is_refused() -> Result {
    let page = Page::open_at("#/check", NARROW, false).await?;
    page.fill_in(BYTES, "hello").await?;
    page.until(".outcome .verdict", "“hello” is no bytes").await?;
    assert_eq!(page.texts(".outcome dd > span").await?, ["–", "–"]);
    assert_eq!(page.count(".player").await?, 0);
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.fill_in(BYTES, "").await?;
    page.until(".outcome .verdict", "No bytes yet").await?;
    page.close().await
}

/// Which of the known algorithms gives what stands at the end?
#[tokio::test(flavor = "multi_thread")]
async fn algorithms_are_compared() -> Result {
    let page = Page::open_at("#/check", DESKTOP, true).await?;
    for (bytes, said) in [
        ("01 03 00 C8 00 03 84 35", "Only CRC-16/MODBUS gives the 84 35 at the end."),
        (
            "01 03 00 C8 00 03 35 84",
            "Only CRC-16/MODBUS gives the 35 84 at the end, with its two bytes swapped.",
        ),
        ("31 32 33 34 35 36 37 38 39 3D BB", "Only CRC-16/ARC gives the 3D BB at the end."),
        ("01 02 03 04 05 99", "None of these gives the bytes at the end."),
    ] {
        page.fill_in(BYTES, bytes).await?;
        page.until(".rail .note", said).await?;
    }
    page.picture("check-desktop-dark").await?;
    // One that can be followed is a click away.
    page.fill_in(BYTES, "02 03 00 C8 00 05 2E").await?;
    page.press_button("LRC").await?;
    page.until(".outcome .verdict", "The LRC in these bytes is valid").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn sums_and_the_keyboard() -> Result {
    let page = Page::open_at("#/check", PHONE, true).await?;
    page.choose_in("Algorithm", "LRC (Modbus ASCII)").await?;
    page.fill_in(BYTES, "02 03 00 C8 00 05").await?;
    page.driver.execute("document.querySelector('.player input').focus()", vec![]).await?;
    page.press(Key::End + "").await?;
    page.until(".why", "2Eh is the LRC").await?;
    page.press(Key::Left + "").await?;
    page.until(".step h3", "Add byte 5, 05h").await?;
    let spoken = page.one(".player input").await?.attr("aria-valuetext").await?;
    assert!(spoken.is_some_and(|text| text.contains("Add byte 5")));
    // The bytes are one stop, arrow keys go from byte to byte.
    page.driver.execute("document.querySelector('.byte-strip [tabindex=\"0\"]').focus()", vec![]).await?;
    page.press(Key::Home + "").await?;
    page.until(".step h3", "Add byte 0, 02h").await?;
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.picture("check-phone-dark").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn it_plays_to_the_end_by_itself() -> Result {
    let page = Page::open_at("#/check?text=01&.check=fcs&.ending=data", DESKTOP, false).await?;
    page.press_button("Play").await?;
    page.until(".step .note", "Step 1 of 1").await?;
    page.one("[aria-label=Play]").await?;
    page.press_button("Play").await?;
    page.until(".step .note", "Step 0 of 1").await?;
    page.press_button("Pause").await?;
    // Another view stops it.
    page.press_button("Play").await?;
    page.view("devices").await?;
    page.view("check").await?;
    page.one("[aria-label=Play]").await?;
    assert_eq!(page.value("return location.hash.startsWith('#/check')").await?, json!(true));
    page.close().await
}

/// More bytes than any telegram has, and other things that nobody should type.
#[tokio::test(flavor = "multi_thread")]
async fn no_input_is_too_much() -> Result {
    let page = Page::open_at("#/check", DESKTOP, false).await?;
    page.fill_in(BYTES, &"01 ".repeat(5000)).await?;
    page.until(".outcome .note", "Only the first 1000 bytes count").await?;
    for bytes in ["0", ":", ":01", "0x", "<b>", "ß", "FFFFFFFF", "01 02"] {
        page.fill_in(BYTES, bytes).await?;
        for kind in ["LRC (Modbus ASCII)", "FCS (PROFIBUS)", "CRC-16/MODBUS (Modbus RTU)"] {
            page.choose_in("Algorithm", kind).await?;
        }
    }
    assert_eq!(page.holds(BYTES).await?, "01 02");
    page.close().await
}

/// A receiver goes on over the CRC, and ends at 0000h: a click away.
#[tokio::test(flavor = "multi_thread")]
async fn a_frame_ends_at_zero_with_its_crc() -> Result {
    let page = Page::open_at("#/check", DESKTOP, false).await?;
    page.until(".worth", "ends at 0000h").await?;
    page.press_button("Show it: go on over the CRC").await?;
    page.until(".outcome", "0000h").await?;
    page.until(".verdict", "0000h over a whole frame").await?;
    page.until(".step .number", "Step 72 of 72").await?;
    // What other checks are worth is another matter.
    page.choose_in("Algorithm", "LRC (Modbus ASCII)").await?;
    page.until(".worth", "1 in 256").await?;
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.close().await
}

/// Who clicks into the field has bytes of his own: they do not end up behind the example.
#[tokio::test(flavor = "multi_thread")]
async fn the_example_makes_room() -> Result {
    let page = Page::open_at("#/check", DESKTOP, false).await?;
    page.until_value("main input", "01 03 00 C8 00 03 84 35").await?;
    page.click("main input").await?;
    page.press("01 06").await?;
    page.settle().await?;
    assert_eq!(page.one("main input").await?.value().await?.as_deref(), Some("01 06"));
    // What one typed stays, wherever one clicks.
    page.click(".check .outcome").await?;
    page.click("main input").await?;
    page.press(Key::End + " 00").await?;
    page.until_value("main input", "01 06 00").await?;
    page.close().await
}
