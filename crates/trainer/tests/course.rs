//! Moodle XML and GIFT, read again by parsers of our own that hold to the rules of the formats.

use buslens_trainer::practice::{Kind, LEVELS, Round, Seed};
use buslens_trainer::{Expected, Given, Number, Task, course};

/// An element with its attributes, what it has inside, and its text.
#[derive(Debug, Default)]
struct Element {
    name: String,
    attributes: Vec<(String, String)>,
    children: Vec<Element>,
    text: String,
}

impl Element {
    fn all(&self, name: &str) -> Vec<&Element> {
        self.children.iter().filter(|child| child.name == name).collect()
    }

    fn one(&self, name: &str) -> &Element {
        self.all(name).first().unwrap_or_else(|| panic!("{} without {name}", self.name))
    }
}

/// Reads well-formed XML, and nothing else.
fn xml(text: &str) -> Element {
    let text = text.strip_prefix("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n").expect("a declaration");
    let mut stack = vec![Element::default()];
    let mut rest = text;
    while !rest.is_empty() {
        if let Some(end) = rest.strip_prefix("</") {
            let (name, after) = end.split_once('>').expect("a closed tag");
            let done = stack.pop().unwrap();
            assert_eq!(done.name, name);
            stack.last_mut().expect("a parent").children.push(done);
            rest = after;
        } else if let Some(begin) = rest.strip_prefix('<') {
            let (tag, after) = begin.split_once('>').expect("a closed tag");
            let mut words = tag.splitn(2, ' ');
            let name = words.next().unwrap().to_owned();
            assert!(name.chars().all(|c| c.is_ascii_alphanumeric()), "{name}");
            let attribute = |word: &str| {
                let (key, value) = word.split_once('=').expect("key=value");
                let value = value.strip_prefix('"').and_then(|it| it.strip_suffix('"')).expect("quotes");
                (key.to_owned(), value.to_owned())
            };
            let attributes = words.next().map_or(Vec::new(), |all| all.split(' ').map(attribute).collect());
            stack.push(Element { name, attributes, ..Element::default() });
            rest = after;
        } else {
            let end = rest.find('<').unwrap_or(rest.len());
            let text = unescaped(&rest[..end]);
            stack.last_mut().unwrap().text += &text;
            rest = &rest[end..];
        }
    }
    assert_eq!(stack.len(), 1, "every tag is closed");
    let mut root = stack.pop().unwrap();
    assert_eq!(root.children.len(), 1);
    root.children.pop().unwrap()
}

fn unescaped(text: &str) -> String {
    let mut plain = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('&') {
        assert!(!before.contains('>'), "{before}");
        plain += before;
        let (name, after) = after.split_once(';').expect("an entity");
        plain.push(match name {
            "amp" => '&',
            "lt" => '<',
            "gt" => '>',
            "quot" => '"',
            other => panic!("&{other};"),
        });
        rest = after;
    }
    plain + rest
}

/// A question of GIFT: name, text, and its answers with their signs.
#[derive(Debug, PartialEq)]
struct Gift {
    name: String,
    text: String,
    answers: Vec<(char, String)>,
    feedback: String,
}

/// Reads GIFT: questions are parted by empty lines, what has a backslash before it is itself.
fn read_gift(text: &str) -> Vec<Gift> {
    let blocks = text.split("\n\n").filter(|block| !block.trim_start().starts_with(['/', '$']));
    blocks.map(|block| gift(block.trim())).collect()
}

fn gift(block: &str) -> Gift {
    let mut parts: Vec<(char, String)> = vec![(' ', String::new())];
    let mut characters = block.chars().peekable();
    let mut inside = false;
    while let Some(c) = characters.next() {
        match c {
            '\\' => match characters.next().expect("something behind a backslash") {
                'n' => parts.last_mut().unwrap().1.push('\n'),
                c @ ('~' | '=' | '#' | '{' | '}' | ':' | '\\') => parts.last_mut().unwrap().1.push(c),
                other => panic!("\\{other} in {block}"),
            },
            ':' if !inside && characters.peek() == Some(&':') => {
                characters.next();
                parts.push((':', String::new()));
            }
            '{' if !inside => inside = true,
            '}' if inside => {
                inside = false;
                assert_eq!(characters.peek(), None, "nothing follows");
            }
            '=' | '~' if inside => parts.push((c, String::new())),
            '#' if inside => {
                let more = (0..3).filter_map(|_| characters.next_if_eq(&'#')).count();
                assert_eq!(more, 3, "only general feedback is used");
                parts.push(('#', String::new()));
            }
            ':' | '{' | '}' => panic!("a bare {c} in {block}"),
            c => parts.last_mut().unwrap().1.push(c),
        }
    }
    assert!(!inside, "{block}");
    let of = |sign: char| parts.iter().filter(move |part| part.0 == sign).map(|part| part.1.clone());
    let mut heads = of(':');
    let name = heads.next().expect("a name");
    let text = heads.next().expect("a text").trim_end().strip_prefix("[plain]").expect("a format").to_owned();
    let answers = parts.iter().filter(|part| matches!(part.0, '=' | '~'));
    let answers = answers.map(|(sign, text)| (*sign, text.trim().to_owned())).collect();
    Gift { name, text, answers, feedback: of('#').next().expect("feedback").trim().to_owned() }
}

