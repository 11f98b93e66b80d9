//! The tables of a folder, and what their columns seem to be.

use std::path::Path;

use taceva_arrays::ArrayFormat;

use super::roles::{Role, of_named, role};
use super::survey::FileGroup;
use crate::csv_table::number;
use crate::file::SourceFolder;
use crate::foreign::{ForeignTable, PictureColumn, TableForm, packed, topics};

/// How many rows of a table are looked at.
const SAMPLED: usize = 200;

/// The fewest and the most numbers of a row that are taken for taxels.
const LEAST_TAXELS: usize = 8;
const MOST_TAXELS: usize = 4_096;

/// A table, or the first of several that were written alike.
#[derive(Debug)]
pub(super) struct SeenTable<'g> {
    pub(super) group: &'g FileGroup,
    /// What a map writes for it.
    pub(super) written: String,
    pub(super) is_single_array: bool,
    /// Whether channels are guessed by their number alone.
    pub(super) has_guessed_channels: bool,
    pub(super) rows: usize,
    pub(super) columns: Vec<SeenColumn>,
    pub(super) pictures: Vec<PictureColumn>,
    /// Lists of classes that the file states.
    pub(super) classes: Vec<(String, Vec<String>)>,
    /// Other tables with pictures in the same file, as a map writes them.
    pub(super) others: Vec<String>,
}

#[derive(Debug)]
pub(super) struct SeenColumn {
    pub(super) name: String,
    pub(super) role: Role,
    /// Its first cells.
    pub(super) cells: Vec<String>,
}

