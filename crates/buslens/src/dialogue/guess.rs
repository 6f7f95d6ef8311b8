use crate::field::{Direction, Message};
use crate::message;
use crate::modbus::{Dialect, EXCEPTION, KINDS, Kind, Length, Pdu};

/// Who speaks in a telegram, as far as its bytes tell.
#[derive(Clone, Debug, PartialEq)]
pub struct Guess {
    /// How the telegram is read.
    pub direction: Direction,
    pub certainty: Certainty,
    /// Why.
    pub reason: Message,
}

impl Guess {
    /// The direction; `None` where it is open.
    pub fn told(&self) -> Option<Direction> {
        (self.certainty != Certainty::Open).then_some(self.direction)
    }
}

/// How sure a direction is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Certainty {
    /// The bytes fit this direction only, or a person said so.
    Certain,
    /// The bytes fit neither direction; this one is nearer.
    Likely,
    /// The bytes do not tell.
    Open,
}

/// Tells from a PDU's function code and length whether it is a request or a response.
///
/// `around` is how many bytes its frame has besides: people count the frame's bytes. `awaited` says
/// that a request of the same function waits for its response.
pub fn direction(pdu: &[u8], around: usize, awaited: bool, dialect: &'static Dialect) -> Guess {
    let Some(function) = pdu.first().copied() else {
        return Guess {
            direction: Direction::Request,
            certainty: Certainty::Open,
            reason: message!("too short to tell request from response"),
        };
    };
    if function & EXCEPTION != 0 {
        let plain = function & !EXCEPTION;
        let reason = message!("80h in the function code marks an exception to function {f}", f = plain);
        return Guess { direction: Direction::Response, certainty: Certainty::Certain, reason };
    }
    if !KINDS.iter().any(|kind| kind.function == function) {
        let reason = message!("function {f} is unknown, so both directions are possible", f = function);
        return Guess { direction: Direction::Request, certainty: Certainty::Open, reason };
    }
    let request = Pdu::kind(function, Direction::Request, dialect);
    let response = Pdu::kind(function, Direction::Response, dialect);
    match (request.length.fits(pdu), response.length.fits(pdu)) {
        (true, false) => Guess {
            direction: Direction::Request,
            certainty: Certainty::Certain,
            reason: message!("its length fits a request of function {f} only", f = function),
        },
        (false, true) => Guess {
            direction: Direction::Response,
            certainty: Certainty::Certain,
            reason: message!("its length fits a response of function {f} only", f = function),
        },
        (true, true) => Guess {
            direction: Direction::Request,
            certainty: Certainty::Open,
            reason: message!("in function {f}, request and response look the same here", f = function),
        },
        (false, false) => nearer(pdu, around, awaited, request, response),
    }
}

/// The direction whose length the PDU misses by less.
fn nearer(pdu: &[u8], around: usize, awaited: bool, request: &Kind, response: &Kind) -> Guess {
    /// How many slips more a response may have that somebody waits for.
    const AWAITED: usize = 2;
    let allowed = if awaited { AWAITED } else { 0 };
    let (of_request, of_response) = (slips(request.length, pdu), slips(response.length, pdu));
    let direction = if of_response <= of_request.saturating_add(allowed) {
        Direction::Response
    } else {
        Direction::Request
    };
    let length = |length: Length| match length.of(pdu) {
        Some(length) => Message::bytes(length + around),
        None => message!("more bytes"),
    };
    let reason = message!(
        "its length fits neither direction: in function {f} a request has {request} here, a response {response}, and there are {found}",
        f = request.function,
        request = length(request.length),
        response = length(response.length),
        found = Message::bytes(pdu.len() + around)
    );
    Guess { direction, certainty: Certainty::Likely, reason }
}

/// How many slips it takes to make `pdu` of such a length: a byte or a whole item too many or too
/// few is one; so is a byte count that counts no whole items; one that counts nothing is unlikely.
fn slips(length: Length, pdu: &[u8]) -> usize {
    const EMPTY: usize = 4;
    let Some(right) = length.of(pdu) else { return usize::MAX };
    let missed = right.abs_diff(pdu.len());
    let Length::Counted { at, unit } = length else { return missed };
    let counted = right - at - 1;
    let whole = counted.is_multiple_of(unit);
    let missed = if whole && missed.is_multiple_of(unit) { missed / unit } else { missed };
    // A write of nothing is a slip of the client; a response with nothing is not one.
    let empty = counted == 0 && !(missed == 0 && at > 1);
    missed + usize::from(!whole) + if empty { EMPTY } else { 0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modbus::STANDARD;
    use Certainty::{Certain, Likely, Open};

    fn guessed(pdu: &[u8]) -> (Direction, Certainty) {
        let guess = direction(pdu, 3, false, &STANDARD);
        (guess.direction, guess.certainty)
    }

    #[test]
    fn the_length_tells() {
        use Direction::{Request, Response};
        assert_eq!(guessed(&[3, 0, 200, 0, 3]), (Request, Certain));
        assert_eq!(guessed(&[3, 6, 0, 8, 0x42, 0xA4, 0xF1, 0xDE]), (Response, Certain));
        assert_eq!(guessed(&[16, 0, 215, 0, 3]), (Response, Certain));
        assert_eq!(guessed(&[16, 0, 215, 0, 1, 2, 0, 1]), (Request, Certain));
        assert_eq!(guessed(&[100, 0x20, 0, 0, 2]), (Request, Certain));
        assert_eq!(guessed(&[100, 4, 0, 0, 0, 2]), (Response, Certain));
        assert_eq!(guessed(&[0xE4, 64]), (Response, Certain));
    }

    #[test]
    fn an_odd_byte_count_is_no_response() {
        // A request whose address begins with 03 looks like a response of three bytes.
        assert_eq!(guessed(&[3, 3, 0x20, 0, 3]), (Direction::Request, Certain));
        assert_eq!(guessed(&[100, 3, 0x20, 0, 3]), (Direction::Request, Certain));
    }

    #[test]
    fn what_is_open_is_said_to_be_open() {
        assert_eq!(guessed(&[6, 0, 1, 0, 2]), (Direction::Request, Open));
        assert_eq!(guessed(&[99, 0, 1]), (Direction::Request, Open));
        assert_eq!(guessed(&[]), (Direction::Request, Open));
    }

    #[test]
    fn the_nearer_length_counts_where_neither_fits() {
        // A response with a byte too many, and a request with one too few.
        assert_eq!(guessed(&[3, 4, 0, 8, 0, 0, 0]), (Direction::Response, Likely));
        // A whole register is missing.
        assert_eq!(guessed(&[3, 4, 0, 8]), (Direction::Response, Likely));
        assert_eq!(direction(&[3, 4, 0, 8, 0, 0], 3, true, &STANDARD).direction, Direction::Response);
        // A request while it is typed, even where one waits already.
        assert_eq!(direction(&[3, 0, 200], 3, true, &STANDARD).direction, Direction::Request);
        assert_eq!(guessed(&[3, 0]), (Direction::Request, Likely));
        assert_eq!(guessed(&[3, 0, 200]), (Direction::Request, Likely));
        // Five bytes are no whole registers, but there are five.
        assert_eq!(guessed(&[3, 5, 0, 8, 0, 0, 0]), (Direction::Response, Likely));
        assert_eq!(guessed(&[3, 0, 200, 0]), (Direction::Request, Likely));
        assert_eq!(guessed(&[16, 0, 215, 0, 3, 6, 0, 128, 66, 246, 233]), (Direction::Request, Likely));
    }
}
