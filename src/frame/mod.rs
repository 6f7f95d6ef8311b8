//! Frames: what carries a PDU over a line, with address and check.

pub mod modbus_rtu;
pub mod profibus_fdl;
