//! A quantity for each pair of names.

/// Numbers by name and name; a pair without one is `None`, never a placeholder.
///
/// # Shapes
/// `values[row][column]` belongs to `rows[row]` and `columns[column]`.
/// # Units
/// Those of the [`Variant`](crate::Variant) that holds the matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix {
    /// The names of the rows.
    pub rows: Vec<String>,
    /// The names of the columns.
    pub columns: Vec<String>,
    /// The value of each pair.
    pub values: Vec<Vec<Option<f64>>>,
}
