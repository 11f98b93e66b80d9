//! Where the frames of a table seem to be.

use std::path::Path;

use super::roles::Role;
use super::survey::FileGroup;
use super::tables::{SeenColumn, SeenTable};
use crate::foreign::{PictureColumn, PictureKind};
use crate::source_folder::SourceFolder;
use taceva_dataset::ChannelOrder;
use taceva_dataset::internal::{decode, limits, read_capped};

/// How many cells of a column are looked up as files.
const LOOKED_UP: usize = 20;

pub(super) fn is_picture(ending: &str) -> bool {
    matches!(ending, "png" | "jpg" | "jpeg" | "tif" | "tiff")
}

pub(super) fn is_clip(ending: &str) -> bool {
    matches!(ending, "avi" | "mp4" | "mkv" | "mov" | "webm")
}

/// The lines of `[frame]`, with their comments.
#[derive(Debug, Default)]
pub(super) struct FrameLines {
    pub(super) lines: Vec<String>,
    pub(super) is_gray: bool,
}

/// The column whose cells name pictures, and whether they are relative to the folder itself and not to that of the table.
pub(super) fn file_column<'t>(
    folder: &SourceFolder,
    table: &'t SeenTable<'_>,
) -> Option<(&'t SeenColumn, bool)> {
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
    table.columns.iter().find_map(|column| {
        let is_own = names_files(column, own);
        (is_own || names_files(column, folder.path())).then_some((column, !is_own))
    })
}

/// Where the frames are.
pub(super) fn of(
    folder: &SourceFolder,
    groups: &[FileGroup],
    main: &SeenTable<'_>,
    tables: &[SeenTable<'_>],
) -> Option<FrameLines> {
    if let Some((column, is_below_source)) = file_column(folder, main) {
        let mut lines = vec![format!("column = {:?}", column.name)];
        if is_below_source && main.group.first().contains('/') {
            lines.push("folder = \".\"".to_owned());
        }
        let base = match is_below_source {
            true => folder.path().to_owned(),
            false => taceva_files::parent_of(&folder.path().join(main.group.first())).to_owned(),
        };
        let first = column.cells.iter().find(|cell| !cell.is_empty());
        return Some(FrameLines {
            lines,
            is_gray: first.is_some_and(|cell| is_gray(&base.join(cell))),
        });
    }
    if let Some(picture) = main.pictures.first() {
        return Some(in_array(picture, None, &main.pictures[1..]));
    }
    let with_pictures =
        |table: &&SeenTable<'_>| table.is_single_array && !table.pictures.is_empty();
    if let Some(table) = tables.iter().find(with_pictures) {
        let beside = Beside::of(main.group, table.group);
        return Some(in_array(&table.pictures[0], Some(beside), &[]));
    }
    let clips = groups.iter().find(|group| is_clip(&group.ending))?;
    let index = main
        .columns
        .iter()
        .find(|column| column.role == Role::Index);
    let index = index.map_or("row", |column| column.name.as_str());
    let (file, index) = match clips.paths.as_slice() {
        [only] if main.group.paths.len() == 1 => (only.clone(), format!("index = {index:?}")),
        [only] => (only.clone(), counted_through(main.group)),
        // A clip a table.
        _ if are_pairs(main.group, clips) => (clips.parts.of_table(), format!("index = {index:?}")),
        _ => return None,
    };
    Some(FrameLines {
        lines: vec![format!("video = {file:?}"), index],
        is_gray: false,
    })
}

/// Whether there is one of `files` for each of `tables`: what varies in the names of both is the same.
fn are_pairs(tables: &FileGroup, files: &FileGroup) -> bool {
    tables.paths.len() > 1
        && files.paths.len() == tables.paths.len()
        && files.parts.names == tables.parts.names
}

/// The line of pictures in one file for several tables: each of these would begin with the first picture again.
fn counted_through(tables: &FileGroup) -> String {
    format!(
        "index = \"?\"   # {} tables share it: the column that counts through its pictures",
        tables.paths.len()
    )
}

/// Pictures in files of their own.
struct Beside {
    /// The file, as a map names it for each table.
    file: String,
    /// What is to be said before it.
    comment: Option<String>,
    /// The line that says which picture a row has, where that is not the one of its own number.
    index: Option<String>,
}

impl Beside {
    /// The pictures in `files` for the rows of `tables`.
    fn of(tables: &FileGroup, files: &FileGroup) -> Beside {
        let named = |file: &str, comment: Option<String>| Beside {
            file: file.to_owned(),
            comment,
            index: None,
        };
        let count = files.paths.len();
        // Only then names that are sorted are in the order of their numbers.
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
                    "# A guess: the rows count through the pictures of all {count} files, in the order of their names."
                );
                named(files.pattern(), Some(comment))
            }
            _ => {
                let comment = format!(
                    "# Pictures are in {count} files, {}: which of them those of a row are in, their names do not say.",
                    files.pattern()
                );
                named("?", Some(comment))
            }
        }
    }
}