impl<'g> SeenTable<'g> {
    /// The table in the first file of `group`; `Ok(None)` if it is no table; the error says what is wrong with one that cannot be read.
    pub(super) fn read(
        folder: &SourceFolder,
        group: &'g FileGroup,
    ) -> Result<Option<SeenTable<'g>>, String> {
        let path = folder.path().join(group.first());
        match form_of(&path, group) {
            Some(form) => SeenTable::of_form(&path, group, (group.pattern(), form)).map(Some),
            None => Ok(None),
        }
    }

    /// The folder as LeRobot writes it, if it is one; `group` is the file that says so.
    pub(super) fn of_lerobot(
        folder: &SourceFolder,
        group: &'g FileGroup,
    ) -> Option<Result<SeenTable<'g>, String>> {
        let form = (TableForm::LeRobot, "format = \"lerobot\"".to_owned());
        (group.first() == "meta/info.json")
            .then(|| SeenTable::of_form(folder.path(), group, (".", form)))
    }

    /// The topics of an MCAP recording that are read, those with pictures first.
    pub(super) fn of_messages(
        folder: &SourceFolder,
        group: &'g FileGroup,
    ) -> Result<Vec<SeenTable<'g>>, String> {
        let path = folder.path().join(group.first());
        let mut tables = Vec::new();
        for topic in topics(&path)? {
            let form = TableForm::Messages {
                topic: Some(topic.clone()),
            };
            let extra = format!("rows = {topic:?}");
            // A topic whose messages are not read is none of the tables.
            tables.extend(SeenTable::of_form(
                &path,
                group,
                (group.pattern(), (form, extra)),
            ));
        }
        tables.sort_by_key(|table| std::cmp::Reverse((table.pictures.len(), table.rows)));
        // Pictures that are not compressed stand beside those that are.
        let others = tables
            .iter()
            .skip(1)
            .filter(|table| !table.pictures.is_empty())
            .count();
        let others: Vec<String> = tables
            .drain(1..=others)
            .map(|table| table.written)
            .collect();
        if let Some(first) = tables.first_mut() {
            first.others = others;
        }
        Ok(tables)
    }

    fn of_form(
        path: &Path,
        group: &'g FileGroup,
        (pattern, (form, extra)): (&str, (TableForm, String)),
    ) -> Result<SeenTable<'g>, String> {
        let table = ForeignTable::read(path, &form).map_err(|error| error.to_string())?;
        let rows = table.rows();
        let pictures = table.picture_columns();
        let is_picture = |name: &String| pictures.iter().any(|picture| picture.name == *name);
        let about = group.stem();
        let names = table.columns().into_iter().filter(|name| !is_picture(name));
        let columns = names.map(|name| {
            let cells = 0..rows.min(SAMPLED);
            let cells = cells.map(|row| table.cell(row, &name).unwrap_or_default());
            let cells: Vec<String> = cells.map(|cell| packed::plain(&cell).to_owned()).collect();
            SeenColumn {
                role: of_named(&name, &table.element_names(&name))
                    .unwrap_or_else(|| role(&name, about, &cells)),
                name,
                cells,
            }
        });
        let mut columns: Vec<SeenColumn> = columns.collect();
        let has_guessed_channels = extra == "header = false" && guess_channels(&mut columns);
        Ok(SeenTable {
            columns,
            has_guessed_channels,
            written: match extra.as_str() {
                "" => format!("{pattern:?}"),
                extra => format!("{{ file = {pattern:?}, {extra} }}"),
            },
            is_single_array: matches!(
                form,
                TableForm::Arrays {
                    format: ArrayFormat::Npy,
                    ..
                }
            ),
            group,
            rows,
            classes: table.classes(),
            others: Vec::new(),
            pictures,
        })
    }

    /// Whether its rows are in several groups of one file.
    pub(super) fn has_groups(&self) -> bool {
        self.written.contains("/*\"") && self.group.ending != "json"
    }

    /// How many numbers a row has, if it is an array of many and of nothing else: those of taxels.
    pub(super) fn taxels(&self) -> Option<usize> {
        let [column] = self.columns.as_slice() else {
            return None;
        };
        let cell = column.cells.first()?;
        // Lists in lists are one grid.
        let numbers = cell
            .split(['[', ']', ',', ' '])
            .filter(|part| !part.is_empty());
        let numbers: Option<Vec<f64>> = numbers
            .map(|part| number::number(part).ok().flatten())
            .collect();
        let count = numbers?.len();
        let is_many = (LEAST_TAXELS..=MOST_TAXELS).contains(&count);
        (self.is_single_array && self.pictures.is_empty() && is_many).then_some(count)
    }

    /// The taxels that its columns are, as a map writes them, and how many numbers: a cell of many, or a run of many columns whose names say nothing.
    pub(super) fn own_taxels(&self) -> Option<(String, usize)> {
        if let Some(count) = self.taxels() {
            return Some((format!("{:?}", self.columns[0].name), count));
        }
        let is_number = |column: &&SeenColumn| column.role == Role::Number;
        let run: Vec<&SeenColumn> = self
            .columns
            .iter()
            .skip_while(|column| !is_number(column))
            .take_while(is_number)
            .collect();
        let numbers = self.columns.iter().filter(is_number).count();
        let is_taxels = run.len() == numbers
            && numbers.is_multiple_of(3)
            && (LEAST_TAXELS..=MOST_TAXELS).contains(&numbers);
        if !is_taxels || self.channels() > 0 || !self.pictures.is_empty() {
            return None;
        }
        let [first, .., last] = run.as_slice() else {
            return None;
        };
        let is_position = |column: &SeenColumn| column.name.parse::<usize>().is_ok();
        let from = match is_position(first) && is_position(last) {
            true => format!("\"{}..{}\"", first.name, last.name),
            false => {
                let names: Vec<String> = run
                    .iter()
                    .map(|column| format!("{:?}", column.name))
                    .collect();
                format!("[{}]", names.join(", "))
            }
        };
        Some((from, numbers))
    }

    /// How many channels its columns hold.
    pub(super) fn channels(&self) -> usize {
        let of = |column: &SeenColumn| match &column.role {
            Role::Channels(channels) => channels.len(),
            _ => 0,
        };
        self.columns.iter().map(of).sum()
    }

    /// The column of the time: when it was taken rather than when it was logged.
    pub(super) fn time(&self) -> Option<(&SeenColumn, &'static str, bool)> {
        let is_logged = |column: &&SeenColumn| {
            ["log_time", "publish_time"]
                .iter()
                .any(|name| column.name.starts_with(name))
        };
        let (logged, taken): (Vec<_>, Vec<_>) = self.columns.iter().partition(is_logged);
        taken
            .into_iter()
            .chain(logged)
            .find_map(|column| match &column.role {
                Role::Time { unit, is_unix } => Some((column, *unit, *is_unix)),
                _ => None,
            })
    }
}

