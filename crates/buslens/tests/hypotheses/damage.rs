//! 10,000 telegrams, each damaged in one way. The true telegram has to be first among the hypotheses
//! where that can be decided, and in the list nearly always.
//!
//! Decidable is a damage whose cause would be found by chance less than once in eight times
//! (`Decides`): a flipped bit always is, a changed byte up to 32 bytes of telegram, a lost
//! one as well. A cause that "always" fits, such as a wrong check, counts as decidable, too: then the
//! content alone has to decide.

use buslens::field::hex;
use buslens::tool::{Options, decode};
use buslens::walk::CRC_16_MODBUS;

/// How many telegrams are damaged in each way.
const TIMES: usize = 500;

/// Random numbers: splitmix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    fn below(&mut self, end: usize) -> usize {
        (self.next() % end as u64) as usize
    }

    fn of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len())]
    }
}

fn with_check(body: &[u8]) -> Vec<u8> {
    let check = CRC_16_MODBUS.wire(body) as u16;
    [body, &check.to_be_bytes()].concat()
}

/// A request and its response as the F5 and the Memograph have them.
fn exchange(random: &mut Random) -> [Vec<u8>; 2] {
    let unit = random.of(&[1, 2, 5, 9, 20]);
    let function = random.of(&[3, 3, 3, 4, 6, 16, 100, 101]);
    let start = random.of(&[0_u16, 200, 215, 800, 1240, 3216, 6321, 8242]).to_be_bytes();
    let count = random.of(&[1, 1, 2, 2, 3, 3, 5, 8]);
    let quantity = (count as u16).to_be_bytes();
    let width = if function >= 100 { 4 } else { 2 };
    let data: Vec<u8> =
        (0..count * width).map(|at| if at % 3 == 0 { 0 } else { random.next() as u8 }).collect();
    let head = [unit, function];
    let (request, response) = match function {
        6 => {
            let both = [&head[..], &start, &data[..2]].concat();
            (both.clone(), both)
        }
        16 | 101 => (
            [&head[..], &start, &quantity, &[data.len() as u8], &data].concat(),
            [&head[..], &start, &quantity].concat(),
        ),
        _ => ([&head[..], &start, &quantity].concat(), [&head[..], &[data.len() as u8], &data].concat()),
    };
    [with_check(&request), with_check(&response)]
}

/// Damages a telegram; `None` where this one cannot be damaged so.
type Damage = fn(&[u8], &mut Random) -> Option<Vec<u8>>;

/// Whether a way is decidable by the odds for a telegram of so many bytes.
type Decides = fn(usize) -> bool;

