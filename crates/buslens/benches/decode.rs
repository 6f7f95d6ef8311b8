//! `cargo bench`: what reading costs. The figures that the README promises come from here.

use std::hint::black_box;

use buslens::field::{Direction, hex};
use buslens::frame::Verdict;
use buslens::frame::modbus_rtu::RTU;
use buslens::tool::{Options, decode};
use buslens::walk;
use criterion::{Criterion, criterion_group, criterion_main};

/// A response with 125 registers, as long as they get: 255 bytes, and its check.
fn longest_response() -> Vec<u8> {
    let mut bytes = vec![1, 3, 250];
    bytes.extend((0..250).map(|n| n as u8));
    let check = walk::CRC_16_MODBUS.wire(&bytes);
    bytes.extend_from_slice(&(check as u16).to_be_bytes());
    bytes
}

fn one_telegram(c: &mut Criterion) {
    let bytes = longest_response();
    assert_eq!(RTU.verdict(&bytes), Verdict::Right);
    c.bench_function("255 bytes into the tree of fields", |b| {
        b.iter(|| {
            let mut rtu = RTU.expect(black_box(&bytes), Direction::Response, &buslens::modbus::STANDARD);
            walk::read(&mut rtu, &bytes)
        });
    });
    let text = hex(&bytes);
    c.bench_function("255 bytes of text, decoded with all details", |b| {
        b.iter(|| decode(black_box(&text), Options::default()).detail(0));
    });
}

fn many_lines(c: &mut Criterion) {
    let text = "01 03 00 C8 00 03 84 35\n".repeat(100_000 / 24);
    c.bench_function("100,000 characters, a telegram a line", |b| {
        b.iter(|| decode(black_box(&text), Options::default()));
    });
}

fn a_failed_check(c: &mut Criterion) {
    let mut bytes = longest_response();
    bytes[100] ^= 0x55;
    let report = decode(&hex(&bytes), Options::default());
    assert!(!report.explanations(0).is_empty());
    c.bench_function("255 bytes with a changed one, explained", |b| {
        b.iter(|| report.explanations(black_box(0)))
    });
}

criterion_group!(benches, one_telegram, many_lines, a_failed_check);
criterion_main!(benches);
