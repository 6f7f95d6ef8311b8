use super::{Certainty, Guess};
use crate::field::{Direction, Message};
use crate::message;

/// Who speaks in telegrams whose two sides take turns, by how much each looks like a response
/// (above 0) or a request (below 0).
///
/// In a sequence request and response alternate; which of the two comes first is what all of them
/// together say. Where they do not alternate, each is taken for what it looks like.
pub fn turns(leanings: &[i32]) -> Vec<Guess> {
    let signs = [-1, 1].into_iter().cycle();
    let request_first: i32 = leanings.iter().zip(signs).map(|(leaning, sign)| leaning * sign).sum();
    let all: i32 = leanings.iter().map(|leaning| leaning.abs()).sum();
    let alternate = leanings.len() > 1 && 2 * request_first.abs() > all;
    let guess = |(index, leaning): (usize, &i32)| {
        if !alternate {
            return self::leaning(*leaning);
        }
        let direction = if index.is_multiple_of(2) == request_first.is_positive() {
            Direction::Request
        } else {
            Direction::Response
        };
        let reason = message!("request and response take turns");
        Guess { direction, certainty: Certainty::Likely, reason }
    };
    leanings.iter().enumerate().map(guess).collect()
}

/// Who speaks in one such telegram by itself.
pub fn leaning(leaning: i32) -> Guess {
    /// A sign that only one of the two gives.
    const SURE: i32 = 10;
    let direction = if leaning > 0 { Direction::Response } else { Direction::Request };
    match leaning.abs() {
        0 => Guess {
            direction,
            certainty: Certainty::Open,
            reason: message!("request and response look the same here"),
        },
        SURE.. => Guess {
            direction,
            certainty: Certainty::Certain,
            reason: message!("only a response has an error"),
        },
        _ => Guess {
            direction,
            certainty: Certainty::Likely,
            reason: message!("it looks more like one than the other"),
        },
    }
}

/// Who speaks in a telegram that says it, or that goes one way only: `reason` says which of the two.
pub fn told(direction: Option<Direction>, reason: Message) -> Guess {
    match direction {
        Some(direction) => Guess { direction, certainty: Certainty::Certain, reason },
        None => Guess {
            direction: Direction::Request,
            certainty: Certainty::Open,
            reason: message!("it is neither asked nor answered"),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Direction::{Request, Response};

    fn told_by(leanings: &[i32]) -> Vec<Direction> {
        turns(leanings).iter().map(|guess| guess.direction).collect()
    }

    #[test]
    fn a_sequence_alternates() {
        assert_eq!(
            told_by(&[-3, 0, -3, 0, -3, 10]),
            [Request, Response, Request, Response, Request, Response]
        );
        assert_eq!(told_by(&[0, -3, 0, -3]), [Response, Request, Response, Request]);
    }

    #[test]
    fn what_does_not_alternate_is_told_one_by_one() {
        assert_eq!(told_by(&[-3, -3, -3]), [Request; 3]);
        assert_eq!(told_by(&[10, 4]), [Response; 2]);
        assert_eq!(told_by(&[3]), [Response]);
        assert_eq!(told_by(&[0, 0]), [Request; 2]);
    }
}
