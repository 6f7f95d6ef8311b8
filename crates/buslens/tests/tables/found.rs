//! Which telegrams are found in small texts and in what people paste.

use std::fmt::Write as _;
use std::path::Path;

use buslens::field::hex;
use buslens::tool::Options;
use buslens::tool::log::{Log, Reading, Role};
use buslens::walk::CRC_16_MODBUS;

use super::texts::{BLOCKS, SPELLINGS, SURROUNDINGS};
use super::{assert_table, bytes};

/// What a text as a whole says: conversations, copies, what is near.
const CONVERSATIONS: &[&str] = &[
    "TX: 01 03 00 C8 00 03\nRX: 01 03 06 00 80 42 A4 F1 DE",
    "TX: 01 03 00 C8 00 03 84 36\nRX: 01 03 06 00 80 42 A4 F1 DE B0 F9",
    "TX: 01 03 00 C8 00 03 84 35\nRX: 01 03 06 00 80 42 A4 F1 DE B0 F9",
    "TX: 01 03 00 C8 00 03 84 35\nRX: 01 03 06 00 80 42",
    "TX: 01 03 00 C8 00 03 84 35\nRX: 01 83 02 C0 F2",
    "TX: 01 03 00 C8 00 03 84 35\nRX: 01 83 02",
    "TX: 01 03 00 C8 00 03 84 35\nRX: 01 83",
    "TX: 01 03 00 C8 00 03 84 35\nRX: 02 83 02",
    "TX: 01 03 00 C8 00 03 84 35\nx\ny\nz\nRX: 02 03 06 00 80 42 A4 F1 DE B0 F9",
    "TX: 01 03 00 C8 00 03 84 35\nRX: 01\nRX: 03 06 00 80 42 A4 F1 DE B0 F8",
    "TX: 01 03 00 C8 00 03 84 35\nRX: 01 03 06 00\nRX: 80 42 A4 F1\nRX: DE B0 F8",
    "TX: 01 03 00 C8 00 03 84 35\nRX: 01 03 06 00 80 42 A4 F1 DE B0 F8 01 03\nRX: 00 C8 00 03 84 35",
    "10:00:00 RX: 01 03 06 00\n10:00:09 RX: 80 42 A4 F1 DE B0 F8",
    "10:00:00.000 RX: 01 03 06 00\n10:00:00.100 RX: 80 42 A4 F1 DE B0 F8",
    "RX: 01 03 06 00\nRX: 01 03 06 00 80 42\nRX: 01 03 06 00 80 42 A4 F1 DE B0 F8",
    "RX: 01 03 06 00\nRX: 01 03 06 00\nRX: 80 42 A4 F1 DE B0 F8",
    "RX: 01 03 06 00\nother 99\nRX: 80 42 A4 F1 DE B0 F8",
    "tx: 55 01 03 00 C8\ntx: 00 03 84 35",
    "TX: 01 05 00 C8 FF 00\nRX: 01 05 00 C8 FF 00",
    "TX: 01 05 00 C8 FF 00\nRX: 01 05 00 C8 00 00",
    "TX: 01 06 00 C8 00 05 00 00\nRX: 01 06 00 C8 00 05 00 01",
    "TX: 01 10 00 C8 00 02 04 00 01 00 02\nRX: 01 10 00 C8 00 02",
    "TX: 11 42 01 02 03 5D 21\nRX: 11 42 01 02 03 04",
    "TX: 03 04 00 01\nRX: 03 04 00 01 00 02",
    "tx 03 00 01 00 02\nrx 03 04 00 01 00 02",
    "tx 03 00 01 00 02\nrx 03 04 00 01 00",
    "03 00 01 00 02\n03 04 00 01 00 02",
    "sent 01 03 00 C8 00 03 84 35\ncopy of 01 03 00 C8 00 03",
    "sent 01 03 00 C8 00 03 84 35\nthe data were 03 00 C8 00",
    "sent 01 03 00 C8 00 03 84 35\nthe frame 01 03 00 C8 00 03 00 00 again",
    "sent 01 03 00 C8 00 03 84 35\nTX: 01 03 00 C8 00 03 84 01 03 00 C8 00 03 84",
    "sent 01 03 00 C8 00 03 84 35 sent 01 03 00 C8 00 03 84 35",
    "01 03 00 C8 00 03 84 35 01 03 06 00 80 42 A4 F1 DE B0 F8",
    "01 03 00 C8 00 03 84 35 01 03 06 00 80 42 A4 F1 DE B0",
    "01 03 00 C8 00 03 84 35 11 22",
    "TX: FF FF 01 03 00 C8 00 03 84 35 00 00",
    "TX: 00 01 42 00 C8 00 03 D1 F5",
    "TX: 01 42 00 C8 00 03 D1 F5",
    "TX: 01 42 00 C8 00 03 D1 F5 00",
    "rx 00 01 00 00 00 06 01 03 00 C8 00 03",
    "rx 00 01 00 00 00 06 01 63 00 C8 00 03",
    "rx 00 01 00 00 00 02 01 07",
    "rx 55 00 01 00 00 00 06 01 03 00 C8 00 03",
    "rx 00 01 00 00 00 06 01 03 00 C8 00 03 00 02 00 00 00 06 01 03 00 C8 00 03",
    "tx 00 01 00 00 00 06 01 03 00 C8 00 03\nrx 00 01 00 00 00 09 01 03 06 00 80 42 A4 F1 DE\nrx 00 02 00 00 00 07 01 03 00 C8 00 03",
    "tx 00 01 00 00 00 06 01 03 00 C8 00 03\ntx 01 03 00 C8 00 03 84 36",
    "tx 01 03 00 C8 00 03 84 35\nrx 00 01 00 00 00 07 01 03 00 C8 00 03",
    "68 05 05 68 81 82 5D 3B 3E D9 16\nE5",
    "68 05 05 68 81 82 5D 3B 3E D9 16 E5 10 01 02 49 4C 16",
    "10 01 02 49 4C 16\nE5\n10 5B 0A 65 16",
    "10 5B 0A 65 16\n10 01 02 49 4C 16\n10 5B 0A 65 16",
    "tx 01 03 00 C8 00 03 84 35\nE5",
    "tx 10 01 02 49 4C 16\nrx E5",
    "68 0F 0F 68 01 02 5D 41 00 20 34 00 00 00 00 00 00 00 00 F5 16\n68 0F 0F 68 02 01 08 71 00 20 34 00 00 05 DC 00 00 00 00 B4 16",
    "S1: 41 00 23 00 00 00 00 00\nE1: 71 00 23 00 00 00 00 05",
    "41 00 23 00 00 00 00 00\n71 00 23 00 00 00 00 05",
    "52 00 23 00 00 05 00 00\n52 00 23 00 00 05 00 00",
    "41 00 23 00 00 00 00 00\n41 00 23 00 00 00 00 00",
    "41 54 2B 43 47 4D 49 0D",
    "3A 30 31 30 33 30 30 43 38 30 30 30 33 33 31 0D 0A",
    "3A 30 31 30 33 30 30 43 38 30 30 30 33 33 32 0D 0A",
    "3A 31 31 30 33 0D 0A",
    "30 31 30 33 30 30 43 38 30 30 30 33 38 34 33 35",
    ":010300C8000331\n:01030600804\n:0103060080",
    ":010300C8000332",
    ":0163",
    "AA 55 01 00 00 0B 11 04 00 01 20",
    "7E A0 07 03 21 93 0F 01 7E",
    "55 FF 00 07 03 00 00 EB 01 02",
    "1, 3, 0, 200, 0, 3, 132, 53\n1, 3, 6, 0, 128, 66, 164, 241, 222, 176, 248",
    "1 3 0 20 0 3 4 5",
    "8: 01 03 00 C8 00 03 84 35 99",
    "42ec148 151 010300",
    "FA 01,03 00 C8 00 03,84 35",
    "99 01 03 00 C8 00 03 84 35,99",
    "a 01 00\nb 03 00\nc 00 00\nd C8 00\ne 00 00\nf 03 00\ng 84 00\nh 35 00",
    "a 01 01\nb 03 03\nc 00 02\nd C8 00\ne 00 07\nf 03 F9\ng 84 86\nh 35",
    "unit 01\nfunction 03\naddress 00 C8\ncount 00 03\nnote",
    "unit 01 01\nfunction 03 03\nstart 00 02\nlow C8 00\nhigh 00 05\nlow 03",
    "const a[] = {0x01, 0x03, 0x00, 0xC8, 0x00, 0x03, 0x84, 0x35, 0x00, 0x00, 0x00}",
    "discarded: 01 03 00 C8 00 03",
    "discarded 01 03 00 C8 00 03 84 36",
    "0000  01 03 00 C8 00 03 84 36",
    "0000  00 01 02 03 04 05 06 07 08 09 0A 0B 0C 0D 0E 0F\n0010  10 11 12 13 14 15 16 17 18 19 1A 1B 1C 1D 1E 1F",
    "TX: 01 03 00 C8 00 03 84 35\nTX: 01 03 00 C8 00 03 84 35\nRX: 01 03 06 00 80 42 A4 F1 DE B0 F8",
    "TX: 01 03 00 C8 00 03 84 35\nRX: 01 03 00 C8 00 03 84 35\nRX: 01 03 06 00 80 42 A4 F1 DE B0 F8",
    "RX: 01 03 00 C8 00 03 84 35\nTX: 01 03 06 00 80 42 A4 F1 DE B0 F8",
    "TX: 00 06 00 C8 00 03 48 24\nTX: 01 03 00 C8 00 03 84 35",
    "10:00:00 TX: 01 03 00 C8 00 03 84 35\n10:00:01 TX: 02 03 00 C8 00 03 84 06\n10:00:02 RX: 01 03 06 00 80 42 A4 F1 DE B0 F8",
    "10:00:00 COM1 TX: 01 03 00 C8 00 03 84 35\n10:00:01 COM2 TX: 01 03 00 C8 00 03 84 35\n10:00:02 COM1 RX: 01 03 06 00 80 42 A4 F1 DE B0 F8\n10:00:02 COM2 RX: 01 83 02 C0 F1",
    "23:59:59.9 TX: 01 03 00 C8 00 03 84 35\n00:00:00.1 RX: 01 03 06 00 80 42 A4 F1 DE B0 F8",
    "RX: 01 03 06 00 80 42 A4 F1 DE B0 F8\nRX: 01 03 06 00 80 42 A4 F1 DE B0 F8",
    "so 11 42 01 02 03 ~~",
    "so 55 06 04 22 07 00 01 8B C4 06 04 02 00 40 0D 00 66",
    "so 06 04 22 07 00 01 8B C4 06 04 02 00 40 0D 00",
    "tx: 06 04 22 07 00 01 8B C4\nrx: 06 04 02 00 40 0D 00 06 04 22 07 00 01 8B C4",
    "rx: 06 04 02 00 40 0D 00 06 04 22 07 00 01 8B C4",
    "tx: 06 04 22 07 00 01 8B C4\nrx: 06 04 02 00 40 0D\nrx: 00",
    "discarded FA 07 01 02 03 ~~",
    "discarded FA 07 ~~",
    "tx: 01 06 00 C8 00 03 ~~\nand that\n01 06 00 C8 00 03 12 34",
    "tx: 01 06 00 C8 00 03 ~~\nand that\n01 06 00 C8 00",
    "discarded FA 63 01 02 ~~",
    "rx: 68 09 09 68 02\nrx: 01 5D 01 02 03 04 05 06 75 16",
    "rx: 00 09 00 00 00\nrx: 09 01 03 06 00 80 42 A4 F1 DE",
    "rx: 00 09 00 00 00 09\nrx: 01 03 06 00 80 42 A4 F1 DE",
    "rx: 68 09 09\nrx: 68 02 01 5D 01 02 03 04 05 06 75 16",
    "rx: A2 01 02 5D 01\nrx: 02 03 04 05 06 07 08 84 16",
    "rx: 10 01 02 5D\nrx: 60 16",
    "tx: 01 03 00 C8 00 03 ~~\nrx: 55 01 03 06 00 80 42 A4 F1 DE",
    "tx: 01 03 00 C8 00 03 ~~\nrx: 55 55 55 01 03 06 00 80 42 A4",
    "so 11 42 ~~",
    "so 11 42 01 ~~ 00",
    "so 11 42 01 02 ~~ 00 00",
    "so 11 80 01 02 ~~",
    "so 11 00 01 02 ~~",
    "so 01 03 00 C8 00 03 00 ~~",
    "so 01 03 00 C8 00 ~~",
    "so 01 03 06 00 80 42 A4 F1 DE ~~ 00",
    "so 01 03 06 00 80 42 A4 F1 DE 01 ~~",
    "so FF 01 03 00 C8 00 03 ~~",
    "so 00 00 01 42 00 C8 ~~",
    "so 00 01 42 00 C8 ~~",
    "so FF 01 42 00 C8 00 ~~",
    "so 00 00 00 01 42 00 C8 ~~",
    "so 55 01 03 00 C8 00 03 ~~ 66 01 03 06 00 80 42 A4 F1 DE ~~",
    "tx: 55 01 03 00 C8 00 03 ~~ 66 01 03 06 00 80 42 A4 F1 DE ~~",
    "tx: 01 03 00 C8 00 03 ~~ 01 03 06 00 80 42",
    "tx: 01 03 00 C8 00 03 ~~ 01 03 06 00 80 42 00 00 00",
    "tx: 01 03 00 C8 00 03 ~~ 01 03 06 00 80 42 01 03 00 C8 00 03 ~~",
    "tx: 01 03 00 C8 00 03 ~~ 02 03 06 00 80 42 01 03 00 C8 00 03 ~~",
    "tx: 01 03 00 C8 00 03 ~~\nrx: 55 01 03 06 00 80 42 A4 F1 DE ~~",
    "tx: 01 03 00 C8 00 03 ~~\nrx: 55 01 03 06 00 80 42 A4 F1",
    "tx: 01 03 00 C8 00 03 ~~\nrx: 01 03 06 00 80\nx 99 98 97 96 y\nrx: 42 A4 F1 DE B0 F8",
    "tx: 01 03 00 C8 00 03 ~~\nrx: 01 03 06 00 80\nq1 99 98 97 96 y\nq2 99 98 97 95 y\nq3 99 98 97 94 y\nq4 99 98 97 93 y\n\
     q5 99 98 97 92 y\nq6 99 98 97 91 y\nq7 99 98 97 90 y\nq8 99 98 97 89 y\nrx: 42 A4 F1 DE B0 F8",
    "tx: 01 03 00 C8 00 03 ~~\nrx: 01 03 06 00 80\nq1 99 98 97 96 y\nq2 99 98 97 95 y\nq3 99 98 97 94 y\nq4 99 98 97 93 y\n\
     q5 99 98 97 92 y\nq6 99 98 97 91 y\nq7 99 98 97 90 y\nq8 99 98 97 89 y\nq9 99 98 97 88 y\nrx: 42 A4 F1 DE B0 F8",
    "tx: 01 03 00 C8 00 03 ~~\nrx: 01 03 06 00 80\nq1 FE 98 97 96 y\nq2 FE 98 97 95 y\nq3 FE 98 97 94 y\nq4 FE 98 97 93 y\n\
     q5 FE 98 97 92 y\nq6 FE 98 97 91 y\nq7 FE 98 97 90 y\nq8 FE 98 97 89 y\nrx: 42 A4 F1 DE B0 F8",
    "tx: 01 03 00 C8 00 03 ~~\nrx: 01 03 06 00 80\nq1 FE 98 97 96 y\nq2 FE 98 97 95 y\nq3 FE 98 97 94 y\nq4 FE 98 97 93 y\n\
     q5 FE 98 97 92 y\nq6 FE 98 97 91 y\nq7 FE 98 97 90 y\nq8 FE 98 97 89 y\nq9 FE 98 97 88 y\nrx: 42 A4 F1 DE B0 F8",
    "10:00:00 rx: 01 03 06 00 80\n10:00:01 rx: 42 A4 F1 DE B0 F8",
    "10:00:00.0 rx: 01 03 06 00 80\n10:00:01.1 rx: 42 A4 F1 DE B0 F8",
    "10:00:01 rx: 01 03 06 00 80\n10:00:00 rx: 42 A4 F1 DE B0 F8",
    "rx: 01 03 06 00 80\ntx: 42 A4 F1 DE B0 F8",
    "rx: 01 03 06 00 80\nx: 42 A4 F1 DE B0 F8",
    "rx: 01 03 06 00 80\n42 A4 F1 DE B0 F8",
    "rx: 01 03 06 00 80 42 A4 F1 DE\nrx: B0 F8",
    "rx: 01 03 06 00 80 42 A4 F1 DE\nthe end is: B0 F8",
    "rx: 01 03 06 00 80 42 A4 F1 DE\nleftover: B0 F8",
    "rx: 01 03 06 00 80\nrx: 42 A4 F1 DE B0 F8 01 03 06\nrx: 00 80 42 A4 F1 DE B0 F8",
    "rx: 00 01 00 00 00 09 01 03\nrx: 06 00 80 42 A4 F1 DE",
    "rx: 00 01 00 00 00\nrx: 09 01 03 06 00 80 42 A4 F1 DE",
    "rx: 68 05 05 68 81\nrx: 82 5D 3B 3E D9 16",
    "rx: 68 05 05\nrx: 68 81 82 5D 3B 3E D9 16",
    "rx: F8 03 06 00 80\nrx: 42 A4 F1 DE ~~",
    "tx: 11 42 01 02 ~~\nrx: 11 42 01\nrx: 02 03 04",
    "so 01 03 00 C8 00 03 ~~\nso 01 03 00 C8 00 03\nso 01 03 00 C8 00 04",
    "so 01 03 00 C8 00 03 ~~\nso 01 03 00 C9 00 03 ~~\nso 01 03 00 CA 00 03 00 00\nso 77 88 99 AA",
    "so 01 03 00 C8 00 03 ~~\nso 01 03 00 C9 00 03 ~~\nso F8 88 99 AA",
    "so 01 03 00 C8 00 03 ~~\nso 01 03 00 C9 00 03 ~~\nso 01 88 99 AA",
    "so 01 03 00 C8 00 03 ~~\nso 01 03 00 C9 00 03 ~~\nso F8 03 99 AA",
    "so 01 03 00 C8 00 03 ~~\nso 01 03 00 C9 00 03 ~~\nso 01 03 99 AA ...",
    "tx 00 01 00 00 00 06 01 03 00 C8 00 03\ntx 00 02 00 00 00 06 01 03 00 C9 00 03\ntx 01 03 99 AA",
    "so 01 03 00 C8 00 03 ~~ by\nso 01 03 00 C9 00 03 ~~ by\nso 01 10 00 C8 00 02 04 00 01 00 02 by",
    "so 01 03 00 C8 00 03 ~~\nas 01 03 06 00 80 42 A4 F1 DE ~~\nas 01 03 06 00 80 42 A4 F1 DF ~~\nas 01 03 06 00 80 42 A4 F1 D0",
    "so 01 03 00 C8 00 03 ~~\nas 01 03 06 00 80 42 A4 F1 DE\nas 01 03 06 00 80 42 A4 F1 DF\nas 01 03 06 00 80 42 A4 F1 D0 ~~",
    "TX 01 03 00 C8 00 03 ~~\nRX 01 03 06 00 80 42 A4 F1 DE ~~\nas 03 06 00 80 42",
    "TX 01 03 00 C8 00 03 ~~\nRX 01 03 06 00 80 42 A4 F1 DE ~~\nRX 01 03 06 00 80 42 A4 F1",
    "TX 01 03 00 C8 00 03 ~~\nRX 01 03 06 00 80 42 A4 F1 DE ~~\nRX 01 03 06 00 80 42 A4 F1 DE 01 03 06 00 80 42 A4 F1 DE B0 x",
    "TX 01 03 00 C8 00 03 ~~\nTX 01 03 00 C8 00",
    "TX 01 03 00 C8 00 03 ~~\nTX 01 03 00 C8",
    "TX 01 03 00 C8 00 03 ~~\nx 01 03 00 C8 00 03 84",
    "TX 01 06 00 C8 00 03 ~~\nRX 01 06 00 C8 00 03 ~~\nTX 01 06 00 C8 00 04 00 00\nRX 01 06 00 C8 00 04 ~~",
    "tx: 11 42 01 02 03 04 05 06 07 ~~\ntx: 01 03 00 C8 00 03 ~~\nand again\n11 42 01 02 03 04 05",
    "tx: 11 42 01 02 03 04 05 06 07 ~~\ntx: 01 03 00 C8 00 03 ~~\nand again\n11 42 01 02 03 04",
    "tx: 11 42 01 02 03 04 ~~\ntx: 01 03 00 C8 00 03 ~~\nand again\n11 42 01 02 03",
    "tx: 11 42 01 02 03 04 ~~\ntx: 01 03 00 C8 00 03 ~~\nand again\n11 42 01 02",
    "tx: 11 42 01 02 03 ~~\ntx: 01 03 00 C8 00 03 ~~\nand again\n11 42 01 02 03 00 00",
    "tx: 11 42 01 02 03 ~~\ntx: 01 03 00 C8 00 03 ~~\nand again\n11 42 01 02 04 00 00",
    "tx: 11 42 01 02 03 04 ~~\ntx: 11 42 01 02 05 06 ~~\ntx: 01 03 00 C8 00 03 ~~\nand again\n11 42 01 02 05",
    "so 00 01 00 00 00 06 63 03 00 C8 00 03 it\nby 63 03 06 00 80 42 A4 F1 DE it",
    "TX: 01 03 00 00 00 02 C4 03",
    "41 00 23 00 00 00 00 00\n71 00 23 00 00 00 00 05\n00 00 00 00 00 00 00 00",
    "63 03 00 C8 00 03\n63 03 06 00 80 42 A4 F1 DE\n63 03 00 C9 00 01\n11 22 33 44\n55 66 77 88\n99 AA BB CC",
    "63 03 00 C8 00 03\n63 03 06 00 80 42 A4 F1 DE\n11 22 33 44\n55 66 77 88\n99 AA BB CC\nDD EE FF 00",
    "rx: 00 09 00 00 00 09\ntx: 00 10 00 00 00 06 01 03 00 C8 00 03\ntx: 00 11 00 00 00 06 01 03 00 C8 00 03\ntx: 00 12 00 00 00 06 01 03 00 C8 00 03\ntx: 00 13 00 00 00 06 01 03 00 C8 00 03\ntx: 00 14 00 00 00 06 01 03 00 C8 00 03\ntx: 00 15 00 00 00 06 01 03 00 C8 00 03\ntx: 00 16 00 00 00 06 01 03 00 C8 00 03\ntx: 00 17 00 00 00 06 01 03 00 C8 00 03\nrx: 01 03 06 00 80 42 A4 F1 DE",
    "rx: 00 09 00 00 00 09\ntx: 00 10 00 00 00 06 01 03 00 C8 00 03\ntx: 00 11 00 00 00 06 01 03 00 C8 00 03\ntx: 00 12 00 00 00 06 01 03 00 C8 00 03\ntx: 00 13 00 00 00 06 01 03 00 C8 00 03\ntx: 00 14 00 00 00 06 01 03 00 C8 00 03\ntx: 00 15 00 00 00 06 01 03 00 C8 00 03\ntx: 00 16 00 00 00 06 01 03 00 C8 00 03\ntx: 00 17 00 00 00 06 01 03 00 C8 00 03\ntx: 00 18 00 00 00 06 01 03 00 C8 00 03\nrx: 01 03 06 00 80 42 A4 F1 DE",
    "rx: 00 09 00 00 00 09\n00 0A 00 00 00 06 01 03 00 C8 00 03\nrx: 01 03 06 00 80 42 A4 F1 DE",
    "00 09 00 00 00 09\ntx: 00 0A 00 00 00 06 01 03 00 C8 00 03\n01 03 06 00 80 42 A4 F1 DE",
    "rx: 00 09 00 00 00 09\nrx: 00 0A 00 00 00 06 01 03 00 C8 00 03\nrx: 01 03 06 00 80 42 A4 F1 DE",
    "tx: 06 04 00 07 00 01 ~~\nrx: 06 04 02 00 40 0D 00 00 06 00 C8 00 03 48 24",
    "so E5 E5 E5 E5 it",
    "so DC 01 02 DC 02 01 it",
    "so E5 DC 01 02 it",
    "a 63\nb 03\nc 00\nd C8\ne 00\nf 03\n\nby 63 03 06 00 80 42 A4 F1 DE it",
    "rx 00 01 00 00 00 06 01 03 00 C8 00 03, 12",
    "01 03 00 C8 00 03 84 36\n01 03 06 00 80 42 A4 F1 DE",
    "discarded: 01 03 00 C8 00 03\nby 01 03 06 00 80 42 A4 12 34 it",
    "so :01630000009C it",
    "x :6308001500FF it",
    "3A 31 31 36 33 0D 0A",
    "rx: 01 03 06 00 80 42 A4 F1 DE\nreceived B0 F8 more",
    "rx: 01 03 06 00 80 42 A4 F1 DE\nsent B0 F8 more",
    "so FF 11 42 8D D1",
    "so FF 11 42 01 D0 A5",
    "so FF 11 42 01 02 03 DC DA",
    "so FF 11 80 01 02 03 E1 62",
    "so 63 03 00 C8 00 03 ~~ it\n1\n2\n3\n4\n5\nso 63 03 06 00 80 42 it",
    "so 63 03 00 C8 00 03 it\nby 63 03 06 00 80 42 A4 F1 DE it",
    "so 63 03 00 C8 00 03 it\nby 62 03 06 00 80 42 A4 F1 DE it",
    "so 63 03 00 C8 00 03 it\nby 63 04 06 00 80 42 A4 F1 DE it",
    "so 63 03 00 C8 00 03 it\nby 63 03 04 00 80 42 A4 it",
    "COM1 so 63 03 00 C8 00 03 it\nCOM2 by 63 03 06 00 80 42 A4 F1 DE it",
    "so 63 03 00 C8 00 03 ~~ it\nby 63 83 02 it",
    "so 63 03 00 C8 00 03 ~~ it\nby 63 83 02 01 it",
    "by 63 03 06 00 80 42 A4 F1 DE it\nso 63 03 00 C8 00 03 it",
    "so 41 00 23 00 00 00 00 00 it\nby 71 00 23 00 00 00 00 05 it",
    "so 41 00 23 00 00 00 00 00 it\nby 71 00 24 00 00 00 00 05 it",
    "so 41 00 00 00 00 00 00 00 it\nby 71 00 00 00 00 00 00 05 it",
    "so 00 01 00 00 00 06 63 03 00 C8 00 03 it\nby 00 01 00 00 00 08 63 03 06 00 80 42 A4 F1 DE it",
    "so 00 01 00 00 00 06 63 03 00 C8 00 03 it\nby 00 02 00 00 00 08 63 03 06 00 80 42 A4 F1 DE it",
    "so 10 5B 0A 65 16 it\nso 10 01 02 49 4C 16 it\nso 10 01 02 4A 4D 16 it",
    "so 10 5B 0A 65 16 it\nso 10 5B 0B 66 16 it\nso 10 01 02 49 4C 16 it",
    "so 0x63, 0x03, 0x00, 0xC8, 0x00, 0x03 it\nby 0x63, 0x03, 0x06, 0x00, 0x80, 0x42, 0xA4, 0xF1, 0xDE it",
    "63 03 00 C8 00 03\n63 03 06 00 80 42 A4 F1 DE\n11 22 33 44\nhello",
    "63 03 00 C8 00 03\n63 03 06 00 80 42 A4 F1 DE\n11 22 33 44\n55 66 77\n88 99 AA",
    "hello\nyou\n63 03 00 C8 00 03",
    "03 00 C8 00 03\n03 06 00 80 42 A4 F1 DE\n03 00 C8 00 03\n03 06 00 80 42 A4 F1 D0",
    "03 00 C8 00 03\n01 03 00 C8 00 03 ~~",
    "B7 A3 93\n00 0C 00 02 05 EB\n88 01 0A 0B 05 EB 00",
    "41 00 23 00 00 00 00 00\n71 00 23 00 00 00 00 05\n41 00 23 01 00 00 00 00\n71 00 23 01 00 00 00 06",
    "52 00 23 00 00 05 00 00\n52 00 23 00 00 05 00 00\n12 00 23 01 00 06 00 00\n12 00 23 01 00 06 00 00",
    "41 00 23 00 00 00 00 00\nC1 00 23 00 06 03 00 00",
    "x 01 03 00 C8 00 03 ~~ y\n| 01 | 01 |\n| 03 | 03 |\n| 00 | 00 |\n| C8 | C9 |\n| 00 | 00 |\n| 03 | 03 |\n| 84 | D5 |\n| 35 | F5 |",
    "a 01\nb 03\nc 05\nd 06\ne B3\nf 4A",
    "ADR 01H, CMD 03H, CRC 40H 21H",
    "ADR 01H, CMD 03H, number 05H 06H, CRC B3H 4AH",
    "| 01 | 01 |\n| 03 | 03 |\n| 00 | 06 |\n| C8 | 00 |\n| 00 | 80 |\n| 03 | 42 |\n| z | A4 |\n| z | F1 |\n| z | DE |",
];

