//! Practice: a question of each kind answered wrong and right, the same link, paper, and results of a group.

use buslens_trainer::practice::{Kind, QUESTIONS, Round, Seed};
use buslens_trainer::result::{About, RoundResult};
use buslens_trainer::{Answer, Expected, Given, Task, Verdict, grade};
use page_tests::{DESKTOP, NARROW, PHONE, Page, Result};
use serde_json::json;

fn round(kind: Kind, level: u8) -> Round {
    Round { kind, level, seed: Seed::of("K7QM").expect("a seed") }
}

fn link(round: Round, rest: &str) -> String {
    format!("#/learn?place=practice.{}{rest}", round.place())
}

/// Gives a wrong answer, which is told what is off, and then the right one.
async fn answer(page: &Page, task: &Task) -> Result {
    match &task.expected {
        Expected::Telegram(telegram) => {
            let mut wrong = telegram.bytes[..telegram.bytes.len() - 2].to_vec();
            wrong[0] ^= 3;
            let wrong = buslens::field::hex(&wrong);
            page.fill(".answer input", &wrong).await?;
            page.press_button("Check the answer").await?;
            page.until(".said.wrong", &said(task, &Answer::Text(wrong))).await?;
            page.fill(".answer input", &telegram.hex().to_lowercase().replace(' ', "")).await?;
        }
        Expected::Number(number) => {
            page.fill(".answer input", "7").await?;
            page.press_button("Check the answer").await?;
            page.until(".said.wrong", &said(task, &Answer::Text("7".to_owned()))).await?;
            page.fill(".answer input", &number.text()).await?;
        }
        Expected::Choice { choices, right } => {
            let wrong = (right + 1) % choices.len();
            page.click(&format!(".choice:nth-of-type({}) input", wrong + 1)).await?;
            page.press_button("Check the answer").await?;
            page.until(".said.wrong", &said(task, &Answer::Choice(wrong))).await?;
            page.click(&format!(".choice:nth-of-type({}) input", right + 1)).await?;
        }
        Expected::Byte { at, telegram, .. } => {
            let last = telegram.bytes.len() - 1;
            let wrong = if at.contains(last) { 0 } else { last };
            let strip = ".ask > .given:nth-last-of-type(1) .byte-strip";
            page.click(&format!("{strip} li:nth-child({}) button", wrong + 1)).await?;
            page.press_button("Check the answer").await?;
            page.until(".said.wrong", &said(task, &Answer::Byte(wrong))).await?;
            page.click(&format!("{strip} li:nth-child({}) button", at.from + 1)).await?;
        }
        Expected::Blanks { telegram, blanks } => {
            for (index, _) in blanks.iter().enumerate() {
                page.fill(&format!(".blank:nth-of-type({}) input", nth_blank(telegram, blanks, index)), "7E")
                    .await?;
            }
            page.press_button("Check the answer").await?;
            page.until(".said.wrong", "Not yet").await?;
            for (index, blank) in blanks.iter().enumerate() {
                let css = format!(".blank:nth-of-type({}) input", nth_blank(telegram, blanks, index));
                page.fill(&css, &buslens::field::hex(blank.span.of(&telegram.bytes))).await?;
            }
        }
    }
    page.press_button("Check the answer").await?;
    page.until(".said.right", "Right.").await
}

/// What the page has to say first.
fn said(task: &Task, answer: &Answer) -> String {
    match grade(task, answer) {
        Verdict::Wrong(remarks) => remarks[0].text.sentence(),
        other => panic!("{other:?}"),
    }
}

/// Which item of the telegram a blank is: bytes that are given are one each.
fn nth_blank(telegram: &buslens_trainer::Telegram, blanks: &[buslens_trainer::Blank], index: usize) -> usize {
    let before = (0..telegram.bytes.len()).filter(|at| {
        let within = blanks.iter().find(|blank| blank.span.contains(*at));
        *at < blanks[index].span.from && within.is_none_or(|blank| blank.span.from == *at)
    });
    before.count() + 1
}

