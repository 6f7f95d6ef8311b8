//! Telegrams are found, filled in, answered, and read again.

use buslens::tool::offers;
use page_tests::{DESKTOP, PHONE, Page, Result, chromium_only};
use serde_json::json;
use thirtyfour::prelude::*;

const REQUEST: &str = ".side[aria-label=Request]";
const REPLY: &str = ".side[aria-label=Reply]";
const SEARCH: &str = "What do you want to do? A name, a function code, an address";

/// Finds something and opens its form. A hit of a sentence says its telegram; it is the first one then.
async fn find(page: &Page, text: &str, label: &str) -> Result {
    page.fill_in(SEARCH, text).await?;
    let script = "const hits = [...document.querySelectorAll('.finder [role=option]')]; \
                  const hit = hits.find((hit) => hit.querySelector('b').textContent == arguments[0]) ?? hits[0]; \
                  if (!hit) throw new Error(`${arguments[0]} is not found`); hit.click()";
    page.driver.execute(script, vec![json!(label)]).await?;
    page.settle().await?;
    assert_eq!(page.text(".making h3").await?, label);
    Ok(())
}

#[tokio::test(flavor = "multi_thread")]
async fn a_channel_is_written_in_the_words_of_the_manual() -> Result {
    let page = Page::open_at("#/build", DESKTOP, false).await?;
    find(&page, "215 write", "Write Universal channel at 200 to 319").await?;
    page.fill_in("Number", "6").await?;
    page.tick_option("Good").await?;
    page.fill_in("Value", "123.456").await?;
    // Section 2.6.1 of the manual prints these bytes.
    assert_eq!(page.bytes_in(REQUEST).await?, "01 10 00 D7 00 03 06 00 80 42 F6 E9 79 28 15");
    assert_eq!(page.bytes_in(REPLY).await?, "01 10 00 D7 00 03 30 30");
    assert_eq!(
        page.text(&format!("{REQUEST} .said")).await?,
        "Write to unit 1: Universal channel 6 = 123.456, good."
    );
    // The reply is in the device's words, too.
    assert!(page.text(&format!("{REPLY} .said")).await?.contains("Universal channel 6"));
    // The field that is typed in lights up its bytes.
    assert_eq!(page.text(&format!("{REQUEST} .byte-strip .chosen .label")).await?, "Value");
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.picture("build-desktop-light").await?;
    page.close().await
}