/// Slips and odd neighbours, each of which shows a difference that the other texts do not.
const DIFFERENCES: &[&str] = &[
    "01 17 00 10 00 05 00 20 00 05 0A 00 00 01 00 02 00 03 00 04 00 crc",
    "00 00 01 00 02 00 03 00 04 00 05 00",
    "01, }03,\n00, C8, (8)\nend 00, 03",
    "S1: C1 00 23 00 00 00 00 00\nE1: 71 00 23 00 00 00 00 05",
    "10:00:01 discarded  rx: 01 03 06 00 80\n1000:00 rx: 42 A4 F1 DE B0 F8",
    "12 34 56 0AZq 78\n01 0300 C8 1A3 00\n01 03 00 C8 | ....",
    "00 03,00 C8 10 03,84 35",
    "8字节 01 0 00 C8 00 03 ~~",
    "1, 3, //, 4,\nE5 5, 6",
    "tx: 06 04 22 07 00 01 ~~\nrx: 06 04 02 00 ~~\nrx: 00\nA 0000: 01\nB 0000: 02\nC 0000: 03\nA 0001: 04\nB 0001: 05\nC 0001: 06",
    "01 03 06 00 80 42\n41 00 23 00 00 00 00 00\n41 00 23 00 00 00 00 00\n71 00 23 00 00 00 00 05\n00 00 00 00 00 00 00 00",
    "\"\\x01Ā\"\n0101 03 00 8 00 03 ~~  .......5",
    "ok E5\n01 03 00 C8 0[0 03 ~~ 01 03 06 00 80 42 A4 F1 DE ~~",
    "01 03 00 C8 00 03 ...x ->\nrx 00 01 00 00 00 06 01 03 00 C8 00 03",
    "0000:\t01 03 00 C8\nrx: 68 05 05\nrx: 68 81 82 5D 3B 3E D9 16",
    "and again\ntx: 01 03 00 C8 00 03 ~~\ntx: 11 42 01 02 03 04 05 06 07 ~~\n11 42 01 02 03 04 05",
    "'\\x01\\x03' and \"\\x00\\xC8\\x00\\x03\\x84\\x35\" '\n'\\x01\\x03' and \"\\x00\\xC8\\x00\\x03\\x84\\x35\"\n'\\x01\\x03' and \"\\x00\\xC8\\x00\\x03\\x84\\x35\"",
    "so 01 03 00  ' C8 00 03 ~~\nso 0E 03 00 C9 00 0 ~~\nso 01 03 99 AA ...\n<01><03><00><C8><00><03><84><35>",
    "41 00 23 00 00 00 00 00 frame\n71 00 23 0000 00 00 00 05\n41 00 23 01 00 00 00 00 COM1\n71 00 23 01 00 00 00 06",
    "10.0.0.7:49152-> 192.168.0.10:502 01 06 00 C8 00 03\nrx: 00 01 00 00 00 06 01 03  ' 00 C8 00 03\n10.0.0.7:49152-> 192.168.0.10:502 01 06 00 C8 00 03",
    "--> 01 03 00 00 00 02 ~~\n<-- (timeout) <-\n--> 01 03 00 00 00 02~~\n<-- 00 01 03 04 00 01  02 2A 32 00\n",
    "TX 01 03 00 C8 00 03 ~~\nrx: 01 03 00 C8 00 03 ~~\nRX 01 03 06 00 80 42 A4 F1 DE ~~\nRX 01 03 06 00 80 42 A4 F1 DE 01 03 06 00 80 42 A4 F1 DE B0 x",
    "Request:\n01 03 00 C8 00 03 ~~\nResponse:\n01 03 06 00 80 42 A4 F1 DE ~~\ntx -> rx 01 03 00 C8\n41 54 2B 43 47 4D 49 0D",
    "{\"ts\":5646123456789,\"level\":\"debug\",\"msg\":\"tx\",\"hex\":\"010300000002c40b\"}\n{\"ts\":1646123456839,\"level\":\"debug\",\"msg\":\"rx\",\"hex\":\"010304000100022a32\"}\n{\"ts\":1646123457839,\"level\":\"info\",\"msg\":\"value\",\"raw\":[1,2],\"float\":9.18e-41}\n",
    "A 0000: 01\nB 0000: 02\nC 0000: 03\nA 0001: 04\nB 0001: 05\nC 0001: 06\n10 01 02 49 4C 16\nE5\n10 5B 0A 65 16\n63 03 00 C8 00 03\n63 03 06 00 80 42 A4 F1 DE\n11 22 33 44\nhello",
    " 8 1, 3, 0, 20, 0x05, 6",
    "sc e5\n09:30:05 discarded sc e5\n09:30:05 discarded sc e5",
    "rx 01 tx 01 03 00 C8\n20 20 41 42    AB\n\\x01\\x03\\x00\\xC8\\x00\\x03\\x845",
    "10 20 30 40 50 6A\n63 03 00 C8 00 03\n11 22 33 44\n63 03 06 00 80 42 A4 F1 DE\n55 66 77\n89 99 AA }",
    "1,1, 3, 0, 200, 0, 3, 132, 53 h",
    "1,  note 3, 0, 20,\n0x00, 0x03, 0x84, 0x35",
    "; 01 03 00 O8Q 00",
    "rx 00 01 00 00 00 06 01 03 00 C8 00 /03, 12",
    "0000: 01 03 00 C8\n0004: 00 03 84 35\n0010: 01 03\nserver <- 01 03 00 C8",
    "99 01 03 00  00 03 84 35,99\n99 01 03 00  00 03 84 35,99\nTX:\n01 03 00 C8 00 03 ~~ E5",
    "12 00 23 01 00 06 00 00\n52 00 23 00 00 05 00 00\n52 00 23 00 00 05 00 00\n12 00 23 01 00 06 00 00",
    "rx: 01 03 06 00 80 42 A4 F1 DE\nrx: 01 03 06 00 80 42 A4 F1 DE\nrx: 68 81 82 5D 3B 3E D9 16\nreceived B0 F8 more",
    "COM1 tx 03 00 01 00 02\nCOM2 rx 03 04 00 01 00 02",
    "tx 00 00 00 00 00 20 01 63 00",
    "01 01 03 00 07 D0 ~~",
    "01 01 03 00 07 D1 ~~",
    "what came back here was odd\nit was not what I asked\nTX: 01 03 00 C8 00 03 84 35\nRX: 01 03 06 00 80 42 A4 F1 DE B0 F9\nTX: 01 03 00 C8 00 03 84 35\nRX: 01 03 06 00 80 42 A4 F1 DE B0 F7\nTX: 01 03 00 C8 00 03 84 35\nRX: 01 03 06 00 80 42 A4 F1 DE\n and again and again here",
    "TX: 01 03 00 C8 00 03 ~~\nRX: 01 03 00 C8 00 03 ~~\nRX: 01 03 06 00 80 42 A4 F1 DE ~~\nTX: 01 03 00 C8 00 03 ~~\nRX: 01 03 00 C8 00 03 ~~\nRX: 01 03 06 00 80 42 A4 F1 DE ~~\nTX: 11 42 01 02 03 ~~\nRX: 11 42 01 02 03 ~~\nRX: 11 42 09 09 09 ~~",
    "10 01 02 49 4C 16 SC E5 SC E5",
    "a 01\nb 42\nc 07\nd 51\ne 62",
    "TX: 08 03 00 10 00 01 85 56\nRX: 08 03 02 8D 00 01 15 00 08 03 02 00 00 64 45",
    "TX: 08 03 00 10 00 01 85 56\nRX: 08 03 02 8D 00 01 15 08 03 00 10 00 01 85 56",
    "3A 30 31 34 32 30 30 0D 0A",
    "TX: 55 08 03 00 10 00 01 85 56 08 03 02 8D 00 01 15 00 55 55",
    "TX: 68 05 05\nTX: 68 81 82 5D 3B 3E D9 16",
    "TX: 01 42 00 C8 A0 5A FF 01 42 00 C9 61 9A",
    "TX: 01 42 00 C8 A0 5A FF 01 42 00 C9 61 9B",
    "TX: 01 42 00 C8 A0 5A FF 02 43 00 C9 30 1E",
    "55 08 03 00 10 00 03 04 97 55 08 03 06 00 01",
    "so 01 06 00 C8 00 05 it\nso 01 06 00 C8 00 06 it",
    "so 01 06 00 C8 00 05 it\nso 01 06 00 C8 00 05 it",
    "so 10 01 02 49 4D 16 it\nso E5 it\nSC E5",
];

