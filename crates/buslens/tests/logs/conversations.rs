use std::fmt::Write as _;

use buslens::field::{Direction, hex};
use buslens::tool::Options;
use buslens::tool::log::{Filter, Log, Reading, Role, Wanted};

use super::generator::Sent;

fn rtu(body: &[u8]) -> Vec<u8> {
    Sent { direction: Direction::Request, body: body.to_vec() }.rtu()
}

fn read(text: &str) -> Log {
    Log::read(text.as_bytes(), &Reading::default(), Options::default()).expect("a log")
}

fn roles(log: &Log) -> Vec<Role> {
    log.entries().iter().map(|entry| entry.role).collect()
}

/// A log of lines with a time in milliseconds, a word and bytes.
fn log(lines: &[(u64, &str, Vec<u8>)]) -> String {
    let mut text = String::new();
    for (time, word, bytes) in lines {
        let second = 36_000 + time / 1000;
        writeln!(
            text,
            "{:02}:{:02}:{:02}.{:03} {word}: {}",
            second / 3600 % 24,
            second / 60 % 60,
            second % 60,
            time % 1000,
            hex(bytes)
        )
        .unwrap();
    }
    text
}

fn ask(unit: u8) -> Vec<u8> {
    rtu(&[unit, 3, 0, 200, 0, 1])
}

fn answer(unit: u8) -> Vec<u8> {
    rtu(&[unit, 3, 2, 0, 7])
}

#[test]
fn retries_late_and_unasked_answers() {
    let log = read(&log(&[
        (0, "Tx", ask(5)),
        (500, "Tx", ask(5)),
        (520, "Rx", answer(5)),
        (600, "Rx", answer(5)),
        (700, "Tx", ask(6)),
        (900, "Tx", ask(7)),
        (910, "Rx", answer(6)),
        (915, "Rx", answer(7)),
        (950, "Tx", rtu(&[0, 6, 0, 1, 0, 2])),
    ]));
    use Role::{Broadcast, Late, Plain, Retry, Unasked};
    assert_eq!(roles(&log), [Plain, Retry, Plain, Unasked, Plain, Plain, Late, Plain, Broadcast]);
    let partners: Vec<_> = log.entries().iter().map(|entry| entry.partner()).collect();
    assert_eq!(partners, [None, Some(2), Some(1), None, Some(6), Some(7), Some(4), Some(5), None]);
    assert_eq!(log.latency(&log.entry(2)), Some(20_000));
    let all = log.statistics();
    assert_eq!((all.unanswered, all.retries, all.unasked, all.late, all.broadcasts), (1, 1, 1, 1, 1));
}

#[test]
fn polls_of_a_silent_unit_are_no_retries() {
    let mut lines = Vec::new();
    for n in 0..300 {
        lines.push((n * 100, "Tx", ask(5)));
        lines.push((n * 100 + 20, "Rx", answer(5)));
        lines.push((n * 100 + 50, "Tx", ask(9)));
        if !(100..120).contains(&n) {
            lines.push((n * 100 + 80, "Rx", answer(9)));
        }
    }
    let log = read(&log(&lines));
    let story: Vec<String> = log.story().iter().map(ToString::to_string).collect();
    assert_eq!(
        story[1],
        "Unit 9 answered 280 of 300 requests; 20 unanswered, most between 10:00:10.050 and 10:00:11.750",
        "{story:#?}"
    );
    assert_eq!(story[2], "Unit 5 answered all 300 requests");
    let dialog = log.statistics().dialogs[0];
    assert_eq!((dialog.median, dialog.worst), (Some(20_000), Some(20_000)));
}

