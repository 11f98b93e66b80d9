//! How far predictions are from the truth: one metric per file, formula and description together.

mod bias;
mod gate;
mod mae;
mod mae_euclid;
pub(crate) mod pair_sums;
mod pairs;
mod plane;
pub(crate) mod plane_sums;
mod r2;
mod rmse;
mod skill;
mod smape;

pub(crate) use bias::BIAS;
pub(crate) use gate::gate;
pub(crate) use mae::MAE;
pub(crate) use mae_euclid::MAE_EUCLID;
pub(crate) use pairs::{Pairs, outputs};
pub(crate) use plane::Plane;
pub(crate) use r2::R2;
pub(crate) use rmse::RMSE;
pub(crate) use skill::{Axis, SKILL, STREAMS as SKILL_STREAMS, constant, skill};
pub(crate) use smape::{SMAPE, SMAPE_GATED};

use taceva_core::{Field, FieldSet, Needs, Unit};

use crate::families::accuracy::pair_sums::PairSums;
use crate::score::Parameter;
use crate::score::value::UndefinedReason;

/// What every score of pairs needs.
const fn needs(least_samples: u64, channels: &'static [&'static str]) -> Needs {
    Needs::new(FieldSet::EMPTY.with(Field::Truth).with(Field::Prediction))
        .with_channels(channels)
        .with_least_samples(least_samples)
}

pub(crate) fn no_constants(_: Unit) -> Vec<Parameter> {
    Vec::new()
}

/// The reason for no value if there is no pair.
fn not_empty(sums: &PairSums) -> Result<(), UndefinedReason> {
    if sums.n() == 0 {
        return Err(UndefinedReason::Empty);
    }
    Ok(())
}
