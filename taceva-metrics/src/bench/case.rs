//! Test inputs as cases: a few numbers from which every machine computes bit-identical columns.

use super::numbers::Numbers;
use crate::pair::Paired;

/// Recipe for two columns. A plain value, which gets no further fields.
///
/// ```
/// use taceva_metrics::bench::{Kind, Order, Case};
/// let kind = Kind::Lab { low: -12.5, high: 12.5, noise: 0.3 };
/// let case = Case { kind, rows: 1600, seed: 1, order: Order::AsMade };
/// assert_eq!(case.columns().reference.len(), 1600);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    /// Kind of values.
    pub kind: Kind,
    /// Number of rows.
    pub rows: usize,
    /// Seed of the generator.
    pub seed: u64,
    /// Order of the rows.
    pub order: Order,
}

/// Kind of values. y is drawn first, then ŷ; `noise` is approximately the standard deviation of ŷ − y, or of ŷ / y.
///
/// ```
/// use taceva_metrics::bench::{Case, Kind, Order};
/// let columns = Case { kind: Kind::Met { value: 2.0 }, rows: 3, seed: 1, order: Order::AsMade }.columns();
/// assert_eq!(columns.estimate, columns.reference);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Kind {
    /// y uniform between two values, ŷ near y: typical laboratory data.
    Lab {
        /// The least y.
        low: f64,
        /// The greatest y.
        high: f64,
        /// Approximate standard deviation of ŷ − y.
        noise: f64,
    },
    /// Like `Lab`, but far from zero, where the textbook formula of SST cancels.
    Offset {
        /// Distance from zero.
        offset: f64,
        /// Least y before the offset is added.
        low: f64,
        /// Greatest y before the offset is added.
        high: f64,
        /// Approximate standard deviation of ŷ − y.
        noise: f64,
    },
    /// y and ŷ with exponents between two limits.
    Wide {
        /// The least exponent.
        low: i32,
        /// The greatest exponent.
        high: i32,
    },
    /// y with exponents between two limits, ŷ near y.
    WideNear {
        /// The least exponent.
        low: i32,
        /// The greatest exponent.
        high: i32,
        /// Approximate standard deviation of ŷ / y.
        noise: f64,
    },
    /// Every second y is the negative of the previous y, so the sum of y is exactly zero.
    Cancelling {
        /// The least exponent.
        low: i32,
        /// The greatest exponent.
        high: i32,
        /// Approximate standard deviation of ŷ − y.
        noise: f64,
    },
    /// y and ŷ below the smallest normal number.
    Denormal,
    /// Constant y, ŷ near y.
    Constant {
        /// Value of y.
        value: f64,
        /// Approximate standard deviation of ŷ.
        noise: f64,
    },
    /// Constant y, and ŷ equal to y.
    Met {
        /// Value of y and ŷ.
        value: f64,
    },
    /// Like `Lab`, rounded to binary32.
    Single {
        /// The least y.
        low: f64,
        /// The greatest y.
        high: f64,
        /// Approximate standard deviation of ŷ − y.
        noise: f64,
    },
    /// y in whole thousandths.
    Thousandths {
        /// The least y in thousandths.
        low: i32,
        /// The greatest y in thousandths.
        high: i32,
        /// Approximate standard deviation of ŷ − y.
        noise: f64,
    },
    /// y uniform between two values, errors with exponents between two limits.
    SmallErrors {
        /// The least y.
        low: f64,
        /// The greatest y.
        high: f64,
        /// The least exponent of an error.
        least: i32,
        /// The greatest exponent of an error.
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
    /// Order of generation.
    AsMade,
    /// Reversed order of generation.
    Reversed,
    /// Ascending by y, then by ŷ.
    Sorted,
    /// Shuffled, with this seed.
    Shuffled(u64),
}

impl Case {
    /// Columns of the case.
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
    /// y and ŷ of one row; `before` is the y of the previous row.
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

/// Cases that common summation algorithms compute wrongly, by name. The first case is harmless.
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
