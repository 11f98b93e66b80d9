//! Matrices: values for pairs of names.

/// Values for pairs of names: the name of a row and the name of a column. A missing value is `None`, never a placeholder.
///
/// # Shapes
/// `values[row][column]` belongs to `rows[row]` and `columns[column]`.
/// # Units
/// The unit of the [`Variant`](crate::Variant) with the matrix.
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
    /// Value of each pair, by row and column.
    pub values: Vec<Vec<Option<f64>>>,
}

impl Matrix {
    /// Creates a matrix. The caller must check the shapes.
    pub fn new(rows: Vec<String>, columns: Vec<String>, values: Vec<Vec<Option<f64>>>) -> Matrix {
        Matrix {
            rows,
            columns,
            values,
        }
    }
}
