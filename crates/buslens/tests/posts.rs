//! What people paste: prose, odd logs, text without telegrams. `tests/posts` has each input with its truth.
//!
//! The truth beside an input lists its telegrams: the bytes, who speaks (`unknown` accepts any), and the
//! `check`: right, wrong, or none where no check bytes were printed. Nothing else may be reported.

mod changes;
mod random;

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use buslens::field::{Direction, hex};
use buslens::tool::log::{Log, Reading};
use buslens::tool::{Options, Report, Telegram, Verdict, decode_file};
use serde_json::Value;

struct Post {
    name: String,
    input: Vec<u8>,
    telegrams: Vec<Truth>,
}

struct Truth {
    bytes: String,
    direction: String,
    check: String,
}

fn posts() -> Vec<Post> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/posts");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let (truths, inputs): (Vec<PathBuf>, Vec<PathBuf>) =
        files.partition(|path| path.extension().is_some_and(|extension| extension == "json"));
    let mut posts: Vec<Post> = inputs
        .iter()
        .map(|path| {
            let truth = std::fs::read_to_string(path.with_extension("json")).unwrap();
            let truth: Value = serde_json::from_str(&truth).unwrap();
            let telegrams = truth["telegrams"].as_array().unwrap();
            let word = |value: &Value| value.as_str().unwrap().to_owned();
            Post {
                name: path.file_stem().unwrap().to_string_lossy().into_owned(),
                input: std::fs::read(path).unwrap(),
                telegrams: telegrams
                    .iter()
                    .map(|it| Truth {
                        bytes: word(&it["hex"]),
                        direction: word(&it["dir"]),
                        check: word(&it["check"]),
                    })
                    .collect(),
            }
        })
        .collect();
    assert_eq!(truths.len(), posts.len(), "an input and a truth each");
    posts.sort_by(|a, b| a.name.cmp(&b.name));
    posts
}

fn check(telegram: &Telegram) -> &'static str {
    match telegram.verdict {
        Verdict::Right => "right",
        Verdict::Wrong => "wrong",
        Verdict::Unchecked | Verdict::NoCheck => "none",
    }
}

/// What is wrong with a report; nothing if it is as the truth has it.
fn faults(report: &Report, truth: &[Truth]) -> Vec<String> {
    let mut left: Vec<&Telegram> = report.telegrams.iter().collect();
    let mut faults = Vec::new();
    for wanted in truth {
        let fits = |it: &&&Telegram| {
            let direction = it.guess.told().map_or("unknown", Direction::key);
            let told = wanted.direction == "unknown" || wanted.direction == direction;
            hex(&it.line.bytes) == wanted.bytes && told && check(it) == wanted.check
        };
        match left.iter().position(|it| fits(&it)) {
            Some(at) => _ = left.remove(at),
            None => faults.push(format!("missing {} {} {}", wanted.bytes, wanted.direction, wanted.check)),
        }
    }
    let known: HashSet<&str> = truth.iter().map(|it| it.bytes.as_str()).collect();
    let others =
        left.into_iter().map(|it| hex(&it.line.bytes)).filter(|bytes| !known.contains(bytes.as_str()));
    faults.extend(others.map(|bytes| format!("not a telegram: {bytes}")));
    faults
}

