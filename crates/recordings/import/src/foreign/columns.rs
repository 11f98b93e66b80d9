//! Table whose columns are read on first use: arrays, Parquet, messages.

use std::collections::BTreeMap;
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use super::pictures::Pictures;
use crate::error::ImportError;
use crate::frame_names::FrameNames;
use taceva_dataset::internal::guarded;
use taceva_dataset::{ChannelOrder, Place};
use taceva_tables::DepthCodes;

/// Attributes that a file states for the numbers in a column.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Stated {
    /// Unit, from `unit` or `units`.
    pub(crate) unit: Option<String>,
    /// Factor and offset of packed numbers, from `scale_factor` and `add_offset` (netCDF convention); `None` if the numbers are not packed.
    pub(crate) packed: Option<[f64; 2]>,
}

/// Readable part of a truncated recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct BeforeCut {
    /// Number of complete messages of all topics.
    pub(crate) messages: u64,
    /// Offset of the end of the complete records, bytes.
    pub(crate) end: u64,
}

/// Source of a table that is read column by column.
pub(crate) trait ColumnSource: fmt::Debug + Send + Sync {
    fn rows(&self) -> usize;

    /// Columns that a map may use.
    fn names(&self) -> Vec<String>;

    /// True if there is a column of exactly this name.
    fn has(&self, name: &str) -> bool;

    /// Cells of each column, by row. Texts are unchanged, numbers have the shortest form that parses back to the same 64 bits, and several numbers are written
    /// as `[1.0, 2.0]`.
    fn columns(&self, names: &[&str]) -> Result<Vec<Vec<String>>, String>;

    /// Unit of a time column as stated by the file; `None` for other columns. The cells are already converted to seconds.
    fn time_unit(&self, _name: &str) -> Option<&'static str> {
        None
    }

    /// True if the file states that a column contains integers or lists of integers.
    fn holds_integers(&self, _name: &str) -> bool {
        false
    }

    /// Attributes that the file states for a column. Groups of the file with different attributes give one entry each.
    fn stated(&self, _name: &str) -> Vec<Stated> {
        Vec::new()
    }

    /// Reason why an item with this name is not a column: a link, or an unsupported form.
    fn why_absent(&self, _name: &str) -> Option<String> {
        None
    }

    /// Unread items of the file, each with the reason.
    fn unread(&self) -> Vec<String> {
        Vec::new()
    }

    /// Readable part of a truncated recording; `None` if the recording is complete.
    fn before_cut(&self) -> Option<BeforeCut> {
        None
    }

    /// Arrays of these columns that have unwritten chunks, and the number of unwritten chunks of each.
    fn absent_chunks(&self, _names: &[&str]) -> Result<Vec<(String, u64)>, String> {
        Ok(Vec::new())
    }

    /// Columns that seem to contain pictures.
    fn picture_columns(&self) -> Vec<PictureColumn>;

    /// Columns whose numbers denote classes, each with the list of class names that the file states.
    fn classes(&self) -> Vec<(String, Vec<String>)> {
        Vec::new()
    }

    /// Names of the numbers in a column; empty if the file does not state them.
    fn element_names(&self, _column: &str) -> Vec<String> {
        Vec::new()
    }

    /// Pictures of the rows, by row number.
    fn pictures(&self, names: &FrameNames) -> Result<Arc<dyn Pictures>, String>;

    /// Clip and frame number of each row for the LeRobot feature `key`. Clip paths are relative to the folder of the table.
    fn clips(&self, key: &str) -> Result<Vec<(String, u64)>, String> {
        Err(format!("`{key}` names no clip: this table has no clips"))
    }

    /// Distance for each code of the LeRobot feature `key`; `None` if the feature is not a depth map.
    fn depth(&self, _key: &str) -> Option<DepthCodes> {
        None
    }
}

/// Column that seems to contain pictures.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PictureColumn {
    pub(crate) name: String,
    pub(crate) kind: PictureKind,
    /// Colour order, if the file states it.
    pub(crate) order: Option<ChannelOrder>,
}

