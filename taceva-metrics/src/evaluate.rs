//! Samples in, scores out.

use std::fmt;

use taceva_core::{Batch, BatchBuilder, FieldSet, Sample, SampleSink, SinkError};

use crate::accumulator::Accumulator;
use crate::error::MetricError;
use crate::evaluation::{Entry, Evaluation};
use crate::plan::MetricPlan;
use crate::state::State;

/// Samples that are collected before they are summed: small enough for the columns to stay in the fastest cache.
const BATCH_ROWS: usize = 1024;

/// Takes samples, one by one or in batches, and finishes a plan's scores.
///
/// Threads and labs may each have one of the same plan; merging them gives what one alone would have given, bit for bit.
pub struct Evaluator {
    plan: MetricPlan,
    accumulators: Vec<Box<dyn Accumulator>>,
    builder: BatchBuilder,
}

impl Evaluator {
    /// An evaluator that has seen nothing.
    pub fn new(plan: &MetricPlan) -> Evaluator {
        Evaluator {
            plan: plan.clone(),
            accumulators: plan.accumulators(),
            builder: BatchBuilder::new(plan.channels().clone(), plan.fields()),
        }
    }

    /// What is computed.
    pub fn plan(&self) -> &MetricPlan {
        &self.plan
    }

    /// Takes in the samples of `batch`.
    ///
    /// # Errors
    /// [`MetricError::Channels`] if they are of other channels than the plan's; nothing is taken in then.
    pub fn update(&mut self, batch: &Batch) -> Result<(), MetricError> {
        for accumulator in &mut self.accumulators {
            accumulator.update(batch)?;
        }
        Ok(())
    }

    /// Takes over what another evaluator of the same plan has seen.
    ///
    /// # Errors
    /// [`MetricError`] if its plan was another.
    pub fn merge(&mut self, other: Evaluator) -> Result<(), MetricError> {
        self.merge_states(&other.into_states()?)
    }

    /// Takes over what was kept elsewhere.
    ///
    /// # Errors
    /// [`MetricError`] if a state is of another schema, other channels or other parameters, or broken; those before it are
    /// taken over.
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

    /// All that was seen, as data that merges.
    ///
    /// # Errors
    /// As [`update`](Evaluator::update), for samples still collected.
    pub fn states(&mut self) -> Result<Vec<State>, MetricError> {
        self.flush()?;
        let accumulators = self.accumulators.iter();
        Ok(accumulators
            .map(|accumulator| accumulator.state())
            .collect())
    }

    /// The scores.
    ///
    /// # Errors
    /// As [`update`](Evaluator::update), for samples still collected.
    pub fn finish(mut self) -> Result<Evaluation, MetricError> {
        self.flush()?;
        let accumulators = self.accumulators.iter();
        let entries = accumulators.flat_map(|accumulator| accumulator.scores(self.plan.kept()));
        let mut entries: Vec<Entry> = entries.collect();
        let rank = |entry: &Entry| {
            let kept = self.plan.kept().iter();
            kept.take_while(|metric| metric.id != entry.metric.id)
                .count()
        };
        entries.sort_by_key(rank);
        Ok(Evaluation::new(entries, self.plan.skipped().to_vec()))
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
