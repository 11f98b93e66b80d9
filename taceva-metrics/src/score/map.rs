//! A quantity over the sensing surface.

/// Numbers in the cells of a grid; a cell without one is `None`, never a placeholder.
///
/// # Shapes
/// `values[row][column]` and `counts[row][column]` lie between `y_mm[row]..y_mm[row + 1]` and `x_mm[column]..x_mm[column + 1]`.
/// # Units
/// Edges in mm; values in the unit of the [`Variant`](crate::Variant) that holds the map.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// The edges of the columns, in mm, ascending.
    pub x_mm: Vec<f64>,
    /// The edges of the rows, in mm, ascending.
    pub y_mm: Vec<f64>,
    /// The value of each cell.
    pub values: Vec<Vec<Option<f64>>>,
    /// How many samples each cell has.
    pub counts: Vec<Vec<u64>>,
}
