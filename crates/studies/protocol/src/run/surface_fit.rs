//! Fit of the height of the gel to readings of force before and after the first contact.
//!
//! Let z₀ be the height of the gel and z the height of the tip, both positive into the gel. Above the gel, the force is a constant b. In the gel, the
//! force is b + c·(z − z₀)^p. Neither b, the stiffness c, the exponent p nor the noise is known. The fit weighs every z₀ and p by the residuals of
//! the best b and c. The weight is the posterior under a flat prior of b, c and the logarithm of the noise. Only sums, products and roots are
//! computed, so that every machine finds the same bits.

use super::depth_zero::ZeroUnknown;

/// Normal force at one height of the tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct DepthForce {
    /// Height in the sensor's frame, positive into the gel, in mm.
    pub(super) z_mm: f64,
    /// Normal force, in N.
    pub(super) force_n: f64,
}

/// Fitted height of the gel in the sensor frame, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Surface {
    pub(super) height_mm: f64,
    /// Standard uncertainty of the height, in mm.
    pub(super) deviation_mm: f64,
}

/// Least number of readings: one more than the parameters of the fit, including the noise.
pub(super) const LEAST_READINGS: usize = 6;
/// Number of parameters that are fitted at each height and exponent: force above the gel, stiffness and noise.
const PARAMETERS: usize = 3;
/// Exponents of the force over depth, in quarters, with their prior weights. 4/4 fits a flat tip and a skin, 6/4 a sphere, 8/4 an edge.
const EXPONENTS: [(u32, f64); 5] = [(4, 2.0), (5, 2.0), (6, 2.0), (7, 0.5), (8, 0.25)];
/// Number of heights whose residuals are weighed in each pass.
const HEIGHTS: u32 = 64;
/// Number of passes. The second pass covers the heights that the first finds probable.
const PASSES: u32 = 2;
/// Half the range of heights in the second pass, in standard deviations of the height from the first pass.
const SPREAD: f64 = 5.0;
/// Minimum standard deviation of a reading, in N. No transducer at rest has less noise.
const QUIET_N: f64 = 1e-4;
/// Greatest weight of a fit without a gel, relative to the best fit, at which a contact is still detected.
const UNSEEN: f64 = 0.01;
/// Greatest weight of the highest height, relative to the greatest weight, at which the gel certainly begins within the range.
const CUT_OFF: f64 = 0.1;
/// Standard uncertainty due to the unknown force law, as a share of the depth of the first contact below the fitted height.
const LAW_PART: f64 = 0.05;
/// Tolerance for the upper end of the window of readings, in mm.
const ROUNDING_MM: f64 = 1e-9;

/// Fits the height of the gel whose first contact was at `contact_mm`, to the `readings` from `window_mm` above the contact on.
pub(super) fn surface(
    readings: &[DepthForce],
    contact_mm: f64,
    window_mm: f64,
) -> Result<Surface, ZeroUnknown> {
    let from_mm = contact_mm - window_mm - ROUNDING_MM;
    let near = readings.iter().filter(|reading| reading.z_mm >= from_mm);
    let near: Vec<DepthForce> = near.copied().collect();
    if near.len() < LEAST_READINGS {
        let readings = near.len();
        return Err(ZeroUnknown::FewReadings { readings });
    }
    let readings = Centred::new(&near);
    let heights = near.iter().map(|reading| reading.z_mm);
    let highest_mm = heights.fold(contact_mm, f64::min);
    let mut range = Range {
        from_mm: highest_mm,
        to_mm: contact_mm,
    };
    let mut found = readings.weigh(&range);
    if readings.part_of(found.least, readings.squares) > UNSEEN {
        return Err(ZeroUnknown::NoRise);
    }
    if found.at_upper_end > CUT_OFF {
        return Err(ZeroUnknown::NoneWithoutContact);
    }
    for _ in 1..PASSES {
        range = range.around(&found.surface);
        found = readings.weigh(&range);
    }
    let Surface {
        height_mm,
        deviation_mm,
    } = found.surface;
    let of_law_mm = LAW_PART * (contact_mm - height_mm);
    Ok(Surface {
        height_mm,
        deviation_mm: (deviation_mm * deviation_mm + of_law_mm * of_law_mm).sqrt(),
    })
}

/// Range of heights at which the gel may begin.
#[derive(Clone, Copy, Debug)]
struct Range {
    from_mm: f64,
    to_mm: f64,
}

impl Range {
    fn step_mm(&self) -> f64 {
        (self.to_mm - self.from_mm) / f64::from(HEIGHTS)
    }

    /// Middle heights of [`HEIGHTS`] equal parts of the range, from the highest on, in mm.
    fn heights_mm(&self) -> impl Iterator<Item = f64> {
        (0..HEIGHTS).map(move |part| self.from_mm + self.step_mm() * (f64::from(part) + 0.5))
    }

