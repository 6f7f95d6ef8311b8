//! Chk_Cfg: a master says which configuration it expects of the slave.

use super::Kind;
use super::configuration::Configuration;
use crate::field::{Direction, Spec};
use crate::message;

pub static REQUEST: Kind = Kind {
    sap: Some(62),
    direction: Direction::Request,
    spec: Spec::new("chk_cfg_request", "Check configuration")
        .short("Chk_Cfg")
        .note(
            "The modules that the master expects. If they fit, the slave acknowledges without data and data \
             exchange can begin.",
        )
        .source("KEB COMBIVERT F5 PROFIBUS-DP operator, 7.2; EN 50170, volume 2"),
    new: |settings| {
        let meaning =
            |who, layout| message!("tell {who} its configuration: {layout}", who = who, layout = layout);
        Box::new(Configuration::new(settings, meaning))
    },
};
