//! Variants for the spread of bin means beyond chance, computed from known clusters.

use crate::evaluate::family::Intervals;
use crate::score::Interval;
use crate::score::value::UndefinedReason;
use crate::stats::components::Excess;

/// Value of a variant, and both ends of its interval.
pub(crate) struct WithEnds {
    pub(crate) value: f64,
    pub(crate) ends: [f64; 2],
}

/// Value and interval of the variant `name`. `finish` computes both from the mean of `all`, whose samples form `clusters` clusters.
pub(crate) fn of_mean(
    name: &str,
    all: Result<Vec<Excess>, UndefinedReason>,
    clusters: usize,
    finish: impl Fn(&Excess) -> Result<WithEnds, UndefinedReason>,
) -> Intervals {
    let found = all.and_then(|all| {
        let excess = Excess::mean_of(&all).ok_or(UndefinedReason::Empty)?;
        finish(&excess)
    });
    let (value, interval) = match found {
        Ok(found) => (Ok(found.value), Excess::interval(found.ends, clusters)),
        Err(reason) => (Err(reason), Interval::Undefined(reason)),
    };
    Intervals {
        variants: vec![(name.to_owned(), interval)],
        values: vec![(name.to_owned(), value)],
        ..Intervals::default()
    }
}
