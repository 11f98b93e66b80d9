//! Detects the form of a table from its name and content.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use taceva_arrays::ArrayFormat;

use crate::csv_table::number;
use crate::csv_table::text_form::TextForm;
use crate::draft::survey::FileGroup;
use crate::foreign::{BeforeCut, ForeignTable, TableForm, cell_list};

/// Map key for a table whose column names are the numbers from 0.
pub(super) const NUMBERED_HEADER: &str = "header = true";

/// Map key with a gap (`"?"`), and a comment, for a recording that was cut or not closed.
pub(super) fn cut_key(before: BeforeCut) -> (&'static str, String) {
    let BeforeCut { messages, end } = before;
    let comment = format!(
        "# The recording was cut or not closed. `cut = \"keep\"` reads its {} before byte {end}.",
        taceva_core::counted(messages, "complete message")
    );
    ("cut = \"?\", ", comment)
}

/// Form of a table, with the keys that a map needs besides its path.
pub(super) fn form_of(path: &Path, group: &FileGroup) -> Option<(TableForm, String)> {
    let plain = |form| Some((form, String::new()));
    match group.ending.as_str() {
        "txt" if !is_numeric(path) => None,
        "csv" | "tsv" | "txt" => {
            let guessed = TextForm::guessed(&beginning(path)?);
            let form = |has_header: bool| TextForm {
                has_header,
                ..guessed.clone()
            };
            let with_header = TableForm::Delimited(form(true));
            let names = ForeignTable::read(path, &with_header).map(|table| table.names());
            let (form, keys) = match names {
                // Each of its lines is numbers.
                _ if group.ending == "txt" => (form(false), String::new()),
                Ok(names) if is_numbered(&names) => (form(true), format!(", {NUMBERED_HEADER}")),
                Ok(names) if !is_of_numbers(&names) => (form(true), String::new()),
                _ => (form(false), String::new()),
            };
            let keys = format!("{keys}{}", form.keys());
            let extra = keys.trim_start_matches(", ").to_owned();
            Some((TableForm::Delimited(form), extra))
        }
        "json" => {
            // An object whose members are objects is a table of them.
            let members = TableForm::Json {
                rows: Some("/*".to_owned()),
            };
            let table = ForeignTable::read(path, &TableForm::Json { rows: None }).ok()?;
            let is_list = table.rows() != 1;
            let are_rows = !is_list
                && ForeignTable::read(path, &members).is_ok_and(|table| {
                    // If the members are numbers or texts, they are the cells of one row.
                    let mut names = table.names().into_iter();
                    table.rows() > 1 && names.any(|name| name.starts_with('/'))
                });
            match are_rows {
                true => Some((members, "rows = \"/*\"".to_owned())),
                false => plain(TableForm::Json { rows: None }),
            }
        }
        "jsonl" | "ndjson" => plain(TableForm::JsonLines),
        "parquet" => plain(TableForm::Parquet),
        "arrow" | "feather" => plain(TableForm::Arrow),
        "tar" => plain(TableForm::WebDataset),
        _ => {
            let format = ArrayFormat::of(path)?;
            let of = |rows| TableForm::Arrays {
                format,
                rows,
                is_whole: false,
            };
            let whole = of(None);
            let Ok(table) = ForeignTable::read(path, &whole) else {
                return plain(whole);
            };
            let names = table.names();
            let found = match format {
                ArrayFormat::Pickle | ArrayFormat::Npy => rows_of_dictionaries(&names),
                _ => rows_within(&names),
            };
            let Some(rows) = found else {
                return plain(whole);
            };
            let extra = format!("rows = {rows:?}");
            Some((of(Some(rows)), extra))
        }
    }
}

/// Number of leading lines of a text that must consist of numbers, so that the text is taken for a table.
const LINES: usize = 20;

/// True if each cell in the first lines of a text is a number. Such a text is a table without a header.
fn is_numeric(path: &Path) -> bool {
    let Some(text) = beginning(path) else {
        return false;
    };
    let lines: Vec<&str> = text.lines().take(LINES).collect();
    let is_number = |cell: &str| number::number(cell).is_ok_and(|found| found.is_some());
    let are_numbers = |line: &&str| {
        let mut cells = line
            .split([',', ';', ' ', '\t'])
            .filter(|cell| !cell.is_empty());
        cells.next().is_some_and(is_number) && cells.all(is_number)
    };
    lines.len() > 1 && lines.iter().all(are_numbers)
}

