//! Success rate of the recognition of spacings.

use taceva_core::{Field, FieldSet, Nanometre, Needs, Unit};

use super::histogram::Histogram;
use crate::evaluate::family::{Details, Numbers};
use crate::evaluate::metric::{Metric, ScoreUnit};
use crate::families::resolution::KIND;
use crate::score::curve::Curve;
use crate::score::direction::Better;
use crate::score::range::Range;
use crate::score::theme::Theme;
use crate::score::value::{UndefinedReason, Value};
use crate::score::verdict_rule::{OF_CONSTANT, VerdictRule};
use crate::score::{Parameter, Variant};
use crate::stats::wilson;

pub(crate) static SR: Metric = Metric {
    id: "sr",
    title: "success rate of spacings",
    symbol: Some("SR"),
    theme: Theme::Detail,
    better: Better::Higher,
    variants: &[("of_constant", Better::Described)],
    unit: ScoreUnit::One,
    range: Range::Share,
    definition: "sr/1",
    reference: "TacEva, equation (4)",
    documentation: "Share of gratings whose spacing is predicted to within 0.05 mm, for lines and dots separately. Spacings are compared \
                    in whole nanometres, because 0.40 − 0.35 ≤ 0.05 is false in binary64. `exact` is the share without any error, \
                    `curve` the share for every tolerance up to 1 mm. `wilson` is the narrower interval of independent samples; presses \
                    of one board depend on each other. Samples without point_id are grouped by kind and spacing of their board. \
                    `of_constant` is the share of the best constant prediction. A classifier takes part in verdicts only if its interval \
                    is above that share.",
    needs: Needs::new(
        FieldSet::EMPTY
            .with(Field::Kind)
            .with(Field::Spacing)
            .with(Field::PredictedSpacing),
    )
    .with_least_samples(1),
    verdict: VerdictRule::Share,
    ..Metric::of(&KIND)
};

/// Step between tolerances of the curve, nm.
const STEP_NM: u64 = 50_000;
/// Number of tolerances of the curve: 0, 0.05, …, 1 mm.
const LEVELS: u64 = 21;

/// Share of spacings recognised within the tolerance, and share of spacings recognised exactly.
pub(super) fn success_rate(histogram: &Histogram, tolerance_nm: u64) -> Numbers {
    let rate = |tolerance: u64| histogram.rate(tolerance).ok_or(UndefinedReason::Empty);
    Numbers::of(rate(tolerance_nm)).with("exact", Unit::One, Range::Share, rate(0))
}

pub(super) fn details(histogram: &Histogram, tolerance: Nanometre, tolerance_nm: u64) -> Details {
    let levels = || (0..LEVELS).map(|level| level * STEP_NM);
    let millimetres = |nanometres: u64| {
        let nanometres = i64::try_from(nanometres).expect("at most 1 mm");
        Nanometre(nanometres).to_millimetres()
    };
    let curve = Curve {
        x: levels().map(millimetres).collect(),
        x_unit: Unit::Millimetre,
        values: levels().map(|level| histogram.rate(level)).collect(),
        counts: levels().map(|level| histogram.hits(level)).collect(),
        band: None,
    };
    let mut variants = vec![Variant::plain("curve", Unit::One, Value::Curve(curve))];
    if let Some(rate) = histogram.of_constant(tolerance_nm) {
        variants.push(Variant::plain(OF_CONSTANT, Unit::One, Value::Scalar(rate)));
    }
    if let Some(rate) = histogram.rate(tolerance_nm) {
        let interval = wilson::interval(histogram.hits(tolerance_nm), histogram.n());
        variants.push(Variant {
            range: Range::Share,
            interval: Some(interval),
            ..Variant::plain("wilson", Unit::One, Value::Scalar(rate))
        });
    }
    Details {
        variants,
        parameters: vec![Parameter {
            name: "tolerance_mm",
            value: tolerance.to_millimetres(),
        }],
        ..Details::default()
    }
}
