use super::{Target, USUAL_MEMORY};
use crate::{Input, make};
use buslens::field::hex;
use buslens::tool::{Options, Protocol, Verdict, decode};

/// Possible causes to a telegram whose check fails.
pub static TARGET: Target = Target {
    key: "cause",
    about: "causes of failed checks: each would make the check right",
    share: 2,
    memory: USUAL_MEMORY,
    make: |random, seeds| {
        let mut bytes = seeds.telegrams[random.below(seeds.telegrams.len())].clone();
        make::change(random, &mut bytes, seeds);
        bytes.truncate(80);
        [make::choices(random, CHOICES), bytes].concat()
    },
    run,
};

const CHOICES: usize = 2;

fn run(data: &[u8]) {
    let mut input = Input::new(data, CHOICES);
    let protocol = ["modbus-rtu", "modbus-ascii", "profibus-fdl", ""][input.below(4)];
    let device = input.device();
    let bytes = input.content();
    let report =
        decode(&hex(bytes), Options { protocol: Protocol::of(protocol), device, ..Options::default() });
    for index in 0..report.telegrams.len().min(2) {
        let telegram = &report.telegrams[index];
        let found = &telegram.line.bytes;
        report.undecidable(index);
        for explanation in report.explanations(index) {
            let hypothesis = &explanation.hypothesis;
            assert!(!hypothesis.text(found).sentence().is_empty());
            let right = buslens::tool::PROTOCOLS
                .iter()
                .any(|protocol| (protocol.verdict)(&hypothesis.bytes) == Verdict::Right)
                || hypothesis.cause.key() == "other-protocol";
            assert!(right, "{} makes {} of {}", hypothesis.cause.key(), hex(&hypothesis.bytes), hex(found));
            assert!(explanation.removed.iter().all(|span| span.from <= span.to && span.to <= found.len()));
            assert!(explanation.added.iter().all(|span| span.to <= hypothesis.bytes.len()));
        }
    }
}
