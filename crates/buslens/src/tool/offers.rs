//! What can be built: every telegram of the registries, and what a device can be asked for.

use crate::device::{Profile, Target, Task};
use crate::field::{Direction, Message, Name, Spec};
use crate::modbus::{self, Kind, STANDARD};
use crate::profibus;
use crate::walk::{Deviations, form};

/// Something that can be built.
#[derive(Clone, Copy, Debug)]
pub enum Offer {
    /// A telegram of a Modbus function.
    Telegram(&'static Kind),
    /// A telegram of a PROFIBUS service.
    Service(&'static profibus::Kind),
    /// A request in the words of a device's manual.
    Task(Task),
}

/// Everything that can be built; what the device can be asked for comes first.
pub fn offers(device: Option<&'static Profile>) -> Vec<Offer> {
    let tasks = device.map_or(Vec::new(), Profile::tasks).into_iter().map(Offer::Task);
    let telegrams = modbus::KINDS.iter().map(|kind| Offer::Telegram(kind));
    let services = profibus::KINDS.iter().map(|kind| Offer::Service(kind));
    tasks.chain(telegrams).chain(services).collect()
}

impl Offer {
    /// "Write universal channel", "Read coils, request".
    pub fn label(&self) -> Message {
        let directed = |spec: &'static Spec, direction: Direction| {
            let label = crate::field::Argument::Term(spec.label);
            match direction {
                Direction::Request => crate::message!("{label}, request", label = label),
                Direction::Response => crate::message!("{label}, response", label = label),
            }
        };
        match self {
            Self::Telegram(kind) => directed(&kind.spec, kind.direction),
            Self::Service(kind) => directed(&kind.spec, kind.direction),
            Self::Task(task) => task.label(),
        }
    }

    /// Whether this is what somebody types a part of: each word is in the label or in the name of a
    /// command that it can give, or is the function code, the access point, or an address that it is about
    /// (decimal, `0x5F00` or `5F00h`).
    pub fn fits(&self, typed: &str) -> bool {
        let label = self.label().to_string().to_ascii_lowercase();
        typed.to_ascii_lowercase().split_whitespace().all(|word| {
            label.contains(word)
                || number(word).is_some_and(|number| self.has(number))
                || self.commands().iter().any(|name| name.label.to_ascii_lowercase().contains(word))
        })
    }

    /// What there is to choose from in it.
    fn commands(&self) -> &'static [Name] {
        let form = match self {
            Self::Task(task) => form::form(&mut task.draft(), &Deviations::default()),
            Self::Telegram(kind) => form::form(&mut kind.pdu(&STANDARD), &Deviations::default()),
            Self::Service(_) => return &[],
        };
        let mut names: &'static [Name] = &[];
        form.visit(&mut |entry| {
            if let form::Content::Choice { .. } = entry.content {
                names = entry.spec.names;
            }
        });
        names
    }

    /// Whether `number` is its function code, its access point, or one of its addresses.
    fn has(&self, number: u16) -> bool {
        match self {
            Self::Telegram(kind) => u16::from(kind.function) == number,
            Self::Service(kind) => kind.sap.map(u16::from) == Some(number),
            Self::Task(Task { target: Target::Area(area), .. }) => {
                (area.from..=area.last()).contains(&number)
            }
            Self::Task(Task { target: Target::Parameter(parameter), .. }) => parameter.address == number,
        }
    }
}

fn number(word: &str) -> Option<u16> {
    let hex = word.strip_prefix("0x").or_else(|| word.strip_suffix('h'));
    match hex {
        Some(digits) => u16::from_str_radix(digits, 16).ok(),
        None => word.parse().ok(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::device::PROFILES;

    fn found(device: &str, typed: &str) -> Vec<String> {
        let device = PROFILES.iter().copied().find(|profile| profile.key == device);
        let fitting = offers(device).into_iter().filter(|offer| offer.fits(typed));
        fitting.map(|offer| offer.label().sentence()).collect()
    }

    #[test]
    fn offers_are_found_by_name_function_and_address() {
        assert_eq!(found("", "read coils"), ["Read coils, request", "Read coils, response"]);
        assert_eq!(
            found("", "16"),
            ["Write multiple registers, request", "Write multiple registers, response"]
        );
        assert_eq!(found("", "61 request"), ["Set parameters, request"]);
        assert_eq!(found("memograph-rsg45", "write batch"), ["Write Batch"]);
        assert!(
            found("memograph-rsg45", "215 write")
                .contains(&"Write Universal channel at 200 to 319".to_owned())
        );
        assert_eq!(found("keb-f5-modbus", "0x5f00 read"), found("keb-f5-modbus", "5F00h read"));
        assert!(found("keb-f5-modbus", "5f00h read").contains(&"Read MDB_ProtCfg (FB.00)".to_owned()));
        assert_eq!(found("memograph-rsg45", "start batch"), ["Write Batch"]);
        assert!(found("", "no such thing").is_empty());
    }

    /// Nothing is offered twice under the same words.
    #[test]
    fn offers_are_told_apart() {
        for device in PROFILES {
            let labels: Vec<String> = offers(Some(device)).iter().map(|it| it.label().to_string()).collect();
            for (index, label) in labels.iter().enumerate() {
                let twice = labels[..index].contains(label);
                assert!(!twice, "{}: {label}", device.key);
            }
        }
    }
}
