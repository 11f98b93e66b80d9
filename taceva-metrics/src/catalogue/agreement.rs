//! Limits of agreement of predictions with the truth.

use taceva_core::Unit;

use crate::evaluate::family::{Intervals, Numbers};
use crate::evaluate::metric::{Formula, Metric, ScoreUnit};
use crate::families::error_limits::{
    ERROR_LIMITS, Errors, LIMIT_NEEDS, LimitFormula, Whole, of_components,
};
use crate::score::direction::Better;
use crate::score::range::Range;
use crate::score::theme::Theme;
use crate::score::value::{Finished, UndefinedReason};
use crate::score::{Interval, Parameter};
use crate::stats::{NormalSample, chance};

/// Name of the variant with the slope of errors over the mean of truth and prediction.
const SLOPE: &str = "slope";
const SLOPE_P: &str = "slope_p";

pub(crate) static AGREEMENT: Metric = Metric {
    id: "agreement",
    title: "half width of the limits of agreement",
    symbol: Some("agreement"),
    theme: Theme::Accuracy,
    better: Better::Lower,
    variants: &[
        ("bias", Better::NearZero),
        ("lower", Better::NearZero),
        ("upper", Better::NearZero),
        (SLOPE, Better::NearZero),
        (SLOPE_P, Better::Described),
    ],
    unit: ScoreUnit::OfChannel,
    range: Range::Positive,
    definition: "agreement/1",
    reference: "Bland and Altman, Lancet 327 (1986); Carkeet, Optometry and Vision Science 92 (2015); Satterthwaite, Biometrics Bulletin 2 \
        (1946)",
    documentation: "1.96 standard deviations of truth − prediction. About 95 % of errors that are normally distributed are within \
                    `bias` ± this value, from `lower` to `upper`. If a contact point was pressed several times, the variance `sd`² \
                    is the sum of those between and within clusters of the one-way random model. Its degrees of freedom are \
                    Satterthwaite's. Intervals are exact for independent errors of one normal distribution: of `lower` and `upper` by the \
                    noncentral t distribution, of the value and `sd` by χ². Clusters may differ in spread, so intervals over clusters leave out one \
                    cluster at a time, as do those of planes and of `slope`. `slope` is the change of the error with the mean of truth and \
                    prediction, and `slope_p` the probability of such a slope by chance. Undefined if all errors are equal, or if all samples are of one cluster. \
                    Above 30,000 clusters of a channel they count as unknown.",
    needs: LIMIT_NEEDS,
    constants: |_| {
        vec![Parameter {
            name: "share",
            value: 0.95,
        }]
    },
    formula: Formula(&LimitFormula {
        finish: agreement,
        factor: |_| None,
        settle,
    }),
    ..Metric::of(&ERROR_LIMITS)
};

fn agreement(errors: &Errors<'_>, unit: Unit) -> Numbers {
    let sample = errors.sample();
    let of = |number: fn(&NormalSample) -> f64| sample.map(|sample| number(&sample));
    let limits = sample.map(|sample| sample.limits());
    let [slope, chance] = errors.slope();
    Numbers::of(of(NormalSample::half_width))
        .with("bias", unit, Range::Any, errors.mean())
        .with("sd", unit, Range::Positive, of(|sample| sample.sd))
        .with("lower", unit, Range::Any, limits.map(|[lower, _]| lower))
        .with("upper", unit, Range::Any, limits.map(|[_, upper]| upper))
        .with(SLOPE, Unit::One, Range::Any, slope)
        .with(SLOPE_P, Unit::One, Range::Any, chance)
}

/// For independent errors, replaces the intervals by exact intervals. For clustered errors, computes the p value of the slope.
fn settle(found: &mut Intervals, whole: &Whole<'_>) {
    let none = Interval::Undefined(UndefinedReason::NoInterval);
    if !whole.are_independent {
        let chance = chance_of(whole.numbers.variant(SLOPE), found.of(Some(SLOPE)));
        found.values.push((SLOPE_P.to_owned(), chance));
        found.variants.push((SLOPE_P.to_owned(), none));
        return;
    }
    let mut set = |name: &str, interval| found.variants.push((name.to_owned(), interval));
    set(SLOPE_P, none);
    let Some(sample) = whole.sample else { return };
    let of = |ends: [f64; 2], freedom: f64| of_components(ends, freedom, whole.clusters);
    let [low, high] = sample.limit_ends();
    set("bias", of(sample.mean_ends(), sample.mean_freedom));
    set("sd", of(sample.sd_ends(), sample.freedom));
    set("lower", of(low, sample.freedom));
    set("upper", of(high, sample.freedom));
    let factor = sample.half_width() / sample.sd;
    let widths = sample.sd_ends().map(|end| end * factor);
    found.value = Some(of(widths, sample.freedom));
}

/// p value of `slope` under the hypothesis of no slope, from the jackknife standard error over clusters.
fn chance_of(slope: Finished, interval: Option<Interval>) -> Finished {
    let slope = slope?;
    match interval {
        Some(Interval::Jackknife {
            standard_error,
            freedom,
            ..
        }) => Ok(chance(slope, standard_error, freedom)),
        Some(Interval::Undefined(reason)) => Err(reason),
        _ => Err(UndefinedReason::NoInterval),
    }
}
