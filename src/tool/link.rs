//! What a page shows, in the part of a link behind `#`, which no server sees: `key=value&…`, in the
//! encoding of web forms.
//!
//! | key | what it says |
//! | --- | --- |
//! | `text` | the input |
//! | `protocol`, `direction`, `device` | how it is to be read, by their keys |
//! | `settings` | how the devices are set up: the bytes of [`settings`] in hex |
//! | `telegram` | which telegram is shown, from 1 |
//! | `task` | what is asked of the device, instead of a telegram: the label of an offer |
//! | `.` and a path | what was typed into that entry of the form, where the bytes do not tell |
//!
//! What is missing is as when nobody chose. Unknown keys are passed over: a newer page may have made
//! the link.

use form_urlencoded::{Serializer, parse};

use super::{Options, PROFILES, PROTOCOLS, settings};
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
    /// Paths of entries with what was typed there.
    pub entries: Vec<(String, String)>,
}

impl Link {
    /// A link to nothing but this text.
    pub fn to(text: String, options: Options) -> Self {
        Self { text, options, ..Self::default() }
    }

    /// Reads the part behind `#`.
    pub fn read(fragment: &str) -> Self {
        let mut link = Self::default();
        for (key, value) in parse(fragment.as_bytes()) {
            let options = &mut link.options;
            match &*key {
                "text" => link.text = value.into_owned(),
                "protocol" => options.protocol = PROTOCOLS.iter().copied().find(|it| it.key == value),
                "direction" => {
                    let both = [Direction::Request, Direction::Response];
                    options.direction = both.into_iter().find(|it| it.key() == value);
                }
                "device" => options.device = PROFILES.iter().copied().find(|it| it.key == value),
                "settings" => options.settings = kept_settings(&value),
                "telegram" => link.telegram = value.parse().unwrap_or(1_usize).saturating_sub(1),
                "task" => link.task = Some(value.into_owned()),
                _ => {
                    if let Some(path) = key.strip_prefix('.') {
                        link.entries.push((path.to_owned(), value.into_owned()));
                    }
                }
            }
        }
        link
    }

    /// The part behind `#`; nothing for a page as it is at first.
    pub fn write(&self) -> String {
        let mut written = Serializer::new(String::new());
        let mut add = |key: &str, value: &str| {
            if !value.is_empty() {
                written.append_pair(key, value);
            }
        };
        let Options { protocol, direction, device, settings } = &self.options;
        add("device", device.map_or("", |it| it.key));
        add("protocol", protocol.map_or("", |it| it.key));
        add("direction", direction.map_or("", Direction::key));
        add("settings", &keep_settings(settings));
        if self.telegram > 0 {
            add("telegram", &(self.telegram + 1).to_string());
        }
        add("task", self.task.as_deref().unwrap_or_default());
        add("text", &self.text);
        for (path, text) in &self.entries {
            written.append_pair(&format!(".{path}"), text);
        }
        written.finish()
    }
}

/// The settings in as few characters as they take.
pub fn keep_settings(settings: &super::Settings) -> String {
    hex(&settings::to_bytes(settings)).replace(' ', "")
}

/// What [`keep_settings`] wrote.
pub fn kept_settings(text: &str) -> super::Settings {
    let bytes: Vec<u8> = text::read(text).lines.into_iter().flat_map(|line| line.bytes).collect();
    settings::from_bytes(&bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tool::settings::changed;

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
            entries: vec![("values.0.value".to_owned(), String::new())],
        };
        let again = Link::read(&link.write());
        assert_eq!(again.text, link.text);
        assert_eq!(again.options.direction, link.options.direction);
        assert_eq!(again.options.protocol.map(|it| it.key), Some(PROTOCOLS[1].key));
        assert_eq!(again.options.device.map(|it| it.key), Some(PROFILES[0].key));
        assert_eq!(changed(&again.options.settings), changed(&link.options.settings));
        assert_eq!((again.telegram, &again.task, &again.entries), (3, &link.task, &link.entries));
    }

    #[test]
    fn a_telegram_has_a_short_link() {
        let link = Link::to("01 03 00 C8 00 03 84 35".to_owned(), Options::default());
        assert_eq!(link.write(), "text=01+03+00+C8+00+03+84+35");
        assert_eq!(Link::default().write(), "");
    }

    #[test]
    fn whatever_stands_behind_the_sign_is_a_link() {
        for fragment in
            ["", "main", "&&=&", "telegram=no&protocol=telex&.=&%zz", "settings=xyz", "telegram=0"]
        {
            let link = Link::read(fragment);
            assert!(link.text.is_empty() && link.telegram == 0 && link.options.protocol.is_none());
        }
    }
}
