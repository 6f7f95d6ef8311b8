//! Fields and buttons, found as a person finds them: by what they are called.

use std::time::Duration;

use serde_json::{Value, json};
use thirtyfour::session::scriptret::ScriptRet;

use crate::{Page, Result};

/// Finds the field that is called `name` below `main`, by its label or its name for screen readers.
const FIELD: &str = "const called = (field) => field.getAttribute('aria-label') ?? \
    [...(field.labels ?? [])].map((label) => (label.querySelector(':scope > span') ?? label).textContent.trim())[0]; \
    const field = [...document.querySelectorAll('main :is(input, select, textarea)')].find((field) => \
    called(field) == arguments[0] && field.offsetParent); \
    if (!field) throw new Error(`no field is called ${arguments[0]}`);";

impl Page {
    /// Runs a script that throws as long as what it looks for is not there: a view may still be loading.
    async fn on_what_comes(&self, script: &str, arguments: Vec<Value>) -> Result<ScriptRet> {
        for _ in 0..100 {
            if let Ok(result) = self.driver.execute(script, arguments.clone()).await {
                return Ok(result);
            }
            tokio::time::sleep(Duration::from_millis(50)).await;
        }
        self.driver.execute(script, arguments).await
    }

    /// Types `text` in place of what the field holds.
    pub async fn fill_in(&self, name: &str, text: &str) -> Result {
        let script = format!(
            "{FIELD} field.focus(); field.select(); \
             document.execCommand(arguments[1] ? 'insertText' : 'delete', false, arguments[1])"
        );
        self.on_what_comes(&script, vec![json!(name), json!(text)]).await?;
        self.settle().await
    }

    /// What the field holds.
    pub async fn holds(&self, name: &str) -> Result<String> {
        let value = self.on_what_comes(&format!("{FIELD} return field.value"), vec![json!(name)]).await?;
        value.convert()
    }

    /// What stands below the field: what is wrong with it, or what to know of it.
    pub async fn about(&self, name: &str) -> Result<String> {
        let script = format!("{FIELD} return field.closest('.entry').querySelector('.about').textContent");
        self.on_what_comes(&script, vec![json!(name)]).await?.convert()
    }

    /// Chooses the option that says `text`.
    pub async fn choose_in(&self, name: &str, text: &str) -> Result {
        let script = format!(
            "{FIELD} const option = [...field.options].find((option) => option.textContent == arguments[1]); \
             if (!option) throw new Error(`no option says ${{arguments[1]}}`); \
             field.value = option.value; field.dispatchEvent(new Event('change', {{ bubbles: true }}))"
        );
        self.on_what_comes(&script, vec![json!(name), json!(text)]).await?;
        self.settle().await
    }

    /// Turns a switch or a choice on or off.
    pub async fn tick(&self, name: &str) -> Result {
        self.on_what_comes(&format!("{FIELD} field.click()"), vec![json!(name)]).await?;
        self.settle().await
    }

    /// Chooses one of a few that stand side by side.
    pub async fn tick_option(&self, text: &str) -> Result {
        let script = "const found = [...document.querySelectorAll('.segments label')].find((label) => \
                      label.textContent.trim() == arguments[0]); \
                      if (!found) throw new Error(`no option says ${arguments[0]}`); found.click()";
        self.on_what_comes(script, vec![json!(text)]).await?;
        self.settle().await
    }

    /// Presses the button or the link that is called so.
    pub async fn press_button(&self, name: &str) -> Result {
        let script = "const found = [...document.querySelectorAll('button, a, summary')].find((it) => it.offsetParent \
            && (it.getAttribute('aria-label') ?? it.textContent.trim()) == arguments[0]); \
            if (!found) throw new Error(`no button is called ${arguments[0]}`); found.click()";
        self.on_what_comes(script, vec![json!(name)]).await?;
        self.settle().await
    }

    /// The bytes of the strip below `css`.
    pub async fn bytes_in(&self, css: &str) -> Result<String> {
        self.settle().await?;
        let script = "return [...document.querySelectorAll(arguments[0] + ' .byte-strip button')].map((cell) => \
                      cell.textContent).join(' ')";
        self.on_what_comes(script, vec![json!(css)]).await?.convert()
    }

    /// Lets a script run before the page does, from the next load on.
    pub async fn before_loading(&self, script: &str) -> Result {
        let source = json!({ "source": script });
        self.driver.cdp().send_raw("Page.addScriptToEvaluateOnNewDocument", source).await.map(drop)
    }
}
