//! Tables of a folder, with the guessed roles of their columns.

mod form;
mod taxels;

use std::path::Path;

use taceva_arrays::ArrayFormat;
use taceva_core::SourceUnit;

use super::roles::candidate::{Candidate, Reason};
use super::roles::{Role, is_logged, of_named, role, words};
use super::survey::FileGroup;
use crate::csv_table::number;
use crate::foreign::{ForeignTable, PictureColumn, TableForm, Topics, cell_list};
use crate::source_folder::SourceFolder;
use form::{NUMBERED_HEADER, cut_key, form_of};
pub(super) use taxels::Taxels;
use taxels::{open_numbered_times, taxels_of};

/// Maximum number of rows examined in a table.
const SAMPLED: usize = 200;

/// Examined table, which represents all similar tables of its group.
#[derive(Debug)]
pub(super) struct SeenTable<'g> {
    pub(super) group: &'g FileGroup,
    /// Value of `table` in a map for this table.
    pub(super) written: String,
    pub(super) is_single_array: bool,
    /// True if channels are guessed only from the number of columns.
    pub(super) has_guessed_channels: bool,
    /// Comment on the guessed header, or on the end of a truncated recording.
    pub(super) header_guess: Option<String>,
    pub(super) rows: usize,
    pub(super) columns: Vec<SeenColumn>,
    pub(super) pictures: Vec<PictureColumn>,
    /// Lists of classes stated by the file.
    pub(super) classes: Vec<(String, Vec<String>)>,
    /// Further tables with pictures in the same file, as written in a map.
    pub(super) others: Vec<String>,
    /// Unread items of the file, each with the reason.
    pub(super) unread: Vec<String>,
}

#[derive(Debug)]
pub(super) struct SeenColumn {
    pub(super) name: String,
    pub(super) role: Role,
    /// Cells of the first rows.
    pub(super) cells: Vec<String>,
    /// Cell of the last row.
    pub(super) last: String,
    /// Shape of the lists in the first cell, if the lists contain enough numbers for taxels.
    pub(super) taxels: Option<Vec<usize>>,
    /// Number of empty cells among the first million rows.
    pub(super) empty: usize,
}

/// Time column of an examined table.
#[derive(Debug)]
pub(super) struct SeenTime<'t> {
    pub(super) column: &'t SeenColumn,
    pub(super) unit: &'static str,
    pub(super) is_unix: bool,
    guess: Option<&'static str>,
}

impl SeenTime<'_> {
    /// Comment with the reason why the unit of the time may be different; empty for a certain unit.
    pub(super) fn mark(&self) -> String {
        let guess = self.guess.map(|guess| format!("   # {guess}"));
        guess.unwrap_or_default()
    }
}

