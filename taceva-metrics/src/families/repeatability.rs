//! How far predictions of the same press scatter.

mod repeats;
mod signal;
mod spread;

pub(crate) use repeats::Repeats;
pub(crate) use signal::SIGNAL_TO_REPEATABILITY;

use taceva_core::{Field, FieldSet, Needs, Unit};

use crate::evaluate::family::Numbers;
use crate::evaluate::metric::{Formula, Metric, ScoreUnit};
use crate::score::Parameter;
use crate::score::better::Better;
use crate::score::range::Range;
use spread::SpreadSums;

/// The factor between repeatability standard deviation and repeatability limit: f √2 with f = 1.96, rounded to one decimal as
/// ISO 5725-6 (4.1.4) does.
pub(crate) const LIMIT_FACTOR: f64 = 2.8;

/// What scores of repeats need.
const NEEDS: Needs = Needs::new(
    FieldSet::EMPTY
        .with(Field::Prediction)
        .with(Field::Point)
        .with(Field::DepthStep)
        .with(Field::Repeat),
)
.with_least_samples(2);

pub(crate) static REPEATABILITY: Metric = Metric {
    id: "repeatability",
    title: "repeatability standard deviation",
    better: Better::Lower,
    unit: ScoreUnit::OfChannel,
    range: Range::Positive,
    definition: "repeatability/1",
    reference: "TacEva, equation (9); ISO 5725",
    documentation: "How far predictions scatter when the same point is pressed to the same depth again: the standard deviation \
                    (over n − 1) of each cell of point and depth step with two repeats or more, averaged over cells. \
                    `population` divides by n; `pooled` is s_r, the root of the mean variance weighted by n − 1; `limit` is \
                    2.8 s_r, which two repeats exceed once in twenty times; `curve` is the mean at each depth step.",
    needs: NEEDS,
    facts: &[],
    constants: limit_factor,
    formula: Formula::Repeatability,
};

fn limit_factor(_: Unit) -> Vec<Parameter> {
    vec![Parameter {
        name: "limit_factor",
        value: LIMIT_FACTOR,
    }]
}

/// Rep = RN(Σ s_c / cells) over the cells c with two repeats, s_c = √RN((n Sqq − Sq²) / (n (n − 1))).
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
