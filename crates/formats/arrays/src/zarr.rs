//! Zarr, versions 2 and 3: a folder of arrays with one file for each chunk, or a ZIP archive of this folder. A missing chunk has the fill value.

mod array;
mod codecs;
mod fill;
mod grid;
mod metadata;
mod tree;
mod version_2;
mod version_3;

use std::collections::BTreeSet;
use std::fs;
use std::ops::Range;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

use serde_json::Value;

use crate::cache::Cache;
use crate::error::Problem;
use crate::limits;
use crate::store::{Arrays, Store, chunks_of};
use crate::values::ArrayData;

use array::ZarrArray;
use grid::Grid;
use tree::Tree;

/// Maximum nesting of groups in a zarr store.
const DEPTH: usize = 16;

/// Cached chunks, by the index of the array and the position of the chunk in the grid.
type Chunks = Cache<(usize, Vec<u64>), Vec<u8>>;

/// Zarr store.
#[derive(Debug)]
pub(crate) struct Zarr {
    groups: Vec<String>,
    arrays: Vec<(Tree, ZarrArray)>,
    /// For each listed array, the index of the stored array and of the field.
    listed: Vec<(usize, usize)>,
    /// Attributes of groups and arrays, by full name.
    attributes: Vec<(String, Value)>,
    refused: Vec<(String, Problem)>,
    chunks: Mutex<Chunks>,
    /// Indices of the arrays whose unpacked size was already checked.
    checked: Mutex<BTreeSet<usize>>,
}

impl Zarr {
    /// Attributes of the group or array `owner`.
    fn attributes_of(&self, owner: &str) -> Option<&Value> {
        let owner = owner.trim_matches('/');
        let mut attributes = self.attributes.iter();
        let (_, found) = attributes.find(|(of, _)| of.trim_matches('/') == owner)?;
        Some(found)
    }

    pub(crate) fn open(folder: &Path) -> Result<Zarr, Problem> {
        let tree = Tree::open(folder)?;
        let mut zarr = Zarr {
            groups: Vec::new(),
            arrays: Vec::new(),
            listed: Vec::new(),
            attributes: Vec::new(),
            refused: Vec::new(),
            chunks: Mutex::new(Cache::new(limits::HELD_BYTES)),
            checked: Mutex::default(),
        };
        zarr.visit(&tree, "", 0)?;
        if zarr.groups.is_empty() && zarr.arrays.is_empty() && zarr.refused.is_empty() {
            return Err(Problem::damaged(
                0,
                "no `zarr.json`, `.zgroup` or `.zarray`",
                "a folder of zarr version 2 or 3, or a ZIP archive of one",
            ));
        }
        for (index, (_, array)) in zarr.arrays.iter().enumerate() {
            zarr.listed
                .extend((0..array.item.fields.len()).map(|field| (index, field)));
        }
        Ok(zarr)
    }