fn rounds() -> impl Iterator<Item = Round> {
    Kind::ALL
        .into_iter()
        .flat_map(|kind| LEVELS.map(move |level| Round { kind, level, seed: Seed::new(77_777) }))
}

#[test]
fn moodle_xml_is_well_formed_and_whole() {
    for round in rounds() {
        let tasks = round.questions();
        let quiz = xml(&course::moodle_xml("Test & <level>", &round.place(), &tasks));
        assert_eq!(quiz.name, "quiz");
        let questions = quiz.all("question");
        assert_eq!(questions.len(), tasks.len() + 1);
        assert_eq!(questions[0].one("category").one("text").text, "$course$/top/Test & <level>");
        for (question, task) in questions[1..].iter().zip(&tasks) {
            let kind = &question.attributes[0].1;
            assert!(question.one("questiontext").one("text").text.starts_with("<p>"));
            assert_eq!(question.all("hint").len(), 3);
            let answers = question.all("answer");
            let right = answers
                .iter()
                .filter(|answer| answer.attributes[0] == ("fraction".to_owned(), "100".to_owned()));
            match &task.expected {
                Expected::Choice { choices, .. } => {
                    assert_eq!(
                        (kind.as_str(), answers.len(), right.count()),
                        ("multichoice", choices.len(), 1)
                    );
                }
                _ => {
                    assert_eq!(kind, "shortanswer");
                    assert_eq!(right.count(), answers.len());
                }
            }
            if let Expected::Telegram(telegram) = &task.expected {
                assert!(answers.iter().any(|answer| answer.one("text").text == telegram.hex()));
            }
        }
    }
}

#[test]
fn gift_is_read_again() {
    for round in rounds() {
        let tasks = round.questions();
        let questions = read_gift(&course::gift("Test", &round.place(), &tasks));
        assert_eq!(questions.len(), tasks.len());
        for (index, (question, task)) in questions.iter().zip(&tasks).enumerate() {
            assert_eq!(question.name, format!("{}.{}", round.place(), index + 1));
            assert!(question.text.starts_with(&task.question), "{question:?}");
            for given in &task.given {
                if let Given::Text(text) = given {
                    assert!(question.text.contains(text), "{question:?}");
                }
            }
            assert_eq!(question.feedback, task.working.join("\n"));
            match &task.expected {
                Expected::Choice { choices, right } => {
                    let all: Vec<&String> = question.answers.iter().map(|answer| &answer.1).collect();
                    assert_eq!(all, choices.iter().map(|choice| &choice.text).collect::<Vec<_>>());
                    assert_eq!(question.answers[*right].0, '=');
                    assert_eq!(question.answers.iter().filter(|answer| answer.0 == '=').count(), 1);
                }
                _ => assert!(question.answers.iter().all(|answer| answer.0 == '='), "{question:?}"),
            }
        }
    }
}

/// Whatever somebody writes into a question comes out as it went in.
#[test]
fn signs_with_a_meaning_are_guarded() {
    let question = "a = b ~ c # {d} : e \\ f & <g> \"h\" % 100*\nnext::line // $";
    let task = Task {
        question: question.to_owned(),
        given: Vec::new(),
        expected: Expected::Number(Number::new("n", 200, 2, buslens::field::Format::Decimal)),
        hints: vec![question.to_owned()],
        working: vec![question.to_owned()],
    };
    let tasks = [task];
    let read = read_gift(&course::gift("x", "1", &tasks));
    assert_eq!(read[0].text, question);
    assert_eq!(read[0].feedback, question);
    assert_eq!(read[0].answers[0].1, "200");
    let quiz = xml(&course::moodle_xml("x", "1", &tasks));
    let html = &quiz.all("question")[1].one("questiontext").one("text").text;
    assert_eq!(
        unescaped(
            html.strip_prefix("<p>")
                .unwrap()
                .strip_suffix("</p>")
                .unwrap_or(html)
                .replace('>', "&gt;")
                .as_str()
        ),
        question
    );
}
