//! What can be looked up: every telegram, register, parameter and code, each with a draft that builds; and the
//! telegrams of the gallery.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use buslens::device::{Access, Content, PROFILES, Profile};
use buslens::field::{Spec, hex};
use buslens::frame::PROTOCOLS;
use buslens::modbus;
use buslens::profibus;
use buslens::tool::gallery::{Sample, samples};
use buslens::tool::link::Link;
use buslens::tool::reference::{About, Book, Chapter, Doing, Item, find, items};
use buslens::tool::{Editor, Size, decode};

fn of(book: Book, chapter: Chapter) -> Vec<Arc<Item>> {
    items().into_iter().filter(|item| item.book == book && item.chapter == chapter).collect()
}

/// Every telegram of every kind, both ways, and every frame: laid out without a gap.
#[test]
fn every_telegram_is_laid_out() {
    for book in [Book::Modbus, Book::Profibus] {
        for item in of(book, Chapter::Telegrams) {
            let About::Telegram(topic) = &item.about else { panic!("{}: no telegram", item.label) };
            for carrier in topic.carriers() {
                let layouts = topic.layouts(carrier);
                assert!(!layouts.is_empty(), "{} by {}", item.label, carrier.label);
                for layout in layouts {
                    let mut next = Some(0);
                    for row in layout.rows.iter().filter(|row| !row.size.is_around()) {
                        assert_eq!(row.offset, next, "{} {}: {}", item.label, layout.title, row.spec.label);
                        next = match row.size {
                            Size::Fixed(width) | Size::Each(width) => next.map(|next| next + width),
                            _ => None,
                        };
                        // Behind a list nobody knows.
                        let list = matches!(row.size, Size::Each(_));
                        next = next
                            .filter(|next| !list || layout.rows.iter().any(|row| row.offset == Some(*next)));
                    }
                }
            }
        }
    }
    let functions: BTreeSet<u8> = of(Book::Modbus, Chapter::Telegrams)
        .iter()
        .filter_map(|item| match &item.about {
            About::Telegram(topic) => topic.function(),
            _ => None,
        })
        .collect();
    for kind in modbus::KINDS.iter().chain(modbus::OTHER_KINDS) {
        assert!(functions.contains(&kind.function), "{}", kind.spec.label);
    }
    let services: Vec<String> =
        of(Book::Profibus, Chapter::Telegrams).iter().map(|item| item.label.clone()).collect();
    for kind in profibus::KINDS.iter().chain(profibus::OTHER_KINDS) {
        assert!(services.iter().any(|label| label == kind.spec.label), "{}", kind.spec.label);
    }
}

/// Every register and parameter of every device, each address of an area once at least.
#[test]
fn every_register_and_parameter_is_there() {
    for profile in PROFILES {
        let items = of(Book::Device(profile), Chapter::Registers);
        let registers: Vec<_> = items
            .iter()
            .filter_map(|item| match &item.about {
                About::Register(register) => Some(register),
                _ => None,
            })
            .collect();
        for parameter in profile.parameters() {
            let there = registers.iter().any(|register| {
                (register.from, register.subindex, register.id)
                    == (parameter.address, parameter.subindex, parameter.id)
                    && register.spec == &parameter.spec
            });
            assert!(there, "{}: {}", profile.key, parameter.spec.label);
        }
        for area in profile.areas.iter().filter(|area| !area.listed) {
            for address in area.from..=area.last() {
                let there = registers.iter().any(|register| (register.from..=register.to).contains(&address));
                assert!(there, "{}: {} at {address}", profile.key, area.spec.label);
            }
        }
        let keys: BTreeSet<&str> = items.iter().map(|item| item.key.as_str()).collect();
        assert_eq!(keys.len(), items.len(), "{}: each has a key of its own", profile.key);
        assert!(keys.iter().all(|key| !key.contains('.')), "{}", profile.key);
    }
}

/// Every named value, range and bit of a device's table, its exceptions and the texts of its display.
#[test]
fn every_code_is_there() {
    for profile in PROFILES {
        let items = of(Book::Device(profile), Chapter::Codes);
        let labels: BTreeSet<&str> = items.iter().map(|item| item.label.as_str()).collect();
        let mut missing = Vec::new();
        let mut ask = |label: &'static str| {
            if !label.is_empty() && !labels.contains(label) {
                missing.push(label);
            }
        };
        for spec in specs(profile) {
            spec.names.iter().for_each(|name| ask(name.label));
            spec.ranges.iter().for_each(|range| ask(range.label));
            for part in spec.bits.iter().filter(|part| !part.reserved) {
                part.names.iter().for_each(|name| ask(name.label));
                part.ranges.iter().for_each(|range| ask(range.label));
                if part.count == 1 && part.names.is_empty() {
                    ask(part.label);
                }
            }
        }
        profile.display.iter().for_each(|display| ask(display.meaning));
        let own = profile.exceptions.into_iter().flat_map(|spec| spec.names).map(|name| name.label);
        own.for_each(&mut ask);
        assert_eq!(missing, [""; 0], "{}", profile.key);
        let keys: BTreeSet<&str> = items.iter().map(|item| item.key.as_str()).collect();
        assert_eq!(keys.len(), items.len(), "{}: each has a key of its own", profile.key);
    }
    for name in modbus::exceptions() {
        assert_eq!(find(&items(), &format!("exception {}", name.value))[0].label, name.label);
    }
    let errors = of(Book::Profibus, Chapter::Codes);
    for (refusal, name) in profibus::Refusal::all() {
        assert!(
            errors.iter().any(|item| item.number == refusal.number().to_string() && item.label == name.label)
        );
    }
}