static WAYS: &[(&str, Damage, Decides)] = &[
    (
        "check bytes swapped",
        |bytes, _| {
            let mut bytes = bytes.to_vec();
            let end = bytes.len();
            bytes.swap(end - 1, end - 2);
            Some(bytes)
        },
        |_| true,
    ),
    ("check missing", |bytes, _| Some(bytes[..bytes.len() - 2].to_vec()), |_| true),
    (
        "check over fewer bytes",
        |bytes, _| {
            let body = &bytes[..bytes.len() - 2];
            let check = CRC_16_MODBUS.wire(&body[1..]) as u16;
            Some([body, &check.to_be_bytes()].concat())
        },
        |_| true,
    ),
    (
        "start value 0000h",
        |bytes, _| {
            let body = &bytes[..bytes.len() - 2];
            let crc = body.iter().fold(0_u16, |crc, byte| {
                (0..8).fold(
                    crc ^ u16::from(*byte),
                    |crc, _| if crc & 1 == 1 { crc >> 1 ^ 0xA001 } else { crc >> 1 },
                )
            });
            Some([body, &crc.to_le_bytes()].concat())
        },
        |_| true,
    ),
    (
        "check wrong",
        |bytes, random| {
            let mut bytes = bytes.to_vec();
            let end = bytes.len();
            bytes[end - 2] ^= 1 + random.below(255) as u8;
            bytes[end - 1] ^= 1 + random.below(255) as u8;
            Some(bytes)
        },
        |_| true,
    ),
    (
        "bit flipped",
        |bytes, random| {
            let mut bytes = bytes.to_vec();
            let at = random.below(bytes.len());
            bytes[at] ^= 1 << random.below(8);
            Some(bytes)
        },
        |length| 8 * length * 8 <= 65_536,
    ),
    (
        "byte changed",
        |bytes, random| {
            let mut bytes = bytes.to_vec();
            let at = random.below(bytes.len() - 2);
            bytes[at] ^= 1 + random.below(255) as u8;
            Some(bytes)
        },
        |length| 255 * length * 8 <= 65_536,
    ),
    (
        "byte lost",
        |bytes, random| {
            let mut bytes = bytes.to_vec();
            bytes.remove(random.below(bytes.len() - 2));
            Some(bytes)
        },
        |length| 256 * length * 8 <= 65_536,
    ),
    (
        "byte doubled",
        |bytes, random| {
            let mut bytes = bytes.to_vec();
            let at = random.below(bytes.len());
            bytes.insert(at, bytes[at]);
            Some(bytes)
        },
        |_| true,
    ),
    (
        "byte inserted",
        |bytes, random| {
            let mut bytes = bytes.to_vec();
            bytes.insert(1 + random.below(bytes.len() - 1), random.next() as u8);
            Some(bytes)
        },
        |_| true,
    ),
    (
        "bytes in front",
        |bytes, random| {
            let front: Vec<u8> = (0..1 + random.below(3)).map(|_| random.next() as u8).collect();
            Some([front.as_slice(), bytes].concat())
        },
        |_| true,
    ),
    (
        "bytes behind",
        |bytes, random| {
            let behind: Vec<u8> = (0..1 + random.below(4)).map(|_| 1 + random.below(255) as u8).collect();
            Some([bytes, behind.as_slice()].concat())
        },
        |_| true,
    ),
    (
        "digits swapped",
        |bytes, random| {
            let mut bytes = bytes.to_vec();
            let at = random.below(bytes.len() - 2);
            bytes[at] = bytes[at].rotate_left(4);
            Some(bytes)
        },
        |_| true,
    ),
    (
        "bytes swapped",
        |bytes, random| {
            let mut bytes = bytes.to_vec();
            let at = random.below(bytes.len() - 3);
            bytes.swap(at, at + 1);
            Some(bytes)
        },
        |_| true,
    ),
    (
        "words swapped",
        |bytes, _| {
            let mut bytes = bytes.to_vec();
            let end = bytes.len() - 2;
            bytes[3..end].chunks_exact_mut(2).for_each(|word| word.swap(0, 1));
            Some(bytes)
        },
        |_| true,
    ),
    (
        "11h and 13h swallowed",
        |bytes, random| {
            // One or two of its bytes are such.
            let mut body = bytes[..bytes.len() - 2].to_vec();
            for _ in 0..1 + random.below(2) {
                let at = if body.len() > 6 { 4 + random.below(body.len() - 4) } else { 3 };
                body[at] = random.of(&[0x11, 0x13]);
            }
            Some(with_check(&body))
        },
        |length| 2 * length * length * 8 <= 65_536,
    ),
    (
        "00 or FF of the line",
        |bytes, random| {
            let turn: &[u8] = random.of(&[&[0][..], &[0xFF], &[0, 0], &[0xFF, 0xFF]]);
            Some(if random.below(2) == 0 { [bytes, turn].concat() } else { [turn, bytes].concat() })
        },
        |_| true,
    ),
    ("check copied", |bytes, _| Some(bytes.to_vec()), |_| true),
    ("echo in front", |bytes, _| Some(bytes.to_vec()), |_| true),
    (
        "two joined",
        |bytes, random| {
            let [other, _] = exchange(random);
            Some([bytes, other.as_slice()].concat())
        },
        |_| true,
    ),
];

