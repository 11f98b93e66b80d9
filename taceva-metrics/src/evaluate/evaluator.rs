//! Evaluators, which take samples and return scores.

use std::fmt;

use taceva_core::{Batch, BatchBuilder, Channel, FieldSet, Sample, SampleSink, SinkError};

use crate::error::MetricError;
use crate::evaluate::accumulator::Accumulator;
use crate::evaluate::batch_clusters::{BatchClusters, SideBySide};
use crate::evaluate::entry::Entry;
use crate::evaluate::evaluation::Evaluation;
use crate::evaluate::number::Number;
use crate::evaluate::plan::MetricPlan;
use crate::evaluate::rows::Rows;
use crate::evaluate::state::State;

/// Number of rows that are buffered and then summed together. Their columns stay in the L1 cache.
const BATCH_ROWS: usize = 1024;
/// Number of pairs of one channel that are summed together: two columns of 32 KiB. In measurements from 1,024 to a million pairs, smaller blocks
/// cost allocations. Larger blocks cost page faults.
const PAIR_ROWS: usize = 4096;
/// Least number of accumulators with sums by contact point for which sorting a batch saves time.
const LEAST_TO_SORT: usize = 3;

/// Accepts samples, one by one or in batches, and computes the scores of a plan.
///
/// Threads and labs may each use an evaluator of the same plan. Merging these evaluators gives the scores of a single evaluator, bit for bit.
///
/// ```
/// use taceva_metrics::{Channel, Evaluator};
/// let mut left = Evaluator::of_channels([Channel::FZ])?;
/// let mut right = Evaluator::of_channels([Channel::FZ])?;
/// left.update_pairs(Channel::FZ, &[0.25], &[0.5])?;
/// right.update_pairs(Channel::FZ, &[0.5], &[0.5])?;
/// left.merge(right)?;
/// let scores = left.finish()?;
/// assert_eq!(scores.mae(Channel::FZ).and_then(|score| score.value.scalar()), Some(0.125));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Evaluator {
    plan: MetricPlan,
    accumulators: Vec<Accumulator>,
    builder: BatchBuilder,
}

impl Evaluator {
    /// An evaluator of `plan`, without samples.
    pub fn new(plan: &MetricPlan) -> Evaluator {
        Evaluator {
            plan: plan.clone(),
            accumulators: Accumulator::of_plan(plan),
            builder: BatchBuilder::new(plan.channels().clone(), plan.fields()),
        }
    }

