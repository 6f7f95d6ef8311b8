//! Times in a line: of day, with a date, since 1970, since the start.

use super::characters::{digits, is_digit};

/// A time and where it ends in the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Found {
    /// Microseconds since 1970, since midnight or since the start, as far as the line says.
    pub micros: i64,
    pub to: usize,
}

const SECOND: i64 = 1_000_000;
const DAY: i64 = 86_400 * SECOND;

/// The time that begins at `at`, where a digit stands.
pub fn at(line: &[u8], at: usize) -> Option<Found> {
    if let Some((days, to)) = date(line, at) {
        // Between date and time: a blank, a T, a comma.
        let gap =
            line[to..].iter().take(3).take_while(|c| matches!(c, b' ' | b'T' | b't' | b',' | b'_')).count();
        return Some(match of_day(line, to + gap) {
            Some(time) => Found { micros: days * DAY + time.micros, to: zone(line, time.to) },
            None => Found { micros: days * DAY, to },
        });
    }
    of_day(line, at)
        .or_else(|| seconds(line, at))
        .or_else(|| milliseconds(line, at))
        .map(|time| Found { to: zone(line, time.to), ..time })
}

/// Days since 1970 of `2026-03-02`, `2026/03/02`, `02.03.2026`, `02/03/2026`.
fn date(line: &[u8], at: usize) -> Option<(i64, usize)> {
    let (a, to_a) = digits(line, at)?;
    let mark = *line.get(to_a).filter(|c| matches!(c, b'-' | b'/' | b'.'))?;
    let (b, to_b) = digits(line, to_a + 1)?;
    if line.get(to_b) != Some(&mark) {
        return None;
    }
    let (c, to) = digits(line, to_b + 1)?;
    let lengths = (to_a - at, to_b - to_a - 1, to - to_b - 1);
    let (year, month, day) = match lengths {
        (4, 1 | 2, 1 | 2) => (a, b, c),
        (1 | 2, 1 | 2, 4) if b <= 12 => (c, b, a),
        (1 | 2, 1 | 2, 4) => (c, a, b),
        _ => return None,
    };
    let right = (1900..2200).contains(&year) && (1..=12).contains(&month) && (1..=31).contains(&day);
    right.then(|| (days(year as i64, month as i64, day as i64), to))
}

/// Days from 1970-01-01 to a day of the Gregorian calendar. Years are counted from March, so that
/// the leap day is their last.
fn days(year: i64, month: i64, day: i64) -> i64 {
    let year = if month <= 2 { year - 1 } else { year };
    let day_of_year = (153 * ((month + 9) % 12) + 2) / 5 + day - 1;
    365 * year + year / 4 - year / 100 + year / 400 + day_of_year - 719_468
}

/// `9:30:05`, `09:30:05.123`, `09:30:05,123456`, `09:30:05:081`.
fn of_day(line: &[u8], at: usize) -> Option<Found> {
    let (hour, to) = digits(line, at)?;
    let (minute, to) = group(line, at, to)?;
    let (second, to) = group(line, to - 2, to)?;
    if hour > 23 || minute > 59 || second > 60 {
        return None;
    }
    let whole = (hour as i64 * 3600 + minute as i64 * 60 + second as i64) * SECOND;
    let fraction = match line.get(to) {
        Some(b'.' | b',') => fraction(line, to + 1),
        // With a colon, bytes could go on: 09:30:05:08:…
        Some(b':') => {
            let part = fraction(line, to + 1);
            match part {
                Some((_, end))
                    if line.get(end) != Some(&b':')
                        && !line.get(end).is_some_and(|c| c.is_ascii_alphanumeric()) =>
                {
                    part
                }
                _ if line.get(to + 1).is_some_and(u8::is_ascii_hexdigit) => return None,
                _ => None,
            }
        }
        _ => None,
    };
    let (micros, to) = fraction.unwrap_or((0, to));
    Some(Found { micros: whole + micros, to })
}

/// The two digits behind the colon at `to`; what comes before it has one or two.
fn group(line: &[u8], from: usize, to: usize) -> Option<(u64, usize)> {
    let short = (1..=2).contains(&(to - from));
    let (value, end) = (short && line.get(to) == Some(&b':')).then(|| digits(line, to + 1)).flatten()?;
    (end - to == 3).then_some((value, end))
}

/// Digits behind a decimal point, in microseconds.
fn fraction(line: &[u8], at: usize) -> Option<(i64, usize)> {
    let to = at + line.get(at..)?.iter().take_while(|c| is_digit(**c)).count();
    (to - at <= 9).then(|| (millionths(&line[at..to]), to))
}

/// The first six digits behind a decimal point.
fn millionths(digits: &[u8]) -> i64 {
    (0..6).fold(0, |sum, place| sum * 10 + digits.get(place).map_or(0, |c| i64::from(c - b'0')))
}

