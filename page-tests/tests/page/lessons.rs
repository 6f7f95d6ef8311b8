//! Lessons: every one is done rightly and wrongly, as somebody does it in the page.

use buslens_trainer::Answer;
use buslens_trainer::lesson::{Ask, Exercise, LESSONS, Lesson, Step, read};
use page_tests::{DESKTOP, NARROW, PHONE, Page, Result};
use serde_json::json;
use thirtyfour::prelude::*;

fn lessons() -> Vec<Lesson> {
    LESSONS.iter().map(|text| read(text).0).collect()
}

/// An answer that is wrong, of the kind that the task takes.
fn wrong(step: &Step, exercise: &Exercise, right: &Answer) -> Answer {
    match (&exercise.ask, right) {
        (Ask::Choose { choices, right }, _) => Answer::Choice((right + 1) % choices.len()),
        (Ask::Point { .. }, Answer::Byte(at)) => {
            let length = step.report().telegrams.last().unwrap().line.bytes.len();
            Answer::Byte(if *at > length / 2 { 0 } else { length - 1 })
        }
        (Ask::Blank { .. }, Answer::Blanks(texts)) => {
            Answer::Blanks(texts.iter().map(|text| text.replace(|c: char| c != ' ', "9")).collect())
        }
        (Ask::Bits { from, .. }, _) => Answer::Text(buslens::field::hex(from)),
        (Ask::Number { .. }, _) => Answer::Text("7777".to_owned()),
        _ => Answer::Text("01 02 03 04 05 06".to_owned()),
    }
}

const SET: &str = "const set = (field, text) => { \
    Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, 'value').set.call(field, text); \
    field.dispatchEvent(new Event('input', { bubbles: true })); };";

/// Gives the answer as the task takes it, and has it checked.
async fn give(page: &Page, exercise: &Exercise, answer: &Answer) -> Result {
    let (script, what) = match (&exercise.ask, answer) {
        (Ask::Bits { to, .. }, Answer::Text(text)) => {
            let wanted = buslens::tool::steps::bytes(text);
            let bits: Vec<u8> =
                wanted.iter().flat_map(|byte| (0..8).rev().map(move |bit| byte >> bit & 1)).collect();
            assert_eq!(bits.len(), 8 * to.len());
            (
                "[...document.querySelectorAll('.switches button')].forEach((it, at) => { \
              if ((it.getAttribute('aria-checked') == 'true') != (arguments[0][at] == 1)) it.click() });",
                json!(bits),
            )
        }
        (_, Answer::Text(text)) => {
            ("set(document.querySelector('.task .typed input'), arguments[0]);", json!(text))
        }
        (_, Answer::Choice(index)) => {
            ("document.querySelectorAll('.choices input')[arguments[0]].click();", json!(index))
        }
        (_, Answer::Byte(at)) => {
            ("document.querySelectorAll('.task .byte-strip button')[arguments[0]].click();", json!(at))
        }
        (_, Answer::Blanks(texts)) => (
            "[...document.querySelectorAll('.blanks input')].forEach((it, at) => set(it, arguments[0][at]));",
            json!(texts),
        ),
    };
    page.driver.execute(format!("{SET} {script}"), vec![what]).await?;
    page.settle().await?;
    page.driver.execute("document.querySelector('.task form').requestSubmit()", vec![]).await?;
    page.settle().await
}

/// Goes to a step as a link does.
async fn step(page: &Page, lesson: &Lesson, number: usize) -> Result {
    let to = format!("#/learn?place=lessons.{}.{number}", lesson.key);
    page.driver.execute("location.hash = arguments[0]", vec![json!(to)]).await?;
    page.until(".step h2", &lesson.steps[number - 1].title).await
}