#[tokio::test(flavor = "multi_thread")]
async fn practice_has_questions_of_each_kind() -> Result {
    let page = Page::open_at("#/learn?place=practice", DESKTOP, false).await?;
    page.until(".practice .headline", "Practice").await?;
    assert_eq!(page.count(".kind-card").await?, Kind::ALL.len());
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.picture("practice-start-desktop-light").await?;
    for (kind, level) in Kind::ALL.into_iter().zip([3, 1, 2, 1, 2, 3]) {
        let round = round(kind, level);
        let task = &round.questions()[0];
        page.go(&link(round, "")).await?;
        page.until(".question .headline", &task.question).await?;
        if level == 1 {
            page.press_button("Give me a hint").await?;
            page.until(".hints li", &task.hints[0]).await?;
            page.press_button("Another hint, 2 of 3").await?;
            page.until(".hints li", &task.hints[1]).await?;
        }
        assert_eq!(page.accessibility().await?, [""; 0], "{}", kind.key());
        page.picture(&format!("practice-{}-desktop-light", kind.key())).await?;
        answer(&page, task).await?;
        assert_eq!(page.accessibility().await?, [""; 0], "{}", kind.key());
        page.picture(&format!("practice-{}-right-desktop-light", kind.key())).await?;
    }
    page.close().await
}

