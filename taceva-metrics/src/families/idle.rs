//! Family of scores computed from predictions without contact.

use taceva_core::{Batch, Channel, Field, FieldSet, Needs, Unit};

use crate::evaluate::family::{FamilyKind, Numbers, Output, erased};
use crate::evaluate::metric::Metric;
use crate::evaluate::plan::MetricPlan;
use crate::exact::merge::Merge;
use crate::exact::moments::Moments;
use crate::exact::record::Record;
use crate::families::channelwise::{ByChannel, Channelwise};
use crate::families::row_columns::Gathered;
use crate::pair::{Paired, is_valid};
use crate::score::value::UndefinedReason;

/// Least normal force of contact, N.
pub(crate) const GATE_N: f64 = 0.02;
/// Least number of samples without contact for a score.
pub(crate) const LEAST_SAMPLES: u64 = 10;

/// Fields that metrics without contact need: truth and prediction with the channel `Fz`, for at least ten samples.
pub(crate) const IDLE_NEEDS: Needs =
    Needs::new(FieldSet::EMPTY.with(Field::Truth).with(Field::Prediction))
        .with_channels(&["Fz"])
        .with_least_samples(LEAST_SAMPLES);

/// Computes value and variants of a metric from the predictions without contact.
pub(crate) struct IdleFormula(pub(crate) fn(&Moments, Unit) -> Numbers);

/// Family of metrics computed from predictions without contact.
pub(crate) static IDLE: FamilyKind = FamilyKind::new("taceva.idle/1", |plan| {
    erased(ByChannel::new(Idle::for_plan(plan)?, plan))
});

/// Collects predicted forces of samples without contact.
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
    /// Creates the family for `plan`; `None` if the plan lacks `Fz`.
    pub(crate) fn for_plan(plan: &MetricPlan) -> Option<Idle> {
        let normal_force = plan.channels().position("Fz")?;
        Some(Idle {
            normal_force,
            gathered: Gathered::default(),
        })
    }
}

/// Returns an error if there are fewer than ten samples without contact.
pub(crate) fn enough(predictions: &Moments) -> Result<(), UndefinedReason> {
    match predictions.n {
        0 => Err(UndefinedReason::NoIdleSamples),
        LEAST_SAMPLES.. => Ok(()),
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

    fn numbers(&self, metric: &Metric, output: &Output, sums: &IdleSums) -> Numbers {
        match metric.formula.get::<IdleFormula>() {
            Some(formula) => (formula.0)(&sums.predictions, output.unit),
            None => Numbers::of(Err(UndefinedReason::Empty)),
        }
    }
}

impl Merge for IdleSums {
    fn merge(&mut self, other: &IdleSums) {
        self.n_invalid = self.n_invalid.saturating_add(other.n_invalid);
        self.predictions.merge(&other.predictions);
    }
}
