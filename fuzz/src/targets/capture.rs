use super::law::assert_same;
use super::log::{read, show};
use super::{Target, USUAL_MEMORY};
use crate::{Input, make};
use buslens::tool::Options;
use buslens::tool::log::{Input as Kind, Reading};

/// Captures of networks, whole and in pieces.
pub static TARGET: Target = Target {
    key: "capture",
    about: "captures of networks: whole as in pieces of any cut",
    share: 2,
    memory: USUAL_MEMORY,
    make: |random, seeds| [make::choices(random, CHOICES), make::capture(random, seeds)].concat(),
    run,
};

const CHOICES: usize = 5;

fn run(data: &[u8]) {
    let mut input = Input::new(data, CHOICES);
    let (how, device) = (input.byte(), input.device());
    let cuts = [input.byte(), input.byte(), input.byte()];
    let file = input.content();
    let reading =
        Reading { input: if how & 128 != 0 { Kind::Auto } else { Kind::Capture }, ..Reading::default() };
    let options = Options { device, ..Options::default() };
    let Some(whole) = read(file, &reading, &options, &[]) else { return };
    let mut at = cuts.map(|cut| usize::from(cut) * 3 % file.len().max(1));
    at.sort_unstable();
    let parts = read(file, &reading, &options, &at).expect("a file that is read is read in parts");
    assert_same(&parts, &whole, file, &format!("in parts that end at {at:?}"));
    show(&whole, file, how);
}
