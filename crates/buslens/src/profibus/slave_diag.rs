//! Slave_Diag: how a slave is.
//!
//! Layout of the response, 6 bytes: station status 1 to 3 (1 each), address of the master (1), ident
//! number (2); then extended diagnosis, if there is some.

use super::no_data::NoData;
use super::{Body, Diagnosis, Kind, ident, number_meaning};
use crate::field::{Bits, Direction, Message, Name, Role, Severity, Spec};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

pub static REQUEST: Kind = Kind {
    sap: Some(60),
    direction: Direction::Request,
    spec: Spec::new("slave_diag_request", "Diagnosis")
        .short("Slave_Diag")
        .note("Asks the slave how it is. It answers before it is set up, too.")
        .source(SOURCE),
    new: |_| Box::new(NoData { meaning: |who| message!("ask {who} for its diagnosis", who = who) }),
};

pub static RESPONSE: Kind = Kind {
    sap: Some(60),
    direction: Direction::Response,
    spec: Spec::new("slave_diag_response", "Diagnosis")
        .short("Slave_Diag")
        .note("Whether the slave is ready, and what is wrong if it is not.")
        .source(SOURCE),
    new: |settings| {
        let ident = settings.ident.unwrap_or_default();
        let expected = settings.ident;
        let (status, master, extended) = ([0, HEALTHY, 0], NO_MASTER, Vec::new());
        Box::new(SlaveDiag { status, master, ident, expected, extended })
    },
};

/// No master has set up the slave.
pub const NO_MASTER: u8 = 0xFF;

/// Station status 2 with nothing to say: bit 2 is always set.
const HEALTHY: u8 = 4;

pub struct SlaveDiag {
    pub status: [u8; 3],
    /// The address of the master that set up the slave, or [`NO_MASTER`].
    pub master: u8,
    pub ident: u16,
    /// The ident number that the slave has, where it is known.
    pub expected: Option<u16>,
    /// Blocks of diagnosis, each with its header byte.
    pub extended: Vec<u8>,
}

impl Telegram for SlaveDiag {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        for (spec, status) in STATUS.iter().zip(&mut self.status) {
            w.u8(spec, status)?;
        }
        w.u8(&MASTER, &mut self.master)?;
        ident::walk(w, &mut self.ident, self.expected)?;
        w.bytes(&EXTENDED, &mut self.extended, None)?;
        if self.ident == ident::KEB_F5 && !self.extended.is_empty() {
            let message = message!("a KEB F5 gives 6 bytes of diagnosis, and no more of its own");
            w.remark(&EXTENDED, Severity::Warning, "no-such-diagnosis", message);
        }
        Ok(())
    }
}

impl Body for SlaveDiag {
    fn diagnosis(&self) -> Option<Diagnosis> {
        let [first, second, _] = self.status;
        Some(Diagnosis { not_set_up: second & 1 != 0, configuration_fault: first & 4 != 0 })
    }

    fn meaning(&self, who: Message) -> Message {
        let [first, second, _] = self.status;
        let said = number_meaning(&STATUS[0], first);
        let more = number_meaning(&STATUS[1], second);
        let status = match (first, second) {
            (0, HEALTHY) => message!("ready"),
            (0, _) => message!("ready, {more}", more = more),
            (_, HEALTHY) => said,
            _ => message!("{said}, {more}", said = said, more = more),
        };
        let master = match self.master {
            NO_MASTER => message!("no master has set it up"),
            master => message!("set up by station {n}", n = master),
        };
        let said = message!("{who} says: {status}; {master}", who = who, status = status, master = master);
        match self.extended.len() {
            0 => said,
            more => {
                message!("{said}; {bytes} of extended diagnosis", said = said, bytes = Message::bytes(more))
            }
        }
    }
}

static STATUS: [Spec; 3] = [
    status("station_status_1", "Station status 1").bits(&[
        Bits::flag(0, "non_existent", "does not exist").note("Set by the master: nobody answers."),
        Bits::flag(1, "not_ready", "not ready").note("The slave cannot exchange data yet."),
        Bits::flag(2, "configuration_fault", "configuration fault")
            .note("The last configuration (Chk_Cfg) does not fit the slave."),
        Bits::flag(3, "extended_diagnosis", "extended diagnosis")
            .note("More follows behind the ident number."),
        Bits::flag(4, "not_supported", "function not supported"),
        Bits::flag(5, "invalid_response", "invalid response")
            .note("Set by the master: the answer made no sense."),
        Bits::flag(6, "parameter_fault", "parameter fault")
            .note("The last Set_Prm was not right, such as a wrong ident number."),
        Bits::flag(7, "locked", "locked by another master").note("Set by the master."),
    ]),
    status("station_status_2", "Station status 2").bits(&[
        Bits::flag(0, "parameters_wanted", "must be set up")
            .note("The slave wants Set_Prm and Chk_Cfg again."),
        Bits::flag(1, "static_diagnosis", "static diagnosis")
            .note("The slave cannot give valid data; the master keeps asking for diagnosis."),
        Bits::flag(2, "always_set", "bit 2").names(&[
            Name { value: 0, label: "bit 2 not set", note: "A slave always sets it." },
            Name { value: 1, label: "", note: "" },
        ]),
        Bits::flag(3, "watchdog", "watchdog on"),
        Bits::flag(4, "freeze", "inputs frozen"),
        Bits::flag(5, "sync", "outputs held (sync)"),
        Bits::flag(6, "not_present", "not present").note("Set by the master; reserved in older texts."),
        Bits::flag(7, "deactivated", "deactivated").note("Set by the master: it does not ask this slave."),
    ]),
    status("station_status_3", "Station status 3").bits(&[
        Bits::reserved(0, 7),
        Bits::flag(7, "overflow", "extended diagnosis overflow")
            .note("There is more than the telegram can hold."),
    ]),
];

const fn status(key: &'static str, label: &'static str) -> Spec {
    Spec::new(key, label)
        .role(Role::Status)
        .note("How the slave is, bit by bit. Some bits are set by the master that shows the diagnosis.")
        .source(SOURCE)
}

static MASTER: Spec = Spec::new("master", "Master")
    .role(Role::Unit)
    .note("The address of the master that set up the slave.")
    .source(SOURCE)
    .names(&[Name { value: NO_MASTER as u64, label: "no master", note: "Nobody has set up the slave yet." }]);

static EXTENDED: Spec = Spec::new("extended_diagnosis", "Extended diagnosis")
    .short("Extended")
    .role(Role::Unknown)
    .note(
        "What more the device has to say, in blocks. The lower six bits of a block's first byte are its \
         length with this byte; the upper two say whether it is about the device (0), a module (1), a channel \
         (2, always 3 bytes) or the revision (3, always 1 byte). A KEB F5 has none.",
    );

const SOURCE: &str = "KEB COMBIVERT F5 PROFIBUS-DP operator, 7.3; EN 50170, volume 2";
