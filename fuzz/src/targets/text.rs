use super::law::{assert_exports, assert_telegram};
use super::{Target, USUAL_MEMORY};
use crate::{Input, make};
use buslens::tool::{annotated, decode};

/// Any text as somebody pastes it.
pub static TARGET: Target = Target {
    key: "text",
    about: "pasted text: places within it, and the laws of telegrams for what is found",
    share: 3,
    memory: USUAL_MEMORY,
    make: |random, seeds| [make::choices(random, CHOICES), make::text(random, seeds)].concat(),
    run,
};

const CHOICES: usize = 8;

fn run(data: &[u8]) {
    let mut input = Input::new(data, CHOICES);
    let (how, options) = (input.byte(), input.options());
    let text = String::from_utf8_lossy(input.content());
    let report = decode(&text, options);
    for line in report.lines() {
        assert_eq!(line.bytes.len(), line.places.len(), "{text:?}");
        for place in line.places.iter().chain(line.remarks.iter().map(|remark| &remark.span)) {
            assert!(text.get(place.from..place.to).is_some(), "{place:?} of {text:?}");
        }
        // Of words whose low byte comes first, the halves are the other way round.
        let ordered = line.places.is_sorted_by(|one, other| one.from <= other.from || other.to == one.from);
        assert!(ordered, "places of {text:?}");
    }
    for index in 0..report.telegrams.len().min(4) {
        assert_telegram(&report, index);
        if how & 7 == 0 {
            assert_exports(&report, index);
        }
    }
    if how & 56 == 0 {
        annotated::text(&report);
    }
    let summary = report.summary();
    assert_eq!(summary.telegrams, report.telegrams.len());
    assert!(summary.lines_not_understood <= summary.lines.max(1), "{text:?}");
}
