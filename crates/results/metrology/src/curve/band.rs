//! Confidence and prediction bands of a curve.

use super::fit::{Clustered, CurveFit};
use super::squares::{Square, form};
use super::undefined::{CurveUndefined, probability};
use taceva_metrics::distributions::{f_ratio, student_t};

/// Source of a covariance. This type gets no further variant: rows are independent or clustered.
///
/// ```
/// use taceva_metrology::curve::CovarianceOf;
/// assert_eq!(CovarianceOf::Points { clusters: 60 }.to_string(), "jackknife over 60 points");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CovarianceOf {
    /// Residuals of independent rows: residual variance times (XᵀX)⁻¹, with the design matrix X.
    Rows,
    /// Jackknife over contact points, with one point left out at a time.
    Points {
        /// Number of points.
        clusters: usize,
    },
}

impl std::fmt::Display for CovarianceOf {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            CovarianceOf::Rows => f.write_str("independent rows"),
            CovarianceOf::Points { clusters } => write!(f, "jackknife over {clusters} points"),
        }
    }
}

/// Value of a curve with the ends of a band, in the unit of y. Of the bands from rows and from contact points, the wider is used.
///
/// ```
/// use taceva_metrology::curve::{CovarianceOf, CurveFit, CurveRow};
/// let rows: Vec<CurveRow> = [(0.0, 1.0), (1.0, 3.1), (2.0, 4.9), (3.0, 7.0)].map(|(x, y)| CurveRow::new(x, y)).into();
/// let band = CurveFit::of(&rows, 1)?.confidence(1.5, 0.95)?;
/// assert_eq!(band.covariance, CovarianceOf::Rows);
/// assert!(band.low < 4.0 && 4.0 < band.high);
/// # Ok::<(), taceva_metrology::curve::CurveUndefined>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Band {
    /// Value y(x) of the curve, in the unit of y.
    pub value: f64,
    /// Lower end of the band.
    pub low: f64,
    /// Upper end of the band.
    pub high: f64,
    /// Standard uncertainty of the value. The half-width of the band is a multiple of this uncertainty.
    pub u: f64,
    /// Degrees of freedom of `u`.
    pub freedom: f64,
    /// Source of the covariance.
    pub covariance: CovarianceOf,
}

/// Standard uncertainty of a coefficient: the greater of those from independent rows and from contact points.
///
/// ```
/// use taceva_metrology::curve::{CovarianceOf, CurveFit, CurveRow};
/// let rows: Vec<CurveRow> = [(0.0, 1.0), (1.0, 3.1), (2.0, 4.9), (3.0, 7.0)].map(|(x, y)| CurveRow::new(x, y)).into();
/// let line = CurveFit::of(&rows, 1)?;
/// let slope = line.coefficient_uncertainty(1).ok_or("a slope")?;
/// assert_eq!((slope.covariance, slope.freedom), (CovarianceOf::Rows, 2.0));
/// assert!((slope.u - line.covariance()[1][1].sqrt()).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct CoefficientUncertainty {
    /// Standard uncertainty, in the unit of the coefficient.
    pub u: f64,
    /// Degrees of freedom of `u`.
    pub freedom: f64,
    /// Source of the covariance.
    pub covariance: CovarianceOf,
}

/// Covariance of the coefficients of the centred and scaled polynomial, with degrees of freedom.
pub(super) struct Spread {
    pub(super) covariance: Square,
    pub(super) freedom: f64,
    pub(super) of: CovarianceOf,
}

impl CurveFit {
    /// Covariance of the coefficients for independent rows.
    pub(super) fn of_rows(&self) -> Spread {
        let square = self.residual_deviation().powi(2);
        let inverse = self.solution.inverse;
        Spread {
            covariance: inverse.map(|row| row.map(|cell| cell * square)),
            freedom: self.freedom(),
            of: CovarianceOf::Rows,
        }
    }

