//! Every lesson that comes with Buslens: nothing in its text is a mistake, everything it says holds, each task
//! takes the right answer, and says of a wrong one what is off.

use buslens_trainer::lesson::{Ask, Exercise, LESSONS, Lesson, Place, Step, read};
use buslens_trainer::{Answer, Checksum, Verdict, grade};

fn lessons() -> Vec<Lesson> {
    LESSONS.iter().map(|text| read(text).0).collect()
}

fn exercises(mut visit: impl FnMut(&Step, &Exercise, &str)) {
    for lesson in lessons() {
        for (step, number) in lesson.steps.iter().zip(1..) {
            let exercise = step.exercise.as_ref().expect("each step has something to do");
            visit(step, exercise, &format!("{}.{number}", lesson.key));
        }
    }
}

#[test]
fn nothing_in_a_lesson_is_a_mistake() {
    let mut found = String::new();
    for text in LESSONS {
        let (lesson, mut mistakes) = read(text);
        mistakes.extend(lesson.mistakes());
        for mistake in mistakes {
            found += &format!("{}, line {}: {}\n", lesson.key, mistake.line, mistake.said);
        }
    }
    assert!(found.is_empty(), "{found}");
}

#[test]
fn every_lesson_is_whole() {
    let mut keys = Vec::new();
    for lesson in lessons() {
        assert!(
            !lesson.group.is_empty() && lesson.about.ends_with('.') && lesson.minutes > 0,
            "{}",
            lesson.key
        );
        assert!(lesson.steps.len() >= 4, "{}", lesson.key);
        keys.push(lesson.key);
    }
    let count = keys.len();
    keys.sort();
    keys.dedup();
    assert_eq!(keys.len(), count);
    let folder = std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../../lessons")).unwrap();
    assert_eq!(folder.count(), count, "each file of the folder is listed");
}

#[test]
fn every_task_has_three_hints_and_a_last_word() {
    exercises(|_, exercise, place| {
        assert_eq!(exercise.hints.len(), 3, "{place}");
        assert!(!exercise.then.is_empty() && !exercise.question.is_empty(), "{place}");
    });
}

/// Whether what is said of one of the step's telegrams lights every byte of it, part by part.
fn lights_every_byte(step: &Step) -> bool {
    let report = step.report();
    step.telegrams.iter().enumerate().any(|(index, telegram)| {
        let (Some(detail), length) = (report.detail(index), report.telegrams[index].line.bytes.len()) else {
            return false;
        };
        let parts = telegram.remarks.iter().filter(|remark| remark.place != Place::Whole);
        let lit: Vec<_> = parts.filter_map(|remark| remark.place.span(&detail, length)).collect();
        lit.len() > 1 && (0..length).all(|at| lit.iter().any(|span| span.contains(at)))
    })
}

/// First a worked example with every byte lit, then the same with blanks, then one's own, and at last a broken
/// one to repair.
#[test]
fn every_lesson_leads_from_the_example_to_the_repair() {
    let mut missing = String::new();
    for lesson in lessons() {
        let at = |is: &dyn Fn(&Step, &Ask) -> bool| {
            lesson.steps.iter().position(|step| is(step, &step.exercise.as_ref().unwrap().ask))
        };
        let arc = [
            ("example", at(&|step, _| lights_every_byte(step))),
            ("blanks", at(&|_, ask| matches!(ask, Ask::Blank { .. }))),
            ("own", at(&|_, ask| matches!(ask, Ask::Build { .. }))),
            ("repair", at(&|_, ask| matches!(ask, Ask::Repair { .. }))),
        ];
        for (name, _) in arc.iter().filter(|(_, at)| at.is_none()) {
            missing += &format!("{}: there is no {name}\n", lesson.key);
        }
        if !arc.iter().map(|(_, at)| at).is_sorted() {
            missing += &format!("{}: {arc:?}\n", lesson.key);
        }
        if !matches!(lesson.steps.last().unwrap().exercise.as_ref().unwrap().ask, Ask::Repair { .. }) {
            missing += &format!("{}: the last one is no repair\n", lesson.key);
        }
    }
    assert!(missing.is_empty(), "{missing}");
}

