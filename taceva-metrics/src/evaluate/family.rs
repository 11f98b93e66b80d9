//! Interface of a family of metrics for [`Accumulator`](crate::evaluate::accumulator::Accumulator).

use std::borrow::Cow;
use std::collections::BTreeMap;

use taceva_core::{Batch, FieldSet, Labels, SkipReason, Unit};

pub(crate) use crate::evaluate::accumulator::{AnyFamily, erased};
use crate::evaluate::metric::Metric;
use crate::evaluate::plan::MetricPlan;
use crate::exact::merge::Merge;
use crate::exact::record::Record;
use crate::score::flag::Flag;
use crate::score::range::Range;
use crate::score::value::{Finished, InapplicableReason, UndefinedReason};
use crate::score::{Count, Interval, Parameter, Variant};

/// Description of a family as data: the schema of its states, and its constructor for a plan.
#[derive(Debug)]
pub(crate) struct FamilyKind {
    /// Schema of the family's states: name and version.
    pub(crate) schema: &'static str,
    /// True if the family keeps one summary of all samples, without clusters, because its scores have no intervals.
    pub(crate) is_whole: bool,
    /// True if the plan chooses the clusters; otherwise they are contact points.
    pub(crate) clusters_of_plan: bool,
    /// True if [`Family::intervals`] computes all intervals. The interval method of the plan is then ignored.
    pub(crate) own_intervals: bool,
    /// Fields that the family reads if samples have them.
    pub(crate) optional: FieldSet,
    /// Reason why the plan skips the metrics of the family, apart from missing needs. `None` if they can be computed.
    pub(crate) obstacle: fn(&MetricPlan) -> Option<SkipReason>,
    /// Creates the family for a plan that contains one of its metrics.
    pub(crate) build: fn(&MetricPlan) -> Option<Box<dyn AnyFamily>>,
}

impl FamilyKind {
    /// Family with contact points as clusters and without optional fields.
    pub(crate) const fn new(
        schema: &'static str,
        build: fn(&MetricPlan) -> Option<Box<dyn AnyFamily>>,
    ) -> FamilyKind {
        FamilyKind {
            schema,
            is_whole: false,
            clusters_of_plan: false,
            own_intervals: false,
            optional: FieldSet::EMPTY,
            obstacle: |_| None,
            build,
        }
    }
}

