//! Sets of tasks: written, read again, changed as text, and refused with the line that is wrong; faults hidden in
//! telegrams of each protocol and in logs, each of which the library itself finds.

use buslens::tool::steps::CHECKS;
use buslens::tool::{Options, Protocol};
use buslens_trainer::fault::{self, Fault};
use buslens_trainer::log::{Find, Log, Spoil};
use buslens_trainer::practice::{Kind, LEVELS, Round, Seed};
use buslens_trainer::random::Random;
use buslens_trainer::set::Hide;
use buslens_trainer::{Answer, Expected, Given, Task, Telegram, grade, set};

/// A frame of PROFIBUS (SD2) around destination to data.
fn sd2(body: &[u8]) -> String {
    let sum = CHECKS[2].wire(body) as u8;
    let length = body.len() as u8;
    buslens::field::hex(&[&[0x68, length, length, 0x68], body, &[sum, 0x16]].concat())
}

/// A telegram of each protocol, with its request where it answers one.
fn telegrams() -> Vec<(&'static str, Telegram)> {
    let drive = sd2(&[0x01, 0x02, 0x6D, 0x52, 0x01, 0x20, 0x34, 0xFA, 0x24, 0x00, 0x11]);
    [
        ("modbus-rtu", "01 03 00 C8 00 03 84 35\n01 03 06 00 80 42 A4 11 DE F9 38".to_owned()),
        (
            "modbus-tcp",
            "00 01 00 00 00 06 11 03 00 C8 00 03\n00 01 00 00 00 09 11 03 06 00 80 42 A4 19 DE".to_owned(),
        ),
        ("modbus-ascii", ":1103006B00037E\n:110306022B0000006455".to_owned()),
        ("profibus-fdl", drive),
        ("profibus-fdl", "10 02 01 49 4C 16".to_owned()),
        ("profibus-parameter-channel", "52 01 20 34 FA 24 00 00".to_owned()),
    ]
    .into_iter()
    .map(|(protocol, text)| (protocol, fault::telegram(&text, Protocol::of(protocol), None).expect(&text)))
    .collect()
}

fn is_solved(task: &Task) {
    let answer = match &task.expected {
        Expected::Choice { right, .. } => Answer::Choice(*right),
        Expected::Byte { at, .. } => Answer::Byte(at.from),
        expected => Answer::Text(expected.text()),
    };
    assert!(grade(task, &answer).is_right(), "{}", task.question);
}

/// Which faults there are for which protocol. That the library names each first is what makes it a task; so the text
/// of a set, which holds bytes alone, leads to the same task.
#[test]
fn faults_of_every_protocol_are_found() {
    let expected = [
        "check-swapped bit-flipped byte-changed digits-swapped bytes-swapped byte-doubled byte-extra byte-missing flow-control check-missing line-turn trailing-bytes wrong-byte",
        "byte-doubled byte-extra byte-missing wrong-byte",
        "bit-flipped digits-swapped byte-doubled byte-extra byte-missing wrong-byte",
        "bit-flipped digits-swapped byte-doubled byte-extra byte-missing wrong-byte",
        "bit-flipped digits-swapped byte-doubled byte-extra byte-missing wrong-byte",
        "byte-doubled byte-extra byte-missing wrong-byte",
    ];
    for ((protocol, telegram), expected) in telegrams().into_iter().zip(expected) {
        let mut possible = Vec::new();
        for fault in Fault::ALL {
            let made = (0..3).find_map(|seed| fault.inject(&telegram, &mut Random::of(&[seed])));
            let Some((came, _)) = made else { continue };
            possible.push(fault.key());
            let lines = set::of_telegram(&telegram, &came);
            let text = set::with(&set::empty("One"), "What happened?", &lines);
            let (read, mistakes) = set::read(&text);
            assert!(mistakes.is_empty(), "{text}\n{mistakes:?}");
            let task = &read.tasks[0].task;
            is_solved(task);
            match &task.expected {
                Expected::Choice { choices, right } => {
                    assert_eq!((choices.len(), choices[*right].text.as_str()), (4, fault.label()), "{text}");
                }
                Expected::Byte { telegram, .. } => {
                    assert_eq!((fault, &telegram.bytes), (Fault::WrongByte, &came));
                }
                other => panic!("{other:?}"),
            }
            let last = task.given.last();
            assert!(matches!(last, Some(Given::Telegram(given)) if given.bytes == came), "{text}");
        }
        assert_eq!(possible.join(" "), expected, "{protocol}");
    }
}

