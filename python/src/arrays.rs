//! Input arrays from Python.

use std::ops::Range;

use pyo3::buffer::{Element, PyBuffer};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use taceva_core::Labels;

use crate::buffer::{copy_into, values};
use crate::errors::value_error;

/// A C-order array of float32 or float64 numbers, `[rows, width]` or, for one channel, `[rows]`.
pub(crate) enum Table {
    Single(PyBuffer<f32>),
    Double(PyBuffer<f64>),
}

impl Table {
    /// Reads `array` as a table of `width` columns; `name` is its name in errors.
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
                "{name}: expected a C-contiguous array"
            )));
        }
        match shape {
            [_] if width == 1 => Ok(table),
            [_, columns] if *columns == width => Ok(table),
            shape => Err(value_error(format_args!(
                "{name} has the shape {shape:?}, expected [rows, {width}]: one column per channel"
            ))),
        }
    }

    /// Number of rows.
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

    /// Appends the numbers of `rows` to `columns`, channel by channel; returns true if all numbers are finite.
    pub(crate) fn read(
        &self,
        py: Python<'_>,
        rows: Range<usize>,
        columns: &mut [Vec<f64>],
    ) -> bool {
        match self {
            Table::Single(buffer) => gather(py, buffer, rows, columns),
            Table::Double(buffer) => gather(py, buffer, rows, columns),
        }
    }

    /// True if all numbers are finite.
    pub(crate) fn is_finite(&self, py: Python<'_>) -> bool {
        match self {
            Table::Single(buffer) => is_finite(py, buffer),
            Table::Double(buffer) => is_finite(py, buffer),
        }
    }
}

/// Number of values copied at a time; they fit into the L1 cache with their target columns.
const AT_ONCE: usize = 1536;

/// Appends consecutive rows to `columns`, channel by channel; returns true if all numbers are finite.
fn gather<T: Element + Into<f64>>(
    py: Python<'_>,
    array: &PyBuffer<T>,
    rows: Range<usize>,
    columns: &mut [Vec<f64>],
) -> bool {
    let width = columns.len();
    let step = (AT_ONCE / width.max(1)).max(1);
    let mut numbers = Vec::new();
    let mut are_all = true;
    for first in rows.clone().step_by(step) {
        let end = rows.end.min(first + step);
        copy_into(py, array, first * width..end * width, &mut numbers);
        are_all &= are_finite(&numbers);
        // Constant strides for common widths.
        match width {
            1 => columns[0].extend(numbers.iter().map(|number| (*number).into())),
            3 => apart::<T, 3>(&numbers, columns),
            6 => apart::<T, 6>(&numbers, columns),
            _ => {
                for (at, column) in columns.iter_mut().enumerate() {
                    column.extend(numbers.chunks_exact(width).map(|row| row[at].into()));
                }
            }
        }
    }
    are_all
}

/// Appends rows of `WIDTH` numbers to `columns`, channel by channel.
fn apart<T: Copy + Into<f64>, const WIDTH: usize>(numbers: &[T], columns: &mut [Vec<f64>]) {
    let (rows, _) = numbers.as_chunks::<WIDTH>();
    for (at, column) in columns.iter_mut().enumerate().take(WIDTH) {
        column.extend(rows.iter().map(|row| row[at].into()));
    }
}

fn is_finite<T: Element + Into<f64>>(py: Python<'_>, array: &PyBuffer<T>) -> bool {
    let count = array.item_count();
    let mut numbers = Vec::new();
    (0..count).step_by(AT_ONCE).all(|first| {
        copy_into(py, array, first..count.min(first + AT_ONCE), &mut numbers);
        are_finite(&numbers)
    })
}

/// True if all numbers are finite. Checking all is faster than an early exit.
fn are_finite<T: Copy + Into<f64>>(numbers: &[T]) -> bool {
    let numbers = numbers.iter().map(|number| (*number).into());
    numbers.fold(true, |all, number: f64| all & number.is_finite())
}

/// Contact points: one name or whole number for each row.
pub(crate) enum Points {
    Numbers(PyBuffer<i64>),
    Names(Vec<String>),
}

impl Points {
    /// Reads `points` as an array of int64, or as texts.
    pub(crate) fn of(points: &Bound<'_, PyAny>) -> PyResult<Points> {
        if let Ok(buffer) = PyBuffer::<i64>::get(points)
            && buffer.dimensions() == 1
            && buffer.is_c_contiguous()
        {
            return Ok(Points::Numbers(buffer));
        }
        let names = points.extract().map_err(|_| {
            PyTypeError::new_err("points: expected whole numbers or texts, one per row")
        })?;
        Ok(Points::Names(names))
    }

    /// Number of rows.
    pub(crate) fn rows(&self) -> usize {
        match self {
            Points::Numbers(buffer) => buffer.shape()[0],
            Points::Names(names) => names.len(),
        }
    }

    /// Contact points of `rows`. A whole number becomes decimal text, as in a table.
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
