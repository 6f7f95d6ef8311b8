use crate::field::Message;
use crate::frame::{Fit, PROTOCOLS, Protocol, Settings};
use crate::message;

/// The protocol of a telegram, with those that it could be as well.
#[derive(Clone, Debug)]
pub struct Choice {
    pub protocol: &'static Protocol,
    /// What speaks for it.
    pub reason: Message,
    /// What else fits, best first.
    pub others: Vec<(&'static Protocol, Fit)>,
}

/// A telegram whose protocol is to be told.
#[derive(Clone, Copy, Debug)]
pub struct Candidate<'a> {
    pub bytes: &'a [u8],
    /// The text says which, as the colon of Modbus ASCII does.
    pub written_as: Option<&'static Protocol>,
}

/// So many bits are proof: a telegram counts by itself, whatever those around it are.
const PROOF: u32 = 16;

/// What the others' protocol counts for, in bits, where a telegram's own bytes prove none.
const COMPANY: u32 = 4;

/// What the choice of a device counts for.
const DEVICE: u32 = 8;

/// The same where some of the others prove it.
const PROVEN_COMPANY: u32 = 12;

/// Tells the protocol of each telegram: by its own bytes where they prove it, else by what fits
/// all telegrams together best.
pub fn protocols(telegrams: &[Candidate<'_>], settings: &Settings) -> Vec<Choice> {
    let fits: Vec<Vec<Fit>> = telegrams
        .iter()
        .map(|telegram| PROTOCOLS.iter().map(|protocol| fit(protocol, telegram.bytes, settings)).collect())
        .collect();
    let mut together = vec![0; PROTOCOLS.len()];
    for fits in &fits {
        for (sum, fit) in together.iter_mut().zip(fits) {
            *sum += fit.bits;
        }
    }
    let common = best(together.iter().copied());
    let proven = fits.iter().any(|fits| fits[common].bits >= PROOF);
    let company = if proven { PROVEN_COMPANY } else { COMPANY };
    telegrams
        .iter()
        .zip(fits)
        .map(|(telegram, fits)| choose(telegram, fits, common, (together[common], company)))
        .collect()
}

/// How well bytes fit a protocol, with what the device that is chosen speaks for or against it.
fn fit(protocol: &Protocol, bytes: &[u8], settings: &Settings) -> Fit {
    let mut fit = (protocol.fit)(bytes, settings);
    // What a check proves, no choice takes away.
    if let (Some(bus), 1..PROOF) = (settings.bus, fit.bits) {
        fit.bits = if bus == protocol.bus() { fit.bits + DEVICE } else { fit.bits.saturating_sub(DEVICE) };
    }
    fit
}

/// `common` is the protocol that fits all telegrams best, by so many bits `together`; it counts for
/// so many bits `company`.
fn choose(
    telegram: &Candidate<'_>,
    fits: Vec<Fit>,
    common: usize,
    (together, company): (u32, u32),
) -> Choice {
    let own = best(fits.iter().map(|fit| fit.bits));
    let (chosen, reason) = match telegram.written_as {
        Some(protocol) => (protocol, message!("it is written as one: a colon and hex digits")),
        None if fits[own].bits >= PROOF || fits[own].bits > fits[common].bits + company => {
            (PROTOCOLS[own], fits[own].reason.clone())
        }
        None if fits[common].bits > 0 => (PROTOCOLS[common], fits[common].reason.clone()),
        None if together == 0 => (PROTOCOLS[own], fits[own].reason.clone()),
        None => (PROTOCOLS[common], message!("its neighbours are of this protocol, and nothing fits better")),
    };
    let mut others: Vec<(&'static Protocol, Fit)> = Vec::new();
    for (protocol, fit) in PROTOCOLS.iter().copied().zip(fits) {
        if fit.bits > COMPANY && !protocol.is(chosen) {
            let at = others.partition_point(|(_, other)| other.bits >= fit.bits);
            others.insert(at, (protocol, fit));
        }
    }
    Choice { protocol: chosen, reason, others }
}

/// The first of the largest.
fn best(bits: impl Iterator<Item = u32>) -> usize {
    let mut best = (0, 0);
    for (index, bits) in bits.enumerate() {
        if bits > best.1 {
            best = (index, bits);
        }
    }
    best.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(lines: &[&[u8]]) -> Vec<&'static str> {
        let candidates: Vec<_> = lines.iter().map(|bytes| Candidate { bytes, written_as: None }).collect();
        protocols(&candidates, &Settings::default()).iter().map(|choice| choice.protocol.key).collect()
    }

    #[test]
    fn each_protocol_is_told() {
        assert_eq!(told(&[&[1, 3, 0, 200, 0, 3, 0x84, 0x35]]), ["modbus-rtu"]);
        assert_eq!(told(&[&[0, 1, 0, 0, 0, 6, 255, 3, 0, 200, 0, 3]]), ["modbus-tcp"]);
        assert_eq!(told(&[&[3, 0, 200, 0, 3]]), ["modbus-pdu"]);
        assert_eq!(told(&[&[2, 3, 0, 200, 0, 5, 0x2E]]), ["modbus-ascii"]);
    }

    #[test]
    fn a_failed_check_does_not_make_another_protocol() {
        assert_eq!(told(&[&[1, 3, 0, 200, 0, 3, 0x84, 0x36]]), ["modbus-rtu"]);
        assert_eq!(told(&[&[1, 3]]), ["modbus-rtu"]);
        assert_eq!(told(&[&[]]), ["modbus-rtu"]);
    }

    #[test]
    fn the_others_tell_what_one_leaves_open() {
        let tcp: &[u8] = &[0, 1, 0, 0, 0, 6, 255, 3, 0, 200, 0, 3];
        let cut: &[u8] = &[0, 2, 0, 0, 0, 6, 255, 3, 0];
        let rtu: &[u8] = &[1, 3, 0, 200, 0, 3, 0x84, 0x35];
        assert_eq!(told(&[tcp, cut, rtu]), ["modbus-tcp", "modbus-tcp", "modbus-rtu"]);
    }
}
