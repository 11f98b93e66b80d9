//! A measured value with its uncertainty.

use taceva_metrics::Scale;
use taceva_metrics::distributions::student_t;

use super::error::check;
use super::scale::OpenScale;
use super::{ConformityError, Limits};

/// Measured value with standard uncertainty and degrees of freedom, if known.
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
    scale: OpenScale,
}

/// Standard uncertainty on the scale of the distribution, with degrees of freedom.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Uncertainty {
    scaled: f64,
    freedom: f64,
}

impl Measurement {
    /// Measured value and standard uncertainty in the same unit. `freedom` may be infinite.
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
            uncertainty: Some(Uncertainty {
                scaled: standard,
                freedom,
            }),
            ..Measurement::without_uncertainty(value)?
        })
    }

    /// Measured value with a 95 % confidence interval whose ends are symmetric about the value on `scale`.
    ///
    /// The uncertainty is half the width of the interval on that scale, divided by Student's t. A Wilson interval uses the log odds.
    /// If the value or an end is outside the domain of the scale, the linear distance to the farther end is used.
    ///
    /// ```
    /// use taceva_metrics::Scale;
    /// use taceva_metrology::conformity::{Limits, Measurement};
    /// let error = Measurement::of_interval(0.08, [0.064, 0.1], 31.0, Scale::Logarithm)?;
    /// let p = error.conformance_probability(&Limits::at_most(0.1)?);
    /// assert!(p.is_some_and(|p| (p - 0.975).abs() < 1e-12));
    /// # Ok::<(), taceva_metrology::conformity::ConformityError>(())
    /// ```
    ///
    /// # Errors
    /// [`ConformityError::Number`] for a value outside its interval, an end that is not finite, or degrees of freedom not above 0.
    pub fn of_interval(
        value: f64,
        ends: [f64; 2],
        freedom: f64,
        scale: Scale,
    ) -> Result<Measurement, ConformityError> {
        let [low, high] = ends;
        for end in ends {
            check(
                "the end of the interval",
                end,
                end.is_finite(),
                "a finite number",
            )?;
        }
        let is_within = low <= value && value <= high;
        check("the value", value, is_within, "a value within its interval")?;
        let symmetric = OpenScale::candidates(scale).iter().filter_map(|scale| {
            let distances = ends.map(|end| scale.distance(value, end).abs());
            let [below, above] = distances;
            let is_finite = scale.holds(value) && below.is_finite() && above.is_finite();
            is_finite.then_some((*scale, f64::midpoint(below, above), (below - above).abs()))
        });
        let nearest = symmetric.min_by(|(_, _, one), (_, _, other)| one.total_cmp(other));
        let own = (OpenScale::Own, (value - low).max(high - value), 0.0);
        let (scale, half, _) = nearest.unwrap_or(own);
        let plain = Measurement::new(value, 0.0, freedom)?;
        let scaled = half / student_t::quantile(0.975, freedom);
        Ok(Measurement {
            uncertainty: Some(Uncertainty { scaled, freedom }),
            scale,
            ..plain
        })
    }

    /// Measured value with unknown uncertainty. Only the simple rule can decide about this value.
    ///
    /// # Errors
    /// [`ConformityError::Number`] for a value that is not finite.
    pub fn without_uncertainty(value: f64) -> Result<Measurement, ConformityError> {
        check("the value", value, value.is_finite(), "a finite number")?;
        Ok(Measurement {
            value,
            uncertainty: None,
            scale: OpenScale::Own,
        })
    }

    /// The same value with a distribution on the logarithmic scale, for quantities that are always positive.
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
        let uncertainty = self.uncertainty.map(|of| Uncertainty {
            scaled: self.in_unit(of.scaled) / self.value,
            ..of
        });
        Ok(Measurement {
            uncertainty,
            scale: OpenScale::Logarithm,
            ..self
        })
    }

    /// Measured value.
    #[must_use]
    pub fn value(&self) -> f64 {
        self.value
    }

    /// Standard uncertainty, in the unit of the value; `None` if unknown.
    #[must_use]
    pub fn standard_uncertainty(&self) -> Option<f64> {
        self.uncertainty.map(|of| self.in_unit(of.scaled))
    }

    /// Degrees of freedom of the standard uncertainty; `None` if the uncertainty is unknown.
    #[must_use]
    pub fn freedom(&self) -> Option<f64> {
        self.uncertainty.map(|of| of.freedom)
    }

    /// Coverage factor for a two-sided coverage in 0..1: the ratio of expanded to standard uncertainty. `None` without an uncertainty.
    #[must_use]
    pub fn coverage_factor(&self, coverage: f64) -> Option<f64> {
        let of = self.uncertainty?;
        Some(student_t::quantile(
            f64::midpoint(1.0, coverage),
            of.freedom,
        ))
    }

    /// Expanded uncertainty for a two-sided coverage in 0..1, on the scale of the distribution. `None` without an uncertainty.
    #[must_use]
    pub fn expanded(&self, coverage: f64) -> Option<f64> {
        Some(self.coverage_factor(coverage)? * self.uncertainty?.scaled)
    }

    /// Probability that the measured quantity is within `limits`; `None` without an uncertainty.
    ///
    /// # Reference
    /// JCGM 106:2012, 7.2 to 7.5.
    #[must_use]
    pub fn conformance_probability(&self, limits: &Limits) -> Option<f64> {
        let of = self.uncertainty?;
        if of.scaled <= 0.0 {
            return Some(if limits.contain(self.value) { 1.0 } else { 0.0 });
        }
        let t = |limit: f64| self.scale.distance(self.value, limit) / of.scaled;
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
            // Two tails about limits that hardly differ may sum to more than 1 by rounding.
            _ => Some((1.0 - beyond.into_iter().flatten().sum::<f64>()).max(0.0)),
        }
    }

    /// Words for a quantity that a guard band scales by a factor, such as the limit. `None` if the band shifts the limit by a difference.
    ///
    /// ```
    /// use taceva_metrics::Scale;
    /// use taceva_metrology::conformity::Measurement;
    /// let error = Measurement::of_interval(0.08, [0.064, 0.1], 31.0, Scale::Logarithm)?;
    /// assert_eq!(error.guarded_quantity(), Some("the limit"));
    /// # Ok::<(), taceva_metrology::conformity::ConformityError>(())
    /// ```
    #[must_use]
    pub fn guarded_quantity(&self) -> Option<&'static str> {
        self.scale.quantity()
    }

    /// Factor of a guard band on a logarithmic scale: scaled quantity at `inner` divided by the same quantity at `limit`.
    #[must_use]
    pub fn guard_quotient(&self, limit: f64, inner: f64) -> f64 {
        self.scale.quantity_of(inner) / self.scale.quantity_of(limit)
    }

    /// Converts an uncertainty from the scale of the distribution to the unit of the value.
    pub(super) fn in_unit(&self, scaled: f64) -> f64 {
        self.scale.in_unit(self.value, scaled)
    }

    /// Converts an uncertainty from the unit of the value to the scale of the distribution.
    pub(super) fn on_scale(&self, standard: f64) -> f64 {
        standard / self.in_unit(1.0)
    }

    /// Distance of `value` from the measured value on the scale of the distribution.
    pub(super) fn place(&self, value: f64) -> f64 {
        self.scale.distance(self.value, value)
    }

    /// True if `value` is in the domain of the scale.
    pub(super) fn holds(&self, value: f64) -> bool {
        self.scale.holds(value)
    }

    /// Moves both limits inwards by `guard` on the scale of the distribution; `None` for an empty range.
    pub(super) fn narrowed(&self, limits: &Limits, guard: f64) -> Option<Limits> {
        limits.map(
            |least| self.scale.moved(least, guard),
            |most| self.scale.moved(most, -guard),
        )
    }

    /// The same uncertainty on the same scale, about another value.
    pub(super) fn at(&self, value: f64) -> Measurement {
        Measurement { value, ..*self }
    }
}
