//! Tolerance interval of errors.

use taceva_core::Unit;

use crate::evaluate::family::Numbers;
use crate::evaluate::metric::{Formula, Metric, ScoreUnit};
use crate::families::error_limits::{ERROR_LIMITS, Errors, LIMIT_NEEDS, LimitFormula};
use crate::score::Parameter;
use crate::score::direction::Better;
use crate::score::range::Range;
use crate::score::theme::Theme;
use crate::stats::NormalSample;

/// Share of all errors that the interval contains, with the confidence [`CONFIDENCE`].
const SHARE: f64 = 0.95;
const CONFIDENCE: f64 = 0.95;

pub(crate) static TOLERANCE_INTERVAL: Metric = Metric {
    id: "tolerance_interval",
    title: "error that 95 % of errors do not exceed",
    symbol: Some("tolerance interval"),
    theme: Theme::Accuracy,
    better: Better::Lower,
    variants: &[("lower", Better::NearZero), ("upper", Better::NearZero)],
    unit: ScoreUnit::OfChannel,
    range: Range::Positive,
    definition: "tolerance_interval/1",
    reference: "Krishnamoorthy and Mathew, Statistical Tolerance Regions (2009), 2.3; ISO 16269-6; Satterthwaite, Biometrics Bulletin 2 (1946)",
    documentation: "The x of `95 % of errors lie within ±x`, with a confidence of 95 %: the end that is farther from zero of the interval \
                    from `lower` to `upper`. These are mean ± k standard deviations of truth − prediction with the exact factor k of normally \
                    distributed errors. The fewer clusters there are, the greater k is: 3.4 for ten independent errors, 2.2 for a \
                    hundred, at least 1.96. The standard deviation is that of the agreement, with both components of variance if a contact \
                    point was pressed several times. The interval of the value is by jackknife over clusters, with \
                    the same k. Undefined without contact points unless samples are declared independent, if all errors are equal, or if \
                    all samples are of one cluster. Above 30,000 clusters of a channel they count as unknown.",
    needs: LIMIT_NEEDS,
    constants: |_| {
        let constant = |name, value| Parameter { name, value };
        vec![constant("share", SHARE), constant("confidence", CONFIDENCE)]
    },
    formula: Formula(&LimitFormula {
        finish: tolerance_interval,
        factor,
        settle: |_, _| {},
    }),
    ..Metric::of(&ERROR_LIMITS)
};

fn factor(sample: &NormalSample) -> Option<f64> {
    sample.tolerance_factor(SHARE, CONFIDENCE)
}

fn tolerance_interval(errors: &Errors<'_>, unit: Unit) -> Numbers {
    let ends = errors.tolerance_ends(factor);
    Numbers::of(ends.map(|[low, high]| low.abs().max(high.abs())))
        .with("lower", unit, Range::Any, ends.map(|[low, _]| low))
        .with("upper", unit, Range::Any, ends.map(|[_, high]| high))
}
