//! What the reader of texts says of many small ones.

use std::fmt::Write as _;
use std::path::Path;

use buslens::dialogue::foreign::FOREIGN;
use buslens::dialogue::{self, Context, evidence, hypotheses};
use buslens::field::{Direction, Facts, Span, hex};
use buslens::frame::split::{Splitter, Waiting};
use buslens::modbus::STANDARD;
use buslens::text::{self, Event, Form, Marks, Numbers, Piece, Place, Reader, Sender};
use buslens::tool::log::{Log, Reading, Role};
use buslens::tool::{Options, PROTOCOLS, Protocol};
use buslens::walk::CRC_16_MODBUS;

use super::{assert_table, bytes};

/// A telegram in many spellings.
const SPELLINGS: &[&str] = &[
    "01 03 00 C8 00 03 84 35",
    "01  03  00  C8  00  03  84  35  ",
    "\t01\t03\t00\tC8\t00\t03\t84\t35",
    "1 3 0 C8 0 3 84 35",
    "1 03 00 C8 00 03 84 35",
    "01-03-00-C8-00-03-84-35",
    "01:03:00:C8:00:03:84:35",
    "01.03.00.C8.00.03.84.35",
    "01/03/00/C8/00/03/84/35",
    "01, 03, 00, C8, 00, 03, 84, 35",
    "01;03;00;C8;00;03;84;35",
    "01_03_00_C8_00_03_84_35",
    "01|03|00|C8|00|03|84|35",
    "010300C800038435",
    "0103 00C8 0003 8435",
    "010300C8 00038435",
    "01 03 00 C8-00 03 84 35",
    "01 03 00 C8 00 03 84 35 - 01 03 00 C8 00 03 84 35",
    "01 03 00 C8 00 03 84 35-01 03 06 00 80 42 A4 F1 DE B0 F8",
    "0x01 0x03 0x00 0xC8 0x00 0x03 0x84 0x35",
    "0X1,0X3,0X0,0XC8,0X0,0X3,0X84,0X35",
    "0x010300C800038435",
    "0x010x030x000xC80x000x030x840x35",
    "0x0103 0x00C8 0x0003 0x8435",
    "0x01u, 0x03u, 0x00u, 0xC8u, 0x00U, 0x03L, 0x84ul, 0x35i8",
    "0x01 0x03 0x00 0xC8 0x0 0x3 0x843 0x",
    "{ 0x01, 0x03, 0, 200, 0, 3, 0x84, 0x35 }",
    "01h 03h 00h C8h 00h 03h 84h 35h",
    "01H,03H,00H,0C8H,00H,03H,84H,35H",
    "1h 3h 0h 0C8h 0h 3h 84h 35h",
    "0103h 00C8h 0003h 8435h",
    "ach 01h 03h 00h C8h",
    "$01 $03 $00 $C8 $00 $03 $84 $35",
    "#01#03#00#C8#00#03#84#35",
    "%01%03%00%C8%00%03%84%35",
    "&H01 &H03 &H00 &HC8 &h00 &h3 &H84 &H35",
    "&H &H123 &H01",
    "16#01 16#03 16#00 16#C8 16#0 16#3 16#84 16#35",
    "16#123 16#1 16#",
    r"\x01\x03\x00\xC8\x00\x03\x84\x35",
    r"\x01\x03\x00\xC8\x00\x03\x845",
    r"b'\x01\x03\x00\xc8\x00\x03\x845'",
    r#""\001\003\000\310\000\003\2045""#,
    r#"b"\x01\x03\x00\xC8\0\x03\x845" + b'ab'"#,
    r#"'\x01\x03' and "\x00\xC8\x00\x03\x84\x35""#,
    r#""\x01\x03\n\r\t\a\b\v\f\\\"""#,
    r"'\x01\x03\q\x00'",
    r"'\x0g\x01\x03'",
    r"'\x01\x3'",
    r"'\08\19'",
    r"'\x01\xg3'",
    r"C:\x01\x03.txt",
    "\"\\x01\\xc3\\xa9\u{e9}\"",
    "\"\\x01\u{100}\"",
    "it's 01 03 00 C8, isn't it",
    "[01][03][00][C8][00][03][84][35]",
    "<01><03><00><C8><00><03><84><35>",
    "<01><03>",
    "[01 03 00 C8 00 03 84 35]",
    "(01 03 00 C8 00 03 84 35)",
    "\"01 03 00 C8 00 03 84 35\"",
    "`01 03 00 C8 00 03 84 35`",
    "{01 03 00 C8 00 03 84 35}",
    "<01 03 00 C8 00 03 84 35>",
    "*01 03 00 C8 00 03 84 35*",
    "01 03 **00 C8** 00 03 84 35",
    "01 03 ~~00~~ C8 00 03 84 35",
    "\u{1b}[32m01 03\u{1b}[0m 00 C8 \u{1b}[1;31m00 03\u{1b}[m 84 35",
    "\u{1b}[01 03 00 C8",
    "\u{1b}01 03 00 C8 00 03",
    "1, 3, 0, 200, 0, 3, 132, 53",
    "1 3 0 200 0 3 132 53",
    "001 003 000 200 000 003 132 053",
    "[1, 3, 0, -56, 0, 3, -124, 53]",
    "1, 3, 0, -56, 0, 3, -124, -0, 53",
    "1, 3, 0, -129, 0",
    "1, 3, 0, 256, 0, 3, 132, 53",
    "01 03 00 C8 00 03 84 3",
    "01 03 00 C8 00 03 84 35 7",
    "01 03 00 G8 00 03 84 35",
    "O1 03 00 C8 00 03 84 35",
    "01 03 0O C8 00 l3 84 35",
    "01 03 x 00 C8 00 03",
    "01 03 00 C8 00MQTT is up 03 84 35",
    "010300C8X00038435",
    "010300C8000384351",
    "010300C80003843",
    "103 00C8 0003",
    "faced beef 01 03 00 C8",
    "01 03 BEEF 00 C8",
    "0103 BEEF 00C8",
    "| 0103 | BEEF | BDCB |",
    "00010000 00000011 11111111 10101010",
    "０１　０３　００　Ｃ８　００　０３　８４　３５",
    "０１０３００Ｃ８ａｂ",
    "01\u{a0}03\u{a0}00\u{a0}C8\u{2009}00\u{3000}03",
    "01\u{2013}03\u{2013}00\u{2013}C8",
    "01 03 00 C8 é 00 03 84 35",
    "8字节 01 03 00 C8 00 03 84 35",
    "16进制: 01 03 00 C8",
    ":010300C8000331",
    ":010300C8000331\\r\\n",
    "a:010300C8000331",
    "x :010300C8",
    ": 010300C8000331",
    ":0103",
];

