//! Channels computed as a matrix times columns: a calibration, or the rotation of a sensor.

use taceva_core::SourceUnit;

/// Channels computed as `matrix · (columns − offset)`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MatrixMap {
    /// Columns that are multiplied by the matrix, in order.
    pub(crate) from: Vec<String>,
    /// Offset subtracted from each column, in the unit of its cells.
    pub(crate) offset: Vec<f64>,
    pub(crate) by: MatrixRows,
    /// Channels, one per row of the matrix, with the unit of the product.
    pub(crate) gives: Vec<(String, SourceUnit)>,
    /// True if the matrix must be a rotation.
    pub(crate) is_rotation: bool,
}

/// Source of the numbers of a matrix.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum MatrixRows {
    Written(Vec<Vec<f64>>),
    /// Headerless CSV file, relative to the source folder.
    File(String),
}

/// Tolerance of a rotation matrix: deviation from orthonormal rows, and of the determinant from 1.
const ROTATION: f64 = 1e-6;

impl MatrixMap {
    /// Column name of the channel at `position` in the resolved table.
    pub(crate) fn column(&self, position: usize) -> String {
        format!("[[matrix]] {}", self.gives[position].0)
    }

    /// Reason why `rows` cannot be used for this map; `None` if they can.
    pub(crate) fn problem(&self, rows: &[Vec<f64>]) -> Option<String> {
        let (height, width) = (self.gives.len(), self.from.len());
        if rows.len() != height || rows.iter().any(|row| row.len() != width) {
            let found: Vec<String> = rows.iter().map(|row| row.len().to_string()).collect();
            return Some(format!(
                "expected {height} rows, one per channel, of {width} numbers, one per column; found {} rows of {} numbers",
                rows.len(),
                found.join(", ")
            ));
        }
        if !self.is_rotation {
            return None;
        }
        let is_one = rows.iter().enumerate().all(|(one, row)| {
            rows.iter().enumerate().all(|(other, beside)| {
                let expected = f64::from(u8::from(one == other));
                let product: f64 = row.iter().zip(beside).map(|(a, b)| a * b).sum();
                (product - expected).abs() <= ROTATION
            })
        });
        match rows {
            [a, b, c] if is_one && width == 3 => {
                let cross = [
                    a[1] * b[2] - a[2] * b[1],
                    a[2] * b[0] - a[0] * b[2],
                    a[0] * b[1] - a[1] * b[0],
                ];
                let determinant: f64 = cross.iter().zip(c).map(|(a, b)| a * b).sum();
                ((determinant - 1.0).abs() > ROTATION)
                    .then(|| format!("not a rotation: the determinant is {determinant:.6}, expected 1: the matrix mirrors"))
            }
            _ => Some("not a rotation: expected 3 × 3 numbers whose rows have length 1 and are at right angles".to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rotation_neither_stretches_nor_mirrors() {
        let newton = SourceUnit::parse("N").expect("known");
        let map = MatrixMap {
            from: ["x", "y", "z"].map(str::to_owned).to_vec(),
            offset: vec![0.0; 3],
            by: MatrixRows::Written(Vec::new()),
            gives: ["Fx", "Fy", "Fz"]
                .map(|name| (name.to_owned(), newton))
                .to_vec(),
            is_rotation: true,
        };
        let of = |z: f64| [vec![0.0, 1.0, 0.0], vec![-1.0, 0.0, 0.0], vec![0.0, 0.0, z]];
        assert_eq!(map.problem(&of(1.0)), None);
        assert!(
            map.problem(&of(-1.0))
                .is_some_and(|problem| problem.contains("mirrors"))
        );
        assert!(
            map.problem(&of(1.01))
                .is_some_and(|problem| problem.contains("length 1"))
        );
        let short = map.problem(&[vec![1.0], vec![2.0]]);
        assert!(short.is_some_and(|problem| {
            problem.contains("expected 3 rows, one per channel, of 3 numbers")
        }));
    }
}
