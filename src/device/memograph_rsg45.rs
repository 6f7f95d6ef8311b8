//! Endress+Hauser Memograph M RSG45.

use super::Profile;

pub static PROFILE: Profile = Profile {
    key: "memograph-rsg45",
    label: "Endress+Hauser Memograph M RSG45",
    source: "Memograph M RSG45 Modbus supplement",
    areas: &[],
    parameters: &[],
    most_registers: None,
    display: &[],
    lessons: &[],
};
