//! Reproducible random numbers, computed from a seed, a purpose and two indices.

use taceva_core::random::{STEP, fnv_1a, mix, unit};

/// A source of random numbers for one purpose.
#[derive(Clone, Copy, Debug)]
pub(super) struct Draws {
    key: u64,
}

impl Draws {
    /// Creates the source of random numbers for `purpose` from `seed`.
    pub(super) fn new(seed: u64, purpose: &str) -> Draws {
        Draws {
            key: mix(seed ^ fnv_1a(purpose.as_bytes())),
        }
    }

    /// Returns the 64 random bits with the two indices `place`.
    pub(super) fn bits(self, place: [u64; 2]) -> u64 {
        mix(mix(self.key ^ place[0].wrapping_mul(STEP)) ^ place[1].wrapping_mul(STEP))
    }

    /// A whole number from `least` to `greatest`, both included.
    pub(super) fn between(self, least: u64, greatest: u64, place: [u64; 2]) -> u64 {
        least + taceva_core::random::scaled(self.bits(place), greatest - least + 1)
    }

    /// Returns the random number, from 0 to below 1, with the two indices `place`.
    pub(super) fn fraction(self, place: [u64; 2]) -> f64 {
        unit(self.bits(place))
    }
}
