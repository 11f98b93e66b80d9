//! Symmetric mean absolute percentage error of the samples in contact.

use taceva_core::Unit;

use super::smape::epsilon;
use crate::evaluate::metric::{Formula, Metric, ScoreUnit};
use crate::exact::Dyadic;
use crate::exact::streams::{Stream, Streams};
use crate::families::accuracy::gate;
use crate::families::accuracy::pair_sums::PairSums;
use crate::families::accuracy::pairs::{PAIR_NEEDS, PAIRS, PairFinish, PairFormula};
use crate::score::Parameter;
use crate::score::direction::Better;
use crate::score::range::Range;
use crate::score::theme::Theme;
use crate::score::value::{Finished, UndefinedReason};

pub(crate) static SMAPE_GATED: Metric = Metric {
    id: "smape_gated",
    title: "symmetric mean absolute percentage error in contact",
    symbol: Some("sMAPE, gated"),
    theme: Theme::Accuracy,
    better: Better::Lower,
    unit: ScoreUnit::One,
    range: Range::BelowTwo,
    definition: "smape_gated/1",
    reference: "TacEva, equation (3), for |truth| ≥ 0.02 N or 0.02 mm",
    documentation: "Like smape, but only over samples whose truth reaches the gate; n is their number.",
    needs: PAIR_NEEDS,
    constants: epsilon_and_gate,
    formula: Formula(&PairFormula {
        streams: Streams::of(&[Stream::Symmetric]),
        gated: true,
        count: PairSums::n_gated,
        finish: PairFinish::Channel(smape_gated),
    }),
    ..Metric::of(&PAIRS)
};

/// Mean of the terms of sMAPE over the samples whose |truth| reaches the gate, rounded once.
fn smape_gated(sums: &PairSums) -> Finished {
    if sums.n_gated() == 0 {
        return Err(UndefinedReason::BelowGate);
    }
    Ok(sums
        .gated_sum()
        .to_dyadic()
        .over(&Dyadic::from(sums.n_gated())))
}

fn epsilon_and_gate(unit: Unit) -> Vec<Parameter> {
    let gate = gate(unit).map(|value| Parameter {
        name: "gate",
        value,
    });
    epsilon(unit).into_iter().chain(gate).collect()
}
