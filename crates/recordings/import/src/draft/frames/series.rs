//! Series of pictures whose names differ in a number, such as `cam/gel_00001.png`. A column contains the number, or the number counts the rows.

use std::collections::{BTreeMap, BTreeSet, HashSet};

use super::stems::{may_name, within};
use super::{FrameLines, is_gray, of_views};
use crate::draft::endings::is_picture;
use crate::draft::survey::FileGroup;
use crate::draft::tables::{SeenColumn, SeenTable};
use crate::import::{DIGITS_MAX, whole_number};
use crate::source_folder::SourceFolder;
use taceva_core::counted;

/// Picture, with the digits of the last number in its name.
struct Numbered<'g> {
    digits: &'g str,
    path: &'g str,
}

/// Pictures of a folder whose names differ only in the last number.
struct Series<'g> {
    /// Folder, relative to the source folder.
    base: &'g str,
    /// Parts of the names before and after the number.
    around: [&'g str; 2],
    numbers: BTreeSet<u64>,
    /// Minimum number of digits; 0 for numbers without leading zeros.
    digits: usize,
    first: &'g str,
}

impl<'g> Series<'g> {
    /// All series among `groups`, ordered by folder and name.
    fn all(groups: &'g [FileGroup]) -> Vec<Series<'g>> {
        let mut found: BTreeMap<(&str, [&str; 2]), Vec<Numbered<'_>>> = BTreeMap::new();
        let pictures = groups.iter().filter(|group| is_picture(&group.ending));
        let paths = pictures.flat_map(|group| group.paths.iter().map(String::as_str));
        for path in paths {
            if let Some((base, around, digits)) = parts(path) {
                let files = found.entry((base, around)).or_default();
                files.push(Numbered { digits, path });
            }
        }
        let series = found.into_iter();
        series
            .filter_map(|((base, around), files)| Series::of(base, around, &files))
            .collect()
    }

    /// Series of `files`; `None` for a single file, for repeated numbers and for numbers with too many digits.
    fn of(base: &'g str, around: [&'g str; 2], files: &[Numbered<'g>]) -> Option<Series<'g>> {
        let written = || files.iter().map(|file| file.digits);
        let is_padded = written().any(|digits| digits.len() > 1 && digits.starts_with('0'));
        let least = written().map(str::len).min()?;
        let digits = if is_padded { least } else { 0 };
        let numbers = written().map(|digits_of| {
            let number: u64 = digits_of.parse().ok()?;
            (format!("{number:0digits$}") == digits_of).then_some(number)
        });
        let numbers: BTreeSet<u64> = numbers.collect::<Option<_>>()?;
        let is_series = files.len() > 1 && numbers.len() == files.len() && digits <= DIGITS_MAX;
        is_series.then_some(Series {
            base,
            around,
            numbers,
            digits,
            first: files[0].path,
        })
    }

    /// Least and greatest number of the pictures.
    fn ends(&self) -> (u64, u64) {
        let first = self.numbers.first().copied().unwrap_or_default();
        (first, self.numbers.last().copied().unwrap_or(first))
    }

    /// Path of the pictures, with `*` instead of the number.
    fn glob(&self) -> String {
        let [before, behind] = self.around;
        match self.base {
            "" => format!("{before}*{behind}"),
            base => format!("{base}/{before}*{behind}"),
        }
    }

    /// Text for a comment: number and path of the pictures, first and last number.
    fn words(&self) -> String {
        let (first, last) = self.ends();
        format!(
            "{} pictures {} numbered {first} to {last}",
            self.numbers.len(),
            self.glob()
        )
    }

    /// Line `pattern`, in which `column` stands for the number, with `reason` as a comment.
    fn lines(&self, main: &SeenTable<'_>, column: &str, reason: &str) -> Vec<String> {
        let own = main.group.first();
        let own = own.rsplit_once('/').map_or("", |(own, _)| own);
        let within = within(own, self.base);
        let [before, behind] = self.around;
        let folder = match within.unwrap_or(self.base) {
            "" => String::new(),
            folder => format!("{folder}/"),
        };
        let pattern = format!("{folder}{before}{{{column}}}{behind}");
        let mut lines = vec![format!("pattern = {pattern:?}   # a guess: {reason}")];
        if within.is_none() {
            lines.push("folder = \".\"".to_owned());
        }
        lines
    }

    /// Lines of `[frame]` for pictures whose numbers are in `column`.
    fn of_column(&self, main: &SeenTable<'_>, column: &SeenColumn) -> Vec<String> {
        let are_plain = filled(column)
            .all(|cell| whole_number(cell).is_some_and(|number| number.to_string() == cell));
        let name = match (self.digits, are_plain) {
            (0, true) => column.name.clone(),
            (digits, _) => format!("{}:0{}", column.name, digits.max(1)),
        };
        let reason = format!(
            "{}, and {:?} holds these numbers",
            self.words(),
            column.name
        );
        self.lines(main, &name, &reason)
    }

    /// Lines of `[frame]` for pictures in the order of the rows.
    fn of_rows(&self, main: &SeenTable<'_>) -> Vec<String> {
        let name = match (self.ends().0, self.digits) {
            (0, 0) => "row".to_owned(),
            (0, digits) => format!("row:0{digits}"),
            (first, 0) => format!("row+{first}"),
            (first, digits) => format!("row+{first}:0{digits}"),
        };
        let reason = format!(
            "{} and {} rows: the first row is taken for the first picture",
            self.words(),
            main.rows
        );
        self.lines(main, &name, &reason)
    }

    /// True if `column` contains a different picture number in each row, and every picture belongs to a row. A column that counts the rows is no evidence if
    /// the number of pictures differs.
    fn is_numbered_by(&self, column: &SeenColumn, rows: usize) -> bool {
        let numbers: Option<Vec<u64>> = filled(column).map(whole_number).collect();
        let numbers = numbers.unwrap_or_default();
        let different: HashSet<u64> = numbers.iter().copied().collect();
        // A draft reads the first rows and the last row. Numbers from 1 do not name pictures from 0.
        let last = whole_number(&column.last);
        may_name(column)
            && last.is_none_or(|last| self.numbers.contains(&last))
            && numbers.len() > 1
            && different.len() == numbers.len()
            && different.iter().all(|number| self.numbers.contains(number))
            && self.numbers.len() == rows.saturating_sub(column.empty)
    }

    /// True if there are `rows` pictures, numbered without a gap.
    fn counts(&self, rows: usize) -> bool {
        let (first, last) = self.ends();
        self.numbers.len() == rows
            && (rows as u64).checked_sub(1) == Some(last - first)
            && u32::try_from(first).is_ok()
    }
}

/// Cells of a column that are not empty.
fn filled(column: &SeenColumn) -> impl Iterator<Item = &str> {
    let cells = column.cells.iter().map(String::as_str);
    cells.filter(|cell| !cell.is_empty())
}

/// Splits a path into its folder, the parts of the name before and after the last number, and the digits of that number.
fn parts(path: &str) -> Option<(&str, [&str; 2], &str)> {
    let (base, name) = path.rsplit_once('/').unwrap_or(("", path));
    let (stem, _) = name.rsplit_once('.')?;
    let is_digit = |letter: char| letter.is_ascii_digit();
    let end = stem.rfind(is_digit)? + 1;
    let before = stem[..end].trim_end_matches(is_digit);
    let is_fraction = before.ends_with('.');
    let is_plain = !path.contains(|letter: char| letter.is_control() || "{}".contains(letter));
    (!is_fraction && is_plain).then(|| {
        let digits = &name[before.len()..end];
        (base, [before, &name[end..]], digits)
    })
}

/// Column of `main` that contains the picture numbers of `series`. Prefers a column that counts the rows.
fn column_of<'t>(series: &Series<'_>, main: &'t SeenTable<'_>) -> Option<&'t SeenColumn> {
    let columns = main.columns.iter();
    let columns = columns.filter(|column| series.is_numbered_by(column, main.rows));
    let (counting, others): (Vec<_>, Vec<_>) = columns.partition(|column| is_counting(column));
    counting.into_iter().chain(others).next()
}

