use super::{Target, USUAL_MEMORY};
use crate::make;
use buslens::field::hex;
use buslens_trainer::lesson::{LESSONS, Lesson, Progress, pieces, read};
use buslens_trainer::{Answer, Verdict};

/// Files of lessons and of progress, changed at random.
pub static TARGET: Target = Target {
    key: "lesson",
    about: "lessons: any text is read, and what is wrong in it has its line; right answers are right",
    share: 1,
    // A lesson has a dozen reports.
    memory: 4 * USUAL_MEMORY,
    make: |random, seeds| {
        if random.one_in(8) {
            let steps = make::words(random, ": 1 2\n");
            return [b"Buslens: lessons that are done\n", steps.as_slice()].concat();
        }
        let mut lines: Vec<String> =
            LESSONS[random.below(LESSONS.len())].lines().map(str::to_owned).collect();
        // A few steps are enough.
        let from = random.below(lines.len());
        lines = lines.into_iter().skip(if random.one_in(2) { from } else { 0 }).take(60).collect();
        for _ in 0..random.below(6) {
            let at = random.below(lines.len());
            match random.below(5) {
                0 => _ = lines.remove(at),
                1 => lines.insert(at, lines[random.below(lines.len())].clone()),
                2 => lines[at] += &hex(&make::telegram(random, seeds)),
                3 => lines[at] = String::from_utf8_lossy(&make::words(random, " ")).into_owned(),
                _ => {
                    let letters: Vec<char> = lines[at].chars().collect();
                    lines[at] = letters.iter().take(random.below(letters.len() + 1)).collect();
                }
            }
            if lines.is_empty() {
                lines.push(String::new());
            }
        }
        lines.join("\n").into_bytes()
    },
    run,
};

fn run(data: &[u8]) {
    let text = String::from_utf8_lossy(data).into_owned();
    if let Some(progress) = Progress::read(&text) {
        assert_eq!(Progress::read(&progress.write()), Some(progress));
    }
    let (lesson, unread) = read(&text);
    let wrong = lesson.mistakes();
    let lines = text.lines().count().max(1);
    for mistake in unread.iter().chain(&wrong) {
        assert!((1..=lines).contains(&mistake.line) && !mistake.said.is_empty(), "{mistake:?} of {lines}");
    }
    let sound = unread.is_empty() && wrong.is_empty();
    tried(&lesson, &text, sound);
}

/// Every exercise takes its own answer, where nothing is wrong with the lesson, and tells about any other.
fn tried(lesson: &Lesson, text: &str, sound: bool) {
    for step in &lesson.steps {
        step.text.iter().for_each(|paragraph| _ = pieces(paragraph));
        let Some(exercise) = &step.exercise else { continue };
        match exercise.answer(step) {
            Some(answer) if sound => {
                let verdict = exercise.grade(step, &answer);
                assert!(verdict.is_right(), "line {}: {answer:?} is {verdict:?}", step.line);
            }
            Some(answer) => _ = exercise.grade(step, &answer),
            None => assert!(!sound, "line {}: a sound lesson has answers", step.line),
        }
        let some: String = text.chars().take(40).collect();
        for answer in
            [Answer::Text(some.clone()), Answer::Choice(1), Answer::Byte(2), Answer::Blanks(vec![some])]
        {
            match exercise.grade(step, &answer) {
                Verdict::Right(_) => {}
                Verdict::Wrong(remarks) => assert!(!remarks.is_empty()),
                Verdict::Unread(message) => assert!(!message.sentence().is_empty()),
            }
        }
    }
}
