//! Inputs: random ones, and seeds with changes.

use std::time::{Duration, Instant};

use buslens::field::hex;
use buslens::frame::Cargo;
use buslens::modbus::{DIALECTS, KINDS};
use buslens::profibus;
use buslens::tool::PROTOCOLS;
use buslens::walk::{self, CRC_16_MODBUS, Deviations};

use crate::seeds::{ASKED, Exchange, WORDS};
use crate::{Random, Seeds};

/// Random bytes to choose by, see [`Input`](crate::Input).
pub fn choices(random: &mut Random, count: usize) -> Vec<u8> {
    (0..count).map(|_| random.byte()).collect()
}

/// A telegram: a seed, one made of a kind, or random bytes; mostly changed a little.
pub fn telegram(random: &mut Random, seeds: &Seeds) -> Vec<u8> {
    let mut bytes = match random.below(8) {
        0..=3 => seeds.telegrams[random.below(seeds.telegrams.len())].clone(),
        4..=6 => made(random),
        _ => {
            let count = [3, 8, 20, 300][random.below(4)];
            choices(random, count)
        }
    };
    if !random.one_in(4) {
        change(random, &mut bytes, seeds);
    }
    if random.one_in(4) && bytes.len() > 3 {
        // What is changed mostly has a wrong check, and then little of it counts.
        let at = bytes.len() - 2;
        let check = (CRC_16_MODBUS.wire(&bytes[..at]) as u16).to_be_bytes();
        bytes[at..].copy_from_slice(&check);
    }
    bytes
}

/// A telegram of some kind with random values that keep their limits, in some frame.
fn made(random: &mut Random) -> Vec<u8> {
    let dialect = DIALECTS[random.below(DIALECTS.len())];
    let cargo = if random.one_in(3) {
        let kind = profibus::KINDS[random.below(profibus::KINDS.len())];
        Cargo::Profibus(kind, (kind.new)(&profibus::Settings::default()))
    } else {
        let kinds = if random.one_in(8) && !dialect.kinds.is_empty() { dialect.kinds } else { KINDS };
        Cargo::Modbus(kinds[random.below(kinds.len())].pdu(dialect))
    };
    let protocol = PROTOCOLS[random.below(PROTOCOLS.len())];
    let Some(mut frame) = (protocol.carry)(random.byte(), cargo) else { return Vec::new() };
    walk::sample(frame.as_mut(), &mut |most| match most {
        u64::MAX => random.number(),
        most => random.number() % (most + 1),
    });
    walk::write(frame.as_mut(), &Deviations::default())
}

/// Changes a few things in bytes.
pub fn change(random: &mut Random, bytes: &mut Vec<u8>, seeds: &Seeds) {
    for _ in 0..=random.below(3) {
        let at = random.below(bytes.len() + 1);
        let to = (at + 1 + random.below(8)).min(bytes.len());
        match random.below(10) {
            0 | 1 if at < bytes.len() => bytes[at] ^= 1 << random.below(8),
            2 | 3 if at < bytes.len() => bytes[at] = [0, 1, 0x7F, 0x80, 0xFF, random.byte()][random.below(6)],
            4 => bytes.truncate(at),
            5 if at < to => drop(bytes.drain(at..to)),
            6 => bytes.insert(at, random.byte()),
            7 if at < to => {
                let again = bytes[at..to].to_vec();
                bytes.splice(at..at, again);
            }
            8 if at < bytes.len() => bytes[at] = bytes[at].wrapping_add(random.byte() % 8).wrapping_sub(4),
            _ => {
                let other = &seeds.telegrams[random.below(seeds.telegrams.len())];
                let from = random.below(other.len() + 1);
                bytes.splice(at..at, other[from..].iter().take(40).copied());
            }
        }
    }
}

