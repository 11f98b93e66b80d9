//! How far a robustness would move with other contact points: the delta method on the errors it is made of.

use super::change::Change;
use super::robustness::{changes, variant_of};
use super::sums::{LightingSums, SceneSums};
use crate::evaluate::family::Intervals;
use crate::exact::merge::Merge;
use crate::score::Interval;
use crate::score::range::Range;
use crate::score::value::{Finished, UndefinedReason};
use crate::stats::jackknife::{self, LeftOut};

/// The intervals of one channel's scores, from the jackknife variances of ln MAE of each scene.
///
/// With v_c the variance of ln MAEc and s_c = ∂R_c / ∂ ln MAEc, a scene's variance is s_c² (v_c + v_o); the mean over C scenes
/// has (Σ s_c² v_c + (Σ s_c)² v_o) / C², because all share the reference. The brightness counts as known: it is a mean
/// over whole pictures. Presses at one place err alike under every light, which makes these intervals rather too wide.
pub(super) fn intervals(
    total: &LightingSums,
    clusters: &[&LightingSums],
    reference: &str,
) -> Intervals {
    let undefined = |reason| Intervals {
        value: Some(Interval::Undefined(reason)),
        ..Intervals::default()
    };
    let changes = match changes(total, reference) {
        Ok(changes) => changes,
        Err(reason) => return undefined(reason),
    };
    let baseline = log_variance(total, clusters, reference);
    let mut variants = Vec::new();
    let mut terms = [Vec::new(), Vec::new()];
    for (scene, change) in &changes {
        let own = log_variance(total, clusters, scene);
        let values = [change.robustness(), change.robustness_plus()];
        for ((plus, terms), value) in [false, true].into_iter().zip(&mut terms).zip(values) {
            if let Ok(value) = value {
                terms.push(term(*change, value, plus, own));
            }
        }
        if change.robustness().is_ok() {
            let last = terms[0].last().into_iter();
            let interval = mean_interval(last.copied(), baseline, Range::Ratio);
            variants.push((variant_of(scene), interval));
        }
    }
    let [plain, plus] = terms;
    // Where every error grew both are one quantity, and have one interval.
    let values = |terms: &[Result<Term, UndefinedReason>]| -> Vec<Option<u64>> {
        let values = terms.iter().map(|term| term.as_ref().ok());
        values
            .map(|term| term.map(|term| term.value.to_bits()))
            .collect()
    };
    let is_one = values(&plain) == values(&plus);
    let plain = mean_interval(plain.into_iter(), baseline, Range::Ratio);
    let plus = match is_one {
        true => plain,
        false => mean_interval(plus.into_iter(), baseline, Range::RatioWithEnds),
    };
    variants.push(("plus".to_owned(), plus));
    Intervals {
        value: Some(plain),
        variants,
        ..Intervals::default()
    }
}

/// A scene's share in an interval.
#[derive(Clone, Copy)]
struct Term {
    value: f64,
    slope: f64,
    variance: Variance,
}

/// The variance of a logarithm, and how many clusters it is from.
#[derive(Clone, Copy)]
struct Variance {
    value: f64,
    clusters: usize,
}

fn term(
    change: Change,
    value: f64,
    plus: bool,
    own: Result<Variance, UndefinedReason>,
) -> Result<Term, UndefinedReason> {
    Ok(Term {
        value,
        slope: change.slope(plus).ok_or(UndefinedReason::Overflow)?,
        variance: own?,
    })
}

/// The interval of the mean of `terms` that share a reference.
fn mean_interval(
    terms: impl Iterator<Item = Result<Term, UndefinedReason>>,
    baseline: Result<Variance, UndefinedReason>,
    range: Range,
) -> Interval {
    let sum = || {
        let baseline = baseline?;
        let terms = terms.collect::<Result<Vec<Term>, _>>()?;
        let count = terms.iter().fold(0.0, |count, _| count + 1.0);
        let value = terms.iter().map(|term| term.value).sum::<f64>() / count;
        let slope: f64 = terms.iter().map(|term| term.slope).sum();
        let own = terms
            .iter()
            .map(|term| term.slope * term.slope * term.variance.value);
        let variance = (own.sum::<f64>() + slope * slope * baseline.value) / (count * count);
        let clusters = terms.iter().map(|term| term.variance.clusters);
        let clusters = clusters
            .chain([baseline.clusters])
            .min()
            .unwrap_or_default();
        Ok((value, variance, clusters))
    };
    match sum() {
        Ok((value, variance, clusters)) => {
            jackknife::delta_interval(value, range, variance, clusters)
        }
        Err(reason) => Interval::Undefined(reason),
    }
}

/// The jackknife variance of the scene's mean absolute error over its square.
fn log_variance(
    total: &LightingSums,
    clusters: &[&LightingSums],
    scene: &str,
) -> Result<Variance, UndefinedReason> {
    let mean = |sums: &SceneSums| -> Finished {
        match sums.n {
            0 => Err(UndefinedReason::Empty),
            _ => Ok(sums.mean_error()),
        }
    };
    let cells: Vec<&SceneSums> = clusters
        .iter()
        .filter_map(|cell| cell.scenes.get(scene))
        .collect();
    let left_out = cells.iter().enumerate().map(|(left, cell)| {
        let mut others = SceneSums::default();
        let kept = cells.iter().enumerate().filter(|(at, _)| *at != left);
        kept.for_each(|(_, cell)| others.merge(cell));
        LeftOut {
            count: cell.n,
            value: mean(&others),
        }
    });
    let value = mean(total.scenes.get(scene).ok_or(UndefinedReason::Empty)?)?;
    let left_out: Vec<LeftOut> = left_out.collect();
    let relative = jackknife::standard_error(value, &left_out)? / value;
    Ok(Variance {
        value: relative * relative,
        clusters: left_out.len(),
    })
}