    /// New evaluator of the same plan with every sample as its own cluster, as in [`MetricPlan::independent_samples`]. Call this method before the
    /// first update, because it drops earlier samples.
    ///
    /// ```
    /// use taceva_metrics::{Channel, Evaluator};
    /// let mut evaluator = Evaluator::of_channels([Channel::FZ])?.independent_samples();
    /// let truth = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0];
    /// evaluator.update_pairs(Channel::FZ, &truth, &[0.1, 1.2, 1.9, 3.3, 3.8, 5.2])?;
    /// let scores = evaluator.score()?;
    /// let mae = scores.mae(Channel::FZ).ok_or("no score")?;
    /// let method = mae.interval.method().ok_or("no interval")?;
    /// assert_eq!(method, "jackknife, samples taken as independent, G=6, logarithmic");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn independent_samples(self) -> Evaluator {
        Evaluator::new(&self.plan.independent_samples())
    }

    /// Plan of the evaluation.
    pub fn plan(&self) -> &MetricPlan {
        &self.plan
    }

    /// Adds the samples of `batch`.
    ///
    /// # Errors
    /// [`MetricError::Channels`] if the batch has other channels than the plan. Nothing is added then.
    pub fn update(&mut self, batch: &Batch) -> Result<(), MetricError> {
        let moved = batch.unwrapped(self.plan.constants());
        let batch = moved.as_ref().unwrap_or(batch);
        let seed = self.plan.seed();
        let by_point = self.accumulators.iter();
        let by_point = by_point.filter(|accumulator| accumulator.is_by_point());
        let sorted = match by_point.count() {
            ..LEAST_TO_SORT => None,
            _ => SideBySide::of(batch, seed),
        };
        let batch = sorted.as_ref().map_or(batch, |sorted| &sorted.batch);
        let clusters = match &sorted {
            Some(sorted) => sorted.clusters(seed),
            None => BatchClusters::new(batch, seed),
        };
        for accumulator in &mut self.accumulators {
            accumulator.update(batch, &clusters)?;
        }
        Ok(())
    }

    /// Adds `truth` and `prediction` of one channel, one number per sample, in the unit of the channel. Both may be slices, vectors,
    /// arrays, iterators or views of `f32` or `f64`. These samples have no value in other channels. For several channels or contact points
    /// use [`Rows`]. A pair with a NaN or an infinite number is left out and counted in [`n_invalid`](crate::Score::n_invalid).
    ///
    /// # Errors
    /// [`MetricError::Lengths`] if the lengths differ, [`MetricError::Channels`] if the plan lacks the channel. Nothing is added then,
    /// unless an iterator ends before its stated length.
    ///
    /// ```
    /// use taceva_metrics::{Channel, Evaluator};
    /// let mut evaluator = Evaluator::of_channels([Channel::FZ])?;
    /// evaluator.update_pairs(Channel::FZ, &[0.25_f32, 0.5], vec![0.5, 0.5])?;
    /// evaluator.update_pairs(Channel::FZ, (0..2).map(f64::from), [Some(0.0), None])?;
    /// assert_eq!(evaluator.score()?.mae(Channel::FZ).map(|score| score.n), Some(3));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn update_pairs<T: Number, P: Number>(
        &mut self,
        channel: Channel,
        truth: impl IntoIterator<Item = T>,
        prediction: impl IntoIterator<Item = P>,
    ) -> Result<(), MetricError> {
        let (mut truth, mut prediction) = (truth.into_iter(), prediction.into_iter());
        // Columns of equal length are added block by block: blocks stay in the L1 cache, and no full copy is made.
        if let Some(mut rows) = certain(&truth).filter(|rows| certain(&prediction) == Some(*rows)) {
            while rows > PAIR_ROWS {
                let truth = truth.by_ref().take(PAIR_ROWS);
                let prediction = prediction.by_ref().take(PAIR_ROWS);
                self.update_rows(Rows::new().pairs(channel, truth, prediction))?;
                rows -= PAIR_ROWS;
            }
        }
        self.update_rows(Rows::new().pairs(channel, truth, prediction))
    }

    /// Adds the samples of `rows`, which holds truth and prediction channel by channel.
    ///
    /// # Errors
    /// The errors of [`Rows::into_batch`]. Nothing is added then.
    ///
    /// ```
    /// use taceva_metrics::{Channel, Evaluator, Rows};
    /// let mut evaluator = Evaluator::of_channels([Channel::PX, Channel::PY])?;
    /// let rows = Rows::new().pairs(Channel::PX, &[0.0], &[3.0]).pairs(Channel::PY, &[0.0], &[4.0]);
    /// evaluator.update_rows(rows)?;
    /// let scores = evaluator.score()?;
    /// assert_eq!(scores.score("mae_euclid", "Pxy").and_then(|score| score.value.scalar()), Some(5.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn update_rows(&mut self, rows: Rows) -> Result<(), MetricError> {
        let batch = rows.into_batch(self.plan.channels())?;
        self.update(&batch)
    }

    /// Merges another evaluator of the same plan.
    ///
    /// # Errors
    /// [`MetricError`] if the other evaluator has another plan.
    pub fn merge(&mut self, other: Evaluator) -> Result<(), MetricError> {
        self.merge_states(&other.into_states()?)
    }

    /// Merges states that were saved elsewhere.
    ///
    /// # Errors
    /// [`MetricError`] if a state is malformed, or differs in schema, channels or parameters. Earlier states in the list stay merged.
    pub fn merge_states(&mut self, states: &[State]) -> Result<(), MetricError> {
        for state in states {
            let mut accumulators = self.accumulators.iter_mut();
            match accumulators.find(|accumulator| accumulator.reads(state.schema())) {
                Some(accumulator) => accumulator.merge(state)?,
                None => {
                    let known = self
                        .accumulators
                        .iter()
                        .map(|accumulator| accumulator.state());
                    let known: Vec<String> =
                        known.map(|state| format!("`{}`", state.schema())).collect();
                    return Err(MetricError::Schema {
                        expected: known.join(" or "),
                        found: state.schema().to_owned(),
                    });
                }
            }
        }
        Ok(())
    }

    /// Mergeable states of all added samples.
    ///
    /// # Errors
    /// The errors of [`update`](Evaluator::update), for samples still buffered.
    pub fn states(&mut self) -> Result<Vec<State>, MetricError> {
        self.flush()?;
        let accumulators = self.accumulators.iter();
        Ok(accumulators
            .map(|accumulator| accumulator.state())
            .collect())
    }

    /// Scores of all added samples. Further samples may follow.
    ///
    /// # Errors
    /// The errors of [`update`](Evaluator::update), for samples still buffered.
    ///
    /// ```
    /// use taceva_metrics::{Channel, Evaluator};
    /// let mut evaluator = Evaluator::of_channels([Channel::FZ])?;
    /// let mut running = Vec::new();
    /// for prediction in [0.5, 0.25] {
    ///     evaluator.update_pairs(Channel::FZ, [0.0], [prediction])?;
    ///     running.push(evaluator.score()?.mae(Channel::FZ).and_then(|score| score.value.scalar()));
    /// }
    /// assert_eq!(running, [Some(0.5), Some(0.375)]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn score(&self) -> Result<Evaluation, MetricError> {
        if self.builder.rows() == 0 {
            return Ok(self.scored());
        }
        let mut with_collected = Evaluator::new(&self.plan);
        let accumulators = self.accumulators.iter();
        let states: Vec<State> = accumulators
            .map(|accumulator| accumulator.state())
            .collect();
        with_collected.merge_states(&states)?;
        with_collected.update(self.builder.so_far())?;
        Ok(with_collected.scored())
    }

    /// Scores of all added samples. Consumes the evaluator.
    ///
    /// # Errors
    /// The errors of [`update`](Evaluator::update), for samples still buffered.
    pub fn finish(mut self) -> Result<Evaluation, MetricError> {
        self.flush()?;
        Ok(self.scored())
    }

    /// Scores of the summed samples, without the buffered samples.
    fn scored(&self) -> Evaluation {
        let accumulators = self.accumulators.iter();
        let entries = accumulators.flat_map(|accumulator| accumulator.scores(self.plan.kept()));
        let mut entries: Vec<Entry> = entries.collect();
        let rank = |entry: &Entry| {
            let kept = self.plan.kept().iter();
            kept.take_while(|metric| metric.id != entry.metric.id)
                .count()
        };
        entries.sort_by_key(rank);
        Evaluation::new(entries, self.plan.skipped().to_vec())
    }

    fn into_states(mut self) -> Result<Vec<State>, MetricError> {
        self.states()
    }

    fn flush(&mut self) -> Result<(), MetricError> {
        if self.builder.rows() == 0 {
            return Ok(());
        }
        let batch = self.builder.take();
        self.update(&batch)
    }
}

/// Number of items of an iterator; `None` if the iterator does not know this number exactly.
fn certain(items: &impl Iterator) -> Option<usize> {
    let (least, most) = items.size_hint();
    most.filter(|most| *most == least)
}

impl SampleSink for Evaluator {
    fn fields(&self) -> FieldSet {
        self.plan.fields()
    }

    fn accept(&mut self, sample: &Sample) -> Result<(), SinkError> {
        self.builder.push(sample);
        if self.builder.rows() >= BATCH_ROWS {
            self.flush()?;
        }
        Ok(())
    }
}

impl fmt::Debug for Evaluator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Evaluator")
            .field("plan", &self.plan)
            .finish_non_exhaustive()
    }
}
