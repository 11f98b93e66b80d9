//! Least-squares line through predictions over truth, and the greatest deviation from the line.

use crate::exact::merge::Merge;
use crate::exact::record::Record;
use crate::exact::single::exactly;
use crate::exact::{ColumnSums, Dyadic, ExactSum};
use crate::geometry::{GrowingHull, Hull};
use crate::pair::is_valid;
use crate::score::value::UndefinedReason;

/// Least number of samples for a line. Two samples are always on a line.
pub(super) const LEAST_SAMPLES: u64 = 3;

/// Pairs of columns to multiply for Σ x² and Σ x y. Column 0 is the truth x, column 1 the prediction y.
pub(super) const PRODUCTS: [[usize; 2]; 2] = [[0, 0], [0, 1]];

/// Sums over the pairs of one channel, with x the truth and y the prediction.
///
/// The greatest deviation from any line is at a corner of the convex hull, so only the hull of the pairs is stored.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct LineSums {
    n: u64,
    n_invalid: u64,
    hull: GrowingHull,
    /// Σ x, Σ y, Σ x² and Σ x y over pairs, with the truth x and the prediction y.
    sums: [ExactSum; 4],
}

impl LineSums {
    /// Number of samples.
    pub(super) fn n(&self) -> u64 {
        self.n
    }

    /// Number of skipped samples.
    pub(super) fn n_invalid(&self) -> u64 {
        self.n_invalid
    }

    /// Converts the sums to a record for a saved state, with the corners of the hull as x, y, x, y, ….
    pub(super) fn to_record(&self) -> Record {
        Record {
            counts: vec![self.n, self.n_invalid],
            sums: self.sums.to_vec(),
            values: self.hull.hull().corners().concat(),
            ..Record::default()
        }
    }

    /// Reads the sums from a record of a saved state.
    pub(super) fn read_record(record: &Record) -> Result<LineSums, String> {
        let (&[n, n_invalid], sums) = record.with_cells()?;
        let hull = Hull::from_values(&record.values)?;
        if hull.is_empty() != (n == 0) || !record.cells.is_empty() {
            return Err(format!(
                "{n} samples and {} corners of their hull, expected both or neither",
                hull.corners().len()
            ));
        }
        Ok(LineSums {
            n,
            n_invalid,
            hull: hull.into(),
            sums: sums.clone(),
        })
    }
}

impl ColumnSums for LineSums {
    fn sums(&mut self) -> [&mut [ExactSum]; 2] {
        let (values, products) = self.sums.split_at_mut(2);
        [values, products]
    }

    fn take(&mut self, columns: &[&[f64]]) {
        let &[truth, estimate] = columns else { return };
        self.n += u64::try_from(truth.len()).expect("no column has 2^64 rows");
        let points = truth.iter().zip(estimate);
        self.hull.extend(points.map(|(&x, &y)| [x, y]));
    }

    fn leave_out(&mut self) {
        self.n_invalid += 1;
    }
}

impl Merge for LineSums {
    fn merge(&mut self, other: &LineSums) {
        self.n = self.n.saturating_add(other.n);
        self.n_invalid = self.n_invalid.saturating_add(other.n_invalid);
        self.hull.merge(other.hull.hull());
        self.sums.merge(&other.sums);
    }
}

/// Least-squares line y = a + b x of predictions y over truths x. Each number is an exact rational, rounded once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Line {
    /// Slope b = (n Σ x y − Σ x Σ y) / (n Σ x² − (Σ x)²) over n truths x and predictions y.
    pub(super) slope: f64,
    /// Offset a = (Σ y Σ x² − Σ x Σ x y) / (n Σ x² − (Σ x)²) over n truths x and predictions y.
    pub(super) offset: f64,
}

/// Greatest deviation of predictions y from the least-squares line a + b x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Deviation {
    /// Greatest deviation of a prediction from the line: max |y − a − b x|, in the unit of the channel.
    pub(super) greatest: f64,
    /// Greatest deviation as a share of the range of the truth: max |y − a − b x| / (max x − min x).
    pub(super) relative: f64,
}

/// Exact terms from which a [`Line`] of predictions y over n truths x is computed.
struct Fit {
    n: Dyadic,
    /// Sums Σ x of the truths and Σ y of the predictions.
    sums: [Dyadic; 2],
    /// Numerator of the slope: n Σ x y − Σ x Σ y over n truths x and predictions y.
    shared: Dyadic,
    /// Denominator of slope and offset: n Σ x² − (Σ x)² over n truths x.
    spread: Dyadic,
    /// Numerator of the offset: Σ y Σ x² − Σ x Σ x y over truths x and predictions y.
    rest: Dyadic,
    /// Range of the truth: max x − min x.
    range: Dyadic,
}

