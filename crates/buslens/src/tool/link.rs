//! What a page shows, for the part of a link behind `#`, which no server sees. It is `key=value&…` in the
//! encoding of web forms, which the page leaves to the browser; here are the pairs.
//!
//! | key | what it says |
//! | --- | --- |
//! | `text` | the input |
//! | `protocol`, `direction`, `device` | how it is to be read, by their keys |
//! | `settings` | how the devices are set up: the bytes of [`settings`] in hex |
//! | `telegram` | which telegram is shown, from 1 |
//! | `place` | where in Learn: words with points between them, the part first (`lessons.crc.3`) |
//! | `task` | what is asked of the device, instead of a telegram: the label of an offer |
//! | `.` and a path | what was typed into that entry of the form, where the bytes do not tell |
//!
//! What is missing is as when nobody chose. Unknown keys are passed over: a newer page may have made
//! the link. Keys whose values cannot be read are [`damaged`](Link::damaged), so that a page can say so.

use super::{Options, Profile, Protocol, settings};
use crate::field::{Direction, hex};
use crate::text;

/// What a link holds.
#[derive(Clone, Debug, Default)]
pub struct Link {
    pub text: String,
    pub options: Options,
    /// The index of the telegram that is shown.
    pub telegram: usize,
    pub task: Option<String>,
    /// Where in Learn.
    pub place: String,
    /// Paths of entries with what was typed there.
    pub entries: Vec<(String, String)>,
    /// Keys of what it holds that cannot be read: it was cut or changed on its way, or a newer page
    /// made it.
    pub damaged: Vec<String>,
}

impl Link {
    /// A link to nothing but this text.
    pub fn to(text: String, options: Options) -> Self {
        Self { text, options, ..Self::default() }
    }

    /// Reads the part behind `#` as it stands in an address.
    ///
    /// ```
    /// use buslens::tool::link::Link;
    ///
    /// assert_eq!(Link::parse("text=01+03%0A05").text, "01 03\n05");
    /// assert_eq!(Link::parse("text=%E0%A4%A&device=%").damaged, ["text", "device"]);
    /// ```
    pub fn parse(content: &str) -> Self {
        let mut damaged = Vec::new();
        let pairs = content.split('&').filter(|pair| !pair.is_empty()).filter_map(|pair| {
            let (key, value) = pair.split_once('=')?;
            let both = decoded(key).zip(decoded(value));
            if both.is_none() {
                damaged.push(decoded(key).unwrap_or_else(|| key.to_owned()));
            }
            both
        });
        let mut link = Self::read(pairs);
        link.damaged.splice(0..0, damaged);
        link
    }

    /// Reads the pairs of the part behind `#`.
    pub fn read(pairs: impl IntoIterator<Item = (String, String)>) -> Self {
        let mut link = Self::default();
        for (key, value) in pairs {
            let options = &mut link.options;
            let understood = match key.as_str() {
                "text" => {
                    link.text = value;
                    true
                }
                "protocol" => {
                    options.protocol = Protocol::of(&value);
                    options.protocol.is_some()
                }
                "direction" => {
                    options.direction = Direction::of(&value);
                    options.direction.is_some()
                }
                "device" => {
                    options.device = Profile::of(&value);
                    options.device.is_some()
                }
                "settings" => {
                    options.settings = kept_settings(&value);
                    value.len().is_multiple_of(2) && value.bytes().all(|digit| digit.is_ascii_hexdigit())
                }
                "telegram" => {
                    let number = value.parse::<usize>();
                    link.telegram = number.clone().unwrap_or(1).saturating_sub(1);
                    number.is_ok_and(|number| number > 0)
                }
                "place" => {
                    link.place = value;
                    true
                }
                "task" => {
                    link.task = Some(value);
                    true
                }
                _ => {
                    if let Some(path) = key.strip_prefix('.') {
                        link.entries.push((path.to_owned(), value));
                    }
                    true
                }
            };
            if !understood {
                link.damaged.push(key);
            }
        }
        link
    }

