//! The accumulator of any family of sums that are kept apart by contact location.

use std::borrow::Borrow;
use std::collections::BTreeMap;

use taceva_core::{Batch, Channels, Unit};

use super::Accumulator;
use crate::clusters::{Clustering, Clusters};
use crate::error::MetricError;
use crate::merge::Merge;
use crate::metric::{Finish, Metric};
use crate::plan::MetricPlan;
use crate::score::{Interval, Score};
use crate::state::{Record, Shape, State, describe, written};
use crate::stats::IntervalMethod;
use crate::stats::jackknife::{self, LeftOut};
use crate::value::{InapplicableReason, UndefinedReason, Value};

/// What is kept of a batch, and which scores come of it.
pub(crate) trait Family: Send {
    /// What is kept of one channel or plane.
    type Sums: Merge + Clone + Send;
    /// The name and version of its states.
    const SCHEMA: &'static str;

    /// What must agree before states merge.
    fn parameters(&self) -> BTreeMap<String, String>;
    /// Nothing kept, for each channel or plane.
    fn empty(&self) -> Vec<Self::Sums>;
    /// Adds `rows` of `batch`, all of them for `None`.
    fn deposit(&mut self, sums: &mut [Self::Sums], batch: &Batch, rows: Option<&[u32]>);
    /// Samples left out.
    fn invalid(sums: &Self::Sums) -> u64;
    /// As a state holds it.
    fn to_record(&self, sums: &Self::Sums) -> Record;
    /// Back from a state, for the channel or plane at `position`.
    fn read_record(&self, position: usize, record: &Record) -> Result<Self::Sums, String>;
    /// The scores to give.
    fn outputs(&self) -> &[Output];
    /// How `metric` is finished, if it belongs here.
    fn finish(metric: &Metric) -> Option<&Finish<Self::Sums>>;
    /// Why `metric` has no value in `unit`, if so.
    fn inapplicable(metric: &Metric, unit: Unit) -> Option<InapplicableReason>;
}

/// One score of a metric: of a channel or plane, or the mean of two.
#[derive(Clone, Debug)]
pub(crate) struct Output {
    /// What it is called in reports.
    pub(crate) label: String,
    /// The unit of its channels.
    pub(crate) unit: Unit,
    /// Its channels, if it is not one channel's own.
    pub(crate) of: Vec<String>,
    /// Which sums it is finished from; the value is the mean over them.
    pub(crate) parts: Vec<usize>,
}

/// An accumulator of `F`, by contact location.
pub(crate) struct Clustered<F: Family> {
    family: F,
    channels: Channels,
    clustering: Clustering<Vec<F::Sums>>,
    clusters: Clusters<Vec<F::Sums>>,
    interval_method: IntervalMethod,
}

impl<F: Family> Clustered<F> {
    pub(crate) fn new(family: F, plan: &MetricPlan) -> Clustered<F> {
        let clustering = Clustering {
            empty: family.empty(),
            seed: plan.seed(),
        };
        Clustered {
            family,
            channels: plan.channels().clone(),
            clustering,
            clusters: Clusters::default(),
            interval_method: plan.interval_method(),
        }
    }

    fn shape(&self) -> Shape {
        let mut parameters = self.family.parameters();
        parameters.insert("seed".to_owned(), self.clustering.seed.to_string());
        Shape {
            schema: F::SCHEMA,
            parameters,
            channels: written(&self.channels),
        }
    }

    fn score(
        &self,
        metric: &'static Metric,
        finish: &Finish<F::Sums>,
        output: &Output,
        total: &[F::Sums],
    ) -> Score {
        let parts = || output.parts.iter().map(|&part| &total[part]);
        let value = match F::inapplicable(metric, output.unit) {
            Some(reason) => Value::NotApplicable(reason),
            None => mean_of_parts(finish, parts()).into(),
        };
        Score {
            value,
            unit: metric.unit.of(output.unit),
            n: parts().map(finish.count).min().unwrap_or_default(),
            n_invalid: parts().map(F::invalid).max().unwrap_or_default(),
            interval: match value {
                Value::Scalar(value) => self.interval(value, finish, output, total),
                Value::Undefined(reason) => Interval::Undefined(reason),
                Value::NotApplicable(_) => Interval::Undefined(UndefinedReason::Empty),
            },
            definition: metric.definition,
            parameters: (metric.constants)(output.unit),
            of: output.of.clone(),
        }
    }

