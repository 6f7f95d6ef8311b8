//! Read, with a telegram or a few: pasting, typing, linking bytes and fields.

use buslens::tool::PROFILES;
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
    assert_eq!(page.text(".start h2").await?, "Paste what the bus said. Read what it means.");
    page.paste(REQUEST).await?;
    assert_eq!(page.text(".lead h2").await?, "Ask unit 1 for 3 holding registers from 200.");
    assert_eq!(page.shown().await?, REQUEST);
    assert_eq!(
        page.texts(".fields tbody th").await?,
        ["Unit address", "Function code", "Starting address", "Quantity", "CRC"]
    );
    assert_eq!(page.texts(".fields td.value").await?, ["1", "3", "200", "3", "3584h"]);
    assert_eq!(page.text(".check-result .verdict").await?, "CRC is valid");
    assert!(page.text(".read-as").await?.contains("1 telegram, checksum valid"));
    assert!(page.text(".said-lines").await?.contains("Read 3 holding registers from 200"));
    // Typing on changes what is said at once.
    page.click(".editor textarea").await?;
    page.press(Key::End + Key::Backspace + "6").await?;
    page.settle().await?;
    assert_eq!(page.text(".check-result .verdict").await?, "CRC is wrong");
    assert!(page.text(".said-lines").await?.contains("damaged"));
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_failed_check_shows_what_may_have_happened() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste(BROKEN).await?;
    page.until(".causes li", "by chance").await?;
    let causes = page.texts(".causes li").await?;
    assert!(causes[0].contains("The manual prints it so in section 2.6.3"), "{causes:?}");
    assert!(causes[0].contains("1 in ") && causes[0].contains("by chance"), "the first is open: {causes:?}");
    assert_eq!(page.texts(".causes li:first-child mark").await?, ["08", "80"]);
    assert!(page.text(".check-result").await?.contains("50 E7"));
    assert_eq!(page.count(".byte-strip .faulty").await?, 1);
    page.picture("causes-desktop-light").await?;
    // A problem leads to its bytes.
    page.click(".problems button").await?;
    assert_eq!(page.texts(".fields tr.chosen th").await?, ["CRC"]);
    // Both, one beside the other.
    page.click(".causes li:first-child a").await?;
    page.until(".read-as", "2 telegrams").await?;
    assert_eq!(page.shown().await?, ANSWER);
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn answers_find_their_requests() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste(&format!("{REQUEST}\n{ANSWER}\n\n05 06 0C 90 04 01 48 33")).await?;
    assert_eq!(page.count(".said-lines li").await?, 3);
    // What somebody looks for first is the answer.
    assert_eq!(
        page.text(".lead h2").await?,
        "Unit 1 answers: holding registers 200 to 202 = 128, 17060, 61918."
    );
    page.click_text(".rail .link", "telegram 1").await?;
    assert_eq!(page.shown().await?, REQUEST);
    // The telegram at the cursor is the one that is shown.
    page.click(".editor textarea").await?;
    page.press(Key::Control + Key::End).await?;
    page.settle().await?;
    assert_eq!(page.shown().await?, "05 06 0C 90 04 01 48 33");
    // Function 6 looks the same in both directions; a person can say who speaks.
    assert!(page.text(".reasons").await?.contains("it could be a response, too"));
    page.read_as("Direction", "response").await?;
    page.until(".lead h2", "Unit 5 confirms: holding register 3216").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn bytes_and_fields_light_each_other_up() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste(REQUEST).await?;
    let lit = "const texts = (css) => [...document.querySelectorAll(css)].map((e) => e.textContent.trim()); \
               return [texts('.byte-strip :is(.pointed, .chosen) .label').join(), \
               texts('.fields :is(.pointed, .chosen) th').join(), texts('.marks .lit').join(' ')]";
    let quantity = json!(["Quantity", "Quantity", "00 03"]);
    let start = json!(["Start", "Starting address", "00 C8"]);
    assert_eq!(page.value(lit).await?, json!(["", "", ""]));

    // By pointer, from either side.
    let byte = page.one(".byte-strip li:nth-child(4) button").await?;
    page.driver.action_chain().move_to_element_center(&byte).perform().await?;
    assert_eq!(page.value(lit).await?, quantity);
    let cell = page.one(".fields tbody tr:nth-child(3) td.meaning").await?;
    page.driver.action_chain().move_to_element_center(&cell).perform().await?;
    assert_eq!(page.value(lit).await?, start);
    let title = page.one("header h1").await?;
    page.driver.action_chain().move_to_element_center(&title).perform().await?;
    assert_eq!(page.value(lit).await?, json!(["", "", ""]), "nothing is pointed at");

    // By keyboard: the arrow keys go from byte to byte, and from row to row.
    page.driver.execute("document.querySelector('.byte-strip [tabindex=\"0\"]').focus()", vec![]).await?;
    for _ in 0..4 {
        page.press(Key::Right + "").await?;
    }
    assert_eq!(page.value(lit).await?, quantity);
    assert_eq!(page.count(".byte-strip [tabindex='0']").await?, 1, "one stop for the tab key");
    page.press(Key::End + "").await?;
    assert_eq!(page.value(lit).await?, json!(["CRC", "CRC", "84 35"]));
    page.driver.execute("document.querySelector('.fields [tabindex=\"0\"]').focus()", vec![]).await?;
    page.press(Key::Home + "").await?;
    page.press(Key::Down + Key::Down).await?;
    assert_eq!(page.value(lit).await?, start);
    // What is chosen stays, and is let go of.
    page.driver.action_chain().move_to_element_center(&title).perform().await?;
    assert_eq!(page.value(lit).await?, start);
    page.press(Key::Escape + "").await?;
    assert_eq!(page.value(lit).await?, json!(["", "", ""]));
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn on_a_phone_a_tap_lights_up() -> Result {
    let page = Page::open(PHONE, true).await?;
    page.paste(BROKEN).await?;
    page.click_text(".fields th button", "CRC").await?;
    assert_eq!(page.text(".byte-strip .chosen .label").await?, "CRC");
    page.picture("read-phone-dark").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_bad_character_is_marked_where_it_stands() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste(&format!("{REQUEST}\n01 03 0G C8 00 03 84 35")).await?;
    let marked = "return [...document.querySelectorAll('.marks .bad')].map((mark) => mark.textContent)";
    assert_eq!(page.value(marked).await?, json!(["0G"]));
    let remarks = page.texts(".remarks li").await?;
    assert!(remarks[0].contains("Line 2, character 7") && remarks[0].contains("is not hex"), "{remarks:?}");
    page.click(".remarks li:first-child button").await?;
    let selected = "const input = document.querySelector('.editor textarea'); \
                    return input.value.slice(input.selectionStart, input.selectionEnd)";
    assert_eq!(page.value(selected).await?, json!("0G"), "the button selects it");
    page.close().await
}