/// Text of words, telegrams, and what is between them.
pub fn text(random: &mut Random, seeds: &Seeds) -> Vec<u8> {
    let mut text = String::new();
    for _ in 0..1 + random.below(6) {
        match random.below(4) {
            0 => (0..1 + random.below(4)).for_each(|_| text.push_str(random.of(WORDS))),
            1 => line(random, seeds, &mut text),
            _ => {
                let bytes = telegram(random, seeds);
                written(random, &bytes, &mut text);
            }
        }
    }
    let mut bytes = text.into_bytes();
    disturb(random, &mut bytes);
    bytes
}

/// A log: lines of one layout, some of them disturbed.
pub fn log(random: &mut Random, seeds: &Seeds) -> Vec<u8> {
    let head = random.of(WORDS);
    let mut text = String::new();
    for _ in 0..2 + random.below(5) {
        if !random.one_in(3) {
            text.push_str(head);
        }
        line(random, seeds, &mut text);
        if random.one_in(6) {
            text.push_str(random.of(WORDS));
            text.push('\n');
        }
    }
    let mut bytes = text.into_bytes();
    if random.one_in(3) {
        disturb(random, &mut bytes);
    }
    if random.one_in(12) {
        let text = String::from_utf8_lossy(&bytes).into_owned();
        bytes = [0xFEFF].into_iter().chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect();
    }
    bytes
}

/// Telegrams one behind the other, with something between them now and then.
pub fn stream(random: &mut Random, seeds: &Seeds) -> Vec<u8> {
    let mut bytes = Vec::new();
    for _ in 0..1 + random.below(5) {
        bytes.extend(telegram(random, seeds));
        if random.one_in(4) {
            let noise = random.below(6);
            bytes.extend(choices(random, noise));
        }
    }
    bytes
}

/// A capture with a packet for each of a few telegrams or parts of them.
pub fn capture(random: &mut Random, seeds: &Seeds) -> Vec<u8> {
    let ng = random.one_in(2);
    let mut file = if ng { section() } else { header() };
    let mut sequence = [100_u32, 100];
    for _ in 0..1 + random.below(5) {
        let way = random.below(2);
        let payload = telegram(random, seeds);
        let gap = if random.one_in(6) { random.below(9) as u32 } else { 0 };
        sequence[way] = sequence[way].wrapping_add(gap);
        let packet = packet(way, sequence[way], &payload[..payload.len().min(300)]);
        sequence[way] = sequence[way].wrapping_add(payload.len() as u32);
        let time = random.number() >> random.below(64);
        file.extend(if ng { packet_block(time, &packet) } else { record(time, &packet) });
    }
    if random.one_in(2) {
        change(random, &mut file, seeds);
    }
    file
}

fn header() -> Vec<u8> {
    [0xA1B2_C3D4_u32, 0x0002_0004, 0, 0, 65_535, 1].map(u32::to_be_bytes).concat()
}

fn record(time: u64, packet: &[u8]) -> Vec<u8> {
    let length = packet.len() as u32;
    [&[time as u32, (time >> 44) as u32, length, length].map(u32::to_be_bytes).concat(), packet].concat()
}

fn section() -> Vec<u8> {
    let words =
        [0x0A0D_0D0A_u32, 28, 0x1A2B_3C4D, 0x0001_0000, u32::MAX, u32::MAX, 28, 1, 20, 0x0001_0000, 0, 20];
    words.map(u32::to_be_bytes).concat()
}

fn packet_block(time: u64, packet: &[u8]) -> Vec<u8> {
    let (length, padded) = (packet.len() as u32, packet.len().next_multiple_of(4));
    let whole = 32 + padded as u32;
    let words = [6, whole, 0, (time >> 32) as u32, time as u32, length, length].map(u32::to_be_bytes);
    [words.as_flattened(), packet, &vec![0; padded - packet.len()], &whole.to_be_bytes()].concat()
}

