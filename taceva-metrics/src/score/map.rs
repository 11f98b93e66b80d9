//! Maps: values over the sensing surface.

/// Values in the cells of a grid. A missing value is `None`, never a placeholder.
///
/// # Shapes
/// `values[row][column]` and `counts[row][column]` are for `y_mm[row]..y_mm[row + 1]` and `x_mm[column]..x_mm[column + 1]`.
/// # Units
/// Edges in mm; values in the unit of the [`Variant`](crate::Variant) with the map.
///
/// ```
/// use taceva_metrics::Map;
/// let map = Map::new(vec![0.0, 1.0, 2.0], vec![0.0, 1.0], vec![vec![Some(0.5), None]], vec![vec![4, 0]]);
/// assert_eq!(map.values[0].len() + 1, map.x_mm.len());
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Map {
    /// Edges of the columns, mm, ascending.
    pub x_mm: Vec<f64>,
    /// Edges of the rows, mm, ascending.
    pub y_mm: Vec<f64>,
    /// The value of each cell.
    pub values: Vec<Vec<Option<f64>>>,
    /// Number of samples of each cell.
    pub counts: Vec<Vec<u64>>,
}

impl Map {
    /// Creates a map. The caller must check the shapes.
    pub fn new(
        x_mm: Vec<f64>,
        y_mm: Vec<f64>,
        values: Vec<Vec<Option<f64>>>,
        counts: Vec<Vec<u64>>,
    ) -> Map {
        Map {
            x_mm,
            y_mm,
            values,
            counts,
        }
    }
}
