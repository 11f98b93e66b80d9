//! Relative errors of a force-proving instrument, similar to those of ISO 376.

use super::fit::{CurveFit, CurveRow};
use super::limits::{Figure, Standing, Table};
use super::undefined::{CurveUndefined, all_positive, range};

/// Upper limits in % of the figures of [`ProvingLevel`] and [`ProvingFigures`]. They were not compared with the standard.
const LIMITS: Table = Table {
    standard: "ISO 376",
    figures: &["b", "b'", "f_c", "f_0", "v", "c"],
    rows: &[
        ("00", &[0.05, 0.025, 0.025, 0.012, 0.07, 0.025]),
        ("0.5", &[0.10, 0.05, 0.05, 0.025, 0.15, 0.05]),
        ("1", &[0.20, 0.10, 0.10, 0.05, 0.30, 0.10]),
        ("2", &[0.40, 0.20, 0.20, 0.10, 0.50, 0.20]),
    ],
};

/// Least force for each row of limits, in multiples of the resolution.
const LEAST_FORCES: [(&str, f64); 4] =
    [("00", 4000.0), ("0.5", 2000.0), ("1", 1000.0), ("2", 500.0)];

/// Readings by force level: X1 and X2 in one mounting, X3 and X5 in other mountings, X4' and X6' during unloading.
///
/// ```
/// use taceva_metrology::curve::ProvingSeries;
/// let mut series = ProvingSeries::new(&[0.2, 0.4, 0.6, 0.8, 1.0]);
/// series.x1 = vec![0.20012, 0.40025, 0.60031, 0.8004, 1.00052];
/// assert_eq!(series.figures().unwrap_err().to_string(), "series X3 is missing");
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct ProvingSeries {
    /// Forces F, ascending.
    pub forces: Vec<f64>,
    /// First series. A series that was not recorded is empty.
    pub x1: Vec<f64>,
    /// Second series, in the mounting of the first.
    pub x2: Vec<f64>,
    /// Series in the second mounting.
    pub x3: Vec<f64>,
    /// Readings during unloading after `x3`.
    pub x4: Vec<f64>,
    /// Series in the third mounting.
    pub x5: Vec<f64>,
    /// Readings during unloading after `x5`.
    pub x6: Vec<f64>,
    /// Readings at zero force, before and after the series; `None` if not recorded.
    pub zeros: Option<[f64; 2]>,
    /// Readings at the greatest force after 30 s and after 300 s; `None` if not recorded.
    pub creep: Option<[f64; 2]>,
    /// Resolution, in the unit of the force; `None` if unknown.
    pub resolution: Option<f64>,
    /// Full-scale reading X_N, in the unit of the readings. Defaults to the mean reading at the greatest force.
    pub full_scale: Option<f64>,
}

/// Figures of one force level of a [`ProvingSeries`], which defines X1 to X6', in % unless stated otherwise.
///
/// ```
/// # use taceva_metrology::curve::ProvingSeries;
/// # let mut series = ProvingSeries::new(&[1.0, 2.0, 3.0, 4.0]);
/// # (series.x1, series.x3, series.x5) = (vec![1.0, 2.0, 3.0, 4.0], vec![1.01, 2.0, 3.0, 4.0], vec![1.0, 2.0, 3.0, 4.0]);
/// let level = series.figures()?.levels[0];
/// assert!((level.b - 100.0 * 0.01 / level.mean).abs() < 1e-9);
/// # Ok::<(), taceva_metrology::curve::CurveUndefined>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ProvingLevel {
    /// Force of the level, in the unit of the reference force.
    pub force: f64,
    /// X̄_r: mean of X1, X3 and X5, in the unit of the readings.
    pub mean: f64,
    /// b: range of X1, X3 and X5, divided by their mean.
    pub b: f64,
    /// b': |X2 − X1| divided by their mean; `None` without X2.
    pub b_prime: Option<f64>,
    /// f_c: mean of X1, X3 and X5 minus the cubic X_a fitted over all forces, divided by X_a.
    pub f_c: f64,
    /// v: mean of |X4' − X3|/X3 and |X6' − X5|/X5; `None` without unloading.
    pub v: Option<f64>,
    /// Standard uncertainty from rotation, as a ratio: √(Σ(X_i − mean)²/6) divided by the mean, over X1, X3 and X5.
    pub w_rotation: f64,
}

/// Figures of all force levels, similar to those of ISO 376.
///
/// ```
/// # use taceva_metrology::curve::ProvingSeries;
/// # let mut series = ProvingSeries::new(&[1.0, 2.0, 3.0, 4.0]);
/// # (series.x1, series.x3, series.x5) = (vec![1.0, 2.0, 3.0, 4.0], vec![1.1, 2.0, 3.0, 4.0], vec![1.0, 2.0, 3.0, 4.0]);
/// let place = series.figures()?.standing(0).to_string();
/// assert!(place.starts_with("none: b = 9.7 %, class 2 ends at 0.40 %; known figures within class 1 x 50"), "{place}");
/// # Ok::<(), taceva_metrology::curve::CurveUndefined>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ProvingFigures {
    /// Levels, in the order of the forces.
    pub levels: Vec<ProvingLevel>,
    /// f_0: zero reading after minus before the series, divided by the full scale, in %; `None` without readings at zero force.
    pub f_0: Option<f64>,
    /// c: reading after 300 s minus reading after 30 s, divided by the full scale, in %; `None` without creep readings.
    pub c: Option<f64>,
    /// Resolution, in the unit of the force; `None` if unknown.
    pub resolution: Option<f64>,
}

