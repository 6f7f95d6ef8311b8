//! Telegrams are built in a browser, and read again.

use page_tests::{DESKTOP, PHONE, Page, Result};
use serde_json::json;
use thirtyfour::prelude::*;

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
    assert_eq!(page.shown().await?, "01 10 00 D7 00 03 06 00 80 42 F6 E9 79 28 15");
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.picture("build-desktop-light").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn what_does_not_fit_is_said_beside_it_and_kept() -> Result {
    let page = Page::open_at("build.html", PHONE, true).await?;
    let right = page.shown().await?;
    page.enter("quantity", "many").await?;
    assert_eq!(page.shown().await?, right);
    assert!(page.text("[id='quantity!']").await?.contains("“many” is not a number"));
    assert_eq!(page.value("return document.getElementById('quantity').value").await?, json!("many"));
    page.picture("build-phone-dark").await?;
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.enter("quantity", "0x10").await?;
    assert_eq!(page.text("[id='quantity!']").await?, "");
    assert_eq!(page.shown().await?, "01 01 00 00 00 10 3D C6");
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
    assert_eq!(page.shown().await?, "00 01 00 00 00 0B 01 10 00 00 00 02 04 00 00 12 34");
    page.click("[data-remove='0']").await?;
    assert_eq!(page.shown().await?, "00 01 00 00 00 09 01 10 00 00 00 01 02 12 34");
    page.close().await
}