/// What stands around bytes.
const SURROUNDINGS: &[&str] = &[
    "TX: 01 03 00 C8 00 03 84 35",
    "tx 01 03 00 C8 00 03 84 35 rx 01 03 06 00 80 42 A4 F1 DE B0 F8",
    "RX = 01 03 06 00 80 42 A4 F1 DE B0 F8",
    "rx 01 tx 01 03 00 C8",
    "read 01 03 00 C8 then write 01 03 00 C8",
    "request by the client: 01 03 00 C8 00 03",
    "Request | Response 01 03 00 C8 00 03",
    "request, request 01 03 00 C8 00 03",
    "master -> slave: 01 03 00 C8",
    "slave -> master: 01 03 00 C8",
    "slave <- master 01 03 00 C8",
    "client => server 01 03 00 C8",
    "master x -> 01 03 00 C8",
    "-> 01 03 00 C8 00 03",
    "--> 01 03 00 C8 00 03",
    "<- 01 03 00 C8 00 03",
    "<= 01 03 00 C8 00 03",
    ">> 01 03 00 C8 00 03",
    "<<< 01 03 00 C8 00 03",
    "> 01 03 00 C8 00 03",
    "< 01 03 00 C8 00 03",
    "  > 01 03 00 C8 00 03",
    "x > 01 03 00 C8 00 03",
    "→ 01 03 00 C8 00 03",
    "← 01 03 00 C8 00 03",
    "发送: 01 03 00 C8 00 03",
    "收 01 03 00 C8 00 03",
    "S1: 41 00 23 00 00 00 00 00",
    "E12: 71 00 23 00 00 00 00 05",
    "S100: 41 00 23 00",
    "S: 41 00 23 00",
    "x E1: 41 00 23 00",
    "COM3 01 03 00 C8 00 03",
    "COM 01 03 00 C8 00 03",
    "COM3x 01 03 00 C8 00 03",
    "ttyACM1 ttyAMA0 01 03 00 C8",
    "ttyUSB0: 01 03 00 C8 00 03",
    "ttyS x COM12 01 03 00 C8 00 03",
    "10.0.0.7:49152 -> 192.168.0.10:502 01 06 00 C8 00 03",
    "192.168.0.10:502 > 10.0.0.7:49152: 01 06 00 C8 00 03",
    "10.0.0.7.49152 > 192.168.0.10.502: 01 06 00 C8 00 03",
    "10.0.0.7 -> 10.0.0.1 01 06 00 C8 00 03",
    "10.0.0.7 10.0.0.7 01 06 00 C8 00 03",
    "10.0.0.7 10.0.0.1 10.0.0.3 01 06 00 C8 00 03",
    "10.0.0.256 10.0.0.1234 10.0.0 10.0.0.1x 01 06 00 C8",
    "TX 10.0.0.7:1000 01 06 00 C8 00 03",
    "10.0.0.1:502 10.0.0.1:502 01 06 00 C8 00 03",
    "8: 01 03 00 C8 00 03 84 35",
    "01 03 00 C8 00 03 84 35 (8 bytes)",
    "len=8 01 03 00 C8 00 03 84 35",
    "len=9 01 03 00 C8 00 03 84 35",
    "8 01 03 00 C8 00 03 84 35",
    "7B 04'00 C8 00 03",
    "01 03,00 C8 00 03,84 35",
    "01 03 00 C8, 00 03, 84 35; 01.02 03.04 05:06 07/08 09|0A 0B-0C",
    "frame 01 03 00 C8 00 03 84 35",
    "crc of 01 03 00 C8 00 03: 84 35",
    "discarded 01 03 00 C8 00 03",
    "skipping junk 01 03 00 C8 frame",
    "01 03 00 C8 00 03 84 35  .......5",
    "01 03 00 C8 00 03 84 35 |.......5|",
    "01 03 00 C8 00 03 84 35   ...È...5",
    "01 03 41 42 43 44  ..ABCD",
    "01 03 41 42 43 44  ..ABCE",
    "01 03 20 42 20 20  .. B",
    "01 03 00 C8 ... 84 35",
    "01 03 00 C8 00 03..",
    "01 03 00 C8 00 03 .....",
    "01 03 00 C8 00 03 ...x",
    "01 03 00 C8 00 03 xx xx",
    "01 03 00 C8 00 03 ?? ??",
    "01 03 00 C8 00 03 …",
    "..01 03 00 C8 00 03",
    "value=1234 01 03 00 C8",
    "value 1234",
    "value: 12345678",
    "ID 0103 at 00C8 and 12345678",
    "12345678",
    "1234",
    "E5",
    "SC E5",
    "sc: E5",
    "ok E5",
    "TX: E5",
    "TX: 01",
    "TX: 01 03",
    "tx got 01 03",
    "the rest: 84 35",
    "the rest 84 35",
    "84 35",
    "8",
    "01 03 00",
    "unit 1 asks for 3 registers from 200",
    "ADR 01H, CMD 03H, address 00H C8H, count 00H 03H",
    "0x01 is the unit, 0x03 the function",
    "const uint8_t request[] = {0x01, 0x03, 0x00, 0xC8, 0x00, 0x03, 0x84, 0x35}; // 8 bytes",
    "send(0x01, 0x03, 0x00, 0xC8, 0x00, 0x03, 0x84, 0x35)",
    "Buffer.from([1, 3, 0, 200, 0, 3, 132, 53])",
    "data := \"010300C800038435\"",
    "crc=0x3584",
    "The register 40201 has 3 words of 16 bits, see page 12 (2026).",
    "https://example.org/0103/00C8?id=8435",
    "{\"hex\":\"010300C800038435\",\"unit\":1}",
    "aa:bb:cc:dd:ee:ff",
    "550e8400-e29b-41d4-a716-446655440000",
    "1.2.3.4",
    "v1.2.3 build 20260302",
    "0000 01 03 00 C8",
    "0000:01 03 00 C8",
    "0000:\t01 03 00 C8",
    "0000  01.03",
    "0000  01-03",
    "0000  010300C800",
    "00000000 01 03 00 C8",
    "x 00000000  01 03 00 C8",
    "x 0000  01 03 00 C8",
    "00000000000000000  01 03",
    "000  01 03",
    "0000: xx",
    "0003: 01 03 00 C8",
    "1, 3, 0, 20, 0x05, 6",
    "01 03 00 C8, 00 03",
    "0103,00C8,0003",
    "01030405,06070809",
    "01030405 06070809",
    "0103 04050607 0809",
    "01  03 00 C8",
    "01 03  00 C8 00 03",
    "01 03 00 C8  00 03",
    "01, 03, 00,C8, 00, 03",
    "01, 03, 00, C8x 00, 03",
    "01 03 00 C8x",
    "01 03 00 C8é",
    "01 03 00 3",
    "01 03 00 30 030 40",
    "10 20 30 40 50 60",
    "10 20 30 40 50 6A",
    "10 20 30 40 5A 60 70 80",
    "10 20 30 07 50 60",
    "01 03 00 O8 Q 00",
    "01 03 00 ab1z 00",
    "12 34 5x 78 9a",
    "12 34 xx 78 9a",
    "12 34 x5 78 9a",
    "12 34 G 78 9a",
    "12 34 G",
    "12 G 78 9a",
    "12,34,G,78,9a",
    "12 34 56 00Zq 78",
    "12 34 56 0AZq 78",
    "12 34 56 AAZq 78",
    "01 02 03 AAZq 78",
    "01 02 03 0Azq 78",
    "01 02 0AZq 78",
    "1234567G90",
    "123G567G90AB",
    "12G456",
    "12G45",
    "A2G456",
    "word 1234567G90",
    "word 12345",
    "12345",
    "1234567",
    "a1234567",
    "10:00:00 1234567",
    "0101",
    "01 1",
    "1 01",
    "a 01 03 00",
    "1 01 03 00",
    "read 1 01 03 00 C8",
    "ask, answer 01 03 00 C8",
    "tx rx 01 03 00 C8",
    "tx -> rx 01 03 00 C8",
    "server -> 01 03 00 C8",
    "server <- 01 03 00 C8",
    "client -> 01 03 00 C8",
    "client <- 01 03 00 C8",
    "server x <- 01 03 00 C8",
    "read write 01 03 00 C8",
    "send read 01 03 00 C8",
    "tx: 01 03 00 C8 01 03 00 C8",
    "tx: 01 03 00 then 01 03 00 C8",
    "tx: 01 03 00 C8 then 01 03 00 C8",
    "[01][03]",
    "[01][03][00]",
    "<01><03><00>",
    "tx [01][03][00]",
    "10.0.0.7:502 -> 10.0.0.1:502 tx 01 06 00 C8",
    "tx 10.0.0.7:1502 -> 10.0.0.1:502 01 06 00 C8",
    "10.0.0.1:502 -> 10.0.0.7:1502 01 06 00 C8",
    "-12, 34, 56, 78",
    "12, -34, 56, 78",
    "12,-34,56,78",
    "12, -034, 56, 78",
    "12, -128, 56, 78",
    "12, -34; 56",
    "12, -34x, 56, 78",
    "[-1, -2, -3, -4]",
    "{-1, -2, -3, -4}",
    "12-34-56-78",
    "0x12 -34",
    r"\x01\x0g\x03",
    r"\x01",
    r"\x1\x2",
    r#""\x01" "\x03\x00""#,
    "'01 03 00 C8",
    "\"01 03 00 C8",
    "it's \\x01\\x03 'a' \"b\"",
    "01 03 00 C8   ....  ",
    "01 03 00 C8\t....",
    "01 03 00 C8 ....",
    "01 03 00 C8|....",
    "01 03 00 C8 | ....",
    "41 42 43 44  ABCD",
    "41 42 43 44  ABC",
    "41 42 43 44  ABCDE",
    "41 42 20 20  AB",
    "20 20 41 42    AB",
    "41 42 43 44  ÄBCD",
    "01 03 00 C8 {8}",
    "(2) 01 03 00 C8",
    "(4) 01 03 00 C8",
    "4: 0103 00C8",
    "count 4 of 01 03 00 C8",
    "01 4",
    "SC: 01",
    "sc e5",
    "xx E5 SC",
    "0b00000001 0b00000011",
    "11000101",
    "tx 11000101 01 03 00 C8",
];

/// Times in front of bytes.
const TIMES: &[&str] = &[
    "9:30:05",
    "09:30:05",
    "09:30:05.5",
    "09:30:05,123456789",
    "09:30:05.1234567890",
    "09:30:05Z5",
    "09:30:05+0100",
    "09:30:05+01005",
    "09:30:05.",
    "09:30:05:081",
    "09:30:05:08:01",
    "09:30:05:0x",
    "09:30:05: ",
    "23:59:60",
    "24:00:00",
    "23:60:00",
    "23:59:61",
    "009:30:05",
    "9:3:05",
    "09:30:5",
    "09:30",
    "2026-03-02",
    "2026-3-2 09:30:05",
    "2026-03-02T09:30:05",
    "2026-03-02T09:30:05Z",
    "2026-03-02t09:30:05z",
    "2026-03-02T09:30:05Zx",
    "2026-03-02T09:30:05+01:00",
    "2026-03-02T09:30:05+0100",
    "2026-03-02T09:30:05-01:00",
    "2026-03-02T09:30:05+01",
    "2026-03-02T09:30:05+01:x",
    "2026-03-02, 09:30:05.25",
    "2026-03-02_09:30:05",
    "2026-03-02    09:30:05",
    "2026/03/02 09:30:05",
    "2026.03.02 09:30:05",
    "02.03.2026 09:30:05",
    "02/03/2026 09:30:05",
    "31/12/2026 09:30:05",
    "12/31/2026 09:30:05",
    "13/13/2026 09:30:05",
    "2026-13-02 09:30:05",
    "2026-00-02 09:30:05",
    "2026-02-32 09:30:05",
    "2026-02-00 09:30:05",
    "1899-02-01 09:30:05",
    "2199-02-01 09:30:05",
    "2200-02-01 09:30:05",
    "26-03-02 09:30:05",
    "2026-003-02 09:30:05",
    "2026-03/02 09:30:05",
    "2024-02-29 00:00:00",
    "2000-03-01 00:00:00",
    "1970-01-01 00:00:01",
    "1969-12-31 23:59:59",
    "2026-01-31",
    "2026-08-15",
    "2026-12-31",
    "1772443805.123",
    "1772443805.123456",
    "12.345678",
    "12.34",
    "12.345.6",
    "12.345:6",
    "12.345-6",
    "100000000000.123",
    "99999999999.123",
    "[09:30:05.081]",
    "(12.345678)",
    "t=12.345678",
    "12:34:56.789 09:30:05",
];