fn specs(profile: &'static Profile) -> Vec<&'static Spec> {
    let parameters = profile.parameters().map(|parameter| &parameter.spec);
    let areas = profile.areas.iter().filter(|area| !area.listed).flat_map(|area| {
        let parts = match area.content {
            Content::Parts(parts) => parts,
            _ => &[],
        };
        let written = area.access != Access::Read;
        let parts = parts
            .iter()
            .flat_map(move |part| std::iter::once(part.spec).chain(written.then_some(part.written)));
        std::iter::once(&area.spec).chain(parts)
    });
    parameters.chain(areas).collect()
}

fn built(link: &Link) -> Result<Vec<u8>, String> {
    let mut editor = Editor::follow(link).ok_or("it is not found")?;
    editor.bytes().map_err(|message| message.to_string())
}

/// Whatever can be built of what is looked up is a finished telegram with a right check.
#[test]
fn every_draft_builds_a_telegram() {
    let mut wrong = Vec::new();
    let mut drafts = 0;
    for item in items() {
        for (doing, link) in item.drafts() {
            drafts += 1;
            let told = || {
                format!("{} {:?}, {} {}: {:?}", item.book.key(), doing, item.number, item.label, link.pairs())
            };
            let bytes = match built(&link) {
                Ok(bytes) => bytes,
                Err(why) => {
                    wrong.push(format!("{why}: {}", told()));
                    continue;
                }
            };
            let report = decode(&hex(&bytes), link.options.clone());
            if report.telegrams.len() != 1 || report.telegrams[0].verdict == buslens::tool::Verdict::Wrong {
                wrong.push(format!("{}: {}", hex(&bytes), told()));
            }
        }
        let openable = !item.drafts().is_empty();
        let register = match &item.about {
            About::Register(register) => register.allowed() != "not over this bus",
            About::Telegram(_) => true,
            About::Code(_) => openable,
        };
        assert_eq!(openable, register, "{} {}", item.number, item.label);
    }
    assert!(wrong.is_empty(), "{} of {drafts}\n{}", wrong.len(), wrong[..wrong.len().min(20)].join("\n"));
    assert!(drafts > 1000, "{drafts}");
}

/// A draft is filled in: the block that was looked up, the value of a code.
#[test]
fn drafts_are_filled_in() {
    let items = items();
    let draft = |typed: &str, wanted: Doing| {
        let item = &find(&items, typed)[0];
        let draft = item.drafts().into_iter().find(|(doing, _)| *doing == wanted);
        hex(&built(&draft.unwrap_or_else(|| panic!("{typed}: {}", item.label)).1).unwrap())
    };
    assert_eq!(draft("universal channel 6", Doing::Read), "01 03 00 D7 00 03 B5 F3");
    assert_eq!(draft("40216", Doing::Read), "01 03 00 D7 00 03 B5 F3");
    assert_eq!(draft("9600 baud Sy.07", Doing::Write), "01 10 20 07 00 01 02 00 03 C6 24");
    assert_eq!(draft("exception 66", Doing::Build), "01 83 42 C1 01");
    assert_eq!(draft("8-0-0030h", Doing::Build), "D2 00 23 00 08 00 00 30");
}

#[test]
fn things_are_found_as_people_type_them() {
    let items = items();
    let first = |typed: &str| {
        let found = find(&items, typed);
        found
            .first()
            .map_or(String::new(), |item| format!("{} {} {}", item.book.key(), item.number, item.label))
    };
    let mut wrong = Vec::new();
    for (typed, wanted) in [
        ("215", "memograph-rsg45 215 to 217 Universal channel 6"),
        ("00D7h", "memograph-rsg45 215 to 217 Universal channel 6"),
        ("mdb_protcfg", "keb-f5-modbus 5F00h MDB_ProtCfg"),
        ("fb.05", "keb-f5-modbus 5F05h MDB_MapNr_Wr"),
        ("2050h", "keb-f5-modbus 2050h Inverter parameter 0050h"),
        ("function 16", "modbus 16 Write multiple registers"),
        ("sap 61", "profibus 61 Set parameters"),
        ("Chk_Cfg", "profibus 62 Check configuration"),
        ("E.bcc", "keb-f5-profibus E_Bcc link to the inverter: wrong checksum"),
        ("EEEP3", "keb-f5-profibus EEEPX fatal: step X of the EEPROM test fails"),
        ("float status 81h", "memograph-rsg45 81h good, low limit or falling gradient"),
        ("value out of range", "profibus 8-0-0030h value out of range"),
        ("token", "profibus SD4 Token"),
        ("gateway", "modbus 10 (0Ah) gateway path unavailable"),
        ("no such thing", ""),
    ] {
        if first(typed) != wanted {
            wrong.push(format!("{typed}: {}, wanted {wanted}", first(typed)));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert_eq!(find(&items, " ").len(), items.len());
}

/// The list that the page's build.rs makes.
fn gallery() -> Vec<Sample> {
    let list: String = vectors()
        .iter()
        .map(|path| fs::read_to_string(path).unwrap())
        .map(|text| text.split("---\n").next().unwrap_or_default().to_owned())
        .filter(|head| !head.contains("bytes of our own") || head.contains("\ngallery: yes\n"))
        .map(|head| head + "\n")
        .collect();
    samples(&list)
}

fn vectors() -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/vectors")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            match path.is_dir() {
                true => folders.push(path),
                false => found.push(path),
            }
        }
    }
    found.sort();
    found
}

