//! Finds taxels in the columns of a table: cells of many numbers, or runs of numbered columns.

mod axes;

use super::{SeenColumn, SeenTable};
use crate::csv_table::number;
use crate::draft::roles::{Role, words};
use crate::taxel_codes::{TaxelCode, codes};
use crate::unit_suffix::UnitSuffix;

/// Minimum number of values per row that are taken for taxels.
const LEAST: usize = 8;
const MOST: usize = 4_096;
/// Minimum number of numbered columns that are taken for taxels.
const LEAST_RUN: usize = 8;

/// Taxels of a table, as values of the keys of `[signals]` in a map.
#[derive(Debug, PartialEq)]
pub(crate) struct Taxels {
    /// Value of `from`, as TOML.
    pub(crate) from: String,
    /// Value of `from` that lists adjacent columns by position; `None` for other columns.
    pub(crate) by_position: Option<String>,
    /// Shape of the lists in a cell, or the number of columns.
    pub(crate) shape: Vec<usize>,
    /// Unit stated by the name.
    pub(crate) unit: Option<&'static str>,
    /// Numbers that probably mean "not measured", each with the reason.
    pub(crate) placeholders: Vec<(f64, String)>,
    /// True if the name contains a word for taxels. Named taxels are preferred.
    pub(crate) is_named: bool,
}

/// Minimum number of consecutive columns `t0`, `t1`, `t2`, … for which `t` does not mean time.
const LEAST_SERIES: usize = 3;

/// Words in the names of taxel columns.
const WORDS: [&str; 14] = [
    "taxel",
    "taxels",
    "tactile",
    "skin",
    "pressure",
    "pressures",
    "cells",
    "sensel",
    "sensels",
    "forces",
    "shear",
    "pts",
    "tac",
    "array",
];

/// Shape of the lists in the cells of a column; `None` unless all non-empty cells have the same shape and enough numbers for taxels.
pub(super) fn taxels_of(role: &Role, cells: &[String]) -> Option<Vec<usize>> {
    let is_open = matches!(role, Role::Numbers(_) | Role::Other | Role::Channels(_));
    let first = cells.iter().find(|cell| !cell.is_empty())?;
    if !is_open || !first.contains(['[', ',', ' ', ';']) {
        return None;
    }
    let shape = shape_of(first)?;
    let count: usize = shape.iter().product();
    let is_many = (LEAST..=MOST).contains(&count) && shape.len() <= 3;
    let mut filled = cells.iter().filter(|cell| !cell.is_empty());
    (is_many && filled.all(|cell| shape_of(cell).as_ref() == Some(&shape))).then_some(shape)
}

/// Takes columns called `t0`, `t1`, … for numbers instead of times.
pub(super) fn open_numbered_times(columns: &mut [SeenColumn]) {
    for run in columns.chunk_by_mut(|one, next| follows(&one.name, &next.name)) {
        let words = words(&run[0].name);
        let is_series = run.len() >= LEAST_SERIES && words.last().is_some_and(|word| word == "t");
        for column in run.iter_mut().filter(|_| is_series) {
            if matches!(column.role, Role::Time { .. }) {
                column.role = Role::Number;
            }
        }
    }
}

/// Splits a name into the text before the number at its end, and that number.
fn counted(name: &str) -> Option<(&str, u32)> {
    let digits = name.bytes().rev().take_while(u8::is_ascii_digit);
    let (stem, number) = name.split_at(name.len() - digits.count());
    Some((stem, number.parse().ok()?))
}

/// True if the number in `next` follows the number in `name`.
fn follows(name: &str, next: &str) -> bool {
    let pair = counted(name).zip(counted(next));
    pair.is_some_and(|((stem, number), (next_stem, next_number))| {
        stem == next_stem && number.checked_add(1) == Some(next_number)
    })
}

/// Shape of the nested lists in a cell of numbers, the outermost list first.
fn shape_of(cell: &str) -> Option<Vec<usize>> {
    let separators = |letter: char| letter.is_whitespace() || "[](),;".contains(letter);
    let mut count = 0;
    for part in cell.split(separators).filter(|part| !part.is_empty()) {
        number::number(part).ok().flatten()?;
        count += 1;
    }
    let depth = cell
        .trim_start()
        .bytes()
        .take_while(|byte| matches!(byte, b'[' | b'(' | b' '))
        .filter(|byte| *byte != b' ')
        .count();
    // Each opening bracket at the second level begins a list.
    let mut opened = vec![0_usize; depth.max(1) + 1];
    let mut level = 0_usize;
    for byte in cell.bytes() {
        match byte {
            b'[' | b'(' => {
                level += 1;
                *opened.get_mut(level)? += 1;
            }
            b']' | b')' => level = level.checked_sub(1)?,
            _ => {}
        }
    }
    let mut shape = Vec::new();
    let mut lists = 1;
    for open in opened.iter().skip(2) {
        shape.push(open.checked_div(lists)?);
        lists = *open;
    }
    shape.push(usize::checked_div(count, lists)?);
    (shape.iter().product::<usize>() == count && level == 0).then_some(shape)
}