#[test]
fn every_post_gives_its_telegrams_and_nothing_else() {
    let posts = posts();
    let mut wrong = Vec::new();
    for post in &posts {
        let report = decode_file(&post.input, &Reading::default(), Options::default()).unwrap();
        let faults = faults(&report, &post.telegrams);
        if !faults.is_empty() {
            wrong.push(format!("{}: {}", post.name, faults.join("; ")));
        }
    }
    println!("{} of {} posts are right", posts.len() - wrong.len(), posts.len());
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// However a text comes in, the same telegrams are in it.
#[test]
fn pieces_of_any_size_give_the_same() {
    for post in posts() {
        let whole = Log::read(&post.input, &Reading::default(), Options::default()).unwrap();
        for size in [1, 7, 64] {
            let mut log =
                Log::open(&post.input, post.input.len() as u64, &Reading::default(), Options::default())
                    .unwrap();
            for part in post.input.chunks(size) {
                log.push(part);
            }
            log.finish();
            let bytes = |log: &Log| -> Vec<Vec<u8>> {
                log.entries().iter().map(|it| log.bytes(&post.input.as_slice(), &it).into_owned()).collect()
            };
            assert_eq!(bytes(&log), bytes(&whole), "{} in parts of {size}", post.name);
            assert_eq!(log.entries(), whole.entries(), "{} in parts of {size}", post.name);
            assert_eq!(log.unread(), whole.unread(), "{} in parts of {size}", post.name);
        }
    }
}

/// Windows ends lines in another way, mails quote them, and code is pasted with its indentation.
#[test]
fn what_is_around_the_lines_changes_nothing() {
    /// Changes a text and none of its telegrams.
    type Way = fn(&str) -> String;
    let ways: [(&str, Way); 3] = [
        ("CR LF", |text| text.replace('\n', "\r\n")),
        ("indented", |text| text.lines().map(|line| format!("    {line}\n")).collect()),
        ("without the last line end", |text| text.trim_end_matches('\n').to_owned()),
    ];
    let mut wrong = Vec::new();
    for post in posts() {
        let Ok(text) = std::str::from_utf8(&post.input) else { continue };
        for (way, change) in ways {
            let report =
                decode_file(change(text).as_bytes(), &Reading::default(), Options::default()).unwrap();
            let faults = faults(&report, &post.telegrams);
            if !faults.is_empty() {
                wrong.push(format!("{}, {way}: {}", post.name, faults.join("; ")));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// What a text says besides its bytes, and how they are written, is another thing in each post.
#[test]
fn other_words_times_and_blanks_change_nothing() {
    /// Changes a text and none of its telegrams.
    type Way = fn(&str, changes::Random) -> String;
    let ways: [(&str, Way); 6] = [
        ("words", changes::other_words),
        ("times", changes::other_times),
        ("case", changes::other_case),
        ("line ends", changes::other_ends),
        ("beginnings of lines", changes::other_beginnings),
        ("separators", changes::other_separators),
    ];
    let mut wrong = Vec::new();
    let mut tried = 0;
    for post in posts() {
        let Ok(text) = std::str::from_utf8(&post.input) else { continue };
        for (way, change) in ways {
            for seed in 0..3 {
                let changed = change(text, &mut random::random(seed));
                let report =
                    decode_file(changed.as_bytes(), &Reading::default(), Options::default()).unwrap();
                let faults = faults(&report, &post.telegrams);
                tried += 1;
                if !faults.is_empty() {
                    wrong.push(format!("{}, other {way} ({seed}): {}", post.name, faults.join("; ")));
                }
            }
        }
    }
    println!("{} of {tried} changed posts are right", tried - wrong.len());
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Other units and data, with checks made right again, wherever a telegram stands in hex digits.
#[test]
fn other_bytes_are_found_as_well() {
    let mut wrong = Vec::new();
    let mut tried = 0;
    for post in posts() {
        let Ok(text) = std::str::from_utf8(&post.input) else { continue };
        // What has no check of its own would need the same change.
        if post.telegrams.iter().any(|it| it.check != "right") {
            continue;
        }
        for seed in 0..6 {
            let mut random = random::random(seed);
            let units: [u8; 256] = std::array::from_fn(|_| 1 + random(31) as u8);
            let mut changed = text.to_owned();
            let mut known: Vec<(String, String)> = Vec::new();
            let mut truth = Vec::new();
            for wanted in &post.telegrams {
                let old = bytes_of(&wanted.bytes);
                let new = match known.iter().find(|(old, _)| *old == wanted.bytes) {
                    Some((_, new)) => new.clone(),
                    None if wanted.check == "right" && is_rtu(&old) => {
                        let new = changes::other_bytes(&old, &units, &mut random);
                        let replaced = changes::replaced(&changed, &old, &new);
                        // In another notation it stays what it is.
                        let new = if replaced == changed { wanted.bytes.clone() } else { hex(&new) };
                        known.push((wanted.bytes.clone(), new.clone()));
                        changed = replaced;
                        new
                    }
                    None => wanted.bytes.clone(),
                };
                truth.push(Truth {
                    bytes: new,
                    direction: wanted.direction.clone(),
                    check: wanted.check.clone(),
                });
            }
            if known.is_empty() || known.iter().any(|(old, new)| old == new) {
                continue;
            }
            tried += 1;
            let report = decode_file(changed.as_bytes(), &Reading::default(), Options::default()).unwrap();
            let mut faults = faults(&report, &truth);
            // A second notation was not changed with the first.
            faults.retain(|fault| !known.iter().any(|(old, _)| fault.ends_with(old.as_str())));
            if !faults.is_empty() {
                wrong.push(format!("{} ({seed}): {}", post.name, faults.join("; ")));
            }
        }
    }
    println!("{} of {tried} posts with other bytes are right", tried - wrong.len());
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn bytes_of(hex: &str) -> Vec<u8> {
    hex.split(' ').map(|byte| u8::from_str_radix(byte, 16).unwrap()).collect()
}

/// Whether the check of a telegram is the CRC of Modbus.
fn is_rtu(telegram: &[u8]) -> bool {
    telegram.len() > 3 && buslens::walk::CRC_16_MODBUS.wire(telegram) == 0
}
