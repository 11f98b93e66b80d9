//! Scores of a ranking from the counts of each different score.

use serde::{Deserialize, Serialize};

use crate::quotient::{Quotient, ratio, sum_over};
use crate::undefined::Undefined;

/// Numbers of samples with one score.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Level {
    /// Score of these samples.
    pub(crate) score: f64,
    /// Number of samples of the positive class.
    pub(crate) positive: u64,
    /// Number of samples of the negative class.
    pub(crate) negative: u64,
}

impl Level {
    pub(crate) fn of(score: f64, sides: Sides) -> Level {
        Level {
            score,
            positive: sides.positive,
            negative: sides.negative,
        }
    }
}

/// Numbers of samples of the positive and of the negative class.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Sides {
    pub(crate) positive: u64,
    pub(crate) negative: u64,
}

impl Sides {
    pub(crate) fn of(levels: &[Level]) -> Sides {
        Sides {
            positive: levels.iter().map(|level| level.positive).sum(),
            negative: levels.iter().map(|level| level.negative).sum(),
        }
    }

    pub(crate) fn n(self) -> u64 {
        self.positive + self.negative
    }

    /// Share of positive samples; `None` without samples.
    pub(crate) fn prevalence(self) -> Option<f64> {
        (self.n() > 0).then(|| ratio(u128::from(self.positive), u128::from(self.n())))
    }
}

/// Probability that a positive sample has a greater score than a negative sample; equal scores count half.
///
/// `levels` are the counts of each score, in ascending order. Levels without samples do not change the result.
pub(crate) fn roc_auc(levels: &[Level]) -> Result<f64, Undefined> {
    let sides = Sides::of(levels);
    match (sides.positive, sides.negative) {
        (0, 0) => return Err(Undefined::Empty),
        (0, _) | (_, 0) => return Err(Undefined::OneClass),
        _ => {}
    }
    let (mut halves, mut below) = (0_u128, 0_u64);
    for level in levels {
        let halves_of_each = 2 * u128::from(below) + u128::from(level.negative);
        halves += u128::from(level.positive) * halves_of_each;
        below += level.negative;
    }
    let pairs = u128::from(sides.positive) * u128::from(sides.negative);
    Ok(ratio(halves, 2 * pairs))
}

/// Average precision: sum over the scores of the precision at a score times the recall that the score adds.
///
/// `levels` are the counts of each score, in ascending order.
pub(crate) fn average_precision(levels: &[Level]) -> Result<f64, Undefined> {
    let positive = positives(levels)?;
    let mut above = Sides::default();
    let mut terms = Vec::new();
    for level in levels.iter().rev() {
        above.positive += level.positive;
        above.negative += level.negative;
        if level.positive > 0 {
            terms.push(Quotient {
                above: u128::from(above.positive) * u128::from(level.positive),
                below: above.n(),
            });
        }
    }
    Ok(sum_over(terms.iter().copied(), positive))
}

/// Same as [`average_precision`], but faster, because each term is rounded. Used for the rankings of a jackknife, each without one cluster.
pub(crate) fn average_precision_of_rest(levels: &[Level]) -> Result<f64, Undefined> {
    let positive = positives(levels)?;
    let mut above = Sides::default();
    let mut sum = 0.0;
    for level in levels.iter().rev() {
        above.positive += level.positive;
        above.negative += level.negative;
        if level.positive > 0 {
            sum += level.positive as f64 * (above.positive as f64 / above.n() as f64);
        }
    }
    Ok(sum / positive as f64)
}

/// Number of positive samples. Undefined without positive samples.
fn positives(levels: &[Level]) -> Result<u64, Undefined> {
    let sides = Sides::of(levels);
    match (sides.n(), sides.positive) {
        (0, _) => Err(Undefined::Empty),
        (_, 0) => Err(Undefined::NoPositive),
        (_, positive) => Ok(positive),
    }
}
