//! Chunked array of a zarr store, version 2 or 3.

use serde_json::Value;

use super::codecs::Codec;
use crate::error::Problem;
use crate::fields::Item;
use crate::limits;

/// Chunked array.
#[derive(Debug)]
pub(crate) struct ZarrArray {
    /// Full name of the array.
    pub(crate) name: String,
    pub(crate) shape: Vec<u64>,
    /// Lengths of the axes of a chunk. Chunks at an edge are stored in full size.
    pub(crate) chunk: Vec<u64>,
    pub(crate) item: Item,
    /// Bytes of the fill value; `None` if the array has none.
    pub(crate) fill: Option<Vec<u8>>,
    /// Codecs of a chunk, in the order in which a writer applies them.
    pub(crate) codecs: Vec<Codec>,
    /// Prefix of the names of chunk files.
    pub(crate) prefix: &'static str,
    pub(crate) separator: char,
}

impl ZarrArray {
    /// File name of the chunk at the grid position `place`.
    pub(crate) fn key(&self, place: &[u64]) -> String {
        let numbers: Vec<String> = place.iter().map(u64::to_string).collect();
        let numbers = numbers.join(&self.separator.to_string());
        match (self.prefix, numbers.as_str()) {
            ("", "") => "0".to_owned(),
            ("", _) => numbers,
            (prefix, "") => prefix.to_owned(),
            (prefix, _) => format!("{prefix}{}{numbers}", self.separator),
        }
    }

    /// True if `name` is the file name of a chunk that lies within the shape of the array.
    pub(crate) fn is_key(&self, name: &str) -> bool {
        let numbers = name.strip_prefix(self.prefix).unwrap_or(name);
        let numbers = numbers.trim_start_matches(self.separator);
        let place: Option<Vec<u64>> = match self.shape.is_empty() {
            true => Some(Vec::new()),
            false => numbers
                .split(self.separator)
                .map(|number| number.parse().ok())
                .collect(),
        };
        place.is_some_and(|place| {
            let sides = self.shape.iter().zip(&self.chunk).zip(&place);
            let is_inside = |((side, chunk), number): ((&u64, &u64), &u64)| {
                *number < side.div_ceil((*chunk).max(1))
            };
            place.len() == self.shape.len()
                && sides.into_iter().all(is_inside)
                && self.key(&place) == name
        })
    }

    /// Unpacked size of a chunk, bytes; `None` above [`limits::CHUNK_BYTES`].
    pub(crate) fn chunk_bytes(&self) -> Option<u64> {
        let bytes = self
            .chunk
            .iter()
            .try_fold(self.item.bytes as u64, |bytes, side| {
                bytes.checked_mul(*side)
            });
        bytes.filter(|bytes| *bytes <= limits::CHUNK_BYTES)
    }

    /// Rejects an array if its numbers of axes and chunk lengths differ, or if its chunks are empty or too large.
    pub(crate) fn check(self) -> Result<ZarrArray, Problem> {
        let is_grid = self.shape.len() == self.chunk.len()
            && self.shape.len() <= limits::AXES
            && self.chunk.iter().all(|side| *side > 0);
        if !is_grid {
            return Err(Problem::damaged(
                0,
                format!("shape {:?} in chunks of {:?}", self.shape, self.chunk),
                "equal numbers of axes, and chunk lengths of at least 1",
            ));
        }
        if self.chunk_bytes().is_none() {
            let bytes = self
                .chunk
                .iter()
                .fold(self.item.bytes as u64, |bytes, side| {
                    bytes.saturating_mul(*side)
                });
            return Err(Problem::too_large(
                "bytes of one chunk (write it with smaller ones)",
                bytes,
                limits::CHUNK_BYTES,
            ));
        }
        Ok(self)
    }

    /// Unpacks the bytes of a chunk by reversing its codecs, the last codec first.
    pub(crate) fn unpack(&self, packed: Vec<u8>) -> Result<Vec<u8>, Problem> {
        let bytes = usize::try_from(self.chunk_bytes().unwrap_or(0)).unwrap_or(0);
        let mut chunk = packed;
        let packings = self
            .codecs
            .iter()
            .filter(|codec| codec.is_packing())
            .count();
        // Data compressed twice may be slightly larger in between.
        let most = if packings > 1 {
            bytes + bytes / 8 + (64 << 10)
        } else {
            bytes + 4
        };
        for codec in self.codecs.iter().rev() {
            chunk = codec.undo(chunk, most, &self.chunk, self.item.bytes)?;
        }
        if chunk.len() != bytes {
            return Err(Problem::damaged(
                0,
                format!("{} decompressed bytes", chunk.len()),
                format!("{bytes}"),
            ));
        }
        Ok(chunk)
    }
}

/// Parses the lengths of axes under `key` of the metadata.
pub(crate) fn lengths(metadata: &Value, key: &str) -> Result<Vec<u64>, Problem> {
    let sides = metadata
        .as_array()
        .and_then(|sides| sides.iter().map(Value::as_u64).collect());
    sides.ok_or_else(|| Problem::damaged(0, format!("`{key}`: {metadata}"), "a list of lengths"))
}
