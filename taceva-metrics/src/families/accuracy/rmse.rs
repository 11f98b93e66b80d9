//! Root mean square error.

use super::{needs, no_constants, not_empty};
use crate::evaluate::metric::{Finish, Formula, Metric, ScoreUnit};
use crate::exact::streams::{Stream, Streams};
use crate::families::accuracy::pair_sums::PairSums;
use crate::score::better::Better;
use crate::score::range::Range;
use crate::score::value::UndefinedReason;

pub(crate) static RMSE: Metric = Metric {
    id: "rmse",
    title: "root mean square error",
    better: Better::Lower,
    unit: ScoreUnit::OfChannel,
    range: Range::Positive,
    definition: "rmse/1",
    reference: "square root of the mean squared error",
    documentation: "Like the mean absolute error, but large errors weigh more; 1.25 times as large if errors are Gaussian.",
    needs: needs(1, &[]),
    facts: &[],
    constants: no_constants,
    formula: Formula::Pairs {
        streams: Streams::of(&[Stream::Squared]),
        gated: false,
        finish: Finish {
            count: PairSums::n,
            evaluate: rmse,
        },
    },
};

/// RN(√RN(Sdd / n)).
fn rmse(sums: &PairSums) -> Result<f64, UndefinedReason> {
    not_empty(sums)?;
    Ok(sums.mean_squared_error().sqrt())
}
