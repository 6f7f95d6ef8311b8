//! What the browser is asked for, besides showing the page.

use std::cell::RefCell;

use gloo_timers::callback::Timeout;
use leptos::prelude::*;
use leptos::task::spawn_local;
use wasm_bindgen::JsCast;
use wasm_bindgen::closure::Closure;
use wasm_bindgen_futures::JsFuture;
use web_sys::js_sys::Array;
use web_sys::{
    Blob, ClipboardEvent, DragEvent, Element, Event, File, FocusEvent, HtmlAnchorElement, HtmlDocument,
    HtmlElement, HtmlInputElement, HtmlSelectElement, HtmlTextAreaElement, KeyboardEvent, Url,
};

use buslens::field::Span;

/// A panic ends the page's program: says so, and that the input can still be copied.
pub fn tell_of_panics() {
    std::panic::set_hook(Box::new(|panic| {
        web_sys::console::error_1(&panic.to_string().into());
        let told = document().create_element("p").and_then(|note| {
            note.set_class_name("ended");
            note.set_attribute("role", "alert")?;
            note.set_text_content(Some(
                "Something in Buslens broke, and the page has stopped. Your input is still in its box: \
                 copy it, then reload the page. Please report the input that led to this.",
            ));
            document().body().map(|body| body.prepend_with_node_1(&note)).transpose()
        });
        drop(told);
    }));
}

/// Calls `hear` with every event of the page that it reacts to.
pub fn listen(hear: impl Fn(&Event) + 'static) {
    let hear = Closure::<dyn Fn(Event)>::new(move |event| hear(&event));
    let hear = hear.into_js_value().unchecked_into();
    for kind in [
        "change",
        "click",
        "dragover",
        "drop",
        "focusin",
        "focusout",
        "input",
        "keydown",
        "keyup",
        "paste",
        "pointerleave",
        "pointerover",
        "scroll",
    ] {
        // Not all of them bubble, but all come down from the document.
        let _ = document().add_event_listener_with_callback_and_bool(kind, &hear, true);
    }
}

/// Calls `hear` with an event of the window that no element has.
pub fn on_window(kind: &str, hear: impl Fn() + 'static) {
    let hear = Closure::<dyn Fn()>::new(hear).into_js_value().unchecked_into();
    let _ = window().add_event_listener_with_callback(kind, &hear);
}

/// Keeps what belongs to the element `id` in the browser, where the browser allows that.
pub fn remember(id: &str, value: &str) {
    if let Ok(Some(storage)) = window().local_storage() {
        // A full or forbidden storage only means that it is gone at the next visit.
        let _ = storage.set_item(&kept_as(id), value);
    }
}

/// What was kept by [`remember`].
pub fn remembered(id: &str) -> Option<String> {
    window().local_storage().ok()??.get_item(&kept_as(id)).ok()?
}

fn kept_as(id: &str) -> String {
    format!("buslens.{id}")
}

/// Copies `text`; the clipboard of the browser is missing where the page comes over plain http.
pub fn copy(text: &str) {
    let clipboard = window().navigator().clipboard();
    if clipboard.is_undefined() {
        copy_by_selection(text);
    } else {
        // A browser that forbids it shows that itself.
        let _ = clipboard.write_text(text);
    }
}

/// Opens the browser's window for printing.
pub fn print() {
    let _ = window().print();
}

/// Gives `text` to the browser as a file to keep.
pub fn download(name: &str, text: &str) {
    if let Ok(blob) = Blob::new_with_str_sequence(&Array::of1(&text.into())) {
        download_blob(name, &blob);
    }
}

/// Gives a file to the browser to keep.
pub fn download_blob(name: &str, blob: &Blob) {
    let Ok(address) = Url::create_object_url_with_blob(blob) else { return };
    if let Ok(link) = document().create_element("a") {
        let link: HtmlAnchorElement = link.unchecked_into();
        link.set_href(&address);
        link.set_download(name);
        link.click();
    }
    let _ = Url::revoke_object_url(&address);
}

