//! Family of metrics computed from sums over pairs of prediction and truth, channel by channel.

use std::collections::BTreeMap;

use taceva_core::{Batch, Channels, Field, FieldSet, Needs, Unit};

use super::plane::planes;
use crate::evaluate::family::{Details, Family, FamilyKind, Numbers, Output, erased};
use crate::evaluate::metric::Metric;
use crate::evaluate::plan::MetricPlan;
use crate::exact::merge::keyed;
use crate::exact::record::Record;
use crate::exact::streams::{Stream, Streams};
use crate::exact::{Counts, Sums};
use crate::families::accuracy::gate;
use crate::families::accuracy::pair_sums::{PairSpec, PairSums};
use crate::families::row_columns::Gathered;
use crate::pair::{EPSILON, Paired};
use crate::score::value::{Finished, InapplicableReason, UndefinedReason};

/// Family of metrics computed from pairs of prediction and truth.
pub(crate) static PAIRS: FamilyKind = FamilyKind {
    clusters_of_plan: true,
    ..FamilyKind::new("taceva.pairs/1", |plan| erased(Pairs::for_plan(plan)))
};

/// Fields that every metric of pairs needs: truth and prediction, for at least one sample.
pub(crate) const PAIR_NEEDS: Needs =
    Needs::new(FieldSet::EMPTY.with(Field::Truth).with(Field::Prediction)).with_least_samples(1);

/// Formula of a metric of pairs.
pub(crate) struct PairFormula {
    /// Sums over pairs that the formula reads.
    pub(crate) streams: Streams,
    /// True if the metric uses only samples with |truth| of at least the gate of the channel.
    pub(crate) gated: bool,
    /// Number of samples that the metric uses.
    pub(crate) count: fn(&PairSums) -> u64,
    /// Computes the value from the sums.
    pub(crate) finish: PairFinish,
}

