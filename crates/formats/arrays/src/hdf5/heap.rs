//! Variable-length texts and bytes in collections of the global heap.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

use crate::cache::Cache;
use crate::error::Problem;
use crate::limits;
use crate::source::{FileBytes, bytes_of};
use crate::values::ArrayValues;

/// Global heap of an HDF5 file, which stores variable-length values.
#[derive(Debug)]
pub(crate) struct GlobalHeap {
    file: Arc<FileBytes>,
    /// Offset of address 0 in the file, bytes.
    base: u64,
    offset_bytes: usize,
    length_bytes: usize,
    collections: Mutex<Cache<u64, Collection>>,
}

/// Collection of objects in the heap.
#[derive(Debug)]
struct Collection {
    bytes: Vec<u8>,
    /// Byte range of each object, by its number.
    objects: BTreeMap<u32, Range<usize>>,
}

impl GlobalHeap {
    pub(crate) fn new(
        file: Arc<FileBytes>,
        base: u64,
        offset_bytes: u8,
        length_bytes: u8,
    ) -> GlobalHeap {
        GlobalHeap {
            file,
            base,
            offset_bytes: usize::from(offset_bytes),
            length_bytes: usize::from(length_bytes),
            collections: Mutex::new(Cache::new(limits::HELD_BYTES)),
        }
    }

    /// Resolves references. Each reference is a length (4 bytes), the address of a collection, and the number of an object (4 bytes).
    pub(crate) fn values(&self, references: &[u8], is_text: bool) -> Result<ArrayValues, Problem> {
        let mut all = Vec::with_capacity(references.len() / (8 + self.offset_bytes));
        let mut held = 0_u64;
        for reference in references.chunks_exact(8 + self.offset_bytes) {
            let length = number(&reference[..4]);
            let address = number(&reference[4..4 + self.offset_bytes]);
            let object =
                u32::try_from(number(&reference[4 + self.offset_bytes..])).unwrap_or(u32::MAX);
            held = held.saturating_add(length);
            if held > limits::READ_BYTES {
                return Err(Problem::too_large(
                    "bytes of these rows (read fewer at a time)",
                    held,
                    limits::READ_BYTES,
                ));
            }
            // An element of length 0 was never written.
            all.push(if length == 0 {
                Vec::new()
            } else {
                self.object(address, object, length)?
            });
        }
        if !is_text {
            return Ok(ArrayValues::Bytes(all));
        }
        let texts = all.into_iter().enumerate().map(|(place, bytes)| {
            let end = bytes
                .iter()
                .rposition(|byte| *byte != 0)
                .map_or(0, |last| last + 1);
            let text = std::str::from_utf8(&bytes[..end]).map(str::to_owned);
            text.map_err(|_| {
                Problem::unsupported(
                    format!("element {place} of these rows is not UTF-8"),
                    "write strings as UTF-8",
                )
            })
        });
        Ok(ArrayValues::Text(texts.collect::<Result<_, _>>()?))
    }

    fn object(&self, address: u64, object: u32, length: u64) -> Result<Vec<u8>, Problem> {
        let collection = self.collection(address)?;
        let range = collection.objects.get(&object).cloned();
        let bytes = range.and_then(|range| collection.bytes.get(range));
        let bytes = bytes.and_then(|bytes| bytes.get(..usize::try_from(length).ok()?));
        bytes.map(<[u8]>::to_vec).ok_or_else(|| {
            Problem::damaged(
                self.base.saturating_add(address),
                format!(
                    "no object {object} of {length} bytes in this collection of the global heap"
                ),
                "the value of an element",
            )
        })
    }

    fn collection(&self, address: u64) -> Result<Arc<Collection>, Problem> {
        let mut collections = self
            .collections
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        if let Some(collection) = collections.get(&address) {
            return Ok(collection);
        }
        let at = self.base.saturating_add(address);
        let header = bytes_of(&*self.file, at, 8 + self.length_bytes as u64)?;
        if !header.starts_with(b"GCOL\x01") {
            return Err(Problem::damaged(
                at,
                "not a collection of the global heap",
                "`GCOL`, version 1",
            ));
        }
        let bytes = bytes_of(&*self.file, at, number(&header[8..]))?;
        let collection = Arc::new(Collection {
            objects: self.objects(&bytes),
            bytes,
        });
        collections.keep(
            address,
            collection.bytes.len() as u64,
            Arc::clone(&collection),
        );
        Ok(collection)
    }

    /// Parses objects: number (2 bytes), reference count (2), padding (4), length, then data padded to 8 bytes. Number 0 marks free space.
    fn objects(&self, collection: &[u8]) -> BTreeMap<u32, Range<usize>> {
        let mut objects = BTreeMap::new();
        let mut at = 8 + self.length_bytes;
        while let Some(header) = collection.get(at..at + 8 + self.length_bytes) {
            let object = u32::try_from(number(&header[..2])).unwrap_or(0);
            let start = at + header.len();
            let length = usize::try_from(number(&header[8..])).ok();
            let end = length
                .and_then(|length| start.checked_add(length))
                .filter(|end| *end <= collection.len());
            let (1.., Some(end)) = (object, end) else {
                break;
            };
            objects.insert(object, start..end);
            at = end.next_multiple_of(8);
        }
        objects
    }
}

/// Little-endian number of up to 8 bytes.
fn number(bytes: &[u8]) -> u64 {
    bytes
        .iter()
        .rev()
        .fold(0, |number, byte| number << 8 | u64::from(*byte))
}
