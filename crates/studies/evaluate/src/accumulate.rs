//! Accumulates rows into scores on all threads. The result has the same bits for any number of threads.

use std::num::NonZeroUsize;
use std::ops::Range;

use taceva_core::{Batch, Column, Field, Labels};
use taceva_dataset::Dataset;
use taceva_dataset::internal::each_part;
use taceva_metrics::{ClusteredBy, Evaluator, Metric, MetricPlan};

use crate::error::EvaluateError;
use crate::recordings;

/// Number of rows in a batch: large enough that merging is rare, small enough that a batch fits into the cache.
pub(crate) const BATCH_ROWS: usize = 1 << 12;

/// Name of the metric of frame rate and field of view. The sensor reaches its full frame rate only at rest without contact. The metric therefore
/// reads times only from the phase of the same name, and all other fields from every row.
pub const OF_SENSOR: &str = "intrinsic";

/// Source of rows with truth and prediction. Any thread may read any range.
pub trait Rows: Sync {
    /// Number of rows.
    fn rows(&self) -> usize;

    /// Rows in the range `rows`, with the channels of the plan.
    ///
    /// # Errors
    /// [`EvaluateError`] if a row cannot be read.
    fn batch(&self, plan: &MetricPlan, rows: Range<usize>) -> Result<Batch, EvaluateError>;
}

/// Accumulates all rows of `source`. Each thread takes a contiguous block. Sums are exact, so the blocks do not affect the result.
///
/// Blocks consist of whole batches. The first batch with an error is therefore the same for any number of threads.
///
/// # Errors
/// [`EvaluateError`] of the first batch that cannot be read or scored.
pub fn accumulate(
    source: &impl Rows,
    plan: &MetricPlan,
    jobs: NonZeroUsize,
) -> Result<Evaluator, EvaluateError> {
    let rows = source.rows();
    let block = rows.div_ceil(jobs.get()).next_multiple_of(BATCH_ROWS);
    let blocks: Vec<Range<usize>> = (0..rows)
        .step_by(block.max(BATCH_ROWS))
        .map(|start| start..rows.min(start + block))
        .collect();
    let evaluators = each_part(blocks, |block| accumulate_block(source, plan, block));
    let mut total = Evaluator::new(plan);
    for evaluator in evaluators {
        total.merge(evaluator?)?;
    }
    Ok(total)
}

fn accumulate_block(
    source: &impl Rows,
    plan: &MetricPlan,
    rows: Range<usize>,
) -> Result<Evaluator, EvaluateError> {
    let mut evaluator = Evaluator::new(plan);
    for start in rows.clone().step_by(BATCH_ROWS) {
        let end = rows.end.min(start + BATCH_ROWS);
        evaluator.update(&source.batch(plan, start..end)?)?;
    }
    Ok(evaluator)
}

/// The plan restricted to `metrics`. Sums computed by it can be merged with sums of the whole plan.
///
/// # Errors
/// [`EvaluateError::Scores`] for an unusable constant or setting.
pub(crate) fn restricted(
    plan: &MetricPlan,
    metrics: &[&'static Metric],
) -> Result<MetricPlan, EvaluateError> {
    let restricted = MetricPlan::new(metrics, plan.channels().clone(), plan.available())
        .with_facts(plan.facts().clone())
        .with_seed(plan.seed())
        .with_interval_method(plan.interval_method())
        .with_constants(plan.constants().clone())?
        .with_settings(*plan.settings())?;
    Ok(match plan.clustered_by() {
        ClusteredBy::Recording => restricted.by_recording(),
        ClusteredBy::Group => restricted.by_group(),
        ClusteredBy::Sample => restricted.independent_samples(),
        _ => restricted,
    })
}

/// True if `metric` reads only the truth, and therefore every row of a recording.
pub(crate) fn reads_no_prediction(metric: &Metric) -> bool {
    let fields = metric.needs.fields;
    !fields.contains(Field::Prediction) && !fields.contains(Field::PredictedSpacing)
}

/// Truth and predictions in memory, column by column. The other fields of the rows are read from the dataset.
///
/// # Shapes
/// One column for each channel of the plan, each as long as `rows`.
pub struct Columns<'a> {
    /// Columns of the truth.
    pub truth: &'a [Column],
    /// Columns of the predictions.
    pub prediction: &'a [Column],
    /// Recording that contains the rows.
    pub dataset: &'a Dataset,
    /// Row numbers in the recording.
    pub rows: &'a [usize],
    /// Group of every row of the recording, for confidence intervals by group; `None` for other intervals.
    pub groups: Option<&'a [String]>,
}

impl Rows for Columns<'_> {
    fn rows(&self) -> usize {
        self.rows.len()
    }

    fn batch(&self, plan: &MetricPlan, rows: Range<usize>) -> Result<Batch, EvaluateError> {
        let slice = |columns: &[Column]| {
            let slices = columns.iter().map(|column| column.slice(rows.clone()));
            slices.collect()
        };
        let table = self.dataset.table();
        let of_table = || self.rows[rows.clone()].iter().copied();
        let wanted = plan.fields();
        let points = wanted
            .contains(Field::Point)
            .then(|| table.labels(Field::Point, of_table()))
            .flatten();
        let channels = plan.channels().clone();
        let mut batch =
            Batch::from_columns(channels, slice(self.truth), slice(self.prediction), points);
        if plan.clustered_by() == ClusteredBy::Recording {
            batch = batch.with_recordings(recordings::labels(self.dataset, of_table()));
        }
        if plan.clustered_by() == ClusteredBy::Sample {
            let mut labels = Labels::default();
            of_table().for_each(|row| labels.push(&table.samples()[row]));
            batch = batch.with_samples(labels);
        }
        if let (ClusteredBy::Group, Some(groups)) = (plan.clustered_by(), self.groups) {
            // The labels contain the recording, so that blocks of several shards stay distinct.
            let recording = self.dataset.digest().to_string();
            let mut labels = Labels::default();
            of_table().for_each(|row| labels.push(&format!("{recording} {}", groups[row])));
            batch = batch.with_recordings(labels);
        }
        for field in wanted.iter().filter(|field| *field != Field::Point) {
            if let Some(labels) = table.labels(field, of_table()) {
                batch = batch.with_labels(field, labels);
            } else if let Some(numbers) = table.numbers(field, of_table()) {
                batch = batch.with_numbers(field, numbers);
            }
        }
        Ok(batch)
    }
}
