//! Mean absolute error.

use super::{needs, no_constants, not_empty};
use crate::evaluate::metric::{Finish, Formula, Metric, ScoreUnit};
use crate::exact::streams::{Stream, Streams};
use crate::families::accuracy::pair_sums::PairSums;
use crate::score::better::Better;
use crate::score::range::Range;
use crate::score::value::UndefinedReason;

pub(crate) static MAE: Metric = Metric {
    id: "mae",
    title: "mean absolute error",
    better: Better::Lower,
    unit: ScoreUnit::OfChannel,
    range: Range::Positive,
    definition: "mae/1",
    reference: "TacEva, equation (1)",
    documentation: "How far predictions are from the truth on average, in the unit of the channel.",
    needs: needs(1, &[]),
    facts: &[],
    constants: no_constants,
    formula: Formula::Pairs {
        streams: Streams::of(&[Stream::Absolute]),
        gated: false,
        finish: Finish {
            count: PairSums::n,
            evaluate: mae,
        },
    },
};

/// RN(S|d| / n).
fn mae(sums: &PairSums) -> Result<f64, UndefinedReason> {
    not_empty(sums)?;
    Ok(sums.mean(Stream::Absolute))
}
