//! Rows that each metric reads. Metrics of predictions read unseen samples, and metrics of only the truth read all samples.

use std::num::NonZeroUsize;
use std::ops::Range;

use taceva_core::Column;
use taceva_dataset::Dataset;
use taceva_metrics::{Evaluation, Evaluator, Metric, MetricPlan};

use crate::accumulate::{Columns, accumulate, reads_no_prediction, restricted};
use crate::error::EvaluateError;
use crate::note::Note;
use crate::predict::{Predicted, truth};

/// Metrics of a plan, grouped by the rows that they read.
pub(super) struct Passes<'a> {
    plan: &'a MetricPlan,
    /// Group of every row, for confidence intervals by group; `None` for other intervals.
    groups: Option<&'a [String]>,
    /// Metrics that compare clipped predictions with the truth.
    of_predictions: Vec<&'static Metric>,
    /// Metrics that compare unclipped predictions with the truth.
    of_unbounded: Vec<&'static Metric>,
    /// Metrics that read only the truth.
    of_truth: Vec<&'static Metric>,
}

impl<'a> Passes<'a> {
    /// Assigns the metrics of `plan` to passes. If a part was requested, every metric reads this part.
    pub(super) fn new(
        plan: &'a MetricPlan,
        groups: Option<&'a [String]>,
        is_part_asked_for: bool,
    ) -> Passes<'a> {
        let kept = plan.kept().iter().copied();
        let (of_truth, others): (Vec<_>, Vec<_>) =
            kept.partition(|metric| !is_part_asked_for && reads_no_prediction(metric));
        let (of_unbounded, of_predictions) = others
            .into_iter()
            .partition(|metric| metric.reads_unbounded_predictions());
        Passes {
            plan,
            groups,
            of_predictions,
            of_unbounded,
            of_truth,
        }
    }

    /// Accumulates `predicted`, the predictions of the rows `rows` of `dataset`. Metrics of only the truth also accumulate all other rows.
    pub(super) fn run(
        &self,
        dataset: &Dataset,
        predicted: &Predicted,
        rows: &[usize],
        jobs: NonZeroUsize,
    ) -> Result<Evaluator, EvaluateError> {
        let mut total = Evaluator::new(self.plan);
        let of_both = [
            (&self.of_predictions, predicted.prediction()),
            (&self.of_unbounded, predicted.unbounded()),
        ];
        for (metrics, prediction) in of_both {
            let columns = Columns {
                truth: predicted.truth(),
                prediction,
                dataset,
                rows,
                groups: self.groups,
            };
            let plan = restricted(self.plan, metrics)?;
            total.merge(accumulate(&columns, &plan, jobs)?)?;
        }
        if !self.of_truth.is_empty() {
            let rows = dataset.all_rows();
            let channels = self.plan.channels().iter();
            let truth: Vec<Column> = channels
                .map(|channel| truth(dataset, channel, &rows))
                .collect::<Result<_, _>>()?;
            let mut nothing = Column::default();
            rows.iter().for_each(|_| nothing.push(None));
            let columns = Columns {
                prediction: &vec![nothing; truth.len()],
                truth: &truth,
                dataset,
                rows: &rows,
                groups: self.groups,
            };
            let plan = restricted(self.plan, &self.of_truth)?;
            total.merge(accumulate(&columns, &plan, jobs)?)?;
        }
        Ok(total)
    }

    /// Scores of the predictions of one recording. `own` has the indices of its rows in `rows`. Intervals use clusters within this recording.
    pub(super) fn of_recording(
        &self,
        dataset: &Dataset,
        predicted: &Predicted,
        rows: &[usize],
        own: Range<usize>,
        jobs: NonZeroUsize,
    ) -> Result<Evaluation, EvaluateError> {
        let slice = |columns: &[Column]| -> Vec<Column> {
            let own = || own.clone();
            columns.iter().map(|column| column.slice(own())).collect()
        };
        let truth = slice(predicted.truth());
        let metrics = [&self.of_predictions[..], &self.of_unbounded].concat();
        let mut total = Evaluator::new(&restricted(self.plan, &metrics)?);
        for (metrics, prediction) in [
            (&self.of_predictions, predicted.prediction()),
            (&self.of_unbounded, predicted.unbounded()),
        ] {
            let columns = Columns {
                truth: &truth,
                prediction: &slice(prediction),
                dataset,
                rows: &rows[own.clone()],
                groups: self.groups,
            };
            let plan = restricted(self.plan, metrics)?;
            total.merge(accumulate(&columns, &plan, jobs)?)?;
        }
        let evaluation = total.finish()?;
        Ok(evaluation.with_bounded_shares(&predicted.bounded(own).shares()))
    }

    /// Note on metrics that read every row, if other metrics read predictions.
    pub(super) fn note(&self, dataset: &Dataset) -> Option<Note> {
        let metrics: Vec<&str> = self.of_truth.iter().map(|metric| metric.id).collect();
        let reads_predictions = !self.of_predictions.is_empty() || !self.of_unbounded.is_empty();
        let rows = dataset.table().rows();
        (!metrics.is_empty() && reads_predictions).then_some(Note::EveryRow { metrics, rows })
    }
}