/// Kind of a column of pictures.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum PictureKind {
    /// Bytes of a PNG, JPEG or TIFF file.
    Encoded,
    /// Frames of clips beside the table.
    Clip,
    /// Depth maps in clips beside the table.
    Depth(DepthCodes),
    Array {
        is_gray: bool,
        is_planar: bool,
        /// Minimum and maximum number in the first frames; `None` if the numbers are already pixels.
        range: Option<[f64; 2]>,
    },
}

/// Table whose columns are read on first use.
#[derive(Debug)]
pub(crate) struct ColumnTable {
    path: PathBuf,
    source: Box<dyn ColumnSource>,
    read: Mutex<ReadColumns>,
    /// Maximum memory of the cells, bytes. A small crafted file could otherwise exhaust the memory.
    most_bytes: usize,
}

/// Columns that were read.
#[derive(Debug, Default)]
struct ReadColumns {
    by_name: BTreeMap<String, Arc<Vec<String>>>,
    /// Errors of columns that could not be read, so that each column is tried only once.
    refused: BTreeMap<String, String>,
    bytes: usize,
}

/// Memory limit of the cells of a file, bytes: the larger of `CELL_BYTES` and `CELL_RATIO` times the file size.
const CELL_BYTES: u64 = 96 << 20;
const CELL_RATIO: u64 = 64;

/// Maximum memory of the cells of the file at `path`, bytes; unlimited for a folder.
fn most_bytes(path: &Path) -> usize {
    let file = std::fs::metadata(path)
        .ok()
        .filter(std::fs::Metadata::is_file);
    let bytes = file.map(|file| file.len().saturating_mul(CELL_RATIO).max(CELL_BYTES));
    bytes
        .and_then(|bytes| usize::try_from(bytes).ok())
        .unwrap_or(usize::MAX)
}

/// Memory of the cells of a column, bytes.
fn bytes_of(column: &[String]) -> usize {
    column
        .iter()
        .map(|cell| size_of::<String>() + cell.capacity())
        .sum()
}

