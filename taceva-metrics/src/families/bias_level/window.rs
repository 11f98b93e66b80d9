//! Adds the errors of a batch to their levels, with an array for adjacent levels.

use super::{LevelErrors, LevelSums};
use crate::exact::FixedSum;
use crate::exact::level::millionths;
use crate::pair::Paired;

/// Greatest length of the array of adjacent levels. Levels beyond its end are looked up in a map.
const LEVELS: usize = 1 << 12;

/// Placeholder for a pair without a level.
const NONE: i64 = i64::MIN;

/// Reused memory for a block of pairs: the level of each pair, and the sums of adjacent levels from the lowest.
#[derive(Debug, Default)]
pub(super) struct Window {
    of_rows: Vec<i64>,
    levels: Vec<(u32, FixedSum)>,
}

impl Window {
    /// Adds the errors of pairs to the levels of their truths. Levels are `width` millionths wide.
    pub(super) fn add(&mut self, pairs: Paired<&[f64]>, width: i64, sums: &mut LevelSums) {
        for pairs in pairs.blocks(FixedSum::MOST) {
            self.add_block(pairs, width, sums);
        }
    }

    fn add_block(&mut self, pairs: Paired<&[f64]>, width: i64, sums: &mut LevelSums) {
        let level = |pair: Paired<f64>| {
            let truth = millionths(pair.reference).filter(|_| pair.is_valid());
            truth.map_or(NONE, |truth| floored(truth, width))
        };
        self.of_rows.clear();
        self.of_rows.extend(pairs.iter().map(level));
        let with_level = || self.of_rows.iter().copied().filter(|level| *level != NONE);
        let (Some(lowest), Some(highest)) = (with_level().min(), with_level().max()) else {
            sums.n_invalid += count(self.of_rows.len());
            return;
        };
        let levels =
            usize::try_from(highest - lowest).map_or(LEVELS, |span| span.min(LEVELS - 1) + 1);
        self.levels.clear();
        self.levels.resize(levels, (0, FixedSum::default()));
        for (pair, &level) in pairs.iter().zip(&self.of_rows) {
            if level == NONE {
                sums.n_invalid += 1;
                continue;
            }
            sums.n += 1;
            let place = usize::try_from(level - lowest).unwrap_or(usize::MAX);
            let error = pair.residual();
            let is_held = self.levels.get_mut(place).is_some_and(|(n, errors)| {
                let is_held = errors.try_add(error);
                *n += u32::from(is_held);
                is_held
            });
            if !is_held {
                sums.levels.entry(level).add(error);
            }
        }
        for (level, (n, errors)) in (lowest..).zip(&mut self.levels) {
            if *n > 0 {
                let of_level: &mut LevelErrors = sums.levels.entry(level);
                of_level.n += u64::from(*n);
                errors.settle_into(&mut of_level.errors);
            }
        }
    }
}

/// ⌊value / width⌋. Common widths are literals here, because a division by a constant compiles to a multiplication.
#[inline]
fn floored(value: i64, width: i64) -> i64 {
    match width {
        100_000 => value.div_euclid(100_000),
        1_000_000 => value.div_euclid(1_000_000),
        width => value.div_euclid(width),
    }
}

fn count(rows: usize) -> u64 {
    u64::try_from(rows).expect("no column has 2^64 rows")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reference sums: adds the pairs one by one to the level ⌊truth / width⌋.
    fn one_by_one(pairs: &[[f64; 2]], width: i64) -> LevelSums {
        let mut sums = LevelSums::default();
        for &[reference, estimate] in pairs {
            let pair = Paired {
                estimate,
                reference,
            };
            match millionths(reference).filter(|_| pair.is_valid()) {
                Some(truth) => {
                    let level = sums.levels.entry(truth.div_euclid(width));
                    level.add(pair.residual());
                    sums.n += 1;
                }
                None => sums.n_invalid += 1,
            }
        }
        sums
    }

    fn by_window(pairs: &[[f64; 2]], width: i64, at_once: usize) -> LevelSums {
        let (mut window, mut sums) = (Window::default(), LevelSums::default());
        for part in pairs.chunks(at_once) {
            let column = |at: usize| part.iter().map(|pair| pair[at]).collect();
            let [reference, estimate]: [Vec<f64>; 2] = [column(0), column(1)];
            let pairs = Paired {
                estimate: &estimate[..],
                reference: &reference[..],
            };
            window.add(pairs, width, &mut sums);
        }
        sums
    }

    #[test]
    fn a_window_of_levels_keeps_what_every_pair_on_its_own_would_keep() {
        let near = (0..3000).map(|row| {
            let truth = f64::from(row % 251) * 0.1 - 12.5;
            [truth, truth + f64::from(row % 17) * 0.013 - 0.1]
        });
        let odd = [
            [1e6, 0.0],
            [-1e6, 3.0],
            [9e9, 1.0],
            [1e10, 0.0],
            [f64::NAN, 0.0],
            [0.0, f64::INFINITY],
            [0.25, 0.25 + 1e-14],
            [0.1, 1e300],
            [-0.0, 0.0],
        ];
        let few: Vec<[f64; 2]> = odd.to_vec();
        let near: Vec<[f64; 2]> = near.collect();
        let all: Vec<[f64; 2]> = near.iter().chain(&odd).copied().collect();
        for pairs in [&near, &all, &few] {
            for width in [100_000, 1_000_000, 7] {
                let expected = one_by_one(pairs, width);
                for at_once in [1, 100, 5000] {
                    assert_eq!(
                        by_window(pairs, width, at_once),
                        expected,
                        "{width} {at_once}"
                    );
                }
            }
        }
        assert!(one_by_one(&few, 100_000).n_invalid > 2);
    }
}