impl<'g> SeenTable<'g> {
    /// Reads the table in the first file of `group`; `Ok(None)` if the file is not a table. The error describes an unreadable table.
    pub(super) fn read(
        folder: &SourceFolder,
        group: &'g FileGroup,
    ) -> Result<Option<SeenTable<'g>>, String> {
        let path = folder.path().join(group.first());
        let Some((form, extra)) = form_of(&path, group) else {
            return Ok(None);
        };
        SeenTable::of_form(&path, group, group.pattern(), form, extra).map(Some)
    }

    /// Reads the folder as a LeRobot dataset; `None` if the folder is not such a dataset. `group` is the file that identifies the dataset.
    pub(super) fn of_lerobot(
        folder: &SourceFolder,
        group: &'g FileGroup,
    ) -> Option<Result<SeenTable<'g>, String>> {
        let extra = "format = \"lerobot\"".to_owned();
        (group.first() == "meta/info.json")
            .then(|| SeenTable::of_form(folder.path(), group, ".", TableForm::LeRobot, extra))
    }

    /// Tables of the readable topics of a recording, topics with pictures first. The error states why no topic is readable.
    pub(super) fn of_messages(
        folder: &SourceFolder,
        group: &'g FileGroup,
    ) -> Result<Vec<SeenTable<'g>>, String> {
        let path = folder.path().join(group.first());
        let mut tables = Vec::new();
        let mut problems = Vec::new();
        let topics = Topics::of(&path)?;
        let (cut, guess) = topics.before_cut.map(cut_key).unzip();
        for topic in topics.names {
            let extra = format!("{}rows = {topic:?}", cut.unwrap_or_default());
            let form = TableForm::Messages {
                topic: Some(topic),
                is_to_cut: true,
            };
            match SeenTable::of_form(&path, group, group.pattern(), form, extra) {
                Ok(table) => tables.push(SeenTable {
                    header_guess: guess.clone(),
                    ..table
                }),
                Err(problem) => problems.push(problem),
            }
        }
        if let (true, Some(problem)) = (tables.is_empty(), problems.first()) {
            return Err(problem.clone());
        }
        tables.sort_by_key(|table| std::cmp::Reverse((table.pictures.len(), table.rows)));
        // Recordings may hold compressed and uncompressed pictures of one camera.
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
        pattern: &str,
        form: TableForm,
        extra: String,
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
            if let Role::Channels(candidates) = &mut role {
                complete(&table, &name, candidates);
            }
            // Stated times are read in seconds.
            if table.time_unit(&name).is_some()
                && let Role::Time { unit, guess, .. } = &mut role
            {
                (*unit, *guess) = ("s", None);
            }
            let last = rows.checked_sub(1).map(|row| table.cell(row, &name));
            let last = last.and_then(Result::ok).unwrap_or_default();
            SeenColumn {
                last: cell_list::plain(&last).to_owned(),
                taxels: taxels_of(&role, &cells),
                empty: match role {
                    Role::Other | Role::Attribute => empty_cells(&table, &name),
                    _ => 0,
                },
                role,
                name,
                cells,
            }
        });
        let mut columns: Vec<SeenColumn> = columns.collect();
        open_invalid(&mut columns);
        open_numbered_times(&mut columns);
        let is_numbered = extra.starts_with(NUMBERED_HEADER);
        let is_nameless = extra.contains("header = false") || is_numbered;
        let has_guessed_channels = is_nameless && guess_channels(&mut columns);
        let header_guess = is_numbered.then(|| {
            let names = columns.iter().map(|column| column.name.as_str());
            let names: Vec<&str> = names.take(4).collect();
            let more = if columns.len() > names.len() { ",…" } else { "" };
            format!(
                "# A guess: the first line, {}{more}, is a header as pandas writes it; `header = false` if it is data.",
                names.join(",")
            )
        });
        // Only the lab knows whether points group digits.
        let grouped = columns
            .iter()
            .find_map(|column| table.grouped_digits(&column.name));
        let header_guess = header_guess.or(grouped.as_ref().map(|(example, _)| {
            format!("# Is `{example}` a fraction, or a whole number in groups? `thousands` is \"\" if a fraction, \".\" if in groups.")
        }));
        let extra = match (&grouped, extra.as_str()) {
            (None, _) => extra,
            (Some(_), "") => "thousands = \"?\"".to_owned(),
            (Some(_), extra) => format!("{extra}, thousands = \"?\""),
        };
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

    /// True if the rows are in several groups of one file.
    pub(super) fn has_groups(&self) -> bool {
        self.written.contains("/*\"") && self.group.ending != "json"
    }

    /// True for a LeRobot dataset.
    pub(super) fn is_lerobot(&self) -> bool {
        self.group.first() == "meta/info.json"
    }

    /// Number of channels among the columns.
    pub(super) fn channels(&self) -> usize {
        self.columns.iter().map(SeenColumn::channels).sum()
    }

    /// Time column. Prefers the time of acquisition to the time of logging.
    pub(super) fn time(&self) -> Option<SeenTime<'_>> {
        let columns = self.columns.iter();
        let (logged, taken): (Vec<_>, Vec<_>) = columns.partition(|column| is_logged(&column.name));
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

/// Maximum number of rows that are searched for empty cells. A small file can declare many more rows.
const SEARCHED: usize = 1_000_000;

