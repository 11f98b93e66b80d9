//! Metrics of limits between which a share of all errors lies, such as limits of agreement.

mod errors;
mod intervals;
mod pair_sums;
mod sums;

use taceva_core::{Batch, Field, FieldSet, Labels, Needs, Unit};

use crate::evaluate::family::{FamilyKind, Intervals, Numbers, Output, erased};
use crate::evaluate::metric::Metric;
use crate::evaluate::plan::MetricPlan;
use crate::exact::moments::Moments;
use crate::exact::record::Record;
use crate::families::channelwise::{ByChannel, Channelwise, each_pair};
use crate::pair::is_valid;
use crate::score::ClusteredBy;
use crate::score::value::UndefinedReason;
use crate::stats::NormalSample;
pub(crate) use errors::Errors;
pub(crate) use intervals::{Whole, of_components};
use pair_sums::PairColumns;
use sums::ErrorSums;

/// Least number of samples for a standard deviation.
const LEAST_SAMPLES: u64 = 2;

/// Fields that metrics of error limits need: truth and prediction, for at least two samples.
pub(crate) const LIMIT_NEEDS: Needs =
    Needs::new(FieldSet::EMPTY.with(Field::Truth).with(Field::Prediction))
        .with_least_samples(LEAST_SAMPLES);

/// Formula of a metric of error limits.
pub(crate) struct LimitFormula {
    /// Computes value and variants from the errors of one channel, whose unit is given.
    pub(crate) finish: fn(&Errors<'_>, Unit) -> Numbers,
    /// Computes the factor of the standard deviation from all clusters. Resamples of clusters use the same factor.
    pub(crate) factor: fn(&NormalSample) -> Option<f64>,
    /// Replaces jackknife intervals if the metric has more accurate intervals.
    pub(crate) settle: fn(&mut Intervals, &Whole<'_>),
}

fn formula(metric: &Metric) -> Option<&'static LimitFormula> {
    metric.formula.get()
}

/// Family of metrics computed from the errors of each cluster of samples.
pub(crate) static ERROR_LIMITS: FamilyKind = FamilyKind {
    clusters_of_plan: true,
    own_intervals: true,
    ..FamilyKind::new("taceva.error-limits/1", |plan| {
        erased(ByChannel::new(ErrorLimits::for_plan(plan), plan))
    })
};

/// Collects errors by cluster of samples.
pub(crate) struct ErrorLimits {
    clustered_by: ClusteredBy,
    /// Means and differences of pairs for each channel index, because channels differ in magnitude.
    columns: Vec<PairColumns>,
}

impl ErrorLimits {
    /// Creates the family with the clusters of `plan`.
    pub(crate) fn for_plan(plan: &MetricPlan) -> ErrorLimits {
        ErrorLimits {
            clustered_by: plan.clustered_by(),
            columns: Vec::new(),
        }
    }

    /// True if the caller declared the samples independent.
    fn are_declared_independent(&self) -> bool {
        self.clustered_by == ClusteredBy::Sample
    }

    /// Clusters of the rows of `batch`; `None` if they are unknown, or if every sample is its own cluster.
    fn labels<'a>(&self, batch: &'a Batch) -> Option<&'a Labels> {
        match self.clustered_by {
            ClusteredBy::Point => batch.points(),
            ClusteredBy::Recording | ClusteredBy::Group => batch.recordings(),
            ClusteredBy::Sample => None,
        }
    }
}

impl Channelwise for ErrorLimits {
    type Sums = ErrorSums;

    fn deposit(
        &mut self,
        sums: &mut ErrorSums,
        batch: &Batch,
        position: usize,
        rows: Option<&[u32]>,
    ) {
        sums.forget_totals();
        let labels = self.labels(batch);
        if self.columns.len() <= position {
            self.columns.resize_with(position + 1, PairColumns::default);
        }
        let columns = &mut self.columns[position];
        let is_named = labels.is_some() && sums.clusters.are_named();
        let mut clusters = sums.clusters.of_labels(labels, batch.rows());
        let name = |row: usize| labels.and_then(|labels| labels.get(row));
        // Rows of one cluster mostly follow each other.
        let (mut first, mut run) = (0, Moments::default());
        each_pair(batch, position, rows, |row, pair| {
            if !pair.is_valid() {
                sums.n_invalid += 1;
                return;
            }
            sums.n += 1;
            let difference = pair.residual();
            let is_in_column = is_valid(difference);
            match is_in_column {
                true => columns.push(f64::midpoint(pair.reference, pair.estimate), difference),
                // The difference is too large for a column, but the pair is valid.
                false => sums.line.add(pair.reference, pair.estimate),
            }
            if is_in_column && !is_named {
                return;
            }
            if run.n > 0 && name(row) != name(first) {
                join(clusters.at(first, 0), std::mem::take(&mut run));
            }
            if run.n == 0 {
                first = row;
            }
            run.add(difference);
        });
        let differences = columns.settle_into(&mut sums.line);
        if !is_named {
            join(&mut run, differences);
        }
        if run.n > 0 {
            join(clusters.at(first, 0), run);
        }
        sums.bound_group();
    }

