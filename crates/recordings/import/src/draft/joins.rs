//! Finds tables to join with the main table: by a shared column, by time, or row by row.

use std::collections::BTreeSet;

use super::roles::{Role, median_step};
use super::tables::{SeenTable, SeenTime};

/// Joined table with the lines of its `[[join]]` section.
#[derive(Debug)]
pub(super) struct SeenJoin<'t, 'g> {
    pub(super) name: String,
    pub(super) table: &'t SeenTable<'g>,
    /// Value of `table` in a map for this table.
    pub(super) written: String,
    pub(super) lines: Vec<String>,
}

impl SeenJoin<'_, '_> {
    /// True if cells of the joined table are interpolated. Only numbers can be interpolated.
    pub(super) fn is_interpolated(&self) -> bool {
        self.lines.iter().any(|line| line.starts_with(LINEAR))
    }
}

/// Beginning of the line `pick` of a join that interpolates.
const LINEAR: &str = "pick = \"linear\"";

/// Joins with the tables that have channels which `main` lacks.
pub(super) fn of<'t, 'g>(
    main: &SeenTable<'_>,
    tables: &'t [SeenTable<'g>],
) -> Vec<SeenJoin<'t, 'g>> {
    let mut joins: Vec<SeenJoin<'t, 'g>> = Vec::new();
    for table in tables.iter().filter(|table| table.written != main.written) {
        let is_alone =
            table.group.paths.len() == 1 && table.channels() > 0 && table.pictures.is_empty();
        let found = match is_alone {
            true => by_key(main, table)
                .or_else(|| by_time(main, table))
                .or_else(|| by_row(main, table)),
            false => None,
        };
        let beside = beside(main, table);
        let Some((written, lines)) = found.map(|lines| (table.written.clone(), lines)).or(beside)
        else {
            continue;
        };
        // A topic keeps its name; another table is named by its file.
        let stem = table
            .written
            .split("rows = \"")
            .nth(1)
            .map_or(table.group.stem(), |rows| {
                rows.trim_end_matches([' ', '}', '"'])
            });
        let stem: String = stem.chars().filter(char::is_ascii_alphanumeric).collect();
        let name = match stem.as_str() {
            "" | "path" | "row" | "file" | "key" => "other".to_owned(),
            stem => stem.to_owned(),
        };
        if joins.iter().all(|join| join.name != name) {
            joins.push(SeenJoin {
                name,
                table,
                written,
                lines,
            });
        }
    }
    joins
}

/// Join of a table that has one row for each file of the main table, such as a summary of a session: its path and its lines.
fn beside(main: &SeenTable<'_>, other: &SeenTable<'_>) -> Option<(String, Vec<String>)> {
    let are_pairs = main.group.paths.len() > 1
        && other.group.paths.len() == main.group.paths.len()
        && other.group.parts.names == main.group.parts.names
        && other.rows == 1;
    are_pairs.then(|| {
        let written = format!("{:?}", other.group.parts.of_table());
        (
            written,
            vec!["on = \"all\"   # the only row of this table belongs to every row".to_owned()],
        )
    })
}

/// Lines of a join by a key: a column of both tables that is unique in `other` and shares a value with `main`.
fn by_key(main: &SeenTable<'_>, other: &SeenTable<'_>) -> Option<Vec<String>> {
    let key = main.columns.iter().find(|column| {
        let Some(there) = other.columns.iter().find(|there| there.name == column.name) else {
            return false;
        };
        let known: BTreeSet<&String> = there.cells.iter().collect();
        let is_key = matches!(
            column.role,
            Role::Attribute | Role::Index | Role::Number | Role::Other
        );
        // An unnamed column is the pandas index, that is the row number.
        let is_named = column
            .name
            .starts_with(|letter: char| !letter.is_ascii_digit());
        // `header.seq` of ROS 1 counts messages per publisher, so it is not a key.
        let is_own = column.name.ends_with("header.seq");
        is_key
            && is_named
            && !is_own
            && known.len() == there.cells.len()
            && column.cells.iter().any(|cell| known.contains(cell))
    })?;
    Some(vec![
        format!("on = {{ {:?} = {:?} }}", key.name, key.name),
        "unmatched = \"drop\"   # rows without a match are left out and counted".to_owned(),
    ])
}