/// Several lines that belong together, or do not.
const BLOCKS: &[&str] = &[
    "00000000: 0103 00c8 0003 8435  ...5\n00000008: 0103 0600 8042 a4f1\n00000010: deb0 f8",
    "0000  01 03 00 C8 00 03 84 35 01 03 06 00 80 42 A4 F1  ................\n0010  DE B0 F8",
    "0000000 0301 c800 0300 3584\n0000010",
    "0000000 001 003 000 310 000 003 204 065\n0000010 001 203\n0000012",
    "0000000 001401 144000 001400 032604\n0000010",
    "0000000 001 9",
    "0000000 0010 003",
    "0x0000:  0103 00c8 0003 8435\n0x0010:  0103 0600",
    "0000: 01 03 00 C8\n0004: 00 03 84 35\n0010: 01 03",
    "0000: 01 03 00 C8\n0003: 00 03 84 35",
    "TX 0000: 01 03 00 C8 00 03 84 35\nRX 0000: 01 03 06 00 80 42 A4 F1\nRX 0008: DE B0 F8",
    "0008: 01 03\n0010: 00 C8",
    "0010  01 03 00 C8",
    "09:30:05 0000: 01 03 00 C8\n09:30:06 0004: 00 03 84 35",
    "note\n0000  01 03 00 C8 00 03 84 35",
    "| 0000 | 01 03 00 C8 |\n| 0004 | 00 03 84 35 |",
    "0000 | 01 03 00 C8 00 03 84 35 | .......5 |",
    "# 0000: 01 03 00 C8 00 03 84 35",
    "; 0000: 01 03 00 C8 00 03 84 35",
    "0x01, 0x03, 0x00, 0xC8,\n0x00, 0x03, 0x84, 0x35",
    "byte[] data = {\n  0x01, 0x03, // unit, function\n  0x00, 0xC8, # address\n  0x00, 0x03, -- count\n  0x84, 0x35\n};",
    "1, 3, 0, 200,\n0, 3, 132, 53",
    "01, 03,\n00, C8,\nend 00, 03",
    "01, 03,\n\n00, C8",
    "tx:\n01, 03,\n00, C8,\n00, 03",
    "09:30:05 01, 03,\n00, C8",
    "0x01, 0x03, 1, 2,\n0x00, 300,\n0xC8",
    "TX:\n01 03 00 C8 00 03 84 35",
    "TX (8):\n01 03 00 C8 00 03 84 35",
    "Request:\n01 03 00 C8 00 03 84 35\nResponse:\n01 03 06 00 80 42 A4 F1 DE B0 F8",
    "09:30:05 COM3 written\n01 03 00 C8 00 03 84 35",
    "09:30:05 nothing\n01 03 00 C8 00 03 84 35",
    "09:30:05 nothing\n0000  01 03 00 C8 00 03 84 35",
    "09:30:05 nothing\n09:30:06 nothing\n01 03 00 C8 00 03 84 35",
    "a long sentence that says that it was sent by the tx\n01 03 00 C8 00 03 84 35",
    "a long sentence that says that it was sent by the tx:\n01 03 00 C8 00 03 84 35",
    "TX:\nnothing here\n01 03 00 C8 00 03 84 35",
    "TX:\n\n01 03 00 C8 00 03 84 35",
    "TX:\nx 01 03 00 C8 00 03 84 35",
    "RX:\n01 03 06 00 80 42 A4 F1\nDE B0 F8",
    "RX:\n01 03 06 00 80 42 A4 F1 DE\nB0 F8",
    "RX:\n00 01 02 03 04 05 06 07 08 09 0A 0B 0C 0D 0E 0F\n10 11 12 13",
    "RX:\nnote: 00 01 02 03 04 05 06 07\n08 09",
    "discarded:\n01 03 00 C8 00 03",
    "a 01\nb 03\nc 00\nd C8\ne 00\nf 03\ng 84\nh 35",
    "unit 01\nfunction 03\naddress 00 C8\ncount 00 03\ncrc 84 35",
    "| 0 | 01 |\n| 1 | 03 |\n| 2 | 00 C8 |\n| 3 | 00 03 |\n| 4 | 84 35 |",
    "1 01\n2 03\n3 00",
    "01\n03\n00\nC8\n00\n03\n84\n35",
    "1\n3\n0\n200\n0\n3\n132\n53",
    "x 1 2 3 4 5 6 7 8 9\nx 01\nx 03\nx 00\nx C8\nx 00\nx 03",
    "> 01 03 00 C8\n> 00 03 84 35\n> 01 03",
    ">> 01 03 00 C8 00 03 84 35\n>> 01 03 00 C8 00 03 84 35\n>> 01 03 00 C8 00 03 84 35",
    "8 01 03 00 C8 00 03 84 35\n11 01 03 06 00 80 42 A4 F1 DE B0 F8",
    "8 01 03 00 C8 00 03 84 35\n8 01 03 00 C8 00 03 84 35",
    "9 01 03 00 C8 00 03 84 35\n11 01 03 06 00 80 42 A4 F1 DE B0 F8",
    "10:00:00 TX 01 03 00 C8 00 03 84 35\r\n10:00:01 RX 01 03 06 00 80 42 A4 F1 DE B0 F8\r\r\n\n",
    "line one\rline 01 03 00 C8 00 03\rlast",
    "0000: 01 03 00 C8\n    0004: 00 03 84 35",
    "0000: 01 03 00 C8\n    0000: 00 03 84 35",
    "0000: 01 03 00 C8\n    0008: 00 03 84 35",
    "0000: 01 03 00 C8\n0005: 00 03 84 35",
    "0000: 01 03 00 C8\n0004",
    "0000: 01 03 00 C8\n4",
    "0000: 01 03 00 C8\n0005",
    "0001: 01 03 00 C8",
    "0008  01 03 00 C8",
    "x 0008: 01 03 00 C8",
    "x 0008  01 03 00 C8",
    "A 0000: 01\nB 0000: 02\nC 0000: 03\nA 0001: 04\nB 0001: 05\nC 0001: 06",
    "1, 3, 0, 20,\n0x00, 0x03, 0x84, 0x35",
    "1, 3, 0, 20,\n0, 3, 13, 53",
    "1, 3, 0, 20,\n0, 3, 300,\n13, 53",
    "0x01, 0x03,\n0, 20,\n0x05",
    "1, 3, 0, 20,\nend, 0, 3",
    "1, 3, 0, 20, and\n0, 3",
    "x 1, 3, 0, 20,\n0, 3",
    "x 0x01, 0x03,\n0x00, 0xC8",
    "1, 3, //, 4,\n5, 6",
    "1, 3 # 4,\n5, 6",
    "1, 3, --x\n5, 6",
    "http://x 1, 3,\n5, 6",
    "RX:\n01 03 06 00 80 42 A4 F1\n01 03 06 00 80 42 A4 F1\nDE B0 F8",
    "RX:\n01 03 06 00 80 42 A4\nF1 DE B0 F8",
    "RX:\n00 01 02 03 04 05 06 07 08 09 0A 0B 0C 0D 0E 0F 10 11 12 13\n14 15 16 17",
    "01 03 06 00 80 42 A4 F1\nDE B0 F8",
    "RX 11:\n01 03 06 00 80 42 A4 F1 DE B0 F8",
    "RX 12:\n01 03 06 00 80 42 A4 F1 DE B0 F8",
    "RX 05 11:\n01 03 06 00 80 42 A4 F1 DE B0 F8",
    "RX 05 x 11:\n01 03 06 00 80 42 A4 F1 DE B0 F8",
    "RX A5,11:\n01 03 06 00 80 42 A4 F1 DE B0 F8",
    "RX 11 bytes, 3:\n01 03 06",
    "RX\nTX\n01 03 00 C8",
    "junk:\ntx 01 03 00 C8",
    "10:00:00 RX\n10:00:01\n01 03 00 C8",
    "10:00:00 x\n\n01 03 00 C8",
    "COM1 tx\nCOM2 01 03 00 C8",
    "COM1 tx\n01 03 00 C8",
    "one two three four five six tx\n01 03 00 C8",
    "one two three four five tx\n01 03 00 C8",
    "01 x\n03 x\n00 x",
    "x 01\n\nx 03\nx 00\nx C8",
    "x 01 02\nx 03\nx 00 04 05\nx C8\nx 00 07",
    "| a | 01 |\n| b | 03 |\n|\n| c | 00 |\n| d | C8 |\n| e |",
    "| 01 03 00 C8 | x | 02 |\n| 01 03 00 C9 | y | 03 |\n| 01 03 00 CA | z | 04 |\n| 01 03 00 CB | z | 05 |",
    "x 01\nx 03\nx 00\n01 03 00 C8 00 03\nx C8\nx 00",
    "a 1\nb 2\nc 3\nd 4\ne 05 06 07 08",
    "time 10:00:00 a 01\ntime 10:00:01 a 03\ntime 10:00:02 a 00\ntime 10:00:03 a C8",
    "tx:\nx 01\nx 03\nx 00\nx C8",
    "ADR 01H CMD 03H\nADR 00H C8H and 00H 03H, 84H 35H end",
    "ADR 01H, CMD 03H, 00H",
    "ADR 01H 03H 00H C8H 00H",
];

