//! Coordinates of samples in their span, used if there are no more samples than features.
//!
//! A rotation of the features does not change ridge regression or the least-norm solution of least squares. The weights have no component outside the
//! span of the samples. The samples are centred, so that their span has fewer dimensions than there are samples. A library that requires more samples
//! than features can therefore compute the same result in these coordinates.

use crate::estimators::library::predictor::Weighted;
use crate::linalg::dot;

/// Orthonormal basis of the span of centred rows, and the coordinates of the rows in this basis.
pub(crate) struct Span {
    /// Mean row, shape `[features]`.
    centre: Vec<f64>,
    /// Orthonormal basis vectors, shape `[dimensions, features]`.
    basis: Vec<f64>,
    features: usize,
    /// Coordinates of the rows, shape `[samples, dimensions]`.
    pub(crate) rows: Vec<f64>,
}

/// Norm of the remainder of a row after projection, relative to the longest row, up to which the row adds no basis vector.
const TOLERANCE: f64 = 1e-10;

impl Span {
    /// Computes the span of `rows`, shape `[samples, features]`, by the Gram–Schmidt method with every projection done twice.
    pub(crate) fn new(rows: &[f64], features: usize) -> Span {
        // Single-precision rows are centred only up to rounding, which would add a dimension.
        let centre = mean(rows, features);
        let rows: Vec<f64> = (rows.chunks_exact(features))
            .flat_map(|row| {
                row.iter()
                    .zip(&centre)
                    .map(|(value, centre)| value - centre)
            })
            .collect();
        let mut basis: Vec<f64> = Vec::new();
        let longest = rows.chunks_exact(features).map(norm).fold(0.0, f64::max);
        for row in rows.chunks_exact(features) {
            let mut left = row.to_vec();
            for _ in 0..2 {
                for direction in basis.chunks_exact(features) {
                    let along = dot(&left, direction);
                    let places = left.iter_mut().zip(direction);
                    places.for_each(|(place, value)| *place -= along * value);
                }
            }
            let length = norm(&left);
            if length > TOLERANCE * longest {
                basis.extend(left.iter().map(|value| value / length));
            }
        }
        let coordinates = rows.chunks_exact(features).flat_map(|row| {
            let directions = basis.chunks_exact(features);
            directions
                .map(|direction| dot(row, direction))
                .collect::<Vec<_>>()
        });
        Span {
            rows: coordinates.collect(),
            centre,
            features,
            basis,
        }
    }

    /// Converts `weights` for span coordinates to weights for features, with the bias that accounts for the centring.
    pub(crate) fn weights(&self, weights: &[f64]) -> Weighted {
        let mut of_features = vec![0.0; self.features];
        for (weight, direction) in weights.iter().zip(self.basis.chunks_exact(self.features)) {
            let places = of_features.iter_mut().zip(direction);
            places.for_each(|(place, value)| *place += weight * value);
        }
        let bias = -dot(&of_features, &self.centre);
        (of_features, bias)
    }
}

/// Mean of each feature over `rows`, shape `[features]`.
fn mean(rows: &[f64], features: usize) -> Vec<f64> {
    let samples = (rows.len() / features) as f64;
    let mut mean = vec![0.0; features];
    for row in rows.chunks_exact(features) {
        let places = mean.iter_mut().zip(row);
        places.for_each(|(place, value)| *place += value / samples);
    }
    mean
}

fn norm(values: &[f64]) -> f64 {
    dot(values, values).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_keep_their_products_and_dependent_ones_add_no_dimension() {
        // Four points of a plane.
        let rows = [1.0, 2.0, -1.0, 0.5, 0.0, 3.0, 1.5, 2.0, 2.0, 0.0, 0.0, 0.0];
        let span = Span::new(&rows, 3);
        assert_eq!(span.rows.len(), 4 * 2);
        let weights = [0.3, -0.7];
        let (of_features, bias) = span.weights(&weights);
        for (row, own) in rows.chunks_exact(3).zip(span.rows.chunks_exact(2)) {
            // A row has the same prediction from its coordinates as from its features.
            let found = dot(row, &of_features) + bias;
            assert!((found - dot(own, &weights)).abs() < 1e-12);
        }
        let centred = |row: usize| -> Vec<f64> {
            let own = rows[row * 3..row * 3 + 3].iter().zip(&span.centre);
            own.map(|(value, centre)| value - centre).collect()
        };
        for (one, other) in [(0, 0), (0, 1), (1, 2), (2, 3)] {
            let expected = dot(&centred(one), &centred(other));
            let own = |row: usize| &span.rows[row * 2..row * 2 + 2];
            assert!((dot(own(one), own(other)) - expected).abs() < 1e-12);
        }
    }
}
