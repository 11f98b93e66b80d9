//! The family of scores that are finished from the sums of each channel's pairs.

use std::collections::BTreeMap;

use taceva_core::{Batch, Channels, Unit};

use super::plane::planes;
use crate::evaluate::family::{Details, Family, Numbers, Output};
use crate::evaluate::metric::{Formula, Metric};
use crate::evaluate::plan::MetricPlan;
use crate::exact::merge::keyed;
use crate::exact::record::Record;
use crate::exact::streams::{Stream, Streams};
use crate::exact::{Counts, Sums};
use crate::families::accuracy::pair_sums::{PairSpec, PairSums};
use crate::families::accuracy::{Axis, SKILL_STREAMS, constant, gate, skill};
use crate::families::gathered::Gathered;
use crate::paired::{EPSILON, Paired};
use crate::score::Variant;
use crate::score::flag::Flag;
use crate::score::value::{InapplicableReason, UndefinedReason, Value};

/// Sums of the pairs of each channel.
pub(crate) struct Pairs {
    streams: Streams,
    gated: bool,
    specs: Vec<PairSpec>,
    /// What the model is measured by, channel by channel; the mean of truth where absent.
    constants: Vec<Option<f64>>,
    outputs: Vec<Output>,
    gathered: Gathered,
}

impl Pairs {
    /// What the kept metrics of `plan` need; `None` if they need nothing of the kind.
    pub(crate) fn for_plan(plan: &MetricPlan) -> Option<Pairs> {
        let channels = plan.channels();
        let mut streams = Streams::NONE;
        let mut any_gated = false;
        for metric in plan.kept() {
            match metric.formula {
                Formula::Pairs {
                    streams: needed,
                    gated,
                    ..
                } => {
                    streams = streams | needed;
                    any_gated |= gated;
                }
                Formula::Skill => streams = streams | SKILL_STREAMS,
                _ => {}
            }
        }
        let specs = channels.iter().map(|channel| PairSpec {
            streams,
            gate: gate(channel.unit()).filter(|_| any_gated),
        });
        (streams != Streams::NONE).then(|| Pairs {
            streams,
            gated: any_gated,
            specs: specs.collect(),
            constants: channels
                .iter()
                .map(|channel| plan.constant(channel.name()))
                .collect(),
            outputs: outputs(channels),
            gathered: Gathered::default(),
        })
    }
}

/// Each channel, then each plane as the mean of its axes.
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
    const SCHEMA: &'static str = "taceva.pairs/1";

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
            return Err("values or cells in a record that has none".to_owned());
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

    fn outputs(&self, metric: &Metric) -> Vec<Output> {
        match metric.formula {
            Formula::Pairs { .. } | Formula::Skill => self.outputs.clone(),
            _ => Vec::new(),
        }
    }

    fn count(&self, metric: &Metric, sums: &PairSums) -> u64 {
        match &metric.formula {
            Formula::Pairs { finish, .. } => (finish.count)(sums),
            Formula::Skill => sums.n(),
            _ => 0,
        }
    }

    fn invalid(&self, sums: &PairSums) -> u64 {
        sums.n_invalid()
    }

    fn numbers(&self, metric: &Metric, _output: &Output, sums: &PairSums) -> Numbers {
        match &metric.formula {
            Formula::Pairs { finish, .. } => Numbers::of((finish.evaluate)(sums)),
            _ => Numbers::of(Err(UndefinedReason::Empty)),
        }
    }

    fn joint(&self, metric: &Metric, output: &Output, sums: &[PairSums]) -> Option<Numbers> {
        matches!(metric.formula, Formula::Skill).then(|| {
            let axes: Vec<Axis<'_>> = output
                .parts
                .iter()
                .map(|&part| (&sums[part], self.constants[part]))
                .collect();
            Numbers::of(skill(&axes))
        })
    }

    fn details(&self, metric: &Metric, output: &Output, parts: &[&PairSums]) -> Details {
        if !matches!(metric.formula, Formula::Skill) {
            return Details::default();
        }
        let constants = output.parts.iter().map(|&part| self.constants[part]);
        let axes: Vec<Axis<'_>> = parts.iter().copied().zip(constants).collect();
        let is_mean = axes.iter().any(|(_, constant)| constant.is_none());
        let variants = match axes[..] {
            [axis] => constant(axis)
                .map(|constant| Variant::plain("constant", output.unit, Value::Scalar(constant))),
            _ => None,
        };
        Details {
            variants: variants.into_iter().collect(),
            flags: is_mean.then_some(Flag::MeanOfTruth).into_iter().collect(),
            ..Details::default()
        }
    }

    fn inapplicable(&self, metric: &Metric, output: &Output) -> Option<InapplicableReason> {
        let gated = matches!(metric.formula, Formula::Pairs { gated: true, .. });
        (gated && gate(output.unit).is_none()).then_some(InapplicableReason::NoGate(output.unit))
    }
}
