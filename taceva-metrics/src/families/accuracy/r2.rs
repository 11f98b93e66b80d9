//! Coefficient of determination.

use super::{needs, no_constants, not_empty};
use crate::evaluate::metric::{Finish, Formula, Metric, ScoreUnit};
use crate::exact::Dyadic;
use crate::exact::streams::{Stream, Streams};
use crate::families::accuracy::pair_sums::PairSums;
use crate::score::better::Better;
use crate::score::range::Range;
use crate::score::value::UndefinedReason;

pub(crate) static R2: Metric = Metric {
    id: "r2",
    title: "coefficient of determination",
    better: Better::Higher,
    unit: ScoreUnit::One,
    range: Range::BelowOne,
    definition: "r2/1",
    reference: "TacEva, equation (2)",
    documentation: "Which share of the truth's spread the predictions explain: 1 is perfect, 0 is no better than always \
                    predicting the mean of the evaluated truth, and below 0 is worse. Never clipped; undefined where the truth \
                    does not vary.",
    needs: needs(2, &[]),
    facts: &[],
    constants: no_constants,
    formula: Formula::Pairs {
        streams: Streams::of(&[Stream::Squared, Stream::Truth, Stream::TruthSquared]),
        gated: false,
        finish: Finish {
            count: PairSums::n,
            evaluate: r2,
        },
    },
};

/// RN(1 − n Sdd / (n Syy − Sy²)): the textbook formula is safe because nothing rounds before the end.
fn r2(sums: &PairSums) -> Result<f64, UndefinedReason> {
    not_empty(sums)?;
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
