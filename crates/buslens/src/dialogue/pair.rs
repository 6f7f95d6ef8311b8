use crate::field::Direction;
use crate::frame::ANY_EXCHANGE;

/// Finds the request that a response answers, telegram after telegram.
///
/// What the two have in common is a number that the protocol makes: unit and function on a serial
/// line, the transaction as well over TCP. On a serial line one client speaks, and it waits: a
/// response answers the request just before it. Over TCP several requests can wait.
#[derive(Debug, Default)]
pub struct Pairing {
    /// Oldest first.
    waiting: Vec<Waiting>,
}

#[derive(Debug)]
struct Waiting {
    /// The request's place in the caller's list.
    index: usize,
    exchange: u64,
}

impl Pairing {
    /// Takes the next telegram, `index` in the caller's list; `most` requests can wait. Returns the
    /// index of the request that it answers.
    pub fn next(&mut self, index: usize, direction: Direction, exchange: u64, most: usize) -> Option<usize> {
        match direction {
            Direction::Request => {
                self.waiting.push(Waiting { index, exchange });
                let too_many = self.waiting.len().saturating_sub(most);
                self.waiting.drain(..too_many);
                None
            }
            Direction::Response => {
                let asked = self.place(exchange)?;
                Some(self.waiting.remove(asked).index)
            }
        }
    }

    /// The request that a response of this exchange would answer.
    pub fn waiting(&self, exchange: u64) -> Option<usize> {
        self.place(exchange).map(|place| self.waiting[place].index)
    }

    fn place(&self, exchange: u64) -> Option<usize> {
        self.waiting.iter().position(|it| exchange == ANY_EXCHANGE || it.exchange == exchange)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Direction::{Request, Response};

    #[test]
    fn a_response_answers_the_request_before_it() {
        let mut pairing = Pairing::default();
        assert_eq!(pairing.next(0, Request, 0x0103, 1), None);
        assert_eq!(pairing.next(1, Response, 0x0103, 1), Some(0));
        assert_eq!(pairing.next(2, Response, 0x0103, 1), None, "answered only once");
        assert_eq!(pairing.next(3, Request, 0x0110, 1), None);
        assert_eq!(pairing.next(4, Response, 0x0210, 1), None, "another unit");
        assert_eq!(pairing.next(5, Response, 0x0110, 1), Some(3));
    }

    #[test]
    fn a_new_request_takes_the_place_of_an_unanswered_one() {
        let mut pairing = Pairing::default();
        pairing.next(0, Request, 0x0103, 1);
        pairing.next(1, Request, 0x0104, 1);
        assert_eq!(pairing.next(2, Response, 0x0103, 1), None);
        assert_eq!(pairing.next(3, Response, 0x0104, 1), Some(1));
    }

    #[test]
    fn where_several_can_wait_each_finds_its_own() {
        let mut pairing = Pairing::default();
        pairing.next(0, Request, 1, 2);
        pairing.next(1, Request, 2, 2);
        assert_eq!(pairing.next(2, Response, 2, 2), Some(1));
        assert_eq!(pairing.next(3, Response, 1, 2), Some(0));
    }
}