/// Marks and what lines say stand where the text stands, also when it is wide.
#[tokio::test(flavor = "multi_thread")]
async fn marks_stand_behind_their_text() -> Result {
    for size in [DESKTOP, PHONE] {
        let page = Page::open(size, false).await?;
        page.paste(&format!("{}\n{REQUEST}\n01 03 00 C8 00 03 84 zz", "01 03 00 C8 ".repeat(20))).await?;
        let fonts = "const [a, b] = ['.written textarea', '.written .marks'].map((css) => document.querySelector(css)); \
                     const line = (e) => [e.clientWidth, getComputedStyle(e).font, getComputedStyle(e).padding, \
                     getComputedStyle(e).whiteSpace]; return [line(a), line(b)]";
        let fonts = page.value(fonts).await?;
        assert_eq!(fonts[0], fonts[1], "both have the same lines, {size:?}");
        page.close().await?;
    }
    Ok(())
}

#[tokio::test(flavor = "multi_thread")]
async fn every_example_is_shown_and_undone() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste("DE AD BE EF").await?;
    for example in EXAMPLES {
        page.click(".examples > button").await?;
        page.click_text(".examples [role=menuitem]", example.label).await?;
        if page.count(".editor textarea").await? > 0 {
            assert_eq!(page.input().await?, example.text);
            let broken = page.count(".read-as .bad, .remarks, .problems").await? > 0
                || page.count(".said-lines li").await? > 1;
            assert!(broken || example.group != Group::Broken, "{}", example.key);
        } else {
            page.click_text(".file-bar .button", "Close").await?;
        }
        assert_eq!(page.count(".examples [role=menu]").await?, 0, "the menu closes");
    }
    // The menu closes as well where one goes elsewhere.
    page.click(".examples > button").await?;
    assert_eq!(page.count(".examples [role=menu]").await?, 1);
    page.press(Key::Escape + "").await?;
    assert_eq!(page.count(".examples [role=menu]").await?, 0, "by the escape key");
    // What was typed before is not lost.
    page.paste("DE AD BE EF").await?;
    page.paste(REQUEST).await?;
    page.click_text(".toast button, [role=status] button", "Undo").await?;
    assert_eq!(page.input().await?, "DE AD BE EF");
    page.close().await
}

