//! Distribution shapes of sources, with standard uncertainty and random draws.

use std::f64::consts::TAU;

use taceva_core::random::{Draws, open_unit};

use super::freedom::Freedom;
use taceva_metrics::distributions::normal;

/// Distribution shape of a source. Half-widths are in the unit of the source.
///
/// ```
/// use taceva_metrology::budget::Shape;
/// let light = Shape::Rectangular { half_width: 10.0 };
/// assert!((light.standard_uncertainty() - 5.7735).abs() < 1e-4);
/// ```
///
/// # Reference
/// GUM 4.3, JCGM 101 table 1; the curvilinear trapezoid is a rectangle whose limits are known to ±`limits`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Shape {
    /// Normal distribution. Draws use Student's distribution if the degrees of freedom are finite.
    Normal {
        /// Standard uncertainty.
        u: f64,
    },
    /// Mean of n readings with standard deviation s, u = s/√n. Draws use Student's distribution.
    Student {
        /// Standard uncertainty.
        u: f64,
    },
    /// Rectangular of half-width a, u = a/√3. Draws use a curvilinear trapezoid if the degrees of freedom are finite.
    Rectangular {
        /// Half-width a.
        half_width: f64,
    },
    /// Triangular of half-width a, u = a/√6.
    Triangular {
        /// Half-width a.
        half_width: f64,
    },
    /// Arcsine (U-shaped) of half-width a, u = a/√2.
    Arcsine {
        /// Half-width a.
        half_width: f64,
    },
    /// Symmetric trapezoid of half-width a and ratio β of top to base width, u = a √((1 + β²)/6).
    Trapezoid {
        /// Half-width a.
        half_width: f64,
        /// Ratio of top width to base width, from 0 to 1.
        beta: f64,
    },
    /// Curvilinear trapezoid: rectangle of half-width a with limits known to ±d, u = √(a²/3 + d²/9).
    CurvilinearTrapezoid {
        /// Half-width a.
        half_width: f64,
        /// Greatest error d of either limit.
        limits: f64,
    },
}

impl Shape {
    /// Standard uncertainty, in the unit of the half-width.
    pub fn standard_uncertainty(&self) -> f64 {
        match *self {
            Shape::Normal { u } | Shape::Student { u } => u,
            Shape::Rectangular { half_width } => half_width / 3_f64.sqrt(),
            Shape::Triangular { half_width } => half_width / 6_f64.sqrt(),
            Shape::Arcsine { half_width } => half_width / 2_f64.sqrt(),
            Shape::Trapezoid { half_width, beta } => {
                half_width * ((1.0 + beta * beta) / 6.0).sqrt()
            }
            Shape::CurvilinearTrapezoid { half_width, limits } => {
                (half_width * half_width / 3.0 + limits * limits / 9.0).sqrt()
            }
        }
    }

    /// Name in files and reports.
    pub fn name(&self) -> &'static str {
        match self {
            Shape::Normal { .. } => "normal",
            Shape::Student { .. } => "student",
            Shape::Rectangular { .. } => "rectangular",
            Shape::Triangular { .. } => "triangular",
            Shape::Arcsine { .. } => "arcsine",
            Shape::Trapezoid { .. } => "trapezoid",
            Shape::CurvilinearTrapezoid { .. } => "curvilinear_trapezoid",
        }
    }

    /// True for shapes with normal or Student draws.
    pub(super) fn is_bell(&self) -> bool {
        matches!(self, Shape::Normal { .. } | Shape::Student { .. })
    }

    /// Deviation from the estimate, in draw number `counter`.
    pub(super) fn draw(&self, freedom: Freedom, draws: Draws, counter: u64) -> f64 {
        let unit = |which: u64| draws.unit(2 * counter + which);
        let signed = |which: u64| 2.0 * unit(which) - 1.0;
        match *self {
            Shape::Normal { u } | Shape::Student { u } => u * bell(freedom, draws, counter),
            Shape::Rectangular { half_width } => match freedom {
                Freedom::Finite(number) => {
                    // ν = 1 / (2 q²), d = a q.
                    let limits = half_width * (0.5 / number).sqrt().min(1.0);
                    (half_width + limits * signed(1)) * signed(0)
                }
                _ => half_width * signed(0),
            },
            Shape::Triangular { half_width } => half_width * (unit(0) + unit(1) - 1.0),
            Shape::Arcsine { half_width } => half_width * (TAU * unit(0)).sin(),
            Shape::Trapezoid { half_width, beta } => {
                half_width / 2.0 * ((1.0 + beta) * signed(0) + (1.0 - beta) * signed(1))
            }
            Shape::CurvilinearTrapezoid { half_width, limits } => {
                (half_width + limits * signed(1)) * signed(0)
            }
        }
    }
}

/// Draw from the standard normal distribution, or from Student's distribution if the degrees of freedom are finite.
///
/// # Reference
/// Bailey, Mathematics of Computation 62 (1994): √(ν (U^(−2/ν) − 1)) cos(2πV) has Student's
/// distribution for U and V uniform in 0..1.
fn bell(freedom: Freedom, draws: Draws, counter: u64) -> f64 {
    let first = open_unit(draws.bits(2 * counter));
    match freedom {
        Freedom::Finite(number) => {
            let square = number * (first.powf(-2.0 / number) - 1.0);
            square.max(0.0).sqrt() * (TAU * draws.unit(2 * counter + 1)).cos()
        }
        _ => normal::quantile(first),
    }
}
