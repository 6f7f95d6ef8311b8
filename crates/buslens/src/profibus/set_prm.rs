//! Set_Prm: a master sets up a slave, before anything else.
//!
//! Layout, 7 bytes: station status (1), watchdog factors (1 + 1), least response time (1), ident
//! number (2), groups (1); then parameters of the device, if it has some.

use super::{Body, Kind, ident};
use crate::field::{Argument, Bits, Direction, Message, Name, Role, Severity, Spec, hex_value};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

pub static REQUEST: Kind = Kind {
    sap: Some(61),
    direction: Direction::Request,
    spec: Spec::new("set_prm_request", "Set parameters")
        .short("Set_Prm")
        .note("Sets the slave up for this master. The slave acknowledges without data.")
        .source(SOURCE),
    new: |settings| {
        let ident = settings.ident.unwrap_or_default();
        let expected = settings.ident;
        let (status, factors, response_time, groups, parameters) = (0x88, [1, 10], 11, 0, Vec::new());
        Box::new(SetPrm { status, factors, response_time, ident, expected, groups, parameters })
    },
};

/// How a slave is to behave.
pub struct SetPrm {
    pub status: u8,
    pub factors: [u8; 2],
    pub response_time: u8,
    pub ident: u16,
    /// The ident number that the slave has, where it is known.
    pub expected: Option<u16>,
    pub groups: u8,
    /// What the device's maker defines.
    pub parameters: Vec<u8>,
}

impl SetPrm {
    /// The watchdog's time in ms; `None` if it is off.
    pub fn watchdog(&self) -> Option<u32> {
        let [first, second] = self.factors.map(u32::from);
        (WATCHDOG.of(self.status.into()) == 1).then_some(first * second * 10)
    }
}

impl Telegram for SetPrm {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        w.u8(&STATUS, &mut self.status)?;
        let [first, second] = &mut self.factors;
        if WATCHDOG.of(self.status.into()) == 1 {
            w.u8(&FACTOR_1, first)?;
            w.u8(&FACTOR_2, second)?;
        } else {
            w.u8(&IDLE_FACTOR_1, first)?;
            w.u8(&IDLE_FACTOR_2, second)?;
        }
        w.u8(&RESPONSE_TIME, &mut self.response_time)?;
        ident::walk(w, &mut self.ident, self.expected)?;
        w.u8(&GROUPS, &mut self.groups)?;
        w.bytes(&PARAMETERS, &mut self.parameters, None)?;
        if self.ident == ident::KEB_F5 && !self.parameters.is_empty() {
            let message = message!("a KEB F5 takes 7 bytes, without parameters of its own");
            w.remark(&PARAMETERS, Severity::Warning, "no-such-parameters", message);
        }
        Ok(())
    }
}

impl Body for SetPrm {
    fn sets_up(&self) -> bool {
        true
    }

    fn meaning(&self, who: Message) -> Message {
        let lock = LOCK.name(LOCK.of(self.status.into())).map_or("", |name| name.label);
        let watchdog = match self.watchdog() {
            Some(time) => message!("watchdog {time} ms", time = time),
            None => message!("no watchdog"),
        };
        message!(
            "parameterise {who} (ident {ident}): {lock}, {watchdog}",
            who = who,
            ident = hex_value(self.ident.into(), 2),
            lock = Argument::Term(lock),
            watchdog = watchdog
        )
    }
}

static STATUS: Spec = Spec::new("station_status", "Station status")
    .short("Status")
    .role(Role::Function)
    .note("Whom the slave belongs to from now on, and what it is to be ready for.")
    .source(SOURCE)
    .bits(&[
        Bits::reserved(0, 3),
        WATCHDOG,
        Bits::flag(4, "freeze", "freeze").note("The slave must be able to freeze its inputs."),
        Bits::flag(5, "sync", "sync").note("The slave must be able to hold its outputs."),
        LOCK,
    ]);

const WATCHDOG: Bits = Bits::flag(3, "watchdog", "watchdog on")
    .note("Without a telegram for the watchdog's time, a KEB F5 sets its process outputs to 0.");

/// Unlock (bit 6) and lock (bit 7).
const LOCK: Bits = Bits::part(6, 2, "lock", "lock")
    .names(&[
        Name {
            value: 0,
            label: "not locked, settings may change",
            note: "Response time and the other settings may be overwritten.",
        },
        Name { value: 1, label: "released for other masters", note: "" },
        Name { value: 2, label: "locked for other masters", note: "The usual case." },
        Name {
            value: 3,
            label: "released for other masters",
            note: "Unlock (bit 6) wins over lock (bit 7).",
        },
    ])
    .note("Bit 6 asks to unlock, bit 7 to lock the slave for other masters; unlock wins.");

static FACTOR_1: Spec = FIRST.limits(1, 255);
static FACTOR_2: Spec = SECOND.limits(1, 255);
static IDLE_FACTOR_1: Spec = FIRST;
static IDLE_FACTOR_2: Spec = SECOND;

const FIRST: Spec =
    Spec::new("watchdog_factor_1", "Watchdog factor 1").short("Factor 1").note(FACTORS).source(SOURCE);
const SECOND: Spec =
    Spec::new("watchdog_factor_2", "Watchdog factor 2").short("Factor 2").note(FACTORS).source(SOURCE);

const FACTORS: &str = "The watchdog's time is both factors and 10 ms multiplied, so their order does not \
                       matter (the manual of the F5 counts them the other way round).";

static RESPONSE_TIME: Spec = Spec::new("min_tsdr", "Least response time")
    .short("Min Tsdr")
    .unit("bit times")
    .note(
        "How long the slave waits at least before it answers (min Tsdr). The most it may take depends on \
         the speed: 60 bit times up to 187.5 kbit/s, 100 at 500, 150 at 1500, 250 at 3000, 450 at 6000, \
         800 at 12000 kbit/s.",
    )
    .source("KEB COMBIVERT F5 PROFIBUS-DP operator, 7.1 and 8.2")
    .names(&[Name { value: 0, label: "as before", note: "" }]);

static GROUPS: Spec = Spec::new("groups", "Groups")
    .note("Which groups the slave belongs to, for control commands to a group.")
    .source(SOURCE)
    .names(&[Name { value: 0, label: "in no group", note: "" }])
    .bits(super::global_control::GROUPS);

static PARAMETERS: Spec = Spec::new("user_parameters", "Parameters of the device")
    .short("Parameters")
    .role(Role::Unknown)
    .note("What these bytes mean, the device's maker says. A KEB F5 has none.");

const SOURCE: &str = "KEB COMBIVERT F5 PROFIBUS-DP operator, 7.1; EN 50170, volume 2";
