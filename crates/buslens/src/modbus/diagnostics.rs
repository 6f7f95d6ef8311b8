//! Function 8: diagnostics of the serial line. A sub-function says what is to be tested or told.
//!
//! Layout of request and response: sub-function (2 bytes), data (2 bytes; with sub-function 0 any
//! number of bytes).

use super::{Body, Choice, Kind, Length, Server};
use crate::field::{Argument, Bits, Direction, Format, Message, Name, Role, Spec, hex};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

pub static REQUEST: Kind = Kind {
    function: 8,
    direction: Direction::Request,
    spec: Spec::new("diagnostics_request", "Diagnostics")
        .note("Tests the line, or asks for one of the server's counters.")
        .source(SOURCE),
    length: LENGTH,
    serial_only: true,
    new: || Diagnostics::of(Direction::Request),
};

pub static RESPONSE: Kind = Kind {
    function: 8,
    direction: Direction::Response,
    spec: Spec::new("diagnostics_response", "Diagnostics")
        .note("Repeats the request, or has the counter asked for in place of its data.")
        .source(SOURCE),
    length: LENGTH,
    serial_only: true,
    new: || Diagnostics::of(Direction::Response),
};

const LENGTH: Length = Length::Chosen {
    at: 1,
    width: 2,
    by: |number| match sub_function(number).request {
        Data::Bytes => Length::Open,
        Data::Number(_) | Data::Choice(_) => Length::Fixed(5),
    },
};

/// A sub-function and its data.
pub struct Diagnostics {
    pub direction: Direction,
    pub sub_function: u16,
    /// The data where the sub-function has a number.
    pub number: u16,
    /// The data where it has bytes.
    pub bytes: Vec<u8>,
}

impl Diagnostics {
    pub fn of(direction: Direction) -> Box<dyn Body> {
        Box::new(Self { direction, sub_function: 0, number: 0, bytes: Vec::new() })
    }

    fn sub_function(&self) -> &'static SubFunction {
        sub_function(self.sub_function.into())
    }

    fn data(&self) -> Data {
        match self.direction {
            Direction::Request => self.sub_function().request,
            Direction::Response => self.sub_function().response,
        }
    }
}

impl Telegram for Diagnostics {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        w.choose(&SUB_FUNCTION, 2, &mut self.sub_function, &|number| &sub_function(number).spec)?;
        match self.data() {
            Data::Bytes => w.bytes(&DATA, &mut self.bytes, None),
            Data::Number(spec) => w.u16(spec, &mut self.number),
            Data::Choice(choice) => choice.walk(w, &mut self.number),
        }
    }
}

impl Body for Diagnostics {
    fn meaning(&self, who: Server) -> Message {
        let who = who.name();
        let what = Argument::Term(self.sub_function().spec.label);
        match (self.direction, self.data()) {
            (Direction::Request, Data::Bytes) => {
                message!(
                    "diagnostics of {who}, {what}: {bytes}",
                    who = who,
                    what = what,
                    bytes = hex(&self.bytes)
                )
            }
            (Direction::Request, _) => message!("diagnostics of {who}: {what}", who = who, what = what),
            (Direction::Response, Data::Bytes) => {
                message!("{who} answers to {what}: {bytes}", who = who, what = what, bytes = hex(&self.bytes))
            }
            (Direction::Response, Data::Number(spec)) if spec.limits.is_none() => message!(
                "{who} answers to {what}: {number}",
                who = who,
                what = what,
                number = crate::field::number_text(self.number.into(), 2, spec.format)
            ),
            (Direction::Response, _) => message!("{who} confirms: {what}", who = who, what = what),
        }
    }

    fn only_reads(&self) -> bool {
        self.sub_function().only_reads
    }
}