    fn to_record(&self, sums: &ErrorSums) -> Record {
        sums.to_record()
    }

    fn read_record(&self, record: &Record) -> Result<ErrorSums, String> {
        ErrorSums::read_record(record)
    }

    fn count(&self, sums: &ErrorSums) -> u64 {
        sums.n
    }

    fn invalid(&self, sums: &ErrorSums) -> u64 {
        sums.n_invalid
    }

    fn numbers(&self, metric: &Metric, output: &Output, sums: &ErrorSums) -> Numbers {
        let Some(formula) = formula(metric) else {
            return Numbers::of(Err(UndefinedReason::Empty));
        };
        let errors = Errors::of(sums.totals(), self.are_declared_independent());
        (formula.finish)(&errors, output.unit)
    }

    fn intervals(
        &self,
        metric: &Metric,
        output: &Output,
        clusters: &[Vec<&ErrorSums>],
    ) -> Option<Intervals> {
        let formula = formula(metric)?;
        let are_independent = self.are_declared_independent();
        Some(intervals::intervals(
            metric,
            formula,
            output.unit,
            clusters,
            are_independent,
        ))
    }
}

/// Adds the errors `others` to `errors`. The first errors of a cell are moved, which is faster than adding them to zero.
fn join(errors: &mut Moments, others: Moments) {
    match errors.n {
        0 => *errors = others,
        _ => errors.merge(&others),
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::{Channel, Channels, Column};

    use super::*;
    use crate::exact::merge::Merge;
    use crate::pair::GREATEST;

    #[test]
    fn totals_follow_every_change_of_the_sums() {
        let channels = Channels::new([Channel::FZ]).expect("one");
        let batch = |errors: &[f64]| {
            let truth = Column::full(errors.to_vec());
            let prediction = Column::full(vec![0.0; errors.len()]);
            Batch::from_columns(channels.clone(), vec![truth], vec![prediction], None)
        };
        let mut family = ErrorLimits {
            clustered_by: ClusteredBy::Point,
            columns: Vec::new(),
        };
        let mut sums = ErrorSums::default();
        family.deposit(&mut sums, &batch(&[0.1, -0.2]), 0, None);
        assert_eq!(sums.totals().errors.n, 2);
        family.deposit(&mut sums, &batch(&[0.3]), 0, None);
        assert_eq!(sums.totals().errors.n, 3);
        let others = sums.clone();
        sums.merge(&others);
        assert_eq!(sums.totals().errors.n, 6);
    }

    #[test]
    fn a_difference_too_large_for_a_column_counts_in_its_own_cluster() {
        let rows = [("a", 0.1), ("b", GREATEST), ("c", 0.2)];
        let sums = |order: [usize; 3]| {
            let ordered = order.map(|row| rows[row]);
            let mut points = Labels::default();
            ordered.iter().for_each(|(name, _)| points.push(name));
            let truth = Column::full(ordered.map(|(_, value)| value).to_vec());
            let prediction = Column::full(ordered.map(|(_, value)| -value).to_vec());
            let channels = Channels::new([Channel::FZ]).expect("one");
            let batch = Batch::from_columns(channels, vec![truth], vec![prediction], Some(points));
            let mut family = ErrorLimits {
                clustered_by: ClusteredBy::Point,
                columns: Vec::new(),
            };
            let mut sums = ErrorSums::default();
            family.deposit(&mut sums, &batch, 0, None);
            sums
        };
        let forward = sums([0, 1, 2]);
        let counts: Vec<u64> = forward
            .clusters
            .iter()
            .map(|(_, errors)| errors.n)
            .collect();
        assert_eq!(counts, [1, 1, 1]);
        assert_eq!(forward, sums([2, 0, 1]));
    }
}