#[test]
fn echoes_are_told_from_retries_and_from_answers() {
    let mut lines = Vec::new();
    let writes = rtu(&[5, 6, 0, 1, 0, 2]);
    for n in 0..20 {
        lines.extend([(n * 100, "Tx", ask(5)), (n * 100 + 2, "Rx", ask(5)), (n * 100 + 20, "Rx", answer(5))]);
        // Request, echo and response of function 6 are the same.
        lines.extend([
            (n * 100 + 40, "Tx", writes.clone()),
            (n * 100 + 42, "Rx", writes.clone()),
            (n * 100 + 60, "Rx", writes.clone()),
        ]);
    }
    let log = read(&log(&lines));
    use Role::{Echo, Plain};
    for part in roles(&log).chunks(3) {
        assert_eq!(part, [Plain, Echo, Plain]);
    }
    let all = log.statistics();
    assert_eq!((all.pairs, all.echoes, all.unanswered), (40, 40, 0));
}

#[test]
fn connections_are_told_by_their_addresses() {
    let (one, other) = ("10.0.0.7:49152", "10.0.0.8:49153");
    let server = "192.168.0.10:502";
    let mut text = String::new();
    for _ in 0..10 {
        for client in [one, other] {
            writeln!(text, "{client} -> {server} {}", hex(&ask(1))).unwrap();
        }
        for client in [other, one] {
            writeln!(text, "{server} -> {client} {}", hex(&answer(1))).unwrap();
        }
    }
    let log = read(&text);
    assert_eq!((log.statistics().pairs, log.statistics().retries), (20, 0));
    for (n, entry) in log.entries().iter().enumerate() {
        let client = if matches!(n % 4, 0 | 3) { one } else { other };
        assert_eq!(log.port_name(entry.port), Some(format!("{client} – {server}")));
    }
}

#[test]
fn an_address_that_is_not_repeated_stays() {
    let mut text = String::new();
    for unit in [1, 2] {
        writeln!(text, "TX to 10.0.0.{unit}:502: {}\nRX: {}", hex(&ask(unit)), hex(&answer(unit))).unwrap();
    }
    assert_eq!(read(&text).statistics().pairs, 2);
}

#[test]
fn names_of_speakers_are_no_connections() {
    let mut text = String::new();
    for _ in 0..10 {
        writeln!(text, "10.0.0.7:49152: {}\n10.0.0.1:502: {}", hex(&ask(1)), hex(&answer(1))).unwrap();
    }
    let log = read(&text);
    assert_eq!(log.statistics().pairs, 10);
    assert_eq!(log.port_name(log.entry(3).port), None);
}

#[test]
fn lines_and_connections_are_parted() {
    let mut text = String::new();
    for n in 0..10 {
        writeln!(text, "COM3 Tx {}\nCOM5 Tx {}", hex(&ask(1)), hex(&ask(1))).unwrap();
        writeln!(text, "COM5 Rx {}", hex(&answer(1))).unwrap();
        if n > 0 {
            writeln!(text, "COM3 Rx {}", hex(&answer(1))).unwrap();
        }
    }
    let log = read(&text);
    let ports: Vec<_> = log
        .statistics()
        .dialogs
        .iter()
        .map(|it| (log.port_name(it.port).unwrap(), it.answered, it.unanswered))
        .collect();
    assert_eq!(ports, [("COM3".to_owned(), 9, 1), ("COM5".to_owned(), 10, 0)]);
}

#[test]
fn over_tcp_several_requests_wait() {
    let frame = |transaction: u16, body: &[u8]| {
        Sent { direction: Direction::Request, body: body.to_vec() }.tcp(transaction)
    };
    let text = log(&[
        (0, "send", frame(1, &[1, 3, 0, 1, 0, 1])),
        (1, "send", frame(2, &[1, 3, 0, 2, 0, 1])),
        (5, "recv", frame(2, &[1, 3, 2, 0, 2])),
        (9, "recv", frame(1, &[1, 3, 2, 0, 1])),
    ]);
    let log = read(&text);
    let partners: Vec<_> = log.entries().iter().map(|entry| entry.partner()).collect();
    assert_eq!(partners, [Some(3), Some(2), Some(1), Some(0)]);
    assert_eq!(roles(&log), [Role::Plain; 4]);
}

