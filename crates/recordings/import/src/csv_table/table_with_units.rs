//! Text table read in a stated text form, with the unit of each column.

use std::path::Path;

use super::text_form::{TextForm, separator_line, unit_said};
use super::{CsvTable, as_text, cells_of_first_row, delimiter_of, number};
use crate::error::{ImportError, Place, table_error};
use taceva_dataset::internal::{all_cores, limits, read_capped, shown};

/// Text table with the unit of each column from the row below the header.
pub(crate) struct TableWithUnits {
    pub(crate) table: CsvTable,
    pub(crate) units: Vec<Option<String>>,
}

impl CsvTable {
    /// Reads the file at `path` in the text form `form`. A line `sep=;` before the header sets the separator.
    ///
    /// # Errors
    /// Errors of [`read`](CsvTable::read). The error suggests keys of the map if the text seems to have another form.
    pub(crate) fn read_written(
        path: &Path,
        form: &TextForm,
    ) -> Result<TableWithUnits, ImportError> {
        let text = as_text(path, read_capped(path, limits::TABLE_BYTES)?)?;
        let hint = match form.is_plain() {
            true => hint(&text, form),
            false => None,
        };
        let read = read_text(path, text, form);
        read.map_err(|error| match (error, hint) {
            (ImportError::Table { place, problem }, Some(hint)) => {
                table_error!(place, "{problem}; {hint}")
            }
            (error, _) => error,
        })
    }
}

/// Suggested keys of the map section `table`, if the form guessed from `text` needs keys.
fn hint(text: &str, form: &TextForm) -> Option<String> {
    let guessed = TextForm::guessed(text);
    let keys = TextForm {
        has_header: true,
        decimal: '.',
        thousands: None,
        ..guessed
    };
    (!keys.is_plain()).then(|| {
        let keys = TextForm {
            has_header: form.has_header,
            ..keys
        };
        format!("`table = {{ file = \"…\"{} }}` may read it", keys.keys())
    })
}

fn read_text(path: &Path, text: String, form: &TextForm) -> Result<TableWithUnits, ImportError> {
    let wrong = |line: u64, problem: String| ImportError::table(Place::line(path, line), problem);
    let is_comment = |line: &str| {
        let mark = form.comment.as_deref();
        mark.is_some_and(|mark| line.trim_start().trim_start_matches('"').starts_with(mark))
    };
    // Number of lines cut off before the header.
    let mut before = 0_u64;
    let mut at = 0;
    let mut separator = None;
    for line in text.split_inclusive('\n') {
        let is_skipped = before < u64::from(form.skip_lines);
        let said = separator_line(line).filter(|_| separator.is_none());
        separator = separator.or(said);
        let is_blank = line.trim().is_empty() && !form.is_plain();
        if !is_skipped && said.is_none() && !is_comment(line) && !is_blank {
            break;
        }
        // The map does not count a separator line.
        before += 1;
        at += line.len();
    }
    if at >= text.len() {
        let lines = text.lines().count();
        let problem = format!(
            "all {lines} lines are comments or skipped, so no header is left: correct `skip_lines` and `comment` of the map"
        );
        return Err(wrong(1, problem));
    }
    let mut text = match at {
        0 => text,
        at => text[at..].to_owned(),
    };
    let delimiter =
        separator.unwrap_or_else(|| delimiter_of(text.lines().next().unwrap_or_default()));
    let mut units = Vec::new();
    if form.has_units || form.comment.is_some() {
        let mut cleared = String::with_capacity(text.len());
        let mut is_header = form.has_header;
        let mut needs_units = form.has_units;
        let mut is_quoted = false;
        for line in text.split_inclusive('\n') {
            let end = if line.ends_with('\n') { "\n" } else { "" };
            let is_blank = line.trim().is_empty();
            // A line end within a quoted cell ends no row.
            let is_removed = if is_quoted {
                false
            } else if is_comment(line) {
                true
            } else if is_header || is_blank {
                is_header &= is_blank;
                false
            } else if needs_units {
                needs_units = false;
                units = cells_of(line, delimiter);
                true
            } else {
                false
            };
            match is_removed {
                true => cleared.push_str(end),
                false => {
                    is_quoted ^= line.matches('"').count() % 2 == 1;
                    cleared.push_str(line);
                }
            }
        }
        text = cleared;
    }
    let read = match form.has_header {
        true => CsvTable::of_text(path, text, delimiter, all_cores()),
        false => {
            // Blank lines are skipped, so the header is the first other line.
            let first = text.lines().find(|line| !line.trim().is_empty());
            let count = cells_of_first_row(first.unwrap_or_default(), delimiter);
            let names: Vec<String> = (0..count).map(|position| position.to_string()).collect();
            let header = names.join(&char::from(delimiter).to_string());
            let read = CsvTable::of_text(path, format!("{header}\n{text}"), delimiter, all_cores());
            read.map_err(ImportError::a_line_above).map(|mut table| {
                table.added_lines = 1;
                table
            })
        }
    };
    let mut table = read.map_err(|error| error.lines_below(before))?;
    table.left_out_lines = before;
    let said = |cell: &String| unit_said(cell);
    let written: Vec<Option<String>> = units.iter().map(said).collect();
    if let Some(cell) = units
        .iter()
        .find(|cell| number::number(cell).is_ok_and(|found| found.is_some()))
    {
        let problem = format!(
            "`{}` is a number where `units_row = true` of the map expects units",
            shown(cell)
        );
        return Err(wrong(before + 2, problem));
    }
    Ok(TableWithUnits {
        table,
        units: written,
    })
}

