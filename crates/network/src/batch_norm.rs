//! Batch normalisation: batch moments, normalised output and gradients.

mod apply;
mod backward;
mod sums;

pub(crate) use apply::{Shortcut, apply, relu};
pub(crate) use backward::{Gate, GradientSums, gradient_sums, input_gradient};
pub(crate) use sums::ChannelSums;

use crate::panel::Aligned;
use taceva_core::single;

/// Epsilon added to a variance before its square root, as in PyTorch.
pub(crate) const EPSILON: f64 = 1e-5;

/// Weight of the newest batch in the running moments, as in PyTorch.
pub(crate) const MOMENTUM: f64 = 0.1;

/// Gain, bias and running moments of each channel.
#[derive(Clone, Debug)]
pub(crate) struct BatchNorm {
    pub(crate) gain: Aligned,
    pub(crate) bias: Aligned,
    pub(crate) running_mean: Aligned,
    pub(crate) running_variance: Aligned,
}

/// Moments of one batch, and the factor and addend of each channel for normalisation by these moments.
#[derive(Clone, Debug)]
pub(crate) struct Moments {
    pub(crate) mean: Aligned,
    /// Reciprocal standard deviation of each channel: 1 / √(variance + ε).
    pub(crate) inverse: Aligned,
    /// Factor of each channel: gain · inverse.
    pub(crate) scale: Aligned,
    /// Addend of each channel: bias − mean · scale.
    pub(crate) shift: Aligned,
}

impl Moments {
    /// Zeroed moments of `channels` channels.
    pub(crate) fn zeros(channels: usize) -> Moments {
        let zeros = Aligned::zeros(channels);
        Moments {
            mean: zeros.clone(),
            inverse: zeros.clone(),
            scale: zeros.clone(),
            shift: zeros,
        }
    }
}

impl BatchNorm {
    /// Normalisation with gains 1, biases 0, running means 0 and running variances 1.
    pub(crate) fn new(channels: usize) -> BatchNorm {
        let ones = Aligned::of(&vec![1.0; channels]);
        BatchNorm {
            gain: ones.clone(),
            bias: Aligned::zeros(channels),
            running_mean: Aligned::zeros(channels),
            running_variance: ones,
        }
    }

    /// Writes the moments of a batch to `into`, computed from sums over `samples` values per channel. Updates the running moments.
    pub(crate) fn update(&mut self, sums: &[ChannelSums], samples: usize, into: &mut Moments) {
        let samples = samples as f64;
        for channel in 0..self.gain.len() {
            let (mut sum, mut squares) = (0.0, 0.0);
            for image in sums {
                sum += image.sum(channel);
                squares += image.squares(channel);
            }
            let mean = sum / samples;
            let variance = (squares / samples - mean * mean).max(0.0);
            let unbiased = variance * samples / (samples - 1.0);
            let inverse = 1.0 / (variance + EPSILON).sqrt();
            let scale = f64::from(self.gain[channel]) * inverse;
            into.mean[channel] = single(mean);
            into.inverse[channel] = single(inverse);
            into.scale[channel] = single(scale);
            into.shift[channel] = single(f64::from(self.bias[channel]) - mean * scale);
            let follow = |running: &mut f32, newest: f64| {
                *running = single(f64::from(*running) * (1.0 - MOMENTUM) + MOMENTUM * newest);
            };
            follow(&mut self.running_mean[channel], mean);
            follow(&mut self.running_variance[channel], unbiased);
        }
    }

    /// Factor and addend of `channel` for normalisation by the running moments.
    pub(crate) fn frozen(&self, channel: usize) -> (f64, f64) {
        let variance = f64::from(self.running_variance[channel]);
        let scale = f64::from(self.gain[channel]) / (variance + EPSILON).sqrt();
        let shift = f64::from(self.bias[channel]) - f64::from(self.running_mean[channel]) * scale;
        (scale, shift)
    }
}
