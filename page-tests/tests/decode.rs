//! The Decode view: pasting, reading, linking bytes and fields.

use buslens::tool::examples::{EXAMPLES, Group};
use page_tests::{DESKTOP, PHONE, Page, Result};
use serde_json::json;
use thirtyfour::prelude::*;

const REQUEST: &str = "01 03 00 C8 00 03 84 35";
const ANSWER: &str = "01 03 06 00 80 42 A4 F1 DE B0 F8";
const BROKEN: &str = "01 03 06 00 08 42 A4 F1 DE B0 F8";

#[tokio::test(flavor = "multi_thread")]
async fn a_pasted_telegram_is_read() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    assert_eq!(page.text(".welcome h2").await?, "What does this telegram say?");
    page.paste(REQUEST).await?;
    assert_eq!(page.text(".detail h2").await?, "Ask unit 1 for 3 holding registers from 200.");
    assert_eq!(page.texts(".strip button").await?.join(" "), REQUEST);
    assert_eq!(
        page.texts(".fields .field").await?,
        ["Unit address", "Function code", "Starting address", "Quantity", "CRC"]
    );
    assert_eq!(page.texts(".fields td.value").await?, ["1", "3", "200", "3", "3584h"]);
    assert_eq!(page.text("div.check h3").await?, "The check is right");
    assert!(page.text(".reading").await?.contains("1 telegram, check right"));
    // Typing on changes what is said at once.
    page.press(Key::Backspace + "6").await?;
    page.settle().await?;
    assert_eq!(page.text("div.check h3").await?, "The check does not match");
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_failed_check_shows_what_may_have_happened() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste(BROKEN).await?;
    let causes = page.texts(".causes li").await?;
    assert!(causes[0].contains("The digits of byte 4 are swapped: 08h for 80h."), "{causes:?}");
    assert!(causes[0].contains("Fits by chance: 1 in "), "{causes:?}");
    page.click(".causes summary").await?;
    assert_eq!(page.texts(".causes li:first-child mark").await?, ["08", "80"]);
    let lit = page.texts(".strip .lit button").await?;
    assert!(lit.contains(&"08".to_owned()), "the difference is marked in the bytes: {lit:?}");
    page.picture("causes-desktop-light").await?;
    // Both, one beside the other.
    page.click(".causes li:first-child a").await?;
    page.until(".detail .title", "Telegram 2 of 2").await?;
    assert_eq!(page.texts(".strip button").await?.join(" "), ANSWER);
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn several_lines_are_a_list_and_answers_find_their_requests() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste(&format!("{REQUEST}\n{ANSWER}\n\n05 06 0C 90 04 01 48 33")).await?;
    assert_eq!(page.count("[role=option]").await?, 3);
    page.click("#telegram-1").await?;
    assert_eq!(
        page.text(".detail h2").await?,
        "Unit 1 answers: holding registers 200 to 202 = 128, 17060, 61918."
    );
    page.click("[data-select]").await?;
    assert_eq!(page.text("[role=option][aria-selected=true] .number").await?, "1");
    // The telegram at the cursor is the one that is shown.
    page.press(Key::Control + Key::End).await?;
    page.click("#input").await?;
    page.press(Key::Control + Key::End).await?;
    page.settle().await?;
    assert!(page.text(".detail .title").await?.starts_with("Telegram 3 of 3 · Modbus RTU telegram"));
    // Function 6 leaves open who speaks; a person can say so.
    assert!(
        page.text(".kind")
            .await?
            .contains("Request or response? In function 6, request and response look the same")
    );
    page.one("#direction option[value=response]").await?.click().await?;
    page.settle().await?;
    assert!(page.text(".detail h2").await?.starts_with("Unit 5 confirms: holding register 3216"));
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn bytes_and_fields_light_each_other_up() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste(REQUEST).await?;
    let lit = "return [[...document.querySelectorAll('.group.lit .name')].map((e) => e.textContent).join(), \
               [...document.querySelectorAll('tr.lit .field')].map((e) => e.textContent.trim()).join(), \
               [...document.querySelectorAll('.marks .lit')].map((e) => e.textContent).join(' ')]";
    let quantity = json!(["Quantity", "Quantity", "00 03"]);
    let start = json!(["Start", "Starting address", "00 C8"]);
    assert_eq!(page.value(lit).await?, json!(["", "", ""]));

    // By pointer, from either side.
    let byte = page.one(".strip .cells [data-at='5']").await?;
    page.driver.action_chain().move_to_element_center(&byte).perform().await?;
    assert_eq!(page.value(lit).await?, quantity);
    let cell = page.one("tr[data-span='2-4'] td.meaning").await?;
    page.driver.action_chain().move_to_element_center(&cell).perform().await?;
    assert_eq!(page.value(lit).await?, start);
    let title = page.one("header h1").await?;
    page.driver.action_chain().move_to_element_center(&title).perform().await?;
    assert_eq!(page.value(lit).await?, json!(["", "", ""]), "nothing is pointed at");

    // By keyboard: the arrow keys go from byte to byte, and from row to row.
    page.driver.execute("document.querySelector('.strip [tabindex=\"0\"]').focus()", vec![]).await?;
    for _ in 0..4 {
        page.press(Key::Right + "").await?;
    }
    assert_eq!(page.value(lit).await?, quantity);
    assert_eq!(page.count(".strip [tabindex='0']").await?, 1, "one stop for the tab key");
    page.press(Key::End + "").await?;
    assert_eq!(page.value(lit).await?, json!(["CRC", "CRC", "84 35"]));
    page.driver.execute("document.querySelector('.fields [tabindex=\"0\"]').focus()", vec![]).await?;
    page.press(Key::Down + Key::Down).await?;
    assert_eq!(page.value(lit).await?, start);

    // By click.
    page.click(".strip .cells [data-at='0']").await?;
    page.driver.action_chain().move_to_element_center(&title).perform().await?;
    assert_eq!(page.value(lit).await?, json!(["Unit", "Unit address", "01"]), "what is chosen stays");
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn on_a_phone_a_tap_lights_up() -> Result {
    let page = Page::open(PHONE, true).await?;
    page.paste(BROKEN).await?;
    page.click("tr[data-span='9-11'] .field").await?;
    assert_eq!(page.text(".group.lit .name").await?, "CRC");
    assert_eq!(page.texts("tr.lit .field").await?, ["CRC"]);
    page.picture("decode-phone-dark").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn groups_close_and_open() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste(ANSWER).await?;
    let rows =
        "return [...document.querySelectorAll('.fields tbody tr')].filter((row) => row.offsetHeight).length";
    assert_eq!(page.value(rows).await?, json!(8));
    page.click(".field.group").await?;
    assert_eq!(page.value(rows).await?, json!(5));
    page.press(Key::Right + "").await?;
    assert_eq!(page.value(rows).await?, json!(8));
    page.press(Key::Left + "").await?;
    assert_eq!(page.value(rows).await?, json!(5));
    page.press(Key::Down + "").await?;
    assert_eq!(page.value("return document.activeElement.textContent.trim()").await?, json!("CRC"));
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_wrong_check_is_shown() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste(&format!("{REQUEST}\n{BROKEN}")).await?;
    page.click("#telegram-1").await?;
    assert!(page.text(".reading").await?.contains("1 check failed"));
    assert_eq!(page.text("#telegram-1 .check").await?, "✗\ncheck failed");
    assert_eq!(page.text("div.check h3").await?, "The check does not match");
    let check = page.text("div.check").await?;
    assert!(check.contains("50 E7") && check.contains("Found: B0 F8"), "{check}");
    assert_eq!(
        page.texts(".problems button").await?,
        ["Error:\nCRC does not match: B0 F8 found, 50 E7 computed from the bytes before it."]
    );
    assert_eq!(page.count(".group.faulty").await?, 1);
    page.click(".problems button").await?;
    assert_eq!(page.texts("tr.lit .field").await?, ["CRC"]);
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_bad_character_is_marked_where_it_stands() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste(&format!("{REQUEST}\n01 03 é0 C8 00 03 84 35\nhello")).await?;
    let marked = "return [...document.querySelectorAll('.marks .bad')].map((mark) => mark.textContent)";
    assert_eq!(page.value(marked).await?, json!(["é", "hello"]));
    let remarks = page.texts(".remarks li").await?;
    assert_eq!(remarks.len(), 2);
    assert!(remarks[0].starts_with("Line 2, character 7 “é” is not a hex digit"), "{remarks:?}");
    // The rest of the line is read all the same.
    page.click("#telegram-1").await?;
    assert_eq!(page.texts(".strip button").await?.join(" "), "01 03 C8 00 03 84 35");
    page.click(".remarks li:first-child button").await?;
    let selected = "const input = document.getElementById('input'); \
                    return input.value.slice(input.selectionStart, input.selectionEnd)";
    assert_eq!(page.value(selected).await?, json!("é"), "the button selects it");
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn marks_stand_behind_their_text() -> Result {
    let page = Page::open(PHONE, false).await?;
    page.paste(&format!("{}\n{}", "01 03 00 C8 ".repeat(40), "zz ".repeat(3))).await?;
    let sizes = "const [a, b] = ['input', 'marks'].map((id) => document.getElementById(id)); \
                 const line = (e) => [e.clientWidth, getComputedStyle(e).font, getComputedStyle(e).padding]; \
                 const marks = document.querySelectorAll('.marks .bad'); const last = marks[marks.length - 1]; \
                 const below = a.scrollHeight - parseFloat(getComputedStyle(a).paddingBottom) - \
                 last.offsetTop - last.offsetHeight; return [line(a), line(b), Math.abs(below) < 6]";
    let sizes = page.value(sizes).await?;
    assert_eq!(sizes[0], sizes[1], "both have the same lines");
    assert_eq!(sizes[2], json!(true), "the last mark is in the last line");
    page.driver.execute("document.getElementById('input').scrollTop = 60", vec![]).await?;
    page.settle().await?;
    assert_eq!(page.value("return document.getElementById('marks').scrollTop").await?, json!(60));
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn every_example_is_shown_and_undone() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste("DE AD BE EF").await?;
    for example in EXAMPLES {
        page.click("#examples summary").await?;
        page.click(&format!("#examples [data-example={}]", example.key)).await?;
        page.settle().await?;
        assert_eq!(page.value("return document.getElementById('input').value").await?, json!(example.text));
        assert!(!page.text(".detail h2").await?.is_empty());
        let broken = page.count(".reading .error, .remarks, .problems").await? > 0
            || page.texts("[role=option]").await?.len() > 1;
        assert!(broken || example.group != Group::Broken, "{}", example.key);
        assert_eq!(page.count("#examples[open]").await?, 0, "the menu closes");
    }
    // The menu closes as well where one goes elsewhere.
    page.click("#examples summary").await?;
    assert_eq!(page.count("#examples[open]").await?, 1);
    page.press(Key::Escape + "").await?;
    assert_eq!(page.count("#examples[open]").await?, 0, "by the escape key");
    page.click("#examples summary").await?;
    page.click("#input").await?;
    assert_eq!(page.count("#examples[open]").await?, 0, "by a click elsewhere");
    // What was typed before is not lost.
    for _ in EXAMPLES {
        page.one("#input").await?.send_keys(Key::Control + "z").await?;
    }
    assert_eq!(page.value("return document.getElementById('input').value").await?, json!("DE AD BE EF"));
    page.settle().await?;
    assert!(page.text(".detail .title").await?.starts_with("Telegram 1 of 1"));
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_long_list_is_scrolled_by_keyboard() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    let text = format!("{REQUEST}\n").repeat(4000);
    page.fill(&text).await?;
    assert!(page.count("[role=option]").await? < 40, "only rows in sight exist");
    page.driver.execute("document.getElementById('list').focus()", vec![]).await?;
    page.press(Key::End + "").await?;
    page.settle().await?;
    page.settle().await?;
    assert!(page.text(".detail .title").await?.starts_with("Telegram 4000 of 4000"));
    assert_eq!(page.text("[role=option][aria-selected=true] .number").await?, "4000");
    page.press(Key::Up + Key::Up).await?;
    assert!(page.text(".detail .title").await?.starts_with("Telegram 3998 of 4000"));
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn hundred_thousand_characters_are_fine() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    for unit in ["01 03 ", "G", "0x", "{", "01 03 00 C8 00 03 84 35\n"] {
        let text = unit.repeat(100_000 / unit.len());
        page.fill(&text).await?;
        assert!(page.count(".strip button").await? <= 300);
    }
    page.paste(REQUEST).await?;
    assert_eq!(page.text("div.check h3").await?, "The check is right");
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_byte_is_explained() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.one("#device option[value=memograph-rsg45]").await?.click().await?;
    page.paste("01 03 00 C8 00 03 84 35\n01 03 06 00 80 42 F6 E9 79 5A 93").await?;
    assert!(page.text(".bar .count").await?.contains("Choose one"));
    assert!(!page.one(".byte").await?.is_displayed().await?);
    page.click("[data-at='6']").await?;
    let said = page.text(".byte").await?;
    for part in [
        "Byte 6: F6h, 246, 1111 0110",
        "Byte 2 of 2 of Register 201. It counts 246 × 1 = 246, and all of them 17142.",
        "Byte 2 of 4 of Value.",
        "2^(133 − 127) × 1.929 = 123.456",
        "Memograph M RSG45 Modbus supplement, 2.6.14",
    ] {
        assert!(said.contains(part), "{part} is not in {said}");
    }
    // The byte keeps the focus, and the arrow keys explain the next ones.
    page.press(Key::Right + "").await?;
    page.until(".byte", "Byte 7: E9h").await?;
    assert_eq!(page.value("return document.activeElement.dataset.at").await?, json!("7"));
    page.click("[data-close]").await?;
    assert!(!page.one(".byte").await?.is_displayed().await?);
    page.click("#views summary").await?;
    page.click("[data-at='5']").await?;
    page.until("#views .guess", "123.456").await?;
    assert_eq!(page.texts("#views .guess").await?, ["a float number, ABCD", "123.456"]);
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn telegrams_are_pasted_and_dropped_anywhere() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    let script = "const data = new DataTransfer(); data.setData('text', '01 03 00 C8 00 03 84 35'); \
        document.body.dispatchEvent(new ClipboardEvent('paste', { clipboardData: data, bubbles: true }))";
    page.driver.execute(script, vec![]).await?;
    page.until(".detail h2", "Ask unit 1").await?;
    let script = "const data = new DataTransfer(); data.items.add(new File(['05 06 0C 90 04 01 48 33'], 'log.txt')); \
        const drop = new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }); \
        document.querySelector('.detail').dispatchEvent(drop); return drop.defaultPrevented";
    assert_eq!(page.value(script).await?, json!(true), "the browser stays here");
    page.until(".detail h2", "unit 5").await?;
    // What was there before is one undo away.
    page.driver
        .execute("document.getElementById('input').focus(); document.execCommand('undo')", vec![])
        .await?;
    assert_eq!(page.input().await?, "01 03 00 C8 00 03 84 35");
    page.driver.execute("document.getElementById('list').focus()", vec![]).await?;
    page.press("?").await?;
    assert!(page.text("#keys").await?.contains("Arrow keys"));
    page.press(Key::Escape + "").await?;
    page.press("/").await?;
    assert_eq!(page.value("return document.activeElement.id").await?, json!("input"));
    page.close().await
}

/// From opening the page to the first telegram read, as the browser measures it.
#[tokio::test(flavor = "multi_thread")]
async fn the_first_telegram_is_read_within_a_second() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.go("#text=01+03+00+C8+00+03+84+35").await?;
    page.until(".detail h2", "Ask unit 1").await?;
    let script = "const done = arguments[0]; new PerformanceObserver((list) => done(Math.max(...list.getEntries().map((entry) => entry.startTime)))).observe({ type: 'largest-contentful-paint', buffered: true })";
    let painted: f64 = page.driver.execute_async(script, vec![]).await?.convert()?;
    println!("first telegram painted {painted:.0} ms after opening the page");
    page.close().await
}
