//! A quantity over the sensing surface.

/// Numbers in the cells of a grid; a cell without one is `None`, never a placeholder.
///
/// # Shapes
/// `values[row][column]` and `counts[row][column]` are for `y_mm[row]..y_mm[row + 1]` and `x_mm[column]..x_mm[column + 1]`.
/// # Units
/// Edges in mm; values in the unit of the [`Variant`](crate::Variant) that holds the map.
///
/// ```
/// use taceva_metrics::Map;
/// let map = Map::new(vec![0.0, 1.0, 2.0], vec![0.0, 1.0], vec![vec![Some(0.5), None]], vec![vec![4, 0]]);
/// assert_eq!(map.values[0].len() + 1, map.x_mm.len());
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Map {
    /// The edges of the columns, in mm, ascending.
    pub x_mm: Vec<f64>,
    /// The edges of the rows, in mm, ascending.
    pub y_mm: Vec<f64>,
    /// The value of each cell.
    pub values: Vec<Vec<Option<f64>>>,
    /// Number of samples of each cell.
    pub counts: Vec<Vec<u64>>,
}

impl Map {
    /// Map with these edges, values and counts; the caller has checked their shapes.
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
