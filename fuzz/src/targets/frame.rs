use super::law::assert_tiled;
use super::{Target, USUAL_MEMORY};
use crate::{Input, make};
use buslens::field::{Direction, hex};
use buslens::frame::Frame;
use buslens::tool::{Verdict, replies};
use buslens::walk::{self, Deviations, form};

/// Bytes read as any protocol: tiled, written again, edited in a form, answered.
pub static TARGET: Target = Target {
    key: "frame",
    about: "bytes to value to bytes, and to form to bytes, in every protocol",
    share: 3,
    memory: USUAL_MEMORY,
    make: |random, seeds| [make::choices(random, CHOICES), make::telegram(random, seeds)].concat(),
    run,
};

const CHOICES: usize = 6;

fn run(data: &[u8]) {
    let mut input = Input::new(data, CHOICES);
    let (protocol, direction, more) = (input.protocol(), input.direction(), input.byte());
    let settings = input.settings();
    let bytes = input.content();
    let expect = |bytes: &[u8]| (protocol.expect)(bytes, direction, &settings.frame);
    let mut frame = expect(bytes);
    let reading = walk::read(frame.as_mut(), bytes);
    assert_tiled(&reading.fields, bytes);
    assert!(!frame.meaning().sentence().is_empty());
    let deviations = reading.deviations(frame.as_mut());
    assert_eq!(hex(&walk::write(frame.as_mut(), &deviations)), hex(bytes), "{}", protocol.key);
    let verdict = (protocol.verdict)(bytes);
    assert!(verdict != Verdict::Right || !bytes.is_empty());
    let first = (protocol.first)(bytes);
    assert!(first <= bytes.len(), "{}: first {first} of {}", protocol.key, hex(bytes));
    (protocol.unit)(bytes);
    (protocol.exchange)(bytes);
    (protocol.fit)(bytes, &settings.frame);
    if more & 3 == 0 {
        let shown = form::form(frame.as_mut(), &deviations);
        let mut filled = expect(&[]);
        let entered = form::fill(filled.as_mut(), &shown).expect("a form fills what it was made of");
        assert_eq!(hex(&walk::write(filled.as_mut(), &entered)), hex(bytes), "{} by its form", protocol.key);
        assert_eq!(form::form(filled.as_mut(), &entered), shown);
    }
    if more & 12 == 0 && direction == Direction::Request {
        answer(
            frame.as_mut(),
            &|bytes| (protocol.expect)(bytes, Direction::Response, &settings.frame),
            &settings,
        );
    }
}

/// What can come back is read again as it was written.
fn answer(
    request: &mut dyn Frame,
    expect: &dyn Fn(&[u8]) -> Box<dyn Frame>,
    settings: &buslens::tool::Settings,
) {
    for mut reply in replies(request, &settings.frame.profibus, None) {
        let bytes = walk::write(reply.frame.as_mut(), &Deviations::default());
        let mut again = expect(&bytes);
        again.answer(&request.content());
        let reading = walk::read(again.as_mut(), &bytes);
        assert_tiled(&reading.fields, &bytes);
    }
}