/// What of the text layer comes out of a text.
fn pieces(table: &mut String, text: &str, form: &Form) {
    writeln!(table, "{}", text.escape_debug()).unwrap();
    let mut shapes: Vec<u32> = Vec::new();
    let mut tell = |event: Event<'_>| match event {
        Event::Piece(piece) => {
            let known = shapes.iter().position(|shape| *shape == piece.facts.shape);
            let shape = known.unwrap_or_else(|| {
                shapes.push(piece.facts.shape);
                shapes.len() - 1
            });
            writeln!(table, "    {}", shown(&piece, shape)).unwrap();
        }
        Event::Unread { line, offset } => writeln!(table, "    unread {line} at {offset}").unwrap(),
    };
    let mut reader = Reader::new(form.clone());
    reader.push(text.as_bytes(), &mut tell);
    reader.finish(&mut tell);
}

/// All of a piece, without what is as it mostly is.
fn shown(piece: &Piece<'_>, shape: usize) -> String {
    let places: Vec<String> =
        piece.places.iter().map(|place| format!("{}+{}", place.from, place.len())).collect();
    let mut said = format!("{} at {}: {} ({})", piece.line, piece.offset, hex(piece.bytes), places.join(" "));
    if let Some(decimal) = piece.decimal {
        write!(said, ", decimal {decimal:?}").unwrap();
    }
    if !piece.breaks.is_empty() {
        write!(said, ", breaks {:?}", piece.breaks).unwrap();
    }
    if let Some(time) = piece.time {
        write!(said, ", time {time}").unwrap();
    }
    if let Some(sender) = piece.sender {
        write!(said, ", {}", by(sender)).unwrap();
    }
    if let Some(port) = piece.port {
        write!(said, ", port {}", String::from_utf8_lossy(port)).unwrap();
    }
    if piece.joins {
        said += ", joins";
    }
    let names = facts(&piece.facts);
    if !names.is_empty() {
        write!(said, ", {}", names.join(" ")).unwrap();
    }
    if shape > 0 {
        write!(said, ", shape {shape}").unwrap();
    }
    said
}

fn by(sender: Sender) -> &'static str {
    match sender {
        Sender::Says(Direction::Request) => "request",
        Sender::Says(Direction::Response) => "response",
        Sender::Logger => "sent",
        Sender::Other => "received",
    }
}

fn facts(facts: &Facts) -> Vec<&'static str> {
    let named = [
        (facts.colon, "colon"),
        (facts.dumped, "dumped"),
        (facts.column, "column"),
        (facts.bare, "bare"),
        (facts.said, "said"),
        (facts.labelled, "labelled"),
        (facts.wrapped, "wrapped"),
        (facts.listed, "listed"),
        (facts.marked, "marked"),
        (facts.counted, "counted"),
        (facts.of_telegrams, "of-telegrams"),
        (facts.of_leftovers, "of-leftovers"),
        (facts.abridged, "abridged"),
        (facts.slips, "slips"),
        (facts.rest, "rest"),
    ];
    named.into_iter().filter(|(fact, _)| *fact).map(|(_, name)| name).collect()
}

/// The pieces of small texts, with all that the text says of them.
#[test]
fn what_texts_have() {
    let mut table = String::new();
    for text in SPELLINGS.iter().chain(SURROUNDINGS).chain(BLOCKS) {
        pieces(&mut table, text, &Form::default());
    }
    for time in TIMES {
        pieces(&mut table, &format!("{time} 01 03 00 C8 00 03 84 35"), &Form::default());
    }
    assert_table("pieces", &table);
}

/// A text that is being typed or comes in pieces: how many bytes are found in it at each length.
#[test]
fn texts_that_grow() {
    let mut table = String::new();
    for text in SPELLINGS.iter().chain(SURROUNDINGS).chain(BLOCKS) {
        let mut found: Vec<(usize, usize)> = Vec::new();
        for length in (1..=text.len()).filter(|length| text.is_char_boundary(*length)) {
            let mut count = 0;
            let mut tell = |event: Event<'_>| {
                if let Event::Piece(piece) = event {
                    count += piece.bytes.len();
                }
            };
            let mut reader = Reader::new(Form::default());
            reader.push(&text.as_bytes()[..length], &mut tell);
            reader.finish(&mut tell);
            match found.last_mut() {
                Some((known, times)) if *known == count => *times += 1,
                _ => found.push((count, 1)),
            }
        }
        let found: Vec<String> = found.iter().map(|(count, times)| format!("{count}\u{d7}{times}")).collect();
        writeln!(table, "{}: {}", text.escape_debug(), found.join(" ")).unwrap();
    }
    assert_table("growing", &table);
}

/// What a person says of a text, or its beginning does.
#[test]
fn forms_of_texts() {
    let mut table = String::new();
    for numbers in [Numbers::Hex, Numbers::Decimal] {
        writeln!(table, "# {numbers:?}").unwrap();
        let form = Form { numbers: Some(numbers), ..Form::default() };
        for text in [
            "01 03 00 C8 00 03 84 35",
            "01 03 00 200 00 03 132 53",
            "1 3 0 20 0 3 13 53",
            "1, 3, 0, -56, 0, 3",
            "100 101 99 12",
            "{ 0x01, 3, 0, 20,\n0, 3, 13, 53 }",
            "010300C800038435",
            "a 01\nb 03\nc 00\nd 20\ne 00",
        ] {
            pieces(&mut table, text, &form);
        }
    }
    writeln!(table, "# counted").unwrap();
    for text in [
        "8 01 03 00 C8 00 03 84 35",
        "08 01 03 00 C8 00 03 84 35",
        "11 01 03 06 00 80 42 A4 F1 DE B0 F8",
        "9 01 03 00 C8 00 03 84 35",
        "4 01 03 00 C8",
        "3 01 03 00",
        "8, 1, 3, 0, 200, 0, 3, 132, 53",
        "tx 8 01 03 00 C8 00 03 84 35 rx 4 01 03 00 C8",
    ] {
        pieces(&mut table, text, &Form { counted: true, ..Form::default() });
    }
    writeln!(table, "# quoted").unwrap();
    for text in
        ["> 01 03 00 C8\n> > 00 03\n>\n> x\nno 01 03 00 C8", ">>> tx 01 03 00 C8", "> 0000: 01 03 00 C8"]
    {
        pieces(&mut table, text, &Form { quoted: true, ..Form::default() });
    }
    writeln!(table, "# one byte a line").unwrap();
    for unit in [1, 1000, 1_000_000] {
        let form = Form { flow: Some(text::Flow { unit }), ..Form::default() };
        for text in [
            "time,byte\n0.5,0x01\n1.25,03\n2.125 00\n3.0;C8",
            "12.5\t01\t.\n13.5\t0x03 x\n14\t00\n15.5x 03",
            "10:00:00.5 RX 01\n10:00:01 RX 03 04",
            "1.,01\n99999999999999.5,01\n0.1234567,01\n1.5",
        ] {
            pieces(&mut table, text, &form);
        }
    }
    writeln!(table, "# marked").unwrap();
    let line = "#7;09:30:05.5;A;5;01 03 00 C8;note 1";
    let place = |text: &str| {
        let from = line.find(text).unwrap();
        Place::of(line, Span::new(from, from + text.len()))
    };
    for (time, word) in
        [(Some("09:30"), Some(Direction::Request)), (None, Some(Direction::Response)), (None, None)]
    {
        let marks = Marks {
            time: time.map(place),
            direction: word.map(|direction| (place("A"), "A".to_owned(), direction)),
            bytes: place("01 03"),
        };
        let form = Form { marks: Some(marks), ..Form::default() };
        for text in [
            "#7;09:30:05.5;A;5;01 03 00 C8;note 1",
            "#8;09:30:06.5;B;55;05 03 00 C8;note 2\n#9;x;AB;1;05;",
            "nothing; here",
            "#9;09:30:06.5;B;55;",
            "a;b;c;d;0x01, 0x03,\n1;2;3;4;00 C8",
        ] {
            pieces(&mut table, text, &form);
        }
    }
    assert_table("forms_of_texts", &table);
}

/// What the beginning of a text tells of it.
#[test]
fn beginnings() {
    let mut table = String::new();
    let lines = |line: &dyn Fn(usize) -> String, count: usize| -> String {
        (0..count).map(|n| line(n) + "\n").collect()
    };
    let mut texts: Vec<String> = SPELLINGS.iter().chain(BLOCKS).map(|text| (*text).to_owned()).collect();
    for count in [3, 7, 8, 16, 17] {
        texts.push(lines(&|n| format!("TX 01 03 00 C8 00 {n:02X} 84 35"), count));
        texts.push(lines(&|n| format!("TX 1 3 0 200 0 {n} 132 53"), count));
        texts.push(lines(&|n| format!("{n}.5,0x{n:02X},"), count));
        texts.push(lines(&|n| format!("{:02} 01 03 00 C8 00{}", 5 + n, " 03".repeat(n)), count));
        texts.push(lines(&|n| format!("{} 1 3 0 200 0{}", 5 + n, " 3".repeat(n)), count));
        texts.push(lines(&|n| format!("{:02} 01 03 00 C8 00", 5 + n), count));
        texts.push(lines(&|_| "06 01 03 00 C8 00 03".to_owned(), count));
        texts.push(lines(&|n| format!("> 01 03 00 C8 {n:02X}"), count));
    }
    texts.push(format!("Time [ms],x\n{}", lines(&|n| format!("{n}.5,0x{n:02X}"), 20)));
    texts.push(format!("time_us\n{}\n01 03 00 C8", lines(&|n| format!("{n}.5,0x{n:02X}"), 20)));
    texts.push(format!("t (us)\n01 03\n01 03\n{}", lines(&|n| format!("{n}.5,0x{n:02X}"), 20)));
    texts.push(format!("t\n01 03\n01 03\n01 03\n{}", lines(&|n| format!("{n}.5,0x{n:02X}"), 20)));
    texts.push(format!(
        "t\n{}{}",
        lines(&|_| "01 03 00 C8 x 0x05".to_owned(), 3),
        lines(&|n| format!("{n}.5,0x{n:02X}"), 20)
    ));
    texts.push(format!(
        "t\n{}{}",
        lines(&|_| "01 03 00 C8 x 0x05".to_owned(), 2),
        lines(&|n| format!("{n}.5,0x{n:02X}"), 20)
    ));
    texts.push(format!(
        "t\n{}{}",
        lines(&|_| "x 1".to_owned(), 3),
        lines(&|n| format!("{n}.5,0x{n:02X}"), 20)
    ));
    for text in &texts {
        let known = text::recognise(text.as_bytes());
        let shown: String = text.escape_debug().to_string().chars().take(60).collect();
        writeln!(
            table,
            "{shown} ({}): {:?}, {:?}, {:?}, {} with bytes, {} telling, {} dumped, counted {}, quoted {}, {:?}",
            text.len(),
            known.layout.map(|layout| layout.name),
            known.numbers,
            known.style.map(text::Style::name),
            known.with_bytes,
            known.telling,
            known.dumped,
            text::counted(text.as_bytes(), known.numbers),
            text::quoted(text.as_bytes()),
            text::flow(text.as_bytes(), known.numbers),
        )
        .unwrap();
    }
    assert_table("beginnings", &table);
}