#[tokio::test(flavor = "multi_thread")]
async fn every_lesson_is_finished_wrongly_and_rightly() -> Result {
    let page = Page::open_at("#/learn", DESKTOP, false).await?;
    for lesson in lessons() {
        for (this, number) in lesson.steps.iter().zip(1..) {
            let exercise = this.exercise.as_ref().unwrap();
            let right = exercise.answer(this).unwrap();
            step(&page, &lesson, number).await?;
            give(&page, exercise, &wrong(this, exercise, &right)).await?;
            let place = format!("{}.{number}", lesson.key);
            assert_eq!(page.count(".task .said:is(.wrong, .unread)").await?, 1, "{place}: a wrong answer");
            let said = page.text(".task .said:is(.wrong, .unread)").await?;
            assert!(said.len() > 12, "{place}: {said}");
            give(&page, exercise, &right).await?;
            assert_eq!(
                page.count(".task .said.right").await?,
                1,
                "{place}: the right answer, but {:?}",
                page.texts(".task .said").await?
            );
        }
        assert_eq!(page.accessibility().await?, [""; 0], "{}", lesson.key);
    }
    page.driver.execute("location.hash = '#/learn?place=lessons'", vec![]).await?;
    page.until(".overview header", "steps are done").await?;
    assert_eq!(page.accessibility().await?, [""; 0]);
    // What is done is still done after a reload, and in a file.
    page.go("#/learn").await?;
    page.until(".overview header", "steps are done").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn bytes_are_lit_one_after_another() -> Result {
    let page = Page::open_at("#/learn?place=lessons.request.1", DESKTOP, false).await?;
    page.until(".spoken .of", "Unit address").await?;
    page.press_button("Next").await?;
    page.until(".spoken .of", "Function code").await?;
    // A click on a byte tells of it, and the way goes on from there.
    page.driver.execute("document.querySelectorAll('.walk .byte-strip button')[4].click()", vec![]).await?;
    page.until(".spoken .of", "Quantity").await?;
    page.press_button("Next").await?;
    page.until(".spoken .of", "CRC").await?;
    page.picture("lesson-desktop-light").await?;
    page.press_button("Back").await?;
    page.until(".spoken .of", "Quantity").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn hints_come_one_by_one() -> Result {
    let page = Page::open_at("#/learn?place=lessons.bytes.3", PHONE, true).await?;
    page.until(".task h3", "64h").await?;
    assert_eq!(page.count(".hints li").await?, 0);
    page.press_button("Give me a hint").await?;
    page.press_button("Another hint, 2 of 3").await?;
    page.press_button("Another hint, 3 of 3").await?;
    assert_eq!(page.count(".hints li").await?, 3);
    page.press_button("Fill in the answer").await?;
    page.press_button("Check my answer").await?;
    page.until(".said.right", "6 × 16 + 4 = 100.").await?;
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.picture("lesson-phone-dark").await?;
    page.press_button("Next step").await?;
    page.until(".step h2", "Two bytes, one number").await?;
    // Back leads to the step before, with what was typed there.
    page.driver.back().await?;
    page.until(".said.right", "6 × 16 + 4 = 100.").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn two_sides_take_turns() -> Result {
    let page = Page::open_at("#/learn?place=lessons.channel.2", NARROW, false).await?;
    page.until(".spoken", "with handshake 1").await?;
    let shown = "return [...document.querySelectorAll('.sides > ol > li:not([hidden])')].length";
    assert_eq!(page.value(shown).await?, json!(1));
    for _ in 0..3 {
        page.press_button("Next").await?;
    }
    page.until(".spoken", "the job is done").await?;
    assert_eq!(page.value(shown).await?, json!(4));
    assert_eq!(page.accessibility().await?, [""; 0]);
    page.close().await
}

/// A start-up that fails, step by step, and the telegram that was to blame, made right.
#[tokio::test(flavor = "multi_thread")]
async fn a_start_up_is_stepped_through_and_mended() -> Result {
    let page = Page::open_at("#/learn?place=lessons.startup.3", DESKTOP, false).await?;
    page.until(".spoken", "another device").await?;
    for _ in 0..3 {
        page.press_button("Next").await?;
    }
    page.until(".spoken", "Only here it says: not ready, parameter fault").await?;
    let shown = "return [...document.querySelectorAll('.sides > ol > li:not([hidden])')].length";
    assert_eq!(page.value(shown).await?, json!(4));
    page.picture("lesson-startup-desktop-light").await?;
    page.go("#/learn?place=lessons.startup.8").await?;
    page.until(".task h3", "Make Set_Prm right").await?;
    page.press_button("Check my answer").await?;
    page.until(".task .said.wrong", "05EBh").await?;
    let mended = "68 0C 0C 68 81 82 5D 3D 3E B8 0A 14 0B 05 EB 00 7F 16";
    page.fill(".task .typed input", mended).await?;
    page.press_button("Check my answer").await?;
    page.until(".task .said.wrong", "over your bytes it is AC").await?;
    page.fill(".task .typed input", &mended.replace("7F", "AC")).await?;
    page.press_button("Check my answer").await?;
    page.until(".task .said.right", "Right").await?;
    page.close().await
}

#[tokio::test(flavor = "multi_thread")]
async fn where_the_checksum_is_asked_for_the_page_adds_none() -> Result {
    let page = Page::open_at("#/learn?place=lessons.crc.6", PHONE, false).await?;
    page.fill(".task .typed input", "02 07").await?;
    page.until(".task .byte-strip", "02").await?;
    assert_eq!(page.count(".task .note").await?, 0);
    page.press_button("Check my answer").await?;
    page.until(".task .said.wrong", "The CRC is missing").await?;
    page.fill(".task .typed input", "02 07 41 12").await?;
    page.press_button("Check my answer").await?;
    page.until(".task .said.right", "in the standard").await?;
    page.close().await
}

/// Goes on with Tab until what has the focus is found by `css`.
async fn tab_to(page: &Page, css: &str) -> Result {
    for _ in 0..60 {
        page.press(Key::Tab + "").await?;
        if page.value(&format!("return document.activeElement.matches('{css}')")).await? == json!(true) {
            return Ok(());
        }
    }
    panic!("Tab does not lead to {css}");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_lesson_is_done_by_keyboard_alone() -> Result {
    let page = Page::open_at("#/learn?place=lessons.bytes.1", DESKTOP, true).await?;
    let lesson = &lessons()[0];
    for (step, number) in lesson.steps.iter().zip(1..) {
        page.until(".step h2", &step.title).await?;
        let exercise = step.exercise.as_ref().unwrap();
        match (&exercise.ask, exercise.answer(step).unwrap()) {
            (Ask::Bits { to, .. }, _) => {
                tab_to(&page, ".switches button").await?;
                for bit in (0..8).rev() {
                    if to[0] >> bit & 1 == 1 {
                        page.press(" ").await?;
                    }
                    page.press(Key::Right + "").await?;
                }
                tab_to(&page, ".task [type=submit]").await?;
            }
            (_, Answer::Byte(at)) => {
                tab_to(&page, ".task .byte-strip button").await?;
                for _ in 0..at {
                    page.press(Key::Right + "").await?;
                }
                tab_to(&page, ".task [type=submit]").await?;
            }
            (_, Answer::Blanks(texts)) => {
                for text in texts {
                    tab_to(&page, ".task .input").await?;
                    page.press(text).await?;
                }
            }
            (_, Answer::Text(text)) => {
                tab_to(&page, ".task .input").await?;
                page.press(Key::Control + "a").await?;
                page.press(text).await?;
            }
            other => panic!("{other:?} is not done by keyboard here"),
        }
        page.press(Key::Enter + "").await?;
        page.until(".task .said.right", "Right").await?;
        if number < lesson.steps.len() {
            page.press(Key::Shift + Key::Tab).await?;
            let next = "return document.activeElement.matches('.said a')";
            if page.value(next).await? != json!(true) {
                tab_to(&page, ".said a").await?;
            }
            page.press(Key::Enter + "").await?;
        }
    }
    page.close().await
}

/// Puts a file into the field that opens lessons.
async fn open(page: &Page, name: &str, text: &str) -> Result {
    let script = "const files = new DataTransfer(); files.items.add(new File([arguments[1]], arguments[0])); \
                  const field = document.querySelector('.files input[type=file]'); field.files = files.files; \
                  field.dispatchEvent(new Event('change', { bubbles: true }))";
    page.driver.execute(script, vec![json!(name), json!(text)]).await?;
    page.settle().await
}

const OWN: &str = "# Our own\nkey: our-own\ngroup: Training room\nabout: Ours.\n## One\ntelegram: 01 03 00 C8 00 03 84 35\n\
                   - Quantity: {value} registers.\nholds: Quantity = 3\ntask: How many?\nnumber: Quantity\n";

#[tokio::test(flavor = "multi_thread")]
async fn a_trainer_opens_a_lesson_of_his_own() -> Result {
    let page = Page::open_at("#/learn?place=lessons", DESKTOP, false).await?;
    page.one(".files").await?;
    // A mistake is told with its line, and nothing is taken.
    open(&page, "ours.txt", &OWN.replace("= 3", "= 4")).await?;
    page.until(".mistakes", "Line 8").await?;
    page.until(".mistakes", "not 4").await?;
    assert_eq!(page.accessibility().await?, [""; 0]);
    open(&page, "ours.txt", OWN).await?;
    assert_eq!(page.count(".mistakes").await?, 0);
    page.until(".overview", "Our own").await?;
    page.go("#/learn?place=lessons.our-own.1").await?;
    page.until(".spoken", "3 registers.").await?;
    page.driver
        .execute(format!("{SET} set(document.querySelector('.task .typed input'), '3')"), vec![])
        .await?;
    page.press_button("Check my answer").await?;
    page.until(".said.right", "Right").await?;
    page.driver.execute("location.hash = '#/learn?place=lessons'", vec![]).await?;
    page.until(".overview", "Our own").await?;
    page.press_button("Remove “Our own”").await?;
    assert!(!page.text(".overview").await?.contains("Our own"));
    page.press_button("Undo").await?;
    page.until(".overview", "Our own").await?;
    // Progress of somebody else's file is joined.
    open(&page, "done.txt", "Buslens: lessons that are done\nbytes: 1 2 3 4 5 6\n").await?;
    page.until(".overview header", "7 of").await?;
    open(&page, "other.txt", "nonsense").await?;
    page.until(".mistakes", "A lesson begins with its title").await?;
    page.close().await
}
