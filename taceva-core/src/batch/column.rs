//! Numbers, one a row.

use std::ops::Range;

/// The values of one channel; where a sample has none, a mask says so.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Column {
    values: Vec<f64>,
    present: Option<Vec<bool>>,
}

impl Column {
    /// A column in which every sample has a value.
    pub fn full(values: Vec<f64>) -> Column {
        Column {
            values,
            present: None,
        }
    }

    /// Adds a value, or the fact that there is none.
    pub fn push(&mut self, value: Option<f64>) {
        if value.is_none() && self.present.is_none() {
            self.present = Some(vec![true; self.values.len()]);
        }
        if let Some(present) = &mut self.present {
            present.push(value.is_some());
        }
        self.values.push(value.unwrap_or(0.0));
    }

    /// The value at `row`, if there is one.
    pub fn get(&self, row: usize) -> Option<f64> {
        let present = self.present.as_ref().is_none_or(|present| present[row]);
        present.then(|| self.values[row])
    }

    /// All values in one slice; where [`present`](Column::present) says no, the number means nothing.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Which rows have a value; `None` if all have.
    pub fn present(&self) -> Option<&[bool]> {
        self.present.as_deref()
    }

    /// The rows of `range` as a column of their own.
    ///
    /// # Panics
    /// If the range reaches beyond the last row.
    pub fn slice(&self, range: Range<usize>) -> Column {
        let present = self
            .present
            .as_ref()
            .map(|present| present[range.clone()].to_vec());
        Column {
            values: self.values[range].to_vec(),
            present,
        }
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }
}
