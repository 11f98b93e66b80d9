//! Mean Euclidean error in a plane.

use super::{needs, no_constants};
use crate::evaluate::metric::{Finish, Formula, Metric, ScoreUnit};
use crate::exact::Dyadic;
use crate::families::accuracy::plane_sums::PlaneSums;
use crate::score::better::Better;
use crate::score::range::Range;
use crate::score::value::UndefinedReason;

pub(crate) static MAE_EUCLID: Metric = Metric {
    id: "mae_euclid",
    title: "mean Euclidean error in the plane",
    better: Better::Lower,
    unit: ScoreUnit::OfChannel,
    range: Range::Positive,
    definition: "mae_euclid/1",
    reference: "mean of √((x − x̂)² + (y − ŷ)²)",
    documentation: "How far the predicted point is from the true one on average; 1.57 times the mean absolute error of an \
                    axis if errors are Gaussian. Not the paper's xy value, which is the mean of the two axes' scores.",
    needs: needs(1, &[]),
    facts: &[],
    constants: no_constants,
    formula: Formula::Plane(Finish {
        count: PlaneSums::n,
        evaluate: mae_euclid,
    }),
};

/// RN(Se / n), e the distance of each sample.
fn mae_euclid(sums: &PlaneSums) -> Result<f64, UndefinedReason> {
    if sums.n() == 0 {
        return Err(UndefinedReason::Empty);
    }
    Ok(sums.distance().to_dyadic().over(&Dyadic::from(sums.n())))
}
