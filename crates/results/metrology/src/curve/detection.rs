//! Detection limits of a calibration line.

use super::fit::CurveFit;
use super::undefined::{CurveUndefined, positive, probability};
use taceva_metrics::distributions::{noncentral_t, student_t};

/// Risks of a false and of a missed detection, and the number of averaged readings.
///
/// This type gets no further field.
///
/// ```
/// use taceva_metrology::curve::DetectionRisks;
/// let usual = DetectionRisks::default();
/// assert_eq!((usual.alpha, usual.beta, usual.readings), (0.05, 0.05, 1));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DetectionRisks {
    /// Risk of a false detection at the reference value 0.
    pub alpha: f64,
    /// Risk of a missed detection at the detectable reference value x_D.
    pub beta: f64,
    /// Number K of averaged readings.
    pub readings: u32,
}

impl Default for DetectionRisks {
    fn default() -> DetectionRisks {
        DetectionRisks {
            alpha: 0.05,
            beta: 0.05,
            readings: 1,
        }
    }
}

/// Detection limits in the unit of the reference values x, for independent rows.
///
/// ```
/// use taceva_metrology::curve::{CurveFit, CurveRow, DetectionRisks};
/// let rows: Vec<CurveRow> = [(0.0, 1.0), (1.0, 3.1), (2.0, 4.9), (3.0, 7.0)].map(|(x, y)| CurveRow::new(x, y)).into();
/// let found = CurveFit::of(&rows, 1)?.detection(DetectionRisks::default())?;
/// assert!(found.critical < found.detectable);
/// # Ok::<(), taceva_metrology::curve::CurveUndefined>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Detection {
    /// Critical value x_C. A reading above y(x_C) shows that x is not 0.
    pub critical: f64,
    /// Detectable value x_D: the least x with a risk of at most `beta` of a missed detection.
    pub detectable: f64,
    /// Noncentrality parameter δ(ν; α, β), for ν degrees of freedom of the residuals.
    pub factor: f64,
    /// Twice the critical value: the detection limit of DIN 32645.
    pub twice_critical: f64,
}

impl CurveFit {
    /// Computes x_C = t s/b √(1/K + 1/n + x̄²/S_xx), and x_D with δ in place of t.
    ///
    /// t is Student's t, s the residual standard deviation, b the slope, n the number of rows, and S_xx = Σ (x − x̄)².
    ///
    /// # Errors
    /// [`CurveUndefined::NotALine`], [`CurveUndefined::Probability`], [`CurveUndefined::NotPositive`] for no readings,
    /// [`CurveUndefined::SlopeNotShown`] at the coverage 1 − α.
    ///
    /// # Reference
    /// ISO 11843-2:2000, 5.2 and 5.3; DIN 32645:2008.
    pub fn detection(&self, risks: DetectionRisks) -> Result<Detection, CurveUndefined> {
        if self.count != 2 {
            return Err(CurveUndefined::NotALine(self.order()));
        }
        let (alpha, beta) = (probability(risks.alpha)?, probability(risks.beta)?);
        if alpha >= 0.5 {
            return Err(CurveUndefined::Probability(alpha));
        }
        let readings = positive("the number of readings", f64::from(risks.readings))?;
        let freedom = self.freedom();
        let slope = self.solution.coefficients[1] / self.axis.scale;
        let z = -self.axis.centre / self.axis.scale;
        // The centre is the mean of x, so that (ZᵀZ)⁻¹ = diag(1/n, scale²/S_xx).
        let [[of_mean, ..], [_, of_slope, ..], ..] = self.solution.inverse;
        let u = self.residual_deviation() / slope.abs()
            * (1.0 / readings + of_mean + z * z * of_slope).sqrt();
        let t = student_t::quantile(1.0 - alpha / 2.0, freedom);
        let b = self.solution.coefficients[1];
        let g = t * t * self.solution.squares / freedom * of_slope / (b * b);
        if g.is_nan() || g >= 1.0 {
            return Err(CurveUndefined::SlopeNotShown { g });
        }
        let critical = student_t::quantile(1.0 - alpha, freedom) * u;
        let factor = noncentral_t::detection_factor(freedom, alpha, beta);
        Ok(Detection {
            critical,
            detectable: factor * u,
            factor,
            twice_critical: 2.0 * critical,
        })
    }
}