const HEALTHY: &str = "\
08:00:00.000 TX 02 03 01 20 00 02 C5 C2
08:00:00.020 RX 02 03 04 11 34 13 78 C4 34
08:00:00.120 TX 05 03 01 20 00 01 84 72
08:00:00.140 RX 05 03 02 12 34 44 F3
08:00:00.240 TX 02 03 01 24 00 02 84 03
08:00:00.260 RX 02 03 04 01 02 03 04 88 A4
08:00:00.360 TX 05 03 01 24 00 01 C5 B3
08:00:00.380 RX 05 03 02 56 78 77 C6
";

/// With the checksums that belong to it.
fn healthy() -> String {
    let line = |line: &str| {
        let (head, hex) = line.split_at(16);
        let bytes = buslens::tool::steps::bytes(hex);
        let body = &bytes[..bytes.len() - 2];
        let check = CHECKS[0].wire(body) as u16;
        format!("{head}{}", buslens::field::hex(&[body, &check.to_be_bytes()].concat()))
    };
    HEALTHY.lines().map(line).collect::<Vec<_>>().join("\n")
}

#[test]
fn logs_are_spoiled_so_that_the_library_sees_it() {
    let options = Options { protocol: Protocol::of("modbus-rtu"), ..Options::default() };
    let log = Log::of(&healthy(), options).unwrap();
    let Expected::Choice { choices, right } = log.task(Find::Fault).unwrap().expected else { panic!() };
    assert!(choices[right].text.starts_with("Nothing"), "{choices:?}");
    assert!(log.task(Find::Unit).is_err(), "every unit answers");
    for spoil in Spoil::ALL {
        let made = (0..8).find_map(|seed| log.spoiled(spoil, &mut Random::of(&[seed])));
        let (spoiled, find) = made.unwrap_or_else(|| panic!("{spoil:?} cannot be put into it"));
        let text = set::with(&set::empty("One"), "What is wrong?", &set::of_log(&spoiled, find));
        let (read, mistakes) = set::read(&text);
        assert!(mistakes.is_empty(), "{text}\n{mistakes:?}");
        let task = &read.tasks[0].task;
        is_solved(task);
        match &task.expected {
            Expected::Choice { choices, right } => assert_eq!(choices[*right].text, spoil.label(), "{text}"),
            Expected::Number(number) => assert!([2, 5].contains(&number.raw), "{text}"),
            other => panic!("{other:?}"),
        }
    }
}

/// The library sees in the logs of the generator what was put into them.
#[test]
fn logs_of_the_generator_are_seen_through() {
    let (mut all, mut same) = (0, 0);
    for level in LEVELS {
        for seed in 0..20 {
            let round = Round { kind: Kind::Conversation, level, seed: Seed::new(seed * 7919 + 5) };
            for task in round.questions() {
                let Expected::Choice { choices, right } = &task.expected else { panic!() };
                let [Given::Text(text)] = &task.given[..] else { panic!() };
                // What a value should be, no log tells.
                if choices[*right].text.contains("float") {
                    continue;
                }
                all += 1;
                let log =
                    Log::of(text, Options { protocol: Protocol::of("modbus-rtu"), ..Options::default() });
                let Ok(Task { expected: Expected::Choice { choices: own, right: own_right }, .. }) =
                    log.unwrap().task(Find::Fault)
                else {
                    println!("nothing said of {}\n{text}", choices[*right].text);
                    continue;
                };
                // By chance, the next request is the same.
                let repeated = own[own_right].text.contains("repeated");
                if own[own_right].text == choices[*right].text || repeated {
                    same += 1;
                } else {
                    println!("{} for {}\n{text}", own[own_right].text, choices[*right].text);
                }
            }
        }
    }
    assert_eq!(all, same);
}

const WHOLE: &str = "\
# Friday's test
about: Telegrams of our plant.

## Warm up
practice: 1.decode.1.K7QM.2

## All of a round
practice: 1.build.2.K7QM