#[test]
fn the_right_answer_is_right() {
    exercises(|step, exercise, place| {
        let answer = exercise.answer(step).unwrap_or_else(|| panic!("{place} has no answer"));
        let verdict = exercise.grade(step, &answer);
        assert!(verdict.is_right(), "{place}: {answer:?} is {verdict:?}");
    });
}

/// Answers that are wrong, of the kind that somebody gives.
fn wrong(step: &Step, exercise: &Exercise) -> Vec<Answer> {
    let telegram = exercise.telegram(step).map(|telegram| telegram.bytes);
    match &exercise.ask {
        Ask::Choose { choices, right } => {
            (0..choices.len()).filter(|at| at != right).map(Answer::Choice).collect()
        }
        Ask::Number { wrong, .. } => {
            let own = wrong.iter().map(|own| Answer::Text(own.answer.clone()));
            own.chain([Answer::Text("1".to_owned())]).collect()
        }
        Ask::Point { .. } => {
            let Some(Answer::Byte(right)) = exercise.answer(step) else { panic!("a byte") };
            let report = step.report();
            let bytes = &report.telegrams.last().unwrap().line.bytes;
            (0..bytes.len()).filter(|at| !(right..right + 4).contains(at)).map(Answer::Byte).collect()
        }
        Ask::Blank { fields, .. } => {
            let Some(Answer::Blanks(right)) = exercise.answer(step) else { panic!("blanks") };
            (0..fields.len())
                .map(|at| {
                    let mut texts = right.clone();
                    let mut bytes = buslens::tool::steps::bytes(&texts[at]);
                    *bytes.last_mut().unwrap() ^= 0x11;
                    texts[at] = buslens::field::hex(&bytes);
                    Answer::Blanks(texts)
                })
                .collect()
        }
        Ask::Build { .. } | Ask::Repair { .. } => {
            let bytes = telegram.unwrap();
            let changed = (0..bytes.len() - 2).map(|at| {
                let mut bytes = bytes.clone();
                bytes[at] ^= 0x05;
                Answer::Text(buslens::field::hex(&bytes[..bytes.len() - 2]))
            });
            changed.collect()
        }
        Ask::Bits { from, .. } => vec![Answer::Text(buslens::field::hex(from))],
    }
}

#[test]
fn a_wrong_answer_hears_what_is_off() {
    exercises(|step, exercise, place| {
        let answers = wrong(step, exercise);
        assert!(!answers.is_empty(), "{place}");
        for answer in answers {
            match exercise.grade(step, &answer) {
                Verdict::Wrong(remarks) => {
                    assert!(remarks.iter().all(|remark| !remark.text.to_string().is_empty()), "{place}");
                    if let Ask::Build { .. } | Ask::Repair { .. } | Ask::Blank { .. } = exercise.ask {
                        assert!(!remarks[0].field.is_empty(), "{place}: {answer:?}: {remarks:?}");
                    }
                }
                other => panic!("{place}: {answer:?} is {other:?}"),
            }
        }
    });
}

#[test]
fn what_was_damaged_is_not_right_yet() {
    exercises(|step, exercise, place| {
        if let Ask::Repair { damaged, .. } = &exercise.ask {
            let verdict = exercise.grade(step, &Answer::Text(damaged.clone()));
            assert!(!verdict.is_right(), "{place}");
        }
    });
}

/// Where the checksum is asked for, a telegram without it is not right yet.
#[test]
fn a_checksum_that_is_asked_for_is_missed() {
    let mut asked = 0;
    exercises(|step, exercise, place| {
        let Some(telegram) = exercise.telegram(step) else { return };
        let Some(check) = telegram.check().filter(|_| telegram.checksum == Checksum::Asked) else { return };
        asked += 1;
        let rest = buslens::field::hex(&telegram.bytes[..check.covered.to]);
        let verdict = exercise.grade(step, &Answer::Text(rest));
        let said = verdict.remarks().first().map(|remark| remark.text.sentence());
        assert_eq!(said.as_deref(), Some("The CRC is missing: it has 2 bytes"), "{place}");
    });
    assert!(asked > 2, "{asked}");
}

/// What is no pointing and no switching is a task like those of practice.
#[test]
fn tasks_are_graded_as_tasks() {
    exercises(|step, exercise, _| {
        if let (Some(task), Some(answer)) = (exercise.task(step), exercise.answer(step)) {
            assert!(grade(&task, &answer).is_right());
        }
    });
}

