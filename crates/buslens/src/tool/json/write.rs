//! JSON, written straight into a text: no tree of values, no text of its own for each of them.

use std::num::NonZero;

use lexical_core::{BUFFER_SIZE, WriteFloatOptions, format};

use crate::field::{Message, Span, push_digits, push_hex};

/// An object that is being written, one key after the other.
pub struct Object<'a> {
    text: &'a mut String,
}

impl Object<'_> {
    /// Writes an object behind what `text` holds.
    pub fn write(text: &mut String, fill: impl FnOnce(&mut Object<'_>)) {
        text.push('{');
        fill(&mut Object { text });
        text.push('}');
    }

    /// A key with its value; neither where the value is `None`.
    pub fn put(&mut self, key: &str, value: impl Json) {
        if !value.is_left_out() {
            value.write(self.key(key));
        }
    }

    /// A key with what `write` puts behind a text.
    pub fn text(&mut self, key: &str, write: impl FnOnce(&mut String)) {
        string(self.key(key), write);
    }

    /// The same; not even the key where that is nothing.
    pub fn text_if_any(&mut self, key: &str, write: impl FnOnce(&mut String)) {
        let before = self.text.len();
        let text = self.key(key);
        let empty = text.len() + 2;
        string(text, write);
        if text.len() == empty {
            text.truncate(before);
        }
    }

    pub fn object(&mut self, key: &str, fill: impl FnOnce(&mut Object<'_>)) {
        Object::write(self.key(key), fill);
    }

    /// A key with a list, each item as `write` writes it.
    pub fn list<T>(
        &mut self,
        key: &str,
        items: impl IntoIterator<Item = T>,
        write: impl FnMut(&mut String, T),
    ) {
        list(self.key(key), items, write);
    }

    /// The same; not even the key where the list is empty.
    pub fn list_if_any<T>(
        &mut self,
        key: &str,
        items: impl IntoIterator<Item = T>,
        write: impl FnMut(&mut String, T),
    ) {
        let mut items = items.into_iter().peekable();
        if items.peek().is_some() {
            self.list(key, items, write);
        }
    }

    /// Puts a key, and the comma before it where it is not the first. Its value is to follow.
    fn key(&mut self, key: &str) -> &mut String {
        // No value ends in an opening brace.
        self.text.push_str(if self.text.as_bytes().last() == Some(&b'{') { "\"" } else { ",\"" });
        self.text.push_str(key);
        self.text.push_str("\":");
        self.text
    }
}

/// What JSON has a value for.
pub trait Json {
    fn is_left_out(&self) -> bool {
        false
    }

    fn write(self, text: &mut String);
}

macro_rules! numbers {
    ($($number:ty),*) => {$(
        impl Json for $number {
            fn write(self, text: &mut String) {
                push_digits(text, self as u64, 1);
            }
        }
    )*};
}

numbers!(u8, u16, u32, u64, usize);

impl Json for i64 {
    fn write(self, text: &mut String) {
        if self < 0 {
            text.push('-');
        }
        self.unsigned_abs().write(text);
    }
}

impl Json for f64 {
    /// Must be finite: JSON has no other numbers.
    fn write(self, text: &mut String) {
        /// Up to 16 digits stand before the point, as most programs write them.
        const PLAIN: WriteFloatOptions =
            WriteFloatOptions::builder().positive_exponent_break(NonZero::new(15)).build_strict();
        let mut buffer = [0; BUFFER_SIZE];
        let written = lexical_core::write_with_options::<_, { format::STANDARD }>(self, &mut buffer, &PLAIN);
        let written = str::from_utf8(written).unwrap_or_default().replace(".0e", "e");
        text.push_str(&written.replace('e', "e+").replace("e+-", "e-"));
    }
}

impl Json for bool {
    fn write(self, text: &mut String) {
        text.push_str(if self { "true" } else { "false" });
    }
}

impl Json for &str {
    fn write(self, text: &mut String) {
        string(text, |text| text.push_str(self));
    }
}

impl Json for &Message {
    fn write(self, text: &mut String) {
        string(text, |text| self.push_to(text));
    }
}

/// Bytes are text in hex.
impl Json for &[u8] {
    fn write(self, text: &mut String) {
        string(text, |text| push_hex(text, self));
    }
}

impl Json for Span {
    fn write(self, text: &mut String) {
        list(text, [self.from, self.to], |text, place| place.write(text));
    }
}

impl<T: Json> Json for Option<T> {
    fn is_left_out(&self) -> bool {
        self.is_none()
    }

    fn write(self, text: &mut String) {
        if let Some(value) = self {
            value.write(text);
        }
    }
}

fn list<T>(text: &mut String, items: impl IntoIterator<Item = T>, mut write: impl FnMut(&mut String, T)) {
    text.push('[');
    for (place, item) in items.into_iter().enumerate() {
        if place > 0 {
            text.push(',');
        }
        write(text, item);
    }
    text.push(']');
}

/// What `write` puts behind a text, in quotes.
fn string(text: &mut String, write: impl FnOnce(&mut String)) {
    text.push('"');
    let from = text.len();
    write(text);
    // Looked at as a whole: hardly any text has such characters.
    let is_plain = |byte: &u8| *byte >= b' ' && *byte != b'"' && *byte != b'\\';
    if !text.as_bytes()[from..].iter().fold(true, |plain, byte| plain & is_plain(byte)) {
        let own = text.split_off(from);
        escape(text, &own);
    }
    text.push('"');
}

/// Puts `own` behind `text` as it stands in quotes.
fn escape(text: &mut String, own: &str) {
    for character in own.chars() {
        let short = match character {
            '"' | '\\' => character,
            '\n' => 'n',
            '\r' => 'r',
            '\t' => 't',
            '\u{8}' => 'b',
            '\u{c}' => 'f',
            ..' ' => {
                text.push_str("\\u00");
                for digit in [character as u32 >> 4, character as u32 & 15] {
                    text.extend(char::from_digit(digit, 16));
                }
                continue;
            }
            _ => {
                text.push(character);
                continue;
            }
        };
        text.push('\\');
        text.push(short);
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn written(value: impl Json) -> String {
        let mut text = String::new();
        value.write(&mut text);
        text
    }

    #[test]
    fn values_are_as_others_write_them() {
        for number in
            [0.0, -1.5, 0.1, 2.0, 1e-5, 1.25e-7, 123_456.789, 2_147_483_648.5, 1e15, 1e16, 6.5e21, f64::MAX]
        {
            assert_eq!(written(number), json!(number).to_string());
        }
        for number in [0, -1, i64::MIN, i64::MAX] {
            assert_eq!(written(number), json!(number).to_string());
        }
        let text: String = ('\0'..='\u{A0}').chain("“−\u{1F600}".chars()).collect();
        assert_eq!(written(text.as_str()), json!(text).to_string());
    }

    #[test]
    fn keys_stand_where_they_have_something() {
        let mut text = String::new();
        Object::write(&mut text, |object| {
            object.put("none", None::<u8>);
            object.text_if_any("empty", |_| {});
            object.list_if_any("nothing", [0_u8; 0], |text, item| item.write(text));
            object.put("brace", "{");
            object.object("inner", |inner| inner.put("some", Some(true)));
            object.list("list", [[1_u8, 2].as_slice(), &[]], |text, item| item.write(text));
            object.text("text", |text| text.push_str("\"{"));
        });
        assert_eq!(text, r#"{"brace":"{","inner":{"some":true},"list":["01 02",""],"text":"\"{"}"#);
    }
}
