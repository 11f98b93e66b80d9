//! Section `[signals]` of a map: taxels of each sample as a grid.

use std::fmt::Write;

use super::NAMED;
use crate::draft::tables::Taxels;
use taceva_dataset::internal::first_names;

/// Lines of `[signals]` for `taxels`. A comment names `others`, the alternative columns.
pub(super) fn signals(taxels: &Taxels, others: &[String]) -> String {
    let names = |count: usize| match count {
        1 => "[\"value\"]".to_owned(),
        count if count <= 3 => format!("{:?}", &["x", "y", "z"][..count]),
        count => {
            let names: Vec<String> = (0..count).map(|at| format!("v{at}")).collect();
            format!("{names:?}")
        }
    };
    let square = |places: usize| {
        let side = places.isqrt();
        match side > 1 && side * side == places {
            true => [side, side],
            false => [places, 1],
        }
    };
    let count = taxels.count();
    let (grid, channels, is_channel_first) = match taxels.shape[..] {
        [places, channels] if channels <= 6 => (square(places), channels, false),
        [channels, places] if channels <= 3 => (square(places), channels, true),
        [rows, columns] => ([rows, columns], 1, false),
        [rows, columns, channels] if channels <= 6 => ([rows, columns], channels, false),
        [channels, rows, columns] if channels <= 6 => ([rows, columns], channels, true),
        _ if count.is_multiple_of(3) => (square(count / 3), 3, false),
        _ => (square(count), 1, false),
    };
    let mut text = match others {
        [] => String::new(),
        others => format!("# or: from = {}\n", first_names(others, NAMED)),
    };
    if let Some(positions) = &taxels.by_position {
        let _ = writeln!(text, "# or, by position from 0: from = {positions}");
    }
    let unit = match taxels.unit {
        Some(unit) => format!("{unit:?}   # by its name"),
        None => "\"?\"".to_owned(),
    };
    let order = match is_channel_first {
        true => "\"channel-first\"   # a guess: x x … y y … z z …",
        false => "\"place-first\"   # a guess: x y z x y z …",
    };
    let _ = writeln!(
        text,
        "from = {}\nunit = {unit}\nplaces = {grid:?}   # a guess: rows and columns of the grid\nchannels = {}   # a guess\norder = {order}",
        taxels.from,
        names(channels),
    );
    if !taxels.placeholders.is_empty() {
        let codes: Vec<String> = taxels
            .placeholders
            .iter()
            .map(|(code, _)| code.to_string())
            .collect();
        let reasons = taxels
            .placeholders
            .iter()
            .map(|(_, reason)| reason.as_str());
        let reasons: Vec<&str> = reasons.collect();
        let _ = writeln!(
            text,
            "placeholders = [{}]   # a guess: codes of missing readings: {}",
            codes.join(", "),
            reasons.join("; ")
        );
    }
    text
}
