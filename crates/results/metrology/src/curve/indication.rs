//! Relative errors of indicated forces, similar to those of ISO 7500-1.

use super::limits::{Figure, Standing, Table};
use super::undefined::{CurveUndefined, all_positive, positive, range};
use taceva_core::whole_size;

/// Upper limits in % of the figures in [`IndicationFigures`]. A laboratory's workbook states them. They were not compared with the standard.
const LIMITS: Table = Table {
    standard: "ISO 7500-1",
    figures: &["q", "b", "v", "f_0", "a"],
    rows: &[
        ("0.5", &[0.5, 0.5, 0.75, 0.05, 0.25]),
        ("1", &[1.0, 1.0, 1.5, 0.1, 0.5]),
        ("2", &[2.0, 2.0, 3.0, 0.2, 1.0]),
        ("3", &[3.0, 3.0, 4.5, 0.3, 1.5]),
    ],
};

/// Least number of repeats for the range b.
const LEAST_REPEATS: usize = 3;

/// Indicated force and true force, in the same unit. This type gets no further field.
///
/// ```
/// use taceva_metrology::curve::Indication;
/// assert_eq!(Indication::new(100.0, 98.0).error_percent(), Some(100.0 * 2.0 / 98.0));
/// assert_eq!(Indication::new(f64::NAN, 98.0).error_percent(), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Indication {
    /// Indicated force F_i.
    pub indicated: f64,
    /// True force F.
    pub truth: f64,
}

impl Indication {
    /// Pairs an indicated force with the true force.
    pub const fn new(indicated: f64, truth: f64) -> Indication {
        Indication { indicated, truth }
    }

    /// Relative error q = (F_i − F)/F, %; `None` for a blank (NaN), or for a true force that is not above 0.
    pub fn error_percent(&self) -> Option<f64> {
        let is_there = self.indicated.is_finite() && self.truth > 0.0 && self.truth.is_finite();
        is_there.then(|| 100.0 * (self.indicated - self.truth) / self.truth)
    }

    /// Ratio of true force to indicated force; `None` unless both are above 0 and finite.
    fn ratio(&self) -> Option<f64> {
        self.error_percent()
            .filter(|_| self.indicated > 0.0)
            .map(|_| self.truth / self.indicated)
    }
}

/// Readings at one force level.
///
/// ```
/// use taceva_metrology::curve::{Indication, IndicationLevel};
/// let level = IndicationLevel::new(&[100.0, 98.0, 100.0].map(|truth| Indication::new(100.0, truth)));
/// // The range of all three, not the first less the third.
/// assert!(level.figures(200.0)?.b.is_some_and(|b| (b - 2.0408).abs() < 1e-4));
/// # Ok::<(), taceva_metrology::curve::CurveUndefined>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct IndicationLevel {
    /// Repeats during loading. Blanks are NaN and are skipped.
    pub up: Vec<Indication>,
    /// Reading during unloading, after the last repeat; `None` if not recorded.
    pub down: Option<Indication>,
    /// Readings at zero force.
    pub zeros: Vec<f64>,
    /// Resolution of the indication, in the unit of the force; `None` if unknown.
    pub resolution: Option<f64>,
}

/// Figures of a force level in %, similar to those of ISO 7500-1.
///
/// ```
/// use taceva_metrology::curve::{Indication, IndicationLevel};
/// let two = IndicationLevel::new(&[100.0, 98.0].map(|truth| Indication::new(100.0, truth))).figures(100.0)?;
/// assert_eq!((two.q.len(), two.b), (2, None));
/// # Ok::<(), taceva_metrology::curve::CurveUndefined>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct IndicationFigures {
    /// Relative error q of each repeat.
    pub q: Vec<f64>,
    /// Mean of `q` over all repeats, %.
    pub q_mean: f64,
    /// Standard uncertainty of `q_mean`: standard deviation of `q` divided by √n for n repeats; `None` for one repeat.
    pub q_mean_u: Option<f64>,
    /// Range of the relative error: greatest `q` minus least `q`, %; `None` for fewer than three repeats.
    pub b: Option<f64>,
    /// Reversibility, %: true force of the last repeat minus that during unloading, relative to the mean of the repeats.
    ///
    /// The true forces are scaled to one indicated force. `None` without an unloading reading.
    pub v: Option<f64>,
    /// Zero error f_0, the greatest |reading at zero force| divided by the full scale, %; `None` without readings at zero force.
    pub f_0: Option<f64>,
    /// Relative resolution a = resolution / mean true force, %; `None` for an unknown resolution.
    pub a: Option<f64>,
}

impl IndicationLevel {
    /// Force level with these repeats and no other readings.
    pub fn new(up: &[Indication]) -> IndicationLevel {
        IndicationLevel {
            up: up.to_vec(),
            ..IndicationLevel::default()
        }
    }

