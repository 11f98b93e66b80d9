//! A quantity for each pair of names.

/// Numbers by name and name; a pair without one is `None`, never a placeholder.
///
/// # Shapes
/// `values[row][column]` belongs to `rows[row]` and `columns[column]`.
/// # Units
/// Unit of the [`Variant`](crate::Variant) that holds the matrix.
///
/// ```
/// use taceva_metrics::Matrix;
/// let names = || vec!["Fx".to_owned(), "Fz".to_owned()];
/// let leaks = Matrix::new(names(), names(), vec![vec![None, Some(0.02)], vec![Some(0.05), None]]);
/// assert_eq!(leaks.values[1][0], Some(0.05));
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Matrix {
    /// The names of the rows.
    pub rows: Vec<String>,
    /// The names of the columns.
    pub columns: Vec<String>,
    /// The value of each pair.
    pub values: Vec<Vec<Option<f64>>>,
}

impl Matrix {
    /// Matrix of `values` by the names of rows and columns; the caller has checked their shapes.
    pub fn new(rows: Vec<String>, columns: Vec<String>, values: Vec<Vec<Option<f64>>>) -> Matrix {
        Matrix {
            rows,
            columns,
            values,
        }
    }
}
