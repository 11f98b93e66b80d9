//! Where the frames of a table seem to be.

use std::path::Path;

use super::path_parts::PathParts;
use super::roles::Role;
use super::survey::FileGroup;
use super::tables::{SeenColumn, SeenTable};
use crate::decode::{ChannelOrder, decode};
use crate::file::{SourceFolder, read_capped};
use crate::foreign::{PictureColumn, PictureKind};
use crate::limits;

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
    /// Of clips beside tables of several files: what their names share with those of the tables.
    pub(super) path: Option<PathParts>,
}

/// The column whose cells name pictures, and whether they are relative to the folder itself and not to that of the table.
pub(super) fn file_column<'t>(
    folder: &SourceFolder,
    table: &'t SeenTable<'_>,
) -> Option<(&'t SeenColumn, bool)> {
    let own = folder.path().join(table.group.first());
    let own = taceva_durable::parent_of(&own);
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
    (main, tables): (&SeenTable<'_>, &[SeenTable<'_>]),
) -> Option<FrameLines> {
    if let Some((column, is_below_source)) = file_column(folder, main) {
        let mut lines = vec![format!("column = {:?}", column.name)];
        if is_below_source && main.group.first().contains('/') {
            lines.push("folder = \".\"".to_owned());
        }
        let base = match is_below_source {
            true => folder.path().to_owned(),
            false => taceva_durable::parent_of(&folder.path().join(main.group.first())).to_owned(),
        };
        let first = column.cells.iter().find(|cell| !cell.is_empty());
        return Some(FrameLines {
            lines,
            is_gray: first.is_some_and(|cell| is_gray(&base.join(cell))),
            path: None,
        });
    }
    if let Some(picture) = main.pictures.first() {
        return Some(in_array(picture, None, &main.pictures[1..]));
    }
    let with_pictures =
        |table: &&SeenTable<'_>| table.is_single_array && !table.pictures.is_empty();
    if let Some(table) = tables.iter().find(with_pictures) {
        return Some(in_array(&table.pictures[0], Some(table.group.first()), &[]));
    }
    let clips = groups.iter().find(|group| is_clip(&group.ending))?;
    let index = main
        .columns
        .iter()
        .find(|column| column.role == Role::Index);
    let index = format!(
        "index = {:?}",
        index.map_or("row", |column| column.name.as_str())
    );
    if let [only] = clips.paths.as_slice() {
        return Some(FrameLines {
            lines: vec![format!("video = {only:?}"), index],
            ..FrameLines::default()
        });
    }
    // A clip a table: what varies in the names of both is the same.
    let parts = &main.group.parts;
    let are_pairs = clips.parts.names == parts.names && clips.paths.len() == main.group.paths.len();
    let plain = |pattern: &str| pattern.replace(":digits}", "}").replace(":number}", "}");
    are_pairs.then(|| FrameLines {
        lines: vec![
            format!(
                "video = {:?}",
                plain(&clips.parts.pattern).replace('{', "{path.")
            ),
            index,
        ],
        is_gray: false,
        path: Some(parts.clone()),
    })
}

/// Whether a file holds a picture without colours. What cannot be read is named by the import.
fn is_gray(path: &Path) -> bool {
    let bytes = read_capped(path, limits::IMAGE_BYTES);
    bytes.is_ok_and(|bytes| decode(&bytes, ChannelOrder::Gray).is_ok())
}

fn in_array(picture: &PictureColumn, file: Option<&str>, others: &[PictureColumn]) -> FrameLines {
    let name = &picture.name;
    let mut lines: Vec<String> = match others {
        [] => Vec::new(),
        others => {
            let others: Vec<&str> = others.iter().map(|other| other.name.as_str()).collect();
            vec![format!("# or: {}", others.join(", "))]
        }
    };
    let mut is_gray = false;
    match (&picture.kind, file) {
        (PictureKind::Clip, _) => lines.push(format!("video = {name:?}")),
        (PictureKind::Encoded, _) => lines.push(format!("bytes = {name:?}")),
        (PictureKind::Array { .. }, None) => lines.push(format!("array = {name:?}")),
        (PictureKind::Array { .. }, Some(file)) => {
            lines.push(format!("array = {{ file = {file:?} }}"))
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
    FrameLines {
        lines,
        is_gray,
        path: None,
    }
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
}
