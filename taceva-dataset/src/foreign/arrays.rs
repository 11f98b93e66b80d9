//! Arrays as tables: a row is what the arrays hold at one place of their first axis.

mod cells;
mod form;
mod frames;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use taceva_arrays::{ArrayError, ArrayFile, ArrayFormat, ArrayInfo, Element, Problem};

use super::columns::{ColumnSource, PictureColumn, Stated};
use super::pictures::Pictures;
use crate::import::{FrameNames, OWN_ROW};
use crate::limits;
use crate::text::listed;
use cells::Texts;
pub(crate) use frames::ArrayPictures;

/// The most bytes that a column may take in memory as text.
const COLUMN_BYTES: u64 = 1 << 30;
/// The most values of a cell that holds a whole array.
const CELL_VALUES: u64 = 1 << 16;
/// Arrays that a draft looks into for pictures.
const LISTED: usize = 64;

/// The rows of a file of arrays, of one group or several.
#[derive(Debug)]
pub(crate) struct ArrayRows {
    path: PathBuf,
    file: Arc<ArrayFile>,
    /// The groups whose arrays are columns, or the table itself of an HDF5 table; one without a name where the file has none.
    groups: Vec<Group>,
    /// Whether the file is one row, each array of it a cell.
    is_whole: bool,
}

#[derive(Debug)]
struct Group {
    path: String,
    rows: usize,
}

impl ArrayRows {
    /// The arrays of the groups that `rows` names, or of the whole file.
    pub(super) fn open(
        path: &Path,
        format: ArrayFormat,
        rows: Option<&str>,
    ) -> Result<ArrayRows, String> {
        let file = ArrayFile::open(path, format).map_err(problem)?;
        let paths = match rows {
            None | Some("" | "/") => vec![String::new()],
            Some(pattern) => {
                file.check_groups(pattern).map_err(problem)?;
                match file.groups(pattern) {
                    found if found.is_empty() => vec![pattern.trim_end_matches('/').to_owned()],
                    found => found,
                }
            }
        };
        let groups: Result<Vec<Group>, String> = paths
            .into_iter()
            .map(|path| {
                let rows = rows_of(&file, &path)?;
                Ok(Group { path, rows })
            })
            .collect();
        Ok(ArrayRows {
            path: path.to_owned(),
            groups: groups?,
            file: Arc::new(file),
            is_whole: false,
        })
    }

    /// The file as one row.
    pub(super) fn whole(path: &Path, format: ArrayFormat) -> Result<ArrayRows, String> {
        let file = ArrayFile::open(path, format).map_err(problem)?;
        let whole = Group {
            path: String::new(),
            rows: 1,
        };
        Ok(ArrayRows {
            path: path.to_owned(),
            groups: vec![whole],
            file: Arc::new(file),
            is_whole: true,
        })
    }

    /// A whole array as one cell.
    fn whole_cell(&self, path: &str, info: &ArrayInfo) -> Result<String, String> {
        let elements = info
            .shape
            .iter()
            .try_fold(1_u64, |product, side| product.checked_mul(*side));
        let elements = elements.unwrap_or(u64::MAX);
        if elements > CELL_VALUES {
            return Err(format!(
                "{elements} values, more than the {CELL_VALUES} that a cell holds; without `whole = true` each of them along the first axis is a row"
            ));
        }
        let read = self.file.read(path, 0..info.rows()).map_err(problem)?;
        let sides = info.shape.iter().map(|side| usize::try_from(*side));
        let shape: Result<Vec<usize>, _> = sides.collect();
        let shape = shape.map_err(|error| error.to_string())?;
        Ok(Texts(&read.values).packed(0, &shape))
    }

    /// The array of a group that the map calls `name`.
    fn info(&self, group: &Group, name: &str) -> Option<(String, &ArrayInfo)> {
        candidates(&group.path, name)
            .into_iter()
            .find_map(|path| self.file.info(&path).map(|info| (path, info)))
    }

    fn attribute(&self, group: &Group, name: &str) -> Option<String> {
        let (owner, attribute) = name.rsplit_once('@')?;
        let owner = owner.trim_end_matches('/');
        let owner = match owner {
            "" => group.path.clone(),
            _ => format!("{}/{owner}", group.path),
        };
        let owner = if owner.is_empty() { "/" } else { &owner };
        self.file.attribute(owner, attribute)
    }