/// Ethernet, IPv4 and TCP around what one end sends.
fn packet(way: usize, sequence: u32, payload: &[u8]) -> Vec<u8> {
    let mut ends = [[10, 0, 0, 5], [10, 0, 0, 9]];
    let mut ports = [49_152_u16, 502];
    if way == 1 {
        ends.reverse();
        ports.reverse();
    }
    let length = (40 + payload.len()) as u16;
    [
        &[2, 0, 0, 0, 0, 1, 2, 0, 0, 0, 0, 2, 8, 0, 0x45, 0][..],
        &length.to_be_bytes(),
        &[0, 0, 0, 0, 64, 6, 0, 0],
        ends.as_flattened(),
        &ports.map(u16::to_be_bytes).concat(),
        &sequence.to_be_bytes(),
        &[0, 0, 0, 0, 0x50, 16, 0xFF, 0xFF, 0, 0, 0, 0],
        payload,
    ]
    .concat()
}

/// Bytes without a frame: what stands in a telegram behind its head, values, or anything.
pub fn block(random: &mut Random, seeds: &Seeds) -> Vec<u8> {
    /// States, values, entries of mappings and heads of channels as devices have them.
    const VALUES: &[&[u8]] = &[
        &[0x00, 0x80],
        &[0x02, 0x80],
        &[0x00, 0x40],
        &[0x42, 0xA4, 0xF1, 0xDE],
        &[0x40, 0x54, 0x9E, 0x3B, 0xC0, 0, 0, 0],
        &[0x7F, 0xC0, 0, 0],
        &[0, 0],
        &[0, 0, 0, 0],
        &[0xFF, 0xFF],
        &[0x00, 0x33, 0x01, 0x01],
        &[0x41, 0x00, 0x23, 0x00],
        &[0xB7, 0xA3, 0x93],
        &[0x88, 0x01, 0x0A, 0x0B, 0x05, 0xEB, 0x00],
    ];
    let mut bytes = Vec::new();
    if random.one_in(3) {
        let telegram = telegram(random, seeds);
        let from = random.below(telegram.len() + 1).min(8);
        bytes.extend(&telegram[from..telegram.len().min(80)]);
    } else {
        (0..1 + random.below(6)).for_each(|_| bytes.extend(random.of(VALUES)));
    }
    if random.one_in(2) {
        change(random, &mut bytes, seeds);
    }
    bytes
}

/// Requests of one device in its words, each with what comes back, a line each: some over and over.
pub fn conversation(random: &mut Random, seeds: &Seeds) -> Vec<u8> {
    let exchanges = &seeds.exchanges[random.below(seeds.exchanges.len())];
    let few: Vec<&Exchange> =
        (0..1 + random.below(3)).map(|_| &exchanges[random.below(exchanges.len())]).collect();
    let mut text = String::new();
    for _ in 0..1 + random.below(5) {
        let exchange = few[random.below(few.len())];
        let mut said = vec![exchange.request.clone()];
        if let Some(mut reply) = exchange.replies.get(random.below(2).min(exchange.replies.len())).cloned() {
            valued(random, &mut reply);
            said.push(reply);
        }
        for mut bytes in said {
            if random.one_in(12) {
                change(random, &mut bytes, seeds);
            }
            text.push_str(&hex(&bytes));
            text.push('\n');
        }
    }
    text.into_bytes()
}

/// Gives a response other values, and the check that belongs to them.
fn valued(random: &mut Random, bytes: &mut [u8]) {
    let Some(length) = bytes.len().checked_sub(2).filter(|length| *length > 3) else { return };
    let checked = CRC_16_MODBUS.wire(&bytes[..length])
        == u64::from(u16::from_be_bytes([bytes[length], bytes[length + 1]]));
    let end = if checked { length } else { length + 2 };
    for byte in &mut bytes[3..end] {
        if random.one_in(3) {
            *byte = [0, 0x80, 0x42, 0x7F, 0xC0, random.byte()][random.below(6)];
        }
    }
    if checked {
        let check = (CRC_16_MODBUS.wire(&bytes[..length]) as u16).to_be_bytes();
        bytes[length..].copy_from_slice(&check);
    }
}