/// Whatever stands in a file, it is read, and the lines of its mistakes are those of the file.
#[test]
fn no_text_is_too_strange() {
    let whole = LESSONS[1];
    for at in (0..whole.len()).filter(|at| whole.is_char_boundary(*at)).step_by(37) {
        let behind = (at + 11..whole.len()).find(|at| whole.is_char_boundary(*at)).unwrap_or(whole.len());
        let text = format!("{}{}", &whole[..at], &whole[behind..]);
        let (lesson, mistakes) = read(&text);
        let lines = text.lines().count().max(1);
        assert!(
            mistakes.iter().chain(&lesson.mistakes()).all(|it| (1..=lines).contains(&it.line)),
            "at {at}"
        );
    }
    for text in [
        "",
        "\n",
        "#",
        "# ",
        "## ",
        "- a: b",
        "| 01",
        "task: x",
        "# A\n## B\ntask: c\nblank: in in in\n",
        "\u{feff}# A",
    ] {
        let (lesson, _) = read(text);
        lesson.mistakes();
    }
    read(&"a".repeat(1_000_000));
    read(&"## b\n".repeat(100_000));
}

/// Digits that would be right as hex are another number; what says itself that it is hex is right.
#[test]
fn what_is_wrong_as_digits_may_be_right_as_hex() {
    let text = "# T\nkey: t\n## S\ntask: what\nnumber: 200 in hex\nwrong: 200 | That is decimal.\n";
    let (lesson, mistakes) = read(text);
    assert_eq!((mistakes, lesson.mistakes()), (Vec::new(), Vec::new()));
    let step = &lesson.steps[0];
    let graded = |text: &str| step.exercise.as_ref().unwrap().grade(step, &Answer::Text(text.to_owned()));
    assert!(graded("00C8h").is_right() && graded("C8").is_right());
    assert_eq!(graded("200").remarks()[0].text.sentence(), "That is decimal.");
}

/// Each mistake says what was expected.
#[test]
fn a_mistake_is_told_with_its_line() {
    let text = |more: &str| format!("# T\nkey: t\n## S\ntelegram: 01 03 00 C8 00 03 84 35\n{more}");
    for (more, line, said) in [
        ("- Quantitty: how many", 5, "no field “Quantitty”. It has: Unit address, Function code"),
        ("- bytes 6-9: what", 5, "bytes 0 to 7"),
        ("- Quantity how many", 5, "Expected “- Field: what to say of it”"),
        ("holds: Quantity = 4", 5, "“Quantity” is 3 or 00 03, not 4"),
        ("hnt: look", 5, "“hnt” is no key"),
        ("hint: look", 5, "belongs to a task"),
        ("task: what\nhint: look", 5, "The task needs what is right"),
        ("task: what\nright: a\nwrong: b", 7, "who is wrong wants to know why"),
        ("task: what\nright: a\nwrong: b | no\nwrong: a | no", 8, "“a” is the right answer"),
        ("task: what\nnumber: 10\nwrong: 4 | no\nwrong: 0Ah | no", 8, "“0Ah” is the right answer"),
        ("task: what\nnumber: Quantity\nwrong: 3 | no", 7, "“3” is the right answer"),
        ("task: what\npoint: Quantity\nwrong: Quantity | no", 7, "“Quantity” is the right answer"),
        ("task: what\nnumber: Colour", 5, "no field"),
        ("task: what\nbuild: 01 03 00 C8 00 03 84 36", 5, "no telegram with a valid checksum"),
        ("device: telex", 5, "Known are: "),
        ("show: film", 5, "What can be shown is"),
        ("{Colour} is nice.", 3, "{Colour}"),
        ("telegram: hello", 5, "not one telegram"),
        ("key: Word Order", 5, "above the first step"),
        ("# Another", 5, "one lesson"),
    ] {
        let (lesson, mut mistakes) = read(&text(more));
        mistakes.extend(lesson.mistakes());
        let found = mistakes.iter().any(|mistake| mistake.line == line && mistake.said.contains(said));
        assert!(found, "{more:?}: {mistakes:?}");
    }
}