/// Formula that computes a value from sums of pairs.
pub(crate) enum PairFinish {
    /// Value of one channel with at least one pair. A plane, such as `Pxy`, gets the mean of its two axes.
    Channel(fn(&PairSums) -> Finished),
    /// Value computed from all axes together, each with the constant prediction to compare with.
    Axes {
        value: fn(&[Axis<'_>]) -> Finished,
        details: fn(&[Axis<'_>], &Output) -> Details,
    },
}

/// One channel with the constant prediction to which the model is compared.
#[derive(Clone, Copy)]
pub(crate) struct Axis<'a> {
    pub(crate) sums: &'a PairSums,
    /// Constant prediction: the mean of the training labels, or `None` for the mean of the truth.
    pub(crate) constant: Option<f64>,
}

/// Sums over pairs of prediction and truth, by channel.
struct Pairs {
    streams: Streams,
    gated: bool,
    specs: Vec<PairSpec>,
    /// Constant predictions to which the model is compared, by channel; `None` to use the mean of truth.
    constants: Vec<Option<f64>>,
    outputs: Vec<Output>,
    gathered: Gathered,
}

impl Pairs {
    /// Sums required by the metrics of `plan`.
    fn for_plan(plan: &MetricPlan) -> Pairs {
        let channels = plan.channels();
        let mut streams = Streams::NONE;
        let mut any_gated = false;
        for formula in plan.kept().iter().filter_map(|metric| formula(metric)) {
            streams = streams | formula.streams;
            any_gated |= formula.gated;
        }
        let specs = channels.iter().map(|channel| PairSpec {
            streams,
            gate: gate(channel.unit()).filter(|_| any_gated),
        });
        Pairs {
            streams,
            gated: any_gated,
            specs: specs.collect(),
            constants: channels
                .iter()
                .map(|channel| plan.constant(channel.name()))
                .collect(),
            outputs: outputs(channels),
            gathered: Gathered::default(),
        }
    }
}

fn formula(metric: &Metric) -> Option<&'static PairFormula> {
    metric.formula.get()
}

/// The value of `metric` for one channel.
pub(crate) fn value_of(metric: &Metric, sums: &PairSums) -> Finished {
    match formula(metric).map(|formula| &formula.finish) {
        Some(PairFinish::Channel(value)) if sums.n() > 0 => value(sums),
        _ => Err(UndefinedReason::Empty),
    }
}

/// Outputs to score: each channel, then each plane of two channels.
pub(crate) fn outputs(channels: &Channels) -> Vec<Output> {
    let single = channels
        .iter()
        .enumerate()
        .map(|(position, channel)| Output {
            label: channel.name().to_owned(),
            unit: channel.unit(),
            of: Vec::new(),
            parts: vec![position],
        });
    let groups = planes(channels).into_iter().map(|plane| Output {
        parts: plane.axes.to_vec(),
        ..plane.output()
    });
    single.chain(groups).collect()
}

impl Family for Pairs {
    type Sums = PairSums;

    fn parameters(&self) -> BTreeMap<String, String> {
        let mut parameters = keyed([("streams".to_owned(), self.streams.to_string())]);
        if self.streams.contains(Stream::Symmetric) {
            parameters.insert("eps".to_owned(), format!("{EPSILON:e}"));
        }
        if self.gated {
            for unit in [Unit::Newton, Unit::Millimetre] {
                let gate = gate(unit).map_or(String::new(), |gate| gate.to_string());
                parameters.insert(format!("gate_{unit}"), gate);
            }
        }
        parameters
    }

    fn empty(&self) -> Vec<PairSums> {
        self.specs.iter().copied().map(PairSums::new).collect()
    }

    fn deposit(&mut self, sums: &mut [PairSums], batch: &Batch, rows: Option<&[u32]>) {
        for (position, sums) in sums.iter_mut().enumerate() {
            let columns = [batch.prediction(position), batch.truth(position)];
            let [estimate, reference] = self.gathered.rows(&columns, rows)[..] else {
                return;
            };
            sums.update(Paired {
                estimate,
                reference,
            });
        }
    }

    fn to_record(&self, sums: &PairSums) -> Record {
        let mut record = Record {
            counts: vec![sums.n(), sums.n_invalid()],
            sums: self.streams.iter().map(|stream| sums.sum(stream)).collect(),
            ..Record::default()
        };
        if sums.gate().is_some() {
            record.counts.push(sums.n_gated());
            record.sums.push(sums.gated_sum());
        }
        record
    }

    fn read_record(&self, position: usize, record: &Record) -> Result<PairSums, String> {
        let mut sums = PairSums::new(self.specs[position]);
        let gated = usize::from(sums.gate().is_some());
        let expected = (2 + gated, self.streams.iter().count() + gated);
        let found = (record.counts.len(), record.sums.len());
        if !record.values.is_empty() || !record.cells.is_empty() {
            return Err("the record has values or cells, expected none".to_owned());
        }
        if found != expected {
            return Err(format!(
                "{} counts and {} sums, expected {} and {}",
                found.0, found.1, expected.0, expected.1
            ));
        }
        let mut kept = record.sums.iter().cloned();
        let mut read = Sums::default();
        for (stream, sum) in self.streams.iter().zip(&mut kept) {
            read.streams[stream as usize] = sum;
        }
        read.gated = kept.next().unwrap_or_default();
        let counts = Counts {
            valid: record.counts[0],
            invalid: record.counts[1],
            gated: record.counts.get(2).copied().unwrap_or_default(),
        };
        sums.set(counts, read);
        Ok(sums)
    }

    fn outputs(&self, _metric: &Metric) -> Vec<Output> {
        self.outputs.clone()
    }

    fn count(&self, metric: &Metric, sums: &PairSums) -> u64 {
        formula(metric).map_or(0, |formula| (formula.count)(sums))
    }

    fn invalid(&self, sums: &PairSums) -> u64 {
        sums.n_invalid()
    }

    fn numbers(&self, metric: &Metric, _output: &Output, sums: &PairSums) -> Numbers {
        Numbers::of(value_of(metric, sums))
    }

    fn joint(&self, metric: &Metric, output: &Output, sums: &[PairSums]) -> Option<Numbers> {
        let PairFinish::Axes { value, .. } = formula(metric)?.finish else {
            return None;
        };
        let axes: Vec<Axis<'_>> = output
            .parts
            .iter()
            .map(|&part| Axis {
                sums: &sums[part],
                constant: self.constants[part],
            })
            .collect();
        Some(Numbers::of(value(&axes)))
    }

    fn details(&self, metric: &Metric, output: &Output, parts: &[&PairSums]) -> Details {
        match formula(metric).map(|formula| &formula.finish) {
            Some(PairFinish::Axes { details, .. }) => {
                let constants = output.parts.iter().map(|&part| self.constants[part]);
                let axes = parts.iter().zip(constants);
                let axes: Vec<Axis<'_>> = axes
                    .map(|(sums, constant)| Axis { sums, constant })
                    .collect();
                details(&axes, output)
            }
            _ => Details::default(),
        }
    }

    fn inapplicable(&self, metric: &Metric, output: &Output) -> Option<InapplicableReason> {
        let gated = formula(metric).is_some_and(|formula| formula.gated);
        (gated && gate(output.unit).is_none()).then_some(InapplicableReason::NoGate(output.unit))
    }
}
