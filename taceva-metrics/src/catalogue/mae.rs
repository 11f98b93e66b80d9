//! Mean absolute error.

use crate::evaluate::metric::{Formula, Metric, ScoreUnit};
use crate::exact::streams::{Stream, Streams};
use crate::families::accuracy::pair_sums::PairSums;
use crate::families::accuracy::pairs::{PAIR_NEEDS, PAIRS, PairFinish, PairFormula};
use crate::score::direction::Better;
use crate::score::range::Range;
use crate::score::theme::Theme;
use crate::score::value::Finished;

pub(crate) static MAE: Metric = Metric {
    id: "mae",
    title: "mean absolute error",
    symbol: Some("MAE"),
    theme: Theme::Accuracy,
    better: Better::Lower,
    unit: ScoreUnit::OfChannel,
    range: Range::Positive,
    definition: "mae/1",
    reference: "TacEva, equation (1)",
    documentation: "Mean magnitude of the error, in the unit of the channel. For Pxy and Fxy it is the mean of both axes, not a distance: see mae_euclid.",
    needs: PAIR_NEEDS,
    formula: Formula(&PairFormula {
        streams: Streams::of(&[Stream::Absolute]),
        gated: false,
        count: PairSums::n,
        finish: PairFinish::Channel(mae),
    }),
    ..Metric::of(&PAIRS)
};

/// Sum of the absolute residuals divided by the number of pairs, rounded once.
fn mae(sums: &PairSums) -> Finished {
    Ok(sums.mean(Stream::Absolute))
}
