//! HDF5 files. The crate `hdf5-pure` reads structures, chunks and filters. This module reads contiguous data and variable-length values.

mod attribute;
mod chunk_index;
mod data_frame;
mod element;
mod element_type;
mod heap;
mod layout_version;
mod link;
mod lookup3;
mod patched_file;
mod soft_links;
mod structures;
mod tree;
mod unpacked_sizes;
mod writer;

use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

use hdf5_pure::{ChunkCacheConfig, Dataset, DatasetAccessProperties, File, FormatError, Layout};

use crate::cache::Cache;
use crate::error::Problem;
use crate::fields::{Field, Item};
use crate::limits;
use crate::source::{ByteSource, FileBytes, bytes_of};
use crate::store::{Arrays, Store};
use crate::values::ArrayData;

use chunk_index::ChunkIndex;
use heap::GlobalHeap;
use patched_file::PatchedFile;
use soft_links::Patches;
use unpacked_sizes::UnpackedSizes;

pub(crate) use data_frame::store;
pub use element_type::WrittenElement;
pub use writer::Hdf5Writer;

/// HDF5 file.
#[derive(Debug)]
pub(crate) struct Hdf5 {
    bytes: Arc<FileBytes>,
    file: File,
    groups: Vec<String>,
    datasets: Vec<Listed>,
    refused: Vec<(String, Problem)>,
    /// Dead links, each with the reason.
    nowhere: Vec<(String, Problem)>,
    /// For each listed array, the index of the dataset and of the field.
    listed: Vec<(usize, usize)>,
    open: Mutex<Cache<usize, Opened>>,
    unpacked: UnpackedSizes,
    heap: GlobalHeap,
}

/// Readable dataset.
#[derive(Debug)]
pub(crate) struct Listed {
    pub(crate) path: String,
    pub(crate) shape: Vec<u64>,
    pub(crate) item: Item,
    /// Unpacked size of one row, bytes.
    pub(crate) row_bytes: u64,
}

/// Dataset after its structures were parsed.
#[derive(Debug)]
struct Opened {
    dataset: Dataset,
    /// Offset of the rows, if they are contiguous.
    at: Option<u64>,
}

impl Hdf5 {
    pub(crate) fn open(bytes: FileBytes) -> Result<Hdf5, Problem> {
        let bytes = Arc::new(bytes);
        let open = |patches| {
            let shared = PatchedFile {
                bytes: Arc::clone(&bytes),
                patches,
            };
            let file = File::from_source(shared).map_err(problem)?;
            Ok((tree::walk(&file)?, file))
        };
        let mut nowhere = Vec::new();
        let (found, file) = match open(Patches::new()) {
            Ok(opened) => opened,
            // Soft links may be the only cause.
            Err(problem) => match soft_links::followed(&bytes) {
                Ok(followed) if !followed.patches.is_empty() => {
                    nowhere = followed.nowhere;
                    open(followed.patches)?
                }
                _ => return Err(problem),
            },
        };
        let fields = found
            .datasets
            .iter()
            .enumerate()
            .flat_map(|(dataset, listed)| {
                let count = listed.item.fields.len();
                (0..count).map(move |field| (dataset, field))
            });
        let listed = fields.collect();
        let superblock = file.superblock();
        let heap = GlobalHeap::new(
            Arc::clone(&bytes),
            superblock.base_address.get(),
            superblock.offset_size,
            superblock.length_size,
        );
        Ok(Hdf5 {
            bytes,
            heap,
            groups: found.groups,
            datasets: found.datasets,
            refused: found.refused,
            nowhere,
            listed,
            open: Mutex::new(Cache::new(limits::HELD_BYTES)),
            unpacked: UnpackedSizes::default(),
            file,
        })
    }

    fn opened(&self, index: usize) -> Result<Arc<Opened>, Problem> {
        let mut open = self.open.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(opened) = open.get(&index) {
            return Ok(opened);
        }
        let (opened, held_bytes) = self.open_dataset(index)?;
        let opened = Arc::new(opened);
        open.keep(index, held_bytes, Arc::clone(&opened));
        Ok(opened)
    }

