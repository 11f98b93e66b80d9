//! Recognises columns of times that are written as text.

use super::Role;
use crate::instant::TextInstant;

/// Role of cells that are all dates or all times of day; `None` for other texts.
pub(super) fn of_texts(cells: &[&str]) -> Option<Role> {
    let instants: Option<Vec<TextInstant>> =
        cells.iter().map(|cell| TextInstant::parse(cell)).collect();
    let instants = instants.filter(|instants| !instants.is_empty())?;
    let of_day = instants
        .iter()
        .filter(|instant| instant.is_of_day())
        .count();
    match of_day {
        0 => Some(Role::Time {
            unit: "s",
            is_unix: true,
            guess: match instants.iter().any(TextInstant::has_zone) {
                true => None,
                false => Some("texts without a time zone: `zone = \"+00:00\"` states it"),
            },
        }),
        count if count == instants.len() => Some(Role::Time {
            unit: "s",
            is_unix: false,
            guess: Some("times of day, in seconds since midnight"),
        }),
        _ => None,
    }
}
