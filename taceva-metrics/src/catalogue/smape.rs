//! Symmetric mean absolute percentage error, as a fraction.

use taceva_core::Unit;

use crate::evaluate::metric::{Formula, Metric, ScoreUnit};
use crate::exact::streams::{Stream, Streams};
use crate::families::accuracy::pair_sums::PairSums;
use crate::families::accuracy::pairs::{PAIR_NEEDS, PAIRS, PairFinish, PairFormula};
use crate::pair::EPSILON;
use crate::score::Parameter;
use crate::score::direction::Better;
use crate::score::range::Range;
use crate::score::theme::Theme;
use crate::score::value::Finished;

pub(crate) static SMAPE: Metric = Metric {
    id: "smape",
    title: "symmetric mean absolute percentage error",
    symbol: Some("sMAPE"),
    theme: Theme::Accuracy,
    better: Better::Lower,
    unit: ScoreUnit::One,
    range: Range::BelowTwo,
    definition: "smape/1",
    reference: "TacEva, equation (3)",
    documentation: "Error relative to the mean magnitude of truth and prediction, as a fraction from 0 to 2; output in % is multiplied \
                    by 100. ε is absolute, so the value depends on the unit, which is fixed to mm and N. Where the truth is near \
                    zero, it comes near to 2 for any error: see smape_gated.",
    needs: PAIR_NEEDS,
    constants: epsilon,
    formula: Formula(&PairFormula {
        streams: Streams::of(&[Stream::Symmetric]),
        gated: false,
        count: PairSums::n,
        finish: PairFinish::Channel(smape),
    }),
    ..Metric::of(&PAIRS)
};

/// Mean of the terms of sMAPE over all pairs, rounded once.
fn smape(sums: &PairSums) -> Finished {
    Ok(sums.mean(Stream::Symmetric))
}

/// Constant ε in the denominator of sMAPE.
pub(super) fn epsilon(_: Unit) -> Vec<Parameter> {
    vec![Parameter {
        name: "eps",
        value: EPSILON,
    }]
}
