//! The weights of one channel along a path of strengths, a weight at a time.

use faer::Mat;
use taceva_core::{ModelError, Progress};

use crate::progress::interrupted;

/// What weights cost.
#[derive(Clone, Copy, Debug)]
pub(super) struct Penalty<'a> {
    /// Ascending, relative to the least penalty at which every weight is 0.
    pub(super) strengths: &'a [f64],
    /// The share of the penalty that is on sizes.
    pub(super) mix: f64,
}

/// Sweeps at one strength at most.
const SWEEPS: usize = 1000;

/// The largest change of a sweep, as a share of what labels vary by, at which the weights are taken as found.
const ENOUGH: f64 = 1e-5;

/// The weights at each strength, `gram` being XᵀX and `products` Xᵀy of centred X and y.
///
/// The strongest penalty comes first and every other starts from the weights before it. The gradient follows each change through a
/// column of the Gram matrix, and is formed anew at each strength, so that roundings do not add up. A strength ends where a sweep
/// changes no prediction by more than a hundred-thousandth of the typical label, or after 1,000 sweeps.
pub(super) fn path(
    gram: &Mat<f64>,
    products: &[f64],
    penalty: Penalty<'_>,
    progress: &dyn Progress,
) -> Result<Vec<Vec<f64>>, ModelError> {
    let width = products.len();
    let largest = products
        .iter()
        .fold(0.0_f64, |most, value| most.max(value.abs()));
    let mut weights = vec![0.0; width];
    let mut found = Vec::with_capacity(penalty.strengths.len());
    // What a weight that explained a channel alone would change: the unit of `ENOUGH`.
    let diagonal: Vec<f64> = (0..width).map(|feature| gram[(feature, feature)]).collect();
    let alone = products
        .iter()
        .zip(&diagonal)
        .filter(|(_, square)| **square > 0.0);
    let unit = alone.fold(0.0_f64, |most, (product, square)| {
        most.max(product.abs() / square.sqrt())
    });
    for strength in penalty.strengths.iter().rev() {
        // λn α = strength × the largest product.
        let size = strength * largest;
        let square = size * (1.0 - penalty.mix) / penalty.mix;
        let mut gradient = residual_products(gram, products, &weights);
        let mut active: Vec<usize> = Vec::new();
        let mut whole = true;
        for _ in 0..SWEEPS {
            interrupted(progress)?;
            let mut change = 0.0_f64;
            let mut step = |feature: usize, weights: &mut [f64], gradient: &mut [f64]| {
                let own = diagonal[feature];
                if own <= 0.0 {
                    return;
                }
                let before = weights[feature];
                let pull = gradient[feature] + own * before;
                let after = pull.signum() * (pull.abs() - size).max(0.0) / (own + square);
                let moved = after - before;
                if moved.abs() > 0.0 {
                    weights[feature] = after;
                    let column = gram.col_as_slice(feature);
                    let places = gradient.iter_mut().zip(column);
                    places.for_each(|(place, value)| *place -= moved * value);
                    change = change.max(moved.abs() * own.sqrt());
                }
            };
            if whole {
                (0..width).for_each(|feature| step(feature, &mut weights, &mut gradient));
                active = (0..width)
                    .filter(|&feature| weights[feature].abs() > 0.0)
                    .collect();
            } else {
                active
                    .iter()
                    .for_each(|&feature| step(feature, &mut weights, &mut gradient));
            }
            // Weights that are not 0 first, then all: a sweep of all that changes nothing ends it.
            let settled = change <= ENOUGH * unit;
            if settled && whole {
                break;
            }
            whole = settled;
        }
        found.push(weights.clone());
    }
    found.reverse();
    Ok(found)
}

/// Xᵀ(y − Xw).
fn residual_products(gram: &Mat<f64>, products: &[f64], weights: &[f64]) -> Vec<f64> {
    let mut gradient = products.to_vec();
    for (feature, weight) in weights
        .iter()
        .enumerate()
        .filter(|(_, weight)| weight.abs() > 0.0)
    {
        let places = gradient.iter_mut().zip(gram.col_as_slice(feature));
        places.for_each(|(place, value)| *place -= weight * value);
    }
    gradient
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::SplitMix64;
    use taceva_core::Silent;

    #[test]
    fn every_weight_meets_the_conditions_of_the_least() {
        let mut random = SplitMix64::new(9);
        let mut next = || f64::from(random.next_u64().to_le_bytes()[0]) / 255.0 - 0.5;
        let rows = Mat::from_fn(60, 12, |_, _| next());
        let labels: Vec<f64> = (0..60)
            .map(|row| rows[(row, 3)] - rows[(row, 7)] + 0.1 * next())
            .collect();
        let gram = Mat::from_fn(12, 12, |a, b| {
            (0..60).map(|row| rows[(row, a)] * rows[(row, b)]).sum()
        });
        let products: Vec<f64> = (0..12)
            .map(|a| (0..60).map(|row| rows[(row, a)] * labels[row]).sum())
            .collect();
        let strengths = [0.001, 0.1, 0.5, 1.0];
        let penalty = Penalty {
            strengths: &strengths,
            mix: 0.5,
        };
        let found = path(&gram, &products, penalty, &Silent).expect("not cancelled");
        let largest = products
            .iter()
            .fold(0.0_f64, |most, value| most.max(value.abs()));
        assert!(
            found[3]
                .iter()
                .all(|weight| weight.abs() < f64::MIN_POSITIVE)
        );
        assert!(found[2].iter().filter(|weight| weight.abs() > 0.0).count() < 4);
        for (strength, weights) in strengths.iter().zip(&found) {
            let size = strength * largest;
            for (weight, gradient) in weights
                .iter()
                .zip(residual_products(&gram, &products, weights))
            {
                // ∂/∂w = 0 where w is not; within the penalty where it is.
                let slack = if weight.abs() > 0.0 {
                    (gradient - size * weight - size * weight.signum()).abs()
                } else {
                    (gradient.abs() - size).max(0.0)
                };
                assert!(slack < 1e-3 * largest, "{slack} of {largest}");
            }
        }
    }
}