impl ColumnTable {
    /// Opens the file at `path` with `open`. Errors and decoder panics name the file.
    pub(super) fn open<S: ColumnSource + 'static>(
        path: &Path,
        open: impl FnOnce() -> Result<S, String>,
    ) -> Result<ColumnTable, ImportError> {
        let source = guarded(open).and_then(|opened| opened);
        Ok(ColumnTable {
            source: Box::new(source.map_err(|problem| ImportError::table(path, problem))?),
            path: path.to_owned(),
            read: Mutex::default(),
            most_bytes: most_bytes(path),
        })
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    pub(super) fn rows(&self) -> usize {
        self.source.rows()
    }

    pub(super) fn names(&self) -> Vec<String> {
        self.source.names()
    }

    pub(super) fn has(&self, name: &str) -> bool {
        self.source.has(name)
    }

    pub(super) fn cell(&self, row: usize, name: &str) -> Result<String, ImportError> {
        let known = |row: usize| {
            let read = self.read.lock().unwrap_or_else(PoisonError::into_inner);
            let column = read.by_name.get(name);
            column.map(|column| column[row].clone())
        };
        if let Some(cell) = known(row) {
            return Ok(cell);
        }
        self.read_ahead(&[name])?;
        Ok(known(row).unwrap_or_default())
    }

    /// Reads the existing columns among `names` together, in one pass over the file.
    pub(super) fn read_ahead(&self, names: &[&str]) -> Result<(), ImportError> {
        let mut names: Vec<&str> = names
            .iter()
            .copied()
            .filter(|name| self.has(name))
            .collect();
        names.sort_unstable();
        names.dedup();
        let mut read = self.read.lock().unwrap_or_else(PoisonError::into_inner);
        names.retain(|name| !read.by_name.contains_key(*name));
        if names.is_empty() {
            return Ok(());
        }
        // A cell takes at least the size of its `String`, which is known before unpacking.
        let least = size_of::<String>().saturating_mul(self.rows());
        let least = least.saturating_mul(names.len()).saturating_add(read.bytes);
        let columns = match names.as_slice() {
            [name] if read.refused.contains_key(*name) => Err(read.refused[*name].clone()),
            _ if least > self.most_bytes => Err(self.too_many_bytes()),
            names => guarded(|| self.source.columns(names)).and_then(|columns| columns),
        };
        let columns = columns.map_err(|problem| match names.as_slice() {
            [name] => {
                read.refused.insert((*name).to_owned(), problem.clone());
                ImportError::table(Place::file(&self.path).in_column(*name), problem)
            }
            _ => ImportError::table(Place::file(&self.path), problem),
        })?;
        for (name, column) in names.into_iter().zip(columns) {
            if column.len() != self.rows() {
                let problem = format!(
                    "{} values of `{name}`, expected {}, one per row",
                    column.len(),
                    self.rows()
                );
                return Err(ImportError::table(&self.path, problem));
            }
            let bytes = read.bytes.saturating_add(bytes_of(&column));
            if bytes > self.most_bytes {
                return Err(ImportError::table(&self.path, self.too_many_bytes()));
            }
            read.bytes = bytes;
            read.by_name.insert(name.to_owned(), Arc::new(column));
        }
        Ok(())
    }

    fn too_many_bytes(&self) -> String {
        format!(
            "the cells of its columns take more than {} bytes, far more than the file: write it with less compression, or name fewer columns",
            self.most_bytes
        )
    }

    pub(super) fn time_unit(&self, name: &str) -> Option<&'static str> {
        guarded(|| self.source.time_unit(name)).unwrap_or_default()
    }

    pub(super) fn holds_integers(&self, name: &str) -> bool {
        guarded(|| self.source.holds_integers(name)).unwrap_or_default()
    }

    pub(super) fn stated(&self, name: &str) -> Vec<Stated> {
        guarded(|| self.source.stated(name)).unwrap_or_default()
    }

    pub(super) fn unread(&self) -> Vec<String> {
        guarded(|| self.source.unread()).unwrap_or_default()
    }

    pub(crate) fn before_cut(&self) -> Option<BeforeCut> {
        self.source.before_cut()
    }

    pub(super) fn why_absent(&self, name: &str) -> Option<String> {
        guarded(|| self.source.why_absent(name)).unwrap_or_default()
    }

    pub(super) fn absent_chunks(&self, names: &[&str]) -> Result<Vec<(String, u64)>, ImportError> {
        let counted = guarded(|| self.source.absent_chunks(names)).and_then(|counted| counted);
        counted.map_err(|problem| ImportError::table(&self.path, problem))
    }

    pub(super) fn picture_columns(&self) -> Vec<PictureColumn> {
        guarded(|| self.source.picture_columns()).unwrap_or_default()
    }

    pub(super) fn classes(&self) -> Vec<(String, Vec<String>)> {
        self.source.classes()
    }

    pub(super) fn element_names(&self, column: &str) -> Vec<String> {
        self.source.element_names(column)
    }

    /// Clip and frame number of each row for the LeRobot feature `key`. Clip paths are relative to the folder of the table.
    pub(super) fn clips(&self, key: &str) -> Result<Vec<(String, u64)>, ImportError> {
        let clips = guarded(|| self.source.clips(key)).and_then(|found| found);
        clips.map_err(|problem| ImportError::table(&self.path, problem))
    }

    pub(super) fn depth(&self, key: &str) -> Option<DepthCodes> {
        self.source.depth(key)
    }

    /// Pictures of the rows.
    pub(super) fn pictures(&self, names: &FrameNames) -> Result<Arc<dyn Pictures>, ImportError> {
        let pictures = guarded(|| self.source.pictures(names)).and_then(|found| found);
        pictures.map_err(|problem| ImportError::table(&self.path, problem))
    }
}

#[cfg(test)]
mod tests;
