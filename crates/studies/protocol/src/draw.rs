//! Counter-based random numbers. Each number depends on seed, purpose and counters, never on earlier numbers.

use taceva_core::random::{STEP, fnv_1a, mix};
use taceva_core::{Footprint, Nanometre};

/// Random numbers for one purpose.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Draws {
    key: u64,
}

/// Maximum number of tries for a place within an outline. A disc fills 79 % of its square, so 64 misses in a row occur once in 10⁴³ points.
const TRIES: u64 = 64;

impl Draws {
    /// Random numbers for `purpose` from `seed`.
    pub(crate) fn new(seed: u64, purpose: &str) -> Draws {
        Draws {
            key: mix(seed ^ fnv_1a(purpose.as_bytes())),
        }
    }

    /// 64 random bits for the two counters `place`.
    pub(crate) fn bits(self, place: [u64; 2]) -> u64 {
        mix(mix(self.key ^ place[0].wrapping_mul(STEP)) ^ place[1].wrapping_mul(STEP))
    }

    /// Random integer from `least` to `greatest`, inclusive.
    pub(crate) fn between(self, least: i64, greatest: i64, place: [u64; 2]) -> i64 {
        let span = u128::from(greatest.abs_diff(least)) + 1;
        let up = (u128::from(self.bits(place)) * span) >> 64;
        least + i64::try_from(up).expect("at most the difference of two lengths, which fits an i64")
    }

    /// Uniformly random place in `footprint`, for point number `point`.
    pub(crate) fn place(self, footprint: &Footprint, point: u64) -> [Nanometre; 2] {
        let [half_x, half_y] = footprint.half_extent();
        let candidate = |attempt: u64| {
            let x = self.between(-half_x.0, half_x.0, [point, 2 * attempt]);
            let y = self.between(-half_y.0, half_y.0, [point, 2 * attempt + 1]);
            [Nanometre(x), Nanometre(y)]
        };
        let inside = |&[x, y]: &[Nanometre; 2]| footprint.contains(x, y);
        (0..TRIES).map(candidate).find(inside).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_their_values() {
        let draws = Draws::new(7, "spatial");
        assert_eq!(draws.bits([3, 4]), 6_457_705_831_062_634_958);
    }

    #[test]
    fn a_draw_depends_on_its_place_alone() {
        let draws = Draws::new(7, "calibration");
        let forward: Vec<u64> = (0..100).map(|point| draws.bits([point, 0])).collect();
        let mut backward: Vec<u64> = (0..100).rev().map(|point| draws.bits([point, 0])).collect();
        backward.reverse();
        assert_eq!(forward, backward);
        assert_ne!(draws.bits([0, 0]), Draws::new(7, "spatial").bits([0, 0]));
    }

    #[test]
    fn places_fill_a_disc_and_nothing_else() {
        let disc = Footprint::disc(17.0, None).expect("a disc");
        let draws = Draws::new(1, "test");
        let places: Vec<_> = (0..4_000).map(|point| draws.place(&disc, point)).collect();
        assert!(places.iter().all(|&[x, y]| disc.contains(x, y)));
        let half = Footprint::disc(17.0 / 2_f64.sqrt(), None).expect("half the area");
        let inner = places.iter().filter(|&&[x, y]| half.contains(x, y)).count();
        // Binomial with p = 1/2: five standard deviations are 158.
        assert!(inner.abs_diff(2_000) < 158, "{inner}");
    }

    #[test]
    fn both_ends_of_a_range_are_drawn() {
        let draws = Draws::new(3, "ends");
        let drawn: std::collections::BTreeSet<i64> = (0..200)
            .map(|place| draws.between(-1, 1, [place, 0]))
            .collect();
        assert_eq!(drawn.into_iter().collect::<Vec<_>>(), [-1, 0, 1]);
    }
}