/// Number of empty cells among the first rows of a column.
fn empty_cells(table: &ForeignTable, name: &str) -> usize {
    let rows = 0..table.rows().min(SEARCHED);
    rows.filter(|row| table.cell(*row, name).is_ok_and(|cell| cell.is_empty()))
        .count()
}

/// Number of rows, spread over the table, that are searched for a non-zero number.
const SPREAD: usize = 2_000;

/// Adds the unit stated by the file to `candidates`. Leaves a gap (`"?"`) for a force or a torque that is 0 in all examined rows.
fn complete(table: &ForeignTable, name: &str, candidates: &mut [Candidate]) {
    let stated = table.stated(name);
    let stated = stated.iter().find_map(|stated| stated.unit.as_deref());
    let stated = stated.and_then(|unit| SourceUnit::parse(unit.trim()).ok());
    let rows = table.rows();
    let step = rows.div_ceil(SPREAD).max(1);
    for candidate in candidates {
        if let Some(unit) = stated {
            candidate.take_unit(unit);
        }
        let at: Vec<usize> = candidate
            .index
            .trim_matches(['[', ']'])
            .parse()
            .into_iter()
            .collect();
        let mut looked_at = 0;
        let is_zero = (0..rows).step_by(step).all(|row| {
            let cell = table.cell(row, name).unwrap_or_default();
            let cell = cell_list::plain(&cell);
            let found = match at.as_slice() {
                [] => number::number(cell),
                at => match cell_list::value(cell, at) {
                    Ok(value) => number::number(&value.text),
                    Err(_) => Ok(None),
                },
            };
            looked_at += usize::from(matches!(found, Ok(Some(_))));
            !matches!(found, Ok(Some(number)) if number != 0.0)
        });
        // A position may be 0 throughout: a scan along one axis.
        let is_place = candidate.channel.starts_with('P');
        if is_zero && !is_place && looked_at >= LEAST_ZEROS {
            candidate.open = Some(format!(
                "is 0 in all {looked_at} rows that the draft read: name it if 0 was measured"
            ));
        }
    }
}

/// Minimum number of examined rows for the doubt that a channel with only zeros was measured.
const LEAST_ZEROS: usize = 4;

/// Leaves a gap (`"?"`) for each channel that another column marks as invalid in all examined rows: `force_valid` for `force_z`.
fn open_invalid(columns: &mut [SeenColumn]) {
    let is_false = |cell: &String| {
        matches!(
            cell.to_ascii_lowercase().as_str(),
            "false" | "0" | "0.0" | "no"
        )
    };
    let invalid: Vec<(String, Vec<String>)> = columns
        .iter()
        .filter(|column| !column.cells.is_empty() && column.cells.iter().all(is_false))
        .filter_map(|column| {
            let mut about = words(&column.name);
            about.iter().any(|word| word == "valid").then(|| {
                about.retain(|word| word != "valid" && word != "is");
                (column.name.clone(), about)
            })
        })
        .collect();
    for column in columns {
        let own = words(&column.name);
        let Role::Channels(candidates) = &mut column.role else {
            continue;
        };
        let mut known = invalid.iter();
        let said = known.find(|(_, about)| about.iter().all(|word| own.contains(word)));
        if let Some((name, _)) = said {
            for candidate in candidates {
                candidate.open = Some(format!(
                    "is invalid by `{name}` in every row that the draft read: name it if it is valid"
                ));
            }
        }
    }
}

/// Takes exactly three unnamed columns of numbers for forces, or exactly six for forces and torques. Returns true if it does so.
fn guess_channels(columns: &mut [SeenColumn]) -> bool {
    let names = ["Fx", "Fy", "Fz", "Tx", "Ty", "Tz"];
    let numbers: Vec<&mut SeenColumn> = columns
        .iter_mut()
        .filter(|column| column.role == Role::Number)
        .collect();
    let is_so_many = matches!(numbers.len(), 3 | 6);
    if is_so_many {
        for (column, channel) in numbers.into_iter().zip(names) {
            column.role = Role::Channels(vec![Candidate {
                channel,
                index: String::new(),
                reason: Reason::Guess,
                unit: None,
                is_unscaled: false,
                open: None,
            }]);
        }
    }
    is_so_many
}
