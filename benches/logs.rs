//! `cargo bench --bench logs`: what reading logs costs, beside other crates that split telegrams in the
//! same run.
//!
//! The stream has 200,000 telegrams of functions 1 to 6, 15 and 16, requests and responses in turn, as
//! all three can split them. rmodbus and modbus-core are told what comes, request or response; Buslens
//! finds that out, checks, pairs and keeps an index.

use std::hint::black_box;

use buslens::dialogue::traffic::{Chunk, Traffic};
use buslens::field::hex;
use buslens::frame::{Settings, modbus_rtu};
use buslens::tool::Options;
use buslens::tool::log::{Log, Reading};
use buslens::walk::CRC_16_MODBUS;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use rmodbus::server::ModbusFrame;
use rmodbus::{ModbusProto, guess_request_frame_len, guess_response_frame_len};

const TELEGRAMS: usize = 200_000;

/// Requests and responses in turn, each with its length.
fn telegrams() -> Vec<Vec<u8>> {
    let mut state = 1_u64;
    let mut random = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize
    };
    let with_check = |body: &[u8]| {
        let check = CRC_16_MODBUS.wire(body) as u16;
        [body, &check.to_be_bytes()].concat()
    };
    let mut telegrams = Vec::with_capacity(TELEGRAMS);
    while telegrams.len() < TELEGRAMS {
        let function = [1_u8, 2, 3, 3, 3, 4, 5, 6, 15, 16][random() % 10];
        let unit = 1 + (random() % 20) as u8;
        let count = 1 + random() % 8;
        let start = (random() as u16 & 0x0FFF).to_be_bytes();
        let data: Vec<u8> = (0..2 * count).map(|_| random() as u8).collect();
        let asks = [&[unit, function][..], &start, &[0, count as u8]].concat();
        let (request, response) = match function {
            1 | 2 => (asks, vec![unit, function, 1, data[0]]),
            3 | 4 => (asks, [&[unit, function, data.len() as u8][..], &data].concat()),
            5 => {
                let both = [&[unit, function][..], &start, &[0xFF, 0]].concat();
                (both.clone(), both)
            }
            6 => {
                let both = [&[unit, function][..], &start, &data[..2]].concat();
                (both.clone(), both)
            }
            15 => ([&asks[..], &[1, data[0]]].concat(), asks),
            _ => ([&asks[..], &[data.len() as u8], &data].concat(), asks),
        };
        telegrams.extend([with_check(&request), with_check(&response)]);
    }
    telegrams
}

fn streams(c: &mut Criterion) {
    let telegrams = telegrams();
    let stream: Vec<u8> = telegrams.concat();
    let mut group = c.benchmark_group("a stream of 200,000 telegrams");
    group.throughput(Throughput::Elements(TELEGRAMS as u64)).sample_size(20);
    group.bench_function("buslens: split, checked, paired, indexed", |b| {
        b.iter(|| {
            let mut traffic = Traffic::new(&modbus_rtu::PROTOCOL, &Settings::default());
            traffic.stream();
            traffic.take(Chunk { bytes: black_box(&stream), joins: true, ..Chunk::default() });
            traffic.finish();
            assert_eq!(traffic.entries().len(), TELEGRAMS);
            traffic
        });
    });
    group.bench_function("rmodbus: split", |b| {
        b.iter(|| {
            let (mut at, mut count, mut asks) = (0, 0, true);
            while at < stream.len() {
                let rest = black_box(&stream[at..stream.len().min(at + 256)]);
                let guess = if asks { guess_request_frame_len } else { guess_response_frame_len };
                let Ok(length) = guess(rest, ModbusProto::Rtu) else { break };
                (at, count, asks) = (at + usize::from(length), count + 1, !asks);
            }
            assert_eq!(count, TELEGRAMS);
        });
    });
    group.bench_function("rmodbus: split, requests checked", |b| {
        b.iter(|| {
            let (mut at, mut count, mut asks) = (0, 0, true);
            let mut response = Vec::new();
            while at < stream.len() {
                let rest = black_box(&stream[at..stream.len().min(at + 256)]);
                let guess = if asks { guess_request_frame_len } else { guess_response_frame_len };
                let Ok(length) = guess(rest, ModbusProto::Rtu) else { break };
                let telegram = &rest[..usize::from(length)];
                if asks {
                    let mut frame = ModbusFrame::new(telegram[0], telegram, ModbusProto::Rtu, &mut response);
                    assert!(frame.parse().is_ok());
                }
                (at, count, asks) = (at + usize::from(length), count + 1, !asks);
            }
            assert_eq!(count, TELEGRAMS);
        });
    });
    group.bench_function("modbus-core: split and checked", |b| {
        use modbus_core::rtu::{extract_frame, request_pdu_len, response_pdu_len};
        b.iter(|| {
            let (mut at, mut count, mut asks) = (0, 0, true);
            while at < stream.len() {
                let rest = black_box(&stream[at..stream.len().min(at + 256)]);
                // Version 0.2 misreads how long a request of function 15 or 16 is: it is told.
                let told = match (asks, rest[1]) {
                    (true, 15 | 16) => Ok(Some(telegrams[count].len() - 3)),
                    (true, _) => request_pdu_len(rest),
                    (false, _) => response_pdu_len(rest),
                };
                let Ok(Some(length)) = told else { break };
                let Ok(Some(_)) = extract_frame(rest, length) else { break };
                (at, count, asks) = (at + length + 3, count + 1, !asks);
            }
            assert_eq!(count, TELEGRAMS);
        });
    });
    group.finish();
}

fn texts(c: &mut Criterion) {
    let telegrams = telegrams();
    let text: String = telegrams
        .iter()
        .zip(0_usize..)
        .map(|(bytes, n)| {
            format!(
                "{:02}:{:02}:{:02}.{:03} {}: {}\n",
                n / 180_000 % 24,
                n / 3000 % 60,
                n / 50 % 60,
                n % 50 * 20,
                ["Tx", "Rx"][n % 2],
                hex(bytes)
            )
        })
        .collect();
    let mut group = c.benchmark_group("a log as text");
    group.throughput(Throughput::Bytes(text.len() as u64)).sample_size(10);
    group.bench_function("200,000 lines", |b| {
        b.iter(|| Log::read(black_box(text.as_bytes()), &Reading::default(), Options::default()));
    });
    group.finish();
}

criterion_group!(benches, streams, texts);
criterion_main!(benches);