/// All that the manuals print, each with a sentence; what is misprinted with its slip and the right bytes.
#[test]
fn the_gallery_has_every_printed_telegram() {
    let samples = gallery();
    let printed =
        |manual: &str| samples.iter().filter(|sample| sample.printed && sample.manual == manual).count();
    assert_eq!(printed("Memograph M RSG45 Modbus supplement"), 71);
    assert_eq!(printed("KEB COMBIVERT F5 PROFIBUS-DP operator"), 15);
    let mut misprinted = 0;
    for sample in &samples {
        let said = sample.said().unwrap_or_else(|| panic!("{}: nothing is said", sample.title));
        assert!(said.sentence.len() > 8 && !said.bytes.is_empty(), "{}", sample.title);
        assert!(!sample.section.is_empty() || sample.manual.starts_with("EN 50170"), "{}", sample.title);
        if let Some(slip) = &said.misprint {
            misprinted += 1;
            assert_ne!(slip.right, said.bytes, "{}", sample.title);
            assert!(!said.sentence.contains("checksum is wrong"), "{}: {}", sample.title, said.sentence);
            let link = sample.corrected(slip);
            let report = decode(&link.text, link.options);
            let last = report.telegrams.len() - 1;
            assert_eq!(report.telegrams[last].line.bytes, slip.right);
            assert!(report.detail(last).unwrap().problems().is_empty(), "{}", sample.title);
        } else if sample.printed {
            assert!(!said.is_faulty, "{}: {}", sample.title, said.sentence);
        }
        // What is opened in Read is the telegram of the row.
        let link = sample.link();
        let report = decode(&link.text, link.options);
        assert_eq!(report.telegrams.len(), link.telegram + 1, "{}", sample.title);
    }
    assert_eq!(misprinted, 13 + 2);
    // An answer stands behind its request.
    let places: Vec<_> =
        samples.iter().filter(|sample| sample.section == "2.6.1" && sample.printed).collect();
    let places: Vec<&str> = places.iter().map(|sample| sample.place.as_str()).collect();
    assert_eq!(places, ["request 1", "response 1", "request 2", "response 2"]);
}

/// One of each function and service, both ways, and of each protocol.
#[test]
fn the_gallery_has_one_of_each_kind() {
    let said: Vec<_> = gallery().iter().filter_map(Sample::said).collect();
    for kind in modbus::KINDS {
        let there = said.iter().any(|said| {
            said.function == Some(kind.function) && said.direction == kind.direction && !said.is_exception
        });
        assert!(there, "{} {:?}", kind.spec.label, kind.direction);
    }
    for kind in profibus::KINDS.iter().chain(&profibus::OTHER_KINDS[..2]) {
        let there = said.iter().any(|said| said.kind == kind.spec.label && said.direction == kind.direction);
        assert!(there, "{} {:?}", kind.spec.label, kind.direction);
    }
    for key in [
        "modbus-rtu",
        "modbus-tcp",
        "modbus-ascii",
        "modbus-pdu",
        "profibus-fdl",
        "profibus-parameter-channel",
    ] {
        assert!(said.iter().any(|said| said.protocol.key == key), "{key}");
    }
    assert!(PROTOCOLS.len() > 6);
}