/// True if the numbers of `column` count its rows.
fn is_counting(column: &SeenColumn) -> bool {
    let numbers: Vec<u64> = filled(column).filter_map(whole_number).collect();
    let mut pairs = numbers.windows(2);
    pairs.all(|pair| pair[1].checked_sub(pair[0]) == Some(1))
}

/// True if the cells of `column` are different whole numbers, unsorted and with a range below `rows`. Pictures may then have these numbers plus
/// an offset.
fn is_shuffled(column: &SeenColumn, rows: usize) -> bool {
    let numbers: Option<Vec<u64>> = filled(column).map(whole_number).collect();
    let numbers = numbers.filter(|numbers| may_name(column) && !numbers.is_sorted());
    numbers.is_some_and(|numbers| {
        let different: BTreeSet<u64> = numbers.iter().copied().collect();
        let ends = different.last().zip(different.first());
        let span = ends.map(|(last, first)| last - first);
        different.len() == numbers.len() && span.is_some_and(|span| span < rows as u64)
    })
}

/// False if the times or numbers of the rows show that the rows were sorted after the recording.
fn is_in_order(main: &SeenTable<'_>) -> bool {
    let mut columns = main.columns.iter();
    let is_sorted = !columns.any(|column| is_shuffled(column, main.rows));
    is_sorted && are_times_in_order(main)
}

