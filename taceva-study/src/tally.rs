//! From columns to scores, on all threads, with the same bits on any number of them.

use std::num::NonZeroUsize;
use std::ops::Range;

use taceva_core::{Batch, Column, Labels};
use taceva_metrics::{Evaluation, Evaluator, MetricError, MetricPlan};

/// Rows a batch: large enough that merging is rare, small enough that few are in flight.
const BATCH_ROWS: usize = 1 << 15;

/// Truth and predictions, column by column.
///
/// # Shapes
/// A column a channel of the plan, all of one length; `points`: a name a row.
pub(crate) struct Columns<'a> {
    pub(crate) truth: &'a [Column],
    pub(crate) prediction: &'a [Column],
    pub(crate) points: Option<&'a [&'a str]>,
}

impl Columns<'_> {
    fn rows(&self) -> usize {
        self.truth.first().map_or(0, Column::len)
    }

    fn batch(&self, plan: &MetricPlan, rows: Range<usize>) -> Batch {
        let slice = |columns: &[Column]| {
            columns
                .iter()
                .map(|column| column.slice(rows.clone()))
                .collect()
        };
        let points = self.points.map(|points| {
            let mut labels = Labels::default();
            points[rows.clone()]
                .iter()
                .for_each(|point| labels.push(point));
            labels
        });
        Batch::from_columns(
            plan.channels().clone(),
            slice(self.truth),
            slice(self.prediction),
            points,
        )
    }

    fn tally(&self, plan: &MetricPlan, rows: Range<usize>) -> Result<Evaluator, MetricError> {
        let mut evaluator = Evaluator::new(plan);
        for start in rows.clone().step_by(BATCH_ROWS) {
            let end = rows.end.min(start + BATCH_ROWS);
            evaluator.update(&self.batch(plan, start..end))?;
        }
        Ok(evaluator)
    }

    /// Scores all rows. Each thread takes a contiguous share; exact sums make the shares invisible.
    pub(crate) fn score(
        &self,
        plan: &MetricPlan,
        jobs: NonZeroUsize,
    ) -> Result<Evaluation, MetricError> {
        let rows = self.rows();
        let share = rows.div_ceil(jobs.get()).max(BATCH_ROWS);
        let shares: Vec<Range<usize>> = (0..rows)
            .step_by(share)
            .map(|start| start..rows.min(start + share))
            .collect();
        let evaluators: Vec<Result<Evaluator, MetricError>> = std::thread::scope(|scope| {
            let threads: Vec<_> = shares
                .into_iter()
                .map(|share| scope.spawn(move || self.tally(plan, share)))
                .collect();
            let joined = threads.into_iter().map(|thread| match thread.join() {
                Ok(evaluator) => evaluator,
                Err(panic) => std::panic::resume_unwind(panic),
            });
            joined.collect()
        });
        let mut total = Evaluator::new(plan);
        for evaluator in evaluators {
            total.merge(evaluator?)?;
        }
        total.finish()
    }
}
