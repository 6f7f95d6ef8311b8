use std::sync::LazyLock;

use super::{Target, USUAL_MEMORY};
use crate::{Input, make};
use buslens::field::{Format, Spec, number_text};
use buslens::tool::steps::{CHECKS, steps};
use buslens::tool::{Offer, PROFILES, offers, parse_value};

/// What is typed into finders and entries, and checks worked out by hand.
pub static TARGET: Target = Target {
    key: "word",
    about: "what is typed to find and to enter; checks step by step",
    share: 1,
    memory: USUAL_MEMORY,
    make: |random, seeds| {
        let words = if random.one_in(2) { make::words(random, " ") } else { make::telegram(random, seeds) };
        [make::choices(random, CHOICES), words].concat()
    },
    run,
};

static OFFERS: LazyLock<Vec<Vec<Offer>>> =
    LazyLock::new(|| PROFILES.iter().copied().map(|profile| offers(Some(profile))).collect());

static SPECS: [Spec; 6] = [
    Spec::new("number", "Number"),
    Spec::new("hex", "Hex").format(Format::Hex),
    Spec::new("address", "Address").format(Format::HexAddress),
    Spec::new("float", "Float").format(Format::Float),
    Spec::new("places", "Places").format(Format::Places(3)),
    Spec::new("register", "Register").format(Format::Register),
];

const CHOICES: usize = 12;

fn run(data: &[u8]) {
    let mut input = Input::new(data, CHOICES);
    let (how, which) = (input.byte(), input.byte());
    let spec = &SPECS[input.below(SPECS.len())];
    let width = match spec.format {
        Format::Float => [4, 8][input.below(2)],
        _ => 1 + input.below(8),
    };
    let raw = input.bytes(8).iter().fold(0_u64, |raw, byte| raw << 8 | u64::from(*byte))
        & u64::MAX >> (64 - 8 * width);
    let shown = number_text(raw, width, spec.format);
    assert_eq!(parse_value(&shown, width, spec), Ok(raw), "{shown} of {}", spec.key);
    let text = String::from_utf8_lossy(input.content());
    let _ = parse_value(&text, width, spec);
    if how & 15 == 0 {
        let offers = &OFFERS[usize::from(which) % OFFERS.len()];
        offers[usize::from(how) * offers.len() / 256].fits(&text);
        PROFILES[usize::from(which) % PROFILES.len()].addresses(&text);
        PROFILES[usize::from(which) % PROFILES.len()].shown(&text);
    }
    let check = CHECKS[usize::from(which) % CHECKS.len()];
    let bytes = input.content();
    let done = steps(check, bytes);
    let value = done.last().map_or(0, |step| step.after);
    let wire = check.wire(&bytes[..bytes.len().min(buslens::tool::steps::MOST)]);
    let swapped = if check.low_first { u64::from(value.swap_bytes()) } else { u64::from(value) };
    assert_eq!(swapped, wire, "{} of {bytes:02X?}", check.kind);
}