/// Splits a line into cells.
fn cells_of(line: &str, delimiter: u8) -> Vec<String> {
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(delimiter)
        .has_headers(false)
        .from_reader(line.as_bytes());
    let mut record = csv::StringRecord::new();
    match reader.read_record(&mut record) {
        Ok(true) => record.iter().map(|cell| cell.trim().to_owned()).collect(),
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str, form: &TextForm) -> Result<TableWithUnits, String> {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("table.csv");
        std::fs::write(&path, text).expect("written");
        CsvTable::read_written(&path, form).map_err(|error| error.to_string())
    }

    #[test]
    fn comments_skipped_lines_units_and_separators_are_no_rows_and_lines_keep_their_numbers() {
        for (text, line) in [
            ("# load cell\n# lab 3\nfile;fz\na;1\n# pause\nb;2\n", 4),
            ("file,fz\n-,[mN]\na,1\nb,2\n", 3),
            ("sep=;\nfile;fz\na;1\nb;2\n", 3),
            ("Gauge 7\nserial 12\n\nfile,fz\na,1\nb,2\n", 5),
            ("\"# note, with a comma\"\nfile,fz\n\"a\",1\n\"b\",2\n", 3),
        ] {
            let form = TextForm::guessed(text);
            let found = read(text, &form).unwrap_or_else(|problem| panic!("{text}: {problem}"));
            assert_eq!(found.table.names(), ["file", "fz"], "{text}");
            assert_eq!(
                found.table.text("file").expect("a column"),
                ["a", "b"],
                "{text}"
            );
            assert_eq!(found.table.place(0, 0).line, Some(line), "{text}");
            if form.has_units {
                assert_eq!(found.units, [None, Some("mN".to_owned())]);
            }
        }
    }

    #[test]
    fn a_table_that_is_read_as_it_lies_names_the_key_that_reads_it() {
        let plain = TextForm::new(true);
        for (text, key) in [
            ("# load cell\nfile,fz\na,1\nb,2\n", "comment = \"#\""),
            ("Gauge 7\nserial 12\nfile,fz\na,1\nb,2\n", "skip_lines = 2"),
        ] {
            let problem = read(text, &plain).err().unwrap_or_default();
            assert!(problem.contains(key), "{problem}");
        }
        assert!(
            read("a,b\n1,2\n3\n", &plain).is_err_and(|problem| !problem.contains("skip_lines"))
        );
    }
}