/// What is wrong with what a person types.
#[test]
fn slips() {
    let mut table = String::new();
    for text in [
        "01 03 00 C8 00 03 84 3",
        "01 03 00 C8 00 03 84 357",
        "01 03 00 c8 OO l3",
        "O",
        "l",
        "I 01",
        "0x",
        "0X 01",
        "01 0x 03",
        "01 zz 03",
        "01 z 03",
        "01 ? 03 !",
        "01 é 03",
        "010",
        "010 3",
        "01 0",
        "a",
        "ab c",
        "0103000",
        "01 03 00 C8 hello",
        "hello",
        "0103zz00",
        "123456789",
        "1234 56",
        "12 3x",
        "1x2x3x",
        "deadbeef",
        "01-03-0",
        "",
        " ",
        "?",
        "01 03 00 C8 00 03 84 35 q",
    ] {
        let mut places = Vec::new();
        let mut tell = |event: Event<'_>| {
            if let Event::Piece(piece) = event {
                places.extend(piece.places.iter().map(|place| place.shifted(piece.offset as usize)));
            }
        };
        let mut reader = Reader::new(Form::default());
        reader.push(text.as_bytes(), &mut tell);
        reader.finish(&mut tell);
        let remarks: Vec<String> = text::remarks(text, 0, &places)
            .iter()
            .map(|it| format!("{} at {}..{}: {}", it.code, it.span.from, it.span.to, it.message))
            .collect();
        let typed = if text::looks_typed(text) { "typed" } else { "not typed" };
        writeln!(table, "{text:?} = {}, {typed}: {}", hex(&text::bytes(text)), remarks.join("; ")).unwrap();
    }
    assert_table("slips", &table);
}

/// What bytes without a proof are most likely, with the bits that speak for it, and what each is worth as a proof.
#[test]
fn what_bytes_could_be() {
    let splitter = Splitter::new(&STANDARD);
    let mut table = String::new();
    let waits = [
        None,
        Some(Waiting { unit: 1, function: 3, length: Some(11) }),
        Some(Waiting { unit: 1, function: 3, length: None }),
        Some(Waiting { unit: 17, function: 66, length: None }),
    ];
    for text in [
        "",
        "01",
        "E5",
        "01 03",
        "01 83",
        "01 83 02",
        "01 83 07",
        "01 83 0C",
        "01 83 02 C0 F1",
        "01 83 02 C0 F2",
        "01 83 09 C0 F2",
        "01 03 00",
        "01 03 00 C8",
        "01 03 00 C8 00",
        "01 03 00 C8 00 03",
        "01 03 00 C8 00 03 84",
        "01 03 00 C8 00 03 85",
        "01 03 00 C8 00 03 84 35",
        "01 03 00 C8 00 03 84 36",
        "00 03 00 C8 00 03",
        "00 05 00 C8 FF 00",
        "00 64 00 C8 00 03",
        "00 06 00 C8 00 03",
        "20 03 00 C8 00 03 00 00",
        "21 03 00 C8 00 03 00 00",
        "F7 03 00 C8 00 03 00 00",
        "F8 03 00 C8 00 03 00 00",
        "01 03 00 C8 00 7D 00 00",
        "01 03 00 C8 00 7E 00 00",
        "01 03 FF FF 00 01 00 00",
        "01 03 FF FF 00 02 00 00",
        "01 03 00 C8 00 00 00 00",
        "01 01 00 C8 07 D0 00 00",
        "01 01 00 C8 07 D1 00 00",
        "01 02 00 C8 00 01",
        "01 04 00 C8 00 01",
        "01 05 00 C8 FF 00",
        "01 05 00 C8 00 00",
        "01 05 00 C8 FF 01",
        "01 05 00 C8 01 00",
        "01 06 00 C8 12 34",
        "01 07",
        "01 07 00",
        "01 08 00 00 12 34",
        "01 08 00 14 00 00",
        "01 08 00 15 00 00",
        "01 0F 00 13 00 0A 02 CD 01",
        "01 0F 00 13 00 0A 03 CD 01 00",
        "01 0F 00 13 00 0A",
        "01 0F 00 13 07 B0",
        "01 0F 00 13 07 B1",
        "01 0F 00 13 00 0A 02 CD",
        "01 10 00 C8 00 02 04 00 01 00 02",
        "01 10 00 C8 00 02 04 00 01 00 02 00 00",
        "01 10 00 C8 00 02 06 00 01 00 02 00 03",
        "01 10 00 C8 00 02 04 00 01",
        "01 10 00 C8 00 02 04 00 01 00 02 00",
        "01 10 00 C8 00 02 05 00 01",
        "01 10 00 C8 00 02",
        "01 10 00 C8 00 7B",
        "01 10 00 C8 00 7C",
        "01 65 20 00 00 01 04 00 00 00 01",
        "01 65 20 00 00 01 04 00 00 00",
        "01 65 20 00 00 01 05 00 00 00 01",
        "01 65 20 00 00 01 08 00 00 00 01 00 00 00 02",
        "01 65 20 00 00 02 08 00 00 00 01 00 00 00 02",
        "01 65 20 00 00 3E",
        "01 65 20 00 00 3F",
        "01 64 20 00 00 3E",
        "01 64 20 00 00 3F",
        "01 64 04 00 00 00 05",
        "01 64 04 00 00",
        "01 16 00 04 00 F2 00 25",
        "01 17 00 03 00 06 00 0E 00 03 06 00 FF 00 FF 00 FF",
        "01 2B 0E 01 00",
        "01 42 01 02 03",
        "11 42 01 02 03",
        "01 03 06 00 80 42 A4 F1 DE B0 F8",
        "01 03 06 00 80 42 A4 F1 DE",
        "01 03 06 00 80 42 A4 F1 DE B0",
        "01 03 06 00 80 42 A4 F1 DE B1",
        "01 03 06 00 80 42 A4 F1",
        "01 03 06 00 80",
        "01 03 06",
        "01 03 04 00 80 42 A4",
        "55 01 03 06 00 80 42",
        "55 01 03 06 00 80 42 A4 F1 DE",
        "55 01 03 06 00 80 42 A4 F1 DE B1",
        "55 AA 01 03 06 00",
        "55 AA 55 01 03 06 00",
        "01 03 05 00 80",
        "01 01 05 00 80",
        "01 02 05 00 80",
        "01 03 FA 00 80",
        "01 01 FA 00 80",
        "01 01 FB 00 80",
        "00 03 06 00 80",
        "00 10 00 C8 00 02 04 00 01",
        "01 06 00 C8 00 05 00 00",
        "03 06 00 C8 00 05 00 00",
        "01 03 FC 00 80",
        "01 17 06 00 80",
        "01 05 06 00 80",
        "03 00 C8 00 03",
        "03 06 00 80 42 A4 F1 DE",
        "10 00 C8 00 02",
        "83 02",
        "07",
        "01 03 00 C8 00 03 31",
        "01 03 00 C8 00 03 32",
        "00 01 00 00 00 06 01 03 00 C8 00 03",
        "00 01 00 00 00 07 01 03 00 C8 00 03",
        "00 01 00 00 00 0A 01 03 00 C8 00 03",
        "00 01 00 00 00 0B 01 03 00 C8 00 03",
        "00 01 00 00 00 02 01 03 00 C8 00 03",
        "00 01 00 00 00 01 01 03 00 C8 00 03",
        "00 00 00 00 00 07 01 03 00 C8 00 03",
        "00 01 00 00 01 06 01 03 00 C8 00 03",
        "00 01 00 00 02 06 01 03 00 C8 00 03",
        "00 01 00 00 00 06 01 03 00 C8",
        "00 01 00 00 00 06 01 42 00 C8",
        "00 01 00 00 00 06 01 03",
        "00 01 00 00 00 06 01",
        "00 01 00 01 00 06 01 03 00 C8 00 03",
        "68 05 05 68 81 82 5D 3B 3E D9 16",
        "68 05 05 68 81 82 5D 3B 3E DA 16",
        "68 05 06 68 81 82 5D 3B 3E D9 16",
        "68 05 05 68 81 82 5D 3B 3E",
        "68 05 05 68 81 82 5D 3B 3E D9",
        "68 05 05 68 81 82 5D 3B 16",
        "68 05 06 68 81 82 5D 3B 16",
        "68 05 05 69 81 82 5D 3B 3E",
        "68 05 05 68 81 82 5D 3B 3E D9 16 00",
        "68 05 05 68 81 82 9D 3B 3E",
        "68 05 06 68 81 82 5D 3B 3E",
        "10 01 02 49 4C 16",
        "10 01 02 49 4D 16",
        "10 01 02 49 4D 17",
        "10 01 02 49",
        "DC 01 02",
    ] {
        let bytes = bytes(text);
        for (index, waiting) in waits.into_iter().enumerate() {
            let reading = evidence::reading(&bytes, &splitter, waiting);
            if index > 0 && reading.is_none_or(|it| !it.awaited) {
                continue;
            }
            let shown = reading.map_or("nothing".to_owned(), |it| {
                let cut = if it.cut { ", cut" } else { "" };
                let awaited = if it.awaited { ", awaited" } else { "" };
                format!("{} {:?} from {}: {}{cut}{awaited}", it.protocol.key, it.verdict, it.from, it.bits)
            });
            let before = match waiting {
                Some(it) => format!(" behind {} {} {:?}", it.unit, it.function, it.length),
                None => String::new(),
            };
            writeln!(table, "{text}{before} | {shown}").unwrap();
        }
        let proofs: Vec<String> = ["modbus-rtu", "modbus-tcp", "profibus-fdl", "modbus-ascii"]
            .map(|key| evidence::proof(Protocol::of(key).unwrap(), &bytes, &splitter).to_string())
            .into();
        let ascii = evidence::ascii(&bytes, &splitter).map(|it| it.bits);
        writeln!(table, "{text} | proofs {}, ascii {ascii:?}", proofs.join(" ")).unwrap();
    }
    let facts = |change: fn(&mut Facts)| {
        let mut facts = Facts::default();
        change(&mut facts);
        evidence::place(&facts)
    };
    let places = [
        ("bare", facts(|it| it.bare = true)),
        ("said", facts(|it| it.said = true)),
        ("labelled", facts(|it| it.labelled = true)),
        ("said and labelled", facts(|it| (it.said, it.labelled) = (true, true))),
        ("wrapped", facts(|it| it.wrapped = true)),
        ("marked", facts(|it| it.marked = true)),
        ("dumped", facts(|it| it.dumped = true)),
        ("of telegrams", facts(|it| it.of_telegrams = true)),
        ("counted", facts(|it| it.counted = true)),
        ("left over", facts(|it| it.of_leftovers = true)),
        ("listed", facts(|it| it.listed = true)),
    ];
    for (fact, bits) in places {
        writeln!(table, "{fact}: {bits}").unwrap();
    }
    for pieces in 0..6 {
        let company: Vec<String> = (0..=pieces)
            .flat_map(|proven| (0..=pieces - proven).map(move |alike| (proven, alike)))
            .map(|(proven, alike)| format!("{proven}+{alike}: {}", evidence::company(pieces, proven, alike)))
            .collect();
        writeln!(table, "of {pieces}, {}", company.join(", ")).unwrap();
    }
    assert_table("evidence", &table);
}

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
    "| 01 | 01 |\n| 03 | 03 |\n| 00 | 06 |\n| C8 | 00 |\n| 00 | 80 |\n| 03 | 42 |\n| z | A4 |\n| z | F1 |\n| z | DE |",
];