/// Every telegram of the registries opens as a form whose bytes are read as the same, without an error.
#[tokio::test(flavor = "multi_thread")]
async fn each_kind_is_built_and_read_again() -> Result {
    let page = Page::open_at("build.html", DESKTOP, false).await?;
    page.one("[data-offer='0']").await?;
    let script = "const done = arguments[0]; const offers = document.querySelectorAll('[data-offer]').length; \
        const built = []; \
        const next = () => new Promise((go) => requestAnimationFrame(() => setTimeout(go, 0))); \
        (async () => { for (let at = 0; at < offers; at++) { \
          const button = document.querySelector(`[data-offer='${at}']`); const label = button.textContent; \
          button.click(); await next(); \
          built.push([label, document.querySelector('.form h2').textContent, \
            document.querySelectorAll('.strip [data-at]').length, \
            [...document.querySelectorAll('.problems .error')].map((error) => error.textContent).join()]); } \
          done(built); })()";
    let built: Vec<(String, String, usize, String)> =
        page.driver.execute_async(script, vec![]).await?.convert()?;
    assert!(built.len() > 50, "{}", built.len());
    for (offered, opened, bytes, errors) in built {
        assert_eq!(offered, opened);
        assert!(bytes > 0, "{offered} has no bytes");
        // What no device can be asked for has no right form before something is typed.
        assert_eq!(errors, "", "{offered}");
    }
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_faulty_telegram_goes_to_build_and_back_byte_for_byte() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    for faulty in [
        "01 03 06 00 08 42 A4 F1 DE B0 F8",
        "01 03 05 00 08 42 A4 F1 DE 12 34 56",
        "01 10 00 D7 00 03 06 00 80",
        "00 01 00 00 00 09 FF 03 00 C8 00 03",
        "68 0F 0E 68 01 02 5D 52 01 20 34 00 64 00 00 00 05 01 2C 9D 16",
    ] {
        page.go("").await?;
        page.paste(faulty).await?;
        let said = page.text(".detail h2").await?;
        page.click(".bar a").await?;
        page.until(".bar a", "Open in Decode").await?;
        assert_eq!(page.shown().await?, faulty, "in Build");
        page.click(".bar a").await?;
        page.until(".bar a", "Edit in Build").await?;
        assert_eq!(page.input().await?, faulty, "back in Decode");
        assert_eq!(page.text(".detail h2").await?, said);
    }
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn what_comes_back_can_be_opened_and_changed() -> Result {
    let page = Page::open_at("build.html", DESKTOP, false).await?;
    page.one("#find").await?.send_keys("read holding request").await?;
    page.click("[data-offer='0']").await?;
    page.enter("quantity", "2").await?;
    let request = page.shown().await?;
    page.fragment().await?;
    page.click(".reply").await?;
    page.until(".form h2", "response").await?;
    page.enter("values.1.value", "0x1234").await?;
    assert!(page.shown().await?.starts_with("01 03 04 00 00 12 34 "));
    page.fragment().await?;
    page.driver.back().await?;
    page.until(".form h2", "request").await?;
    assert_eq!(page.shown().await?, request);
    page.click(".replies summary").await?;
    assert!(page.texts(".reply").await?.iter().any(|reply| reply.contains("01 83 02 C0 F1")));
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn bytes_are_copied_in_every_format() -> Result {
    let page = Page::open_at("build.html#text=01+03+00+C8+00+03+84+35", DESKTOP, false).await?;
    page.allow_clipboard().await?;
    page.until(".detail h2", "Ask unit 1").await?;
    for (format, text) in [
        ("spaced", "01 03 00 C8 00 03 84 35"),
        ("plain", "010300C800038435"),
        ("c", "uint8_t telegram[8] = { 0x01, 0x03, 0x00, 0xC8, 0x00, 0x03, 0x84, 0x35 };"),
        ("python", "telegram = b\"\\x01\\x03\\x00\\xC8\\x00\\x03\\x84\\x35\""),
        ("rust", "let telegram: [u8; 8] = [0x01, 0x03, 0x00, 0xC8, 0x00, 0x03, 0x84, 0x35];"),
    ] {
        page.click(".bar .menu summary").await?;
        page.click(&format!("[data-format={format}]")).await?;
        assert_eq!(page.clipboard().await?, text);
    }
    page.click(".bar .menu summary").await?;
    page.click("[data-format=json]").await?;
    let json: serde_json::Value = serde_json::from_str(&page.clipboard().await?).expect("JSON");
    assert_eq!(json["start"], json!(200));
    assert_eq!(json["fields"][0]["key"], json!("unit"));
    // What stands on an ASCII line are characters.
    page.one("#protocol option[value=modbus-ascii]").await?.click().await?;
    for (format, text) in [
        ("characters", ":010300C8000331\r\n"),
        (
            "python",
            "telegram = b\"\\x3A\\x30\\x31\\x30\\x33\\x30\\x30\\x43\\x38\\x30\\x30\\x30\\x33\\x33\\x31\\x0D\\x0A\"",
        ),
    ] {
        page.click(".bar .menu summary").await?;
        page.click(&format!("[data-format={format}]")).await?;
        assert_eq!(page.clipboard().await?, text);
    }
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_parameter_is_changed_in_two_sets() -> Result {
    let page = Page::open_at("build.html", DESKTOP, true).await?;
    page.one("#device option[value=keb-f5-profibus]").await?.click().await?;
    page.one("#protocol option[value=profibus-parameter-channel]").await?.click().await?;
    page.one("#find").await?.send_keys("write set speed").await?;
    page.click("[data-offer='0']").await?;
    page.one("#protocol option[value=profibus-parameter-channel]").await?.click().await?;
    for bit in ["subindex#0", "subindex#2"] {
        page.click(&format!("[id='{bit}']")).await?;
    }
    page.enter("content.set_speed", "1500").await?;
    assert_eq!(page.shown().await?, "52 05 20 34 05 DC 00 00");
    assert!(page.text(".detail h2").await?.contains("Set speed (Sy.52) = 1500"));
    page.close().await
}

/// All of it without a pointer.
#[tokio::test(flavor = "multi_thread")]
async fn a_telegram_is_built_by_keyboard_alone() -> Result {
    let page = Page::open_at("build.html", DESKTOP, false).await?;
    page.one("[data-offer='0']").await?;
    page.press("/").await?;
    page.press("write single register request").await?;
    page.press(Key::Tab + Key::Enter).await?;
    page.settle().await?;
    for (entry, text) in [("unit", "5"), ("start", "3216"), ("value", "0x0401")] {
        let mut stops = 0;
        while page.value("return document.activeElement.id").await? != json!(entry) {
            page.driver.action_chain().send_keys(Key::Tab + "").perform().await?;
            stops += 1;
            assert!(stops < 40, "{entry} is not reached");
        }
        page.driver
            .action_chain()
            .key_down(Key::Control)
            .send_keys("a")
            .key_up(Key::Control)
            .perform()
            .await?;
        page.press(text).await?;
    }
    assert_eq!(page.shown().await?, "05 06 0C 90 04 01 48 33");
    page.close().await
}

/// A choice decides which fields follow: the command of a batch, the state of a coil, the function code.
#[tokio::test(flavor = "multi_thread")]
async fn choices_make_another_form() -> Result {
    let page = Page::open_at("build.html", DESKTOP, false).await?;
    page.one("#find").await?.send_keys("write single coil request").await?;
    page.click("[data-offer='0']").await?;
    page.one(".form select option[value='65280']").await?.click().await?;
    assert_eq!(page.shown().await?, "01 05 00 00 FF 00 8C 3A");
    page.one("#device option[value=memograph-rsg45]").await?.click().await?;
    page.driver.execute("const find = document.getElementById('find'); find.value = 'start batch'; find.dispatchEvent(new Event('input', { bubbles: true }))", vec![]).await?;
    page.until("[data-offer='0']", "Write Batch").await?;
    page.click("[data-offer='0']").await?;
    page.settle().await?;
    let options = page.texts(".form select option").await?;
    let start = options.iter().position(|option| option == "Start batch").expect("a command");
    page.click(&format!(".form select option:nth-child({})", start + 1)).await?;
    page.settle().await?;
    let said = page.text(".detail h2").await?;
    assert!(said.contains("start batch"), "{said}");
    page.close().await
}
