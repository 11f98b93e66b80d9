//! zarr, versions 2 and 3: a folder of arrays in chunks, a file each. A chunk that is not there holds the fill value.

mod array;
mod codecs;
mod fill;
mod grid;
mod metadata;
mod version_2;
mod version_3;

use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use serde_json::Value;

use crate::cache::Cache;
use crate::error::Problem;
use crate::limits;
use crate::source::{ByteSource, FileBytes, bytes_of};
use crate::store::{Arrays, Store, chunks_of};
use crate::values::ArrayData;

use array::ZarrArray;
use grid::Grid;

/// Groups within groups.
const DEPTH: usize = 16;

/// Chunks that were read, by the number of their array and their place in its grid.
type Chunks = Cache<(usize, Vec<u64>), Vec<u8>>;

/// A folder of zarr.
#[derive(Debug)]
pub(crate) struct Zarr {
    groups: Vec<String>,
    arrays: Vec<(PathBuf, ZarrArray)>,
    /// For each array that is listed, which array and which field of it.
    listed: Vec<(usize, usize)>,
    /// Attributes of groups and arrays that have any, by full name.
    attributes: Vec<(String, Value)>,
    refused: Vec<(String, Problem)>,
    chunks: Mutex<Chunks>,
}

impl Zarr {
    /// What the group or array `owner` is described by beside its data.
    fn attributes_of(&self, owner: &str) -> Option<&Value> {
        let owner = owner.trim_matches('/');
        let mut attributes = self.attributes.iter();
        let (_, found) = attributes.find(|(of, _)| of.trim_matches('/') == owner)?;
        Some(found)
    }

    pub(crate) fn open(folder: &Path) -> Result<Zarr, Problem> {
        let metadata = fs::metadata(folder).map_err(Problem::io("open"))?;
        if !metadata.is_dir() {
            return Err(Problem::unsupported(
                "a zarr store that is no folder",
                "unpack it, or save it with a path that is a folder",
            ));
        }
        let mut zarr = Zarr {
            groups: Vec::new(),
            arrays: Vec::new(),
            listed: Vec::new(),
            attributes: Vec::new(),
            refused: Vec::new(),
            chunks: Mutex::new(Cache::new(limits::HELD_BYTES)),
        };
        zarr.visit(folder, "", 0)?;
        if zarr.groups.is_empty() && zarr.arrays.is_empty() && zarr.refused.is_empty() {
            return Err(Problem::damaged(
                0,
                "no `zarr.json`, `.zgroup` or `.zarray`",
                "a folder of zarr version 2 or 3",
            ));
        }
        for (index, (_, array)) in zarr.arrays.iter().enumerate() {
            zarr.listed
                .extend((0..array.item.fields.len()).map(|field| (index, field)));
        }
        Ok(zarr)
    }

    /// Lists what `folder` holds; `path` is its full name, empty for the outermost.
    fn visit(&mut self, folder: &Path, path: &str, depth: usize) -> Result<(), Problem> {
        let name = if path.is_empty() { "/" } else { path };
        let within = |problem: Problem| problem.within(&format!("the metadata of `{name}`"));
        let node = metadata::node(folder).map_err(within)?;
        if let Some(attributes) = node.attributes {
            self.attributes.push((name.to_owned(), attributes));
        }
        match node.array {
            Some(Ok(array)) => {
                self.arrays.push((folder.to_owned(), array));
                if let Some((_, array)) = self.arrays.last_mut() {
                    array.name = name.to_owned();
                }
            }
            Some(Err(reason @ Problem::Unsupported { .. })) => {
                self.refused.push((name.to_owned(), reason))
            }
            Some(Err(problem)) => return Err(within(problem)),
            None if node.is_group => {
                self.groups.push(name.to_owned());
                self.members(folder, path, depth)?;
            }
            // A folder of somebody else's.
            None => {}
        }
        let count = (self.groups.len() + self.arrays.len() + self.refused.len()) as u64;
        if count > limits::ARRAYS {
            return Err(Problem::too_large(
                "groups and arrays",
                count,
                limits::ARRAYS,
            ));
        }
        Ok(())
    }

    fn members(&mut self, folder: &Path, path: &str, depth: usize) -> Result<(), Problem> {
        if depth == DEPTH {
            return Ok(());
        }
        let mut members = Vec::new();
        for entry in fs::read_dir(folder).map_err(Problem::io("list"))? {
            let entry = entry.map_err(Problem::io("list"))?;
            // Links are not followed: they may lead anywhere.
            let is_folder = entry.file_type().map_err(Problem::io("list"))?.is_dir();
            if let (true, Some(name)) = (is_folder, entry.file_name().to_str()) {
                members.push(name.to_owned());
            }
        }
        members.sort_unstable();
        for name in members {
            self.visit(&folder.join(&name), &format!("{path}/{name}"), depth + 1)?;
        }
        Ok(())
    }

