//! The page as a screen reader has it: the tree that the browser makes for it, as lines of text.

use std::collections::HashMap;

use serde_json::{Value, json};

use crate::{Page, Result};

impl Page {
    /// What is below the first element with this role, a line each: its role, its name, its value, what describes
    /// it, its state. What only holds other things together has no line.
    pub async fn aloud(&self, role: &str) -> Result<String> {
        let nodes = self.tree().await?;
        let by_id: HashMap<&str, &Value> =
            nodes.iter().filter_map(|node| Some((node["nodeId"].as_str()?, node))).collect();
        let root = nodes.iter().find(|node| text(node, "role") == role);
        let mut lines = Vec::new();
        if let Some(root) = root {
            add(root, &by_id, 0, &mut lines);
        }
        Ok(lines.join("\n") + "\n")
    }

    /// What is said where the focus is.
    pub async fn focus_aloud(&self) -> Result<String> {
        let nodes = self.tree().await?;
        let is_focused =
            |node: &&Value| property(node, "focused").is_some() && text(node, "role") != "RootWebArea";
        let focused = nodes.iter().find(is_focused);
        // Who has the focus may say that it is elsewhere.
        let active = focused.and_then(|node| {
            let related =
                node["properties"].as_array()?.iter().find(|it| it["name"] == "activedescendant")?;
            let id = &related["value"]["relatedNodes"][0]["backendDOMNodeId"];
            nodes.iter().find(|node| node["backendDOMNodeId"] == *id)
        });
        Ok(active.or(focused).map_or("nothing".to_owned(), said))
    }

    /// What the page tells by itself, once it has made a pause.
    pub async fn told(&self) -> Result<String> {
        tokio::time::sleep(std::time::Duration::from_millis(1200)).await;
        let script = "return [...document.querySelectorAll('[role=status], [role=alert], [aria-live=polite]')]\
                      .map((it) => it.textContent.trim()).filter((it) => it).join(' | ')";
        Ok(self.value(script).await?.as_str().unwrap_or_default().to_owned())
    }

    async fn tree(&self) -> Result<Vec<Value>> {
        self.settle().await?;
        let tree = self.driver.cdp().send_raw("Accessibility.getFullAXTree", json!({})).await?;
        Ok(tree["nodes"].as_array().cloned().unwrap_or_default())
    }
}

fn text<'a>(node: &'a Value, key: &str) -> &'a str {
    node[key]["value"].as_str().unwrap_or_default().trim()
}

/// A property that is set.
fn property(node: &Value, name: &str) -> Option<String> {
    let found = node["properties"].as_array()?.iter().find(|it| it["name"] == name)?;
    match &found["value"]["value"] {
        Value::String(value) if value != "false" => Some(value.clone()),
        Value::Bool(true) => Some("true".to_owned()),
        Value::Number(value) => Some(value.to_string()),
        _ => None,
    }
}

/// Those whose name is all that is in them.
const NAMED: [&str; 16] = [
    "button",
    "link",
    "heading",
    "option",
    "cell",
    "gridcell",
    "rowheader",
    "columnheader",
    "menuitem",
    "tab",
    "textbox",
    "searchbox",
    "combobox",
    "spinbutton",
    "DisclosureTriangle",
    "image",
];

/// More rows are not written down.
const ROWS: usize = 12;

fn add(node: &Value, by_id: &HashMap<&str, &Value>, depth: usize, lines: &mut Vec<String>) {
    let children = || {
        let ids = node["childIds"].as_array().into_iter().flatten();
        ids.filter_map(|id| by_id.get(id.as_str()?).copied())
    };
    let role = text(node, "role");
    if matches!(role, "InlineTextBox" | "ListMarker") {
        return;
    }
    let holds = node["ignored"] == true || matches!(role, "" | "none" | "generic" | "LabelText");
    if holds || (role == "StaticText" && text(node, "name").is_empty()) {
        return children().for_each(|child| add(child, by_id, depth, lines));
    }
    let indent = "  ".repeat(depth);
    if role == "StaticText" {
        // Pieces of a sentence are read in one go.
        let start = format!("{indent}text ");
        match lines.last_mut().filter(|line| line.starts_with(&start)) {
            Some(line) => line.push_str(&format!(" {}", text(node, "name"))),
            None => lines.push(format!("{start}{}", text(node, "name"))),
        }
        return;
    }
    lines.push(format!("{indent}{}", said(node)));
    // A cell whose only content is its name; one with something to press in it is more than that.
    let pressed = |child: &Value| matches!(text(child, "role"), "button" | "link");
    if !NAMED.contains(&role) || text(node, "name").is_empty() || children().any(pressed) {
        // Rows of a list are like each other.
        let most = if role == "rowgroup" { ROWS } else { usize::MAX };
        children().take(most).for_each(|child| add(child, by_id, depth + 1, lines));
        if children().count() > most {
            lines.push(format!("{indent}  and further rows"));
        }
    }
}

fn said(node: &Value) -> String {
    let mut said = text(node, "role").to_owned();
    let name = text(node, "name");
    if !name.is_empty() {
        said += &format!(" \"{name}\"");
    }
    match &node["value"]["value"] {
        Value::String(value) if !value.is_empty() => said += &format!(" = {value:?}"),
        Value::Number(value) => said += &format!(" = {value}"),
        _ => {}
    }
    let description = text(node, "description");
    if !description.is_empty() {
        said += &format!(" ({description})");
    }
    for name in ["level", "checked", "pressed", "selected", "disabled", "invalid", "live"] {
        // Items of lists have a level, too, which says nothing.
        if let Some(value) = property(node, name).filter(|_| name != "level" || said.starts_with("heading")) {
            said += &match value.as_str() {
                "true" => format!(", {name}"),
                value => format!(", {name} {value}"),
            };
        }
    }
    let expanded =
        node["properties"].as_array().and_then(|all| all.iter().find(|it| it["name"] == "expanded"));
    if let Some(expanded) = expanded.filter(|_| !said.starts_with("combobox")) {
        said += if expanded["value"]["value"] == true { ", expanded" } else { ", collapsed" };
    }
    said
}
