//! Symmetric mean absolute percentage error, as a fraction.

use taceva_core::Unit;

use super::{gate, needs, not_empty};
use crate::evaluate::metric::{Finish, Formula, Metric, ScoreUnit};
use crate::exact::Dyadic;
use crate::exact::streams::{Stream, Streams};
use crate::families::accuracy::pair_sums::PairSums;
use crate::paired::EPSILON;
use crate::score::Parameter;
use crate::score::better::Better;
use crate::score::range::Range;
use crate::score::value::UndefinedReason;

pub(crate) static SMAPE: Metric = Metric {
    id: "smape",
    title: "symmetric mean absolute percentage error",
    better: Better::Lower,
    unit: ScoreUnit::One,
    range: Range::BelowTwo,
    definition: "smape/1",
    reference: "TacEva, equation (3)",
    documentation: "Errors relative to the mean magnitude of truth and prediction, as a fraction from 0 to 2 (the printer \
                    multiplies by 100 where it writes %). ε is absolute, so that the value depends on the unit, which is \
                    fixed to mm and N. Channels of both signs saturate towards 2 near zero: see smape_gated.",
    needs: needs(1, &[]),
    facts: &[],
    constants: epsilon,
    formula: Formula::Pairs {
        streams: Streams::of(&[Stream::Symmetric]),
        gated: false,
        finish: Finish {
            count: PairSums::n,
            evaluate: smape,
        },
    },
};

pub(crate) static SMAPE_GATED: Metric = Metric {
    id: "smape_gated",
    title: "symmetric mean absolute percentage error in contact",
    better: Better::Lower,
    unit: ScoreUnit::One,
    range: Range::BelowTwo,
    definition: "smape_gated/1",
    reference: "TacEva, equation (3), for |truth| ≥ 0.02 N or 0.02 mm",
    documentation: "Like smape, of those samples only whose truth reaches the gate; n says how many those are.",
    needs: needs(1, &[]),
    facts: &[],
    constants: epsilon_and_gate,
    formula: Formula::Pairs {
        streams: Streams::of(&[Stream::Symmetric]),
        gated: true,
        finish: Finish {
            count: PairSums::n_gated,
            evaluate: smape_gated,
        },
    },
};

/// RN(St / n).
fn smape(sums: &PairSums) -> Result<f64, UndefinedReason> {
    not_empty(sums)?;
    Ok(sums.mean(Stream::Symmetric))
}

/// RN(St / n) over the samples that reach the gate.
fn smape_gated(sums: &PairSums) -> Result<f64, UndefinedReason> {
    not_empty(sums)?;
    if sums.n_gated() == 0 {
        return Err(UndefinedReason::BelowGate);
    }
    Ok(sums
        .gated_sum()
        .to_dyadic()
        .over(&Dyadic::from(sums.n_gated())))
}

fn epsilon(_: Unit) -> Vec<Parameter> {
    vec![Parameter {
        name: "eps",
        value: EPSILON,
    }]
}

fn epsilon_and_gate(unit: Unit) -> Vec<Parameter> {
    let gate = gate(unit).map(|value| Parameter {
        name: "gate",
        value,
    });
    epsilon(unit).into_iter().chain(gate).collect()
}