/// Whether a file holds a picture without colours. What cannot be read is named by the import.
fn is_gray(path: &Path) -> bool {
    let bytes = read_capped(path, limits::IMAGE_BYTES);
    bytes.is_ok_and(|bytes| decode(&bytes, ChannelOrder::Gray).is_ok())
}

fn in_array(
    picture: &PictureColumn,
    beside: Option<Beside>,
    others: &[PictureColumn],
) -> FrameLines {
    let name = &picture.name;
    let mut lines: Vec<String> = match others {
        [] => Vec::new(),
        others => {
            let others: Vec<&str> = others.iter().map(|other| other.name.as_str()).collect();
            vec![format!("# or: {}", others.join(", "))]
        }
    };
    let mut is_gray = false;
    match (&picture.kind, beside) {
        (PictureKind::Clip, _) => lines.push(format!("video = {name:?}")),
        (PictureKind::Encoded, _) => lines.push(format!("bytes = {name:?}")),
        (PictureKind::Array { .. }, None) => lines.push(format!("array = {name:?}")),
        (PictureKind::Array { .. }, Some(beside)) => {
            lines.extend(beside.comment);
            lines.push(format!("array = {{ file = {:?} }}", beside.file));
            lines.extend(beside.index);
        }
    }
    if let PictureKind::Array {
        is_gray: gray,
        is_planar,
        range,
    } = &picture.kind
    {
        is_gray = *gray;
        if *is_planar {
            lines.push("layout = \"nchw\"".to_owned());
        }
        if let Some([least, greatest]) = range {
            let (black, full) = guessed_range(*least, *greatest);
            lines.push(format!("# The first frames have numbers from {least} to {greatest}: which is black, which is full?"));
            lines.push(format!("range = [{black}, {full}]"));
            lines.push("bits = 8".to_owned());
        }
    }
    FrameLines { lines, is_gray }
}

/// The range that pictures of such numbers mostly have: 0 to 1, −1 to 1 or 0 to 255.
fn guessed_range(least: f64, greatest: f64) -> (f64, f64) {
    match (least, greatest) {
        (least, greatest) if least >= 0.0 && greatest <= 1.0 => (0.0, 1.0),
        (least, greatest) if least >= -1.0 && greatest <= 1.0 => (-1.0, 1.0),
        (least, greatest) if least >= 0.0 && greatest <= 255.0 => (0.0, 255.0),
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_is_guessed_by_what_pictures_are_mostly_kept_in() {
        assert_eq!(guessed_range(0.1, 0.9), (0.0, 1.0));
        assert_eq!(guessed_range(-0.5, 0.9), (-1.0, 1.0));
        assert_eq!(guessed_range(3.0, 250.0), (0.0, 255.0));
        assert_eq!(guessed_range(-2048.0, 2032.0), (-2048.0, 2032.0));
    }

    fn group(paths: &[&str]) -> FileGroup {
        FileGroup {
            paths: paths.iter().map(|path| (*path).to_owned()).collect(),
            ending: "npy".to_owned(),
            parts: super::super::path_parts::varying(paths).expect("of one depth"),
        }
    }

    #[test]
    fn each_of_several_tables_has_the_array_beside_it_and_of_one_array_the_index_is_open() {
        let of = |tables: &[&str], files: &[&str]| {
            let found = Beside::of(&group(tables), &group(files));
            (found.file, found.comment.is_some(), found.index.is_some())
        };
        let sessions = ["s0/force.npy", "s1/force.npy", "s12/force.npy"];
        assert_eq!(
            of(
                &sessions,
                &["s0/frames.npy", "s1/frames.npy", "s12/frames.npy"]
            ),
            ("s{path.s}/frames.npy".to_owned(), false, false)
        );
        assert_eq!(
            of(&sessions, &["frames.npy"]),
            ("frames.npy".to_owned(), false, true)
        );
        // Which of two belongs to which of three?
        assert_eq!(
            of(&sessions, &["s0/frames.npy", "s1/frames.npy"]),
            ("?".to_owned(), true, false)
        );
        let one = ["force.npy"];
        assert_eq!(
            of(&one, &["frames.npy"]),
            ("frames.npy".to_owned(), false, false)
        );
        assert_eq!(
            of(&one, &["frames_00.npy", "frames_01.npy"]),
            ("frames_*.npy".to_owned(), true, false)
        );
        // Sorted, 10 stands before 2.
        assert_eq!(
            of(&one, &["frames_10.npy", "frames_2.npy"]),
            ("?".to_owned(), true, false)
        );
    }
}
