//! Intervals of error limits, by a jackknife over clusters or by the method of a metric.

use taceva_core::Unit;

use super::sums::{ErrorSums, Totals};
use super::{Errors, LimitFormula};
use crate::distributions::student_t;
use crate::evaluate::family::{Intervals, Numbers};
use crate::evaluate::metric::Metric;
use crate::score::least::LEAST_CLUSTERS;
use crate::score::range::Range;
use crate::score::value::{Finished, UndefinedReason};
use crate::score::{COVERAGE, ClusteredBy, Interval};
use crate::stats::NormalSample;
use crate::stats::jackknife::{self, LeftOut};

/// Value and variants computed from all clusters together, and the errors as a normal sample.
pub(crate) struct Whole<'a> {
    pub(crate) numbers: &'a Numbers,
    /// Errors of one channel; `None` for a plane, because its axes depend on each other.
    pub(crate) sample: Option<NormalSample>,
    /// True for one channel in which no two errors belong to one cluster.
    pub(crate) are_independent: bool,
    /// Number of clusters with samples.
    pub(crate) clusters: usize,
}

/// Errors of one channel: of all clusters together, and without each cluster.
struct Part {
    all: Totals,
    others: Vec<Totals>,
    are_declared_independent: bool,
    factor: Option<f64>,
}

impl Part {
    fn of(clusters: &[&ErrorSums], are_declared_independent: bool, formula: &LimitFormula) -> Part {
        let totals: Vec<&Totals> = clusters.iter().map(|sums| sums.totals()).collect();
        let mut part = Part {
            all: Totals::of_all(&totals),
            others: Totals::without_each(&totals),
            are_declared_independent,
            factor: None,
        };
        part.factor = part.errors(None).tolerance_factor(formula.factor);
        part
    }

    /// Errors without the cluster `left_out`, or all errors for `None`.
    fn errors(&self, left_out: Option<usize>) -> Errors<'_> {
        let totals = left_out.map_or(&self.all, |cluster| &self.others[cluster]);
        Errors::of(totals, self.are_declared_independent).with_factor(self.factor)
    }
}

/// Intervals of the value and of every variant of a score. `clusters` has the sums of each cluster, for each channel of the output.
///
/// The jackknife keeps the tolerance factor of all clusters, because another sample of as many clusters would have nearly the same factor.
pub(super) fn intervals(
    metric: &Metric,
    formula: &LimitFormula,
    unit: Unit,
    clusters: &[Vec<&ErrorSums>],
    are_declared_independent: bool,
) -> Intervals {
    let parts = clusters.iter();
    let parts = parts.map(|clusters| Part::of(clusters, are_declared_independent, formula));
    let parts: Vec<Part> = parts.collect();
    let numbers = |left_out: Option<usize>| {
        let mut of_parts = parts
            .iter()
            .map(|part| (formula.finish)(&part.errors(left_out), unit));
        let first = of_parts.next();
        let first = first.unwrap_or_else(|| Numbers::of(Err(UndefinedReason::Empty)));
        match of_parts.next() {
            Some(second) => first.mean(&second),
            None => first,
        }
    };
    let whole = numbers(None);
    // Without a value there is no interval, and no cluster to leave out.
    let mut variants = whole.variants.iter();
    let is_defined = whole.value.is_ok() || variants.any(|variant| variant.value.is_ok());
    let samples = |cluster: usize| {
        let of_parts = clusters.iter().map(|sums| sums[cluster].n);
        of_parts.fold(0, u64::saturating_add)
    };
    let left_out = 0..clusters.first().map_or(0, Vec::len);
    let left_out = left_out.filter(|cluster| is_defined && samples(*cluster) > 0);
    let left_out: Vec<(u64, Numbers)> = left_out
        .map(|cluster| (samples(cluster), numbers(Some(cluster))))
        .collect();
    let interval = |value: Finished, range: Range, of: &dyn Fn(&Numbers) -> Finished| {
        let left_out = left_out.iter().map(|(count, others)| LeftOut {
            count: *count,
            value: of(others),
        });
        match value {
            Ok(value) => jackknife::interval(value, range, &left_out.collect::<Vec<LeftOut>>()),
            Err(reason) => Interval::Undefined(reason),
        }
    };
    let variants = whole.variants.iter().map(|variant| {
        let name = &variant.name;
        let of = interval(variant.value, variant.range, &|others| others.variant(name));
        (name.to_string(), of)
    });
    let mut found = Intervals {
        value: Some(interval(whole.value, metric.range, &|others| others.value)),
        variants: variants.collect(),
        values: Vec::new(),
    };
    let one = match &parts[..] {
        [part] => Some(part.errors(None)),
        _ => None,
    };
    let whole = Whole {
        numbers: &whole,
        sample: one.and_then(|errors| errors.sample().ok()),
        are_independent: one.is_some_and(|errors| errors.are_independent()),
        clusters: left_out.len(),
    };
    (formula.settle)(&mut found, &whole);
    found
}

/// Interval with these ends, computed from a normal sample with `freedom` degrees of freedom.
pub(crate) fn of_components([low, high]: [f64; 2], freedom: f64, clusters: usize) -> Interval {
    if clusters < LEAST_CLUSTERS {
        return Interval::Undefined(UndefinedReason::TooFewClusters { have: clusters });
    }
    let t = student_t::quantile(f64::midpoint(1.0, COVERAGE), freedom);
    let standard_error = (high - low) / 2.0 / t;
    if !standard_error.is_finite() {
        return Interval::Undefined(UndefinedReason::Overflow);
    }
    Interval::Components {
        low,
        high,
        standard_error,
        freedom,
        clusters,
        by: ClusteredBy::default(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::moments::Moments;
    use crate::families::error_limits::ERROR_LIMITS;

    fn no_factor(_: &NormalSample) -> Option<f64> {
        panic!("errors without clusters need no factor")
    }

    #[test]
    fn errors_without_clusters_have_no_tolerance_limits_and_compute_no_factor() {
        let mut sums = ErrorSums {
            n: 3,
            ..ErrorSums::default()
        };
        let errors: Moments = [0.1, -0.2, 0.3].into_iter().collect();
        sums.clusters.of_labels(None, 3).at(0, 0).merge(&errors);
        let formula = LimitFormula {
            finish: |errors, _| Numbers::of(errors.tolerance_ends(no_factor).map(|[low, _]| low)),
            factor: no_factor,
            settle: |_, _| {},
        };
        let metric = Metric::of(&ERROR_LIMITS);
        let clusters = [vec![&sums; 6]];
        let found = intervals(&metric, &formula, Unit::Newton, &clusters, false);
        let none = Interval::Undefined(UndefinedReason::NoClusters);
        assert_eq!(found.value, Some(none));
    }
}