## One of ours
Line 3, last Tuesday.

device: memograph-rsg45
telegram: 01 03 00 C8 00 03 84 35

task: How many registers are asked for?
number: Quantity
hint: Look at the end.
then: Three registers.

## Choose
task: Who speaks first?
right: The client
wrong: The server | It answers.

## A log
protocol: modbus-rtu
| TX 01 03 00 C8 00 03 84 35
| TX 01 03 00 C8 00 03 84 35
| RX 01 03 06 00 80 42 A4 11 DE F9 38
find: fault
";

#[test]
fn a_set_is_read() {
    let (set, mistakes) = set::read(WHOLE);
    assert_eq!(mistakes, []);
    assert_eq!((set.title.as_str(), set.about.as_str()), ("Friday's test", "Telegrams of our plant."));
    let titles: Vec<&str> = set.tasks.iter().map(|task| task.title.as_str()).collect();
    assert_eq!(
        (titles.len(), titles[0], titles[1], titles[6]),
        (9, "Warm up", "All of a round", "One of ours")
    );
    let round = Round::of("1.decode.1.K7QM").unwrap().0;
    assert_eq!(set.tasks[0].task.question, round.questions()[1].question);
    let own = &set.tasks[6].task;
    assert_eq!(own.question, "Line 3, last Tuesday. How many registers are asked for?");
    assert!(grade(own, &Answer::Text("3".to_owned())).is_right());
    assert_eq!((own.given.len(), own.hints.len()), (1, 1));
    set.tasks.iter().for_each(|task| is_solved(&task.task));
    assert_eq!(set::seed(WHOLE), set::seed(&WHOLE.replace('\n', "\r\n")));
    assert_ne!(set::seed(WHOLE), set::seed(&WHOLE.replace("Friday", "Monday")));
}

#[test]
fn a_set_is_changed_as_text() {
    let titles = |text: &str| {
        let (set, mistakes) = set::read(text);
        assert_eq!(mistakes, [], "{text}");
        let mut titles: Vec<String> = set.tasks.into_iter().map(|task| task.title).collect();
        titles.dedup();
        titles.join(", ")
    };
    assert_eq!(titles(&set::later(WHOLE, 0)), "All of a round, Warm up, One of ours, Choose, A log");
    assert_eq!(titles(&set::later(WHOLE, 3)), "Warm up, All of a round, One of ours, A log, Choose");
    assert_eq!(set::later(WHOLE, 4), WHOLE);
    assert_eq!(titles(&set::without(WHOLE, 2)), "Warm up, All of a round, Choose, A log");
    assert_eq!(
        titles(&set::titled(WHOLE, Some(1), " Five  of\nthem ")),
        "Warm up, Five of them, One of ours, Choose, A log"
    );
    assert_eq!(set::read(&set::titled(WHOLE, None, "Monday")).0.title, "Monday");
    let round = Round { kind: Kind::Find, level: 3, seed: Seed::of("K7QM").unwrap() };
    let more = set::with(WHOLE, "One more", &set::of_round(&round, 4));
    assert!(titles(&more).ends_with("A log, One more"));
    assert_eq!(set::places(&more).len(), 6);
}

