//! Drift of errors over time.

use taceva_core::{Batch, Channel, Field, FieldSet, Needs, Unit};

use crate::evaluate::family::{FamilyKind, Numbers, Output, erased};
use crate::evaluate::metric::{Metric, ScoreUnit};
use crate::exact::merge::Merge;
use crate::exact::record::Record;
use crate::exact::{Dyadic, ExactSum};
use crate::families::channelwise::{ByChannel, Channelwise, each_pair};
use crate::pair::is_valid;
use crate::score::direction::Better;
use crate::score::range::Range;
use crate::score::theme::Theme;
use crate::score::value::{Finished, UndefinedReason};

/// Seconds in an hour.
const HOUR_S: u64 = 3600;

pub(crate) static DRIFT: Metric = Metric {
    id: "drift",
    title: "drift of the error",
    theme: Theme::Robustness,
    better: Better::NearZero,
    unit: ScoreUnit::PerHour,
    range: Range::Any,
    definition: "drift/1",
    reference: "least-squares slope of truth − prediction over time",
    documentation: "Change of the mean error per hour: the slope of the line that best fits truth − prediction over time. Positions and \
                    forces only. If presses get deeper over time, an error that depends on depth looks like drift.",
    needs: Needs::new(
        FieldSet::EMPTY
            .with(Field::Truth)
            .with(Field::Prediction)
            .with(Field::Stamp),
    )
    .with_least_samples(2),
    ..Metric::of(&KIND)
};

/// Family of metrics computed from errors over time.
pub(crate) static KIND: FamilyKind = FamilyKind::new("taceva.drifts/1", |plan| {
    erased(ByChannel::new(Drifts, plan))
});

/// Collects errors and their times.
pub(crate) struct Drifts;

/// Sums of one channel, with the time t in s and the residual d.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct DriftSums {
    n: u64,
    n_invalid: u64,
    /// Σ t, Σ d, Σ t² and Σ t d over samples, with the time t in s and the residual d.
    sums: [ExactSum; 4],
}

/// Slope of the residuals over time, per hour, rounded once.
fn drift(sums: &DriftSums) -> Finished {
    match sums.n {
        0 => return Err(UndefinedReason::Empty),
        1 => return Err(UndefinedReason::TooFew { least: 2 }),
        _ => {}
    }
    let n = Dyadic::from(sums.n);
    let [t, d, tt, td] = [0, 1, 2, 3].map(|sum| sums.sums[sum].to_dyadic());
    let spread = &(&n * &tt) - &(&t * &t);
    if spread.is_zero() {
        return Err(UndefinedReason::EqualTimes);
    }
    let shared = &(&n * &td) - &(&t * &d);
    Ok((&shared * &Dyadic::from(HOUR_S)).over(&spread))
}

impl Channelwise for Drifts {
    type Sums = DriftSums;

    fn takes(&self, channel: &Channel) -> bool {
        matches!(channel.unit(), Unit::Millimetre | Unit::Newton)
    }

    fn deposit(
        &mut self,
        sums: &mut DriftSums,
        batch: &Batch,
        position: usize,
        rows: Option<&[u32]>,
    ) {
        let Some(times) = batch.numbers(Field::Stamp) else {
            return;
        };
        each_pair(batch, position, rows, |row, pair| {
            let Some(time) = times.get(row) else {
                return;
            };
            if !pair.is_valid() || !is_valid(time) {
                sums.n_invalid += 1;
                return;
            }
            sums.n += 1;
            let [t, d, tt, td] = &mut sums.sums;
            t.add(time);
            d.add(pair.residual());
            tt.add_product(time, time);
            td.add_product(time, pair.residual());
        });
    }

    fn to_record(&self, sums: &DriftSums) -> Record {
        Record {
            counts: vec![sums.n, sums.n_invalid],
            sums: sums.sums.to_vec(),
            ..Record::default()
        }
    }

    fn read_record(&self, record: &Record) -> Result<DriftSums, String> {
        let (&[n, n_invalid], sums) = record.exactly()?;
        Ok(DriftSums {
            n,
            n_invalid,
            sums: sums.clone(),
        })
    }

    fn count(&self, sums: &DriftSums) -> u64 {
        sums.n
    }

    fn invalid(&self, sums: &DriftSums) -> u64 {
        sums.n_invalid
    }

    fn numbers(&self, _metric: &Metric, _output: &Output, sums: &DriftSums) -> Numbers {
        Numbers::of(drift(sums))
    }
}

impl Merge for DriftSums {
    fn merge(&mut self, other: &DriftSums) {
        self.n = self.n.saturating_add(other.n);
        self.n_invalid = self.n_invalid.saturating_add(other.n_invalid);
        self.sums.merge(&other.sums);
    }
}
