use crate::field::{Direction, Message};
use crate::message;
use crate::modbus::{EXCEPTION, KINDS, Kind, Length, Pdu};

/// Who speaks in a telegram, as far as its bytes tell.
#[derive(Clone, Debug, PartialEq)]
pub struct Guess {
    /// How the telegram is read.
    pub direction: Direction,
    /// `false` where the bytes leave it open, or fit neither and the nearer one was taken.
    pub certain: bool,
    /// Why.
    pub reason: Message,
}

/// Tells from a PDU's function code and length whether it is a request or a response.
pub fn direction(pdu: &[u8]) -> Guess {
    let Some(function) = pdu.first().copied() else {
        return Guess {
            direction: Direction::Request,
            certain: false,
            reason: message!("too short to tell request from response"),
        };
    };
    if function & EXCEPTION != 0 {
        let plain = function & !EXCEPTION;
        let reason = message!("80h in the function code marks a refusal of function {f}", f = plain);
        return Guess { direction: Direction::Response, certain: true, reason };
    }
    if !KINDS.iter().any(|kind| kind.function == function) {
        let reason = message!("function {f} is not known: both directions are possible", f = function);
        return Guess { direction: Direction::Request, certain: false, reason };
    }
    let request = Pdu::kind(function, Direction::Request);
    let response = Pdu::kind(function, Direction::Response);
    match (request.length.fits(pdu), response.length.fits(pdu)) {
        (true, false) => Guess {
            direction: Direction::Request,
            certain: true,
            reason: message!("its length fits a request of function {f} only", f = function),
        },
        (false, true) => Guess {
            direction: Direction::Response,
            certain: true,
            reason: message!("its length fits a response of function {f} only", f = function),
        },
        (true, true) => Guess {
            direction: Direction::Request,
            certain: false,
            reason: message!("in function {f}, request and response look the same here", f = function),
        },
        (false, false) => nearer(function, pdu, request, response),
    }
}

/// The direction whose length the PDU misses by less. A cut request is likelier than a response
/// that is too long by as much, and looks better while one types.
fn nearer(function: u8, pdu: &[u8], request: &Kind, response: &Kind) -> Guess {
    let missed = |length: Length| length.of(pdu).map_or(usize::MAX, |length| length.abs_diff(pdu.len()));
    let (of_request, of_response) = (missed(request.length), missed(response.length));
    let direction = if of_response < of_request { Direction::Response } else { Direction::Request };
    let reason = match (request.length.of(pdu), response.length.of(pdu)) {
        (Some(request), Some(response)) => message!(
            "its length fits neither: function {f} has {request} bytes in a request, {response} in a response, here are {found}",
            f = function,
            request = request,
            response = response,
            found = pdu.len()
        ),
        _ => message!("too short for function {f}: {found} bytes", f = function, found = pdu.len()),
    };
    Guess { direction, certain: false, reason }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn guessed(pdu: &[u8]) -> (Direction, bool) {
        let guess = direction(pdu);
        (guess.direction, guess.certain)
    }

    #[test]
    fn the_length_tells() {
        use Direction::{Request, Response};
        assert_eq!(guessed(&[3, 0, 200, 0, 3]), (Request, true));
        assert_eq!(guessed(&[3, 6, 0, 8, 0x42, 0xA4, 0xF1, 0xDE]), (Response, true));
        assert_eq!(guessed(&[16, 0, 215, 0, 3]), (Response, true));
        assert_eq!(guessed(&[16, 0, 215, 0, 1, 2, 0, 1]), (Request, true));
        assert_eq!(guessed(&[100, 0x20, 0, 0, 2]), (Request, true));
        assert_eq!(guessed(&[100, 4, 0, 0, 0, 2]), (Response, true));
        assert_eq!(guessed(&[0xE4, 64]), (Response, true));
    }

    #[test]
    fn an_odd_byte_count_is_no_response() {
        // A request whose address begins with 03 looks like a response of three bytes.
        assert_eq!(guessed(&[3, 3, 0x20, 0, 3]), (Direction::Request, true));
        assert_eq!(guessed(&[100, 3, 0x20, 0, 3]), (Direction::Request, true));
    }

    #[test]
    fn what_is_open_is_said_to_be_open() {
        assert_eq!(guessed(&[6, 0, 1, 0, 2]), (Direction::Request, false));
        assert_eq!(guessed(&[99, 0, 1]), (Direction::Request, false));
        assert_eq!(guessed(&[]), (Direction::Request, false));
    }

    #[test]
    fn the_nearer_length_counts_where_neither_fits() {
        // A response with a byte too many, and a request with one too few.
        assert_eq!(guessed(&[3, 4, 0, 8, 0, 0, 0]), (Direction::Response, false));
        assert_eq!(guessed(&[3, 0, 200, 0]), (Direction::Request, false));
        assert_eq!(guessed(&[16, 0, 215, 0, 3, 6, 0, 128, 66, 246, 233]), (Direction::Request, false));
    }
}
