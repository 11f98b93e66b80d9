//! Parallel evaluation on a rayon pool.

use rayon::iter::{IntoParallelIterator, ParallelIterator};
use taceva_core::Batch;

use crate::error::MetricError;
use crate::evaluate::evaluator::Evaluator;
use crate::evaluate::plan::MetricPlan;

impl Evaluator {
    /// Evaluator with the samples of `batches`, summed by all threads of the current rayon pool.
    ///
    /// Sums are exact, so any number of threads gives the same result, bit for bit.
    ///
    /// ```
    /// use taceva_metrics::{Batch, Channel, Channels, Column, Evaluator, FieldSet, MetricPlan, catalogue};
    /// let channels = Channels::new([Channel::FZ])?;
    /// let plan = MetricPlan::new(&catalogue::select(["mae"])?, channels.clone(), FieldSet::PAIRS);
    /// let batch = |truth: f64| {
    ///     let column = |value| vec![Column::full(vec![value])];
    ///     Batch::from_columns(channels.clone(), column(truth), column(0.0), None)
    /// };
    /// let batches: Vec<Batch> = [0.25, 0.75].map(batch).into();
    /// let evaluation = Evaluator::of_batches(&plan, batches)?.finish()?;
    /// let mae = evaluation.score("mae", "Fz").and_then(|score| score.value.scalar());
    /// assert_eq!(mae, Some(0.5));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`update`](Evaluator::update).
    pub fn of_batches(
        plan: &MetricPlan,
        batches: impl IntoParallelIterator<Item = Batch>,
    ) -> Result<Evaluator, MetricError> {
        let empty = || Evaluator::new(plan);
        batches
            .into_par_iter()
            .try_fold(empty, |mut evaluator, batch| {
                evaluator.update(&batch)?;
                Ok(evaluator)
            })
            .try_reduce(empty, |mut left, right| {
                left.merge(right)?;
                Ok(left)
            })
    }
}
