//! Columns of the tables in a bundle, as readers of Croissant load them.

use std::fs::File;
use std::io::{BufRead as _, BufReader, Read as _};
use std::path::Path;

use taceva_evaluate::CsvTable;

use crate::layout::{MOST_COLUMNS, MOST_NAME};
use crate::sample_digest::IDS;

/// Maximum length of a line of column names, bytes.
const MOST_LINE: u64 = 1 << 20;

/// Table of a bundle that readers of Croissant can load.
pub(crate) struct TableColumns {
    /// Path in the bundle.
    pub(crate) path: String,
    pub(crate) columns: Vec<Column>,
}

/// Column of a table.
pub(crate) struct Column {
    pub(crate) name: String,
    /// Data type in Croissant: `sc:Float`.
    pub(crate) data_type: &'static str,
}

impl TableColumns {
    /// Columns of `table`, which was read from the file at `path` and is called `name` in the bundle.
    ///
    /// `None` for a table with a separator other than a comma, and for a table without columns.
    pub(crate) fn of_read(table: &CsvTable, path: &Path, name: &str) -> Option<TableColumns> {
        let names = table.names();
        if !name.ends_with(".parquet") && !has_commas(path, names) {
            return None;
        }
        let data_type = |column: usize, name: &str| {
            let is_whole = |row| table.cell(row, column).parse::<i64>().is_ok();
            let is_number = |row| table.number(row, column).is_ok();
            if IDS.contains(&name) {
                "sc:Text"
            } else if (0..table.rows()).all(is_whole) {
                "sc:Integer"
            } else if (0..table.rows()).all(is_number) {
                "sc:Float"
            } else {
                "sc:Text"
            }
        };
        let columns = names.iter().enumerate();
        let named = columns.filter(|(_, own)| (1..=MOST_NAME).contains(&own.len()));
        let columns: Vec<Column> = named
            .map(|(column, own)| Column {
                name: own.clone(),
                data_type: data_type(column, own),
            })
            .collect();
        (!columns.is_empty()).then(|| TableColumns {
            path: name.to_owned(),
            columns,
        })
    }
}

/// Tables in order. Leaves out each table that would raise the total number of columns above [`MOST_COLUMNS`].
pub(crate) fn bounded(tables: impl Iterator<Item = TableColumns>) -> Vec<TableColumns> {
    let mut left = MOST_COLUMNS;
    let within = tables.filter_map(|table| {
        left = left.checked_sub(table.columns.len())?;
        Some(table)
    });
    within.collect()
}

/// True if the first line of the file at `path` is `names` with commas between them.
fn has_commas(path: &Path, names: &[String]) -> bool {
    let Ok(file) = File::open(path) else {
        return false;
    };
    let mut line = String::new();
    if BufReader::new(file.take(MOST_LINE))
        .read_line(&mut line)
        .is_err()
    {
        return false;
    }
    let line = line.trim_start_matches('\u{feff}');
    let cells = line.trim_end_matches(['\r', '\n']).split(',');
    cells
        .map(|cell| cell.trim_matches('"'))
        .eq(names.iter().map(String::as_str))
}

#[cfg(test)]
mod tests {
    use std::num::NonZeroUsize;

    use super::*;

    /// Types of the columns in the table `text`; `None` if no reader of Croissant can load it.
    fn types(text: &str) -> Option<Vec<&'static str>> {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("t.csv");
        std::fs::write(&path, text).expect("room");
        let (read, _) = taceva_evaluate::read_table(&path, NonZeroUsize::MIN).ok()?;
        let table = TableColumns::of_read(&read, &path, "t.csv")?;
        Some(table.columns.iter().map(|own| own.data_type).collect())
    }

    #[test]
    fn a_column_has_the_narrowest_type_that_takes_all_its_cells() {
        let found = types("id,n,Fz [N],part,empty\n1,2,0.5,a,\n2,-3,,b,\n");
        let expected = vec!["sc:Text", "sc:Integer", "sc:Float", "sc:Text", "sc:Float"];
        assert_eq!(found, Some(expected));
    }

    #[test]
    fn columns_are_bounded_in_number_and_names_in_length() {
        let long = "x".repeat(MOST_NAME + 1);
        let found = types(&format!("id,{long}\n1,0.5\n"));
        assert_eq!(found, Some(vec!["sc:Text"]));
        let table = |count: usize| TableColumns {
            path: count.to_string(),
            columns: (0..count)
                .map(|own| Column {
                    name: own.to_string(),
                    data_type: "sc:Text",
                })
                .collect(),
        };
        let found = bounded([MOST_COLUMNS - 2, 3, 2, 1].into_iter().map(table));
        let counts: Vec<usize> = found.iter().map(|own| own.columns.len()).collect();
        assert_eq!(counts, [MOST_COLUMNS - 2, 2]);
    }

    #[test]
    fn a_table_without_commas_between_its_names_is_left_out() {
        assert_eq!(types("id;Fz\n1;0.5\n"), None);
        assert_eq!(types("id, Fz\n1,0.5\n"), None);
        let quoted = types("\u{feff}\"id\",\"Fz\"\r\n1,0.5\r\n");
        assert_eq!(quoted, Some(vec!["sc:Text", "sc:Float"]));
    }
}
