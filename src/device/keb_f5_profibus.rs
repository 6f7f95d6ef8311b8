//! KEB COMBIVERT F5 on PROFIBUS-DP.

use super::Profile;

pub static PROFILE: Profile = Profile {
    key: "keb-f5-profibus",
    label: "KEB COMBIVERT F5 on PROFIBUS-DP",
    source: "KEB COMBIVERT F5 PROFIBUS-DP operator",
    areas: &[],
    parameters: &[],
    most_registers: None,
    display: &[],
    lessons: &[],
};
