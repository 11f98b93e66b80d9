//! Mean signed error.

use crate::evaluate::metric::{Formula, Metric, ScoreUnit};
use crate::exact::streams::{Stream, Streams};
use crate::families::accuracy::pair_sums::PairSums;
use crate::families::accuracy::pairs::{PAIR_NEEDS, PAIRS, PairFinish, PairFormula};
use crate::score::direction::Better;
use crate::score::range::Range;
use crate::score::theme::Theme;
use crate::score::value::Finished;

pub(crate) static BIAS: Metric = Metric {
    id: "bias",
    title: "mean error",
    symbol: Some("bias"),
    theme: Theme::Accuracy,
    better: Better::NearZero,
    unit: ScoreUnit::OfChannel,
    range: Range::Any,
    definition: "bias/1",
    reference: "mean of truth − prediction",
    documentation: "Mean of truth − prediction: the constant that corrects the predictions on average.",
    needs: PAIR_NEEDS,
    formula: Formula(&PairFormula {
        streams: Streams::of(&[Stream::Residual]),
        gated: false,
        count: PairSums::n,
        finish: PairFinish::Channel(bias),
    }),
    ..Metric::of(&PAIRS)
};

/// Sum of the residuals divided by the number of pairs, rounded once.
fn bias(sums: &PairSums) -> Finished {
    Ok(sums.mean(Stream::Residual))
}
