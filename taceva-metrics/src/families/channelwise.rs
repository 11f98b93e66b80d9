//! Interface of metric families that keep the same sums for each channel.

use std::collections::BTreeMap;

use taceva_core::{Batch, Channel};

use crate::evaluate::family::{Details, Family, Intervals, Numbers, Output, each_row};
use crate::evaluate::metric::Metric;
use crate::evaluate::plan::MetricPlan;
use crate::exact::merge::Merge;
use crate::exact::record::Record;
use crate::families::accuracy::outputs;
use crate::pair::Paired;
use crate::score::value::InapplicableReason;

/// Metric family that keeps separate sums for each channel.
pub(crate) trait Channelwise: Send + 'static {
    /// Sums of one channel. The default value has no samples.
    type Sums: Merge + Clone + Default + Send + 'static;

    /// Parameters by name. States with different parameters cannot be merged.
    fn parameters(&self) -> BTreeMap<String, String> {
        BTreeMap::new()
    }
    /// True if the family includes `channel`.
    fn takes(&self, _channel: &Channel) -> bool {
        true
    }
    /// Adds `rows` of `batch`, or all rows for `None`, to the sums of the channel at index `position`.
    fn deposit(
        &mut self,
        sums: &mut Self::Sums,
        batch: &Batch,
        position: usize,
        rows: Option<&[u32]>,
    );
    /// Converts the sums to a record for a saved state.
    fn to_record(&self, sums: &Self::Sums) -> Record;
    /// Reads the sums from a record of a saved state.
    fn read_record(&self, record: &Record) -> Result<Self::Sums, String>;
    /// Number of samples in the sums.
    fn count(&self, sums: &Self::Sums) -> u64;
    /// Number of samples skipped for an unusable value.
    fn invalid(&self, sums: &Self::Sums) -> u64;
    /// Value and variants of `metric` for one channel.
    fn numbers(&self, metric: &Metric, output: &Output, sums: &Self::Sums) -> Numbers;
    /// Value and variants of `metric` for a resample, as in [`Family::resampled`].
    fn resampled(&self, metric: &Metric, output: &Output, sums: &Self::Sums) -> Numbers {
        self.numbers(metric, output, sums)
    }
    /// Intervals of `metric`, as in [`Family::intervals`]. The last argument has the sums of every cluster, for each channel of the output.
    fn intervals(
        &self,
        _metric: &Metric,
        _output: &Output,
        _clusters: &[Vec<&Self::Sums>],
    ) -> Option<Intervals> {
        None
    }
    /// Reason why the metric does not apply to the output; `None` if it applies.
    fn inapplicable(&self, _output: &Output) -> Option<InapplicableReason> {
        None
    }
    /// Parts of a score besides its numbers, such as curves, counts and flags.
    fn details(&self, _metric: &Metric, _output: &Output, _parts: &[&Self::Sums]) -> Details {
        Details::default()
    }
}

/// Turns a [`Channelwise`] kind into a family of scores for channels and planes. The score of a plane is the mean over its two axes.
pub(crate) struct ByChannel<K> {
    kind: K,
    positions: Vec<usize>,
    outputs: Vec<Output>,
}

impl<K: Channelwise> ByChannel<K> {
    /// Creates the family for the channels of `plan` that `kind` takes.
    pub(crate) fn new(kind: K, plan: &MetricPlan) -> ByChannel<K> {
        let channels = plan.channels().iter().enumerate();
        let positions: Vec<usize> = channels
            .filter(|(_, channel)| kind.takes(channel))
            .map(|(position, _)| position)
            .collect();
        let outputs = outputs(plan.channels()).into_iter();
        let outputs = outputs.filter_map(|output| {
            let part = |of: &usize| positions.iter().position(|position| position == of);
            let parts = output.parts.iter().map(part).collect::<Option<Vec<_>>>()?;
            Some(Output { parts, ..output })
        });
        ByChannel {
            outputs: outputs.collect(),
            kind,
            positions,
        }
    }
}

impl<K: Channelwise> Family for ByChannel<K> {
    type Sums = K::Sums;

    fn parameters(&self) -> BTreeMap<String, String> {
        self.kind.parameters()
    }

    fn empty(&self) -> Vec<K::Sums> {
        vec![K::Sums::default(); self.positions.len()]
    }

    fn deposit(&mut self, sums: &mut [K::Sums], batch: &Batch, rows: Option<&[u32]>) {
        for (sums, &position) in sums.iter_mut().zip(&self.positions) {
            self.kind.deposit(sums, batch, position, rows);
        }
    }

    fn to_record(&self, sums: &K::Sums) -> Record {
        self.kind.to_record(sums)
    }

    fn read_record(&self, _position: usize, record: &Record) -> Result<K::Sums, String> {
        self.kind.read_record(record)
    }

    fn outputs(&self, _metric: &Metric) -> Vec<Output> {
        self.outputs.clone()
    }

    fn count(&self, _metric: &Metric, sums: &K::Sums) -> u64 {
        self.kind.count(sums)
    }

    fn invalid(&self, sums: &K::Sums) -> u64 {
        self.kind.invalid(sums)
    }

    fn numbers(&self, metric: &Metric, output: &Output, sums: &K::Sums) -> Numbers {
        self.kind.numbers(metric, output, sums)
    }

    fn resampled(&self, metric: &Metric, output: &Output, sums: &K::Sums) -> Numbers {
        self.kind.resampled(metric, output, sums)
    }

    fn intervals(
        &self,
        metric: &Metric,
        output: &Output,
        clusters: &[&Vec<K::Sums>],
    ) -> Option<Intervals> {
        let of_part = |part: &usize| clusters.iter().map(|sums| &sums[*part]).collect();
        let parts: Vec<Vec<&K::Sums>> = output.parts.iter().map(of_part).collect();
        self.kind.intervals(metric, output, &parts)
    }

    fn inapplicable(&self, _metric: &Metric, output: &Output) -> Option<InapplicableReason> {
        self.kind.inapplicable(output)
    }

    fn details(&self, metric: &Metric, output: &Output, parts: &[&K::Sums]) -> Details {
        self.kind.details(metric, output, parts)
    }
}

/// Calls `add` with the row and the pair of channel `position`, for each of `rows` that has prediction and truth.
pub(crate) fn each_pair(
    batch: &Batch,
    position: usize,
    rows: Option<&[u32]>,
    mut add: impl FnMut(usize, Paired<f64>),
) {
    let (estimates, references) = (batch.prediction(position), batch.truth(position));
    each_row(batch, rows, |row| {
        if let (Some(estimate), Some(reference)) = (estimates.get(row), references.get(row)) {
            let pair = Paired {
                estimate,
                reference,
            };
            add(row, pair);
        }
    });
}