    fn cells(&self, group: &Group, name: &str) -> Result<Vec<String>, String> {
        if let Some(text) = self.attribute(group, name) {
            return Ok(vec![text; group.rows]);
        }
        if name == "group" && !group.path.is_empty() {
            let between = if group.path.contains('/') { '/' } else { '.' };
            let last = group.path.rsplit(between).next().unwrap_or_default();
            return Ok(vec![last.to_owned(); group.rows]);
        }
        let (path, info) = self
            .info(group, name)
            .ok_or_else(|| format!("there is no array of this name in `{}`", group.path))?;
        if self.is_whole {
            return self.whole_cell(&path, info).map(|cell| vec![cell]);
        }
        let across = info.row_elements().ok_or("larger than any memory")?;
        if across.saturating_mul(info.rows()) > COLUMN_BYTES / 8 {
            return Err(format!(
                "{} rows of {across} values are no labels: `[frame] array = \"{name}\"` reads frames",
                info.rows()
            ));
        }
        let is_scalar = info.shape.is_empty() || (info.rows() == 1 && group.rows != 1);
        if !is_scalar && info.rows() != group.rows as u64 {
            return Err(format!(
                "{} values along its first axis, where the other arrays have {}",
                info.rows(),
                group.rows
            ));
        }
        let read = self.file.read(&path, 0..info.rows()).map_err(problem)?;
        let sides = info.shape.iter().skip(1);
        let shape: Result<Vec<usize>, _> = sides.map(|side| usize::try_from(*side)).collect();
        let shape = shape.map_err(|error| error.to_string())?;
        let texts = Texts(&read.values);
        let width = usize::try_from(across).map_err(|error| error.to_string())?;
        let cell = |row: usize| texts.packed(row * width, &shape);
        Ok(match is_scalar {
            true => vec![cell(0); group.rows],
            false => (0..group.rows).map(cell).collect(),
        })
    }
}

impl ColumnSource for ArrayRows {
    fn rows(&self) -> usize {
        self.groups.iter().map(|group| group.rows).sum()
    }

    fn names(&self) -> Vec<String> {
        let Some(group) = self.groups.first() else {
            return Vec::new();
        };
        let length = group.rows as u64;
        let named = |name: String| match name.strip_prefix(&group.path) {
            _ if group.path.is_empty() => Some(name.trim_start_matches('/').to_owned()),
            Some(rest) if rest.starts_with(['/', '.']) => Some(rest[1..].to_owned()),
            // As long as the table, and named from the root.
            _ => {
                (self.file.info(&name)?.rows() == length && self.groups.len() == 1).then_some(name)
            }
        };
        let names = self.file.names().into_iter();
        let attributes = match group.path.as_str() {
            "" => Vec::new(),
            path => self.file.attributes(path),
        };
        let attributes = attributes.into_iter().map(|name| format!("@{name}"));
        names.filter_map(named).chain(attributes).collect()
    }

    fn has(&self, name: &str) -> bool {
        let of = |group: &Group| {
            self.info(group, name).is_some() || self.attribute(group, name).is_some()
        };
        match name {
            "group" if self.groups.iter().any(|group| !group.path.is_empty()) => true,
            _ => self.groups.first().is_some_and(of),
        }
    }

    fn columns(&self, names: &[&str]) -> Result<Vec<Vec<String>>, String> {
        let of = |name: &&str| {
            // As many as are read: what a file states may be any number.
            let mut cells = Vec::new();
            for group in &self.groups {
                cells.extend(self.cells(group, name)?);
            }
            Ok(cells)
        };
        let named =
            |name: &&str| of(name).map_err(|problem: String| format!("`{name}`: {problem}"));
        match names {
            [only] => Ok(vec![of(only)?]),
            several => several.iter().map(named).collect(),
        }
    }

    fn holds_integers(&self, name: &str) -> bool {
        self.groups.iter().all(|group| {
            // An attribute of this name comes first, and is a text.
            let array = match self.attribute(group, name) {
                Some(_) => None,
                None => self.info(group, name),
            };
            array.is_some_and(|(_, info)| {
                matches!(info.element, Element::Unsigned(_) | Element::Signed(_))
            })
        })
    }

    fn stated(&self, name: &str) -> Vec<Stated> {
        let groups = self.groups.iter();
        let paths = groups.filter_map(|group| Some(self.info(group, name)?.0));
        let mut all: Vec<Stated> = paths.map(|path| stated(&self.file, &path)).collect();
        all.dedup();
        all
    }

    fn why_absent(&self, name: &str) -> Option<String> {
        let group = self.groups.first()?;
        let paths = candidates(&group.path, name).into_iter();
        let mut found = paths.filter_map(|path| self.file.find(&path).err());
        let error = found.find(|error| !matches!(error.problem, Problem::Absent { .. }))?;
        Some(problem(error))
    }

    fn unread(&self) -> Vec<String> {
        let links = self.file.dead_links().into_iter();
        links.map(|(_, reason)| reason).collect()
    }

    fn absent_chunks(&self, names: &[&str]) -> Result<Vec<(String, u64)>, String> {
        let mut arrays: Vec<String> = self
            .groups
            .iter()
            .flat_map(|group| names.iter().filter_map(|name| self.info(group, name)))
            .map(|(path, _)| path)
            .collect();
        arrays.sort_unstable();
        arrays.dedup();
        absent_chunks(&self.file, arrays.iter().map(String::as_str))
    }

    fn picture_columns(&self) -> Vec<PictureColumn> {
        let Some(group) = self.groups.first() else {
            return Vec::new();
        };
        let seems = |name: String| {
            let (path, info) = self.info(group, &name)?;
            let kind = form::kind_of(&self.file, &path, info)?;
            Some(PictureColumn { name, kind })
        };
        let names = self.names().into_iter().take(LISTED);
        names.filter_map(seems).collect()
    }

