//! Random numbers, each a function of seed, purpose and place.

use taceva_core::random::{STEP, fnv_1a, mix, unit};

/// A source of numbers for one purpose.
#[derive(Clone, Copy, Debug)]
pub(super) struct Draws {
    key: u64,
}

impl Draws {
    /// Numbers of `seed` for `purpose`.
    pub(super) fn new(seed: u64, purpose: &str) -> Draws {
        Draws {
            key: mix(seed ^ fnv_1a(purpose.as_bytes())),
        }
    }

    /// 64 random bits at `place`.
    pub(super) fn bits(self, place: [u64; 2]) -> u64 {
        mix(mix(self.key ^ place[0].wrapping_mul(STEP)) ^ place[1].wrapping_mul(STEP))
    }

    /// A whole number from `least` to `greatest`, both included.
    pub(super) fn between(self, least: u64, greatest: u64, place: [u64; 2]) -> u64 {
        least + taceva_core::random::scaled(self.bits(place), greatest - least + 1)
    }

    /// Number from 0 to below 1.
    pub(super) fn fraction(self, place: [u64; 2]) -> f64 {
        unit(self.bits(place))
    }
}
