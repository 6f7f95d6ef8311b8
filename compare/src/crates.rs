//! Crates that read Modbus. They are told that requests and responses take turns, and keep nothing.

use std::hint::black_box;

use modbus_core::{DecoderType, rtu};
use rmodbus::client::ModbusRequest;
use rmodbus::server::ModbusFrame;
use rmodbus::{ErrorKind, ModbusProto, guess_request_frame_len, guess_response_frame_len};

use crate::data::{Data, Spans};
use crate::{Measured, compare, speed};

pub fn rmodbus(data: &Data) -> Measured {
    Measured {
        name: "rmodbus 0.13".to_owned(),
        split: Some(speed(|| split_with_rmodbus(black_box(&data.stream)).len())),
        noise: Some(compare(&split_with_rmodbus(&data.noise.0), &data.noise.1)),
        ..Measured::default()
    }
}

/// What is no telegram of the side whose turn it is, is looked at as one of the other side, and then left out byte by
/// byte.
fn split_with_rmodbus(stream: &[u8]) -> Spans {
    let mut answer: Vec<u8> = Vec::new();
    let mut length_of = |bytes: &[u8], asks: bool| {
        let guess = if asks { guess_request_frame_len } else { guess_response_frame_len };
        let length = usize::from(guess(bytes, ModbusProto::Rtu).ok()?);
        let telegram = bytes.get(..length).filter(|telegram| telegram.len() > 3)?;
        let right = if asks {
            let mut frame = ModbusFrame::new(telegram[0], telegram, ModbusProto::Rtu, &mut answer);
            frame.parse().is_ok()
        } else {
            let client = ModbusRequest::new(telegram[0], ModbusProto::Rtu);
            !matches!(client.parse_ok(telegram), Err(ErrorKind::FrameCRCError | ErrorKind::FrameBroken))
        };
        right.then_some(length)
    };
    let (mut spans, mut at, mut asks) = (Vec::new(), 0, true);
    while at < stream.len() {
        let bytes = &stream[at..];
        match [asks, !asks].into_iter().find_map(|asks| Some((asks, length_of(bytes, asks)?))) {
            Some((asked, length)) => {
                spans.push((at, length));
                (at, asks) = (at + length, !asked);
            }
            None => at += 1,
        }
    }
    spans
}

pub fn modbus_core(data: &Data) -> Measured {
    Measured {
        name: "modbus-core 0.2".to_owned(),
        split: Some(speed(|| split_with_modbus_core(black_box(&data.stream)).len())),
        noise: Some(compare(&split_with_modbus_core(&data.noise.0), &data.noise.1)),
        ..Measured::default()
    }
}

/// The same. It looks for the next telegram itself, wherever that is.
fn split_with_modbus_core(stream: &[u8]) -> Spans {
    use DecoderType::{Request, Response};
    let (mut spans, mut at, mut asks) = (Vec::new(), 0, true);
    while at < stream.len() {
        let found = [asks, !asks].into_iter().find_map(|asks| {
            let side = if asks { Request } else { Response };
            rtu::decode(side, &stream[at..]).ok().flatten().map(|(_, place)| (asks, place))
        });
        match found {
            Some((asked, place)) => {
                spans.push((at + place.start, place.size));
                (at, asks) = (at + place.start + place.size, !asked);
            }
            None => at += 1,
        }
    }
    spans
}
