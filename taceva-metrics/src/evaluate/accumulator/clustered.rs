//! The accumulator of any family of sums that are kept apart by contact location.

use std::borrow::Cow;

use taceva_core::{Batch, Channels};

use super::Accumulator;
use super::resampling::{Cell, Resampling, each_left_out};
use crate::error::MetricError;
use crate::evaluate::evaluation::Entry;
use crate::evaluate::independent::rows_as_clusters;
use crate::evaluate::plan::MetricPlan;
use crate::evaluate::state::{Shape, State, describe, written};
use crate::families::family::{Details, Family, Numbers, Output};
use crate::metric::Metric;
use crate::score::standing::Standing;
use crate::score::value::{UndefinedReason, Value};
use crate::score::{Interval, Score, Variant};
use crate::stats::IntervalMethod;
use crate::stats::clusters::{Clustering, Clusters};

/// An accumulator of `F`, by contact location.
pub(crate) struct Clustered<F: Family> {
    family: F,
    channels: Channels,
    clustering: Clustering<Vec<F::Sums>>,
    clusters: Clusters<Vec<F::Sums>>,
    interval_method: IntervalMethod,
    rows_as_clusters: bool,
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
            rows_as_clusters: false,
        }
    }

    /// The same accumulator; where `rows_as_clusters`, each row is a cluster of its own.
    pub(crate) fn with_rows_as_clusters(self, rows_as_clusters: bool) -> Clustered<F> {
        Clustered {
            rows_as_clusters,
            ..self
        }
    }

    fn shape(&self) -> Shape {
        let mut parameters = self.family.parameters();
        parameters.insert("seed".to_owned(), self.clustering.seed.to_string());
        if self.rows_as_clusters {
            parameters.insert("clusters".to_owned(), "samples".to_owned());
        }
        Shape {
            schema: F::SCHEMA,
            parameters,
            channels: written(&self.channels),
        }
    }

    /// The numbers of an output: one part's, the mean of two, or what the family makes of them.
    fn numbers(&self, metric: &Metric, output: &Output, sums: &[F::Sums]) -> Numbers {
        if let Some(numbers) = self.family.joint(metric, output, sums) {
            return numbers;
        }
        let mut parts = output.parts.iter();
        let mut next = || {
            let part = parts.next()?;
            Some(self.family.numbers(metric, output, &sums[*part]))
        };
        let first = next().unwrap_or_else(|| Numbers::of(Err(UndefinedReason::Empty)));
        match next() {
            Some(second) => first.mean(&second),
            None => first,
        }
    }

    /// Samples of a cluster that take part in an output.
    fn samples(&self, metric: &Metric, output: &Output, sums: &[F::Sums]) -> u64 {
        let parts = output.parts.iter();
        let counts = parts.map(|&part| self.family.count(metric, &sums[part]));
        counts.fold(0, u64::saturating_add)
    }

    /// Every score of `metrics`, without intervals.
    fn requests(&self, metrics: &[&'static Metric], total: &[F::Sums]) -> Vec<Request> {
        let mut requests = Vec::new();
        for &metric in metrics {
            for output in self.family.outputs(metric) {
                let numbers = self.numbers(metric, &output, total);
                requests.push(Request {
                    resampling: Resampling::new(&numbers, metric.range),
                    metric,
                    output,
                    numbers,
                });
            }
        }
        requests
    }

    /// Finishes every score again with clusters left out or weighted.
    fn resample(&self, requests: &mut [Request], cells: &[Cell<'_, F::Sums>]) {
        match self.interval_method {
            IntervalMethod::Jackknife => {
                each_left_out(&self.clustering.empty, cells, |cell, others| {
                    for request in &mut *requests {
                        let count = self.samples(request.metric, &request.output, cell);
                        if count > 0 {
                            let numbers = self.numbers(request.metric, &request.output, others);
                            request.resampling.leave_out(count, &numbers);
                        }
                    }
                });
            }
            IntervalMethod::PoissonBootstrap(bootstrap) => {
                for request in requests {
                    let (metric, output) = (request.metric, &request.output);
                    let cells: Vec<Cell<'_, F::Sums>> = cells
                        .iter()
                        .copied()
                        .filter(|(_, cell)| self.samples(metric, output, cell) > 0)
                        .collect();
                    let finish = |sums: &[F::Sums]| self.numbers(metric, output, sums);
                    let counts = cells.iter();
                    let counts = counts.map(|(_, cell)| self.samples(metric, output, cell));
                    let total = (&request.numbers, counts.fold(0, u64::saturating_add));
                    let (empty, resampling) = (&self.clustering.empty, &mut request.resampling);
                    resampling.weigh(bootstrap, empty, &cells, total, finish);
                }
            }
        }
    }

    fn score(
        &self,
        request: Request,
        total: &[F::Sums],
        cells: Option<&[Cell<'_, F::Sums>]>,
    ) -> Score {
        let Request {
            metric,
            output,
            numbers,
            resampling,
        } = request;
        let parts: Vec<&F::Sums> = output.parts.iter().map(|&part| &total[part]).collect();
        let (value, details) = match self.family.inapplicable(metric, &output) {
            Some(reason) => (Value::NotApplicable(reason), Details::default()),
            None => (
                numbers.value.into(),
                self.family.details(metric, &output, &parts),
            ),
        };
        let own = match (self.interval_method, cells) {
            (IntervalMethod::Jackknife, Some(cells)) => {
                let cells: Vec<&Vec<F::Sums>> = cells.iter().map(|(_, cell)| *cell).collect();
                self.family.intervals(metric, &output, &cells)
            }
            _ => None,
        };
        let of_value = |value: &Value, name: Option<&str>| match value {
            Value::Undefined(reason) => Interval::Undefined(*reason),
            Value::Scalar(_) if cells.is_none() => Interval::Undefined(self.family.unclustered()),
            Value::Scalar(value) => match (&own, name) {
                (Some(own), None) => own.value,
                (Some(own), Some(name)) if own.variants.contains_key(name) => own.variants[name],
                _ => resampling.interval(*value, name),
            },
            _ => Interval::Undefined(UndefinedReason::Empty),
        };
        let interval = |value: &Value, name: Option<&str>| match self.rows_as_clusters {
            true => of_value(value, name).of_independent_samples(),
            false => of_value(value, name),
        };
        let n = parts.iter().map(|sums| self.family.count(metric, sums));
        let n_invalid = parts.iter().map(|sums| self.family.invalid(sums));
        let mut variants = Vec::new();
        if !matches!(value, Value::NotApplicable(_)) {
            variants.extend(numbers.variants.iter().map(|number| {
                let value = number.value.into();
                Variant {
                    interval: Some(interval(&value, Some(&number.name))),
                    name: number.name.clone(),
                    unit: number.unit,
                    range: number.range,
                    value,
                }
            }));
        }
        variants.extend(details.variants);
        let mut parameters = (metric.constants)(output.unit);
        parameters.extend(details.parameters);
        Score {
            interval: interval(&value, None),
            value,
            unit: metric.unit.of(output.unit),
            n: n.min().unwrap_or_default(),
            n_invalid: n_invalid.max().unwrap_or_default(),
            definition: metric.definition,
            parameters,
            counts: details.counts,
            flags: details.flags,
            standing: Standing::default(),
            bounded_share: None,
            of: output.of,
            variants,
        }
    }
}

/// A score on its way.
struct Request {
    metric: &'static Metric,
    output: Output,
    numbers: Numbers,
    resampling: Resampling,
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
        let labels = match self.rows_as_clusters {
            true => Some(Cow::Owned(rows_as_clusters(batch))),
            false => family.clusters(batch),
        };
        self.clustering.deposit(
            &mut self.clusters,
            batch.rows(),
            labels.as_deref(),
            |sums, rows| family.deposit(sums, batch, rows),
        );
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

    fn scores(&self, metrics: &[&'static Metric]) -> Vec<Entry> {
        let total = self.clustering.total(&self.clusters);
        let mut requests = self.requests(metrics, &total);
        let cells = self.clusters.cells();
        if let Some(cells) = &cells {
            self.resample(&mut requests, cells);
        }
        let requests = requests.into_iter();
        requests
            .map(|request| Entry {
                metric: request.metric,
                channel: request.output.label.clone(),
                score: self.score(request, &total, cells.as_deref()),
            })
            .collect()
    }
}
