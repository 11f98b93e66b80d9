//! Global risks of false acceptance and false rejection, for units of one process.

use taceva_metrics::distributions::{integral, normal};

use super::error::check;
use super::{ConformityError, Limits};

/// Distance from the mean, in standard deviations, beyond which the normal density is negligible.
const FAR: f64 = 12.0;

/// Process with normally distributed units, which are measured with a known uncertainty.
///
/// ```
/// use taceva_metrology::conformity::{Limits, Process};
/// // 95 % of units within ±1, and a test uncertainty ratio of 4.
/// let process = Process::new(0.0, 1.0 / 1.959_963_984_540_054, 0.125)?;
/// let limits = Limits::between(-1.0, 1.0)?;
/// let risk = process.risk(&limits, &limits);
/// assert!((risk.consumer - 0.0086).abs() < 5e-5 && (risk.producer - 0.0155).abs() < 5e-5);
/// # Ok::<(), taceva_metrology::conformity::ConformityError>(())
/// ```
///
/// # Reference
/// JCGM 106:2012, 9.5.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Process {
    mean: f64,
    deviation: f64,
    uncertainty: f64,
}

/// Shares of units with a wrong decision.
///
/// ```
/// use taceva_metrology::conformity::{Limits, Process};
/// let limits = Limits::at_most(1.0)?;
/// let risk = Process::new(0.0, 0.1, 0.01)?.risk(&limits, &limits);
/// assert!(risk.consumer < 1e-20 && risk.producer < 1e-20);
/// # Ok::<(), taceva_metrology::conformity::ConformityError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct GlobalRisk {
    /// Share of all units that are accepted but do not conform.
    pub consumer: f64,
    /// Share of all units that are rejected but conform.
    pub producer: f64,
}

impl Process {
    /// Process with the mean and the standard deviation of units, and the standard uncertainty of one measurement, in the same unit.
    ///
    /// # Errors
    /// [`ConformityError::Number`] for a mean that is not finite, or a deviation or uncertainty not above 0.
    pub fn new(mean: f64, deviation: f64, uncertainty: f64) -> Result<Process, ConformityError> {
        check("the mean", mean, mean.is_finite(), "a finite number")?;
        for (name, value) in [
            ("the deviation of units", deviation),
            ("the standard uncertainty", uncertainty),
        ] {
            check(
                name,
                value,
                value > 0.0 && value.is_finite(),
                "a number above 0",
            )?;
        }
        Ok(Process {
            mean,
            deviation,
            uncertainty,
        })
    }

    /// Risks of accepting values within `acceptance` if units within `limits` conform.
    #[must_use]
    pub fn risk(&self, limits: &Limits, acceptance: &Limits) -> GlobalRisk {
        GlobalRisk {
            consumer: self.consumer(limits, acceptance),
            producer: self.integral(self.ends(limits), acceptance, |unit| {
                self.refused(unit, acceptance)
            }),
        }
    }

    /// Guard band with the consumer's risk `target`: inward distance of the acceptance limits. 0 if the risk is lower without a guard band.
    ///
    /// `None` if no guard band reaches the target.
    ///
    /// # Errors
    /// [`ConformityError::Number`] for a target outside 0..1.
    pub fn guard(&self, limits: &Limits, target: f64) -> Result<Option<f64>, ConformityError> {
        check(
            "the target risk",
            target,
            target > 0.0 && target < 1.0,
            "a share above 0 and below 1",
        )?;
        let risk = |guard: f64| {
            let inner = limits.map(|least| least + guard, |most| most - guard)?;
            Some(self.consumer(limits, &inner))
        };
        if risk(0.0).is_none_or(|risk| risk <= target) {
            return Ok(Some(0.0));
        }
        let mut high = self.uncertainty;
        while risk(high).is_some_and(|risk| risk > target) {
            high *= 2.0;
        }
        let mut low = 0.0;
        for _ in 0..60 {
            let middle = f64::midpoint(low, high);
            match risk(middle) {
                Some(risk) if risk > target => low = middle,
                _ => high = middle,
            }
        }
        Ok(risk(high).map(|_| high))
    }

    fn consumer(&self, limits: &Limits, acceptance: &Limits) -> f64 {
        let [low, high] = self.ends(limits);
        let accepted = |unit: f64| self.accepted(unit, acceptance);
        let far = FAR * self.deviation;
        let below = limits.least().map_or(0.0, |least| {
            let from = least.min(self.mean) - far;
            self.integral([from, low], acceptance, accepted)
        });
        let above = limits.most().map_or(0.0, |most| {
            let to = most.max(self.mean) + far;
            self.integral([high, to], acceptance, accepted)
        });
        below + above
    }

    /// Lower and upper limit. A missing limit is [`FAR`] standard deviations from the mean, or at the other limit if that is farther.
    fn ends(&self, limits: &Limits) -> [f64; 2] {
        let far = FAR * self.deviation;
        let (low, high) = (self.mean - far, self.mean + far);
        let most = limits
            .most()
            .unwrap_or(high.max(limits.least().unwrap_or(low)));
        let least = limits.least().unwrap_or(low.min(most));
        [least, most]
    }

    fn accepted(&self, unit: f64, acceptance: &Limits) -> f64 {
        let z = |limit: f64| (limit - unit) / self.uncertainty;
        match (acceptance.least(), acceptance.most()) {
            (None, Some(most)) => normal::below(z(most)),
            (Some(least), None) => normal::above(z(least)),
            (Some(least), Some(most)) => {
                let (low, high) = (z(least), z(most));
                // Uses the tails on the side of the unit, so that small differences keep their digits.
                match low > 0.0 {
                    true => normal::above(low) - normal::above(high),
                    false => normal::below(high) - normal::below(low),
                }
            }
            (None, None) => 1.0,
        }
    }

    fn refused(&self, unit: f64, acceptance: &Limits) -> f64 {
        let z = |limit: f64| (limit - unit) / self.uncertainty;
        let below = acceptance
            .least()
            .map_or(0.0, |least| normal::below(z(least)));
        let above = acceptance.most().map_or(0.0, |most| normal::above(z(most)));
        below + above
    }

    /// Integral of the unit density times `share`, from `from` to `to`. Panels of the integral are narrow where `share` changes.
    fn integral(
        &self,
        [from, to]: [f64; 2],
        acceptance: &Limits,
        share: impl Fn(f64) -> f64,
    ) -> f64 {
        let near = FAR * self.uncertainty;
        let changes: Vec<f64> = [acceptance.least(), acceptance.most()]
            .into_iter()
            .flatten()
            .collect();
        let mut cuts = vec![from, to];
        for change in &changes {
            cuts.extend([change - near, change + near].map(|cut| cut.clamp(from, to)));
        }
        cuts.sort_by(f64::total_cmp);
        let weighted = |unit: f64| {
            normal::density((unit - self.mean) / self.deviation) / self.deviation * share(unit)
        };
        let coarse = self.deviation / 2.0;
        let mut sum = 0.0;
        for ends in cuts.windows(2).filter(|ends| ends[1] > ends[0]) {
            let middle = f64::midpoint(ends[0], ends[1]);
            let is_near = changes.iter().any(|change| (middle - change).abs() < near);
            let width = if is_near {
                coarse.min(self.uncertainty / 2.0)
            } else {
                coarse
            };
            sum += integral(weighted, ends[0], ends[1], width);
        }
        sum
    }
}
