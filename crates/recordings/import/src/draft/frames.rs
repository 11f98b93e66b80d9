//! Finds the frames that belong to the rows of a table.

mod picture_lines;
mod series;
mod stems;

use std::path::Path;

use super::endings::is_picture;
use super::survey::FileGroup;
use super::tables::{SeenColumn, SeenTable};
use super::views::{Sided, sided};
use crate::source_folder::SourceFolder;
use picture_lines::{in_array, in_table};
use taceva_dataset::ChannelOrder;
use taceva_dataset::internal::{decode, limits, read_capped};

/// Maximum number of cells of a column that are checked for names of files.
const LOOKED_UP: usize = 20;

/// Comment of the draft that lists the pictures that belong to no row of `main`.
pub(super) fn none_found(groups: &[FileGroup], main: &SeenTable<'_>) -> String {
    series::none_found(groups, main)
}

/// Lines of `[frame]` with their comments.
#[derive(Debug, Default)]
pub(super) struct FrameLines {
    /// Name of the view, if rows have several pictures.
    pub(super) view: Option<String>,
    pub(super) lines: Vec<String>,
    pub(super) is_gray: bool,
    /// Colour order, if the file states it.
    pub(super) order: Option<ChannelOrder>,
    /// Lines of `[path]`, if pictures are found by the end of a path.
    pub(super) path: Option<String>,
    /// Lines of `[drop]`.
    pub(super) drop: Option<String>,
}

/// Evidence that rows of `table` have pictures: 2 if rows contain or name pictures, 1 if cells are parts of picture names, 0 for none.
pub(super) fn evidence(folder: &SourceFolder, groups: &[FileGroup], table: &SeenTable<'_>) -> u8 {
    match table.pictures.is_empty() && file_columns(folder, table).is_empty() {
        true => u8::from(
            stems::of(folder, groups, table).is_some() || series::has_column(groups, table),
        ),
        false => 2,
    }
}

/// Column whose cells name pictures.
#[derive(Clone, Copy)]
struct FileColumn<'t> {
    column: &'t SeenColumn,
    /// True if cells are relative to the source folder instead of the table's folder.
    is_below_source: bool,
}

/// All columns whose cells name pictures.
fn file_columns<'t>(folder: &SourceFolder, table: &'t SeenTable<'_>) -> Vec<FileColumn<'t>> {
    let own = folder.path().join(table.group.first());
    let own = taceva_files::parent_of(&own);
    let names_files = |column: &SeenColumn, base: &Path| {
        let mut cells = column
            .cells
            .iter()
            .filter(|cell| !cell.is_empty())
            .take(LOOKED_UP)
            .peekable();
        let is_file = |cell: &String| {
            let ending = cell
                .rsplit_once('.')
                .map_or("", |(_, ending)| ending)
                .to_ascii_lowercase();
            is_picture(&ending) && base.join(cell).is_file()
        };
        cells.peek().is_some() && cells.all(is_file)
    };
    let columns = table.columns.iter().filter_map(|column| {
        let is_own = names_files(column, own);
        let is_named = is_own || names_files(column, folder.path());
        is_named.then_some(FileColumn {
            column,
            is_below_source: !is_own,
        })
    });
    columns.collect()
}

/// Finds the column whose cells name pictures in several folders, one folder for each view. Returns the column and the folders, such as `left` and `right`.
fn camera_folders<'t>(
    folder: &SourceFolder,
    table: &'t SeenTable<'_>,
) -> Option<(&'t SeenColumn, Vec<String>)> {
    let entries = std::fs::read_dir(folder.path()).ok()?.flatten();
    let names = entries.filter_map(|entry| {
        let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
        entry.file_name().into_string().ok().filter(|_| is_folder)
    });
    let mut names: Vec<String> = names.collect();
    names.sort_unstable();
    table.columns.iter().find_map(|column| {
        let cells = column.cells.iter().filter(|cell| !cell.is_empty());
        let cells: Vec<&String> = cells.take(LOOKED_UP).collect();
        let is_one = |cell: &&String| {
            let ending = cell.rsplit_once('.').map_or("", |(_, ending)| ending);
            is_picture(&ending.to_ascii_lowercase())
        };
        if cells.is_empty() || !cells.iter().all(is_one) {
            return None;
        }
        let has_all = |name: &&String| {
            let base = folder.path().join(name);
            cells.iter().all(|cell| base.join(cell).is_file())
        };
        let found: Vec<String> = names.iter().filter(has_all).cloned().collect();
        (found.len() > 1).then_some((column, found))
    })
}

/// Line of `[drop]` for rows without a picture name. Recorders that allocate rows in advance leave empty rows at the end.
fn empty_rows(column: &SeenColumn, rows: usize) -> Option<String> {
    (column.empty > 0).then(|| {
        format!(
            "frames_named = [\"\"]   # {} of {rows} rows name no picture\n",
            column.empty
        )
    })
}

