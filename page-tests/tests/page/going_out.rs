//! What goes out: the summary for a mail, the report, a capture, a log to pass on.

use page_tests::{DESKTOP, PHONE, Page, Result};

/// The example that has a little of everything: a silent unit, bytes that are swallowed, slow answers.
const LOG: &str = include_str!("../../../src/views/read/example.log");

/// Opens a file with this content.
async fn open(page: &Page, name: &str, content: &str) -> Result {
    let folder = tempfile::tempdir()?.keep();
    let path = folder.join(name);
    std::fs::write(&path, content)?;
    page.open_file(&path.display().to_string()).await?;
    page.wait_for(".rows .row").await
}

/// A kind of file of the menu with this name.
async fn saved(page: &Page, menu: &str, label: &str) -> Result<Vec<u8>> {
    page.click_text(".menu > button", menu).await?;
    let at = page.texts("[role=menuitem]").await?.iter().position(|it| it == label);
    let at = at.unwrap_or_else(|| panic!("no {label}"));
    let path = page.saved(&format!("[role=menuitem]:nth-child({})", at + 1)).await?;
    Ok(std::fs::read(path)?)
}

#[tokio::test(flavor = "multi_thread")]
async fn the_summary_of_a_log_is_copied_and_shown() -> Result {
    for (size, dark, name) in [(DESKTOP, false, "desktop-light"), (PHONE, true, "phone-dark")] {
        let page = Page::open(size, dark).await?;
        page.allow_clipboard().await?;
        // Its file is too large for the page's own thread.
        let text = LOG.repeat(20);
        open(&page, "converter.log", &text).await?;
        page.click_text(".file-bar button", "Copy summary for a mail").await?;
        page.until("dialog[open] .done", "Copied. Paste it into the mail").await?;
        for said in ["What is wrong", "XON/XOFF", "Unit 9 answered none of", "Units", "Telegrams that matter"]
        {
            page.until("dialog[open] .digest", said).await?;
        }
        assert!(page.count("dialog[open] .lines tbody tr").await? <= 10);
        assert_eq!(page.accessibility().await?, [""; 0], "{name}");
        page.picture(&format!("summary-{name}")).await?;
        let text = page.clipboard().await?;
        assert!(text.starts_with("converter.log: "), "{text}");
        assert!(
            text.contains("XON/XOFF") && text.contains("[damaged") && text.contains("01 03 06"),
            "{text}"
        );
        let html = page.clipboard_html().await?;
        assert!(html.contains("<table") && html.contains("XON/XOFF") && html.contains("01 03 06"), "{html}");
        // Without bytes it is copied again.
        page.tick("With bytes").await?;
        page.until("dialog[open] .done", "Copied").await?;
        let text = page.clipboard().await?;
        assert!(!text.contains("01 03 06") && text.contains("[damaged"), "{text}");
        page.close().await?;
    }
    Ok(())
}

#[tokio::test(flavor = "multi_thread")]
async fn a_telegram_has_a_summary_too() -> Result {
    let page =
        Page::open_at("#/sheet?device=memograph-rsg45&text=01+03+06+00+08+42+A4+F1+DE+B0+F8", DESKTOP, false);
    let page = page.await?;
    page.allow_clipboard().await?;
    page.press_button("Copy summary for a mail").await?;
    page.until("dialog[open] .done", "Copied").await?;
    assert_eq!(page.accessibility().await?, [""; 0]);
    let text = page.clipboard().await?;
    for said in ["1 telegram, Modbus RTU, Endress+Hauser Memograph M RSG45.", "[damaged]", "Byte count"] {
        assert!(text.contains(said), "{said}: {text}");
    }
    assert!(page.clipboard_html().await?.contains("Byte count"));
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_refused_summary_can_be_copied_by_hand() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    page.paste(LOG).await?;
    page.wait_for(".rows .row").await?;
    page.value(
        "navigator.clipboard.write = navigator.clipboard.writeText = () => Promise.reject(new Error('refused')); \
         document.execCommand = () => false",
    )
    .await?;
    page.click_text(".file-bar button", "Copy summary for a mail").await?;
    page.until("dialog[open] .not-done", "does not let Buslens copy").await?;
    page.until("dialog[open] .digest", "What is wrong").await?;
    page.close().await
}

