//! Which device telegrams look like, where nobody chose one.

use super::decode::{Options, Report, Telegram};
use super::{PROFILES, Profile, Verdict};
use crate::device::likelihood;
use crate::field::{Argument, Message, Role, count};
use crate::message;

/// A device that the telegrams of a unit read well as.
#[derive(Clone, Debug)]
pub struct Proposal {
    pub unit: Option<u8>,
    pub device: &'static Profile,
    /// "unit 5 reads well as a Memograph: 5 blocks with good status".
    pub text: Message,
    /// The indices of the telegrams that speak for it.
    pub evidence: Vec<usize>,
    /// How much speaks for it, in bits of chance.
    pub bits: i32,
}

/// For each unit the device that its telegrams read best as, where enough speaks for one; none where a
/// person chose a device. One unit can be a recorder and another a drive.
pub fn proposals(report: &Report) -> Vec<Proposal> {
    let mut units: Vec<Option<u8>> = Vec::new();
    if report.options.device.is_none() {
        for telegram in &report.telegrams {
            let known = report.options.device_of(telegram.unit).is_some();
            if !known && !units.contains(&telegram.unit) {
                units.push(telegram.unit);
            }
        }
    }
    let of_unit = |unit| {
        let read = PROFILES.iter().filter_map(|profile| propose(report, unit, profile));
        read.max_by_key(|proposal| proposal.bits)
    };
    units.into_iter().filter_map(of_unit).collect()
}

/// So many telegrams of a unit are looked at.
const MOST: usize = 300;

/// So much has to speak for a device.
const ENOUGH: i32 = 14;

/// What speaks against it.
const STRANGE: i32 = 6;

fn propose(report: &Report, unit: Option<u8>, device: &'static Profile) -> Option<Proposal> {
    let own = |telegram: &&Telegram| telegram.unit == unit && telegram.verdict != Verdict::Wrong;
    let chosen: Vec<usize> =
        (0..report.telegrams.len()).filter(|index| own(&&report.telegrams[*index])).take(MOST).collect();
    let read_as = report.read_as(&chosen, Options { device: Some(device), ..report.options.clone() });
    let (mut bits, mut good, mut named, mut unique, mut evidence) = (0, 0, 0, 0, Vec::new());
    for (at, index) in chosen.iter().enumerate() {
        let detail = read_as.detail(at)?;
        // What speaks Modbus is no station of PROFIBUS, whatever the addresses look like.
        if device.functions.is_empty() && detail.function.is_some() {
            continue;
        }
        let mut own = 0;
        let strange = [
            "not-in-manual",
            "not-listed",
            "function-not-listed",
            "too-many-for-device",
            "block-cut",
            "no-such-subindex",
        ];
        let against = detail.device.problems().filter(|problem| strange.contains(&problem.code)).count();
        if against > 0 {
            own -= STRANGE;
        }
        for block in detail.device.blocks.iter().filter(|_| against == 0) {
            let fields = std::slice::from_ref(&block.field);
            let has_status = block.field.children.iter().any(|child| child.spec.role == Role::Status);
            // A name of its own says more than that a range has the address.
            if !block.id.is_empty() {
                (own, named) = (own + 3, named + 1);
            } else if block.to > block.from {
                (own, named) = (own + 2, named + 1);
            }
            if has_status {
                own += likelihood(fields);
                good +=
                    usize::from(block.status().is_some_and(|status| status.to_string().starts_with("good")));
            }
        }
        // Only the maker's own devices know these.
        if detail.function.is_some_and(|function| function >= 100 && device.functions.contains(&function)) {
            (own, unique) = (own + 8, unique + 1);
        }
        if device.ident.is_some() && detail.fields_hold("Ident number", device.ident.map(u64::from)) {
            (own, unique) = (own + 16, unique + 1);
        }
        bits += own;
        if own > 0 {
            evidence.push(*index);
        }
    }
    let who = match unit {
        Some(unit) => message!("unit {n}", n = unit),
        None => message!("what was said"),
    };
    let what = match (good, named) {
        (0, 0) => message!("{n} that only it knows", n = count(unique, "telegram")),
        (0, named) => message!("{n} of its manual", n = count(named, "name")),
        (good, _) => message!("{n} with good status", n = count(good, "block")),
    };
    (bits >= ENOUGH).then(|| Proposal {
        unit,
        device,
        text: message!(
            "{who} reads well as {device}: {what}",
            who = who,
            device = Argument::Term(device.label),
            what = what
        ),
        evidence,
        bits,
    })
}