/// Puts the check of the bytes before it where `~~` stands.
pub fn checked(text: &str) -> String {
    let mut whole = String::new();
    for (index, part) in text.split("~~").enumerate() {
        if index > 0 {
            let line = whole.rsplit('\n').next().unwrap_or_default();
            let is_byte = |word: &&str| word.len() == 2 && word.bytes().all(|c| c.is_ascii_hexdigit());
            let mut words: Vec<&str> =
                line.split(' ').filter(|word| !word.is_empty()).rev().take_while(is_byte).collect();
            words.reverse();
            // What stands behind another check is a telegram of its own.
            let own = bytes(&words.join(" "));
            let from = (0..own.len())
                .rev()
                .find(|at| {
                    *at >= 4
                        && CRC_16_MODBUS.wire(&own[..at - 2])
                            == u64::from(u16::from_be_bytes([own[at - 2], own[at - 1]]))
                })
                .unwrap_or(0);
            let check = CRC_16_MODBUS.wire(&own[from..]) as u16;
            write!(whole, "{}", hex(&check.to_be_bytes())).unwrap();
        }
        whole += part;
    }
    whole
}

/// The telegrams of small texts, with all that is known of each.
#[test]
fn what_is_found_in_texts() {
    let mut table = String::new();
    let texts = CONVERSATIONS.iter().chain(DIFFERENCES).chain(SPELLINGS).chain(SURROUNDINGS).chain(BLOCKS);
    for text in texts {
        let text = checked(text);
        writeln!(table, "{}", text.escape_debug()).unwrap();
        found(&mut table, text.as_bytes());
    }
    // What is too long is no telegram; alone in its line it may be more.
    for (before, behind) in [("", ""), ("so ", " it")] {
        for length in [300, 301, 599, 600] {
            let header = hex(&(length as u16 - 5).to_be_bytes());
            let text = format!("{before}00 01 00 00 {header} 01 03{}{behind}", " 5A".repeat(length - 8));
            writeln!(table, "{before}{length} bytes{behind}").unwrap();
            found(&mut table, text.as_bytes());
        }
    }
    // Of telegrams that begin alike so many are known again.
    for count in [16, 17] {
        let all: String = (0..count).map(|n| format!("tx: 11 42 01 02 {n:02X} ~~\n")).collect();
        let text = format!("{all}tx: 01 03 00 C8 00 03 ~~\nand again\n11 42 01 02 {:02X}", count - 1);
        writeln!(table, "{count} alike").unwrap();
        found(&mut table, checked(&text).as_bytes());
    }
    assert_table("found", &table);
}

