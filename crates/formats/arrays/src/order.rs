//! Column-major arrays (Fortran order, first axis fastest), transposed block by block to rows.

use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

use crate::error::Problem;
use crate::limits;
use crate::source::{ByteSource, bytes_of};

/// Number of bytes read at once if columns are shorter.
const PIECE_BYTES: u64 = 1 << 20;

/// Transposed rows, and their range.
type Turned = (Range<u64>, Arc<Vec<u8>>);

/// Range of rows, and their transposed bytes.
#[derive(Debug)]
pub(crate) struct ColumnMajor {
    rows: u64,
    item_bytes: u64,
    /// Lengths of all axes except the first.
    rest: Vec<u64>,
    row_elements: u64,
    data_at: u64,
    kept: Mutex<Option<Turned>>,
}

impl ColumnMajor {
    /// Describes an array whose bytes begin at `data_at`. The caller has checked the sizes against the source.
    pub(crate) fn new(shape: &[u64], item_bytes: u64, data_at: u64) -> ColumnMajor {
        let rest = shape.get(1..).unwrap_or(&[]).to_vec();
        ColumnMajor {
            rows: shape.first().copied().unwrap_or(1),
            item_bytes,
            // Above 64 bits only if another length or the element length is 0. Then nothing is read.
            row_elements: rest
                .iter()
                .fold(1, |product: u64, side| product.saturating_mul(*side)),
            rest,
            data_at,
            kept: Mutex::new(None),
        }
    }

    /// Bytes of `rows`, row by row.
    pub(crate) fn rows(
        &self,
        source: &dyn ByteSource,
        rows: Range<u64>,
    ) -> Result<Vec<u8>, Problem> {
        let row_bytes = self.row_elements.saturating_mul(self.item_bytes);
        if row_bytes == 0 || rows.is_empty() {
            return Ok(Vec::new());
        }
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        let (block, turned) = match &*kept {
            Some((block, turned)) if block.start <= rows.start && rows.end <= block.end => {
                (block.clone(), Arc::clone(turned))
            }
            _ => {
                let fit = (limits::TURNED_BYTES / row_bytes).max(rows.end - rows.start);
                let block = rows.start..rows.start.saturating_add(fit).min(self.rows);
                // The previous block is dropped first, because memory has room for only one.
                *kept = None;
                let turned = Arc::new(self.turned(source, block.clone())?);
                *kept = Some((block.clone(), Arc::clone(&turned)));
                (block, turned)
            }
        };
        drop(kept);
        let place =
            |row: u64| usize::try_from((row - block.start) * row_bytes).unwrap_or(usize::MAX);
        Ok(turned[place(rows.start)..place(rows.end)].to_vec())
    }

    fn turned(&self, source: &dyn ByteSource, block: Range<u64>) -> Result<Vec<u8>, Problem> {
        let size = |bytes: u64| {
            usize::try_from(bytes)
                .map_err(|_| Problem::too_large("bytes", bytes, limits::READ_BYTES))
        };
        let item = size(self.item_bytes)?;
        let count = size(block.end - block.start)?;
        let row = size(self.row_elements * self.item_bytes)?;
        let mut turned = vec![0; count * row];
        let column_bytes = self.rows * self.item_bytes;
        let at_once = (PIECE_BYTES / column_bytes).max(1);
        let mut places = Places::new(&self.rest);
        let mut column = 0;
        while column < self.row_elements {
            let columns = at_once.min(self.row_elements - column);
            let start = self.data_at + column * column_bytes;
            // Short columns are read whole. Of a long column only the rows of the block are read.
            let (piece, first) = if column_bytes <= PIECE_BYTES {
                (
                    bytes_of(source, start, columns * column_bytes)?,
                    size(block.start * self.item_bytes)?,
                )
            } else {
                let from = start + block.start * self.item_bytes;
                (
                    bytes_of(source, from, (block.end - block.start) * self.item_bytes)?,
                    0,
                )
            };
            for whole in piece.chunks_exact(piece.len() / size(columns)?) {
                let place = places.next_place() * item;
                let of_block = &whole[first..first + count * item];
                for (into, from) in turned
                    .chunks_exact_mut(row)
                    .zip(of_block.chunks_exact(item))
                {
                    into[place..place + item].copy_from_slice(from);
                }
            }
            column += columns;
        }
        Ok(turned)
    }
}

