//! Random numbers that are functions of purpose, identity and index.
//!
//! The key of a number is the seed, a [`Purpose`], an identity (a press, a point, a frame) and an index. A press is therefore independent
//! of earlier presses, of threads and of interruptions.
//!
//! The mixing is the function in `taceva_core::random`, applied once per coordinate. A normal number is the quantile of one uniform number.

mod normal;

use taceva_core::random::{Draws, mix, open_unit};

/// Purpose of a random number. Different purposes never share a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(u32)]
#[non_exhaustive]
pub enum Purpose {
    /// Stiffness field of a unit's gel.
    Stiffness = 1,
    /// Surface of a unit: gap and blisters.
    Surface,
    /// Position error of the robot.
    Positioning,
    /// Start of the search for contact above the surface.
    SearchPhase,
    /// Noise of the transducer in the search for contact.
    SearchNoise,
    /// Zero of the transducer, by point.
    ZeroDrift,
    /// Zero of the transducer, by press.
    PressDrift,
    /// White noise of logged readings.
    ForceNoise,
    /// Cross-talk of the transducer.
    CrossTalk,
    /// Places and depths of presses.
    Draws,
    /// Flicker of a frame.
    Flicker,
    /// Pixel noise of a frame.
    PixelNoise,
    /// Texture of a unit's picture.
    Texture,
    /// Gains of a unit's lamps.
    LampGain,
    /// Places of a unit's markers.
    MarkerJitter,
    /// Buckling of a lattice under a press.
    Buckling,
    /// Pose of a grating.
    GratingPose,
    /// Marks of wear on a unit's gel.
    Wear,
}

/// All random numbers of one seed.
///
/// ```
/// use taceva_sim::random::{Purpose, Random};
/// let random = Random::new(7);
/// let press = random.stream(Purpose::ForceNoise, 41);
/// assert_eq!(press.normal(0).to_bits(), Random::new(7).stream(Purpose::ForceNoise, 41).normal(0).to_bits());
/// assert_ne!(press.bits(0), press.bits(1));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Random {
    key: u64,
}

impl Random {
    /// Random numbers of `seed`.
    pub fn new(seed: u64) -> Random {
        Random { key: mix(seed) }
    }

    /// Stream for one purpose and one identity.
    pub fn stream(&self, purpose: Purpose, identity: u64) -> Stream {
        let purpose = mix(self.key ^ u64::from(purpose as u32));
        Stream {
            draws: Draws::new(mix(purpose ^ identity)),
        }
    }
}

/// Stream of random numbers of one purpose and one identity, by index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stream {
    draws: Draws,
}

impl Stream {
    /// 64 random bits.
    #[inline]
    pub fn bits(&self, index: u64) -> u64 {
        self.draws.bits(index)
    }

    /// Uniform number strictly between 0 and 1, in steps of 2⁻⁵³.
    #[inline]
    pub fn uniform(&self, index: u64) -> f64 {
        open_unit(self.bits(index))
    }

    /// Uniform number between `low` and `high`.
    #[inline]
    pub fn between(&self, index: u64, low: f64, high: f64) -> f64 {
        low + (high - low) * self.uniform(index)
    }

    /// Normal number of mean 0 and standard deviation 1.
    #[inline]
    pub fn normal(&self, index: u64) -> f64 {
        normal::quantile(self.uniform(index))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_their_values() {
        let stream = Random::new(7).stream(Purpose::ForceNoise, 41);
        assert_eq!(stream.bits(0), 13_639_428_296_288_009_589);
        assert_eq!(stream.bits(3), 10_308_629_338_191_251_828);
        assert_eq!(stream.uniform(1).to_bits(), 0x3fc8_91a2_b1e3_3106);
    }

    #[test]
    fn uniform_numbers_have_the_mean_and_variance_of_the_interval() {
        let stream = Random::new(1).stream(Purpose::Draws, 0);
        let n = 100_000;
        let mean = (0..n).map(|i| stream.uniform(i)).sum::<f64>() / n as f64;
        let variance = (0..n)
            .map(|i| (stream.uniform(i) - mean).powi(2))
            .sum::<f64>()
            / n as f64;
        assert!((mean - 0.5).abs() < 0.004, "{mean}");
        assert!((variance - 1.0 / 12.0).abs() < 0.001, "{variance}");
    }

    #[test]
    fn neighbouring_identities_and_purposes_are_uncorrelated() {
        let random = Random::new(3);
        let pairs = [
            (
                random.stream(Purpose::Draws, 0),
                random.stream(Purpose::Draws, 1),
            ),
            (
                random.stream(Purpose::Draws, 0),
                random.stream(Purpose::Surface, 0),
            ),
        ];
        for (left, right) in pairs {
            let n = 50_000_u64;
            let sum: f64 = (0..n).map(|i| left.normal(i) * right.normal(i)).sum();
            // Standard deviation of the mean product: 1/√n.
            assert!((sum / n as f64).abs() < 4.0 / (n as f64).sqrt());
        }
    }
}
