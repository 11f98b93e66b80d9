//! The least force that is distinguished from none.

use taceva_core::{Batch, Channel, Field, FieldSet, Needs, Unit};

use crate::evaluate::family::{FamilyKind, Numbers, Output, erased};
use crate::evaluate::metric::{Metric, ScoreUnit};
use crate::evaluate::plan::MetricPlan;
use crate::exact::merge::Merge;
use crate::exact::moments::Moments;
use crate::exact::record::Record;
use crate::families::channelwise::{ByChannel, Channelwise};
use crate::families::row_columns::Gathered;
use crate::pair::{Paired, is_valid};
use crate::score::Parameter;
use crate::score::direction::Better;
use crate::score::range::Range;
use crate::score::theme::Theme;
use crate::score::value::UndefinedReason;

/// k_α + k_β of Currie for risks of 5 % each: 2 × 1.645.
pub(crate) const DETECTION_FACTOR: f64 = 3.29;
/// Samples without contact below which their spread is not estimated.
const LEAST_SAMPLES: u64 = 10;
/// The normal force from which on there is contact, in N.
const GATE_N: f64 = 0.02;

pub(crate) static MINIMUM_DETECTABLE_FORCE: Metric = Metric {
    id: "minimum_detectable_force",
    title: "minimum detectable force",
    symbol: Some("$F_{\\min}$"),
    theme: Theme::Detail,
    better: Better::Lower,
    unit: ScoreUnit::OfChannel,
    range: Range::Positive,
    definition: "minimum_detectable_force/1",
    reference: "Currie 1968, Analytical Chemistry 40: detection limit 3.29 σ₀ for risks of 5 %",
    documentation: "The least force that is distinguished from none, with 5 % of false alarms and 5 % of misses: 3.29 times the standard \
                    deviation (over n − 1) of predicted force over the samples without contact, |true Fz| < 0.02 N. Of forces \
                    only, and from ten such samples on. It says nothing of a constant offset: see bias.",
    needs: Needs::new(FieldSet::EMPTY.with(Field::Truth).with(Field::Prediction))
        .with_channels(&["Fz"])
        .with_least_samples(LEAST_SAMPLES),
    constants: factor_and_gate,
    ..Metric::of(&KIND)
};

fn factor_and_gate(_: Unit) -> Vec<Parameter> {
    let parameter = |name, value| Parameter { name, value };
    vec![
        parameter("factor", DETECTION_FACTOR),
        parameter("gate", GATE_N),
    ]
}

/// Family of predictions without contact.
pub(crate) static KIND: FamilyKind = FamilyKind::new("taceva.idle/1", |plan| {
    erased(ByChannel::new(Idle::for_plan(plan)?, plan))
});

/// Predicted forces where nothing is touched.
pub(crate) struct Idle {
    normal_force: usize,
    gathered: Gathered,
}

/// Count and sums of the predictions of one channel without contact.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct IdleSums {
    n_invalid: u64,
    predictions: Moments,
}

impl Idle {
    /// The kind for `plan`, if it has a normal force.
    pub(crate) fn for_plan(plan: &MetricPlan) -> Option<Idle> {
        let normal_force = plan.channels().position("Fz")?;
        Some(Idle {
            normal_force,
            gathered: Gathered::default(),
        })
    }
}

/// L_D = RN(3.29 s), s the standard deviation of the predictions.
fn minimum_detectable_force(sums: &IdleSums) -> Result<f64, UndefinedReason> {
    match (sums.predictions.n, sums.predictions.deviation(1)) {
        (0, _) => Err(UndefinedReason::NoIdleSamples),
        (LEAST_SAMPLES.., Some(deviation)) => Ok(DETECTION_FACTOR * deviation),
        _ => Err(UndefinedReason::TooFew {
            least: LEAST_SAMPLES,
        }),
    }
}

impl Channelwise for Idle {
    type Sums = IdleSums;

    fn takes(&self, channel: &Channel) -> bool {
        channel.unit() == Unit::Newton
    }

    fn deposit(
        &mut self,
        sums: &mut IdleSums,
        batch: &Batch,
        position: usize,
        rows: Option<&[u32]>,
    ) {
        let columns = [
            batch.prediction(position),
            batch.truth(position),
            batch.truth(self.normal_force),
        ];
        let [estimate, reference, forces] = self.gathered.rows(&columns, rows)[..] else {
            return;
        };
        let pairs = Paired {
            estimate,
            reference,
        };
        for (pair, &force) in pairs.iter().zip(forces) {
            if !pair.is_valid() || !is_valid(force) {
                sums.n_invalid += 1;
            } else if force.abs() < GATE_N {
                sums.predictions.add(pair.estimate);
            }
        }
    }

    fn to_record(&self, sums: &IdleSums) -> Record {
        let mut record = sums.predictions.to_record();
        record.counts.push(sums.n_invalid);
        record
    }

    fn read_record(&self, record: &Record) -> Result<IdleSums, String> {
        let (&[n, n_invalid], [sum, squares]) = record.exactly()?;
        Ok(IdleSums {
            n_invalid,
            predictions: Moments {
                n,
                sum: sum.clone(),
                squares: squares.clone(),
            },
        })
    }

    fn count(&self, sums: &IdleSums) -> u64 {
        sums.predictions.n
    }

    fn invalid(&self, sums: &IdleSums) -> u64 {
        sums.n_invalid
    }

    fn numbers(&self, _metric: &Metric, _output: &Output, sums: &IdleSums) -> Numbers {
        Numbers::of(minimum_detectable_force(sums))
    }
}

impl Merge for IdleSums {
    fn merge(&mut self, other: &IdleSums) {
        self.n_invalid = self.n_invalid.saturating_add(other.n_invalid);
        self.predictions.merge(&other.predictions);
    }
}
