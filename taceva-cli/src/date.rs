//! Date of a data sheet, of a seal or of added rows: from an argument, or today by the clock of the machine.

use std::time::{SystemTime, UNIX_EPOCH};

use taceva_core::Date;

/// Returns `text` if it is a valid date, such as 2026-11-22; otherwise `None`.
pub(crate) fn read(text: &str) -> Option<String> {
    let date: Date = text.parse().ok()?;
    Some(date.to_string())
}

/// Today's date, in UTC.
pub(crate) fn today() -> String {
    let since = SystemTime::now().duration_since(UNIX_EPOCH);
    Date::of_unix_s(since.map_or(0, |since| since.as_secs())).to_string()
}
