//! Joint regression of every prediction on all truths.

use super::sums::JointSums;
use crate::exact::single::exactly;
use crate::score::value::{Finished, UndefinedReason};

/// Slope of each prediction on each truth, as a share of full scale, the range of a truth.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Leaks {
    /// Shares by predicted channel, then by true channel; `None` if the truth of either channel is constant.
    pub(super) shares: Vec<Vec<Option<f64>>>,
    /// True if the slopes on all truths were fitted together; false if each slope was fitted alone.
    pub(super) joint: bool,
}

impl Leaks {
    /// Slope b_ij of prediction y_i on truth x_j, times range_j / range_i, where range_j is the full scale of x_j.
    ///
    /// The fit is y_i = a_i + Σ_j b_ij x_j. Products of deviations are exact and rounded once. Cholesky's method solves the normal equations,
    /// scaled to correlations. Its error increases with the collinearity of the truths.
    ///
    /// Each slope is fitted alone if there are no more samples than unknowns. The same applies if other truths explain a truth up to 10⁻⁸ of its
    /// variance. The slope is then Σ y_i x_j / Σ x_j² of deviations from the means.
    ///
    /// # Errors
    /// [`UndefinedReason`] for fewer than three samples, one channel, or no truth that varies.
    pub(super) fn of(sums: &JointSums) -> Result<Leaks, UndefinedReason> {
        /// Least number of samples for a regression.
        const LEAST: u64 = 3;
        let channels = sums.channels();
        match sums.n() {
            0 => return Err(UndefinedReason::Empty),
            1..LEAST => return Err(UndefinedReason::TooFew { least: LEAST }),
            _ => {}
        }
        if channels < 2 {
            return Err(UndefinedReason::OneChannel);
        }
        let varies = |channel: &usize| !sums.truth_products(*channel, *channel).is_zero();
        let varying: Vec<usize> = (0..channels).filter(varies).collect();
        if varying.is_empty() {
            return Err(UndefinedReason::ConstantTruth { perfect: false });
        }
        let factor = Factor::of(sums, &varying).filter(|factor| {
            let unknowns = factor.rows.iter().fold(1, |unknowns: u64, _| unknowns + 1);
            sums.n() > unknowns
        });
        let row = |predicted: usize| {
            let slopes = match &factor {
                Some(factor) => factor.slopes(sums, &varying, predicted),
                None => single_slopes(sums, &varying, predicted),
            };
            let mut shares = vec![None; channels];
            for (&truth, slope) in varying.iter().zip(slopes) {
                shares[truth] = full_scales(sums, truth, predicted).map(|ratio| slope * ratio);
            }
            shares
        };
        let shares: Vec<Vec<Option<f64>>> = (0..channels).map(row).collect();
        if !shares
            .iter()
            .flatten()
            .flatten()
            .all(|share| share.is_finite())
        {
            return Err(UndefinedReason::Overflow);
        }
        Ok(Leaks {
            shares,
            joint: factor.is_some(),
        })
    }

    /// Greatest magnitude of a share, over all pairs of different channels.
    pub(super) fn greatest(&self) -> Finished {
        let rows = self.shares.iter().enumerate();
        let leaks = rows.flat_map(|(row, shares)| {
            let others = shares.iter().enumerate();
            others.filter(move |(column, _)| *column != row)
        });
        let sizes = leaks.filter_map(|(_, share)| share.map(f64::abs));
        sizes
            .max_by(f64::total_cmp)
            .ok_or(UndefinedReason::ConstantTruth { perfect: false })
    }
}

/// Cholesky factor of the matrix of correlations between truths. Constant truths are excluded.
struct Factor {
    /// Lower triangle, row by row.
    rows: Vec<Vec<f64>>,
}

impl Factor {
    /// Factor for the truths with indices `varying`; `None` if other truths explain one of them.
    fn of(sums: &JointSums, varying: &[usize]) -> Option<Factor> {
        /// Least share of a truth's variance that the other truths do not explain.
        const LEAST_OWN: f64 = 1e-8;
        let mut rows: Vec<Vec<f64>> = Vec::new();
        for (place, &truth) in varying.iter().enumerate() {
            let mut row = Vec::with_capacity(place + 1);
            for (column, &other) in varying[..place].iter().enumerate() {
                let explained: f64 = row.iter().zip(&rows[column]).map(|(a, b)| a * b).sum();
                row.push((correlation(sums, truth, other) - explained) / rows[column][column]);
            }
            let own = 1.0 - row.iter().map(|entry| entry * entry).sum::<f64>();
            if own <= LEAST_OWN || !own.is_finite() {
                return None;
            }
            row.push(own.sqrt());
            rows.push(row);
        }
        Some(Factor { rows })
    }

    /// Slopes of the prediction of channel `predicted` on the `varying` truths, fitted together.
    fn slopes(&self, sums: &JointSums, varying: &[usize], predicted: usize) -> Vec<f64> {
        let shared = varying
            .iter()
            .map(|&truth| sums.shared_products(predicted, truth).to_f64() / deviation(sums, truth));
        let mut solution: Vec<f64> = Vec::with_capacity(varying.len());
        for (row, shared) in self.rows.iter().zip(shared) {
            let known: f64 = solution.iter().zip(row).map(|(a, b)| a * b).sum();
            solution.push((shared - known) / row[solution.len()]);
        }
        for place in (0..solution.len()).rev() {
            let below = place + 1..solution.len();
            let known: f64 = below.map(|row| self.rows[row][place] * solution[row]).sum();
            solution[place] = (solution[place] - known) / self.rows[place][place];
        }
        let scaled = solution.iter().zip(varying);
        scaled
            .map(|(slope, &truth)| slope / deviation(sums, truth))
            .collect()
    }
}

