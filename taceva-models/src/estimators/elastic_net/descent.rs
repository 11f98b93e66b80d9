//! Coordinate descent: computes the weights of one channel for a sequence of penalties.

use taceva_core::{ModelError, Progress};

use super::predictors::{Predictors, Residual, Target};
use crate::linalg::progress::interrupted;

/// Penalties for which the weights of one channel are computed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Penalty<'a> {
    /// Strengths, ascending. Strength 1 is the least penalty at which every weight is 0.
    pub(super) strengths: &'a [f64],
    /// Share α of the penalty that is on absolute weights. The rest is on squared weights.
    pub(super) mix: f64,
}

/// Maximum number of sweeps over the weights at one strength.
const SWEEPS: usize = 1000;

/// Convergence threshold: greatest change of predictions by one weight in a sweep, divided by the greatest effect that a single weight can have.
const ENOUGH: f64 = 3e-4;

/// Computes the weights at each strength.
///
/// Starts with the strongest penalty. Every other strength starts from the weights of the previous strength. The sweeps at one strength end when no
/// change exceeds `ENOUGH`, or after `SWEEPS` sweeps.
pub(super) fn path(
    predictors: &Predictors,
    target: Target<'_>,
    penalty: Penalty<'_>,
    progress: &dyn Progress,
) -> Result<Vec<Vec<f64>>, ModelError> {
    let products = target.products;
    let width = products.len();
    let largest = products
        .iter()
        .fold(0.0_f64, |most, value| most.max(value.abs()));
    let mut weights = vec![0.0; width];
    let mut found = Vec::with_capacity(penalty.strengths.len());
    // Largest effect of a weight that explains a channel alone: the unit of `ENOUGH`.
    let alone = products
        .iter()
        .zip(&predictors.squares)
        .filter(|(_, square)| **square > 0.0);
    let unit = alone.fold(0.0_f64, |most, (product, square)| {
        most.max(product.abs() / square.sqrt())
    });
    for strength in penalty.strengths.iter().rev() {
        // λn α = strength × the largest product.
        let size = strength * largest;
        let square = size * (1.0 - penalty.mix) / penalty.mix;
        let mut residual = Residual::new(predictors, target, &weights);
        let mut active: Vec<usize> = Vec::new();
        let mut whole = true;
        for _ in 0..SWEEPS {
            interrupted(progress)?;
            let mut change = 0.0_f64;
            let mut step = |feature: usize| {
                let own = predictors.squares[feature];
                if own <= 0.0 {
                    return;
                }
                let before = weights[feature];
                let pull = residual.along(feature) + own * before;
                let after = pull.signum() * (pull.abs() - size).max(0.0) / (own + square);
                let moved = after - before;
                if moved.abs() > 0.0 {
                    weights[feature] = after;
                    residual.follow(feature, moved);
                    change = change.max(moved.abs() * own.sqrt());
                }
            };
            if whole {
                (0..width).for_each(step);
                active = (0..width)
                    .filter(|&feature| weights[feature].abs() > 0.0)
                    .collect();
            } else {
                active.iter().for_each(|&feature| step(feature));
            }
            // Alternates sweeps of nonzero weights with full sweeps. A full sweep without change ends the loop.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::{Design, FeatureScale};
    use taceva_core::random::SplitMix64;
    use taceva_core::{FeatureShape, Features, SilentProgress};

    /// Test samples of twelve features, with labels computed from two of the features.
    fn problem(samples: usize) -> (Features, Vec<f64>) {
        let mut random = SplitMix64::new(9);
        let mut next = || f32::from(random.next_u64().to_le_bytes()[0]) / 255.0 - 0.5;
        let values: Vec<f32> = (0..12 * samples).map(|_| next()).collect();
        let labels: Vec<f64> = values
            .chunks_exact(12)
            .map(|row| f64::from(row[3] - row[7] + 0.1 * next()))
            .collect();
        let mean = labels.iter().sum::<f64>() / labels.len() as f64;
        let labels = labels.iter().map(|label| label - mean).collect();
        let features = Features::new(FeatureShape::flat(12), values).expect("whole samples");
        (features, labels)
    }

    fn products(features: &Features, design: &Design<'_>, labels: &[f64]) -> Vec<f64> {
        let labels = faer::Mat::from_fn(features.samples(), 1, |row, _| labels[row]);
        let products = design.transpose_times(labels.as_ref());
        products.col_as_slice(0).to_vec()
    }

    const STRENGTHS: [f64; 4] = [0.001, 0.1, 0.5, 1.0];
    const HALF: Penalty<'_> = Penalty {
        strengths: &STRENGTHS,
        mix: 0.5,
    };

    #[test]
    fn every_weight_meets_the_conditions_of_the_least_in_either_layout() {
        let (features, labels) = problem(60);
        let design = Design::new(&features, FeatureScale::None);
        let products = products(&features, &design, &labels);
        let largest = products
            .iter()
            .fold(0.0_f64, |most, value| most.max(value.abs()));
        let target = Target {
            labels: &labels,
            products: &products,
        };
        let gram = Predictors::of_products(&design, &SilentProgress).expect("not cancelled");
        for predictors in [&gram, &Predictors::of_columns(&design)] {
            let found = path(predictors, target, HALF, &SilentProgress).expect("not cancelled");
            assert!(
                found[3]
                    .iter()
                    .all(|weight| weight.abs() < f64::MIN_POSITIVE)
            );
            assert!(found[2].iter().filter(|weight| weight.abs() > 0.0).count() < 4);
            for (strength, weights) in STRENGTHS.iter().zip(&found) {
                let size = strength * largest;
                let residual = Residual::new(&gram, target, weights);
                for (feature, weight) in weights.iter().enumerate() {
                    let gradient = residual.along(feature);
                    // ∂/∂w is 0 for a nonzero weight, and within the penalty for a zero weight.
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

    #[test]
    fn fewer_samples_than_half_the_features_are_kept_as_columns() {
        let (features, labels) = problem(5);
        let design = Design::new(&features, FeatureScale::Unit);
        let products = products(&features, &design, &labels);
        let target = Target {
            labels: &labels,
            products: &products,
        };
        let chosen = Predictors::of(&design, &SilentProgress).expect("not cancelled");
        let products = Predictors::of_products(&design, &SilentProgress).expect("not cancelled");
        let [ours, other] = [&chosen, &products].map(|predictors| {
            path(predictors, target, HALF, &SilentProgress).expect("not cancelled")
        });
        assert!(format!("{chosen:?}").contains("Columns"));
        for (ours, other) in ours.iter().flatten().zip(other.iter().flatten()) {
            assert!((ours - other).abs() < 1e-4, "{ours} against {other}");
        }
    }
}