/// Seconds with a fraction of three digits or more: `1772443805.123`, `12.345678`.
fn seconds(line: &[u8], at: usize) -> Option<Found> {
    let (whole, to) = digits(line, at)?;
    let (micros, end) = (line.get(to) == Some(&b'.')).then(|| fraction(line, to + 1)).flatten()?;
    let plain = end - to > 3 && !matches!(line.get(end), Some(b'.' | b':' | b'-'));
    let found = || Found { micros: whole as i64 * SECOND + micros, to: end };
    (plain && whole < 100_000_000_000).then(found)
}

/// How many digits milliseconds since 1970 have in our days.
pub const MILLISECONDS: usize = 13;

/// `1772443805123` before something else, as programs count milliseconds since 1970: of the years 2001 to 2065.
fn milliseconds(line: &[u8], at: usize) -> Option<Found> {
    const YEARS: std::ops::Range<u64> = 1_000_000_000_000..3_000_000_000_000;
    let (value, to) =
        digits(line, at).filter(|(value, to)| to - at == MILLISECONDS && YEARS.contains(value))?;
    let mut behind = line[to..].iter();
    let parted = behind.next().is_some_and(|c| !c.is_ascii_alphanumeric());
    (parted && behind.any(u8::is_ascii_alphanumeric)).then_some(Found { micros: value as i64 * 1000, to })
}

/// A number with a fraction that a blank or another separator ends, of units of so many microseconds.
pub fn number(line: &[u8], at: usize, unit: i64) -> Option<Found> {
    let (whole, to) = digits(line, at)?;
    let count = line.get(to + 1..)?.iter().take_while(|c| is_digit(**c)).count();
    let end = to + 1 + count;
    let parted = matches!(line.get(end), Some(b' ' | b'\t' | b',' | b';'));
    if line[to] != b'.' || count == 0 || !parted {
        return None;
    }
    let millionths = millionths(&line[to + 1..end]);
    let micros =
        i64::try_from(whole).ok()?.checked_mul(unit)?.checked_add(millionths.checked_mul(unit)? / SECOND)?;
    Some(Found { micros, to: end })
}

/// Past `Z`, `+01:00`, `+0100`, which are the same for all lines of a log.
fn zone(line: &[u8], at: usize) -> usize {
    match line.get(at) {
        Some(b'Z' | b'z') if !line.get(at + 1).is_some_and(u8::is_ascii_alphanumeric) => at + 1,
        Some(b'+' | b'-') => match digits(line, at + 1) {
            Some((_, to)) if to == at + 5 => to,
            Some((_, to))
                if to == at + 3 && line.get(to) == Some(&b':') && digits(line, to + 1).is_some() =>
            {
                to + 3
            }
            _ => at,
        },
        _ => at,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Option<(i64, &str)> {
        at(text.as_bytes(), 0).map(|found| (found.micros, &text[found.to..]))
    }

    #[test]
    fn times_of_day() {
        const NINE: i64 = 34_205 * SECOND;
        assert_eq!(read("09:30:05 01 03"), Some((NINE, " 01 03")));
        assert_eq!(read("9:30:05.5 01"), Some((NINE + 500_000, " 01")));
        assert_eq!(read("09:30:05:081 - 11"), Some((NINE + 81_000, " - 11")));
        assert_eq!(read("09:30:05,123456] x"), Some((NINE + 123_456, "] x")));
        assert_eq!(read("09:30:05] x"), Some((NINE, "] x")));
    }

    #[test]
    fn bytes_with_colons_are_no_times() {
        for text in ["11:04:0C:90:00:05:31:E4", "11:04:05:10:20:30:31:E4", "25:00:00", "01:03", "01 03 04"] {
            assert_eq!(read(text), None, "{text}");
        }
    }

    #[test]
    fn dates_and_seconds() {
        let day = 20_514 * DAY;
        assert_eq!(read("2026-03-02T09:30:05Z TRACE"), Some((day + 34_205 * SECOND, " TRACE")));
        assert_eq!(read("2026-03-02 09:30:05.091 DEBUG"), Some((day + 34_205_091_000, " DEBUG")));
        assert_eq!(read("02/03/2026 09:30:05] W"), Some((day + 34_205 * SECOND, "] W")));
        assert_eq!(read("02.03.2026 x"), Some((day, " x")));
        assert_eq!(read("2026-03-02T09:30:05+01:00 x"), Some((day + 34_205 * SECOND, " x")));
        assert_eq!(read("1970-01-01 x"), Some((0, " x")));
        assert_eq!(read("12.345678] x"), Some((12_345_678, "] x")));
        assert_eq!(read("1772443805123 x"), Some((1_772_443_805_123_000, " x")));
        assert_eq!(read("1772443805123x"), None);
        assert_eq!(read("1103006000037"), None, "what is typed");
        assert_eq!(read("0103000A00C80003"), None);
        assert_eq!(read("192.168.0.10:502"), None);
        assert_eq!(read("50.0 ms"), None);
    }
}
