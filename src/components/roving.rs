//! Arrow keys among the stops of a part of the page, which is a single stop for Tab.

use leptos::ev::KeyboardEvent;
use leptos::prelude::document;
use leptos::wasm_bindgen::JsCast;
use web_sys::{Element, HtmlElement};

/// Where a key leads from stop `at` of `count`, if it leads anywhere.
pub fn step(key: &str, at: usize, count: usize) -> Option<usize> {
    let last = count.checked_sub(1)?;
    Some(match key {
        "ArrowRight" | "ArrowDown" => (at + 1).min(last),
        "ArrowLeft" | "ArrowUp" => at.saturating_sub(1),
        "Home" => 0,
        "End" => last,
        _ => return None,
    })
}

/// Moves the focus among the elements below `root` that `stops` finds, as the key says. Gives where it
/// is then.
pub fn follow(event: &KeyboardEvent, root: &Element, stops: &str) -> Option<usize> {
    let found = root.query_selector_all(stops).ok()?;
    let focused = document().active_element();
    let all = (0..found.length()).filter_map(|index| found.get(index)?.dyn_into::<Element>().ok());
    let at =
        all.enumerate().find(|(_, element)| Some(element) == focused.as_ref()).map(|(index, _)| index)?;
    let to = step(&event.key(), at, found.length() as usize)?;
    event.prevent_default();
    focus(root, stops, to);
    Some(to)
}

/// Moves the focus to stop `index` below `root`.
pub fn focus(root: &Element, stops: &str, index: usize) {
    let found = root.query_selector_all(stops).ok().and_then(|all| all.get(u32::try_from(index).ok()?));
    if let Some(stop) = found.and_then(|stop| stop.dyn_into::<HtmlElement>().ok()) {
        // An element that cannot take the focus leaves it where it was.
        let _ = stop.focus();
    }
}

#[cfg(test)]
mod tests {
    use super::step;

    #[test]
    fn keys_stay_within_the_stops() {
        assert_eq!(step("ArrowRight", 0, 3), Some(1));
        assert_eq!(step("ArrowDown", 2, 3), Some(2));
        assert_eq!(step("ArrowLeft", 0, 3), Some(0));
        assert_eq!(step("End", 0, 3), Some(2));
        assert_eq!(step("a", 0, 3), None);
        assert_eq!(step("End", 0, 0), None);
    }
}
