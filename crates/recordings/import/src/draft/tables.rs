//! The tables of a folder, and what their columns seem to be.

mod form;

use std::path::Path;

use taceva_arrays::ArrayFormat;

use super::roles::{Role, doubt, of_named, role};
use super::survey::FileGroup;
use crate::csv_table::number;
use crate::foreign::{ForeignTable, PictureColumn, TableForm, cell_list, topics};
use crate::source_folder::SourceFolder;
use form::{NUMBERED_HEADER, form_of};

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
    /// What is guessed of its header.
    pub(super) header_guess: Option<String>,
    pub(super) rows: usize,
    pub(super) columns: Vec<SeenColumn>,
    pub(super) pictures: Vec<PictureColumn>,
    /// Lists of classes that the file states.
    pub(super) classes: Vec<(String, Vec<String>)>,
    /// Other tables with pictures in the same file, as a map writes them.
    pub(super) others: Vec<String>,
    /// What of its file is not read, each with the reason.
    pub(super) unread: Vec<String>,
}

#[derive(Debug)]
pub(super) struct SeenColumn {
    pub(super) name: String,
    pub(super) role: Role,
    /// Why its numbers may not be what was measured, by its name.
    pub(super) doubt: Option<String>,
    /// Its first cells.
    pub(super) cells: Vec<String>,
}

/// The column of the time of a table.
#[derive(Debug)]
pub(super) struct SeenTime<'t> {
    pub(super) column: &'t SeenColumn,
    pub(super) unit: &'static str,
    pub(super) is_unix: bool,
    guess: Option<&'static str>,
}

impl SeenTime<'_> {
    /// The comment behind its unit.
    pub(super) fn mark(&self) -> String {
        let guess = self.guess.map(|guess| format!("   # {guess}"));
        guess.unwrap_or_default()
    }
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
            let cells: Vec<String> = cells
                .map(|cell| cell_list::plain(&cell).to_owned())
                .collect();
            let mut role = of_named(&name, &table.element_names(&name))
                .unwrap_or_else(|| role(&name, about, &cells));
            // Times that the file says to be times are read in seconds.
            if table.time_unit(&name).is_some()
                && let Role::Time { unit, guess, .. } = &mut role
            {
                (*unit, *guess) = ("s", None);
            }
            SeenColumn {
                role,
                doubt: doubt(&name, about),
                name,
                cells,
            }
        });
        let mut columns: Vec<SeenColumn> = columns.collect();
        let is_nameless = matches!(extra.as_str(), "header = false" | NUMBERED_HEADER);
        let has_guessed_channels = is_nameless && guess_channels(&mut columns);
        let header_guess = (extra == NUMBERED_HEADER).then(|| {
            let names = columns.iter().map(|column| column.name.as_str());
            let names: Vec<&str> = names.take(4).collect();
            let more = if columns.len() > names.len() { ",…" } else { "" };
            format!(
                "# A guess: the first line, {}{more}, is a header as pandas writes it; `header = false` if it is data.",
                names.join(",")
            )
        });
        Ok(SeenTable {
            columns,
            has_guessed_channels,
            header_guess,
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
            unread: table.unread(),
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
        self.columns.iter().map(SeenColumn::channels).sum()
    }

    /// How many of them are what was measured, as far as names say.
    pub(super) fn measured(&self) -> usize {
        let columns = self.columns.iter();
        let sure = columns.filter(|column| column.doubt.is_none());
        sure.map(SeenColumn::channels).sum()
    }

    /// The column of the time: when it was taken rather than when it was logged.
    pub(super) fn time(&self) -> Option<SeenTime<'_>> {
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
                Role::Time {
                    unit,
                    is_unix,
                    guess,
                } => Some(SeenTime {
                    column,
                    unit,
                    is_unix: *is_unix,
                    guess: *guess,
                }),
                _ => None,
            })
    }
}

impl SeenColumn {
    fn channels(&self) -> usize {
        match &self.role {
            Role::Channels(channels) => channels.len(),
            _ => 0,
        }
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
