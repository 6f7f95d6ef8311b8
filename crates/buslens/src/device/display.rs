//! What a device's display shows when something is wrong.

use super::Profile;

/// A text that the device's display shows.
#[derive(Debug, PartialEq, Eq)]
pub struct Display {
    /// As the seven segments write it; an X at the end stands for any digit or letter.
    pub text: &'static str,
    pub meaning: &'static str,
}

impl Profile {
    /// What the display's `text` means. Seven segments do not tell capitals from small letters, so
    /// neither does this; dots, spaces and underscores count for nothing.
    ///
    /// ```
    /// use buslens::device::PROFILES;
    ///
    /// let f5 = PROFILES.iter().find(|profile| profile.key == "keb-f5-profibus").unwrap();
    /// assert_eq!(f5.shown("e.bcc").unwrap().text, "E_Bcc");
    /// assert_eq!(f5.shown("EEEP3").unwrap().text, "EEEPX");
    /// assert_eq!(f5.shown("hello"), None);
    /// ```
    pub fn shown(&self, text: &str) -> Option<&'static Display> {
        let shown = folded(text);
        let exact = self.display.iter().find(|display| folded(display.text) == shown);
        exact.or_else(|| self.display.iter().find(|display| fits(&shown, &folded(display.text))))
    }
}

/// The letters and digits of `text`, without their case.
fn folded(text: &str) -> Vec<u8> {
    let kept = text.bytes().filter(|byte| !matches!(byte, b'_' | b' ' | b'.'));
    kept.map(|byte| byte.to_ascii_lowercase()).collect()
}

/// Whether `shown` is `pattern` with its last X filled in.
fn fits(shown: &[u8], pattern: &[u8]) -> bool {
    let fixed = pattern.iter().rposition(|byte| *byte != b'x').map_or(0, |last| last + 1);
    shown.len() == pattern.len()
        && pattern.len() > fixed
        && shown.starts_with(pattern.split_at(fixed).0)
        && shown.iter().all(u8::is_ascii_alphanumeric)
}