impl SeenTable<'_> {
    /// Taxels of a table that is a single array with many numbers per row.
    pub(crate) fn taxels(&self) -> Option<Taxels> {
        let [column] = self.columns.as_slice() else {
            return None;
        };
        let shape = column.taxels.clone()?;
        (self.is_single_array && self.pictures.is_empty()).then(|| of_column(column, shape))
    }

    /// Taxels among the columns, the most likely first.
    pub(crate) fn own_taxels(&self) -> Vec<Taxels> {
        let of_cells = self.columns.iter().filter_map(|column| {
            let shape = column.taxels.clone()?;
            (!matches!(column.role, Role::Channels(_))).then(|| of_column(column, shape))
        });
        let mut found: Vec<Taxels> = of_cells.chain(self.runs()).collect();
        found.sort_by_key(|taxels| (!taxels.is_named, std::cmp::Reverse(taxels.count())));
        found
    }

    /// Runs of numbered columns of numbers: `c0`, `c1`, …
    fn runs(&self) -> Vec<Taxels> {
        let is_number = |column: &&SeenColumn| column.role == Role::Number;
        let numbers: Vec<&SeenColumn> = self.columns.iter().filter(is_number).collect();
        let runs = numbers.chunk_by(|one, next| follows(&one.name, &next.name));
        let is_padded = |column: &SeenColumn| {
            let digits = column
                .name
                .trim_start_matches(|letter: char| !letter.is_ascii_digit());
            digits.len() > 1 && digits.starts_with('0')
        };
        let of_run = |run: &[&SeenColumn]| {
            let [first, .., last] = run else {
                return None;
            };
            let has_header = first.name.parse::<usize>().is_err();
            let least = if has_header { LEAST_RUN } else { LEAST };
            let is_taxels = (least..=MOST).contains(&run.len())
                && (has_header || (run.len().is_multiple_of(3) && self.channels() == 0));
            let (_, number) = counted(&last.name)?;
            let from = match run.iter().any(|column| is_padded(column)) {
                true => listed(run),
                false => format!("\"{}..{number}\"", first.name),
            };
            is_taxels.then(|| self.of_columns(run, from))
        };
        let mut found: Vec<Taxels> = runs.filter_map(of_run).collect();
        let series = axes::series(numbers.iter().map(|column| column.name.as_str()));
        let series = series.into_iter().map(|positions| {
            let columns = positions.into_iter().map(|position| numbers[position]);
            columns.collect::<Vec<_>>()
        });
        let series = series.filter(|columns| (LEAST..=MOST).contains(&columns.len()));
        found.extend(series.map(|columns| Taxels {
            shape: vec![columns.len() / axes::COUNT, axes::COUNT],
            ..self.of_columns(&columns, listed(&columns))
        }));
        // Columns with uninformative names, and no other columns.
        let is_one = self
            .columns
            .iter()
            .skip_while(|column| !is_number(column))
            .take_while(is_number)
            .count()
            == numbers.len();
        let is_nameless = is_one
            && numbers.len().is_multiple_of(3)
            && (LEAST..=MOST).contains(&numbers.len())
            && self.channels() == 0
            && self.pictures.is_empty();
        if found.is_empty() && is_nameless {
            found.push(self.of_columns(&numbers, listed(&numbers)));
        }
        found
    }

    fn of_columns(&self, columns: &[&SeenColumn], from: String) -> Taxels {
        let first = columns.first();
        Taxels {
            by_position: self.by_position(columns).filter(|_| from.starts_with('[')),
            from,
            shape: vec![columns.len()],
            unit: first.and_then(|column| unit_of(&column.name)),
            placeholders: placeholders(columns),
            is_named: first.is_some_and(|column| is_named(&column.name)),
        }
    }

    /// Positions of adjacent `columns` of a text table, from 0, as TOML. `None` if a name of the table may be a position.
    fn by_position(&self, columns: &[&SeenColumn]) -> Option<String> {
        let is_text = matches!(self.group.ending.as_str(), "csv" | "tsv");
        let is_number = |column: &SeenColumn| column.name.parse::<usize>().is_ok();
        if !is_text || self.columns.iter().any(is_number) {
            return None;
        }
        let mut all = self.columns.iter();
        let start = columns.first()?;
        let first = all.position(|column| column.name == start.name)?;
        let own = self.columns.get(first..first + columns.len())?;
        let mut pairs = own.iter().zip(columns);
        let are_adjacent = pairs.all(|(own, column)| own.name == column.name);
        are_adjacent.then(|| format!("\"{first}..{}\"", first + columns.len() - 1))
    }
}