/// A round to its end: the code says how it went, is kept, and is read into the table.
#[tokio::test(flavor = "multi_thread")]
async fn practice_ends_with_a_code() -> Result {
    let page = Page::open_at(&link(round(Kind::Decode, 1), ""), PHONE, true).await?;
    let round = round(Kind::Decode, 1);
    for (index, task) in round.questions().iter().enumerate() {
        // Two questions may be the same words about other bytes.
        page.until(".round [aria-current=step]", &(index + 1).to_string()).await?;
        page.until(".question .headline", &task.question).await?;
        match (&task.expected, index) {
            (_, 0) => answer(&page, task).await?,
            (Expected::Number(number), _) => {
                page.fill(".answer input", &number.text()).await?;
                page.press_button("Check the answer").await?;
                page.until(".said.right", "Right.").await?;
            }
            (other, _) => panic!("{other:?}"),
        }
        if index == 1 {
            page.picture("practice-question-phone-dark").await?;
        }
        page.press_button(if index + 1 < QUESTIONS { "Next question" } else { "What came of it" }).await?;
    }
    page.until(".done .headline", "4 of 5 right at the first answer.").await?;
    let code = page.text(".code output").await?;
    assert_eq!(RoundResult::of(&code), Ok(RoundResult { about: About::Round(round), right: 4 }));
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.picture("practice-done-phone-dark").await?;
    // What came of it outlasts a reload, and the same link asks the same.
    page.go(&link(round, ".2")).await?;
    page.until(".question .headline", &round.questions()[1].question).await?;
    page.until(".said.right", "Answered").await?;
    assert_eq!(page.count(".dot.good").await?, QUESTIONS);
    page.go("#/learn?place=practice.results").await?;
    let text = format!("Anna {code}\nBen {}\n", code.replace(|c: char| c.is_ascii_digit(), "Z"));
    page.fill(".results textarea", &text).await?;
    page.until(".results tbody tr:nth-child(1)", "Anna").await?;
    page.until(".results tbody tr:nth-child(1)", "4 of 5").await?;
    page.until(".results .no-code", "another one").await?;
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.picture("practice-results-phone-dark").await?;
    let file = page.saved(".results .acts button").await?;
    assert!(std::fs::read_to_string(file)?.contains("\"Anna\""));
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn practice_goes_on_paper_and_on_the_wall() -> Result {
    let round = round(Kind::Complete, 3);
    let tasks = round.questions();
    let page = Page::open_at(&link(round, ".paper"), DESKTOP, true).await?;
    page.until(".handout .asked", &tasks[4].question).await?;
    page.until(".key .right", &tasks[0].expected.text()).await?;
    page.until(".handout footer", "seed K7QM").await?;
    assert!(page.count(".handout .grid .empty").await? > 5, "room to write");
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.picture("practice-paper-desktop-dark").await?;
    page.click_text(".segments label", "Handout").await?;
    assert_eq!(page.count(".paper.key").await?, 0);
    let moodle = page.saved(".practice .tools .button:nth-last-of-type(2)").await?;
    assert!(std::fs::read_to_string(moodle)?.contains("<question type=\"shortanswer\">"));
    page.go(&format!("#/learn?place=practice.wall.{}", round.place())).await?;
    page.until(".wall h3", &tasks[0].question).await?;
    assert_eq!(page.text(".wall-answer").await?, "");
    page.picture("practice-wall-desktop-dark").await?;
    let bare = page.count(".wall .bare").await?;
    page.driver
        .execute(
            "document.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowRight', bubbles: true }))",
            vec![],
        )
        .await?;
    page.settle().await?;
    assert!(page.count(".wall .bare").await? < bare, "a field has its name");
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.driver
        .execute(
            "document.dispatchEvent(new KeyboardEvent('keydown', { key: 'Escape', bubbles: true }))",
            vec![],
        )
        .await?;
    page.until(".question .headline", &tasks[0].question).await?;
    page.close().await
}

/// What is no round is refused in a sentence, and something else is offered; a seed is taken by hand, too.
#[tokio::test(flavor = "multi_thread")]
async fn practice_refuses_damaged_links() -> Result {
    let page = Page::open_at("#/learn?place=practice.1.decode.1.K7Q", NARROW, false).await?;
    page.until(".practice .refused", "incomplete or damaged").await?;
    page.go("#/learn?place=practice.9.decode.1.K7QM").await?;
    page.until(".practice .refused", "newer version").await?;
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.fill(".seed input", "K7").await?;
    page.until(".seed .note", "four letters").await?;
    page.fill(".seed input", "k7qm").await?;
    page.click_text(".kind-card .level", "Level 1").await?;
    let task = &round(Kind::Decode, 1).questions()[0];
    page.until(".question .headline", &task.question).await?;
    assert!(page.fragment().await?.contains("practice.1.decode.1.K7QM.1"));
    let wide = "return document.documentElement.scrollWidth <= innerWidth";
    assert_eq!(page.value(wide).await?, json!(true), "nothing scrolls sideways");
    page.close().await
}

const SET: &str = "# Friday's test\nabout: Two of practice and one of ours.\n\n## Warm up\npractice: 1.decode.1.K7QM.2\n\n\
    ## Ours\ntelegram: 01 03 00 C8 00 03 84 35\ncame: 01 03 00 C8 00 02 84 35\n";

/// A set is put together, ordered, opened and answered; its link holds all of it, and its code is known.
#[tokio::test(flavor = "multi_thread")]
async fn practice_prepares_a_set() -> Result {
    let page = Page::open_at("#/learn?place=practice.prepare", DESKTOP, false).await?;
    page.until(".prepare .headline", "Prepare a set").await?;
    page.choose_in("Kind", "Decode this").await?;
    page.press_button("Add a question").await?;
    page.until(".chosen-tasks li:nth-child(1) .soft", "?").await?;
    page.fill(".adding textarea", "01 03 00 C8 00 03 84 36").await?;
    page.press_button("Add the task").await?;
    page.until(".adding .misfit", "wrong already").await?;
    page.fill(".adding textarea", "00 01 00 00 00 06 11 03 00 C8 00 03").await?;
    page.choose_in("What is to be found", "In a telegram: A byte is missing").await?;
    page.press_button("Add the task").await?;
    page.until(".chosen-tasks li:nth-child(2) .soft", "What happened to it?").await?;
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.press_button("Move task 2 up").await?;
    page.until(".chosen-tasks li:nth-child(1) .soft", "What happened to it?").await?;
    page.press_button("Remove task 2").await?;
    page.picture("practice-prepare-desktop-light").await?;
    assert_eq!(page.count(".chosen-tasks li").await?, 1);
    page.press_button("The set as a text").await?;
    page.wait_for(".prepare details textarea").await?;
    // What is not understood is said with its line, and cannot be opened yet.
    page.fill(".prepare details textarea", &SET.replace("came:", "com:")).await?;
    page.until(".mistakes li", "Line 9").await?;
    assert_eq!(page.value("return document.querySelector('.prepare .main').disabled").await?, json!(true));
    page.fill(".prepare details textarea", SET).await?;
    page.until_value("#set-title", "Friday's test").await?;
    page.press_button("Open the set").await?;
    let tasks = buslens_trainer::set::read(SET).0.tasks;
    page.until(".question .headline", &tasks[0].task.question).await?;
    answer(&page, &tasks[0].task).await?;
    page.press_button("Next question").await?;
    page.until(".tag", "Ours").await?;
    let Expected::Choice { right, .. } = &tasks[1].task.expected else { panic!() };
    page.click(&format!(".choice:nth-of-type({}) input", right + 1)).await?;
    page.press_button("Check the answer").await?;
    page.until(".said.right", "Right.").await?;
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.press_button("What came of it").await?;
    page.until(".done .headline", "1 of 2 right").await?;
    let code = page.text(".code output").await?;
    let about = About::Set(buslens_trainer::set::seed(SET));
    assert_eq!(RoundResult::of(&code), Ok(RoundResult { about, right: 1 }));
    let link = page.fragment().await?;
    page.go("#/learn?place=practice.results").await?;
    page.fill(".results textarea", &format!("Anna {code}")).await?;
    page.until(".results tbody tr", "Friday's test").await?;
    page.until(".results tbody tr", "1 of 2").await?;
    page.close().await?;
    // Where nobody opened it, the link alone does.
    let link = link.trim_start_matches('#').replace(".done", ".paper");
    let page = Page::open_at(&format!("#{link}"), PHONE, true).await?;
    page.until(".handout .called", "Warm up").await?;
    page.until(".key .asked", &tasks[0].task.question).await?;
    page.go("#/learn?place=practice").await?;
    page.until(".sets .level", "Friday's test").await?;
    page.picture("practice-sets-phone-dark").await?;
    page.close().await
}

/// A file with mistakes is refused with their lines; one without is opened. A log that is dropped may become a task.
#[tokio::test(flavor = "multi_thread")]
async fn practice_opens_a_set() -> Result {
    let folder = std::env::temp_dir().join(format!("buslens-sets-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    let (bad, good) = (folder.join("bad.txt"), folder.join("good.txt"));
    std::fs::write(&bad, SET.replace("practice: 1.decode.1", "practice: 1.decode.8"))?;
    std::fs::write(&good, SET)?;
    let page = Page::open_at("#/learn?place=practice", NARROW, false).await?;
    page.wait_for(".practice .open-file input").await?;
    let open = async |path: &std::path::Path| {
        page.one(".practice .open-file input").await?.send_keys(path.to_string_lossy()).await
    };
    open(&bad).await?;
    page.until(".mistakes", "bad.txt").await?;
    page.until(".mistakes li", "Line 5").await?;
    assert_eq!(page.accessibility().await?, [""; 0]);
    open(&good).await?;
    page.until(".question .headline", &buslens_trainer::set::read(SET).0.tasks[0].task.question).await?;
    page.settle().await?;
    assert!(page.fragment().await?.contains("practice.set."));
    // A link of before there were sets.
    page.go("#/learn?place=practice.own.1.bit-flipped.K7QM.any.010300C800038435").await?;
    page.until(".question .headline", "What happened to it?").await?;
    page.until(".round", "A task of somebody's own").await?;
    page.close().await?;
    std::fs::remove_dir_all(folder)?;
    Ok(())
}

/// What is in Read becomes a task: a telegram, and of a log what is around the telegram that is shown.
#[tokio::test(flavor = "multi_thread")]
async fn practice_takes_what_is_in_read() -> Result {
    let page = Page::open_at("#/read?text=01+03+00+C8+00+03+84+35", DESKTOP, false).await?;
    page.wait_for(".byte-strip").await?;
    page.click(".input-tools a[href='#/sheet']").await?;
    page.press_button("Save as").await?;
    page.click_text("[role=menuitem]", "A task for learners").await?;
    page.until_value(".adding textarea", "01 03 00 C8 00 03 84 35").await?;
    page.press_button("Add the task").await?;
    page.until(".chosen-tasks .soft", "This was to be: ask unit 1").await?;
    page.view("read").await?;
    page.wait_for(".byte-strip").await?;
    let Some(Given::Text(log)) = round(Kind::Silence, 3).questions()[0].given.first().cloned() else {
        panic!()
    };
    page.paste(&log).await?;
    page.wait_for(".file-bar").await?;
    page.press_button("Export").await?;
    page.click_text("[role=menuitem]", "A task for learners").await?;
    page.until_value(".adding textarea", "TX").await?;
    page.choose_in("What is to be found", "A log as it is: who does not answer?").await?;
    page.press_button("Add the task").await?;
    page.until(".chosen-tasks li:nth-child(2) .soft", "never answers").await?;
    page.picture("practice-from-read-desktop-light").await?;
    page.close().await
}
