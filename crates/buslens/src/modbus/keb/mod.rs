//! Function codes of KEB's own, for 32-bit values in one register address each.
//!
//! Source: KEB COMBIVERT F5 Modbus operator manual, section 2.4; the figures' fields are those of
//! the English edition (CM.F5.010-K000, pages 7 and 8). The order of the fields is that of functions
//! 3 and 16; [`dialects`] has the other readings of the figures.

pub mod dialects;
pub mod read_long_registers;
pub mod write_long_registers;

use super::{Layout, Table};
use crate::field::{Format, Role, Spec};

pub(super) static LONG_REGISTERS: Table = LONG;

/// The F5 operator's registers, read as 32-bit values. The manual gives no largest number; the
/// limits are what a frame of 256 bytes can hold.
const LONG: Table = Table {
    one: "long register",
    many: "long registers",
    width: 4,
    layout: Layout::STANDARD,
    start: Spec::new("start", "Starting address")
        .short("Start")
        .role(Role::Address)
        .format(Format::HexAddress)
        .note("The first register. Each address holds a whole 32-bit value.")
        .source(SOURCE),
    read_quantity: QUANTITY.limits(1, 62).note("How many 32-bit values are to be read. 62 fit into a frame."),
    write_quantity: QUANTITY.limits(1, 61).note("How many 32-bit values are written. 61 fit into a frame."),
    byte_count: Spec::new("byte_count", "Byte count")
        .short("Bytes")
        .role(Role::Count)
        .limits(4, 248)
        .note("How many bytes of values follow: four for each.")
        .source(SOURCE),
    values: Spec::new("values", "Values"),
    value: LONG_VALUE.note("A 32-bit value, most significant byte first."),
};

const QUANTITY: Spec = Spec::new("quantity", "Quantity").role(Role::Count).source(SOURCE);

const LONG_VALUE: Spec = Spec::new("value", "Register").format(Format::Register).hex_numbers().source(SOURCE);

const SOURCE: &str = "KEB COMBIVERT F5 Modbus operator, 2.4";