/// What is wrong is said with its line.
#[test]
fn mistakes_have_their_line() {
    for (text, line, words) in [
        ("", 1, "title"),
        ("# A\n", 1, "needs a task"),
        ("# A\n## B\n", 2, "asks nothing yet"),
        ("# A\npractice: 1.decode.1.K7QM\n## B\npractice: 1.decode.1.K7QM\n", 2, "below a line"),
        ("# A\n## B\npractice: 1.decode.9.K7QM\n", 3, "version, kind, level"),
        ("# A\n## B\npractice: 7.decode.1.K7QM\n", 3, "newer version"),
        ("# A\n## B\npractise: 1.decode.1.K7QM\n", 3, "is no key"),
        ("# A\n## B\ncame: 01 03\n", 3, "as it should be"),
        (
            "# A\n## B\ntelegram: 01 03 00 C8 00 03 84 35\ncame: 01 03 00 C8 00 03 84 35\n",
            4,
            "nothing to find",
        ),
        ("# A\n## B\ntelegram: 01 03 00 C8 00 03 84 35\ncame: 77 77 77 77 77\n", 4, "would not find"),
        ("# A\n## B\ntelegram: 01 03 00 C8 00 03 84 36\ncame: 77\n", 4, "wrong already"),
        ("# A\n## B\nfind: fault\n", 3, "in a log above"),
        ("# A\n## B\n| TX 01 03 00 C8 00 03 84 35\nfind: fault\n", 4, "one telegram"),
        (
            "# A\n## B\n| TX 01 03 00 C8 00 03 84 35\n| RX 01 03 06 00 80 42 A4 11 DE F9 38\nfind: unit\n",
            5,
            "every unit answers",
        ),
        ("# A\n## B\n| TX 01\nfind: error\n", 4, "Expected"),
        ("# A\n## B\ntask: What?\nbits: 00 -> 01\n", 3, "for lessons"),
        ("# A\n## B\ntask: What?\nnumber: Quantity\n", 3, "no number"),
        ("# A\n## B\ntask: What?\n", 3, "needs what is right"),
        ("# A\n## B\npractice: 1.decode.1.K7QM\nfind: fault\n", 4, "one thing"),
    ] {
        let (_, mistakes) = set::read(text);
        let first = mistakes.first().unwrap_or_else(|| panic!("nothing is wrong with\n{text}"));
        assert!(first.line == line && first.said.contains(words), "{text}\n{mistakes:?}");
    }
    let many =
        (0..7).fold(set::empty("Too many"), |text, _| set::with(&text, "Five", "practice: 1.build.2.K7QM"));
    assert!(set::read(&many).1[0].said.contains("at most 31"));
}

/// What is pasted becomes a task of what it is.
#[test]
fn what_is_pasted_becomes_a_task() {
    let made = |text: &str, hide| set::made(text, None, hide, &mut Random::of(&[5]));
    let whole = |(title, lines): (&str, String)| {
        let text = set::with(&set::empty("One"), title, &lines);
        let (set, mistakes) = set::read(&text);
        assert_eq!(mistakes, [], "{text}");
        is_solved(&set.tasks[0].task);
        text
    };
    for (_, telegram) in telegrams() {
        let request = telegram.request.iter().map(|bytes| buslens::field::hex(bytes) + "\n");
        let text = request.collect::<String>() + &telegram.hex();
        // Bytes alone of ASCII or of the parameter channel may be another protocol.
        if ["modbus-rtu", "modbus-tcp", "profibus-fdl"].contains(&telegram.protocol.key) {
            let text = whole(made(&text, Hide::Any).unwrap());
            assert!(text.contains(&format!("protocol: {}", telegram.protocol.key)), "{text}");
        }
    }
    let log = healthy();
    assert!(whole(made(&log, Hide::Any).unwrap()).contains("find: "));
    assert!(whole(made(&log, Hide::Log(Find::Fault)).unwrap()).contains("find: fault"));
    assert!(whole(made(&log, Hide::Spoil(Spoil::Silence)).unwrap()).contains("find: unit"));
    assert!(made(&log, Hide::Log(Find::Unit)).unwrap_err().contains("every unit answers"));
    assert!(made("hello", Hide::Any).unwrap_err().contains("Paste a telegram"));
    let long = (0..30).map(|_| log.clone()).collect::<Vec<_>>().join("\n");
    assert!(made(&long, Hide::Any).unwrap_err().contains("at most 40"));
    let part = Log::excerpt(&long, Options::default(), 100);
    assert_eq!(part.lines().count(), 40);
    whole(made(&part, Hide::Any).unwrap());
}

/// What docs/practice.md shows is a set.
#[test]
fn the_example_of_the_docs_is_a_set() {
    let docs = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/practice.md");
    let docs = std::fs::read_to_string(docs).unwrap();
    let from = docs.find("    # Friday's test").unwrap();
    let lines = docs[from..].lines().take_while(|line| line.is_empty() || line.starts_with("    "));
    let text: String = lines.map(|line| format!("{}\n", line.trim_start_matches("    "))).collect();
    let (set, mistakes) = set::read(&text);
    assert_eq!(mistakes, []);
    assert_eq!(set.tasks.len(), 4);
    set.tasks.iter().for_each(|task| is_solved(&task.task));
}
