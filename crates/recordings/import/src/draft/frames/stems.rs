//! Columns whose cells are the names of pictures without their ending: `000012` for `000012.png`.

use std::collections::{BTreeMap, HashSet};

use super::{FrameLines, LOOKED_UP, empty_rows, is_gray, is_picture};
use crate::draft::roles::Role;
use crate::draft::survey::FileGroup;
use crate::draft::tables::{SeenColumn, SeenTable};
use crate::source_folder::SourceFolder;

/// Frame lines for pictures whose names without their ending are the cells of a column.
pub(super) fn of(
    folder: &SourceFolder,
    groups: &[FileGroup],
    main: &SeenTable<'_>,
) -> Option<FrameLines> {
    let own = main
        .group
        .first()
        .rsplit_once('/')
        .map_or("", |(own, _)| own);
    stems(groups)
        .into_iter()
        .find_map(|((base, ending), stems)| {
            // Each of several tables has its pictures in its own folder.
            let within = match own {
                "" => Some(base),
                own if base == own => Some(""),
                own => base
                    .strip_prefix(own)
                    .and_then(|rest| rest.strip_prefix('/')),
            };
            if within.is_none() && main.group.paths.len() > 1 {
                return None;
            }
            let column = main.columns.iter().find(|column| names(column, &stems))?;
            let first = column.cells.iter().find(|cell| !cell.is_empty())?;
            let before = match within.unwrap_or(base) {
                "" => String::new(),
                before => format!("{before}/"),
            };
            let mut lines = vec![format!(
                "pattern = {:?}   # a guess: the cells are names of pictures without `.{ending}`",
                format!("{before}{{{}}}.{ending}", column.name)
            )];
            if within.is_none() {
                lines.push("folder = \".\"".to_owned());
            }
            let picture = folder.path().join(base).join(format!("{first}.{ending}"));
            Some(FrameLines {
                lines,
                is_gray: is_gray(&picture),
                drop: empty_rows(column, main.rows),
                ..FrameLines::default()
            })
        })
}

/// Names of the pictures without their ending, by folder and ending.
fn stems(groups: &[FileGroup]) -> BTreeMap<(&str, &str), HashSet<&str>> {
    let mut found: BTreeMap<(&str, &str), HashSet<&str>> = BTreeMap::new();
    let pictures = groups.iter().filter(|group| is_picture(&group.ending));
    for path in pictures.flat_map(|group| &group.paths) {
        let (base, name) = path.rsplit_once('/').unwrap_or(("", path));
        if let Some((stem, ending)) = name.rsplit_once('.') {
            found.entry((base, ending)).or_default().insert(stem);
        }
    }
    found
}

/// True if each cell of `column` is another one of `stems`.
fn names(column: &SeenColumn, stems: &HashSet<&str>) -> bool {
    let may_name = matches!(
        column.role,
        Role::Attribute | Role::Index | Role::Number | Role::Other
    ) && !column.name.contains(['{', '}']);
    let cells = column.cells.iter().filter(|cell| !cell.is_empty());
    let cells: Vec<&str> = cells.map(String::as_str).take(LOOKED_UP).collect();
    let different: HashSet<&str> = cells.iter().copied().collect();
    may_name
        && cells.len() > 1
        && different.len() == cells.len()
        && cells.iter().all(|cell| stems.contains(cell))
}