/// The first page of a log's report is its summary; what is wrong stands behind it, field by field.
#[tokio::test(flavor = "multi_thread")]
async fn a_log_has_a_report() -> Result {
    for repeat in [1, 20] {
        let page = Page::open(DESKTOP, false).await?;
        open(&page, "converter.log", &LOG.repeat(repeat)).await?;
        page.click_text(".file-bar .menu > button", "Export").await?;
        page.click_text("[role=menuitem]", "A report to print").await?;
        page.until(".paper .digest", "Unit 9 answered none of").await?;
        page.until(".paper .digest", "Telegrams that matter").await?;
        page.fill_in("Title", "Dairy, line 2").await?;
        page.until(".paper h2", "Dairy, line 2").await?;
        assert_eq!(page.accessibility().await?, [""; 0]);
        page.picture(&format!("report-{repeat}")).await?;
        page.close().await?;
    }
    Ok(())
}

#[tokio::test(flavor = "multi_thread")]
async fn a_log_is_passed_on_without_what_is_nobodys_business() -> Result {
    let text = format!("# gateway 10.20.30.40 of Miller, unit 9 is the pump\n{LOG}");
    for repeat in [1, 20] {
        let page = Page::open(DESKTOP, false).await?;
        open(&page, "converter.log", &text.repeat(repeat)).await?;
        page.click_text(".file-bar .menu > button", "Export").await?;
        page.click_text("[role=menuitem]", "A log to pass on").await?;
        page.fill_in("Names, with a comma between them", "Miller, pump").await?;
        page.press_button("Replace, and show what").await?;
        page.until("dialog[open] h3", "things replaced").await?;
        page.until("dialog[open] .table", "10.20.30.40").await?;
        assert_eq!(page.accessibility().await?, [""; 0]);
        page.picture(&format!("pass-on-{repeat}")).await?;
        let path = page.saved("dialog[open] footer .main").await?;
        assert_eq!(path.file_name().and_then(|name| name.to_str()), Some("converter-to-pass-on.log"));
        let passed = std::fs::read_to_string(path)?;
        assert_eq!(passed.len(), text.len() * repeat);
        for gone in ["10.20.30.40", "Miller", "pump", "unit 9", " 09 04 00 00 00 02 70 83"] {
            assert!(!passed.contains(gone), "{gone} is still there");
        }
        // It reads as the one before.
        page.click("dialog[open] [aria-label=Close]").await?;
        let before = page.text(".story h2").await?;
        open(&page, "again.log", &passed).await?;
        page.until(".file-bar strong", "again.log").await?;
        page.settle().await?;
        let words = |text: &str| text.split(" unit ").next().unwrap_or_default().to_owned();
        assert_eq!(words(&page.text(".story h2").await?), words(&before));
        page.close().await?;
    }
    Ok(())
}

#[tokio::test(flavor = "multi_thread")]
async fn telegrams_are_saved_as_a_capture() -> Result {
    let page = Page::open(DESKTOP, false).await?;
    open(&page, "converter.log", LOG).await?;
    let capture = saved(&page, "Export", "Capture for Wireshark (pcapng)").await?;
    assert_eq!(capture.get(..4), Some(&[0x0A, 0x0D, 0x0D, 0x0A][..]));
    // Opened again, it is the same log.
    let said = page.text(".file-bar .soft").await?;
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("again.pcapng");
    std::fs::write(&path, &capture)?;
    page.open_file(&path.display().to_string()).await?;
    page.until(".file-bar strong", "again.pcapng").await?;
    page.until(".file-bar .soft", said.split(" · ").next().unwrap_or_default()).await?;
    page.until(".story", "Unit 9").await?;
    page.close().await
}