    /// Lists the content of `folder`. `path` is the full name of the folder, empty for the root.
    fn visit(&mut self, folder: &Tree, path: &str, depth: usize) -> Result<(), Problem> {
        let name = if path.is_empty() { "/" } else { path };
        let within = |problem: Problem| problem.within(&format!("the metadata of `{name}`"));
        let node = metadata::node(folder).map_err(within)?;
        if let Some(attributes) = node.attributes {
            self.attributes.push((name.to_owned(), attributes));
        }
        match node.array {
            Some(Ok(array)) => {
                self.arrays.push((folder.clone(), array));
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
            // Folder of another program.
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

    fn members(&mut self, folder: &Tree, path: &str, depth: usize) -> Result<(), Problem> {
        if depth == DEPTH {
            return Ok(());
        }
        for name in folder.folders()? {
            self.visit(&folder.join(&name), &format!("{path}/{name}"), depth + 1)?;
        }
        Ok(())
    }

    /// Rejects an array that would exhaust memory or time, by comparing its unpacked size with its stored size.
    fn check_unpacked(
        &self,
        index: usize,
        folder: &Tree,
        array: &ZarrArray,
    ) -> Result<(), Problem> {
        let mut checked = self.checked.lock().unwrap_or_else(PoisonError::into_inner);
        if !checked.insert(index) {
            return Ok(());
        }
        let whole = array
            .shape
            .iter()
            .fold(array.item.bytes as u64, |bytes, side| {
                bytes.saturating_mul(*side)
            });
        if whole <= limits::INFLATED_BYTES && array.chunk_bytes() <= Some(limits::INFLATED_BYTES) {
            return Ok(());
        }
        let there = written(folder, array)?;
        let chunks = there
            .chunks
            .saturating_mul(array.chunk_bytes().unwrap_or(u64::MAX));
        let (all, most) = (whole.max(chunks), limits::unpacked_bytes(there.bytes));
        match all <= most {
            true => Ok(()),
            false => {
                checked.remove(&index);
                Err(Problem::too_large(
                    format!(
                        "bytes of decompressed `{}`, {} times the size of its chunks (write it with less compression, or in several \
                         arrays)",
                        array.name,
                        all / there.bytes.max(1)
                    ),
                    all,
                    most,
                ))
            }
        }
    }

    /// Bytes of the chunk at the grid position `place` of the array `index`, row by row; `None` if the chunk was never written.
    fn chunk(&self, index: usize, place: &[u64]) -> Result<Option<Arc<Vec<u8>>>, Problem> {
        let key = (index, place.to_vec());
        let mut kept = self.chunks.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(chunk) = kept.get(&key) {
            return Ok(Some(chunk));
        }
        drop(kept);
        let (folder, array) = &self.arrays[index];
        let name = array.key(place);
        if let Tree::Folder(folder) = folder
            && !is_own_file(folder, &name)?
        {
            return Ok(None);
        }
        let packed = folder.bytes(&name, "bytes of one chunk", limits::CHUNK_BYTES)?;
        let Some(packed) = packed else {
            return Ok(None);
        };
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

/// True if `folder` contains the chunk file `name`, and false if it contains nothing of this name. Anything else, such as a link, is an error.
fn is_own_file(folder: &Path, name: &str) -> Result<bool, Problem> {
    let path = folder.join(name);
    match fs::symlink_metadata(&path) {
        Ok(metadata) if metadata.is_file() => {}
        Ok(_) => {
            return Err(Problem::unsupported(
                format!("chunk `{name}` is not a regular file"),
                "copy the store",
            ));
        }
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(false),
        Err(error) => return Err(Problem::io("open")(error)),
    }
    let real = |path: &Path| fs::canonicalize(path).map_err(Problem::io("open"));
    match real(&path)?.starts_with(real(folder)?) {
        true => Ok(true),
        false => Err(Problem::unsupported(
            format!("chunk `{name}` is a link to outside its array"),
            "copy the store",
        )),
    }
}

/// Existing chunk files of an array.
#[derive(Clone, Copy, Debug, Default)]
struct Written {
    chunks: u64,
    /// Total stored size of the chunk files, bytes.
    bytes: u64,
}

/// Finds the chunk files of `array` in `folder` by their names.
fn written(folder: &Tree, array: &ZarrArray) -> Result<Written, Problem> {
    let mut there = Written::default();
    let mut folders = vec![(folder.clone(), String::new(), 0)];
    while let Some((folder, before, depth)) = folders.pop() {
        let files = folder.files()?;
        let is_key = |name: &&String| array.is_key(&format!("{before}{name}"));
        for name in files.iter().filter(is_key) {
            there.chunks += 1;
            there.bytes = there.bytes.saturating_add(folder.file_bytes(name)?);
        }
        // Each axis of a chunk `c/0/1` may be a folder.
        if depth <= array.shape.len() {
            for name in folder.folders()? {
                folders.push((folder.join(&name), format!("{before}{name}/"), depth + 1));
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
        Ok(all.saturating_sub(written(folder, array)?.chunks))
    }

    fn read(&self, index: usize, rows: Range<u64>) -> Result<ArrayData, Problem> {
        let (index, field) = self.listed[index];
        let (folder, array) = &self.arrays[index];
        self.check_unpacked(index, folder, array)?;
        let grid = Grid::new(array, rows)?;
        let mut raw = grid.filled(array)?;
        for place in grid.places() {
            if let Some(chunk) = self.chunk(index, &place)? {
                grid.copy(&place, &chunk, &mut raw);
            } else if array.fill.is_none() {
                let name = array.key(&place);
                return Err(Problem::unsupported(
                    format!("chunk `{name}` was not written, and the fill value is not supported"),
                    "write every chunk",
                ));
            }
        }
        array
            .item
            .read(&array.item.fields[field], raw, grid.shape())
    }
}