    fn pictures(&self, names: &FrameNames) -> Result<Arc<dyn Pictures>, String> {
        if let FrameNames::Array(array) = names
            && self.groups.len() > 1
            && !["row", OWN_ROW].contains(&array.index.as_str())
        {
            return Err(format!(
                "`index = \"{}\"` counts in which of the {} groups? A row of a group has the picture of its own place: leave `index` out",
                array.index,
                self.groups.len()
            ));
        }
        let name = match names {
            FrameNames::Array(array) => array.path.as_deref().unwrap_or("value"),
            FrameNames::Bytes(column) => column,
            _ => return Err("frames of another kind than arrays or bytes".to_owned()),
        };
        let parts: Result<Vec<String>, String> = self
            .groups
            .iter()
            .map(|group| {
                let found = self.info(group, name);
                let pictures = found.as_ref().map_or(0, |(_, info)| info.rows());
                // Otherwise the pictures of the groups behind it would be those of other rows.
                if self.groups.len() > 1 && found.is_some() && pictures != group.rows as u64 {
                    return Err(format!(
                        "`{name}` of {} has {pictures} pictures for {} rows",
                        group.path, group.rows
                    ));
                }
                found.map(|(path, _)| path).ok_or_else(|| {
                    self.why_absent(name).unwrap_or_else(|| {
                        format!(
                            "there is no array `{name}` for the frames in {}; there are {}",
                            match group.path.as_str() {
                                "" => "it",
                                path => path,
                            },
                            listed(&self.names())
                        )
                    })
                })
            })
            .collect();
        let pictures = ArrayPictures::new((&self.path, Arc::clone(&self.file)), parts?, names)?;
        Ok(Arc::new(pictures))
    }
}

/// What packed numbers are multiplied by and what is added, where they are not packed.
const UNPACKED: [f64; 2] = [1.0, 0.0];

/// The arrays that `name` may mean in a group: one of the group, a field of the table, one named from the root.
fn candidates(group: &str, name: &str) -> Vec<String> {
    let bare = name.trim_start_matches('/');
    let mut paths = Vec::new();
    if name.starts_with('/') {
        paths.push(format!("/{bare}"));
    }
    paths.extend([
        format!("{group}/{bare}"),
        format!("{group}.{bare}"),
        bare.to_owned(),
    ]);
    paths
}

/// The rows of a group: the length of the first axis that most of its arrays have, the longest of several.
fn rows_of(file: &ArrayFile, group: &str) -> Result<usize, String> {
    let mut lengths: BTreeMap<u64, usize> = BTreeMap::new();
    let names = file.names();
    let inside = names.iter().filter(|name| {
        group.is_empty()
            || *name == group
            || name
                .strip_prefix(group)
                .is_some_and(|rest| rest.starts_with(['/', '.']))
    });
    for info in inside.filter_map(|name| file.info(name)) {
        if !info.shape.is_empty() {
            *lengths.entry(info.rows()).or_default() += 1;
        }
    }
    let most = lengths
        .iter()
        .max_by_key(|(length, count)| (**count, **length));
    match most {
        Some((length, _)) if *length > limits::ROWS => Err(format!(
            "{length} rows, more than the {} that are accepted",
            limits::ROWS
        )),
        Some((length, _)) => usize::try_from(*length).map_err(|error| error.to_string()),
        None => Err(format!(
            "no array with rows {}; there are {}",
            match group {
                "" => "in it".to_owned(),
                group => format!("in `{group}`"),
            },
            match names.is_empty() {
                true => "none that is read".to_owned(),
                false => listed(&names),
            }
        )),
    }
}

/// What a file says of the numbers in an array.
pub(crate) fn stated(file: &ArrayFile, array: &str) -> Stated {
    let said = |attribute: &str| file.attribute(array, attribute);
    let number = |attribute: &str| said(attribute)?.trim_matches(['[', ']']).parse().ok();
    let packed = [number("scale_factor"), number("add_offset")];
    let is_packed = packed.iter().any(Option::is_some);
    let packed = [packed[0].unwrap_or(1.0), packed[1].unwrap_or(0.0)];
    Stated {
        unit: said("unit").or_else(|| said("units")),
        packed: (is_packed && packed != UNPACKED).then_some(packed),
    }
}

/// The arrays of which some chunks were never written, and how many these are.
fn absent_chunks<'n>(
    file: &ArrayFile,
    names: impl Iterator<Item = &'n str>,
) -> Result<Vec<(String, u64)>, String> {
    let counted = names.map(|name| {
        let count = file.absent_chunks(name).map_err(problem)?;
        Ok((name.to_owned(), count))
    });
    let counted: Result<Vec<(String, u64)>, String> = counted.collect();
    let mut counted = counted?;
    counted.retain(|(_, count)| *count > 0);
    Ok(counted)
}

/// What is wrong, without the path of the file: the error around it names that.
fn problem(error: ArrayError) -> String {
    match error.array {
        Some(array) => format!("`{array}`: {}", error.problem),
        None => error.problem.to_string(),
    }
}
