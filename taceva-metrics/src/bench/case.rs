//! Test cases: a few numbers each, from which every machine computes bit-identical columns of truth and estimate.

use super::numbers::Numbers;
use crate::pair::Paired;

/// Recipe for a column of truth (`reference`) and a column of estimates (`estimate`). A plain value, which gets no further fields.
///
/// ```
/// use taceva_metrics::bench::{Kind, Order, Case};
/// let kind = Kind::Lab { low: -12.5, high: 12.5, noise: 0.3 };
/// let case = Case { kind, rows: 1600, seed: 1, order: Order::AsMade };
/// assert_eq!(case.columns().reference.len(), 1600);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    /// Distribution of truth and estimate.
    pub kind: Kind,
    /// Number of rows.
    pub rows: usize,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Order of the rows.
    pub order: Order,
}

/// Distribution of truth y and estimate ŷ. The generator draws y first, then ŷ. `noise` is approximately the standard deviation of ŷ − y. In
/// [`WideNear`](Kind::WideNear) it is that of ŷ / y.
///
/// ```
/// use taceva_metrics::bench::{Case, Kind, Order};
/// let columns = Case { kind: Kind::Met { value: 2.0 }, rows: 3, seed: 1, order: Order::AsMade }.columns();
/// assert_eq!(columns.estimate, columns.reference);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Kind {
    /// Typical laboratory data: truth uniform between two values, estimate near the truth.
    Lab {
        /// Least truth.
        low: f64,
        /// Greatest truth.
        high: f64,
        /// Approximate standard deviation of estimate − truth.
        noise: f64,
    },
    /// Like `Lab`, plus an offset. Far from zero, the textbook formula of the total sum of squares loses digits by cancellation.
    Offset {
        /// Number that is added to every truth and estimate.
        offset: f64,
        /// Least truth before the offset is added.
        low: f64,
        /// Greatest truth before the offset is added.
        high: f64,
        /// Approximate standard deviation of estimate − truth.
        noise: f64,
    },
    /// Truth and estimate with independent random binary exponents between two limits.
    Wide {
        /// Least binary exponent.
        low: i32,
        /// Greatest binary exponent.
        high: i32,
    },
    /// Truth with a random binary exponent between two limits, estimate near the truth.
    WideNear {
        /// Least binary exponent of the truth.
        low: i32,
        /// Greatest binary exponent of the truth.
        high: i32,
        /// Approximate standard deviation of estimate / truth.
        noise: f64,
    },
    /// Every second truth is the negative of the previous truth. For an even number of rows, the sum of the truth is exactly zero.
    Cancelling {
        /// Least binary exponent of the truth.
        low: i32,
        /// Greatest binary exponent of the truth.
        high: i32,
        /// Approximate standard deviation of estimate − truth.
        noise: f64,
    },
    /// Truth and estimate with magnitudes below the smallest normal number of binary64.
    Denormal,
    /// Constant truth, estimate near the truth.
    Constant {
        /// Value of every truth.
        value: f64,
        /// Approximate standard deviation of the estimates.
        noise: f64,
    },
    /// Constant truth, estimate equal to the truth.
    Met {
        /// Value of every truth and estimate.
        value: f64,
    },
    /// Like `Lab`, with truth and estimate rounded to binary32.
    Single {
        /// Least truth.
        low: f64,
        /// Greatest truth.
        high: f64,
        /// Approximate standard deviation of estimate − truth.
        noise: f64,
    },
    /// Truth in whole thousandths, estimate near the truth.
    Thousandths {
        /// Least truth in thousandths.
        low: i32,
        /// Greatest truth in thousandths.
        high: i32,
        /// Approximate standard deviation of estimate − truth.
        noise: f64,
    },
    /// Truth uniform between two values; errors with random binary exponents between two limits.
    SmallErrors {
        /// Least truth.
        low: f64,
        /// Greatest truth.
        high: f64,
        /// Least binary exponent of an error.
        least: i32,
        /// Greatest binary exponent of an error.
        greatest: i32,
    },
}

/// Order of rows.
///
/// ```
/// use taceva_metrics::bench::Order;
/// assert_ne!(Order::Shuffled(1), Order::Shuffled(2));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Order {
    /// Rows in the order of generation.
    AsMade,
    /// Rows in reverse order of generation.
    Reversed,
    /// Rows in ascending order of truth, then of estimate.
    Sorted,
    /// Rows in random order, determined by this seed.
    Shuffled(u64),
}