impl ProvingSeries {
    /// Series with these forces and no readings.
    pub fn new(forces: &[f64]) -> ProvingSeries {
        ProvingSeries {
            forces: forces.to_vec(),
            ..ProvingSeries::default()
        }
    }

    /// Computes the figures.
    ///
    /// # Errors
    /// [`CurveUndefined::MissingSeries`] without X1, X3 or X5, [`CurveUndefined::Levels`], and [`CurveUndefined::NotPositive`] for a force, a
    /// reading or a resolution that is not above 0; [`CurveUndefined`] of the cubic of fewer than four levels.
    ///
    /// # Reference
    /// Definitions like those of ISO 376:2011, 7.5. The cubic is fitted with an additional row at 0.
    pub fn figures(&self) -> Result<ProvingFigures, CurveUndefined> {
        let all = [
            ("X1", &self.x1, true),
            ("X3", &self.x3, true),
            ("X5", &self.x5, true),
            ("X2", &self.x2, false),
            ("X4'", &self.x4, false),
            ("X6'", &self.x6, false),
        ];
        all_positive("force", &self.forces)?;
        all_positive("resolution", &self.resolution)?;
        all_positive("full scale", &self.full_scale)?;
        for (series, values, is_needed) in all {
            let expected = self.forces.len();
            match values.len() {
                0 if is_needed => return Err(CurveUndefined::MissingSeries(series)),
                0 => {}
                have if have != expected => {
                    return Err(CurveUndefined::Levels {
                        series,
                        have,
                        expected,
                    });
                }
                _ => all_positive("reading", values)?,
            }
        }
        let mean = |at: usize| (self.x1[at] + self.x3[at] + self.x5[at]) / 3.0;
        let means: Vec<f64> = (0..self.forces.len()).map(mean).collect();
        let mut rows = vec![CurveRow::new(0.0, 0.0)];
        let points = self.forces.iter().zip(&means);
        rows.extend(points.map(|(force, mean)| CurveRow::new(*force, *mean)));
        let cubic = CurveFit::of(&rows, 3)?;
        let levels =
            (0..means.len()).map(|at| self.level(at, means[at], cubic.value(self.forces[at])));
        let points = self.forces.iter().zip(&means);
        let greatest = points.max_by(|one, other| one.0.total_cmp(other.0));
        let full = self.full_scale.or(greatest.map(|of| *of.1)).unwrap_or(1.0);
        let percent = |[before, after]: [f64; 2]| 100.0 * (after - before) / full;
        Ok(ProvingFigures {
            levels: levels.collect(),
            f_0: self.zeros.map(percent),
            c: self.creep.map(percent),
            resolution: self.resolution,
        })
    }

    fn level(&self, at: usize, mean: f64, cubic: f64) -> ProvingLevel {
        let of = |series: &[f64]| series.get(at).copied();
        let three = [self.x1[at], self.x3[at], self.x5[at]];
        let squares: f64 = three.iter().map(|x| (x - mean).powi(2)).sum();
        let reversed = |down: &[f64], up: f64| of(down).map(|down| (down - up).abs() / up);
        let both = reversed(&self.x4, three[1]).zip(reversed(&self.x6, three[2]));
        ProvingLevel {
            force: self.forces[at],
            mean,
            b: 100.0 * range(&three) / mean,
            b_prime: of(&self.x2).map(|x2| 200.0 * (x2 - three[0]).abs() / (x2 + three[0])),
            f_c: 100.0 * (mean - cubic) / cubic,
            v: both.map(|(one, other)| 50.0 * (one + other)),
            w_rotation: (squares / 6.0).sqrt() / mean,
        }
    }
}

impl ProvingFigures {
    /// Standing of a level among limits similar to those of ISO 376.
    ///
    /// # Panics
    /// If there is no level with this index.
    pub fn standing(&self, level: usize) -> Standing {
        let of = &self.levels[level];
        let mut figures: Vec<Figure> = vec![
            Ok(of.b),
            of.b_prime.ok_or("X2"),
            Ok(of.f_c.abs()),
            self.f_0.map(f64::abs).ok_or("zero readings"),
            of.v.ok_or("X4' and X6'"),
            self.c.map(f64::abs).ok_or("creep readings"),
        ];
        // Each row has a least force in resolutions.
        if self.resolution.is_none() {
            figures.push(Err("the resolution"));
        }
        let may_have = |row: &str| {
            let least = LEAST_FORCES.iter().find(|(name, _)| *name == row);
            let pair = least.zip(self.resolution);
            pair.is_none_or(|((_, least), resolution)| of.force >= least * resolution)
        };
        LIMITS.standing(&figures, may_have)
    }

    /// Relative standard uncertainty of a level, as a ratio: root of the sum of the squares of eight terms. Missing figures count as 0.
    ///
    /// The terms are `machine` (half of the reference's U), `w_rotation`, b'/√3, resolution/(force × √6), c/√3, f_0, `temperature` and f_c.
    ///
    /// # Panics
    /// If there is no level with this index.
    ///
    /// # Reference
    /// Terms like those of ISO 376:2011, annex C.
    pub fn relative_uncertainty(&self, level: usize, machine: f64, temperature: f64) -> f64 {
        let of = &self.levels[level];
        let percent = |figure: Option<f64>| figure.unwrap_or_default() / 100.0;
        let terms = [
            machine,
            of.w_rotation,
            percent(of.b_prime) / 3_f64.sqrt(),
            self.resolution.unwrap_or_default() / (of.force * 6_f64.sqrt()),
            percent(self.c) / 3_f64.sqrt(),
            percent(self.f_0),
            temperature,
            of.f_c / 100.0,
        ];
        terms.iter().map(|term| term * term).sum::<f64>().sqrt()
    }
}