/// Sums of a family of metrics, and the scores computed from them.
///
/// # Laws
/// The sums of [`deposit`](Family::deposit) must be a function of the set of rows: neither their order nor their grouping may matter.
pub(crate) trait Family: Send + 'static {
    /// Sums of one part. A part is a channel, a plane, a kind of grating, or all samples together.
    type Sums: Merge + Clone + Send + 'static;

    /// Parameters that must be equal in merged states; none by default.
    fn parameters(&self) -> BTreeMap<String, String> {
        BTreeMap::new()
    }
    /// Empty sums of each part.
    fn empty(&self) -> Vec<Self::Sums>;
    /// Adds to `sums` the rows of `batch` with the ascending indices `rows`, or all rows for `None`.
    fn deposit(&mut self, sums: &mut [Self::Sums], batch: &Batch, rows: Option<&[u32]>);
    /// Cluster of each row of `batch`, by default its contact point. `None` if the rows have no clusters.
    fn clusters<'a>(&self, batch: &'a Batch) -> Option<Cow<'a, Labels>> {
        batch.points().map(Cow::Borrowed)
    }
    /// Reason why a score has no interval if the rows have no clusters.
    fn unclustered(&self) -> UndefinedReason {
        UndefinedReason::NoClusters
    }
    /// Converts the sums of one part to a record of a state.
    fn to_record(&self, sums: &Self::Sums) -> Record;
    /// Reads the sums of the part at index `position` from a record of a state.
    fn read_record(&self, position: usize, record: &Record) -> Result<Self::Sums, String>;

    /// Scores of `metric`, one per channel, plane or other part. The metric belongs to this family.
    fn outputs(&self, metric: &Metric) -> Vec<Output>;
    /// Number of samples in `sums` of one part that `metric` uses, as the weight of a cluster.
    fn count(&self, metric: &Metric, sums: &Self::Sums) -> u64;
    /// Number of samples that `sums` of one part skipped because of an unusable value.
    fn invalid(&self, sums: &Self::Sums) -> u64;
    /// Value and variants of `metric` for one part. A score of two parts is the mean of both.
    fn numbers(&self, metric: &Metric, output: &Output, sums: &Self::Sums) -> Numbers;
    /// Value and variants of `metric` for a selection of clusters. Numbers without intervals may be missing.
    fn resampled(&self, metric: &Metric, output: &Output, sums: &Self::Sums) -> Numbers {
        self.numbers(metric, output, sums)
    }
    /// Value and variants of `metric` computed from the `sums` of all parts together. `None` if the mean over the parts applies.
    fn joint(&self, _metric: &Metric, _output: &Output, _sums: &[Self::Sums]) -> Option<Numbers> {
        None
    }
    /// Reason why `metric` does not apply to the channels of an output; `None` if it applies.
    fn inapplicable(&self, _metric: &Metric, _output: &Output) -> Option<InapplicableReason> {
        None
    }
    /// Maps, counts, constants and flags of a score, from the sums of all its parts.
    fn details(&self, _metric: &Metric, _output: &Output, _parts: &[&Self::Sums]) -> Details {
        Details::default()
    }
    /// Intervals of the value and of the variants, if the family has a better method than the jackknife of the score. `clusters` has one item per
    /// cluster: the sums of each part.
    fn intervals(
        &self,
        _metric: &Metric,
        _output: &Output,
        _clusters: &[&Vec<Self::Sums>],
    ) -> Option<Intervals> {
        None
    }
}

/// Calls `add` with each row index in `rows`, or with every row of `batch` for `None`.
pub(crate) fn each_row(batch: &Batch, rows: Option<&[u32]>, mut add: impl FnMut(usize)) {
    match rows {
        Some(rows) => rows.iter().for_each(|&row| add(row as usize)),
        None => (0..batch.rows()).for_each(add),
    }
}

/// One score of a metric: the score of a part, or the mean of two parts.
#[derive(Clone, Debug)]
pub(crate) struct Output {
    /// Name of the channel, plane or other part in reports.
    pub(crate) label: String,
    /// Unit of the channels that the score uses.
    pub(crate) unit: Unit,
    /// Channels of the output; empty for a single channel.
    pub(crate) of: Vec<String>,
    /// Indices of the one or two source parts.
    pub(crate) parts: Vec<usize>,
}

/// Value and variants of a score: the numbers that have intervals.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Numbers {
    pub(crate) value: Finished,
    pub(crate) variants: Vec<Number>,
}

/// A scalar variant of a score.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Number {
    pub(crate) name: Cow<'static, str>,
    pub(crate) unit: Unit,
    pub(crate) range: Range,
    pub(crate) value: Finished,
}

impl Numbers {
    /// Numbers with a value and no variants. A value that is not finite becomes [`UndefinedReason::Overflow`].
    pub(crate) fn of(value: Finished) -> Numbers {
        Numbers {
            value: value.and_then(finite),
            variants: Vec::new(),
        }
    }

    /// The same numbers with one more variant.
    pub(crate) fn with(
        mut self,
        name: impl Into<Cow<'static, str>>,
        unit: Unit,
        range: Range,
        value: Finished,
    ) -> Numbers {
        self.variants.push(Number {
            name: name.into(),
            unit,
            range,
            value: value.and_then(finite),
        });
        self
    }

    /// Value of the variant called `name`; [`UndefinedReason::Empty`] for an unknown name.
    pub(crate) fn variant(&self, name: &str) -> Finished {
        let found = self.variants.iter().find(|variant| variant.name == name);
        found.map_or(Err(UndefinedReason::Empty), |variant| variant.value)
    }

