//! One-way random model: readings in groups with different means, and scatter within groups.

use std::collections::BTreeMap;

use crate::count::as_f64;
use crate::exact::{Dyadic, ExactSum, Fraction, Moments};

/// Variance components of groups of unequal size, in the unit of the readings.
///
/// ```
/// use taceva_metrics::OneWay;
/// let found = OneWay::of([[1.0, 2.0].as_slice(), &[4.0, 5.0]]).ok_or("two groups")?;
/// assert_eq!((found.readings, found.groups, found.mean), (4, 2, 3.0));
/// assert_eq!(found.within, 0.5_f64.sqrt());
/// // Mean squares 9 and 0.5, two readings in each group.
/// assert_eq!(found.between, 4.25_f64.sqrt());
/// # Ok::<(), &str>(())
/// ```
///
/// # Reference
/// Searle, Casella and McCulloch, Variance Components (1992), chapter 3; Satterthwaite, Biometrics Bulletin 2 (1946).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct OneWay {
    /// Number of readings.
    pub readings: u64,
    /// Number of groups.
    pub groups: u64,
    /// Mean of all readings.
    pub mean: f64,
    /// Standard uncertainty of the mean, with groups − 1 degrees of freedom. Readings of one group have a common deviation, so large groups increase
    /// this uncertainty.
    pub mean_uncertainty: f64,
    /// Mean square between groups.
    pub mean_square_between: f64,
    /// Mean square within groups.
    pub mean_square_within: f64,
    /// Effective number of readings per group, in the formula for the variance between groups.
    pub group_size: f64,
    /// Standard deviation within groups.
    pub within: f64,
    /// Degrees of freedom of `within`: readings − groups.
    pub within_freedom: f64,
    /// Standard deviation between groups; 0 if the estimated variance is negative.
    pub between: f64,
    /// Degrees of freedom of `between`; `None` if the estimated variance is not above 0.
    pub between_freedom: Option<f64>,
    /// Variance between groups, before a negative estimate is replaced by 0.
    pub between_variance_raw: f64,
    /// Standard deviation of a single reading, from the variances between and within groups.
    pub total: f64,
    /// Degrees of freedom of `total`; `None` if the readings do not vary.
    pub total_freedom: Option<f64>,
}

/// Exact sums of the readings of groups, which determine the variance components. Sums of different groups merge in any order.
///
/// ```
/// use taceva_metrics::{OneWay, OneWaySums};
/// let mut sums = OneWaySums::default();
/// sums.add(&[1.0, 2.0].into_iter().collect());
/// let mut others = OneWaySums::default();
/// others.add(&[4.0, 5.0].into_iter().collect());
/// sums.merge(&others);
/// assert_eq!(sums.model(), OneWay::of([[1.0, 2.0].as_slice(), &[4.0, 5.0]]));
/// ```
#[derive(Clone, Debug, Default)]
pub struct OneWaySums {
    readings: u64,
    groups: u64,
    squared_sizes: u64,
    sum: ExactSum,
    squares: ExactSum,
    /// Sum of the squared readings of all groups with one reading.
    singles: ExactSum,
    /// For each larger group size, the sum of (Σ x)² over the groups of this size, with readings x. One division by the size then suffices.
    of_sizes: BTreeMap<u64, Dyadic>,
}

impl OneWaySums {
    /// Adds a whole group. A group without readings is ignored.
    pub fn add(&mut self, group: &Moments) {
        if group.n == 0 {
            return;
        }
        self.readings = self.readings.saturating_add(group.n);
        self.groups += 1;
        let squared_size = group.n.saturating_mul(group.n);
        self.squared_sizes = self.squared_sizes.saturating_add(squared_size);
        self.sum.merge(&group.sum);
        self.squares.merge(&group.squares);
        if group.n == 1 {
            self.singles.merge(&group.squares);
        } else {
            let of_group = group.sum.to_dyadic();
            self.add_of_size(group.n, &(&of_group * &of_group));
        }
    }

