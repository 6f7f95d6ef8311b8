//! Logs with one byte in each line, mostly with its time: what logic analysers and line monitors export.

use super::line::{Numbers, Run, Scan, Start};

/// What a log with one byte in each line says of time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Flow {
    /// How many microseconds the unit of its times has, where they are plain numbers.
    pub unit: i64,
}

/// Whether nearly each line of a text has one byte.
pub fn flow(text: &[u8], numbers: Option<Numbers>) -> Option<Flow> {
    const ENOUGH: usize = 1 << 14;
    const LEAST: usize = 16;
    let text = &text[..text.len().min(ENOUGH)];
    let unit = unit(text.split(|c| matches!(c, b'\n' | b'\r')).next()?);
    let mut scan = Scan::timed(Some(unit));
    let (mut single, mut others) = (0, 0);
    for line in text.split(|c| matches!(c, b'\n' | b'\r')) {
        scan.read(line, Start::default(), numbers);
        match byte(&scan) {
            _ if scan.runs.iter().any(|run| run.len() > 2) => others += 1,
            Some(run) if run.len() == 1 && run.span.len() > 1 => single += 1,
            Some(_) => others += 1,
            None => {}
        }
    }
    (single >= LEAST && others * 10 <= single).then_some(Flow { unit })
}

/// The run that holds a line's byte: the last one, rather one that is marked as bytes.
pub(super) fn byte(scan: &Scan) -> Option<&Run> {
    scan.runs.iter().max_by_key(|run| run.marked)
}

/// What the heading says of the unit of times: seconds, if nothing.
fn unit(heading: &[u8]) -> i64 {
    let heading = heading.to_ascii_lowercase();
    let says = |unit: &str| {
        [format!("_{unit}"), format!("[{unit}]"), format!("({unit})")]
            .iter()
            .any(|sign| heading.windows(sign.len()).any(|part| part == sign.as_bytes()))
    };
    match () {
        () if says("us") || says("µs") => 1,
        () if says("ms") => 1000,
        () => 1_000_000,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_byte_a_line_is_told() {
        let lines = |line: &dyn Fn(usize) -> String| {
            (0..20).fold(String::from("time_us,byte\n"), |text, n| text + &line(n) + "\n")
        };
        let told = |text: String| flow(text.as_bytes(), None);
        assert_eq!(told(lines(&|n| format!("{n}179.5\t0{}", n % 10))), Some(Flow { unit: 1 }));
        assert_eq!(told(lines(&|n| format!("10:00:00.{n:03} RX 0{}", n % 10))), Some(Flow { unit: 1 }));
        let saleae = lines(&|n| format!("0.0311790{n:02},0x{n:02X},,")).replace("time_us", "Time [s]");
        assert_eq!(told(saleae), Some(Flow { unit: 1_000_000 }));
        assert_eq!(told(lines(&|_| "01 03 00 C8 00 03 84 35".into())), None);
        assert_eq!(told(lines(&|n| format!("request {n} was sent"))), None);
    }
}