/// Standard deviation of a truth x, multiplied by n: √(n Σ x² − (Σ x)²).
fn deviation(sums: &JointSums, truth: usize) -> f64 {
    sums.truth_products(truth, truth).to_f64().sqrt()
}

fn correlation(sums: &JointSums, left: usize, right: usize) -> f64 {
    let product = sums.truth_products(left, right).to_f64();
    product / deviation(sums, left) / deviation(sums, right)
}

/// Slopes of the prediction of channel `predicted` on the `varying` truths, each fitted alone.
fn single_slopes(sums: &JointSums, varying: &[usize], predicted: usize) -> Vec<f64> {
    let slope = |&truth: &usize| {
        let shared = sums.shared_products(predicted, truth);
        shared.over(&sums.truth_products(truth, truth))
    };
    varying.iter().map(slope).collect()
}

/// Full scale of channel `truth` divided by that of channel `predicted`, rounded once. `None` if the truth of `predicted` is constant.
fn full_scales(sums: &JointSums, truth: usize, predicted: usize) -> Option<f64> {
    let range = |channel: usize| {
        let [low, high] = sums.range(channel)?;
        Some(&exactly(high) - &exactly(low))
    };
    let own = range(predicted).filter(|range| !range.is_zero())?;
    Some(range(truth)?.over(&own))
}

#[cfg(test)]
mod tests {
    use super::super::sums::products;
    use super::*;
    use crate::exact::ColumnAdder;

    /// Sums over `samples`. A sample has the truths of all channels, then their predictions.
    fn of_samples(channels: usize, samples: &[Vec<f64>]) -> JointSums {
        let mut sums = JointSums::new(channels);
        let column = |at: usize| samples.iter().map(|sample| sample[at]).collect();
        let columns: Vec<Vec<f64>> = (0..2 * channels).map(column).collect();
        let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
        ColumnAdder::new(products(channels)).add(&columns, &mut sums);
        sums
    }

    /// Sums of samples with three channels: the truths are `truths`, and the predictions are linear functions of them with `slopes`.
    fn sums(truths: impl Fn(u32) -> [f64; 3], slopes: [[f64; 3]; 3]) -> JointSums {
        let sample = |row: u32| {
            let x = truths(row);
            let estimate =
                |channel: usize| 0.5 + (0..3).map(|j| slopes[channel][j] * x[j]).sum::<f64>();
            x.into_iter().chain((0..3).map(estimate)).collect()
        };
        of_samples(3, &(0..200).map(sample).collect::<Vec<_>>())
    }

    fn spread_out(row: u32) -> [f64; 3] {
        let digit = |base: u32| f64::from(row / base % 5);
        [digit(1), 2.0 * digit(5) + 0.3 * digit(1), 10.0 * digit(25)]
    }

    #[test]
    fn linear_predictions_give_back_their_slopes_as_shares_of_full_scale() {
        let slopes = [[1.0, 0.02, 0.0], [0.05, 0.9, 0.001], [0.0, -0.25, 1.0]];
        let leaks = Leaks::of(&sums(spread_out, slopes)).expect("varied truths");
        assert!(leaks.joint);
        let ranges = [4.0, 9.2, 40.0];
        for (i, row) in slopes.iter().enumerate() {
            for (j, slope) in row.iter().enumerate() {
                let found = leaks.shares[i][j].expect("a share");
                let expected = slope * ranges[j] / ranges[i];
                assert!(
                    (found - expected).abs() < 1e-13,
                    "{i} {j}: {found}, {expected}"
                );
            }
        }
        let greatest = leaks.greatest().expect("a share");
        assert!((greatest - 0.25 * 9.2 / 40.0).abs() < 1e-13);
    }

    #[test]
    fn truths_that_move_together_are_fitted_one_by_one_and_say_so() {
        let together = |row: u32| [f64::from(row), 2.0 * f64::from(row), f64::from(row % 7)];
        let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let leaks = Leaks::of(&sums(together, identity)).expect("varied truths");
        assert!(!leaks.joint);
        // y₀ = x₀ = x₁ / 2: its full-scale motion per full-scale motion of x₁ is 1.
        assert_eq!(leaks.shares[0][1], Some(1.0));
    }

    #[test]
    fn a_truth_that_does_not_vary_leaks_nowhere_and_has_no_scale() {
        let still = |row: u32| [f64::from(row % 9), 0.25, f64::from(row % 7)];
        let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let leaks = Leaks::of(&sums(still, identity)).expect("varied truths");
        assert_eq!((leaks.shares[0][1], leaks.shares[1][0]), (None, None));
        let constant = Leaks::of(&sums(|_| [1.0, 2.0, 3.0], identity));
        assert_eq!(
            constant,
            Err(UndefinedReason::ConstantTruth { perfect: false })
        );
        assert_eq!(Leaks::of(&JointSums::new(3)), Err(UndefinedReason::Empty));
        let alone: Vec<Vec<f64>> = (0..4).map(|row| vec![f64::from(row); 2]).collect();
        let alone = of_samples(1, &alone);
        assert_eq!(Leaks::of(&alone), Err(UndefinedReason::OneChannel));
    }
}
