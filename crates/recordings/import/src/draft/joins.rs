//! Finds joined tables: by a shared column, by time, or row by row.

use std::collections::BTreeSet;

use super::roles::Role;
use super::tables::SeenTable;

/// Joined table with the lines of its `[[join]]`.
#[derive(Debug)]
pub(super) struct SeenJoin<'t, 'g> {
    pub(super) name: String,
    pub(super) table: &'t SeenTable<'g>,
    /// The table's value in a map.
    pub(super) written: String,
    pub(super) lines: Vec<String>,
}

/// Tables with channels that `main` lacks, each with its join.
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
        // A topic is named by itself, another table by its file.
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

/// Table with one row for each main table, such as a summary of a session.
fn beside(main: &SeenTable<'_>, other: &SeenTable<'_>) -> Option<(String, Vec<String>)> {
    let are_pairs = main.group.paths.len() > 1
        && other.group.paths.len() == main.group.paths.len()
        && other.group.parts.names == main.group.parts.names
        && other.rows == 1;
    are_pairs.then(|| {
        let written = format!("{:?}", other.group.parts.of_table());
        (
            written,
            vec!["on = \"all\"   # its only row belongs to every row".to_owned()],
        )
    })
}

/// Join by key: a column of both tables, unique in `other`, that shares some values with `main`.
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
        // ROS 1 messages count per publisher.
        let is_own = column.name.ends_with("header.seq");
        is_key
            && is_named
            && !is_own
            && known.len() == there.cells.len()
            && column.cells.iter().any(|cell| known.contains(cell))
    })?;
    Some(vec![
        format!("on = {{ {:?} = {:?} }}", key.name, key.name),
        "unmatched = \"drop\"   # rows without one are left out and counted".to_owned(),
    ])
}

/// Join by time: the times of both tables overlap.
fn by_time(main: &SeenTable<'_>, other: &SeenTable<'_>) -> Option<Vec<String>> {
    let (own_time, time) = (main.time()?, other.time()?);
    let (own, own_unit) = (own_time.column, own_time.unit);
    let (there, unit) = (time.column, time.unit);
    let seconds = |cells: &[String], unit: &str| -> Option<(f64, f64)> {
        let factor = match unit {
            "ns" => 1e-9,
            "us" => 1e-6,
            "ms" => 1e-3,
            _ => 1.0,
        };
        let first: f64 = cells.first()?.parse().ok()?;
        let last: f64 = cells.last()?.parse().ok()?;
        Some((first * factor, last * factor))
    };
    let is_rising = |cells: &[String]| {
        let times = cells.iter().filter_map(|cell| cell.parse::<f64>().ok());
        times.is_sorted()
    };
    if !is_rising(&there.cells) {
        return None;
    }
    let (begin, end) = seconds(&own.cells, own_unit)?;
    let (first, last) = seconds(&there.cells, unit)?;
    if first > end || last < begin {
        return None;
    }
    let spacing_ms = 1e3 * (last - first) / (there.cells.len().max(2) - 1) as f64;
    Some(vec![
        format!(
            "time = {{ column = {:?}, unit = {unit:?} }}{}",
            there.name,
            time.mark()
        ),
        "pick = \"nearest\"".to_owned(),
        format!(
            "tolerance_ms = {:.3}   # the time between two of its rows",
            spacing_ms.max(0.001)
        ),
        "lag_ms = 0   # how far its clock is ahead: the files do not state it".to_owned(),
        "unmatched = \"drop\"".to_owned(),
    ])
}

/// Join row by row: both tables have equally many rows and no other relation.
fn by_row(main: &SeenTable<'_>, other: &SeenTable<'_>) -> Option<Vec<String>> {
    // With several tables, each would begin with the first row of the other.
    let is_alike = main.rows == other.rows && main.channels() == 0 && main.group.paths.len() == 1;
    is_alike.then(|| vec!["on = \"row\"   # both have as many rows".to_owned()])
}
