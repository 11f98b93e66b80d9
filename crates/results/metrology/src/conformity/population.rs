//! Distribution of units from one process, estimated from measurements of several units.

use super::error::check;
use super::{ConformityError, GlobalRisk, Limits, Measurement, Process};

/// Least number of units from which a process is estimated.
const LEAST_UNITS: usize = 5;

/// Distribution of the units of one process: normal on the linear or logarithmic scale of their measurements.
///
/// ```
/// use taceva_metrology::conformity::{Limits, Measurement, Population};
/// let unit = |value| Measurement::new(value, 0.01, 30.0);
/// let units = [0.2, 0.3, 0.25, 0.35, 0.3].map(unit).into_iter().collect::<Result<Vec<_>, _>>()?;
/// let population = Population::of(&units, &unit(0.28)?)?;
/// let limits = Limits::at_most(0.4)?;
/// let risk = population.risk(&limits, &limits).ok_or("within the scale")?;
/// assert!(risk.consumer < 0.01 && risk.producer < 0.01);
/// // A consumer's risk of one in 10,000 needs a guard.
/// let inner = population.acceptance(&limits, 1e-4)?.ok_or("room")?;
/// assert!(inner.most().is_some_and(|most| most < 0.4));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Reference
/// JCGM 106:2012, 9.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Population {
    process: Process,
    measured: Measurement,
}

impl Population {
    /// Estimates the process from `units`. Further units are measured with the uncertainty of `measured`.
    ///
    /// The variance between units is the variance of their values minus the mean variance of their measurements, on the scale of `measured`.
    ///
    /// # Errors
    /// [`ConformityError::Number`] for fewer than five units, a value outside the scale, a measurement without an uncertainty, or differences of
    /// units within their uncertainties.
    pub fn of(
        units: &[Measurement],
        measured: &Measurement,
    ) -> Result<Population, ConformityError> {
        let n = units.len() as f64;
        check(
            "the number of units",
            n,
            units.len() >= LEAST_UNITS,
            "at least 5 units of one process",
        )?;
        let known = |of: &Measurement| {
            let standard = of.standard_uncertainty().unwrap_or(f64::NAN);
            let scaled = measured.at(of.value()).on_scale(standard);
            let expected = "a number, from an interval of each unit";
            check(
                "the standard uncertainty of a unit",
                scaled,
                scaled.is_finite(),
                expected,
            )
            .map(|()| scaled)
        };
        let mut places = Vec::new();
        let mut squares = Vec::new();
        for unit in units {
            let place = measured.place(unit.value());
            let expected = "a value on the scale of the other units";
            check(
                "the value of a unit",
                unit.value(),
                place.is_finite(),
                expected,
            )?;
            places.push(place);
            squares.push(known(unit)?.powi(2));
        }
        let mean = sum(&mut places) / n;
        let mut distances: Vec<f64> = places.iter().map(|place| (place - mean).powi(2)).collect();
        let variance = sum(&mut distances) / (n - 1.0) - sum(&mut squares) / n;
        check(
            "the variance of units minus that of their measurement",
            variance,
            variance > 0.0,
            "a number above 0: units that differ by more than their uncertainties",
        )?;
        let process = Process::new(mean, variance.sqrt(), known(measured)?)?;
        Ok(Population {
            process,
            measured: *measured,
        })
    }

    /// Risks of accepting values within `acceptance` if units within `limits` conform; `None` for a limit outside the scale.
    #[must_use]
    pub fn risk(&self, limits: &Limits, acceptance: &Limits) -> Option<GlobalRisk> {
        let (limits, acceptance) = (self.on_scale(limits)?, self.on_scale(acceptance)?);
        Some(self.process.risk(&limits, &acceptance))
    }

    /// Acceptance limits with the consumer's risk `target`; `None` if no guard band reaches this risk.
    ///
    /// # Errors
    /// [`ConformityError::Number`] for a target outside 0..1.
    pub fn acceptance(
        &self,
        limits: &Limits,
        target: f64,
    ) -> Result<Option<Limits>, ConformityError> {
        let Some(scaled) = self.on_scale(limits) else {
            return Ok(None);
        };
        let guard = self.process.guard(&scaled, target)?;
        Ok(guard.and_then(|guard| self.measured.narrowed(limits, guard)))
    }

    fn on_scale(&self, limits: &Limits) -> Option<Limits> {
        limits.map(
            |least| self.measured.place(least),
            |most| self.measured.place(most),
        )
    }
}

/// Sum of `numbers`, independent of their order.
fn sum(numbers: &mut [f64]) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers.iter().sum()
}
