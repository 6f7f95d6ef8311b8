use super::{Target, USUAL_MEMORY};
use crate::{Input, make};
use buslens::field::{Format, hex};
use buslens_trainer::notation::{self, Notation};
use buslens_trainer::practice::{Kind, LEVELS, Round, Seed};
use buslens_trainer::{Answer, Expected, Task, Verdict, grade};

/// Rounds of practice by any seed and any link, and answers of any text.
pub static TARGET: Target = Target {
    key: "practice",
    about: "practice: every seed makes tasks whose own answers are right, and any answer is told about",
    share: 1,
    memory: USUAL_MEMORY,
    make: |random, seeds| {
        let answer = match random.below(3) {
            0 => make::words(random, " "),
            1 => hex(&make::telegram(random, seeds)).into_bytes(),
            _ => random.below(70_000).to_string().into_bytes(),
        };
        let choices: Vec<u8> = (0..CHOICES).map(|_| random.below(256) as u8).collect();
        [choices, answer].concat()
    },
    run,
};

const CHOICES: usize = 6;

fn run(data: &[u8]) {
    let mut input = Input::new(data, CHOICES);
    let kind = Kind::ALL[usize::from(input.byte()) % Kind::ALL.len()];
    let level = LEVELS.start() + input.byte() % (LEVELS.end() - LEVELS.start() + 1);
    let seed = Seed::new(u64::from_be_bytes([0, 0, 0, 0, 0, input.byte(), input.byte(), input.byte()]));
    let question = usize::from(input.byte());
    let round = Round { kind, level, seed };
    assert_eq!(Round::of(&round.place()).map(|(round, _)| round), Ok(round));
    assert_eq!(Seed::of(&seed.to_string()), Some(seed));
    let tasks = round.questions();
    let task = &tasks[question % tasks.len()];
    assert!(!task.question.is_empty() && task.hints.len() <= 3, "{}", round.place());
    let verdict = grade(task, &right(task));
    assert!(verdict.is_right(), "{}, question {question}: {verdict:?}", round.place());

    let text = String::from_utf8_lossy(input.content()).into_owned();
    told(&grade(task, &Answer::Text(text.clone())));
    told(&grade(task, &Answer::Choice(question)));
    told(&grade(task, &Answer::Byte(question)));
    told(&grade(task, &Answer::Blanks(text.split(' ').map(str::to_owned).collect())));
    if let Ok((round, _)) = Round::of(&text) {
        assert_eq!(Round::of(&round.place()).map(|(round, _)| round), Ok(round));
    }
    for width in [1, 2, 4, 8] {
        for format in [Format::Decimal, Format::Signed, Format::Float] {
            if let Err(why) = notation::read(&text, width, format, Notation::Any) {
                assert!(!why.sentence().is_empty());
            }
        }
    }
}

/// What somebody answers who knows.
fn right(task: &Task) -> Answer {
    match &task.expected {
        Expected::Telegram(telegram) => Answer::Text(hex(&telegram.bytes)),
        Expected::Number(number) => Answer::Text(number.text()),
        Expected::Choice { right, .. } => Answer::Choice(*right),
        Expected::Byte { at, .. } => Answer::Byte(at.from),
        Expected::Blanks { telegram, blanks } => {
            Answer::Blanks(blanks.iter().map(|blank| hex(blank.span.of(&telegram.bytes))).collect())
        }
    }
}

/// Whoever is wrong is told something.
fn told(verdict: &Verdict) {
    match verdict {
        Verdict::Right(_) => {}
        Verdict::Wrong(remarks) => {
            assert!(!remarks.is_empty());
            assert!(remarks.iter().all(|remark| !remark.text.sentence().is_empty()), "{remarks:?}");
        }
        Verdict::Unread(message) => assert!(!message.sentence().is_empty()),
    }
}