/// Reads the file that was chosen or dropped, and calls `then` with its name and text.
pub fn read_file(event: &Event, then: impl FnOnce(String, String) + 'static) {
    /// Longer files would stop the page for seconds.
    const LONGEST: f64 = 5e6;
    let Some(file) = file(event) else { return };
    let field = event.target().and_then(|target| target.dyn_into::<HtmlInputElement>().ok());
    if file.size() > LONGEST {
        say(&format!("{} has more than 5 MB: open it in Logs, which reads files of any size.", file.name()));
        return;
    }
    spawn_local(async move {
        let text = JsFuture::from(file.text()).await.ok().and_then(|text| text.as_string());
        then(file.name(), text.unwrap_or_default());
        // The same file can be chosen again.
        if let Some(field) = field {
            field.set_value("");
        }
    });
}

/// The file that was chosen or dropped, if it was one.
pub fn file(event: &Event) -> Option<File> {
    let field = event.target().and_then(|target| target.dyn_into::<HtmlInputElement>().ok());
    let dropped = event.dyn_ref::<DragEvent>().and_then(DragEvent::data_transfer);
    let files = dropped.and_then(|dropped| dropped.files()).or_else(|| field?.files())?;
    files.get(0)
}

/// The text that was pasted or dropped, if it was one.
pub fn pasted(event: &Event) -> Option<String> {
    let pasted = event.dyn_ref::<ClipboardEvent>().and_then(ClipboardEvent::clipboard_data);
    let data = pasted.or_else(|| event.dyn_ref::<DragEvent>()?.data_transfer())?;
    data.get_data("text").ok().filter(|text| !text.is_empty())
}

/// Whether the event is of something that text is typed into.
pub fn is_field(event: &Event) -> bool {
    closest(event, "textarea, input:not([type=checkbox], [type=range], [type=file])").is_some()
}

/// Moves the focus to the first element that `selector` finds.
pub fn focus_first(selector: &str) {
    if let Some(element) = document().query_selector(selector).ok().flatten() {
        focus(&element);
    }
}

/// Clicks the element that `selector` finds.
pub fn click(selector: &str) {
    let found = document().query_selector(selector).ok().flatten();
    if let Some(element) = found.as_ref().and_then(|element| element.dyn_ref::<HtmlElement>()) {
        element.click();
    }
}

fn copy_by_selection(text: &str) {
    let Ok(area) = document().create_element("textarea") else { return };
    let area: HtmlTextAreaElement = area.unchecked_into();
    area.set_value(text);
    area.set_class_name("unseen");
    if let Some(body) = document().body() {
        let _ = body.append_child(&area);
        area.select();
        let _ = document().unchecked_into::<HtmlDocument>().exec_command("copy");
        area.remove();
    }
}

/// What is kept while it is handed over to the view of logs.
pub const LOG: &str = "log";

/// Goes to another view.
pub fn go_to(document: &str) {
    let _ = window().location().set_href(document);
}

/// The id of the field that a file is chosen in.
pub const FILE: &str = "file";

/// The ids of the input, of the list's scrolling part and of the telegram with all its details.
pub const INPUT: &str = "input";
pub const LIST: &str = "list";
pub const DETAIL: &str = "detail";

/// The ids of the lists that say how the input is to be read.
pub const PROTOCOL: &str = "protocol";
pub const DIRECTION: &str = "direction";
pub const DEVICE: &str = "device";

/// The element with this id.
pub fn element<T: JsCast>(id: &str) -> Option<T> {
    document().get_element_by_id(id)?.dyn_into().ok()
}

/// Puts `text` in place of what the text area `id` holds, in a way that the browser's undo takes
/// back. The area tells of it like of any other input.
pub fn replace_undoably(id: &str, text: &str) {
    let Some(area) = element::<HtmlTextAreaElement>(id) else { return };
    focus(&area);
    area.select();
    let command = if text.is_empty() { "delete" } else { "insertText" };
    let _ =
        document().unchecked_into::<HtmlDocument>().exec_command_with_show_ui_and_value(command, false, text);
    if area.value() != text {
        area.set_value(text);
        if let Ok(event) = Event::new("input") {
            let _ = area.dispatch_event(&event);
        }
    }
}

