//! Distance of a sample from the training part in feature space. It detects samples that are unlike those of the training part.

use taceva_core::{FeatureShape, Features, ModelError, Progress, single, whole_size};

use super::pca::Pca;
use crate::linalg::invalid;

/// Maximum number of training samples from which the distance is fitted. They are evenly spaced over the training part.
const SAMPLES_MOST: usize = 256;
/// Minimum number of training samples. Fewer samples do not give a useful limit of the distance.
const SAMPLES_LEAST: usize = 20;
/// Number of blocks of consecutive samples. Without groups, whole blocks are held out to find the limits.
const BLOCKS: usize = 8;
/// Maximum number of principal components of the training samples.
const DIRECTIONS_MOST: usize = 16;
/// Minimum number of training samples per principal component.
const SAMPLES_PER_DIRECTION: usize = 4;
/// Maximum number of cells along a side. Blocks of cells are averaged if a sample has more.
const SIDE_MOST: usize = 32;
/// Share of held-out training samples whose distance does not exceed the limit.
const WITHIN: f64 = 0.99;
/// Minimum limit of the residual, relative to the spread of the features. Without it, rounding errors would count as novelty.
const ROUNDING: f64 = 1e-5;

/// Distance of a sample's features from the training part, relative to a limit. 99 of 100 held-out training samples are within the limit.
///
/// The training part is described by its leading principal components. A sample has two distances. The first is along the components, in standard
/// deviations of the training part (Hotelling's T). The second is the root mean square of the residual, which is orthogonal to the components (Q
/// statistic). Each distance is divided by its limit, and the greater quotient is reported. Limits are quantiles over samples that were held out by
/// contact point or block.
///
/// ```
/// use taceva_core::{FeatureShape, Features, SilentProgress};
/// use taceva_models::FeatureDistance;
///
/// // Two features that rise together, and a constant one.
/// let rows = (0..60).flat_map(|row| { let at = (row % 10) as f32; [at, 2.0 * at, 5.0] });
/// let training = Features::new(FeatureShape::flat(3), rows.collect())?;
/// let distance = FeatureDistance::fit(&training, None, &SilentProgress)?.expect("enough samples");
/// assert!(!FeatureDistance::is_outside(distance.of(&[4.5, 9.0, 5.0])?));
/// assert!(FeatureDistance::is_outside(distance.of(&[40.0, 80.0, 5.0])?), "too far along");
/// assert!(FeatureDistance::is_outside(distance.of(&[4.5, 9.0, 6.0])?), "beside");
/// # Ok::<(), taceva_core::ModelError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct FeatureDistance {
    /// Shape of a sample, before its cells are averaged.
    pub(crate) shape: FeatureShape,
    /// Mean of each feature after averaging of cells.
    pub(crate) mean: Vec<f64>,
    /// Orthonormal principal components of the training part, one after the other. Single precision halves the size of the file.
    pub(crate) directions: Vec<f32>,
    /// Standard deviation of the training samples along each principal component.
    pub(crate) deviations: Vec<f64>,
    /// Limits of both distances of a sample.
    pub(crate) limits: DistanceLimits,
}

/// Limits of the two distances of a sample: along the principal components, and orthogonal to them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct DistanceLimits {
    /// Limit along the principal components, in standard deviations of the training part.
    pub(crate) along: f64,
    /// Limit orthogonal to the principal components, in units of the features.
    pub(crate) beside: f64,
}

impl FeatureDistance {
    /// Fits the distance to the training samples `training`. `None` for fewer than 20 samples, or if all samples are equal.
    ///
    /// `groups` contains the group number of each sample. All samples of a group are held out together. Without groups, blocks of consecutive samples
    /// are held out.
    ///
    /// # Errors
    /// [`ModelError`] if a feature is not finite, the number of `groups` is wrong, or `progress` was cancelled.
    pub fn fit(
        training: &Features,
        groups: Option<&[u32]>,
        progress: &dyn Progress,
    ) -> Result<Option<FeatureDistance>, ModelError> {
        let samples = training.samples();
        if let Some(groups) = groups.filter(|groups| groups.len() != samples) {
            return Err(invalid(format!(
                "{} groups for {samples} samples, expected a group for each sample",
                groups.len()
            )));
        }
        if samples < SAMPLES_LEAST || training.shape().is_empty() {
            return Ok(None);
        }
        let count = samples.min(SAMPLES_MOST);
        let chosen: Vec<usize> = (0..count).map(|place| place * samples / count).collect();
        let seen = averaged(training.shape(), &training.select(&chosen))?;
        let halves = halves(&chosen, groups);
        let mut apart = Vec::with_capacity(count);
        for [learnt, held] in [[0, 1], [1, 0]] {
            let Some(half) = Span::of(&seen.select(&halves[learnt]), progress)? else {
                return Ok(None);
            };
            let held = halves[held].iter();
            apart.extend(held.map(|&sample| half.apart(seen.sample(sample))));
        }
        let Some(whole) = Span::of(&seen, progress)? else {
            return Ok(None);
        };
        let limits = DistanceLimits::of(&apart, whole.spread);
        Ok(Some(FeatureDistance {
            shape: training.shape(),
            mean: whole.mean,
            directions: whole.directions,
            deviations: whole.deviations,
            limits,
        }))
    }

