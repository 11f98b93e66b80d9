//! Arrays of Python on their way in.

use std::ops::Range;

use pyo3::buffer::{Element, PyBuffer, ReadOnlyCell};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use taceva_core::Labels;

use crate::buffer::values;
use crate::errors::value_error;

/// An array of float32 or float64 numbers in the order of C, `[rows, width]` or, of one channel, `[rows]`.
pub(crate) enum Table {
    Single(PyBuffer<f32>),
    Double(PyBuffer<f64>),
}

impl Table {
    /// `array` as a table of `width` columns; `name` says in errors which one it is.
    pub(crate) fn of(array: &Bound<'_, PyAny>, name: &str, width: usize) -> PyResult<Table> {
        let table = match PyBuffer::<f64>::get(array) {
            Ok(buffer) => Table::Double(buffer),
            Err(_) => Table::Single(PyBuffer::<f32>::get(array).map_err(|_| {
                PyTypeError::new_err(format!("{name}: expected an array of float32 or float64"))
            })?),
        };
        let (shape, is_contiguous) = match &table {
            Table::Single(buffer) => (buffer.shape(), buffer.is_c_contiguous()),
            Table::Double(buffer) => (buffer.shape(), buffer.is_c_contiguous()),
        };
        if !is_contiguous {
            return Err(value_error(format_args!(
                "{name}: expected an array in the order of C"
            )));
        }
        match shape {
            [_] if width == 1 => Ok(table),
            [_, columns] if *columns == width => Ok(table),
            shape => Err(value_error(format_args!(
                "{name} has the shape {shape:?}, expected [rows, {width}]: a column a channel"
            ))),
        }
    }

    /// The number of rows.
    pub(crate) fn rows(&self) -> usize {
        match self {
            Table::Single(buffer) => buffer.shape()[0],
            Table::Double(buffer) => buffer.shape()[0],
        }
    }

    /// All numbers, row after row.
    pub(crate) fn row_by_row(&self, py: Python<'_>) -> Vec<f64> {
        match self {
            Table::Single(buffer) => {
                let numbers = values(py, buffer, 0..buffer.item_count());
                numbers.into_iter().map(f64::from).collect()
            }
            Table::Double(buffer) => values(py, buffer, 0..buffer.item_count()),
        }
    }

    /// Some rows as a column a channel, behind what `columns` hold; whether all of them are finite.
    pub(crate) fn read(
        &self,
        py: Python<'_>,
        rows: Range<usize>,
        columns: &mut [Vec<f64>],
    ) -> bool {
        let wanted = rows.start * columns.len()..rows.end * columns.len();
        match self {
            Table::Single(buffer) => gather(&cells(py, buffer)[wanted], columns),
            Table::Double(buffer) => gather(&cells(py, buffer)[wanted], columns),
        }
    }

    /// Whether all numbers are finite.
    pub(crate) fn is_finite(&self, py: Python<'_>) -> bool {
        match self {
            Table::Single(buffer) => are_finite(cells(py, buffer).iter().map(ReadOnlyCell::get)),
            Table::Double(buffer) => are_finite(cells(py, buffer).iter().map(ReadOnlyCell::get)),
        }
    }
}

/// The numbers of an array in the order of C, where they lie.
fn cells<'a, T: Element>(py: Python<'a>, array: &'a PyBuffer<T>) -> &'a [ReadOnlyCell<T>] {
    // An array that is not in the order of C was refused.
    array.as_slice(py).unwrap_or_default()
}

/// Rows that are taken apart at once: with their columns they fit into the fastest cache.
const ROWS_AT_ONCE: usize = 256;

/// Rows after each other as a column a channel; whether all numbers are finite.
fn gather<T: Element + Into<f64>>(rows: &[ReadOnlyCell<T>], columns: &mut [Vec<f64>]) -> bool {
    let width = columns.len();
    let mut is_finite = true;
    for rows in rows.chunks(ROWS_AT_ONCE * width.max(1)) {
        for (at, column) in columns.iter_mut().enumerate() {
            let before = column.len();
            column.extend(rows.chunks_exact(width).map(|row| row[at].get().into()));
            is_finite &= are_finite(column[before..].iter().copied());
        }
    }
    is_finite
}

/// Whether all numbers are finite; all are looked at, which takes less time than to look where to end.
fn are_finite<T: Into<f64>>(numbers: impl Iterator<Item = T>) -> bool {
    numbers.fold(true, |all, number| all & number.into().is_finite())
}

/// Contact points, a name or a whole number a row.
pub(crate) enum Points {
    Numbers(PyBuffer<i64>),
    Names(Vec<String>),
}

impl Points {
    /// `points` as an array of int64, or as texts.
    pub(crate) fn of(points: &Bound<'_, PyAny>) -> PyResult<Points> {
        if let Ok(buffer) = PyBuffer::<i64>::get(points)
            && buffer.dimensions() == 1
            && buffer.is_c_contiguous()
        {
            return Ok(Points::Numbers(buffer));
        }
        let names = points.extract().map_err(|_| {
            PyTypeError::new_err("points: expected whole numbers or texts, one a row")
        })?;
        Ok(Points::Names(names))
    }

    /// The number of rows.
    pub(crate) fn rows(&self) -> usize {
        match self {
            Points::Numbers(buffer) => buffer.shape()[0],
            Points::Names(names) => names.len(),
        }
    }

    /// Those of some rows. A whole number is called by its digits, as a table would have it.
    pub(crate) fn read(&self, py: Python<'_>, rows: Range<usize>) -> Labels {
        match self {
            Points::Numbers(buffer) => Labels::of_numbers(values(py, buffer, rows)),
            Points::Names(names) => {
                let mut labels = Labels::default();
                names[rows].iter().for_each(|name| labels.push(name));
                labels
            }
        }
    }
}
