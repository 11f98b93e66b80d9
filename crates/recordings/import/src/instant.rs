//! Times as text: ISO 8601 dates and times, and times of day.

use taceva_core::Date;

/// Instant written as text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct TextInstant {
    /// Days since 1 January 1970; `None` for a time of day.
    day: Option<i64>,
    /// Whole seconds since midnight.
    second: i64,
    /// Digits of the fraction of the second.
    fraction: String,
    /// UTC offset, s, positive east of Greenwich; `None` if the text has no time zone.
    zone_s: Option<i64>,
}

const DAY_S: i64 = 86_400;

impl TextInstant {
    /// Parses the instant in `cell`, such as `2024-10-27 02:59:59.000`, `2024-10-27T02:59:59+01:00`, `20241027T025959Z`, `2024/10/27 02:59:59,5` or
    /// `03:21:28.429`.
    pub(crate) fn parse(cell: &str) -> Option<TextInstant> {
        let cell = cell.trim().trim_matches('"');
        let (day, time) = match cell.split_once(['T', 't', ' ']) {
            Some((date, time)) => (Some(day_of(date)?), time.trim_start()),
            None if cell.contains(':') => (None, cell),
            None => return None,
        };
        let (clock, zone_s) = zoned(time)?;
        let is_written_with_colons = clock.contains(':');
        let (clock, fraction) = match clock.split_once(['.', ',']) {
            Some((clock, fraction)) => (clock, fraction),
            None => (clock, ""),
        };
        let parts: Vec<&str> = match is_written_with_colons {
            true => clock.split(':').collect(),
            false if clock.len() == 6 => vec![&clock[..2], &clock[2..4], &clock[4..]],
            false => return None,
        };
        let is_day = |parts: &[&str]| parts.iter().all(|part| (1..=2).contains(&part.len()));
        if !(2..=3).contains(&parts.len()) || !is_day(&parts) || !is_of_digits(fraction) {
            return None;
        }
        // Minutes and seconds alone are ambiguous: `12:30` may be a ratio.
        if day.is_none() && (parts.len() < 3 || zone_s.is_some()) {
            return None;
        }
        let number = |at: usize| parts.get(at).map_or(Some(0), |part| digits(part));
        let [hour, minute, second] = [number(0)?, number(1)?, number(2)?];
        if hour > 24 || minute > 59 || second > 60 {
            return None;
        }
        Some(TextInstant {
            day,
            second: hour * 3_600 + minute * 60 + second,
            fraction: fraction.trim_end_matches('0').to_owned(),
            zone_s,
        })
    }

    /// True for a time of day without a date.
    pub(crate) fn is_of_day(&self) -> bool {
        self.day.is_none()
    }

    /// True if the text has a time zone.
    pub(crate) fn has_zone(&self) -> bool {
        self.zone_s.is_some()
    }

    /// Seconds since midnight, without fraction.
    pub(crate) fn second_of_day(&self) -> i64 {
        self.second
    }

    /// Seconds since 1970 as decimal text. For a time of day: seconds since midnight, plus `days` days. `zone_s` replaces a missing time zone.
    pub(crate) fn seconds(&self, zone_s: Option<i64>, days: i64) -> String {
        let zone_s = match self.day {
            Some(_) => self.zone_s.or(zone_s).unwrap_or_default(),
            None => 0,
        };
        let whole = self.day.unwrap_or(days) * DAY_S + self.second - zone_s;
        match (self.fraction.as_str(), whole < 0) {
            ("", _) => whole.to_string(),
            (fraction, false) => format!("{whole}.{fraction}"),
            // Before 1970 the fraction counts in the positive direction.
            (fraction, true) => {
                let places = fraction.len().min(18);
                let unit = 10_i64.pow(u32::try_from(places).unwrap_or_default());
                let part = unit - digits(&fraction[..places]).unwrap_or_default();
                format!("-{}.{part:0places$}", -(whole + 1))
            }
        }
    }
}