    /// The pairs for the part behind `#`; none for a page as it is at first.
    pub fn pairs(&self) -> Vec<(String, String)> {
        let Options { protocol, direction, device, settings } = &self.options;
        let telegram = if self.telegram > 0 { (self.telegram + 1).to_string() } else { String::new() };
        let pairs = [
            ("device", device.map_or("", |it| it.key)),
            ("protocol", protocol.map_or("", |it| it.key)),
            ("direction", direction.map_or("", Direction::key)),
            ("settings", &keep_settings(settings)),
            ("telegram", &telegram),
            ("task", self.task.as_deref().unwrap_or_default()),
            ("place", &self.place),
            ("text", &self.text),
        ];
        let said = pairs.iter().filter(|(_, value)| !value.is_empty());
        let said = said.map(|(key, value)| ((*key).to_owned(), (*value).to_owned()));
        let entries = self.entries.iter().map(|(path, text)| (format!(".{path}"), text.clone()));
        said.chain(entries).collect()
    }
}

/// Text in the encoding of web forms; `None` where that is damaged.
fn decoded(text: &str) -> Option<String> {
    let digit = |digit: u8| char::from(digit).to_digit(16);
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.bytes();
    while let Some(byte) = rest.next() {
        bytes.push(match byte {
            b'+' => b' ',
            b'%' => (digit(rest.next()?)? << 4 | digit(rest.next()?)?) as u8,
            byte => byte,
        });
    }
    String::from_utf8(bytes).ok()
}

/// The settings in as few characters as they take.
pub fn keep_settings(settings: &super::Settings) -> String {
    hex(&settings::to_bytes(settings)).replace(' ', "")
}

/// What [`keep_settings`] wrote.
pub fn kept_settings(text: &str) -> super::Settings {
    settings::from_bytes(&text::bytes(text))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tool::settings::changed;
    use crate::tool::{PROFILES, PROTOCOLS};

    #[test]
    fn what_is_written_is_read_again() {
        let link = Link {
            text: "01 03 00 C8\n# 10 % & more = “ß”".to_owned(),
            options: Options {
                direction: Some(Direction::Response),
                protocol: Some(PROTOCOLS[1]),
                device: Some(PROFILES[0]),
                settings: settings::from_bytes(&[1, 0, 16]),
            },
            telegram: 3,
            task: Some("write Batch".to_owned()),
            place: "lessons.crc".to_owned(),
            entries: vec![("values.0.value".to_owned(), String::new())],
            ..Link::default()
        };
        let again = Link::read(link.pairs());
        assert_eq!(again.text, link.text);
        assert_eq!(again.options.direction, link.options.direction);
        assert_eq!(again.options.protocol.map(|it| it.key), Some(PROTOCOLS[1].key));
        assert_eq!(again.options.device.map(|it| it.key), Some(PROFILES[0].key));
        assert_eq!(changed(&again.options.settings), changed(&link.options.settings));
        assert_eq!((again.telegram, &again.task, &again.entries), (3, &link.task, &link.entries));
        assert_eq!(again.place, link.place);
    }

    #[test]
    fn a_telegram_has_a_short_link() {
        let link = Link::to("01 03 00 C8 00 03 84 35".to_owned(), Options::default());
        assert_eq!(link.pairs(), [("text".to_owned(), link.text.clone())]);
        assert_eq!(Link::default().pairs(), []);
    }

    #[test]
    fn whatever_stands_in_it_is_a_link() {
        for (key, value) in [
            ("", ""),
            ("telegram", "no"),
            ("protocol", "telex"),
            (".", ""),
            ("settings", "xyz"),
            ("telegram", "0"),
        ] {
            let link = Link::read([(key.to_owned(), value.to_owned())]);
            assert!(link.text.is_empty() && link.telegram == 0 && link.options.protocol.is_none());
            let known = !key.is_empty() && key != ".";
            assert_eq!(link.damaged, if known { vec![key.to_owned()] } else { Vec::new() });
        }
    }

    #[test]
    fn a_damaged_link_tells_what_is_lost() {
        let link = Link::parse("text=%E0%A4%A&device=%&protocol=modbus-tcp&%ZZ=1&direction=up&.unit=2&&x");
        assert_eq!(link.damaged, ["text", "device", "%ZZ", "direction"]);
        assert_eq!(link.options.protocol.map(|it| it.key), Some("modbus-tcp"));
        assert_eq!(link.entries, [("unit".to_owned(), "2".to_owned())]);
        let whole = Link::parse("text=01+03%20%C3%9F%26%3D&telegram=2&settings=0A");
        assert_eq!((whole.text.as_str(), whole.telegram), ("01 03 ß&=", 1));
        assert!(whole.damaged.is_empty());
    }
}
