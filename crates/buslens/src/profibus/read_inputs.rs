//! RD_Inp: read the inputs of a slave while another master exchanges data with it.

use super::Kind;
use super::no_data::NoData;
use super::user_data::{Side, UserData};
use crate::field::{Direction, Spec};
use crate::message;

pub static REQUEST: Kind = Kind {
    sap: Some(56),
    direction: Direction::Request,
    spec: Spec::new("read_inputs_request", "Read inputs")
        .short("RD_Inp")
        .note("Asks for the present inputs.")
        .source(SOURCE),
    new: |_| Box::new(NoData { meaning: |who| message!("ask {who} for its inputs", who = who) }),
};

pub static RESPONSE: Kind = Kind {
    sap: Some(56),
    direction: Direction::Response,
    spec: Spec::new("read_inputs_response", "Read inputs")
        .short("RD_Inp")
        .note("The inputs as in data exchange, with the parameter channel.")
        .source(SOURCE),
    new: |settings| Box::new(UserData::read(Side::Inputs, settings)),
};

const SOURCE: &str = "EN 50170, volume 2; KEB COMBIVERT F5 PROFIBUS-DP operator, 6.1";
