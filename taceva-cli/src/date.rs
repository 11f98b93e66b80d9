//! The date of a data sheet: an argument, or today by the clock of the machine.

use std::time::{SystemTime, UNIX_EPOCH};

const DAY_S: u64 = 86_400;

/// `text` if it is a valid date, such as 2026-11-22.
pub(crate) fn read(text: &str) -> Option<String> {
    let digits = |range: std::ops::Range<usize>| -> Option<u32> {
        let digits = text.get(range)?;
        let is_digits = digits.bytes().all(|byte| byte.is_ascii_digit());
        is_digits.then(|| digits.parse().ok())?
    };
    let dashes = [text.get(4..5)?, text.get(7..8)?];
    let (year, month, day) = (digits(0..4)?, digits(5..7)?, digits(8..10)?);
    let is_day = (1..=12).contains(&month) && (1..=days_of(year, month)).contains(&day);
    (text.len() == 10 && dashes == ["-"; 2] && is_day).then(|| text.to_owned())
}

/// Today, in UTC.
pub(crate) fn today() -> String {
    let since = SystemTime::now().duration_since(UNIX_EPOCH);
    after_epoch(since.map_or(0, |since| since.as_secs() / DAY_S))
}

/// The date `days` after 1970-01-01.
fn after_epoch(mut days: u64) -> String {
    let (mut year, mut month) = (1970, 1);
    loop {
        let of_month = u64::from(days_of(year, month));
        if days < of_month {
            return format!("{year:04}-{month:02}-{:02}", days + 1);
        }
        days -= of_month;
        (year, month) = match month {
            12 => (year + 1, 1),
            _ => (year, month + 1),
        };
    }
}

/// The number of days of a month.
fn days_of(year: u32, month: u32) -> u32 {
    let is_leap = year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400));
    match month {
        2 if is_leap => 29,
        2 => 28,
        4 | 6 | 9 | 11 => 30,
        _ => 31,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_are_counted_over_leap_years_and_centuries() {
        let days = [0, 58, 59, 789, 11_016, 20_779].map(after_epoch);
        assert_eq!(
            days,
            [
                "1970-01-01",
                "1970-02-28",
                "1970-03-01",
                "1972-02-29",
                "2000-02-29",
                "2026-11-22"
            ]
        );
    }

    #[test]
    fn a_day_that_there_is_not_is_refused() {
        for wrong in [
            "2026-02-29",
            "2026-13-01",
            "2026-1-01",
            "22.11.2026",
            "2026-11-22x",
            "",
            "２026-11-2",
        ] {
            assert_eq!(read(wrong), None, "{wrong}");
        }
        assert_eq!(read("2024-02-29").as_deref(), Some("2024-02-29"));
    }
}