#[test]
fn midnight_is_passed() {
    let text = format!("23:59:59.990 Tx {}\n00:00:00.010 Rx {}\n", hex(&ask(1)), hex(&answer(1)));
    let log = read(&text);
    assert_eq!(log.latency(&log.entry(1)), Some(20_000));
}

/// The writer of the log is the server: what it received are requests.
#[test]
fn who_is_who_is_told_by_the_telegrams() {
    let writes = rtu(&[5, 6, 0, 1, 0, 2]);
    let text = log(&[
        (0, "Rx", ask(5)),
        (5, "Tx", answer(5)),
        (10, "Rx", writes.clone()),
        (15, "Tx", writes.clone()),
    ]);
    let directions: Vec<_> = read(&text).entries().iter().map(|entry| entry.direction).collect();
    use Direction::{Request, Response};
    assert_eq!(directions, [Request, Response, Request, Response]);
}

#[test]
fn filters_choose() {
    let mut lines = Vec::new();
    for n in 0..50_u8 {
        let broken = n == 30;
        lines.push((u64::from(n) * 100, "Tx", rtu(&[5, 3, 0, n, 0, 2])));
        let mut bytes = rtu(&[5, 3, 4, 0, n, 1, 2]);
        bytes[4] ^= u8::from(broken);
        lines.push((u64::from(n) * 100 + 10, "Rx", bytes));
    }
    let text = log(&lines).replace("10:00:02.000 Tx", "10:00:02.000 fan on, Lüfter, Ölpumpe Tx");
    let log = read(&text);
    let source = text.as_bytes();
    let count = |filter: Filter| log.filtered(&filter, &source, source.len() as u64).len();
    let all = Filter::default;
    assert_eq!(count(all()), 100);
    assert_eq!(count(Filter { wanted: Wanted::CheckFailed, ..all() }), 1);
    assert_eq!(count(Filter { unit: Some(6), ..all() }), 0);
    assert_eq!(count(Filter { direction: Some(Direction::Response), ..all() }), 50);
    let second = 1_000_000;
    assert_eq!(count(Filter { times: Some((36_001 * second, 36_002 * second - 1)), ..all() }), 20);
    // A register is in two requests and their answers; bytes are found in any telegram.
    assert_eq!(count(Filter { text: "7".into(), ..all() }), 4);
    assert_eq!(count(Filter { text: "05 03 00 07".into(), ..all() }), 1);
    assert_eq!(count(Filter { text: "FAN on".into(), ..all() }), 1);
    assert_eq!(count(Filter { text: "Lüfter".into(), ..all() }), 1);
    assert_eq!(count(Filter { text: "Ölpumpe".into(), ..all() }), 1);
    let timeline = log.timeline(None, 10);
    assert_eq!(timeline.buckets.iter().map(|bucket| bucket.telegrams).sum::<u32>(), 100);
    assert_eq!(timeline.buckets.iter().map(|bucket| bucket.errors).sum::<u32>(), 1);
    let values: Vec<f64> = log.series(&source, Some(5), 7, 100).iter().map(|point| point.value).collect();
    assert_eq!(values, [258.0, 7.0]);
    // What is offered to be drawn has values; a device's manual gives it a name.
    let held = log.held(&source);
    assert!(held.len() > 10 && held.iter().all(|held| held.unit == Some(5) && held.name.is_empty()));
    for held in &held {
        assert!(!log.series(&source, held.unit, held.address, 10).is_empty(), "{held:?}");
    }
}