    /// One chunk, row by row, or `None` where none was written.
    fn chunk(&self, index: usize, place: &[u64]) -> Result<Option<Arc<Vec<u8>>>, Problem> {
        let key = (index, place.to_vec());
        let mut kept = self.chunks.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(chunk) = kept.get(&key) {
            return Ok(Some(chunk));
        }
        drop(kept);
        let (folder, array) = &self.arrays[index];
        let name = array.key(place);
        let path = folder.join(&name);
        // A chunk is a file of its own, never a link to one elsewhere.
        match fs::symlink_metadata(&path) {
            Ok(metadata) if metadata.is_file() => {}
            Ok(_) => {
                return Err(Problem::unsupported(
                    format!("chunk `{name}` is no regular file"),
                    "copy the store",
                ));
            }
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(Problem::io("open")(error)),
        }
        let real = |path: &Path| fs::canonicalize(path).map_err(Problem::io("open"));
        if !real(&path)?.starts_with(real(folder)?) {
            return Err(Problem::unsupported(
                format!("chunk `{name}` is outside of its array, through a link"),
                "copy the store",
            ));
        }
        let file = FileBytes::open(&path)?;
        if file.length() > limits::CHUNK_BYTES {
            return Err(Problem::too_large(
                "bytes of one chunk",
                file.length(),
                limits::CHUNK_BYTES,
            ));
        }
        let packed = bytes_of(&file, 0, file.length())?;
        let chunk = array
            .unpack(packed)
            .map_err(|problem| problem.within(&format!("chunk `{name}`")))?;
        let chunk = Arc::new(chunk);
        let mut kept = self.chunks.lock().unwrap_or_else(PoisonError::into_inner);
        kept.keep(key, chunk.len() as u64, Arc::clone(&chunk));
        drop(kept);
        Ok(Some(chunk))
    }
}

/// How many chunks of the array in `folder` are there: a file that has the name of one.
fn written(folder: &Path, array: &ZarrArray) -> Result<u64, Problem> {
    let mut there = 0;
    let mut folders = vec![(folder.to_owned(), String::new(), 0)];
    while let Some((folder, before, depth)) = folders.pop() {
        for entry in fs::read_dir(folder).map_err(Problem::io("list"))? {
            let entry = entry.map_err(Problem::io("list"))?;
            let name = entry.file_name();
            let Some(name) = name.to_str() else { continue };
            let kind = entry.file_type().map_err(Problem::io("list"))?;
            let name = format!("{before}{name}");
            // Of a chunk `c/0/1` each axis may be a folder.
            if kind.is_dir() && depth <= array.shape.len() {
                folders.push((entry.path(), format!("{name}/"), depth + 1));
            } else if kind.is_file() && array.is_key(&name) {
                there += 1;
            }
        }
    }
    Ok(there)
}

impl Store for Zarr {
    fn arrays(&self) -> Arrays {
        let each = self.arrays.iter();
        each.flat_map(|(_, array)| array.item.arrays(&array.name, &array.shape))
            .collect()
    }

    fn refused(&self) -> &[(String, Problem)] {
        &self.refused
    }

    fn groups(&self) -> Vec<String> {
        self.groups.clone()
    }

    fn attributes(&self, owner: &str) -> Vec<String> {
        let attributes = self.attributes_of(owner).and_then(Value::as_object);
        attributes
            .into_iter()
            .flatten()
            .map(|(name, _)| name.clone())
            .collect()
    }

    fn attribute(&self, owner: &str, name: &str) -> Option<String> {
        let attributes = self.attributes_of(owner)?;
        match attributes.get(name)? {
            Value::String(text) => Some(text.clone()),
            Value::Null => None,
            other => Some(other.to_string()),
        }
    }

    fn absent_chunks(&self, index: usize) -> Result<u64, Problem> {
        let (folder, array) = &self.arrays[self.listed[index].0];
        let all = chunks_of(&array.shape, &array.chunk);
        Ok(all.saturating_sub(written(folder, array)?))
    }

    fn read(&self, index: usize, rows: Range<u64>) -> Result<ArrayData, Problem> {
        let (index, field) = self.listed[index];
        let (_, array) = &self.arrays[index];
        let grid = Grid::new(array, rows)?;
        let mut raw = grid.filled(array)?;
        for place in grid.places() {
            if let Some(chunk) = self.chunk(index, &place)? {
                grid.copy(&place, &chunk, &mut raw);
            } else if array.fill.is_none() {
                let name = array.key(&place);
                return Err(Problem::unsupported(
                    format!("chunk `{name}` was not written, and the fill value is not understood"),
                    "write every chunk",
                ));
            }
        }
        array
            .item
            .read(&array.item.fields[field], raw, grid.shape())
    }
}
