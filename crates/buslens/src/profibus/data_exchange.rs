//! Data_Exchange: the cyclic exchange of user data. The one service without an access point.

use super::Kind;
use super::user_data::{Side, UserData};
use crate::field::{Direction, Spec};

pub static REQUEST: Kind = Kind {
    sap: None,
    direction: Direction::Request,
    spec: Spec::new("data_exchange_request", "Data exchange")
        .short("Data_Exchange")
        .note("The master sends its outputs, and with them a job of the parameter channel.")
        .source(SOURCE),
    new: |settings| Box::new(UserData::exchanged(Side::Outputs, settings)),
};

pub static RESPONSE: Kind = Kind {
    sap: None,
    direction: Direction::Response,
    spec: Spec::new("data_exchange_response", "Data exchange")
        .short("Data_Exchange")
        .note("The slave answers with its inputs, and with the confirmation of the last job.")
        .source(SOURCE),
    new: |settings| Box::new(UserData::exchanged(Side::Inputs, settings)),
};

const SOURCE: &str = "KEB COMBIVERT F5 PROFIBUS-DP operator, 7.4 and 11";
