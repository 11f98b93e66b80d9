//! Scatter of predictions among repeats of one press.

use taceva_core::Unit;

use crate::evaluate::family::Numbers;
use crate::evaluate::metric::{Formula, Metric, ScoreUnit};
use crate::families::repeats::spread::SpreadSums;
use crate::families::repeats::{REPEAT_NEEDS, REPEATS, RepeatFormula};
use crate::score::Parameter;
use crate::score::direction::Better;
use crate::score::range::Range;
use crate::score::theme::Theme;

/// Ratio of the repeatability limit to the repeatability standard deviation: f √2 with f = 1.96, rounded to one decimal as in
/// ISO 5725-6 (4.1.4).
const LIMIT_FACTOR: f64 = 2.8;

pub(crate) static REPEATABILITY: Metric = Metric {
    id: "repeatability",
    title: "repeatability standard deviation",
    symbol: Some("$\\sigma_{\\mathrm{rep}}$"),
    theme: Theme::Robustness,
    better: Better::Lower,
    unit: ScoreUnit::OfChannel,
    range: Range::Positive,
    definition: "repeatability/1",
    reference: "TacEva, equation (9); ISO 5725",
    documentation: "Scatter of predictions when the same point is pressed to the same depth again: the standard deviation (over n − 1) \
                    of each cell of point and depth step with two repeats or more, averaged over cells. `population` divides by n. \
                    `pooled` is s_r, the root of the mean variance weighted by n − 1. Verdicts use `pooled`, because fewer repeats make \
                    the average of standard deviations smaller. `limit` is 2.8 s_r, which the difference of two Gaussian repeats exceeds \
                    once in twenty times; `curve` is the mean at each depth step.",
    needs: REPEAT_NEEDS,
    decided_by: Some("pooled"),
    constants: limit_factor,
    formula: Formula(&RepeatFormula {
        finish: repeatability,
        has_curve: true,
        needs_stimulus: false,
    }),
    ..Metric::of(&REPEATS)
};

fn limit_factor(_: Unit) -> Vec<Parameter> {
    vec![Parameter {
        name: "limit_factor",
        value: LIMIT_FACTOR,
    }]
}

/// Mean of the sample standard deviations over all groups of at least two repeats, rounded once.
fn repeatability(spreads: &SpreadSums, unit: Unit) -> Numbers {
    let pooled = spreads.pooled();
    Numbers::of(spreads.mean(|spread| spread.deviation))
        .with(
            "population",
            unit,
            Range::Positive,
            spreads.mean(|spread| spread.population_deviation),
        )
        .with("pooled", unit, Range::Positive, pooled)
        .with(
            "limit",
            unit,
            Range::Positive,
            pooled.map(|pooled| LIMIT_FACTOR * pooled),
        )
}