    /// Distance of one sample: 0 at the mean of the training part, 1 at the limit.
    ///
    /// # Errors
    /// [`ModelError`] if the number of features is wrong.
    pub fn of(&self, sample: &[f32]) -> Result<f64, ModelError> {
        if sample.len() != self.shape.len() {
            return Err(invalid(format!(
                "a sample of {} features, expected {}",
                sample.len(),
                self.shape.len()
            )));
        }
        let mut cells = Vec::with_capacity(self.mean.len());
        average(self.shape, sample, &mut cells);
        let apart = apart(&self.mean, &self.directions, &self.deviations, &cells);
        Ok(self.limits.distance(apart))
    }

    /// Distance of every sample of `features`.
    ///
    /// # Errors
    /// Errors of [`of`](FeatureDistance::of).
    pub fn of_all(&self, features: &Features) -> Result<Vec<f64>, ModelError> {
        let samples = 0..features.samples();
        samples
            .map(|sample| self.of(features.sample(sample)))
            .collect()
    }

    /// Shape of the samples that the distance accepts.
    pub fn shape(&self) -> FeatureShape {
        self.shape
    }

    /// True if `distance` is above 1 or NaN. The sample is then unlike the training part.
    pub fn is_outside(distance: f64) -> bool {
        distance.is_nan() || distance > 1.0
    }

    /// Number of features of a sample of `shape` after averaging of cells. The mean and each principal component have this length.
    pub(crate) fn width_of(shape: FeatureShape) -> usize {
        let [rows, columns] = steps(shape);
        shape.height.div_ceil(rows) * shape.width.div_ceil(columns) * shape.depth
    }
}

/// Distances of a sample from a set of samples: along its principal components, and orthogonal to them.
#[derive(Clone, Copy, Debug)]
struct Apart {
    along: f64,
    beside: f64,
}

impl DistanceLimits {
    /// Limits that 99 of 100 of the distances `apart` do not exceed. `spread` is the root mean square of the centred features.
    fn of(apart: &[Apart], spread: f64) -> DistanceLimits {
        let along = apart.iter().map(|apart| apart.along);
        let beside = apart.iter().map(|apart| apart.beside);
        let limits = DistanceLimits {
            along: quantile(along.collect()).max(1.0),
            beside: quantile(beside.collect()).max(ROUNDING * spread),
        };
        // Samples exceed at least one of two limits more often than a single limit.
        let both = apart.iter().map(|apart| limits.distance(*apart));
        let both = quantile(both.collect()).max(1.0);
        DistanceLimits {
            along: limits.along * both,
            beside: limits.beside * both,
        }
    }

    fn distance(&self, apart: Apart) -> f64 {
        let [along, beside] = [apart.along / self.along, apart.beside / self.beside];
        // `max` would ignore NaN.
        match along.is_nan() || beside.is_nan() {
            true => f64::NAN,
            false => along.max(beside),
        }
    }
}

/// Mean, principal components and spread of a set of samples.
struct Span {
    mean: Vec<f64>,
    directions: Vec<f32>,
    deviations: Vec<f64>,
    /// Root mean square of the features minus their means, over samples and features.
    spread: f64,
}

impl Span {
    /// Computes the principal components of the samples `seen`; `None` if no feature varies.
    fn of(seen: &Features, progress: &dyn Progress) -> Result<Option<Span>, ModelError> {
        let most = (seen.samples() / SAMPLES_PER_DIRECTION).clamp(1, DIRECTIONS_MOST);
        let pca = Pca::up_to(most, seen, progress)?;
        if pca.variance_ratio().is_empty() {
            return Ok(None);
        }
        let mut span = Span {
            mean: pca.mean().to_vec(),
            directions: pca.components().flatten().copied().map(single).collect(),
            deviations: vec![1.0; pca.variance_ratio().len()],
            spread: 0.0,
        };
        let width = span.mean.len();
        let count = seen.samples() as f64;
        let mut squares = vec![0.0; span.deviations.len()];
        for sample in 0..seen.samples() {
            let mut centred = centred(&span.mean, seen.sample(sample));
            let square: f64 = centred.iter().map(|value| value * value).sum();
            span.spread += square / (count * width as f64);
            for (square, direction) in squares.iter_mut().zip(span.directions.chunks_exact(width)) {
                *square += take_along(&mut centred, direction).powi(2) / count;
            }
        }
        span.spread = span.spread.sqrt();
        span.deviations = squares.into_iter().map(f64::sqrt).collect();
        Ok(Some(span))
    }

