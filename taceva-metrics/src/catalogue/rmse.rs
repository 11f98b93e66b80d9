//! Root mean square error.

use crate::evaluate::metric::{Formula, Metric, ScoreUnit};
use crate::exact::streams::{Stream, Streams};
use crate::families::accuracy::pair_sums::PairSums;
use crate::families::accuracy::pairs::{PAIR_NEEDS, PAIRS, PairFinish, PairFormula};
use crate::score::direction::Better;
use crate::score::range::Range;
use crate::score::theme::Theme;
use crate::score::value::Finished;

pub(crate) static RMSE: Metric = Metric {
    id: "rmse",
    title: "root mean square error",
    symbol: Some("RMSE"),
    theme: Theme::Accuracy,
    better: Better::Lower,
    unit: ScoreUnit::OfChannel,
    range: Range::Positive,
    definition: "rmse/2",
    reference: "square root of the mean squared error",
    documentation: "Like the mean absolute error, but large errors weigh more; 1.25 times as large for Gaussian errors of mean zero.",
    needs: PAIR_NEEDS,
    formula: Formula(&PairFormula {
        streams: Streams::of(&[Stream::Squared]),
        gated: false,
        count: PairSums::n,
        finish: PairFinish::Channel(rmse),
    }),
    ..Metric::of(&PAIRS)
};

/// Root of the exact mean of squared residuals, rounded once, even if this mean exceeds the range of binary64.
fn rmse(sums: &PairSums) -> Finished {
    Ok(sums.root_mean_square(Stream::Squared))
}
