//! Function 22 (16h): mask write register. The response repeats the request, so that the two cannot
//! be told apart by their bytes.

use super::coils::runs;
use super::read_holding_registers::HOLDING_REGISTERS;
use super::{Access, Body, Kind, Length, Server};
use crate::field::{Direction, Format, Message, Spec};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

pub static REQUEST: Kind = Kind {
    function: 22,
    direction: Direction::Request,
    spec: Spec::new("mask_write_register_request", "Mask write register")
        .note("Sets and clears single bits of a register and leaves the others as they are.")
        .source(SOURCE),
    length: Length::Fixed(7),
    serial_only: false,
    new: || MaskWrite::of(Direction::Request),
};

pub static RESPONSE: Kind = Kind {
    function: 22,
    direction: Direction::Response,
    spec: Spec::new("mask_write_register_response", "Mask write register")
        .note("Repeats the request once the register is written.")
        .source(SOURCE),
    length: Length::Fixed(7),
    serial_only: false,
    new: || MaskWrite::of(Direction::Response),
};

/// Address (2 bytes), AND mask (2 bytes), OR mask (2 bytes).
///
/// The register becomes (register AND `and`) OR (`or` AND NOT `and`).
pub struct MaskWrite {
    pub direction: Direction,
    pub address: u16,
    pub and: u16,
    pub or: u16,
}

impl MaskWrite {
    pub fn of(direction: Direction) -> Box<dyn Body> {
        Box::new(Self { direction, address: 0, and: 0xFFFF, or: 0 })
    }
}

impl Telegram for MaskWrite {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        w.u16(&HOLDING_REGISTERS.start, &mut self.address)?;
        w.u16(&AND, &mut self.and)?;
        w.u16(&OR, &mut self.or)
    }
}

impl Body for MaskWrite {
    fn meaning(&self, who: Server) -> Message {
        let who = who.name();
        let (set, cleared) = (!self.and & self.or, !self.and & !self.or);
        let change = match (set, cleared) {
            (0, 0) => message!("no bit"),
            (_, 0) => message!("bits set: {set}", set = bits(set)),
            (0, _) => message!("bits cleared: {cleared}", cleared = bits(cleared)),
            _ => {
                message!("bits set: {set}; bits cleared: {cleared}", set = bits(set), cleared = bits(cleared))
            }
        };
        match self.direction {
            Direction::Request => message!(
                "change holding register {address} of {who}: {change}",
                address = self.address,
                who = who,
                change = change
            ),
            Direction::Response => message!(
                "{who} has changed holding register {address}: {change}",
                who = who,
                address = self.address,
                change = change
            ),
        }
    }

    fn access(&self) -> Option<Access<'_>> {
        Some(Access::write(&HOLDING_REGISTERS, self.address, 1, &[]))
    }
}

/// "0, 2, 8–15": the numbers of the bits that are set.
fn bits(word: u16) -> String {
    let bits: Vec<u32> = (0..16).map(|bit| u32::from(word >> bit & 1)).collect();
    runs("", 0, &bits)
}

static AND: Spec = Spec::new("and_mask", "AND mask")
    .short("AND")
    .format(Format::Hex)
    .note("A 1 leaves the register's bit as it is; a 0 puts that of the OR mask in its place.")
    .source(SOURCE);

static OR: Spec = Spec::new("or_mask", "OR mask")
    .short("OR")
    .format(Format::Hex)
    .note("What becomes of the bits that are 0 in the AND mask. The others have no effect.")
    .source(SOURCE);

const SOURCE: &str = "Modbus application protocol V1.1b3, 6.16";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn masks_are_said_in_bits() {
        let said = |direction, and, or| {
            let write = MaskWrite { direction, address: 4, and, or };
            write.meaning(Server::Unit(1)).to_string()
        };
        let request = Direction::Request;
        assert_eq!(
            said(request, 0x00F2, 0x0025),
            "change holding register 4 of unit 1: bits set: 0, 2; bits cleared: 3, 8–15"
        );
        assert_eq!(said(request, 0xFFFF, 0x0025), "change holding register 4 of unit 1: no bit");
        assert_eq!(
            said(Direction::Response, 0xFFFE, 0x0001),
            "unit 1 has changed holding register 4: bits set: 0"
        );
    }
}