    /// Part of the range near `surface`, which the second pass covers.
    fn around(&self, surface: &Surface) -> Range {
        let half_mm = SPREAD * surface.deviation_mm + self.step_mm();
        Range {
            from_mm: self.from_mm.max(surface.height_mm - half_mm),
            to_mm: self.to_mm.min(surface.height_mm + half_mm),
        }
    }
}

/// Force readings of one fit, with the sums that are the same for every height.
struct Centred<'a> {
    readings: &'a [DepthForce],
    count: f64,
    mean_n: f64,
    /// Sum of the squared differences of the forces from their mean, plus that of the least noise, in N².
    squares: f64,
}

/// Result of weighing every height of a range.
struct Weighed {
    surface: Surface,
    /// Least sum of squared residuals over all heights and exponents, in N².
    least: f64,
    /// Weight of the highest height, relative to the greatest weight of all heights.
    at_upper_end: f64,
}

impl<'a> Centred<'a> {
    fn new(readings: &'a [DepthForce]) -> Centred<'a> {
        let (mut count, mut sum_n) = (0.0, 0.0);
        for reading in readings {
            count += 1.0;
            sum_n += reading.force_n;
        }
        let mean_n = sum_n / count;
        let squares = readings.iter().map(|reading| {
            let off_n = reading.force_n - mean_n;
            off_n * off_n
        });
        Centred {
            readings,
            count,
            mean_n,
            squares: squares.sum::<f64>() + count * QUIET_N * QUIET_N,
        }
    }

    /// Weighs each height of `range` by its residuals under each exponent.
    fn weigh(&self, range: &Range) -> Weighed {
        let residuals: Vec<[f64; EXPONENTS.len()]> = range
            .heights_mm()
            .map(|height_mm| EXPONENTS.map(|(quarters, _)| self.residual(height_mm, quarters)))
            .collect();
        let least = residuals
            .iter()
            .flatten()
            .copied()
            .fold(f64::INFINITY, f64::min);
        let weights: Vec<f64> = residuals
            .iter()
            .map(|of_height| {
                let of_exponents = of_height.iter().zip(EXPONENTS);
                of_exponents
                    .map(|(residual, (_, prior))| prior * self.part_of(least, *residual))
                    .sum::<f64>()
            })
            .collect();
        let total: f64 = weights.iter().sum();
        let mean = |value: &dyn Fn(f64) -> f64| {
            let terms = range.heights_mm().zip(&weights);
            terms
                .map(|(height_mm, weight)| weight * value(height_mm))
                .sum::<f64>()
                / total
        };
        let height_mm = mean(&|height_mm| height_mm);
        let variance = mean(&|at_mm| (at_mm - height_mm) * (at_mm - height_mm));
        let step_mm = range.step_mm();
        let greatest = weights.iter().copied().fold(0.0, f64::max);
        Weighed {
            surface: Surface {
                height_mm,
                deviation_mm: (variance + step_mm * step_mm / 12.0).sqrt(),
            },
            least,
            at_upper_end: weights.first().map_or(0.0, |first| first / greatest),
        }
    }

    /// Least sum of squared residuals of the force law with the gel at `height_mm` and the exponent `quarters` / 4, in N²; not below that of noise.
    fn residual(&self, height_mm: f64, quarters: u32) -> f64 {
        let (mut sum, mut square, mut product) = (0.0, 0.0, 0.0);
        for reading in self.readings {
            let depth_mm = reading.z_mm - height_mm;
            if depth_mm > 0.0 {
                let shape = power(depth_mm, quarters);
                sum += shape;
                square += shape * shape;
                product += shape * (reading.force_n - self.mean_n);
            }
        }
        let spread = square - sum * sum / self.count;
        match spread > 0.0 && product > 0.0 {
            true => (self.squares - product * product / spread).max(self.count * QUIET_N * QUIET_N),
            false => self.squares,
        }
    }

    /// Weight of the sum of squared residuals `residual`, relative to that of the least sum `least`.
    fn part_of(&self, least: f64, residual: f64) -> f64 {
        let mut base = (least / residual).sqrt();
        let mut exponent = self.readings.len().saturating_sub(PARAMETERS);
        let mut part = 1.0;
        while exponent > 0 {
            if exponent % 2 == 1 {
                part *= base;
            }
            base *= base;
            exponent /= 2;
        }
        part
    }
}

/// `depth` to the power of `quarters` / 4, for 4 to 8 quarters.
fn power(depth: f64, quarters: u32) -> f64 {
    let root = depth.sqrt();
    match quarters {
        4 => depth,
        5 => depth * root.sqrt(),
        6 => depth * root,
        7 => depth * root * root.sqrt(),
        _ => depth * depth,
    }
}

#[cfg(test)]
mod tests;