/// What a sub-function has as its data.
#[derive(Clone, Copy, Debug)]
enum Data {
    Bytes,
    Number(&'static Spec),
    Choice(&'static Choice),
}

#[derive(Debug)]
struct SubFunction {
    number: u64,
    spec: Spec,
    request: Data,
    response: Data,
    /// It changes nothing in the server.
    only_reads: bool,
}

impl SubFunction {
    /// One that the response repeats.
    const fn repeated(number: u64, label: &'static str, note: &'static str, data: Data) -> Self {
        let spec = Spec::new("sub_function", label).note(note);
        Self { number, spec, request: data, response: data, only_reads: false }
    }

    /// One that the response answers with a number.
    const fn told(number: u64, label: &'static str, note: &'static str, answer: &'static Spec) -> Self {
        let response = Data::Number(answer);
        Self { response, only_reads: true, ..Self::repeated(number, label, note, ZERO) }
    }
}

/// The sub-function with this number.
fn sub_function(number: u64) -> &'static SubFunction {
    SUB_FUNCTIONS.iter().find(|known| known.number == number).unwrap_or(&UNKNOWN)
}

static SUB_FUNCTIONS: &[SubFunction] = &[
    SubFunction {
        only_reads: true,
        ..SubFunction::repeated(
            0,
            "return query data",
            "The server sends the data back as it came.",
            Data::Bytes,
        )
    },
    SubFunction::repeated(
        1,
        "restart communications",
        "The server starts its line anew, clears its counters and leaves listen only mode.",
        Data::Choice(&EVENT_LOG),
    ),
    SubFunction::told(
        2,
        "return diagnostic register",
        "Asks for 16 bits whose meaning the device's manual tells.",
        &DIAGNOSTIC_REGISTER,
    ),
    SubFunction::repeated(
        3,
        "change ASCII input delimiter",
        "On a Modbus ASCII line, the character that ends a telegram from now on. Without it, line feed.",
        Data::Number(&DELIMITER),
    ),
    SubFunction::repeated(
        4,
        "force listen only mode",
        "The server hears and neither obeys nor answers until its communication is restarted. It does not \
         answer this either.",
        ZERO,
    ),
    SubFunction::repeated(10, "clear counters", "Sets all counters and the diagnostic register to 0.", ZERO),
    SubFunction::told(
        11,
        "return bus message count",
        "Asks how many telegrams the server has heard, whomever they were for.",
        &COUNT,
    ),
    SubFunction::told(
        12,
        "return bus communication error count",
        "Asks how many telegrams had a wrong checksum.",
        &COUNT,
    ),
    SubFunction::told(
        13,
        "return bus exception error count",
        "Asks how many requests the server has rejected with an exception.",
        &COUNT,
    ),
    SubFunction::told(
        14,
        "return server message count",
        "Asks how many telegrams were for this server, broadcasts included.",
        &COUNT,
    ),
    SubFunction::told(
        15,
        "return server no response count",
        "Asks how many telegrams for this server it has not answered.",
        &COUNT,
    ),
    SubFunction::told(
        16,
        "return server NAK count",
        "Asks how often the server has answered with exception 7.",
        &COUNT,
    ),
    SubFunction::told(
        17,
        "return server busy count",
        "Asks how often the server has answered with exception 6.",
        &COUNT,
    ),
    SubFunction::told(
        18,
        "return bus character overrun count",
        "Asks how many telegrams came faster than the server could take them.",
        &COUNT,
    ),
    SubFunction::repeated(
        20,
        "clear overrun counter",
        "Sets the count of overruns to 0, and the flag that says that there were some.",
        ZERO,
    ),
];

static UNKNOWN: SubFunction = SubFunction::repeated(0, "sub-function not known", "", Data::Bytes);

static SUB_FUNCTION: Spec = Spec::new("sub_function", "Sub-function")
    .role(Role::Function)
    .note("What is to be tested or told. The numbers 5 to 9, 19 and those above 20 are reserved.")
    .source(SOURCE);

static DATA: Spec = Spec::new("data", "Data").note("Any bytes; the server sends them back.").source(SOURCE);

/// The data of sub-functions that need none.
const ZERO: Data = Data::Number(&NO_DATA);

static NO_DATA: Spec = Spec::new("data", "Data")
    .format(Format::Hex)
    .limits(0, 0)
    .note("This sub-function has none: 0000h.")
    .source(SOURCE);

static COUNT: Spec = Spec::new("count", "Count")
    .note("What the server has counted since it was started or told to count anew.")
    .source(SOURCE);

static DIAGNOSTIC_REGISTER: Spec = Spec::new("diagnostic_register", "Diagnostic register")
    .short("Register")
    .role(Role::Status)
    .format(Format::Hex)
    .note("What each bit says is in the device's manual.")
    .source(SOURCE);

static DELIMITER: Spec = Spec::new("delimiter", "Delimiter")
    .note("The character in the first byte; the second one is 0.")
    .source(SOURCE)
    .bits(&[Bits::reserved(0, 8), Bits::part(8, 8, "character", "character")]);

static EVENT_LOG: Choice = Choice::new(
    Spec::new("event_log", "Event log")
        .format(Format::Hex)
        .note("Whether the log of function 12 is cleared, too.")
        .source(SOURCE),
    2,
    &[Name { value: 0, label: "kept", note: "" }, Name { value: 0xFF00, label: "cleared", note: "" }],
);

const SOURCE: &str = "Modbus application protocol V1.1b3, 6.8";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modbus::{Pdu, STANDARD};
    use crate::walk::{Deviations, read, sample, write};

    #[test]
    fn every_sub_function_is_written_and_read() {
        for (number, direction) in
            (0..=21).flat_map(|number| [(number, Direction::Request), (number, Direction::Response)])
        {
            let mut body = Diagnostics { direction, sub_function: number, number: 0, bytes: Vec::new() };
            let mut seed = 0;
            sample(&mut body, &mut |most| {
                seed += 0x4321;
                seed % most.saturating_add(1).max(1)
            });
            let mut bytes = vec![8];
            bytes.extend(write(&mut body, &Deviations::default()));
            assert!(LENGTH.fits(&bytes), "{bytes:?}");
            let mut pdu = Pdu::expect(8, direction, &STANDARD);
            let reading = read(&mut pdu, &bytes);
            assert!(crate::field::problems(&reading.fields).is_empty(), "{:?}", reading.fields);
            assert_eq!(write(&mut pdu, &Deviations::default()), bytes);
            let told = LENGTH.of(&bytes).is_some();
            let cut = read(&mut pdu, &bytes[..bytes.len() - 1]).fields;
            assert_eq!(told, crate::field::problems(&cut).iter().any(|problem| problem.code == "truncated"));
        }
    }

    #[test]
    fn responses_say_what_they_answer() {
        let said = |bytes: &[u8]| {
            let mut pdu = Pdu::expect(8, Direction::Response, &STANDARD);
            read(&mut pdu, bytes);
            pdu.body.meaning(Server::Unit(5)).to_string()
        };
        assert_eq!(said(&[8, 0, 0, 0xA5, 0x37]), "unit 5 answers to return query data: A5 37");
        assert_eq!(said(&[8, 0, 11, 1, 0]), "unit 5 answers to return bus message count: 256");
        assert_eq!(said(&[8, 0, 2, 0, 0xFF]), "unit 5 answers to return diagnostic register: 00FFh");
        assert_eq!(said(&[8, 0, 1, 0xFF, 0]), "unit 5 confirms: restart communications");
    }
}
