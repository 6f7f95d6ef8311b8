//! KEB COMBIVERT F5 on Modbus.

use super::Profile;

pub static PROFILE: Profile = Profile {
    key: "keb-f5-modbus",
    label: "KEB COMBIVERT F5 on Modbus",
    source: "KEB COMBIVERT F5 Modbus operator",
    areas: &[],
    parameters: &[],
    most_registers: None,
    display: &[],
    lessons: &[],
};