impl Case {
    /// Computes the columns of truth and estimate.
    pub fn columns(&self) -> Paired<Vec<f64>> {
        let mut random = Numbers::new(self.seed);
        let mut rows: Vec<(f64, f64)> = Vec::with_capacity(self.rows);
        for row in 0..self.rows {
            let before = rows.last().map(|row| row.0);
            let pair = self.kind.draw(row, before, &mut random);
            rows.push(pair);
        }
        match self.order {
            Order::AsMade => {}
            Order::Reversed => rows.reverse(),
            Order::Sorted => rows
                .sort_by(|left, right| left.0.total_cmp(&right.0).then(left.1.total_cmp(&right.1))),
            Order::Shuffled(seed) => Numbers::new(seed).shuffle(&mut rows),
        }
        let (reference, estimate) = rows.into_iter().unzip();
        Paired {
            estimate,
            reference,
        }
    }
}

impl Kind {
    /// Truth and estimate of one row. `before` is the truth of the previous row.
    fn draw(self, row: usize, before: Option<f64>, random: &mut Numbers) -> (f64, f64) {
        match self {
            Kind::Lab { low, high, noise } => {
                let y = low + (high - low) * random.unit();
                (y, y + noise * random.bell())
            }
            Kind::Offset {
                offset,
                low,
                high,
                noise,
            } => {
                let y = offset + (low + (high - low) * random.unit());
                (y, y + noise * random.bell())
            }
            Kind::Wide { low, high } => (random.wide(low, high), random.wide(low, high)),
            Kind::WideNear { low, high, noise } => {
                let y = random.wide(low, high);
                (y, y * (1.0 + noise * random.bell()))
            }
            Kind::Cancelling { low, high, noise } => {
                let y = match before.filter(|_| row % 2 == 1) {
                    Some(before) => -before,
                    None => random.wide(low, high),
                };
                (y, y + noise * random.bell())
            }
            Kind::Denormal => (random.denormal(), random.denormal()),
            Kind::Constant { value, noise } => (value, value + noise * random.bell()),
            Kind::Met { value } => (value, value),
            Kind::Single { low, high, noise } => {
                let y = to_single(low + (high - low) * random.unit());
                (y, to_single(y + noise * random.bell()))
            }
            Kind::Thousandths { low, high, noise } => {
                let levels = u64::try_from(high - low + 1).expect("levels in order");
                let level = i32::try_from(random.below(levels)).expect("fewer than 2^31 levels");
                let y = f64::from(low + level) / 1000.0;
                (y, y + noise * random.bell())
            }
            Kind::SmallErrors {
                low,
                high,
                least,
                greatest,
            } => {
                let y = low + (high - low) * random.unit();
                (y, y + random.wide(least, greatest))
            }
        }
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "the case is rounded to binary32"
)]
fn to_single(value: f64) -> f64 {
    f64::from(value as f32)
}

/// Named cases that common summation algorithms compute inaccurately. The first case is typical laboratory data, for comparison.
pub fn nasty_inputs() -> impl Iterator<Item = (&'static str, Case)> {
    let case = |kind, rows, order| Case {
        kind,
        rows,
        seed: 20_261_121,
        order,
    };
    let offset = |offset| Kind::Offset {
        offset,
        low: 0.0,
        high: 1.0,
        noise: 0.03,
    };
    let small_errors = Kind::SmallErrors {
        low: -12.5,
        high: 12.5,
        least: -60,
        greatest: 0,
    };
    let inputs = [
        (
            "lab",
            Kind::Lab {
                low: -12.5,
                high: 12.5,
                noise: 0.3,
            },
            Order::AsMade,
        ),
        ("offset 1e6", offset(1e6), Order::AsMade),
        ("offset 1e9", offset(1e9), Order::AsMade),
        (
            "cancelling",
            Kind::Cancelling {
                low: -40,
                high: 40,
                noise: 1e-6,
            },
            Order::AsMade,
        ),
        ("small errors", small_errors, Order::AsMade),
        ("small errors, sorted", small_errors, Order::Sorted),
        (
            "wide",
            Kind::Wide {
                low: -100,
                high: 100,
            },
            Order::AsMade,
        ),
        ("denormal", Kind::Denormal, Order::AsMade),
        (
            "binary32",
            Kind::Single {
                low: -12.5,
                high: 12.5,
                noise: 0.3,
            },
            Order::AsMade,
        ),
    ];
    inputs
        .into_iter()
        .map(move |(name, kind, order)| (name, case(kind, 20_011, order)))
}
