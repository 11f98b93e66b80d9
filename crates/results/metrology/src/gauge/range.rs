//! Average and range method.

use taceva_metrics::distributions::{integral, normal};
use taceva_metrics::{Dyadic, ExactSum, Fraction};

use super::anova::{count, real};
use super::cells::Balanced;

/// Factors that convert a range to a standard deviation: 1 / d2 for trials, 1 / d2* for operators and parts.
///
/// d2 is the mean range of standard normal numbers, and d3 the standard deviation of that range. d2* = √(d2² + d3²) applies to a single range.
///
/// ```
/// use taceva_metrology::gauge::RangeConstants;
/// let of_three = RangeConstants::of(10, 3, 3);
/// // AIAG prints 0.5908, 0.5231 and 0.3146.
/// assert!((of_three.k1 - 0.5908).abs() < 5e-5 && (of_three.k2 - 0.5231).abs() < 5e-5);
/// assert!((of_three.k3 - 0.3146).abs() < 5e-5);
/// ```
///
/// # Reference
/// Duncan, Quality Control and Industrial Statistics, 5th edition (1986), table D3.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct RangeConstants {
    /// Factor of the mean range of the trials.
    pub k1: f64,
    /// Factor of the range of operator means.
    pub k2: f64,
    /// Factor of the range of part means.
    pub k3: f64,
}

impl RangeConstants {
    /// Factors from a printed table.
    ///
    /// ```
    /// use taceva_metrology::gauge::RangeConstants;
    /// assert_eq!(RangeConstants::new(0.5908, 0.5231, 0.3146).k2, 0.5231);
    /// ```
    #[must_use]
    pub fn new(k1: f64, k2: f64, k3: f64) -> RangeConstants {
        RangeConstants { k1, k2, k3 }
    }

    /// Factors at full precision, for at least two parts, operators and trials.
    #[must_use]
    pub fn of(parts: usize, operators: usize, trials: usize) -> RangeConstants {
        let one = |n| 1.0 / moment(2, n).sqrt();
        RangeConstants {
            k1: 1.0 / moment(1, trials),
            k2: one(operators),
            k3: one(parts),
        }
    }
}

/// Mean of R^`power` for the range R of `n` standard normal numbers; `power` is 1 or 2.
fn moment(power: usize, n: usize) -> f64 {
    /// Distance from the mean, in standard deviations, beyond which the density is negligible.
    const FAR: f64 = 9.0;
    /// Width of a panel of the integral, in standard deviations.
    const WIDTH: f64 = 1.0;
    let between_count = n.saturating_sub(2);
    let n = real(count(n));
    // With m the middle of the least and the greatest number, r their distance.
    let density = |r: f64| {
        let at = |m: f64| {
            let ends = normal::density(m - r / 2.0) * normal::density(m + r / 2.0);
            let between = normal::below(m + r / 2.0) - normal::below(m - r / 2.0);
            ends * whole_power(between.max(0.0), between_count)
        };
        2.0 * integral(at, 0.0, FAR, WIDTH)
    };
    let weighted = |r: f64| whole_power(r, power) * n * (n - 1.0) * density(r);
    integral(weighted, 0.0, 2.0 * FAR, WIDTH)
}

/// base^exponent by repeated multiplication.
fn whole_power(base: f64, exponent: usize) -> f64 {
    let (mut result, mut factor, mut left) = (1.0, base, exponent);
    while left > 0 {
        if left % 2 == 1 {
            result *= factor;
        }
        factor *= factor;
        left /= 2;
    }
    result
}

/// Standard deviations by the range method, in the unit of the readings.
///
/// ```
/// use taceva_metrology::gauge::{GaugeSettings, GaugeStudy, RangeConstants};
/// let mut study = GaugeStudy::default();
/// for (at, value) in [1.0, 1.1, 1.2, 1.4, 2.0, 2.2, 2.1, 2.3].into_iter().enumerate() {
///     study.add(["p", "q"][at / 4], ["A", "B"][at / 2 % 2], ["1", "2"][at % 2], value)?;
/// }
/// let constants = RangeConstants::new(0.8862, 0.7071, 0.7071);
/// let found = study.range_with(&GaugeSettings::default(), &constants)?;
/// // Ranges 0.1, 0.2, 0.2 and 0.2.
/// assert!((found.equipment - 0.175 * 0.8862).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct RangeEstimate {
    /// Equipment variation: standard deviation between trials.
    pub equipment: f64,
    /// Appraiser variation: standard deviation between operators.
    pub appraiser: f64,
    /// Equipment and appraiser variation combined.
    pub gauge: f64,
    /// Part variation: standard deviation between parts.
    pub part: f64,
    /// Gauge and part variation combined.
    pub total: f64,
}

pub(super) fn estimate(study: &Balanced, constants: &RangeConstants) -> RangeEstimate {
    let (o, p) = (count(study.operators), count(study.parts));
    let r = count(study.trials);
    let mut ranges = ExactSum::default();
    let mut of_operators = vec![ExactSum::default(); study.operators];
    let mut of_parts = vec![ExactSum::default(); study.parts];
    for (at, cell) in study.cells().enumerate() {
        let sum: ExactSum = cell.iter().copied().collect();
        of_operators[at / study.parts].merge(&sum);
        of_parts[at % study.parts].merge(&sum);
        ranges.add(cell.iter().copied().fold(f64::MIN, f64::max));
        ranges.add(-cell.iter().copied().fold(f64::MAX, f64::min));
    }
    let equipment = Fraction::of(ranges.to_dyadic(), o * p).to_f64() * constants.k1;
    let operators = Fraction::of(spread(&of_operators), p * r).to_f64() * constants.k2;
    let part = Fraction::of(spread(&of_parts), o * r).to_f64() * constants.k3;
    let noise = equipment * equipment / real(p * r);
    let appraiser = (operators * operators - noise).max(0.0).sqrt();
    let gauge = (equipment * equipment + appraiser * appraiser).sqrt();
    RangeEstimate {
        equipment,
        appraiser,
        gauge,
        part,
        total: (gauge * gauge + part * part).sqrt(),
    }
}

/// Greatest sum minus least sum.
fn spread(sums: &[ExactSum]) -> Dyadic {
    let mut ends: Option<[Dyadic; 2]> = None;
    for sum in sums.iter().map(ExactSum::to_dyadic) {
        let [low, high] = ends.unwrap_or_else(|| [sum.clone(), sum.clone()]);
        let is_low = (&sum - &low).is_negative();
        let is_high = (&high - &sum).is_negative();
        ends = Some([
            if is_low { sum.clone() } else { low },
            if is_high { sum } else { high },
        ]);
    }
    ends.map_or(Dyadic::from(0), |[low, high]| &high - &low)
}