thread_local! {
    static WAITING: RefCell<Option<Timeout>> = const { RefCell::new(None) };
    static SHOWING: RefCell<Option<Timeout>> = const { RefCell::new(None) };
}

/// Tells `text` to those who do not see the page, once there is a pause.
pub fn announce(text: String) {
    const PAUSE: u32 = 700;
    let tell = move || {
        if let Some(status) = element::<Element>("status") {
            status.set_text_content(Some(&text));
        }
    };
    // What waited before is dropped, and so never told.
    WAITING.with_borrow_mut(|waiting| *waiting = Some(Timeout::new(PAUSE, tell)));
}

/// Says `text` to everybody, for some seconds.
pub fn say(text: &str) {
    const SECONDS: u32 = 8_000;
    let show = |text: &str| {
        if let Some(note) = element::<Element>("toast") {
            note.set_text_content(Some(text));
        }
    };
    show(text);
    let hide = Timeout::new(SECONDS, move || show(""));
    SHOWING.with_borrow_mut(|showing| *showing = Some(hide));
}

/// The id of the element that an event is of.
pub fn id(event: &Event) -> String {
    let element = event.target().and_then(|target| target.dyn_into::<Element>().ok());
    element.map_or(String::new(), |element| element.id())
}

/// The key that was pressed: `ArrowDown`.
pub fn key(event: &Event) -> String {
    event.dyn_ref::<KeyboardEvent>().map_or(String::new(), KeyboardEvent::key)
}

/// The value of the list or field that an event is of.
pub fn value(event: &Event) -> String {
    let Some(target) = event.target() else { return String::new() };
    match target.dyn_into::<HtmlSelectElement>() {
        Ok(list) => list.value(),
        Err(other) => other.dyn_into::<HtmlInputElement>().map_or(String::new(), |field| field.value()),
    }
}

/// Whether the switch that an event is of is on; `None` for what is no switch.
pub fn checked(event: &Event) -> Option<bool> {
    let field = event.target()?.dyn_into::<HtmlInputElement>().ok()?;
    (field.type_() == "checkbox").then(|| field.checked())
}

/// Puts `value` into the field, list or switch with this id, if it shows something else.
pub fn set_field(id: &str, value: &str) {
    if let Some(list) = element::<HtmlSelectElement>(id) {
        list.set_value(value);
    } else if let Some(area) = element::<HtmlTextAreaElement>(id) {
        area.set_value(value);
    } else if let Some(field) = element::<HtmlInputElement>(id) {
        if field.type_() == "checkbox" {
            field.set_checked(value == "1");
        } else if field.value() != value {
            field.set_value(value);
        }
    }
}

/// Sets a slider to one of the numbers from 0 to `last`.
pub fn set_range(id: &str, at: usize, last: usize) {
    if let Some(field) = element::<HtmlInputElement>(id) {
        let _ = field.set_attribute("max", &last.to_string());
        field.set_value(&at.to_string());
    }
}

/// Hides the element with this id, or shows it.
pub fn hide(id: &str, hidden: bool) {
    if let Some(element) = element::<Element>(id) {
        let _ = element.toggle_attribute_with_force("hidden", hidden);
    }
}

/// Puts `text` into the element with this id.
pub fn set_text(id: &str, text: &str) {
    if let Some(element) = element::<Element>(id) {
        element.set_text_content(Some(text));
    }
}

/// The element at or above the event's target that `selector` fits.
pub fn closest(event: &Event, selector: &str) -> Option<Element> {
    event.target()?.dyn_into::<Element>().ok()?.closest(selector).ok()?
}

/// Whether the focus only moves within the element `selector` around it.
pub fn stays_within(event: &Event, selector: &str) -> bool {
    let to = event.dyn_ref::<FocusEvent>().and_then(FocusEvent::related_target);
    let to = to.and_then(|to| to.dyn_into::<Element>().ok());
    let around = |element: &Element| element.closest(selector).ok().flatten();
    to.is_some_and(|to| around(&to) == closest(event, selector))
}

/// The value of the attribute `name` at or above the event's target.
pub fn attribute(event: &Event, name: &str) -> Option<String> {
    closest(event, &format!("[{name}]"))?.get_attribute(name)
}