    /// Opens the dataset with the index `index`. Also returns the size of its chunks in memory, bytes.
    fn open_dataset(&self, index: usize) -> Result<(Opened, u64), Problem> {
        let listed = &self.datasets[index];
        let dataset = self.file.dataset(&listed.path).map_err(problem)?;
        let item_bytes = listed.item.bytes as u64;
        match dataset.layout().map_err(problem)? {
            Layout::Contiguous {
                address: Some(at), ..
            } => {
                let rows = listed.shape.first().copied().unwrap_or(1);
                let length = self.bytes.length();
                let end = rows
                    .checked_mul(listed.row_bytes)
                    .and_then(|bytes| bytes.checked_add(at));
                if end.is_none_or(|end| end > length) {
                    return Err(Problem::damaged(
                        length,
                        "the end",
                        format!("{rows} rows of {} bytes from byte {at}", listed.row_bytes),
                    ));
                }
                Ok((
                    Opened {
                        dataset,
                        at: Some(at),
                    },
                    0,
                ))
            }
            Layout::Chunked { chunk_shape, .. } => {
                let chunk_bytes =
                    product(&chunk_shape, item_bytes).filter(|bytes| *bytes <= limits::CHUNK_BYTES);
                let chunk_bytes = chunk_bytes.ok_or_else(|| {
                    Problem::too_large(
                        "bytes of one chunk (write it with smaller ones)",
                        product(&chunk_shape, item_bytes).unwrap_or(u64::MAX),
                        limits::CHUNK_BYTES,
                    )
                })?;
                let chunks = ChunkIndex::read(&dataset, &listed.shape, &chunk_shape)?;
                let written = chunks.map_or(0, |chunks| chunks.written);
                self.take_unpacked(index, written.saturating_mul(chunk_bytes))?;
                // Rows that are read one at a time share cached chunks.
                let rows_of_chunk = chunk_shape.first().copied().unwrap_or(1);
                let across = rows_of_chunk
                    .saturating_mul(listed.row_bytes)
                    .saturating_add(chunk_bytes);
                let held = across.min(limits::HELD_BYTES);
                let cache = ChunkCacheConfig::new()
                    .with_max_bytes(usize::try_from(held).unwrap_or(usize::MAX));
                let properties = DatasetAccessProperties::new().with_chunk_cache(cache);
                let dataset = self
                    .file
                    .dataset_with_options(&listed.path, properties)
                    .map_err(problem)?;
                Ok((Opened { dataset, at: None }, held))
            }
            Layout::Virtual => Err(Problem::unsupported(
                "a virtual dataset, whose elements are in other files",
                "copy it into one file: `h5repack`, or `f2['x'] = f['x'][:]` in h5py",
            )),
            _ => {
                self.take_unpacked(index, 0)?;
                Ok((Opened { dataset, at: None }, 0))
            }
        }
    }

    /// Adds the dataset `index` to the unpacked size of the file. The dataset counts with the larger of `chunks` (bytes of its unpacked chunks) and
    /// all its rows.
    fn take_unpacked(&self, index: usize, chunks: u64) -> Result<(), Problem> {
        let listed = &self.datasets[index];
        let rows = listed.shape.first().copied().unwrap_or(1);
        let bytes = chunks.max(rows.saturating_mul(listed.row_bytes));
        self.unpacked.take(index, bytes, self.bytes.length())
    }

    /// Bytes of `rows` of the dataset `index`, after all filters are reversed.
    pub(crate) fn raw_rows(&self, index: usize, rows: Range<u64>) -> Result<Vec<u8>, Problem> {
        let row_bytes = self.datasets[index].row_bytes;
        let count = rows.end - rows.start;
        let bytes = count
            .checked_mul(row_bytes)
            .filter(|bytes| *bytes <= limits::READ_BYTES);
        let bytes = bytes.ok_or_else(|| {
            Problem::too_large(
                "bytes of these rows (read fewer at a time)",
                count.saturating_mul(row_bytes),
                limits::READ_BYTES,
            )
        })?;
        if bytes == 0 {
            return Ok(Vec::new());
        }
        let opened = self.opened(index)?;
        if let Some(at) = opened.at {
            return bytes_of(&*self.bytes, at + rows.start * row_bytes, bytes);
        }
        let raw = opened
            .dataset
            .read_raw_rows(rows.start, count)
            .map_err(problem)?;
        if raw.len() as u64 != bytes {
            return Err(Problem::damaged(
                0,
                format!("{} bytes of these rows", raw.len()),
                format!("{bytes}"),
            ));
        }
        Ok(raw)
    }

    pub(crate) fn datasets(&self) -> &[Listed] {
        &self.datasets
    }
}

