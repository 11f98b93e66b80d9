//! The dual of linear support vector regression, a sample at a time.

use faer::Mat;

use crate::linalg::dot;
use taceva_core::random::SplitMix64;

/// Errors that cost nothing, and what those beyond cost.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tube {
    pub(super) cost: f64,
    pub(super) half_width: f64,
}

/// Sweeps over all samples at most.
const SWEEPS: usize = 1000;

/// Sweeps between two looks at the gap, which cost as much as a sweep.
const LOOK: usize = 10;

/// The share of what is minimised that it may still lie above its least.
const ENOUGH: f64 = 1e-4;

/// The seed of the order in which samples are visited.
const SEED: u64 = 1;

/// The weights for labels that are centred; `rows` has a column a sample.
///
/// Ends where the gap to the dual says that no weights are better by a ten-thousandth, or after 1,000 sweeps.
pub(super) fn descend(rows: &Mat<f64>, labels: &[f64], tube: Tube) -> Vec<f64> {
    let samples = labels.len();
    let mut weights = vec![0.0; rows.nrows()];
    let mut duals = vec![0.0_f64; samples];
    let squares: Vec<f64> = (0..samples)
        .map(|sample| dot(rows.col_as_slice(sample), rows.col_as_slice(sample)))
        .collect();
    let mut order: Vec<usize> = (0..samples).collect();
    let mut random = SplitMix64::new(SEED);
    for sweep in 1..=SWEEPS {
        random.shuffle(&mut order);
        for &sample in order.iter().filter(|&&sample| squares[sample] > 0.0) {
            let row = rows.col_as_slice(sample);
            let gradient = dot(&weights, row) - labels[sample];
            let (above, below) = (gradient + tube.half_width, gradient - tube.half_width);
            let dual = duals[sample];
            let (curve, reach) = (squares[sample], squares[sample] * dual);
            let step = if above < reach {
                -above / curve
            } else if below > reach {
                -below / curve
            } else {
                -dual
            };
            let next = (dual + step).clamp(-tube.cost, tube.cost);
            let change = next - dual;
            if change.abs() > 0.0 {
                duals[sample] = next;
                let places = weights.iter_mut().zip(row);
                places.for_each(|(weight, value)| *weight += change * value);
            }
        }
        if sweep % LOOK == 0 {
            let least = objective(rows, labels, tube, &weights);
            let size = 0.5 * dot(&weights, &weights);
            let pulls = duals.iter().zip(labels);
            let pull: f64 = pulls
                .map(|(dual, label)| label * dual - tube.half_width * dual.abs())
                .sum();
            // The dual is the size subtracted from the pull: nothing is below it.
            if least - (pull - size) <= ENOUGH * least {
                break;
            }
        }
    }
    weights
}

/// ½‖w‖² + C Σ max(0, |y − wᵀx| − ε).
fn objective(rows: &Mat<f64>, labels: &[f64], tube: Tube, weights: &[f64]) -> f64 {
    let beyond = labels.iter().enumerate().map(|(sample, label)| {
        let error = (dot(weights, rows.col_as_slice(sample)) - label).abs();
        (error - tube.half_width).max(0.0)
    });
    0.5 * dot(weights, weights) + tube.cost * beyond.sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_step_in_any_direction_makes_it_better() {
        let mut random = SplitMix64::new(5);
        let mut next = || f64::from(random.next_u64().to_le_bytes()[0]) / 255.0 - 0.5;
        let rows = Mat::from_fn(3, 40, |_, _| next());
        let labels: Vec<f64> = (0..40)
            .map(|sample| rows[(0, sample)] - 2.0 * rows[(2, sample)] + 0.1 * next())
            .collect();
        for cost in [0.1, 1.0, 30.0] {
            let tube = Tube {
                cost,
                half_width: 0.02,
            };
            let weights = descend(&rows, &labels, tube);
            let least = objective(&rows, &labels, tube, &weights);
            for direction in 0..3 {
                for step in [-0.03, 0.03] {
                    let mut moved = weights.clone();
                    moved[direction] += step;
                    let found = objective(&rows, &labels, tube, &moved);
                    assert!(found > least, "{found} for {least} with {cost}");
                }
            }
        }
    }

    #[test]
    fn labels_within_the_tube_need_no_weight() {
        let rows = Mat::from_fn(2, 3, |row, column| (row + column) as f64);
        let tube = Tube {
            cost: 10.0,
            half_width: 0.5,
        };
        assert!(
            descend(&rows, &[0.1, -0.4, 0.5], tube)
                .iter()
                .all(|w| w.abs() < f64::MIN_POSITIVE)
        );
    }
}