/// Lines of a join by time, if the times of both tables overlap.
fn by_time(main: &SeenTable<'_>, other: &SeenTable<'_>) -> Option<Vec<String>> {
    let (own_time, time) = (main.time()?, other.time()?);
    let (own, own_unit) = (own_time.column, own_time.unit);
    let (there, unit) = (time.column, time.unit);
    let is_rising = |cells: &[String]| {
        let times = cells.iter().filter_map(|cell| cell.parse::<f64>().ok());
        times.is_sorted()
    };
    if !is_rising(&there.cells) {
        return None;
    }
    let [begin, end] = span_s(&own_time)?;
    let [first, last] = span_s(&time)?;
    let is_apart = first > end || last < begin;
    let seen: [f64; 2] =
        [there.cells.first()?, there.cells.last()?].map(|cell| in_seconds(cell, unit));
    let spacing_ms = 1e3 * (seen[1] - seen[0]) / (there.cells.len().max(2) - 1) as f64;
    if is_apart || !spacing_ms.is_finite() {
        return None;
    }
    let rates = rate_hz(&own.cells, own_unit).zip(rate_hz(&there.cells, unit));
    let pick = match rates {
        Some((own, other)) => pick_by_rates(own, other),
        None => "pick = \"nearest\"".to_owned(),
    };
    let (tolerance_ms, tolerance) = match rates {
        // Both neighbours of an instant must lie within the tolerance, and steps vary.
        _ if pick.starts_with(LINEAR) => (
            2.0 * spacing_ms,
            "twice the time between two rows of this table",
        ),
        Some((own, _)) if spacing_ms > PRESSES_MS => (
            (SHARE_OF_STEP * spacing_ms).min(1e3 / own),
            "at most a tenth of the time between two rows of this table, so no other press matches",
        ),
        _ => (spacing_ms, "the time between two rows of this table"),
    };
    let mut lines = vec![
        format!(
            "time = {{ column = {:?}, unit = {unit:?} }}{}",
            there.name,
            time.mark()
        ),
        pick,
        format!(
            "tolerance_ms = {:.3}   # {tolerance}",
            tolerance_ms.max(0.001)
        ),
    ];
    if rates.is_some_and(|(own, other)| is_slower(own, other) && is_of_presses(other)) {
        lines.push(format!(
            "# or, if this table is a slow stream and not one row per press: {LINEAR} and tolerance_ms = {:.3}",
            2.0 * spacing_ms
        ));
    }
    lines.extend([
        "lag_ms = 0   # lead of this table's clock in ms: not stated by the files".to_owned(),
        "unmatched = \"drop\"".to_owned(),
    ]);
    Some(lines)
}

/// Minimum time step between rows that are single presses, ms. Rows of a stream are closer.
const PRESSES_MS: f64 = 1_000.0;

/// Maximum time difference between rows of the same press in two tables, as a fraction of the time step between presses.
const SHARE_OF_STEP: f64 = 0.1;

/// First and last time of a table, s; `None` if the times are not numbers.
pub(super) fn span_s(time: &SeenTime<'_>) -> Option<[f64; 2]> {
    let ends = [time.column.cells.first()?, &time.column.last];
    let ends = ends.map(|cell| in_seconds(cell, time.unit));
    ends.iter().all(|end| end.is_finite()).then_some(ends)
}

/// Time of a cell in seconds; NaN if the cell is not a number.
fn in_seconds(cell: &str, unit: &str) -> f64 {
    cell.parse::<f64>().unwrap_or(f64::NAN) / second_in(unit)
}

/// Number of units per second: 1000 for `ms`.
fn second_in(unit: &str) -> f64 {
    match unit {
        "ns" => 1e9,
        "us" => 1e6,
        "ms" => 1e3,
        _ => 1.0,
    }
}