    /// Covariance of the coefficients between contact points; `None` if undefined.
    pub(super) fn of_points(&self) -> Option<Spread> {
        let Clustered {
            covariance,
            clusters,
        } = *self.clustered.as_ref()?;
        Some(Spread {
            covariance,
            freedom: (clusters - 1) as f64,
            of: CovarianceOf::Points { clusters },
        })
    }

    /// Standard uncertainty of the coefficient of x to `power`; `None` above the order.
    pub fn coefficient_uncertainty(&self, power: usize) -> Option<CoefficientUncertainty> {
        let all = self.powers_of_x();
        let own = all.iter().take(self.count).nth(power)?;
        let of = |spread: Spread| CoefficientUncertainty {
            u: form(own, &spread.covariance, own).max(0.0).sqrt(),
            freedom: spread.freedom,
            covariance: spread.of,
        };
        let rows = of(self.of_rows());
        let points = self.of_points().map(of);
        Some(points.filter(|points| points.u > rows.u).unwrap_or(rows))
    }

    /// Widest of the bands with half-widths factor(ν) √(extra + zᵀ C z). C is a covariance with ν degrees of freedom, z the scaled powers of `x`.
    fn widest(&self, x: f64, extra: f64, factor: impl Fn(f64) -> f64) -> Band {
        let (value, powers) = (self.value(x), self.axis.powers(x));
        let band = |spread: Spread| {
            let variance = form(&powers, &spread.covariance, &powers).max(0.0);
            let u = (extra + variance).sqrt();
            let half = factor(spread.freedom) * u;
            Band {
                value,
                low: value - half,
                high: value + half,
                u,
                freedom: spread.freedom,
                covariance: spread.of,
            }
        };
        let rows = band(self.of_rows());
        match self.of_points().map(band) {
            Some(points) if points.high > rows.high => points,
            _ => rows,
        }
    }

    /// Confidence band of the curve at one x: y ± t u(y), with Student's t.
    ///
    /// # Errors
    /// [`CurveUndefined::Probability`] for `p` outside 0..1.
    pub fn confidence(&self, x: f64, p: f64) -> Result<Band, CurveUndefined> {
        let p = probability(p)?;
        Ok(self.widest(x, 0.0, |freedom| {
            student_t::quantile(f64::midpoint(1.0, p), freedom)
        }))
    }

    /// Prediction band for the mean of m = `readings` new readings at one x: y ± t √(s²/m + u²(y)). t is Student's t,
    /// and s the residual standard deviation.
    ///
    /// # Errors
    /// [`CurveUndefined::Probability`] for `p` outside 0..1; [`CurveUndefined::NotPositive`] for no readings.
    pub fn prediction(&self, x: f64, p: f64, readings: u32) -> Result<Band, CurveUndefined> {
        let (p, extra) = (probability(p)?, self.reading_variance(readings)?);
        Ok(self.widest(x, extra, |freedom| {
            student_t::quantile(f64::midpoint(1.0, p), freedom)
        }))
    }

    /// Simultaneous confidence band of the curve at all x: y ± √(q F(q, ν)) u(y) for q coefficients.
    ///
    /// # Errors
    /// [`CurveUndefined::Probability`] for `p` outside 0..1.
    ///
    /// # Reference
    /// Scheffé, The Analysis of Variance (1959), 3.5.
    pub fn simultaneous(&self, x: f64, p: f64) -> Result<Band, CurveUndefined> {
        let p = probability(p)?;
        let q = self.count as f64;
        Ok(self.widest(x, 0.0, |freedom| {
            (q * f_ratio::quantile(p, q, freedom)).sqrt()
        }))
    }

    /// Variance s²/m of the mean of m readings, with the residual standard deviation s.
    pub(super) fn reading_variance(&self, readings: u32) -> Result<f64, CurveUndefined> {
        let readings = super::undefined::positive("the number of readings", f64::from(readings))?;
        Ok(self.residual_deviation().powi(2) / readings)
    }
}
