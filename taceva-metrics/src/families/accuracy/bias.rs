//! Mean error with its sign.

use super::{needs, no_constants, not_empty};
use crate::evaluate::metric::{Finish, Formula, Metric, ScoreUnit};
use crate::exact::streams::{Stream, Streams};
use crate::families::accuracy::pair_sums::PairSums;
use crate::score::better::Better;
use crate::score::range::Range;
use crate::score::value::UndefinedReason;

pub(crate) static BIAS: Metric = Metric {
    id: "bias",
    title: "mean error",
    better: Better::NearZero,
    unit: ScoreUnit::OfChannel,
    range: Range::Any,
    definition: "bias/1",
    reference: "mean of truth − prediction",
    documentation: "By how much the truth exceeds the predictions on average: what a constant correction would remove.",
    needs: needs(1, &[]),
    facts: &[],
    constants: no_constants,
    formula: Formula::Pairs {
        streams: Streams::of(&[Stream::Residual]),
        gated: false,
        finish: Finish {
            count: PairSums::n,
            evaluate: bias,
        },
    },
};

/// RN(Sd / n).
fn bias(sums: &PairSums) -> Result<f64, UndefinedReason> {
    not_empty(sums)?;
    Ok(sums.mean(Stream::Residual))
}
