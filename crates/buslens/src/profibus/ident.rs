//! The ident number, by which the PROFIBUS user organisation tells types of devices apart.

use crate::field::{Format, Name, Severity, Spec, hex_value};
use crate::message;
use crate::walk::{Walk, Walker};

/// The ident number of the KEB F5 PROFIBUS-DP operator.
pub const KEB_F5: u16 = 0x05EB;

/// Walks an ident number and says so where it is not the expected one.
pub fn walk(w: &mut dyn Walker, ident: &mut u16, expected: Option<u16>) -> Walk {
    w.u16(&IDENT, ident)?;
    if let Some(expected) = expected
        && *ident != expected
    {
        w.remark(
            &IDENT,
            Severity::Error,
            "wrong-ident",
            message!(
                "the ident number is {found}; this slave has {expected}",
                found = hex_value((*ident).into(), 2),
                expected = hex_value(expected.into(), 2)
            ),
        );
    }
    Ok(())
}

static IDENT: Spec = Spec::new("ident", "Ident number")
    .short("Ident")
    .format(Format::Hex)
    .note("Which type of device this is, high byte first. A slave rejects parameters with another one.")
    .source("KEB COMBIVERT F5 PROFIBUS-DP operator, 7.1 and 7.3")
    .names(&[Name { value: KEB_F5 as u64, label: "KEB F5 PROFIBUS-DP operator", note: "" }]);
