//! Practice: the same link asks the same questions, two seeds are equally hard, and a solver that uses nothing
//! but the public library answers every question; wrong answers are told what is off.

use std::path::Path;

use buslens_trainer::practice::{Kind, LEVELS, Measure, QUESTIONS, Round, Seed};
use buslens_trainer::{Given, Task, letter};

fn rounds(seeds: std::ops::Range<u64>) -> impl Iterator<Item = Round> {
    seeds.flat_map(|seed| {
        Kind::ALL.into_iter().flat_map(move |kind| {
            LEVELS.map(move |level| Round { kind, level, seed: Seed::new(seed * 7919 + 5) })
        })
    })
}

/// A task as text: what links of version 1 ask for ever.
fn written(task: &Task) -> String {
    let mut text = format!("? {}\n", task.question);
    for given in &task.given {
        match given {
            Given::Telegram(telegram) => {
                text += &format!("  {} {}\n", telegram.direction.key(), telegram.hex())
            }
            Given::Text(lines) => lines.lines().for_each(|line| text += &format!("  {line}\n")),
        }
    }
    if let buslens_trainer::Expected::Choice { choices, .. } = &task.expected {
        for (index, choice) in choices.iter().enumerate() {
            text += &format!("  {}) {}\n", letter(index), choice.text);
        }
    }
    text += &format!("= {}\n", task.expected.text());
    task.hints.iter().for_each(|hint| text += &format!("  hint {hint}\n"));
    task.working.iter().for_each(|step| text += &format!("  {step}\n"));
    text
}

/// `BLESS=1` writes the file. A changed question is a fault: links that people have would ask something else.
/// A sentence of the library that is put better is none.
#[test]
fn the_same_seed_asks_the_same_questions() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/practice.txt");
    let mut text = String::new();
    for round in rounds(0..2) {
        text += &format!("# {}\n\n", round.place());
        round.questions().iter().for_each(|task| text += &format!("{}\n", written(task)));
    }
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(&path, &text).unwrap();
    }
    let kept = std::fs::read_to_string(&path).unwrap();
    for (line, (kept, now)) in kept.lines().zip(text.lines()).enumerate() {
        assert_eq!(kept, now, "line {} of {}", line + 1, path.display());
    }
    assert_eq!(kept.len(), text.len());
}

#[test]
fn two_seeds_are_equally_hard() {
    for kind in Kind::ALL {
        for level in LEVELS {
            let measure = |seed| Round { kind, level, seed: Seed::new(seed) }.measure();
            let all: Vec<Measure> = (0..1000).map(measure).collect();
            let totals = all.iter().map(|measure| measure.total());
            let (least, most) = (totals.clone().min().unwrap(), totals.max().unwrap());
            println!("{:12} {level}: {least} to {most}, for example {:?}", kind.key(), all[0]);
            assert!(most - least <= least / 20, "{} {level}: {least} to {most}", kind.key());
        }
    }
}

#[test]
fn every_task_is_whole() {
    for round in rounds(0..40) {
        let questions = round.questions();
        assert_eq!(questions.len(), QUESTIONS);
        for task in questions {
            let what = format!("{}\n{}", round.place(), written(&task));
            assert!(task.question.len() > 20 && !task.expected.text().is_empty(), "{what}");
            assert_eq!(task.hints.len(), 3, "{what}");
            assert!(
                task.hints.iter().chain(&task.working).all(|line| line.len() > 8 && !line.contains("()")),
                "{what}"
            );
            assert!((2..=12).contains(&task.working.len()), "{what}");
        }
    }
}
