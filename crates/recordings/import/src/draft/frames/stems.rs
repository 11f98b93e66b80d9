//! Columns whose cells are picture names without the filename extension: `000012` for `000012.png`.

use std::collections::{BTreeMap, HashSet};

use super::{FrameLines, empty_rows, is_gray};
use crate::draft::endings::is_picture;
use crate::draft::roles::Role;
use crate::draft::survey::FileGroup;
use crate::draft::tables::{SeenColumn, SeenTable};
use crate::source_folder::SourceFolder;

/// Column whose cells name the pictures of a folder.
struct Match<'t> {
    /// Folder of the pictures relative to the folder of the table; `None` if the pictures are outside the folder of the table.
    within: Option<&'t str>,
    /// Folder of the pictures relative to the source folder.
    base: &'t str,
    ending: &'t str,
    column: &'t SeenColumn,
}

impl Match<'_> {
    fn pattern(&self) -> String {
        let before = match self.within.unwrap_or(self.base) {
            "" => String::new(),
            before => format!("{before}/"),
        };
        format!("{before}{{{}}}.{}", self.column.name, self.ending)
    }
}

/// Lines of `[frame]` for pictures whose names without the extension are the cells of a column. Prefers pictures below the folder of the table.
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
    let stems = stems(groups);
    let mut found: Vec<Match<'_>> = Vec::new();
    for (&(base, ending), stems) in &stems {
        let within = within(own, base);
        // Each of several tables has its pictures in its own folder.
        if within.is_none() && main.group.paths.len() > 1 {
            continue;
        }
        let columns = main.columns.iter();
        let columns = columns.filter(|column| names(column, stems, main.rows));
        found.extend(columns.map(|column| Match {
            within,
            base,
            ending,
            column,
        }));
    }
    found.sort_by_key(|one| one.within.is_none());
    let (best, others) = found.split_first()?;
    let first = best.column.cells.iter().find(|cell| !cell.is_empty())?;
    let mut lines = vec![format!(
        "pattern = {:?}   # a guess: the cells are names of pictures without `.{}`",
        best.pattern(),
        best.ending
    )];
    if best.within.is_none() {
        lines.push("folder = \".\"".to_owned());
    }
    let others = others
        .iter()
        .filter(|other| other.within.is_none() == best.within.is_none());
    lines.extend(others.map(|other| format!("# or: pattern = {:?}", other.pattern())));
    let picture = folder
        .path()
        .join(best.base)
        .join(format!("{first}.{}", best.ending));
    Some(FrameLines {
        lines,
        is_gray: is_gray(&picture),
        drop: empty_rows(best.column, main.rows),
        ..FrameLines::default()
    })
}

/// Folder `base` relative to the folder `own`; `None` if `base` is outside `own`.
pub(super) fn within<'b>(own: &str, base: &'b str) -> Option<&'b str> {
    match own {
        "" => Some(base),
        own if base == own => Some(""),
        own => base
            .strip_prefix(own)
            .and_then(|rest| rest.strip_prefix('/')),
    }
}

/// True if the cells of `column` may name files.
pub(super) fn may_name(column: &SeenColumn) -> bool {
    let is_free = matches!(
        column.role,
        Role::Attribute | Role::Index | Role::Number | Role::Other
    );
    is_free && !column.name.contains(['{', '}'])
}

/// Names of the pictures without their extension, by folder and extension.
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

/// True if each cell of `column` is a different element of `stems`. Plain numbers may only count the rows of a log. They count as names only if `rows` pictures
/// have plain numbers as names.
fn names(column: &SeenColumn, stems: &HashSet<&str>, rows: usize) -> bool {
    let cells = column.cells.iter().filter(|cell| !cell.is_empty());
    let cells: Vec<&str> = cells.map(String::as_str).collect();
    let different: HashSet<&str> = cells.iter().copied().collect();
    let is_count = |text: &&str| {
        let number: Result<u64, _> = text.parse();
        number.is_ok_and(|number| number.to_string() == **text)
    };
    let are_as_many = || {
        let numbered = stems.iter().filter(|stem| is_count(stem)).count();
        numbered == rows.saturating_sub(column.empty)
    };
    may_name(column)
        && cells.len() > 1
        && (column.last.is_empty() || stems.contains(column.last.as_str()))
        && different.len() == cells.len()
        && cells.iter().all(|cell| stems.contains(cell))
        && (!cells.iter().all(is_count) || are_as_many())
}
