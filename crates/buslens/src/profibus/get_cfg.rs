//! Get_Cfg: ask a slave for its configuration.

use super::Kind;
use super::configuration::Configuration;
use super::no_data::NoData;
use crate::field::{Direction, Spec};
use crate::message;

pub static REQUEST: Kind = Kind {
    sap: Some(59),
    direction: Direction::Request,
    spec: Spec::new("get_cfg_request", "Get configuration")
        .short("Get_Cfg")
        .note("Asks the slave which modules it has.")
        .source(SOURCE),
    new: |_| Box::new(NoData { meaning: |who| message!("ask {who} for its configuration", who = who) }),
};

pub static RESPONSE: Kind = Kind {
    sap: Some(59),
    direction: Direction::Response,
    spec: Spec::new("get_cfg_response", "Get configuration")
        .short("Get_Cfg")
        .note("The modules that the slave has.")
        .source(SOURCE),
    new: |settings| {
        let meaning =
            |who, layout| message!("{who} has the configuration: {layout}", who = who, layout = layout);
        Box::new(Configuration::new(settings, meaning))
    },
};

const SOURCE: &str = "KEB COMBIVERT F5 PROFIBUS-DP operator, 7.2; EN 50170, volume 2";