    /// Adds the groups of `other`.
    pub fn merge(&mut self, other: &OneWaySums) {
        self.readings = self.readings.saturating_add(other.readings);
        self.groups = self.groups.saturating_add(other.groups);
        self.squared_sizes = self.squared_sizes.saturating_add(other.squared_sizes);
        self.sum.merge(&other.sum);
        self.squares.merge(&other.squares);
        self.singles.merge(&other.singles);
        for (size, above) in &other.of_sizes {
            self.add_of_size(*size, above);
        }
    }

    fn add_of_size(&mut self, size: u64, above: &Dyadic) {
        let of_size = self.of_sizes.entry(size);
        let of_size = of_size.or_insert_with(|| Dyadic::from(0));
        *of_size = &*of_size + above;
    }

    /// Number of groups.
    pub fn groups(&self) -> u64 {
        self.groups
    }

    /// Variance components; `None` for fewer than two groups, or if no group has two readings.
    pub fn model(&self) -> Option<OneWay> {
        let (n, k) = (self.readings, self.groups);
        if k < 2 || n <= k {
            return None;
        }
        let of_sizes = self.of_sizes.iter();
        let singles = Fraction::of(self.singles.to_dyadic(), 1);
        let of_groups = of_sizes.fold(singles, |all, (size, above)| {
            all.plus(&Fraction::of(above.clone(), *size))
        });
        let sum = self.sum.to_dyadic();
        let all = Fraction::of(&sum * &sum, n);
        let within = Fraction::of(self.squares.to_dyadic(), 1)
            .minus(&of_groups)
            .divided(n - k);
        let between = of_groups.minus(&all).divided(k - 1);
        // n0 = (n − Σ n² / n) / (k − 1).
        let above = &(&Dyadic::from(n) * &Dyadic::from(n)) - &Dyadic::from(self.squared_sizes);
        let size = Fraction::of(above, n).divided(k - 1);
        let raw = between.minus(&within);
        let excess = raw.at_least_zero();
        let freedoms = [as_f64(k - 1), as_f64(n - k)];
        let size_f64 = size.to_f64();
        let (ms_b, ms_w) = (between.to_f64(), within.to_f64());
        // Variance of one reading: MS_b / n0 + (1 − 1 / n0) MS_w, or MS_w alone.
        let share = if excess.is_zero() {
            0.0
        } else {
            1.0 / size_f64
        };
        let total = share * ms_b + (1.0 - share) * ms_w;
        // Variance of the mean of groups of unequal size: s_b² Σ n² / n² + MS_w / n.
        let n_f64 = as_f64(n);
        let weight = as_f64(self.squared_sizes) / (n_f64 * n_f64);
        let of_mean = weight * excess.to_f64() / size_f64 + ms_w / n_f64;
        let spread = |parts: [f64; 2]| {
            let [b, w] = parts.map(|part| part * part);
            b / freedoms[0] + w / freedoms[1]
        };
        let of_total = spread([share * ms_b, (1.0 - share) * ms_w]);
        let difference = raw.to_f64();
        Some(OneWay {
            readings: n,
            groups: k,
            mean: Fraction::of(sum, n).to_f64(),
            mean_uncertainty: of_mean.sqrt(),
            mean_square_between: ms_b,
            mean_square_within: ms_w,
            group_size: size_f64,
            within: within.root(),
            within_freedom: freedoms[1],
            between: excess.root_over(&size).unwrap_or_default(),
            between_freedom: (!excess.is_zero())
                .then(|| difference * difference / spread([ms_b, ms_w])),
            between_variance_raw: raw.over(&size).unwrap_or_default(),
            total: total.sqrt(),
            total_freedom: (of_total > 0.0).then(|| total * total / of_total),
        })
    }
}

impl OneWay {
    /// Variance components of finite readings by group; `None` for fewer than two groups, or if no group has two readings.
    ///
    /// # Panics
    /// If a reading is NaN or infinite.
    pub fn of<'a>(groups: impl IntoIterator<Item = &'a [f64]>) -> Option<OneWay> {
        let mut sums = OneWaySums::default();
        for group in groups {
            sums.add(&group.iter().copied().collect());
        }
        sums.model()
    }
}