/// Size of the beginning of a text table from which its form is guessed, bytes.
const BEGINNING: u64 = 1 << 16;

/// First lines of a text table.
fn beginning(path: &Path) -> Option<String> {
    let file = File::open(path).ok()?;
    let mut bytes = Vec::new();
    file.take(BEGINNING).read_to_end(&mut bytes).ok()?;
    let text = String::from_utf8_lossy(&bytes);
    let text = text.trim_start_matches('\u{feff}');
    // The last line may be incomplete.
    let end = match bytes.len() as u64 == BEGINNING {
        true => text.rfind('\n').unwrap_or(text.len()),
        false => text.len(),
    };
    Some(text[..end].to_owned())
}

/// True if most column names are numbers. The file then has no header.
fn is_of_numbers(names: &[String]) -> bool {
    let is_number =
        |name: &&String| number::number(cell_list::plain(name)).is_ok_and(|found| found.is_some());
    names.iter().filter(is_number).count() * 2 > names.len()
}

/// True if the names are the column positions from 0, as pandas writes an array without names. An unnamed index column may precede them.
fn is_numbered(names: &[String]) -> bool {
    let names = match names {
        [index, rest @ ..] if index.is_empty() => rest,
        names => names,
    };
    let mut numbered = names.iter().enumerate();
    !names.is_empty() && numbered.all(|(position, name)| *name == position.to_string())
}

/// Path to the rows of nested dictionaries: `trajectories.*`, or the fields of one record.
fn rows_of_dictionaries(names: &[String]) -> Option<String> {
    let first = |name: &String| name.split_once('.').map(|(first, _)| first.to_owned());
    if let Some(deep) = names.iter().find(|name| name.matches('.').count() > 1) {
        return Some(format!("{}.*", first(deep)?));
    }
    let own = first(names.first()?)?;
    let is_one = names.iter().all(|name| first(name).as_ref() == Some(&own));
    is_one.then(|| format!("/{own}"))
}

/// Path to the rows of a file of arrays: a table with fields, or groups of similar names.
fn rows_within(names: &[String]) -> Option<String> {
    let mut fields = names
        .iter()
        .filter_map(|name| Some(name.rsplit_once('.')?.0));
    if let Some(table) = fields.next() {
        return Some(format!("/{table}"));
    }
    // `data/demo_0/ft` and `data/demo_1/ft` give `/data/*`.
    let split: Vec<Vec<&str>> = names.iter().map(|name| name.split('/').collect()).collect();
    let first = split.first()?;
    let counted = first
        .iter()
        .position(|part| part.ends_with(|letter: char| letter.is_ascii_digit()))?;
    let bare = |part: &str| {
        part.trim_end_matches(|letter: char| letter.is_ascii_digit())
            .to_owned()
    };
    let are_alike = split.iter().all(|parts| {
        parts.len() > counted + 1
            && parts[..counted] == first[..counted]
            && bare(parts[counted]) == bare(first[counted])
    });
    let is_several = split.iter().any(|parts| parts[counted] != first[counted]);
    (are_alike && is_several).then(|| {
        let before: String = first[..counted]
            .iter()
            .map(|part| format!("/{part}"))
            .collect();
        format!("{before}/*")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn are_numbered(names: &[&str]) -> bool {
        let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
        is_numbered(&names)
    }

    #[test]
    fn a_header_as_pandas_writes_it_of_an_array_is_its_positions_behind_the_index() {
        assert!(are_numbered(&["0", "1", "2"]));
        assert!(are_numbered(&["", "0", "1"]));
        assert!(!are_numbered(&["0", "2", "1"]));
        assert!(!are_numbered(&["1", "2", "3"]));
        assert!(!are_numbered(&["0.0", "1.0"]));
        assert!(!are_numbered(&["", "Fx"]));
        assert!(!are_numbered(&[""]));
    }
}