#[test]
fn registers_to_draw_have_the_names_of_the_manual() {
    let text = self::log(&[
        (0, "Tx", rtu(&[1, 3, 0, 200, 0, 3])),
        (20, "Rx", rtu(&[1, 3, 6, 0, 0x80, 0x42, 0xF6, 0xE9, 0x79])),
    ]);
    let device = buslens::tool::Profile::of("memograph-rsg45");
    let log =
        Log::read(text.as_bytes(), &Reading::default(), Options { device, ..Options::default() }).unwrap();
    let held = log.held(&text.as_bytes());
    let names: Vec<(u16, &str)> = held.iter().map(|held| (held.address, held.name.as_str())).collect();
    assert_eq!(names, [(200, "Universal channel 1")]);
    assert_eq!(log.series(&text.as_bytes(), Some(1), 200, 10)[0].value, 123.456);
}

#[test]
fn writes_in_a_log_teach_later_reads() {
    // Register 0 of the F5's process data is what its mapping list says.
    let profile = buslens::tool::Profile::of("keb-f5-modbus").expect("listed");
    let lesson = &profile.lessons[0];
    let [high, low] = lesson.from.to_be_bytes();
    let write = rtu(&[1, 6, high, low, 2, 3]);
    let later = rtu(&[1, 3, 0, 200, 0, 1]);
    let text = log(&[
        (0, "Tx", write.clone()),
        (5, "Rx", write),
        (10, "Tx", later),
        (15, "Rx", rtu(&[1, 3, 2, 0, 1])),
    ]);
    let options = Options { device: Some(profile), ..Options::default() };
    let log = Log::read(text.as_bytes(), &Reading::default(), options.clone()).unwrap();
    let source = text.as_bytes();
    // The last telegram by itself is read as in the whole log.
    let whole = log.whole_report(&source);
    let alone = log.report(&source, &[2, 3]);
    assert_eq!(
        format!("{:?}", whole.detail(3).unwrap().device),
        format!("{:?}", alone.detail(1).unwrap().device)
    );
}

/// The story says each thing that is special, with its number.
#[test]
fn the_story_tells_what_is_special() {
    let twice: Vec<(u64, &str, Vec<u8>)> = (0..10)
        .flat_map(|n| {
            let time = n * 100;
            [
                (time, "Tx", ask(5)),
                (time, "Tx", ask(5)),
                (time + 9, "Rx", answer(5)),
                (time + 9, "Rx", answer(5)),
            ]
        })
        .collect();
    let copied = read(&log(&twice));
    assert_eq!(copied.statistics().copies, 20);
    assert!(roles(&copied).chunks(2).all(|pair| pair == [Role::Plain, Role::Copy]));
    let story: Vec<String> = copied.story().iter().map(ToString::to_string).collect();
    assert_eq!(story[1], "Unit 5 answered all 10 requests");
    assert_eq!(story[2], "20 telegrams the log has twice; the copies are not counted");

    let mut broken = answer(9);
    broken[3] ^= 1;
    let some = read(&log(&[
        (0, "Tx", ask(9)),
        (10, "Rx", rtu(&[9, 0x83, 2])),
        (100, "Tx", ask(9)),
        (110, "Rx", broken),
        (200, "Tx", rtu(&[0, 6, 0, 1, 0, 2])),
        (300, "Rx", answer(8)),
    ]));
    let all = some.statistics();
    assert_eq!((all.exceptions, all.check_failed, all.broadcasts, all.unasked), (1, 1, 1, 1));
    let story: Vec<String> = some.story().iter().map(ToString::to_string).collect();
    assert!(story[1].contains("1 exception; 1 wrong checksum"), "{story:#?}");
    assert!(story.contains(&"1 response without a request".to_owned()), "{story:#?}");
    assert!(story.contains(&"1 request to all, which nobody answers".to_owned()), "{story:#?}");
}