/// What somebody types to find something: words of the manuals and of sentences.
pub fn sentence(random: &mut Random, seeds: &Seeds) -> Vec<u8> {
    let mut text = String::new();
    for _ in 0..1 + random.below(5) {
        match random.below(8) {
            0 | 1 => text.push_str(&seeds.sentences[random.below(seeds.sentences.len())]),
            2 | 3 => text.push_str(random.of(WORDS)),
            _ => text.push_str(random.of(ASKED)),
        }
        if !random.one_in(8) {
            text.push(' ');
        }
    }
    text.truncate(text.floor_char_boundary(200));
    let mut bytes = text.into_bytes();
    if random.one_in(3) {
        disturb(random, &mut bytes);
    }
    bytes
}

/// Lines of words, as links and settings are.
pub fn words(random: &mut Random, between: &str) -> Vec<u8> {
    let mut text = String::new();
    for _ in 0..1 + random.below(8) {
        (0..1 + random.below(2)).for_each(|_| text.push_str(random.of(WORDS)));
        text.push_str(between);
    }
    let mut bytes = text.into_bytes();
    if random.one_in(2) {
        disturb(random, &mut bytes);
    }
    bytes
}

/// A few words over and over.
pub fn repeated(random: &mut Random) -> Vec<u8> {
    let size = 1 << (10 + random.below(7));
    let unit: String = (0..1 + random.below(3)).map(|_| random.of(WORDS)).collect();
    unit.repeat(size / unit.len().max(1) + 1).into_bytes()
}

/// A line with a telegram.
fn line(random: &mut Random, seeds: &Seeds, text: &mut String) {
    (0..random.below(3)).for_each(|_| text.push_str(random.of(WORDS)));
    let bytes = telegram(random, seeds);
    written(random, &bytes, text);
    text.push_str(["\n", "\r\n", "\n", "  |..|\n"][random.below(4)]);
}

/// Bytes as people write them.
fn written(random: &mut Random, bytes: &[u8], text: &mut String) {
    use std::fmt::Write as _;
    let bytes = &bytes[..bytes.len().min(60)];
    let how = random.below(8);
    for byte in bytes {
        // Writing to a string cannot fail.
        let _ = match how {
            0..=3 => write!(text, "{byte:02X} "),
            4 => write!(text, "{byte:02x}"),
            5 => write!(text, "0x{byte:02X}, "),
            6 => write!(text, "\\x{byte:02x}"),
            _ => write!(text, "{byte} "),
        };
    }
}

/// Changes some characters.
fn disturb(random: &mut Random, bytes: &mut Vec<u8>) {
    for _ in 0..random.below(4) {
        let at = random.below(bytes.len() + 1);
        let to = (at + 1 + random.below(12)).min(bytes.len());
        match random.below(5) {
            0 if at < bytes.len() => bytes[at] = b"\n :0x'\"\\F7g-.[\0\xFF"[random.below(16)],
            1 => drop(bytes.drain(at..to)),
            2 => {
                let again = bytes[at..to].to_vec();
                bytes.splice(at..at, again);
            }
            3 => bytes.truncate(at),
            _ => drop(bytes.splice(at..at, random.of(WORDS).bytes())),
        }
    }
}

/// The smallest input of its kind that still fails, or what was found in some seconds: leaves out parts,
/// and makes bytes 0, as long as `fails` says yes.
pub fn smaller(mut input: Vec<u8>, mut fails: impl FnMut(&[u8]) -> bool) -> Vec<u8> {
    const TIME: Duration = Duration::from_secs(8);
    let start = Instant::now();
    let mut size = input.len() / 2;
    while size > 0 && start.elapsed() < TIME {
        let mut at = 0;
        while at < input.len() && start.elapsed() < TIME {
            let mut shorter = input.clone();
            shorter.drain(at..(at + size).min(input.len()));
            if fails(&shorter) { input = shorter } else { at += size }
        }
        size /= 2;
    }
    for at in 0..input.len() {
        let mut plainer = input.clone();
        plainer[at] = 0;
        if input[at] != 0 && start.elapsed() < TIME && fails(&plainer) {
            input = plainer;
        }
    }
    input
}