/// Takes three numbers without names for forces, six for forces and torques; returns whether there are three or six.
fn guess_channels(columns: &mut [SeenColumn]) -> bool {
    let names = ["Fx", "Fy", "Fz", "Tx", "Ty", "Tz"];
    let numbers: Vec<&mut SeenColumn> = columns
        .iter_mut()
        .filter(|column| column.role == Role::Number)
        .collect();
    let is_so_many = matches!(numbers.len(), 3 | 6);
    if is_so_many {
        for (column, name) in numbers.into_iter().zip(names) {
            column.role = Role::Channels(vec![(name, String::new())]);
        }
    }
    is_so_many
}

/// The form of a table, and what a map has to say of it beside its path.
fn form_of(path: &Path, group: &FileGroup) -> Option<(TableForm, String)> {
    let plain = |form| Some((form, String::new()));
    match group.ending.as_str() {
        "csv" | "tsv" => {
            let header = ForeignTable::read(path, &TableForm::Delimited { has_header: true });
            match header.is_ok_and(|table| !is_of_numbers(&table.names())) {
                true => plain(TableForm::Delimited { has_header: true }),
                false => Some((
                    TableForm::Delimited { has_header: false },
                    "header = false".to_owned(),
                )),
            }
        }
        "json" => {
            // An object whose members are objects is a table of them.
            let members = TableForm::Json {
                rows: Some("/*".to_owned()),
            };
            let table = ForeignTable::read(path, &TableForm::Json { rows: None }).ok()?;
            let is_list = table.rows() != 1;
            let are_rows = !is_list
                && ForeignTable::read(path, &members)
                    .is_ok_and(|table| table.rows() > 1 && !table.names().is_empty());
            match are_rows {
                true => Some((members, "rows = \"/*\"".to_owned())),
                false => plain(TableForm::Json { rows: None }),
            }
        }
        "jsonl" | "ndjson" => plain(TableForm::JsonLines),
        "parquet" => plain(TableForm::Parquet),
        "tar" => plain(TableForm::WebDataset),
        _ => {
            let format = ArrayFormat::of(path)?;
            let of = |rows| TableForm::Arrays {
                format,
                rows,
                is_whole: false,
            };
            let whole = of(None);
            let table = ForeignTable::read(path, &whole).ok()?;
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

/// Whether what would be names of columns are numbers: the file has no header.
fn is_of_numbers(names: &[String]) -> bool {
    let is_number =
        |name: &&String| number::number(packed::plain(name)).is_ok_and(|found| found.is_some());
    names.iter().filter(is_number).count() * 2 > names.len()
}

/// Where the rows of dictionaries within dictionaries are: `trajectories.*`, or in the fields of one record.
fn rows_of_dictionaries(names: &[String]) -> Option<String> {
    let first = |name: &String| name.split_once('.').map(|(first, _)| first.to_owned());
    if let Some(deep) = names.iter().find(|name| name.matches('.').count() > 1) {
        return Some(format!("{}.*", first(deep)?));
    }
    let own = first(names.first()?)?;
    let is_one = names.iter().all(|name| first(name).as_ref() == Some(&own));
    is_one.then(|| format!("/{own}"))
}

/// Where the rows of a file of arrays are: in a table with fields, or in groups that are called alike.
fn rows_within(names: &[String]) -> Option<String> {
    let mut fields = names
        .iter()
        .filter_map(|name| Some(name.rsplit_once('.')?.0));
    if let Some(table) = fields.next() {
        return Some(format!("/{table}"));
    }
    // data/demo_0/ft, data/demo_1/ft: /data/*
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
