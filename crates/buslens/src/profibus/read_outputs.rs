//! RD_Outp: read the outputs of a slave while another master exchanges data with it.

use super::Kind;
use super::no_data::NoData;
use super::user_data::{Side, UserData};
use crate::field::{Direction, Spec};
use crate::message;

pub static REQUEST: Kind = Kind {
    sap: Some(57),
    direction: Direction::Request,
    spec: Spec::new("read_outputs_request", "Read outputs")
        .short("RD_Outp")
        .note("Asks for the present outputs.")
        .source(SOURCE),
    new: |_| Box::new(NoData { meaning: |who| message!("ask {who} for its outputs", who = who) }),
};

pub static RESPONSE: Kind = Kind {
    sap: Some(57),
    direction: Direction::Response,
    spec: Spec::new("read_outputs_response", "Read outputs")
        .short("RD_Outp")
        .note("The outputs as in data exchange, with the parameter channel.")
        .source(SOURCE),
    new: |settings| Box::new(UserData::read(Side::Outputs, settings)),
};

const SOURCE: &str = "EN 50170, volume 2; KEB COMBIVERT F5 PROFIBUS-DP operator, 6.1";