    /// Mean of each number and the number of the same name in `other`, rounded once. The mean is undefined if either number is.
    pub(crate) fn mean(self, other: &Numbers) -> Numbers {
        let mean = |left: Finished, right: Finished| Ok(midpoint(left?, right?));
        let variants = self.variants.into_iter().map(|variant| Number {
            value: mean(variant.value, other.variant(&variant.name)),
            ..variant
        });
        Numbers {
            value: mean(self.value, other.value),
            variants: variants.collect(),
        }
    }
}

fn finite(value: f64) -> Finished {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(UndefinedReason::Overflow)
    }
}

/// Mean of both numbers, rounded once. Halving the sum is exact unless the sum is subnormal, and a subnormal sum is exact itself. If the sum
/// overflows, each number is halved first, exactly.
pub(crate) fn midpoint(left: f64, right: f64) -> f64 {
    let sum = left + right;
    if sum.is_finite() {
        sum * 0.5
    } else {
        left * 0.5 + right * 0.5
    }
}

/// Details of a score other than its numbers: maps and curves, counts, constants and flags.
#[derive(Clone, Debug, Default)]
pub(crate) struct Details {
    pub(crate) variants: Vec<Variant>,
    pub(crate) counts: Vec<Count>,
    pub(crate) parameters: Vec<Parameter>,
    pub(crate) flags: Vec<Flag>,
}

/// Intervals of a value and of its variants by name, and values of variants that depend on clusters.
#[derive(Clone, Debug, Default)]
pub(crate) struct Intervals {
    /// Interval of the value; `None` to use the jackknife of the score.
    pub(crate) value: Option<Interval>,
    pub(crate) variants: Vec<(String, Interval)>,
    /// Values of variants, by name, that are computed from the clusters instead of the total sums.
    pub(crate) values: Vec<(String, Finished)>,
}

impl Intervals {
    /// Interval of the variant called `name`, or of the value for `None`. If a name has several entries, the last applies.
    pub(crate) fn of(&self, name: Option<&str>) -> Option<Interval> {
        let Some(name) = name else {
            return self.value;
        };
        let mut variants = self.variants.iter().rev();
        let found = variants.find(|(known, _)| known == name);
        found.map(|(_, interval)| *interval)
    }

    /// Value of the variant called `name` computed from clusters; `None` for an unknown name.
    pub(crate) fn value_of(&self, name: &str) -> Option<Finished> {
        let mut values = self.values.iter();
        let found = values.find(|(known, _)| known == name);
        found.map(|(_, value)| *value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_of_two_is_rounded_once_at_both_ends_of_the_range() {
        let denormal = f64::from_bits;
        assert_eq!(midpoint(denormal(1), denormal(2)).to_bits(), 2);
        assert_eq!(midpoint(f64::MAX, f64::MAX).to_bits(), f64::MAX.to_bits());
        assert_eq!(midpoint(1.0, 2.0).to_bits(), 1.5_f64.to_bits());
    }

    #[test]
    fn a_mean_of_numbers_is_undefined_where_either_is() {
        let left = Numbers::of(Ok(1.0)).with("a", Unit::One, Range::Any, Ok(3.0));
        let right =
            Numbers::of(Ok(2.0)).with("a", Unit::One, Range::Any, Err(UndefinedReason::Empty));
        let mean = left.clone().mean(&right);
        assert_eq!(
            (mean.value, mean.variant("a")),
            (Ok(1.5), Err(UndefinedReason::Empty))
        );
        assert_eq!(
            left.mean(&Numbers::of(Ok(2.0))).variant("a"),
            Err(UndefinedReason::Empty)
        );
    }

    #[test]
    fn a_number_that_is_not_finite_is_an_overflow() {
        let numbers = Numbers::of(Ok(f64::INFINITY)).with("a", Unit::One, Range::Any, Ok(f64::NAN));
        assert_eq!(numbers.value, Err(UndefinedReason::Overflow));
        assert_eq!(numbers.variant("a"), Err(UndefinedReason::Overflow));
    }
}