    /// Computes the figures. `full_scale` is in the unit of the force.
    ///
    /// # Errors
    /// [`CurveUndefined::MissingSeries`] without a repeat, [`CurveUndefined::NotPositive`] for a full scale or resolution that is not above 0.
    ///
    /// # Reference
    /// Definitions like those of ISO 7500-1:2018, 6.5.
    pub fn figures(&self, full_scale: f64) -> Result<IndicationFigures, CurveUndefined> {
        let full_scale = positive("full scale", full_scale)?;
        all_positive("resolution", &self.resolution)?;
        let up = self.up.iter();
        let q: Vec<f64> = up.clone().filter_map(Indication::error_percent).collect();
        if q.is_empty() {
            return Err(CurveUndefined::MissingSeries("of upward repeats"));
        }
        let n = q.len() as f64;
        let q_mean = q.iter().sum::<f64>() / n;
        let squares: f64 = q.iter().map(|of| (of - q_mean).powi(2)).sum();
        let ratios: Vec<f64> = up.clone().filter_map(Indication::ratio).collect();
        let mean_ratio = ratios.iter().sum::<f64>() / ratios.len().max(1) as f64;
        let reversed = ratios.last().zip(self.down.and_then(|down| down.ratio()));
        let zeros = self.zeros.iter().filter(|zero| zero.is_finite());
        let greatest = zeros.map(|zero| zero.abs()).reduce(f64::max);
        let valid = up.filter(|of| of.error_percent().is_some());
        let mean_truth = valid.map(|of| of.truth).sum::<f64>() / n;
        Ok(IndicationFigures {
            q_mean,
            q_mean_u: (q.len() > 1).then(|| (squares / (n * (n - 1.0))).sqrt()),
            b: (q.len() >= LEAST_REPEATS).then(|| range(&q)),
            v: reversed.map(|(up, down)| 100.0 * (up - down) / mean_ratio),
            f_0: greatest.map(|greatest| 100.0 * greatest / full_scale),
            a: self.resolution.map(|of| 100.0 * of / mean_truth),
            q,
        })
    }
}

impl IndicationFigures {
    /// Standing of `q_mean` and the other figures among limits similar to those of ISO 7500-1.
    pub fn standing(&self) -> Standing {
        let figures: [Figure; 5] = [
            Ok(self.q_mean.abs()),
            self.b.ok_or("three repeats"),
            self.v.map(f64::abs).ok_or("a downward series"),
            self.f_0.ok_or("zero readings"),
            self.a.ok_or("the resolution"),
        ];
        LIMITS.standing(&figures, |_| true)
    }
}

/// Magnitude of the relative error q over a set of presses.
///
/// ```
/// use taceva_metrology::curve::{Indication, IndicationSummary};
/// let presses = [1.0, 2.0, 4.0, 8.0].map(|percent| Indication::new(100.0 + percent, 100.0));
/// let of = IndicationSummary::of(&presses)?;
/// assert_eq!((of.n, of.share_within_3), (4, 0.5));
/// assert!((of.median_abs - 3.0).abs() < 1e-12);
/// # Ok::<(), taceva_metrology::curve::CurveUndefined>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct IndicationSummary {
    /// Number of presses with a defined relative error.
    pub n: usize,
    /// Median magnitude of the relative error over the presses, %.
    pub median_abs: f64,
    /// 95th percentile over the presses of the relative error's magnitude, %, interpolated between neighbours.
    pub p95_abs: f64,
    /// Share of presses with a relative error of at most 3 % in magnitude, the loosest limit of [`IndicationFigures::q`].
    pub share_within_3: f64,
}

impl IndicationSummary {
    /// Summarises presses with a defined relative error, and skips other presses.
    ///
    /// # Errors
    /// [`CurveUndefined::TooFewRows`] if no press has a defined relative error.
    pub fn of(presses: &[Indication]) -> Result<IndicationSummary, CurveUndefined> {
        let mut sizes: Vec<f64> = presses
            .iter()
            .filter_map(Indication::error_percent)
            .map(f64::abs)
            .collect();
        if sizes.is_empty() {
            return Err(CurveUndefined::TooFewRows { have: 0, least: 1 });
        }
        sizes.sort_unstable_by(f64::total_cmp);
        let n = sizes.len();
        let percentile = |share: f64| {
            let at = share * (n - 1) as f64;
            let below = whole_size(at.floor());
            let next = sizes[(below + 1).min(n - 1)];
            sizes[below] + (at - below as f64) * (next - sizes[below])
        };
        Ok(IndicationSummary {
            n,
            median_abs: percentile(0.5),
            p95_abs: percentile(0.95),
            share_within_3: sizes.iter().filter(|size| **size <= 3.0).count() as f64 / n as f64,
        })
    }
}
