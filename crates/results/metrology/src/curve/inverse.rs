//! Inverse prediction: the reference value for a given reading.

use super::band::CovarianceOf;
use super::fit::CurveFit;
use super::undefined::{CurveUndefined, probability};
use taceva_metrics::distributions::student_t;

/// Reference value for a reading, with Fieller's interval, in the unit of x.
///
/// ```
/// use taceva_metrology::curve::{CurveFit, CurveRow};
/// let rows: Vec<CurveRow> = [(0.0, 1.0), (1.0, 3.1), (2.0, 4.9), (3.0, 7.0)].map(|(x, y)| CurveRow::new(x, y)).into();
/// let found = CurveFit::of(&rows, 1)?.invert(4.0, 0.95, 1)?;
/// assert!(found.low < 1.5 && 1.5 < found.high && found.g < 0.01);
/// # Ok::<(), taceva_metrology::curve::CurveUndefined>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct InversePrediction {
    /// Reference value x at which y(x) equals the reading.
    pub x: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
    /// Half-width without Fieller's correction, as in DIN 32645: Student's t times the standard uncertainty of `x`.
    pub half_width: f64,
    /// Fieller's g = (t u(b)/b)² for Student's t and the slope b with standard uncertainty u(b); 0 for an exact slope.
    pub g: f64,
    /// Source of the covariance with the wider interval.
    pub covariance: CovarianceOf,
}

impl CurveFit {
    /// Reference value at which the curve equals `y`, the mean of `readings` readings, with an interval of coverage `p`.
    ///
    /// # Errors
    /// [`CurveUndefined::SlopeNotShown`] if Fieller's g is 1 or more, [`CurveUndefined::NotALine`] for an order other than 1.
    ///
    /// # Reference
    /// Fieller, Journal of the Royal Statistical Society B 16 (1954); DIN 32645:2008 for the plain half-width.
    pub fn invert(
        &self,
        y: f64,
        p: f64,
        readings: u32,
    ) -> Result<InversePrediction, CurveUndefined> {
        if self.count != 2 {
            return Err(CurveUndefined::NotALine(self.order()));
        }
        let (p, extra) = (probability(p)?, self.reading_variance(readings)?);
        let [a, b, ..] = self.solution.coefficients;
        let mut widest: Option<InversePrediction> = None;
        for spread in [Some(self.of_rows()), self.of_points()]
            .into_iter()
            .flatten()
        {
            let t = student_t::quantile(f64::midpoint(1.0, p), spread.freedom);
            let [[v_aa, v_ab, ..], [_, v_bb, ..], ..] = spread.covariance;
            let g = t * t * v_bb / (b * b);
            // g is not a number for a slope of exactly 0.
            if g.is_nan() || g >= 1.0 {
                return Err(CurveUndefined::SlopeNotShown { g });
            }
            // Ends of z: (y − a − b z)² = t² (s²/m + v_aa + 2 z v_ab + z² v_bb).
            let z = (y - a) / b;
            let shift = t * t * v_ab / (b * b);
            let variance = |z: f64| extra + v_aa + 2.0 * z * v_ab + z * z * v_bb;
            let middle = (z + shift) / (1.0 - g);
            let square = middle * middle - (z * z - t * t * (extra + v_aa) / (b * b)) / (1.0 - g);
            let half = square.max(0.0).sqrt();
            let x = |z: f64| self.axis.centre + self.axis.scale * z;
            let found = InversePrediction {
                x: x(z),
                low: x(middle - half),
                high: x(middle + half),
                half_width: self.axis.scale * t * variance(z).sqrt() / b.abs(),
                g,
                covariance: spread.of,
            };
            let is_wider = |best: &InversePrediction| found.high - found.low > best.high - best.low;
            if widest.as_ref().is_none_or(is_wider) {
                widest = Some(found);
            }
        }
        widest.ok_or(CurveUndefined::EqualX)
    }
}
