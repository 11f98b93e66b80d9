//! Mean Euclidean error in a plane.

use crate::evaluate::metric::{Formula, Metric, ScoreUnit};
use crate::exact::Dyadic;
use crate::families::accuracy::pairs::PAIR_NEEDS;
use crate::families::accuracy::plane::{PLANE, PlaneFormula};
use crate::families::accuracy::plane_sums::PlaneSums;
use crate::score::direction::Better;
use crate::score::range::Range;
use crate::score::theme::Theme;
use crate::score::value::{Finished, UndefinedReason};

pub(crate) static MAE_EUCLID: Metric = Metric {
    id: "mae_euclid",
    title: "mean Euclidean error in the plane",
    symbol: Some("MAE, Euclidean"),
    theme: Theme::Accuracy,
    better: Better::Lower,
    unit: ScoreUnit::OfChannel,
    range: Range::Positive,
    definition: "mae_euclid/1",
    reference: "mean of √((x − x̂)² + (y − ŷ)²)",
    documentation: "Mean distance between the predicted and the true point; 1.57 times the mean absolute error of an axis for \
                    Gaussian errors of mean zero that are alike on both axes. The paper's xy value differs: it is the mean of the two axes' scores.",
    needs: PAIR_NEEDS,
    formula: Formula(&PlaneFormula(mae_euclid)),
    ..Metric::of(&PLANE)
};

/// Mean distance between predicted and true position in the plane, rounded once.
fn mae_euclid(sums: &PlaneSums) -> Finished {
    if sums.n() == 0 {
        return Err(UndefinedReason::Empty);
    }
    Ok(sums.distance().to_dyadic().over(&Dyadic::from(sums.n())))
}