/// A stream has no times and no words: the order alone tells who answers whom.
#[test]
fn a_bare_stream_is_a_conversation_too() {
    let stream = [ask(5), answer(5), ask(6), ask(7), answer(7), ask(5), answer(5)].concat();
    let reading = Reading { input: buslens::tool::log::Input::Binary, ..Reading::default() };
    let log = Log::read(&stream, &reading, Options::default()).unwrap();
    let partners: Vec<_> = log.entries().iter().map(|entry| entry.partner()).collect();
    assert_eq!(partners, [Some(1), Some(0), None, Some(4), Some(3), Some(6), Some(5)]);
    assert!(log.entries().iter().all(|entry| log.latency(&entry).is_none()));
}

/// What is behind many errors is one finding, with its telegrams.
#[test]
fn findings_name_what_is_behind_errors() {
    let found = |lines: &[(u64, &str, Vec<u8>)]| -> Vec<(&'static str, usize)> {
        let text = log(lines);
        let findings = read(&text).findings(&text.as_bytes());
        findings.iter().map(|finding| (finding.code, finding.evidence.len())).collect()
    };
    // A converter swallows 11h and 13h.
    let mut lines = Vec::new();
    for n in 0..40_u8 {
        lines.push((u64::from(n) * 100, "Tx", rtu(&[5, 3, 0, 200, 0, 2])));
        let whole = rtu(&[5, 3, 4, 0x42, n, 0x11, 0x80]);
        let kept = whole.into_iter().filter(|byte| !matches!(byte, 0x11 | 0x13)).collect();
        lines.push((u64::from(n) * 100 + 20, "Rx", kept));
    }
    assert_eq!(found(&lines)[0], ("flow-control", 40));
    // The check is written high byte first.
    for (_, word, bytes) in &mut lines {
        if *word == "Rx" {
            *bytes = rtu(&[5, 3, 4, 0x42, 1, 2, 3]);
            let end = bytes.len();
            bytes.swap(end - 1, end - 2);
        }
    }
    assert_eq!(found(&lines)[0], ("check-swapped", 40));
    // A unit is silent, another refuses, a third is slow in the middle of its telegrams.
    let mut lines = Vec::new();
    for n in 0..10 {
        lines.push((n * 500, "Tx", ask(9)));
        lines.push((n * 500 + 100, "Tx", ask(5)));
        lines.push((n * 500 + 120, "Rx", rtu(&[5, 0x83, 2])));
        lines.push((n * 500 + 200, "Tx", ask(7)));
        let whole = answer(7);
        lines.push((n * 500 + 220, "Rx", whole[..4].to_vec()));
        lines.push((n * 500 + 240, "Rx", whole[4..].to_vec()));
    }
    assert_eq!(found(&lines), [("unit-silent", 10), ("always-refused", 10), ("pauses-within", 10)]);
    assert_eq!(found(&[(0, "Tx", ask(5)), (20, "Rx", answer(5))]), []);
    // One in ten answers takes 424 ms where 20 ms are usual; two of them would be no finding.
    let slow = |times: u64| -> Vec<(u64, &str, Vec<u8>)> {
        let at = |n: u64| n * 1000;
        let late = |n: u64| if n % 10 == 3 { 424 } else { 20 };
        (0..times * 10).flat_map(|n| [(at(n), "Tx", ask(5)), (at(n) + late(n), "Rx", answer(5))]).collect()
    };
    assert_eq!(found(&slow(2)), []);
    assert_eq!(found(&slow(5)), [("slow-answers", 5)]);
    let text = log(&slow(5));
    let said = read(&text).findings(&text.as_bytes())[0].text.to_string();
    assert!(said.starts_with("Unit 5: 5 answers took 424 ms or more, usually 20 ms."), "{said}");
}

/// The last telegram waits for what may go on with it; the lines behind it do not wait with it.
#[test]
fn many_lines_behind_the_last_telegram_are_listed() {
    let text = "TX: 01 03 00 C8 00 03 84 35\n".to_owned() + &"nothing of interest\n".repeat(100_000);
    let log = read(&text);
    assert_eq!((log.entries().len(), log.unread().len()), (1, 100_000));
    assert!(log.unread().iter().map(|(line, _)| line).eq(2..=100_001));
}
