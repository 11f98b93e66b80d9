//! Computes scores with their intervals from sums.

use super::Accumulator;
use super::erased_sums::ErasedSums;
use super::resampling::{Cell, Resampling, each_left_out};
use crate::evaluate::entry::Entry;
use crate::evaluate::family::{Details, Numbers, Output};
use crate::evaluate::metric::Metric;
use crate::score::flag::Flag;
use crate::score::value::{UndefinedReason, Value};
use crate::score::verdict_rule::VerdictRule;
use crate::score::verdict_standing::Standing;
use crate::score::{Interval, Score, Variant};
use crate::stats::IntervalMethod;

/// A score before its interval is computed.
struct Request {
    metric: &'static Metric,
    output: Output,
    numbers: Numbers,
    resampling: Resampling,
}

impl Accumulator {
    /// Scores of those `metrics` that belong to the family, in the order of `metrics`.
    pub(crate) fn scores(&self, metrics: &[&'static Metric]) -> Vec<Entry> {
        let total = self.clustering.total(&self.clusters);
        let mut requests = self.requests(metrics, &total);
        let cells = self.clusters.cells();
        if let Some(cells) = cells.as_ref().filter(|_| !self.kind.own_intervals) {
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

    /// Value and variants of one score. If the family has a joint formula for the score, the numbers come from the sums of all parts together.
    /// Otherwise the numbers are those of the score's only part, or the mean of its two parts.
    fn numbers(&self, metric: &Metric, output: &Output, sums: &ErasedSums) -> Numbers {
        self.of_parts(metric, output, sums, |part| {
            self.family.numbers(metric, output, sums, part)
        })
    }

    /// Numbers of one score for a selection of clusters. Numbers without intervals may be missing.
    fn resampled(&self, metric: &Metric, output: &Output, sums: &ErasedSums) -> Numbers {
        self.of_parts(metric, output, sums, |part| {
            self.family.resampled(metric, output, sums, part)
        })
    }

    fn of_parts(
        &self,
        metric: &Metric,
        output: &Output,
        sums: &ErasedSums,
        of_part: impl Fn(usize) -> Numbers,
    ) -> Numbers {
        if let Some(numbers) = self.family.joint(metric, output, sums) {
            return numbers;
        }
        let mut parts = output.parts.iter();
        let mut next = || parts.next().map(|part| of_part(*part));
        let first = next().unwrap_or_else(|| Numbers::of(Err(UndefinedReason::Empty)));
        match next() {
            Some(second) => first.mean(&second),
            None => first,
        }
    }

    /// Number of samples in the sums of a cluster that one score uses.
    fn samples(&self, metric: &Metric, output: &Output, sums: &ErasedSums) -> u64 {
        let parts = output.parts.iter();
        let counts = parts.map(|&part| self.family.count(metric, sums, part));
        counts.fold(0, u64::saturating_add)
    }

    /// Scores of those `metrics` that belong to the family, before intervals are computed.
    fn requests(&self, metrics: &[&'static Metric], total: &ErasedSums) -> Vec<Request> {
        let mut requests = Vec::new();
        let of_family = |metric: &&&Metric| metric.family.schema == self.kind.schema;
        for &metric in metrics.iter().filter(of_family) {
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

    /// Recomputes each score that has an interval, with clusters left out or weighted.
    fn resample(&self, requests: &mut [Request], cells: &[Cell<'_>]) {
        let requests = requests.iter_mut();
        let mut requests: Vec<&mut Request> = requests
            .filter(|request| request.resampling.is_needed())
            .collect();
        if requests.is_empty() {
            return;
        }
        match self.interval_method {
            IntervalMethod::Jackknife => {
                each_left_out(&self.clustering.empty, cells, &mut |cell, others| {
                    for request in &mut requests {
                        let count = self.samples(request.metric, &request.output, cell);
                        if count > 0 {
                            let numbers = self.resampled(request.metric, &request.output, others);
                            request.resampling.leave_out(count, &numbers);
                        }
                    }
                });
            }
            IntervalMethod::PoissonBootstrap(bootstrap) => {
                for request in requests {
                    let (metric, output) = (request.metric, &request.output);
                    let cells: Vec<Cell<'_>> = cells
                        .iter()
                        .copied()
                        .filter(|(_, cell)| self.samples(metric, output, cell) > 0)
                        .collect();
                    let finish = |sums: &ErasedSums| self.resampled(metric, output, sums);
                    let counts = cells.iter();
                    let counts = counts.map(|(_, cell)| self.samples(metric, output, cell));
                    let samples = counts.fold(0, u64::saturating_add);
                    let (empty, resampling) = (&self.clustering.empty, &mut request.resampling);
                    let numbers = &request.numbers;
                    resampling.weigh(bootstrap, empty, &cells, numbers, samples, &finish);
                }
            }
        }
    }

    fn score(&self, request: Request, total: &ErasedSums, cells: Option<&[Cell<'_>]>) -> Score {
        let Request {
            metric,
            output,
            numbers,
            resampling,
        } = request;
        let (value, details) = match self.family.inapplicable(metric, &output) {
            Some(reason) => (Value::NotApplicable(reason), Details::default()),
            None => (
                numbers.value.into(),
                self.family.details(metric, &output, total),
            ),
        };
        let is_jackknife = matches!(self.interval_method, IntervalMethod::Jackknife);
        let is_own = self.kind.own_intervals || is_jackknife;
        let own = cells.filter(|_| is_own).and_then(|cells| {
            let cells: Vec<&ErasedSums> = cells.iter().map(|(_, cell)| *cell).collect();
            self.family.intervals(metric, &output, &cells)
        });
        let of_value = |value: &Value, name: Option<&str>| match value {
            Value::Undefined(reason) => Interval::Undefined(*reason),
            Value::Scalar(_) if cells.is_none() => Interval::Undefined(self.family.unclustered()),
            Value::Scalar(value) => {
                let own = own.as_ref().and_then(|own| own.of(name));
                own.unwrap_or_else(|| resampling.interval(*value, name))
            }
            _ => Interval::Undefined(UndefinedReason::Empty),
        };
        let interval = |value: &Value, name: Option<&str>| {
            of_value(value, name).clustered_by(self.clustered_by)
        };
        let parts = output.parts.iter();
        let n = parts
            .clone()
            .map(|&part| self.family.count(metric, total, part));
        let n_invalid = parts.map(|&part| self.family.invalid(total, part));
        let (n, n_invalid) = (n.min(), n_invalid.max());
        let mut variants = Vec::new();
        if !matches!(value, Value::NotApplicable(_)) {
            variants.extend(numbers.variants.iter().map(|number| {
                let known = own.as_ref().and_then(|own| own.value_of(&number.name));
                let value = known.unwrap_or(number.value).into();
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
        let interval = interval(&value, None);
        let mut flags = details.flags;
        let has_no_width = interval.ends().is_some_and(|[low, high]| high <= low);
        // The skill of a constant prediction is 0 by its definition.
        if has_no_width && metric.verdict != VerdictRule::Skill {
            flags.push(Flag::EqualClusters);
        }
        Score {
            interval,
            value,
            unit: metric.unit.of(output.unit),
            n: n.unwrap_or_default(),
            n_invalid: n_invalid.unwrap_or_default(),
            definition: metric.definition,
            parameters,
            counts: details.counts,
            flags,
            standing: Standing::default(),
            bounded_share: None,
            of: output.of,
            variants,
        }
    }
}