/// False if the times of the rows decrease.
fn are_times_in_order(main: &SeenTable<'_>) -> bool {
    main.time().is_none_or(|time| {
        let times = time.column.cells.iter();
        times
            .filter_map(|cell| cell.parse::<f64>().ok())
            .is_sorted()
    })
}

/// True if a column of `main` contains the numbers of pictures.
pub(super) fn has_column(groups: &[FileGroup], main: &SeenTable<'_>) -> bool {
    main.group.paths.len() == 1
        && Series::all(groups)
            .iter()
            .any(|series| column_of(series, main).is_some())
}

/// Lines of `[frame]` for each view. A column of `main` contains the picture numbers; without such a column, the pictures must be as many as the
/// rows.
pub(super) fn of(
    folder: &SourceFolder,
    groups: &[FileGroup],
    main: &SeenTable<'_>,
) -> Vec<FrameLines> {
    // The numbers may restart in each of several tables.
    if main.group.paths.len() > 1 {
        return Vec::new();
    }
    let all = Series::all(groups);
    let numbered = all.iter().filter_map(|series| {
        let column = column_of(series, main)?;
        let mut lines = series.of_column(main, column);
        // Numbers in another order, such as the numbers of random points, may count no pictures.
        if !is_counting(column) && series.counts(main.rows) && are_times_in_order(main) {
            let in_order = series.of_rows(main).into_iter().take(1);
            lines.extend(in_order.map(|line| format!("# or: {line}")));
        }
        Some((series, lines))
    });
    let mut found: Vec<(&Series<'_>, Vec<String>)> = numbered.collect();
    if found.is_empty() && is_in_order(main) {
        let counted = all.iter().filter(|series| series.counts(main.rows));
        found.extend(counted.map(|series| (series, series.of_rows(main))));
    }
    let lines = |at: usize| {
        let (series, lines) = &found[at];
        FrameLines {
            lines: lines.clone(),
            is_gray: is_gray(&folder.path().join(series.first)),
            ..FrameLines::default()
        }
    };
    let names: Vec<String> = found.iter().map(|(series, _)| series.glob()).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let views = of_views(&names, lines);
    // Folders with numbers may be sessions, and pictures of another session belong to no row.
    let is_numbered = |own: &FrameLines| {
        let view = own.view.as_deref().unwrap_or_default();
        view.ends_with(|letter: char| letter.is_ascii_digit())
    };
    let are_folders = found
        .windows(2)
        .any(|pair| pair[0].0.base != pair[1].0.base);
    let are_sessions = are_folders && views.iter().any(is_numbered);
    if (!views.is_empty() && !are_sessions) || found.is_empty() {
        return views;
    }
    let mut first = lines(0);
    let others = found[1..].iter().map(|(_, lines)| lines);
    let others = others.filter(|lines| lines.len() == first.lines.len());
    let others: Vec<String> = others
        .flat_map(|lines| lines.first())
        .map(|line| format!("# or: {line}"))
        .collect();
    if !others.is_empty() {
        let named = std::mem::replace(&mut first.lines[0], SEVERAL.to_owned());
        first.lines.insert(1, format!("# or: {named}"));
    }
    first.lines.extend(others);
    vec![first]
}

/// Line `pattern` with a gap (`"?"`), for several series that are not views of one sample, such as colour and depth.
const SEVERAL: &str =
    "pattern = \"?\"   # several series fit the rows: name the series of the sensor";

/// Comment of the draft that lists pictures of the folder that belong to no row of `main`.
pub(super) fn none_found(groups: &[FileGroup], main: &SeenTable<'_>) -> String {
    let pictures = groups.iter().filter(|group| is_picture(&group.ending));
    let files: Vec<String> = pictures
        .map(|group| {
            format!(
                "{} {}",
                counted(group.paths.len(), "picture"),
                group.pattern()
            )
        })
        .collect();
    match files.is_empty() {
        true => "# No pictures match the rows of the table.".to_owned(),
        false => format!(
            "# No pictures match the rows of the table. Not joined: {}; the table has {}. Name them by `column` or `pattern` of [frame].",
            files.join(", "),
            counted(main.rows, "row")
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_number_of_a_name_is_its_number_unless_it_is_a_fraction() {
        assert_eq!(
            parts("cam/gel_00001.png"),
            Some(("cam", ["gel_", ".png"], "00001"))
        );
        assert_eq!(
            parts("run2_7_left.jpg"),
            Some(("", ["run2_", "_left.jpg"], "7"))
        );
        assert_eq!(parts("x0.5.png"), None);
        assert_eq!(parts("a{1}.png"), None);
        assert_eq!(parts("rest.png"), None);
    }
}
