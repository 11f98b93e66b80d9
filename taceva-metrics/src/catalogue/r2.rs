//! Coefficient of determination.

use crate::evaluate::metric::{Formula, Metric, ScoreUnit};
use crate::exact::Dyadic;
use crate::exact::streams::{Stream, Streams};
use crate::families::accuracy::pair_sums::PairSums;
use crate::families::accuracy::pairs::{PAIR_NEEDS, PAIRS, PairFinish, PairFormula};
use crate::score::direction::Better;
use crate::score::range::Range;
use crate::score::theme::Theme;
use crate::score::value::{Finished, UndefinedReason};

pub(crate) static R2: Metric = Metric {
    id: "r2",
    title: "coefficient of determination",
    symbol: Some("$R^2$"),
    theme: Theme::Accuracy,
    better: Better::Higher,
    unit: ScoreUnit::One,
    range: Range::BelowOne,
    definition: "r2/1",
    reference: "TacEva, equation (2)",
    documentation: "Share of the variance of the truth that the predictions explain: 1 is perfect, 0 is no better than the mean of the \
                    evaluated truth as a constant prediction, and below 0 is worse. Never clipped; undefined if the truth does not vary.",
    needs: PAIR_NEEDS.with_least_samples(2),
    formula: Formula(&PairFormula {
        streams: Streams::of(&[Stream::Squared, Stream::Truth, Stream::TruthSquared]),
        gated: false,
        count: PairSums::n,
        finish: PairFinish::Channel(r2),
    }),
    ..Metric::of(&PAIRS)
};

/// R² = 1 − n Σ d² / (n Σ y² − (Σ y)²) for n residuals d and truths y, rounded once. Cancellation costs no digits, because the sums are exact.
fn r2(sums: &PairSums) -> Finished {
    if sums.n() < R2.needs.least_samples {
        return Err(UndefinedReason::TooFew {
            least: R2.needs.least_samples,
        });
    }
    let squared = sums.sum(Stream::Squared).to_dyadic();
    let spread = sums.scaled_spread();
    if spread.is_zero() {
        return Err(UndefinedReason::ConstantTruth {
            perfect: squared.is_zero(),
        });
    }
    let unexplained = &Dyadic::from(sums.n()) * &squared;
    Ok((&spread - &unexplained).over(&spread))
}