/// UTC offset of `zone` (`Z`, `+02:00`, `-0530`, `+01`), s.
pub(crate) fn zone_seconds(zone: &str) -> Option<i64> {
    if matches!(zone, "Z" | "z" | "UTC") {
        return Some(0);
    }
    let (sign, clock) = match zone.split_at_checked(1)? {
        ("+", clock) => (1, clock),
        ("-" | "−", clock) => (-1, clock),
        _ => return None,
    };
    let (hours, minutes) = match (clock.split_once(':'), clock.len()) {
        (Some(parts), _) => parts,
        (None, 4) => clock.split_at(2),
        (None, 2) => (clock, "0"),
        _ => return None,
    };
    let (hours, minutes) = (digits(hours)?, digits(minutes)?);
    (hours <= 14 && minutes < 60).then_some(sign * (hours * 3_600 + minutes * 60))
}

/// Splits a time into the time and its UTC offset.
fn zoned(time: &str) -> Option<(&str, Option<i64>)> {
    let time = time.trim_end();
    let at = time.find(['Z', 'z', '+', '-']).or_else(|| time.find("UTC"));
    match at {
        None => Some((time, None)),
        Some(at) => Some((time[..at].trim_end(), Some(zone_seconds(&time[at..])?))),
    }
}

/// Days from 1 January 1970 to a date, such as `2024-10-27`, `2024/10/27` or `20241027`.
fn day_of(date: &str) -> Option<i64> {
    let parts: Vec<&str> = match (date.contains('-'), date.contains('/'), date.len()) {
        (true, false, _) => date.split('-').collect(),
        (false, true, _) => date.split('/').collect(),
        (false, false, 8) => vec![date.get(..4)?, date.get(4..6)?, date.get(6..)?],
        _ => return None,
    };
    let [year, month, day] = parts.as_slice() else {
        return None;
    };
    // Dates with an ambiguous order of day and month are rejected.
    if year.len() != 4 || !(1..=2).contains(&month.len()) || !(1..=2).contains(&day.len()) {
        return None;
    }
    let number = |text: &str| digits(text).map(i64::cast_unsigned);
    Date::new(number(year)?, number(month)?, number(day)?).map(Date::days_since_1970)
}

fn is_of_digits(text: &str) -> bool {
    text.bytes().all(|byte| byte.is_ascii_digit())
}

fn digits(text: &str) -> Option<i64> {
    (is_of_digits(text) && !text.is_empty())
        .then(|| text.parse().ok())
        .flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_and_times_are_seconds_since_1970_as_the_calendar_counts() {
        // By Python: datetime(…, tzinfo=…).timestamp().
        for (cell, seconds) in [
            ("1970-01-01 00:00:00", "0"),
            ("2024-10-27 02:59:59.100", "1729997999.1"),
            ("2024-10-27T02:59:59+01:00", "1729994399"),
            ("2024-10-27T02:59:59.25Z", "1729997999.25"),
            ("20241027T025959Z", "1729997999"),
            ("2024/10/27 02:59:59,5", "1729997999.5"),
            ("2000-02-29 12:00", "951825600"),
            ("2024-02-29T00:00:00-0530", "1709184600"),
            ("1969-12-31 23:59:59.25", "-0.75"),
            ("1969-12-31 23:59:58.75", "-1.25"),
        ] {
            let instant = TextInstant::parse(cell).unwrap_or_else(|| panic!("{cell}"));
            assert_eq!(instant.seconds(None, 0), seconds, "{cell}");
        }
        let local = TextInstant::parse("2024-10-27 02:59:59").expect("a date");
        assert_eq!(local.seconds(Some(7_200), 0), "1729990799");
        assert!(!local.has_zone());
    }

    #[test]
    fn times_of_day_count_from_midnight_and_through_it() {
        let late = TextInstant::parse("23:59:59.9").expect("a time of day");
        assert!(late.is_of_day());
        assert_eq!(late.seconds(None, 0), "86399.9");
        let early = TextInstant::parse("00:00:00.1").expect("a time of day");
        assert_eq!(early.seconds(None, 1), "86400.1");
    }

    #[test]
    fn other_texts_are_no_instants() {
        for cell in [
            "",
            "1.5",
            "2024-10-27",
            "27.10.2024 02:59:59",
            "10-27-2024 01:00:00",
            "2023-02-29 00:00:00",
            "2024-13-01 00:00:00",
            "12:30",
            "ball 1",
            "25:00:00",
            "12:61:00",
            "2024-10-27 02:59:59+99:00",
            "a:b:c",
        ] {
            assert_eq!(TextInstant::parse(cell), None, "{cell}");
        }
    }
}