/// Median rate of rows with the times `cells`, Hz; `None` if all times are equal or the unit is unknown.
fn rate_hz(cells: &[String], unit: &str) -> Option<f64> {
    if unit == "?" {
        return None;
    }
    let times: Vec<f64> = cells.iter().filter_map(|cell| cell.parse().ok()).collect();
    Some(second_in(unit) / median_step(&times)?)
}

/// Minimum rate of a joined table, as a fraction of the rate of the main table. Below it, main rows share a joined row.
const NEAR_RATE: f64 = 0.9;

/// True if the joined table, with the rate `other`, is so much slower than the main table, with the rate `own`, that main rows share a row. Rates in
/// Hz.
fn is_slower(own: f64, other: f64) -> bool {
    other < NEAR_RATE * own
}

/// True if the rate of rows, Hz, is so low that each row is taken for a single press.
fn is_of_presses(rate: f64) -> bool {
    1e3 / rate > PRESSES_MS
}

/// Line `pick` for the rate `own` of the main table and the rate `other` of the joined table, Hz.
fn pick_by_rates(own: f64, other: f64) -> String {
    let both = format!("{} against {} of the main table", in_hz(other), in_hz(own));
    match is_slower(own, other) {
        true if is_of_presses(other) => format!(
            "pick = \"nearest\"   # {both}: this table has one row per press, and only rows at a press are kept"
        ),
        true => format!(
            "{LINEAR}   # {both}: this table is slower, so numbers between two of its rows are interpolated"
        ),
        false => format!(
            "pick = \"nearest\"   # {both}: the nearest row of this table is at most {:.3} ms away",
            500.0 / other
        ),
    }
}

/// Writes a rate, Hz, with three digits: `33.3 Hz`.
fn in_hz(rate: f64) -> String {
    let scale = 10_f64.powf(2.0 - rate.log10().floor());
    format!("{} Hz", (rate * scale).round() / scale)
}

/// Line of a row-by-row join, for tables with the same number of rows and no other relation.
fn by_row(main: &SeenTable<'_>, other: &SeenTable<'_>) -> Option<Vec<String>> {
    // With several tables, each would begin with the first row of the other.
    let is_alike = main.rows == other.rows && main.channels() == 0 && main.group.paths.len() == 1;
    is_alike.then(|| vec!["on = \"row\"   # both have the same number of rows".to_owned()])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slower_table_is_interpolated_and_a_faster_one_gives_its_nearest_row() {
        let slow = pick_by_rates(29.97, 5.0);
        assert!(
            slow.starts_with("pick = \"linear\"   # 5 Hz against 30 Hz of the main table: "),
            "{slow}"
        );
        for rate in [29.0, 30.0, 200.0] {
            let near = pick_by_rates(30.0, rate);
            assert!(near.starts_with("pick = \"nearest\"   # "), "{near}");
        }
        assert!(pick_by_rates(30.0, 200.0).ends_with("is at most 2.500 ms away"));
        // Between two presses there is nothing to interpolate.
        let presses = pick_by_rates(16.0, 0.25);
        assert!(presses.starts_with("pick = \"nearest\"   # "), "{presses}");
        assert!(
            presses.ends_with("only rows at a press are kept"),
            "{presses}"
        );
    }

    #[test]
    fn the_rate_of_rows_is_that_of_their_median_step() {
        let cells = |times: &[&str]| -> Vec<String> {
            times.iter().map(|time| (*time).to_owned()).collect()
        };
        // One pause among four steps.
        let times = cells(&["0", "20", "40", "900", "920"]);
        assert_eq!(rate_hz(&times, "ms").map(in_hz).as_deref(), Some("50 Hz"));
        assert_eq!(rate_hz(&cells(&["5", "5"]), "s"), None);
        assert_eq!(in_hz(1234.5), "1230 Hz");
        assert_eq!(in_hz(100.0 / 3.0), "33.3 Hz");
    }
}
