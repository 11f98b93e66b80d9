//! Arrays as tables: each index of the first axis is a row.

mod attributes;
mod cells;
mod column;
mod form;
mod frames;
mod group;
mod row_pictures;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use taceva_arrays::{ArrayFile, ArrayFormat, Element, Problem};

use super::columns::{ColumnSource, PictureColumn, Stated};
use super::pictures::Pictures;
use crate::frame_names::FrameNames;
pub(crate) use attributes::stated;
use attributes::{absent_chunks, is_data_frame, problem};
pub(crate) use frames::ArrayPictures;
use group::{Group, candidates, rows_of};

/// Maximum number of arrays that a draft searches for pictures.
const LISTED: usize = 64;

/// Rows of a file of arrays, from one or several groups.
#[derive(Debug)]
pub(crate) struct ArrayRows {
    path: PathBuf,
    file: Arc<ArrayFile>,
    /// Groups whose arrays are the columns, or the HDF5 table itself. A file without groups has one group without a name.
    groups: Vec<Group>,
    /// True if the file is a single row, with each array as a cell.
    is_whole: bool,
}

impl ArrayRows {
    /// Opens the arrays of the groups named by `rows`, or of the whole file.
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

    /// Opens the file as a single row.
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
            // Named from the root, and as long as the table.
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
            // The capacity follows the values read: the file may state any number.
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

    /// Unit of times that pandas stores as integers with a marker; `None` for other columns.
    fn time_unit(&self, name: &str) -> Option<&'static str> {
        let mut units = self
            .groups
            .iter()
            .map(|group| self.unit_of_times(group, name));
        let first = units.next()??;
        units.all(|unit| unit == Some(first)).then_some(first)
    }

    fn holds_integers(&self, name: &str) -> bool {
        self.groups.iter().all(|group| {
            // An attribute of this name takes precedence, and is a text.
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
        let frames = self.file.unread_arrays().into_iter();
        let frames = frames.filter(|(name, _)| is_data_frame(&self.file, name));
        let frames = frames.map(|(name, reason)| format!("`{name}`: {reason}"));
        links.map(|(_, reason)| reason).chain(frames).collect()
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
            Some(PictureColumn {
                name,
                kind,
                order: None,
            })
        };
        let names = self.names().into_iter().take(LISTED);
        names.filter_map(seems).collect()
    }

    fn pictures(&self, names: &FrameNames) -> Result<Arc<dyn Pictures>, String> {
        Ok(Arc::new(self.pictures_of_rows(names)?))
    }
}