impl Taxels {
    /// Number of values per row.
    pub(crate) fn count(&self) -> usize {
        self.shape.iter().product()
    }

    /// True if `name` is among the columns of the taxels.
    pub(crate) fn holds(&self, name: &str) -> bool {
        let quoted = format!("{name:?}");
        if self.from == quoted
            || self.from.contains(&format!("{quoted},"))
            || self.from.contains(&format!("{quoted}]"))
        {
            return true;
        }
        let run = self.from.trim_matches('"').split_once("..");
        run.is_some_and(|(first, last)| {
            let stem = first.trim_end_matches(|letter: char| letter.is_ascii_digit());
            let number = |text: &str| text.parse::<u32>().ok();
            let bounds = (number(&first[stem.len()..]), number(last));
            let own = name.strip_prefix(stem).and_then(number);
            matches!((bounds, own), ((Some(first), Some(last)), Some(own)) if (first..=last).contains(&own))
        })
    }
}

fn listed(columns: &[&SeenColumn]) -> String {
    let names: Vec<String> = columns
        .iter()
        .map(|column| format!("{:?}", column.name))
        .collect();
    format!("[{}]", names.join(", "))
}

fn is_named(name: &str) -> bool {
    words(name)
        .iter()
        .any(|word| WORDS.contains(&word.as_str()))
}

fn unit_of(name: &str) -> Option<&'static str> {
    let suffix = UnitSuffix::of(name)?;
    suffix.any_unit().map(|unit| unit.symbol())
}

fn of_column(column: &SeenColumn, shape: Vec<usize>) -> Taxels {
    Taxels {
        from: format!("{:?}", column.name),
        by_position: None,
        shape,
        unit: unit_of(&column.name),
        placeholders: Vec::new(),
        is_named: is_named(&column.name),
    }
}

/// Frequent outliers of the columns, which are probably codes for "not measured".
fn placeholders(columns: &[&SeenColumn]) -> Vec<(f64, String)> {
    let mut found: Vec<(f64, String)> = Vec::new();
    for column in columns {
        let cells = column.cells.iter();
        let numbers = cells.filter_map(|cell| number::number(cell).ok().flatten());
        let numbers: Vec<f64> = numbers.collect();
        let rows = numbers.len();
        for code in codes(numbers) {
            let TaxelCode {
                value,
                count,
                nearest,
            } = code;
            let mut known = found.iter();
            if !known.any(|(known, _)| known.total_cmp(&value).is_eq()) {
                let reason = format!(
                    "{:?} is {value} in {count} of {rows} rows, and the nearest other value is {nearest}",
                    column.name
                );
                found.push((value, reason));
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shape_of_a_cell_is_that_of_its_lists() {
        for (cell, shape) in [
            ("[1, 2, 3, 4]", Some(vec![4])),
            ("1 2 3", Some(vec![3])),
            ("[[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]]", Some(vec![3, 2])),
            ("[[[1],[2]],[[3],[4]]]", Some(vec![2, 2, 1])),
            ("[[1, 2], [3]]", None),
            ("[a, b]", None),
            ("[[1, 2], [3, 4]", None),
        ] {
            assert_eq!(shape_of(cell), shape, "{cell}");
        }
    }

    fn column(name: &str, numbers: &[f64]) -> SeenColumn {
        SeenColumn {
            last: String::new(),
            name: name.to_owned(),
            role: Role::Number,
            cells: numbers.iter().map(f64::to_string).collect(),
            taxels: None,
            empty: 0,
        }
    }

    #[test]
    fn a_number_far_from_the_others_that_comes_often_is_a_code_for_nothing() {
        let with = |code: f64, least: f64| {
            let numbers: Vec<f64> = (0..100)
                .map(|row| match row % 10 {
                    0 => code,
                    row => least + f64::from(row * 7),
                })
                .collect();
            let column = column("c5", &numbers);
            let found = placeholders(&[&column]);
            found.first().map(|(number, _)| *number)
        };
        assert_eq!(with(-1.0, 8.0), Some(-1.0));
        assert_eq!(with(65_535.0, 8.0), Some(65_535.0));
        // Numbers around 0, and one that is slightly greater.
        assert_eq!(with(-1.0, -40.0), None);
        assert_eq!(with(255.0, 190.0), None);
        assert_eq!(with(70.0, 8.0), None);
    }
}
