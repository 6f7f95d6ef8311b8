//! Times and lengths of time as lists and pictures show them.

use buslens::tool::log::time_text;

/// The time of day without its date, which the overview tells.
pub fn clock(time: i64) -> String {
    let text = time_text(time);
    match text.split_once(' ') {
        Some((_, clock)) if !clock.starts_with('(') => clock.to_owned(),
        _ => text,
    }
}

/// "31.4 ms", "2.1 s".
pub fn duration(micros: i64) -> String {
    let of = micros as f64;
    match micros.unsigned_abs() {
        0..10_000 => format!("{:.1} ms", of / 1e3),
        10_000..2_000_000 => format!("{:.0} ms", of / 1e3),
        2_000_000..100_000_000 => format!("{:.1} s", of / 1e6),
        _ => format!("{:.0} s", of / 1e6),
    }
}

/// Milliseconds since the telegram before: "+22".
pub fn delta(micros: i64) -> String {
    let millis = micros as f64 / 1e3;
    match micros.unsigned_abs() {
        0..10_000 => format!("{millis:+.1}"),
        _ => format!("{millis:+.0}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_of_time_are_short() {
        assert_eq!(duration(31_400), "31 ms");
        assert_eq!(duration(1_250), "1.2 ms");
        assert_eq!(duration(2_150_000), "2.1 s");
        assert_eq!(delta(22_000), "+22");
        assert_eq!(delta(-1_500), "-1.5");
    }

    #[test]
    fn a_clock_has_no_date() {
        assert_eq!(clock(36_000_000_000), "10:00:00");
    }
}
