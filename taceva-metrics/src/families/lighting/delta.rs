//! Intervals of robustness to lighting, by the delta method.

use super::robustness::{changes, variant_of};
use super::sums::LightingSums;
use crate::evaluate::family::Intervals;
use crate::exact::merge::Merge;
use crate::score::Interval;
use crate::score::least::LEAST_CLUSTERS;
use crate::score::range::Range;
use crate::score::value::{Finished, UndefinedReason};
use crate::stats::jackknife::{self, LeftOut};

/// Intervals of the robustness of one channel, by the delta method and a jackknife over contact points.
///
/// A left-out contact point changes the mean absolute error of scene c by a share δ_c, and of the reference scene by δ_o. To first order, the
/// robustness R_c to scene c changes by s_c (δ_c − δ_o), with s_c = ∂R_c / ∂ ln MAEc. The mean over C scenes changes by Σ s_c (δ_c − δ_o) / C.
///
/// A contact point is left out of all scenes at once, because presses at one place have similar errors in every light. The brightness counts as
/// exact, because it is a mean over whole pictures.
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
    let moves = Moves::new(total, clusters, reference);
    let mut variants = Vec::new();
    let mut terms = [Vec::new(), Vec::new()];
    for (scene, change) in &changes {
        let values = [change.robustness(), change.robustness_plus()];
        for ((plus, terms), value) in [false, true].into_iter().zip(&mut terms).zip(values) {
            if let Ok(value) = value {
                terms.push(Term {
                    scene,
                    value,
                    slope: change.slope(plus),
                });
            }
        }
        if change.robustness().is_ok() {
            let last = terms[0].last().into_iter();
            let interval = moves.interval(last, Range::Ratio);
            variants.push((variant_of(scene), interval));
        }
    }
    let [plain, plus] = terms;
    // If every error grew, both variants are equal and share one interval.
    let values = |terms: &[Term<'_>]| -> Vec<u64> {
        terms.iter().map(|term| term.value.to_bits()).collect()
    };
    let is_one = values(&plain) == values(&plus);
    let plain = moves.interval(&plain, Range::Ratio);
    let plus = match is_one {
        true => plain,
        false => moves.interval(&plus, Range::RatioWithEnds),
    };
    variants.push(("plus".to_owned(), plus));
    Intervals {
        value: Some(plain),
        variants,
        ..Intervals::default()
    }
}

/// Contribution of one scene to the mean robustness.
#[derive(Clone, Copy)]
struct Term<'a> {
    scene: &'a str,
    value: f64,
    /// Slope of the robustness over the logarithm of the scene's error; `None` if not finite.
    slope: Option<f64>,
}

/// Sums of errors by scene, with each contact point left out in turn.
struct Moves<'a> {
    total: &'a LightingSums,
    reference: &'a str,
    /// For each contact point, its number of samples and the sums of all other contact points.
    others: Vec<(u64, LightingSums)>,
    clusters: &'a [&'a LightingSums],
}

impl<'a> Moves<'a> {
    fn new(
        total: &'a LightingSums,
        clusters: &'a [&'a LightingSums],
        reference: &'a str,
    ) -> Moves<'a> {
        let others = clusters.iter().enumerate().map(|(left, cell)| {
            let mut others = LightingSums::default();
            let kept = clusters.iter().enumerate().filter(|(at, _)| *at != left);
            kept.for_each(|(_, cell)| others.merge(cell));
            (cell.n(), others)
        });
        Moves {
            total,
            reference,
            others: others.filter(|(count, _)| *count > 0).collect(),
            clusters,
        }
    }

    /// Interval of the mean robustness over the scenes of `terms`.
    fn interval<'t>(
        &self,
        terms: impl IntoIterator<Item = &'t Term<'t>>,
        range: Range,
    ) -> Interval {
        let terms: Vec<&Term<'_>> = terms.into_iter().collect();
        let scenes = terms.iter().map(|term| term.scene).chain([self.reference]);
        let clusters = scenes.map(|scene| self.clusters_of(scene)).min();
        let clusters = clusters.unwrap_or_default();
        if clusters < LEAST_CLUSTERS {
            return Interval::Undefined(UndefinedReason::TooFewClusters { have: clusters });
        }
        let count = terms.iter().fold(0.0, |count, _| count + 1.0);
        let value = terms.iter().map(|term| term.value).sum::<f64>() / count;
        let left_out: Vec<LeftOut> = self
            .others
            .iter()
            .map(|(count, others)| LeftOut {
                count: *count,
                value: self.moved(&terms, others),
            })
            .collect();
        match jackknife::standard_error(0.0, &left_out) {
            Ok(error) => jackknife::delta_interval(value, range, error * error, clusters),
            Err(reason) => Interval::Undefined(reason),
        }
    }

    fn clusters_of(&self, scene: &str) -> usize {
        let with = self.clusters.iter();
        with.filter(|cell| cell.scenes.get(scene).is_some()).count()
    }

    /// First-order change of the mean robustness over `terms`, if only the samples in `others` are used.
    fn moved(&self, terms: &[&Term<'_>], others: &LightingSums) -> Finished {
        let baseline = self.change_of(self.reference, others)?;
        let mut sum = 0.0;
        for term in terms {
            let slope = term.slope.ok_or(UndefinedReason::Overflow)?;
            sum += slope * (self.change_of(term.scene, others)? - baseline);
        }
        Ok(sum / terms.iter().fold(0.0, |count, _| count + 1.0))
    }

    /// Relative change of the mean absolute error of `scene`, from all samples to those in `others`.
    fn change_of(&self, scene: &str, others: &LightingSums) -> Finished {
        let mean = |sums: &LightingSums| match sums.scenes.get(scene) {
            Some(sums) if sums.n > 0 => Ok(sums.mean_error()),
            _ => Err(UndefinedReason::Empty),
        };
        Ok(mean(others)? / mean(self.total)? - 1.0)
    }
}