/// Telegrams that are cut, as they are while somebody types, with each device chosen: the page goes on.
#[tokio::test(flavor = "multi_thread")]
async fn a_telegram_can_be_typed_byte_by_byte_with_any_device() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    let telegrams = [
        ("", ":01060000057F\r\n"),
        ("", "05 10 0C 10 00 04 08 06 02 31 0A 00 00 00 00 52 34"),
        ("modbus-tcp", "00 01 00 00 00 0D 01 10 00 D7 00 03 06 00 80 42 F6 E9 79"),
        ("modbus-tcp", "00 01 00 00 00 06 01 06 00 00 00 05"),
        ("profibus-parameter-channel", "71 00 22 34 00 00 00 00"),
        ("", "68 0F 0F 68 01 02 7D 52 00 23 00 64 00 00 00 05 01 2C 9D 16"),
        ("", "01 64 20 00 00 02 00 00"),
    ];
    for profile in PROFILES {
        for (protocol, telegram) in telegrams {
            page.paste("").await?;
            page.read_as("Device", profile.key).await?;
            page.read_as("Protocol", protocol).await?;
            let script = "const [text, done] = arguments; const area = document.querySelector('.editor textarea'); \
                area.focus(); area.select(); document.execCommand('delete'); let at = 0; \
                const next = () => { if (at == text.length) return done(area.value); \
                document.execCommand('insertText', false, text[at++]); \
                for (const button of document.querySelectorAll('.byte-strip button')) if (at % 4 == 0) button.click(); \
                setTimeout(next, 0); }; next();";
            let typed = page.driver.execute_async(script, vec![json!(telegram)]).await?;
            let typed: String = typed.convert()?;
            assert_eq!(
                typed.trim_end(),
                telegram.trim_end().replace('\r', ""),
                "{}, {telegram}",
                profile.key
            );
            assert_eq!(page.count(".ended").await?, 0, "{}, {telegram}", profile.key);
            assert!(page.count(".byte-strip button, .log").await? > 0, "{}, {telegram}", profile.key);
        }
    }
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_byte_is_explained() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste("01 03 00 C8 00 03 84 35\n01 03 06 00 80 42 F6 E9 79 5A 93").await?;
    page.read_as("Device", "memograph-rsg45").await?;
    assert_eq!(page.text(".lead h2").await?, "Unit 1 answers: Universal channel 1 = 123.456, good.");
    assert_eq!(page.count(".chosen-byte").await?, 0);
    page.click(".byte-strip [aria-label^='F6, '][aria-label$=', byte 6']").await?;
    let said = page.text(".chosen-byte").await?;
    for part in [
        "Byte 6: F6h, 246, 1111 0110",
        "Byte 2 of 2 of Register 201",
        "Byte 2 of 4 of Value",
        "2^(133 − 127) × 1.929 = 123.456",
        "Memograph M RSG45 Modbus supplement, 2.6.14",
    ] {
        assert!(said.contains(part), "{part} is not in {said}");
    }
    // The byte keeps the focus, and the arrow keys explain the next ones.
    page.press(Key::Right + "").await?;
    page.until(".chosen-byte", "Byte 7: E9h").await?;
    page.click(".chosen-byte [aria-label=Close]").await?;
    assert_eq!(page.count(".chosen-byte").await?, 0);
    page.click_text(".fold summary", "All interpretations").await?;
    page.click(".byte-strip [aria-label^='42, '][aria-label$=', byte 5']").await?;
    page.until(".interpretations .guess", "123.456").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn bytes_are_copied_and_a_refusal_is_told() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.allow_clipboard().await?;
    page.paste("010306000842A4F1DEB0F8").await?;
    page.click_text(".lead .menu > button", "Copy as").await?;
    page.click_text("[role=menuitem]", "Hex with spaces").await?;
    page.until("[role=status]", "Copied.").await?;
    assert_eq!(page.clipboard().await?, BROKEN);
    page.click_text(".check-result button", "Copy with the correct checksum").await?;
    page.until(".check-result button", "Copied").await?;
    assert_eq!(page.clipboard().await?, "01 03 06 00 08 42 A4 F1 DE 50 E7");
    // Where the browser refuses, nothing is called copied.
    page.value(
        "navigator.clipboard.writeText = () => Promise.reject(new Error('refused')); document.execCommand = () => false",
    )
    .await?;
    tokio::time::sleep(std::time::Duration::from_millis(2200)).await;
    page.click_text(".check-result button", "Copy with the correct checksum").await?;
    page.until("[role=status]", "does not let Buslens copy").await?;
    assert!(!page.text(".check-result").await?.contains("Copied"));
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn keys_lead_to_the_input_and_to_their_list() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.press("?").await?;
    page.until("dialog[open]", "Arrow keys").await?;
    page.press(Key::Escape + "").await?;
    page.settle().await?;
    assert_eq!(page.count("dialog[open]").await?, 0);
    page.press("/").await?;
    assert_eq!(page.value("return document.activeElement.tagName").await?, json!("TEXTAREA"));
    page.press("01 03 00 C8 00 03 84 35").await?;
    page.settle().await?;
    assert_eq!(page.text(".check-result .verdict").await?, "CRC is valid");
    page.close().await
}
