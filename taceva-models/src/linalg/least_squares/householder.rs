//! Householder decomposition of a matrix with columns scaled by powers of two.

use faer::Mat;

/// Decomposition A D = Q R of a matrix A into an orthogonal Q and a triangular R. The diagonal matrix D scales each column of A by a power of two, to
/// a norm near 1.
#[derive(Clone, Debug)]
pub(super) struct Householder {
    /// Reflectors of Q on and below the diagonal, entries of R above the diagonal.
    packed: Mat<f64>,
    /// Diagonal of the triangular factor R.
    diagonal: Vec<f64>,
    /// Powers of two that scale the columns: the diagonal of D.
    scale: Vec<f64>,
}

impl Householder {
    pub(super) fn new(mut matrix: Mat<f64>) -> Householder {
        let columns = matrix.ncols();
        let mut scale = Vec::with_capacity(columns);
        for column in 0..columns {
            let own = matrix.col_as_slice_mut(column);
            let factor = power_of_two_over(norm(own));
            own.iter_mut().for_each(|value| *value *= factor);
            scale.push(factor);
        }
        let mut diagonal = Vec::with_capacity(columns);
        for column in 0..columns {
            let own = &mut matrix.col_as_slice_mut(column)[column..];
            let size = norm(own);
            let value = if own[0] > 0.0 { -size } else { size };
            own[0] -= value;
            let length = norm(own);
            if length > 0.0 {
                own.iter_mut().for_each(|place| *place /= length);
            }
            diagonal.push(value);
            let reflector = own.to_vec();
            for other in column + 1..columns {
                reflect(&reflector, &mut matrix.col_as_slice_mut(other)[column..]);
            }
        }
        Householder {
            packed: matrix,
            diagonal,
            scale,
        }
    }

    /// Index of the first column that is a linear combination of earlier columns to within rounding; `None` if there is no such column.
    pub(super) fn dependent(&self) -> Option<usize> {
        let rounding = self.packed.nrows() as f64 * f64::EPSILON;
        self.diagonal
            .iter()
            .position(|value| value.abs() <= rounding)
    }

    /// Solves r + A x = `upper` and Aᵀr = `lower` for x and r. A is the decomposed matrix.
    pub(super) fn solve(&self, upper: &[f64], lower: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let columns = self.diagonal.len();
        let scaled: Vec<f64> = lower.iter().zip(&self.scale).map(|(a, b)| a * b).collect();
        let within = self.transpose_substitute(&scaled);
        let mut rotated = upper.to_vec();
        for column in 0..columns {
            reflect(self.reflector(column), &mut rotated[column..]);
        }
        let ahead: Vec<f64> = rotated.iter().zip(&within).map(|(a, b)| a - b).collect();
        let mut weights = self.substitute(&ahead);
        weights
            .iter_mut()
            .zip(&self.scale)
            .for_each(|(weight, scale)| *weight *= scale);
        let mut residual = rotated;
        residual[..columns].copy_from_slice(&within);
        for column in (0..columns).rev() {
            reflect(self.reflector(column), &mut residual[column..]);
        }
        (weights, residual)
    }

    fn reflector(&self, column: usize) -> &[f64] {
        &self.packed.col_as_slice(column)[column..]
    }

    /// Solves R z = `values` for z, with the triangular factor R.
    fn substitute(&self, values: &[f64]) -> Vec<f64> {
        let mut found = values[..self.diagonal.len()].to_vec();
        for column in (0..found.len()).rev() {
            found[column] /= self.diagonal[column];
            let (above, own) = found.split_at_mut(column);
            let entries = self.packed.col_as_slice(column);
            above
                .iter_mut()
                .zip(entries)
                .for_each(|(place, entry)| *place -= entry * own[0]);
        }
        found
    }

    /// Solves Rᵀ z = `values` for z, with the triangular factor R.
    fn transpose_substitute(&self, values: &[f64]) -> Vec<f64> {
        let mut found: Vec<f64> = Vec::with_capacity(values.len());
        for (column, value) in values.iter().enumerate() {
            let entries = self.packed.col_as_slice(column).iter();
            let known: f64 = entries.zip(&found).map(|(a, b)| a * b).sum();
            found.push((value - known) / self.diagonal[column]);
        }
        found
    }
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum::<f64>().sqrt()
}

/// Reflects `values` in the plane normal to the unit vector `reflector`.
fn reflect(reflector: &[f64], values: &mut [f64]) {
    let along: f64 = reflector
        .iter()
        .zip(values.iter())
        .map(|(a, b)| a * b)
        .sum();
    let places = values.iter_mut().zip(reflector);
    places.for_each(|(value, own)| *value -= 2.0 * along * own);
}

/// Power of two that scales `size` to 0.5..2; 1 for a `size` of 0. The scaling is exact.
fn power_of_two_over(size: f64) -> f64 {
    if size > 0.0 && size.is_finite() {
        (-size.log2().round()).exp2()
    } else {
        1.0
    }
}
