//! Telegrams of another implementation (the crate rmodbus) are read as what they were made of, and
//! our responses are understood by it.

use buslens::field::Direction;
use buslens::frame::modbus_rtu::RTU;
use buslens::frame::modbus_serial::Serial;
use buslens::modbus::{KINDS, STANDARD};
use buslens::tool::{Detail, Options, Verdict, decode};
use proptest::prelude::*;
use rmodbus::ModbusProto;
use rmodbus::client::ModbusRequest;

/// What Buslens reads in `bytes`, which must be without a problem.
fn read(bytes: &[u8], direction: Direction) -> Detail {
    let text = buslens::field::hex(bytes);
    let report = decode(&text, Options { direction: Some(direction), ..Options::default() });
    let detail = report.detail(0).expect("one telegram");
    assert_eq!(report.telegrams[0].verdict, Verdict::Right, "{text}");
    assert_eq!(detail.problems(), [] as [&buslens::field::Problem; 0], "{text}");
    detail
}

fn words(values: &[u16]) -> Vec<u32> {
    values.iter().copied().map(u32::from).collect()
}

fn switches(values: &[bool]) -> Vec<u32> {
    values.iter().copied().map(u32::from).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn requests(unit in 1..=247u8, start in 0..=0xFF00u16, quantity in 1..=125u16, values in proptest::collection::vec(any::<u16>(), 1..=123)) {
        let mut client = ModbusRequest::new(unit, ModbusProto::Rtu);
        let mut bytes = Vec::new();
        for function in [3, 4] {
            bytes.clear();
            match function {
                3 => client.generate_get_holdings(start, quantity, &mut bytes),
                _ => client.generate_get_inputs(start, quantity, &mut bytes),
            }.expect("a request");
            let detail = read(&bytes, Direction::Request);
            prop_assert_eq!((detail.unit, detail.function), (Some(unit), Some(function)));
            prop_assert_eq!((detail.start, detail.count), (Some(start), Some(quantity.into())));
        }

        bytes.clear();
        client.generate_set_holding(start, values[0], &mut bytes).expect("a request");
        let detail = read(&bytes, Direction::Request);
        prop_assert_eq!((detail.function, detail.start), (Some(6), Some(start)));
        prop_assert_eq!(detail.values, words(&values[..1]));

        bytes.clear();
        client.generate_set_holdings_bulk(start, &values, &mut bytes).expect("a request");
        let detail = read(&bytes, Direction::Request);
        prop_assert_eq!((detail.function, detail.start), (Some(16), Some(start)));
        prop_assert_eq!(detail.values, words(&values));
    }

    #[test]
    fn requests_for_coils(unit in 1..=247u8, start in 0..=0xF000u16, quantity in 1..=2000u16, values in proptest::collection::vec(any::<bool>(), 1..=1968)) {
        let mut client = ModbusRequest::new(unit, ModbusProto::Rtu);
        let mut bytes = Vec::new();
        for function in [1, 2] {
            bytes.clear();
            match function {
                1 => client.generate_get_coils(start, quantity, &mut bytes),
                _ => client.generate_get_discretes(start, quantity, &mut bytes),
            }.expect("a request");
            let detail = read(&bytes, Direction::Request);
            prop_assert_eq!((detail.unit, detail.function), (Some(unit), Some(function)));
            prop_assert_eq!((detail.start, detail.count), (Some(start), Some(quantity.into())));
        }

        bytes.clear();
        client.generate_set_coil(start, values[0], &mut bytes).expect("a request");
        let detail = read(&bytes, Direction::Request);
        prop_assert_eq!((detail.function, detail.start), (Some(5), Some(start)));
        prop_assert_eq!(detail.values, switches(&values[..1]));

        bytes.clear();
        client.generate_set_coils_bulk(start, &values, &mut bytes).expect("a request");
        let detail = read(&bytes, Direction::Request);
        prop_assert_eq!((detail.function, detail.start), (Some(15), Some(start)));
        prop_assert_eq!(detail.values, switches(&values));
    }

    /// A response of ours, random but for its length, is parsed to the values that we say it has.
    #[test]
    fn responses(unit in 1..=247u8, values in proptest::collection::vec(any::<u16>(), 1..=125)) {
        let mut client = ModbusRequest::new(unit, ModbusProto::Rtu);
        client.generate_get_holdings(0, values.len() as u16, &mut Vec::new()).expect("a request");
        let kind = KINDS.iter().find(|kind| kind.spec.key == "read_holding_registers_response").expect("listed");
        let mut rtu = Serial { mode: &RTU, unit, pdu: kind.pdu(&STANDARD) };
        let mut rest = values.iter();
        buslens::walk::sample(&mut rtu, &mut |most| match most {
            // The unit, then the number of registers, then each of them.
            255 => unit.into(),
            124 => values.len() as u64 - 1,
            _ => rest.next().copied().map_or(0, u64::from),
        });
        let bytes = buslens::walk::write(&mut rtu, &buslens::walk::Deviations::default());
        prop_assert_eq!(read(&bytes, Direction::Response).values, words(&values));
        let mut parsed = Vec::new();
        client.parse_u16(&bytes, &mut parsed).expect("a response that rmodbus understands");
        prop_assert_eq!(parsed, values);
    }
}