/// Lines of `[frame]` for a table whose picture paths begin in a parent folder or on another machine.
fn by_end_of_path(folder: &SourceFolder, main: &SeenTable<'_>) -> Option<FrameLines> {
    let own = folder.path().join(main.group.first());
    let own = taceva_files::parent_of(&own).to_owned();
    let found = main.columns.iter().find_map(|column| {
        let mut cells = column.cells.iter().filter(|cell| !cell.is_empty());
        let first = cells.next()?;
        let ending = first.rsplit_once('.').map_or("", |(_, ending)| ending);
        if !is_picture(&ending.to_ascii_lowercase()) || first.contains('\\') {
            return None;
        }
        let parts: Vec<&str> = first.split('/').collect();
        // The longest end of the path that leads to a file.
        (1..parts.len()).find_map(|above| {
            let end = parts[above..].join("/");
            let base = [&own, folder.path()]
                .into_iter()
                .find(|base| base.join(&end).is_file())?;
            let is_there = |cell: &String| {
                let parts: Vec<&str> = cell.split('/').collect();
                parts.len() > above && base.join(parts[above..].join("/")).is_file()
            };
            let are_there = cells.clone().take(LOOKED_UP).all(is_there);
            are_there.then(|| (column, above, end, base.to_owned()))
        })
    });
    let (column, above, end, base) = found?;
    let inside = base.strip_prefix(folder.path()).unwrap_or(&base);
    let mut folders: Vec<String> = vec![inside.to_string_lossy().into_owned()];
    let (within, _) = end.rsplit_once('/').unwrap_or(("", &end));
    folders.push(within.to_owned());
    folders.retain(|folder| !folder.is_empty());
    folders.push("{path.picture}".to_owned());
    let first = column.cells.iter().find(|cell| !cell.is_empty())?;
    let begin: Vec<&str> = first.split('/').take(above).collect();
    let comment = format!(
        "# A guess: paths in {:?} begin with {:?}, which leads to this folder; the rest of each path names the picture.",
        column.name,
        begin.join("/")
    );
    let one_folder = column
        .cells
        .iter()
        .filter(|cell| !cell.is_empty())
        .all(|cell| {
            cell.rsplit_once('/')
                .is_some_and(|(before, _)| before.ends_with(within))
        });
    if main.group.paths.len() > 1 || !one_folder {
        return Some(FrameLines {
            lines: vec![
                comment,
                format!(
                    "column = \"?\"   # the paths in {:?} are relative to another folder: draft the map of that folder",
                    column.name
                ),
            ],
            is_gray: is_gray(&base.join(&end)),
            ..FrameLines::default()
        });
    }
    let within = match within {
        "" => String::new(),
        within => format!("{within}/"),
    };
    Some(FrameLines {
        lines: vec![
            comment,
            format!("pattern = {:?}", folders.join("/")),
            "folder = \".\"".to_owned(),
        ],
        is_gray: is_gray(&base.join(&end)),
        path: Some(format!(
            "of = {:?}\npattern = {:?}\n",
            column.name,
            format!("{{before:folders}}{within}{{picture}}")
        )),
        drop: empty_rows(column, main.rows),
        ..FrameLines::default()
    })
}