    fn apart(&self, cells: &[f32]) -> Apart {
        apart(&self.mean, &self.directions, &self.deviations, cells)
    }
}

fn apart(mean: &[f64], directions: &[f32], deviations: &[f64], cells: &[f32]) -> Apart {
    let mut centred = centred(mean, cells);
    let width = mean.len();
    let mut along = 0.0;
    for (direction, deviation) in directions.chunks_exact(width).zip(deviations) {
        along += (take_along(&mut centred, direction) / deviation).powi(2);
    }
    let beside: f64 = centred.iter().map(|value| value * value).sum();
    Apart {
        along: (along / deviations.len() as f64).sqrt(),
        beside: (beside / width as f64).sqrt(),
    }
}

fn centred(mean: &[f64], cells: &[f32]) -> Vec<f64> {
    let pairs = cells.iter().zip(mean);
    pairs.map(|(cell, mean)| f64::from(*cell) - mean).collect()
}

/// Subtracts the component of `centred` along `direction`, and returns this component.
fn take_along(centred: &mut [f64], direction: &[f32]) -> f64 {
    let pairs = centred.iter().zip(direction);
    let along: f64 = pairs.map(|(value, of)| value * f64::from(*of)).sum();
    let pairs = centred.iter_mut().zip(direction);
    pairs.for_each(|(value, of)| *value -= along * f64::from(*of));
    along
}

/// Splits samples into two halves: those of even and of odd group numbers. Without groups, or if a half is too small, blocks of consecutive samples
/// alternate.
fn halves(chosen: &[usize], groups: Option<&[u32]>) -> [Vec<usize>; 2] {
    let second = |is_second: &dyn Fn(usize) -> bool| -> [Vec<usize>; 2] {
        let (second, first) = (0..chosen.len()).partition(|&place| is_second(place));
        [first, second]
    };
    let least = chosen.len() / 4;
    let by_group = groups.map(|groups| second(&|place| groups[chosen[place]] % 2 == 1));
    by_group
        .filter(|halves| halves.iter().all(|half| half.len() >= least))
        .unwrap_or_else(|| second(&|place| place * BLOCKS / chosen.len() % 2 == 1))
}

/// Smallest of `values` that at least 99 % of the values do not exceed.
fn quantile(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    let rank = whole_size((values.len() as f64 * WITHIN).ceil());
    values[rank.clamp(1, values.len()) - 1]
}

/// Height and width of the blocks of cells that are averaged, in cells. Flat lists are not averaged, because adjacent values are not neighbours.
fn steps(shape: FeatureShape) -> [usize; 2] {
    match shape.height {
        1 => [1, 1],
        _ => [shape.height, shape.width].map(|side| side.div_ceil(SIDE_MOST).max(1)),
    }
}

/// Averages blocks of cells in every sample. The results are flat lists, one per sample.
fn averaged(shape: FeatureShape, features: &Features) -> Result<Features, ModelError> {
    let width = FeatureDistance::width_of(shape);
    let mut values = Vec::with_capacity(width * features.samples());
    for sample in 0..features.samples() {
        average(shape, features.sample(sample), &mut values);
    }
    Features::new(FeatureShape::flat(width), values)
}

/// Averages blocks of cells in one sample, and appends the means to `into`. Flat lists and small pictures are appended unchanged.
fn average(shape: FeatureShape, sample: &[f32], into: &mut Vec<f32>) {
    let FeatureShape {
        height,
        width,
        depth,
    } = shape;
    let [rows, columns] = steps(shape);
    if rows == 1 && columns == 1 {
        into.extend_from_slice(sample);
        return;
    }
    for top in (0..height).step_by(rows) {
        let bottom = (top + rows).min(height);
        for left in (0..width).step_by(columns) {
            let right = (left + columns).min(width);
            let count = ((bottom - top) * (right - left)) as f64;
            for channel in 0..depth {
                let cells = (top..bottom).flat_map(|y| (left..right).map(move |x| y * width + x));
                let sum: f64 = cells
                    .map(|at| f64::from(sample[at * depth + channel]))
                    .sum();
                into.push(single(sum / count));
            }
        }
    }
}
