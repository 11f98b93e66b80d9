//! Scores as integers with the same order.

/// Number of grid steps in a score difference of 1.
const STEPS: f64 = 65_536.0;

/// Magnitude from which every binary64 number is a multiple of a grid step.
const ON_GRID: f64 = 137_438_953_472.0;

/// Key of a finite score: an integer with the order of the scores. Both zeros are equal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct ScoreKey(u64);

const SIGN: u64 = 1 << 63;

impl ScoreKey {
    pub(crate) fn of(score: f64) -> ScoreKey {
        // −0 + 0 is 0.
        let bits = (score + 0.0).to_bits();
        match bits & SIGN {
            0 => ScoreKey(bits | SIGN),
            _ => ScoreKey(!bits),
        }
    }

    pub(crate) fn score(self) -> f64 {
        match self.0 & SIGN {
            0 => f64::from_bits(!self.0),
            _ => f64::from_bits(self.0 & !SIGN),
        }
    }

    /// Key of the nearest multiple of 2⁻¹⁶, half to even.
    pub(crate) fn on_grid(self) -> ScoreKey {
        let score = self.score();
        match score.abs() < ON_GRID {
            true => ScoreKey::of((score * STEPS).round_ties_even() / STEPS),
            false => self,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_have_the_order_of_scores_and_give_them_back() {
        let scores = [
            f64::MIN,
            -2.5,
            -1e-300,
            0.0,
            1e-300,
            0.1,
            0.5,
            1.0,
            f64::MAX,
        ];
        for pair in scores.windows(2) {
            assert!(ScoreKey::of(pair[0]) < ScoreKey::of(pair[1]), "{pair:?}");
        }
        for score in scores {
            assert_eq!(ScoreKey::of(score).score().to_bits(), score.to_bits());
        }
        assert_eq!(ScoreKey::of(-0.0), ScoreKey::of(0.0));
    }

    #[test]
    fn the_grid_rounds_half_to_even_and_keeps_its_own_points() {
        let step = 1.0 / STEPS;
        for (score, expected) in [
            (0.5 * step, 0.0),
            (1.5 * step, 2.0 * step),
            (-0.5 * step, 0.0),
            (0.75, 0.75),
            (1e300, 1e300),
        ] {
            let found = ScoreKey::of(score).on_grid();
            assert_eq!(found, ScoreKey::of(expected), "{score}");
            assert_eq!(found.on_grid(), found, "{score}");
        }
    }
}