/// Transposes a block to C order. `order` lists its axes from slowest to fastest, and `sides` has their lengths by axis number.
pub(crate) fn c_order(
    block: &[u8],
    sides: &[u64],
    order: &[usize],
    item_bytes: usize,
) -> Result<Vec<u8>, Problem> {
    let side = |axis: usize| usize::try_from(sides[axis]).unwrap_or(usize::MAX);
    let count = (0..sides.len()).map(side).product::<usize>();
    if block.len() != count * item_bytes {
        return Err(Problem::damaged(
            0,
            format!("{} bytes", block.len()),
            format!("{}", count * item_bytes),
        ));
    }
    let strides = strides(sides, item_bytes);
    let mut turned = vec![0; block.len()];
    let mut index = vec![0; sides.len()];
    let mut place = 0;
    for item in block.chunks_exact(item_bytes.max(1)) {
        turned[place..place + item_bytes].copy_from_slice(item);
        // The last axis of the stored order is fastest.
        for axis in order.iter().rev().copied() {
            index[axis] += 1;
            place += strides[axis];
            if index[axis] < side(axis) {
                break;
            }
            place -= strides[axis] * side(axis);
            index[axis] = 0;
        }
    }
    Ok(turned)
}

/// Index in C order of each element of an array with the lengths `sides`, in column-major order. The caller has checked `sides`.
pub(crate) fn c_places(sides: &[u64]) -> impl Iterator<Item = usize> {
    let mut places = Places::new(sides);
    std::iter::repeat_with(move || places.next_place())
}

/// Stride along each axis of a C-order block with the lengths `sides`, in the unit of `item_bytes`, the size of an element.
pub(crate) fn strides(sides: &[u64], item_bytes: usize) -> Vec<usize> {
    let mut strides = vec![item_bytes; sides.len()];
    for axis in (1..sides.len()).rev() {
        strides[axis - 1] = strides[axis] * usize::try_from(sides[axis]).unwrap_or(usize::MAX);
    }
    strides
}

/// Iterator over the elements of a row in column-major order (second axis of the array fastest). Yields their indices in C order.
struct Places {
    sides: Vec<u64>,
    strides: Vec<usize>,
    index: Vec<u64>,
    place: usize,
}

impl Places {
    fn new(sides: &[u64]) -> Places {
        Places {
            sides: sides.to_vec(),
            strides: strides(sides, 1),
            index: vec![0; sides.len()],
            place: 0,
        }
    }

    /// Index of the next element within the row, in C order.
    fn next_place(&mut self) -> usize {
        let here = self.place;
        for axis in 0..self.sides.len() {
            self.index[axis] += 1;
            self.place += self.strides[axis];
            if self.index[axis] < self.sides[axis] {
                break;
            }
            self.place -= self.strides[axis] * usize::try_from(self.sides[axis]).unwrap_or(0);
            self.index[axis] = 0;
        }
        here
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_columns_are_what_numpy_calls_c_order() {
        // np.arange(24).reshape(2, 3, 4) in Fortran order.
        let (rows, sides) = (2, [3, 4]);
        let mut columns = Vec::new();
        for last in 0..4 {
            for middle in 0..3 {
                columns.extend((0..rows).map(|row| row * 12 + middle * 4 + last));
            }
        }
        let array = ColumnMajor::new(&[2, sides[0], sides[1]], 1, 0);
        assert_eq!(
            array.rows(&columns, 1..2).expect("there"),
            (12..24).collect::<Vec<u8>>()
        );
        assert_eq!(
            array.rows(&columns, 0..2).expect("there"),
            (0..24).collect::<Vec<u8>>()
        );
        assert_eq!(array.rows(&columns, 0..0).expect("there"), Vec::<u8>::new());
    }

    #[test]
    fn long_columns_are_read_in_part() {
        let rows = PIECE_BYTES + 5;
        let columns: Vec<u8> = (0..2 * rows)
            .map(|at| if at < rows { 1 } else { 2 })
            .collect();
        let array = ColumnMajor::new(&[rows, 2], 1, 0);
        assert_eq!(
            array.rows(&columns, rows - 2..rows).expect("there"),
            [1, 2, 1, 2]
        );
    }
}
