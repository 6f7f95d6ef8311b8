use super::{Target, USUAL_MEMORY};
use crate::{Input, make};
use buslens::tool::Settings;
use buslens::tool::settings::{changed, from_bytes, read, write};
use buslens::tool::setup::{List, differences, put_back};

/// The lists of a device while somebody sets them up.
pub static TARGET: Target = Target {
    key: "setup",
    about: "lists of parameters set up row by row, and what is not as delivered put back",
    share: 1,
    memory: USUAL_MEMORY,
    make: |random, seeds| {
        let rows = 6 * random.below(12);
        let mut data = make::choices(random, rows);
        if random.one_in(4) {
            data.splice(0..0, make::telegram(random, seeds));
        }
        [vec![data.len().min(255) as u8], data].concat()
    },
    run,
};

fn run(data: &[u8]) {
    let mut input = Input::new(data, data.len());
    let mut settings = match input.byte() & 1 {
        0 => Settings::default(),
        _ => from_bytes(&data[1..]),
    };
    while !input.is_over() {
        let (what, index) = (input.byte(), usize::from(input.byte()) % 110);
        let list = List::ALL[usize::from(what >> 2) % List::ALL.len()];
        let parameter = u16::from_be_bytes([input.byte() % 0x3F, input.byte()]);
        match what & 3 {
            0 => list.remove(&mut settings, index),
            words => list.set(&mut settings, index, parameter, input.byte(), 1 + (words & 1)),
        }
        let rows = list.rows(&settings);
        assert!(rows.len() <= list.most().max(255), "{list:?}: {} rows", rows.len());
    }
    let again = read(&write(&settings)).expect("what is written is read");
    assert_eq!(changed(&again), changed(&settings));
    assert_eq!(differences(&again), differences(&settings));
    let mut left = differences(&settings);
    while let Some(first) = left.first() {
        assert!(!first.said.sentence().is_empty());
        put_back(&mut settings, first.what);
        let fewer = differences(&settings);
        assert!(fewer.len() < left.len(), "{:?} stays", first.said.to_string());
        left = fewer;
    }
}
