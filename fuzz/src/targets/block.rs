use super::law::assert_tiled;
use super::{Target, USUAL_MEMORY};
use crate::{Input, make};
use buslens::tool::blocks;

/// Bytes that are no telegram.
pub static TARGET: Target = Target {
    key: "block",
    about: "bytes without a frame, as something of a device",
    share: 1,
    memory: USUAL_MEMORY,
    make: |random, seeds| [make::choices(random, CHOICES), make::block(random, seeds)].concat(),
    run,
};

const CHOICES: usize = 5;

fn run(data: &[u8]) {
    let mut input = Input::new(data, CHOICES);
    let (device, settings) = (input.device(), input.settings());
    let bytes = input.content();
    let found = blocks(bytes, device, &settings);
    assert!(found.is_sorted_by(|one, other| one.bits >= other.bits));
    for reading in &found {
        assert_tiled(&reading.fields, bytes);
        assert!(reading.bits > 0 || device.is_some());
        assert!(device.is_none_or(|device| device.key == reading.device.key));
        for said in [&reading.kind, &reading.said, &reading.reason] {
            assert!(!said.to_string().is_empty(), "{bytes:02X?}");
        }
    }
}
