//! The least-squares line of predictions on the truth, and the greatest distance from it.

use crate::evaluate::state::Record;
use crate::exact::merge::Merge;
use crate::exact::single::exactly;
use crate::exact::{Dyadic, ExactSum};
use crate::geometry::Hull;
use crate::paired::{Paired, is_valid};
use crate::score::value::UndefinedReason;

/// Samples below which a line says nothing: two are always on one.
pub(super) const LEAST_SAMPLES: u64 = 3;

/// What is kept of the pairs of one channel: x the truth, y the prediction.
///
/// The distance from any line is greatest at a corner of the convex hull, so that the hull stands for all points.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct LineSums {
    n: u64,
    n_invalid: u64,
    hull: Hull,
    /// Σ x, Σ y, Σ x², Σ x y.
    sums: [ExactSum; 4],
}

impl LineSums {
    /// Adds pairs; those with a value that is no usable number are counted and left out.
    pub(super) fn add(&mut self, pairs: &[Paired<f64>]) {
        let valid = || pairs.iter().filter(|pair| pair.is_valid());
        let points = valid().map(|pair| [pair.reference, pair.estimate]);
        self.hull.extend(points);
        for pair in pairs {
            if !pair.is_valid() {
                self.n_invalid += 1;
                continue;
            }
            self.n += 1;
            let [x, y, xx, xy] = &mut self.sums;
            x.add(pair.reference);
            y.add(pair.estimate);
            xx.add_product(pair.reference, pair.reference);
            xy.add_product(pair.reference, pair.estimate);
        }
    }

    /// Number of samples.
    pub(super) fn n(&self) -> u64 {
        self.n
    }

    /// Number of samples left out.
    pub(super) fn n_invalid(&self) -> u64 {
        self.n_invalid
    }

    /// As a state holds it: the corners as x, y, x, y, ….
    pub(super) fn to_record(&self) -> Record {
        Record {
            counts: vec![self.n, self.n_invalid],
            sums: self.sums.to_vec(),
            values: self.hull.corners().concat(),
            ..Record::default()
        }
    }

    /// Back from a state.
    pub(super) fn read_record(record: &Record) -> Result<LineSums, String> {
        let (&[n, n_invalid], sums) = record.with_cells()?;
        let hull = Hull::from_values(&record.values)?;
        if hull.is_empty() != (n == 0) || !record.cells.is_empty() {
            return Err(format!("{n} samples and {} corners", hull.corners().len()));
        }
        Ok(LineSums {
            n,
            n_invalid,
            hull,
            sums: sums.clone(),
        })
    }
}

impl Merge for LineSums {
    fn merge(&mut self, other: &LineSums) {
        self.n = self.n.saturating_add(other.n);
        self.n_invalid = self.n_invalid.saturating_add(other.n_invalid);
        self.hull.merge(&other.hull);
        self.sums.merge(&other.sums);
    }
}

/// The best line y = offset + slope x, each number one exact rational rounded once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Line {
    /// b = (n Sxy − Sx Sy) / (n Sxx − Sx²).
    pub(super) slope: f64,
    /// a = (Sy Sxx − Sx Sxy) / (n Sxx − Sx²).
    pub(super) offset: f64,
    /// max |y − a − b x|.
    pub(super) greatest_deviation: f64,
    /// max |y − a − b x| / (max x − min x).
    pub(super) relative_deviation: f64,
}

impl Line {
    /// The line of the pairs in `sums`.
    ///
    /// # Errors
    /// [`UndefinedReason`] for fewer than three samples, or a truth that does not vary.
    pub(super) fn through(sums: &LineSums) -> Result<Line, UndefinedReason> {
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
        let range = sums.hull.extent(0).filter(|[low, high]| low < high);
        let Some([low, high]) = range.filter(|_| !spread.is_zero()) else {
            let perfect = sums
                .hull
                .corners()
                .iter()
                .all(|&[x, y]| exactly_equal(x, y));
            return Err(UndefinedReason::ConstantTruth { perfect });
        };
        let shared = &(&n * &xy) - &(&x * &y);
        let range = &exactly(high) - &exactly(low);
        let scale = &n * &spread;
        let relative_scale = &scale * &range;
        let (mut greatest_deviation, mut relative_deviation) = (0.0_f64, 0.0_f64);
        for corner in sums.hull.corners() {
            let [truth, estimate] = corner.map(exactly);
            let above_mean = &(&n * &estimate) - &y;
            let from_mean = &(&n * &truth) - &x;
            let deviation = &(&above_mean * &spread) - &(&shared * &from_mean);
            greatest_deviation = greatest_deviation.max(deviation.over(&scale).abs());
            relative_deviation = relative_deviation.max(deviation.over(&relative_scale).abs());
        }
        Ok(Line {
            slope: shared.over(&spread),
            offset: (&(&y * &xx) - &(&x * &xy)).over(&spread),
            greatest_deviation,
            relative_deviation,
        })
    }
}

fn exactly_equal(left: f64, right: f64) -> bool {
    is_valid(left) && (&exactly(left) - &exactly(right)).is_zero()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sums(pairs: &[[f64; 2]]) -> LineSums {
        let pairs: Vec<Paired<f64>> = pairs
            .iter()
            .map(|&[reference, estimate]| Paired {
                estimate,
                reference,
            })
            .collect();
        let mut sums = LineSums::default();
        sums.add(&pairs);
        sums
    }

    #[test]
    fn a_hand_calculation_with_four_points() {
        // y = 0, 1, 3, 2 over x = 0..3: slope 0.8, offset 0.3; deviations −0.3, −0.1, 1.1, −0.7; range 3.
        let line = Line::through(&sums(&[[0.0, 0.0], [1.0, 1.0], [2.0, 3.0], [3.0, 2.0]]));
        let line = line.expect("four points");
        assert_eq!((line.slope, line.offset), (0.8, 0.3));
        assert_eq!(line.greatest_deviation.to_bits(), 1.1_f64.to_bits());
        assert_eq!(
            line.relative_deviation.to_bits(),
            (11.0_f64 / 30.0).to_bits()
        );
    }

    #[test]
    fn the_hull_stands_for_every_point() {
        let at = |place: u32| f64::from(place * 37 % 101) / 7.0;
        let pairs: Vec<[f64; 2]> = (0..300)
            .map(|row| [at(row), 0.9 * at(row) + at(row * row)])
            .collect();
        let line = Line::through(&sums(&pairs)).expect("many points");
        let distance = |&[x, y]: &[f64; 2]| (y - line.offset - line.slope * x).abs();
        let greatest = pairs.iter().map(distance).fold(0.0, f64::max);
        // A few roundings of numbers near 20.
        assert!((line.greatest_deviation - greatest).abs() < 1e-13);
        assert!(sums(&pairs).hull.corners().len() < 30);
    }

    #[test]
    fn a_truth_that_does_not_vary_has_no_line() {
        let constant = Line::through(&sums(&[[0.1, 0.1], [0.1, 0.1], [0.1, 0.2]]));
        assert_eq!(
            constant,
            Err(UndefinedReason::ConstantTruth { perfect: false })
        );
        let two = Line::through(&sums(&[[0.0, 0.0], [1.0, 1.0]]));
        assert_eq!(two, Err(UndefinedReason::TooFew { least: 3 }));
        let broken = Line::through(&sums(&[[f64::NAN, 0.0]]));
        assert_eq!(broken, Err(UndefinedReason::Empty));
    }
}
