//! Chunks that contain requested rows, and the requested part of each chunk.

use std::ops::Range;

use super::array::ZarrArray;
use crate::error::Problem;
use crate::limits;
use crate::order::strides;

/// Requested rows of an array and their chunks.
#[derive(Debug)]
pub(crate) struct Grid {
    /// Requested range of each axis.
    wanted: Vec<Range<u64>>,
    shape: Vec<u64>,
    chunk: Vec<u64>,
    item_bytes: usize,
}

impl Grid {
    pub(crate) fn new(array: &ZarrArray, rows: Range<u64>) -> Result<Grid, Problem> {
        let mut wanted: Vec<Range<u64>> = array.shape.iter().map(|side| 0..*side).collect();
        if let Some(first) = wanted.first_mut() {
            *first = rows;
        }
        let shape: Vec<u64> = wanted.iter().map(|side| side.end - side.start).collect();
        let grid = Grid {
            wanted,
            shape,
            chunk: array.chunk.clone(),
            item_bytes: array.item.bytes,
        };
        let chunks = grid.ranges().try_fold(1_u64, |chunks, range| {
            chunks.checked_mul(range.end - range.start)
        });
        match chunks {
            Some(chunks) if chunks <= limits::CHUNKS => Ok(grid),
            more => Err(Problem::too_large(
                "chunks of these rows (read fewer at a time)",
                more.unwrap_or(u64::MAX),
                limits::CHUNKS,
            )),
        }
    }

    pub(crate) fn shape(&self) -> &[u64] {
        &self.shape
    }

    /// Range of the indices of needed chunks along each axis.
    fn ranges(&self) -> impl Iterator<Item = Range<u64>> {
        self.wanted.iter().zip(&self.chunk).map(|(wanted, side)| {
            if wanted.is_empty() {
                0..0
            } else {
                wanted.start / side..(wanted.end - 1) / side + 1
            }
        })
    }

    /// Buffer for all requested rows, filled with the fill value.
    pub(crate) fn filled(&self, array: &ZarrArray) -> Result<Vec<u8>, Problem> {
        let bytes = self
            .shape
            .iter()
            .try_fold(self.item_bytes as u64, |bytes, side| {
                bytes.checked_mul(*side)
            });
        let size = bytes
            .filter(|bytes| *bytes <= limits::READ_BYTES)
            .and_then(|bytes| usize::try_from(bytes).ok());
        let size = size.ok_or_else(|| {
            Problem::too_large(
                "bytes of these rows (read fewer at a time)",
                bytes.unwrap_or(u64::MAX),
                limits::READ_BYTES,
            )
        })?;
        let mut raw = vec![0; size];
        if let Some(fill) = array
            .fill
            .as_deref()
            .filter(|fill| fill.iter().any(|byte| *byte != 0))
        {
            raw.chunks_exact_mut(fill.len())
                .for_each(|element| element.copy_from_slice(fill));
        }
        Ok(raw)
    }

    /// Grid positions of the needed chunks, with the last axis fastest.
    pub(crate) fn places(&self) -> Vec<Vec<u64>> {
        let mut places = vec![Vec::new()];
        for range in self.ranges() {
            places = places
                .into_iter()
                .flat_map(|place| {
                    range
                        .clone()
                        .map(move |number| [place.as_slice(), &[number]].concat())
                })
                .collect();
        }
        places
    }

    /// Copies the requested part of the chunk at the grid position `place` to `raw`.
    pub(crate) fn copy(&self, place: &[u64], chunk: &[u8], raw: &mut [u8]) {
        let axes = self.wanted.len();
        // Per axis: start of the part in the rows and in the chunk, its length, and the strides.
        let mut parts = Vec::with_capacity(axes);
        for (axis, number) in place.iter().enumerate() {
            let start = number * self.chunk[axis];
            let from = self.wanted[axis].start.max(start);
            let to = self.wanted[axis].end.min(start + self.chunk[axis]);
            parts.push((
                index(from - self.wanted[axis].start),
                index(from - start),
                index(to - from),
            ));
        }
        let into = strides(&self.shape, self.item_bytes);
        let from = strides(&self.chunk, self.item_bytes);
        block(raw, chunk, &parts, &into, &from, self.item_bytes);
    }
}

/// Copies a block from a chunk to the requested rows, axis by axis. The last axis is contiguous.
fn block(
    raw: &mut [u8],
    chunk: &[u8],
    parts: &[(usize, usize, usize)],
    into_strides: &[usize],
    from_strides: &[usize],
    item_bytes: usize,
) {
    match parts {
        [] => raw[..item_bytes].copy_from_slice(&chunk[..item_bytes]),
        [(into, from, count)] => {
            let bytes = count * item_bytes;
            let (into, from) = (into * item_bytes, from * item_bytes);
            raw[into..into + bytes].copy_from_slice(&chunk[from..from + bytes]);
        }
        [(into, from, count), rest @ ..] => {
            for step in 0..*count {
                let raw = &mut raw[(into + step) * into_strides[0]..];
                let chunk = &chunk[(from + step) * from_strides[0]..];
                block(
                    raw,
                    chunk,
                    rest,
                    &into_strides[1..],
                    &from_strides[1..],
                    item_bytes,
                );
            }
        }
    }
}

/// Converts a length that was checked against a limit to `usize`.
fn index(length: u64) -> usize {
    usize::try_from(length).unwrap_or(usize::MAX)
}