/// A sentence is found as what it means, filled in.
#[tokio::test(flavor = "multi_thread")]
async fn a_sentence_is_enough() -> Result {
    let page = Page::open_at("#/build", DESKTOP, false).await?;
    page.fill_in(SEARCH, "write 123.456 good to channel 6").await?;
    page.press(Key::Enter + "").await?;
    page.settle().await?;
    assert_eq!(page.bytes_in(REQUEST).await?, "01 10 00 D7 00 03 06 00 80 42 F6 E9 79 28 15");
    assert_eq!(
        (page.holds("Number").await?, page.holds("Value").await?),
        ("6".to_owned(), "123.456".to_owned())
    );
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn the_search_goes_by_keyboard() -> Result {
    let page = Page::open_at("#/build", DESKTOP, false).await?;
    page.fill_in(SEARCH, "write single").await?;
    let marked = ".finder [role=option][aria-selected=true] b";
    let first = page.text(marked).await?;
    page.press(Key::Down + "").await?;
    page.settle().await?;
    let second = page.text(marked).await?;
    assert_ne!(first, second);
    assert_eq!(page.accessibility().await?, [""; 0], "with its list open");
    page.press(Key::Up + "").await?;
    page.press(Key::Escape + "").await?;
    page.settle().await?;
    assert!(!page.one(".finder [role=listbox]").await?.is_displayed().await?, "Escape closes the list");
    page.press(Key::Down + Key::Enter).await?;
    page.until(".making h3", &first).await?;
    // What was found is filled in next.
    page.settle().await?;
    let focus = page.value("return document.activeElement.closest('.making') != null").await?;
    assert_eq!(focus, json!(true));
    page.fill_in(SEARCH, "no such thing").await?;
    page.until(".finder .nothing", "No match.").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn what_does_not_fit_is_said_beside_it_and_kept() -> Result {
    let page = Page::open_at("#/build", PHONE, true).await?;
    find(&page, "read coils", "Read coils, request").await?;
    let right = page.bytes_in(".dock").await?;
    page.fill_in("Quantity", "many").await?;
    assert_eq!(page.bytes_in(".dock").await?, right);
    assert!(page.about("Quantity").await?.contains("“many” is not a number"));
    assert_eq!(page.holds("Quantity").await?, "many");
    page.picture("build-phone-dark").await?;
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.fill_in("Quantity", "5000").await?;
    assert!(page.about("Quantity").await?.contains("Allowed: 1 to 2000."));
    page.fill_in("Quantity", "0x10").await?;
    assert!(!page.about("Quantity").await?.contains("Allowed"));
    assert_eq!(page.bytes_in(".dock").await?, "01 01 00 00 00 10 3D C6");
    // The bytes are in sight while somebody types.
    let dock = "const box = document.querySelector('.dock').getBoundingClientRect(); \
                return box.top > 0 && box.bottom <= innerHeight";
    assert_eq!(page.value(dock).await?, json!(true));
    page.close().await
}

/// What cannot be asked for is said at its field; the last good telegram stays, greyed.
#[tokio::test(flavor = "multi_thread")]
async fn the_last_good_telegram_stays() -> Result {
    let page = Page::open_at("#/build", DESKTOP, false).await?;
    find(&page, "read universal", "Read Universal channel at 200 to 319").await?;
    page.fill_in("Number", "9").await?;
    let good = page.bytes_in(REQUEST).await?;
    page.fill_in("Number", "99").await?;
    assert!(page.about("Number").await?.contains("99 does not exist"), "{}", page.about("Number").await?);
    assert_eq!(page.bytes_in(REQUEST).await?, good);
    assert_eq!(page.count(&format!("{REQUEST}.stale")).await?, 1);
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.fill_in("Number", "1").await?;
    assert_eq!(page.count(".stale").await?, 0);
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn lists_grow_and_another_protocol_carries_the_same() -> Result {
    let page = Page::open_at("#/build", DESKTOP, true).await?;
    find(&page, "16 request", "Write multiple registers, request").await?;
    page.press_button("Add one").await?;
    page.fill_in("Register 1", "0x1234").await?;
    page.choose_in("Protocol", "Modbus TCP").await?;
    assert_eq!(page.bytes_in(REQUEST).await?, "00 01 00 00 00 0B 01 10 00 00 00 02 04 00 00 12 34");
    page.press_button("Remove number 1").await?;
    assert_eq!(page.bytes_in(REQUEST).await?, "00 01 00 00 00 09 01 10 00 00 00 01 02 12 34");
    // What does not carry it says so, and everything stays.
    page.choose_in("Protocol", "PROFIBUS").await?;
    page.until(".making > .misfit", "does not carry").await?;
    assert_eq!(page.count(".stale").await?, 0, "the telegram is as it was");
    assert_eq!(page.bytes_in(REQUEST).await?, "00 01 00 00 00 09 01 10 00 00 00 01 02 12 34");
    page.close().await
}

/// The check is shown and typed as it is on the wire, and a broken telegram says what is wrong with it.
#[tokio::test(flavor = "multi_thread")]
async fn a_check_is_broken_on_purpose() -> Result {
    let page = Page::open_at("#/build?text=01+03+00+C8+00+03+84+35", DESKTOP, false).await?;
    page.until(".making h3", "Read holding registers, request").await?;
    let placeholder = page.one(".entry.role-check input").await?.attr("placeholder").await?;
    assert_eq!(placeholder.as_deref(), Some("84 35, computed"));
    page.fill_in("CRC", "12 34").await?;
    assert_eq!(page.holds("CRC").await?, "12 34");
    assert!(page.bytes_in(REQUEST).await?.ends_with("12 34"));
    page.until(&format!("{REQUEST} .problems"), "CRC is wrong").await?;
    page.fill_in("CRC", "12").await?;
    assert!(page.about("CRC").await?.contains("not 2 bytes in hex"));
    page.fill_in("CRC", "").await?;
    assert!(page.bytes_in(REQUEST).await?.ends_with("84 35"));
    page.close().await
}

/// Every telegram of the registries opens as a form whose bytes are read as the same, without an error.
#[tokio::test(flavor = "multi_thread")]
async fn each_kind_is_built_and_read_again() -> Result {
    let page = Page::open_at("#/build", DESKTOP, false).await?;
    page.one(".finder input").await?;
    let labels: Vec<String> = offers(None).iter().map(|offer| offer.label().sentence()).collect();
    assert!(labels.len() > 50, "{}", labels.len());
    let script = "const [labels, done] = arguments; const built = []; \
        const next = () => new Promise((go) => requestAnimationFrame(() => setTimeout(go, 0))); \
        const field = document.querySelector('.finder input'); \
        (async () => { for (const label of labels) { field.value = label; \
          field.dispatchEvent(new Event('input', { bubbles: true })); await next(); \
          const hit = [...document.querySelectorAll('.finder [role=option]')].find((hit) => \
            hit.querySelector('b').textContent == label); if (!hit) { built.push([label, '', 0, 'not found']); continue; } \
          hit.click(); await next(); await next(); \
          const side = document.querySelector('.side'); \
          built.push([label, document.querySelector('.making h3').textContent, \
            side.querySelectorAll('.byte-strip button').length, \
            [...side.querySelectorAll('.problems .bad')].map((error) => error.textContent).join()]); } \
          done(built); })()";
    let built = page.driver.execute_async(script, vec![json!(labels)]).await?;
    let built: Vec<(String, String, usize, String)> = built.convert()?;
    assert_eq!(built.len(), labels.len());
    for (offered, opened, bytes, errors) in built {
        assert_eq!(offered, opened);
        assert!(bytes > 0, "{offered} has no bytes");
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
        page.go("#/read").await?;
        page.paste(faulty).await?;
        page.press_button("Edit in Build").await?;
        page.until(".making h3", "").await?;
        assert_eq!(page.bytes_in(".dock").await?, faulty, "in Build");
        page.press_button("Open in Read").await?;
        page.one(".editor textarea").await?;
        assert_eq!(page.input().await?, faulty, "back in Read");
    }
    page.close().await
}

/// A reply is edited beside its request, which is a click away.
#[tokio::test(flavor = "multi_thread")]
async fn what_comes_back_can_be_opened_and_changed() -> Result {
    let page = Page::open_at("#/build", DESKTOP, false).await?;
    find(&page, "read holding request", "Read holding registers, request").await?;
    page.fill_in("Quantity", "2").await?;
    let request = page.bytes_in(REQUEST).await?;
    assert_eq!(page.bytes_in(REPLY).await?, "01 03 04 00 00 00 00 FA 33");
    page.press_button("Edit the reply").await?;
    page.until(".making h3", "response").await?;
    assert_eq!(page.bytes_in(REQUEST).await?, request, "the request stays");
    page.fill_in("Register +1", "0x1234").await?;
    assert!(page.bytes_in(REPLY).await?.starts_with("01 03 04 00 00 12 34 "));
    page.press_button("Back to the request").await?;
    page.until(".making h3", "request").await?;
    assert_eq!(
        (page.bytes_in(REQUEST).await?, page.holds("Quantity").await?),
        (request.clone(), "2".to_owned())
    );
    page.fragment().await?;
    page.press_button("Edit the reply").await?;
    page.fragment().await?;
    page.driver.back().await?;
    page.until(".making h3", "request").await?;
    assert_eq!(page.bytes_in(REQUEST).await?, request);
    // The exceptions are listed, and each is read when it is chosen.
    assert!(page.texts(".exceptions code").await?.iter().any(|reply| reply == "01 83 02 C0 F1"));
    page.click(".exceptions li:nth-child(2) button").await?;
    page.settle().await?;
    assert_eq!(page.bytes_in(REPLY).await?, "01 83 02 C0 F1");
    assert!(page.text(&format!("{REPLY} .said")).await?.contains("exception 2"));
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn bytes_are_copied_in_every_format() -> Result {
    let page = Page::open_at("#/build?text=01+03+00+C8+00+03+84+35", DESKTOP, false).await?;
    page.allow_clipboard().await?;
    page.until(&format!("{REQUEST} .said"), "Ask unit 1").await?;
    page.press_button("Copy hex").await?;
    page.until(&format!("{REQUEST} .actions"), "Copied").await?;
    assert_eq!(page.clipboard().await?, "01 03 00 C8 00 03 84 35");
    let copy = async |format: &str| {
        page.press_button("Copy as").await?;
        page.press_button(format).await?;
        page.clipboard().await
    };
    for (format, text) in [
        ("Hex with spaces", "01 03 00 C8 00 03 84 35"),
        ("Hex without spaces", "010300C800038435"),
        ("C array", "uint8_t telegram[8] = { 0x01, 0x03, 0x00, 0xC8, 0x00, 0x03, 0x84, 0x35 };"),
        ("Python bytes", "telegram = b\"\\x01\\x03\\x00\\xC8\\x00\\x03\\x84\\x35\""),
        ("Rust array", "let telegram: [u8; 8] = [0x01, 0x03, 0x00, 0xC8, 0x00, 0x03, 0x84, 0x35];"),
    ] {
        assert_eq!(copy(format).await?, text);
    }
    let json: serde_json::Value = serde_json::from_str(&copy("JSON, with its fields").await?).expect("JSON");
    assert_eq!(json["start"], json!(200));
    assert_eq!(json["fields"][0]["key"], json!("unit"));
    // What stands on an ASCII line are characters.
    page.choose_in("Protocol", "Modbus ASCII").await?;
    assert_eq!(copy("Characters").await?, ":010300C8000331\r\n");
    page.close().await
}

/// "Copied" is said only where the browser did it.
#[tokio::test(flavor = "multi_thread")]
async fn a_refused_copy_is_told() -> Result {
    if chromium_only("its script has to run before the page") {
        return Ok(());
    }
    let page = Page::open_at("#/read", DESKTOP, false).await?;
    page.before_loading(
        "Object.defineProperty(navigator, 'clipboard', { value: { writeText: () => Promise.reject(new Error('no')) } }); \
         Document.prototype.execCommand = () => false;",
    )
    .await?;
    page.go("#/build").await?;
    page.press_button("Copy hex").await?;
    page.until(".toast", "does not let Buslens copy").await?;
    assert!(!page.text(&format!("{REQUEST} .actions")).await?.contains("Copied"));
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_parameter_is_changed_in_two_sets() -> Result {
    let page = Page::open_at("#/build", DESKTOP, true).await?;
    page.choose_in("Device", "KEB COMBIVERT F5 on PROFIBUS-DP").await?;
    find(&page, "write set speed", "Write Set speed (Sy.52)").await?;
    page.choose_in("Protocol", "PROFIBUS parameter channel").await?;
    page.fill_in("Sets", "0").await?;
    for set in ["Set 0", "Set 2"] {
        page.tick(set).await?;
    }
    page.fill_in("Set speed", "1500").await?;
    assert_eq!(page.bytes_in(REQUEST).await?, "52 05 20 34 05 DC 00 00");
    assert!(page.text(&format!("{REQUEST} .said")).await?.contains("Set speed (Sy.52) = 1500"));
    page.close().await
}

/// All of it without a pointer.
#[tokio::test(flavor = "multi_thread")]
async fn a_telegram_is_built_by_keyboard_alone() -> Result {
    let page = Page::open_at("#/build", DESKTOP, false).await?;
    page.one(".finder input").await?;
    page.driver.execute("document.querySelector('.finder input').focus()", vec![]).await?;
    page.press("write single register request").await?;
    page.press(Key::Enter + "").await?;
    page.until(".making h3", "Write single register, request").await?;
    page.settle().await?;
    for (label, text) in [("Unit address", "5"), ("Starting address", "3216"), ("Register", "0x0401")] {
        let mut stops = 0;
        let here = "return document.activeElement.labels?.[0]?.textContent ?? ''";
        while page.value(here).await? != json!(label) {
            page.driver.action_chain().send_keys(Key::Tab + "").perform().await?;
            stops += 1;
            assert!(stops < 40, "{label} is not reached");
        }
        let select_all =
            page.driver.action_chain().key_down(Key::Control).send_keys("a").key_up(Key::Control);
        select_all.perform().await?;
        page.press(text).await?;
    }
    assert_eq!(page.bytes_in(REQUEST).await?, "05 06 0C 90 04 01 48 33");
    page.close().await
}

/// A choice decides which fields follow: the command of a batch, the state of a coil.
#[tokio::test(flavor = "multi_thread")]
async fn choices_make_another_form() -> Result {
    let page = Page::open_at("#/build", DESKTOP, false).await?;
    find(&page, "write single coil request", "Write single coil, request").await?;
    page.choose_in("Value", "On").await?;
    assert_eq!(page.bytes_in(REQUEST).await?, "01 05 00 00 FF 00 8C 3A");
    find(&page, "start batch", "Write Batch").await?;
    page.choose_in("Function", "Start batch").await?;
    let said = page.text(&format!("{REQUEST} .said")).await?;
    assert!(said.contains("start batch"), "{said}");
    page.close().await
}

/// What was typed, right or wrong, comes back by a link and by a reload, and stays while another view is
/// shown.
#[tokio::test(flavor = "multi_thread")]
async fn what_is_built_is_not_lost() -> Result {
    let page = Page::open_at("#/build", DESKTOP, false).await?;
    find(&page, "215 write", "Write Universal channel at 200 to 319").await?;
    page.fill_in("Number", "0x6").await?;
    page.fill_in("Value", "a lot").await?;
    let link = page.fragment().await?;
    assert!(link.contains(".number=0x6") && link.contains(".content.value=a+lot"), "{link}");
    let bytes = page.bytes_in(REQUEST).await?;
    for step in ["reload", "view", "link"] {
        match step {
            "reload" => page.driver.refresh().await?,
            "view" => {
                page.view("check").await?;
                page.one(".check").await?;
                page.view("build").await?;
            }
            _ => {
                page.driver.execute("localStorage.clear()", vec![]).await?;
                page.go(&link).await?;
            }
        }
        page.until(".making h3", "Write Universal channel").await?;
        assert_eq!(page.bytes_in(REQUEST).await?, bytes, "{step}");
        assert_eq!(page.holds("Number").await?, "0x6", "{step}");
        assert!(page.about("Value").await?.contains("“a lot”"), "{step}");
    }
    page.close().await
}

/// A hit says its telegram, and what tells it from its neighbours.
#[tokio::test(flavor = "multi_thread")]
async fn a_hit_says_what_it_would_send() -> Result {
    let page = Page::open_at("#/build", DESKTOP, false).await?;
    page.fill_in(SEARCH, "write 123.456 good to channel 6").await?;
    let hits = page.texts(".finder [role=option]").await?;
    assert!(hits[0].contains("Write Universal channel 6 = 123.456, good"), "{hits:?}");
    assert!(hits[0].contains("float, registers 215 to 217, function 16"), "{hits:?}");
    assert!(hits[1].contains("double, registers 5225 to 5229"), "{hits:?}");
    page.close().await
}

/// Only what the device rejects with is offered.
#[tokio::test(flavor = "multi_thread")]
async fn exceptions_are_those_of_the_device() -> Result {
    let page = Page::open_at("#/build", DESKTOP, false).await?;
    for (sentence, last) in [("read channel 6", "Exception 4"), ("read Sy.52", "Exception 67")] {
        page.fill_in(SEARCH, sentence).await?;
        page.press(Key::Enter + "").await?;
        page.settle().await?;
        let exceptions = page.texts(".exceptions li span").await?;
        assert!(exceptions.last().is_some_and(|it| it.starts_with(last)), "{sentence}: {exceptions:?}");
        assert!(!exceptions.iter().any(|it| it.contains("gateway")), "{sentence}: {exceptions:?}");
    }
    page.close().await
}

/// What has one right value needs no number to be typed.
#[tokio::test(flavor = "multi_thread")]
async fn a_status_is_chosen_by_its_name() -> Result {
    let page = Page::open_at("#/build", DESKTOP, false).await?;
    page.fill_in(SEARCH, "write 5 to channel 1").await?;
    page.press(Key::Enter + "").await?;
    page.settle().await?;
    assert!(page.bytes_in(REQUEST).await?.contains("00 80 40 A0"));
    page.tick_option("Invalid").await?;
    assert!(!page.bytes_in(REQUEST).await?.contains("00 80 40 A0"));
    page.until(&format!("{REQUEST} .said"), "invalid").await?;
    page.close().await
}