impl Store for Hdf5 {
    fn arrays(&self) -> Arrays {
        let each = self.datasets.iter();
        each.flat_map(|dataset| dataset.item.arrays(&dataset.path, &dataset.shape))
            .collect()
    }

    fn refused(&self) -> &[(String, Problem)] {
        &self.refused
    }

    fn nowhere(&self) -> &[(String, Problem)] {
        &self.nowhere
    }

    fn link(&self, name: &str) -> Option<Problem> {
        link::of(&self.bytes, name)
    }

    fn groups(&self) -> Vec<String> {
        self.groups.clone()
    }

    fn attributes(&self, owner: &str) -> Vec<String> {
        attribute::names(&self.file, owner)
    }

    fn attribute(&self, owner: &str, name: &str) -> Option<String> {
        attribute::read(&self.file, owner, name)
    }

    fn absent_chunks(&self, index: usize) -> Result<u64, Problem> {
        let listed = &self.datasets[self.listed[index].0];
        let dataset = self.file.dataset(&listed.path).map_err(problem)?;
        match dataset.layout().map_err(problem)? {
            Layout::Contiguous { address: None, .. } => Ok(u64::from(!listed.shape.contains(&0))),
            Layout::Chunked { chunk_shape, .. } => {
                let chunks = ChunkIndex::read(&dataset, &listed.shape, &chunk_shape)?;
                Ok(chunks.map_or(0, |chunks| chunks.absent))
            }
            _ => Ok(0),
        }
    }

    fn read(&self, index: usize, rows: Range<u64>) -> Result<ArrayData, Problem> {
        let (dataset, field) = self.listed[index];
        let listed = &self.datasets[dataset];
        let field: &Field = &listed.item.fields[field];
        let mut shape = listed.shape.clone();
        if let Some(first) = shape.first_mut() {
            *first = rows.end - rows.start;
        }
        if let (Some(scalar), None, Some(at)) = (
            listed.item.scalar(),
            field.scalar.heap_text(),
            self.opened(dataset)?.at,
        ) {
            let count =
                (rows.end - rows.start) * (listed.row_bytes / (scalar.bytes() as u64).max(1));
            let count = usize::try_from(count).unwrap_or(usize::MAX);
            let values = scalar.read(&*self.bytes, at + rows.start * listed.row_bytes, count)?;
            return Ok(ArrayData { shape, values });
        }
        let raw = self.raw_rows(dataset, rows)?;
        match field.scalar.heap_text() {
            None => listed.item.read(field, raw, &shape),
            Some(is_text) => {
                let values = self.heap.values(&listed.item.pick(field, raw), is_text)?;
                let shape = [shape.as_slice(), &field.extent].concat();
                Ok(ArrayData { shape, values })
            }
        }
    }
}

/// Size of a block with the lengths `sides` and items of `item_bytes` bytes, in bytes; `None` if it exceeds 64 bits.
pub(crate) fn product(sides: &[u64], item_bytes: u64) -> Option<u64> {
    sides
        .iter()
        .try_fold(item_bytes, |bytes, side| bytes.checked_mul(*side))
}

/// Converts an error of the crate `hdf5-pure`. Adds a remedy if one is known.
pub(crate) fn problem(error: hdf5_pure::Error) -> Problem {
    use hdf5_pure::Error;
    match error {
        Error::Io(source) => Problem::Io {
            doing: "read",
            source,
        },
        Error::Format(FormatError::InvalidLayoutVersion(version)) => Problem::unsupported(
            format!("data layout version {version}, which is newer than HDF5 2.0"),
            "write it with `h5py.File(path, 'w', libver='v114')`, or copy it with h5py into such a file",
        ),
        // The crate has no separate kind for this error.
        Error::Format(FormatError::ChunkedReadError(words))
            if words.contains("version 2 B-tree") =>
        {
            Problem::unsupported(
                "chunks of an array with two growing axes (`maxshape=(None, None)`) in the newer file format",
                "let only one axis grow, or write the file with `h5py.File(path, 'w', libver=('earliest', 'v108'))`",
            )
        }
        Error::Format(FormatError::SignatureNotFound) => {
            Problem::damaged(0, "not an HDF5 file", "`\\x89HDF`")
        }
        Error::Format(FormatError::UnsupportedExternalStorage) => Problem::unsupported(
            "a dataset whose elements are in another file (external storage), which is not opened",
            "copy them into this one: `h5repack -l CONTI FILE COPY`",
        ),
        other => Problem::Structure {
            problem: other.to_string(),
        },
    }
}