impl Fit {
    fn of(sums: &LineSums) -> Result<Fit, UndefinedReason> {
        if sums.n == 0 {
            return Err(UndefinedReason::Empty);
        }
        if sums.n < LEAST_SAMPLES {
            return Err(UndefinedReason::TooFew {
                least: LEAST_SAMPLES,
            });
        }
        let n = Dyadic::from(sums.n);
        let [x, y, xx, xy] = [0, 1, 2, 3].map(|sum| sums.sums[sum].to_dyadic());
        let spread = &(&n * &xx) - &(&x * &x);
        let hull = sums.hull.hull();
        let range = hull.extent(0).filter(|[low, high]| low < high);
        let Some([low, high]) = range.filter(|_| !spread.is_zero()) else {
            let mut corners = hull.corners().iter();
            let perfect = corners.all(|&[x, y]| exactly_equal(x, y));
            return Err(UndefinedReason::ConstantTruth { perfect });
        };
        Ok(Fit {
            shared: &(&n * &xy) - &(&x * &y),
            rest: &(&y * &xx) - &(&x * &xy),
            range: &exactly(high) - &exactly(low),
            sums: [x, y],
            spread,
            n,
        })
    }
}

impl Line {
    /// Least-squares line through the pairs in `sums`.
    ///
    /// # Errors
    /// [`UndefinedReason`] for fewer than three samples, or a truth that does not vary.
    pub(super) fn through(sums: &LineSums) -> Result<Line, UndefinedReason> {
        let fit = Fit::of(sums)?;
        Ok(Line {
            slope: fit.shared.over(&fit.spread),
            offset: fit.rest.over(&fit.spread),
        })
    }
}

impl Deviation {
    /// Greatest deviation of the predictions in `sums` from their least-squares line over the truth.
    ///
    /// # Errors
    /// The errors of [`Line::through`].
    pub(super) fn of(sums: &LineSums) -> Result<Deviation, UndefinedReason> {
        let fit = Fit::of(sums)?;
        let [x, y] = &fit.sums;
        let scale = &fit.n * &fit.spread;
        let relative_scale = &scale * &fit.range;
        let (mut greatest, mut relative) = (0.0_f64, 0.0_f64);
        for corner in sums.hull.hull().corners() {
            let [truth, estimate] = corner.map(exactly);
            let above_mean = &(&fit.n * &estimate) - y;
            let from_mean = &(&fit.n * &truth) - x;
            let deviation = &(&above_mean * &fit.spread) - &(&fit.shared * &from_mean);
            greatest = greatest.max(deviation.over(&scale).abs());
            relative = relative.max(deviation.over(&relative_scale).abs());
        }
        Ok(Deviation { greatest, relative })
    }
}

fn exactly_equal(left: f64, right: f64) -> bool {
    is_valid(left) && (&exactly(left) - &exactly(right)).is_zero()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::ColumnAdder;

    fn sums(pairs: &[[f64; 2]]) -> LineSums {
        let column = |axis: usize| pairs.iter().map(|pair| pair[axis]).collect();
        let [truth, estimate]: [Vec<f64>; 2] = [column(0), column(1)];
        let mut sums = LineSums::default();
        ColumnAdder::new(PRODUCTS.to_vec()).add(&[&truth, &estimate], &mut sums);
        sums
    }

    #[test]
    fn a_hand_calculation_with_four_points() {
        // y = 0, 1, 3, 2 over x = 0..3: slope 0.8, offset 0.3; deviations −0.3, −0.1, 1.1, −0.7; range 3.
        let sums = sums(&[[0.0, 0.0], [1.0, 1.0], [2.0, 3.0], [3.0, 2.0]]);
        let line = Line::through(&sums).expect("four points");
        assert_eq!((line.slope, line.offset), (0.8, 0.3));
        let deviation = Deviation::of(&sums).expect("four points");
        assert_eq!(deviation.greatest.to_bits(), 1.1_f64.to_bits());
        assert_eq!(deviation.relative.to_bits(), (11.0_f64 / 30.0).to_bits());
    }

    #[test]
    fn the_hull_stands_for_every_point() {
        let at = |place: u32| f64::from(place * 37 % 101) / 7.0;
        let pairs: Vec<[f64; 2]> = (0..300)
            .map(|row| [at(row), 0.9 * at(row) + at(row * row)])
            .collect();
        let sums = sums(&pairs);
        let line = Line::through(&sums).expect("many points");
        let deviation = Deviation::of(&sums).expect("many points");
        let distance = |&[x, y]: &[f64; 2]| (y - line.offset - line.slope * x).abs();
        let greatest = pairs.iter().map(distance).fold(0.0, f64::max);
        // A few roundings of numbers near 20.
        assert!((deviation.greatest - greatest).abs() < 1e-13);
        assert!(sums.hull.hull().corners().len() < 30);
    }

    #[test]
    fn a_truth_that_does_not_vary_has_no_line() {
        let constant = Line::through(&sums(&[[0.1, 0.1], [0.1, 0.1], [0.1, 0.2]]));
        assert_eq!(
            constant,
            Err(UndefinedReason::ConstantTruth { perfect: false })
        );
        let two = Deviation::of(&sums(&[[0.0, 0.0], [1.0, 1.0]]));
        assert_eq!(two, Err(UndefinedReason::TooFew { least: 3 }));
        let broken = Line::through(&sums(&[[f64::NAN, 0.0]]));
        assert_eq!(broken, Err(UndefinedReason::Empty));
    }
}
