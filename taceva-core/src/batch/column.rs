//! Column with a number or a missing value in each row.

use std::ops::Range;

/// Numbers of one channel or field, one row per sample. A row may lack a value.
///
/// ```
/// use taceva_core::Column;
/// let mut force = Column::full(vec![0.5, 1.0]);
/// force.push(None);
/// assert_eq!((force.len(), force.get(2)), (3, None));
/// ```
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

    /// A column in which no sample has a value.
    ///
    /// ```
    /// use taceva_core::Column;
    /// assert_eq!((Column::absent(2).len(), Column::absent(2).get(0)), (2, None));
    /// ```
    pub fn absent(rows: usize) -> Column {
        Column {
            values: vec![0.0; rows],
            present: Some(vec![false; rows]),
        }
    }

    /// Adds a row; `None` is a missing value.
    pub fn push(&mut self, value: Option<f64>) {
        if value.is_none() && self.present.is_none() {
            self.present = Some(vec![true; self.values.len()]);
        }
        if let Some(present) = &mut self.present {
            present.push(value.is_some());
        }
        self.values.push(value.unwrap_or(0.0));
    }

    /// The value at `row`; `None` for a missing value.
    pub fn get(&self, row: usize) -> Option<f64> {
        let present = self.present.as_ref().is_none_or(|present| present[row]);
        present.then(|| self.values[row])
    }

    /// Values of all rows. The value of a row is meaningless if [`present`](Column::present) has `false` for the row.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// One entry per row, `true` if the row has a value; `None` if all rows have a value.
    pub fn present(&self) -> Option<&[bool]> {
        self.present.as_deref()
    }

    /// Copies the rows of `range` into a new column.
    ///
    /// # Panics
    /// If the range extends beyond the last row.
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

    /// Copies the rows in the order of the indices `rows`.
    ///
    /// ```
    /// use taceva_core::Column;
    /// let column: Column = [Some(0.5), None, Some(2.5)].into_iter().collect();
    /// assert_eq!(column.in_order(&[2, 1, 0]), [Some(2.5), None, Some(0.5)].into_iter().collect());
    /// ```
    ///
    /// # Panics
    /// If an index is out of range.
    #[must_use]
    pub fn in_order(&self, rows: &[u32]) -> Column {
        let present = self.present.as_ref();
        Column {
            values: rows.iter().map(|&row| self.values[row as usize]).collect(),
            present: present.map(|present| rows.iter().map(|&row| present[row as usize]).collect()),
        }
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// True if there are no rows.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }
}

/// A column in which every row has a value. The values are not copied.
///
/// ```
/// use taceva_core::Column;
/// assert_eq!(Column::from(vec![0.5, 1.0]).get(1), Some(1.0));
/// ```
impl From<Vec<f64>> for Column {
    fn from(values: Vec<f64>) -> Column {
        Column::full(values)
    }
}

/// One row per item; `None` where a sample has no value.
///
/// ```
/// use taceva_core::Column;
/// let column: Column = [Some(0.5), None].into_iter().collect();
/// assert_eq!((column.get(0), column.get(1)), (Some(0.5), None));
/// ```
impl FromIterator<Option<f64>> for Column {
    fn from_iter<I: IntoIterator<Item = Option<f64>>>(values: I) -> Column {
        let mut present: Option<Vec<bool>> = None;
        // Collected and not pushed: one push per item takes three times as long.
        let values = values.into_iter().enumerate().map(|(row, value)| {
            if value.is_none() && present.is_none() {
                present = Some(vec![true; row]);
            }
            if let Some(present) = &mut present {
                present.push(value.is_some());
            }
            value.unwrap_or(0.0)
        });
        Column {
            values: values.collect(),
            present,
        }
    }
}
