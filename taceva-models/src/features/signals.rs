//! Values of taxels as features, unchanged or minus their mean without contact.

use taceva_core::{FeatureShape, Features, SignalInfo, Signals, single};

use super::error::FeatureError;
use super::spec::FeatureSpec;

/// Features that are the values of a grid of taxels.
#[derive(Clone, Debug)]
pub(super) struct Taxels {
    info: SignalInfo,
    /// Mean signals without contact; `None` if they are not subtracted.
    rest: Option<Signals>,
}

impl Taxels {
    pub(super) fn new(
        spec: &FeatureSpec,
        info: SignalInfo,
        rest: Option<&Signals>,
    ) -> Result<Taxels, FeatureError> {
        if spec.of_signals(info) != *spec {
            return Err(FeatureError::OtherGrid { info, spec: *spec });
        }
        let rest = match (spec.difference, rest) {
            (false, _) => None,
            (true, None) => return Err(FeatureError::NoRest),
            (true, Some(rest)) if rest.info() != info => {
                return Err(FeatureError::Input {
                    expected: info.into(),
                    found: rest.info().into(),
                });
            }
            (true, Some(rest)) => Some(rest.clone()),
        };
        Ok(Taxels { info, rest })
    }

    pub(super) fn info(&self) -> SignalInfo {
        self.info
    }

    /// Writes the values of `signals`, minus the mean signals without contact if they are subtracted. The caller must check the grid.
    pub(super) fn write(&self, signals: &Signals, into: &mut [f32]) {
        into.copy_from_slice(signals.values());
        if let Some(rest) = &self.rest {
            let places = into.iter_mut().zip(rest.values());
            places.for_each(|(place, rest)| *place -= rest);
        }
    }
}

/// Spread of each channel over the samples of `training`, rounded to a power of two. Values divided by the spread are near 1, and the division is
/// exact. A model that scales features itself is therefore unaffected.
///
/// A channel's spread is the root mean square of the standard deviations at each taxel, or 1 if no value varies.
///
/// # Shapes
/// `[depth]` of the features.
pub(crate) fn spread(training: &Features) -> Vec<f64> {
    let FeatureShape {
        height,
        width,
        depth,
    } = training.shape();
    let length = height * width * depth;
    let count = training.samples().max(1) as f64;
    let mut means = vec![0.0_f64; length];
    for sample in training.values().chunks_exact(length.max(1)) {
        let places = means.iter_mut().zip(sample);
        places.for_each(|(mean, value)| *mean += f64::from(*value) / count);
    }
    let mut variances = vec![0.0_f64; depth];
    for sample in training.values().chunks_exact(length.max(1)) {
        for (position, (value, mean)) in sample.iter().zip(&means).enumerate() {
            variances[position % depth] += (f64::from(*value) - mean).powi(2);
        }
    }
    let places = (height * width).max(1) as f64;
    let spreads = variances.iter().map(|sum| (sum / count / places).sqrt());
    spreads.map(power_of_two).collect()
}

/// Power of two nearest to `spread`, limited to the range of single precision. 1 for a spread of 0.
fn power_of_two(spread: f64) -> f64 {
    match spread > 0.0 {
        true => spread.log2().round().clamp(-100.0, 100.0).exp2(),
        false => 1.0,
    }
}

/// Divides each value of `features` by the spread of its channel.
pub(crate) fn divided(features: &Features, spread: &[f64]) -> Features {
    let factors = spread.iter().cycle().map(|spread| 1.0 / spread);
    let values = features.values().iter().zip(factors);
    let values = values.map(|(value, factor)| single(f64::from(*value) * factor));
    Features::new(features.shape(), values.collect()).expect("as many values as there were")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn channels_are_divided_by_their_own_spread_and_lose_no_bit() {
        // Two places of two channels: the first channel spreads by 3 at both places, with an offset; the second is constant.
        let shape = FeatureShape {
            height: 1,
            width: 2,
            depth: 2,
        };
        let values = vec![97.0, 5.0, -3.0, 5.0, 103.0, 5.0, 3.0, 5.0];
        let features = Features::new(shape, values).expect("two samples");
        assert_eq!(spread(&features), [4.0, 1.0]);
        let divided = divided(&features, &spread(&features));
        assert_eq!(divided.sample(0), [24.25, 5.0, -0.75, 5.0]);
    }
}
