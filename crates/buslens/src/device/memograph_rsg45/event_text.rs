//! A line for the event list, from register 3024 on: up to 40 characters.

use super::text::Text;
use crate::device::Settings;
use crate::field::Spec;
use crate::walk::{Telegram, Walk, Walker};

pub fn write(_: &Settings) -> Box<dyn Telegram> {
    Box::new(EventText { text: Vec::new() })
}

struct EventText {
    text: Vec<u8>,
}

impl Telegram for EventText {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        TEXT.walk(w, &mut self.text)
    }
}

static TEXT: Text = Text::new(
    Spec::new("text", "Text")
        .note("What the event list is to say, at most 40 characters.")
        .source("Memograph M RSG45 Modbus supplement, 2.6.12"),
    40,
);