/// The bytes that the element of the event stands for.
pub fn span(event: &Event) -> Option<Span> {
    parse_span(&attribute(event, SPAN)?)
}

/// The attribute of elements that stand for bytes of the telegram: `3-5`.
pub const SPAN: &str = "data-span";

/// What that attribute holds.
pub fn span_text(span: Span) -> String {
    format!("{}-{}", span.from, span.to)
}

fn parse_span(text: &str) -> Option<Span> {
    let (from, to) = text.split_once('-')?;
    Some(Span::new(from.parse().ok()?, to.parse().ok()?))
}

/// Gives the class `lit` to the elements that stand for bytes of `lit`, and takes it from all
/// others: groups of cells light up with any of their bytes, rows with just theirs.
pub fn light(lit: Option<Span>) {
    let Some(root) = element::<Element>(DETAIL) else { return };
    for element in all(&root, "[data-span]:is(.group, tr)") {
        let of = element.get_attribute(SPAN).and_then(|span| parse_span(&span));
        let overlaps = |of: Span, lit: Span| of.from < lit.to && lit.from < of.to;
        let on = match (of, lit) {
            (Some(of), Some(lit)) if element.tag_name() == "TR" => of == lit && !of.is_empty(),
            (Some(of), Some(lit)) => overlaps(of, lit),
            _ => false,
        };
        let _ = element.class_list().toggle_with_force("lit", on);
    }
}

/// Scrolls the list as little as it takes to show its row `index`. All rows are of one height.
pub fn keep_in_sight(index: usize) {
    let Some(list) = element::<Element>(LIST) else { return };
    let row = list.query_selector("[role=option]").ok().flatten();
    let row = row.and_then(|row| row.dyn_into::<HtmlElement>().ok()).map_or(0, |row| row.offset_height());
    let top = index as i32 * row;
    let bottom = top + row - list.client_height();
    list.set_scroll_top(list.scroll_top().min(top).max(bottom));
}

/// Makes `pieces` the children of the element with this id, where those of `before` are so far. Only what
/// differs is drawn: most keystrokes change a few of hundreds.
pub fn redraw(id: &str, before: &[String], pieces: &[String]) {
    let Some(root) = element::<Element>(id) else { return };
    let children = all(&root, ":scope > *");
    let changed = before.iter().zip(pieces).filter(|(old, new)| old != new).count();
    if children.len() != before.len() || changed > pieces.len() / 2 {
        root.set_inner_html(&pieces.concat());
        return;
    }
    for (index, child) in children.iter().enumerate() {
        match pieces.get(index) {
            Some(piece) if *piece == before[index] => {}
            Some(piece) => child.set_outer_html(piece),
            None => child.remove(),
        }
    }
    if let Some(more) = pieces.get(before.len()..) {
        let _ = root.insert_adjacent_html("beforeend", &more.concat());
    }
    // The tab key leads to one of the stops, which may have been redrawn.
    let stops = all(&root, "[data-stop]");
    if let Some(first) = stops.first()
        && stops.iter().filter(|stop| stop.get_attribute("tabindex").as_deref() == Some("0")).count() != 1
    {
        stops.iter().for_each(|stop| drop(stop.set_attribute("tabindex", "-1")));
        let _ = first.set_attribute("tabindex", "0");
    }
}

/// All elements below `root` that `selector` fits.
pub fn all(root: &Element, selector: &str) -> Vec<Element> {
    let Ok(found) = root.query_selector_all(selector) else { return Vec::new() };
    (0..found.length()).filter_map(|index| found.item(index)?.dyn_into().ok()).collect()
}

/// Moves the focus to `element`, and makes it the one of its siblings in `among` that the tab key
/// leads to.
pub fn rove(among: &[Element], element: &Element) {
    for other in among {
        let _ = other.set_attribute("tabindex", if other == element { "0" } else { "-1" });
    }
    focus(element);
}

pub fn focus(element: &Element) {
    // Pictures (SVG) have elements of another type with the same method.
    let _ = element.unchecked_ref::<HtmlElement>().focus();
}
