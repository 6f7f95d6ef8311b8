//! The devices' settings: entered once, kept, followed by Read and Build, undone, saved and opened as a file.

use page_tests::{DESKTOP, PHONE, Page, Result, chromium_only};
use serde_json::json;
use thirtyfour::prelude::*;

const CHANGES: &str = ".changes ol";

/// Adds a parameter to the list with this title.
async fn add(page: &Page, list: &str, parameter: &str) -> Result {
    page.one(".rows .new input").await?;
    let script = "const rows = [...document.querySelectorAll('.rows')].find((rows) => \
                  rows.querySelector('h4').textContent == arguments[0]); \
                  const field = rows.querySelector('.new input'); field.focus(); field.select(); \
                  document.execCommand('insertText', false, arguments[1])";
    page.driver.execute(script, vec![json!(list), json!(parameter)]).await?;
    page.settle().await?;
    page.press(Key::Enter + "").await?;
    page.settle().await
}

/// Process data by Chk_Cfg's delivery are 4 bytes; here they are 2, low byte first.
async fn set_up(page: &Page) -> Result {
    page.fill_in("Process output bytes", "2").await?;
    page.tick("Swap process data").await?;
    add(page, "Registers you read", "status word").await
}

#[tokio::test(flavor = "multi_thread")]
async fn settings_are_kept_and_followed() -> Result {
    let page = Page::open_at("#/devices", DESKTOP, false).await?;
    page.until(".changes", "everything is at factory settings").await?;
    set_up(&page).await?;
    let said = page.text(CHANGES).await?;
    for sentence in [
        "Register 0000h reads Status word (Sy.51).",
        "Process data come low byte first.",
        "Process output data have 2 bytes.",
    ] {
        assert!(said.contains(sentence), "{sentence}: {said}");
    }
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.picture("devices-desktop-light").await?;

    let registers = "#/read?device=keb-f5-modbus&text=01+03+00+00+00+02+C4+0B";
    let process =
        "#/read?device=keb-f5-profibus&text=68+0D+0D+68+01+02+5D+01+00+00+00+00+00+00+00+34+12+A7+16";
    page.go(registers).await?;
    page.until("main h2", "Status word (Sy.51)").await?;
    page.go(process).await?;
    page.until("main h2", "1234h").await?;
    // A link takes them along.
    page.view("devices").await?;
    let link = page.fragment().await?;
    assert!(link.contains("settings="), "{link}");
    page.driver.execute("localStorage.clear()", vec![]).await?;
    page.go(&link).await?;
    page.until(CHANGES, "Register 0000h reads Status word (Sy.51).").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn parameters_are_found_by_name_and_number() -> Result {
    let page = Page::open_at("#/devices", DESKTOP, true).await?;
    for (typed, said) in [
        ("set speed", "Register 0000h reads Set speed (Sy.52)."),
        ("0033h", "Register 0001h reads Status word (Sy.51)."),
        ("op.59", "Registers 0002h and 0003h read Motorpoti ramp time (OP.59), 32 bit."),
        ("0x1234", "Register 0004h reads parameter 1234h."),
    ] {
        add(&page, "Registers you read", typed).await?;
        page.until(CHANGES, said).await?;
    }
    // The list is open while somebody types, and what fits to nothing is said and stays.
    add(&page, "Registers you write", "no such thing").await?;
    page.until(".rows .nothing", "No parameter is called so.").await?;
    assert_eq!(page.accessibility().await?, [""; 0]);
    let typed = "return document.activeElement.value";
    assert_eq!(page.value(typed).await?, json!("no such thing"));
    page.press(Key::Escape + "").await?;
    page.picture("devices-desktop-dark").await?;
    page.choose_in("Width of read register 0001h", "32 bit").await?;
    page.until(CHANGES, "Registers 0001h and 0002h read Status word (Sy.51), 32 bit.").await?;
    page.press_button("Remove read register 0000h").await?;
    page.until(CHANGES, "Registers 0000h and 0001h read Status word (Sy.51), 32 bit.").await?;
    page.close().await
}

/// Each change by itself, step by step, and all at once.
#[tokio::test(flavor = "multi_thread")]
async fn every_change_is_undone() -> Result {
    let page = Page::open_at("#/devices", DESKTOP, false).await?;
    set_up(&page).await?;
    page.press_button("Undo: Process data come low byte first").await?;
    assert!(!page.text(CHANGES).await?.contains("low byte first"));
    assert!(page.text(CHANGES).await?.contains("Status word"));
    page.press_button("Undo").await?;
    page.until(CHANGES, "low byte first").await?;
    page.press_button("Redo").await?;
    assert!(!page.text(CHANGES).await?.contains("low byte first"));
    page.press_button("Reset all").await?;
    page.until(".changes", "everything is at factory settings").await?;
    page.click(".toast .button:not(.icon-only)").await?;
    page.until(CHANGES, "Status word").await?;
    // Outside of fields the keys do the same.
    page.press_button("Reset all").await?;
    page.driver.execute("document.querySelector('.changes .button:not(:disabled)').focus()", vec![]).await?;
    page.driver.action_chain().key_down(Key::Control).send_keys("z").key_up(Key::Control).perform().await?;
    page.until(CHANGES, "Status word").await?;
    // Step by step to the start.
    for _ in 0..20 {
        if page.count(".changes .actions .button:first-child:disabled").await? > 0 {
            break;
        }
        page.press_button("Undo").await?;
    }
    page.until(".changes", "everything is at factory settings").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn settings_are_saved_and_opened_as_a_file() -> Result {
    let page = Page::open_at("#/devices", PHONE, true).await?;
    set_up(&page).await?;
    page.picture("devices-phone-dark").await?;
    page.driver.execute("document.querySelector('.changes details').scrollIntoView()", vec![]).await?;
    let file = page.saved(".changes .actions:nth-of-type(2) .button:first-child").await?;
    let text = std::fs::read_to_string(&file)?;
    assert_eq!(
        text,
        "read_mapping.entries = 1\nread_mapping.entries.0.entry = 00330101h\nprofibus = 01h\noutputs = 2\n"
    );
    page.press_button("Reset all").await?;
    let chooser = page.driver.find(By::Css(".changes input[type=file]")).await?;
    chooser.send_keys(file.display().to_string()).await?;
    page.until(".toast", "the devices are set up by it").await?;
    assert_eq!(page.holds("Process output bytes").await?, "2");
    // One that is not understood, or empty, is told, and changes nothing.
    for (content, said) in [
        ("outputs = 2\ncolour = 1\n", "“colour”"),
        ("outputs two\n", "is not like"),
        ("", "is empty. Nothing is changed."),
        (" \n", "is empty. Nothing is changed."),
    ] {
        std::fs::write(&file, content)?;
        chooser.send_keys(file.display().to_string()).await?;
        page.until(".toast", said).await?;
        assert!(page.text(CHANGES).await?.contains("Status word"), "{content:?} changes nothing");
    }
    page.fill_in("Process output bytes", "99").await?;
    assert!(page.about("Process output bytes").await?.contains("Allowed: 0 to 16"));
    page.fill_in("Process output bytes", "many").await?;
    assert!(page.about("Process output bytes").await?.contains("“many”"));
    // What does not fit outlasts a change elsewhere.
    page.tick("Swap parameter channel").await?;
    assert_eq!(page.holds("Process output bytes").await?, "many");
    page.close().await
}

/// A file that the browser cannot read is no empty file.
#[tokio::test(flavor = "multi_thread")]
async fn an_unreadable_file_changes_nothing() -> Result {
    if chromium_only("its script has to run before the page") {
        return Ok(());
    }
    let page = Page::open_at("#/read", DESKTOP, false).await?;
    page.before_loading(
        "File.prototype.text = () => Promise.reject(new DOMException('gone', 'NotFoundError'))",
    )
    .await?;
    page.go("#/devices").await?;
    set_up(&page).await?;
    let file = tempfile::NamedTempFile::new()?;
    std::fs::write(file.path(), "outputs = 8\n")?;
    let chooser = page.driver.find(By::Css(".changes input[type=file]")).await?;
    chooser.send_keys(file.path().display().to_string()).await?;
    page.until(".toast", "cannot be read").await?;
    assert!(page.text(CHANGES).await?.contains("Process output data have 2 bytes."));
    page.close().await
}

/// A browser that keeps nothing is told of.
#[tokio::test(flavor = "multi_thread")]
async fn storage_denied_or_full_is_told() -> Result {
    if chromium_only("its script has to run before the page") {
        return Ok(());
    }
    for (script, said) in [
        (
            "Object.defineProperty(window, 'localStorage', { get() { throw new DOMException('no', 'SecurityError') } })",
            "keeps nothing for this page",
        ),
        (
            "Storage.prototype.setItem = () => { throw new DOMException('no', 'QuotaExceededError') }",
            "has no room left for this page",
        ),
    ] {
        let page = Page::open_at("#/read", DESKTOP, false).await?;
        page.before_loading(script).await?;
        page.go("#/devices").await?;
        set_up(&page).await?;
        page.until(".changes [role=alert]", said).await?;
        assert!(page.text(CHANGES).await?.contains("Status word"), "it counts all the same");
        assert_eq!(page.accessibility().await?, [""; 0]);
        page.close().await?;
    }
    Ok(())
}

/// Two tabs do not overwrite each other.
#[tokio::test(flavor = "multi_thread")]
async fn another_tab_is_heard() -> Result {
    let page = Page::open_at("#/devices", DESKTOP, false).await?;
    page.one(".devices").await?;
    let first = page.driver.window().await?;
    let address = page.driver.current_url().await?.to_string();
    let second = page.driver.new_tab().await?;
    page.driver.switch_to_window(second).await?;
    page.driver.goto(address).await?;
    page.one(".devices").await?;
    page.fill_in("Process input bytes", "8").await?;
    page.driver.switch_to_window(first).await?;
    page.until(CHANGES, "Process input data have 8 bytes.").await?;
    page.fill_in("Process output bytes", "2").await?;
    page.driver.switch_to_window(page.driver.windows().await?[1].clone()).await?;
    page.until(CHANGES, "Process output data have 2 bytes.").await?;
    assert!(page.text(CHANGES).await?.contains("Process input data have 8 bytes."));
    page.close().await
}

/// The settings of a link count while it is looked at; one's own are a click away.
#[tokio::test(flavor = "multi_thread")]
async fn a_link_brings_its_own_set_up() -> Result {
    let page = Page::open_at("#/devices", DESKTOP, false).await?;
    add(&page, "Registers you read", "actual speed").await?;
    let link = page.fragment().await?;
    page.press_button("Undo").await?;
    page.fill_in("Process output bytes", "2").await?;
    page.fragment().await?;
    page.go(&link).await?;
    page.until(".borrowed", "brings its own set-up").await?;
    page.until(CHANGES, "Actual speed").await?;
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.press_button("Use mine").await?;
    page.until(CHANGES, "Process output data have 2 bytes.").await?;
    assert_eq!(page.count(".borrowed").await?, 0);
    page.go(&link).await?;
    page.until(".borrowed", "Yours is kept").await?;
    page.press_button("Keep the link’s").await?;
    page.go("#/devices").await?;
    page.until(CHANGES, "Actual speed").await?;
    assert_eq!(page.count(".borrowed").await?, 0);
    page.close().await
}

/// A line with a recorder and a drive: each unit is named once, and read in the words of its manual.
#[tokio::test(flavor = "multi_thread")]
async fn units_have_devices_of_their_own() -> Result {
    let log = "01+03+00+C8+00+03+84+35%0A01+03+06+00+80+42+A4+F1+DE+D0+2E%0A03+03+20+34+00+01+CF+E6";
    let page = Page::open_at(&format!("#/read?text={log}"), DESKTOP, false).await?;
    page.wait_for(".byte-strip").await?;
    page.view("devices").await?;
    page.until(".units", "2 units").await?;
    page.choose_in("Device of unit 3", "KEB COMBIVERT F5 on Modbus").await?;
    page.until(CHANGES, "Unit 3 is KEB COMBIVERT F5 on Modbus.").await?;
    page.choose_in("Device of unit 1", "Endress+Hauser Memograph M RSG45").await?;
    page.until(".units", "2 units, 2 devices.").await?;
    // One that Read does not show.
    page.fill_in("Another unit", "400").await?;
    page.until(".units", "A unit is a number from 1 to 247.").await?;
    page.fill_in("Another unit", "9").await?;
    page.choose_in("Device of another unit", "KEB COMBIVERT F5 on Modbus").await?;
    let focus = page.value("return document.activeElement.getAttribute('aria-label')").await?;
    assert_eq!(focus, json!("Another unit"), "the next one can be named at once");
    page.until(CHANGES, "Unit 9 is KEB COMBIVERT F5 on Modbus.").await?;
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.picture("devices-units").await?;
    page.press_button("Remove unit 9").await?;
    assert!(!page.text(CHANGES).await?.contains("Unit 9"));
    page.press_button("Undo").await?;
    page.until(CHANGES, "Unit 9").await?;
    // Read says each in its own words.
    let read = format!("#/read?text={}", log.rsplit("%0A").next().unwrap_or_default());
    page.go(&read).await?;
    page.until("main h2", "Set speed").await?;
    page.go("#/read?text=01+03+00+C8+00+03+84+35").await?;
    page.until("main h2", "Universal channel 1").await?;
    page.close().await
}

/// The log that Read shows proposes its devices; what is taken of that can be taken back.
#[tokio::test(flavor = "multi_thread")]
async fn a_log_proposes_the_devices_of_its_units() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste(include_str!("../../../src/views/read/example.log")).await?;
    page.until(".proposed", "Memograph").await?;
    page.view("devices").await?;
    page.until(".units .why", "Unit 1 reads well as Endress+Hauser Memograph M RSG45").await?;
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.press_button("Use it: unit 1 is Endress+Hauser Memograph M RSG45").await?;
    page.until(CHANGES, "Unit 1 is Endress+Hauser Memograph M RSG45.").await?;
    page.view("read").await?;
    page.until(".rows .row", "Universal channel 1").await?;
    page.view("devices").await?;
    page.press_button("Undo").await?;
    page.until(".changes", "everything is at factory settings").await?;
    page.until(".units .why", "Unit 1 reads well as").await?;
    page.close().await
}
