//! Times and lengths of time as lists and pictures show them.

use buslens::field::decimal;
use buslens::tool::log::time_text;

/// The time of day without its date, which the overview tells.
pub fn clock(time: i64) -> String {
    let text = time_text(time);
    match text.split_once(' ') {
        Some((_, clock)) if !clock.starts_with('(') => clock.to_owned(),
        _ => text,
    }
}

/// Whether times between these need their date to be told apart.
pub fn is_over_days(times: Option<(i64, i64)>) -> bool {
    const DAY: i64 = 86_400_000_000;
    times.is_some_and(|(from, to)| from.div_euclid(DAY) != to.div_euclid(DAY))
}

/// The day without its year, and the time of day.
pub fn day_and_clock(time: i64) -> String {
    let text = time_text(time);
    match text.split_once('-') {
        Some((year, rest)) if year.len() == 4 => rest.to_owned(),
        _ => text,
    }
}

/// "2026-11-27 10:00:00 to 10:15:00".
pub fn stretch(from: i64, to: i64) -> String {
    let (first, last) = (time_text(from), time_text(to));
    match is_over_days(Some((from, to))) {
        true => format!("{first} to {last}"),
        false => format!("{first} to {}", clock(to)),
    }
}

/// "31.4 ms", "2.1 s".
pub fn duration(micros: i64) -> String {
    let of = micros as f64;
    match micros.unsigned_abs() {
        0..10_000 => decimal(of / 1e3, 1) + " ms",
        10_000..2_000_000 => decimal(of / 1e3, 0) + " ms",
        2_000_000..100_000_000 => decimal(of / 1e6, 1) + " s",
        _ => decimal(of / 1e6, 0) + " s",
    }
}

/// Milliseconds since the telegram before: "+22".
pub fn delta(micros: i64) -> String {
    let millis = micros as f64 / 1e3;
    let sign = if micros < 0 { "" } else { "+" };
    let places = if micros.unsigned_abs() < 10_000 { 1 } else { 0 };
    format!("{sign}{}", decimal(millis, places))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_of_time_are_short() {
        assert_eq!(duration(31_400), "31 ms");
        assert_eq!(duration(1_250), "1.3 ms");
        assert_eq!(duration(2_150_000), "2.2 s");
        assert_eq!(delta(22_000), "+22");
        assert_eq!(delta(-1_500), "-1.5");
    }

    #[test]
    fn a_clock_has_no_date() {
        assert_eq!(clock(36_000_000_000), "10:00:00");
        assert_eq!(clock(1_700_000_000_000_000), "22:13:20");
    }

    #[test]
    fn dates_stand_where_days_differ() {
        let (night, morning) = (1_700_000_000_000_000, 1_700_010_000_000_000);
        assert!(is_over_days(Some((night, morning))) && !is_over_days(Some((night, night))));
        assert_eq!(day_and_clock(night), "11-14 22:13:20");
        assert_eq!(stretch(night, night + 60_000_000), "2023-11-14 22:13:20 to 22:14:20");
        assert_eq!(stretch(night, morning), "2023-11-14 22:13:20 to 2023-11-15 01:00:00");
        assert_eq!(day_and_clock(90_000_000_000), "01:00:00 (+1 d)");
    }
}
