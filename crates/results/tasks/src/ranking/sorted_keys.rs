//! Sorted scores of each class, and the number of samples with each score.

use std::iter::from_fn;

use super::{ScoreKey, Sides};
use crate::error::TaskError;

/// Keys of positive and of negative samples, each in ascending order.
///
/// Two sorted lists need half the memory of sorted pairs of a score and a class, and less time.
#[derive(Debug)]
pub(super) struct SortedKeys {
    positive: Vec<ScoreKey>,
    negative: Vec<ScoreKey>,
}

impl SortedKeys {
    /// Keys of `scores`, the first of which is row `first`. Both slices are equally long.
    ///
    /// # Errors
    /// [`TaskError::NotFinite`] for a score that is NaN or infinite.
    pub(super) fn of(
        scores: &[f64],
        is_positive: &[bool],
        first: u64,
    ) -> Result<SortedKeys, TaskError> {
        if let Some(at) = scores.iter().position(|score| !score.is_finite()) {
            return Err(TaskError::NotFinite {
                row: first + at as u64,
                column: "the score".to_owned(),
                value: scores[at],
            });
        }
        let positives = is_positive.iter().filter(|is| **is).count();
        let mut keys = SortedKeys {
            positive: Vec::with_capacity(positives),
            negative: Vec::with_capacity(scores.len() - positives),
        };
        for (score, is_positive) in scores.iter().zip(is_positive) {
            let side = match is_positive {
                true => &mut keys.positive,
                false => &mut keys.negative,
            };
            side.push(ScoreKey::of(*score));
        }
        keys.positive.sort_unstable();
        keys.negative.sort_unstable();
        Ok(keys)
    }

    /// Number of samples.
    pub(super) fn n(&self) -> u64 {
        (self.positive.len() + self.negative.len()) as u64
    }

    /// Rounds all keys to multiples of 2⁻¹⁶, which keeps their order.
    pub(super) fn round_to_grid(&mut self) {
        for key in self.positive.iter_mut().chain(&mut self.negative) {
            *key = key.on_grid();
        }
    }

    /// Each different key with its samples, in ascending order.
    pub(super) fn levels(&self) -> impl Iterator<Item = (ScoreKey, Sides)> {
        let [mut positive, mut negative] = [self.positive.as_slice(), self.negative.as_slice()];
        from_fn(move || {
            let key = match (positive.first(), negative.first()) {
                (Some(one), Some(other)) => *one.min(other),
                (one, other) => *one.or(other)?,
            };
            Some((
                key,
                Sides {
                    positive: count_first(&mut positive, key),
                    negative: count_first(&mut negative, key),
                },
            ))
        })
    }
}

/// Removes all keys equal to `key` from the front of `keys`, and returns their number.
fn count_first(keys: &mut &[ScoreKey], key: ScoreKey) -> u64 {
    let n = keys.iter().take_while(|own| **own == key).count();
    *keys = &keys[n..];
    n as u64
}
