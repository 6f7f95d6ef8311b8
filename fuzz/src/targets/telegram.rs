use super::law::{assert_exports, assert_telegram};
use super::{Target, USUAL_MEMORY};
use crate::{Input, make};
use buslens::field::hex;
use buslens::tool::byte::{itself, shares};
use buslens::tool::{Options, decode, views};

/// A telegram and a beginning of it with a device chosen, as it is typed.
pub static TARGET: Target = Target {
    key: "telegram",
    about: "telegrams and their beginnings with every device and protocol: details and exports",
    share: 3,
    memory: USUAL_MEMORY,
    make: |random, seeds| [make::choices(random, CHOICES), make::telegram(random, seeds)].concat(),
    run,
};

const CHOICES: usize = 12;

fn run(data: &[u8]) {
    let mut input = Input::new(data, CHOICES);
    let (how, at) = (input.byte(), input.byte());
    let mut options = Options { device: input.device(), ..input.options() };
    if how & 3 == 0 {
        options.protocol = Some(input.protocol());
    }
    let bytes = input.content();
    let cut = &bytes[..usize::from(at) % (bytes.len() + 1)];
    let text = match how >> 6 {
        0 => hex(bytes),
        1 => format!("{}\n{}", hex(bytes), hex(cut)),
        _ => hex(cut),
    };
    let report = decode(&text, options);
    for index in 0..report.telegrams.len().min(8) {
        assert_telegram(&report, index);
        if how & 12 == 0 {
            assert_exports(&report, index);
        }
        if how & 48 == 0 {
            let detail = report.detail(index).expect("every telegram has its detail");
            let bytes = &report.telegrams[index].line.bytes;
            shares(&detail, bytes, usize::from(at) % bytes.len().max(1));
            itself(at);
            views(bytes);
            report.layout(index);
        }
    }
    report.summary();
}
