//! A measured value with its uncertainty.

use taceva_metrics::distributions::student_t;
use taceva_metrics::elementary::{exponential, logarithm};

use super::error::check;
use super::{ConformityError, Limits};

/// A measured value, and its standard uncertainty with degrees of freedom if there is one.
///
/// ```
/// use taceva_metrology::conformity::{Limits, Measurement};
/// let measured = Measurement::new(0.012, 0.006, f64::INFINITY)?;
/// let p = measured.conformance_probability(&Limits::between(-0.02, 0.02)?);
/// assert!(p.is_some_and(|p| (p - 0.908_788_732_061_098_4).abs() < 1e-14));
/// # Ok::<(), taceva_metrology::conformity::ConformityError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measurement {
    value: f64,
    uncertainty: Option<Uncertainty>,
    is_logarithmic: bool,
}

/// Standard uncertainty in the unit of the value, with its degrees of freedom.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Uncertainty {
    standard: f64,
    freedom: f64,
}

impl Measurement {
    /// Value and standard uncertainty in one unit; `freedom` may be infinite.
    ///
    /// # Errors
    /// [`ConformityError::Number`] for a value that is not finite, an uncertainty below 0 or degrees of freedom not above 0.
    pub fn new(value: f64, standard: f64, freedom: f64) -> Result<Measurement, ConformityError> {
        let is_right = standard >= 0.0 && standard.is_finite();
        check(
            "the standard uncertainty",
            standard,
            is_right,
            "a number from 0 on",
        )?;
        check(
            "the degrees of freedom",
            freedom,
            freedom > 0.0,
            "a number above 0",
        )?;
        Ok(Measurement {
            uncertainty: Some(Uncertainty { standard, freedom }),
            ..Measurement::without_uncertainty(value)?
        })
    }

    /// A value whose uncertainty is unknown, on which no rule decides but the simple one.
    ///
    /// # Errors
    /// [`ConformityError::Number`] for a value that is not finite.
    pub fn without_uncertainty(value: f64) -> Result<Measurement, ConformityError> {
        check("the value", value, value.is_finite(), "a finite number")?;
        Ok(Measurement {
            value,
            uncertainty: None,
            is_logarithmic: false,
        })
    }

    /// The same value, the logarithm of which has the distribution; as for errors that cannot be below 0.
    ///
    /// # Errors
    /// [`ConformityError::Number`] for a value that is not above 0.
    pub fn logarithmic(self) -> Result<Measurement, ConformityError> {
        check(
            "the value",
            self.value,
            self.value > 0.0,
            "a number above 0 on a logarithmic scale",
        )?;
        Ok(Measurement {
            is_logarithmic: true,
            ..self
        })
    }

    /// The value.
    #[must_use]
    pub fn value(&self) -> f64 {
        self.value
    }

    /// Standard uncertainty, in the unit of the value.
    #[must_use]
    pub fn standard_uncertainty(&self) -> Option<f64> {
        self.uncertainty.map(|of| of.standard)
    }

    /// Degrees of freedom of the standard uncertainty.
    #[must_use]
    pub fn freedom(&self) -> Option<f64> {
        self.uncertainty.map(|of| of.freedom)
    }

    /// Expanded uncertainty for a two-sided coverage in 0..1; relative to the value on a logarithmic scale.
    #[must_use]
    pub fn expanded(&self, coverage: f64) -> Option<f64> {
        let of = self.uncertainty?;
        let factor = student_t::quantile(f64::midpoint(1.0, coverage), of.freedom);
        Some(factor * self.scaled(of.standard))
    }

    /// Probability that the measured quantity is within `limits`; none without an uncertainty.
    ///
    /// # Reference
    /// JCGM 106:2012, 7.2 to 7.5.
    #[must_use]
    pub fn conformance_probability(&self, limits: &Limits) -> Option<f64> {
        let of = self.uncertainty?;
        if of.standard <= 0.0 {
            return Some(if limits.contain(self.value) { 1.0 } else { 0.0 });
        }
        let scaled = self.scaled(of.standard);
        let t = |limit: f64| self.distance(limit) / scaled;
        let beyond = [
            limits
                .most()
                .map(|most| student_t::above(t(most), of.freedom)),
            limits
                .least()
                .map(|least| student_t::below(t(least), of.freedom)),
        ];
        match beyond {
            // The smaller of both tails keeps its digits.
            [Some(above), None] if above > 0.5 => {
                Some(student_t::below(t(limits.most()?), of.freedom))
            }
            [None, Some(below)] if below > 0.5 => {
                Some(student_t::above(t(limits.least()?), of.freedom))
            }
            _ => Some(1.0 - beyond.into_iter().flatten().sum::<f64>()),
        }
    }

    /// The uncertainty on the scale of the distribution.
    fn scaled(&self, standard: f64) -> f64 {
        match self.is_logarithmic {
            true => standard / self.value,
            false => standard,
        }
    }

    /// An uncertainty on the scale of the distribution in the unit of the value.
    pub(super) fn in_unit(&self, scaled: f64) -> f64 {
        match self.is_logarithmic {
            true => scaled * self.value,
            false => scaled,
        }
    }

    /// Distance from the value to `limit` on the scale of the distribution.
    fn distance(&self, limit: f64) -> f64 {
        match self.is_logarithmic {
            true if limit <= 0.0 => f64::NEG_INFINITY,
            true => logarithm(limit / self.value),
            false => limit - self.value,
        }
    }

    /// `limit` moved by `by` on the scale of the distribution.
    pub(super) fn moved(&self, limit: f64, by: f64) -> f64 {
        match self.is_logarithmic {
            true => limit * exponential(by),
            false => limit + by,
        }
    }

    /// The same uncertainty about another value.
    pub(super) fn at(&self, value: f64) -> Measurement {
        let ratio = if self.is_logarithmic {
            value / self.value
        } else {
            1.0
        };
        Measurement {
            value,
            uncertainty: self.uncertainty.map(|of| Uncertainty {
                standard: of.standard * ratio,
                ..of
            }),
            ..*self
        }
    }
}
