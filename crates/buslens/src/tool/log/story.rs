//! A log in sentences.

use super::{Dialog, Log};
use crate::field::{Message, grouped, in_order, many};
use crate::message;

impl Log {
    /// What there is to say about the log, the most important first.
    pub fn story(&self) -> Vec<Message> {
        let all = self.statistics();
        let mut story = Vec::new();
        let telegrams = many(all.telegrams, "telegram");
        let where_from = match self.lines() {
            0 => message!("{n} of {protocol}", n = telegrams, protocol = self.protocol().label.to_owned()),
            lines => message!(
                "{n} of {protocol} in {lines}",
                n = telegrams,
                protocol = self.protocol().label.to_owned(),
                lines = many(lines as usize, "line")
            ),
        };
        story.push(match all.times {
            Some((from, to)) if to > from => message!(
                "{what}, from {from} to {to}",
                what = where_from.to_string(),
                from = time_text(from),
                to = time_text(to)
            ),
            _ => where_from,
        });
        let units = self.units();
        let spoken = units.len();
        let units =
            in_order(units, |unit| std::cmp::Reverse(unit.unanswered + unit.check_failed + unit.exceptions));
        story.extend(units.iter().take(MOST_UNITS).map(|unit| self.of_unit(unit)));
        if spoken > MOST_UNITS {
            let more = spoken - MOST_UNITS;
            story.push(message!("{n} more in the table", n = many(more, "unit")));
        }
        story.extend(self.remarks());
        story
    }

    /// What there is to say besides the units.
    pub(super) fn remarks(&self) -> Vec<Message> {
        let all = self.statistics();
        let mut story = Vec::new();
        let mut say = |n: usize, message: &dyn Fn(String) -> Message, noun: &str| {
            if n > 0 {
                story.push(message(many(n, noun)));
            }
        };
        say(
            all.echoes,
            &|n| {
                message!(
                    "{n} came back to the sender over the same wires (RS-485): switch the echo off, or leave it out",
                    n = n
                )
            },
            "request",
        );
        say(
            all.copies,
            &|n| message!("{n} the log has twice; the copies are not counted", n = n),
            "telegram",
        );
        say(all.unasked, &|n| message!("{n} without a request", n = n), "response");
        say(all.late, &|n| message!("{n} came late, after other requests", n = n), "response");
        say(all.broadcasts, &|n| message!("{n} to all, which nobody answers", n = n), "request");
        say(all.bytes_discarded, &|n| message!("{n} between the telegrams belong to none", n = n), "byte");
        say(
            self.foreign().div_ceil(2),
            &|n| message!("{n} of the capture without telegrams, left out", n = n),
            "connection",
        );
        say(
            self.left_out(),
            &|n| message!("{n} of the capture left out: it has more than can be told apart", n = n),
            "connection",
        );
        say(self.unread().len(), &|n| message!("{n} left unread", n = n), "line");
        story
    }

    /// The numbers of each unit, all functions together.
    pub(super) fn units(&self) -> Vec<Dialog> {
        let mut units: Vec<Dialog> = Vec::new();
        for dialog in &self.statistics().dialogs {
            // Dialogs are in the order of their units.
            let same = |unit: &&mut Dialog| (unit.port, unit.unit) == (dialog.port, dialog.unit);
            match units.last_mut().filter(same) {
                Some(unit) => {
                    unit.telegrams += dialog.telegrams;
                    unit.requests += dialog.requests;
                    unit.answered += dialog.answered;
                    unit.unanswered += dialog.unanswered;
                    unit.retries += dialog.retries;
                    unit.exceptions += dialog.exceptions;
                    unit.check_failed += dialog.check_failed;
                    let fuller =
                        |silent: &super::Minutes| unit.silent.is_none_or(|known| known.count < silent.count);
                    unit.silent = dialog.silent.filter(fuller).or(unit.silent);
                }
                None => units.push(*dialog),
            }
        }
        units
    }

    /// "Unit 5 answered 812 of 1,004 requests; 190 unanswered, most between 14:02 and 14:09; 2 failed
    /// checks".
    fn of_unit(&self, unit: &Dialog) -> Message {
        let name = match (unit.unit, self.port_name(unit.port)) {
            (Some(number), Some(port)) => format!("Unit {number} on {port}"),
            (Some(number), None) => format!("Unit {number}"),
            (None, _) => "The server".to_owned(),
        };
        let mut parts = Vec::new();
        if unit.requests > 0 {
            let requests = many(unit.requests, "request");
            parts.push(match unit.answered {
                answered if answered == unit.requests && answered > 1 => format!("answered all {requests}"),
                0 if unit.requests > 1 => format!("answered none of {requests}"),
                answered => format!("answered {} of {requests}", grouped(answered)),
            });
        } else {
            parts.push(format!("appears in {}", many(unit.telegrams, "telegram")));
        }
        if unit.unanswered > 0 {
            parts.push(match unit.silent {
                Some(silent) => format!(
                    "{} unanswered, most between {} and {}",
                    grouped(unit.unanswered),
                    time_text(silent.from),
                    time_text(silent.to)
                ),
                None => format!("{} unanswered", grouped(unit.unanswered)),
            });
        }
        for (n, noun) in [(unit.exceptions, "exception"), (unit.check_failed, "wrong checksum")] {
            if n > 0 {
                parts.push(many(n, noun));
            }
        }
        if unit.retries > 0 {
            parts.push(if unit.retries == 1 {
                "1 retry".into()
            } else {
                format!("{} retries", grouped(unit.retries))
            });
        }
        message!("{unit} {what}", unit = name, what = parts.join("; "))
    }
}

/// More units are in the table.
const MOST_UNITS: usize = 5;

/// Microseconds as a time: with its date if it is one since 1970.
pub fn time_text(micros: i64) -> String {
    const SECOND: i64 = 1_000_000;
    const DAY: i64 = 86_400 * SECOND;
    /// Times of a day that goes on behind midnight are not yet dates.
    const DATED: i64 = 1000 * DAY;
    let (days, of_day) = (micros.div_euclid(DAY), micros.rem_euclid(DAY));
    let (seconds, fraction) = (of_day / SECOND, of_day % SECOND);
    let clock = format!("{:02}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
    let fraction = match fraction {
        0 => String::new(),
        micros if micros % 1000 == 0 => format!(".{:03}", micros / 1000),
        micros => format!(".{micros:06}"),
    };
    if micros.abs() < DATED {
        return match days {
            0 => format!("{clock}{fraction}"),
            days => format!("{clock}{fraction} (+{days} d)"),
        };
    }
    let (year, month, day) = date(days);
    format!("{year:04}-{month:02}-{day:02} {clock}{fraction}")
}

/// The day of the Gregorian calendar, so many days after 1970-01-01. Years are counted from March.
fn date(days: i64) -> (i64, i64, i64) {
    let days = days + 719_468;
    let era = days.div_euclid(146_097);
    let of_era = days.rem_euclid(146_097);
    let year_of_era = (of_era - of_era / 1460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let month = (5 * of_year + 2) / 153;
    let day = of_year - (153 * month + 2) / 5 + 1;
    let month = if month < 10 { month + 3 } else { month - 9 };
    (year_of_era + era * 400 + i64::from(month <= 2), month, day)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_written_as_people_do() {
        assert_eq!(time_text(34_205_081_000), "09:30:05.081");
        assert_eq!(time_text(34_205_000_000), "09:30:05");
        assert_eq!(time_text(1_772_443_805_091_000), "2026-03-02 09:30:05.091");
        assert_eq!(time_text(86_400_000_000), "00:00:00 (+1 d)");
    }
}
