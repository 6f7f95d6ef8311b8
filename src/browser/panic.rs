//! A panic ends the page's program: says so, and that the input can still be copied.

use leptos::prelude::document;

/// From now on a panic is told in the page. What was typed stays in its box: nothing draws any more.
pub fn tell() {
    std::panic::set_hook(Box::new(|panic| {
        web_sys::console::error_1(&panic.to_string().into());
        // Whatever cannot be done here cannot be told either.
        let _ = document().create_element("p").and_then(|note| {
            note.set_class_name("ended");
            note.set_attribute("role", "alert")?;
            note.set_text_content(Some(
                "Something in Buslens broke, and the page has stopped. Your input is still in its box: \
                 copy it, then reload the page. Please report the input that led to this.",
            ));
            document().body().map(|body| body.prepend_with_node_1(&note)).transpose()
        });
    }));
}