/// Lines of `[frame]` for the pictures of `main`, one entry for each view. Clips are handled separately.
pub(super) fn of(
    folder: &SourceFolder,
    groups: &[FileGroup],
    main: &SeenTable<'_>,
    tables: &[SeenTable<'_>],
) -> Vec<FrameLines> {
    let columns = file_columns(folder, main);
    if let Some(first) = columns.first() {
        let names: Vec<&str> = columns.iter().map(|own| own.column.name.as_str()).collect();
        let views = of_views(&names, |at| in_column(folder, main, columns[at]));
        return match views.is_empty() {
            true => vec![in_column(folder, main, *first)],
            false => views,
        };
    }
    if let Some((column, folders)) = camera_folders(folder, main) {
        let names: Vec<&str> = folders.iter().map(String::as_str).collect();
        let first = column.cells.iter().find(|cell| !cell.is_empty());
        let views = of_views(&names, |at| FrameLines {
            lines: vec![
                format!("column = {:?}", column.name),
                format!("folder = {:?}", folders[at]),
            ],
            is_gray: first
                .is_some_and(|cell| is_gray(&folder.path().join(&folders[at]).join(cell))),
            drop: empty_rows(column, main.rows),
            ..FrameLines::default()
        });
        if !views.is_empty() {
            return views;
        }
    }
    if let Some(lines) = by_end_of_path(folder, main) {
        return vec![lines];
    }
    if !main.pictures.is_empty() {
        return in_table(main);
    }
    let with_pictures =
        |table: &&SeenTable<'_>| table.is_single_array && !table.pictures.is_empty();
    let tables: Vec<&SeenTable<'_>> = tables.iter().filter(with_pictures).collect();
    let beside = |at: usize| {
        let table: &SeenTable<'_> = tables[at];
        let beside = Beside::of(main.group, table.group);
        in_array(&table.pictures[0], Some(beside), &[])
    };
    let names: Vec<&str> = tables.iter().map(|table| table.group.first()).collect();
    let views = of_views(&names, beside);
    match (views.is_empty(), tables.is_empty()) {
        (false, _) => views,
        (true, false) => vec![beside(0)],
        (true, true) => match stems::of(folder, groups, main) {
            Some(lines) => vec![lines],
            None => series::of(folder, groups, main),
        },
    }
}

/// Lines of `[frame]` for each view; empty if `names` are not views of one sample. `lines` writes the lines of the column, folder or file at a
/// position.
pub(super) fn of_views(names: &[&str], lines: impl Fn(usize) -> FrameLines) -> Vec<FrameLines> {
    of_sides(sided(names), lines)
}

/// Lines of `[frame]` for each of the views `sides`; `lines` writes the lines of one view.
fn of_sides(sides: Vec<Sided>, lines: impl Fn(usize) -> FrameLines) -> Vec<FrameLines> {
    let views = sides.into_iter().map(|Sided { at, view }| FrameLines {
        view: Some(view),
        ..lines(at)
    });
    views.collect()
}

/// Lines of `[frame]` for pictures that a column names.
fn in_column(folder: &SourceFolder, main: &SeenTable<'_>, found: FileColumn<'_>) -> FrameLines {
    let FileColumn {
        column,
        is_below_source,
    } = found;
    let mut lines = vec![format!("column = {:?}", column.name)];
    if is_below_source && main.group.first().contains('/') {
        lines.push("folder = \".\"".to_owned());
    }
    let base = match is_below_source {
        true => folder.path().to_owned(),
        false => taceva_files::parent_of(&folder.path().join(main.group.first())).to_owned(),
    };
    let first = column.cells.iter().find(|cell| !cell.is_empty());
    FrameLines {
        lines,
        is_gray: first.is_some_and(|cell| is_gray(&base.join(cell))),
        drop: empty_rows(column, main.rows),
        ..FrameLines::default()
    }
}

/// True if the files of both groups form pairs: the varying parts of their names are equal.
pub(super) fn are_pairs(tables: &FileGroup, files: &FileGroup) -> bool {
    tables.paths.len() > 1
        && files.paths.len() == tables.paths.len()
        && files.parts.names == tables.parts.names
}

/// Line `index` with a gap (`"?"`), for pictures in one file that several tables share. By default each table would begin with the first picture.
pub(super) fn counted_through(tables: &FileGroup) -> String {
    format!(
        "index = \"?\"   # {} tables share this file: name the column that numbers its pictures",
        tables.paths.len()
    )
}

/// Map entries for pictures in files beside the table.
struct Beside {
    /// File name or pattern, as written in the map.
    file: String,
    /// Comment above the line `array`; `None` without a comment.
    comment: Option<String>,
    /// Line that names the picture index of a row, if the index differs from the row number.
    index: Option<String>,
}

impl Beside {
    /// Entries for pictures in `files` that belong to the rows of `tables`.
    fn of(tables: &FileGroup, files: &FileGroup) -> Beside {
        let named = |file: &str, comment: Option<String>| Beside {
            file: file.to_owned(),
            comment,
            index: None,
        };
        let count = files.paths.len();
        // Names of equal length without words sort in the order of their numbers.
        let is_counted = files.parts.words.is_empty()
            && files
                .paths
                .iter()
                .all(|path| path.len() == files.first().len());
        match (files.paths.as_slice(), tables.paths.len()) {
            ([only], 1) => named(only, None),
            ([only], _) => Beside {
                index: Some(counted_through(tables)),
                ..named(only, None)
            },
            _ if are_pairs(tables, files) => named(&files.parts.of_table(), None),
            (_, 1) if is_counted => {
                let comment = format!(
                    "# A guess: rows match the pictures of all {count} files one by one, in the order of the file names."
                );
                named(files.pattern(), Some(comment))
            }
            _ => {
                let comment = format!(
                    "# Pictures are in {count} files, {}: their names do not show which file belongs to which row.",
                    files.pattern()
                );
                named("?", Some(comment))
            }
        }
    }
}

/// True for a file with a grayscale picture. False for an unreadable file, which the import reports.
fn is_gray(path: &Path) -> bool {
    let bytes = read_capped(path, limits::IMAGE_BYTES);
    bytes.is_ok_and(|bytes| decode(&bytes, ChannelOrder::Gray).is_ok())
}

#[cfg(test)]
mod tests;