    fn interval(
        &self,
        value: f64,
        finish: &Finish<F::Sums>,
        output: &Output,
        total: &[F::Sums],
    ) -> Interval {
        let Some(cells) = self.clusters.cells() else {
            return Interval::Undefined(UndefinedReason::NoClusters);
        };
        let samples = |cell: &[F::Sums]| {
            let counts = output.parts.iter().map(|&part| (finish.count)(&cell[part]));
            counts.fold(0, u64::saturating_add)
        };
        let (keys, cells): (Vec<u64>, Vec<&Vec<F::Sums>>) = cells
            .into_iter()
            .filter(|(_, cell)| samples(cell) > 0)
            .unzip();
        match self.interval_method {
            IntervalMethod::Jackknife => {
                let left_out = cells.iter().map(|cell| {
                    let others = output.parts.iter().map(|&part| {
                        let mut others = total[part].clone();
                        others.subtract(&cell[part]);
                        others
                    });
                    LeftOut {
                        count: samples(cell),
                        value: mean_of_parts(finish, others),
                    }
                });
                jackknife::interval(value, &left_out.collect::<Vec<_>>())
            }
            IntervalMethod::PoissonBootstrap(bootstrap) => {
                bootstrap.interval(value, &keys, |weights| {
                    let resampled = output.parts.iter().map(|&part| {
                        let mut sums = self.clustering.empty[part].clone();
                        for (cell, &weight) in cells.iter().zip(weights) {
                            sums.merge_times(&cell[part], weight);
                        }
                        sums
                    });
                    mean_of_parts(finish, resampled)
                })
            }
        }
    }
}

impl<F: Family> Accumulator for Clustered<F> {
    fn update(&mut self, batch: &Batch) -> Result<(), MetricError> {
        if batch.channels() != &self.channels {
            return Err(MetricError::Channels {
                expected: describe(&written(&self.channels)),
                found: describe(&written(batch.channels())),
            });
        }
        let family = &mut self.family;
        self.clustering
            .deposit(&mut self.clusters, batch, |sums, rows| {
                family.deposit(sums, batch, rows);
            });
        Ok(())
    }

    fn state(&self) -> State {
        let Shape {
            schema,
            parameters,
            channels,
        } = self.shape();
        let records = |sums: &Vec<F::Sums>| {
            let records = sums.iter().map(|sums| self.family.to_record(sums));
            Ok::<_, std::convert::Infallible>(records.collect())
        };
        let clusters = match self.clusters.try_map(records) {
            Ok(clusters) => clusters,
            Err(never) => match never {},
        };
        State {
            schema: schema.to_owned(),
            parameters,
            channels,
            clusters,
        }
    }

    fn reads(&self, schema: &str) -> bool {
        schema == F::SCHEMA
    }

    fn merge(&mut self, state: &State) -> Result<(), MetricError> {
        state.check(&self.shape())?;
        let malformed = |what| MetricError::Malformed {
            schema: F::SCHEMA,
            what,
        };
        let clusters = state.clusters.try_map(|records| {
            let expected = self.clustering.empty.len();
            if records.len() != expected {
                let found = records.len();
                return Err(malformed(format!("{found} records, expected {expected}")));
            }
            let sums = records.iter().enumerate();
            sums.map(|(position, record)| self.family.read_record(position, record))
                .collect::<Result<Vec<_>, _>>()
                .map_err(malformed)
        })?;
        self.clustering.merge(&mut self.clusters, &clusters);
        Ok(())
    }

    fn scores(&self, metric: &'static Metric) -> Vec<(String, Score)> {
        let Some(finish) = F::finish(metric) else {
            return Vec::new();
        };
        let total = self.clustering.total(&self.clusters);
        let outputs = self.family.outputs().iter();
        outputs
            .map(|output| {
                let score = self.score(metric, finish, output, &total);
                (output.label.clone(), score)
            })
            .collect()
    }
}

/// RN of the exact mean of one or two values.
fn mean_of_parts<S>(
    finish: &Finish<S>,
    mut parts: impl Iterator<Item = impl Borrow<S>>,
) -> Result<f64, UndefinedReason> {
    let first = finish.value(parts.next().ok_or(UndefinedReason::Empty)?.borrow())?;
    match parts.next() {
        Some(second) => Ok(midpoint(first, finish.value(second.borrow())?)),
        None => Ok(first),
    }
}

/// RN((a + b) / 2): halving is exact unless the sum is tiny, and then the sum is; where the sum overflows, halves are exact.
fn midpoint(left: f64, right: f64) -> f64 {
    let sum = left + right;
    if sum.is_finite() {
        sum * 0.5
    } else {
        left * 0.5 + right * 0.5
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_of_two_is_rounded_once_at_both_ends_of_the_range() {
        let denormal = f64::from_bits;
        assert_eq!(midpoint(denormal(1), denormal(2)).to_bits(), 2);
        assert_eq!(midpoint(f64::MAX, f64::MAX).to_bits(), f64::MAX.to_bits());
        assert_eq!(midpoint(1.0, 2.0).to_bits(), 1.5_f64.to_bits());
    }
}
