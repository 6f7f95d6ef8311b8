use std::sync::LazyLock;

use super::{Target, USUAL_MEMORY};
use crate::{Input, make};
use buslens::field::hex;
use buslens::frame::split::{Begins, Place, Splitter, Waiting};
use buslens::modbus::DIALECTS;
use buslens::tool::{Protocol, Verdict};

/// What begins at a place of a stream does not depend on how much of it has come.
pub static TARGET: Target = Target {
    key: "splitter",
    about: "what begins in a stream, for every beginning of it",
    share: 1,
    memory: USUAL_MEMORY,
    make: |random, seeds| [make::choices(random, CHOICES), make::stream(random, seeds)].concat(),
    run,
};

static SPLITTERS: LazyLock<Vec<Splitter>> =
    LazyLock::new(|| DIALECTS.iter().map(|dialect| Splitter::new(dialect)).collect());

const CHOICES: usize = 6;

fn run(data: &[u8]) {
    let mut input = Input::new(data, CHOICES);
    let splitter = &SPLITTERS[input.below(DIALECTS.len())];
    let key = ["modbus-rtu", "modbus-tcp", "profibus-fdl"][input.below(3)];
    let protocol = Protocol::of(key).expect("a protocol of this key");
    let (flags, unit) = (input.byte(), input.byte());
    let (function, length) = (input.byte(), input.byte());
    let bytes = input.content();
    let waiting = (flags & 2 != 0).then(|| Waiting {
        unit: if flags & 4 != 0 { bytes.first().copied().unwrap_or(unit) } else { unit },
        function: if flags & 4 != 0 { bytes.get(1).copied().unwrap_or(function) & 0x7F } else { function },
        length: (flags & 8 != 0).then_some(length.into()),
    });
    let begins = |bytes, last| {
        let place = Place { bytes, last, in_step: flags & 1 != 0, waiting: waiting.as_ref() };
        splitter.begins(protocol, place)
    };
    let whole = begins(bytes, false);
    for cut in 0..bytes.len() {
        let beginning = begins(&bytes[..cut], false);
        assert!(
            beginning == Begins::More || beginning == whole,
            "{key}: {whole:?} begins with {beginning:?} of {cut} bytes: {}",
            hex(bytes)
        );
    }
    let last = begins(bytes, true);
    assert_ne!(last, Begins::More, "{}", hex(bytes));
    assert!(whole == Begins::More || last == whole, "{}", hex(bytes));
    if let Begins::Telegram(length) = last {
        assert!((1..=bytes.len()).contains(&length), "{length} of {}", hex(bytes));
        assert_ne!((protocol.verdict)(&bytes[..length]), Verdict::Wrong, "{}", hex(bytes));
    }
    assert!(splitter.covered(protocol, bytes) <= bytes.len());
}