/// Puts the check of the bytes before it where `~~` stands.
fn checked(text: &str) -> String {
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
    for text in CONVERSATIONS.iter().chain(SPELLINGS).chain(SURROUNDINGS).chain(BLOCKS) {
        let text = checked(text);
        writeln!(table, "{}", text.escape_debug()).unwrap();
        found(&mut table, text.as_bytes());
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
        let mut said = format!(
            "{} at {}+{}: {} | {} {:?} {:?}",
            entry.line,
            entry.offset,
            entry.skip,
            hex(&log.bytes(&text, &entry)),
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

/// How much speaks for a telegram without a proof, seen from outside: among how many others that look a little
/// like telegrams it is still found. Each doubling of them asks for one bit more.
#[test]
fn how_much_speaks_for_it() {
    /// Read as a write to a unit that cannot be, of a value that cannot be.
    const OTHER: &str = "note FA 05 00 01 12 34 end\n";
    const MOST: u32 = 9;
    let mut table = String::new();
    let mut measure = |text: &str, wanted: &str| {
        let wanted = bytes(wanted);
        let is_found = |doubled: u32| {
            let text = OTHER.repeat((1 << doubled) - 1) + "\n" + text;
            let log = Log::read(text.as_bytes(), &Reading::default(), Options::default()).unwrap();
            log.entries()
                .iter()
                .any(|entry| entry.role != Role::Discarded && log.bytes(&text.as_bytes(), &entry) == wanted)
        };
        let all: Vec<u32> = (1..=MOST).collect();
        let bits = match all.partition_point(|doubled| is_found(*doubled)) as u32 {
            0 => "less than 13 bits".to_owned(),
            MOST => format!("{} bits or more", 12 + MOST),
            most => format!("{} bits", 12 + most),
        };
        writeln!(table, "{}: {bits}", text.escape_debug()).unwrap();
    };
    for place in [
        "so {} was",
        "{}",
        "TX: {}",
        "it: {}",
        "it [{}] was",
        "frame {} was",
        "discarded {} here",
        "0000  {}",
        "so {} was, {n} bytes",
    ] {
        for telegram in [
            "01 03 00 C8 00 03",
            "63 03 00 C8 00 03",
            "63 06 00 C8 00 03",
            "01 03 00 C8 00 03 84 36",
            "63 03 00 C8 00 03 84 36",
            "63 03 06 00 80 42 A4 F1 DE B0 F9",
            "01 03 06 00 80 42",
            "63 10 00 C8 00 02 04 00 01",
            "00 01 00 00 00 07 63 03 00 C8 00 03",
            "00 00 00 00 00 07 63 03 00 C8 00 03",
            "03 00 C8 00 03",
            "63 03 00 C8 00 03 CF",
            "63 83 02 C0 F2",
            "68 05 05 68 81 82 5D 3B 3E DA 16",
            "68 05 05 68 81 82 5D 3B 3E",
            "10 01 02 49 4D 16",
            "41 00 23 00 00 00 00 00",
        ] {
            let count = telegram.split(' ').count();
            measure(&place.replace("{}", telegram).replace("{n}", &count.to_string()), telegram);
        }
    }
    for (text, telegram) in [
        ("0x63, 0x03, 0x00, 0xC8, 0x00, 0x03", "63 03 00 C8 00 03"),
        (":630300C800031F", "63 03 00 C8 00 03 1F"),
        ("E5", "E5"),
        ("so 63 01 00 C8 00 03\nso 63 02 00 C8 00 03", "63 01 00 C8 00 03"),
        ("so 63 01 00 C8 00 03\nso 63 02 00 C8 00 03\nso 63 04 00 C8 00 03", "63 01 00 C8 00 03"),
        ("so 01 03 00 C8 00 03 84 35\nso 63 06 00 C8 00 03", "63 06 00 C8 00 03"),
        ("so 63 03 00 C8 00 03 8C 47\nas 63 03 00 C8 00 04", "63 03 00 C8 00 04"),
        ("so 63 03 00 C8 00 03\nas 63 03 06 00 80 42 A4 F1 DE", "63 03 06 00 80 42 A4 F1 DE"),
        ("so 63 03 00 C8 00 03 8C 47\nas 63 03 06 00 80 42 A4 F1 DE", "63 03 06 00 80 42 A4 F1 DE"),
        ("so 63 03 00 C8 00 03 8C 47\nas 63 03 06 00 80 42", "63 03 06 00 80 42"),
        ("so 63 03 00 C8 00 03 8C 47\nas 63 03 05 00 80 42 00 00", "63 03 05 00 80 42 00 00"),
        ("so 63 03 00 C8 00 03 8C 47\nas 63 83 02", "63 83 02"),
        ("so 68 05 05 68 81 82 5D 3B 3E D9 16\nas 63 06 00 C8 00 03 00 00", "63 06 00 C8 00 03 00 00"),
        ("so 68 05 05 68 81 82 5D 3B 3E D9 16\nTX: E5", "E5"),
        ("so 01 03 00 C8 00 03 84 35\nTX: E5", "E5"),
        ("so 00 01 00 00 00 06 01 03 00 C8 00 03\nas 63 06 00 C8 00 03", "63 06 00 C8 00 03"),
        ("so 63 06 00 C8 00 03 41 8A\nas 63 06 00 C8 00 03 41 8B", "63 06 00 C8 00 03 41 8B"),
        ("so 63 06 00 C8 00 03 41 8A\nTX: 63 06 00 C8 00 03 41 8B", "63 06 00 C8 00 03 41 8B"),
    ] {
        measure(text, telegram);
    }
    assert_table("weights", &table);
}

/// What may have happened to damaged telegrams, in the order in which the search finds it.
#[test]
fn causes_of_damage() {
    let request = bytes("01 03 00 C8 00 03 84 35");
    let other = bytes("05 06 00 01 00 02 58 4F");
    let mut table = String::new();
    for (protocol, text) in [
        ("modbus-rtu", "01 03 00 C8 00 03 35 84"),
        ("modbus-rtu", "01 03 00 C8 00 03 84 36"),
        ("modbus-rtu", "01 03 00 C8 00 03 12 34"),
        ("modbus-rtu", "01 03 00 C8 00 03"),
        ("modbus-rtu", "01 03 00 C8 00 02 84 35"),
        ("modbus-rtu", "01 03 00 8C 00 03 84 35"),
        ("modbus-rtu", "01 03 0C 80 00 03 84 35"),
        ("modbus-rtu", "01 03 C8 00 00 03 84 35"),
        ("modbus-rtu", "01 03 00 C8 00 7E 84 35"),
        ("modbus-rtu", "01 03 03 00 C8 00 03 84 35"),
        ("modbus-rtu", "01 03 00 C8 55 AA 00 03 84 35"),
        ("modbus-rtu", "01 03 C8 00 03 84 35"),
        ("modbus-rtu", "01 03 00 C8 00 03 84 35 11 22 33"),
        ("modbus-rtu", "33 22 01 03 00 C8 00 03 84 35"),
        ("modbus-rtu", "55 44 33 22 11 01 03 00 C8 00 03 84 35"),
        ("modbus-rtu", "01 03 00 C8 00 03 84 35 55 44 33 22 11 66 77 88"),
        ("modbus-rtu", "01 03 00 C8 00 03 84 35 FF"),
        ("modbus-rtu", "00 01 03 00 C8 00 03 84 35"),
        ("modbus-rtu", "03 01 C8 00 03 00 35 84"),
        ("modbus-rtu", "01 03 00 C8 00 03 84 35 01 03 06 00 80 42 A4 F1 DE B0 F8"),
        ("modbus-rtu", "01 03 06 00 80 42 A4 F1 DE 58 4F"),
        ("modbus-rtu", "01 03 06 80 00 A4 42 DE F1 B0 F8"),
        ("modbus-rtu", "01 03 06 00 80 42 A4"),
        ("modbus-rtu", "01 83 02 F1 C0"),
        ("modbus-rtu", "01 03 00 C8 00 03 2E 84"),
        ("modbus-rtu", "01 03 00 C8 00 03 84 2E"),
        ("modbus-rtu", "01 03 00 C8 00 03 14 47"),
        ("modbus-rtu", "01 03 00 C8 00 03 47 14"),
        ("modbus-rtu", "01 03 00 C8 00 03 FF A1"),
        ("modbus-rtu", "01 03 00 C8 00 03 A1 FF"),
        ("modbus-rtu", "01 03 0C 08 00 03 84 35"),
        ("modbus-rtu", "00 13 00 C8 00 03 84 35"),
        ("modbus-rtu", "10 03 00 C8 00 03 84 35"),
        ("modbus-rtu", "03 01 00 C8 00 03 84 35"),
        ("modbus-rtu", "01 03 00 C8 03 00 84 35"),
        ("modbus-rtu", "01 03 00 0C 00 03 84 35"),
        ("modbus-rtu", "01 03 00 80 00 38 43"),
        ("modbus-rtu", "01 03 00 C8 00 03 84 35 01 03 00 C8 00 03 84 35"),
        ("modbus-rtu", "01 03 06 00 80 42 A4 F1 DE B0"),
        ("modbus-rtu", "01 03 06 00 80 A4 F1 DE B0 F8"),
        ("modbus-rtu", "01 03 06 42 A4 F1 DE B0 F8"),
        ("modbus-rtu", "01 03 06 00 80 42 A4 F1 DE"),
        ("modbus-rtu", "01 03 06 00 80 42 A4 F1 DE BE EF 00"),
        ("modbus-rtu", "00 01 00 00 00 06 01 03 00 C8 00 03"),
        ("modbus-rtu", "01 03 00 C8 00 03 31"),
        ("modbus-rtu", "01 03 00 C8 00 03 31"),
        ("modbus-rtu", "01 03"),
        ("modbus-ascii", "01 03 00 C8 00 03 32"),
        ("modbus-ascii", "01 03 00 C8 00 03 01"),
        ("modbus-ascii", "01 03 00 C8 03 00 31"),
        ("modbus-ascii", "01 03 00 C8 00 31"),
        ("modbus-ascii", "01 03 00 C8 00 03 84 35"),
        ("profibus-fdl", "68 05 05 68 81 82 5D 3B 3E DA 16"),
        ("profibus-fdl", "68 05 06 68 81 82 5D 3B 3E D9 16"),
        ("profibus-fdl", "68 05 05 68 81 82 5D 3E 3B D9 16"),
        ("profibus-fdl", "10 01 02 49 4D 16"),
        ("profibus-fdl", "10 02 01 4A 4C 16"),
        ("modbus-tcp", "00 01 00 00 00 07 01 03 00 C8 00 03"),
    ] {
        let found = bytes(text);
        for digit_lost in [false, true] {
            let others: [&[u8]; 2] = [&other, &request];
            let context = Context { request: Some(&request), others: &others, digit_lost };
            for one in hypotheses(&found, Protocol::of(protocol).unwrap(), context) {
                // Most that a lost digit allows is found by chance.
                if digit_lost && !one.cause.key().contains("digit") {
                    continue;
                }
                let (gone, new) = one.difference(&found);
                let spans = |spans: &[Span]| {
                    let spans: Vec<String> =
                        spans.iter().map(|span| format!("{}..{}", span.from, span.to)).collect();
                    spans.join(" ")
                };
                writeln!(
                    table,
                    "{text} | {} | {} | {} bits, {}, {} for {}",
                    hex(&one.bytes),
                    one.text(&found),
                    one.bits(),
                    one.odds(),
                    spans(&gone),
                    spans(&new)
                )
                .unwrap();
            }
        }
    }
    assert_table("causes", &table);
}

/// Which protocols telegrams are of, together, and who speaks in them.
#[test]
fn protocols_and_speakers() {
    let mut table = String::new();
    for lines in [
        "01 03 00 C8 00 03 84 35",
        "01 03 00 C8 00 03 84 36",
        "03 00 C8 00 03",
        "02 03 00 C8 00 05 2E",
        "00 01 00 00 00 06 01 03 00 C8 00 03",
        "00 01 00 00 00 07 01 03 00 C8 00 03",
        "00 01 00 00 00 06 01 03 00 C8 00 03 / 00 02 00 00 00 06 FF 03 00",
        "00 01 00 00 00 06 01 03 00 C8 00 03 / 01 03 00 C8 00 03 84 35",
        "01 03 00 C8 00 03 84 36 / 03 00 C8 00 03",
        "41 00 23 00 00 00 00 00 / 71 00 23 00 00 00 00 05",
        "B7 A3 93 / 00 0C 00 02 05 EB",
        "68 05 05 68 81 82 5D 3B 3E D9 16 / E5",
        "E5",
        "FF",
        "FF / 03 00 C8 00 03",
    ] {
        let telegrams: Vec<Vec<u8>> = lines.split(" / ").map(bytes).collect();
        for bus in [None, Some(PROTOCOLS[0].bus()), Some(Protocol::of("profibus-fdl").unwrap().bus())] {
            let settings = buslens::frame::Settings { bus, ..Default::default() };
            let candidates: Vec<_> =
                telegrams.iter().map(|bytes| dialogue::Candidate { bytes, written_as: None }).collect();
            let choices: Vec<String> = dialogue::protocols(&candidates, &settings)
                .iter()
                .map(|choice| {
                    let others: Vec<String> = choice
                        .others
                        .iter()
                        .map(|(protocol, fit)| format!("{} {}", protocol.key, fit.bits))
                        .collect();
                    format!("{} ({}) [{}]", choice.protocol.key, choice.reason, others.join(", "))
                })
                .collect();
            writeln!(table, "{lines} | {bus:?} | {}", choices.join(" / ")).unwrap();
        }
    }
    for text in [
        "03 00 C8 00 03",
        "03 06 00 80 42 A4 F1 DE",
        "03 06 00 80 42 A4 F1",
        "03 06 00 80 42 A4",
        "03 05 00 80 42 A4",
        "03 05 00 80 42 A4 F1",
        "03 00",
        "03 00 C8",
        "03 00 C8 00 03 84",
        "10 00 C8 00 02 04 00 01 00",
        "10 00 C8 00 02 00",
        "10 00 C8 00",
        "01 00",
        "01 01 00 00",
        "06 00 C8",
        "83",
        "83 02",
        "42 01",
        "",
        "65 20 00 00 01 04 00 00 00",
        "64 08 00 00 00 00",
        "64 04 00 00 00",
        "18 00",
    ] {
        for awaited in [false, true] {
            let guess = dialogue::direction(&bytes(text), 3, awaited, &STANDARD);
            writeln!(
                table,
                "{text} | {awaited} | {:?} {:?}: {}",
                guess.direction, guess.certainty, guess.reason
            )
            .unwrap();
        }
    }
    for leanings in [
        &[][..],
        &[0],
        &[3],
        &[-3],
        &[10],
        &[9],
        &[11],
        &[-10],
        &[-3, 3],
        &[3, -3],
        &[-3, 0, 0],
        &[-3, -3],
        &[-3, -1, 2],
        &[-3, 1, 0, 10],
        &[1, 1, 1, -3],
        &[-2, 1, 1, 0],
    ] {
        let guesses: Vec<String> = dialogue::turns(leanings)
            .iter()
            .map(|it| format!("{:?} {:?} ({})", it.direction, it.certainty, it.reason))
            .collect();
        writeln!(table, "{leanings:?}: {}", guesses.join(", ")).unwrap();
    }
    assert_table("speakers", &table);
}

/// Bytes that may be text, and telegrams of others.
#[test]
fn encodings_and_others() {
    let mut table = String::new();
    for bytes in [
        &b"01 03"[..],
        b"",
        b"\xFF\xFE0\x001\x00",
        b"\xFE\xFF\x000\x001",
        b"0\x001\x00 \x00",
        b"\x000\x001\x00 ",
        b"0\x001\x00 ",
        b"\x000\x001\x00",
        b"0\x001",
        b"0\x00",
        b"\x010\x001\x002",
        b"0\x001\x01",
        b"\xE9\x000\x001\x00",
        b"a\x00\t\x00\r\x00\n\x00~\x00",
        b"\xFF\xFE\x3D\xD8\x00\xDE",
        b"\xFF\xFE\x3D\xD8A\x00",
        b"\xFF\xFEA\x00\x3D\xD8\x00\xDE",
        b"\xFE\xFF\x00A\xD8\x3D\xDE\x00",
        b"\xFF\xFEA\x00\x3D\xDC\x00\xDE",
        b"\xFE\xFF\xD8\x3D\xDE\x00\x00A\x00",
        b"\x01\x03\x00\xC8",
        b"text with \x1B[0m colours \x07 and \x0C",
        b"a text of more than fifty characters has one odd control\x00",
        b"a text of hardly fifty characters has one as we\x01",
        b"a text of hardly forty characters \x0E",
        b"a text of hardly forty characters \x1A",
        b"a text of hardly forty characters \x1F",
        b"a text of hardly forty characters \x7F",
        b"a text of hardly forty characters \x06",
    ] {
        let encoding = text::encoding(bytes);
        let whole: Vec<usize> =
            (0..=bytes.len().min(8)).map(|length| encoding.whole(&bytes[..length])).collect();
        let read = String::from_utf8_lossy(&encoding.text(bytes)).escape_debug().to_string();
        let further = String::from_utf8_lossy(&encoding.further(bytes)).escape_debug().to_string();
        writeln!(table, "{} | {encoding:?} | {read} | {further} | {whole:?}", bytes.escape_ascii()).unwrap();
    }
    for text in [
        "10 5B 0A 65 16",
        "10 5B 0A 66 16",
        "10 5B 0A 65 17",
        "68 0B 0B 68 08 03 72 21 43 65 87 24 40 01 07 39 16",
        "68 03 03 68 53 01 51 A5 16",
        "68 03 03 68 53 01 50 A4 16",
        "68 03 03 68 53 01 52 A6 16",
        "68 03 03 68 53 01 53 A7 16",
        "68 03 03 68 73 01 5A CE 16",
        "68 03 03 68 7B 01 70 EC 16",
        "68 03 03 68 5B 01 72 CE 16",
        "68 03 03 68 18 01 78 91 16",
        "68 03 03 68 28 01 7A A3 16",
        "68 03 03 68 38 01 B8 F1 16",
        "68 03 03 68 38 01 BF F8 16",
        "68 03 03 68 38 01 C0 F9 16",
        "68 03 03 68 39 01 B8 F2 16",
        "68 03 04 68 53 01 51 A5 16",
        "68 04 04 68 53 01 51 A5 16",
        "68 02 02 68 53 01 54 16",
        "FE FE 68 21 43 65 87 09 00 68 11 04 33 33 34 33 0B 16",
        "68 21 43 65 87 09 00 68 11 04 33 33 34 33 0B 16",
        "68 21 43 65 87 09 00 68 11 03 33 33 34 0B 16",
        "68 21 43 65 87 09 00 68 11 04 33 33 34 33 0C 16",
        "7E A0 07 03 21 93 0F 01 7E",
        "7E A0 08 03 21 93 0F 01 7E",
        "7E A8 07 03 21 93 0F 01 7E",
        "7E A0 07 03 21 93 0F 00 7E",
        "55 FF 00 07 03 00 00 EB",
        "55 FF 07 07 03 00 00 EB",
        "55 FF 08 07 03 00 00 EB",
        "55 FF 7F 07 03 00 00 EB",
        "55 FF 80 07 03 00 00 EB",
        "55 FF 00 07 03 00 00",
        "04 30 31 05",
        "04 30 31 47 05",
        "02 47 30 30 03 37",
        "02 47 30 03 37",
        "02 47 7F 30 03 37",
        "02 47 1F 30 03 37",
        "AA 55 01 00 00 0B 11 04 00 01 20",
        "AA 55 01 00 00 0B 11 04 00 01 21",
        "AA 55 00 FF",
        "AA 54 00 FE",
        "7E 32 30 30 31 34 0D",
        "7E 32 30 30 31 0D",
        "7E 32 30 30 31 47 0D",
        "01",
    ] {
        let bytes = bytes(text);
        let names: Vec<&str> =
            FOREIGN.iter().filter(|foreign| (foreign.fits)(&bytes)).map(|foreign| foreign.name).collect();
        writeln!(table, "{text} | {}", names.join(", ")).unwrap();
    }
    for text in [
        "\"No.\",\"Time\",\"Source\"",
        "\n\n\n\n\"No.\",\"Time\",\"Source\"",
        "\n\n\n\n\n\"No.\",\"Time\",\"Source\"",
        "  No.     Time",
        "x No.     Time",
        "#separator \\x09",
        "separator \\x0",
    ] {
        let named = text::export(text.as_bytes()).map(|export| export.name);
        writeln!(table, "{} | {named:?}", text.escape_debug()).unwrap();
    }
    for line in [
        "[RTU]>Tx > 09:30:05:081 - 01 03",
        "000017-Tx:01 03",
        "  000017-Rx:01 03",
        "x 000017-Tx:01 03",
        "[01][03][00]",
        "<01><03><00>",
        "[0g][03][00]",
        ":010300C8",
        ":010300C",
        "rx [02, 64, 00]",
        "00000000: 0103 00c8",
        "0x0000:  4500 0034",
        "0000000 001 003",
        "0000000 001403 144000",
        "0000   01 03",
        "0000  01 03",
        "modbus",
    ] {
        let known: Vec<&str> =
            text::LAYOUTS.iter().filter(|layout| layout.shows(line.as_bytes())).map(|it| it.key).collect();
        writeln!(table, "{line} | {}", known.join(", ")).unwrap();
    }
    assert_table("encodings", &table);
}

/// Texts that are longer than what is read at once: the pieces in short.
#[test]
fn long_texts() {
    let mut table = String::new();
    let rows = |count: usize, row: &str| format!("{row}\n").repeat(count);
    let bytes = |count: usize, parted: &str| vec!["5A"; count].join(parted);
    for (name, text) in [
        ("a line of 65,536 characters", "x".repeat(1 << 16)),
        ("65,537 characters and bytes", "x".repeat((1 << 16) + 1) + " 01 03 00 C8 00 03"),
        ("30,000 bytes in a line", bytes(30_000, " ")),
        ("30,000 bytes in a line with a time", format!("10:00:00 tx: {}", bytes(30_000, " "))),
        ("60,000 bytes without blanks", bytes(60_000, "")),
        ("30,000 bytes with colons, and a line", bytes(30_000, ":") + "\n01 03 00 C8\n"),
        ("a list of 4,096 bytes", rows(256, "1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16,")),
        ("a list of 4,112 bytes", rows(257, "1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16,")),
        ("a list of 8,300 bytes", rows(519, "1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16,")),
        ("600 lines of a column", rows(600, "x 5A")),
        ("601 lines of a column", rows(601, "x 5A")),
        ("605 lines of a column", rows(605, "x 5A")),
        ("8 numbers in a row", rows(5, "a 1 b 2 c 3 d 4 e 5 f 6 g 7 h 8")),
        ("9 numbers in a row", rows(5, "q 1 r 2 s 3 t 4 u 5 v 6 w 7 x 8 y 9")),
        (
            "70 numbers in a line, the last tells the length",
            format!("{} 8: 01 03 00 C8 00 03 84 35", "x 9 ".repeat(70)),
        ),
        ("a number far away tells the length", format!("8 {}: 01 03 00 C8 00 03 84 35", "x 9 ".repeat(40))),
        (
            "a number not so far away tells the length",
            format!("8 {}: 01 03 00 C8 00 03 84 35", "x 9 ".repeat(20)),
        ),
        (
            "many breaks",
            (0..14)
                .map(|n| format!("5A{}5B 5C 5D", [",", ";", "|", "/"][n % 4]))
                .collect::<Vec<_>>()
                .join(" "),
        ),
        ("far behind an ellipsis", format!("01 03 00 C8 00 03 {} …", "z".repeat(35))),
        ("too far behind for an ellipsis", format!("01 03 00 C8 00 03 {} …", "z".repeat(45))),
        ("between bytes too much", format!("01 03{}00 C8 00 03", " ".repeat(24))),
        ("between bytes more than too much", format!("01 03{}00 C8 00 03", " ".repeat(25))),
    ] {
        let mut told: Vec<String> = Vec::new();
        let mut tell = |event: Event<'_>| match event {
            Event::Piece(piece) => told.push(
                format!(
                    "{} at {}: {} bytes{}{}{}{}",
                    piece.line,
                    piece.offset,
                    piece.bytes.len(),
                    if piece.joins { ", joins" } else { "" },
                    if piece.time.is_some() { ", with time" } else { "" },
                    if piece.sender.is_some() { ", said" } else { "" },
                    if piece.breaks.is_empty() {
                        String::new()
                    } else {
                        format!(", breaks {:?}", piece.breaks)
                    }
                ) + &facts(&piece.facts).iter().map(|fact| format!(" {fact}")).collect::<String>(),
            ),
            Event::Unread { line, offset } => told.push(format!("unread {line} at {offset}")),
        };
        let mut reader = Reader::new(Form::default());
        for part in text.as_bytes().chunks(1000) {
            reader.push(part, &mut tell);
        }
        reader.finish(&mut tell);
        let lines = reader.lines();
        let count = told.len();
        told.truncate(8);
        writeln!(table, "{name}: {lines} lines, {count} pieces: {}", told.join("; ")).unwrap();
    }
    assert_table("long_texts", &table);
}
