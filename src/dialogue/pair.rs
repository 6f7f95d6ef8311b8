use crate::field::Direction;

/// Finds the request that a response answers, telegram after telegram.
///
/// One client speaks on a serial line, and it waits: a response answers the request just before
/// it, if unit and function are the same.
#[derive(Debug, Default)]
pub struct Pairing {
    waiting: Option<Waiting>,
}

#[derive(Debug)]
struct Waiting {
    /// The request's place in the caller's list.
    index: usize,
    /// Unit and function code without the exception bit.
    asked: [u8; 2],
}

impl Pairing {
    /// Takes the next telegram of the line, `index` in the caller's list. Returns the index of the
    /// request that it answers.
    pub fn next(&mut self, index: usize, direction: Direction, unit: u8, function: u8) -> Option<usize> {
        let asked = [unit, function & !crate::modbus::EXCEPTION];
        match direction {
            Direction::Request => {
                self.waiting = Some(Waiting { index, asked });
                None
            }
            Direction::Response => self.waiting.take_if(|waiting| waiting.asked == asked).map(|w| w.index),
        }
    }

    /// The request that waits for an answer.
    pub fn waiting(&self) -> Option<usize> {
        self.waiting.as_ref().map(|waiting| waiting.index)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Direction::{Request, Response};

    #[test]
    fn a_response_answers_the_request_before_it() {
        let mut pairing = Pairing::default();
        assert_eq!(pairing.next(0, Request, 1, 3), None);
        assert_eq!(pairing.next(1, Response, 1, 3), Some(0));
        assert_eq!(pairing.next(2, Response, 1, 3), None, "answered only once");
        assert_eq!(pairing.next(3, Request, 1, 16), None);
        assert_eq!(pairing.next(4, Response, 2, 16), None, "another unit");
        assert_eq!(pairing.next(5, Response, 1, 0x90), Some(3), "a refusal answers, too");
    }

    #[test]
    fn a_new_request_takes_the_place_of_an_unanswered_one() {
        let mut pairing = Pairing::default();
        pairing.next(0, Request, 1, 3);
        pairing.next(1, Request, 1, 4);
        assert_eq!(pairing.next(2, Response, 1, 3), None);
        assert_eq!(pairing.next(3, Response, 1, 4), Some(1));
    }
}
