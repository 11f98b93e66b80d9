//! From rows to scores, on all threads, with the same bits on any number of them.

use std::num::NonZeroUsize;
use std::ops::Range;

use taceva_core::{Batch, Column, Labels};
use taceva_metrics::{Evaluation, Evaluator, MetricPlan};

use crate::error::StudyError;

/// Rows a batch: large enough that merging is rare, small enough that a batch stays in the cache.
const BATCH_ROWS: usize = 1 << 12;

/// Where rows with truth and prediction come from: any of them, asked for from any thread.
pub(crate) trait Rows: Sync {
    /// How many there are.
    fn rows(&self) -> usize;

    /// Those in `rows`, with the channels of the plan.
    ///
    /// # Errors
    /// [`StudyError`] if one of them cannot be read.
    fn batch(&self, plan: &MetricPlan, rows: Range<usize>) -> Result<Batch, StudyError>;
}

/// Scores all rows. Each thread takes a contiguous share; exact sums make the shares invisible.
///
/// Shares are whole batches, so that the first batch with an error is the same on any number of threads.
///
/// # Errors
/// [`StudyError`] of the first batch that cannot be read or scored.
pub(crate) fn score(
    source: &impl Rows,
    plan: &MetricPlan,
    jobs: NonZeroUsize,
) -> Result<Evaluation, StudyError> {
    let rows = source.rows();
    let share = rows.div_ceil(jobs.get()).next_multiple_of(BATCH_ROWS);
    let shares: Vec<Range<usize>> = (0..rows)
        .step_by(share.max(BATCH_ROWS))
        .map(|start| start..rows.min(start + share))
        .collect();
    let evaluators: Vec<Result<Evaluator, StudyError>> = std::thread::scope(|scope| {
        let threads: Vec<_> = shares
            .into_iter()
            .map(|share| scope.spawn(move || tally(source, plan, share)))
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
    Ok(total.finish()?)
}

fn tally(
    source: &impl Rows,
    plan: &MetricPlan,
    rows: Range<usize>,
) -> Result<Evaluator, StudyError> {
    let mut evaluator = Evaluator::new(plan);
    for start in rows.clone().step_by(BATCH_ROWS) {
        let end = rows.end.min(start + BATCH_ROWS);
        evaluator.update(&source.batch(plan, start..end)?)?;
    }
    Ok(evaluator)
}

/// A name a row.
pub(crate) fn labels<'a>(names: impl Iterator<Item = &'a str>) -> Labels {
    let mut labels = Labels::default();
    names.for_each(|name| labels.push(name));
    labels
}

/// Truth and predictions that lie in memory, column by column.
///
/// # Shapes
/// A column a channel of the plan, all of one length; `points`: a name a row.
pub(crate) struct Columns<'a> {
    pub(crate) truth: &'a [Column],
    pub(crate) prediction: &'a [Column],
    pub(crate) points: Option<&'a [&'a str]>,
}

impl Columns<'_> {
    /// Scores all rows, as [`score`] does.
    pub(crate) fn score(
        &self,
        plan: &MetricPlan,
        jobs: NonZeroUsize,
    ) -> Result<Evaluation, StudyError> {
        score(self, plan, jobs)
    }
}

impl Rows for Columns<'_> {
    fn rows(&self) -> usize {
        self.truth.first().map_or(0, Column::len)
    }

    fn batch(&self, plan: &MetricPlan, rows: Range<usize>) -> Result<Batch, StudyError> {
        let slice = |columns: &[Column]| {
            let slices = columns.iter().map(|column| column.slice(rows.clone()));
            slices.collect()
        };
        let points = self.points.map(|points| &points[rows.clone()]);
        Ok(Batch::from_columns(
            plan.channels().clone(),
            slice(self.truth),
            slice(self.prediction),
            points.map(|points| labels(points.iter().copied())),
        ))
    }
}