/// The same for what people paste.
#[test]
fn what_is_found_in_posts() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/posts");
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_none_or(|extension| extension != "json"));
    files.sort();
    let mut table = String::new();
    for file in files {
        writeln!(table, "{}", file.file_name().unwrap().to_string_lossy()).unwrap();
        found(&mut table, &std::fs::read(&file).unwrap());
    }
    assert_table("found_in_posts", &table);
}

fn found(table: &mut String, text: &[u8]) {
    let log = match Log::read(text, &Reading::default(), Options::default()) {
        Ok(log) => log,
        Err(why) => return writeln!(table, "    {why:?}").unwrap(),
    };
    for entry in log.entries() {
        let own = log.bytes(&text, &entry);
        let bytes = match own.len() {
            0..=64 => hex(&own),
            length => format!("{} … ({length} bytes)", hex(&own[..8])),
        };
        let mut said = format!(
            "{} at {}+{}: {bytes} | {} {:?} {:?}",
            entry.line,
            entry.offset,
            entry.skip,
            entry.protocol().key,
            entry.verdict,
            entry.direction
        );
        if entry.role != Role::Plain {
            write!(said, " {:?}", entry.role).unwrap();
        }
        if let Some(partner) = entry.partner() {
            write!(said, ", with {partner}").unwrap();
        }
        let unit = entry.unit.map_or("no unit".to_owned(), |unit| format!("unit {unit}"));
        write!(said, ", {unit}, function {}, sides {:?}", entry.function, entry.sides()).unwrap();
        if let Some(time) = entry.time() {
            write!(said, ", time {time}").unwrap();
        }
        if entry.is_said() {
            said += ", said";
        }
        if let Some(port) = log.port_name(entry.port) {
            write!(said, ", port {port}").unwrap();
        }
        writeln!(table, "    {said}").unwrap();
    }
    if !log.unread().is_empty() {
        let unread: Vec<String> = log.unread().iter().map(|(line, at)| format!("{line} at {at}")).collect();
        writeln!(table, "    unread {}", unread.join(", ")).unwrap();
    }
}