#[test]
fn of_10_000_damaged_telegrams_the_true_ones_are_found() {
    let mut random = Random(2026);
    let (mut decidable, mut first, mut listed, mut all) = (0, 0, 0, 0);
    println!(
        "{:24} {:>6} {:>10} {:>7} {:>8} {:>9}",
        "damage", "", "decidable", "first", "of them", "in list"
    );
    for (name, damage, decides) in WAYS {
        let mut row = [0; 4];
        let mut count = 0;
        while count < TIMES {
            let [request, response] = exchange(&mut random);
            let (before, right) = if random.below(2) == 0 {
                (None, request.clone())
            } else {
                (Some(request.clone()), response)
            };
            let Some((right, damaged, context)) =
                damaged(name, *damage, &right, before.as_deref(), &mut random)
            else {
                continue;
            };
            if damaged == right || damaged.len() < 4 {
                continue;
            }
            count += 1;
            let lines: Vec<String> = context.iter().chain([&damaged]).map(|bytes| hex(bytes)).collect();
            let rtu = buslens::tool::Protocol::of("modbus-rtu");
            let report = decode(&lines.join("\n"), Options { protocol: rtu, ..Options::default() });
            // What is right by chance needs no explanation, and what holds two telegrams, or spare bytes
            // behind one, was parted already.
            let parted = report.telegrams.iter().any(|it| it.line.bytes == right);
            let wrong = report.telegrams.iter().rposition(|it| it.verdict == buslens::tool::Verdict::Wrong);
            let place = match wrong {
                Some(index) if !parted => {
                    report.explanations(index).iter().position(|one| one.hypothesis.bytes == right)
                }
                _ => parted.then_some(0),
            };
            let decided = decides(right.len());
            row[0] += usize::from(decided);
            row[1] += usize::from(place == Some(0));
            row[2] += usize::from(decided && place == Some(0));
            row[3] += usize::from(place.is_some());
        }
        println!("{name:24} {count:>6} {:>10} {:>7} {:>8} {:>9}", row[0], row[1], row[2], row[3]);
        decidable += row[0];
        first += row[2];
        listed += row[3];
        all += count;
    }
    let share = |part: usize, of: usize| part as f64 / of as f64;
    println!(
        "first of the decidable: {:.1} %, in the list: {:.1} %",
        100.0 * share(first, decidable),
        100.0 * share(listed, all)
    );
    assert_eq!(all, 10_000);
    assert!(share(first, decidable) >= 0.90, "{first} of {decidable}");
    assert!(share(listed, all) >= 0.97, "{listed} of {all}");
}

/// The true telegram, the damaged one, and the telegrams before it.
type Damaged = (Vec<u8>, Vec<u8>, Vec<Vec<u8>>);

fn damaged(
    name: &str,
    damage: Damage,
    right: &[u8],
    before: Option<&[u8]>,
    random: &mut Random,
) -> Option<Damaged> {
    let context: Vec<Vec<u8>> = before.into_iter().map(<[u8]>::to_vec).collect();
    match name {
        "check copied" => {
            let [other, _] = exchange(random);
            let body = &right[..right.len() - 2];
            let bytes = [body, &other[other.len() - 2..]].concat();
            Some((right.to_vec(), bytes, context.into_iter().chain([other]).collect()))
        }
        "echo in front" => {
            let request = before?;
            Some((right.to_vec(), [request, right].concat(), context))
        }
        "11h and 13h swallowed" => {
            let right = damage(right, random)?;
            let kept: Vec<u8> = right.iter().copied().filter(|byte| !matches!(byte, 0x11 | 0x13)).collect();
            (right.len() - kept.len() <= 2 && right.len() > kept.len()).then_some((right, kept, context))
        }
        _ => Some((right.to_vec(), damage(right, random)?, context)),
    }
}
