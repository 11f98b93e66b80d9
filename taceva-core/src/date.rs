//! A day of the calendar.

use std::fmt;
use std::str::FromStr;

/// A day of the Gregorian calendar, written `2026-05-12`. Dates are ordered by time.
///
/// This crate computes the calendar itself, because it has no required dependency.
///
/// ```
/// use taceva_core::Date;
/// let issued: Date = "2026-05-12".parse()?;
/// assert!(issued < Date::of_unix_s(1_800_000_000));
/// assert!("2026-02-29".parse::<Date>().is_err());
/// # Ok::<(), taceva_core::DateError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(into = "String", try_from = "String"))]
pub struct Date {
    year: u64,
    month: u64,
    day: u64,
}

impl Date {
    /// Day in UTC of a Unix time in seconds.
    pub fn of_unix_s(seconds: u64) -> Date {
        // In the calendar that repeats every 400 years, with years that begin in March.
        let days = seconds / 86_400 + 719_468;
        let (era, day) = (days / 146_097, days % 146_097);
        let year = (day - day / 1_460 + day / 36_524 - day / 146_096) / 365;
        let day = day - (365 * year + year / 4 - year / 100);
        let month = (5 * day + 2) / 153;
        let day = day - (153 * month + 2) / 5 + 1;
        let (month, next) = if month < 10 {
            (month + 3, 0)
        } else {
            (month - 9, 1)
        };
        Date {
            year: era * 400 + year + next,
            month,
            day,
        }
    }

    /// Date of `year`, `month` from 1 to 12, and `day` from 1; `None` if the day does not exist or the year is above 9999.
    ///
    /// ```
    /// use taceva_core::Date;
    /// assert_eq!(Date::new(2024, 2, 29).map(|day| day.days_since_1970()), Some(19_782));
    /// assert_eq!(Date::new(2023, 2, 29), None);
    /// ```
    pub fn new(year: u64, month: u64, day: u64) -> Option<Date> {
        let is_leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
        let length = match month {
            2 => 28 + u64::from(is_leap),
            4 | 6 | 9 | 11 => 30,
            1..=12 => 31,
            _ => return None,
        };
        let is_there = year <= 9_999 && (1..=length).contains(&day);
        is_there.then_some(Date { year, month, day })
    }

    /// Number of days since 1 January 1970, negative for an earlier date.
    pub fn days_since_1970(self) -> i64 {
        // Years that begin in March have the leap day at their end. 400 years more keep the numbers positive.
        let year = self.year + 400 - u64::from(self.month <= 2);
        let of_year = (153 * ((self.month + 9) % 12) + 2) / 5 + self.day - 1;
        let days = 365 * year + year / 4 - year / 100 + year / 400 + of_year;
        (-146_097_i64 - 719_468).wrapping_add_unsigned(days)
    }
}

impl fmt::Display for Date {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:04}-{:02}-{:02}", self.year, self.month, self.day)
    }
}

impl From<Date> for String {
    fn from(date: Date) -> String {
        date.to_string()
    }
}

impl TryFrom<String> for Date {
    type Error = DateError;

    fn try_from(text: String) -> Result<Date, DateError> {
        text.parse()
    }
}

impl FromStr for Date {
    type Err = DateError;

    fn from_str(text: &str) -> Result<Date, DateError> {
        let mut parts = text.split('-').map(|part| {
            let is_of_digits = part.bytes().all(|byte| byte.is_ascii_digit());
            part.parse::<u64>().ok().filter(|_| is_of_digits)
        });
        let mut next = || parts.next().flatten().ok_or(DateError);
        let (year, month, day) = (next()?, next()?, next()?);
        let date = Date::new(year, month, day);
        date.filter(|date| date.to_string() == text)
            .ok_or(DateError)
    }
}

/// Error for a text that is not a day of the calendar.
///
/// ```
/// use taceva_core::Date;
/// let error = "12.05.2026".parse::<Date>().unwrap_err();
/// assert_eq!(error.to_string(), "a day such as 2026-05-12");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DateError;

impl fmt::Display for DateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a day such as 2026-05-12")
    }
}

impl std::error::Error for DateError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_have_their_dates() {
        for (day, date) in [
            (0_u64, "1970-01-01"),
            (59, "1970-03-01"),
            (11_016, "2000-02-29"),
            (20_779, "2026-11-22"),
            (47_540, "2100-02-28"),
            (47_541, "2100-03-01"),
        ] {
            let found = Date::of_unix_s(day * 86_400);
            assert_eq!(found.to_string(), date);
            assert_eq!(found.days_since_1970(), day.cast_signed());
            assert_eq!(date.parse(), Ok(Date::of_unix_s(day * 86_400 + 86_399)));
        }
    }

    #[test]
    fn a_day_that_the_calendar_lacks_or_that_is_written_otherwise_is_refused() {
        for text in [
            "2026-02-29",
            "2026-13-01",
            "2026-00-10",
            "2026-05-00",
            "2026-5-12",
            "２026-11-2",
            "2026-05-12T10:00:00",
            "2026-05-12-01",
            "+026-05-12",
            "12.05.2026",
            "12026-05-12",
            "",
        ] {
            assert_eq!(text.parse::<Date>(), Err(DateError), "{text}");
        }
    }
}
