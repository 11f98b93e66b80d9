//! What takes samples in and gives scores out; metrics that are finished from the same sums share one.

mod clustered;
mod resampling;

pub(crate) use clustered::Clustered;

use taceva_core::Batch;

use crate::error::MetricError;
use crate::evaluate::evaluation::Entry;
use crate::evaluate::state::State;
use crate::metric::Metric;

/// Keeps what the metrics of one family are finished from.
///
/// # Laws
/// Any order, split and merge of the same samples gives equal states and, bit for bit, equal scores; the state of nothing
/// changes nothing.
pub(crate) trait Accumulator: Send {
    /// Takes in the samples of `batch`.
    fn update(&mut self, batch: &Batch) -> Result<(), MetricError>;

    /// What is kept so far.
    fn state(&self) -> State;

    /// Whether states of `schema` are its own.
    fn reads(&self, schema: &str) -> bool;

    /// Takes over what another one kept.
    fn merge(&mut self, state: &State) -> Result<(), MetricError>;

    /// The scores of those of `metrics` that are finished from what is kept here, metric by metric.
    fn scores(&self, metrics: &[&'static Metric]) -> Vec<Entry>;
}
